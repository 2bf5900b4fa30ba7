//! The time-stepping scheme of Moreau and Jean for impacts without compliance.

use super::effective_mass::EffectiveMass;
use super::{Counts, Information, Method, Verdict, step_to_grid};
use crate::complementarity::Complementarity;
use crate::dynamics::{Context, push_apart};
use crate::layout::Layout;
use crate::polynomial::{COEFFICIENTS, Polynomial};
use crate::system::{Segment, System};

/// Moreau-Jean time stepping: the theta method for the storeys, Newton's law of
/// impact between the velocities at both ends of a step for every gap that the
/// motion closes by half the step. Nothing is located: an impact happens somewhere
/// inside its step, and floors overlap by up to a step's travel.
///
/// Sources: Moreau, Unilateral contact and dry friction in finite freedom dynamics,
/// 1988; Jean, Computer Methods in Applied Mechanics and Engineering 177 (1999) 235;
/// Acary and Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, 2008,
/// section 10.1.
#[derive(Debug)]
pub(crate) struct MoreauJean {
    fixed: f64,
    theta: f64,
    layout: Layout,
    step: f64,
    effective: EffectiveMass,
    /// Levels that may carry an impulse in this step.
    active: Vec<usize>,
    /// Impulse of every level (N s).
    impulses: Vec<f64>,
    /// Free change of the velocities, then their whole change.
    change: Vec<f64>,
    load: Vec<f64>,
    middle: Vec<f64>,
    scratch: Vec<f64>,
    net: Vec<f64>,
    matrix: Vec<f64>,
    right: Vec<f64>,
    problem: Complementarity,
    start: Vec<f64>,
    end: Vec<f64>,
    dense: Vec<Polynomial>,
}

impl MoreauJean {
    pub(crate) fn new(system: &System, fixed: f64, theta: f64) -> Self {
        let layout = Layout::of(system);
        let zeros = || vec![0.0; layout.dofs];
        Self {
            fixed,
            theta,
            layout,
            step: 0.0,
            effective: EffectiveMass::new(system),
            active: Vec::with_capacity(layout.levels),
            impulses: vec![0.0; layout.levels],
            change: zeros(),
            load: zeros(),
            middle: zeros(),
            scratch: zeros(),
            net: zeros(),
            matrix: Vec::new(),
            right: Vec::new(),
            problem: Complementarity::default(),
            start: vec![0.0; layout.dimension()],
            end: vec![0.0; layout.dimension()],
            dense: vec![[0.0; COEFFICIENTS]; layout.dimension()],
        }
    }

    /// Ground acceleration on a degree of freedom as the theta method weighs it (m/s2).
    fn ground(&self, system: &System, i: usize, (segment, tau): (&Segment, f64)) -> f64 {
        let on = |tau: f64| system.load_on(i, segment.ground(tau));
        (1.0 - self.theta) * on(tau) + self.theta * on(tau + self.step)
    }

    /// Change of the velocities without impulses: `(M + theta h C + theta^2 h^2 K) w =
    /// -h (C v + K (u + theta h v) + M 1 a_g)`.
    fn free_change(&mut self, context: &Context<'_, '_>, tau: f64, state: &[f64]) {
        let system = context.dynamics.system;
        let n = self.layout.dofs;
        let (u, v) = (&state[..n], &state[n..2 * n]);
        for i in 0..n {
            self.middle[i] = u[i] + self.theta * self.step * v[i];
        }
        system.internal_forces(&self.middle, v, &mut self.load, &mut self.scratch);
        for i in 0..n {
            let ground = self.ground(system, i, (context.segment, tau));
            self.change[i] = self.step * (self.load[i] - system.mass()[i] * ground);
        }
        self.effective.solve(system, &mut self.change);
    }

    /// Impulses of all gaps that half a step would close, solved together:
    /// `0 <= -(r + e r0) complementary to p >= 0` with the relative velocities `r0`
    /// and `r` (positive closing) at both ends of the step. False if there are none.
    fn impulses(&mut self, context: &Context<'_, '_>, state: &[f64]) -> bool {
        let system = context.dynamics.system;
        let n = self.layout.dofs;
        let (u, v) = (&state[..n], &state[n..2 * n]);
        let levels = system.levels();
        self.impulses.fill(0.0);
        self.active.clear();
        self.right.clear();
        for (l, level) in levels.iter().enumerate() {
            let closing = level.relative(v);
            let reached = context.contacts.penetration(system, l, u) + 0.5 * self.step * closing;
            if reached >= 0.0 {
                let restitution = level.model.rigid_restitution().unwrap_or(0.0);
                let free = closing + level.relative(&self.change);
                self.active.push(l);
                self.right.push(-(free + restitution * closing));
            }
        }
        if self.active.is_empty() {
            return true;
        }
        let size = self.active.len();
        self.matrix.resize(size * size, 0.0);
        for (column, &m) in self.active.iter().enumerate() {
            self.net.fill(0.0);
            push_apart(&levels[m], -1.0, &mut self.net);
            self.effective.solve(system, &mut self.net);
            for (row, &l) in self.active.iter().enumerate() {
                self.matrix[row * size + column] = levels[l].relative(&self.net);
            }
        }
        let Some(solution) = self.problem.solve(&self.matrix, &self.right) else {
            return false;
        };
        self.net.fill(0.0);
        for (&l, impulse) in self.active.iter().zip(solution) {
            self.impulses[l] = *impulse;
            push_apart(&levels[l], *impulse, &mut self.net);
        }
        self.effective.solve(system, &mut self.net);
        for (w, extra) in self.change.iter_mut().zip(&self.net) {
            *w += extra;
        }
        true
    }

    /// New state with the works over the step, which balance exactly for theta 1/2.
    fn finish(&mut self, context: &Context<'_, '_>, tau: f64, state: &[f64], new: &mut [f64]) {
        let system = context.dynamics.system;
        let (n, layout, h) = (self.layout.dofs, self.layout, self.step);
        for i in 0..n {
            self.middle[i] = state[n + i] + self.theta * self.change[i];
            new[i] = state[i] + h * self.middle[i];
            new[n + i] = state[n + i] + self.change[i];
        }
        new[2 * n..].copy_from_slice(&state[2 * n..]);
        system.damping_forces(&self.middle, &mut self.scratch);
        for i in 0..system.with_mass() {
            let ground = self.ground(system, i, (context.segment, tau));
            new[layout.input()] -= h * system.mass()[i] * self.middle[i] * ground;
            new[layout.viscous()] += h * self.middle[i] * self.scratch[i];
        }
        for (l, impulse) in self.impulses.iter().enumerate() {
            // The mean of both ends for every theta: what the jump itself takes away.
            let level = &system.levels()[l];
            let sum = level.relative(&state[n..2 * n]) + level.relative(&new[n..2 * n]);
            new[layout.work(l)] += 0.5 * impulse * sum;
            let of_ground = level.terms.ground_of(|i| state[n + i] + new[n + i]);
            new[layout.input()] += 0.5 * impulse * of_ground;
            new[layout.impulse(l)] += impulse;
        }
    }
}

impl Method for MoreauJean {
    fn information(&self) -> Information {
        Information {
            name: "moreau_jean",
            title: "Moreau-Jean time stepping, impacts not located",
            order: 1,
            implicit: true,
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
        let weight = self.theta * step;
        let system = context.dynamics.system;
        if !self.effective.factor(system, (weight, weight * weight)) {
            return Verdict::Retry(0.5 * step);
        }
        self.free_change(context, tau, state);
        if !self.impulses(context, state) {
            return Verdict::Retry(0.5 * step);
        }
        self.finish(context, tau, state, new_state);
        self.end.copy_from_slice(new_state);
        if new_state.iter().all(|x| x.is_finite()) {
            Verdict::Accept
        } else {
            Verdict::Retry(0.5 * step)
        }
    }

    /// Velocities are taken as linear, displacements as quadratic with the slope of
    /// the start; straight where an impulse makes a kink somewhere inside.
    fn prepare_interpolant(&mut self, _context: &mut Context<'_, '_>, _tau: f64) {
        let n = self.layout.dofs;
        let kink = self.impulses.iter().any(|p| *p > 0.0);
        for i in 0..self.layout.dimension() {
            let (a, b) = (self.start[i], self.end[i]);
            let slope = if i < n && !kink {
                self.step * self.start[n + i]
            } else {
                b - a
            };
            self.dense[i] = [0.0; COEFFICIENTS];
            self.dense[i][0] = a;
            self.dense[i][1] = slope;
            self.dense[i][2] = b - a - slope;
        }
    }

    fn polynomial(&self, i: usize) -> &Polynomial {
        &self.dense[i]
    }

    fn accept(&mut self, _cut: bool) {}

    fn restart(&mut self, _smooth: bool) {}

    fn counts(&self) -> Counts {
        Counts::default()
    }

    fn step_impulses(&self) -> Option<&[f64]> {
        Some(&self.impulses)
    }
}
