//! Ground motions under the buildings and forces on floors, and which degree of freedom follows
//! which.

use pounding_shear_building::{Excitation, ShearBuilding};
use std::sync::Arc;

use super::{CLOSE, GroundAcceleration, Grounds, Segment, System, no_storey};
use crate::error::TimeHistoryError;
use crate::peak::Peak;
use crate::short_numbers::short;

/// A ground motion that begins some time after the run.
#[derive(Debug, Clone)]
pub struct GroundMotion {
    /// The acceleration, zero before it begins and after its last sample.
    pub acceleration: GroundAcceleration,
    /// Time (s) of its first sample.
    pub delay: f64,
    /// Where it comes from, line by line, for the user; may be empty.
    pub origin: Vec<String>,
}

/// Which ground motions move the ground under a building, by their number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Support {
    /// Along the row of buildings.
    pub along: usize,
    /// Across the row, for coordinates that feel it; `None` is ground at rest.
    pub across: Option<usize>,
}

/// A force on a floor over time, positive to the right, linear between points: whatever is
/// made of straight lines is exact.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceHistory {
    points: Arc<[(f64, f64)]>,
    stays: bool,
}

/// A force on a floor.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorForce {
    /// Building, from zero.
    pub building: usize,
    /// Storey below the floor, from zero.
    pub storey: usize,
    /// The force.
    pub history: ForceHistory,
    /// Where it comes from, for the user; may be empty.
    pub origin: String,
}

impl ForceHistory {
    /// Times (s), none before the one before it, and forces (N). Two points at one time are a
    /// jump. Before the first point there is no force; after the last one there is none, or it
    /// stays.
    ///
    /// # Errors
    /// No points, times that go back, are negative or beyond a day, three points at one time,
    /// numbers that are not finite.
    pub fn new(points: &[(f64, f64)], stays: bool) -> Result<Self, TimeHistoryError> {
        let this = Self {
            points: points.into(),
            stays,
        };
        match this.fault() {
            Some(reason) => Err(TimeHistoryError::Force { reason }),
            None => Ok(this),
        }
    }

    /// What is wrong with it.
    fn fault(&self) -> Option<String> {
        if self.points.is_empty() {
            return Some("there are no points".to_owned());
        }
        let finite = |p: &&(f64, f64)| !(p.0.is_finite() && p.1.is_finite());
        if let Some((t, force)) = self.points.iter().find(finite) {
            return Some(format!("a point of {t} s and {force} N"));
        }
        let in_time = |t: f64| (0.0..=LONGEST_DELAY).contains(&t);
        if let Some((t, _)) = self.points.iter().find(|p| !in_time(p.0)) {
            return Some(format!(
                "a point at {t} s; times are from zero to {LONGEST_DELAY} s"
            ));
        }
        let mut pairs = self.points.windows(2);
        if let Some(pair) = pairs.find(|p| p[1].0 < p[0].0) {
            let (later, earlier) = (pair[1].0, pair[0].0);
            return Some(format!("the time {later} s stands after {earlier} s"));
        }
        let mut triples = self.points.windows(3);
        let three = triples.find(|p| p[0].0 == p[2].0);
        three.map(|p| format!("three points at {} s", p[0].0))
    }

    /// Time (s) until which there is no force; `None` if there never is one.
    pub(super) fn begin(&self) -> Option<f64> {
        let first = self.points.iter().position(|p| p.1 != 0.0)?;
        Some(self.points[first.saturating_sub(1)].0)
    }

    /// Time of the last point (s).
    fn end(&self) -> f64 {
        self.points.last().map_or(0.0, |p| p.0)
    }

    /// Force (N) at an instant and slope (N/s) around another, between whose points and the
    /// first none lies.
    fn line(&self, at: f64, around: f64) -> [f64; 2] {
        let next = self.points.partition_point(|p| p.0 <= around);
        match (
            next.checked_sub(1).map(|k| self.points[k]),
            self.points.get(next),
        ) {
            (Some((t0, f0)), Some((t1, f1))) => {
                let slope = (f1 - f0) / (t1 - t0);
                [f0 + slope * (at - t0), slope]
            }
            (Some((_, last)), None) if self.stays => [last, 0.0],
            _ => [0.0; 2],
        }
    }

    /// Times (s) and forces (N).
    #[must_use]
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// Whether the last force stays.
    #[must_use]
    pub fn stays(&self) -> bool {
        self.stays
    }

    /// Force (N) at an instant (s), after a jump that happens there.
    #[must_use]
    pub fn at(&self, time: f64) -> f64 {
        self.line(time, time)[0]
    }

    /// Force (N) at an instant (s), before a jump that happens there but for round-off of its time,
    /// which is how rows of histories are taken; at time zero, with which all begins, after it.
    #[must_use]
    pub fn before(&self, time: f64) -> f64 {
        let clearly_before = time * (1.0 - CLOSE);
        let next = self.points.partition_point(|p| p.0 < clearly_before);
        let before = next.checked_sub(1).map(|k| self.points[k]);
        match (before, self.points.get(next)) {
            _ if time <= 0.0 => self.at(time),
            (Some((t0, f0)), Some((t1, f1))) => f0 + (f1 - f0) / (t1 - t0) * (time - t0),
            (Some((_, last)), None) if self.stays => last,
            _ => 0.0,
        }
    }

    /// Largest absolute force (N) and when it is there first.
    #[must_use]
    pub fn peak(&self) -> Peak {
        let mut peak = Peak::default();
        for (time, force) in self.points.iter() {
            peak.raise(force.abs(), *time);
        }
        peak
    }
}

/// An interval in which all motions and forces are linear.
#[derive(Debug, Clone)]
pub(crate) struct Interval {
    pub start: f64,
    pub length: f64,
    /// Acceleration at the start (m/s2) and slope (m/s3) of every motion, then of every degree
    /// of freedom with forces.
    pub loads: Vec<[f64; 2]>,
    /// Whether any of them jumps where it begins.
    pub jumps: bool,
}

/// Several motions, forces, or coordinates that do not all follow the one motion there is.
#[derive(Debug, Clone)]
pub(crate) struct Motions {
    pub motions: Vec<GroundMotion>,
    pub supports: Vec<Support>,
    pub forces: Vec<FloorForce>,
    pub intervals: Vec<Interval>,
    /// Loads after the last of the intervals.
    pub after: Vec<f64>,
    /// Whether any of them jumps there.
    pub jumps_at_end: bool,
    /// Motion and weight of every degree of freedom: its acceleration relative to the ground
    /// is less by the product. A displacement of the ground has the weight -1.
    pub grounds: Vec<(usize, f64)>,
    /// The same with what forces on it add: a load beyond the motions where there are any.
    pub loads: Vec<(usize, f64)>,
    /// What those loads are made of.
    pushed: Vec<Pushed>,
}

/// The load of a degree of freedom with forces.
#[derive(Debug, Clone)]
struct Pushed {
    /// Ground motion and its weight.
    ground: (usize, f64),
    mass: f64,
    /// Numbers of the forces.
    forces: Vec<usize>,
}

/// Longest delay of a ground motion (s), a day: beyond, the digits of the time do not tell the samples of a record apart.
pub const LONGEST_DELAY: f64 = 86_400.0;
/// Breakpoints closer than this part of a time step are one.
const SAME: f64 = 1.0e-9;
/// Part of a displacement of the ground that is its round-off.
const SAME_DISPLACEMENT: f64 = 1.0e-10;

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
            motions,
            supports,
            forces: Vec::new(),
            intervals: Vec::new(),
            after: Vec::new(),
            jumps_at_end: false,
            grounds: Vec::new(),
            loads: Vec::new(),
            pushed: Vec::new(),
        };
        this.lay_out_intervals();
        for (building, support) in buildings.iter().zip(&this.supports) {
            this.grounds
                .extend(building.mass().iter().map(|_| (support.along, 1.0)));
        }
        for (building, support) in buildings.iter().zip(&this.supports) {
            let further = building.further_coordinates().iter();
            this.grounds
                .extend(further.map(|c| match (c.excitation, support.across) {
                    (Excitation::Along, _) => (support.along, 1.0),
                    (Excitation::Across, Some(motion)) => (motion, 1.0),
                    _ => (0, 0.0),
                }));
        }
        this.loads.clone_from(&this.grounds);
        Ok(this)
    }

    /// The same with forces on floors, in the place of those there are.
    ///
    /// # Errors
    /// A floor that does not exist.
    fn with_forces(
        &self,
        forces: Vec<FloorForce>,
        buildings: &[Arc<ShearBuilding>],
        offsets: &[usize],
        mass: &[f64],
    ) -> Result<Self, TimeHistoryError> {
        let mut this = self.clone();
        this.loads.clone_from(&this.grounds);
        this.pushed.clear();
        for (number, force) in forces.iter().enumerate() {
            let wrong = |reason: String| TimeHistoryError::Force { reason };
            let Some(building) = buildings.get(force.building) else {
                let count = buildings.len();
                return Err(wrong(format!(
                    "there is no building of index {}; there are {count}, counted from zero",
                    force.building
                )));
            };
            if force.storey >= building.storeys() {
                return Err(wrong(no_storey(building, force.storey)));
            }
            let dof = offsets[force.building] + force.storey;
            let (load, _) = this.loads[dof];
            match load.checked_sub(this.motions.len()) {
                Some(known) => this.pushed[known].forces.push(number),
                None => {
                    this.loads[dof] = (this.motions.len() + this.pushed.len(), 1.0);
                    this.pushed.push(Pushed {
                        ground: this.grounds[dof],
                        mass: mass[dof],
                        forces: vec![number],
                    });
                }
            }
        }
        this.forces = forces;
        this.lay_out_intervals();
        Ok(this)
    }

    /// Degrees of freedom beyond the first so many have none any more.
    pub(super) fn keep(&mut self, count: usize) {
        self.grounds.truncate(count);
        self.loads.truncate(count);
    }

    /// Acceleration (m/s2) at the start of an interval, and slope (m/s3), of a load.
    #[inline]
    fn load(&self, interval: usize, load: usize) -> [f64; 2] {
        match self.intervals.get(interval) {
            None => [self.after[load], 0.0],
            Some(interval) => interval.loads[load],
        }
    }

    /// The same with another record in the place of the first one.
    pub(super) fn with_first(&self, old: &GroundAcceleration, new: &GroundAcceleration) -> Self {
        let mut motions = self.motions.clone();
        for motion in &mut motions {
            if motion.is_of(old) {
                motion.acceleration = new.clone();
            }
        }
        let mut this = Self {
            motions,
            ..self.clone()
        };
        this.lay_out_intervals();
        this
    }

    /// The same with all motions scaled that are not of this record, those across the row by a
    /// factor of their own.
    pub(super) fn with_others_scaled(
        &self,
        first: &GroundAcceleration,
        [along, across]: [f64; 2],
    ) -> Self {
        let mut this = self.clone();
        let is_across = |motion: usize| self.supports.iter().any(|s| s.across == Some(motion));
        for (index, motion) in this.motions.iter_mut().enumerate() {
            if motion.is_of(first) {
                continue;
            }
            let factor = if is_across(index) { across } else { along };
            let samples = motion.acceleration.samples.iter();
            motion.acceleration.samples = Arc::new(samples.map(|a| factor * a).collect());
        }
        this.lay_out_intervals();
        this
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

    /// End of the last motion or force (s).
    pub(super) fn duration(&self) -> f64 {
        let motions = self.motions.iter();
        let ends = motions.map(|m| m.delay + m.acceleration.duration());
        let forces = self.forces.iter().map(|f| f.history.end());
        ends.chain(forces).fold(0.0, f64::max)
    }

    /// Cuts the time at the samples of all motions and the points of all forces, from zero to
    /// the end of the last.
    fn lay_out_intervals(&mut self) {
        let step = |m: &GroundMotion| m.acceleration.time_step;
        let least = self.motions.iter().map(step).fold(f64::INFINITY, f64::min);
        let mut times = vec![0.0];
        for motion in &self.motions {
            let count = motion.acceleration.samples.len();
            times.extend((0..count).map(|k| motion.delay + k as f64 * step(motion)));
        }
        for force in &self.forces {
            times.extend(force.history.points.iter().map(|p| p.0));
        }
        times.sort_by(f64::total_cmp);
        times.dedup_by(|later, earlier| *later - *earlier <= SAME * least);
        let over = |ends: &[f64]| {
            let (start, length) = (ends[0], ends[1] - ends[0]);
            // The middle tells the interval of a motion or force; the load is that at the start.
            let middle = start + 0.5 * length;
            Interval {
                start,
                length,
                loads: self.loads_over(start, middle, SAME * least),
                jumps: false,
            }
        };
        let mut intervals: Vec<Interval> = times.windows(2).map(over).collect();
        for k in 1..intervals.len() {
            let (before, now) = intervals.split_at_mut(k);
            now[0].jumps = before[k - 1].jumps_at_end(&now[0].loads);
        }
        let end = times.last().copied().unwrap_or(0.0);
        let after = self.loads_over(end, 2.0 * LONGEST_DELAY + end, 0.0);
        self.jumps_at_end = intervals.last().is_some_and(|i| i.jumps_at_end(&after));
        self.after = after.iter().map(|load| load[0]).collect();
        self.intervals = intervals;
    }

    /// Acceleration at an instant and slope around another of every load.
    fn loads_over(&self, start: f64, middle: f64, same: f64) -> Vec<[f64; 2]> {
        let motions = self.motions.iter().map(|m| m.line(start, middle, same));
        let mut loads: Vec<[f64; 2]> = motions.collect();
        for pushed in &self.pushed {
            let (motion, weight) = pushed.ground;
            let mut load = loads[motion].map(|x| weight * x);
            for number in &pushed.forces {
                let force = self.forces[*number].history.line(start, middle);
                load[0] -= force[0] / pushed.mass;
                load[1] -= force[1] / pushed.mass;
            }
            loads.push(load);
        }
        loads
    }
}

impl Interval {
    /// Whether any load is another one at the end than that with which the next interval begins,
    /// beyond round-off, also that of times: it counts by the largest value of a load, as any value
    /// may be next to zero.
    fn jumps_at_end(&self, next: &[[f64; 2]]) -> bool {
        let jumps = |([start, slope], [next, _]): (&[f64; 2], &[f64; 2])| {
            let end = start + slope * self.length;
            (end - next).abs() > 1.0e-9 * start.abs().max(end.abs()).max(next.abs())
        };
        self.loads.iter().zip(next).any(jumps)
    }
}

impl Motions {
    #[inline]
    fn acceleration(&self, (load, weight): (usize, f64), at: Grounds) -> f64 {
        if weight == 0.0 {
            return 0.0;
        }
        let [value, slope] = self.load(at.interval, load);
        weight * (value + slope * at.tau)
    }

    fn slope(&self, (load, weight): (usize, f64), segment: &Segment) -> f64 {
        weight * self.load(segment.interval, load)[1]
    }
}

impl GroundMotion {
    /// Whether it is this record, sooner or later.
    pub(super) fn is_of(&self, record: &GroundAcceleration) -> bool {
        Arc::ptr_eq(&self.acceleration.samples, &record.samples)
    }

    /// Acceleration at an instant (m/s2); at that of the last sample its value, after which there is
    /// none.
    #[must_use]
    pub fn at(&self, time: f64) -> f64 {
        let since_last = time - (self.delay + self.acceleration.duration());
        match self.acceleration.samples.last() {
            // Rows stand at multiples of a step, beside the sample by round-off.
            Some(last) if since_last.abs() <= SAME * self.acceleration.time_step => *last,
            _ => self.line(time, time, 0.0)[0],
        }
    }

    /// Acceleration at an instant, which is a sample if it is as near to it as that, and slope
    /// around another.
    fn line(&self, start: f64, middle: f64, same: f64) -> [f64; 2] {
        let step = self.acceleration.time_step;
        let place = (middle - self.delay) / step;
        if place < 0.0 {
            return [0.0; 2];
        }
        let interval = place.floor();
        let [a, slope] = self.acceleration.over(interval as usize);
        let since = start - self.delay - interval * step;
        let since = if since.abs() <= same { 0.0 } else { since };
        [a + slope * since, slope]
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

impl System {
    /// Acceleration of the ground that degree of freedom `i` is relative to (m/s2): what its
    /// absolute acceleration holds beside its own.
    #[inline]
    pub(crate) fn ground_on(&self, i: usize, ground: Grounds) -> f64 {
        match &self.motions {
            None => ground.first,
            Some(motions) => motions.acceleration(motions.grounds[i], ground),
        }
    }

    /// Slope of the same (m/s3).
    pub(crate) fn ground_slope_on(&self, i: usize, segment: &Segment) -> f64 {
        match &self.motions {
            None => segment.slope,
            Some(motions) => motions.slope(motions.grounds[i], segment),
        }
    }

    /// The same as the equation of motion takes it: less what forces on it do to its mass
    /// (m/s2).
    #[inline]
    pub(crate) fn load_on(&self, i: usize, ground: Grounds) -> f64 {
        match &self.motions {
            None => ground.first,
            Some(motions) => motions.acceleration(motions.loads[i], ground),
        }
    }

    /// The same at two times (s) in an interval, and its slope (m/s3).
    #[inline]
    pub(crate) fn load_over(
        &self,
        i: usize,
        segment: &Segment,
        times: [f64; 2],
    ) -> ([f64; 2], f64) {
        match &self.motions {
            None => (times.map(|tau| segment.acceleration_at(tau)), segment.slope),
            Some(motions) => {
                let (load, weight) = motions.loads[i];
                let [value, slope] = motions.load(segment.interval, load);
                (
                    times.map(|tau| weight * (value + slope * tau)),
                    weight * slope,
                )
            }
        }
    }

    /// Slope of the same (m/s3).
    pub(crate) fn load_slope_on(&self, i: usize, segment: &Segment) -> f64 {
        match &self.motions {
            None => segment.slope,
            Some(motions) => motions.slope(motions.loads[i], segment),
        }
    }

    /// The same buildings, gaps and motions with forces on floors, in the place of those there
    /// are.
    ///
    /// # Errors
    /// A floor that does not exist.
    pub fn with_forces(mut self, forces: Vec<FloorForce>) -> Result<Self, TimeHistoryError> {
        if self.motions.is_none() && !forces.is_empty() {
            self.motions = self.under_one_motion().map(Arc::new);
        }
        if let Some(motions) = &self.motions {
            let made = motions.with_forces(forces, &self.buildings, &self.offsets, &self.mass)?;
            self.motions = Some(Arc::new(made));
            self.propagation = Arc::default();
        }
        Ok(self)
    }

    /// Forces on floors.
    #[must_use]
    pub fn forces(&self) -> &[FloorForce] {
        self.motions.as_ref().map_or(&[], |m| &m.forces)
    }

    /// Ground motions along the row and across it under a building, where these are not
    /// [`System::ground`] alone.
    #[must_use]
    pub fn motions_under(&self, building: usize) -> [Option<&GroundMotion>; 2] {
        let Some(motions) = &self.motions else {
            return [None; 2];
        };
        let Support { along, across } = motions.supports[building];
        let own = Some(along).filter(|along| *along > 0);
        [own, across].map(|m| m.map(|m| &motions.motions[m]))
    }

    /// The ground motions that move buildings, each with whose it is, in words, and when it
    /// begins (s).
    pub(crate) fn motions_in_use(&self) -> Vec<(String, &GroundAcceleration, f64)> {
        let Some(motions) = &self.motions else {
            return vec![(String::new(), &self.ground, 0.0)];
        };
        let mut found: Vec<Option<String>> = vec![None; motions.motions.len()];
        for (building, support) in self.buildings.iter().zip(&motions.supports) {
            let own = || format!(" under building {}", building.name());
            let first = found[support.along].get_or_insert_with(own);
            if support.along == 0 {
                first.clear();
            }
            if let Some(across) = support.across {
                found[across].get_or_insert_with(|| " across the row".to_owned());
            }
        }
        let used = motions.motions.iter().zip(found);
        used.filter_map(|(m, place)| Some((place?, &m.acceleration, m.delay)))
            .collect()
    }

    /// What moves and pushes the buildings beside the first ground motion, line by line, for
    /// the user.
    #[must_use]
    pub fn further_excitation(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for (index, building) in self.buildings.iter().enumerate() {
            let name = building.name();
            let places = ["", ", across the row"];
            for (motion, place) in self.motions_under(index).into_iter().zip(places) {
                let Some(motion) = motion else { continue };
                let of_building = |line: &String| format!("building {name}{place}: {line}");
                lines.extend(motion.origin.iter().map(of_building));
                if motion.delay > 0.0 {
                    let delay = short(motion.delay);
                    lines.push(format!(
                        "building {name}{place}: the ground moves {delay} s later"
                    ));
                }
            }
            for force in self.forces().iter().filter(|f| f.building == index) {
                let peak = force.history.peak();
                lines.push(format!(
                    "building {name}: force on storey {}, {}up to {} kN at {} s",
                    force.storey + 1,
                    match force.origin.as_str() {
                        "" => String::new(),
                        origin => format!("{origin}, "),
                    },
                    short(1e-3 * peak.value),
                    short(peak.time),
                ));
            }
        }
        lines
    }

    /// Whether a load jumps where an interval begins; `last` is what the one before ended with,
    /// `None` if there is none. Round-off is no jump.
    pub(crate) fn jumps_into(&self, now: Grounds, last: Option<Grounds>) -> bool {
        let Some(last) = last else {
            return true;
        };
        // Inside an interval all loads are linear.
        if last.interval == now.interval {
            return false;
        }
        match &self.motions {
            // Samples, as `value + slope * length` is the next one but for round-off.
            None => {
                let samples = &self.ground.samples;
                let end = samples.get(last.interval + 1).copied().unwrap_or(0.0);
                let start = samples[..samples.len() - 1].get(now.interval);
                end != start.copied().unwrap_or(0.0)
            }
            Some(motions) => match motions.intervals.get(now.interval) {
                Some(interval) => interval.jumps,
                None => motions.jumps_at_end && now.interval == motions.intervals.len(),
            },
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
                if sample > 0 && rest <= 1.0e-9 * step {
                    return None;
                }
                let whole = rest > length * (1.0 - 1.0e-9) && rest < length * (1.0 + 1.0e-9);
                let [acceleration, slope] = motions.load(sample, 0);
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
        // The last interval may be round-off: duration is often a whole number of steps. The first one is none, however long
        // the step.
        let rest = duration - start;
        if sample > 0 && rest <= 1.0e-9 * ground.time_step {
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

    /// Whether a load ever acts on a degree of freedom.
    pub(crate) fn has_load(&self, i: usize) -> bool {
        let motions = self.motions.as_ref();
        motions.is_none_or(|motions| motions.loads[i].1 != 0.0)
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
                let of = |(motion, weight): &(usize, f64)| {
                    motions.load(segment.interval, *motion).map(|x| weight * x)
                };
                sides
                    .iter()
                    .map(of)
                    .fold([0.0; 2], |sum, x| [sum[0] + x[0], sum[1] + x[1]])
            });
            let velocity = |s: f64| v + s * (a + 0.5 * s * slope);
            let displacement = |s: f64| x + s * (v + s * (0.5 * a + s * slope / 6.0));
            // It turns where the velocity, a parabola, is zero.
            let root = (a * a - 2.0 * slope * v).max(0.0).sqrt();
            let half = -(a + root.copysign(a));
            let turns = [half / slope, 2.0 * v / half];
            let inside = turns
                .into_iter()
                .filter(|s| *s > 0.0 && *s < segment.length);
            for s in inside.chain([segment.length]) {
                let value = displacement(s).abs();
                // Ground that has come to rest away from where it began stays at its peak but for round-off.
                let time = match value > peak.value * (1.0 + SAME_DISPLACEMENT) {
                    true => segment.start + s,
                    false => peak.time,
                };
                peak.raise(value, time);
            }
            (x, v) = (displacement(segment.length), velocity(segment.length));
        }
        Some(peak)
    }

    /// Ground motions under a building, by their numbers in [`System::ground_motions`].
    pub(crate) fn support(&self, building: usize) -> Support {
        let first = Support {
            along: 0,
            across: None,
        };
        let motions = self.motions.as_ref();
        motions.map_or(first, |m| m.supports[building])
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
            let motions = Arc::make_mut(motions);
            motions.grounds.push((motion, -1.0));
            motions.loads.push((motion, -1.0));
        }
        let n = self.mass.len();
        self.mass.push(1.0);
        self.initial.insert(n, 0.0);
        self.initial.push(0.0);
        self.moving_ground.push(motion);
        n
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_sample_counts_at_its_time() {
        let motion = GroundMotion {
            acceleration: GroundAcceleration {
                samples: vec![0.5, 1.0, 2.0].into(),
                time_step: 0.1,
            },
            delay: 0.3,
            origin: Vec::new(),
        };
        // 0.1 + 0.1 + 0.3 is beside 0.3 + 2 * 0.1.
        for (time, expected) in [
            (0.2, 0.0),
            (0.35, 0.75),
            (0.5, 2.0),
            (0.1 + 0.1 + 0.3, 2.0),
            (0.501, 0.0),
        ] {
            assert!((motion.at(time) - expected).abs() < 1e-12, "{time}");
        }
    }

    #[test]
    fn motions_that_do_not_go_forward_are_refused() {
        let of = |samples: &[f64], time_step: f64| GroundMotion {
            acceleration: GroundAcceleration {
                samples: samples.to_vec().into(),
                time_step,
            },
            delay: 0.1,
            origin: Vec::new(),
        };
        for (samples, time_step) in [
            (&[1.0; 3][..], -0.01),
            (&[1.0; 3], 0.0),
            (&[1.0; 3], f64::NAN),
            (&[1.0, f64::NAN], 0.01),
            (&[], 0.01),
        ] {
            let motions = vec![of(&[1.0; 3], 0.01), of(samples, time_step)];
            let said = System::with_motions(Vec::new(), motions, Vec::new());
            let said = said.unwrap_err().to_string();
            assert!(said.contains("motion 2 has"), "{said}");
        }
    }
}
