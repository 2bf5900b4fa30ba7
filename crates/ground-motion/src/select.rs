//! The series that excites the buildings.

use crate::accelerogram::Accelerogram;
use crate::direction::{Direction, Orientation};
use crate::error::{GroundMotionError, bound, rounded};
use crate::options::{Offset, ReadOptions};
use crate::origin::Processing;
use crate::quantity::Quantity;
use crate::recording::{Recording, Sampling, Series, WithoutSensitivity};
use crate::unit::AccelerationUnit;

/// Ratio of mean to peak from which a mean that is kept is named.
const OFFSET_TO_NAME: f64 = 0.01;
/// Digits of a time step in a message: a mean of differences has round-off behind them.
const STEP_DIGITS: usize = 9;

/// Chooses the acceleration that the options name and makes it ready.
pub(crate) fn excitation(
    file: &str,
    recording: Recording,
    options: &ReadOptions,
) -> Result<Accelerogram, GroundMotionError> {
    let not = |quantity: Quantity| GroundMotionError::NotAcceleration {
        file: file.to_owned(),
        quantity: quantity.name(),
    };
    if let Some(quantity) = options.quantity.filter(|q| *q != Quantity::Acceleration) {
        return Err(not(quantity));
    }
    let mut possible = Vec::new();
    let mut other = Quantity::Velocity;
    for series in recording.series {
        if series.quantity == Quantity::Acceleration {
            possible.push(series);
        } else {
            other = series.quantity;
        }
    }
    if possible.is_empty() {
        return Err(not(other));
    }
    let series = choose(file, possible, &recording.without, options)?;
    ready(file, series, options)
}

impl Recording {
    /// The one series that the options name by quantity (acceleration by default) and
    /// component, as it is in the file.
    ///
    /// # Errors
    /// No series of the quantity, no such component, or a choice that is ambiguous.
    pub fn choose(&self, options: &ReadOptions) -> Result<Series, GroundMotionError> {
        let file = self
            .series
            .first()
            .map_or(String::new(), |s| s.origin.file.clone());
        let wanted = options.quantity.unwrap_or(Quantity::Acceleration);
        let possible: Vec<Series> = self
            .series
            .iter()
            .filter(|s| s.quantity == wanted)
            .cloned()
            .collect();
        if possible.is_empty() {
            return Err(GroundMotionError::NoSuchQuantity {
                file,
                quantity: wanted.name(),
                available: self.series.iter().map(Series::label).collect(),
            });
        }
        choose(&file, possible, &self.without, options)
    }
}

impl Series {
    /// The series as excitation: mean, even steps and first zero as the options say.
    ///
    /// # Errors
    /// A velocity or displacement, or uneven samples without a step to resample to.
    pub fn accelerogram(&self, options: &ReadOptions) -> Result<Accelerogram, GroundMotionError> {
        let file = &self.origin.file;
        if self.quantity != Quantity::Acceleration {
            return Err(GroundMotionError::NotAcceleration {
                file: file.clone(),
                quantity: self.quantity.name(),
            });
        }
        ready(file, self.clone(), options)
    }
}

fn choose(
    file: &str,
    possible: Vec<Series>,
    without: &[WithoutSensitivity],
    options: &ReadOptions,
) -> Result<Series, GroundMotionError> {
    let passed_over = || {
        let shown =
            |other: &WithoutSensitivity| format!("{} (without sensitivity)", other.component);
        without.iter().map(shown)
    };
    let labels = |of: &[Series]| of.iter().map(Series::label).collect::<Vec<_>>();
    let mut chosen = match &options.component {
        None if without.is_empty() => possible,
        None => {
            return Err(GroundMotionError::AmbiguousSeries {
                file: file.to_owned(),
                line: None,
                available: labels(&possible).into_iter().chain(passed_over()).collect(),
            });
        }
        Some(wanted) => {
            let available = labels(&possible);
            let is_it = |other: &&WithoutSensitivity| {
                let name = other.component.as_str();
                let code = name.rsplit_once('.').map_or(name, |(_, code)| code);
                [name, code]
                    .iter()
                    .any(|n| n.eq_ignore_ascii_case(wanted.trim()))
            };
            if let Some(other) = without.iter().find(is_it) {
                return Err(GroundMotionError::Unsupported {
                    file: file.to_owned(),
                    what: format!(
                        "the sensitivity of component {} is not known: {}",
                        other.component, other.reason
                    ),
                    remedy: "give the StationXML that has the channel by `response` (`--response` with `pounding motion`), or choose another component",
                });
            }
            let chosen = named(possible, wanted);
            if chosen.is_empty() {
                return Err(GroundMotionError::NoSuchSeries {
                    file: file.to_owned(),
                    component: wanted.clone(),
                    available,
                });
            }
            chosen
        }
    };
    match chosen.pop() {
        Some(only) if chosen.is_empty() => Ok(only),
        last => {
            chosen.extend(last);
            Err(GroundMotionError::AmbiguousSeries {
                file: file.to_owned(),
                line: chosen.first().and_then(|s| s.origin.header_line),
                available: labels(&chosen),
            })
        }
    }
}

/// Series of this name; else of this azimuth or code at the start of the name;
/// else of this channel; else of this word in the name, as the azimuth of `L 50 deg`;
/// else of this direction, however file and user write it: `90` is `N90E`, `360` is `N-S`.
fn named(possible: Vec<Series>, wanted: &str) -> Vec<Series> {
    let wanted = wanted.trim();
    let full = |s: &Series| s.component.eq_ignore_ascii_case(wanted);
    // `HNE` of `10.HNE`, behind the code of a location.
    let code = |s: &Series| {
        let behind = s.component.rsplit_once('.').map(|(_, code)| code);
        behind.is_some_and(|c| c.len() == 3 && c.eq_ignore_ascii_case(wanted))
    };
    let first = |s: &Series| {
        s.component
            .split_whitespace()
            .next()
            .is_some_and(|w| w.eq_ignore_ascii_case(wanted))
    };
    let channel = |s: &Series| wanted.parse() == Ok(s.channel);
    let word = |s: &Series| {
        s.component
            .split_whitespace()
            .any(|w| w.eq_ignore_ascii_case(wanted))
    };
    let direction = Direction::parse(wanted);
    let points_there = |s: &Series| {
        let stated = s.origin.orientation.map(Orientation::direction);
        let own = stated.or_else(|| Direction::parse(&s.component));
        own.zip(direction)
            .is_some_and(|(own, wanted)| own.is(wanted))
    };
    let tests: [&dyn Fn(&Series) -> bool; 6] =
        [&full, &code, &first, &channel, &word, &points_there];
    let Some(test) = tests.into_iter().find(|t| possible.iter().any(t)) else {
        return Vec::new();
    };
    possible.into_iter().filter(|s| test(s)).collect()
}

/// Offset, even steps, and the zero before the first value.
fn ready(
    file: &str,
    mut series: Series,
    options: &ReadOptions,
) -> Result<Accelerogram, GroundMotionError> {
    let remove = match options.offset {
        Offset::Automatic => series.origin.processing == Processing::Raw,
        Offset::Keep => false,
        Offset::Remove => true,
    };
    let mean = series.mean();
    if remove && mean != 0.0 {
        for a in &mut series.samples {
            *a -= mean;
        }
        series.origin.mean_removed = true;
        series.origin.warnings.push(format!(
            "the mean, {} m/s2, was taken off",
            rounded(mean, 7)
        ));
    } else if mean.abs() > OFFSET_TO_NAME * series.peak().value {
        series.origin.warnings.push(format!(
            "the mean is {} m/s2: an offset of the instrument?",
            rounded(mean, 7)
        ));
    }
    let (mut samples, time_step) = match series.sampling {
        Sampling::Even { time_step } => (series.samples, time_step),
        Sampling::Uneven { times } => {
            let longest = continuous(file, &times)?;
            let step = resampling_step(file, &times, options)?;
            series.origin.warnings.push(format!(
                "{} samples at uneven times, resampled to {} s by linear interpolation; the longest step between them is {longest}",
                times.len(),
                rounded(step, STEP_DIGITS)
            ));
            series.origin.time_step = format!("{step} s (given by the user)");
            (resample(file, &times, &series.samples, step)?, step)
        }
    };
    let mut origin = series.origin;
    let mut initial = series.initial;
    if options.prepend_zero {
        // The acceleration rises in a line from the zero to the first value.
        initial = initial.map(|(velocity, displacement)| {
            let before = velocity - 0.5 * time_step * samples[0];
            let moved = time_step * (before + time_step * samples[0] / 6.0);
            (before, displacement - moved)
        });
        samples.insert(0, 0.0);
        origin.start_later(-time_step);
        origin
            .warnings
            .push("a zero was put before the first value".to_owned());
    }
    let accelerogram =
        Accelerogram::new(samples, AccelerationUnit::MetrePerSecondSquared, time_step)
            .map_err(|e| GroundMotionError::Invalid(format!("{file}: {e}")))?;
    Ok(accelerogram.with_origin(origin).with_initial(initial))
}

/// Median steps of which a longer one may be a gap: digitised film has up to 27.
const GAP_IN_STEPS: f64 = 10.0;
/// The longest step (s) that is none, however short the others are: digitised film has up to
/// 0.04 s, and instruments take ten samples in a second at least.
const LONGEST_STEP: f64 = 0.1;

/// The longest step between uneven times with its place, refused where it is a gap: a straight
/// line across it is no motion of the ground.
fn continuous(file: &str, times: &[f64]) -> Result<String, GroundMotionError> {
    let mut steps: Vec<f64> = times.windows(2).map(|t| t[1] - t[0]).collect();
    let longest = (0..steps.len()).max_by(|a, b| steps[*a].total_cmp(&steps[*b]));
    let at = longest.unwrap_or(0);
    let longest = steps[at];
    let place = format!(
        "{} s, from {} s to {} s",
        bound(longest),
        times[at],
        times[at + 1]
    );
    steps.sort_by(f64::total_cmp);
    let median = steps[steps.len() / 2];
    // A millionth: differences of times carry noise.
    if longest > LONGEST_STEP.max(GAP_IN_STEPS * median) * (1.0 + 1.0e-6) {
        return Err(GroundMotionError::Unsupported {
            file: file.to_owned(),
            what: format!(
                "a gap of {place}, where half of the steps are {} s or less: an excitation must be continuous",
                bound(median)
            ),
            remedy: "get the record again; where the ground did not move in the gap, write rows of zeros there",
        });
    }
    Ok(place)
}

/// The step that the user gives for an uneven series: not coarser than the
/// record's own.
fn resampling_step(
    file: &str,
    times: &[f64],
    options: &ReadOptions,
) -> Result<f64, GroundMotionError> {
    let steps = || times.windows(2).map(|w| w[1] - w[0]);
    let mean = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
    match options.time_step {
        // A thousandth: 0.005 s stands for film steps of 0.0050007 s and back.
        Some(step) if step > 0.0 && step <= mean * 1.001 => Ok(step),
        _ => Err(GroundMotionError::Uneven {
            file: file.to_owned(),
            count: times.len(),
            mean,
            smallest: steps().fold(f64::INFINITY, f64::min),
            largest: steps().fold(0.0, f64::max),
        }),
    }
}

/// Linear interpolation at even steps from the first time to the last.
fn resample(
    file: &str,
    times: &[f64],
    values: &[f64],
    step: f64,
) -> Result<Vec<f64>, GroundMotionError> {
    let span = times[times.len() - 1] - times[0];
    let count = (span / step * (1.0 + 1.0e-12)).floor() + 1.0;
    // Finer steps add nothing but length.
    if !(count <= 10.0 * times.len() as f64) {
        return Err(GroundMotionError::Invalid(format!(
            "{file}: {} samples over {span} s would become {count:e} at {step} s",
            times.len()
        )));
    }
    let mut samples = Vec::with_capacity(count as usize);
    let mut k = 0;
    for i in 0..count as usize {
        let t = (times[0] + i as f64 * step).min(times[times.len() - 1]);
        while k + 2 < times.len() && times[k + 1] < t {
            k += 1;
        }
        let fraction = (t - times[k]) / (times[k + 1] - times[k]);
        samples.push(values[k] + fraction * (values[k + 1] - values[k]));
    }
    Ok(samples)
}
