//! One step of the explicit pair of order 8(5,3) on the modes with contacts of any law.

use multiversion::multiversion;
use pounding_runge_kutta::tableau::{ERROR_3, ERROR_5, NODES, ROWS, STAGES, WEIGHTS};

use super::clock::Clock;
use super::point::Point;
use super::rows::{LevelRows, total};
use super::series::Works;
use super::touch::Touch;
use crate::free_flight::{FreeFlight, Lane, WIDTH};
use crate::system::System;

/// Sizes (m, m/s) below which displacements and velocities are controlled absolutely.
const SIZE: [f64; 2] = [1.0e-2, 1.0e-1];

/// What a step needs to know beside its start.
#[derive(Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub constants: &'a FreeFlight,
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
    /// Derivatives of displacements and velocities with respect to `s`, stage after stage.
    stages: [Vec<Lane>; 2],
    trial: [Vec<Lane>; 2],
    pub start: Point,
    pub end: Point,
    pub works: Works,
    /// Work on every closed level (J), and impulse (N s).
    pub contact_works: Vec<(f64, f64)>,
    pub evaluations: u64,
}

impl Pair {
    pub(crate) fn new(lanes: usize, levels: usize) -> Self {
        let stages = || vec![[0.0; WIDTH]; lanes * STAGES];
        let zeros = || vec![[0.0; WIDTH]; lanes];
        Self {
            lanes,
            stages: [stages(), stages()],
            trial: [zeros(), zeros()],
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
    let (lanes, span) = (pair.lanes, clock.span());
    pair.contact_works.clear();
    pair.contact_works.resize(scene.touches.len(), (0.0, 0.0));
    let (mut input, mut viscous) = ([0.0; WIDTH], [0.0; WIDTH]);
    for stage in 0..STAGES {
        let theta = NODES[stage];
        let rate = clock.rate(theta);
        let ground = scene.ground.0 + scene.ground.1 * clock.offset(theta);
        let weight = SOLUTION[stage] * span * rate;
        if stage > 0 {
            for which in 0..2 {
                let (stages, base) = (&pair.stages[which], &pair.start.motion[which]);
                combine(
                    stages,
                    lanes,
                    ROWS[stage],
                    base,
                    span,
                    &mut pair.trial[which],
                );
            }
        }
        let [q, p] = if stage > 0 {
            [&pair.trial[0], &pair.trial[1]]
        } else {
            [&pair.start.motion[0], &pair.start.motion[1]]
        };
        let [speeds, accelerations] = &mut pair.stages;
        let range = stage * lanes..(stage + 1) * lanes;
        let (speeds, accelerations) = (&mut speeds[range.clone()], &mut accelerations[range]);
        for (c, m) in scene.constants.modes.iter().enumerate() {
            let (x, v) = (q[c], p[c]);
            let (mut speed, mut a) = ([0.0; WIDTH], [0.0; WIDTH]);
            for l in 0..WIDTH {
                let dashpot = m.damping[l] * v[l];
                let load = m.participation[l] * ground;
                a[l] = rate * (-(dashpot + m.stiffness[l] * x[l]) - load);
                speed[l] = rate * v[l];
                input[l] -= weight * (load * v[l]);
                viscous[l] += weight * (dashpot * v[l]);
            }
            (speeds[c], accelerations[c]) = (speed, a);
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
    for which in 0..2 {
        let (stages, base) = (&pair.stages[which], &pair.start.motion[which]);
        combine(
            stages,
            lanes,
            &WEIGHTS,
            base,
            span,
            &mut pair.end.motion[which],
        );
    }
    pair.works = Works {
        input: total(&input),
        viscous: total(&viscous),
    };
    error(pair, scene, span)
}

/// `out = base + step * sum(weight * stage)`.
#[inline(always)]
fn combine(
    stages: &[Lane],
    lanes: usize,
    weights: &[(usize, f64)],
    base: &[Lane],
    step: f64,
    out: &mut [Lane],
) {
    for c in 0..lanes {
        let mut sum = [0.0; WIDTH];
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
}

/// Error of the step over what is allowed, by the blend of Hairer, Norsett and Wanner
/// (1993, equation II.10.17), the largest of all modes at the floor where it shows most.
#[inline(always)]
fn error(pair: &Pair, scene: &Scene<'_>, span: f64) -> f64 {
    let lanes = pair.lanes;
    let mut largest = [0.0_f64; WIDTH];
    for which in 0..2 {
        let stages = &pair.stages[which];
        for c in 0..lanes {
            let (mut fifth, mut third) = ([0.0; WIDTH], [0.0; WIDTH]);
            for ((j, w), (_, x)) in ERROR_5.iter().zip(&ERROR_3) {
                let stage = &stages[j * lanes + c];
                for l in 0..WIDTH {
                    fifth[l] += w * stage[l];
                    third[l] += x * stage[l];
                }
            }
            let (before, after) = (&pair.start.motion[which][c], &pair.end.motion[which][c]);
            for l in 0..WIDTH {
                let size = scene.rows.size[c][l];
                let reach = before[l].abs().max(after[l].abs());
                let allowed = scene.tolerance * (SIZE[which] + size * reach);
                let square = fifth[l] * fifth[l];
                let blend = (square + 0.01 * third[l] * third[l]).sqrt();
                let error = span.abs() * size * square / (blend + f64::MIN_POSITIVE);
                let ratio = error / allowed;
                // A NaN must not be lost in the comparison.
                largest[l] = if ratio <= largest[l] {
                    largest[l]
                } else {
                    ratio
                };
            }
        }
    }
    let mut most = 0.0;
    for ratio in largest {
        most = if ratio <= most { most } else { ratio };
    }
    most
}
