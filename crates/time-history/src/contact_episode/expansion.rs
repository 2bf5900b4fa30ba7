//! Sums over the terms of a series, in lanes.

use multiversion::multiversion;

use super::rows::{ModalRow, total};
use super::series::{Series, Works};
use super::tables::{FEW, PARTS, Rule, TERMS, Terms, sample};
use crate::contact_free::{Lane, ModeLanes, WIDTH};

/// Terms after which the remainder beside the motion, `x^(k+1) e^x / (k+1)!`, is negligible.
pub(super) fn last_term((x, negligible): (f64, f64)) -> usize {
    let mut k = 3;
    // No step is so long that the exponential is greater than this.
    let exponential = 1.0 + x + x * x;
    let mut remainder = x * x * x * x / 24.0 * exponential;
    while remainder > negligible && k < TERMS - 2 {
        k += 1;
        remainder *= x * PARTS[k + 1];
    }
    k
}

#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
pub(super) fn expand(series: &mut Series, modes: &[ModeLanes], levels: &[ModalRow]) {
    match (series.lanes, series.touches.len()) {
        (1, 0) => expand_in_place::<1, 0>(series, modes, levels),
        (1, 1) => expand_in_place::<1, 1>(series, modes, levels),
        (1, 2) => expand_in_place::<1, 2>(series, modes, levels),
        (1, 3) => expand_in_place::<1, 3>(series, modes, levels),
        (2, 0) => expand_in_place::<2, 0>(series, modes, levels),
        (2, 1) => expand_in_place::<2, 1>(series, modes, levels),
        (2, 2) => expand_in_place::<2, 2>(series, modes, levels),
        (2, 3) => expand_in_place::<2, 3>(series, modes, levels),
        (3, 0) => expand_in_place::<3, 0>(series, modes, levels),
        (3, 1) => expand_in_place::<3, 1>(series, modes, levels),
        (3, 2) => expand_in_place::<3, 2>(series, modes, levels),
        (4, 0) => expand_in_place::<4, 0>(series, modes, levels),
        (4, 1) => expand_in_place::<4, 1>(series, modes, levels),
        _ => expand_many(series, modes, levels),
    }
}

/// The same as [`expand_many`], with the present terms in registers: few lanes, and few
/// levels that are closed.
#[inline(always)]
fn expand_in_place<const LANES: usize, const CLOSED: usize>(
    series: &mut Series,
    modes: &[ModeLanes],
    levels: &[ModalRow],
) {
    let (last, h) = (series.last, series.step);
    let (ground, mobility) = (series.ground, &series.mobility);
    let touches = &mut series.touches[..CLOSED];
    let powers = &mut series.powers[..CLOSED];
    let rows: [[Lane; LANES]; CLOSED] =
        std::array::from_fn(|i| levels[touches[i].level].spread::<LANES>());
    let mobility: [[f64; CLOSED]; CLOSED] =
        std::array::from_fn(|i| std::array::from_fn(|j| mobility[i * CLOSED + j]));
    let mut rates: [f64; CLOSED] = std::array::from_fn(|i| touches[i].rate[0]);
    let mut forces: [f64; CLOSED] = std::array::from_fn(|i| touches[i].force[0]);
    let (mut q, mut p) = ([Lane::ZERO; LANES], [Lane::ZERO; LANES]);
    q.copy_from_slice(&series.displacement[..LANES]);
    p.copy_from_slice(&series.velocity[..LANES]);
    let (mut bend, mut snap) = ([Lane::ZERO; LANES], [Lane::ZERO; LANES]);
    for k in 0..last {
        let mut a = [Lane::ZERO; LANES];
        for c in 0..LANES {
            let m = &modes[c];
            for l in 0..WIDTH {
                a[c][l] = -(m.damping[l] * p[c][l] + m.stiffness[l] * q[c][l]);
            }
        }
        // The ground's acceleration has two terms.
        if k < 2 {
            let load = if k == 0 { ground.0 } else { ground.1 * h };
            for c in 0..LANES {
                for l in 0..WIDTH {
                    a[c][l] -= modes[c].participation[l] * load;
                }
            }
        }
        let scale = h * PARTS[k + 1];
        // The next rates of the levels come from this acceleration and from these forces
        // apart: what waits for the forces is short.
        let mut next = [0.0; CLOSED];
        for i in 0..CLOSED {
            let mut sum = Lane::ZERO;
            for c in 0..LANES {
                for l in 0..WIDTH {
                    sum[l] += rows[i][c][l] * a[c][l];
                }
            }
            next[i] = total(&sum);
        }
        for i in 0..CLOSED {
            for j in 0..CLOSED {
                next[i] -= mobility[i][j] * forces[j];
            }
        }
        for i in 0..CLOSED {
            for c in 0..LANES {
                for l in 0..WIDTH {
                    a[c][l] -= forces[i] * rows[i][c][l];
                }
            }
        }
        let (order, before) = (((k + 1) * k) as f64, (k * k.saturating_sub(1)) as f64);
        for c in 0..LANES {
            for l in 0..WIDTH {
                // Terms of the acceleration are those of the velocity before scaling.
                snap[c][l] += before * a[c][l].abs();
                q[c][l] = scale * p[c][l];
                p[c][l] = scale * a[c][l];
                bend[c][l] += order * q[c][l].abs();
            }
        }
        let range = (k + 1) * LANES..(k + 2) * LANES;
        series.displacement[range.clone()].copy_from_slice(&q);
        series.velocity[range].copy_from_slice(&p);
        for i in 0..CLOSED {
            let delta = scale * rates[i];
            rates[i] = scale * next[i];
            forces[i] = touches[i].push(&mut powers[i], k + 1, (delta, rates[i]));
        }
    }
    series.bend.copy_from_slice(&bend);
    series.snap.copy_from_slice(&snap);
}

/// Any number of lanes.
#[inline(always)]
fn expand_many(series: &mut Series, modes: &[ModeLanes], levels: &[ModalRow]) {
    let (lanes, last, h) = (series.lanes, series.last, series.step);
    series.bend.fill(Lane::ZERO);
    series.snap.fill(Lane::ZERO);
    for k in 0..last {
        let load = match k {
            0 => series.ground.0,
            1 => series.ground.1 * h,
            _ => 0.0,
        };
        let (q, q_next) = series.displacement[k * lanes..(k + 2) * lanes].split_at_mut(lanes);
        let (p, p_next) = series.velocity[k * lanes..(k + 2) * lanes].split_at_mut(lanes);
        for (c, m) in modes.iter().enumerate() {
            let (x, v) = (q[c], p[c]);
            let mut a = Lane::ZERO;
            for l in 0..WIDTH {
                a[l] = -(m.damping[l] * v[l] + m.stiffness[l] * x[l]) - m.participation[l] * load;
            }
            p_next[c] = a;
        }
        let scale = h * PARTS[k + 1];
        let present = series.touches.len();
        for i in 0..present {
            let mut rate = levels[series.touches[i].level].dot(p_next);
            for j in 0..present {
                rate -= series.mobility[i * present + j] * series.touches[j].force[k];
            }
            series.next_rates[i] = scale * rate;
        }
        for touch in &series.touches {
            levels[touch.level].add(-touch.force[k], p_next);
        }
        let (order, next) = (((k + 1) * k) as f64, (k * k.saturating_sub(1)) as f64);
        for c in 0..lanes {
            let (v, mut a) = (p[c], p_next[c]);
            let (mut bend, mut snap) = (series.bend[c], series.snap[c]);
            let mut x = Lane::ZERO;
            for l in 0..WIDTH {
                // Terms of the acceleration are those of the velocity before scaling.
                snap[l] += next * a[l].abs();
                a[l] *= scale;
                x[l] = scale * v[l];
                bend[l] += order * x[l].abs();
            }
            (q_next[c], p_next[c]) = (x, a);
            (series.bend[c], series.snap[c]) = (bend, snap);
        }
        let touches = series.touches.iter_mut().zip(&mut series.powers);
        for ((touch, powers), rate) in touches.zip(&series.next_rates) {
            let delta = scale * touch.rate[k];
            touch.push(powers, k + 1, (delta, *rate));
        }
    }
}

/// Multiplies the terms of the modes by these factors, from the second on.
#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
pub(super) fn shorten(series: &mut Series, factors: &Terms) {
    let lanes = series.lanes;
    let terms = lanes..(series.last + 1) * lanes;
    let displacement = series.displacement[terms.clone()].chunks_exact_mut(lanes);
    let velocity = series.velocity[terms].chunks_exact_mut(lanes);
    for ((displacement, velocity), factor) in displacement.zip(velocity).zip(&factors[1..]) {
        for (x, v) in displacement.iter_mut().zip(velocity) {
            for l in 0..WIDTH {
                x[l] *= factor;
                v[l] *= factor;
            }
        }
    }
}

#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
pub(super) fn end(
    series: &Series,
    modes: &[ModeLanes],
    displacement: &mut [Lane],
    velocity: &mut [Lane],
    absolute: &mut [Lane],
) {
    let mut out = [displacement, velocity, absolute];
    let lanes = series.lanes;
    // A few lanes at once: their sums do not wait for each other.
    let mut first = 0;
    while first + 2 <= lanes {
        end_of::<2>(series, modes, &mut out, first);
        first += 2;
    }
    if first < lanes {
        end_of::<1>(series, modes, &mut out, first);
    }
}

#[inline(always)]
fn end_of<const LANES: usize>(
    series: &Series,
    modes: &[ModeLanes],
    [displacement, velocity, absolute]: &mut [&mut [Lane]; 3],
    first: usize,
) {
    let lanes = series.lanes;
    let mut sums = [[Lane::ZERO; 3]; LANES];
    for k in (0..=series.last).rev() {
        let order = k as f64;
        for (c, [q, p, slope]) in sums.iter_mut().enumerate() {
            let place = k * lanes + first + c;
            let (x, v) = (series.displacement[place], series.velocity[place]);
            for l in 0..WIDTH {
                q[l] += x[l];
                p[l] += v[l];
                slope[l] += order * v[l];
            }
        }
    }
    let ground = series.ground.0 + series.ground.1 * series.step;
    for (c, [q, p, slope]) in sums.iter().enumerate() {
        let c = first + c;
        (displacement[c], velocity[c]) = (*q, *p);
        for l in 0..WIDTH {
            absolute[c][l] = slope[l] / series.step + modes[c].participation[l] * ground;
        }
    }
}

#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
pub(super) fn works(series: &Series, modes: &[ModeLanes]) -> Works {
    if series.is_slow() {
        works_by::<FEW>(series, modes, &series.tables.few)
    } else {
        works_by::<WIDTH>(series, modes, &series.tables.rule)
    }
}

#[inline(always)]
fn works_by<const NODES: usize>(series: &Series, modes: &[ModeLanes], rule: &Rule) -> Works {
    let (lanes, last, step) = (series.lanes, series.last, series.step);
    let (ground, slope) = series.ground;
    let weights = rule.weights.map(|w| step * w);
    let loads = Lane::from_fn(|node| weights[node] * (ground + slope * step * rule.points[node]));
    let (mut input, mut viscous) = (Lane::ZERO, Lane::ZERO);
    for (c, m) in modes.iter().enumerate() {
        let mut speeds = [Lane::ZERO; NODES];
        for k in (0..=last).rev() {
            let v = series.velocity[k * lanes + c];
            for (node, speed) in speeds.iter_mut().enumerate() {
                let power = rule.powers[k][node];
                for l in 0..WIDTH {
                    speed[l] += power * v[l];
                }
            }
        }
        let (mut pushed, mut damped) = (Lane::ZERO, Lane::ZERO);
        for (node, speed) in speeds.iter().enumerate() {
            for l in 0..WIDTH {
                pushed[l] += loads[node] * speed[l];
                damped[l] += weights[node] * speed[l] * speed[l];
            }
        }
        for l in 0..WIDTH {
            input[l] -= m.participation[l] * pushed[l];
            viscous[l] += m.damping[l] * damped[l];
        }
    }
    Works {
        input: total(&input),
        viscous: total(&viscous),
    }
}

#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
pub(super) fn contact_works(series: &mut Series) {
    let (rule, last, step) = (&series.tables.rule, series.last, series.step);
    for touch in &mut series.touches {
        let force = sample(&touch.force, last, &rule.powers);
        let rate = sample(&touch.rate, last, &rule.powers);
        let (mut work, mut impulse) = (Lane::ZERO, Lane::ZERO);
        for l in 0..WIDTH {
            impulse[l] = rule.weights[l] * force[l];
            work[l] = impulse[l] * rate[l];
        }
        touch.works = (step * total(&work), step * total(&impulse));
    }
}
