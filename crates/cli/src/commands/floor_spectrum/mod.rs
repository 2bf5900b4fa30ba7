//! `pounding floor-spectrum`: what equipment on the floors feels.

mod answer;

use std::ops::ControlFlow;

use pounding_case::Dimension;
use pounding_files::FileUse;
use pounding_ground_motion::spectra::logarithmic_periods;
use pounding_report::pictures::floor_spectrum::{Curves, spectra as drawn};
use pounding_study::floor_spectra::{
    FloorMotions, FloorPlace, FloorSpectra, FloorSpectraError, FloorSpectraWanted, SHORTEST_PERIOD,
    floor_above, roofs,
};
use pounding_time_history::System;

use crate::arguments::{FloorSpectrumArguments, ascending, list, value};
use crate::failure::Failure;
use crate::faults::{assembled, read_case};
use crate::files::{have_a_place, reads_too};
use crate::output::{pretty, print};
use crate::plot;
use crate::progress::{Progress, Unit};

/// Periods where none are given, and those of a smooth picture.
const PERIODS: usize = 30;
const SMOOTH: usize = 200;

/// Runs a case with and without its gaps and links, and prints the spectra of its floors.
pub fn floor_spectrum(
    arguments: &FloorSpectrumArguments,
    mut files: FileUse,
) -> Result<(), Failure> {
    let periods = periods(arguments)?;
    let dampings = list(&arguments.damping, "damping", Dimension::NUMBER)?;
    let case = read_case(&arguments.case, true)?;
    reads_too(&mut files, case.files())?;
    let assembly = assembled(&case)?;
    let floors = floors(&assembly.system, &arguments.floors)?;
    have_a_place([arguments.csv.as_deref(), arguments.plot.as_deref()])?;
    let failed = |error: FloorSpectraError| match error {
        FloorSpectraError::Run(error) => Failure::of_case(error, &case),
        FloorSpectraError::Spectrum(error) => error.into(),
        FloorSpectraError::Damping { .. } => named("damping", &error),
        FloorSpectraError::Period { .. } => {
            let option = if arguments.at.is_some() { "at" } else { "from" };
            named(option, &error)
        }
        error => named("floor", &error),
    };
    let wanted = FloorSpectraWanted {
        floors: &floors,
        periods: &periods,
        dampings: &dampings,
    };
    let progress = Progress::begin(Unit::Part)?;
    let motions = FloorMotions::new(&assembly, wanted, &mut |part| {
        progress.show((1000.0 * part) as usize, 1000, "");
        ControlFlow::Continue(())
    });
    let motions = motions.map_err(failed)?;
    let answer = motions.spectra(&periods).map_err(failed)?;
    if let Some(path) = &arguments.csv {
        plot::write(path, &answer::csv(&answer)?)?;
    }
    if let Some(path) = &arguments.plot {
        // A picture is smooth unless its periods are given.
        let smooth = arguments.at.is_none() && arguments.count.is_none();
        let ends = (periods[0], periods[periods.len() - 1]);
        let drawn = match smooth {
            true => {
                let many = logarithmic_periods(ends.0, ends.1, SMOOTH)?;
                picture(&motions.spectra(&many).map_err(failed)?)
            }
            false => picture(&answer),
        };
        plot::write_drawn(path, drawn, &arguments.figure)?;
    }
    drop(progress);
    print(&match arguments.json {
        true => pretty(&answer)?,
        false => answer::text(&answer, &case.title),
    })
}

/// An error of the library under the option that it comes from.
fn named(option: &str, error: &FloorSpectraError) -> Failure {
    Failure::input(format!("--{option}: {error}"), error.help())
}

/// The floors of these names, `BUILDING:STOREY`; without any the roof of every building.
fn floors(system: &System, names: &[String]) -> Result<Vec<FloorPlace>, Failure> {
    if names.is_empty() {
        return Ok(roofs(system));
    }
    let refused = |message: String, help: String| Err(Failure::input(message, Some(help)));
    let mut floors = Vec::new();
    for name in names {
        let Some((building, storey)) = name.rsplit_once(':') else {
            let help = format!("write it as \"{name}:1\"");
            return refused(format!("--floor: \"{name}\" names no storey"), help);
        };
        let floor = floor_above(system, building, storey).map_err(|e| named("floor", &e))?;
        if floors.contains(&floor) {
            let help = "give it once".to_owned();
            return refused(format!("--floor: \"{name}\" stands twice"), help);
        }
        floors.push(floor);
    }
    Ok(floors)
}

fn periods(arguments: &FloorSpectrumArguments) -> Result<Vec<f64>, Failure> {
    if let Some(text) = &arguments.at {
        return list(text, "at", Dimension::TIME);
    }
    let end = |text: &str, name| value(text, name, Dimension::TIME);
    let from = end(&arguments.from, "from")?;
    let to = end(&arguments.to, "to")?;
    ascending(("from", from), ("to", to), "s")?;
    let count = arguments.count.unwrap_or(PERIODS);
    if count < 2 {
        let message = format!("--count: {count} is less than two");
        let help = "give one period by --at".to_owned();
        return Err(Failure::input(message, Some(help)));
    }
    match from >= SHORTEST_PERIOD {
        true => Ok(logarithmic_periods(from, to, count)?),
        // Which is refused as one.
        false => Ok(vec![from]),
    }
}

fn picture(answer: &FloorSpectra) -> pounding_report::Chart {
    let panels = answer.floors.iter().flat_map(|floor| {
        floor.spectra.iter().map(|spectra| {
            let curves = Curves {
                ground: &spectra.ground,
                pounding: &spectra.pounding,
                alone: spectra.alone.as_ref(),
            };
            (answer::title(floor), curves)
        })
    });
    drawn(&panels.collect::<Vec<_>>())
}
