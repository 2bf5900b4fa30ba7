//! The explicit pair of order 8(5,3) with dense output and error control.

use pounding_gap_element::APPROACH_VELOCITY_FLOOR;
use pounding_runge_kutta::Dop853;

use super::{Counts, Information, Method, Verdict};
use crate::dynamics::Context;
use crate::layout::Layout;
use crate::polynomial::Polynomial;
use crate::rates::Rates;
use crate::system::System;

/// First step (s) after a closure whose force starts like a power of the
/// penetration; error control takes over from there.
const SINGULAR_START: f64 = 1.0e-8;

/// Adaptive explicit Runge-Kutta of order 8(5,3), Dormand and Prince (Hairer,
/// Norsett and Wanner 1993, section II.5).
#[derive(Debug, Clone)]
pub(crate) struct Adaptive {
    pair: Dop853,
    layout: Layout,
    relative_tolerance: f64,
    next: f64,
    last_norm: f64,
    step: f64,
    /// Time (s) since the last start like a power of time, while it matters.
    since: Option<f64>,
    /// Sizes of the internal variables of elements, in their units.
    sizes: Vec<f64>,
    rates: Rates,
}

/// Maximum product of a step and of the fastest rate. The pair is stable in the left half
/// of the disc of radius 5.96. Beyond it whatever is faster than the step grows up to the
/// tolerance and stays there as noise, with its own changes of sign and events, which a
/// control of errors cannot see.
const STABLE: f64 = 5.0;

/// Growth of a step beyond what error control asks for, after such a start.
const LARGEST_GROWTH: f64 = 2.0;

/// Part of the time to the end of a contact that a step may take, and the change of
/// velocity by what force is left, in allowed errors, that an end may have.
const CLEAR: f64 = 0.65;
const NEGLIGIBLE_CHANGE: f64 = 2.0e3;

/// Sizes (m, m/s) below which a displacement or velocity is controlled
/// absolutely: a hundredth of a metre, a tenth of a metre per second.
const DISPLACEMENT_SIZE: f64 = 1.0e-2;
const VELOCITY_SIZE: f64 = 1.0e-1;

impl Adaptive {
    pub(crate) fn new(system: &System, relative_tolerance: f64) -> Self {
        let layout = Layout::of(system);
        Self {
            pair: Dop853::new(layout.dimension()),
            layout,
            relative_tolerance,
            next: 1.0e-3,
            last_norm: 0.0,
            step: 0.0,
            since: None,
            sizes: system
                .elements()
                .iter()
                .flat_map(|e| {
                    let sizes = e.law.variable_sizes();
                    sizes.into_iter().take(e.law.internal_variables())
                })
                .collect(),
            rates: Rates::new(system),
        }
    }
}

impl Adaptive {
    /// Longest step (s) that stays clear of the ends of contacts whose force ends like
    /// a power of the penetration: near such an end steps are as long as it is away,
    /// until what is left of the force does not matter.
    fn before_the_end(&self, context: &Context<'_, '_>, state: &[f64]) -> f64 {
        let n = self.layout.dofs;
        let system = context.dynamics.system;
        let mut longest = f64::INFINITY;
        for &l in context.contacts.closed() {
            let level = &system.levels()[l];
            let Some(contact) = context.contacts.contact(l) else {
                continue;
            };
            let velocity = level.relative(&state[n..2 * n]);
            if contact.is_stuck() || level.model.smooth_at_closure() || velocity >= 0.0 {
                continue;
            }
            let delta = context.contacts.penetration(system, l, &state[..n]);
            let left = delta / -velocity;
            let force = contact.force(level, delta, velocity).value;
            let change = force.abs() / level.effective_mass * left;
            if change > NEGLIGIBLE_CHANGE * self.relative_tolerance * VELOCITY_SIZE {
                longest = longest.min(CLEAR * left);
            }
        }
        longest
    }

    /// Size of an energy integral or of an impulse: the impulse and the work of a contact
    /// are held to those of the level so far, or to what its floors bring along with their
    /// approach velocity, whichever is greater. Stiff contacts move too little for the
    /// sizes of displacements and velocities to tell anything of their forces.
    fn integral_size(&self, context: &Context<'_, '_>, i: usize, value: f64) -> f64 {
        if i < self.layout.work(0) {
            return f64::INFINITY;
        }
        let place = i - self.layout.work(0);
        let l = place % self.layout.levels;
        match context.contacts.contact(l) {
            Some(contact) if !contact.is_stuck() => {
                let mass = context.dynamics.system.levels()[l].effective_mass;
                let velocity = contact.collision.approach_velocity;
                let velocity = velocity.max(APPROACH_VELOCITY_FLOOR);
                let is_work = place < self.layout.levels;
                let brought = mass * velocity * if is_work { velocity } else { 1.0 };
                brought + value.abs()
            }
            _ => f64::INFINITY,
        }
    }
}

impl Method for Adaptive {
    fn information(&self) -> Information {
        Information {
            name: "adaptive",
            title: "adaptive explicit Runge-Kutta 8(5,3) with dense output",
            order: pounding_runge_kutta::ORDER,
            implicit: false,
            adaptive: true,
        }
    }

    fn propose(&mut self, context: &Context<'_, '_>, tau: f64, state: &[f64]) -> f64 {
        let rest = context.segment.length - tau;
        let stable = STABLE / self.rates.at(context, state);
        let end = self.before_the_end(context, state).min(stable);
        if self.next > end {
            return end.min(rest);
        }
        if self.next >= rest * (1.0 - 1.0e-9) {
            rest
        } else if self.next > 0.5 * rest {
            0.5 * rest
        } else {
            self.next
        }
    }

    fn trial(
        &mut self,
        context: &mut Context<'_, '_>,
        tau: f64,
        state: &[f64],
        step: f64,
        new_state: &mut [f64],
    ) -> Verdict {
        let (segment, contacts) = (context.segment, context.contacts);
        let dynamics = &mut *context.dynamics;
        self.pair.step(
            &mut |offset: f64, y: &[f64], dy: &mut [f64]| {
                dynamics.derivative(contacts, segment.ground(tau + offset), y, dy);
            },
            state,
            step,
            new_state,
        );
        self.step = step;
        let n = self.layout.dofs;
        let tolerance = self.relative_tolerance;
        self.last_norm = self.pair.error_norm(|i| {
            if i < n {
                tolerance * (DISPLACEMENT_SIZE + state[i].abs().max(new_state[i].abs()))
            } else if i < 2 * n {
                tolerance * (VELOCITY_SIZE + state[i].abs().max(new_state[i].abs()))
            } else if i < self.layout.motion() {
                let size = self.sizes[i - 2 * n];
                tolerance * (size + state[i].abs().max(new_state[i].abs()))
            } else {
                tolerance * self.integral_size(context, i, new_state[i])
            }
        });
        if self.last_norm <= 1.0 {
            Verdict::Accept
        } else {
            let shorter = step * Dop853::step_factor(self.last_norm).min(0.9);
            self.next = shorter;
            Verdict::Retry(shorter)
        }
    }

    fn prepare_interpolant(&mut self, context: &mut Context<'_, '_>, tau: f64) {
        let (segment, contacts) = (context.segment, context.contacts);
        let dynamics = &mut *context.dynamics;
        self.pair
            .prepare_dense(&mut |offset: f64, y: &[f64], dy: &mut [f64]| {
                dynamics.derivative(contacts, segment.ground(tau + offset), y, dy);
            });
    }

    fn polynomial(&self, i: usize) -> &Polynomial {
        self.pair.polynomial(i)
    }

    fn accept(&mut self, cut: bool) {
        self.pair.advance();
        let mut wanted = self.step * Dop853::step_factor(self.last_norm);
        if let Some(since) = self.since {
            // The further from the start, the longer a step with the same error.
            let growth = (since + self.step) / since;
            wanted *= growth.min(LARGEST_GROWTH);
            self.since = (growth > 1.1 || since == 0.0).then_some(since + self.step);
        }
        // A step cut by an event or a sample says nothing against a longer one.
        if cut || self.step < self.next {
            self.next = self.next.max(wanted);
        } else {
            self.next = wanted;
        }
    }

    fn restart(&mut self, smooth: bool) {
        self.pair.invalidate();
        if !smooth {
            self.next = SINGULAR_START;
            self.since = Some(0.0);
        }
    }

    fn counts(&self) -> Counts {
        Counts {
            evaluations: self.pair.evaluations(),
            newton_iterations: 0,
        }
    }
}
