//! Spectra of codes, alone or beside those of a record.

use std::fmt::Write as _;

use pounding_case::Dimension;
use pounding_ground_motion::spectra::design::CodeSpectrum;
use pounding_ground_motion::spectra::{SMOOTH, logarithmic_periods};
use pounding_report::pictures::motion;
use serde::Serialize;

use super::code::{code_spectrum, warn_of_parameters};
use super::spectrum_places::places;
use crate::arguments::{SpectrumArguments, list, once};
use crate::failure::Failure;
use crate::output::{pretty, print};
use crate::plot;
use crate::tables::{G, new_long_table};

/// Periods of the printed table.
const ROWS: usize = 30;

/// What `--json` prints of a code.
#[derive(Serialize)]
pub struct OfCode {
    code: &'static str,
    title: String,
    clause: &'static str,
    damping: f64,
    periods: Vec<f64>,
    pseudo_acceleration: Vec<f64>,
}

impl OfCode {
    /// At these periods (s).
    pub fn of(code: &CodeSpectrum, periods: &[f64]) -> Self {
        Self {
            code: code.name(),
            title: code.title(),
            clause: code.clause(),
            damping: code.damping(),
            periods: periods.to_vec(),
            pseudo_acceleration: periods.iter().map(|t| code.acceleration(*t)).collect(),
        }
    }
}

/// What `--json` prints of codes alone.
#[derive(Serialize)]
struct Answer {
    codes: Vec<OfCode>,
}

/// The spectra of the code that is asked for, one for each damping ratio; none if none is.
pub fn beside(
    arguments: &SpectrumArguments,
    periods: &[f64],
    dampings: &[f64],
) -> Result<Vec<CodeSpectrum>, Failure> {
    let Some(text) = &arguments.code else {
        return Ok(Vec::new());
    };
    let spectra = dampings.iter().map(|damping| {
        let spectrum = code_spectrum(text, *damping)?;
        let checked = spectrum.check_periods(periods);
        checked.map_err(|e| Failure::input(format!("--code: {e}"), e.help()))?;
        Ok(spectrum)
    });
    spectra.collect()
}

/// An option that means nothing without a record.
fn of_records(arguments: &SpectrumArguments) -> Option<&'static str> {
    let read = &arguments.read;
    [
        ("at-samples", arguments.at_samples),
        ("format", read.format.is_some()),
        ("time-step", read.time_step.is_some()),
        ("unit", read.unit.is_some()),
        ("layout", read.layout.is_some()),
        ("component", read.component.is_some()),
        ("skip-lines", read.skip_lines != 0),
        ("skip-columns", read.skip_columns != 0),
        ("prepend-zero", read.prepend_zero),
        ("lenient", read.lenient),
        ("sensitivity", read.sensitivity.is_some()),
        ("response", read.response.is_some()),
        ("gravity", read.gravity.is_some()),
        ("offset", read.offset.is_some()),
    ]
    .into_iter()
    .find_map(|(option, is_given)| is_given.then_some(option))
}

/// Spectra of a code without a record.
pub fn alone(arguments: &SpectrumArguments) -> Result<(), Failure> {
    if let Some(option) = of_records(arguments) {
        return Err(Failure::input(
            format!("--{option} is of a record, and none is given beside --code"),
            Some("leave it out, or name the file of a record".to_owned()),
        ));
    }
    let dampings = list(&arguments.damping, "damping", Dimension::NUMBER)?;
    once("damping", &dampings, "")?;
    let (shown, written) = periods(arguments, &dampings)?;
    let spectra = beside(arguments, &shown, &dampings)?;
    // Whatever the damping.
    spectra.iter().take(1).for_each(warn_of_parameters);
    if let Some(path) = &arguments.csv {
        plot::write(path, &csv(&spectra, &written)?)?;
    }
    if let Some(path) = &arguments.svg {
        plot::write_drawn(path, motion::codes(&spectra, &written), &arguments.figure)?;
    }
    print(&if arguments.json {
        let codes = spectra.iter().map(|s| OfCode::of(s, &written)).collect();
        pretty(&Answer { codes })?
    } else {
        text(&spectra, &shown)
    })
}

/// Periods of the table, and of files and pictures: those that are given, else many over the
/// range of the code, with its corners.
fn periods(
    arguments: &SpectrumArguments,
    dampings: &[f64],
) -> Result<(Vec<f64>, Vec<f64>), Failure> {
    let range = (0.01, 4.0);
    let default = (range.0, range.1, ROWS);
    let shown = places(arguments, default, Dimension::TIME)?;
    if arguments.at.is_some() || arguments.count.is_some() {
        return Ok((shown.clone(), shown));
    }
    let [from, to] = [shown[0], shown[shown.len() - 1]];
    let corners = beside(arguments, &[], &dampings[..1])?;
    let corners = corners.iter().flat_map(CodeSpectrum::corners);
    let corners: Vec<f64> = corners.filter(|t| (from..=to).contains(t)).collect();
    let with_corners = |mut periods: Vec<f64>| {
        periods.extend(&corners);
        periods.sort_by(f64::total_cmp);
        periods.dedup();
        periods
    };
    let many = logarithmic_periods(from, to, SMOOTH)?;
    Ok((with_corners(shown), with_corners(many)))
}

/// The columns that `--target` reads; of several damping ratios a table each would not be one.
fn csv(spectra: &[CodeSpectrum], periods: &[f64]) -> Result<String, Failure> {
    let [spectrum] = spectra else {
        return Err(Failure::input(
            "--csv: a table holds the spectrum of one damping ratio",
            Some("give one --damping, or --json".to_owned()),
        ));
    };
    let mut text = format!(
        "# {} ({})\nperiod_s,psa_m_s2\n",
        spectrum.title(),
        spectrum.clause()
    );
    for period in periods {
        let _ = writeln!(text, "{period},{}", spectrum.acceleration(*period));
    }
    Ok(text)
}

fn text(spectra: &[CodeSpectrum], periods: &[f64]) -> String {
    let mut text = String::new();
    for spectrum in spectra {
        let mut table = new_long_table([
            "period (s)",
            "pseudo-acceleration PSA (g)",
            "displacement SD (mm)",
        ]);
        for period in periods {
            let acceleration = spectrum.acceleration(*period);
            let frequency = std::f64::consts::TAU / period;
            table.add_row([
                format!("{period:.4}"),
                format!("{:.5}", acceleration / G),
                format!("{:.4}", 1e3 * acceleration / (frequency * frequency)),
            ]);
        }
        let _ = writeln!(
            text,
            "\n{} ({})\n{table}",
            spectrum.title(),
            spectrum.clause()
        );
    }
    text
}
