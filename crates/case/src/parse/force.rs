//! Forces on floors.

use std::ops::Range;

use pounding_catalogue::wording::counted;
use schemars::JsonSchema;
use serde::Deserialize;

use super::ground_motion::Degrees;
use super::lateral::unit_of;
use super::scale::FilePath;
use crate::document::{
    Count, Cycles, Entry, Field, Force, NotNegative, Number, Optional, Positive, Reader, Signed,
    Time, Written,
};
use crate::located::Located;
use crate::types::{FloorForce, ForceSource};

/// A force on a floor over time, positive to the right
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "[[building.force]]")]
#[schemars(extend("oneOf" = [
    {"required": ["constant"]},
    {"required": ["points"]},
    {"required": ["harmonic"]},
    {"required": ["file"]}
]))]
pub(super) struct ForceTable {
    /// Storey below the floor, from 1
    storey: Field<Count<1>>,
    /// A force (N) that is there from time zero to the end
    constant: Optional<Signed<Force>>,
    /// Times (s) and forces (N), straight lines between them: [["0 s", "0 kN"], ["20 ms", "900
    /// kN"], ...]; two points at one time are a jump
    points: Optional<Vec<Point>>,
    /// A sine wave from time zero on
    harmonic: Optional<HarmonicTable>,
    /// CSV file of times and forces, relative to the folder of the case file
    file: Optional<FilePath>,
    /// Column of the file that holds the force, from 1; by default the one after the times, or
    /// the first where `time_step` is given
    column: Optional<Count<1>>,
    /// Time between lines of a file without times (s); the first line is at time zero
    time_step: Optional<Positive<Time>>,
    /// Unit of the forces of the file; by default that of its header, or N
    unit: Optional<Written>,
    /// Whether the last force of `points` or a file stays; by default there is none after it
    stays: Optional<bool>,
    /// Factor of the force (-), by default 1
    scale: Optional<Signed<Number>>,
    /// Time by which it comes later (s), by default 0
    delay: Optional<NotNegative<Time>>,
}

/// A time and a force.
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(expecting = "a list of a time and a force\nfor example [\"20 ms\", \"900 kN\"]")]
struct Point(NotNegative<Time>, Signed<Force>);

/// A sine wave
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    rename = "harmonic",
    expecting = "a table\nfor example { amplitude = \"60 kN\", frequency = \"2 Hz\", duration = \"10 s\" }"
)]
struct HarmonicTable {
    /// Amplitude (N)
    amplitude: Field<Signed<Force>>,
    /// Frequency (Hz)
    frequency: Field<Positive<Cycles>>,
    /// Phase (degrees), by default 0: a sine
    phase: Optional<Degrees>,
    /// How long it lasts (s)
    duration: Field<Positive<Time>>,
    /// Straight lines of this length (s) stand for it, by default 400 to the cycle
    step: Optional<Positive<Time>>,
}

/// Straight lines to a cycle: the force is met within `(pi / 400)^2 / 2`, 3.1e-5 of the
/// amplitude.
const LINES: f64 = 400.0;
/// The fewest lines to a cycle: the force is met within 5 % of the amplitude.
const FEWEST_LINES: f64 = 10.0;
/// The most straight lines of a harmonic force.
const MOST_LINES: f64 = 2.0e6;

impl ForceTable {
    /// The force on a floor of a building of so many storeys, whose table stands at `place`.
    pub(super) fn read(
        self,
        reader: &Reader<'_>,
        place: Range<usize>,
        storeys: usize,
    ) -> Option<Located<FloorForce>> {
        let storey = self.storey.clone().located()?;
        if storey.value.0 > storeys {
            return reader.refuse(
                storey.span,
                format!(
                    "there is no storey {} in a building of {}",
                    storey.value.0,
                    counted(storeys, "storey")
                ),
                "forces act on the floor above a storey, counted from 1 at the bottom",
            );
        }
        self.fits_its_kind(reader, &place)?;
        let scale = self.scale.clone().number_or(1.0)?;
        let delay = self.delay.clone().number_or(0.0)?;
        let stays = self.stays.clone().value_or(false)?;
        let source = self.source(reader)?;
        Some(Located {
            value: FloorForce {
                storey: storey.value.0 - 1,
                stays: stays || matches!(source, ForceSource::Constant(_)),
                source,
                scale,
                delay,
            },
            span: place,
        })
    }

    /// Refuses none or several of the kinds, and keys that belong to another.
    fn fits_its_kind(&self, reader: &Reader<'_>, place: &Range<usize>) -> Option<()> {
        fn given<T>(key: &'static str, entry: &Optional<T>) -> Option<&'static str> {
            entry.as_ref().map(|_| key)
        }
        let kinds = [
            given("constant", &self.constant),
            given("points", &self.points),
            given("harmonic", &self.harmonic),
            given("file", &self.file),
        ];
        let kinds: Vec<&str> = kinds.into_iter().flatten().collect();
        let kind = match kinds[..] {
            [kind] => kind,
            [] => {
                return reader.refuse(
                    place.clone(),
                    "[[building.force]] does not say what the force is",
                    "add `constant`, `points`, `harmonic` or `file`",
                );
            }
            [one, other, ..] => {
                return reader.refuse(
                    place.clone(),
                    format!("[[building.force]] has either `{one}` or `{other}`, not both"),
                    "forces of several tables on one floor are added",
                );
            }
        };
        let of_file: &[&str] = &["file"];
        let belong = [
            (given("column", &self.column), of_file),
            (given("time_step", &self.time_step), of_file),
            (given("unit", &self.unit), of_file),
            (given("stays", &self.stays), &["points", "file"]),
        ];
        let foreign = belong.into_iter().find_map(|(key, kinds)| {
            let key = key?;
            (!kinds.contains(&kind)).then_some((key, kinds))
        });
        match foreign {
            None => Some(()),
            Some((key, kinds)) => reader.refuse(
                place.clone(),
                format!("`{key}` has no meaning beside `{kind}`"),
                format!("it belongs to `{}`", kinds.join("` and `")),
            ),
        }
    }

    fn source(self, reader: &Reader<'_>) -> Option<ForceSource> {
        if let Some(constant) = self.constant.stated()? {
            return Some(ForceSource::Constant(constant.value.into()));
        }
        let stays = self.stays.clone().value_or(false)?;
        if let Some(points) = self.points.stated()? {
            let numbers = points.value.into_iter();
            let value: Vec<(f64, f64)> = numbers.map(|p| (p.0.into(), p.1.into())).collect();
            let (first, last) = (value.first(), value.last());
            if !stays && first.map(|p| p.0) == last.map(|p| p.0) {
                return reader.refuse(
                    points.span,
                    "points at a single time are a force that lasts no time",
                    "give the time at which the force ends too, or `stays = true`",
                );
            }
            return Some(ForceSource::Points(Located {
                value,
                span: points.span,
            }));
        }
        if let Some(harmonic) = self.harmonic.stated()? {
            return harmonic.value.read(reader, harmonic.span);
        }
        let time_step = self.time_step.stated()?.map(|step| step.value.into());
        let first = if time_step.is_some() { 1 } else { 2 };
        let column = match self.column.stated()? {
            None => None,
            Some(column) if column.value.0 < first => {
                return reader.refuse(
                    column.span,
                    "column 1 holds the times",
                    "give the column of the force, or `time_step` for a file without times",
                );
            }
            Some(column) => Some(column.value.0 - 1),
        };
        let unit = match self.unit.stated()? {
            None => None,
            Some(unit) => Some(unit_of::<Force>(reader, unit)?),
        };
        Some(ForceSource::File {
            file: self.file.located()?.into(),
            column,
            time_step,
            unit,
        })
    }
}

impl HarmonicTable {
    fn read(self, reader: &Reader<'_>, place: Range<usize>) -> Option<ForceSource> {
        let (amplitude, frequency) = (self.amplitude.number(), self.frequency.number());
        let duration = self.duration.number();
        let phase = match self.phase.stated()? {
            None => 0.0,
            Some(phase) => phase.value.0.to_radians(),
        };
        let (amplitude, frequency, duration) = (amplitude?, frequency?, duration?);
        let step = self.step.number_or(1.0 / (LINES * frequency))?;
        if step * frequency * FEWEST_LINES > 1.0 {
            return reader.refuse(
                place,
                format!("straight lines of {step} s do not draw a wave of {frequency} Hz"),
                format!(
                    "give a `step` of at most {} s, or leave it out",
                    1.0 / (FEWEST_LINES * frequency)
                ),
            );
        }
        if duration / step > MOST_LINES {
            return reader.refuse(
                place,
                format!("the force has {:.0} straight lines", duration / step),
                format!(
                    "give a shorter `duration`, or a longer `step`: at most {MOST_LINES} lines"
                ),
            );
        }
        Some(ForceSource::Harmonic {
            amplitude,
            frequency,
            phase,
            duration,
            step,
        })
    }
}
