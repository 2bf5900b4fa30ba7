//! Text files of columns of numbers, units in the header.

use std::ops::Range;
use std::path::Path;

use pounding_case::{Dimension, parse_quantity, unit_in};

use pounding_files::input::read_to_string;

use crate::failure::Failure;

/// What a column holds.
#[derive(Clone, Copy)]
pub struct Column {
    /// Name, for messages.
    pub name: &'static str,
    /// Dimension of its unit.
    pub dimension: Dimension,
}

/// A file of columns. Lines that start with `#` are comments.
pub struct Source {
    name: String,
    text: String,
    /// A header as it should be.
    example: &'static str,
}

/// The fields of a line.
pub type Fields = Vec<String>;

/// Rows of SI values, each with its place in the file.
pub type Rows = Vec<(Range<usize>, Vec<f64>)>;

impl Source {
    /// Opens the text file of an option; `example` is a header as it should be.
    pub fn of_option(path: &Path, option: &str, example: &'static str) -> Result<Self, Failure> {
        let help = format!("{option} takes a text file with a header such as {example}");
        Self::open(path, &help, example)
    }

    /// Opens a text file, with `help` for what is none.
    pub fn open(path: &Path, help: &str, example: &'static str) -> Result<Self, Failure> {
        let name = path.display().to_string();
        let text = read_to_string(path).map_err(|e| unreadable(&name, &e, help))?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text).to_owned();
        Ok(Self {
            name,
            text,
            example,
        })
    }

    /// Reads the rows under a header in one of these layouts.
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
        let sizes = header
            .iter()
            .zip(*layout)
            .map(|(field, column)| self.size(&place, field, column))
            .collect::<Result<Vec<f64>, Failure>>()?;
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

    /// Size in SI of the unit in a field of the header.
    fn size(&self, place: &Range<usize>, field: &str, column: &Column) -> Result<f64, Failure> {
        let unit = unit_in(field).ok_or_else(|| {
            let message = format!("the unit of the {} column is not known", column.name);
            self.error(place.clone(), message, &self.header_help())
        })?;
        column.size(unit).map_err(|(message, help)| {
            let help = help.unwrap_or_else(|| self.header_help());
            self.error(place.clone(), message, &help)
        })
    }

    /// A number of a row.
    pub fn number(&self, place: &Range<usize>, field: &str) -> Result<f64, Failure> {
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
    pub fn lines(&self) -> impl Iterator<Item = (Range<usize>, Fields)> {
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

fn unreadable(name: &str, error: &std::io::Error, help: &str) -> Failure {
    Failure::input(
        format!("cannot read {name}: {error}"),
        Some(help.to_owned()),
    )
}

impl Column {
    /// Size of a unit in SI, or what is wrong with it, with a remedy unless it is another unit.
    pub fn size(&self, unit: &str) -> Result<f64, (String, Option<String>)> {
        // Energies, which case files do not need, in the terms of those.
        let known = match unit {
            // Our own files spell their headers in small letters.
            "J" | "j" => "N m",
            "kJ" | "kj" => "kN m",
            "mJ" => "N mm",
            unit => unit,
        };
        match parse_quantity(&format!("1 {known}")) {
            Ok(q) if q.dimension == Some(self.dimension) => Ok(q.value),
            Ok(q) => {
                let found = q.dimension.unwrap_or(Dimension::NUMBER);
                let message = format!(
                    "the {} column is in \"{unit}\", which is {found}, not {}",
                    self.name, self.dimension
                );
                Err((message, None))
            }
            Err(e) => {
                let message = format!("\"{unit}\" is no unit of the {} column", self.name);
                Err((message, Some(e.help())))
            }
        }
    }
}

/// The fields of a line: separated by tab, semicolon, comma or else blanks.
fn fields(line: &str) -> Fields {
    let Some(separator) = ['\t', ';', ','].into_iter().find(|s| line.contains(*s)) else {
        return blank_separated(line);
    };
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .delimiter(separator as u8)
        .trim(csv::Trim::All)
        .from_reader(line.as_bytes());
    let record = reader.records().next().and_then(Result::ok);
    record.map_or_else(Vec::new, |r| r.iter().map(str::to_owned).collect())
}

/// A unit in brackets belongs to the word before it.
fn blank_separated(line: &str) -> Fields {
    let mut fields: Fields = Vec::new();
    for word in line.split_whitespace() {
        match fields.last_mut() {
            Some(last) if word.starts_with(['(', '[']) => last.push_str(word),
            _ => fields.push(word.to_owned()),
        }
    }
    fields
}

/// Damaged values are still numbers to this question: their row is no header.
pub fn looks_numeric(field: &str) -> bool {
    field.parse::<f64>().is_ok() || field.starts_with(|c: char| c.is_ascii_digit())
}
