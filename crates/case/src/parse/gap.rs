//! Gaps: neighbours, contact levels, and the model's parameters.

use std::collections::HashSet;
use std::ops::Range;

use pounding_catalogue::suggestion;
use pounding_shear_building::{ELEVATION_TOLERANCE, floor_without_partner, level_pairs};
use toml::Spanned;
use toml::de::DeValue;

use super::{Row, check_name, not_negative, spread};
use crate::error::CaseError;
use crate::reader::{List, Reader, Table, Value};
use crate::schema;
use crate::types::{Building, ContactLevel, Gap, Located, Parameter, Side};
use crate::units::Dimension;

/// Reads a gap; also returns where its `between` stands. Where neighbours, levels or widths
/// are wrong there is no such place, and the gap lies between walls: its model can be judged.
pub(super) fn gap(
    reader: &Reader<'_>,
    value: &Value<'_>,
    row: &Row,
) -> Result<(Gap, Option<Range<usize>>), CaseError> {
    let table = reader.section(value, "[[gap]]", schema::GAP)?;
    let keep = reader.errors;
    let parameters = parameters(&table);
    let read = |v: &Value<'_>| not_negative(reader, v, "width", Dimension::LENGTH);
    let width = table.required("width");
    let width = keep.keep(width.and_then(|v| reader.list(v, "width", read)));
    let model = keep.keep(
        table
            .required("model")
            .and_then(|v| reader.text(v, "model")),
    );
    let separation = keep.or_default(table.optional_text("separation"));
    let name = keep.or_default(name(&table, "gap"));
    let placed = keep.keep(placed(&table, row, width));
    let Some(model) = model else {
        return Err(reader.lost());
    };
    let (parameters, whole) = parameters;
    if !whole {
        keep.incomplete(model.span.clone());
    }
    let (place, place_in_row) = placed.unzip();
    let place_in_row = place_in_row.unwrap_or(Placed {
        between: [Side::Wall; 2],
        names: Default::default(),
        levels: Vec::new(),
        tolerance: ELEVATION_TOLERANCE,
        floor_to_floor: false,
    });
    let gap = Gap {
        name: name.unwrap_or_else(|| place_in_row.names.join("-")),
        between: place_in_row.between,
        levels: place_in_row.levels,
        elevation_tolerance: place_in_row.tolerance,
        floor_to_floor: place_in_row.floor_to_floor,
        model,
        separation,
        parameters,
    };
    Ok((gap, place))
}

/// Where a gap lies, and how wide it is.
struct Placed {
    between: [Side; 2],
    names: [String; 2],
    levels: Vec<ContactLevel>,
    tolerance: f64,
    floor_to_floor: bool,
}

/// Reads where a gap lies; also returns where its `between` stands.
fn placed(
    table: &Table<'_, '_>,
    row: &Row,
    width: Option<List>,
) -> Result<(Range<usize>, Placed), CaseError> {
    let reader = &table.reader;
    let place = table.required("between")?;
    let (between, names) = between(reader, place, row)?;
    let buildings = row.buildings(reader)?;
    let Faced {
        pairs,
        listed,
        tolerance,
    } = levels(table, between, buildings, place.span())?;
    let floor_to_floor = floor_to_floor(table, between, listed)?;
    let width = width.ok_or_else(|| reader.lost())?;
    let widths = spread(reader, width, pairs.len(), "contact level")?;
    let mut levels: Vec<ContactLevel> = pairs
        .into_iter()
        .zip(widths)
        .map(|(((left, right), place), width)| ContactLevel {
            left,
            right,
            width,
            place,
        })
        .collect();
    levels.sort_by_key(|level| (level.left, level.right));
    let placed = Placed {
        between,
        names,
        levels,
        tolerance,
        floor_to_floor,
    };
    Ok((place.span(), placed))
}

/// The name of a gap or link, if it states one.
pub(super) fn name(table: &Table<'_, '_>, what: &str) -> Result<Option<String>, CaseError> {
    let name = table.optional_text("name")?;
    let name = name.map(|name| check_name(&table.reader, name, what));
    Ok(name.transpose()?.map(|name| name.value))
}

/// All keys but those of the gap itself, and whether all of them could be read.
fn parameters(table: &Table<'_, '_>) -> (Vec<Parameter>, bool) {
    let reader = &table.reader;
    let mut whole = true;
    let mut parameters = Vec::new();
    for (key, value) in table.entries() {
        let own = schema::GAP.iter().any(|k| k.name == key.value);
        if own || table.is_unknown(&key.value) {
            whole &= own;
            continue;
        }
        if let Some(quantity) = reader.errors.keep(reader.any_quantity(value, &key.value)) {
            parameters.push(Parameter {
                key,
                value: Located {
                    value: quantity,
                    span: value.span(),
                },
            });
        } else {
            whole = false;
        }
    }
    (parameters, whole)
}

pub(super) fn between(
    reader: &Reader<'_>,
    value: &Value<'_>,
    row: &Row,
) -> Result<([Side; 2], [String; 2]), CaseError> {
    let DeValue::Array(items) = value.get_ref() else {
        return Err(reader.wrong_type(value, "between", "a list of two names"));
    };
    let buildings = row.names(reader)?;
    let mut sides = Vec::new();
    for item in items.iter() {
        let name = reader.text(item, "between")?;
        let side = if name.value == "wall" {
            Side::Wall
        } else {
            let found = buildings.iter().position(|b| *b == name.value);
            Side::Building(found.ok_or_else(|| unknown_building(reader, &name, buildings))?)
        };
        sides.push((side, name.value));
    }
    let [(left, a), (right, b)] = sides.as_slice() else {
        return Err(reader.error(
            value.span(),
            format!("`between` has {} names", sides.len()),
            "name the left and the right neighbour",
        ));
    };
    match row_problem(*left, *right, buildings.len() - 1) {
        Some((problem, true)) => Err(reader.error(
            value.span(),
            problem,
            format!("write between = [{b:?}, {a:?}]"),
        )),
        Some((problem, false)) => Err(reader.error(
            value.span(),
            problem,
            "buildings stand in a row in the order of the file; name left and right neighbour",
        )),
        None => Ok(([*left, *right], [a.clone(), b.clone()])),
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

fn unknown_building(reader: &Reader<'_>, name: &Located<String>, names: &[String]) -> CaseError {
    let guess = suggestion::misspelt(&name.value, names)
        .map_or_else(String::new, |n| format!("did you mean \"{n}\"? "));
    reader.error(
        name.span.clone(),
        format!("there is no building \"{}\"", name.value),
        format!(
            "{guess}buildings: {}; a rigid wall is \"wall\"",
            names.join(", ")
        ),
    )
}

/// Storeys from zero of the left and the right building, `None` for a wall.
pub(super) type Pair = (Option<usize>, Option<usize>);

/// The floors that face one another across a gap or a link.
pub(super) struct Faced {
    /// Pairs, each with its place in the source.
    pub pairs: Vec<(Pair, Range<usize>)>,
    /// Whether `levels` names them.
    pub listed: bool,
    /// Elevation tolerance (m).
    pub tolerance: f64,
}

/// The pairs of floors that may touch; `place` is where an error of the default
/// rule points.
pub(super) fn levels(
    table: &Table<'_, '_>,
    between: [Side; 2],
    buildings: &[Building],
    place: Range<usize>,
) -> Result<Faced, CaseError> {
    let reader = &table.reader;
    for key in ["levels", "elevation_tolerance"] {
        table.misspelt(key).map_or(Ok(()), Err)?;
    }
    let (mut matching_only, mut listed) = (false, None);
    if let Some(value) = table.get("levels") {
        match value.get_ref() {
            DeValue::String(word) if word == "matching" => matching_only = true,
            DeValue::Array(_) => listed = Some(listed_levels(reader, value, between, buildings)?),
            _ => {
                return Err(reader.wrong_type(
                    value,
                    "levels",
                    "a list of storeys, or \"matching\"",
                ));
            }
        }
    }
    if let (Some(value), true) = (
        table.get("elevation_tolerance"),
        between.contains(&Side::Wall),
    ) {
        return Err(useless_tolerance(reader, value, "a wall"));
    }
    // The rule stands in `levels` where it is given.
    let place = match table.get("levels") {
        Some(value) if matching_only => value.span(),
        _ => place,
    };
    let facing = match between {
        [Side::Building(i), Side::Building(j)] => Some([&buildings[i], &buildings[j]]),
        _ => None,
    };
    let named = listed.is_some();
    let tolerance = match facing {
        Some(pair) => elevation_tolerance(table, pair, &place)?,
        None => ELEVATION_TOLERANCE,
    };
    let by_rule = |pairs: Vec<Pair>| pairs.into_iter().map(|p| (p, place.clone())).collect();
    let pairs = match (listed, between, facing) {
        (Some(pairs), ..) => pairs,
        (None, _, Some(pair)) => {
            let place = place.clone();
            by_rule(levels_at_equal_elevation(
                reader,
                pair,
                tolerance,
                matching_only,
                place,
            )?)
        }
        (None, [Side::Building(i), _], None) => {
            let storeys = 0..buildings[i].mass.len();
            by_rule(storeys.map(|s| (Some(s), None)).collect())
        }
        (None, [_, Side::Building(j)], None) => {
            let storeys = 0..buildings[j].mass.len();
            by_rule(storeys.map(|s| (None, Some(s))).collect())
        }
        (None, [Side::Wall, Side::Wall], None) => Vec::new(),
    };
    Ok(Faced {
        pairs,
        listed: named,
        tolerance,
    })
}

/// An elevation tolerance where nothing asks for one.
pub(super) fn useless_tolerance(reader: &Reader<'_>, value: &Value<'_>, beside: &str) -> CaseError {
    reader.error(
        value.span(),
        format!("`elevation_tolerance` has no meaning beside {beside}"),
        "remove it",
    )
}

/// The tolerance within which floors of two neighbours are level (m).
fn elevation_tolerance(
    table: &Table<'_, '_>,
    buildings: [&Building; 2],
    place: &Range<usize>,
) -> Result<f64, CaseError> {
    let stated = table.get("elevation_tolerance");
    let tolerance = table
        .optional_positive("elevation_tolerance", Dimension::LENGTH)?
        .unwrap_or(ELEVATION_TOLERANCE);
    let lowest = buildings
        .iter()
        .flat_map(|b| &b.height)
        .fold(f64::INFINITY, |least, h| least.min(*h));
    // With less than half a storey, no floor can have two partners.
    if tolerance >= 0.5 * lowest {
        return Err(table.reader.error(
            stated.map_or(place.clone(), Spanned::span),
            format!("the elevation tolerance {tolerance} m is not less than half of the lowest storey, {lowest} m"),
            "state a smaller `elevation_tolerance`",
        ));
    }
    Ok(tolerance)
}

/// Whether floors that are not level act on each other as if they were. The key must not
/// look as if it paired floors by their numbers.
fn floor_to_floor(
    table: &Table<'_, '_>,
    between: [Side; 2],
    listed: bool,
) -> Result<bool, CaseError> {
    let stated = table.flag("floor_to_floor")?;
    match table.get("floor_to_floor") {
        Some(value) if stated && (!listed || between.contains(&Side::Wall)) => {
            Err(table.reader.error(
                value.span(),
                "`floor_to_floor` has no meaning without pairs of floors in `levels`",
                "name the pairs of storeys that may touch with `levels = [[1, 1], ...]`, or remove it",
            ))
        }
        _ => Ok(stated),
    }
}

/// `levels` as a list.
fn listed_levels(
    reader: &Reader<'_>,
    value: &Value<'_>,
    between: [Side; 2],
    buildings: &[Building],
) -> Result<Vec<(Pair, Range<usize>)>, CaseError> {
    let mut seen = HashSet::new();
    let mut pairs = Vec::new();
    for item in value.get_ref().as_array().into_iter().flatten() {
        let pair = pair(reader, item, between, buildings)?;
        if !seen.insert(pair) {
            return Err(reader.error(item.span(), "this level is given twice", "remove one"));
        }
        pairs.push((pair, item.span()));
    }
    if pairs.is_empty() {
        return Err(reader.error(
            value.span(),
            "`levels` is empty",
            "name at least one pair of storeys, or one storey beside a wall",
        ));
    }
    Ok(pairs)
}

fn levels_at_equal_elevation(
    reader: &Reader<'_>,
    buildings: [&Building; 2],
    tolerance: f64,
    matching_only: bool,
    place: Range<usize>,
) -> Result<Vec<Pair>, CaseError> {
    let [a, b] = buildings.map(Building::elevations);
    let pairs = level_pairs(&a, &b, tolerance);
    if pairs.is_empty() && matching_only {
        let [left, right] = buildings.map(|b| &b.name.value);
        let (a, b) = (shown(&a), shown(&b));
        return Err(reader.error(
            place,
            format!("no floor of \"{left}\" ({a}) is level with a floor of \"{right}\" ({b}; tolerance {tolerance} m)"),
            AT_DIFFERENT_ELEVATIONS,
        ));
    }
    let faced = |pairs: &[(usize, usize)]| pairs.iter().map(|p| (Some(p.0), Some(p.1))).collect();
    if matching_only {
        return Ok(faced(&pairs));
    }
    let Some((side, storey)) = floor_without_partner([&a, &b], &pairs, tolerance) else {
        return Ok(faced(&pairs));
    };
    let (building, elevation) = (buildings[side], [&a, &b][side][storey]);
    Err(reader.error(
        place,
        format!("floor {} of \"{}\" at {elevation} m has no floor of its neighbour at equal elevation (tolerance {tolerance} m)", storey + 1, building.name.value),
        match pairs.is_empty() {
            true => AT_DIFFERENT_ELEVATIONS.to_owned(),
            false => format!("write `levels = \"matching\"` to let only floors at equal elevation touch; otherwise {AT_DIFFERENT_ELEVATIONS}"),
        },
    ))
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
    item: &Value<'_>,
    sides: [Side; 2],
    buildings: &[Building],
) -> Result<Pair, CaseError> {
    let storey = |value: &Value<'_>, side: Side| match side {
        Side::Wall => Ok(None),
        Side::Building(b) => {
            let storeys = buildings[b].mass.len();
            let given = match value.get_ref() {
                DeValue::Integer(i) => i64::from_str_radix(i.as_str(), i.radix()).ok(),
                _ => return Err(reader.wrong_type(value, "levels", "a whole number")),
            };
            let given = given.and_then(|n| usize::try_from(n).ok());
            match given.filter(|n| (1..=storeys).contains(n)) {
                Some(n) => Ok(Some(n - 1)),
                None => {
                    let text = reader.source.get(value.span()).unwrap_or_default();
                    Err(reader.error(
                        value.span(),
                        format!("\"{}\" has no storey {text}", buildings[b].name.value),
                        match storeys {
                            1 => "it has 1 storey: name that, 1".to_owned(),
                            _ => format!("it has {storeys} storeys: name one from 1 to {storeys}"),
                        },
                    ))
                }
            }
        }
    };
    match item.get_ref() {
        DeValue::Array(items) if items.len() == 2 && !sides.contains(&Side::Wall) => {
            Ok((storey(&items[0], sides[0])?, storey(&items[1], sides[1])?))
        }
        DeValue::Integer(_) if sides.contains(&Side::Wall) => {
            Ok((storey(item, sides[0])?, storey(item, sides[1])?))
        }
        _ => Err(reader.wrong_type(
            item,
            "levels",
            "pairs of storeys such as [1, 1], or storeys beside a wall",
        )),
    }
}
