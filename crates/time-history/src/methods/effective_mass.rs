//! The matrix of implicit steps, `M + c C + k K`, factored building by building.

use nalgebra::{Cholesky, DMatrix, Dyn};
use pounding_shear_building::{DampingMatrix, ShearBuilding, StiffnessMatrix, TridiagonalFactor};

use crate::system::System;

/// Factors of every building's effective mass matrix for one pair of weights.
#[derive(Debug, Clone)]
pub(crate) struct EffectiveMass {
    factors: Vec<Factor>,
    /// Weights of the present factors; NaN before the first.
    weights: (f64, f64),
    diagonal: Vec<f64>,
    off_diagonal: Vec<f64>,
}

#[derive(Debug, Clone)]
enum Factor {
    Tridiagonal(TridiagonalFactor),
    Dense(Option<Cholesky<f64, Dyn>>),
}

impl EffectiveMass {
    pub(crate) fn new(system: &System) -> Self {
        let factors = system
            .buildings()
            .iter()
            .map(|b| match (b.damping_matrix(), b.stiffness_matrix()) {
                (DampingMatrix::Tridiagonal(_), StiffnessMatrix::Tridiagonal(_)) => {
                    Factor::Tridiagonal(TridiagonalFactor::new(b.storeys()))
                }
                _ => Factor::Dense(None),
            })
            .collect();
        let dofs = system.degrees_of_freedom();
        Self {
            factors,
            weights: (f64::NAN, f64::NAN),
            diagonal: vec![0.0; dofs],
            off_diagonal: vec![0.0; dofs],
        }
    }

    /// Factors `M + c C + k K` of every building, unless that is done already.
    /// Returns false if a factor fails.
    pub(crate) fn factor(&mut self, system: &System, weights: (f64, f64)) -> bool {
        if self.weights == weights {
            return true;
        }
        self.weights = (f64::NAN, f64::NAN);
        for (index, building) in system.buildings().iter().enumerate() {
            if !self.factor_building(index, building, weights) {
                return false;
            }
        }
        self.weights = weights;
        true
    }

    fn factor_building(
        &mut self,
        index: usize,
        building: &ShearBuilding,
        (c, k): (f64, f64),
    ) -> bool {
        let mass = building.inertia();
        let n = mass.len();
        let matrices = (building.damping_matrix(), building.stiffness_matrix());
        match (matrices, &mut self.factors[index]) {
            (
                (DampingMatrix::Tridiagonal(damping), StiffnessMatrix::Tridiagonal(stiffness)),
                Factor::Tridiagonal(f),
            ) => {
                for i in 0..n {
                    self.diagonal[i] =
                        mass[i] + c * damping.diagonal[i] + k * stiffness.diagonal[i];
                }
                for i in 0..n - 1 {
                    self.off_diagonal[i] =
                        c * damping.off_diagonal[i] + k * stiffness.off_diagonal[i];
                }
                f.factor(&self.diagonal[..n], &self.off_diagonal[..n - 1])
                    .is_ok()
            }
            ((damping, stiffness), Factor::Dense(f)) => {
                let a = DMatrix::from_fn(n, n, |i, j| {
                    let inertia = if i == j { mass[i] } else { 0.0 };
                    inertia + c * damping.entry(i, j) + k * stiffness.entry(i, j)
                });
                *f = a.cholesky();
                f.is_some()
            }
            _ => false,
        }
    }

    /// Solves with the factors in place, building by building.
    pub(crate) fn solve(&self, system: &System, x: &mut [f64]) {
        for (index, factor) in self.factors.iter().enumerate() {
            let [floors, further] = system.parts(index);
            match factor {
                Factor::Tridiagonal(f) => f.solve_in_place(&mut x[floors]),
                Factor::Dense(Some(f)) if further.is_empty() => {
                    let part = &mut x[floors];
                    let mut view = nalgebra::DVectorViewMut::from_slice(part, part.len());
                    f.solve_mut(&mut view);
                }
                Factor::Dense(Some(f)) => {
                    let all = floors.clone().chain(further.clone());
                    let mut part = nalgebra::DVector::from_iterator(
                        floors.len() + further.len(),
                        all.clone().map(|i| x[i]),
                    );
                    f.solve_mut(&mut part);
                    for (i, part) in all.zip(part.iter()) {
                        x[i] = *part;
                    }
                }
                Factor::Dense(None) => x[floors].fill(f64::NAN),
            }
        }
    }
}
