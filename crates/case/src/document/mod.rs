//! Files that people write, read by serde: a table is a type that derives `Deserialize` and
//! `JsonSchema`, a key is one field of it, and the comment on the field explains the key in
//! the JSON Schema.
//!
//! All that is wrong in a file is found in one reading, each error at its place: a [`Field`]
//! records what is wrong in its value, and the rest of its table is read all the same.
//! Fields without it make their table wrong as a whole. What only follows from another error
//! is not reported. The name of a struct, where `#[serde(rename)]` gives one, is that of its
//! table in messages; in a table with such a name, and in one with [`FreeKeys`], an unknown key
//! does not keep the others from being read. An enum whose variants have no fields is a text;
//! with `#[serde(rename)]` a text that is none of them is called an unknown one of that name. An enum whose variants have fields
//! is a table of several kinds, each known by the key that is called like the variant; one
//! whose variants hold one value is a table with one key.

mod deserializer;
mod entries;
mod error;
mod numbers;
mod pasted;
mod schema;

use std::ops::Range;

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{CaseError, Errors};

pub use entries::{
    Entry, Field, FreeKeys, Kinds, List, OneOrEach, Optional, Table, TableOr, Tables,
};
pub use error::Fault;
pub use numbers::{
    AboveZero, Acceleration, Amount, Count, Cycles, Dashpot, Density, Dimensioned, Flexibility,
    FlexuralRigidity, Force, Frequency, FromZero, Length, Mass, NotNegative, Number, Poisson,
    Positive, Ratio, RotationalDashpot, RotationalInertia, RotationalStiffness, Scalar, Signed,
    Slowness, Stiffness, Time, Velocity, Within, Written,
};
pub use schema::schema_of;

/// A text being read.
#[derive(Debug, Clone, Copy)]
pub struct Reader<'a> {
    /// Its name in messages.
    pub file: &'a str,
    /// The text.
    pub source: &'a str,
    /// What was found wrong so far.
    pub errors: &'a Errors,
}

impl Reader<'_> {
    /// An error at a place of the text.
    #[must_use]
    pub fn error(
        &self,
        span: Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> CaseError {
        let help = Some(help.into()).filter(|help| !help.is_empty());
        CaseError::new(self.file, self.source, span, message, help)
    }

    /// Records an error; in the place of the value that is not there because of it.
    pub fn refuse<T>(
        &self,
        span: Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<T> {
        self.errors.record(self.error(span, message, help));
        None
    }

    /// The value, which stands at a key; `None` after recording what is wrong with it.
    pub fn keep<T>(&self, span: &Range<usize>, key: &str, value: Result<T, Fault>) -> Option<T> {
        let error = |fault| self.fault(span.clone(), key, fault);
        self.errors.keep(value.map_err(error))
    }

    /// The error of a value that stands at a key.
    fn fault(&self, span: Range<usize>, key: &str, fault: Fault) -> CaseError {
        let Fault { message, help } = fault;
        let message = match message.starts_with([' ', ':']) {
            true => format!("{}{message}", deserializer::quoted(key)),
            false => message,
        };
        let written = self.source.get(span.clone()).unwrap_or_default();
        let message = message.replace("{written}", written);
        self.error(span, message, help.replace("{key}", key))
    }

    /// Whether the number that stands here has no unit, which needs quotes.
    pub(crate) fn is_bare(&self, place: &Range<usize>) -> bool {
        let written = self.source.get(place.clone()).unwrap_or_default();
        !written.starts_with(['"', '\''])
    }

    /// Line of a place, from 1.
    #[must_use]
    pub fn line(&self, span: &Range<usize>) -> usize {
        self.error(span.clone(), "", "").line
    }

    /// The whole text; `help` says how to write it. `None` after its errors were recorded.
    #[must_use]
    pub fn read<T: DeserializeOwned>(&self, help: &str) -> Option<T> {
        let (tree, wrong) = DeTable::parse_recoverable(self.source);
        let mut lines = Vec::new();
        let of_old_macintosh = self.source.contains('\r') && !self.source.contains('\n');
        let help = match of_old_macintosh {
            true => {
                "its lines end with a carriage return alone: save it with line ends of Unix or Windows"
            }
            false => help,
        };
        let mut of_second_table = 0..0;
        for e in wrong {
            let span = e.span().unwrap_or(0..0);
            let line = self.line(&span);
            // What follows in the same line is mostly of the parser's own making, and so are the keys
            // of a table that is given twice.
            if lines.contains(&line) || of_second_table.contains(&span.start) {
                continue;
            }
            lines.push(line);
            let written = match e.message() {
                DUPLICATE => Twice::at(self.source, &span),
                _ => None,
            };
            let error = match written {
                Some(twice) => {
                    of_second_table = twice.keys;
                    self.error(span, twice.message, twice.help)
                }
                None => match pasted::sign_in(self.source, &span) {
                    Some(pasted) => self.error(
                        pasted.place,
                        format!("this is not TOML: {}", pasted.message),
                        pasted.help,
                    ),
                    None => self.error(span, format!("this is not TOML: {}", e.message()), help),
                },
            };
            self.errors.record(error);
        }
        if !lines.is_empty() {
            return None;
        }
        let root = Spanned::new(0..0, DeValue::Table(tree.into_inner()));
        self.value("", &root)
    }

    /// The value of a key, empty for that of the whole text; `None` after recording what is
    /// wrong.
    pub(crate) fn value<T: DeserializeOwned>(
        &self,
        key: &str,
        value: &Spanned<DeValue<'_>>,
    ) -> Option<T> {
        deserializer::read(*self, key, value)
    }
}

/// What the parser says of a key or a table that stands twice.
const DUPLICATE: &str = "duplicate key";

/// A key or a table that stands twice where it can stand once.
struct Twice {
    message: String,
    help: &'static str,
    /// Where the keys of a table stand that is not read.
    keys: Range<usize>,
}

impl Twice {
    fn at(source: &str, span: &Range<usize>) -> Option<Self> {
        let key = source.get(span.clone())?;
        let start = source[..span.start].rfind('\n').map_or(0, |end| end + 1);
        let end = source[span.end..].find('\n');
        let end = end.map_or(source.len(), |end| span.end + end);
        let before = source[start..span.start].trim();
        // Brackets with parts of a key that is dotted, and no list or table in a line.
        let is_header = before.starts_with('[') && !before.contains(['{', '=', ',']);
        if !is_header {
            return Some(Self {
                message: format!("`{key}` is given twice"),
                help: "remove one of them",
                keys: 0..0,
            });
        }
        let header = |line: &str| line.split('#').next().unwrap_or_default().trim().to_owned();
        let here = header(&source[start..end]);
        let name = here.trim_start_matches('[').trim_end_matches(']');
        let stands = |wanted: &str| source[..start].lines().any(|line| header(line) == wanted);
        let single = format!("[{name}]");
        let (message, help) = if here != single && stands(&single) {
            (
                format!("{here} stands beside {single}"),
                "write double brackets at each of them",
            )
        } else if stands(&here) {
            (
                format!("{here} stands twice"),
                "put all its keys below the first one; several of a kind, such as buildings, have double brackets each",
            )
        } else {
            (
                format!("`{name}` is given before, in another form"),
                "write all of it in one form",
            )
        };
        let next = source[end..].find("\n[");
        let keys = span.end..next.map_or(source.len(), |next| end + next);
        Some(Self {
            message,
            help,
            keys,
        })
    }
}
