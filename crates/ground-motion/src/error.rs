//! What can be wrong with a record.

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
    /// No reader knows the file.
    #[error("{file}: the format of this record is not known")]
    UnknownFormat {
        /// File.
        file: String,
    },
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
    #[error("{file}: {quantity} is {stated} in the file but {given} in the case")]
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
    #[error("{file}:{line}: the header says {expected} samples, the file ends after {found}")]
    TooFewSamples {
        /// File.
        file: String,
        /// Last line, from 1.
        line: usize,
        /// Count in the header.
        expected: usize,
        /// Count found.
        found: usize,
    },
    /// A velocity or displacement series.
    #[error("{file}: the series is a {quantity}, not an acceleration")]
    NotAcceleration {
        /// File.
        file: String,
        /// What it is.
        quantity: &'static str,
    },
    /// A unit that is not one of acceleration.
    #[error("\"{text}\" is not a unit of acceleration{hint}")]
    Unit {
        /// The text.
        text: String,
        /// What it is instead, if known.
        hint: &'static str,
    },
    /// Values that no accelerogram can have.
    #[error("the accelerogram is not usable: {0}")]
    Invalid(String),
}

impl GroundMotionError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        Some(match self {
            Self::Io { .. } => {
                "check the path; it is relative to the folder of the case file".to_owned()
            }
            Self::Parse { remedy, .. } => remedy.clone(),
            Self::UnknownFormat { .. } => {
                "known formats: our CSV layout, PEER AT2, plain columns; for plain columns give `format = \"plain_columns\"`, `unit` and `time_step`".to_owned()
            }
            Self::MissingUnit { .. } => {
                "add `unit = \"g\"` (or m/s2, cm/s2, ...) to [ground_motion]; units are never guessed".to_owned()
            }
            Self::MissingTimeStep { .. } => {
                "add `time_step = \"0.02 s\"` (with the record's step) to [ground_motion]".to_owned()
            }
            Self::Contradiction { quantity, .. } => {
                format!("remove the {quantity} from [ground_motion], or use the right record")
            }
            Self::TooFewSamples { .. } => {
                "the file is probably truncated: get it again, or set `lenient = true` to use what is there".to_owned()
            }
            Self::NotAcceleration { .. } => {
                "use the acceleration file of the same record (AT2 beside VT2 and DT2)".to_owned()
            }
            Self::Unit { .. } => "use g, m/s2, cm/s2, mm/s2, gal, in/s2 or ft/s2".to_owned(),
            Self::Invalid(_) => "check unit, time step and scale of the record".to_owned(),
        })
    }
}
