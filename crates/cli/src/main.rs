//! The program `pounding`.

use std::process::ExitCode;

fn main() -> ExitCode {
    pounding_cli::run()
}
