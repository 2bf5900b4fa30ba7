//! Reading a result back, block by block.

use std::collections::HashMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use hdf5::types::VarLenUnicode;
use hdf5::{Dataset, File, H5Type};
use pounding_files::checksum::{Checksum, ChecksumError, WithoutChecksum};

use super::datasets::{BLOCK, CHOSEN_QUANTITIES, FLOAT32, Id, MERGED_SHARDS, NUMBERS};
use super::{
    Axis, Coordinate, Description, Ending, ISOLATED_DEMAND, IsolatedQuantities, Layout, Part,
    Place, Row, StudyFileError, Value, isolated_peaks, numbers,
};
use crate::watch::Reading;
use crate::{OpenError, ResultFile, Stamp, dataset, number, text, texts, values};

/// A result that is read.
#[derive(Debug)]
pub struct ResultReader {
    path: PathBuf,
    /// What the result says beside its rows.
    pub description: Description,
    /// Number of its rows.
    pub rows: usize,
    /// What its checksum says.
    pub checksum: Checksum,
    /// What tells whether the file has changed since.
    pub(super) stamp: Stamp,
    run: Dataset,
    id: Dataset,
    status: Dataset,
    coordinates: Vec<Dataset>,
    /// With the number of columns, `None` for a quantity of the whole run.
    quantities: Vec<(Dataset, Option<usize>)>,
    failures: HashMap<i64, String>,
}

impl ResultReader {
    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Opens a result whose checksum matches; one without a checksum only if that is
    /// accepted.
    ///
    /// # Errors
    /// [`StudyFileError::Checksum`], or [`StudyFileError::File`] if it is not the result of a
    /// study or its parts do not fit one another.
    pub fn open(path: &Path, without: WithoutChecksum) -> Result<Self, StudyFileError> {
        let failed = |reason: String| StudyFileError::File {
            what: "read",
            path: path.to_owned(),
            reason,
        };
        let _reading = Reading::of(path);
        let opened = ResultFile::open(path, without).map_err(|source| match source {
            OpenError::Checksum(ChecksumError::NotHdf5) => {
                failed("it is not the result of a study (it is not HDF5)".to_owned())
            }
            source => StudyFileError::Checksum {
                path: path.to_owned(),
                source,
            },
        })?;
        Self::of(path, &opened)
    }

    /// Opens a result once more that was open before, if it has not changed since.
    pub(super) fn open_again(path: &Path, stamp: &Stamp) -> Result<Self, StudyFileError> {
        let _reading = Reading::of(path);
        let opened = stamp.open_again(path);
        let opened = opened.map_err(|source| StudyFileError::Checksum {
            path: path.to_owned(),
            source,
        })?;
        Self::of(path, &opened)
    }

    fn of(path: &Path, opened: &ResultFile) -> Result<Self, StudyFileError> {
        Self::with_parts(path, opened).map_err(|e| {
            let reason = e.to_string();
            let reason = reason.lines().next().unwrap_or_default();
            StudyFileError::File {
                what: "read",
                path: path.to_owned(),
                reason: format!("it is not the result of a study ({reason})"),
            }
        })
    }

    fn with_parts(path: &Path, opened: &ResultFile) -> hdf5::Result<Self> {
        let file = opened.file();
        let description = description(file)?;
        let run = part::<i64>(file, "run")?;
        let rows = run.size();
        if Some(rows) != description.part.rows(description.runs, description.chunk) {
            return Err(hdf5::Error::from(
                "its rows are not those of its part of the study",
            ));
        }
        let fits = |data: Dataset, name: &str, columns: Option<usize>| {
            let shape: Vec<usize> = [Some(rows), columns].into_iter().flatten().collect();
            match data.shape() == shape {
                true => Ok(data),
                false => Err(hdf5::Error::from(format!(
                    "{name} does not have the rows and columns of the result"
                ))),
            }
        };
        let (id, status) = (part::<Id>(file, "run_id")?, part::<i8>(file, "status")?);
        let mut coordinates = Vec::new();
        for c in &description.coordinates {
            let data = match &c.choices {
                Some(_) => part::<VarLenUnicode>(file, &c.name),
                None => part::<f64>(file, &c.name),
            };
            coordinates.push(fits(data?, &c.name, None)?);
        }
        let layout = &description.layout;
        let mut quantities = Vec::new();
        for q in &layout.quantities {
            let columns = match q.axis {
                Axis::Run => None,
                axis => Some(layout.width(axis)),
            };
            if columns != Some(0) {
                let data = match description.float32 {
                    true => part::<f32>(file, q.name)?,
                    false => part::<f64>(file, q.name)?,
                };
                quantities.push((fits(data, q.name, columns)?, columns));
            }
        }
        Ok(Self {
            path: path.to_owned(),
            rows,
            checksum: opened.checksum(),
            stamp: opened.stamp().clone(),
            id: fits(id, "run_id", None)?,
            status: fits(status, "status", None)?,
            run,
            coordinates,
            quantities,
            failures: failures(file)?,
            description,
        })
    }

    /// How many of its runs failed, and in how many a building collapsed.
    ///
    /// # Errors
    /// [`StudyFileError::File`].
    pub fn failed_and_collapsed(&self) -> Result<[usize; 2], StudyFileError> {
        let _reading = Reading::of(&self.path);
        let status = match self.rows {
            0 => Ok(Vec::new()),
            rows => column::<i8>(&self.status, &(0..rows)),
        };
        let status = status.map_err(|e| StudyFileError::File {
            what: "read",
            path: self.path.clone(),
            reason: e.to_string(),
        })?;
        let endings = [
            Ending::Failed(String::new()),
            Ending::Collapsed(String::new()),
        ];
        Ok(endings.map(|ending| {
            let (flag, _) = ending.status();
            status.iter().filter(|status| **status == flag).count()
        }))
    }

    /// Hands over every row, with the values of the variables; those of a block are held at once.
    ///
    /// # Errors
    /// Rows that cannot be read, or that `take` refuses.
    pub fn each<E: From<StudyFileError>>(
        &self,
        mut take: impl FnMut(Row, Vec<Value>) -> Result<(), E>,
    ) -> Result<(), E> {
        for start in (0..self.rows).step_by(BLOCK) {
            let block = self.block(start..(start + BLOCK).min(self.rows))?;
            block
                .into_iter()
                .try_for_each(|(row, point)| take(row, point))?;
        }
        Ok(())
    }

    /// Rows at these places of the file, with the values of the variables.
    ///
    /// # Errors
    /// [`StudyFileError::File`].
    pub fn block(&self, places: Range<usize>) -> Result<Vec<(Row, Vec<Value>)>, StudyFileError> {
        let _reading = Reading::of(&self.path);
        self.read(places).map_err(|e| StudyFileError::File {
            what: "read",
            path: self.path.clone(),
            reason: e.to_string(),
        })
    }

    fn read(&self, places: Range<usize>) -> hdf5::Result<Vec<(Row, Vec<Value>)>> {
        let columns = self.description.layout.columns();
        let runs = column::<i64>(&self.run, &places)?;
        let ids = column::<Id>(&self.id, &places)?;
        let status = column::<i8>(&self.status, &places)?;
        let mut rows = Vec::with_capacity(runs.len());
        for ((run, id), status) in runs.iter().zip(&ids).zip(&status) {
            let damaged = |what: &str| hdf5::Error::from(format!("run {run} has {what}"));
            let diagnosis = || {
                let diagnosis = self.failures.get(run).cloned();
                diagnosis.ok_or_else(|| damaged("no diagnosis"))
            };
            let row = Row {
                run: usize::try_from(*run).map_err(|_| damaged("no number that can be"))?,
                id: bytes(id.as_str()).ok_or_else(|| damaged("no identity"))?,
                values: Vec::with_capacity(columns),
                ending: match status {
                    0 => Ending::Complete,
                    1 => Ending::Failed(diagnosis()?),
                    2 => Ending::Collapsed(diagnosis()?),
                    _ => return Err(damaged("no status that we know")),
                },
            };
            rows.push((row, Vec::new()));
        }
        for (data, c) in self.coordinates.iter().zip(&self.description.coordinates) {
            match &c.choices {
                Some(names) => {
                    let values = column::<VarLenUnicode>(data, &places)?;
                    for (row, value) in rows.iter_mut().zip(&values) {
                        let at = names
                            .iter()
                            .position(|n| n.as_bytes() == value.as_bytes())
                            .ok_or_else(|| {
                                hdf5::Error::from(format!("a value of {} is no choice", c.name))
                            })?;
                        row.1.push(Value::Choice(at));
                    }
                }
                None => {
                    let values = column::<f64>(data, &places)?;
                    for (row, value) in rows.iter_mut().zip(values) {
                        row.1.push(Value::Number(value));
                    }
                }
            }
        }
        for (data, columns) in &self.quantities {
            match self.description.float32 {
                true => add::<f32>(&mut rows, data, *columns, &places)?,
                false => add::<f64>(&mut rows, data, *columns, &places)?,
            }
        }
        Ok(rows)
    }
}

/// Adds the values of a quantity to rows.
fn add<T: H5Type + Copy + Into<f64>>(
    rows: &mut [(Row, Vec<Value>)],
    data: &Dataset,
    columns: Option<usize>,
    places: &Range<usize>,
) -> hdf5::Result<()> {
    if columns.is_none() {
        for (row, value) in rows.iter_mut().zip(column::<T>(data, places)?) {
            row.0.values.push(value.into());
        }
        return Ok(());
    }
    let block = data.read_slice_2d::<T, _>((places.clone(), ..))?;
    for (row, values) in rows.iter_mut().zip(block.rows()) {
        row.0.values.extend(values.iter().map(|x| (*x).into()));
    }
    Ok(())
}

/// A dataset of this type, or which one is damaged and how.
fn part<T: H5Type>(file: &File, name: &str) -> hdf5::Result<Dataset> {
    dataset::<T>(file, name).map_err(|e| of(name, &e))
}

/// An error with the name of what it is of.
fn of(name: &str, error: &hdf5::Error) -> hdf5::Error {
    hdf5::Error::from(format!("{name}: {error}"))
}

fn column<T: H5Type>(data: &Dataset, places: &Range<usize>) -> hdf5::Result<Vec<T>> {
    let column = data.read_slice_1d::<T, _>(places.clone())?;
    Ok(column.into_raw_vec_and_offset().0)
}

fn failures(file: &File) -> hdf5::Result<HashMap<i64, String>> {
    let group = file.group("failures")?;
    let run = values::<i64>(&group, "run").map_err(|e| of("failures/run", &e))?;
    let why = texts(&group, "diagnosis").map_err(|e| of("failures/diagnosis", &e))?;
    if run.len() != why.len() {
        return Err(hdf5::Error::from("failures and diagnoses differ in number"));
    }
    Ok(run.into_iter().zip(why).collect())
}

fn bytes(text: &str) -> Option<[u8; 16]> {
    let mut id = [0; 16];
    for (i, b) in id.iter_mut().enumerate() {
        *b = u8::from_str_radix(text.get(2 * i..2 * i + 2)?, 16).ok()?;
    }
    Some(id)
}

fn description(file: &File) -> hdf5::Result<Description> {
    let text = |name: &str| -> hdf5::Result<String> {
        text(file, name).map_err(|e| of(&format!("attribute {name}"), &e))
    };
    let number = |name: &str| -> hdf5::Result<usize> {
        let number = number::<u64>(file, name)?;
        // More would be no number of anything.
        let number = u32::try_from(number).ok().map(|n| n as usize);
        number
            .ok_or_else(|| hdf5::Error::from(format!("attribute {name} is no number that can be")))
    };
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
    let coordinates: Vec<Coordinate> = variables
        .as_array()
        .into_iter()
        .flatten()
        .map(coordinate)
        .collect();
    let has = |name: &str| -> hdf5::Result<bool> {
        Ok(file.attr_names()?.iter().any(|found| found == name))
    };
    let quantities = match has(CHOSEN_QUANTITIES)? {
        true => Some(text(CHOSEN_QUANTITIES)?),
        false => None,
    };
    let quantities: Option<Vec<String>> =
        quantities.map(|names| names.split_whitespace().map(str::to_owned).collect());
    let float32 = match has(NUMBERS)? {
        true if text(NUMBERS)? == FLOAT32 => true,
        true => {
            return Err(hdf5::Error::from(
                "its numbers have a type that we do not know",
            ));
        }
        false => false,
    };
    Ok(Description {
        title: text("title")?,
        study_sha256: text("study_sha256")?,
        study: text("study")?,
        case: text("case")?,
        records: text("record_sha256")?,
        version: text("version")?,
        build: match file.attr_names()?.iter().any(|name| name == "build") {
            true => text("build")?,
            false => String::new(),
        },
        runs: number("runs")?,
        chunk: number("chunk")?,
        part: part_of(file, number("shard")?, number("shards")?)?,
        // Versions before had none.
        warnings: match file.attr_names()?.iter().any(|n| n == "warnings") {
            true => text("warnings")?.lines().map(str::to_owned).collect(),
            false => Vec::new(),
        },
        layout: layout(file, quantities.as_deref(), &coordinates)?,
        quantities,
        float32,
        coordinates,
    })
}

/// Which shards a result holds.
fn part_of(file: &File, shard: usize, of: usize) -> hdf5::Result<Part> {
    let shards = match shard {
        0 => numbers(&text(file, MERGED_SHARDS)?, of),
        one => Some(vec![one]),
    };
    let part = shards.and_then(|shards| Part::of(shards, of));
    part.ok_or_else(|| hdf5::Error::from("its shards are none that can be"))
}

/// The columns of a result, of which a study may have chosen some quantities.
fn layout(
    file: &File,
    chosen: Option<&[String]>,
    coordinates: &[Coordinate],
) -> hdf5::Result<Layout> {
    // Variables may have the names of results that versions before did not know.
    let stores = |name: &str| file.link_exists(name) && coordinates.iter().all(|c| c.name != name);
    let labels = |name: &str| match stores(name) {
        true => texts(file, name).map_err(|e| of(name, &e)),
        false => Ok(Vec::new()),
    };
    let numbers = |name: &str| -> hdf5::Result<Vec<usize>> {
        if !stores(name) {
            return Ok(Vec::new());
        }
        let numbers = values::<i32>(file, name)
            .map_err(|e| of(name, &e))?
            .into_iter()
            .map(usize::try_from);
        let numbers = numbers.collect::<Result<Vec<_>, _>>();
        numbers.map_err(|_| hdf5::Error::from(format!("{name} has a number that cannot be")))
    };
    // Versions before had no elevations and widths.
    let known = |name: &str, count: usize| -> hdf5::Result<Vec<Option<f64>>> {
        if !stores(name) {
            return Ok(vec![None; count]);
        }
        let read = values::<f64>(file, name).map_err(|e| of(name, &e))?;
        let numbers = read.into_iter().map(|x| (!x.is_nan()).then_some(x));
        Ok(numbers.collect())
    };
    let (storey, building, number) = (
        labels("storey")?,
        labels("storey_building")?,
        numbers("storey_number")?,
    );
    let elevation = known("storey_elevation", storey.len())?;
    let undescribed = || hdf5::Error::from("storeys or levels are not all described");
    if [building.len(), number.len(), elevation.len()] != [storey.len(); 3] {
        return Err(undescribed());
    }
    // Levels of gaps or of links, and to which of them each belongs.
    let levels = |axis: &str, of: &str| -> hdf5::Result<Vec<Place>> {
        let (level, of) = (labels(axis)?, labels(&format!("{axis}_{of}"))?);
        let side = |side: &str| -> hdf5::Result<_> {
            let storeys = numbers(&format!("{axis}_{side}_storey"))?;
            let elevations = known(&format!("{axis}_{side}_elevation"), level.len())?;
            Ok((storeys, elevations))
        };
        let ((left, left_elevation), (right, right_elevation)) = (side("left")?, side("right")?);
        let width = known(&format!("{axis}_width"), level.len())?;
        let described = [
            of.len(),
            left.len(),
            right.len(),
            left_elevation.len(),
            right_elevation.len(),
            width.len(),
        ];
        if described != [level.len(); 6] {
            return Err(undescribed());
        }
        let places = level.into_iter().zip(of).enumerate();
        let places = places.map(|(i, (label, of))| Place {
            label,
            of,
            storeys: vec![left[i], right[i]],
            elevations: vec![left_elevation[i], right_elevation[i]],
            width: width[i],
        });
        Ok(places.collect())
    };
    let (levels, link_levels) = (levels("level", "gap")?, levels("link_level", "link")?);
    let storeys = storey.into_iter().zip(building).zip(number).zip(elevation);
    let storeys = storeys.map(|(((label, of), n), z)| Place {
        label,
        of,
        storeys: vec![n],
        elevations: vec![z],
        width: None,
    });
    let mut layout = Layout::from_places(
        [storeys.collect(), levels, link_levels],
        labels("building")?,
        |response| stores(response.peak.name),
        |own| stores(own.peak.name),
        |own| stores(own.storey.name) || stores(own.isolated.name),
        IsolatedQuantities {
            demand: stores(ISOLATED_DEMAND.name),
            peaks: isolated_peaks().any(stores),
        },
    );
    if let Some(names) = chosen {
        layout.keep(names);
        // Else a quantity whose dataset is lost would not be missed.
        if layout.quantities.len() != names.len() {
            return Err(hdf5::Error::from(
                "a quantity that the study chose is not there",
            ));
        }
    }
    Ok(layout)
}
