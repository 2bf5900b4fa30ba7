//! One step of the explicit pair of order 8(5,3) on the modes with contacts of any law.

use pounding_gap_element::PowerLaw;
use pounding_runge_kutta::tableau::{ERROR_3, ERROR_5, NODES, ROWS, STAGES, WEIGHTS};
use pounding_vectorised::vectorised;

use super::clock::Clock;
use super::point::{Point, TouchPoint};
use super::series::Works;
use super::touch::Touch;
use crate::system::System;
use crate::system::modes::{ContactFree, Lane, LevelRows, WIDTH, add, mul, scale, total};

/// Sizes (m, m/s) below which displacements and velocities are controlled absolutely.
const SIZE: [f64; 2] = [1.0e-2, 1.0e-1];

/// What a step needs to know beside its start.
#[derive(Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub constants: &'a ContactFree,
    pub rows: &'a LevelRows,
    pub system: &'a System,
    pub touches: &'a [Touch],
    /// Ground acceleration at the start of the step (m/s2) and its slope (m/s3).
    pub ground: (f64, f64),
    pub tolerance: f64,
}

/// Work space of the pair.
#[derive(Debug, Clone)]
pub(crate) struct Pair {
    lanes: usize,
    /// Derivatives of displacements, then of velocities, with respect to `s`, stage after
    /// stage.
    stages: Vec<Lane>,
    /// Displacements, then velocities.
    trial: Vec<Lane>,
    base: Vec<Lane>,
    pub start: Point,
    pub end: Point,
    pub works: Works,
    /// Work on every closed level (J), and impulse (N s).
    pub contact_works: Vec<(f64, f64)>,
    pub evaluations: u64,
    /// Stands in for the end, and for the works on levels, while a part of the step is looked at.
    part: Point,
    part_works: Vec<(f64, f64)>,
}

impl Pair {
    pub(crate) fn new(lanes: usize, levels: usize) -> Self {
        let zeros = |count: usize| vec![Lane::ZERO; count];
        Self {
            lanes,
            stages: zeros(2 * lanes * STAGES),
            trial: zeros(2 * lanes),
            base: zeros(2 * lanes),
            start: Point::new(lanes, levels),
            end: Point::new(lanes, levels),
            works: Works::default(),
            contact_works: Vec::with_capacity(levels),
            evaluations: 0,
            part: Point::new(lanes, levels),
            part_works: Vec::with_capacity(levels),
        }
    }

    /// A closed level inside the step, by a step of its own to there: what interpolates between
    /// the ends of a long step is less accurate than the step.
    pub(crate) fn inside(
        &mut self,
        scene: &Scene<'_>,
        clock: &Clock,
        (theta, k): (f64, usize),
    ) -> TouchPoint {
        let (time, works) = (clock.offset(theta), self.works);
        std::mem::swap(&mut self.end, &mut self.part);
        std::mem::swap(&mut self.contact_works, &mut self.part_works);
        self.step(scene, &clock.until(time));
        self.derive_end(scene, time);
        let found = self.end.touches[k];
        self.works = works;
        std::mem::swap(&mut self.end, &mut self.part);
        std::mem::swap(&mut self.contact_works, &mut self.part_works);
        found
    }

    /// Takes a step from `start`, whose accelerations hold, to `end`, whose displacements
    /// and velocities it sets. Returns the error over what is allowed.
    pub(crate) fn step(&mut self, scene: &Scene<'_>, clock: &Clock) -> f64 {
        self.evaluations += STAGES as u64 - 1;
        let lanes = self.lanes;
        self.base[..lanes].copy_from_slice(&self.start.motion[0]);
        self.base[lanes..].copy_from_slice(&self.start.motion[1]);
        step(self, scene, clock)
    }
}

/// Stage weights of the solution.
const SOLUTION: [f64; STAGES] = {
    let mut weights = [0.0; STAGES];
    let mut i = 0;
    while i < WEIGHTS.len() {
        weights[WEIGHTS[i].0] = WEIGHTS[i].1;
        i += 1;
    }
    weights
};

#[vectorised]
fn step(pair: &mut Pair, scene: &Scene<'_>, clock: &Clock) -> f64 {
    match pair.lanes {
        1 => step_in_place::<1>(pair, scene, clock),
        2 => step_in_place::<2>(pair, scene, clock),
        3 => step_in_place::<3>(pair, scene, clock),
        4 => step_in_place::<4>(pair, scene, clock),
        _ => step_of_many(pair, scene, clock),
    }
}

/// A closed level as the stages see it: its row is read once, and so is its law where that is
/// one in powers.
#[derive(Clone, Copy)]
struct Level<const LANES: usize> {
    row: [Lane; LANES],
    law: Option<PowerLaw>,
}

/// The law in powers of a closed level, if it has one.
fn power_law(scene: &Scene<'_>, touch: &Touch) -> Option<PowerLaw> {
    let model = &scene.system.levels()[touch.level].model;
    model.power_law(&touch.contact.collision, touch.contact.phase)
}

/// Force (N) of a closed level.
#[inline(always)]
fn force(
    scene: &Scene<'_>,
    (touch, law): (&Touch, &Option<PowerLaw>),
    (delta, velocity): (f64, f64),
) -> f64 {
    match law {
        Some(law) if delta > 0.0 => law.force(delta, velocity),
        _ => {
            let level = &scene.system.levels()[touch.level];
            touch.contact.force(level, delta, velocity).value
        }
    }
}

/// Closed levels whose rows are kept beside the stages.
const AT_HAND: usize = 4;

/// For a few lanes of modes, with the stages in place.
#[inline(always)]
fn step_in_place<const LANES: usize>(pair: &mut Pair, scene: &Scene<'_>, clock: &Clock) -> f64 {
    let touches = scene.touches;
    let stages = pair.stages.as_chunks_mut::<LANES>().0.first_chunk_mut();
    let Some(stages) = stages.filter(|_| touches.len() <= AT_HAND) else {
        return step_of_many(pair, scene, clock);
    };
    let mut levels = [Level {
        row: [Lane::ZERO; LANES],
        law: None,
    }; AT_HAND];
    for (level, touch) in levels.iter_mut().zip(touches) {
        level.row = scene.rows.levels[touch.level].spread::<LANES>();
        level.law = power_law(scene, touch);
    }
    let levels = &levels[..touches.len()];
    let span = clock.span();
    let modes = &scene.constants.modes[..LANES];
    let (mut q0, mut p0) = ([Lane::ZERO; LANES], [Lane::ZERO; LANES]);
    q0.copy_from_slice(&pair.base[..LANES]);
    p0.copy_from_slice(&pair.base[LANES..]);
    let (mut q, mut p) = (q0, p0);
    let mut works = [(0.0, 0.0); AT_HAND];
    let (mut input, mut viscous) = (Lane::ZERO, Lane::ZERO);
    for stage in 0..STAGES {
        let theta = NODES[stage];
        let rate = clock.rate(theta);
        let ground = scene.ground.0 + scene.ground.1 * clock.offset(theta);
        if stage > 0 {
            (q, p) = combine(stages, ROWS[stage], (&q0, &p0), span);
        }
        let weight = SOLUTION[stage] * span * rate;
        let [mut speeds, mut accelerations] = [[Lane::ZERO; LANES]; 2];
        for c in 0..LANES {
            let m = &modes[c];
            let (dashpot, spring) = (mul(m.damping, p[c]), mul(m.stiffness, q[c]));
            let load = scale(ground, m.participation);
            accelerations[c] = scale(-rate, add(add(dashpot, spring), load));
            speeds[c] = scale(rate, p[c]);
            if SOLUTION[stage] != 0.0 {
                input = add(input, scale(-weight, mul(load, p[c])));
                viscous = add(viscous, scale(weight, mul(dashpot, p[c])));
            }
        }
        for ((level, touch), works) in levels.iter().zip(touches).zip(&mut works) {
            let (mut closing, mut approach) = (Lane::ZERO, Lane::ZERO);
            for c in 0..LANES {
                closing = add(closing, mul(level.row[c], q[c]));
                approach = add(approach, mul(level.row[c], p[c]));
            }
            let (delta, velocity) = (total(&closing) - touch.width, total(&approach));
            let force = force(scene, (touch, &level.law), (delta, velocity));
            for c in 0..LANES {
                accelerations[c] = add(accelerations[c], scale(-rate * force, level.row[c]));
            }
            works.0 += weight * force * velocity;
            works.1 += weight * force;
        }
        stages[2 * stage] = speeds;
        stages[2 * stage + 1] = accelerations;
    }
    (q, p) = combine(stages, &WEIGHTS, (&q0, &p0), span);
    pair.end.motion[0].copy_from_slice(&q);
    pair.end.motion[1].copy_from_slice(&p);
    pair.works = Works {
        input: total(&input),
        viscous: total(&viscous),
    };
    pair.contact_works.clear();
    pair.contact_works
        .extend_from_slice(&works[..touches.len()]);
    let mut largest = Lane::ZERO;
    for c in 0..LANES {
        for (quantity, (before, after)) in [(q0[c], q[c]), (p0[c], p[c])].into_iter().enumerate() {
            let size = (scene.constants.rows.size[c], SIZE[quantity]);
            let of = |j: usize| stages[2 * j + quantity][c];
            let allowed = (scene.tolerance, size);
            error(&mut largest, of, (before, after), allowed, span);
        }
    }
    greatest(&largest)
}

/// `base + step * sum(weight * stage)`.
#[inline(always)]
fn combine<const LANES: usize>(
    stages: &[[Lane; LANES]; 2 * STAGES],
    weights: &[(usize, f64)],
    (q, p): (&[Lane; LANES], &[Lane; LANES]),
    step: f64,
) -> ([Lane; LANES], [Lane; LANES]) {
    let mut sums = [[Lane::ZERO; LANES]; 2];
    for (j, w) in weights {
        for quantity in 0..2 {
            let stage = &stages[2 * j + quantity];
            for c in 0..LANES {
                sums[quantity][c] = add(sums[quantity][c], scale(*w, stage[c]));
            }
        }
    }
    let end = |base: &[Lane; LANES], sums: &[Lane; LANES]| {
        std::array::from_fn(|c| add(base[c], scale(step, sums[c])))
    };
    (end(q, &sums[0]), end(p, &sums[1]))
}

/// The same as [`step_in_place`] for any number of lanes and of closed levels.
#[inline(always)]
fn step_of_many(pair: &mut Pair, scene: &Scene<'_>, clock: &Clock) -> f64 {
    let (lanes, span) = (pair.lanes, clock.span());
    pair.contact_works.clear();
    pair.contact_works.resize(scene.touches.len(), (0.0, 0.0));
    let (mut input, mut viscous) = (Lane::ZERO, Lane::ZERO);
    for stage in 0..STAGES {
        let theta = NODES[stage];
        let rate = clock.rate(theta);
        let ground = scene.ground.0 + scene.ground.1 * clock.offset(theta);
        let weight = SOLUTION[stage] * span * rate;
        if stage > 0 {
            combine_many(&pair.stages, ROWS[stage], &pair.base, span, &mut pair.trial);
        }
        let state = if stage > 0 { &pair.trial } else { &pair.base };
        let (q, p) = state.split_at(lanes);
        let range = 2 * stage * lanes..2 * (stage + 1) * lanes;
        let (speeds, accelerations) = pair.stages[range].split_at_mut(lanes);
        for (c, m) in scene.constants.modes[..lanes].iter().enumerate() {
            let (x, v) = (q[c], p[c]);
            let (dashpot, spring) = (mul(m.damping, v), mul(m.stiffness, x));
            let load = scale(ground, m.participation);
            accelerations[c] = scale(-rate, add(add(dashpot, spring), load));
            speeds[c] = scale(rate, v);
            input = add(input, scale(-weight, mul(load, v)));
            viscous = add(viscous, scale(weight, mul(dashpot, v)));
        }
        for (touch, works) in scene.touches.iter().zip(&mut pair.contact_works) {
            let row = &scene.rows.levels[touch.level];
            let (delta, velocity) = (row.dot(q) - touch.width, row.dot(p));
            let force = force(scene, (touch, &power_law(scene, touch)), (delta, velocity));
            row.add(-rate * force, accelerations);
            works.0 += weight * force * velocity;
            works.1 += weight * force;
        }
    }
    combine_many(&pair.stages, &WEIGHTS, &pair.base, span, &mut pair.trial);
    let (q, p) = pair.trial.split_at(lanes);
    pair.end.motion[0].copy_from_slice(q);
    pair.end.motion[1].copy_from_slice(p);
    pair.works = Works {
        input: total(&input),
        viscous: total(&viscous),
    };
    let mut largest = Lane::ZERO;
    for c in 0..2 * lanes {
        let of = |j: usize| pair.stages[2 * j * lanes + c];
        let size = (scene.constants.rows.size[c % lanes], SIZE[c / lanes]);
        let ends = (pair.base[c], pair.trial[c]);
        error(&mut largest, of, ends, (scene.tolerance, size), span);
    }
    greatest(&largest)
}

/// The same as [`combine`] for any number of lanes.
#[inline(always)]
fn combine_many(
    stages: &[Lane],
    weights: &[(usize, f64)],
    base: &[Lane],
    step: f64,
    out: &mut [Lane],
) {
    let lanes = base.len();
    for c in 0..lanes {
        let mut sum = Lane::ZERO;
        for (j, w) in weights {
            sum = add(sum, scale(*w, stages[j * lanes + c]));
        }
        out[c] = add(base[c], scale(step, sum));
    }
}

/// Takes the error of one lane of modes, over what is allowed, into the largest: by the blend
/// of Hairer, Norsett and Wanner (1993, equation II.10.17), at the floor where a mode shows
/// most. `size` are the modes' sizes there, and the size below which control is absolute.
#[inline(always)]
fn error(
    largest: &mut Lane,
    stage: impl Fn(usize) -> Lane,
    (before, after): (Lane, Lane),
    (tolerance, (size, floor)): (f64, (Lane, f64)),
    span: f64,
) {
    let (mut fifth, mut third) = (Lane::ZERO, Lane::ZERO);
    for ((j, w), (_, x)) in ERROR_5.iter().zip(&ERROR_3) {
        let stage = stage(*j);
        fifth = add(fifth, scale(*w, stage));
        third = add(third, scale(*x, stage));
    }
    for l in 0..WIDTH {
        let (a, b) = (before[l].abs(), after[l].abs());
        let reach = if a > b { a } else { b };
        let allowed = tolerance * (floor + size[l] * reach);
        let square = fifth[l] * fifth[l];
        let blend = (square + 0.01 * third[l] * third[l]).sqrt();
        let error = span.abs() * size[l] * square / (blend + f64::MIN_POSITIVE);
        largest[l] = larger(error / allowed, largest[l]);
    }
}

/// The greatest place of a lane of errors; infinite if one is NaN, which rejects the step.
#[inline(always)]
fn greatest(lane: &Lane) -> f64 {
    let most = lane.0.iter().fold(0.0, |most, ratio| larger(*ratio, most));
    if most.is_nan() { f64::INFINITY } else { most }
}

/// The larger one; NaN if one is, which a comparison alone would lose to the next number.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if (a > b) | a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps far too long for a stiff contact overflow in single modes: they must not pass for exact.
    #[test]
    fn an_error_that_is_no_number_is_infinite() {
        for place in 0..WIDTH {
            for other in [0.0, 0.5, f64::INFINITY] {
                let mut lane = Lane([other; WIDTH]);
                assert_eq!(greatest(&lane), other);
                lane[place] = f64::NAN;
                assert_eq!(greatest(&lane), f64::INFINITY, "{place} {other}");
            }
        }
    }
}
