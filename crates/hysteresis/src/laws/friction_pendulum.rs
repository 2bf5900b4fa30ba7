//! A friction pendulum: a slider on a dish, whose friction depends on the speed.

use crate::bouc_wen_family::{LOADING, guards, kind, pass, variables};
use crate::descriptor::{LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::history::{Branch, History, MAXIMUM_INTERNAL_VARIABLES, Point};
use crate::law::{Guard, Guards, HysteresisLaw, Motion, Response};
use crate::parameters::{LawParameters, positive};

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "friction_pendulum",
    aliases: &[],
    title: "Friction pendulum",
    formula: "F = W x / R + mu W z;  mu = mu_f - (mu_f - mu_s) exp(-a |v|);  Y dz/dt = v for v z < 0, else v (1 - z^2)",
    citation: "Constantinou, Mokha and Reinhorn, Journal of Structural Engineering 116 (1990) 455; the variable z of Bouc and Wen with exponent 2, beta = gamma = 1/2",
    parameters: &[
        positive(
            "weight",
            ParameterUnit::Newton,
            "Weight W on the isolators, constant",
        ),
        positive(
            "radius",
            ParameterUnit::Metre,
            "Effective radius R of the dish: the period of the pendulum is 2 pi sqrt(R / g)",
        ),
        positive(
            "friction_fast",
            ParameterUnit::One,
            "Coefficient of friction mu_f at high speed",
        )
        .within((0.0, false), (1.0, false)),
        positive(
            "friction_slow",
            ParameterUnit::One,
            "Coefficient of friction mu_s at rest, at most mu_f",
        )
        .within((0.0, false), (1.0, false)),
        positive(
            "friction_rate",
            ParameterUnit::SecondPerMetre,
            "Rate a at which the friction grows with the speed, usually 20 to 100 s/m",
        ),
        positive(
            "yield_displacement",
            ParameterUnit::Metre,
            "Displacement Y over which the friction builds up, usually 0.1 to 1 mm",
        ),
    ],
    rate_dependent: true,
    link_alone: None,
    verification: Verification::Verified(
        "closed form of the dissipation of cycles; a rigid block between walls by two independent integrations",
    ),
    example: &[
        ("weight", 1.0e7),
        ("radius", 2.0),
        ("friction_fast", 0.08),
        ("friction_slow", 0.04),
        ("friction_rate", 30.0),
        ("yield_displacement", 0.0025),
    ],
    example_amplitude: 0.03,
    traps: &[
        "The weight is constant: neither overturning nor vertical motion changes it, and the dish has no rim.",
        "Stored is W x^2 / 2 R + mu_s W Y z^2 / 2; what the work of the force exceeds it by is dissipated.",
        "Within the yield displacement the law gives back a little more than it took where it is loaded slowly and unloaded fast: (mu_f - mu_s) W Y / 2 a time at most.",
        "A trial takes the mean of the friction at both ends of its step for the dissipated energy: second order in the step.",
    ],
    build,
};

/// Exponent of the fading friction up to which a trial step behind the turn of the motion follows it.
const FREE_EXPONENT: f64 = 2.0;

/// Internal variables: `z` and the work of the friction over `W Y` (both without dimension).
#[derive(Debug)]
struct FrictionPendulum {
    weight: f64,
    radius: f64,
    fast: f64,
    slow: f64,
    rate: f64,
    yield_displacement: f64,
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(&DESCRIPTOR, name);
    let (fast, slow) = (get("friction_fast")?, get("friction_slow")?);
    if slow > fast {
        return Err(HysteresisError::Inconsistent {
            law: DESCRIPTOR.name,
            reason: format!(
                "its friction_slow {slow} is above its friction_fast {fast}: friction grows with the speed"
            ),
            remedy: "give friction_slow as 0.3 to 0.6 of friction_fast, or both equal for friction without rate",
        });
    }
    Ok(Box::new(FrictionPendulum {
        weight: get("weight")?,
        radius: get("radius")?,
        fast,
        slow,
        rate: get("friction_rate")?,
        yield_displacement: get("yield_displacement")?,
    }))
}

impl FrictionPendulum {
    /// Coefficient of friction at a speed, and its derivative by it. Behind the turn of the motion,
    /// where the speed along the branch is negative, a trial step goes on smoothly along the branch;
    /// only there, and far from the turn, is it held below what the exponential grows to.
    fn friction(&self, speed: f64) -> (f64, f64) {
        let exponent = -self.rate * speed;
        let (exponent, by_exponent) = if exponent > FREE_EXPONENT {
            let tangent = libm::tanh(exponent - FREE_EXPONENT);
            (FREE_EXPONENT + tangent, 1.0 - tangent * tangent)
        } else {
            (exponent, 1.0)
        };
        let fading = (self.fast - self.slow) * libm::exp(exponent);
        (self.fast - fading, self.rate * fading * by_exponent)
    }

    /// `Y dz/dx` on a branch.
    fn slope(z: f64, kind: u8) -> f64 {
        if kind == LOADING { 1.0 - z * z } else { 1.0 }
    }

    /// Follows a path in one direction, under this mean coefficient of friction: `z` grows by
    /// the path up to zero, and from there as a hyperbolic tangent.
    fn walk(&self, history: &mut History, deformation: f64, friction: f64) {
        let path = (deformation - history.deformation) / self.yield_displacement;
        let direction = path.signum();
        let [z, work] = history.variables;
        // Mirrored, so that the path is positive.
        let (mut z, mut rest) = (direction * z, path.abs());
        let mut done = 0.0;
        if z < 0.0 {
            let straight = rest.min(-z);
            done = straight * (z + 0.5 * straight);
            rest -= straight;
            z = if rest > 0.0 { 0.0 } else { z + straight };
        }
        let side = if z < 0.0 { -direction } else { direction };
        if rest > 0.0 {
            let tangent = libm::tanh(rest);
            // ln(cosh rest + z sinh rest), without large numbers.
            done += rest + libm::log(0.5 * ((1.0 + z) + (1.0 - z) * libm::exp(-2.0 * rest)));
            z = (z + tangent) / (1.0 + z * tangent);
        }
        history.variables = [direction * z, work + friction * done];
        history.branch.direction = direction;
        history.branch.side = side;
        history.branch.kind = kind(direction, side);
    }

    /// Energy (J) of one unit of the second variable.
    fn unit_of_energy(&self) -> f64 {
        self.weight * self.yield_displacement
    }

    fn pendulum(&self) -> f64 {
        self.weight / self.radius
    }
}

impl HysteresisLaw for FrictionPendulum {
    fn descriptor(&self) -> &'static LawDescriptor {
        &DESCRIPTOR
    }
    /// The pendulum, and the friction at rest.
    fn holds_static_load(&self) -> bool {
        true
    }
    fn initial_stiffness(&self) -> f64 {
        self.pendulum() + self.slow * self.weight / self.yield_displacement
    }
    fn internal_variables(&self) -> usize {
        2
    }
    fn variable_sizes(&self) -> [f64; MAXIMUM_INTERNAL_VARIABLES] {
        [0.1, self.fast]
    }
    fn variable_bound(&self) -> f64 {
        1.0
    }
    fn virgin(&self) -> History {
        let branch = Branch::line(LOADING, 1.0, Point::default(), 0.0).towards(1.0);
        let mut history = History::new(branch);
        history.internal_variables = 2;
        history
    }
    fn trial(
        &self,
        committed: &History,
        candidate: &mut History,
        end: Motion,
        _step: f64,
    ) -> Response {
        candidate.clone_from(committed);
        let (friction, by_speed) = self.friction(end.velocity.abs());
        if end.deformation != committed.deformation {
            let (before, _) = self.friction(committed.velocity.abs());
            self.walk(candidate, end.deformation, 0.5 * (before + friction));
        }
        candidate.deformation = end.deformation;
        candidate.velocity = end.velocity;
        let [z, _] = candidate.variables;
        let slope = Self::slope(z, candidate.branch.kind) / self.yield_displacement;
        // Within the step the motion may have turned: the friction is that of the speed at its end.
        if end.velocity != 0.0 {
            let branch = &mut candidate.branch;
            branch.direction = end.velocity.signum();
            branch.kind = kind(branch.direction, branch.side);
        }
        Response {
            force: self.pendulum() * end.deformation + friction * self.weight * z,
            by_deformation: self.pendulum() + friction * self.weight * slope,
            by_velocity: by_speed * end.velocity.signum() * self.weight * z,
        }
    }
    fn force(&self, history: &History, motion: Motion, given: &[f64]) -> Response {
        let [z, _] = variables(history, given);
        let direction = history.branch.direction;
        let (friction, by_speed) = self.friction(direction * motion.velocity);
        Response {
            force: self.pendulum() * motion.deformation + friction * self.weight * z,
            by_deformation: self.pendulum(),
            by_velocity: by_speed * direction * self.weight * z,
        }
    }
    fn rates(&self, history: &History, motion: Motion, given: &[f64], rates: &mut [f64]) {
        let [z, _] = variables(history, given);
        let branch = &history.branch;
        let speed = motion.velocity / self.yield_displacement;
        let (friction, _) = self.friction(branch.direction * motion.velocity);
        if let [z_rate, work_rate, ..] = rates {
            *z_rate = Self::slope(z, branch.kind) * speed;
            *work_rate = friction * z * speed;
        }
    }
    fn guards(&self, history: &History) -> Guards {
        guards(history)
    }
    fn pass(&self, history: &mut History, guard: Guard, motion: Motion, given: &[f64]) {
        self.accept(history, motion, given);
        pass(history, guard);
    }
    /// The pendulum, and what the friction gives back on slow unloading.
    fn stored_energy(&self, history: &History, motion: Motion, given: &[f64]) -> f64 {
        let [z, _] = variables(history, given);
        let x = motion.deformation;
        0.5 * self.pendulum() * x * x + 0.5 * self.slow * self.unit_of_energy() * z * z
    }
    fn dissipated_energy(&self, history: &History, _: Motion, given: &[f64]) -> f64 {
        let [z, work] = variables(history, given);
        self.unit_of_energy() * (work - 0.5 * self.slow * z * z)
    }
}
