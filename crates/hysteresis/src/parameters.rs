//! Parameters of a law as a user gives them, and those that several laws have.

pub use pounding_catalogue::Parameters as LawParameters;
use pounding_catalogue::{ParameterDescriptor, ParameterUnit};
pub(crate) use pounding_catalogue::{non_negative, optional_positive, positive};

use crate::descriptor::LawDescriptor;

/// Deformation (m) at which an element of initial stiffness `stiffness` (N/m) begins to yield or
/// slip from rest in either direction: its yield displacement, or its yield or friction force over that stiffness. `None` for
/// a law without one of them, and for bumpers, which a gap parts from what they act on.
#[must_use]
pub fn yield_deformation(
    law: &LawDescriptor,
    parameters: &LawParameters,
    stiffness: f64,
) -> Option<f64> {
    if law
        .parameters
        .iter()
        .any(|parameter| parameter.name == "gap")
    {
        return None;
    }
    let force = ["yield_force", "friction_force"]
        .iter()
        .find_map(|name| parameters.given(name));
    let displacement = parameters.given("yield_displacement");
    displacement
        .or(force.map(|force| force / stiffness))
        .filter(|x| x.is_finite() && *x > 0.0)
}

/// Elastic stiffness.
pub(crate) const STIFFNESS: ParameterDescriptor = positive(
    "stiffness",
    ParameterUnit::NewtonPerMetre,
    "Stiffness before yield",
);

/// Yield force.
pub(crate) const YIELD_FORCE: ParameterDescriptor = positive(
    "yield_force",
    ParameterUnit::Newton,
    "Force at which the element yields",
);

/// Ratio of the stiffness after yield, not negative.
pub(crate) const HARDENING_RATIO: ParameterDescriptor = non_negative(
    "hardening_ratio",
    ParameterUnit::One,
    "Stiffness after yield over stiffness before; a falling backbone would reach zero force, which this law cannot follow",
)
.within((0.0, true), (1.0, false))
.default_to(0.0);

#[cfg(test)]
mod tests {
    use super::*;

    /// A bumper yields on the side on which it acts, behind its gap; a bilinear element of the same numbers at 4e5 / 5e7 m on
    /// both.
    #[test]
    fn bumpers_yield_from_rest_nowhere() {
        let numbers = [("stiffness", 5.0e7), ("yield_force", 4.0e5)];
        let parameters = LawParameters::from_pairs(&numbers);
        let of = |name| yield_deformation(crate::find(name).unwrap(), &parameters, 5.0e7);
        assert_eq!(of("elastoplastic_gap"), None);
        assert_eq!(of("bilinear"), Some(8.0e-3));
    }
}
