//! Files of plain numbers: matrices of buildings, histories of forces.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use pounding_case::Case;
use pounding_catalogue::wording::counted;

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
        let mut source = BufReader::with_capacity(START, source);
        let start = source.fill_buf().map_err(|e| self.unreadable(&e))?;
        if is_wide(start) {
            let message = "the text is UTF-16, whose characters have two bytes".to_owned();
            return Err((message, "save it as UTF-8".to_owned()));
        }
        let separator = separator(start);
        // A line that ends by both characters would count from the second one on.
        let end = if start.contains(&b'\n') { b'\n' } else { b'\r' };
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .comment(Some(b'#'))
            .delimiter(separator)
            .terminator(csv::Terminator::Any(end))
            .trim(csv::Trim::All)
            .from_reader(source);
        let correct = || format!("write {}", self.rows);
        let Numbers {
            mut names,
            mut rows,
        } = Numbers::default();
        // How many columns there are, and what says so.
        let mut columns: Option<(usize, &str)> = None;
        for record in reader.records() {
            let record = record.map_err(|e| (e.to_string(), correct()))?;
            if record.iter().all(str::is_empty) {
                continue;
            }
            let finite = |text: &str| text.parse::<f64>().ok().filter(|x| x.is_finite());
            let is_text = record.iter().all(|text| text.parse::<f64>().is_err());
            let is_first = names.is_none() && rows.is_empty();
            if self.header && is_first && is_text && record.get(0).is_some_and(is_name) {
                columns = Some((record.len(), "the names above"));
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
                    let help = match finite(&text.replace(',', ".")) {
                        Some(_) => "write decimal points".to_owned(),
                        None => correct(),
                    };
                    (message, help)
                })
            };
            let (most, of) = self.most;
            if record.len() > most || rows.len() == most {
                let message = format!("it has more than {most} rows or columns, {of}");
                return Err((message, correct()));
            }
            let entries = record.iter().enumerate();
            rows.push(entries.map(number).collect::<Result<_, _>>()?);
            let (expected, what) = *columns.get_or_insert((record.len(), "the first row"));
            if self.header && record.len() != expected {
                let message = format!(
                    "line {line} has {} where {what} {} {expected}",
                    counted(record.len(), "column"),
                    if what == "the first row" {
                        "has"
                    } else {
                        "are"
                    },
                );
                let help = "write as many numbers in every row as there are columns, each with a name if any has one; no comma stands in a number: 1200, 0.5".to_owned();
                return Err((message, help));
            }
        }
        Ok(Numbers { names, rows })
    }
}

/// How much of a file tells how it is written.
const START: usize = 1 << 16;

/// What separates its columns: what stands in its first line.
fn separator(start: &[u8]) -> u8 {
    let lines = start.split(|b| matches!(b, b'\n' | b'\r'));
    let lines = lines.map(<[u8]>::trim_ascii);
    let mut first = lines.filter(|line| !line.is_empty() && !line.starts_with(b"#"));
    let first = first.next().unwrap_or_default();
    let mut known = [b';', b'\t'].into_iter();
    known.find(|b| first.contains(b)).unwrap_or(b',')
}

/// Whether a text is in characters of two bytes: by the mark at its start, or by the zeros in it.
fn is_wide(start: &[u8]) -> bool {
    let marked = start.starts_with(b"\xff\xfe") || start.starts_with(b"\xfe\xff");
    marked || start.iter().take(2).any(|b| *b == 0)
}

/// Whether a text names a column; a number that is spelled wrongly, or has its unit, does not.
fn is_name(text: &str) -> bool {
    !text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
}
