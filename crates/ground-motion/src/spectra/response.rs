//! Response spectra of linear oscillators.

use std::f64::consts::TAU;

use serde::Serialize;

use crate::accelerogram::{Accelerogram, Peak};
use crate::error::{GroundMotionError, ascending, positive, within};
use crate::spectra::oscillator::{Oscillator, OscillatorPeaks, TOGETHER, peaks_of};
use crate::spectra::{Evaluation, State};

const STEP: &str = "response spectrum";
/// Least period as a part of the time step: below it an oscillator swings thousands
/// of times between two samples, and its spectral acceleration is the peak of the
/// ground.
const LEAST_PERIOD: f64 = 1.0e-3;

/// Peak responses of oscillators of one damping ratio.
///
/// Peaks are those up to the last sample; pad the record to see free vibration after
/// its end.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResponseSpectrum {
    /// Damping ratio (-).
    pub damping: f64,
    /// How peaks were taken.
    pub evaluation: Evaluation,
    /// Periods (s); zero is a rigid oscillator.
    pub periods: Vec<f64>,
    /// Relative displacement SD (m).
    pub displacement: Vec<f64>,
    /// Relative velocity SV (m/s).
    pub velocity: Vec<f64>,
    /// Absolute acceleration SA (m/s2).
    pub acceleration: Vec<f64>,
    /// Pseudo-velocity PSV = w SD (m/s).
    pub pseudo_velocity: Vec<f64>,
    /// Pseudo-acceleration PSA = w^2 SD (m/s2); the peak ground acceleration at
    /// period zero, which is its limit.
    pub pseudo_acceleration: Vec<f64>,
}

/// The history of one oscillator at the samples of the record.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OscillatorResponse {
    /// Relative displacement (m).
    pub displacement: Vec<f64>,
    /// Relative velocity (m/s).
    pub velocity: Vec<f64>,
    /// Peak relative displacement (m) and its time (s), also between samples.
    pub peak_displacement: Peak,
}

/// Damping ratio of spectra where none is given, which is that of codes (-).
pub const USUAL_DAMPING: f64 = 0.05;
/// So many periods give a smooth curve.
pub const SMOOTH: usize = 200;

/// `count` periods (s), evenly spaced in their logarithm, both ends included.
///
/// # Errors
/// Fewer than two periods, or ends that are not `0 < from < to`.
pub fn logarithmic_periods(
    from: f64,
    to: f64,
    count: usize,
) -> Result<Vec<f64>, GroundMotionError> {
    positive(STEP, "first period", from)?;
    positive(STEP, "last period", to)?;
    ascending(STEP, ("first period", from), ("last period", to))?;
    within(STEP, "number of periods", count as f64, 2.0, 1.0e6)?;
    let ratio = libm::log(to / from) / (count - 1) as f64;
    let mut periods: Vec<f64> = (0..count)
        .map(|i| from * libm::exp(ratio * i as f64))
        .collect();
    periods[count - 1] = to;
    Ok(periods)
}

/// One response spectrum: see [`response_spectra`].
///
/// # Errors
/// As [`response_spectra`].
pub fn response_spectrum(
    record: &Accelerogram,
    periods: &[f64],
    damping: f64,
    evaluation: Evaluation,
) -> Result<ResponseSpectrum, GroundMotionError> {
    response_spectrum_while(record, periods, (damping, evaluation), &|| true)
}

/// The same as long as it `goes_on`, which is asked before every period.
///
/// # Errors
/// As [`response_spectra`], and [`GroundMotionError::Stopped`].
pub fn response_spectrum_while(
    record: &Accelerogram,
    periods: &[f64],
    (damping, evaluation): (f64, Evaluation),
    goes_on: &dyn Fn() -> bool,
) -> Result<ResponseSpectrum, GroundMotionError> {
    let step = record.time_step();
    check(periods, damping, step)?;
    let ground = record.peak().value;
    let mut spectrum = ResponseSpectrum::empty(damping, evaluation);
    let swing: Vec<f64> = periods.iter().copied().filter(|t| *t != 0.0).collect();
    let oscillator = |period: &f64| Oscillator::new(*period, damping, step);
    let oscillators: Vec<Oscillator> = swing.iter().map(oscillator).collect();
    let (together, alone) = oscillators.as_chunks::<TOGETHER>();
    let together = together.iter().flat_map(|of| {
        let of = of.each_ref();
        peaks_of(of, record.samples(), evaluation)
    });
    let alone = alone
        .iter()
        .map(|of| of.peaks(record.samples(), evaluation));
    let mut found = together.chain(alone);
    for &period in periods {
        if !goes_on() {
            return Err(GroundMotionError::Stopped);
        }
        let peaks = match period {
            0.0 => None,
            _ => found.next(),
        };
        match peaks {
            Some(peaks) => spectrum.push_peaks(period, &peaks),
            None => spectrum.push(period, [0.0, 0.0, ground, 0.0, ground]),
        }
    }
    Ok(spectrum)
}

/// Response spectra for periods (s; zero is a rigid oscillator) and damping ratios,
/// one spectrum a damping ratio, by the exact recurrence for an acceleration that is
/// linear between samples (Nigam and Jennings 1969), from rest at the first sample.
///
/// # Errors
/// A damping ratio outside [0, 1), or a period that is negative or below a
/// thousandth of the time step (use zero).
pub fn response_spectra(
    record: &Accelerogram,
    periods: &[f64],
    dampings: &[f64],
    evaluation: Evaluation,
) -> Result<Vec<ResponseSpectrum>, GroundMotionError> {
    dampings
        .iter()
        .map(|&damping| response_spectrum(record, periods, damping, evaluation))
        .collect()
}

/// The history of an oscillator of one period (s) and damping ratio.
///
/// # Errors
/// As [`response_spectra`]; a period of zero has no history.
pub fn oscillator_response(
    record: &Accelerogram,
    period: f64,
    damping: f64,
) -> Result<OscillatorResponse, GroundMotionError> {
    let step = record.time_step();
    within(STEP, "period", period, LEAST_PERIOD * step, f64::MAX)?;
    check(&[period], damping, step)?;
    let oscillator = Oscillator::new(period, damping, step);
    let mut state = State::default();
    let mut response = OscillatorResponse {
        displacement: vec![0.0],
        velocity: vec![0.0],
        peak_displacement: oscillator
            .peaks(record.samples(), Evaluation::PiecewiseLinear)
            .displacement,
    };
    for pair in record.samples().windows(2) {
        state = oscillator.advance(state, -pair[0], -pair[1]);
        response.displacement.push(state.displacement);
        response.velocity.push(state.velocity);
    }
    Ok(response)
}

impl ResponseSpectrum {
    /// That of no period as yet.
    pub(super) fn empty(damping: f64, evaluation: Evaluation) -> Self {
        Self {
            damping,
            evaluation,
            periods: Vec::new(),
            displacement: Vec::new(),
            velocity: Vec::new(),
            acceleration: Vec::new(),
            pseudo_velocity: Vec::new(),
            pseudo_acceleration: Vec::new(),
        }
    }

    /// Adds the periods of another spectrum, of the same motion and damping.
    pub fn append(&mut self, other: Self) {
        self.periods.extend(other.periods);
        self.displacement.extend(other.displacement);
        self.velocity.extend(other.velocity);
        self.acceleration.extend(other.acceleration);
        self.pseudo_velocity.extend(other.pseudo_velocity);
        self.pseudo_acceleration.extend(other.pseudo_acceleration);
    }

    /// Adds the peaks of an oscillator of this period (s), above zero.
    pub(super) fn push_peaks(&mut self, period: f64, peaks: &OscillatorPeaks) {
        let frequency = TAU / period;
        let displacement = peaks.displacement.value;
        let values = [
            displacement,
            peaks.velocity.value,
            peaks.acceleration.value,
            frequency * displacement,
            frequency * frequency * displacement,
        ];
        self.push(period, values);
    }

    fn push(&mut self, period: f64, values: [f64; 5]) {
        self.periods.push(period);
        self.displacement.push(values[0]);
        self.velocity.push(values[1]);
        self.acceleration.push(values[2]);
        self.pseudo_velocity.push(values[3]);
        self.pseudo_acceleration.push(values[4]);
    }
}

/// Refuses periods and damping ratios that the recurrence cannot have.
pub(crate) fn check(
    periods: &[f64],
    damping: f64,
    time_step: f64,
) -> Result<(), GroundMotionError> {
    if !(0.0..1.0).contains(&damping) {
        return Err(GroundMotionError::OutOfRange {
            step: STEP,
            name: "damping ratio",
            value: damping,
            range: "[0, 1)".to_owned(),
        });
    }
    for &period in periods.iter().filter(|p| **p != 0.0) {
        within(STEP, "period", period, LEAST_PERIOD * time_step, f64::MAX)?;
    }
    Ok(())
}
