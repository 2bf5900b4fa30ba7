//! Synthetic motions from formulas: pulses in closed form, and random motions that a seed
//! fixes.
//!
//! The same parameters and seed give the same bytes wherever `exp`, `sin` and `ln` of
//! the platform are the same; the random numbers themselves are the same everywhere.

mod boore_2003;
mod clough_penzien_1975;
mod envelope;
mod kanai_tajimi_1960;
mod makris_roussos_2000;
mod mavroeidis_papageorgiou_2003;
mod noise;
mod random_phases;
mod rezaeian_der_kiureghian_2010;
mod ricker_1953;
mod sine;

use std::f64::consts::PI;

use pounding_catalogue::{Descriptor, Registry};

use crate::accelerogram::Accelerogram;
use crate::error::{GroundMotionError, bound, positive, within};
use crate::measures::{GroundMotion, Husid};
use crate::spectra::Evaluation;
use crate::step_record::StepRecord;
use crate::unit::AccelerationUnit;

pub use boore_2003::{Boore2003, Diminution};
pub use clough_penzien_1975::CloughPenzien1975;
pub use envelope::Envelope;
pub use kanai_tajimi_1960::KanaiTajimi1960;
pub use makris_roussos_2000::{MakrisRoussos2000, PulseType};
pub use mavroeidis_papageorgiou_2003::MavroeidisPapageorgiou2003;
pub use random_phases::{PowerSpectrum, StationaryMotion};
pub use rezaeian_der_kiureghian_2010::{
    FaultMechanism, RezaeianDerKiureghian2010, RezaeianDerKiureghianScenario,
};
pub use ricker_1953::Ricker1953;
pub use sine::Sine;

/// All generators by name.
pub static GENERATORS: Registry<Generator> = Registry::new(
    &[
        &Sine::GENERATOR,
        &Ricker1953::GENERATOR,
        &MavroeidisPapageorgiou2003::GENERATOR,
        &MakrisRoussos2000::GENERATOR,
        &KanaiTajimi1960::GENERATOR,
        &CloughPenzien1975::GENERATOR,
        &RezaeianDerKiureghian2010::GENERATOR,
        &Boore2003::GENERATOR,
    ],
    &[],
);

/// What is known of a generator without running it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Generator {
    /// Name on the command line and in reports.
    pub name: &'static str,
    /// What it makes.
    pub title: &'static str,
    /// Author, journal, year.
    pub source: &'static str,
}

impl Descriptor for Generator {
    const KIND: &'static str = "generator of motions";
    const NOUN: &'static str = "generator";

    fn name(&self) -> &'static str {
        self.name
    }
}

/// Most samples of a generated motion.
const MOST_SAMPLES: f64 = 1.0e7;
/// Part of a step by which a duration of whole steps may be off: products of rounded numbers.
const WHOLE: f64 = 1.0e-6;
/// Samples in a period below which straight lines between them lose more than 3 % of a sine: see
/// [`TimeGrid::record`].
const FEWEST_A_PERIOD: f64 = 10.0;

/// Time step and length of a motion to make.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeGrid {
    /// Time step (s).
    pub time_step: f64,
    /// Time of the last sample (s), to the nearest step.
    pub duration: f64,
}

/// A synthetic motion and how it was generated.
#[derive(Debug, Clone, PartialEq)]
pub struct Generated {
    /// The motion.
    pub accelerogram: Accelerogram,
    /// What was asked for and what came of it.
    pub steps: Vec<StepRecord>,
}

impl Generated {
    /// What is to be said of it: the remarks of its steps that are warnings.
    pub fn warnings(&self) -> impl Iterator<Item = &str> {
        let remarks = self.steps.iter().flat_map(|step| &step.remarks);
        remarks.filter_map(|remark| remark.strip_prefix(WARNING))
    }
}

/// What remarks begin with that are warnings.
pub(crate) const WARNING: &str = "warning: ";

impl TimeGrid {
    /// Time step (s) unless another is asked for.
    pub const USUAL_TIME_STEP: f64 = 0.01;

    /// Number of samples.
    ///
    /// # Errors
    /// Steps or durations that are not positive or make too many samples.
    pub fn count(&self) -> Result<usize, GroundMotionError> {
        const STEP: &str = "time grid";
        positive(STEP, "time step", self.time_step)?;
        let longest = self.time_step * MOST_SAMPLES;
        within(STEP, "duration", self.duration, self.time_step, longest)?;
        Ok((self.duration / self.time_step).round() as usize + 1)
    }

    /// The record of a pulse or a sine of a frequency (Hz), with a remark where its samples are so
    /// few that the acceleration between them is another one. Straight lines between `n` samples
    /// of a period have `(n/pi sin(pi/n))^2` of its sine.
    ///
    /// # Errors
    /// A frequency that is not positive, or of which samples at this step show nothing or another
    /// motion: half the sampling rate and more.
    pub(crate) fn record(
        &self,
        generator: &'static str,
        frequency: f64,
    ) -> Result<StepRecord, GroundMotionError> {
        self.count()?;
        positive(generator, "frequency", frequency)?;
        let samples = 1.0 / (frequency * self.time_step);
        // Round-off of a period that is two steps.
        if samples <= 2.0 * (1.0 + 1.0e-9) {
            return Err(GroundMotionError::NotPossible {
                step: generator,
                reason: format!(
                    "samples {} s apart show frequencies below {} Hz, and this one is {} Hz, a period of {} s",
                    bound(self.time_step),
                    bound(0.5 / self.time_step),
                    bound(frequency),
                    bound(1.0 / frequency)
                ),
                remedy: "give a time step of a tenth of the period or less (`--time-step`), or a lower frequency",
            });
        }
        let record = StepRecord::new(generator);
        if samples >= FEWEST_A_PERIOD * (1.0 - 1.0e-9) {
            return Ok(record);
        }
        let kept = (samples / PI * libm::sin(PI / samples)).powi(2);
        Ok(record.remark(format!(
            "only {samples:.1} samples in a period: straight lines between them have {:.0} % less of it",
            100.0 * (1.0 - kept)
        )))
    }

    /// Refuses a pulse that is longer (s) than the motion.
    pub(crate) fn has_room_for(
        &self,
        generator: &'static str,
        length: f64,
    ) -> Result<(), GroundMotionError> {
        // A pulse may end with the motion, whose duration is a sum of rounded numbers.
        if length <= self.duration * (1.0 + 1.0e-9) {
            return Ok(());
        }
        Err(GroundMotionError::NotPossible {
            step: generator,
            reason: format!(
                "the pulse takes {} s, and the duration is {} s",
                bound(length),
                bound(self.duration)
            ),
            remedy: "give a longer duration, or a pulse of a shorter period or fewer oscillations",
        })
    }

    /// Refuses a pulse of this length (s) on either side of its centre (s) that the motion does not hold.
    pub(crate) fn has_room_around(
        &self,
        generator: &'static str,
        centre: f64,
        half: f64,
    ) -> Result<(), GroundMotionError> {
        self.has_room_for(generator, 2.0 * half)?;
        // A part of a step: pulses are put at their own half length.
        let slack = 1.0e-9 * half;
        let (earliest, latest) = (half - slack, self.duration - half + slack);
        within(generator, "centre", centre, earliest, latest)?;
        Ok(())
    }

    /// A function of time at the samples.
    pub(crate) fn sample(
        &self,
        function: impl Fn(f64) -> f64,
    ) -> Result<Vec<f64>, GroundMotionError> {
        let count = self.count()?;
        Ok((0..count)
            .map(|i| function(i as f64 * self.time_step))
            .collect())
    }

    /// A function at the samples from a time (s) to another, and zero beyond them. Where it
    /// jumps there, the samples beside the jump have it by halves, or by what lies on its side of
    /// a step: so the velocity behind it is right. Before the first sample and after the last one
    /// there is no step to share.
    pub(crate) fn sample_between(
        &self,
        (from, to): (f64, f64),
        function: impl Fn(f64) -> f64,
    ) -> Result<Vec<f64>, GroundMotionError> {
        let count = self.count()?;
        let (step, last) = (self.time_step, (count - 1) as f64 * self.time_step);
        let (at_start, at_end) = (function(from), function(to));
        let sample = |t: f64| {
            // What the sample stands for in the integral over time.
            let (left, right) = ((t - 0.5 * step).max(0.0), (t + 0.5 * step).min(last));
            let part = |of: f64| (of / (right - left)).clamp(0.0, 1.0);
            let (begun, goes_on) = (t >= from, t <= to);
            let value = if begun && goes_on { function(t) } else { 0.0 };
            value
                + at_start * (part(right - from) - f64::from(u8::from(begun)))
                + at_end * (part(to - left) - f64::from(u8::from(goes_on)))
        };
        Ok((0..count).map(|i| sample(i as f64 * step)).collect())
    }

    /// The motion with the numbers that it achieved.
    pub(crate) fn finish(
        &self,
        samples: Vec<f64>,
        asked: StepRecord,
    ) -> Result<Generated, GroundMotionError> {
        let unit = AccelerationUnit::MetrePerSecondSquared;
        let mut accelerogram = Accelerogram::new(samples, unit, self.time_step)?;
        let end = accelerogram.duration();
        let asked = if (end - self.duration).abs() <= WHOLE * self.time_step {
            asked
        } else {
            asked.remark(format!(
                "{} s are no whole number of time steps: the last sample is at {} s",
                bound(self.duration),
                bound(end)
            ))
        };
        let steps = vec![achieved(asked, &accelerogram)?];
        accelerogram.note(&steps);
        Ok(Generated {
            accelerogram,
            steps,
        })
    }
}

/// Adds what a motion achieved to what was asked for.
pub(crate) fn achieved(
    step: StepRecord,
    motion: &Accelerogram,
) -> Result<StepRecord, GroundMotionError> {
    let linear = Evaluation::PiecewiseLinear;
    let husid = Husid::of(motion, linear)?;
    let ground = GroundMotion::of(motion, 0.0, 0.0);
    let duration = husid.between(0.05, 0.95)?.duration();
    Ok(step
        .number("achieved peak acceleration", motion.peak().value, "m/s2")
        .number(
            "achieved peak velocity",
            ground.peak_velocity(linear).value,
            "m/s",
        )
        .number("achieved Arias intensity", husid.arias_intensity(), "m/s")
        .number("achieved 5-95 % duration", duration, "s")
        .number("end velocity", ground.end_velocity(), "m/s")
        .number("end displacement", ground.end_displacement(), "m"))
}
