//! Time integration of buildings in a row: event location, energy ledger, recorders.

// The same bits on every machine: see clippy.toml.
#![warn(clippy::disallowed_methods)]

mod bands;
mod batch;
mod bernstein;
mod building_rates;
mod complementarity;
mod contact;
mod contact_episode;
mod contact_free;
mod dense_output;
mod driver;
mod dynamics;
mod elements;
mod error;
mod estimate;
mod events;
mod find_warnings;
mod history;
mod impacts;
mod isolated_demand;
mod isolated_run;
mod layout;
mod ledger;
mod limits;
mod lost_strength;
mod method_choice;
mod methods;
mod observers;
mod options;
mod outcome;
mod peak;
mod peaks;
mod polynomial;
mod rates;
mod recorder;
mod relative_displacement;
mod response_row;
mod short_numbers;
mod small_solver;
mod soft_contact;
#[cfg(feature = "serde")]
mod summary;
mod system;
mod unequal_elevations;
mod unusual_values;
mod warning;

pub use batch::{in_parallel, run_many};
pub use driver::run;
pub use error::TimeHistoryError;
pub use estimate::StepEstimate;
pub use history::History;
pub use isolated_demand::{isolated_demand, isolated_demand_beside};
pub use isolated_run::{IsolatedRun, run_isolated};
pub use limits::{MAXIMUM_STEPS, StepLimit};
pub use method_choice::{DEFAULT_RELATIVE_TOLERANCE, MethodChoice};
pub use methods::Information;
pub use options::RunOptions;
pub use outcome::*;
pub use peak::Peak;
pub use recorder::{GridRecorder, HistorySink, MAXIMUM_RESPONSES, Recorder, StepView};
pub use relative_displacement::RelativeDisplacement;
pub use short_numbers::short;
#[cfg(feature = "serde")]
pub use summary::Summary;
pub use system::{
    BuildingPoint, ContactLevel, Element, ElementPlace, Floor, FloorForce, ForceHistory, Gap,
    GroundAcceleration, GroundMotion, LONGEST_DELAY, LevelMotion, LevelPlace, LevelResponse, Link,
    LinkedMotion, LinkedPair, Support, System, UnequalFloors, more_pairs,
};
pub use warning::Warning;
