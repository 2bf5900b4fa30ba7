//! Pages of results, each one HTML file: the answer in words first, then tables and figures.
//! They need no other file and no network, and print.

mod answer;
mod answered;
mod comparison;
mod document;
mod gap;
mod html;
mod ida;
mod motion;
mod numbers;
mod run;
mod sentence;
mod studies;
mod sweep;
mod sweep_answer;
mod table;

pub use crate::answer_file::{Inputs, Picture};
pub use comparison::comparison;
pub use document::{Document, MARK, Script};
pub use gap::{COLLAPSE_AT_WIDTHS, gap};
pub use html::escaped;
pub use ida::ida;
pub use motion::motion;
pub(crate) use numbers::figures_that_suffice;
pub use run::page as run;
pub use sentence::Sentence;
pub use sweep::sweep;
pub use sweep_answer::{Maximum, SweepAnswer};
