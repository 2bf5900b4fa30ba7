//! Frequencies and shapes of a building without damping.
//!
//! The eigenproblem of up to [`LARGE`] storeys is solved by nalgebra as a dense one,
//! whose work grows with the cube of the storeys (86 us for 40, 19 ms for 200, 20 s and
//! more for 2,000); that of more storeys as the tridiagonal one that it is. Frequencies
//! then follow from the shapes as Rayleigh quotients (relative error below 1e-15 at 200
//! storeys).
//!
//! Both give the same bits on every processor, on which result files of one study made on
//! several machines rely. `faer` does not: it chooses vector widths and block sizes by the
//! processor at run time, without a way to fix them, and 20 storeys already have other shapes
//! with vector units than without. Nor would it gain much here (faer 0.24, one thread): 1.1,
//! 26 and 327 ms for 100, 400 and 1,000 storeys against 1.2 (nalgebra), 35 and 227 ms, with
//! residuals of 5e-15 of the norm against 1.3e-16.

use nalgebra::{DMatrix, SymmetricEigen};

use crate::dense::multiply;
use crate::tridiagonal::SymmetricTridiagonal;
use crate::tridiagonal_eigen::eigen;

/// Storeys up to which matrices are handled as dense ones without further thought.
pub(crate) const LARGE: usize = 100;

/// Frequencies and shapes without damping.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Undamped {
    pub circular_frequency: Vec<f64>,
    pub shape: DMatrix<f64>,
}

/// Solves `K phi = omega^2 M phi` through `M^-1/2 K M^-1/2`.
pub(crate) fn undamped(
    mass: &[f64],
    storeys: &[f64],
    stiffness: &SymmetricTridiagonal,
) -> Undamped {
    let n = mass.len();
    let scale: Vec<f64> = mass.iter().map(|m| 1.0 / m.sqrt()).collect();
    let scaled = SymmetricTridiagonal {
        diagonal: (0..n)
            .map(|i| stiffness.diagonal[i] * scale[i] * scale[i])
            .collect(),
        off_diagonal: (0..n - 1)
            .map(|i| stiffness.off_diagonal[i] * scale[i] * scale[i + 1])
            .collect(),
    };
    let shape = if n > LARGE {
        let (_, mut vectors) = eigen(&scaled);
        for mut column in vectors.column_iter_mut() {
            let sign = if column[n - 1] < 0.0 { -1.0 } else { 1.0 };
            for (x, scale) in column.iter_mut().zip(&scale) {
                *x *= sign * scale;
            }
        }
        vectors
    } else {
        dense_shapes(&scaled, &scale)
    };
    Undamped {
        circular_frequency: (0..n)
            .map(|j| rayleigh_quotient(mass, storeys, &shape, j).sqrt())
            .collect(),
        shape,
    }
}

/// The same for a full stiffness matrix; frequencies are NaN where it is not positive
/// definite.
pub(crate) fn undamped_dense(mass: &[f64], stiffness: &DMatrix<f64>, floors: usize) -> Undamped {
    let n = mass.len();
    let scale: Vec<f64> = mass.iter().map(|m| 1.0 / m.sqrt()).collect();
    let scaled = DMatrix::from_fn(n, n, |i, j| stiffness[(i, j)] * (scale[i] * scale[j]));
    let shape = shapes_of(scaled, &scale, floors);
    let mut force = vec![0.0; n];
    let frequency = |phi: &[f64]| {
        multiply(stiffness, phi, &mut force);
        let elastic: f64 = phi.iter().zip(&force).map(|(x, f)| x * f).sum();
        let kinetic: f64 = phi.iter().zip(mass).map(|(x, m)| m * x * x).sum();
        (elastic / kinetic).sqrt()
    };
    Undamped {
        circular_frequency: shape.as_slice().chunks(n).map(frequency).collect(),
        shape,
    }
}

fn dense_shapes(scaled: &SymmetricTridiagonal, scale: &[f64]) -> DMatrix<f64> {
    let n = scale.len();
    shapes_of(DMatrix::from_fn(n, n, |i, j| scaled.entry(i, j)), scale, n)
}

/// Eigenvectors in the order of their eigenvalues, scaled, the roof positive.
fn shapes_of(matrix: DMatrix<f64>, scale: &[f64], floors: usize) -> DMatrix<f64> {
    let n = scale.len();
    let eigen = SymmetricEigen::new(matrix);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let roof_sign = |column: usize| {
        if eigen.eigenvectors[(floors - 1, column)] < 0.0 {
            -1.0
        } else {
            1.0
        }
    };
    DMatrix::from_fn(n, n, |i, j| {
        roof_sign(order[j]) * scale[i] * eigen.eigenvectors[(i, order[j])]
    })
}

/// `omega^2` of a computed shape from its drifts: never negative, and accurate to
/// the square of the shape's own error.
fn rayleigh_quotient(mass: &[f64], storeys: &[f64], shape: &DMatrix<f64>, j: usize) -> f64 {
    let (mut elastic, mut kinetic, mut below) = (0.0, 0.0, 0.0);
    for (i, (m, k)) in mass.iter().zip(storeys).enumerate() {
        let phi = shape[(i, j)];
        elastic += k * (phi - below) * (phi - below);
        kinetic += m * phi * phi;
        below = phi;
    }
    elastic / kinetic
}
