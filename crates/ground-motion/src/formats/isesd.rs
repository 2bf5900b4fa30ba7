//! Internet Site for European Strong-motion Data (`.cor`, `.raw`): lines
//! `key: value`, comments, then blocks that start `->`.

use crate::cut_numbers::Forms;
use crate::draft::{Draft, DraftUnit, StatedDuration};
use crate::error::GroundMotionError;
use crate::format::Format;
use crate::formats::rows::DecimalCommas;
use crate::fortran::Layout;
use crate::number::{self, Bare};
use crate::origin::Processing;
use crate::quantity::{Quantity, SeriesUnit};
use crate::recording::Series;
use crate::row_widths::RowWidths;
use crate::source::Source;
use crate::text::{Line, Lines};
use crate::time_column::Times;

/// Columns of a number.
const WIDTH: usize = 13;
/// Columns that a row of touching numbers may have.
const LONGEST: usize = 260;

/// What the header says.
#[derive(Default)]
struct Header {
    step: Option<f64>,
    /// Length of the record, with its line.
    duration: Option<StatedDuration>,
    count: Option<usize>,
    units: Vec<SeriesUnit>,
    orientation: String,
    station: String,
    start: String,
}

pub(super) static FORMAT: Format = Format {
    name: "isesd",
    title: "Internet Site for European Strong-motion Data",
    source: "Imperial College London and partners",
    recognised_by: "file: in the first line, and waveform code within ten",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    source.first_line().contains("file:")
        && source
            .head()
            .take(10)
            .any(|l| l.lower().contains("waveform code"))
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut header = Header::default();
    while let Some(line) = lines.peek().filter(|l| !is_label(l)) {
        header.take(source, line)?;
        lines.next();
    }
    let mut series = Vec::new();
    while let Some(label) = lines.next() {
        let text = label.lower();
        let quantity = [
            Quantity::Acceleration,
            Quantity::Velocity,
            Quantity::Displacement,
        ]
        .into_iter()
        .find(|q| text.contains(q.name()));
        let histories = quantity.filter(|_| !text.contains("spectr"));
        let Some(quantity) = histories else {
            source.warn("blocks that are not time histories were passed over");
            while lines.peek().is_some_and(|l| !is_label(&l)) {
                lines.next();
            }
            continue;
        };
        let raw = text.contains("uncorrected");
        // A value is followed by its time where there is no step.
        let of_a_sample = if header.is_uneven(raw) { 2 } else { 1 };
        let (numbers, row) = numbers(source, &mut lines, header.count, of_a_sample)?;
        let mut draft = header.draft(
            quantity,
            raw,
            numbers,
            (label.number, label.number + 1, lines.number()),
        );
        draft.row = row.map(|row| row.div_ceil(of_a_sample));
        series.push(draft.finish(source)?);
    }
    Ok(series)
}

fn is_label(line: &Line<'_>) -> bool {
    line.bytes.trim_ascii_start().starts_with(b"->")
}

/// Values up to the next label, so many of a sample, and the most in a row.
fn numbers<'a>(
    source: &Source<'a>,
    lines: &mut Lines<'a>,
    count: Option<usize>,
    of_a_sample: usize,
) -> Result<(Vec<f64>, Option<usize>), GroundMotionError> {
    let mut values = Vec::with_capacity(count.unwrap_or(0).min(lines.remaining() / 2 + 1));
    let mut widths = RowWidths::default();
    let mut forms = Forms::default();
    let mut commas = DecimalCommas::default();
    while let Some(line) = lines.peek().filter(|l| !is_label(l)) {
        lines.next();
        commas.see(line);
        let before = values.len();
        let length = line.bytes.len();
        // Fields that touch are no numbers between blanks.
        let touching = line.fields().any(|(_, f)| number::parse(f).is_err());
        if touching && length.is_multiple_of(WIDTH) && length <= LONGEST {
            source.row(line, Layout::new(length / WIDTH, WIDTH), &mut values)?;
            for (i, field) in line.bytes.chunks(WIDTH).enumerate() {
                forms.see(line.number, i * WIDTH, field.trim_ascii());
            }
        } else {
            for (column, field) in line.fields() {
                values.push(source.number(line, column, field)?);
                forms.see(line.number, column, field);
            }
        }
        if values.len() > before {
            widths.see(line.number, values.len() - before);
        }
    }
    commas.part_values(source, values.len(), count.map(|count| count * of_a_sample))?;
    let row = widths.most();
    widths.are_even(source)?;
    match lines.peek().is_some() || source.ends_whole()? {
        true => forms.are_whole(source)?,
        false => drop(values.pop()),
    }
    Ok((values, row))
}

impl Header {
    fn take(&mut self, source: &Source<'_>, line: Line<'_>) -> Result<(), GroundMotionError> {
        let text = line.text();
        let Some((key, value)) = text.split_once(':') else {
            return Ok(());
        };
        let value = value.trim();
        let first = number::first_in(value).map(|n| n.0);
        match key.trim().to_ascii_lowercase().as_str() {
            "sampling period" => {
                let step = source.step_or_rate(line, value, Bare::Step)?;
                self.step = step.filter(|s| *s > 0.0);
            }
            "record length" => {
                let seconds = first.filter(|s| *s > 0.0);
                self.duration = seconds.map(|seconds| StatedDuration {
                    seconds,
                    line: Some(line.number),
                });
            }
            "number of samples" => {
                self.count = first
                    .filter(|n| n.fract() == 0.0 && (1.0..1.0e9).contains(n))
                    .map(|n| n as usize);
            }
            "units" => {
                self.units = value
                    .split([',', '&'])
                    .filter_map(SeriesUnit::parse)
                    .collect();
            }
            "orientation of transducer" => self.orientation = value.to_owned(),
            "station code" => self.station = value.to_owned(),
            "time of first sample" => self.start = value.to_owned(),
            _ => {}
        }
        Ok(())
    }

    /// Whether each value of a block is followed by its time.
    fn is_uneven(&self, raw: bool) -> bool {
        raw && self.step.is_none()
    }

    fn draft(
        &self,
        quantity: Quantity,
        raw: bool,
        numbers: Vec<f64>,
        lines: (usize, usize, usize),
    ) -> Draft {
        let stated = self.units.iter().find(|u| u.quantity == quantity).copied();
        // The list names acceleration and velocity; displacement follows them.
        let metres = self.units.contains(&SeriesUnit::M_S);
        let unit =
            stated.or((quantity == Quantity::Displacement && metres).then_some(SeriesUnit::M));
        let unit = unit.map_or(DraftUnit::Unstated, DraftUnit::Stated);
        let mut draft = if self.is_uneven(raw) {
            let times = numbers.chunks_exact(2).map(|p| p[1]).collect();
            let samples = numbers.chunks_exact(2).map(|p| p[0]).collect();
            let mut draft = Draft::new(samples, unit, lines);
            draft.times = Times::Each(times);
            draft
        } else {
            let mut draft = Draft::new(numbers, unit, lines);
            draft.times = Times::Step(self.step);
            draft
        };
        draft.header_count = self.count;
        draft.header_durations = self.duration.into_iter().collect();
        draft.component.clone_from(&self.orientation);
        draft.title.clone_from(&self.station);
        draft.start_time.clone_from(&self.start);
        draft.processing = if raw {
            Processing::Raw
        } else {
            Processing::Corrected
        };
        draft
    }
}
