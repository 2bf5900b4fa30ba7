//! Mahin and Bertero's correction of the Clough law.

use crate::descriptor::{Alias, LawDescriptor, Verification};
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::parameters::{HARDENING_RATIO, LawParameters, STIFFNESS, YIELD_FORCE};
use crate::stiffness_degrading::StiffnessDegrading;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "modified_clough",
    aliases: &[Alias {
        name: "mahin_bertero_1976",
        citation: "Mahin and Bertero, Journal of the Structural Division 102 (1976)",
    }],
    title: "Modified Clough law of Mahin and Bertero",
    formula: "bilinear backbone; unloading with k, retraced if it turns before zero force; reloading aims at the farthest point of its side",
    citation: "Mahin and Bertero, Journal of the Structural Division 102 (1976), after Clough and Johnston 1966",
    parameters: &[STIFFNESS, YIELD_FORCE, HARDENING_RATIO],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::SecondarySources(
        "the rules; paths computed by hand from them are checked",
    ),
    example: &[
        ("stiffness", 2.0e7),
        ("yield_force", 2.0e5),
        ("hardening_ratio", 0.05),
    ],
    example_amplitude: 0.05,
    traps: &["A side that never yielded has its yield point as the peak."],
    build,
};

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    Ok(Box::new(StiffnessDegrading {
        descriptor: &DESCRIPTOR,
        stiffness: parameters.get(&DESCRIPTOR, "stiffness")?,
        yield_force: parameters.get(&DESCRIPTOR, "yield_force")?,
        hardening_ratio: parameters.get(&DESCRIPTOR, "hardening_ratio")?,
        unloading_exponent: 0.0,
        reloading_factor: 0.0,
        retraces: true,
    }))
}
