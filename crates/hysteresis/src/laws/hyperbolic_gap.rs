//! Backfill behind an abutment or the wall of a moat: a hyperbola behind a gap that stays
//! wider.

use crate::descriptor::{LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::history::{Branch, History, Point};
use crate::law::HysteresisLaw;
use crate::parameters::{LawParameters, non_negative, optional_positive, positive};
use crate::path::PathLaw;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "hyperbolic_gap",
    aliases: &[],
    title: "Backfill behind a gap",
    formula: "F = y / (1/Ki + Rf y / Fu) for the largest y = -x - g so far; below it a line of slope Ku down to F = 0, where the gap stays: no tension",
    citation: "Duncan and Mokwa, Journal of Geotechnical and Geoenvironmental Engineering 127 (2001) 248, the hyperbola; unloading as in OpenSees' HyperbolicGapMaterial; a positive deformation is an extension, the wall closes on shortening and its force is negative",
    parameters: &[
        positive(
            "initial_stiffness",
            ParameterUnit::NewtonPerMetre,
            "Slope Ki of the hyperbola at its start",
        ),
        positive(
            "ultimate_force",
            ParameterUnit::Newton,
            "Ultimate passive force Fu",
        ),
        positive(
            "failure_ratio",
            ParameterUnit::One,
            "Ratio Rf of the ultimate force to the asymptote of the hyperbola, below 1",
        )
        .within((0.0, false), (1.0, false)),
        optional_positive(
            "unloading_stiffness",
            ParameterUnit::NewtonPerMetre,
            "Slope Ku of unloading and reloading, at least Ki; by default Ki",
        ),
        optional_positive(
            "force_limit",
            ParameterUnit::Newton,
            "Force of a plateau that ends the hyperbola; by default none",
        ),
        non_negative(
            "gap",
            ParameterUnit::Metre,
            "Shortening at which the wall is first met",
        )
        .default_to(0.0),
    ],
    rate_dependent: false,
    link_alone: Some("it acts on shortening alone"),
    verification: Verification::Verified(
        "closed form of force and dissipation; an oscillator beside an abutment by two independent integrations",
    ),
    example: &[
        ("initial_stiffness", 2.03e8),
        ("ultimate_force", 3.26e6),
        ("failure_ratio", 0.7),
        ("gap", 0.01),
    ],
    example_amplitude: 0.05,
    traps: &[
        "The hyperbola does not stop at the ultimate force, which it passes at Fu / (Ki (1 - Rf)): it tends to Fu / Rf. Give force_limit for a plateau.",
        "The gap that compressed soil leaves does not recover.",
    ],
    build,
};

const OPEN: u8 = 0;
const CLOSED: u8 = 1;
const ENVELOPE: u8 = 2;
const PLATEAU: u8 = 3;

/// The side on which the wall acts.
const SHORTENING: f64 = -1.0;

/// Below this the logarithm in the work is taken as its series.
const SMALL: f64 = 1.0e-2;

#[derive(Debug)]
struct HyperbolicGap {
    /// `1/Ki` (m/N) and `Rf/Fu` (1/N).
    flexibility: f64,
    curvature: f64,
    unloading_stiffness: f64,
    /// Where the plateau begins (m), and its force (N); infinite without one.
    limit: (f64, f64),
    gap: f64,
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(&DESCRIPTOR, name);
    let optional = |name| match parameters.given(name) {
        Some(_) => get(name).map(Some),
        None => Ok(None),
    };
    let refuse = |reason: String, remedy: &'static str| HysteresisError::Inconsistent {
        law: DESCRIPTOR.name,
        reason,
        remedy,
    };
    let (initial, ultimate) = (get("initial_stiffness")?, get("ultimate_force")?);
    let ratio = get("failure_ratio")?;
    let unloading_stiffness = optional("unloading_stiffness")?.unwrap_or(initial);
    if unloading_stiffness < initial {
        return Err(refuse(
            format!(
                "its unloading_stiffness {unloading_stiffness} N/m is below its initial_stiffness {initial} N/m: unloading would give back more than loading took"
            ),
            "give at least the initial stiffness, or leave it out",
        ));
    }
    let asymptote = ultimate / ratio;
    let limit = match optional("force_limit")? {
        None => (f64::INFINITY, f64::INFINITY),
        Some(force) if force < asymptote => {
            // The hyperbola solved for y.
            (force / (initial * (1.0 - force / asymptote)), force)
        }
        Some(force) => {
            return Err(refuse(
                format!(
                    "its force_limit {force} N is not below {asymptote} N, which its hyperbola never reaches"
                ),
                "leave force_limit out, or give the ultimate force",
            ));
        }
    };
    Ok(Box::new(HyperbolicGap {
        flexibility: 1.0 / initial,
        curvature: ratio / ultimate,
        unloading_stiffness,
        limit,
        gap: get("gap")?,
    }))
}

impl HyperbolicGap {
    /// Force and slope of the hyperbola; its tangent where it is not yet met.
    fn hyperbola(&self, y: f64) -> (f64, f64) {
        if y <= 0.0 {
            return (y / self.flexibility, 1.0 / self.flexibility);
        }
        let below = self.flexibility + self.curvature * y;
        (y / below, self.flexibility / (below * below))
    }

    /// Largest force so far, at this penetration.
    fn virgin(&self, y: f64) -> f64 {
        if y < self.limit.0 {
            self.hyperbola(y).0
        } else {
            self.limit.1
        }
    }

    /// Work along the hyperbola from its start: `y/b - a/b^2 ln(1 + b y/a)`, in a form that
    /// does not cancel.
    fn hyperbola_work(&self, y: f64) -> f64 {
        let z = self.curvature * y / self.flexibility;
        let part = if z.abs() < SMALL {
            (0..9)
                .rev()
                .fold(0.0, |sum, k| 1.0 / f64::from(k + 2) - z * sum)
        } else {
            (z - libm::log1p(z)) / (z * z)
        };
        y * y / self.flexibility * part
    }

    /// Largest penetration so far (m).
    fn farthest(history: &History) -> f64 {
        history.side(SHORTENING).peak.deformation
    }

    /// Shortening at which the wall is met now.
    fn met(&self, farthest: f64) -> f64 {
        self.gap + farthest - self.virgin(farthest) / self.unloading_stiffness
    }

    fn open(&self, farthest: f64) -> Branch {
        let gap = self.met(farthest);
        let start = Point {
            deformation: -gap,
            force: 0.0,
        };
        Branch::line(OPEN, SHORTENING, start, 0.0).between(f64::NEG_INFINITY, gap)
    }

    /// The line of unloading and reloading below the largest penetration so far.
    fn closed(&self, farthest: f64) -> Branch {
        let gap = self.met(farthest);
        let start = Point {
            deformation: gap,
            force: 0.0,
        };
        let start = start.mirrored(SHORTENING);
        Branch::line(CLOSED, SHORTENING, start, self.unloading_stiffness)
            .between(gap, self.gap + farthest)
    }

    /// Penetrations never reached before.
    fn loading(&self, from: f64) -> Branch {
        let plateau = from >= self.limit.0;
        let start = Point {
            deformation: self.gap + from,
            force: self.virgin(from),
        };
        let kind = if plateau { PLATEAU } else { ENVELOPE };
        let end = if plateau {
            f64::INFINITY
        } else {
            self.gap + self.limit.0
        };
        Branch::line(kind, SHORTENING, start.mirrored(SHORTENING), 0.0)
            .between(f64::NEG_INFINITY, end)
            .towards(SHORTENING)
    }
}

impl PathLaw for HyperbolicGap {
    fn law_descriptor(&self) -> &'static LawDescriptor {
        &DESCRIPTOR
    }
    fn opens(&self) -> bool {
        true
    }
    fn stiffness_when_new(&self) -> f64 {
        if self.gap == 0.0 {
            1.0 / self.flexibility
        } else {
            0.0
        }
    }
    fn steepest(&self) -> f64 {
        1.0 / self.flexibility
    }
    fn begin(&self) -> History {
        let mut branch = self.open(0.0);
        branch.start = Point::default();
        History::new(branch)
    }
    fn on_branch(&self, history: &History, deformation: f64) -> (f64, f64) {
        let branch = &history.branch;
        if branch.kind != ENVELOPE {
            return (branch.force(deformation), branch.stiffness);
        }
        let (force, slope) = self.hyperbola(-deformation - self.gap);
        (-force, slope)
    }
    fn work(&self, history: &History, deformation: f64) -> f64 {
        let branch = &history.branch;
        if branch.kind != ENVELOPE {
            let mean = 0.5 * (branch.start.force + branch.force(deformation));
            return branch.work + mean * (deformation - branch.start.deformation);
        }
        let at = |x: f64| self.hyperbola_work(-x - self.gap);
        branch.work + (at(deformation) - at(branch.start.deformation))
    }
    fn stored(&self, history: &History, deformation: f64) -> f64 {
        let (force, _) = self.on_branch(history, deformation);
        0.5 * force * force / self.unloading_stiffness
    }
    fn turn(&self, history: &mut History, deformation: f64) {
        let work = self.work(history, deformation);
        let farthest = (-deformation - self.gap).max(0.0);
        let force = self.virgin(farthest);
        history.side_mut(SHORTENING).peak = Point {
            deformation: farthest,
            force,
        };
        // The line begins where the force is zero; its work is counted from there.
        history.branch = self.closed(farthest);
        history.branch.work = work - 0.5 * force * force / self.unloading_stiffness;
    }
    fn leave(&self, history: &mut History, end: f64) {
        let farthest = Self::farthest(history);
        let next = match (history.branch.kind, end == SHORTENING) {
            (OPEN, _) if farthest > 0.0 => self.closed(farthest),
            (CLOSED, false) => self.open(farthest),
            (ENVELOPE, _) => self.loading(self.limit.0),
            _ => self.loading(farthest),
        };
        self.switch(history, next);
    }
}
