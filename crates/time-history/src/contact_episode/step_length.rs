//! How long a step of the pair may be, and in which variable it is taken.

use super::clock::Pace;
use super::pair::Scene;
use super::point::Point;

/// What one step tells the next.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepLength {
    /// Next step in even time (s).
    next: f64,
    /// First step (s) after a closure whose force starts like a power of time.
    first: f64,
    /// Time (s) since such a closure, while it matters.
    since: Option<f64>,
    /// Step (s) in the variable of the present start.
    growing: f64,
    /// Part of the even steps tried lately that were rejected, and whether stability limits them.
    rejections: f64,
    limited: bool,
    /// Whether the tolerance is so loose that one step of the pair is as good as series in a row.
    loose: bool,
    /// Series of powers in a row that did not reach far, and steps of the pair since the last.
    short_series: u32,
    since_series: u32,
}

/// A step to try.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Proposal {
    pub pace: Pace,
    pub length: f64,
    pub since: f64,
}

/// Steps are hardly longer than what is left of a contact.
const BEYOND: f64 = 1.5;
/// An end this far off, in steps, can be stepped to.
const REACH: f64 = 0.8;
/// Part of what is left of a contact that an even step may take.
const CLEAR: f64 = 0.6;
/// Once steps are shorter than this part of the time since closure, its singularity does
/// not limit them any more.
const FAR: f64 = 0.35;
/// Part of the time from a zero of the penetration that a series may span, and the part of
/// a step of the pair from which on it is worth while.
const CONVERGENT: f64 = 0.7;
const WORTH: f64 = 0.4;
/// Series are exact to round-off, steps of the pair to a tolerance: from this one on fewer steps are
/// worth more.
const LOOSE: f64 = 1.0e-7;
/// Bounds of the growth of steps.
const FACTORS: [f64; 2] = [0.2, 4.0];
/// Growth of the first step from start to start.
const CAREFUL: f64 = 1.2;
/// Growth of steps in the variable of a start.
const GROWING: f64 = 1.5;
/// Part of the growth that an error allows which is taken where it is more than these: after one
/// bad start, the steps of all later ones would grow back from nothing.
const TRUSTED: f64 = 0.5;
/// Part of it that is taken where a tolerance is tight.
const TIGHT: f64 = 0.65;
/// Errors below this say no more than that.
const SMALLEST: f64 = 1.0e-12;
/// After so many series that did not reach far, one is tried every so many steps.
const SHORT_SERIES: u32 = 16;
/// Weight of one even step in the part that was rejected lately.
const LATELY: f64 = 1.0 / 16.0;
/// Where more of them are rejected than the greater part, and until it is less than the smaller
/// one, stability limits the steps: the error of one that is short enough says that a step several
/// times as long will do, which is rejected.
const REJECTIONS: [f64; 2] = [0.05, 0.4];
/// Growth of such steps: they come back to the limit slowly.
const LIMITED: f64 = 1.02;
/// A penetration (m) as small as this has just begun.
const CLOSED: f64 = 1.0e-15;
/// What is nearer than this (s) is there.
const SHORTEST: f64 = 1.0e-12;
/// First guesses (s).
const GUESS: f64 = 2.0e-4;

impl StepLength {
    /// For steps of the pair to this relative tolerance.
    pub(crate) fn new(tolerance: f64) -> Self {
        Self {
            loose: tolerance >= LOOSE,
            next: GUESS,
            first: GUESS,
            since: None,
            growing: GUESS,
            rejections: 0.0,
            limited: false,
            short_series: 0,
            since_series: 0,
        }
    }

    /// The right-hand side changed; `smooth` is false at a closure whose force starts like
    /// a power of time.
    pub(crate) fn restart(&mut self, smooth: bool) {
        self.since = (!smooth).then_some(0.0);
        self.growing = self.first;
    }

    /// The next step from a point, within `rest` (s) of the interval.
    pub(crate) fn propose(&mut self, scene: &Scene<'_>, point: &Point, rest: f64) -> Proposal {
        let target = time_to_turn(scene, point);
        let end = time_to_end(scene, point);
        if self.since == Some(0.0) && closes_slowly(point, self.growing) {
            // Penetration starts like a square: no power of `s` is the better variable.
            self.since = None;
            self.next = self.growing;
        }
        let plain = |length: f64, pace: Pace| Proposal {
            pace,
            length: length.min(rest),
            since: self.since.unwrap_or(0.0),
        };
        if self.since.is_some() {
            let length = self.growing;
            let length = if target < BEYOND * length {
                target
            } else {
                length
            };
            return plain(length.min(CLEAR * end), Pace::Start);
        }
        if end < REACH * self.next {
            return Proposal {
                pace: Pace::End(end),
                length: end.min(rest),
                since: 0.0,
            };
        }
        let length = self.next.min(CLEAR * end);
        if target < BEYOND * length {
            return plain(target, Pace::Plain);
        }
        if length < rest && length > 0.6 * rest {
            return plain(0.5 * rest, Pace::Plain);
        }
        plain(length, Pace::Plain)
    }

    /// Longest step (s) of a series of powers, which must keep clear of the times at which
    /// penetrations are zero; `None` where the pair gets further, or where a penetration is below
    /// `least` (m), beside which last terms are small whether the series converges or not.
    /// `penetrations` come with their rates.
    pub(crate) fn of_series(
        &self,
        penetrations: impl Iterator<Item = (f64, f64)>,
        least: f64,
        rest: f64,
    ) -> Option<f64> {
        if self.short_series >= SHORT_SERIES && self.since_series < SHORT_SERIES {
            return None;
        }
        let mut longest = rest;
        for (delta, rate) in penetrations {
            if delta <= least {
                return None;
            }
            let away = delta / rate.abs();
            // The end is near: the pair can reach it at once.
            if rate < 0.0 && away < self.next.min(rest) {
                return None;
            }
            longest = longest.min(CONVERGENT * away);
        }
        let pair = match self.since {
            Some(_) => self.growing,
            None => self.next,
        };
        if self.loose && longest < rest && pair >= rest {
            return None;
        }
        (longest >= WORTH * pair.min(rest)).then_some(longest)
    }

    /// A series was taken over `length` (s).
    pub(crate) fn accept_series(&mut self, length: f64) {
        self.short_series = 0;
        self.since = None;
        self.next = self.next.max(length);
    }

    /// A series did not reach far.
    pub(crate) fn refuse_series(&mut self) {
        self.short_series = self.short_series.saturating_add(1);
        self.since_series = 0;
    }

    /// A step of this error was rejected; returns the shorter one to try.
    pub(crate) fn reject(&mut self, tried: &Proposal, error: f64) -> Proposal {
        let factor = factor(error);
        match tried.pace {
            Pace::Start => {
                let factor = factor.min(if self.loose { 0.85 } else { 0.7 });
                let s = |t: f64| t.sqrt().sqrt();
                let from = s(tried.since);
                let to = from + factor * (s(tried.since + tried.length) - from);
                let length = to.powi(4) - tried.since;
                self.growing = length;
                if tried.since == 0.0 {
                    self.first = length;
                }
                Proposal { length, ..*tried }
            }
            Pace::Plain | Pace::End(_) => {
                self.note_even_step(1.0);
                self.next = factor.min(0.7) * tried.length;
                Proposal {
                    pace: Pace::Plain,
                    length: self.next,
                    since: 0.0,
                }
            }
        }
    }

    /// A step was taken over `length` (s), of the `tried` one or cut short.
    pub(crate) fn accept(&mut self, tried: &Proposal, length: f64, error: f64) {
        self.since_series = self.since_series.saturating_add(1);
        let factor = factor(error);
        match tried.pace {
            Pace::Start => {
                let s = |t: f64| t.sqrt().sqrt();
                let since = tried.since + length;
                let (a, b) = (s(tried.since), s(tried.since + tried.length));
                if tried.since == 0.0 {
                    // One start is not quite like the next.
                    let wanted = (growth(error, (CAREFUL, self.loose)) * b).powi(4);
                    // A step cut short says nothing against a longer one.
                    let short = length < tried.length || tried.length < self.first;
                    let wanted = if short {
                        self.first.max(wanted)
                    } else {
                        wanted
                    };
                    self.first = wanted;
                }
                self.growing =
                    (s(since) + growth(error, (GROWING, self.loose)) * (b - a)).powi(4) - since;
                self.since = Some(since);
                if self.growing < FAR * since {
                    self.since = None;
                    self.next = self.growing;
                }
            }
            Pace::Plain => {
                self.note_even_step(0.0);
                let factor = match self.limited {
                    true => factor.min(LIMITED),
                    false => factor,
                };
                let wanted = factor * tried.length;
                // A step cut short says nothing against a longer one.
                self.next = if tried.length < self.next {
                    self.next.max(wanted)
                } else {
                    wanted
                };
            }
            Pace::End(_) => {}
        }
    }

    /// An even step was rejected (1) or taken (0).
    fn note_even_step(&mut self, rejected: f64) {
        self.rejections += LATELY * (rejected - self.rejections);
        let [leave, enter] = REJECTIONS;
        self.limited = self.rejections > if self.limited { leave } else { enter };
    }
}

/// Growth of steps in the variable of a start, of what their error allows and what they usually
/// take: no more than that where a tolerance is tight, since works are not controlled.
fn growth(error: f64, (usual, loose): (f64, bool)) -> f64 {
    if !loose {
        return (TIGHT * factor(error)).min(usual);
    }
    let allowed = 0.9 / error.max(SMALLEST).sqrt().sqrt().sqrt();
    allowed.min(usual.max(TRUSTED * allowed))
}

fn factor(error: f64) -> f64 {
    if error > 0.0 {
        (0.9 / error.sqrt().sqrt().sqrt()).clamp(FACTORS[0], FACTORS[1])
    } else {
        FACTORS[1]
    }
}

/// Whether a contact that begins gains more penetration from acceleration than from its
/// approach velocity within this time (s).
fn closes_slowly(point: &Point, time: f64) -> bool {
    point.touches.iter().any(|touch| {
        let [delta, rate, acceleration, _] = touch.motion;
        delta.abs() < CLOSED && rate < 0.5 * acceleration.abs() * time
    })
}

/// Time (s) until floors in approach stop approaching, by the present motion.
fn time_to_turn(scene: &Scene<'_>, point: &Point) -> f64 {
    let touches = scene.touches.iter().zip(&point.touches);
    touches.fold(f64::INFINITY, |earliest, (_, now)| {
        earliest.min(turn(now.motion).unwrap_or(f64::INFINITY))
    })
}

/// Time (s) until a level in approach, with this penetration and three derivatives, turns: the root
/// of `v + a t + j t^2 / 2`. Where a contact has just begun, a force like a power has a rate of
/// change that tells nothing.
fn turn([delta, v, a, j]: [f64; 4]) -> Option<f64> {
    if delta.abs() < CLOSED || v <= 0.0 || a >= 0.0 {
        return None;
    }
    let root = (a * a - 2.0 * v * j).max(0.0).sqrt();
    let time = 2.0 * v / (root - a);
    (time > SHORTEST).then_some(time)
}

/// Time (s) until the first contact ends whose force ends like a power of time.
fn time_to_end(scene: &Scene<'_>, point: &Point) -> f64 {
    let mut earliest = f64::INFINITY;
    for (touch, now) in scene.touches.iter().zip(&point.touches) {
        let model = &scene.system.levels()[touch.level].model;
        let [d, v, a, j] = now.motion;
        if model.smooth_at_closure() || v >= 0.0 || d <= 0.0 {
            continue;
        }
        let mut t = d / -v;
        for _ in 0..8 {
            let f = d + t * (v + t * (0.5 * a + t * j / 6.0));
            let slope = v + t * (a + 0.5 * t * j);
            let next = t - f / slope;
            if !(next > 0.0 && next.is_finite()) || (next - t).abs() <= 1.0e-9 * t {
                break;
            }
            t = next;
        }
        if t > SHORTEST {
            earliest = earliest.min(t);
        }
    }
    earliest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rate of change of a force like `delta^(1/4)` at a closure, where the penetration is
    /// round-off, would put the turn at once.
    #[test]
    fn a_contact_that_has_just_begun_tells_no_turn() {
        let begun = [1.0e-17, 0.3, -2.0, -1.0e13];
        assert_eq!(turn(begun), None);
        let (v, a) = (0.3, -2.0);
        let time = turn([1.0e-4, v, a, 0.0]).unwrap_or_default();
        assert!((time - v / -a).abs() < 1e-15, "{time}");
        assert_eq!(turn([1.0e-4, -v, a, 0.0]), None);
    }

    /// After one start that was far too short, those to follow grow back in one step where a
    /// tolerance is loose, but never beyond what their error allows.
    #[test]
    fn starts_grow_by_their_error() {
        for exponent in 0..20 {
            let error = libm::pow(10.0, -f64::from(exponent));
            let allowed = 0.9 * libm::pow(error.max(SMALLEST), -0.125);
            for usual in [CAREFUL, GROWING] {
                let loose = growth(error, (usual, true));
                assert!(loose <= allowed * (1.0 + 1e-12), "{error:e}");
                assert!(loose >= allowed.min(usual) * (1.0 - 1e-12), "{error:e}");
                let tight = growth(error, (usual, false));
                assert!(tight <= usual && tight <= allowed, "{error:e}");
            }
        }
        assert!(growth(1.0e-12, (CAREFUL, true)) > 10.0);
    }
}
