//! `pounding floor-spectrum`: what equipment on the floors feels.

mod answer;
mod over_records;

use std::ops::ControlFlow;

use pounding_case::{Case, Dimension};
use pounding_files::FileUse;
use pounding_ground_motion::spectra::{SMOOTH, logarithmic_periods};
use pounding_report::Chart;
use pounding_report::pictures::floor_spectrum::{Floor, spectra as drawn};
use pounding_study::floor_spectra::{
    FloorPlace, FloorSpectra, FloorSpectraError, FloorSpectraOverRecords, FloorSpectraWanted,
    SHORTEST_PERIOD, floor_above, floor_spectra, floor_spectra_under, roofs,
};
use pounding_time_history::System;

use crate::arguments::{FloorSpectrumArguments, ascending, list, once, value};
use crate::failure::Failure;
use crate::faults::{assembled, of_check, read_case, recorded};
use crate::files::{have_a_place, reads_too};
use crate::output::{pretty, print};
use crate::plot;
use crate::progress::{Progress, Unit, threads};

/// Periods where none are given.
const PERIODS: usize = 30;

/// Runs a case with and without its gaps and links, under its record or under others, and prints the spectra of its floors.
pub fn floor_spectrum(arguments: &FloorSpectrumArguments, files: FileUse) -> Result<(), Failure> {
    let periods = periods(arguments)?;
    let dampings = list(&arguments.damping, "damping", Dimension::NUMBER)?;
    once("at", &periods, " s")?;
    once("damping", &dampings, "")?;
    let case = read_case(&arguments.case, arguments.records.is_empty())?;
    // A picture is smooth unless its periods are given.
    let smooth = match arguments.at.is_none() && arguments.count.is_none() && periods.len() > 1 {
        true => Some(logarithmic_periods(
            periods[0],
            periods[periods.len() - 1],
            SMOOTH,
        )?),
        false => None,
    };
    let asked = Asked {
        arguments,
        case: &case,
        periods: &periods,
        dampings: &dampings,
        drawn: smooth.as_deref().unwrap_or(&periods),
    };
    match arguments.records.is_empty() {
        true => asked.under_its_record(files),
        false => asked.under_records(files),
    }
}

/// What is asked for.
struct Asked<'a> {
    arguments: &'a FloorSpectrumArguments,
    case: &'a Case,
    periods: &'a [f64],
    dampings: &'a [f64],
    /// Periods of the picture.
    drawn: &'a [f64],
}

impl<'a> Asked<'a> {
    fn wanted(&self, floors: &'a [FloorPlace]) -> FloorSpectraWanted<'a> {
        FloorSpectraWanted {
            floors,
            periods: self.periods,
            dampings: self.dampings,
        }
    }

    fn under_its_record(&self, mut files: FileUse) -> Result<(), Failure> {
        let Self {
            arguments, case, ..
        } = self;
        reads_too(&mut files, case.files())?;
        let assembly = assembled(case)?;
        let floors = floors(&assembly.system, &arguments.floors)?;
        self.have_a_place()?;
        let progress = Progress::begin(Unit::Part)?;
        let work = floor_spectra(
            &assembly,
            self.wanted(&floors),
            &self.lists(),
            &mut |part| {
                progress.show((1000.0 * part) as usize, 1000, "");
                ControlFlow::Continue(())
            },
        );
        let (answers, _) = work.map_err(|error| self.failed(error))?;
        let (answer, drawn) = (&answers[0], &answers[answers.len() - 1]);
        self.write(answer::csv(answer), || picture(drawn))?;
        drop(progress);
        print(&match arguments.json {
            true => pretty(answer)?,
            false => answer::text(answer, &case.title),
        })
    }

    fn under_records(&self, mut files: FileUse) -> Result<(), Failure> {
        let Self {
            arguments, case, ..
        } = self;
        let records = recorded(case, &arguments.records, &mut files)?;
        let floors = match records.first() {
            Some(first) => floors(&first.assembly.system, &arguments.floors)?,
            None => Vec::new(),
        };
        self.have_a_place()?;
        let progress = Progress::begin(Unit::Runs)?;
        let tell = |done: usize, total: usize| {
            progress.show(done, total, "");
            ControlFlow::Continue(())
        };
        let work = (threads(arguments.threads), &tell as &_);
        let answers =
            floor_spectra_under((case, &records), self.wanted(&floors), &self.lists(), work);
        let answers = answers.map_err(|error| self.failed(error))?;
        let (answer, drawn) = (&answers[0], &answers[answers.len() - 1]);
        self.write(over_records::csv(answer), || picture_over_records(drawn))?;
        drop(progress);
        print(&match arguments.json {
            true => pretty(answer)?,
            false => over_records::text(answer, &case.title),
        })
    }

    /// The periods of the answer, and those of the picture if they are others.
    fn lists(&self) -> Vec<&'a [f64]> {
        let mut lists = vec![self.periods];
        if self.arguments.plot.is_some() && self.drawn != self.periods {
            lists.push(self.drawn);
        }
        lists
    }

    fn have_a_place(&self) -> Result<(), Failure> {
        let Self { arguments, .. } = self;
        have_a_place([arguments.csv.as_deref(), arguments.plot.as_deref()])
    }

    /// Writes the files that are asked for.
    fn write(
        &self,
        csv: Result<String, Failure>,
        picture: impl FnOnce() -> Chart,
    ) -> Result<(), Failure> {
        let Self { arguments, .. } = self;
        if let Some(path) = &arguments.csv {
            plot::write(path, &csv?)?;
        }
        if let Some(path) = &arguments.plot {
            plot::write_drawn(path, picture(), &arguments.figure)?;
        }
        Ok(())
    }

    fn failed(&self, error: FloorSpectraError) -> Failure {
        match error {
            FloorSpectraError::Run(error) => Failure::of_case(error, self.case),
            FloorSpectraError::Record { record, error } => {
                Failure::of_case(*error, self.case).within(&format!("record {record}"))
            }
            FloorSpectraError::NoRecord { .. } => {
                Failure::computation(error.to_string(), error.help())
            }
            FloorSpectraError::Records(error) => of_check(*error, self.case),
            FloorSpectraError::Spectrum(error) => error.into(),
            FloorSpectraError::Damping { .. } => named("damping", &error),
            FloorSpectraError::Period { .. } => {
                let at = self.arguments.at.is_some();
                named(if at { "at" } else { "from" }, &error)
            }
            error => named("floor", &error),
        }
    }
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

fn picture(answer: &FloorSpectra) -> Chart {
    let floors = answer.floors.iter().flat_map(|floor| {
        floor.spectra.iter().map(|of| {
            let mut spectra = vec![("with pounding", &of.pounding.acceleration[..])];
            let alone = of.alone.as_ref();
            spectra.extend(alone.map(|alone| ("building alone", &alone.acceleration[..])));
            spectra.push(("ground", &of.ground.acceleration));
            Floor {
                title: answer::title(floor),
                damping: of.pounding.damping,
                periods: &of.pounding.periods,
                spectra,
            }
        })
    });
    drawn(&floors.collect::<Vec<_>>())
}

fn picture_over_records(answer: &FloorSpectraOverRecords) -> Chart {
    let floors = answer.floors.iter().flat_map(|floor| {
        floor.spectra.iter().map(|of| Floor {
            title: over_records::title(floor),
            damping: of.damping,
            periods: &of.periods,
            spectra: vec![
                ("with pounding, mean", &of.pounding.mean),
                ("building alone, mean", &of.alone.mean),
                ("ground, mean", &of.ground.mean),
                ("with pounding, 84 %", &of.pounding.p84),
                ("building alone, 84 %", &of.alone.p84),
            ],
        })
    });
    drawn(&floors.collect::<Vec<_>>())
}
