//! Motions brought to a target spectrum.

mod drift;
mod frequency_domain;
mod least_squares;
mod misfit;
mod peaks;
mod wavelets;

use serde::Serialize;

use crate::accelerogram::Accelerogram;
use crate::error::{GroundMotionError, ascending, within};
use crate::generators::achieved;
use crate::matching::misfit::{Deviations, MOST_PERIODS};
use crate::processing::band_factor;
use crate::spectra::{
    Evaluation, ResponseSpectrum, TargetSpectrum, logarithmic_periods, response_spectrum,
};
use crate::step_record::StepRecord;

pub use frequency_domain::match_by_fourier_amplitudes;
pub use misfit::{Misfit, misfit};
pub use wavelets::match_by_wavelets;

const STEP: &str = "spectrum matching";
/// Most iterations that are meant: what is not reached by then is not reached at all.
const MOST_ITERATIONS: f64 = 1.0e5;

/// Largest tolerance that is meant: beyond it a motion that is only scaled would be matched, as by
/// 5 for 5 %.
const LARGEST_TOLERANCE: f64 = 1.0;

/// What is asked of a match.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MatchOptions {
    /// First period (s).
    pub from: f64,
    /// Last period (s).
    pub to: f64,
    /// Periods matched from the start, evenly spaced in their logarithm: iterations that bring
    /// nothing add those between them where the deviation is largest.
    pub periods: usize,
    /// Maximum deviation as a part of the target, up to 1: at any period of the band.
    pub tolerance: f64,
    /// Iterations at most.
    pub iterations: usize,
}

impl MatchOptions {
    /// 80 periods of a band (s) to 5 % within 150 iterations.
    #[must_use]
    pub fn band(from: f64, to: f64) -> Self {
        Self {
            from,
            to,
            periods: 80,
            tolerance: 0.05,
            iterations: 150,
        }
    }
}

/// A matched motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Matched {
    /// The motion.
    pub accelerogram: Accelerogram,
    /// Its misfit.
    pub misfit: Misfit,
    /// What was done.
    pub steps: Vec<StepRecord>,
}

fn spectrum(
    record: &Accelerogram,
    target: &TargetSpectrum,
    periods: &[f64],
) -> Result<ResponseSpectrum, GroundMotionError> {
    response_spectrum(
        record,
        periods,
        target.damping(),
        Evaluation::PiecewiseLinear,
    )
}

/// One method's change of a motion.
trait Adjustment {
    const NAME: &'static str;

    /// The motion with its spectrum nearer the target, given its deviations from it.
    fn improve(
        &mut self,
        record: &Accelerogram,
        target: &TargetSpectrum,
        periods: &[f64],
        deviations: &Deviations,
    ) -> Result<Accelerogram, GroundMotionError>;
}

/// Takes the end velocity and displacement of a record off, scales it to the band, then
/// improves it until it is near enough; the best iterate counts.
fn iterate<A: Adjustment>(
    record: &Accelerogram,
    target: &TargetSpectrum,
    options: MatchOptions,
    adjustment: &mut A,
) -> Result<Matched, GroundMotionError> {
    within(
        STEP,
        "tolerance",
        options.tolerance,
        f64::MIN_POSITIVE,
        LARGEST_TOLERANCE,
    )?;
    // Shorter periods swing more than once between two samples.
    let shortest = 2.0 * record.time_step();
    let longest = record.duration();
    if longest <= shortest {
        return Err(GroundMotionError::NotPossible {
            step: STEP,
            reason: format!(
                "a record of {longest} s is no longer than the shortest period of samples {} s apart",
                record.time_step()
            ),
            remedy: "give a longer record",
        });
    }
    ascending(
        STEP,
        ("first period", options.from),
        ("last period", options.to),
    )?;
    within(STEP, "first period", options.from, shortest, longest)?;
    within(STEP, "last period", options.to, shortest, longest)?;
    within(
        STEP,
        "number of periods",
        options.periods as f64,
        2.0,
        MOST_PERIODS as f64,
    )?;
    let iterations = options.iterations as f64;
    within(
        STEP,
        "number of iterations",
        iterations,
        0.0,
        MOST_ITERATIONS,
    )?;
    let mut periods = logarithmic_periods(options.from, options.to, options.periods)?;
    let check = |r: &Accelerogram| Deviations::of(r, target, options.from, options.to);
    // No adjustment changes where the ground ends: it must be at rest before.
    let end = drift::left_behind(record.samples(), record.time_step());
    let at_rest = drift::ending_at_rest(record, record.samples().to_vec())?;
    let factor = band_factor(
        std::slice::from_ref(&at_rest),
        target,
        options.from,
        options.to,
    )?;
    let mut current = at_rest.scaled_by(factor)?;
    let mut now = check(&current)?;
    let before = now.misfit;
    let mut best = (current.clone(), before, 0);
    let (mut done, mut stalled) = (0, false);
    while best.1.worst > options.tolerance && done < options.iterations {
        let next = adjustment.improve(&current, target, &periods, &now)?;
        done += 1;
        let changed = next != current;
        if changed {
            current = next;
            now = check(&current)?;
        }
        if changed && now.misfit.worst < best.1.worst {
            best = (current.clone(), now.misfit, done);
            continue;
        }
        // What is furthest off lies between the periods, out of their reach.
        let known = periods.len();
        now.add_to(&mut periods, target.damping());
        if !changed && periods.len() == known {
            // The same motion and periods would give the same again.
            stalled = true;
            break;
        }
    }
    let (mut accelerogram, misfit, best_at) = best;
    if misfit.worst > options.tolerance {
        return Err(GroundMotionError::NotMatched {
            worst: misfit.worst,
            period: misfit.period,
            iterations: done,
            best_at,
            stalled,
            tolerance: options.tolerance,
        });
    }
    let step = StepRecord::new(A::NAME)
        .number("first period", options.from, "s")
        .number("last period", options.to, "s")
        .number("damping ratio", target.damping(), "-")
        .number("end velocity taken off", end[0], "m/s")
        .number("end displacement taken off", end[1], "m")
        .number("scale before", factor, "-")
        .number("maximum deviation before", before.worst, "-")
        .number("iterations", done as f64, "-")
        .number("maximum deviation", misfit.worst, "-")
        .number("period of the maximum deviation", misfit.period, "s")
        .number("mean deviation", misfit.mean, "-");
    let steps = vec![achieved(step, &accelerogram)?];
    accelerogram.note(&steps);
    Ok(Matched {
        accelerogram,
        misfit,
        steps,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unit::AccelerationUnit;

    /// Changes nothing at the periods of the start, and has the whole answer at more of them.
    struct FromMorePeriods {
        known: usize,
        answer: Option<Accelerogram>,
    }

    impl Adjustment for FromMorePeriods {
        const NAME: &'static str = "matching from more periods";

        fn improve(
            &mut self,
            record: &Accelerogram,
            _: &TargetSpectrum,
            periods: &[f64],
            _: &Deviations,
        ) -> Result<Accelerogram, GroundMotionError> {
            let more = self.answer.clone().filter(|_| periods.len() > self.known);
            Ok(more.unwrap_or_else(|| record.clone()))
        }
    }

    #[test]
    fn where_nothing_is_brought_periods_in_between_are_tried() {
        // An impulse has accelerations that go with one over the period: they are furthest off at the dip, 0.2 s.
        let periods = vec![0.05, 0.1, 0.2, 0.5, 1.0];
        let target = TargetSpectrum::new(periods, vec![2.0, 1.0, 0.3, 0.2, 0.1], 0.05).unwrap();
        let samples = (0..100).map(|i| if i == 50 { 1.0 } else { 0.0 }).collect();
        let unit = AccelerationUnit::MetrePerSecondSquared;
        let record = Accelerogram::new(samples, unit, 0.02).unwrap();
        let options = MatchOptions {
            periods: 2,
            ..MatchOptions::band(0.1, 0.5)
        };
        let answer = match_by_wavelets(&record, &target, MatchOptions::band(0.1, 0.5));
        let with = |answer| {
            let mut adjustment = FromMorePeriods { known: 2, answer };
            iterate(&record, &target, options, &mut adjustment)
        };
        let matched = with(Some(answer.unwrap().accelerogram)).unwrap();
        assert_eq!(matched.steps[0].get("iterations"), Some(2.0));
        let error = with(None).unwrap_err();
        let stalled = matches!(error, GroundMotionError::NotMatched { stalled: true, .. });
        assert!(stalled, "{error}");
    }
}
