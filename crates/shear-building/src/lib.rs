//! Shear buildings: storeys, mass, stiffness, damping and modes.
//!
//! A building is a chain of storeys, bottom first. Storey `i` has a floor mass
//! and a stiffness that connects the floor to the one below (the ground for the
//! first), so that the stiffness matrix is tridiagonal.

mod building;
mod damping;
mod elevation;
mod error;
mod modes;
mod names;
mod tridiagonal;
mod tridiagonal_eigen;

pub use building::{MAXIMUM_STOREYS, ShearBuilding, StoreyLaw};
pub use damping::{Damping, DampingMatrix};
pub use elevation::{
    ELEVATION_TOLERANCE, are_level, decimal, elevations, floor_without_partner, level_pairs,
};
pub use error::ShearBuildingError;
pub use modes::Modes;
pub use names::{NAMES, is_name};
pub use tridiagonal::{SymmetricTridiagonal, TridiagonalFactor};
