//! Parameters of the family and the laws they make.

use super::{Capacities, Deteriorating, Reloading};
use crate::descriptor::{LawDescriptor, ParameterDescriptor, ParameterUnit};
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::parameters::{
    HARDENING_RATIO, LawParameters, STIFFNESS, YIELD_FORCE, non_negative, positive,
};

const fn capacity(name: &'static str, explanation: &'static str) -> ParameterDescriptor {
    non_negative(name, ParameterUnit::One, explanation).default_to(0.0)
}

/// Parameters of all three laws, then those of pinching.
pub(crate) const PARAMETERS: [ParameterDescriptor; 13] = [
    STIFFNESS,
    YIELD_FORCE,
    HARDENING_RATIO,
    positive(
        "capping_deformation",
        ParameterUnit::Metre,
        "Deformation at which the strength begins to fall on first loading, beyond yield",
    ),
    positive(
        "softening_ratio",
        ParameterUnit::One,
        "Fall of the strength beyond the cap over the elastic stiffness",
    ),
    capacity(
        "residual_ratio",
        "Strength that remains over the yield force",
    )
    .within((0.0, true), (1.0, false)),
    capacity(
        "strength_capacity",
        "Energy capacity of the strength over Fy xy; zero for no cyclic deterioration",
    ),
    capacity(
        "capping_capacity",
        "Energy capacity of the falling line over Fy xy; zero for no cyclic deterioration",
    ),
    capacity(
        "unloading_capacity",
        "Energy capacity of the unloading stiffness over Fy xy; zero for no cyclic deterioration",
    ),
    positive(
        "deterioration_exponent",
        ParameterUnit::One,
        "Exponent c of the rate of deterioration, from 1 to 2",
    )
    .within((1.0, true), (2.0, true))
    .default_to(1.0),
    capacity(
        "reloading_capacity",
        "Energy capacity of the reloading stiffness over Fy xy; zero for no cyclic deterioration",
    ),
    positive(
        "pinching_force",
        ParameterUnit::One,
        "Force that the first leg heads for over the force at the target",
    )
    .within((0.0, false), (1.0, true))
    .default_to(0.25),
    non_negative(
        "pinching_deformation",
        ParameterUnit::One,
        "Share of the maximum residual deformation by which the legs meet before it",
    )
    .within((0.0, true), (1.0, true))
    .default_to(0.5),
];

/// The law of a descriptor from its parameters.
pub(crate) fn build(
    descriptor: &'static LawDescriptor,
    reloading: Reloading,
    parameters: &LawParameters,
) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(descriptor, name);
    let (stiffness, yield_force) = (get("stiffness")?, get("yield_force")?);
    let capping_deformation = get("capping_deformation")?;
    if !(capping_deformation > yield_force / stiffness) {
        return Err(HysteresisError::Inconsistent {
            law: descriptor.name,
            reason: format!(
                "the cap at {capping_deformation} m does not lie beyond yield at {} m",
                yield_force / stiffness
            ),
            remedy: "take a capping deformation beyond yield_force / stiffness",
        });
    }
    let accelerated = match reloading {
        Reloading::Bilinear => 0.0,
        _ => get("reloading_capacity")?,
    };
    Ok(Box::new(Deteriorating {
        descriptor,
        reloading,
        stiffness,
        yield_force,
        hardening_ratio: get("hardening_ratio")?,
        capping_deformation,
        softening: get("softening_ratio")? * stiffness,
        residual_force: get("residual_ratio")? * yield_force,
        capacities: Capacities {
            strength: get("strength_capacity")?,
            capping: get("capping_capacity")?,
            unloading: get("unloading_capacity")?,
            reloading: accelerated,
            exponent: get("deterioration_exponent")?,
        },
    }))
}
