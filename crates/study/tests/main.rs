//! Studies, called as a library.
#![allow(clippy::unwrap_used)]

mod comparison;
mod floor_spectra;
mod gap_check;
mod interruption;
mod random_numbers;
mod records;
mod several_entries;
mod studies;
mod yielding_storeys;
