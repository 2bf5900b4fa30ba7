//! What keeps a value from being read.

use std::fmt;

use serde::de::{self, Expected, Unexpected};

use crate::error::CaseError;

/// Why a value cannot be what it should be, for [`serde::de::Error::custom`]: `help` says what
/// to do about it, and a message that begins with a blank or a colon follows the name of the
/// key.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{message}\n{help}")]
pub struct Fault {
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: String,
}

impl Fault {
    /// A fault.
    #[must_use]
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            help: help.into(),
        }
    }
}

/// An error of a value on its way to where it is recorded.
#[derive(Debug)]
pub(super) enum Error {
    /// Its place is not known yet.
    New(Fault),
    /// At its place.
    Placed(Box<CaseError>),
    /// Recorded.
    Recorded,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::New(fault) => fault.fmt(f),
            Self::Placed(error) => error.fmt(f),
            Self::Recorded => f.write_str("reported already"),
        }
    }
}

impl std::error::Error for Error {}

impl de::Error for Error {
    fn custom<T: fmt::Display>(text: T) -> Self {
        let text = text.to_string();
        let (message, help) = text
            .split_once('\n')
            .unwrap_or((&text, "correct the value"));
        Self::New(Fault::new(message, help))
    }

    /// What is expected may have a second line, which is the remedy.
    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        let expected = expected.to_string();
        let (wanted, help) = match expected.split_once('\n') {
            Some((wanted, help)) => (wanted, help.to_owned()),
            None => (expected.as_str(), format!("write {expected}")),
        };
        let found = match found {
            Unexpected::Str(_) => "a text",
            Unexpected::Bool(_) => "true or false",
            Unexpected::Seq => "a list",
            Unexpected::Map => "a table",
            Unexpected::Other(other) => other,
            _ => "a number",
        };
        Self::New(Fault::new(format!(" must be {wanted}, not {found}"), help))
    }
}
