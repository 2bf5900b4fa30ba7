//! Grounds motions under the buildings, and which degree of freedom follows which.

use pounding_shear_building::{Excitation, ShearBuilding};
use std::sync::Arc;

use super::GroundAcceleration;
use crate::error::TimeHistoryError;

/// A ground motion that begins some time after the run.
#[derive(Debug, Clone)]
pub struct GroundMotion {
    /// The acceleration, zero before it begins and after its last sample.
    pub acceleration: GroundAcceleration,
    /// Time (s) of its first sample.
    pub delay: f64,
}

/// Which ground motions move the ground under a building, by their number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Support {
    /// Along the row of buildings.
    pub along: usize,
    /// Across the row, for coordinates that feel it; `None` is ground at rest.
    pub across: Option<usize>,
}

/// Ground accelerations at an instant: that of the first motion, and where to find the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grounds {
    /// Acceleration of the first motion (m/s2).
    pub first: f64,
    /// Number of the interval, and time (s) since its start.
    pub interval: usize,
    pub tau: f64,
}

/// An interval in which all motions are linear.
#[derive(Debug, Clone)]
pub(crate) struct Interval {
    pub start: f64,
    pub length: f64,
    /// Acceleration at the start (m/s2) and slope (m/s3) of every motion.
    pub loads: Vec<[f64; 2]>,
}

/// Several motions, or coordinates that do not all follow the one there is.
#[derive(Debug, Clone)]
pub(crate) struct Motions {
    pub motions: Vec<GroundMotion>,
    pub supports: Vec<Support>,
    pub intervals: Vec<Interval>,
    /// Motion and weight of every degree of freedom: its acceleration relative to the ground
    /// is less by the product. A displacement of the ground has the weight -1.
    pub loads: Vec<(usize, f64)>,
}

/// A day (s): beyond, the digits of the time do not tell the samples of a record apart.
const LONGEST_DELAY: f64 = 86_400.0;
/// Breakpoints closer than this part of a time step are one.
const SAME: f64 = 1.0e-9;

impl Motions {
    /// # Errors
    /// No motion, supports that are not one a building or name no motion, a delay that is
    /// negative or not finite.
    pub(super) fn new(
        motions: Vec<GroundMotion>,
        supports: Vec<Support>,
        buildings: &[Arc<ShearBuilding>],
    ) -> Result<Self, TimeHistoryError> {
        let wrong = |reason: String| TimeHistoryError::Motions { reason };
        if motions.is_empty() || supports.len() != buildings.len() {
            return Err(wrong(format!(
                "there are {} ground motions, and supports of {} buildings for {}",
                motions.len(),
                supports.len(),
                buildings.len()
            )));
        }
        for support in &supports {
            let named = [Some(support.along), support.across];
            if let Some(m) = named.into_iter().flatten().find(|m| *m >= motions.len()) {
                return Err(wrong(format!("there is no ground motion {}", m + 1)));
            }
        }
        for motion in &motions {
            if !(0.0..=LONGEST_DELAY).contains(&motion.delay) {
                let delay = motion.delay;
                return Err(wrong(format!(
                    "a delay of {delay} s; it must be from zero to {LONGEST_DELAY} s"
                )));
            }
        }
        let mut this = Self {
            intervals: intervals(&motions),
            motions,
            supports,
            loads: Vec::new(),
        };
        for (building, support) in buildings.iter().zip(&this.supports) {
            this.loads
                .extend(building.mass().iter().map(|_| (support.along, 1.0)));
        }
        for (building, support) in buildings.iter().zip(&this.supports) {
            let further = building.further_coordinates().iter();
            this.loads
                .extend(further.map(|c| match (c.excitation, support.across) {
                    (Excitation::Along, _) => (support.along, 1.0),
                    (Excitation::Across, Some(motion)) => (motion, 1.0),
                    _ => (0, 0.0),
                }));
        }
        Ok(this)
    }

    /// The same with another record in the place of the first one.
    pub(super) fn with_first(&self, old: &GroundAcceleration, new: &GroundAcceleration) -> Self {
        let mut motions = self.motions.clone();
        for motion in &mut motions {
            if Arc::ptr_eq(&motion.acceleration.samples, &old.samples) {
                motion.acceleration = new.clone();
            }
        }
        Self {
            intervals: intervals(&motions),
            motions,
            ..self.clone()
        }
    }

    /// Displacement (m) of a motion at the end of the last one, from rest.
    pub(super) fn displacement_at_end(&self, motion: usize) -> f64 {
        let (mut x, mut v) = (0.0, 0.0);
        for Interval {
            length: h, loads, ..
        } in &self.intervals
        {
            let [a, slope] = loads[motion];
            x += h * (v + h * (0.5 * a + h * slope / 6.0));
            v += h * (a + 0.5 * h * slope);
        }
        x
    }

    /// End of the last motion (s).
    pub(super) fn duration(&self) -> f64 {
        let ends = self
            .motions
            .iter()
            .map(|m| m.delay + m.acceleration.duration());
        ends.fold(0.0, f64::max)
    }
}

impl GroundAcceleration {
    /// Time of its last sample (s).
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.time_step * self.samples.len().saturating_sub(1) as f64
    }

    /// Acceleration and slope inside one of its intervals.
    fn over(&self, interval: usize) -> [f64; 2] {
        match (self.samples.get(interval), self.samples.get(interval + 1)) {
            (Some(a), Some(b)) => [*a, (b - a) / self.time_step],
            _ => [0.0; 2],
        }
    }
}

/// The union of the breakpoints of all motions, from zero to the end of the last.
fn intervals(motions: &[GroundMotion]) -> Vec<Interval> {
    let step = |m: &GroundMotion| m.acceleration.time_step;
    let least = motions.iter().map(step).fold(f64::INFINITY, f64::min);
    let mut times = vec![0.0];
    for motion in motions {
        let count = motion.acceleration.samples.len();
        times.extend((0..count).map(|k| motion.delay + k as f64 * step(motion)));
    }
    times.sort_by(f64::total_cmp);
    times.dedup_by(|later, earlier| *later - *earlier <= SAME * least);
    let over = |ends: &[f64]| {
        let (start, length) = (ends[0], ends[1] - ends[0]);
        let loads = motions.iter().map(|motion| {
            // The middle tells the interval of the motion; its load is that at the start.
            let place = (start + 0.5 * length - motion.delay) / step(motion);
            if place < 0.0 {
                return [0.0; 2];
            }
            let interval = place.floor();
            let [a, slope] = motion.acceleration.over(interval as usize);
            let since = start - motion.delay - interval * step(motion);
            let since = if since.abs() <= SAME * least {
                0.0
            } else {
                since
            };
            [a + slope * since, slope]
        });
        Interval {
            start,
            length,
            loads: loads.collect(),
        }
    };
    times.windows(2).map(over).collect()
}
