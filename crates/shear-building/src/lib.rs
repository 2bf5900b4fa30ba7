//! Shear buildings: storeys, mass, stiffness, damping and modes.
//!
//! A building is a chain of storeys, bottom first. Storey `i` has a floor mass
//! and a stiffness that connects the floor to the one below (the ground for the
//! first), so that the stiffness matrix is tridiagonal. A frame or a wall, whose floors all
//! act on one another, is a building with a full matrix instead ([`LateralStiffness`]).

// The same bits on every machine: see clippy.toml.
#![warn(clippy::disallowed_methods)]

mod building;
mod building_on_foundation;
mod column;
mod coordinates;
mod damping;
mod dense;
mod elevation;
mod error;
mod foundation;
mod isolator;
mod lateral;
mod modes;
mod names;
mod stiffness;
mod storey_law;
mod tridiagonal;
mod tridiagonal_eigen;
mod undamped;
mod yielding_frame;

pub use building::{
    ContactLine, MAXIMUM_STOREYS, OVERTURNING_RATIO, OnFoundation, ShearBuilding, UPLIFT_BEGINS,
};
pub use building_on_foundation::{BuildingOnFoundation, CoupledMode, FixedBaseBuilding};
pub use column::{
    ColumnEnds, ColumnError, ColumnForceRows, ColumnForces, ColumnResponse, ForcedColumnResponse,
    HitColumn, HitLine, NEAR_FLOOR,
};
pub use coordinates::{
    Coordinate, EDGE_DISPLACEMENTS, Excitation, GeneralBuilding, GeometricStiffness, ResponseKind,
    ResponseRow,
};
pub use damping::{Damping, DampingMatrix};
pub use elevation::{
    ELEVATION_TOLERANCE, are_level, decimal, elevations, floor_without_partner, level_pairs,
};
pub use error::ShearBuildingError;
pub use foundation::{Foundation, FoundationError, Soil, SoilSprings, SpringDashpot};
pub use isolator::{
    Isolator, IsolatorError, IsolatorKind, IsolatorProperties, PostYield, Strength,
};
pub use lateral::{LateralStiffness, LateralStiffnessError};
pub use modes::Modes;
pub use names::{NAMES, NameError, NameFault, WALL, check_names, is_name};
pub use stiffness::StiffnessMatrix;
pub use storey_law::StoreyLaw;
pub use tridiagonal::{SymmetricTridiagonal, TridiagonalFactor};
pub use yielding_frame::{FrameDirection, YieldingFrame};

/// The crate whose matrices and vectors this one takes and gives, of the version that they are of.
pub use nalgebra;
