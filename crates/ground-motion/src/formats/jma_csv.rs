//! CSV of the Japan Meteorological Agency: `KEY= value` lines, `NS,EW,UD`, rows.

use crate::cut_numbers::Forms;
use crate::draft::{Draft, DraftUnit};
use crate::error::GroundMotionError;
use crate::format::Format;
use crate::formats::rows::{not_of_format, second_record};
use crate::number::Bare;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::source::Source;
use crate::text::Line;
use crate::time_column::Times;

pub(super) static FORMAT: Format = Format {
    name: "jma_csv",
    title: "CSV of the Japan Meteorological Agency",
    source: "Japan Meteorological Agency",
    recognised_by: "SITE CODE in the first line",
};

/// Keys of which one at least stands before the names of the columns.
const KEYS: [&str; 4] = ["site", "sampling", "unit", "initial time"];

const UNITS: &str = "give the record of the accelerations, whose unit is gal(cm/s/s); if the unit alone is wrong, correct the line";

pub(super) fn matches(source: &Source<'_>) -> bool {
    source.lines().next().is_some_and(is_first)
}

fn is_first(line: Line<'_>) -> bool {
    line.lower().contains("site code")
}

/// Whether a line has the names of the columns, which may be single letters: `N,E,U`, `N-S,E-W,U-D`.
fn has_names(line: Line<'_>, text: &str) -> bool {
    let mut names = text.split(',').map(str::trim);
    line.is_text() || names.all(|name| name.starts_with(|c: char| c.is_ascii_alphabetic()))
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let (mut step, mut unit, mut is_keyed) = (None, DraftUnit::Unstated, false);
    let (mut site, mut start) = (String::new(), String::new());
    let (header, names) = loop {
        let line = source.expect(&mut lines, "the line NS,EW,UD")?;
        let text = line.text();
        let text = text.trim_end_matches([',', ' ']);
        let Some((key, value)) = text.split_once('=') else {
            if has_names(line, text) {
                if !is_keyed {
                    let keys = "\"SITE CODE= \", \"SAMPLING RATE= \" or \"UNIT = \"";
                    return Err(not_of_format(
                        source,
                        line.number,
                        &FORMAT,
                        (keys, "columns"),
                    ));
                }
                let names = text.split(',').map(|n| n.trim().to_owned());
                break (line.number, names.collect::<Vec<_>>());
            }
            continue;
        };
        let (key, value) = (key.trim().to_ascii_lowercase(), value.trim());
        is_keyed |= KEYS.iter().any(|known| key.starts_with(known));
        if key.starts_with("sampling") {
            let stated = source.step_or_rate(line, value, Bare::Rate)?;
            step = stated.filter(|s| s.is_finite() && *s > 0.0);
        } else if key.starts_with("unit") {
            // `gal(cm/s/s)`: the same unit twice.
            let mut words = value.split(['(', ')']).map(SeriesUnit::parse);
            let (stated, again) = (words.next().flatten(), words.next().flatten());
            if let (Some(stated), Some(again)) = (stated, again)
                && stated != again
            {
                return Err(source.two_units(line, stated, again));
            }
            if !value.is_empty() && stated.is_none() {
                return Err(source.unknown_unit(line.number, value, UNITS));
            }
            unit = stated.map_or(DraftUnit::Unstated, DraftUnit::Stated);
        } else if key.starts_with("site") {
            site = value.to_owned();
        } else if key.starts_with("initial time") && !value.is_empty() {
            start = format!("{value} JST");
        }
    };
    if names.len() > 12 {
        return Err(source.error(header, 0, "more than 12 components", "get the record again"));
    }
    let room = lines.remaining() / (2 * names.len()) + 1;
    let mut values: Vec<Vec<f64>> = names.iter().map(|_| Vec::with_capacity(room)).collect();
    let mut forms: Vec<Forms> = names.iter().map(|_| Forms::default()).collect();
    let mut blank = None;
    for line in lines.by_ref() {
        if line.is_text() && is_first(line) {
            return Err(second_record(source, line));
        }
        if line.is_blank() {
            blank = blank
                .or(Some(line.number))
                .filter(|_| !values[0].is_empty());
            continue;
        }
        if let Some(blank) = blank {
            return Err(source.error(
                blank,
                0,
                "a blank row stands within the data: its samples are missing",
                "the file is damaged: get it again",
            ));
        }
        let mut at = 0;
        let mut found = 0;
        for field in line.bytes.split(|b| *b == b',') {
            let blank = field.trim_ascii().is_empty();
            if let Some((column, forms)) = values.get_mut(found).zip(forms.get_mut(found)) {
                column.push(source.number(line, at, field)?);
                forms.see(line.number, at, field.trim_ascii());
            } else if !blank {
                return Err(columns(source, line.number, names.len()));
            }
            found += 1;
            at += field.len() + 1;
        }
        if found < names.len() {
            return Err(columns(source, line.number, names.len()));
        }
    }
    match source.ends_whole()? {
        true => forms.iter().try_for_each(|forms| forms.are_whole(source))?,
        // The components are of one length.
        false => values
            .iter_mut()
            .for_each(|column| column.truncate(column.len().saturating_sub(1))),
    }
    let ends = (header, header + 1, lines.number());
    let mut series = Vec::new();
    for (name, samples) in names.into_iter().zip(values) {
        let stated = match &unit {
            DraftUnit::Stated(u) => DraftUnit::Stated(*u),
            _ => DraftUnit::Unstated,
        };
        let mut draft = Draft::new(samples, stated, ends);
        draft.component = name;
        draft.channel = series.len() + 1;
        draft.times = Times::Step(step);
        draft.title.clone_from(&site);
        draft.start_time.clone_from(&start);
        series.push(draft.finish(source)?);
    }
    Ok(series)
}

fn columns(source: &Source<'_>, line: usize, count: usize) -> GroundMotionError {
    source.error(
        line,
        0,
        format!("the row does not have {count} values"),
        "the file is damaged or truncated: get it again",
    )
}
