//! Writes the book of the documentation.

use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

use book::Parts;
use clap::Parser;

/// Writes the documentation of the repository as a book.
#[derive(Parser)]
struct Arguments {
    /// Root of the repository
    root: PathBuf,
    /// Folder of the book, whose old content goes
    output: PathBuf,
    /// What `cargo doc` made
    #[arg(long)]
    crates: Option<PathBuf>,
    /// A page of `pounding explore`, for the front page
    #[arg(long)]
    explorer: Option<PathBuf>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let parts = Parts {
        crates: arguments.crates.as_deref(),
        explorer: arguments.explorer.as_deref(),
    };
    match book::build(&arguments.root, &arguments.output, &parts) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Nobody is left to tell that nobody hears it.
            let _ = writeln!(std::io::stderr(), "{error}");
            ExitCode::FAILURE
        }
    }
}
