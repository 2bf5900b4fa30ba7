//! Elements with memory: storeys that yield, and links between floors.
//!
//! An element pulls together two places, the *far* one, whose displacement makes its
//! deformation greater, and the *near* one. The matrices of the buildings carry the
//! initial stiffness of a storey already, so that an element adds only what its law
//! departs from that.

use std::sync::Arc;

use pounding_hysteresis::{Guard, History, HysteresisLaw, Motion, Response};

use crate::dynamics::Layout;
use crate::polynomial::{COEFFICIENTS, Polynomial, difference};
use crate::system::{LevelPlace, System, Terms};

/// Where an element sits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ElementPlace {
    /// The storey of a building, both from zero.
    Storey {
        /// Index in [`System::buildings`].
        building: usize,
        /// Storey from the bottom.
        storey: usize,
    },
    /// A level of a link, both from zero.
    Link {
        /// Index in [`System::links`].
        link: usize,
        /// Level within the link, from the bottom.
        level: usize,
    },
}

impl ElementPlace {
    /// Whether it is a storey of this building.
    pub(crate) fn is_in(self, of: usize) -> bool {
        matches!(self, Self::Storey { building, .. } if building == of)
    }
}

/// A storey or a level of a link whose force follows a law with memory.
#[derive(Debug, Clone)]
pub struct Element {
    /// Where it sits.
    pub place: ElementPlace,
    /// Degree of freedom whose displacement deforms the element positively; `None`
    /// moves with the ground.
    pub far: Option<usize>,
    /// Degree of freedom at the other end; `None` moves with the ground.
    pub near: Option<usize>,
    /// What the deformation holds beside both ends: of a storey the motion of a foundation.
    pub(crate) terms: Terms,
    /// Storeys and elevations of both ends of a level of a link.
    pub(crate) level_place: Option<LevelPlace>,
    /// The law: force (N) of the deformation far minus near (m).
    pub law: Arc<dyn HysteresisLaw>,
    /// Deformation (m) at which it begins to yield, if its law has one.
    pub yield_deformation: Option<f64>,
    /// Part of its stiffness that the matrices carry (N/m).
    pub(crate) carried: f64,
    /// Place of its first internal variable among all.
    pub(crate) first_variable: usize,
}

impl Element {
    /// Far minus near of any quantity given per degree of freedom.
    pub(crate) fn relative(&self, x: &[f64]) -> f64 {
        let at = |dof: Option<usize>| dof.map_or(0.0, |i| x[i]);
        let of_ends = at(self.far) - at(self.near);
        if self.terms.is_empty() {
            return of_ends;
        }
        of_ends + self.terms.sum_of(|i| x[i])
    }

    pub(crate) fn motion(&self, u: &[f64], v: &[f64]) -> Motion {
        Motion {
            deformation: self.relative(u),
            velocity: self.relative(v),
        }
    }

    /// Where its internal variables stand in the state.
    pub(crate) fn range(&self, layout: Layout) -> std::ops::Range<usize> {
        let first = 2 * layout.dofs + self.first_variable;
        first..first + self.law.internal_variables()
    }

    /// Adds a force that pulls its ends together.
    pub(crate) fn pull(&self, force: f64, net: &mut [f64]) {
        if let Some(i) = self.far {
            net[i] -= force;
        }
        if let Some(i) = self.near {
            net[i] += force;
        }
        self.terms.push(force, net);
    }

    /// Its deformation (offset zero) or the rate of it (offset of the velocities). What is
    /// round-off of the motions of its ends, which may be far greater, is left out.
    pub(crate) fn polynomial(
        &self,
        component: impl Fn(usize) -> Polynomial,
        offset: usize,
    ) -> Polynomial {
        let at = |dof: Option<usize>| dof.map_or([0.0; COEFFICIENTS], |i| component(offset + i));
        let (far, near) = (at(self.far), at(self.near));
        let largest = far.iter().chain(&near).fold(0.0_f64, |m, c| m.max(c.abs()));
        let mut p = difference(&far, &near);
        for (i, w) in self.terms.pushed.iter().chain(&self.terms.ground) {
            for (sum, c) in p.iter_mut().zip(component(offset + i)) {
                *sum += w * c;
            }
        }
        for c in &mut p[1..] {
            if c.abs() < ROUND_OFF * largest {
                *c = 0.0;
            }
        }
        p
    }

    /// Law of the element at a state. Within a step of a method that locates events,
    /// and at its ends, the branch in the history is held (`elapsed` is `None`);
    /// within a step of one that does not, the law is followed over the `elapsed`
    /// seconds since the history was committed.
    pub(crate) fn response(
        &self,
        history: &History,
        scratch: &mut History,
        (motion, variables): (Motion, &[f64]),
        elapsed: Option<f64>,
    ) -> Response {
        match elapsed {
            Some(step) => self.law.trial(history, scratch, motion, step),
            None => self.law.force(history, motion, variables),
        }
    }
}

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

/// Round-off of a coefficient over the largest of the motions that it is made from.
const ROUND_OFF: f64 = 32.0 * f64::EPSILON;

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
