//! What commands write, and what they never write over.
#![allow(clippy::unwrap_used)]

mod fixture;
mod inputs;
#[cfg(unix)]
mod left_over;
mod progress;
mod races;
#[cfg(unix)]
mod results;
mod signals;
