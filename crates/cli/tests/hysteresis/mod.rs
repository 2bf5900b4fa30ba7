//! `pounding hysteresis` and `pounding verify hysteresis`.
mod documentation;
mod laboratory;
mod pages;
mod refusals;
mod verify;
