//! A motion as averages over a moment, which hardly depend on how it was sampled.

use pounding_ground_motion::Accelerogram;
use pounding_ground_motion::measures::GroundMotion;

/// Half the base (s) of the triangle with which accelerations are averaged: what is faster than some
/// 5 Hz is left out, in which samples of another time step or phase differ.
const HALF_BASE: f64 = 0.1;
/// Step of the averages (s).
const STEP: f64 = 0.02;
/// Parts of the sum of squares at whose times records are compared before all averages are.
const PARTS: [f64; 7] = [0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8];
/// How far such times of one motion may be from one another (s), and as a part of their distance: ends
/// that are cut off take squares away.
const APART: [f64; 2] = [0.1, 0.05];
/// What two records of one motion may differ by, over their root mean square. Samples left out or put
/// between others by straight lines make less than 0.01, and no two motions of agencies come below 0.3.
const DIFFERENCE: f64 = 0.03;
/// Shifts of the records against one another that are tried around the one that brings the half of
/// their squares together: how far (s), and how many to either side.
const SHIFTS: (f64, i32) = (0.3, 30);
/// Narrowings of the best one by the golden section.
const NARROWINGS: usize = 20;
/// Part of the shorter record that must lie in the other one too.
pub(super) const OVERLAP: f64 = 0.9;

/// A motion between whose samples lie straight lines, with its averages.
#[derive(Debug)]
pub(super) struct Averaged {
    motion: GroundMotion,
    /// Averages at whole steps from the first sample on.
    averages: Vec<f64>,
    /// Times (s) of the parts of the sum of squares.
    times: [f64; PARTS.len()],
}

impl Averaged {
    pub(super) fn of(record: &Accelerogram) -> Self {
        let mut averaged = Self {
            motion: GroundMotion::of(record, 0.0, 0.0),
            averages: Vec::new(),
            times: [0.0; PARTS.len()],
        };
        let count = match record.time_step() <= HALF_BASE {
            true => (averaged.duration() / STEP) as usize + 1,
            false => 0,
        };
        let all = (0..count).map(|i| averaged.at(STEP * i as f64));
        averaged.averages = all.collect();
        averaged.times = PARTS.map(|part| averaged.time_of(part));
        averaged
    }

    fn duration(&self) -> f64 {
        self.motion.time_step * self.motion.acceleration.len().saturating_sub(1) as f64
    }

    /// Time (s) until which this part of the sum of squares of the averages is reached.
    fn time_of(&self, part: f64) -> f64 {
        let whole: f64 = self.averages.iter().map(|x| x * x).sum();
        let mut sum = 0.0;
        let reached = self.averages.iter().position(|x| {
            sum += x * x;
            sum >= part * whole
        });
        STEP * reached.unwrap_or_default() as f64
    }

    /// Its average around a time (s), with nothing before the first sample and after the last: the
    /// second difference of the displacement.
    fn at(&self, time: f64) -> f64 {
        let [before, now, after] =
            [-HALF_BASE, 0.0, HALF_BASE].map(|by| self.displacement_at(time + by));
        (before - 2.0 * now + after) / (HALF_BASE * HALF_BASE)
    }

    fn displacement_at(&self, time: f64) -> f64 {
        let GroundMotion {
            time_step,
            acceleration,
            velocity,
            displacement,
        } = &self.motion;
        let last = acceleration.len().saturating_sub(1);
        if !(time > 0.0) || last == 0 {
            return 0.0;
        }
        let i = ((time / time_step) as usize).min(last);
        let tau = time - time_step * i as f64;
        let (u, v) = (displacement[i], velocity[i]);
        if i == last {
            return u + v * tau;
        }
        let slope = (acceleration[i + 1] - acceleration[i]) / time_step;
        u + tau * (v + tau * (0.5 * acceleration[i] + tau * slope / 6.0))
    }

    /// Whether the motion is the other one times a factor, sampled at other times. Of records whose
    /// steps are longer than averages nothing can be said.
    pub(super) fn is_that_of(&self, other: &Self) -> bool {
        if self.averages.is_empty() || other.averages.is_empty() {
            return false;
        }
        let half = PARTS.len() / 2;
        let about = other.times[half] - self.times[half];
        let allowed = APART[0] + APART[1] * (self.times[PARTS.len() - 1] - self.times[0]);
        let mut times = self.times.iter().zip(&other.times);
        if times.any(|(own, other)| (other - own - about).abs() > allowed) {
            return false;
        }
        let (far, count) = SHIFTS;
        let step = far / f64::from(count);
        let shifts = (-count..=count).map(|i| about + step * f64::from(i));
        let tried = shifts.map(|shift| (self.difference(other, shift), shift));
        let Some((_, best)) = tried.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            return false;
        };
        let (mut low, mut high) = (best - step, best + step);
        let golden = 0.5 * (3.0 - 5.0_f64.sqrt());
        for _ in 0..NARROWINGS {
            let part = golden * (high - low);
            let (left, right) = (low + part, high - part);
            if self.difference(other, left) < self.difference(other, right) {
                high = right;
            } else {
                low = left;
            }
        }
        self.difference(other, 0.5 * (low + high)) <= DIFFERENCE
    }

    /// Root mean square of the difference from the other motion, shifted (s) and times the factor that
    /// makes it least, over that of the other one, where both have samples all around; infinite where
    /// that is too little of the shorter one.
    fn difference(&self, other: &Self, shift: f64) -> f64 {
        let (own, others) = (self.duration(), other.duration());
        let begin = HALF_BASE.max(HALF_BASE - shift);
        let end = (own - HALF_BASE).min(others - HALF_BASE - shift);
        if end - begin + 2.0 * HALF_BASE < OVERLAP * own.min(others) {
            return f64::INFINITY;
        }
        let (from, to) = (
            (begin / STEP).ceil() as usize,
            (end / STEP).floor() as usize,
        );
        let (mut both, mut squares, mut of_other) = (0.0, 0.0, 0.0);
        for i in from..=to.min(self.averages.len().saturating_sub(1)) {
            let (x, y) = (self.averages[i], other.at(STEP * i as f64 + shift));
            both += x * y;
            squares += x * x;
            of_other += y * y;
        }
        let left = of_other - both * both / squares;
        // What is not a number is no likeness.
        let difference = (left.max(0.0) / of_other).sqrt();
        if difference.is_finite() {
            difference
        } else {
            f64::INFINITY
        }
    }
}
