//! A case, its files, and what is asked of them.

use std::path::Path;

use pounding_assembly::{
    Assembly, AssemblyError, assemble, assemble_with_record, read_record, scale_record,
};
use pounding_case::{Case, GivenFiles, decoded};
use pounding_ground_motion::Accelerogram;
use pounding_study::edited::{Change, edited};
use pounding_study::faults;
use serde_json::json;

use crate::answer::Answer;
use crate::controls;
use crate::fault::Refused;
use crate::limits;
use crate::request::{Changed, Request, changes};
use crate::requests::{calibrate, run, sweep, widths};

/// A case, the files that it names, and what was computed of them before.
#[derive(Debug, Default)]
pub struct Explorer {
    files: GivenFiles,
    name: String,
    source: String,
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

impl Explorer {
    /// Answers a request: the length of a JSON text in four bytes, lowest first, the text, and
    /// the bytes that belong to it. The JSON text says what to `do`:
    ///
    /// - `file`: keep the bytes as the file `name`;
    /// - `open`: take the bytes as the case of this `name`;
    /// - `controls`: say what can be moved in the case;
    /// - `run`: run it, with at most so many `frames` of its motion;
    /// - `widths`: the widths that records, codes and combination rules ask for;
    /// - `calibrate`: the parameters with which `model` is like the model of `gap`;
    /// - `sweep`: runs at `widths` (m) of `gap`, or of all gaps.
    ///
    /// All but the first two take `changes` of the case, each `{path, value}`, `{gap, keys}` or
    /// `{record}`; nothing of them is kept.
    ///
    /// The answer is the length of a JSON text and the place of numbers, four bytes each, the
    /// text, and the numbers, in eight bytes each. Its `columns` say where each column of numbers
    /// begins, and how long it is. If anything is wrong it has `faults` instead, each with
    /// `message`, `help` and the `line` of the case.
    #[must_use]
    pub fn answer(&mut self, request: &[u8]) -> Vec<u8> {
        let answer = parts(request).and_then(|(request, bytes)| self.answered(request, bytes));
        answer.unwrap_or_else(Answer::from).bytes()
    }

    fn answered(&mut self, request: Request, bytes: &[u8]) -> Result<Answer, Refused> {
        match request {
            Request::File { name } => self.keep(&name, bytes),
            Request::Open { name } => self.open(&name, bytes),
            Request::Controls { changes } => {
                let prepared = self.prepared(&changes)?;
                Ok(controls::answer(&prepared))
            }
            Request::Run { changes, frames } => run::answer(&self.prepared(&changes)?, frames),
            Request::Widths { changes } => widths::answer(self.prepared(&changes)?),
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
        Ok(answer)
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

/// Whether a change is one of how the record is read, and not of its scale.
fn reads_the_record(change: &Change) -> bool {
    match change {
        Change::Record { .. } => true,
        Change::Entry { path, .. } => {
            path.starts_with("ground_motion") && !path.starts_with("ground_motion.scale")
        }
        Change::Model { .. } => false,
    }
}

/// The request and the bytes behind it.
fn parts(request: &[u8]) -> Result<(Request, &[u8]), Refused> {
    let wrong = |why: String| Refused::new(format!("no request: {why}"), None);
    let (length, rest) = request
        .split_first_chunk::<4>()
        .ok_or_else(|| wrong("it has no length".to_owned()))?;
    let (text, bytes) = rest
        .split_at_checked(u32::from_le_bytes(*length) as usize)
        .ok_or_else(|| wrong("it ends before its text".to_owned()))?;
    let request = serde_json::from_slice(text).map_err(|e| wrong(e.to_string()))?;
    Ok((request, bytes))
}
