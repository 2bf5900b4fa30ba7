//! What can be wrong with a building.

use crate::foundation::FoundationError;

/// A value without hundreds of zeros.
fn short(value: f64) -> String {
    match (1.0e-6..1.0e12).contains(&value.abs()) || value == 0.0 {
        true => value.to_string(),
        false => format!("{value:e}"),
    }
}

/// A building that cannot be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShearBuildingError {
    /// No storeys.
    #[error("building {building} has no storeys")]
    NoStoreys {
        /// Name of the building.
        building: String,
    },
    /// More storeys than the modes of a building can have.
    #[error(
        "building {building} has {storeys} storeys; a building can have {largest} at most, as memory and work of its modes grow with the square of the storeys"
    )]
    TooManyStoreys {
        /// Name of the building.
        building: String,
        /// Storeys.
        storeys: usize,
        /// Storeys at most.
        largest: usize,
    },
    /// Lists of unequal length.
    #[error("building {building}: {quantity} has {found} values for {expected} storeys")]
    Length {
        /// Name of the building.
        building: String,
        /// Quantity with the wrong number of values.
        quantity: &'static str,
        /// Values given.
        found: usize,
        /// Storeys.
        expected: usize,
    },
    /// A storey of a wall or a frame whose stiffness is that of another height.
    #[error(
        "building {building}, storey {storey}: its height is {height} m, and the stiffness matrix is that of a storey of {of_matrix} m"
    )]
    OtherHeight {
        /// Name of the building.
        building: String,
        /// Storey, from 1.
        storey: usize,
        /// Height (m).
        height: f64,
        /// Height from which the matrix was made (m).
        of_matrix: f64,
    },
    /// A value that is not finite, or not positive where it must be.
    #[error("building {building}, storey {storey}: {quantity} = {} must be {required}", short(*value))]
    Value {
        /// Name of the building.
        building: String,
        /// Quantity.
        quantity: &'static str,
        /// Storey, from 1.
        storey: usize,
        /// Value (SI).
        value: f64,
        /// What is allowed.
        required: &'static str,
    },
    /// A coordinate without inertia.
    #[error(
        "building {building}: the inertia of its {coordinate} is {value}; it must be greater than zero"
    )]
    Inertia {
        /// Name of the building.
        building: String,
        /// Name of the coordinate.
        coordinate: String,
        /// Inertia (kg or kg m2).
        value: f64,
    },
    /// A response that is a sum of no numbers.
    #[error(
        "building {building}: a weight of its drifts, sections or responses is {value}; it must be finite"
    )]
    Weight {
        /// Name of the building.
        building: String,
        /// The weight.
        value: f64,
    },
    /// Gravity or a length of a foundation that cannot be.
    #[error(
        "building {building}: {quantity} = {value} {unit} of its foundation must be finite and greater than zero"
    )]
    FoundationSize {
        /// Name of the building.
        building: String,
        /// Quantity.
        quantity: &'static str,
        /// Value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// Columns that cannot have points with mass.
    #[error("building {building}: its columns cannot be hit at points with a mass: {reason}")]
    ContactPoints {
        /// Name of the building.
        building: String,
        /// Why not.
        reason: String,
    },
    /// Damping that cannot be.
    #[error("building {building}: damping: {reason}")]
    Damping {
        /// Name of the building.
        building: String,
        /// What is wrong.
        reason: String,
    },
    /// Isolators that cannot be.
    #[error("building {building}: {source}")]
    Isolator {
        /// Name of the building.
        building: String,
        /// What is wrong.
        source: crate::isolator::IsolatorError,
    },
    /// A storey law that cannot carry the storey.
    #[error("building {building}, storey {storey}: law {law}: {reason}")]
    Law {
        /// Name of the building.
        building: String,
        /// Storey, from 1.
        storey: usize,
        /// Name of the law.
        law: &'static str,
        /// What is wrong.
        reason: String,
    },
    /// A storey law that serves as a link alone.
    #[error("building {building}, storey {storey}: law {law} cannot carry a storey: {reason}")]
    LawOfLinks {
        /// Name of the building.
        building: String,
        /// Storey, from 1.
        storey: usize,
        /// Name of the law.
        law: &'static str,
        /// Why not.
        reason: &'static str,
    },
    /// Gravity that overturns the elastic building.
    #[error(
        "building {building}, storey {storey}: the load {load} N on a storey of {height} m takes {geometric} N/m off its stiffness {stiffness} N/m: it cannot stand"
    )]
    Unstable {
        /// Name of the building.
        building: String,
        /// Storey, from 1.
        storey: usize,
        /// Weight above (N).
        load: f64,
        /// Storey height (m).
        height: f64,
        /// Weight over height (N/m).
        geometric: f64,
        /// Storey stiffness (N/m).
        stiffness: f64,
    },
    /// The same for a building with a stiffness matrix.
    #[error(
        "building {building}: gravity acting through the drift takes more off its stiffness matrix than this has: it cannot stand"
    )]
    UnstableMatrix {
        /// Name of the building.
        building: String,
    },
    /// The same for a building on a foundation that sways or rocks.
    #[error(
        "building {building}: gravity acting through the drift and the rotation of its foundation takes more stiffness off than building and soil have: it cannot stand"
    )]
    Overturned {
        /// Name of the building.
        building: String,
    },
    /// A foundation that cannot carry the building.
    #[error("building {building}: {reason}")]
    Foundation {
        /// Name of the building.
        building: String,
        /// What is wrong.
        reason: FoundationError,
    },
    /// Masses or stiffnesses so far apart that double precision cannot resolve a mode.
    #[error(
        "building {building}: mode {mode} has the circular frequency {frequency} rad/s; masses or stiffnesses are too far apart"
    )]
    Modes {
        /// Name of the building.
        building: String,
        /// Mode, from 1.
        mode: usize,
        /// Circular frequency found (rad/s).
        frequency: f64,
    },
    /// A matrix that is not positive definite.
    #[error("the matrix is not positive definite: pivot {pivot:e} in row {row}")]
    NotPositiveDefinite {
        /// Row, from 1.
        row: usize,
        /// Pivot found there.
        pivot: f64,
    },
}

impl ShearBuildingError {
    /// What to try, where it is the same for a case file and for code.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        let text = match self {
            Self::TooManyStoreys { .. } => {
                "join storeys: several of them as one of their total height and mass, and of their stiffnesses in series"
            }
            Self::Length { .. } => {
                "give one value for each storey, the lowest first; of a matrix one row for each floor"
            }
            Self::OtherHeight { .. } => {
                "give floors and stiffness the same heights; a matrix from other programs is given by its rows"
            }
            Self::Damping { .. } => {
                "ratios are of critical damping, from 0 to below 1, usual are 0.02 to 0.05; factors and dashpots are zero or more, with one dashpot for each storey"
            }
            Self::LawOfLinks { .. } => {
                "make it a link, beside a storey with a stiffness or another law"
            }
            Self::Modes { .. } => "correct masses and stiffnesses, with their units",
            Self::Isolator { source, .. } => return source.help(),
            _ => return None,
        };
        Some(text.to_owned())
    }
}
