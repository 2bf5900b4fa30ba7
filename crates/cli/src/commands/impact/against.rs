//! Computed against measured force.

use crate::tables::Table;
use pounding_case::Dimension;
use pounding_catalogue::wording::{agreeing, counted};
use pounding_gap_element::CollisionSample;
use serde_json::{Value, json};

use super::collisions::{Collided, right_aligned};
use super::measured;
use super::numbers::{signed_percent, significant};
use super::setting::quantity;
use crate::arguments::ImpactArguments;
use crate::failure::Failure;
use crate::plot::Curve;

/// Samples in contact below which a measured history says little.
const FEW_SAMPLES: usize = 10;

/// A measured history from its first contact on.
pub struct Measured {
    file: String,
    /// Time of first contact in the file (s), and how it was found.
    first_contact: f64,
    found: String,
    /// Time after first contact (s) and force (N), from first contact to the end of
    /// the file.
    samples: Vec<(f64, f64)>,
    peak: (f64, f64),
    contact_time: f64,
    impulse: f64,
    in_contact: usize,
    warnings: Vec<String>,
}

/// One model beside the measured history; percentages are of the measured value.
pub struct Compared {
    model: &'static str,
    peak: f64,
    peak_error: f64,
    impulse: f64,
    impulse_error: f64,
    duration: f64,
    difference: f64,
    window: f64,
}

/// Reads and aligns the measured history, if one is asked for.
pub fn measured(arguments: &ImpactArguments) -> Result<Option<Measured>, Failure> {
    let Some(path) = &arguments.against else {
        return Ok(None);
    };
    let threshold = quantity(&arguments.threshold, "threshold", Dimension::NUMBER)?;
    if !(threshold > 0.0 && threshold < 1.0) {
        return Err(Failure::input(
            format!("--threshold is {threshold}, but it must lie between 0 and 1"),
            Some("it is a part of the measured peak: \"1 %\" is usual".to_owned()),
        ));
    }
    let shift = arguments
        .shift
        .as_deref()
        .map(|text| quantity(text, "shift", Dimension::TIME))
        .transpose()?;
    let samples = measured::read(path, arguments.against_units.as_deref())?;
    align(path.display().to_string(), &samples, threshold, shift).map(Some)
}

/// Counts time from first contact, and finds peak, end and impulse of the contact.
fn align(
    file: String,
    raw: &[(f64, f64)],
    threshold: f64,
    shift: Option<f64>,
) -> Result<Measured, Failure> {
    let top = (0..raw.len()).max_by(|a, b| raw[*a].1.total_cmp(&raw[*b].1));
    let top = top.filter(|i| raw[*i].1 > 0.0).ok_or_else(|| {
        Failure::input(
            format!("{file} has no force above zero"),
            Some("give a force that pushes the bodies apart as positive".to_owned()),
        )
    })?;
    let level = threshold * raw[top].1;
    let percent = significant(100.0 * threshold);
    let first = raw.iter().position(|(_, f)| *f > level).unwrap_or(top);
    let (first_contact, found) = match shift {
        Some(time) => (time, "as given by --shift".to_owned()),
        None => (
            closure(raw, first),
            format!(
                "extrapolated to zero force from the first sample above {percent} % of the peak"
            ),
        ),
    };
    if !(first_contact >= raw[0].0 - (raw[1].0 - raw[0].0) && first_contact <= raw[top].0) {
        return Err(Failure::input(
            format!(
                "first contact at {first_contact} s is not between the start of {file} and its peak at {} s",
                raw[top].0
            ),
            Some("--shift is the time of first contact in the measured history".to_owned()),
        ));
    }
    let mut warnings = Vec::new();
    let released = (top..raw.len()).find(|i| raw[*i].1 <= level);
    let end = match released {
        Some(i) => opening(raw, i),
        None => {
            warnings.push(
                "the measured history ends in contact: its impulse and contact time are cut short"
                    .to_owned(),
            );
            raw[raw.len() - 1].0
        }
    };
    if raw[first..top].iter().any(|(_, f)| *f <= level) {
        warnings.push(format!("the measured force falls below {percent} % of its peak and rises again: more than one contact, or noise"));
    }
    let start = if shift.is_some() {
        interpolate(raw, first_contact)
    } else {
        0.0
    };
    let mut samples = vec![(0.0, start)];
    let later = raw.iter().filter(|(t, _)| *t > first_contact);
    samples.extend(later.map(|(t, f)| (t - first_contact, *f)));
    let contact_time = end - first_contact;
    let mut contact: Vec<_> = samples
        .iter()
        .filter(|(t, _)| *t < contact_time)
        .copied()
        .collect();
    let in_contact = contact.len() - 1;
    if in_contact < FEW_SAMPLES {
        warnings.push(format!(
            "only {} {} in the contact: peak and impulse are rough",
            counted(in_contact, "sample"),
            agreeing(&in_contact, "lies", "lie")
        ));
    }
    contact.push((
        contact_time,
        if released.is_some() {
            0.0
        } else {
            raw[raw.len() - 1].1
        },
    ));
    Ok(Measured {
        file,
        first_contact,
        found,
        peak: (raw[top].1, raw[top].0 - first_contact),
        contact_time,
        impulse: trapezoid(&contact),
        in_contact,
        samples,
        warnings,
    })
}

/// Time of zero force on the line through the first sample in contact and the next,
/// at most one sample earlier; where the force does not rise any more, the time of
/// the sample before.
fn closure(raw: &[(f64, f64)], first: usize) -> f64 {
    let (time, force) = raw[first];
    let before = first.checked_sub(1).map(|i| raw[i].0);
    match raw.get(first + 1) {
        Some((next_time, next_force)) if *next_force > force => {
            let back = force * (next_time - time) / (next_force - force);
            (time - back).max(before.unwrap_or(time - (next_time - time)))
        }
        _ => before.unwrap_or(time),
    }
}

/// Time of zero force on the line through the last sample in contact and the first
/// after it, at most one sample later.
fn opening(raw: &[(f64, f64)], after: usize) -> f64 {
    let ((t0, f0), (t1, f1)) = (raw[after - 1], raw[after]);
    t1 + (f1 * (t1 - t0) / (f0 - f1)).min(t1 - t0)
}

/// Linear between points, zero beyond the last.
fn interpolate(points: &[(f64, f64)], time: f64) -> f64 {
    let after = points.partition_point(|(t, _)| *t <= time);
    match (after.checked_sub(1).map(|i| points[i]), points.get(after)) {
        (Some((t0, f0)), Some((t1, f1))) => f0 + (f1 - f0) * (time - t0) / (t1 - t0),
        (Some((t, f)), None) if t == time => f,
        _ => 0.0,
    }
}

fn trapezoid(points: &[(f64, f64)]) -> f64 {
    let part = |w: &[(f64, f64)]| 0.5 * (w[1].1 + w[0].1) * (w[1].0 - w[0].0);
    points.windows(2).map(part).sum()
}

/// Puts each model beside the measured history.
pub fn compare(measured: &Measured, collided: &[Collided<'_>]) -> Vec<Compared> {
    collided
        .iter()
        .map(|one| {
            let outcome = &one.outcome;
            let error = |computed: f64, value: f64| 100.0 * (computed - value) / value;
            let (difference, window) = if one.rigid {
                (f64::NAN, f64::NAN)
            } else {
                difference(measured, &outcome.history, outcome.stays_in_contact)
            };
            Compared {
                model: one.chosen.descriptor.name,
                peak: outcome.peak_force,
                peak_error: error(outcome.peak_force, measured.peak.0),
                impulse: one.impulse(),
                impulse_error: error(one.impulse(), measured.impulse),
                duration: one.contact_time(),
                difference,
                window,
            }
        })
        .collect()
}

/// Root mean square of the difference in % of the measured peak, and its window
/// (s): from first contact until both contacts are over, as far as both are known.
fn difference(
    measured: &Measured,
    history: &[CollisionSample],
    stays_in_contact: bool,
) -> (f64, f64) {
    let computed: Vec<_> = history.iter().map(|s| (s.time, s.force)).collect();
    let over = computed.last().map_or(0.0, |(t, _)| *t);
    let known = measured.samples.last().map_or(0.0, |(t, _)| *t);
    let both = if stays_in_contact {
        over
    } else {
        over.max(measured.contact_time)
    };
    let window = both.min(known);
    let square = |time: f64, force: f64| (time, (force - interpolate(&computed, time)).powi(2));
    let inside = measured.samples.iter().filter(|(t, _)| *t < window);
    let mut squares: Vec<_> = inside.map(|(t, f)| square(*t, *f)).collect();
    squares.push(square(window, interpolate(&measured.samples, window)));
    let mean = trapezoid(&squares) / window;
    (100.0 * mean.sqrt() / measured.peak.0, window)
}

impl Measured {
    /// The history in ms and kN until the contact is over, for a picture that shows
    /// computed contacts of up to this length (s).
    pub fn curve(&self, longest: f64) -> Curve {
        let end = self.contact_time.max(longest);
        let shown = self.samples.iter().filter(|(t, _)| *t <= end);
        Curve {
            name: "measured".to_owned(),
            points: shown.map(|(t, f)| (t * 1e3, f * 1e-3)).collect(),
        }
    }

    /// The measured history for machines.
    pub fn json(&self) -> Value {
        json!({
            "file": self.file, "first_contact": self.first_contact,
            "peak_force": {"peak": self.peak.0, "time": self.peak.1},
            "impulse": self.impulse, "duration": self.contact_time,
            "samples_in_contact": self.in_contact, "warnings": self.warnings,
        })
    }
}

impl Compared {
    /// The comparison for machines.
    pub fn json(&self) -> Value {
        json!({
            "peak_force_error_percent": self.peak_error,
            "impulse_error_percent": self.impulse_error,
            "rms_force_difference_percent_of_peak": self.difference,
            "window": self.window,
        })
    }
}

/// The comparison for people.
pub fn text(measured: &Measured, compared: &[Compared]) -> String {
    let mut text = format!(
        "\nAgainst {}\nfirst contact at {} ms there, {}\n{}\n",
        measured.file,
        significant(measured.first_contact * 1e3),
        measured.found,
        comparison(measured, compared)
    );
    text.push_str(&format!(
        "impulse: each over its own contact, measured by trapezoids over {}; rms difference: from first contact until both contacts are over\n",
        counted(measured.in_contact, "sample")
    ));
    for warning in &measured.warnings {
        text.push_str(&format!("warning: {warning}\n"));
    }
    text
}

fn comparison(measured: &Measured, compared: &[Compared]) -> Table {
    let header = [
        "",
        "peak force (kN)",
        "error %",
        "impulse (kN s)",
        "error %",
        "contact time (ms)",
        "rms difference (% of measured peak)",
        "over (ms)",
    ];
    let mut table = right_aligned(header.map(str::to_owned).into());
    let kilo = |x: f64| significant(x * 1e-3);
    let milli = |x: f64| significant(x * 1e3);
    table.add_row([
        "measured".to_owned(),
        kilo(measured.peak.0),
        String::new(),
        kilo(measured.impulse),
        String::new(),
        milli(measured.contact_time),
        String::new(),
        String::new(),
    ]);
    for c in compared {
        table.add_row([
            c.model.to_owned(),
            kilo(c.peak),
            signed_percent(c.peak_error),
            kilo(c.impulse),
            signed_percent(c.impulse_error),
            milli(c.duration),
            significant(c.difference),
            milli(c.window),
        ]);
    }
    table
}
