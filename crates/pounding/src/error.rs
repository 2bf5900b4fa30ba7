//! Why a simulation cannot be built or run.

use pounding_gap_element::GapElementError;
use pounding_ground_motion::GroundMotionError;
use pounding_hysteresis::HysteresisError;
use pounding_shear_building::{LateralStiffnessError, NameError, ShearBuildingError};
use pounding_time_history::TimeHistoryError;

use crate::help;

/// What can go wrong between a description and its results.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A building cannot be; the error names it.
    #[error(transparent)]
    Building(#[from] ShearBuildingError),
    /// A matrix that is no stiffness of a building.
    #[error(transparent)]
    LateralStiffness(#[from] LateralStiffnessError),
    /// A storey with a stiffness of its own beside a stiffness matrix, or a floor with neither.
    #[error("building {building}, storey {storey}: {}", match matrix {
        true => "it has a stiffness, and the building a stiffness matrix",
        false => "it has no stiffness, and the building no stiffness matrix",
    })]
    StiffnessOfStorey {
        /// Name of the building.
        building: String,
        /// Storey, from 1.
        storey: usize,
        /// Whether the building has a matrix.
        matrix: bool,
    },
    /// P-Delta of a building on isolators.
    #[error(
        "building {building}: P-Delta does not go with isolators, whose law holds what the weight does at their displacement"
    )]
    GravityOnIsolators {
        /// Name of the building.
        building: String,
    },
    /// The damping of a building on isolators, for one that stands on none.
    #[error("building {building}: its damping is that of a building on isolators, and it has none")]
    DampingOfIsolators {
        /// Name of the building.
        building: String,
    },
    /// Floors that act on each other as if they were level, in a gap that names no pairs of floors.
    #[error("gap {gap}: `.floor_to_floor()` has no meaning without pairs of floors")]
    FloorToFloor {
        /// Name of the gap.
        gap: String,
    },
    /// A building that is not said to be damped, nor to be undamped.
    #[error("building {building} has no damping")]
    NoDamping {
        /// Its name.
        building: String,
    },
    /// A name that cannot stand in messages and results, or is taken.
    #[error("{name:?} cannot name a {what}: {reason}")]
    Name {
        /// The name.
        name: String,
        /// Building or gap.
        what: &'static str,
        /// Why.
        reason: &'static str,
    },
    /// A gap or link that no floors face each other across.
    #[error("{of} has no {level}")]
    NoLevel {
        /// Gap or link.
        of: String,
        /// What its levels are called.
        level: &'static str,
    },
    /// Floors at different elevations that were named as a pair.
    #[error("gap {gap}: {floors} differ in elevation by {difference} m")]
    NotLevel {
        /// Name of the gap.
        gap: String,
        /// The first pair.
        floors: String,
        /// Difference (m).
        difference: f64,
    },
    /// A parameter that is given twice.
    #[error("{of}: parameter `{parameter}` is given twice")]
    Twice {
        /// Gap, building or link.
        of: String,
        /// Name of the parameter.
        parameter: String,
    },
    /// A level that is given twice: both would act.
    #[error("{of}: the level of storeys {left} and {right} is given twice")]
    LevelTwice {
        /// Gap or link.
        of: String,
        /// Storey of the left side, from 1.
        left: String,
        /// Storey of the right side, from 1.
        right: String,
    },
    /// Two gaps between the same neighbours: both would act.
    #[error("gap {gap} is between the same two as gap {first}")]
    SecondGap {
        /// Name of the gap.
        gap: String,
        /// Name of the first of them.
        first: String,
    },
    /// A separation rule beside an impact model of one's own, which has its own rule.
    #[error(
        "gap {gap}: the separation rule is of an impact model by name, and the gap has one of one's own"
    )]
    RuleBesideModel {
        /// Name of the gap.
        gap: String,
    },
    /// A gap without width or impact model, or a link without law.
    #[error("{of} has no {what}")]
    Incomplete {
        /// Gap or link.
        of: String,
        /// What is missing.
        what: &'static str,
    },
    /// An impact model that is not known, or its parameters.
    #[error("gap {gap}: {reason}")]
    Model {
        /// Name of the gap.
        gap: String,
        /// Why.
        reason: GapElementError,
    },
    /// As many widths as the gap has no levels.
    #[error("gap {gap}: {widths} widths for {levels} contact levels")]
    Widths {
        /// Name of the gap.
        gap: String,
        /// Widths given.
        widths: usize,
        /// Contact levels.
        levels: usize,
    },
    /// A law of storeys or of a link that is not known, or its parameters.
    #[error("{of}: {reason}")]
    Law {
        /// Building or link.
        of: String,
        /// Why.
        reason: HysteresisError,
    },
    /// A law of a storey that cannot have it.
    #[error("building {building}, law of storey {storey}: {reason}")]
    LawOfStorey {
        /// Name of the building.
        building: String,
        /// Storey, from 1.
        storey: usize,
        /// Why.
        reason: &'static str,
    },
    /// A state at time zero of other floors than the building has.
    #[error("building {building}: {given} values at time zero for {storeys} floors")]
    InitialState {
        /// Its name.
        building: String,
        /// Values given.
        given: usize,
        /// Floors that there are.
        storeys: usize,
    },
    /// A gap or link names a building that is not there.
    #[error("{of}: there is no building \"{building}\"")]
    UnknownBuilding {
        /// Gap or link.
        of: String,
        /// The name asked for.
        building: String,
        /// The name that is meant, if it is like one.
        nearest: Option<String>,
    },
    /// A force on a wall.
    #[error("a force on \"wall\": a rigid wall does not move by it")]
    ForceOnWall,
    /// A storey above the roof.
    #[error("{of}: {building} has no storey {storey}")]
    UnknownStorey {
        /// Gap, link or force.
        of: String,
        /// Name of the building.
        building: String,
        /// The storey asked for, from 1.
        storey: usize,
        /// Its highest storey.
        highest: usize,
    },
    /// A storey of the number zero.
    #[error("{of}: there is no storey 0")]
    StoreyZero {
        /// Gap or link.
        of: String,
    },
    /// A gap or link joins buildings that do not stand side by side in this order.
    #[error("{of}: {reason}")]
    NotNeighbours {
        /// Gap or link.
        of: String,
        /// What its sides are instead.
        reason: String,
        /// What to do.
        remedy: &'static str,
    },
    /// A floor without one of its neighbour at equal elevation.
    #[error(
        "{of}: floor {floor} of {building} at {elevation} m has no floor of its neighbour at equal elevation"
    )]
    UnequalFloors {
        /// Gap or link.
        of: String,
        /// The building.
        building: String,
        /// Its floor, from 1.
        floor: usize,
        /// Elevation (m).
        elevation: f64,
    },
    /// A simulation of nothing.
    #[error("the simulation has no buildings")]
    NoBuildings,
    /// Nothing shakes the buildings.
    #[error("the simulation has no ground motion")]
    NoGroundMotion,
    /// The record cannot be read or used.
    #[error(transparent)]
    GroundMotion(#[from] GroundMotionError),
    /// The system, the options, or the run.
    #[error(transparent)]
    Run(#[from] TimeHistoryError),
    /// Who was asked whether to go on ended the run ([`Model::run_while`](crate::Model::run_while)).
    #[error("the run was ended with {:.0} % of its duration done", 100.0 * done)]
    Stopped {
        /// Part of the duration that was done (-).
        done: f64,
    },
    /// The case file cannot be read or assembled.
    #[cfg(feature = "toml")]
    #[error(transparent)]
    Case(#[from] pounding_assembly::AssemblyError),
    /// The result cannot be written.
    #[cfg(feature = "hdf5")]
    #[error(transparent)]
    Result(#[from] pounding_results::WriteError),
    /// The result would be larger than any disk.
    #[cfg(feature = "hdf5")]
    #[error(transparent)]
    TooLarge(#[from] pounding_results::ResponsesTooLarge),
    /// The result would replace the case file or the record.
    #[cfg(feature = "hdf5")]
    #[error(transparent)]
    FileUse(#[from] pounding_files::FileUseError),
}

#[cfg(feature = "toml")]
impl From<pounding_case::CaseError> for Error {
    fn from(error: pounding_case::CaseError) -> Self {
        Self::Case(error.into())
    }
}

impl Error {
    /// What to try, in words of this library; of a case file ([`Error::Case`]), by its keys.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        match self {
            Self::GravityOnIsolators { .. } => Some("leave `.p_delta()` out".to_owned()),
            Self::DampingOfIsolators { .. } => Some(
                "make the building by `Building::isolated(...)`, or give it the damping of its storeys alone"
                    .to_owned(),
            ),
            Self::FloorToFloor { .. } => Some(
                "name the pairs of storeys that may touch by `.levels(...)`, or leave it out"
                    .to_owned(),
            ),
            Self::Building(ShearBuildingError::NoStoreys { .. }) => Some(
                "`.storeys(...)` adds them, and `.floors(...)` those of a building with a stiffness matrix"
                    .to_owned(),
            ),
            Self::Building(
                ShearBuildingError::Unstable { .. } | ShearBuildingError::UnstableMatrix { .. },
            ) => Some(
                "correct stiffness, masses and heights, with their units, or leave `.p_delta()` out".to_owned(),
            ),
            Self::Building(error) => help::of_building(error),
            Self::LateralStiffness(error) => Some(error.help().to_owned()),
            Self::Stopped { .. } => None,
            Self::Twice { .. } => Some("give it once".to_owned()),
            Self::StiffnessOfStorey { .. } => Some(
                "`Building::shear(...)` takes storeys, `Building::stiffness_matrix(...)` floors"
                    .to_owned(),
            ),
            Self::NoDamping { .. } => {
                Some("damp it by `.damping(...)`, or say `.undamped()`".to_owned())
            }
            Self::Name { .. } => Some(NameError::HELP.to_owned()),
            Self::NoLevel { .. } => {
                Some("name pairs of storeys by `.levels(...)`, or correct the storey heights".to_owned())
            }
            Self::NotLevel { .. } => Some(
                "name floors at equal elevation; `.floor_to_floor()` lets these act on each other as if they were level, a simplification that leaves out the columns which they hit"
                    .to_owned(),
            ),
            Self::LevelTwice { .. } => Some("name each pair of storeys once".to_owned()),
            Self::SecondGap { .. } => {
                Some("give one of them all levels by `.levels(...)`, with their `.widths(...)`".to_owned())
            }
            Self::RuleBesideModel { .. } => Some("leave `.separation(...)` out".to_owned()),
            Self::Incomplete { what, .. } => Some(format!("give it one: `.{what}(...)`")),
            Self::Model { reason, .. } => help::of_model(reason),
            Self::Law { reason, .. } => help::of_law(reason),
            Self::Widths { .. } => {
                Some("give one width per level, bottom first, or a single one by `.width(...)`".to_owned())
            }
            Self::LawOfStorey { .. } => {
                Some("storeys are numbered from 1, and each takes one law".to_owned())
            }
            Self::InitialState { .. } => Some("give one value per floor, the lowest first".to_owned()),
            Self::UnknownBuilding { nearest, .. } => {
                let guess = nearest
                    .as_ref()
                    .map_or_else(String::new, |name| format!("did you mean \"{name}\"? "));
                Some(format!("{guess}A rigid wall is \"wall\""))
            }
            Self::ForceOnWall => {
                Some("name a building: a force pushes the floor above one of its storeys".to_owned())
            }
            Self::UnknownStorey { highest, .. } => {
                Some(format!("its storeys are numbered from 1 at the bottom to {highest}"))
            }
            Self::StoreyZero { .. } => Some("storeys are numbered from 1".to_owned()),
            Self::NotNeighbours { remedy, .. } => Some((*remedy).to_owned()),
            Self::UnequalFloors { .. } => Some(
                "correct the storey heights, or name pairs of floors with `.levels(...)`, to which alone `.floor_to_floor()` applies; `.matching_floors_only()` leaves the others out"
                    .to_owned(),
            ),
            Self::NoGroundMotion => Some("give it one: `.ground_motion(...)`".to_owned()),
            Self::NoBuildings => Some("give it some: `Simulation::of([...])`".to_owned()),
            Self::GroundMotion(error) => Some(help::of_motion(error)),
            Self::Run(error) => help::of_run(error),
            #[cfg(feature = "toml")]
            Self::Case(error) => error.help(),
            #[cfg(feature = "hdf5")]
            Self::Result(error) => Some(help::of_result(error)),
            #[cfg(feature = "hdf5")]
            Self::TooLarge(_) => Some(help::OF_SIZE.to_owned()),
            #[cfg(feature = "hdf5")]
            Self::FileUse(error) => Some(error.help()),
        }
    }
}

/// Refuses parameters that are given twice.
pub(crate) fn once<'p>(of: &str, names: impl Iterator<Item = &'p str>) -> Result<(), Error> {
    let mut seen = std::collections::BTreeSet::new();
    for name in names {
        if !seen.insert(name) {
            return Err(Error::Twice {
                of: of.to_owned(),
                parameter: name.to_owned(),
            });
        }
    }
    Ok(())
}

/// Message and help: what a `main` that returns this error prints.
impl std::fmt::Debug for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{self}")?;
        match self.help() {
            Some(help) => write!(f, "\n  help: {help}"),
            None => Ok(()),
        }
    }
}
