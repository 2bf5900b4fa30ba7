//! A bracketed root with few evaluations, each of which is a collision.

use super::{CalibrationError, CalibrationStep, GREATEST_ALPHA};

/// First upper end of the bracket: beyond the exact `alpha` of every restitution.
const FIRST_HIGH: f64 = 1.0;
/// Ratio of the ends of the bracket, which is moved until it holds a root. It comes to small values
/// from above: without an `alpha` the body would creep out of the contact and never leave it.
const GROWTH: f64 = 4.0;
/// Least `alpha` that is tried, below that of every restitution that a collision tells from zero.
const LEAST_ALPHA: f64 = 1.0e-12;
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
    let first = attempt(FIRST_HIGH)?;
    let (mut low, mut high) = (first, first);
    while high.achieved < requested && high.alpha * GROWTH <= GREATEST_ALPHA {
        low = high;
        high = attempt(high.alpha * GROWTH)?;
    }
    while low.achieved > requested && low.alpha / GROWTH >= LEAST_ALPHA {
        high = low;
        low = attempt(low.alpha / GROWTH)?;
    }
    if let Some(step) = [low, high].into_iter().find(near) {
        // The last entry of the record is the result.
        return attempt(step.alpha);
    }
    if !(low.achieved < requested && high.achieved > requested) {
        // All values that were tried, from the first one on.
        let low = if low.achieved < requested { first } else { low };
        let high = if high.achieved > requested {
            first
        } else {
            high
        };
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
