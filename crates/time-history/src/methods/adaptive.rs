//! The explicit pair of order 8(5,3) with dense output and error control.

use pounding_runge_kutta::Dop853;

use super::{Context, Counts, Information, Method, Verdict};
use crate::dynamics::Layout;
use crate::polynomial::Polynomial;

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
}

/// Sizes (m, m/s) below which a displacement or velocity is controlled
/// absolutely: a hundredth of a metre, a tenth of a metre per second.
const DISPLACEMENT_SIZE: f64 = 1.0e-2;
const VELOCITY_SIZE: f64 = 1.0e-1;

impl Adaptive {
    pub(crate) fn new(layout: Layout, relative_tolerance: f64) -> Self {
        Self {
            pair: Dop853::new(layout.dimension()),
            layout,
            relative_tolerance,
            next: 1.0e-3,
            last_norm: 0.0,
            step: 0.0,
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

    fn propose(&mut self, context: &Context<'_, '_>, tau: f64) -> f64 {
        let rest = context.segment.length - tau;
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
            } else {
                f64::INFINITY
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
        let wanted = self.step * Dop853::step_factor(self.last_norm);
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
        }
    }

    fn counts(&self) -> Counts {
        Counts {
            evaluations: self.pair.evaluations(),
            newton_iterations: 0,
        }
    }
}
