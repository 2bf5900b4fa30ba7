//! Measures taken from spectra.

use std::f64::consts::TAU;

use crate::accelerogram::Accelerogram;
use crate::error::GroundMotionError;
use crate::spectra::{Evaluation, fourier_spectrum, logarithmic_periods, response_spectrum_while};

const FIRST_PERIOD: f64 = 0.1;
/// Steps of the integrals from 0.1 to 0.5 s, where spectra are rugged, and their length (s): the
/// spectrum intensity of El Centro 1940 is off by 0.14 % with 0.01 s.
const ACCELERATION_STEPS: usize = 400;
const SHORT_STEP: f64 = 0.001;
/// Steps from there to 2.5 s.
const FURTHER_STEPS: usize = 400;
const LONG_STEP: f64 = 0.005;
/// Frequencies of the mean period (Hz).
const LEAST_FREQUENCY: f64 = 0.25;
const GREATEST_FREQUENCY: f64 = 20.0;
/// Zeros that bring the frequencies of the mean period at least this near (Hz),
/// as its authors ask for.
const FREQUENCY_STEP: f64 = 0.05;

pub(crate) struct SpectralMeasures {
    pub housner_intensity: f64,
    pub acceleration_spectrum_intensity: f64,
    pub mean_period: Option<f64>,
    pub predominant_period: f64,
}

/// As long as they go on, which is asked before every period and between their parts.
pub(crate) fn measures(
    record: &Accelerogram,
    damping: f64,
    evaluation: Evaluation,
    goes_on: &dyn Fn() -> bool,
) -> Result<SpectralMeasures, GroundMotionError> {
    let spectrum_at =
        |periods: &[f64]| response_spectrum_while(record, periods, (damping, evaluation), goes_on);
    let short = |i| FIRST_PERIOD + SHORT_STEP * i as f64;
    let long = |i| short(ACCELERATION_STEPS) + LONG_STEP * i as f64;
    let periods = (0..=ACCELERATION_STEPS)
        .map(short)
        .chain((1..=FURTHER_STEPS).map(long))
        .collect::<Vec<_>>();
    // Not shorter than the recurrence allows, for records with long steps.
    let shortest = 1.0e-3 * record.time_step();
    let least = 0.01_f64.max(shortest);
    let rigid = periods.partition_point(|period| *period < shortest);
    let spectrum = spectrum_at(&periods[rigid..])?;
    // An oscillator of a shorter period moves with the ground.
    let peak = record.peak().value;
    let pseudo_acceleration = [vec![peak; rigid], spectrum.pseudo_acceleration].concat();
    let of_rigid = periods[..rigid].iter().map(|period| peak * period / TAU);
    let pseudo_velocity = [of_rigid.collect(), spectrum.pseudo_velocity].concat();
    let spread = logarithmic_periods(least, 10.0_f64.max(2.0 * least), 200)?;
    let wide = spectrum_at(&spread)?;
    let (mut predominant_period, mut most) = (0.0, 0.0);
    for (period, a) in spread.iter().zip(&wide.pseudo_acceleration) {
        if *a > most {
            (predominant_period, most) = (*period, *a);
        }
    }
    if !goes_on() {
        return Err(GroundMotionError::Stopped);
    }
    Ok(SpectralMeasures {
        housner_intensity: trapezoid(&periods, &pseudo_velocity),
        acceleration_spectrum_intensity: trapezoid(
            &periods[..=ACCELERATION_STEPS],
            &pseudo_acceleration[..=ACCELERATION_STEPS],
        ),
        mean_period: mean_period(record),
        predominant_period,
    })
}

/// Integral of the values over these periods (s), straight between them.
fn trapezoid(periods: &[f64], values: &[f64]) -> f64 {
    periods
        .windows(2)
        .zip(values.windows(2))
        .map(|(t, v)| 0.5 * (t[1] - t[0]) * (v[0] + v[1]))
        .sum()
}

/// `sum(C^2/f) / sum(C^2)`.
fn mean_period(record: &Accelerogram) -> Option<f64> {
    let least = (1.0 / (FREQUENCY_STEP * record.time_step())).ceil();
    let spectrum = fourier_spectrum(record, least.min(1.0e7) as usize);
    let (mut above, mut below) = (0.0, 0.0);
    for (f, a) in spectrum.frequencies.iter().zip(&spectrum.amplitudes) {
        if (LEAST_FREQUENCY..=GREATEST_FREQUENCY).contains(f) {
            above += a * a / f;
            below += a * a;
        }
    }
    (below > 0.0).then(|| above / below)
}
