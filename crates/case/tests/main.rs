//! Case files: what is read, what is refused and in which words.
#![allow(clippy::unwrap_used)]

mod bad_input;
mod case_file;
mod column;
mod document;
mod foundation;
mod ground;
mod ground_motion;
mod isolator;
mod lateral;
mod separation;
mod several_errors;
mod units;
