//! Rung 6 of the ladder for storeys that yield and for links between floors: exact
//! solutions, two methods against each other, the energy ledger.
#![allow(clippy::print_stdout)]

mod all_laws;
mod convergence;
mod event_driven;
mod exact_oscillator;
mod fixed_step_peaks;
mod from_rest;
mod on_soil;
mod p_delta;
mod properties;
pub mod setup;
