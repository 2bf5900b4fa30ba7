//! Grounds motions under the buildings, and which degree of freedom follows which.

use pounding_shear_building::{Excitation, ShearBuilding};
use std::sync::Arc;

use super::{GroundAcceleration, System};
use crate::dynamics::Segment;
use crate::error::TimeHistoryError;
use crate::outcome::Peak;

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

impl System {
    /// Acceleration of the ground that degree of freedom `i` is relative to, as the equation
    /// of motion takes it (m/s2).
    #[inline]
    pub(crate) fn ground_on(&self, i: usize, ground: Grounds) -> f64 {
        match &self.motions {
            None => ground.first,
            Some(motions) => {
                let (motion, weight) = motions.loads[i];
                if weight == 0.0 {
                    return 0.0;
                }
                let (value, slope) = match motions.intervals.get(ground.interval) {
                    None => (0.0, 0.0),
                    Some(interval) => (interval.loads[motion][0], interval.loads[motion][1]),
                };
                weight * (value + slope * ground.tau)
            }
        }
    }

    /// Slope of the same (m/s3).
    pub(crate) fn ground_slope_on(&self, i: usize, segment: &Segment) -> f64 {
        match &self.motions {
            None => segment.slope,
            Some(motions) => {
                let (motion, weight) = motions.loads[i];
                let interval = motions.intervals.get(segment.interval);
                weight * interval.map_or(0.0, |interval| interval.loads[motion][1])
            }
        }
    }

    /// Whether no ground acceleration jumps between two instants at the same time.
    pub(crate) fn same_ground(&self, a: Grounds, b: Grounds) -> bool {
        match &self.motions {
            None => a.first == b.first,
            Some(motions) => {
                let at = |ground: Grounds, motion: usize| {
                    let interval = motions.intervals.get(ground.interval);
                    interval.map_or(0.0, |interval| {
                        interval.loads[motion][0] + interval.loads[motion][1] * ground.tau
                    })
                };
                (0..motions.motions.len()).all(|m| {
                    let (a, b) = (at(a, m), at(b, m));
                    (a - b).abs() <= 1.0e-12 * a.abs().max(b.abs())
                })
            }
        }
    }

    /// Interval number `sample` up to the end of the run, in which every ground acceleration is
    /// linear; after the last sample the ground stands still.
    pub(crate) fn segment(&self, sample: usize, duration: f64) -> Option<Segment> {
        match &self.motions {
            None => self.segment_of_samples(sample, duration),
            Some(motions) => {
                let intervals = &motions.intervals;
                let step = self.ground.time_step;
                let (start, length) = match intervals.get(sample) {
                    Some(interval) => (interval.start, interval.length),
                    None => {
                        let end = intervals.last().map_or(0.0, |i| i.start + i.length);
                        (end + (sample - intervals.len()) as f64 * step, step)
                    }
                };
                let rest = duration - start;
                if rest <= 1.0e-9 * step {
                    return None;
                }
                let whole = rest > length * (1.0 - 1.0e-9) && rest < length * (1.0 + 1.0e-9);
                let [acceleration, slope] = intervals.get(sample).map_or([0.0; 2], |i| i.loads[0]);
                Some(Segment {
                    start,
                    length: if whole { length } else { rest.min(length) },
                    acceleration,
                    slope,
                    interval: sample,
                })
            }
        }
    }

    fn segment_of_samples(&self, sample: usize, duration: f64) -> Option<Segment> {
        let ground = &self.ground;
        let start = sample as f64 * ground.time_step;
        // The last interval may be round-off: duration is often a whole number of steps.
        let rest = duration - start;
        if rest <= 1.0e-9 * ground.time_step {
            return None;
        }
        let (a, b) = match (ground.samples.get(sample), ground.samples.get(sample + 1)) {
            (Some(a), Some(b)) => (*a, *b),
            _ => (0.0, 0.0),
        };
        let whole = ground.time_step;
        let length = if rest < whole * (1.0 + 1.0e-9) && rest > whole * (1.0 - 1.0e-9) {
            whole
        } else {
            rest.min(whole)
        };
        Some(Segment {
            start,
            length,
            acceleration: a,
            slope: (b - a) / whole,
            interval: sample,
        })
    }

    /// Lengths (s) of the intervals in which every ground acceleration is linear.
    pub(crate) fn interval_lengths(&self) -> Vec<f64> {
        match &self.motions {
            None => vec![self.ground.time_step],
            Some(motions) => motions.intervals.iter().map(|i| i.length).collect(),
        }
    }

    /// Whether two degrees of freedom are relative to the same ground.
    pub(crate) fn same_load(&self, i: usize, j: usize) -> bool {
        let motions = self.motions.as_ref();
        motions.is_none_or(|motions| motions.loads[i] == motions.loads[j])
    }

    /// Ground accelerations at time zero.
    pub(crate) fn ground_at_start(&self) -> Grounds {
        let first = self.ground.samples.first().copied().unwrap_or(0.0);
        let delayed = self
            .motions
            .as_ref()
            .is_some_and(|m| m.motions[0].delay > 0.0);
        Grounds {
            first: if delayed { 0.0 } else { first },
            interval: 0,
            tau: 0.0,
        }
    }

    /// Time (s) until which all ground stands still.
    pub(crate) fn ground_at_rest_until(&self) -> f64 {
        let of = |ground: &GroundAcceleration, delay: f64| {
            let first = ground.samples.iter().position(|a| *a != 0.0)?;
            Some(delay + first.saturating_sub(1) as f64 * ground.time_step)
        };
        match &self.motions {
            None => of(&self.ground, 0.0).unwrap_or(0.0),
            Some(motions) => {
                let begin = motions.motions.iter();
                let begin = begin.filter_map(|m| of(&m.acceleration, m.delay));
                begin.reduce(f64::min).unwrap_or(0.0)
            }
        }
    }

    /// The ground motions, the first of which is [`System::ground`]; empty where that one is
    /// under all buildings.
    #[must_use]
    pub fn ground_motions(&self) -> &[GroundMotion] {
        self.motions.as_ref().map_or(&[], |m| &m.motions)
    }

    /// Displacement of the ground at the left side of a contact level less that at the right
    /// one when the last ground motion ends (m); `None` where it is the same by definition.
    #[must_use]
    pub fn ground_offset_at_end(&self, level: usize) -> Option<f64> {
        let (motions, terms) = (self.motions.as_ref()?, &self.levels[level].terms);
        let first = self.with_mass();
        let of = |(dof, weight): &(usize, f64)| {
            weight * motions.displacement_at_end(self.moving_ground[dof - first])
        };
        (!terms.ground.is_empty()).then(|| terms.ground.iter().map(of).sum())
    }

    /// Maximum absolute displacement of the ground at the left side of a contact level relative
    /// to that at the right one (m) in a run of this duration (s), from the double integral of
    /// the accelerations, exact inside every interval; `None` where it is the same by definition.
    #[must_use]
    pub fn relative_ground_displacement(&self, level: usize, duration: f64) -> Option<Peak> {
        let terms = &self.levels[level].terms;
        if self.motions.is_none() || terms.ground.is_empty() {
            return None;
        }
        let first = self.with_mass();
        let sides = terms.ground.iter();
        let sides: Vec<(usize, f64)> = sides
            .map(|(dof, weight)| (self.moving_ground[dof - first], *weight))
            .collect();
        let mut peak = Peak::default();
        let (mut x, mut v) = (0.0, 0.0);
        let segments = (0..).map_while(|k| self.segment(k, duration));
        for segment in segments {
            let [a, slope] = self.motions.as_ref().map_or([0.0; 2], |motions| {
                let loads = motions.intervals.get(segment.interval).map(|i| &i.loads);
                let sum = |k: usize| -> f64 {
                    let of = |(motion, weight): &(usize, f64)| {
                        weight * loads.map_or(0.0, |loads| loads[*motion][k])
                    };
                    sides.iter().map(of).sum()
                };
                [sum(0), sum(1)]
            });
            let velocity = |s: f64| v + s * (a + 0.5 * s * slope);
            let displacement = |s: f64| x + s * (v + s * (0.5 * a + s * slope / 6.0));
            // It turns where the velocity, a parabola, is zero.
            let root = (a * a - 2.0 * slope * v).max(0.0).sqrt();
            let half = -(a + root.copysign(a));
            let turns = [half / slope, 2.0 * v / half];
            let inside = turns.into_iter().filter(|s| *s > 0.0 && *s < segment.length);
            for s in inside.chain([segment.length]) {
                peak.raise(displacement(s).abs(), segment.start + s);
            }
            (x, v) = (displacement(segment.length), velocity(segment.length));
        }
        Some(peak)
    }

    /// Ground motion along the row under a building, by its number in
    /// [`System::ground_motions`].
    pub(crate) fn motion_under(&self, building: usize) -> usize {
        let motions = self.motions.as_ref();
        motions.map_or(0, |m| m.supports[building].along)
    }

    /// Degree of freedom that is the displacement of a ground motion; made when first asked for.
    pub(super) fn displacement_of_ground(&mut self, motion: usize) -> usize {
        let first = self.with_mass();
        if let Some(k) = self.moving_ground.iter().position(|m| *m == motion) {
            return first + k;
        }
        if self.motions.is_none() {
            self.motions = self.under_one_motion().map(Arc::new);
        }
        if let Some(motions) = &mut self.motions {
            Arc::make_mut(motions).loads.push((motion, -1.0));
        }
        let n = self.mass.len();
        self.mass.push(1.0);
        self.initial.insert(n, 0.0);
        self.initial.push(0.0);
        self.moving_ground.push(motion);
        n
    }
}
