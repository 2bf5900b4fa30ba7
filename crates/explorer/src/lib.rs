//! The solver where there are no files: in a web page.
//!
//! An [`Explorer`] holds a case and the files that it names, as bytes. It answers requests, each
//! a JSON object with bytes behind it, by a JSON object with numbers behind it: see
//! [`Explorer::answer`]. All of it is computed by the crates that `pounding run`, `gap` and
//! `compare` compute with, from the text of a case that `pounding run` would take, and what is
//! wrong is said in the same words.
//!
//! Compiled to WebAssembly it has three functions that a host calls (the module `interface`). It
//! bounds the memory and the time that a case may take ([`limits`]), as a page has no one to stop
//! it.

mod answer;
mod clock;
mod controls;
mod explorer;
mod fault;
#[cfg(target_arch = "wasm32")]
mod interface;
mod request;
mod requests;

pub mod limits;

pub use explorer::Explorer;
