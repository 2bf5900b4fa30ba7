//! What a step may do to a record, and is more often a mistake in its numbers.

use crate::accelerogram::Accelerogram;
use crate::error::rounded;
use crate::processing::ProcessingStep;

/// Part of the range of accelerations that filters and longer steps customarily leave at least.
const LEAST_PART: f64 = 0.5;
/// Cycles of the high-pass corner within the record: with fewer its pads are thirty times as long as
/// the record, and periods are called usable that the record does not hold.
const LEAST_CYCLES: f64 = 0.1;

/// Warnings of a step that made one record of another.
pub(super) fn warnings<T>(
    step: &ProcessingStep<T>,
    before: &Accelerogram,
    after: &Accelerogram,
) -> Vec<String> {
    let mut warnings = Vec::new();
    let name = match step {
        ProcessingStep::Filter(filter) => {
            let duration = before.duration();
            if let Some(corner) = filter.high_pass
                && corner * duration < LEAST_CYCLES
            {
                warnings.push(format!(
                    "filter: the high-pass corner of {corner} Hz has a period of {:.4} s, and the record lasts {duration} s: it holds no such periods; check the corner",
                    1.0 / corner
                ));
            }
            "filter"
        }
        ProcessingStep::Resample { .. } => {
            warnings.extend(
                after
                    .unusual_time_step()
                    .map(|w| format!("resampling: {w}")),
            );
            "resampling"
        }
        _ => return warnings,
    };
    let (from, to) = (range(before), range(after));
    if to < LEAST_PART * from {
        warnings.push(format!(
            "{name}: the accelerations lay within {} m/s2 of each other and lie within {} m/s2 now, {:.3} % of that; check the {}",
            rounded(from, 5),
            rounded(to, 5),
            100.0 * to / from,
            if name == "filter" { "corners" } else { "time step" }
        ));
    }
    warnings
}

/// Difference of the largest and the smallest sample (m/s2): an offset that is filtered off is none
/// of it.
fn range(record: &Accelerogram) -> f64 {
    let samples = record.samples();
    let largest = samples.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let smallest = samples.iter().copied().fold(f64::INFINITY, f64::min);
    largest - smallest
}
