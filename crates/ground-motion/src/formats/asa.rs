//! Archivo Estandar de Aceleracion 2.0 (UNAM, CICESE, CENAPRED): Spanish key lines,
//! then a column for each channel, gal.

use crate::cut_numbers::Forms;
use crate::direction::Direction;
use crate::draft::{Draft, DraftPeak, DraftUnit, StatedDuration};
use crate::error::{GroundMotionError, bound};
use crate::format::Format;
use crate::fortran::Layout;
use crate::number;
use crate::origin::Processing;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::source::Source;
use crate::text::{Line, Lines};
use crate::time_column::Times;

const REMEDY: &str = "the header is not that of ASA 2.0: get the record again";
/// Lines that a header may have; 109 in every file seen.
const HEADER_LINES: usize = 400;

/// Channels that the format has room for.
const MOST_CHANNELS: usize = 12;
/// Widths of a column that can be: the format's own is ten.
const WIDTH: std::ops::RangeInclusive<usize> = 3..=20;

/// An entry for each of the twelve channels, where the header has one, with the line.
#[derive(Default, Clone)]
struct Entries([Option<(String, usize)>; MOST_CHANNELS]);

impl Entries {
    /// Takes the list of a line such as `/0.005/0.005/0.005` for channels from `first` on. The
    /// lines of channels that a record does not have are blank.
    fn take(&mut self, line: usize, first: usize, value: &str) {
        let value = value.strip_prefix('/').unwrap_or(value);
        let free = self.0.iter_mut().skip(first);
        for (entry, text) in free.zip(value.split('/')) {
            // `V;+`: direction and sense.
            let text = text.split(';').next().unwrap_or_default().trim();
            if !text.is_empty() {
                *entry = Some((text.to_owned(), line));
            }
        }
    }

    /// The number of channel `k`, with one unit of its last digit and its line; a single one
    /// stands for all.
    fn number(&self, k: usize) -> Option<((f64, f64), usize)> {
        let alone = || {
            let mut all = self.0.iter().flatten();
            let first = all.next()?;
            all.next().is_none().then_some(first)
        };
        let own = self.0.get(k).and_then(Option::as_ref);
        let (text, line) = own.or_else(alone)?;
        Some((number::first_in(text)?, *line))
    }

    /// The line of the first entry.
    fn line(&self) -> Option<usize> {
        self.0.iter().flatten().map(|(_, line)| *line).next()
    }

    /// Names in the order of the channels.
    fn texts(&self) -> Vec<&str> {
        self.0
            .iter()
            .flatten()
            .map(|(text, _)| text.as_str())
            .collect()
    }
}

/// What the header says.
#[derive(Default)]
struct Header {
    steps: Entries,
    rates: Entries,
    durations: Entries,
    counts: Entries,
    peaks: Entries,
    /// Unit of the peaks, in brackets in the key.
    peak_unit: Option<SeriesUnit>,
    /// Samples (from 1) that have the peaks.
    peak_places: Entries,
    names: Entries,
    /// Line and text of an orientation whose sense is minus.
    reversed: Option<(usize, String)>,
    /// The columns' numbers and names just before the rows, with their line.
    column_numbers: Option<(Vec<String>, usize)>,
    column_names: Option<(Vec<String>, usize)>,
    channels: Option<usize>,
    unit: Option<SeriesUnit>,
    /// Line and text of a unit that is none of acceleration.
    strange_unit: Option<(usize, String)>,
    layout: Option<Layout>,
    decimation: Option<f64>,
    station: String,
    start: String,
    incomplete: bool,
}

pub(super) static FORMAT: Format = Format {
    name: "asa",
    title: "Archivo Estandar de Aceleracion 2.0",
    source: "UNAM, CICESE and CENAPRED, Mexico",
    recognised_by: "archivo estandar de aceleracion within fifteen lines",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    source
        .head()
        .take(15)
        .any(|l| plain(l).contains("ARCHIVO ESTANDAR DE ACELERACION"))
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let header = header(source, &mut lines)?;
    let end = lines.number();
    let Some(layout) = header.layout else {
        return Err(source.error(end, 0, "no line FORMATO DATOS such as 3F10.4", REMEDY));
    };
    if let Some((line, text)) = &header.strange_unit {
        return Err(source.error(
            *line,
            0,
            format!("\"{text}\" is not a unit of acceleration"),
            "the lines UNIDADES DE LOS DATOS and ACEL. MAX. must name one, such as gal, or be blank: get the record again",
        ));
    }
    if let Some((line, name)) = &header.reversed {
        return Err(source.error(
            *line,
            0,
            format!("the sense of \"{name}\" is minus: in which direction its positive values point is not known"),
            "ask the agency whether the values must change their signs; change them if so, and write `;+`",
        ));
    }
    let names = header.names.texts();
    header.agrees_with_columns(source, &names)?;
    if layout.per_line > MOST_CHANNELS || !WIDTH.contains(&layout.width) {
        return Err(source.error(
            end,
            0,
            format!("{} columns of {} characters", layout.per_line, layout.width),
            REMEDY,
        ));
    }
    if layout.per_line > names.len() {
        return Err(source.error(
            end,
            0,
            format!(
                "{} columns of data, {} orientations",
                layout.per_line,
                names.len()
            ),
            REMEDY,
        ));
    }
    for (what, count) in [
        ("channels", header.channels),
        ("orientations", Some(names.len())),
    ] {
        if let Some(count) = count.filter(|n| *n != layout.per_line) {
            source.warn(&format!(
                "the header says {count} {what}, the data have {} columns",
                layout.per_line
            ));
        }
    }
    let columns = columns(source, &mut lines, layout, &header)?;
    let mut series = Vec::new();
    for (k, samples) in columns.into_iter().enumerate() {
        let unit = header.unit.map_or(DraftUnit::Unstated, DraftUnit::Stated);
        let mut draft = Draft::new(samples, unit, (end, end + 1, lines.number()));
        header.fill(k, names[k], &mut draft, source);
        series.push(draft.finish(source)?);
    }
    Ok(series)
}

/// The columns, which may end before one another: a blank field is the end of its channel.
fn columns(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    layout: Layout,
    header: &Header,
) -> Result<Vec<Vec<f64>>, GroundMotionError> {
    let room = lines.remaining() / (layout.width * layout.per_line) + 1;
    let mut columns: Vec<Vec<f64>> = (0..layout.per_line)
        .map(|k| {
            let stated = header.counts.number(k).map_or(0.0, |n| n.0.0);
            Vec::with_capacity(room.min(stated.max(0.0) as usize))
        })
        .collect();
    let mut forms: Vec<Forms> = columns.iter().map(|_| Forms::of(layout)).collect();
    let mut row = Vec::with_capacity(layout.per_line);
    let mut rows = 0_usize;
    for line in lines.by_ref().filter(|l| !l.is_blank()) {
        let has_blanks = line
            .bytes
            .chunks(layout.width)
            .any(|f| f.trim_ascii().is_empty());
        let short = line.bytes.len() <= layout.width * (layout.per_line - 1);
        if !(has_blanks || short) || line.bytes.contains(&b'\t') {
            row.clear();
            source.row(line, layout, &mut row)?;
            if row.len() != layout.per_line {
                return Err(source.error(
                    line.number,
                    line.bytes.len(),
                    format!(
                        "{} numbers where there must be {}",
                        row.len(),
                        layout.per_line
                    ),
                    "the file is damaged or truncated: get it again",
                ));
            }
        }
        for (k, column) in columns.iter_mut().enumerate() {
            let at = k * layout.width;
            let end = (at + layout.width).min(line.bytes.len());
            let field = line.bytes.get(at..end).unwrap_or(&[]);
            let value = match row.get(k) {
                Some(value) => *value,
                None if field.trim_ascii().is_empty() => continue,
                None if field.len() < layout.width => {
                    return Err(source.error(
                        line.number,
                        at,
                        format!(
                            "\"{}\" is cut off: a number takes {} columns",
                            number::shown(field),
                            layout.width
                        ),
                        "the file is damaged or truncated: get it again",
                    ));
                }
                None => source.field(line, at, field, layout)?,
            };
            if column.len() < rows {
                return Err(source.error(
                    line.number,
                    at,
                    format!("channel {} goes on after it ended in a blank field", k + 1),
                    "the file is damaged: get it again, no sample may be missing",
                ));
            }
            column.push(value);
            // Rows with tabs have no columns of characters.
            if !line.bytes.contains(&b'\t') {
                forms[k].see(line.number, at, field);
            }
        }
        if line.bytes.contains(&b'\t') {
            for ((at, field), forms) in line.fields().zip(&mut forms) {
                forms.see(line.number, at, field);
            }
        }
        row.clear();
        rows += 1;
    }
    forms.iter().try_for_each(|forms| forms.are_whole(source))?;
    Ok(columns)
}

impl Header {
    fn fill(&self, k: usize, name: &str, draft: &mut Draft, source: &Source<'_>) {
        name.clone_into(&mut draft.component);
        draft.channel = k + 1;
        let count = self
            .counts
            .number(k)
            .filter(|((n, _), _)| n.fract() == 0.0 && (1.0..1.0e9).contains(n));
        let stated = count.map(|((n, _), _)| n as usize);
        let (step, count) = self.decimated(k, stated, draft.samples.len());
        draft.header_count = count;
        draft.times = Times::Step(step);
        let rate = self.rates.number(k).filter(|((rate, _), _)| *rate > 0.0);
        if let (Some(((interval, _), line)), Some(((rate, digit), other))) =
            (self.steps.number(k), rate)
            && (interval * rate - 1.0).abs() > 0.01 + digit / rate
        {
            let message = format!(
                "channel {} has a step of {} s here, but {} samples/s ({} s) in line {other}",
                k + 1,
                bound(interval),
                bound(rate),
                bound(1.0 / rate)
            );
            let near = |given: f64, step: f64| (given - step).abs() <= 1.0e-6 * step;
            match source.options.time_step {
                Some(given) if near(given, interval) || near(given, 1.0 / rate) => {
                    draft.times = Times::Step(Some(given));
                    draft
                        .warnings
                        .push(format!("line {line}: {message}; {given} s was given"));
                }
                _ => {
                    let remedy = "the header contradicts itself: get the record again, or say which step is right, `time_step = \"0.01 s\"` in [ground_motion] of a case, `--time-step \"0.01 s\"` with `pounding motion`";
                    draft.step_conflict = Some((line, message, remedy.to_owned()));
                }
            }
        }
        let duration = self.durations.number(k).filter(|((d, _), _)| *d > 0.0);
        draft.header_durations = duration
            .map(|((seconds, _), line)| StatedDuration {
                seconds,
                line: Some(line),
            })
            .into_iter()
            .collect();
        let place = self.peak_places.number(k).map(|((place, _), _)| place);
        let time = place
            .zip(step)
            .map(|(place, step)| ((place - 1.0) * step, 0.0));
        draft.peak = self.peaks.number(k).map(|(value, line)| DraftPeak {
            value,
            time: time.filter(|(time, _)| *time >= 0.0),
            unit: self.peak_unit,
            shift: 0.0,
            line: Some(line),
            of_sign: false,
        });
        draft.processing = Processing::Raw;
        draft.title.clone_from(&self.station);
        draft.start_time.clone_from(&self.start);
        if self.incomplete {
            draft
                .warnings
                .push("the agency says that the record is not complete".to_owned());
        }
    }

    /// Step and count of channel `k`, of whose samples every n-th may be left: interval and
    /// count are then those of the recorder, or of what is left.
    fn decimated(
        &self,
        k: usize,
        count: Option<usize>,
        found: usize,
    ) -> (Option<f64>, Option<usize>) {
        let step = self.steps.number(k).map(|((step, _), _)| step);
        let rate = || self.rates.number(k).map(|((rate, _), _)| rate);
        let step = step.or_else(|| rate().filter(|rate| *rate > 0.0).map(|rate| 1.0 / rate));
        let factor = self.decimation.unwrap_or(1.0);
        let left = count.map(|n| n as f64 / factor);
        match left {
            Some(left) if factor > 1.0 && (left - found as f64).abs() <= 1.0 => {
                (step.map(|s| s * factor), Some(found))
            }
            _ => (step, count),
        }
    }
}

/// A line in capitals without accents: some files have them.
fn plain(line: Line<'_>) -> String {
    let text = line.text();
    let bare = |c: char| match c {
        'Á' => 'A',
        'É' => 'E',
        'Í' => 'I',
        'Ó' => 'O',
        'Ú' | 'Ü' => 'U',
        'Ñ' => 'N',
        other => other,
    };
    text.chars()
        .flat_map(char::to_uppercase)
        .map(bare)
        .collect()
}

/// Reads the header; `lines` are at the first row afterwards.
fn header<'a>(source: &Source<'a>, lines: &mut Lines<'a>) -> Result<Header, GroundMotionError> {
    let mut header = Header::default();
    let mut announced = false;
    while let Some(line) = lines.peek() {
        if announced && is_row(line) {
            return Ok(header);
        }
        if line.number > HEADER_LINES {
            break;
        }
        lines.next();
        if announced {
            header.take_columns(line);
        } else {
            header.take(line);
        }
        announced |= plain(line).trim_start().starts_with("DATOS DE ACELERACION");
    }
    Err(source.error(
        lines.number().max(1),
        0,
        "no rows of numbers after DATOS DE ACELERACION",
        REMEDY,
    ))
}

/// A row of numbers: not a ruler, not channels' names.
fn is_row(line: Line<'_>) -> bool {
    let mut fields = line.fields().peekable();
    fields.peek().is_some()
        && line.bytes.contains(&b'.')
        && fields.all(|(_, f)| {
            f.iter()
                .all(|b| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+' | b'*' | b'E' | b'e'))
        })
}

impl Header {
    /// The lines between the announcement of the data and its rows: `CANAL-1 CANAL-2`, then the
    /// orientations.
    fn take_columns(&mut self, line: Line<'_>) {
        let upper = plain(line);
        let words: Vec<String> = upper.split_whitespace().map(str::to_owned).collect();
        let is_channel = |word: &String| word.starts_with("CANAL");
        if !(1..=MOST_CHANNELS).contains(&words.len()) {
            return;
        }
        if words.iter().all(is_channel) {
            self.column_numbers = Some((words, line.number));
        } else if words.iter().any(|word| Direction::parse(word).is_some()) {
            self.column_names = Some((words, line.number));
        }
    }

    /// Holds what stands above the columns against the orientations in the header.
    fn agrees_with_columns(
        &self,
        source: &Source<'_>,
        names: &[&str],
    ) -> Result<(), GroundMotionError> {
        if let Some((words, line)) = &self.column_numbers {
            let number = |word: &String| number::first_in(word).map(|n| n.0.abs());
            let in_order =
                |(k, word): (usize, &String)| number(word).is_none_or(|n| n == (k + 1) as f64);
            if !words.iter().enumerate().all(in_order) {
                let message = format!(
                    "the columns are {} here, not in the order of the channels in the header",
                    words.join(", ")
                );
                source.contradiction(*line, message)?;
            }
        }
        let (Some((words, line)), Some(of_names)) = (&self.column_names, self.names.line()) else {
            return Ok(());
        };
        let mut both = words.iter().zip(names);
        if both.any(|(a, b)| Direction::differ(a, b)) {
            let message = format!(
                "the columns are {} here, but the orientations are {} in line {of_names}",
                words.join(", "),
                names.join(", ")
            );
            source.contradiction(*line, message)?;
        }
        Ok(())
    }

    fn take(&mut self, line: Line<'_>) {
        let (text, upper) = (line.text(), plain(line));
        self.incomplete |= upper.contains("REGISTRO INCOMPLETO");
        let (Some((key, _)), Some((_, value))) = (upper.split_once(':'), text.split_once(':'))
        else {
            return;
        };
        let (key, value) = (key.trim(), value.trim());
        if value.is_empty() {
            return;
        }
        let first = if key.contains("C7-C12") { 6 } else { 0 };
        let entries = match key {
            // `ACEL. MAX., C1-C6, EN LA MUESTRA` is where they are.
            k if k.contains("EN LA MUESTRA") => &mut self.peak_places,
            k if k.starts_with("INTERVALO DE MUESTREO") => &mut self.steps,
            k if k.starts_with("VEL. DE MUESTREO") => &mut self.rates,
            k if k.starts_with("DURACION DEL REGISTRO") => &mut self.durations,
            k if k.starts_with("NUM. TOTAL DE MUESTRAS") => &mut self.counts,
            k if k.starts_with("ACEL. MAX") => {
                let bracketed = key.split_once('(').and_then(|(_, r)| r.split(')').next());
                if let Some(word) = bracketed {
                    self.peak_unit = SeriesUnit::parse(word);
                    if self.peak_unit.is_none() {
                        self.strange_unit = Some((line.number, word.to_owned()));
                    }
                }
                &mut self.peaks
            }
            k if k.starts_with("ORIENTACION C") => {
                let minus = |text: &&str| text.trim_end().ends_with(";-");
                let reversed = value
                    .split('/')
                    .find(minus)
                    .map(|t| (line.number, t.to_owned()));
                self.reversed = self.reversed.take().or(reversed);
                &mut self.names
            }
            k => return self.take_single(line.number, k, value),
        };
        entries.take(line.number, first, value);
    }

    /// What holds for all channels.
    fn take_single(&mut self, line: usize, key: &str, value: &str) {
        let number = number::first_in(value).map(|n| n.0);
        match key {
            "NUMERO DE CANALES" => {
                let whole = number.filter(|n| n.fract() == 0.0 && (1.0..100.0).contains(n));
                self.channels = whole.map(|n| n as usize);
            }
            k if k.starts_with("UNIDADES DE LOS DATOS") => {
                // `Gal (cm/s/s)`: a unit and the same one in brackets.
                let (word, inner) = value.split_once('(').unwrap_or((value, ""));
                let inner = SeriesUnit::parse(inner.trim().trim_end_matches(')'));
                let unit = SeriesUnit::parse(word);
                self.unit = unit.or(inner).filter(|u| inner.is_none_or(|i| i == *u));
                if self.unit.is_none() {
                    self.strange_unit = Some((line, value.to_owned()));
                }
            }
            k if k.starts_with("FORMATO DATOS") || k.starts_with("FORMATO DE LOS DATOS") => {
                self.layout = Layout::parse(value).filter(|l| l.is_plain());
            }
            k if k.starts_with("FACTOR DE DECIMACION") => {
                self.decimation = number.filter(|n| *n >= 1.0 && n.fract() == 0.0);
            }
            k if k.starts_with("NOMBRE DE LA ESTACION") => value.clone_into(&mut self.station),
            k if k.starts_with("HORA DE LA PRIMERA MUESTRA") => value.clone_into(&mut self.start),
            _ => {}
        }
    }
}
