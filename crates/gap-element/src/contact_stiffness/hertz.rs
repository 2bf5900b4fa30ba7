//! Two elastic spheres.

use super::{Approach, ContactStiffness, ContactStiffnessError, positive, quantity};
use crate::descriptor::Verification;

/// Least ratio of contact time to wave transit at which waves are taken to have
/// died away during the contact (the assumption of a quasi-static contact).
const LEAST_WAVE_TRANSITS: f64 = 10.0;
/// Maximum contact radius as a part of the effective radius of curvature for
/// which surfaces count as half-spaces.
const GREATEST_CONTACT_RADIUS: f64 = 0.1;
/// An elastic sphere, or the curved face of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Radius (m); infinite is a flat half-space.
    pub radius: f64,
    /// Young's modulus (Pa).
    pub elastic_modulus: f64,
    /// Poisson's ratio (-), in (-1, 0.5].
    pub poisson_ratio: f64,
    /// Density (kg/m^3) for the check of waves; `None`: not checked.
    pub density: Option<f64>,
}

/// Two elastic spheres: `k = 4/3 E* sqrt(R*)` in N/m^1.5, with
/// `1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2` and `1/R* = 1/R1 + 1/R2` (Hertz 1882).
///
/// # Errors
/// Radii, moduli, ratios or densities out of range, or two flat bodies.
pub fn hertz(
    left: &Sphere,
    right: &Sphere,
    approach: Option<Approach>,
) -> Result<ContactStiffness, ContactStiffnessError> {
    let compliance = sphere_compliance(left)? + sphere_compliance(right)?;
    if left.radius.is_infinite() && right.radius.is_infinite() {
        return Err(ContactStiffnessError::BothFlat);
    }
    let modulus = 1.0 / compliance;
    let radius = 1.0 / (1.0 / left.radius + 1.0 / right.radius);
    let mut result = ContactStiffness {
        value: 4.0 / 3.0 * modulus * radius.sqrt(),
        exponent: 1.5,
        source: "Hertz, J. reine angew. Math. 92 (1882) 156",
        status: Verification::Verified("independent evaluation of the formula, 1e-10"),
        intermediate: vec![
            quantity("effective modulus", modulus, "Pa"),
            quantity("effective radius", radius, "m"),
        ],
        warnings: vec![
            "holds for curved bodies only: flat-on-flat contact of slabs is not Hertzian (there n = 1)".to_owned(),
        ],
    };
    if let Some(approach) = approach {
        hertz_limits(&mut result, [left, right], radius, approach.checked()?);
    }
    result.checked()
}

/// `(1 - nu^2) / E` (1/Pa).
fn sphere_compliance(sphere: &Sphere) -> Result<f64, ContactStiffnessError> {
    if sphere.radius != f64::INFINITY {
        positive("radius", sphere.radius, "m")?;
    }
    positive("elastic modulus", sphere.elastic_modulus, "Pa")?;
    if let Some(density) = sphere.density {
        positive("density", density, "kg/m^3")?;
    }
    let ratio = sphere.poisson_ratio;
    if !(ratio > -1.0 && ratio <= 0.5) {
        return Err(ContactStiffnessError::OutOfRange {
            quantity: "Poisson's ratio",
            value: ratio,
            range: "(-1, 0.5]",
        });
    }
    Ok((1.0 - ratio * ratio) / sphere.elastic_modulus)
}

/// Warns where the contact is too fast or too wide for Hertz's assumptions.
fn hertz_limits(
    result: &mut ContactStiffness,
    bodies: [&Sphere; 2],
    radius: f64,
    approach: Approach,
) {
    let penetration = approach.penetration(result.value, result.exponent);
    let duration = approach.duration(penetration, result.exponent);
    let contact_radius = (radius * penetration).sqrt();
    result.intermediate.extend([
        quantity("maximum penetration", penetration, "m"),
        quantity("contact time", duration, "s"),
        quantity("contact radius", contact_radius, "m"),
    ]);
    // No wave returns from a half-space.
    let transit = |b: &Sphere| {
        let density = b.density.filter(|_| b.radius.is_finite())?;
        Some(2.0 * b.radius / (b.elastic_modulus / density).sqrt())
    };
    let slowest = bodies.into_iter().filter_map(transit).reduce(f64::max);
    if let Some(transit) = slowest {
        result
            .intermediate
            .push(quantity("wave transit time", transit, "s"));
        if duration < LEAST_WAVE_TRANSITS * transit {
            result.warnings.push(format!(
                "the contact lasts {:.3} times as long as a wave takes through the larger body, not {LEAST_WAVE_TRANSITS} times: waves carry energy away, which Hertz's theory leaves out",
                duration / transit
            ));
        }
    }
    if contact_radius > GREATEST_CONTACT_RADIUS * radius {
        result.warnings.push(format!(
            "the contact radius reaches {:.3} times the effective radius, more than {GREATEST_CONTACT_RADIUS}: the bodies are no half-spaces there",
            contact_radius / radius
        ));
    }
}
