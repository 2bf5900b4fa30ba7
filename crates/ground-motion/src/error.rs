//! What can be wrong with a record.

use pounding_catalogue::DefinitionError;

/// The step of numbers that are options of reading.
pub(crate) const READING: &str = "reading";

/// A record that cannot be read or used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GroundMotionError {
    /// The file cannot be opened or read.
    #[error("cannot read the record {file}: {source}")]
    Io {
        /// File.
        file: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// The text is not of the format.
    #[error("{file}:{line}:{column}: {message}")]
    Parse {
        /// File.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong there.
        message: String,
        /// What to do about it.
        remedy: String,
    },
    /// The bytes are not of the format.
    #[error("{file}: byte {offset}: {message}")]
    Binary {
        /// File.
        file: String,
        /// Offset, from 0.
        offset: usize,
        /// What is wrong there.
        message: String,
    },
    /// Nothing stands in the file.
    #[error("{file}: the file is empty")]
    Empty {
        /// File.
        file: String,
    },
    /// No reader knows the file.
    #[error("{file}: the format of this record is not known")]
    UnknownFormat {
        /// File.
        file: String,
    },
    /// No format of this name.
    #[error(transparent)]
    UnknownFormatName(#[from] DefinitionError),
    /// The unit is not stated in the file and not given.
    #[error("{file}:{line}: the record does not state the unit of its values{hint}")]
    MissingUnit {
        /// File.
        file: String,
        /// Line where the data start, from 1.
        line: usize,
        /// A hint, never a guess.
        hint: String,
    },
    /// The time step is not stated in the file and not given.
    #[error("{file}:{line}: the record does not state its time step")]
    MissingTimeStep {
        /// File.
        file: String,
        /// Line where the data start, from 1.
        line: usize,
    },
    /// File and user disagree.
    #[error("{file}: {quantity} is {stated} in the file but {given} was given")]
    Contradiction {
        /// File.
        file: String,
        /// What they disagree on.
        quantity: &'static str,
        /// In the file.
        stated: String,
        /// From the user.
        given: String,
    },
    /// Fewer samples than the header says.
    #[error(
        "{file}:{line}:{column}: the header says {expected} samples{stated}, the series ends after {found}"
    )]
    TooFewSamples {
        /// File.
        file: String,
        /// Line where they end, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// Count in the header.
        expected: usize,
        /// Count found.
        found: usize,
        /// What the header counts, if not samples, in brackets after a blank.
        stated: String,
    },
    /// A velocity or displacement series.
    #[error("{file}: the series is a {quantity}, not an acceleration")]
    NotAcceleration {
        /// File.
        file: String,
        /// What it is.
        quantity: &'static str,
    },
    /// Several series, of which none is chosen.
    #[error("{file}{}: {} series are possible: {}", place(*line), available.len(), list(available))]
    AmbiguousSeries {
        /// File.
        file: String,
        /// Line that names them, from 1, if one does.
        line: Option<usize>,
        /// What is there.
        available: Vec<String>,
    },
    /// No series of this component.
    #[error(
        "{file}: there is no component \"{component}\" among {}",
        list(available)
    )]
    NoSuchSeries {
        /// File.
        file: String,
        /// Component asked for.
        component: String,
        /// What is there.
        available: Vec<String>,
    },
    /// No series of this quantity.
    #[error("{file}: there is no {quantity} among {}", list(available))]
    NoSuchQuantity {
        /// File.
        file: String,
        /// Quantity asked for.
        quantity: &'static str,
        /// What is there.
        available: Vec<String>,
    },
    /// Samples at uneven times.
    #[error(
        "{file}: the time column is not even: {count} samples, {} s apart on average, {} s to {} s",
        apart(*mean, *smallest, *largest),
        apart(*smallest, *smallest, *largest),
        apart(*largest, *smallest, *largest)
    )]
    Uneven {
        /// File.
        file: String,
        /// Number of samples.
        count: usize,
        /// Mean step (s).
        mean: f64,
        /// Smallest step (s).
        smallest: f64,
        /// Largest step (s).
        largest: f64,
    },
    /// Counts without the instrument's sensitivity.
    #[error("{file}: the record is in counts and does not state how many make 1 m/s2{searched}")]
    MissingSensitivity {
        /// File.
        file: String,
        /// Where it was looked for, and why it was not found; empty if nowhere.
        searched: String,
    },
    /// A file of a known kind that holds no time series to use.
    #[error("{file}: {what}")]
    Unsupported {
        /// File.
        file: String,
        /// What it is.
        what: String,
        /// What to do about it.
        remedy: &'static str,
    },
    /// What an option of reading makes wrong.
    #[error("{error}")]
    OfOption {
        /// The option.
        option: &'static str,
        /// What is wrong.
        error: Box<GroundMotionError>,
    },
    /// A unit that is not one of acceleration.
    #[error("\"{text}\" is not a unit of acceleration{hint}")]
    Unit {
        /// The text.
        text: String,
        /// What it is instead, if known.
        hint: &'static str,
    },
    /// A number of a processing step, a measure or a generator out of its range.
    #[error("{step}: {name} = {} is outside {range}", brief(*value))]
    OutOfRange {
        /// Step, measure or generator.
        step: &'static str,
        /// Number.
        name: &'static str,
        /// Value (SI).
        value: f64,
        /// Allowed range.
        range: String,
    },
    /// Records that cannot be used together.
    #[error("the records do not fit together: {0}")]
    Mismatch(String),
    /// A step that this record does not allow.
    #[error("{step}: {reason}")]
    NotPossible {
        /// Step, measure or generator.
        step: &'static str,
        /// Why.
        reason: String,
        /// What to do about it.
        remedy: &'static str,
    },
    /// A spectrum that was not reached.
    #[error(
        "the spectrum is off by {worst:.4} of the target at {period:.4} s after {iterations} iterations, more than {tolerance}{}",
        at_a_standstill(*.stalled)
    )]
    NotMatched {
        /// Maximum deviation as a part of the target.
        worst: f64,
        /// Period where it is (s).
        period: f64,
        /// Iterations made.
        iterations: usize,
        /// Iterations after which it was nearest.
        best_at: usize,
        /// Whether the method ended by itself: no change that it has brings the motion nearer.
        stalled: bool,
        /// Deviation asked for.
        tolerance: f64,
    },
    /// Work that was not to go on.
    #[error("stopped before the end")]
    Stopped,
    /// Values that no accelerogram can have.
    #[error("the accelerogram is not usable: {0}")]
    Invalid(String),
}

/// What is said of a method that ended before its iterations did.
fn at_a_standstill(stalled: bool) -> &'static str {
    match stalled {
        true => "; the method has stalled: no change that it makes brings the motion nearer",
        false => "",
    }
}

/// `:7` for line 7.
fn place(line: Option<usize>) -> String {
    line.map_or(String::new(), |line| format!(":{line}"))
}

/// The first series of a list; files have had hundreds.
fn list(available: &[String]) -> String {
    let more = if available.len() > 12 { ", ..." } else { "" };
    let shown: Vec<&str> = available.iter().take(12).map(String::as_str).collect();
    format!("{}{more}", shown.join(", "))
}

impl GroundMotionError {
    /// The same, as what an option of reading makes wrong.
    #[must_use]
    pub fn of_option(self, option: &'static str) -> Self {
        Self::OfOption {
            option,
            error: Box::new(self),
        }
    }

    /// The option of reading that makes it, as a case file calls it, if it is one.
    #[must_use]
    pub fn option(&self) -> Option<&'static str> {
        match self {
            Self::OfOption { option, .. } => Some(option),
            Self::NoSuchSeries { .. } | Self::AmbiguousSeries { .. } => Some("component"),
            Self::Contradiction { quantity, .. } => Some(quantity),
            Self::OutOfRange {
                step: READING,
                name,
                ..
            } => Some(name),
            _ => None,
        }
    }
}

/// Refuses what is not finite and above zero.
pub(crate) fn positive(
    step: &'static str,
    name: &'static str,
    value: f64,
) -> Result<f64, GroundMotionError> {
    within(step, name, value, f64::MIN_POSITIVE, f64::MAX)
}

/// Refuses a pair of which the first is not below the second.
pub(crate) fn ascending(
    step: &'static str,
    (first_name, first): (&'static str, f64),
    (last_name, last): (&'static str, f64),
) -> Result<(), GroundMotionError> {
    if first < last {
        return Ok(());
    }
    Err(GroundMotionError::NotPossible {
        step,
        reason: format!(
            "{first_name} = {} is not below {last_name} = {}",
            brief(first),
            brief(last)
        ),
        remedy: "give the smaller one first",
    })
}

/// A number without hundreds of zeros.
fn brief(value: f64) -> String {
    if value == 0.0 || (1.0e-4..1.0e7).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// A bound with six digits: those of products carry noise.
pub(crate) fn bound(value: f64) -> String {
    rounded(value, 6)
}

/// A number with so many digits at most, without an exponent where it is of ordinary size.
pub(crate) fn rounded(value: f64, digits: usize) -> String {
    let after_first = digits.saturating_sub(1);
    brief(format!("{value:.after_first$e}").parse().unwrap_or(value))
}

/// A step (s) between times, with decimals by which the smallest and the largest differ.
fn apart(step: f64, smallest: f64, largest: f64) -> String {
    let decimals = (6..15)
        .find(|decimals| largest - smallest > 10.0_f64.powi(-decimals))
        .unwrap_or(15);
    format!("{step:.*}", decimals as usize)
}

/// Refuses what does not lie in a closed range.
pub(crate) fn within(
    step: &'static str,
    name: &'static str,
    value: f64,
    low: f64,
    high: f64,
) -> Result<f64, GroundMotionError> {
    if value >= low && value <= high {
        return Ok(value);
    }
    Err(GroundMotionError::OutOfRange {
        step,
        name,
        value,
        range: match (low == f64::MIN_POSITIVE, high == f64::MAX) {
            (true, true) => "(0, inf)".to_owned(),
            (true, false) => format!("(0, {}]", bound(high)),
            (false, true) => format!("[{}, inf)", bound(low)),
            (false, false) => format!("[{}, {}]", bound(low), bound(high)),
        },
    })
}
