//! The lateral stiffness of a building.

use nalgebra::DMatrix;

use crate::dense::multiply;
use crate::tridiagonal::SymmetricTridiagonal;

/// The stiffness matrix of a building (N/m).
#[derive(Debug, Clone, PartialEq)]
pub enum StiffnessMatrix {
    /// A chain of storeys.
    Tridiagonal(SymmetricTridiagonal),
    /// Every floor acts on every other: a frame or a wall, condensed to its floors.
    Dense(DMatrix<f64>),
}

impl StiffnessMatrix {
    /// `out = K u` (N); all of one value a floor.
    pub fn multiply(&self, u: &[f64], out: &mut [f64]) {
        match self {
            Self::Tridiagonal(k) => k.multiply(u, out),
            Self::Dense(k) => multiply(k, u, out),
        }
    }

    /// Entry in a row and a column, both from zero (N/m).
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        match self {
            Self::Tridiagonal(k) => k.entry(row, column),
            Self::Dense(k) => k[(row, column)],
        }
    }
}
