//! Dry friction: the spring force is raised in approach and lowered in
//! restitution by the same part.

use crate::classes::dry_friction::{DryFriction, friction};
use crate::classes::dry_friction_table::TabulatedDryFriction;
use crate::descriptor::{
    AchievedRestitution, Alias, ModelDescriptor, ParameterUnit, Verification, constant,
};
use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::{EXPONENT, FRICTION, ModelParameters, POWER_STIFFNESS, RESTITUTION};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "borovin_2014",
    aliases: &[Alias {
        name: "dry_friction",
        citation: "common name",
    }],
    title: "Dry friction in the contact",
    formula: "F = k delta^n (1 + D sgn v);  D = (1 - e^2) / (1 + e^2);  at v = 0 it holds with any force between k delta^n (1 - D) and k delta^n (1 + D)",
    citation: "Borovin, Lapshin and Yurin, Keldysh Institute preprint 46 (2014), equations 3-4",
    class: "dry friction",
    parameters: &[POWER_STIFFNESS, RESTITUTION, FRICTION, EXPONENT],
    constants: &[
        constant("stiffness", ParameterUnit::NewtonPerMetreToExponent),
        constant("friction", ParameterUnit::One),
        constant("exponent", ParameterUnit::One),
    ],
    separation_rules: &[SeparationRule::ZeroPenetration],
    needs_approach_velocity: false,
    needs_effective_mass: false,
    achieved_restitution: AchievedRestitution::Constant,
    recommended: false,
    verification: Verification::Verified(
        "the preprint's ball on concrete, closed form, all printed digits",
    ),
    example: &[("stiffness", 2.75e9)],
    traps: &[
        "Exact restitution, independent of speed, mass and spring.",
        "The force drops by (1 - D) / (1 + D) at the turning point.",
        "With D = 1 and above friction holds what the spring pushes: a plastic impact, restitution 0. The floors stay together, overlapping, until they are pulled apart by more than k delta^n (D - 1).",
        "Floors that stop relative to one another stick; fixed steps without that state chatter.",
        "A spring of your own, `spring` in a gap and `impact --spring`, takes the place of stiffness and exponent: the equations hold for any force that increases.",
        "The preprint's force law lacks a bracket: its equations 3 and 4 use F = f (1 + D sgn v).",
    ],
    build,
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    if let Some(table) = &parameters.spring {
        let friction = parameters.damping(&DESCRIPTOR, "friction", friction)?;
        let model = TabulatedDryFriction::new(&DESCRIPTOR, table, friction)?;
        return Ok(Box::new(model));
    }
    Ok(Box::new(DryFriction {
        descriptor: &DESCRIPTOR,
        stiffness: parameters.get(&DESCRIPTOR, "stiffness")?,
        exponent: parameters.exponent(&DESCRIPTOR),
        friction: parameters.damping(&DESCRIPTOR, "friction", friction)?,
        rate: 0.0,
    }))
}
