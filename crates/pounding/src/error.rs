//! Why a simulation cannot be built or run.

use pounding_gap_element::GapElementError;
use pounding_ground_motion::GroundMotionError;
use pounding_hysteresis::HysteresisError;
use pounding_shear_building::ShearBuildingError;
use pounding_time_history::TimeHistoryError;

/// What can go wrong between a description and its results.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A building cannot be.
    #[error("building {building}: {source}")]
    Building {
        /// Its name.
        building: String,
        /// Why.
        source: ShearBuildingError,
    },
    /// A gap without width or impact model.
    #[error("gap {gap} has no {what}")]
    Incomplete {
        /// Name of the gap.
        gap: String,
        /// What is missing.
        what: &'static str,
    },
    /// An impact model that is not known, or its parameters.
    #[error("gap {gap}: {source}")]
    Model {
        /// Name of the gap.
        gap: String,
        /// Why.
        source: GapElementError,
    },
    /// A law of storeys that is not known, or its parameters.
    #[error("building {building}: {source}")]
    Law {
        /// Its name.
        building: String,
        /// Why.
        source: HysteresisError,
    },
    /// A gap names a building that is not there.
    #[error("gap {gap}: there is no building \"{building}\"")]
    UnknownBuilding {
        /// Name of the gap.
        gap: String,
        /// The name asked for.
        building: String,
        /// The nearest name that there is.
        nearest: Option<String>,
    },
    /// A gap joins buildings that do not stand side by side in this order.
    #[error(
        "gap {gap}: buildings stand in the order given, and a gap joins one to the next on its right"
    )]
    NotNeighbours {
        /// Name of the gap.
        gap: String,
    },
    /// A floor without one of its neighbour at equal elevation.
    #[error(
        "gap {gap}: floor {floor} of {building} at {elevation} m has no floor of its neighbour at equal elevation"
    )]
    UnequalFloors {
        /// Name of the gap.
        gap: String,
        /// The building.
        building: String,
        /// Its floor, from 1.
        floor: usize,
        /// Elevation (m).
        elevation: f64,
    },
    /// Nothing shakes the buildings.
    #[error("the simulation has no ground motion")]
    NoGroundMotion,
    /// The record cannot be read or used.
    #[error(transparent)]
    GroundMotion(#[from] GroundMotionError),
    /// The system, the options, or the run.
    #[error(transparent)]
    Run(#[from] TimeHistoryError),
    /// The case file cannot be read or assembled.
    #[cfg(feature = "toml")]
    #[error(transparent)]
    Case(#[from] pounding_assembly::AssemblyError),
    /// The result cannot be written.
    #[cfg(feature = "hdf5")]
    #[error(transparent)]
    Result(#[from] pounding_results::WriteError),
}

impl Error {
    /// What to try.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Building { .. } => None,
            Self::Incomplete { what, .. } => Some(format!("give it one: `.{what}(...)`")),
            Self::Model { source, .. } => source.help(),
            Self::Law { source, .. } => source.help(),
            Self::UnknownBuilding { nearest, .. } => {
                let name = nearest.as_ref()?;
                Some(format!("did you mean \"{name}\"? A rigid wall is \"wall\""))
            }
            Self::NotNeighbours { .. } => Some(
                "name the left building first, and put neighbours next to each other".to_owned(),
            ),
            Self::UnequalFloors { .. } => Some(
                "correct the storey heights, or name pairs of floors with `.levels(...)`; `.matching_floors_only()` leaves the others out"
                    .to_owned(),
            ),
            Self::NoGroundMotion => Some("give it one: `.ground_motion(...)`".to_owned()),
            Self::GroundMotion(error) => error.help(),
            Self::Run(error) => error.help(),
            #[cfg(feature = "toml")]
            Self::Case(error) => error.help(),
            #[cfg(feature = "hdf5")]
            Self::Result(error) => Some(error.help()),
        }
    }
}
