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

mod block;
mod block_ends;
mod block_step;
mod candidates;
mod closer_look;
mod constants;
mod free_sample;
mod lane_candidates;
mod lanes;
mod mode_step;
mod overdamped;
mod part;
mod phase;
mod reach;
mod sample_bound;
mod single_precision;
mod transform;

pub(crate) use block::step_over;
pub(crate) use block_step::Loads;
pub(crate) use constants::ContactFree;
pub(crate) use free_sample::FreeSample;
pub(crate) use lanes::{
    Ground, Lane, ModeLanes, Track, WIDTH, add, at, drifts, gather, lane_by_lane, mul, raise,
    raise_now, restore, restoring, scale, spread, sum,
};
pub(crate) use part::{put_part, take_part};
pub(crate) use phase::{BlockMotion, ContactFreePhase, EnergyAccounts, SampleMotion, SampleRange};
pub(crate) use transform::{
    Floors, Four, STRIP, sums_of_row, transform, transform_fours, transform_free, transform_three,
};
