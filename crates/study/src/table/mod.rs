//! The rows as a table, CSV or Parquet: a line per run, a column for every variable and value.

mod parquet_table;

use std::fs::File;
use std::path::{Path, PathBuf};

use pounding_catalogue::wording::cell;
use pounding_files::PartFile;
use pounding_results::study::{Axis, Description, Row, Value};

use crate::error::StudyError;
use parquet_table::{Cell, ParquetTable};
use pounding_files::checksum::hexadecimal;

/// Heading of the last column: why a run failed, or what collapsed.
pub(crate) const DIAGNOSIS: &str = "diagnosis";

/// Writes a table beside its place; `finish` puts it there. It is Parquet if its name ends
/// in `.parquet`, else CSV.
#[derive(Debug)]
pub struct RunTable {
    path: PathBuf,
    writer: Writer,
    /// Dropped after `writer`, which writes into it.
    part: PartFile,
    choices: Vec<Option<Vec<String>>>,
    float32: bool,
}

#[derive(Debug)]
enum Writer {
    Csv(Box<csv::Writer<File>>),
    Parquet(Box<ParquetTable>),
}

impl RunTable {
    /// Begins a table with its header; units are SI and stand in brackets.
    ///
    /// # Errors
    /// [`StudyError::Table`].
    pub fn create(path: &Path, description: &Description) -> Result<Self, StudyError> {
        let refused = |e| failed(path, e);
        let part = PartFile::beside(path).map_err(refused)?;
        let names = header(description);
        let writer = if path
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("parquet"))
        {
            let kinds = kinds(description);
            let table = ParquetTable::create(part.path(), &names, &kinds).map_err(refused)?;
            Writer::Parquet(Box::new(table))
        } else {
            let mut csv = csv::Writer::from_path(part.path()).map_err(|e| refused(e.into()))?;
            let names = names.iter().map(|name| cell(name).into_owned());
            csv.write_record(names).map_err(|e| refused(e.into()))?;
            Writer::Csv(Box::new(csv))
        };
        Ok(Self {
            path: path.to_owned(),
            writer,
            part,
            choices: description
                .coordinates
                .iter()
                .map(|c| c.choices.clone())
                .collect(),
            float32: description.float32,
        })
    }

    /// Adds a run.
    ///
    /// # Errors
    /// [`StudyError::Table`].
    pub fn push(&mut self, row: &Row, point: &[Value]) -> Result<(), StudyError> {
        let mut cells = vec![Cell::Whole(i64::try_from(row.run).unwrap_or(i64::MAX))];
        cells.extend(
            point
                .iter()
                .zip(&self.choices)
                .map(|(value, names)| match (value, names) {
                    (Value::Choice(i), Some(names)) => Cell::Text(names[*i].clone()),
                    (Value::Choice(i), None) => Cell::Number(*i as f64),
                    (Value::Number(x), _) => Cell::Number(*x),
                }),
        );
        cells.push(Cell::Text(row.ending.status().1.to_owned()));
        cells.push(Cell::Text(hexadecimal(&row.id)));
        cells.extend(row.values.iter().map(|x| match self.float32 {
            true => Cell::Single(*x as f32),
            false => Cell::Number(*x),
        }));
        let diagnosis = row.ending.diagnosis().unwrap_or_default();
        cells.push(Cell::Text(diagnosis.to_owned()));
        let written = match &mut self.writer {
            Writer::Parquet(table) => table.push(cells),
            Writer::Csv(csv) => csv
                .write_record(cells.into_iter().map(in_characters))
                .map_err(std::io::Error::from),
        };
        written.map_err(|e| failed(&self.path, e))
    }

    /// Brings the table to its place.
    ///
    /// # Errors
    /// [`StudyError::Table`].
    pub fn finish(self) -> Result<(), StudyError> {
        let written = match self.writer {
            Writer::Csv(mut csv) => csv.flush(),
            Writer::Parquet(table) => table.finish(),
        };
        written
            .and_then(|()| self.part.finish())
            .map_err(|e| failed(&self.path, e))
    }
}

fn in_characters(value: Cell) -> String {
    match value {
        Cell::Whole(i) => i.to_string(),
        Cell::Number(x) => number(x),
        Cell::Single(x) if x.is_nan() => String::new(),
        Cell::Single(x) => format!("{x:?}"),
        Cell::Text(text) => cell(&text).into_owned(),
    }
}

/// A cell of the kind of each column.
fn kinds(d: &Description) -> Vec<Cell> {
    let word = || Cell::Text(String::new());
    let mut kinds = vec![Cell::Whole(0)];
    kinds.extend(d.coordinates.iter().map(|c| match c.choices {
        Some(_) => word(),
        None => Cell::Number(0.0),
    }));
    kinds.extend([word(), word()]);
    let values = header(d).len() - kinds.len() - 1;
    let value = match d.float32 {
        true => Cell::Single(0.0),
        false => Cell::Number(0.0),
    };
    kinds.extend(std::iter::repeat_n(value, values));
    kinds.push(word());
    kinds
}

fn failed(path: &Path, source: std::io::Error) -> StudyError {
    StudyError::Table {
        path: path.to_owned(),
        source,
        stored: false,
    }
}

/// Finds out before the runs, not after them, whether a path can be the place of a table.
///
/// # Errors
/// [`StudyError::Table`] if it is a folder or a device, or its folder is not there or cannot be
/// written to.
pub fn writable_table(path: &Path) -> Result<(), StudyError> {
    let part = PartFile::beside(path).map(drop);
    part.map_err(|source| failed(path, source))
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
            Axis::LinkLevel => &d.layout.link_levels,
            Axis::Building => {
                let of = |name: &String| with_unit(&format!("{}: {name}", q.name), q.unit);
                cells.extend(d.layout.buildings.iter().map(of));
                continue;
            }
        };
        cells.extend(
            places
                .iter()
                .map(|p| with_unit(&format!("{}: {}", q.name, p.heading()), q.unit)),
        );
    }
    cells.push(DIAGNOSIS.to_owned());
    cells
}
