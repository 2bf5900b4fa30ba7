//! How far the formula of a provision has been compared with a text.

use std::fmt;

use crate::rule::Rule;

/// How far a provision may be trusted.
#[derive(Debug, Clone, Copy)]
pub enum Status {
    /// The clause was read in the standard itself.
    SeenInStandard(&'static str),
    /// The formula was seen in an excerpt, a transcription, a guide or a program by others: which
    /// one, and what of the rule it does not show.
    SeenInText(&'static str),
    /// Not compared with any text: what has to be looked up before it enters a design report.
    Unverified(&'static str),
    /// Texts say different things: the readings, none of which is chosen.
    Disputed {
        /// What they differ in.
        about: &'static str,
        /// Two readings or more; the first is that of the provision's own formula.
        readings: &'static [Reading],
    },
    /// Stated by the user.
    Yours,
}

/// One reading of a disputed provision.
#[derive(Debug, Clone, Copy)]
pub struct Reading {
    /// Whose reading it is.
    pub text: &'static str,
    /// Formula in plain characters.
    pub formula: &'static str,
    /// Its width for the worked example, by hand in mm.
    pub worked: &'static str,
    pub(crate) rule: Rule,
}

impl Status {
    /// In a few words, as in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::SeenInStandard(_) => "seen in the standard",
            Self::SeenInText(_) => "seen in a secondary text",
            Self::Unverified(_) => "unverified",
            Self::Disputed { .. } => "disputed",
            Self::Yours => "yours",
        }
    }

    /// What was seen, or what is uncertain.
    #[must_use]
    pub fn remark(self) -> &'static str {
        match self {
            Self::SeenInStandard(text) | Self::SeenInText(text) | Self::Unverified(text) => text,
            Self::Disputed { about, .. } => about,
            Self::Yours => "a rule of the user",
        }
    }

    /// Whether the formula was seen, in the standard or elsewhere.
    #[must_use]
    pub fn was_seen(self) -> bool {
        matches!(self, Self::SeenInStandard(_) | Self::SeenInText(_))
    }

    /// The readings of a disputed provision; none of any other.
    #[must_use]
    pub fn readings(self) -> &'static [Reading] {
        match self {
            Self::Disputed { readings, .. } => readings,
            _ => &[],
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.name(), self.remark())
    }
}
