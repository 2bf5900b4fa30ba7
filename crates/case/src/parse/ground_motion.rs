//! The record of a case.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::PathBuf;

use pounding_ground_motion::Offset;
use schemars::transform::{RecursiveTransform, Transform};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::process::Process;
use super::scale::{FilePath, ScaleValue, scale_of};
use crate::document::{
    Acceleration, Count, Dimensioned, Entry, Fault, Field, Length, NotNegative, Optional, Positive,
    Reader, TableOr, Time, Velocity, Written,
};
use crate::located::Located;
use crate::types::{BuildingGround, GroundMotion, Rotation};
use crate::units::{Dimension, Quantity, parse_degrees};

/// The recorded motion
#[derive(Clone, Default, Deserialize, JsonSchema)]
#[serde(rename = "[ground_motion]")]
pub(super) struct MotionTable {
    /// Record, relative to the folder of the case file
    file: Field<FilePath>,
    /// Name of the format, such as peer_at2 or plain_columns; found from the content by
    /// default
    format: Optional<String>,
    /// Time step (s), for files that do not state it, and for uneven times
    time_step: Optional<Positive<Time>>,
    /// Unit of the values, for files that do not state it
    unit: Optional<String>,
    /// Plain columns: "a", or names such as "t,ns,ew"
    layout: Optional<String>,
    /// Component to use: its name in the file, its azimuth, or its channel number
    component: Optional<String>,
    /// The other component of the file, for `rotate`
    second_component: Optional<String>,
    /// Angle (degrees, a plain number) by which two components at right angles are turned,
    /// first towards second; the first is used
    rotate: Optional<Degrees>,
    /// The record across the row, for buildings that turn in plan: its file, or a table with the
    /// file and what else is to be said of it
    #[schemars(transform = one_record)]
    across: Optional<TableOr<GroundTable, FilePath>>,
    /// acceleration, the only quantity that excites buildings
    quantity: Optional<String>,
    /// Plain columns: lines to skip at the start
    skip_lines: Optional<Count<0>>,
    /// Plain columns: characters to skip at the start of each line
    skip_columns: Optional<Count<0>>,
    /// The first value is at one time step, after a zero
    prepend_zero: Optional<bool>,
    /// Use samples that contradict the header's count, duration, step or peak, with a warning
    lenient: Optional<bool>,
    /// Counts per m/s2 of the whole channel, for records in counts
    sensitivity: Optional<Positive<Sensitivity>>,
    /// StationXML with the sensitivities of a miniSEED record, relative to the folder of the case
    /// file; by default one that lies beside the record
    response: Optional<FilePath>,
    /// The g (m/s2) of records in units of gravity, by default 9.80665
    gravity: Optional<Positive<Acceleration>>,
    /// What becomes of the mean: automatic (taken off raw records, kept in corrected ones),
    /// keep or remove
    offset: Optional<Offset>,
    /// What is done to the record, in this order, before it is scaled
    process: Optional<Process>,
    /// A factor, or a table such as { pga = "0.35 g" }
    scale: Optional<ScaleValue>,
}

/// How the ground under one building moves
#[derive(Clone, Default, Deserialize, JsonSchema)]
#[serde(
    rename = "ground",
    expecting = "a table\nfor example { delay = \"0.13 s\" }, or { distance = \"60 m\", wave_speed = \"460 m/s\" }"
)]
pub(super) struct GroundTable {
    /// Time by which it moves later than the others (s)
    delay: Optional<NotNegative<Time>>,
    /// Distance from where the motion arrives first (m), for `wave_speed`
    distance: Optional<NotNegative<Length>>,
    /// Apparent speed of the waves along the row (m/s)
    wave_speed: Optional<Positive<Velocity>>,
    /// A record of its own, relative to the folder of the case file; by default that of the
    /// table ground_motion
    file: Optional<FilePath>,
    /// Name of its format; found from the content by default
    format: Optional<String>,
    /// Time step (s), for files that do not state it
    time_step: Optional<Positive<Time>>,
    /// Unit of the values, for files that do not state it
    unit: Optional<String>,
    /// Component to use: its name in the file, its azimuth, or its channel number
    component: Optional<String>,
    /// The other component of the file, for `rotate`
    second_component: Optional<String>,
    /// Angle (degrees, a plain number) by which two components at right angles are turned,
    /// first towards second; the first is used
    rotate: Optional<Degrees>,
    /// What is done to this record, in this order, before it is scaled
    process: Optional<Process>,
    /// A factor for this record, or a table such as { pga = "0.35 g" }
    scale: Optional<ScaleValue>,
}

impl GroundTable {
    /// The motion under a building; refuses keys that say nothing together.
    pub(super) fn read(self, reader: &Reader<'_>, place: &Range<usize>) -> Option<BuildingGround> {
        let by_wave = match (&self.distance, &self.wave_speed) {
            (None, None) => None,
            (Some(_), Some(_)) => Some((self.distance.number()?, self.wave_speed.number()?)),
            (one, _) => {
                let missing = if one.is_some() {
                    "wave_speed"
                } else {
                    "distance"
                };
                return reader.refuse(
                    place.clone(),
                    format!("`ground` has no `{missing}`"),
                    "give both `distance` and `wave_speed`, or a `delay`",
                );
            }
        };
        if by_wave.is_some() && self.delay.is_some() {
            return reader.refuse(
                place.clone(),
                "`ground` has either `delay` or `distance` and `wave_speed`, not both",
                "leave one of them out",
            );
        }
        let by_wave_speed = by_wave.is_some();
        let delay = match by_wave {
            Some((distance, speed)) => distance / speed,
            None if self.delay.is_some() => self.delay.number()?,
            None => 0.0,
        };
        let of_record = [
            ("format", self.format.is_some()),
            ("time_step", self.time_step.is_some()),
            ("unit", self.unit.is_some()),
            ("component", self.component.is_some()),
            ("second_component", self.second_component.is_some()),
            ("rotate", self.rotate.is_some()),
            ("process", self.process.is_some()),
            ("scale", self.scale.is_some()),
        ];
        let Some(file) = self.file else {
            if let Some((key, _)) = of_record.iter().find(|(_, given)| *given) {
                return reader.refuse(
                    place.clone(),
                    format!("`{key}` in `ground` belongs to a record, and there is no `file`"),
                    "add `file = ...`, or leave it out: without a file the record of [ground_motion] moves this building, too",
                );
            }
            return Some(BuildingGround {
                delay,
                by_wave_speed,
                motion: None,
            });
        };
        let table = MotionTable {
            file,
            format: self.format,
            time_step: self.time_step,
            unit: self.unit,
            component: self.component,
            second_component: self.second_component,
            rotate: self.rotate,
            process: self.process,
            scale: self.scale,
            ..MotionTable::default()
        };
        Some(BuildingGround {
            delay,
            by_wave_speed,
            motion: Some(table.read(reader)),
        })
    }
}

/// JSON Schema of the table `[ground_motion]` of a case, for files whose records have its keys.
pub fn ground_motion_schema(generator: &mut SchemaGenerator) -> Schema {
    MotionTable::json_schema(generator)
}

/// Counts per m/s2.
#[derive(Clone)]
struct Sensitivity;

impl Dimensioned for Sensitivity {
    const DIMENSION: Dimension = Dimension {
        mass: 0.0,
        length: -1.0,
        time: 2.0,
    };
}

/// How a turn is written.
const TURN: &str =
    "for example component = \"360\", second_component = \"90\", rotate = 30, in degrees";

/// An angle in degrees, `30` or `"30 deg"`.
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(try_from = "Written")]
pub(super) struct Degrees(pub(super) f64);

impl TryFrom<Written> for Degrees {
    type Error = Fault;
    fn try_from(written: Written) -> Result<Self, Fault> {
        let is_plain = written.is_plain();
        if let Some(degrees) = parse_degrees(written.as_written()) {
            return Ok(Self(degrees));
        }
        match written.any() {
            Ok(Quantity {
                value,
                dimension: None,
                ..
            }) => Ok(Self(value)),
            Err(fault) if is_plain => Err(fault),
            _ => Err(Fault::new(
                " is a number of degrees",
                "for example 30, or \"30 deg\"",
            )),
        }
    }
}

impl MotionTable {
    /// The motion; of a table that could not be read, one without file.
    pub(super) fn read(self, reader: &Reader<'_>) -> GroundMotion {
        let flag = |given: Optional<bool>| given.value().unwrap_or_default();
        let count = |given: Optional<Count<0>>| given.value().map_or(0, |count| count.0);
        let no_file = || Located {
            value: PathBuf::new(),
            span: 0..0,
        };
        let places = self.places();
        GroundMotion {
            file: self.file.located().map_or_else(no_file, Located::from),
            format: self.format.located(),
            time_step: self.time_step.number(),
            unit: self.unit.located(),
            layout: self.layout.value(),
            component: self.component.value(),
            rotation: rotation(reader, self.second_component, self.rotate),
            across: self
                .across
                .located()
                .and_then(|given| across(reader, given)),
            quantity: self.quantity.located(),
            skip_lines: count(self.skip_lines),
            skip_columns: count(self.skip_columns),
            prepend_zero: flag(self.prepend_zero),
            lenient: flag(self.lenient),
            sensitivity: self.sensitivity.number(),
            response: self.response.located().map(Located::from),
            gravity: self.gravity.number(),
            offset: self.offset.value().unwrap_or_default(),
            process: self
                .process
                .value()
                .and_then(|steps| steps.read(reader))
                .unwrap_or_default(),
            scale: self.scale.located().and_then(|scale| {
                Some(Located {
                    value: scale_of(reader, scale.value, &scale.span)?,
                    span: scale.span,
                })
            }),
            places,
        }
    }

    /// Where the values of the keys that say how to read the record stand.
    fn places(&self) -> BTreeMap<&'static str, Range<usize>> {
        let given = [
            ("format", self.format.span()),
            ("time_step", self.time_step.span()),
            ("unit", self.unit.span()),
            ("layout", self.layout.span()),
            ("component", self.component.span()),
            ("second_component", self.second_component.span()),
            ("rotate", self.rotate.span()),
            ("quantity", self.quantity.span()),
            ("skip_lines", self.skip_lines.span()),
            ("skip_columns", self.skip_columns.span()),
            ("sensitivity", self.sensitivity.span()),
            ("gravity", self.gravity.span()),
        ];
        let place = |(key, span): (_, Option<_>)| Some((key, span?));
        given.into_iter().filter_map(place).collect()
    }
}

/// Takes out of the schema of `across` what only the ground under a building has.
fn one_record(schema: &mut Schema) {
    let of_table = |form: &mut Schema| {
        let keys = form
            .get_mut("properties")
            .and_then(|keys| keys.as_object_mut());
        // That of the table alone, and none of its steps and scales.
        let Some(keys) = keys.filter(|keys| keys.contains_key("wave_speed")) else {
            return;
        };
        keys.retain(|key, _| !["delay", "distance", "wave_speed"].contains(&key.as_str()));
        form.insert(
            "description".into(),
            "A record, with what is to be said of it".into(),
        );
        form.insert("required".into(), ["file"].as_slice().into());
    };
    RecursiveTransform(of_table).transform(schema);
}

/// The record across the row.
fn across(
    reader: &Reader<'_>,
    given: Located<TableOr<GroundTable, FilePath>>,
) -> Option<Located<Box<GroundMotion>>> {
    let span = given.span;
    let table = match given.value {
        TableOr::Table(table) => table,
        TableOr::Value(value) => GroundTable {
            file: Some(Field::Given(Located {
                value,
                span: span.clone(),
            })),
            ..GroundTable::default()
        },
    };
    match table.read(reader, &span)? {
        BuildingGround {
            delay: 0.0,
            motion: Some(motion),
            ..
        } => Some(Located {
            value: Box::new(motion),
            span,
        }),
        _ => reader.refuse(
            span,
            "`across` is a record of its own, without a delay",
            "write across = \"...\", the file, or across = { file = \"...\", scale = ... }; a delay stands in `ground` of a building, for both components",
        ),
    }
}

fn rotation(
    reader: &Reader<'_>,
    second: Optional<String>,
    rotate: Optional<Degrees>,
) -> Option<Rotation> {
    let (second, rotate) = match (second, rotate) {
        (Some(second), Some(rotate)) => (second.located()?, rotate.value()?),
        (second, rotate) => {
            return reader.refuse(
                second.span().or(rotate.span())?,
                "`rotate` and `second_component` belong together",
                TURN,
            );
        }
    };
    Some(Rotation {
        second_component: second,
        angle: rotate.0,
    })
}
