//! Elastic, then yielding at constant force.

use super::bilinear::Bilinear;
use crate::descriptor::{Alias, LawDescriptor, Verification};
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::parameters::{LawParameters, STIFFNESS, YIELD_FORCE};

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "elastic_perfectly_plastic",
    aliases: &[Alias {
        name: "elastoplastic",
        citation: "common name",
    }],
    title: "Elastic, perfectly plastic",
    formula: "slope k inside -Fy < F < Fy, F = +-Fy while yielding",
    citation: "Prandtl, Zeitschrift fuer Angewandte Mathematik und Mechanik 8 (1928) 85",
    parameters: &[STIFFNESS, YIELD_FORCE],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::Verified("closed forms of force and cycle dissipation"),
    example: &[("stiffness", 2.0e7), ("yield_force", 2.0e5)],
    example_amplitude: 0.05,
    traps: &["No stiffness while it yields: a chain of storeys may drift without bound."],
    build,
};

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    Ok(Box::new(Bilinear::new(
        &DESCRIPTOR,
        parameters.get(&DESCRIPTOR, "stiffness")?,
        parameters.get(&DESCRIPTOR, "yield_force")?,
        0.0,
    )))
}
