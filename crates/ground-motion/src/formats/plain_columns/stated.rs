//! What lines before the rows state of unit, step, count and peak under a key: `# dt: 0.01 s`,
//! `Units = cm/s2`, `Sampling rate (Hz): 100`, `NPTS: 400`, `PGA: 0.3 g`. It is used where the user
//! says nothing, and held against what the user and the rows say.

use super::stated_unit::{Unit, unit_of};
use super::{faults, header, names};
use crate::draft::{Draft, DraftPeak, NamedQuantity, StatedDuration, decimated, not_applied};
use crate::error::{GroundMotionError, bound};
use crate::header_keys::{self, Entry, Meaning, is_of_rate, keyed, meaning};
use crate::number::{self, Printed};
use crate::quantity::{Quantity, SeriesUnit};
use crate::source::Source;
use crate::stated_step::{STEP_TOLERANCE, frequency_not_used};
use crate::text::Line;

/// Keys of our CSV that tell how a record was made from another one.
const HISTORY: [&str; 6] = ["source", "step", "read", "note", "event", "station"];
/// Words behind a step or a rate by which it is that of another stage of the record, or not the last one said.
const OF_OTHER_STAGES: [&str; 8] = [
    "interpolat",
    "decimat",
    "resampl",
    "now ",
    "(original",
    "original)",
    "every ",
    "this file",
];
/// Step (s) from which on a `delta` without a unit is none beside a count: one of a distance in degrees.
const LONGEST_DELTA: f64 = 0.1;
/// Number from which on one under the letter N is no count of storeys or piles.
const LEAST_COUNT: f64 = 20.0;

/// Something that a line states.
struct At<T> {
    line: usize,
    value: T,
}

/// A stated time step (s).
struct Step {
    seconds: f64,
    is_rate: bool,
}

/// A stated largest acceleration.
#[derive(Clone, Copy)]
struct Peak {
    value: Printed,
    /// Digits of it but zeros before the first other one.
    digits: usize,
    unit: Option<SeriesUnit>,
    /// Its time (s).
    time: Option<Printed>,
    /// Whether it is one of the values themselves: it stands beside count and step, or has a time.
    is_of_values: bool,
}

/// Digits that a peak must have to tell in which unit the values are.
const SURE_DIGITS: usize = 3;

/// What the lines before the rows state.
#[derive(Default)]
pub(super) struct Stated {
    unit: Option<At<SeriesUnit>>,
    steps: Vec<At<Step>>,
    counts: Vec<At<usize>>,
    /// Numbers under the letter N, or under a length without a unit, which may be counts.
    letters: Vec<At<(&'static str, usize)>>,
    peaks: Vec<At<Peak>>,
    durations: Vec<At<f64>>,
    /// What the values are, in words.
    quantities: Vec<At<(Quantity, String)>>,
    /// Factors that are not applied.
    factors: Vec<At<f64>>,
    /// Of how many samples one was kept.
    decimations: Vec<At<f64>>,
    /// A `delta` without a unit: a step (s), or a distance.
    delta: Option<At<f64>>,
    /// Step (s) of a frequency that may be the rate of sampling: it counts where nothing else does, and is only
    /// named where it is not that of the samples.
    frequency: Option<At<f64>>,
    /// A g (m/s2) in which the values may be.
    gravities: Vec<At<f64>>,
}

impl Stated {
    /// What the lines state, but for the unit in those of which `without_unit` says so.
    ///
    /// # Errors
    /// Two units, one of another quantity, one that is not known, or another than the user gives.
    pub(super) fn before<'a>(
        source: &Source<'a>,
        lines: impl Iterator<Item = Line<'a>>,
        without_unit: impl Fn(usize) -> bool,
    ) -> Result<Self, GroundMotionError> {
        let mut stated = Self::default();
        for line in lines {
            if line.bytes.len() > header::LONGEST {
                continue;
            }
            let lower = header::without_formats(&without_cells(lower(&line)));
            if is_history(&lower) {
                continue;
            }
            if !without_unit(line.number) {
                stated.unit(source, line, &lower)?;
            }
            seconds(source, line, &lower)?;
            let at = |value| At {
                line: line.number,
                value,
            };
            stated
                .gravities
                .extend(header_keys::gravity(&lower).map(at));
            stated.numbers(line.number, &lower);
        }
        if stated.steps.is_empty()
            && source.options.time_step.is_none()
            && let Some(At { line, value }) = stated.frequency.take()
        {
            stated.state_step(line, value, true);
        }
        // As the headers of SAC have it.
        if stated.steps.is_empty()
            && !stated.counts.is_empty()
            && let Some(At { line, value }) = stated.delta.take_if(|d| d.value < LONGEST_DELTA)
        {
            stated.state_step(line, value, false);
        }
        Ok(stated)
    }

    fn unit(
        &mut self,
        source: &Source<'_>,
        line: Line<'_>,
        lower: &str,
    ) -> Result<(), GroundMotionError> {
        let unit = match unit_of(lower) {
            Unit::None => return Ok(()),
            Unit::Known(unit) => unit,
            Unit::Unknown(text) => {
                return Err(source.error(
                    line.number,
                    0,
                    format!("the unit \"{text}\" that is stated here is none of acceleration"),
                    "give the record in m/s2, cm/s2, g or the like; counts, volts and forces are not read. If the line says nothing of the values, pass it over by `skip_lines`",
                ));
            }
        };
        if unit.quantity != Quantity::Acceleration {
            let fault = faults::Fault::NoAcceleration(unit.quantity, unit.symbol.to_owned());
            let (line, text) = (line.number, line.text().trim().to_owned());
            return Err(super::Faulty { line, text, fault }.error(source));
        }
        if let Some(first) = self.unit.as_ref().filter(|first| first.value != unit) {
            return Err(source.error(
                line.number,
                0,
                format!(
                    "the unit is {} here, but {} in line {}",
                    unit.symbol, first.value.symbol, first.line
                ),
                "the lines before the rows contradict one another: correct them, or get the record again",
            ));
        }
        if let Some(given) = source.options.unit.filter(|given| !unit.is(*given)) {
            return Err(GroundMotionError::Contradiction {
                file: source.file.to_owned(),
                quantity: "unit",
                stated: format!("{} (line {})", unit.symbol, line.number),
                given: SeriesUnit::from(given).symbol.to_owned(),
            });
        }
        self.unit.get_or_insert(At {
            line: line.number,
            value: unit,
        });
        Ok(())
    }

    fn state_step(&mut self, line: usize, seconds: f64, is_rate: bool) {
        if seconds > 0.0 && seconds.is_finite() {
            let value = Step { seconds, is_rate };
            self.steps.push(At { line, value });
        }
    }

    fn numbers(&mut self, line: usize, lower: &str) {
        let entries = keyed(lower);
        // Behind a key stands its own number first: others are of filters and recorders, unless the record
        // was brought from one to the other.
        let changed = lower.contains("decimated to") || lower.contains("resampled to");
        if changed || !entries.iter().any(is_of_rate) {
            let own = header_keys::behind_rate(lower).and_then(number::first_in);
            for (seconds, _) in number::rates(lower) {
                let is_own = own.is_none_or(|(rate, _)| (seconds * rate - 1.0).abs() < 1.0e-9);
                if changed || is_own {
                    self.state_step(line, seconds, true);
                }
            }
        }
        let at = |value| At { line, value };
        self.factors
            .extend(header_keys::factors(lower).into_iter().map(at));
        self.decimations
            .extend(header_keys::decimation(lower).map(at));
        let has_step = |entry: &Entry<'_>| {
            let of_time = matches!(meaning(entry), Some(Meaning::Step | Meaning::Rate));
            of_time && entry.has_number()
        };
        let beside_step = entries.iter().any(has_step);
        // Beside a time step, N counts the samples: `N =  4096 DT =  0.020`.
        let count = count_n(&entries).filter(|_| beside_step);
        match count {
            Some(value) => self.counts.push(At { line, value }),
            None => {
                let letters = letters(&entries);
                self.letters
                    .extend(letters.into_iter().map(|value| At { line, value }));
            }
        }
        for (i, entry) in entries.iter().enumerate() {
            let next = entries.get(i + 1);
            // What follows a number may be the key behind it.
            let begins_next = |word: &str| next.is_some_and(|next| next.key.starts_with(word));
            if entry.is_of_time()
                && let Some((found, digits, unit)) = entry.number()
                && let Some(peak) = self.peaks.last_mut().filter(|peak| peak.line == line)
                && ["", "s", "sec"].contains(&unit)
            {
                let time = (found, number::resolution(digits.as_bytes()));
                peak.value.time.get_or_insert(time);
            }
            let Some(meaning) = meaning(entry) else {
                continue;
            };
            if meaning == Meaning::Quantity {
                let value = named_quantity(entry.value);
                self.quantities
                    .extend(value.map(|value| At { line, value }));
                continue;
            }
            let Some((found, digits, behind)) = entry.number() else {
                continue;
            };
            let of_time = matches!(meaning, Meaning::Step | Meaning::StepByUnit | Meaning::Rate);
            // `200 Hz (decimated from 1000 Hz)` is that of the record.
            let of_other = OF_OTHER_STAGES
                .iter()
                .any(|words| entry.value.contains(words));
            if of_time && of_other && !entry.value.contains("ed from") {
                continue;
            }
            let inside = entry.unit_of_key();
            let inside = inside.as_deref();
            let unit = match behind {
                "" => inside.unwrap_or_default(),
                unit => unit,
            };
            let seconds = match unit {
                "" => Some(1.0),
                unit => names::time_unit(unit),
            };
            let hertz = header_keys::is_rate_unit(unit);
            let mut step = |seconds, is_rate| self.state_step(line, seconds, is_rate);
            match meaning {
                // A rate under a key of a step says so.
                Meaning::Step => match seconds {
                    Some(one) => step(found * one, false),
                    None if hertz => step(1.0 / found, true),
                    None => {}
                },
                Meaning::StepByUnit if entry.key == "delta" && unit.is_empty() => {
                    self.delta = Some(At { line, value: found });
                }
                // An interval of a second and more is that of a window.
                Meaning::StepByUnit => {
                    let rest = entry.value[digits.len()..].trim();
                    let alone = rest == behind || rest.trim_end_matches('.') == behind;
                    let own = seconds.filter(|one| alone && !unit.is_empty() && found * one < 1.0);
                    step(own.map_or(0.0, |one| found * one), false);
                }
                Meaning::Rate if ["khz", "kilohertz"].contains(&unit) => step(1.0e-3 / found, true),
                Meaning::Rate => {
                    let worded = number::rates(&format!("sampling {}", entry.value));
                    let same = |(seconds, _): &&(f64, f64)| (seconds * found - 1.0).abs() < 1.0e-9;
                    if hertz || worded.first().filter(same).is_some() {
                        step(1.0 / found, true);
                    }
                }
                // Else that of a sine, a filter or a building.
                Meaning::Frequency => match header_keys::lone_rate(lower) {
                    Some((rate, true)) => step(1.0 / rate, true),
                    Some((rate, false)) => {
                        let value = 1.0 / rate;
                        self.frequency = Some(At { line, value });
                    }
                    None => {}
                },
                Meaning::Count
                    if found >= 2.0
                        && found.fract() == 0.0
                        && (["", "points", "samples", "values", "pts"].contains(&unit)
                            || behind.is_empty() && ["n", "npts", "-", "#"].contains(&unit)
                            || begins_next(unit)) =>
                {
                    let value = found as usize;
                    self.counts.push(At { line, value });
                }
                // `Duration (5-95 %)` is that of a part.
                Meaning::Duration
                    if found > 0.0 && inside.is_none_or(|u| names::time_unit(u).is_some()) =>
                {
                    let value = seconds.map(|one| found * one);
                    self.durations.extend(value.map(|value| At { line, value }));
                }
                Meaning::Peak => {
                    let printed = |digits: &str| number::resolution(digits.as_bytes());
                    let stated = names::motion_unit(unit);
                    let accelerates = |unit: &SeriesUnit| unit.quantity == Quantity::Acceleration;
                    let bare = stated.is_none()
                        && (["", "at"].contains(&unit) || begins_next(unit) || entry.is_followed());
                    if !(bare || stated.as_ref().is_some_and(accelerates)) {
                        continue;
                    }
                    let time = entry.time().map(|(time, digits)| (time, printed(digits)));
                    // Without a unit it may be of anything that the line names.
                    if stated.is_none() && count.is_none() && !is_of_the_values(lower, entry.key) {
                        continue;
                    }
                    let value = Peak {
                        value: (found, printed(digits)),
                        digits: significant(digits),
                        unit: stated,
                        time,
                        is_of_values: count.is_some() || time.is_some(),
                    };
                    self.peaks.push(At { line, value });
                }
                _ => {}
            }
        }
        let is_rate = |step: &At<Step>| step.line == line && step.value.is_rate;
        if self.steps.last().is_some_and(is_rate)
            && !header_keys::is_of_another(lower)
            && let Some(seconds) = step_beside_rate(lower)
        {
            self.state_step(line, seconds, false);
        }
    }

    /// The unit of the first peak whose number is that of the largest of these values, with what to say of it.
    pub(super) fn unit_of_peak(&self, samples: &[f64]) -> Option<(SeriesUnit, String)> {
        let largest = samples.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        self.peaks.iter().find_map(|At { line, value: peak }| {
            let (value, digit) = (peak.value.0.abs(), peak.value.1);
            let near = (largest - value).abs() <= digit.max(1.0e-4 * value);
            let unit = peak.unit.filter(|_| near && peak.digits >= SURE_DIGITS)?;
            Some((
                unit,
                format!(
                    "line {line}: the unit of the values is that of the peak, {value} {}, which is the largest of them",
                    unit.symbol
                ),
            ))
        })
    }

    /// The counts of samples.
    pub(super) fn counted(&self) -> Vec<usize> {
        self.counts.iter().map(|count| count.value).collect()
    }

    /// The time step (s) that is stated first.
    pub(super) fn first_step(&self) -> Option<f64> {
        self.steps.first().map(|step| step.value.seconds)
    }

    /// The unit of values that no column states.
    pub(super) fn unit_of_values(&self) -> Option<SeriesUnit> {
        self.unit.as_ref().map(|u| u.value)
    }

    /// Refuses another unit than that which a header states for a column.
    pub(super) fn agrees(
        &self,
        source: &Source<'_>,
        unit: SeriesUnit,
        header: &str,
    ) -> Result<(), GroundMotionError> {
        match self.unit.as_ref().filter(|stated| stated.value != unit) {
            Some(stated) => Err(source.error(
                stated.line,
                0,
                format!(
                    "unit \"{}\" contradicts the column header \"{header}\"",
                    stated.value.symbol
                ),
                "make both the same",
            )),
            None => Ok(()),
        }
    }

    /// The step (s) of values for which the rows say `found`.
    ///
    /// # Errors
    /// Another one than the rows or the user say; two, where neither says which is right.
    pub(super) fn step(
        &self,
        source: &Source<'_>,
        found: Option<f64>,
    ) -> Result<Option<f64>, GroundMotionError> {
        let known = found.or(source.options.time_step);
        let Some(first) = self.steps.first() else {
            return match (&self.delta, known) {
                (Some(delta), None) => Err(source.error(
                    delta.line,
                    0,
                    format!(
                        "the record does not state its time step: {} under \"delta\" has no unit, and may be a distance",
                        delta.value
                    ),
                    "if it is the time step, write its unit or another key, `dt: 0.01 s`; or give `time_step`, `--time-step` with `pounding motion`",
                )),
                _ => {
                    self.warn_of_frequency(source, known);
                    Ok(found)
                }
            };
        };
        self.warn_of_frequency(source, known.or(Some(first.value.seconds)));
        let same = |step: f64| {
            let near = move |s: &&At<Step>| {
                (s.value.seconds - step).abs() <= STEP_TOLERANCE * s.value.seconds
            };
            self.steps.iter().find(near)
        };
        match (found, source.options.time_step) {
            (Some(found), _) => match (same(found), self.steps.iter().find(|s| !s.value.is_rate)) {
                (Some(same), _) if !same.value.is_rate => Ok(Some(same.value.seconds)),
                (Some(_), _) => Ok(Some(found)),
                (None, Some(stated)) => Err(source.error(
                    stated.line,
                    0,
                    format!(
                        "the time step is {} s here, but the values are {} s apart",
                        bound(stated.value.seconds),
                        bound(found)
                    ),
                    "make both the same, or get the record again",
                )),
                (None, None) => {
                    source.warn(&format!(
                        "line {}: the header says {} samples/s, but the values are {} s apart, which is used",
                        first.line,
                        bound(1.0 / first.value.seconds),
                        bound(found)
                    ));
                    Ok(Some(found))
                }
            },
            (None, Some(given)) if same(given).is_some() => Ok(None),
            (None, Some(given)) => Err(GroundMotionError::Contradiction {
                file: source.file.to_owned(),
                quantity: "time_step",
                stated: format!("{} s (line {})", bound(first.value.seconds), first.line),
                given: format!("{given} s"),
            }),
            (None, None) => {
                let differs = |s: &&At<Step>| {
                    (s.value.seconds - first.value.seconds).abs()
                        > STEP_TOLERANCE * first.value.seconds
                };
                match self.steps.iter().find(differs) {
                    None => {
                        for At { line, value } in &self.decimations {
                            source.warn(&decimated(*line, *value));
                        }
                        Ok(Some(first.value.seconds))
                    }
                    Some(other) => Err(source.error(
                        other.line,
                        0,
                        format!(
                            "the time step is {} s here, but {} s in line {}",
                            bound(other.value.seconds),
                            bound(first.value.seconds),
                            first.line
                        ),
                        "say which one is right by `time_step`, `--time-step` with `pounding motion`",
                    )),
                }
            }
        }
    }

    /// Says that a frequency is not that of the samples, where their step (s) is known.
    fn warn_of_frequency(&self, source: &Source<'_>, used: Option<f64>) {
        if let (Some(At { line, value }), Some(used)) = (&self.frequency, used)
            && let Some(told) = frequency_not_used(*line, *value, used)
        {
            source.warn(&told);
        }
    }

    /// States to a draft what it is held against; `numbers` are all that stand in the rows.
    pub(super) fn state(&self, draft: &mut Draft, numbers: usize) {
        for At { line, value: peak } in &self.peaks {
            let stated = DraftPeak {
                value: peak.value,
                time: peak.time,
                unit: peak.unit,
                shift: 0.0,
                line: Some(*line),
                of_sign: false,
            };
            match peak.unit {
                Some(_) => draft.other_peaks.push(stated),
                None => draft.bare_peaks.push((stated, peak.is_of_values)),
            }
        }
        for At { line, value } in &self.durations {
            draft.other_durations.push(StatedDuration {
                seconds: *value,
                line: Some(*line),
            });
        }
        for At { line, value } in &self.quantities {
            let (quantity, text) = value.clone();
            let line = *line;
            draft.quantities.push(NamedQuantity {
                quantity,
                text,
                line,
            });
        }
        let gravities = self.gravities.iter().map(|g| (g.line, g.value));
        draft.gravities.extend(gravities);
        for At { line, value } in &self.factors {
            draft.warnings.push(not_applied(*line, *value));
        }
        self.count(draft, numbers);
    }

    fn count(&self, draft: &mut Draft, numbers: usize) {
        let found = draft.samples.len();
        for At { line, value } in &self.letters {
            let (key, value) = *value;
            // A length may be one of time.
            let seconds = self.first_step().map(|step| step * found as f64);
            let near = |seconds: f64| (seconds - value as f64).abs() <= 1.0;
            let lasts = key != "N" && seconds.is_some_and(near);
            if ![found, numbers].contains(&value) && !lasts {
                draft.warnings.push(format!(
                    "line {line}: {key} is {value} here, but {found} samples are read"
                ));
            }
        }
        for count in &self.counts {
            if count.value == numbers && count.value != found {
                draft.warnings.push(format!(
                    "line {}: the header says {numbers} samples, which are all numbers of the rows: {found} samples are read",
                    count.line
                ));
            } else if draft.header_count.is_none() {
                draft.header_count = Some(count.value);
                draft.row.get_or_insert(1);
            } else {
                draft.other_counts.push((count.line, count.value));
            }
        }
    }
}

/// The step (s) right behind a rate of sampling, behind a comma or a sign of equality or in brackets, in a line that
/// states nothing else: `sampling rate 200 hz, 0.005 s`. Longer ones are durations, and those behind other words, `low-pass 25 hz, 0.05 s`, of
/// something else.
fn step_beside_rate(lower: &str) -> Option<f64> {
    let bare = lower.trim_end_matches([' ', '\t', '.', ')', ']']);
    let (rate, step) = bare.rsplit_once([',', ';', '(', '[', '='])?;
    let entries = keyed(rate);
    let [entry] = entries.as_slice() else {
        return None;
    };
    let (_, digits, _) = entry.number()?;
    let unit = entry.value[digits.len()..].trim().trim_end_matches('.');
    let is_rate = meaning(entry) == Some(Meaning::Rate)
        && !rate.contains([',', ';', '|', '(', '['])
        && !unit.is_empty()
        && header_keys::is_rate_unit(unit);
    let step = step.trim();
    let number = step.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let one = names::time_unit(&step[number.len()..]).filter(|_| is_rate)?;
    let seconds = one * number::parse(number.trim_end().as_bytes()).ok()?;
    (seconds > 0.0 && seconds <= LONGEST_DELTA).then_some(seconds)
}

/// Refuses another unit of the times than the second under a key, which the rows do not know of: `Time unit: ms`.
fn seconds(source: &Source<'_>, line: Line<'_>, lower: &str) -> Result<(), GroundMotionError> {
    const KEYS: [&str; 5] = [
        "time unit",
        "time units",
        "unit of time",
        "x unit",
        "x units",
    ];
    let other = keyed(lower).into_iter().find_map(|entry| {
        let key = entry.key.replace(['-', '_'], " ");
        let unit = entry.value.split([',', ';', ' ']).next()?;
        let one = names::time_unit(unit).filter(|_| KEYS.contains(&key.trim()))?;
        (one != 1.0).then(|| unit.to_owned())
    });
    match other {
        Some(unit) if source.options.layout.is_none() => Err(source.error(
            line.number,
            0,
            format!("the times are in {unit} here, and are read in seconds"),
            "name the column with its unit, `time (ms)`, or bring the times to seconds and take the line out",
        )),
        _ => Ok(()),
    }
}

/// Whether a line in lower case has a key of our CSV that tells how a record was made from another one.
pub(super) fn is_history(lower: &str) -> bool {
    let bare = lower.trim_start_matches(|c: char| !c.is_ascii_alphanumeric());
    let key = bare.split([':', '=']).next().unwrap_or_default().trim();
    HISTORY.contains(&key)
}

/// The numbers alone under the letter N, `n=300`, or under a length, `length: 300`, where they may count samples.
fn letters(entries: &[Entry<'_>]) -> Vec<(&'static str, usize)> {
    let count = |entry: &Entry<'_>| {
        let name = match entry.key {
            "n" => "N",
            "length" => "the length",
            _ => return None,
        };
        let (found, digits, _) = entry.number()?;
        let alone = entry.value.trim() == digits && found.fract() == 0.0 && found >= LEAST_COUNT;
        alone.then_some((name, found as usize))
    };
    entries.iter().filter_map(count).collect()
}

/// The number under the letter N, whatever key follows it.
fn count_n(entries: &[Entry<'_>]) -> Option<usize> {
    let entry = entries.iter().find(|entry| entry.key == "n")?;
    let (found, digits, behind) = entry.number()?;
    let whole = digits.bytes().all(|b| b.is_ascii_digit()) && found >= LEAST_COUNT;
    (whole && behind.is_empty()).then_some(found as usize)
}

/// Digits of a printed number but zeros before the first other one.
fn significant(printed: &str) -> usize {
    let digits = printed.bytes().take_while(|b| !b"eEdD".contains(b));
    let digits = digits.filter(u8::is_ascii_digit);
    digits.skip_while(|b| *b == b'0').count()
}

/// A line in lower case whose keys and values stand in cells of their own, as BASIC writes them: `"dt =",.02,"npts
/// :",300` as `dt = .02, npts : 300`.
fn without_cells(lower: String) -> String {
    let keys = [":\",", ": \",", "=\",", "= \","];
    if !keys.iter().any(|end| lower.contains(end)) {
        return lower;
    }
    let joined = keys.iter().fold(lower, |text, end| {
        text.replace(end, &format!("{} ", &end[..1]))
    });
    joined.replace('"', " ")
}

/// Whether a line begins with a peak under this key, and names nothing but the values of which it may be: no other
/// quantity, no other stage of the processing.
fn is_of_the_values(lower: &str, key: &str) -> bool {
    const OTHERS: [&str; 16] = [
        "veloc",
        "displ",
        "spectr",
        "response",
        "psa",
        "normal",
        "raw",
        "uncorr",
        "vert",
        "damp",
        "vitesse",
        "geschwindigk",
        "desplaz",
        "deslocam",
        "spostam",
        "verschieb",
    ];
    let begins = lower.trim_start_matches(|c: char| !c.is_alphabetic());
    // Of two peaks in a line one may be that of another component.
    let once = |word: &&str| begins.starts_with(*word) && begins.matches(*word).count() == 1;
    ["peak", "max", "amax", "pga", "largest", key]
        .iter()
        .any(once)
        && !OTHERS.iter().any(|word| lower.contains(word))
}

/// Whether a line is a heading of values, `Velocity (cm/s)`: the name of a motion first, and few words.
fn is_heading(lower: &str) -> bool {
    const MOTIONS: [&str; 6] = [
        "acceleration",
        "accelerations",
        "velocity",
        "velocities",
        "displacement",
        "displacements",
    ];
    let mut words = lower.split_whitespace();
    let first = words.next().unwrap_or_default();
    MOTIONS.contains(&first.trim_end_matches([':', ','])) && words.count() <= 3
}

/// Whether a line has a range, of which no number counts anything: `samples 201 to 400`, `points 201-400`.
fn has_range(lower: &str) -> bool {
    let is_number = |word: &str| !word.is_empty() && word.bytes().all(|b| b.is_ascii_digit());
    let words: Vec<&str> = lower.split_whitespace().collect();
    let apart = |three: &[&str]| {
        let between = ["to", "-", "..", "\u{2013}", "through", "of"].contains(&three[1]);
        between && is_number(three[0]) && is_number(three[2])
    };
    let together = |word: &&str| {
        let signs = ["-", "..", "\u{2013}"];
        let mut parts = signs.iter().filter_map(|sign| word.split_once(*sign));
        parts.any(|(from, to)| is_number(from) && is_number(to))
    };
    words.windows(3).any(apart) || words.iter().any(together)
}

/// What a line states that no record states twice: keys of a count, of a time step, of a rate or of the quantity
/// with their values.
pub(super) fn states_a_record(line: &Line<'_>) -> bool {
    let lower = without_cells(lower(line));
    if is_history(&lower) {
        return false;
    }
    is_heading(&lower)
        || keyed(&lower).iter().any(|entry| match meaning(entry) {
            Some(Meaning::Count) => entry.has_number() && !has_range(&lower),
            Some(Meaning::Step | Meaning::Rate) => entry.has_number(),
            Some(Meaning::Quantity) => named_quantity(entry.value).is_some(),
            _ => false,
        })
}

/// The quantity that a value names by its first letters, with the value.
fn named_quantity(value: &str) -> Option<(Quantity, String)> {
    let all = [
        Quantity::Acceleration,
        Quantity::Velocity,
        Quantity::Displacement,
    ];
    // `velocity pulse` is a kind of acceleration.
    let mut words = value.split_whitespace();
    let (word, None) = (words.next()?, words.next()) else {
        return None;
    };
    let is_word = word.chars().all(char::is_alphabetic);
    let named = |q: &Quantity| is_word && word.starts_with(&q.name()[..3]);
    let text = word.chars().take(48).collect();
    all.into_iter().find(named).map(|quantity| (quantity, text))
}

/// A line in lower case; the sign of an increment is a delta.
fn lower(line: &Line<'_>) -> String {
    line.text().to_lowercase().replace('\u{2206}', "\u{3b4}")
}
