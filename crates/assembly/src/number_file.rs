//! Files of plain numbers: matrices of buildings, histories of forces.

use std::io::Read;
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
    /// A file that cannot be read, what is no number, too many rows or columns; where lines may have names, rows of
    /// another number of columns than these, or than the first.
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
        let text = self.text(source)?;
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .comment(Some(b'#'))
            .delimiter(separator(&text))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
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
                    let help = match finite(&text.replacen(',', ".", 1)) {
                        Some(_) => {
                            "write decimal points, and no separators of thousands".to_owned()
                        }
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
            if self.header {
                let columns = rows.first().map_or(0, Vec::len);
                if rows.len() == 1
                    && let Some(names) = &mut names
                {
                    fit(names, columns);
                }
                let (expected, what) = match &names {
                    Some(names) => (names.len(), "the names above are"),
                    None => (columns, "the first row has"),
                };
                if record.len() != expected {
                    let found = counted(record.len(), "column");
                    let message = format!("line {line} has {found} where {what} {expected}");
                    return Err((message, COLUMNS.to_owned()));
                }
            }
        }
        Ok(Numbers { names, rows })
    }

    /// The text, with every line ended alike.
    fn text(&self, source: impl Read) -> Result<String, Refused> {
        let mut bytes = Vec::new();
        let read = source.take(LARGEST + 1).read_to_end(&mut bytes);
        read.map_err(|e| self.unreadable(&e))?;
        if bytes.len() as u64 > LARGEST {
            let message = format!("it has more than {} MB", LARGEST / 1_000_000);
            return Err((message, format!("write {}", self.rows)));
        }
        if is_wide(&bytes) {
            let message = "the text is UTF-16, whose characters have two bytes".to_owned();
            return Err((message, "save it as UTF-8".to_owned()));
        }
        // A name in another encoding is a name all the same; a number is none.
        let text = match String::from_utf8(bytes) {
            Ok(text) => text,
            Err(error) => String::from_utf8_lossy(error.as_bytes()).into_owned(),
        };
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        Ok(text.replace("\r\n", "\n").replace('\r', "\n"))
    }
}

/// The largest file (bytes): more than any with so many lines needs.
const LARGEST: u64 = 256_000_000;

/// What to do about rows of another number of columns.
const COLUMNS: &str = "write as many numbers in every row as there are columns, each with a name if any has one; no comma stands in a number: 1200, 0.5";

/// Takes away what is no name of a column: an empty one behind a comma at the end of the line. The name of a single column
/// may have commas.
fn fit(names: &mut Vec<String>, columns: usize) {
    while names.len() > columns && names.last().is_some_and(String::is_empty) {
        names.pop();
    }
    if columns == 1 {
        *names = vec![names.join(", ")];
    }
}

/// What separates the columns: what stands between numbers in the first row of them.
fn separator(text: &str) -> u8 {
    let lines = text.lines().map(str::trim);
    let rows = lines.filter(|line| !line.is_empty() && !line.starts_with('#'));
    let mut rows = rows.filter(|line| !is_name(line.trim_start_matches('"')));
    let row = rows.next().unwrap_or_default();
    let is_number = |field: &str| field.trim().trim_matches('"').parse::<f64>().is_ok();
    let stands = |c: &char| row.contains(*c);
    let parts = |c: &char| stands(c) && row.split(*c).all(is_number);
    let known = [';', '\t', ','];
    let found = known.iter().find(|c| parts(c));
    let found = found.or_else(|| known.iter().find(|c| stands(c)));
    found.map_or(b',', |c| *c as u8)
}

/// Whether a text is in characters of two bytes: by the mark at its start, or by the zeros in it.
fn is_wide(bytes: &[u8]) -> bool {
    let marked = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    marked || bytes.iter().take(2).any(|b| *b == 0)
}

/// Whether a text names a column; a number that is spelled wrongly, or has its unit, does not.
fn is_name(text: &str) -> bool {
    !text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
}
