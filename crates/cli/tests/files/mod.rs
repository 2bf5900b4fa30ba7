//! What commands write, and what they never write over.
#![allow(clippy::unwrap_used)]

mod fixture;
mod inputs;
#[cfg(unix)]
mod left_over;
#[path = "../support/part_files.rs"]
mod part_files;
mod progress;
mod races;
#[cfg(unix)]
mod results;
mod signals;
