//! What is done to a record before it is scaled.

use std::borrow::Cow;
use std::marker::PhantomData;
use std::ops::Range;

use pounding_ground_motion::processing::{
    Baseline, Butterworth, Interpolation, OffsetCorrection, Phase, ProcessingStep, SegmentWindow,
    Trim,
};
use pounding_ground_motion::{AccelerationUnit, GroundMotionError};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::scale::{ScaleValue, scale_of};
use crate::document::{
    Acceleration, Count, Cycles, Entry, Field, Kinds, NotNegative, Number, Positive, Reader,
    Signed, TableOr, Time,
};
use crate::error::{CaseError, Errors};
use crate::located::Located;
use crate::types::BandSource;

/// A text that holds nothing but steps.
#[derive(Deserialize)]
#[serde(rename = "the steps")]
struct Steps {
    process: Field<Process>,
}

/// Steps in their order.
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(expecting = "a list of steps")]
pub(super) struct Process(Vec<Field<Step>>);

/// A step of processing
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    rename = "a step of `process`",
    rename_all = "snake_case",
    expecting = "a table\nwrite one table per step: [{ remove_offset = \"mean\" }, { pad = { after = \"10 s\" } }]"
)]
enum Step {
    /// The values, taken as m/s2, are in truth in this unit
    TrueUnit(Located<String>),
    /// "reversed" turns the sign
    Sign(Sign),
    /// Takes "mean", the mean of the time before the event, or a value off all samples
    RemoveOffset(TableOr<Kinds<RemoveTable>, OfAll>),
    /// Butterworth filter: high-pass, low-pass, or both
    Filter(Located<FilterTable>),
    /// Corrects the baseline
    Baseline(Kinds<BaselineTable>),
    /// Keeps a part
    Trim(Kinds<TrimTable>),
    /// Brings the ends to zero by half a cosine
    Taper(Located<TaperTable>),
    /// Puts zeros before and after: after, for free vibration
    Pad(Located<PadTable>),
    /// Changes the time step
    Resample(ResampleTable),
    /// Scales
    Scale(ScaleValue),
}

#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", expecting = "a text in quotes")]
enum Sign {
    Reversed,
}

#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    rename_all = "snake_case",
    expecting = "a text in quotes, or a table\nwrite \"mean\", { pre_event = \"10 s\" } or { value = \"0.1 m/s2\" }"
)]
enum OfAll {
    Mean,
}

#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(untagged)]
enum RemoveTable {
    PreEvent {
        /// Length of the time before the event (s), whose mean is taken off
        pre_event: Positive<Time>,
    },
    Value {
        /// Value to take off (m/s2)
        value: Signed<Acceleration>,
    },
}

#[derive(Clone, Deserialize, JsonSchema)]
struct FilterTable {
    /// High-pass (low-cut) corner (Hz)
    high_pass: Option<Positive<Cycles>>,
    /// Low-pass (high-cut) corner (Hz)
    low_pass: Option<Positive<Cycles>>,
    /// Order of each pass and side, 1 to 12, by default 4
    order: Option<Count<1, { Butterworth::LARGEST_ORDER }>>,
    /// zero (default: forward and backward) or causal (forward)
    phase: Option<PhaseWord>,
    /// Zero phase: whether the zeros put at both ends stay, by default true
    keep_pads: Option<bool>,
}

#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", expecting = "a text in quotes")]
enum PhaseWord {
    Zero,
    Causal,
}

#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(untagged)]
enum BaselineTable {
    Acceleration {
        /// Degree, 0 to 5, of a polynomial that is fitted to the acceleration and taken off
        acceleration: Count<0, 5>,
    },
    Velocity {
        /// Degree, 1 to 5, of a polynomial that is fitted to the velocity, whose derivative
        /// is taken off
        velocity: Count<1, 5>,
    },
    Start {
        /// Two segments: start t1 of the first (s)
        start: NotNegative<Time>,
        /// Two segments: end t2 of the first (s)
        end: NotNegative<Time>,
        /// Two segments: start of the fit (s), by default t2
        fit_from: Option<NotNegative<Time>>,
    },
    Threshold {
        /// Two segments: from the first to the last sample at this acceleration (m/s2)
        threshold: Positive<Acceleration>,
        /// Two segments: start of the fit (s), by default t2
        fit_from: Option<NotNegative<Time>>,
    },
}

#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(untagged)]
enum TrimTable {
    End {
        /// Start (s), by default 0
        start: Option<NotNegative<Time>>,
        /// End (s)
        end: NotNegative<Time>,
    },
    AriasFrom {
        /// Part of the Arias intensity at the start, such as 0.001
        arias_from: Positive<Number>,
        /// Part of the Arias intensity at the end, such as 0.999
        arias_to: Positive<Number>,
    },
}

#[derive(Clone, Deserialize, JsonSchema)]
struct TaperTable {
    /// Length at the start (s)
    start: Option<NotNegative<Time>>,
    /// Length at the end (s)
    end: Option<NotNegative<Time>>,
}

#[derive(Clone, Deserialize, JsonSchema)]
struct PadTable {
    /// Length before (s)
    before: Option<NotNegative<Time>>,
    /// Length after (s)
    after: Option<NotNegative<Time>>,
}

#[derive(Clone, Deserialize, JsonSchema)]
struct ResampleTable {
    /// New time step (s)
    time_step: Positive<Time>,
    /// linear (default) or band_limited
    #[schemars(with = "Option<Words<Interpolation>>")]
    interpolation: Option<Interpolation>,
}

/// Looks in a schema as the words of `T`, without what its library says of each.
struct Words<T>(PhantomData<T>);

impl<T: JsonSchema> JsonSchema for Words<T> {
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let schema = T::json_schema(generator);
        let words = schema.get("oneOf").and_then(|all| all.as_array());
        let words = words.into_iter().flatten().map(|one| &one["const"]);
        json_schema!({"type": "string", "enum": words.collect::<Vec<_>>()})
    }
}

/// Steps of a `process` list with their places.
pub type ProcessSteps = Vec<Located<ProcessingStep<BandSource>>>;

/// Reads a text `process = [...]`, the same list as in a case file: for programs that
/// offer the steps elsewhere; and what is asked about their values. `name` stands in messages.
///
/// # Errors
/// All that is wrong in the text, with its places.
pub fn process_steps(source: &str, name: &str) -> Result<(ProcessSteps, Vec<String>), CaseError> {
    let errors = Errors::default();
    let reader = Reader {
        file: name,
        source,
        errors: &errors,
    };
    let steps = reader.read::<Steps>("write process = [{ remove_offset = \"mean\" }, ...]");
    let steps = steps.and_then(|steps| steps.process.value()?.read(&reader));
    let asked = errors.all_asked();
    errors.finish(Ok((steps.unwrap_or_default(), asked)))
}

impl Process {
    pub(super) fn read(
        self,
        reader: &Reader<'_>,
    ) -> Option<Vec<Located<ProcessingStep<BandSource>>>> {
        let made = |step: Field<Step>| {
            let step = step.located()?;
            Some(Located {
                value: step.value.read(reader, &step.span)?,
                span: step.span,
            })
        };
        let steps: Vec<_> = self.0.into_iter().map(made).collect();
        steps.into_iter().collect()
    }
}

/// A table `step` in which neither of its keys `either` is given.
fn nothing<T>(
    reader: &Reader<'_>,
    place: Range<usize>,
    step: &str,
    either: [&str; 2],
    help: &str,
) -> Option<T> {
    let [first, second] = either;
    let message = format!("`{step}` needs `{first}`, `{second}` or both");
    reader.refuse(place, message, help)
}

impl Step {
    /// The step, which stands at `place`.
    fn read(self, reader: &Reader<'_>, place: &Range<usize>) -> Option<ProcessingStep<BandSource>> {
        let or_zero = |time: Option<NotNegative<Time>>| time.map_or(0.0, f64::from);
        Some(match self {
            Self::TrueUnit(unit) => {
                let unit = unit.value.parse::<AccelerationUnit>();
                let error = |e: GroundMotionError| {
                    reader.error(place.clone(), e.to_string(), e.help().unwrap_or_default())
                };
                ProcessingStep::Unit(reader.errors.keep(unit.map_err(error))?)
            }
            Self::Sign(Sign::Reversed) => ProcessingStep::Sign,
            Self::RemoveOffset(offset) => ProcessingStep::Offset(match offset {
                TableOr::Value(OfAll::Mean) => OffsetCorrection::Mean,
                TableOr::Table(Kinds(RemoveTable::PreEvent { pre_event })) => {
                    OffsetCorrection::PreEventMean(pre_event.into())
                }
                TableOr::Table(Kinds(RemoveTable::Value { value })) => {
                    OffsetCorrection::Value(value.into())
                }
            }),
            Self::Filter(Located { value, span }) => {
                if value.high_pass.is_none() && value.low_pass.is_none() {
                    let help = "for example filter = { high_pass = \"0.1 Hz\", low_pass = \"25 Hz\" }; known keys: high_pass, low_pass, order, phase, keep_pads";
                    let either = ["high_pass", "low_pass"];
                    return nothing(reader, span, "filter", either, help);
                }
                if let (Some(PhaseWord::Causal), Some(_)) = (&value.phase, value.keep_pads) {
                    let message = "`keep_pads` has no meaning beside phase = \"causal\": such a filter puts no zeros at the ends";
                    return reader.refuse(span, message, "remove `keep_pads`");
                }
                ProcessingStep::Filter(Butterworth {
                    order: value.order.map_or(4, |order| order.0),
                    high_pass: value.high_pass.map(f64::from),
                    low_pass: value.low_pass.map(f64::from),
                    phase: match value.phase {
                        Some(PhaseWord::Causal) => Phase::Causal,
                        Some(PhaseWord::Zero) | None => Phase::Zero {
                            keep_pads: value.keep_pads.unwrap_or(true),
                        },
                    },
                })
            }
            Self::Baseline(Kinds(table)) => ProcessingStep::Baseline(table.into()),
            Self::Trim(Kinds(table)) => ProcessingStep::Trim(match table {
                TrimTable::End { start, end } => Trim::Times {
                    start: or_zero(start),
                    end: end.into(),
                },
                TrimTable::AriasFrom {
                    arias_from,
                    arias_to,
                } => Trim::Arias {
                    from: arias_from.into(),
                    to: arias_to.into(),
                },
            }),
            Self::Taper(Located { value, span }) => {
                let (start, end) = (or_zero(value.start), or_zero(value.end));
                if start == 0.0 && end == 0.0 {
                    let help = "for example taper = { start = \"1 s\", end = \"2 s\" }";
                    return nothing(reader, span, "taper", ["start", "end"], help);
                }
                ProcessingStep::Taper { start, end }
            }
            Self::Pad(Located { value, span }) => {
                let (before, after) = (or_zero(value.before), or_zero(value.after));
                if before == 0.0 && after == 0.0 {
                    let help = "for example pad = { after = \"10 s\" }";
                    return nothing(reader, span, "pad", ["before", "after"], help);
                }
                ProcessingStep::Pad { before, after }
            }
            Self::Resample(table) => ProcessingStep::Resample {
                time_step: table.time_step.into(),
                interpolation: table.interpolation.unwrap_or(Interpolation::Linear),
            },
            Self::Scale(scale) => ProcessingStep::Scale(scale_of(reader, scale, place)?),
        })
    }
}

impl From<BaselineTable> for Baseline {
    fn from(table: BaselineTable) -> Self {
        let (window, fit_from) = match table {
            BaselineTable::Acceleration { acceleration } => {
                return Self::Acceleration {
                    degree: acceleration.0,
                };
            }
            BaselineTable::Velocity { velocity } => {
                return Self::Velocity { degree: velocity.0 };
            }
            BaselineTable::Start {
                start,
                end,
                fit_from,
            } => {
                let (start, end) = (start.into(), end.into());
                (SegmentWindow::Times { start, end }, fit_from)
            }
            BaselineTable::Threshold {
                threshold,
                fit_from,
            } => (SegmentWindow::Threshold(threshold.into()), fit_from),
        };
        Self::TwoSegments {
            window,
            fit_from: fit_from.map(f64::from),
        }
    }
}
