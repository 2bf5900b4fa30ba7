//! What is watched after every step: that buildings stand, that the ledger is finite; and
//! how places are named in messages.

use super::Driver;
use crate::dynamics::Segment;
use crate::elements::ElementPlace;
use crate::error::TimeHistoryError;
use crate::events::{Candidate, EventKind};
use crate::ledger;
use crate::polynomial::{Polynomial, first_rise};

impl Driver<'_> {
    /// Ends the run where gravity has overturned a building in the trial step: in a storey that
    /// yields, since an elastic one stands or is refused from the start.
    pub(super) fn stands(
        &self,
        segment: &Segment,
        tau: f64,
        step: f64,
    ) -> Result<(), TimeHistoryError> {
        let mut first: Option<(f64, usize, usize)> = None;
        for element in self.system.elements() {
            let (ElementPlace::Storey { building, storey }, Some(dof)) =
                (element.place, element.far)
            else {
                continue;
            };
            let own = &self.system.buildings()[building];
            let ratio = self.peaks.storeys[dof].drift_ratio.value;
            if own.geometric_stiffness()[storey] > 0.0 && ratio > 1.0 {
                let drift = element.polynomial(|k| *self.method.polynomial(k), 0);
                let theta = first_beyond(&drift, own.height()[storey]);
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

    /// Takes the ledger at the present state; a motion that is not finite ends the run.
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
        Ok(())
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
