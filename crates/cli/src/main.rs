//! The program `pounding`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(pounding_cli::run(std::env::args_os()))
}
