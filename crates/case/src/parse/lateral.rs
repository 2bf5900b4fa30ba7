//! What resists the lateral motion of a building that is no chain of storeys.

use std::ops::Range;

use pounding_catalogue::wording::{agreeing, counted};
use schemars::JsonSchema;
use serde::Deserialize;

use super::scale::FilePath;
use super::spread;
use crate::document::{
    Dimensioned, Fault, FlexuralRigidity, Force, Length, OneOrEach, Positive, Reader, Signed,
    TableOr, Written,
};
use crate::located::Located;
use crate::types::{Lateral, MatrixSource};

/// Rows of a matrix, or the file that holds them.
pub(super) type MatrixValue<D> = TableOr<MatrixFile, Rows<D>>;

/// Rows of a matrix.
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    bound = "",
    expecting = "a list of rows, or a table\nwrite [[...], [...]] with one row per floor, bottom first, or { file = \"K.csv\", unit = \"kN/mm\" }"
)]
#[schemars(bound = "")]
pub(super) struct Rows<D: Dimensioned>(Vec<Vec<Signed<D>>>);

/// File of a matrix
#[derive(Clone, Deserialize, JsonSchema)]
pub(super) struct MatrixFile {
    /// CSV file with one row per floor, bottom first, and no header
    file: Located<FilePath>,
    /// Unit of its numbers; by default SI
    unit: Option<Located<Written>>,
}

/// Cantilever wall
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    expecting = "a table\nfor example { flexural_rigidity = \"6 GN m2\" }, with shear_rigidity where the wall deforms in shear too"
)]
pub(super) struct CantileverTable {
    /// Flexural rigidity E I (N m2), one for all storeys or a list, bottom first
    flexural_rigidity: Located<OneOrEach<Positive<FlexuralRigidity>>>,
    /// Shear rigidity kappa G A (N), one for all storeys or a list; by default rigid in shear
    shear_rigidity: Option<Located<OneOrEach<Positive<Force>>>>,
}

/// Frame with flexible beams, its columns and beams lumped
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    expecting = "a table\nfor example { columns = \"240 MN m2\", beams = \"150 MN m2\", span = \"6 m\" }"
)]
pub(super) struct FishboneTable {
    /// Flexural rigidity E I of all columns of a storey together (N m2), one for all storeys
    /// or a list, bottom first
    columns: Located<OneOrEach<Positive<FlexuralRigidity>>>,
    /// Flexural rigidity E I of all beams of a floor together (N m2), one for all floors or a
    /// list, bottom first
    beams: Located<OneOrEach<Positive<FlexuralRigidity>>>,
    /// Span of the beams between column axes (m), one for all floors or a list
    span: Located<OneOrEach<Positive<Length>>>,
}

/// A matrix at its key.
pub(super) fn matrix<D: Dimensioned>(
    reader: &Reader<'_>,
    value: MatrixValue<D>,
    place: &Range<usize>,
    storeys: usize,
) -> Option<MatrixSource> {
    let table = match value {
        TableOr::Table(table) => table,
        TableOr::Value(Rows(rows)) => {
            let wrong = rows.iter().position(|row| row.len() != storeys);
            if let Some(row) = wrong.filter(|_| rows.len() == storeys) {
                return reader.refuse(
                    place.clone(),
                    format!(
                        "row {} has {} {} for {}",
                        row + 1,
                        rows[row].len(),
                        agreeing(&rows[row].len(), "entry", "entries"),
                        counted(storeys, "floor")
                    ),
                    "give one row per floor, bottom first, with one entry per floor",
                );
            }
            let rows = rows.into_iter();
            let numbers = |row: Vec<Signed<D>>| row.into_iter().map(f64::from).collect();
            return Some(MatrixSource::Rows(rows.map(numbers).collect()));
        }
    };
    let unit = match table.unit {
        None => 1.0,
        Some(unit) => unit_of::<D>(reader, unit)?,
    };
    Some(MatrixSource::File {
        file: table.file.into(),
        unit,
    })
}

/// A unit of this dimension in SI units.
pub(super) fn unit_of<D: Dimensioned>(reader: &Reader<'_>, unit: Located<Written>) -> Option<f64> {
    let text = unit.value.as_written().to_owned();
    if text.trim().is_empty() {
        return reader.refuse(
            unit.span,
            "`unit` is empty",
            "write the unit, such as \"kN/mm\", or leave it out for SI",
        );
    }
    let one = Written::of_text(format!("1 {text}")).of(D::DIMENSION);
    let one = one.map_err(|fault| Fault {
        message: fault.message.replace(&format!("1 {text}"), &text),
        ..fault
    });
    reader.keep(&unit.span, "unit", one)
}

/// Number of rows that are written.
pub(super) fn rows<D: Dimensioned>(value: &MatrixValue<D>) -> Option<usize> {
    match value {
        TableOr::Value(Rows(rows)) => Some(rows.len()),
        TableOr::Table(_) => None,
    }
}

impl CantileverTable {
    pub(super) fn read(self, reader: &Reader<'_>, storeys: usize) -> Option<Lateral> {
        let flexural_rigidity = spread(reader, self.flexural_rigidity, storeys, "storey")?;
        let shear_rigidity = match self.shear_rigidity {
            Some(rigidity) => Some(spread(reader, rigidity, storeys, "storey")?),
            None => None,
        };
        Some(Lateral::Cantilever {
            flexural_rigidity,
            shear_rigidity,
        })
    }
}

impl FishboneTable {
    pub(super) fn read(self, reader: &Reader<'_>, storeys: usize) -> Option<Lateral> {
        let columns = spread(reader, self.columns, storeys, "storey");
        let beams = spread::<_, f64, 1>(reader, self.beams, storeys, "floor");
        let span = spread::<_, f64, 1>(reader, self.span, storeys, "floor");
        let stiffness = beams?.into_iter().zip(span?);
        Some(Lateral::Fishbone {
            columns: columns?,
            beam_stiffness: stiffness.map(|(beam, span)| 12.0 * beam / span).collect(),
        })
    }
}
