//! Why a gap check or a comparison of models could not be made.

use std::path::PathBuf;

use pounding_assembly::AssemblyError;
use pounding_case::CaseError;
use pounding_separation::SeparationError;

/// What keeps a check from an answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckError {
    /// The case is wrong at a place.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// Ended by who watches its progress.
    #[error("stopped before the end: nothing is kept")]
    Stopped,
    /// A record could not be used, or the isolated buildings not integrated under it.
    #[error("record {record}: {source}")]
    Record {
        /// Record.
        record: String,
        /// Why.
        source: Box<AssemblyError>,
    },
    /// Under every record of several a building collapses without contact, so that there is no
    /// demand.
    #[error(
        "under all {records} records a building collapses without contact; record {record}: {source}"
    )]
    AllCollapse {
        /// How many.
        records: usize,
        /// The first of them.
        record: String,
        /// Its collapse.
        source: Box<AssemblyError>,
    },
    /// The run with the gaps' own laws failed under a record, so that models have no
    /// reference.
    #[error("record {record}: the run with the case's own law failed: {diagnosis}")]
    OwnLaw {
        /// Record.
        record: String,
        /// Why.
        diagnosis: String,
    },
    /// A provision that is not known.
    #[error(transparent)]
    Separation(#[from] SeparationError),
    /// A word that is not known, from an argument.
    #[error("{message}")]
    Word {
        /// What is wrong.
        message: String,
        /// What to do.
        help: Option<String>,
    },
    /// The case has no gap.
    #[error("the case has no gap")]
    NoGap,
    /// No gap of this name.
    #[error("the case has no gap \"{name}\"")]
    UnknownGap {
        /// The name asked for.
        name: String,
        /// Gaps of the case.
        known: Vec<String>,
    },
    /// A folder of records that cannot be listed or holds none.
    #[error("no records in {}: {reason}", path.display())]
    NoRecords {
        /// The folder.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// The file of a shard of the check that cannot be used.
    #[error("{path}: {reason}")]
    Shards {
        /// The file.
        path: PathBuf,
        /// Why not.
        reason: String,
    },
    /// The runs of a shard cannot be stored.
    #[error("cannot write {path}: {reason}")]
    Unwritten {
        /// The file.
        path: PathBuf,
        /// What the system said.
        reason: String,
    },
    /// An option out of range.
    #[error("{option} = {value} is out of range: it must be {allowed}")]
    Option {
        /// Option.
        option: &'static str,
        /// How the command line calls it.
        argument: &'static str,
        /// Value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A model that is not known.
    #[error("unknown impact model \"{name}\"")]
    UnknownModel {
        /// The name asked for.
        name: String,
        /// What to do.
        help: String,
    },
    /// The gap's own law does not give what the others are calibrated to.
    #[error("models cannot be calibrated alike: {reason}")]
    Calibration {
        /// Why.
        reason: String,
        /// What to do.
        help: &'static str,
    },
}

impl CheckError {
    /// That of a record that would count twice.
    #[must_use]
    pub fn record_given_twice(name: &dyn std::fmt::Display) -> Self {
        Self::Word {
            message: format!("record {name} is given twice"),
            help: Some("name each record once: it would count twice".to_owned()),
        }
    }

    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Case(error) => error.help.clone(),
            Self::Stopped => None,
            Self::Record { source, .. } | Self::AllCollapse { source, .. } => source.help(),
            Self::Separation(error) => error.help(),
            Self::Word { help, .. } => help.clone(),
            Self::OwnLaw { .. } => Some(
                "`pounding run` of the case under this record says more; another law, gap or method may help"
                    .to_owned(),
            ),
            Self::NoGap => Some("add a [[gap]] to the case".to_owned()),
            Self::UnknownGap { known, .. } => Some(format!("its gaps are {}", known.join(", "))),
            Self::Shards { .. } => Some(
                "make all shards i/n for one n by one build of the program, with the same options, case and records"
                    .to_owned(),
            ),
            Self::Unwritten { .. } => Some(
                "check that the folder exists, may be written to and has room, or name another one by --into"
                    .to_owned(),
            ),
            Self::NoRecords { .. } => Some("name record files, or a folder of them".to_owned()),
            Self::Option {
                argument, allowed, ..
            } => Some(format!("give `{argument}` a value that is {allowed}")),
            Self::UnknownModel { help, .. } => Some(help.clone()),
            Self::Calibration { help, .. } => Some((*help).to_owned()),
        }
    }
}
