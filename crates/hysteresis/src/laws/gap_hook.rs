//! A gap that closes in compression and a hook that catches in tension.

use crate::descriptor::{Alias, LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::history::{Branch, History, Point};
use crate::law::HysteresisLaw;
use crate::parameters::{LawParameters, non_negative};
use crate::path::PathLaw;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "gap_hook",
    aliases: &[Alias {
        name: "restrainer",
        citation: "common name of the hook alone",
    }],
    title: "Gap and hook",
    formula: "F = kc (x + gc) for x < -gc, 0 between, kt (x - gt) for x > gt",
    citation: "closed form; a positive deformation is an extension",
    parameters: &[
        non_negative(
            "compression_stiffness",
            ParameterUnit::NewtonPerMetre,
            "Stiffness kc of the closed gap; zero for none",
        )
        .default_to(0.0),
        non_negative(
            "compression_gap",
            ParameterUnit::Metre,
            "Shortening gc that closes the gap",
        )
        .default_to(0.0),
        non_negative(
            "tension_stiffness",
            ParameterUnit::NewtonPerMetre,
            "Stiffness kt of the caught hook; zero for none",
        )
        .default_to(0.0),
        non_negative(
            "tension_gap",
            ParameterUnit::Metre,
            "Extension gt that catches the hook",
        )
        .default_to(0.0),
    ],
    rate_dependent: false,
    link_alone: Some("it has no stiffness between its gap and its hook"),
    verification: Verification::Verified("closed form"),
    example: &[
        ("compression_stiffness", 5.0e8),
        ("compression_gap", 0.01),
        ("tension_stiffness", 2.0e7),
        ("tension_gap", 0.02),
    ],
    example_amplitude: 0.05,
    traps: &["Elastic: a collision through it loses nothing; impact models belong to gaps."],
    build,
};

const OPEN: u8 = 0;
const TENSION: u8 = 1;
const COMPRESSION: u8 = 2;

#[derive(Debug)]
struct GapHook {
    compression_stiffness: f64,
    compression_gap: f64,
    tension_stiffness: f64,
    tension_gap: f64,
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(&DESCRIPTOR, name);
    let law = GapHook {
        compression_stiffness: get("compression_stiffness")?,
        compression_gap: get("compression_gap")?,
        tension_stiffness: get("tension_stiffness")?,
        tension_gap: get("tension_gap")?,
    };
    if law.compression_stiffness == 0.0 && law.tension_stiffness == 0.0 {
        return Err(HysteresisError::Inconsistent {
            law: DESCRIPTOR.name,
            reason: "it has neither a gap nor a hook".to_owned(),
            remedy: "give compression_stiffness, tension_stiffness or both",
        });
    }
    Ok(Box::new(law))
}

impl GapHook {
    fn open(&self) -> Branch {
        Branch::line(OPEN, 1.0, Point::default(), 0.0)
            .between(-self.compression_gap, self.tension_gap)
    }

    fn closed(&self, side: f64) -> Branch {
        let (kind, gap, stiffness) = if side > 0.0 {
            (TENSION, self.tension_gap, self.tension_stiffness)
        } else {
            (
                COMPRESSION,
                self.compression_gap,
                self.compression_stiffness,
            )
        };
        let start = Point {
            deformation: side * gap,
            force: 0.0,
        };
        Branch::line(kind, side, start, stiffness).between(gap, f64::INFINITY)
    }
}

impl PathLaw for GapHook {
    fn law_descriptor(&self) -> &'static LawDescriptor {
        &DESCRIPTOR
    }
    fn straight(&self) -> bool {
        true
    }
    fn stiffness_when_new(&self) -> f64 {
        if self.compression_gap == 0.0 {
            return self.compression_stiffness;
        }
        if self.tension_gap == 0.0 {
            return self.tension_stiffness;
        }
        0.0
    }
    fn steepest(&self) -> f64 {
        self.tension_stiffness.max(self.compression_stiffness)
    }
    fn begin(&self) -> History {
        History::new(self.open())
    }
    fn stored(&self, history: &History, deformation: f64) -> f64 {
        0.5 * history.branch.force(deformation) * (deformation - history.branch.start.deformation)
    }
    fn dissipated(&self, _: &History, _: f64) -> f64 {
        0.0
    }
    fn turn(&self, _: &mut History, _: f64) {}
    fn leave(&self, history: &mut History, end: f64) {
        let next = if history.branch.kind == OPEN {
            self.closed(end)
        } else {
            self.open()
        };
        self.switch(history, next);
    }
}
