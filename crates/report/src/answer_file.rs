//! Files of answers: what `gap`, `compare` and `motion info` answer, stored so that a page is
//! made of it again.
//!
//! A file is one JSON object: `schema` and `schema_version` say what it is, `command` and
//! `pounding` who made it, `answer` is what the command prints with `--json`, `inputs` has title,
//! hashes and texts of the files that were read, `figures` the curves of each figure, and `sha256` is the
//! hash of all the others, written without spaces and with keys in alphabetical order.

use std::path::{Path, PathBuf};

use pounding_files::checksum::hexadecimal;
use serde::{Deserialize, Serialize};
use serde_json::error::Category;
use serde_json::{Deserializer, Value, json};
use sha2::{Digest, Sha256};
use thiserror::Error;

use crate::chart::{Chart, Plot};

/// Value of `schema` in every file of an answer.
pub const SCHEMA: &str = "pounding answer";
/// Version of the schema that is written, the latest that is read.
pub const SCHEMA_VERSION: u64 = 1;

/// A command whose answers have files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum AnsweredCommand {
    /// `pounding gap`.
    #[serde(rename = "gap")]
    Gap,
    /// `pounding compare`.
    #[serde(rename = "compare")]
    Compare,
    /// `pounding motion info`.
    #[serde(rename = "motion info")]
    MotionInfo,
}

impl AnsweredCommand {
    /// Its words on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Gap => "gap",
            Self::Compare => "compare",
            Self::MotionInfo => "motion info",
        }
    }
}

/// What a command answers, with all that its page shows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answered {
    /// Who answers.
    pub command: AnsweredCommand,
    /// Inputs, hashes, version.
    pub inputs: Inputs,
    /// What it prints with `--json`.
    pub answer: Value,
    /// What it draws.
    pub figures: Vec<Picture>,
}

/// A picture of a page, and what it shows in words.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// What it is called, by which a page finds the place of it.
    pub(crate) name: String,
    /// For those who do not see it.
    pub(crate) words: String,
    /// What is drawn.
    pub(crate) plots: Vec<Plot>,
}

impl Picture {
    /// A chart that is as wide as a page.
    #[must_use]
    pub fn of(name: &str, words: &str, chart: Chart) -> Self {
        Self {
            name: name.to_owned(),
            words: words.to_owned(),
            plots: chart.plots,
        }
    }

    /// Whether it can be drawn: one that stands in a file may hold anything.
    pub(crate) fn is_drawable(&self) -> bool {
        Chart::of_page(self.plots.clone()).is_drawable()
    }
}

/// What a page says of its inputs beside the answer.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Inputs {
    /// Title of the case or study.
    pub title: String,
    /// Below the title: command, file, version.
    pub origin: Vec<String>,
    /// What the user should know, beside warnings in the answer itself.
    pub warnings: Vec<String>,
    /// Names and values, such as hashes.
    pub facts: Vec<(String, String)>,
    /// Headings and texts of files that were read.
    pub listings: Vec<(String, String)>,
}

/// Why a file of an answer cannot be used.
#[derive(Debug, Error)]
pub enum AnswerFileError {
    /// The operating system cannot read it.
    #[error("{} cannot be read: {source}", path.display())]
    Read {
        /// File.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// It ends in the middle.
    #[error("{} is cut off: it ends at line {line}, column {column}, before its content does", path.display())]
    Truncated {
        /// File.
        path: PathBuf,
        /// Line, from one.
        line: usize,
        /// Column, from one.
        column: usize,
    },
    /// It is no JSON.
    #[error("{} is no JSON: {reason}", path.display())]
    NotJson {
        /// File.
        path: PathBuf,
        /// What is wrong, with line and column.
        reason: String,
    },
    /// It is JSON of something else.
    #[error("{} is not the result of `pounding`: {found}", path.display())]
    Foreign {
        /// File.
        path: PathBuf,
        /// What it is instead.
        found: &'static str,
        /// What to do about it.
        help: &'static str,
    },
    /// A later version of the program wrote it.
    #[error(
        "{} was written by pounding {writer} in version {version} of its schema; this program reads up to {SCHEMA_VERSION}",
        path.display()
    )]
    Newer {
        /// File.
        path: PathBuf,
        /// Version of the program that wrote it.
        writer: String,
        /// Version of the schema.
        version: String,
    },
    /// Its content is not that which was written.
    #[error("{} was changed after it was written: its content does not match its `sha256`", path.display())]
    Changed {
        /// File.
        path: PathBuf,
    },
    /// Its content is whole and has another shape.
    #[error("{} is not as `pounding` writes it: {reason}", path.display())]
    Shape {
        /// File.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
}

impl AnswerFileError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        let help = match self {
            Self::Read { .. } => return None,
            Self::Foreign { help, .. } => help,
            Self::Newer { writer, .. } => {
                return Some(format!("use pounding {writer} or later"));
            }
            Self::Truncated { .. } | Self::NotJson { .. } | Self::Changed { .. } => {
                "copy the file again from where it is whole, or run the command with --output again"
            }
            Self::Shape { .. } => "run the command with --output again",
        };
        Some(help.to_owned())
    }
}

/// What gives a file of an answer.
const WHICH: &str = "give what `pounding gap`, `compare` or `motion info` writes with --output FILE.json, or the .h5 file of a run or study";

impl Answered {
    /// The text of its file.
    #[must_use]
    pub fn text(&self) -> String {
        // Nothing in it has keys that are no texts: it is always an object.
        let mut content = json!(self);
        content["schema"] = json!(SCHEMA);
        content["schema_version"] = json!(SCHEMA_VERSION);
        content["pounding"] = json!(env!("CARGO_PKG_VERSION"));
        content["sha256"] = json!(hash(&content));
        format!("{content}\n")
    }

    /// Whether a file begins as JSON does, and not as HDF5; false for one that cannot be read.
    #[must_use]
    pub fn may_be(path: &Path) -> bool {
        use std::io::Read as _;
        let mut start = [0; 64];
        let read = pounding_files::input::open(path).and_then(|mut file| file.read(&mut start));
        let start = &start[..read.unwrap_or(0)];
        without_mark(start).trim_ascii_start().starts_with(b"{")
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`AnswerFileError`].
    pub fn read(path: &Path) -> Result<Self, AnswerFileError> {
        let path = path.to_owned();
        let bytes = match pounding_files::input::read(&path) {
            Ok(bytes) => bytes,
            Err(source) => return Err(AnswerFileError::Read { path, source }),
        };
        let foreign = |found, help| AnswerFileError::Foreign {
            path: path.clone(),
            found,
            help,
        };
        let bytes = without_mark(&bytes);
        let mut values = Deserializer::from_slice(bytes).into_iter::<Value>();
        let first = values.next().unwrap_or(Ok(Value::Null));
        let whole = bytes[values.byte_offset()..].trim_ascii().is_empty();
        let mut content = match first {
            Ok(content) => content,
            Err(e) if e.classify() == Category::Eof => {
                let (line, column) = (e.line(), e.column());
                return Err(AnswerFileError::Truncated { path, line, column });
            }
            Err(e) => {
                let reason = e.to_string();
                return Err(AnswerFileError::NotJson { path, reason });
            }
        };
        if content["check"].is_string() && content["shards"].is_u64() {
            let help = "merge all shards first: the same command with --merge and their files in the place of --shard, and --output or --report";
            return Err(foreign("it is a shard of a check", help));
        }
        if !whole {
            let reason = "something follows the end of its object".to_owned();
            return Err(AnswerFileError::NotJson { path, reason });
        }
        if content["schema"] != SCHEMA {
            let printed = ["/gaps", "/models", "/files"];
            if printed.iter().any(|p| content.pointer(p).is_some()) {
                let help = "what --json prints has neither inputs nor figures: write the file with --output FILE.json";
                return Err(foreign("it has no `schema`", help));
            }
            return Err(foreign("its `schema` is not \"pounding answer\"", WHICH));
        }
        let version = &content["schema_version"];
        if version.as_u64().is_none_or(|v| v > SCHEMA_VERSION) {
            let writer = content["pounding"].as_str().unwrap_or("of another version");
            return Err(AnswerFileError::Newer {
                path,
                writer: writer.to_owned(),
                version: version.to_string(),
            });
        }
        let written = content.as_object_mut().and_then(|c| c.remove("sha256"));
        if written != Some(json!(hash(&content))) {
            return Err(AnswerFileError::Changed { path });
        }
        let shape = |reason: String| AnswerFileError::Shape {
            path: path.clone(),
            reason,
        };
        let answered: Self = serde_json::from_value(content).map_err(|e| shape(e.to_string()))?;
        match answered.figures.iter().all(Picture::is_drawable) {
            true => Ok(answered),
            false => Err(shape("a figure of it cannot be drawn".to_owned())),
        }
    }
}

/// The SHA-256 of a value: keys stand in alphabetical order whatever their order in the file.
fn hash(content: &Value) -> String {
    hexadecimal(&Sha256::digest(content.to_string()))
}
/// Bytes of a text without the byte order mark that editors put before it.
fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}
