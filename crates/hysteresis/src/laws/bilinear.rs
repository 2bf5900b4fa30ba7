//! Bilinear law with kinematic hardening.

use crate::descriptor::{Alias, LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::history::{Branch, History, Point};
use crate::law::HysteresisLaw;
use crate::parameters::{LawParameters, STIFFNESS, YIELD_FORCE, non_negative};
use crate::path::PathLaw;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "bilinear",
    aliases: &[Alias {
        name: "bilinear_kinematic",
        citation: "what it does",
    }],
    title: "Bilinear with kinematic hardening",
    formula: "elastic k inside r k x - (1-r) Fy < F < r k x + (1-r) Fy, slope r k on those lines",
    citation: "Prager, Journal of Applied Mechanics 23 (1956) 493: kinematic hardening, in one dimension",
    parameters: &[
        STIFFNESS,
        YIELD_FORCE,
        non_negative(
            "hardening_ratio",
            ParameterUnit::One,
            "Stiffness r after yield over stiffness before, above -1: a fall steeper than the elastic stiffness has no stable answer in series with the element's own elasticity",
        )
        .within((-1.0, false), (1.0, false))
        .default_to(0.0),
    ],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::Verified(
        "closed forms of force and cycle dissipation; sliders in parallel",
    ),
    example: &[
        ("stiffness", 2.0e7),
        ("yield_force", 2.0e5),
        ("hardening_ratio", 0.05),
    ],
    example_amplitude: 0.05,
    traps: &[
        "With negative hardening the force falls to zero and changes its sign at large deformation; the stored energy can then be negative.",
    ],
    build,
};

const ELASTIC: u8 = 0;
const PLASTIC: u8 = 1;

/// An elastic-plastic element and a spring in parallel.
#[derive(Debug)]
pub(super) struct Bilinear {
    descriptor: &'static LawDescriptor,
    stiffness: f64,
    yield_force: f64,
    hardening_ratio: f64,
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    Ok(Box::new(Bilinear::new(
        &DESCRIPTOR,
        parameters.get(&DESCRIPTOR, "stiffness")?,
        parameters.get(&DESCRIPTOR, "yield_force")?,
        parameters.get(&DESCRIPTOR, "hardening_ratio")?,
    )))
}

impl Bilinear {
    /// Stiffness (N/m), yield force (N) and hardening ratio.
    pub(super) fn new(
        descriptor: &'static LawDescriptor,
        stiffness: f64,
        yield_force: f64,
        hardening_ratio: f64,
    ) -> Self {
        Self {
            descriptor,
            stiffness,
            yield_force,
            hardening_ratio,
        }
    }

    fn yield_deformation(&self) -> f64 {
        self.yield_force / self.stiffness
    }

    /// The line along which the element yields towards this side.
    fn plastic(&self, side: f64, deformation: f64) -> Branch {
        let slope = self.hardening_ratio * self.stiffness;
        let force = side * (1.0 - self.hardening_ratio) * self.yield_force + slope * deformation;
        Branch::line(PLASTIC, side, Point { deformation, force }, slope).towards(side)
    }
}

impl PathLaw for Bilinear {
    fn law_descriptor(&self) -> &'static LawDescriptor {
        self.descriptor
    }
    fn straight(&self) -> bool {
        true
    }
    fn stiffness_when_new(&self) -> f64 {
        self.stiffness
    }
    fn begin(&self) -> History {
        let range = self.yield_deformation();
        let line = Branch::line(ELASTIC, 1.0, Point::default(), self.stiffness);
        History::new(line.between(-range, range))
    }
    fn stored(&self, history: &History, deformation: f64) -> f64 {
        let hardening = self.hardening_ratio * self.stiffness;
        let sliding = history.branch.force(deformation) - hardening * deformation;
        0.5 * (hardening * deformation * deformation
            + sliding * sliding / (self.stiffness - hardening))
    }
    fn turn(&self, history: &mut History, deformation: f64) {
        let (force, _) = self.on_branch(history, deformation);
        let side = history.branch.side;
        let front = side * deformation;
        let line = Branch::line(ELASTIC, side, Point { deformation, force }, self.stiffness);
        self.switch(
            history,
            line.between(front - 2.0 * self.yield_deformation(), front),
        );
    }
    fn leave(&self, history: &mut History, end: f64) {
        let at = if end > 0.0 {
            history.branch.upper
        } else {
            history.branch.lower
        };
        self.switch(history, self.plastic(end, at));
    }
}
