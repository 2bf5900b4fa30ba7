//! Intensity measures of a record.

mod cumulative;
mod duration;
mod motion;
mod spectral;

use serde::Serialize;

use crate::accelerogram::{Accelerogram, Peak};
use crate::error::{GroundMotionError, positive};
use crate::spectra::Evaluation;

pub use duration::Husid;
pub use motion::GroundMotion;
pub(crate) use motion::integrate;

pub(crate) use pounding_catalogue::STANDARD_GRAVITY as GRAVITY;

/// Constants that measures are defined with.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeasureOptions {
    /// How peaks and integrals are taken.
    pub evaluation: Evaluation,
    /// Velocity at the first sample (m/s).
    pub initial_velocity: f64,
    /// Displacement at the first sample (m).
    pub initial_displacement: f64,
    /// Acceleration (m/s2) of bracketed and uniform duration: 0.05 g.
    pub duration_threshold: f64,
    /// Acceleration (m/s2) that a second must reach to count in the standardised
    /// cumulative absolute velocity: 0.025 g.
    pub velocity_threshold: f64,
    /// Damping ratio of spectral measures: 0.05.
    pub damping: f64,
}

impl Default for MeasureOptions {
    fn default() -> Self {
        Self {
            evaluation: Evaluation::default(),
            initial_velocity: 0.0,
            initial_displacement: 0.0,
            duration_threshold: 0.05 * GRAVITY,
            velocity_threshold: 0.025 * GRAVITY,
            damping: 0.05,
        }
    }
}

/// A stretch of a record.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Span {
    /// Start (s).
    pub start: f64,
    /// End (s).
    pub end: f64,
}

impl Span {
    /// Length (s).
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.end - self.start
    }
}

/// All measures of a record.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct IntensityMeasures {
    /// Constants that they were taken with.
    pub options: MeasureOptions,
    /// Peak ground acceleration PGA (m/s2).
    pub peak_acceleration: Peak,
    /// Peak ground velocity PGV (m/s).
    pub peak_velocity: Peak,
    /// Peak ground displacement PGD (m).
    pub peak_displacement: Peak,
    /// Velocity at the last sample (m/s).
    pub end_velocity: f64,
    /// Displacement at the last sample (m).
    pub end_displacement: f64,
    /// PGV/PGA (s).
    pub velocity_to_acceleration: f64,
    /// Arias intensity `pi/(2 g) int a^2 dt` (m/s; Arias 1970).
    pub arias_intensity: f64,
    /// From 5 to 75 % of the Arias intensity.
    pub significant_5_75: Span,
    /// From 5 to 95 % of the Arias intensity (Trifunac and Brady 1975).
    pub significant_5_95: Span,
    /// From the first to the last time at the threshold; `None` where it is never
    /// reached (Bolt 1969).
    pub bracketed: Option<Span>,
    /// Total time at or above the threshold (s; Bolt 1969).
    pub uniform_duration: f64,
    /// Cumulative absolute velocity `int |a| dt` (m/s; EPRI 1988).
    pub cumulative_absolute_velocity: f64,
    /// The same over those seconds alone whose peak reaches the threshold (m/s; EPRI
    /// 1991).
    pub standardised_cumulative_absolute_velocity: f64,
    /// Root of the mean square acceleration over the 5-95 % duration (m/s2).
    pub root_mean_square_acceleration: f64,
    /// Characteristic intensity `a_rms^1.5 D^0.5` over that duration (m^1.5 s^-2.5;
    /// Park, Ang and Wen 1985).
    pub characteristic_intensity: f64,
    /// Specific energy density `int v^2 dt` (m2/s).
    pub specific_energy_density: f64,
    /// Housner's intensity, PSV over periods from 0.1 to 2.5 s (m; Housner 1952).
    pub housner_intensity: f64,
    /// Acceleration spectrum intensity, PSA over periods from 0.1 to 0.5 s (m/s; Von
    /// Thun and others 1988).
    pub acceleration_spectrum_intensity: f64,
    /// Mean period (s) of Fourier amplitudes from 0.25 to 20 Hz (Rathje, Abrahamson
    /// and Bray 1998); `None` where the record has no such frequency.
    pub mean_period: Option<f64>,
    /// Period (s) of the maximum PSA among 200 from 0.01 to 10 s.
    pub predominant_period: f64,
}

impl IntensityMeasures {
    /// All measures of a record.
    ///
    /// # Errors
    /// Thresholds that are not positive, a damping ratio outside [0, 1), or a record
    /// of zeros, which has no duration.
    pub fn of(record: &Accelerogram, options: MeasureOptions) -> Result<Self, GroundMotionError> {
        Self::of_while(record, options, &|| true)
    }

    /// The same as long as they go on, which is asked between their parts.
    ///
    /// # Errors
    /// As [`of`](Self::of), and [`GroundMotionError::Stopped`].
    pub fn of_while(
        record: &Accelerogram,
        options: MeasureOptions,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Self, GroundMotionError> {
        const STEP: &str = "intensity measures";
        positive(STEP, "duration threshold", options.duration_threshold)?;
        positive(STEP, "velocity threshold", options.velocity_threshold)?;
        let (samples, step) = (record.samples(), record.time_step());
        let evaluation = options.evaluation;
        let start = (options.initial_velocity, options.initial_displacement);
        let motion = GroundMotion::of(record, start.0, start.1);
        let husid = Husid::of(record, evaluation)?;
        let (bracketed, uniform_duration) =
            duration::above(samples, step, options.duration_threshold, evaluation);
        let peak_acceleration = record.peak();
        let peak_velocity = motion.peak_velocity(evaluation);
        let significant_5_95 = husid.between(0.05, 0.95)?;
        let strong = significant_5_95.duration();
        let square = 0.9 * husid.arias_intensity() * 2.0 * GRAVITY / std::f64::consts::PI;
        let root_mean_square = (square / strong).sqrt();
        let spectral = spectral::measures(record, options.damping, evaluation, goes_on)?;
        Ok(Self {
            options,
            peak_acceleration,
            peak_velocity,
            peak_displacement: motion.peak_displacement(evaluation),
            end_velocity: motion.end_velocity(),
            end_displacement: motion.end_displacement(),
            velocity_to_acceleration: peak_velocity.value / peak_acceleration.value,
            arias_intensity: husid.arias_intensity(),
            significant_5_75: husid.between(0.05, 0.75)?,
            significant_5_95,
            bracketed,
            uniform_duration,
            cumulative_absolute_velocity: cumulative::absolute_velocity(samples, step, evaluation),
            standardised_cumulative_absolute_velocity: cumulative::standardised(
                samples,
                step,
                options.velocity_threshold,
                evaluation,
            ),
            root_mean_square_acceleration: root_mean_square,
            characteristic_intensity: libm::pow(root_mean_square, 1.5) * strong.sqrt(),
            specific_energy_density: motion.specific_energy_density(evaluation),
            housner_intensity: spectral.housner_intensity,
            acceleration_spectrum_intensity: spectral.acceleration_spectrum_intensity,
            mean_period: spectral.mean_period,
            predominant_period: spectral.predominant_period,
        })
    }
}
