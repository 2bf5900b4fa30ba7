//! The implicit family: Newmark with any beta and gamma, and HHT-alpha.

mod forces;

use pounding_hysteresis::History;

use forces::Place;

use super::effective_mass::EffectiveMass;
use super::{Counts, Information, Method, Verdict, step_to_grid};
use crate::dynamics::{Context, Instant};
use crate::layout::Layout;
use crate::polynomial::{COEFFICIENTS, Polynomial, hermite};
use crate::small_solver::SmallSolver;
use crate::system::System;

/// Newton iterations allowed before the step is halved.
const MAXIMUM_ITERATIONS: usize = 30;
/// Relative change of the contact forces at which Newton has converged.
const NEWTON_TOLERANCE: f64 = 1.0e-13;

/// Newmark 1959 (beta, gamma) with the alpha weighting of Hilber, Hughes and
/// Taylor 1977 (alpha in -1/3..0; zero is plain Newmark).
///
/// The unknowns of a step are the contact forces, and what the forces of elements
/// (yielding storeys, links) depart from the matrices of the buildings: those are
/// condensed to their flexibility at the places of these forces, and Newton's method
/// solves `force = law(deformation, velocity)` with both partial derivatives of the law,
/// so that its tangent is the consistent one. Stuck levels take the place of the
/// law with `velocity = 0`.
#[derive(Debug, Clone)]
pub(crate) struct Newmark {
    information: Information,
    beta: f64,
    gamma: f64,
    alpha: f64,
    fixed: f64,
    layout: Layout,
    step: f64,
    effective: EffectiveMass,
    start: Vec<f64>,
    end: Vec<f64>,
    start_acceleration: Option<Vec<f64>>,
    first: Vec<f64>,
    last: Vec<f64>,
    predictor: Vec<f64>,
    velocity_predictor: Vec<f64>,
    load: Vec<f64>,
    net: Vec<f64>,
    scratch: Vec<f64>,
    places: Vec<Place>,
    start_forces: Vec<f64>,
    flexibility: Vec<f64>,
    /// Weights and places that the flexibility belongs to.
    condensed: (f64, f64),
    condensed_places: Vec<Place>,
    unknowns: Vec<f64>,
    change: Vec<f64>,
    matrix: Vec<f64>,
    solver: SmallSolver,
    dense: Vec<Polynomial>,
    newton_iterations: u64,
    candidate: Option<History>,
}

impl Newmark {
    /// Newmark's method with a fixed step (s).
    pub(crate) fn with_beta_gamma(system: &System, fixed: f64, beta: f64, gamma: f64) -> Self {
        let second = (gamma - 0.5).abs() < 1.0e-14;
        let information = Information {
            name: "newmark",
            title: "Newmark, fixed step cut at events",
            order: if second { 2 } else { 1 },
            implicit: true,
            adaptive: false,
        };
        Self::new(system, information, fixed, [beta, gamma, 0.0])
    }

    /// HHT-alpha with `beta = (1 - alpha)^2 / 4`, `gamma = 1/2 - alpha`.
    pub(crate) fn hht_alpha(system: &System, fixed: f64, alpha: f64) -> Self {
        let information = Information {
            name: "hht_alpha",
            title: "HHT-alpha, fixed step cut at events",
            order: 2,
            implicit: true,
            adaptive: false,
        };
        let beta = 0.25 * (1.0 - alpha) * (1.0 - alpha);
        Self::new(system, information, fixed, [beta, 0.5 - alpha, alpha])
    }

    fn new(system: &System, information: Information, fixed: f64, weights: [f64; 3]) -> Self {
        let layout = Layout::of(system);
        let zeros = || vec![0.0; layout.dofs];
        Self {
            information,
            beta: weights[0],
            gamma: weights[1],
            alpha: weights[2],
            fixed,
            layout,
            step: 0.0,
            effective: EffectiveMass::new(system),
            start: vec![0.0; layout.dimension()],
            end: vec![0.0; layout.dimension()],
            start_acceleration: None,
            first: zeros(),
            last: zeros(),
            predictor: zeros(),
            velocity_predictor: zeros(),
            load: zeros(),
            net: zeros(),
            scratch: zeros(),
            places: Vec::new(),
            start_forces: Vec::new(),
            flexibility: Vec::new(),
            condensed: (f64::NAN, f64::NAN),
            condensed_places: Vec::new(),
            unknowns: Vec::new(),
            change: Vec::new(),
            matrix: Vec::new(),
            solver: SmallSolver::default(),
            dense: vec![[0.0; COEFFICIENTS]; layout.dimension()],
            newton_iterations: 0,
            candidate: None,
        }
    }

    /// Accelerations and contact forces at the start of the step.
    fn start_up(&mut self, context: &mut Context<'_, '_>, tau: f64, state: &[f64]) {
        let n = self.layout.dofs;
        context.dynamics.accelerations(
            context.contacts,
            Instant::committed(context.segment.ground(tau)),
            state,
            &mut self.first,
        );
        self.places.clear();
        self.start_forces.clear();
        for &l in context.contacts.closed() {
            self.places.push(Place::Level(l));
            self.start_forces.push(context.dynamics.forces[l]);
        }
        for (e, element) in context.dynamics.system.elements().iter().enumerate() {
            let force = context
                .dynamics
                .element_force(context.contacts, e, state, None);
            self.places.push(Place::Element(e));
            self.start_forces
                .push(force - element.carried * element.relative(&state[..n]));
        }
        if let Some(a) = &self.start_acceleration {
            self.first.copy_from_slice(a);
        }
    }

    /// Right-hand side without the contact forces at the end of the step, and the
    /// free accelerations in `last`.
    fn free_accelerations(&mut self, context: &mut Context<'_, '_>, tau: f64, state: &[f64]) {
        let n = self.layout.dofs;
        let (h, beta, gamma, weight) = (self.step, self.beta, self.gamma, 1.0 + self.alpha);
        let system = context.dynamics.system;
        let (u, v) = (&state[..n], &state[n..2 * n]);
        for i in 0..n {
            let a = self.first[i];
            self.predictor[i] = u[i] + h * v[i] + h * h * (0.5 - beta) * a;
            self.velocity_predictor[i] = v[i] + h * (1.0 - gamma) * a;
        }
        let segment = context.segment;
        let ends = [segment.ground(tau), segment.ground(tau + h)];
        system.internal_forces(
            &self.predictor,
            &self.velocity_predictor,
            &mut self.load,
            &mut self.scratch,
        );
        for (i, (load, m)) in self.load.iter_mut().zip(system.mass()).enumerate() {
            let [start, end] = ends.map(|ground| system.load_on(i, ground));
            *load = weight * *load - m * (weight * end - self.alpha * start);
        }
        if self.alpha != 0.0 {
            system.internal_forces(u, v, &mut self.last, &mut self.scratch);
            self.net.fill(0.0);
            for (place, force) in self.places.iter().zip(&self.start_forces) {
                place.push(system, *force, &mut self.net);
            }
            for i in 0..n {
                self.load[i] -= self.alpha * (self.last[i] + self.net[i]);
            }
        }
        self.last.copy_from_slice(&self.load);
        self.effective.solve(system, &mut self.last);
    }

    /// Weights of damping and stiffness in the matrix of the step.
    fn weights(&self) -> (f64, f64) {
        let (weight, step) = (1.0 + self.alpha, self.step);
        (weight * self.gamma * step, weight * self.beta * step * step)
    }

    /// Displacements, velocities and the energy integrals at the end of the step.
    ///
    /// The integrals are the trapezoidal works over the step, with which the
    /// average acceleration rule (beta 1/4, gamma 1/2) balances exactly
    /// (Hughes, The Finite Element Method, 1987, section 9.4); what other
    /// parameters lose or gain shows as the residual.
    fn finish(&mut self, context: &mut Context<'_, '_>, tau: f64, state: &[f64], new: &mut [f64]) {
        let n = self.layout.dofs;
        let (h, layout, system) = (self.step, self.layout, context.dynamics.system);
        for i in 0..n {
            new[i] = self.predictor[i] + self.beta * h * h * self.last[i];
            new[n + i] = self.velocity_predictor[i] + self.gamma * h * self.last[i];
        }
        new[2 * n..].copy_from_slice(&state[2 * n..]);
        let segment = context.segment;
        let ends = [segment.ground(tau), segment.ground(tau + h)];
        for i in 0..n {
            self.predictor[i] = 0.5 * (state[n + i] + new[n + i]);
        }
        system.damping_forces(&self.predictor, &mut self.scratch);
        let (mut input, mut viscous) = (0.0, 0.0);
        for i in 0..system.with_mass() {
            let [start, end] = ends.map(|ground| system.load_on(i, ground));
            let ground = 0.5 * (start + end);
            let moved = new[i] - state[i];
            input -= system.mass()[i] * moved * ground;
            viscous += moved * self.scratch[i];
        }
        new[layout.input()] += input;
        new[layout.viscous()] += viscous;
        for (k, &l) in context.contacts.closed().iter().enumerate() {
            let level = &system.levels()[l];
            let mean = 0.5 * (self.start_forces[k] + self.unknowns[k]);
            let closed_in = level.relative(&new[..n]) - level.relative(&state[..n]);
            new[layout.work(l)] += mean * closed_in;
            new[layout.impulse(l)] += mean * h;
            new[layout.input()] += mean * level.terms.ground_of(|i| new[i] - state[i]);
        }
        let closed = context.contacts.closed().len();
        for (k, element) in system.elements().iter().enumerate() {
            let moved = element.terms.ground_of(|i| new[i] - state[i]);
            if moved != 0.0 {
                let k = closed + k;
                new[layout.input()] += 0.5 * (self.start_forces[k] + self.unknowns[k]) * moved;
            }
        }
    }
}

impl Method for Newmark {
    fn information(&self) -> Information {
        self.information
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
        let system = context.dynamics.system;
        let weight = 1.0 + self.alpha;
        if !self.effective.factor(system, self.weights()) {
            return Verdict::Retry(0.5 * step);
        }
        self.start_up(context, tau, state);
        self.free_accelerations(context, tau, state);
        if !self.places.is_empty() {
            if !self.unknown_forces(context) {
                return Verdict::Retry(0.5 * step);
            }
            self.net.fill(0.0);
            for (place, force) in self.places.iter().zip(&self.unknowns) {
                place.push(system, *force, &mut self.net);
            }
            for i in 0..self.layout.dofs {
                self.last[i] = self.load[i] + weight * self.net[i];
            }
            self.effective.solve(system, &mut self.last);
        }
        self.finish(context, tau, state, new_state);
        self.end.copy_from_slice(new_state);
        if new_state.iter().all(|x| x.is_finite()) {
            Verdict::Accept
        } else {
            Verdict::Retry(0.5 * step)
        }
    }

    fn prepare_interpolant(&mut self, _context: &mut Context<'_, '_>, _tau: f64) {
        let n = self.layout.dofs;
        let (h, y, z) = (self.step, &self.start, &self.end);
        for i in 0..n {
            self.dense[i] = hermite(h, y[i], z[i], y[n + i], z[n + i]);
            self.dense[n + i] = hermite(h, y[n + i], z[n + i], self.first[i], self.last[i]);
        }
        for i in 2 * n..self.layout.dimension() {
            self.dense[i] = [0.0; COEFFICIENTS];
            self.dense[i][0] = y[i];
            self.dense[i][1] = z[i] - y[i];
        }
    }

    fn polynomial(&self, i: usize) -> &Polynomial {
        &self.dense[i]
    }

    fn accept(&mut self, _cut: bool) {
        match &mut self.start_acceleration {
            Some(a) => a.copy_from_slice(&self.last),
            None => self.start_acceleration = Some(self.last.clone()),
        }
    }

    fn restart(&mut self, _smooth: bool) {
        self.start_acceleration = None;
    }

    fn counts(&self) -> Counts {
        Counts {
            evaluations: 0,
            newton_iterations: self.newton_iterations,
        }
    }
}
