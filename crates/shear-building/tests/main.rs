//! Storeys, damping and modes.

mod properties;
mod textbook_frame;
