//! Dry friction that sticks with a stated stiffness.

use super::bilinear::Bilinear;
use crate::descriptor::{Alias, LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::parameters::{LawParameters, positive};

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "coulomb_friction",
    aliases: &[Alias {
        name: "jenkins_1962",
        citation: "Jenkins: a spring and a slider in series",
    }],
    title: "Coulomb friction with elastic sticking",
    formula: "sticks with the slope ks until |F| = Ff, then slips at +-Ff until the motion turns",
    citation: "Coulomb 1785; the elastic stick is the element of Jenkins (1962)",
    parameters: &[
        positive(
            "friction_force",
            ParameterUnit::Newton,
            "Force while slipping",
        ),
        positive(
            "sticking_stiffness",
            ParameterUnit::NewtonPerMetre,
            "Stiffness before slip: that of what the slider is fixed to",
        ),
    ],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::Verified("closed forms of force and cycle dissipation"),
    example: &[("friction_force", 5.0e4), ("sticking_stiffness", 5.0e8)],
    example_amplitude: 0.01,
    traps: &[
        "Not rigid before slip: a stiffness far above that of the structure costs an implicit method nothing but makes explicit steps small.",
        "The same force sticking and slipping: no drop at the onset of slip.",
    ],
    build,
};

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    Ok(Box::new(Bilinear::new(
        &DESCRIPTOR,
        parameters.get(&DESCRIPTOR, "sticking_stiffness")?,
        parameters.get(&DESCRIPTOR, "friction_force")?,
        0.0,
    )))
}
