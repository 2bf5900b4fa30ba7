//! Reading a result back, block by block.

use std::collections::HashMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use hdf5::types::VarLenUnicode;
use hdf5::{File, H5Type};

use super::writing::Id;
use super::{Coordinate, Description};
use crate::error::StudyError;
use crate::runs::{Ending, Layout, Place, Row};
use crate::study_file::Value;

/// A result that is read.
#[derive(Debug)]
pub struct ResultReader {
    file: File,
    path: PathBuf,
    /// What the result says beside its rows.
    pub description: Description,
    /// Number of its rows.
    pub rows: usize,
    failures: HashMap<i64, String>,
}

impl ResultReader {
    /// Opens a result.
    ///
    /// # Errors
    /// [`StudyError::ResultFile`] if it is not the result of a study.
    pub fn open(path: &Path) -> Result<Self, StudyError> {
        let failed = |reason: String| StudyError::ResultFile {
            what: "read",
            path: path.to_owned(),
            reason,
        };
        // The library's own message for a file that is not there is a page long.
        std::fs::metadata(path).map_err(|e| failed(e.to_string()))?;
        let open = || -> hdf5::Result<Self> {
            let file = File::open(path)?;
            let description = description(&file)?;
            let run = file.dataset("failures/run")?.read_raw::<i64>()?;
            let why = file
                .dataset("failures/diagnosis")?
                .read_raw::<VarLenUnicode>()?;
            let failures = run
                .into_iter()
                .zip(why.iter().map(|w| w.to_string()))
                .collect();
            Ok(Self {
                rows: file.dataset("run")?.size(),
                file,
                path: path.to_owned(),
                description,
                failures,
            })
        };
        open().map_err(|e| failed(format!("it is not the result of a study ({e})")))
    }

    /// Rows at these places of the file, with the values of the variables.
    ///
    /// # Errors
    /// [`StudyError::ResultFile`].
    pub fn block(&self, places: Range<usize>) -> Result<Vec<(Row, Vec<Value>)>, StudyError> {
        self.read(places).map_err(|e| StudyError::ResultFile {
            what: "read",
            path: self.path.clone(),
            reason: e.to_string(),
        })
    }

    fn read(&self, places: Range<usize>) -> hdf5::Result<Vec<(Row, Vec<Value>)>> {
        let layout = &self.description.layout;
        let runs = self.column::<i64>("run", &places)?;
        let ids = self.column::<Id>("run_id", &places)?;
        let status = self.column::<i8>("status", &places)?;
        let mut rows: Vec<(Row, Vec<Value>)> = runs
            .iter()
            .zip(&ids)
            .zip(&status)
            .map(|((run, id), status)| {
                let diagnosis = || self.failures.get(run).cloned().unwrap_or_default();
                let row = Row {
                    run: *run as usize,
                    id: bytes(id.as_str()),
                    values: Vec::with_capacity(layout.columns()),
                    ending: match status {
                        0 => Ending::Complete,
                        2 => Ending::Collapsed(diagnosis()),
                        _ => Ending::Failed(diagnosis()),
                    },
                };
                (row, Vec::new())
            })
            .collect();
        for c in &self.description.coordinates {
            match &c.choices {
                Some(names) => {
                    let values = self.column::<VarLenUnicode>(&c.name, &places)?;
                    for (row, value) in rows.iter_mut().zip(&values) {
                        let at = names.iter().position(|n| n == value.as_str());
                        row.1.push(Value::Choice(at.unwrap_or(0)));
                    }
                }
                None => {
                    let values = self.column::<f64>(&c.name, &places)?;
                    for (row, value) in rows.iter_mut().zip(values) {
                        row.1.push(Value::Number(value));
                    }
                }
            }
        }
        for q in &layout.quantities {
            if layout.width(q.axis) == 0 {
                continue;
            }
            let data = self.file.dataset(q.name)?;
            if data.ndim() == 1 {
                for (row, value) in rows.iter_mut().zip(self.column::<f64>(q.name, &places)?) {
                    row.0.values.push(value);
                }
            } else {
                let block = data.read_slice_2d::<f64, _>((places.clone(), ..))?;
                for (row, values) in rows.iter_mut().zip(block.rows()) {
                    row.0.values.extend(values);
                }
            }
        }
        Ok(rows)
    }

    fn column<T: H5Type>(&self, name: &str, places: &Range<usize>) -> hdf5::Result<Vec<T>> {
        let data = self.file.dataset(name)?;
        Ok(data
            .read_slice_1d::<T, _>(places.clone())?
            .into_raw_vec_and_offset()
            .0)
    }
}

fn bytes(text: &str) -> [u8; 16] {
    let mut id = [0; 16];
    for (i, b) in id.iter_mut().enumerate() {
        let two = text.get(2 * i..2 * i + 2).unwrap_or("00");
        *b = u8::from_str_radix(two, 16).unwrap_or(0);
    }
    id
}

fn description(file: &File) -> hdf5::Result<Description> {
    let text = |name: &str| -> hdf5::Result<String> {
        Ok(file.attr(name)?.read_scalar::<VarLenUnicode>()?.to_string())
    };
    let number =
        |name: &str| -> hdf5::Result<usize> { Ok(file.attr(name)?.read_scalar::<u64>()? as usize) };
    let variables: serde_json::Value =
        serde_json::from_str(&text("variables")?).map_err(|e| hdf5::Error::from(e.to_string()))?;
    let coordinate = |v: &serde_json::Value| {
        let field = |key: &str| v[key].as_str().unwrap_or_default().to_owned();
        let named = |names: &Vec<serde_json::Value>| {
            let names = names.iter().filter_map(|n| n.as_str());
            names.map(str::to_owned).collect()
        };
        Coordinate {
            name: field("name"),
            long_name: field("long_name"),
            unit: field("unit"),
            choices: v["choices"].as_array().map(named),
        }
    };
    Ok(Description {
        title: text("title")?,
        study_sha256: text("study_sha256")?,
        study: text("study")?,
        case: text("case")?,
        records: text("record_sha256")?,
        version: text("version")?,
        runs: number("runs")?,
        chunk: number("chunk")?,
        shard: (number("shard")?, number("shards")?),
        // Versions before had none.
        warnings: match file.attr_names()?.iter().any(|n| n == "warnings") {
            true => text("warnings")?.lines().map(str::to_owned).collect(),
            false => Vec::new(),
        },
        layout: layout(file)?,
        coordinates: variables
            .as_array()
            .into_iter()
            .flatten()
            .map(coordinate)
            .collect(),
    })
}

fn layout(file: &File) -> hdf5::Result<Layout> {
    let texts = |name: &str| -> hdf5::Result<Vec<String>> {
        if !file.link_exists(name) {
            return Ok(Vec::new());
        }
        let values = file.dataset(name)?.read_raw::<VarLenUnicode>()?;
        Ok(values.iter().map(|v| v.to_string()).collect())
    };
    let numbers = |name: &str| -> hdf5::Result<Vec<usize>> {
        if !file.link_exists(name) {
            return Ok(Vec::new());
        }
        let values = file.dataset(name)?.read_raw::<i32>()?;
        Ok(values.into_iter().map(|n| n as usize).collect())
    };
    // Versions before had no elevations and widths.
    let known = |name: &str, count: usize| -> hdf5::Result<Vec<Option<f64>>> {
        if !file.link_exists(name) {
            return Ok(vec![None; count]);
        }
        let values = file.dataset(name)?.read_raw::<f64>()?;
        Ok(values
            .into_iter()
            .map(|x| (!x.is_nan()).then_some(x))
            .collect())
    };
    let names = texts("storey")?.into_iter().zip(texts("storey_building")?);
    let count = names.len();
    let storeys = names
        .zip(numbers("storey_number")?)
        .zip(known("storey_elevation", count)?)
        .map(|(((label, of), n), z)| Place {
            label,
            of,
            storeys: vec![n],
            elevations: vec![z],
            width: None,
        });
    let names = texts("level")?.into_iter().zip(texts("level_gap")?);
    let count = names.len();
    let pairs = numbers("level_left_storey")?
        .into_iter()
        .zip(numbers("level_right_storey")?);
    let elevations = known("level_left_elevation", count)?
        .into_iter()
        .zip(known("level_right_elevation", count)?);
    let levels = names
        .zip(pairs)
        .zip(elevations)
        .zip(known("level_width", count)?)
        .map(
            |((((label, of), (l, r)), (z_left, z_right)), width)| Place {
                label,
                of,
                storeys: vec![l, r],
                elevations: vec![z_left, z_right],
                width,
            },
        );
    Ok(Layout::from_places(
        storeys.collect(),
        levels.collect(),
        file.link_exists("isolated_demand"),
    ))
}
