//! The two-body collision: what a model really does, by integration.
//!
//! Two bodies: `m delta'' = -F(delta, v) + m a` with the reduced mass `m`,
//! `delta(0) = 0`, `v(0) = v0`, and `a` zero for a free collision. Integrated with
//! the pair of order 8(5,3) at a tolerance near round-off, every change of phase
//! located.

mod flight;

use crate::error::GapElementError;
use crate::model::{Collision, ImpactModel};
use flight::{End, Flight};

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

/// What acts beside the contact, and what is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CollisionOptions {
    /// Constant acceleration (m/s2) that presses the left body towards the right
    /// one: gravity for a body dropped on a slab, zero for a free collision.
    pub pressing_acceleration: f64,
    /// Time after closure (s) at which the state is wanted, as a sensor reads it.
    pub read_at: Option<f64>,
}

/// Result of a collision.
#[derive(Debug, Clone, PartialEq)]
pub struct CollisionOutcome {
    /// Constants that the model fixed at closure.
    pub collision: Collision,
    /// Separation over approach velocity (-); zero if the bodies stay in contact.
    pub restitution: f64,
    /// Whether the bodies stay in contact: pressed together, they have too little
    /// energy left to part.
    pub stays_in_contact: bool,
    /// State at the time asked for: in contact, or in free flight after it.
    pub reading: Option<CollisionSample>,
    /// Velocity of the left body after (m/s).
    pub velocity_left: f64,
    /// Velocity of the right body after (m/s).
    pub velocity_right: f64,
    /// Maximum force (N); NaN for a rigid impact, which has none.
    pub peak_force: f64,
    /// Its time after closure (s).
    pub peak_force_time: f64,
    /// Maximum penetration (m).
    pub peak_penetration: f64,
    /// Its time after closure (s).
    pub peak_penetration_time: f64,
    /// Time until the bodies stop acting on one another (s).
    pub duration: f64,
    /// Impulse (N s).
    pub impulse: f64,
    /// Kinetic energy lost (J).
    pub energy_dissipated: f64,
    /// The history: every accepted step and eight places in each.
    pub history: Vec<CollisionSample>,
}

impl CollisionOutcome {
    /// Whether the velocities jumped: there is no force, no penetration and no history.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        self.peak_force.is_nan()
    }

    /// Restitution (-) that a sensor reads off the velocity of a sample.
    #[must_use]
    pub fn restitution_at(&self, sample: &CollisionSample) -> f64 {
        -sample.velocity / self.collision.approach_velocity
    }

    /// A value that means nothing for bodies that stay in contact: not a number for them.
    fn of_parted(&self, value: f64) -> f64 {
        if self.stays_in_contact {
            f64::NAN
        } else {
            value
        }
    }

    /// Contact time (s); not a number for a rigid impact and for bodies that stay in contact.
    #[must_use]
    pub fn contact_time(&self) -> f64 {
        if self.is_rigid() {
            f64::NAN
        } else {
            self.of_parted(self.duration)
        }
    }

    /// Contact time (s) as results show it: zero for a rigid impact, not a number for bodies that
    /// stay in contact.
    #[cfg(feature = "serde")]
    pub(crate) fn shown_duration(&self) -> f64 {
        match self.is_rigid() {
            true => 0.0,
            false => self.contact_time(),
        }
    }

    /// Impulse (N s); not a number for bodies that stay in contact.
    #[must_use]
    pub fn impulse_of_parted(&self) -> f64 {
        self.of_parted(self.impulse)
    }

    /// Energy lost (J), without the round-off of an elastic contact.
    #[must_use]
    pub fn energy_lost(&self) -> f64 {
        let collision = &self.collision;
        let before = 0.5 * collision.effective_mass * collision.approach_velocity.powi(2);
        if self.energy_dissipated.abs() < 1e-9 * before {
            0.0
        } else {
            self.energy_dissipated
        }
    }
}

/// A maximum and its time, as results show them.
#[cfg(feature = "serde")]
#[derive(serde::Serialize)]
pub(crate) struct PeakOf {
    /// Maximum.
    pub(crate) peak: f64,
    /// Its time after closure (s).
    pub(crate) time: f64,
}

/// The history in rows, whose columns are named; what does not exist is not a number.
#[cfg(feature = "serde")]
impl serde::Serialize for CollisionOutcome {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        #[derive(serde::Serialize)]
        struct Reading {
            time: f64,
            restitution: f64,
            penetration: f64,
            velocity: f64,
            force: f64,
        }
        let rigid = self.is_rigid();
        let shown = if rigid { &[][..] } else { &self.history };
        let history: Vec<_> = shown
            .iter()
            .map(|s| (s.time, s.penetration, s.velocity, s.force))
            .collect();
        let reading = self.reading.as_ref().map(|s| Reading {
            time: s.time,
            restitution: self.restitution_at(s),
            penetration: s.penetration,
            velocity: s.velocity,
            force: s.force,
        });
        let peak_force = PeakOf {
            peak: self.peak_force,
            time: if rigid {
                f64::NAN
            } else {
                self.peak_force_time
            },
        };
        let peak_penetration = PeakOf {
            peak: self.peak_penetration,
            time: self.peak_penetration_time,
        };
        let mut object = serializer.serialize_struct("CollisionOutcome", 13)?;
        object.serialize_field("restitution", &self.restitution)?;
        object.serialize_field("stays_in_contact", &self.stays_in_contact)?;
        object.serialize_field("has_force_history", &!rigid)?;
        object.serialize_field("reading", &reading)?;
        object.serialize_field("peak_force", &peak_force)?;
        object.serialize_field("peak_penetration", &peak_penetration)?;
        object.serialize_field("duration", &self.shown_duration())?;
        object.serialize_field("impulse", &self.impulse_of_parted())?;
        object.serialize_field("energy_dissipated", &self.energy_dissipated)?;
        object.serialize_field("velocity_left", &self.of_parted(self.velocity_left))?;
        object.serialize_field("velocity_right", &self.of_parted(self.velocity_right))?;
        object.serialize_field(
            "history_columns",
            &["time", "penetration", "velocity", "force"],
        )?;
        object.serialize_field("history", &history)?;
        object.end()
    }
}

/// Lets two bodies collide freely.
///
/// # Errors
/// Masses that are not positive, bodies that do not approach one another or by less than 1e-30
/// or more than 1e30 m/s, or a law with which the contact does not end.
pub fn collide(
    model: &dyn ImpactModel,
    bodies: &Bodies,
) -> Result<CollisionOutcome, GapElementError> {
    collide_with(model, bodies, &CollisionOptions::default())
}

/// Lets two bodies collide while a constant acceleration presses them together.
///
/// # Errors
/// As [`collide`], and options that are negative or not finite.
pub fn collide_with(
    model: &dyn ImpactModel,
    bodies: &Bodies,
    options: &CollisionOptions,
) -> Result<CollisionOutcome, GapElementError> {
    let (mass, approach) = check(bodies)?;
    let pressing = options.pressing_acceleration;
    let allowed = |x: f64| x.is_finite() && x >= 0.0;
    if !allowed(pressing) || !options.read_at.is_none_or(allowed) {
        return Err(GapElementError::Bodies(
            "pressing acceleration and reading time must be zero or more".to_owned(),
        ));
    }
    let collision = model.begin(approach, mass);
    if let Some(restitution) = model.rigid_restitution() {
        return Ok(rigid(collision, restitution, bodies, options));
    }
    let mut flight = Flight::new(model, collision, options);
    let end = flight.integrate()?;
    Ok(outcome(flight, end, bodies, options))
}

fn outcome(
    flight: Flight<'_>,
    end: End,
    bodies: &Bodies,
    options: &CollisionOptions,
) -> CollisionOutcome {
    let approach = flight.collision.approach_velocity;
    let stays_in_contact = end == End::AtRest;
    let separation = if stays_in_contact {
        0.0
    } else {
        -flight.state[1]
    };
    let impulse = flight.state[2];
    let pressed = options.pressing_acceleration * flight.time;
    let velocity_right = bodies
        .mass_right
        .map_or(0.0, |m| bodies.velocity_right + impulse / m);
    let reading = flight.reading.or_else(|| {
        let time = options.read_at?;
        if stays_in_contact {
            // Bodies that end together before their reading stick.
            return Some(CollisionSample {
                time,
                penetration: flight.state[0],
                velocity: 0.0,
                force: flight.collision.effective_mass * options.pressing_acceleration,
            });
        }
        fly_on(&flight, time, options.pressing_acceleration)
    });
    CollisionOutcome {
        restitution: separation / approach,
        stays_in_contact,
        reading,
        velocity_left: bodies.velocity_left + pressed - impulse / bodies.mass_left,
        velocity_right,
        peak_force: flight.peak_force.0,
        peak_force_time: flight.peak_force.1,
        peak_penetration: flight.peak_penetration.0,
        peak_penetration_time: flight.peak_penetration.1,
        duration: flight.released_at.unwrap_or(flight.time),
        impulse,
        energy_dissipated: 0.5
            * flight.collision.effective_mass
            * (approach * approach - separation * separation),
        collision: flight.collision,
        history: flight.history,
    }
}

/// Free flight after the contact, until the bodies meet again.
fn fly_on(flight: &Flight<'_>, time: f64, pressing: f64) -> Option<CollisionSample> {
    let after = time - flight.time;
    let penetration = flight.state[0] + (flight.state[1] + 0.5 * pressing * after) * after;
    let meets_again = after > 0.0 && penetration > 0.0;
    (!meets_again).then_some(CollisionSample {
        time,
        penetration,
        velocity: flight.state[1] + pressing * after,
        force: 0.0,
    })
}

/// The velocities jump; there is no force to speak of.
fn rigid(
    collision: Collision,
    restitution: f64,
    bodies: &Bodies,
    options: &CollisionOptions,
) -> CollisionOutcome {
    let (mass, approach) = (collision.effective_mass, collision.approach_velocity);
    let impulse = mass * approach * (1.0 + restitution);
    let sample = |velocity: f64| CollisionSample {
        time: 0.0,
        penetration: 0.0,
        velocity,
        force: 0.0,
    };
    CollisionOutcome {
        collision,
        restitution,
        stays_in_contact: restitution == 0.0 && options.pressing_acceleration > 0.0,
        reading: options.read_at.map(|time| CollisionSample {
            time,
            penetration: -restitution * approach * time
                + 0.5 * options.pressing_acceleration * time * time,
            velocity: -restitution * approach + options.pressing_acceleration * time,
            force: 0.0,
        }),
        velocity_left: bodies.velocity_left - impulse / bodies.mass_left,
        velocity_right: bodies
            .mass_right
            .map_or(0.0, |m| bodies.velocity_right + impulse / m),
        peak_force: f64::NAN,
        peak_force_time: 0.0,
        peak_penetration: 0.0,
        peak_penetration_time: 0.0,
        duration: 0.0,
        impulse,
        energy_dissipated: 0.5 * mass * approach * approach * (1.0 - restitution * restitution),
        history: vec![sample(approach), sample(-restitution * approach)],
    }
}

/// Least approach velocity (m/s): below the round-off of any motion of buildings, and far above where
/// squares of velocities and powers of penetrations leave the range of numbers.
const LEAST_APPROACH: f64 = 1.0e-30;
/// Greatest one: as far from the other end of the range.
const GREATEST_APPROACH: f64 = 1.0e30;

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
    if approach < LEAST_APPROACH {
        return Err(GapElementError::Bodies(format!(
            "their relative velocity of {approach:e} m/s is less than {LEAST_APPROACH:e} m/s, and forces and energies would be lost in round-off"
        )));
    }
    if approach > GREATEST_APPROACH {
        return Err(GapElementError::Bodies(format!(
            "their relative velocity of {approach:e} m/s is more than {GREATEST_APPROACH:e} m/s, and powers of their penetration would leave the range of numbers"
        )));
    }
    let mass = bodies.mass_right.map_or(bodies.mass_left, |m| {
        bodies.mass_left * m / (bodies.mass_left + m)
    });
    Ok((mass, approach))
}
