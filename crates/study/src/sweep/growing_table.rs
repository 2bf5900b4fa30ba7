//! A table that grows while the runs of a study finish.

use std::path::Path;

use pounding_results::study::Description;

use crate::error::StudyError;
use crate::parts::{Parts, RowsInOrder};
use crate::study_file::Study;
use crate::table::RunTable;

/// The table of a study whose runs are being made. It gets the row of a run as soon as that run
/// and all before it are stored, so that its bytes depend on neither threads nor interruptions.
/// It stands beside its place until it is finished: a study that is killed leaves no half table
/// under its name, and one that goes on begins the table anew from the stored runs.
#[derive(Debug)]
pub(super) struct GrowingTable<'s> {
    study: &'s Study,
    table: RunTable,
    rows: RowsInOrder,
}

impl<'s> GrowingTable<'s> {
    /// Begins the table with its header.
    ///
    /// # Errors
    /// [`StudyError::Table`].
    pub(super) fn create(
        study: &'s Study,
        path: &Path,
        description: &Description,
    ) -> Result<Self, StudyError> {
        Ok(Self {
            study,
            table: RunTable::create(path, description)?,
            rows: RowsInOrder::default(),
        })
    }

    /// Adds the runs that have been stored since, up to the first that is not.
    ///
    /// # Errors
    /// [`StudyError::Table`], or [`StudyError::File`] of a stored run that cannot be read.
    pub(super) fn follow(&mut self, parts: &Parts) -> Result<(), StudyError> {
        while let Some(row) = self.rows.next(parts)? {
            let pushed = self.table.push(&row, &self.study.point(row.run));
            pushed.map_err(with_stored_runs)?;
        }
        Ok(())
    }

    /// Adds what is left, and brings the table to its place. All runs are stored by then.
    ///
    /// # Errors
    /// As [`follow`](Self::follow).
    pub(super) fn finish(mut self, parts: &Parts) -> Result<(), StudyError> {
        self.follow(parts)?;
        self.table.finish().map_err(with_stored_runs)
    }
}

/// The rows of this table are those of stored runs.
fn with_stored_runs(error: StudyError) -> StudyError {
    match error {
        StudyError::Table { path, source, .. } => StudyError::Table {
            path,
            source,
            stored: true,
        },
        error => error,
    }
}
