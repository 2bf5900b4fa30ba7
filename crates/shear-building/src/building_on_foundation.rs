//! Buildings on foundations that sway and rock on the soil.
//!
//! A foundation has the displacement `u_f` relative to the ground of the free field and the
//! rotation `theta`, positive where the building leans to the positive side. Floors at the
//! heights `H_i` above the point of rotation, which lies at the base of the first storey, move
//! by `U_i` relative to the free field. What deforms the building is
//! `v_i = U_i - u_f - H_i theta`: stiffness and damping of the building on a fixed base act on
//! that, the springs and dashpots of the soil on `u_f` and `theta`.
//!
//! In the coordinates `U_1..U_n, u_f, theta` the mass matrix is diagonal. An influence vector
//! of ones on the displacements and zero on the rotation belongs to them.

use nalgebra::{Complex, ComplexField, DMatrix, DVector};

use crate::foundation::{Foundation, FoundationError, SpringDashpot};
use crate::undamped::undamped_dense;

impl Foundation {
    /// A building on this foundation.
    ///
    /// # Errors
    /// Lists and matrices of other sizes than the floors.
    pub fn carrying(
        &self,
        building: &FixedBaseBuilding<'_>,
    ) -> Result<BuildingOnFoundation, FoundationError> {
        building.check()?;
        let floors = building.mass.len();
        let moves = [self.sway().is_some(), self.rocking().is_some()];
        let sway = moves[0].then_some(floors);
        let rotation = moves[1].then_some(floors + usize::from(moves[0]));
        let size = floors + moves.iter().filter(|moves| **moves).count();

        let mut deformation = DMatrix::zeros(floors, size);
        for i in 0..floors {
            deformation[(i, i)] = 1.0;
            if let Some(sway) = sway {
                deformation[(i, sway)] = -1.0;
            }
            if let Some(rotation) = rotation {
                deformation[(i, rotation)] = -building.elevations[i];
            }
        }
        let mut mass = DVector::zeros(size);
        let mut influence = DVector::from_element(size, 1.0);
        let mut stiffness = on_both_sides(building.stiffness, &deformation);
        let mut damping = on_both_sides(building.damping, &deformation);
        mass.rows_mut(0, floors).copy_from_slice(building.mass);
        for (at, held, inertia) in [
            (sway, self.sway(), self.mass()),
            (rotation, self.rocking(), self.rotational_inertia()),
        ] {
            if let (Some(at), Some(held)) = (at, held) {
                mass[at] = inertia;
                stiffness[(at, at)] += held.stiffness;
                damping[(at, at)] += held.dashpot;
            }
        }
        if let Some(rotation) = rotation {
            influence[rotation] = 0.0;
        }
        // Gravity acts through the whole drift, that by rocking included.
        for (i, geometric) in building.geometric.iter().enumerate() {
            let below = if i == 0 { sway } else { Some(i - 1) };
            stiffness[(i, i)] -= geometric;
            if let Some(below) = below {
                stiffness[(below, below)] -= geometric;
                stiffness[(i, below)] += geometric;
                stiffness[(below, i)] += geometric;
            }
        }
        Ok(BuildingOnFoundation {
            floors,
            sway,
            rotation,
            mass,
            stiffness,
            damping,
            influence,
            elastic: building.stiffness.clone(),
            elevations: building.elevations.to_vec(),
            held: [self.sway(), self.rocking()],
            deformation,
        })
    }
}

/// `T' A T`, exactly symmetric where `A` is.
fn on_both_sides(matrix: &DMatrix<f64>, transform: &DMatrix<f64>) -> DMatrix<f64> {
    let product = transform.transpose() * (matrix * transform);
    DMatrix::from_fn(product.nrows(), product.ncols(), |i, j| {
        0.5 * (product[(i, j)] + product[(j, i)])
    })
}

/// A building as it would be on a fixed base; one value per floor, bottom first.
#[derive(Debug, Clone, Copy)]
pub struct FixedBaseBuilding<'a> {
    /// Floor masses (kg).
    pub mass: &'a [f64],
    /// Elevations of the floors above the point of rotation of the foundation (m).
    pub elevations: &'a [f64],
    /// Stiffness matrix (N/m), without what gravity takes off.
    pub stiffness: &'a DMatrix<f64>,
    /// What gravity takes off the stiffness of each storey, weight above over height (N/m);
    /// empty where it is left out.
    pub geometric: &'a [f64],
    /// Damping matrix (N s/m).
    pub damping: &'a DMatrix<f64>,
}

impl FixedBaseBuilding<'_> {
    fn check(&self) -> Result<(), FoundationError> {
        let expected = self.mass.len();
        let all = |quantity, found| match found == expected {
            true => Ok(()),
            false => Err(FoundationError::Length {
                quantity,
                found,
                expected,
            }),
        };
        all("elevations", self.elevations.len())?;
        all("stiffness matrix", self.stiffness.nrows())?;
        all("stiffness matrix", self.stiffness.ncols())?;
        all("damping matrix", self.damping.nrows())?;
        all("damping matrix", self.damping.ncols())?;
        match self.geometric {
            [] => Ok(()),
            geometric => all("geometric stiffness", geometric.len()),
        }
    }
}

/// The matrices of a building on a foundation, in the displacements of its floors relative to
/// the free field, bottom first, then sway and rotation of the foundation, as far as it has
/// them.
#[derive(Debug, Clone, PartialEq)]
pub struct BuildingOnFoundation {
    floors: usize,
    sway: Option<usize>,
    rotation: Option<usize>,
    mass: DVector<f64>,
    stiffness: DMatrix<f64>,
    damping: DMatrix<f64>,
    influence: DVector<f64>,
    elastic: DMatrix<f64>,
    elevations: Vec<f64>,
    held: [Option<SpringDashpot>; 2],
    deformation: DMatrix<f64>,
}

/// The first mode of a building with its foundation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoupledMode {
    /// Period `2 pi / |s|` of the eigenvalue `s` (s).
    pub period: f64,
    /// Damping ratio `-Re(s) / |s|` (-).
    pub damping_ratio: f64,
}

impl BuildingOnFoundation {
    /// Number of floors; the first so many coordinates are theirs.
    #[must_use]
    pub fn floors(&self) -> usize {
        self.floors
    }

    /// Index of the coordinate of sway (m), if the foundation sways.
    #[must_use]
    pub fn sway(&self) -> Option<usize> {
        self.sway
    }

    /// Index of the coordinate of rotation (rad), if the foundation rocks.
    #[must_use]
    pub fn rotation(&self) -> Option<usize> {
        self.rotation
    }

    /// Diagonal of the mass matrix (kg, of the rotation kg m2).
    #[must_use]
    pub fn mass(&self) -> &DVector<f64> {
        &self.mass
    }

    /// Stiffness matrix (N/m; of the rotation N m, between both N).
    #[must_use]
    pub fn stiffness(&self) -> &DMatrix<f64> {
        &self.stiffness
    }

    /// Damping matrix (N s/m; of the rotation N m s, between both N s).
    #[must_use]
    pub fn damping(&self) -> &DMatrix<f64> {
        &self.damping
    }

    /// What a unit displacement of the ground moves: one for displacements, zero for the
    /// rotation.
    #[must_use]
    pub fn influence(&self) -> &DVector<f64> {
        &self.influence
    }

    /// Rows of `v_i = U_i - u_f - H_i theta` (m), what deforms the building, on the
    /// coordinates.
    #[must_use]
    pub fn deformation(&self) -> &DMatrix<f64> {
        &self.deformation
    }

    /// Rows of the storey drifts `v_i - v_(i-1)` (m), bottom first: without what sway and
    /// rotation of the foundation add.
    #[must_use]
    pub fn storey_drifts(&self) -> DMatrix<f64> {
        let v = &self.deformation;
        DMatrix::from_fn(v.nrows(), v.ncols(), |i, j| {
            v[(i, j)] - if i == 0 { 0.0 } else { v[(i - 1, j)] }
        })
    }

    /// Rows of the storey shears (N), bottom first: the elastic forces above.
    #[must_use]
    pub fn storey_shears(&self) -> DMatrix<f64> {
        let mut rows = &self.elastic * &self.deformation;
        for i in (0..self.floors.saturating_sub(1)).rev() {
            let above = rows.row(i + 1).clone_owned();
            let mut row = rows.row_mut(i);
            row += above;
        }
        rows
    }

    /// Row of the overturning moment of the elastic forces about the point of rotation (N m).
    #[must_use]
    pub fn base_moment(&self) -> Vec<f64> {
        let forces = &self.elastic * &self.deformation;
        let moment = DVector::from_row_slice(&self.elevations).transpose() * forces;
        moment.iter().copied().collect()
    }

    /// Row of the force of the sway spring (N), if the foundation sways.
    #[must_use]
    pub fn sway_force(&self) -> Option<Vec<f64>> {
        self.spring(self.sway, self.held[0])
    }

    /// Row of the moment of the rocking spring (N m), if the foundation rocks.
    #[must_use]
    pub fn rocking_moment(&self) -> Option<Vec<f64>> {
        self.spring(self.rotation, self.held[1])
    }

    fn spring(&self, at: Option<usize>, held: Option<SpringDashpot>) -> Option<Vec<f64>> {
        let mut row = vec![0.0; self.mass.len()];
        row[at?] = held?.stiffness;
        Some(row)
    }

    /// Periods without damping (s), descending; `None` where the stiffness matrix is not
    /// positive definite: gravity overturns the building on its foundation.
    #[must_use]
    pub fn undamped_periods(&self) -> Option<Vec<f64>> {
        self.stiffness.clone().cholesky()?;
        let undamped = undamped_dense(self.mass.as_slice(), &self.stiffness, self.floors);
        let periods = undamped.circular_frequency.iter();
        Some(periods.map(|w| std::f64::consts::TAU / w).collect())
    }

    /// The first mode with the damping of building and soil: a complex eigenvalue `s` and its
    /// shape, `(s^2 M + s C + K) phi = 0`, reached from the first mode without damping by
    /// putting the damping on step by step, so that another mode, which the soil damps
    /// strongly, is not taken for it. `None` where that mode does not oscillate.
    #[must_use]
    pub fn first_mode(&self) -> Option<CoupledMode> {
        let undamped = undamped_dense(self.mass.as_slice(), &self.stiffness, self.floors);
        let frequency = undamped.circular_frequency.first().copied()?;
        if !(frequency.is_finite() && frequency > 0.0) {
            return None;
        }
        let shape = undamped.shape.column(0);
        let mut shape = shape.map(|x| Complex::new(x, 0.0));
        let mut s = Complex::new(0.0, frequency);
        for step in 1..=STEPS_OF_DAMPING {
            let part = f64::from(step) / f64::from(STEPS_OF_DAMPING);
            (s, shape) = self.follow(s, shape, part)?;
        }
        // That of `Complex` itself may be of the C library.
        let size = s.modulus();
        let oscillates = s.im > ROUND_OFF * size;
        oscillates.then(|| CoupledMode {
            period: std::f64::consts::TAU / size,
            damping_ratio: -s.re / size,
        })
    }

    /// The eigenvalue next to one, with a part of the damping, by inverse iteration with the
    /// quotient that is stationary at eigenvectors of symmetric matrices.
    fn follow(
        &self,
        mut s: Complex<f64>,
        mut shape: DVector<Complex<f64>>,
        part: f64,
    ) -> Option<(Complex<f64>, DVector<Complex<f64>>)> {
        let complex = |x: f64| Complex::new(x, 0.0);
        let mass = self.mass.map(complex);
        let stiffness = self.stiffness.map(complex);
        let damping = self.damping.map(|c| complex(part * c));
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let mut pencil = &stiffness + &damping * s;
            for i in 0..mass.len() {
                pencil[(i, i)] += s * s * mass[i];
            }
            let slope = mass.component_mul(&shape) * (s * 2.0) + &damping * &shape;
            // At an eigenvalue itself the matrix is singular, and there is no more to do.
            let Some(next) = pencil.lu().solve(&slope) else {
                return Some((s, shape));
            };
            let length = next.norm();
            if !length.is_finite() {
                return Some((s, shape));
            }
            shape = next / complex(length);
            let a = shape.dot(&mass.component_mul(&shape));
            let b = shape.dot(&(&damping * &shape));
            let c = shape.dot(&(&stiffness * &shape));
            let root = ComplexField::sqrt(b * b - a * c * 4.0);
            let roots = [(-b + root) / (a * 2.0), (-b - root) / (a * 2.0)];
            let near = |x: &Complex<f64>| (x - s).modulus();
            let [one, other] = roots;
            let found = if near(&one) <= near(&other) {
                one
            } else {
                other
            };
            let change = (found - s).modulus();
            s = found;
            // What no longer falls is the round-off of stiffnesses that are far apart.
            let is_stale = change >= last && change <= MOST_STALE * s.modulus();
            if change <= ROUND_OFF * s.modulus() || is_stale {
                return Some((s, shape));
            }
            last = change;
        }
        None
    }
}

/// Steps in which the damping is put on.
const STEPS_OF_DAMPING: u32 = 10;

/// Iterations at most; a handful is usual.
const MOST_ITERATIONS: usize = 50;

/// Relative change of an eigenvalue that is round-off.
const ROUND_OFF: f64 = 1.0e-12;

/// Relative change up to which an eigenvalue whose change no longer falls is taken for found.
const MOST_STALE: f64 = 1.0e-6;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::foundation::Soil;
    use crate::foundation::tests::{BESIDE, near, soil};

    /// A chain of storeys as a full matrix.
    fn chain(storeys: &[f64]) -> DMatrix<f64> {
        let n = storeys.len();
        DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => storeys[i] + storeys.get(i + 1).copied().unwrap_or(0.0),
            1 => -storeys[i.max(j)],
            _ => 0.0,
        })
    }

    /// Light and heavy building of a pair; masses, storey stiffnesses, mass and inertia of the
    /// foundation, length, factors of the Rayleigh damping.
    struct Known {
        mass: f64,
        storeys: [f64; 3],
        foundation: [f64; 2],
        length: f64,
        rayleigh: [f64; 2],
        periods: [f64; 5],
    }

    const PAIR: [Known; 2] = [
        Known {
            mass: 100000.0,
            storeys: [6.0e7, 5.5e7, 5.0e7],
            foundation: [150000.0, 5400000.0],
            length: 12.0,
            rayleigh: [0.7765509156958651, 0.0025304963677573794],
            periods: [
                0.6028226206123655,
                0.21880939067149968,
                0.1504964449453448,
                0.05512911351635948,
                0.05279132258046425,
            ],
        },
        Known {
            mass: 180000.0,
            storeys: [3.5e8, 3.2e8, 3.0e8],
            foundation: [250000.0, 14812500.0],
            length: 15.0,
            rayleigh: [1.4023456102320835, 0.001396795054403878],
            periods: [
                0.3546581304983563,
                0.12478179605076892,
                0.08479879676295299,
                0.06693827515539931,
                0.06123101090139549,
            ],
        },
    ];

    const HEIGHTS: [f64; 3] = [3.2, 6.4, 9.6];

    impl Known {
        fn on_soil(&self) -> BuildingOnFoundation {
            let soil = Soil {
                length: self.length,
                ..soil()
            };
            let [mass, inertia] = self.foundation;
            let foundation = Foundation::on_soil(mass, inertia, &soil).unwrap();
            let stiffness = chain(&self.storeys);
            let [alpha, beta] = self.rayleigh;
            let inertia = DMatrix::from_diagonal_element(3, 3, alpha * self.mass);
            let building = FixedBaseBuilding {
                mass: &[self.mass; 3],
                elevations: &HEIGHTS,
                stiffness: &stiffness,
                geometric: &[],
                damping: &(inertia + &stiffness * beta),
            };
            foundation.carrying(&building).unwrap()
        }
    }

    /// Sway, rotation and displacements of the floors relative to the rigid line, in which
    /// others write the same building: floors move by `U_i = u_f + H_i theta + v_i`.
    fn in_relative_coordinates() -> DMatrix<f64> {
        let mut to_total = DMatrix::zeros(5, 5);
        for i in 0..3 {
            to_total[(i, 0)] = 1.0;
            to_total[(i, 1)] = HEIGHTS[i];
            to_total[(i, 2 + i)] = 1.0;
        }
        to_total[(3, 0)] = 1.0;
        to_total[(4, 1)] = 1.0;
        to_total
    }

    /// In relative coordinates the masses are coupled, stiffness and damping fall apart. Numbers of the damping from a
    /// script apart from this code.
    #[test]
    fn the_matrices_are_those_of_relative_coordinates() {
        let known = &PAIR[0];
        let founded = known.on_soil();
        let to_total = in_relative_coordinates();
        let relative = |m: &DMatrix<f64>| to_total.transpose() * m * &to_total;
        let mass = relative(&DMatrix::from_diagonal(founded.mass()));
        let stiffness = relative(founded.stiffness());
        let damping = relative(founded.damping());
        let m = known.mass;
        let expected = [
            [450000.0, 1920000.0, m, m, m],
            [1920000.0, 19736000.0, 3.2 * m, 6.4 * m, 9.6 * m],
            [m, 3.2 * m, m, 0.0, 0.0],
            [m, 6.4 * m, 0.0, m, 0.0],
            [m, 9.6 * m, 0.0, 0.0, m],
        ];
        let expected = DMatrix::from_fn(5, 5, |i, j| expected[i][j]);
        assert!((mass - &expected).amax() < 1e-14 * expected.amax());
        let (k_x, k_t) = (1891460781.5571823, 74567887107.42413);
        let expected = [
            [k_x, 0.0, 0.0, 0.0, 0.0],
            [0.0, k_t, 0.0, 0.0, 0.0],
            [0.0, 0.0, 115000000.0, -55000000.0, 0.0],
            [0.0, 0.0, -55000000.0, 105000000.0, -50000000.0],
            [0.0, 0.0, 0.0, -50000000.0, 50000000.0],
        ];
        let expected = DMatrix::from_fn(5, 5, |i, j| expected[i][j]);
        assert!((stiffness - &expected).amax() < 1e-14 * expected.amax());
        let expected = [
            [46656000.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, 1111480093.6993349, 0.0, 0.0, 0.0],
            [0.0, 0.0, 368662.1738616851, -139177.30022665588, 0.0],
            [
                0.0,
                0.0,
                -139177.30022665588,
                343357.2101841114,
                -126524.81838786897,
            ],
            [0.0, 0.0, 0.0, -126524.81838786897, 204179.90995745547],
        ];
        let expected = DMatrix::from_fn(5, 5, |i, j| expected[i][j]);
        // Entries of the storeys are a ten thousandth of the largest.
        assert!((damping - &expected).amax() < 1e-15 * expected.amax());
        let influence = to_total.try_inverse().unwrap() * founded.influence();
        let expected = DVector::from_column_slice(&[1.0, 0.0, 0.0, 0.0, 0.0]);
        assert!((influence - expected).amax() < 1e-14);
    }

    #[test]
    fn periods_are_those_of_a_generalised_eigenproblem() {
        for known in &PAIR {
            let found = known.on_soil().undamped_periods().unwrap();
            for (found, expected) in found.iter().zip(known.periods) {
                near(*found, expected, 1e-12);
            }
        }
    }

    /// Against the eigenvalues of the whole state matrix.
    #[test]
    fn the_first_mode_is_an_eigenvalue_of_the_state_matrix() {
        for known in &PAIR {
            let founded = known.on_soil();
            let n = founded.mass().len();
            let per_mass = |m: &DMatrix<f64>, i: usize, j: usize| m[(i, j)] / founded.mass()[i];
            let state = DMatrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
                (true, _) => f64::from(u8::from(j == i + n)),
                (false, true) => -per_mass(founded.stiffness(), i - n, j),
                (false, false) => -per_mass(founded.damping(), i - n, j - n),
            });
            let values = state.complex_eigenvalues();
            let first = founded.first_mode().unwrap();
            let distance = |s: &Complex<f64>| {
                let period = std::f64::consts::TAU / s.modulus() / first.period - 1.0;
                libm::hypot(period, -s.re / s.modulus() - first.damping_ratio)
            };
            let nearest = values.iter().map(distance).fold(1.0, f64::min);
            assert!(nearest < 1e-10, "{nearest:e}");
            let slowest = values.iter().filter(|s| s.im > 0.0).map(|s| s.modulus());
            let slowest = slowest.fold(f64::INFINITY, f64::min);
            near(first.period, std::f64::consts::TAU / slowest, 1e-9);
        }
    }

    /// One storey on a foundation almost without mass: `T~/T = sqrt(1 + k/k_x + k h^2/k_t)`
    /// (Veletsos and Meek, Earthquake Engineering and Structural Dynamics 3 (1974) 121).
    #[test]
    fn soft_soil_lengthens_the_period() {
        let (mass, k, h, k_x, k_t) = (2.0e5_f64, 8.0e7, 6.0, 3.0e8, 9.0e9);
        let held = |stiffness| {
            Some(SpringDashpot {
                stiffness,
                dashpot: 0.0,
            })
        };
        let foundation = Foundation::new(1e-3, 1e-3, held(k_x), held(k_t)).unwrap();
        let zeta = 0.05;
        let c = 2.0 * zeta * (k * mass).sqrt();
        let founded = foundation
            .carrying(&FixedBaseBuilding {
                mass: &[mass],
                elevations: &[h],
                stiffness: &DMatrix::from_element(1, 1, k),
                geometric: &[],
                damping: &DMatrix::from_element(1, 1, c),
            })
            .unwrap();
        let lengthening = (1.0 + k / k_x + k * h * h / k_t).sqrt();
        let fixed = std::f64::consts::TAU * (mass / k).sqrt();
        let undamped = founded.undamped_periods().unwrap();
        near(undamped[0] / fixed, lengthening, 1e-8);
        // The damping of the building counts by the cube, for small ratios.
        let mode = founded.first_mode().unwrap();
        near(mode.damping_ratio, zeta / lengthening.powi(3), 5e-3);
        near(mode.period / fixed, lengthening, 5e-3);
    }

    /// With a rigid building that rocks alone: `2 pi sqrt((I_0 + sum m H^2) / k_t)`.
    #[test]
    fn a_rigid_building_that_rocks_is_a_pendulum() {
        let mass = [3.0e4, 2.0e4];
        let (inertia, k_t) = (4.0e5, 6.0e8);
        let rocking = SpringDashpot {
            stiffness: k_t,
            dashpot: 2.0e6,
        };
        let foundation = Foundation::new(0.0, inertia, None, Some(rocking)).unwrap();
        let stiffness = chain(&[1.0e14, 1.0e14]);
        let founded = foundation
            .carrying(&FixedBaseBuilding {
                mass: &mass,
                elevations: &[3.0, 7.0],
                stiffness: &stiffness,
                geometric: &[],
                damping: &DMatrix::zeros(2, 2),
            })
            .unwrap();
        assert_eq!((founded.sway(), founded.rotation()), (None, Some(2)));
        let all = inertia + 3.0e4 * 9.0 + 2.0e4 * 49.0;
        let period = std::f64::consts::TAU * (all / k_t).sqrt();
        near(founded.undamped_periods().unwrap()[0], period, 1e-6);
        let mode = founded.first_mode().unwrap();
        near(mode.period, period, 1e-6);
        near(mode.damping_ratio, 2.0e6 / (2.0 * (k_t * all).sqrt()), 1e-6);
    }

    /// Springs a million times as stiff as the building leave its periods.
    #[test]
    fn a_stiff_soil_is_a_fixed_base() {
        let stiffness = chain(&[6.0e7, 5.0e7]);
        let held = |stiffness| {
            Some(SpringDashpot {
                stiffness,
                dashpot: 0.0,
            })
        };
        let mass = [1.0e5, 1.0e5];
        let foundation = Foundation::new(1.0e5, 1.0e6, held(6.0e14), held(6.0e16)).unwrap();
        let founded = foundation
            .carrying(&FixedBaseBuilding {
                mass: &mass,
                elevations: &[3.0, 6.0],
                stiffness: &stiffness,
                geometric: &[],
                damping: &(&stiffness * 0.002),
            })
            .unwrap();
        let fixed = undamped_dense(&mass, &stiffness, mass.len()).circular_frequency;
        let found = founded.undamped_periods().unwrap();
        for j in 0..2 {
            near(found[j], std::f64::consts::TAU / fixed[j], 1e-6);
        }
        let mode = founded.first_mode().unwrap();
        near(mode.damping_ratio, 0.001 * fixed[0], 1e-6);
    }

    /// Rows against the forces that they stand for, at some displacement.
    #[test]
    fn rows_give_the_forces_of_storeys_and_soil() {
        let founded = PAIR[0].on_soil();
        let q = DVector::from_column_slice(&[0.011, 0.025, 0.037, 0.002, 0.001]);
        let v: Vec<f64> = (0..3).map(|i| q[i] - 0.002 - HEIGHTS[i] * 0.001).collect();
        let drifts = [v[0], v[1] - v[0], v[2] - v[1]];
        let found = founded.storey_drifts() * &q;
        let shears = founded.storey_shears() * &q;
        let mut forces = [0.0; 3];
        for i in 0..3 {
            near(found[i], drifts[i], 1e-12);
            let shear = PAIR[0].storeys[i] * drifts[i];
            near(shears[i], shear, 1e-11);
            forces[i] += shear;
            if i > 0 {
                forces[i - 1] -= shear;
            }
        }
        let dot = |row: &[f64]| row.iter().zip(q.iter()).map(|(a, b)| a * b).sum::<f64>();
        let moment: f64 = forces.iter().zip(HEIGHTS).map(|(f, h)| f * h).sum();
        near(dot(&founded.base_moment()), moment, 1e-11);
        let force = dot(&founded.sway_force().unwrap());
        near(force, 0.002 * 1891460781.5571823, 1e-14);
        let moment = dot(&founded.rocking_moment().unwrap());
        near(moment, 0.001 * 74567887107.42413, 1e-14);
        // Under a rigid motion the building itself carries nothing.
        let rigid = DVector::from_column_slice(&[3.2, 6.4, 9.6, 0.0, 1.0]);
        assert!((founded.storey_drifts() * rigid).amax() < 1e-14);
    }

    /// The energy of gravity is `-sum P_i (U_i - U_(i-1))^2 / (2 h_i)`, with the foundation
    /// as the floor below the first.
    #[test]
    fn gravity_acts_through_the_whole_drift() {
        let stiffness = chain(&[6.0e7, 5.0e7]);
        let geometric = [6.0e5, 3.0e5];
        let foundation = Foundation::new(1.0e5, 1.0e6, Some(BESIDE), Some(BESIDE)).unwrap();
        let matrix = |geometric: &[f64]| {
            let building = FixedBaseBuilding {
                mass: &[1.0e5, 1.0e5],
                elevations: &[3.0, 6.0],
                stiffness: &stiffness,
                geometric,
                damping: &DMatrix::zeros(2, 2),
            };
            foundation.carrying(&building).unwrap().stiffness().clone()
        };
        let off = matrix(&[]) - matrix(&geometric);
        let q = DVector::from_column_slice(&[0.02, 0.05, 0.01, 0.001]);
        let energy = 6.0e5 * 0.01_f64.powi(2) + 3.0e5 * 0.03_f64.powi(2);
        // Round-off is that of the matrices.
        near(q.dot(&(off * &q)), energy, 1e-6);
        // Ten times the stiffness of the first storey overturns it.
        let heavy = FixedBaseBuilding {
            mass: &[1.0e5, 1.0e5],
            elevations: &[3.0, 6.0],
            stiffness: &stiffness,
            geometric: &[6.0e8, 3.0e5],
            damping: &DMatrix::zeros(2, 2),
        };
        let founded = foundation.carrying(&heavy).unwrap();
        assert_eq!(founded.undamped_periods(), None);
        assert_eq!(founded.first_mode(), None);
    }

    #[test]
    fn unequal_sizes_are_refused() {
        let foundation = Foundation::new(1.0, 1.0, Some(BESIDE), None).unwrap();
        let building = FixedBaseBuilding {
            mass: &[1.0, 1.0],
            elevations: &[3.0],
            stiffness: &DMatrix::identity(2, 2),
            geometric: &[],
            damping: &DMatrix::identity(2, 2),
        };
        let error = foundation.carrying(&building).unwrap_err().to_string();
        assert!(
            error.contains("elevations has 1 values for 2 floors"),
            "{error}"
        );
    }
}
