//! Dense systems of a handful of unknowns, in place and without allocation.
//!
//! Contact forces of the implicit methods and the forces that hold stuck floors
//! come from systems as large as the number of levels in touch. Systems of more
//! than one unknown are eliminated in both orders and averaged: a case and its
//! mirror image number their gaps the other way round, and this makes their
//! answers equal to the last bit.

/// Work space that grows to the largest system met and is then reused.
#[derive(Debug, Clone, Default)]
pub(crate) struct SmallSolver {
    matrix: Vec<f64>,
    forward: Vec<f64>,
    backward: Vec<f64>,
}

impl SmallSolver {
    /// With space for systems of this size.
    pub(crate) fn with_capacity(size: usize) -> Self {
        Self {
            matrix: Vec::with_capacity(size * size),
            forward: Vec::with_capacity(size),
            backward: Vec::with_capacity(size),
        }
    }

    /// Solves `matrix x = x`, row by row storage, in place of `x`. Returns false
    /// if the matrix is singular or holds a NaN; `x` is then unchanged.
    pub(crate) fn solve(&mut self, matrix: &[f64], x: &mut [f64]) -> bool {
        let n = x.len();
        if n == 1 {
            if !(matrix[0] != 0.0 && matrix[0].is_finite()) {
                return false;
            }
            x[0] /= matrix[0];
            return true;
        }
        self.matrix.clear();
        self.matrix.extend_from_slice(matrix);
        self.forward.clear();
        self.forward.extend_from_slice(x);
        if !eliminate(&mut self.matrix, &mut self.forward) {
            return false;
        }
        self.matrix.clear();
        self.matrix.extend(matrix.iter().rev());
        self.backward.clear();
        self.backward.extend(x.iter().rev());
        if !eliminate(&mut self.matrix, &mut self.backward) {
            return false;
        }
        for (i, out) in x.iter_mut().enumerate() {
            *out = 0.5 * (self.forward[i] + self.backward[n - 1 - i]);
        }
        true
    }
}

/// Gaussian elimination with partial pivoting.
fn eliminate(a: &mut [f64], x: &mut [f64]) -> bool {
    let n = x.len();
    for column in 0..n {
        let mut pivot = column;
        for row in column + 1..n {
            if a[row * n + column].abs() > a[pivot * n + column].abs() {
                pivot = row;
            }
        }
        let divisor = a[pivot * n + column];
        if !(divisor != 0.0 && divisor.is_finite()) {
            return false;
        }
        if pivot != column {
            for k in 0..n {
                a.swap(pivot * n + k, column * n + k);
            }
            x.swap(pivot, column);
        }
        for row in column + 1..n {
            let factor = a[row * n + column] / divisor;
            if factor != 0.0 {
                for k in column..n {
                    a[row * n + k] -= factor * a[column * n + k];
                }
                x[row] -= factor * x[column];
            }
        }
    }
    for row in (0..n).rev() {
        let mut sum = x[row];
        for k in row + 1..n {
            sum -= a[row * n + k] * x[k];
        }
        x[row] = sum / a[row * n + row];
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_and_mirrors_bit_for_bit() {
        let a = [4.0, 1.0, 0.3, 1.1, 5.0, 0.7, 0.2, 0.6, 3.0];
        let b = [1.0, -2.0, 0.5];
        let mut solver = SmallSolver::default();
        let mut x = b;
        assert!(solver.solve(&a, &mut x));
        for row in 0..3 {
            let sum: f64 = (0..3).map(|k| a[row * 3 + k] * x[k]).sum();
            assert!((sum - b[row]).abs() < 1e-14);
        }
        let mirrored: Vec<f64> = a.iter().rev().copied().collect();
        let mut y = [b[2], b[1], b[0]];
        assert!(solver.solve(&mirrored, &mut y));
        assert_eq!([y[2], y[1], y[0]], x);
    }

    #[test]
    fn a_singular_matrix_is_reported() {
        let mut x = [1.0, 1.0];
        assert!(!SmallSolver::default().solve(&[1.0, 2.0, 2.0, 4.0], &mut x));
        assert_eq!(x, [1.0, 1.0]);
    }
}
