//! `pounding ida`: incremental dynamic analysis, fragility, and the gap for a frequency.

pub mod numbers;
mod tables;

use std::path::Path;

use pounding_files::FileUse;
use pounding_files::checksum::WithoutChecksum;
use pounding_report::openquake::{Measure, fragility_model};
use pounding_report::page::{Inputs, Picture};
use pounding_report::pictures::ida::fragility;
use pounding_study::{
    IdaReport, IdaSettings, IntensityMeasure, ResultReader, Study, StudyError, SweepOptions,
    SweepReport, evaluate,
};

use crate::arguments::IdaArguments;
use crate::command_words::quoted;
use crate::failure::Failure;
use crate::files::{have_a_place, reads_too};
use crate::output::{comma_separated, pretty, print, warn};
use crate::plan::{self, Planned, path_word};
use crate::progress::{Progress, Unit, threads};
use crate::study::{
    Finished, all_failed, name, options, read, run, shard, stands_complete, summary,
};
use crate::{page, plot};

/// Runs all records at all intensities and evaluates them.
pub fn ida(arguments: &IdaArguments, mut files: FileUse) -> Result<(), Failure> {
    let study = read(&arguments.study)?;
    let Some(settings) = &study.ida else {
        return Err(no_analysis(&study));
    };
    let openquake = match &arguments.openquake {
        Some(path) => Some((path, measure_of_openquake(&settings.measure)?)),
        None => None,
    };
    let outputs = [
        arguments.plot.as_deref(),
        arguments.table.as_deref(),
        arguments.openquake.as_deref(),
        arguments.running.report.as_deref(),
    ];
    if let Some(scheduler) = arguments.planning.plan {
        let planned = Planned {
            command: "ida",
            at_the_end: at_the_end(arguments),
            written_at_the_end: &outputs,
            running: &arguments.running,
            into: arguments.sharing.into.as_deref(),
            planning: &arguments.planning,
        };
        return plan::print_plan(&study, &planned, (scheduler, arguments.json), &mut files);
    }
    let shard = shard(&arguments.sharing, &arguments.running)?;
    let into = arguments.sharing.into.as_deref();
    let options = options(&study, &arguments.running, (shard, into), &mut files)?;
    if stands_complete(&options, &arguments.running, &files)? {
        return Ok(());
    }
    have_a_place(outputs)?;
    let sweep = run(&study, &options, into)?;
    if let Err(failed) = all_failed(&sweep, shard) {
        tell(arguments, (&study, &sweep, &options), None)?;
        return Err(failed);
    }
    if shard.is_some() {
        return part(arguments, &study, &sweep, &options);
    }
    let result = ResultReader::open(&options.output, WithoutChecksum::Refuse);
    let result = result.map_err(StudyError::from)?;
    let report = evaluated(&study, &result, arguments.running.threads)?;
    if let Some(path) = &arguments.plot {
        plot::write_drawn(path, fragility(&report), &arguments.figure)?;
    }
    if let Some(path) = &arguments.table {
        write_table(path, &report)?;
    }
    if let Some((path, measure)) = openquake {
        write_openquake(path, &study, (&report, &measure))?;
    }
    if let Some(path) = &arguments.running.report {
        write_page(path, &study, &result, &report)?;
    }
    tell(
        arguments,
        (&study, &sweep, &options),
        Some((&report, settings)),
    )
}

/// What the runs say.
fn evaluated(
    study: &Study,
    result: &ResultReader,
    asked: Option<u32>,
) -> Result<IdaReport, Failure> {
    let progress = Progress::begin(Unit::Part)?;
    let tell = |done: usize, states: usize| progress.show(done, states, "evaluation");
    Ok(evaluate(study, result, (threads(asked), &tell))?)
}

/// Prints what the runs are, and what they say, if they do.
fn tell(
    arguments: &IdaArguments,
    (study, sweep, options): (&Study, &SweepReport, &SweepOptions),
    said: Option<(&IdaReport, &IdaSettings)>,
) -> Result<(), Failure> {
    if arguments.json {
        return print(&pretty(&numbers::Answer {
            analysis: said.map(|(report, settings)| numbers::Analysis::of(report, settings)),
            sweep: Finished::of(sweep, options),
        })?);
    }
    let mut text = summary(study, sweep, options);
    if let Some((report, settings)) = said {
        text.push_str(&tables::report(report, settings));
    }
    print(&text)
}

/// A part of the study is a part of its runs, which the whole is evaluated from.
fn part(
    arguments: &IdaArguments,
    study: &Study,
    sweep: &SweepReport,
    options: &SweepOptions,
) -> Result<(), Failure> {
    if let Some(path) = &arguments.running.report {
        page::of_sweep(&options.output, path)?;
    }
    if arguments.json {
        return print(&pretty(&Finished::of(sweep, options))?);
    }
    let mut text = summary(study, sweep, options);
    let file = quoted(&path_word(&study.file));
    text.push_str(&format!(
        "When all shards are done: `pounding merge` with all of them and -o ALL.h5, then `pounding ida {file} -o ALL.h5 --resume`\n"
    ));
    print(&text)
}

/// Options of the analysis of the whole study.
fn at_the_end(arguments: &IdaArguments) -> Vec<String> {
    let files = [
        ("--table", &arguments.table),
        ("--openquake", &arguments.openquake),
        ("--plot", &arguments.plot),
    ];
    let given = files.iter().filter_map(|(option, path)| {
        let path = path_word(path.as_ref()?);
        Some([(*option).to_owned(), path])
    });
    given.flatten().collect()
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

/// The intensity measure of a study as OpenQuake knows it.
fn measure_of_openquake(measure: &IntensityMeasure) -> Result<Measure, Failure> {
    Measure::of(measure).map_err(|e| Failure::input(e.to_string(), Some(e.help())))
}

/// Writes the fragilities for OpenQuake, and says which states have none.
fn write_openquake(
    path: &Path,
    study: &Study,
    (report, measure): (&IdaReport, &Measure),
) -> Result<(), Failure> {
    let model = fragility_model(report, measure, (&name(&study.file), &study.title));
    let file = path.display();
    if !model.left_out.is_empty() {
        warn(&format!(
            "{file} has no function for states without a fragility: {}",
            model.left_out.join(", ")
        ));
    }
    plot::write(path, &model.xml)
}

/// Writes the page of a result of the study; one of another study is refused.
pub fn page_of_result(
    study: &Path,
    result: &ResultReader,
    output: &Path,
    files: &mut FileUse,
) -> Result<(), Failure> {
    let study = read(study)?;
    reads_too(files, study.files())?;
    let d = &result.description;
    if study.source != d.study || study.base.source != d.case {
        return Err(Failure::input(
            format!(
                "{} is not the study that the result is of, or its case has changed",
                study.file.display()
            ),
            Some("the result has both texts, as its attributes `study` and `case`".to_owned()),
        ));
    }
    if study.ida.is_none() {
        return Err(Failure::input(
            format!(
                "{} has no [ida], of which --study makes the page",
                study.file.display()
            ),
            Some("leave --study away: the page of a sweep needs none".to_owned()),
        ));
    }
    if !d.part.is_whole() {
        return Err(Failure::input(
            format!(
                "{} is {}, of which --study makes no page",
                result.path().display(),
                d.part
            ),
            Some(
                "merge all shards first (pounding merge), or leave --study away: the page of the runs needs none"
                    .to_owned(),
            ),
        ));
    }
    let report = evaluated(&study, result, None)?;
    write_page(output, &study, result, &report)
}

fn write_page(
    output: &Path,
    study: &Study,
    result: &ResultReader,
    report: &IdaReport,
) -> Result<(), Failure> {
    let Some(settings) = &study.ida else {
        return Err(no_analysis(study));
    };
    let d = &result.description;
    let words = "Incremental dynamic analysis";
    let drawn = [Picture::of("fragility", words, fragility(report))];
    let inputs = Inputs {
        title: d.title.clone(),
        origin: vec![
            "ida".to_owned(),
            study.file.display().to_string(),
            format!("pounding {}", d.version),
        ],
        warnings: d.warnings.clone(),
        facts: vec![
            ("build".to_owned(), d.build.clone()),
            ("SHA-256 of the study".to_owned(), d.study_sha256.clone()),
            ("SHA-256 of the records".to_owned(), d.records.clone()),
        ],
        listings: vec![
            ("The study file".to_owned(), d.study.clone()),
            ("The case file".to_owned(), d.case.clone()),
        ],
    };
    let answer = page::answer(&numbers::Analysis::of(report, settings))?;
    let html = pounding_report::page::ida(&answer, &drawn, &inputs);
    plot::write(output, &html)
}

fn no_analysis(study: &Study) -> Failure {
    Failure::input(
        format!("{} has no [ida]", study.file.display()),
        Some("add it, or run the study with pounding sweep".to_owned()),
    )
}
