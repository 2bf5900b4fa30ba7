//! Taylor series of all buildings together with closed contacts whose laws are affine, over
//! steps of several radians of the fastest mode.

use super::building::Building;
use super::{BOUNDED, Ends, ORDERS, accumulate, multiply};
use crate::contact::Contacts;
use crate::dynamics::Segment;
use crate::system::System;

/// Terms at most, and at least: as many as derivatives have bounds.
const MOST: usize = 44;
const FEWEST: usize = BOUNDED.end;
/// Terms smaller than this (m, m/s) end the series.
const NEGLIGIBLE: (f64, f64) = (1.0e-18, 1.0e-17);
/// Maximum product of rate and step: terms then stay below ten times what they sum to, and
/// the works, of twice the rate, are met by Gauss's rule.
const REACH: f64 = 3.0;

/// Half of Gauss's rule with ten points on (-1, 1), exact to degree 19.
const GAUSS: [(f64, f64); 5] = [
    (0.148_874_338_981_631_2, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];

/// A closed contact with the force `at_rest + stiffness u + dashpot v` along its row.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AffineContact {
    pub level: usize,
    pub at_rest: f64,
    pub stiffness: f64,
    pub dashpot: f64,
    /// Works over the step: energy (J) and impulse (N s).
    pub work: f64,
    pub impulse: f64,
}

/// A coordinate that a level weighs.
#[derive(Debug, Clone, Copy)]
struct Entry {
    place: usize,
    weight: f64,
    /// Acceleration (1/kg) by a unit force; zero for displacements of the ground.
    push: f64,
}

/// The series with its work space. Coordinates stand building after building, then
/// displacements of the ground.
#[derive(Debug, Clone)]
pub(crate) struct ContactSeries {
    dofs: Vec<usize>,
    /// Entries of all levels, and of the ground alone.
    rows: Vec<Vec<Entry>>,
    moves_ground: Vec<bool>,
    pub contacts: Vec<AffineContact>,
    /// Bound of the rate of the buildings (1/s).
    fastest: f64,
    length: f64,
    last: usize,
    /// Terms of displacements and velocities in the time over the length.
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    /// Factors of all terms, and a sum of them.
    factors: Vec<f64>,
    sum: Vec<f64>,
    both: Vec<f64>,
    acceleration: Vec<f64>,
    /// Derivatives at the start, order after order.
    derived: Vec<f64>,
    force: Vec<f64>,
}

impl ContactSeries {
    pub(super) fn new(system: &System, buildings: &[Building]) -> Self {
        let mut dofs: Vec<usize> = buildings.iter().flat_map(|b| b.dofs.clone()).collect();
        dofs.extend(system.with_mass()..system.degrees_of_freedom());
        let n = dofs.len();
        let mass = system.mass();
        let entry = |dof: usize, weight: f64, moves: bool| Entry {
            place: dofs.iter().position(|d| *d == dof).unwrap_or(0),
            weight,
            push: if moves { weight / mass[dof] } else { 0.0 },
        };
        let row = |level: &crate::system::ContactLevel| -> Vec<Entry> {
            let ends = [(level.left, 1.0), (level.right, -1.0)].into_iter();
            let ends = ends.filter_map(|(i, w)| i.map(|i| (i, w)));
            let pushed = ends.chain(level.terms.pushed.iter().copied());
            let moved = pushed.map(|(i, w)| entry(i, w, true));
            let ground = level.terms.ground.iter();
            moved
                .chain(ground.map(|(i, w)| entry(*i, *w, false)))
                .collect()
        };
        let levels = system.levels();
        Self {
            rows: levels.iter().map(row).collect(),
            moves_ground: levels.iter().map(|l| !l.terms.ground.is_empty()).collect(),
            contacts: Vec::with_capacity(levels.len()),
            fastest: crate::rates::fastest_rate(system.buildings()),
            length: 0.0,
            last: 0,
            displacement: vec![0.0; (MOST + 1) * n],
            velocity: vec![0.0; (MOST + 1) * n],
            factors: vec![0.0; MOST + 1],
            sum: vec![0.0; n],
            both: vec![0.0; 2 * n],
            acceleration: vec![0.0; n],
            derived: vec![0.0; BOUNDED.end * n],
            force: vec![0.0; n],
            dofs,
        }
    }

    /// Takes the laws of the closed contacts; false where one is not affine, or where the
    /// bounds would not hold.
    pub(crate) fn take_laws(&mut self, system: &System, contacts: &Contacts) -> bool {
        self.contacts.clear();
        for &l in contacts.closed() {
            let (level, Some(contact)) = (&system.levels()[l], contacts.contact(l)) else {
                return false;
            };
            if contact.is_stuck() || !level.model.is_affine(&contact.collision, contact.phase) {
                return false;
            }
            let law = contact.force(level, 0.0, 0.0);
            if !(law.by_penetration >= 0.0 && law.by_velocity >= 0.0) {
                return false;
            }
            self.contacts.push(AffineContact {
                level: l,
                at_rest: law.value - law.by_penetration * contacts.width(l),
                stiffness: law.by_penetration,
                dashpot: law.by_velocity,
                work: 0.0,
                impulse: 0.0,
            });
        }
        true
    }

    /// Longest step (s).
    pub(crate) fn longest(&self, system: &System) -> f64 {
        let (mut squares, mut damping) = (self.fastest * self.fastest, 0.0);
        for contact in &self.contacts {
            let mass = system.levels()[contact.level].effective_mass;
            squares += contact.stiffness / mass;
            damping += contact.dashpot / mass;
        }
        REACH / (squares.sqrt() + damping)
    }

    /// Length (s).
    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    /// Expands the motion over a step from `tau` in an interval. Returns whether the terms
    /// have an end.
    pub(super) fn expand(
        &mut self,
        (system, buildings): (&System, &[Building]),
        (segment, tau): (&Segment, f64),
        state: &[f64],
        length: f64,
    ) -> bool {
        let n = self.dofs.len();
        self.length = length;
        for (k, i) in self.dofs.iter().enumerate() {
            self.displacement[k] = state[*i];
            self.velocity[k] = state[n + *i];
        }
        let at = segment.ground(tau);
        for k in 1..=MOST {
            self.accelerate(buildings, k);
            if k <= 2 {
                for (a, i) in self.acceleration.iter_mut().zip(&self.dofs) {
                    *a -= match k {
                        1 => system.load_on(*i, at),
                        _ => length * system.load_slope_on(*i, segment),
                    };
                }
            }
            let (scale, now) = (length / k as f64, k * n);
            let (mut farthest, mut fastest) = (0.0_f64, 0.0_f64);
            for i in 0..n {
                let (u, v) = (
                    scale * self.velocity[now - n + i],
                    scale * self.acceleration[i],
                );
                (self.displacement[now + i], self.velocity[now + i]) = (u, v);
                (farthest, fastest) = (farthest.max(u.abs()), fastest.max(v.abs()));
            }
            if k >= FEWEST && farthest < NEGLIGIBLE.0 && fastest < NEGLIGIBLE.1 {
                self.last = k;
                return true;
            }
        }
        false
    }

    /// Accelerations by term `k - 1` of the motion, without those of the ground.
    fn accelerate(&mut self, buildings: &[Building], k: usize) {
        let n = self.dofs.len();
        let range = (k - 1) * n..k * n;
        let (u, v) = (&self.displacement[range.clone()], &self.velocity[range]);
        self.acceleration.fill(0.0);
        let mut first = 0;
        for building in buildings {
            let count = building.dofs.len();
            let own = first..first + count;
            let out = &mut self.acceleration[own.clone()];
            let [by_displacement, by_velocity] = &building.restoring;
            accumulate(by_displacement, count, &u[own.clone()], out);
            accumulate(by_velocity, count, &v[own], out);
            first += count;
        }
        for contact in &self.contacts {
            let row = &self.rows[contact.level];
            let (mut delta, mut rate) = (0.0, 0.0);
            for entry in row {
                delta += entry.weight * u[entry.place];
                rate += entry.weight * v[entry.place];
            }
            let constant = if k == 1 { contact.at_rest } else { 0.0 };
            let force = constant + contact.stiffness * delta + contact.dashpot * rate;
            for entry in row {
                self.acceleration[entry.place] -= entry.push * force;
            }
        }
    }

    /// Terms of the closing (m) of a level over its width, and of its rate (m/s).
    pub(crate) fn closing(&self, level: usize, width: f64) -> ([f64; MOST + 1], [f64; MOST + 1]) {
        let n = self.dofs.len();
        let (mut delta, mut rate) = ([0.0; MOST + 1], [0.0; MOST + 1]);
        for k in 0..=self.last {
            for entry in &self.rows[level] {
                delta[k] += entry.weight * self.displacement[k * n + entry.place];
                rate[k] += entry.weight * self.velocity[k * n + entry.place];
            }
        }
        delta[0] -= width;
        (delta, rate)
    }

    /// Number of the last term.
    pub(crate) fn last(&self) -> usize {
        self.last
    }

    /// Cuts the step at this part of it.
    pub(crate) fn cut(&mut self, theta: f64) {
        let n = self.dofs.len();
        let mut factor = 1.0;
        for k in 1..=self.last {
            factor *= theta;
            for terms in [&mut self.displacement, &mut self.velocity] {
                for term in &mut terms[k * n..(k + 1) * n] {
                    *term *= factor;
                }
            }
        }
        self.length *= theta;
    }

    /// Works out the motion at both ends up to the third derivative, and bounds up to order 6.
    pub(super) fn lead(
        &mut self,
        (system, buildings): (&System, &[Building]),
        (segment, tau): (&Segment, f64),
        ends: &mut Ends,
    ) {
        let (n, h) = (self.dofs.len(), self.length);
        ends.length = h;
        let mut factor = 1.0;
        self.derived[..n].copy_from_slice(&self.displacement[..n]);
        for order in 1..BOUNDED.end {
            for i in 0..n {
                self.derived[order * n + i] = factor * self.velocity[(order - 1) * n + i];
            }
            factor *= order as f64 / h;
        }
        self.hand_out(0..4, ends);
        for (at, relative, absolute) in [
            (tau, &ends.start, &mut ends.absolute_start),
            (tau + h, &ends.end, &mut ends.absolute_end),
        ] {
            let ground = segment.ground(at);
            for i in self.dofs.iter().filter(|i| **i < system.with_mass()) {
                absolute[0][*i] = relative[2][*i] + system.ground_on(*i, ground);
                absolute[1][*i] = relative[3][*i] + system.ground_slope_on(*i, segment);
            }
        }
        self.bound(buildings, BOUNDED.start..7, ends);
    }

    /// Works out the other derivatives and bounds.
    pub(super) fn deepen(&mut self, buildings: &[Building], ends: &mut Ends) {
        self.hand_out(4..ORDERS, ends);
        self.bound(buildings, 7..BOUNDED.end, ends);
    }

    /// Gives the derivatives of these orders to the degrees of freedom.
    fn hand_out(&mut self, orders: std::ops::Range<usize>, ends: &mut Ends) {
        let (n, h) = (self.dofs.len(), self.length);
        for order in orders {
            let (terms, lower) = match order {
                0 => (&self.displacement, 0),
                _ => (&self.velocity, order - 1),
            };
            let scale = h.powi(-(lower as i32));
            for (k, factor) in self.factors[..=self.last].iter_mut().enumerate() {
                let falling = (0..lower).map(|j| k as f64 - j as f64);
                *factor = scale * falling.product::<f64>();
            }
            multiply(terms, n, &self.factors[..=self.last], &mut self.sum);
            let start = &self.derived[order * n..][..n];
            for (k, i) in self.dofs.iter().enumerate() {
                ends.start[order][*i] = start[k];
                ends.end[order][*i] = self.sum[k];
            }
        }
    }

    /// Bounds of the derivatives of these orders.
    fn bound(&mut self, buildings: &[Building], orders: std::ops::Range<usize>, ends: &mut Ends) {
        let grounded = self.contacts.iter().any(|c| self.moves_ground[c.level]);
        for order in orders.rev() {
            let (kinetic, strain) = self.energies(buildings, order);
            let bound = if grounded && order == BOUNDED.start {
                // The third derivative has ground that moves as a load.
                kinetic.sqrt() + self.length * ends.bounds[0][order + 1]
            } else {
                (kinetic + strain).max(0.0).sqrt()
            };
            for bounds in &mut ends.bounds {
                bounds[order] = bound;
            }
        }
    }

    /// `x' M x` of the derivative of this order and `y' K y` of the one before, at the start.
    fn energies(&mut self, buildings: &[Building], order: usize) -> (f64, f64) {
        let n = self.dofs.len();
        let y = &self.derived[(order - 1) * n..order * n];
        let x = &self.derived[order * n..(order + 1) * n];
        let (mut kinetic, mut strain) = (0.0, 0.0);
        let mut first = 0;
        for building in buildings {
            let count = building.dofs.len();
            let force = &mut self.force[..count];
            multiply(&building.stiffness, count, &y[first..first + count], force);
            for i in 0..count {
                kinetic += building.mass[i] * x[first + i] * x[first + i];
                strain += y[first + i] * force[i];
            }
            first += count;
        }
        for contact in &self.contacts {
            let row = self.rows[contact.level].iter();
            let delta: f64 = row.map(|e| e.weight * y[e.place]).sum();
            strain += contact.stiffness * delta * delta;
        }
        (kinetic, strain)
    }

    /// Works over the step, into `ends` and [`ContactSeries::contacts`].
    pub(super) fn works(
        &mut self,
        (system, buildings): (&System, &[Building]),
        (segment, tau): (&Segment, f64),
        ends: &mut Ends,
    ) {
        let (n, h) = (self.dofs.len(), self.length);
        (ends.input, ends.viscous) = (0.0, 0.0);
        for (k, factor) in self.factors[..=self.last].iter_mut().enumerate() {
            *factor = h / (k as f64 + 1.0);
        }
        let integral = &mut self.sum;
        multiply(&self.displacement, n, &self.factors[..=self.last], integral);
        let instants = [segment.ground(tau), segment.ground(tau + h)];
        for (k, i) in self.dofs.iter().enumerate() {
            if *i >= system.with_mass() {
                continue;
            }
            let [a, b] = instants.map(|at| system.load_on(*i, at));
            let slope = system.load_slope_on(*i, segment);
            let moved = ends.end[0][*i] * b - ends.start[0][*i] * a - slope * integral[k];
            ends.input -= system.mass()[*i] * moved;
        }
        let mut contacts = std::mem::take(&mut self.contacts);
        for contact in &mut contacts {
            let row = &self.rows[contact.level];
            let sum =
                |of: &[f64]| -> f64 { row.iter().map(|e| e.weight * of[self.dofs[e.place]]).sum() };
            let [before, after] = [sum(&ends.start[0]), sum(&ends.end[0])];
            let held: f64 = row.iter().map(|e| e.weight * self.sum[e.place]).sum();
            let change = after - before;
            contact.impulse =
                contact.at_rest * h + contact.stiffness * held + contact.dashpot * change;
            contact.work = (contact.at_rest + 0.5 * contact.stiffness * (after + before)) * change;
        }
        let grounded = contacts.iter().any(|c| self.moves_ground[c.level]);
        for (place, weight) in GAUSS {
            for theta in [0.5 * (1.0 - place), 0.5 * (1.0 + place)] {
                let weight = 0.5 * h * weight;
                let mut power = 1.0;
                for factor in &mut self.factors[..=self.last] {
                    *factor = power;
                    power *= theta;
                }
                let powers = &self.factors[..=self.last];
                multiply(&self.velocity, n, powers, &mut self.both[n..]);
                if grounded {
                    multiply(&self.displacement, n, powers, &mut self.both[..n]);
                }
                let (u, v) = self.both.split_at(n);
                let mut first = 0;
                for building in buildings {
                    let count = building.dofs.len();
                    let v = &v[first..first + count];
                    let force = &mut self.force[..count];
                    multiply(&building.damping, count, v, force);
                    let power: f64 = v.iter().zip(&*force).map(|(v, f)| v * f).sum();
                    ends.viscous += weight * power;
                    first += count;
                }
                for contact in &mut contacts {
                    let row = &self.rows[contact.level];
                    let rate: f64 = row.iter().map(|e| e.weight * v[e.place]).sum();
                    contact.work += weight * contact.dashpot * rate * rate;
                    if self.moves_ground[contact.level] {
                        let delta: f64 = row.iter().map(|e| e.weight * u[e.place]).sum();
                        let force =
                            contact.at_rest + contact.stiffness * delta + contact.dashpot * rate;
                        let of_ground = row.iter().filter(|e| e.push == 0.0);
                        let moved: f64 = of_ground.map(|e| e.weight * v[e.place]).sum();
                        ends.input += weight * force * moved;
                    }
                }
            }
        }
        self.contacts = contacts;
    }
}
