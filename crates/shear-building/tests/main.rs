//! Storeys, damping and modes.

mod isolators;
mod properties;
mod textbook_frame;
