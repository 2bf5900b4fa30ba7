//! Who owns the ground on both sides of a gap.

/// Who owns the ground on both sides of a gap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ownership {
    /// No property line lies in the gap.
    SameProperty,
    /// Each building stands on its own property.
    DifferentProperties,
}

impl Ownership {
    /// A word for tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::SameProperty => "same property",
            Self::DifferentProperties => "different properties",
        }
    }
}
