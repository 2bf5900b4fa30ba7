//! `pounding ida`: incremental dynamic analysis, fragility, and the gap for a frequency.

mod picture;
mod tables;

use std::path::Path;

use pounding_files::FileUse;
use pounding_files::checksum::WithoutChecksum;
use pounding_study::{
    FragilityFit, IdaReport, LimitResult, ResultReader, Shard, Study, StudyError, evaluate,
};
use serde_json::{Value, json};

use crate::arguments::IdaArguments;
use crate::failure::Failure;
use crate::files::have_a_place;
use crate::output::{comma_separated, pretty, print};
use crate::plot;
use crate::study::{all_failed, as_json, options, run, summary};

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
    have_a_place([arguments.plot.as_deref(), arguments.table.as_deref()])?;
    let sweep = run(&study, &options)?;
    all_failed(&sweep)?;
    let result = ResultReader::open(&options.output, WithoutChecksum::Refuse);
    let report = evaluate(&study, &result.map_err(StudyError::from)?)?;
    if let Some(path) = &arguments.plot {
        plot::write(path, &picture::curves(&report)?)?;
    }
    if let Some(path) = &arguments.table {
        write_table(path, &report)?;
    }
    if arguments.json {
        let mut value = ida_json(&report, settings.confidence);
        value["sweep"] = as_json(&sweep, &options);
        return print(&pretty(&value));
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

fn ida_json(report: &IdaReport, confidence: f64) -> Value {
    let levels = report.levels.iter().map(|l| {
        let demands = report.demands.iter().zip(&l.fractiles);
        let demands: Vec<_> = demands
            .map(|((name, unit), f)| json!({"name": name, "unit": unit, "p16": f[0], "p50": f[1], "p84": f[2]}))
            .collect();
        json!({"intensity": l.intensity, "runs": l.runs, "failed": l.failed, "collapsed": l.collapsed, "demands": demands})
    });
    let limits = report.limits.iter().map(|l| limit_json(l, confidence));
    let gaps = report.gaps.iter().map(|g| {
        let widths = g.widths.iter().map(|w| {
            let mut value = limit_json(&w.result, confidence);
            value["width"] = json!(w.width);
            value
        });
        json!({
            "gap": g.gap,
            "widths": widths.collect::<Vec<_>>(),
            "minimum": g.minimum.map(|m| json!({"width": m.width, "mean_annual_frequency": m.frequency})),
        })
    });
    json!({
        "measure": report.measure, "unit": report.unit, "records": report.records,
        "levels": levels.collect::<Vec<_>>(),
        "limits": limits.collect::<Vec<_>>(),
        "gaps": gaps.collect::<Vec<_>>(),
    })
}

fn limit_json(limit: &LimitResult, confidence: f64) -> Value {
    let counts: Vec<_> = limit
        .counts
        .iter()
        .map(|c| json!({"intensity": c.intensity, "runs": c.runs, "reached": c.reached}))
        .collect();
    let fit = match limit.fit {
        FragilityFit::Lognormal(f) => json!({
            "kind": "lognormal", "median": f.median, "dispersion": f.dispersion,
            "confidence": confidence, "median_bounds": f.median_bounds(confidence),
            "dispersion_bounds": f.dispersion_bounds(confidence),
            "log_likelihood": f.log_likelihood,
        }),
        FragilityFit::Step { lower, upper } => json!({
            "kind": "step", "lower": lower, "upper": upper.is_finite().then_some(upper),
        }),
        FragilityFit::Never { up_to } => json!({"kind": "never", "up_to": up_to}),
        FragilityFit::Always { from } => json!({"kind": "always", "from": from}),
        FragilityFit::None => json!({"kind": "none"}),
    };
    json!({"name": limit.name, "counts": counts, "fit": fit, "mean_annual_frequency": limit.frequency})
}
