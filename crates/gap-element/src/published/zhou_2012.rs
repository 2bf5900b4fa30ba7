//! Zhou, Wu, Zhang and Xie 2012, collision dynamics from spring-damper models: two
//! steel balls by the energy model and by the IMPACT function of ADAMS.
//!
//! The numbers of the paper's table 1 and the curves of its figures are lost in the
//! source at hand. The reference values here are an independent evaluation and an
//! independent integration of order 8 at a tolerance of 1e-13.

use std::f64::consts::PI;

use crate::classes::elastic_time_factor;
use crate::collision::{Bodies, CollisionOutcome, collide};
use crate::contact_stiffness::{ContactStiffnessError, Sphere, hertz};
use crate::error::GapElementError;
use crate::parameters::ModelParameters;
use crate::registry;

/// Radii of the balls (m).
pub const RADII: [f64; 2] = [0.025, 0.050];
/// Young's modulus of the steel (Pa).
pub const ELASTIC_MODULUS: f64 = 206.0e9;
/// Its Poisson's ratio (-).
pub const POISSON_RATIO: f64 = 0.28;
/// Its density (kg/m3).
pub const DENSITY: f64 = 7800.0;
/// Approach velocity (m/s).
pub const APPROACH_VELOCITY: f64 = 0.2;
/// Exponent of the spring (-).
pub const EXPONENT: f64 = 1.5;
/// Contact time over `delta_max / v0` as printed (-).
pub const PRINTED_TIME_FACTOR: f64 = 2.94;
/// Penetration at which the dashpot of IMPACT is fully on, as printed (m).
pub const FULL_DAMPING_PENETRATION: f64 = 1.0e-4;
/// Hertz stiffness of the two balls, independently evaluated (N/m^1.5).
pub const REFERENCE_STIFFNESS: f64 = 19_237_909_175.316_547;

/// Contact stiffness of the two balls (N/m^1.5), Hertz 1882.
///
/// # Errors
/// None with these constants.
pub fn stiffness() -> Result<f64, ContactStiffnessError> {
    let ball = |radius| Sphere {
        radius,
        elastic_modulus: ELASTIC_MODULUS,
        poisson_ratio: POISSON_RATIO,
        density: Some(DENSITY),
    };
    Ok(hertz(&ball(RADII[0]), &ball(RADII[1]), None)?.value)
}

/// The smaller ball runs into the larger one, which rests.
#[must_use]
pub fn bodies() -> Bodies {
    let mass = |radius: f64| 4.0 / 3.0 * PI * radius.powi(3) * DENSITY;
    Bodies {
        mass_left: mass(RADII[0]),
        mass_right: Some(mass(RADII[1])),
        velocity_left: APPROACH_VELOCITY,
        velocity_right: 0.0,
    }
}

/// The energy model in explicit form: velocity, and with it the damping force, is
/// taken from the elastic trajectory,
///
/// `F = k delta^n [1 +- y sqrt(1 - (delta / delta_max)^(n+1))]`, `y = (3/4)(1 - e^2)`,
///
/// plus in approach, minus in restitution (Zhou et al. 2012, equations 3 to 7, which
/// extend Lankarani and Nikravesh 1990). Its loop has exactly the area
/// `(1/2) m v0^2 (1 - e^2)` for n = 3/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExplicitCollision {
    /// Stiffness (N/m^n).
    pub stiffness: f64,
    /// Exponent n (-).
    pub exponent: f64,
    /// Damping factor y (-).
    pub damping_factor: f64,
    /// Hysteresis damping `y k / v0` (N s/m^(n+1)).
    pub hysteresis_damping: f64,
    /// Maximum penetration `[(n+1) m v0^2 / (2 k)]^(1/(n+1))` (m), whatever the
    /// restitution.
    pub peak_penetration: f64,
    /// Contact time `2 I_n delta_max / v0` (s), whatever the restitution.
    pub duration: f64,
    /// Maximum force (N), reached in approach.
    pub peak_force: f64,
    /// Where it is reached, over the maximum penetration (-).
    pub peak_force_place: f64,
}

impl ExplicitCollision {
    /// From stiffness (N/m^n), exponent (-), effective mass (kg), approach velocity
    /// (m/s) and restitution (-). With `q = sqrt(1 - (delta/delta_max)^(n+1))` the
    /// force peaks where `y (3n+1)/2 q^2 + n q - y (n+1)/2 = 0`.
    #[must_use]
    pub fn new(
        stiffness: f64,
        exponent: f64,
        effective_mass: f64,
        approach_velocity: f64,
        restitution: f64,
    ) -> Self {
        let (n, power) = (exponent, exponent + 1.0);
        let y = 0.75 * (1.0 - restitution * restitution);
        let energy = effective_mass * approach_velocity * approach_velocity;
        let peak_penetration = libm::pow(0.5 * power * energy / stiffness, 1.0 / power);
        // The positive root in the form without cancellation, good for y = 0 too.
        let q = power * y / (n + (n * n + (3.0 * n + 1.0) * power * y * y).sqrt());
        let place = libm::pow(1.0 - q * q, 1.0 / power);
        Self {
            stiffness,
            exponent,
            damping_factor: y,
            hysteresis_damping: y * stiffness / approach_velocity,
            peak_penetration,
            duration: 2.0 * elastic_time_factor(n) * peak_penetration / approach_velocity,
            peak_force: stiffness * libm::pow(place * peak_penetration, n) * (1.0 + y * q),
            peak_force_place: place,
        }
    }

    /// Force (N) at a penetration (m), in approach or in restitution.
    #[must_use]
    pub fn force(&self, penetration: f64, approaching: bool) -> f64 {
        let part = (penetration / self.peak_penetration).clamp(0.0, 1.0);
        let velocity = (1.0 - libm::pow(part, self.exponent + 1.0)).sqrt();
        let sign = if approaching { 1.0 } else { -1.0 };
        self.stiffness
            * libm::pow(penetration.max(0.0), self.exponent)
            * (1.0 + sign * self.damping_factor * velocity)
    }
}

/// The explicit form for the two balls.
///
/// # Errors
/// None with these constants.
pub fn explicit(restitution: f64) -> Result<ExplicitCollision, ContactStiffnessError> {
    let pair = bodies();
    let right = pair.mass_right.unwrap_or(f64::INFINITY);
    let mass = pair.mass_left / (1.0 + pair.mass_left / right);
    Ok(ExplicitCollision::new(
        stiffness()?,
        EXPONENT,
        mass,
        APPROACH_VELOCITY,
        restitution,
    ))
}

/// The same law, integrated (`lankarani_nikravesh_1990`). Stiffness in N/m^1.5.
///
/// # Errors
/// A restitution outside (0, 1].
pub fn integrated(stiffness: f64, restitution: f64) -> Result<CollisionOutcome, GapElementError> {
    let parameters =
        ModelParameters::from_pairs(&[("stiffness", stiffness), ("restitution", restitution)]);
    let model = registry::build("lankarani_nikravesh_1990", &parameters)?;
    collide(model.as_ref(), &bodies())
}

/// The two balls by IMPACT. Stiffness in N/m^1.5; the ratio is that of the numbers
/// of `c_max` in N s/mm and `k` in N/mm^1.5.
///
/// # Errors
/// A ratio that is negative or not finite.
pub fn adams_impact(stiffness: f64, ratio: f64) -> Result<CollisionOutcome, GapElementError> {
    let parameters = ModelParameters::from_pairs(&[
        ("stiffness", stiffness),
        ("damping_ratio_n_mm_s", ratio),
        ("full_damping_penetration", FULL_DAMPING_PENETRATION),
    ]);
    let model = registry::build("adams_impact", &parameters)?;
    collide(model.as_ref(), &bodies())
}

/// Reference values of the energy model at one restitution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnergyReference {
    /// Restitution put in (-).
    pub restitution: f64,
    /// Explicit form: maximum force (N).
    pub explicit_peak_force: f64,
    /// Explicit form: its place over the maximum penetration (-).
    pub explicit_place: f64,
    /// Integrated: restitution achieved (-).
    pub achieved: f64,
    /// Integrated: maximum force (N).
    pub peak_force: f64,
    /// Integrated: maximum penetration (m).
    pub peak_penetration: f64,
    /// Integrated: contact time (s).
    pub duration: f64,
}

/// Reference values of the explicit form, whatever the restitution: maximum
/// penetration (m), contact time (s).
pub const EXPLICIT_REFERENCE: (f64, f64) = (1.693_031_895_348_753e-5, 2.491_529_381_925_102e-4);

/// The energy model over its restitutions.
pub const ENERGY_REFERENCE: [EnergyReference; 6] = [
    energy(
        0.3,
        [1536.9953492045909, 0.9381388303389414],
        [
            0.6842246057494477,
            1210.6092417383975,
            1.4649942983799803e-05,
            0.0002622224754533716,
        ],
    ),
    energy(
        0.4,
        [1512.8359385073993, 0.9433535099250033],
        [
            0.7016347276735007,
            1211.384923459945,
            1.4784580748770745e-05,
            0.0002611239633471909,
        ],
    ),
    energy(
        0.5,
        [1483.067562671513, 0.9503978525978438],
        [
            0.7252411140101973,
            1213.5727705008599,
            1.496514221625924e-05,
            0.00025972977834724326,
        ],
    ),
    energy(
        0.6,
        [1449.0288238325895, 0.9594610367475238],
        [
            0.7561486806594477,
            1218.438307246845,
            1.5198268519345833e-05,
            0.00025805546226965217,
        ],
    ),
    energy(
        0.7,
        [1412.9160067501184, 0.9705639697419152],
        [
            0.7959725953653285,
            1228.114947266914,
            1.5493532094608736e-05,
            0.00025612265554669577,
        ],
    ),
    energy(
        0.8,
        [1378.3665898697775, 0.9830852660326397],
        [
            0.8471022797876163,
            1246.3005229154253,
            1.5864853706921578e-05,
            0.0002539617084127503,
        ],
    ),
];

const fn energy(restitution: f64, explicit: [f64; 2], integrated: [f64; 4]) -> EnergyReference {
    EnergyReference {
        restitution,
        explicit_peak_force: explicit[0],
        explicit_place: explicit[1],
        achieved: integrated[0],
        peak_force: integrated[1],
        peak_penetration: integrated[2],
        duration: integrated[3],
    }
}

/// Reference values of IMPACT.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AdamsReference {
    /// What the case is.
    pub case: &'static str,
    /// `c_max` over `k` as numbers in N, mm and s (-).
    pub ratio: f64,
    /// The dashpot coefficient that this is in SI (N s/m).
    pub damping: f64,
    /// Restitution achieved (-).
    pub achieved: f64,
    /// Maximum force (N).
    pub peak_force: f64,
    /// Maximum penetration (m).
    pub peak_penetration: f64,
    /// Contact time (s).
    pub duration: f64,
}

/// The two ends of the recommended range, and dashpots tuned to a restitution.
pub const ADAMS_REFERENCE: [AdamsReference; 5] = [
    adams(
        "0.1 % of k",
        0.001,
        608356.1041345181,
        [
            0.23382212613728692,
            1703.3278310615328,
            1.0024926923134003e-05,
            0.0003602663811908575,
        ],
    ),
    adams(
        "1 % of k",
        0.01,
        6083561.041345181,
        [
            0.04452276484233948,
            3361.0154283264405,
            5.17354792658269e-06,
            0.0008746555948412193,
        ],
    ),
    adams(
        "tuned to 0.8",
        6.811585221754033e-05,
        41438.69448486541,
        [
            0.7999999999250496,
            1250.939236954184,
            1.5514139914203183e-05,
            0.00025611395494274823,
        ],
    ),
    adams(
        "tuned to 0.5",
        0.00028619942561120405,
        174111.1675703689,
        [
            0.5000000000047694,
            1340.6560654973982,
            1.3052747089505289e-05,
            0.00028092118973450974,
        ],
    ),
    adams(
        "tuned to 0.3",
        0.0006945510824438775,
        422534.39063796983,
        [
            0.29999999999774296,
            1564.9795802149795,
            1.0932193976673135e-05,
            0.0003275857395715793,
        ],
    ),
];

const fn adams(
    case: &'static str,
    ratio: f64,
    damping: f64,
    integrated: [f64; 4],
) -> AdamsReference {
    AdamsReference {
        case,
        ratio,
        damping,
        achieved: integrated[0],
        peak_force: integrated[1],
        peak_penetration: integrated[2],
        duration: integrated[3],
    }
}
