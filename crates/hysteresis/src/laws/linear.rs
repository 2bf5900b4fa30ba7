//! A linear spring.

use crate::descriptor::{Alias, LawDescriptor, Verification};
use crate::error::HysteresisError;
use crate::history::{Branch, History, Point};
use crate::law::HysteresisLaw;
use crate::parameters::{LawParameters, STIFFNESS};
use crate::path::PathLaw;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "linear",
    aliases: &[Alias {
        name: "elastic",
        citation: "common name",
    }],
    title: "Linear spring",
    formula: "F = k x",
    citation: "Hooke 1678",
    parameters: &[STIFFNESS],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::Verified("closed form"),
    example: &[("stiffness", 2.0e7)],
    example_amplitude: 0.02,
    traps: &[],
    build,
};

#[derive(Debug)]
struct Linear {
    stiffness: f64,
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    Ok(Box::new(Linear {
        stiffness: parameters.get(&DESCRIPTOR, "stiffness")?,
    }))
}

impl PathLaw for Linear {
    fn law_descriptor(&self) -> &'static LawDescriptor {
        &DESCRIPTOR
    }
    fn linear(&self) -> bool {
        true
    }
    fn straight(&self) -> bool {
        true
    }
    fn stiffness_when_new(&self) -> f64 {
        self.stiffness
    }
    fn begin(&self) -> History {
        History::new(Branch::line(0, 1.0, Point::default(), self.stiffness))
    }
    fn stored(&self, _: &History, deformation: f64) -> f64 {
        0.5 * self.stiffness * deformation * deformation
    }
    fn dissipated(&self, _: &History, _: f64) -> f64 {
        0.0
    }
    fn turn(&self, _: &mut History, _: f64) {}
    fn leave(&self, _: &mut History, _: f64) {}
}
