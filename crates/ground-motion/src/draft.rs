//! From what a reader found to a series in SI, held against the header.

use crate::direction::Orientation;
use crate::error::{GroundMotionError, READING, bound, within};
use crate::number::Printed;
use crate::origin::{Origin, Processing};
use crate::quantity::{Quantity, SeriesUnit};
use crate::recording::{HeaderPeak, Sampling, Series};
use crate::source::{Source, Used};
use crate::start_times::is_impossible;
use crate::time_column::{Times, not_after};
use crate::time_step::{impossible_step, unusual_step};
use crate::unit::AccelerationUnit;

/// A peak in the header: value and time, with their printed digits.
pub(crate) struct DraftPeak {
    pub value: Printed,
    pub time: Option<Printed>,
    /// Unit of the value, where it is not that of the samples.
    pub unit: Option<SeriesUnit>,
    /// Time that the header counts from, after the first sample (s).
    pub shift: f64,
    /// Its line, from 1; `None`: that of the step.
    pub line: Option<usize>,
    /// Whether it is the largest value of its sign alone.
    pub of_sign: bool,
}

/// A quantity that a header names in words, which is that of the unit.
pub(crate) struct NamedQuantity {
    pub quantity: Quantity,
    /// The words.
    pub text: String,
    /// Their line, from 1.
    pub line: usize,
}

impl NamedQuantity {
    /// What the words of a line name, if they name one quantity.
    pub(crate) fn of(line: usize, text: &str) -> Option<Self> {
        let quantity = Quantity::in_words(&text.to_ascii_lowercase())?;
        let text = text.trim().chars().take(48).collect();
        Some(Self {
            quantity,
            text,
            line,
        })
    }
}

/// A length of the record that a header states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StatedDuration {
    /// Length (s).
    pub seconds: f64,
    /// Its line, from 1; `None`: that of the step.
    pub line: Option<usize>,
}

impl From<f64> for StatedDuration {
    fn from(seconds: f64) -> Self {
        Self {
            seconds,
            line: None,
        }
    }
}

/// The unit of the values in a file.
pub(crate) enum DraftUnit {
    /// As the file states it; its symbol for display.
    Stated(SeriesUnit),
    /// Values of an instrument, so many units of `unit` each.
    Scaled {
        /// What one value is a multiple of.
        unit: SeriesUnit,
        /// So many of them.
        each: f64,
        /// What the file holds: counts or volts.
        of: &'static str,
        /// Who states it.
        by: String,
    },
    /// Counts whose sensitivity is not in the file.
    Counts,
    /// Not stated: the user must.
    Unstated,
}

impl DraftUnit {
    /// Counts of `each` units, as the file states.
    pub(crate) fn counts_of(unit: SeriesUnit, each: f64) -> Self {
        Self::Scaled {
            unit,
            each,
            of: "counts",
            by: "stated in the file".to_owned(),
        }
    }
}

/// What a reader found, in the units of the file.
pub(crate) struct Draft {
    pub component: String,
    pub channel: usize,
    pub unit: DraftUnit,
    pub times: Times,
    pub samples: Vec<f64>,
    pub header_count: Option<usize>,
    /// Most values that stand in a row, where rows have several or nothing may be too many:
    /// agencies fill the last row, and no surplus is a row of its own.
    pub row: Option<usize>,
    /// What the header counts, if not samples, in brackets after a blank.
    pub counted: String,
    /// Other counts that the header states, with their lines.
    pub other_counts: Vec<(usize, usize)>,
    /// Lengths of the record that the header states, in numbers or in words.
    pub header_durations: Vec<StatedDuration>,
    /// Others that may be those of a part of the record: what differs is only said.
    pub other_durations: Vec<StatedDuration>,
    /// Two steps that the header states: line, what is wrong, remedy. A duration that
    /// tells which of them is wrong is said first.
    pub step_conflict: Option<(usize, String, String)>,
    pub peak: Option<DraftPeak>,
    /// The same peak where the header repeats it, and lesser ones.
    pub other_peaks: Vec<DraftPeak>,
    /// Peaks without a unit, which may be in another one than the samples, and whether they are of the samples: what
    /// differs is only said of the others, which may be of something else.
    pub bare_peaks: Vec<(DraftPeak, bool)>,
    /// What the header says in words that the values are.
    pub quantities: Vec<NamedQuantity>,
    pub initial: Option<(f64, f64)>,
    pub processing: Processing,
    pub title: String,
    pub start_time: String,
    /// Time of the first sample (s) in a column of times.
    pub first_time: Option<f64>,
    pub orientation: Option<Orientation>,
    /// Low and high corner frequency (Hz).
    pub corners: (Option<f64>, Option<f64>),
    /// Lines that state a g, and that (m/s2).
    pub gravities: Vec<(usize, f64)>,
    pub warnings: Vec<String>,
    /// Lines of the step and of the first and last values, for messages.
    pub lines: (usize, usize, usize),
}

/// Values that a last row may hold beyond the count of the header: agencies fill it.
pub(crate) const ROW: usize = 10;

/// What to say of a factor of the values that a header states.
pub(crate) fn not_applied(line: usize, factor: f64) -> String {
    format!(
        "line {line}: a factor of {factor} is stated, which is not applied: the samples are used as they stand"
    )
}

/// Part of a g by which one that a header states may differ from the one that is used.
const SAME_GRAVITY: f64 = 1.0e-4;

/// What to say of a g (m/s2) that a header states.
fn gravity_not_used(line: usize, stated: f64, used: f64) -> Option<String> {
    let differs = (stated - used).abs() > SAME_GRAVITY * used;
    differs.then(|| {
        let stated = bound(stated);
        format!(
            "line {line}: a g of {stated} m/s2 is stated, but {} m/s2 is used: if the values are in that g, give it, `gravity = \"{stated} m/s2\"` in [ground_motion] of a case, `--gravity \"{stated} m/s2\"` with `pounding motion`",
            bound(used)
        )
    })
}

/// What to say of samples that a header says to have been left out.
pub(crate) fn decimated(line: usize, of: f64) -> String {
    format!(
        "line {line}: a decimation by {of} is stated: the time step of the header is taken for that of the samples as they stand"
    )
}

/// The values of a row, of rows that have more than one: one value a row has nothing to fill.
pub(crate) fn several(values: usize) -> Option<usize> {
    Some(values).filter(|n| *n > 1)
}

impl Draft {
    /// A draft with nothing but values: `lines` are those of the header, of the
    /// first and of the last value.
    pub(crate) fn new(samples: Vec<f64>, unit: DraftUnit, lines: (usize, usize, usize)) -> Self {
        Self {
            component: String::new(),
            channel: 1,
            unit,
            times: Times::Step(None),
            samples,
            header_count: None,
            row: None,
            counted: String::new(),
            other_counts: Vec::new(),
            header_durations: Vec::new(),
            other_durations: Vec::new(),
            step_conflict: None,
            peak: None,
            other_peaks: Vec::new(),
            bare_peaks: Vec::new(),
            quantities: Vec::new(),
            initial: None,
            processing: Processing::Unstated,
            title: String::new(),
            start_time: String::new(),
            first_time: None,
            orientation: None,
            corners: (None, None),
            gravities: Vec::new(),
            warnings: Vec::new(),
            lines,
        }
    }

    /// The series in SI.
    ///
    /// # Errors
    /// Too few samples, an unstated or contradicted unit or step.
    pub(crate) fn finish(mut self, source: &Source<'_>) -> Result<Series, GroundMotionError> {
        source.one_more_series(self.lines.2)?;
        self.count(source)?;
        self.samples.shrink_to_fit();
        self.missing();
        self.time_of_calendar();
        let name = &self.component;
        let other = self.orientation.and_then(|o| o.against_name(name));
        self.warnings.extend(other);
        let (factor, quantity, symbol, unit_text) = self.unit(source)?;
        self.agrees_in_gravity(source);
        self.agrees_in_words(source, quantity, symbol)?;
        // Counts are of no unit: they stand for values in one.
        let stated = match &self.unit {
            DraftUnit::Scaled { unit, .. } => unit.in_si(gravity(source.options.gravity)),
            DraftUnit::Counts => 1.0,
            _ => factor,
        };
        let (sampling, step_text) = self.sampling(source)?;
        self.warn_of_step(source, &sampling);
        self.duration(source, &sampling)?;
        if let Some((line, message, remedy)) = self.step_conflict.take() {
            if !source.options.lenient {
                return Err(source.error(line, 0, message, &remedy));
            }
            self.warnings.push(format!("line {line}: {message}"));
        }
        for a in &mut self.samples {
            *a *= factor;
        }
        let mut series = Series {
            quantity,
            component: self.component.clone(),
            channel: self.channel,
            unit: symbol,
            unit_in_si: factor,
            samples: std::mem::take(&mut self.samples),
            sampling,
            header_peak: None,
            initial: self.initial,
            origin: Origin {
                file: source.file.to_owned(),
                title: std::mem::take(&mut self.title),
                component: std::mem::take(&mut self.component),
                unit: unit_text,
                unit_in_si: Some(stated),
                time_step: step_text,
                header_count: self.header_count,
                processing: self.processing,
                start_time: std::mem::take(&mut self.start_time),
                first_time: self.first_time,
                orientation: self.orientation,
                low_corner: self.corners.0,
                high_corner: self.corners.1,
                ..Origin::default()
            },
        };
        let peaks = self.peak.take().map(|peak| (peak, true));
        let others = self.other_peaks.drain(..).map(|peak| (peak, false));
        for (peak, is_main) in peaks.into_iter().chain(others) {
            if let Some(unit) = peak.unit.filter(|unit| unit.quantity != quantity) {
                let message = format!(
                    "the peak is in {}, a unit of {}, but the values are {quantity}",
                    unit.symbol, unit.quantity
                );
                source.contradiction(peak.line.unwrap_or(self.lines.0), message)?;
                continue;
            }
            let unit = peak.unit.map_or((symbol, factor), |u| {
                source.uses(Used {
                    gravity: u.is_of_gravity(),
                    ..Used::default()
                });
                (u.symbol, u.in_si(gravity(source.options.gravity)))
            });
            let (stated, compared) = compare_peak(&series, &peak, unit, &mut self.warnings);
            if is_main {
                series.header_peak = Some(stated);
            }
            if let Err(message) = compared {
                // Who says the unit has said that the header is wrong in it, unless neither
                // samples nor peak have a unit there: both are in the one that is given.
                let without = matches!(self.unit, DraftUnit::Unstated) && peak.unit.is_none();
                let other_unit = source.options.unit.is_some() && !without;
                if !(source.options.lenient || other_unit) {
                    let line = peak.line.unwrap_or(self.lines.0);
                    return Err(source.error(line, 0, message, PEAK_REMEDY));
                }
                if !self.warnings.contains(&message) {
                    self.warnings.push(message);
                }
            }
        }
        for (peak, is_of_samples) in std::mem::take(&mut self.bare_peaks) {
            let line = peak.line.unwrap_or(self.lines.0);
            match in_no_unit(&series, &peak) {
                Some(message) if is_of_samples && !source.options.lenient => {
                    return Err(source.error(line, 0, message, PEAK_REMEDY));
                }
                Some(message) => self.warnings.push(format!("line {line}: {message}")),
                // What differs in this unit is in another one.
                None if is_of_samples => {
                    drop(compare_peak(
                        &series,
                        &peak,
                        (symbol, factor),
                        &mut self.warnings,
                    ));
                }
                None => {}
            }
        }
        series.origin.warnings = self.warnings;
        Ok(series)
    }

    fn count(&mut self, source: &Source<'_>) -> Result<(), GroundMotionError> {
        let found = self.samples.len();
        let expected = self.header_count.unwrap_or(found);
        if found < expected {
            if !source.options.lenient {
                return Err(GroundMotionError::TooFewSamples {
                    file: source.file.to_owned(),
                    line: self.lines.2.max(1),
                    column: 1,
                    expected,
                    found,
                    stated: std::mem::take(&mut self.counted),
                });
            }
            self.warnings.push(format!(
                "header says {expected} samples, {found} found and used"
            ));
        } else if found == expected + 1 {
            self.warnings.push(format!(
                "header says {expected} samples, one more found and used"
            ));
        } else if found > expected {
            let most = self.row.map_or(ROW, |row| row.saturating_sub(1).min(ROW));
            if found - expected > most && !source.options.lenient {
                return Err(source.error(
                    self.lines.1,
                    0,
                    format!("the header says {expected} samples, but {found} stand in the file"),
                    "the count is wrong, or something else stands behind the series: get the record again, or set `lenient = true` to use as many as the header says",
                ));
            }
            self.warnings.push(format!(
                "header says {expected} samples, {found} found; the surplus is not used"
            ));
            self.samples.truncate(expected);
            if let Times::Each(times) = &mut self.times {
                times.truncate(expected);
            }
        }
        for (line, other) in std::mem::take(&mut self.other_counts) {
            if other.abs_diff(self.samples.len()) > ROW {
                let message = format!(
                    "the header says {other} samples here, but {} stand in the file",
                    self.samples.len()
                );
                if !source.options.lenient {
                    return Err(source.error(
                        line,
                        0,
                        message,
                        "the header contradicts itself: get the record again, or set `lenient = true` to use what is there",
                    ));
                }
                self.warnings.push(format!("line {line}: {message}"));
            }
        }
        if self.samples.len() < 2 {
            return Err(source.error(
                self.lines.1,
                0,
                format!("{} samples; at least two are needed", self.samples.len()),
                "the file has no series: get it again",
            ));
        }
        Ok(())
    }

    /// Refuses words that name another quantity than the unit: which is right cannot be known.
    fn agrees_in_words(
        &self,
        source: &Source<'_>,
        quantity: Quantity,
        unit: &str,
    ) -> Result<(), GroundMotionError> {
        let Some(other) = self.quantities.iter().find(|q| q.quantity != quantity) else {
            return Ok(());
        };
        // Counts and volts are not what they count.
        let values = match &self.unit {
            DraftUnit::Scaled { of, .. } => format!("{of} of {quantity}"),
            _ => format!("in {unit}, which is {quantity}"),
        };
        Err(source.error(
            other.line,
            0,
            format!(
                "the header says {} here (\"{}\"), but the values are {values}",
                other.quantity, other.text
            ),
            "header and unit contradict one another: get the record again",
        ))
    }

    /// Leaves out a start time that no calendar or clock has.
    fn time_of_calendar(&mut self) {
        if is_impossible(&self.start_time) {
            let text: String = self.start_time.chars().take(48).collect();
            self.start_time.clear();
            self.warnings.push(format!(
                "the start time \"{text}\" is none of a calendar and a clock, and is not used"
            ));
        }
    }

    /// Values that often stand for "missing" but can be true are only named.
    fn missing(&mut self) {
        // Whole numbers are nothing special among counts.
        if matches!(self.unit, DraftUnit::Counts | DraftUnit::Scaled { .. }) {
            return;
        }
        let stands_for = |a: &f64| [-999.0, -9999.0, 9999.0, -12345.0, -32768.0].contains(a);
        let count = self.samples.iter().filter(|a| stands_for(a)).count();
        if let Some(first) = self.samples.iter().position(stands_for) {
            self.warnings.push(format!(
                "sample {} is exactly {}, which often stands for a missing value ({count} such samples)",
                first + 1,
                self.samples[first]
            ));
        }
    }

    /// Says that another g than the one that is used is stated for values in units of it.
    fn agrees_in_gravity(&mut self, source: &Source<'_>) {
        let unit = match self.unit {
            DraftUnit::Stated(unit) | DraftUnit::Scaled { unit, .. } => Some(unit),
            _ => source.options.unit.map(SeriesUnit::from),
        };
        if unit.is_some_and(SeriesUnit::is_of_gravity) {
            let used = gravity(source.options.gravity);
            let stated = self.gravities.iter();
            let told = stated.filter_map(|(line, stated)| gravity_not_used(*line, *stated, used));
            self.warnings.extend(told);
        }
    }

    /// Factor to SI, quantity, symbol and the text for the user.
    fn unit(
        &self,
        source: &Source<'_>,
    ) -> Result<(f64, Quantity, &'static str, String), GroundMotionError> {
        let options = source.options;
        if let Some(given) = options.gravity {
            let (least, most) = GRAVITY;
            within(READING, "gravity", given, least, most)?;
        }
        let gravity = gravity(options.gravity);
        let of_gravity = |unit: SeriesUnit| {
            source.uses(Used {
                gravity: unit.is_of_gravity(),
                ..Used::default()
            });
        };
        if let DraftUnit::Stated(unit) | DraftUnit::Scaled { unit, .. } = &self.unit {
            of_gravity(*unit);
        }
        let contradiction = |stated: &str, given: String| GroundMotionError::Contradiction {
            file: source.file.to_owned(),
            quantity: "unit",
            stated: stated.to_owned(),
            given,
        };
        match (&self.unit, options.unit) {
            (DraftUnit::Stated(unit) | DraftUnit::Scaled { unit, .. }, Some(given))
                if unit.quantity == Quantity::Acceleration && !unit.is(given) =>
            {
                Err(contradiction(unit.symbol, given.symbol().to_owned()))
            }
            (DraftUnit::Stated(unit), _) => Ok((
                unit.in_si(gravity),
                unit.quantity,
                unit.symbol,
                format!("{} (stated in the file)", unit.symbol),
            )),
            (DraftUnit::Scaled { unit, each, of, by }, _) => Ok((
                unit.in_si(gravity) * each,
                unit.quantity,
                of,
                format!("{of} of {each:e} {} ({by})", unit.symbol),
            )),
            // That of the sensitivity may be said once more.
            (DraftUnit::Counts, Some(given))
                if options.sensitivity.is_some()
                    && given != AccelerationUnit::MetrePerSecondSquared =>
            {
                Err(GroundMotionError::Unsupported {
                    file: source.file.to_owned(),
                    what: format!(
                        "both the unit {} and a sensitivity are given: with a sensitivity, in counts per m/s2, the values are counts",
                        SeriesUnit::from(given).symbol
                    ),
                    remedy: "give `sensitivity` alone if the values are counts of the instrument, `unit` alone if not",
                })
            }
            (DraftUnit::Counts, _) => match options.sensitivity {
                Some(s) if s.is_finite() && s != 0.0 => {
                    source.uses(Used {
                        sensitivity: true,
                        ..Used::default()
                    });
                    Ok((
                        1.0 / s,
                        Quantity::Acceleration,
                        "counts",
                        format!("counts, {s} per m/s2 (given by the user)"),
                    ))
                }
                _ => Err(GroundMotionError::MissingSensitivity {
                    file: source.file.to_owned(),
                    searched: String::new(),
                }),
            },
            (DraftUnit::Unstated, Some(given)) => {
                let unit = SeriesUnit::from(given);
                of_gravity(unit);
                Ok((
                    unit.in_si(gravity),
                    unit.quantity,
                    unit.symbol,
                    format!("{} (given by the user)", unit.symbol),
                ))
            }
            (DraftUnit::Unstated, None) => {
                let peak = self.samples.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
                Err(GroundMotionError::MissingUnit {
                    file: source.file.to_owned(),
                    line: self.lines.1,
                    hint: if peak > 20.0 {
                        format!(" (the largest value, {peak}, is too large for g)")
                    } else {
                        String::new()
                    },
                })
            }
        }
    }

    /// A step that no accelerograph has is used: synthetic motions may have it.
    fn warn_of_step(&mut self, source: &Source<'_>, sampling: &Sampling) {
        let Some(text) = unusual_step(sampling.median_step(), self.samples.len()) else {
            return;
        };
        // Binary formats have no lines.
        let stated = self.lines != (1, 1, 1) && source.options.time_step.is_none();
        let text = match (sampling, stated) {
            (Sampling::Even { .. }, true) => format!("line {}: {text}", self.lines.0),
            _ => text,
        };
        self.warnings.push(text);
    }

    fn sampling(&mut self, source: &Source<'_>) -> Result<(Sampling, String), GroundMotionError> {
        let stated = match std::mem::replace(&mut self.times, Times::Step(None)) {
            Times::Each(times) => {
                if let Some(i) = times.windows(2).position(|w| !(w[1] > w[0])) {
                    return Err(not_after(source, self.lines.1, &times, i + 1));
                }
                let length = times.last().zip(times.first()).map_or(0.0, |(b, a)| b - a);
                let mean = length / times.len().saturating_sub(1).max(1) as f64;
                if let Some(wrong) = impossible_step(mean).filter(|_| times.len() > 1) {
                    return Err(source.error(
                        self.lines.1,
                        0,
                        format!("the times have a mean step of {mean:e} s: {wrong}"),
                        "correct the times, or their unit",
                    ));
                }
                return Ok((Sampling::Uneven { times }, "uneven".to_owned()));
            }
            Times::Step(stated) => stated,
        };
        let line = self.lines.0;
        let (step, by) = match (stated, source.options.time_step) {
            (None, None) => {
                return Err(GroundMotionError::MissingTimeStep {
                    file: source.file.to_owned(),
                    line,
                });
            }
            (Some(a), Some(b)) if (a - b).abs() > 1.0e-6 * a.abs() => {
                return Err(GroundMotionError::Contradiction {
                    file: source.file.to_owned(),
                    quantity: "time_step",
                    stated: format!("{a} s"),
                    given: format!("{b} s"),
                });
            }
            (Some(a), _) => (a, "stated in the file"),
            (None, Some(b)) => (b, "given by the user"),
        };
        if let Some(wrong) = impossible_step(step) {
            return Err(source.error(line, 0, wrong, "correct the header, or give `time_step`"));
        }
        Ok((
            Sampling::Even { time_step: step },
            format!("{step} s ({by})"),
        ))
    }
}

/// Part of a duration by which header and samples may differ.
const DURATION_TOLERANCE: f64 = 0.01;

impl Draft {
    /// Adds a length in words that may be that of the record before it was processed, which
    /// may have cut off an end. Where the header states both lengths (s) in numbers, and the
    /// words repeat that of the `raw` record, they say nothing of the samples; else they must
    /// be theirs.
    pub(crate) fn state_in_words(
        &mut self,
        words: StatedDuration,
        raw: Option<f64>,
        own: Option<f64>,
    ) {
        let is_raw = |raw: f64| (raw - words.seconds).abs() <= DURATION_TOLERANCE * raw;
        if !own.and(raw).is_some_and(is_raw) {
            self.header_durations.push(words);
        }
    }

    /// Holds every duration in the header against count and step. Agencies count n or
    /// n - 1 steps and round the duration: one and a half steps are no difference.
    fn duration(
        &mut self,
        source: &Source<'_>,
        sampling: &Sampling,
    ) -> Result<(), GroundMotionError> {
        if self.header_durations.is_empty() && self.other_durations.is_empty() {
            return Ok(());
        }
        let count = self.samples.len();
        let (found, step, how) = match sampling {
            Sampling::Even { time_step } => {
                let found = count as f64 * time_step;
                (
                    found,
                    *time_step,
                    format!("{count} samples at {time_step} s last {} s", bound(found)),
                )
            }
            Sampling::Uneven { times } => {
                let found = times.last().copied().unwrap_or(0.0);
                let how = format!("the times of its {count} samples end at {} s", bound(found));
                (found, found / count as f64, how)
            }
        };
        let must = std::mem::take(&mut self.header_durations);
        let may = std::mem::take(&mut self.other_durations);
        let must = must.into_iter().map(|stated| (stated, true));
        for (StatedDuration { seconds, line }, must) in
            must.chain(may.into_iter().map(|stated| (stated, false)))
        {
            let difference = (found - seconds).abs();
            if difference <= 1.5 * step {
                continue;
            }
            let message = format!("the header says a duration of {seconds} s, but {how}");
            let near = difference <= DURATION_TOLERANCE * seconds;
            if must && !(near || source.options.lenient) {
                return Err(source.error(
                    line.unwrap_or(self.lines.0),
                    0,
                    message,
                    "duration, count or time step of the header is wrong: get the record again, or set `lenient = true` to use count and time step as they are",
                ));
            }
            if !self.warnings.contains(&message) {
                self.warnings.push(message);
            }
        }
        Ok(())
    }
}

/// Gravity (m/s2) on Earth, with room for what agencies take it to be.
const GRAVITY: (f64, f64) = (9.7, 9.9);

/// The g (m/s2) to use.
pub(crate) fn gravity(given: Option<f64>) -> f64 {
    given
        .filter(|g| g.is_finite() && *g > 0.0)
        .unwrap_or(AccelerationUnit::StandardGravity.in_si())
}

/// Part of the header's peak by which that of the samples may differ: agencies print the
/// peak of another stage of their processing, or of a raw record less an offset that the
/// header does not state.
const PEAK_TOLERANCE: f64 = 0.05;
const PEAK_REMEDY: &str = "header and samples contradict one another: check the unit, get the record again, or set `lenient = true` to use the samples as they are";

/// What to say of a peak without a unit that the samples have in none.
fn in_no_unit(series: &Series, peak: &DraftPeak) -> Option<String> {
    let found = series.signed_peak().0.abs();
    let value = peak.value.0.abs();
    let gravity = AccelerationUnit::StandardGravity.in_si();
    let near = |in_si: f64| (found - value * in_si).abs() <= PEAK_TOLERANCE * value * in_si;
    let known = [
        series.unit_in_si,
        gravity,
        0.001 * gravity,
        1.0,
        0.01,
        0.001,
    ];
    (value != 0.0 && !known.into_iter().any(near)).then(|| {
        format!(
            "the header says a peak of {} without a unit, that of the samples is {} {}",
            peak.value.0,
            bound(found / series.unit_in_si),
            series.unit
        )
    })
}

/// Holds the header's peak against the samples: magnitudes, for agencies print
/// either sign, within the last printed digit; times within one step. Headers of
/// raw records refer to samples with or without their mean. A sign that differs is kept
/// with the header's peak. What is wrong with a peak that differs by more than [`PEAK_TOLERANCE`]
/// is returned beside it.
fn compare_peak(
    series: &Series,
    peak: &DraftPeak,
    (unit, in_si): (&'static str, f64),
    warnings: &mut Vec<String>,
) -> (HeaderPeak, Result<(), String>) {
    let value = peak.value.0 * in_si;
    // Either the header or the samples have fewer digits than the other.
    let tolerance = (peak.value.1 * in_si).abs() + 1.0e-4 * value.abs();
    let mut stated = HeaderPeak {
        value,
        time: peak.time.map(|t| t.0),
        unit,
        unit_in_si: in_si,
        opposite_sign: false,
    };
    let mean = if series.origin.processing == Processing::Corrected {
        0.0
    } else {
        series.mean()
    };
    let less = |offset: f64| {
        let size = |a: &f64| match peak.of_sign {
            true => (a - offset) * value.signum(),
            false => (a - offset).abs(),
        };
        let largest = |m: f64, a: &f64| m.max(size(a));
        series.samples.iter().fold(0.0_f64, largest)
    };
    for offset in [0.0, mean] {
        let found = less(offset);
        if (found - value.abs()).abs() > tolerance {
            continue;
        }
        let signed = |a: &f64| (a - offset) * value.signum() >= value.abs() - tolerance;
        stated.opposite_sign = !series.samples.iter().any(signed);
        if let Some((time, digit)) = peak.time {
            let step = match &series.sampling {
                Sampling::Even { time_step } => *time_step,
                Sampling::Uneven { times } => {
                    (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64
                }
            };
            // The second tolerance: times of long records are single precision too.
            let near = step + digit + 1.0e-6 * time.abs();
            let there = (0..series.samples.len()).any(|i| {
                (series.samples[i] - offset).abs() >= found - tolerance
                    && (series.time(i) - peak.shift - time).abs() <= near
            });
            if !there {
                warnings.push(format!(
                    "the header puts the peak at {time} s, where the samples do not have it"
                ));
            }
        }
        return (stated, Ok(()));
    }
    let (found, time) = match peak.of_sign {
        true => series.extreme(value.signum()),
        false => series.signed_peak(),
    };
    let decimals = ((4.0 - libm::log10(value.abs() / in_si).floor()).clamp(0.0, 9.0)) as usize;
    let message = format!(
        "the header's peak is {:.decimals$} {unit}, that of the samples {:.decimals$} {unit} at {time:.3} s",
        peak.value.0,
        found / in_si,
    );
    let differs = |offset: f64| (less(offset) - value.abs()).abs() > PEAK_TOLERANCE * value.abs();
    // A zero is a field that was not filled in.
    if value != 0.0 && [0.0, mean].into_iter().all(differs) {
        return (stated, Err(message));
    }
    if !warnings.contains(&message) {
        warnings.push(message);
    }
    (stated, Ok(()))
}
