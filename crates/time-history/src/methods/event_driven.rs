//! The event-driven exact method.

use super::taylor::Taylor;
use super::{Adaptive, Counts, Information, Method, Verdict};
use crate::building_rates::fastest_rate;
use crate::dynamics::Context;
use crate::polynomial::Polynomial;
use crate::rates::Rates;
use crate::system::System;

/// Product of rate and step that the series of the event-driven method takes at most.
pub(crate) const SERIES: f64 = 0.35;

/// Maximum product of rate and step for the Taylor series, for the fastest mode
/// and for the stiffest contact: the interpolant of degree 7, on which recorded samples
/// and the work of the damping rest, then errs by less than 3e-11 of the mode's amplitude,
/// and 1e-10 of the penetration.
const LONGEST: (f64, f64) = (SERIES, 0.4);

/// Contact-free motion by the exact step of the modes (`contact_free`), a Taylor series to
/// round-off while all closed contacts are affine and all storeys and links that follow
/// laws are on straight branches, the adaptive pair for the others.
#[derive(Debug, Clone)]
pub(crate) struct EventDriven {
    taylor: Taylor,
    pair: Adaptive,
    /// Rate of the fastest mode of all buildings (1/s).
    fastest: f64,
    /// Circular frequency of the stiffest closed contact (rad/s).
    contact: f64,
    by_series: bool,
    /// Whether no storey and no link has a memory, and whether all that have one are linear
    /// between changes of branch.
    linear: bool,
    piecewise_linear: bool,
    rates: Rates,
    /// Whether the next step can be a Taylor series.
    affine: bool,
}

impl EventDriven {
    pub(crate) fn new(system: &System, relative_tolerance: f64) -> Self {
        Self {
            taylor: Taylor::new(system),
            pair: Adaptive::new(system, relative_tolerance),
            fastest: fastest_rate(system.buildings()),
            contact: 0.0,
            by_series: false,
            linear: system.elements().is_empty(),
            piecewise_linear: system.first_curved_element().is_none(),
            rates: Rates::of_branches(system),
            affine: true,
        }
    }

    /// Shortest wavelength of what follows, and whether the series can follow it.
    fn look_at(&mut self, context: &Context<'_, '_>) {
        self.affine = self.piecewise_linear && Taylor::applies(context);
        self.contact = 0.0;
        if !self.affine {
            return;
        }
        for &l in context.contacts.closed() {
            let level = &context.dynamics.system.levels()[l];
            if let Some(contact) = context.contacts.contact(l) {
                let law = contact.force(level, 0.0, 0.0);
                let spring = (law.by_penetration.abs() / level.effective_mass).sqrt();
                let damper = law.by_velocity.abs() / level.effective_mass;
                self.contact = self.contact.max(spring).max(damper);
            }
        }
    }
}

impl Method for EventDriven {
    fn information(&self) -> Information {
        Information {
            name: "event_driven",
            title: match (self.linear, self.piecewise_linear) {
                (true, _) => "event-driven, exact between impacts",
                (_, true) => "event-driven, exact between events",
                _ => "event-driven, adaptive Runge-Kutta 8(5,3) between events",
            },
            order: pounding_runge_kutta::ORDER,
            implicit: false,
            adaptive: true,
        }
    }

    fn propose(&mut self, context: &Context<'_, '_>, tau: f64, state: &[f64]) -> f64 {
        self.look_at(context);
        if !self.affine {
            return self.pair.propose(context, tau, state);
        }
        let rest = context.segment.length - tau;
        let fastest = if self.linear {
            (self.fastest / LONGEST.0).max(self.contact / LONGEST.1)
        } else {
            self.rates.at(context, state) / LONGEST.0
        };
        let parts = (rest * fastest).ceil().max(1.0);
        rest / parts
    }

    fn trial(
        &mut self,
        context: &mut Context<'_, '_>,
        tau: f64,
        state: &[f64],
        step: f64,
        new_state: &mut [f64],
    ) -> Verdict {
        self.by_series = self.affine;
        if !self.by_series {
            return self.pair.trial(context, tau, state, step, new_state);
        }
        self.taylor.step(context, tau, state, step, new_state);
        self.taylor.rest(new_state);
        if new_state.iter().all(|x| x.is_finite()) {
            Verdict::Accept
        } else {
            Verdict::Retry(0.5 * step)
        }
    }

    fn prepare_interpolant(&mut self, context: &mut Context<'_, '_>, tau: f64) {
        if !self.by_series {
            self.pair.prepare_interpolant(context, tau);
        }
    }

    fn polynomial(&self, i: usize) -> &Polynomial {
        if self.by_series {
            self.taylor.polynomial(i)
        } else {
            self.pair.polynomial(i)
        }
    }

    fn accept(&mut self, cut: bool) {
        if self.by_series {
            self.pair.restart(true);
        } else {
            self.pair.accept(cut);
        }
    }

    fn restart(&mut self, smooth: bool) {
        self.pair.restart(smooth);
    }

    fn counts(&self) -> Counts {
        let pair = self.pair.counts();
        Counts {
            evaluations: pair.evaluations + self.taylor.terms(),
            ..pair
        }
    }

    fn flies(&self) -> bool {
        self.linear
    }
}
