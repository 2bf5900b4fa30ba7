//! The text of a case with some of its entries replaced.
//!
//! Runs of a study differ from their case in a few entries. Replacing them in the text
//! puts every run through the same reading and checking as a case file, and gives a run
//! that can be written out and repeated alone.

mod edits;
mod identity;
mod path;

pub(crate) use edits::{
    Edits, Entry, Lost, apply, building_names, entry, options_of_gap, options_of_motion,
};
pub(crate) use identity::canonical;
pub(crate) use path::Path;
pub(crate) use pounding_files::checksum::hexadecimal;
