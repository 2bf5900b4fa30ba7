//! Coordinates of a building that are no floors, and responses that are sums over all of them.

use nalgebra::DMatrix;

use crate::damping::Damping;
use crate::tridiagonal::SymmetricTridiagonal;

/// Which component of the ground motion accelerates the ground under a coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Excitation {
    /// None: a rotation, for which a shift of the ground is no motion.
    None,
    /// The one along the row of buildings, as of floors.
    Along,
    /// The one across it.
    Across,
}

/// A coordinate of a building that is no floor: the sway or the rotation of a foundation, a
/// point of a column, a floor's displacement across the row or its rotation in plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinate {
    /// What it is, in words for messages.
    pub name: String,
    /// Mass (kg), or moment of inertia of a rotation (kg m2).
    pub inertia: f64,
    /// The ground motion that it is relative to.
    pub excitation: Excitation,
}

/// What the sum of a [`ResponseRow`] runs over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ResponseKind {
    /// Coordinates.
    Displacement,
    /// Absolute accelerations of the coordinates.
    Acceleration,
}

/// Names, before the number of the floor, of the displacements along the row of both ends of a floor
/// that turns in plan: the lower and the upper one, by position across the row.
pub const EDGE_DISPLACEMENTS: [&str; 2] =
    ["displacement_of_lower_edge", "displacement_of_upper_edge"];

/// A response of a building with a name: a sum over its coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseRow {
    /// Name in results: lower case with underscores, such as `foundation_rotation`.
    pub name: String,
    /// SI unit of the response, such as `rad`.
    pub unit: &'static str,
    /// Of what.
    pub kind: ResponseKind,
    /// One a coordinate, floors first.
    pub weights: Vec<f64>,
}

/// What gravity takes off the stiffness of a building through its drifts (P-Delta).
#[derive(Debug, Clone, PartialEq)]
pub struct GeometricStiffness {
    /// Of every storey along the row, bottom first: weight above over height (N/m).
    pub storeys: Vec<f64>,
    /// Of all coordinates, as the stiffness is.
    pub matrix: DMatrix<f64>,
}

impl GeometricStiffness {
    /// That of floors with several coordinates, which come kind after kind, those along the row first: `inertia` holds of each
    /// kind the masses (kg) or moments of inertia (kg m2) of the floors. Weights lie as the masses do, and in every storey below
    /// a floor each part of its weight leans by what its own place drifts there, a rotation among it (Rutenberg, J. Struct. Div.
    /// ASCE 108 (1982) 1995: a column of negative lateral and torsional stiffness). Heights in m, gravity in m/s2.
    #[must_use]
    pub fn of_floors(inertia: &[&[f64]], height: &[f64], gravity: f64) -> Self {
        let floors = height.len();
        let kinds = inertia.iter();
        let kinds = kinds.map(|inertia| weights_over_heights(inertia, height, gravity));
        let kinds: Vec<Vec<f64>> = kinds.collect();
        let mut matrix = DMatrix::zeros(floors * kinds.len(), floors * kinds.len());
        for (kind, storeys) in kinds.iter().enumerate() {
            let chain = SymmetricTridiagonal::chain(storeys);
            let of_kind = DMatrix::from_fn(floors, floors, |i, j| chain.entry(i, j));
            let first = kind * floors;
            let mut place = matrix.view_mut((first, first), (floors, floors));
            place.copy_from(&of_kind);
        }
        Self {
            storeys: kinds.into_iter().next().unwrap_or_default(),
            matrix,
        }
    }
}

/// Weight above over height of every storey (N/m).
pub(crate) fn weights_over_heights(mass: &[f64], height: &[f64], gravity: f64) -> Vec<f64> {
    let mut above: f64 = mass.iter().sum();
    let storeys = mass.iter().zip(height);
    storeys
        .map(|(mass, height)| {
            let load = gravity * above;
            above -= mass;
            load / height
        })
        .collect()
}

/// A building of floors and other coordinates with full matrices; see
/// [`crate::ShearBuilding::with_coordinates`].
#[derive(Debug, Clone, PartialEq)]
pub struct GeneralBuilding {
    /// Name.
    pub name: String,
    /// Floor masses (kg), bottom first.
    pub mass: Vec<f64>,
    /// Storey heights (m), bottom first.
    pub height: Vec<f64>,
    /// Coordinates after the floors.
    pub further: Vec<Coordinate>,
    /// Stiffness of all coordinates, floors first (N/m; N m/rad on the diagonal of rotations).
    pub stiffness: DMatrix<f64>,
    /// What gravity takes off it; `None` without P-Delta.
    pub geometric: Option<GeometricStiffness>,
    /// Damping of all coordinates.
    pub damping: Damping,
    /// Drift of every storey (m) as a sum over the coordinates; `None` where it is the
    /// difference of the floors at both its ends.
    pub drifts: Option<Vec<Vec<f64>>>,
    /// Shear of every storey (N), bottom first, then the overturning moment at the base
    /// (N m), as sums over the coordinates.
    pub sections: Vec<Vec<f64>>,
    /// Further responses.
    pub responses: Vec<ResponseRow>,
}
