//! Pages, in one program.
#![allow(clippy::unwrap_used)]

mod answer_file;
mod page;
mod studies;
