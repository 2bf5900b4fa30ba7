//! The modes of all buildings, eight to a lane: exact steps over samples and blocks of them, and the
//! floors' functions.

pub(crate) mod block;
mod block_motion;
mod block_step;
pub(crate) mod constants;
mod lanes;
mod mode_step;
mod overdamped;
mod overshoots;
mod part;
mod reach;
mod rows;
mod single_precision;
mod transform;

pub(crate) use block::{
    Block, Extremes, Quantity, advance_all, bound_overshoots, products, step_over,
};
pub(crate) use block_motion::{BlockMotion, SampleMotion};
pub(crate) use block_step::{BLOCK, BlockLoad, BlockStep, Loads, MadeLoad};
pub(crate) use constants::{ContactFree, Fine, is_tall, stored};
pub(crate) use lanes::{
    Ground, Lane, Modal, ModeLanes, Track, WIDTH, add, at, balance, derive, drifts, gather,
    lane_by_lane, mul, raise, raise_now, restore, restoring, scale, spread, step_modes, sum,
    sum_of_products,
};
pub(crate) use overdamped::Decay;
pub(crate) use overshoots::{is_low, modal_acceleration_overshoots, modal_overshoots};
pub(crate) use part::{put_part, take_part};
pub(crate) use reach::{Bounds, OneLane, QUANTITIES, Reach};
pub(crate) use rows::{FloorRows, LevelRows, ModalRow, closings, total};
pub(crate) use single_precision::SinglePrecisionModes;
pub(crate) use transform::{
    Floors, Four, STRIP, floor_of_eight, rows_of_four, rows_of_two, sums_of_row, to_floors,
    transform, transform_four, transform_fours, transform_free, transform_three, transform_two,
};
