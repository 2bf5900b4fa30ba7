//! Peaks of absolute accelerations within fixed steps, where laws keep their branch: the second
//! derivative of an interpolant of low order departs from the equations of motion, by which histories
//! go, as much as a step is long.

use super::Peaks;
use super::branches::FAR;
use crate::dynamics::Context;
use crate::methods::Method;
use crate::polynomial::{Polynomial, absolute_maximum, bound, fit, fit_nodes};

impl Peaks {
    /// Takes in the absolute accelerations of floors, and the sums of them, all over a step.
    pub(super) fn accelerations_within(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        place: (f64, f64),
    ) {
        if !self.is_reached(context, method, place) {
            return;
        }
        let count = self.accelerations(context);
        let mut samples = std::mem::take(&mut self.samples);
        samples.resize(count, Polynomial::default());
        for (node, theta) in fit_nodes().into_iter().enumerate() {
            for (index, samples) in samples.iter_mut().enumerate() {
                samples[node] = self.signed_acceleration_at(context, method, (index, theta), place);
            }
        }
        for (index, samples) in samples.iter().enumerate() {
            for (theta, sample) in fit_nodes().iter().zip(samples) {
                self.raise_acceleration(context, index, sample.abs(), (*theta, place));
            }
            let present = self.present_acceleration(context, index);
            if let Some((theta, _)) = absolute_maximum(&fit(samples), present) {
                let exact = self.signed_acceleration_at(context, method, (index, theta), place);
                self.raise_acceleration(context, index, exact.abs(), (theta, place));
            }
        }
        self.samples = samples;
    }

    /// Whether an acceleration comes near to its peak in the step, by the interpolant.
    fn is_reached(
        &self,
        context: &Context<'_, '_>,
        method: &dyn Method,
        place: (f64, f64),
    ) -> bool {
        let dofs = context.dynamics.layout.dofs;
        let most = |a: &Polynomial| bound(a).max(bound(&a.map(|c| -c)));
        let of_floor = |i: usize| {
            let a = self.acceleration_polynomial(context, method, (i, dofs + i), place);
            most(&a) > FAR * self.storeys[i].acceleration_absolute.value
        };
        let mut rows = context.dynamics.system.acceleration_rows().iter();
        (0..self.storeys.len()).any(of_floor)
            || rows.any(|row| {
                let sum = self.sum_of_accelerations(context, method, row, place);
                most(&sum) > FAR * self.of_section(row.place).value
            })
    }
}
