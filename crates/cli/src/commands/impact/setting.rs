//! What collides: two bodies, or one that falls on a slab.

use pounding_case::Dimension;
use pounding_catalogue::DefinitionError;
use pounding_catalogue::numbers::significant;
use pounding_gap_element::laboratory::Specimen;
use pounding_gap_element::{Bodies, CollisionOptions, GapElementError};
use serde::Serialize;

use crate::arguments::{ImpactArguments, positive, value};
use crate::failure::Failure;

/// The collision that all models are put through.
pub struct Setting {
    /// The two bodies.
    pub bodies: Bodies,
    /// Gravity in a drop, and the reading of a sensor.
    pub options: CollisionOptions,
    /// In words.
    pub description: String,
}

/// What collides, for machines.
#[derive(Serialize)]
pub struct Shown {
    mass_left: f64,
    mass_right: Option<f64>,
    velocity_left: f64,
    velocity_right: f64,
    pressing_acceleration: f64,
}

/// Reads the setting off the arguments.
pub fn setting(arguments: &ImpactArguments) -> Result<Setting, Failure> {
    let mass_left = mass(&arguments.mass_left, "mass-left")?;
    let wall = if arguments.drop { "wall" } else { "40 t" };
    let mass_right = match arguments.mass_right.as_deref().unwrap_or(wall) {
        "wall" => None,
        text => Some(mass(text, "mass-right")?),
    };
    let velocity_right = value(
        &arguments.velocity_right,
        "velocity-right",
        Dimension::VELOCITY,
    )?;
    if mass_right.is_none() && velocity_right != 0.0 {
        return Err(Failure::input(
            format!("--velocity-right is {velocity_right} m/s, but the right body is a rigid wall"),
            Some(
                "leave --velocity-right out, or give the right body a mass with --mass-right"
                    .to_owned(),
            ),
        ));
    }
    let (velocity_left, gravity) = arrival(arguments)?;
    let bodies = Bodies {
        mass_left,
        mass_right,
        velocity_left,
        velocity_right,
    };
    if !(velocity_left > velocity_right) {
        return Err(Failure::input(
            format!(
                "the bodies do not approach one another: the left one moves at {velocity_left} m/s, the right one at {velocity_right} m/s"
            ),
            Some(
                "velocities are positive to the right: the left one must be the faster".to_owned(),
            ),
        ));
    }
    let read_at = arguments
        .read_at
        .as_deref()
        .map(|text| positive(text, ("read-at", "5 ms"), Dimension::TIME))
        .transpose()?;
    Ok(Setting {
        bodies,
        options: CollisionOptions {
            pressing_acceleration: gravity,
            read_at,
        },
        description: describe(&bodies, arguments, gravity),
    })
}

/// Velocity at first contact (m/s) and the gravity that acts during it (m/s2).
fn arrival(arguments: &ImpactArguments) -> Result<(f64, f64), Failure> {
    let given = arguments
        .velocity
        .as_deref()
        .map(|text| value(text, "velocity", Dimension::VELOCITY))
        .transpose()?;
    if !arguments.drop {
        return Ok((given.unwrap_or(0.8), 0.0));
    }
    let gravity = value(&arguments.gravity, "gravity", Dimension::ACCELERATION)?;
    if !(gravity >= 0.0) {
        return Err(Failure::input(
            format!("--gravity is {gravity} m/s2, but it must be zero or more"),
            Some("leave --gravity out for 9.80665 m/s2; 0 is a blow without weight".to_owned()),
        ));
    }
    match (given, &arguments.height) {
        (Some(velocity), _) => Ok((velocity, gravity)),
        (None, Some(text)) => {
            let height = positive(text, ("height", "0.2 m"), Dimension::LENGTH)?;
            Ok(((2.0 * gravity * height).sqrt(), gravity))
        }
        (None, None) => Err(Failure::input(
            "--drop does not say how fast the body arrives",
            Some("add --height \"0.2 m\" or --velocity \"2 m/s\"".to_owned()),
        )),
    }
}

fn describe(bodies: &Bodies, arguments: &ImpactArguments, gravity: f64) -> String {
    let against = match bodies.mass_right {
        None if arguments.drop => "a rigid slab".to_owned(),
        None => "a rigid wall".to_owned(),
        Some(mass) if arguments.drop => format!("a slab of {} kg", significant(mass)),
        Some(mass) => format!(
            "{} kg at {} m/s",
            significant(mass),
            significant(bodies.velocity_right)
        ),
    };
    let left = significant(bodies.mass_left);
    let speed = significant(bodies.velocity_left);
    if !arguments.drop {
        return format!("{left} kg at {speed} m/s against {against}");
    }
    let height = match gravity {
        fall if arguments.height.is_some() => {
            let height = bodies.velocity_left.powi(2) / (2.0 * fall);
            format!(" from {} m", significant(height))
        }
        _ => String::new(),
    };
    format!(
        "{left} kg dropped{height} on {against}, arriving at {speed} m/s; gravity {gravity} m/s2 acts during contact"
    )
}

impl Setting {
    /// The setting for machines.
    pub fn shown(&self) -> Shown {
        Shown {
            mass_left: self.bodies.mass_left,
            mass_right: self.bodies.mass_right,
            velocity_left: self.bodies.velocity_left,
            velocity_right: self.bodies.velocity_right,
            pressing_acceleration: self.options.pressing_acceleration,
        }
    }

    /// The setting as `key=value` pairs for the head of a file.
    pub fn pairs(&self) -> String {
        let right = self
            .bodies
            .mass_right
            .map_or("wall".to_owned(), |m| m.to_string());
        format!(
            "mass_left_kg={} mass_right_kg={right} velocity_left_m_per_s={} velocity_right_m_per_s={} pressing_acceleration_m_per_s2={}",
            self.bodies.mass_left,
            self.bodies.velocity_left,
            self.bodies.velocity_right,
            self.options.pressing_acceleration
        )
    }
}

fn mass(text: &str, option: &str) -> Result<f64, Failure> {
    positive(text, (option, "25 t"), Dimension::MASS)
}

/// What an error of a model means to somebody at the command line.
pub fn refused(specimen: &Specimen, error: GapElementError) -> Failure {
    match &error {
        GapElementError::Definition(DefinitionError::MissingParameter { parameter, .. }) => {
            let of_example = specimen.descriptor.example.iter();
            let mut of_example = of_example.filter(|(name, _)| name == parameter);
            // The stiffness of an example belongs to its exponent.
            if specimen.parameters.given("exponent").is_some() && of_example.next().is_some() {
                return Failure::input(
                    error.to_string(),
                    Some(format!(
                        "add -p {parameter}=VALUE: that of the model's example belongs to another exponent"
                    )),
                );
            }
            Failure::input(
                error.to_string(),
                Some(format!(
                    "add -p {}=VALUE, or --example for the values of the model's example",
                    parameter.replace(" or ", "=VALUE or -p ")
                )),
            )
        }
        _ => Failure::from(error),
    }
}
