//! Isolators under a building.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_hysteresis::{HysteresisError, LawParameters, build, yield_deformation};

use crate::storey_law::StoreyLaw;

/// Isolators of a building, all of them together: its first storey, below its base slab.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Isolator {
    /// What they are.
    pub kind: IsolatorKind,
    /// Dashpot beside them (N s/m).
    pub dashpot: f64,
}

/// Kinds of isolators.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum IsolatorKind {
    /// Lead-rubber bearings, or plain rubber bearings with a `stiffness_ratio` of 1: the law
    /// `bilinear`.
    LeadRubber {
        /// How stiff they are after yield.
        post_yield: PostYield,
        /// Where they yield; `None` for plain rubber alone.
        strength: Option<Strength>,
        /// Stiffness before yield over that after (-).
        stiffness_ratio: f64,
    },
    /// Sliders on dishes: the law `friction_pendulum`.
    FrictionPendulum {
        /// Effective radius (m).
        radius: f64,
        /// Coefficient of friction at high speed (-).
        friction_fast: f64,
        /// Coefficient of friction at rest (-).
        friction_slow: f64,
        /// How fast friction grows with the speed (s/m).
        rate: f64,
        /// Displacement over which it builds up (m).
        yield_displacement: f64,
    },
}

/// Stiffness of isolators after yield.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PostYield {
    /// The period (s) that the whole weight has on it.
    Period(f64),
    /// The stiffness (N/m).
    Stiffness(f64),
}

/// Strength of isolators.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Strength {
    /// Characteristic strength, the force at zero displacement, over the weight (-).
    OfWeight(f64),
    /// Yield force (N).
    YieldForce(f64),
}

/// Isolators that cannot be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IsolatorError {
    /// A strength that is no part of the weight.
    #[error(
        "the isolators have a characteristic strength of {share} of the weight, which must be above 0 and below 1"
    )]
    Strength {
        /// Strength over weight (-).
        share: f64,
    },
    /// A period or stiffness after yield that cannot be.
    #[error("{name} = {value} of the isolators after yield must be greater than zero and finite")]
    PostYield {
        /// `post_yield_period` (s) or `post_yield_stiffness` (N/m).
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A ratio of stiffnesses that is none.
    #[error("stiffness_ratio = {ratio} must be 1 or more")]
    Ratio {
        /// Stiffness before yield over that after (-).
        ratio: f64,
    },
    /// Plain rubber with a strength.
    #[error("a stiffness_ratio of 1 is plain rubber, which does not yield")]
    PlainWithStrength,
    /// Lead rubber without one.
    #[error("lead-rubber isolators have no strength")]
    NoStrength,
    /// What the law says.
    #[error(transparent)]
    Law(#[from] HysteresisError),
}

impl IsolatorError {
    /// What to try.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        let help = match self {
            Self::Strength { .. } => {
                "usual are 0.03 to 0.10 of the weight: correct `strength` or `yield_force`"
            }
            Self::PostYield { .. } => {
                "usual is a period of 2 to 4 s, with its unit: correct it, or give the stiffness after yield"
            }
            Self::Ratio { .. } => "usual are 6.5 to 15; leave it out for 10",
            Self::PlainWithStrength => {
                "leave `strength` and `yield_force` out, or give a stiffness_ratio above 1"
            }
            Self::NoStrength => {
                "add `strength`, characteristic strength over weight such as 0.06, or `yield_force`; `stiffness_ratio = 1` is plain rubber"
            }
            Self::Law(error) => return error.help(),
        };
        Some(help.to_owned())
    }
}

/// What isolators are under a building.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IsolatorProperties {
    /// Weight on them (N).
    pub weight: f64,
    /// Stiffness before yield, or before sliding at rest (N/m).
    pub initial_stiffness: f64,
    /// Stiffness after that (N/m).
    pub post_yield_stiffness: f64,
    /// Characteristic strength: the force at zero displacement after yield, of a slider at
    /// high speed (N); zero for plain rubber.
    pub strength: f64,
    /// Displacement at yield (m); zero for plain rubber.
    pub yield_displacement: f64,
}

impl IsolatorProperties {
    /// Period of the whole weight on the stiffness after yield (s).
    #[must_use]
    pub fn post_yield_period(&self) -> f64 {
        self.period(self.post_yield_stiffness)
    }

    fn period(&self, stiffness: f64) -> f64 {
        TAU * (self.weight / (STANDARD_GRAVITY * stiffness)).sqrt()
    }

    /// Effective period (s) and damping ratio (-) at a displacement (m): of the secant
    /// stiffness `k2 + Q / D`, and of the loop `2 Q (D - y) / (pi k D^2)` (Naeim and Kelly,
    /// Design of Seismic Isolated Structures, 1999). Dashpots are left out.
    #[must_use]
    pub fn effective(&self, displacement: f64) -> (f64, f64) {
        if displacement <= self.yield_displacement || self.strength == 0.0 {
            return (self.period(self.initial_stiffness), 0.0);
        }
        let secant = self.post_yield_stiffness + self.strength / displacement;
        let way = displacement - self.yield_displacement;
        let damping = 2.0 * self.strength * way / (PI * secant * displacement * displacement);
        (self.period(secant), damping)
    }
}

impl Isolator {
    /// Name of the kind in case files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self.kind {
            IsolatorKind::LeadRubber { .. } => "lead_rubber",
            IsolatorKind::FrictionPendulum { .. } => "friction_pendulum",
        }
    }

    /// What they are under this mass of all floors (kg).
    ///
    /// # Errors
    /// A period, stiffness, strength or ratio that cannot be.
    pub fn properties(&self, mass: f64) -> Result<IsolatorProperties, IsolatorError> {
        let weight = mass * STANDARD_GRAVITY;
        match self.kind {
            IsolatorKind::LeadRubber {
                post_yield,
                strength,
                stiffness_ratio: ratio,
            } => {
                let (name, value) = match post_yield {
                    PostYield::Period(period) => ("post_yield_period", period),
                    PostYield::Stiffness(stiffness) => ("post_yield_stiffness", stiffness),
                };
                let after = match post_yield {
                    PostYield::Period(period) => mass * (TAU / period).powi(2),
                    PostYield::Stiffness(stiffness) => stiffness,
                };
                let sound = |x: f64| x.is_finite() && x > 0.0;
                if !(sound(value) && sound(after)) {
                    return Err(IsolatorError::PostYield { name, value });
                }
                if !(ratio.is_finite() && ratio >= 1.0) {
                    return Err(IsolatorError::Ratio { ratio });
                }
                let strength = match (strength, ratio == 1.0) {
                    (None, true) => 0.0,
                    (Some(_), true) => return Err(IsolatorError::PlainWithStrength),
                    (None, false) => return Err(IsolatorError::NoStrength),
                    (Some(Strength::OfWeight(share)), false) => share * weight,
                    (Some(Strength::YieldForce(force)), false) => force * (1.0 - 1.0 / ratio),
                };
                let share = strength / weight;
                if ratio > 1.0 && !(share > 0.0 && share < 1.0) {
                    return Err(IsolatorError::Strength { share });
                }
                let yields = if ratio > 1.0 {
                    strength / (after * (ratio - 1.0))
                } else {
                    0.0
                };
                Ok(IsolatorProperties {
                    weight,
                    initial_stiffness: ratio * after,
                    post_yield_stiffness: after,
                    strength,
                    yield_displacement: yields,
                })
            }
            IsolatorKind::FrictionPendulum {
                radius,
                friction_fast,
                friction_slow,
                yield_displacement,
                ..
            } => Ok(IsolatorProperties {
                weight,
                initial_stiffness: weight / radius + friction_slow * weight / yield_displacement,
                post_yield_stiffness: weight / radius,
                strength: friction_fast * weight,
                yield_displacement,
            }),
        }
    }

    /// Their law under this mass of all floors (kg); `None` for plain rubber, which is a
    /// linear storey.
    ///
    /// # Errors
    /// As [`Isolator::properties`], and what the law refuses.
    pub fn law(&self, mass: f64) -> Result<Option<StoreyLaw>, IsolatorError> {
        let properties = self.properties(mass)?;
        let (name, parameters) = match self.kind {
            IsolatorKind::LeadRubber {
                stiffness_ratio: 1.0,
                ..
            } => return Ok(None),
            IsolatorKind::LeadRubber {
                strength,
                stiffness_ratio,
                ..
            } => {
                let force = match strength {
                    Some(Strength::YieldForce(force)) => force,
                    _ => properties.strength / (1.0 - 1.0 / stiffness_ratio),
                };
                let parameters = vec![
                    ("stiffness", properties.initial_stiffness),
                    ("yield_force", force),
                    ("hardening_ratio", 1.0 / stiffness_ratio),
                ];
                ("bilinear", parameters)
            }
            IsolatorKind::FrictionPendulum {
                radius,
                friction_fast,
                friction_slow,
                rate,
                yield_displacement,
            } => {
                let parameters = vec![
                    ("weight", properties.weight),
                    ("radius", radius),
                    ("friction_fast", friction_fast),
                    ("friction_slow", friction_slow),
                    ("friction_rate", rate),
                    ("yield_displacement", yield_displacement),
                ];
                ("friction_pendulum", parameters)
            }
        };
        let parameters = LawParameters::from_pairs(&parameters);
        let law = build(name, &parameters)?;
        Ok(Some(StoreyLaw {
            yield_drift: yield_deformation(law.descriptor(), &parameters, law.initial_stiffness()),
            law: Arc::from(law),
        }))
    }
}
