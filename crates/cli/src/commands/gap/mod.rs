//! `pounding gap`: is the gap wide enough?

mod files;
mod numbers;
mod provisions;
mod text;

pub use files::csv;

use std::path::Path;

use pounding_case::{Case, Dimension, Separation, parse_quantity};
use pounding_files::FileUse;
use pounding_study::gap_check::{
    CheckError, GapCheck, GapCheckOptions, SweepOptions, gap_check, under_records,
};

use super::progress::{Progress, Unit, threads};
use super::{have_a_place, pretty, print, reads_too, record_files};
use crate::arguments::{GapArguments, OutputPath};
use crate::failure::Failure;
use crate::faults::{of_records, read_case};
use crate::plot;

/// Checks the gaps of a case; the answer "too small" is exit code 1.
pub fn gap(arguments: &GapArguments, mut files: FileUse) -> Result<(), Failure> {
    let Some(path) = arguments.case.as_deref().filter(|_| !arguments.list) else {
        return provisions::list(arguments.json);
    };
    let case = read_case(path, arguments.records.is_empty())?;
    let separation = separation(&case, arguments)?;
    let options = options(arguments)?;
    let failed = |e| failure(e, &case);
    let given = record_files(&arguments.records).map_err(failed)?;
    reads_too(&mut files, case.files())?;
    let records =
        under_records(&case, &given).map_err(|e| of_records(e, &case, given.is_empty()))?;
    reads_too(
        &mut files,
        records.iter().map(|r| ("record", r.file.clone())),
    )?;
    have_a_place([
        arguments.csv.as_deref(),
        arguments.codes_csv.as_deref(),
        arguments.plot.as_deref(),
    ])?;
    let progress = Progress::begin(Unit::Runs)?;
    let tell = |done: usize, total: usize| progress.show(done, total, "");
    let check = gap_check(&case, &separation, &records, &options, &tell).map_err(failed)?;
    drop(progress);
    write_files(arguments, &check)?;
    if arguments.json {
        print(&pretty(&numbers::check(&check)))?;
    } else {
        print(&text::report(&case, &check, arguments.all))?;
    }
    if check.adequate() {
        Ok(())
    } else {
        Err(Failure::No)
    }
}

/// A failure of a check, with its place in the case where it has one.
pub fn failure(error: CheckError, case: &Case) -> Failure {
    let help = error.help();
    match error {
        CheckError::Case(error) => Failure::case(error, &case.source),
        CheckError::Record { source, record } => match Failure::assembly(*source, "") {
            Failure::Input(report) => Failure::Input(report.wrap_err(format!("record {record}"))),
            Failure::Inputs(reports) => Failure::Inputs(
                reports
                    .into_iter()
                    .map(|r| r.wrap_err(format!("record {record}")))
                    .collect(),
            ),
            Failure::Computation(report) => {
                Failure::Computation(report.wrap_err(format!("record {record}")))
            }
            other => other,
        },
        error @ CheckError::OwnLaw { .. } => Failure::computation(error.to_string(), help),
        error => Failure::input(error.to_string(), help),
    }
}

fn separation(case: &Case, arguments: &GapArguments) -> Result<Separation, Failure> {
    let mut separation = case.separation.clone();
    for text in &arguments.set {
        let one = Separation::parse(text, case.buildings.len());
        separation = separation.overridden_by(one.map_err(|e| Failure::case(e, text))?);
    }
    if !arguments.provisions.is_empty() {
        let quoted: Vec<_> = arguments
            .provisions
            .iter()
            .map(|p| format!("{p:?}"))
            .collect();
        let text = format!("provisions = [{}]", quoted.join(", "));
        let one = Separation::parse(&text, case.buildings.len());
        separation = separation.overridden_by(one.map_err(|e| Failure::case(e, &text))?);
    }
    Ok(separation)
}

fn options(arguments: &GapArguments) -> Result<GapCheckOptions, Failure> {
    let width =
        |text: &Option<String>, name: &str| text.as_deref().map(|t| length(t, name)).transpose();
    let (from, to) = (width(&arguments.from, "from")?, width(&arguments.to, "to")?);
    let sweep = (arguments.points > 0).then(|| SweepOptions {
        gap: arguments.gap.clone(),
        from,
        to,
        points: arguments.points,
    });
    Ok(GapCheckOptions {
        target_probability: arguments.probability,
        confidence: arguments.confidence,
        sweep,
        threads: threads(arguments.threads),
    })
}

/// A length of an argument (m).
fn length(text: &str, name: &str) -> Result<f64, Failure> {
    let refused = |message: String| {
        Failure::input(message, Some("write a length such as \"20 mm\"".to_owned()))
    };
    let quantity = parse_quantity(text).map_err(|e| {
        let help = e.help_for(Some(Dimension::LENGTH));
        Failure::input(format!("--{name}: {e}"), Some(help))
    })?;
    match quantity.dimension {
        Some(found) if found != Dimension::LENGTH => {
            Err(refused(format!("--{name} must be a length, not {found}")))
        }
        _ => Ok(quantity.value),
    }
}

fn write_files(arguments: &GapArguments, check: &GapCheck) -> Result<(), Failure> {
    let write = |path: &Option<OutputPath>, text: &dyn Fn() -> Result<String, Failure>| {
        let write = |path: &Path| plot::write(path, &text()?);
        path.as_deref().map_or(Ok(()), write)
    };
    write(&arguments.codes_csv, &|| files::codes(check))?;
    if (arguments.csv.is_some() || arguments.plot.is_some()) && check.sweep.is_none() {
        let help = "leave --points 0 away".to_owned();
        let message = "without a sweep there is nothing to write or draw";
        return Err(Failure::input(message, Some(help)));
    }
    write(&arguments.csv, &|| files::sweep(check))?;
    write(&arguments.plot, &|| files::figure(check))
}
