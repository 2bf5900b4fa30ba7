//! Peaks within the steps of implicit methods, which do not locate where laws of storeys and links
//! change their branch: forces and accelerations have kinks inside a step, by which maxima of
//! fits miss theirs.

use super::Peaks;
use crate::dynamics::Context;
use crate::methods::Method;
use crate::polynomial::{Polynomial, sagitta};

/// Parts of a step at whose ends a function is looked at.
const PARTS: usize = 16;
/// Places looked at around the largest value.
const SECTIONS: usize = 40;
/// Precision of the place of a peak, as a part of a step.
const NARROWEST: f64 = 1.0e-7;
/// Relative differences of values that are their round-off.
const FLAT: f64 = 1.0e-15;
/// Part of the present peak below which the ends and the middle of a step, or what a fit of it
/// reaches, are too low for a peak inside it.
pub(super) const FAR: f64 = 0.7;
/// Part of the present peak from which the largest value of a grid is looked at closer.
const NEARLY: f64 = 0.9;
/// As many times as a function changes from one place to the next it may rise between them at most.
const CHANGES: f64 = 4.0;

/// Most that the magnitude of a force may reach on a path with these ends, of which it is a function without jumps whose
/// slope has this bound: between two deformations it rises from both, and beyond them, where the path turns inside
/// the step, from one.
pub(super) fn most_on_path(deformation: &Polynomial, ends: [f64; 2], slope: f64) -> f64 {
    let [first, last] = ends.map(f64::abs);
    let along: f64 = deformation[1..].iter().sum();
    let between = 0.5 * (first + last + slope * along.abs());
    between.max(first.max(last) + slope * sagitta(deformation))
}

/// What a function reaches at places that are looked at one after the other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reached {
    /// Where it is largest, and its value there.
    top: (f64, f64),
    last: f64,
    /// Largest change from one place to the next.
    change: f64,
}

impl Reached {
    const NOTHING: Self = Self {
        top: (0.0, f64::NEG_INFINITY),
        last: f64::NAN,
        change: 0.0,
    };

    fn take(&mut self, theta: f64, value: f64) {
        if value > self.top.1 {
            self.top = (theta, value);
        }
        // The first value is no change.
        self.change = self.change.max((value - self.last).abs());
        self.last = value;
    }

    /// Whether it may exceed a peak between the places, where branches meet in a kink: it rises from one of them
    /// by some of the changes that are seen.
    fn may_exceed(&self, peak: f64, part: f64) -> bool {
        self.top.1 > part * peak && self.top.1 + CHANGES * self.change > peak
    }
}

/// Where a function of the place in a step (0 to 1) that may have kinks is largest, and its value
/// there: as exactly as values above this peak are found.
pub(super) fn largest(peak: f64, mut function: impl FnMut(f64) -> f64) -> (f64, f64) {
    let mut reached = Reached::NOTHING;
    for k in 0..=PARTS {
        let theta = k as f64 / PARTS as f64;
        reached.take(theta, function(theta));
    }
    match reached.may_exceed(peak, NEARLY) {
        true => around(reached.top, function),
        false => reached.top,
    }
}

/// The largest value near the place of the largest one of a grid, by parabolas and, where there is a kink, golden
/// sections. Source: R. P. Brent, Algorithms for Minimization without Derivatives, 1973, chapter 5.
fn around(best: (f64, f64), mut function: impl FnMut(f64) -> f64) -> (f64, f64) {
    let width = 1.0 / PARTS as f64;
    let (mut left, mut right) = ((best.0 - width).max(0.0), (best.0 + width).min(1.0));
    let section = 0.5 * (3.0 - 5.0_f64.sqrt());
    let mut x = best;
    if best.0 == left || best.0 == right {
        // The end of a step is the largest value where the function rises up to it.
        let beside = best.0
            + if best.0 == left {
                NARROWEST
            } else {
                -NARROWEST
            };
        let at = function(beside);
        if at <= best.1 {
            return best;
        }
        x = (beside, at);
    }
    let (mut second, mut third) = (x, x);
    let (mut step, mut before) = (0.0_f64, 0.0_f64);
    for _ in 0..SECTIONS {
        let middle = 0.5 * (left + right);
        if (x.0 - middle).abs() <= 2.0 * NARROWEST - 0.5 * (right - left) {
            break;
        }
        let mut by_parabola = false;
        if before.abs() > NARROWEST {
            let r = (x.0 - second.0) * (x.1 - third.1);
            let q = (x.0 - third.0) * (x.1 - second.1);
            let p = (x.0 - third.0) * q - (x.0 - second.0) * r;
            let (p, q) = if q > r {
                (-p, 2.0 * (q - r))
            } else {
                (p, 2.0 * (r - q))
            };
            by_parabola =
                p.abs() < (0.5 * q * before).abs() && p > q * (left - x.0) && p < q * (right - x.0);
            before = step;
            if by_parabola {
                step = p / q;
                let place = x.0 + step;
                if (place - left).min(right - place) < 2.0 * NARROWEST {
                    step = NARROWEST.copysign(middle - x.0);
                }
            }
        }
        if !by_parabola {
            before = if x.0 < middle {
                right - x.0
            } else {
                left - x.0
            };
            step = section * before;
        }
        let moved = if step.abs() >= NARROWEST {
            step
        } else {
            NARROWEST.copysign(step)
        };
        let next = (x.0 + moved, function(x.0 + moved));
        let flat = [second.1, third.1, next.1].map(|value| (value - x.1).abs() <= FLAT * x.1.abs());
        if next.1 >= x.1 {
            if next.0 < x.0 {
                right = x.0
            } else {
                left = x.0
            }
            (third, second, x) = (second, x, next);
        } else {
            if next.0 < x.0 {
                left = next.0
            } else {
                right = next.0
            }
            if next.1 >= second.1 || second.0 == x.0 {
                (third, second) = (second, next);
            } else if next.1 >= third.1 || third.0 == x.0 || third.0 == second.0 {
                third = next;
            }
        }
        if third.0 != second.0 && flat == [true; 3] {
            break;
        }
    }
    if x.1 > best.1 { x } else { best }
}

impl Peaks {
    /// Takes in the absolute accelerations of floors, and the sums of them, all over a step.
    pub(super) fn accelerations_between_branches(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        place: (f64, f64),
    ) {
        let mut reached = std::mem::take(&mut self.reached);
        self.look_between_branches(context, method, place, &mut reached);
        self.reached = reached;
    }

    fn look_between_branches(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        place: (f64, f64),
        reached: &mut Vec<Reached>,
    ) {
        for (parts, part) in [(2, FAR), (PARTS, NEARLY)] {
            reached.clear();
            reached.resize(self.accelerations(context), Reached::NOTHING);
            for k in 0..=parts {
                let theta = k as f64 / parts as f64;
                for (index, reached) in reached.iter_mut().enumerate() {
                    let value = self.acceleration_at(context, method, (index, theta), place);
                    reached.take(theta, value);
                }
            }
            let peak = |index: usize| self.present_acceleration(context, index);
            let mut all = reached.iter().enumerate();
            if !all.any(|(index, reached)| reached.may_exceed(peak(index), part)) {
                break;
            }
        }
        for (index, reached) in reached.iter().enumerate() {
            let (mut theta, mut top) = reached.top;
            if reached.may_exceed(self.present_acceleration(context, index), NEARLY) {
                (theta, top) = around((theta, top), |theta| {
                    self.acceleration_at(context, method, (index, theta), place)
                });
            }
            self.raise_acceleration(context, index, top, (theta, place));
        }
    }

    /// The magnitude of an acceleration at a place in the step.
    fn acceleration_at(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        at: (usize, f64),
        place: (f64, f64),
    ) -> f64 {
        let signed = self.signed_acceleration_at(context, method, at, place);
        signed.abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The place and value of the largest value, and how often the function was asked around it.
    fn found(function: impl Fn(f64) -> f64) -> ((f64, f64), usize) {
        let mut asked = 0;
        let count = |theta: f64| {
            asked += 1;
            function(theta)
        };
        let best = largest(0.0, count);
        (best, asked - PARTS - 1)
    }

    /// Smooth maxima between places of the grid and at ends, by few questions; kinks as exactly as their places.
    #[test]
    fn maxima_are_found() {
        for k in 0..200 {
            let at = f64::from(k) / 199.0;
            let (best, asked) = found(|x| 2.0 + libm::cos(3.0 * (x - at)));
            assert!((best.0 - at).abs() < 1e-6, "{at}: {best:?}");
            assert!((best.1 - 3.0).abs() < 1e-12, "{at}: {best:?}");
            assert!(asked <= 16, "{at}: {asked}");
            // Another slope on either side.
            let (best, _) = found(|x| 1.0 - if x < at { at - x } else { 3.0 * (x - at) });
            assert!((best.1 - 1.0).abs() < 1e-6, "{at}: {best:?}");
        }
        // A monotone function and a constant one.
        assert_eq!(found(|x| 1.0 + x), ((1.0, 2.0), 1));
        assert_eq!(found(|x| 2.0 - x), ((0.0, 2.0), 1));
        let (best, asked) = found(|_| 3.0);
        assert!(best.1 == 3.0 && asked <= 3, "{best:?} {asked}");
    }

    /// A kink between two places is seen by what changes before it.
    #[test]
    fn a_kink_above_the_peak_is_looked_for() {
        for k in 1..100 {
            let at = f64::from(k) / 100.0;
            let kink = |x: f64| 1.0 - if x < at { at - x } else { 2.0 * (x - at) };
            let (_, top) = largest(1.0 - 1e-5, kink);
            assert!(top > 1.0 - 1e-6, "{at}: {top}");
        }
    }

    /// Within the bound of its slope a path reaches what is said, and may.
    #[test]
    fn paths_stay_below_their_bound() {
        // From 1 at 0 up with the slope, and down to 1.5 at 1: the largest value is 2.25.
        let deformation = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        assert_eq!(most_on_path(&deformation, [1.0, -1.5], 2.0), 2.25);
        // A path that turns: out to 0.25 and back again.
        let turning = [0.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        assert!(most_on_path(&turning, [1.0, 1.0], 2.0) >= 1.5);
    }
}
