//! Cases that differ in some entries.
//!
//! Runs of a study differ from their case in a few entries. These are replaced in the tree of
//! the case, of which only the tables that differ are read again, as those of a case file are.
//! Replaced in the text, they give a run that can be written out and repeated alone.

mod edits;
mod identity;
mod path;
mod several;
mod variant;

pub(crate) use edits::{
    Edit, Entry, KEPT, Lost, apply, building_names, entry, of_impact_model, places_of_keys,
    root_key, with_model, with_motion, without, written,
};
pub(crate) use identity::{Lines, canonical};
pub(crate) use path::Path;
pub(crate) use several::{Found, LostAmong, entries, numbers};
pub(crate) use variant::Variant;
