//! The contract of an impact model.
//!
//! Sign convention: the penetration `delta = u_left - u_right - gap > 0` is
//! contact, `v = d(delta)/dt > 0` is approach, and a positive force pushes the
//! floors apart. The contract knows nothing of integrators or files.

pub mod descriptor;

use self::descriptor::ModelDescriptor;
pub use crate::separation_rule::SeparationRule;

/// Maximum number of constants that a model may fix for one collision.
pub const MAXIMUM_CONSTANTS: usize = 4;

/// Smallest approach velocity (m/s) that laws scaled by the approach velocity
/// divide by. Buildings that touch at rest close at zero speed; without this
/// floor `v / approach_velocity` would be 0/0 there. A collision slower than
/// 1 mm/s is treated, in those laws only, as if it closed at 1 mm/s.
pub const APPROACH_VELOCITY_FLOOR: f64 = 1.0e-3;

/// What is fixed at the located closure of one collision and holds until the
/// contact opens.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Collision {
    /// Relative velocity at the located closure (m/s), not floored.
    pub approach_velocity: f64,
    /// `m1 m2 / (m1 + m2)` of the two floors (kg); the floor's own mass
    /// against a rigid wall.
    pub effective_mass: f64,
    /// The model's constants in the order of
    /// [`ModelDescriptor::constants`], unused places zero.
    pub constants: [f64; MAXIMUM_CONSTANTS],
}

/// What a model remembers inside one collision. Changed at accepted steps only.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory {
    /// Maximum penetration of this collision so far (m).
    pub maximum_penetration: f64,
    /// Penetration at which the elastic branch of a yielding law has no force
    /// (m); set by [`ImpactModel::enter`].
    pub plastic_penetration: f64,
}

/// The part of a contact that the force law is evaluated in. It changes only
/// at located events; an open gap has no phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Phase {
    /// Since closure, or since the last turning point with growing penetration.
    Approach,
    /// After a turning point, penetration falling.
    Restitution,
    /// The floors move as one (dry friction at zero relative velocity); the
    /// force is whatever holds them.
    Stuck,
    /// The law would pull, and the separation rule forbids it: no force while
    /// the floors still overlap.
    Released,
    /// A further branch of a piecewise law, numbered by the model.
    Branch(u8),
}

/// Force of the contact and its partial derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Force {
    /// Force (N), positive pushes apart.
    pub value: f64,
    /// Partial derivative with respect to the penetration (N/m).
    pub by_penetration: f64,
    /// Partial derivative with respect to the relative velocity (N s/m).
    pub by_velocity: f64,
}

/// A law in powers of a positive penetration,
/// `F = stiffness delta^exponent + dashpot delta^dashpot_exponent v`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// Contact stiffness (N/m^exponent).
    pub stiffness: f64,
    /// Exponent of the penetration (-).
    pub exponent: f64,
    /// Dashpot coefficient (N s/m^(1 + dashpot_exponent)).
    pub dashpot: f64,
    /// Exponent of the penetration in the dashpot (-).
    pub dashpot_exponent: f64,
}

impl PowerLaw {
    /// Force (N) at a positive penetration (m) and its rate (m/s).
    #[inline]
    #[must_use]
    pub fn force(&self, delta: f64, velocity: f64) -> f64 {
        let root = delta.sqrt();
        let power = |exponent: f64| {
            if exponent == 1.5 {
                root * delta
            } else if exponent == 0.25 {
                root.sqrt()
            } else if exponent == 1.0 {
                delta
            } else {
                libm::pow(delta, exponent)
            }
        };
        let spring = power(self.exponent);
        if self.dashpot == 0.0 {
            return self.stiffness * spring;
        }
        let dashpot = if self.dashpot_exponent == self.exponent {
            spring
        } else {
            power(self.dashpot_exponent)
        };
        self.stiffness * spring + self.dashpot * dashpot * velocity
    }
}

/// The function whose sign change ends a phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Guard {
    /// Relative velocity `v` (m/s): the turning point.
    Velocity,
    /// The sign of the law's force before any cut of tension,
    /// [`ImpactModel::raw_force`].
    RawForce,
    /// Holding force minus the lower bound of [`ImpactModel::stick_range`] (N).
    StickLower,
    /// Upper bound of [`ImpactModel::stick_range`] minus holding force (N).
    StickUpper,
    /// A function of the model's own, [`ImpactModel::guard`], by its number.
    Model(u8),
}

/// Direction of the sign change that counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
}

/// Where a transition leads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// To this phase.
    Phase(Phase),
    /// The driver computes the force that would hold the floors together. Inside
    /// [`ImpactModel::stick_range`] the contact sticks; above it, it goes on in
    /// approach; below it, in restitution.
    StickOrSlip,
    /// The contact is over, though the floors overlap. For laws of [`SeparationRule::GapShift`], whose gap is
    /// wider then: under another rule the floors, which still overlap, are in contact again at once, in
    /// impacts without end.
    Open,
}

/// One way out of a phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Transition {
    /// The function watched.
    pub guard: Guard,
    /// The sign change that fires.
    pub direction: Direction,
    /// The phase after it.
    pub target: Target,
}

/// What is known of a free two-body collision without integration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosedForm {
    /// Achieved restitution, separation over approach velocity (-).
    pub restitution: f64,
    /// Maximum penetration (m), where a closed form exists.
    pub peak_penetration: Option<f64>,
    /// Maximum force (N), where a closed form exists.
    pub peak_force: Option<f64>,
    /// Time from closure until the floors stop acting on one another (s),
    /// where a closed form exists.
    pub duration: Option<f64>,
}

/// An impact model with its parameters: a pure function of its arguments.
///
/// The driver latches the approach velocity at located closure
/// ([`ImpactModel::begin`]), evaluates [`ImpactModel::force`] with the phase
/// held fixed inside a step, cuts the step where a guard of
/// [`ImpactModel::transitions`] changes sign, and calls
/// [`ImpactModel::commit`] for accepted steps only.
pub trait ImpactModel: Send + Sync + std::fmt::Debug {
    /// The model's descriptor: names, citation, parameters, class, verification.
    fn descriptor(&self) -> &'static ModelDescriptor;

    /// The rule by which contact ends.
    fn separation(&self) -> SeparationRule;

    /// Fixes the constants of a collision from the approach velocity (m/s) at
    /// located closure and the effective mass (kg).
    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision;

    /// Force and both partial derivatives at penetration `delta` (m) and
    /// relative velocity `velocity` (m/s). The phase is held: the law of the
    /// phase is continued smoothly past its end, so that a step that overshoots
    /// an event stays accurate up to it. Zero in [`Phase::Released`]; in
    /// [`Phase::Stuck`] the driver supplies the force and does not call this.
    fn force(
        &self,
        collision: &Collision,
        memory: &Memory,
        phase: Phase,
        delta: f64,
        velocity: f64,
    ) -> Force;

    /// Whether the force of this phase is an affine function of penetration and
    /// velocity (zero counts): then value and derivatives of [`ImpactModel::force`] at
    /// zero are its constants, and an integrator may take the contact as a linear
    /// system.
    fn is_affine(&self, collision: &Collision, phase: Phase) -> bool {
        let _ = (collision, phase);
        false
    }

    /// The law of this phase in powers of the penetration, where it is one: an integrator
    /// may then expand it into a series. Equal to [`ImpactModel::force`] at every positive
    /// penetration.
    fn power_law(&self, collision: &Collision, phase: Phase) -> Option<PowerLaw> {
        let _ = (collision, phase);
        None
    }

    /// A smooth function with the sign of the law's force before any cut of
    /// tension; the force itself (N) unless the law has a simpler factor.
    fn raw_force(
        &self,
        collision: &Collision,
        memory: &Memory,
        phase: Phase,
        delta: f64,
        velocity: f64,
    ) -> f64 {
        self.force(collision, memory, phase, delta, velocity).value
    }

    /// Recoverable energy (J) at penetration `delta` (m): the part of the work
    /// done on the contact that its spring would give back. In [`Phase::Released`] what it gives once
    /// it acts again: until then it counts as lost.
    fn stored_energy(
        &self,
        collision: &Collision,
        memory: &Memory,
        phase: Phase,
        delta: f64,
    ) -> f64;

    /// The ways out of `phase` other than the end of the contact at zero
    /// penetration, which every model shares.
    fn transitions(&self, phase: Phase) -> &'static [Transition];

    /// Value of guard number `index` of the model's own ([`Guard::Model`]), in any
    /// unit: only its sign and its smoothness matter.
    fn guard(
        &self,
        index: u8,
        collision: &Collision,
        memory: &Memory,
        delta: f64,
        velocity: f64,
    ) -> f64 {
        let _ = (index, collision, memory, delta, velocity);
        0.0
    }

    /// Prepares the memory for the phase `to`, which follows `from` at this
    /// penetration (m); after [`ImpactModel::commit`] of the same state.
    fn enter(
        &self,
        collision: &Collision,
        memory: &mut Memory,
        (from, to): (Phase, Phase),
        delta: f64,
    ) {
        let _ = (collision, memory, from, to, delta);
    }

    /// Restitution of a law without compliance, from 0 to 1 (a system refuses others): the driver then lets velocities
    /// jump at located closure, and neither [`ImpactModel::force`] nor a phase
    /// other than [`Phase::Stuck`] (lasting contact) is ever asked for.
    fn rigid_restitution(&self) -> Option<f64> {
        None
    }

    /// Least and maximum force (N) with which the contact can hold the floors
    /// together at penetration `delta` (m). Equal bounds: it cannot stick.
    fn stick_range(&self, collision: &Collision, memory: &Memory, delta: f64) -> (f64, f64) {
        let force = self
            .force(collision, memory, Phase::Approach, delta, 0.0)
            .value;
        (force, force)
    }

    /// Takes an accepted state into the memory.
    fn commit(&self, memory: &mut Memory, phase: Phase, delta: f64, velocity: f64) {
        let _ = (phase, velocity);
        memory.maximum_penetration = memory.maximum_penetration.max(delta);
    }

    /// Free collision at this approach velocity (m/s) and effective mass (kg)
    /// in closed form, `None` where the law has none.
    fn closed_form(&self, approach_velocity: f64, effective_mass: f64) -> Option<ClosedForm>;

    /// Whether the force is a smooth function of time at the instant of
    /// closure. Powers such as `delta^1.5` or `delta^0.25` are not: an
    /// integrator then has to start the contact with a tiny step.
    fn smooth_at_closure(&self) -> bool;

    /// Stiffness (N/m) of an elastic spring behind the contact ([`crate::in_series()`]), whose
    /// deformation is part of the penetration.
    fn spring_behind(&self) -> Option<f64> {
        None
    }
}
