//! Kinds of what expressions are made of.

use pounding_case::Dimension;

/// What a part of an expression is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// A quantity of a dimension.
    Number(Dimension),
    /// A zero that is written out, which is one of any dimension.
    Zero,
    /// True or false.
    Truth,
    /// A word.
    Word,
}
