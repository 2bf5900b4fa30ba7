//! Datasets that grow with the run: a row for every time on the output grid.

use std::ops::Range;

use hdf5::{Dataset, Group};
use ndarray::{ArrayView1, ArrayView2};
use pounding_time_history::{Energy, FloorForce, GroundMotion, History};

use super::Result;
use super::datasets::CHUNK_ROWS;
use crate::attributes::describe;

/// Bytes of a block of rows at most.
const BLOCK_BYTES: usize = 32 << 20;
/// Rows of a block at least.
const LEAST_ROWS: usize = 16;

/// What stands in a dataset of a block of responses.
pub(super) enum Content {
    /// A number of every time.
    Number(fn(&History) -> &[f64]),
    /// One column of a list.
    Column(fn(&History) -> &[f64], usize),
    /// Some columns of a list.
    Columns(fn(&History) -> &[f64], Range<usize>),
    /// Sums of columns of a list; one of none holds zeros.
    Sums(fn(&History) -> &[f64], Vec<Vec<usize>>),
    /// Drift ratios of a building: its floors, its storey heights (m).
    DriftRatios(Range<usize>, Vec<f64>),
    /// The same from drifts that are columns of their own.
    OverHeights(Range<usize>, Vec<f64>),
    /// A part of the energy ledger.
    Energy(fn(&Energy) -> f64),
    /// Acceleration of the ground by a motion.
    Ground(GroundMotion),
    /// Forces on the floors of a building of so many storeys.
    Forces(Vec<FloorForce>, usize),
}

/// A dataset and what it is filled with.
struct Table {
    data: Dataset,
    content: Content,
}

/// The datasets, and the block of rows that is written next.
pub(super) struct Tables {
    all: Vec<Table>,
    block: History,
    /// Rows of a block; chunks divide it.
    rows: usize,
    written: usize,
}

impl Tables {
    /// For rows of this many numbers.
    pub(super) fn new(width: usize) -> Self {
        let mut rows = CHUNK_ROWS;
        while rows > LEAST_ROWS && rows * width * size_of::<f64>() > BLOCK_BYTES {
            rows /= 2;
        }
        Self {
            all: Vec::new(),
            block: History::default(),
            rows,
            written: 0,
        }
    }

    /// Adds a dataset with units and long name, empty as yet.
    pub(super) fn add(
        &mut self,
        group: &Group,
        (name, units, long_name): (&str, &str, &str),
        content: Content,
    ) -> Result<Dataset> {
        let builder = group.new_dataset::<f64>().shuffle().deflate(1).fletcher32();
        let data = match content.columns() {
            None => builder.chunk(self.rows).shape(0..).create(name)?,
            Some(columns) => {
                let chunk = (self.rows, columns.max(1));
                builder.chunk(chunk).shape((0.., columns)).create(name)?
            }
        };
        describe(&data, units, long_name)?;
        let handle = data.clone();
        self.all.push(Table { data, content });
        Ok(handle)
    }

    /// Takes rows: whole blocks are written at once, others when a block is full.
    pub(super) fn take(&mut self, rows: &mut History) -> Result<()> {
        if self.block.is_empty() && rows.len().is_multiple_of(self.rows) {
            return self.write_rows(rows);
        }
        self.block.append(rows);
        if self.block.len() < self.rows {
            return Ok(());
        }
        self.write()
    }

    /// Writes what the block holds.
    pub(super) fn write(&mut self) -> Result<()> {
        let mut block = std::mem::take(&mut self.block);
        let written = self.write_rows(&block);
        block.clear();
        self.block = block;
        written
    }

    /// Writes rows behind those that are written.
    pub(super) fn write_rows(&mut self, rows: &History) -> Result<()> {
        let place = self.written..self.written + rows.len();
        for table in &self.all {
            let values = table.content.of(rows);
            let rows = place.clone();
            let Some(columns) = table.content.columns() else {
                table.data.resize(place.end)?;
                table.data.write_slice(ArrayView1::from(&values), rows)?;
                continue;
            };
            table.data.resize((place.end, columns))?;
            let view = ArrayView2::from_shape((place.len(), columns), &values);
            let view = view.map_err(|e| hdf5::Error::from(e.to_string()))?;
            table.data.write_slice(view, (rows, ..))?;
        }
        self.written = place.end;
        Ok(())
    }
}

impl Content {
    /// Columns of the dataset; `None` where it has one dimension.
    fn columns(&self) -> Option<usize> {
        match self {
            Self::Number(_) | Self::Column(..) | Self::Energy(_) | Self::Ground(_) => None,
            Self::Forces(_, storeys) => Some(*storeys),
            Self::Columns(_, range) | Self::DriftRatios(range, _) | Self::OverHeights(range, _) => {
                Some(range.len())
            }
            Self::Sums(_, columns) => Some(columns.len()),
        }
    }

    /// Values of a block, row after row.
    fn of(&self, block: &History) -> Vec<f64> {
        match self {
            Self::Number(list) => list(block).to_vec(),
            Self::Energy(part) => block.energy.iter().map(part).collect(),
            Self::Ground(motion) => block.time.iter().map(|t| motion.at(*t)).collect(),
            Self::Forces(forces, storeys) => {
                let mut values = vec![0.0; storeys * block.len()];
                for (row, time) in values.chunks_exact_mut(*storeys).zip(&block.time) {
                    for force in forces {
                        // Accelerations are those before a jump.
                        row[force.storey] += force.history.before(*time);
                    }
                }
                values
            }
            Self::Column(list, index) => block.column(list(block), *index),
            Self::Columns(list, range) => block.columns(list(block), range.clone()),
            Self::Sums(list, columns) => {
                let list = list(block);
                let rows = list.chunks_exact((list.len() / block.len().max(1)).max(1));
                let sum =
                    |row: &[f64], of: &Vec<usize>| of.iter().map(|c| row[*c]).reduce(|a, b| a + b);
                rows.flat_map(|row| columns.iter().map(move |of| sum(row, of).unwrap_or(0.0)))
                    .collect()
            }
            Self::OverHeights(range, height) => {
                let mut values = block.columns(&block.drift, range.clone());
                for row in values.chunks_exact_mut(range.len().max(1)) {
                    for (drift, h) in row.iter_mut().zip(height) {
                        *drift *= 1.0 / h;
                    }
                }
                values
            }
            Self::DriftRatios(range, height) => {
                let mut values = block.columns(&block.displacement, range.clone());
                for row in values.chunks_exact_mut(range.len().max(1)) {
                    let mut below = 0.0;
                    for (u, h) in row.iter_mut().zip(height) {
                        let drift = *u - below;
                        below = std::mem::replace(u, drift * (1.0 / h));
                    }
                }
                values
            }
        }
    }
}
