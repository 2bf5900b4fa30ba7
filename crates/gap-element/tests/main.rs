//! Impact models, by their registry and against published results.
#![allow(clippy::unwrap_used)]

mod calibration;
mod contact_stiffness;
mod laboratory;
mod pressed_collisions;
mod published;
mod registry;
mod single_collisions;
