//! What can be moved in a case: its widths, laws, masses, stiffnesses and its motion, each with
//! what it is in a line, from the descriptors and from the schema of the case file.

use pounding_case::{Building, Case, Gap, schema};
use pounding_catalogue::numbers::significant;
use pounding_gap_element::{ModelDescriptor, ParameterDescriptor, ParameterUnit, registry};
use pounding_ground_motion::processing::Scale;
use serde::Serialize;
use serde_json::{Value, json};

use crate::answer::Answer;
use crate::explorer::Prepared;

/// Where keys of the case file are explained.
const CASE_FILE: &str = "reference/case-file.md";
/// Where the factor of the motion stands.
const SCALE: &str = "ground_motion.scale";
/// Widest range of a parameter that a slider has as it is.
const WIDEST: f64 = 10.0;
/// Ends of a slider of a quantity without such a range, as parts of its value.
const AROUND: f64 = 30.0;

/// One thing that can be moved.
#[derive(Debug, Clone, Serialize)]
struct Control {
    /// What it is part of.
    group: String,
    /// Its key in the case.
    label: String,
    /// Where it stands in the case.
    path: String,
    /// `number`, `list` of one number a storey, `model`, `record` or `component` of it; `fixed`
    /// for values that the page shows and does not move, `said` for what is no number.
    kind: &'static str,
    /// Unit that it is shown and written in; empty for SI.
    unit: String,
    /// What that unit is in SI.
    factor: f64,
    /// Value in SI, list of values, or name; `null` where the case leaves it out.
    value: Value,
    /// Ends of a slider (SI).
    slider: Option<[f64; 2]>,
    /// Whether equal ways of the slider are equal ratios.
    logarithmic: bool,
    /// Whether the case may leave it out.
    optional: bool,
    /// Value where the case leaves it out (SI).
    default: Option<f64>,
    /// What values are allowed, in words.
    allowed: String,
    /// What it is, in a line.
    explanation: String,
    /// Page of the documentation.
    page: String,
}

/// The controls of a case, and the models that its gaps may have.
pub(crate) fn answer(prepared: &Prepared) -> Answer {
    let case = &prepared.case;
    let mut answer = Answer::default();
    answer.say("title", case.title.as_str());
    answer.say("file", case.file.display().to_string());
    answer.say("controls", json!(controls(case)));
    let models = registry::descriptors().iter().map(|d| model(d));
    answer.say("models", models.collect::<Value>());
    let files = case.named_files();
    let files = files
        .iter()
        .map(|(what, path)| json!([what, path.display().to_string()]));
    answer.say("files", files.collect::<Value>());
    let of_separation = case.separation.warnings();
    let warnings = prepared.assembly.warnings().into_iter();
    let warnings: Vec<_> = warnings.chain(of_separation).collect();
    answer.say("warnings", json!(warnings));
    answer.say("excitation", json!(prepared.assembly.excitation()));
    answer.say("case", case.source.as_str());
    answer
}

fn model(descriptor: &ModelDescriptor) -> Value {
    json!({
        "name": descriptor.name,
        "title": descriptor.title,
        "formula": descriptor.formula,
        "citation": descriptor.citation,
        "class": descriptor.class,
        "verification": descriptor.verification.to_string(),
        "recommended": descriptor.recommended,
        "traps": descriptor.traps,
        "page": page(descriptor),
    })
}

fn page(descriptor: &ModelDescriptor) -> String {
    format!("reference/models/{}.md", descriptor.name)
}

fn controls(case: &Case) -> Vec<Control> {
    let schema = schema();
    let mut controls = Vec::new();
    for (index, gap) in case.gaps.iter().enumerate() {
        controls.extend(of_gap(&schema, index, gap));
    }
    controls.extend(of_motion(&schema, case));
    for (index, building) in case.buildings.iter().enumerate() {
        controls.extend(of_building(&schema, index, building));
    }
    controls
}

/// What the schema of the case file says of a key of a table.
fn explained(schema: &Value, table: &str, key: &str) -> String {
    let table = &schema["properties"][table];
    let properties = [&table["items"]["properties"], &table["properties"]];
    let found = properties
        .iter()
        .find_map(|p| p[key]["description"].as_str());
    found.unwrap_or_default().to_owned()
}

fn of_gap(schema: &Value, index: usize, gap: &Gap) -> Vec<Control> {
    let group = format!("Gap {}", gap.name);
    let path = format!("gap.{index}");
    let mut controls = Vec::new();
    let first = gap.levels.first().map(|level| level.width);
    let same = gap.levels.iter().all(|level| Some(level.width) == first);
    if let Some(width) = first {
        let all: Vec<f64> = gap.levels.iter().map(|level| level.width).collect();
        controls.push(Control {
            group: group.clone(),
            label: "width".to_owned(),
            path: format!("{path}.width"),
            // One slider is of one width.
            kind: if same { "number" } else { "fixed" },
            unit: "mm".to_owned(),
            factor: 1.0e-3,
            value: if same { json!(width) } else { json!(all) },
            slider: same.then_some([0.0, (3.0 * width).max(0.05)]),
            logarithmic: false,
            optional: false,
            default: None,
            allowed: "zero or more".to_owned(),
            explanation: explained(schema, "gap", "width"),
            page: CASE_FILE.to_owned(),
        });
    }
    let descriptor = registry::find(&gap.model.value).ok();
    controls.push(Control {
        group: group.clone(),
        label: "model".to_owned(),
        path: path.clone(),
        kind: "model",
        unit: String::new(),
        factor: 1.0,
        value: json!(descriptor.map_or(gap.model.value.as_str(), |d| d.name)),
        slider: None,
        logarithmic: false,
        optional: false,
        default: None,
        allowed: "one of the impact models".to_owned(),
        explanation: explained(schema, "gap", "model"),
        page: descriptor.map_or_else(|| "reference/models/README.md".to_owned(), page),
    });
    if let Some(descriptor) = descriptor {
        let all = descriptor.parameters.iter();
        controls.extend(all.map(|p| of_parameter(&group, &path, gap, descriptor, p)));
    }
    controls
}

fn of_parameter(
    group: &str,
    path: &str,
    gap: &Gap,
    descriptor: &ModelDescriptor,
    parameter: &ParameterDescriptor,
) -> Control {
    let mut given = gap.parameters.iter();
    let given = given.find(|p| p.key.value == parameter.name);
    let own = given.and_then(|p| Some(p.at(0)?.value.value));
    let value = own.or(parameter.default);
    // One slider is of one value.
    let of_levels = given.filter(|p| !p.is_one());
    let of_levels: Option<Vec<f64>> =
        of_levels.map(|p| p.values.iter().map(|given| given.value.value).collect());
    let [low, high] = [parameter.minimum.0, parameter.maximum.0];
    // A range that is there to catch mistakes is too wide for a slider.
    let bounded = high - low <= WIDEST;
    let slider = match value {
        _ if bounded => {
            // Ends that are not allowed themselves are left out.
            let little = 1.0e-3 * (high - low);
            let low = if parameter.minimum.1 {
                low
            } else {
                low + little
            };
            let high = if parameter.maximum.1 {
                high
            } else {
                high - little
            };
            Some([low, high])
        }
        Some(value) if value > 0.0 => Some([value / AROUND, (value * AROUND).min(high)]),
        _ => None,
    };
    let symbol = match parameter.unit {
        ParameterUnit::One => "",
        unit => descriptor.unit_symbol(unit),
    };
    Control {
        group: group.to_owned(),
        label: parameter.name.to_owned(),
        path: format!("{path}.{}", parameter.name),
        kind: if of_levels.is_some() {
            "fixed"
        } else {
            "number"
        },
        // With a free exponent the unit depends on another value: plain numbers are SI.
        unit: String::new(),
        factor: 1.0,
        value: of_levels.as_ref().map_or(json!(value), |all| json!(all)),
        slider: slider.filter(|_| of_levels.is_none()),
        logarithmic: !bounded,
        optional: !parameter.required,
        default: parameter.default,
        allowed: match symbol {
            "" => parameter.range(),
            symbol => format!("{} {symbol}", parameter.range()),
        },
        explanation: parameter.explanation.to_owned(),
        page: page(descriptor),
    }
}

fn of_motion(schema: &Value, case: &Case) -> Vec<Control> {
    let group = "Ground motion".to_owned();
    let file = &case.ground_motion.file.value;
    let across = case.ground_motion.across.as_ref();
    let stays = across.map_or_else(String::new, |across| {
        let file = across.value.file.value.display();
        format!("; the record across the row, {file}, stays")
    });
    let record = Control {
        group: group.clone(),
        label: "file".to_owned(),
        path: "ground_motion".to_owned(),
        kind: "record",
        unit: String::new(),
        factor: 1.0,
        value: json!(file.display().to_string()),
        slider: None,
        logarithmic: false,
        optional: false,
        default: None,
        allowed: format!("a record in the page, or one dropped on it{stays}"),
        explanation: explained(schema, "ground_motion", "file"),
        page: "reference/ground-motions.md".to_owned(),
    };
    let scale = |label: &str, path: &str, unit: (&str, f64), value: f64| Control {
        group: group.clone(),
        label: label.to_owned(),
        path: path.to_owned(),
        kind: "number",
        unit: unit.0.to_owned(),
        factor: unit.1,
        value: json!(value),
        slider: Some([value / 10.0, value * 5.0]),
        logarithmic: true,
        optional: path == SCALE,
        default: (path == SCALE).then_some(1.0),
        allowed: "greater than zero".to_owned(),
        explanation: explained(schema, "ground_motion", "scale"),
        page: CASE_FILE.to_owned(),
    };
    let given = case.ground_motion.scale.as_ref().map(|scale| &scale.value);
    let gravity = pounding_catalogue::STANDARD_GRAVITY;
    let scale = match given {
        None => Some(scale("scale", SCALE, ("", 1.0), 1.0)),
        Some(Scale::Factor(x)) => Some(scale("scale", SCALE, ("", 1.0), *x)),
        Some(Scale::PeakAcceleration(x)) => {
            let path = "ground_motion.scale.pga";
            Some(scale("scale: pga", path, ("g", gravity), *x))
        }
        Some(Scale::PeakVelocity(x)) => {
            let path = "ground_motion.scale.pgv";
            Some(scale("scale: pgv", path, ("m/s", 1.0), *x))
        }
        Some(Scale::SpectralAcceleration { target, period, .. }) => {
            let label = format!("scale: psa at {} s", significant(*period));
            let path = "ground_motion.scale.psa";
            Some(scale(&label, path, ("g", gravity), *target))
        }
        // Nearest to a spectrum is no number: it stays as the case says it.
        Some(Scale::Band(_)) => Some(Control {
            kind: "said",
            value: json!("nearest to a spectrum over a band of periods"),
            slider: None,
            logarithmic: false,
            ..scale("scale", "ground_motion.scale", ("", 1.0), 1.0)
        }),
    };
    let component = case.ground_motion.component.as_ref();
    // A motion that is turned needs both.
    let component = component.filter(|_| case.ground_motion.rotation.is_none());
    let component = component.map(|component| Control {
        label: "component".to_owned(),
        path: "ground_motion.component".to_owned(),
        kind: "component",
        value: json!(component),
        allowed: "one that the record has".to_owned(),
        explanation: explained(schema, "ground_motion", "component"),
        ..record.clone()
    });
    std::iter::once(record)
        .chain(component)
        .chain(scale)
        .collect()
}

fn of_building(schema: &Value, index: usize, building: &Building) -> Vec<Control> {
    let list = |label: &str, unit: (&str, f64), values: &[f64]| Control {
        group: format!("Building {}", building.name.value),
        label: label.to_owned(),
        path: format!("building.{index}.{label}"),
        kind: "list",
        unit: unit.0.to_owned(),
        factor: unit.1,
        value: json!(values),
        slider: Some([0.25, 4.0]),
        logarithmic: true,
        optional: false,
        default: None,
        allowed: "greater than zero".to_owned(),
        explanation: explained(schema, "building", label),
        page: CASE_FILE.to_owned(),
    };
    let mut controls = vec![list("mass", ("t", 1.0e3), &building.mass)];
    let chain = building.lateral.is_none() && building.plan.is_none();
    if chain && !building.stiffness.is_empty() {
        controls.push(list("stiffness", ("MN/m", 1.0e6), &building.stiffness));
    }
    controls
}
