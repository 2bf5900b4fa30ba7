//! Gaps: neighbours, contact levels, and the model's parameters.

use std::ops::Range;

use toml::de::DeValue;

use super::{
    Building, CaseError, Gap, Located, Parameter, Reader, Side, Value, distance, not_negative,
    schema, spread,
};
use crate::reader::Table;
use crate::types::ContactLevel;
use crate::units::Dimension;

/// Reads a gap; also returns where its `between` stands.
pub(super) fn gap(
    reader: &Reader<'_>,
    value: &Value<'_>,
    buildings: &[Building],
) -> Result<(Gap, Range<usize>), CaseError> {
    let table = reader.table(value, "[[gap]]", schema::GAP)?;
    let place = table.required("between")?;
    let (between, names) = between(reader, place, buildings)?;
    let name = match table.optional_text("name")? {
        Some(name) if !name.value.trim().is_empty() && !name.value.contains('/') => name.value,
        Some(name) => {
            return Err(reader.error(
                name.span,
                format!("\"{}\" cannot name a gap", name.value),
                "a name is not empty and has no slash",
            ));
        }
        None => names.join("-"),
    };
    let pairs = levels(&table, between, buildings, place.span())?;
    let width = table.required("width")?;
    let read = |v: &Value<'_>| not_negative(reader, v, "width", Dimension::LENGTH);
    let widths = spread(
        reader,
        reader.list(width, "width", read)?,
        pairs.len(),
        "contact level",
    )?;
    let levels = pairs
        .into_iter()
        .zip(widths)
        .map(|((left, right), width)| ContactLevel { left, right, width })
        .collect();
    let mut parameters = Vec::new();
    for (key, value) in table.entries() {
        if schema::GAP.iter().any(|k| k.name == key.value) {
            continue;
        }
        // An unknown key next to a key of the gap is a slip, not a parameter.
        let near = schema::GAP
            .iter()
            .find(|k| k.name != "*" && distance(&key.value, k.name) <= 2);
        if let Some(near) = near {
            return Err(reader.error(
                key.span,
                format!("unknown key `{}` in [[gap]]", key.value),
                format!("did you mean `{}`?", near.name),
            ));
        }
        let quantity = reader.any_quantity(value, &key.value)?;
        parameters.push(Parameter {
            key,
            value: Located {
                value: quantity,
                span: value.span(),
            },
        });
    }
    let gap = Gap {
        name,
        between,
        levels,
        model: reader.text(table.required("model")?, "model")?,
        separation: table.optional_text("separation")?,
        parameters,
    };
    Ok((gap, place.span()))
}

fn between(
    reader: &Reader<'_>,
    value: &Value<'_>,
    buildings: &[Building],
) -> Result<([Side; 2], [String; 2]), CaseError> {
    let DeValue::Array(items) = value.get_ref() else {
        return Err(reader.wrong_type(value, "between", "a list of two names"));
    };
    let mut sides = Vec::new();
    for item in items.iter() {
        let name = reader.text(item, "between")?;
        let side = if name.value == "wall" {
            Side::Wall
        } else {
            let found = buildings.iter().position(|b| b.name.value == name.value);
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
    let (first, last) = (0, buildings.len() - 1);
    let problem = match (*left, *right) {
        (Side::Wall, Side::Wall) => Some("a gap cannot lie between two walls"),
        (Side::Wall, Side::Building(i)) if i != first => {
            Some("a wall on the left can only stand beside the first building")
        }
        (Side::Building(i), Side::Wall) if i != last => {
            Some("a wall on the right can only stand beside the last building")
        }
        (Side::Building(i), Side::Building(j)) if i == j => {
            Some("a gap needs two different neighbours")
        }
        (Side::Building(i), Side::Building(j)) if i == j + 1 => {
            Some("the neighbours are in the wrong order: the left one comes first")
        }
        (Side::Building(i), Side::Building(j)) if j != i + 1 => {
            Some("these buildings are not neighbours in the order of the file")
        }
        _ => None,
    };
    match problem {
        Some(problem) => Err(reader.error(
            value.span(),
            problem,
            "buildings stand in a row in the order of the file; name left and right neighbour",
        )),
        None => Ok(([*left, *right], [a.clone(), b.clone()])),
    }
}

fn unknown_building(
    reader: &Reader<'_>,
    name: &Located<String>,
    buildings: &[Building],
) -> CaseError {
    let nearest = buildings
        .iter()
        .map(|b| b.name.value.as_str())
        .min_by_key(|b| distance(b, &name.value));
    reader.error(
        name.span.clone(),
        format!("there is no building \"{}\"", name.value),
        format!(
            "did you mean \"{}\"? A rigid wall is \"wall\"",
            nearest.unwrap_or("wall")
        ),
    )
}

type Pair = (Option<usize>, Option<usize>);

/// The pairs of floors that may touch, from the bottom.
fn levels(
    table: &Table<'_, '_>,
    between: [Side; 2],
    buildings: &[Building],
    place: Range<usize>,
) -> Result<Vec<Pair>, CaseError> {
    let reader = &table.reader;
    let tolerance = table
        .optional_positive("elevation_tolerance", Dimension::LENGTH)?
        .unwrap_or(0.01);
    let (mut matching_only, mut listed) = (false, None);
    if let Some(value) = table.get("levels") {
        match value.get_ref() {
            DeValue::String(word) if word == "matching" => matching_only = true,
            DeValue::Array(items) => listed = Some((items, value.span())),
            _ => {
                return Err(reader.wrong_type(
                    value,
                    "levels",
                    "a list of storeys, or \"matching\"",
                ));
            }
        }
    }
    match (between, listed) {
        ([left, right], Some((items, span))) => {
            let mut pairs = Vec::new();
            for item in items.iter() {
                let pair = pair(reader, item, [left, right], buildings)?;
                if pairs.contains(&pair) {
                    return Err(reader.error(
                        item.span(),
                        "this level is given twice",
                        "remove one",
                    ));
                }
                pairs.push(pair);
            }
            if pairs.is_empty() {
                return Err(reader.error(
                    span,
                    "`levels` is empty",
                    "name at least one pair of storeys",
                ));
            }
            Ok(pairs)
        }
        ([Side::Building(i), Side::Building(j)], None) => {
            let (a, b) = (elevations(&buildings[i]), elevations(&buildings[j]));
            let names = (&buildings[i].name.value, &buildings[j].name.value);
            equal_elevation(&a, &b, tolerance, matching_only)
                .map_err(|unmatched| {
                    let (name, storey, elevation) = match unmatched {
                        Unmatched::Left(s) => (names.0, s, a[s]),
                        Unmatched::Right(s) => (names.1, s, b[s]),
                    };
                    reader.error(
                        place,
                        format!("floor {} of \"{name}\" at {elevation} m has no floor of its neighbour at equal elevation (tolerance {tolerance} m)", storey + 1),
                        "name the pairs of storeys that may touch with `levels = [[1, 1], ...]`, or write `levels = \"matching\"` to let only floors at equal elevation touch",
                    )
                })
        }
        ([Side::Building(i), Side::Wall], None) => Ok((0..buildings[i].mass.len())
            .map(|s| (Some(s), None))
            .collect()),
        ([_, Side::Building(j)], None) => Ok((0..buildings[j].mass.len())
            .map(|s| (None, Some(s)))
            .collect()),
        (_, None) => Ok(Vec::new()),
    }
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
    let near = |x: f64, others: &[f64]| others.iter().position(|y| (x - y).abs() <= tolerance);
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
