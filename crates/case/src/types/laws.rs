//! Laws with memory: of storeys, and of links.

use super::{Located, Side};
use crate::units::Quantity;

/// A force-deformation law with memory in some storeys.
#[derive(Debug, Clone, PartialEq)]
pub struct StoreyLaw {
    /// Law.
    pub model: Located<String>,
    /// Storeys, from zero.
    pub storeys: Vec<usize>,
    /// All other keys, for the law to judge; one value per storey of this law.
    pub parameters: Vec<LawParameter>,
}

/// A parameter of a law with memory.
#[derive(Debug, Clone, PartialEq)]
pub struct LawParameter {
    /// Key.
    pub key: Located<String>,
    /// Values, one per storey or level of the law.
    pub values: Vec<Located<Quantity>>,
}

/// A link: a law with memory that joins floors of neighbours, or a floor and a wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Name, by default `left-right`.
    pub name: String,
    /// Left and right.
    pub between: [Side; 2],
    /// Storeys of the left and the right building that are joined, from zero; `None`
    /// for a wall.
    pub levels: Vec<(Option<usize>, Option<usize>)>,
    /// The motion of the foundations of both buildings that it joins, in the place of floors,
    /// at its key; there is one level then, without storeys.
    pub foundations: Option<Located<FoundationMotion>>,
    /// Law.
    pub model: Located<String>,
    /// All other keys, for the law to judge; one value per level.
    pub parameters: Vec<LawParameter>,
}

/// A motion of a foundation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FoundationMotion {
    /// Displacement.
    Sway,
    /// Rotation.
    Rocking,
}
