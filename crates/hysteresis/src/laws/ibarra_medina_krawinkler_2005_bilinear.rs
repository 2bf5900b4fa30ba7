//! Deteriorating bilinear law of Ibarra, Medina and Krawinkler.

use crate::descriptor::{LawDescriptor, ParameterDescriptor, Verification};
use crate::deteriorating::{self, PARAMETERS, Reloading};
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::parameters::LawParameters;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "ibarra_medina_krawinkler_2005_bilinear",
    aliases: &[],
    title: "Deteriorating bilinear law of Ibarra, Medina and Krawinkler",
    formula: "envelope min(h + Ks x, Fref - Kc x), at least the residual force; elastic with Ku between the envelopes of both sides; deterioration by (E / (gamma Fy xy - sum E))^c at zero force (strength, cap) and at turning points of the envelope (Ku)",
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
    ],
    example_amplitude: 0.06,
    traps: &[
        "After a turning point beyond the cap the side never exceeds the force reached there, so that returning does not raise its strength.",
        deteriorating::WHAT_FALLS,
        deteriorating::ENERGY_SINCE,
        deteriorating::ENERGY_STEPS_BACK,
        deteriorating::FAILS_FOR_EVER,
        deteriorating::RESIDUAL_STAYS,
    ],
    build,
};

/// The first of the family's parameters: this rule needs no more.
const OWN: [ParameterDescriptor; 10] = {
    let mut own = [PARAMETERS[0]; 10];
    let mut i = 0;
    while i < 10 {
        own[i] = PARAMETERS[i];
        i += 1;
    }
    own
};

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let reloading = Reloading::Bilinear;
    deteriorating::build(&DESCRIPTOR, reloading, parameters)
}
