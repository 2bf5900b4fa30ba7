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
    /// In the order of the unknowns, and in the opposite one.
    orders: [Elimination; 2],
    reversed: Vec<f64>,
}

/// A matrix after Gaussian elimination with partial pivoting. Zeros are left out: of rows of buildings most are.
#[derive(Debug, Clone, Default)]
struct Elimination {
    matrix: Vec<f64>,
    /// The row that every column takes its divisor from.
    pivots: Vec<usize>,
    /// Column, row and factor of what is taken off below the diagonal, in their order.
    lower: Vec<(usize, usize, f64)>,
    diagonal: Vec<f64>,
    /// Column and entry beyond the diagonal, row by row, and where each row starts.
    upper: Vec<(usize, f64)>,
    rows: Vec<usize>,
}

impl SmallSolver {
    /// With space for systems of this size.
    pub(crate) fn with_capacity(size: usize) -> Self {
        let elimination = || Elimination {
            matrix: Vec::with_capacity(size * size),
            pivots: Vec::with_capacity(size),
            lower: Vec::with_capacity(size * size / 2),
            diagonal: Vec::with_capacity(size),
            upper: Vec::with_capacity(size * size / 2),
            rows: Vec::with_capacity(size + 1),
        };
        Self {
            orders: [elimination(), elimination()],
            reversed: Vec::with_capacity(size),
        }
    }

    /// Solves `matrix x = x`, row by row storage, in place of `x`. Returns false
    /// if the matrix is singular or holds a NaN; `x` is then unchanged.
    pub(crate) fn solve(&mut self, matrix: &[f64], x: &mut [f64]) -> bool {
        let ready = self.prepare(matrix, x.len());
        if ready {
            self.solve_prepared(x);
        }
        ready
    }

    /// Makes a matrix of so many rows ready for right-hand sides. Returns false if it is singular or holds a NaN.
    pub(crate) fn prepare(&mut self, matrix: &[f64], n: usize) -> bool {
        let [forward, backward] = &mut self.orders;
        match n {
            1 => forward.of(matrix.iter(), n),
            _ => forward.of(matrix.iter(), n) && backward.of(matrix.iter().rev(), n),
        }
    }

    /// Solves with the matrix that was made ready last, in place of `x`.
    pub(crate) fn solve_prepared(&mut self, x: &mut [f64]) {
        let [forward, backward] = &self.orders;
        if x.len() > 1 {
            self.reversed.clear();
            self.reversed.extend(x.iter().rev());
            backward.solve(&mut self.reversed);
        }
        forward.solve(x);
        if x.len() > 1 {
            for (out, other) in x.iter_mut().zip(self.reversed.iter().rev()) {
                *out = 0.5 * (*out + other);
            }
        }
    }
}

impl Elimination {
    /// Eliminates; false if the matrix is singular or holds a NaN.
    fn of<'m>(&mut self, matrix: impl Iterator<Item = &'m f64>, n: usize) -> bool {
        self.matrix.clear();
        self.matrix.extend(matrix);
        self.pivots.clear();
        self.lower.clear();
        self.diagonal.clear();
        self.upper.clear();
        self.rows.clear();
        let a = &mut self.matrix;
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
            }
            self.pivots.push(pivot);
            for row in column + 1..n {
                let factor = a[row * n + column] / divisor;
                if factor != 0.0 {
                    for k in column..n {
                        a[row * n + k] -= factor * a[column * n + k];
                    }
                    self.lower.push((column, row, factor));
                }
            }
        }
        for row in 0..n {
            self.rows.push(self.upper.len());
            self.diagonal.push(a[row * n + row]);
            let beyond = a[row * n..(row + 1) * n].iter().enumerate().skip(row + 1);
            self.upper
                .extend(beyond.filter(|(_, x)| **x != 0.0).map(|(k, x)| (k, *x)));
        }
        self.rows.push(self.upper.len());
        true
    }

    fn solve(&self, x: &mut [f64]) {
        let mut lower = self.lower.iter().peekable();
        for (column, pivot) in self.pivots.iter().enumerate() {
            x.swap(*pivot, column);
            while let Some((_, row, factor)) = lower.next_if(|(of, ..)| *of == column) {
                x[*row] -= factor * x[column];
            }
        }
        for row in (0..x.len()).rev() {
            let beyond = &self.upper[self.rows[row]..self.rows[row + 1]];
            let sum = beyond.iter().fold(x[row], |sum, (k, a)| sum - a * x[*k]);
            x[row] = sum / self.diagonal[row];
        }
    }
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
