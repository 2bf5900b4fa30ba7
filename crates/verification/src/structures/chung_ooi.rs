//! Tests 1 and 2 of Chung and Ooi 2011: elastic impacts of spheres.

use std::f64::consts::PI;

use pounding_gap_element::{Bodies, ModelParameters, collide, registry};

use super::quantity::{Quantity, comparison};
use crate::comparison::{Comparison, Line, Part};
use crate::error::VerificationError;

/// The peaks are read off a figure: so much of them (-).
const FIGURE: f64 = 1.0e-3;

/// Tests 1 and 2 of Chung and Ooi 2011.
///
/// # Errors
/// A collision that cannot be computed.
pub(super) fn chung_ooi() -> Result<Part, VerificationError> {
    Ok(Part {
        name: "chung_ooi",
        citation: "Chung and Ooi, Granular Matter 13 (2011) 643, benchmark tests 1 and 2, with the curves as Kratos and Yade ship them",
        comparisons: vec![two_spheres()?, sphere_on_plane()?],
        findings: vec![
            "Their peaks are read off figures, to about 0.1 %. In both tests ours are the closed form of Hertz, k delta^1.5 with delta = (5 m v^2 / (4 k))^(2/5).".to_owned(),
        ],
    })
}

/// Stiffness (N/m^1.5) by Hertz of spheres with this effective modulus (Pa) and radius (m).
fn hertz(effective_modulus: f64, effective_radius: f64) -> f64 {
    4.0 / 3.0 * effective_modulus * effective_radius.sqrt()
}

fn peak(stiffness: f64, bodies: &Bodies, theirs: f64) -> Result<Line, VerificationError> {
    let parameters = ModelParameters::from_pairs(&[("stiffness", stiffness)]);
    let model = registry::build("hertz_1882", &parameters)?;
    let out = collide(model.as_ref(), bodies)?;
    let right = bodies.mass_right.unwrap_or(f64::INFINITY);
    let mass = bodies.mass_left / (1.0 + bodies.mass_left / right);
    let speed = bodies.velocity_left - bodies.velocity_right;
    let penetration = (1.25 * mass * speed * speed / stiffness).powf(0.4);
    Ok(Quantity {
        name: "peak force (kN)",
        theirs,
        closed_form: Some(1.0e-3 * stiffness * penetration.powf(1.5)),
        ours: 1.0e-3 * out.peak_force,
        tolerance: FIGURE,
    }
    .reproduced())
}

fn two_spheres() -> Result<Comparison, VerificationError> {
    let (radius, modulus, poisson) = (0.010_f64, 48.0e9, 0.20_f64);
    let mass = 4.0 / 3.0 * PI * radius.powi(3) * 2800.0;
    let bodies = Bodies {
        mass_left: mass,
        mass_right: Some(mass),
        velocity_left: 10.0,
        velocity_right: -10.0,
    };
    let stiffness = hertz(0.5 * modulus / (1.0 - poisson * poisson), 0.5 * radius);
    Ok(comparison(
        "Test 1: two glass spheres of radius 10 mm, 48 GPa, Poisson's ratio 0.20, 2800 kg/m3, 10 m/s each towards the other",
        vec![peak(stiffness, &bodies, 10.704)?],
    ))
}

fn sphere_on_plane() -> Result<Comparison, VerificationError> {
    let (radius, modulus, poisson) = (0.1_f64, 70.0e9, 0.30_f64);
    let bodies = Bodies {
        mass_left: 4.0 / 3.0 * PI * radius.powi(3) * 2699.0,
        mass_right: None,
        velocity_left: 0.2,
        velocity_right: 0.0,
    };
    // The plane is a thousand times as stiff.
    let stiffness = hertz(modulus / (1.0 - poisson * poisson) / 1.001, radius);
    Ok(comparison(
        "Test 2: aluminium sphere of radius 100 mm, 70 GPa, Poisson's ratio 0.30, 2699 kg/m3, 0.2 m/s against a plane a thousand times as stiff",
        vec![peak(stiffness, &bodies, 11.357)?],
    ))
}
