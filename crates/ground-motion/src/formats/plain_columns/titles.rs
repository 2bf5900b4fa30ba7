//! Titles that speak of a velocity or a displacement above values that are taken for accelerations.

use super::column_name::{Role, role};
use super::header::Cells;
use super::names::is_component;
use crate::quantity::{Quantity, of_something_else};

/// The velocity or displacement of which a title before the rows speaks first, with its line, where none of them speaks of
/// an acceleration: more than a hint it is not, as titles speak of much.
pub(super) fn titled(lines: &[Cells]) -> Option<(usize, &str, Quantity)> {
    let lower = |cells: &Cells| cells.text.to_ascii_lowercase();
    let of_acceleration = |cells: &Cells| {
        let role = |name: &String| matches!(role(name), Some(Role::Acceleration(..)));
        cells.names.len() > 1 && cells.names.iter().any(role)
            || ACCELERATIONS.iter().any(|acc| lower(cells).contains(acc))
    };
    if lines.iter().any(of_acceleration) {
        return None;
    }
    lines.iter().find_map(|cells| {
        let times = |name: &String| matches!(role(name), Some(Role::Time(_)));
        let title = cells.separator.is_none() || cells.names.len() < 3;
        let found = begins_a_title(&lower(cells), title)?;
        (!cells.names.iter().any(times)).then(|| (cells.line, cells.text.trim(), found))
    })
}

/// The quantity of a title in lower case whose first words name it, and which goes on in words of a record: `velocity
/// record of station x`, `displacement trace`; where it has few commas also in a direction, a remark in brackets or words
/// behind a comma: `velocidad ns`, `velocity (integrated)`, `corrected velocity, ns`.
fn begins_a_title(lower: &str, is_short: bool) -> Option<Quantity> {
    let words = || {
        lower
            .split(|c: char| !c.is_alphanumeric())
            .filter(|w| !w.is_empty())
    };
    let has = |starts: &[&str]| words().any(|w| starts.iter().any(|start| w.starts_with(start)));
    let of_else = words().any(|w| of_something_else(w) || OF_NO_SERIES.contains(&w));
    if of_else || has(&ACCELERATIONS) || has(&NOT_OF_VALUES) {
        return None;
    }
    let (velocity, displacement) = (has(&VELOCITIES), has(&DISPLACEMENTS));
    let (quantity, starts) = match (velocity, displacement) {
        (true, false) => (Quantity::Velocity, &VELOCITIES[..]),
        (false, true) => (Quantity::Displacement, &DISPLACEMENTS[..]),
        _ => return None,
    };
    let first = words().take_while(|w| BEFORE_QUANTITY.contains(w)).count();
    let named = words().nth(first)?;
    if !starts.iter().any(|start| named.starts_with(start)) {
        return None;
    }
    let at = lower.find(named)? + named.len();
    let rest = lower[at..].trim_start();
    let next = words().nth(first + 1).unwrap_or_default();
    let remark = rest.starts_with(['(', '[']) && OF_STAGE.contains(&next);
    let goes_on = is_short
        && (is_component(next)
            || OF_GROUND.iter().any(|of| rest.starts_with(of))
            || remark
            || rest.starts_with(','));
    // `Velocity record: 3 cm/s` and `velocity, 200 m/s` are of something else; a year is part of a name.
    let is_year = |w: &str| w.len() == 4 && (w.starts_with("19") || w.starts_with("20"));
    let mut behind = words().skip(first + 1);
    let numbers = behind.any(|w| w.starts_with(|c: char| c.is_ascii_digit()) && !is_year(w));
    let is_number = rest.contains([':', '=']) || numbers;
    let found = rest.is_empty() || OF_RECORD.contains(&next) || goes_on;
    (found && !is_number).then_some(quantity)
}

/// First letters of words for the quantities, in the languages of the agencies.
const ACCELERATIONS: [&str; 5] = ["acc", "acel", "beschl", "ivme", "vibration"];
const VELOCITIES: [&str; 3] = ["veloc", "vitesse", "geschwind"];
const DISPLACEMENTS: [&str; 6] = [
    "displ",
    "despl",
    "deplac",
    "d\u{e9}plac",
    "spostam",
    "verschieb",
];
/// Words before the quantity of the values.
const BEFORE_QUANTITY: [&str; 17] = [
    "the",
    "corrected",
    "uncorrected",
    "processed",
    "unprocessed",
    "filtered",
    "raw",
    "recorded",
    "measured",
    "integrated",
    "ground",
    "horizontal",
    "vertical",
    "ns",
    "ew",
    "ud",
    "baseline",
];
/// Words behind it that say that it is that of the values.
const OF_RECORD: [&str; 16] = [
    "record",
    "records",
    "recording",
    "recordings",
    "data",
    "trace",
    "traces",
    "seismogram",
    "seismograms",
    "waveform",
    "waveforms",
    "history",
    "histories",
    "signal",
    "series",
    "component",
];
/// Words that go on with what was measured.
const OF_GROUND: [&str; 2] = ["of ground", "of the ground"];
/// What a remark in brackets begins with that tells how the values came about.
const OF_STAGE: [&str; 5] = [
    "integrated",
    "corrected",
    "uncorrected",
    "filtered",
    "processed",
];
/// Words of titles that speak of a velocity or a displacement of something else, or that it is not that of the values.
const OF_NO_SERIES: [&str; 39] = [
    "other",
    "another",
    "none",
    "given",
    "available",
    "file",
    "files",
    "column",
    "columns",
    "processing",
    "request",
    "separate",
    "separately",
    "is",
    "are",
    "be",
    "no",
    "not",
    "without",
    "and",
    "or",
    "high",
    "low",
    "soil",
    "rock",
    "layer",
    "pulse",
    "control",
    "controlled",
    "drift",
    "see",
    "removed",
    "zero",
    "limit",
    "profile",
    "model",
    "propagation",
    "from",
    "sensor",
];
/// First letters of such words.
const NOT_OF_VALUES: [&str; 4] = ["different", "deriv", "convert", "transduc"];
