//! Tables of reference values that are part of this crate.

use crate::error::VerificationError;

/// A row of a table.
pub(super) struct Row<const N: usize> {
    file: &'static str,
    line: u64,
    pub(super) cells: [String; N],
}

impl<const N: usize> Row<N> {
    /// The number in a column.
    pub(super) fn number(&self, column: usize) -> Result<f64, VerificationError> {
        let cell = &self.cells[column];
        let value = cell.parse().ok().filter(|value: &f64| value.is_finite());
        value.ok_or_else(|| self.error(format!("\"{cell}\" is no number")))
    }

    /// What is wrong with it.
    pub(super) fn error(&self, problem: String) -> VerificationError {
        VerificationError::Table {
            file: self.file,
            line: self.line,
            problem,
        }
    }
}

/// The rows of a table of `N` columns with a header; lines that begin with `#` are comments.
pub(super) fn rows<const N: usize>(
    file: &'static str,
    text: &str,
) -> Result<Vec<Row<N>>, VerificationError> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let mut found = Vec::new();
    for record in reader.records() {
        let wrong = |line, problem| VerificationError::Table {
            file,
            line,
            problem,
        };
        let record = record.map_err(|e| {
            let line = e.position().map_or(0, csv::Position::line);
            wrong(line, e.to_string())
        })?;
        let line = record.position().map_or(0, csv::Position::line);
        let cells: Vec<String> = record.iter().map(str::to_owned).collect();
        let cells = cells
            .try_into()
            .map_err(|cells: Vec<String>| wrong(line, format!("{} cells, not {N}", cells.len())))?;
        found.push(Row { file, line, cells });
    }
    Ok(found)
}
