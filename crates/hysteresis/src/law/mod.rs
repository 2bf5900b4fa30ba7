//! The contract of a force-deformation law with memory.

pub mod descriptor;

use self::descriptor::LawDescriptor;
use crate::history::{History, MAXIMUM_INTERNAL_VARIABLES};

/// Maximum number of guards that one branch watches.
pub const MAXIMUM_GUARDS: usize = 3;

/// Deformation of the element and its rate.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// Deformation (m).
    pub deformation: f64,
    /// Rate of deformation (m/s).
    pub velocity: f64,
}

impl History {
    /// Deformation and velocity of the last committed or accepted state.
    #[must_use]
    pub fn motion(&self) -> Motion {
        Motion {
            deformation: self.deformation,
            velocity: self.velocity,
        }
    }
}

/// Force of the element and its partial derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Response {
    /// Force (N), positive resists a positive deformation.
    pub force: f64,
    /// Derivative by the deformation (N/m).
    pub by_deformation: f64,
    /// Derivative by the velocity (N s/m).
    pub by_velocity: f64,
}

/// A function that ends a branch when it becomes positive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Guard {
    /// The velocity against the direction of the branch (m/s): a turning point.
    Turning,
    /// Deformation beyond the upper end of the branch (m): yield, slip, closure
    /// of a gap, or the meeting of two branches.
    Above,
    /// Deformation beyond the lower end of the branch (m).
    Below,
    /// Velocity beyond the upper end of the branch (m/s).
    Faster,
    /// Velocity beyond the lower end of the branch (m/s).
    Slower,
    /// Sign of the internal variable of this number against the one held.
    Variable(u8),
}

/// The guards of one branch, unused places `None`.
pub type Guards = [Option<Guard>; MAXIMUM_GUARDS];

/// A force-deformation law with its parameters: a pure function of its arguments.
///
/// Laws are files of this crate: what a [`History`] remembers is for them alone to write. How one is added
/// stands in `docs/how-to/add-a-hysteresis-law.md`.
///
/// **Implicit seam.** [`HysteresisLaw::trial`] follows the straight path from the
/// committed state to a trial point over a step, through every change of branch on
/// the way, and gives force and tangents there. It leaves the committed history
/// alone and writes what would follow into a second one;
/// [`History::commit`] makes that the committed one.
///
/// **Explicit seam.** Within a step the branch in the history is held: its law
/// ([`HysteresisLaw::force`], [`HysteresisLaw::rates`]) continues smoothly past its
/// end. The method watches [`HysteresisLaw::guards`], cuts the step where one of
/// them becomes positive and calls [`HysteresisLaw::pass`] there, again until none
/// is positive; [`HysteresisLaw::accept`] takes each accepted state. The internal
/// variables are part of the method's own state vector.
pub trait HysteresisLaw: Send + Sync + std::fmt::Debug {
    /// The descriptor of the law: names, citation, parameters, verification.
    fn descriptor(&self) -> &'static LawDescriptor;

    /// Whether the force is a linear function of deformation and velocity.
    fn is_linear(&self) -> bool {
        false
    }

    /// Whether it takes a force to deform the element either way: the largest deformation over that at
    /// yield is a ductility. What opens without a force has none.
    fn deforms_by_force_alone(&self) -> bool {
        true
    }

    /// Whether on every branch that can be held the force is an affine function of
    /// deformation and velocity, whatever the internal variables, which only account for
    /// what the motion does: between two changes of branch the element is a spring and a
    /// dashpot with constant coefficients.
    fn is_piecewise_linear(&self) -> bool {
        false
    }

    /// Derivative of the force by the deformation before anything happened (N/m):
    /// for a rate-dependent law that of an infinitely fast start.
    fn initial_stiffness(&self) -> f64;

    /// Derivative of the force by the deformation at most (N/m), where it can be more than at first, as
    /// of what closes a gap.
    fn steepest_stiffness(&self) -> f64 {
        self.initial_stiffness()
    }

    /// Bound (N/m) of the magnitude of the derivative of the force by the deformation on all straight paths that
    /// [`HysteresisLaw::trial`] follows from this history within a step; `None` where the force depends on the
    /// velocity too, or none is known.
    fn slope_bound(&self, committed: &History) -> Option<f64> {
        let _ = committed;
        None
    }

    /// Derivative of the force by the velocity at rest (N s/m).
    fn initial_damping(&self) -> f64 {
        0.0
    }

    /// Rate (1/s) at which an internal variable relaxes by itself, at most.
    fn relaxation_rate(&self) -> f64 {
        0.0
    }

    /// Whether the element at rest keeps up a lasting load, which one whose force is due to the speed
    /// alone does not.
    fn holds_static_load(&self) -> bool {
        !self.descriptor().rate_dependent
    }

    /// Whether the element may lose all its strength: what it then is has no force for ever.
    fn may_lose_all_strength(&self) -> bool {
        false
    }

    /// Whether it has.
    fn has_lost_all_strength(&self, history: &History) -> bool {
        let _ = history;
        false
    }

    /// Number of internal variables, at most
    /// [`crate::MAXIMUM_INTERNAL_VARIABLES`].
    fn internal_variables(&self) -> usize {
        0
    }

    /// Sizes below which errors of the internal variables are held absolutely by a
    /// method with error control, in the units of the variables; infinite for one that
    /// only keeps account of energy.
    fn variable_sizes(&self) -> [f64; MAXIMUM_INTERNAL_VARIABLES] {
        [1.0; MAXIMUM_INTERNAL_VARIABLES]
    }

    /// Largest magnitude of the first internal variable that any motion leads to, where there is one: a
    /// method that leads beyond takes steps that are too long for the law.
    fn variable_bound(&self) -> f64 {
        f64::INFINITY
    }

    /// The history of an element that was never deformed.
    fn virgin(&self) -> History;

    /// Force and tangents at the end of a step of `step` seconds on a straight path
    /// of deformations from the committed state. The tangents are those of the
    /// returned force by the components of `end`. `candidate` receives the history
    /// that a commit would establish; its former content does not matter.
    fn trial(
        &self,
        committed: &History,
        candidate: &mut History,
        end: Motion,
        step: f64,
    ) -> Response;

    /// Force on the held branch at these internal variables, and its partial
    /// derivatives with the internal variables fixed.
    fn force(&self, history: &History, motion: Motion, variables: &[f64]) -> Response;

    /// Rates of the internal variables on the held branch (their unit per second).
    fn rates(&self, history: &History, motion: Motion, variables: &[f64], rates: &mut [f64]) {
        let _ = (history, motion, variables, rates);
    }

    /// The guards of the held branch.
    fn guards(&self, history: &History) -> Guards;

    /// Value of a guard: positive beyond the end of the branch, smooth around it.
    fn guard(&self, history: &History, guard: Guard, motion: Motion, variables: &[f64]) -> f64 {
        let branch = &history.branch;
        match guard {
            Guard::Turning => -branch.direction * motion.velocity,
            Guard::Above => motion.deformation - branch.upper,
            Guard::Below => branch.lower - motion.deformation,
            Guard::Faster => motion.velocity - branch.upper,
            Guard::Slower => branch.lower - motion.velocity,
            Guard::Variable(i) => -branch.side * variables.get(usize::from(i)).unwrap_or(&0.0),
        }
    }

    /// Passes a guard that fired at this located state: switches the branch.
    fn pass(&self, history: &mut History, guard: Guard, motion: Motion, variables: &[f64]);

    /// Takes an accepted state into the history, on the held branch.
    fn accept(&self, history: &mut History, motion: Motion, variables: &[f64]) {
        history.deformation = motion.deformation;
        history.velocity = motion.velocity;
        let n = variables.len().min(history.variables.len());
        history.variables[..n].copy_from_slice(&variables[..n]);
    }

    /// Recoverable energy (J): what the element would give back on unloading.
    fn stored_energy(&self, history: &History, motion: Motion, variables: &[f64]) -> f64;

    /// Energy dissipated since the element was new (J). With
    /// [`HysteresisLaw::stored_energy`] it adds up to the work of the force.
    fn dissipated_energy(&self, history: &History, motion: Motion, variables: &[f64]) -> f64;
}
