//! Menegotto and Pinto's curved law of reinforcing steel.

use crate::descriptor::{Alias, LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::history::{Branch, History, Point, Side};
use crate::law::HysteresisLaw;
use crate::parameters::{
    HARDENING_RATIO, LawParameters, STIFFNESS, YIELD_FORCE, non_negative, positive,
};
use crate::path::PathLaw;
use crate::substeps::integrate;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "menegotto_pinto_1973",
    aliases: &[Alias {
        name: "giuffre_menegotto_pinto",
        citation: "common name of the form without isotropic hardening",
    }],
    title: "Menegotto-Pinto",
    formula: "f = r s + (1-r) s / (1 + |s|^R)^(1/R), from the last turning point (s = f = 0) to where its tangent k meets the yield line (s = f = 1);  R = R0 (1 - c1 p / (c2 + p)), p = |xm - x0| / xy",
    citation: "Menegotto and Pinto, IABSE Symposium on Resistance and Ultimate Deformability of Structures, Lisbon (1973) 15; R as in Filippou, Popov and Bertero, Report UCB/EERC-83/19 (1983)",
    parameters: &[
        STIFFNESS,
        YIELD_FORCE,
        HARDENING_RATIO,
        positive(
            "curvature",
            ParameterUnit::One,
            "Exponent R0 of the first loading: the greater, the sharper the knee",
        )
        .within((1.0, false), (100.0, true))
        .default_to(20.0),
        non_negative(
            "curvature_loss",
            ParameterUnit::One,
            "Coefficient c1, below 1: share of R lost after large plastic excursions",
        )
        .within((0.0, true), (1.0, false))
        .default_to(0.925),
        positive(
            "curvature_excursion",
            ParameterUnit::One,
            "Coefficient c2: excursion over xy after which half of that is lost",
        )
        .default_to(0.15),
    ],
    rate_dependent: false,
    verification: Verification::SecondarySources(
        "the formula; equals the bilinear law away from the knee for a large R0",
    ),
    example: &[
        ("stiffness", 2.0e7),
        ("yield_force", 2.0e5),
        ("hardening_ratio", 0.05),
        ("curvature", 15.0),
    ],
    example_amplitude: 0.05,
    traps: &[
        "Inner loops are not closed: reloading after a small unloading overshoots the curve it left.",
        "R can fall below 1.5 with the usual coefficients; the curve then approaches the yield line slowly.",
        "The stored energy is F^2 / 2k; unloading is curved, so the dissipated energy steps back a little on it.",
    ],
    build,
};

#[derive(Debug)]
struct MenegottoPinto {
    stiffness: f64,
    yield_force: f64,
    hardening_ratio: f64,
    curvature: f64,
    curvature_loss: f64,
    curvature_excursion: f64,
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(&DESCRIPTOR, name);
    Ok(Box::new(MenegottoPinto {
        stiffness: get("stiffness")?,
        yield_force: get("yield_force")?,
        hardening_ratio: get("hardening_ratio")?,
        curvature: get("curvature")?,
        curvature_loss: get("curvature_loss")?,
        curvature_excursion: get("curvature_excursion")?,
    }))
}

/// The curve of the held branch.
struct Curve {
    start: Point,
    /// From the start to where the tangents meet, in deformation (m).
    reach: f64,
    exponent: f64,
}

impl MenegottoPinto {
    fn curve(&self, history: &History) -> Curve {
        let branch = &history.branch;
        let (k, r) = (self.stiffness, self.hardening_ratio);
        let start = branch.start;
        let line = branch.direction * self.yield_force * (1.0 - r) + r * k * start.deformation;
        let reach = (line - start.force) / (k * (1.0 - r));
        let meet = branch.direction * (start.deformation + reach);
        let farthest = history.side(branch.direction).peak.deformation;
        let excursion = (farthest - meet).abs() / (self.yield_force / k);
        let loss = self.curvature_loss * excursion / (self.curvature_excursion + excursion);
        Curve {
            start,
            reach,
            exponent: self.curvature * (1.0 - loss),
        }
    }

    fn branch(&self, direction: f64, start: Point) -> Branch {
        Branch::line(0, direction, start, self.stiffness).towards(direction)
    }
}

impl Curve {
    /// `s / (1 + |s|^R)^(1/R)` and its slope.
    fn bend(&self, share: f64) -> (f64, f64) {
        let size = share.abs();
        if size > 1.0 {
            // The same without overflow for large shares.
            let inverse = size.powf(-self.exponent);
            let root = (1.0 + inverse).powf(-1.0 / self.exponent);
            let slope = root * inverse / ((1.0 + inverse) * size);
            return (root * share.signum(), slope);
        }
        let sum = 1.0 + size.powf(self.exponent);
        let root = sum.powf(-1.0 / self.exponent);
        (share * root, root / sum)
    }

    /// Integral of [`Curve::bend`] from zero.
    fn area(&self, share: f64) -> f64 {
        let slope = |s: f64, _: &[f64; 1]| [self.bend(s).0];
        integrate(slope, [0.0], 0.0, share)[0]
    }
}

impl PathLaw for MenegottoPinto {
    fn law_descriptor(&self) -> &'static LawDescriptor {
        &DESCRIPTOR
    }
    fn stiffness_when_new(&self) -> f64 {
        self.stiffness
    }
    fn begin(&self) -> History {
        let mut history = History::new(self.branch(1.0, Point::default()));
        history.sides = [Side {
            peak: Point {
                deformation: self.yield_force / self.stiffness,
                force: self.yield_force,
            },
            ..Side::default()
        }; 2];
        history
    }
    fn on_branch(&self, history: &History, deformation: f64) -> (f64, f64) {
        let curve = self.curve(history);
        let (k, r) = (self.stiffness, self.hardening_ratio);
        let way = deformation - curve.start.deformation;
        let (bend, slope) = if curve.reach == 0.0 {
            (0.0, 0.0)
        } else {
            curve.bend(way / curve.reach)
        };
        (
            curve.start.force + k * (r * way + (1.0 - r) * curve.reach * bend),
            k * (r + (1.0 - r) * slope),
        )
    }
    fn work(&self, history: &History, deformation: f64) -> f64 {
        let curve = self.curve(history);
        let (k, r) = (self.stiffness, self.hardening_ratio);
        let way = deformation - curve.start.deformation;
        let bent = if curve.reach == 0.0 {
            0.0
        } else {
            (1.0 - r) * curve.reach * curve.reach * curve.area(way / curve.reach)
        };
        history.branch.work + curve.start.force * way + k * (0.5 * r * way * way + bent)
    }
    fn stored(&self, history: &History, deformation: f64) -> f64 {
        let (force, _) = self.on_branch(history, deformation);
        0.5 * force * force / self.stiffness
    }
    fn turn(&self, history: &mut History, deformation: f64) {
        let (force, _) = self.on_branch(history, deformation);
        let direction = history.branch.direction;
        let next = self.branch(-direction, Point { deformation, force });
        self.switch(history, next);
        let peak = &mut history.side_mut(direction).peak;
        peak.deformation = peak.deformation.max(direction * deformation);
    }
    fn leave(&self, _: &mut History, _: f64) {}
}
