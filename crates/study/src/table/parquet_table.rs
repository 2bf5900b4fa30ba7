//! The rows as a Parquet table: a row per run, a column for every variable and value, of the
//! same names as in CSV.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, FloatType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

/// Rows that are held until they are written together.
const GROUP: usize = 8192;

/// A cell of a row.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Cell {
    /// A whole number.
    Whole(i64),
    /// A number; NaN where it is missing.
    Number(f64),
    /// The same with 32 bits.
    Single(f32),
    /// A word.
    Text(String),
}

/// A column that waits to be written.
#[derive(Debug)]
enum Column {
    Whole(Vec<i64>),
    Number(Vec<f64>),
    Single(Vec<f32>),
    Text(Vec<ByteArray>),
}

/// Writes a Parquet file row group by row group.
pub(super) struct ParquetTable {
    writer: SerializedFileWriter<File>,
    columns: Vec<Column>,
    rows: usize,
}

impl std::fmt::Debug for ParquetTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "ParquetTable with {} columns", self.columns.len())
    }
}

impl ParquetTable {
    /// Begins a table whose columns have the types of these cells.
    pub(super) fn create(
        path: &Path,
        names: &[String],
        kinds: &[Cell],
    ) -> Result<Self, std::io::Error> {
        let file = File::create(path)?;
        let fields = names.iter().zip(kinds).map(|(name, kind)| {
            let field = match kind {
                Cell::Whole(_) => Type::primitive_type_builder(name, Physical::INT64),
                Cell::Number(_) => Type::primitive_type_builder(name, Physical::DOUBLE),
                Cell::Single(_) => Type::primitive_type_builder(name, Physical::FLOAT),
                Cell::Text(_) => Type::primitive_type_builder(name, Physical::BYTE_ARRAY)
                    .with_logical_type(Some(LogicalType::String)),
            };
            field
                .with_repetition(Repetition::REQUIRED)
                .build()
                .map(Arc::new)
        });
        let fields = fields.collect::<Result<Vec<_>, _>>().map_err(plain)?;
        let schema = Type::group_type_builder("runs").with_fields(fields).build();
        let properties = Arc::new(WriterProperties::builder().build());
        let schema = Arc::new(schema.map_err(plain)?);
        let columns = kinds.iter().map(|kind| match kind {
            Cell::Whole(_) => Column::Whole(Vec::new()),
            Cell::Number(_) => Column::Number(Vec::new()),
            Cell::Single(_) => Column::Single(Vec::new()),
            Cell::Text(_) => Column::Text(Vec::new()),
        });
        Ok(Self {
            writer: SerializedFileWriter::new(file, schema, properties).map_err(plain)?,
            columns: columns.collect(),
            rows: 0,
        })
    }

    /// Adds a row with a cell of the right kind for every column.
    pub(super) fn push(&mut self, cells: Vec<Cell>) -> Result<(), std::io::Error> {
        for (column, cell) in self.columns.iter_mut().zip(cells) {
            match (column, cell) {
                (Column::Whole(all), Cell::Whole(x)) => all.push(x),
                (Column::Number(all), Cell::Number(x)) => all.push(x),
                (Column::Single(all), Cell::Single(x)) => all.push(x),
                (Column::Text(all), Cell::Text(x)) => all.push(x.as_str().into()),
                (_, cell) => {
                    let text = format!("{cell:?} does not belong into its column");
                    return Err(std::io::Error::other(text));
                }
            }
        }
        self.rows += 1;
        if self.rows == GROUP {
            self.write_group().map_err(plain)?;
        }
        Ok(())
    }

    /// Writes what is left, and the end of the file.
    pub(super) fn finish(mut self) -> Result<(), std::io::Error> {
        if self.rows > 0 {
            self.write_group().map_err(plain)?;
        }
        self.writer.close().map(|_| ()).map_err(plain)
    }

    fn write_group(&mut self) -> Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        for column in &mut self.columns {
            let Some(mut writer) = group.next_column()? else {
                break;
            };
            match column {
                Column::Whole(all) => {
                    writer.typed::<Int64Type>().write_batch(all, None, None)?;
                    all.clear();
                }
                Column::Number(all) => {
                    writer.typed::<DoubleType>().write_batch(all, None, None)?;
                    all.clear();
                }
                Column::Single(all) => {
                    writer.typed::<FloatType>().write_batch(all, None, None)?;
                    all.clear();
                }
                Column::Text(all) => {
                    writer
                        .typed::<ByteArrayType>()
                        .write_batch(all, None, None)?;
                    all.clear();
                }
            }
            writer.close()?;
        }
        group.close()?;
        self.rows = 0;
        Ok(())
    }
}

fn plain(e: ParquetError) -> std::io::Error {
    std::io::Error::other(e.to_string())
}
