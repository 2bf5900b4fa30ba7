//! What a study file is read against: its case, as far as that is sound.

use std::cell::RefCell;
use std::ops::Range;
use std::path::PathBuf;

use pounding_case::document::Reader;
use pounding_case::{Case, CaseError, Located};

use crate::case_text::building_names;
use crate::error::StudyError;

/// A case that can be assembled.
pub(super) struct Base {
    pub case: Case,
    /// Fundamental period of each building along the row (s).
    pub fundamental_periods: Vec<f64>,
    /// Names of the contact levels of all gaps, in the order of results.
    pub levels: Vec<String>,
    /// Whether impacts at each of them are rigid.
    pub rigid: Vec<bool>,
    /// Laws of storeys, and of frames in them.
    pub laws: Vec<LawOfStorey>,
}

/// A law of a storey, isolators among them, or of a frame in it.
pub(super) struct LawOfStorey {
    /// Number of the building, from zero.
    pub building: usize,
    /// From zero.
    pub storey: usize,
    /// Whether it has a yield force.
    pub yields: bool,
}

/// What is known of the case.
#[derive(Default)]
pub(super) struct Context {
    /// The case; `None` where something is wrong with it.
    pub base: Option<Base>,
    /// Its text, if it is TOML.
    pub text: Option<String>,
    /// What is wrong with it.
    pub wrong: Option<StudyError>,
    /// Folder of the study.
    pub folder: PathBuf,
    /// Whether the values of variables go together, a row of a list each.
    pub in_rows: bool,
    /// Where values stand that the case refuses alone, which with others of their rows it may take.
    pub refused_alone: RefCell<Vec<Range<usize>>>,
    /// Files of records that are not there, which is no error where a run may do without.
    pub missing: RefCell<Vec<CaseError>>,
}

impl Context {
    /// Index of the building of this name; `None` after recording that there is none.
    pub(super) fn building(&self, reader: &Reader<'_>, name: &Located<String>) -> Option<usize> {
        let names = building_names(self.text.as_deref()?);
        let Located { value: name, span } = name;
        names.iter().position(|n| n == name).or_else(|| {
            let message = format!("the case has no building \"{name}\"");
            let help = format!("its buildings are {}", names.join(", "));
            reader.refuse(span.clone(), message, help)
        })
    }
}
