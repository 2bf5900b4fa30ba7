//! Impact models made comparable: of one stiffness rule and one restitution, in a collision that
//! the gap's own law meets.

mod models;
mod reference_collision;
mod stiffness;

pub use models::{CalibratedModel, RestitutionRule, calibrated};
pub use reference_collision::{OwnLaw, ReferenceCollision};
pub use stiffness::StiffnessRule;

use pounding_case::Case;
use pounding_gap_element::{ModelDescriptor, SeparationRule, registry};
use pounding_hysteresis::help_among_gaps;
use pounding_time_history::System;

use crate::gap_check::{CheckError, RecordDemand};
use models::{own_law, own_parameters, own_restitution};

/// The descriptors of these models, or of all if none is named.
///
/// # Errors
/// An unknown name, or a model that is named twice, as by its alias.
pub fn descriptors(names: &[String]) -> Result<Vec<&'static ModelDescriptor>, CheckError> {
    if names.is_empty() {
        return Ok(registry::descriptors().to_vec());
    }
    let mut descriptors: Vec<&'static ModelDescriptor> = Vec::new();
    for name in names {
        let descriptor = registry::find(name).map_err(|e| CheckError::UnknownModel {
            name: name.clone(),
            help: help_among_gaps(name).or(e.help()).unwrap_or_default(),
        })?;
        // A model and its alias are one.
        if descriptors.iter().any(|c| c.name == descriptor.name) {
            return Err(CheckError::Word {
                message: format!("model {} is asked for twice", descriptor.name),
                help: Some(format!(
                    "leave \"{name}\" out: one name or alias per model is enough"
                )),
            });
        }
        descriptors.push(descriptor);
    }
    Ok(descriptors)
}

/// The collision of each gap that its models are calibrated in: the fastest one that the
/// gap's own law meets under the records that `own` tells of, at the restitution (-) and the
/// approach velocity (m/s) that are given, or those of the gap's own law.
///
/// # Errors
/// A restitution out of range, own runs that failed, or a gap whose own law gives nothing to
/// calibrate to.
pub fn references(
    case: &Case,
    system: &System,
    own: &[RecordDemand],
    (restitution, approach_velocity): (Option<f64>, Option<f64>),
) -> Result<Vec<ReferenceCollision>, CheckError> {
    if let Some(e) = restitution
        && !(e > 0.0 && e <= 1.0)
    {
        return Err(CheckError::Option {
            option: "restitution",
            argument: "--restitution",
            value: e,
            allowed: "greater than 0 and at most 1",
        });
    }
    let mut with = Vec::new();
    for record in own {
        let (_, gaps) = record.pounding.as_ref().map_err(|e| CheckError::OwnLaw {
            record: record.name.clone(),
            diagnosis: e.clone(),
        })?;
        with.push(gaps);
    }
    let fastest = |gap: usize| {
        let levels = with
            .iter()
            .flat_map(|gaps| gaps[gap].levels.iter().enumerate());
        levels.fold((0, 0.0_f64), |best, (l, level)| {
            let velocity = level.approach_velocity_max;
            if velocity > best.1 {
                (l, velocity)
            } else {
                best
            }
        })
    };
    let over_all = (0..system.gaps().len()).fold(0.0_f64, |m, g| m.max(fastest(g).1));
    let mut references = Vec::new();
    for (index, gap) in system.gaps().iter().enumerate() {
        let (level, velocity) = fastest(index);
        let of_other_gaps = approach_velocity.is_none() && velocity <= 0.0;
        let velocity = if velocity > 0.0 { velocity } else { over_all };
        let velocity = approach_velocity.unwrap_or(velocity);
        if !(velocity.is_finite() && velocity > 0.0) {
            return Err(CheckError::Calibration {
                reason: "the buildings touch under no record, so that no collision is known"
                    .to_owned(),
                help: "give --approach-velocity, or a narrower gap",
            });
        }
        let place = &system.levels()[gap.first_level + level];
        let of_case = &case.gaps[index];
        // Floors that turn in plan have several points at each level of the case.
        let points = gap.levels / of_case.levels.len().max(1);
        let level = level / points.max(1);
        let (stiffness, exponent) = own_law(of_case, level)?;
        let mut reference = ReferenceCollision {
            approach_velocity: velocity,
            of_other_gaps,
            effective_mass: place.effective_mass,
            stiffness,
            exponent,
            restitution: f64::NAN,
            // The case has been assembled, and what it says is known.
            separation: of_case
                .separation
                .as_ref()
                .and_then(|rule| SeparationRule::from_name(&rule.value)),
            own: own_parameters(of_case, level, restitution.is_none()),
        };
        reference.restitution = match restitution {
            Some(e) => e,
            None => own_restitution(of_case, level, place.model.as_ref(), &reference)?,
        };
        references.push(reference);
    }
    Ok(references)
}
