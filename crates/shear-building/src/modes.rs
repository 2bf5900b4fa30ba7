//! Modes of a building.
//!
//! The eigenproblem is solved by nalgebra. Measured for uniform buildings, one
//! full decomposition with nalgebra 0.35 and faer 0.24: 0.9 and 2.5 us (3
//! storeys), 7.9 and 10 us (10), 0.14 and 0.15 ms (40), 0.77 and 0.63 ms (80), 26
//! and 13.5 ms (200), both within 8e-13 relative of the closed form at 200
//! storeys. Buildings have fewer than 80 storeys more often than not, nalgebra is
//! needed for the dense damping matrix anyway, and it costs a fifth of faer's
//! build time.

use nalgebra::{DMatrix, SymmetricEigen};

use crate::damping::DampingMatrix;
use crate::tridiagonal::SymmetricTridiagonal;

/// Frequencies and shapes without damping.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Undamped {
    pub circular_frequency: Vec<f64>,
    pub shape: DMatrix<f64>,
}

/// Modal properties of a building.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Circular frequencies (rad/s), ascending.
    pub circular_frequency: Vec<f64>,
    /// Periods (s), descending.
    pub period: Vec<f64>,
    /// Shapes, storey by mode, normalised to the mass matrix (1/sqrt(kg)), the
    /// roof positive.
    pub shape: DMatrix<f64>,
    /// Participation factors `phi' M 1` (sqrt(kg)).
    pub participation_factor: Vec<f64>,
    /// Effective modal masses (kg); they sum to the building's mass.
    pub effective_mass: Vec<f64>,
    /// Damping ratios `phi' C phi / (2 omega)` (-). For dashpots the modes are
    /// coupled, and this is the diagonal part.
    pub damping_ratio: Vec<f64>,
}

/// Solves `K phi = omega^2 M phi` through `M^-1/2 K M^-1/2`.
pub(crate) fn undamped(mass: &[f64], stiffness: &SymmetricTridiagonal) -> Undamped {
    let n = mass.len();
    let scale: Vec<f64> = mass.iter().map(|m| 1.0 / m.sqrt()).collect();
    let mut matrix = DMatrix::zeros(n, n);
    for i in 0..n {
        matrix[(i, i)] = stiffness.diagonal[i] * scale[i] * scale[i];
        if i + 1 < n {
            let off = stiffness.off_diagonal[i] * scale[i] * scale[i + 1];
            matrix[(i, i + 1)] = off;
            matrix[(i + 1, i)] = off;
        }
    }
    let eigen = SymmetricEigen::new(matrix);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let roof_sign = |column: usize| {
        if eigen.eigenvectors[(n - 1, column)] < 0.0 {
            -1.0
        } else {
            1.0
        }
    };
    Undamped {
        circular_frequency: order
            .iter()
            .map(|j| eigen.eigenvalues[*j].max(0.0).sqrt())
            .collect(),
        shape: DMatrix::from_fn(n, n, |i, j| {
            roof_sign(order[j]) * scale[i] * eigen.eigenvectors[(i, order[j])]
        }),
    }
}

impl Modes {
    pub(crate) fn new(undamped: Undamped, mass: &[f64], damping: &DampingMatrix) -> Self {
        let n = mass.len();
        let Undamped {
            circular_frequency,
            shape,
        } = undamped;
        let participation_factor: Vec<f64> = (0..n)
            .map(|j| (0..n).map(|i| shape[(i, j)] * mass[i]).sum())
            .collect();
        let mut product = vec![0.0; n];
        let damping_ratio = (0..n)
            .map(|j| {
                let phi: Vec<f64> = shape.column(j).iter().copied().collect();
                damping.multiply(&phi, &mut product);
                let generalised: f64 = phi.iter().zip(&product).map(|(a, b)| a * b).sum();
                generalised / (2.0 * circular_frequency[j])
            })
            .collect();
        Self {
            period: circular_frequency
                .iter()
                .map(|w| std::f64::consts::TAU / w)
                .collect(),
            effective_mass: participation_factor.iter().map(|g| g * g).collect(),
            circular_frequency,
            shape,
            participation_factor,
            damping_ratio,
        }
    }
}
