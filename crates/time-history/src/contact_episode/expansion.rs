//! Sums over the terms of a series, in lanes.

use pounding_vectorised::vectorised;

use super::series::{Series, SeriesStep, Works};
use super::tables::{
    FEW, PARTS, Rule, TERMS, Tables, Terms, end_and_bend, sample, value_and_slope,
};
use super::touch::Touch;
use crate::polynomial::{Polynomial, combine};
use crate::system::modes::{
    ContactFree, Lane, LevelRows, ModalRow, ModeLanes, WIDTH, lane_by_lane, scale, total,
};

impl Series {
    /// Expands the motion over a step.
    pub(crate) fn expand(
        &mut self,
        constants: &ContactFree,
        rows: &LevelRows,
        touches: &[Touch],
        from: &SeriesStep<'_>,
    ) {
        self.step = from.step;
        self.ground = from.ground;
        let product = (from.rate * from.step, from.negligible);
        if product != self.product {
            // Whole samples are alike.
            (self.product, self.enough) = (product, last_term(product));
        }
        self.last = self.enough.max(from.terms);
        let places = (&constants.modes[..], &rows.levels[..]);
        let motion = (from.displacement, from.velocity);
        expand(self, places, touches, motion);
    }

    /// Cuts the step at `theta`.
    pub(crate) fn shorten(&mut self, theta: f64) {
        shorten(self, theta);
    }

    /// Cuts the step at `theta` and works out its end anew.
    pub(crate) fn cut(&mut self, theta: f64, places: Places<'_>, end: &mut EndOfStep<'_>) {
        cut(self, theta, places, end);
    }

    /// Works out the end of the step.
    pub(crate) fn finish(&mut self, places: Places<'_>, end: &mut EndOfStep<'_>) {
        finish(self, places, end);
    }

    /// Displacements, velocities and absolute accelerations of the modes at the end.
    pub(crate) fn end(
        &self,
        modes: &[ModeLanes],
        displacement: &mut [Lane],
        velocity: &mut [Lane],
        absolute: &mut [Lane],
    ) {
        end(self, modes, [displacement, velocity, absolute]);
    }

    /// Works of ground motion and damping over the step, and [`super::touch_series::TouchSeries::works`] of all closed
    /// levels with the ends of their forces.
    pub(crate) fn account(&mut self, modes: &[ModeLanes]) -> Works {
        account(self, modes)
    }

    /// The polynomial that fits a scalar series.
    pub(crate) fn fitted(&self, terms: &Terms) -> Polynomial {
        fitted(self, terms)
    }

    /// Where a scalar series has this value, from a place that is nearly right; with value and
    /// derivative there.
    pub(super) fn polished(&self, terms: &Terms, theta: f64, target: f64) -> (f64, (f64, f64)) {
        polished(terms, self.last, theta, target)
    }
}

/// Terms after which the remainder beside the motion, `x^(k+1) e^x / (k+1)!`, is negligible.
pub(super) fn last_term((x, negligible): (f64, f64)) -> usize {
    if negligible == Series::ROUND_OFF {
        // As many terms more as there are numbers of terms that do not reach so far: comparisons
        // that do not wait for each other.
        let short = FARTHEST.iter().map(|most| usize::from(x > *most));
        return FEWEST + short.sum::<usize>();
    }
    count_terms(x, negligible)
}

/// Least and greatest number of the last term.
const FEWEST: usize = 3;
const MOST: usize = TERMS - 2;

/// Greatest `x` for which every number of the last term but the greatest is enough, down to round-off.
/// Every operation of [`count_terms`] grows with `x`, after rounding too, so that halving finds it.
const FARTHEST: [f64; MOST - FEWEST] = {
    let mut farthest = [0.0; MOST - FEWEST];
    let mut k = FEWEST;
    while k < MOST {
        // Positive numbers are in the order of their bits.
        let (mut enough, mut short) = (0, 8.0_f64.to_bits());
        while short - enough > 1 {
            let middle = enough + (short - enough) / 2;
            if count_terms(f64::from_bits(middle), Series::ROUND_OFF) <= k {
                enough = middle;
            } else {
                short = middle;
            }
        }
        farthest[k - FEWEST] = f64::from_bits(enough);
        k += 1;
    }
    farthest
};

/// The same term by term.
const fn count_terms(x: f64, negligible: f64) -> usize {
    let mut k = FEWEST;
    // No step is so long that the exponential is greater than this.
    let exponential = 1.0 + x + x * x;
    let mut remainder = x * x * x * x / 24.0 * exponential;
    while remainder > negligible && k < MOST {
        k += 1;
        remainder *= x * PARTS[k + 1];
    }
    k
}

/// Expands the motion of the modes and of the closed levels, which starts from these displacements
/// and velocities of the modes, and from this penetration and rate of each of the levels.
#[vectorised]
pub(super) fn expand(
    series: &mut Series,
    (modes, levels): (&[ModeLanes], &[ModalRow]),
    touches: &[Touch],
    (displacement, velocity): (&[Lane], &[Lane]),
) {
    let lanes = series.lanes;
    copy(displacement, &mut series.displacement[..lanes]);
    copy(velocity, &mut series.velocity[..lanes]);
    let all = series.touches.iter_mut().zip(&mut series.powers);
    for ((series, powers), touch) in all.zip(touches) {
        series.push(powers, 0, touch.motion);
    }
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
    // What steps of more terms left would count in sums over four terms at once.
    let (four, count) = (series.last / 4, series.last % 4 + 1);
    for touch in &mut series.touches {
        for terms in [&mut touch.delta, &mut touch.rate, &mut touch.force] {
            for (l, term) in terms.as_chunks_mut::<4>().0[four].iter_mut().enumerate() {
                *term = if l < count { *term } else { 0.0 };
            }
        }
    }
}

/// Few lanes, without a call.
#[inline(always)]
fn copy(from: &[Lane], to: &mut [Lane]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
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

/// Powers of the place at which a series is cut.
#[inline(always)]
fn factors_of(theta: f64, last: usize) -> Terms {
    let mut factors = [1.0; TERMS];
    for k in 1..=last {
        factors[k] = factors[k - 1] * theta;
    }
    factors
}

/// Cuts the step at `theta`.
#[vectorised]
pub(super) fn shorten(series: &mut Series, theta: f64) {
    shorten_here(series, theta);
}

#[inline(always)]
fn shorten_here(series: &mut Series, theta: f64) {
    let factors = factors_of(theta, series.last);
    match series.lanes {
        1 => shorten_modes::<1>(series, &factors),
        2 => shorten_modes::<2>(series, &factors),
        3 => shorten_modes::<3>(series, &factors),
        4 => shorten_modes::<4>(series, &factors),
        lanes => {
            let terms = ..(series.last + 1) * lanes;
            let displacement = series.displacement[terms].chunks_exact_mut(lanes);
            let velocity = series.velocity[terms].chunks_exact_mut(lanes);
            for (k, (displacement, velocity)) in displacement.zip(velocity).enumerate() {
                shorten_term(displacement, velocity, factors[k]);
            }
        }
    }
    for touch in &mut series.touches {
        for terms in [&mut touch.delta, &mut touch.rate, &mut touch.force] {
            // What stands beyond the last one is multiplied by one.
            for (term, factor) in terms.iter_mut().zip(&factors) {
                *term *= factor;
            }
        }
    }
    for (bend, snap) in series.bend.iter_mut().zip(&mut series.snap) {
        lane_by_lane();
        let square = theta * theta;
        (*bend, *snap) = (scale(square, *bend), scale(square, *snap));
    }
    series.step *= theta;
}

/// Multiplies the terms of a few lanes of modes.
#[inline(always)]
fn shorten_modes<const LANES: usize>(series: &mut Series, factors: &Terms) {
    let count = ..=series.last;
    let displacement = &mut series.displacement.as_chunks_mut::<LANES>().0[count];
    let velocity = &mut series.velocity.as_chunks_mut::<LANES>().0[count];
    for ((displacement, velocity), factor) in displacement.iter_mut().zip(velocity).zip(factors) {
        shorten_term(displacement, velocity, *factor);
    }
}

#[inline(always)]
fn shorten_term(displacement: &mut [Lane], velocity: &mut [Lane], factor: f64) {
    for (x, v) in displacement.iter_mut().zip(velocity) {
        lane_by_lane();
        (*x, *v) = (scale(factor, *x), scale(factor, *v));
    }
}

/// What a series is evaluated with at its end: constants, rows of all levels, and those of them
/// whose closings are wanted.
#[derive(Clone, Copy)]
pub(crate) struct Places<'a> {
    pub constants: &'a ContactFree,
    pub rows: &'a LevelRows,
    pub levels: &'a [usize],
}

/// Where the motion at the end goes to: displacements, velocities and absolute accelerations of
/// the modes, and the closings (m) of all levels.
pub(crate) struct EndOfStep<'a> {
    pub displacement: &'a mut [Lane],
    pub velocity: &'a mut [Lane],
    pub absolute: &'a mut [Lane],
    pub closings: &'a mut [f64],
}

/// Works out the end of the step, of the modes and of the levels.
#[vectorised]
pub(super) fn finish(series: &mut Series, places: Places<'_>, end: &mut EndOfStep<'_>) {
    finish_here(series, places, end);
}

/// The same of a step that is cut at `theta` before.
#[vectorised]
pub(super) fn cut(series: &mut Series, theta: f64, places: Places<'_>, end: &mut EndOfStep<'_>) {
    shorten_here(series, theta);
    finish_here(series, places, end);
}

#[inline(always)]
fn finish_here(series: &mut Series, places: Places<'_>, end: &mut EndOfStep<'_>) {
    let (constants, rows) = (places.constants, &places.rows.levels);
    let modal = [&mut *end.displacement, end.velocity, end.absolute];
    end_here(series, &constants.modes, modal);
    for l in places.levels {
        end.closings[*l] = rows[*l].dot(end.displacement);
    }
    for touch in &mut series.touches {
        touch.rate_end = rows[touch.level].dot(end.velocity);
        touch.delta_end = end_and_bend(&touch.delta, series.last);
    }
    series.over = 0.125 * constants.rows.bound(&series.bend);
}

/// Displacements, velocities and absolute accelerations of the modes at the end.
#[vectorised]
pub(super) fn end(series: &Series, modes: &[ModeLanes], out: [&mut [Lane]; 3]) {
    end_here(series, modes, out);
}

#[inline(always)]
fn end_here(series: &Series, modes: &[ModeLanes], mut out: [&mut [Lane]; 3]) {
    match series.lanes {
        1 => end_of_few::<1>(series, modes, &mut out),
        2 => end_of_few::<2>(series, modes, &mut out),
        3 => end_of_few::<3>(series, modes, &mut out),
        4 => end_of_few::<4>(series, modes, &mut out),
        lanes => {
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
    }
}

/// Displacement, velocity, and the same of the acceleration before it is divided by the step.
type Sums = [Lane; 3];

#[inline(always)]
fn add_term([q, p, slope]: &mut Sums, order: f64, (x, v): (&Lane, &Lane)) {
    for l in 0..WIDTH {
        q[l] += x[l];
        p[l] += v[l];
        slope[l] += order * v[l];
    }
}

#[inline(always)]
fn end_of_few<const LANES: usize>(
    series: &Series,
    modes: &[ModeLanes],
    out: &mut [&mut [Lane]; 3],
) {
    let count = ..=series.last;
    let displacement = &series.displacement.as_chunks::<LANES>().0[count];
    let velocity = &series.velocity.as_chunks::<LANES>().0[count];
    let mut sums = [[Lane::ZERO; 3]; LANES];
    for (k, (x, v)) in displacement.iter().zip(velocity).enumerate().rev() {
        for c in 0..LANES {
            add_term(&mut sums[c], k as f64, (&x[c], &v[c]));
        }
    }
    put_end(series, modes, &sums, out, 0);
}

/// So many lanes from this one on.
#[inline(always)]
fn end_of<const LANES: usize>(
    series: &Series,
    modes: &[ModeLanes],
    out: &mut [&mut [Lane]; 3],
    first: usize,
) {
    let lanes = series.lanes;
    let mut sums = [[Lane::ZERO; 3]; LANES];
    for k in (0..=series.last).rev() {
        for (c, sums) in sums.iter_mut().enumerate() {
            let place = k * lanes + first + c;
            let term = (&series.displacement[place], &series.velocity[place]);
            add_term(sums, k as f64, term);
        }
    }
    put_end(series, modes, &sums, out, first);
}

#[inline(always)]
fn put_end<const LANES: usize>(
    series: &Series,
    modes: &[ModeLanes],
    sums: &[Sums; LANES],
    [displacement, velocity, absolute]: &mut [&mut [Lane]; 3],
    first: usize,
) {
    let ground = series.ground.0 + series.ground.1 * series.step;
    for (c, [q, p, slope]) in sums.iter().enumerate() {
        let c = first + c;
        (displacement[c], velocity[c]) = (*q, *p);
        for l in 0..WIDTH {
            absolute[c][l] = slope[l] / series.step + modes[c].participation[l] * ground;
        }
    }
}

/// Works of ground motion and damping over the step; those on the closed levels, and the ends of
/// their forces, go to their series.
#[vectorised]
pub(super) fn account(series: &mut Series, modes: &[ModeLanes]) -> Works {
    let works = if series.is_slow() {
        works_by::<FEW>(series, modes, &series.tables.few)
    } else {
        works_by::<WIDTH>(series, modes, &series.tables.rule)
    };
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
        touch.force_end = end_and_bend(&touch.force, last);
    }
    works
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
        let terms = series.velocity[..(last + 1) * lanes].chunks_exact(lanes);
        for (terms, powers) in terms.zip(&rule.powers).rev() {
            let v = &terms[c];
            for (node, speed) in speeds.iter_mut().enumerate() {
                let power = powers[node];
                for l in 0..WIDTH {
                    speed[l] += power * v[l];
                }
            }
        }
        let (mut pushed, mut damped) = (Lane::ZERO, Lane::ZERO);
        for (node, speed) in speeds.into_iter().enumerate() {
            // Keeps the compiler from taking six vectors before it apart for the sake of the sums;
            // eight it leaves alone.
            let speed = match NODES {
                WIDTH => speed,
                _ => *std::hint::black_box(&speed),
            };
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

/// The polynomial that fits a scalar series.
#[vectorised]
pub(super) fn fitted(series: &Series, terms: &Terms) -> Polynomial {
    let Tables { fit, basis, .. } = series.tables;
    combine(&sample(terms, series.last, fit).0, basis)
}

/// Corrections of a root at most.
const CORRECTIONS: usize = 12;

/// Where a scalar series has this value, by Newton's method from a place that is nearly right;
/// with value and derivative there.
#[vectorised]
pub(super) fn polished(terms: &Terms, last: usize, theta: f64, target: f64) -> (f64, (f64, f64)) {
    let mut x = theta;
    for _ in 0..CORRECTIONS {
        let (value, slope) = value_and_slope(terms, last, x);
        let step = (value - target) / slope;
        if !step.is_finite() {
            x = theta;
            break;
        }
        let next = (x - step).clamp(0.5 * x, 1.0_f64.min(1.5 * x));
        let close = (next - x).abs() <= 2.0 * f64::EPSILON * x;
        x = next;
        if close {
            break;
        }
    }
    (x, value_and_slope(terms, last, x))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table against the count, close to every entry of it and over the whole range.
    #[test]
    fn terms_are_counted_by_comparisons() {
        let mut seen = [false; TERMS];
        let mut same = |x: f64| {
            let counted = count_terms(x, Series::ROUND_OFF);
            assert_eq!(last_term((x, Series::ROUND_OFF)), counted, "{x:e}");
            seen[counted] = true;
        };
        for most in FARTHEST {
            let bits = most.to_bits();
            (bits - 300..bits + 300).for_each(|bits| same(f64::from_bits(bits)));
        }
        (0..200_000).for_each(|i| same(f64::from(i) * 2.0e-5));
        [
            0.0,
            f64::MIN_POSITIVE,
            1.0e-300,
            10.0,
            1.0e9,
            f64::INFINITY,
            f64::NAN,
        ]
        .into_iter()
        .for_each(&mut same);
        assert!(seen[FEWEST..=MOST].iter().all(|seen| *seen), "{seen:?}");
        for negligible in [1.0e-13, 1.0e-15, 3.0e-17] {
            for x in [0.01, 0.3, 1.3] {
                assert_eq!(last_term((x, negligible)), count_terms(x, negligible));
            }
        }
    }
}
