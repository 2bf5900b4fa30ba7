//! Values with their places.

use std::ops::Range;

/// A value and where it stands in the source (bytes).
#[derive(Debug, Clone, PartialEq)]
pub struct Located<T> {
    /// Value.
    pub value: T,
    /// Bytes of the source.
    pub span: Range<usize>,
}
