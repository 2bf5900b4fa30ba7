//! Buildings that stand on a foundation which sways and rocks.

use nalgebra::DMatrix;

use super::ShearBuilding;
use crate::building_on_foundation::{BuildingOnFoundation, CoupledMode, FixedBaseBuilding};
use crate::coordinates::{Coordinate, Excitation, GeneralBuilding, ResponseKind, ResponseRow};
use crate::damping::Damping;
use crate::error::ShearBuildingError;
use crate::foundation::Foundation;

/// The foundation of a building, and what the building would be without it.
#[derive(Debug, Clone)]
pub struct OnFoundation {
    foundation: Foundation,
    length: Option<f64>,
    overturning_moment: Option<f64>,
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

    /// The moment (N m) that overturns a rigid body on rigid ground: the weight of floors and foundation stands on
    /// the edge alone. No soil bears more. `None` where the length is not known.
    #[must_use]
    pub fn overturning_moment(&self) -> Option<f64> {
        self.overturning_moment
    }

    /// The moment (N m) from which on the edge of the foundation lifts off elastic soil, [`UPLIFT_BEGINS`] of
    /// [`OnFoundation::overturning_moment`]; `None` where the length is not known.
    #[must_use]
    pub fn moment_of_uplift(&self) -> Option<f64> {
        self.overturning_moment.map(|moment| UPLIFT_BEGINS * moment)
    }
}

/// Name of the response that is the moment on the foundation over that which overturns a rigid body.
pub const OVERTURNING_RATIO: &str = "overturning_ratio";

/// The overturning ratio (-) from which on an edge lifts off: the pressure under it is zero at a moment of a sixth of
/// weight times length under a rectangle on Winkler's springs, and under a rigid disc on an elastic half-space, where
/// weight and moment press by `P / (2 pi a r)` and `3 M x / (2 pi a^3 r)`, `r = sqrt(a^2 - x^2 - y^2)`. Under a rigid strip
/// on a half-space it is a quarter.
pub const UPLIFT_BEGINS: f64 = 1.0 / 3.0;

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
    /// Laws of its storeys stay, with the drifts of the building itself as their deformations.
    /// Modes, damping and the rows of its forces are those of the elastic building.
    ///
    /// # Errors
    /// Gravity or a length that is not above zero, a building with further coordinates or on isolators that follow a
    /// law, gravity that overturns building and foundation, and values so far apart that the modes cannot be
    /// resolved.
    pub fn on_foundation(
        self,
        foundation: Foundation,
        length: Option<f64>,
        gravity: f64,
    ) -> Result<Self, ShearBuildingError> {
        if let (Some(_), Some(Some(law))) = (self.isolator(), self.laws().first()) {
            return Err(ShearBuildingError::Law {
                law: law.law.descriptor().name,
                building: self.name().to_owned(),
                storey: 1,
                reason: "isolators stand on no foundation that sways or rocks".to_owned(),
            });
        }
        let sizes = [("gravity", Some(gravity), "m/s2"), ("length", length, "m")];
        for (quantity, value, unit) in sizes {
            if let Some(value) = value.filter(|value| !(value.is_finite() && *value > 0.0)) {
                return Err(ShearBuildingError::FoundationSize {
                    building: self.name().to_owned(),
                    quantity,
                    value,
                    unit,
                });
            }
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
        let overturning_moment = length.map(|length| 0.5 * weight * length);
        let made = general(&self, &matrices, overturning_moment);
        let building = Self::with_coordinates(made)?;
        let on = OnFoundation {
            overturning_moment,
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
    overturning_moment: Option<f64>,
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
    if let Some(limit) = overturning_moment {
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
        geometric: None,
        damping: Damping::Matrix {
            matrix: matrices.damping().clone(),
        },
        drifts: Some(rows(matrices.storey_drifts())),
        sections,
        responses,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pounding_hysteresis::{LawParameters, build};

    use super::*;
    use crate::foundation::SpringDashpot;
    use crate::isolator::{Isolator, IsolatorKind};
    use crate::storey_law::StoreyLaw;

    fn fixed(gravity: f64) -> ShearBuilding {
        let damping = Damping::Modal { ratios: vec![0.05] };
        let (mass, stiffness) = (vec![1.0e5, 8.0e4], vec![6.0e7, 5.0e7]);
        let name = "a".to_owned();
        ShearBuilding::under_gravity(name, mass, stiffness, vec![3.0, 4.0], damping, gravity)
            .unwrap()
    }

    fn spring(stiffness: f64) -> Option<SpringDashpot> {
        Some(SpringDashpot {
            stiffness,
            dashpot: 0.0,
        })
    }

    /// The pressures under a disc sum up to weight and moment, by the midpoint rule over rings `x^2 + y^2 = (a sin t)^2`; at
    /// the edge `3 M / a^2` of the one takes away `P / a` of the other where `M = P a / 3`: a third of `P a`, which overturns.
    #[test]
    fn pressures_under_a_disc_have_their_resultants() {
        let (count, a) = (2000_u32, 1.7_f64);
        let h = 0.5 * std::f64::consts::PI / f64::from(count);
        // Of a moment of one, over the pressure of a weight of one, at each x.
        let by_x = 3.0 / (a * a);
        let (mut weight, mut moment) = (0.0, 0.0);
        for i in 0..count {
            let (sine, cosine) = libm::sincos((f64::from(i) + 0.5) * h);
            let (ring, width) = (a * sine, h * a * cosine);
            let pressure = 1.0 / (2.0 * std::f64::consts::PI * a * (a * cosine));
            weight += pressure * 2.0 * std::f64::consts::PI * ring * width;
            // Over a ring the mean of `x^2` is half its radius squared.
            moment += by_x * pressure * std::f64::consts::PI * ring.powi(3) * width;
        }
        assert!((weight - 1.0).abs() < 1e-6 && (moment - 1.0).abs() < 1e-6);
        let lifts = 1.0 / (by_x * a);
        assert!((lifts / a - UPLIFT_BEGINS).abs() < 1e-15);
    }

    /// Without rocking the moment at the base takes the place of that of the foundation.
    #[test]
    fn a_foundation_that_only_sways_may_overturn() {
        let foundation = Foundation::new(5.0e4, 0.0, spring(1.0e9), None).unwrap();
        let building = fixed(0.0)
            .on_foundation(foundation, Some(8.0), 10.0)
            .unwrap();
        let names: Vec<&str> = (building.responses().iter())
            .map(|r| r.name.as_str())
            .collect();
        let expected = ["foundation_sway", "foundation_shear", OVERTURNING_RATIO];
        assert_eq!(names, expected);
        // Half of 2.3 MN times 8 m.
        let on = building.foundation().unwrap();
        assert_eq!(on.overturning_moment(), Some(9.2e6));
        assert!((on.moment_of_uplift().unwrap() / 9.2e6 - 1.0 / 3.0).abs() < 1e-15);
        let ratio = &building.responses()[2].weights;
        for (ratio, moment) in ratio.iter().zip(on.matrices().base_moment()) {
            assert!((ratio * 9.2e6 - moment).abs() <= 1e-14 * moment.abs());
        }
        assert_eq!(building.coordinates(), 3);
        assert_eq!(building.further_coordinates()[0].inertia, 5.0e4);
    }

    /// Stiffness and damping of the building itself do no work in a motion with its foundation.
    #[test]
    fn the_building_rides_on_its_foundation() {
        let foundation = Foundation::new(5.0e4, 1.0e6, spring(1.0e9), spring(1.0e10)).unwrap();
        let building = fixed(0.0).on_foundation(foundation, None, 10.0).unwrap();
        // A sway of 1 and a rotation of 2, with floors at 3 and 7 m.
        let motion = [1.0 + 3.0 * 2.0, 1.0 + 7.0 * 2.0, 1.0, 2.0];
        let mut force = [0.0; 4];
        building.stiffness_matrix().multiply(&motion, &mut force);
        for (found, expected) in force.into_iter().zip([0.0, 0.0, 1.0e9, 2.0e10]) {
            assert!((found - expected).abs() < 1e-6 * 1e9, "{force:?}");
        }
        building.apply_damping(&motion, &mut force);
        assert!(force.iter().all(|f| f.abs() < 1e-6), "{force:?}");
        for row in building.drifts().unwrap() {
            let drift: f64 = row.iter().zip(motion).map(|(w, u)| w * u).sum();
            assert!(drift.abs() < 1e-14);
        }
        let on = building.foundation().unwrap();
        assert!(on.period_lengthening().unwrap() > 1.0 && on.length().is_none());
        assert_eq!(on.fixed_base().stiffness(), [6.0e7, 5.0e7]);
    }

    #[test]
    fn what_cannot_stand_is_refused() {
        let on = |building: ShearBuilding, rocking: f64| {
            let foundation = Foundation::new(0.0, 1.0e6, None, spring(rocking)).unwrap();
            let made = building.on_foundation(foundation, None, 10.0);
            made.map(|_| ()).map_err(|e| e.to_string())
        };
        assert_eq!(on(fixed(9.8), 1.0e10), Ok(()));
        // Gravity takes some 8 MN m/rad off the rocking spring.
        let error = on(fixed(9.8), 1.0e6).unwrap_err();
        assert!(error.contains("it cannot stand"), "{error}");
        assert_eq!(on(fixed(0.0), 1.0e6), Ok(()));

        let mut values = LawParameters::default();
        for (name, value) in [("stiffness", 6.0e7), ("yield_force", 1.0e6)] {
            values.values.insert(name.to_owned(), value);
        }
        let law = StoreyLaw {
            law: Arc::from(build("bilinear", &values).unwrap()),
            yield_drift: None,
        };
        let yields = fixed(0.0).with_laws(vec![Some(law), None]).unwrap();
        assert_eq!(on(yields, 1.0e10), Ok(()));
        let isolator = Isolator {
            kind: IsolatorKind::FrictionPendulum {
                radius: 2.0,
                friction_fast: 0.08,
                friction_slow: 0.04,
                rate: 30.0,
                yield_displacement: 0.001,
            },
            dashpot: 0.0,
        };
        let (mass, height) = (vec![5.0e4, 8.0e4], vec![0.5, 4.0]);
        let damping = Damping::MassProportional { ratio: 0.0 };
        let isolated =
            ShearBuilding::on_isolators("b".to_owned(), mass, &[5.0e7], height, damping, isolator);
        let error = on(isolated.unwrap(), 1.0e10).unwrap_err();
        assert!(
            error.contains("isolators stand on no foundation"),
            "{error}"
        );

        let foundation = Foundation::new(0.0, 1.0e6, None, spring(1.0e10)).unwrap();
        let twice = fixed(0.0).on_foundation(foundation, None, 10.0).unwrap();
        let error = on(twice, 1.0e10).unwrap_err();
        assert!(error.contains("3 values for 2"), "{error}");
    }
}
