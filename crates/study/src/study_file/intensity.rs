//! Intensity measures to which records are scaled.

use pounding_case::Dimension;
use pounding_ground_motion::Accelerogram;
use pounding_ground_motion::measures::GroundMotion;
use pounding_ground_motion::spectra::{Evaluation, response_spectrum};

use super::context::Context;
use super::reader::{Result, Table, Wrong};
use crate::error::StudyError;

/// What is held at a value by scaling a record. Every measure grows in proportion to the
/// record.
#[derive(Debug, Clone, PartialEq)]
pub enum IntensityMeasure {
    /// Maximum ground acceleration (m/s2).
    PeakGroundAcceleration,
    /// Maximum ground velocity (m/s), from rest, exact for an acceleration that is linear
    /// between samples.
    PeakGroundVelocity,
    /// Geometric mean of pseudo-spectral accelerations (m/s2) over some periods: one
    /// period is Sa(T); those of two buildings are their geometric mean; a band is the
    /// average Sa of Eads, Miranda and Lignos (2015), Earthq. Eng. Struct. Dyn. 44, 2057.
    SpectralAcceleration {
        /// Periods (s).
        periods: Vec<f64>,
        /// Damping ratio (-).
        damping: f64,
    },
}

/// Periods of a default average, 0.2 to 3 times the building's, evenly spaced in their
/// logarithm.
const AVERAGED: usize = 30;

impl IntensityMeasure {
    /// Value of a motion (SI).
    ///
    /// # Errors
    /// Periods too short for the time step of the record.
    pub fn of(&self, record: &Accelerogram) -> std::result::Result<f64, StudyError> {
        let evaluation = Evaluation::PiecewiseLinear;
        Ok(match self {
            Self::PeakGroundAcceleration => record.peak().value,
            Self::PeakGroundVelocity => {
                GroundMotion::of(record, 0.0, 0.0)
                    .peak_velocity(evaluation)
                    .value
            }
            Self::SpectralAcceleration { periods, damping } => {
                let spectrum = response_spectrum(record, periods, *damping, evaluation)?;
                let values = &spectrum.pseudo_acceleration;
                let sum: f64 = values.iter().map(|a| a.ln()).sum();
                (sum / values.len() as f64).exp()
            }
        })
    }

    /// What it is, for people.
    #[must_use]
    pub fn title(&self) -> String {
        match self {
            Self::PeakGroundAcceleration => "peak ground acceleration".to_owned(),
            Self::PeakGroundVelocity => "peak ground velocity".to_owned(),
            Self::SpectralAcceleration { periods, damping } => {
                let part = format!("{} % damping", damping * 100.0);
                match periods.as_slice() {
                    [one] => format!("Sa({one:.4} s), {part}"),
                    [a, b] => format!("geometric mean of Sa({a:.4} s) and Sa({b:.4} s), {part}"),
                    many => format!(
                        "average Sa over {} periods from {:.4} to {:.4} s, {part}",
                        many.len(),
                        many.iter().copied().fold(f64::INFINITY, f64::min),
                        many.iter().copied().fold(0.0, f64::max)
                    ),
                }
            }
        }
    }

    /// Dimension of its values.
    #[must_use]
    pub fn dimension(&self) -> Dimension {
        match self {
            Self::PeakGroundVelocity => Dimension::VELOCITY,
            _ => Dimension::ACCELERATION,
        }
    }
}

/// Reads `intensity` with `building`, `period` and `damping`.
pub(super) fn intensity(table: &Table<'_, '_>, context: &Context<'_>) -> Result<IntensityMeasure> {
    let reader = table.reader;
    let value = table.required("intensity")?;
    let name = reader.text(value, "intensity")?;
    let of_ground = match name.as_str() {
        "peak_ground_acceleration" => Some(IntensityMeasure::PeakGroundAcceleration),
        "peak_ground_velocity" => Some(IntensityMeasure::PeakGroundVelocity),
        _ => None,
    };
    if let Some(measure) = of_ground {
        for key in ["building", "period", "damping"] {
            if let Some(extra) = table.get(key) {
                reader.check(Err(reader.error(
                    extra.span(),
                    format!("`{key}` has no meaning for {name}"),
                    "remove it",
                )));
            }
        }
        return Ok(measure);
    }
    let averaged = match name.as_str() {
        "spectral_acceleration" => Ok(false),
        "average_spectral_acceleration" => Ok(true),
        _ => Err(reader.error(
            value.span(),
            format!("unknown intensity measure \"{name}\""),
            "known are peak_ground_acceleration, peak_ground_velocity, spectral_acceleration, average_spectral_acceleration",
        )),
    };
    let averaged = reader.keep(averaged);
    let damping = table.or("damping", 0.05, |v| {
        let ratio = reader.positive(v, "damping", Dimension::NUMBER)?;
        if ratio < 1.0 {
            return Ok(ratio);
        }
        Err(reader.error(
            v.span(),
            format!("`damping` = {ratio} must be a ratio below 1"),
            "5 % is 0.05, or \"5 %\"",
        ))
    });
    let damping = reader.keep(damping);
    let periods = periods(table, context)?;
    let (averaged, damping) = averaged.zip(damping).ok_or(Wrong::Recorded)?;
    Ok(IntensityMeasure::SpectralAcceleration {
        periods: if averaged { band(&periods) } else { periods },
        damping,
    })
}

/// The periods that a table names, by themselves or by buildings.
fn periods(table: &Table<'_, '_>, context: &Context<'_>) -> Result<Vec<f64>> {
    let reader = table.reader;
    table.not_both("building", "period")?;
    if let Some(value) = table.get("period") {
        let read = |v| reader.positive(v, "period", Dimension::TIME);
        return match reader.list(value, "period") {
            Ok(items) => reader.all(items.iter().map(read)),
            Err(_) => Ok(vec![read(value)?]),
        };
    }
    let Some(value) = table.get("building") else {
        // Neither building is the one that counts.
        return Ok(context.base()?.first_periods.clone());
    };
    let items = match value.get_ref().as_array() {
        Some(_) => reader.list(value, "building")?.iter().collect(),
        None => vec![value],
    };
    let at = reader.all(
        items
            .into_iter()
            .map(|item| context.building(&reader, item)),
    )?;
    let first = &context.base()?.first_periods;
    Ok(at.into_iter().map(|i| first[i]).collect())
}

/// From 0.2 to 3 times the geometric mean of some periods.
fn band(periods: &[f64]) -> Vec<f64> {
    let sum: f64 = periods.iter().map(|t| t.ln()).sum();
    let middle = (sum / periods.len() as f64).exp();
    let (from, to) = (0.2 * middle, 3.0 * middle);
    let step = (to / from).ln() / (AVERAGED - 1) as f64;
    (0..AVERAGED)
        .map(|i| from * (step * i as f64).exp())
        .collect()
}
