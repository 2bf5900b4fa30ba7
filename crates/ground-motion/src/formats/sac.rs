//! SAC, binary: 158 words of header, then values of four bytes. Its unit is not
//! reliable, so the user states it.

use crate::direction::Orientation;
use crate::draft::{Draft, DraftPeak, DraftUnit};
use crate::error::{GroundMotionError, bound};
use crate::format::Format;
use crate::instrument::may_accelerate;
use crate::origin::Processing;
use crate::quantity::Quantity;
use crate::recording::Series;
use crate::source::Source;
use crate::start_times::later;
use crate::text::latin_1;
use crate::time_column::{Times, even_step_in_single};

const HEADER: usize = 632;
const VERSION: usize = 76;
/// Word of the kind of the values, and first byte of the component's name.
const KIND: usize = 86;
const COMPONENT: usize = 600;
/// Azimuth of the component, and its angle from upwards (degrees).
const AZIMUTH: usize = 57;
const INCIDENCE: usize = 58;
/// Time of the first sample after the reference time (s).
const BEGIN: usize = 5;
/// Mean of the samples, in their unit.
const MEAN: usize = 56;
/// Part of the largest sample by which a mean that was summed up in single precision may differ.
const MEAN_TOLERANCE: f64 = 1.0e-3;
const UNDEFINED: f32 = -12345.0;

/// Bytes of the 22 doubles behind the data of version 7, of which the first is the time step.
const FOOTER: usize = 176;
/// Least and largest sample, and a factor that programs other than SAC write.
const LEAST: usize = 1;
const LARGEST: usize = 2;
const SCALE: usize = 3;

/// The bytes with their order.
struct Words<'a> {
    bytes: &'a [u8],
    big: bool,
}

impl Words<'_> {
    fn four(&self, offset: usize) -> [u8; 4] {
        let mut four = [0; 4];
        if let Some(found) = self.bytes.get(offset..offset + 4) {
            four.copy_from_slice(found);
        }
        four
    }

    fn float_at(&self, offset: usize) -> f32 {
        let four = self.four(offset);
        if self.big {
            f32::from_be_bytes(four)
        } else {
            f32::from_le_bytes(four)
        }
    }

    fn double_at(&self, offset: usize) -> Option<f64> {
        let mut eight = [0; 8];
        eight.copy_from_slice(self.bytes.get(offset..offset + 8)?);
        Some(match self.big {
            true => f64::from_be_bytes(eight),
            false => f64::from_le_bytes(eight),
        })
    }

    /// Word `index` (from 0) as a number, unless it is undefined.
    fn float(&self, index: usize) -> Option<f64> {
        let value = self.float_at(4 * index);
        (value.is_finite() && value != UNDEFINED).then_some(f64::from(value))
    }

    fn integer(&self, index: usize) -> i32 {
        let four = self.four(4 * index);
        if self.big {
            i32::from_be_bytes(four)
        } else {
            i32::from_le_bytes(four)
        }
    }

    fn text(&self, from: usize) -> String {
        let field = self.bytes.get(from..from + 8).unwrap_or(&[]);
        let text = latin_1(field).trim().to_owned();
        if text.starts_with("-12345") {
            String::new()
        } else {
            text
        }
    }
}

/// The byte order in which the version is 6 or 7.
fn words<'a>(bytes: &'a [u8]) -> Option<Words<'a>> {
    [false, true]
        .into_iter()
        .map(|big| Words { bytes, big })
        .find(|w| bytes.len() >= HEADER && [6, 7].contains(&w.integer(VERSION)))
}

pub(super) static FORMAT: Format = Format {
    name: "sac",
    title: "SAC, binary, either byte order",
    source: "Seismic Analysis Code",
    recognised_by: "version 6 or 7 in word 77 of the header, in either byte order",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    words(source.bytes).is_some()
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let Some(words) = words(source.bytes) else {
        let offset = source.bytes.len().min(4 * VERSION);
        return Err(source.binary_error(offset, "no SAC header of version 6 or 7"));
    };
    if words.integer(85) == -12345 {
        source.warn("the header does not say that the file is a time series (IFTYPE is undefined): taken for one");
    } else if words.integer(85) != 1 {
        return Err(GroundMotionError::Unsupported {
            file: source.file.to_owned(),
            what: format!("SAC file of type {}, not a time series", words.integer(85)),
            remedy: "use the time series (iftype ITIME) of the same record",
        });
    }
    acceleration(source, &words)?;
    let stated = words.integer(79);
    let count = usize::try_from(stated).unwrap_or(0);
    let uneven = words.integer(105) == 0;
    let data = source.bytes.len() - HEADER;
    let width: usize = if uneven { 8 } else { 4 };
    // Version 7 has 22 doubles after the data; some programs leave them out.
    let without = words.integer(VERSION) != 7
        || data == width.saturating_mul(count) && !ends_in_footer(&words, data);
    let footer = if without { 0 } else { FOOTER };
    let present = data.saturating_sub(footer) / width;
    let surplus = present > count;
    if uneven && count >= 2 && present < count && data / 4 >= count {
        return Err(GroundMotionError::Unsupported {
            file: source.file.to_owned(),
            what: format!(
                "the header says that the file is unevenly spaced (LEVEN is false): the times of its {count} samples must stand behind them, but it holds {} numbers in all",
                data / 4
            ),
            remedy: "get the record with its times or at even steps, as `interpolate` of SAC writes it; where its steps are even, the header is wrong: set LEVEN",
        });
    }
    let lenient = source.options.lenient && !uneven;
    if (present < count || surplus) && !lenient || count < 2 {
        return Err(source.binary_error(
            source
                .bytes
                .len()
                .min(HEADER.saturating_add(width.saturating_mul(count))),
            format!("the header says {stated} samples, the file holds {present}"),
        ));
    }
    // The shortest decimal that is this single-precision number: 0.005, not
    // 0.004999999888.
    let step = words
        .float(0)
        .and_then(|delta| format!("{}", delta as f32).parse::<f64>().ok());
    if footer > 0 && !uneven {
        same_step(source, &words, HEADER + width * count)?;
    }
    let samples = values(source, &words, HEADER, count.min(present))?;
    // The header has no unit that can be relied on; a sensitivity says that there are counts.
    let unit = match source.options.sensitivity {
        Some(_) => DraftUnit::Counts,
        None => DraftUnit::Unstated,
    };
    let mut draft = Draft::new(samples, unit, (1, 1, 1));
    draft.header_count = Some(count);
    draft.times = if uneven {
        let times = values(source, &words, HEADER + 4 * count, count)?;
        match even_step_in_single(&times) {
            Some(step) => Times::Step(Some(step)),
            None => Times::Each(times),
        }
    } else {
        Times::Step(step)
    };
    let ends = words.float(6).zip(words.float(5)).map(|(e, b)| e - b);
    let length = ends.filter(|length| !uneven && *length > 0.0);
    draft.header_durations = length.map(Into::into).into_iter().collect();
    if surplus {
        draft.warnings.push(format!(
            "header says {count} samples, {present} found; the surplus is not used"
        ));
    }
    draft.warnings.extend(other_mean(&words, &draft.samples));
    draft.warnings.extend(other_ends(&words, &draft.samples));
    draft.warnings.extend(factor(&words));
    draft.warnings.extend(no_direction(&words));
    fill(&words, &mut draft);
    // Counts are as the instrument gave them.
    if source.options.sensitivity.is_some() {
        draft.processing = Processing::Raw;
    }
    Ok(vec![draft.finish(source)?])
}

/// Whether so many bytes behind the header end in the doubles of version 7: with a time step that is that of the header.
fn ends_in_footer(words: &Words<'_>, data: usize) -> bool {
    let double = data
        .checked_sub(FOOTER)
        .and_then(|at| words.double_at(HEADER + at));
    let agrees = |(double, step): (f64, f64)| (double - step).abs() <= 1.0e-6 * step.abs();
    double.zip(words.float(0)).is_some_and(agrees)
}

/// Refuses a step in double precision, the first number behind the data of version 7, that is not
/// the one of the header.
fn same_step(source: &Source<'_>, words: &Words<'_>, at: usize) -> Result<(), GroundMotionError> {
    let (Some(double), Some(step)) = (words.double_at(at), words.float(0)) else {
        return Ok(());
    };
    let stated = double.is_finite() && double != f64::from(UNDEFINED);
    if stated && (double - step).abs() > 1.0e-6 * step.abs() && !source.options.lenient {
        let message = format!(
            "the time step is {double} s here, but {} s in the header",
            step as f32
        );
        return Err(source.binary_error(at, message));
    }
    Ok(())
}

/// Refuses what the header says to be no acceleration: by IDEP (word 87), or where that says
/// nothing, by the code of the instrument in the component's name.
fn acceleration(source: &Source<'_>, words: &Words<'_>) -> Result<(), GroundMotionError> {
    let of_other = |quantity: Quantity| GroundMotionError::NotAcceleration {
        file: source.file.to_owned(),
        quantity: quantity.name(),
    };
    let unsupported = |what: String, remedy: &'static str| GroundMotionError::Unsupported {
        file: source.file.to_owned(),
        what,
        remedy,
    };
    match words.integer(KIND) {
        8 => Ok(()),
        6 => Err(of_other(Quantity::Displacement)),
        7 => Err(of_other(Quantity::Velocity)),
        5 | -12345 => may_accelerate(
            source,
            &words.text(COMPONENT),
            "the header does not say what the values are (IDEP)",
            "use the channel of an accelerograph, or set IDEP to IACC where the values are accelerations",
        ),
        50 => Err(unsupported(
            "the header says that the values are volts (IDEP is IVOLTS)".to_owned(),
            "use the file of the accelerations (IDEP IACC)",
        )),
        other => Err(unsupported(
            format!(
                "the header says that the values are of kind {other} (IDEP), not accelerations"
            ),
            "use the file of the accelerations (IDEP IACC)",
        )),
    }
}

fn values(
    source: &Source<'_>,
    words: &Words<'_>,
    from: usize,
    count: usize,
) -> Result<Vec<f64>, GroundMotionError> {
    let mut values = Vec::with_capacity(count);
    for i in 0..count {
        let value = words.float_at(from + 4 * i);
        if !(value.abs() < 1.0e37) {
            return Err(source.binary_error(
                from + 4 * i,
                format!("sample {} is {value}: it is missing or damaged", i + 1),
            ));
        }
        values.push(f64::from(value));
    }
    Ok(values)
}

/// What to say of a mean in the header that is not that of the samples; a zero is a field that may not
/// have been filled in.
fn other_mean(words: &Words<'_>, samples: &[f64]) -> Option<String> {
    let stated = words.float(MEAN).filter(|mean| *mean != 0.0)?;
    let found = samples.iter().sum::<f64>() / samples.len() as f64;
    let largest = samples.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    ((stated - found).abs() > MEAN_TOLERANCE * largest).then(|| {
        format!(
            "the header says a mean of {} (DEPMEN), that of the samples is {}",
            bound(stated),
            bound(found)
        )
    })
}

/// What to say of a least or largest sample in the header that is not that of the samples. The one of the larger
/// magnitude is the peak, which is refused where both are stated; a zero may not have been filled in.
fn other_ends(words: &Words<'_>, samples: &[f64]) -> Vec<String> {
    let least = samples.iter().copied().fold(f64::INFINITY, f64::min);
    let most = samples.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let size = least.abs().max(most.abs());
    let ends = [
        (LEAST, "least value", "DEPMIN", least),
        (LARGEST, "largest value", "DEPMAX", most),
    ];
    let other = |(word, what, name, found): (usize, &str, &str, f64)| {
        let stated = words.float(word).filter(|stated| *stated != 0.0)?;
        ((stated - found).abs() > 1.0e-6 * size).then(|| {
            format!(
                "the header says a {what} of {} ({name}), that of the samples is {}",
                bound(stated),
                bound(found)
            )
        })
    };
    ends.into_iter().filter_map(other).collect()
}

/// What to say of a factor in the header, which SAC does not use and data centres fill with the sensitivity.
fn factor(words: &Words<'_>) -> Option<String> {
    let scale = words
        .float(SCALE)
        .filter(|scale| *scale != 0.0 && *scale != 1.0)?;
    Some(format!(
        "the header has a factor of {} (SCALE), which is not applied: it may be the sensitivity of the instrument, counts for each unit",
        bound(scale)
    ))
}

/// What to say of angles of the component in the header that are none: no direction is known of it by them.
fn no_direction(words: &Words<'_>) -> Option<String> {
    const LEVEL: f64 = 90.0;
    let angles = [("CMPAZ", AZIMUTH), ("CMPINC", INCIDENCE)];
    let of = |word: usize, usual: f64| words.float(word).unwrap_or(usual);
    if Orientation::of(of(AZIMUTH, 0.0), of(INCIDENCE, LEVEL) - LEVEL).is_some() {
        return None;
    }
    let stated = angles.iter().filter_map(|(name, word)| {
        let degrees = words.float(*word)?;
        Some(format!("{name} of {} degrees", bound(degrees)))
    });
    let stated: Vec<String> = stated.collect();
    Some(format!(
        "the header says a {}, which is no direction and is not used",
        stated.join(" and a ")
    ))
}

/// Time of the first sample: the reference time and B (word 6) after it. Empty where the header
/// leaves a part of the reference out.
fn start_time(words: &Words<'_>) -> String {
    let [year, day, hour, minute, second, thousandths] =
        [70, 71, 72, 73, 74, 75].map(|index| words.integer(index));
    if [year, day, hour, minute, second, thousandths].contains(&-12345) {
        return String::new();
    }
    let reference =
        format!("{year} day {day} {hour:02}:{minute:02}:{second:02}.{thousandths:03} UTC");
    let begin = words.float(BEGIN).unwrap_or(0.0);
    // In single precision: 0.005, not 0.004999999888.
    let begin = format!("{}", begin as f32).parse().unwrap_or(begin);
    later(&reference, begin).unwrap_or_default()
}

fn fill(words: &Words<'_>, draft: &mut Draft) {
    draft.component = words.text(COMPONENT);
    draft.orientation = words
        .float(AZIMUTH)
        .zip(words.float(INCIDENCE))
        .and_then(|(azimuth, incidence)| Orientation::of(azimuth, incidence - 90.0));
    draft.title = format!("{} {}", words.text(608), words.text(440))
        .trim()
        .to_owned();
    draft.processing = Processing::Unstated;
    draft.start_time = start_time(words);
    let (low, high) = (words.float(LEAST), words.float(LARGEST));
    draft.peak = low.zip(high).map(|(low, high)| DraftPeak {
        value: {
            let peak = if high.abs() >= low.abs() { high } else { low };
            (peak, 1.0e-6 * peak.abs())
        },
        time: None,
        unit: None,
        shift: 0.0,
        line: None,
        of_sign: false,
    });
}
