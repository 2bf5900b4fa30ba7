//! Modified linear viscoelastic law: the dashpot acts in approach only.

use crate::classes::DampingPhases;
use crate::classes::linear::{self, LinearClass};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;
use std::f64::consts::PI;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "mahmoud_jankowski_2011",
    title: "Modified linear viscoelastic",
    formula: "F = k delta + c v (v > 0), k delta (v <= 0);  c = 2 zeta sqrt(k m),  zeta = (1 - e^2) / (e (e (pi - 2) + 2))",
    citation: "Mahmoud and Jankowski, IJST Transactions C 35 (2011) 51, equations 6-7",
    class: "linear class, exponent 1, damping in approach only",
    verification: Verification::Verified("closed form e = exp(-g(zeta)) of approach-only damping"),
    traps: &[
        "Returns slightly more than asked: 0.2055 for 0.2, 0.6046 for 0.6, 0.6538 for 0.65.",
        "The force jumps to c v0 at closure, and for e below about 0.5 that jump is the peak.",
        "zeta grows to 4.68 at e = 0.1: explicit fixed steps need 2 zeta omega h < 2.78.",
    ],
    build,
    ..linear::LINEAR_DESCRIPTOR
};

/// Equation 7 of the paper.
fn damping_ratio(e: f64) -> f64 {
    (1.0 - e * e) / (e * (e * (PI - 2.0) + 2.0))
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    LinearClass::build(
        &DESCRIPTOR,
        parameters,
        DampingPhases::ApproachOnly,
        damping_ratio,
    )
}
