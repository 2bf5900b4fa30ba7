//! Borovin, Lapshin and Yurin, Keldysh Institute preprint 46 (2014): a rubber ball on
//! concrete with dry friction in the contact.
//!
//! Radius and stiffness are printed; penetration, duration and restitution appear in
//! the figures only, so the reference values here are the law's closed form.

use std::f64::consts::PI;

use crate::collision::{Bodies, CollisionOutcome, collide};
use crate::contact_stiffness::{ContactStiffnessError, Sphere, hertz};
use crate::error::GapElementError;
use crate::model::{ImpactModel, Memory, Phase};
use crate::parameters::ModelParameters;
use crate::registry;

/// Mass of the ball (kg).
pub const MASS: f64 = 0.1;
/// Density of the rubber (kg/m3).
pub const DENSITY: f64 = 1800.0;
/// Young's moduli of rubber and concrete (Pa); the latter is printed 2750e7.
pub const ELASTIC_MODULI: [f64; 2] = [8.0e6, 27.5e9];
/// Their Poisson's ratios (-).
pub const POISSON_RATIOS: [f64; 2] = [0.5, 0.15];
/// Friction of the contact (-).
pub const FRICTION: f64 = 0.3;
/// Radius of the ball as printed (m).
pub const PRINTED_RADIUS: f64 = 0.02367;
/// Contact stiffness as printed (N/m^1.5).
pub const PRINTED_STIFFNESS: f64 = 2.1873e6;

/// Radius of the ball (m) from its mass and density.
#[must_use]
pub fn radius() -> f64 {
    libm::cbrt(0.75 * MASS / (PI * DENSITY))
}

/// Contact stiffness (N/m^1.5) of the ball on a flat floor, Hertz 1882.
///
/// # Errors
/// None with these constants.
pub fn stiffness() -> Result<f64, ContactStiffnessError> {
    let body = |index: usize, radius| Sphere {
        radius,
        elastic_modulus: ELASTIC_MODULI[index],
        poisson_ratio: POISSON_RATIOS[index],
        density: None,
    };
    Ok(hertz(&body(0, radius()), &body(1, f64::INFINITY), None)?.value)
}

/// The ball hits the floor.
#[derive(Debug, Clone, PartialEq)]
pub struct BallOnConcrete {
    /// The collision.
    pub outcome: CollisionOutcome,
    /// Force just after the turning point (N): dry friction lets it drop from the
    /// peak.
    pub force_after_turning: f64,
}

/// Integrates the collision at this velocity (m/s) with this stiffness (N/m^1.5).
///
/// # Errors
/// A velocity or stiffness that is not positive.
pub fn ball_on_concrete(stiffness: f64, velocity: f64) -> Result<BallOnConcrete, GapElementError> {
    let parameters =
        ModelParameters::from_pairs(&[("stiffness", stiffness), ("friction", FRICTION)]);
    let model = registry::build("borovin_2014", &parameters)?;
    let bodies = Bodies {
        mass_left: MASS,
        mass_right: None,
        velocity_left: velocity,
        velocity_right: 0.0,
    };
    let outcome = collide(model.as_ref(), &bodies)?;
    let after = model.force(
        &outcome.collision,
        &Memory::default(),
        Phase::Restitution,
        outcome.peak_penetration,
        0.0,
    );
    Ok(BallOnConcrete {
        force_after_turning: after.value,
        outcome,
    })
}

/// The law of the preprint about a spring that is a table of penetrations (m) and forces (N),
/// both increasing from above zero: its equations hold for any f(x).
///
/// # Errors
/// A table that is empty or does not increase, or a friction (-) that is negative or not finite.
pub fn about_table(
    table: &[(f64, f64)],
    friction: f64,
) -> Result<Box<dyn ImpactModel>, GapElementError> {
    let mut parameters = ModelParameters::from_pairs(&[("friction", friction)]);
    parameters.spring = Some(table.to_vec());
    registry::build("borovin_2014", &parameters)
}

/// Reference values at one velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallReference {
    /// Velocity (m/s).
    pub velocity: f64,
    /// Maximum penetration (m).
    pub peak_penetration: f64,
    /// Time of the approach (s).
    pub compression: f64,
    /// Contact time (s).
    pub duration: f64,
    /// Force just before the turning point (N).
    pub peak_force: f64,
    /// Force just after it (N).
    pub force_after_turning: f64,
}

/// Restitution at every velocity (-): `sqrt((1 - D) / (1 + D))`.
pub const REFERENCE_RESTITUTION: f64 = 0.733_799_385_705_342_8;

/// Closed form over the velocities of the preprint.
pub const REFERENCE: [BallReference; 6] = [
    row(
        0.5,
        [
            0.0006552378010462099,
            0.0019285451596507976,
            0.0045567092017847945,
            47.69260862255432,
            25.680635412144632,
        ],
    ),
    row(
        1.0,
        [
            0.0011408352735873834,
            0.0016788960750760155,
            0.003966845762390385,
            109.5688421404911,
            58.998607306418286,
        ],
    ),
    row(
        2.0,
        [
            0.001986309580099169,
            0.0014615639238730771,
            0.003453339812957793,
            251.72309745142388,
            135.54320631999747,
        ],
    ),
    row(
        3.0,
        [
            0.0027473876676920887,
            0.0013477196573396422,
            0.0031843519625632108,
            409.47989001677485,
            220.48917154749412,
        ],
    ),
    row(
        4.0,
        [
            0.003458365847671639,
            0.001272365297221001,
            0.0030063069194233385,
            578.3078159144179,
            311.39651626160963,
        ],
    ),
    row(
        5.0,
        [
            0.004134271029511578,
            0.0012168297326433976,
            0.002875089137526595,
            755.8769073659854,
            407.01064242783826,
        ],
    ),
];

const fn row(velocity: f64, values: [f64; 5]) -> BallReference {
    BallReference {
        velocity,
        peak_penetration: values[0],
        compression: values[1],
        duration: values[2],
        peak_force: values[3],
        force_after_turning: values[4],
    }
}
