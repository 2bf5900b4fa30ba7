//! Laws that depend on the path of deformations alone, not on its speed.
//!
//! Such a law is a list of branches, each valid on an interval of deformations and
//! in one direction or both. From that alone both seams of [`HysteresisLaw`]
//! follow, exactly: a trial walks from branch to branch.

use crate::descriptor::LawDescriptor;
use crate::history::{Branch, History};
use crate::law::{Guard, Guards, HysteresisLaw, Motion, Response};

/// A rate-independent law, branch by branch.
pub(crate) trait PathLaw: Send + Sync + std::fmt::Debug {
    fn law_descriptor(&self) -> &'static LawDescriptor;

    fn linear(&self) -> bool {
        false
    }

    fn stiffness_when_new(&self) -> f64;

    /// Whether it opens one way without a force.
    fn opens(&self) -> bool {
        false
    }

    /// [`HysteresisLaw::may_lose_all_strength`].
    fn may_fail(&self) -> bool {
        false
    }

    /// [`HysteresisLaw::has_lost_all_strength`].
    fn has_failed(&self, history: &History) -> bool {
        let _ = history;
        false
    }

    /// Stiffness (N/m) on the steepest branch.
    fn steepest(&self) -> f64 {
        self.stiffness_when_new()
    }

    fn begin(&self) -> History;

    /// Whether all branches are straight: the event-driven method then follows them
    /// exactly.
    fn straight(&self) -> bool {
        false
    }

    /// Force and its slope on the held branch; straight unless the law says more.
    fn on_branch(&self, history: &History, deformation: f64) -> (f64, f64) {
        let branch = &history.branch;
        (branch.force(deformation), branch.stiffness)
    }

    /// Work of the force (J) from the new state to this deformation on the held
    /// branch.
    fn work(&self, history: &History, deformation: f64) -> f64 {
        let branch = &history.branch;
        let mean = 0.5 * (branch.start.force + branch.force(deformation));
        branch.work + mean * (deformation - branch.start.deformation)
    }

    /// Recoverable energy (J) at this deformation on the held branch.
    fn stored(&self, history: &History, deformation: f64) -> f64;

    /// Dissipated energy (J) at this deformation on the held branch.
    fn dissipated(&self, history: &History, deformation: f64) -> f64 {
        self.work(history, deformation) - self.stored(history, deformation)
    }

    /// The path turns at this deformation against the direction of the branch.
    fn turn(&self, history: &mut History, deformation: f64);

    /// The path leaves the branch over its upper (+1) or lower (-1) end.
    fn leave(&self, history: &mut History, end: f64);

    /// Puts the element on a branch that starts on the present one.
    fn switch(&self, history: &mut History, mut branch: Branch) {
        branch.work = self.work(history, branch.start.deformation);
        history.branch = branch;
    }
}

/// Walks from the last state to this deformation.
fn walk(law: &impl PathLaw, history: &mut History, deformation: f64) {
    let from = history.deformation;
    let heading = if deformation > from {
        1.0
    } else if deformation < from {
        -1.0
    } else {
        return;
    };
    if history.branch.direction == -heading {
        law.turn(history, from);
    }
    while heading > 0.0 && deformation > history.branch.upper {
        law.leave(history, 1.0);
    }
    while heading < 0.0 && deformation < history.branch.lower {
        law.leave(history, -1.0);
    }
    history.deformation = deformation;
}

impl<L: PathLaw> HysteresisLaw for L {
    fn descriptor(&self) -> &'static LawDescriptor {
        self.law_descriptor()
    }
    fn is_linear(&self) -> bool {
        self.linear()
    }
    fn is_piecewise_linear(&self) -> bool {
        self.straight()
    }
    fn initial_stiffness(&self) -> f64 {
        self.stiffness_when_new()
    }
    fn steepest_stiffness(&self) -> f64 {
        self.steepest()
    }
    fn deforms_by_force_alone(&self) -> bool {
        !self.opens()
    }
    fn may_lose_all_strength(&self) -> bool {
        self.may_fail()
    }
    fn has_lost_all_strength(&self, history: &History) -> bool {
        self.has_failed(history)
    }
    fn virgin(&self) -> History {
        self.begin()
    }
    fn trial(
        &self,
        committed: &History,
        candidate: &mut History,
        end: Motion,
        _step: f64,
    ) -> Response {
        candidate.clone_from(committed);
        walk(self, candidate, end.deformation);
        candidate.velocity = end.velocity;
        HysteresisLaw::force(self, candidate, end, &[])
    }
    fn force(&self, history: &History, motion: Motion, _variables: &[f64]) -> Response {
        let (force, by_deformation) = self.on_branch(history, motion.deformation);
        Response {
            force,
            by_deformation,
            by_velocity: 0.0,
        }
    }
    fn guards(&self, history: &History) -> Guards {
        let branch = &history.branch;
        [
            (branch.direction != 0.0).then_some(Guard::Turning),
            (branch.upper < f64::INFINITY && branch.direction >= 0.0).then_some(Guard::Above),
            (branch.lower > f64::NEG_INFINITY && branch.direction <= 0.0).then_some(Guard::Below),
        ]
    }
    fn pass(&self, history: &mut History, guard: Guard, motion: Motion, _variables: &[f64]) {
        match guard {
            Guard::Turning => self.turn(history, motion.deformation),
            Guard::Above => self.leave(history, 1.0),
            Guard::Below => self.leave(history, -1.0),
            Guard::Faster | Guard::Slower | Guard::Variable(_) => {}
        }
        history.deformation = motion.deformation;
        history.velocity = motion.velocity;
    }
    fn stored_energy(&self, history: &History, motion: Motion, _variables: &[f64]) -> f64 {
        self.stored(history, motion.deformation)
    }
    fn dissipated_energy(&self, history: &History, motion: Motion, _variables: &[f64]) -> f64 {
        self.dissipated(history, motion.deformation)
    }
}
