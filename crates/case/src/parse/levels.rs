//! The floors that face one another across a gap or a link.

use std::fmt;
use std::ops::Range;

use pounding_catalogue::suggestion;
use pounding_shear_building::{
    ELEVATION_TOLERANCE, WALL, decimal, floor_without_partner, level_pairs,
};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{self, Deserializer, SeqAccess, Unexpected, Visitor};

use super::Row;
use super::column::{ColumnTables, columns};
use crate::document::{Entry, Field, Length, OneOrEach, Optional, Positive, Reader, TableOr};
use crate::located::Located;
use crate::types::{Building, Facing, HitColumns, Side};

/// Two neighbours.
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(expecting = "a list of two names")]
#[schemars(extend("minItems" = 2, "maxItems" = 2))]
pub(super) struct Between(Vec<Located<String>>);

/// Which floors face one another, and which of them columns, where `COLUMNS` lets them.
#[derive(Clone)]
pub(super) enum Levels<const COLUMNS: bool> {
    /// Those at equal elevation.
    Matching,
    /// Each floor and the floor or the columns at its elevation.
    AllFloors,
    /// Pairs of storeys, or storeys beside a wall.
    Listed(Vec<Located<Level>>),
}

type Level = OneOrEach<Located<FloorOrColumn>, 0>;

/// A floor by the number of its storey, or the columns of a storey.
type FloorOrColumn = TableOr<InStorey, Storey>;

/// Columns of a storey
#[derive(Clone, Deserialize)]
#[serde(rename = "columns of a storey")]
pub(super) struct InStorey {
    /// The storey, from 1
    storey: Located<Storey>,
}

/// A storey, from 1, that may not exist.
#[derive(Clone, Deserialize)]
#[serde(expecting = "storeys as whole numbers, in pairs such as [1, 1] or alone beside a wall")]
pub(super) struct Storey(i64);

impl<'de, const COLUMNS: bool> Deserialize<'de> for Levels<COLUMNS> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Given<const COLUMNS: bool>;
        impl<'de, const COLUMNS: bool> Visitor<'de> for Given<COLUMNS> {
            type Value = Levels<COLUMNS>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(match COLUMNS {
                    true => "a list of storeys, \"matching\" or \"all_floors\"",
                    false => "a list of storeys, or \"matching\"",
                })
            }
            fn visit_str<E: de::Error>(self, word: &str) -> Result<Self::Value, E> {
                match word {
                    "matching" => Ok(Levels::Matching),
                    "all_floors" if COLUMNS => Ok(Levels::AllFloors),
                    _ => Err(E::invalid_type(Unexpected::Str(word), &self)),
                }
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Self::Value, A::Error> {
                let mut listed = Vec::new();
                while let Some(level) = items.next_element()? {
                    listed.push(level);
                }
                Ok(Levels::Listed(listed))
            }
        }
        deserializer.deserialize_any(Given::<COLUMNS>)
    }
}

impl<const COLUMNS: bool> JsonSchema for Levels<COLUMNS> {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        match COLUMNS {
            true => "levels of a gap".into(),
            false => "levels".into(),
        }
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let storey = json_schema!({"type": "integer", "minimum": 1});
        let (words, one) = match COLUMNS {
            true => (
                json_schema!({"enum": ["matching", "all_floors"]}),
                json_schema!({"anyOf": [storey, {
                    "type": "object",
                    "properties": {"storey": storey},
                    "required": ["storey"],
                    "additionalProperties": false
                }]}),
            ),
            false => (json_schema!({"const": "matching"}), storey.clone()),
        };
        json_schema!({"anyOf": [
            words,
            {"type": "array", "minItems": 1, "items": {"anyOf": [
                storey,
                {"type": "array", "items": one, "minItems": 2, "maxItems": 2}
            ]}}
        ]})
    }
}

/// What faces what, from the left.
type Pair = [Facing; 2];

/// What a gap or link says of the floors that it lies between.
pub(super) struct Faces<const COLUMNS: bool> {
    pub between: Field<Between>,
    pub levels: Optional<Levels<COLUMNS>>,
    pub tolerance: Optional<Positive<Length>>,
    pub columns: Optional<ColumnTables>,
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
    /// Columns of both sides that may be hit.
    pub columns: [Option<Located<HitColumns>>; 2],
}

impl<const COLUMNS: bool> Faces<COLUMNS> {
    pub(super) fn read(self, reader: &Reader<'_>, row: &Row) -> Option<Faced> {
        let given = self.between.located()?;
        let (between, names) = sides(reader, &given, row.names.as_deref()?)?;
        let columns = columns(reader, self.columns, between, &names)?;
        let buildings = row.buildings()?;
        if self.levels.is_wrong() || self.tolerance.is_wrong() {
            return None;
        }
        let levels = self.levels.located();
        // The rule stands in `levels` where it is given.
        let rule = match &levels {
            Some(levels) if !matches!(levels.value, Levels::Listed(_)) => levels.span.clone(),
            _ => given.span.clone(),
        };
        let tolerance = self.tolerance.located();
        let facing = match between {
            [Side::Building(i), Side::Building(j)] => Some([&buildings[i], &buildings[j]]),
            _ => None,
        };
        let elevations = between.map(|side| match side {
            Side::Building(building) => row.elevations[building].as_slice(),
            Side::Wall => &[],
        });
        let has_columns = columns.iter().any(Option::is_some);
        let mut all_floors = has_columns && levels.is_none();
        let is_matching;
        let listed = match levels.map(|levels| (levels.value, levels.span)) {
            Some((Levels::Listed(levels), span)) => {
                is_matching = false;
                let sides = Sides {
                    between,
                    buildings,
                    elevations,
                    columns: COLUMNS.then(|| columns.each_ref().map(Option::is_some)),
                };
                Some(listed_levels(reader, levels, span, &sides)?)
            }
            Some((Levels::AllFloors, span)) => {
                if !has_columns {
                    return reader.refuse(
                        span,
                        "`levels = \"all_floors\"` lets floors hit columns, but the gap has no `column`",
                        "add `column = { of = ..., flexural_rigidity = ... }`, or write `levels = \"matching\"`",
                    );
                }
                is_matching = false;
                all_floors = true;
                None
            }
            Some((Levels::Matching, _)) => {
                is_matching = true;
                None
            }
            None => {
                is_matching = false;
                None
            }
        };
        let hit = |pairs: &[(Pair, Range<usize>)], side: usize| {
            pairs.iter().any(|(pair, _)| pair[side].is_column())
        };
        if !all_floors {
            for (side, column) in columns.iter().enumerate() {
                let Some(column) = column else { continue };
                if !listed.as_ref().is_some_and(|pairs| hit(pairs, side)) {
                    return reader.refuse(
                        column.span.clone(),
                        format!("no level of this gap lets the columns of \"{}\" be hit", names[side]),
                        "write `levels = \"all_floors\"`, or pairs such as [1, { storey = 2 }], the left storey first; or remove `column`",
                    );
                }
            }
        }
        let tolerance = match (facing, tolerance) {
            (None, Some(given)) => return useless_tolerance(reader, given.span, "a wall"),
            (None, None) => ELEVATION_TOLERANCE,
            (Some(pair), given) => elevation_tolerance(reader, given, pair, &rule)?,
        };
        let is_listed = listed.is_some();
        let storeys = |building: usize| 0..buildings[building].mass.len();
        let by_rule: Vec<Pair> = match (&listed, between, facing) {
            (Some(_), ..) => Vec::new(),
            (None, _, Some(pair)) if all_floors => {
                let hit = columns.each_ref().map(Option::is_some);
                all_levels(reader, (pair, elevations), hit, tolerance, &rule)?
            }
            (None, _, Some(pair)) => {
                let pair = (pair, elevations);
                levels_at_equal_elevation(reader, pair, tolerance, is_matching, &rule)?
            }
            (None, [Side::Building(i), _], _) => storeys(i)
                .map(|s| [Facing::Floor(s), Facing::Wall])
                .collect(),
            (None, [_, Side::Building(j)], _) => storeys(j)
                .map(|s| [Facing::Wall, Facing::Floor(s)])
                .collect(),
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
            columns,
        })
    }
}

/// The neighbours with their names.
pub(super) fn sides(
    reader: &Reader<'_>,
    given: &Located<Between>,
    buildings: &[String],
) -> Option<([Side; 2], [String; 2])> {
    let mut sides = Vec::new();
    for name in &given.value.0 {
        let side = if name.value == WALL {
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
pub(super) fn row_problem(left: Side, right: Side, last: usize) -> Option<(&'static str, bool)> {
    match (left, right) {
        (Side::Wall, Side::Wall) => Some(("two walls are no neighbours in the row", false)),
        (Side::Wall, Side::Building(i)) if i != 0 => Some((
            "a wall on the left can only stand beside the first building",
            i == last,
        )),
        (Side::Building(i), Side::Wall) if i != last => Some((
            "a wall on the right can only stand beside the last building",
            i == 0,
        )),
        (Side::Building(i), Side::Building(j)) if i == j => {
            Some(("two different neighbours are needed", false))
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

/// What pairs of `levels` may name.
struct Sides<'a> {
    between: [Side; 2],
    buildings: &'a [Building],
    elevations: [&'a [f64]; 2],
    /// Whether there are columns to be hit; `None` where floors do not hit, but are joined.
    columns: Option<[bool; 2]>,
}

/// `levels` as a list.
fn listed_levels(
    reader: &Reader<'_>,
    given: Vec<Located<Level>>,
    place: Range<usize>,
    sides: &Sides<'_>,
) -> Option<Vec<(Pair, Range<usize>)>> {
    let mut pairs: Vec<(Pair, Range<usize>)> = Vec::new();
    for level in given {
        let span = level.span.clone();
        let pair = pair(reader, level, sides)?;
        if pairs.iter().any(|(other, _)| *other == pair) {
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

/// The columns between floors at these elevations that a neighbour hits at one of its own;
/// `None` above the roof.
fn column_at(floors: &[f64], elevation: f64) -> Option<Facing> {
    let storey = floors.partition_point(|z| *z < elevation);
    let below = if storey == 0 { 0.0 } else { floors[storey - 1] };
    (storey < floors.len()).then_some(Facing::Column {
        storey,
        above_floor: decimal(elevation - below),
    })
}

/// Each floor and the floor at its elevation, or else the columns there, where these may be
/// hit.
fn all_levels(
    reader: &Reader<'_>,
    (buildings, elevations): ([&Building; 2], [&[f64]; 2]),
    hit: [bool; 2],
    tolerance: f64,
    place: &Range<usize>,
) -> Option<Vec<Pair>> {
    let [a, b] = elevations;
    let level = level_pairs(a, b, tolerance);
    let mut pairs: Vec<(f64, Pair)> = Vec::new();
    for (i, j) in &level {
        pairs.push((a[*i], [Facing::Floor(*i), Facing::Floor(*j)]));
    }
    for side in 0..2 {
        if !hit[1 - side] {
            continue;
        }
        for (floor, z) in elevations[side].iter().enumerate() {
            // Both floors of the pairs rise.
            if level
                .binary_search_by_key(&floor, |p| [p.0, p.1][side])
                .is_ok()
            {
                continue;
            }
            let Some(column) = column_at(elevations[1 - side], *z) else {
                continue;
            };
            let mut pair = [Facing::Floor(floor), column];
            if side == 1 {
                pair.reverse();
            }
            pairs.push((*z, pair));
        }
    }
    if pairs.is_empty() {
        let [left, right] = buildings.map(|b| &b.name.value);
        let (a, b) = (shown(a), shown(b));
        return reader.refuse(
            place.clone(),
            format!("no floor of \"{left}\" ({a}) and \"{right}\" ({b}) meets a floor or a column that may be hit"),
            "name in `column` the building whose columns the floors of the other hit, or correct the storey heights",
        );
    }
    pairs.sort_by(|one, other| one.0.total_cmp(&other.0));
    Some(pairs.into_iter().map(|(_, pair)| pair).collect())
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
        let floors = pairs.iter();
        return Some(
            floors
                .map(|p| [Facing::Floor(p.0), Facing::Floor(p.1)])
                .collect(),
        );
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
const AT_DIFFERENT_ELEVATIONS: &str = "correct the storey heights, or name the pairs of storeys that may touch with `levels = [[1, 1], ...]`, which with `floor_to_floor = true` may stand at different elevations and act on each other as if they were level; floors that hit columns need `column = {...}`";

/// Some elevations, for a message.
fn shown(elevations: &[f64]) -> String {
    const MOST: usize = 4;
    let first: Vec<String> = elevations.iter().take(MOST).map(f64::to_string).collect();
    let more = if elevations.len() > MOST { ", ..." } else { "" };
    format!("{}{more} m", first.join(", "))
}

/// One entry of `levels`: a pair, or a storey beside a wall.
fn pair(reader: &Reader<'_>, level: Located<Level>, sides: &Sides<'_>) -> Option<Pair> {
    let beside_wall = sides.between.contains(&Side::Wall);
    match &level.value {
        OneOrEach::Each(pair) if pair.len() == 2 && !beside_wall => {
            let [left, right] = [&pair[0], &pair[1]];
            match (&left.value, &right.value) {
                (TableOr::Value(i), TableOr::Value(j)) => Some([
                    Facing::Floor(storey(reader, (i, &left.span), sides, 0)?),
                    Facing::Floor(storey(reader, (j, &right.span), sides, 1)?),
                ]),
                (TableOr::Value(i), TableOr::Table(columns)) => {
                    let floor = storey(reader, (i, &left.span), sides, 0)?;
                    let column = hit_column(reader, (columns, &right.span), sides, 1, floor)?;
                    Some([Facing::Floor(floor), column])
                }
                (TableOr::Table(columns), TableOr::Value(j)) => {
                    let floor = storey(reader, (j, &right.span), sides, 1)?;
                    let column = hit_column(reader, (columns, &left.span), sides, 0, floor)?;
                    Some([column, Facing::Floor(floor)])
                }
                (TableOr::Table(_), TableOr::Table(_)) => reader.refuse(
                    level.span,
                    "columns do not hit columns",
                    "write a storey whose floor hits columns, and `{ storey = ... }` for these",
                ),
            }
        }
        OneOrEach::One(Located {
            value: TableOr::Value(one),
            span,
        }) if beside_wall => match sides.between {
            [Side::Wall, _] => {
                let floor = storey(reader, (one, span), sides, 1)?;
                Some([Facing::Wall, Facing::Floor(floor)])
            }
            _ => {
                let floor = storey(reader, (one, span), sides, 0)?;
                Some([Facing::Floor(floor), Facing::Wall])
            }
        },
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

/// A storey of one side, from zero.
fn storey(
    reader: &Reader<'_>,
    (given, place): (&Storey, &Range<usize>),
    sides: &Sides<'_>,
    side: usize,
) -> Option<usize> {
    let Side::Building(building) = sides.between[side] else {
        return None;
    };
    let building = &sides.buildings[building];
    let storeys = building.mass.len();
    let number = usize::try_from(given.0).ok();
    if let Some(n) = number.filter(|n| (1..=storeys).contains(n)) {
        return Some(n - 1);
    }
    let text = reader.source.get(place.clone()).unwrap_or_default();
    reader.refuse(
        place.clone(),
        format!("\"{}\" has no storey {text}", building.name.value),
        match storeys {
            1 => "it has 1 storey: name that, 1".to_owned(),
            _ => format!("it has {storeys} storeys: name one from 1 to {storeys}"),
        },
    )
}

/// The columns of a storey of one side, which a floor of the other hits.
fn hit_column(
    reader: &Reader<'_>,
    (given, place): (&InStorey, &Range<usize>),
    sides: &Sides<'_>,
    side: usize,
    floor: usize,
) -> Option<Facing> {
    let names = sides.between.map(|side| match side {
        Side::Building(building) => sides.buildings[building].name.value.as_str(),
        Side::Wall => WALL,
    });
    let hit = names[side];
    let Some(columns) = sides.columns else {
        return reader.refuse(
            place.clone(),
            "a link joins floors, not columns",
            "write pairs of storeys, such as [[1, 1], [2, 2]]",
        );
    };
    if !columns[side] {
        return reader.refuse(
            place.clone(),
            format!("the gap has no `column` of \"{hit}\" that could be hit"),
            format!("add `column = {{ of = \"{hit}\", flexural_rigidity = ... }}`"),
        );
    }
    let number = &given.storey;
    let stated = storey(reader, (&number.value, &number.span), sides, side)?;
    let elevation = sides.elevations[1 - side][floor];
    let floors = sides.elevations[side];
    let column = column_at(floors, elevation);
    match column {
        Some(Facing::Column { storey, .. }) if storey == stated => return column,
        _ => {}
    }
    let below = if stated == 0 { 0.0 } else { floors[stated - 1] };
    let remedy = match column {
        Some(Facing::Column { storey, .. }) => format!("it meets storey {}", storey + 1),
        _ => format!(
            "it is above the roof of \"{hit}\" at {} m",
            shown_last(floors)
        ),
    };
    reader.refuse(
        place.clone(),
        format!(
            "floor {} of \"{}\" at {elevation} m does not meet storey {} of \"{hit}\" from {below} m to {} m",
            floor + 1,
            names[1 - side],
            stated + 1,
            floors[stated]
        ),
        remedy,
    )
}

fn shown_last(elevations: &[f64]) -> f64 {
    elevations.last().copied().unwrap_or_default()
}
