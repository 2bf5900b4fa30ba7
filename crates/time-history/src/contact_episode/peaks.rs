//! Peaks of floors inside a step.

use pounding_vectorised::vectorised;

use super::pair::Scene;
use super::series::Series;
use super::span::Span;
use crate::polynomial::{COEFFICIENTS, absolute_maximum, fit, values_at_nodes};
use crate::system::modes::{
    ContactFree, FloorRows, Lane, ModalRow, ModeLanes, Track, WIDTH, add, drifts, lane_by_lane,
    raise, raise_now, scale, sums_of_row, transform,
};

/// Displacement, drift and absolute acceleration of all floors.
pub(crate) struct Tracks<'a> {
    pub displacement: &'a mut Track,
    pub drift: &'a mut Track,
    pub acceleration: &'a mut Track,
    /// Least and greatest displacements, where they are followed.
    pub extent: Option<&'a mut [Vec<Lane>; 2]>,
}

impl Tracks<'_> {
    /// Takes the next displacements in, between which and the present ones floors stray from
    /// the chord by at most this much.
    #[inline(always)]
    fn extend(&mut self, over: f64) {
        let Some([least, greatest]) = &mut self.extent else {
            return;
        };
        let ends = self.displacement.now.iter().zip(&self.displacement.next);
        for (c, (now, next)) in ends.enumerate() {
            lane_by_lane();
            let (low, high) = (&mut least[c], &mut greatest[c]);
            for l in 0..WIDTH {
                let (a, b) = (now[l], next[l]);
                let (below, above) = if a < b { (a, b) } else { (b, a) };
                let (below, above) = (below - over, above + over);
                low[l] = if below < low[l] { below } else { low[l] };
                high[l] = if above > high[l] { above } else { high[l] };
            }
        }
    }
}

/// Absolute accelerations of the floors at the start of a step, which may have jumped.
pub(crate) fn begin_acceleration(
    constants: &ContactFree,
    absolute: &[Lane],
    tracks: &mut Tracks<'_>,
    time: f64,
) {
    transform(&constants.shapes, absolute, &mut tracks.acceleration.now);
    raise_now(tracks.acceleration, time);
}

/// Takes the peaks within a series; `absolute` are the modal absolute accelerations and
/// `displacement` the modal displacements at its end.
pub(crate) fn note_floors_of_series(
    constants: &ContactFree,
    series: &Series,
    (displacement, absolute): (&[Lane], &[Lane]),
    tracks: &mut Tracks<'_>,
    start: f64,
) {
    let loud = values(constants, series, [displacement, absolute], tracks);
    let (rows, end) = (&constants.rows, start + series.step());
    for (which, track) in [
        &mut *tracks.displacement,
        &mut *tracks.drift,
        &mut *tracks.acceleration,
    ]
    .into_iter()
    .enumerate()
    {
        if !loud[which] {
            // No value at the end can be a peak either.
            std::mem::swap(&mut track.now, &mut track.next);
            continue;
        }
        let (shapes, bound) = match which {
            0 => (&constants.magnitudes, &series.bend),
            1 => (&constants.drift_magnitudes, &series.bend),
            _ => (&constants.magnitudes, &series.snap),
        };
        transform(shapes, bound, &mut track.overshoot);
        for lane in &mut track.overshoot {
            *lane = lane.map(|x| 0.125 * x);
        }
        inside_series(rows, series, which, track, start);
        raise(track, end);
    }
}

/// Takes the peaks of the forces in sections within a series, that ends at these modal
/// displacements; `track` holds the values at its start.
pub(crate) fn note_sections_of_series(
    rows: &[ModalRow],
    series: &Series,
    displacement: &[Lane],
    track: &mut Track,
    start: f64,
) {
    for (i, row) in rows.iter().enumerate() {
        let (c, l) = (i / WIDTH, i % WIDTH);
        let ends = (track.now[c][l], row.dot(displacement));
        track.now[c][l] = ends.1;
        take(track, i, ends.1.abs(), start + series.step());
        let over = 0.125 * row.dot_magnitudes(&series.bend);
        if !could_turn(ends, over, track.peak[c][l]) {
            continue;
        }
        let terms = series.row(row);
        let fitted = series.fitted(&terms);
        if let Some((theta, _)) = absolute_maximum(&fitted, track.peak[c][l]) {
            let value = series.at(&terms, theta).0.abs();
            take(track, i, value, start + theta * series.step());
        }
    }
}

/// The same within a step of the pair.
pub(crate) fn note_sections_of_span(
    rows: &[ModalRow],
    span: &Span<'_>,
    track: &mut Track,
    start: f64,
) {
    for (i, row) in rows.iter().enumerate() {
        let (a, b) = span.row(row, 0.0);
        let (c, l) = (i / WIDTH, i % WIDTH);
        track.now[c][l] = b[0];
        let force = span.displacement(a, b);
        if let Some((theta, top)) = absolute_maximum(&force, track.peak[c][l]) {
            take(track, i, top, start + span.clock.offset(theta));
        }
    }
}

/// Takes the values at the end of a series, and says which of displacement, drift and
/// acceleration could exceed a peak.
#[vectorised]
fn values(
    constants: &ContactFree,
    series: &Series,
    modal: [&[Lane]; 2],
    tracks: &mut Tracks<'_>,
) -> [bool; 3] {
    floors_at_end(constants, modal, tracks);
    let bend = series.over;
    let snap = 0.125 * constants.rows.bound(&series.snap);
    tracks.extend(bend);
    // A drift is a difference of two floors.
    [
        exceeds(tracks.displacement, bend),
        exceeds(tracks.drift, 2.0 * bend),
        exceeds(tracks.acceleration, snap),
    ]
}

/// Floors' displacements, drifts and absolute accelerations at the end of a step from displacements
/// and absolute accelerations of the modes, in one pass over the floors.
#[inline(always)]
fn floors_at_end(constants: &ContactFree, modal: [&[Lane]; 2], tracks: &mut Tracks<'_>) {
    let count = constants.floor_rows.len();
    let above = &constants.above[..count];
    let displacement = &mut tracks.displacement.next[..count];
    let drift = &mut tracks.drift.next[..count];
    let acceleration = &mut tracks.acceleration.next[..count];
    // The floor below the first one of a lane is in the lane before.
    let mut last = 0.0;
    for (c, row) in constants.floor_rows.iter().enumerate() {
        let [u, w] = sums_of_row(row, modal);
        let mut below = [last; WIDTH];
        below[1..].copy_from_slice(&u.0[..WIDTH - 1]);
        last = u[WIDTH - 1];
        for l in 0..WIDTH {
            drift[c][l] = u[l] - above[c][l] * below[l];
        }
        (displacement[c], acceleration[c]) = (u, w);
    }
}

/// The same at the end of a step of the pair, for which `modal` is work space.
#[vectorised]
fn values_of_span(
    scene: &Scene<'_>,
    span: &Span<'_>,
    modal: &mut [Lane],
    tracks: &mut Tracks<'_>,
) -> [bool; 3] {
    let (constants, rows) = (scene.constants, &scene.constants.rows);
    let length = span.clock.offset(1.0);
    let ground = scene.ground.0 + scene.ground.1 * length;
    let accelerations = span.end.motion[2].iter().zip(&constants.modes);
    for (out, (a, m)) in modal.iter_mut().zip(accelerations) {
        *out = add(*a, scale(ground, m.participation));
    }
    floors_at_end(constants, [&span.end.motion[0], modal], tracks);
    let [.., a, j] = &span.start.motion;
    let (bend, snap) = (rows.bound(a), rows.bound(j));
    let [.., a, j] = &span.end.motion;
    let (bend, snap) = (bend.max(rows.bound(a)), snap.max(rows.bound(j)));
    // What lies between can differ from the chord by this much, and half as much again for
    // safety.
    let over = 0.1875 * length * length * bend;
    tracks.extend(over);
    [
        exceeds(tracks.displacement, over),
        exceeds(tracks.drift, 2.0 * over),
        exceeds(tracks.acceleration, 0.75 * length * snap),
    ]
}

/// Whether any floor could exceed its peak inside, for this bound of the overshoot.
#[inline(always)]
fn exceeds(track: &Track, over: f64) -> bool {
    let mut any = false;
    let ends = track.now.iter().zip(&track.next);
    for ((a, b), peak) in ends.zip(&track.peak) {
        lane_by_lane();
        for l in 0..WIDTH {
            let (a, b) = (a[l].abs(), b[l].abs());
            any |= (if a > b { a } else { b }) + over > peak[l];
        }
    }
    any
}

/// Peaks of displacement (0), drift (1) or absolute acceleration (2) inside a series.
fn inside_series(rows: &FloorRows, series: &Series, which: usize, track: &mut Track, start: f64) {
    for c in 0..track.now.len() {
        if !any_turns(track, c) {
            continue;
        }
        for i in c * WIDTH..rows.floors.len().min((c + 1) * WIDTH) {
            if turns(track, i) {
                look_inside(rows, series, (which, i), track, start);
            }
        }
    }
}

/// Takes the peak of one floor inside a series.
fn look_inside(
    rows: &FloorRows,
    series: &Series,
    (which, i): (usize, usize),
    track: &mut Track,
    start: f64,
) {
    let terms = match which {
        0 => series.row(&rows.floors[i]),
        1 => series.row(&rows.drifts[i]),
        _ => series.row_acceleration(&rows.floors[i], 1.0),
    };
    let fitted = series.fitted(&terms);
    let (c, l) = (i / WIDTH, i % WIDTH);
    if let Some((theta, _)) = absolute_maximum(&fitted, track.peak[c][l]) {
        let value = series.at(&terms, theta).0.abs();
        take(track, i, value, start + theta * series.step());
    }
}

/// Whether any floor of a lane could turn above its peak.
fn any_turns(track: &Track, c: usize) -> bool {
    let (now, next) = (track.now[c], track.next[c]);
    let (overshoot, peak) = (track.overshoot[c], track.peak[c]);
    (0..WIDTH).fold(false, |any, l| {
        any | could_turn((now[l], next[l]), overshoot[l], peak[l])
    })
}

/// Whether this floor could turn above its peak.
fn turns(track: &Track, floor: usize) -> bool {
    let (c, l) = (floor / WIDTH, floor % WIDTH);
    let ends = (track.now[c][l], track.next[c][l]);
    could_turn(ends, track.overshoot[c][l], track.peak[c][l])
}

/// Whether what overshoots its ends by so much at most could turn above a peak: a larger
/// change excludes a turning point. Without branches, for lanes.
#[inline(always)]
fn could_turn((a, b): (f64, f64), overshoot: f64, peak: f64) -> bool {
    let (first, last) = (a.abs(), b.abs());
    let above = (if first > last { first } else { last }) + overshoot > peak;
    above & ((b - a).abs() <= 4.0 * overshoot)
}

fn take(track: &mut Track, floor: usize, value: f64, time: f64) {
    let (c, l) = (floor / WIDTH, floor % WIDTH);
    if value > track.peak[c][l] {
        (track.peak[c][l], track.time[c][l]) = (value, time);
    }
}

/// Rates of the floors' functions at both ends of a span.
#[derive(Debug, Clone)]
pub(crate) struct Rates {
    /// Velocity, drift velocity, and rate of absolute acceleration: at the start and at
    /// the end.
    ends: [[Vec<Lane>; 2]; 3],
    modal: Vec<Lane>,
    /// One for every floor that may exceed its peak.
    open: Vec<Lane>,
    /// Absolute accelerations of the modes at the nodes of a fit.
    nodes: [Vec<Lane>; COEFFICIENTS],
}

/// Margins of the hulls: cubics err by less than this part of a peak.
const MARGIN: [f64; 3] = [1.0e-3, 1.0e-3, 2.0e-2];

impl Rates {
    pub(crate) fn new(lanes: usize) -> Self {
        let zeros = || vec![Lane::ZERO; lanes];
        Self {
            ends: std::array::from_fn(|_| [zeros(), zeros()]),
            modal: zeros(),
            open: zeros(),
            nodes: std::array::from_fn(|_| zeros()),
        }
    }

    /// Takes the velocities of floors and drifts at both ends of a span.
    fn take_velocities(&mut self, constants: &ContactFree, span: &Span<'_>) {
        let (shapes, [velocity, drift, _]) = (&constants.shapes, &mut self.ends);
        for (end, point) in [span.start, span.end].into_iter().enumerate() {
            transform(shapes, &point.motion[1], &mut velocity[end]);
            drifts(shapes, &velocity[end], &mut drift[end]);
        }
    }

    /// Takes the rates of absolute acceleration at both ends of a span over which that of the
    /// ground has this slope (m/s3).
    fn take_jerks(&mut self, constants: &ContactFree, span: &Span<'_>, slope: f64) {
        for (end, point) in [span.start, span.end].into_iter().enumerate() {
            for (c, m) in constants.modes.iter().enumerate() {
                for l in 0..WIDTH {
                    self.modal[c][l] = point.motion[3][c][l] + m.participation[l] * slope;
                }
            }
            transform(&constants.shapes, &self.modal, &mut self.ends[2][end]);
        }
    }
}

/// Takes the peaks within a step of the pair. `tracks` hold the values at its start.
pub(crate) fn note_floors_of_span(
    scene: &Scene<'_>,
    span: &Span<'_>,
    rates: &mut Rates,
    tracks: &mut Tracks<'_>,
    start: f64,
) {
    let (constants, rows) = (scene.constants, &scene.constants.rows);
    let length = span.clock.offset(1.0);
    let loud = values_of_span(scene, span, &mut rates.modal, tracks);
    let scales = [span.rates[0][0], span.rates[1][0]];
    if loud[0] || loud[1] {
        rates.take_velocities(constants, span);
    }
    if loud[2] {
        rates.take_jerks(constants, span, scene.ground.1);
    }
    let mut sampled = false;
    for (which, track) in [
        &mut *tracks.displacement,
        &mut *tracks.drift,
        &mut *tracks.acceleration,
    ]
    .into_iter()
    .enumerate()
    {
        if !loud[which] {
            // No value at the end can be a peak either.
            std::mem::swap(&mut track.now, &mut track.next);
            continue;
        }
        may_exceed(
            track,
            &rates.ends[which],
            (scales, MARGIN[which]),
            &mut rates.open,
        );
        for i in 0..rows.floors.len() {
            if rates.open[i / WIDTH][i % WIDTH] == 0.0 {
                continue;
            }
            let function = match which {
                0 => {
                    let (a, b) = span.row(&rows.floors[i], 0.0);
                    span.displacement(a, b)
                }
                1 => {
                    let (a, b) = span.row(&rows.drifts[i], 0.0);
                    span.displacement(a, b)
                }
                _ => {
                    if !sampled {
                        accelerations(scene, span, &mut rates.nodes);
                        sampled = true;
                    }
                    let mut samples: [f64; COEFFICIENTS] =
                        std::array::from_fn(|n| rows.floors[i].dot(&rates.nodes[n]));
                    let (c, l) = (i / WIDTH, i % WIDTH);
                    samples[0] = track.now[c][l];
                    samples[COEFFICIENTS - 1] = track.next[c][l];
                    fit(&samples)
                }
            };
            let (c, l) = (i / WIDTH, i % WIDTH);
            if let Some((theta, top)) = absolute_maximum(&function, track.peak[c][l]) {
                take(track, i, top, start + span.clock.offset(theta));
            }
        }
        raise(track, start + length);
    }
}

/// Of which floors the hull of the cubic through both ends exceeds the peak: ones in `open`, where
/// zeros are not.
#[vectorised]
fn may_exceed(
    track: &Track,
    [first, last]: &[Vec<Lane>; 2],
    (scales, margin): ([f64; 2], f64),
    open: &mut [Lane],
) {
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let ends = track.now.iter().zip(&track.next).zip(&track.peak);
    let rates = first.iter().zip(last);
    for ((((a, b), peak), (first, last)), open) in ends.zip(rates).zip(open) {
        lane_by_lane();
        let mut above = Lane::ZERO;
        for l in 0..WIDTH {
            let (a, b) = (a[l], b[l]);
            let inner = [
                (a + first[l] * scales[0] / 3.0).abs(),
                (b - last[l] * scales[1] / 3.0).abs(),
            ];
            let ends = larger(a.abs(), b.abs());
            let hull = larger(larger(inner[0], inner[1]), ends);
            let is_open = (hull > peak[l] * (1.0 - margin)) & (hull > ends);
            above[l] = if is_open { 1.0 } else { 0.0 };
        }
        *open = above;
    }
}

/// Absolute accelerations of the modes at the inner nodes of a fit.
fn accelerations(scene: &Scene<'_>, span: &Span<'_>, nodes: &mut [Vec<Lane>; COEFFICIENTS]) {
    without_contacts(&scene.constants.modes, span, &basis(span), nodes);
    for (k, touch) in scene.touches.iter().enumerate() {
        let (a, b) = span.touch(k);
        let delta = values_at_nodes(&span.displacement(a, b));
        let rate = values_at_nodes(&span.velocity(a, b));
        let level = &scene.system.levels()[touch.level];
        let row = &scene.rows.levels[touch.level];
        for node in 1..COEFFICIENTS - 1 {
            let law = touch.contact.force(level, delta[node], rate[node]);
            row.add(-law.value, &mut nodes[node]);
        }
    }
}

/// The same without the forces of the closed levels.
#[vectorised]
fn without_contacts(
    modes: &[ModeLanes],
    span: &Span<'_>,
    basis: &Basis,
    nodes: &mut [Vec<Lane>; COEFFICIENTS],
) {
    for (node, out) in nodes.iter_mut().enumerate() {
        if node == 0 || node == COEFFICIENTS - 1 {
            continue;
        }
        for (c, (m, out)) in modes.iter().zip(out).enumerate() {
            let (mut q, mut p) = (Lane::ZERO, Lane::ZERO);
            for (k, [q0, q1, p0, p1]) in basis.iter().enumerate() {
                let (a, b) = (span.start.motion[k][c], span.end.motion[k][c]);
                for l in 0..WIDTH {
                    q[l] += q0[node] * a[l] + q1[node] * b[l];
                    p[l] += p0[node] * a[l] + p1[node] * b[l];
                }
            }
            let omega = m.circular_frequency;
            for l in 0..WIDTH {
                out[l] = -(m.damping[l] * p[l] + omega[l] * omega[l] * q[l]);
            }
        }
    }
}

/// Of displacement, velocity, acceleration and jerk: `[q of start, q of end, p of start, p of end]`
/// at the nodes of a fit.
type Basis = [[[f64; COEFFICIENTS]; 4]; 4];

/// Weights of displacement, velocity, acceleration and jerk at both ends in displacement
/// and velocity at the nodes of a fit.
fn basis(span: &Span<'_>) -> Basis {
    let none = [0.0; 4];
    let both = |a, b| {
        (
            values_at_nodes(&span.displacement(a, b)),
            values_at_nodes(&span.velocity(a, b)),
        )
    };
    std::array::from_fn(|k| {
        let mut unit = none;
        unit[k] = 1.0;
        let ((q0, p0), (q1, p1)) = (both(unit, none), both(none, unit));
        [q0, q1, p0, p1]
    })
}
