//! Papi and Toopchi-Nezhad: modified Kelvin-Voigt with the loss shared out between
//! approach and restitution.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{ModelDescriptor, ParameterDescriptor, ParameterUnit};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::{
    DAMPING_FACTOR, LINEAR_STIFFNESS, ModelParameters, RESTITUTION, optional_non_negative,
};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "papi_toopchi_2022",
    title: "Modified Kelvin-Voigt of Papi and Toopchi-Nezhad",
    formula: "F = k delta (1 + y v / v0);  y = (3/2) (1 - e^2) / (alpha + e^2),  alpha = e + 0.1 (e < 0.8), 1 (e >= 0.8)",
    citation: "Papi and Toopchi-Nezhad, Amirkabir J. Civil Engineering 54(9) (2022) 709 and 3497, equations 30-36 and table 1",
    parameters: &[LINEAR_STIFFNESS, RESTITUTION, DAMPING_FACTOR, ALPHA],
    traps: &[
        "In a free collision it returns 0.5211 for 0.5, 0.6182 for 0.6, 0.6664 for 0.65, 0.8194 for 0.8: alpha = e + 0.1 was tuned in a drop test with gravity, on a grid of 0.1.",
        "The alpha that is exact in a free collision is 0.5352 at e = 0.5 and 0.6247 at 0.6; `pounding impact calibrate` finds it, and alpha for a drop test.",
        "The paper prints alpha = e + 1 in its equations; its table 1 has e + 0.1, and with e + 1 the mean error is 84 %.",
        "Its discontinuity: alpha jumps from 0.9 to 1 at e = 0.8.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::LINEAR_DESCRIPTOR
};

/// The paper's ratio of the losses, instead of its own rule.
const ALPHA: ParameterDescriptor = optional_non_negative(
    "alpha",
    ParameterUnit::One,
    "Energy lost in restitution over energy lost in approach, instead of the paper's rule",
);

/// Table 1 of the paper.
pub(crate) fn published_alpha(e: f64) -> f64 {
    if e < 0.8 { e + 0.1 } else { 1.0 }
}

/// Equation 30 of the paper; alpha = e is Ye and Li 2009, alpha = 0 Pant 2010.
pub(crate) fn damping_factor(e: f64, alpha: f64) -> f64 {
    1.5 * (1.0 - e * e) / (alpha + e * e)
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    let alpha = parameters.given("alpha");
    if alpha.is_some() && parameters.given("damping_factor").is_some() {
        return Err(GapElementError::Conflict {
            model: DESCRIPTOR.name,
            first: "alpha",
            second: "damping_factor",
        });
    }
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, |e| {
        damping_factor(e, alpha.unwrap_or_else(|| published_alpha(e)))
    })
}
