//! The log of impacts and what they sum up to at every level.

use pounding_gap_element::{Collision, MAXIMUM_CONSTANTS};

use crate::dynamics::Layout;
use crate::outcome::{Impact, LevelOutcome, Peak};
use crate::peaks::Peaks;
use crate::system::System;

/// An impact in progress.
#[derive(Debug, Clone, Copy)]
struct Open {
    index: usize,
    work: f64,
    impulse: f64,
    lasting: bool,
}

/// Room for impacts before the log has to grow.
const IMPACTS: usize = 1024;

/// Impacts in order of closure.
#[derive(Debug)]
pub(crate) struct ImpactLog {
    impacts: Vec<Impact>,
    present: Vec<Option<Open>>,
    levels: Vec<LevelOutcome>,
    /// Sums of squared approach and separation velocities of finished impacts.
    squares: Vec<(f64, f64)>,
    places: Vec<(usize, usize)>,
    /// Number of constants of each level's model, and those of all impacts: handed over
    /// with the impact, so that nothing is allocated while it lasts.
    count: Vec<usize>,
    constants: Vec<[f64; MAXIMUM_CONSTANTS]>,
    /// Levels whose impacts are velocity jumps.
    rigid: Vec<bool>,
    finished: Vec<usize>,
    handed_out: Vec<Impact>,
}

impl ImpactLog {
    pub(crate) fn new(system: &System) -> Self {
        let count = system.levels().len();
        let mut places = Vec::with_capacity(count);
        for (g, gap) in system.gaps().iter().enumerate() {
            places.extend((0..gap.levels).map(|level| (g, level)));
        }
        let empty = LevelOutcome {
            impacts: 0,
            first_contact: None,
            peak_force: Peak::default(),
            peak_penetration: Peak::default(),
            impulse_max: 0.0,
            approach_velocity_max: 0.0,
            energy_dissipated: 0.0,
            impulse: 0.0,
            achieved_restitution: None,
            sticks: 0,
            gap_widening: 0.0,
        };
        Self {
            impacts: Vec::with_capacity(IMPACTS),
            present: vec![None; count],
            levels: vec![empty; count],
            squares: vec![(0.0, 0.0); count],
            places,
            constants: Vec::with_capacity(IMPACTS),
            count: system
                .levels()
                .iter()
                .map(|l| l.model.descriptor().constants.len())
                .collect(),
            rigid: system
                .levels()
                .iter()
                .map(|l| l.model.rigid_restitution().is_some())
                .collect(),
            finished: Vec::with_capacity(IMPACTS),
            handed_out: Vec::new(),
        }
    }

    pub(crate) fn close(
        &mut self,
        l: usize,
        time: f64,
        collision: &Collision,
        layout: Layout,
        state: &[f64],
    ) {
        let (gap, level) = self.places[l];
        self.present[l] = Some(Open {
            index: self.impacts.len(),
            work: state[layout.work(l)],
            impulse: state[layout.impulse(l)],
            lasting: false,
        });
        self.impacts.push(Impact {
            gap,
            level,
            time_closed: time,
            time_opened: f64::NAN,
            approach_velocity: collision.approach_velocity,
            separation_velocity: f64::NAN,
            achieved_restitution: f64::NAN,
            peak_force: Peak::default(),
            peak_penetration: Peak::default(),
            impulse: 0.0,
            energy_dissipated: 0.0,
            constants: Vec::new(),
        });
        self.constants.push(collision.constants);
        let outcome = &mut self.levels[l];
        outcome.impacts += 1;
        outcome.first_contact.get_or_insert(time);
        outcome.approach_velocity_max = outcome
            .approach_velocity_max
            .max(collision.approach_velocity);
    }

    /// Ends an impact. `end` is the time (s) and the separation velocity (m/s), or
    /// `None` if the run ends first; `stored` is what the spring still holds (J).
    pub(crate) fn open(
        &mut self,
        l: usize,
        end: Option<(f64, f64)>,
        peaks: &Peaks,
        layout: Layout,
        state: &[f64],
        stored: f64,
    ) {
        let Some(open) = self.present[l].take() else {
            return;
        };
        let impact = &mut self.impacts[open.index];
        impact.impulse = state[layout.impulse(l)] - open.impulse;
        impact.energy_dissipated = state[layout.work(l)] - open.work - stored;
        impact.peak_force = peaks.force[l];
        impact.peak_penetration = peaks.penetration[l];
        let outcome = &mut self.levels[l];
        if let Some((time, separation)) = end {
            impact.time_opened = time;
            // Contact may end before the impacts that led to it would have.
            impact.time_closed = impact.time_closed.min(time);
            impact.separation_velocity = separation;
            if impact.approach_velocity > 0.0 {
                impact.achieved_restitution = separation / impact.approach_velocity;
            }
            let squares = &mut self.squares[l];
            squares.0 += impact.approach_velocity * impact.approach_velocity;
            squares.1 += separation * separation;
            if squares.0 > 0.0 {
                outcome.achieved_restitution = Some((squares.1 / squares.0).sqrt());
            }
        }
        outcome.impulse += impact.impulse;
        outcome.impulse_max = outcome.impulse_max.max(impact.impulse);
        outcome.energy_dissipated += impact.energy_dissipated;
        outcome
            .peak_force
            .raise(impact.peak_force.value, impact.peak_force.time);
        outcome
            .peak_penetration
            .raise(impact.peak_penetration.value, impact.peak_penetration.time);
        self.finished.push(open.index);
    }

    /// A plastic deformation (m) widened the gap.
    pub(crate) fn widen(&mut self, l: usize, deformation: f64) {
        self.levels[l].gap_widening += deformation;
    }

    /// Whether an impact is in progress.
    pub(crate) fn is_running(&self, l: usize) -> bool {
        self.present[l].is_some()
    }

    /// Whether the impact in progress is a lasting contact of rigid floors.
    pub(crate) fn is_lasting(&self, l: usize) -> bool {
        self.present[l].is_some_and(|open| open.lasting)
    }

    /// The rigid floors of the impact in progress do not part.
    pub(crate) fn begin_lasting(&mut self, l: usize) {
        if let Some(open) = &mut self.present[l] {
            open.lasting = true;
            self.levels[l].sticks += 1;
        }
    }

    /// Moves the closure of the impact in progress.
    pub(crate) fn closed_at(&mut self, l: usize, time: f64) {
        if let Some(open) = &self.present[l] {
            self.impacts[open.index].time_closed = time;
        }
    }

    pub(crate) fn stick(&mut self, l: usize) {
        self.levels[l].sticks += 1;
    }

    /// Impacts that ended since the last call.
    pub(crate) fn finished(&mut self) -> &[Impact] {
        self.handed_out.clear();
        for index in std::mem::take(&mut self.finished) {
            let mut impact = self.impacts[index].clone();
            impact.constants = self.constants_of(index);
            self.handed_out.push(impact);
        }
        &self.handed_out
    }

    /// Constants of a collision, as many as its model has on its card.
    fn constants_of(&self, index: usize) -> Vec<f64> {
        let impact = &self.impacts[index];
        let place = (impact.gap, impact.level);
        let level = self.places.iter().position(|p| *p == place);
        let count = level.map_or(0, |l| self.count[l]);
        self.constants[index][..count].to_vec()
    }

    pub(crate) fn into_outcome(mut self) -> (Vec<LevelOutcome>, Vec<Impact>) {
        for (level, rigid) in self.levels.iter_mut().zip(&self.rigid) {
            if *rigid && level.impacts > 0 && level.sticks == 0 {
                level.peak_force.value = f64::NAN;
            }
        }
        for index in 0..self.impacts.len() {
            self.impacts[index].constants = self.constants_of(index);
        }
        (self.levels, self.impacts)
    }
}
