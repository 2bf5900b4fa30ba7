//! Contact-free motion: linear buildings between impacts, advanced a sample at a time by the
//! exact step of their modes.
//!
//! A sample is advanced only if nothing can happen inside it. Both questions - can a gap
//! close, can a peak lie between the samples - are answered by a rigorous bound: a
//! function lies below the larger of its end values plus `h^2 / 8` times a bound of
//! its second derivative, and it has no extremum inside if its change exceeds `h^2 / 2`
//! times that bound. The second derivatives follow from the modal amplitudes, which
//! grow by at most `|gamma| h max |a_g|` over a sample. Samples that fail are left to
//! the driver, which brackets and locates.

mod block_ends;
mod candidates;
mod closer_look;
mod free_sample;
mod lane_candidates;
mod phase;
mod sample_bound;

pub(crate) use free_sample::FreeSample;
pub(crate) use phase::{ContactFreePhase, EnergyAccounts, SampleRange};
