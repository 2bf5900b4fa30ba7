//! What a study file is read against: its case, as far as that is sound.

use std::path::Path;

use pounding_case::Case;

use super::reader::{Reader, Result, Value, Wrong};
use crate::case_text::building_names;

/// A case that can be assembled.
pub(super) struct Base {
    pub case: Case,
    /// First period of each building (s).
    pub first_periods: Vec<f64>,
}

/// What is known of the case.
pub(super) struct Context<'c> {
    /// The case; `None` where something is wrong with it, which was recorded.
    pub base: Option<Base>,
    /// Its text, if it is TOML.
    pub text: Option<String>,
    /// Folder of the study.
    pub folder: &'c Path,
}

impl<'c> Context<'c> {
    /// Nothing but the folder.
    pub(super) fn unknown(folder: &'c Path) -> Self {
        Self {
            base: None,
            text: None,
            folder,
        }
    }

    /// The case.
    pub(super) fn base(&self) -> Result<&Base> {
        self.base.as_ref().ok_or(Wrong::Recorded)
    }

    /// The text of the case.
    pub(super) fn text(&self) -> Result<&str> {
        self.text.as_deref().ok_or(Wrong::Recorded)
    }

    /// Index of the building that a value names.
    ///
    /// # Errors
    /// A name that is none.
    pub(super) fn building(&self, reader: &Reader<'_>, value: &Value<'_>) -> Result<usize> {
        let name = reader.text(value, "building")?;
        let names = building_names(self.text()?);
        names.iter().position(|n| *n == name).ok_or_else(|| {
            reader.error(
                value.span(),
                format!("the case has no building \"{name}\""),
                format!("its buildings are {}", names.join(", ")),
            )
        })
    }
}
