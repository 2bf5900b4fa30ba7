//! Viscous damping of a building.

use nalgebra::DMatrix;
use pounding_vectorised::vectorised;

use crate::dense::multiply;
use crate::lateral::{LateralStiffnessError, symmetric};
use crate::stiffness::StiffnessMatrix;
use crate::tridiagonal::SymmetricTridiagonal;
use crate::undamped::{LARGE, Undamped, undamped};

/// How a building is damped.
#[derive(Debug, Clone, PartialEq)]
pub enum Damping {
    /// `C = alpha M + beta K` with given factors (Rayleigh 1877).
    Rayleigh {
        /// Mass factor (1/s).
        alpha: f64,
        /// Stiffness factor (s).
        beta: f64,
    },
    /// `C = alpha M + beta K` with the same ratio in two modes.
    RayleighRatio {
        /// Damping ratio (-).
        ratio: f64,
        /// The two modes, from 1.
        modes: [usize; 2],
    },
    /// `C = beta K` with this ratio in the first mode.
    StiffnessProportional {
        /// Damping ratio of mode 1 (-).
        ratio: f64,
    },
    /// `C = alpha M` with this ratio in the first mode.
    MassProportional {
        /// Damping ratio of mode 1 (-).
        ratio: f64,
    },
    /// `C = M Phi diag(2 zeta omega) Phi' M`: one ratio per mode, or a single one
    /// for all modes. Modes beyond the list are an error, not undamped.
    Modal {
        /// Damping ratios from the first mode (-).
        ratios: Vec<f64>,
    },
    /// A dashpot in every storey, between the floor and the one below.
    Dashpots {
        /// Coefficients from the bottom (N s/m).
        coefficients: Vec<f64>,
    },
    /// A given matrix, symmetric and positive semi-definite; [`Damping::from_rows`] makes it.
    Matrix {
        /// One row a coordinate, floors first (N s/m; N m s/rad on the diagonal of rotations).
        matrix: DMatrix<f64>,
    },
    /// A building on isolators, which are its first storey: the storeys above are damped as
    /// if their base slab, the first floor, were fixed, and the isolators by a dashpot.
    /// Ratios are those of the modes above the fixed slab, and the matrix acts on velocities
    /// relative to the slab, so that nothing of it brakes the isolators (Ryan and Polanco,
    /// Journal of Structural Engineering 134 (2008) 1780): `C = T' C_s T + c e1 e1'`.
    Isolated {
        /// Damping of the storeys above the slab.
        superstructure: Box<Damping>,
        /// Dashpot of all isolators together (N s/m).
        isolators: f64,
    },
}

/// The damping matrix of a building (N s/m).
#[derive(Debug, Clone, PartialEq)]
pub enum DampingMatrix {
    /// All kinds but modal damping of a chain of storeys.
    Tridiagonal(SymmetricTridiagonal),
    /// Modal damping, and damping in proportion to a full stiffness matrix, couple every
    /// floor with every other.
    Dense(DMatrix<f64>),
}

impl DampingMatrix {
    /// `out = C v` (N).
    pub fn multiply(&self, v: &[f64], out: &mut [f64]) {
        match self {
            Self::Tridiagonal(c) => c.multiply(v, out),
            Self::Dense(c) => multiply(c, v, out),
        }
    }
}

impl DampingMatrix {
    /// Entry in a row and a column, both from zero (N s/m).
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        match self {
            Self::Tridiagonal(c) => c.entry(row, column),
            Self::Dense(c) => c[(row, column)],
        }
    }
}

/// Negative eigenvalue, over the largest one, that rounded digits of a matrix may leave of zero.
const ROUNDED: f64 = 1.0e-6;

impl Damping {
    /// A given matrix, row after row, one a coordinate, floors first from the bottom (N s/m; N m s/rad on
    /// the diagonal of rotations). Entries on both sides of the diagonal may differ by 1e-6 of the largest
    /// one: their mean is taken.
    ///
    /// # Errors
    /// No rows, rows that are not as long as there are rows, entries that are not finite, a matrix
    /// that is not symmetric, and one that gives energy to a motion: negative eigenvalues, but for what rounded digits leave
    /// of those that are zero.
    pub fn from_rows(rows: &[Vec<f64>]) -> Result<Self, LateralStiffnessError> {
        let (matrix, _) = symmetric(rows)?;
        let eigenvalues = matrix.symmetric_eigenvalues();
        let (smallest, largest) = (eigenvalues.min(), eigenvalues.max());
        if smallest < -ROUNDED * eigenvalues.amax() {
            return Err(LateralStiffnessError::NotPositiveSemidefinite { smallest, largest });
        }
        Ok(Self::Matrix { matrix })
    }

    /// Whether the damping forces of one mode may move others: no ratios of the modes say
    /// then all of it.
    #[must_use]
    pub fn couples_modes(&self) -> bool {
        matches!(
            self,
            Self::Dashpots { .. } | Self::Isolated { .. } | Self::Matrix { .. }
        )
    }

    /// `[alpha, beta]` of damping in proportion to mass and stiffness, of a building with these
    /// circular frequencies; `None` for other damping. Fails with the reason.
    pub(crate) fn factors(&self, omega: &[f64]) -> Result<Option<[f64; 2]>, String> {
        let n = omega.len();
        Ok(Some(match self {
            Self::Rayleigh { alpha, beta } => {
                not_negative("alpha", *alpha)?;
                not_negative("beta", *beta)?;
                [*alpha, *beta]
            }
            Self::RayleighRatio { ratio, modes } => {
                check_ratio(*ratio)?;
                let [i, j] = *modes;
                if i == j || i == 0 || j == 0 || i > n || j > n {
                    return Err(format!(
                        "modes = [{i}, {j}] must be two different modes from 1 to {n}"
                    ));
                }
                let (a, b) = (omega[i - 1], omega[j - 1]);
                [2.0 * ratio * a * b / (a + b), 2.0 * ratio / (a + b)]
            }
            Self::StiffnessProportional { ratio } => {
                check_ratio(*ratio)?;
                [0.0, 2.0 * ratio / omega[0]]
            }
            Self::MassProportional { ratio } => {
                check_ratio(*ratio)?;
                [2.0 * ratio * omega[0], 0.0]
            }
            _ => return Ok(None),
        }))
    }

    /// The damping matrix, or the reason why there is none.
    pub(crate) fn matrix(
        &self,
        mass: &[f64],
        stiffness: &StiffnessMatrix,
        modes: &Undamped,
    ) -> Result<DampingMatrix, String> {
        let n = mass.len();
        let omega = &modes.circular_frequency;
        let proportional = |alpha: f64, beta: f64| match stiffness {
            StiffnessMatrix::Tridiagonal(k) => DampingMatrix::Tridiagonal(SymmetricTridiagonal {
                diagonal: (0..n)
                    .map(|i| alpha * mass[i] + beta * k.diagonal[i])
                    .collect(),
                off_diagonal: k.off_diagonal.iter().map(|k| beta * k).collect(),
            }),
            StiffnessMatrix::Dense(k) => DampingMatrix::Dense(DMatrix::from_fn(n, n, |i, j| {
                let inertia = if i == j { alpha * mass[i] } else { 0.0 };
                inertia + beta * k[(i, j)]
            })),
        };
        match self {
            Self::Rayleigh { .. }
            | Self::RayleighRatio { .. }
            | Self::StiffnessProportional { .. }
            | Self::MassProportional { .. } => {
                let factors = self.factors(omega)?;
                let made = factors.map(|[alpha, beta]| proportional(alpha, beta));
                made.ok_or_else(|| "it has no factors of mass and stiffness".to_owned())
            }
            Self::Modal { ratios } => modal(ratios, mass, modes),
            Self::Matrix { matrix } => {
                if matrix.nrows() != n || matrix.ncols() != n {
                    return Err(format!("a matrix of {} rows for {n} coordinates", matrix.nrows()));
                }
                // By which road it came: a matrix of its own may be made without `from_rows`.
                let rows: Vec<Vec<f64>> = (0..n)
                    .map(|row| matrix.row(row).iter().copied().collect())
                    .collect();
                Self::from_rows(&rows).map_err(|error| error.to_string())?;
                Ok(DampingMatrix::Dense(matrix.clone()))
            }
            Self::Dashpots { .. } if matches!(stiffness, StiffnessMatrix::Dense(_)) => Err(
                "dashpots stand in the storeys of a shear building; with a stiffness matrix or a plan give ratios"
                    .to_owned(),
            ),
            Self::Dashpots { coefficients } => {
                if coefficients.len() != n {
                    return Err(format!(
                        "{} dashpots for {n} storeys; give one for each",
                        coefficients.len()
                    ));
                }
                for c in coefficients {
                    not_negative("dashpot", *c)?;
                }
                Ok(DampingMatrix::Tridiagonal(SymmetricTridiagonal::chain(
                    coefficients,
                )))
            }
            Self::Isolated {
                superstructure,
                isolators,
            } => {
                let StiffnessMatrix::Tridiagonal(k) = stiffness else {
                    return Err("isolators are the first of a chain of storeys, and a stiffness matrix has no storeys".to_owned());
                };
                not_negative("the dashpot of the isolators", *isolators)?;
                superstructure.above_isolators(*isolators, mass, k)
            }
        }
    }

    /// The matrix of a building on isolators, of the damping of the storeys above its slab.
    fn above_isolators(
        &self,
        isolators: f64,
        mass: &[f64],
        chain: &SymmetricTridiagonal,
    ) -> Result<DampingMatrix, String> {
        let storeys: Vec<f64> = chain.off_diagonal.iter().map(|k| -k).collect();
        let dashpots = |above: Vec<f64>| {
            let all: Vec<f64> = std::iter::once(isolators).chain(above).collect();
            DampingMatrix::Tridiagonal(SymmetricTridiagonal::chain(&all))
        };
        let above = &mass[1..];
        if above.is_empty() {
            return Ok(dashpots(Vec::new()));
        }
        let fixed = SymmetricTridiagonal::chain(&storeys);
        let modes = undamped(above, &storeys, &fixed);
        // What acts on drifts alone stays a chain.
        match self {
            Self::Isolated { .. } => return Err("isolators are the first storey alone".to_owned()),
            Self::Dashpots { coefficients } if coefficients.len() == storeys.len() => {
                for c in coefficients {
                    not_negative("dashpot", *c)?;
                }
                return Ok(dashpots(coefficients.clone()));
            }
            Self::StiffnessProportional { ratio } => {
                check_ratio(*ratio)?;
                let beta = 2.0 * ratio / modes.circular_frequency[0];
                return Ok(dashpots(storeys.iter().map(|k| beta * k).collect()));
            }
            _ => {}
        }
        let relative = self.matrix(above, &StiffnessMatrix::Tridiagonal(fixed), &modes)?;
        let n = mass.len();
        let column = |j: usize| (0..n - 1).map(|i| relative.entry(i, j)).sum::<f64>();
        let sums: Vec<f64> = (0..n - 1).map(column).collect();
        Ok(DampingMatrix::Dense(DMatrix::from_fn(n, n, |i, j| match (
            i.checked_sub(1),
            j.checked_sub(1),
        ) {
            (None, None) => isolators + sums.iter().sum::<f64>(),
            (Some(k), None) | (None, Some(k)) => -sums[k],
            (Some(i), Some(j)) => relative.entry(i, j),
        })))
    }
}

fn modal(ratios: &[f64], mass: &[f64], modes: &Undamped) -> Result<DampingMatrix, String> {
    let n = mass.len();
    if ratios.len() != n && ratios.len() != 1 {
        return Err(format!(
            "{} modal ratios for {n} modes; give one for each, or a single one for all",
            ratios.len()
        ));
    }
    for ratio in ratios {
        check_ratio(*ratio)?;
    }
    let ratio = |j: usize| ratios[if ratios.len() == 1 { 0 } else { j }];
    if n > LARGE {
        // Half of the weight on either side, so that the matrix is exactly symmetric.
        let scaled = |p: usize, j: usize| {
            let weight = 2.0 * ratio(j) * modes.circular_frequency[j];
            weight.sqrt() * (mass[p] * modes.shape[(p, j)])
        };
        return Ok(DampingMatrix::Dense(outer_product(n, scaled)));
    }
    Ok(DampingMatrix::Dense(DMatrix::from_fn(n, n, |p, q| {
        (0..n)
            .map(|j| {
                let weight = 2.0 * ratio(j) * modes.circular_frequency[j];
                // The product of the two first, so that the matrix is exactly symmetric.
                weight * ((mass[p] * modes.shape[(p, j)]) * (mass[q] * modes.shape[(q, j)]))
            })
            .sum()
    })))
}

/// Rows side by side in [`outer_product`].
const WIDTH: usize = 8;

/// `B B'` of a square matrix, eight by eight entries at a time.
fn outer_product(n: usize, entry: impl Fn(usize, usize) -> f64) -> DMatrix<f64> {
    let blocks = n.div_ceil(WIDTH);
    let mut rows = vec![[0.0; WIDTH]; blocks * n];
    for j in 0..n {
        for p in 0..n {
            rows[p / WIDTH * n + j][p % WIDTH] = entry(p, j);
        }
    }
    let mut out = DMatrix::zeros(n, n);
    // All columns for a few rows, which stay in the cache, before the next ones.
    for first in (0..blocks).step_by(WIDTH) {
        let end = blocks.min(first + WIDTH);
        for (b, right) in rows.chunks_exact(n).enumerate().take(end) {
            for a in first.max(b)..end {
                let product = tile(&rows[a * n..(a + 1) * n], right);
                for (r, column) in product.iter().enumerate() {
                    for (l, x) in column.iter().enumerate() {
                        let (p, q) = (a * WIDTH + l, b * WIDTH + r);
                        if p < n && q < n {
                            out[(p, q)] = *x;
                            out[(q, p)] = *x;
                        }
                    }
                }
            }
        }
    }
    out
}

/// Products of eight rows with eight rows.
#[vectorised]
fn tile(left: &[[f64; WIDTH]], right: &[[f64; WIDTH]]) -> [[f64; WIDTH]; WIDTH] {
    let mut sums = [[0.0; WIDTH]; WIDTH];
    for (a, b) in left.iter().zip(right) {
        for r in 0..WIDTH {
            for l in 0..WIDTH {
                sums[r][l] += b[r] * a[l];
            }
        }
    }
    sums
}

fn check_ratio(ratio: f64) -> Result<(), String> {
    if (0.0..1.0).contains(&ratio) {
        Ok(())
    } else {
        Err(format!(
            "ratio {ratio} is not from 0 to below 1 (5 % of critical is 0.05)"
        ))
    }
}

fn not_negative(name: &str, value: f64) -> Result<(), String> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(format!("{name} = {value} must be zero or more"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// More rows than are kept together, and a number that lanes do not divide.
    #[test]
    fn products_in_blocks_have_the_bits_of_plain_sums() {
        let n = 2 * WIDTH * WIDTH + 21;
        let entry = |p: usize, j: usize| libm::sin((3 * p + 7 * j) as f64);
        let product = outer_product(n, entry);
        for p in 0..n {
            for q in 0..n {
                let sum = (0..n).fold(0.0, |sum, j| sum + entry(p, j) * entry(q, j));
                assert_eq!(product[(p, q)].to_bits(), f64::to_bits(sum), "{p}, {q}");
            }
        }
    }
}
