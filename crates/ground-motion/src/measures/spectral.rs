//! Measures taken from spectra.

use crate::accelerogram::Accelerogram;
use crate::error::GroundMotionError;
use crate::spectra::{Evaluation, fourier_spectrum, logarithmic_periods, response_spectrum};

/// Periods of the integrals are this far apart (s).
const PERIOD_STEP: f64 = 0.01;
const FIRST_PERIOD: f64 = 0.1;
/// Steps from 0.1 to 0.5 s and to 2.5 s.
const ACCELERATION_STEPS: usize = 40;
const VELOCITY_STEPS: usize = 240;
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

pub(crate) fn measures(
    record: &Accelerogram,
    damping: f64,
    evaluation: Evaluation,
) -> Result<SpectralMeasures, GroundMotionError> {
    let even: Vec<f64> = (0..=VELOCITY_STEPS)
        .map(|i| FIRST_PERIOD + PERIOD_STEP * i as f64)
        .collect();
    let spectrum = response_spectrum(record, &even, damping, evaluation)?;
    // Not shorter than the recurrence allows, for records with long steps.
    let least = 0.01_f64.max(1.0e-3 * record.time_step());
    let spread = logarithmic_periods(least, 10.0_f64.max(2.0 * least), 200)?;
    let wide = response_spectrum(record, &spread, damping, evaluation)?;
    let (mut predominant_period, mut most) = (0.0, 0.0);
    for (period, a) in spread.iter().zip(&wide.pseudo_acceleration) {
        if *a > most {
            (predominant_period, most) = (*period, *a);
        }
    }
    Ok(SpectralMeasures {
        housner_intensity: trapezoid(&spectrum.pseudo_velocity),
        acceleration_spectrum_intensity: trapezoid(
            &spectrum.pseudo_acceleration[..=ACCELERATION_STEPS],
        ),
        mean_period: mean_period(record),
        predominant_period,
    })
}

fn trapezoid(values: &[f64]) -> f64 {
    values
        .windows(2)
        .map(|v| 0.5 * PERIOD_STEP * (v[0] + v[1]))
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
