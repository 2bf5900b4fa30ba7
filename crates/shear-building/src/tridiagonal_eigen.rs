//! Eigenvalues and eigenvectors of large symmetric tridiagonal matrices.
//!
//! Bisection with Sturm counts (Barth, Martin and Wilkinson, Numerische Mathematik 9
//! (1967) 386) and inverse iteration with Gram-Schmidt in clusters (Peters and Wilkinson,
//! Handbook for Automatic Computation II (1971), II/18; LAPACK `dstebz` and `dstein`):
//! work that grows with the square of the size, and the same bits on every processor.

use nalgebra::DMatrix;
use pounding_vectorised::vectorised;

use crate::tridiagonal::SymmetricTridiagonal;

/// Eigenvalues bisected side by side.
const WIDTH: usize = 8;
/// Groups of so many that are bisected at the same time.
const GROUPS: usize = 4;
/// Solutions of inverse iteration: the first leaves the start behind, and each further one
/// gains as many digits as the eigenvalue has.
const SOLUTIONS: usize = 4;
/// Eigenvalues closer together than this part of the norm are one cluster. Vectors of
/// different clusters are then orthogonal to some `4e-16 / 1e-4`.
const CLUSTER: f64 = 1.0e-4;

/// Eigenvalues, ascending, and the matrix of their unit eigenvectors, one a column.
pub(crate) fn eigen(matrix: &SymmetricTridiagonal) -> (Vec<f64>, DMatrix<f64>) {
    let n = matrix.diagonal.len();
    let bounds = gershgorin(matrix);
    let norm = bounds.0.abs().max(bounds.1.abs()).max(f64::MIN_POSITIVE);
    let values = eigenvalues(matrix, bounds, norm);
    let mut vectors = DMatrix::zeros(n, n);
    let mut factor = Factor::new(n);
    let mut seed = 1_u64;
    let (mut first_of_cluster, mut last_shift) = (0, f64::NEG_INFINITY);
    for j in 0..n {
        if j > 0 && values[j] - values[j - 1] > CLUSTER * norm {
            first_of_cluster = j;
        }
        // Equal shifts would give equal vectors.
        let apart = last_shift + 10.0 * f64::EPSILON * values[j].abs().max(f64::EPSILON * norm);
        let shift = values[j].max(apart);
        last_shift = shift;
        factor.decompose(matrix, shift, norm);
        let (before, mut own) = vectors.columns_range_pair_mut(first_of_cluster..j, j);
        let own = own.as_mut_slice();
        for x in own.iter_mut() {
            *x = random(&mut seed);
        }
        for _ in 0..SOLUTIONS {
            factor.solve(own);
            normalise(own);
            for other in before.column_iter() {
                let part: f64 = other.iter().zip(own.iter()).map(|(a, b)| a * b).sum();
                for (x, a) in own.iter_mut().zip(other.iter()) {
                    *x -= part * a;
                }
            }
            normalise(own);
        }
    }
    (values, vectors)
}

/// Interval that holds all eigenvalues.
fn gershgorin(matrix: &SymmetricTridiagonal) -> (f64, f64) {
    let off = |i: Option<usize>| {
        i.and_then(|i| matrix.off_diagonal.get(i))
            .map_or(0.0, |e| e.abs())
    };
    let mut bounds = (f64::INFINITY, f64::NEG_INFINITY);
    for (i, d) in matrix.diagonal.iter().enumerate() {
        let radius = off(i.checked_sub(1)) + off(Some(i));
        bounds = (bounds.0.min(d - radius), bounds.1.max(d + radius));
    }
    bounds
}

fn eigenvalues(matrix: &SymmetricTridiagonal, bounds: (f64, f64), norm: f64) -> Vec<f64> {
    let n = matrix.diagonal.len();
    let squares: Vec<f64> = matrix.off_diagonal.iter().map(|e| e * e).collect();
    let slack = 2.0 * f64::EPSILON * norm;
    let start = (bounds.0 - slack, bounds.1 + slack);
    let groups = n.div_ceil(WIDTH);
    let mut values = vec![0.0; groups * WIDTH];
    for first in (0..groups).step_by(GROUPS) {
        let mut brackets: [Bracket; GROUPS] = std::array::from_fn(|g| {
            // What is beyond the last is bisected with it.
            let group = (first + g).min(groups - 1);
            let index = std::array::from_fn(|l| (group * WIDTH + l).min(n - 1) as f64);
            Bracket::new(index, start)
        });
        while brackets.iter().any(|b| b.open) {
            let middles = brackets.each_ref().map(|b| b.middle);
            let below = counts_below(&matrix.diagonal, &squares, &middles, norm);
            for (bracket, below) in brackets.iter_mut().zip(&below) {
                bracket.halve(below);
            }
        }
        for (values, bracket) in values.chunks_mut(WIDTH).skip(first).zip(&brackets) {
            values.copy_from_slice(&bracket.middle);
        }
    }
    values.truncate(n);
    values
}

/// Intervals of eigenvalues that are bisected until the last of them is narrow.
struct Bracket {
    index: [f64; WIDTH],
    low: [f64; WIDTH],
    high: [f64; WIDTH],
    middle: [f64; WIDTH],
    open: bool,
}

impl Bracket {
    fn new(index: [f64; WIDTH], (low, high): (f64, f64)) -> Self {
        let mut this = Self {
            index,
            low: [low; WIDTH],
            high: [high; WIDTH],
            middle: [0.0; WIDTH],
            open: true,
        };
        this.look();
        this
    }

    /// Takes the numbers of eigenvalues below the middles, unless all intervals are narrow.
    fn halve(&mut self, below: &[f64; WIDTH]) {
        if !self.open {
            return;
        }
        for l in 0..WIDTH {
            if below[l] > self.index[l] {
                self.high[l] = self.middle[l];
            } else {
                self.low[l] = self.middle[l];
            }
        }
        self.look();
    }

    fn look(&mut self) {
        let (low, high) = (&self.low, &self.high);
        let middle: [f64; WIDTH] = std::array::from_fn(|l| 0.5 * (low[l] + high[l]));
        let open = |l: usize| {
            let scale = low[l].abs().max(high[l].abs());
            high[l] - low[l] > f64::EPSILON * scale + f64::MIN_POSITIVE
                && low[l] < middle[l]
                && middle[l] < high[l]
        };
        self.open = (0..WIDTH).any(open);
        self.middle = middle;
    }
}

/// Number of eigenvalues below each shift: that of negative pivots. Groups of shifts are
/// independent, so that the processor need not wait for the divisions of one.
#[vectorised]
fn counts_below(
    diagonal: &[f64],
    squares: &[f64],
    shifts: &[[f64; WIDTH]; GROUPS],
    norm: f64,
) -> [[f64; WIDTH]; GROUPS] {
    let smallest = f64::MIN_POSITIVE * norm.max(1.0);
    let mut count = [[0.0; WIDTH]; GROUPS];
    let mut pivot = [[1.0; WIDTH]; GROUPS];
    for (i, d) in diagonal.iter().enumerate() {
        let square = if i > 0 { squares[i - 1] } else { 0.0 };
        for g in 0..GROUPS {
            for l in 0..WIDTH {
                let next = d - shifts[g][l] - square / pivot[g][l];
                let next = if next.abs() < smallest {
                    -smallest
                } else {
                    next
                };
                pivot[g][l] = next;
                count[g][l] += if next < 0.0 { 1.0 } else { 0.0 };
            }
        }
    }
    count
}

/// `P L U` factor of a shifted tridiagonal matrix with partial pivoting.
struct Factor {
    /// Rows of `U`: the diagonal and the two entries right of it.
    upper: Vec<[f64; 3]>,
    lower: Vec<f64>,
    exchanged: Vec<bool>,
}

impl Factor {
    fn new(size: usize) -> Self {
        Self {
            upper: vec![[0.0; 3]; size],
            lower: vec![0.0; size],
            exchanged: vec![false; size],
        }
    }

    fn decompose(&mut self, matrix: &SymmetricTridiagonal, shift: f64, norm: f64) {
        let n = matrix.diagonal.len();
        let off = |i: usize| matrix.off_diagonal.get(i).copied().unwrap_or(0.0);
        let smallest = f64::EPSILON * norm;
        let mut row = [matrix.diagonal[0] - shift, off(0), 0.0];
        for i in 0..n {
            if i + 1 == n {
                self.upper[i] = [not_zero(row[0], smallest), 0.0, 0.0];
                return;
            }
            let below = [off(i), matrix.diagonal[i + 1] - shift, off(i + 1)];
            let exchange = below[0].abs() > row[0].abs();
            let (mut pivot, other) = if exchange { (below, row) } else { (row, below) };
            pivot[0] = not_zero(pivot[0], smallest);
            let factor = other[0] / pivot[0];
            self.upper[i] = pivot;
            self.lower[i] = factor;
            self.exchanged[i] = exchange;
            row = [
                other[1] - factor * pivot[1],
                other[2] - factor * pivot[2],
                0.0,
            ];
        }
    }

    fn solve(&self, x: &mut [f64]) {
        let n = x.len();
        for i in 0..n - 1 {
            if self.exchanged[i] {
                x.swap(i, i + 1);
            }
            x[i + 1] -= self.lower[i] * x[i];
        }
        for i in (0..n).rev() {
            let [pivot, first, second] = self.upper[i];
            let mut sum = x[i];
            if i + 1 < n {
                sum -= first * x[i + 1];
            }
            if i + 2 < n {
                sum -= second * x[i + 2];
            }
            x[i] = sum / pivot;
        }
    }
}

/// A pivot that may be divided by: the matrix is singular to round-off by design.
fn not_zero(pivot: f64, smallest: f64) -> f64 {
    if pivot.abs() < smallest {
        smallest.copysign(pivot)
    } else {
        pivot
    }
}

/// Length one, without overflow on the way.
fn normalise(x: &mut [f64]) {
    let largest = x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return;
    }
    let sum: f64 = x.iter().map(|x| (x / largest) * (x / largest)).sum();
    let scale = 1.0 / sum.sqrt();
    for x in x {
        *x = (*x / largest) * scale;
    }
}

/// Components of a start vector, from -1 to 1 (Steele, Lea and Flood, 2014: SplitMix64).
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *seed;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    2.0 * ((z ^ (z >> 31)) as f64 / u64::MAX as f64) - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn orthogonality(vectors: &DMatrix<f64>) -> f64 {
        let n = vectors.ncols();
        (vectors.transpose() * vectors - DMatrix::identity(n, n)).amax()
    }

    fn residual(matrix: &SymmetricTridiagonal, values: &[f64], vectors: &DMatrix<f64>) -> f64 {
        let mut out = vec![0.0; values.len()];
        let mut worst = 0.0_f64;
        for (j, value) in values.iter().enumerate() {
            let x: Vec<f64> = vectors.column(j).iter().copied().collect();
            matrix.multiply(&x, &mut out);
            for (a, b) in out.iter().zip(&x) {
                worst = worst.max((a - value * b).abs());
            }
        }
        worst
    }

    /// A uniform chain: `lambda_j = 4 sin^2(pi (2 j - 1) / (4 n + 2))`.
    #[test]
    fn a_uniform_chain_has_its_closed_form() {
        let n = 300;
        let matrix = SymmetricTridiagonal::chain(&vec![1.0; n]);
        let (values, vectors) = eigen(&matrix);
        for (j, value) in values.iter().enumerate() {
            let half = std::f64::consts::PI * (2 * j + 1) as f64 / (4 * n + 2) as f64;
            let exact = 4.0 * libm::sin(half) * libm::sin(half);
            assert!((value - exact).abs() < 4.0e-15, "{j}: {value} {exact}");
        }
        assert!(orthogonality(&vectors) < 1.0e-11);
        assert!(residual(&matrix, &values, &vectors) < 1.0e-13);
    }

    /// Equal towers on almost nothing between them: pairs that differ by round-off, and
    /// Wilkinson's matrix, whose largest pairs agree to 15 digits.
    #[test]
    fn eigenvalues_that_almost_agree_have_orthogonal_vectors() {
        let wilkinson = SymmetricTridiagonal {
            diagonal: (0..121).map(|i| f64::from((60_i32 - i).abs())).collect(),
            off_diagonal: vec![1.0; 120],
        };
        let mut storeys = vec![1.0; 150];
        for link in storeys.iter_mut().step_by(30) {
            *link = 1.0e-13;
        }
        for matrix in [wilkinson, SymmetricTridiagonal::chain(&storeys)] {
            let (values, vectors) = eigen(&matrix);
            assert!(values.is_sorted());
            assert!(
                orthogonality(&vectors) < 1.0e-11,
                "{}",
                orthogonality(&vectors)
            );
            let residual = residual(&matrix, &values, &vectors);
            assert!(residual < 1.0e-12, "{residual:e}");
        }
    }

    #[test]
    fn it_agrees_with_a_dense_solver() {
        let mut seed = 7;
        let n = 130;
        let mut positive = || 1.5 + random(&mut seed);
        let matrix = SymmetricTridiagonal::chain(&(0..n).map(|_| positive()).collect::<Vec<_>>());
        let dense = DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => matrix.diagonal[i],
            1 => matrix.off_diagonal[i.min(j)],
            _ => 0.0,
        });
        let mut expected: Vec<f64> = dense.symmetric_eigenvalues().iter().copied().collect();
        expected.sort_by(f64::total_cmp);
        let (values, vectors) = eigen(&matrix);
        for (a, b) in values.iter().zip(&expected) {
            assert!((a - b).abs() < 1.0e-13, "{a} {b}");
        }
        assert!(orthogonality(&vectors) < 1.0e-11);
    }

    /// The last group takes part with copies of itself where groups run out.
    #[test]
    fn eigenvalues_do_not_depend_on_those_bisected_at_the_same_time() {
        let mut seed = 11;
        let n = 8 * WIDTH * GROUPS + 2 * WIDTH + 3;
        let storeys: Vec<f64> = (0..n).map(|_| 1.5 + random(&mut seed)).collect();
        let matrix = SymmetricTridiagonal::chain(&storeys);
        let squares: Vec<f64> = matrix.off_diagonal.iter().map(|e| e * e).collect();
        let bounds = gershgorin(&matrix);
        let norm = bounds.1;
        let values = eigenvalues(&matrix, bounds, norm);
        let slack = 2.0 * f64::EPSILON * norm;
        for (group, values) in values.chunks(WIDTH).enumerate() {
            let index = std::array::from_fn(|l| (group * WIDTH + l).min(n - 1) as f64);
            let mut alone = Bracket::new(index, (bounds.0 - slack, bounds.1 + slack));
            while alone.open {
                let shifts = [alone.middle; GROUPS];
                alone.halve(&counts_below(&matrix.diagonal, &squares, &shifts, norm)[0]);
            }
            assert_eq!(values, &alone.middle[..values.len()]);
        }
    }
}
