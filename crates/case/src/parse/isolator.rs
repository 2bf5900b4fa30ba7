//! Isolators under a building.

use std::ops::Range;

use schemars::JsonSchema;
use serde::Deserialize;

use crate::document::{
    Dashpot, Entry, Field, Force, Length, NotNegative, Number, Optional, Positive, Reader,
    Slowness, Stiffness, Time,
};
use crate::located::Located;
use crate::types::{Isolator, IsolatorKind, PostYield, Strength};

/// Isolators under a building
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "[building.isolator]")]
pub(super) struct IsolatorTable {
    /// lead_rubber or friction_pendulum
    model: Field<Model>,
    /// Lead rubber: period of the whole weight on the stiffness after yield (s)
    post_yield_period: Optional<Positive<Time>>,
    /// Lead rubber: stiffness after yield (N/m), in the place of that period
    post_yield_stiffness: Optional<Positive<Stiffness>>,
    /// Lead rubber: characteristic strength over the weight (-), usually 0.03 to 0.10
    strength: Optional<NotNegative<Number>>,
    /// Lead rubber: yield force (N), in the place of `strength`
    yield_force: Optional<Positive<Force>>,
    /// Lead rubber: stiffness before yield over that after (-), by default 10; 1 is plain
    /// rubber, which has no strength
    stiffness_ratio: Optional<Positive<Number>>,
    /// Friction pendulum: effective radius (m)
    radius: Optional<Positive<Length>>,
    /// Friction pendulum: coefficient of friction at high speed (-)
    friction_fast: Optional<Positive<Number>>,
    /// Friction pendulum: coefficient of friction at rest (-)
    friction_slow: Optional<Positive<Number>>,
    /// Friction pendulum: how fast friction grows with the speed (s/m), usually 20 to 100
    rate: Optional<Positive<Slowness>>,
    /// Friction pendulum: displacement over which friction builds up (m), usually 0.1 to 1 mm
    yield_displacement: Optional<Positive<Length>>,
    /// Dashpot beside all isolators together (N s/m), by default none
    damping: Optional<NotNegative<Dashpot>>,
}

/// Kinds of isolators.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(
    rename = "isolator",
    rename_all = "snake_case",
    expecting = "a text in quotes"
)]
enum Model {
    LeadRubber,
    FrictionPendulum,
}

impl Model {
    fn name(self) -> &'static str {
        match self {
            Self::LeadRubber => "lead_rubber",
            Self::FrictionPendulum => "friction_pendulum",
        }
    }

    fn keys(self) -> &'static str {
        match self {
            Self::LeadRubber => {
                "`post_yield_period` or `post_yield_stiffness`, `strength` or `yield_force`, `stiffness_ratio`, `damping`"
            }
            Self::FrictionPendulum => {
                "`radius`, `friction_fast`, `friction_slow`, `rate`, `yield_displacement`, `damping`"
            }
        }
    }
}

impl IsolatorTable {
    /// The isolators, whose table stands at `place`.
    pub(super) fn read(self, reader: &Reader<'_>, place: &Range<usize>) -> Option<Isolator> {
        let Located { value: model, .. } = self.model.clone().located()?;
        self.none_of_another(reader, model)?;
        let kind = match model {
            Model::LeadRubber => self.lead_rubber(reader, place)?,
            Model::FrictionPendulum => self.friction_pendulum(reader, place)?,
        };
        Some(Isolator {
            kind,
            dashpot: self.damping.number_or(0.0)?,
        })
    }

    /// Refuses keys of the other kinds.
    fn none_of_another(&self, reader: &Reader<'_>, model: Model) -> Option<()> {
        fn given<T>(
            key: &'static str,
            entry: &Optional<T>,
        ) -> Option<(&'static str, Option<Range<usize>>)> {
            entry.as_ref().map(|field| (key, field.span()))
        }
        let rubber = [
            given("post_yield_period", &self.post_yield_period),
            given("post_yield_stiffness", &self.post_yield_stiffness),
            given("strength", &self.strength),
            given("yield_force", &self.yield_force),
            given("stiffness_ratio", &self.stiffness_ratio),
        ];
        let pendulum = [
            given("radius", &self.radius),
            given("friction_fast", &self.friction_fast),
            given("friction_slow", &self.friction_slow),
            given("rate", &self.rate),
            given("yield_displacement", &self.yield_displacement),
        ];
        let others = match model {
            Model::LeadRubber => pendulum,
            Model::FrictionPendulum => rubber,
        };
        let Some((key, span)) = others.into_iter().flatten().next() else {
            return Some(());
        };
        reader.refuse(
            span?,
            format!("`{key}` has no meaning beside model = \"{}\"", model.name()),
            format!("{} takes {}", model.name(), model.keys()),
        )
    }

    fn lead_rubber(&self, reader: &Reader<'_>, place: &Range<usize>) -> Option<IsolatorKind> {
        let period = self.post_yield_period.clone().stated()?;
        let stiffness = self.post_yield_stiffness.clone().stated()?;
        let post_yield = match (period, stiffness) {
            (Some(period), None) => PostYield::Period(period.value.into()),
            (None, Some(stiffness)) => PostYield::Stiffness(stiffness.value.into()),
            (None, None) => {
                return reader.refuse(
                    place.clone(),
                    "[building.isolator] has no `post_yield_period`",
                    "add `post_yield_period = \"2.5 s\"`, usually 2 to 4 s, or `post_yield_stiffness`",
                );
            }
            (Some(_), Some(stiffness)) => {
                return either(
                    reader,
                    stiffness.span,
                    ["post_yield_period", "post_yield_stiffness"],
                );
            }
        };
        let ratio = self.stiffness_ratio.clone().stated()?;
        let stiffness_ratio = ratio.as_ref().map_or(10.0, |ratio| ratio.value.into());
        if let Some(span) = ratio.map(|r| r.span).filter(|_| stiffness_ratio < 1.0) {
            return reader.refuse(
                span,
                format!("`stiffness_ratio` = {stiffness_ratio} must be 1 or more"),
                "it is the stiffness before yield over that after: usually 6.5 to 15; leave it out for 10",
            );
        }
        let plain = stiffness_ratio == 1.0;
        let share = self.strength.clone().stated()?;
        let force = self.yield_force.clone().stated()?;
        let strength = match (share, force) {
            (Some(_), Some(force)) => {
                return either(reader, force.span, ["strength", "yield_force"]);
            }
            (None, None) if plain => None,
            (None, None) => {
                return reader.refuse(
                    place.clone(),
                    "[building.isolator] has no `strength`",
                    "add `strength = 0.06`, characteristic strength over weight, or `yield_force`; `stiffness_ratio = 1` is plain rubber without strength",
                );
            }
            (Some(share), None) => {
                let value = f64::from(share.value);
                match (plain, value == 0.0) {
                    (true, true) => None,
                    (true, false) => return does_not_yield(reader, share.span),
                    (false, _) if value > 0.0 && value < 1.0 => Some(Strength::OfWeight(value)),
                    _ => {
                        return reader.refuse(
                            share.span,
                            format!("`strength` = {value} must be above 0 and below 1"),
                            "it is the characteristic strength over the weight, usually 0.03 to 0.10; for plain rubber give `stiffness_ratio = 1`",
                        );
                    }
                }
            }
            (None, Some(force)) if plain => return does_not_yield(reader, force.span),
            (None, Some(force)) => Some(Strength::YieldForce(force.value.into())),
        };
        Some(IsolatorKind::LeadRubber {
            post_yield,
            strength,
            stiffness_ratio,
        })
    }

    fn friction_pendulum(&self, reader: &Reader<'_>, place: &Range<usize>) -> Option<IsolatorKind> {
        let radius = needed(reader, &self.radius, "radius = \"2 m\"", place);
        let fast = needed(reader, &self.friction_fast, "friction_fast = 0.08", place);
        let slow = needed(reader, &self.friction_slow, "friction_slow = 0.04", place);
        let rate = needed(reader, &self.rate, "rate = \"30 s/m\"", place);
        let over = "yield_displacement = \"1 mm\"";
        let yields = needed(reader, &self.yield_displacement, over, place);
        let (fast, slow) = (fast?, slow?);
        let (friction_fast, friction_slow) = (fast.value, slow.value);
        if friction_fast >= 1.0 {
            return reader.refuse(
                fast.span,
                format!("`friction_fast` = {friction_fast} must be below 1"),
                "it is a coefficient of friction, usually 0.03 to 0.12",
            );
        }
        if friction_slow > friction_fast {
            return reader.refuse(
                slow.span,
                format!("`friction_slow` = {friction_slow} is above `friction_fast` = {friction_fast}"),
                "friction grows with the speed: `friction_slow` is usually 0.3 to 0.6 of `friction_fast`",
            );
        }
        Some(IsolatorKind::FrictionPendulum {
            radius: radius?.value,
            friction_fast,
            friction_slow,
            rate: rate?.value,
            yield_displacement: yields?.value,
        })
    }
}

fn either<T>(reader: &Reader<'_>, span: Range<usize>, [one, other]: [&str; 2]) -> Option<T> {
    reader.refuse(
        span,
        format!("isolators have either `{one}` or `{other}`, not both"),
        "leave one of them out",
    )
}

fn does_not_yield<T>(reader: &Reader<'_>, span: Range<usize>) -> Option<T> {
    reader.refuse(
        span,
        "`stiffness_ratio = 1` is plain rubber, which does not yield",
        "leave `strength` and `yield_force` out, or give a ratio above 1",
    )
}

/// A value (SI) that must be given; `example` begins with its key.
fn needed<T: Into<f64> + Clone>(
    reader: &Reader<'_>,
    entry: &Optional<T>,
    example: &str,
    place: &Range<usize>,
) -> Option<Located<f64>> {
    if let Some(Located { value, span }) = entry.clone().stated()? {
        return Some(Located {
            value: value.into(),
            span,
        });
    }
    let key = example.split(' ').next().unwrap_or_default();
    reader.refuse(
        place.clone(),
        format!("[building.isolator] has no `{key}`"),
        format!("add `{example}`"),
    )
}
