//! Intensity measures to which records are scaled.

use pounding_case::document::{
    AboveZero, Amount, Entry, Fault, Number, OneOrEach, Optional, Positive, Reader, Time, Within,
};
use pounding_case::{Dimension, Located};
use pounding_ground_motion::Accelerogram;
use pounding_ground_motion::measures::GroundMotion;
use pounding_ground_motion::spectra::{Evaluation, response_spectrum};

use schemars::JsonSchema;
use serde::Deserialize;

use super::context::Context;
use super::values::{all, not_both};
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
    pub fn of(&self, record: &Accelerogram) -> Result<f64, StudyError> {
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

/// Intensity measure
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(
    rename = "intensity measure",
    rename_all = "snake_case",
    expecting = "a text in quotes"
)]
pub(super) enum Measure {
    PeakGroundAcceleration,
    PeakGroundVelocity,
    SpectralAcceleration,
    AverageSpectralAcceleration,
}

/// The range of a damping ratio that a spectrum is computed with.
#[derive(Debug)]
pub(super) struct BelowOne;

impl Within for BelowOne {
    const SCHEMA: &[(&str, f64)] = &[("exclusiveMinimum", 0.0), ("exclusiveMaximum", 1.0)];
    fn check(value: f64) -> Result<(), Fault> {
        AboveZero::check(value)?;
        match value < 1.0 {
            true => Ok(()),
            false => Err(Fault::new(
                format!(" = {value} must be a ratio below 1"),
                "5 % is 0.05, or \"5 %\"",
            )),
        }
    }
}

/// What a variable says of its intensity.
pub(super) struct IntensityKeys {
    pub intensity: Optional<Measure>,
    pub building: Optional<OneOrEach<Located<String>>>,
    pub period: Optional<OneOrEach<Positive<Time>>>,
    pub damping: Optional<Amount<Number, BelowOne>>,
}

impl IntensityKeys {
    /// The measure.
    pub(super) fn read(self, reader: &Reader<'_>, context: &Context) -> Option<IntensityMeasure> {
        let measure = self.intensity.located();
        let of_ground = measure.as_ref().and_then(|measure| match measure.value {
            Measure::PeakGroundAcceleration => Some(IntensityMeasure::PeakGroundAcceleration),
            Measure::PeakGroundVelocity => Some(IntensityMeasure::PeakGroundVelocity),
            _ => None,
        });
        if let (Some(of_ground), Some(measure)) = (of_ground, &measure) {
            let name = reader.source[measure.span.clone()].trim_matches(['"', '\'']);
            for (key, place) in [
                ("building", self.building.span()),
                ("period", self.period.span()),
                ("damping", self.damping.span()),
            ] {
                place.and_then(|place| {
                    let message = format!("`{key}` has no meaning for {name}");
                    reader.refuse::<()>(place, message, "remove it")
                });
            }
            return Some(of_ground);
        }
        let damping = self.damping.number_or(0.05);
        let periods = periods(reader, self.building, self.period, context)?;
        Some(IntensityMeasure::SpectralAcceleration {
            periods: match measure?.value {
                Measure::AverageSpectralAcceleration => band(&periods),
                _ => periods,
            },
            damping: damping?,
        })
    }
}

/// The periods that a table names, by themselves or by buildings.
fn periods(
    reader: &Reader<'_>,
    building: Optional<OneOrEach<Located<String>>>,
    period: Optional<OneOrEach<Positive<Time>>>,
    context: &Context,
) -> Option<Vec<f64>> {
    let places = (("building", building.span()), ("period", period.span()));
    not_both(reader, "[[variable]]", places.0, places.1)?;
    if let Some(periods) = period.stated()? {
        let periods = periods.value.into_list().into_iter();
        return Some(periods.map(f64::from).collect());
    }
    let buildings = building.stated()?.map(|names| names.value.into_list());
    let at = buildings.map(|names| all(names.iter().map(|name| context.building(reader, name))));
    let first = context.base.as_ref().map(|base| &base.fundamental_periods);
    match at {
        Some(at) => {
            let (at, first) = at.zip(first)?;
            Some(at.into_iter().map(|i| first[i]).collect())
        }
        // Neither building is the one that counts.
        None => first.cloned(),
    }
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
