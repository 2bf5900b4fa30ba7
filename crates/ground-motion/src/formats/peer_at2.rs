//! PEER strong-motion database: AT2 (acceleration), VT2 (velocity) and DT2
//! (displacement) in all header forms that were met: `NPTS=, DT=`, numbers first,
//! four or seven header lines, and the free header of Peknold's El Centro.

use crate::cut_numbers::Forms;
use crate::direction::Direction;
use crate::draft::{
    Draft, DraftPeak, DraftUnit, NamedQuantity, StatedDuration, decimated, not_applied, several,
};
use crate::error::GroundMotionError;
use crate::format::Format;
use crate::formats::rows::{DecimalCommas, second_record};
use crate::fortran::Layout;
use crate::header_keys::{
    Entry, Meaning, bare_rate, decimation, factors, gravity, is_of_another, is_rate_unit, keyed,
    lone_rate, meaning, unit_in_words, unit_words,
};
use crate::number::{self, Bare};
use crate::origin::Processing;
use crate::quantity::{Multiple, Quantity, SeriesUnit, named_with_unit, speaks_of_spectrum};
use crate::recording::Series;
use crate::row_widths::RowWidths;
use crate::source::Source;
use crate::stated_step::{StatedStep, frequency_not_used, state_step};
use crate::text::{Line, Lines};
use crate::time_column::mostly_times;
use crate::writers::peer_at2::{OTHER, RAW, UNSTATED};

/// Lines looked through for the header.
const HEADER_LINES: usize = 12;
/// Lines looked through for the start of the data after a free header.
const FREE_LINES: usize = 60;
const REMEDY: &str =
    "an AT2 header has a line such as `NPTS=  4000, DT= .01000 SEC` or `4000  0.0100  NPTS, DT`";

/// What the header says.
struct Header {
    line: usize,
    count: usize,
    steps: Vec<StatedStep>,
    text: Vec<String>,
}

impl Header {
    /// Whether this program wrote the file, which says so in its first line.
    fn is_own(&self) -> bool {
        let own = [RAW, UNSTATED, OTHER].map(Some);
        own.contains(&self.text.first().map(String::as_str))
    }
}

fn is_counts(line: &Line<'_>) -> bool {
    let lower = line.lower();
    lower.contains("npts") && lower.contains("dt")
}

/// `1559 points at equal spacing of 0.02 sec`.
fn is_spaced(line: &Line<'_>) -> bool {
    line.lower().contains("points at equal spacing of")
}

pub(super) static FORMAT: Format = Format {
    name: "peer_at2",
    title: "PEER AT2, VT2 and DT2 with all header forms",
    source: "Pacific Earthquake Engineering Research Center",
    recognised_by: "a line with NPTS and DT, or points at equal spacing of",
};

/// Whether a line is a comment, which this format has not: other programs write the same keys in them.
fn is_comment(line: &Line<'_>) -> bool {
    let start = line.bytes.trim_ascii_start();
    start.starts_with(b"#") || start.starts_with(b"%") || start.starts_with(b"//")
}

/// The line that states the count, and the one that states the step: mostly one line.
fn line_of_counts<'a>(source: &Source<'a>) -> Option<(Line<'a>, usize)> {
    let lines = || source.lines().take(HEADER_LINES).filter(|l| !is_comment(l));
    let in_one = lines().find(is_counts).map(|line| (line, line.number));
    in_one.or_else(|| {
        let states = |key: &'static str| {
            let number = |text: &str| text.starts_with(|c: char| c.is_ascii_digit() || c == '.');
            move |line: &Line<'_>| behind(&line.lower(), key).any(number)
        };
        let count = lines().find(states("npts"))?;
        let step = lines().find(states("dt"))?;
        Some((count, count.number.max(step.number)))
    })
}

/// Rows behind the header that show whether they are values alone.
const ROWS: usize = 30;

/// Whether values follow the line of the counts, alone: behind words that name columns, and in pairs of times
/// and values, rows are plain columns whose header has the keys of this format.
fn has_values_alone(source: &Source<'_>, (line, last): (Line<'_>, usize)) -> bool {
    // The keys of this format stand the other way round, or have signs of equality.
    let lower = line.lower();
    if lower.starts_with("dt ") && !lower.contains(['=', ':']) {
        return false;
    }
    let behind = source.lines().skip_while(|l| l.number <= last);
    let mut rows = behind
        .skip_while(|l| l.is_text() && is_key(l))
        .filter(|l| !l.is_blank())
        .take(ROWS)
        .peekable();
    let names = rows.peek().is_some_and(|l| {
        let first = l.fields().next().map_or(&b""[..], |(_, field)| field);
        let starts = |b: &u8| b.is_ascii_digit() || b"+-.*".contains(b);
        let is_end = l.lower().contains("end data");
        l.is_text() && !is_end && !first.first().is_some_and(starts) || is_comment(l)
    });
    let pairs: Option<Vec<f64>> = rows
        .map(|l| {
            let mut fields = l.fields().map(|(_, field)| number::parse(field).ok());
            let pair = [fields.next()??, fields.next()??];
            fields.next().is_none().then_some(pair)
        })
        .collect::<Option<Vec<_>>>()
        .map(|pairs| pairs.concat());
    !names && !pairs.is_some_and(|numbers| mostly_times(&numbers, 2))
}

pub(super) fn matches(source: &Source<'_>) -> bool {
    line_of_counts(source).is_some_and(|found| has_values_alone(source, found))
        || source.lines().take(FREE_LINES).any(|l| is_spaced(&l))
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let header = header(source, &mut lines)?;
    let unit = unit(source, &header)?;
    let first = lines.number() + 1;
    // A value takes two bytes at least.
    let mut samples = Vec::with_capacity((lines.remaining() / 2 + 1).min(header.count + 1));
    let mut last_row = 0;
    let mut commas = DecimalCommas::default();
    let mut forms = Forms::default();
    let mut widths = RowWidths::default();
    while let Some(line) = lines.next() {
        if line.is_text() {
            if line.lower().contains("end data") {
                break;
            }
            let behind = lines.clone().take(HEADER_LINES);
            if std::iter::once(line).chain(behind).any(|l| is_counts(&l)) {
                return Err(second_record(source, line));
            }
        } else if line.is_blank() {
            continue;
        }
        let before = samples.len();
        commas.see(line);
        for (column, field) in line.fields() {
            samples.push(value(source, line, (column, field), first - 1)?);
            forms.see(line.number, column, field);
        }
        last_row = samples.len() - before;
        widths.see(line.number, last_row);
    }
    commas.part_values(source, samples.len(), Some(header.count))?;
    match source.ends_whole()? {
        true => forms.are_whole(source)?,
        false => drop(samples.pop()),
    }
    are_no_pairs(source, &samples, (header.count, first))?;
    if let Some(width) = widths.are_all(header.count) {
        return Err(source.error(
            first,
            0,
            format!(
                "the header says {} samples, and there are as many rows, of {width} values each: {width} components beside one another",
                header.count
            ),
            &format!(
                "this format has one series along the rows: read them as `format = \"plain_columns\"`, `skip_lines = {}` and `layout` with a name for each column, such as \"ns,ew\" or \"ns,ew,ud\" (`-` passes one over), and choose one by `component`; give `time_step` and `unit` of the header (`--format plain_columns --skip-lines {0}` and so on with `pounding motion`)",
                first - 1
            ),
        ));
    }
    widths.are_even(source)?;
    let mut draft = Draft::new(samples, unit, (header.line, first, lines.number()));
    let rates = rates(&header);
    let steps: Vec<StatedStep> = header.steps.iter().copied().chain(rates).collect();
    state_step(&mut draft, source, &steps);
    draft.header_count = Some(header.count);
    draft.row = several(last_row);
    draft.processing = match header.text.first() {
        // Written by this program, which says so.
        Some(first) if first == RAW => Processing::Raw,
        Some(first) if first == UNSTATED => Processing::Unstated,
        _ => Processing::Corrected,
    };
    keys(&mut draft, source, &header);
    draft.component = component(&header);
    draft.quantities = quantities(&header.text);
    let all = header.text.join(" ");
    draft.peak = peak(&draft.unit, &all);
    draft.corners = (
        number::after(&all, "hp=").map(|n| n.0).filter(|f| *f > 0.0),
        number::after(&all, "lp=").map(|n| n.0).filter(|f| *f > 0.0),
    );
    let shown = header.text.len().saturating_sub(1).min(2);
    draft.title = header.text[..shown].join("; ");
    Ok(vec![draft.finish(source)?])
}

/// The steps of the rates that the header states beside its time step, `SAMPLING RATE= 200 HZ`.
fn rates(header: &Header) -> impl Iterator<Item = StatedStep> {
    let of_line = |(i, line): (usize, &String)| {
        let lower = line.to_ascii_lowercase();
        let rates: Vec<StatedStep> = keyed(&lower)
            .iter()
            .filter(|entry| meaning(entry) == Some(Meaning::Rate))
            .filter_map(|entry| {
                let (rate, _, unit) = entry.number()?;
                (rate > 0.0 && is_rate_unit(unit)).then_some(StatedStep {
                    line: i + 1,
                    step: 1.0 / rate,
                })
            })
            .collect();
        // `RATE: 200 HZ`.
        let lone = lone_rate(&lower).filter(|(_, is_rate)| *is_rate);
        let lone = lone.map(|(rate, _)| StatedStep {
            line: i + 1,
            step: 1.0 / rate,
        });
        // `NPTS= 400, DT= .01 SEC, RATE 200 HZ`, `(200 SPS)`.
        let is_of_counts = i + 1 == header.line && !is_of_stage(&lower);
        let of_part = |part: &str| {
            let lone = lone_rate(part).filter(|(_, is_rate)| *is_rate);
            let keyed = || {
                let [entry] = *keyed(part).as_slice() else {
                    return None;
                };
                let (rate, _, unit) = entry.number()?;
                let is_rate = meaning(&entry) == Some(Meaning::Rate);
                (is_rate && rate > 0.0 && is_rate_unit(unit)).then_some(rate)
            };
            let of_samples = || bare_rate(part).filter(|_| !part.contains("hz"));
            lone.map(|(rate, _)| rate)
                .or_else(keyed)
                .or_else(of_samples)
        };
        let mut in_parts: Vec<StatedStep> = Vec::new();
        if is_of_counts {
            in_parts.extend(parts(&lower).filter_map(of_part).map(|rate| StatedStep {
                line: i + 1,
                step: 1.0 / rate,
            }));
        }
        rates.into_iter().chain(lone).chain(in_parts)
    };
    header.text.iter().enumerate().flat_map(of_line)
}

/// Whether a line in lower case speaks of another stage, of which its parts do not tell: `resampled from (200 sps)`.
fn is_of_stage(lower: &str) -> bool {
    let words = [
        "from", "orig", "resampl", "decim", "convert", "raw", "uncor", "target", "before", "scal",
        "digiti", "instrum", "interpol", "sensor", "compon", "input", "source", "archive",
    ];
    is_of_another(lower) || words.iter().any(|word| lower.contains(word))
}

/// What stands between separators and in brackets of the line of the counts, in lower case.
fn parts(lower: &str) -> impl Iterator<Item = &str> {
    let parts = lower.split([',', ';', '|', '(', ')', '[', ']']);
    parts.map(str::trim).filter(|part| !part.is_empty())
}

/// The largest accelerations that the line of the counts states in lower case, with their unit: `PEAK= 0.5 G`, `PEAK
/// ACCELERATION= 0.5 G`. Those under `PGA=` are read elsewhere.
fn peaks(line: usize, lower: &str) -> Vec<DraftPeak> {
    let of_entry = |entry: &Entry<'_>| {
        let is_peak = meaning(entry) == Some(Meaning::Peak) || entry.is_of_peak();
        let (value, digits, unit) = entry.number().filter(|_| is_peak && entry.key != "pga")?;
        // A number behind another word, or one of a velocity, is of something else.
        let stated = SeriesUnit::parse(unit);
        let stated = stated.filter(|unit| unit.quantity == Quantity::Acceleration)?;
        Some(DraftPeak {
            value: (value, number::resolution(digits.as_bytes())),
            time: None,
            unit: Some(stated),
            shift: 0.0,
            line: Some(line),
            of_sign: false,
        })
    };
    keyed(lower).iter().filter_map(of_entry).collect()
}

/// States peaks, durations, factors and decimations of the header to a draft.
fn keys(draft: &mut Draft, source: &Source<'_>, header: &Header) {
    let of_other =
        matches!(draft.unit, DraftUnit::Stated(unit) if unit.quantity != Quantity::Acceleration);
    for (i, line) in header.text.iter().enumerate() {
        let lower = line.to_ascii_lowercase();
        // The title of a file that this program wrote is a name.
        let is_name = i == 1 && header.is_own();
        if i + 1 == header.line && !of_other && !is_of_stage(&lower) {
            draft.other_peaks.extend(peaks(i + 1, &lower));
        }
        for entry in keyed(&lower) {
            let Some((value, _, unit)) = entry.number() else {
                continue;
            };
            let lasts = meaning(&entry) == Some(Meaning::Duration);
            if lasts && value > 0.0 && ["", "s", "sec"].contains(&unit) {
                draft.other_durations.push(StatedDuration {
                    seconds: value,
                    line: Some(i + 1),
                });
            }
        }
        if is_name {
            continue;
        }
        let used = header.steps.first().map(|stated| stated.step);
        let used = source.options.time_step.or(used);
        if let (Some((rate, false)), Some(used)) = (lone_rate(&lower), used) {
            let told = frequency_not_used(i + 1, 1.0 / rate, used);
            draft.warnings.extend(told);
        }
        draft.gravities.extend(gravity(&lower).map(|g| (i + 1, g)));
        let told = factors(&lower).into_iter().map(|x| not_applied(i + 1, x));
        draft.warnings.extend(told);
        let of = decimation(&lower).filter(|_| source.options.time_step.is_none());
        draft.warnings.extend(of.map(|of| decimated(i + 1, of)));
    }
}

/// A value; numbers that touch can be read as plain columns alone.
fn value(
    source: &Source<'_>,
    line: Line<'_>,
    (column, field): (usize, &[u8]),
    header: usize,
) -> Result<f64, GroundMotionError> {
    if !number::touching(field) {
        return source.number(line, column, field);
    }
    number::parse(field).map_err(|message| {
        let remedy = format!(
            "put a blank between the numbers; or read the rows as plain columns by their Fortran format: `format = \"plain_columns\"`, `skip_lines = {header}`, `layout = \"8F9.5\"` for eight numbers of nine characters a row, `time_step` and `unit` of the header (`--format plain_columns --skip-lines {header}` and so on with `pounding motion`)"
        );
        source.error(line.number, column, message, &remedy)
    })
}

/// Refuses times among the values: this format has none.
fn are_no_pairs(
    source: &Source<'_>,
    samples: &[f64],
    (count, first): (usize, usize),
) -> Result<(), GroundMotionError> {
    if samples.len() < 2 * count || !mostly_times(samples, 2) {
        return Ok(());
    }
    Err(source.error(
        first,
        0,
        format!("the header says {count} samples, and every other number is a time"),
        "this format has no times: take the header off and read the rows as `format = \"plain_columns\"`, `layout = \"t,a\"`",
    ))
}

/// Reads the header; `lines` are at the data afterwards.
fn header(source: &Source<'_>, lines: &mut Lines<'_>) -> Result<Header, GroundMotionError> {
    let position = line_of_counts(source);
    let spaced = source.lines().take(FREE_LINES).find(is_spaced);
    let Some(line) = position.map(|(line, _)| line).or(spaced) else {
        return Err(source.error(1, 0, "no line with NPTS and DT", REMEDY));
    };
    let begins = source
        .lines()
        .take(FREE_LINES)
        .find(|l| l.lower().contains("begin data"))
        .filter(|_| spaced.is_some());
    let counts = position.map_or(line.number, |(_, last)| last);
    let last = begins.map_or(counts, |l| l.number.max(counts));
    let mut text = Vec::new();
    while lines.number() < last
        && let Some(l) = lines.next()
    {
        let line = l.text();
        // Other programs take such lines for comments.
        let bare = match position {
            None => line.trim().trim_start_matches('#'),
            Some(_) => &line,
        };
        text.push(bare.trim().to_owned());
    }
    // `Units: gal` may follow.
    while let Some(l) = lines.peek().filter(|l| l.is_text() && is_key(l)) {
        lines.next();
        text.push(l.text().trim().to_owned());
    }
    let mut counts = Vec::new();
    let mut steps = Vec::new();
    // The title of a file that this program wrote is a name, whatever keys stand in it.
    let own = source.first_line();
    let is_own = [RAW, UNSTATED, OTHER]
        .iter()
        .any(|first| own == first.to_ascii_lowercase());
    let others = source
        .lines()
        .take_while(|l| l.number <= last)
        .filter(|l| !is_own || l.number != 2);
    // The line of the count goes before the others.
    for stated in std::iter::once(line).chain(others.filter(|l| l.number != line.number)) {
        let (more, times) = statements(source, stated)?;
        counts.extend(more.into_iter().map(|count| (stated.number, count)));
        steps.extend(times.into_iter().map(|step| StatedStep {
            line: stated.number,
            step,
        }));
    }
    let Some((first, count)) = counts.first().copied().filter(|c| c.0 == line.number) else {
        return Err(source.error(
            line.number,
            0,
            format!("no count of samples in \"{}\"", number::shown(line.bytes)),
            REMEDY,
        ));
    };
    if let Some((at, other)) = counts.iter().find(|(_, other)| *other != count) {
        source.contradiction(
            first,
            format!("the header says {count} samples here, but {other} in line {at}"),
        )?;
    }
    Ok(Header {
        line: line.number,
        count,
        steps,
        text,
    })
}

/// Whether a line is a key with its value, none of which is a number of the series.
fn is_key(line: &Line<'_>) -> bool {
    let text = line.text();
    let key = text.split_once([':', '=']).map(|(key, _)| key.trim());
    key.is_some_and(|key| {
        !key.is_empty() && key.chars().all(|c| c.is_ascii_alphabetic() || c == ' ')
    })
}

/// Components of which no direction is known: numbered, along and across an instrument, parallel
/// and normal to a fault.
const NO_DIRECTION: [&str; 13] = [
    "H1", "H2", "H3", "L", "T", "LG", "LN", "TR", "LONG", "TRAN", "TRANS", "FN", "FP",
];

/// The component that ends the second line, `EVENT, STATION, 180`: what stands in brackets behind
/// it is not of its name. Of files that this program wrote it is all that stands there.
fn component(header: &Header) -> String {
    // The line of the count has commas of its own.
    let second = header.text.get(1).filter(|_| header.line != 2);
    // A comma may end the line, but for a component without a name that this program wrote.
    let second = second.map(|line| match header.is_own() {
        true => line.as_str(),
        false => line.trim_end_matches([',', ';', ' ', '\t']),
    });
    let Some((_, field)) = second.and_then(|line| line.rsplit_once(',')) else {
        return String::new();
    };
    if header.is_own() {
        return field.trim().to_owned();
    }
    let name = field.split('(').next().unwrap_or(field).trim();
    let lower = name.to_ascii_lowercase();
    let word = ["component", "comp.", "comp"]
        .into_iter()
        .find(|word| lower.starts_with(word));
    let name = word.map_or(name, |word| name[word.len()..].trim());
    let is_name = Direction::parse(name).is_some()
        || Direction::of_name(name).is_some()
        || NO_DIRECTION.iter().any(|n| n.eq_ignore_ascii_case(name));
    if is_name {
        name.to_owned()
    } else {
        String::new()
    }
}

/// The quantities of the lines on the unit and on the kind of series, such as `VELOCITY TIME
/// HISTORY IN UNITS OF CM/S` and `VELOCITY (CM/S)`.
fn quantities(text: &[String]) -> Vec<NamedQuantity> {
    let named = |(i, line): (usize, &String)| {
        let lower = line.to_ascii_lowercase();
        let says = ["units", "time history", "time series"];
        let says = says.iter().any(|words| lower.contains(words));
        let with_unit = || named_with_unit(&lower);
        let says = says || ["velocity", "displacement"].contains(&lower.trim());
        (says || with_unit().is_some()).then(|| NamedQuantity::of(i + 1, line))?
    };
    text.iter().enumerate().filter_map(named).collect()
}

/// What stands behind each `KEY =` or `KEY:` of a line in lower case, but for those of the record before it was
/// processed, `ORIGINAL DT=`.
fn behind<'t>(lower: &'t str, key: &'t str) -> impl Iterator<Item = &'t str> {
    lower.match_indices(key).filter_map(move |(at, _)| {
        let before = &lower[..at];
        let is_word = !before.ends_with(|c: char| c.is_ascii_alphanumeric());
        let word = before.split_whitespace().next_back();
        let is_own = !word.is_some_and(is_of_another);
        let rest = lower[at + key.len()..].trim_start();
        let rest = rest.strip_prefix(['=', ':'])?;
        (is_word && is_own).then(|| rest.trim_start())
    })
}

/// A count that a text starts with; `Err`: digits in groups.
fn count_in(text: &str) -> Result<Option<usize>, String> {
    let digits =
        |text: &str| text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let (number, rest) = text.split_at(digits(text));
    let grouped = rest
        .strip_prefix(',')
        .is_some_and(|group| digits(group) > 0);
    if grouped && !number.is_empty() {
        let shown: String = text
            .chars()
            .take_while(|c| c.is_ascii_digit() || *c == ',')
            .collect();
        let shown = shown.trim_end_matches(',');
        return Err(format!(
            "the count \"{shown}\" has a comma within its digits"
        ));
    }
    let ends = rest.is_empty() || rest.starts_with([' ', '\t', ',', ';']);
    Ok(number.parse().ok().filter(|_| ends))
}

/// Whether a line in lower case names both before their numbers: `NPTS, DT= 2000, 0.0100`.
fn names_both_before(lower: &str) -> bool {
    let mut behind = lower.split("npts").skip(1);
    behind.any(|rest| {
        let names = rest.split(['=', ':']).next().unwrap_or(rest);
        let names = names.trim_matches([' ', ',', ';', '/', '\t']);
        names == "dt"
    })
}

/// Counts of samples and time steps (s) of a line.
fn statements(
    source: &Source<'_>,
    line: Line<'_>,
) -> Result<(Vec<usize>, Vec<f64>), GroundMotionError> {
    let lower = line.lower();
    let mut steps = Vec::new();
    let mut counts = Vec::new();
    if !names_both_before(&lower) {
        for text in behind(&lower, "dt") {
            steps.extend(source.step_or_rate(line, text, Bare::Step)?);
        }
        for text in behind(&lower, "npts") {
            let count = count_in(text);
            counts.extend(count.map_err(|message| source.error(line.number, 0, message, REMEDY))?);
        }
    }
    if counts.is_empty() && (is_counts(&line) || is_spaced(&line)) {
        // `#1559 points at equal spacing of 0.02 sec`.
        let bare = |field: &'_ [u8]| number::parse(field.strip_prefix(b"#").unwrap_or(field)).ok();
        let mut numbers = line.fields().filter_map(|(_, field)| bare(field));
        let count = numbers
            .next()
            .filter(|n| n.fract() == 0.0 && (0.0..1.0e9).contains(n));
        counts.extend(count.map(|n| n as usize));
        steps.extend(numbers.next().filter(|_| steps.is_empty()));
    }
    Ok((counts, steps))
}

/// Words of the line that says what the values are.
const OF_VALUES: [&str; 2] = ["time series", "time history"];

/// A unit and what stands behind it on its line.
type UnitAndRest<'t> = (SeriesUnit, &'t str);

/// What stands where a text in lower case states a unit: `in units of g`, `the units are (g)`,
/// `units of cm / sec / sec`, `unit: g`, `units g`.
fn behind_units(lower: &str) -> impl Iterator<Item = &str> {
    lower.split("unit").skip(1).filter_map(|after| {
        let after = after.strip_prefix('s').unwrap_or(after);
        let bare = after.trim_start();
        let word = bare
            .strip_prefix("of")
            .or_else(|| bare.strip_prefix("are"))
            .or_else(|| bare.strip_prefix([':', '=']))
            .or_else(|| after.starts_with([' ', '\t']).then_some(bare))?;
        let word = word.trim_start_matches([' ', '(', ':', '=', '\n']);
        word.split('\n').next()
    })
}

/// What may end a unit, in which blanks may stand.
const UNIT_ENDS: [char; 5] = [',', ')', ';', '\t', '|'];

/// The unit that a text in lower case states.
fn unit_in(lower: &str) -> Option<UnitAndRest<'_>> {
    behind_units(lower).find_map(|word| {
        let whole = &word[..word.find(UNIT_ENDS).unwrap_or(word.len())];
        let first = whole.split(' ').next().unwrap_or(whole);
        let parts = [whole, first].map(|unit| unit.trim_end_matches('.'));
        let found = |of: fn(&str) -> Option<SeriesUnit>| {
            let mut parts = parts.into_iter();
            parts.find_map(|unit| Some((of(unit)?, &word[unit.len()..])))
        };
        found(SeriesUnit::parse).or_else(|| found(|unit| Multiple::parse(unit)?.unit))
    })
}

/// A unit with a factor that a line in lower case states, and of which it is not known what the values are
/// multiplied by: `in units of g*1000`, `units of 1000 g`.
fn factor_of_unit(lower: &str) -> Option<&str> {
    behind_units(lower).find_map(|word| {
        let unit = &word[..word.find(UNIT_ENDS).unwrap_or(word.len())];
        let multiple = Multiple::parse(unit)?;
        multiple.unit.is_none().then_some(unit)
    })
}

/// First words in brackets behind a unit that a number of something else follows: `G (PGA 0.3)`.
const KEYS_BEHIND_UNIT: [&str; 7] = ["dt", "frequency", "npts", "pga", "rate", "sampling", "sps"];
/// First words that speak of something else where they follow a unit.
const BEHIND_UNIT: [&str; 21] = [
    "acceleration",
    "and",
    "at",
    "baseline",
    "corrected",
    "data",
    "filter",
    "filtered",
    "for",
    "format",
    "from",
    "in",
    "instrument",
    "number",
    "points",
    "processed",
    "recorded",
    "rotated",
    "sampled",
    "uncorrected",
    "with",
];

/// What a number behind a unit may count.
const COUNTED: [&str; 5] = ["data", "points", "pts", "samples", "values"];

/// Words that begin a factor or another unit.
const OF_UNIT: [&str; 9] = [
    "divided",
    "e",
    "factor",
    "multiplied",
    "or",
    "per",
    "scaled",
    "times",
    "x",
];

/// Whether what stands behind a unit on its line says nothing of the unit: nothing, a key such as
/// `PGA=`, a Fortran format, the unit once more in brackets, or words of something else.
fn is_of_something_else(unit: SeriesUnit, rest: &str) -> bool {
    let blanks = [' ', '\t', ')', '-'];
    let direct = rest.trim_start_matches(blanks);
    let text = direct.trim_start_matches(['.', ',', ';', ':', '|', ' ', '\t']);
    if text.is_empty() {
        return true;
    }
    if let Some(inside) = text.strip_prefix('(') {
        let (inside, behind) = inside.split_once(')').unwrap_or((inside, ""));
        let in_words = inside.split([' ', ',']).all(|w| !OF_UNIT.contains(&w))
            && inside
                .chars()
                .all(|c| c.is_ascii_alphabetic() || " ,-".contains(c));
        let word = inside.split(|c: char| !c.is_ascii_alphabetic()).next();
        let is_key = word.is_some_and(|word| KEYS_BEHIND_UNIT.contains(&word));
        let known = match SeriesUnit::parse(inside) {
            Some(other) => other == unit,
            // `G (G = 9.81 M/S2)`.
            None => {
                let is_gravity =
                    || unit.symbol == "g" && gravity(&format!("g ({inside})")).is_some();
                in_words || is_key || Layout::find(text).is_some() || is_gravity()
            }
        };
        return known && is_of_something_else(unit, behind);
    }
    let first_word = |text: &str| -> usize {
        let end = text.find(|c: char| !c.is_ascii_alphabetic());
        end.unwrap_or(text.len())
    };
    // `4000 points`.
    let number = text.trim_start_matches(|c: char| c.is_ascii_digit());
    let counted = number.trim_start();
    if number.len() < text.len() {
        return COUNTED.contains(&&counted[..first_word(counted)]);
    }
    let (word, behind) = text.split_at(first_word(text));
    // A sentence of its own.
    let apart = direct.len() > text.len();
    match word {
        "" => false,
        _ if behind.trim_start().starts_with('=') || BEHIND_UNIT.contains(&word) => true,
        word => apart && !OF_UNIT.contains(&word) && SeriesUnit::parse(word).is_none(),
    }
}

/// Whether what stands behind a unit begins with a factor or another unit.
fn may_change_unit(rest: &str) -> bool {
    let rest = rest.trim_start();
    let mut words = rest.split(|c: char| !c.is_ascii_alphabetic());
    rest.starts_with(['*', '/', '^']) || words.next().is_some_and(|w| OF_UNIT.contains(&w))
}

/// Whether a line in lower case on the unit of the values says that they are a spectrum. Records
/// may be matched to one.
fn is_of_spectrum(lower: &str) -> bool {
    lower.contains("units")
        && speaks_of_spectrum(lower)
        && !OF_VALUES.iter().any(|w| lower.contains(w))
}

/// What to do about a factor beside a unit.
const FACTOR_REMEDY: &str = "write the unit of the values alone, `ACCELERATION TIME SERIES IN UNITS OF G`, and scale the record by `scale` if it has a factor";

/// Unit from the header's text: that of the line that names the quantity of the values, such as
/// `ACCELERATION TIME SERIES IN UNITS OF G`, before those of others.
fn unit(source: &Source<'_>, header: &Header) -> Result<DraftUnit, GroundMotionError> {
    let lower: Vec<String> = header.text.iter().map(|l| l.to_ascii_lowercase()).collect();
    if let Some(line) = lower.iter().position(|l| is_of_spectrum(l)) {
        return Err(source.error(
            line + 1,
            0,
            format!(
                "the header says that the values are those of a spectrum: \"{}\"",
                number::shown(header.text[line].as_bytes())
            ),
            "give the acceleration over the time (AT2) of the same record",
        ));
    }
    let all = lower.join(" ");
    let lines = lower.join("\n");
    let stated = |of_values: bool| -> Vec<(usize, UnitAndRest<'_>)> {
        let lines = lower.iter().enumerate();
        lines
            .filter(|(_, l)| !of_values || OF_VALUES.iter().any(|words| l.contains(words)))
            .filter_map(|(i, l)| Some((i + 1, unit_in(l)?)))
            .collect()
    };
    let mut units = stated(true);
    if units.is_empty() {
        units = stated(false);
    }
    if units.is_empty() {
        // Words may go on in the next line.
        units.extend(unit_in(&lines).map(|unit| (header.line, unit)));
    }
    if units.is_empty() {
        // `ACCELERATION TIME SERIES (G)`, `ACCELERATION TIME HISTORY IN G`.
        let behind = lower.iter().enumerate().filter_map(|(i, line)| {
            let rest = OF_VALUES.iter().find_map(|words| line.split_once(words))?.1;
            let rest = rest.trim_start().trim_start_matches(',').trim_start();
            let rest = rest
                .strip_prefix('(')
                .or_else(|| rest.strip_prefix("in "))?;
            let word = rest.trim_start();
            let whole = &word[..word.find(UNIT_ENDS).unwrap_or(word.len())];
            let first = whole.split(' ').next().unwrap_or(whole);
            let multiple = || {
                let multiple = Multiple::parse(whole).filter(|m| !m.may_be_level)?;
                Some((multiple.unit?, &word[whole.len()..]))
            };
            let unit = SeriesUnit::parse(first.trim_end_matches('.'))
                .map(|unit| (unit, &word[first.len()..]));
            Some((i + 1, unit.or_else(multiple)?))
        });
        units.extend(behind);
    }
    if units.is_empty() {
        // `VALUES IN CM/S2`.
        let in_words = lower
            .iter()
            .enumerate()
            .filter_map(|(i, line)| Some((i + 1, (SeriesUnit::parse(unit_in_words(line)?)?, ""))));
        units.extend(in_words);
    }
    if units.is_empty() {
        // `ACCELERATION (GAL)`. What follows such a unit may be of a title, unless it changes it.
        let beside = lower.iter().enumerate().filter_map(|(i, line)| {
            let named = named_with_unit(line)?;
            Some((i + 1, (named.unit, named.rest)))
        });
        units.extend(beside.filter(|(_, (unit, rest))| {
            is_of_something_else(*unit, rest) || may_change_unit(rest)
        }));
    }
    if let Some((line, (unit, rest))) = units
        .iter()
        .find(|(_, (unit, rest))| !is_of_something_else(*unit, rest))
    {
        return Err(source.error(
            *line,
            0,
            format!(
                "\"{}\" behind the unit {} is not understood",
                number::shown(rest.trim().to_ascii_uppercase().as_bytes()),
                unit.symbol
            ),
            &format!("what follows the unit may change it: {FACTOR_REMEDY}"),
        ));
    }
    if let [(first, (unit, _)), rest @ ..] = units.as_slice()
        && let Some((line, (other, _))) = rest.iter().find(|(_, (other, _))| other != unit)
    {
        return Err(source.error(
            *line,
            0,
            format!(
                "the unit is {} here, but {} in line {first}",
                other.symbol, unit.symbol
            ),
            "header lines contradict one another: a line such as `ACCELERATION TIME SERIES IN UNITS OF G` must say the unit of the values",
        ));
    }
    // `ACCELERATION (G) TIME SERIES (CM/S2)`.
    let twice = units.iter().find_map(|(line, (unit, _))| {
        let text = lower.get(line - 1)?;
        let is_of_values = OF_VALUES.iter().any(|words| text.contains(words));
        let beside = named_with_unit(text).filter(|_| is_of_values)?.unit;
        let differs = beside != *unit && beside.quantity == unit.quantity;
        differs.then_some((*line, [beside, *unit]))
    });
    if let Some((line, both)) = twice {
        let given = source.options.unit;
        if given.is_some_and(|given| both.iter().any(|unit| unit.is(given))) {
            return Ok(DraftUnit::Unstated);
        }
        return Err(source.error(
            line,
            0,
            format!(
                "two units, {} and {}, stand beside one quantity",
                both[0].symbol, both[1].symbol
            ),
            "say which one the values have by `unit` in [ground_motion] of a case, `--unit` with `pounding motion`; or correct the line so that it states that unit alone",
        ));
    }
    let scaled = lower.iter().enumerate().find_map(|(i, line)| {
        let is_title = i == 1 && header.is_own();
        Some((i + 1, factor_of_unit(line).filter(|_| !is_title)?))
    });
    if let Some((line, unit)) = scaled {
        return Err(source.error(
            line,
            0,
            format!(
                "the unit \"{}\" that is stated here is not known",
                number::shown(unit.to_ascii_uppercase().as_bytes())
            ),
            FACTOR_REMEDY,
        ));
    }
    if let Some((first, (unit, _))) = units.first() {
        // `Units: cm/s2` or `Values in cm/s2` below `IN UNITS OF G`.
        let keys = lower.iter().enumerate().filter_map(|(i, line)| {
            let entry = || keyed(line).into_iter().find(|entry| unit_words(entry.key));
            let stated = unit_in_words(line).or_else(|| Some(entry()?.value))?;
            let multiple = || Multiple::parse(stated)?.unit;
            Some((i + 1, SeriesUnit::parse(stated).or_else(multiple)?))
        });
        // `NPTS= 400, DT= .01 SEC, CM/S2` and `UNIT CM/S2`.
        let of_counts = lower
            .get(header.line - 1)
            .filter(|line| !is_of_stage(line))
            .into_iter()
            .flat_map(|line| parts(line));
        let in_parts = of_counts.filter_map(|part| {
            let word = ["units", "unit"]
                .iter()
                .find_map(|word| part.strip_prefix(word));
            let unit = SeriesUnit::parse(word.unwrap_or(part).trim_start_matches(" of "))?;
            let accelerates = unit.quantity == Quantity::Acceleration;
            accelerates.then_some((header.line, unit))
        });
        let keys = keys.chain(in_parts);
        if let Some((line, other)) = keys.into_iter().find(|(_, other)| other != unit) {
            return Err(source.error(
                line,
                0,
                format!(
                    "the unit is {} here, but {} in line {first}",
                    other.symbol, unit.symbol
                ),
                "the header contradicts itself: correct it, or get the record again",
            ));
        }
        return Ok(DraftUnit::Stated(*unit));
    }
    let words = |q: Quantity| all.contains(&format!("{} time", q.name()));
    for quantity in [Quantity::Velocity, Quantity::Displacement] {
        if words(quantity) && !words(Quantity::Acceleration) {
            return Err(GroundMotionError::NotAcceleration {
                file: source.file.to_owned(),
                quantity: quantity.name(),
            });
        }
    }
    Ok(DraftUnit::Unstated)
}

/// `PGA=`, `PGV=` or `PGD=` of newer headers, in the unit of the samples.
fn peak(unit: &DraftUnit, text: &str) -> Option<DraftPeak> {
    let DraftUnit::Stated(unit) = unit else {
        return None;
    };
    let key = match unit.quantity {
        Quantity::Acceleration => "pga=",
        Quantity::Velocity => "pgv=",
        Quantity::Displacement => "pgd=",
    };
    Some(DraftPeak {
        value: number::stated(text, key)?,
        time: None,
        unit: None,
        shift: 0.0,
        line: None,
        of_sign: false,
    })
}
