//! Writing: rows in, blocks out.

use std::path::{Path, PathBuf};

use hdf5::{Dataset, File, H5Type};
use ndarray::{ArrayView1, ArrayView2};
use pounding_files::checksum::{append, hexadecimal};
use pounding_files::{PartFile, PlaceTaken};
use serde_json::json;
use sha2::{Digest, Sha256};

use super::datasets::{
    Axes, BLOCK, Id, coordinates, dataset, describe, failures, labels, places, quantities, root,
    states,
};
use super::{Description, Row, StudyFileError, Value, ranges};
use crate::attributes::unicode;
use crate::dimension_scales::make_scale;
use crate::label::Kind;
use crate::{hdf5_file, reason_of};

type Result<T> = hdf5::Result<T>;

/// Writes a result beside its place; `finish` puts it there.
pub struct ResultWriter {
    path: PathBuf,
    label: String,
    open: Option<Open>,
    /// Dropped after `open`, which writes into it.
    part: Option<PartFile>,
}

struct Open {
    file: File,
    run: Dataset,
    status: Dataset,
    id: Dataset,
    coordinates: Vec<(Dataset, Option<Vec<String>>)>,
    quantities: Vec<(Dataset, std::ops::Range<usize>)>,
    failures: (Dataset, Dataset),
    float32: bool,
    written: usize,
    block: Vec<(Row, Vec<Value>)>,
}

impl ResultWriter {
    /// Begins a result of `rows` rows.
    ///
    /// # Errors
    /// [`StudyFileError::File`].
    pub fn create(
        path: &Path,
        description: &Description,
        rows: usize,
    ) -> std::result::Result<Self, StudyFileError> {
        let mut writer = Self {
            path: path.to_owned(),
            label: label(description, ""),
            open: None,
            part: None,
        };
        let part = PartFile::beside(path).map_err(|e| writer.failed(&e))?;
        let open = Open::create(part.path(), description, rows);
        writer.part = Some(part);
        writer.open = Some(open.map_err(|e| writer.failed(&e))?);
        Ok(writer)
    }

    /// Says of which study file the result is, as seen from the current folder. It is no part of
    /// what the result holds: that of a whole study which the user has named does without, and has
    /// the same bytes wherever it was made.
    #[must_use]
    pub fn of_study_file(mut self, description: &Description, study: &Path) -> Self {
        let file = pounding_files::label::seen_from_here(study);
        self.label = label(description, &file);
        self
    }

    fn failed(&self, error: &dyn std::fmt::Display) -> StudyFileError {
        StudyFileError::File {
            what: "write",
            path: self.path.clone(),
            reason: reason_of(error),
        }
    }

    /// Adds the next row.
    ///
    /// # Errors
    /// [`StudyFileError::File`].
    pub fn push(&mut self, row: Row, point: Vec<Value>) -> std::result::Result<(), StudyFileError> {
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
    /// [`StudyFileError::File`], or [`StudyFileError::Aside`]; nothing new stands under its name
    /// then.
    pub fn finish(mut self) -> std::result::Result<(), StudyFileError> {
        let (Some(mut open), Some(part)) = (self.open.take(), self.part.take()) else {
            return Ok(());
        };
        let written = open.flush().and_then(|()| open.file.flush());
        drop(open);
        written.map_err(|e| self.failed(&e))?;
        pounding_files::label::append(part.path(), &self.label)
            .and_then(|()| append(part.path()))
            .and_then(|()| part.finish())
            .map_err(|e| match e.downcast::<PlaceTaken>() {
                Ok(source) => StudyFileError::Aside {
                    path: self.path.clone(),
                    source,
                },
                Err(e) => self.failed(&e),
            })
    }
}

/// The label of the result of a study.
fn label(d: &Description, file: &str) -> String {
    json!({
        "result": Kind::STUDY, "file": file, "study_sha256": d.study_sha256,
        "text_sha256": hexadecimal(&Sha256::digest(&d.study)), "shards": ranges(d.part.shards()), "of": d.part.count(), "build": d.build,
    })
    .to_string()
}

impl Open {
    fn create(path: &Path, description: &Description, rows: usize) -> Result<Self> {
        let file = hdf5_file::create(path)?;
        root(&file, description)?;
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
        let link_level = labels(
            &file,
            "link_level",
            layout.link_levels.iter().map(|p| p.label.as_str()),
        )?;
        let building = labels(
            &file,
            "building",
            layout.buildings.iter().map(String::as_str),
        )?;
        for scale in [
            ("storey", &storey),
            ("level", &level),
            ("link_level", &link_level),
            ("building", &building),
        ] {
            if let Some(data) = scale.1 {
                make_scale(data, scale.0)?;
            }
        }
        let [storey, level, link_level] = [&storey, &level, &link_level].map(Option::as_ref);
        places(&file, description, [storey, level, link_level])?;
        let coordinates = coordinates(&file, description, &run, rows)?;
        let names: Vec<&str> = description
            .coordinates
            .iter()
            .map(|c| c.name.as_str())
            .collect();
        let axes = Axes {
            run: &run,
            storey,
            level,
            link_level,
            building: building.as_ref(),
            coordinates: &names.join(" "),
        };
        let (status, id) = states(&file, &axes, rows)?;
        let quantities = quantities(&file, description, &axes, rows)?;
        let failures = failures(&file)?;
        Ok(Self {
            file,
            run,
            status,
            id,
            coordinates,
            quantities,
            failures,
            float32: description.float32,
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
        let status: Vec<i8> = rows.iter().map(|(r, _)| r.ending.status().0).collect();
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
            let shape = (data.ndim() > 1).then_some((rows.len(), columns.len()));
            if self.float32 {
                let values: Vec<f32> = values.iter().map(|x| *x as f32).collect();
                put_block(data, &values, shape, place.clone())?;
            } else {
                put_block(data, &values, shape, place.clone())?;
            }
        }
        self.add_failures(&rows)?;
        self.written = place.end;
        Ok(())
    }

    fn add_failures(&mut self, rows: &[(Row, Vec<Value>)]) -> Result<()> {
        let failed: Vec<_> = rows
            .iter()
            .filter_map(|(r, _)| Some((r.run as i64, r.ending.diagnosis()?)))
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

/// Puts rows of one value, or of as many as the shape has columns.
fn put_block<T: H5Type>(
    data: &Dataset,
    values: &[T],
    shape: Option<(usize, usize)>,
    place: std::ops::Range<usize>,
) -> Result<()> {
    let Some(shape) = shape else {
        return put(data, values, place);
    };
    let view = ArrayView2::from_shape(shape, values);
    let view = view.map_err(|e| hdf5::Error::from(e.to_string()))?;
    data.write_slice(view, (place, ..))
}
