//! Symmetric tridiagonal matrices: product, factor, solution; O(n) and without
//! allocation, because the step loop uses them.

use crate::error::ShearBuildingError;

/// A symmetric tridiagonal matrix.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SymmetricTridiagonal {
    /// Diagonal, length n.
    pub diagonal: Vec<f64>,
    /// Entry (i, i+1), length n - 1.
    pub off_diagonal: Vec<f64>,
}

impl SymmetricTridiagonal {
    /// The matrix of a chain of springs or dashpots: storey `i` connects floor
    /// `i - 1` (the ground for the first) to floor `i`.
    #[must_use]
    pub fn chain(storeys: &[f64]) -> Self {
        let n = storeys.len();
        let above = |i: usize| storeys.get(i + 1).copied().unwrap_or(0.0);
        Self {
            diagonal: (0..n).map(|i| storeys[i] + above(i)).collect(),
            off_diagonal: storeys.iter().skip(1).map(|k| -k).collect(),
        }
    }

    /// Entry in a row and a column, both from zero.
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        match row.abs_diff(column) {
            0 => self.diagonal[row],
            1 => self.off_diagonal[row.min(column)],
            _ => 0.0,
        }
    }

    /// `out = A x`; all of length n.
    pub fn multiply(&self, x: &[f64], out: &mut [f64]) {
        let n = self.diagonal.len();
        for i in 0..n {
            let mut sum = self.diagonal[i] * x[i];
            if i > 0 {
                sum += self.off_diagonal[i - 1] * x[i - 1];
            }
            if i + 1 < n {
                sum += self.off_diagonal[i] * x[i + 1];
            }
            out[i] = sum;
        }
    }
}

/// `L D L'` factor of a symmetric positive definite tridiagonal matrix (Golub and
/// Van Loan, Matrix Computations, 4th edition, algorithm 4.3.6).
#[derive(Debug, Clone, PartialEq)]
pub struct TridiagonalFactor {
    pivots: Vec<f64>,
    lower: Vec<f64>,
}

impl TridiagonalFactor {
    /// Work space for matrices of `size` rows. Before the first successful
    /// [`TridiagonalFactor::factor`] it is the factor of the identity.
    #[must_use]
    pub fn new(size: usize) -> Self {
        Self {
            pivots: vec![1.0; size],
            lower: vec![0.0; size.saturating_sub(1)],
        }
    }

    /// Factors a matrix of the size given at construction; reuses the memory.
    ///
    /// # Errors
    /// A pivot that is not positive.
    pub fn factor(
        &mut self,
        diagonal: &[f64],
        off_diagonal: &[f64],
    ) -> Result<(), ShearBuildingError> {
        let mut pivot = 0.0;
        for i in 0..self.pivots.len() {
            if i == 0 {
                pivot = diagonal[0];
            } else {
                let factor = off_diagonal[i - 1] / pivot;
                self.lower[i - 1] = factor;
                pivot = diagonal[i] - factor * off_diagonal[i - 1];
            }
            if !(pivot > 0.0 && pivot.is_finite()) {
                return Err(ShearBuildingError::NotPositiveDefinite { row: i + 1, pivot });
            }
            self.pivots[i] = pivot;
        }
        Ok(())
    }

    /// Solves `A x = x` in place.
    pub fn solve_in_place(&self, x: &mut [f64]) {
        let n = self.pivots.len();
        for i in 1..n {
            x[i] -= self.lower[i - 1] * x[i - 1];
        }
        for i in (0..n).rev() {
            x[i] /= self.pivots[i];
            if i + 1 < n {
                x[i] -= self.lower[i] * x[i + 1];
            }
        }
    }
}
