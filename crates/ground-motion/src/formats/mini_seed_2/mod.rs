//! miniSEED 2 (FDSN SEED manual, version 2.4, chapter 8 and appendix B): records of
//! integers, floats, Steim-1 or Steim-2. Counts: the sensitivity is in the
//! station's metadata, not in the file; StationXML beside it, or named by the user, gives it.

use crate::draft::{Draft, DraftUnit};
use crate::error::{GroundMotionError, bound};
use crate::format::Format;
use crate::instrument;
use crate::origin::Processing;
use crate::origin::ResponseFile;
use crate::recording::{Series, WithoutSensitivity};
use crate::source::Source;
use crate::station_xml::{Responses, Sensitivity};
use crate::time_column::Times;

mod record;
mod steim;

/// What to do about channels of seismometers.
const VELOCITY_REMEDY: &str = "use the channels of an accelerograph, HN or EN; where the code is wrong, give the StationXML of the channel as `response`";

use record::Record;

pub(super) static FORMAT: Format = Format {
    name: "mini_seed_2",
    title: "miniSEED 2 with integers, floats, Steim-1 or Steim-2; counts",
    source: "Federation of Digital Seismograph Networks, SEED manual 2.4, chapter 8 and appendix B",
    recognised_by: "a sequence number of six digits, then D, R, Q or M",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    record::is_start(source.bytes)
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let (mut records, mut emptied) = (Vec::new(), Vec::new());
    let mut at = 0;
    while at < source.bytes.len() && !is_filled_up(source, at) {
        let record = Record::read(source, at)?;
        at += record.length;
        if record.count > 0 {
            records.push(record);
        } else if record.has_data(source) {
            emptied.push(record);
        }
    }
    if let Some(first) = emptied.first() {
        let more = match emptied.len() {
            1 => String::new(),
            n => format!(" (and {} more)", n - 1),
        };
        source.warn(&format!(
            "the record at byte {} of {}{more} says that it has no samples, but data stand in it: it was passed over",
            first.at,
            first.label()
        ));
    }
    // The file's order among equal times, for messages.
    records.sort_by_key(|r| (r.name, r.start, r.at));
    let responses = responses(source, &records)?;
    let channels: Vec<&[Record]> = records.chunk_by(|a, b| a.name == b.name).collect();
    let mut series = Vec::new();
    let mut velocity = None;
    let mut other = None;
    let mut without = Vec::new();
    let mut number = 0;
    for channel in &channels {
        let first = &channel[0];
        let is_given = matches!(responses, Some(Responses::Given(_)));
        // Values that a program has brought to a unit are written as floats; the user knows which.
        let is_in_unit = source.options.unit.is_some()
            && source.options.sensitivity.is_none()
            && !is_given
            && in_floats(channel);
        let mut unused = None;
        let known = match &responses {
            Some(responses) => {
                let mut name = first.channel_name();
                let ends = channel.iter().map(Record::end);
                name.end = ends.max().unwrap_or(name.end);
                match (responses.of(source.file, &name), is_in_unit) {
                    (found, false) => Some(found?),
                    (found, true) => {
                        unused = found.ok().and_then(Result::ok);
                        None
                    }
                }
            }
            // The user gives the sensitivity.
            None => None,
        };
        let says_acceleration = source.options.sensitivity.is_some() || is_in_unit;
        if !matches!(known, Some(Ok(_))) && first.is_velocity() && !is_given {
            let label = first.label();
            let is_of_low_gain = instrument::is_of_low_gain(&first.channel_name().channel);
            if is_of_low_gain && says_acceleration {
                instrument::may_accelerate(
                    source,
                    &first.channel_name().channel,
                    match is_in_unit {
                        true => {
                            "its floats are taken to be accelerations, in the unit that is given"
                        }
                        false => {
                            "its counts are taken to be those of an acceleration, by the sensitivity that is given"
                        }
                    },
                    VELOCITY_REMEDY,
                )?;
            } else {
                let said = match is_of_low_gain {
                    true => "is that of an instrument of low gain, which may record velocity,",
                    false => "records velocity",
                };
                source.warn(&format!("channel {label} {said} and was passed over"));
                velocity.get_or_insert((label, is_of_low_gain));
                continue;
            }
        }
        if !matches!(known, Some(Ok(_)))
            && !is_given
            && let Some(measured) = first.other_measure()
        {
            let label = first.label();
            source.warn(&format!(
                "channel {label} records {measured} and was passed over"
            ));
            other.get_or_insert((label, measured));
            continue;
        }
        number += 1;
        let name = component(first, &channels);
        let known = match known {
            Some(Ok(known)) => Some(known),
            Some(Err(error)) => {
                without.push((name, first.label(), error));
                continue;
            }
            None => None,
        };
        let mut draft = draft(source, channel)?;
        draft.component = name;
        draft.channel = number;
        let mut response = None;
        if let (Some(given), Some(unused)) = (source.options.unit, unused) {
            draft.warnings.push(format!(
                "the values are floats, taken to be in {}, which is given: the sensitivity in {} is not applied",
                given.symbol(),
                unused.file
            ));
        }
        if let Some(known) = known {
            if let Some(given) = source.options.unit {
                return Err(counts_in_unit(source, first, given.symbol(), &known.file));
            }
            if !is_given && in_floats(channel) {
                draft.warnings.push(format!(
                    "the values are floats, which a program may have brought to a unit already; they are taken for counts, and divided by the sensitivity in {}: where they are in a unit, `unit` says which, and the sensitivity is not applied",
                    known.file
                ));
            }
            draft.unit = unit(&known);
            draft.orientation = known.orientation;
            draft.warnings.extend(known.warnings);
            response = Some(ResponseFile {
                file: known.file,
                sha256: known.sha256,
            });
        }
        let mut finished = draft.finish(source)?;
        finished.origin.response = response;
        series.push(finished);
    }
    if series.is_empty() {
        if let Some((_, _, error)) = without.into_iter().next() {
            return Err(error);
        }
        if let Some((label, is_of_low_gain)) = velocity {
            let (what, remedy) = match is_of_low_gain {
                true => (
                    format!(
                        "channel {label} is that of an instrument of low gain, which is an accelerograph in older codes and a seismometer, which records velocity, in others"
                    ),
                    "give the StationXML of the channel as `response`; or, of an accelerograph, `sensitivity` in counts per m/s2, or `unit` if the values are floats in it",
                ),
                false => (
                    format!("channel {label} is that of a seismometer, which records velocity"),
                    VELOCITY_REMEDY,
                ),
            };
            return Err(GroundMotionError::Unsupported {
                file: source.file.to_owned(),
                what,
                remedy,
            });
        }
        if let Some((label, measured)) = other {
            return Err(GroundMotionError::Unsupported {
                file: source.file.to_owned(),
                what: format!("channel {label} records {measured}, no acceleration"),
                remedy: VELOCITY_REMEDY,
            });
        }
        return Ok(series);
    }
    for (component, label, error) in without {
        let reason = error.to_string();
        source.warn(&format!(
            "channel {label} was passed over, as its sensitivity is not known: {reason}"
        ));
        source.is_without(WithoutSensitivity { component, reason });
    }
    Ok(series)
}

/// Whether nothing but zeros, or nothing but blanks, stands from a byte on behind a record, which is said:
/// files are filled up to whole blocks.
fn is_filled_up(source: &Source<'_>, at: usize) -> bool {
    let rest = &source.bytes[at..];
    let of = |filler: u8| rest.iter().all(|b| *b == filler);
    let what = match (of(0), of(b' ')) {
        _ if at == 0 => return false,
        (true, _) => "zeros",
        (_, true) => "blanks",
        _ => return false,
    };
    source.warn(&format!(
        "the last {} bytes are all {what} and were passed over: if records stood there, the end is missing",
        rest.len()
    ));
    true
}

/// What to say of a unit that is given for values which the sensitivity of a file brings to one.
fn counts_in_unit(
    source: &Source<'_>,
    channel: &Record,
    unit: &str,
    file: &str,
) -> GroundMotionError {
    let what = match channel.is_of_floats() {
        true => "by the file of response that is given they are counts",
        false => "they are integers, which are counts",
    };
    GroundMotionError::Unsupported {
        file: source.file.to_owned(),
        what: format!(
            "the unit {unit} is given for the values of {}, but {what}: {file} has their sensitivity, with its unit",
            channel.label()
        ),
        remedy: "leave `unit` out: it is for floats that a program has brought to a unit, and then without `response`",
    }
    .of_option("unit")
}

/// Whether all samples of a channel are floats, which instruments do not count in.
fn in_floats(channel: &[Record]) -> bool {
    channel.iter().all(Record::is_of_floats)
}

/// The code of a channel, with that of its location where another one differs by it alone.
fn component(of: &Record, channels: &[&[Record]]) -> String {
    let name = of.channel_name();
    let differs_by_location = channels.iter().any(|other| {
        let other = other[0].channel_name();
        other.location != name.location
            && (other.network, other.station, other.channel)
                == (
                    name.network.clone(),
                    name.station.clone(),
                    name.channel.clone(),
                )
    });
    match differs_by_location {
        true => format!("{}.{}", name.location, name.channel),
        false => name.channel,
    }
}

/// Where the sensitivities of the channels stand; `None` where the user gives one number.
fn responses(
    source: &Source<'_>,
    records: &[Record],
) -> Result<Option<Responses>, GroundMotionError> {
    let given = source.options.response.as_deref();
    if source.options.sensitivity.is_some() {
        if given.is_some() {
            return Err(GroundMotionError::Unsupported {
                file: source.file.to_owned(),
                what: "both a sensitivity and a file of response are given".to_owned(),
                remedy: "give one of `sensitivity` and `response`",
            });
        }
        return Ok(None);
    }
    let mut stations: Vec<String> = records.iter().map(|r| r.channel_name().station).collect();
    stations.dedup();
    Responses::find(given, source.path, &stations).map(Some)
}

/// Counts by the sensitivity of StationXML, which holds at one frequency: accelerometers are
/// taken to be flat, as with a sensitivity that the user gives.
fn unit(known: &Sensitivity) -> DraftUnit {
    let frequency = known
        .frequency
        .map_or(String::new(), |f| format!(" at {f} Hz"));
    DraftUnit::Scaled {
        unit: known.unit,
        each: 1.0 / known.value,
        of: "counts",
        by: format!(
            "{} per {}{frequency} by {}",
            known.value, known.unit.symbol, known.file
        ),
    }
}

/// Part by which the rate of blockette 100, the actual one, may differ from that of the fixed
/// header, which is rounded.
const RATE_TOLERANCE: f64 = 0.01;

/// Time (s) from the last sample of a record with the step after it to the first of the next one,
/// by their clocks.
fn clock_gap(before: &Record, after: &Record) -> f64 {
    (after.start - before.start) as f64 * 1.0e-6 - before.count as f64 / before.rate
}

/// Seconds that were inserted while a record lasted, where the clock of the next one has gone
/// over them: some recorders know of them only later.
fn leap_seconds(before: &Record, after: &Record) -> f64 {
    let (leap, gap) = (before.leap_seconds as f64, clock_gap(before, after));
    if (gap + leap).abs() < gap.abs() {
        leap
    } else {
        0.0
    }
}

/// One channel from its records in the order of time.
fn draft(source: &Source<'_>, channel: &[Record]) -> Result<Draft, GroundMotionError> {
    let first = &channel[0];
    for (before, after) in channel.iter().zip(&channel[1..]) {
        let gap = clock_gap(before, after) + leap_seconds(before, after);
        if (after.rate - before.rate).abs() > 1.0e-4 * before.rate {
            return Err(source.binary_error(
                after.at,
                format!("the rate changes from {} to {} Hz", before.rate, after.rate),
            ));
        }
        if gap.abs() > 0.5 / before.rate {
            return Err(source.binary_error(
                after.at,
                format!(
                    "{} of {:.4} s before this record of {}: an excitation must be continuous",
                    if gap > 0.0 { "a gap" } else { "an overlap" },
                    gap.abs(),
                    after.label()
                ),
            ));
        }
    }
    // Gaps too short to be refused may add up, as those of a clock or of a rate that is wrong do.
    let mut counted = 0;
    let mut inserted = 0.0;
    let mut latest = (0.0_f64, first);
    for (i, record) in channel.iter().enumerate() {
        if i > 0 {
            inserted += leap_seconds(&channel[i - 1], record);
        }
        let clock = (record.start - first.start) as f64 * 1.0e-6;
        let late = clock + inserted - counted as f64 / first.rate;
        if late.abs() > latest.0.abs() {
            latest = (late, record);
        }
        counted += record.count;
    }
    let total = channel.iter().map(|r| r.count).sum();
    let mut samples = Vec::with_capacity(total);
    let mut longer = None;
    for record in channel {
        if record.decode(source, &mut samples)? {
            longer.get_or_insert(record);
        }
    }
    let unit = match source.options.sensitivity {
        None if in_floats(channel) => DraftUnit::Unstated,
        _ => DraftUnit::Counts,
    };
    let mut draft = Draft::new(samples, unit, (1, 1, 1));
    draft.title = first.label();
    draft.start_time = first.start_text.to_string();
    draft.times = Times::Step(Some(1.0 / first.rate));
    draft.header_count = Some(total);
    draft.processing = Processing::Raw;
    let differs =
        |r: &&Record| r.nominal > 0.0 && (r.rate - r.nominal).abs() > RATE_TOLERANCE * r.nominal;
    if let Some(record) = channel.iter().find(differs) {
        draft.warnings.push(format!(
            "the record at byte {} has {} samples per second by its blockette 100, which is used, but {} by its fixed header",
            record.at,
            bound(record.rate),
            bound(record.nominal)
        ));
    }
    if let Some(record) = longer {
        draft.warnings.push(format!(
            "data stand behind the {} samples that the header of the record at byte {} counts: they were passed over",
            record.count, record.at
        ));
    }
    let (late, record) = latest;
    if late.abs() > 0.5 / first.rate {
        draft.warnings.push(format!(
            "the record at byte {} starts {:.4} s {} than the samples before it say, {:.1} samples: gaps or overlaps of less than half a sample add up; the samples are taken one after another",
            record.at,
            late.abs(),
            if late > 0.0 { "later" } else { "earlier" },
            late.abs() * first.rate
        ));
    }
    Ok(draft)
}
