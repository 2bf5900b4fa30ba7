//! Readers, one format a file, and the detection of the format by content.

mod peer_at2;
mod plain_columns;
mod pounding_csv;

use std::path::Path;

use sha2::{Digest, Sha256};

use crate::accelerogram::{Accelerogram, Origin};
use crate::error::GroundMotionError;
use crate::number;
use crate::unit::AccelerationUnit;

/// A record format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Our CSV layout: comment header, column header, time and acceleration.
    PoundingCsv,
    /// PEER strong-motion database, AT2.
    PeerAt2,
    /// Plain columns of numbers with declared layout and unit.
    PlainColumns,
}

impl Format {
    /// All formats in the order of detection.
    pub const ALL: [Self; 3] = [Self::PoundingCsv, Self::PeerAt2, Self::PlainColumns];

    /// Name in the case file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::PoundingCsv => "pounding_csv",
            Self::PeerAt2 => "peer_at2",
            Self::PlainColumns => "plain_columns",
        }
    }

    /// The format of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|f| f.name() == name)
    }
}

/// What the user says about a record.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ReadOptions {
    /// Format; `None`: found from the content.
    pub format: Option<Format>,
    /// Time step (s), for files that do not state it.
    pub time_step: Option<f64>,
    /// Unit, for files that do not state it.
    pub unit: Option<AccelerationUnit>,
    /// Layout of plain columns: `"a"` (values along the rows) or column names such
    /// as `"t,ns,ew,v"`.
    pub layout: Option<String>,
    /// Column to use, by its name in the layout.
    pub component: Option<String>,
    /// Lines to skip at the start of plain columns.
    pub skip_lines: usize,
    /// Puts a zero before the first value, which is then at one time step.
    pub prepend_zero: bool,
    /// Accepts fewer samples than the header says, with a warning.
    pub lenient: bool,
}

/// A file's text with what is needed to point into it.
pub(crate) struct Source<'a> {
    pub file: &'a str,
    pub lines: Vec<&'a str>,
    pub options: &'a ReadOptions,
}

/// What a reader found.
pub(crate) struct Found {
    pub samples: Vec<f64>,
    pub unit: AccelerationUnit,
    pub unit_source: &'static str,
    pub time_step: f64,
    pub time_step_source: &'static str,
    pub title: String,
    pub header_count: Option<usize>,
    pub warnings: Vec<String>,
}

impl Source<'_> {
    pub(crate) fn error(
        &self,
        line: usize,
        column: usize,
        message: String,
        remedy: &str,
    ) -> GroundMotionError {
        GroundMotionError::Parse {
            file: self.file.to_owned(),
            line: line + 1,
            column: column + 1,
            message,
            remedy: remedy.to_owned(),
        }
    }

    /// A number of line `line` that starts at byte `column`.
    pub(crate) fn number(
        &self,
        line: usize,
        column: usize,
        text: &str,
    ) -> Result<f64, GroundMotionError> {
        number::parse(text).map_err(|message| {
            self.error(
                line,
                column,
                message,
                "correct the value, or get the record again: no sample may be missing",
            )
        })
    }

    /// The time step of the file against that of the user.
    pub(crate) fn time_step(
        &self,
        stated: Option<f64>,
        line: usize,
    ) -> Result<(f64, &'static str), GroundMotionError> {
        let (step, source) = match (stated, self.options.time_step) {
            (None, None) => {
                return Err(GroundMotionError::MissingTimeStep {
                    file: self.file.to_owned(),
                    line: line + 1,
                });
            }
            (Some(a), Some(b)) if (a - b).abs() > 1.0e-6 * a.abs() => {
                return Err(GroundMotionError::Contradiction {
                    file: self.file.to_owned(),
                    quantity: "time_step",
                    stated: format!("{a} s"),
                    given: format!("{b} s"),
                });
            }
            (Some(a), _) => (a, "stated in the file"),
            (None, Some(b)) => (b, "given in the case"),
        };
        if step.is_finite() && step > 0.0 {
            Ok((step, source))
        } else {
            Err(self.error(
                line,
                0,
                format!("time step {step} s must be greater than zero"),
                "correct the header, or give `time_step` in [ground_motion]",
            ))
        }
    }

    /// The unit of the file against that of the user.
    pub(crate) fn unit(
        &self,
        stated: Option<AccelerationUnit>,
        line: usize,
        peak: f64,
    ) -> Result<(AccelerationUnit, &'static str), GroundMotionError> {
        match (stated, self.options.unit) {
            (Some(a), Some(b)) if a != b => Err(GroundMotionError::Contradiction {
                file: self.file.to_owned(),
                quantity: "unit",
                stated: a.symbol().to_owned(),
                given: b.symbol().to_owned(),
            }),
            (Some(a), _) => Ok((a, "stated in the file")),
            (None, Some(b)) => Ok((b, "given in the case")),
            (None, None) => Err(GroundMotionError::MissingUnit {
                file: self.file.to_owned(),
                line: line + 1,
                hint: if peak > 20.0 {
                    format!(" (the largest value, {peak}, is too large for g)")
                } else {
                    String::new()
                },
            }),
        }
    }

    /// Holds the count found against the header's.
    pub(crate) fn count(
        &self,
        samples: &mut Vec<f64>,
        expected: Option<usize>,
        warnings: &mut Vec<String>,
    ) -> Result<(), GroundMotionError> {
        let Some(expected) = expected else {
            return Ok(());
        };
        let found = samples.len();
        if found < expected {
            if !self.options.lenient {
                return Err(GroundMotionError::TooFewSamples {
                    file: self.file.to_owned(),
                    line: self.lines.len(),
                    expected,
                    found,
                });
            }
            warnings.push(format!(
                "header says {expected} samples, {found} found and used"
            ));
        } else if found > expected {
            if found == expected + 1 {
                warnings.push(format!(
                    "header says {expected} samples, one more found and used"
                ));
            } else {
                warnings.push(format!(
                    "header says {expected} samples, {found} found; the surplus is not used"
                ));
                samples.truncate(expected);
            }
        }
        Ok(())
    }
}

/// Reads a record from a file.
///
/// # Errors
/// A file that cannot be read, or whatever is wrong with its content, with file,
/// line and remedy.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Accelerogram, GroundMotionError> {
    let file = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|source| GroundMotionError::Io {
        file: file.clone(),
        source,
    })?;
    read_bytes(&file, &bytes, options)
}

/// Reads a record from bytes; `file` names it in messages.
///
/// # Errors
/// As [`read`].
pub fn read_bytes(
    file: &str,
    bytes: &[u8],
    options: &ReadOptions,
) -> Result<Accelerogram, GroundMotionError> {
    // Latin-1: every byte is a character, so no header can stop the reader.
    let body = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text: String = body.iter().map(|b| char::from(*b)).collect();
    let source = Source {
        file,
        lines: text.split('\n').map(|l| l.trim_end()).collect(),
        options,
    };
    let format = match options.format {
        Some(format) => format,
        None => detect(&source)?,
    };
    let mut found = match format {
        Format::PoundingCsv => pounding_csv::read(&source)?,
        Format::PeerAt2 => peer_at2::read(&source)?,
        Format::PlainColumns => plain_columns::read(&source)?,
    };
    if options.prepend_zero {
        found.samples.insert(0, 0.0);
        found
            .warnings
            .push("a zero was put before the first value".to_owned());
    }
    let sha256 = Sha256::digest(bytes)
        .iter()
        .map(|b| format!("{b:02x}"))
        .collect();
    let accelerogram = Accelerogram::new(found.samples, found.unit, found.time_step)
        .map_err(|e| GroundMotionError::Invalid(format!("{file}: {e}")))?;
    Ok(accelerogram.with_origin(Origin {
        file: file.to_owned(),
        format: format.name(),
        title: found.title,
        unit: format!("{} ({})", found.unit.symbol(), found.unit_source),
        time_step: format!("{} s ({})", found.time_step, found.time_step_source),
        header_count: found.header_count,
        sha256,
        warnings: found.warnings,
    }))
}

fn detect(source: &Source<'_>) -> Result<Format, GroundMotionError> {
    if pounding_csv::matches(source) {
        Ok(Format::PoundingCsv)
    } else if peer_at2::matches(source) {
        Ok(Format::PeerAt2)
    } else if plain_columns::matches(source) {
        Ok(Format::PlainColumns)
    } else {
        Err(GroundMotionError::UnknownFormat {
            file: source.file.to_owned(),
        })
    }
}

/// Blank-separated fields with their byte columns.
pub(crate) fn fields(line: &str) -> impl Iterator<Item = (usize, &str)> {
    line.split([' ', '\t', ',', ';', '\r'])
        .filter(|f| !f.is_empty())
        .map(move |f| (f.as_ptr() as usize - line.as_ptr() as usize, f))
}
