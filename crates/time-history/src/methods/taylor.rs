//! Taylor series of a system that is linear between events: buildings with all closed
//! contacts affine, and storeys and links on straight branches of their laws.

use super::chain::{Chain, Spring, Sums, TERMS};
use super::modal_series::ModalSeries;
use pounding_hysteresis::{MAXIMUM_INTERNAL_VARIABLES, Motion};

use crate::dynamics::Context;
use crate::layout::Layout;
use crate::polynomial::{COEFFICIENTS, GAUSS, Polynomial, fit, fit_nodes, septic, value};
use crate::system::System;

/// Work space of the series.
#[derive(Debug, Clone)]
pub(crate) struct Taylor {
    layout: Layout,
    /// Present term of displacements and velocities.
    term: Vec<f64>,
    /// Three derivatives of the velocities with respect to theta at both ends.
    start: [Vec<f64>; 3],
    end: [Vec<f64>; 3],
    /// Integral of the displacements over the step.
    integral: Vec<f64>,
    scratch: Vec<f64>,
    damping: Vec<f64>,
    speed: Vec<f64>,
    /// Closed contacts, then storeys and links that follow laws.
    springs: Vec<Spring>,
    /// How many of them are contacts, and the levels of these.
    levels: Vec<usize>,
    /// Buildings with tridiagonal matrices, and the sums of those without.
    chain: Option<Chain>,
    /// Large buildings with others.
    modal: Option<ModalSeries>,
    sums: Sums,
    dense: Vec<Polynomial>,
    terms: u64,
}

impl Taylor {
    pub(crate) fn new(system: &System) -> Self {
        let layout = Layout::of(system);
        let two = || vec![0.0; 2 * layout.dofs];
        let one = || vec![0.0; layout.dofs];
        Self {
            layout,
            term: two(),
            start: [one(), one(), one()],
            end: [one(), one(), one()],
            integral: one(),
            scratch: one(),
            damping: one(),
            speed: one(),
            springs: Vec::with_capacity(layout.levels + system.elements().len()),
            levels: Vec::with_capacity(layout.levels),
            chain: Chain::new(system),
            modal: ModalSeries::new(system),
            sums: Sums::new(layout.dofs),
            dense: vec![[0.0; COEFFICIENTS]; layout.dimension()],
            terms: 0,
        }
    }

    /// Terms computed so far.
    pub(crate) fn terms(&self) -> u64 {
        self.terms
    }

    /// Whether every closed contact is affine in its phase; laws of storeys and links are
    /// the caller's business.
    pub(crate) fn applies(context: &Context<'_, '_>) -> bool {
        context.contacts.closed().iter().all(|&l| {
            context.contacts.contact(l).is_some_and(|c| {
                let model = &context.dynamics.system.levels()[l].model;
                !c.is_stuck() && model.is_affine(&c.collision, c.phase)
            })
        })
    }

    /// State after a step of length `h`, with the energy integrals.
    pub(crate) fn step(
        &mut self,
        context: &Context<'_, '_>,
        tau: f64,
        state: &[f64],
        h: f64,
        new: &mut [f64],
    ) {
        self.laws(context, state);
        self.series(context, tau, state, h, new);
        new[2 * self.layout.dofs..].copy_from_slice(&state[2 * self.layout.dofs..]);
        self.interpolate_motion(state, new, h);
        self.works(context, tau, state, h, new);
    }

    /// Constants of the closed contacts, and of the branches that elements hold.
    fn laws(&mut self, context: &Context<'_, '_>, state: &[f64]) {
        self.springs.clear();
        self.levels.clear();
        for &l in context.contacts.closed() {
            let level = &context.dynamics.system.levels()[l];
            if let Some(contact) = context.contacts.contact(l) {
                let law = contact.force(level, 0.0, 0.0);
                let at_rest = law.value - law.by_penetration * context.contacts.width(l);
                self.levels.push(l);
                self.springs.push(Spring {
                    level: l,
                    element: usize::MAX,
                    left: level.left,
                    right: level.right,
                    at_rest,
                    stiffness: law.by_penetration,
                    dashpot: law.by_velocity,
                });
            }
        }
        let (n, elements) = (self.layout.dofs, context.dynamics.system.elements());
        let histories = &context.contacts.elements.histories;
        for (index, (element, history)) in elements.iter().zip(histories).enumerate() {
            let motion = element.motion(&state[..n], &state[n..2 * n]);
            let law = element.law.force(history, motion, &[]);
            let (stiffness, dashpot) = (law.by_deformation, law.by_velocity);
            self.springs.push(Spring {
                level: usize::MAX,
                element: index,
                left: element.far,
                right: element.near,
                at_rest: law.force - stiffness * motion.deformation - dashpot * motion.velocity,
                stiffness: stiffness - element.carried,
                dashpot,
            });
        }
    }

    fn series(
        &mut self,
        context: &Context<'_, '_>,
        tau: f64,
        state: &[f64],
        h: f64,
        new: &mut [f64],
    ) {
        let n = self.layout.dofs;
        let load = [
            context.segment.acceleration_at(tau),
            context.segment.slope * h,
        ];
        let constants = context.dynamics.system.contact_free();
        self.terms += match (&mut self.chain, self.modal.as_mut().zip(constants)) {
            (Some(chain), _) => chain.sum(&self.springs, load, h, (&state[..n], &state[n..2 * n])),
            (None, Some((modal, constants))) => {
                let (start, sums) = (&state[..2 * n], &mut self.sums);
                modal.sum(constants, &self.springs, (load, h), start, sums)
            }
            (None, None) => self.general(context, tau, state, h),
        };
        let sums = self.chain.as_ref().map_or(&self.sums, |c| &c.sums);
        let (u, v) = new[..2 * n].split_at_mut(n);
        u.copy_from_slice(&sums.displacement[..n]);
        v.copy_from_slice(&sums.velocity[..n]);
        for (integral, sum) in self.integral.iter_mut().zip(&sums.integral) {
            *integral = h * sum;
        }
        for k in 0..3 {
            self.end[k].copy_from_slice(&sums.end[k][..n]);
            self.start[k].copy_from_slice(&sums.start[k][..n]);
        }
    }

    /// The series with matrices of any shape. Returns the number of terms.
    fn general(&mut self, context: &Context<'_, '_>, tau: f64, state: &[f64], h: f64) -> u64 {
        let n = self.layout.dofs;
        let (system, segment) = (context.dynamics.system, context.segment);
        let start = segment.ground(tau);
        self.term.copy_from_slice(&state[..2 * n]);
        self.sums.begin(&state[..n], &state[n..2 * n]);
        for k in 1..TERMS {
            let (u, v) = self.term.split_at(n);
            system.internal_forces(u, v, &mut self.scratch, &mut self.damping);
            for spring in &self.springs {
                let terms = spring.terms(system);
                if terms.is_empty() {
                    spring.push((k, 0), (u, v), |_| 1.0, &mut self.scratch);
                } else {
                    spring.push_weighted(k, (u, v), terms, &mut self.scratch);
                }
            }
            let scale = h / k as f64;
            for i in 0..n {
                let ground = match k {
                    1 => system.load_on(i, start),
                    2 => h * system.load_slope_on(i, segment),
                    _ => 0.0,
                };
                let u = scale * self.term[n + i];
                let v = scale * (self.scratch[i] / system.mass()[i] - ground);
                (self.term[i], self.term[n + i]) = (u, v);
            }
            let (u, v) = self.term.split_at(n);
            if self.sums.add(k, u, v) {
                return k as u64;
            }
        }
        TERMS as u64
    }

    /// The velocity has three derivatives at both ends; the displacement has the
    /// velocity and two of them.
    fn interpolate_motion(&mut self, state: &[f64], new: &[f64], h: f64) {
        let n = self.layout.dofs;
        for i in 0..n {
            let derivatives = |at: &[Vec<f64>; 3]| [at[0][i], at[1][i], at[2][i]];
            let (a, b) = (derivatives(&self.start), derivatives(&self.end));
            let (v0, v1) = (state[n + i], new[n + i]);
            self.dense[n + i] = septic([v0, a[0], a[1], a[2]], [v1, b[0], b[1], b[2]]);
            self.dense[i] = septic(
                [state[i], h * v0, h * a[0], h * a[1]],
                [new[i], h * v1, h * b[0], h * b[1]],
            );
        }
    }

    /// Works and impulses over the step. The input is exact; damping and contacts by
    /// Gauss's rule.
    fn works(
        &mut self,
        context: &Context<'_, '_>,
        tau: f64,
        state: &[f64],
        h: f64,
        new: &mut [f64],
    ) {
        let (n, layout) = (self.layout.dofs, self.layout);
        let (system, segment) = (context.dynamics.system, context.segment);
        let instants = [segment.ground(tau), segment.ground(tau + h)];
        let mass = &system.mass()[..system.with_mass()];
        for (i, m) in mass.iter().enumerate() {
            let [a, b] = instants.map(|at| system.load_on(i, at));
            let slope = system.load_slope_on(i, segment);
            let moved = new[i] * b - state[i] * a - slope * self.integral[i];
            new[layout.input()] -= m * moved;
        }
        let mut powers = [[[0.0; 3]; 2]; 2];
        for (end, y) in [(0, state), (1, &*new)] {
            let v = &y[n..2 * n];
            let [first, second, _] = [&self.start, &self.end][end];
            let mut input = [0.0; 3];
            for (i, m) in mass.iter().enumerate() {
                let ground = system.load_on(i, instants[end]);
                let change = h * system.load_slope_on(i, segment);
                input[0] -= m * (ground * v[i]);
                input[1] -= m * (ground * first[i] + change * v[i]);
                input[2] -= m * (ground * second[i] + 2.0 * change * first[i]);
            }
            let viscous = match &self.modal {
                Some(modal) => modal.viscous_powers(end as f64),
                None => self.viscous_powers(context, v, end),
            };
            powers[end] = [input, viscous];
        }
        let mut viscous = 0.0;
        for (theta, weight) in GAUSS {
            if let Some(modal) = &self.modal {
                viscous += weight * modal.viscous_power(theta);
                continue;
            }
            for i in 0..n {
                self.speed[i] = value(&self.dense[n + i], theta);
            }
            let speed = std::mem::take(&mut self.speed);
            viscous += weight * self.viscous_power(context, &speed);
            self.speed = speed;
        }
        new[layout.viscous()] += h * viscous;
        for k in 0..self.levels.len() {
            self.contact_work(context, k, state, h, new);
        }
        for k in 0..self.springs.len() {
            let added = self.ground_work(context, k, state, h, new);
            for (powers, added) in powers.iter_mut().zip(added) {
                for (power, added) in powers[0].iter_mut().zip(added) {
                    *power += added;
                }
            }
        }
        self.accounts(context, state, h, new);
        for (which, place) in [layout.input(), layout.viscous()].into_iter().enumerate() {
            let powers = [powers[0][which], powers[1][which]];
            self.dense[place] = integral(h, [state[place], new[place]], powers);
        }
    }

    /// Work and impulse of one contact, and their interpolants.
    fn contact_work(
        &mut self,
        context: &Context<'_, '_>,
        k: usize,
        state: &[f64],
        h: f64,
        new: &mut [f64],
    ) {
        let (n, layout) = (self.layout.dofs, self.layout);
        let contact = self.springs[k];
        let l = contact.level;
        let level = &context.dynamics.system.levels()[l];
        let force = |u: f64, v: f64| contact.term(1, u, v);
        // Force, and product of force and velocity, with two derivatives by theta.
        let ends = [(state, &self.start), (&*new, &self.end)].map(|(y, [first, second, _])| {
            let (u, v) = (level.relative(&y[..n]), level.relative(&y[n..2 * n]));
            let [v1, v2] = [first, second].map(|v| level.relative(v));
            let f = force(u, v);
            let f1 = contact.stiffness * h * v + contact.dashpot * v1;
            let f2 = contact.stiffness * h * v1 + contact.dashpot * v2;
            let power = [f * v, f1 * v + f * v1, f2 * v + 2.0 * f1 * v1 + f * v2];
            ([f, f1, f2], power)
        });
        let (mut impulse, mut work) = (0.0, 0.0);
        for (theta, weight) in GAUSS {
            let at = |offset: usize| level.relative_of(|i| value(&self.dense[offset + i], theta));
            let (u, v) = (at(0), at(n));
            impulse += weight * force(u, v);
            work += weight * force(u, v) * v;
        }
        new[layout.work(l)] += h * work;
        new[layout.impulse(l)] += h * impulse;
        for (place, rates) in [
            (layout.work(l), [ends[0].1, ends[1].1]),
            (layout.impulse(l), [ends[0].0, ends[1].0]),
        ] {
            self.dense[place] = integral(h, [state[place], new[place]], rates);
        }
    }

    /// Work that ground which moves by itself puts into a contact or a link; returns its power
    /// at both ends of the step, with two derivatives by theta.
    fn ground_work(
        &mut self,
        context: &Context<'_, '_>,
        k: usize,
        state: &[f64],
        h: f64,
        new: &mut [f64],
    ) -> [[f64; 3]; 2] {
        let (n, spring) = (self.layout.dofs, self.springs[k]);
        let terms = spring.terms(context.dynamics.system);
        if terms.ground.is_empty() {
            return [[0.0; 3]; 2];
        }
        let relative = |x: &dyn Fn(usize) -> f64| {
            let at = |floor: Option<usize>| floor.map_or(0.0, x);
            at(spring.left) - at(spring.right) + terms.sum_of(x)
        };
        let force = |u: f64, v: f64| spring.term(1, u, v);
        let ends = [(state, &self.start), (&*new, &self.end)].map(|(y, [first, second, _])| {
            let [u, v] = [0, n].map(|offset| relative(&|i| y[offset + i]));
            let [v1, v2] = [first, second].map(|v| relative(&|i| v[i]));
            let f = force(u, v);
            let f1 = spring.stiffness * h * v + spring.dashpot * v1;
            let f2 = spring.stiffness * h * v1 + spring.dashpot * v2;
            let of_ground = |v: &[f64]| terms.ground_of(|i| v[i]);
            let [g, g1, g2] = [of_ground(&y[n..]), of_ground(first), of_ground(second)];
            [f * g, f1 * g + f * g1, f2 * g + 2.0 * f1 * g1 + f * g2]
        });
        let mut work = 0.0;
        for (theta, weight) in GAUSS {
            let component = |offset: usize, i: usize| value(&self.dense[offset + i], theta);
            let [u, v] = [0, n].map(|offset| relative(&|i| component(offset, i)));
            work += weight * force(u, v) * terms.ground_of(|i| component(n, i));
        }
        new[self.layout.input()] += h * work;
        ends
    }

    /// Internal variables of elements, which are integrals over the motion.
    fn accounts(&mut self, context: &Context<'_, '_>, state: &[f64], h: f64, new: &mut [f64]) {
        let (n, elements) = (self.layout.dofs, context.dynamics.system.elements());
        for (element, history) in elements.iter().zip(&context.contacts.elements.histories) {
            let range = element.range(self.layout);
            if range.is_empty() {
                continue;
            }
            let dense = &self.dense;
            let at = |offset: usize, theta: f64| {
                let component = |i: usize| value(&dense[offset + i], theta);
                let one = |floor: Option<usize>| floor.map_or(0.0, component);
                let of_ends = one(element.far) - one(element.near);
                match element.terms.is_empty() {
                    true => of_ends,
                    false => of_ends + element.terms.sum_of(component),
                }
            };
            let mut rates = [0.0; MAXIMUM_INTERNAL_VARIABLES];
            let mut at = |theta: f64| {
                let motion = Motion {
                    deformation: at(0, theta),
                    velocity: at(n, theta),
                };
                let before = &state[range.clone()];
                let law = &element.law;
                law.rates(history, motion, before, &mut rates[..range.len()]);
                rates
            };
            let nodes = fit_nodes().map(&mut at);
            let mut change = [0.0; MAXIMUM_INTERNAL_VARIABLES];
            for (theta, weight) in GAUSS {
                for (change, rate) in change.iter_mut().zip(at(theta)) {
                    *change += weight * rate;
                }
            }
            for (k, place) in range.clone().enumerate() {
                new[place] += h * change[k];
                let rates = fit(&nodes.map(|rates| rates[k]));
                self.dense[place] = primitive(h, [state[place], new[place]], &rates);
            }
        }
    }

    fn viscous_power(&mut self, context: &Context<'_, '_>, v: &[f64]) -> f64 {
        self.damp(context, v);
        dot(v, &self.scratch)
    }

    /// Damping forces of these velocities, into the scratch.
    fn damp(&mut self, context: &Context<'_, '_>, v: &[f64]) {
        (context.dynamics.system).damping_forces(v, &mut self.scratch);
    }

    /// Power of the damping at an end of the step, with two derivatives by theta.
    fn viscous_powers(&mut self, context: &Context<'_, '_>, v: &[f64], end: usize) -> [f64; 3] {
        self.damp(context, v);
        let [first, second, _] = [&self.start, &self.end][end];
        let (power, slope) = (dot(v, &self.scratch), 2.0 * dot(first, &self.scratch));
        let bend = 2.0 * dot(second, &self.scratch);
        let first = std::mem::take(&mut [&mut self.start, &mut self.end][end][0]);
        self.damp(context, &first);
        let bend = bend + 2.0 * dot(&first, &self.scratch);
        [&mut self.start, &mut self.end][end][0] = first;
        [power, slope, bend]
    }

    /// Component `i` of the state over the last step.
    pub(crate) fn polynomial(&self, i: usize) -> &Polynomial {
        &self.dense[i]
    }

    /// Keeps the integrals of levels that are open constant in the interpolant.
    pub(crate) fn rest(&mut self, new: &[f64]) {
        for l in 0..self.layout.levels {
            if !self.levels.contains(&l) {
                for place in [self.layout.work(l), self.layout.impulse(l)] {
                    self.dense[place] = [0.0; COEFFICIENTS];
                    self.dense[place][0] = new[place];
                }
            }
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// An integral over the step from its values at both ends, and its rate there with two
/// derivatives by theta.
fn integral(h: f64, [start, end]: [f64; 2], [a, b]: [[f64; 3]; 2]) -> Polynomial {
    let derivatives = |value: f64, rates: [f64; 3]| {
        let [first, second, third] = rates.map(|x| h * x);
        [value, first, second, third]
    };
    septic(derivatives(start, a), derivatives(end, b))
}

/// The same from a polynomial for its rate.
fn primitive(h: f64, [start, end]: [f64; 2], rate: &Polynomial) -> Polynomial {
    let mut p = [0.0; COEFFICIENTS];
    p[0] = start;
    for k in 1..COEFFICIENTS {
        p[k] = h * rate[k - 1] / k as f64;
    }
    // What a power more would hold.
    p[COEFFICIENTS - 1] += end - p.iter().sum::<f64>();
    p
}
