//! Non-linear viscoelastic law: Hertz spring, dashpot in approach only.

use crate::classes::DampingPhases;
use crate::classes::linear::{self, LinearClass};
use crate::descriptor::{Alias, ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::{DAMPING_RATIO, HERTZ_STIFFNESS, ModelParameters, RESTITUTION};
use std::f64::consts::PI;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "jankowski_2005",
    aliases: &[Alias {
        name: "jankowski_2006",
        citation: "Jankowski, Earthquake Engineering and Structural Dynamics 35 (2006) 517",
    }],
    title: "Non-linear viscoelastic",
    formula: "F = k delta^1.5 + c v (v > 0), k delta^1.5 (v <= 0);  c = 2 xi sqrt(k sqrt(delta) m),  xi = (9 sqrt5 / 2) (1 - e^2) / (e (e (9 pi - 16) + 16))",
    citation: "Jankowski, Earthquake Engineering and Structural Dynamics 34 (2005) 595; xi(e): 35 (2006) 517",
    class: "linear class, exponent 3/2, damping in approach only",
    parameters: &[HERTZ_STIFFNESS, RESTITUTION, DAMPING_RATIO],
    verification: Verification::Verified(
        "JankowskiImpact of OpenSees in pairs of one and three storeys, elastic and yielding: peaks to 3e-5 at its steps of 10 us, falling with them (pounding verify structures); closed form e = exp(-g(2 xi / sqrt5))",
    ),
    traps: &[
        "The papers were not read: formula and xi(e) are those that OpenSees documents.",
        "The relation of the 2006 paper returns slightly less than asked: 0.0933 for 0.1, 0.4946 for 0.5, 0.6470 for 0.65.",
        "The 2005 paper gives xi by numerical calibration: its often quoted damping_ratio = 0.35 for concrete returns 0.6618.",
        "The xi that returns exactly what is asked is in exact_linear_approach with exponent = 1.5; at e = 0.65 it is 0.3682 instead of 0.3728.",
        "The dashpot starts like delta^0.25: its tangent has no bound at closure.",
    ],
    build,
    ..linear::DESCRIPTOR
};

/// The relation of the 2006 paper.
fn damping_ratio(e: f64) -> f64 {
    4.5 * 5.0_f64.sqrt() * (1.0 - e * e) / (e * (e * (9.0 * PI - 16.0) + 16.0))
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    let xi = parameters.damping(&DESCRIPTOR, "damping_ratio", damping_ratio)?;
    Ok(Box::new(LinearClass {
        descriptor: &DESCRIPTOR,
        stiffness: parameters.get(&DESCRIPTOR, "stiffness")?,
        exponent: 1.5,
        // The papers' c = 2 xi sqrt(k m sqrt(delta)) in terms of the class.
        zeta: 2.0 * xi / 5.0_f64.sqrt(),
        phases: DampingPhases::ApproachOnly,
        separation: parameters.separation(&DESCRIPTOR),
    }))
}
