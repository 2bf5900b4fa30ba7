//! Integration of one contact.

use pounding_runge_kutta::{DENSE_COEFFICIENTS, Dop853};

use super::{CollisionOptions, CollisionSample};
use crate::descriptor::AchievedRestitution;
use crate::error::GapElementError;
use crate::model::{Collision, Direction, Force, Guard, ImpactModel, Memory, Phase, Target};

/// Relative error of a step.
const TOLERANCE: f64 = 1.0e-13;
/// First step (s): small enough for any start like a power of time, since later steps
/// may grow sixfold.
const FIRST_STEP: f64 = 1.0e-10;
/// Shortest step that error control may ask for.
const SHORTEST_STEP: f64 = 1.0e-18;
const MAXIMUM_STEPS: usize = 100_000;
/// Changes of phase after which a contact is given up.
const MAXIMUM_CHANGES: usize = 1_000;
/// Places of the history inside a step.
const PLACES: usize = 8;

/// Part of the approach velocity below which bodies that settle without turning
/// back have arrived.
const CREEP: f64 = 1.0e-9;

/// Steps after which a body under a lasting force that has not turned back may be one that creeps to
/// where that force is balanced.
const CREEPING_STEPS: usize = 2_000;
/// Part of the pressing acceleration that is left to a body that creeps: the rest is balanced.
const UNBALANCED: f64 = 1.0e-3;

/// How a contact ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// The bodies part.
    Separation,
    /// They never will: the energy left is less than parting takes.
    AtRest,
}

/// What ends a step of the flight.
#[derive(Clone, Copy)]
enum Event {
    Separation,
    Transition(usize),
}

pub(super) struct Flight<'a> {
    model: &'a dyn ImpactModel,
    pub(super) collision: Collision,
    memory: Memory,
    phase: Phase,
    pressing: f64,
    read_at: Option<f64>,
    pub(super) reading: Option<CollisionSample>,
    pair: Dop853,
    /// Penetration, velocity, impulse.
    pub(super) state: [f64; 3],
    pub(super) time: f64,
    step: f64,
    /// When the bodies last stopped acting on one another, if they do not act now.
    pub(super) released_at: Option<f64>,
    pub(super) peak_force: (f64, f64),
    pub(super) peak_penetration: (f64, f64),
    pub(super) history: Vec<CollisionSample>,
}

impl<'a> Flight<'a> {
    pub(super) fn new(
        model: &'a dyn ImpactModel,
        collision: Collision,
        options: &CollisionOptions,
    ) -> Self {
        Self {
            model,
            collision,
            memory: Memory::default(),
            phase: Phase::Approach,
            pressing: options.pressing_acceleration,
            read_at: options.read_at,
            reading: None,
            pair: Dop853::new(3),
            state: [0.0, collision.approach_velocity, 0.0],
            time: 0.0,
            step: FIRST_STEP,
            released_at: None,
            peak_force: (0.0, 0.0),
            peak_penetration: (0.0, 0.0),
            history: Vec::new(),
        }
    }

    fn force(&self, delta: f64, velocity: f64) -> Force {
        self.model
            .force(&self.collision, &self.memory, self.phase, delta, velocity)
    }

    pub(super) fn integrate(&mut self) -> Result<End, GapElementError> {
        self.record();
        self.reading = self
            .history
            .first()
            .copied()
            .filter(|_| self.read_at == Some(0.0));
        let mut changes = 0;
        for count in 0..MAXIMUM_STEPS {
            if changes > MAXIMUM_CHANGES {
                break;
            }
            let to_reading = self.read_at.map(|t| t - self.time).filter(|t| *t > 0.0);
            let (wanted, reads) = match to_reading {
                Some(rest) if self.step >= rest => (rest, true),
                _ => (self.step, false),
            };
            let mut new = self.accurate_step(wanted);
            let reads = reads && self.step == wanted;
            let event = self.event(&new);
            if let Some((event, theta)) = event {
                new = self.locate(event, theta);
            }
            self.peaks();
            let grown = Dop853::step_factor(self.pair_error(&new)) * self.step;
            self.time += self.step;
            self.pair.advance();
            self.state = new;
            self.model
                .commit(&mut self.memory, self.phase, new[0], new[1]);
            let end = match event.map(|(event, _)| event) {
                Some(Event::Separation) => Some(End::Separation),
                Some(Event::Transition(index)) => {
                    changes += 1;
                    self.change_phase(index)
                }
                None if self.rests() => Some(End::AtRest),
                None if count >= CREEPING_STEPS => self.creeps_to_rest().then_some(End::AtRest),
                None => None,
            };
            self.record();
            if reads && event.is_none() {
                self.reading = self.history.last().copied();
            }
            if let Some(end) = end {
                return Ok(end);
            }
            let next = if event.is_some() || reads {
                self.step.max(grown)
            } else {
                grown
            };
            self.step = next.min((0.5 * self.time).max(FIRST_STEP));
        }
        let model = self.model.descriptor();
        Err(GapElementError::Unfinished {
            model: model.name,
            elastic: model.achieved_restitution == AchievedRestitution::Elastic,
            steps: MAXIMUM_STEPS,
            time: self.time,
        })
    }

    /// Parting takes a kinetic energy at zero penetration; less than nothing is
    /// left for it, and no law here gives energy back that it did not store. That
    /// may be known on the way in: the peaks are so when the way in is over. The
    /// motion goes on as long as a reading is wanted.
    fn rests(&self) -> bool {
        let [delta, velocity, _] = self.state;
        let (mass, pressing) = (self.collision.effective_mass, self.pressing);
        if self.phase == Phase::Released && pressing == 0.0 {
            // Nothing acts, and they do not part: slower velocities are the error of steps.
            return velocity >= -TOLERANCE * self.collision.approach_velocity;
        }
        if velocity > CREEP * self.collision.approach_velocity {
            return false;
        }
        // Without a pressing force too slow a parting is none: a damping at or above the critical
        // one lets them creep apart without end.
        let creep = CREEP * self.collision.approach_velocity;
        let least = match pressing > 0.0 {
            true => mass * pressing * delta,
            false => 0.5 * mass * creep * creep,
        };
        !self.is_unread() && self.energy() < least
    }

    /// Whether a reading is still to come.
    fn is_unread(&self) -> bool {
        self.read_at.is_some_and(|t| t > self.time)
    }

    /// Kinetic energy and what the spring would give back (J).
    fn energy(&self) -> f64 {
        let [delta, velocity, _] = self.state;
        let stored = self
            .model
            .stored_energy(&self.collision, &self.memory, self.phase, delta);
        0.5 * self.collision.effective_mass * velocity * velocity + stored
    }

    /// Whether a body whose damping leaves it no more inertia creeps on, ever more slowly, to the
    /// penetration at which the spring bears the lasting force: without the energy to part it stays
    /// there, and goes no deeper. Explicit steps, held short by the damping, would not arrive. Takes
    /// that penetration as a peak.
    fn creeps_to_rest(&mut self) -> bool {
        let [delta, velocity, _] = self.state;
        let holding = self.collision.effective_mass * self.pressing;
        let left = holding - self.force(delta, velocity).value;
        let creeps = velocity > 0.0
            && left.abs() <= UNBALANCED * holding
            && self.energy() < holding * delta
            && !self.is_unread();
        if !creeps {
            return false;
        }
        let bears = |delta: f64| self.force(delta, 0.0).value >= holding;
        let (mut low, mut high) = (delta, 2.0 * delta);
        while !bears(high) {
            if !high.is_finite() {
                return false;
            }
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            match bears(middle) {
                true => high = middle,
                false => low = middle,
            }
        }
        if high > self.peak_penetration.0 {
            self.peak_penetration = (high, self.time);
        }
        true
    }

    /// Changes the phase at a located transition; tells if that ends the contact.
    fn change_phase(&mut self, index: usize) -> Option<End> {
        let target = self.model.transitions(self.phase)[index].target;
        let next = match target {
            Target::Phase(phase) => phase,
            Target::Open => return Some(End::Separation),
            Target::StickOrSlip => {
                let holding = self.collision.effective_mass * self.pressing;
                let (low, high) =
                    self.model
                        .stick_range(&self.collision, &self.memory, self.state[0]);
                if holding >= low && holding <= high {
                    return Some(End::AtRest);
                }
                if holding > high {
                    Phase::Approach
                } else {
                    Phase::Restitution
                }
            }
        };
        self.model.enter(
            &self.collision,
            &mut self.memory,
            (self.phase, next),
            self.state[0],
        );
        self.released_at = (next == Phase::Released).then_some(self.time);
        self.phase = next;
        self.pair.invalidate();
        None
    }

    fn trial(&mut self, step: f64) -> [f64; 3] {
        let (model, collision, memory, phase, pressing) = (
            self.model,
            self.collision,
            self.memory,
            self.phase,
            self.pressing,
        );
        let mut derivative = |_: f64, y: &[f64], dy: &mut [f64]| {
            let force = model.force(&collision, &memory, phase, y[0], y[1]).value;
            dy[0] = y[1];
            dy[1] = pressing - force / collision.effective_mass;
            dy[2] = force;
        };
        let mut new = [0.0; 3];
        self.step = step;
        self.pair.step(&mut derivative, &self.state, step, &mut new);
        self.pair.prepare_dense(&mut derivative);
        new
    }

    fn pair_error(&self, new: &[f64; 3]) -> f64 {
        let v0 = self.collision.approach_velocity;
        let size = self
            .peak_penetration
            .0
            .max(new[0].abs())
            .max(f64::MIN_POSITIVE);
        self.pair.error_norm(|i| match i {
            0 => TOLERANCE * size,
            1 => TOLERANCE * v0,
            _ => f64::INFINITY,
        })
    }

    fn accurate_step(&mut self, first: f64) -> [f64; 3] {
        self.step = first;
        loop {
            let new = self.trial(self.step);
            let error = self.pair_error(&new);
            if error <= 1.0 || self.step < SHORTEST_STEP {
                return new;
            }
            self.step *= Dop853::step_factor(error).min(0.9);
        }
    }

    /// Value of an event function: it fires when it becomes positive.
    fn guard(&self, event: Event, state: &[f64; 3]) -> f64 {
        let Event::Transition(index) = event else {
            return -state[0];
        };
        let (model, collision, memory) = (self.model, &self.collision, &self.memory);
        let transition = model.transitions(self.phase)[index];
        let value = match transition.guard {
            Guard::Velocity => state[1],
            Guard::RawForce => model.raw_force(collision, memory, self.phase, state[0], state[1]),
            Guard::Model(number) => model.guard(number, collision, memory, state[0], state[1]),
            // Bodies that stick have ended their flight.
            Guard::StickLower | Guard::StickUpper => 0.0,
        };
        if transition.direction == Direction::Rising {
            value
        } else {
            -value
        }
    }

    /// The first event in the last step, by signs at places inside it: steps are
    /// shorter than half the time since closure, so that no event of a motion as
    /// simple as that of two bodies comes and goes between places, but for bodies that a
    /// lasting force presses together: they leave one another for a moment, around the
    /// least penetration, which is a place more. Of several
    /// between two places, the interpolant tells which comes first.
    fn event(&self, new: &[f64; 3]) -> Option<(Event, f64)> {
        let (delta, velocity) = (*self.pair.polynomial(0), *self.pair.polynomial(1));
        let inside = |theta: f64| [value(&delta, theta), value(&velocity, theta), 0.0];
        let transitions = self.model.transitions(self.phase).len();
        let even = |place: usize| place as f64 / PLACES as f64;
        let places = (1..=PLACES).flat_map(|place| {
            let (from, to) = (even(place - 1), even(place));
            let speed = |part: f64| value(&velocity, from + part);
            let turns = self.pressing > 0.0 && speed(0.0) < 0.0 && speed(to - from) > 0.0;
            let nearest = turns.then(|| from + rising_root(to - from, speed));
            nearest.into_iter().chain([to])
        });
        for theta in places {
            let state = if theta == 1.0 { *new } else { inside(theta) };
            let first = (0..transitions)
                .map(Event::Transition)
                .chain([Event::Separation])
                .filter(|event| {
                    let started = matches!(event, Event::Separation)
                        || self.guard(*event, &self.state) <= 0.0;
                    started && self.guard(*event, &state) > 0.0
                })
                .map(|event| (event, rising_root(theta, |t| self.guard(event, &inside(t)))))
                .min_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((event, _)) = first {
                return Some((event, theta));
            }
        }
        None
    }

    /// Cuts the step at an event before `theta` by regula falsi (Illinois) on re-taken
    /// steps.
    fn locate(&mut self, event: Event, theta: f64) -> [f64; 3] {
        let (mut low, mut high) = (0.0, theta * self.step);
        let (mut at_low, mut at_high) = (self.guard(event, &self.state), 0.0);
        let mut new = self.trial(high);
        at_high += self.guard(event, &new);
        if at_high <= 0.0 {
            // The interpolant saw by round-off what the step does not: it is here.
            return new;
        }
        let mut last_side = 0;
        for _ in 0..200 {
            if at_high == 0.0 || high - low <= 1.0e-16 * high {
                break;
            }
            let chord = high - (high - low) * at_high / (at_high - at_low);
            let middle = 0.5 * (low + high);
            let step = if chord > low && chord < high && at_low < 0.0 {
                chord
            } else {
                middle
            };
            if step <= low || step >= high {
                break;
            }
            new = self.trial(step);
            let value = self.guard(event, &new);
            if value > 0.0 {
                (high, at_high) = (step, value);
                if last_side == 1 {
                    at_low *= 0.5;
                }
                last_side = 1;
            } else {
                (low, at_low) = (step, value);
                if last_side == -1 {
                    at_high *= 0.5;
                }
                last_side = -1;
                if value == 0.0 {
                    return new;
                }
            }
        }
        if self.step != high {
            new = self.trial(high);
        }
        new
    }

    fn record(&mut self) {
        let [delta, velocity, _] = self.state;
        let force = self.force(delta.max(0.0), velocity).value;
        if force > self.peak_force.0 {
            self.peak_force = (force, self.time);
        }
        let sample = CollisionSample {
            time: self.time,
            penetration: delta,
            velocity,
            force,
        };
        // The near side of a jump is there already; the far side may equal it.
        if self.history.last() != Some(&sample) {
            self.history.push(sample);
        }
    }

    /// Interior maxima of penetration and force over the last step, and the
    /// history inside it.
    fn peaks(&mut self) {
        let (delta, velocity) = (*self.pair.polynomial(0), *self.pair.polynomial(1));
        let state = |theta: f64| (value(&delta, theta), value(&velocity, theta));
        if let Some(theta) = falling_root(|theta| state(theta).1) {
            let (top, time) = (state(theta).0, self.time + theta * self.step);
            if top > self.peak_penetration.0 {
                self.peak_penetration = (top, time);
            }
        }
        let rate = |theta: f64| {
            let (d, v) = state(theta);
            let force = self.force(d, v);
            let acceleration = self.pressing - force.value / self.collision.effective_mass;
            force.by_penetration * v + force.by_velocity * acceleration
        };
        if let Some(theta) = falling_root(rate) {
            let (d, v) = state(theta);
            self.raise_force(self.force(d, v).value, theta);
        }
        for place in 1..=PLACES {
            let theta = place as f64 / PLACES as f64;
            let (penetration, velocity) = state(theta);
            let force = self.force(penetration, velocity).value;
            // The last place is the near side of a jump at the end of the step.
            self.raise_force(force, theta);
            if penetration > self.peak_penetration.0 {
                self.peak_penetration = (penetration, self.time + theta * self.step);
            }
            self.history.push(CollisionSample {
                time: self.time + theta * self.step,
                penetration,
                velocity,
                force,
            });
        }
    }

    fn raise_force(&mut self, force: f64, theta: f64) {
        if force > self.peak_force.0 {
            self.peak_force = (force, self.time + theta * self.step);
        }
    }
}

fn value(p: &[f64; DENSE_COEFFICIENTS], theta: f64) -> f64 {
    p.iter().rev().fold(0.0, |sum, c| sum * theta + c)
}

/// Root in (0, `end`) at which a function that is positive at the end rises through
/// zero, by bisection.
fn rising_root(end: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, end);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// Root in (0, 1) at which a function falls through zero, by bisection.
fn falling_root(f: impl Fn(f64) -> f64) -> Option<f64> {
    let (mut low, mut high) = (0.0, 1.0);
    if !(f(low) > 0.0 && f(high) < 0.0) {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(0.5 * (low + high))
}
