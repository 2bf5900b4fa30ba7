//! Hysteresis laws, against closed forms, published results and one another.
#![allow(clippy::unwrap_used)]

mod closed_forms;
mod common;
mod deterioration;
mod every_law;
mod iwan;
mod iwan_fit;
mod laboratory;
mod parameters;
mod random_histories;
mod smooth_laws;
