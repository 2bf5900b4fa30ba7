//! Blocks whose floors are worked out at both ends alone, with their rates: a product with all mode
//! shapes for every sample would cost the square of the storeys.
//!
//! Inside, a floor is the cubic through both ends, which lies within the hull of its Bernstein
//! coefficients, and what its modes depart from theirs. That is bounded by the exact step over
//! the block ([`crate::system::modes::BlockStep`]), or, where there is none, by the largest departure at a
//! sample and the overshoot between samples. What stays below its peak by this bound has no
//! higher one in the block. The rest is put off, eight floors together, and looked at from the
//! state at the start of the block ([`super::lane_candidates`]).

use pounding_vectorised::vectorised;

use crate::bands::Bands;
use crate::contact::Contacts;
use crate::system::System;
use crate::system::modes::{
    BLOCK, Block, BlockLoad, BlockStep, Bounds, ContactFree, Lane, MadeLoad, Modal, OneLane,
    QUANTITIES, Quantity, Reach, STRIP, SinglePrecisionModes, Track, WIDTH, add, advance_all,
    bound_overshoots, is_low, lane_by_lane, modal_acceleration_overshoots, rows_of_four,
    rows_of_two, scale, spread, transform_four, transform_two,
};

/// Bernstein coefficients of a cubic.
const CUBIC: usize = 4;

/// Displacement and absolute acceleration at an end of the block, each followed by a third of the
/// block times its rate.
type End = [Vec<Lane>; 4];

/// Work space.
#[derive(Debug, Clone)]
pub(super) struct BlockEnds {
    /// Whether the mode shapes stay in the cache by themselves.
    small: bool,
    /// Of the modes at one end, and of the floors at both.
    modes: End,
    start: End,
    end: End,
    /// Whether displacements, and accelerations, at the start are those of the present time.
    holds: [bool; 2],
    /// How far the modes depart from their cubics.
    bounds: Bounds,
    /// What the accelerations of a block do, where it is not at hand.
    load: MadeLoad,
    /// What displacement, drift and absolute acceleration of every floor may exceed the hull by,
    /// and absolute acceleration what the ground's is at the ends.
    beyond: [Vec<Lane>; QUANTITIES],
    buildings: Vec<Reach>,
    one_lane: Option<OneLane>,
    /// What could have a peak in the block.
    suspects: Vec<Suspect>,
    bands: Option<ByBands>,
}

/// Floors of tall buildings in single precision ([`crate::system::modes::SinglePrecisionModes`]), and their absolute
/// accelerations from these displacements and velocities, where stiffness and damping are
/// tridiagonal: a product with the mode shapes less. Peaks are taken from the modes alone.
#[derive(Debug, Clone)]
struct ByBands {
    modes: SinglePrecisionModes,
    /// Bounds of what displacement (m), and a third of the block times velocity (m), err by at
    /// either end.
    errors: [[f64; 2]; 2],
    /// Of all floors, one after another, with a zero before and after them: displacement,
    /// velocity, and acceleration relative to the ground.
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
    /// Absolute acceleration and its rate.
    absolute: Vec<f64>,
    rate: Vec<f64>,
    /// Maximum sums of magnitudes in a row of stiffness and of damping, by the masses.
    rows: [f64; 2],
    /// Bound of what absolute accelerations, and thirds of the block times their rates, err by at
    /// either end (m/s2).
    lost: [f64; 2],
}

/// Part of the largest terms of an acceleration that is lost in round-off, at most: some thousand
/// units in the last place.
const ROUND_OFF: f64 = 1.0e-12;

/// Eight floors of which a function could have a peak in a block, with its bounds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Suspect {
    pub quantity: Quantity,
    pub lane: usize,
    pub upper: Lane,
}

impl BlockEnds {
    pub(super) fn new(constants: &ContactFree) -> Self {
        let (dofs, lanes) = (constants.building.len(), constants.modes.len());
        let zeros = || vec![Lane::ZERO; lanes];
        let end = || std::array::from_fn(|_| zeros());
        let buildings = Reach::of_buildings(&constants.shapes, &constants.rows);
        Self {
            small: constants.bands.is_none() && constants.shapes.iter().all(|b| b.modes <= STRIP),
            modes: end(),
            start: end(),
            end: end(),
            holds: [false; 2],
            bounds: Bounds::new(lanes),
            load: constants
                .block_step
                .as_ref()
                .map_or_else(MadeLoad::default, BlockStep::space),
            beyond: std::array::from_fn(|_| zeros()),
            one_lane: OneLane::of(lanes, &buildings),
            buildings,
            suspects: Vec::with_capacity(3 * lanes),
            bands: constants.bands.as_ref().map(|bands| ByBands {
                modes: SinglePrecisionModes::new(lanes),
                errors: [[0.0; 2]; 2],
                displacement: vec![0.0; dofs + 2],
                velocity: vec![0.0; dofs + 2],
                acceleration: vec![0.0; dofs + 2],
                absolute: vec![0.0; dofs],
                rate: vec![0.0; dofs],
                rows: bands.largest_rows(),
                lost: [0.0; 2],
            }),
        }
    }

    /// Forgets the floors: the motion goes on from elsewhere.
    pub(super) fn forget(&mut self) {
        self.holds = [false; 2];
    }

    /// Advances the modes over a block of samples, whose ground accelerations are `samples`, and
    /// the floors to its end. Returns whether no acceleration can be a peak, so that they are not
    /// worked out.
    #[inline]
    pub(super) fn advance(
        &mut self,
        constants: &ContactFree,
        now: &Modal,
        (samples, load): (&[f64; BLOCK + 1], Option<BlockLoad<'_>>),
        peak: &[Lane],
        block: &mut Block,
    ) -> bool {
        if self.bands.is_some() && !self.holds[0] {
            self.approach_end(constants, [&now.displacement, &now.velocity]);
            self.work_out_approximate_end(constants);
            self.go_on();
            self.holds = [true, false];
        }
        let low = match &constants.block_step {
            Some(step) => {
                if load.is_none() {
                    step.load(samples, &mut self.load);
                }
                self.step_over((step, now), (samples, load), &mut block.end);
                self.approach_end(constants, [&block.end.displacement, &block.end.velocity]);
                bound_all((samples[0], samples[BLOCK]), load, peak, self)
            }
            None => advance_modes(constants, (now, samples), peak, block, self),
        };
        if self.bands.is_some() {
            self.work_out_approximate_end(constants);
            if !low {
                self.accelerate_ends(constants, [samples[0], samples[BLOCK]]);
            }
            return low;
        }
        let (q, p) = (&now.displacement, &now.velocity);
        if !(self.holds[0] && (low || self.holds[1])) {
            self.work_out_end(constants, (q, p, samples[0]), low);
            self.go_on();
        }
        let (q, p) = (&block.end.displacement, &block.end.velocity);
        self.work_out_end(constants, (q, p, samples[BLOCK]), low);
        low
    }

    /// Takes displacements and velocities of the modes at the end over in single precision, where
    /// floors are worked out by that.
    fn approach_end(&mut self, constants: &ContactFree, modes: [&[Lane]; 2]) {
        if let (Some(shapes), Some(bands)) = (&constants.single_precision, &mut self.bands) {
            bands.errors[1] = shapes.take(modes, third(constants), &mut bands.modes);
        }
    }

    /// Works out the floors at the end from the modes that were taken over.
    fn work_out_approximate_end(&mut self, constants: &ContactFree) {
        if let (Some(shapes), Some(bands)) = (&constants.single_precision, &self.bands) {
            let [displacement, rate, _, _] = &mut self.end;
            shapes.floors(&bands.modes, [displacement, rate]);
        }
    }

    /// Absolute accelerations with their rates at the end, and at the start unless they are known,
    /// under these accelerations of the ground.
    fn accelerate_ends(&mut self, constants: &ContactFree, ground: [f64; 2]) {
        let (Some(bands), Some(work)) = (&constants.bands, &mut self.bands) else {
            return;
        };
        let third = third(constants);
        for (end, known) in [(0, self.holds[1]), (1, false)] {
            if !known {
                let floors = match end {
                    0 => &mut self.start,
                    _ => &mut self.end,
                };
                work.lost[end] =
                    accelerate(bands, (work.errors[end], third), ground[end], work, floors);
            }
        }
    }

    /// Advances the modes by one step over the block, whose load is at hand or was worked out.
    fn step_over(
        &mut self,
        (step, now): (&BlockStep, &Modal),
        (samples, load): (&[f64; BLOCK + 1], Option<BlockLoad<'_>>),
        end: &mut Modal,
    ) {
        let load = load.unwrap_or(self.load.view());
        let ends = (samples[0], samples[BLOCK]);
        let bounds = &mut self.bounds;
        step.advance((now, ends), load, (end, bounds));
    }

    /// Works out the floors, from these displacements and velocities of the modes and this
    /// ground acceleration.
    fn work_out_end(
        &mut self,
        constants: &ContactFree,
        (q, p, ground): (&[Lane], &[Lane], f64),
        low: bool,
    ) {
        derive_end(constants, (q, p, ground), low, &mut self.modes);
        let [_, rate, absolute, absolute_rate] = &self.modes;
        let (shapes, rows) = (&constants.shapes, &constants.floor_rows);
        match (self.small, low) {
            (true, true) => rows_of_two(rows, [q, rate], &mut self.end),
            (true, false) => rows_of_four(rows, [q, rate, absolute, absolute_rate], &mut self.end),
            (false, true) => transform_two(shapes, [q, rate], &mut self.end),
            (false, false) => {
                transform_four(shapes, [q, rate, absolute, absolute_rate], &mut self.end)
            }
        }
    }

    /// Makes the end the start.
    fn go_on(&mut self) {
        std::mem::swap(&mut self.start, &mut self.end);
        if let Some(bands) = &mut self.bands {
            bands.lost.swap(0, 1);
            bands.errors.swap(0, 1);
        }
    }

    /// Whether no gap can close in the block.
    #[inline]
    pub(super) fn is_open(&self, system: &System, contacts: &Contacts) -> bool {
        let mut least = f64::INFINITY;
        for width in contacts.widths() {
            // Widths are numbers: what `f64::min` does about others would cost as much as the rest.
            least = if *width < least { *width } else { least };
        }
        if are_within(0.5 * least, self) {
            return true;
        }
        system.levels().iter().enumerate().all(|(l, level)| {
            let (left, over) = self.hull_of(level.left);
            let (right, under) = self.hull_of(level.right);
            let mut most = f64::NEG_INFINITY;
            for k in 0..CUBIC {
                most = most.max(left[k] - right[k]);
            }
            most + (over + under) <= contacts.width(l)
        })
    }

    /// Coefficients of a floor's displacement, and what it may exceed their hull by; none of a wall.
    #[inline(always)]
    fn hull_of(&self, floor: Option<usize>) -> ([f64; CUBIC], f64) {
        let Some(i) = floor else {
            return ([0.0; CUBIC], 0.0);
        };
        let (c, l) = (i / WIDTH, i % WIDTH);
        let (a, b) = (self.start[0][c][l], self.end[0][c][l]);
        let (out, back) = (self.start[1][c][l], self.end[1][c][l]);
        ([a, a + out, b - back, b], self.beyond[0][c][l])
    }

    /// Whether the floors that are worked out are those of the modes in double precision.
    pub(super) fn is_exact(&self) -> bool {
        self.bands.is_none()
    }

    /// What displacements of floors, and their rates, err by together (m).
    fn error(&self) -> f64 {
        let of = |bands: &ByBands| {
            let [start, end] = bands.errors.map(|[value, rate]| value + rate);
            start.max(end)
        };
        self.bands.as_ref().map_or(0.0, of)
    }

    /// Takes the floors at the end, at this time (s), as present ones and as peaks, and finds
    /// what could have higher peaks in the block: of floors that are not those of the modes, what
    /// their peaks are sure to reach.
    #[inline]
    pub(super) fn take_end(
        &mut self,
        constants: &ContactFree,
        tracks: [&mut Track; 3],
        (time, low): (f64, bool),
    ) -> &[Suspect] {
        compare(constants, self, tracks, (time, low));
        self.go_on();
        self.holds = [true, !low];
        &self.suspects
    }
}

/// Advances all modes and bounds what floors may exceed the hull by. Returns whether no
/// acceleration can be a peak.
#[vectorised]
fn advance_modes(
    constants: &ContactFree,
    (now, samples): (&Modal, &[f64; BLOCK + 1]),
    peak: &[Lane],
    block: &mut Block,
    ends: &mut BlockEnds,
) -> bool {
    advance_all(constants, now, samples, block);
    let end = &block.end;
    ends.approach_end(constants, [&end.displacement, &end.velocity]);
    bound_overshoots(constants, block, [0], true);
    let low = is_low(constants, (&block.over[0], block.largest.0), peak);
    deviate(constants, (now, samples), block, low, ends);
    add_all(&block.modal, &mut ends.bounds.displacement);
    if !low {
        let (size, modal) = (&block.size, &mut block.modal);
        modal_acceleration_overshoots(constants, size, block.largest, modal);
        add_all(modal, &mut ends.bounds.acceleration);
    }
    bound_floors(ends, None);
    low
}

/// Bounds what floors may exceed the hull by, where the modes are bounded. Returns whether no
/// acceleration can be a peak, under a ground that has these accelerations at the ends.
#[vectorised]
fn bound_all(
    ground: (f64, f64),
    load: Option<BlockLoad<'_>>,
    peak: &[Lane],
    ends: &mut BlockEnds,
) -> bool {
    bound_floors(ends, load);
    // Under the line a building moves as the ground does.
    let line = ground.0.abs().max(ground.1.abs());
    let mut low = true;
    for (most, peak) in ends.beyond[3].iter().zip(peak) {
        for l in 0..WIDTH {
            low &= line + most[l] <= peak[l];
        }
        if !low {
            break;
        }
    }
    low
}

/// What floors may exceed the hull by, for those of a building together: by the motion of the modes,
/// and by what the accelerations add, if that is apart.
#[inline(always)]
fn bound_floors(ends: &mut BlockEnds, load: Option<BlockLoad<'_>>) {
    let added = load.unwrap_or(ends.load.view()).bounds;
    if let Some(one_lane) = &ends.one_lane {
        let bounds = one_lane.bounds(&ends.bounds, added);
        for (beyond, bound) in ends.beyond.iter_mut().zip(bounds) {
            beyond[0] = bound;
        }
        return;
    }
    let error = ends.error();
    let mut made = 0;
    for (index, building) in ends.buildings.iter().enumerate() {
        let mut sums = building.sums(&ends.bounds);
        if let Some(added) = added.get(index) {
            for (sum, added) in sums.iter_mut().zip(added) {
                *sum += added;
            }
        }
        sums[0] += error;
        // A drift is a difference.
        sums[1] += 2.0 * error;
        for (bound, beyond) in sums.into_iter().zip(&mut ends.beyond) {
            let lanes = beyond[building.lane..].iter_mut().zip(&building.own);
            for (c, (beyond, own)) in lanes.enumerate() {
                lane_by_lane();
                let bound = scale(bound, *own);
                // A lane of the building before ends with floors of this one.
                let shared = building.lane + c < made;
                *beyond = if shared { add(*beyond, bound) } else { bound };
            }
        }
        made = building.lane + building.own.len();
    }
}

#[inline(always)]
fn add_all(more: &[Lane], to: &mut [Lane]) {
    for (to, more) in to.iter_mut().zip(more) {
        lane_by_lane();
        for l in 0..WIDTH {
            to[l] += more[l];
        }
    }
}

/// Bernstein polynomials of degree 3 at the samples inside a block.
const BERNSTEIN: [[f64; CUBIC]; BLOCK - 1] = {
    let mut weights = [[0.0; CUBIC]; BLOCK - 1];
    let mut k = 0;
    while k < BLOCK - 1 {
        let x = (k + 1) as f64 / BLOCK as f64;
        let y = 1.0 - x;
        weights[k] = [y * y * y, 3.0 * x * y * y, 3.0 * x * x * y, x * x * x];
        k += 1;
    }
    weights
};

/// Maximum deviations of the modes from the cubics through values and rates at both ends.
#[inline(always)]
fn deviate(
    constants: &ContactFree,
    (now, samples): (&Modal, &[f64; BLOCK + 1]),
    block: &Block,
    low: bool,
    ends: &mut BlockEnds,
) {
    let third = third(constants);
    let count = constants.modes.len();
    let (displacement, acceleration) =
        (&mut ends.bounds.displacement, &mut ends.bounds.acceleration);
    for (c, m) in constants.modes.iter().enumerate() {
        let ends = [
            (now.displacement[c], now.velocity[c], samples[0]),
            (
                block.end.displacement[c],
                block.end.velocity[c],
                samples[BLOCK],
            ),
        ];
        let mut cubic = [Lane::ZERO; CUBIC];
        for l in 0..WIDTH {
            let [(a, va, _), (b, vb, _)] = ends;
            cubic[0][l] = a[l];
            cubic[1][l] = a[l] + third * va[l];
            cubic[2][l] = b[l] - third * vb[l];
            cubic[3][l] = b[l];
        }
        displacement[c] = farthest_from(&cubic, |k| &block.displacement[k * count + c]);
        if low {
            continue;
        }
        for l in 0..WIDTH {
            let [first, last] = ends.map(|(q, p, ground)| {
                let absolute = -(m.damping[l] * p[l] + m.stiffness[l] * q[l]);
                let relative = absolute - m.participation[l] * ground;
                let rate = -(m.damping[l] * relative + m.stiffness[l] * p[l]);
                (absolute, third * rate)
            });
            cubic[0][l] = first.0;
            cubic[1][l] = first.0 + first.1;
            cubic[2][l] = last.0 - last.1;
            cubic[3][l] = last.0;
        }
        acceleration[c] = farthest_from(&cubic, |k| &block.acceleration[k * count + c]);
    }
}

/// Maximum distance of values at the samples inside a block from a cubic.
#[inline(always)]
fn farthest_from<'a>(cubic: &[Lane; CUBIC], value: impl Fn(usize) -> &'a Lane) -> Lane {
    let mut most = Lane::ZERO;
    for (k, weights) in BERNSTEIN.iter().enumerate() {
        let value = value(k);
        for l in 0..WIDTH {
            let (a, b) = (
                weights[0] * cubic[0][l] + weights[1] * cubic[1][l],
                weights[2] * cubic[2][l] + weights[3] * cubic[3][l],
            );
            let distance = (value[l] - (a + b)).abs();
            most[l] = if distance > most[l] {
                distance
            } else {
                most[l]
            };
        }
    }
    most
}

/// A third of the block (s).
fn third(constants: &ContactFree) -> f64 {
    BLOCK as f64 * constants.step / 3.0
}

/// What is transformed to floors beside displacements, or thirds of speeds alone.
#[vectorised]
fn derive_end(
    constants: &ContactFree,
    (displacement, velocity, ground): (&[Lane], &[Lane], f64),
    speeds_alone: bool,
    modes: &mut End,
) {
    let third = third(constants);
    let count = constants.modes.len();
    let [_, rates, absolutes, absolute_rates] = modes.each_mut().map(|modes| &mut modes[..count]);
    let (displacement, velocity) = (&displacement[..count], &velocity[..count]);
    if speeds_alone {
        for (rate, p) in rates.iter_mut().zip(velocity) {
            lane_by_lane();
            for l in 0..WIDTH {
                rate[l] = third * p[l];
            }
        }
        return;
    }
    for (c, m) in constants.modes.iter().enumerate() {
        lane_by_lane();
        let (q, p) = (&displacement[c], &velocity[c]);
        let mut out = [Lane::ZERO; 3];
        for l in 0..WIDTH {
            let absolute = -(m.damping[l] * p[l] + m.stiffness[l] * q[l]);
            let relative = absolute - m.participation[l] * ground;
            out[0][l] = third * p[l];
            out[1][l] = absolute;
            out[2][l] = third * -(m.damping[l] * relative + m.stiffness[l] * p[l]);
        }
        [rates[c], absolutes[c], absolute_rates[c]] = out;
    }
}

/// Absolute accelerations of all floors with their rates, from displacements and velocities that
/// err by at most this. Returns what they err by at most.
#[vectorised]
fn accelerate(
    bands: &Bands,
    ([error, third_error], third): ([f64; 2], f64),
    ground: f64,
    work: &mut ByBands,
    end: &mut End,
) -> f64 {
    let [displacements, rates, absolutes, absolute_rates] = end;
    let count = work.absolute.len();
    let slower = 1.0 / third;
    let (mut farthest, mut fastest) = (0.0_f64, 0.0_f64);
    let u = work.displacement[1..=count].chunks_mut(WIDTH);
    let v = work.velocity[1..=count].chunks_mut(WIDTH);
    for (((u, v), displacement), rate) in u.zip(v).zip(&*displacements).zip(&*rates) {
        let floors = u.iter_mut().zip(v).zip(displacement.0).zip(rate.0);
        for (((u, v), displacement), rate) in floors {
            (*u, *v) = (displacement, slower * rate);
            farthest = farthest.max(u.abs());
            fastest = fastest.max(v.abs());
        }
    }
    bands.resist(&work.displacement, &work.velocity, &mut work.absolute);
    for (a, absolute) in work.acceleration[1..].iter_mut().zip(&work.absolute) {
        *a = absolute - ground;
    }
    bands.resist(&work.velocity, &work.acceleration, &mut work.rate);
    for rate in &mut work.rate {
        *rate *= third;
    }
    spread(&work.absolute, absolutes);
    spread(&work.rate, absolute_rates);
    let [stiffness, damping] = work.rows;
    let speed_error = slower * third_error;
    let value = stiffness * error + damping * speed_error;
    let rate = stiffness * speed_error + damping * value;
    let lost = ROUND_OFF * (stiffness * farthest + damping * fastest);
    value + third * rate + lost
}

/// Whether the displacements of all floors in the block are at most this one (m); those that are
/// no numbers are not.
#[vectorised]
fn are_within(limit: f64, ends: &BlockEnds) -> bool {
    let (start, end) = (&ends.start, &ends.end);
    let mut all = true;
    for (c, beyond) in ends.beyond[0].iter().enumerate() {
        lane_by_lane();
        let floors = cubic([&start[0][c], &start[1][c], &end[0][c], &end[1][c]]);
        let upper = upper(&floors, beyond);
        for l in 0..WIDTH {
            all &= upper[l] <= limit;
        }
    }
    all
}

/// Compares the hulls of all functions with their peaks, after those at the end were taken.
#[vectorised]
fn compare(
    constants: &ContactFree,
    ends: &mut BlockEnds,
    [displacement, drift, acceleration]: [&mut Track; 3],
    at: (f64, bool),
) {
    if ends.bands.is_some() {
        compare_each::<true>(constants, ends, [displacement, drift, acceleration], at);
    } else {
        compare_each::<false>(constants, ends, [displacement, drift, acceleration], at);
    }
}

/// The same of floors that are known approximately, or exactly.
#[inline(always)]
fn compare_each<const APPROXIMATE: bool>(
    constants: &ContactFree,
    ends: &mut BlockEnds,
    [displacement, drift, acceleration]: [&mut Track; 3],
    (time, low): (f64, bool),
) {
    let error = if APPROXIMATE { ends.error() } else { 0.0 };
    let lost = ends.bands.as_ref().filter(|_| APPROXIMATE);
    let lost = lost.map_or(0.0, |bands| bands.lost[0].max(bands.lost[1]));
    let (start, end, suspects) = (&ends.start, &ends.end, &mut ends.suspects);
    suspects.clear();
    let mut last = [0.0; CUBIC];
    for (c, above) in constants.above.iter().enumerate() {
        let floors = cubic([&start[0][c], &start[1][c], &end[0][c], &end[1][c]]);
        let mut drifts = [Lane::ZERO; CUBIC];
        for k in 0..CUBIC {
            let u = floors[k];
            let mut below = [last[k]; WIDTH];
            below[1..].copy_from_slice(&u.0[..WIDTH - 1]);
            last[k] = u[WIDTH - 1];
            for l in 0..WIDTH {
                drifts[k][l] = u[l] - above[l] * below[l];
            }
        }
        let mut suspect = |quantity: Quantity, upper: Option<Lane>| {
            suspects.extend(upper.map(|upper| Suspect {
                quantity,
                lane: c,
                upper,
            }));
        };
        let [beyond, beyond_drift, beyond_acceleration, _] =
            ends.beyond.each_ref().map(|beyond| &beyond[c]);
        let take = |cubic, error, beyond, track: &mut Track| {
            if APPROXIMATE {
                approach_peak((cubic, error), beyond, (track, c))
            } else {
                take_end(cubic, beyond, (track, c), time)
            }
        };
        let upper = take(&floors, error, beyond, displacement);
        suspect(Quantity::Displacement, upper);
        let upper = take(&drifts, 2.0 * error, beyond_drift, drift);
        suspect(Quantity::Drift, upper);
        if low {
            continue;
        }
        let cubic = cubic([&start[2][c], &start[3][c], &end[2][c], &end[3][c]]);
        let mut beyond = *beyond_acceleration;
        if APPROXIMATE {
            beyond = beyond.map(|beyond| beyond + lost);
        }
        suspect(
            Quantity::Acceleration,
            take(&cubic, lost, &beyond, acceleration),
        );
    }
}

/// Bernstein coefficients from values and thirds of rates at both ends.
#[inline(always)]
fn cubic([a, third_a, b, third_b]: [&Lane; CUBIC]) -> [Lane; CUBIC] {
    let mut out = [*a, Lane::ZERO, Lane::ZERO, *b];
    for l in 0..WIDTH {
        out[1][l] = a[l] + third_a[l];
        out[2][l] = b[l] - third_b[l];
    }
    out
}

/// Takes the last coefficients as present values and as peaks at this time (s). Returns bounds
/// of the functions if one could still be above its peak.
#[inline(always)]
fn take_end(
    cubic: &[Lane; CUBIC],
    beyond: &Lane,
    (track, c): (&mut Track, usize),
    time: f64,
) -> Option<Lane> {
    let (peak, times) = (&mut track.peak[c], &mut track.time[c]);
    for l in 0..WIDTH {
        let value = cubic[CUBIC - 1][l].abs();
        let higher = value > peak[l];
        peak[l] = if higher { value } else { peak[l] };
        times[l] = if higher { time } else { times[l] };
    }
    track.now[c] = cubic[CUBIC - 1];
    unless_below(upper(cubic, beyond), peak)
}

/// Takes the last coefficients, which err by at most so much, as what peaks are sure to reach.
/// Returns bounds of the functions if one could still be above its peak.
#[inline(always)]
fn approach_peak(
    (cubic, error): (&[Lane; CUBIC], f64),
    beyond: &Lane,
    (track, c): (&mut Track, usize),
) -> Option<Lane> {
    let sure = &mut track.sure[c];
    for l in 0..WIDTH {
        let value = cubic[CUBIC - 1][l].abs() - error;
        sure[l] = if value > sure[l] { value } else { sure[l] };
    }
    unless_below(upper(cubic, beyond), &track.reach(c))
}

/// Bounds of functions in the block.
#[inline(always)]
fn upper(cubic: &[Lane; CUBIC], beyond: &Lane) -> Lane {
    let mut upper = Lane::ZERO;
    for l in 0..WIDTH {
        let mut top = 0.0;
        for coefficients in cubic {
            let size = coefficients[l].abs();
            top = if size <= top { top } else { size };
        }
        upper[l] = top + beyond[l];
    }
    upper
}

/// These bounds, if one is not below its peak.
#[inline(always)]
fn unless_below(upper: Lane, peak: &Lane) -> Option<Lane> {
    let mut all_below = true;
    for l in 0..WIDTH {
        all_below &= upper[l] <= peak[l];
    }
    (!all_below).then_some(upper)
}

/// The property that all of this rests on: peaks are those of evaluating every floor at every
/// sample, in blocks of [`crate::system::modes::block`], which know nothing of hulls. They have the same bits
/// where the modes go from sample to sample too.
#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pounding_gap_element::{ModelParameters, registry};
    use pounding_shear_building::{Damping, ShearBuilding};
    use proptest::prelude::*;

    use super::*;
    use crate::contact_free::candidates::Candidates;
    use crate::contact_free::{ContactFreePhase, EnergyAccounts, SampleRange};
    use crate::layout::Layout;
    use crate::observers::Observers;
    use crate::peaks::Peaks;
    use crate::system::modes::LevelRows;
    use crate::system::modes::constants::TALL;
    use crate::system::{Floor, GroundAcceleration};

    /// Two towers of these storeys with storeys of random mass and stiffness under so many steps of
    /// this length (s). Where `ratio` is one, all modes have the same damping ratio, so that its
    /// matrix is full.
    fn towers(
        storeys: [usize; 2],
        seed: f64,
        ratio: bool,
        gap: f64,
        (samples, step): (usize, f64),
    ) -> System {
        let vary = |i: usize, k: usize| libm::sin(seed + 12.9898 * i as f64 + 78.233 * k as f64);
        let building = |b: usize, count: usize| {
            let mass = (0..count).map(|i| 3.0e5 * (1.0 + 0.3 * vary(i, b)));
            let stiffness = (0..count).map(|i| 6.0e8 * (1.0 + 0.4 * vary(i, b + 2)));
            let damping = if ratio || count == 1 {
                Damping::Modal { ratios: vec![0.03] }
            } else {
                Damping::RayleighRatio {
                    ratio: 0.04,
                    modes: [1, 2],
                }
            };
            let (mass, stiffness) = (mass.collect(), stiffness.collect());
            let heights = vec![3.0; count];
            let name = format!("b{b}");
            Arc::new(ShearBuilding::new(name, mass, stiffness, heights, damping).unwrap())
        };
        let buildings = vec![building(0, storeys[0]), building(1, storeys[1])];
        // A swell of many frequencies that comes and goes.
        let ground = (0..=samples).map(|s| {
            let t = step * s as f64;
            let waves = (1..=12).map(|k| {
                let frequency = 2.3 * f64::from(k) * (1.0 + 0.1 * vary(k as usize, 7));
                libm::sin(frequency * t + 6.0 * vary(k as usize, 9))
            });
            let swell = (step * (samples - s) as f64).min(t).min(1.0);
            swell * waves.sum::<f64>()
        });
        under(buildings, (ground.collect(), step), gap)
    }

    /// Two buildings with gaps between all floors, under a ground of these samples.
    fn under(
        buildings: Vec<Arc<ShearBuilding>>,
        (samples, time_step): (Vec<f64>, f64),
        gap: f64,
    ) -> System {
        let storeys = [0, 1].map(|b: usize| buildings[b].storeys());
        let samples = Arc::new(samples);
        let mut system = System::new(buildings, GroundAcceleration { samples, time_step });
        let parameters = [("stiffness", 2.0e9), ("restitution", 0.65)];
        let parameters = ModelParameters::from_pairs(&parameters);
        let pairs = (0..storeys[0].min(storeys[1])).map(|i| {
            let model = registry::build("anagnostopoulos_2004", &parameters).unwrap();
            (Floor::Storey(0, i), Floor::Storey(1, i), gap, model.into())
        });
        let between = ["b0".to_owned(), "b1".to_owned()];
        system.add_gap("gap", between, pairs.collect()).unwrap();
        system
    }

    /// What is left behind by the samples without contact.
    struct Advanced {
        count: usize,
        /// Values and times of all peaks.
        peaks: Vec<(f64, f64)>,
        /// State with its works, and largest input and residual; penetrations; accelerations, if
        /// they are known.
        state: Vec<f64>,
        penetration: Vec<f64>,
        acceleration: Option<Vec<Lane>>,
    }

    impl Advanced {
        fn bits(&self) -> String {
            format!(
                "{:?} {:?} {:?} {:?}",
                self.peaks, self.state, self.penetration, self.acceleration
            )
        }
    }

    /// Advances as far as no gap can close, with constants that have a step over the block or not,
    /// by the ends of blocks or by all samples, and at most this far.
    fn advanced(system: &System, by_step: bool, by_ends: bool, to: usize) -> Advanced {
        let mut constants = system.contact_free().unwrap().clone();
        if !by_step {
            constants.block_step = None;
        }
        let constants = &constants;
        let mut phase = ContactFreePhase::new(constants, system);
        assert!(phase.ends.is_some() || !by_ends);
        if !by_ends {
            phase.ends = None;
            let functions = 3 * system.degrees_of_freedom();
            phase.candidates = Candidates::new((constants.modes.len(), functions), false, false);
        }
        let contacts = Contacts::all_open(system);
        let layout = Layout::of(system);
        let mut peaks = Peaks::new(layout, system);
        let mut state = vec![0.0; layout.dimension()];
        phase.take_state(constants, (system, &contacts), &peaks, &state);
        let range = SampleRange {
            system,
            contacts: &contacts,
            from: 0,
            to,
        };
        let mut largest_input = 0.0;
        let mut accounts = EnergyAccounts {
            state: &mut state,
            largest_input: &mut largest_input,
            residual: 0.0,
        };
        let rows = LevelRows::new(&constants.rows, system);
        let mut nobody = Observers::new(system, &mut [], 1.0e3);
        let watched = (&rows, &mut nobody);
        let count = phase.propagate(constants, &range, &mut accounts, watched);
        let residual = accounts.residual;
        let penetration = phase.penetration.clone();
        let acceleration = phase.acceleration.now.clone();
        phase.return_state(constants, system, &mut peaks, &mut state);
        phase.finish(constants, system, &mut peaks);
        let storeys = peaks.storeys.iter().flat_map(|s| {
            [
                s.displacement,
                s.drift_ratio,
                s.storey_shear,
                s.acceleration_absolute,
            ]
        });
        state.extend([largest_input, residual]);
        Advanced {
            count: count.unwrap(),
            peaks: storeys.map(|peak| (peak.value, peak.time)).collect(),
            state,
            penetration,
            acceleration: phase.acceleration_known.then_some(acceleration),
        }
    }

    fn largest(values: &[f64]) -> f64 {
        values.iter().fold(0.0, |m, x| m.max(x.abs()))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(12))]
        #[test]
        fn peaks_have_the_bits_of_every_floor_at_every_sample(
            storeys in [TALL..200, 2_usize..120],
            seed in 0.0..100.0,
            ratio in any::<bool>(),
            gap in prop_oneof![Just(1.0e3), 0.05..0.4],
            samples in 60_usize..700,
        ) {
            const STEP: f64 = 0.01;
            let system = towers(storeys, seed, ratio, gap, (samples, STEP));
            prop_assert_eq!(system.contact_free().unwrap().bands.is_some(), !ratio);
            let expected = advanced(&system, false, false, samples);
            let seen = advanced(&system, false, true, samples);
            prop_assert_eq!(seen.count, expected.count);
            prop_assert!(gap < 1.0 || seen.count == samples);
            prop_assert_eq!(&seen.state, &expected.state);
            prop_assert_eq!(&seen.penetration, &expected.penetration);
            prop_assert_eq!(&seen.acceleration, &expected.acceleration);
            let end = STEP * seen.count as f64 * (1.0 - 1.0e-12);
            let all = &expected.peaks;
            for (i, (seen, expected)) in seen.peaks.iter().zip(all).enumerate() {
                let largest = all.iter().skip(i % 4).step_by(4).map(|peak| peak.0);
                let largest = largest.fold(0.0, f64::max);
                // Round-off alone moves floors that no wave has reached yet.
                if expected.1 < end && expected.0 > 1.0e-12 * largest {
                    prop_assert_eq!(seen, expected);
                } else {
                    // Of motion that is cut while it still grows, sample and polynomial up to it
                    // are the same but for round-off.
                    let error = (seen.0 - expected.0).abs();
                    prop_assert!(error <= 1.0e-11 * largest, "{seen:?} {expected:?}");
                }
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn one_step_over_a_block_leads_to_where_samples_lead(
            storeys in prop_oneof![
                7 => [1_usize..70, 1_usize..50],
                1 => [130_usize..220, 1_usize..120],
            ],
            seed in 0.0..100.0,
            ratio in any::<bool>(),
            gap in prop_oneof![Just(1.0e3), 0.01..0.4],
            samples in 5_usize..700,
            step in prop_oneof![Just(0.005), Just(0.01), Just(0.02)],
        ) {
            let system = towers(storeys, seed, ratio, gap, (samples, step));
            prop_assume!(system.contact_free().unwrap().block_step.is_some());
            // Which sample is left to contacts depends on where blocks begin.
            let counts = [true, false].map(|ends| advanced(&system, ends, ends, samples).count);
            prop_assert!(counts[0].abs_diff(counts[1]) <= 1);
            let count = counts[0].min(counts[1]);
            prop_assert!(gap < 1.0 || count == samples);
            let expected = advanced(&system, false, false, count);
            let seen = advanced(&system, true, true, count);
            prop_assert_eq!([seen.count, expected.count], [count; 2]);
            // Loads at hand change no bit.
            prop_assert!(system.loads().is_made());
            let fresh = towers(storeys, seed, ratio, gap, (samples, step));
            prop_assert_eq!(seen.bits(), advanced(&fresh, true, true, count).bits());
            prop_assert!(!fresh.loads().is_made());
            let n = system.degrees_of_freedom();
            for part in [0..n, n..2 * n, 2 * n..seen.state.len() - 1] {
                let (seen, expected) = (&seen.state[part.clone()], &expected.state[part]);
                let largest = largest(expected);
                for (seen, expected) in seen.iter().zip(expected) {
                    let error = (seen - expected).abs();
                    prop_assert!(error <= 1.0e-12 * largest, "{seen} {expected}");
                }
            }
            let [input, residual] = seen.state[seen.state.len() - 2..] else { unreachable!() };
            prop_assert!(residual <= 1.0e-13 * input, "{residual} of {input}");
            let all = &expected.peaks;
            let end = step * seen.count as f64 * (1.0 - 1.0e-12);
            for (i, (seen, expected)) in seen.peaks.iter().zip(all).enumerate() {
                let largest = all.iter().skip(i % 4).step_by(4).map(|peak| peak.0);
                let largest = largest.fold(0.0, f64::max);
                let error = (seen.0 - expected.0).abs();
                prop_assert!(error <= 1.0e-12 * largest, "{seen:?} {expected:?}");
                if expected.1 < end && expected.0 > 1.0e-3 * largest {
                    let late = (seen.1 - expected.1).abs();
                    prop_assert!(late <= 1.0e-6, "{seen:?} {expected:?}");
                }
            }
        }
    }

    /// Against double precision, and against accelerations of the modes.
    #[test]
    fn floors_in_single_precision_err_by_less_than_their_bounds() {
        for (storeys, seed) in [([24, 3], 1.0), ([31, 50], 2.0), ([150, 70], 3.0)] {
            let system = towers(storeys, seed, false, 1.0e3, (100, 0.01));
            let constants = system.contact_free().unwrap();
            let mut ends = BlockEnds::new(constants);
            let lanes = constants.modes.len();
            for decay in [0.0, 1.0, 2.0] {
                let modal = [1.0, 7.0].map(|speed: f64| -> Vec<Lane> {
                    let value = |j: usize| {
                        300.0 * speed * libm::sin(seed + speed + 5.7 * j as f64)
                            / (1.0 + decay * (j * j) as f64)
                    };
                    let lane = |c: usize| Lane::from_fn(|l| value(c * WIDTH + l));
                    (0..lanes).map(lane).collect()
                });
                let [q, p] = modal.each_ref().map(Vec::as_slice);
                ends.approach_end(constants, [q, p]);
                ends.work_out_approximate_end(constants);
                ends.accelerate_ends(constants, [0.7; 2]);
                let (mut modes, mut floors) = (ends.modes.clone(), ends.end.clone());
                derive_end(constants, (q, p, 0.7), false, &mut modes);
                let [_, rate, absolute, absolute_rate] = &modes;
                let all = [q, rate, absolute, absolute_rate];
                transform_four(&constants.shapes, all, &mut floors);
                let bands = ends.bands.as_ref().unwrap();
                let farthest = [0, 1, 2, 3].map(|k: usize| {
                    let lanes = ends.end[k].iter().zip(&floors[k]);
                    let each = lanes.flat_map(|(a, b)| (0..WIDTH).map(|l| (a[l] - b[l]).abs()));
                    each.fold(0.0, f64::max)
                });
                let [value, rate] = bands.errors[1];
                assert!(farthest[0] <= value && farthest[1] <= rate, "{farthest:?}");
                let lost = bands.lost[1];
                assert!(farthest[2] + farthest[3] <= lost, "{farthest:?} {lost:e}");
                assert!(farthest.iter().all(|error| *error > 0.0));
            }
        }
    }

    /// A ground that goes up and down from sample to sample moves the floors little: its work is a
    /// small part of the products that it is the sum of.
    #[test]
    fn ground_that_alternates_leaves_the_ledger_closed() {
        for (storeys, step) in [
            ([1, 1], 0.005),
            ([3, 2], 0.005),
            ([12, 8], 0.005),
            ([40, 25], 0.01),
        ] {
            let swell = towers(storeys, 4.0, false, 1.0e3, (800, step));
            let up_and_down = (0..=800).map(|s| if s % 2 == 0 { 3.0 } else { -3.0 });
            let samples = (up_and_down.collect(), step);
            let system = under(swell.buildings().to_vec(), samples, 1.0e3);
            assert!(system.contact_free().unwrap().block_step.is_some());
            let [by_samples, by_step] = [false, true].map(|by_step| {
                let state = advanced(&system, by_step, by_step, 800).state;
                state[state.len() - 1] / state[state.len() - 2]
            });
            // Before differences were taken, up to 4e-9.
            assert!(by_step <= 1.0e-11, "{by_step:e}, by samples {by_samples:e}");
        }
    }
}
