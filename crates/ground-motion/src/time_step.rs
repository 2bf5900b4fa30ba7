//! Time steps that records have.

use crate::error::bound;

/// Time steps (s) between which those of accelerograms lie. Agencies publish 0.001 s to 0.02 s;
/// instruments record to 20 Hz at least, which 10 samples a second do not hold, and none takes
/// 10,000.
const USUAL_STEPS: (f64, f64) = (1.0e-4, 0.1);

/// Time steps (s) with which a record is read at all: beyond them times have no digits, or no end.
const POSSIBLE_STEPS: (f64, f64) = (1.0e-9, 1.0e6);

/// What is wrong with a time step (s) that no record has.
pub(crate) fn impossible_step(step: f64) -> Option<String> {
    let (least, most) = POSSIBLE_STEPS;
    match step {
        step if !(step > 0.0) => Some(format!("time step {step} s must be greater than zero")),
        step if !(least..=most).contains(&step) => Some(format!(
            "time step {} s is that of no record: {least:e} s to {most:e} s are possible",
            bound(step)
        )),
        _ => None,
    }
}

/// What is to be said of a time step (s) that no accelerograph has, of so many samples.
pub(crate) fn unusual_step(step: f64, count: usize) -> Option<String> {
    let (least, most) = USUAL_STEPS;
    // One that is printed with few digits is no other.
    let usual = step >= least * (1.0 - 1.0e-6) && step <= most * (1.0 + 1.0e-6);
    let long = bound(count.saturating_sub(1) as f64 * step);
    (!usual).then(|| {
        format!(
            "the time step is {} s, where accelerographs have {least} s to {most} s: with it the {count} samples take {long} s; check it",
            bound(step)
        )
    })
}
