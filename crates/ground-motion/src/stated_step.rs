//! Time steps that a header states more than once.

use crate::draft::Draft;
use crate::error::bound;
use crate::source::Source;
use crate::time_column::Times;

/// A time step as a header states it, in seconds or as a rate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StatedStep {
    /// Its line, from 1.
    pub line: usize,
    /// Step (s).
    pub step: f64,
}

/// Part of a step by which two statements of it may differ.
pub(crate) const STEP_TOLERANCE: f64 = 0.01;

/// Part of the rate of the samples up to which another frequency is taken for that of a filter, which most are.
const OF_FILTERS: f64 = 0.25;

/// What to say of a frequency of a header, of which it is not known what it is of, that is not the rate of the samples;
/// by their steps (s). One as low as those of filters is passed over.
pub(crate) fn frequency_not_used(line: usize, stated: f64, used: f64) -> Option<String> {
    let differs = (stated - used).abs() > STEP_TOLERANCE * used;
    let is_of_filter = used <= OF_FILTERS * (1.0 + STEP_TOLERANCE) * stated;
    (differs && !is_of_filter).then(|| {
        format!(
            "line {line}: a frequency of {} Hz is stated, but the samples are {} s apart, which is used: if it is the rate of sampling, get the record again",
            bound(1.0 / stated),
            bound(used)
        )
    })
}

/// Takes the first of the steps; all must be the same, or the user says which is right.
pub(crate) fn state_step(draft: &mut Draft, source: &Source<'_>, stated: &[StatedStep]) {
    let Some(first) = stated.first() else {
        return;
    };
    draft.times = Times::Step(Some(first.step));
    let differs = |s: &&StatedStep| (s.step - first.step).abs() > STEP_TOLERANCE * first.step;
    let Some(other) = stated.iter().find(differs) else {
        return;
    };
    let message = format!(
        "the time step is {} s ({} samples/s) here, but {} s ({} samples/s) in line {}",
        bound(first.step),
        bound(1.0 / first.step),
        bound(other.step),
        bound(1.0 / other.step),
        other.line
    );
    let near = |given: f64| {
        let near = move |s: &&StatedStep| (s.step - given).abs() <= 1.0e-6 * given.abs();
        stated.iter().find(near)
    };
    if let Some(used) = source.options.time_step.and_then(near) {
        draft.times = Times::Step(Some(used.step));
        draft.warnings.push(format!(
            "line {}: {message}; {} s was given",
            first.line, used.step
        ));
        return;
    }
    let remedy = format!(
        "the header contradicts itself: get the record again, or say which step is right, `time_step = \"{0} s\"` in [ground_motion] of a case, `--time-step \"{0} s\"` with `pounding motion` (`lenient = true` takes {0} s)",
        bound(first.step)
    );
    draft.step_conflict = Some((first.line, message, remedy));
}
