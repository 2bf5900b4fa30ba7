//! Herbert and McWhannell: an iterate of the energy balance.

use crate::classes::DampingPhases;
use crate::classes::hunt_crossley::{self, HuntCrossley};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::ImpactModel;
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "herbert_mcwhannell_1977",
    title: "Herbert-McWhannell",
    formula: "F = k delta^n (1 + y v / v0);  y = 6 (1 - e) / ((2 e - 1)^2 + 3)",
    citation: "Herbert and McWhannell, J. Engineering for Industry 99 (1977) 795",
    verification: Verification::SecondarySources(
        "relation as quoted in the literature, not read in the paper; behaviour verified against the closed form",
    ),
    traps: &[
        "Returns 0.6511 for 0.6 and 0.5936 for 0.5; never below 0.487.",
        "Pulls if the floors separate faster than v0 / y; no_tension cuts that.",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

/// Relation of the paper.
fn damping_factor(e: f64) -> f64 {
    6.0 * (1.0 - e) / ((2.0 * e - 1.0).powi(2) + 3.0)
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    HuntCrossley::build(&DESCRIPTOR, parameters, DampingPhases::Both, damping_factor)
}
