//! Period and damping of a linear oscillator that stands for a yielding one, so that
//! [`crate::CombinationRule::DoubleDifference`] can be applied to yielding buildings.

use std::f64::consts::PI;

use crate::combination::Oscillator;
use crate::error::SeparationError;
use pounding_catalogue::Verification;

/// A bilinear building as an oscillator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YieldingOscillator {
    /// Period before yield (s).
    pub period: f64,
    /// Viscous damping ratio (-).
    pub damping_ratio: f64,
    /// Maximum displacement over yield displacement (-), 1 to 1000.
    pub ductility: f64,
    /// Stiffness after yield over that before (-), 0 to 1.
    pub hardening: f64,
}

/// A published way to effective period and damping.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EffectiveProperties {
    /// Secant stiffness, and the area of the bilinear loop as damping:
    /// `T sqrt(mu / (1 + alpha (mu - 1)))`,
    /// `x + (2 / pi) (1 - alpha) (mu - 1) / (mu (1 + alpha (mu - 1)))`.
    RosenbluethHerrera1964,
    /// `T (1 + 0.121 (mu - 1)^0.939)`, `x + 0.0587 (mu - 1)^0.371`.
    Iwan1980,
    /// `T (1 + 0.18 (mu - 1))`, `x + 0.16 (mu - 1)^0.9`.
    Kasai1996,
}

impl EffectiveProperties {
    /// All of them.
    pub const ALL: [Self; 3] = [
        Self::RosenbluethHerrera1964,
        Self::Iwan1980,
        Self::Kasai1996,
    ];

    /// Name, `author_year`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::RosenbluethHerrera1964 => "rosenblueth_herrera_1964",
            Self::Iwan1980 => "iwan_1980",
            Self::Kasai1996 => "kasai_1996",
        }
    }

    /// Author, year, journal.
    #[must_use]
    pub fn citation(self) -> &'static str {
        match self {
            Self::RosenbluethHerrera1964 => {
                "Rosenblueth and Herrera, Journal of the Engineering Mechanics Division 90 (1964) 263"
            }
            Self::Iwan1980 => "Iwan, Earthquake Engineering and Structural Dynamics 8 (1980) 375",
            Self::Kasai1996 => {
                "Kasai, Jagiasi and Jeng, Journal of Structural Engineering 122 (1996) 1136"
            }
        }
    }

    /// How far the formula has been checked.
    #[must_use]
    pub fn status(self) -> Verification {
        match self {
            Self::RosenbluethHerrera1964 => Verification::Verified(
                "derived: secant stiffness and area of a bilinear loop, held against a polygon",
            ),
            Self::Iwan1980 => Verification::Unverified("coefficients; fitted for ductility 2 to 8"),
            Self::Kasai1996 => {
                Verification::Unverified("coefficients, and which loops they were fitted to")
            }
        }
    }

    /// The linear oscillator that stands for a yielding one.
    ///
    /// # Errors
    /// A period that is not positive, damping or hardening outside 0 to 1, ductility outside 1 to 1000.
    pub fn apply(self, building: &YieldingOscillator) -> Result<Oscillator, SeparationError> {
        let YieldingOscillator {
            period,
            damping_ratio,
            ductility,
            hardening,
        } = *building;
        within("period", period, f64::MIN_POSITIVE..=f64::MAX, "(0, inf)")?;
        within("damping ratio", damping_ratio, 0.0..=1.0, "[0, 1]")?;
        within("ductility", ductility, 1.0..=1.0e3, "[1, 1000]")?;
        within("hardening", hardening, 0.0..=1.0, "[0, 1]")?;
        let beyond = ductility - 1.0;
        let (stretch, added) = match self {
            Self::RosenbluethHerrera1964 => {
                let strength = 1.0 + hardening * beyond;
                let loss = (1.0 - hardening) * beyond / (ductility * strength);
                ((ductility / strength).sqrt(), 2.0 / PI * loss)
            }
            Self::Iwan1980 => (
                1.0 + 0.121 * libm::pow(beyond, 0.939),
                0.0587 * libm::pow(beyond, 0.371),
            ),
            Self::Kasai1996 => (1.0 + 0.18 * beyond, 0.16 * libm::pow(beyond, 0.9)),
        };
        Ok(Oscillator {
            period: period * stretch,
            damping_ratio: damping_ratio + added,
        })
    }
}

fn within(
    quantity: &'static str,
    value: f64,
    allowed: std::ops::RangeInclusive<f64>,
    range: &'static str,
) -> Result<(), SeparationError> {
    if allowed.contains(&value) {
        return Ok(());
    }
    Err(SeparationError::OutOfRange {
        quantity,
        value,
        range,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use proptest::prelude::*;

    use super::*;

    fn yielding(ductility: f64, hardening: f64) -> YieldingOscillator {
        YieldingOscillator {
            period: 0.8,
            damping_ratio: 0.05,
            ductility,
            hardening,
        }
    }

    #[test]
    fn no_yield_changes_nothing() {
        for rule in EffectiveProperties::ALL {
            let o = rule.apply(&yielding(1.0, 0.05)).unwrap();
            assert_eq!((o.period, o.damping_ratio), (0.8, 0.05), "{rule:?}");
        }
    }

    /// Hand calculation at ductility 4: 3^0.939 = 2.80551, 3^0.371 = 1.50316, 3^0.9 = 2.68787.
    #[test]
    fn ductility_four() {
        let at = |rule: EffectiveProperties| rule.apply(&yielding(4.0, 0.0)).unwrap();
        let secant = at(EffectiveProperties::RosenbluethHerrera1964);
        assert!((secant.period - 1.6).abs() < 1.0e-12);
        assert!((secant.damping_ratio - (0.05 + 1.5 / PI)).abs() < 1.0e-12);
        let iwan = at(EffectiveProperties::Iwan1980);
        assert!((iwan.period - 0.8 * 1.339_467).abs() < 1.0e-5);
        assert!((iwan.damping_ratio - 0.138_235).abs() < 1.0e-5);
        let kasai = at(EffectiveProperties::Kasai1996);
        assert!((kasai.period - 0.8 * 1.54).abs() < 1.0e-12);
        assert!((kasai.damping_ratio - 0.480_059).abs() < 1.0e-5);
    }

    #[test]
    fn out_of_range() {
        let rule = EffectiveProperties::Iwan1980;
        assert!(rule.apply(&yielding(0.9, 0.0)).is_err());
        assert!(rule.apply(&yielding(2.0, 1.1)).is_err());
        assert!(rule.apply(&yielding(f64::NAN, 0.0)).is_err());
    }

    proptest! {
        /// Area of the loop as a polygon (shoelace formula) over `2 pi k_secant u^2`.
        #[test]
        fn damping_is_the_area_of_the_loop(mu in 1.0..10.0_f64, alpha in 0.0..0.9_f64) {
            let top = 1.0 + alpha * (mu - 1.0);
            let back = mu - 2.0;
            let corners = [(mu, top), (back, top - 2.0), (-mu, -top), (-back, 2.0 - top)];
            let mut area = 0.0;
            for i in 0..4 {
                let ((x, y), (a, b)) = (corners[i], corners[(i + 1) % 4]);
                area += 0.5 * (x * b - a * y);
            }
            let expected = area.abs() / (2.0 * PI * top * mu);
            let o = EffectiveProperties::RosenbluethHerrera1964.apply(&yielding(mu, alpha)).unwrap();
            prop_assert!((o.damping_ratio - 0.05 - expected).abs() < 1.0e-12);
        }
    }
}
