//! Writes the book: `book ROOT OUTPUT [CRATES]`, where `CRATES` is what `cargo doc` made.

use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let (root, output, crates) = match arguments.as_slice() {
        [root, output] => (root, output, None),
        [root, output, crates] => (root, output, Some(crates.as_path())),
        _ => return told("book ROOT OUTPUT [CRATES]"),
    };
    match book::build(root, output, crates) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => told(&error.to_string()),
    }
}

fn told(message: &str) -> ExitCode {
    // Nobody is left to tell that nobody hears it.
    let _ = writeln!(std::io::stderr(), "{message}");
    ExitCode::FAILURE
}
