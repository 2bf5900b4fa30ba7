//! The first event in a series of the coordinates, located on the series itself.

use pounding_gap_element::{Direction, Guard};

use super::ExactSteps;
use crate::bernstein::{Rise, isolated_rise_of_series};
use crate::driver::{Driver, EVENT_TOLERANCE};
use crate::events::{Candidate, EventKind};

/// A function nearer to zero than this (m, m/s) at the start, or than this part of its largest
/// term, may lie on its root.
const CLEAR_OF_ZERO: f64 = 1.0e-11;
const CLEAR_PART: f64 = 1.0e-10;
/// A function that leaves its root at the start changes over the step by more than this, and by
/// so many times what it has there.
const CLEAR_CHANGE: f64 = 1.0e-8;
const CLEAR_TIMES: f64 = 1.0e4;
/// Corrections of a root at most.
const CORRECTIONS: usize = 60;

/// What the levels do over a series.
pub(super) enum Scan {
    /// None has an event.
    Clear,
    /// This is the first.
    First(Candidate),
    /// One starts on a root, only touches zero, or has a guard that is no series.
    Unclear,
}

impl Driver<'_> {
    /// Looks for the first event of every level over the series. Those that the bounds do not
    /// exclude are decided by the Bernstein hull of the whole series.
    pub(super) fn scan(&mut self, exact: &ExactSteps) -> Scan {
        let candidates = &mut self.finder.candidates;
        candidates.clear();
        let mut earliest: Option<Candidate> = None;
        let mut take = |rise: Option<Option<f64>>, level: usize, kind: EventKind| {
            let Some(found) = rise else {
                return false;
            };
            if let Some(theta) = found {
                let candidate = Candidate { level, kind, theta };
                candidates.push(candidate);
                if earliest.is_none_or(|e| theta < e.theta) {
                    earliest = Some(candidate);
                }
            }
            true
        };
        for (l, row) in exact.levels.iter().enumerate() {
            let width = self.contacts.width(l);
            let (least, most) = row.range(&exact.propagation.ends, 0);
            let closed = self.contacts.contact(l);
            let apart = closed.is_none() && most < width;
            let transitions = closed.map_or(&[][..], |contact| {
                let level = &self.system.levels()[l];
                level.model.transitions(contact.phase)
            });
            let together = closed.is_some() && least > width && transitions.is_empty();
            if apart || together {
                continue;
            }
            let (delta, rate) = exact.series.closing(l, width);
            let last = exact.series.last();
            let (delta, rate) = (&delta[..=last], &rate[..=last]);
            if closed.is_none() {
                if !take(rise(delta, 1.0), l, EventKind::Close) {
                    return Scan::Unclear;
                }
                continue;
            }
            if !take(rise(delta, -1.0), l, EventKind::Open) {
                return Scan::Unclear;
            }
            for (index, transition) in transitions.iter().enumerate() {
                let sign = match transition.direction {
                    Direction::Rising => 1.0,
                    Direction::Falling => -1.0,
                };
                let found = match transition.guard {
                    Guard::Velocity => rise(rate, sign),
                    _ => None,
                };
                if !take(found, l, EventKind::Transition(index)) {
                    return Scan::Unclear;
                }
            }
        }
        match earliest {
            None => Scan::Clear,
            Some(first) if first.theta * exact.series.length() <= EVENT_TOLERANCE => Scan::Unclear,
            Some(first) => Scan::First(first),
        }
    }
}

/// First place at which a series, times a sign, becomes positive; `None` if that is unclear.
fn rise(terms: &[f64], sign: f64) -> Option<Option<f64>> {
    let mut signed = [0.0; 48];
    let signed = signed.get_mut(..terms.len())?;
    for (s, t) in signed.iter_mut().zip(terms) {
        *s = sign * t;
    }
    let largest = signed.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let clear = CLEAR_OF_ZERO.max(CLEAR_PART * largest);
    let signed = if signed[0] < -clear {
        signed
    } else {
        // From its root, as after an event of the same level, it falls at once: what it has
        // there is round-off, and the rest is divided by the time.
        let falls = -CLEAR_CHANGE.max(CLEAR_TIMES * signed[0].abs());
        if !(signed[0].abs() <= clear && signed.len() > 2 && signed[1] < falls) {
            return None;
        }
        &mut signed[1..]
    };
    match isolated_rise_of_series(signed) {
        Rise::Never => Some(None),
        Rise::Within(left, right) => Some(Some(polish(signed, (left, right)))),
        Rise::Unclear => None,
    }
}

/// The root between these by Newton's method, kept inside.
fn polish(terms: &[f64], (mut low, mut high): (f64, f64)) -> f64 {
    let mut x = 0.5 * (low + high);
    for _ in 0..CORRECTIONS {
        let (mut value, mut slope) = (0.0, 0.0);
        for term in terms.iter().rev() {
            slope = slope * x + value;
            value = value * x + term;
        }
        if value > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let newton = x - value / slope;
        let inside = newton > low && newton < high;
        let next = if inside { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 2.0 * f64::EPSILON * x {
            return next;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_rise_of_a_sine_is_found_to_round_off() {
        // sin(3 (theta - 0.2)) in powers of theta: derivatives of the sine at -0.6.
        let mut terms = [0.0; 40];
        let (mut factor, phase) = (1.0, -0.6_f64);
        for (k, term) in terms.iter_mut().enumerate() {
            let turn = 0.5 * std::f64::consts::PI * k as f64;
            *term = factor * libm::sin(phase + turn);
            factor *= 3.0 / (k + 1) as f64;
        }
        let found = rise(&terms, 1.0).flatten().expect("a rise");
        assert!((found - 0.2).abs() < 1e-14, "{found:e}");
        // It starts negative, so that its other sign is on the wrong side.
        assert_eq!(rise(&terms, -1.0), None);
    }

    #[test]
    fn a_sine_that_leaves_its_root_rises_half_a_period_later() {
        // -sin(4 theta), with round-off at the root.
        let mut terms = [0.0; 40];
        let mut factor = -1.0;
        for (k, term) in terms.iter_mut().enumerate().skip(1) {
            factor *= 4.0 / k as f64;
            *term = match k % 4 {
                1 => factor,
                3 => -factor,
                _ => 0.0,
            };
        }
        terms[0] = 1.0e-16;
        let found = rise(&terms, 1.0).flatten().expect("a rise");
        let half = 0.25 * std::f64::consts::PI;
        assert!((found - half).abs() < 1e-14, "{found:e}");
        // The other way it rises at once.
        assert_eq!(rise(&terms, -1.0), None);
        // A function that stays on its root for a while tells nothing.
        terms[1] = 1.0e-12;
        assert_eq!(rise(&terms, 1.0), None);
    }
}
