//! What commands write, and what they never write over.
mod fixture;
mod inputs;
#[cfg(unix)]
mod left_over;
mod progress;
mod races;
#[cfg(unix)]
mod results;
mod signals;
