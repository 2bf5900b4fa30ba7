//! Pant, Wijeyewickrema and Ohmachi: modified Kelvin-Voigt, damped in approach only.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{Alias, ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "pant_2010",
    aliases: &[Alias {
        name: "pant_2012",
        citation: "Pant and Wijeyewickrema, Earthquake Engineering and Structural Dynamics 41 (2012) 1709",
    }],
    title: "Modified Kelvin-Voigt of Pant",
    formula: "F = k delta (1 + y v / v0) (v > 0), k delta (v <= 0);  y = (3/2) (1 - e^2) / e^2",
    citation: "Pant, Wijeyewickrema and Ohmachi (2010); Pant and Wijeyewickrema, Earthquake Engineering and Structural Dynamics 41 (2012) 1709",
    class: "Hunt-Crossley class, exponent 1, damping in approach only",
    separation_rules: &[crate::model::SeparationRule::ZeroPenetration],
    verification: Verification::SecondarySources(
        "relation as quoted in the literature; behaviour verified against the closed form e = sqrt(2 (y - ln(1 + y))) / y",
    ),
    traps: &[
        "Returns a little more than asked: 0.5254 for 0.5, 0.6201 for 0.6, 0.6670 for 0.65.",
        "With damping in both phases, as some programs have it, the same factor is far too strong.",
    ],
    build,
    ..hunt_crossley::LINEAR_DESCRIPTOR
};

/// All the loss taken in approach, on the undamped trajectory.
pub(super) fn damping_factor(e: f64) -> f64 {
    1.5 * (1.0 - e * e) / (e * e)
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(
        &DESCRIPTOR,
        parameters,
        DampingPhases::ApproachOnly,
        damping_factor,
    )
}
