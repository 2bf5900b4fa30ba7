//! The first event of every level inside a step.

use pounding_gap_element::{Direction, Guard, Phase, Transition};

use super::pair::Scene;
use super::series::{LEADING, Series, stays_positive};
use super::span::Span;
use super::tables::{TERMS, Terms};
use super::touch::Touch;
use super::touch_series::TouchSeries;
use crate::bernstein::first_rise_of_series;
use crate::contact::{Contact, Contacts};
use crate::events::{Candidate, EventKind};
use crate::polynomial::{Polynomial, first_rise_near, first_rise_of, negated, value};
use crate::system::System;
use crate::system::modes::{LevelRows, ModalRow};

/// A function that passes its root by less than this part of its size only touches it: as
/// much round-off has the motion gathered by then.
const ROUND_OFF: f64 = 1.0e-13;
/// Secants at most.
const CORRECTIONS: usize = 12;

/// Precision (of theta) of a root that only leads near the event.
const NEAR: f64 = 1.0e-6;

/// First rise of a polynomial that only leads near the root.
fn near(p: &Polynomial) -> Option<f64> {
    first_rise_near(p, NEAR)
}

/// A root of the fit is that of the function if it is so soon (in theta) after where one could be.
const AT_ONCE: f64 = 1.0e-3;

/// Multiples of displacement and velocity in these two.
const DISPLACEMENT: [f64; 2] = [1.0, 0.0];
const VELOCITY: [f64; 2] = [0.0, 1.0];

/// Transitions of a closed level in its phase.
fn transitions<'a>(system: &'a System, touch: &Touch) -> &'a [Transition] {
    system.levels()[touch.level]
        .model
        .transitions(touch.contact.phase)
}

/// The guard of a transition, positive once it fires, at a penetration and a rate. Those
/// of a stuck contact do not come up here.
fn guard(system: &System, touch: &Touch, transition: Transition, delta: f64, rate: f64) -> f64 {
    let level = &system.levels()[touch.level];
    touch
        .contact
        .transition_function(level, transition, delta, rate)
}

/// The guard of an event of a closed level.
pub(crate) fn event_guard(
    system: &System,
    touch: &Touch,
    kind: EventKind,
    delta: f64,
    rate: f64,
) -> f64 {
    match kind {
        EventKind::Close => delta,
        EventKind::Open => -delta,
        // Systems with such elements never come here.
        EventKind::Branch(_) => f64::NEG_INFINITY,
        EventKind::Transition(index) => {
            let transition = transitions(system, touch)[index];
            guard(system, touch, transition, delta, rate)
        }
    }
}

/// Keeps the earliest event of a level that counts.
fn keep(
    first: &mut Option<Candidate>,
    found: Option<f64>,
    (level, kind): (usize, EventKind),
    muted: &impl Fn(usize, f64) -> bool,
) {
    if let Some(theta) = found
        && !muted(level, theta)
        && first.is_none_or(|f| theta < f.theta)
    {
        *first = Some(Candidate { level, kind, theta });
    }
}

/// The earliest of all.
fn earliest(candidates: &[Candidate]) -> Option<Candidate> {
    candidates
        .iter()
        .copied()
        .reduce(|a, b| if b.theta < a.theta { b } else { a })
}

/// Events of these levels inside a series, at whose end they have these closings and between
/// whose ends no floor's displacement exceeds both by more than `over`. `penetration` holds
/// those at the start.
pub(crate) fn in_series(
    (system, contacts, rows): (&System, &Contacts, &LevelRows),
    levels: &[usize],
    (series, touches): (&Series, &[Touch]),
    (closings, over, penetration): (&[f64], f64, &[f64]),
    candidates: &mut Vec<Candidate>,
    muted: impl Fn(usize, f64) -> bool,
) -> Option<Candidate> {
    candidates.clear();
    let mut closed = touches.iter().zip(&series.touches).peekable();
    for &l in levels {
        let mut first = None;
        if let Some((touch, motion)) = closed.next_if(|(t, _)| t.level == l) {
            let row = &rows.levels[l];
            if !stays_positive(motion.delta[0], motion.delta_end) {
                let zeros = series.leading_zeros((row, DISPLACEMENT), &motion.delta, touch.width);
                let open = fall(series, (&motion.delta, motion.delta_end), zeros);
                keep(&mut first, open, (l, EventKind::Open), &muted);
            }
            for (index, transition) in transitions(system, touch).iter().enumerate() {
                let found = passage((system, row), series, (touch, motion), *transition);
                keep(&mut first, found, (l, EventKind::Transition(index)), &muted);
            }
        } else {
            let after = closings[l] - contacts.width(l);
            // Every mode moves one floor of a level.
            if penetration[l].max(after) + over > 0.0 {
                let mut terms = series.row(&rows.levels[l]);
                terms[0] -= contacts.width(l);
                let offset = contacts.width(l);
                let zeros = series.leading_zeros((&rows.levels[l], DISPLACEMENT), &terms, offset);
                let closes = rise(series, &terms, zeros);
                keep(&mut first, closes, (l, EventKind::Close), &muted);
            }
        }
        candidates.extend(first);
    }
    earliest(candidates)
}

/// First passage of a scalar series to positive values, known to start on the other side or
/// on the root. Terms that are `zeros` are divided out: the same root is not found again,
/// while a function that leaves through it is reported at once.
fn rise(series: &Series, terms: &Terms, zeros: usize) -> Option<f64> {
    if zeros > series.terms() || zeros >= LEADING {
        // The same motion on both sides, but for round-off.
        return None;
    }
    let mut rest = [0.0; TERMS];
    let count = series.terms() + 1 - zeros;
    rest[..count].copy_from_slice(&terms[zeros..][..count]);
    if zeros > 0 && rest[0] > 0.0 {
        return Some(0.0);
    }
    let (after, bend) = series.end_and_bend(&rest);
    if rest[0].max(after) + bend < 0.0 {
        return None;
    }
    let theta = if zeros == 0 && rest[0] < 0.0 && after > 0.0 && after - rest[0] > 4.0 * bend {
        // It only rises: where the chord has its root is near enough.
        rest[0] / (rest[0] - after)
    } else {
        let mut fitted = series.fitted(&rest);
        fitted[0] = rest[0];
        // The function is nowhere above this.
        let mut above = fitted;
        above[0] += error_of_fit(&rest[..count]);
        let soonest = near(&above)?;
        match near(&fitted) {
            Some(theta) if theta <= 0.0 => return Some(theta),
            Some(theta) if theta - soonest <= AT_ONCE => theta,
            // It comes so close to zero that the fit does not tell whether it passes it.
            _ => return certain_rise(series, &rest, count),
        }
    };
    let target = target_of(&rest);
    let (root, (value, slope)) = series.polished(&rest, theta, target);
    let noise = noise_of(&rest);
    // Beyond a root it rises at least this far.
    let clear = slope * slope > 16.0 * bend * noise;
    if (value - target).abs() <= noise && slope > 0.0 && clear {
        return Some(root);
    }
    // The fit has a root where the function itself may only come close to one.
    certain_rise(series, &rest, count)
}

/// First rise of a series of so many terms by more than its noise, wherever a fit has roots.
fn certain_rise(series: &Series, terms: &Terms, count: usize) -> Option<f64> {
    let (target, noise) = (target_of(terms), noise_of(terms));
    let mut lower = *terms;
    lower[0] -= noise + target;
    let theta = first_rise_of_series(&lower[..count])?;
    // That is where it has risen so far; the event is where it begins to.
    let (root, (value, slope)) = series.polished(terms, theta, target);
    let is_root = (value - target).abs() <= noise && slope > 0.0;
    Some(if is_root { root } else { theta })
}

/// Value of a series at its event: floors that were let be may have closed by a trifle, and meet
/// again where they set out.
fn target_of(terms: &Terms) -> f64 {
    terms[0].max(0.0)
}

fn noise_of(terms: &Terms) -> f64 {
    ROUND_OFF * terms.iter().map(|c| c.abs()).sum::<f64>()
}

/// What the polynomial of degree 7 through a series at the nodes of a fit errs by at most: the
/// product of the distances from the nodes is at most `2^-14`, and the eighth derivative over `8!`
/// at most the sum of the magnitudes of terms with their binomial coefficients.
fn error_of_fit(terms: &[f64]) -> f64 {
    const FROM: usize = 8;
    let mut coefficient = 1.0;
    let mut sum = 0.0;
    for (k, term) in terms.iter().enumerate().skip(FROM) {
        sum += coefficient * term.abs();
        coefficient *= (k + 1) as f64 / (k + 1 - FROM) as f64;
    }
    sum / f64::from(1 << 14)
}

/// First passage to negative values, of a series with its end and the bound of the distance from the
/// chord.
fn fall(
    series: &Series,
    (terms, (after, bend)): (&Terms, (f64, f64)),
    zeros: usize,
) -> Option<f64> {
    let first = terms[zeros.min(TERMS - 1)];
    if zeros == 0 && terms[0].min(after) - bend > 0.0 {
        return None;
    }
    // Over theta, the second derivative has a smaller bound.
    if zeros == 1 && first.min(after - terms[0]) - bend > 0.0 {
        return None;
    }
    rise(series, &negated(*terms), zeros)
}

/// First time at which a transition fires.
fn passage(
    (system, row): (&System, &ModalRow),
    series: &Series,
    (touch, motion): (&Touch, &TouchSeries),
    transition: Transition,
) -> Option<f64> {
    let zeros = || series.leading_zeros((row, VELOCITY), &motion.rate, 0.0);
    match (transition.guard, transition.direction) {
        (Guard::Velocity, Direction::Rising) => rise(series, &motion.rate, zeros()),
        (Guard::Velocity, Direction::Falling) => {
            let ends = series.end_and_bend(&motion.rate);
            fall(series, (&motion.rate, ends), zeros())
        }
        _ => {
            let Contact {
                phase, collision, ..
            } = &touch.contact;
            let model = &system.levels()[touch.level].model;
            // The function of a contact that has let go is not that of its force, which is zero, but of
            // the law's: affine if that needs no power.
            let affine = model.is_affine(collision, *phase)
                && (*phase != Phase::Released || model.smooth_at_closure());
            if affine {
                return passage_of_affine((system, row), series, (touch, motion), transition);
            }
            let at = |x: f64| {
                let (delta, rate) = (series.at(&motion.delta, x).0, series.at(&motion.rate, x).0);
                guard(system, touch, transition, delta, rate)
            };
            let theta = first_rise_of(at, NEAR)?;
            if theta <= 0.0 {
                return Some(theta);
            }
            Some(secant(theta, at))
        }
    }
}

/// The same of a function that is affine in penetration and rate, and so a series as they are: where
/// it begins at its root, as after the transition that led here, its first terms tell whether it leaves
/// to the other side. A fit would not: what it errs by is more than the slope of floors that begin to
/// move like a high power of time.
fn passage_of_affine(
    (system, row): (&System, &ModalRow),
    series: &Series,
    (touch, motion): (&Touch, &TouchSeries),
    transition: Transition,
) -> Option<f64> {
    let function = |delta: f64, rate: f64| guard(system, touch, transition, delta, rate);
    let constant = function(0.0, 0.0);
    let factors = [function(1.0, 0.0) - constant, function(0.0, 1.0) - constant];
    let mut terms = [0.0; TERMS];
    for (term, (delta, rate)) in terms.iter_mut().zip(motion.delta.iter().zip(&motion.rate)) {
        *term = factors[0] * delta + factors[1] * rate;
    }
    terms[0] = function(motion.delta[0], motion.rate[0]);
    let offset = constant.abs() + (factors[0] * touch.width).abs();
    let zeros = series.leading_zeros((row, factors), &terms, offset);
    rise(series, &terms, zeros)
}

/// The secant method from a root that is nearly right.
fn secant(theta: f64, function: impl Fn(f64) -> f64) -> f64 {
    let (mut x, mut y) = (theta * (1.0 - 1.0e-4), theta);
    let (mut f, mut g) = (function(x), function(y));
    if f.abs() < g.abs() {
        (x, f, y, g) = (y, g, x, f);
    }
    for _ in 0..CORRECTIONS {
        let next = y - g * (y - x) / (g - f);
        if !(next > 0.0 && next <= 1.0) || (next - y).abs() <= 2.0 * f64::EPSILON * y {
            return y;
        }
        let value = function(next);
        if value.abs() >= g.abs() {
            // Down to round-off, which must not throw the root away.
            return y;
        }
        (x, f) = (y, g);
        (y, g) = (next, value);
    }
    y
}

/// Events of these levels inside a step of the pair, with `penetration` at its start.
pub(crate) fn in_span(
    scene: &Scene<'_>,
    levels: &[usize],
    contacts: &Contacts,
    span: &Span<'_>,
    penetration: &[f64],
    candidates: &mut Vec<Candidate>,
    muted: impl Fn(usize, f64) -> bool,
) -> Option<Candidate> {
    candidates.clear();
    let system = scene.system;
    let length = span.clock.offset(1.0);
    let mut closed = scene.touches.iter().enumerate().peekable();
    for &l in levels {
        let mut first = None;
        if let Some((k, touch)) = closed.next_if(|(_, t)| t.level == l) {
            let (a, b) = span.touch(k);
            let delta = span.displacement(a, b);
            let rate = span.velocity(a, b);
            let open = near(&negated(delta));
            keep(&mut first, open, (l, EventKind::Open), &muted);
            for (index, transition) in transitions(system, touch).iter().enumerate() {
                let found = fires(system, touch, *transition, (&delta, &rate));
                keep(&mut first, found, (l, EventKind::Transition(index)), &muted);
            }
        } else {
            let row = &scene.rows.levels[l];
            let [q, p, ..] = &span.end.motion;
            let [closing, from, to] = row.dot_three([q, &span.start.motion[1], p]);
            let after = closing - contacts.width(l);
            if penetration[l].max(after) + length * from.abs().max(to.abs()) > 0.0 {
                let (a, b) = span.row(row, contacts.width(l));
                let closes = near(&span.displacement(a, b));
                keep(&mut first, closes, (l, EventKind::Close), &muted);
            }
        }
        candidates.extend(first);
    }
    earliest(candidates)
}

/// An event so soon after the end of a span, within `limit` (s), that the derivatives there
/// reach it: the end of an approach or of a contact that the step was meant for. Returns it
/// with its time (s) after the end; theta is one.
pub(crate) fn soon_after(
    scene: &Scene<'_>,
    span: &Span<'_>,
    limit: f64,
) -> Option<(Candidate, f64)> {
    let mut first: Option<(Candidate, f64)> = None;
    for (touch, now) in scene.touches.iter().zip(&span.end.touches) {
        let [delta, rate, acceleration, _] = now.motion;
        let turns = |t: &Transition| {
            t.guard == Guard::Velocity && t.direction == Direction::Falling && rate > 0.0
        };
        let by_force = |t: &Transition| t.guard == Guard::RawForce;
        let (kind, time) = if rate < 0.0 {
            if transitions(scene.system, touch).iter().any(by_force) {
                // The force may end before the penetration does.
                continue;
            }
            (EventKind::Open, delta / -rate)
        } else {
            let place = transitions(scene.system, touch).iter().position(turns);
            let Some(index) = place else { continue };
            (EventKind::Transition(index), rate / -acceleration)
        };
        let level = touch.level;
        let theta = 1.0;
        if time >= 0.0 && time <= limit && first.is_none_or(|f| time < f.1) {
            first = Some((Candidate { level, kind, theta }, time));
        }
    }
    first
}

/// First theta at which a transition fires within a span.
fn fires(
    system: &System,
    touch: &Touch,
    transition: Transition,
    (delta, rate): (&Polynomial, &Polynomial),
) -> Option<f64> {
    match (transition.guard, transition.direction) {
        (Guard::Velocity, Direction::Rising) => near(rate),
        (Guard::Velocity, Direction::Falling) => near(&negated(*rate)),
        _ => {
            let at = |x: f64| {
                let (d, r) = (value(delta, x), value(rate, x));
                guard(system, touch, transition, d, r)
            };
            first_rise_of(at, NEAR)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Series that rise or not, from below zero, against the Bernstein hull: whether bounds decide,
    /// the chord or a fit leads to the root.
    #[test]
    fn rises_are_those_of_the_hull() {
        let (mut by_chord, mut others, mut never) = (0, 0, 0);
        for seed in 0..4000_usize {
            let number = |k: usize| {
                let bits = (seed * 131 + k + 1).wrapping_mul(0x9e37_79b9) % 0x1_0000;
                bits as f64 / 32768.0 - 1.0
            };
            let mut series = Series::new(1, 0);
            series.last = 9 + seed % 9;
            let rate = 0.2 + 2.5 * number(101).abs();
            let (mut terms, mut factor) = ([0.0; TERMS], 1.0e-2);
            for (k, term) in terms.iter_mut().enumerate().take(series.last + 1) {
                *term = factor * number(k);
                factor *= rate / (k + 1) as f64;
            }
            terms[0] = -terms[0].abs() - 1.0e-6;
            let (after, bend) = series.end_and_bend(&terms);
            let chord = after > 0.0 && after - terms[0] > 4.0 * bend;
            let certain = first_rise_of_series(&terms[..=series.last]);
            let found = rise(&series, &terms, 0);
            match (found, certain) {
                (Some(a), Some(b)) => {
                    let (value, slope) = series.at(&terms, a);
                    assert!(value.abs() < 1e-16, "{seed}: {value:e}");
                    assert!((a - b).abs() < 1e-11, "{seed}: {a} {b} {slope:e}");
                    (by_chord, others) = match chord {
                        true => (by_chord + 1, others),
                        false => (by_chord, others + 1),
                    };
                }
                (None, None) => never += 1,
                other => panic!("{seed}: {other:?}"),
            }
        }
        assert!(
            by_chord > 200 && others > 200 && never > 200,
            "{by_chord} {others} {never}"
        );
    }

    /// `cos(w (theta - 1/2)) - cos(w / 2) - c`, which passes zero by a little or comes as close to it,
    /// less than a fit of it errs by.
    #[test]
    fn close_passages_are_told_apart() {
        let mut by_less_than_the_fit_errs = 0;
        for product in [0.3, 0.8, 1.0, 1.3] {
            for height in [1e-12_f64, 1e-11, 1e-10, 1e-9, 1e-8] {
                let mut series = Series::new(1, 0);
                series.last = TERMS - 1;
                let mut terms = [0.0; TERMS];
                let (sine, cosine) = (libm::sin(0.5 * product), libm::cos(0.5 * product));
                let mut factor = 1.0;
                for (k, term) in terms.iter_mut().enumerate() {
                    let sign = if k % 4 < 2 { 1.0 } else { -1.0 };
                    *term = factor * sign * if k % 2 == 0 { cosine } else { sine };
                    factor *= product / (k + 1) as f64;
                }
                by_less_than_the_fit_errs += usize::from(height < error_of_fit(&terms));
                for above in [height, -height] {
                    let mut terms = terms;
                    terms[0] -= 1.0 - above;
                    let found = rise(&series, &terms, 0);
                    assert_eq!(
                        found.is_some(),
                        above > 0.0,
                        "{product} {above:e}: {found:?}"
                    );
                    if let Some(theta) = found {
                        let expected = 0.5 - (2.0 * height).sqrt() / product;
                        let error = (theta - expected).abs();
                        // Beside the round-off that is taken off, the noise of the series.
                        let allowed = 1e-12 / (height.sqrt() * product) + height;
                        assert!(error <= allowed, "{product} {height:e}: {error:e}");
                    }
                }
            }
        }
        assert!(by_less_than_the_fit_errs > 5);
    }
}
