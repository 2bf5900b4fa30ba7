//! A bumper that closes, yields and leaves a wider gap behind.

use crate::descriptor::{Alias, LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::history::{Branch, History, Point};
use crate::law::HysteresisLaw;
use crate::parameters::{HARDENING_RATIO, LawParameters, STIFFNESS, YIELD_FORCE, non_negative};
use crate::path::PathLaw;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "elastoplastic_gap",
    aliases: &[Alias {
        name: "yielding_bumper",
        citation: "what it is",
    }],
    title: "Yielding bumper behind a gap",
    formula: "F = 0 while s = -x < g; then bilinear in s - g with stiffness k, yield force Fy, hardening r k; no tension: what yielded widens g",
    citation: "closed form; a positive deformation is an extension, the bumper closes on shortening and its force is negative",
    parameters: &[
        STIFFNESS,
        YIELD_FORCE,
        HARDENING_RATIO,
        non_negative(
            "gap",
            ParameterUnit::Metre,
            "Shortening at which the new bumper closes",
        )
        .default_to(0.0),
    ],
    rate_dependent: false,
    link_alone: Some("it acts on shortening alone"),
    verification: Verification::Verified("closed form of force and dissipation"),
    example: &[
        ("stiffness", 5.0e7),
        ("yield_force", 4.0e5),
        ("hardening_ratio", 0.02),
        ("gap", 0.01),
    ],
    example_amplitude: 0.05,
    traps: &["The widened gap does not recover."],
    build,
};

const OPEN: u8 = 0;
const CLOSED: u8 = 1;
const YIELDING: u8 = 2;

/// The side on which the bumper acts.
const SHORTENING: f64 = -1.0;

#[derive(Debug)]
struct ElastoplasticGap {
    stiffness: f64,
    yield_force: f64,
    hardening_ratio: f64,
    gap: f64,
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(&DESCRIPTOR, name);
    Ok(Box::new(ElastoplasticGap {
        stiffness: get("stiffness")?,
        yield_force: get("yield_force")?,
        hardening_ratio: get("hardening_ratio")?,
        gap: get("gap")?,
    }))
}

impl ElastoplasticGap {
    fn yield_line(&self, shortening: f64) -> f64 {
        let plastic = shortening - self.gap - self.yield_force / self.stiffness;
        self.yield_force + self.hardening_ratio * self.stiffness * plastic
    }

    /// The elastic line from `gap` to where it meets the yield line.
    fn closed(&self, gap: f64) -> Branch {
        let hardening = self.hardening_ratio * self.stiffness;
        let reach = self.yield_line(gap) / (self.stiffness - hardening);
        let start = Point {
            deformation: gap,
            force: 0.0,
        };
        Branch::line(
            CLOSED,
            SHORTENING,
            start.mirrored(SHORTENING),
            self.stiffness,
        )
        .between(gap, gap + reach)
    }

    fn open(&self, gap: f64) -> Branch {
        let start = Point {
            deformation: -gap,
            force: 0.0,
        };
        Branch::line(OPEN, SHORTENING, start, 0.0).between(f64::NEG_INFINITY, gap)
    }
}

impl PathLaw for ElastoplasticGap {
    fn law_descriptor(&self) -> &'static LawDescriptor {
        &DESCRIPTOR
    }
    fn straight(&self) -> bool {
        true
    }
    fn opens(&self) -> bool {
        true
    }
    fn stiffness_when_new(&self) -> f64 {
        if self.gap == 0.0 { self.stiffness } else { 0.0 }
    }
    fn steepest(&self) -> f64 {
        self.stiffness
    }
    fn begin(&self) -> History {
        let mut branch = self.open(self.gap);
        branch.start = Point::default();
        History::new(branch)
    }
    fn stored(&self, history: &History, deformation: f64) -> f64 {
        let force = history.branch.force(deformation);
        0.5 * force * force / self.stiffness
    }
    fn turn(&self, history: &mut History, deformation: f64) {
        let force = -history.branch.force(deformation);
        let gap = -deformation - force / self.stiffness;
        let work = self.work(history, deformation);
        // The elastic line begins at the gap; its work is counted from there.
        history.branch = self.closed(gap);
        history.branch.work = work - 0.5 * force * force / self.stiffness;
    }
    fn leave(&self, history: &mut History, end: f64) {
        let branch = history.branch;
        let gap = -branch.start.deformation;
        let next = match (branch.kind, end == SHORTENING) {
            (OPEN, _) => self.closed(-branch.lower),
            (CLOSED, false) => self.open(gap),
            _ => {
                let start = Point {
                    deformation: -branch.lower,
                    force: self.yield_line(-branch.lower),
                };
                let slope = self.hardening_ratio * self.stiffness;
                Branch::line(YIELDING, SHORTENING, start.mirrored(SHORTENING), slope)
                    .towards(SHORTENING)
            }
        };
        self.switch(history, next);
    }
}
