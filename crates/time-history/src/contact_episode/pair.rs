//! One step of the explicit pair of order 8(5,3) on the modes with contacts of any law.

use multiversion::multiversion;
use pounding_runge_kutta::tableau::{ERROR_3, ERROR_5, NODES, ROWS, STAGES, WEIGHTS};

use super::clock::Clock;
use super::point::Point;
use super::rows::{LevelRows, total};
use super::series::Works;
use super::touch::Touch;
use crate::contact_free::{ContactFree, Lane, WIDTH, add, mul, scale};
use crate::system::System;

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
        }
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

#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
fn step(pair: &mut Pair, scene: &Scene<'_>, clock: &Clock) -> f64 {
    match pair.lanes {
        1 => step_of::<2>(pair, scene, clock),
        2 => step_of::<4>(pair, scene, clock),
        3 => step_of::<6>(pair, scene, clock),
        4 => step_of::<8>(pair, scene, clock),
        _ => step_of::<0>(pair, scene, clock),
    }
}

/// For `LANES` lanes of displacements and velocities together; zero is any number.
#[inline(always)]
fn step_of<const LANES: usize>(pair: &mut Pair, scene: &Scene<'_>, clock: &Clock) -> f64 {
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
            combine::<LANES>(&pair.stages, ROWS[stage], &pair.base, span, &mut pair.trial);
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
            let level = &scene.system.levels()[touch.level];
            let force = touch.contact.force(level, delta, velocity).value;
            row.add(-rate * force, accelerations);
            works.0 += weight * force * velocity;
            works.1 += weight * force;
        }
    }
    combine::<LANES>(&pair.stages, &WEIGHTS, &pair.base, span, &mut pair.trial);
    let (q, p) = pair.trial.split_at(lanes);
    pair.end.motion[0].copy_from_slice(q);
    pair.end.motion[1].copy_from_slice(p);
    pair.works = Works {
        input: total(&input),
        viscous: total(&viscous),
    };
    error(pair, scene, span)
}

/// `out = base + step * sum(weight * stage)`.
#[inline(always)]
fn combine<const LANES: usize>(
    stages: &[Lane],
    weights: &[(usize, f64)],
    base: &[Lane],
    step: f64,
    out: &mut [Lane],
) {
    if LANES == 0 {
        let lanes = base.len();
        for c in 0..lanes {
            let mut sum = Lane::ZERO;
            for (j, w) in weights {
                let stage = stages[j * lanes + c];
                for l in 0..WIDTH {
                    sum[l] += w * stage[l];
                }
            }
            let mut end = base[c];
            for l in 0..WIDTH {
                end[l] += step * sum[l];
            }
            out[c] = end;
        }
        return;
    }
    let mut sums = [Lane::ZERO; LANES];
    for (j, w) in weights {
        let stage = &stages[j * LANES..(j + 1) * LANES];
        for c in 0..LANES {
            for l in 0..WIDTH {
                sums[c][l] += w * stage[c][l];
            }
        }
    }
    let (base, out) = (&base[..LANES], &mut out[..LANES]);
    for c in 0..LANES {
        let mut end = base[c];
        for l in 0..WIDTH {
            end[l] += step * sums[c][l];
        }
        out[c] = end;
    }
}

/// Error of the step over what is allowed, by the blend of Hairer, Norsett and Wanner
/// (1993, equation II.10.17), the largest of all modes at the floor where it shows most.
#[inline(always)]
fn error(pair: &Pair, scene: &Scene<'_>, span: f64) -> f64 {
    let lanes = pair.lanes;
    let mut largest = Lane::ZERO;
    for c in 0..2 * lanes {
        let (mut fifth, mut third) = (Lane::ZERO, Lane::ZERO);
        for ((j, w), (_, x)) in ERROR_5.iter().zip(&ERROR_3) {
            let stage = pair.stages[2 * j * lanes + c];
            for l in 0..WIDTH {
                fifth[l] += w * stage[l];
                third[l] += x * stage[l];
            }
        }
        let (before, after) = (pair.base[c], pair.trial[c]);
        let (size, floor) = (scene.constants.rows.size[c % lanes], SIZE[c / lanes]);
        for l in 0..WIDTH {
            let (a, b) = (before[l].abs(), after[l].abs());
            let reach = if a > b { a } else { b };
            let allowed = scene.tolerance * (floor + size[l] * reach);
            let square = fifth[l] * fifth[l];
            let blend = (square + 0.01 * third[l] * third[l]).sqrt();
            let error = span.abs() * size[l] * square / (blend + f64::MIN_POSITIVE);
            let ratio = error / allowed;
            // A NaN must not be lost in the comparison.
            largest[l] = if ratio <= largest[l] {
                largest[l]
            } else {
                ratio
            };
        }
    }
    let mut most = 0.0;
    for ratio in largest.0 {
        most = if ratio <= most { most } else { ratio };
    }
    most
}
