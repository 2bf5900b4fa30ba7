//! Deteriorating pinching law of Ibarra, Medina and Krawinkler.

use crate::descriptor::{LawDescriptor, Verification};
use crate::deteriorating::{self, PARAMETERS, Reloading};
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::parameters::LawParameters;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "ibarra_medina_krawinkler_2005_pinching",
    aliases: &[],
    title: "Deteriorating pinching law of Ibarra, Medina and Krawinkler",
    formula: "as the peak-oriented law, but reloading heads for kappa_f times the target's force up to (1 - kappa_d) times the maximum residual deformation, then for the target",
    citation: "Ibarra, Medina and Krawinkler, Earthquake Engineering and Structural Dynamics 34 (2005) 1489",
    parameters: &PARAMETERS,
    rate_dependent: false,
    link_alone: None,
    verification: Verification::SecondarySources(
        "the rules; paths computed by hand from them are checked",
    ),
    example: &[
        ("stiffness", 2.0e7),
        ("yield_force", 2.0e5),
        ("hardening_ratio", 0.05),
        ("capping_deformation", 0.03),
        ("softening_ratio", 0.1),
        ("residual_ratio", 0.2),
        ("strength_capacity", 80.0),
        ("capping_capacity", 80.0),
        ("unloading_capacity", 160.0),
        ("reloading_capacity", 80.0),
        ("pinching_force", 0.3),
        ("pinching_deformation", 0.4),
    ],
    example_amplitude: 0.06,
    traps: &[
        deteriorating::RETRACED,
        deteriorating::NO_STEEPER,
        deteriorating::WHAT_FALLS,
        deteriorating::ENERGY_SINCE,
        deteriorating::ENERGY_STEPS_BACK,
        deteriorating::FAILS_FOR_EVER,
        deteriorating::RESIDUAL_STAYS,
    ],
    build,
};

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let reloading = Reloading::Pinching {
        force: parameters.get(&DESCRIPTOR, "pinching_force")?,
        deformation: parameters.get(&DESCRIPTOR, "pinching_deformation")?,
    };
    deteriorating::build(&DESCRIPTOR, reloading, parameters)
}
