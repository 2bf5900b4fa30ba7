//! The deteriorating laws of Ibarra, Medina and Krawinkler (Earthquake Engineering
//! and Structural Dynamics 34 (2005) 1489): an envelope that hardens, is capped,
//! softens and ends in a residual strength; three rules of reloading; four modes of
//! cyclic deterioration, driven by dissipated energy.
//!
//! All rules are written for the positive side and mirrored.

mod envelope;
mod parameters;

use crate::descriptor::LawDescriptor;
use crate::history::{Branch, History, Point, Side};
use crate::path::PathLaw;
use envelope::{Envelope, Stretch};
pub(crate) use parameters::{PARAMETERS, build};

/// To know of every law of the family: which energy counts.
pub(crate) const ENERGY_SINCE: &str = "E is the energy dissipated since the mode acted before: since the crossing of zero force before for strength, cap and target, since the turning point before for Ku, there reckoned with the stiffness that it fell to; sum E is all energy dissipated so far.";
/// To know of every law of the family: what a mode multiplies.
pub(crate) const WHAT_FALLS: &str = "With beta the rate of its mode, strength multiplies Fy and Ks of the side that is loaded next by 1 - beta, where h = Fy (1 - Ks / K) with the first stiffness K; the cap its Fref, the force of the softening line at zero deformation, by 1 - beta; reloading the deformation of its target by 1 + beta; and unloading Ku, one for both sides, by 1 - beta.";
/// To know of the laws that aim at a target: what a small unloading does.
pub(crate) const RETRACED: &str = "Unloading that turns before zero force is retraced to the point where it began, and goes on from there as if it had not been, but no steeper than Ku, which may have fallen meanwhile.";
/// To know of the laws that aim at a target: what bounds their way to it.
pub(crate) const NO_STEEPER: &str = "The target of a side is the largest deformation that was reached on its envelope, at first that at yield; the mode of reloading moves it outwards. Reloading is no steeper than unloading: where the way to the target is, after Ku has fallen, the path has the slope Ku, passes below the target and meets the envelope farther on; if it turns before, the target stays, however far it went. The published rule has no such bound, and gives back more energy there than was put in.";
/// To know of every law of the family: its energy where the unloading stiffness falls.
pub(crate) const ENERGY_STEPS_BACK: &str = "Where the unloading stiffness falls, what is stored rises, and the dissipated energy steps back: no further than to what it was at the turning point before, which bounds the stiffness from below. The published rule has no bound, and gives back more energy than was put in as its capacity runs out. The E of a turning point is with the stiffness before it falls; energies that are reported on the way to it are with the one that it would fall to there.";
/// To know: how it fails.
pub(crate) const FAILS_FOR_EVER: &str = "Exhausted capacity, or a strength that reaches zero, also at the target before the path is there, leaves an element without force for ever.";
/// To know: what does not deteriorate.
pub(crate) const RESIDUAL_STAYS: &str = "The residual strength does not deteriorate.";

/// How the element reloads after zero force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Reloading {
    /// Straight on to the envelope with the unloading stiffness.
    Bilinear,
    /// Towards the target on the envelope.
    PeakOriented,
    /// First towards a break point with little force, then towards the target.
    Pinching {
        /// Force to head for over the force at the target.
        force: f64,
        /// Share of the residual deformation by which the break lies before it.
        deformation: f64,
    },
}

const ELASTIC: u8 = 0;
/// Stretches of the envelope, in the order of [`Stretch`].
const ENVELOPE: u8 = 1;
const FROM_ENVELOPE: u8 = 6;
const FROM_FIRST_LEG: u8 = 7;
const FROM_SECOND_LEG: u8 = 8;
const FIRST_LEG: u8 = 9;
const SECOND_LEG: u8 = 10;
const FAILED: u8 = 11;

/// Energy capacities of the modes of deterioration over `Fy xy`; zero for none.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Capacities {
    strength: f64,
    capping: f64,
    unloading: f64,
    reloading: f64,
    exponent: f64,
}

/// A law of the family.
#[derive(Debug)]
pub(crate) struct Deteriorating {
    descriptor: &'static LawDescriptor,
    reloading: Reloading,
    stiffness: f64,
    yield_force: f64,
    hardening_ratio: f64,
    capping_deformation: f64,
    softening: f64,
    residual_force: f64,
    capacities: Capacities,
}

impl Deteriorating {
    fn yield_deformation(&self) -> f64 {
        self.yield_force / self.stiffness
    }

    fn envelope(&self, side: &Side) -> Envelope {
        Envelope {
            start: side.yield_force * (1.0 - side.hardening / self.stiffness),
            hardening: side.hardening,
            cap: side.cap_intercept,
            softening: self.softening,
            limit: side.force_limit,
            residual: self.residual_force,
        }
    }

    /// Rate of deterioration of a mode after `energy` (J) since it last acted, with
    /// `total` dissipated in all; `None` where the capacity is exhausted.
    fn rate(&self, capacity: f64, energy: f64, total: f64) -> Option<f64> {
        if capacity == 0.0 || !(energy > 0.0) {
            return Some(0.0);
        }
        let left = capacity * self.yield_force * self.yield_deformation() - total;
        let rate = libm::pow(energy / left, self.capacities.exponent);
        (left > 0.0 && rate < 1.0).then_some(rate)
    }

    /// Weakens the side that is about to be loaded, at zero force. `None`: failed.
    fn deteriorate(&self, history: &mut History, side: f64, dissipated: f64) -> Option<()> {
        let energy = dissipated - history.reckoned;
        history.reckoned = dissipated;
        let modes = self.capacities;
        let strength = self.rate(modes.strength, energy, dissipated)?;
        let capping = self.rate(modes.capping, energy, dissipated)?;
        let reloading = self.rate(modes.reloading, energy, dissipated)?;
        let side = history.side_mut(side);
        side.yield_force *= 1.0 - strength;
        side.hardening *= 1.0 - strength;
        side.cap_intercept *= 1.0 - capping;
        side.peak.deformation *= 1.0 + reloading;
        Some(())
    }

    /// The stretch of the envelope that holds at this mirrored deformation.
    fn on_envelope(&self, history: &History, side: f64, deformation: f64) -> Branch {
        let envelope = self.envelope(history.side(side));
        let stretch = envelope.stretch(deformation);
        self.stretch(&envelope, stretch, side, deformation)
    }

    fn stretch(&self, envelope: &Envelope, stretch: Stretch, side: f64, from: f64) -> Branch {
        let (force, slope) = envelope.line(stretch, from);
        if stretch == Stretch::Residual && self.residual_force == 0.0 {
            return failed(side, from);
        }
        let start = Point {
            deformation: from,
            force,
        };
        Branch::line(ENVELOPE + stretch as u8, side, start.mirrored(side), slope)
            .towards(side)
            .between(f64::NEG_INFINITY, envelope.end(stretch))
    }

    /// Unloading from a mirrored point, retraced if it turns.
    fn unloading(&self, history: &History, kind: u8, side: f64, from: Point) -> Branch {
        let slope = history.unloading_stiffness;
        Branch::line(kind, side, from.mirrored(side), slope)
            .between(from.deformation - from.force / slope, from.deformation)
    }

    /// Straight on with the unloading stiffness, up to the envelope.
    fn straight(&self, history: &History, side: f64, from: Point) -> Branch {
        let slope = history.unloading_stiffness;
        let end = self.envelope(history.side(side)).meets(from, slope);
        Branch::line(SECOND_LEG, side, from.mirrored(side), slope)
            .towards(side)
            .between(f64::NEG_INFINITY, end)
    }

    /// Towards the target on the envelope.
    fn second_leg(&self, history: &History, side: f64, from: Point) -> Branch {
        if self.reloading == Reloading::Bilinear {
            return self.straight(history, side, from);
        }
        let memory = history.side(side);
        let target = memory.peak.deformation;
        let force = self.envelope(memory).force(target);
        let way = target - from.deformation;
        let slope = (force - from.force) / way;
        if !(way > 0.0) || slope > history.unloading_stiffness {
            return self.straight(history, side, from);
        }
        Branch::line(SECOND_LEG, side, from.mirrored(side), slope)
            .towards(side)
            .between(f64::NEG_INFINITY, target)
    }

    /// Towards the break point, or below it: a leg steeper than the unloading stiffness would give
    /// back more than it took.
    fn first_leg(&self, history: &History, side: f64, from: Point) -> Branch {
        let to = history.side(side).break_point;
        let slope = (to.force - from.force) / (to.deformation - from.deformation);
        let slope = slope.min(history.unloading_stiffness);
        Branch::line(FIRST_LEG, side, from.mirrored(side), slope)
            .towards(side)
            .between(f64::NEG_INFINITY, to.deformation)
    }

    /// Loading of a side from zero force at this mirrored deformation.
    fn reload(&self, history: &mut History, side: f64, at: f64) -> Branch {
        let from = Point {
            deformation: at,
            force: 0.0,
        };
        let memory = history.side(side);
        let target = memory.peak.deformation;
        let strength = self.envelope(memory).force(target);
        if self.reloading != Reloading::Bilinear && !(strength > 0.0) {
            return failed(side, at);
        }
        if let Reloading::Pinching { force, deformation } = self.reloading {
            let meet = (1.0 - deformation) * memory.residual;
            if at < meet && meet < target {
                let slope = force * strength / (target - at);
                history.side_mut(side).break_point = Point {
                    deformation: meet,
                    force: slope * (meet - at),
                };
                return self.first_leg(history, side, from);
            }
        }
        self.second_leg(history, side, from)
    }

    /// Zero force reached on unloading from the other side.
    fn cross(&self, history: &mut History, side: f64, at: f64) -> Branch {
        let dissipated = self.work(history, side * at);
        let behind = history.side_mut(-side);
        behind.residual = behind.residual.max(-at);
        match self.deteriorate(history, side, dissipated) {
            Some(()) => self.reload(history, side, at),
            None => failed(side, at),
        }
    }

    /// Unloading stiffness if the path turned here; `None` where its capacity is
    /// exhausted. It falls where loading dissipates: not on the elastic lines of the bilinear rule.
    fn stiffness_on_turning(&self, history: &History, deformation: f64) -> Option<f64> {
        let present = history.unloading_stiffness;
        let inelastic = match history.branch.kind {
            ENVELOPE..FROM_ENVELOPE => true,
            FIRST_LEG | SECOND_LEG => self.reloading != Reloading::Bilinear,
            _ => false,
        };
        if !inelastic {
            return Some(present);
        }
        let force = history.branch.force(deformation);
        let stored = 0.5 * force * force / present;
        let dissipated = self.work(history, deformation) - stored;
        let energy = dissipated - history.reckoned_unloading;
        let rate = self.rate(self.capacities.unloading, energy, dissipated)?;
        // The published rule lets the stiffness fall to zero as its capacity runs out, and what is
        // stored rise above all bounds: no more is given back than was put in since it last fell.
        let least = stored / (stored + energy.max(0.0));
        let left = match least.is_finite() {
            true => (1.0 - rate).max(least),
            false => 1.0 - rate,
        };
        Some(present * left)
    }

    /// A turning point of loading: what the side and the unloading stiffness learn from it.
    /// Whether the element survives.
    fn learn(&self, history: &mut History, side: f64, at: Point, kind: u8) -> bool {
        let deformation = side * at.deformation;
        let dissipated = self.dissipated(history, deformation);
        let Some(stiffness) = self.stiffness_on_turning(history, deformation) else {
            return false;
        };
        history.unloading_stiffness = stiffness;
        // With the new stiffness: a turning point right after this one adds nothing.
        history.reckoned_unloading = dissipated;
        let memory = history.side_mut(side);
        if (ENVELOPE..FROM_ENVELOPE).contains(&kind) {
            memory.peak.deformation = memory.peak.deformation.max(at.deformation);
        }
        let falling = [Stretch::Softening, Stretch::Residual].map(|s| ENVELOPE + s as u8);
        if self.reloading == Reloading::Bilinear && falling.contains(&kind) {
            memory.force_limit = memory.force_limit.min(at.force);
        }
        true
    }
}

/// An element without force from here on.
fn failed(side: f64, at: f64) -> Branch {
    let start = Point {
        deformation: side * at,
        force: 0.0,
    };
    Branch::line(FAILED, side, start, 0.0)
}

impl PathLaw for Deteriorating {
    fn law_descriptor(&self) -> &'static LawDescriptor {
        self.descriptor
    }
    fn straight(&self) -> bool {
        true
    }
    fn stiffness_when_new(&self) -> f64 {
        self.stiffness
    }
    fn may_fail(&self) -> bool {
        let Capacities {
            strength,
            capping,
            unloading,
            reloading,
            ..
        } = self.capacities;
        let most = strength.max(capping).max(unloading).max(reloading);
        most > 0.0 || self.residual_force == 0.0
    }
    fn has_failed(&self, history: &History) -> bool {
        history.branch.kind == FAILED
    }
    fn begin(&self) -> History {
        let range = self.yield_deformation();
        let hardening = self.hardening_ratio * self.stiffness;
        let strength = self.yield_force + hardening * (self.capping_deformation - range);
        let line = Branch::line(ELASTIC, 1.0, Point::default(), self.stiffness);
        let mut history = History::new(line.between(-range, range));
        history.unloading_stiffness = self.stiffness;
        history.sides = [Side {
            peak: Point {
                deformation: range,
                force: self.yield_force,
            },
            yield_force: self.yield_force,
            hardening,
            cap_intercept: strength + self.softening * self.capping_deformation,
            force_limit: f64::INFINITY,
            ..Side::default()
        }; 2];
        history
    }
    fn stored(&self, history: &History, deformation: f64) -> f64 {
        let force = history.branch.force(deformation);
        self.stiffness_on_turning(history, deformation)
            .map_or(0.0, |stiffness| 0.5 * force * force / stiffness)
    }
    fn turn(&self, history: &mut History, deformation: f64) {
        let (kind, side) = (history.branch.kind, history.branch.side);
        let at = Point {
            deformation,
            force: history.branch.force(deformation),
        }
        .mirrored(side);
        let from = match kind {
            FIRST_LEG => FROM_FIRST_LEG,
            SECOND_LEG => FROM_SECOND_LEG,
            _ => FROM_ENVELOPE,
        };
        if !self.learn(history, side, at, kind) {
            // The capacity of the unloading stiffness is exhausted: what is stored
            // is lost as well.
            self.switch(history, failed(side, at.deformation));
            return;
        }
        let next = self.unloading(history, from, side, at);
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
            FROM_FIRST_LEG if end == branch.side => self.first_leg(history, end, ahead),
            FROM_SECOND_LEG if end == branch.side => self.second_leg(history, end, ahead),
            FROM_ENVELOPE if end == branch.side => {
                self.on_envelope(history, end, ahead.deformation)
            }
            FROM_FIRST_LEG | FROM_SECOND_LEG | FROM_ENVELOPE => {
                self.cross(history, end, ahead.deformation)
            }
            FIRST_LEG => self.second_leg(history, end, ahead),
            ELASTIC | SECOND_LEG => self.on_envelope(history, end, ahead.deformation),
            stretch => {
                let envelope = self.envelope(history.side(end));
                let next = Stretch::after(stretch - ENVELOPE, &envelope);
                self.stretch(&envelope, next, end, ahead.deformation)
            }
        };
        self.switch(history, next);
    }
}
