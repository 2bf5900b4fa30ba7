//! The smooth law of Bouc and Wen.

use crate::bouc_wen_family::{BoucWen, Degradation};
use crate::descriptor::{Alias, LawDescriptor, ParameterDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::parameters::{
    HARDENING_RATIO, LawParameters, STIFFNESS, YIELD_FORCE, non_negative, positive,
};

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "bouc_wen",
    aliases: &[Alias {
        name: "wen_1976",
        citation: "Wen, Journal of the Engineering Mechanics Division 102 (1976) 249",
    }],
    title: "Bouc-Wen",
    formula: "F = a k x + (1-a) Fy zeta;  xy dzeta/dt = v - beta |v| |zeta|^(n-1) zeta - gamma v |zeta|^n,  xy = Fy / k",
    citation: "Bouc, Proceedings of the Fourth Conference on Nonlinear Oscillation, Prague (1967) 315; Wen, Journal of the Engineering Mechanics Division 102 (1976) 249",
    parameters: &[
        STIFFNESS,
        YIELD_FORCE,
        HARDENING_RATIO,
        EXPONENT,
        BETA,
        GAMMA,
    ],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::Verified("its differential equation solved independently to 1e-12"),
    example: &[
        ("stiffness", 2.0e7),
        ("yield_force", 2.0e5),
        ("hardening_ratio", 0.05),
        ("exponent", 2.0),
    ],
    example_amplitude: 0.05,
    traps: &[
        "The maximum force of the hysteretic part is Fy (beta + gamma)^(-1/n): Fy itself only for beta + gamma = 1.",
        "Stored is a k x^2 / 2 + (1-a) Fy xy zeta^2 / 2; what the work of the force exceeds it by is dissipated.",
        "Small loops within larger ones drift and are not closed (Drucker's postulate is violated).",
    ],
    build,
};

/// Sharpness of the transition.
pub(super) const EXPONENT: ParameterDescriptor = positive(
    "exponent",
    ParameterUnit::One,
    "Exponent n, 1 or more: the greater, the sharper the knee",
)
.within((1.0, true), (100.0, true))
.default_to(2.0);

/// Part of the bend that changes with the direction of motion.
pub(super) const BETA: ParameterDescriptor = positive(
    "beta",
    ParameterUnit::One,
    "Shape factor beta without dimension",
)
.default_to(0.5);

/// Part of the bend that does not.
pub(super) const GAMMA: ParameterDescriptor = non_negative(
    "gamma",
    ParameterUnit::One,
    "Shape factor gamma without dimension, in (-beta, beta]",
)
.within((f64::NEG_INFINITY, false), (f64::INFINITY, false))
.default_to(0.5);

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    Ok(Box::new(BoucWen::from_parameters(
        &DESCRIPTOR,
        parameters,
        Degradation::default(),
    )?))
}
