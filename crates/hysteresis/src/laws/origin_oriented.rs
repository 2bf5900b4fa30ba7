//! Unloading and reloading along the secant through the origin.

use crate::descriptor::{Alias, LawDescriptor, Verification};
use crate::error::HysteresisError;
use crate::history::{Branch, History, Point, Side};
use crate::law::HysteresisLaw;
use crate::parameters::{HARDENING_RATIO, LawParameters, STIFFNESS, YIELD_FORCE};
use crate::path::PathLaw;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "origin_oriented",
    aliases: &[Alias {
        name: "secant",
        citation: "what it does",
    }],
    title: "Origin-oriented law",
    formula: "bilinear backbone; below the farthest point of each side F = (Fm / xm) x",
    citation: "Umemura, Aoyama and Takizawa 1974, as in Otani, Journal of the Faculty of Engineering, University of Tokyo 36 (1981) 407",
    parameters: &[STIFFNESS, YIELD_FORCE, HARDENING_RATIO],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::SecondarySources(
        "the rules; closed form of the dissipation on first loading",
    ),
    example: &[
        ("stiffness", 2.0e7),
        ("yield_force", 2.0e5),
        ("hardening_ratio", 0.05),
    ],
    example_amplitude: 0.05,
    traps: &["Dissipates only where it reaches new ground: steady cycles cost nothing."],
    build,
};

const SECANT: u8 = 0;
const BACKBONE: u8 = 1;

#[derive(Debug)]
struct OriginOriented {
    stiffness: f64,
    yield_force: f64,
    hardening_ratio: f64,
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    Ok(Box::new(OriginOriented {
        stiffness: parameters.get(&DESCRIPTOR, "stiffness")?,
        yield_force: parameters.get(&DESCRIPTOR, "yield_force")?,
        hardening_ratio: parameters.get(&DESCRIPTOR, "hardening_ratio")?,
    }))
}

/// The line through the origin to the farthest point of a side. Where that of the other side is the same line, as before any
/// yielding, it goes on there: without a kink there is nothing to change at the origin, where an element at rest would not
/// know its side.
fn secant(history: &History, side: f64) -> Branch {
    let slope = |side: f64| {
        let peak = history.side(side).peak;
        peak.force / peak.deformation
    };
    let end = |side: f64| history.side(side).peak.deformation;
    let back = match slope(side) == slope(-side) {
        true => -end(-side),
        false => 0.0,
    };
    Branch::line(SECANT, side, Point::default(), slope(side)).between(back, end(side))
}

impl OriginOriented {
    /// The backbone of a side from its yield point on.
    fn backbone(&self, side: f64, from: f64) -> Branch {
        let slope = self.hardening_ratio * self.stiffness;
        let plastic = from - self.yield_force / self.stiffness;
        let start = Point {
            deformation: from,
            force: self.yield_force + slope * plastic,
        };
        Branch::line(BACKBONE, side, start.mirrored(side), slope).towards(side)
    }
}

impl PathLaw for OriginOriented {
    fn law_descriptor(&self) -> &'static LawDescriptor {
        &DESCRIPTOR
    }
    fn straight(&self) -> bool {
        true
    }
    fn stiffness_when_new(&self) -> f64 {
        self.stiffness
    }
    fn begin(&self) -> History {
        let peak = Point {
            deformation: self.yield_force / self.stiffness,
            force: self.yield_force,
        };
        let mut history = History::new(Branch::default());
        history.sides = [Side {
            peak,
            ..Side::default()
        }; 2];
        history.branch = secant(&history, 1.0);
        history
    }
    fn stored(&self, history: &History, deformation: f64) -> f64 {
        0.5 * history.branch.force(deformation) * deformation
    }
    fn turn(&self, history: &mut History, deformation: f64) {
        let side = history.branch.side;
        let force = history.branch.force(deformation);
        let peak = Point { deformation, force }.mirrored(side);
        history.side_mut(side).peak = peak;
        let work = self.work(history, deformation);
        // The secant begins at the origin; its work is counted from there.
        history.branch = secant(history, side);
        history.branch.work = work - 0.5 * peak.force * peak.deformation;
    }
    fn leave(&self, history: &mut History, end: f64) {
        let left = match end > 0.0 {
            true => history.branch.upper,
            false => history.branch.lower,
        };
        let next = match left == 0.0 {
            true => secant(history, end),
            false => self.backbone(end, history.side(end).peak.deformation),
        };
        self.switch(history, next);
    }
}
