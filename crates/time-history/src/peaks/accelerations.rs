//! Absolute accelerations at any place in a step, by the equations of motion: of all floors, and behind
//! them of all sums of them, by one index.

use super::Peaks;
use crate::dynamics::Context;
use crate::methods::Method;

impl Peaks {
    /// How many there are.
    pub(super) fn accelerations(&self, context: &Context<'_, '_>) -> usize {
        self.storeys.len() + context.dynamics.system.acceleration_rows().len()
    }

    /// The present peak of one.
    pub(super) fn present_acceleration(&self, context: &Context<'_, '_>, index: usize) -> f64 {
        match index.checked_sub(self.storeys.len()) {
            None => self.storeys[index].acceleration_absolute.value,
            Some(row) => {
                let row = &context.dynamics.system.acceleration_rows()[row];
                self.of_section(row.place).value
            }
        }
    }

    /// Raises it, at a place in a step: theta, then tau and step length (s).
    pub(super) fn raise_acceleration(
        &mut self,
        context: &Context<'_, '_>,
        index: usize,
        value: f64,
        (theta, (tau, step)): (f64, (f64, f64)),
    ) {
        let time = context.segment.start + tau + theta * step;
        match index.checked_sub(self.storeys.len()) {
            None => {
                let peak = &mut self.storeys[index].acceleration_absolute;
                peak.raise(value, time);
            }
            Some(row) => {
                let row = &context.dynamics.system.acceleration_rows()[row];
                self.raise_section(row.place, value, time);
            }
        }
    }

    /// The acceleration at a place in the step.
    pub(super) fn signed_acceleration_at(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        (index, theta): (usize, f64),
        (tau, step): (f64, f64),
    ) -> f64 {
        let known = match theta {
            0.0 => 0,
            1.0 => 1,
            _ => 2,
        };
        self.evaluate_at(context, method, (tau, step), (known, theta));
        let system = context.dynamics.system;
        let ground = context.segment.ground(tau + theta * step);
        let own = |i: usize| self.acceleration[known][i] + system.ground_on(i, ground);
        match index.checked_sub(self.storeys.len()) {
            None => own(index),
            Some(row) => {
                let row = &system.acceleration_rows()[row];
                row.terms().map(|(i, w)| w * own(i)).sum::<f64>()
            }
        }
    }
}
