//! The elastic power law that gives a wanted contact time or penetration.

use super::{ContactStiffness, ContactStiffnessError, positive, quantity};
use crate::classes::elastic_time_factor;
use crate::descriptor::Verification;

/// How two floors meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach {
    /// Relative velocity at closure (m/s).
    pub velocity: f64,
    /// `m1 m2 / (m1 + m2)` of the two floors (kg).
    pub effective_mass: f64,
}

impl Approach {
    /// From the velocity (m/s) and both masses (kg); `None` is a rigid wall.
    ///
    /// # Errors
    /// A velocity or mass that is not positive.
    pub fn new(
        velocity: f64,
        mass_left: f64,
        mass_right: Option<f64>,
    ) -> Result<Self, ContactStiffnessError> {
        positive("left mass", mass_left, "kg")?;
        let effective_mass = match mass_right {
            None => mass_left,
            Some(right) => {
                positive("right mass", right, "kg")?;
                let light = mass_left.min(right);
                light / (1.0 + light / mass_left.max(right))
            }
        };
        Self {
            velocity,
            effective_mass,
        }
        .checked()
    }

    pub(super) fn checked(self) -> Result<Self, ContactStiffnessError> {
        positive("approach velocity", self.velocity, "m/s")?;
        positive("effective mass", self.effective_mass, "kg")?;
        Ok(self)
    }

    /// Maximum penetration (m) of the elastic law with this stiffness.
    pub(super) fn penetration(&self, stiffness: f64, exponent: f64) -> f64 {
        let power = exponent + 1.0;
        libm::pow(
            0.5 * power * self.effective_mass * self.velocity * self.velocity / stiffness,
            1.0 / power,
        )
    }

    /// Stiffness (N/m^n) that stops the floors at this penetration (m).
    fn stiffness(&self, penetration: f64, exponent: f64) -> f64 {
        let power = exponent + 1.0;
        0.5 * power * self.effective_mass * self.velocity * self.velocity
            / libm::pow(penetration, power)
    }

    /// Contact time (s) of the elastic law that penetrates this far (m).
    pub(super) fn duration(&self, penetration: f64, exponent: f64) -> f64 {
        2.0 * elastic_time_factor(exponent) * penetration / self.velocity
    }
}

/// Stiffness (N/m^n) of the elastic law `F = k delta^n` whose contact lasts so
/// long (s): `delta_max = T v0 / (2 I_n)` from the contact time of the power law,
/// `T = 2 I_n delta_max / v0`. For n = 1 it is `m (pi / T)^2`. The restitution (-)
/// of the law meant, if it is known, decides whether damping is warned of.
///
/// # Errors
/// Quantities that are not positive, an exponent outside [1, 5], which impact models take, or a restitution outside (0, 1].
pub fn duration(
    wanted: f64,
    exponent: f64,
    approach: Approach,
    restitution: Option<f64>,
) -> Result<ContactStiffness, ContactStiffnessError> {
    positive("contact time", wanted, "s")?;
    let penetration = wanted * approach.checked()?.velocity / (2.0 * power_time(exponent)?);
    let mut warnings = Vec::new();
    if exponent != 1.0 {
        warnings.push(format!(
            "holds at {} m/s only: the contact time of a law with n = {exponent} changes with the approach velocity",
            approach.velocity
        ));
    }
    if damped(restitution)? {
        warnings.push("holds without damping: the contact of a damped law lasts differently, see `pounding impact`".to_owned());
    }
    from_penetration(penetration, exponent, approach, warnings)
}

/// Stiffness (N/m^n) of the elastic law `F = k delta^n` that stops the floors at
/// this penetration (m): `k = (n + 1) m v0^2 / (2 delta_max^(n + 1))`, energy
/// conservation. Restitution (-) and gap width (m), if known, decide on warnings.
///
/// # Errors
/// Quantities that are not positive, an exponent outside [1, 5], which impact models take, or a restitution outside (0, 1].
pub fn penetration(
    wanted: f64,
    exponent: f64,
    approach: Approach,
    restitution: Option<f64>,
    gap_width: Option<f64>,
) -> Result<ContactStiffness, ContactStiffnessError> {
    positive("maximum penetration", wanted, "m")?;
    approach.checked()?;
    power_time(exponent)?;
    let mut warnings = Vec::new();
    if damped(restitution)? {
        warnings.push("holds without damping: a damped law penetrates less".to_owned());
    }
    if let Some(width) = gap_width {
        positive("gap width", width, "m")?;
        if wanted > width {
            warnings.push(format!(
                "the penetration of {wanted} m exceeds the gap of {width} m: the floors would overlap by more than they are apart"
            ));
        }
    }
    from_penetration(wanted, exponent, approach, warnings)
}

/// What [`duration`] and [`penetration`] share.
fn from_penetration(
    penetration: f64,
    exponent: f64,
    approach: Approach,
    warnings: Vec<String>,
) -> Result<ContactStiffness, ContactStiffnessError> {
    let value = approach.stiffness(penetration, exponent);
    ContactStiffness {
        value,
        exponent,
        source: "Energy and contact time of the elastic power law, closed form",
        status: Verification::Verified(
            "integrated collisions of linear_elastic and hertz_1882, 1e-9",
        ),
        intermediate: vec![
            quantity("effective mass", approach.effective_mass, "kg"),
            quantity("maximum penetration", penetration, "m"),
            quantity(
                "contact time",
                approach.duration(penetration, exponent),
                "s",
            ),
            quantity(
                "maximum force",
                value * libm::pow(penetration, exponent),
                "N",
            ),
        ],
        warnings,
    }
    .checked()
}

/// `I_n` after a check of the exponent: below 1 the force would start infinitely
/// stiff, published laws end at about 2.65, and impact models take no exponent above 5.
fn power_time(exponent: f64) -> Result<f64, ContactStiffnessError> {
    if (1.0..=5.0).contains(&exponent) {
        return Ok(elastic_time_factor(exponent));
    }
    Err(ContactStiffnessError::OutOfRange {
        quantity: "exponent",
        value: exponent,
        range: "[1, 5]",
    })
}

/// Whether the law meant may have damping: unless its restitution is 1.
fn damped(restitution: Option<f64>) -> Result<bool, ContactStiffnessError> {
    match restitution {
        Some(value) if !(value > 0.0 && value <= 1.0) => Err(ContactStiffnessError::OutOfRange {
            quantity: "restitution",
            value,
            range: "(0, 1]",
        }),
        given => Ok(given != Some(1.0)),
    }
}
