//! The state of every contact level: open, or closed in a phase of a collision.

use pounding_gap_element::{Collision, Direction, Force, Guard, Memory, Phase, Transition};

use crate::elements::Elements;
use crate::system::{ContactLevel, System};

/// A contact level at one time.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Mode {
    /// The floors are apart.
    Open,
    /// The floors are in contact.
    Closed(Contact),
}

/// A contact in progress.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Contact {
    pub phase: Phase,
    pub collision: Collision,
    pub memory: Memory,
}

/// All that a system remembers beside its state: contact levels with the list of those
/// that are closed, and the histories of elements.
#[derive(Debug, Clone)]
pub(crate) struct Contacts {
    pub modes: Vec<Mode>,
    pub elements: Elements,
    closed: Vec<usize>,
    /// Present width of every gap (m): wider than at rest where impacts left a
    /// plastic deformation.
    widths: Vec<f64>,
}

impl Contacts {
    pub(crate) fn all_open(system: &System) -> Self {
        let levels = system.levels().len();
        Self {
            modes: vec![Mode::Open; levels],
            elements: Elements::new(system),
            closed: Vec::with_capacity(levels),
            widths: system.levels().iter().map(|l| l.width).collect(),
        }
    }

    /// Present width of a gap (m).
    pub(crate) fn width(&self, level: usize) -> f64 {
        self.widths[level]
    }

    /// Those of all gaps (m).
    pub(crate) fn widths(&self) -> &[f64] {
        &self.widths
    }

    /// Penetration (m), positive in contact.
    pub(crate) fn penetration(&self, system: &System, level: usize, u: &[f64]) -> f64 {
        system.levels()[level].relative(u) - self.widths[level]
    }

    /// Widens a gap by a plastic deformation (m).
    pub(crate) fn widen(&mut self, level: usize, deformation: f64) {
        self.widths[level] += deformation;
    }

    /// Closed levels in index order.
    pub(crate) fn closed(&self) -> &[usize] {
        &self.closed
    }

    pub(crate) fn contact(&self, level: usize) -> Option<&Contact> {
        match &self.modes[level] {
            Mode::Open => None,
            Mode::Closed(contact) => Some(contact),
        }
    }

    pub(crate) fn close(&mut self, level: usize, contact: Contact) {
        self.modes[level] = Mode::Closed(contact);
        let place = self.closed.partition_point(|l| *l < level);
        self.closed.insert(place, level);
    }

    pub(crate) fn open(&mut self, level: usize) {
        self.modes[level] = Mode::Open;
        self.closed.retain(|l| *l != level);
    }

    /// Mode and width of a level, to go back to.
    pub(crate) fn mark(&self, level: usize) -> (Mode, f64) {
        (self.modes[level], self.widths[level])
    }

    /// Puts a level back to where it was.
    pub(crate) fn go_back(&mut self, level: usize, (mode, width): (Mode, f64)) {
        self.widths[level] = width;
        match mode {
            Mode::Open => self.open(level),
            Mode::Closed(contact) => {
                self.open(level);
                self.close(level, contact);
            }
        }
    }

    /// Whether floors stick together anywhere.
    pub(crate) fn any_stuck(&self) -> bool {
        let mut closed = self.closed.iter();
        closed.any(|l| self.contact(*l).is_some_and(Contact::is_stuck))
    }

    pub(crate) fn set_phase(&mut self, level: usize, phase: Phase) {
        if let Mode::Closed(contact) = &mut self.modes[level] {
            contact.phase = phase;
        }
    }

    /// Changes the phase and lets the model prepare its memory for it.
    pub(crate) fn enter(&mut self, system: &System, level: usize, phase: Phase, u: &[f64]) {
        let delta = self.penetration(system, level, u);
        if let Mode::Closed(contact) = &mut self.modes[level] {
            let change = (contact.phase, phase);
            system.levels()[level].model.enter(
                &contact.collision,
                &mut contact.memory,
                change,
                delta,
            );
            contact.phase = phase;
        }
    }

    /// Lets every model take the accepted state into its memory.
    pub(crate) fn commit(&mut self, system: &System, u: &[f64], v: &[f64]) {
        for k in 0..self.closed.len() {
            let l = self.closed[k];
            let level = &system.levels()[l];
            let delta = level.relative(u) - self.widths[l];
            self.commit_level(system, l, (delta, level.relative(v)));
        }
    }

    /// The same for one level, by its penetration (m) and its rate (m/s).
    pub(crate) fn commit_level(
        &mut self,
        system: &System,
        level: usize,
        (delta, velocity): (f64, f64),
    ) {
        if let Mode::Closed(contact) = &mut self.modes[level] {
            let model = &system.levels()[level].model;
            model.commit(&mut contact.memory, contact.phase, delta, velocity);
        }
    }
}

impl Contact {
    /// Law of the contact; not for [`Phase::Stuck`].
    pub(crate) fn force(&self, level: &ContactLevel, delta: f64, velocity: f64) -> Force {
        level
            .model
            .force(&self.collision, &self.memory, self.phase, delta, velocity)
    }

    pub(crate) fn raw_force(&self, level: &ContactLevel, delta: f64, velocity: f64) -> f64 {
        level
            .model
            .raw_force(&self.collision, &self.memory, self.phase, delta, velocity)
    }

    /// The function of a transition, positive once it fires, at a penetration and a velocity; of those
    /// of a stuck contact, which are of forces, not a number.
    pub(crate) fn transition_function(
        &self,
        level: &ContactLevel,
        transition: Transition,
        delta: f64,
        velocity: f64,
    ) -> f64 {
        let (collision, memory) = (&self.collision, &self.memory);
        let value = match transition.guard {
            Guard::Velocity => velocity,
            Guard::RawForce => self.raw_force(level, delta, velocity),
            Guard::Model(index) => level.model.guard(index, collision, memory, delta, velocity),
            Guard::StickLower | Guard::StickUpper => f64::NAN,
        };
        match transition.direction {
            Direction::Rising => value,
            Direction::Falling => -value,
        }
    }

    /// Recoverable energy in the contact (J): none once it has let go.
    pub(crate) fn stored_energy(&self, level: &ContactLevel, delta: f64) -> f64 {
        if self.phase == Phase::Released {
            return 0.0;
        }
        level
            .model
            .stored_energy(&self.collision, &self.memory, self.phase, delta)
    }

    pub(crate) fn is_stuck(&self) -> bool {
        self.phase == Phase::Stuck
    }
}
