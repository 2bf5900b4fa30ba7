//! Buildings that stand on a foundation which sways and rocks.

use nalgebra::DMatrix;

use crate::building::ShearBuilding;
use crate::coordinates::{Coordinate, Excitation, GeneralBuilding, ResponseKind, ResponseRow};
use crate::damping::Damping;
use crate::error::ShearBuildingError;
use crate::foundation::{BuildingOnFoundation, CoupledMode, FixedBaseBuilding, Foundation};

/// The foundation of a building, and what the building would be without it.
#[derive(Debug, Clone)]
pub struct OnFoundation {
    foundation: Foundation,
    length: Option<f64>,
    moment_of_uplift: Option<f64>,
    fixed_base: ShearBuilding,
    matrices: BuildingOnFoundation,
    first_mode: Option<CoupledMode>,
}

impl OnFoundation {
    /// The foundation.
    #[must_use]
    pub fn foundation(&self) -> &Foundation {
        &self.foundation
    }

    /// Length of the foundation along the motion (m), if it is known.
    #[must_use]
    pub fn length(&self) -> Option<f64> {
        self.length
    }

    /// The building on a fixed base.
    #[must_use]
    pub fn fixed_base(&self) -> &ShearBuilding {
        &self.fixed_base
    }

    /// Matrices and rows of the building with its foundation.
    #[must_use]
    pub fn matrices(&self) -> &BuildingOnFoundation {
        &self.matrices
    }

    /// The first mode of building and soil with their damping; `None` where it does not
    /// oscillate.
    #[must_use]
    pub fn first_mode(&self) -> Option<CoupledMode> {
        self.first_mode
    }

    /// Period of the first mode over that of the building on a fixed base (-).
    #[must_use]
    pub fn period_lengthening(&self) -> Option<f64> {
        let fixed = self.fixed_base.modes().period.first()?;
        Some(self.first_mode?.period / fixed)
    }

    /// The moment (N m) at which half the length of the foundation no longer holds the weight
    /// of floors and foundation: the far edge lifts off. `None` where the length is not known.
    #[must_use]
    pub fn moment_of_uplift(&self) -> Option<f64> {
        self.moment_of_uplift
    }
}

/// Name of the response that is the moment on the foundation over that at which it lifts off.
pub const OVERTURNING_RATIO: &str = "overturning_ratio";

impl ShearBuilding {
    /// This building on a foundation, of this length along the motion (m) if it is known.
    /// Further coordinates after the floors are the sway of the foundation and its rotation,
    /// as far as it has them; floor displacements remain those relative to the ground. Drifts,
    /// storey shears and the base moment are those of the building itself, without what sway
    /// and rotation add. Named responses are `foundation_sway` (m) and `foundation_shear` (N),
    /// `foundation_rotation` (rad) and `foundation_moment` (N m), force and moment those of
    /// the springs of the soil; where the length is known, also [`OVERTURNING_RATIO`] (-), the
    /// moment (that at the base where the foundation does not rock) over half of weight
    /// times length. `gravity` in m/s2.
    ///
    /// # Errors
    /// A building with storey laws or further coordinates, gravity that overturns building
    /// and foundation, and values so far apart that the modes cannot be resolved.
    pub fn on_foundation(
        self,
        foundation: Foundation,
        length: Option<f64>,
        gravity: f64,
    ) -> Result<Self, ShearBuildingError> {
        if let Some(storey) = self.laws().iter().position(Option::is_some) {
            let law = self.laws()[storey].as_ref();
            return Err(ShearBuildingError::Law {
                law: law.map_or("", |l| l.law.descriptor().name),
                building: self.name().to_owned(),
                storey: storey + 1,
                reason: "a building on a foundation that sways or rocks has elastic storeys"
                    .to_owned(),
            });
        }
        let n = self.storeys();
        let stiffness = self
            .elastic_matrix()
            .ok_or_else(|| ShearBuildingError::Length {
                building: self.name().to_owned(),
                quantity: "coordinates of a building that is put on a foundation",
                found: self.coordinates(),
                expected: n,
            })?;
        let damping = DMatrix::from_fn(n, n, |i, j| self.damping_matrix().entry(i, j));
        let carried = foundation.carrying(&FixedBaseBuilding {
            mass: self.mass(),
            elevations: self.elevations(),
            stiffness: &stiffness,
            geometric: self.geometric_stiffness(),
            damping: &damping,
        });
        let matrices = carried.map_err(|reason| ShearBuildingError::Foundation {
            building: self.name().to_owned(),
            reason,
        })?;
        if self.geometric_stiffness().iter().any(|g| *g > 0.0)
            && matrices.stiffness().clone().cholesky().is_none()
        {
            return Err(ShearBuildingError::Overturned {
                building: self.name().to_owned(),
            });
        }
        let floors: f64 = self.mass().iter().sum();
        let weight = gravity * (floors + foundation.mass());
        let moment_of_uplift = length.map(|length| 0.5 * weight * length);
        let made = general(&self, &matrices, moment_of_uplift);
        let building = Self::with_coordinates(made)?;
        let on = OnFoundation {
            moment_of_uplift,
            first_mode: matrices.first_mode(),
            foundation,
            length,
            matrices,
            fixed_base: self,
        };
        Ok(building.standing_on(on))
    }
}

/// The building of these matrices.
fn general(
    fixed: &ShearBuilding,
    matrices: &BuildingOnFoundation,
    moment_of_uplift: Option<f64>,
) -> GeneralBuilding {
    let mut further = Vec::new();
    let mut responses = Vec::new();
    let all = matrices.mass().len();
    let ends = [
        (
            matrices.sway(),
            ("sway of the foundation", Excitation::Along),
            ("foundation_sway", "m"),
            ("foundation_shear", "N", matrices.sway_force()),
        ),
        (
            matrices.rotation(),
            ("rotation of the foundation", Excitation::None),
            ("foundation_rotation", "rad"),
            ("foundation_moment", "N m", matrices.rocking_moment()),
        ),
    ];
    for (at, (name, excitation), motion, (force, force_unit, row)) in ends {
        let (Some(at), Some(row)) = (at, row) else {
            continue;
        };
        further.push(Coordinate {
            name: name.to_owned(),
            inertia: matrices.mass()[at],
            excitation,
        });
        let mut own = vec![0.0; all];
        own[at] = 1.0;
        for (name, unit, weights) in [(motion.0, motion.1, own), (force, force_unit, row)] {
            responses.push(ResponseRow {
                name: name.to_owned(),
                unit,
                kind: ResponseKind::Displacement,
                weights,
            });
        }
    }
    if let Some(limit) = moment_of_uplift {
        let moment = matrices.rocking_moment();
        let moment = moment.unwrap_or_else(|| matrices.base_moment());
        responses.push(ResponseRow {
            name: OVERTURNING_RATIO.to_owned(),
            unit: "1",
            kind: ResponseKind::Displacement,
            weights: moment.iter().map(|m| m / limit).collect(),
        });
    }
    let rows = |matrix: DMatrix<f64>| -> Vec<Vec<f64>> {
        let rows = matrix.row_iter();
        rows.map(|row| row.iter().copied().collect()).collect()
    };
    let mut sections = rows(matrices.storey_shears());
    sections.push(matrices.base_moment());
    GeneralBuilding {
        name: fixed.name().to_owned(),
        mass: fixed.mass().to_vec(),
        height: fixed.height().to_vec(),
        further,
        stiffness: matrices.stiffness().clone(),
        damping: Damping::Matrix {
            matrix: matrices.damping().clone(),
        },
        drifts: Some(rows(matrices.storey_drifts())),
        sections,
        responses,
    }
}
