//! Song's adjusted Iwan model: uniform density of sliders and a residual spring.

use super::iwan_six_parameter::law;
use crate::descriptor::{Alias, LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::iwan::IwanDensity;
use crate::law::HysteresisLaw;
use crate::parameters::{LawParameters, non_negative, positive};

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "song_2004",
    aliases: &[Alias {
        name: "adjusted_iwan",
        citation: "name in the paper",
    }],
    title: "Adjusted Iwan model of Song",
    formula: "rho(phi) = k (1-r) / (phi_2 - phi_1) on [phi_1, phi_2], beside a spring r k",
    citation: "Song, Hartwigsen, McFarland, Vakakis and Bergman, Journal of Sound and Vibration 273 (2004) 249",
    parameters: &[
        positive(
            "stiffness",
            ParameterUnit::NewtonPerMetre,
            "Initial stiffness k",
        ),
        non_negative(
            "residual_ratio",
            ParameterUnit::One,
            "Stiffness r that never slips over the initial one",
        )
        .within((0.0, true), (1.0, false)),
        non_negative(
            "phi_1",
            ParameterUnit::Metre,
            "Deformation at which the first slider slips, below phi_2",
        )
        .default_to(0.0),
        positive(
            "phi_2",
            ParameterUnit::Metre,
            "Deformation at which the last slider slips",
        ),
    ],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::SecondarySources(
        "the density; its closed forms are checked against discrete sliders",
    ),
    example: &[
        ("stiffness", 1.5e7),
        ("residual_ratio", 0.1),
        ("phi_1", 5.0e-5),
        ("phi_2", 5.0e-4),
    ],
    example_amplitude: 1.0e-3,
    traps: &["Small cycles dissipate like the third power of the amplitude, never less."],
    build,
};

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(&DESCRIPTOR, name);
    let (stiffness, ratio) = (get("stiffness")?, get("residual_ratio")?);
    let (phi_1, phi_2) = (get("phi_1")?, get("phi_2")?);
    if phi_1 >= phi_2 {
        return Err(HysteresisError::Inconsistent {
            law: DESCRIPTOR.name,
            reason: format!("its phi_1 {phi_1} m is not below its phi_2 {phi_2} m"),
            remedy: "give phi_1 below phi_2, or leave phi_1 out for 0",
        });
    }
    let density = IwanDensity {
        density: stiffness * (1.0 - ratio) / (phi_2 - phi_1),
        exponent: 0.0,
        phi_1,
        phi_2,
        slider_stiffness: 0.0,
        residual_stiffness: ratio * stiffness,
    };
    let stated = || {
        format!(
            "stiffness = {stiffness:?} N/m, residual_ratio = {ratio:?}, phi_1 = {phi_1:?} m and phi_2 = {phi_2:?} m"
        )
    };
    Ok(law(
        &DESCRIPTOR,
        density.checked_as(DESCRIPTOR.name, stated)?,
    ))
}
