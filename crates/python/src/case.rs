//! Cases.

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use pounding_assembly::{
    Assembly, AssemblyError, RecordFiles, assemble_sharing, assemble_with_record, process_record,
    scale_record,
};
use pounding_case::{Case, read_text};
use pounding_cli::Failure;
use pounding_cli::answers::{Understood, inputs_stay_meanwhile};
use pounding_files::{AskedOfTargets, FileUse};
use pounding_ground_motion::Accelerogram;
use pounding_study::faults;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::Problem;
use crate::motion::{Motion, ReadFrom};
use crate::values::{here, json, text_of};

/// Name in messages of a case that was made of a dict.
const MADE: &str = "<dict>";

/// A case: buildings, gaps, ground motion and analysis.
#[pyclass(frozen, name = "Case", module = "pounding._native")]
#[derive(Debug, Clone)]
pub struct PyCase {
    pub case: Arc<Case>,
    /// A motion that takes the place of the record of the case.
    pub motion: Option<Arc<Accelerogram>>,
    /// Its name.
    pub motion_name: String,
    /// The files that this motion was read from.
    motion_files: ReadFrom,
    /// The text of the case, which says so of such a motion.
    pub text: Arc<str>,
    /// The file as it was given, by which results call what the case reads.
    given: Option<PathBuf>,
    /// Whether nobody wrote the text, so that places are told by keys.
    made: bool,
}

impl PyCase {
    fn parsed(source: &str, file: &Path, made: bool, has_motion: bool) -> Result<Self, Problem> {
        match faults::parse_case(source, file, !has_motion) {
            Ok(case) => Ok(Self {
                case: Arc::new(case),
                motion: None,
                motion_name: String::new(),
                motion_files: ReadFrom::default(),
                text: source.into(),
                given: None,
                made,
            }),
            Err(error) => {
                let made = made.then(|| file.display().to_string());
                Err(Problem::from(Failure::case(error, source)).by_keys(made))
            }
        }
    }

    /// A case of a file that is called as it was given.
    fn of_file(source: &str, file: PathBuf) -> Result<Self, Problem> {
        let made = Self::parsed(source, &here(file.clone()), false, false)?;
        Ok(Self {
            given: Some(file),
            ..made
        })
    }

    /// The case with the file as it was given, as long as that leads there from the working folder.
    fn as_given(&self) -> Cow<'_, Case> {
        let leads_there = |given: &&PathBuf| here((*given).clone()) == self.case.file;
        match self.given.as_ref().filter(leads_there) {
            Some(given) => {
                let mut case = Case::clone(&self.case);
                case.file.clone_from(given);
                Cow::Owned(case)
            }
            None => Cow::Borrowed(&self.case),
        }
    }

    /// A failure as a problem of this case.
    pub fn problem(&self, failure: Failure) -> Problem {
        Problem::from(failure).by_keys(self.made.then(|| self.case.file.display().to_string()))
    }

    /// The system of the case under its motion.
    ///
    /// # Errors
    /// As of the case file, or of its record.
    pub fn assembly(&self) -> Result<Assembly, Problem> {
        self.assembly_sharing(&RecordFiles::default())
    }

    /// The same for one of many cases, which read the files of records once.
    ///
    /// # Errors
    /// As [`assembly`](Self::assembly).
    pub fn assembly_sharing(&self, files: &RecordFiles) -> Result<Assembly, Problem> {
        let case = &*self.as_given();
        let made = match &self.motion {
            None => assemble_sharing(case, files),
            Some(motion) => under_motion(case, motion),
        };
        made.map_err(|error| {
            let all = faults::with_all(error, case, self.motion.is_none());
            self.problem(Failure::of_case(all, case))
        })
    }

    /// The same case under a motion of this name.
    fn under(self, motion: &Motion, name: &str) -> Self {
        let record = Accelerogram::clone(&motion.record).of_memory(name);
        Self {
            text: format!(
                "{}\n{}",
                self.case.source.trim_end(),
                comment_on_motion(motion, name)
            )
            .into(),
            motion: Some(Arc::new(record)),
            motion_name: name.to_owned(),
            motion_files: motion.read_from.clone(),
            ..self
        }
    }

    /// The file of a case that was read from one.
    pub fn own_file(&self) -> Option<&Path> {
        (!self.made).then_some(&*self.case.file)
    }

    /// Refuses to write where something is read, now and once more right before the file takes its place.
    pub fn writes(&self, role: &str, path: &Path) -> Result<AskedOfTargets, Problem> {
        let mut files = FileUse::new();
        for (role, file) in self
            .case
            .files()
            .into_iter()
            .chain(self.motion_files.files())
        {
            files.reads(role, file);
        }
        if !self.made {
            files.reads("case", self.case.file.clone());
        }
        files.writes(role, path);
        Ok(inputs_stay_meanwhile(&files)?)
    }
}

#[pymethods]
impl PyCase {
    /// A case from the text of a case file; `file` names it and is the base of its paths.
    #[staticmethod]
    fn from_text(source: &str, file: PathBuf) -> Result<Self, Problem> {
        Self::of_file(source, file)
    }

    /// A case from its file.
    #[staticmethod]
    fn from_file(path: PathBuf) -> Result<Self, Problem> {
        let source = read_text(&path, "case").map_err(|e| Failure::case(e, ""))?;
        Self::of_file(&source, path)
    }

    /// A case from a dict with the keys of the case file; paths in it begin in `folder`. With
    /// a motion the ground motion of the dict says at most how that is scaled.
    #[staticmethod]
    #[pyo3(signature = (dict, folder, motion=None, name=""))]
    fn from_dict(
        dict: &Bound<'_, PyDict>,
        folder: PathBuf,
        motion: Option<&Motion>,
        name: &str,
    ) -> PyResult<Self> {
        let text = text_of(dict)?;
        let made = Self::parsed(&text, &here(folder).join(MADE), true, motion.is_some())?;
        Ok(match motion {
            Some(motion) => made.under(motion, name),
            None => made,
        })
    }

    /// The same case under another motion, processed and scaled as the case says.
    fn with_motion(&self, motion: &Motion, name: &str) -> Self {
        self.clone().under(motion, name)
    }

    /// The text of the case file; under a motion in memory with a comment that says so.
    #[getter]
    fn source(&self) -> &str {
        &self.text
    }

    /// Title, may be empty.
    #[getter]
    fn title(&self) -> &str {
        &self.case.title
    }

    /// The file that it was read from; `None` for one that was made of a dict.
    #[getter]
    fn file(&self) -> Option<PathBuf> {
        (!self.made).then(|| self.case.file.clone())
    }

    /// Names of the buildings, from the left.
    #[getter]
    fn buildings(&self) -> Vec<String> {
        let names = self.case.buildings.iter().map(|b| b.name.value.clone());
        names.collect()
    }

    /// Names of the gaps.
    #[getter]
    fn gaps(&self) -> Vec<String> {
        self.case.gaps.iter().map(|g| g.name.clone()).collect()
    }

    /// What was understood of the case, as JSON: what `pounding check --json` prints.
    fn check_json(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| {
            let assembly = self.assembly()?;
            let understood = Understood::of(&self.case, &assembly);
            json(&understood.map_err(|e| self.problem(Failure::of_case(e, &self.case)))?)
        })
        .map_err(PyErr::from)
    }
}

/// The comment at the end of a case on the motion in memory that it is under.
fn comment_on_motion(motion: &Motion, name: &str) -> String {
    let record = &motion.record;
    let from = motion.read_from.record.as_ref();
    let from = from.map_or(String::new(), |file| format!(", read from {file:?}"));
    format!(
        "\n# In the place of the record of [ground_motion] stands the motion {name:?} in memory{from}:\n\
         # {} samples at {} s, of which time step and values have the SHA-256\n# {}\n",
        record.samples().len(),
        record.time_step(),
        record.sha256()
    )
}

/// The system of a case under a motion in memory, processed and scaled as the case says of records.
///
/// # Errors
/// As of the case file, or what the motion does not allow.
pub fn under_motion(case: &Case, motion: &Accelerogram) -> Result<Assembly, AssemblyError> {
    let processed = process_record(case, motion.clone())?;
    assemble_with_record(case, &scale_record(case, processed)?)
}

/// Adds the classes of this file.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyCase>()
}
