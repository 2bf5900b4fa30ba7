//! A closer look at what tall buildings put off: eight floors over a block, at all of its samples,
//! between which a function lies within the hull of the cubic through values and rates, and
//! `h^4 / 384` times a bound of its fourth derivative.

use crate::system::modes::{
    BLOCK, ContactFree, Decay, Ground, Lane, Quantity, Track, WIDTH, derive, products, step_modes,
    sum_of_products,
};
use pounding_vectorised::vectorised;

/// Samples at which a block is looked at, its start included.
const TIMES: usize = BLOCK + 1;
const HALF: usize = TIMES.div_ceil(2);
/// What a third of the rate of a cubic may err by, in units of what its value may: the rate of
/// Hermite's cubic errs by at most `sqrt(3) h^3 / 216` times the fourth derivative.
const TURNS: f64 = 1.1;

/// Eight floors of which a function could have a peak in a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct LaneCandidate {
    pub quantity: Quantity,
    pub lane: usize,
    /// Bounds of the function in the block.
    pub upper: Lane,
    /// Index of the state at the start of the block.
    pub snapshot: usize,
}

/// One floor's function between two samples.
#[derive(Debug, Clone, Copy)]
pub(super) struct Interval {
    pub floor: usize,
    /// Number of the interval in the block.
    pub number: usize,
    pub upper: f64,
}

/// The modes at all samples of a block, and the floors that were asked for last.
#[derive(Debug, Clone)]
pub(super) struct BlockLook {
    /// Displacement and velocity, absolute acceleration and its rate, sample after sample.
    modes: [Vec<Lane>; 4],
    /// Bounds of the fourth derivatives of displacement and absolute acceleration, and what fast
    /// decays depart by beside.
    fourth: [Vec<Lane>; 2],
    rest: [Vec<Lane>; 2],
    /// Lanes of the modes that were followed.
    followed: Vec<bool>,
    /// Two lanes next to one another whose displacements and velocities are known: drifts take that
    /// below too.
    known: [Option<usize>; 2],
    motion: [[[Lane; TIMES]; 2]; 2],
}

impl BlockLook {
    pub(super) fn new(lanes: usize) -> Self {
        let zeros = |count: usize| vec![Lane::ZERO; count];
        Self {
            modes: std::array::from_fn(|_| zeros(lanes * TIMES)),
            fourth: std::array::from_fn(|_| zeros(lanes)),
            rest: std::array::from_fn(|_| zeros(lanes)),
            followed: vec![false; lanes],
            known: [None; 2],
            motion: [[[Lane::ZERO; TIMES]; 2]; 2],
        }
    }

    /// Begins with another block.
    pub(super) fn begin(&mut self) {
        self.known = [None; 2];
        self.followed.fill(false);
    }

    /// Follows the modes that move a lane of floors from these displacements and velocities over
    /// the block, unless they were followed.
    pub(super) fn follow(
        &mut self,
        constants: &ContactFree,
        (state, samples): ((&[Lane], &[Lane]), &[f64]),
        lane: usize,
    ) {
        let row = &constants.floor_rows[lane];
        let end = row.first_mode + row.columns.len();
        for c in row.first_mode / WIDTH..end.div_ceil(WIDTH) {
            if !std::mem::replace(&mut self.followed[c], true) {
                self.known = [None; 2];
                follow(constants, (c, state), samples, self);
            }
        }
    }

    /// Takes the peaks of eight floors at the samples, of which the first has this number, and
    /// notes the intervals in which there could be higher ones.
    pub(super) fn look_at(
        &mut self,
        constants: &ContactFree,
        candidate: &LaneCandidate,
        (first, track): (usize, &mut Track),
        intervals: &mut Vec<Interval>,
    ) {
        let functions = self.functions(constants, candidate);
        let lane = candidate.lane;
        let floors = lane * WIDTH..constants.building.len().min((lane + 1) * WIDTH);
        let rows = &constants.rows;
        let (size, k) = match candidate.quantity {
            Quantity::Drift => (&rows.drift_size, 0),
            Quantity::Acceleration => (&rows.size, 1),
            Quantity::Displacement | Quantity::SectionForce => (&rows.size, 0),
        };
        let (mut rest, mut of) = (0.0, None);
        let third = constants.step / 3.0;
        for (l, floor) in floors.enumerate() {
            if candidate.upper[l] <= track.peak[lane][l] {
                continue;
            }
            let building = constants.building[floor];
            if of != Some(building) {
                let shapes = &constants.shapes[building];
                let modes = shapes.first_mode..shapes.first_mode + shapes.modes;
                rest = constants.step.powi(4) / 384.0
                    * sum_of_products(size, &self.fourth[k], modes.clone());
                if !constants.decays.is_empty() {
                    rest += sum_of_products(size, &self.rest[k], modes);
                }
                of = Some(building);
            }
            let [values, rates] = functions.each_ref().map(|f| f.map(|lane| lane[l]));
            let peak = &mut track.peak[lane][l];
            for (number, value) in values.iter().enumerate().skip(1) {
                if value.abs() > *peak {
                    *peak = value.abs();
                    track.time[lane][l] = (first + number) as f64 * constants.step;
                }
            }
            for number in 0..BLOCK {
                let (a, b) = (values[number], values[number + 1]);
                let (out, back) = (a + third * rates[number], b - third * rates[number + 1]);
                // The rate of the cubic errs by less than 3.1 times the rest: where it keeps its
                // sign by more, there is no turning point.
                let slopes = [out - a, back - out, b - back];
                if slopes.iter().all(|slope| *slope > TURNS * rest)
                    || slopes.iter().all(|slope| *slope < -TURNS * rest)
                {
                    continue;
                }
                let hull = a.abs().max(b.abs()).max(out.abs()).max(back.abs());
                let upper = hull + rest;
                if upper > *peak {
                    intervals.push(Interval {
                        floor,
                        number,
                        upper,
                    });
                }
            }
        }
    }

    /// Values and rates of eight floors' functions at all samples.
    fn functions(
        &mut self,
        constants: &ContactFree,
        candidate: &LaneCandidate,
    ) -> [[Lane; TIMES]; 2] {
        let lane = candidate.lane;
        match candidate.quantity {
            Quantity::Displacement | Quantity::SectionForce => *self.motion_of(constants, lane),
            Quantity::Acceleration => {
                let [_, _, absolute, rate] = &self.modes;
                floors_of(constants, lane, [absolute, rate])
            }
            Quantity::Drift => {
                let above = constants.above[lane];
                let mut functions = *self.motion_of(constants, lane);
                let before = lane.checked_sub(1).filter(|_| above[0] > 0.0);
                let before = before.map(|before| self.motion_of(constants, before));
                for (k, function) in functions.iter_mut().enumerate() {
                    for (time, u) in function.iter_mut().enumerate() {
                        let last = before.map_or(0.0, |before| before[k][time][WIDTH - 1]);
                        let mut below = [last; WIDTH];
                        below[1..].copy_from_slice(&u.0[..WIDTH - 1]);
                        for l in 0..WIDTH {
                            u[l] -= above[l] * below[l];
                        }
                    }
                }
                functions
            }
        }
    }

    /// Displacements and velocities of eight floors at all samples.
    fn motion_of(&mut self, constants: &ContactFree, lane: usize) -> &[[Lane; TIMES]; 2] {
        let place = lane % 2;
        let motion = &mut self.motion[place];
        if self.known[place] != Some(lane) {
            let [displacement, velocity, _, _] = &self.modes;
            *motion = floors_of(constants, lane, [displacement, velocity]);
            self.known[place] = Some(lane);
        }
        motion
    }
}

/// A lane of floors from two functions of the modes, at all samples.
#[vectorised]
fn floors_of(constants: &ContactFree, lane: usize, modes: [&[Lane]; 2]) -> [[Lane; TIMES]; 2] {
    let (row, count) = (&constants.floor_rows[lane], constants.modes.len());
    let mut floors = [[Lane::ZERO; TIMES]; 2];
    for (floors, modes) in floors.iter_mut().zip(modes) {
        // As many sums as stay in registers.
        let (first, second) = floors.split_at_mut(HALF);
        first.copy_from_slice(&products::<HALF>(row, modes, count));
        let modes = &modes[HALF * count..];
        second.copy_from_slice(&products::<{ TIMES - HALF }>(row, modes, count));
    }
    floors
}

/// Follows eight modes over a block. The fourth derivatives swing freely between samples, so that
/// `y'^2 + omega^2 y^2` of a derivative from the second on never grows, and
/// `|y''| <= (omega + 2 zeta omega) (|y'| + omega |y|)`; beyond critical damping by their decay.
#[vectorised]
fn follow(
    constants: &ContactFree,
    (c, (displacement, velocity)): (usize, (&[Lane], &[Lane])),
    samples: &[f64],
    look: &mut BlockLook,
) {
    let count = constants.modes.len();
    let [displacements, velocities, absolutes, rates] = &mut look.modes;
    let m = &constants.modes[c];
    let mut state = [displacement[c], velocity[c], Lane::ZERO, Lane::ZERO];
    let (mut largest, mut beside) = ([Lane::ZERO; 2], [Lane::ZERO; 2]);
    let decay = Decay::of_lane(&constants.decays, c);
    for (s, start) in samples.iter().copied().enumerate() {
        let end = samples.get(s + 1).copied().unwrap_or(start);
        let ground = Ground {
            start,
            end,
            slope: (end - start) / constants.step,
        };
        let [q, p, ..] = state;
        let ([absolute, rate], derivatives) = derive(m, (&q, &p), ground);
        for (k, [y, rate]) in derivatives.iter().enumerate() {
            let mut any = Lane::ZERO;
            for l in 0..WIDTH {
                let omega = m.circular_frequency[l];
                any[l] = (omega + m.damping[l]) * (rate[l].abs() + omega * y[l].abs());
            }
            if let Some(decay) = decay {
                let [fourth, rest] = decay.bound([y, rate, &any]);
                any = fourth;
                beside[k] = larger(&rest, &beside[k]);
            }
            largest[k] = larger(&any, &largest[k]);
        }
        let place = s * count + c;
        (displacements[place], velocities[place]) = (q, p);
        (absolutes[place], rates[place]) = (absolute, rate);
        (state, _) = step_modes::<false>(m, state, ground);
    }
    for k in 0..2 {
        (look.fourth[k][c], look.rest[k][c]) = (largest[k], beside[k]);
    }
}

/// Larger values, place by place.
#[inline(always)]
fn larger(a: &Lane, b: &Lane) -> Lane {
    let mut out = *b;
    for l in 0..WIDTH {
        out[l] = if a[l] > b[l] { a[l] } else { b[l] };
    }
    out
}
