//! Arithmetic on lanes: eight degrees of freedom, or modes, side by side.
//!
//! The functions are compiled for several instruction sets and chosen at run time
//! ([`vectorised`]); without fused operations their bits are the same on all.

use std::hint::black_box;

use pounding_vectorised::vectorised;
use std::ops::{Index, IndexMut, Range};

/// Eight values side by side, in one line of the cache.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(align(64))]
pub(crate) struct Lane(pub [f64; 8]);

impl Lane {
    pub(crate) const ZERO: Self = Self([0.0; 8]);

    /// Made place by place.
    pub(crate) fn from_fn(value: impl FnMut(usize) -> f64) -> Self {
        Self(std::array::from_fn(value))
    }

    /// A function of every place.
    pub(crate) fn map(self, function: impl FnMut(f64) -> f64) -> Self {
        Self(self.0.map(function))
    }
}

impl Index<usize> for Lane {
    type Output = f64;

    #[inline(always)]
    fn index(&self, place: usize) -> &f64 {
        &self.0[place]
    }
}

impl IndexMut<usize> for Lane {
    #[inline(always)]
    fn index_mut(&mut self, place: usize) -> &mut f64 {
        &mut self.0[place]
    }
}

/// A value by its number in a row of lanes.
#[inline(always)]
pub(crate) fn at(lanes: &[Lane], i: usize) -> f64 {
    lanes[i / WIDTH][i % WIDTH]
}

/// Copies values into a row of lanes.
pub(crate) fn spread(values: &[f64], lanes: &mut [Lane]) {
    for (values, lane) in values.chunks(WIDTH).zip(lanes) {
        lane.0[..values.len()].copy_from_slice(values);
    }
}

/// Copies values out of a row of lanes.
pub(crate) fn gather(lanes: &[Lane], values: &mut [f64]) {
    for (values, lane) in values.chunks_mut(WIDTH).zip(lanes) {
        values.copy_from_slice(&lane.0[..values.len()]);
    }
}

/// Number of values in a lane.
pub(crate) const WIDTH: usize = 8;

/// Keeps the lanes of a loop one after another. Each is a register already: what the compiler makes
/// of eight at once, by loads that gather, takes several times as long.
#[inline(always)]
pub(crate) fn lane_by_lane() {
    black_box(());
}

/// Sum of all values.
#[inline(always)]
pub(crate) fn sum(lanes: &[Lane]) -> f64 {
    let mut sum = Lane::ZERO;
    for lane in lanes {
        for l in 0..WIDTH {
            sum[l] += lane[l];
        }
    }
    let half: [f64; 4] = std::array::from_fn(|l| sum[l] + sum[l + 4]);
    (half[0] + half[2]) + (half[1] + half[3])
}

/// Sum, place by place.
#[inline(always)]
pub(crate) fn add(a: Lane, b: Lane) -> Lane {
    let mut out = Lane::ZERO;
    for l in 0..WIDTH {
        out[l] = a[l] + b[l];
    }
    out
}

/// Product, place by place.
#[inline(always)]
pub(crate) fn mul(a: Lane, b: Lane) -> Lane {
    let mut out = Lane::ZERO;
    for l in 0..WIDTH {
        out[l] = a[l] * b[l];
    }
    out
}

/// Multiple.
#[inline(always)]
pub(crate) fn scale(factor: f64, a: Lane) -> Lane {
    let mut out = Lane::ZERO;
    for l in 0..WIDTH {
        out[l] = factor * a[l];
    }
    out
}

/// Sum of the products of values with these numbers.
#[inline(always)]
pub(crate) fn sum_of_products(a: &[Lane], b: &[Lane], numbers: Range<usize>) -> f64 {
    let (first, last) = (numbers.start.div_ceil(WIDTH), numbers.end / WIDTH);
    if first >= last {
        return numbers.map(|i| at(a, i) * at(b, i)).sum();
    }
    let mut sum = Lane::ZERO;
    for (a, b) in a[first..last].iter().zip(&b[first..last]) {
        for l in 0..WIDTH {
            sum[l] += a[l] * b[l];
        }
    }
    let edges = (numbers.start..first * WIDTH).chain(last * WIDTH..numbers.end);
    let edges = edges.map(|i| at(a, i) * at(b, i));
    sum.0.iter().sum::<f64>() + edges.sum::<f64>()
}

/// Constants of eight modes.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ModeLanes {
    pub displacement: [Lane; 4],
    pub velocity: [Lane; 4],
    pub integral: [Lane; 4],
    pub viscous: [Lane; 10],
    pub participation: Lane,
    pub circular_frequency: Lane,
    /// `omega^2`.
    pub stiffness: Lane,
    /// `2 zeta omega`.
    pub damping: Lane,
    /// Bounds of the mode's part in floor acceleration, and in the second derivative of
    /// absolute floor acceleration: weights of `|q'| + omega |q|`, of the maximum ground
    /// acceleration, and of its maximum slope.
    pub acceleration_bound: [Lane; 2],
    pub snap_bound: [Lane; 3],
    /// `gamma / omega^2` and `2 zeta gamma / omega^3`: what a steady ground acceleration, and its
    /// slope, displace the mode by.
    pub steady: [Lane; 2],
}

/// Modal state of a system, and what it has worked since take-off.
#[derive(Debug, Clone, Default)]
pub(crate) struct Modal {
    pub displacement: Vec<Lane>,
    pub velocity: Vec<Lane>,
    pub input: Vec<Lane>,
    pub viscous: Vec<Lane>,
}

/// The same, looked at.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ModalState<'a> {
    pub displacement: &'a [Lane],
    pub velocity: &'a [Lane],
    pub input: &'a [Lane],
    pub viscous: &'a [Lane],
}

/// Ground acceleration over a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ground {
    pub start: f64,
    pub end: f64,
    pub slope: f64,
}

/// One building's part of the transformation from modes to floors: columns of the
/// mode shapes, spread over the lanes that hold its floors.
#[derive(Debug, Clone)]
pub(crate) struct Shapes {
    pub first_lane: usize,
    pub lanes: usize,
    pub first_mode: usize,
    pub modes: usize,
    /// `lanes` times `modes` lanes.
    pub columns: Vec<Lane>,
}

/// A function of time at every floor, sampled: present and next values, and its peak.
#[derive(Debug, Clone, Default)]
pub(crate) struct Track {
    pub now: Vec<Lane>,
    pub next: Vec<Lane>,
    pub peak: Vec<Lane>,
    pub time: Vec<Lane>,
    /// What the peak is sure to reach once all that was put off has been looked at.
    pub sure: Vec<Lane>,
    /// Bound of the overshoot between samples: `h^2 / 8` times that of the second
    /// derivative.
    pub overshoot: Vec<Lane>,
}

impl Modal {
    pub(crate) fn view(&self) -> ModalState<'_> {
        ModalState {
            displacement: &self.displacement,
            velocity: &self.velocity,
            input: &self.input,
            viscous: &self.viscous,
        }
    }

    /// Takes over another state of the same system.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.displacement.copy_from_slice(&other.displacement);
        self.velocity.copy_from_slice(&other.velocity);
        self.input.copy_from_slice(&other.input);
        self.viscous.copy_from_slice(&other.viscous);
    }

    pub(crate) fn new(lanes: usize) -> Self {
        let zeros = || vec![Lane::ZERO; lanes];
        Self {
            displacement: zeros(),
            velocity: zeros(),
            input: zeros(),
            viscous: zeros(),
        }
    }
}

impl Track {
    /// What the peaks of a lane are sure to reach.
    #[inline(always)]
    pub(crate) fn reach(&self, lane: usize) -> Lane {
        let (peak, sure) = (&self.peak[lane], &self.sure[lane]);
        Lane::from_fn(|l| if sure[l] > peak[l] { sure[l] } else { peak[l] })
    }

    /// Takes over another one of as many values.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.now.copy_from_slice(&other.now);
        self.peak.copy_from_slice(&other.peak);
        self.time.copy_from_slice(&other.time);
    }

    /// For so many values: places beyond them never have a peak.
    pub(crate) fn new(count: usize) -> Self {
        let lanes = count.div_ceil(WIDTH);
        let zeros = || vec![Lane::ZERO; lanes];
        let mut peak = zeros();
        for i in count..lanes * WIDTH {
            peak[i / WIDTH][i % WIDTH] = f64::INFINITY;
        }
        Self {
            now: zeros(),
            next: zeros(),
            peak,
            time: zeros(),
            sure: zeros(),
            overshoot: zeros(),
        }
    }
}

/// Displacement, velocity, input and viscous work of eight modes after a step, and their
/// `|q'| + omega |q|` before it; of `SWINGS` that of their free vibration, without the motion
/// that is linear in time as the ground's acceleration is.
#[inline(always)]
pub(crate) fn step_modes<const SWINGS: bool>(
    m: &ModeLanes,
    [x, v, mut input, mut viscous]: [Lane; 4],
    ground: Ground,
) -> ([Lane; 4], Lane) {
    let (a, b, slope) = (ground.start, ground.end, ground.slope);
    let linear = |k: &[Lane; 4]| -> Lane {
        let mut out = Lane::ZERO;
        for l in 0..WIDTH {
            out[l] = k[0][l] * x[l] + k[1][l] * v[l] + (k[2][l] * a + k[3][l] * b);
        }
        out
    };
    let (end, speed, integral) = (
        linear(&m.displacement),
        linear(&m.velocity),
        linear(&m.integral),
    );
    let k = &m.viscous;
    let mut size = Lane::ZERO;
    for l in 0..WIDTH {
        let moved = end[l] * b - x[l] * a - slope * integral[l];
        input[l] -= m.participation[l] * moved;
        viscous[l] += x[l] * (k[0][l] * x[l] + k[1][l] * v[l] + (k[2][l] * a + k[3][l] * b))
            + v[l] * (k[4][l] * v[l] + (k[5][l] * a + k[6][l] * b))
            + (a * (k[7][l] * a + k[8][l] * b) + k[9][l] * (b * b));
        size[l] = if SWINGS {
            let [by_value, by_slope] = m.steady;
            let speed = v[l] + by_value[l] * slope;
            let place = x[l] + (by_value[l] * a - by_slope[l] * slope);
            speed.abs() + m.circular_frequency[l] * place.abs()
        } else {
            v[l].abs() + m.circular_frequency[l] * x[l].abs()
        };
    }
    ([end, speed, input, viscous], size)
}

/// Absolute acceleration of eight modes and its rate, from displacement and velocity; and the
/// second and the fourth derivative of displacement, which swing freely between samples, each with
/// its rate.
#[inline(always)]
pub(crate) fn derive(
    m: &ModeLanes,
    (q, p): (&Lane, &Lane),
    ground: Ground,
) -> ([Lane; 2], [[Lane; 2]; 2]) {
    let (mut absolute, mut of) = ([Lane::ZERO; 2], [[Lane::ZERO; 2]; 2]);
    for l in 0..WIDTH {
        let (damping, stiffness) = (m.damping[l], m.stiffness[l]);
        let restoring = -(damping * p[l] + stiffness * q[l]);
        let second = restoring - m.participation[l] * ground.start;
        let rate = -(damping * second + stiffness * p[l]);
        let third = rate - m.participation[l] * ground.slope;
        let fourth = -(damping * third + stiffness * second);
        let fifth = -(damping * fourth + stiffness * third);
        (absolute[0][l], absolute[1][l]) = (restoring, rate);
        (of[0][0][l], of[0][1][l]) = (second, third);
        (of[1][0][l], of[1][1][l]) = (fourth, fifth);
    }
    (absolute, of)
}

/// Storey drifts from floor displacements.
#[inline(always)]
pub(crate) fn drifts(shapes: &[Shapes], floors: &[Lane], drifts: &mut [Lane]) {
    for building in shapes {
        let mut below = 0.0;
        for i in building.first_mode..building.first_mode + building.modes {
            let u = at(floors, i);
            drifts[i / WIDTH][i % WIDTH] = u - below;
            below = u;
        }
    }
}

/// Takes the values at the end of the step as peaks.
#[vectorised]
pub(crate) fn raise(track: &mut Track, time: f64) {
    let count = track.now.len();
    let (next, peak) = (&track.next[..count], &mut track.peak[..count]);
    let times = &mut track.time[..count];
    for c in 0..count {
        for l in 0..WIDTH {
            let value = next[c][l].abs();
            let higher = value > peak[c][l];
            peak[c][l] = if higher { value } else { peak[c][l] };
            times[c][l] = if higher { time } else { times[c][l] };
        }
    }
    std::mem::swap(&mut track.now, &mut track.next);
}

/// Takes the present values as peaks.
pub(crate) fn raise_now(track: &mut Track, time: f64) {
    let count = track.now.len();
    let (now, peak) = (&track.now[..count], &mut track.peak[..count]);
    let times = &mut track.time[..count];
    for c in 0..count {
        for l in 0..WIDTH {
            let value = now[c][l].abs();
            let higher = value > peak[c][l];
            peak[c][l] = if higher { value } else { peak[c][l] };
            times[c][l] = if higher { time } else { times[c][l] };
        }
    }
}

/// Largest imbalance of every mode's energy so far, and the whole input energy.
#[vectorised]
pub(crate) fn balance(
    modes: &[ModeLanes],
    now: &Modal,
    start: &[Lane],
    drifted: &mut [Lane],
) -> f64 {
    let mut input = Lane::ZERO;
    for (c, m) in modes.iter().enumerate() {
        let (q, p) = (&now.displacement[c], &now.velocity[c]);
        for l in 0..WIDTH {
            let x = m.circular_frequency[l] * q[l];
            let energy = 0.5 * (p[l] * p[l] + x * x) - start[c][l];
            let imbalance = (energy + now.viscous[c][l] - now.input[c][l]).abs();
            // A NaN must not be lost in the comparison.
            let before = drifted[c][l];
            drifted[c][l] = if imbalance <= before {
                before
            } else {
                imbalance
            };
            input[l] += now.input[c][l];
        }
    }
    input.0.iter().sum()
}

/// Absolute accelerations of the modes, `-(2 zeta omega q' + omega^2 q)`.
#[vectorised]
pub(crate) fn restoring(modes: &[ModeLanes], q: &[Lane], p: &[Lane], out: &mut [Lane]) {
    restore(modes, q, p, out);
}

#[inline(always)]
pub(crate) fn restore(modes: &[ModeLanes], q: &[Lane], p: &[Lane], out: &mut [Lane]) {
    let count = modes.len().min(out.len());
    let (q, p, out) = (&q[..count], &p[..count], &mut out[..count]);
    for (c, m) in modes[..count].iter().enumerate() {
        lane_by_lane();
        for l in 0..WIDTH {
            let omega = m.circular_frequency[l];
            out[c][l] = -(m.damping[l] * p[c][l] + omega * omega * q[c][l]);
        }
    }
}
