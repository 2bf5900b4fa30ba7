//! The classical Runge-Kutta method of order 4 with a fixed step.

use super::{Counts, Information, Method, Verdict, step_to_grid};
use crate::dynamics::Context;
use crate::layout::Layout;
use crate::polynomial::{COEFFICIENTS, Polynomial, hermite};

/// Classical Runge-Kutta (Kutta 1901), fixed step cut at events, cubic Hermite
/// interpolation.
#[derive(Debug, Clone)]
pub(crate) struct RungeKutta4 {
    fixed: f64,
    step: f64,
    start: Vec<f64>,
    end: Vec<f64>,
    slopes: [Vec<f64>; 5],
    trial: Vec<f64>,
    dense: Vec<Polynomial>,
    evaluations: u64,
}

impl RungeKutta4 {
    pub(crate) fn new(layout: Layout, fixed: f64) -> Self {
        let n = layout.dimension();
        let empty = || vec![0.0; n];
        Self {
            fixed,
            step: 0.0,
            start: empty(),
            end: empty(),
            slopes: [empty(), empty(), empty(), empty(), empty()],
            trial: empty(),
            dense: vec![[0.0; COEFFICIENTS]; n],
            evaluations: 0,
        }
    }
}

impl Method for RungeKutta4 {
    fn information(&self) -> Information {
        Information {
            name: "runge_kutta_4",
            title: "classical Runge-Kutta, fixed step cut at events",
            order: 4,
            implicit: false,
            adaptive: false,
        }
    }

    fn propose(&mut self, context: &Context<'_, '_>, tau: f64, _state: &[f64]) -> f64 {
        step_to_grid(context.segment, tau, self.fixed)
    }

    fn trial(
        &mut self,
        context: &mut Context<'_, '_>,
        tau: f64,
        state: &[f64],
        step: f64,
        new_state: &mut [f64],
    ) -> Verdict {
        self.step = step;
        self.start.copy_from_slice(state);
        let half = 0.5 * step;
        let offsets = [0.0, half, half, step];
        for stage in 0..4 {
            let offset = offsets[stage];
            let (before, from) = self.slopes.split_at_mut(stage);
            match before.last() {
                None => self.trial.copy_from_slice(state),
                Some(slope) => {
                    for ((z, y), k) in self.trial.iter_mut().zip(state).zip(slope) {
                        *z = y + offset * k;
                    }
                }
            }
            let ground = context.segment.ground(tau + offset);
            context
                .dynamics
                .derivative(context.contacts, ground, &self.trial, &mut from[0]);
        }
        self.evaluations += 4;
        let [a, b, c, d, _] = &self.slopes;
        for (i, new) in new_state.iter_mut().enumerate() {
            *new = state[i] + step / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]);
        }
        self.end.copy_from_slice(new_state);
        Verdict::Accept
    }

    fn prepare_interpolant(&mut self, context: &mut Context<'_, '_>, tau: f64) {
        let ground = context.segment.ground(tau + self.step);
        context
            .dynamics
            .derivative(context.contacts, ground, &self.end, &mut self.slopes[4]);
        self.evaluations += 1;
        for (i, p) in self.dense.iter_mut().enumerate() {
            *p = hermite(
                self.step,
                self.start[i],
                self.end[i],
                self.slopes[0][i],
                self.slopes[4][i],
            );
        }
    }

    fn polynomial(&self, i: usize) -> &Polynomial {
        &self.dense[i]
    }

    fn accept(&mut self, _cut: bool) {}

    fn restart(&mut self, _smooth: bool) {}

    fn counts(&self) -> Counts {
        Counts {
            evaluations: self.evaluations,
            newton_iterations: 0,
        }
    }
}
