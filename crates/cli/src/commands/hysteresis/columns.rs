//! Columns of measured or prescribed numbers, units in the header.

use std::ops::Range;
use std::path::Path;

use pounding_case::{Dimension, parse_quantity};

use crate::commands::impact::measured::{Columns, fields, looks_numeric, unit_in};
use crate::failure::Failure;

/// What a column holds.
#[derive(Clone, Copy)]
pub struct Column {
    /// Name, for messages.
    pub name: &'static str,
    /// Dimension of its unit.
    pub dimension: Dimension,
}

/// A file of columns.
pub struct Source {
    name: String,
    text: String,
    example: &'static str,
}

/// Rows of SI values, each with its place in the file.
pub type Rows = Vec<(Range<usize>, Vec<f64>)>;

impl Source {
    /// Opens a text file; `example` is a header as it should be.
    pub fn open(path: &Path, option: &str, example: &'static str) -> Result<Self, Failure> {
        let name = path.display().to_string();
        // A device or a pipe may never end.
        let regular = match std::fs::metadata(path) {
            Ok(found) if !found.is_file() => Err(std::io::Error::other("this is no regular file")),
            found => found.map(|_| ()),
        };
        let text = regular
            .and_then(|()| std::fs::read_to_string(path))
            .map_err(|e| {
                Failure::input(
                    format!("cannot read {name}: {e}"),
                    Some(format!(
                        "{option} takes a text file with a header such as {example}"
                    )),
                )
            })?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text).to_owned();
        Ok(Self {
            name,
            text,
            example,
        })
    }

    /// Reads the rows under a header in one of these layouts. Lines that start with `#`
    /// are comments.
    pub fn rows(&self, layouts: &[&[Column]]) -> Result<Rows, Failure> {
        let mut lines = self.lines();
        let Some((place, header)) = lines.next() else {
            return Err(self.error(0..0, "the file is empty".to_owned(), &self.header_help()));
        };
        if header.iter().any(|field| looks_numeric(field)) {
            return Err(self.error(
                place,
                "the units of the columns are not known".to_owned(),
                &self.header_help(),
            ));
        }
        let Some(layout) = layouts.iter().find(|l| l.len() == header.len()) else {
            return Err(self.columns(place, header.len(), layouts));
        };
        let sizes = self.sizes(&place, &header, layout)?;
        let mut rows = Rows::new();
        for (place, fields) in lines {
            if fields.len() != layout.len() {
                return Err(self.columns(place, fields.len(), &[*layout]));
            }
            let row = fields
                .iter()
                .zip(&sizes)
                .map(|(field, size)| Ok(self.number(&place, field)? * size))
                .collect::<Result<Vec<f64>, Failure>>()?;
            rows.push((place, row));
        }
        Ok(rows)
    }

    /// Sizes of the header's units in SI.
    fn sizes(
        &self,
        place: &Range<usize>,
        header: &[String],
        layout: &[Column],
    ) -> Result<Vec<f64>, Failure> {
        let size = |(field, column): (&String, &Column)| {
            let unit = unit_in(field).ok_or_else(|| {
                let message = format!("the unit of the {} column is not known", column.name);
                self.error(place.clone(), message, &self.header_help())
            })?;
            // Energies, which case files do not need, in the terms of those.
            let known = match unit {
                // Our own files spell their headers in small letters.
                "J" | "j" => "N m",
                "kJ" | "kj" => "kN m",
                "mJ" => "N mm",
                unit => unit,
            };
            match parse_quantity(&format!("1 {known}")) {
                Ok(q) if q.dimension == Some(column.dimension) => Ok(q.value),
                Ok(q) => {
                    let found = q.dimension.unwrap_or(Dimension::NUMBER);
                    let message = format!(
                        "the {} column is in \"{unit}\", which is {found}, not {}",
                        column.name, column.dimension
                    );
                    Err(self.error(place.clone(), message, &self.header_help()))
                }
                Err(e) => {
                    let message = format!("\"{unit}\" is no unit of the {} column", column.name);
                    Err(self.error(place.clone(), message, &e.help()))
                }
            }
        };
        header.iter().zip(layout).map(size).collect()
    }

    fn number(&self, place: &Range<usize>, field: &str) -> Result<f64, Failure> {
        match field.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(self.error(
                place.clone(),
                format!("\"{field}\" is not a finite number"),
                "write numbers as 12.5 or 1.25e1 with a decimal point; leave out rows without a value",
            )),
        }
    }

    /// Lines with content: their places and fields.
    fn lines(&self) -> impl Iterator<Item = (Range<usize>, Columns)> {
        let mut start = 0;
        self.text.split_inclusive('\n').filter_map(move |line| {
            let content = line.trim_end();
            let place = start..start + content.len();
            start += line.len();
            let skipped = content.trim().is_empty() || content.trim_start().starts_with('#');
            (!skipped).then(|| (place, fields(content)))
        })
    }

    fn columns(&self, place: Range<usize>, found: usize, layouts: &[&[Column]]) -> Failure {
        let list = |layout: &&[Column]| -> String {
            let names: Vec<_> = layout.iter().map(|c| c.name).collect();
            names.join(", ")
        };
        let wanted: Vec<_> = layouts.iter().map(list).collect();
        self.error(
            place,
            format!(
                "the number of columns here is {found}, but wanted are {}",
                wanted.join("; or ")
            ),
            "separate columns by comma, semicolon, tab or blanks, and write numbers with a decimal point",
        )
    }

    fn header_help(&self) -> String {
        format!("write a header line with units such as `{}`", self.example)
    }

    /// An error at a place of the file.
    pub fn error(&self, place: Range<usize>, message: String, help: &str) -> Failure {
        Failure::in_file(&self.name, &self.text, place, message, help)
    }
}
