//! Archivo Estandar de Aceleracion 2.0 (UNAM, CICESE, CENAPRED): Spanish key lines,
//! then a column for each channel, gal.

use crate::accelerogram::Processing;
use crate::draft::{Draft, DraftPeak, DraftUnit, Times};
use crate::error::GroundMotionError;
use crate::formats::Format;
use crate::fortran::Layout;
use crate::number;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::source::Source;
use crate::text::{Line, Lines};

const REMEDY: &str = "the header is not that of ASA 2.0: get the record again";
/// Lines that a header may have; 109 in every file seen.
const HEADER_LINES: usize = 400;

/// What the header says.
#[derive(Default)]
struct Header {
    steps: Vec<String>,
    counts: Vec<String>,
    peaks: Vec<String>,
    names: Vec<String>,
    unit: Option<SeriesUnit>,
    layout: Option<Layout>,
    station: String,
    start: String,
    incomplete: bool,
}

pub(super) static FORMAT: Format = Format {
    name: "asa",
    title: "Archivo Estandar de Aceleracion 2.0",
    source: "UNAM, CICESE and CENAPRED, Mexico",
    recognised_by: "archivo estandar de aceleracion within fifteen lines",
    matches,
    read,
};

fn matches(source: &Source<'_>) -> bool {
    source
        .head()
        .take(15)
        .any(|l| l.lower().contains("archivo estandar de aceleracion"))
}

fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let header = header(source, &mut lines)?;
    let end = lines.number();
    let Some(layout) = header.layout else {
        return Err(source.error(end, 0, "no line FORMATO DATOS such as 3F10.4", REMEDY));
    };
    if layout.per_line > header.names.len() {
        return Err(source.error(
            end,
            0,
            format!(
                "{} columns of data, {} orientations",
                layout.per_line,
                header.names.len()
            ),
            REMEDY,
        ));
    }
    let room = lines.remaining() / (layout.width * layout.per_line) + 1;
    let mut values: Vec<Vec<f64>> = (0..layout.per_line)
        .map(|_| Vec::with_capacity(room))
        .collect();
    let mut row = Vec::with_capacity(layout.per_line);
    for line in lines.by_ref().filter(|l| !l.is_blank()) {
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
        for (column, value) in values.iter_mut().zip(&row) {
            column.push(*value);
        }
    }
    let mut series = Vec::new();
    for (k, samples) in values.into_iter().enumerate() {
        let unit = header.unit.map_or(DraftUnit::Unstated, DraftUnit::Stated);
        let mut draft = Draft::new(samples, unit, (end, end + 1, lines.number()));
        header.fill(k, &mut draft);
        series.push(draft.finish(source)?);
    }
    Ok(series)
}

impl Header {
    /// Entry `k` of a list, unless there is one for all channels.
    fn entry(list: &[String], k: usize) -> Option<(f64, f64)> {
        let text = list
            .get(k)
            .or_else(|| list.first().filter(|_| list.len() == 1))?;
        number::first_in(text)
    }

    fn fill(&self, k: usize, draft: &mut Draft) {
        draft.component.clone_from(&self.names[k]);
        draft.channel = k + 1;
        draft.times = Times::Step(Self::entry(&self.steps, k).map(|s| s.0));
        draft.header_count = Self::entry(&self.counts, k)
            .map(|n| n.0)
            .filter(|n| n.fract() == 0.0 && (1.0..1.0e9).contains(n))
            .map(|n| n as usize);
        draft.peak = Self::entry(&self.peaks, k).map(|value| DraftPeak {
            value,
            time: None,
            unit: Some(SeriesUnit::CM_S2),
            shift: 0.0,
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
        header.take(line);
        let lower = line.lower();
        announced |= lower.trim_start().starts_with("datos de aceleracion");
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
    fn take(&mut self, line: Line<'_>) {
        let text = line.text();
        let upper = text.to_ascii_uppercase();
        self.incomplete |= upper.contains("REGISTRO INCOMPLETO");
        let Some((key, value)) = text.split_once(':') else {
            return;
        };
        let key = key.trim().to_ascii_uppercase();
        let value = value.trim();
        let list = || -> Vec<String> {
            value
                .split(['/', ';'])
                .map(|v| v.trim().trim_end_matches('+').trim().to_owned())
                .filter(|v| !v.is_empty())
                .collect()
        };
        match key.as_str() {
            k if k.starts_with("INTERVALO DE MUESTREO") => self.steps = list(),
            k if k.starts_with("NUM. TOTAL DE MUESTRAS") => self.counts = list(),
            k if k.starts_with("ACEL. MAX") => self.peaks = list(),
            k if k.starts_with("ORIENTACION C1") => self.names = list(),
            k if k.starts_with("UNIDADES DE LOS DATOS") => self.unit = SeriesUnit::parse(value),
            k if k.starts_with("FORMATO DATOS") => self.layout = Layout::parse(value),
            k if k.starts_with("NOMBRE DE LA ESTACION") => self.station = value.to_owned(),
            k if k.starts_with("HORA DE LA PRIMERA MUESTRA") => self.start = value.to_owned(),
            _ => {}
        }
    }
}
