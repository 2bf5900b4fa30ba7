//! Lateral stiffness of frames and walls, condensed to the displacements of the floors.
//!
//! What a frame program exports is a stiffness or a flexibility matrix of the floors; for a
//! wall and for a frame with flexible beams it is made here from what they consist of. The
//! rotations of the floors, which carry no mass, are condensed out:
//! `K = K_uu - K_ur K_rr^-1 K_ru` (Guyan, Reduction of stiffness and mass matrices, AIAA
//! Journal 3 (1965) 380).

use nalgebra::DMatrix;

/// A stiffness matrix of floors (N/m): symmetric and positive definite.
#[derive(Debug, Clone, PartialEq)]
pub struct LateralStiffness {
    matrix: DMatrix<f64>,
    asymmetry: f64,
    /// Heights of the storeys that it was made from, if it was.
    heights: Option<Vec<f64>>,
}

/// A matrix that is no stiffness of a building.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LateralStiffnessError {
    /// A building without floors.
    #[error("a matrix of no floors")]
    Empty,
    /// Rows of the wrong length.
    #[error("the matrix is not square: row {row} has {found} of {expected} entries")]
    NotSquare {
        /// Row, from 1.
        row: usize,
        /// Its entries.
        found: usize,
        /// Number of rows.
        expected: usize,
    },
    /// An entry that is not a finite number.
    #[error("row {row}, column {column}: {value} is not a finite number")]
    NotFinite {
        /// Row, from 1.
        row: usize,
        /// Column, from 1.
        column: usize,
        /// Entry.
        value: f64,
    },
    /// Entries that should be the same.
    #[error(
        "the matrix is not symmetric: row {row}, column {column} is {value}, row {column}, column {row} is {other}"
    )]
    Asymmetric {
        /// Row, from 1.
        row: usize,
        /// Column, from 1.
        column: usize,
        /// Entry.
        value: f64,
        /// The entry on the other side of the diagonal.
        other: f64,
    },
    /// A structure that moves without resistance.
    #[error(
        "the matrix is not positive definite: its smallest eigenvalue is {smallest:e}, its largest {largest:e}; the structure is a mechanism: is a support missing, or a sign wrong?"
    )]
    NotPositiveDefinite {
        /// Smallest eigenvalue.
        smallest: f64,
        /// Largest eigenvalue.
        largest: f64,
    },
    /// Damping that gives energy to a motion.
    #[error(
        "the damping matrix gives energy to some motions: its smallest eigenvalue is {smallest:e}, its largest {largest:e}; is a sign wrong?"
    )]
    NotPositiveSemidefinite {
        /// Smallest eigenvalue.
        smallest: f64,
        /// Largest eigenvalue.
        largest: f64,
    },
    /// A flexibility whose inverse is round-off.
    #[error(
        "the flexibility matrix cannot be inverted: its smallest eigenvalue is round-off, 1/{condition:.0e} of the largest; give more digits, or the stiffness matrix"
    )]
    IllConditioned {
        /// Ratio of the largest to the smallest eigenvalue.
        condition: f64,
    },
    /// Lists of unequal length.
    #[error("{quantity} has {found} values for {expected} storeys")]
    Length {
        /// Quantity.
        quantity: &'static str,
        /// Values given.
        found: usize,
        /// Storeys.
        expected: usize,
    },
    /// A value that is not positive and finite.
    #[error("storey {storey}: {quantity} = {value} must be greater than zero")]
    Value {
        /// Quantity.
        quantity: &'static str,
        /// Storey, from 1.
        storey: usize,
        /// Value (SI).
        value: f64,
    },
}

impl LateralStiffnessError {
    /// What to try, where it is the same for a case file and for code.
    #[must_use]
    pub fn help(&self) -> &'static str {
        match self {
            Self::NotPositiveSemidefinite { .. } => {
                "give the coefficients that multiply velocities in the forces against them: positive on the diagonal"
            }
            Self::Length { .. } | Self::Value { .. } => {
                "give one value for each storey, the lowest first, and greater than zero"
            }
            _ => {
                "give the matrix of the floors as the frame program exports it: bottom floor first, all other coordinates condensed out"
            }
        }
    }
}

/// Difference of entries that should be the same, over the largest entry, up to which
/// their mean is taken.
const LARGEST_ASYMMETRY: f64 = 1.0e-6;
/// Largest over smallest eigenvalue from which on the sign of the smallest one may come from
/// rounded digits.
const ROUNDED: f64 = 1.0e4;
/// Condition number of a flexibility matrix at most.
const LARGEST_CONDITION: f64 = 1.0e12;

impl LateralStiffness {
    /// A stiffness matrix (N/m), row after row, floors from the bottom. Entries on both sides
    /// of the diagonal may differ by 1e-6 of the largest one: their mean is taken.
    ///
    /// # Errors
    /// Rows of unequal length, entries that are not finite, and a matrix that is not
    /// symmetric or not positive definite.
    pub fn from_rows(rows: &[Vec<f64>]) -> Result<Self, LateralStiffnessError> {
        let (matrix, asymmetry) = symmetric(rows)?;
        Self::new(matrix, asymmetry)
    }

    /// The inverse of a flexibility matrix (m/N): displacements of the floors under a unit
    /// force on each.
    ///
    /// # Errors
    /// As [`LateralStiffness::from_rows`], and a condition number above 1e12.
    pub fn from_flexibility(rows: &[Vec<f64>]) -> Result<Self, LateralStiffnessError> {
        let (matrix, asymmetry) = symmetric(rows)?;
        Self::inverse_of(matrix, asymmetry)
    }

    /// A cantilever wall with one flexural rigidity `EI` (N m2) a storey, and one shear
    /// rigidity `kappa G A` (N) if it deforms in shear, storeys of these heights (m) from the
    /// bottom. The flexibility is that of Castigliano's theorem, which is exact:
    /// `F_ij = int (z_i - z)(z_j - z) / EI dz + int 1 / (kappa G A) dz` up to the lower of both
    /// floors (for one `EI`, `z_i^2 (3 z_j - z_i) / (6 EI)`).
    ///
    /// # Errors
    /// No storeys, lists of unequal length, or a value that is not positive.
    pub fn cantilever(
        heights: &[f64],
        flexural_rigidity: &[f64],
        shear_rigidity: Option<&[f64]>,
    ) -> Result<Self, LateralStiffnessError> {
        let n = heights.len();
        positive("height", heights, n)?;
        positive("flexural_rigidity", flexural_rigidity, n)?;
        if let Some(shear) = shear_rigidity {
            positive("shear_rigidity", shear, n)?;
        }
        let floors: Vec<f64> = heights
            .iter()
            .scan(0.0, |top, h| {
                *top += h;
                Some(*top)
            })
            .collect();
        let flexibility = |i: usize, j: usize| {
            let (a, b) = (floors[i], floors[j]);
            let storeys = 0..=i.min(j);
            let parts = storeys.map(|s| {
                let (bottom, top) = (floors[s] - heights[s], floors[s]);
                let arm = |z: f64| (a - z) * (b - z);
                // Simpson's rule is exact for a square.
                let middle = 0.5 * (bottom + top);
                let bending = (arm(bottom) + 4.0 * arm(middle) + arm(top)) / 6.0;
                let shear = shear_rigidity.map_or(0.0, |rigidity| 1.0 / rigidity[s]);
                heights[s] * (bending / flexural_rigidity[s] + shear)
            });
            parts.sum::<f64>()
        };
        let matrix = DMatrix::from_fn(n, n, |i, j| flexibility(i.min(j), i.max(j)));
        Ok(Self::inverse_of(matrix, 0.0)?.of_heights(heights))
    }

    /// A frame as a fishbone: one column with the flexural rigidity `EI` (N m2) of all columns
    /// of a storey, fixed at its base, and a rotational spring (N m) at every floor in the
    /// place of its beams: `12 E I_b / L` for one bay of span `L` between two columns.
    /// Rotations of the floors are condensed out.
    ///
    /// # Errors
    /// As [`LateralStiffness::cantilever`].
    pub fn fishbone(
        heights: &[f64],
        column_flexural_rigidity: &[f64],
        beam_stiffness: &[f64],
    ) -> Result<Self, LateralStiffnessError> {
        let n = heights.len();
        positive("height", heights, n)?;
        positive("column_flexural_rigidity", column_flexural_rigidity, n)?;
        positive("beam_stiffness", beam_stiffness, n)?;
        // Displacements of the floors, then their rotations.
        let mut whole = DMatrix::<f64>::zeros(2 * n, 2 * n);
        for (s, (h, rigidity)) in heights.iter().zip(column_flexural_rigidity).enumerate() {
            let k = rigidity / (h * h * h);
            let column = [
                [12.0, 6.0 * h, -12.0, 6.0 * h],
                [6.0 * h, 4.0 * h * h, -6.0 * h, 2.0 * h * h],
                [-12.0, -6.0 * h, 12.0, -6.0 * h],
                [6.0 * h, 2.0 * h * h, -6.0 * h, 4.0 * h * h],
            ];
            let below = s.checked_sub(1);
            let places = [below, below.map(|b| n + b), Some(s), Some(n + s)];
            for (row, place) in column.iter().zip(places) {
                for (entry, other) in row.iter().zip(places) {
                    if let (Some(i), Some(j)) = (place, other) {
                        whole[(i, j)] += k * entry;
                    }
                }
            }
            whole[(n + s, n + s)] += beam_stiffness[s];
        }
        let rotations = whole.view((n, n), (n, n)).clone_owned();
        let coupling = whole.view((n, 0), (n, n)).clone_owned();
        let mut matrix = whole.view((0, 0), (n, n)).clone_owned();
        if let Some(factor) = rotations.cholesky() {
            matrix -= coupling.transpose() * factor.solve(&coupling);
        }
        let mean = DMatrix::from_fn(n, n, |i, j| 0.5 * (matrix[(i, j)] + matrix[(j, i)]));
        Ok(Self::new(mean, 0.0)?.of_heights(heights))
    }

    fn of_heights(self, heights: &[f64]) -> Self {
        Self {
            heights: Some(heights.to_vec()),
            ..self
        }
    }

    fn new(matrix: DMatrix<f64>, asymmetry: f64) -> Result<Self, LateralStiffnessError> {
        let values = matrix.symmetric_eigenvalues();
        let (smallest, largest) = (values.min(), values.max());
        if !(smallest > f64::EPSILON * largest) {
            return Err(LateralStiffnessError::NotPositiveDefinite { smallest, largest });
        }
        Ok(Self {
            matrix,
            asymmetry,
            heights: None,
        })
    }

    fn inverse_of(matrix: DMatrix<f64>, asymmetry: f64) -> Result<Self, LateralStiffnessError> {
        let values = matrix.symmetric_eigenvalues();
        let (smallest, largest) = (values.min(), values.max());
        let condition = largest / smallest.abs();
        if !(smallest > 0.0) && !(condition > ROUNDED) {
            return Err(LateralStiffnessError::NotPositiveDefinite { smallest, largest });
        }
        let inverse = matrix.cholesky().map(|f| f.inverse());
        match inverse.filter(|_| smallest > 0.0 && condition <= LARGEST_CONDITION) {
            Some(inverse) => {
                let n = inverse.nrows();
                let mean = |i, j| 0.5 * (inverse[(i, j)] + inverse[(j, i)]);
                Self::new(DMatrix::from_fn(n, n, mean), asymmetry)
            }
            None => Err(LateralStiffnessError::IllConditioned { condition }),
        }
    }

    /// Number of floors.
    #[must_use]
    pub fn floors(&self) -> usize {
        self.matrix.nrows()
    }

    /// Difference of entries on both sides of the diagonal that was found, over the largest
    /// entry; their mean was taken.
    #[must_use]
    pub fn asymmetry(&self) -> f64 {
        self.asymmetry
    }

    /// Heights (m) of the storeys of a wall or a frame, from the bottom; `None` for a matrix that was given
    /// as such.
    #[must_use]
    pub fn heights(&self) -> Option<&[f64]> {
        self.heights.as_deref()
    }

    pub(crate) fn into_matrix(self) -> DMatrix<f64> {
        self.matrix
    }
}

/// The matrix of these rows with the means of entries that should be the same, and the largest
/// difference of such entries over the largest entry.
pub(crate) fn symmetric(rows: &[Vec<f64>]) -> Result<(DMatrix<f64>, f64), LateralStiffnessError> {
    let n = rows.len();
    if n == 0 {
        return Err(LateralStiffnessError::Empty);
    }
    for (i, row) in rows.iter().enumerate() {
        if row.len() != n {
            return Err(LateralStiffnessError::NotSquare {
                row: i + 1,
                found: row.len(),
                expected: n,
            });
        }
        if let Some(j) = row.iter().position(|x| !x.is_finite()) {
            return Err(LateralStiffnessError::NotFinite {
                row: i + 1,
                column: j + 1,
                value: row[j],
            });
        }
    }
    let largest = rows.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let mut asymmetry = 0.0_f64;
    for i in 0..n {
        for j in 0..i {
            let difference = (rows[i][j] - rows[j][i]).abs() / largest;
            if difference > LARGEST_ASYMMETRY {
                return Err(LateralStiffnessError::Asymmetric {
                    row: i + 1,
                    column: j + 1,
                    value: rows[i][j],
                    other: rows[j][i],
                });
            }
            asymmetry = asymmetry.max(difference);
        }
    }
    let mean = |i: usize, j: usize| 0.5 * (rows[i][j] + rows[j][i]);
    Ok((DMatrix::from_fn(n, n, mean), asymmetry))
}

fn positive(
    quantity: &'static str,
    values: &[f64],
    expected: usize,
) -> Result<(), LateralStiffnessError> {
    if values.len() != expected {
        return Err(LateralStiffnessError::Length {
            quantity,
            found: values.len(),
            expected,
        });
    }
    match values.iter().position(|x| !(x.is_finite() && *x > 0.0)) {
        None if expected == 0 => Err(LateralStiffnessError::Empty),
        None => Ok(()),
        Some(i) => Err(LateralStiffnessError::Value {
            quantity,
            storey: i + 1,
            value: values[i],
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: &LateralStiffness, expected: &[&[f64]], tolerance: f64) {
        let largest = found.matrix.amax();
        for (i, row) in expected.iter().enumerate() {
            for (j, x) in row.iter().enumerate() {
                let error = (found.matrix[(i, j)] - x).abs();
                assert!(error < tolerance * largest, "{i}, {j}: {error:e}");
            }
        }
    }

    #[test]
    fn no_floors_have_no_matrix() {
        for made in [
            LateralStiffness::from_rows(&[]),
            LateralStiffness::from_flexibility(&[]),
            LateralStiffness::cantilever(&[], &[], None),
            LateralStiffness::fishbone(&[], &[], &[]),
        ] {
            assert!(matches!(made, Err(LateralStiffnessError::Empty)));
        }
    }

    /// The closed form `z_i^2 (3 z_j - z_i) / (6 EI)` of a uniform cantilever, inverted.
    #[test]
    fn a_uniform_cantilever_has_its_closed_form() {
        let rigidity = 6.0e9;
        let z = [3.0_f64, 6.0, 9.0, 12.0];
        let flexibility = |i: usize, j: usize| {
            let (a, b) = (z[i.min(j)], z[i.max(j)]);
            a * a * (3.0 * b - a) / (6.0 * rigidity)
        };
        let rows: Vec<Vec<f64>> = (0..4)
            .map(|i| (0..4).map(|j| flexibility(i, j)).collect())
            .collect();
        let expected = LateralStiffness::from_flexibility(&rows).unwrap();
        let found = LateralStiffness::cantilever(&[3.0; 4], &[rigidity; 4], None).unwrap();
        let difference = (&found.matrix - &expected.matrix).amax();
        assert!(difference < 1e-11 * expected.matrix.amax(), "{difference}");
    }

    /// With a flexural rigidity beyond all measure, only shear is left: storeys of
    /// `kappa G A / h`.
    #[test]
    fn a_cantilever_that_bends_nowhere_is_a_shear_building() {
        let shear = [3.0e8, 2.0e8, 1.0e8];
        let found =
            LateralStiffness::cantilever(&[3.0, 4.0, 5.0], &[1.0e22; 3], Some(&shear)).unwrap();
        let k = [1.0e8, 0.5e8, 0.2e8];
        near(
            &found,
            &[
                &[k[0] + k[1], -k[1], 0.0],
                &[-k[1], k[1] + k[2], -k[2]],
                &[0.0, -k[2], k[2]],
            ],
            1e-10,
        );
    }

    /// A frame whose beams do not bend is a shear building with `12 EI / h^3` a storey; one
    /// without beams a cantilever.
    #[test]
    fn a_fishbone_has_its_limits() {
        let found = LateralStiffness::fishbone(&[3.0; 2], &[2.7e8; 2], &[1.0e22; 2]).unwrap();
        let k = 12.0 * 2.7e8 / 27.0;
        near(&found, &[&[2.0 * k, -k], &[-k, k]], 1e-12);
        let bare = LateralStiffness::fishbone(&[3.0; 3], &[2.7e8; 3], &[1.0e-3; 3]).unwrap();
        let wall = LateralStiffness::cantilever(&[3.0; 3], &[2.7e8; 3], None).unwrap();
        let difference = (&bare.matrix - &wall.matrix).amax();
        assert!(difference < 1e-9 * wall.matrix.amax());
    }

    /// A frame of three storeys of 3 m, columns 240 MN m2, beams 150 MN m2 over 6 m: the
    /// matrix of an independent condensation (a script in Python, with long doubles).
    #[test]
    fn a_fishbone_agrees_with_an_independent_condensation() {
        let spring = 12.0 * 1.5e8 / 6.0;
        let found = LateralStiffness::fishbone(&[3.0; 3], &[2.4e8; 3], &[spring; 3]).unwrap();
        near(
            &found,
            &[
                &[183957870.64018354, -104085980.85697334, 21794698.127175644],
                &[-104085980.85697334, 144582250.43447214, -67291046.46095526],
                &[21794698.127175644, -67291046.46095526, 49206084.18521376],
            ],
            1e-13,
        );
    }

    #[test]
    fn what_is_no_stiffness_is_refused_with_its_place() {
        let text = |rows: &[Vec<f64>]| LateralStiffness::from_rows(rows).unwrap_err().to_string();
        assert!(text(&[vec![1.0, 2.0], vec![3.0]]).contains("row 2 has 1 of 2 entries"));
        let rows = [vec![4.0e7, 3.4e7], vec![3.1e7, 9.0e7]];
        assert!(text(&rows).contains("row 2, column 1 is 31000000"));
        let rows = [vec![1.0e8, -1.0e8], vec![-1.0e8, 1.0e8]];
        assert!(text(&rows).contains("mechanism"));
        assert!(text(&[vec![f64::NAN]]).contains("row 1, column 1"));
        let rows = [vec![1.0, 1.0 - 1.0e-14], vec![1.0 - 1.0e-14, 1.0]];
        let error = LateralStiffness::from_flexibility(&rows).unwrap_err();
        assert!(error.to_string().contains("round-off"), "{error}");
        let slightly = [vec![2.0e8, -1.0e8], vec![-1.000_000_1e8, 1.0e8]];
        let taken = LateralStiffness::from_rows(&slightly).unwrap();
        assert!(taken.asymmetry() > 0.0);
        assert_eq!(taken.matrix[(0, 1)], taken.matrix[(1, 0)]);
    }
}
