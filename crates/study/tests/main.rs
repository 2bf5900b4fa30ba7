//! Studies, called as a library.

mod comparison;
mod gap_check;
mod interruption;
mod records;
mod several_entries;
mod studies;
