//! Systems with the same buildings and other gaps.

use std::sync::Arc;

use pounding_gap_element::{ImpactModel, in_series};
use pounding_time_history::{ContactLevel, System, TimeHistoryError};

/// The same buildings and links under the same motion, with another width (m) and model at every
/// contact level: `change` is given the gap and the level. What the isolated buildings
/// determine is shared with `system`.
///
/// # Errors
/// A gap that the system does not take.
pub fn rebuilt(
    system: &System,
    change: impl Fn(usize, &ContactLevel) -> (f64, Arc<dyn ImpactModel>),
) -> Result<System, TimeHistoryError> {
    let mut other = system.without_gaps();
    for (index, gap) in system.gaps().iter().enumerate() {
        let levels = system.levels_of(gap);
        let pairs = levels.iter().map(|level| {
            let (width, model) = change(index, level);
            let [left, right] = level.between;
            // What stands behind a contact stays there, whatever its law.
            let model = match (level.model.spring_behind(), model.spring_behind()) {
                (Some(spring), None) => in_series(model, spring),
                _ => Ok(model),
            };
            let model = model.map_err(|e| TimeHistoryError::GapDefinition {
                gap: gap.name.clone(),
                reason: format!("{e}, and the columns that are hit have no mass"),
            })?;
            Ok((left, right, width, model))
        });
        let pairs = pairs.collect::<Result<_, TimeHistoryError>>()?;
        let (between, tolerance) = (gap.between.clone(), gap.elevation_tolerance);
        other.add_gap_with_tolerance(&gap.name, between, pairs, tolerance)?;
    }
    other.take_level_responses(system)?;
    Ok(other)
}
