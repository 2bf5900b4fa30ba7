//! Intensity measures to which records are scaled.

use pounding_case::document::{
    AboveZero, Amount, Entry, Fault, Number, OneOrEach, Optional, Positive, Reader, Time, Within,
};
use pounding_case::{Dimension, Located};
use pounding_ground_motion::Accelerogram;
use pounding_ground_motion::measures::GroundMotion;
use pounding_ground_motion::spectra::{Evaluation, USUAL_DAMPING, response_spectrum};

use schemars::JsonSchema;
use serde::Deserialize;

use super::context::Context;
use super::keys::not_both;
use super::values::all;
use crate::error::StudyError;

/// What is held at a value by scaling a record. Every measure grows in proportion to the
/// record.
#[derive(Debug, Clone, PartialEq)]
pub enum IntensityMeasure {
    /// Maximum ground acceleration (m/s2).
    PeakGroundAcceleration,
    /// Maximum ground velocity (m/s), from the initial velocity that the file of the record states, exact
    /// for an acceleration that is linear between samples.
    PeakGroundVelocity,
    /// Geometric mean of pseudo-spectral accelerations (m/s2) at some periods: one
    /// period is PSA(T), the Sa(T) of most hazard curves, those of several buildings are their geometric mean.
    SpectralAcceleration {
        /// Periods (s).
        periods: Vec<f64>,
        /// Damping ratio (-).
        damping: f64,
    },
    /// The same over a band, 30 periods from 0.2 to 3 times one, the average Sa of Eads,
    /// Miranda and Lignos (2015), Earthq. Eng. Struct. Dyn. 44, 2057.
    AverageSpectralAcceleration {
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
                let (velocity, displacement) = record.initial().unwrap_or_default();
                GroundMotion::of(record, velocity, displacement)
                    .peak_velocity(evaluation)
                    .value
            }
            Self::SpectralAcceleration { periods, damping }
            | Self::AverageSpectralAcceleration { periods, damping } => {
                let spectrum = response_spectrum(record, periods, *damping, evaluation)?;
                let values = &spectrum.pseudo_acceleration;
                let sum: f64 = values.iter().map(|a| libm::log(*a)).sum();
                libm::exp(sum / values.len() as f64)
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
                let sa = match periods.as_slice() {
                    [one] => format!("PSA({one:.4} s)"),
                    [a, b] => format!("geometric mean of PSA({a:.4} s) and PSA({b:.4} s)"),
                    many => format!("geometric mean of PSA at {}", from_to(many)),
                };
                format!("{sa}, {}", damped(*damping))
            }
            Self::AverageSpectralAcceleration { periods, damping } => {
                format!(
                    "average PSA over {}, {}",
                    from_to(periods),
                    damped(*damping)
                )
            }
        }
    }

    /// The geometric mean of its periods (s) where that is above 1 s, from which on accelerations fall
    /// with the period; else 1.
    pub(super) fn long_period(&self) -> f64 {
        match self {
            Self::SpectralAcceleration { periods, .. }
            | Self::AverageSpectralAcceleration { periods, .. } => {
                let sum: f64 = periods.iter().map(|period| libm::log(*period)).sum();
                libm::exp(sum / periods.len() as f64).max(1.0)
            }
            Self::PeakGroundAcceleration | Self::PeakGroundVelocity => 1.0,
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

fn from_to(periods: &[f64]) -> String {
    format!(
        "{} periods from {:.4} to {:.4} s",
        periods.len(),
        periods.iter().copied().fold(f64::INFINITY, f64::min),
        periods.iter().copied().fold(0.0, f64::max)
    )
}

fn damped(damping: f64) -> String {
    format!("{} % damping", damping * 100.0)
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
        let averages = measure
            .as_ref()
            .is_some_and(|m| m.value == Measure::AverageSpectralAcceleration);
        let listed = self.period.span();
        let damping = self.damping.number_or(USUAL_DAMPING);
        let periods = periods(reader, self.building, self.period, context)?;
        if let Some(place) = listed.filter(|_| averages && periods.len() > 1) {
            let message = "`period` of average_spectral_acceleration is one: the average is over 30 periods from 0.2 to 3 times it, not over a list";
            let help = "give one period, or take intensity = \"spectral_acceleration\" for the geometric mean over these periods";
            return reader.refuse(place, message, help);
        }
        let damping = damping?;
        measure.map(|_| match averages {
            true => IntensityMeasure::AverageSpectralAcceleration {
                periods: band(&periods),
                damping,
            },
            false => IntensityMeasure::SpectralAcceleration { periods, damping },
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
    let sum: f64 = periods.iter().map(|t| libm::log(*t)).sum();
    let middle = libm::exp(sum / periods.len() as f64);
    let (from, to) = (0.2 * middle, 3.0 * middle);
    let step = libm::log(to / from) / (AVERAGED - 1) as f64;
    (0..AVERAGED)
        .map(|i| from * libm::exp(step * i as f64))
        .collect()
}
