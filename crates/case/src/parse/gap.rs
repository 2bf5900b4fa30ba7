//! Gaps: neighbours, contact levels, and the model's parameters.

use std::collections::HashSet;
use std::ops::Range;

use toml::Spanned;
use toml::de::DeValue;

use super::{Row, check_name, not_negative, spread};
use crate::error::CaseError;
use crate::reader::{Reader, Table, Value, distance};
use crate::schema;
use crate::types::{Building, ContactLevel, Gap, Located, Parameter, Side};
use crate::units::Dimension;

/// Reads a gap; also returns where its `between` stands.
pub(super) fn gap(
    reader: &Reader<'_>,
    value: &Value<'_>,
    row: &Row,
) -> Result<(Gap, Range<usize>), CaseError> {
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
    let place = table.required("between")?;
    let (between, names) = between(reader, place, row)?;
    let buildings = row.buildings(reader)?;
    let pairs = levels(&table, between, buildings, place.span())?;
    let (Some(width), Some(model)) = (width, model) else {
        return Err(reader.lost());
    };
    let widths = spread(reader, width, pairs.len(), "contact level")?;
    let mut levels: Vec<ContactLevel> = pairs
        .into_iter()
        .zip(widths)
        .map(|((left, right), width)| ContactLevel { left, right, width })
        .collect();
    levels.sort_by_key(|level| (level.left, level.right));
    let gap = Gap {
        name: name.unwrap_or_else(|| names.join("-")),
        between,
        levels,
        model,
        separation,
        parameters,
    };
    Ok((gap, place.span()))
}

/// The name of a gap or link, if it states one.
pub(super) fn name(table: &Table<'_, '_>, what: &str) -> Result<Option<String>, CaseError> {
    let name = table.optional_text("name")?;
    let name = name.map(|name| check_name(&table.reader, name, what));
    Ok(name.transpose()?.map(|name| name.value))
}

/// All keys but those of the gap itself.
fn parameters(table: &Table<'_, '_>) -> Vec<Parameter> {
    let reader = &table.reader;
    let mut parameters = Vec::new();
    for (key, value) in table.entries() {
        let own = schema::GAP.iter().any(|k| k.name == key.value);
        if own || table.is_unknown(&key.value) {
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
        }
    }
    parameters
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
    let guess = names
        .iter()
        .min_by_key(|n| distance(n, &name.value))
        .filter(|n| distance(n, &name.value) <= 1 + name.value.chars().count() / 3)
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

/// Floors this close in elevation are level unless the case says otherwise (m).
const ELEVATION_TOLERANCE: f64 = 0.01;

/// Storeys from zero of the left and the right building, `None` for a wall.
pub(super) type Pair = (Option<usize>, Option<usize>);

/// The pairs of floors that may touch; `place` is where an error of the default
/// rule points.
pub(super) fn levels(
    table: &Table<'_, '_>,
    between: [Side; 2],
    buildings: &[Building],
    place: Range<usize>,
) -> Result<Vec<Pair>, CaseError> {
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
        listed.is_some() || between.contains(&Side::Wall),
    ) {
        return Err(reader.error(
            value.span(),
            "`elevation_tolerance` has no meaning beside a wall or listed `levels`",
            "remove it",
        ));
    }
    match (listed, between) {
        (Some(pairs), _) => Ok(pairs),
        (None, [Side::Building(i), Side::Building(j)]) => {
            let pair = [&buildings[i], &buildings[j]];
            levels_at_equal_elevation(table, pair, matching_only, place)
        }
        (None, [Side::Building(i), Side::Wall]) => Ok((0..buildings[i].mass.len())
            .map(|s| (Some(s), None))
            .collect()),
        (None, [Side::Wall, Side::Building(j)]) => Ok((0..buildings[j].mass.len())
            .map(|s| (None, Some(s)))
            .collect()),
        (None, [Side::Wall, Side::Wall]) => Ok(Vec::new()),
    }
}

/// `levels` as a list.
fn listed_levels(
    reader: &Reader<'_>,
    value: &Value<'_>,
    between: [Side; 2],
    buildings: &[Building],
) -> Result<Vec<Pair>, CaseError> {
    let mut seen = HashSet::new();
    let mut pairs = Vec::new();
    for item in value.get_ref().as_array().into_iter().flatten() {
        let pair = pair(reader, item, between, buildings)?;
        if !seen.insert(pair) {
            return Err(reader.error(item.span(), "this level is given twice", "remove one"));
        }
        pairs.push(pair);
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
    table: &Table<'_, '_>,
    buildings: [&Building; 2],
    matching_only: bool,
    place: Range<usize>,
) -> Result<Vec<Pair>, CaseError> {
    let reader = &table.reader;
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
        return Err(reader.error(
            stated.map_or(place, Spanned::span),
            format!("the elevation tolerance {tolerance} m is not less than half of the lowest storey, {lowest} m"),
            "state a smaller `elevation_tolerance`",
        ));
    }
    let [a, b] = buildings.map(elevations);
    equal_elevation(&a, &b, tolerance, matching_only).map_err(|unmatched| {
        let (building, storey, elevation) = match unmatched {
            Unmatched::Left(s) => (buildings[0], s, a[s]),
            Unmatched::Right(s) => (buildings[1], s, b[s]),
        };
        reader.error(
            place,
            format!("floor {} of \"{}\" at {elevation} m has no floor of its neighbour at equal elevation (tolerance {tolerance} m)", storey + 1, building.name.value),
            "name the pairs of storeys that may touch with `levels = [[1, 1], ...]`, or write `levels = \"matching\"` to let only floors at equal elevation touch",
        )
    })
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
            let n = reader.count(value, "levels", 1)?;
            if n <= buildings[b].mass.len() {
                Ok(Some(n - 1))
            } else {
                Err(reader.error(
                    value.span(),
                    format!("\"{}\" has no storey {n}", buildings[b].name.value),
                    format!("it has {} storeys", buildings[b].mass.len()),
                ))
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

fn elevations(building: &Building) -> Vec<f64> {
    building
        .height
        .iter()
        .scan(0.0, |sum, h| {
            *sum += h;
            Some(*sum)
        })
        .collect()
}

enum Unmatched {
    Left(usize),
    Right(usize),
}

/// Floors at equal elevation. Below the roof of the lower building every floor
/// must have a partner, unless only matching floors are asked for.
fn equal_elevation(
    a: &[f64],
    b: &[f64],
    tolerance: f64,
    matching_only: bool,
) -> Result<Vec<Pair>, Unmatched> {
    // Elevations rise, so the first that is not below the band is the only candidate.
    let near = |x: f64, others: &[f64]| {
        let at = others.partition_point(|y| *y < x - tolerance);
        others
            .get(at)
            .is_some_and(|y| *y <= x + tolerance)
            .then_some(at)
    };
    let roof = |x: &[f64]| x.last().copied().unwrap_or(0.0);
    let top = roof(a).min(roof(b)) + tolerance;
    let pairs: Vec<Pair> = a
        .iter()
        .enumerate()
        .filter_map(|(i, x)| near(*x, b).map(|j| (Some(i), Some(j))))
        .collect();
    if !matching_only {
        if let Some(i) = a.iter().position(|x| *x <= top && near(*x, b).is_none()) {
            return Err(Unmatched::Left(i));
        }
        if let Some(j) = b.iter().position(|x| *x <= top && near(*x, a).is_none()) {
            return Err(Unmatched::Right(j));
        }
    }
    if pairs.is_empty() {
        return Err(Unmatched::Left(0));
    }
    Ok(pairs)
}
