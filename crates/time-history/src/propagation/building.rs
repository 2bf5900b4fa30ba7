//! Matrices of one building.

use nalgebra::{DMatrix, SymmetricEigen};

use super::{BOUNDED, Ends, HALVINGS, NARROW, WIDE, multiply, pad, padded};
use crate::dynamics::Segment;
use crate::polynomial::GAUSS;
use crate::system::{Grounds, System};

/// Coordinates of a building at most: the work of an interval grows with their square, that of
/// the matrices with the cube.
const COORDINATES: usize = 60;
/// Product of rate and time over which the series of the matrix exponential is summed.
const REACH: f64 = 0.5;
/// Its terms.
const TERMS: usize = 16;
/// Blocks of rows of derivatives: those of order two to six, two for bounds, and the others.
const FIRST: usize = 5;
const ALL: usize = BOUNDED.end;

#[derive(Debug, Clone)]
pub(super) struct Building {
    /// Degrees of freedom.
    pub dofs: Vec<usize>,
    pub mass: Vec<f64>,
    /// Stiffness and damping over the masses, with their signs changed: column after column,
    /// filled up with zeros.
    pub restoring: [Vec<f64>; 2],
    /// Stiffness and damping, columns filled up with zeros.
    pub stiffness: Vec<f64>,
    pub damping: Vec<f64>,
    /// Degrees of freedom whose ground accelerations, less those of forces, are the loads, one for each that differs.
    loads: Vec<usize>,
    /// Load of every coordinate.
    load_of: Vec<usize>,
    /// From displacements, velocities, and acceleration and slope of every load to the
    /// derivatives of order two to six; the third and fifth times the root of the stiffness;
    /// the derivatives of order seven and more.
    derive: Vec<f64>,
    /// For whole intervals, by length: the rows of the step; what is squared in the bounds of
    /// orders 4 and 6, the derivative of that order times the roots of the masses, and the one
    /// before times the root of the stiffness; absolute accelerations at the end, and their rates.
    whole: Vec<Vec<f64>>,
    /// Whether forces push it, so that its loads are not its ground accelerations.
    pushed: bool,
    /// By length, then by the number of halvings.
    steps: Vec<Vec<Step>>,
    /// Displacements, velocities and loads at both ends of the step; what comes of them.
    start: Vec<f64>,
    end: Vec<f64>,
    led: Vec<f64>,
    derived: Vec<f64>,
    /// What comes of a whole interval, and absolute accelerations with their rates at its end.
    led_whole: Vec<f64>,
    absolute: Vec<f64>,
    force: Vec<f64>,
}

/// The motion of a building at the end of a step: displacements, velocities, absolute
/// accelerations and their rates.
pub(crate) struct EndMotion<'a> {
    pub displacement: &'a [f64],
    pub velocity: &'a [f64],
    pub acceleration: &'a [f64],
    pub acceleration_rate: &'a [f64],
}

/// Matrices for one length, column after column.
#[derive(Debug, Clone)]
struct Step {
    /// From displacements, velocities, and acceleration and slope of every load to displacements,
    /// velocities and integrals of displacements; then the quadratic form of the same for the
    /// work of the damping.
    rows: Vec<f64>,
}

impl Building {
    pub(super) fn new(system: &System, index: usize, lengths: &[f64]) -> Option<Self> {
        let building = &system.buildings()[index];
        let dofs: Vec<usize> = system.parts(index).into_iter().flatten().collect();
        let n = dofs.len();
        if n > COORDINATES {
            return None;
        }
        let mass = building.inertia().to_vec();
        let (k, c) = (building.stiffness_matrix(), building.damping_matrix());
        let stiffness = DMatrix::from_fn(n, n, |i, j| k.entry(i, j));
        let damping = DMatrix::from_fn(n, n, |i, j| c.entry(i, j));
        let scaled = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] / (mass[i] * mass[j]).sqrt())
        };
        let values = |matrix: DMatrix<f64>| {
            let symmetric = 0.5 * (&matrix + matrix.transpose());
            let values = SymmetricEigen::new(symmetric).eigenvalues;
            (values.min(), values.amax())
        };
        // The bounds rest on both.
        let (soft, stiff) = values(scaled(&stiffness));
        let (driven, damped) = values(scaled(&damping));
        if !(soft > 0.0) || driven < -1.0e-9 * damped.max(f64::MIN_POSITIVE) {
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
        let columns = 2 * (n + loads.len());
        let over_mass =
            |matrix: &DMatrix<f64>| DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] / mass[i]);
        let (soft, damped) = (over_mass(&stiffness), over_mass(&damping));
        let root = stiffness.clone().cholesky()?.l().transpose();
        let derive = derivatives((&soft, &damped, &root), &load_of, columns);
        let mut this = Self {
            dofs,
            restoring: [-&soft, -&damped].map(|m| pad(n, m.iter().copied())),
            stiffness: pad(n, stiffness.iter().copied()),
            damping: pad(n, damping.iter().copied()),
            loads,
            load_of,
            derive: pad(ALL * n, derive.iter().copied()),
            whole: Vec::new(),
            pushed: !system.forces().is_empty(),
            steps: Vec::new(),
            start: vec![0.0; columns],
            end: vec![0.0; columns],
            led: vec![0.0; padded(3 * n + columns)],
            derived: vec![0.0; padded(ALL * n)],
            led_whole: vec![0.0; (9 * n + columns).next_multiple_of(WIDE)],
            absolute: vec![0.0; 2 * n],
            force: vec![0.0; padded(n)],
            mass,
        };
        for length in lengths {
            let steps = this.steps(*length, stiff.sqrt(), (&soft, &damped));
            let finite = |step: &Step| step.rows.iter().all(|x| x.is_finite());
            if !steps.iter().all(finite) {
                return None;
            }
            let whole = this.whole(&steps[0], *length, &derive);
            this.whole.push(whole);
            this.steps.push(steps);
        }
        Some(this)
    }

    /// Matrices of a step, and of its parts. The exponential is summed over a part of the step
    /// and squared, with displacements times the fastest rate, so that all entries are of the
    /// size of velocities.
    fn steps(
        &self,
        h: f64,
        rate: f64,
        (stiffness, damping): (&DMatrix<f64>, &DMatrix<f64>),
    ) -> Vec<Step> {
        let (n, columns) = (self.dofs.len(), self.start.len());
        // Integrals of the displacements stand last: they act on nothing.
        let all = columns + n;
        let mut a = DMatrix::zeros(all, all);
        for i in 0..n {
            a[(i, n + i)] = rate;
            a[(columns + i, i)] = 1.0 / rate;
            for j in 0..n {
                a[(n + i, j)] = -stiffness[(i, j)] / rate;
                a[(n + i, n + j)] = -damping[(i, j)];
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
        let doublings = libm::log2((norm * h / REACH).max(1.0)).ceil() as usize;
        let doublings = doublings.max(HALVINGS);
        let part = h / 2.0_f64.powi(doublings as i32);
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
        let c = DMatrix::from_fn(n, n, |i, j| self.mass[i] * damping[(i, j)]);
        let mut viscous = DMatrix::zeros(columns, columns);
        for (theta, weight) in GAUSS {
            let there = at(theta);
            let velocity = there.view((n, 0), (n, columns));
            viscous += velocity.transpose() * (&c * velocity) * (weight * part);
        }
        let mut whole = at(1.0);
        let mut steps = Vec::with_capacity(HALVINGS + 1);
        for left in (0..=doublings).rev() {
            if left <= HALVINGS {
                steps.push(step(n, rate, &whole, &viscous));
            }
            if left > 0 {
                let lead = whole.view((0, 0), (columns, columns)).into_owned();
                viscous += lead.transpose() * (&viscous * &lead);
                whole = &whole * &whole;
            }
        }
        steps.reverse();
        steps
    }

    /// Leads the building over a step.
    pub(super) fn advance(
        &mut self,
        (system, segment): (&System, &Segment),
        place: (f64, f64, usize, usize),
        state: (&[f64], usize),
        (index, ends): (usize, &mut Ends),
    ) {
        let n = self.dofs.len();
        let instants = self.lead((system, segment), place, state, ends);
        for (k, i) in self.dofs.iter().enumerate() {
            for order in 0..2 {
                ends.start[order][*i] = self.start[order * n + k];
                ends.end[order][*i] = self.end[order * n + k];
            }
        }
        let rows = self.derived.len();
        let second = &mut self.derived[..padded(2 * n)];
        multiply(&self.derive, rows, &self.end, second);
        self.hand_out(2, &mut ends.end);
        self.add_ground((system, segment), instants[1], &mut ends.absolute_end);
        let first = &mut self.derived[..padded((FIRST + 2) * n)];
        multiply(&self.derive, rows, &self.start, first);
        self.hand_out(2, &mut ends.start);
        self.add_ground((system, segment), instants[0], &mut ends.absolute_start);
        for (order, place) in [(4, FIRST * n), (6, (FIRST + 1) * n)] {
            let (y, x) = (&self.derived[place..][..n], self.derivative(order));
            let mut sum = 0.0;
            for i in 0..n {
                sum += self.mass[i] * x[i] * x[i] + y[i] * y[i];
            }
            ends.bounds[index][order] = sum.sqrt();
        }
    }

    /// Rows for whole intervals of this length (s).
    fn whole(&self, step: &Step, length: f64, derive: &DMatrix<f64>) -> Vec<f64> {
        let (n, columns) = (self.dofs.len(), self.start.len());
        let (led, rows) = (3 * n + columns, self.led_whole.len());
        let stride = self.led.len();
        let moved = DMatrix::from_fn(columns, columns, |i, j| {
            if i < 2 * n {
                return step.rows[j * stride + i];
            }
            let slope = (i - 2 * n).is_multiple_of(2) && j == i + 1;
            f64::from(u8::from(i == j)) + if slope { length } else { 0.0 }
        });
        // The ground's acceleration is a part of the absolute one.
        let mut absolute = derive.rows(0, 2 * n).into_owned();
        for (k, load) in self.load_of.iter().enumerate() {
            absolute[(k, 2 * n + 2 * load)] += 1.0;
            absolute[(n + k, 2 * n + 2 * load + 1)] += 1.0;
        }
        let absolute = absolute * moved;
        let squared = [(2, true), (FIRST, false), (4, true), (FIRST + 1, false)];
        let all = DMatrix::from_fn(rows, columns, |row, column| {
            if row < led {
                return step.rows[column * stride + row];
            }
            let (block, i) = ((row - led) / n, (row - led) % n);
            match squared.get(block) {
                Some((place, true)) => self.mass[i].sqrt() * derive[(place * n + i, column)],
                Some((place, false)) => derive[(place * n + i, column)],
                None if block < 6 => absolute[(row - led - 4 * n, column)],
                None => 0.0,
            }
        });
        all.as_slice().to_vec()
    }

    /// Leads the building over a whole interval, with bounds of orders 4 and 6 and no more of
    /// the motion than [`Building::end_motion`] needs.
    pub(super) fn advance_whole(
        &mut self,
        (system, segment): (&System, &Segment),
        which: usize,
        state: (&[f64], usize),
        (index, ends): (usize, &mut Ends),
    ) {
        let (n, columns) = (self.dofs.len(), self.start.len());
        let instants = [segment.ground(0.0), segment.ground(segment.length)];
        self.begin_at((system, segment), instants, state);
        let rows = self.led_whole.len();
        multiply(&self.whole[which], rows, &self.start, &mut self.led_whole);
        let (led, rest) = self.led_whole.split_at(3 * n + columns);
        self.end[..2 * n].copy_from_slice(&led[..2 * n]);
        let (squared, absolute) = rest.split_at(4 * n);
        for (order, size) in [4, 6].into_iter().zip(squared.chunks_exact(2 * n)) {
            ends.bounds[index][order] = norm(size);
        }
        self.absolute.copy_from_slice(&absolute[..2 * n]);
        self.add_works(led, ends);
        let [u, v, ..] = &mut ends.end;
        let (displacement, velocity) = self.end[..2 * n].split_at(n);
        let motion = displacement.iter().zip(velocity);
        for ((displacement, velocity), i) in motion.zip(&self.dofs) {
            (u[*i], v[*i]) = (*displacement, *velocity);
        }
    }

    /// Takes a state as the end of a step, for [`Building::end_motion`].
    pub(super) fn end_at(
        &mut self,
        (system, segment): (&System, &Segment),
        tau: f64,
        (state, dofs): (&[f64], usize),
    ) {
        let (n, instant) = (self.dofs.len(), segment.ground(tau));
        for (k, i) in self.dofs.iter().enumerate() {
            self.end[k] = state[*i];
            self.end[n + k] = state[dofs + *i];
        }
        for (k, i) in self.loads.iter().enumerate() {
            self.end[2 * n + 2 * k] = system.load_on(*i, instant);
            self.end[2 * n + 2 * k + 1] = system.load_slope_on(*i, segment);
        }
        let rows = self.derived.len();
        let second = &mut self.derived[..padded(2 * n)];
        multiply(&self.derive, rows, &self.end, second);
        for (k, load) in self.load_of.iter().enumerate() {
            self.absolute[k] = self.derived[k] + self.end[2 * n + 2 * load];
            self.absolute[n + k] = self.derived[n + k] + self.end[2 * n + 2 * load + 1];
        }
    }

    pub(super) fn end_motion(&self) -> EndMotion<'_> {
        let n = self.dofs.len();
        EndMotion {
            displacement: &self.end[..n],
            velocity: &self.end[n..2 * n],
            acceleration: &self.absolute[..n],
            acceleration_rate: &self.absolute[n..],
        }
    }

    /// Whether forces push the building.
    pub(super) fn is_pushed(&self) -> bool {
        self.pushed
    }

    /// Leads displacements and velocities over a step, and adds the works. Returns the ground
    /// at both ends.
    fn lead(
        &mut self,
        (system, segment): (&System, &Segment),
        (tau, h, which, halvings): (f64, f64, usize, usize),
        state: (&[f64], usize),
        ends: &mut Ends,
    ) -> [Grounds; 2] {
        let n = self.dofs.len();
        let instants = [segment.ground(tau), segment.ground(tau + h)];
        self.begin_at((system, segment), instants, state);
        let step = &self.steps[which][halvings];
        multiply(&step.rows, self.led.len(), &self.start, &mut self.led);
        self.end[..2 * n].copy_from_slice(&self.led[..2 * n]);
        self.add_works(&self.led, ends);
        instants
    }

    /// Takes the state at the start of a step, and the loads at both ends.
    fn begin_at(
        &mut self,
        (system, segment): (&System, &Segment),
        instants: [Grounds; 2],
        (state, dofs): (&[f64], usize),
    ) {
        let n = self.dofs.len();
        let (u, v) = self.start.split_at_mut(n);
        for ((u, v), i) in u.iter_mut().zip(v).zip(&self.dofs) {
            (*u, *v) = (state[*i], state[dofs + *i]);
        }
        for (k, i) in self.loads.iter().enumerate() {
            let place = 2 * n + 2 * k;
            let slope = system.load_slope_on(*i, segment);
            self.start[place] = system.load_on(*i, instants[0]);
            self.end[place] = system.load_on(*i, instants[1]);
            (self.start[place + 1], self.end[place + 1]) = (slope, slope);
        }
    }

    /// Adds the works of a step that led to this.
    fn add_works(&self, led: &[f64], ends: &mut Ends) {
        let (n, columns) = (self.dofs.len(), self.start.len());
        let weighed = led[3 * n..][..columns].iter().zip(&self.start);
        ends.viscous += weighed.map(|(w, x)| w * x).sum::<f64>();
        let (start, end) = (&self.start, &self.end);
        let motion = start[..n].iter().zip(&end[..n]).zip(&led[2 * n..3 * n]);
        let mut input = 0.0;
        for ((((u, after), integral), mass), load) in motion.zip(&self.mass).zip(&self.load_of) {
            let load = 2 * n + 2 * load;
            let moved = after * end[load] - u * start[load] - start[load + 1] * integral;
            input += mass * moved;
        }
        ends.input -= input;
    }

    /// The derivative of this order at the start.
    fn derivative(&self, order: usize) -> &[f64] {
        let n = self.dofs.len();
        let place = if order < FIRST + 2 { order - 2 } else { order };
        &self.derived[place * n..][..n]
    }

    /// Absolute acceleration and its rate at one end.
    fn add_ground(
        &self,
        (system, segment): (&System, &Segment),
        ground: Grounds,
        out: &mut [Vec<f64>; 2],
    ) {
        let n = self.dofs.len();
        if !self.pushed {
            // Loads are the ground's accelerations.
            for load in 0..self.loads.len() {
                let dof = self.loads[load];
                let now = system.load_on(dof, ground);
                let slope = system.load_slope_on(dof, segment);
                let own = self.dofs.iter().zip(&self.load_of).enumerate();
                for (k, (i, _)) in own.filter(|(_, (_, of))| **of == load) {
                    out[0][*i] = self.derived[k] + now;
                    out[1][*i] = self.derived[n + k] + slope;
                }
            }
            return;
        }
        for (k, i) in self.dofs.iter().enumerate() {
            out[0][*i] = self.derived[k] + system.ground_on(*i, ground);
            out[1][*i] = self.derived[n + k] + system.ground_slope_on(*i, segment);
        }
    }

    /// Works out the other derivatives and bounds.
    pub(super) fn deepen(&mut self, index: usize, ends: &mut Ends) {
        let n = self.dofs.len();
        let rows = self.derived.len();
        let four = &mut self.derived[..padded(4 * n)];
        multiply(&self.derive, rows, &self.end, four);
        self.hand_out(4, &mut ends.end);
        multiply(&self.derive, rows, &self.start, &mut self.derived);
        self.hand_out(4, &mut ends.start);
        for order in BOUNDED {
            let mut force = std::mem::take(&mut self.force);
            let (y, x) = (self.derivative(order - 1), self.derivative(order));
            multiply(&self.stiffness, force.len(), y, &mut force);
            let mut sum = 0.0;
            for i in 0..n {
                sum += self.mass[i] * x[i] * x[i] + y[i] * force[i];
            }
            ends.bounds[index][order] = sum.max(0.0).sqrt();
            self.force = force;
        }
    }

    /// Gives so many derivatives, from the second on, to the degrees of freedom.
    fn hand_out(&self, count: usize, out: &mut [Vec<f64>]) {
        let n = self.dofs.len();
        for (out, values) in out[2..].iter_mut().zip(self.derived.chunks(n)).take(count) {
            for (i, value) in self.dofs.iter().zip(values) {
                out[*i] = *value;
            }
        }
    }
}

/// Root of a sum of squares, in chains that do not wait for each other.
fn norm(x: &[f64]) -> f64 {
    let mut sums = [0.0; NARROW];
    let blocks = x.chunks_exact(NARROW);
    let rest: f64 = blocks.remainder().iter().map(|x| x * x).sum();
    for block in blocks {
        for (sum, x) in sums.iter_mut().zip(block) {
            *sum += x * x;
        }
    }
    (sums[0] + sums[1] + (sums[2] + sums[3]) + rest).sqrt()
}

/// Rows of the derivatives of order two and more.
fn derivatives(
    (stiffness, damping, root): (&DMatrix<f64>, &DMatrix<f64>, &DMatrix<f64>),
    load_of: &[usize],
    columns: usize,
) -> DMatrix<f64> {
    let n = load_of.len();
    let unit =
        |first: usize| DMatrix::from_fn(n, columns, |i, j| f64::from(u8::from(j == first + i)));
    let load = |place: usize| {
        DMatrix::from_fn(n, columns, |i, j| {
            f64::from(u8::from(j == 2 * n + 2 * load_of[i] + place))
        })
    };
    let (mut y, mut x) = (unit(0), unit(n));
    let mut all = DMatrix::zeros(ALL * n, columns);
    let mut take = |block: usize, rows: &DMatrix<f64>| {
        all.view_mut((block * n, 0), (n, columns)).copy_from(rows);
    };
    for order in 2..BOUNDED.end {
        let mut next = -(stiffness * &y) - damping * &x;
        if order < 4 {
            next -= load(order - 2);
        }
        match order {
            3 => take(FIRST, &(root * &next)),
            5 => take(FIRST + 1, &(root * &next)),
            _ => {}
        }
        take(if order < FIRST + 2 { order - 2 } else { order }, &next);
        (y, x) = (x, next);
    }
    all
}

/// The matrices of a step in metres from those with displacements times a rate.
fn step(n: usize, rate: f64, whole: &DMatrix<f64>, viscous: &DMatrix<f64>) -> Step {
    let columns = viscous.ncols();
    let unit = |j: usize| if j < n { rate } else { 1.0 };
    let row = |i: usize| match i / n {
        0 => (i, 1.0 / rate),
        1 => (i, 1.0),
        _ => (columns + i - 2 * n, 1.0),
    };
    let rows = DMatrix::from_fn(3 * n + columns, columns, |i, j| {
        match i.checked_sub(3 * n) {
            None => {
                let (i, factor) = row(i);
                whole[(i, j)] * factor * unit(j)
            }
            Some(i) => 0.5 * (viscous[(i, j)] + viscous[(j, i)]) * unit(i) * unit(j),
        }
    });
    Step {
        rows: pad(rows.nrows(), rows.iter().copied()),
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
