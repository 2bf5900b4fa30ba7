//! Buildings: storeys and damping.

use pounding_catalogue::wording::counted;
use toml::de::DeValue;

use super::law::storey_laws;
use super::{check_name, not_negative, spread};
use crate::error::CaseError;
use crate::reader::{List, Reader, Table, Value, Values};
use crate::schema;
use crate::types::{Building, Damping, Located};
use crate::units::Dimension;

/// A building, and whether its heights are sound.
type Read = Result<(Building, bool), CaseError>;

/// Reads a building; its name also where the rest is wrong.
pub(super) fn building(reader: &Reader<'_>, value: &Value<'_>) -> (Option<Located<String>>, Read) {
    let table = match reader.section(value, "[[building]]", schema::BUILDING) {
        Ok(table) => table,
        Err(e) => return (None, Err(e)),
    };
    let name = reader.errors.keep(name(reader, &table));
    let rest = named(reader, &table, name.clone());
    (name, rest)
}

fn name(reader: &Reader<'_>, table: &Table<'_, '_>) -> Result<Located<String>, CaseError> {
    let name = check_name(
        reader,
        reader.text(table.required("name")?, "name")?,
        "building",
    )?;
    if name.value == "wall" {
        return Err(reader.error(
            name.span,
            "a building cannot be called \"wall\"",
            "in `between`, \"wall\" is the rigid wall; give the building another name",
        ));
    }
    Ok(name)
}

fn named(reader: &Reader<'_>, table: &Table<'_, '_>, name: Option<Located<String>>) -> Read {
    let keep = reader.errors;
    let read = |key: &str, dimension| {
        let value = table.required(key);
        keep.keep(value.and_then(|v| reader.list(v, key, |v| reader.positive(v, key, dimension))))
    };
    let mass = read("mass", Dimension::MASS);
    let stiffness = read("stiffness", Dimension::STIFFNESS);
    let height = read("height", Dimension::LENGTH);
    let start = |key: &'static str, dimension| {
        let value = table.get(key);
        keep.or_default(
            value
                .map(|value| reader.list(value, key, |v| reader.quantity(v, key, dimension)))
                .transpose(),
        )
    };
    let displacement = start("initial_displacement", Dimension::LENGTH);
    let velocity = start("initial_velocity", Dimension::VELOCITY);
    let stated = table.get("storeys").map(|v| reader.count(v, "storeys", 1));
    let stated = keep.keep(stated.transpose());
    let p_delta = keep.or_default(table.flag("p_delta"));
    let damped = keep.keep(table.required("damping"));
    let sound = [&mass, &stiffness, &height].iter().all(|l| l.is_some());
    let lists: Vec<(&str, &List)> = [
        ("mass", &mass),
        ("stiffness", &stiffness),
        ("height", &height),
        ("initial_displacement", &displacement),
        ("initial_velocity", &velocity),
    ]
    .into_iter()
    .filter_map(|(key, list)| Some((key, list.as_ref()?)))
    .collect();
    let storeys = match storeys(table, stated.flatten(), &lists)? {
        Some(storeys) => storeys,
        // One of the values that are wrong may say it.
        None if !sound || stated.is_none() => return Err(reader.lost()),
        None => {
            return Err(table.misspelt("storeys").unwrap_or_else(|| {
                table.reader.error(
                    table.span.clone(),
                    "the building does not say how many storeys it has",
                    "add `storeys = ...`",
                )
            }));
        }
    };
    let all = |list: List| match list.values {
        Values::Scalar(x) => vec![x; storeys],
        Values::List(values) => values,
    };
    let or = |list: Option<List>, stand_in: f64| list.map_or_else(|| vec![stand_in; storeys], all);
    let laws = match table.get("law") {
        Some(value) => keep.or_default(storey_laws(reader, value, storeys)),
        None => Vec::new(),
    };
    if stiffness.is_none() {
        // A law is held against the stiffness of its storey.
        for law in &laws {
            keep.incomplete(law.model.span.clone());
        }
    }
    let damping = damped.and_then(|value| {
        Some(Located {
            value: keep.keep(damping(reader, value, storeys))?,
            span: value.span(),
        })
    });
    let name = name.unwrap_or_else(|| Located {
        value: String::new(),
        span: table.span.clone(),
    });
    // With stand-ins for masses or stiffnesses, damping and gravity would say nothing.
    let damping = damping.filter(|_| sound).unwrap_or_else(|| {
        keep.incomplete(table.span.clone());
        Located {
            value: Damping::MassProportional { ratio: 0.0 },
            span: table.span.clone(),
        }
    });
    let heights = height.is_some();
    let building = Building {
        initial_displacement: Located {
            span: displacement
                .as_ref()
                .map_or_else(|| name.span.clone(), |l| l.span.clone()),
            value: or(displacement, 0.0),
        },
        initial_velocity: or(velocity, 0.0),
        name,
        mass: or(mass, 1.0),
        stiffness: or(stiffness, 1.0),
        height: or(height, 1.0),
        laws,
        p_delta: p_delta && sound,
        damping,
    };
    Ok((building, heights))
}

/// The number of storeys, on which `storeys` and all lists must agree; `None` if nothing
/// says it.
fn storeys(
    table: &Table<'_, '_>,
    stated: Option<usize>,
    lists: &[(&str, &List)],
) -> Result<Option<usize>, CaseError> {
    let mut known = stated.map(|n| ("storeys", n));
    for &(key, list) in lists {
        let Values::List(values) = &list.values else {
            continue;
        };
        match known {
            None => known = Some((key, values.len())),
            Some((other, n)) if n != values.len() => {
                return Err(table.reader.error(
                    list.span.clone(),
                    format!(
                        "`{key}` has {}, but `{other}` says {}",
                        counted(values.len(), "value"),
                        counted(n, "storey")
                    ),
                    "give one value per storey, or a single value for all",
                ));
            }
            Some(_) => {}
        }
    }
    Ok(known.map(|(_, n)| n))
}

fn damping(reader: &Reader<'_>, value: &Value<'_>, storeys: usize) -> Result<Damping, CaseError> {
    let table = reader.table(value, "damping", schema::DAMPING)?;
    let kind = kind(&table)?;
    let value = table.required(kind)?;
    let ratio = |v: &Value<'_>| {
        let ratio = reader.quantity(v, kind, Dimension::NUMBER)?;
        if (0.0..1.0).contains(&ratio) {
            Ok(ratio)
        } else {
            Err(reader.error(
                v.span(),
                format!("damping ratio {ratio} is not in 0..1"),
                "5 % of critical is 0.05 or \"5 %\"",
            ))
        }
    };
    Ok(match kind {
        "ratio" => Damping::RayleighRatio {
            ratio: ratio(value)?,
            modes: two_modes(reader, table.required("modes")?, storeys)?,
        },
        "rayleigh" => {
            let table = reader.table(value, "rayleigh", schema::RAYLEIGH)?;
            Damping::Rayleigh {
                alpha: not_negative(
                    reader,
                    table.required("alpha")?,
                    "alpha",
                    Dimension::FREQUENCY,
                )?,
                beta: not_negative(reader, table.required("beta")?, "beta", Dimension::TIME)?,
            }
        }
        "stiffness_proportional" => Damping::StiffnessProportional {
            ratio: ratio(value)?,
        },
        "mass_proportional" => Damping::MassProportional {
            ratio: ratio(value)?,
        },
        "modal" => Damping::Modal {
            ratios: spread(reader, reader.list(value, kind, ratio)?, storeys, "mode")?,
        },
        _ => {
            let read = |v: &Value<'_>| not_negative(reader, v, kind, Dimension::DASHPOT);
            Damping::Dashpots {
                coefficients: spread(reader, reader.list(value, kind, read)?, storeys, "storey")?,
            }
        }
    })
}

/// The one kind of damping that the keys of its table say.
fn kind(table: &Table<'_, '_>) -> Result<&'static str, CaseError> {
    let error = |message: String| {
        let kinds: Vec<String> = schema::DAMPING_KINDS
            .iter()
            .map(|keys| format!("{{ {} }}", keys.join(", ")))
            .collect();
        table.reader.error(
            table.span.clone(),
            message,
            format!("write one of {}", kinds.join(", ")),
        )
    };
    let found: Vec<&[&'static str]> = schema::DAMPING_KINDS
        .iter()
        .filter(|keys| keys.first().is_some_and(|k| table.get(k).is_some()))
        .copied()
        .collect();
    let [keys] = found.as_slice() else {
        return Err(error(format!(
            "`damping` must be of one kind, not {}",
            found.len()
        )));
    };
    let stray = table
        .entries()
        .into_iter()
        .find(|(key, _)| !keys.contains(&key.value.as_str()));
    match (stray, keys.first()) {
        (None, Some(kind)) => Ok(kind),
        (Some((key, _)), _) => Err(error(format!(
            "`{}` has no meaning beside `{}`",
            key.value, keys[0]
        ))),
        (None, None) => Err(error("`damping` is empty".to_owned())),
    }
}

fn two_modes(
    reader: &Reader<'_>,
    value: &Value<'_>,
    storeys: usize,
) -> Result<[usize; 2], CaseError> {
    let DeValue::Array(items) = value.get_ref() else {
        return Err(reader.wrong_type(value, "modes", "a list of two modes"));
    };
    let modes = items
        .iter()
        .map(|v| reader.count(v, "modes", 1))
        .collect::<Result<Vec<_>, _>>()?;
    match modes.as_slice() {
        [a, b] if a != b && *a <= storeys && *b <= storeys => Ok([*a, *b]),
        _ => Err(reader.error(
            value.span(),
            format!("`modes` must be two different modes from 1 to {storeys}"),
            "for a single storey use { mass_proportional = ... }",
        )),
    }
}
