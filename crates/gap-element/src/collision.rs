//! The two-body collision: what a model really does, by integration.
//!
//! Two bodies without external force: `m delta'' = -F(delta, v)` with the reduced
//! mass, `delta(0) = 0`, `v(0) = v0`. Integrated with the pair of order 8(5,3) at
//! a tolerance near round-off, every change of phase located.

use pounding_runge_kutta::{DENSE_COEFFICIENTS, Dop853};

use crate::error::GapElementError;
use crate::model::{Collision, Direction, Force, Guard, ImpactModel, Memory, Phase, Target};

/// Relative error of a step.
const TOLERANCE: f64 = 1.0e-13;
/// First step as a part of the unknown contact time: small enough for any start
/// like a power of time, since later steps may grow sixfold.
const FIRST_STEP: f64 = 1.0e-10;
const MAXIMUM_STEPS: usize = 100_000;

/// Two bodies on a line, velocities positive to the right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bodies {
    /// Mass of the left body (kg).
    pub mass_left: f64,
    /// Mass of the right body (kg); `None` is a rigid wall.
    pub mass_right: Option<f64>,
    /// Velocity of the left body before (m/s).
    pub velocity_left: f64,
    /// Velocity of the right body before (m/s); zero for a wall.
    pub velocity_right: f64,
}

/// State of the contact at one time after closure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CollisionSample {
    /// Time after closure (s).
    pub time: f64,
    /// Penetration (m).
    pub penetration: f64,
    /// Relative velocity, positive in approach (m/s).
    pub velocity: f64,
    /// Force (N).
    pub force: f64,
}

/// Result of a collision.
#[derive(Debug, Clone, PartialEq)]
pub struct CollisionOutcome {
    /// Constants that the model fixed at closure.
    pub collision: Collision,
    /// Separation over approach velocity (-).
    pub restitution: f64,
    /// Velocity of the left body after (m/s).
    pub velocity_left: f64,
    /// Velocity of the right body after (m/s).
    pub velocity_right: f64,
    /// Greatest force (N).
    pub peak_force: f64,
    /// Its time after closure (s).
    pub peak_force_time: f64,
    /// Greatest penetration (m).
    pub peak_penetration: f64,
    /// Its time after closure (s).
    pub peak_penetration_time: f64,
    /// Time until the bodies stop acting on one another (s).
    pub duration: f64,
    /// Impulse (N s).
    pub impulse: f64,
    /// Kinetic energy lost (J).
    pub energy_dissipated: f64,
    /// The history, at least every accepted step.
    pub history: Vec<CollisionSample>,
}

/// Lets two bodies collide.
///
/// # Errors
/// Masses that are not positive, bodies that do not approach one another, or a
/// law with which the contact does not end.
pub fn collide(
    model: &dyn ImpactModel,
    bodies: &Bodies,
) -> Result<CollisionOutcome, GapElementError> {
    let (mass, approach) = check(bodies)?;
    let mut flight = Flight::new(model, model.begin(approach, mass));
    flight.integrate()?;
    let separation = -flight.state[1];
    let impulse = flight.state[2];
    let velocity_right = bodies
        .mass_right
        .map_or(0.0, |m| bodies.velocity_right + impulse / m);
    Ok(CollisionOutcome {
        restitution: separation / approach,
        velocity_left: bodies.velocity_left - impulse / bodies.mass_left,
        velocity_right,
        peak_force: flight.peak_force.0,
        peak_force_time: flight.peak_force.1,
        peak_penetration: flight.peak_penetration.0,
        peak_penetration_time: flight.peak_penetration.1,
        duration: flight.time,
        impulse,
        energy_dissipated: 0.5 * mass * (approach * approach - separation * separation),
        collision: flight.collision,
        history: flight.history,
    })
}

fn check(bodies: &Bodies) -> Result<(f64, f64), GapElementError> {
    let positive = |m: f64| m.is_finite() && m > 0.0;
    if !positive(bodies.mass_left) || !bodies.mass_right.is_none_or(positive) {
        return Err(GapElementError::Bodies(
            "masses must be greater than zero".to_owned(),
        ));
    }
    let right = if bodies.mass_right.is_some() {
        bodies.velocity_right
    } else {
        0.0
    };
    let approach = bodies.velocity_left - right;
    if !positive(approach) {
        return Err(GapElementError::Bodies(format!(
            "their relative velocity is {approach} m/s"
        )));
    }
    let mass = bodies.mass_right.map_or(bodies.mass_left, |m| {
        bodies.mass_left * m / (bodies.mass_left + m)
    });
    Ok((mass, approach))
}

/// What ends a step of the flight.
#[derive(Clone, Copy)]
enum Event {
    Separation,
    Transition(usize),
}

struct Flight<'a> {
    model: &'a dyn ImpactModel,
    collision: Collision,
    memory: Memory,
    phase: Phase,
    pair: Dop853,
    /// Penetration, velocity, impulse.
    state: [f64; 3],
    time: f64,
    step: f64,
    peak_force: (f64, f64),
    peak_penetration: (f64, f64),
    history: Vec<CollisionSample>,
}

impl<'a> Flight<'a> {
    fn new(model: &'a dyn ImpactModel, collision: Collision) -> Self {
        Self {
            model,
            collision,
            memory: Memory::default(),
            phase: Phase::Approach,
            pair: Dop853::new(3),
            state: [0.0, collision.approach_velocity, 0.0],
            time: 0.0,
            step: FIRST_STEP,
            peak_force: (0.0, 0.0),
            peak_penetration: (0.0, 0.0),
            history: Vec::new(),
        }
    }

    fn force(&self, delta: f64, velocity: f64) -> Force {
        self.model
            .force(&self.collision, &self.memory, self.phase, delta, velocity)
    }

    fn integrate(&mut self) -> Result<(), GapElementError> {
        self.record();
        for _ in 0..MAXIMUM_STEPS {
            let mut new = self.accurate_step();
            let event = self.event(&new);
            if let Some(event) = event {
                new = self.locate(event);
            }
            self.peaks();
            let grown = Dop853::step_factor(self.pair_error(&new)) * self.step;
            self.time += self.step;
            self.pair.advance();
            self.state = new;
            self.model
                .commit(&mut self.memory, self.phase, new[0], new[1]);
            let ended = match event {
                Some(Event::Separation) => true,
                Some(Event::Transition(index)) => self.change_phase(index),
                None => false,
            };
            self.record();
            if ended {
                return Ok(());
            }
            self.step = if event.is_some() {
                self.step.max(grown)
            } else {
                grown
            };
        }
        Err(GapElementError::Unfinished {
            steps: MAXIMUM_STEPS,
            time: self.time,
        })
    }

    /// Changes the phase at a located transition; true if the bodies are free then.
    fn change_phase(&mut self, index: usize) -> bool {
        let target = self.model.transitions(self.phase)[index].target;
        self.phase = match target {
            Target::Phase(phase) => phase,
            // No external force holds free bodies together.
            Target::StickOrSlip => Phase::Restitution,
        };
        self.pair.invalidate();
        self.phase == Phase::Released
    }

    fn trial(&mut self, step: f64) -> [f64; 3] {
        let (model, collision, memory, phase) =
            (self.model, self.collision, self.memory, self.phase);
        let mut derivative = |_: f64, y: &[f64], dy: &mut [f64]| {
            let force = model.force(&collision, &memory, phase, y[0], y[1]).value;
            dy[0] = y[1];
            dy[1] = -force / collision.effective_mass;
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

    fn accurate_step(&mut self) -> [f64; 3] {
        loop {
            let new = self.trial(self.step);
            let error = self.pair_error(&new);
            if error <= 1.0 || self.step < 1.0e-18 {
                return new;
            }
            self.step *= Dop853::step_factor(error).min(0.9);
        }
    }

    /// Value of an event function: it fires when it becomes positive.
    fn guard(&self, event: Event, state: &[f64; 3]) -> f64 {
        match event {
            Event::Separation => -state[0],
            Event::Transition(index) => {
                let transition = self.model.transitions(self.phase)[index];
                let value = match transition.guard {
                    Guard::Velocity => state[1],
                    Guard::RawForce => self.model.raw_force(
                        &self.collision,
                        &self.memory,
                        self.phase,
                        state[0],
                        state[1],
                    ),
                    // Free bodies never stick.
                    Guard::StickLower | Guard::StickUpper => 0.0,
                };
                if transition.direction == Direction::Rising {
                    value
                } else {
                    -value
                }
            }
        }
    }

    /// The first event in the last step, by the sign at its end: the free motion
    /// is so simple that no event comes and goes within an accurate step.
    fn event(&self, new: &[f64; 3]) -> Option<Event> {
        let transitions = self.model.transitions(self.phase).len();
        (0..transitions)
            .map(Event::Transition)
            .chain([Event::Separation])
            .find(|event| {
                self.guard(*event, new) > 0.0 && self.guard(*event, &self.state) < 0.0
                    || (matches!(event, Event::Separation) && new[0] < 0.0)
            })
    }

    /// Cuts the step at the event by the secant method on re-taken steps.
    fn locate(&mut self, event: Event) -> [f64; 3] {
        let (mut low, mut high) = (0.0, self.step);
        let mut step = 0.5 * high;
        let mut new = self.trial(step);
        for _ in 0..200 {
            let value = self.guard(event, &new);
            if value > 0.0 {
                high = step;
            } else {
                low = step;
            }
            let slope = self.guard_rate(event, &new);
            let newton = step - value / slope;
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            if value == 0.0 || (next - step).abs() <= 1.0e-16 * step || high - low <= 1.0e-16 * high
            {
                break;
            }
            step = next;
            new = self.trial(step);
        }
        new
    }

    fn guard_rate(&self, event: Event, state: &[f64; 3]) -> f64 {
        let force = self.force(state[0], state[1]);
        let acceleration = -force.value / self.collision.effective_mass;
        match event {
            Event::Separation => -state[1],
            Event::Transition(index) => {
                let transition = self.model.transitions(self.phase)[index];
                let rate = match transition.guard {
                    Guard::Velocity => acceleration,
                    _ => force.by_penetration * state[1] + force.by_velocity * acceleration,
                };
                if transition.direction == Direction::Rising {
                    rate
                } else {
                    -rate
                }
            }
        }
    }

    fn record(&mut self) {
        let [delta, velocity, _] = self.state;
        let force = self.force(delta.max(0.0), velocity).value;
        if force > self.peak_force.0 {
            self.peak_force = (force, self.time);
        }
        self.history.push(CollisionSample {
            time: self.time,
            penetration: delta,
            velocity,
            force,
        });
    }

    /// Interior maxima of penetration and force over the last step.
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
            force.by_penetration * v
                - force.by_velocity * force.value / self.collision.effective_mass
        };
        if let Some(theta) = falling_root(rate) {
            let (d, v) = state(theta);
            let top = self.force(d, v).value;
            if top > self.peak_force.0 {
                self.peak_force = (top, self.time + theta * self.step);
            }
        }
        // The near side of a jump at the end of the step.
        let (d, v) = state(1.0);
        let end = self.force(d, v).value;
        if end > self.peak_force.0 {
            self.peak_force = (end, self.time + self.step);
        }
        if d > self.peak_penetration.0 {
            self.peak_penetration = (d, self.time + self.step);
        }
    }
}

fn value(p: &[f64; DENSE_COEFFICIENTS], theta: f64) -> f64 {
    p.iter().rev().fold(0.0, |sum, c| sum * theta + c)
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
