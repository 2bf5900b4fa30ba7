//! Finding the first event inside a trial step.
//!
//! Every event is a function that starts on a known side and fires when it
//! becomes positive. Penetrations and velocities are the step's own polynomials;
//! forces are fitted by a polynomial of the same degree at Chebyshev points, over parts of the step where
//! one for the whole does not follow them. The
//! search is certified by Bernstein coefficients (`polynomial`), so two crossings
//! inside one step are found as surely as one.

use pounding_gap_element::{Direction, Guard};
use pounding_hysteresis::Guard as LawGuard;

use crate::dynamics::{Context, Dynamics, Instant};
use crate::elements::guard_function;
use crate::layout::Layout;
use crate::methods::Method;
use crate::polynomial::{
    COEFFICIENTS, EXACT, Polynomial, difference, first_rise, first_rise_of, fit, fit_nodes, value,
};

/// What happens at a level, or to an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EventKind {
    /// An open gap closes.
    Close,
    /// A contact ends at zero penetration.
    Open,
    /// Transition of this number in the model's list for the present phase.
    Transition(usize),
    /// An element leaves its branch.
    Branch(LawGuard),
}

/// An event inside a trial step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Candidate {
    /// The level; for [`EventKind::Branch`] the element.
    pub level: usize,
    pub kind: EventKind,
    pub theta: f64,
}

/// Event search with its work space.
#[derive(Debug)]
pub(crate) struct Finder {
    pub candidates: Vec<Candidate>,
    /// Those of the search before, while they may still be wanted.
    pub others: Vec<Candidate>,
    nodes: [f64; COEFFICIENTS],
    state: Vec<f64>,
    acceleration: Vec<f64>,
    known: Known,
}

/// States and forces of all levels at places of one step, as far as they were asked for there: what holds one
/// level depends on all that are stuck.
#[derive(Debug)]
struct Known {
    /// Places, of which `count` are those of the step in hand.
    thetas: [f64; MOST_KNOWN],
    count: usize,
    /// State and forces at each of them, one after another; none for a level alone, which is asked for once.
    values: Vec<f64>,
    each: usize,
}

impl Known {
    fn new(layout: Layout) -> Self {
        let each = layout.motion() + layout.levels;
        let places = if layout.levels > 1 { MOST_KNOWN } else { 0 };
        Self {
            thetas: [0.0; MOST_KNOWN],
            count: 0,
            values: vec![0.0; places * each],
            each,
        }
    }

    /// State and forces at a place, if they are known.
    fn at(&self, theta: f64) -> Option<&[f64]> {
        let place = self.thetas[..self.count]
            .iter()
            .position(|known| *known == theta)?;
        Some(&self.values[place * self.each..][..self.each])
    }

    fn keep(&mut self, theta: f64, state: &[f64], forces: &[f64]) {
        if self.values.len() < (self.count + 1) * self.each {
            return;
        }
        let values = &mut self.values[self.count * self.each..][..self.each];
        let (states, rest) = values.split_at_mut(state.len());
        states.copy_from_slice(state);
        rest.copy_from_slice(forces);
        self.thetas[self.count] = theta;
        self.count += 1;
    }
}

/// Places of a step of which the forces are kept: those of a fit, and some at which a peak is looked at.
const MOST_KNOWN: usize = 2 * COEFFICIENTS;

impl Finder {
    pub(crate) fn new(layout: Layout) -> Self {
        Self {
            candidates: Vec::with_capacity(2 * layout.levels),
            others: Vec::with_capacity(2 * layout.levels),
            nodes: fit_nodes(),
            state: vec![0.0; layout.motion()],
            acceleration: vec![0.0; layout.dofs],
            known: Known::new(layout),
        }
    }

    /// Forgets the forces of the step before: another step, or other contacts, have others.
    pub(crate) fn forget(&mut self) {
        self.known.count = 0;
    }

    /// Collects the first event of every level and returns the earliest.
    /// Events for which `muted` holds do not count.
    pub(crate) fn find(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        (tau, step): (f64, f64),
        muted: impl Fn(Candidate) -> bool,
    ) -> Option<Candidate> {
        self.candidates.clear();
        self.forget();
        for level in 0..context.contacts.modes.len() {
            let mut first: Option<Candidate> = None;
            let kinds = kinds(context, level);
            for kind in kinds.into_iter().flatten() {
                let of_law = law_guard(context, method, level, kind);
                let of_law = of_law.map(|function| first_rise_of(function, EXACT));
                let rise = of_law.unwrap_or_else(|| {
                    first_rise(&self.guard(context, method, level, kind, tau, step))
                });
                let found = rise.map(|theta| Candidate { level, kind, theta });
                if let Some(found) = found.filter(|found| !muted(*found))
                    && first.is_none_or(|f| found.theta < f.theta)
                {
                    first = Some(found);
                }
            }
            self.candidates.extend(first);
        }
        if !method.information().implicit {
            self.find_branches(context, method, muted);
        }
        self.candidates
            .iter()
            .copied()
            .reduce(|a, b| if b.theta < a.theta { b } else { a })
    }

    /// Collects the first change of branch of every element.
    fn find_branches(
        &mut self,
        context: &Context<'_, '_>,
        method: &dyn Method,
        muted: impl Fn(Candidate) -> bool,
    ) {
        let Dynamics { system, layout, .. } = *context.dynamics;
        let memory = &context.contacts.elements;
        let elements = system.elements().iter().zip(&memory.histories);
        for (level, (element, history)) in elements.enumerate() {
            let turned = memory.turned[level];
            let mut first: Option<Candidate> = None;
            for guard in element.law.guards(history).into_iter().flatten() {
                let component = |i: usize| *method.polynomial(i);
                let theta = guard_function(element, history, guard, layout, component)
                    .map(|function| if turned { at_rest(function) } else { function })
                    .and_then(|function| first_rise(&function));
                let kind = EventKind::Branch(guard);
                let found = theta.map(|theta| Candidate { level, kind, theta });
                if let Some(found) = found.filter(|found| !muted(*found))
                    && first.is_none_or(|f| found.theta < f.theta)
                {
                    first = Some(found);
                }
            }
            self.candidates.extend(first);
        }
    }

    /// The function of theta that fires the event when it becomes positive.
    pub(crate) fn guard(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        level: usize,
        kind: EventKind,
        tau: f64,
        step: f64,
    ) -> Polynomial {
        if let Some(function) = law_guard(context, method, level, kind) {
            return fit(&self.nodes.map(function));
        }
        match kind {
            EventKind::Close => penetration(context, method, level),
            EventKind::Open => negated(penetration(context, method, level)),
            EventKind::Branch(guard) => {
                let Dynamics { system, layout, .. } = *context.dynamics;
                let history = &context.contacts.elements.histories[level];
                let component = |i: usize| *method.polynomial(i);
                guard_function(&system.elements()[level], history, guard, layout, component)
                    .unwrap_or([0.0; COEFFICIENTS])
            }
            EventKind::Transition(index) => {
                let system = context.dynamics.system;
                let Some(contact) = context.contacts.contact(level) else {
                    return [0.0; COEFFICIENTS];
                };
                let transition = system.levels()[level].model.transitions(contact.phase)[index];
                let function = match transition.guard {
                    // Those of the law are above.
                    Guard::Velocity | Guard::RawForce | Guard::Model(_) => {
                        velocity(context, method, level)
                    }
                    Guard::StickLower | Guard::StickUpper => {
                        let upper = transition.guard == Guard::StickUpper;
                        fit(&self.nodes.map(|x| {
                            self.stick_margin(context, method, level, upper, (tau, step, x))
                        }))
                    }
                };
                match transition.direction {
                    Direction::Rising => function,
                    Direction::Falling => negated(function),
                }
            }
        }
    }

    /// Holding force above the lower, or below the upper, bound of sticking.
    fn stick_margin(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        level: usize,
        upper: bool,
        place: (f64, f64, f64),
    ) -> f64 {
        let holding = self.force_at(context, method, level, place);
        let system = context.dynamics.system;
        let Some(contact) = context.contacts.contact(level) else {
            return 0.0;
        };
        let delta = context.contacts.penetration(system, level, &self.state);
        let (low, high) =
            system.levels()[level]
                .model
                .stick_range(&contact.collision, &contact.memory, delta);
        if upper { high - holding } else { holding - low }
    }

    /// Holding force of a level that is stuck, at `theta` of the step.
    pub(crate) fn force_at(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        level: usize,
        (tau, step, theta): (f64, f64, f64),
    ) -> f64 {
        if let Some(known) = self.known.at(theta) {
            let (state, forces) = known.split_at(self.state.len());
            self.state.copy_from_slice(state);
            context.dynamics.forces.copy_from_slice(forces);
            return forces[level];
        }
        for (i, y) in self.state.iter_mut().enumerate() {
            *y = value(method.polynomial(i), theta);
        }
        let ground = context.segment.ground(tau + theta * step);
        let (contacts, state) = (context.contacts, &self.state);
        if !context
            .dynamics
            .held_by_itself(contacts, ground, &|k| state[k])
        {
            let now = Instant::within(ground, method.information().implicit, theta * step);
            let out = &mut self.acceleration;
            context.dynamics.accelerations(contacts, now, state, out);
        }
        let forces = &context.dynamics.forces;
        if contacts.closed().len() > 1 {
            self.known.keep(theta, &self.state, forces);
        }
        forces[level]
    }
}

/// The function of an event that is one of the law's own, of penetration and velocity; `None` of others.
fn law_guard<'a>(
    context: &'a Context<'_, '_>,
    method: &dyn Method,
    level: usize,
    kind: EventKind,
) -> Option<impl Fn(f64) -> f64 + 'a> {
    let EventKind::Transition(index) = kind else {
        return None;
    };
    let contact = context.contacts.contact(level)?;
    let place = &context.dynamics.system.levels()[level];
    let transition = place.model.transitions(contact.phase)[index];
    if !matches!(transition.guard, Guard::RawForce | Guard::Model(_)) {
        return None;
    }
    let delta = penetration(context, method, level);
    let rate = velocity(context, method, level);
    Some(move |x: f64| {
        contact.transition_function(place, transition, value(&delta, x), value(&rate, x))
    })
}

/// A guard without what round-off of the velocity adds at a turning point.
fn at_rest(mut function: Polynomial) -> Polynomial {
    function[0] = function[0].min(0.0);
    function[1] = function[1].min(0.0);
    function
}

/// The events that a level can have in its present mode.
fn kinds(context: &Context<'_, '_>, level: usize) -> [Option<EventKind>; 4] {
    let Some(contact) = context.contacts.contact(level) else {
        return [Some(EventKind::Close), None, None, None];
    };
    let transitions = context.dynamics.system.levels()[level]
        .model
        .transitions(contact.phase);
    std::array::from_fn(|i| match i {
        0 => (!contact.is_stuck()).then_some(EventKind::Open),
        _ => (i <= transitions.len()).then(|| EventKind::Transition(i - 1)),
    })
}

/// Penetration of a level over the step.
pub(crate) fn penetration(
    context: &Context<'_, '_>,
    method: &dyn Method,
    level: usize,
) -> Polynomial {
    let mut p = relative(context, method, level, 0);
    p[0] -= context.contacts.width(level);
    p
}

/// Relative velocity of a level over the step.
pub(crate) fn velocity(context: &Context<'_, '_>, method: &dyn Method, level: usize) -> Polynomial {
    relative(context, method, level, context.dynamics.layout.dofs)
}

fn relative(
    context: &Context<'_, '_>,
    method: &dyn Method,
    level: usize,
    offset: usize,
) -> Polynomial {
    let level = &context.dynamics.system.levels()[level];
    let mut sum = match (level.left, level.right) {
        (Some(l), Some(r)) => {
            difference(method.polynomial(offset + l), method.polynomial(offset + r))
        }
        (Some(l), None) => *method.polynomial(offset + l),
        (None, Some(r)) => negated(*method.polynomial(offset + r)),
        (None, None) => [0.0; COEFFICIENTS],
    };
    let component = |i: usize| method.polynomial(offset + i);
    level.terms.add_polynomials(component, &mut sum);
    sum
}

fn negated(p: Polynomial) -> Polynomial {
    p.map(|c| -c)
}
