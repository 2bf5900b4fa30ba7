//! What an incremental dynamic analysis evaluates.

use std::path::{Path, PathBuf};

use pounding_case::Dimension;

use super::context::Context;
use super::reader::{Reader, Result, Table, Value, Wrong};
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

/// Reads `[ida]`; `variables` are the indices of record and intensity, whose measure this is.
pub(super) fn settings(
    reader: &Reader<'_>,
    value: &Value<'_>,
    context: &Context<'_>,
    variables: Option<(usize, usize)>,
    measure: Option<IntensityMeasure>,
) -> Result<IdaSettings> {
    let table = reader.table(value, "[ida]", &IDA)?;
    let limits = table.or("limit", Vec::new(), |v| {
        let items = reader.list(v, "limit")?;
        reader.all(items.iter().map(|item| limit(reader, item, context)))
    });
    let limits = reader.keep(limits);
    let hazard = table.or("hazard", None, |v| {
        hazard(reader, v, measure.as_ref(), context.folder).map(Some)
    });
    let hazard = reader.keep(hazard);
    let hazard_file = table
        .get("hazard")
        .and_then(|v| v.get_ref().as_str())
        .map(|name| context.folder.join(name));
    let target_frequency = table.optional("target_frequency", |v| {
        reader.positive(v, "target_frequency", Dimension::NUMBER)
    });
    let no_hazard = table.get("hazard").is_none() && !table.lacks("hazard");
    if let (Some(v), true) = (table.get("target_frequency"), no_hazard) {
        reader.check(Err(reader.error(
            v.span(),
            "a target frequency needs a hazard curve",
            "add `hazard = [[intensity, frequency], ...]` or the name of a CSV file",
        )));
    }
    let confidence = table.or("confidence", 0.95, |v| {
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
    let confidence = reader.keep(confidence);
    let gaps = reader.keep(table.or("gaps", Vec::new(), |v| gaps(reader, v)));
    let (Some(gaps), Some(limits), Some(hazard), Some(confidence), Some(measure)) =
        (gaps, limits, hazard, confidence, measure)
    else {
        return Err(Wrong::Recorded);
    };
    let (record, intensity) = variables.ok_or(Wrong::Recorded)?;
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
        let items = reader.list(value, "gaps")?;
        return reader.all(items.iter().map(|v| positive(v, "gaps")));
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

fn limit(reader: &Reader<'_>, value: &Value<'_>, context: &Context<'_>) -> Result<Limit> {
    let table = reader.table(value, "[[ida.limit]]", &LIMIT)?;
    let name = table.required("name").and_then(|v| reader.text(v, "name"));
    let name = reader.keep(name);
    let demand = reader.keep(demand(&table));
    let exceeds = table.required("exceeds").and_then(|v| match demand {
        Some((_, dimension)) => reader.positive(v, "exceeds", dimension),
        None => Ok(reader.any_quantity(v, "exceeds")?.value),
    });
    let exceeds = reader.keep(exceeds);
    let building = table.or("building", None, |v| context.building(reader, v).map(Some));
    let building = reader.keep(building);
    table.not_both("building", "level")?;
    table.not_both("storey", "level")?;
    let count = |key| table.or(key, None, |v| reader.count(v, key, 1).map(Some));
    let storey = reader.keep(count("storey"));
    let level = reader.keep(count("level"));
    let (Some(building), Some(storey), Some(level)) = (building, storey, level) else {
        return Err(Wrong::Recorded);
    };
    if let Some(v) = table.get("storey") {
        match (storey, building) {
            (Some(n), Some(b)) => {
                let storeys = context.base()?.case.buildings[b].mass.len();
                if n > storeys {
                    return Err(reader.error(
                        v.span(),
                        format!("the building has no storey {n}"),
                        format!("it has {storeys}"),
                    ));
                }
            }
            _ if table.lacks("building") => {}
            _ => {
                return Err(reader.error(
                    v.span(),
                    "a storey of which building?",
                    "add `building = \"...\"`",
                ));
            }
        }
    }
    let (name, (demand, _), exceeds) = match (name, demand, exceeds) {
        (Some(name), Some(demand), Some(exceeds)) => (name, demand, exceeds),
        _ => return Err(Wrong::Recorded),
    };
    Ok(Limit {
        name,
        demand,
        building,
        place: storey.or(level).map(|n| n - 1),
        exceeds,
    })
}

/// The demand of a limit, and its dimension.
fn demand(table: &Table<'_, '_>) -> Result<(DemandKind, Dimension)> {
    let reader = table.reader;
    let place = table.required("demand")?;
    let name = reader.text(place, "demand")?;
    let known = DemandKind::ALL.into_iter().find(|(_, n, _)| *n == name);
    known
        .map(|(demand, _, dimension)| (demand, dimension))
        .ok_or_else(|| {
            let names = DemandKind::ALL.map(|(_, n, _)| n);
            reader.error(
                place.span(),
                format!("unknown demand \"{name}\""),
                format!("known are {}", names.join(", ")),
            )
        })
}

/// Points, or the name of a CSV file of two columns.
fn hazard(
    reader: &Reader<'_>,
    value: &Value<'_>,
    measure: Option<&IntensityMeasure>,
    folder: &Path,
) -> Result<HazardCurve> {
    let wrong = |reason: String| {
        let help = "give intensities (SI, or with a unit) and mean annual frequencies (1/year), intensities rising, frequencies falling";
        reader.error(value.span(), format!("the hazard curve: {reason}"), help)
    };
    let refused = |refusals: Vec<hazard_file::Refusal>| {
        for (message, help) in refusals {
            reader.check(Err(reader.error(value.span(), message, help)));
        }
        Wrong::Recorded
    };
    let points = match value.get_ref().as_str() {
        Some(name) => {
            let text = hazard_file::text(&folder.join(name)).map_err(refused)?;
            let measure = measure.ok_or(Wrong::Recorded)?;
            hazard_file::points(&folder.join(name), &text, measure).map_err(refused)?
        }
        None => {
            let intensity = |v| match measure {
                Some(measure) => reader.positive(v, "hazard", measure.dimension()),
                None => Ok(reader.any_quantity(v, "hazard")?.value),
            };
            let point = |item| match reader.list(item, "hazard")? {
                [a, b] => {
                    let frequency = reader.positive(b, "hazard", Dimension::NUMBER);
                    let point = reader.keep(intensity(a)).zip(reader.keep(frequency));
                    point.ok_or(Wrong::Recorded)
                }
                _ => Err(wrong("a point is a pair".to_owned())),
            };
            reader.all(reader.list(value, "hazard")?.iter().map(point))?
        }
    };
    measure.ok_or(Wrong::Recorded)?;
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
