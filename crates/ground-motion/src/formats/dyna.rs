//! DYNA 1.x (ESM and ITACA of INGV, AFAD): lines `KEY: value`, then one value a
//! line.

use crate::cut_numbers::Forms;
use crate::draft::{Draft, DraftPeak, DraftUnit, StatedDuration};
use crate::error::GroundMotionError;
use crate::format::Format;
use crate::formats::rows::{DecimalCommas, second_record};
use crate::number;
use crate::origin::Processing;
use crate::quantity::{Quantity, SeriesUnit};
use crate::recording::Series;
use crate::source::{Keys, Source};
use crate::text::Line;
use crate::time_column::Times;

/// What the header says.
#[derive(Default)]
struct Header {
    /// Time step (s) and its line.
    step: Option<(f64, usize)>,
    count: Option<usize>,
    duration: Option<StatedDuration>,
    unit: Option<SeriesUnit>,
    /// What DATA_TYPE says, and its line.
    quantity: Option<(Quantity, usize)>,
    peak: Option<(f64, f64)>,
    /// Unit in its key, and its line.
    peak_unit: Option<SeriesUnit>,
    peak_line: Option<usize>,
    peak_time: Option<(f64, f64)>,
    stream: String,
    station: String,
    event: String,
    start: String,
    processing: Processing,
    corners: (Option<f64>, Option<f64>),
    late: bool,
    keys: Keys,
}

pub(super) static FORMAT: Format = Format {
    name: "dyna",
    title: "DYNA 1.x: ESM, ITACA, AFAD",
    source: "Istituto Nazionale di Geofisica e Vulcanologia, Italy",
    recognised_by: "a first line that starts with EVENT_NAME:",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    source.lines().next().is_some_and(is_first)
}

fn is_first(line: Line<'_>) -> bool {
    line.lower().starts_with("event_name:")
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut header = Header::default();
    while let Some(line) = lines.peek() {
        let Some((key, value)) = key_and_value(line) else {
            break;
        };
        header.take(source, line, &key, &value)?;
        lines.next();
    }
    let end = lines.number();
    let mut samples = Vec::with_capacity(lines.remaining() / 4 + 1);
    let mut forms = Forms::default();
    let mut commas = DecimalCommas::default();
    let mut row = 0;
    for line in lines.by_ref() {
        if line.is_text() && is_first(line) {
            return Err(second_record(source, line));
        }
        commas.see(line);
        let before = samples.len();
        for (column, field) in line.fields() {
            samples.push(source.number(line, column, field)?);
            forms.see(line.number, column, field);
        }
        row = row.max(samples.len() - before);
    }
    commas.part_values(source, samples.len(), header.count)?;
    match source.ends_whole()? {
        true => forms.are_whole(source)?,
        false => drop(samples.pop()),
    }
    let unit = header.unit.map_or(DraftUnit::Unstated, DraftUnit::Stated);
    if let (Some(unit), Some((quantity, line))) = (header.unit, header.quantity)
        && unit.quantity != quantity
    {
        return Err(source.error(
            line,
            0,
            format!("DATA_TYPE is {quantity}, UNITS is {}", unit.symbol),
            "the header contradicts itself: get the record again",
        ));
    }
    header.peak_agrees(source, &samples)?;
    let of_step = header.step.map_or(end, |(_, line)| line);
    let mut draft = Draft::new(samples, unit, (of_step, end + 1, lines.number()));
    draft.times = Times::Step(header.step.map(|(step, _)| step));
    draft.header_count = header.count;
    draft.row = Some(row);
    draft.header_durations = header.duration.into_iter().collect();
    draft.component = header.stream;
    draft.title = format!("{}; {}", header.event, header.station);
    draft.start_time = header.start;
    draft.processing = header.processing;
    draft.corners = header.corners;
    draft.peak = header.peak.map(|value| DraftPeak {
        value,
        time: header.peak_time,
        unit: header.peak_unit,
        shift: 0.0,
        line: header.peak_line,
        of_sign: false,
    });
    if header.late {
        draft
            .warnings
            .push("late triggered: the onset of the motion is lost".to_owned());
    }
    Ok(vec![draft.finish(source)?])
}

/// A line that starts with a word of capitals and a colon.
fn key_and_value(line: Line<'_>) -> Option<(String, String)> {
    let text = line.text();
    let (key, value) = text.split_once(':')?;
    key.starts_with(|c: char| c.is_ascii_alphabetic())
        .then(|| (key.trim().to_ascii_uppercase(), value.trim().to_owned()))
}

impl Header {
    /// Refuses a peak that the samples have as they are printed, where its key has another unit
    /// than they have: mg and cm/s2 differ by 2 %, which other peaks may.
    fn peak_agrees(&self, source: &Source<'_>, samples: &[f64]) -> Result<(), GroundMotionError> {
        let (Some((peak, digit)), Some(of_peak), Some(unit)) =
            (self.peak, self.peak_unit, self.unit)
        else {
            return Ok(());
        };
        let largest = samples.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        let as_printed = (largest - peak.abs()).abs() <= digit && peak != 0.0;
        if !as_printed || of_peak == unit || of_peak.quantity != unit.quantity {
            return Ok(());
        }
        Err(source.error(
            self.peak_line.unwrap_or(1),
            0,
            format!(
                "the samples have the peak of the header in {}, but UNITS is {}",
                of_peak.symbol, unit.symbol
            ),
            "header lines contradict one another: get the record again",
        ))
    }

    fn take(
        &mut self,
        source: &Source<'_>,
        line: Line<'_>,
        key: &str,
        value: &str,
    ) -> Result<(), GroundMotionError> {
        if value.is_empty() {
            return Ok(());
        }
        if !self.keys.is_new(source, line, key, value)? {
            return Ok(());
        }
        let first = number::first_in(value);
        match key {
            "SAMPLING_INTERVAL_S" => {
                let step = source.number(line, key.len() + 2, value.as_bytes())?;
                self.step = Some((step, line.number));
            }
            "DURATION_S" => {
                let stated = source.header_number(line.number, key, value);
                self.duration = stated
                    .filter(|d| d.0 > 0.0)
                    .map(|(seconds, _)| StatedDuration {
                        seconds,
                        line: Some(line.number),
                    });
            }
            "NDATA" => {
                self.count = Some(value.parse().map_err(|_| {
                    source.error(
                        line.number,
                        key.len() + 2,
                        format!("\"{value}\" is not a number of samples"),
                        "the header is damaged: get the record again",
                    )
                })?);
            }
            "UNITS" => {
                self.unit = Some(SeriesUnit::parse(value).ok_or_else(|| {
                    source.error(
                        line.number,
                        key.len() + 2,
                        format!("\"{value}\" is not a unit of ground motion"),
                        "DYNA files have cm/s^2, cm/s or cm",
                    )
                })?);
            }
            "DATA_TYPE" => {
                let lower = value.to_ascii_lowercase();
                let quantity = Quantity::in_words(&lower).filter(|_| !lower.contains("spectr"));
                let quantity = quantity.ok_or_else(|| {
                    source.error(
                        line.number,
                        key.len() + 2,
                        format!("DATA_TYPE is \"{value}\", which is no time history of one quantity"),
                        "give the time history of the acceleration: DATA_TYPE is ACCELERATION, VELOCITY or DISPLACEMENT there",
                    )
                })?;
                self.quantity = Some((quantity, line.number));
            }
            "STREAM" => self.stream = value.to_owned(),
            "STATION_CODE" => self.station = value.to_owned(),
            "EVENT_NAME" => self.event = value.to_owned(),
            "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS" => self.start = value.to_owned(),
            "LOW_CUT_FREQUENCY_HZ" => self.corners.0 = first.map(|n| n.0),
            "HIGH_CUT_FREQUENCY_HZ" => self.corners.1 = first.map(|n| n.0),
            "LATE/NORMAL_TRIGGERED" => self.late = value.eq_ignore_ascii_case("LT"),
            "BASELINE_CORRECTION" | "FILTER_TYPE" => self.take_processing(value),
            k if k.starts_with("PGA_") || k.starts_with("PGV_") || k.starts_with("PGD_") => {
                // `PGA_CM/S^2`, whatever the unit of the samples is.
                self.peak = source.header_number(line.number, key, value);
                self.peak_unit = SeriesUnit::parse(&k["PGA_".len()..]);
                self.peak_line = Some(line.number);
            }
            k if k.starts_with("TIME_PG") => {
                self.peak_time = source.header_number(line.number, key, value);
            }
            _ => {}
        }
        Ok(())
    }

    /// Any correction makes the record a corrected one.
    fn take_processing(&mut self, value: &str) {
        let not = value.to_ascii_uppercase().contains("NOT ");
        if !not {
            self.processing = Processing::Corrected;
        } else if self.processing == Processing::Unstated {
            self.processing = Processing::Raw;
        }
    }
}
