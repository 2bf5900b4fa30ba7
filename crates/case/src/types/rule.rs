//! Rules of users for the gap, as they were written.

use std::ops::Range;
use std::sync::Arc;

use crate::error::CaseError;
use crate::located::Located;
use crate::units::Quantity;

/// A rule of a user for the gap: its expression is not yet understood.
#[derive(Debug, Clone, PartialEq)]
pub struct RuleText {
    /// Name.
    pub name: Located<String>,
    /// Country, or whatever the user calls it; may be empty.
    pub region: String,
    /// Code or office standard with its edition; may be empty.
    pub edition: String,
    /// Clause; may be empty.
    pub clause: String,
    /// Whether it gives the distance of two buildings, and not that of one from the border.
    pub between: bool,
    /// The expression.
    pub expression: Located<String>,
    /// Numbers with units that the expression names.
    pub inputs: Vec<(Located<String>, Quantity)>,
    /// Tables of one quantity over another that it calls.
    pub tables: Vec<(Located<String>, TableText)>,
    /// Parts of it that have names.
    pub definitions: Vec<(Located<String>, Located<String>)>,
    /// What the user says that the rule takes for granted.
    pub assumptions: Vec<String>,
    /// Name of the file that it stands in.
    pub file: Arc<str>,
    /// Text of that file.
    pub source: Arc<str>,
}

/// A table of one quantity over another.
#[derive(Debug, Clone, PartialEq)]
pub struct TableText {
    /// Pairs, as written.
    pub points: Vec<[Quantity; 2]>,
    /// Whether a value holds from its point on, and not only there.
    pub steps: bool,
    /// Where it stands.
    pub span: Range<usize>,
}

impl RuleText {
    /// An error at a span of the file.
    #[must_use]
    pub fn error(
        &self,
        span: Range<usize>,
        message: impl Into<String>,
        help: Option<String>,
    ) -> CaseError {
        CaseError::new(&self.file, &self.source, span, message, help)
    }
}
