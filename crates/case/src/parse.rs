//! From the TOML tree to a case.

use std::path::{Path, PathBuf};

use toml::de::{DeTable, DeValue};

use crate::error::CaseError;
use crate::reader::{List, Reader, Table, Value, Values, distance};
use crate::schema;
use crate::types::{
    Analysis, Building, Case, Damping, Gap, GroundMotion, Located, Parameter, Scale, Side,
};
use crate::units::Dimension;

mod gap;

pub(crate) fn case(source: &str, file: &Path) -> Result<Case, CaseError> {
    let name = file.display().to_string();
    let reader = Reader {
        file: &name,
        source,
    };
    let tree = DeTable::parse(source).map_err(|e| {
        reader.error(
            e.span().unwrap_or(0..0),
            format!("this is not TOML: {}", e.message()),
            "see the example in the README",
        )
    })?;
    let root = Table::new(reader, tree.get_ref(), 0..0, "the case", schema::CASE)?;
    let title = root
        .optional_text("title")?
        .map_or(String::new(), |t| t.value);
    let mut buildings: Vec<Building> = Vec::new();
    for value in tables(&root, "building")? {
        let building = building(&reader, value)?;
        if let Some(other) = buildings
            .iter()
            .find(|b| b.name.value == building.name.value)
        {
            let first = CaseError::new(&name, source, other.name.span.clone(), "", None);
            return Err(reader.error(
                building.name.span,
                format!(
                    "building \"{}\" is given twice, first in line {}",
                    building.name.value, first.line
                ),
                "give every building its own name",
            ));
        }
        buildings.push(building);
    }
    if buildings.is_empty() {
        return Err(reader.error(0..0, "the case has no building", "add a [[building]]"));
    }
    let mut gaps: Vec<(Gap, std::ops::Range<usize>)> = Vec::new();
    for value in tables(&root, "gap")? {
        let (gap, span) = gap::gap(&reader, value, &buildings)?;
        if let Some((_, first)) = gaps.iter().find(|(g, _)| g.between == gap.between) {
            let first = CaseError::new(&name, source, first.clone(), "", None);
            return Err(reader.error(
                span,
                format!("gap given twice: the first is in line {}", first.line),
                "remove one; several levels of one gap go into its `levels` and `width`",
            ));
        }
        gaps.push((gap, span));
    }
    let ground_motion = ground_motion(&reader, root.required("ground_motion")?)?;
    let analysis = match root.get("analysis") {
        Some(value) => analysis(&reader, value)?,
        None => default_analysis(),
    };
    Ok(Case {
        title,
        buildings,
        gaps: gaps.into_iter().map(|(g, _)| g).collect(),
        ground_motion,
        analysis,
        source: source.to_owned(),
        file: file.to_owned(),
    })
}

/// The tables of an array of tables; none if the key is absent.
fn tables<'v, 'a>(root: &Table<'v, 'a>, key: &str) -> Result<Vec<&'v Value<'a>>, CaseError> {
    match root.get(key) {
        None => Ok(Vec::new()),
        Some(value) => match value.get_ref() {
            DeValue::Array(items) => Ok(items.iter().collect()),
            _ => Err(root.reader.error(
                value.span(),
                format!("`{key}` must be a list of tables"),
                format!("write [[{key}]] with double brackets"),
            )),
        },
    }
}

fn building(reader: &Reader<'_>, value: &Value<'_>) -> Result<Building, CaseError> {
    let table = reader.table(value, "[[building]]", schema::BUILDING)?;
    let name = reader.text(table.required("name")?, "name")?;
    if name.value == "wall" || name.value.trim().is_empty() || name.value.contains('/') {
        return Err(reader.error(
            name.span,
            format!("\"{}\" cannot name a building", name.value),
            "\"wall\" is the rigid wall; a name is not empty and has no slash",
        ));
    }
    let read = |key: &str, dimension| {
        let value = table.required(key)?;
        reader.list(value, key, |v| reader.positive(v, key, dimension))
    };
    let mass = read("mass", Dimension::MASS)?;
    let stiffness = read("stiffness", Dimension::STIFFNESS)?;
    let height = read("height", Dimension::LENGTH)?;
    let stated = table
        .get("storeys")
        .map(|v| reader.count(v, "storeys", 1))
        .transpose()?;
    let storeys = storeys(
        &table,
        stated,
        [
            ("mass", &mass),
            ("stiffness", &stiffness),
            ("height", &height),
        ],
    )?;
    let all = |list: List| match list.values {
        Values::Scalar(x) => vec![x; storeys],
        Values::List(values) => values,
    };
    let value = table.required("damping")?;
    Ok(Building {
        name,
        mass: all(mass),
        stiffness: all(stiffness),
        height: all(height),
        damping: Located {
            value: damping(reader, value, storeys)?,
            span: value.span(),
        },
    })
}

/// The number of storeys, on which `storeys` and all lists must agree.
fn storeys(
    table: &Table<'_, '_>,
    stated: Option<usize>,
    lists: [(&str, &List); 3],
) -> Result<usize, CaseError> {
    let mut known = stated.map(|n| ("storeys", n));
    for (key, list) in lists {
        let Values::List(values) = &list.values else {
            continue;
        };
        match known {
            None => known = Some((key, values.len())),
            Some((other, n)) if n != values.len() => {
                return Err(table.reader.error(
                    list.span.clone(),
                    format!(
                        "`{key}` has {} values, but `{other}` says {n} storeys",
                        values.len()
                    ),
                    "give one value a storey, or a single value for all",
                ));
            }
            Some(_) => {}
        }
    }
    known.map(|(_, n)| n).ok_or_else(|| {
        table.reader.error(
            table.span.clone(),
            "the building does not say how many storeys it has",
            "add `storeys = ...`",
        )
    })
}

fn damping(reader: &Reader<'_>, value: &Value<'_>, storeys: usize) -> Result<Damping, CaseError> {
    let table = reader.table(value, "damping", schema::DAMPING)?;
    let kinds: Vec<&str> = [
        "ratio",
        "rayleigh",
        "stiffness_proportional",
        "mass_proportional",
        "modal",
        "dashpots",
    ]
    .into_iter()
    .filter(|k| table.get(k).is_some())
    .collect();
    let [kind] = kinds.as_slice() else {
        return Err(reader.error(
            value.span(),
            format!("damping must be of one kind, not {}", kinds.len()),
            "for example { stiffness_proportional = 0.05 } or { ratio = 0.05, modes = [1, 3] }",
        ));
    };
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
    Ok(match *kind {
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

fn not_negative(
    reader: &Reader<'_>,
    value: &Value<'_>,
    key: &str,
    dimension: Dimension,
) -> Result<f64, CaseError> {
    let number = reader.quantity(value, key, dimension)?;
    if number >= 0.0 {
        Ok(number)
    } else {
        Err(reader.error(
            value.span(),
            format!("`{key}` = {number} must be zero or more"),
            "correct the value",
        ))
    }
}

/// One value for each of `count` places.
fn spread(
    reader: &Reader<'_>,
    list: List,
    count: usize,
    place: &str,
) -> Result<Vec<f64>, CaseError> {
    match list.values {
        Values::Scalar(x) => Ok(vec![x; count]),
        Values::List(values) if values.len() == count => Ok(values),
        Values::List(values) => Err(reader.error(
            list.span,
            format!("{} values where there are {count} {place}s", values.len()),
            format!("give one value a {place}, or a single value for all"),
        )),
    }
}

fn ground_motion(reader: &Reader<'_>, value: &Value<'_>) -> Result<GroundMotion, CaseError> {
    let table = reader.table(value, "[ground_motion]", schema::GROUND_MOTION)?;
    let file = reader.text(table.required("file")?, "file")?;
    let plain = |key: &str| Ok::<_, CaseError>(table.optional_text(key)?.map(|t| t.value));
    Ok(GroundMotion {
        file: Located {
            value: PathBuf::from(file.value),
            span: file.span,
        },
        format: table.optional_text("format")?,
        time_step: table.optional_positive("time_step", Dimension::TIME)?,
        unit: table.optional_text("unit")?,
        layout: plain("layout")?,
        component: plain("component")?,
        skip_lines: table
            .get("skip_lines")
            .map_or(Ok(0), |v| reader.count(v, "skip_lines", 0))?,
        prepend_zero: table.flag("prepend_zero")?,
        lenient: table.flag("lenient")?,
        scale: table
            .get("scale")
            .map_or(Ok(Scale::None), |v| scale(reader, v))?,
    })
}

fn scale(reader: &Reader<'_>, value: &Value<'_>) -> Result<Scale, CaseError> {
    if !matches!(value.get_ref(), DeValue::Table(_)) {
        return Ok(Scale::Factor(reader.positive(
            value,
            "scale",
            Dimension::NUMBER,
        )?));
    }
    let table = reader.table(value, "scale", schema::SCALE)?;
    match (table.get("factor"), table.get("pga")) {
        (Some(v), None) => Ok(Scale::Factor(reader.positive(
            v,
            "factor",
            Dimension::NUMBER,
        )?)),
        (None, Some(v)) => Ok(Scale::PeakGroundAcceleration(reader.positive(
            v,
            "pga",
            Dimension::ACCELERATION,
        )?)),
        _ => Err(reader.error(
            value.span(),
            "scale needs `factor` or `pga`, and not both",
            "for example { pga = \"0.35 g\" }",
        )),
    }
}

fn default_analysis() -> Analysis {
    Analysis {
        method: Located {
            value: "adaptive".to_owned(),
            span: 0..0,
        },
        duration: None,
        output_step: 0.01,
        step: None,
        beta: None,
        gamma: None,
        alpha: None,
        relative_tolerance: None,
        energy_tolerance: None,
    }
}

fn analysis(reader: &Reader<'_>, value: &Value<'_>) -> Result<Analysis, CaseError> {
    let table = reader.table(value, "[analysis]", schema::ANALYSIS)?;
    let default = default_analysis();
    Ok(Analysis {
        method: table.optional_text("method")?.unwrap_or(default.method),
        duration: table.optional_positive("duration", Dimension::TIME)?,
        output_step: table
            .optional_positive("output_step", Dimension::TIME)?
            .unwrap_or(default.output_step),
        step: table.optional_positive("step", Dimension::TIME)?,
        beta: table.optional_number("beta")?,
        gamma: table.optional_number("gamma")?,
        alpha: table.optional_number("alpha")?,
        relative_tolerance: table.optional_positive("relative_tolerance", Dimension::NUMBER)?,
        energy_tolerance: table.optional_positive("energy_tolerance", Dimension::NUMBER)?,
    })
}
