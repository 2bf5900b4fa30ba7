//! What is watched after every step: that buildings stand, that the ledger is finite; and
//! how places are named in messages.

use super::Driver;
use crate::error::TimeHistoryError;
use crate::events::{Candidate, EventKind};
use crate::ledger;
use crate::polynomial::{Polynomial, first_rise};
use crate::system::Segment;

/// Work of contacts on the buildings, over the largest input energy, that no contact does.
const GIVEN: f64 = 1.0e6;
/// Residual of the balance, over the largest input energy so far, at which a run of fixed steps is given up: what follows
/// is motion that the steps make, however much energy the ground may yet put in.
const LOST: f64 = 1.0e3;
/// How far beyond its bound the error of a fixed step may lead a variable of a law.
const BEYOND: f64 = 1.1;
/// Part of it up to which the balance counts as closed.
const OPEN: f64 = 0.1;

impl Driver<'_> {
    /// Ends the run where a building has fallen in the trial step: overturned by gravity, or because
    /// the force of a law falls, in a storey or at a frame that yields, since an elastic one stands or is
    /// refused from the start.
    pub(super) fn stands(
        &self,
        segment: &Segment,
        tau: f64,
        step: f64,
    ) -> Result<(), TimeHistoryError> {
        let mut first: Option<(f64, usize, usize)> = None;
        for (index, element) in self.system.elements().iter().enumerate() {
            let Some((building, storey)) = self.system.storey_of_element(element.place) else {
                continue;
            };
            let own = &self.system.buildings()[building];
            let height = own.height()[storey];
            let is_beyond = match element.far {
                Some(dof) => self.peaks.storeys[dof].drift_ratio.value > 1.0,
                None => self.peaks.elements[index].deformation.value > height,
            };
            if is_beyond
                && (own.geometric_stiffness()[storey] > 0.0
                    || self.falls_beyond(height, index, step))
            {
                let drift = element.polynomial(|k| *self.method.polynomial(k), 0);
                let theta = first_beyond(&drift, height);
                if first.is_none_or(|(earlier, ..)| theta < earlier) {
                    first = Some((theta, building, storey));
                }
            }
        }
        first.map_or(Ok(()), |(theta, building, storey)| {
            let building = &self.system.buildings()[building];
            Err(TimeHistoryError::Collapse {
                time: segment.start + tau + theta * step,
                building: building.name().to_owned(),
                storey: storey + 1,
                height: building.height()[storey],
            })
        })
    }

    /// Whether an element is deformed by more than this height (m) at the end of the trial step, on a
    /// branch whose force falls with the deformation.
    fn falls_beyond(&self, height: f64, index: usize, step: f64) -> bool {
        let (element, layout) = (&self.system.elements()[index], self.dynamics.layout);
        let (n, state) = (layout.dofs, &self.new_state);
        let motion = element.motion(&state[..n], &state[n..2 * n]);
        if motion.deformation.abs() <= height {
            return false;
        }
        let history = &self.contacts.elements.histories[index];
        let elapsed = self.method.information().implicit.then_some(step);
        let at = (motion, &state[element.range(layout)]);
        let response = element.response(history, &mut history.clone(), at, elapsed);
        response.by_deformation < 0.0
    }

    /// Ends the run where a fixed step leads a law to where no motion does: beyond what a stiff law
    /// allows, an explicit method goes on with forces that are bounded no more, and the ledger closes.
    pub(super) fn laws_are_followed(&self, time: f64) -> Result<(), TimeHistoryError> {
        for (index, element) in self.system.elements().iter().enumerate() {
            let bound = element.law.variable_bound();
            let variables = &self.state[element.range(self.dynamics.layout)];
            let Some(value) = variables.first().map(|z| z.abs()) else {
                continue;
            };
            if value > BEYOND * bound {
                return Err(TimeHistoryError::LawNotFollowed {
                    time,
                    method: self.method.information().title,
                    place: self.system.place_of_element(index),
                    value,
                    bound,
                });
            }
        }
        Ok(())
    }

    /// Work (J) of contacts on the buildings beyond which a run is given up. That of honest contacts
    /// is never more than round-off.
    pub(super) fn most_given(&self) -> f64 {
        GIVEN * self.ledger.largest_input.max(self.least_energy)
    }

    /// Ends the run if contacts have done more work on the buildings than that. Where steps are fixed, or
    /// the balance is open by a good part of it, it may be the step that is too long, not a model that is
    /// wrong.
    #[cold]
    pub(super) fn contacts_give(&self, time: f64, residual: f64) -> Result<(), TimeHistoryError> {
        let layout = self.dynamics.layout;
        let work = |l: usize| self.state[layout.work(l)];
        let levels = 0..layout.levels;
        let given = -levels.clone().map(work).sum::<f64>();
        let most = levels.min_by(|a, b| work(*a).total_cmp(&work(*b)));
        match most {
            Some(level)
                if self.method.information().adaptive
                    && given > self.most_given()
                    && residual.abs() < OPEN * given =>
            {
                Err(TimeHistoryError::ContactGivesEnergy {
                    time,
                    place: self.system.name_of_level(level),
                    model: self.system.levels()[level].model.descriptor().name,
                    given: -work(level),
                    input: self.ledger.largest_input,
                })
            }
            _ => Ok(()),
        }
    }

    /// Takes the ledger at the present state; a motion that is not finite ends the run, and so do
    /// contacts that drive it.
    pub(super) fn balance(&mut self, time: f64) -> Result<(), TimeHistoryError> {
        let energy = ledger::energy(
            self.system,
            self.dynamics.layout,
            &self.contacts,
            &self.state,
            None,
        );
        self.ledger.end = energy;
        self.residual = energy.residual;
        if !energy.residual.is_finite() {
            return Err(self.not_finite(time));
        }
        self.ledger.largest_input = self.ledger.largest_input.max(energy.input.abs());
        self.largest_residual = self.largest_residual.max(energy.residual.abs());
        let lost = LOST.max(self.options.energy_tolerance());
        let input = self.ledger.largest_input.max(self.least_energy);
        if energy.residual.abs() > lost * input && !self.method.information().adaptive {
            return Err(self.does_not_close(time, energy.residual.abs() / input));
        }
        if energy.impact < -self.most_given() {
            return self.contacts_give(time, energy.residual);
        }
        Ok(())
    }

    /// A balance that is open by this part of the largest input energy.
    pub(super) fn does_not_close(&self, time: f64, residual: f64) -> TimeHistoryError {
        let information = self.method.information();
        TimeHistoryError::EnergyResidual {
            residual,
            allowed: self.options.energy_tolerance(),
            time,
            method: information.title,
            name: information.name,
        }
    }

    pub(super) fn not_finite(&self, time: f64) -> TimeHistoryError {
        TimeHistoryError::NotFinite {
            time,
            method: self.method.information().title,
            place: self.places_in_touch(),
        }
    }

    /// A level that had an event, or an element.
    pub(super) fn place_of(&self, event: &Candidate) -> String {
        match event.kind {
            EventKind::Branch(_) => self.system.place_of_element(event.level),
            _ => self.system.name_of_level(event.level),
        }
    }

    pub(super) fn places_in_touch(&self) -> String {
        self.places_closer_than(0.0)
    }

    /// Levels in contact, and those whose floors are closer than this (m).
    pub(super) fn places_closer_than(&self, distance: f64) -> String {
        let n = self.dynamics.layout.dofs;
        let u = &self.state[..n];
        let is_close = |l: &usize| {
            self.contacts.contact(*l).is_some()
                || self.contacts.penetration(self.system, *l, u) > -distance
        };
        let levels = (0..self.dynamics.layout.levels).filter(is_close);
        let places: Vec<_> = levels.map(|l| self.system.name_of_level(l)).collect();
        if places.is_empty() {
            "none".to_owned()
        } else {
            places.join(", ")
        }
    }
}

/// Where in a step a drift first exceeds this height to either side: at its end, if round-off hides it.
fn first_beyond(drift: &Polynomial, height: f64) -> f64 {
    let to_side = |sign: f64| {
        let mut beyond = drift.map(|c| sign * c);
        beyond[0] -= height;
        first_rise(&beyond).unwrap_or(1.0)
    };
    to_side(1.0).min(to_side(-1.0))
}
