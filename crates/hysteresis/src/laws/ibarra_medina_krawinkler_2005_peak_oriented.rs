//! Deteriorating peak-oriented law of Ibarra, Medina and Krawinkler.

use crate::descriptor::{Alias, LawDescriptor, ParameterDescriptor, Verification};
use crate::deteriorating::{self, PARAMETERS, Reloading};
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::parameters::LawParameters;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "ibarra_medina_krawinkler_2005_peak_oriented",
    aliases: &[Alias {
        name: "ibarra_medina_krawinkler_2005",
        citation: "the rule most used",
    }],
    title: "Deteriorating peak-oriented law of Ibarra, Medina and Krawinkler",
    formula: "envelope min(h + Ks x, Fref - Kc x), at least the residual force; unloading with Ku to zero force, reloading towards the target on the envelope; deterioration by (E / (gamma Fy xy - sum E))^c at zero force (strength, cap, target) and at turning points of loading (Ku)",
    citation: "Ibarra, Medina and Krawinkler, Earthquake Engineering and Structural Dynamics 34 (2005) 1489",
    parameters: &OWN,
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

/// The first of the family's parameters: this rule needs no more.
const OWN: [ParameterDescriptor; 11] = {
    let mut own = [PARAMETERS[0]; 11];
    let mut i = 0;
    while i < 11 {
        own[i] = PARAMETERS[i];
        i += 1;
    }
    own
};

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let reloading = Reloading::PeakOriented;
    deteriorating::build(&DESCRIPTOR, reloading, parameters)
}
