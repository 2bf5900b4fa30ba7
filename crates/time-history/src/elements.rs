//! Histories of storeys and links that follow a law with memory, and when they leave their branches.

use pounding_hysteresis::{Guard, History, Motion};

use crate::layout::Layout;
use crate::polynomial::Polynomial;
use crate::system::{Element, System};

/// Histories of all elements.
#[derive(Debug, Clone, Default)]
pub(crate) struct Elements {
    pub histories: Vec<History>,
    /// Which elements turned at this very instant: their velocity is zero but for
    /// round-off, which must not lead them over the ends of their new branch.
    pub turned: Vec<bool>,
    /// How often each element changed its branch at this very instant.
    pub changes: Vec<usize>,
    /// Since when (s) each element has been without strength for ever, and whether any may lose it.
    pub lost: Vec<Option<f64>>,
    may_lose: bool,
}

/// Speed (m/s) below which an element stands still over a step, as between floors in
/// lasting contact: what moves it there is round-off.
const STANDSTILL: f64 = 1.0e-11;

/// Part of its own scale beyond which a guard counts as passed after a jump.
const PASSED: f64 = 1.0e-12;

/// Changes of branch at one instant before an element is left where it is.
const BRANCHES_AT_ONCE: usize = 64;

impl Elements {
    pub(crate) fn new(system: &System) -> Self {
        Self {
            histories: system.elements().iter().map(|e| e.law.virgin()).collect(),
            turned: vec![false; system.elements().len()],
            changes: vec![0; system.elements().len()],
            lost: vec![None; system.elements().len()],
            may_lose: (system.elements().iter()).any(|e| e.law.may_lose_all_strength()),
        }
    }

    /// Puts the elements where the buildings start. Laws that hold a lasting load were led there
    /// straight and infinitely slowly, those whose force also depends on the rate too; what is
    /// due to the rate alone has relaxed, so that viscous elements start unloaded.
    pub(crate) fn begin(&mut self, system: &System, layout: Layout, state: &mut [f64]) {
        let n = layout.dofs;
        for (element, history) in system.elements().iter().zip(&mut self.histories) {
            let motion = element.motion(&state[..n], &state[n..2 * n]);
            if element.law.holds_static_load() && motion.deformation != 0.0 {
                let mut led = history.clone();
                let end = if element.law.descriptor().rate_dependent {
                    Motion {
                        velocity: 0.0,
                        ..motion
                    }
                } else {
                    motion
                };
                element.law.trial(history, &mut led, end, 1.0);
                history.commit(&mut led);
            }
            let variables: Vec<f64> = history.variables().to_vec();
            element.law.accept(history, motion, &variables);
            state[element.range(layout)].copy_from_slice(&variables);
        }
        self.settle(system, layout, state);
    }

    /// Takes an accepted state in. `step` is the length of the step (s) for a method
    /// that does not locate the events of elements; the internal variables of the state
    /// are then those of the law's own step.
    pub(crate) fn accept(
        &mut self,
        (system, layout): (&System, Layout),
        scratch: &mut Option<History>,
        state: &mut [f64],
        step: Option<f64>,
    ) {
        let n = layout.dofs;
        for (element, history) in system.elements().iter().zip(&mut self.histories) {
            let motion = element.motion(&state[..n], &state[n..2 * n]);
            let range = element.range(layout);
            match step {
                None => element.law.accept(history, motion, &state[range]),
                Some(step) => {
                    let candidate = scratch.get_or_insert_with(|| history.clone());
                    element.law.trial(history, candidate, motion, step);
                    history.commit(candidate);
                    state[range].copy_from_slice(history.variables());
                }
            }
        }
    }

    /// Notes which elements have lost all their strength by this time (s).
    pub(crate) fn note_lost(&mut self, system: &System, time: f64) {
        if !self.may_lose {
            return;
        }
        let elements = system.elements().iter().zip(&self.histories);
        for ((element, history), lost) in elements.zip(&mut self.lost) {
            if lost.is_none() && element.law.has_lost_all_strength(history) {
                *lost = Some(time);
            }
        }
    }

    /// Takes a state in, on the branches on which the elements are.
    pub(crate) fn take_in(&mut self, system: &System, layout: Layout, state: &[f64]) {
        let n = layout.dofs;
        for (element, history) in system.elements().iter().zip(&mut self.histories) {
            let motion = element.motion(&state[..n], &state[n..2 * n]);
            let variables = &state[element.range(layout)];
            element.law.accept(history, motion, variables);
        }
    }

    /// Takes a state in that a jump of velocities led to, and passes the guards that it
    /// left behind.
    pub(crate) fn settle(&mut self, system: &System, layout: Layout, state: &[f64]) {
        self.take_in(system, layout, state);
        let n = layout.dofs;
        for (element, history) in system.elements().iter().zip(&mut self.histories) {
            let motion = element.motion(&state[..n], &state[n..2 * n]);
            let variables = &state[element.range(layout)];
            for _ in 0..BRANCHES_AT_ONCE {
                let fired = element
                    .law
                    .guards(history)
                    .into_iter()
                    .flatten()
                    .find(|guard| passed(element, history, *guard, (motion, variables)));
                let Some(guard) = fired else { break };
                element.law.pass(history, guard, motion, variables);
            }
        }
    }

    /// Recoverable and dissipated energy of all elements (J); `elapsed` as in
    /// [`Element::response`].
    pub(crate) fn energy(
        &self,
        (system, layout): (&System, Layout),
        state: &[f64],
        elapsed: Option<f64>,
    ) -> (f64, f64) {
        let (mut stored, mut dissipated) = (0.0, 0.0);
        for index in 0..self.histories.len() {
            let (s, d) = self.energy_of(index, (system, layout), state, elapsed);
            stored += s;
            dissipated += d;
        }
        (stored, dissipated)
    }

    /// The same of one element.
    pub(crate) fn energy_of(
        &self,
        index: usize,
        (system, layout): (&System, Layout),
        state: &[f64],
        elapsed: Option<f64>,
    ) -> (f64, f64) {
        let n = layout.dofs;
        let element = &system.elements()[index];
        let history = &self.histories[index];
        let motion = element.motion(&state[..n], &state[n..2 * n]);
        let both = |history: &History, variables: &[f64]| {
            (
                element.law.stored_energy(history, motion, variables),
                element.law.dissipated_energy(history, motion, variables),
            )
        };
        match elapsed {
            None => both(history, &state[element.range(layout)]),
            Some(step) => {
                let mut then = history.clone();
                element.law.trial(history, &mut then, motion, step);
                both(&then, then.variables())
            }
        }
    }
}

fn passed(
    element: &Element,
    history: &History,
    guard: Guard,
    (motion, variables): (Motion, &[f64]),
) -> bool {
    let size = match guard {
        Guard::Turning => 0.1,
        Guard::Above | Guard::Below => motion.deformation.abs().max(1.0e-9),
        Guard::Faster | Guard::Slower => motion.velocity.abs().max(1.0e-9),
        Guard::Variable(_) => 1.0e-3,
    };
    element.law.guard(history, guard, motion, variables) > PASSED * size
}

/// The function of theta that becomes positive where the guard fires; `None` if the
/// element stands still.
pub(crate) fn guard_function(
    element: &Element,
    history: &History,
    guard: Guard,
    layout: Layout,
    component: impl Fn(usize) -> Polynomial,
) -> Option<Polynomial> {
    let velocity = element.polynomial(&component, layout.dofs);
    if velocity.iter().map(|c| c.abs()).sum::<f64>() < STANDSTILL {
        return None;
    }
    let function = match guard {
        Guard::Variable(i) => component(element.range(layout).start + usize::from(i)),
        Guard::Above | Guard::Below => element.polynomial(component, 0),
        Guard::Turning | Guard::Faster | Guard::Slower => velocity,
    };
    // Guards are affine in the one quantity that they watch.
    let at = |x: f64| {
        let (mut motion, mut variables) = (Motion::default(), [0.0; 2]);
        match guard {
            Guard::Variable(i) => variables[usize::from(i)] = x,
            Guard::Above | Guard::Below => motion.deformation = x,
            Guard::Turning | Guard::Faster | Guard::Slower => motion.velocity = x,
        }
        element.law.guard(history, guard, motion, &variables)
    };
    let first = at(function[0]);
    if !first.is_finite() {
        return None;
    }
    let slope = (at(1.0) - at(-1.0)).signum();
    let mut out = function.map(|c| slope * c);
    out[0] = first;
    Some(out)
}
