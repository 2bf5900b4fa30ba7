//! The bilinear Takeda law of Otani and Litton.

use crate::descriptor::{Alias, LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::parameters::{HARDENING_RATIO, LawParameters, STIFFNESS, YIELD_FORCE, non_negative};
use crate::stiffness_degrading::StiffnessDegrading;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "takeda",
    aliases: &[Alias {
        name: "modified_takeda",
        citation: "common name of the bilinear form",
    }],
    title: "Modified Takeda law",
    formula: "bilinear backbone; unloading with k (xy / xm)^a, retraced if it turns before zero force; reloading aims at xm - b (xm - xy) on the backbone of its side",
    citation: "Takeda, Sozen and Nielsen, Journal of the Structural Division 96 (1970) 2557; Otani, Journal of the Structural Division 100 (1974) 1433; Litton, dissertation, University of California, Berkeley (1975)",
    parameters: &[
        STIFFNESS,
        YIELD_FORCE,
        HARDENING_RATIO,
        non_negative(
            "unloading_exponent",
            ParameterUnit::One,
            "Exponent a by which the unloading stiffness falls with the ductility",
        )
        .within((0.0, true), (1.0, true))
        .default_to(0.5),
        non_negative(
            "reloading_factor",
            ParameterUnit::One,
            "Share b of the plastic deformation by which reloading meets the backbone before the farthest point",
        )
        .within((0.0, true), (1.0, false))
        .default_to(0.0),
    ],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::SecondarySources(
        "the rules; paths computed by hand from them are checked",
    ),
    example: &[
        ("stiffness", 2.0e7),
        ("yield_force", 2.0e5),
        ("hardening_ratio", 0.05),
        ("unloading_exponent", 0.4),
        ("reloading_factor", 0.3),
    ],
    example_amplitude: 0.05,
    traps: &[
        "The bilinear form without cracking: take the stiffness of the cracked section.",
        "Where the target of a small loop lies behind it, or asks for more than the unloading stiffness of the side that is loaded, reloading goes with that stiffness to the backbone: the sources leave this case open.",
        "The unloading stiffness never falls below the secant to the farthest point.",
    ],
    build,
};

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(&DESCRIPTOR, name);
    Ok(Box::new(StiffnessDegrading {
        descriptor: &DESCRIPTOR,
        stiffness: get("stiffness")?,
        yield_force: get("yield_force")?,
        hardening_ratio: get("hardening_ratio")?,
        unloading_exponent: get("unloading_exponent")?,
        reloading_factor: get("reloading_factor")?,
        retraces: true,
    }))
}
