//! Columns that the floor of a neighbour hits between the floors of their building.
//!
//! The column lines that are hit stand together for one column of flexural rigidity `EI` and
//! height `h`, hit at the distance `a` above its lower end, `b = h - a`. Its rotation at that
//! point is condensed out. In the displacements `u_l` of the floor below, `u_c` of the point
//! and `u_u` of the floor above its stiffness is
//!
//! `k_s [1 0 -1; 0 0 0; -1 0 1] + k_c t t'` with `t = (-N_l, 1, -N_u)`, `N_l + N_u = 1`.
//!
//! The first part is in the stiffness of the storey already: a building with such a point has
//! `k_c t t'` more. `N_l u_l + N_u u_u` is where the point stands while nothing pushes it,
//! `1/k_c` what it gives way by under a unit force.
//!
//! With `xi = a/h`, `eta = b/h`, and `Phi = 12 EI / (kappa G A h^2)` for the deformation in
//! shear, which is zero where this is left out:
//!
//! - both ends fixed: `k_s = 12 EI / (h^3 (1 + Phi))`,
//!   `N_u = (3 xi^2 - 2 xi^3 + Phi xi) / (1 + Phi)`,
//!   `1/k_c = h^3 p (4 p^2 + Phi p + Phi (1 + Phi)) / (12 EI (1 + Phi))`, `p = xi eta`;
//! - pinned above: `k_s = 3 EI / (h^3 (1 + Psi))`,
//!   `N_u = (xi^2 (3 - xi) + 2 Psi xi) / (2 (1 + Psi))`,
//!   `1/k_c = h^3 p (xi p (4 - xi) + 4 Psi (1 + p + Psi)) / (12 EI (1 + Psi))`, `Psi = Phi / 4`.
//!
//! Several points of one column act on one another: with the matrix `F` of their displacements
//! under unit forces while the floors stand, `k_c t t'` becomes `T' F^-1 T`, `T` a row `t` a
//! point ([`HitLine`]).
//!
//! Derived from the equilibrium of a Timoshenko beam, and held in the tests against the
//! condensation of two beam elements. Floors are taken not to rotate, as in any shear
//! building, and the column stays elastic.

use nalgebra::{DMatrix, Matrix2, Vector2};

/// How the ends of a column are held by its floors, which do not rotate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnEnds {
    /// Neither end rotates.
    Fixed,
    /// The lower end does not rotate, the upper one is a hinge.
    Pinned,
}

/// A column, or several in one line, hit between floors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HitColumn {
    rigidity: f64,
    /// `Phi` of fixed ends, `Psi` of a hinge above.
    shear: f64,
    ends: ColumnEnds,
    height: f64,
    /// `a / h` and `b / h`.
    parts: [f64; 2],
}

/// A column that cannot be hit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ColumnError {
    /// A value that is not above zero.
    #[error("{quantity} = {value} must be greater than zero")]
    Value {
        /// Quantity.
        quantity: &'static str,
        /// Value (SI).
        value: f64,
    },
    /// A point beside the floor, or beyond it.
    #[error(
        "the column is hit {distance} m above the floor below in a storey of {height} m: within {} % of the height of a floor its stiffness is beyond all measure, and the floors hit each other",
        100.0 * NEAR_FLOOR
    )]
    NearFloor {
        /// Height of the point above the lower floor (m).
        distance: f64,
        /// Storey height (m).
        height: f64,
    },
}

/// Part of the storey height within which a hit beside a floor is one of the floor.
pub const NEAR_FLOOR: f64 = 0.05;

/// Rows of the forces in a hit column on the displacements of the floor below, of the point
/// and of the floor above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColumnForceRows {
    /// Shear below the point (N).
    pub shear_below: [f64; 3],
    /// Shear above the point (N).
    pub shear_above: [f64; 3],
    /// Moment at the lower end (N m).
    pub moment_bottom: [f64; 3],
    /// Moment at the upper end (N m).
    pub moment_top: [f64; 3],
}

/// Forces in a hit column, or what they gain from a unit drift, or from a unit force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColumnForces {
    /// Shear below the point (N).
    pub shear_below: f64,
    /// Shear above the point (N).
    pub shear_above: f64,
    /// Moment at the lower end (N m).
    pub moment_bottom: f64,
    /// Moment at the upper end (N m).
    pub moment_top: f64,
}

impl HitColumn {
    /// A column of the flexural rigidity `EI` (N m2) and the shear rigidity `kappa G A` (N,
    /// `None`: rigid in shear) in a storey of a height (m), hit at a distance above its lower
    /// floor (m).
    ///
    /// # Errors
    /// A rigidity or a height that is not above zero, and a point within 5 % of the height of
    /// a floor, or beyond it.
    pub fn new(
        flexural_rigidity: f64,
        shear_rigidity: Option<f64>,
        ends: ColumnEnds,
        height: f64,
        distance: f64,
    ) -> Result<Self, ColumnError> {
        let sheared = shear_rigidity.map(|rigidity| ("shear rigidity", rigidity));
        let bent = [
            ("flexural rigidity", flexural_rigidity),
            ("storey height", height),
        ];
        for (quantity, value) in bent.into_iter().chain(sheared) {
            if !(value.is_finite() && value > 0.0) {
                return Err(ColumnError::Value { quantity, value });
            }
        }
        let parts = [distance / height, (height - distance) / height];
        if !parts.iter().all(|part| *part >= NEAR_FLOOR) {
            return Err(ColumnError::NearFloor { distance, height });
        }
        let factor = match ends {
            ColumnEnds::Fixed => 12.0,
            ColumnEnds::Pinned => 3.0,
        };
        let shear = shear_rigidity.map_or(0.0, |rigidity| {
            factor * flexural_rigidity / (rigidity * height * height)
        });
        Ok(Self {
            rigidity: flexural_rigidity,
            shear,
            ends,
            height,
            parts,
        })
    }

    /// `k_s` (N/m): what the column is of the storey stiffness.
    #[must_use]
    pub fn storey_stiffness(&self) -> f64 {
        let factor = match self.ends {
            ColumnEnds::Fixed => 12.0,
            ColumnEnds::Pinned => 3.0,
        };
        factor * self.rigidity / (self.height.powi(3) * (1.0 + self.shear))
    }

    /// `k_c` (N/m): force at the point that displaces it by a unit while the floors stand.
    #[must_use]
    pub fn point_stiffness(&self) -> f64 {
        let [xi, eta] = self.parts;
        let (p, s) = (xi * eta, self.shear);
        let flexibility = match self.ends {
            ColumnEnds::Fixed => 4.0 * p * p + s * p + s * (1.0 + s),
            ColumnEnds::Pinned => xi * p * (4.0 - xi) + 4.0 * s * (1.0 + p + s),
        };
        12.0 * self.rigidity * (1.0 + s) / (self.height.powi(3) * p * flexibility)
    }

    /// `[N_l, N_u]`: parts of the displacements of the floors below and above with which the
    /// point moves while nothing pushes it. A force at the point acts on the floors by the
    /// same parts.
    #[must_use]
    pub fn shares(&self) -> [f64; 2] {
        let ([xi, eta], s) = (self.parts, self.shear);
        match self.ends {
            ColumnEnds::Fixed => [eta, xi].map(|x| x * (x * (3.0 - 2.0 * x) + s) / (1.0 + s)),
            ColumnEnds::Pinned => [
                eta * (3.0 - eta * eta + 2.0 * s) / (2.0 * (1.0 + s)),
                xi * (xi * (3.0 - xi) + 2.0 * s) / (2.0 * (1.0 + s)),
            ],
        }
    }

    /// Forces at a drift `u_u - u_l` (m) under the force `P` (N) that the column carries at
    /// the point, positive as displacements are. Shears have the sign of the drift that they
    /// resist.
    #[must_use]
    pub fn forces(&self, drift: f64, force: f64) -> ColumnForces {
        let [lower, upper] = self.shares();
        let [xi, eta] = self.parts;
        let (h, sway) = (self.height, self.storey_stiffness() * drift);
        let (moment_bottom, moment_top) = match self.ends {
            ColumnEnds::Fixed => (
                0.5 * h * (sway + force * (lower - eta * eta)),
                0.5 * h * (sway - force * (upper - xi * xi)),
            ),
            ColumnEnds::Pinned => (h * (sway + force * (lower - eta)), 0.0),
        };
        ColumnForces {
            shear_below: sway + lower * force,
            shear_above: sway - upper * force,
            moment_bottom,
            moment_top,
        }
    }

    /// `t = (-N_l, 1, -N_u)`: how far the point is pushed off the line of its column, as a row
    /// on the displacements of the floor below, of the point and of the floor above. The
    /// building has `k_c t t'` more stiffness for it.
    #[must_use]
    pub fn bow(&self) -> [f64; 3] {
        let [lower, upper] = self.shares();
        [-lower, 1.0, -upper]
    }

    /// Rows of the forces on the displacements of the floor below, of the point and of the
    /// floor above.
    #[must_use]
    pub fn force_rows(&self) -> ColumnForceRows {
        let of_drift = self.forces(1.0, 0.0);
        let of_force = self.forces(0.0, 1.0);
        let stiffness = self.point_stiffness();
        let bow = self.bow();
        let row = |pick: fn(&ColumnForces) -> f64| {
            let drift = [-1.0, 0.0, 1.0];
            let entry =
                |i: usize| pick(&of_drift) * drift[i] + pick(&of_force) * stiffness * bow[i];
            [entry(0), entry(1), entry(2)]
        };
        ColumnForceRows {
            shear_below: row(|f| f.shear_below),
            shear_above: row(|f| f.shear_above),
            moment_bottom: row(|f| f.moment_bottom),
            moment_top: row(|f| f.moment_top),
        }
    }
}

impl HitColumn {
    /// What a unit force at this point displaces another one of the same column by (m/N) while
    /// the floors stand: that of a cantilever less what its upper end is held by.
    fn flexibility_with(&self, other: &Self) -> f64 {
        // In units of the height and of EI.
        let shear = match self.ends {
            ColumnEnds::Fixed => self.shear / 12.0,
            ColumnEnds::Pinned => self.shear / 3.0,
        };
        let cantilever = |x: f64, y: f64| {
            let (low, high) = (x.min(y), x.max(y));
            low * low * (3.0 * high - low) / 6.0 + shear * low
        };
        let [x, y] = [self.parts[0], other.parts[0]];
        let held = match self.ends {
            ColumnEnds::Fixed => {
                // Displacement and rotation of the upper end.
                let [a, b] = [x, y].map(|x| Vector2::new(cantilever(1.0, x), 0.5 * x * x));
                let end = cantilever(1.0, 1.0);
                let scale = end - 0.25;
                let inverse = Matrix2::new(1.0, -0.5, -0.5, end) / scale;
                a.dot(&(inverse * b))
            }
            ColumnEnds::Pinned => cantilever(1.0, x) * cantilever(1.0, y) / cantilever(1.0, 1.0),
        };
        (cantilever(x, y) - held) * self.height.powi(3) / self.rigidity
    }
}

/// One or more points of one column, or of one line of columns, in a storey.
#[derive(Debug, Clone, PartialEq)]
pub struct HitLine {
    points: Vec<HitColumn>,
    stiffness: DMatrix<f64>,
}

/// A force or a displacement of a hit column as a sum over the displacements of the floor
/// below, of the floor above and of the points.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnResponse {
    /// Name in results.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// Factor of the displacement of the floor below.
    pub lower: f64,
    /// Factor of the displacement of the floor above.
    pub upper: f64,
    /// Factors of the displacements of the points.
    pub points: Vec<f64>,
}

/// Forces of a column that stands for itself, and how far it bows out, as sums over the drift
/// of its storey and the force at its one point, both positive as displacements are.
#[derive(Debug, Clone, PartialEq)]
pub struct ForcedColumnResponse {
    /// Name in results.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// Factor of the drift.
    pub by_drift: f64,
    /// Factor of the force.
    pub by_force: f64,
}

/// Names in results with their units; the shears first.
const RESPONSES: [(&str, &str); 5] = [
    ("column_shear_below", "N"),
    ("column_shear_above", "N"),
    ("column_moment_bottom", "N m"),
    ("column_moment_top", "N m"),
    ("column_bow", "m"),
];

impl HitColumn {
    /// Forces in the column, and its bow, under the drift of the storey and a force at a point
    /// without mass.
    #[must_use]
    pub fn responses(&self) -> Vec<ForcedColumnResponse> {
        let [drift, force] = [self.forces(1.0, 0.0), self.forces(0.0, 1.0)].map(|f| f.values());
        let rows = (0..RESPONSES.len()).filter(|i| self.has(*i));
        rows.map(|i| ForcedColumnResponse {
            name: RESPONSES[i].0,
            unit: RESPONSES[i].1,
            by_drift: drift.get(i).copied().unwrap_or(0.0),
            by_force: match force.get(i) {
                Some(force) => *force,
                None => 1.0 / self.point_stiffness(),
            },
        })
        .collect()
    }

    /// Whether it has the response of this number: a hinge bears no moment.
    fn has(&self, response: usize) -> bool {
        self.ends == ColumnEnds::Fixed || RESPONSES[response].0 != "column_moment_top"
    }
}

impl ColumnForces {
    fn values(self) -> [f64; 4] {
        [
            self.shear_below,
            self.shear_above,
            self.moment_bottom,
            self.moment_top,
        ]
    }
}

impl HitLine {
    /// Points of one column, from the bottom; `None` where two of them are one.
    #[must_use]
    pub fn new(points: Vec<HitColumn>) -> Option<Self> {
        let n = points.len();
        let flexibility = DMatrix::from_fn(n, n, |i, j| match i == j {
            true => 1.0 / points[i].point_stiffness(),
            false => points[i.min(j)].flexibility_with(&points[i.max(j)]),
        });
        let stiffness = match points.as_slice() {
            [one] => DMatrix::from_element(1, 1, one.point_stiffness()),
            _ => {
                let inverse = flexibility.cholesky()?.inverse();
                // Exactly symmetric.
                DMatrix::from_fn(n, n, |i, j| 0.5 * (inverse[(i, j)] + inverse[(j, i)]))
            }
        };
        Some(Self { points, stiffness })
    }

    /// The points, from the bottom.
    #[must_use]
    pub fn points(&self) -> &[HitColumn] {
        &self.points
    }

    /// Forces at the points that displace them by a unit each while all else stands (N/m).
    #[must_use]
    pub fn stiffness(&self) -> &DMatrix<f64> {
        &self.stiffness
    }

    /// `T' X T` for a matrix `X` of the points: a row and a column for the floor below, for
    /// the floor above and for each point.
    pub(crate) fn on_floors(&self, x: &DMatrix<f64>) -> DMatrix<f64> {
        let bows = self.bows();
        bows.transpose() * x * bows
    }

    /// `T`: how far each point is pushed off the line of its column.
    fn bows(&self) -> DMatrix<f64> {
        let n = self.points.len();
        DMatrix::from_fn(n, n + 2, |i, j| match j {
            0 | 1 => -self.points[i].shares()[j],
            _ => f64::from(u8::from(j == i + 2)),
        })
    }

    /// Forces in the column at the point of this number, from below, and its bow there.
    #[must_use]
    pub fn responses(&self, point: usize) -> Vec<ColumnResponse> {
        let n = self.points.len();
        let (bows, own) = (self.bows(), &self.points[point]);
        // Forces that the column carries at the points.
        let carried = &self.stiffness * &bows;
        let of_drift = own.forces(1.0, 0.0).values();
        let rows = (0..RESPONSES.len()).filter(|i| own.has(*i));
        let entries = |response: usize| -> Vec<f64> {
            let drift = of_drift.get(response).copied();
            let entry = |j: usize| {
                let Some(drift) = drift else {
                    return bows[(point, j)];
                };
                let sway = drift * [-1.0, 1.0].get(j).copied().unwrap_or(0.0);
                let forces = (0..n).map(|i| {
                    let one = self.points[i].forces(0.0, 1.0);
                    // The section of a shear lies above some points and below others.
                    let factor = match response {
                        0 if i < point => one.shear_above,
                        1 if i > point => one.shear_below,
                        _ => one.values()[response],
                    };
                    factor * carried[(i, j)]
                });
                sway + forces.sum::<f64>()
            };
            (0..n + 2).map(entry).collect()
        };
        rows.map(|i| {
            let row = entries(i);
            ColumnResponse {
                name: RESPONSES[i].0,
                unit: RESPONSES[i].1,
                lower: row[0],
                upper: row[1],
                points: row[2..].to_vec(),
            }
        })
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, expected: f64, tolerance: f64) {
        let error = (found - expected).abs();
        assert!(
            error <= tolerance * expected.abs(),
            "{found} for {expected}: {error:e}"
        );
    }

    /// A column of 256 MN m2 in storeys of 3 m, hit at 1.4 m and at 2 m: numbers of a script
    /// apart from this code.
    #[test]
    fn a_column_that_is_rigid_in_shear_has_known_numbers() {
        let column = |a| HitColumn::new(2.56e8, None, ColumnEnds::Fixed, 3.0, a).unwrap();
        let first = column(1.4);
        near(first.point_stiffness(), 1844934402.3323612, 1e-14);
        near(first.shares()[0], 0.5499259259259257, 1e-14);
        near(first.shares()[1], 0.4500740740740743, 1e-14);
        let second = column(2.0);
        near(second.point_stiffness(), 2592000000.0, 1e-14);
        near(second.shares()[0], 0.25925925925925924, 1e-14);
        for (found, expected) in [
            (
                first.force_rows().shear_below,
                [-671720116.6180753, 1014577259.475218, -342857142.8571428],
            ),
            (
                first.force_rows().shear_above,
                [342857142.8571428, -830357142.8571432, 487500000.00000036],
            ),
            (
                first.force_rows().moment_bottom,
                [-574693877.5510201, 734693877.5510203, -160000000.0000001],
            ),
            (
                first.force_rows().moment_top,
                [182857142.85714278, -642857142.8571429, 460000000.0000001],
            ),
            (
                second.force_rows().shear_below,
                [-288000000.0, 672000000.0, -383999999.99999994],
            ),
            (
                second.force_rows().shear_above,
                [383999999.99999994, -1920000000.0, 1536000000.0],
            ),
            (
                second.force_rows().moment_bottom,
                [-320000000.0, 576000000.0, -255999999.99999997],
            ),
            (
                second.force_rows().moment_top,
                [127999999.99999997, -1152000000.0, 1023999999.9999999],
            ),
        ] {
            let expected: [f64; 3] = expected;
            let largest = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            for (found, expected) in found.iter().zip(expected) {
                assert!(
                    (found - expected).abs() < 1e-13 * largest,
                    "{found} {expected}"
                );
            }
        }
        // 192 EI / h^3 at mid-height.
        near(column(1.5).point_stiffness(), 192.0 * 2.56e8 / 27.0, 1e-14);
    }

    /// A Timoshenko beam of a length in (u, theta, u, theta), with theta = u' in bending.
    fn element(rigidity: f64, shear: Option<f64>, length: f64) -> [[f64; 4]; 4] {
        let phi = shear.map_or(0.0, |shear| 12.0 * rigidity / (shear * length * length));
        let (l, f) = (length, rigidity / (length.powi(3) * (1.0 + phi)));
        let near = (4.0 + phi) * l * l * f;
        let far = (2.0 - phi) * l * l * f;
        let (k, m) = (12.0 * f, 6.0 * l * f);
        [
            [k, m, -k, m],
            [m, near, -m, far],
            [-k, -m, k, -m],
            [m, far, -m, near],
        ]
    }

    /// Two beam elements from floor to floor, the rotations that are free condensed out: the
    /// stiffness in the three displacements, and what carries them on to the forces at the
    /// ends, rows of shear and moment below and above.
    fn condensed(
        rigidity: f64,
        shear: Option<f64>,
        ends: ColumnEnds,
        [a, b]: [f64; 2],
    ) -> (DMatrix<f64>, DMatrix<f64>) {
        // u_l, theta_l, u_c, theta_c, u_u, theta_u
        let mut whole = DMatrix::<f64>::zeros(6, 6);
        for (first, element) in [
            (0, element(rigidity, shear, a)),
            (2, element(rigidity, shear, b)),
        ] {
            for i in 0..4 {
                for j in 0..4 {
                    whole[(first + i, first + j)] += element[i][j];
                }
            }
        }
        let free: &[usize] = match ends {
            ColumnEnds::Fixed => &[3],
            ColumnEnds::Pinned => &[3, 5],
        };
        let kept = [0, 2, 4];
        let pick = |rows: &[usize], columns: &[usize]| {
            DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
                whole[(rows[i], columns[j])]
            })
        };
        let inverse = pick(free, free).try_inverse().unwrap();
        let rotations = -(inverse * pick(free, &kept));
        let mut displacements = DMatrix::zeros(6, 3);
        for (j, row) in kept.iter().enumerate() {
            displacements[(*row, j)] = 1.0;
        }
        for (i, row) in free.iter().enumerate() {
            displacements.row_mut(*row).copy_from(&rotations.row(i));
        }
        let forces = &whole * displacements;
        let stiffness = DMatrix::from_fn(3, 3, |i, j| forces[(kept[i], j)]);
        // What the floors do to the column: shears positive with the drift.
        let ends = DMatrix::from_fn(4, 3, |i, j| match i {
            0 => -forces[(0, j)],
            1 => forces[(4, j)],
            2 => -forces[(1, j)],
            _ => -forces[(5, j)],
        });
        (stiffness, ends)
    }

    #[test]
    fn formulas_are_the_condensation_of_two_beam_elements() {
        let rigidity = 1.7e8;
        for shear in [None, Some(9.0e7), Some(4.0e8), Some(1.0e10)] {
            for ends in [ColumnEnds::Fixed, ColumnEnds::Pinned] {
                for a in [0.2, 0.9, 1.7, 3.1] {
                    let h = 3.4;
                    let column = HitColumn::new(rigidity, shear, ends, h, a).unwrap();
                    let (expected, forces) = condensed(rigidity, shear, ends, [a, h - a]);
                    let (k_s, k_c) = (column.storey_stiffness(), column.point_stiffness());
                    let (t, drift) = (column.bow(), [-1.0, 0.0, 1.0]);
                    let found = DMatrix::from_fn(3, 3, |i, j| {
                        k_s * drift[i] * drift[j] + k_c * t[i] * t[j]
                    });
                    let error = (found - &expected).amax() / expected.amax();
                    assert!(error < 1e-12, "{shear:?} {ends:?} {a}: {error:e}");
                    let rows = column.force_rows();
                    let rows = [
                        rows.shear_below,
                        rows.shear_above,
                        rows.moment_bottom,
                        rows.moment_top,
                    ];
                    let scale = forces.amax();
                    for (i, row) in rows.iter().enumerate() {
                        for (j, found) in row.iter().enumerate() {
                            let error = (found - forces[(i, j)]).abs() / scale;
                            assert!(error < 1e-12, "{shear:?} {ends:?} {a} {i} {j}: {error:e}");
                        }
                    }
                }
            }
        }
    }

    /// Beam elements from floor to floor over several points, the rotations that are free
    /// condensed out.
    fn condensed_line(
        (rigidity, shear, ends, height): (f64, Option<f64>, ColumnEnds, f64),
        points: &[f64],
    ) -> DMatrix<f64> {
        let nodes: Vec<f64> = [0.0]
            .into_iter()
            .chain(points.iter().copied())
            .chain([height])
            .collect();
        let mut whole = DMatrix::<f64>::zeros(2 * nodes.len(), 2 * nodes.len());
        for (first, pair) in nodes.windows(2).enumerate() {
            let element = element(rigidity, shear, pair[1] - pair[0]);
            for i in 0..4 {
                for j in 0..4 {
                    whole[(2 * first + i, 2 * first + j)] += element[i][j];
                }
            }
        }
        let last = nodes.len() - 1;
        let kept: Vec<usize> = [0, 2 * last]
            .into_iter()
            .chain((1..last).map(|i| 2 * i))
            .collect();
        let mut free: Vec<usize> = (1..last).map(|i| 2 * i + 1).collect();
        if ends == ColumnEnds::Pinned {
            free.push(2 * last + 1);
        }
        let pick = |rows: &[usize], columns: &[usize]| {
            DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
                whole[(rows[i], columns[j])]
            })
        };
        let inverse = pick(&free, &free).try_inverse().unwrap();
        pick(&kept, &kept) - pick(&kept, &free) * inverse * pick(&free, &kept)
    }

    #[test]
    fn points_of_one_column_act_on_one_another() {
        for shear in [None, Some(4.0e8)] {
            for ends in [ColumnEnds::Fixed, ColumnEnds::Pinned] {
                for points in [vec![1.1], vec![1.1, 3.0], vec![0.7, 2.4, 5.1]] {
                    let (rigidity, h) = (1.7e8, 6.0);
                    let column = |a: &f64| HitColumn::new(rigidity, shear, ends, h, *a).unwrap();
                    let line = HitLine::new(points.iter().map(column).collect()).unwrap();
                    let expected = condensed_line((rigidity, shear, ends, h), &points);
                    let k_s = line.points()[0].storey_stiffness();
                    let mut found = line.on_floors(line.stiffness());
                    for (i, j, sign) in [(0, 0, 1.0), (1, 1, 1.0), (0, 1, -1.0), (1, 0, -1.0)] {
                        found[(i, j)] += sign * k_s;
                    }
                    let error = (found - &expected).amax() / expected.amax();
                    assert!(error < 1e-11, "{shear:?} {ends:?} {points:?}: {error:e}");
                    shears_jump_by_the_forces(&line, &expected);
                }
            }
        }
    }

    /// The shear below the lowest point and that above the highest are those of the ends, and
    /// at every point they differ by the force that the column carries there.
    fn shears_jump_by_the_forces(line: &HitLine, condensed: &DMatrix<f64>) {
        let n = line.points().len();
        let row = |point: usize, name: &str| -> Vec<f64> {
            let all = line.responses(point);
            let found = all.into_iter().find(|r| r.name == name).unwrap();
            [vec![found.lower, found.upper], found.points].concat()
        };
        for j in 0..n + 2 {
            let near = |found: f64, expected: f64| {
                let error = (found - expected).abs() / condensed.amax();
                assert!(error < 1e-11, "{error:e}");
            };
            near(row(0, "column_shear_below")[j], -condensed[(0, j)]);
            near(row(n - 1, "column_shear_above")[j], condensed[(1, j)]);
            for point in 0..n {
                let [below, above] =
                    ["column_shear_below", "column_shear_above"].map(|name| row(point, name)[j]);
                near(below - above, condensed[(point + 2, j)]);
                if let Some(next) = (point + 1..n).next() {
                    near(above, row(next, "column_shear_below")[j]);
                }
            }
        }
    }

    /// One point: the rows of a column that stands for itself.
    #[test]
    fn responses_of_one_point_are_its_forces() {
        for ends in [ColumnEnds::Fixed, ColumnEnds::Pinned] {
            let column = HitColumn::new(2.56e8, Some(4e8), ends, 3.0, 1.4).unwrap();
            let rows = column.force_rows();
            let line = HitLine::new(vec![column]).unwrap();
            let responses = line.responses(0);
            let count = if ends == ColumnEnds::Fixed { 5 } else { 4 };
            assert_eq!(responses.len(), count);
            let names: Vec<_> = column.responses().iter().map(|r| r.name).collect();
            assert_eq!(names, responses.iter().map(|r| r.name).collect::<Vec<_>>());
            for response in responses {
                let expected = match response.name {
                    "column_shear_below" => rows.shear_below,
                    "column_shear_above" => rows.shear_above,
                    "column_moment_bottom" => rows.moment_bottom,
                    "column_moment_top" => rows.moment_top,
                    _ => column.bow(),
                };
                let found = [response.lower, response.points[0], response.upper];
                for (found, expected) in found.iter().zip(expected) {
                    let size = rows.shear_below[1].abs().max(1.0);
                    assert!((found - expected).abs() < 1e-12 * size, "{}", response.name);
                }
            }
        }
        let column = HitColumn::new(2.56e8, None, ColumnEnds::Fixed, 3.0, 1.4).unwrap();
        assert!(HitLine::new(vec![column, column]).is_none());
    }

    /// The forms in which the formulas without shear are usually written.
    #[test]
    fn a_column_pinned_above_has_its_closed_form() {
        let (rigidity, h, a) = (5.0e7_f64, 3.6_f64, 1.1_f64);
        let column = HitColumn::new(rigidity, None, ColumnEnds::Pinned, h, a).unwrap();
        let (b, xi) = (h - a, a / h);
        near(column.storey_stiffness(), 3.0 * rigidity / h.powi(3), 1e-14);
        near(column.shares()[1], 0.5 * xi * xi * (3.0 - xi), 1e-14);
        let flexibility = a.powi(3) * b * b * (3.0 * a + 4.0 * b) / (12.0 * rigidity * h.powi(3));
        near(column.point_stiffness(), 1.0 / flexibility, 1e-14);
    }

    /// Without a hit the column is one of the storey.
    #[test]
    fn without_force_the_shears_are_those_of_the_storey() {
        let column = HitColumn::new(1e8, Some(1e9), ColumnEnds::Fixed, 3.0, 1.0).unwrap();
        let forces = column.forces(0.01, 0.0);
        assert_eq!(forces.shear_below, forces.shear_above);
        near(forces.shear_below, 0.01 * column.storey_stiffness(), 1e-15);
        near(forces.moment_bottom, 1.5 * forces.shear_below, 1e-15);
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let told = |rigidity, shear, h, a| {
            let made = HitColumn::new(rigidity, shear, ColumnEnds::Fixed, h, a);
            made.unwrap_err().to_string()
        };
        assert!(told(1e8, None, 3.0, 0.1).contains("within 5 %"));
        assert!(told(1e8, None, 3.0, 2.9).contains("within 5 %"));
        assert!(told(1e8, None, 3.0, 3.5).contains("above the floor below"));
        assert!(told(1e8, None, 3.0, f64::NAN).contains("hit NaN m"));
        assert!(told(0.0, None, 3.0, 1.0).contains("flexural rigidity = 0"));
        assert!(told(1e8, Some(-1.0), 3.0, 1.0).contains("shear rigidity = -1"));
    }
}
