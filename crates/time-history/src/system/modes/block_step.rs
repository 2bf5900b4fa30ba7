//! The modes over a block of samples by one exact step.
//!
//! Ground acceleration over a block is the straight line through both ends, and what it departs
//! from that at the samples inside. Under the line a mode has a motion that is linear in time;
//! the difference from it swings freely, and under the departures. So the state at the end, and
//! the work of the ground, are linear in the state at the start and in the accelerations at the
//! samples, the work of the damping is quadratic, and how far a mode departs inside from the
//! cubic with its values and rates at both ends is at most a sum of multiples of magnitudes, as
//! the cubic follows a line. All factors are made from the step over one sample, once for a set
//! of buildings.
//!
//! What the accelerations alone contribute is the *load* of the block. It depends on record and
//! buildings, not on the motion: runs that have both in common share it ([`Loads`]).

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use pounding_vectorised::vectorised;

use super::lanes::{Lane, Modal, ModeLanes, WIDTH};
use super::reach::{Bounds, QUANTITIES, Reach};
use crate::system::System;

/// Samples of a block.
pub(crate) const BLOCK: usize = 8;

/// Samples of a block, with both ends.
const TIMES: usize = BLOCK + 1;
/// Samples inside.
const INSIDE: usize = BLOCK - 1;
/// What works are quadratic in: displacement and velocity at the start, and the accelerations.
const INPUTS: usize = 2 + TIMES;
/// Products of two accelerations.
const PAIRS: usize = TIMES * (TIMES + 1) / 2;
/// Points of a sample at which the factors of bounds are worked out.
const POINTS: usize = 4;
/// Part of the largest terms of a function that may be lost in round-off: some thousand
/// units in the last place.
const ROUND_OFF: f64 = 1.0e-12;
/// Maximum product of block and first circular frequency of a building: the mode then departs from
/// its cubic by a tenth of its amplitude, as `(omega L)^4 / 384`. Of longer blocks, which are more
/// than 0.4 periods, most would have to be looked at.
const LONGEST: f64 = 2.5;
/// Maximum product of block and fastest rate: round-off of the cubics is some units in the last
/// place of velocities times the block, `(omega + 2 zeta omega) L` of the amplitude, and
/// [`ROUND_OFF`] is to be more.
const FASTEST: f64 = 300.0;
/// Bytes that the loads of one record and set of buildings may take.
const BYTES: usize = 32 << 20;

/// Factors of the state at the start, of eight modes.
#[derive(Debug, Clone, Copy)]
struct Start {
    /// Of displacement and velocity, in displacement and velocity at the end.
    displacement: [Lane; 2],
    velocity: [Lane; 2],
    /// Of the square of the displacement, its product with the velocity, and the square of that, in
    /// the work of the damping.
    viscous: [Lane; 3],
    /// Of magnitudes of displacement and velocity less those of the motion under the line, in
    /// [`Bounds`].
    bounds: [[Lane; 2]; 3],
    /// The motion under the line, as [`ModeLanes`] has it: beside the others it is in the cache.
    steady: [Lane; 2],
}

/// Factors of the accelerations.
#[derive(Debug, Clone)]
struct Weights {
    /// Of every acceleration: in displacement and velocity at the end; in what multiplies
    /// displacement and velocity at the start in the work of the ground, and in that of the
    /// damping.
    linear: [[Lane; TIMES]; 6],
    /// Of products of two accelerations in both works.
    pairs: [[Lane; PAIRS]; 2],
}

/// What accelerations add to [`Bounds`], all of magnitudes: factors of departures from the line at
/// the samples inside, and, for round-off, of the largest acceleration and of the line's slope.
type BoundWeights<T> = [T; INSIDE + 2];

/// What the accelerations of a block do to eight modes.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Load {
    linear: [Lane; 6],
    works: [Lane; 2],
}

/// What the accelerations of a block do to all modes, and what they add to the bounds of the floors
/// of every building.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BlockLoad<'a> {
    modes: &'a [Load],
    pub bounds: &'a [[f64; QUANTITIES]],
}

/// The same, made for one block or for many.
#[derive(Debug, Clone, Default)]
pub(crate) struct MadeLoad {
    modes: Vec<Load>,
    bounds: Vec<[f64; QUANTITIES]>,
}

impl MadeLoad {
    fn new(blocks: usize, (lanes, buildings): (usize, usize)) -> Self {
        Self {
            modes: vec![Load::default(); blocks * lanes],
            bounds: vec![[0.0; QUANTITIES]; blocks * buildings],
        }
    }

    /// That of a single block.
    pub(crate) fn view(&self) -> BlockLoad<'_> {
        BlockLoad {
            modes: &self.modes,
            bounds: &self.bounds,
        }
    }

    /// That of the block of this number, if it is there.
    fn of(&self, block: usize, (lanes, buildings): (usize, usize)) -> Option<BlockLoad<'_>> {
        Some(BlockLoad {
            modes: self.modes.get(block * lanes..(block + 1) * lanes)?,
            bounds: self
                .bounds
                .get(block * buildings..(block + 1) * buildings)?,
        })
    }
}

/// All modes of a set of buildings.
#[derive(Debug, Clone)]
pub(crate) struct BlockStep {
    start: Vec<Start>,
    weights: Vec<Weights>,
    /// What accelerations add to the bounds of the floors of every building.
    bounds: Vec<BoundWeights<[f64; QUANTITIES]>>,
    /// Length of a block (s).
    length: f64,
}

/// Loads of all whole blocks of a record on a set of buildings, made by the second run that asks
/// for them: a run by itself works them out as it goes.
#[derive(Debug, Default)]
pub(crate) struct Loads {
    asked: AtomicBool,
    all: OnceLock<MadeLoad>,
}

impl Loads {
    /// Asks for those of a run to come. The results are the same with and without.
    pub(crate) fn ask(&self, system: &System) {
        let Some(step) = system.contact_free().and_then(|c| c.block_step.as_ref()) else {
            return;
        };
        let samples = &system.ground().samples;
        let blocks = samples.len().saturating_sub(1) / BLOCK;
        let (lanes, buildings) = step.counts();
        let bytes =
            blocks * (lanes * size_of::<Load>() + buildings * size_of::<[f64; QUANTITIES]>());
        if bytes > BYTES || !self.asked.swap(true, Ordering::Relaxed) {
            return;
        }
        self.all.get_or_init(|| {
            let mut all = MadeLoad::new(blocks, (lanes, buildings));
            let modes = all.modes.chunks_exact_mut(lanes);
            let bounds = all.bounds.chunks_exact_mut(buildings);
            for (block, (modes, bounds)) in modes.zip(bounds).enumerate() {
                step.load_into(&samples[block * BLOCK..], (modes, bounds));
            }
            all
        });
    }

    /// Whether they are at hand.
    #[cfg(test)]
    pub(crate) fn is_made(&self) -> bool {
        self.all.get().is_some()
    }

    /// That of the block from this sample on; none where it is not at hand.
    pub(crate) fn of(&self, step: Option<&BlockStep>, sample: usize) -> Option<BlockLoad<'_>> {
        let all = self.all.get().filter(|_| sample.is_multiple_of(BLOCK))?;
        all.of(sample / BLOCK, step?.counts())
    }
}

impl BlockStep {
    /// Lanes of modes up to which this is done: the factors of more are larger than any cache, where
    /// this saves less the more there are.
    pub(super) const LANES: usize = 128;

    /// For these modes over one sample of this length (s), and over a part of it, one of
    /// [`BlockStep::parts`].
    pub(super) fn new(
        (modes, parts): (&[ModeLanes], &[ModeLanes]),
        buildings: &[Reach],
        step: f64,
    ) -> Self {
        let (mut start, mut weights) = (Vec::new(), Vec::new());
        let mut bounds: BoundWeights<Bounds> = std::array::from_fn(|_| Bounds::new(modes.len()));
        for (c, (m, part)) in modes.iter().zip(parts).enumerate() {
            let (of_start, of_load, of_bounds) = lanes(m, part, step);
            start.push(of_start);
            weights.push(of_load);
            for (bounds, of_bounds) in bounds.iter_mut().zip(of_bounds) {
                [
                    bounds.displacement[c],
                    bounds.acceleration[c],
                    bounds.most[c],
                ] = of_bounds;
            }
        }
        let of = |building: &Reach| bounds.each_ref().map(|bounds| building.sums(bounds));
        Self {
            start,
            weights,
            bounds: buildings.iter().map(of).collect(),
            length: BLOCK as f64 * step,
        }
    }

    /// Whether blocks of samples of this length (s) are worth a step of their own, for buildings
    /// with these first circular frequencies (rad/s) whose fastest rate (1/s) is that.
    pub(super) fn is_worth(step: f64, mut first: impl Iterator<Item = f64>, fastest: f64) -> bool {
        let length = BLOCK as f64 * step;
        first.all(|omega| omega * length <= LONGEST) && fastest * length <= FASTEST
    }

    /// Length of the parts (s) of a sample of this length (s).
    pub(super) fn parts(step: f64) -> f64 {
        step / POINTS as f64
    }

    /// Numbers of lanes and of buildings.
    fn counts(&self) -> (usize, usize) {
        (self.start.len(), self.bounds.len())
    }

    /// Space for what one block does.
    pub(crate) fn space(&self) -> MadeLoad {
        MadeLoad::new(1, self.counts())
    }

    /// What a block does whose accelerations are the first of these.
    pub(crate) fn load(&self, samples: &[f64], load: &mut MadeLoad) {
        self.load_into(samples, (&mut load.modes, &mut load.bounds));
    }

    fn load_into(&self, samples: &[f64], out: (&mut [Load], &mut [[f64; QUANTITIES]])) {
        let mut block = [0.0; TIMES];
        block.copy_from_slice(&samples[..TIMES]);
        load_all(self, &block, out);
    }

    /// Takes the motion over a block to its end, and bounds what it does inside beside what the
    /// accelerations add. `ends` are the accelerations there.
    pub(crate) fn advance(
        &self,
        (now, ends): (&Modal, (f64, f64)),
        load: BlockLoad<'_>,
        (end, bounds): (&mut Modal, &mut Bounds),
    ) {
        let slope = (ends.1 - ends.0) / self.length;
        let steps = (self.start.as_slice(), load.modes);
        advance_all(steps, (now, ends.0, slope), end, bounds);
    }
}

#[vectorised]
fn advance_all(
    (starts, loads): (&[Start], &[Load]),
    (now, ground, slope): (&Modal, f64, f64),
    end: &mut Modal,
    bounds: &mut Bounds,
) {
    let count = starts.len();
    let now = [
        &now.displacement[..count],
        &now.velocity[..count],
        &now.input[..count],
        &now.viscous[..count],
    ];
    let loads = &loads[..count];
    let ends = [
        &mut end.displacement[..count],
        &mut end.velocity[..count],
        &mut end.input[..count],
        &mut end.viscous[..count],
    ];
    let [end_q, end_p, end_input, end_viscous] = ends;
    let departures = &mut bounds.displacement[..count];
    let (faster, most) = (&mut bounds.acceleration[..count], &mut bounds.most[..count]);
    for (c, k) in starts.iter().enumerate() {
        let load = &loads[c];
        let [x, v, input, viscous] = now.map(|now| now[c]);
        let [q_load, p_load, by_q, by_p, damped_by_q, damped_by_p] = &load.linear;
        let [by_value, by_slope] = &k.steady;
        let mut motion = [Lane::ZERO; 4];
        let mut bounds = [Lane::ZERO; 3];
        for l in 0..WIDTH {
            let (x, v) = (x[l], v[l]);
            motion[0][l] = k.displacement[0][l] * x + k.displacement[1][l] * v + q_load[l];
            motion[1][l] = k.velocity[0][l] * x + k.velocity[1][l] * v + p_load[l];
            motion[2][l] = input[l] + (by_q[l] * x + by_p[l] * v + load.works[0][l]);
            motion[3][l] = viscous[l]
                + (x * (k.viscous[0][l] * x + k.viscous[1][l] * v + damped_by_q[l])
                    + v * (k.viscous[2][l] * v + damped_by_p[l])
                    + load.works[1][l]);
        }
        for l in 0..WIDTH {
            let place = (x[l] + (by_value[l] * ground - by_slope[l] * slope)).abs();
            let speed = (v[l] + by_value[l] * slope).abs();
            for b in 0..3 {
                bounds[b][l] = k.bounds[b][0][l] * place + k.bounds[b][1][l] * speed;
            }
        }
        [end_q[c], end_p[c], end_input[c], end_viscous[c]] = motion;
        [departures[c], faster[c], most[c]] = bounds;
    }
}

#[vectorised]
fn load_all(
    step: &BlockStep,
    samples: &[f64; TIMES],
    (loads, bounds): (&mut [Load], &mut [[f64; QUANTITIES]]),
) {
    let mut pairs = [0.0; PAIRS];
    let mut place = 0;
    for i in 0..TIMES {
        for j in i..TIMES {
            pairs[place] = samples[i] * samples[j];
            place += 1;
        }
    }
    for (weights, load) in step.weights.iter().zip(loads) {
        for (out, weights) in load.linear.iter_mut().zip(&weights.linear) {
            *out = weighted(weights, samples);
        }
        for (out, weights) in load.works.iter_mut().zip(&weights.pairs) {
            *out = weighted(weights, &pairs);
        }
    }
    let rise = (samples[BLOCK] - samples[0]) / BLOCK as f64;
    let mut magnitudes: BoundWeights<f64> = [0.0; INSIDE + 2];
    for k in 0..INSIDE {
        magnitudes[k] = (samples[k + 1] - (samples[0] + rise * (k + 1) as f64)).abs();
    }
    magnitudes[INSIDE] = samples.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    magnitudes[INSIDE + 1] = (samples[BLOCK] - samples[0]).abs() / step.length;
    for (weights, out) in step.bounds.iter().zip(bounds) {
        let mut sums = [0.0; QUANTITIES];
        for (weights, magnitude) in weights.iter().zip(magnitudes) {
            for b in 0..QUANTITIES {
                sums[b] += weights[b] * magnitude;
            }
        }
        *out = sums;
    }
}

#[inline(always)]
fn weighted<const COUNT: usize>(weights: &[Lane; COUNT], values: &[f64; COUNT]) -> Lane {
    let mut sum = Lane::ZERO;
    for (weights, value) in weights.iter().zip(values) {
        for l in 0..WIDTH {
            sum[l] += weights[l] * value;
        }
    }
    sum
}

/// A linear function of the state at the start and the accelerations.
type Row = [Lane; INPUTS];

/// Adds a multiple of a row.
#[inline(always)]
fn add_row(factor: &Lane, row: &Row, to: &mut Row) {
    for (to, row) in to.iter_mut().zip(row) {
        for l in 0..WIDTH {
            to[l] += factor[l] * row[l];
        }
    }
}

/// Adds a row.
#[inline(always)]
fn add_all(row: &Row, to: &mut Row) {
    for (to, row) in to.iter_mut().zip(row) {
        add_to(*row, to);
    }
}

#[inline(always)]
fn add_to(value: Lane, to: &mut Lane) {
    for l in 0..WIDTH {
        to[l] += value[l];
    }
}

/// Sum of so many multiples of two rows and two accelerations.
#[inline(always)]
fn combined(factors: &[Lane; 4], [x, v]: [&Row; 2], sample: usize) -> Row {
    let mut out = [Lane::ZERO; INPUTS];
    add_row(&factors[0], x, &mut out);
    add_row(&factors[1], v, &mut out);
    add_to(factors[2], &mut out[2 + sample]);
    add_to(factors[3], &mut out[3 + sample]);
    out
}

/// Adds the product of two rows to a quadratic form.
#[inline(always)]
fn add_product(a: &Row, b: &Row, form: &mut [Row; INPUTS]) {
    for (a, row) in a.iter().zip(form) {
        add_row(a, b, row);
    }
}

/// The coefficient of the product of two inputs.
#[inline(always)]
fn coefficient(form: &[Row; INPUTS], i: usize, j: usize) -> Lane {
    let (a, b) = (&form[i][j], &form[j][i]);
    Lane::from_fn(|l| if i == j { a[l] } else { a[l] + b[l] })
}

/// All factors of eight modes.
#[vectorised]
fn lanes(m: &ModeLanes, part: &ModeLanes, step: f64) -> (Start, Weights, BoundWeights<[Lane; 3]>) {
    let mut x = [Lane::ZERO; INPUTS];
    let mut v = [Lane::ZERO; INPUTS];
    x[0] = Lane::from_fn(|_| 1.0);
    v[1] = Lane::from_fn(|_| 1.0);
    let mut input = [[Lane::ZERO; INPUTS]; INPUTS];
    let mut viscous = [[Lane::ZERO; INPUTS]; INPUTS];
    for sample in 0..BLOCK {
        let (a, b) = (2 + sample, 3 + sample);
        let integral = combined(&m.integral, [&x, &v], sample);
        let k = &m.viscous;
        add_product(
            &x,
            &combined(&[k[0], k[1], k[2], k[3]], [&x, &v], sample),
            &mut viscous,
        );
        let by_speed = [Lane::ZERO, k[4], k[5], k[6]];
        add_product(&v, &combined(&by_speed, [&x, &v], sample), &mut viscous);
        add_to(k[7], &mut viscous[a][a]);
        add_to(k[8], &mut viscous[a][b]);
        add_to(k[9], &mut viscous[b][b]);
        let end = combined(&m.displacement, [&x, &v], sample);
        let speed = combined(&m.velocity, [&x, &v], sample);
        // The work of the ground, - gamma (x(1) b - x(0) a - (b - a) / h int x), from differences:
        // what the motion has in common at both ends would cancel for every pair of accelerations.
        let gamma = &m.participation;
        let (mut by_start, mut by_rise) = (end, end);
        for k in 0..INPUTS {
            for l in 0..WIDTH {
                by_start[k][l] = -gamma[l] * (end[k][l] - x[k][l]);
                by_rise[k][l] = -gamma[l] * (end[k][l] - integral[k][l] / step);
            }
        }
        add_all(&by_start, &mut input[a]);
        add_all(&by_rise, &mut input[b]);
        for k in 0..INPUTS {
            for l in 0..WIDTH {
                input[a][k][l] -= by_rise[k][l];
            }
        }
        (x, v) = (end, speed);
    }
    let bounds = bounds(m, part, step, [&x, &v]);
    let by = |form: &[Row; INPUTS], start: usize| {
        std::array::from_fn(|k| coefficient(form, start, 2 + k))
    };
    let pairs = |form: &[Row; INPUTS]| {
        let mut pairs = [Lane::ZERO; PAIRS];
        let both = (0..TIMES).flat_map(|i| (i..TIMES).map(move |j| (i, j)));
        for (pair, (i, j)) in pairs.iter_mut().zip(both) {
            *pair = coefficient(form, 2 + i, 2 + j);
        }
        pairs
    };
    let loads = |row: &Row| std::array::from_fn(|k| row[2 + k]);
    let length = BLOCK as f64 * step;
    // What round-off takes is a part of the motion itself, not of what it departs by.
    let still = [
        [
            m.steady[0],
            Lane::from_fn(|l| m.steady[1][l] + m.steady[0][l] * length),
        ],
        [
            m.participation,
            Lane::from_fn(|l| m.stiffness[l] * m.steady[1][l] + m.damping[l] * m.steady[0][l]),
        ],
    ];
    let lost = |of: usize| still[of].map(|factor| factor.map(|x| ROUND_OFF * x.abs()));
    let start = Start {
        displacement: [x[0], x[1]],
        velocity: [v[0], v[1]],
        viscous: [
            coefficient(&viscous, 0, 0),
            coefficient(&viscous, 0, 1),
            coefficient(&viscous, 1, 1),
        ],
        bounds: std::array::from_fn(|b| {
            std::array::from_fn(|k| {
                Lane::from_fn(|l| {
                    let scale = if b == 0 { 1.0 } else { m.stiffness[l] };
                    let speed = if b == 0 {
                        length
                    } else {
                        m.damping[l] + m.stiffness[l] * length
                    };
                    bounds[b][k][l] + ROUND_OFF * if k == 0 { scale } else { speed }
                })
            })
        }),
        steady: m.steady,
    };
    let weights = Weights {
        linear: [
            loads(&x),
            loads(&v),
            by(&input, 0),
            by(&input, 1),
            by(&viscous, 0),
            by(&viscous, 1),
        ],
        pairs: [pairs(&input), pairs(&viscous)],
    };
    let lost = [lost(0), lost(1), lost(1)];
    let bounds = std::array::from_fn(|k| {
        std::array::from_fn(|b| match k.checked_sub(INSIDE) {
            None => bounds[b][2 + k],
            Some(k) => lost[b][k],
        })
    });
    (start, weights, bounds)
}

/// A Bernstein polynomial of degree 3 at each of the points of a block.
fn bernstein(point: usize) -> [f64; 4] {
    let x = point as f64 / (BLOCK * POINTS) as f64;
    let y = 1.0 - x;
    [y * y * y, 3.0 * x * y * y, 3.0 * x * x * y, x * x * x]
}

/// Maximum magnitudes, over the block, of what displacement (0) and absolute acceleration (1)
/// depart from their cubics by, and of absolute acceleration itself (2): for unit displacement
/// and velocity at the start without ground acceleration, then for a unit departure from the line
/// at each sample inside, between whose neighbours it is linear. At the points by the exact step
/// from one to the next; between them a function exceeds its values at both by at most an eighth
/// of the square of their distance times its second derivative.
#[inline(always)]
fn bounds(
    m: &ModeLanes,
    part: &ModeLanes,
    step: f64,
    [x, v]: [&Row; 2],
) -> [[Lane; 2 + INSIDE]; 3] {
    let third = BLOCK as f64 * step / 3.0;
    let between = step / POINTS as f64;
    let eighth = 0.125 * between * between;
    let curve = 6.0 / (9.0 * third * third);
    let mut out = [[Lane::ZERO; 2 + INSIDE]; 3];
    for column in 0..2 + INSIDE {
        // The departure at the first sample is that of the second row of accelerations.
        let end = if column < 2 { column } else { column + 1 };
        let ground = |point: usize| -> f64 {
            let Some(sample) = column.checked_sub(1).filter(|_| column >= 2) else {
                return 0.0;
            };
            (1.0 - (point as f64 / POINTS as f64 - sample as f64).abs()).max(0.0)
        };
        let slope = if column < 2 { 0.0 } else { 1.0 / step };
        let mut q = Lane::from_fn(|_| if column == 0 { 1.0 } else { 0.0 });
        let mut p = Lane::from_fn(|_| if column == 1 { 1.0 } else { 0.0 });
        let (restoring, rate) = (restoring(m, &q, &p), |s: &Lane, p: &Lane| {
            Lane::from_fn(|l| -(m.damping[l] * s[l] + m.stiffness[l] * p[l]))
        });
        let cubic = |a: &Lane, va: &Lane, b: &Lane, vb: &Lane| -> [Lane; 4] {
            [
                *a,
                Lane::from_fn(|l| a[l] + third * va[l]),
                Lane::from_fn(|l| b[l] - third * vb[l]),
                *b,
            ]
        };
        let (q_end, p_end) = (&x[end], &v[end]);
        let restoring_end = self::restoring(m, q_end, p_end);
        let cubics = [
            cubic(&q, &p, q_end, p_end),
            cubic(
                &restoring,
                &rate(&restoring, &p),
                &restoring_end,
                &rate(&restoring_end, p_end),
            ),
        ];
        let mut bend = [Lane::ZERO; 3];
        let mut most = [Lane::ZERO; 3];
        for point in 0..BLOCK * POINTS {
            let (a, b) = (ground(point), ground(point + 1));
            let (force, rise) = (a.max(b), if a == b { 0.0 } else { slope });
            for l in 0..WIDTH {
                let gamma = m.participation[l].abs();
                let (omega, damping) = (m.circular_frequency[l], m.damping[l]);
                let size = p[l].abs() + omega * q[l].abs() + gamma * between * force;
                let second = (omega + damping) * size + gamma * force;
                let snap = (m.stiffness[l] + damping * damping) * second
                    + damping * (m.stiffness[l] * size + gamma * rise);
                bend[0][l] = bend[0][l].max(second);
                bend[1][l] = bend[1][l].max(snap);
            }
            let after = |k: &[Lane; 4]| {
                Lane::from_fn(|l| k[0][l] * q[l] + k[1][l] * p[l] + (k[2][l] * a + k[3][l] * b))
            };
            (q, p) = (after(&part.displacement), after(&part.velocity));
            let absolute = self::restoring(m, &q, &p);
            let weights = bernstein(point + 1);
            for (of, (value, cubic)) in [&q, &absolute].into_iter().zip(&cubics).enumerate() {
                for l in 0..WIDTH {
                    let (first, last) = (
                        weights[0] * cubic[0][l] + weights[1] * cubic[1][l],
                        weights[2] * cubic[2][l] + weights[3] * cubic[3][l],
                    );
                    most[of][l] = most[of][l].max((value[l] - (first + last)).abs());
                }
            }
            for l in 0..WIDTH {
                most[2][l] = most[2][l].max(absolute[l].abs());
            }
        }
        for l in 0..WIDTH {
            most[2][l] = most[2][l].max(restoring[l].abs());
        }
        bend[2] = bend[1];
        for (bend, cubic) in bend.iter_mut().zip(&cubics) {
            for l in 0..WIDTH {
                let ends = [0, 1].map(|k| cubic[k][l] - 2.0 * cubic[k + 1][l] + cubic[k + 2][l]);
                bend[l] += curve * ends[0].abs().max(ends[1].abs());
            }
        }
        for ((out, most), bend) in out.iter_mut().zip(&most).zip(&bend) {
            out[column] = Lane::from_fn(|l| most[l] + eighth * bend[l]);
        }
    }
    out
}

/// Absolute accelerations.
#[inline(always)]
fn restoring(m: &ModeLanes, q: &Lane, p: &Lane) -> Lane {
    Lane::from_fn(|l| -(m.damping[l] * p[l] + m.stiffness[l] * q[l]))
}
