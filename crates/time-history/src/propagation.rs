//! Exact steps over whole intervals between samples for buildings that are no sums of
//! oscillators: damping that couples modes, coordinates that are no floors, several ground motions.
//!
//! Between contacts every building is linear under a load that is linear in time, so that one
//! matrix leads from start to end of an interval. Nothing may be missed inside it: displacements
//! and accelerations lie near the cubics with their values and slopes at both ends, by less than
//! `h^4/384` times the bound of their fourth derivative (Hermite's remainder). The bound follows from
//! energy: the derivatives of the motion obey the equation of motion themselves, from the second one
//! on without load, so that with `C` positive semi-definite
//! `x' M x + y' K y` of a derivative `y` and its rate `x` never grows, and
//! `|w' x| <= sqrt(w' M^-1 w) sqrt(x' M x)`.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::dynamics::Segment;
use crate::polynomial::GAUSS;
use crate::system::System;

/// Lengths of intervals for which matrices are kept; others are left to the method.
const LENGTHS: usize = 4;
/// Coordinates of a building at most: the work of an interval grows with their square, that of
/// the matrices with the cube.
const COORDINATES: usize = 60;
/// Lengths closer than this, relative to each other, are one.
const SAME: f64 = 1.0e-9;
/// Product of rate and time over which the series of the matrix exponential is summed.
const REACH: f64 = 0.5;
/// Its terms.
const TERMS: usize = 16;

/// Matrices of all buildings.
#[derive(Debug, Clone)]
pub(crate) struct Propagation {
    buildings: Vec<Building>,
    lengths: Vec<f64>,
    /// Present state of one building, and what comes of it.
    start: Vec<f64>,
    out: Vec<f64>,
    pub ends: Ends,
}

/// Values at both ends of an interval by degree of freedom: displacement, velocity, relative
/// acceleration and its rate; and bounds of the fourth derivatives of displacement and
/// acceleration by building, for a row with `w' M^-1 w = 1`.
#[derive(Debug, Clone)]
pub(crate) struct Ends {
    pub start: [Vec<f64>; 4],
    pub end: [Vec<f64>; 4],
    pub bounds: Vec<[f64; 2]>,
    /// Works over the interval (J).
    pub input: f64,
    pub viscous: f64,
}

#[derive(Debug, Clone)]
struct Building {
    /// Degrees of freedom.
    dofs: Vec<usize>,
    mass: Vec<f64>,
    /// Over the masses.
    stiffness: DMatrix<f64>,
    damping: DMatrix<f64>,
    /// Degrees of freedom whose ground accelerations are the loads, one for each that differs.
    loads: Vec<usize>,
    /// Load of every coordinate.
    load_of: Vec<usize>,
    steps: Vec<Step>,
    derivatives: [DVector<f64>; 8],
}

/// Matrices for one length.
#[derive(Debug, Clone)]
struct Step {
    /// From displacements, velocities, and acceleration and slope of every load to displacements,
    /// velocities and integrals of displacements.
    advance: DMatrix<f64>,
    /// Quadratic form of the same for the work of the damping.
    viscous: DMatrix<f64>,
}

impl Propagation {
    /// `None` for large buildings, and where the bounds would not hold. Elements with memory are
    /// not looked at.
    pub(crate) fn new(system: &System) -> Option<Self> {
        let lengths = lengths(system);
        let buildings: Option<Vec<_>> = (0..system.buildings().len())
            .map(|index| Building::new(system, index, &lengths))
            .collect();
        let buildings = buildings?;
        let most = buildings.iter().map(|b| b.columns()).max()?;
        let n = system.degrees_of_freedom();
        let zeros = || std::array::from_fn(|_| vec![0.0; n]);
        Some(Self {
            ends: Ends {
                start: zeros(),
                end: zeros(),
                bounds: vec![[0.0; 2]; buildings.len()],
                input: 0.0,
                viscous: 0.0,
            },
            start: vec![0.0; most],
            out: vec![0.0; 2 * most],
            buildings,
            lengths,
        })
    }

    /// The same for a system that may have other displacements of the ground.
    pub(crate) fn for_system(&self, system: &System) -> Self {
        let (mut this, n) = (self.clone(), system.degrees_of_freedom());
        let Ends { start, end, .. } = &mut this.ends;
        for values in start.iter_mut().chain(end) {
            values.resize(n, 0.0);
        }
        this
    }

    /// Leads the state over an interval; false where there are no matrices for it.
    pub(crate) fn advance(&mut self, system: &System, segment: &Segment, state: &[f64]) -> bool {
        let h = segment.length;
        let same = |length: &f64| (length - h).abs() <= SAME * h;
        let Some(which) = self.lengths.iter().position(same) else {
            return false;
        };
        let n = system.degrees_of_freedom();
        (self.ends.input, self.ends.viscous) = (0.0, 0.0);
        let ends = [segment.ground(0.0), segment.ground(h)];
        for (index, building) in self.buildings.iter_mut().enumerate() {
            let work = (self.start.as_mut_slice(), self.out.as_mut_slice());
            self.ends.bounds[index] =
                building.advance((system, segment, which), (state, n), work, &mut self.ends);
        }
        // Displacements of the ground are cubics.
        for i in system.with_mass()..n {
            let [a, b] = ends.map(|ground| -system.load_on(i, ground));
            let slope = -system.load_slope_on(i, segment);
            let (x, v) = (state[i], state[n + i]);
            let end = [
                x + h * (v + h * (0.5 * a + h * slope / 6.0)),
                v + h * (a + 0.5 * h * slope),
            ];
            let (start, end) = ([x, v, a, slope], [end[0], end[1], b, slope]);
            for k in 0..4 {
                self.ends.start[k][i] = start[k];
                self.ends.end[k][i] = end[k];
            }
        }
        true
    }
}

/// Distinct lengths of the intervals of a run, the most frequent ones.
fn lengths(system: &System) -> Vec<f64> {
    let mut found: Vec<(f64, usize)> = Vec::new();
    for length in system.interval_lengths() {
        let known = |(l, _): &&mut (f64, usize)| (*l - length).abs() <= SAME * length;
        match found.iter_mut().find(known) {
            Some((_, count)) => *count += 1,
            None => found.push((length, 1)),
        }
    }
    found.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.total_cmp(&b.0)));
    found.into_iter().take(LENGTHS).map(|(l, _)| l).collect()
}

impl Building {
    fn new(system: &System, index: usize, lengths: &[f64]) -> Option<Self> {
        let building = &system.buildings()[index];
        let dofs: Vec<usize> = system.parts(index).into_iter().flatten().collect();
        let n = dofs.len();
        if n > COORDINATES {
            return None;
        }
        let mass = building.inertia().to_vec();
        let (k, c) = (building.stiffness_matrix(), building.damping_matrix());
        let stiffness = DMatrix::from_fn(n, n, |i, j| k.entry(i, j) / mass[i]);
        let damping = DMatrix::from_fn(n, n, |i, j| c.entry(i, j) / mass[i]);
        let scaled = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] * (mass[i] / mass[j]).sqrt())
        };
        let least = |matrix: DMatrix<f64>| {
            let symmetric = 0.5 * (&matrix + matrix.transpose());
            let values = SymmetricEigen::new(symmetric).eigenvalues;
            (values.min(), values.amax())
        };
        // The bounds rest on both.
        let (soft, stiff) = least(scaled(&stiffness));
        let (driven, _) = least(scaled(&damping));
        let most_damped = damping.amax().max(f64::MIN_POSITIVE);
        if !(soft > 0.0) || driven < -1.0e-9 * most_damped {
            return None;
        }
        let mut loads: Vec<usize> = Vec::new();
        let load_of = dofs.iter().map(|i| {
            let known = loads.iter().position(|j| system.same_load(*i, *j));
            known.unwrap_or_else(|| {
                loads.push(*i);
                loads.len() - 1
            })
        });
        let load_of: Vec<usize> = load_of.collect();
        let mut this = Self {
            dofs,
            mass,
            stiffness,
            damping,
            loads,
            load_of,
            steps: Vec::new(),
            derivatives: std::array::from_fn(|_| DVector::zeros(n)),
        };
        let rate = stiff.sqrt();
        for length in lengths {
            let step = this.step(*length, rate);
            if !step
                .advance
                .iter()
                .chain(step.viscous.iter())
                .all(|x| x.is_finite())
            {
                return None;
            }
            this.steps.push(step);
        }
        Some(this)
    }

    /// Displacements, velocities, acceleration and slope of every load.
    fn columns(&self) -> usize {
        2 * (self.dofs.len() + self.loads.len())
    }

    /// Matrices of a step. The exponential is summed over a part of the step and squared, with
    /// displacements times the fastest rate, so that all entries are of the size of velocities.
    fn step(&self, h: f64, rate: f64) -> Step {
        let (n, columns) = (self.dofs.len(), self.columns());
        // Integrals of the displacements stand last: they act on nothing.
        let all = columns + n;
        let mut a = DMatrix::zeros(all, all);
        for i in 0..n {
            a[(i, n + i)] = rate;
            a[(columns + i, i)] = 1.0 / rate;
            for j in 0..n {
                a[(n + i, j)] = -self.stiffness[(i, j)] / rate;
                a[(n + i, n + j)] = -self.damping[(i, j)];
            }
            a[(n + i, 2 * n + 2 * self.load_of[i])] = -1.0;
        }
        for load in 0..self.loads.len() {
            a[(2 * n + 2 * load, 2 * n + 2 * load + 1)] = 1.0;
        }
        let size = a
            .row_iter()
            .map(|row| row.iter().map(|x| x.abs()).sum::<f64>());
        let norm = size.fold(0.0, f64::max);
        let doublings = (norm * h / REACH).max(1.0).log2().ceil() as i32;
        let part = h / 2.0_f64.powi(doublings);
        let powers = powers(&(a * part));
        let at = |theta: f64| {
            let mut sum = powers[TERMS].clone();
            for power in powers[..TERMS].iter().rev() {
                sum *= theta;
                sum += power;
            }
            sum
        };
        // The work of the damping over the part by Gauss's rule, then over twice the time:
        // `W(2 t) = W(t) + E(t)' W(t) E(t)`.
        let c = DMatrix::from_fn(n, n, |i, j| self.mass[i] * self.damping[(i, j)]);
        let mut viscous = DMatrix::zeros(columns, columns);
        for (theta, weight) in GAUSS {
            let there = at(theta);
            let velocity = there.view((n, 0), (n, columns));
            viscous += velocity.transpose() * (&c * velocity) * (weight * part);
        }
        let mut whole = at(1.0);
        for _ in 0..doublings {
            let lead = whole.view((0, 0), (columns, columns)).into_owned();
            viscous += lead.transpose() * (&viscous * &lead);
            whole = &whole * &whole;
        }
        let unit = |j: usize| if j < n { rate } else { 1.0 };
        let row = |i: usize| match i / n {
            0 => (i, 1.0 / rate),
            1 => (i, 1.0),
            _ => (columns + i - 2 * n, 1.0),
        };
        let advance = DMatrix::from_fn(3 * n, columns, |i, j| {
            let (i, factor) = row(i);
            whole[(i, j)] * factor * unit(j)
        });
        let viscous = DMatrix::from_fn(columns, columns, |i, j| {
            0.5 * (viscous[(i, j)] + viscous[(j, i)]) * unit(i) * unit(j)
        });
        Step { advance, viscous }
    }

    /// Leads one building over an interval; returns the bounds of its derivatives.
    fn advance(
        &mut self,
        (system, segment, which): (&System, &Segment, usize),
        (state, dofs): (&[f64], usize),
        (start, out): (&mut [f64], &mut [f64]),
        ends: &mut Ends,
    ) -> [f64; 2] {
        let (n, columns) = (self.dofs.len(), self.columns());
        let h = segment.length;
        let step = &self.steps[which];
        let instants = [segment.ground(0.0), segment.ground(h)];
        for (k, i) in self.dofs.iter().enumerate() {
            start[k] = state[*i];
            start[n + k] = state[dofs + *i];
        }
        for (k, i) in self.loads.iter().enumerate() {
            start[2 * n + 2 * k] = system.load_on(*i, instants[0]);
            start[2 * n + 2 * k + 1] = system.load_slope_on(*i, segment);
        }
        let (start, out) = (&start[..columns], &mut out[..3 * n]);
        out.fill(0.0);
        for (column, x) in step.advance.column_iter().zip(start) {
            for (o, m) in out.iter_mut().zip(column.as_slice()) {
                *o += m * x;
            }
        }
        let mut viscous = 0.0;
        for (column, x) in step.viscous.column_iter().zip(start) {
            let sum: f64 = column.iter().zip(start).map(|(w, y)| w * y).sum();
            viscous += x * sum;
        }
        ends.viscous += viscous;
        for (k, i) in self.dofs.iter().enumerate() {
            let load = 2 * n + 2 * self.load_of[k];
            let [a, b] = instants.map(|at| system.load_on(*i, at));
            let moved = out[k] * b - start[k] * a - start[load + 1] * out[2 * n + k];
            ends.input -= self.mass[k] * moved;
            ends.start[0][*i] = start[k];
            ends.start[1][*i] = start[n + k];
            ends.end[0][*i] = out[k];
            ends.end[1][*i] = out[n + k];
        }
        self.differentiate(start, (&start[..n], &start[n..2 * n]), 0.0);
        for (k, i) in self.dofs.iter().enumerate() {
            ends.start[2][*i] = self.derivatives[2][k];
            ends.start[3][*i] = self.derivatives[3][k];
        }
        let energy = |y: &DVector<f64>, x: &DVector<f64>| {
            let mut sum = 0.0;
            for i in 0..n {
                let force: f64 = (0..n).map(|j| self.stiffness[(i, j)] * y[j]).sum();
                sum += self.mass[i] * (x[i] * x[i] + y[i] * force);
            }
            sum.max(0.0).sqrt()
        };
        let d = &self.derivatives;
        let bounds = [energy(&d[3], &d[4]), energy(&d[5], &d[6])];
        self.differentiate(start, (&out[..n], &out[n..2 * n]), h);
        for (k, i) in self.dofs.iter().enumerate() {
            ends.end[2][*i] = self.derivatives[2][k];
            ends.end[3][*i] = self.derivatives[3][k];
        }
        bounds
    }

    /// Derivatives of the motion, the second to the sixth, at a state `tau` after the start, where
    /// loads are as in `start`.
    fn differentiate(&mut self, start: &[f64], (u, v): (&[f64], &[f64]), tau: f64) {
        let n = self.dofs.len();
        self.derivatives[0].copy_from_slice(u);
        self.derivatives[1].copy_from_slice(v);
        for order in 2..7 {
            let (before, after) = self.derivatives.split_at_mut(order);
            let (y, x, next) = (&before[order - 2], &before[order - 1], &mut after[0]);
            next.gemv(-1.0, &self.stiffness, y, 0.0);
            next.gemv(-1.0, &self.damping, x, 1.0);
            for i in 0..n {
                let load = 2 * n + 2 * self.load_of[i];
                next[i] -= match order {
                    2 => start[load] + start[load + 1] * tau,
                    3 => start[load + 1],
                    _ => 0.0,
                };
            }
        }
    }
}

/// Terms of the exponential of a matrix, from that of order zero.
fn powers(a: &DMatrix<f64>) -> Vec<DMatrix<f64>> {
    let n = a.nrows();
    let mut powers = vec![DMatrix::identity(n, n)];
    for k in 1..=TERMS {
        let next = a * &powers[k - 1] / k as f64;
        powers.push(next);
    }
    powers
}
