//! A spring and a dashpot in series.

use crate::descriptor::{Alias, LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::history::{Branch, History, MAXIMUM_INTERNAL_VARIABLES, Point};
use crate::law::{Guard, Guards, HysteresisLaw, Motion, Response};
use crate::parameters::{LawParameters, STIFFNESS, positive};

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "maxwell",
    aliases: &[Alias {
        name: "damper_with_brace",
        citation: "what it models",
    }],
    title: "Maxwell element",
    formula: "dF/dt = k v - (k / c) F",
    citation: "Maxwell, Philosophical Transactions of the Royal Society 157 (1867) 49",
    parameters: &[
        STIFFNESS,
        positive(
            "damping",
            ParameterUnit::NewtonSecondPerMetre,
            "Coefficient c of the dashpot",
        ),
    ],
    rate_dependent: true,
    link_alone: Some("its force fades under a lasting load"),
    verification: Verification::Verified(
        "closed forms of relaxation and of the dissipation of harmonic cycles",
    ),
    example: &[("stiffness", 5.0e7), ("damping", 1.0e7)],
    example_amplitude: 0.02,
    traps: &[
        "A trial takes the velocity of its step as constant and ignores the velocity at its end: second order in the step.",
    ],
    build,
};

/// Internal variables: force (N) and dissipated energy (J).
#[derive(Debug)]
struct Maxwell {
    stiffness: f64,
    damping: f64,
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    Ok(Box::new(Maxwell {
        stiffness: parameters.get(&DESCRIPTOR, "stiffness")?,
        damping: parameters.get(&DESCRIPTOR, "damping")?,
    }))
}

fn variables(history: &History, given: &[f64]) -> [f64; 2] {
    match given {
        [force, dissipated, ..] => [*force, *dissipated],
        _ => history.variables,
    }
}

impl HysteresisLaw for Maxwell {
    fn descriptor(&self) -> &'static LawDescriptor {
        &DESCRIPTOR
    }
    fn initial_stiffness(&self) -> f64 {
        self.stiffness
    }
    fn relaxation_rate(&self) -> f64 {
        self.stiffness / self.damping
    }
    fn internal_variables(&self) -> usize {
        2
    }
    /// The force and the energy at a deformation of a millimetre.
    fn variable_sizes(&self) -> [f64; MAXIMUM_INTERNAL_VARIABLES] {
        let deformation = 1.0e-3;
        let force = self.stiffness * deformation;
        [force, force * deformation]
    }
    fn virgin(&self) -> History {
        let mut history = History::new(Branch::line(0, 1.0, Point::default(), 0.0));
        history.internal_variables = 2;
        history
    }
    fn trial(
        &self,
        committed: &History,
        candidate: &mut History,
        end: Motion,
        step: f64,
    ) -> Response {
        candidate.clone_from(committed);
        let [before, dissipated] = committed.variables;
        // Steps over relaxation time; the rest is exact for constant velocity.
        let ratio = step * self.stiffness / self.damping;
        let forgotten = -libm::expm1(-ratio);
        let share = if ratio == 0.0 { 1.0 } else { forgotten / ratio };
        let elastic = self.stiffness * (end.deformation - committed.deformation);
        let force = before - before * forgotten + elastic * share;
        let lost = if ratio == 0.0 {
            0.0
        } else {
            // int F^2 dt / c with F = steady + (before - steady) exp(-t k / c).
            let steady = elastic / ratio;
            let fading = before - steady;
            let integral = steady * steady * ratio
                + 2.0 * steady * fading * forgotten
                + 0.5 * fading * fading * forgotten * (2.0 - forgotten);
            integral / self.stiffness
        };
        candidate.deformation = end.deformation;
        candidate.velocity = end.velocity;
        candidate.variables = [force, dissipated + lost];
        Response {
            force,
            by_deformation: self.stiffness * share,
            by_velocity: 0.0,
        }
    }
    fn force(&self, history: &History, _: Motion, given: &[f64]) -> Response {
        Response {
            force: variables(history, given)[0],
            ..Response::default()
        }
    }
    fn rates(&self, history: &History, motion: Motion, given: &[f64], rates: &mut [f64]) {
        let [force, _] = variables(history, given);
        if let [force_rate, dissipated_rate, ..] = rates {
            *force_rate = self.stiffness * (motion.velocity - force / self.damping);
            *dissipated_rate = force * force / self.damping;
        }
    }
    fn guards(&self, _: &History) -> Guards {
        Guards::default()
    }
    fn pass(&self, history: &mut History, _: Guard, motion: Motion, given: &[f64]) {
        self.accept(history, motion, given);
    }
    fn stored_energy(&self, history: &History, _: Motion, given: &[f64]) -> f64 {
        let [force, _] = variables(history, given);
        0.5 * force * force / self.stiffness
    }
    fn dissipated_energy(&self, history: &History, _: Motion, given: &[f64]) -> f64 {
        variables(history, given)[1]
    }
}
