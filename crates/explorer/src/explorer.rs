//! A case and its files, ready for what is asked of them.

use std::path::Path;

use pounding_assembly::{
    Assembly, AssemblyError, assemble, assemble_with_record, read_record, scale_record,
};
use pounding_case::{Case, GivenFiles, RuleText, Separation, decoded};
use pounding_ground_motion::{Accelerogram, Quantity, read_all_bytes};
use pounding_study::edited::{Change, edited};
use pounding_study::faults;
use pounding_study::gap_check::wrong_rules;
use pounding_time_history::BuildingOutcome;
use serde_json::{Value, json};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::answer::Answer;
use crate::fault::Refused;
use crate::limits;
use crate::request::{Changed, changes};

/// A case, the files that it names, and what was computed of them before.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct Explorer {
    files: GivenFiles,
    name: String,
    source: String,
    /// Rules for the gap beside those of the case.
    rules: Vec<RuleText>,
    /// The record as it was read, unscaled, under these changes of how it is read.
    record: Option<(Vec<Change>, Accelerogram)>,
    /// What the last sweep was made of.
    pub(crate) swept: Option<Swept>,
}

/// A changed case, ready to run.
#[derive(Debug)]
pub(crate) struct Prepared {
    /// The case, with its text.
    pub case: Case,
    /// The system, its options and the record.
    pub assembly: Assembly,
}

/// A case of which several widths were asked, one request after another.
#[derive(Debug)]
pub(crate) struct Swept {
    pub text: String,
    pub assembly: Assembly,
    pub isolated: Vec<BuildingOutcome>,
}

#[wasm_bindgen]
impl Explorer {
    /// An explorer without case and files.
    #[must_use]
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        // What would only trap the module is told to whoever called it.
        #[cfg(target_arch = "wasm32")]
        std::panic::set_hook(Box::new(|panic| {
            wasm_bindgen::throw_str(&panic.to_string());
        }));
        Self::default()
    }
}

impl Explorer {
    pub(crate) fn keep(&mut self, name: &str, bytes: &[u8]) -> Result<Answer, Refused> {
        let others = self.files.lengths().filter(|(n, _)| *n != Path::new(name));
        let before: usize = others.map(|(_, length)| length).sum();
        if before.saturating_add(bytes.len()) > limits::MOST_BYTES {
            return Err(Refused::new(
                format!(
                    "{name}: all files together have more than {} bytes",
                    limits::MOST_BYTES
                ),
                Some("run the case with `pounding run`".to_owned()),
            ));
        }
        self.files.insert(name, bytes);
        self.forget();
        let names = self.files.lengths().map(|(name, _)| name.to_string_lossy());
        let mut answer = Answer::default();
        answer.say("files", json!(names.collect::<Vec<_>>()));
        answer.say("components", json!(components(name, bytes)));
        Ok(answer)
    }

    pub(crate) fn take_rules(&mut self, name: &str, bytes: &[u8]) -> Result<Answer, Refused> {
        limits::text(bytes)?;
        let text = decoded(name, bytes.to_vec()).map_err(|e| Refused::of_case(e, ""))?;
        let rules = match text.is_empty() {
            true => Vec::new(),
            false => RuleText::parse_all(&text, name).map_err(|e| Refused::of_case(e, &text))?,
        };
        let alone = Separation {
            rules,
            ..Separation::default()
        };
        if let Some((error, source)) = wrong_rules(&alone) {
            return Err(Refused::of_case(error, &source));
        }
        self.rules = alone.rules;
        let names = self.rules.iter().map(|rule| rule.name.value.as_str());
        let mut answer = Answer::default();
        answer.say("rules", names.collect::<Value>());
        Ok(answer)
    }

    /// What provisions need to know: of the case, and rules beside it.
    pub(crate) fn separation(&self, case: &Case) -> Result<Separation, Refused> {
        let separation = case.separation.clone().overridden_by(Separation {
            rules: self.rules.clone(),
            ..Separation::default()
        });
        match wrong_rules(&separation) {
            None => Ok(separation),
            Some((error, source)) => Err(Refused::of_case(error, &source)),
        }
    }

    pub(crate) fn open(&mut self, name: &str, bytes: &[u8]) -> Result<Prepared, Refused> {
        limits::text(bytes)?;
        let source = decoded(name, bytes.to_vec()).map_err(|e| Refused::of_case(e, ""))?;
        let before = (
            std::mem::replace(&mut self.name, name.to_owned()),
            std::mem::replace(&mut self.source, source),
        );
        self.forget();
        self.prepared(&[]).inspect_err(|_| {
            // What was open stays open.
            (self.name, self.source) = before;
            self.forget();
        })
    }

    fn forget(&mut self) {
        self.record = None;
        self.swept = None;
    }

    /// The text of the case with these changes.
    pub(crate) fn text(&self, changed: &[Changed]) -> Result<String, Refused> {
        let text = edited(&self.source, &changes(changed)?)?;
        limits::text(text.as_bytes())?;
        Ok(text)
    }

    /// The case with these changes, assembled.
    pub(crate) fn prepared(&mut self, changed: &[Changed]) -> Result<Prepared, Refused> {
        if self.source.is_empty() {
            return Err(Refused::new(
                "no case is open",
                Some("open a case".to_owned()),
            ));
        }
        let text = self.text(changed)?;
        let path = Path::new(&self.name);
        let case = Case::parse_or_draft(&text, path);
        // Before what is wrong behind the words is looked for.
        let read = case.as_ref().ok();
        let draft = case.as_ref().err().and_then(|r| r.draft.as_ref());
        if let Some(read) = read.or(draft.map(|d| &d.case)) {
            limits::case(read)?;
        }
        let case = faults::parse_case_with(&text, path, &self.files)
            .map_err(|e| Refused::of_case(e, &text))?;
        let reading = changes(changed)?;
        let reading = reading.into_iter().filter(reads_the_record).collect();
        let assembly = self
            .assembled(&case, reading)
            // The words of the command line, which says all that is wrong.
            .or_else(|_| assemble(&case))
            .map_err(|e| Refused::of_assembly(e, &case))?;
        limits::run(&assembly)?;
        Ok(Prepared { case, assembly })
    }

    /// The system of a case; its record is read once.
    fn assembled(&mut self, case: &Case, reading: Vec<Change>) -> Result<Assembly, AssemblyError> {
        let known = self.record.take().filter(|(of, _)| *of == reading);
        let record = match known {
            Some((_, record)) => record,
            None => read_record(case)?,
        };
        let scaled = scale_record(case, record.clone());
        self.record = Some((reading, record));
        assemble_with_record(case, &scaled?)
    }
}

/// Names of the accelerations in a file, where there are several: what `component` of a case
/// chooses between. A file that is no record has none, and what is wrong with one is said when it
/// is used.
fn components(name: &str, bytes: &[u8]) -> Vec<String> {
    let recording = read_all_bytes(name, bytes, &Default::default());
    let series = recording.map_or_else(|_| Vec::new(), |recording| recording.series);
    let accelerations = series
        .into_iter()
        .filter(|series| series.quantity == Quantity::Acceleration);
    let names: Vec<String> = accelerations.map(|series| series.component).collect();
    match names.len() {
        1 => Vec::new(),
        _ => names,
    }
}

/// Whether a change is one of how the record is read, and not of its scale.
fn reads_the_record(change: &Change) -> bool {
    match change {
        Change::Record { .. } => true,
        Change::Entry { path, .. } | Change::Absent { path } => {
            path.starts_with("ground_motion") && !path.starts_with("ground_motion.scale")
        }
        Change::Model { .. } => false,
    }
}
