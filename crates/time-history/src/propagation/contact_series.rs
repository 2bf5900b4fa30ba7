//! Taylor series of all buildings together with closed contacts whose laws are affine, over
//! steps of several radians of the fastest mode.

use multiversion::multiversion;

use super::building::Building;
use super::{BOUNDED, Ends, NARROW, ORDERS, add_product, multiply, padded};
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
    dof: usize,
    place: usize,
    weight: f64,
    /// Acceleration (1/kg) by a unit force; zero for displacements of the ground.
    push: f64,
}

/// Values of the terms of one function.
pub(crate) type SeriesTerms = [f64; MOST + 1];

/// The series with its work space. Coordinates stand building after building, then
/// displacements of the ground, each filled up with zeros to whole blocks of rows.
#[derive(Debug, Clone)]
pub(crate) struct ContactSeries {
    /// Places with their degrees of freedom, and the number of all places.
    dofs: Vec<(usize, usize)>,
    places: usize,
    /// Place of every degree of freedom.
    place_of: Vec<usize>,
    /// Entries of all levels, and of the ground alone.
    rows: Vec<Vec<Entry>>,
    moves_ground: Vec<bool>,
    pub contacts: Vec<AffineContact>,
    /// Bound of the rate of the buildings (1/s).
    fastest: f64,
    length: f64,
    last: usize,
    /// Whether both ends have been worked out since the motion was expanded.
    led: bool,
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
        let (mut dofs, mut first) = (Vec::new(), 0);
        let moving: Vec<usize> = (system.with_mass()..system.degrees_of_freedom()).collect();
        for own in buildings.iter().map(|b| &b.dofs).chain([&moving]) {
            dofs.extend(own.iter().enumerate().map(|(k, i)| (first + k, *i)));
            first += padded(own.len());
        }
        let n = first;
        let mut place_of = vec![0; dofs.len()];
        for (place, dof) in &dofs {
            place_of[*dof] = *place;
        }
        let mass = system.mass();
        let entry = |dof: usize, weight: f64, moves: bool| Entry {
            dof,
            place: place_of[dof],
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
            led: false,
            displacement: vec![0.0; (MOST + 1) * n],
            velocity: vec![0.0; (MOST + 1) * n],
            factors: vec![0.0; MOST + 1],
            sum: vec![0.0; n],
            both: vec![0.0; 2 * n],
            acceleration: vec![0.0; n],
            derived: vec![0.0; BOUNDED.end * n],
            force: vec![0.0; n],
            dofs,
            places: n,
            place_of,
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
        let (n, all) = (self.places, self.dofs.len());
        self.length = length;
        self.led = false;
        for (k, i) in &self.dofs {
            self.displacement[*k] = state[*i];
            self.velocity[*k] = state[all + *i];
        }
        let at = segment.ground(tau);
        for k in 1..=MOST {
            let (u, u_next) = self.displacement[(k - 1) * n..(k + 1) * n].split_at_mut(n);
            let (v, v_next) = self.velocity[(k - 1) * n..(k + 1) * n].split_at_mut(n);
            let contacts = (self.contacts.as_slice(), self.rows.as_slice());
            accelerate(buildings, contacts, k, (u, v), &mut self.acceleration);
            if k <= 2 {
                for (place, i) in &self.dofs {
                    self.acceleration[*place] -= match k {
                        1 => system.load_on(*i, at),
                        _ => length * system.load_slope_on(*i, segment),
                    };
                }
            }
            let scale = length / k as f64;
            let terms = (u_next, v_next);
            let (farthest, fastest) = next_terms(scale, v, &self.acceleration, terms);
            if k >= FEWEST && farthest < NEGLIGIBLE.0 && fastest < NEGLIGIBLE.1 {
                self.last = k;
                return true;
            }
        }
        false
    }

    /// Terms of a sum over degrees of freedom, or of its second derivative.
    pub(crate) fn terms_of(
        &self,
        terms: impl Iterator<Item = (usize, f64)>,
        accelerations: bool,
    ) -> SeriesTerms {
        let (n, mut out) = (self.places, [0.0; MOST + 1]);
        for (dof, weight) in terms {
            let place = self.place_of[dof];
            let last = self.last;
            if accelerations {
                for (k, out) in out[..last].iter_mut().enumerate() {
                    *out += weight * self.velocity[(k + 1) * n + place];
                }
            } else {
                for (k, out) in out[..=last].iter_mut().enumerate() {
                    *out += weight * self.displacement[k * n + place];
                }
            }
        }
        if accelerations {
            for (k, out) in out[..self.last].iter_mut().enumerate() {
                *out *= (k + 1) as f64 / self.length;
            }
        }
        out
    }

    /// Terms of the force of a closed contact (N).
    pub(crate) fn force_of(&self, law: &AffineContact) -> SeriesTerms {
        let (mut force, rate) = self.closing(law.level, 0.0);
        for (force, rate) in force.iter_mut().zip(rate) {
            *force = law.stiffness * *force + law.dashpot * rate;
        }
        force[0] += law.at_rest;
        force
    }

    /// Terms of the closing (m) of a level over its width, and of its rate (m/s).
    pub(crate) fn closing(&self, level: usize, width: f64) -> (SeriesTerms, SeriesTerms) {
        let n = self.places;
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
        let n = self.places;
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
        let h = self.length;
        ends.length = h;
        // A step that is cut begins as it did, and what bounds it there still does.
        let cut = std::mem::replace(&mut self.led, true);
        let with_start = !cut || self.is_grounded();
        if with_start {
            self.derive_start();
        }
        self.hand_out(0..4, with_start, ends);
        let ends_of_step = [
            (tau, &ends.start, &mut ends.absolute_start),
            (tau + h, &ends.end, &mut ends.absolute_end),
        ];
        let wanted = if with_start { 0 } else { 1 };
        for (at, relative, absolute) in ends_of_step.into_iter().skip(wanted) {
            let ground = segment.ground(at);
            for (_, i) in self.dofs.iter().filter(|(_, i)| *i < system.with_mass()) {
                absolute[0][*i] = relative[2][*i] + system.ground_on(*i, ground);
                absolute[1][*i] = relative[3][*i] + system.ground_slope_on(*i, segment);
            }
        }
        if with_start {
            self.bound(buildings, BOUNDED.start..7, ends);
        }
    }

    /// Whether ground that moves by itself pushes a contact.
    fn is_grounded(&self) -> bool {
        self.contacts.iter().any(|c| self.moves_ground[c.level])
    }

    /// Derivatives at the start.
    fn derive_start(&mut self) {
        let (n, h) = (self.places, self.length);
        let mut factor = 1.0;
        self.derived[..n].copy_from_slice(&self.displacement[..n]);
        for order in 1..BOUNDED.end {
            for i in 0..n {
                self.derived[order * n + i] = factor * self.velocity[(order - 1) * n + i];
            }
            factor *= order as f64 / h;
        }
    }

    /// Works out the other derivatives and bounds.
    pub(super) fn deepen(&mut self, buildings: &[Building], ends: &mut Ends) {
        self.hand_out(4..ORDERS, true, ends);
        self.bound(buildings, 7..BOUNDED.end, ends);
    }

    /// Gives the derivatives of these orders to the degrees of freedom, at the end and, if
    /// asked for, at the start.
    fn hand_out(&mut self, orders: std::ops::Range<usize>, with_start: bool, ends: &mut Ends) {
        let (n, h) = (self.places, self.length);
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
            for (k, i) in &self.dofs {
                ends.end[order][*i] = self.sum[*k];
            }
            if with_start {
                let start = &self.derived[order * n..][..n];
                for (k, i) in &self.dofs {
                    ends.start[order][*i] = start[*k];
                }
            }
        }
    }

    /// Bounds of the derivatives of these orders.
    fn bound(&mut self, buildings: &[Building], orders: std::ops::Range<usize>, ends: &mut Ends) {
        let grounded = self.is_grounded();
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
        let n = self.places;
        let y = &self.derived[(order - 1) * n..order * n];
        let x = &self.derived[order * n..(order + 1) * n];
        let (mut kinetic, mut strain) = (0.0, 0.0);
        let mut first = 0;
        for building in buildings {
            let count = building.dofs.len();
            let rows = padded(count);
            let force = &mut self.force[..rows];
            multiply(&building.stiffness, rows, &y[first..first + count], force);
            for i in 0..count {
                kinetic += building.mass[i] * x[first + i] * x[first + i];
                strain += y[first + i] * force[i];
            }
            first += rows;
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
        let (n, h) = (self.places, self.length);
        (ends.input, ends.viscous) = (0.0, 0.0);
        for (k, factor) in self.factors[..=self.last].iter_mut().enumerate() {
            *factor = h / (k as f64 + 1.0);
        }
        let integral = &mut self.sum;
        multiply(&self.displacement, n, &self.factors[..=self.last], integral);
        let instants = [segment.ground(tau), segment.ground(tau + h)];
        for (k, i) in &self.dofs {
            if *i >= system.with_mass() {
                continue;
            }
            let [a, b] = instants.map(|at| system.load_on(*i, at));
            let slope = system.load_slope_on(*i, segment);
            let moved = ends.end[0][*i] * b - ends.start[0][*i] * a - slope * integral[*k];
            ends.input -= system.mass()[*i] * moved;
        }
        let mut contacts = std::mem::take(&mut self.contacts);
        for contact in &mut contacts {
            let row = &self.rows[contact.level];
            let sum = |of: &[f64]| -> f64 { row.iter().map(|e| e.weight * of[e.dof]).sum() };
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
                    let rows = padded(building.dofs.len());
                    let v = &v[first..first + building.dofs.len()];
                    let force = &mut self.force[..rows];
                    multiply(&building.damping, rows, v, force);
                    let power: f64 = v.iter().zip(&*force).map(|(v, f)| v * f).sum();
                    ends.viscous += weight * power;
                    first += rows;
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

/// Accelerations by term `k - 1` of the motion, without those of the ground.
#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
fn accelerate(
    buildings: &[Building],
    (contacts, rows): (&[AffineContact], &[Vec<Entry>]),
    k: usize,
    (u, v): (&[f64], &[f64]),
    acceleration: &mut [f64],
) {
    acceleration.fill(0.0);
    let mut first = 0;
    for building in buildings {
        let (count, rows) = (building.dofs.len(), padded(building.dofs.len()));
        let out = &mut acceleration[first..first + rows];
        let own = first..first + count;
        let [by_displacement, by_velocity] = &building.restoring;
        add_product(by_displacement, rows, &u[own.clone()], out);
        add_product(by_velocity, rows, &v[own], out);
        first += rows;
    }
    for contact in contacts {
        let row = &rows[contact.level];
        let (mut delta, mut rate) = (0.0, 0.0);
        for entry in row {
            delta += entry.weight * u[entry.place];
            rate += entry.weight * v[entry.place];
        }
        let constant = if k == 1 { contact.at_rest } else { 0.0 };
        let force = constant + contact.stiffness * delta + contact.dashpot * rate;
        for entry in row {
            acceleration[entry.place] -= entry.push * force;
        }
    }
}

/// The next terms of displacements and velocities, and the largest of each.
#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
fn next_terms(
    scale: f64,
    velocity: &[f64],
    acceleration: &[f64],
    (u, v): (&mut [f64], &mut [f64]),
) -> (f64, f64) {
    let mut largest = [[0.0_f64; NARROW]; 2];
    let before = velocity.chunks_exact(NARROW);
    let before = before.zip(acceleration.chunks_exact(NARROW));
    let next = u.chunks_exact_mut(NARROW).zip(v.chunks_exact_mut(NARROW));
    for ((velocity, acceleration), (u, v)) in before.zip(next) {
        for i in 0..NARROW {
            (u[i], v[i]) = (scale * velocity[i], scale * acceleration[i]);
            let sizes = [u[i].abs(), v[i].abs()];
            for (largest, size) in largest.iter_mut().zip(sizes) {
                largest[i] = if size > largest[i] { size } else { largest[i] };
            }
        }
    }
    let [u, v] = largest.map(|x| x[0].max(x[1]).max(x[2].max(x[3])));
    (u, v)
}
