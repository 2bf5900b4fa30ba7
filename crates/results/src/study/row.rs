//! A row of results: one run.

/// Bytes of a run's identity.
pub const ID: usize = 16;

/// The value of a variable in a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// A number in SI units.
    Number(f64),
    /// Which of the choices, from zero.
    Choice(usize),
}

impl Value {
    /// Bits by which values of one variable are told apart.
    #[must_use]
    pub fn bits(self) -> u64 {
        match self {
            Self::Number(x) => x.to_bits(),
            Self::Choice(i) => i as u64,
        }
    }
}

/// The result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Number of the run.
    pub run: usize,
    /// Identity: the first bytes of the SHA-256 of what the case says, of the bytes of the
    /// record and of the version of the program.
    pub id: [u8; ID],
    /// Values in the columns of the [`Layout`](super::Layout); all missing (NaN) if the run failed, all
    /// but those of the run without gaps if it collapsed.
    pub values: Vec<f64>,
    /// How it ended.
    pub ending: Ending,
}

/// How a run ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Ending {
    /// It went on to its end.
    Complete,
    /// It could not be made, or came to no result: the diagnosis.
    Failed(String),
    /// Gravity overturned a building, which is an answer: when, which building, which
    /// storey.
    Collapsed(String),
}

impl Ending {
    /// Its number and its name in results.
    #[must_use]
    pub fn status(&self) -> (i8, &'static str) {
        match self {
            Self::Complete => (0, "complete"),
            Self::Failed(_) => (1, "failed"),
            Self::Collapsed(_) => (2, "collapsed"),
        }
    }

    /// Why it failed, or what collapsed.
    #[must_use]
    pub fn diagnosis(&self) -> Option<&str> {
        match self {
            Self::Complete => None,
            Self::Failed(reason) | Self::Collapsed(reason) => Some(reason),
        }
    }

    /// Whether it failed.
    #[must_use]
    pub fn failed(&self) -> bool {
        matches!(self, Self::Failed(_))
    }

    /// Whether a building collapsed.
    #[must_use]
    pub fn collapsed(&self) -> bool {
        matches!(self, Self::Collapsed(_))
    }
}
