//! Buildings: storeys and damping.

use std::ops::Range;

use pounding_catalogue::wording::counted;
use schemars::JsonSchema;
use serde::Deserialize;

use super::law::{LawTable, storey_laws};
use super::{check_name, spread};
use crate::document::{
    Count, Dashpot, Entry, Field, Frequency, Kinds, Length, Mass, NotNegative, OneOrEach, Optional,
    Positive, Ratio, Reader, Signed, Stiffness, Time, Velocity,
};
use crate::types::{Building, Damping, Located};

/// A building
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "[[building]]")]
pub(super) struct BuildingTable {
    /// Name, unique in the case; "wall" is reserved
    name: Field<String>,
    /// Number of storeys, if no list says it
    storeys: Optional<Count<1>>,
    /// Floor mass (kg), one for all storeys or a list, bottom first
    mass: Field<OneOrEach<Positive<Mass>>>,
    /// Storey stiffness (N/m), one for all storeys or a list, bottom first
    stiffness: Field<OneOrEach<Positive<Stiffness>>>,
    /// Storey height (m), one for all storeys or a list, bottom first
    height: Field<OneOrEach<Positive<Length>>>,
    /// Floor displacement relative to the ground at time zero (m), one for all floors or a
    /// list; by default at rest
    initial_displacement: Optional<OneOrEach<Signed<Length>>>,
    /// Floor velocity relative to the ground at time zero (m/s), one for all floors or a
    /// list; by default at rest
    initial_velocity: Optional<OneOrEach<Signed<Velocity>>>,
    /// Force-deformation law with memory in the place of the storey stiffness, one for all
    /// storeys or a list of laws that name theirs; `pounding hysteresis` lists them
    law: Optional<OneOrEach<Field<LawTable>, 0>>,
    /// Whether gravity acts through the drift: takes weight above over height off every
    /// storey stiffness
    p_delta: Optional<bool>,
    /// Viscous damping, one of its kinds
    damping: Field<Kinds<DampingTable>>,
}

/// Viscous damping, one of its kinds
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    rename_all = "snake_case",
    expecting = "a table\nfor example { stiffness_proportional = 0.05 }, the ratio in the first mode"
)]
#[schemars(untagged)]
enum DampingTable {
    Ratio {
        /// Rayleigh: ratio in both `modes` (-)
        ratio: Ratio,
        /// Rayleigh: the two modes, from 1
        modes: Located<Modes>,
    },
    Rayleigh {
        /// C = alpha M + beta K
        rayleigh: Rayleigh,
    },
    StiffnessProportional {
        /// Ratio in mode 1 (-)
        stiffness_proportional: Ratio,
    },
    MassProportional {
        /// Ratio in mode 1 (-)
        mass_proportional: Ratio,
    },
    Modal {
        /// Ratio of every mode (-), or one for all
        modal: Located<OneOrEach<Ratio>>,
    },
    Dashpots {
        /// Coefficient of every storey (N s/m), or one for all
        dashpots: Located<OneOrEach<NotNegative<Dashpot>>>,
    },
}

#[derive(Clone, Deserialize, JsonSchema)]
struct Rayleigh {
    /// Mass factor (1/s)
    alpha: NotNegative<Frequency>,
    /// Stiffness factor (s)
    beta: NotNegative<Time>,
}

#[derive(Clone, Deserialize, JsonSchema)]
#[serde(expecting = "a list of two modes")]
#[schemars(extend("minItems" = 2, "maxItems" = 2, "uniqueItems" = true))]
struct Modes(Vec<Count<1>>);

impl BuildingTable {
    /// The name, if it can be one.
    pub(super) fn name(&self, reader: &Reader<'_>) -> Option<Located<String>> {
        let name = check_name(reader, self.name.clone().located()?, "building")?;
        if name.value == "wall" {
            return reader.refuse(
                name.span,
                "a building cannot be called \"wall\"",
                "in `between`, \"wall\" is the rigid wall; give the building another name",
            );
        }
        Some(name)
    }

    /// The building, with stand-ins for values that are wrong, and whether its heights are
    /// sound.
    pub(super) fn read(
        self,
        reader: &Reader<'_>,
        place: Range<usize>,
        name: Option<Located<String>>,
    ) -> Option<(Building, bool)> {
        let keep = reader.errors;
        let sound = !(self.mass.is_wrong() || self.stiffness.is_wrong() || self.height.is_wrong());
        let storeys = match self.storeys(reader)? {
            Some(storeys) => storeys,
            // One of the values that are wrong may say it.
            None if !sound || self.storeys.is_wrong() => return None,
            None => {
                return reader.refuse(
                    place,
                    "the building does not say how many storeys it has",
                    "add `storeys = ...`",
                );
            }
        };
        let laws = self.law.value();
        let laws = laws.map_or_else(Vec::new, |laws| storey_laws(reader, laws, storeys));
        if self.stiffness.is_wrong() {
            // A law is held against the stiffness of its storey.
            for law in &laws {
                keep.incomplete(law.model.span.clone());
            }
        }
        let damping = self.damping.located().and_then(|damping| {
            Some(Located {
                value: damping.value.0.read(reader, storeys)?,
                span: damping.span,
            })
        });
        let name = name.unwrap_or_else(|| Located {
            value: String::new(),
            span: place.clone(),
        });
        // With stand-ins for masses or stiffnesses, damping and gravity would say nothing.
        let damping = damping.filter(|_| sound).unwrap_or_else(|| {
            keep.incomplete(place.clone());
            Located {
                value: Damping::MassProportional { ratio: 0.0 },
                span: place,
            }
        });
        let heights = !self.height.is_wrong();
        let displaced = self.initial_displacement.span();
        let building = Building {
            initial_displacement: Located {
                value: each(self.initial_displacement, storeys, 0.0),
                span: displaced.unwrap_or_else(|| name.span.clone()),
            },
            initial_velocity: each(self.initial_velocity, storeys, 0.0),
            name,
            mass: each(self.mass, storeys, 1.0),
            stiffness: each(self.stiffness, storeys, 1.0),
            height: each(self.height, storeys, 1.0),
            laws,
            p_delta: self.p_delta.value().unwrap_or_default() && sound,
            damping,
        };
        Some((building, heights))
    }

    /// The number of storeys, on which `storeys` and all lists must agree; `Some(None)` if
    /// nothing says it.
    fn storeys(&self, reader: &Reader<'_>) -> Option<Option<usize>> {
        let mut known = None;
        if let Some(Field::Given(stated)) = &self.storeys {
            known = Some(("storeys", stated.value.0));
        }
        for (key, list) in [
            ("mass", length(Some(&self.mass))),
            ("stiffness", length(Some(&self.stiffness))),
            ("height", length(Some(&self.height))),
            (
                "initial_displacement",
                length(self.initial_displacement.as_ref()),
            ),
            ("initial_velocity", length(self.initial_velocity.as_ref())),
        ] {
            let Some((values, span)) = list else {
                continue;
            };
            match known {
                None => known = Some((key, values)),
                Some((other, n)) if n != values => {
                    return reader.refuse(
                        span,
                        format!(
                            "`{key}` has {}, but `{other}` says {}",
                            counted(values, "value"),
                            counted(n, "storey")
                        ),
                        "give one value per storey, or a single value for all",
                    );
                }
                Some(_) => {}
            }
        }
        Some(known.map(|(_, n)| n))
    }
}

/// Length and place of a list.
fn length<T>(list: Option<&Field<OneOrEach<T>>>) -> Option<(usize, Range<usize>)> {
    match list? {
        Field::Given(list) => Some((list.value.length()?, list.span.clone())),
        Field::Wrong => None,
    }
}

/// One value for each storey.
fn each<T: Into<f64>>(list: impl Entry<OneOrEach<T>>, storeys: usize, stand_in: f64) -> Vec<f64> {
    match list.value() {
        Some(list) => list.spread(storeys),
        None => vec![stand_in; storeys],
    }
}

impl DampingTable {
    fn read(self, reader: &Reader<'_>, storeys: usize) -> Option<Damping> {
        Some(match self {
            Self::Ratio { ratio, modes } => Damping::RayleighRatio {
                ratio: ratio.into(),
                modes: two_modes(reader, modes, storeys)?,
            },
            Self::Rayleigh { rayleigh } => Damping::Rayleigh {
                alpha: rayleigh.alpha.into(),
                beta: rayleigh.beta.into(),
            },
            Self::StiffnessProportional {
                stiffness_proportional: ratio,
            } => Damping::StiffnessProportional {
                ratio: ratio.into(),
            },
            Self::MassProportional {
                mass_proportional: ratio,
            } => Damping::MassProportional {
                ratio: ratio.into(),
            },
            Self::Modal { modal } => Damping::Modal {
                ratios: spread(reader, modal, storeys, "mode")?,
            },
            Self::Dashpots { dashpots } => Damping::Dashpots {
                coefficients: spread(reader, dashpots, storeys, "storey")?,
            },
        })
    }
}

fn two_modes(reader: &Reader<'_>, modes: Located<Modes>, storeys: usize) -> Option<[usize; 2]> {
    match modes.value.0.as_slice() {
        [Count(a), Count(b)] if a != b && *a <= storeys && *b <= storeys => Some([*a, *b]),
        _ => reader.refuse(
            modes.span,
            format!("`modes` must be two different modes from 1 to {storeys}"),
            "for a single storey use { mass_proportional = ... }",
        ),
    }
}
