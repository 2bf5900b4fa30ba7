//! Errors that point into the case file.

use std::cell::RefCell;
use std::ops::Range;

use crate::located::Located;

/// Something wrong in a case file, with its place and a remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}: {message}", self.place())]
pub struct CaseError {
    /// File.
    pub file: String,
    /// Line, from 1; 0 for a file that could not be read.
    pub line: usize,
    /// Column in characters, from 1; 0 for a file that could not be read.
    pub column: usize,
    /// Bytes of the source that are wrong.
    pub span: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
    /// What else is wrong in the same file, in the order of the places; none of it follows
    /// from this.
    pub others: Box<[CaseError]>,
}

/// Whether the system allows this process, or all of them, no more open files: no fault of the
/// input.
#[must_use]
pub fn is_short_of_files(error: &std::io::Error) -> bool {
    // `EMFILE` and `ENFILE`, which Windows has not.
    cfg!(unix) && matches!(error.raw_os_error(), Some(24 | 23))
}

/// What to try where [`is_short_of_files`].
pub const MORE_FILES: &str = "allow more open files (`ulimit -n`)";

impl CaseError {
    /// An error at a span of a source text.
    #[must_use]
    pub fn new(
        file: &str,
        source: &str,
        span: Range<usize>,
        message: impl Into<String>,
        help: Option<String>,
    ) -> Self {
        let before = source.get(..span.start).unwrap_or(source);
        // A byte order mark is no column that an editor would show.
        let before = before.strip_prefix('\u{feff}').unwrap_or(before);
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        Self {
            file: file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            span,
            message: message.into(),
            help,
            others: Box::default(),
        }
    }

    /// An error of a file that could not be read, and so has no places.
    #[must_use]
    pub fn unread(file: &str, message: impl Into<String>, help: Option<String>) -> Self {
        Self {
            line: 0,
            column: 0,
            ..Self::new(file, "", 0..0, message, help)
        }
    }

    /// Whether the file could not be read because the system allows no more open files, see
    /// [`is_short_of_files`].
    #[must_use]
    pub fn is_short_of_files(&self) -> bool {
        // Said of that alone: a field of its own would make every error larger.
        self.line == 0 && self.help.as_deref() == Some(MORE_FILES)
    }

    /// `file:line:column`, or the file alone.
    fn place(&self) -> String {
        let Self {
            file, line, column, ..
        } = self;
        match line {
            0 => file.clone(),
            _ => format!("{file}:{line}:{column}"),
        }
    }

    /// One error of all that are wrong in a file, those that others bring too: the first, with the
    /// others in the order of their places. `None` of no errors.
    #[must_use]
    pub fn of_all(errors: Vec<Self>) -> Option<Self> {
        let mut errors: Vec<Self> = errors.into_iter().flat_map(Self::each).collect();
        errors.sort_by_key(|e| e.span.start);
        let mut distinct: Vec<Self> = Vec::new();
        for error in errors {
            // Those that are the same stand at one place.
            let here = |other: &&Self| other.span.start == error.span.start;
            let mut before = distinct.iter().rev().take_while(here);
            if !before.any(|other| *other == error) {
                distinct.push(error);
            }
        }
        let mut distinct = distinct.into_iter();
        let mut first = distinct.next()?;
        first.others = distinct.collect();
        Some(first)
    }

    /// This error and the others, each by itself.
    pub fn each(mut self) -> impl Iterator<Item = Self> {
        let others = std::mem::take(&mut self.others);
        std::iter::once(self).chain(others.into_vec())
    }
}

/// A parameter whose value could not be read.
#[derive(Debug, Clone, PartialEq)]
pub struct UnreadParameter {
    /// Its key.
    pub key: Located<String>,
    /// The impact model or law that it is given to.
    pub model: Located<String>,
    /// Whether that is the model of a gap.
    pub of_gap: bool,
}

/// Errors found so far in a file, and what was not read because of them.
///
/// A function that cannot return its value returns an error: a new one, or one that was
/// recorded before, which is then not reported twice. So nothing is said of what only
/// follows from another error.
///
/// A file is read to its end. Where a value is wrong, something else may stand in for it,
/// after its error was recorded: then all that does not depend on it can be looked at, and
/// what was read is given away by nobody but [`Errors::finish`], which refuses it.
#[derive(Debug, Default)]
pub struct Errors {
    found: RefCell<Vec<CaseError>>,
    /// Places of what could not be read whole, so that later errors there say nothing.
    incomplete: RefCell<Vec<Range<usize>>>,
    /// Parameters whose values could not be read.
    unread: RefCell<Vec<UnreadParameter>>,
    /// Values that were probably meant otherwise, in words.
    asked: RefCell<Vec<String>>,
}

impl Errors {
    /// Records an error, with those that it brings.
    pub fn record(&self, error: CaseError) {
        self.found.borrow_mut().extend(error.each());
    }

    /// The value; `None` after recording the error.
    pub fn keep<T>(&self, result: Result<T, CaseError>) -> Option<T> {
        result.map_err(|e| self.record(e)).ok()
    }

    /// The value, or where it is wrong, after recording the error, one that nobody will see.
    pub fn or_default<T: Default>(&self, result: Result<T, CaseError>) -> T {
        self.keep(result).unwrap_or_default()
    }

    /// All values, unless one of them is wrong; every error is recorded.
    ///
    /// # Errors
    /// One of those that were recorded.
    pub fn all<T>(
        &self,
        results: impl IntoIterator<Item = Result<T, CaseError>>,
    ) -> Result<Vec<T>, CaseError> {
        let mut wrong = None;
        let mut values = Vec::new();
        for result in results {
            match result {
                Ok(value) => values.push(value),
                Err(error) => {
                    self.record(error.clone());
                    wrong = Some(error);
                }
            }
        }
        wrong.map_or(Ok(values), Err)
    }

    /// An error recorded before: for a function that has no value because of it.
    #[must_use]
    pub fn recorded(&self) -> Option<CaseError> {
        self.found.borrow().first().cloned()
    }

    /// How many were recorded so far.
    #[must_use]
    pub fn count(&self) -> usize {
        self.found.borrow().len()
    }

    /// Says that what stands here was not read whole.
    pub fn incomplete(&self, place: Range<usize>) {
        self.incomplete.borrow_mut().push(place);
    }

    /// Places of what was not read whole.
    #[must_use]
    pub fn all_incomplete(&self) -> Vec<Range<usize>> {
        self.incomplete.borrow().clone()
    }

    /// Says that the value of a parameter was not read, and so not all of its model.
    pub(crate) fn unread(&self, parameter: UnreadParameter) {
        self.incomplete(parameter.model.span.clone());
        self.unread.borrow_mut().push(parameter);
    }

    /// Parameters whose values were not read.
    pub(crate) fn all_unread(&self) -> Vec<UnreadParameter> {
        self.unread.borrow().clone()
    }

    /// Says of a value that something else was probably meant: no error.
    pub(crate) fn ask(&self, question: String) {
        self.asked.borrow_mut().push(question);
    }

    /// What was said of such values.
    pub(crate) fn all_asked(&self) -> Vec<String> {
        self.asked.borrow().clone()
    }

    /// The value, unless anything was wrong.
    ///
    /// # Errors
    /// All that was recorded, and this error, as one.
    pub fn finish<T>(self, result: Result<T, CaseError>) -> Result<T, CaseError> {
        let value = self.keep(result);
        match (CaseError::of_all(self.found.into_inner()), value) {
            (None, Some(value)) => Ok(value),
            (Some(error), _) => Err(error),
            (None, None) => Err(CaseError::new(
                "",
                "",
                0..0,
                "the file cannot be read",
                None,
            )),
        }
    }
}
