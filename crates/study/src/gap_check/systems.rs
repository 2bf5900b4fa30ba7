//! Systems with the same buildings and other gaps.

use std::sync::Arc;

use pounding_gap_element::ImpactModel;
use pounding_time_history::{ContactLevel, System, TimeHistoryError};

/// The same buildings and links under the same motion, with another width (m) and model at every
/// contact level: `change` is given the gap and the level. What the isolated buildings
/// determine is shared with `system`.
pub(crate) fn rebuilt(
    system: &System,
    change: impl Fn(usize, &ContactLevel) -> (f64, Arc<dyn ImpactModel>),
) -> Result<System, TimeHistoryError> {
    let mut other = system.without_gaps();
    for (index, gap) in system.gaps().iter().enumerate() {
        let levels = system.levels_of(gap);
        let pairs = levels.iter().map(|level| {
            let (width, model) = change(index, level);
            let [left, right] = level.between;
            (left, right, width, model)
        });
        let (between, tolerance) = (gap.between.clone(), gap.elevation_tolerance);
        other.add_gap_with_tolerance(&gap.name, between, pairs.collect(), tolerance)?;
    }
    other.take_level_responses(system)?;
    Ok(other)
}
