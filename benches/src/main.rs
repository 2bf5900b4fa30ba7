//! Measured speed of `pounding`. See `benches/run` for what it can do; nothing here
//! asserts a time.

mod cases;
mod clock;
mod machine;
mod memory;
mod methods;
mod peers;
mod precision;
mod python;
mod recording;
mod report;
mod scaling;
mod sweep;

use std::io::Write as _;
use std::path::Path;
use std::process::ExitCode;

use pounding_time_history::GroundAcceleration;
use verification::{Failure, ReferenceCases, reference_cases, synthetic_motion};

const USAGE: &str = "quick | full | prototype | scaling | towers STOREYS... | recording | python INTERPRETER | sweeps | sweep RUNS | cases FOLDER";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match answer(&words) {
        Ok(text) => match writeln!(std::io::stdout(), "{}", text.trim_end()) {
            Ok(()) => ExitCode::SUCCESS,
            Err(_) => ExitCode::FAILURE,
        },
        Err(error) => {
            tell(&error.to_string());
            ExitCode::FAILURE
        }
    }
}

fn answer(words: &[&str]) -> Result<String, Failure> {
    let reference = reference_cases()?;
    let ground = synthetic_motion()?;
    match words {
        ["quick"] => report::quick(reference, &ground),
        ["full"] => {
            let text = report::full(reference, &ground)?;
            // A quarter of an hour is not lost if the page cannot be written.
            if let Err(error) = report::write_page(&text) {
                tell(&format!("benches/README.md is not written: {error}"));
            }
            Ok(text)
        }
        ["prototype"] => report::prototype(&reference, &ground),
        ["scaling"] => report::only_scaling(reference, &ground),
        ["recording", only @ ..] => recording::ratios(&reference, &ground, only),
        ["towers", storeys @ ..] => recording::towers(&ground, storeys),
        ["recorded", case, model, kind, tolerance] => {
            recording::child(&reference, &ground, [case, model, kind, tolerance])
        }
        ["python", interpreter] => python::beside_the_library(interpreter),
        ["sweeps"] => report::only_sweeps(&reference, &ground),
        ["sweep", runs] => report::one_sweep(&reference, &ground, runs.parse()?),
        ["cases", folder] => write_cases(&reference, &ground, Path::new(folder)),
        ["memory", case, model, method, runs] => {
            let case = reference.cases.get(*case).ok_or("no such case")?;
            memory::child((case, model), &ground, method, runs)
        }
        _ => Err(USAGE.into()),
    }
}

/// Case files of the compiled peer; returns their names.
fn write_cases(
    reference: &ReferenceCases,
    ground: &GroundAcceleration,
    folder: &Path,
) -> Result<String, Failure> {
    std::fs::create_dir_all(folder)?;
    let mut names = String::new();
    for (name, case) in &reference.cases {
        let path = folder.join(format!("{name}.txt"));
        cases::write_peer_case(case, ground, &path)?;
        names += &format!("{}\n", path.display());
    }
    Ok(names)
}

/// A line of progress.
fn tell(text: &str) {
    // Where nobody listens, there is nobody to tell.
    let _ = writeln!(std::io::stderr(), "{text}");
}
