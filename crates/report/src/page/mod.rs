//! Pages of results, each one HTML file: the answer in words first, then tables and figures.
//! They need no other file and no network, and print.

mod document;
mod html;
mod numbers;
mod run;
mod table;

pub use run::page;
