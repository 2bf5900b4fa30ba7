//! What an incremental dynamic analysis evaluates.

use std::path::{Path, PathBuf};

use pounding_case::{Case, Dimension};

use super::reader::{Reader, Result, Table, Value};
use super::values::numbers;
use super::{IntensityMeasure, hazard_file};

/// A demand whose exceedance is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DemandKind {
    /// Maximum floor displacement (m).
    Displacement,
    /// Maximum drift ratio (-).
    DriftRatio,
    /// Maximum storey shear (N).
    StoreyShear,
    /// Maximum absolute floor acceleration (m/s2).
    AccelerationAbsolute,
    /// Maximum contact force (N).
    ContactForce,
    /// Maximum impulse of one impact (N s).
    Impulse,
    /// Number of impacts.
    Impacts,
    /// Maximum relative displacement of the isolated buildings (m).
    IsolatedDemand,
}

impl DemandKind {
    /// All, with their names in a study.
    pub const ALL: [(Self, &'static str, Dimension); 8] = [
        (Self::Displacement, "displacement", Dimension::LENGTH),
        (Self::DriftRatio, "drift_ratio", Dimension::NUMBER),
        (Self::StoreyShear, "storey_shear", Dimension::FORCE),
        (
            Self::AccelerationAbsolute,
            "acceleration_absolute",
            Dimension::ACCELERATION,
        ),
        (Self::ContactForce, "contact_force", Dimension::FORCE),
        (
            Self::Impulse,
            "impulse",
            Dimension {
                mass: 1.0,
                length: 1.0,
                time: -1.0,
            },
        ),
        (Self::Impacts, "impacts", Dimension::NUMBER),
        (Self::IsolatedDemand, "isolated_demand", Dimension::LENGTH),
    ];
}

/// A state that counts as reached when a demand exceeds a value.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// Name of the state.
    pub name: String,
    /// The demand.
    pub demand: DemandKind,
    /// Index of the building whose storeys count; `None`: all buildings.
    pub building: Option<usize>,
    /// Storey from zero; `None`: the worst storey. For gaps: the level.
    pub place: Option<usize>,
    /// Value that it exceeds (SI).
    pub exceeds: f64,
}

/// Mean annual frequencies with which intensities are exceeded, falling with the
/// intensity; a power law between its points.
#[derive(Debug, Clone, PartialEq)]
pub struct HazardCurve {
    /// Intensity (SI) and mean annual frequency (1/year), intensities rising.
    pub points: Vec<(f64, f64)>,
}

/// The part `[ida]` of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct IdaSettings {
    /// Index of the variable that chooses the record.
    pub record: usize,
    /// Index of the variable that sets the intensity.
    pub intensity: usize,
    /// The measure.
    pub measure: IntensityMeasure,
    /// Gap widths (m) for which the probability of pounding is wanted.
    pub gaps: Vec<f64>,
    /// States beside pounding itself.
    pub limits: Vec<Limit>,
    /// Hazard at the site.
    pub hazard: Option<HazardCurve>,
    /// The file that it stands in, if it has one of its own.
    pub hazard_file: Option<PathBuf>,
    /// Mean annual frequency of pounding that is aimed at (1/year).
    pub target_frequency: Option<f64>,
    /// Confidence of intervals (-).
    pub confidence: f64,
}

const IDA: [&str; 5] = ["gaps", "limit", "hazard", "target_frequency", "confidence"];
const LIMIT: [&str; 6] = ["name", "demand", "building", "storey", "level", "exceeds"];

/// Reads `[ida]`; `record` and `intensity` are the indices of these variables.
pub(super) fn settings(
    reader: &Reader<'_>,
    value: &Value<'_>,
    base: &Case,
    folder: &Path,
    variables: (usize, usize, IntensityMeasure),
) -> Result<IdaSettings> {
    let table = reader.table(value, "[ida]", &IDA)?;
    let (record, intensity, measure) = variables;
    let limits = table.get("limit").map_or(Ok(Vec::new()), |v| {
        let items = reader.list(v, "limit")?;
        reader.all(items.iter().map(|item| limit(reader, item, base)))
    });
    let limits = reader.keep(limits)?;
    let hazard = table
        .get("hazard")
        .map(|v| hazard(reader, v, &measure, folder));
    let hazard = reader.keep(hazard.transpose())?;
    let hazard_file = table
        .get("hazard")
        .and_then(|v| v.get_ref().as_str())
        .map(|name| folder.join(name));
    let per_year = |v: &Value<'_>| reader.positive(v, "target_frequency", Dimension::NUMBER);
    let target_frequency = table.get("target_frequency").map(per_year).transpose();
    let target_frequency = reader.keep(target_frequency)?;
    if let (Some(v), None) = (table.get("target_frequency"), table.get("hazard")) {
        reader.keep(Err::<(), _>(reader.error(
            v.span(),
            "a target frequency needs a hazard curve",
            "add `hazard = [[intensity, frequency], ...]` or the name of a CSV file",
        )))?;
    }
    let confidence = table.get("confidence").map_or(Ok(0.95), |v| {
        let c = reader.positive(v, "confidence", Dimension::NUMBER)?;
        if c < 1.0 {
            return Ok(c);
        }
        Err(reader.error(
            v.span(),
            "`confidence` lies between 0 and 1",
            "for example 0.95",
        ))
    });
    let confidence = reader.keep(confidence)?;
    let gaps = table
        .get("gaps")
        .map_or(Ok(Vec::new()), |v| gaps(reader, v));
    let gaps = reader.keep(gaps)?;
    let (Some(gaps), Some(limits), Some(hazard), Some(target_frequency), Some(confidence)) =
        (gaps, limits, hazard, target_frequency, confidence)
    else {
        return Err(reader.lost());
    };
    Ok(IdaSettings {
        record,
        intensity,
        measure,
        gaps,
        limits,
        hazard,
        hazard_file,
        target_frequency,
        confidence,
    })
}

/// A list of widths, or a table with a range and a count.
fn gaps(reader: &Reader<'_>, value: &Value<'_>) -> Result<Vec<f64>> {
    let positive = |v: &Value<'_>, key: &str| reader.positive(v, key, Dimension::LENGTH);
    if value.get_ref().as_table().is_none() {
        return reader
            .list(value, "gaps")?
            .iter()
            .map(|v| positive(v, "gaps"))
            .collect();
    }
    let keys = ["values", "from", "to", "count", "spacing"];
    let table: Table<'_, '_> = reader.table(value, "gaps", &keys)?;
    let (values, _) = numbers(&table, &positive)?;
    let Some(count) = values.count() else {
        return Err(reader.error(
            value.span(),
            "the range of gaps has no `count`",
            "add `count = ...`",
        ));
    };
    let number = |i| match values.at(i) {
        super::Value::Number(x) => x,
        super::Value::Choice(_) => f64::NAN,
    };
    Ok((0..count).map(number).collect())
}

fn limit(reader: &Reader<'_>, value: &Value<'_>, base: &Case) -> Result<Limit> {
    let table = reader.table(value, "[[ida.limit]]", &LIMIT)?;
    let place = table.required("demand")?;
    let name = reader.text(place, "demand")?;
    let known = DemandKind::ALL.into_iter().find(|(_, n, _)| *n == name);
    let Some((demand, _, dimension)) = known else {
        let names = DemandKind::ALL.map(|(_, n, _)| n);
        return Err(reader.error(
            place.span(),
            format!("unknown demand \"{name}\""),
            format!("known are {}", names.join(", ")),
        ));
    };
    let building = table.get("building").map(|v| {
        let name = reader.text(v, "building")?;
        let at = base.buildings.iter().position(|b| b.name.value == name);
        at.ok_or_else(|| {
            reader.error(
                v.span(),
                format!("the case has no building \"{name}\""),
                "correct the name",
            )
        })
    });
    let building = building.transpose()?;
    table.not_both("building", "level")?;
    table.not_both("storey", "level")?;
    let key = if table.get("level").is_some() {
        "level"
    } else {
        "storey"
    };
    let number = table
        .get(key)
        .map(|v| reader.count(v, key, 1))
        .transpose()?;
    if let (Some(v), Some(n), Some(b)) = (table.get("storey"), number, building) {
        let storeys = base.buildings[b].mass.len();
        if n > storeys {
            return Err(reader.error(
                v.span(),
                format!("the building has no storey {n}"),
                format!("it has {storeys}"),
            ));
        }
    }
    if let (Some(v), None) = (table.get("storey"), building) {
        return Err(reader.error(
            v.span(),
            "a storey of which building?",
            "add `building = \"...\"`",
        ));
    }
    Ok(Limit {
        name: reader.text(table.required("name")?, "name")?,
        demand,
        building,
        place: number.map(|n| n - 1),
        exceeds: reader.positive(table.required("exceeds")?, "exceeds", dimension)?,
    })
}

/// Points, or the name of a CSV file of two columns.
fn hazard(
    reader: &Reader<'_>,
    value: &Value<'_>,
    measure: &IntensityMeasure,
    folder: &Path,
) -> Result<HazardCurve> {
    let wrong = |reason: String| {
        let help = "give intensities (SI, or with a unit) and mean annual frequencies (1/year), intensities rising, frequencies falling";
        reader.error(value.span(), format!("the hazard curve: {reason}"), help)
    };
    let points = match value.get_ref().as_str() {
        Some(name) => hazard_file::read(&folder.join(name), measure).map_err(|refusals| {
            let wrong = refusals.into_iter();
            let wrong = wrong.map(|(m, help)| Err(reader.error(value.span(), m, help)));
            match reader.all::<()>(wrong) {
                Err(e) => e,
                Ok(_) => reader.lost(),
            }
        })?,
        None => {
            let point = |item| match reader.list(item, "hazard")? {
                [a, b] => Ok((
                    reader.positive(a, "hazard", measure.dimension())?,
                    reader.positive(b, "hazard", Dimension::NUMBER)?,
                )),
                _ => Err(wrong("a point is a pair".to_owned())),
            };
            reader.all(reader.list(value, "hazard")?.iter().map(point))?
        }
    };
    HazardCurve::new(points).map_err(|e| wrong(e.to_string()))
}

impl HazardCurve {
    /// A curve through these points.
    ///
    /// # Errors
    /// Fewer than two points, values that are not positive, intensities that do not rise
    /// or frequencies that do not fall.
    pub fn new(points: Vec<(f64, f64)>) -> std::result::Result<Self, crate::StudyError> {
        let wrong = |reason: &str| crate::StudyError::Evaluation {
            what: "hazard curve",
            reason: reason.to_owned(),
        };
        if points.len() < 2 {
            return Err(wrong("it has fewer than two points"));
        }
        if !points
            .iter()
            .all(|(a, b)| *a > 0.0 && *b > 0.0 && a.is_finite() && b.is_finite())
        {
            return Err(wrong("intensities and frequencies must be above zero"));
        }
        if !points
            .windows(2)
            .all(|p| p[0].0 < p[1].0 && p[0].1 > p[1].1)
        {
            return Err(wrong("intensities must rise and frequencies fall"));
        }
        Ok(Self { points })
    }
}
