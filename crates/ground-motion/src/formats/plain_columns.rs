//! Plain columns of numbers: `"a"` along the rows, or named columns.

use super::{Found, Source, fields};
use crate::error::GroundMotionError;
use crate::number;

const COMMENTS: [&str; 6] = ["#", "%", "*", "!", "//", "$"];

fn is_comment(line: &str) -> bool {
    let start = line.trim_start();
    COMMENTS.iter().any(|c| start.starts_with(c))
}

pub(crate) fn matches(source: &Source<'_>) -> bool {
    let mut lines = source
        .lines
        .iter()
        .skip(source.options.skip_lines)
        .filter(|l| !l.trim().is_empty() && !is_comment(l))
        .take(30)
        .peekable();
    // A damaged value is still a number to detection: the reader names it.
    lines.peek().is_some() && lines.all(|l| fields(l).all(|(_, f)| looks_numeric(f)))
}

fn looks_numeric(field: &str) -> bool {
    number::parse(field).is_ok()
        || field.chars().all(|c| c == '*')
        || ["nan", "inf", "-inf"].contains(&field.to_ascii_lowercase().as_str())
}

pub(crate) fn read(source: &Source<'_>) -> Result<Found, GroundMotionError> {
    let mut rows = Vec::new();
    for (i, line) in source
        .lines
        .iter()
        .enumerate()
        .skip(source.options.skip_lines)
    {
        if line.trim().is_empty() || is_comment(line) {
            continue;
        }
        let row = fields(line)
            .map(|(column, f)| source.number(i, column, f))
            .collect::<Result<Vec<_>, _>>()?;
        rows.push((i, row));
    }
    let Some((first, _)) = rows.first() else {
        return Err(source.error(
            0,
            0,
            "the file has no data".to_owned(),
            "give a file with values",
        ));
    };
    let first = *first;
    let layout = source
        .options
        .layout
        .clone()
        .unwrap_or_else(|| if is_time(&rows) { "t,a" } else { "a" }.to_owned());
    let names: Vec<&str> = layout.split(',').map(str::trim).collect();
    let mut warnings = Vec::new();
    let (samples, stated) = if names == ["a"] {
        (
            rows.iter().flat_map(|(_, r)| r.iter().copied()).collect(),
            None,
        )
    } else {
        columns(source, &rows, &names, &mut warnings)?
    };
    let (time_step, time_step_source) = source.time_step(stated, first)?;
    let peak = samples
        .iter()
        .fold(0.0_f64, |m: f64, a: &f64| m.max(a.abs()));
    let (unit, unit_source) = source.unit(None, first, peak)?;
    Ok(Found {
        samples,
        unit,
        unit_source,
        time_step,
        time_step_source,
        title: String::new(),
        header_count: None,
        warnings,
    })
}

/// Whether the rows are pairs whose first values increase, as times do.
fn is_time(rows: &[(usize, Vec<f64>)]) -> bool {
    rows.iter().all(|(_, r)| r.len() == 2)
        && rows
            .windows(2)
            .all(|w| match (w[0].1.first(), w[1].1.first()) {
                (Some(a), Some(b)) => b > a,
                _ => false,
            })
}

/// The chosen column, and the time step if there is a time column.
fn columns(
    source: &Source<'_>,
    rows: &[(usize, Vec<f64>)],
    names: &[&str],
    warnings: &mut Vec<String>,
) -> Result<(Vec<f64>, Option<f64>), GroundMotionError> {
    if let Some((line, row)) = rows.iter().find(|(_, r)| r.len() != names.len()) {
        return Err(source.error(
            *line,
            0,
            format!(
                "{} columns where layout \"{}\" has {}",
                row.len(),
                names.join(","),
                names.len()
            ),
            "correct `layout`, or the row",
        ));
    }
    let series: Vec<&str> = names.iter().copied().filter(|n| *n != "t").collect();
    let wanted = match (&source.options.component, series.as_slice()) {
        (Some(component), _) => component.as_str(),
        (None, [only]) => only,
        (None, _) => {
            return Err(source.error(
                rows[0].0,
                0,
                format!("the layout has several series: {}", series.join(", ")),
                "choose one with `component`",
            ));
        }
    };
    let Some(index) = names.iter().position(|n| *n == wanted) else {
        return Err(source.error(
            rows[0].0,
            0,
            format!("layout \"{}\" has no column \"{wanted}\"", names.join(",")),
            "correct `component` or `layout`",
        ));
    };
    let samples: Vec<f64> = rows.iter().map(|(_, r)| r[index]).collect();
    let Some(time) = names.iter().position(|n| *n == "t") else {
        return Ok((samples, None));
    };
    let times: Vec<f64> = rows.iter().map(|(_, r)| r[time]).collect();
    let step = even_step(&times).map_err(|i| {
        source.error(
            rows[i].0,
            0,
            format!("time {} s: the time column is not even", times[i]),
            "resample the record to even steps",
        )
    })?;
    if times[0] != 0.0 {
        warnings.push(format!(
            "the first value is at {} s in the file and is taken at 0; `prepend_zero` keeps its time",
            times[0]
        ));
    }
    Ok((samples, Some(step)))
}

/// Mean step, rounded to a nice value within the print resolution; the index of
/// the first time that is not even otherwise.
fn even_step(times: &[f64]) -> Result<f64, usize> {
    let n = times.len();
    if n < 2 {
        return Err(0);
    }
    let mean = (times[n - 1] - times[0]) / (n - 1) as f64;
    // Nice steps are whole multiples of 10 us.
    let nice = (mean * 1.0e5).round() / 1.0e5;
    let step = if nice > 0.0 && (nice - mean).abs() < 1.0e-6 * mean + 1.0e-9 {
        nice
    } else {
        mean
    };
    let even =
        |(i, t): (usize, &f64)| (t - times[0] - i as f64 * step).abs() <= 0.02 * step + 1.0e-5;
    match times.iter().enumerate().find(|(i, t)| !even((*i, t))) {
        None if step > 0.0 => Ok(step),
        None => Err(1),
        Some((i, _)) => Err(i),
    }
}
