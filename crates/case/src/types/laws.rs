//! Laws with memory: of storeys, and of links.

use super::Side;
use crate::located::Located;
use crate::units::Quantity;

/// A force-deformation law with memory in some storeys.
#[derive(Debug, Clone, PartialEq)]
pub struct StoreyLaw {
    /// Law.
    pub model: Located<String>,
    /// Storeys, from zero.
    pub storeys: Vec<usize>,
    /// All other keys, for the law to judge; one value per storey of this law.
    pub parameters: Vec<Parameter>,
}

/// A parameter of an impact model or of a law with memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Key.
    pub key: Located<String>,
    /// Values, one per storey or level; a single one is for all.
    pub values: Vec<Located<Quantity>>,
}

impl Parameter {
    /// The value at a storey or level, from zero.
    #[must_use]
    pub fn at(&self, place: usize) -> Option<&Located<Quantity>> {
        self.values.get(place).or(self.values.first())
    }

    /// Whether all places have one value.
    #[must_use]
    pub fn is_one(&self) -> bool {
        let mut pairs = self.values.windows(2);
        pairs.all(|pair| pair[0].value.value == pair[1].value.value)
    }
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
    pub parameters: Vec<Parameter>,
}

/// A motion of a foundation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FoundationMotion {
    /// Displacement.
    Sway,
    /// Rotation.
    Rocking,
}
