//! Segalman's four-parameter Iwan model of a bolted joint.

use super::iwan_six_parameter::law;
use crate::descriptor::{LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::iwan::IwanDensity;
use crate::law::HysteresisLaw;
use crate::parameters::{LawParameters, non_negative, positive};

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "segalman_2005",
    aliases: &[],
    title: "Four-parameter Iwan model of Segalman",
    formula: "rho(phi) = R phi^chi on [0, phi_max] + S delta(phi - phi_max); phi_max = F_S (1+beta) / (K_T (beta + (chi+1)/(chi+2)))",
    citation: "Segalman, Journal of Applied Mechanics 72 (2005) 752",
    parameters: &[
        positive(
            "slip_force",
            ParameterUnit::Newton,
            "Force F_S at which the whole joint slips",
        ),
        positive(
            "stiffness",
            ParameterUnit::NewtonPerMetre,
            "Initial stiffness K_T",
        ),
        positive(
            "chi",
            ParameterUnit::One,
            "Exponent of the density; small cycles dissipate like the amplitude to the power chi + 3",
        )
        .within((-1.0, false), (0.0, true)),
        non_negative(
            "beta",
            ParameterUnit::One,
            "Stiffness of the sliders at phi_max over that of all others",
        ),
    ],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::Verified(
        "conversion back to F_S, K_T and beta; closed form against quadrature; fitted slope of small cycles",
    ),
    example: &[
        ("slip_force", 4000.0),
        ("stiffness", 1.5e7),
        ("chi", -0.5),
        ("beta", 0.3),
    ],
    example_amplitude: 1.0e-3,
    traps: &["No stiffness once the whole joint slips."],
    build,
};

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(&DESCRIPTOR, name);
    let density = IwanDensity::segalman(
        get("slip_force")?,
        get("stiffness")?,
        get("chi")?,
        get("beta")?,
    )?;
    Ok(law(&DESCRIPTOR, density))
}
