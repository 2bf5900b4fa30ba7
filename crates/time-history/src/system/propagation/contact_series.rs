//! Taylor series of all buildings together with closed contacts whose laws are affine, over
//! steps of several radians of the fastest mode.

use pounding_vectorised::vectorised;

use super::building::Building;
use super::product::{NARROW, add_product, multiply, padded};
use super::{BOUNDED, Ends, ORDERS};
use crate::system::{Segment, System};

/// Terms at most, and at least: as many as derivatives have bounds.
const MOST: usize = 44;
const FEWEST: usize = BOUNDED.end;
/// Terms smaller than this (m, m/s) end the series.
const NEGLIGIBLE: (f64, f64) = (1.0e-18, 1.0e-17);
/// Maximum product of rate and step: terms then stay below ten times what they sum to, and the
/// last of [`RULES`] suffices.
const REACH: f64 = 3.6;

/// A rule of Gauss, for works over a step.
struct Rule {
    /// Maximum product of rate and step for an error of less than 1e-13 in the work of the fastest
    /// motion: with `n` points it is `(n!)^4 / ((2 n + 1) (2 n)!^3) z^(2 n)` for twice that
    /// product.
    reach: f64,
    /// Points in a step from zero to one as powers of their places, with their weights.
    points: &'static [(f64, SeriesTerms)],
}

/// From the one with the fewest points on.
static RULES: [Rule; 3] = [
    Rule {
        reach: 0.8,
        points: &points::<3, 6>([
            (0.238_619_186_083_196_9, 0.467_913_934_572_691_04),
            (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
            (0.932_469_514_203_152, 0.171_324_492_379_170_36),
        ]),
    },
    Rule {
        reach: 2.0,
        points: &points::<4, 8>([
            (0.183_434_642_495_649_8, 0.362_683_783_378_361_96),
            (0.525_532_409_916_329, 0.313_706_645_877_887_27),
            (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
            (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
        ]),
    },
    Rule {
        reach: REACH,
        points: &points::<5, 10>([
            (0.148_874_338_981_631_2, 0.295_524_224_714_752_87),
            (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
            (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
            (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
            (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
        ]),
    },
];

/// Points of a rule from half of them on (-1, 1).
const fn points<const HALF: usize, const ALL: usize>(
    half: [(f64, f64); HALF],
) -> [(f64, SeriesTerms); ALL] {
    let mut all = [(0.0, [1.0; MOST + 1]); ALL];
    let mut place = 0;
    while place < ALL {
        let sign = if place.is_multiple_of(2) { -1.0 } else { 1.0 };
        let (at, weight) = half[place / 2];
        let theta = 0.5 * (1.0 + sign * at);
        all[place].0 = 0.5 * weight;
        let mut k = 1;
        while k <= MOST {
            all[place].1[k] = theta * all[place].1[k - 1];
            k += 1;
        }
        place += 1;
    }
    all
}

/// What the terms of a series are multiplied by in its derivatives at the end, by order and
/// term.
static FALLING: [[f64; MOST + 1]; ORDERS] = {
    let mut all = [[1.0; MOST + 1]; ORDERS];
    let mut order = 1;
    while order < ORDERS {
        let mut k = 0;
        while k <= MOST {
            all[order][k] = all[order - 1][k] * (k as f64 - (order - 1) as f64);
            k += 1;
        }
        order += 1;
    }
    all
};

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
    /// Maximum eigenvalues of `M^-1 K` (1/s2) and `M^-1 C` (1/s) of the buildings.
    stiffest: f64,
    damped: f64,
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
    /// By place at the start of the step: loads and their slopes, then the ground's acceleration
    /// and its slope.
    loads: [Vec<f64>; 2],
    ground: [Vec<f64>; 2],
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
            stiffest: buildings.iter().map(|b| b.stiffest).fold(0.0, f64::max),
            damped: buildings.iter().map(|b| b.damped).fold(0.0, f64::max),
            length: 0.0,
            last: 0,
            led: false,
            displacement: vec![0.0; (MOST + 1) * n],
            velocity: vec![0.0; (MOST + 1) * n],
            factors: vec![0.0; MOST + 1],
            sum: vec![0.0; n],
            both: vec![0.0; 2 * n],
            acceleration: vec![0.0; n],
            loads: [vec![0.0; n], vec![0.0; n]],
            ground: [vec![0.0; n], vec![0.0; n]],
            derived: vec![0.0; BOUNDED.end * n],
            force: vec![0.0; n],
            dofs,
            places: n,
            place_of,
        }
    }

    /// Longest step (s).
    pub(crate) fn longest(&self, system: &System) -> f64 {
        REACH / self.rate(system)
    }

    /// Rate of the fastest motion at most (1/s). An eigenvalue `s` of the motion solves `s^2 + c s + w = 0` with the Rayleigh
    /// quotients of its vector: `|s|` is `sqrt(w)`, or at most `c`.
    fn rate(&self, system: &System) -> f64 {
        let (mut squares, mut damping) = (self.stiffest, self.damped);
        for contact in &self.contacts {
            let mass = system.levels()[contact.level].effective_mass;
            squares += contact.stiffness / mass;
            damping += contact.dashpot / mass;
        }
        squares.sqrt().max(damping)
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
        let all = self.dofs.len();
        self.length = length;
        self.led = false;
        for (k, i) in &self.dofs {
            self.displacement[*k] = state[*i];
            self.velocity[*k] = state[all + *i];
        }
        self.take_loads(system, (segment, tau));
        let forces = Forces {
            buildings,
            contacts: &self.contacts,
            rows: &self.rows,
            loads: self.loads.each_ref().map(Vec::as_slice),
        };
        let terms = (
            self.displacement.as_mut_slice(),
            self.velocity.as_mut_slice(),
        );
        let last = expand(
            &forces,
            (self.places, length),
            &mut self.acceleration,
            terms,
        );
        self.last = last.unwrap_or(self.last);
        last.is_some()
    }

    /// Takes loads and ground at the start of a step.
    fn take_loads(&mut self, system: &System, (segment, tau): (&Segment, f64)) {
        let (at, pushed) = (segment.ground(tau), !system.forces().is_empty());
        for (place, i) in &self.dofs {
            let load = [system.load_on(*i, at), system.load_slope_on(*i, segment)];
            let ground = match pushed {
                true => [
                    system.ground_on(*i, at),
                    system.ground_slope_on(*i, segment),
                ],
                false => load,
            };
            self.loads[0][*place] = load[0];
            self.loads[1][*place] = load[1];
            (self.ground[0][*place], self.ground[1][*place]) = (ground[0], ground[1]);
        }
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
    pub(super) fn lead(&mut self, (system, buildings): (&System, &[Building]), ends: &mut Ends) {
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
            (0.0, &ends.start, &mut ends.absolute_start),
            (h, &ends.end, &mut ends.absolute_end),
        ];
        let wanted = if with_start { 0 } else { 1 };
        for (since, relative, absolute) in ends_of_step.into_iter().skip(wanted) {
            for (place, i) in self.dofs.iter().filter(|(_, i)| *i < system.with_mass()) {
                let (ground, slope) = (self.ground[0][*place], self.ground[1][*place]);
                absolute[0][*i] = relative[2][*i] + (ground + slope * since);
                absolute[1][*i] = relative[3][*i] + slope;
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
        let (first, others) = self.derived.split_at_mut(n);
        first.copy_from_slice(&self.displacement[..n]);
        let orders = others
            .chunks_exact_mut(n)
            .zip(self.velocity.chunks_exact(n));
        for (order, (out, terms)) in (1..BOUNDED.end).zip(orders) {
            for (out, term) in out.iter_mut().zip(terms) {
                *out = factor * term;
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
            let factors = &FALLING[lower][..=self.last];
            multiply(terms, n, factors, &mut self.sum);
            let scale = h.powi(-(lower as i32));
            for (k, i) in &self.dofs {
                ends.end[order][*i] = scale * self.sum[*k];
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
            let own = first..first + building.mass.len();
            let (y, x) = (&y[own.clone()], &x[own.clone()]);
            let of_building = energies(building, (y, x), &mut self.force);
            (kinetic, strain) = (kinetic + of_building.0, strain + of_building.1);
            first = own.end;
        }
        for contact in &self.contacts {
            let row = self.rows[contact.level].iter();
            let delta: f64 = row.map(|e| e.weight * y[e.place]).sum();
            strain += contact.stiffness * delta * delta;
        }
        (kinetic, strain)
    }

    /// Works over the step, into `ends` and [`ContactSeries::contacts`].
    pub(super) fn works(&mut self, (system, buildings): (&System, &[Building]), ends: &mut Ends) {
        let (n, h) = (self.places, self.length);
        (ends.input, ends.viscous) = (0.0, 0.0);
        for (k, factor) in self.factors[..=self.last].iter_mut().enumerate() {
            *factor = h / (k as f64 + 1.0);
        }
        let integral = &mut self.sum;
        multiply(&self.displacement, n, &self.factors[..=self.last], integral);
        let (mass, [loads, slopes]) = (system.mass(), &self.loads);
        for (k, i) in self.dofs.iter().filter(|(_, i)| *i < system.with_mass()) {
            let (load, slope) = (loads[*k], slopes[*k]);
            let (before, after) = (ends.start[0][*i], ends.end[0][*i]);
            let moved = after * (load + slope * h) - before * load - slope * integral[*k];
            ends.input -= mass[*i] * moved;
        }
        let grounded = self.is_grounded();
        // With the contacts, which make the motion fast.
        let reach = self.rate(system) * h;
        let [.., most] = &RULES;
        let suffices = |rule: &&Rule| reach <= rule.reach;
        let rule = RULES.iter().find(suffices).unwrap_or(most);
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
        for (weight, powers) in rule.points {
            let (weight, powers) = (h * weight, &powers[..=self.last]);
            let (u, v) = self.both.split_at_mut(n);
            let terms = (self.velocity.as_slice(), n, powers);
            ends.viscous += weight * viscous_power(buildings, terms, v, &mut self.force);
            if grounded {
                multiply(&self.displacement, n, powers, u);
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
        self.contacts = contacts;
    }
}

/// What accelerates the coordinates by one term of the motion.
struct Forces<'a> {
    buildings: &'a [Building],
    contacts: &'a [AffineContact],
    rows: &'a [Vec<Entry>],
    /// Values at the start and slopes: they act on the first two terms alone.
    loads: [&'a [f64]; 2],
}

/// Expands displacements and velocities, whose first terms are given, over a step of this length
/// (s). Returns the number of the last term if they have an end.
#[vectorised]
fn expand(
    forces: &Forces<'_>,
    (n, length): (usize, f64),
    acceleration: &mut [f64],
    (displacement, velocity): (&mut [f64], &mut [f64]),
) -> Option<usize> {
    for k in 1..=MOST {
        let (u, u_next) = displacement[(k - 1) * n..(k + 1) * n].split_at_mut(n);
        let (v, v_next) = velocity[(k - 1) * n..(k + 1) * n].split_at_mut(n);
        let step = (k, length);
        next_terms(forces, step, (u, v), acceleration, (u_next, v_next));
        if k >= FEWEST && largest(v_next) < NEGLIGIBLE.1 && largest(u_next) < NEGLIGIBLE.0 {
            return Some(k);
        }
    }
    None
}

/// The terms of this number of displacements and velocities from those before.
#[inline(always)]
fn next_terms(
    forces: &Forces<'_>,
    (k, length): (usize, f64),
    (u, v): (&[f64], &[f64]),
    acceleration: &mut [f64],
    (u_next, v_next): (&mut [f64], &mut [f64]),
) {
    let scale = length / k as f64;
    let mut first = 0;
    for building in forces.buildings {
        let (count, rows) = (building.dofs.len(), building.mass.len());
        let own = [&u[first..][..count], &v[first..][..count]];
        let out = &mut acceleration[first..][..rows];
        building.restoring.multiply_in_turn(own, out);
        first += rows;
    }
    acceleration[first..].fill(0.0);
    for contact in forces.contacts {
        let row = &forces.rows[contact.level];
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
    if let Some(loads) = forces.loads.get(k - 1) {
        let factor = if k == 1 { 1.0 } else { length };
        for (acceleration, load) in acceleration.iter_mut().zip(*loads) {
            *acceleration -= factor * load;
        }
    }
    let u_next = u_next.as_chunks_mut::<NARROW>().0;
    let v_next = v_next.as_chunks_mut::<NARROW>().0;
    let n = u_next.len();
    let (v_next, v) = (&mut v_next[..n], &v.as_chunks::<NARROW>().0[..n]);
    let acceleration = &acceleration.as_chunks::<NARROW>().0[..n];
    for k in 0..n {
        u_next[k] = scaled(scale, v[k]);
        v_next[k] = scaled(scale, acceleration[k]);
    }
}

/// A block of values times a factor.
#[inline(always)]
fn scaled(factor: f64, mut block: [f64; NARROW]) -> [f64; NARROW] {
    for i in 0..NARROW {
        block[i] *= factor;
    }
    block
}

/// The largest magnitude.
#[inline(always)]
fn largest(values: &[f64]) -> f64 {
    let mut largest = [0.0_f64; NARROW];
    for block in values.as_chunks::<NARROW>().0 {
        for i in 0..NARROW {
            let size = block[i].abs();
            largest[i] = if size > largest[i] { size } else { largest[i] };
        }
    }
    let [a, b, c, d] = largest;
    a.max(b).max(c.max(d))
}

/// `x' M x` and `y' K y` of a building; all are filled up with zeros.
#[vectorised]
fn energies(building: &Building, (y, x): (&[f64], &[f64]), force: &mut [f64]) -> (f64, f64) {
    let force = &mut force[..y.len()];
    building
        .stiffness
        .multiply_inline(&y[..building.dofs.len()], force);
    let (mut kinetic, mut strain) = ([0.0; NARROW], [0.0; NARROW]);
    let blocks = building.mass.as_chunks::<NARROW>().0.iter();
    let motion = x
        .as_chunks::<NARROW>()
        .0
        .iter()
        .zip(y.as_chunks::<NARROW>().0);
    let blocks = blocks.zip(motion).zip(force.as_chunks::<NARROW>().0);
    for ((mass, (x, y)), force) in blocks {
        for i in 0..NARROW {
            kinetic[i] += mass[i] * x[i] * x[i];
            strain[i] += y[i] * force[i];
        }
    }
    let sum = |of: [f64; NARROW]| of[0] + of[1] + (of[2] + of[3]);
    (sum(kinetic), sum(strain))
}

/// Velocities, filled up with zeros, from so many terms in blocks and the powers of the time; and the
/// power of the damping (W).
#[vectorised]
fn viscous_power(
    buildings: &[Building],
    (terms, n, powers): (&[f64], usize, &[f64]),
    velocity: &mut [f64],
    force: &mut [f64],
) -> f64 {
    velocity.fill(0.0);
    add_product(terms, n, powers, velocity);
    let (mut sums, mut first) = ([0.0; NARROW], 0);
    for building in buildings {
        let own = &velocity[first..][..building.mass.len()];
        let force = &mut force[..own.len()];
        building
            .damping
            .multiply_inline(&own[..building.dofs.len()], force);
        let blocks = own.as_chunks::<NARROW>().0.iter();
        for (v, f) in blocks.zip(force.as_chunks::<NARROW>().0) {
            for i in 0..NARROW {
                sums[i] += v[i] * f[i];
            }
        }
        first += own.len();
    }
    sums[0] + sums[1] + (sums[2] + sums[3])
}
