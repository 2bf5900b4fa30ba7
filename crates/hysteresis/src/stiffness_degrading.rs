//! Laws that reload towards the farthest point reached before.
//!
//! One set of rules carries the peak-oriented law, the modified Clough law and the
//! bilinear Takeda law: a bilinear backbone; unloading with a stiffness that may fall
//! with the ductility; from zero force on, reloading towards a target on the
//! backbone of the other side.

use crate::descriptor::LawDescriptor;
use crate::history::{Branch, History, Point, Side};
use crate::path::PathLaw;

const ELASTIC: u8 = 0;
const BACKBONE: u8 = 1;
/// Unloading that, if it turns, goes back to the backbone.
const FROM_BACKBONE: u8 = 2;
/// Unloading that, if it turns, goes back to the way to the target.
const FROM_RELOADING: u8 = 3;
const RELOADING: u8 = 4;

/// Rules with their parameters.
#[derive(Debug)]
pub(crate) struct StiffnessDegrading {
    pub descriptor: &'static LawDescriptor,
    pub stiffness: f64,
    pub yield_force: f64,
    pub hardening_ratio: f64,
    /// Exponent of the ductility by which the unloading stiffness falls.
    pub unloading_exponent: f64,
    /// Share of the plastic deformation by which the target lies before the peak.
    pub reloading_factor: f64,
    /// Whether unloading that turns before zero force goes back the way it came;
    /// otherwise it heads for the target at once.
    pub retraces: bool,
}

impl StiffnessDegrading {
    fn yield_deformation(&self) -> f64 {
        self.yield_force / self.stiffness
    }

    fn backbone_force(&self, deformation: f64) -> f64 {
        let plastic = deformation - self.yield_deformation();
        self.yield_force + self.hardening_ratio * self.stiffness * plastic
    }

    /// Unloading stiffness after this maximum deformation of the side; never below
    /// the secant to that point, so that unloading cannot cross zero deformation.
    fn unloading_stiffness(&self, peak: Point) -> f64 {
        let ductility = peak.deformation / self.yield_deformation();
        let reduced = self.stiffness * libm::pow(ductility, -self.unloading_exponent);
        reduced.max(peak.force / peak.deformation)
    }

    /// The farthest point of the side, the held branch included.
    fn peak(&self, history: &History, side: f64, deformation: f64) -> Point {
        let peak = history.side(side).peak;
        let at = side * deformation;
        if history.branch.kind == BACKBONE && side == history.branch.side && at > peak.deformation {
            return Point {
                deformation: at,
                force: self.backbone_force(at),
            };
        }
        peak
    }

    fn on_backbone(&self, side: f64, deformation: f64) -> Branch {
        let start = Point {
            deformation: side * deformation,
            force: side * self.backbone_force(deformation),
        };
        Branch::line(BACKBONE, side, start, self.hardening_ratio * self.stiffness).towards(side)
    }

    /// From a mirrored point towards the target of the side, with its end.
    fn reloading(&self, history: &History, side: f64, from: Point) -> Branch {
        let peak = history.side(side).peak;
        let steepest = self.unloading_stiffness(peak);
        let plastic = peak.deformation - self.yield_deformation();
        let mut target = peak.deformation - self.reloading_factor * plastic;
        let way = target - from.deformation;
        let mut slope = (self.backbone_force(target) - from.force) / way;
        if !(way > 0.0) || slope > steepest {
            // The target lies behind, or above the steepest way: to the backbone
            // with the unloading stiffness.
            slope = steepest;
            let hardening = self.hardening_ratio * self.stiffness;
            let ahead = self.backbone_force(from.deformation) - from.force;
            target = from.deformation + ahead / (slope - hardening);
        }
        Branch::line(RELOADING, side, from.mirrored(side), slope)
            .towards(side)
            .between(f64::NEG_INFINITY, target)
    }

    fn unloading(&self, history: &History, kind: u8, side: f64, from: Point) -> Branch {
        let slope = self.unloading_stiffness(history.side(side).peak);
        let end = from.deformation - from.force / slope;
        let line = Branch::line(kind, side, from.mirrored(side), slope);
        if self.retraces {
            line.between(end, from.deformation)
        } else {
            line.towards(-side).between(end, f64::INFINITY)
        }
    }
}

impl PathLaw for StiffnessDegrading {
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
        let mut history = History::new(line.between(-range, range));
        history.sides = [Side {
            peak: Point {
                deformation: range,
                force: self.yield_force,
            },
            ..Side::default()
        }; 2];
        history
    }
    fn stored(&self, history: &History, deformation: f64) -> f64 {
        let force = history.branch.force(deformation);
        let side = history.branch.side;
        let stiffness = match history.branch.kind {
            ELASTIC => self.stiffness,
            _ => self.unloading_stiffness(self.peak(history, side, deformation)),
        };
        0.5 * force * force / stiffness
    }
    fn turn(&self, history: &mut History, deformation: f64) {
        let side = history.branch.side;
        history.side_mut(side).peak = self.peak(history, side, deformation);
        let at = Point {
            deformation,
            force: history.branch.force(deformation),
        }
        .mirrored(side);
        let next = match history.branch.kind {
            BACKBONE => self.unloading(history, FROM_BACKBONE, side, at),
            RELOADING => self.unloading(history, FROM_RELOADING, side, at),
            _ => self.reloading(history, side, at),
        };
        self.switch(history, next);
    }
    fn leave(&self, history: &mut History, end: f64) {
        let branch = history.branch;
        let at = if end > 0.0 {
            branch.upper
        } else {
            branch.lower
        };
        let ahead = Point {
            deformation: end * at,
            force: end * branch.force(at),
        };
        let next = match branch.kind {
            ELASTIC | RELOADING => self.on_backbone(end, ahead.deformation),
            FROM_BACKBONE if end == branch.side => self.on_backbone(end, ahead.deformation),
            FROM_RELOADING if end == branch.side => self.reloading(history, end, ahead),
            // Zero force: on to the other side.
            _ => self.reloading(
                history,
                end,
                Point {
                    force: 0.0,
                    ..ahead
                },
            ),
        };
        self.switch(history, next);
    }
}
