//! Contact-free motion over a block of samples at once: most blocks neither touch nor peak,
//! and one comparison of every floor, storey and level says so.

use std::ops::Range;

use pounding_vectorised::vectorised;

use super::block_step::BLOCK;
use super::constants::ContactFree;
use super::lanes::{
    Ground, Lane, Modal, ModalState, ModeLanes, Shapes, WIDTH, at, lane_by_lane, step_modes,
};
use super::overshoots::{is_low, modal_acceleration_overshoots, modal_overshoots};
use super::rows::Rows;
use super::transform::to_floors;
use crate::system::System;

/// What has peaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    Displacement,
    Drift,
    Acceleration,
    SectionForce,
}

/// Lanes of degrees of freedom above which overshoots are first bounded for all floors of a
/// building together: each floor's own takes a pass over the mode shapes, which are then
/// larger than the cache.
const LARGE: usize = 3;

/// Work space.
#[derive(Debug, Clone)]
pub(crate) struct Block {
    /// Modal state at the end.
    pub end: Modal,
    /// Displacements and absolute accelerations of the modes at every sample, sample
    /// after sample.
    pub displacement: Vec<Lane>,
    pub acceleration: Vec<Lane>,
    /// Velocities and works of the modes at every sample, if somebody looks at them.
    watched: Option<[Vec<Lane>; 3]>,
    /// Maximum `|q'| + omega |q|` of every mode over the block.
    pub size: Vec<Lane>,
    /// Maximum floor displacement and drift, and maximum closing of levels.
    pub floors: Extremes,
    pub drifts: Extremes,
    pub levels: Extremes,
    /// Left and right floor of every level.
    between: Vec<(Option<usize>, Option<usize>)>,
    /// Absolute floor acceleration, unless it is low.
    pub accelerations: Extremes,
    /// Forces in sections.
    pub sections: Extremes,
    /// Bounds of the overshoots of displacement, drift, absolute acceleration and force in
    /// sections, and whether they are each floor's own.
    pub over: [Vec<Lane>; 4],
    own: [bool; 4],
    /// Maximum ground acceleration and slope.
    pub largest: (f64, f64),
    pub modal: Vec<Lane>,
}

/// Maximum values over the block, and the values at every sample.
#[derive(Debug, Clone)]
pub(crate) struct Extremes {
    pub top: Vec<Lane>,
    /// Eight lanes, one a sample, for every lane of rows.
    values: Vec<[Lane; BLOCK]>,
}

impl Extremes {
    fn new(lanes: usize) -> Self {
        Self {
            top: vec![Lane::ZERO; lanes],
            values: vec![[Lane::ZERO; BLOCK]; lanes],
        }
    }

    /// Value of a row after so many samples, at least one.
    pub(crate) fn after(&self, samples: usize, row: usize) -> f64 {
        self.values[row / WIDTH][samples - 1][row % WIDTH]
    }

    /// All rows after so many samples.
    pub(crate) fn copy_after(&self, samples: usize, out: &mut [Lane]) {
        for (out, values) in out.iter_mut().zip(&self.values) {
            *out = values[samples - 1];
        }
    }
}

impl Block {
    pub(crate) fn new(system: &System) -> Self {
        let lanes = system.degrees_of_freedom().div_ceil(WIDTH);
        let levels = system.levels().len();
        let sections = system.sections().len().div_ceil(WIDTH);
        let zeros = || vec![Lane::ZERO; lanes];
        Self {
            end: Modal::new(lanes),
            displacement: vec![Lane::ZERO; lanes * BLOCK],
            acceleration: vec![Lane::ZERO; lanes * BLOCK],
            watched: None,
            size: vec![Lane::ZERO; lanes],
            floors: Extremes::new(lanes),
            drifts: Extremes::new(lanes),
            levels: Extremes::new(levels.div_ceil(WIDTH)),
            between: system.levels().iter().map(|l| (l.left, l.right)).collect(),
            accelerations: Extremes::new(lanes),
            sections: Extremes::new(sections),
            over: [zeros(), zeros(), zeros(), vec![Lane::ZERO; sections]],
            own: [false; 4],
            largest: (0.0, 0.0),
            modal: zeros(),
        }
    }
}

impl Block {
    /// For what never takes blocks.
    pub(crate) fn none() -> Self {
        let extremes = || Extremes::new(0);
        Self {
            end: Modal::new(0),
            displacement: Vec::new(),
            acceleration: Vec::new(),
            watched: None,
            size: Vec::new(),
            floors: extremes(),
            drifts: extremes(),
            levels: extremes(),
            between: Vec::new(),
            accelerations: extremes(),
            sections: extremes(),
            over: std::array::from_fn(|_| Vec::new()),
            own: [false; 4],
            largest: (0.0, 0.0),
            modal: Vec::new(),
        }
    }

    /// Keeps the whole motion at every sample from now on.
    pub(crate) fn watch(&mut self) {
        if self.watched.is_none() {
            let zeros = || vec![Lane::ZERO; self.displacement.len()];
            self.watched = Some([zeros(), zeros(), zeros()]);
        }
    }

    /// Motion of the modes after so many samples, at least one, if it was kept.
    pub(super) fn motion_after(&self, samples: usize) -> Option<ModalState<'_>> {
        let lanes = self.size.len();
        let range = (samples - 1) * lanes..samples * lanes;
        let [velocity, input, viscous] = self.watched.as_ref()?;
        Some(ModalState {
            displacement: &self.displacement[range.clone()],
            velocity: &velocity[range.clone()],
            input: &input[range.clone()],
            viscous: &viscous[range],
        })
    }

    /// Values and extremes of one of the floors' functions.
    pub(crate) fn values(&self, quantity: Quantity) -> &Extremes {
        match quantity {
            Quantity::Displacement => &self.floors,
            Quantity::Drift => &self.drifts,
            Quantity::Acceleration => &self.accelerations,
            Quantity::SectionForce => &self.sections,
        }
    }
}

/// Advances a block of samples, whose ground accelerations are `samples` (one more than
/// steps), and finds the extremes of all rows at the samples: those of accelerations only if
/// these are not all below `peak`, their peaks. Returns whether they are.
#[vectorised]
pub(crate) fn propagate(
    constants: &ContactFree,
    now: &Modal,
    samples: &[f64; BLOCK + 1],
    peak: &[Lane],
    block: &mut Block,
) -> bool {
    let count = constants.modes.len();
    advance_all(constants, now, samples, block);
    let large = count > LARGE;
    bound_overshoots(constants, block, [0, 1], large);
    let low = is_low(constants, (&block.over[0], block.largest.0), peak);
    if !low {
        bound_overshoots(constants, block, [2], large);
    }
    rows(&constants.floor_rows, block, !low);
    if !constants.section_rows.is_empty() {
        bound_sections(constants, block);
        for (c, row) in constants.section_rows.iter().enumerate() {
            let sums = products(row, &block.displacement, count);
            block.sections.top[c] = maximum(&sums);
            block.sections.values[c] = sums;
        }
    }
    drifts(&constants.above, &block.floors, &mut block.drifts);
    levels(&block.between, &block.floors, &mut block.levels);
    low
}

/// Bounds the overshoot of displacement (0), drift (1) or acceleration (2) at each floor by
/// itself. Returns false if that was done.
#[vectorised]
pub(crate) fn sharpen(constants: &ContactFree, block: &mut Block, quantity: usize) -> bool {
    let coarse = !block.own[quantity];
    if coarse {
        bound_overshoots(constants, block, [quantity], false);
    }
    coarse
}

/// Bounds overshoots over the block, for all floors of a building `together` or for each.
#[inline(always)]
pub(crate) fn bound_overshoots<const COUNT: usize>(
    constants: &ContactFree,
    block: &mut Block,
    quantities: [usize; COUNT],
    together: bool,
) {
    let (size, modal) = (&block.size, &mut block.modal);
    if quantities[0] < 2 {
        modal_overshoots(constants, size, block.largest.0, modal);
    } else {
        modal_acceleration_overshoots(constants, size, block.largest, modal);
    }
    for quantity in quantities {
        let (shapes, entries) = match quantity {
            1 => (&constants.drift_magnitudes, &constants.rows.drift_size),
            _ => (&constants.magnitudes, &constants.rows.size),
        };
        let over = &mut block.over[quantity];
        block.own[quantity] = !together;
        if !together {
            to_floors(shapes, modal, over);
            continue;
        }
        bound_together(shapes, entries, modal, over);
    }
}

/// A bound for all floors of a building together, from those of the modes.
#[inline(always)]
fn bound_together(shapes: &[Shapes], entries: &[Lane], modal: &[Lane], over: &mut [Lane]) {
    for building in shapes {
        let range = building.first_mode..building.first_mode + building.modes;
        let terms = range.clone().map(|j| at(entries, j) * at(modal, j));
        let bound = terms.sum::<f64>();
        for i in range {
            over[i / WIDTH][i % WIDTH] = bound;
        }
    }
}

/// Bounds overshoots of the forces in sections over the block.
#[inline(always)]
fn bound_sections(constants: &ContactFree, block: &mut Block) {
    let modal = &mut block.modal;
    modal_overshoots(constants, &block.size, block.largest.0, modal);
    block.own[Quantity::SectionForce as usize] = true;
    let over = &mut block.over[Quantity::SectionForce as usize];
    for (over, rows) in over.iter_mut().zip(&constants.section_rows) {
        let mut sum = Lane::ZERO;
        for (j, column) in rows.columns.iter().enumerate() {
            let x = at(modal, rows.first_mode + j);
            for l in 0..WIDTH {
                sum[l] += column[l].abs() * x;
            }
        }
        *over = sum;
    }
}

/// Advances these lanes of the modes alone by some samples.
#[vectorised]
pub(crate) fn advance(
    constants: &ContactFree,
    (lanes, samples): (Range<usize>, &[f64]),
    now: &mut Modal,
) {
    for c in lanes {
        let m = &constants.modes[c];
        let mut state = [
            now.displacement[c],
            now.velocity[c],
            now.input[c],
            now.viscous[c],
        ];
        for pair in samples.windows(2) {
            let ground = Ground {
                start: pair[0],
                end: pair[1],
                slope: (pair[1] - pair[0]) / constants.step,
            };
            (state, _) = step_modes::<false>(m, state, ground);
        }
        [
            now.displacement[c],
            now.velocity[c],
            now.input[c],
            now.viscous[c],
        ] = state;
    }
}

/// Advances displacements and velocities by one step with these constants. Returns the work of
/// ground motion and that of damping (J).
#[vectorised]
pub(crate) fn step_over(
    modes: &[ModeLanes],
    ground: Ground,
    displacement: &mut [Lane],
    velocity: &mut [Lane],
) -> (f64, f64) {
    let (mut input, mut viscous) = (Lane::ZERO, Lane::ZERO);
    for (c, m) in modes.iter().enumerate() {
        let state = [displacement[c], velocity[c], input, viscous];
        let ([q, p, pushed, damped], _) = step_modes::<false>(m, state, ground);
        (displacement[c], velocity[c]) = (q, p);
        (input, viscous) = (pushed, damped);
    }
    (input.0.iter().sum(), viscous.0.iter().sum())
}

/// Follows a block from this state on for those who watch it.
#[vectorised]
pub(crate) fn follow(
    constants: &ContactFree,
    start: &Modal,
    samples: &[f64; BLOCK + 1],
    block: &mut Block,
) {
    let count = constants.modes.len();
    let Some([velocities, inputs, dampings]) = &mut block.watched else {
        return;
    };
    for (c, m) in constants.modes.iter().enumerate() {
        let mut state = [
            start.displacement[c],
            start.velocity[c],
            start.input[c],
            start.viscous[c],
        ];
        for (s, pair) in samples.windows(2).enumerate() {
            let ground = Ground {
                start: pair[0],
                end: pair[1],
                slope: (pair[1] - pair[0]) / constants.step,
            };
            (state, _) = step_modes::<false>(m, state, ground);
            let place = s * count + c;
            block.displacement[place] = state[0];
            velocities[place] = state[1];
            inputs[place] = state[2];
            dampings[place] = state[3];
        }
    }
}

/// Bounds what the displacement of every floor may exceed its values at samples by (m), from this
/// motion on under these ground accelerations at samples; the others are space for the modes.
#[vectorised]
pub(crate) fn bound_displacements(
    constants: &ContactFree,
    start: ModalState<'_>,
    samples: &[f64],
    [over, size, modal]: [&mut [Lane]; 3],
) {
    let largest = samples.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    let length = (samples.len() - 1) as f64 * constants.step;
    // Accelerations are bounded by `sqrt(q'^2 + omega^2 q^2)`, which is no larger than this sum
    // now, and later by no more than what the ground can add until then.
    for (c, m) in constants.modes.iter().enumerate() {
        lane_by_lane();
        size[c] = Lane::from_fn(|l| {
            start.velocity[c][l].abs()
                + m.circular_frequency[l] * start.displacement[c][l].abs()
                + m.participation[l].abs() * length * largest
        });
    }
    modal_overshoots(constants, size, largest, modal);
    bound_together(&constants.magnitudes, &constants.rows.size, modal, over);
}

/// All modes over the block, whose ground accelerations are `samples`.
#[inline(always)]
pub(crate) fn advance_all(
    constants: &ContactFree,
    now: &Modal,
    samples: &[f64; BLOCK + 1],
    block: &mut Block,
) {
    match (block.watched.is_some(), constants.swings) {
        (true, true) => advance_each::<true, true>(constants, now, samples, block),
        (true, false) => advance_each::<true, false>(constants, now, samples, block),
        (false, true) => advance_each::<false, true>(constants, now, samples, block),
        (false, false) => advance_each::<false, false>(constants, now, samples, block),
    }
    let largest = samples.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    let slope = samples
        .windows(2)
        .fold(0.0_f64, |m, pair| m.max((pair[1] - pair[0]).abs()));
    block.largest = (largest, slope / constants.step);
}

/// The same; if the modes are watched, the whole motion at every sample is kept.
#[inline(always)]
fn advance_each<const WATCHED: bool, const SWINGS: bool>(
    constants: &ContactFree,
    now: &Modal,
    samples: &[f64; BLOCK + 1],
    block: &mut Block,
) {
    let count = constants.modes.len();
    let (displacements, accelerations) = (&mut block.displacement, &mut block.acceleration);
    for (c, m) in constants.modes.iter().enumerate() {
        let state = [
            now.displacement[c],
            now.velocity[c],
            now.input[c],
            now.viscous[c],
        ];
        let watched = &mut block.watched;
        let store = |s: usize, motion: [Lane; 4], a: Lane| {
            let [q, p, input, viscous] = motion;
            displacements[s * count + c] = q;
            accelerations[s * count + c] = a;
            if WATCHED && let Some([velocities, inputs, dampings]) = watched {
                velocities[s * count + c] = p;
                inputs[s * count + c] = input;
                dampings[s * count + c] = viscous;
            }
        };
        let (end, size) = modes::<SWINGS>(m, state, samples, constants.step, store);
        block.size[c] = size;
        let [q, p, input, viscous] = end;
        (block.end.displacement[c], block.end.velocity[c]) = (q, p);
        (block.end.input[c], block.end.viscous[c]) = (input, viscous);
    }
}

/// Eight modes over the block. Returns state and works at the end, and the maximum
/// size at the starts of the steps.
#[inline(always)]
fn modes<const SWINGS: bool>(
    m: &ModeLanes,
    start: [Lane; 4],
    samples: &[f64; BLOCK + 1],
    step: f64,
    mut store: impl FnMut(usize, [Lane; 4], Lane),
) -> ([Lane; 4], Lane) {
    let mut state = start;
    let mut largest = Lane::ZERO;
    for s in 0..BLOCK {
        let (start, end) = (samples[s], samples[s + 1]);
        let ground = Ground {
            start,
            end,
            slope: (end - start) / step,
        };
        let (next, size) = step_modes::<SWINGS>(m, state, ground);
        state = next;
        let [q, p, ..] = state;
        let mut absolute = Lane::ZERO;
        for l in 0..WIDTH {
            absolute[l] = -(m.damping[l] * p[l] + m.stiffness[l] * q[l]);
            largest[l] = if size[l] > largest[l] {
                size[l]
            } else {
                largest[l]
            };
        }
        store(s, state, absolute);
    }
    (state, largest)
}

/// Floor displacements over the block and their extremes, and the same of accelerations if
/// they are wanted, lane after lane of floors: the columns of one stay in the cache.
#[inline(always)]
fn rows(rows: &[Rows], block: &mut Block, accelerations: bool) {
    let count = rows.len();
    for (c, row) in rows.iter().enumerate() {
        let sums = products(row, &block.displacement, count);
        block.floors.top[c] = maximum(&sums);
        block.floors.values[c] = sums;
        if accelerations {
            let sums = products(row, &block.acceleration, count);
            block.accelerations.top[c] = maximum(&sums);
            block.accelerations.values[c] = sums;
        }
    }
}

/// A lane of floors at so many times, `stride` lanes of modes from one to the next.
#[inline(always)]
pub(crate) fn products<const TIMES: usize>(
    row: &Rows,
    modal: &[Lane],
    stride: usize,
) -> [Lane; TIMES] {
    let mut sums = [Lane::ZERO; TIMES];
    let (mut lane, mut place) = (row.first_mode / WIDTH, row.first_mode % WIDTH);
    let mut columns = row.columns.as_slice();
    while !columns.is_empty() {
        let (now, later) = columns.split_at(columns.len().min(WIDTH - place));
        let modes: [&Lane; TIMES] = std::array::from_fn(|s| &modal[s * stride + lane]);
        for (place, column) in (place..WIDTH).zip(now) {
            for s in 0..TIMES {
                let x = modes[s][place];
                for l in 0..WIDTH {
                    sums[s][l] += column[l] * x;
                }
            }
        }
        (columns, lane, place) = (later, lane + 1, 0);
    }
    sums
}

/// Maximum magnitudes of eight lanes.
#[inline(always)]
fn maximum(values: &[Lane; BLOCK]) -> Lane {
    let mut most = Lane::ZERO;
    for value in values {
        for l in 0..WIDTH {
            let value = value[l].abs();
            most[l] = if value > most[l] { value } else { most[l] };
        }
    }
    most
}

/// Storey drifts from floor displacements; `above` is one where a floor has another one
/// below it.
#[inline(always)]
fn drifts(above: &[Lane], floors: &Extremes, out: &mut Extremes) {
    let mut last = [0.0; BLOCK];
    for (c, above) in above.iter().enumerate() {
        let mut drifts = [Lane::ZERO; BLOCK];
        for s in 0..BLOCK {
            let u = floors.values[c][s];
            let mut below = [last[s]; WIDTH];
            below[1..].copy_from_slice(&u.0[..WIDTH - 1]);
            last[s] = u[WIDTH - 1];
            for l in 0..WIDTH {
                drifts[s][l] = u[l] - above[l] * below[l];
            }
        }
        out.top[c] = maximum(&drifts);
        out.values[c] = drifts;
    }
}

/// Closings of levels from floor displacements, one level after another.
#[inline(always)]
fn levels(between: &[(Option<usize>, Option<usize>)], floors: &Extremes, out: &mut Extremes) {
    let at = |s: usize, floor: Option<usize>| match floor {
        Some(i) => floors.values[i / WIDTH][s][i % WIDTH],
        None => 0.0,
    };
    for (l, (left, right)) in between.iter().enumerate() {
        let mut most = f64::NEG_INFINITY;
        for s in 0..BLOCK {
            let closing = at(s, *left) - at(s, *right);
            most = if closing > most { closing } else { most };
            out.values[l / WIDTH][s][l % WIDTH] = closing;
        }
        out.top[l / WIDTH][l % WIDTH] = most;
    }
}
