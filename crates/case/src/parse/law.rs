//! Laws with memory: of storeys, and of links between neighbours.

use std::ops::Range;

use pounding_shear_building::ELEVATION_TOLERANCE;
use schemars::JsonSchema;
use serde::Deserialize;

use super::levels::{Between, Faced, Faces, Levels, sides, useless_tolerance};
use super::parameters::{Values, arrange, not_whole, parameters};
use super::{Row, joined_name, name};
use crate::document::{
    Count, Entry, Field, FreeKeys, Length, OneOrEach, Optional, Positive, Reader,
};
use crate::located::Located;
use crate::types::{Facing, FoundationMotion, Link, Side, StoreyLaw};

/// Law of some storeys
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "law")]
pub(super) struct LawTable {
    /// Law of the storey
    model: Field<String>,
    /// Storeys of this law, from 1 at the bottom; by default all
    storeys: Optional<Storeys>,
    /// Parameters of the law: yield_force (N), hardening_ratio, ..., one for all its storeys
    /// or a list; its stiffness is that of the storey
    #[serde(rename = "*")]
    parameters: FreeKeys<Values>,
}

#[derive(Clone, Deserialize, JsonSchema)]
#[serde(expecting = "a list of storeys, from 1")]
#[schemars(extend("minItems" = 1))]
struct Storeys(Vec<Located<Count<1>>>);

/// A link between floors
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "[[link]]")]
pub(super) struct LinkTable {
    /// Name of the link, by default left-right
    name: Optional<String>,
    /// Left and right neighbour; "wall" is a rigid wall that moves with the ground
    between: Field<Between>,
    /// Law of the link
    model: Field<String>,
    /// Pairs of storey numbers that are joined, or "matching" for the floors at equal
    /// elevation only
    levels: Optional<Levels<false>>,
    /// Joins the foundations through the soil in the place of floors: "sway" or "rocking"
    foundations: Optional<Motion>,
    /// Floors this close in elevation are level (m), by default 0.01
    elevation_tolerance: Optional<Positive<Length>>,
    /// Parameters of the law, one for all levels or a list, bottom first
    #[serde(rename = "*")]
    parameters: FreeKeys<Values>,
}

#[derive(Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", expecting = "a text in quotes")]
enum Motion {
    Sway,
    Rocking,
}

/// The laws of a building of so many storeys, of which the first may be an isolator.
pub(super) fn storey_laws(
    reader: &Reader<'_>,
    tables: OneOrEach<Field<LawTable>, 0>,
    (storeys, isolated): (usize, bool),
) -> Vec<StoreyLaw> {
    let mut taken: Vec<Option<Range<usize>>> = vec![None; storeys];
    let mut laws = Vec::new();
    let tables: Vec<Field<LawTable>> = tables.into_list();
    for law in tables {
        let Some(law) = law
            .value()
            .and_then(|law| law.read(reader, (storeys, isolated)))
        else {
            continue;
        };
        for storey in &law.storeys {
            if let Some(first) = &taken[*storey] {
                let message = format!(
                    "storey {} has two laws, the first in line {}",
                    storey + 1,
                    reader.line(first)
                );
                let help = "name the storeys of each law with `storeys = [...]`";
                let none = reader.refuse(law.model.span, message, help);
                return none.unwrap_or_default();
            }
            taken[*storey] = Some(law.model.span.clone());
        }
        laws.push(law);
    }
    laws
}

impl LawTable {
    fn read(self, reader: &Reader<'_>, (storeys, isolated): (usize, bool)) -> Option<StoreyLaw> {
        let listed: Option<Vec<usize>> = match self.storeys {
            None => Some((usize::from(isolated)..storeys).collect()),
            Some(listed) => listed
                .located()
                .and_then(|listed| listed_storeys(reader, listed, (storeys, isolated))),
        };
        let count = listed.as_ref().map(Vec::len);
        let (parameters, unread) = parameters(reader, self.parameters, (count, "place"));
        let model = self.model.located()?;
        not_whole(reader, (&model, false), unread);
        Some(StoreyLaw {
            parameters,
            // Without its storeys a law can be judged by its name.
            storeys: listed.unwrap_or_default(),
            model,
        })
    }
}

fn listed_storeys(
    reader: &Reader<'_>,
    given: Located<Storeys>,
    (storeys, isolated): (usize, bool),
) -> Option<Vec<usize>> {
    let mut listed = Vec::new();
    for Located { value, span } in given.value.0 {
        let Count(storey) = value;
        if isolated && storey == 1 {
            return reader.refuse(
                span,
                "storey 1 is the isolator, which has its own law",
                "name the storeys above it, from 2; or leave [building.isolator] out and give storey 1 a law",
            );
        }
        if storey > storeys {
            return reader.refuse(
                span,
                format!("storey {storey} is not one of {storeys}"),
                format!("storeys are counted from 1 at the bottom to {storeys} at the roof"),
            );
        }
        if listed.contains(&(storey - 1)) {
            return reader.refuse(
                span,
                format!("storey {storey} stands here twice"),
                "name each storey of this law once",
            );
        }
        listed.push(storey - 1);
    }
    if listed.is_empty() {
        return reader.refuse(
            given.span,
            "`storeys` is empty",
            "name at least one storey, or leave the key out for all",
        );
    }
    Some(listed)
}

impl LinkTable {
    /// Reads a link; also returns where its `between` stands. Where neighbours or levels are
    /// wrong there is no such place, and the link lies between walls: its law can be judged.
    pub(super) fn read(
        self,
        reader: &Reader<'_>,
        row: &Row,
    ) -> Option<(Link, Option<Range<usize>>)> {
        let name = name(reader, self.name, "link");
        let (placed, foundations) = match self.foundations {
            None => {
                let faces = Faces {
                    between: self.between,
                    levels: self.levels,
                    tolerance: self.elevation_tolerance,
                    columns: None,
                };
                (placed(reader, faces, row), None)
            }
            Some(motion) => {
                let others = [
                    ("levels", self.levels.span()),
                    ("elevation_tolerance", self.elevation_tolerance.span()),
                ];
                let motion = motion.located();
                let placed = motion
                    .clone()
                    .and_then(|motion| at_foundations(reader, self.between, others, &motion, row));
                let motion = motion.map(|given| Located {
                    value: FoundationMotion::from(given.value),
                    span: given.span,
                });
                (placed, motion)
            }
        };
        let levels = placed.as_ref().map(|p| p.pairs.len());
        let (mut parameters, unread) = parameters(reader, self.parameters, (levels, "place"));
        let model = self.model.located()?;
        not_whole(reader, (&model, false), unread);
        let place = placed.as_ref().map(|p| p.place.clone());
        let (between, names, levels) = match placed {
            Some(faced) => {
                let floors = faced.pairs.into_iter();
                let mut levels: Vec<_> = floors
                    .map(|([left, right], _)| (left.floor(), right.floor()))
                    .collect();
                // Values stand in the order in which levels are named.
                let mut order: Vec<usize> = (0..levels.len()).collect();
                order.sort_by_key(|place| levels[*place]);
                levels.sort_unstable();
                arrange(&mut parameters, &order);
                (faced.between, faced.names, levels)
            }
            None => ([Side::Wall; 2], Default::default(), vec![(None, None)]),
        };
        let joined = || joined_name(reader, &names, place.as_ref(), "link");
        let link = Link {
            name: name.unwrap_or_else(joined),
            between,
            parameters,
            levels,
            foundations,
            model,
        };
        Some((link, place))
    }
}

impl From<Motion> for FoundationMotion {
    fn from(motion: Motion) -> Self {
        match motion {
            Motion::Sway => Self::Sway,
            Motion::Rocking => Self::Rocking,
        }
    }
}

/// A link between the foundations of two buildings, beside keys that say of which floors it
/// would be otherwise.
fn at_foundations(
    reader: &Reader<'_>,
    between: Field<Between>,
    others: [(&str, Option<Range<usize>>); 2],
    motion: &Located<Motion>,
    row: &Row,
) -> Option<Faced> {
    let given = between.located()?;
    let (between, names) = sides(reader, &given, row.names.as_deref()?)?;
    for (key, span) in others {
        if let Some(span) = span {
            return reader.refuse(
                span,
                format!("`{key}` has no meaning beside `foundations`: no floors are joined"),
                "leave one of them out",
            );
        }
    }
    let buildings = row.buildings()?;
    for (side, name) in between.iter().zip(&names) {
        let moves = match side {
            Side::Wall => false,
            Side::Building(b) => {
                // Of a foundation that is wrong nothing can be said.
                let support = buildings[*b].foundation.as_ref().map(|f| &f.value.support);
                support.is_some_and(|support| match motion.value {
                    Motion::Sway => support.sways(),
                    Motion::Rocking => support.rocks(),
                })
            }
        };
        if !moves {
            let motion = match motion.value {
                Motion::Sway => "sways",
                Motion::Rocking => "rocks",
            };
            return reader.refuse(
                given.span.clone(),
                format!("\"{name}\" has no foundation that {motion}"),
                "add [building.foundation] with `soil`, or join floors",
            );
        }
    }
    Some(Faced {
        pairs: vec![([Facing::Wall; 2], given.span.clone())],
        place: given.span,
        between,
        names,
        listed: true,
        tolerance: ELEVATION_TOLERANCE,
        columns: [None, None],
    })
}

fn placed(reader: &Reader<'_>, faces: Faces<false>, row: &Row) -> Option<Faced> {
    let tolerance = faces.tolerance.span();
    let faced = faces.read(reader, row)?;
    match tolerance {
        // A link may join floors at any elevations.
        Some(span) if faced.listed => useless_tolerance(reader, span, "listed `levels` of a link"),
        _ => Some(faced),
    }
}
