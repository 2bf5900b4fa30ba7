//! Matrices of one building.

use nalgebra::{DMatrix, SymmetricEigen};

use std::ops::Range;

use super::product::{RowBlocks, multiply, pad, padded};
use super::whole_interval::{Courses, OfLength, WholeInterval};
use super::{BOUNDED, Ends, HALVINGS};
use crate::polynomial::GAUSS;
use crate::system::{Grounds, Segment, System};

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
    /// Degrees of freedom: floors, and the other coordinates.
    pub dofs: Vec<usize>,
    parts: [Range<usize>; 2],
    /// Masses, filled up with zeros as all rows are.
    pub mass: Vec<f64>,
    /// Accelerations by displacements and velocities in turn, without contacts and loads.
    pub restoring: RowBlocks,
    pub stiffness: RowBlocks,
    pub damping: RowBlocks,
    /// Maximum eigenvalues of `M^-1 K` (1/s2) and `M^-1 C` (1/s).
    pub stiffest: f64,
    pub damped: f64,
    /// Degrees of freedom whose ground accelerations, less those of forces, are the loads, one for each that differs.
    loads: Vec<usize>,
    /// Load of every coordinate that has one.
    load_of: Vec<Option<usize>>,
    /// From displacements, velocities, and acceleration and slope of every load to the
    /// derivatives of order two to six; the third and fifth times the root of the stiffness;
    /// the derivatives of order seven and more.
    derive: Vec<f64>,
    /// For whole intervals: the motion at the start, what comes of it by length, and that with
    /// functions.
    at_start: DMatrix<f64>,
    lengths: Vec<OfLength>,
    whole: WholeInterval,
    /// Whether forces push it, so that its loads are not its ground accelerations.
    pushed: bool,
    /// By length, then by the number of halvings: [`HALVINGS`], or as many more as it takes for the series of the exponential
    /// to be summed over the last part.
    steps: Vec<Vec<Step>>,
    /// Displacements, velocities and loads at both ends of the step; what comes of them.
    start: Vec<f64>,
    end: Vec<f64>,
    led: Vec<f64>,
    derived: Vec<f64>,
    force: Vec<f64>,
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
        let (driven, most_damped) = values(scaled(&damping));
        if !(soft > 0.0) || driven < -1.0e-9 * most_damped.max(f64::MIN_POSITIVE) {
            return None;
        }
        let mut loads: Vec<usize> = Vec::new();
        let load_of = dofs.iter().map(|i| {
            if !system.has_load(*i) {
                return None;
            }
            let known = loads.iter().position(|j| system.same_load(*i, *j));
            Some(known.unwrap_or_else(|| {
                loads.push(*i);
                loads.len() - 1
            }))
        });
        let load_of: Vec<Option<usize>> = load_of.collect();
        let columns = 2 * (n + loads.len());
        let over_mass =
            |matrix: &DMatrix<f64>| DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] / mass[i]);
        let (soft, damped) = (over_mass(&stiffness), over_mass(&damping));
        let root = stiffness.clone().cholesky()?.l().transpose();
        let derive = derivatives((&soft, &damped, &root), &load_of, columns);
        let mut this = Self {
            dofs,
            stiffest: stiff,
            damped: most_damped,
            parts: system.parts(index),
            restoring: RowBlocks::new(n, 2 * n, |i, j| match j % 2 {
                0 => -soft[(i, j / 2)],
                _ => -damped[(i, j / 2)],
            }),
            stiffness: RowBlocks::new(n, n, |i, j| stiffness[(i, j)]),
            damping: RowBlocks::new(n, n, |i, j| damping[(i, j)]),
            loads,
            load_of,
            derive: pad(ALL * n, derive.iter().copied()),
            at_start: DMatrix::zeros(0, 0),
            lengths: Vec::new(),
            whole: WholeInterval::default(),
            pushed: !system.forces().is_empty(),
            steps: Vec::new(),
            start: vec![0.0; columns],
            end: vec![0.0; columns],
            led: vec![0.0; padded(3 * n + columns)],
            derived: vec![0.0; padded(ALL * n)],
            force: vec![0.0; padded(n)],
            mass: pad(n, mass.into_iter()),
        };
        for length in lengths {
            let steps = this.steps(*length, stiff.sqrt(), (&soft, &damped));
            let finite = |step: &Step| step.rows.iter().all(|x| x.is_finite());
            if !steps.iter().all(finite) {
                return None;
            }
            let of_length = this.of_length(&steps[0], *length, &derive);
            this.lengths.push(of_length);
            this.steps.push(steps);
        }
        this.at_start = this.motion(&DMatrix::identity(columns, columns), &derive);
        Some(this)
    }

    /// Matrices of a step, and of its parts. The exponential is summed over a part of the step
    /// and squared, less the identity, with displacements times the fastest rate, so that all entries are of the
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
            if let Some(load) = self.load_of[i] {
                a[(n + i, 2 * n + 2 * load)] = -1.0;
            }
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
        // `W(2 t) = W(t) + E(t)' W(t) E(t)`, of which neither part loses what the other has small.
        let c = DMatrix::from_fn(n, n, |i, j| self.mass[i] * damping[(i, j)]);
        let mut viscous = DMatrix::zeros(columns, columns);
        for (theta, weight) in GAUSS {
            let there = at(theta);
            let velocity = there.view((n, 0), (n, columns));
            viscous += velocity.transpose() * (&c * velocity) * (weight * part);
        }
        // What the exponential is beside the identity: with that, the round-off of a sum of one and
        // a small number would be doubled as often as the step is, and stiff buildings that are
        // damped beyond critical are squared a million times.
        let mut change = DMatrix::zeros(all, all);
        for power in powers[1..].iter().rev() {
            change += power;
        }
        let identity = DMatrix::identity(all, all);
        let mut steps = Vec::with_capacity(doublings + 1);
        for left in (0..=doublings).rev() {
            let whole = &identity + &change;
            steps.push(step(n, rate, &whole, &viscous));
            if left > 0 {
                // `W + (I + N)' W (I + N)`.
                let lead = change.view((0, 0), (columns, columns));
                let turned = &viscous * lead;
                let both = lead.transpose() * &turned;
                viscous = 2.0 * viscous + (&turned + turned.transpose()) + both;
                change = 2.0 * &change + &change * &change;
            }
        }
        steps.reverse();
        steps
    }

    /// How often an interval of this length can be halved.
    pub(super) fn halvings(&self, which: usize) -> usize {
        self.steps[which].len() - 1
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
        let there = (instants[1], &self.end[2 * n..]);
        self.add_ground((system, segment), there, &mut ends.absolute_end);
        let first = &mut self.derived[..padded((FIRST + 2) * n)];
        multiply(&self.derive, rows, &self.start, first);
        self.hand_out(2, &mut ends.start);
        let there = (instants[0], &self.start[2 * n..]);
        self.add_ground((system, segment), there, &mut ends.absolute_start);
        for (order, place) in [(4, FIRST * n), (6, (FIRST + 1) * n)] {
            let (y, x) = (&self.derived[place..][..n], self.derivative(order));
            let mut sum = 0.0;
            for i in 0..n {
                sum += self.mass[i] * x[i] * x[i] + y[i] * y[i];
            }
            ends.bounds[index][order] = sum.sqrt();
        }
    }

    /// Displacements, velocities, absolute accelerations and their rates where displacements,
    /// velocities and loads are these.
    fn motion(&self, there: &DMatrix<f64>, derive: &DMatrix<f64>) -> DMatrix<f64> {
        let (n, columns) = (self.dofs.len(), self.start.len());
        // The ground's acceleration is a part of the absolute one.
        let mut absolute = derive.rows(0, 2 * n).into_owned();
        for (k, load) in self.load_of.iter().enumerate() {
            if let Some(load) = load {
                absolute[(k, 2 * n + 2 * load)] += 1.0;
                absolute[(n + k, 2 * n + 2 * load + 1)] += 1.0;
            }
        }
        let mut motion = DMatrix::zeros(4 * n, columns);
        motion.rows_mut(0, 2 * n).copy_from(&there.rows(0, 2 * n));
        motion.rows_mut(2 * n, 2 * n).copy_from(&(absolute * there));
        motion
    }

    /// What comes of whole intervals of this length (s). Bounds of orders 4 and 6 square the
    /// derivative of that order times the roots of the masses, and the one before times the
    /// root of the stiffness.
    fn of_length(&self, step: &Step, length: f64, derive: &DMatrix<f64>) -> OfLength {
        let (n, columns, loads) = (self.dofs.len(), self.start.len(), self.loads.len());
        let stride = self.led.len();
        let led = |row: usize, column: usize| step.rows[column * stride + row];
        let moved = DMatrix::from_fn(columns, columns, |i, j| {
            if i < 2 * n {
                return led(i, j);
            }
            let slope = (i - 2 * n).is_multiple_of(2) && j == i + 1;
            f64::from(u8::from(i == j)) + if slope { length } else { 0.0 }
        });
        let masses = self.masses();
        let squared = [[(2, true), (FIRST, false)], [(4, true), (FIRST + 1, false)]];
        let others = DMatrix::from_fn(2 * loads + columns + 4 * n, columns, |row, column| {
            if row < 2 * loads {
                let first = if row % 2 == 0 { 0 } else { 2 * n };
                let weighed = (0..n).map(|i| masses[(row / 2, i)] * led(first + i, column));
                return weighed.sum();
            }
            let row = row - 2 * loads;
            if row < columns {
                return led(3 * n + row, column);
            }
            // Two rows of the one bound and two of the other, in turn: so they are summed.
            let (pair, lane) = ((row - columns) / 4, (row - columns) % 4);
            let (block, i) = ((2 * pair + lane % 2) / n, (2 * pair + lane % 2) % n);
            let (place, by_mass) = squared[lane / 2][block];
            let root = if by_mass { self.mass[i].sqrt() } else { 1.0 };
            root * derive[(place * n + i, column)]
        });
        OfLength {
            motion: self.motion(&moved, derive),
            others,
        }
    }

    /// Masses of the coordinates that have a load, by load.
    fn masses(&self) -> DMatrix<f64> {
        DMatrix::from_fn(self.loads.len(), self.dofs.len(), |load, i| {
            let own = self.load_of[i] == Some(load);
            if own { self.mass[i] } else { 0.0 }
        })
    }

    /// Takes the functions, rows over the coordinates, whose courses whole intervals tell: of
    /// displacements, and of absolute accelerations.
    pub(super) fn follow(&mut self, functions: [&DMatrix<f64>; 2]) {
        self.whole = WholeInterval::new(&self.at_start, &self.lengths, functions, self.masses());
    }

    /// Leads the building over a whole interval, from where the last one ended or from
    /// [`Building::begin_whole`]: the motion at the end, works, bounds of orders 4 and 6, and
    /// courses.
    pub(super) fn advance_whole(
        &mut self,
        (system, segment): (&System, &Segment),
        which: usize,
        (index, ends): (usize, &mut Ends),
    ) {
        self.take_loads(system, segment, [0.0, segment.length]);
        let (work, [fourth, sixth]) = self.whole.advance(which, &mut self.start);
        ends.viscous += work;
        let bounds = &mut ends.bounds[index];
        (bounds[4], bounds[6]) = (fourth.sqrt(), sixth.sqrt());
        let first = 2 * self.dofs.len();
        let [before, after] = self.whole.others();
        let (starts, ends_of_loads) = (pairs(&self.start[first..]), pairs(&self.end[first..]));
        let loads = starts.iter().zip(ends_of_loads);
        let moved = pairs(before).iter().zip(pairs(after));
        for (([a, slope], [b, _]), ([before, _], [after, integral])) in loads.zip(moved) {
            ends.input -= after * b - before * a - slope * integral;
        }
        let [floors, further] = &self.parts;
        let [u, v, ..] = &mut ends.end;
        for (out, motion) in [u, v].into_iter().zip(self.whole.motion()) {
            let (of_floors, of_others) = motion.split_at(floors.len());
            out[floors.clone()].copy_from_slice(of_floors);
            out[further.clone()].copy_from_slice(of_others);
        }
    }

    /// Takes the state at the start of a whole interval.
    pub(super) fn begin_whole(
        &mut self,
        (system, segment): (&System, &Segment),
        state: (&[f64], usize),
    ) {
        self.take_state(state);
        self.take_loads(system, segment, [0.0, segment.length]);
        self.whole.begin(&self.start);
    }

    /// Courses over the last whole interval of the functions of displacements, then of those of
    /// absolute accelerations.
    pub(super) fn courses(&self) -> Courses<'_> {
        self.whole.courses()
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
        self.take_state(state);
        self.take_loads(system, segment, [tau, tau + h]);
        let step = &self.steps[which][halvings];
        multiply(&step.rows, self.led.len(), &self.start, &mut self.led);
        self.end[..2 * n].copy_from_slice(&self.led[..2 * n]);
        self.add_works(&self.led, ends);
        instants
    }

    /// Takes the state at the start of a step.
    fn take_state(&mut self, (state, dofs): (&[f64], usize)) {
        let n = self.dofs.len();
        let (u, v) = self.start[..2 * n].split_at_mut(n);
        for (out, given) in [u, v].into_iter().zip([&state[..dofs], &state[dofs..]]) {
            let [floors, further] = &self.parts;
            let (of_floors, of_others) = out.split_at_mut(floors.len());
            of_floors.copy_from_slice(&given[floors.clone()]);
            of_others.copy_from_slice(&given[further.clone()]);
        }
    }

    /// Takes the loads at these times (s) in an interval, where a step begins and ends.
    fn take_loads(&mut self, system: &System, segment: &Segment, times: [f64; 2]) {
        let first = 2 * self.dofs.len();
        let places = self.start[first..].as_chunks_mut::<2>().0.iter_mut();
        let places = places.zip(self.end[first..].as_chunks_mut::<2>().0);
        for (i, (start, end)) in self.loads.iter().zip(places) {
            let ([a, b], slope) = system.load_over(*i, segment, times);
            (*start, *end) = ([a, slope], [b, slope]);
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
            let Some(load) = load else { continue };
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

    /// Absolute acceleration and its rate at one end, where the ground and its loads are these.
    fn add_ground(
        &self,
        (system, segment): (&System, &Segment),
        (ground, loads): (Grounds, &[f64]),
        out: &mut [Vec<f64>; 2],
    ) {
        let n = self.dofs.len();
        for (k, i) in self.dofs.iter().enumerate() {
            let [now, slope] = match self.load_of[k] {
                // Loads are the ground's accelerations.
                Some(load) if !self.pushed => [loads[2 * load], loads[2 * load + 1]],
                None => [0.0; 2],
                Some(_) => {
                    let slope = system.ground_slope_on(*i, segment);
                    [system.ground_on(*i, ground), slope]
                }
            };
            out[0][*i] = self.derived[k] + now;
            out[1][*i] = self.derived[n + k] + slope;
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
            self.stiffness.multiply(y, &mut force);
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

/// Values two by two, as loads stand with their slopes.
#[inline]
fn pairs(values: &[f64]) -> &[[f64; 2]] {
    values.as_chunks::<2>().0
}

/// Rows of the derivatives of order two and more.
fn derivatives(
    (stiffness, damping, root): (&DMatrix<f64>, &DMatrix<f64>, &DMatrix<f64>),
    load_of: &[Option<usize>],
    columns: usize,
) -> DMatrix<f64> {
    let n = load_of.len();
    let unit =
        |first: usize| DMatrix::from_fn(n, columns, |i, j| f64::from(u8::from(j == first + i)));
    let load = |place: usize| {
        DMatrix::from_fn(n, columns, |i, j| {
            let own = load_of[i].map(|load| 2 * n + 2 * load + place);
            f64::from(u8::from(own == Some(j)))
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
