//! `pounding hysteresis` and `pounding verify hysteresis`.
#![allow(clippy::unwrap_used)]

mod documentation;
mod laboratory;
mod pages;
mod refusals;
#[path = "../support/mod.rs"]
mod support;
mod verify;
