//! Computed against measured force.

use pounding_catalogue::numbers::significant;
use pounding_catalogue::wording::{agreeing, counted};

use crate::collision::CollisionOutcome;

/// Samples in contact below which a measured history says little.
const FEW_SAMPLES: usize = 10;

/// A measured force history from its first contact on.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredForce {
    /// What the history is called, such as its file.
    pub name: String,
    /// Time of first contact in the history (s).
    pub first_contact: f64,
    /// Time after first contact (s) and force (N), from first contact to the end of the
    /// history.
    pub samples: Vec<(f64, f64)>,
    /// Maximum force (N) and its time after first contact (s).
    pub peak: (f64, f64),
    /// Time from first contact to the end of the contact (s).
    pub contact_time: f64,
    /// Impulse of the contact by trapezoids (N s).
    pub impulse: f64,
    /// Samples in the contact.
    pub samples_in_contact: usize,
    /// Time (s) and force (N) as in the history.
    raw: Vec<(f64, f64)>,
    /// The first sample in contact among them, and the highest.
    first_and_top: (usize, usize),
    /// Whether the first contact was given.
    is_given: bool,
    /// What makes the numbers doubtful.
    pub warnings: Vec<String>,
}

/// A measured history that cannot be compared with.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeasuredForceError {
    /// A threshold that is no part of the peak.
    #[error("threshold is {threshold}, but it must lie between 0 and 1")]
    Threshold {
        /// Part of the peak above which there is contact (-).
        threshold: f64,
    },
    /// A history without a contact force.
    #[error("{name} has no force above zero")]
    NoForce {
        /// History.
        name: String,
    },
    /// A first contact outside the history, or after its peak.
    #[error(
        "first contact at {first_contact} s is not between the start of {name} and its peak at {peak} s"
    )]
    FirstContact {
        /// History.
        name: String,
        /// Time of first contact (s).
        first_contact: f64,
        /// Time of the peak (s).
        peak: f64,
        /// Whether it was given, and not found in the history.
        given: bool,
    },
}

impl MeasuredForceError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> &'static str {
        match self {
            Self::Threshold { .. } => "it is a part of the measured peak: \"1 %\" is usual",
            Self::NoForce { .. } => "give a force that pushes the bodies apart as positive",
            Self::FirstContact { given: true, .. } => {
                "--shift is the time of first contact in the measured history"
            }
            Self::FirstContact { given: false, .. } => {
                "raise --threshold above the noise before the contact, such as \"20 %\"; or give the time of first contact as --shift"
            }
        }
    }
}

/// A collision beside the measured history; percentages are of the measured value.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Difference {
    /// Error of the peak force (%).
    pub peak_force_error_percent: f64,
    /// Error of the impulse (%); not a number for bodies that stay in contact.
    pub impulse_error_percent: f64,
    /// Root mean square of the difference of the forces (% of the measured peak); not a number
    /// for a rigid impact.
    pub rms_force_difference_percent_of_peak: f64,
    /// Its window (s): from first contact until both contacts are over, as far as both are
    /// known; not a number for a rigid impact.
    pub window: f64,
    /// First contact in the measured history (s) for this law.
    pub first_contact: f64,
}

impl MeasuredForce {
    /// Counts the time of samples of time (s) and force (N) from first contact, and finds peak,
    /// end and impulse of the contact. First contact is at `shift` (s), else where the line
    /// through the first sample above `threshold` of the peak and one of twice its force meets zero.
    ///
    /// # Errors
    /// A threshold that does not lie between 0 and 1, no force above zero, or a first contact
    /// that is not between the start of the history and its peak.
    pub fn align(
        name: String,
        raw: &[(f64, f64)],
        threshold: f64,
        shift: Option<f64>,
    ) -> Result<Self, MeasuredForceError> {
        if !(threshold > 0.0 && threshold < 1.0) {
            return Err(MeasuredForceError::Threshold { threshold });
        }
        let top = (0..raw.len()).max_by(|a, b| raw[*a].1.total_cmp(&raw[*b].1));
        let Some(top) = top.filter(|i| raw[*i].1 > 0.0) else {
            return Err(MeasuredForceError::NoForce { name });
        };
        let level = threshold * raw[top].1;
        let percent = significant(100.0 * threshold);
        let first = raw.iter().position(|(_, f)| *f > level).unwrap_or(top);
        let first_contact = shift.unwrap_or_else(|| closure(raw, (first, top), 1.0));
        let step = raw.get(1).map_or(0.0, |second| second.0 - raw[0].0);
        // What begins in contact, and not in noise, began before.
        let noisy = raw[first..top].iter().any(|(_, f)| *f <= level);
        let cut = first == 0 && !noisy && shift.is_none() && first_contact.is_finite();
        if !(first_contact >= raw[0].0 - step || cut) || !(first_contact <= raw[top].0) {
            return Err(MeasuredForceError::FirstContact {
                name,
                first_contact,
                peak: raw[top].0,
                given: shift.is_some(),
            });
        }
        let mut warnings = Vec::new();
        // Who says that contact begins with the first sample knows a force that jumps.
        if first == 0 && raw[0].1 > level && shift.is_none_or(|t| t < raw[0].0) {
            warnings.push(
                "the measured history begins in contact: its first contact, impulse and contact time are cut short, and its peak may be"
                    .to_owned(),
            );
        }
        let released = (top..raw.len()).find(|i| raw[*i].1 <= level);
        let end = match released {
            Some(i) => opening(raw, i, top),
            None => {
                warnings.push(
                    "the measured history ends in contact: its impulse and contact time are cut short"
                        .to_owned(),
                );
                raw[raw.len() - 1].0
            }
        };
        if noisy {
            warnings.push(format!("the measured force falls below {percent} % of its peak and rises again: more than one contact, or noise, above which --threshold is to be raised"));
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
        let in_contact = samples.iter().filter(|(t, _)| *t < contact_time);
        let mut contact: Vec<_> = in_contact.copied().collect();
        let samples_in_contact = contact.len() - 1;
        if samples_in_contact < FEW_SAMPLES {
            warnings.push(format!(
                "only {} {} in the contact: peak and impulse are rough",
                counted(samples_in_contact, "sample"),
                agreeing(&samples_in_contact, "lies", "lie")
            ));
        }
        let last = released.map_or(raw[raw.len() - 1].1, |_| 0.0);
        contact.push((contact_time, last));
        Ok(Self {
            raw: raw.to_vec(),
            first_and_top: (first, top),
            is_given: shift.is_some(),
            name,
            first_contact,
            peak: (raw[top].1, raw[top].0 - first_contact),
            contact_time,
            impulse: trapezoid(&contact),
            samples_in_contact,
            samples,
            warnings,
        })
    }

    /// First contact in the history (s) for a law whose force begins as a power of the
    /// penetration with this exponent (-): where the line through the first two samples in
    /// contact of `F^(1/exponent)` meets zero, not much earlier; that given, where one was.
    #[must_use]
    pub fn first_contact_of(&self, exponent: f64) -> f64 {
        match self.is_given {
            true => self.first_contact,
            false => closure(&self.raw, self.first_and_top, exponent),
        }
    }

    /// How far a collision by a law with this exponent (-) is from the history.
    #[must_use]
    pub fn difference(&self, outcome: &CollisionOutcome, exponent: f64) -> Difference {
        let error = |computed: f64, value: f64| 100.0 * (computed - value) / value;
        let first_contact = self.first_contact_of(exponent);
        let (rms, window) = self.force_difference(outcome, first_contact);
        Difference {
            peak_force_error_percent: error(outcome.peak_force, self.peak.0),
            impulse_error_percent: error(outcome.impulse_of_parted(), self.impulse),
            rms_force_difference_percent_of_peak: rms,
            window,
            first_contact,
        }
    }

    /// Root mean square of the difference in % of the measured peak, and its window (s), with the
    /// closure of the collision at this time of the history (s).
    fn force_difference(&self, outcome: &CollisionOutcome, first_contact: f64) -> (f64, f64) {
        if outcome.is_rigid() {
            return (f64::NAN, f64::NAN);
        }
        let history = outcome.history.iter();
        let computed: Vec<_> = history.map(|s| (s.time, s.force)).collect();
        let start = match self.is_given {
            true => interpolate(&self.raw, first_contact),
            false => 0.0,
        };
        let mut samples = vec![(0.0, start)];
        let later = self.raw.iter().filter(|(t, _)| *t > first_contact);
        samples.extend(later.map(|(t, f)| (t - first_contact, *f)));
        let over = computed.last().map_or(0.0, |(t, _)| *t);
        let known = samples.last().map_or(0.0, |(t, _)| *t);
        let both = if outcome.stays_in_contact {
            over
        } else {
            over.max(self.contact_time + self.first_contact - first_contact)
        };
        let window = both.min(known);
        let square = |time: f64, force: f64| (time, (force - interpolate(&computed, time)).powi(2));
        let inside = samples.iter().filter(|(t, _)| *t < window);
        let mut squares: Vec<_> = inside.map(|(t, f)| square(*t, *f)).collect();
        squares.push(square(window, interpolate(&samples, window)));
        let mean = trapezoid(&squares) / window;
        (100.0 * mean.sqrt() / self.peak.0, window)
    }
}

/// The numbers of the contact, without the samples.
#[cfg(feature = "serde")]
impl serde::Serialize for MeasuredForce {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let peak = crate::collision::PeakOf {
            peak: self.peak.0,
            time: self.peak.1,
        };
        let mut object = serializer.serialize_struct("MeasuredForce", 7)?;
        object.serialize_field("file", &self.name)?;
        object.serialize_field("first_contact", &self.first_contact)?;
        object.serialize_field("peak_force", &peak)?;
        object.serialize_field("impulse", &self.impulse)?;
        object.serialize_field("duration", &self.contact_time)?;
        object.serialize_field("samples_in_contact", &self.samples_in_contact)?;
        object.serialize_field("warnings", &self.warnings)?;
        object.end()
    }
}

/// Time of zero force on the line through the first sample in contact and one of twice its height,
/// or the next where it is higher, of forces to the power `1/exponent`. A force that begins slowly
/// has samples below the threshold: closure may be earlier by as many samples as the exponent rounded
/// up, or by as many times the time between the two, but not before the last sample without a force that
/// pushes. Where the force does not rise any more, the time of the sample before.
fn closure(raw: &[(f64, f64)], (first, top): (usize, usize), exponent: f64) -> f64 {
    let root = |force: f64| libm::pow(force, 1.0 / exponent);
    let (time, force) = raw[first];
    let samples = (1..=first).take_while(|i| (*i as f64) < exponent + 1.0);
    let earliest = raw[first - samples.last().unwrap_or(0)].0;
    let higher = (first + 1..=top).find(|i| raw[*i].1 >= 2.0 * force);
    let force = root(force);
    match raw.get(higher.unwrap_or(first + 1)) {
        Some((later, higher)) if root(*higher) > force => {
            let apart = later - time;
            let back = force * apart / (root(*higher) - force);
            let open = raw[..first].iter().rev().find(|(_, f)| *f <= 0.0);
            let without = time - apart;
            let bound = match (first, open) {
                (0, _) => without,
                (_, Some((open, _))) => earliest.min(time - (exponent + 1.0) * apart).max(*open),
                (_, None) => earliest.min(time - (exponent + 1.0) * apart),
            };
            (time - back).max(bound)
        }
        _ => raw[first.saturating_sub(1)].0,
    }
}

/// Time of zero force on the line through the last sample of twice the height of the first one
/// after the contact, or the last in contact where that is higher, and that one: at most as much
/// later as they are apart, and no later than a sample without a force that pushes.
fn opening(raw: &[(f64, f64)], after: usize, top: usize) -> f64 {
    let (t1, f1) = raw[after];
    let higher = (top..after).rev().find(|i| raw[*i].1 >= 2.0 * f1);
    let (t0, f0) = raw[higher.unwrap_or(after - 1)];
    let crossing = t1 + (f1 * (t1 - t0) / (f0 - f1)).min(t1 - t0);
    let open = raw[after..].iter().find(|(_, f)| *f <= 0.0);
    open.map_or(crossing, |(open, _)| crossing.min(*open))
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
