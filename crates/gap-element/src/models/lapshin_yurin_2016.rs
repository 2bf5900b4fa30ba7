//! Dry friction and a viscous part: restitution falls with speed and stays below one
//! at low speed.

use crate::classes::dry_friction::{DryFriction, friction};
use crate::descriptor::{
    AchievedRestitution, Alias, ConstantDescriptor, ModelDescriptor, ParameterDescriptor,
    ParameterUnit, Verification,
};
use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::{
    EXPONENT, FRICTION, ModelParameters, POWER_STIFFNESS, RESTITUTION, optional,
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
        ConstantDescriptor {
            name: "stiffness",
            unit: ParameterUnit::NewtonPerMetreToExponent,
        },
        ConstantDescriptor {
            name: "friction",
            unit: ParameterUnit::One,
        },
        ConstantDescriptor {
            name: "exponent",
            unit: ParameterUnit::One,
        },
        ConstantDescriptor {
            name: "damping_rate",
            unit: ParameterUnit::SecondPerMetre,
        },
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
    ..optional(
        "damping_rate",
        ParameterUnit::SecondPerMetre,
        "Viscous part b of the force, relative to the spring force",
    )
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    Ok(Box::new(DryFriction {
        descriptor: &DESCRIPTOR,
        stiffness: parameters.required(DESCRIPTOR.name, "stiffness")?,
        exponent: parameters.exponent(&DESCRIPTOR),
        friction: parameters.damping(DESCRIPTOR.name, "friction", friction)?,
        rate: parameters.get("damping_rate").unwrap_or(0.0),
    }))
}
