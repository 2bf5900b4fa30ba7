//! A closer look at one sample of contact-free motion: between points so dense that every
//! floor moves on a polynomial of degree 7.

use std::ops::Range;

use pounding_vectorised::vectorised;

use crate::polynomial::{Polynomial, difference, septic};
use crate::system::modes::{
    ContactFree, Fine, Four, Ground, Lane, Modal, ModeLanes, Quantity, WIDTH, floor_of_eight,
    lane_by_lane, restoring, transform_fours,
};

/// Derivatives of the modes, and of the floors, at one time: displacement, velocity,
/// acceleration relative to the ground, and two more.
#[derive(Debug, Clone)]
struct Point {
    modes: [Vec<Lane>; 5],
    floors: [Vec<Lane>; 4],
    /// Absolute acceleration with three derivatives, of the modes and of the floors.
    restoring: [Vec<Lane>; 4],
    absolute: [Vec<Lane>; 4],
    absolute_known: bool,
    /// Whether the first two of the modes' absolute accelerations are known.
    restoring_known: bool,
}

/// Work space.
#[derive(Debug, Clone)]
pub(super) struct CloserLook {
    start: Point,
    end: Point,
    /// Lanes of the modes that are followed.
    lanes: Range<usize>,
    step: f64,
    fresh: bool,
    /// Lanes of floors whose displacements, or accelerations, are asked for.
    wanted: [Vec<bool>; 2],
    tall: Option<Box<Tall>>,
}

/// Of tall buildings, where a few floors of all are looked at, each where it could have a peak.
#[derive(Debug, Clone)]
struct Tall {
    /// All derivatives of the modes at both ends, of displacements and of absolute accelerations,
    /// eight for every mode; and whether they are those of the present step.
    eights: [Vec<Lane>; 2],
    gathered: [bool; 2],
    /// Whether the present step is the first one.
    first: bool,
    /// What displacements, drifts and absolute accelerations depart from the cubic through values
    /// and rates at both ends by, at most.
    departures: [f64; 3],
}

impl Tall {
    fn new(lanes: usize) -> Self {
        Self {
            eights: std::array::from_fn(|_| vec![Lane::ZERO; lanes * WIDTH]),
            gathered: [false; 2],
            first: true,
            departures: [0.0; 3],
        }
    }
}

impl Point {
    fn new(lanes: usize) -> Self {
        let zeros = || vec![Lane::ZERO; lanes];
        Self {
            modes: std::array::from_fn(|_| zeros()),
            floors: std::array::from_fn(|_| zeros()),
            restoring: std::array::from_fn(|_| zeros()),
            absolute: std::array::from_fn(|_| zeros()),
            absolute_known: false,
            restoring_known: false,
        }
    }

    /// Derivatives of these lanes of the modes from their displacements and velocities by the
    /// equation of motion and its derivatives.
    fn derive(&mut self, of: (&ContactFree, &Range<usize>), ground: (f64, f64)) {
        derive(of, ground, &mut self.modes);
        (self.absolute_known, self.restoring_known) = (false, false);
    }

    /// Absolute acceleration and its rate, of the modes alone.
    fn restore(&mut self, of: (&ContactFree, &Range<usize>)) {
        if self.restoring_known {
            return;
        }
        self.restore_each(of, 0..2);
        self.restoring_known = true;
    }

    /// These derivatives of it.
    fn restore_each(
        &mut self,
        (constants, lanes): (&ContactFree, &Range<usize>),
        of: Range<usize>,
    ) {
        let modes = &constants.modes[lanes.clone()];
        for k in of {
            let [q, p] = [k, k + 1].map(|k| &self.modes[k][lanes.clone()]);
            restoring(modes, q, p, &mut self.restoring[k][lanes.clone()]);
        }
    }

    /// The same of absolute acceleration.
    fn derive_absolute(&mut self, of: (&ContactFree, &Range<usize>)) {
        self.restore(of);
        self.restore_each(of, 2..4);
        self.absolute_known = true;
    }

    /// What is to be transformed for the floors: their motion, and their absolute
    /// acceleration.
    fn fours<'a>(&'a mut self, [moving, absolute]: [&'a [bool]; 2]) -> [Four<'a>; 2] {
        let [a, b, c, d, _] = &self.modes;
        let motion = Four {
            modal: [a, b, c, d],
            floors: &mut self.floors,
            wanted: moving,
        };
        let [a, b, c, d] = &self.restoring;
        let absolute = Four {
            modal: [a, b, c, d],
            floors: &mut self.absolute,
            wanted: absolute,
        };
        [motion, absolute]
    }
}

/// Derivatives of the modes from their displacements and velocities.
#[vectorised]
fn derive(
    (constants, lanes): (&ContactFree, &Range<usize>),
    (ground, slope): (f64, f64),
    point: &mut [Vec<Lane>; 5],
) {
    let [displacement, velocity, seconds, thirds, fourths] =
        point.each_mut().map(|x| &mut x[lanes.clone()]);
    for (c, m) in constants.modes[lanes.clone()].iter().enumerate() {
        lane_by_lane();
        let (q, p) = (&displacement[c], &velocity[c]);
        [_, _, seconds[c], thirds[c], fourths[c]] = derivatives(m, (q, p), (ground, slope));
    }
}

impl CloserLook {
    pub(super) fn new(lanes: usize, tall: bool) -> Self {
        Self {
            start: Point::new(lanes),
            end: Point::new(lanes),
            lanes: 0..lanes,
            step: 0.0,
            fresh: false,
            wanted: [vec![false; lanes], vec![false; lanes]],
            tall: tall.then(|| Box::new(Tall::new(lanes))),
        }
    }

    /// Begins at a state of these lanes of the modes, to look at these functions of floors.
    pub(super) fn begin(
        &mut self,
        (lanes, modal): (Range<usize>, &Modal),
        functions: impl Iterator<Item = (Quantity, usize)>,
    ) {
        let [floors, absolute] = &mut self.wanted;
        floors.fill(false);
        absolute.fill(false);
        for (quantity, floor) in functions {
            match quantity {
                Quantity::Displacement => floors[floor / WIDTH] = true,
                Quantity::Drift => {
                    floors[floor / WIDTH] = true;
                    floors[floor.saturating_sub(1) / WIDTH] = true;
                }
                Quantity::Acceleration => absolute[floor / WIDTH] = true,
                // A row on the modes.
                Quantity::SectionForce => {}
            }
        }
        let from = [&modal.displacement, &modal.velocity];
        for (to, from) in self.end.modes.iter_mut().zip(from) {
            to[lanes.clone()].copy_from_slice(&from[lanes.clone()]);
        }
        self.lanes = lanes;
        self.fresh = true;
    }

    /// Goes on by one fine step.
    pub(super) fn advance(&mut self, constants: &ContactFree, fine: &Fine, ground: Ground) {
        let fresh = std::mem::take(&mut self.fresh);
        let by_eights = self.tall.is_some() && fine.parts == 1;
        if fresh && !by_eights {
            let of = (constants, &self.lanes);
            self.end.derive(of, (ground.start, ground.slope));
        }
        std::mem::swap(&mut self.start, &mut self.end);
        let lanes = &self.lanes;
        let of = (constants, lanes);
        let [from, from_rate, ..] = self.start.modes.each_ref().map(|x| &x[lanes.clone()]);
        let [to, to_rate, ..] = self.end.modes.each_mut().map(|x| &mut x[lanes.clone()]);
        // What is not cut has the constants of the sample, which are in the cache.
        let modes = match fine.parts {
            1 => &constants.modes[lanes.clone()],
            _ => &fine.modes[lanes.clone()],
        };
        if let Some(tall) = self.tall.as_deref_mut().filter(|_| by_eights) {
            self.step = fine.step;
            let wanted = self.wanted.each_ref().map(|lanes| lanes.contains(&true));
            step_in_eights(modes, ground, [from, from_rate], (tall, lanes, wanted));
            tall.gathered = wanted;
            return;
        }
        step(modes, ground, [from, from_rate], [to, to_rate]);
        self.end.derive(of, (ground.end, ground.slope));
        self.step = fine.step;
        let [moving, absolute] = self.wanted.each_ref().map(Vec::as_slice);
        let shapes = &constants.shapes;
        if let Some(tall) = &mut self.tall {
            (tall.gathered, tall.first) = ([false; 2], fresh);
            departures(of, (&self.start.modes, fine.step), &mut tall.departures);
            return;
        }
        if !fresh {
            let [motion, _] = self.end.fours([moving, absolute]);
            transform_fours(shapes, &mut [motion]);
            return;
        }
        // Both ends in one pass, with the accelerations that are sure to be asked for.
        let accelerations = absolute.contains(&true);
        if accelerations {
            self.start.derive_absolute(of);
            self.end.derive_absolute(of);
        }
        let [first, second] = self.start.fours([moving, absolute]);
        let [third, fourth] = self.end.fours([moving, absolute]);
        if accelerations {
            transform_fours(shapes, &mut [first, second, third, fourth]);
        } else {
            transform_fours(shapes, &mut [first, third]);
        }
    }

    /// Whether a floor's function could exceed this value over one of several fine steps, by its
    /// values and rates at both ends: those at the end are left in `last`, which has those at the
    /// start from the second step on. Where all floors are worked out together there is nothing to
    /// be spared.
    pub(super) fn could_exceed(
        &mut self,
        constants: &ContactFree,
        (quantity, floor): (Quantity, usize),
        last: &mut [f64; 2],
        value: f64,
    ) -> bool {
        let Some(tall) = &self.tall else {
            return true;
        };
        let rows = &constants.rows;
        let [displacement, drift, acceleration] = tall.departures;
        let (row, departure) = match quantity {
            Quantity::Displacement => (&rows.floors[floor], displacement),
            Quantity::Drift => (&rows.drifts[floor], drift),
            Quantity::Acceleration => (&rows.floors[floor], acceleration),
            // Tall buildings have none.
            Quantity::SectionForce => return true,
        };
        let of = (constants, &self.lanes);
        let values = |point: &mut Point| {
            let [x, rate] = if quantity == Quantity::Acceleration {
                point.restore(of);
                [&point.restoring[0], &point.restoring[1]]
            } else {
                [&point.modes[0], &point.modes[1]]
            };
            row.dot_two([x, rate])
        };
        let [a, out] = if tall.first {
            values(&mut self.start)
        } else {
            *last
        };
        let [b, back] = values(&mut self.end);
        *last = [b, back];
        let third = self.step / 3.0;
        let hull = a.abs().max(b.abs());
        let hull = hull
            .max((a + third * out).abs())
            .max((b - third * back).abs());
        // What is no number is looked at.
        let below = hull + departure <= value;
        !below
    }

    /// Absolute accelerations at both ends, where they are not known.
    fn derive_absolute(&mut self, constants: &ContactFree) {
        let of = (constants, &self.lanes);
        if let Some(tall) = &mut self.tall {
            if !tall.gathered[1] {
                for point in [&mut self.start, &mut self.end] {
                    if !point.absolute_known {
                        point.derive_absolute(of);
                    }
                }
                let [a, b, c, d] = &self.start.restoring;
                let [e, f, g, h] = &self.end.restoring;
                gather_eights(&self.lanes, [a, b, c, d, e, f, g, h], &mut tall.eights[1]);
                tall.gathered[1] = true;
            }
            return;
        }
        let wanted = [&self.wanted[0], &self.wanted[1]].map(Vec::as_slice);
        for point in [&mut self.start, &mut self.end] {
            if !point.absolute_known {
                point.derive_absolute(of);
                let [_, absolute] = point.fours(wanted);
                transform_fours(&constants.shapes, &mut [absolute]);
            }
        }
    }

    /// Displacement of a floor.
    fn polynomial(&mut self, constants: &ContactFree, floor: usize) -> Polynomial {
        if let Some(tall) = &mut self.tall {
            if !tall.gathered[0] {
                let [a, b, c, d, _] = &self.start.modes;
                let [e, f, g, h, _] = &self.end.modes;
                gather_eights(&self.lanes, [a, b, c, d, e, f, g, h], &mut tall.eights[0]);
                tall.gathered[0] = true;
            }
            let eight = floor_of_eight(&constants.shapes, &tall.eights[0], floor);
            return self.through(eight);
        }
        let at = |point: &Point| self.scaled(&point.floors, floor);
        septic(at(&self.start), at(&self.end))
    }

    /// The function with these derivatives at both ends.
    fn through(&self, eight: Lane) -> Polynomial {
        let end = |first: usize| {
            let mut factor = 1.0;
            std::array::from_fn(|k| {
                let value = factor * eight[first + k];
                factor *= self.step;
                value
            })
        };
        septic(end(0), end(WIDTH / 2))
    }

    /// Derivatives with respect to theta.
    fn scaled(&self, derivatives: &[Vec<Lane>; 4], floor: usize) -> [f64; 4] {
        let mut factor = 1.0;
        std::array::from_fn(|k| {
            let value = factor * derivatives[k][floor / WIDTH][floor % WIDTH];
            factor *= self.step;
            value
        })
    }

    /// A floor's function over the fine step: displacement, drift or absolute
    /// acceleration; or the force in a section.
    pub(super) fn function(
        &mut self,
        constants: &ContactFree,
        quantity: Quantity,
        floor: usize,
    ) -> Polynomial {
        match quantity {
            Quantity::Displacement => self.polynomial(constants, floor),
            Quantity::Drift => {
                let below = floor.checked_sub(1);
                match below.filter(|b| constants.building[*b] == constants.building[floor]) {
                    None => self.polynomial(constants, floor),
                    Some(b) => {
                        let [upper, lower] = [floor, b].map(|i| self.polynomial(constants, i));
                        difference(&upper, &lower)
                    }
                }
            }
            Quantity::Acceleration => {
                self.derive_absolute(constants);
                if let Some(tall) = &self.tall {
                    let eight = floor_of_eight(&constants.shapes, &tall.eights[1], floor);
                    return self.through(eight);
                }
                let at = |point: &Point| self.scaled(&point.absolute, floor);
                septic(at(&self.start), at(&self.end))
            }
            Quantity::SectionForce => {
                let row = &constants.rows.sections[floor];
                let at = |point: &Point| {
                    let mut factor = 1.0;
                    std::array::from_fn(|k| {
                        let value = factor * row.dot(&point.modes[k]);
                        factor *= self.step;
                        value
                    })
                };
                septic(at(&self.start), at(&self.end))
            }
        }
    }
}

/// Eight values for every mode, one after another.
fn gather_eights(lanes: &Range<usize>, values: [&Vec<Lane>; WIDTH], eights: &mut [Lane]) {
    let values = values.map(|values| &values[lanes.clone()]);
    let eights = &mut eights[lanes.start * WIDTH..lanes.end * WIDTH];
    for (c, eights) in eights.as_chunks_mut::<WIDTH>().0.iter_mut().enumerate() {
        gather_eight(&values.map(|values| values[c]), eights);
    }
}

/// The same of eight modes. (Not by wide registers, whose gathering loads take ten times as long.)
#[inline(never)]
fn gather_eight(values: &[Lane; WIDTH], eights: &mut [Lane; WIDTH]) {
    for (l, eight) in eights.iter_mut().enumerate() {
        *eight = Lane(values.each_ref().map(|value| value[l]));
    }
}

/// Derivatives of displacement (0), and of absolute acceleration (1), where they are wanted, at
/// both ends of a step from these displacements and velocities of some lanes of the modes. They go
/// from register to register, and have the bits of one function after another.
#[vectorised]
fn step_in_eights(
    modes: &[ModeLanes],
    ground: Ground,
    [displacement, velocity]: [&[Lane]; 2],
    (tall, lanes, wanted): (&mut Tall, &Range<usize>, [bool; 2]),
) {
    let eights = lanes.start * WIDTH..lanes.end * WIDTH;
    let [moving, absolute] = tall.eights.each_mut().map(|of| &mut of[eights.clone()]);
    let out = moving.as_chunks_mut::<WIDTH>().0.iter_mut();
    let out = out.zip(absolute.as_chunks_mut::<WIDTH>().0);
    let modes = modes.iter().zip(displacement).zip(velocity);
    for (((m, q), p), (moving, absolute)) in modes.zip(out) {
        let after = |k: &[Lane; 4]| {
            Lane::from_fn(|l| {
                k[0][l] * q[l] + k[1][l] * p[l] + (k[2][l] * ground.start + k[3][l] * ground.end)
            })
        };
        let ends = [
            (*q, *p, ground.start),
            (after(&m.displacement), after(&m.velocity), ground.end),
        ];
        let [mut motion, mut forces] = [[Lane::ZERO; WIDTH]; 2];
        for (end, (q, p, acceleration)) in ends.into_iter().enumerate() {
            let derivatives = derivatives(m, (&q, &p), (acceleration, ground.slope));
            let first = end * WIDTH / 2;
            motion[first..first + WIDTH / 2].copy_from_slice(&derivatives[..WIDTH / 2]);
            for k in 0..WIDTH / 2 {
                let (x, v) = (&derivatives[k], &derivatives[k + 1]);
                for l in 0..WIDTH {
                    forces[first + k][l] = -(m.damping[l] * v[l] + m.stiffness[l] * x[l]);
                }
            }
        }
        if wanted[0] {
            gather_eight(&motion, moving);
        }
        if wanted[1] {
            gather_eight(&forces, absolute);
        }
    }
}

/// Displacement and velocity of eight modes with three more derivatives, by the equation of motion
/// and its derivatives.
#[inline(always)]
fn derivatives(m: &ModeLanes, (q, p): (&Lane, &Lane), (ground, slope): (f64, f64)) -> [Lane; 5] {
    let mut out = [*q, *p, Lane::ZERO, Lane::ZERO, Lane::ZERO];
    for l in 0..WIDTH {
        let (damping, gamma) = (m.damping[l], m.participation[l]);
        let stiffness = m.circular_frequency[l] * m.circular_frequency[l];
        let second = -damping * p[l] - stiffness * q[l] - gamma * ground;
        let third = -damping * second - stiffness * p[l] - gamma * slope;
        out[2][l] = second;
        out[3][l] = third;
        out[4][l] = -damping * third - stiffness * second;
    }
    out
}

/// What floors' functions depart from their cubics by over a step of this length (s) from these
/// modes on: `h^4 / 384` times a bound of their fourth derivatives, which swing freely
/// ([`super::lane_candidates`]).
#[vectorised]
fn departures(
    (constants, lanes): (&ContactFree, &Range<usize>),
    (start, step): (&[Vec<Lane>; 5], f64),
    out: &mut [f64; 3],
) {
    let [_, _, seconds, thirds, fourths] = start;
    let mut sums = [Lane::ZERO; 3];
    let rows = &constants.rows;
    for c in lanes.clone() {
        let m = &constants.modes[c];
        let (size, drift_size) = (&rows.size[c], &rows.drift_size[c]);
        for l in 0..WIDTH {
            let (damping, omega) = (m.damping[l], m.circular_frequency[l]);
            let (second, third, fourth) = (seconds[c][l], thirds[c][l], fourths[c][l]);
            let fifth = -(damping * fourth + omega * omega * third);
            let factor = omega + damping;
            let motion = factor * (third.abs() + omega * second.abs());
            sums[0][l] += size[l] * motion;
            sums[1][l] += drift_size[l] * motion;
            sums[2][l] += size[l] * (factor * (fifth.abs() + omega * fourth.abs()));
        }
    }
    let span = step.powi(4) / 384.0;
    *out = sums.map(|sum| span * sum.0.iter().sum::<f64>());
}

/// Displacements and velocities of all modes after a step.
#[vectorised]
fn step(modes: &[ModeLanes], ground: Ground, from: [&[Lane]; 2], to: [&mut [Lane]; 2]) {
    let [displacement, velocity] = to;
    for (c, m) in modes.iter().enumerate() {
        lane_by_lane();
        let (q, p) = (&from[0][c], &from[1][c]);
        let after = |k: &[Lane; 4]| {
            Lane::from_fn(|l| {
                k[0][l] * q[l] + k[1][l] * p[l] + (k[2][l] * ground.start + k[3][l] * ground.end)
            })
        };
        (displacement[c], velocity[c]) = (after(&m.displacement), after(&m.velocity));
    }
}
