//! A bracketed root with few evaluations, each of which is a collision.

use super::{CalibrationError, CalibrationStep, GREATEST_ALPHA};

/// First upper end of the bracket: beyond the exact `alpha` of every restitution.
const FIRST_HIGH: f64 = 1.0;
/// Growth of the upper end until the bracket holds a root.
const GROWTH: f64 = 4.0;
/// Constants of ITP as its authors recommend them: truncation, its power, and the
/// slack over bisection.
const TRUNCATION: f64 = 0.2;
const POWER: i32 = 2;
const SLACK: i32 = 1;

type Attempt<'a> = &'a mut dyn FnMut(f64) -> Result<CalibrationStep, CalibrationError>;

/// The step whose achieved restitution is within `tolerance` of the one requested.
pub(super) fn search(
    requested: f64,
    tolerance: f64,
    attempt: Attempt<'_>,
) -> Result<CalibrationStep, CalibrationError> {
    let near = |step: &CalibrationStep| (step.achieved - requested).abs() <= tolerance;
    let low = attempt(0.0)?;
    let mut high = attempt(FIRST_HIGH)?;
    while high.achieved < requested && high.alpha * GROWTH <= GREATEST_ALPHA {
        high = attempt(high.alpha * GROWTH)?;
    }
    if let Some(step) = [low, high].into_iter().find(near) {
        // The last entry of the record is the result.
        return attempt(step.alpha);
    }
    if !(low.achieved < requested && high.achieved > requested) {
        return Err(CalibrationError::NoRoot {
            requested,
            low: low.alpha,
            achieved_low: low.achieved,
            high: high.alpha,
            achieved_high: high.achieved,
        });
    }
    interpolate(requested, &near, low, high, attempt)
}

/// Interpolation, truncation, projection: regula falsi, moved towards the middle,
/// and kept where bisection would still finish in time.
fn interpolate(
    requested: f64,
    near: &dyn Fn(&CalibrationStep) -> bool,
    mut low: CalibrationStep,
    mut high: CalibrationStep,
    attempt: Attempt<'_>,
) -> Result<CalibrationStep, CalibrationError> {
    let width = high.alpha - low.alpha;
    // Neighbouring doubles at the upper end.
    let finest = f64::EPSILON * high.alpha;
    let bisections = libm::log2(width / (2.0 * finest)).ceil() as i32;
    for round in 0..=bisections + SLACK {
        let (below, above) = (low.achieved - requested, high.achieved - requested);
        let span = high.alpha - low.alpha;
        let middle = low.alpha + 0.5 * span;
        let falsi = (above * low.alpha - below * high.alpha) / (above - below);
        let towards = (middle - falsi).signum();
        let truncation = TRUNCATION / width * span.powi(POWER);
        let truncated = if truncation <= (middle - falsi).abs() {
            falsi + towards * truncation
        } else {
            middle
        };
        let radius = finest * 2.0_f64.powi(bisections + SLACK - round) - 0.5 * span;
        let alpha = if (truncated - middle).abs() <= radius {
            truncated
        } else {
            middle - towards * radius.max(0.0)
        };
        let step = attempt(alpha)?;
        let exhausted = !(alpha > low.alpha && alpha < high.alpha);
        if near(&step) {
            return Ok(step);
        }
        if exhausted {
            return not_reached(requested, step);
        }
        if step.achieved < requested {
            low = step;
        } else {
            high = step;
        }
    }
    not_reached(requested, low)
}

fn not_reached(requested: f64, step: CalibrationStep) -> Result<CalibrationStep, CalibrationError> {
    Err(CalibrationError::NotReached {
        requested,
        alpha: step.alpha,
        achieved: step.achieved,
    })
}
