//! A case, its files, and what is asked of them.

use std::path::Path;

use pounding_assembly::{
    Assembly, AssemblyError, assemble, assemble_with_record, read_record, scale_record,
};
use pounding_case::{Case, GivenFiles, RuleText, Separation, decoded};
use pounding_ground_motion::{Accelerogram, Quantity, read_all_bytes};
use pounding_study::edited::{Change, edited};
use pounding_study::faults;
use pounding_study::gap_check::wrong_rules;
use serde_json::{Value, json};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::answer::Answer;
use crate::controls;
use crate::fault::Refused;
use crate::limits;
use crate::request::{Changed, Request, changes};
use crate::requests::{calibrate, run, sweep, widths};

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
    pub(crate) swept: Option<sweep::Swept>,
}

/// A changed case, ready to run.
#[derive(Debug)]
pub(crate) struct Prepared {
    /// The case, with its text.
    pub case: Case,
    /// The system, its options and the record.
    pub assembly: Assembly,
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

    /// Answers a request, a JSON text with the bytes that belong to it. The text says what to `do`:
    ///
    /// - `file`: keep the bytes as the file `name`; of a record with several components, their
    ///   names are in the answer;
    /// - `rules`: take the bytes as a file of rules for the gap, of this `name`, in the place of
    ///   those before; no bytes for none;
    /// - `open`: take the bytes as the case of this `name`;
    /// - `controls`: say what can be moved in the case;
    /// - `run`: run it, with at most so many `frames` of its motion;
    /// - `widths`: the widths that records, codes and combination rules ask for;
    /// - `calibrate`: the parameters with which `model` is like the model of `gap`;
    /// - `sweep`: runs at `widths` (m) of `gap`, with what happens in it, or of all gaps together.
    ///
    /// All but the first three take `changes` of the case, each `{path, value}`, `{absent}` (the path
    /// of what is left out), `{gap, keys}` or `{record}`; nothing of them is kept. What is wrong is an answer too, see [`Answer::text`].
    #[must_use]
    pub fn answer(&mut self, request: &str, bytes: &[u8]) -> Answer {
        let length = request.len().saturating_add(bytes.len());
        let answer = limits::request(length)
            .and_then(|()| {
                let wrong =
                    |why: serde_json::Error| Refused::new(format!("no request: {why}"), None);
                serde_json::from_str(request).map_err(wrong)
            })
            .and_then(|request| self.answered(request, bytes));
        answer.unwrap_or_else(Answer::from)
    }
}

impl Explorer {
    fn answered(&mut self, request: Request, bytes: &[u8]) -> Result<Answer, Refused> {
        match request {
            Request::File { name } => self.keep(&name, bytes),
            Request::Rules { name } => self.take_rules(&name, bytes),
            Request::Open { name } => self.open(&name, bytes),
            Request::Controls { changes } => {
                let prepared = self.prepared(&changes)?;
                Ok(controls::answer(&prepared))
            }
            Request::Run { changes, frames } => run::answer(&self.prepared(&changes)?, frames),
            Request::Widths { changes } => {
                let prepared = self.prepared(&changes)?;
                let separation = self.separation(&prepared.case)?;
                widths::answer(prepared, &separation)
            }
            Request::Calibrate {
                changes,
                gap,
                model,
            } => calibrate::answer(self.prepared(&changes)?, gap, &model),
            Request::Sweep {
                changes,
                gap,
                widths,
            } => sweep::answer(self, &changes, gap, &widths),
        }
    }

    fn keep(&mut self, name: &str, bytes: &[u8]) -> Result<Answer, Refused> {
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

    fn take_rules(&mut self, name: &str, bytes: &[u8]) -> Result<Answer, Refused> {
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
    fn separation(&self, case: &Case) -> Result<Separation, Refused> {
        let separation = case.separation.clone().overridden_by(Separation {
            rules: self.rules.clone(),
            ..Separation::default()
        });
        match wrong_rules(&separation) {
            None => Ok(separation),
            Some((error, source)) => Err(Refused::of_case(error, &source)),
        }
    }

    fn open(&mut self, name: &str, bytes: &[u8]) -> Result<Answer, Refused> {
        limits::text(bytes)?;
        let source = decoded(name, bytes.to_vec()).map_err(|e| Refused::of_case(e, ""))?;
        let before = (
            std::mem::replace(&mut self.name, name.to_owned()),
            std::mem::replace(&mut self.source, source),
        );
        self.forget();
        match self.prepared(&[]) {
            Ok(prepared) => Ok(controls::answer(&prepared)),
            Err(refused) => {
                // What was open stays open.
                (self.name, self.source) = before;
                self.forget();
                Err(refused)
            }
        }
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
