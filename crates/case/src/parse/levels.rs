//! The floors that face one another across a gap or a link.

use std::collections::HashSet;
use std::fmt;
use std::ops::Range;

use pounding_catalogue::suggestion;
use pounding_shear_building::{ELEVATION_TOLERANCE, floor_without_partner, level_pairs};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{self, Deserializer, SeqAccess, Unexpected, Visitor};

use super::Row;
use crate::document::{Entry, Field, Length, OneOrEach, Optional, Positive, Reader};
use crate::types::{Building, Located, Side};

/// Two neighbours.
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(expecting = "a list of two names")]
#[schemars(extend("minItems" = 2, "maxItems" = 2))]
pub(super) struct Between(Vec<Located<String>>);

/// Which floors face one another.
#[derive(Clone)]
pub(super) enum Levels {
    /// Those at equal elevation.
    Matching,
    /// Pairs of storeys, or storeys beside a wall.
    Listed(Vec<Located<Level>>),
}

type Level = OneOrEach<Located<Storey>, 0>;

/// A storey, from 1, that may not exist.
#[derive(Clone, Deserialize)]
#[serde(expecting = "storeys as whole numbers, in pairs such as [1, 1] or alone beside a wall")]
pub(super) struct Storey(i64);

impl<'de> Deserialize<'de> for Levels {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Given;
        impl<'de> Visitor<'de> for Given {
            type Value = Levels;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a list of storeys, or \"matching\"")
            }
            fn visit_str<E: de::Error>(self, word: &str) -> Result<Levels, E> {
                match word {
                    "matching" => Ok(Levels::Matching),
                    _ => Err(E::invalid_type(Unexpected::Str(word), &self)),
                }
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Levels, A::Error> {
                let mut listed = Vec::new();
                while let Some(level) = items.next_element()? {
                    listed.push(level);
                }
                Ok(Levels::Listed(listed))
            }
        }
        deserializer.deserialize_any(Given)
    }
}

impl JsonSchema for Levels {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "levels".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let storey = json_schema!({"type": "integer", "minimum": 1});
        json_schema!({"anyOf": [
            {"const": "matching"},
            {"type": "array", "minItems": 1, "items": {"anyOf": [
                storey,
                {"type": "array", "items": storey, "minItems": 2, "maxItems": 2}
            ]}}
        ]})
    }
}

/// Storeys from zero of the left and the right building, `None` for a wall.
type Pair = (Option<usize>, Option<usize>);

/// What a gap or link says of the floors that it lies between.
pub(super) struct Faces {
    pub between: Field<Between>,
    pub levels: Optional<Levels>,
    pub tolerance: Optional<Positive<Length>>,
}

/// The floors that face one another across a gap or a link.
pub(super) struct Faced {
    /// Where its `between` stands.
    pub place: Range<usize>,
    pub between: [Side; 2],
    pub names: [String; 2],
    /// Pairs, each with its place in the source.
    pub pairs: Vec<(Pair, Range<usize>)>,
    /// Whether `levels` names them.
    pub listed: bool,
    /// Elevation tolerance (m).
    pub tolerance: f64,
}

impl Faces {
    pub(super) fn read(self, reader: &Reader<'_>, row: &Row) -> Option<Faced> {
        let given = self.between.located()?;
        let (between, names) = sides(reader, &given, row.names.as_deref()?)?;
        let buildings = row.buildings()?;
        if self.levels.is_wrong() || self.tolerance.is_wrong() {
            return None;
        }
        let levels = self.levels.located();
        // The rule stands in `levels` where it is given.
        let rule = match &levels {
            Some(levels) if matches!(levels.value, Levels::Matching) => levels.span.clone(),
            _ => given.span.clone(),
        };
        let tolerance = self.tolerance.located();
        let facing = match between {
            [Side::Building(i), Side::Building(j)] => Some([&buildings[i], &buildings[j]]),
            _ => None,
        };
        let listed = match levels.map(|levels| (levels.value, levels.span)) {
            Some((Levels::Listed(levels), span)) => {
                Some(listed_levels(reader, levels, span, between, buildings)?)
            }
            Some((Levels::Matching, _)) | None => None,
        };
        let is_matching = rule != given.span;
        let tolerance = match (facing, tolerance) {
            (None, Some(given)) => return useless_tolerance(reader, given.span, "a wall"),
            (None, None) => ELEVATION_TOLERANCE,
            (Some(pair), given) => elevation_tolerance(reader, given, pair, &rule)?,
        };
        let is_listed = listed.is_some();
        let storeys = |building: usize| 0..buildings[building].mass.len();
        let by_rule: Vec<Pair> = match (&listed, between, facing) {
            (Some(_), ..) => Vec::new(),
            (None, _, Some(pair)) => {
                let elevations = between.map(|side| match side {
                    Side::Building(building) => row.elevations[building].as_slice(),
                    Side::Wall => &[],
                });
                let pair = (pair, elevations);
                levels_at_equal_elevation(reader, pair, tolerance, is_matching, &rule)?
            }
            (None, [Side::Building(i), _], _) => storeys(i).map(|s| (Some(s), None)).collect(),
            (None, [_, Side::Building(j)], _) => storeys(j).map(|s| (None, Some(s))).collect(),
            (None, [Side::Wall, Side::Wall], _) => Vec::new(),
        };
        let by_rule = by_rule.into_iter().map(|pair| (pair, rule.clone()));
        Some(Faced {
            pairs: listed.unwrap_or_else(|| by_rule.collect()),
            place: given.span,
            between,
            names,
            listed: is_listed,
            tolerance,
        })
    }
}

/// The neighbours with their names.
fn sides(
    reader: &Reader<'_>,
    given: &Located<Between>,
    buildings: &[String],
) -> Option<([Side; 2], [String; 2])> {
    let mut sides = Vec::new();
    for name in &given.value.0 {
        let side = if name.value == "wall" {
            Side::Wall
        } else {
            match buildings.iter().position(|b| *b == name.value) {
                Some(building) => Side::Building(building),
                None => return unknown_building(reader, name, buildings),
            }
        };
        sides.push((side, name.value.clone()));
    }
    let refuse = |problem: String, help: String| reader.refuse(given.span.clone(), problem, help);
    let [(left, a), (right, b)] = sides.as_slice() else {
        let problem = format!("`between` has {} names", sides.len());
        return refuse(problem, "name the left and the right neighbour".to_owned());
    };
    match row_problem(*left, *right, buildings.len() - 1) {
        Some((problem, true)) => refuse(
            problem.to_owned(),
            format!("write between = [{b:?}, {a:?}]"),
        ),
        Some((problem, false)) => refuse(
            problem.to_owned(),
            "buildings stand in a row in the order of the file; name left and right neighbour"
                .to_owned(),
        ),
        None => Some(([*left, *right], [a.clone(), b.clone()])),
    }
}

/// What keeps two sides from facing each other in the row, and whether the other
/// order would do.
fn row_problem(left: Side, right: Side, last: usize) -> Option<(&'static str, bool)> {
    match (left, right) {
        (Side::Wall, Side::Wall) => Some(("a gap cannot lie between two walls", false)),
        (Side::Wall, Side::Building(i)) if i != 0 => Some((
            "a wall on the left can only stand beside the first building",
            i == last,
        )),
        (Side::Building(i), Side::Wall) if i != last => Some((
            "a wall on the right can only stand beside the last building",
            i == 0,
        )),
        (Side::Building(i), Side::Building(j)) if i == j => {
            Some(("a gap needs two different neighbours", false))
        }
        (Side::Building(i), Side::Building(j)) if i == j + 1 => Some((
            "the neighbours are in the wrong order: the left one comes first",
            true,
        )),
        (Side::Building(i), Side::Building(j)) if j != i + 1 => Some((
            "these buildings are not neighbours in the order of the file",
            false,
        )),
        _ => None,
    }
}

fn unknown_building<T>(reader: &Reader<'_>, name: &Located<String>, names: &[String]) -> Option<T> {
    let guess = suggestion::misspelt(&name.value, names)
        .map_or_else(String::new, |n| format!("did you mean \"{n}\"? "));
    reader.refuse(
        name.span.clone(),
        format!("there is no building \"{}\"", name.value),
        format!(
            "{guess}buildings: {}; a rigid wall is \"wall\"",
            names.join(", ")
        ),
    )
}

/// An elevation tolerance where nothing asks for one.
pub(super) fn useless_tolerance<T>(
    reader: &Reader<'_>,
    span: Range<usize>,
    beside: &str,
) -> Option<T> {
    let message = format!("`elevation_tolerance` has no meaning beside {beside}");
    reader.refuse(span, message, "remove it")
}

/// The tolerance within which floors of two neighbours are level (m).
fn elevation_tolerance(
    reader: &Reader<'_>,
    given: Option<Located<Positive<Length>>>,
    buildings: [&Building; 2],
    rule: &Range<usize>,
) -> Option<f64> {
    let (tolerance, place) = match given {
        Some(given) => (given.value.into(), given.span),
        None => (ELEVATION_TOLERANCE, rule.clone()),
    };
    let heights = buildings.iter().flat_map(|b| &b.height);
    let lowest = heights.fold(f64::INFINITY, |least, h| least.min(*h));
    // With less than half a storey, no floor can have two partners.
    if tolerance >= 0.5 * lowest {
        return reader.refuse(
            place,
            format!("the elevation tolerance {tolerance} m is not less than half of the lowest storey, {lowest} m"),
            "state a smaller `elevation_tolerance`",
        );
    }
    Some(tolerance)
}

/// `levels` as a list.
fn listed_levels(
    reader: &Reader<'_>,
    given: Vec<Located<Level>>,
    place: Range<usize>,
    between: [Side; 2],
    buildings: &[Building],
) -> Option<Vec<(Pair, Range<usize>)>> {
    let mut seen = HashSet::new();
    let mut pairs = Vec::new();
    for level in given {
        let span = level.span.clone();
        let pair = pair(reader, level, between, buildings)?;
        if !seen.insert(pair) {
            return reader.refuse(span, "this level is given twice", "remove one");
        }
        pairs.push((pair, span));
    }
    if pairs.is_empty() {
        return reader.refuse(
            place,
            "`levels` is empty",
            "name at least one pair of storeys, or one storey beside a wall",
        );
    }
    Some(pairs)
}

fn levels_at_equal_elevation(
    reader: &Reader<'_>,
    (buildings, [a, b]): ([&Building; 2], [&[f64]; 2]),
    tolerance: f64,
    matching_only: bool,
    place: &Range<usize>,
) -> Option<Vec<Pair>> {
    let pairs = level_pairs(a, b, tolerance);
    if pairs.is_empty() && matching_only {
        let [left, right] = buildings.map(|b| &b.name.value);
        let (a, b) = (shown(a), shown(b));
        return reader.refuse(
            place.clone(),
            format!("no floor of \"{left}\" ({a}) is level with a floor of \"{right}\" ({b}; tolerance {tolerance} m)"),
            AT_DIFFERENT_ELEVATIONS,
        );
    }
    let alone = floor_without_partner([a, b], &pairs, tolerance).filter(|_| !matching_only);
    let Some((side, storey)) = alone else {
        return Some(pairs.iter().map(|p| (Some(p.0), Some(p.1))).collect());
    };
    let (building, elevation) = (buildings[side], [a, b][side][storey]);
    reader.refuse(
        place.clone(),
        format!("floor {} of \"{}\" at {elevation} m has no floor of its neighbour at equal elevation (tolerance {tolerance} m)", storey + 1, building.name.value),
        match pairs.is_empty() {
            true => AT_DIFFERENT_ELEVATIONS.to_owned(),
            false => format!("write `levels = \"matching\"` to let only floors at equal elevation touch; otherwise {AT_DIFFERENT_ELEVATIONS}"),
        },
    )
}

/// What to do where floors are not level.
const AT_DIFFERENT_ELEVATIONS: &str = "correct the storey heights, or name the pairs of storeys that may touch with `levels = [[1, 1], ...]`; pairs at different elevations also need `floor_to_floor = true`, since a floor that hits a column is not modelled";

/// Some elevations, for a message.
fn shown(elevations: &[f64]) -> String {
    const MOST: usize = 4;
    let first: Vec<String> = elevations.iter().take(MOST).map(f64::to_string).collect();
    let more = if elevations.len() > MOST { ", ..." } else { "" };
    format!("{}{more} m", first.join(", "))
}

/// One entry of `levels`: a pair, or a storey beside a wall.
fn pair(
    reader: &Reader<'_>,
    level: Located<Level>,
    sides: [Side; 2],
    buildings: &[Building],
) -> Option<Pair> {
    let storey = |given: &Located<Storey>, side: Side| {
        let Side::Building(b) = side else {
            return Some(None);
        };
        let storeys = buildings[b].mass.len();
        let number = usize::try_from(given.value.0).ok();
        if let Some(n) = number.filter(|n| (1..=storeys).contains(n)) {
            return Some(Some(n - 1));
        }
        let text = reader.source.get(given.span.clone()).unwrap_or_default();
        reader.refuse(
            given.span.clone(),
            format!("\"{}\" has no storey {text}", buildings[b].name.value),
            match storeys {
                1 => "it has 1 storey: name that, 1".to_owned(),
                _ => format!("it has {storeys} storeys: name one from 1 to {storeys}"),
            },
        )
    };
    let beside_wall = sides.contains(&Side::Wall);
    match &level.value {
        OneOrEach::Each(pair) if pair.len() == 2 && !beside_wall => {
            Some((storey(&pair[0], sides[0])?, storey(&pair[1], sides[1])?))
        }
        OneOrEach::One(one) if beside_wall => {
            Some((storey(one, sides[0])?, storey(one, sides[1])?))
        }
        _ if beside_wall => reader.refuse(
            level.span,
            "`levels` beside a wall must be storeys, not pairs",
            "write the storeys, such as [1, 2]",
        ),
        _ => reader.refuse(
            level.span,
            "`levels` between two buildings must be pairs of storeys",
            "write pairs of storeys, such as [[1, 1], [2, 2]]",
        ),
    }
}
