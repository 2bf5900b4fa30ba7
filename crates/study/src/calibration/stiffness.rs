//! Stiffnesses of laws of different exponents that stand for the same contact.

use pounding_gap_element::contact_stiffness::{
    Approach, ContactStiffnessError, duration, penetration,
};

use super::reference_collision::{ReferenceCollision, crushed};

/// How the stiffness of a law follows from that of the gap's own. Laws of one exponent
/// have one stiffness; between exponents a reference collision decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StiffnessRule {
    /// The elastic laws penetrate equally deep in the reference collision.
    Penetration,
    /// The elastic laws stay in contact equally long in the reference collision.
    Duration,
}

impl StiffnessRule {
    /// Name in arguments and tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Penetration => "penetration",
            Self::Duration => "duration",
        }
    }
}

/// A stiffness for the exponent that is like the gap's own.
pub(super) fn stiffness(
    reference: &ReferenceCollision,
    rule: StiffnessRule,
    exponent: f64,
) -> Result<f64, String> {
    let crushed = crushed(reference).map_err(|e| e.to_string())?;
    if exponent == reference.exponent && crushed.is_none() {
        return Ok(reference.stiffness);
    }
    let approach = Approach {
        velocity: reference.approach_velocity,
        effective_mass: reference.effective_mass,
    };
    let depth = match &crushed {
        Some(outcome) => outcome.peak_penetration,
        None => elastic_penetration(reference),
    };
    let found = match (rule, &crushed) {
        (StiffnessRule::Penetration, _) => penetration(depth, exponent, approach, None, None),
        (StiffnessRule::Duration, Some(outcome)) => {
            duration(outcome.duration, exponent, approach, None)
        }
        (StiffnessRule::Duration, None) => {
            // The contact time is proportional to the penetration: that of any stiffness
            // of the law gives the factor.
            let time = duration_of(reference.exponent, depth, approach)?;
            duration(time, exponent, approach, None)
        }
    };
    found.map(|s| s.value).map_err(|e| e.to_string())
}

/// Maximum penetration (m) of the gap's own law without damping in the reference
/// collision: `(n + 1) m v^2 / (2 k)` is its power `n + 1`.
pub(super) fn elastic_penetration(reference: &ReferenceCollision) -> f64 {
    let n = reference.exponent;
    let energy = reference.effective_mass * reference.approach_velocity.powi(2);
    libm::pow(
        0.5 * (n + 1.0) * energy / reference.stiffness,
        1.0 / (n + 1.0),
    )
}

/// Contact time (s) of the elastic law of this exponent and penetration (m): the time for
/// which [`duration`] gives back the stiffness of that penetration.
fn duration_of(exponent: f64, depth: f64, approach: Approach) -> Result<f64, String> {
    let text = |e: ContactStiffnessError| e.to_string();
    let wanted = penetration(depth, exponent, approach, None, None).map_err(text)?;
    let trial = depth / approach.velocity;
    let other = duration(trial, exponent, approach, None).map_err(text)?;
    // k is proportional to T^-(n + 1) at one velocity.
    Ok(trial * libm::pow(other.value / wanted.value, 1.0 / (exponent + 1.0)))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use pounding_gap_element::{Bodies, ModelParameters, collide, registry};

    use super::*;

    fn reference(exponent: f64, stiffness: f64) -> ReferenceCollision {
        ReferenceCollision {
            approach_velocity: 0.6,
            of_other_gaps: false,
            effective_mass: 24_390.0,
            stiffness,
            exponent,
            restitution: 0.65,
            separation: None,
            own: None,
        }
    }

    /// Collisions of the elastic laws, integrated: equal depth and equal time.
    #[test]
    fn elastic_laws_alike() {
        let from = reference(1.5, 2.75e9);
        let bodies = Bodies {
            mass_left: from.effective_mass,
            mass_right: None,
            velocity_left: from.approach_velocity,
            velocity_right: 0.0,
        };
        let collision = |name: &str, stiffness: f64| {
            let parameters = ModelParameters::from_pairs(&[("stiffness", stiffness)]);
            collide(
                registry::build(name, &parameters).unwrap().as_ref(),
                &bodies,
            )
            .unwrap()
        };
        let hertz = collision("hertz_1882", from.stiffness);
        let deep = stiffness(&from, StiffnessRule::Penetration, 1.0).unwrap();
        let long = stiffness(&from, StiffnessRule::Duration, 1.0).unwrap();
        let (deep, long) = (
            collision("linear_elastic", deep),
            collision("linear_elastic", long),
        );
        assert!((deep.peak_penetration / hertz.peak_penetration - 1.0).abs() < 1.0e-8);
        assert!((long.duration / hertz.duration - 1.0).abs() < 1.0e-8);
        assert!(
            (deep.duration / hertz.duration - 1.0).abs() > 1.0e-2,
            "not both at once"
        );
        let same = stiffness(&from, StiffnessRule::Duration, 1.5).unwrap();
        assert_eq!(same, from.stiffness);
    }
}
