//! The solver where there are no files: in a web page.
//!
//! An [`Explorer`] holds a case and the files that it names, as bytes. It answers requests, each
//! a JSON text with bytes, by an [`Answer`]: a JSON text with columns of numbers. All of it is
//! computed by the crates that `pounding run`, `gap` and `compare` compute with, from the text of
//! a case that `pounding run` would take, and what is wrong is said in the same words.
//!
//! Compiled to WebAssembly these two are classes of JavaScript, by `wasm-bindgen`. The memory and
//! the time that a case may take are bounded ([`limits`]), as a page has no one to stop it.

mod answer;
mod controls;
mod explorer;
mod fault;
mod request;
mod requests;

pub mod limits;

pub use answer::Answer;
pub use explorer::Explorer;
