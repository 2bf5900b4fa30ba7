//! Storeys, damping and modes.

mod impossible_values;
mod isolators;
mod properties;
mod textbook_frame;
