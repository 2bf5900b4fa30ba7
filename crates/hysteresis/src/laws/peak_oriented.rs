//! Clough and Johnston's law: reloading aims at the farthest point reached before.

use crate::descriptor::{Alias, LawDescriptor, Verification};
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::parameters::{HARDENING_RATIO, LawParameters, STIFFNESS, YIELD_FORCE};
use crate::stiffness_degrading::StiffnessDegrading;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "peak_oriented",
    aliases: &[Alias {
        name: "clough_johnston_1966",
        citation: "Clough and Johnston, Proceedings of the Second Japan Earthquake Engineering Symposium (1966) 227",
    }],
    title: "Peak-oriented law of Clough and Johnston",
    formula: "bilinear backbone; unloading with k; whatever reloads aims at the farthest point of its side",
    citation: "Clough and Johnston, Proceedings of the Second Japan Earthquake Engineering Symposium (1966) 227",
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
    traps: &[
        "A small unloading inside a reloading branch is not retraced: it heads for the peak with less stiffness, which modified_clough corrects.",
        "A side that never yielded has its yield point as the peak.",
    ],
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
        retraces: false,
    }))
}
