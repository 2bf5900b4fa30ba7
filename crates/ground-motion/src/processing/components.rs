//! Two horizontal components.

use crate::accelerogram::Accelerogram;
use crate::error::GroundMotionError;

/// Samples that both components have.
pub(crate) fn common_length(
    first: &Accelerogram,
    second: &Accelerogram,
) -> Result<usize, GroundMotionError> {
    let (a, b) = (first.time_step(), second.time_step());
    let count = first.samples().len().min(second.samples().len());
    // Over the common length they must not part by a hundredth of a step.
    if !((a - b).abs() * count as f64 <= 0.01 * a) {
        return Err(GroundMotionError::Mismatch(format!(
            "their time steps are {a} s and {b} s"
        )));
    }
    Ok(count)
}
