//! The keys of a case file: one list that the reader checks against and the JSON
//! Schema is made from.

use serde_json::{Map, Value, json};

/// What a key holds.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Kind {
    Text,
    Flag,
    /// A whole number from this on.
    Count(usize),
    /// A number in SI units or a text with unit.
    Quantity,
    /// The same, or a list of them.
    Quantities,
    Names,
    /// A text, or a list of them.
    Texts,
    /// Two different modes, from 1.
    Modes,
    Levels,
    /// Storey numbers.
    Storeys,
    /// A factor, or a table.
    Scale,
    /// A word, or a table that holds one of these sets of keys.
    TextOr(&'static [Key], &'static [&'static [&'static str]]),
    /// A list of tables with one of these keys each.
    Steps(&'static [Key]),
    Table(&'static [Key]),
    Tables(&'static [Key]),
    /// One table, or several.
    TableOrTables(&'static [Key]),
    /// A table that holds one of these sets of keys.
    Choice(&'static [Key], &'static [&'static [&'static str]]),
}

/// A key with what it is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Key {
    pub name: &'static str,
    pub kind: Kind,
    pub required: bool,
    pub explanation: &'static str,
}

const fn key(name: &'static str, kind: Kind, explanation: &'static str) -> Key {
    Key {
        name,
        kind,
        required: false,
        explanation,
    }
}
const fn needed(name: &'static str, kind: Kind, explanation: &'static str) -> Key {
    Key {
        name,
        kind,
        required: true,
        explanation,
    }
}

pub(crate) const CASE: &[Key] = &[
    key("title", Kind::Text, "Title of the case"),
    needed(
        "building",
        Kind::Tables(BUILDING),
        "Buildings, from the left",
    ),
    key(
        "gap",
        Kind::Tables(GAP),
        "Gaps between neighbours, or to a rigid wall",
    ),
    key(
        "link",
        Kind::Tables(LINK),
        "Joints, dampers and bumpers between floors of neighbours",
    ),
    needed(
        "ground_motion",
        Kind::Table(GROUND_MOTION),
        "The recorded motion",
    ),
    key(
        "analysis",
        Kind::Table(ANALYSIS),
        "Method, duration, output",
    ),
    key(
        "separation",
        Kind::Table(SEPARATION),
        "What provisions for the gap need to know",
    ),
];

pub(crate) const SEPARATION: &[Key] = &[
    key(
        "response_modification",
        Kind::Quantities,
        "R, q, Rd Ro, R* or Ra (-), one for all buildings or a list",
    ),
    key(
        "displacement_amplification",
        Kind::Quantities,
        "Cd (-), one for all buildings or a list",
    ),
    key(
        "importance",
        Kind::Quantities,
        "Importance factor (-), one for all buildings or a list",
    ),
    key(
        "yield_amplification",
        Kind::Quantities,
        "alpha_y of the code of Taiwan (-), one for all buildings or a list",
    ),
    key(
        "ductility",
        Kind::Quantities,
        "Ductility (-) for effective period and damping, one for all buildings or a list",
    ),
    key(
        "structural_system",
        Kind::Texts,
        "frame, frame_wall, wall, steel_frame or box_wall, one for all buildings or a list",
    ),
    key(
        "floors_aligned",
        Kind::Flag,
        "Whether all floors face floors; by default found from the elevations",
    ),
    key(
        "same_owner",
        Kind::Flag,
        "Whether no property line lies in the gaps",
    ),
    key(
        "fortification_intensity",
        Kind::Count(1),
        "Fortification intensity of the Chinese code, 6 to 9",
    ),
    key("soil_zone", Kind::Text, "Zone of Mexico City: I, II or III"),
    key(
        "design_ground_acceleration",
        Kind::Quantity,
        "a_g S of Eurocode 8 and NTC (m/s2)",
    ),
    key(
        "seismic_coefficient",
        Kind::Quantity,
        "alpha_h of the Indian code (-)",
    ),
    key(
        "provisions",
        Kind::Texts,
        "Provisions to apply, by default all that apply",
    ),
];

pub(crate) const BUILDING: &[Key] = &[
    needed(
        "name",
        Kind::Text,
        "Name, unique in the case; \"wall\" is reserved",
    ),
    key(
        "storeys",
        Kind::Count(1),
        "Number of storeys, if no list says it",
    ),
    needed(
        "mass",
        Kind::Quantities,
        "Floor mass (kg), one for all storeys or a list, bottom first",
    ),
    needed(
        "stiffness",
        Kind::Quantities,
        "Storey stiffness (N/m), one for all storeys or a list, bottom first",
    ),
    needed(
        "height",
        Kind::Quantities,
        "Storey height (m), one for all storeys or a list, bottom first",
    ),
    key(
        "initial_displacement",
        Kind::Quantities,
        "Floor displacement relative to the ground at time zero (m), one for all floors or a list; by default at rest",
    ),
    key(
        "initial_velocity",
        Kind::Quantities,
        "Floor velocity relative to the ground at time zero (m/s), one for all floors or a list; by default at rest",
    ),
    key(
        "law",
        Kind::TableOrTables(STOREY_LAW),
        "Force-deformation law with memory in the place of the storey stiffness, one for all storeys or a list of laws that name theirs; `pounding hysteresis` lists them",
    ),
    key(
        "p_delta",
        Kind::Flag,
        "Whether gravity acts through the drift: takes weight above over height off every storey stiffness",
    ),
    needed(
        "damping",
        Kind::Choice(DAMPING, DAMPING_KINDS),
        "Viscous damping, one of its kinds",
    ),
];

pub(crate) const DAMPING: &[Key] = &[
    key(
        "ratio",
        Kind::Quantity,
        "Rayleigh: ratio in both `modes` (-)",
    ),
    key("modes", Kind::Modes, "Rayleigh: the two modes, from 1"),
    key("rayleigh", Kind::Table(RAYLEIGH), "C = alpha M + beta K"),
    key(
        "stiffness_proportional",
        Kind::Quantity,
        "Ratio in mode 1 (-)",
    ),
    key("mass_proportional", Kind::Quantity, "Ratio in mode 1 (-)"),
    key(
        "modal",
        Kind::Quantities,
        "Ratio of every mode (-), or one for all",
    ),
    key(
        "dashpots",
        Kind::Quantities,
        "Coefficient of every storey (N s/m), or one for all",
    ),
];

/// The keys of each kind of damping, the first of which names it.
pub(crate) const DAMPING_KINDS: &[&[&str]] = &[
    &["ratio", "modes"],
    &["rayleigh"],
    &["stiffness_proportional"],
    &["mass_proportional"],
    &["modal"],
    &["dashpots"],
];

pub(crate) const RAYLEIGH: &[Key] = &[
    needed("alpha", Kind::Quantity, "Mass factor (1/s)"),
    needed("beta", Kind::Quantity, "Stiffness factor (s)"),
];

pub(crate) const GAP: &[Key] = &[
    key("name", Kind::Text, "Name of the gap, by default left-right"),
    needed(
        "between",
        Kind::Names,
        "Left and right neighbour; \"wall\" is a rigid wall that moves with the ground",
    ),
    needed(
        "width",
        Kind::Quantities,
        "Width at rest (m), one for all levels or a list, bottom first",
    ),
    key(
        "levels",
        Kind::Levels,
        "Pairs of storey numbers that may touch, or \"matching\" for the floors at equal elevation only",
    ),
    key(
        "elevation_tolerance",
        Kind::Quantity,
        "Floors this close in elevation are level (m), by default 0.01; named pairs that are not level are refused",
    ),
    key(
        "floor_to_floor",
        Kind::Flag,
        "Lets named pairs of floors at different elevations act on each other as if they were level, with a warning; by default false",
    ),
    needed("model", Kind::Text, "Impact model, author_year"),
    key(
        "separation",
        Kind::Text,
        "zero_penetration, no_tension, no_tension_latched or gap_shift, where the model offers more than one",
    ),
    key(
        "*",
        Kind::Quantity,
        "Parameters of the model: stiffness (N/m^n), restitution, exponent, ...",
    ),
];

pub(crate) mod ground_motion;
mod laws;

pub(crate) use ground_motion::*;
pub(crate) use laws::{LINK, STOREY_LAW};

pub(crate) const ANALYSIS: &[Key] = &[
    key(
        "method",
        Kind::Text,
        "event_driven (default), adaptive, newmark, hht_alpha, runge_kutta_4, or moreau_jean for rigid impacts",
    ),
    key(
        "duration",
        Kind::Quantity,
        "Duration (s), by default that of the record",
    ),
    key(
        "output_step",
        Kind::Quantity,
        "Step of the responses in the result (s), by default 0.01",
    ),
    key("step", Kind::Quantity, "Step of fixed-step methods (s)"),
    key("beta", Kind::Quantity, "Newmark's beta, by default 1/4"),
    key("gamma", Kind::Quantity, "Newmark's gamma, by default 1/2"),
    key(
        "alpha",
        Kind::Quantity,
        "Alpha of HHT, -1/3 to 0, by default -0.05",
    ),
    key(
        "theta",
        Kind::Quantity,
        "Theta of Moreau and Jean, 1/2 to 1, by default 1/2",
    ),
    key(
        "relative_tolerance",
        Kind::Quantity,
        "Relative tolerance of the adaptive method, and of the event-driven one inside contacts, by default 1e-10",
    ),
    key(
        "energy_tolerance",
        Kind::Quantity,
        "Allowed energy residual over the largest input energy",
    ),
];

/// JSON Schema (2020-12) of a case file: the keys that the reader accepts, with
/// what they are and their units.
#[must_use]
pub fn schema() -> Value {
    let mut schema = object(CASE, "A case of seismic pounding");
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("pounding case");
    schema["$defs"] = json!({
        "quantity": {
            "description": "A number in SI units, or a text with a unit",
            "anyOf": [{"type": "number"}, {"type": "string"}]
        }
    });
    schema
}

fn object(keys: &[Key], description: &str) -> Value {
    let mut properties = Map::new();
    let mut required = Vec::new();
    let mut additional = Value::Bool(false);
    for key in keys {
        let mut value = kind(key.kind, key.explanation);
        value["description"] = json!(key.explanation);
        if key.name == "*" {
            additional = value;
            continue;
        }
        if key.required {
            required.push(key.name);
        }
        properties.insert(key.name.to_owned(), value);
    }
    json!({
        "type": "object",
        "description": description,
        "properties": properties,
        "required": required,
        "additionalProperties": additional,
    })
}

fn kind(kind: Kind, explanation: &str) -> Value {
    let quantity = json!({"$ref": "#/$defs/quantity"});
    match kind {
        Kind::Text => json!({"type": "string"}),
        Kind::Flag => json!({"type": "boolean"}),
        Kind::Count(least) => json!({"type": "integer", "minimum": least}),
        Kind::Quantity => quantity,
        Kind::Quantities => {
            json!({"anyOf": [quantity, {"type": "array", "minItems": 1, "items": quantity}]})
        }
        Kind::Names => {
            json!({"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2})
        }
        Kind::Texts => json!({"anyOf": [
            {"type": "string"},
            {"type": "array", "minItems": 1, "items": {"type": "string"}}
        ]}),
        Kind::Modes => json!({
            "type": "array", "items": {"type": "integer", "minimum": 1},
            "minItems": 2, "maxItems": 2, "uniqueItems": true
        }),
        Kind::Levels => json!({"anyOf": [
            {"const": "matching"},
            {"type": "array", "minItems": 1, "items": {"anyOf": [
                {"type": "integer", "minimum": 1},
                {"type": "array", "items": {"type": "integer", "minimum": 1}, "minItems": 2, "maxItems": 2}
            ]}}
        ]}),
        Kind::Storeys => {
            json!({"type": "array", "minItems": 1, "items": {"type": "integer", "minimum": 1}})
        }
        Kind::TableOrTables(keys) => json!({"anyOf": [
            object(keys, explanation),
            {"type": "array", "minItems": 1, "items": object(keys, explanation)}
        ]}),
        Kind::Scale => json!({"anyOf": [quantity, choice(SCALE, SCALE_KINDS, "Scale")]}),
        Kind::TextOr(keys, sets) => {
            json!({"anyOf": [{"type": "string"}, choice(keys, sets, explanation)]})
        }
        Kind::Steps(keys) => json!({"type": "array", "items": steps(keys)}),
        Kind::Table(keys) => object(keys, explanation),
        Kind::Tables(keys) => json!({"type": "array", "items": object(keys, explanation)}),
        Kind::Choice(keys, sets) => choice(keys, sets, explanation),
    }
}

/// A table with exactly one of the keys.
fn steps(keys: &[Key]) -> Value {
    let mut value = object(keys, "A step of processing");
    value["minProperties"] = json!(1);
    value["maxProperties"] = json!(1);
    value
}

/// An object that holds one of some sets of keys.
fn choice(keys: &[Key], sets: &[&[&str]], description: &str) -> Value {
    let mut value = object(keys, description);
    let sets: Vec<Value> = sets.iter().map(|set| json!({"required": set})).collect();
    value["oneOf"] = json!(sets);
    value
}
