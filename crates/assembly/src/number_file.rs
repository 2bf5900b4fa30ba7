//! Files of plain numbers: matrices of buildings, histories of forces.

use std::io::Read;
use std::path::Path;

use pounding_case::Case;

/// What a CSV file of numbers holds, for messages and limits.
pub(crate) struct NumberFile {
    /// What it is.
    pub what: &'static str,
    /// How it is written.
    pub rows: &'static str,
    /// Whether a first line that is no number names its columns.
    pub header: bool,
    /// The most rows or columns, and what they are.
    pub most: (usize, &'static str),
}

const PATH: &str = "name the file relative to the folder of the case file";

/// What is wrong, and what to do.
pub(crate) type Refused = (String, String);

/// What stands in a file.
#[derive(Default)]
pub(crate) struct Numbers {
    /// Names of the columns, if a first line has them.
    pub names: Option<Vec<String>>,
    /// Row by row.
    pub rows: Vec<Vec<f64>>,
}

impl NumberFile {
    /// The numbers in a file that a case names, row by row; lines that begin with `#` and empty
    /// ones are left out.
    ///
    /// # Errors
    /// A file that cannot be read, what is no number, too many rows or columns.
    pub(crate) fn read(&self, case: &Case, path: &Path) -> Result<Numbers, Refused> {
        let unreadable = |why: &dyn std::fmt::Display| self.unreadable(why);
        match case.given(path) {
            Some(bytes) => self.rows(bytes.map_err(|e| unreadable(&e))?),
            None => self.read_disk(&case.resolve(path)),
        }
    }

    fn unreadable(&self, why: &dyn std::fmt::Display) -> Refused {
        let message = format!("cannot read the {}: {why}", self.what);
        (message, PATH.to_owned())
    }

    fn read_disk(&self, path: &Path) -> Result<Numbers, Refused> {
        let unreadable = |why: &dyn std::fmt::Display| self.unreadable(why);
        // A device or a pipe may never end.
        match std::fs::metadata(path) {
            Ok(found) if found.is_dir() => return Err(unreadable(&"this is a folder")),
            Ok(found) if !found.is_file() => return Err(unreadable(&"this is no regular file")),
            _ => {}
        }
        self.rows(std::fs::File::open(path).map_err(|e| unreadable(&e))?)
    }

    fn rows(&self, source: impl Read) -> Result<Numbers, Refused> {
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(source);
        let correct = || format!("write {}", self.rows);
        let Numbers {
            mut names,
            mut rows,
        } = Numbers::default();
        for (place, record) in reader.records().enumerate() {
            let record = record.map_err(|e| (e.to_string(), correct()))?;
            let finite = |text: &str| text.parse::<f64>().ok().filter(|x| x.is_finite());
            let is_header = self.header && place == 0;
            let is_text = record.iter().all(|text| text.parse::<f64>().is_err());
            if is_header && is_text && record.get(0).is_some_and(is_name) {
                names = Some(record.iter().map(str::to_owned).collect());
                continue;
            }
            let line = record.position().map_or(0, csv::Position::line);
            let number = |(column, text): (usize, &str)| {
                finite(text).ok_or_else(|| {
                    let message = format!(
                        "line {line}, column {}: \"{text}\" is no number",
                        column + 1
                    );
                    (message, correct())
                })
            };
            let (most, of) = self.most;
            if record.len() > most || rows.len() == most {
                let message = format!("it has more than {most} rows or columns, {of}");
                return Err((message, correct()));
            }
            let entries = record.iter().enumerate();
            rows.push(entries.map(number).collect::<Result<_, _>>()?);
        }
        Ok(Numbers { names, rows })
    }
}

/// Whether a text names a column; a number that is spelled wrongly, or has its unit, does not.
fn is_name(text: &str) -> bool {
    !text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
}
