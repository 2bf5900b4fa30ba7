//! What keeps a book from being written.

use std::path::PathBuf;

/// Why there is no book.
#[derive(Debug, thiserror::Error)]
pub enum BookError {
    /// A file could not be read or written.
    #[error(transparent)]
    File(#[from] std::io::Error),
    /// A page could not be read.
    #[error("{}: {error}", .page.display())]
    Page {
        /// The page.
        page: PathBuf,
        /// What the system says.
        error: std::io::Error,
    },
    /// A formula that is no LaTeX.
    #[error("{}: {message}, in the formula\n{formula}", .page.display())]
    Formula {
        /// The page.
        page: PathBuf,
        /// What is wrong.
        message: String,
        /// The formula.
        formula: String,
    },
    /// The book could not be made of its pages.
    #[error("the book cannot be made: {message}")]
    Book {
        /// What the library says.
        message: String,
    },
}

impl BookError {
    /// An error of the library with its causes.
    pub(crate) fn of_book(error: &impl std::fmt::Debug) -> Self {
        Self::Book {
            message: format!("{error:?}"),
        }
    }
}
