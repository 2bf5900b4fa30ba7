//! The documentation of the repository as a book that needs no network.
//!
//! Its parts are the headings of `docs/README.md`, its chapters the pages that stand there, in
//! their order; what only one of these pages names comes below it. Files that pages link to go
//! along.

mod error;
mod formulas;
mod outline;
mod staging;

use std::path::Path;

use mdbook_driver::MDBook;

pub use error::BookError;
pub use outline::{Entry, outline};

/// Title, search and appearance. Programs are not offered to be run elsewhere, as the book works
/// without a network.
const CONFIGURATION: &str = r#"
[book]
title = "pounding"
description = "Seismic pounding of adjacent buildings"
language = "en"
src = "src"

[build]
create-missing = false
use-default-preprocessors = false

[output.html]
smart-punctuation = false

[output.html.playground]
runnable = false

[output.html.print]
enable = false

[output.html.fold]
enable = true
level = 0
"#;

/// What becomes a part of a book beside the pages of the repository.
#[derive(Debug, Clone, Copy, Default)]
pub struct Parts<'a> {
    /// The documentation of the crates, which `cargo doc` made.
    pub crates: Option<&'a Path>,
    /// The page of `pounding explore`, which the front page shows.
    pub explorer: Option<&'a Path>,
}

/// Writes the book of the repository at `root` into the folder `output`, whose old content goes.
///
/// # Errors
/// A page that cannot be read or a file that cannot be written.
pub fn build(root: &Path, output: &Path, parts: &Parts<'_>) -> Result<(), BookError> {
    let stage = tempfile::tempdir()?;
    staging::stage(root, stage.path(), parts)?;
    std::fs::write(stage.path().join("book.toml"), CONFIGURATION)?;
    let book = MDBook::load(stage.path()).map_err(|e| BookError::of_book(&e))?;
    book.build().map_err(|e| BookError::of_book(&e))?;
    let built = stage.path().join("book");
    if output.exists() {
        std::fs::remove_dir_all(output)?;
    }
    staging::copy(&built, output)?;
    if let Some(crates) = parts.crates {
        staging::copy(crates, &output.join(staging::CRATES))?;
    }
    if let Some(explorer) = parts.explorer {
        std::fs::copy(explorer, output.join(staging::EXPLORER))?;
    }
    Ok(())
}
