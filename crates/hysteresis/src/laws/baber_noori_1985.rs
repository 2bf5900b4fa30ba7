//! Bouc-Wen with the degradation and pinching of Baber and Noori.

use super::bouc_wen::{BETA, EXPONENT, GAMMA};
use crate::bouc_wen_family::{BoucWen, Degradation};
use crate::descriptor::{Alias, LawDescriptor, ParameterDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::parameters::{
    HARDENING_RATIO, LawParameters, STIFFNESS, YIELD_FORCE, non_negative, positive,
};

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "baber_noori_1985",
    aliases: &[Alias {
        name: "bouc_wen_baber_noori",
        citation: "common name",
    }],
    title: "Bouc-Wen-Baber-Noori with degradation and pinching",
    formula: "F = a k x + (1-a) Fy zeta;  xy dzeta/dt = h (v - nu (beta |v| |zeta|^(n-1) zeta + gamma v |zeta|^n)) / eta;  nu = 1 + dnu e, eta = 1 + deta e, e = int zeta dx / xy;  h = 1 - z1 exp(-(zeta sgn v - q zu)^2 / z2^2), z1 = zs (1 - exp(-p e)), z2 = (psi + dpsi e)(lambda + z1), zu = (nu (beta + gamma))^(-1/n)",
    citation: "Baber and Wen, Journal of the Engineering Mechanics Division 107 (1981) 1069: degradation; Baber and Noori, Journal of Engineering Mechanics 111 (1985) 1010: pinching; the function h as in Foliente, Journal of Structural Engineering 121 (1995) 1013",
    parameters: &[
        STIFFNESS,
        YIELD_FORCE,
        HARDENING_RATIO,
        EXPONENT,
        BETA,
        GAMMA,
        rate(
            "strength_degradation",
            "Rate dnu at which strength falls with the work e",
        ),
        rate(
            "stiffness_degradation",
            "Rate deta at which stiffness falls with the work e",
        ),
        rate("pinching", "Maximum pinching zs; zero for none").within((0.0, true), (1.0, false)),
        rate(
            "pinching_rate",
            "Rate p at which pinching grows with the work e",
        )
        .default_to(1.0),
        rate(
            "pinching_position",
            "Position q of the pinch as a share of the maximum force",
        )
        .within((0.0, true), (1.0, false))
        .default_to(0.1),
        positive(
            "pinching_spread",
            ParameterUnit::One,
            "Spread psi of the pinch",
        )
        .default_to(0.2),
        rate(
            "pinching_spread_rate",
            "Rate dpsi at which the spread grows with the work e",
        ),
        positive(
            "pinching_coupling",
            ParameterUnit::One,
            "Coupling lambda of the spread with the amount of pinching",
        )
        .default_to(0.5),
    ],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::SecondarySources(
        "the equations; solved independently to 1e-12; equals bouc_wen without degradation",
    ),
    example: &[
        ("stiffness", 2.0e7),
        ("yield_force", 2.0e5),
        ("hardening_ratio", 0.05),
        ("exponent", 1.5),
        ("strength_degradation", 0.005),
        ("stiffness_degradation", 0.02),
        ("pinching", 0.9),
        ("pinching_rate", 0.3),
    ],
    example_amplitude: 0.05,
    traps: &[
        "e grows with the number of yield deformations run through: rates calibrated with another measure of work must be converted.",
        "Stiffness that fades raises what counts as stored; the dissipated energy then steps back a little.",
    ],
    build,
};

const fn rate(name: &'static str, explanation: &'static str) -> ParameterDescriptor {
    non_negative(name, ParameterUnit::One, explanation).default_to(0.0)
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(&DESCRIPTOR, name);
    let degradation = Degradation {
        strength: get("strength_degradation")?,
        stiffness: get("stiffness_degradation")?,
        pinching: get("pinching")?,
        pinching_rate: get("pinching_rate")?,
        pinching_position: get("pinching_position")?,
        pinching_spread: get("pinching_spread")?,
        pinching_spread_rate: get("pinching_spread_rate")?,
        pinching_coupling: get("pinching_coupling")?,
    };
    Ok(Box::new(BoucWen::from_parameters(
        &DESCRIPTOR,
        parameters,
        degradation,
    )?))
}
