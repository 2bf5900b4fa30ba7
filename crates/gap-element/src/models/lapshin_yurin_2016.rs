//! Dry friction and a viscous part: restitution falls with speed and stays below one
//! at low speed.

use crate::classes::dry_friction::{DryFriction, friction};
use crate::descriptor::{
    AchievedRestitution, Alias, ModelDescriptor, ParameterDescriptor, ParameterUnit, Verification,
    constant,
};
use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::{
    EXPONENT, FRICTION, ModelParameters, POWER_STIFFNESS, RESTITUTION, optional_non_negative,
};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "lapshin_yurin_2016",
    aliases: &[Alias {
        name: "viscous_dry_friction",
        citation: "common name",
    }],
    title: "Viscous and dry friction in the contact",
    formula: "F = k delta^n (1 + D sgn v + b v);  D = (1 - e^2) / (1 + e^2) with e the restitution at low speed",
    citation: "the law of Lapshin and Yurin, Vestnik MGTU 1 (2016) 90, with the viscous part of Hunt and Crossley; closed form derived in docs/theory/contact-laws.md",
    class: "dry friction, with a viscous part",
    parameters: &[
        POWER_STIFFNESS,
        RESTITUTION,
        FRICTION,
        DAMPING_RATE,
        EXPONENT,
    ],
    constants: &[
        constant("stiffness", ParameterUnit::NewtonPerMetreToExponent),
        constant("friction", ParameterUnit::One),
        constant("exponent", ParameterUnit::One),
        constant("damping_rate", ParameterUnit::SecondPerMetre),
    ],
    separation_rules: &[SeparationRule::ZeroPenetration],
    needs_approach_velocity: false,
    needs_effective_mass: false,
    achieved_restitution: AchievedRestitution::Varies,
    recommended: false,
    verification: Verification::SecondarySources(
        "the printed version has no viscous part; verified against its closed form and an independent integration",
    ),
    example: &[("stiffness", 2.75e9), ("damping_rate", 0.2)],
    traps: &[
        "The restitution asked for is reached at low speed only; it falls with speed: with D = 0.3 (0.7338 at rest) to 0.5581 at b v0 = 0.5.",
        "Unlike Hunt and Crossley it does not become elastic at low speed.",
        "Floors that stop relative to one another stick.",
        "Pulls if the floors separate faster than (1 - D) / b, which a free collision never does.",
    ],
    build,
};

/// b.
const DAMPING_RATE: ParameterDescriptor = ParameterDescriptor {
    default: Some(0.0),
    ..optional_non_negative(
        "damping_rate",
        ParameterUnit::SecondPerMetre,
        "Viscous part b of the force, relative to the spring force",
    )
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    Ok(Box::new(DryFriction {
        descriptor: &DESCRIPTOR,
        stiffness: parameters.get(&DESCRIPTOR, "stiffness")?,
        exponent: parameters.exponent(&DESCRIPTOR),
        friction: parameters.damping(&DESCRIPTOR, "friction", friction)?,
        rate: parameters.get(&DESCRIPTOR, "damping_rate")?,
    }))
}
