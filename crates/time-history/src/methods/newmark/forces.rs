//! The unknown forces of an implicit step: of contacts, and of elements with memory.

use pounding_hysteresis::Motion;

use super::{MAXIMUM_ITERATIONS, NEWTON_TOLERANCE, Newmark};
use crate::dynamics::{Context, push_apart};
use crate::system::System;

/// Where an unknown force acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// A closed contact level.
    Level(usize),
    /// An element: what its force departs from the matrices.
    Element(usize),
}

impl Place {
    /// Relative displacement, or any other quantity given per degree of freedom.
    pub(super) fn relative(self, system: &System, x: &[f64]) -> f64 {
        match self {
            Self::Level(l) => system.levels()[l].relative(x),
            Self::Element(e) => system.elements()[e].relative(x),
        }
    }

    /// Adds the force to the floors.
    pub(super) fn push(self, system: &System, force: f64, net: &mut [f64]) {
        match self {
            Self::Level(l) => push_apart(&system.levels()[l], force, net),
            Self::Element(e) => system.elements()[e].pull(force, net),
        }
    }
}

impl Newmark {
    /// Flexibility between the places of unknown forces: relative acceleration at one
    /// caused by a unit force that pulls the ends of another together.
    fn condense(&mut self, system: &System, weights: (f64, f64)) {
        if self.condensed == weights && self.condensed_places == self.places {
            return;
        }
        self.condensed = weights;
        self.condensed_places.clone_from(&self.places);
        let size = self.places.len();
        self.flexibility.resize(size * size, 0.0);
        for (column, place) in self.places.iter().enumerate() {
            self.net.fill(0.0);
            place.push(system, -1.0, &mut self.net);
            self.effective.solve(system, &mut self.net);
            for (row, other) in self.places.iter().enumerate() {
                self.flexibility[row * size + column] = other.relative(system, &self.net);
            }
        }
    }

    /// The law at a place: force at this relative displacement (m) and velocity, its
    /// derivatives by both; `None` where the place is to stand still.
    fn law(
        &mut self,
        context: &Context<'_, '_>,
        place: Place,
        (displacement, velocity): (f64, f64),
    ) -> Option<[f64; 3]> {
        let system = context.dynamics.system;
        match place {
            Place::Level(l) => {
                let contact = context.contacts.contact(l).filter(|c| !c.is_stuck())?;
                let delta = displacement - context.contacts.width(l);
                let law = contact.force(&system.levels()[l], delta, velocity);
                Some([law.value, law.by_penetration, law.by_velocity])
            }
            Place::Element(e) => {
                let element = &system.elements()[e];
                let history = &context.contacts.elements.histories[e];
                let candidate = self.candidate.get_or_insert_with(|| history.clone());
                let motion = Motion {
                    deformation: displacement,
                    velocity,
                };
                let law = element.law.trial(history, candidate, motion, self.step);
                let carried = element.carried;
                Some([
                    law.force - carried * displacement,
                    law.by_deformation - carried,
                    law.by_velocity,
                ])
            }
        }
    }

    /// Newton on the unknown forces. Leaves them in `unknowns`.
    pub(super) fn unknown_forces(&mut self, context: &mut Context<'_, '_>) -> bool {
        let size = self.places.len();
        let system = context.dynamics.system;
        self.condense(system, self.weights());
        self.unknowns.clear();
        self.unknowns.extend(&self.start_forces);
        let (h, weight) = (self.step, 1.0 + self.alpha);
        let (by_u, by_v) = (self.beta * h * h, self.gamma * h);
        for _ in 0..MAXIMUM_ITERATIONS {
            self.newton_iterations += 1;
            self.change.clear();
            self.matrix.clear();
            for row in 0..size {
                let place = self.places[row];
                let row_of = row * size..(row + 1) * size;
                let pull: f64 = self.flexibility[row_of.clone()]
                    .iter()
                    .zip(&self.unknowns)
                    .map(|(d, x)| d * x)
                    .sum();
                let a = place.relative(system, &self.last) - weight * pull;
                let displacement = place.relative(system, &self.predictor) + by_u * a;
                let velocity = place.relative(system, &self.velocity_predictor) + by_v * a;
                let law = self.law(context, place, (displacement, velocity));
                let flexibility = &self.flexibility[row_of];
                if let Some([force, by_displacement, by_velocity]) = law {
                    let slope = weight * (by_displacement * by_u + by_velocity * by_v);
                    self.change.push(force - self.unknowns[row]);
                    self.matrix.extend(
                        flexibility
                            .iter()
                            .enumerate()
                            .map(|(k, d)| slope * d + if k == row { 1.0 } else { 0.0 }),
                    );
                } else {
                    self.change.push(velocity / by_v);
                    self.matrix.extend(flexibility.iter().map(|d| weight * d));
                }
            }
            if !self.solver.solve(&self.matrix, &mut self.change) {
                return false;
            }
            let mut largest = 0.0_f64;
            let mut size_of_forces = 1.0_f64;
            for (x, dx) in self.unknowns.iter_mut().zip(&self.change) {
                *x += dx;
                largest = largest.max(dx.abs());
                size_of_forces = size_of_forces.max(x.abs());
            }
            if !largest.is_finite() {
                return false;
            }
            if largest <= NEWTON_TOLERANCE * size_of_forces {
                return true;
            }
        }
        false
    }
}
