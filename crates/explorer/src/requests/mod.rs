//! What is asked of an explorer, and what is computed for each kind of request.

mod calibrate;
mod deadline;
mod run;
mod sweep;
mod widths;

use std::path::PathBuf;

use pounding_study::gap_check::CaseUnderRecord;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::answer::Answer;
use crate::explorer::{Explorer, Prepared};
use crate::fault::Refused;
use crate::request::Request;
use crate::{controls, limits};

#[wasm_bindgen]
impl Explorer {
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
            Request::Open { name } => Ok(controls::answer(&self.open(&name, bytes)?)),
            Request::Controls { changes } => Ok(controls::answer(&self.prepared(&changes)?)),
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
}

/// The case under its own record, as gap checks take it.
fn under_its_record(prepared: Prepared) -> CaseUnderRecord {
    let file: PathBuf = prepared.case.ground_motion.file.value;
    let name = file.file_stem().unwrap_or(file.as_os_str());
    CaseUnderRecord {
        name: name.to_string_lossy().into_owned(),
        file,
        assembly: prepared.assembly,
    }
}
