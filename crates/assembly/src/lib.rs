//! From a case to the system that the solver integrates: the place where words meet physics.
//!
//! [`assemble()`] reads the record of a [`Case`](pounding_case::Case), processes and scales it,
//! finds impact models and laws by their names, checks units against what each parameter
//! wants, and builds the [`System`](pounding_time_history::System).
//!
//! ```
//! use std::path::Path;
//!
//! use pounding_assembly::assemble;
//! use pounding_case::Case;
//! use pounding_time_history::run;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
//! let case = Case::read(&examples.join("three_storey_pair/case.toml"))?;
//! let assembly = assemble(&case)?;
//! let outcome = run(&assembly.system, &assembly.options, &mut [], &mut |_| {})?;
//! assert_eq!(outcome.gaps[0].levels[2].impacts, 26);
//! # Ok(())
//! # }
//! ```

// The same bits on every machine: see clippy.toml.
#![warn(clippy::disallowed_methods)]

mod assemble;
mod dimension;
mod error;
mod number_file;
mod schema;
mod used_parameters;

pub use assemble::{
    Assembly, RecordFiles, assemble, assemble_at_rest, assemble_sharing,
    assemble_under_another_record, assemble_with_record, assemble_without_gaps, further_record,
    methods_that_take, nothing_to_move_across, parameters_of_frames, parameters_of_gap,
    parameters_of_link, parameters_of_storeys, process_record, read_record, read_target, regap,
    scale_record, scale_target,
};
pub use dimension::{parameter_dimension, unknown_parameter};
pub use error::{AssemblyError, place_of};
pub use schema::case_schema;
pub use used_parameters::{UsedParameter, UsedParameters};
