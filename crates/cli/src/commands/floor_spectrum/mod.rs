//! `pounding floor-spectrum`: what equipment on the floors feels.

mod answer;
mod floors;

use pounding_assembly::Assembly;
use pounding_case::Dimension;
use pounding_files::FileUse;
use pounding_ground_motion::spectra::logarithmic_periods;
use pounding_report::pictures::floor_spectrum::{Curves, spectra as drawn};
use pounding_time_history::{
    GridRecorder, Outcome, Recorder, System, TimeHistoryError, run as integrate,
};

use self::answer::{Answer, Floor, Peaks, Spectra};
use self::floors::{Motions, Place, places};
use super::motion::words;
use crate::arguments::{FloorSpectrumArguments, value};
use crate::failure::Failure;
use crate::faults::{assembled, read_case};
use crate::files::{have_a_place, reads_too};
use crate::output::{pretty, print};
use crate::plot;
use crate::progress::{Progress, Unit};

/// Rows of the motions of floors in the shortest period: what happens within a row counts 0.07 % low.
const ROWS_OF_A_PERIOD: f64 = 50.0;
/// Periods where none are given, and those of a smooth picture.
const PERIODS: usize = 30;
const SMOOTH: usize = 200;
/// The shortest period (s): shorter ones feel the peak acceleration of the floor.
const SHORTEST: f64 = 1.0e-3;

/// Runs a case with and without its gaps and links, and prints the spectra of its floors.
pub fn floor_spectrum(
    arguments: &FloorSpectrumArguments,
    mut files: FileUse,
) -> Result<(), Failure> {
    let periods = periods(arguments)?;
    let dampings = words::list(&arguments.damping, "damping", Dimension::NUMBER)?;
    if let Some(damping) = dampings.iter().find(|d| !(0.0..1.0).contains(*d)) {
        let message = format!("--damping: {damping} is not between 0 and 1");
        let help = "give ratios of the critical damping, such as \"2 %, 5 %\"".to_owned();
        return Err(Failure::input(message, Some(help)));
    }
    let case = read_case(&arguments.case, true)?;
    reads_too(&mut files, case.files())?;
    let assembly = assembled(&case)?;
    let places = places(&assembly.system, &arguments.floors)?;
    have_a_place([arguments.csv.as_deref(), arguments.plot.as_deref()])?;
    let failed = |e: TimeHistoryError| Failure::of_case(e, &case);
    let time_step = time_step(&assembly, &periods);
    let progress = Progress::begin(Unit::Part)?;
    let isolated = assembly.system.isolated();
    let with = recorded(&assembly, &assembly.system, (&places, time_step), &|part| {
        progress.show((500.0 * part) as usize, 1000, "");
    });
    let (outcome, with) = with.map_err(failed)?;
    let alone = recorded(&assembly, &isolated, (&places, time_step), &|part| {
        progress.show(500 + (500.0 * part) as usize, 1000, "");
    });
    drop(progress);
    let mut warnings = assembly.with_those_of_the_record(&outcome.warnings);
    let alone = match alone {
        Ok(alone) => Some(alone),
        Err(error) => {
            warnings.push(format!(
                "the buildings without gaps and links have no run, and so no spectrum to compare with: {error}"
            ));
            None
        }
    };
    let levels = assembly.system.gaps().iter();
    let mut levels = levels.flat_map(|gap| assembly.system.levels_of(gap));
    let impacts = outcome.gaps.iter().flat_map(|gap| &gap.levels);
    let impacts = impacts.map(|level| level.impacts).sum();
    if impacts > 0 && levels.any(|l| l.model.rigid_restitution().is_some()) {
        warnings.push("rigid impacts are jumps of the velocity: spectra hold what they do to equipment, peak accelerations of floors leave them out".to_owned());
    }
    let computed = (&outcome, &with, alone.as_ref());
    let floors = |periods: &[f64]| -> Result<Vec<Floor>, Failure> {
        let asked = (periods, &*dampings, time_step);
        let numbered = places.iter().enumerate();
        let floors = numbered
            .map(|(floor, place)| of_floor(&assembly.system, (*place, floor), computed, asked));
        floors.collect()
    };
    let answer = Answer {
        floors: floors(&periods)?,
        impacts,
        time_step,
        warnings,
    };
    if let Some(path) = &arguments.csv {
        plot::write(path, &answer.csv()?)?;
    }
    if let Some(path) = &arguments.plot {
        // A picture is smooth unless its periods are given.
        let smooth = arguments.at.is_none() && arguments.count.is_none();
        let ends = (periods[0], periods[periods.len() - 1]);
        let drawn = match smooth {
            true => picture(&floors(&logarithmic_periods(ends.0, ends.1, SMOOTH)?)?),
            false => picture(&answer.floors),
        };
        plot::write_drawn(path, drawn, &arguments.figure)?;
    }
    print(&match arguments.json {
        true => pretty(&answer)?,
        false => answer.text(&case.title),
    })
}

fn periods(arguments: &FloorSpectrumArguments) -> Result<Vec<f64>, Failure> {
    let (periods, option) = match &arguments.at {
        Some(text) => (words::list(text, "at", Dimension::TIME)?, "at"),
        None => {
            let end = |text: &str, name| value(text, name, Dimension::TIME);
            let from = end(&arguments.from, "from")?;
            let to = end(&arguments.to, "to")?;
            words::ascending(("from", from), ("to", to), "s")?;
            let count = arguments.count.unwrap_or(PERIODS);
            if count < 2 {
                let message = format!("--count: {count} is less than two");
                let help = "give one period by --at".to_owned();
                return Err(Failure::input(message, Some(help)));
            }
            let periods = match from >= SHORTEST {
                true => logarithmic_periods(from, to, count)?,
                false => vec![from],
            };
            (periods, "from")
        }
    };
    if let Some(period) = periods
        .iter()
        .find(|p| !(**p >= SHORTEST) || p.is_infinite())
    {
        let message = format!("--{option}: a period of {period} s is not {SHORTEST} s at least");
        let help = "give longer periods: what is stiffer feels the peak acceleration of the floor, which stands above the table".to_owned();
        return Err(Failure::input(message, Some(help)));
    }
    Ok(periods)
}

/// Of the motions of floors (s): a part of the step of the record, so that rows have all that the ground does.
fn time_step(assembly: &Assembly, periods: &[f64]) -> f64 {
    let shortest = periods.iter().copied().fold(f64::INFINITY, f64::min);
    let step = assembly.accelerogram.time_step();
    let parts = (step * ROWS_OF_A_PERIOD / shortest).ceil().max(1.0);
    step / parts
}

/// A run with the motions of these floors.
fn recorded<'s>(
    assembly: &Assembly,
    system: &'s System,
    (places, time_step): (&'s [Place], f64),
    progress: &dyn Fn(f64),
) -> Result<(Outcome, Motions<'s>), TimeHistoryError> {
    let mut recorder = GridRecorder::into_sink(time_step, Motions::of(system, places))?;
    let recorders: &mut [&mut dyn Recorder] = &mut [&mut recorder];
    let outcome = integrate(system, &assembly.options, recorders, &mut |part| {
        progress(part)
    })?;
    Ok((outcome, recorder.responses))
}

/// Spectra of one floor.
fn of_floor(
    system: &System,
    (place, floor): (Place, usize),
    (outcome, with, alone): (&Outcome, &Motions<'_>, Option<&(Outcome, Motions<'_>)>),
    (periods, dampings, time_step): (&[f64], &[f64], f64),
) -> Result<Floor, Failure> {
    let building = &system.buildings()[place.building];
    let peak = |outcome: &Outcome| {
        let storeys = &outcome.buildings[place.building].storeys;
        storeys[place.storey].acceleration_absolute.value
    };
    let spectra = dampings.iter().map(|damping| {
        let of = (periods, *damping);
        Ok(Spectra {
            ground: with.of_ground(floor, time_step, of)?,
            pounding: with.spectrum(floor, time_step, of)?,
            alone: match alone {
                Some((_, motions)) => Some(motions.spectrum(floor, time_step, of)?),
                None => None,
            },
        })
    });
    Ok(Floor {
        building: building.name().to_owned(),
        storey: place.storey + 1,
        is_roof: place.storey + 1 == building.storeys(),
        elevation: building.elevations()[place.storey],
        peak_acceleration: Peaks {
            pounding: peak(outcome),
            alone: alone.map(|(outcome, _)| peak(outcome)),
        },
        spectra: spectra.collect::<Result<_, Failure>>()?,
    })
}

fn picture(floors: &[Floor]) -> pounding_report::Chart {
    let panels = floors.iter().flat_map(|floor| {
        floor.spectra.iter().map(|spectra| {
            let curves = Curves {
                ground: &spectra.ground,
                pounding: &spectra.pounding,
                alone: spectra.alone.as_ref(),
            };
            (floor.title(), curves)
        })
    });
    drawn(&panels.collect::<Vec<_>>())
}
