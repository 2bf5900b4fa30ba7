//! The laboratory: a law driven along given deformations.
//!
//! A [`Specimen`] is a law with its parameters, a [`LoadPath`] the deformations that it is led
//! through, a [`Loop`] what came of it. [`dissipation_curve`] cycles an element at many amplitudes.

mod cycles;
mod error;
mod path;
mod specimen;

pub use cycles::{Cycle, Loop};
pub use error::LaboratoryError;
pub use path::{HistoryRow, LoadPath, Pace, Step};
pub use specimen::{Specimen, exponent_of_example};

use crate::law::{HysteresisLaw, Motion};

/// One state of a test.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LaboratoryPoint {
    /// Time (s): since the start, or of a history that states its times.
    pub time: f64,
    /// Deformation (m).
    pub deformation: f64,
    /// Force (N).
    pub force: f64,
    /// Energy dissipated since the start (J).
    pub dissipated: f64,
}

/// How a law is cycled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycling {
    /// Steps of a cycle; rate-independent laws without internal variables need only
    /// 2. Odd numbers are raised by one so that both peaks are met.
    pub steps: usize,
    /// Cycles before the one that is measured.
    pub cycles_before: usize,
    /// Duration of a cycle (s); matters for rate-dependent laws only.
    pub period: f64,
}

impl Default for Cycling {
    /// 400 steps, one cycle before, 1 s.
    fn default() -> Self {
        Self {
            steps: 400,
            cycles_before: 1,
            period: 1.0,
        }
    }
}

/// Drives a new element along deformations (m), one every `step` seconds, on straight
/// paths from zero. The velocity of each step is its mean velocity.
#[must_use]
pub fn history(law: &dyn HysteresisLaw, deformations: &[f64], step: f64) -> Vec<LaboratoryPoint> {
    let mut from = 0.0;
    let motions = deformations.iter().map(|deformation| {
        let velocity = (deformation - from) / step;
        from = *deformation;
        Motion {
            deformation: *deformation,
            velocity,
        }
    });
    drive(law, motions, step)
}

/// Drives a new element through motions, one every `step` seconds.
#[must_use]
pub fn drive(
    law: &dyn HysteresisLaw,
    motions: impl IntoIterator<Item = Motion>,
    step: f64,
) -> Vec<LaboratoryPoint> {
    let steps = motions.into_iter().map(|motion| Step {
        motion,
        duration: step,
    });
    drive_steps(law, steps)
}

/// Drives a new element step by step.
#[must_use]
pub fn drive_steps(
    law: &dyn HysteresisLaw,
    steps: impl IntoIterator<Item = Step>,
) -> Vec<LaboratoryPoint> {
    let mut committed = law.virgin();
    let mut candidate = committed.clone();
    let mut time = 0.0;
    let point = |Step { motion, duration }| {
        let force = law
            .trial(&committed, &mut candidate, motion, duration)
            .force;
        committed.commit(&mut candidate);
        time += duration;
        LaboratoryPoint {
            time,
            deformation: motion.deformation,
            force,
            dissipated: law.dissipated_energy(&committed, motion, committed.variables()),
        }
    };
    steps.into_iter().map(point).collect()
}

/// Energy (J) dissipated in one harmonic cycle of this amplitude (m), from peak to
/// peak after [`Cycling::cycles_before`] such cycles.
#[must_use]
pub fn cycle_dissipation(law: &dyn HysteresisLaw, amplitude: f64, cycling: Cycling) -> f64 {
    let steps = 2 * cycling.steps.div_ceil(2).max(1);
    let rate = std::f64::consts::TAU / steps as f64;
    let frequency = std::f64::consts::TAU / cycling.period;
    let cycles = cycling.cycles_before + 1;
    // A quarter of a cycle leads to the first peak.
    let approach = steps.div_ceil(4);
    let quarter = std::f64::consts::FRAC_PI_2 / approach as f64;
    let phases = (1..=approach)
        .map(|i| libm::sin(i as f64 * quarter))
        .map(|share| (share, (1.0 - share * share).max(0.0).sqrt()))
        .chain((1..=cycles * steps).map(|i| {
            let angle = (i % steps) as f64 * rate;
            (libm::cos(angle), -libm::sin(angle))
        }));
    let motions = phases.map(|(position, speed)| Motion {
        deformation: amplitude * position,
        velocity: amplitude * frequency * speed,
    });
    let points = drive(law, motions, cycling.period / steps as f64);
    let measured = points.len().checked_sub(steps + 1);
    match (measured.and_then(|i| points.get(i)), points.last()) {
        (Some(first), Some(last)) => last.dissipated - first.dissipated,
        _ => 0.0,
    }
}

/// Dissipation of a cycle (J) at each of these amplitudes (m), each with a new
/// element: pairs of amplitude and energy.
#[must_use]
pub fn dissipation_curve(
    law: &dyn HysteresisLaw,
    amplitudes: &[f64],
    cycling: Cycling,
) -> Vec<(f64, f64)> {
    amplitudes
        .iter()
        .map(|amplitude| (*amplitude, cycle_dissipation(law, *amplitude, cycling)))
        .collect()
}

/// [`dissipation_curve`] where it may take too long or overflow.
///
/// # Errors
/// [`LaboratoryError::TooLong`] before any cycle, [`LaboratoryError::Overflow`] after them.
pub fn checked_dissipation_curve(
    specimen: &Specimen,
    amplitudes: &[f64],
    cycling: Cycling,
) -> Result<Vec<(f64, f64)>, LaboratoryError> {
    // To the first peak, then full cycles.
    let lengths = 1.0 + 4.0 * (cycling.cycles_before + 1) as f64;
    specimen.reaches(lengths * amplitudes.iter().sum::<f64>())?;
    let pairs = dissipation_curve(specimen.law.as_ref(), amplitudes, cycling);
    match pairs.iter().find(|(_, energy)| !energy.is_finite()) {
        Some(&(deformation, _)) => Err(LaboratoryError::Overflow { deformation }),
        None => Ok(pairs),
    }
}

/// Slope of the straight line through the logarithms of the pairs that dissipate, by
/// least squares; `None` for fewer than two.
#[must_use]
pub fn log_slope(pairs: &[(f64, f64)]) -> Option<f64> {
    let logarithms: Vec<(f64, f64)> = pairs
        .iter()
        .filter(|(_, energy)| *energy > 0.0)
        .map(|(amplitude, energy)| (libm::log(*amplitude), libm::log(*energy)))
        .collect();
    let count = logarithms.len() as f64;
    let mean = |pick: fn(&(f64, f64)) -> f64| logarithms.iter().map(pick).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let along: f64 = logarithms.iter().map(|p| (p.0 - x).powi(2)).sum();
    let across: f64 = logarithms.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    (logarithms.len() > 1).then_some(across / along)
}

/// [`log_slope`] of a dissipation curve at one of its pairs, from the amplitude before to the
/// one after; `None` where one of them does not dissipate.
#[must_use]
pub fn local_slope(pairs: &[(f64, f64)], index: usize) -> Option<f64> {
    let near = pairs.get(index.saturating_sub(1)..(index + 2).min(pairs.len()))?;
    let dissipates = near.iter().all(|(_, energy)| *energy > 0.0);
    dissipates.then(|| log_slope(near)).flatten()
}
