//! The deformations that the arguments ask for.

use pounding_case::Dimension;
use pounding_catalogue::numbers::significant;
use pounding_hysteresis::LawDescriptor;
use pounding_hysteresis::laboratory::{HistoryRow, LaboratoryError, LoadPath, Pace};

use crate::arguments::{HysteresisArguments, positive, with_units_alike};
use crate::columns::{Column, Source};
use crate::failure::Failure;

/// The path of the arguments, if they ask for one, and its cycles in words.
pub fn path(
    law: &LawDescriptor,
    arguments: &HysteresisArguments,
) -> Result<Option<(LoadPath, String)>, Failure> {
    if let Some(file) = &arguments.history {
        let source = Source::of_option(file, "--history", "deformation_mm")?;
        let speed = speed(arguments)?;
        if arguments.period.is_some() {
            return Err(Failure::input(
                "--period does not go with --history",
                Some("give the file a column of times, or add --rate".to_owned()),
            ));
        }
        if arguments.steps.is_some() {
            return Err(Failure::input(
                "--steps does not go with --history",
                Some(
                    "leave it away: the ways between the rows of the file are divided without it"
                        .to_owned(),
                ),
            ));
        }
        let description = "Cycles of the history, from a turning point back to its deformation";
        let path = history(law, &source, speed)?;
        return Ok(Some((path, description.to_owned())));
    }
    if arguments.cycles.is_empty() {
        return Ok(None);
    }
    let amplitudes = arguments
        .cycles
        .iter()
        .map(|text| positive(text.trim(), ("cycles", "10 mm,20 mm"), Dimension::LENGTH))
        .collect::<Result<Vec<f64>, Failure>>()?;
    with_units_alike("cycles", arguments.cycles.iter().map(String::as_str))?;
    let pace = match speed(arguments)? {
        Some(speed) => Pace::Steady(speed),
        None => Pace::Harmonic(period(arguments)?),
    };
    let how = match pace {
        _ if !law.rate_dependent => String::new(),
        Pace::Harmonic(period) => format!(", harmonic, {} s each", significant(period)),
        Pace::Steady(speed) => format!(", at a speed of {} m/s", significant(speed)),
    };
    Ok(Some((
        LoadPath::full_cycles(law, &amplitudes, pace, arguments.steps()),
        format!("Full cycles, each from its positive peak back there{how}"),
    )))
}

/// Period of harmonic cycles (s).
pub fn period(arguments: &HysteresisArguments) -> Result<f64, Failure> {
    let text = arguments.period.as_deref();
    text.map_or(Ok(1.0), |text| {
        positive(text, ("period", "1 s"), Dimension::TIME)
    })
}

fn speed(arguments: &HysteresisArguments) -> Result<Option<f64>, Failure> {
    let text = arguments.rate.as_deref();
    text.map(|text| positive(text, ("rate", "20 mm/s"), Dimension::VELOCITY))
        .transpose()
}

const DEFORMATION: Column = Column {
    name: "deformation",
    dimension: Dimension::LENGTH,
};
const TIME: Column = Column {
    name: "time",
    dimension: Dimension::TIME,
};

/// The rows of a file as a path.
fn history(law: &LawDescriptor, source: &Source, speed: Option<f64>) -> Result<LoadPath, Failure> {
    let read = source.rows(&[&[DEFORMATION], &[TIME, DEFORMATION]])?;
    let row = |(_, row): &(_, Vec<f64>)| match row[..] {
        [time, deformation] => HistoryRow {
            time: Some(time),
            deformation,
        },
        _ => HistoryRow {
            time: None,
            deformation: row[0],
        },
    };
    let rows: Vec<HistoryRow> = read.iter().map(row).collect();
    if speed.is_some() && rows.first().is_some_and(|row| row.time.is_some()) {
        return Err(Failure::input(
            "--rate contradicts the times of the history",
            Some("leave --rate out, or the column of times".to_owned()),
        ));
    }
    LoadPath::history(law, &rows, speed).map_err(|error| match error {
        LaboratoryError::TimeOrder { row } | LaboratoryError::UnknownStart { row } => {
            source.error(read[row].0.clone(), error.to_string(), &error.help())
        }
        error => error.into(),
    })
}
