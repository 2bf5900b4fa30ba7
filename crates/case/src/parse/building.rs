//! Buildings: storeys and damping.

use std::ops::Range;

use pounding_catalogue::wording::counted;
use pounding_shear_building::{MAXIMUM_STOREYS, WALL};
use schemars::JsonSchema;
use serde::Deserialize;

use super::force::ForceTable;
use super::foundation::FoundationTable;
use super::ground_motion::GroundTable;
use super::isolator::IsolatorTable;
use super::lateral::{CantileverTable, FishboneTable, MatrixValue, matrix, rows};
use super::law::{LawTable, storey_laws};
use super::plan::PlanTable;
use super::{check_name, spread};
use crate::document::{
    Count, Dashpot, Dimensioned, Entry, Field, Flexibility, Frequency, Kinds, Length, Mass,
    NotNegative, OneOrEach, Optional, Positive, Ratio, Reader, Signed, Stiffness, Tables, Time,
    Velocity,
};
use crate::located::Located;
use crate::types::{Building, BuildingPlaces, Damping, Isolator, Lateral};

/// A building
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "[[building]]")]
#[schemars(extend("allOf" = [
    {"oneOf": [
        {"required": ["stiffness"]},
        {"required": ["stiffness_matrix"]},
        {"required": ["flexibility_matrix"]},
        {"required": ["cantilever"]},
        {"required": ["fishbone"]},
        {"required": ["plan"]},
        {"required": ["isolator"], "not": {"required": ["stiffness"]}}
    ]},
    {"anyOf": [{"required": ["damping"]}, {"required": ["isolator"]}]},
    {"oneOf": [{"required": ["height"]}, {"required": ["elevations"]}]}
]))]
pub(super) struct BuildingTable {
    /// Name, unique in the case; "wall" is reserved
    name: Field<String>,
    /// Number of storeys, if no list says it
    storeys: Optional<Count<1, MAXIMUM_STOREYS>>,
    /// Floor mass (kg), one for all storeys or a list, bottom first
    mass: Field<OneOrEach<Positive<Mass>>>,
    /// Storey stiffness (N/m), one for all storeys or a list, bottom first
    stiffness: Optional<OneOrEach<Positive<Stiffness>>>,
    /// Lateral stiffness matrix of the floors (N/m) in the place of storey stiffnesses: its
    /// rows, bottom first, or the CSV file that holds them
    stiffness_matrix: Optional<MatrixValue<Stiffness>>,
    /// Flexibility matrix of the floors (m/N) in the place of storey stiffnesses: its rows,
    /// bottom first, or the CSV file that holds them
    flexibility_matrix: Optional<MatrixValue<Flexibility>>,
    /// A cantilever wall in the place of storey stiffnesses
    cantilever: Optional<CantileverTable>,
    /// A frame with flexible beams in the place of storey stiffnesses, its columns and beams
    /// lumped
    fishbone: Optional<FishboneTable>,
    /// Storey height (m), one for all storeys or a list, bottom first
    height: Optional<OneOrEach<Positive<Length>>>,
    /// Elevations of the floors above the base (m) in the place of storey heights, bottom
    /// first
    elevations: Optional<Vec<Positive<Length>>>,
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
    /// Isolators, which are then storey 1 below the base slab, floor 1: `mass` and `height`
    /// have all floors with the slab, `stiffness` the storeys above it, one fewer
    isolator: Optional<IsolatorTable>,
    /// Viscous damping, one of its kinds; with an isolator that of the storeys above it on a
    /// fixed slab, on a foundation of the building on a fixed base
    damping: Optional<Kinds<DampingTable>>,
    /// Foundation that sways and rocks on the soil; by default a fixed base
    foundation: Optional<FoundationTable>,
    /// Plan with frames in the place of storey stiffnesses, for floors that turn
    plan: Optional<PlanTable>,
    /// How the ground under this building moves, where not as the table ground_motion says
    ground: Optional<GroundTable>,
    /// Forces on floors over time
    force: Optional<Tables<ForceTable>>,
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
#[serde(
    expecting = "a table\nfor example rayleigh = { alpha = 0.3, beta = 0.002 }, the factors of mass (1/s) and stiffness (s); ratios in two modes are damping = { ratio = 0.05, modes = [1, 2] }"
)]
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
        if name.value == WALL {
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
        let given = self.resistances();
        let isolated = self.isolator.is_some();
        // Of a slab alone on isolators nothing else resists.
        let bare = isolated && given.is_empty();
        let stiffness_wrong = !bare && !resists(reader, &given, &place);
        let heights_given = self.heights_given(reader, &place);
        let heights_wrong = !heights_given || self.height.is_wrong() || self.elevations.is_wrong();
        let sound = !(self.mass.is_wrong() || stiffness_wrong || heights_wrong);
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
        let by_storeys = bare || given.iter().any(|stated| stated.key == "stiffness");
        let above = storeys - usize::from(isolated);
        let isolator = match isolated {
            true => self.isolators(reader, (storeys, &given), &place),
            false => None,
        };
        let undamped = bare && above == 0;
        if let Some(span) = self.damping.span().filter(|_| undamped) {
            reader.refuse::<()>(
                span,
                "a slab alone on its isolators has no storeys that `damping` could damp",
                "remove it; dashpots beside the isolators are `damping` in [building.isolator]",
            );
        }
        if !undamped && self.damping.is_none() {
            reader.refuse::<()>(
                place.clone(),
                "[[building]] has no `damping`",
                "add `damping = ...`",
            );
        }
        if let (Some(span), Some(stated), false) = (self.law.span(), given.first(), by_storeys) {
            return reader.refuse(
                span,
                format!(
                    "a `law` takes the place of one storey's stiffness, but this building has `{}`",
                    stated.key
                ),
                match stated.key {
                    "plan" => "give the frames of the plan their laws, such as { at = \"-5 m\", stiffness = \"30 MN/m\", law = { model = \"bilinear\", yield_force = \"200 kN\", hardening_ratio = 0.05 } }",
                    _ => "leave out the law, or give storey stiffnesses",
                },
            );
        }
        let lateral = lateral(
            reader,
            storeys,
            (self.stiffness_matrix, self.flexibility_matrix),
            (self.cantilever, self.fishbone),
        );
        // Floors that turn have three coordinates each.
        let modes = if self.plan.is_some() {
            3 * storeys
        } else {
            above
        };
        let plan = self.plan.located();
        let plan = plan.and_then(|given| given.value.read(reader, given.span, storeys));
        let resisted = by_storeys || lateral.is_some() || plan.is_some() || isolated;
        let stiffness_wrong = stiffness_wrong || !resisted || isolated && isolator.is_none();
        let sound = sound && !stiffness_wrong;
        let laws = self.law.value();
        let laws = laws.map_or_else(Vec::new, |laws| {
            storey_laws(reader, laws, (storeys, isolated))
        });
        if stiffness_wrong {
            // A law is held against the stiffness of its storey.
            for law in &laws {
                keep.incomplete(law.model.span.clone());
            }
        }
        let damping = match undamped {
            true => Some(Located {
                value: Damping::MassProportional { ratio: 0.0 },
                span: place.clone(),
            }),
            false => self.damping.located().and_then(|damping| {
                Some(Located {
                    value: damping.value.0.read(reader, above, modes)?,
                    span: damping.span,
                })
            }),
        };
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
        let places = BuildingPlaces {
            mass: self.mass.span(),
            stiffness: self.stiffness.span(),
            height: self.height.span().or(self.elevations.span()),
        };
        let height = match self.elevations.located() {
            Some(elevations) => heights(reader, elevations, storeys)?,
            None => each(self.height, storeys, 1.0),
        };
        let foundation = self.foundation.map(|given| {
            let read = given.located();
            let read = read.and_then(|given| given.value.read(reader, given.span));
            read.unwrap_or_else(|| FoundationTable::stand_in(name.span.clone()))
        });
        let ground = self.ground.located().and_then(|given| {
            let value = given.value.read(reader, &given.span)?;
            Some(Located {
                value,
                span: given.span,
            })
        });
        let forces = self.force.value().map_or_else(Vec::new, |tables| tables.0);
        let forces = forces.into_iter().filter_map(|force| {
            let force = force.located()?;
            force.value.read(reader, force.span, storeys)
        });
        let forces: Vec<_> = forces.collect();
        let displaced = self.initial_displacement.span();
        let building = Building {
            initial_displacement: Located {
                value: each(self.initial_displacement, storeys, 0.0),
                span: displaced.unwrap_or_else(|| name.span.clone()),
            },
            initial_velocity: each(self.initial_velocity, storeys, 0.0),
            name,
            mass: each(self.mass, storeys, 1.0),
            stiffness: match by_storeys || stiffness_wrong {
                // Without its isolator a stand-in is the first of the storeys.
                true if isolator.is_none() && isolated => vec![1.0; storeys],
                true => each(self.stiffness, above, 1.0),
                false => Vec::new(),
            },
            isolator,
            lateral,
            height,
            laws,
            p_delta: self.p_delta.value().unwrap_or_default() && sound,
            damping,
            foundation,
            ground,
            plan,
            forces,
            places,
        };
        Some((building, !heights_wrong))
    }

    /// The keys that say what resists the lateral motion.
    fn resistances(&self) -> Vec<Stated> {
        fn stated<T>(key: &'static str, entry: &Optional<T>) -> Option<Stated> {
            entry.as_ref().map(|field| Stated {
                key,
                span: field.span(),
            })
        }
        let keys = [
            stated("stiffness", &self.stiffness),
            stated("stiffness_matrix", &self.stiffness_matrix),
            stated("flexibility_matrix", &self.flexibility_matrix),
            stated("cantilever", &self.cantilever),
            stated("fishbone", &self.fishbone),
            stated("plan", &self.plan),
        ];
        keys.into_iter().flatten().collect()
    }

    /// The isolators of a building of so many storeys, with the keys that say what resists
    /// above them.
    fn isolators(
        &self,
        reader: &Reader<'_>,
        (storeys, given): (usize, &[Stated]),
        place: &Range<usize>,
    ) -> Option<Located<Isolator>> {
        let Located { value, span } = self.isolator.clone().located()?;
        if let Some(span) = self
            .p_delta
            .span()
            .filter(|_| self.p_delta.clone().value() == Some(true))
        {
            return reader.refuse(
                span,
                "`p_delta` does not go with an isolator, whose law holds what the weight does at its displacement",
                "leave `p_delta` out; a friction pendulum has the stiffness W / R of the weight, and lead rubber its stiffness under the weight",
            );
        }
        match given {
            [] if storeys > 1 => {
                return reader.refuse(
                    place.clone(),
                    "[[building]] has no `stiffness`",
                    format!(
                        "add `stiffness = ...` of the {} above the isolator, which is storey 1",
                        counted(storeys - 1, "storey")
                    ),
                );
            }
            [stated, ..] if stated.key != "stiffness" => {
                return reader.refuse(
                    stated.span.clone()?,
                    format!("an isolator is the first of a chain of storeys, but this building has `{}`", stated.key),
                    "give the storeys above the isolator by `stiffness`",
                );
            }
            [stated, ..] if storeys == 1 => {
                return reader.refuse(
                    stated.span.clone()?,
                    "the building has one floor, the base slab on its isolator, and no storey above for `stiffness`",
                    "leave `stiffness` out, or give `mass` and `height` of all floors, the slab first",
                );
            }
            _ => {}
        }
        let isolator = value.read(reader, &span)?;
        Some(Located {
            value: isolator,
            span,
        })
    }

    /// Whether one of the two keys, and one alone, says how high the storeys are.
    fn heights_given(&self, reader: &Reader<'_>, place: &Range<usize>) -> bool {
        match (&self.height, &self.elevations) {
            (None, None) => {
                reader.refuse::<()>(
                    place.clone(),
                    "[[building]] has no `height`",
                    "add `height = ...`, or `elevations = [...]`",
                );
                false
            }
            (Some(_), Some(_)) => {
                reader.refuse::<()>(
                    self.elevations.span().unwrap_or_else(|| place.clone()),
                    "a building has either `height` or `elevations`, not both",
                    "leave one of them out",
                );
                false
            }
            _ => true,
        }
    }

    /// Storeys that a list of stiffnesses is for: an isolator is one more.
    fn storeys_of_stiffness(&self) -> Option<(usize, Range<usize>)> {
        let (values, span) = length(self.stiffness.as_ref())?;
        Some((values + usize::from(self.isolator.is_some()), span))
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
            ("stiffness", self.storeys_of_stiffness()),
            (
                "stiffness_matrix",
                matrix_rows(self.stiffness_matrix.as_ref()),
            ),
            (
                "flexibility_matrix",
                matrix_rows(self.flexibility_matrix.as_ref()),
            ),
            ("height", length(self.height.as_ref())),
            ("elevations", list_length(self.elevations.as_ref())),
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
                Some((other, n))
                    if n != values && key == "stiffness" && self.isolator.is_some() =>
                {
                    return reader.refuse(
                        span,
                        format!(
                            "`stiffness` has {}, but `{other}` says {} with the isolator",
                            counted(values - 1, "value"),
                            counted(n, "storey")
                        ),
                        "the isolator is storey 1 and the base slab floor 1: `mass` and `height` have all floors with the slab, `stiffness` the storeys above it, one fewer",
                    );
                }
                Some((other, n)) if n != values => {
                    return reader.refuse(
                        span,
                        format!(
                            "`{key}` has {}, but `{other}` says {}",
                            counted(
                                values,
                                if key.ends_with("matrix") {
                                    "row"
                                } else {
                                    "value"
                                }
                            ),
                            counted(n, "storey")
                        ),
                        if key.ends_with("matrix") {
                            "give one row per floor, bottom first"
                        } else {
                            "give one value per storey, or a single value for all"
                        },
                    );
                }
                Some(_) => {}
            }
        }
        Some(known.map(|(_, n)| n))
    }
}

/// A key that is given, with the place of its value; no place where that is wrong.
struct Stated {
    key: &'static str,
    span: Option<Range<usize>>,
}

/// Whether one key, and one alone, says rightly what resists.
fn resists(reader: &Reader<'_>, given: &[Stated], place: &Range<usize>) -> bool {
    match given {
        [one] => return one.span.is_some(),
        [] => {
            reader.refuse::<()>(
                place.clone(),
                "[[building]] has no `stiffness`",
                "add `stiffness = ...`; for a frame or a wall `stiffness_matrix`, `flexibility_matrix`, `cantilever` or `fishbone`, for floors that turn `plan`",
            );
        }
        [first, second, ..] => {
            reader.refuse::<()>(
                second.span.as_ref().unwrap_or(place).clone(),
                format!(
                    "a building has either `{}` or `{}`, not both",
                    first.key, second.key
                ),
                "leave one of them out",
            );
        }
    }
    false
}

/// Length and place of a list.
fn length<T>(list: Option<&Field<OneOrEach<T>>>) -> Option<(usize, Range<usize>)> {
    match list? {
        Field::Given(list) => Some((list.value.length()?, list.span.clone())),
        Field::Wrong => None,
    }
}

/// The same of rows of a matrix.
fn matrix_rows<D: Dimensioned>(
    matrix: Option<&Field<MatrixValue<D>>>,
) -> Option<(usize, Range<usize>)> {
    match matrix? {
        Field::Given(matrix) => Some((rows(&matrix.value)?, matrix.span.clone())),
        Field::Wrong => None,
    }
}

/// The same of a list.
fn list_length<T>(list: Option<&Field<Vec<T>>>) -> Option<(usize, Range<usize>)> {
    match list? {
        Field::Given(list) => Some((list.value.len(), list.span.clone())),
        Field::Wrong => None,
    }
}

/// What resists in the place of storey stiffnesses.
fn lateral(
    reader: &Reader<'_>,
    storeys: usize,
    (stiffness, flexibility): (
        Optional<MatrixValue<Stiffness>>,
        Optional<MatrixValue<Flexibility>>,
    ),
    (cantilever, fishbone): (Optional<CantileverTable>, Optional<FishboneTable>),
) -> Option<Located<Lateral>> {
    let at = |span, value| Some(Located { value, span });
    if let Some(Located { value, span }) = stiffness.located() {
        let source = matrix(reader, value, &span, storeys)?;
        return at(span, Lateral::Stiffness(source));
    }
    if let Some(Located { value, span }) = flexibility.located() {
        let source = matrix(reader, value, &span, storeys)?;
        return at(span, Lateral::Flexibility(source));
    }
    if let Some(Located { value, span }) = cantilever.located() {
        return at(span, value.read(reader, storeys)?);
    }
    let Located { value, span } = fishbone.located()?;
    at(span, value.read(reader, storeys)?)
}

/// Storey heights from the elevations of the floors.
fn heights(
    reader: &Reader<'_>,
    elevations: Located<Vec<Positive<Length>>>,
    storeys: usize,
) -> Option<Vec<f64>> {
    let floors: Vec<f64> = elevations.value.into_iter().map(f64::from).collect();
    let mut heights = Vec::with_capacity(storeys);
    let mut below = 0.0;
    for (i, z) in floors.iter().enumerate() {
        if z - below <= 0.0 {
            return reader.refuse(
                elevations.span,
                format!(
                    "floor {} is at {z} m, not above the one below it at {below} m",
                    i + 1
                ),
                "give the elevations above the base, bottom first",
            );
        }
        heights.push(z - below);
        below = *z;
    }
    Some(heights)
}

/// One value for each storey.
fn each<T: Into<f64>>(list: impl Entry<OneOrEach<T>>, storeys: usize, stand_in: f64) -> Vec<f64> {
    match list.value() {
        Some(list) => list.spread(storeys),
        None => vec![stand_in; storeys],
    }
}

impl DampingTable {
    /// `modes` is the number of modes of the building.
    fn read(self, reader: &Reader<'_>, storeys: usize, modes: usize) -> Option<Damping> {
        let count = modes;
        Some(match self {
            Self::Ratio { ratio, modes } => Damping::RayleighRatio {
                ratio: ratio.into(),
                modes: two_modes(reader, modes, count)?,
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
                ratios: spread(reader, modal, count, "mode")?,
            },
            Self::Dashpots { dashpots } => Damping::Dashpots {
                coefficients: spread(reader, dashpots, storeys, "storey")?,
            },
        })
    }
}

fn two_modes(reader: &Reader<'_>, modes: Located<Modes>, count: usize) -> Option<[usize; 2]> {
    match modes.value.0.as_slice() {
        [Count(a), Count(b)] if a != b && *a <= count && *b <= count => Some([*a, *b]),
        _ => reader.refuse(
            modes.span,
            format!("`modes` must be two different modes from 1 to {count}"),
            match count {
                0 | 1 => "for a single storey use { mass_proportional = ... }".to_owned(),
                2 => "write modes = [1, 2]".to_owned(),
                _ => format!("write two of them, such as modes = [1, {}]", count.min(3)),
            },
        ),
    }
}
