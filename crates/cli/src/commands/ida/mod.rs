//! `pounding ida`: incremental dynamic analysis, fragility, and the gap for a frequency.

mod numbers;
mod tables;

use std::path::Path;

use pounding_files::FileUse;
use pounding_files::checksum::WithoutChecksum;
use pounding_report::pictures::ida::fragility;
use pounding_study::{IdaReport, ResultReader, Shard, Study, StudyError, evaluate};

use crate::arguments::IdaArguments;
use crate::failure::Failure;
use crate::files::have_a_place;
use crate::output::{comma_separated, pretty, print};
use crate::study::{Finished, all_failed, options, run, summary};
use crate::{page, plot};

/// Runs all records at all intensities and evaluates them.
pub fn ida(arguments: &IdaArguments, mut files: FileUse) -> Result<(), Failure> {
    let study = Study::read(&arguments.study)?;
    let Some(settings) = &study.ida else {
        return Err(Failure::input(
            format!("{} has no [ida]", arguments.study.display()),
            Some("add it, or run the study with pounding sweep".to_owned()),
        ));
    };
    let options = options(&study, &arguments.running, Shard::WHOLE, &mut files)?;
    have_a_place([
        arguments.plot.as_deref(),
        arguments.table.as_deref(),
        arguments.running.report.as_deref(),
    ])?;
    let sweep = run(&study, &options)?;
    all_failed(&sweep)?;
    let result = ResultReader::open(&options.output, WithoutChecksum::Refuse);
    let report = evaluate(&study, &result.map_err(StudyError::from)?)?;
    if let Some(path) = &arguments.plot {
        plot::write_drawn(path, fragility(&report))?;
    }
    if let Some(path) = &arguments.table {
        write_table(path, &report)?;
    }
    let answer = numbers::Answer {
        analysis: numbers::Analysis::of(&report, settings.confidence),
        sweep: Finished::of(&sweep, &options),
    };
    if let Some(path) = &arguments.running.report {
        let words = "Fragilities with the counts that they were fitted to";
        let drawn = [page::picture(fragility(&report), words)?];
        let mut inputs = page::inputs("ida", &study.title, &arguments.study);
        let hash = (
            "SHA-256 of the study".to_owned(),
            sweep.study_sha256.clone(),
        );
        inputs.facts.push(hash);
        inputs.listings = vec![
            ("The study file".to_owned(), study.source.clone()),
            ("The case file".to_owned(), study.base.source.clone()),
        ];
        let answer = page::answer(&answer)?;
        let target = settings.target_frequency;
        let html = pounding_report::page::ida(&answer, target, &drawn, &inputs);
        plot::write(path, &html)?;
    }
    if arguments.json {
        return print(&pretty(&answer)?);
    }
    let mut text = summary(&study, &sweep, &options);
    text.push_str(&tables::report(&report, settings));
    print(&text)
}

/// Counts of every state at every intensity, for other programs to fit.
fn write_table(path: &Path, report: &IdaReport) -> Result<(), Failure> {
    let intensity = format!("intensity [{}]", report.unit);
    let header = ["state", &intensity, "runs", "reached"];
    let widths = report
        .gaps
        .iter()
        .flat_map(|g| g.widths.iter().map(|w| &w.result));
    let states = report.limits.iter().chain(widths);
    let rows = states.flat_map(|state| {
        let counts = state.counts.iter();
        counts.map(|c| {
            [
                state.name.clone(),
                format!("{:?}", c.intensity),
                c.runs.to_string(),
                c.reached.to_string(),
            ]
        })
    });
    plot::write(path, &comma_separated(&header, rows)?)
}
