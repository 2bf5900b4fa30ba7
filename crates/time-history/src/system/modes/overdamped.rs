//! Modes that are damped beyond critical, as the upper modes of tall buildings with damping
//! proportional to stiffness are: what they do between samples.
//!
//! One part of their motion dies out so fast that its fourth derivative at the start of a sample
//! says nothing of the rest; it is bounded by itself.

use super::lanes::{Lane, WIDTH};
use crate::system::System;

/// Damping ratio from which both rates of decay are far enough apart to be told from each other.
const APART: f64 = 1.1;

/// How eight modes die out freely: `A exp(-slow t) + B exp(-fast t)`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Decay {
    slow: Lane,
    fast: Lane,
    /// `1 / (fast - slow)`; infinite for modes that are damped less.
    apart: Lane,
    /// What the fast part of a function departs from its cubic by, in parts of that of its second
    /// derivative (s2).
    departs: Lane,
    /// `h^4 / 384` of the sample (s4).
    span: f64,
    /// Whether one of the modes is damped so much.
    any: bool,
}

impl Decay {
    /// Of all modes, in lanes, for samples of this length (s); empty where none is damped so much.
    pub(super) fn of_modes(system: &System, step: f64) -> Vec<Self> {
        let lanes = system.degrees_of_freedom().div_ceil(WIDTH);
        let mut decays = vec![Self::of_none(step); lanes];
        let mut any = false;
        for (building, first) in system.buildings().iter().zip(system.offsets()) {
            let modes = building.modes();
            for j in 0..building.storeys() {
                let (omega, zeta) = (modes.circular_frequency[j], modes.damping_ratio[j]);
                if zeta > APART {
                    let (lane, l) = ((first + j) / WIDTH, (first + j) % WIDTH);
                    decays[lane].set(l, (omega, zeta), step);
                    any = true;
                }
            }
        }
        if any { decays } else { Vec::new() }
    }

    fn of_none(step: f64) -> Self {
        let ones = Lane([1.0; WIDTH]);
        Self {
            slow: ones,
            fast: ones,
            apart: Lane([f64::INFINITY; WIDTH]),
            departs: ones,
            span: step.powi(4) / 384.0,
            any: false,
        }
    }

    /// The cubic through values and rates of `exp(-x theta)` at 0 and 1 departs from it by less
    /// than `1 + 4 x / 27`, as `|1 - theta|^2 theta <= 4 / 27`, and a third of its rate by less than
    /// `1 + 4 x / 9`; both by less than `x^4 / 384` too (with `TURNS` of `contact_free::lane_candidates` for the rate).
    fn set(&mut self, l: usize, (omega, zeta): (f64, f64), step: f64) {
        self.any = true;
        let root = (zeta * zeta - 1.0).sqrt();
        let fast = omega * (zeta + root);
        self.fast[l] = fast;
        self.slow[l] = omega / (zeta + root);
        self.apart[l] = 0.5 / (omega * root);
        let x = fast * step;
        self.departs[l] = (1.0 + 4.0 / 9.0 * x).min(x.powi(4) / 384.0) / (fast * fast);
    }

    /// That of a lane of modes, if one of them is damped so much: for the others there is nothing to
    /// be gained.
    #[inline(always)]
    pub(crate) fn of_lane(all: &[Self], lane: usize) -> Option<&Self> {
        all.get(lane).filter(|decay| decay.any)
    }

    /// Bounds the departure of functions whose second derivatives die out freely from these values
    /// and rates: both parts are largest at the start, where they are
    /// `A = (rate + fast value) / (fast - slow)` and `B = -(rate + slow value) / (fast - slow)`.
    /// It is `fourth`, a bound of the fourth derivative for any damping, where that is less. They
    /// depart from the cubics through values and rates at both ends of the sample by at most
    /// `h^4 / 384` times the first that is returned, a bound of the fourth derivative, and the
    /// second.
    #[inline(always)]
    pub(crate) fn bound(&self, [value, rate, fourth]: [&Lane; 3]) -> [Lane; 2] {
        let mut out = [Lane::ZERO; 2];
        for l in 0..WIDTH {
            let (slow, fast, apart) = (self.slow[l], self.fast[l], self.apart[l]);
            let of_slow = (rate[l] + fast * value[l]).abs() * apart * (slow * slow);
            let of_fast = (rate[l] + slow * value[l]).abs() * apart * self.departs[l];
            let less = self.span * of_slow + of_fast < self.span * fourth[l];
            out[0][l] = if less { of_slow } else { fourth[l] };
            out[1][l] = if less { of_fast } else { 0.0 };
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Held against the cubic through values and rates of the motion itself, at 2,000 times.
    #[test]
    fn no_cubic_departs_by_more() {
        let mut sharp = 0;
        for (zeta, omega) in [
            (1.2f64, 1.0f64),
            (1.5, 3.0),
            (4.0, 2.0),
            (12.0, 5.0),
            (40.0, 9.0),
        ] {
            let mut decay = Decay::of_none(1.0);
            decay.set(0, (omega, zeta), 1.0);
            let (slow, fast) = (decay.slow[0], decay.fast[0]);
            assert!((slow * fast / (omega * omega) - 1.0).abs() < 1e-12);
            for (value, rate) in [
                (1.0, 0.0),
                (0.0, 1.0),
                (1.0, -slow),
                (1.0, -fast),
                (-2.0, 5.0),
            ] {
                // The second derivative is `a exp(-slow t) + b exp(-fast t)`.
                let a = (rate + fast * value) / (fast - slow);
                let b = -(rate + slow * value) / (fast - slow);
                let at = |t: f64, power: i32| {
                    let part =
                        |c: f64, decay: f64| c * (-decay).powi(power - 2) * libm::exp(-decay * t);
                    part(a, slow) + part(b, fast)
                };
                let (x0, v0, x1, v1) = (at(0.0, 0), at(0.0, 1), at(1.0, 0), at(1.0, 1));
                let (mut value_by, mut rate_by) = (0.0f64, 0.0f64);
                for k in 0..=2000 {
                    let t = f64::from(k) / 2000.0;
                    let (back, t2) = (1.0 - t, t * t);
                    let cubic = x0 * (1.0 + 2.0 * t) * back * back
                        + v0 * t * back * back
                        + x1 * t2 * (3.0 - 2.0 * t)
                        - v1 * t2 * back;
                    let slope = (x1 - x0) * 6.0 * t * back
                        + v0 * (1.0 - 4.0 * t + 3.0 * t2)
                        + v1 * (3.0 * t2 - 2.0 * t);
                    value_by = value_by.max((at(t, 0) - cubic).abs());
                    rate_by = rate_by.max((at(t, 1) - slope).abs() / 3.0);
                }
                let of = |fourth: f64| {
                    let lanes = [value, rate, fourth].map(|x| Lane([x; WIDTH]));
                    decay.bound(lanes.each_ref()).map(|bound| bound[0])
                };
                let [fourth, rest] = of(f64::INFINITY);
                let bound = fourth / 384.0 + rest;
                assert!(value_by <= bound * (1.0 + 1e-9), "{zeta} {value} {rate}");
                assert!(rate_by <= 1.1 * bound, "{zeta} {value} {rate}");
                sharp += i32::from(bound < 20.0 * value_by);
                // Another bound is taken where it is less.
                assert_eq!(of(0.0), [0.0; 2]);
            }
        }
        assert!(sharp > 12, "{sharp}");
    }
}
