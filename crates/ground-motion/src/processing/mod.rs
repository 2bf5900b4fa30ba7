//! What can be done to a record before it excites buildings.

mod components;

pub(crate) use components::common_length;
