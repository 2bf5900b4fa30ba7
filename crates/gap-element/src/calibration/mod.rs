//! The factor `alpha` of Papi and Toopchi-Nezhad 2022, found by the paper's search:
//! a body is dropped on a slab again and again with another `alpha` until it
//! rebounds as it should. Beside it the `alpha` of a free collision, in closed form.

mod root;

use crate::classes::hunt_crossley::damping_factor;
use crate::collision::{Bodies, CollisionOptions, collide_with};
use crate::error::GapElementError;
use crate::model::{APPROACH_VELOCITY_FLOOR, ImpactModel};
use crate::models::papi_toopchi_2022::published_alpha;
use crate::parameters::ModelParameters;
use crate::registry;

/// Maximum `alpha` that is tried: the law is elastic to six digits there.
pub const GREATEST_ALPHA: f64 = 1.0e6;

/// A body dropped on a slab.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DropTest {
    /// Mass of the body (kg).
    pub mass: f64,
    /// Acceleration of gravity that acts during the contact (m/s2); zero is a free
    /// collision.
    pub gravity: f64,
    /// Velocity at first contact (m/s).
    pub approach_velocity: f64,
    /// Linear contact stiffness (N/m).
    pub stiffness: f64,
    /// Time after first contact at which the rebound is read (s); `None`: where the
    /// body leaves the slab.
    pub read_at: Option<f64>,
}

impl DropTest {
    /// The same body without gravity, read where it leaves the slab.
    #[must_use]
    pub fn free(self) -> Self {
        Self {
            gravity: 0.0,
            read_at: None,
            ..self
        }
    }

    /// Restitution (-) that the test shows: rebound velocity over approach velocity,
    /// zero if the body stays on the slab, negative if it still moves downwards.
    ///
    /// # Errors
    /// Conditions that are not positive, a collision that fails, or a body that
    /// falls back on the slab before the reading.
    pub fn restitution(&self, model: &dyn ImpactModel) -> Result<f64, CalibrationError> {
        self.check()?;
        let bodies = Bodies {
            mass_left: self.mass,
            mass_right: None,
            velocity_left: self.approach_velocity,
            velocity_right: 0.0,
        };
        let options = CollisionOptions {
            pressing_acceleration: self.gravity,
            read_at: self.read_at,
        };
        let outcome = collide_with(model, &bodies, &options)?;
        match (self.read_at, outcome.reading) {
            (None, _) => Ok(outcome.restitution),
            (Some(_), Some(reading)) => Ok(-reading.velocity / self.approach_velocity),
            (Some(_), None) if outcome.stays_in_contact => Ok(0.0),
            (Some(read_at), None) => Err(CalibrationError::FallsBack {
                read_at,
                duration: outcome.duration,
            }),
        }
    }

    /// Restitution (-) of the law of Papi and Toopchi-Nezhad 2022 with this `alpha`.
    ///
    /// # Errors
    /// As [`DropTest::restitution`], and values that the law does not allow.
    pub fn restitution_with(&self, requested: f64, alpha: f64) -> Result<f64, CalibrationError> {
        self.check()?;
        let parameters = ModelParameters::from_pairs(&[
            ("stiffness", self.stiffness),
            ("restitution", requested),
            ("alpha", alpha),
        ]);
        let model = registry::build("papi_toopchi_2022", &parameters)?;
        self.restitution(model.as_ref())
    }

    /// Whether the law divides by [`APPROACH_VELOCITY_FLOOR`] rather than by the approach velocity,
    /// so that it is damped less.
    #[must_use]
    pub fn is_below_floor(&self) -> bool {
        self.approach_velocity < APPROACH_VELOCITY_FLOOR
    }

    /// An error of the search, in which the slow collision is why the restitution is too large.
    fn too_slow(&self, error: CalibrationError) -> CalibrationError {
        match error {
            CalibrationError::NoRoot {
                requested,
                achieved_low,
                achieved_high,
                ..
            } if self.is_below_floor() && achieved_low.min(achieved_high) > requested => {
                CalibrationError::TooSlow {
                    requested,
                    approach_velocity: self.approach_velocity,
                    least: APPROACH_VELOCITY_FLOOR,
                    achieved: achieved_low.min(achieved_high),
                }
            }
            other => other,
        }
    }

    fn check(&self) -> Result<(), CalibrationError> {
        for (quantity, value, unit, zero_allowed) in [
            ("mass", self.mass, "kg", false),
            ("gravity", self.gravity, "m/s^2", true),
            ("approach velocity", self.approach_velocity, "m/s", false),
            ("stiffness", self.stiffness, "N/m", false),
            ("reading time", self.read_at.unwrap_or(1.0), "s", false),
        ] {
            if !(value.is_finite() && (value > 0.0 || zero_allowed && value == 0.0)) {
                return Err(CalibrationError::NotPositive {
                    quantity,
                    value,
                    unit,
                    zero_allowed,
                });
            }
        }
        Ok(())
    }
}

/// One collision of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CalibrationStep {
    /// Factor tried (-).
    pub alpha: f64,
    /// Restitution that the drop test showed (-).
    pub achieved: f64,
}

/// A choice of `alpha`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct AlphaChoice {
    /// The factor (-).
    pub alpha: f64,
    /// Restitution that the drop test shows with it (-).
    pub achieved: f64,
    /// What it returns in a free collision (-).
    pub achieved_in_free_collision: f64,
}

/// What the search found, beside the other two choices of `alpha`.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Calibration {
    /// Restitution asked for (-).
    pub requested: f64,
    /// Every collision of the search, in its order; the last one is the result.
    pub steps: Vec<CalibrationStep>,
    /// The `alpha` with which the drop test shows the restitution asked for.
    pub found: AlphaChoice,
    /// The `alpha` that is exact in a free collision ([`free_alpha`]).
    pub free: AlphaChoice,
    /// The paper's rule ([`rule_alpha`]).
    pub rule: AlphaChoice,
}

/// What cannot be calibrated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// A restitution that no `alpha` decides on, or a tolerance that is none.
    #[error("{quantity} = {value} is outside (0, 1)")]
    OutOfRange {
        /// The quantity.
        quantity: &'static str,
        /// Its value (-).
        value: f64,
    },
    /// A condition of the drop test that is negative, zero or not a finite number.
    #[error("{quantity} = {value} {unit}, but it must be finite and {}", if *zero_allowed { "not negative" } else { "greater than zero" })]
    NotPositive {
        /// The condition.
        quantity: &'static str,
        /// Value (SI).
        value: f64,
        /// SI unit.
        unit: &'static str,
        /// Whether it may be zero.
        zero_allowed: bool,
    },
    /// The body meets the slab again before its rebound is read.
    #[error(
        "the contact ends at {duration:e} s and the body falls back before the reading at {read_at:e} s"
    )]
    FallsBack {
        /// Time of the reading after first contact (s).
        read_at: f64,
        /// Contact time (s).
        duration: f64,
    },
    /// No sign change: even the smallest or the largest `alpha` misses.
    #[error(
        "no alpha shows a restitution of {requested}: the drop test shows {achieved_low:.6} with alpha = {low} and {achieved_high:.6} with {high}"
    )]
    NoRoot {
        /// Restitution asked for (-).
        requested: f64,
        /// Least `alpha` tried.
        low: f64,
        /// What it shows (-).
        achieved_low: f64,
        /// Maximum `alpha` tried.
        high: f64,
        /// What it shows (-).
        achieved_high: f64,
    },
    /// No `alpha` shows so small a restitution in a collision slower than the law divides by.
    #[error(
        "no alpha shows a restitution of {requested} at {approach_velocity} m/s, below the {least} m/s that the law divides by at least: slower collisions are damped less, and the drop test shows {achieved:.6} at least"
    )]
    TooSlow {
        /// Restitution asked for (-).
        requested: f64,
        /// Approach velocity of the drop test (m/s).
        approach_velocity: f64,
        /// The least that the law divides by (m/s).
        least: f64,
        /// What the drop test shows at least (-).
        achieved: f64,
    },
    /// The achieved restitution jumps across the wanted one, or the tolerance is
    /// below the accuracy of the integration.
    #[error(
        "at alpha = {alpha} the drop test shows {achieved}, and nothing nearer to {requested} can be found"
    )]
    NotReached {
        /// Restitution asked for (-).
        requested: f64,
        /// Last `alpha` tried.
        alpha: f64,
        /// What it shows (-).
        achieved: f64,
    },
    /// The collision itself failed.
    #[error(transparent)]
    Collision(#[from] GapElementError),
}

impl CalibrationError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        Some(match self {
            Self::OutOfRange { quantity, .. } if *quantity == "tolerance" => {
                "1e-10 is usual; the integration is good to about 1e-12".to_owned()
            }
            Self::OutOfRange { .. } => {
                "at 1 the law is elastic whatever alpha is; 0.65 is customary for concrete"
                    .to_owned()
            }
            Self::NotPositive { .. } => "check the value and its unit; plain numbers are SI".to_owned(),
            Self::NoRoot { achieved_low, achieved_high, .. }
                if *achieved_low == 0.0 && *achieved_high == 0.0 =>
            {
                "the body does not leave the slab: its weight presses it in further than it rebounds; drop it faster, or take a lighter body or a stiffer contact; where a rebound is read from a record, read it shortly after the contact".to_owned()
            }
            Self::FallsBack { .. } | Self::NoRoot { .. } => {
                "read the rebound where the body leaves the slab, or at a time shortly after the contact".to_owned()
            }
            Self::TooSlow { least, .. } => {
                format!("give an approach velocity of {least} m/s or more")
            }
            Self::NotReached { .. } => "ask for a wider tolerance".to_owned(),
            Self::Collision(error) => return error.help(),
        })
    }
}

/// The `alpha` with which the law returns exactly `restitution` (-) in a free
/// collision: `alpha = (3/2) (1 - e^2) / y - e^2` with the exact factor `y` of the
/// class, which solves `y (1 + e) = ln((1 + y) / (1 - y e))`. It holds for every
/// mass and stiffness, and every speed from [`APPROACH_VELOCITY_FLOOR`] on, and makes the law that of `exact_hunt_crossley` with
/// `exponent = 1`.
///
/// # Errors
/// A restitution outside (0, 1).
pub fn free_alpha(restitution: f64) -> Result<f64, CalibrationError> {
    fraction("restitution", restitution)?;
    let squared = restitution * restitution;
    Ok(1.5 * (1.0 - squared) / damping_factor(restitution) - squared)
}

/// The paper's own rule: `e + 0.1` below 0.8 and 1 from there on (Papi and
/// Toopchi-Nezhad 2022, table 1; its equations misprint `e + 1`).
#[must_use]
pub fn rule_alpha(restitution: f64) -> f64 {
    published_alpha(restitution)
}

/// Finds the `alpha` with which a drop test shows the restitution asked for, to
/// within `tolerance` (-).
///
/// The search is bracketed: from 1 upwards or downwards until the test shows more at one
/// end and less at the other than was asked for, then by the ITP method (Oliveira and Takahashi, ACM Trans. Math.
/// Softw. 47 (2021) 5), which never takes more than one collision beyond bisection.
///
/// # Errors
/// A restitution outside (0, 1), a drop test that cannot be carried out, or no such
/// `alpha`.
pub fn calibrate(
    drop_test: &DropTest,
    restitution: f64,
    tolerance: f64,
) -> Result<Calibration, CalibrationError> {
    fraction("restitution", restitution)?;
    fraction("tolerance", tolerance)?;
    let mut steps = Vec::new();
    let mut attempt = |alpha: f64| {
        let achieved = drop_test.restitution_with(restitution, alpha)?;
        let step = CalibrationStep { alpha, achieved };
        steps.push(step);
        Ok::<_, CalibrationError>(step)
    };
    let found = root::search(restitution, tolerance, &mut attempt);
    let found = found.map_err(|error| drop_test.too_slow(error))?;
    let free_test = drop_test.free();
    let show = |alpha: f64| drop_test.restitution_with(restitution, alpha);
    let freely = |alpha: f64| free_test.restitution_with(restitution, alpha);
    let (rule, free) = (rule_alpha(restitution), free_alpha(restitution)?);
    Ok(Calibration {
        requested: restitution,
        found: AlphaChoice {
            alpha: found.alpha,
            achieved: found.achieved,
            achieved_in_free_collision: freely(found.alpha)?,
        },
        free: AlphaChoice {
            alpha: free,
            achieved: show(free)?,
            achieved_in_free_collision: freely(free)?,
        },
        rule: AlphaChoice {
            alpha: rule,
            achieved: show(rule)?,
            achieved_in_free_collision: freely(rule)?,
        },
        steps,
    })
}

fn fraction(quantity: &'static str, value: f64) -> Result<(), CalibrationError> {
    if value > 0.0 && value < 1.0 {
        return Ok(());
    }
    Err(CalibrationError::OutOfRange { quantity, value })
}
