//! The rows as a CSV table: a line a run, a column for every variable and value.

use std::fs::File;
use std::path::{Path, PathBuf};

use super::Description;
use crate::case_text::hexadecimal;
use crate::error::StudyError;
use crate::runs::{Axis, Row};
use crate::study_file::Value;

/// Writes a table beside its place; `finish` puts it there.
#[derive(Debug)]
pub struct CsvTable {
    path: PathBuf,
    part: PathBuf,
    writer: csv::Writer<File>,
    choices: Vec<Option<Vec<String>>>,
}

impl CsvTable {
    /// Begins a table with its header; units are SI and stand in brackets.
    ///
    /// # Errors
    /// [`StudyError::File`].
    pub fn create(path: &Path, description: &Description) -> Result<Self, StudyError> {
        let mut name = path.file_name().unwrap_or_default().to_owned();
        name.push(".part");
        let part = path.with_file_name(name);
        let writer = csv::Writer::from_path(&part).map_err(|e| failed(path, e.into()))?;
        let mut table = Self {
            path: path.to_owned(),
            part,
            writer,
            choices: description
                .coordinates
                .iter()
                .map(|c| c.choices.clone())
                .collect(),
        };
        table.line(&header(description))?;
        Ok(table)
    }

    fn line(&mut self, cells: &[String]) -> Result<(), StudyError> {
        self.writer
            .write_record(cells)
            .map_err(|e| failed(&self.path, e.into()))
    }

    /// Adds a run.
    ///
    /// # Errors
    /// [`StudyError::File`].
    pub fn push(&mut self, row: &Row, point: &[Value]) -> Result<(), StudyError> {
        let mut cells = vec![row.run.to_string()];
        cells.extend(
            point
                .iter()
                .zip(&self.choices)
                .map(|(value, names)| match (value, names) {
                    (Value::Choice(i), Some(names)) => names[*i].clone(),
                    (Value::Choice(i), None) => i.to_string(),
                    (Value::Number(x), _) => number(*x),
                }),
        );
        cells.push(
            row.failure
                .as_ref()
                .map_or("complete", |_| "failed")
                .to_owned(),
        );
        cells.push(hexadecimal(&row.id));
        cells.extend(row.values.iter().map(|x| number(*x)));
        cells.push(row.failure.clone().unwrap_or_default());
        self.line(&cells)
    }

    /// Brings the table to its place.
    ///
    /// # Errors
    /// [`StudyError::File`].
    pub fn finish(mut self) -> Result<(), StudyError> {
        let flushed = self.writer.flush();
        flushed
            .and_then(|()| std::fs::rename(&self.part, &self.path))
            .map_err(|e| failed(&self.path, e))
    }
}

fn failed(path: &Path, source: std::io::Error) -> StudyError {
    StudyError::File {
        what: "write",
        path: path.to_owned(),
        source,
    }
}

/// A number with all its digits; nothing for one that is missing.
fn number(x: f64) -> String {
    if x.is_nan() {
        String::new()
    } else {
        format!("{x:?}")
    }
}

fn header(d: &Description) -> Vec<String> {
    let with_unit = |name: &str, unit: &str| match unit {
        "" | "1" => name.to_owned(),
        _ => format!("{name} [{unit}]"),
    };
    let mut cells = vec!["run".to_owned()];
    cells.extend(d.coordinates.iter().map(|c| with_unit(&c.name, &c.unit)));
    cells.extend(["status".to_owned(), "run_id".to_owned()]);
    for q in &d.layout.quantities {
        let places = match q.axis {
            Axis::Run => {
                cells.push(with_unit(q.name, q.unit));
                continue;
            }
            Axis::Storey => &d.layout.storeys,
            Axis::Level => &d.layout.levels,
        };
        cells.extend(
            places
                .iter()
                .map(|p| with_unit(&format!("{}: {}", q.name, p.label), q.unit)),
        );
    }
    cells.push("diagnosis".to_owned());
    cells
}
