//! `pounding hysteresis` and `pounding verify hysteresis`.
#![allow(clippy::unwrap_used)]

mod documentation;
mod laboratory;
mod pages;
mod refusals;
mod verify;
