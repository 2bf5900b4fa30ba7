//! Contacts in the coordinates of the modes: what follows contact-free motion when a gap closes.
//!
//! Classical damping keeps the modes apart, so that a building's own motion costs a few
//! operations a mode, and a contact adds a force along one fixed row of the modes.
//! Contacts whose law is affine are Taylor series summed to round-off, on which events
//! are located without another step. All other laws take the pair of order 8(5,3), in a
//! time that makes the power with which their force starts or ends a smooth function
//! ([`clock`]).

mod clock;
mod expansion;
mod pair;
mod peaks;
mod point;
mod powers;
mod reach;
mod search;
mod series;
mod span;
mod step_length;
mod tables;
mod touch;
mod touch_series;

pub(crate) use clock::Clock;
pub(crate) use expansion::{EndOfStep, Places};
pub(crate) use pair::{Pair, Scene};
pub(crate) use peaks::{
    Rates, Tracks, begin_acceleration, note_floors_of_series, note_floors_of_span,
    note_sections_of_series, note_sections_of_span,
};
pub(crate) use reach::NEAR;
pub(crate) use search::{in_series, in_span, soon_after};
pub(crate) use series::{Series, SeriesEnd, SeriesStep, Works};
pub(crate) use span::Span;
pub(crate) use step_length::{Proposal, StepLength};
pub(crate) use touch::{Touch, are_affine, are_powers, list, refresh};
