//! Free-field text of the Central Weather Administration, Taiwan: lines that start
//! with `#`, then time and, in this order, up, north and east.

use crate::cut_numbers::Forms;
use crate::draft::{Draft, DraftPeak, DraftUnit, StatedDuration};
use crate::error::GroundMotionError;
use crate::format::Format;
use crate::fortran::Layout;
use crate::number::{self, Printed};
use crate::origin::Processing;
use crate::quantity::SeriesUnit;
use crate::recording::Series;
use crate::source::Source;
use crate::text::{Line, Lines};
use crate::time_column::{TimeColumn, Times};

const REMEDY: &str = "the header is not that of the agency's free-field files: get it again";

/// What the header says.
struct Header {
    rate: Option<f64>,
    unit: Option<SeriesUnit>,
    /// A unit that is not known, with its line.
    unknown_unit: Option<(usize, String)>,
    names: Vec<String>,
    /// Line of the names, from 1, and the first of them whose sign is minus.
    reversed: Option<(usize, String)>,
    duration: Option<StatedDuration>,
    /// Component, largest and least value, line from 1.
    peaks: Vec<(String, [Printed; 2], usize)>,
    layout: Option<Layout>,
    station: String,
    start: String,
    processing: Processing,
}

pub(super) static FORMAT: Format = Format {
    name: "cwa",
    title: "Free-field text of the Central Weather Administration",
    source: "Central Weather Administration, Taiwan",
    recognised_by: "a first line that starts with #Earthquake Information",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    source.first_line().starts_with("#earthquake information")
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let header = header(&mut lines);
    let end = lines.number();
    if let Some((line, name)) = header.reversed {
        return Err(source.error(
            line,
            0,
            format!("the sign of \"{name}\" is minus: in which direction its positive values point is not known"),
            "ask the agency whether the values must change their signs; change them if so, and write (+)",
        ));
    }
    let Some(layout) = header.layout else {
        return Err(source.error(end, 0, "no line such as \"#Data: 4F10.3\"", REMEDY));
    };
    if header.names.len() != layout.per_line || header.names.len() < 2 {
        return Err(source.error(
            end,
            0,
            format!(
                "{} names in #DataSequence, {} columns in #Data",
                header.names.len(),
                layout.per_line
            ),
            REMEDY,
        ));
    }
    if let Some((line, word)) = &header.unknown_unit {
        return Err(source.error(
            *line,
            0,
            format!("\"{word}\" is not a unit of ground motion"),
            "give the record of the accelerations, whose unit is gal; if the unit alone is wrong, correct the line",
        ));
    }
    let room = lines.remaining() / (layout.width * layout.per_line) + 1;
    let mut values: Vec<Vec<f64>> = (1..layout.per_line)
        .map(|_| Vec::with_capacity(room))
        .collect();
    let mut forms: Vec<Forms> = values.iter().map(|_| Forms::of(layout)).collect();
    let mut times = TimeColumn::with_capacity(room);
    for line in lines.by_ref().filter(|l| !l.is_blank()) {
        row(source, line, layout, &mut times, &mut values)?;
        let fields = line.bytes.chunks(layout.width).enumerate().skip(1);
        for ((k, field), forms) in fields.zip(&mut forms) {
            let blanks = field.len() - field.trim_ascii_start().len();
            forms.see(line.number, k * layout.width + blanks, field);
        }
    }
    forms.iter().try_for_each(|forms| forms.are_whole(source))?;
    let mut warnings = Vec::new();
    let step = step(source, end, times, header.rate, &mut warnings)?;
    let mut series = Vec::new();
    for (name, samples) in header.names.iter().skip(1).zip(values) {
        let unit = header.unit.map_or(DraftUnit::Unstated, DraftUnit::Stated);
        let mut draft = Draft::new(samples, unit, (end, end + 1, lines.number()));
        draft.component.clone_from(name);
        draft.channel = series.len() + 1;
        draft.times = Times::Step(Some(step));
        draft.title.clone_from(&header.station);
        draft.start_time.clone_from(&header.start);
        draft.processing = header.processing;
        draft.warnings.clone_from(&warnings);
        draft.header_durations = header.duration.into_iter().collect();
        let mut peaks = header.peaks_of(name).into_iter();
        draft.peak = peaks.next();
        draft.other_peaks = peaks.collect();
        series.push(draft.finish(source)?);
    }
    Ok(series)
}

impl Header {
    /// The stated peaks of a component, the larger magnitude first.
    fn peaks_of(&self, name: &str) -> Vec<DraftPeak> {
        let stated = self.peaks.iter().find(|p| p.0.eq_ignore_ascii_case(name));
        let Some((_, [largest, least], line)) = stated else {
            return Vec::new();
        };
        // An offset of the instrument may leave all values on one side of zero.
        let both = largest.0 > 0.0 && least.0 < 0.0;
        let peak = |value: Printed| DraftPeak {
            value,
            time: None,
            unit: None,
            shift: 0.0,
            line: Some(*line),
            of_sign: both,
        };
        let (first, second) = match largest.0.abs() >= least.0.abs() {
            true => (*largest, *least),
            false => (*least, *largest),
        };
        let mut peaks = vec![peak(first)];
        if both {
            peaks.push(peak(second));
        }
        peaks
    }
}

fn header(lines: &mut Lines<'_>) -> Header {
    let mut header = Header {
        rate: None,
        unit: None,
        unknown_unit: None,
        names: Vec::new(),
        reversed: None,
        duration: None,
        peaks: Vec::new(),
        layout: None,
        station: String::new(),
        start: String::new(),
        processing: Processing::Raw,
    };
    while let Some(line) = lines
        .peek()
        .filter(|l| l.is_blank() || l.bytes.starts_with(b"#"))
    {
        lines.next();
        let text = line.columns(1, line.bytes.len());
        let Some((key, value)) = text.split_once(':') else {
            continue;
        };
        let value = value.trim();
        match key.trim().to_ascii_lowercase().as_str() {
            "samplerate(hz)" => {
                header.rate = number::first_in(value).map(|r| r.0).filter(|r| *r > 0.0);
            }
            "amplitudeunit" => {
                let mut words = value.split_whitespace();
                if let Some(word) = words.next() {
                    header.unit = SeriesUnit::parse(word);
                    let unknown = || (line.number, word.to_owned());
                    header.unknown_unit = header.unit.is_none().then(unknown);
                }
                if value.to_ascii_lowercase().contains("dcoffset(corr)") {
                    header.processing = Processing::Unstated;
                }
            }
            "datasequence" => {
                let mut entries = value.split([';', ' ']).filter(|n| !n.is_empty());
                header.reversed = entries
                    .find(|n| n.ends_with("(-)"))
                    .map(|n| (line.number, n.to_owned()));
                header.names = value
                    .split([';', ' '])
                    .filter(|n| !n.is_empty())
                    .map(|n| n.split('(').next().unwrap_or(n).to_owned())
                    .collect();
            }
            "data" => header.layout = Layout::parse(value).filter(|l| l.is_plain()),
            "recordlength(sec)" => {
                let stated = number::first_in(value).map(|l| l.0).filter(|l| *l > 0.0);
                header.duration = stated.map(|seconds| StatedDuration {
                    seconds,
                    line: Some(line.number),
                });
            }
            key if key.starts_with("amplitudemax.") => {
                let name = key["amplitudemax.".len()..].trim().to_owned();
                if let Some((largest, least)) = value.split_once('~')
                    && let (Some(largest), Some(least)) =
                        (number::first_in(largest), number::first_in(least))
                {
                    header.peaks.push((name, [largest, least], line.number));
                }
            }
            "stationcode" => header.station = value.to_owned(),
            "starttime" if !value.is_empty() => header.start = format!("{value} GMT+8"),
            _ => {}
        }
    }
    header
}

fn row(
    source: &Source<'_>,
    line: Line<'_>,
    layout: Layout,
    times: &mut TimeColumn,
    values: &mut [Vec<f64>],
) -> Result<(), GroundMotionError> {
    if line.bytes.len() != layout.width * layout.per_line {
        return Err(source.error(
            line.number,
            line.bytes.len(),
            format!(
                "the row does not have {} numbers of {} columns",
                layout.per_line, layout.width
            ),
            "the file is damaged or truncated: get it again",
        ));
    }
    for (k, field) in line.bytes.chunks(layout.width).enumerate() {
        let value = source.field(line, k * layout.width, field, layout)?;
        match k.checked_sub(1) {
            None => times.push(line, value, field),
            Some(k) => values[k].push(value),
        }
    }
    Ok(())
}

/// The step of the times, held against the rate in the header.
fn step(
    source: &Source<'_>,
    end: usize,
    times: TimeColumn,
    rate: Option<f64>,
    warnings: &mut Vec<String>,
) -> Result<f64, GroundMotionError> {
    match times.finish(source, end + 1, warnings)? {
        Times::Step(Some(step)) => {
            if let Some(rate) = rate
                && (step * rate - 1.0).abs() > 1.0e-3
            {
                warnings.push(format!(
                    "the header says {rate} samples per second, the times {step} s"
                ));
            }
            Ok(step)
        }
        _ => Err(source.error(
            end + 1,
            0,
            "the times are not even",
            "rows are missing: get the record again",
        )),
    }
}
