//! What `motion info` prints and writes.

use std::fmt::Write as _;

use pounding_catalogue::numbers::six_digits;
use pounding_catalogue::wording::cell;
use pounding_ground_motion::measures::IntensityMeasures;
use pounding_ground_motion::{
    Accelerogram, HeaderPeak, Origin, Peak, Processing, ResponseFile, Sampling, Series,
};
use serde::Serialize;

use super::measures::rows;
use crate::tables::new_long_table;

/// One series with its measures.
pub struct Shown {
    /// As in the file.
    pub series: Series,
    /// As excitation, for accelerations.
    pub record: Option<Accelerogram>,
    /// Its measures; none for other quantities and for records of zeros.
    pub measures: Option<IntensityMeasures>,
}

/// One file.
pub struct ShownFile {
    /// Its name.
    pub file: String,
    /// Its series, in the order of the file.
    pub series: Vec<Shown>,
}

/// Tables of each file.
pub fn as_text(files: &[ShownFile]) -> String {
    let mut text = String::new();
    for file in files {
        text.push_str(&header(file));
        text.push_str(&series_table(file));
        let remarks = differences(file);
        text.push_str(&remarks);
        if !remarks.is_empty() {
            text.push('\n');
        }
        text.push_str(&measures_table(file));
        text.push('\n');
    }
    text
}

/// What the header says, once where all series agree.
fn header(file: &ShownFile) -> String {
    let mut text = String::new();
    let Some(first) = file.series.first().map(|s| &s.series.origin) else {
        return text;
    };
    let _ = writeln!(
        text,
        "{}\nformat {}, SHA-256 {}",
        file.file, first.format, first.sha256
    );
    let mut responses: Vec<&ResponseFile> = Vec::new();
    for response in file
        .series
        .iter()
        .filter_map(|s| s.series.origin.response.as_ref())
    {
        if !responses.contains(&response) {
            responses.push(response);
            let _ = writeln!(
                text,
                "sensitivity by {}, SHA-256 {}; that of the record is of both",
                response.file, response.sha256
            );
        }
    }
    let mut reported: Vec<String> = Vec::new();
    for one in &file.series {
        let origin = &one.series.origin;
        let corner = |f: Option<f64>| f.map_or("none stated".to_owned(), |f| format!("{f} Hz"));
        let filtered = match (origin.low_corner, origin.high_corner) {
            (None, None) => String::new(),
            (low, high) => format!(
                "; filter corners low {}, high {}",
                corner(low),
                corner(high)
            ),
        };
        let start = match origin.start_time.as_str() {
            "" => String::new(),
            time => format!("; first sample {time}"),
        };
        let line = format!(
            "{}\n  {}{filtered}{start}",
            origin.title,
            processing(origin)
        );
        if !reported.contains(&line) {
            let _ = writeln!(text, "{}", line.trim());
            reported.push(line);
        }
    }
    text
}

/// Whether a file of our own says by what steps it came about.
fn has_steps(origin: &Origin) -> bool {
    origin.history.iter().any(|line| line.starts_with("Step:"))
}

fn processing(origin: &Origin) -> &'static str {
    match origin.processing {
        Processing::Unstated if has_steps(origin) => {
            "generated or processed by the steps that the lines \"before: Step\" name"
        }
        Processing::Unstated => "the file does not say how it was processed",
        Processing::Raw => "not corrected",
        Processing::Corrected => "corrected by the agency",
    }
}

/// A value (SI) in a unit of the file, for people.
fn in_unit(value: f64, unit: &str, unit_in_si: f64) -> String {
    format!("{} {unit}", six_digits(value / unit_in_si))
}

/// The value of largest magnitude as the file has it, with sign and unit.
fn peak_of_samples(series: &Series) -> String {
    in_unit(series.signed_peak().0, series.unit, series.unit_in_si)
}

fn peak_of_header(peak: &HeaderPeak) -> String {
    in_unit(peak.value, peak.unit, peak.unit_in_si)
}

/// Where the header's signs are not those of the samples: a line per series, and what
/// it means.
fn opposite_signs(file: &ShownFile) -> String {
    let mut text = String::new();
    let stated = || {
        let all = file.series.iter().map(|s| &s.series);
        all.filter_map(|s| Some((s, s.header_peak.as_ref()?)))
    };
    let opposite: Vec<_> = stated().filter(|(_, h)| h.opposite_sign).collect();
    for (series, peak) in &opposite {
        let _ = writeln!(
            text,
            "remark: {}: peak {} in the samples, {} in the header: the signs differ",
            series.label(),
            peak_of_samples(series),
            peak_of_header(peak)
        );
    }
    if opposite.is_empty() {
        return text;
    }
    let cause = if stated().all(|(_, peak)| peak.value >= 0.0) {
        "the header may print magnitudes, or the record may be turned round"
    } else if opposite.len() == stated().count() {
        "all signs of the header are opposite to those of the samples"
    } else {
        "header and samples do not have one sign convention"
    };
    let _ = writeln!(
        text,
        "remark: {cause}; the samples are used as they stand (`motion process --sign reversed` turns them)"
    );
    text
}

fn series_table(file: &ShownFile) -> String {
    let mut table = new_long_table([
        "channel",
        "component",
        "quantity",
        "unit in file",
        "samples",
        "in header",
        "time step (s)",
        "peak as in file",
        "at (s)",
        "peak in header",
        "at (s)",
    ]);
    for one in &file.series {
        let s = &one.series;
        let (stated, at) = match s.header_peak {
            None => ("-".to_owned(), None),
            Some(peak) => (peak_of_header(&peak), peak.time),
        };
        table.add_row([
            s.channel.to_string(),
            s.component.clone(),
            s.quantity.name().to_owned(),
            s.unit.to_owned(),
            s.samples.len().to_string(),
            s.origin
                .header_count
                .map_or("-".to_owned(), |n| n.to_string()),
            step_text(&s.sampling),
            peak_of_samples(s),
            format!("{:.3}", s.signed_peak().1),
            stated,
            at.map_or("-".to_owned(), |t| format!("{t:.3}")),
        ]);
    }
    format!("\n{table}\n\n")
}

fn step_text(sampling: &Sampling) -> String {
    match sampling {
        Sampling::Even { time_step } => format!("{time_step}"),
        Sampling::Uneven { times } => {
            let steps = || times.windows(2).map(|t| t[1] - t[0]);
            let least = steps().fold(f64::INFINITY, f64::min);
            format!("{least:.4} to {:.4}", steps().fold(0.0, f64::max))
        }
    }
}

/// What header and data disagree on, and what was done about the mean.
fn differences(file: &ShownFile) -> String {
    let mut text = String::new();
    for one in &file.series {
        for line in &one.series.origin.history {
            let _ = writeln!(text, "before: {line}");
        }
        for warning in warnings(one) {
            let _ = writeln!(text, "warning: {}: {warning}", one.series.label());
        }
    }
    text + &opposite_signs(file)
}

fn warnings(one: &Shown) -> &[String] {
    let read = one.record.as_ref().and_then(|r| r.origin());
    &read.unwrap_or(&one.series.origin).warnings
}

fn measures_table(file: &ShownFile) -> String {
    let measured: Vec<_> = file
        .series
        .iter()
        .filter_map(|s| Some((&s.series.component, rows(s.measures.as_ref()?))))
        .collect();
    let Some((_, first)) = measured.first() else {
        return "no acceleration to measure\n".to_owned();
    };
    let mut header = vec!["measure"];
    header.extend(measured.iter().map(|(name, _)| name.as_str()));
    let mut table = new_long_table(&header);
    if let Some(column) = table.column_mut(0) {
        column.set_cell_alignment(comfy_table::CellAlignment::Left);
    }
    for (i, row) in first.iter().enumerate() {
        let mut cells = vec![row.words.clone()];
        cells.extend(measured.iter().map(|(_, rows)| rows[i].shown()));
        table.add_row(cells);
    }
    format!("{table}\n")
}

/// What `--json` prints.
#[derive(Serialize)]
pub struct Files<'f> {
    files: Vec<File<'f>>,
}

/// A file with its series.
#[derive(Serialize)]
struct File<'f> {
    file: &'f str,
    format: Option<&'f str>,
    sha256: Option<&'f str>,
    series: Vec<OneSeries<'f>>,
}

/// A series as it is read, and the measures of an acceleration.
#[derive(Serialize)]
struct OneSeries<'f> {
    channel: usize,
    component: &'f str,
    quantity: &'static str,
    unit_in_file: &'static str,
    samples: usize,
    /// Of even sampling.
    time_step: Option<f64>,
    uneven: bool,
    measured_time_step: Option<f64>,
    mean: f64,
    peak: Peak,
    signed_peak: f64,
    header_peak: Option<PeakOfHeader>,
    header_samples: Option<usize>,
    initial_velocity: Option<f64>,
    initial_displacement: Option<f64>,
    title: &'f str,
    processing: &'static str,
    start_time: &'f str,
    low_corner: Option<f64>,
    high_corner: Option<f64>,
    history: &'f [String],
    warnings: &'f [String],
    measures: Option<&'f IntensityMeasures>,
}

/// The maximum that a header states.
#[derive(Serialize)]
struct PeakOfHeader {
    value: f64,
    time: Option<f64>,
    opposite_sign: bool,
}

impl<'f> Files<'f> {
    /// All files of the command.
    pub fn of(files: &'f [ShownFile]) -> Self {
        let files = files.iter().map(|f| {
            let origin = f.series.first().map(|s| &s.series.origin);
            File {
                file: &f.file,
                format: origin.map(|o| &*o.format),
                sha256: origin.map(|o| o.sha256.as_str()),
                series: f.series.iter().map(OneSeries::of).collect(),
            }
        });
        Self {
            files: files.collect(),
        }
    }
}

impl<'f> OneSeries<'f> {
    fn of(one: &'f Shown) -> Self {
        let s = &one.series;
        let origin = &s.origin;
        let (time_step, uneven) = match &s.sampling {
            Sampling::Even { time_step } => (Some(*time_step), false),
            Sampling::Uneven { .. } => (None, true),
        };
        Self {
            channel: s.channel,
            component: &s.component,
            quantity: s.quantity.name(),
            unit_in_file: s.unit,
            samples: s.samples.len(),
            time_step,
            uneven,
            measured_time_step: one.record.as_ref().map(Accelerogram::time_step),
            mean: s.mean(),
            peak: s.peak(),
            signed_peak: s.signed_peak().0,
            header_peak: s.header_peak.map(|p| PeakOfHeader {
                value: p.value,
                time: p.time,
                opposite_sign: p.opposite_sign,
            }),
            header_samples: origin.header_count,
            initial_velocity: s.initial.map(|i| i.0),
            initial_displacement: s.initial.map(|i| i.1),
            title: &origin.title,
            processing: processing_word(origin),
            start_time: &origin.start_time,
            low_corner: origin.low_corner,
            high_corner: origin.high_corner,
            history: &origin.history,
            warnings: warnings(one),
            measures: one.measures.as_ref(),
        }
    }
}

fn processing_word(origin: &Origin) -> &'static str {
    match origin.processing {
        Processing::Unstated if has_steps(origin) => "steps",
        Processing::Unstated => "unstated",
        Processing::Raw => "raw",
        Processing::Corrected => "corrected",
    }
}

/// A row for each acceleration, SI units, full precision.
pub fn comma_separated(files: &[ShownFile]) -> String {
    let mut text = String::new();
    for file in files {
        for one in &file.series {
            let Some(measures) = &one.measures else {
                continue;
            };
            let rows = rows(measures);
            if text.is_empty() {
                let names: Vec<_> = rows.iter().map(|r| r.name).collect();
                text = format!("file,channel,component,{}\n", names.join(","));
            }
            let values: Vec<_> = rows
                .iter()
                .map(|r| r.value.map_or(String::new(), |v| v.to_string()))
                .collect();
            let Series {
                channel, component, ..
            } = &one.series;
            let _ = writeln!(
                text,
                "{},{channel},{},{}",
                quoted(&file.file),
                quoted(component),
                values.join(",")
            );
        }
    }
    text
}

/// A field of a CSV file.
fn quoted(text: &str) -> String {
    let text = cell(text);
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into_owned()
    }
}
