//! Assembly of many cases that have much in common: records are read once, and buildings
//! keep what was computed of them.

use pounding_case::Case;
use pounding_ground_motion::{AccelerationUnit, Accelerogram};
use pounding_time_history::{RunOptions, System};

use super::impact_models::models;
use super::method::options;
use super::motions::{Whose, on_their_ground};
use super::parts::Parts;
use super::{Assembly, unused, with_gaps};
use crate::error::AssemblyError;

/// Builds the system of a case under this motion, which is taken as it is: neither the
/// record nor the scale of the case is looked at.
///
/// # Errors
/// As [`crate::assemble()`], but for the record.
pub fn assemble_with_record(
    case: &Case,
    accelerogram: &Accelerogram,
) -> Result<Assembly, AssemblyError> {
    let _span = tracing::debug_span!("assemble_with_record").entered();
    let Parts {
        buildings,
        models,
        options,
    } = Parts::of(case)?;
    let (system, out_of_step) = on_their_ground(case, buildings, (accelerogram, Whose::Another))?;
    let system = with_gaps(case, &models, system)?;
    options.check(&system)?;
    Ok(Assembly {
        system,
        options,
        output_step: case.analysis.output_step,
        accelerogram: accelerogram.clone(),
        unused: unused(case, out_of_step),
    })
}

/// The same on ground that rests, where only what stands on it matters.
///
/// # Errors
/// As [`assemble_with_record`].
pub fn assemble_at_rest(case: &Case) -> Result<Assembly, AssemblyError> {
    let unit = AccelerationUnit::MetrePerSecondSquared;
    assemble_with_record(case, &Accelerogram::new(vec![0.0; 2], unit, 1.0)?)
}

/// The buildings and links of a case under this motion, without its gaps; with the points of
/// columns at which these let floors hit them.
///
/// # Errors
/// As [`assemble_with_record`], but for gaps.
pub fn assemble_without_gaps(
    case: &Case,
    accelerogram: &Accelerogram,
) -> Result<System, AssemblyError> {
    let mut alone = case.clone();
    alone.gaps.clear();
    let parts = Parts::with_columns(&alone, case)?;
    let (system, _) = on_their_ground(&alone, parts.buildings, (accelerogram, Whose::Another))?;
    with_gaps(&alone, &parts.models, system)
}

/// The gaps, the start and the options of a case on the buildings and the motion of
/// `base`, a system made from a case with the same buildings and the same columns that are
/// hit. What depends on the
/// buildings alone is computed once for all systems made this way, and results are, to
/// the last bit, those of [`crate::assemble()`].
///
/// # Errors
/// What the case says of models, gaps or options cannot be.
pub fn regap(case: &Case, base: &System) -> Result<(System, RunOptions), AssemblyError> {
    let models = models(case)?;
    let options = options(case)?;
    let rest = vec![0.0; base.floors()];
    let alone = base.isolated().with_initial_state(&rest, &rest)?;
    let system = with_gaps(case, &models, alone)?;
    options.check(&system)?;
    Ok((system, options))
}
