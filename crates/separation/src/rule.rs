//! How a provision computes.

use crate::error::SeparationError;
use crate::inputs::{Site, Situation, Structure};
use crate::working::Working;

/// How a provision computes.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Rule {
    /// One building.
    Boundary(fn(&mut Working, &Structure, &Site) -> Result<f64, SeparationError>),
    /// One building, as before; `None` of a building that the rule does not speak of, which beside
    /// one that it speaks of adds nothing, and in words what it speaks of.
    BoundaryOfSome(
        fn(&mut Working, &Structure) -> Result<Option<f64>, SeparationError>,
        &'static str,
    ),
    /// Two buildings.
    Between(fn(&mut Working, &Situation) -> Result<f64, SeparationError>),
    /// The seat of a bridge between two buildings.
    Seat(fn(&mut Working, &Situation) -> Result<f64, SeparationError>),
}
