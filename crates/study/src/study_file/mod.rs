//! The study file: a case, what varies in it, and how it is sampled.

mod annual_frequency;
mod bare_numbers;
mod context;
mod demand_kind;
mod design;
mod distribution;
mod files;
mod hazard_curve;
mod hazard_file;
mod ida;
mod intensity;
mod keys;
mod read;
mod readings;
mod records;
mod rows;
mod trial;
mod values;
mod variables;
mod varied_entry;

use std::path::{Path as FilePath, PathBuf};

pub use demand_kind::DemandKind;
pub use design::{Design, MOST_DIMENSIONS};
pub use distribution::Distribution;
pub use hazard_curve::HazardCurve;
pub use hazard_file::hazard_schema;
pub use ida::{IdaSettings, Limit};
pub(crate) use ida::{POUNDING, pounding_at};
pub use intensity::IntensityMeasure;
pub use pounding_results::study::Value;
pub use read::study_schema;
pub(crate) use readings::Readings;
pub(crate) use records::{beside_that_across, on_grounds_of_their_own};
pub use values::{Spacing, Values};
pub(crate) use varied_entry::VariedEntry;
use varied_entry::{set_all, set_numbers};

use pounding_case::{Case, CaseError};
use pounding_ground_motion::Accelerogram;

use crate::case_text::{Edit, Path};
use crate::error::StudyError;

/// A study: one case, and what varies in it.
#[derive(Debug, Clone)]
pub struct Study {
    /// Title, may be empty.
    pub title: String,
    /// The study file.
    pub file: PathBuf,
    /// Its text.
    pub source: String,
    /// The case that everything is compared with.
    pub base: Case,
    /// What varies, in the order of the file: coordinates of the runs.
    pub variables: Vec<Variable>,
    /// How the variables are sampled.
    pub design: Design,
    /// Runs that are stored at once.
    pub chunk: usize,
    /// Whether the maximum relative displacement of the isolated buildings is wanted.
    pub isolated_demand: bool,
    /// Whether the peaks of the storeys without pounding are wanted, or some of them.
    pub isolated_peaks: bool,
    /// Names of the quantities that are stored; `None`: all.
    pub quantities: Option<Vec<String>>,
    /// Whether quantities are stored as numbers of 32 bits.
    pub float32: bool,
    /// What an incremental dynamic analysis evaluates.
    pub ida: Option<IdaSettings>,
    /// Motions: those of the variable `records`, else the one of the case, as often as variables
    /// say how it is read.
    pub(crate) records: Vec<RecordSource>,
    pub(crate) readings: Readings,
}

/// Something that varies from run to run.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Name of the coordinate in results.
    pub name: String,
    /// What it is, for people.
    pub long_name: String,
    /// Unit of its numbers, in SI; empty for choices.
    pub unit: String,
    /// The values that it takes.
    pub values: Values,
    pub(crate) target: Target,
    /// That its numbers were probably meant in another unit, in words.
    pub(crate) asked: Option<String>,
}

/// What a variable changes.
#[derive(Debug, Clone)]
pub(crate) enum Target {
    /// Entries of the case, which all have the same value, or the same multiple of their own.
    Entries {
        entries: Vec<VariedEntry>,
        /// For choices: the texts as they stand in the study.
        texts: Vec<String>,
    },
    /// The model of gaps with all its options: edits for each choice.
    Model { edits: Vec<Vec<Edit>> },
    /// The motion.
    Record,
    /// The intensity of the motion, by scaling it.
    Intensity(IntensityMeasure),
}

impl Target {
    /// What a value changes in the text of the case, but for that of records.
    pub(crate) fn edits(&self, value: &Value) -> Vec<Edit> {
        match (self, value) {
            (Self::Entries { entries, .. }, Value::Number(x)) => set_numbers(entries, *x),
            (Self::Entries { entries, texts }, Value::Choice(i)) => set_all(entries, &texts[*i]),
            (Self::Model { edits }, Value::Choice(i)) => edits[*i].clone(),
            _ => Vec::new(),
        }
    }

    /// Whether it changes what the case says, but for its motion.
    pub(crate) fn changes_case(&self) -> bool {
        matches!(self, Self::Entries { .. } | Self::Model { .. })
    }

    /// The measure of the intensity that it sets.
    pub(crate) fn measure(&self) -> Option<&IntensityMeasure> {
        match self {
            Self::Intensity(measure) => Some(measure),
            _ => None,
        }
    }

    /// The entries of the case that it changes by numbers or texts.
    pub(crate) fn entries(&self) -> &[VariedEntry] {
        match self {
            Self::Entries { entries, .. } => entries,
            _ => &[],
        }
    }

    /// The paths to these entries.
    pub(crate) fn paths(&self) -> impl Iterator<Item = &Path> + Clone {
        self.entries().iter().map(|varied| &varied.path)
    }
}

/// Where a motion comes from.
#[derive(Debug, Clone)]
pub(crate) struct RecordSource {
    /// Name in results.
    pub name: String,
    pub kind: RecordKind,
    /// Where the study names a file of it that is not there.
    pub missing: Option<Box<CaseError>>,
}

#[derive(Debug, Clone)]
pub(crate) enum RecordKind {
    /// A file, read as this case says; and what makes this case of the base.
    File { case: Box<Case>, edits: Vec<Edit> },
    /// A synthetic motion from a seed.
    Made {
        record: Box<Accelerogram>,
        /// What is to be said of it.
        warnings: Vec<String>,
        /// The command that makes it, but for the file that it goes into.
        command: String,
    },
    /// None: values that say how the record is read make no case together.
    Refused(Box<CaseError>),
}

impl Variable {
    /// Whether it chooses the record.
    pub(crate) fn is_record(&self) -> bool {
        matches!(self.target, Target::Record)
    }

    /// A value of it, in words, without its unit.
    fn without_unit(&self, value: &Value) -> String {
        match (&self.values, value) {
            (Values::Choices(labels), Value::Choice(i)) => {
                format!("{} = {}", self.name, labels[*i])
            }
            (_, Value::Choice(i)) => format!("{} = {i}", self.name),
            (_, Value::Number(x)) => format!("{} = {x}", self.name),
        }
    }

    /// A value of it with its unit, for people.
    pub(crate) fn in_words(&self, value: &Value) -> String {
        match self.unit.as_str() {
            "" | "1" => self.without_unit(value),
            unit => format!("{} {unit}", self.without_unit(value)),
        }
    }

    /// A number (SI) that it takes more than once, but for round-off as of a unit.
    pub(crate) fn repeated(&self) -> Option<f64> {
        let Values::Numbers(numbers) = &self.values else {
            return None;
        };
        let mut sorted = numbers.clone();
        sorted.sort_by(f64::total_cmp);
        let same = |pair: &&[f64]| pair[1] - pair[0] <= 1.0e-9 * pair[1].abs();
        sorted.windows(2).find(same).map(|pair| pair[0])
    }
}

impl Study {
    /// Reads a study and its case.
    ///
    /// # Errors
    /// A file that cannot be read, or all that is wrong in it, with its places. Every
    /// value of every variable is tried in the case alone.
    pub fn read(path: &FilePath) -> Result<Self, StudyError> {
        let source = pounding_case::read_text(path, "study").map_err(|mut error| {
            if !path.is_file() {
                error.help = Some("give the path of a study file (TOML), such as examples/sweep_three_storey_pair/study.toml; docs/reference/studies.md says what stands in it".to_owned());
            }
            StudyError::Text {
                error: Box::new(error),
                source_text: String::new(),
            }
        })?;
        Self::parse(&source, path)
    }

    /// Reads a study from a text; `file` names it and is the base of its paths.
    ///
    /// # Errors
    /// As [`Study::read`].
    pub fn parse(source: &str, file: &FilePath) -> Result<Self, StudyError> {
        read::study(source, file)
    }

    /// What is wrong with the study if files of its records are not there; `None` if all are. Runs
    /// that are to go on all the same, and shards that share records, do without.
    #[must_use]
    pub fn missing_records(&self) -> Option<StudyError> {
        self.missing_of(self.records.iter())
    }

    /// The same of some of its records.
    pub(crate) fn missing_of<'r>(
        &self,
        records: impl Iterator<Item = &'r RecordSource>,
    ) -> Option<StudyError> {
        let missing = records.filter_map(|r| r.missing.as_deref());
        let error = CaseError::of_all(missing.cloned().collect())?;
        Some(StudyError::Text {
            error: Box::new(error),
            source_text: self.source.clone(),
        })
    }

    /// Whether its records take the place of that of the case.
    pub(crate) fn has_records(&self) -> bool {
        self.variables.iter().any(Variable::is_record)
    }

    /// The measure of the intensity to which it scales, if it does.
    pub(crate) fn measure(&self) -> Option<&IntensityMeasure> {
        self.variables.iter().find_map(|v| v.target.measure())
    }

    /// Number of runs.
    #[must_use]
    pub fn runs(&self) -> usize {
        self.design.runs()
    }

    /// Values of all variables in run number `run`, from zero.
    ///
    /// # Panics
    /// A run that the study does not have.
    #[must_use]
    pub fn point(&self, run: usize) -> Vec<Value> {
        let runs = self.runs();
        assert!(run < runs, "run {run} of a study of {runs} runs");
        self.design.point(run, &self.variables)
    }

    /// Name of a choice of a variable, as results show it; empty for one that it does not have.
    ///
    /// # Panics
    /// A variable that the study does not have.
    #[must_use]
    pub fn label(&self, variable: usize, choice: usize) -> &str {
        match &self.variables[variable].values {
            Values::Choices(labels) => labels.get(choice).map_or("", String::as_str),
            _ => "",
        }
    }
}
