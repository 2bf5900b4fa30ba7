//! Writing: rows in, blocks out.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use hdf5::types::{FixedAscii, VarLenUnicode};
use hdf5::{Dataset, File, Group, H5Type, Location};
use ndarray::{ArrayView1, ArrayView2};
use pounding_time_history::dimension_scales::{attach, make_scale};
use serde_json::json;

use super::Description;
use crate::case_text::hexadecimal;
use crate::error::StudyError;
use crate::runs::{Axis, Row};
use crate::study_file::Value;

/// Rows of a block, and of a chunk of the file: hundreds of kilobytes before compression.
pub(super) const BLOCK: usize = 1024;
/// Characters of a run's identity.
pub(super) type Id = FixedAscii<32>;

type Result<T> = hdf5::Result<T>;

/// Writes a result beside its place; `finish` puts it there.
pub(crate) struct ResultWriter {
    path: PathBuf,
    part: PathBuf,
    open: Option<Open>,
}

struct Open {
    file: File,
    run: Dataset,
    status: Dataset,
    id: Dataset,
    coordinates: Vec<(Dataset, Option<Vec<String>>)>,
    quantities: Vec<(Dataset, std::ops::Range<usize>)>,
    failures: (Dataset, Dataset),
    written: usize,
    block: Vec<(Row, Vec<Value>)>,
}

impl ResultWriter {
    /// Begins a result of `rows` rows.
    ///
    /// # Errors
    /// [`StudyError::ResultFile`].
    pub(crate) fn create(
        path: &Path,
        description: &Description,
        rows: usize,
    ) -> std::result::Result<Self, StudyError> {
        let mut name = path.file_name().unwrap_or_default().to_owned();
        name.push(".part");
        let part = path.with_file_name(name);
        let mut writer = Self {
            path: path.to_owned(),
            part,
            open: None,
        };
        let open = Open::create(&writer.part, description, rows);
        writer.open = Some(open.map_err(|e| writer.failed(&e))?);
        Ok(writer)
    }

    fn failed(&self, error: &dyn std::fmt::Display) -> StudyError {
        StudyError::ResultFile {
            what: "write",
            path: self.path.clone(),
            reason: error.to_string(),
        }
    }

    /// Adds the next row.
    ///
    /// # Errors
    /// [`StudyError::ResultFile`].
    pub(crate) fn push(
        &mut self,
        row: Row,
        point: Vec<Value>,
    ) -> std::result::Result<(), StudyError> {
        let Some(open) = &mut self.open else {
            return Ok(());
        };
        open.block.push((row, point));
        if open.block.len() < BLOCK {
            return Ok(());
        }
        open.flush().map_err(|e| self.failed(&e))
    }

    /// Writes what is left, brings the file to the disk and renames it.
    ///
    /// # Errors
    /// [`StudyError::ResultFile`]; nothing new stands under its name then.
    pub(crate) fn finish(mut self) -> std::result::Result<(), StudyError> {
        let Some(mut open) = self.open.take() else {
            return Ok(());
        };
        let written = open.flush().and_then(|()| open.file.flush());
        drop(open);
        written.map_err(|e| self.failed(&e))?;
        let file = std::fs::OpenOptions::new().write(true).open(&self.part);
        file.and_then(|f| f.sync_all())
            .and_then(|()| std::fs::rename(&self.part, &self.path))
            .map_err(|e| self.failed(&e))
    }
}

impl Drop for ResultWriter {
    fn drop(&mut self) {
        self.open = None;
        // After a success there is none; half a file is worthless.
        let _ = std::fs::remove_file(&self.part);
    }
}

impl Open {
    fn create(path: &Path, description: &Description, rows: usize) -> Result<Self> {
        let file = File::create(path)?;
        attributes(&file, description)?;
        let run = dataset::<i64>(&file, "run", rows, None)?;
        describe(&run, "", "number of the run, from 0")?;
        make_scale(&run, "run")?;
        let layout = &description.layout;
        let storey = labels(
            &file,
            "storey",
            layout.storeys.iter().map(|p| p.label.as_str()),
        )?;
        let level = labels(
            &file,
            "level",
            layout.levels.iter().map(|p| p.label.as_str()),
        )?;
        for scale in [("storey", &storey), ("level", &level)] {
            if let Some(data) = scale.1 {
                make_scale(data, scale.0)?;
            }
        }
        places(&file, description, storey.as_ref(), level.as_ref())?;
        let names: Vec<&str> = description
            .coordinates
            .iter()
            .map(|c| c.name.as_str())
            .collect();
        let beside = names.join(" ");
        let mut coordinates = Vec::new();
        for c in &description.coordinates {
            let data = match c.choices {
                Some(_) => dataset::<VarLenUnicode>(&file, &c.name, rows, None)?,
                None => dataset::<f64>(&file, &c.name, rows, None)?,
            };
            describe(&data, &c.unit, &c.long_name)?;
            attach(&data, &run, 0)?;
            coordinates.push((data, c.choices.clone()));
        }
        let status = dataset::<i8>(&file, "status", rows, None)?;
        describe(
            &status,
            "",
            "0 the run is complete, 1 it failed: see the group failures",
        )?;
        text(&status, "flag_meanings", "complete failed")?;
        status
            .new_attr::<i8>()
            .shape(2)
            .create("flag_values")?
            .write_raw(&[0_i8, 1])?;
        let id = dataset::<Id>(&file, "run_id", rows, None)?;
        describe(
            &id,
            "",
            "identity of the run: hash of case, record and program version",
        )?;
        for data in [&status, &id] {
            attach(data, &run, 0)?;
            text(data, "coordinates", &beside)?;
        }
        let mut quantities = Vec::new();
        for q in &layout.quantities {
            let (width, scale) = match q.axis {
                Axis::Run => (None, None),
                Axis::Storey => (Some(layout.width(q.axis)), storey.as_ref()),
                Axis::Level => (Some(layout.width(q.axis)), level.as_ref()),
            };
            if width == Some(0) {
                continue;
            }
            let data = dataset::<f64>(&file, q.name, rows, width)?;
            describe(&data, q.unit, q.long_name)?;
            text(&data, "coordinates", &beside)?;
            attach(&data, &run, 0)?;
            if let Some(scale) = scale {
                attach(&data, scale, 1)?;
            }
            quantities.push((data, layout.range(q.name)));
        }
        let failures = failures(&file)?;
        Ok(Self {
            file,
            run,
            status,
            id,
            coordinates,
            quantities,
            failures,
            written: 0,
            block: Vec::new(),
        })
    }

    /// Writes the block.
    fn flush(&mut self) -> Result<()> {
        let rows = std::mem::take(&mut self.block);
        let place = self.written..self.written + rows.len();
        if rows.is_empty() {
            return Ok(());
        }
        let runs: Vec<i64> = rows.iter().map(|(r, _)| r.run as i64).collect();
        put(&self.run, &runs, place.clone())?;
        let status: Vec<i8> = rows
            .iter()
            .map(|(r, _)| i8::from(r.failure.is_some()))
            .collect();
        put(&self.status, &status, place.clone())?;
        let id = |row: &Row| {
            Id::from_ascii(&hexadecimal(&row.id)).map_err(|e| hdf5::Error::from(e.to_string()))
        };
        let ids = rows
            .iter()
            .map(|(r, _)| id(r))
            .collect::<Result<Vec<_>>>()?;
        put(&self.id, &ids, place.clone())?;
        for (i, (data, choices)) in self.coordinates.iter().enumerate() {
            if let Some(names) = choices {
                let named = |point: &Vec<Value>| match point[i] {
                    Value::Choice(c) => unicode(&names[c]),
                    Value::Number(x) => unicode(&x.to_string()),
                };
                let values = rows
                    .iter()
                    .map(|(_, p)| named(p))
                    .collect::<Result<Vec<_>>>()?;
                put(data, &values, place.clone())?;
            } else {
                let number = |point: &Vec<Value>| match point[i] {
                    Value::Number(x) => x,
                    Value::Choice(c) => c as f64,
                };
                let values: Vec<f64> = rows.iter().map(|(_, p)| number(p)).collect();
                put(data, &values, place.clone())?;
            }
        }
        for (data, columns) in &self.quantities {
            let values: Vec<f64> = rows
                .iter()
                .flat_map(|(r, _)| &r.values[columns.clone()])
                .copied()
                .collect();
            if data.ndim() == 1 {
                put(data, &values, place.clone())?;
                continue;
            }
            let shape = (rows.len(), columns.len());
            let view = ArrayView2::from_shape(shape, &values);
            let view = view.map_err(|e| hdf5::Error::from(e.to_string()))?;
            data.write_slice(view, (place.clone(), ..))?;
        }
        self.add_failures(&rows)?;
        self.written = place.end;
        Ok(())
    }

    fn add_failures(&mut self, rows: &[(Row, Vec<Value>)]) -> Result<()> {
        let failed: Vec<_> = rows
            .iter()
            .filter_map(|(r, _)| Some((r.run as i64, r.failure.as_deref()?)))
            .collect();
        if failed.is_empty() {
            return Ok(());
        }
        let (run, diagnosis) = &self.failures;
        let before = run.size();
        let place = before..before + failed.len();
        run.resize(place.end)?;
        diagnosis.resize(place.end)?;
        let runs: Vec<i64> = failed.iter().map(|f| f.0).collect();
        put(run, &runs, place.clone())?;
        let texts = failed
            .iter()
            .map(|f| unicode(f.1))
            .collect::<Result<Vec<_>>>()?;
        put(diagnosis, &texts, place)
    }
}

fn put<T: H5Type>(data: &Dataset, values: &[T], place: std::ops::Range<usize>) -> Result<()> {
    data.write_slice(ArrayView1::from(values), place)
}

fn attributes(file: &File, d: &Description) -> Result<()> {
    let variables: Vec<_> = d
        .coordinates
        .iter()
        .map(|c| json!({"name": c.name, "long_name": c.long_name, "unit": c.unit, "choices": c.choices}))
        .collect();
    for (name, value) in [
        ("Conventions", "CF-1.10"),
        ("title", &d.title),
        ("program", "pounding"),
        ("version", &d.version),
        ("study", &d.study),
        ("study_sha256", &d.study_sha256),
        ("case", &d.case),
        ("record_sha256", &d.records),
        ("variables", &json!(variables).to_string()),
    ] {
        text(file, name, value)?;
    }
    for (name, value) in [
        ("runs", d.runs),
        ("chunk", d.chunk),
        ("shard", d.shard.0),
        ("shards", d.shard.1),
    ] {
        file.new_attr::<u64>()
            .create(name)?
            .write_scalar(&(value as u64))?;
    }
    Ok(())
}

/// What the labels of storeys and levels are made of.
fn places(
    file: &File,
    d: &Description,
    storey: Option<&Dataset>,
    level: Option<&Dataset>,
) -> Result<()> {
    let numbers = |name: &str, long: &str, values: &[i32], scale: &Dataset| {
        let data = dataset::<i32>(file, name, values.len(), None)?;
        data.write_raw(values)?;
        describe(&data, "", long)?;
        attach(&data, scale, 0)
    };
    let (storeys, levels) = (&d.layout.storeys, &d.layout.levels);
    if let Some(scale) = storey {
        if let Some(data) = labels(
            file,
            "storey_building",
            storeys.iter().map(|p| p.of.as_str()),
        )? {
            attach(&data, scale, 0)?;
        }
        let values: Vec<i32> = storeys.iter().map(|p| p.storeys[0] as i32).collect();
        numbers(
            "storey_number",
            "storey of its building, from 1 at the bottom",
            &values,
            scale,
        )?;
    }
    if let Some(scale) = level {
        if let Some(data) = labels(file, "level_gap", levels.iter().map(|p| p.of.as_str()))? {
            attach(&data, scale, 0)?;
        }
        for (i, name) in ["level_left_storey", "level_right_storey"]
            .into_iter()
            .enumerate()
        {
            let values: Vec<i32> = levels.iter().map(|p| p.storeys[i] as i32).collect();
            numbers(name, "storey from 1, 0 for a wall", &values, scale)?;
        }
    }
    Ok(())
}

/// A dataset of texts; none if there are no texts.
fn labels<'t>(
    file: &File,
    name: &str,
    texts: impl Iterator<Item = &'t str>,
) -> Result<Option<Dataset>> {
    let values = texts.map(unicode).collect::<Result<Vec<_>>>()?;
    if values.is_empty() {
        return Ok(None);
    }
    let builder = file.new_dataset::<VarLenUnicode>().obj_track_times(false);
    let data = builder.shape(values.len()).create(name)?;
    data.write_raw(&values)?;
    Ok(Some(data))
}

/// Numbers of failed runs and why they failed.
fn failures(file: &File) -> Result<(Dataset, Dataset)> {
    let group = file.create_group("failures")?;
    let run = group
        .new_dataset::<i64>()
        .obj_track_times(false)
        .chunk(256)
        .shape(0..)
        .create("run")?;
    describe(&run, "", "number of the run")?;
    let builder = group.new_dataset::<VarLenUnicode>().obj_track_times(false);
    let diagnosis = builder.chunk(256).shape(0..).create("diagnosis")?;
    describe(&diagnosis, "", "why the run failed")?;
    Ok((run, diagnosis))
}

/// A compressed dataset of rows, or of rows and columns.
fn dataset<T: H5Type>(
    group: &Group,
    name: &str,
    rows: usize,
    columns: Option<usize>,
) -> Result<Dataset> {
    let chunk = BLOCK.min(rows).max(1);
    let builder = group
        .new_dataset::<T>()
        .obj_track_times(false)
        .shuffle()
        .deflate(1);
    match columns {
        Some(columns) => builder
            .chunk((chunk, columns))
            .shape((rows, columns))
            .create(name),
        None => builder.chunk(chunk).shape(rows).create(name),
    }
}

fn describe(data: &Dataset, unit: &str, long_name: &str) -> Result<()> {
    if !unit.is_empty() {
        text(data, "units", unit)?;
    }
    text(data, "long_name", long_name)
}

fn text(location: &Location, name: &str, value: &str) -> Result<()> {
    let value = unicode(value)?;
    location
        .new_attr::<VarLenUnicode>()
        .create(name)?
        .write_scalar(&value)
}

fn unicode(value: &str) -> Result<VarLenUnicode> {
    // A text of HDF5 ends at its first zero.
    VarLenUnicode::from_str(&value.replace('\0', " ")).map_err(|e| hdf5::Error::from(e.to_string()))
}
