//! Storeys, damping and modes.
#![allow(clippy::unwrap_used)]

mod impossible_values;
mod isolators;
mod properties;
mod textbook_frame;
