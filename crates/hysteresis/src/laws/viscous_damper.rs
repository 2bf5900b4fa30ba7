//! A viscous damper, linear or with a power of the velocity.

use crate::descriptor::{Alias, LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::history::{Branch, History, MAXIMUM_INTERNAL_VARIABLES, Point};
use crate::law::{Guard, Guards, HysteresisLaw, Motion, Response};
use crate::parameters::{LawParameters, positive};

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "viscous_damper",
    aliases: &[Alias {
        name: "dashpot",
        citation: "common name of the linear damper",
    }],
    title: "Viscous damper",
    formula: "F = c |v|^a sgn v for |v| > v0;  F = c v0^(a-1) v below, unless a = 1",
    citation: "Constantinou and Symans, The Structural Design of Tall Buildings 2 (1993) 93; the straight line below v0 is ours",
    parameters: &[
        positive(
            "damping",
            ParameterUnit::NewtonSecondPerMetreToExponent,
            "Coefficient c",
        ),
        positive("exponent", ParameterUnit::One, "Exponent a of the velocity")
            .within((0.0, false), (3.0, true))
            .default_to(1.0),
        positive(
            "transition_velocity",
            ParameterUnit::MetrePerSecond,
            "Velocity v0 below which the law is straight",
        )
        .default_to(1.0e-3),
    ],
    rate_dependent: true,
    link_alone: Some("it has no stiffness"),
    verification: Verification::Verified("closed form of the dissipation of harmonic cycles"),
    example: &[("damping", 3.0e5), ("exponent", 0.5)],
    example_amplitude: 0.02,
    traps: &[
        "Without the straight line the slope at rest would be infinite for a < 1; it softens the law there only.",
        "No stiffness: a damper at the end of a brace is a maxwell element.",
        "Inside a step a trial takes the mean of the forces at both ends for the dissipated energy: second order in the step.",
    ],
    build,
};

const STRAIGHT: u8 = 0;
const POWER: u8 = 1;

/// Internal variable: dissipated energy (J).
#[derive(Debug)]
struct ViscousDamper {
    damping: f64,
    exponent: f64,
    transition_velocity: f64,
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    Ok(Box::new(ViscousDamper {
        damping: parameters.get(&DESCRIPTOR, "damping")?,
        exponent: parameters.get(&DESCRIPTOR, "exponent")?,
        transition_velocity: parameters.get(&DESCRIPTOR, "transition_velocity")?,
    }))
}

impl ViscousDamper {
    /// The branch on which this velocity lies; its ends are velocities.
    fn branch_at(&self, velocity: f64) -> Branch {
        let limit = self.transition_velocity;
        if self.exponent == 1.0 {
            Branch::line(STRAIGHT, 1.0, Point::default(), 0.0)
        } else if velocity.abs() > limit {
            let side = velocity.signum();
            Branch::line(POWER, side, Point::default(), 0.0).between(limit, f64::INFINITY)
        } else {
            self.straight()
        }
    }

    fn straight(&self) -> Branch {
        let limit = self.transition_velocity;
        Branch::line(STRAIGHT, 1.0, Point::default(), 0.0).between(-limit, limit)
    }

    /// Force and slope of a branch at a velocity.
    fn evaluate(&self, branch: &Branch, velocity: f64) -> (f64, f64) {
        if branch.kind == STRAIGHT {
            let slope = self.initial_damping();
            return (slope * velocity, slope);
        }
        let speed = velocity.abs();
        let slope = self.damping * libm::pow(speed, self.exponent - 1.0);
        (slope * velocity, self.exponent * slope)
    }
}

impl HysteresisLaw for ViscousDamper {
    fn descriptor(&self) -> &'static LawDescriptor {
        &DESCRIPTOR
    }
    fn is_linear(&self) -> bool {
        self.exponent == 1.0
    }
    fn is_piecewise_linear(&self) -> bool {
        self.is_linear()
    }
    fn initial_stiffness(&self) -> f64 {
        0.0
    }
    fn initial_damping(&self) -> f64 {
        if self.exponent == 1.0 {
            return self.damping;
        }
        self.damping * libm::pow(self.transition_velocity, self.exponent - 1.0)
    }
    fn internal_variables(&self) -> usize {
        1
    }
    /// The energy at a speed of a tenth of a metre per second over a millimetre.
    fn variable_sizes(&self) -> [f64; MAXIMUM_INTERNAL_VARIABLES] {
        let (speed, way) = (0.1_f64, 1.0e-3);
        [
            self.damping * libm::pow(speed, self.exponent) * way,
            f64::INFINITY,
        ]
    }
    fn virgin(&self) -> History {
        let mut history = History::new(self.branch_at(0.0));
        history.internal_variables = 1;
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
        let (before, _) = self.evaluate(&committed.branch, committed.velocity);
        candidate.branch = self.branch_at(end.velocity);
        let (force, by_velocity) = self.evaluate(&candidate.branch, end.velocity);
        let way = end.deformation - committed.deformation;
        candidate.variables[0] += 0.5 * (before + force) * way;
        candidate.deformation = end.deformation;
        candidate.velocity = end.velocity;
        Response {
            force,
            by_deformation: 0.0,
            by_velocity,
        }
    }
    fn force(&self, history: &History, motion: Motion, _: &[f64]) -> Response {
        let (force, by_velocity) = self.evaluate(&history.branch, motion.velocity);
        Response {
            force,
            by_deformation: 0.0,
            by_velocity,
        }
    }
    fn rates(&self, history: &History, motion: Motion, _: &[f64], rates: &mut [f64]) {
        let (force, _) = self.evaluate(&history.branch, motion.velocity);
        if let [dissipated, ..] = rates {
            *dissipated = force * motion.velocity;
        }
    }
    fn guards(&self, history: &History) -> Guards {
        let branch = &history.branch;
        [
            (branch.upper < f64::INFINITY).then_some(Guard::Faster),
            (branch.lower > f64::NEG_INFINITY).then_some(Guard::Slower),
            None,
        ]
    }
    fn pass(&self, history: &mut History, guard: Guard, motion: Motion, given: &[f64]) {
        self.accept(history, motion, given);
        let limit = self.transition_velocity;
        let side = if guard == Guard::Faster { 1.0 } else { -1.0 };
        history.branch = if history.branch.kind == STRAIGHT {
            Branch::line(POWER, side, Point::default(), 0.0).between(limit, f64::INFINITY)
        } else {
            self.straight()
        };
    }
    fn stored_energy(&self, _: &History, _: Motion, _: &[f64]) -> f64 {
        0.0
    }
    fn dissipated_energy(&self, history: &History, _: Motion, given: &[f64]) -> f64 {
        given.first().copied().unwrap_or(history.variables[0])
    }
}
