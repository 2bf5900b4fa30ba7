//! The deformations that an element is led through.

use super::LaboratoryError;
use crate::descriptor::LawDescriptor;
use crate::law::Motion;

/// One step on a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Where it ends.
    pub motion: Motion,
    /// Its duration (s).
    pub duration: f64,
}

/// A path of deformations from a new element at rest.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LoadPath {
    /// Its steps.
    pub steps: Vec<Step>,
    /// Time at its start (s): that of the first row of a history, else zero.
    pub start: f64,
    /// Time at the end of each step (s).
    pub times: Vec<f64>,
    /// Cycles as numbers of steps taken: before, at the turning point, and after. One that lies within
    /// another stands before it.
    pub cycles: Vec<[usize; 3]>,
}

/// How fast cycles are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pace {
    /// Harmonic with this period (s).
    Harmonic(f64),
    /// At this speed (m/s).
    Steady(f64),
}

/// A row of a prescribed history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryRow {
    /// Time (s), where the history states it.
    pub time: Option<f64>,
    /// Deformation (m).
    pub deformation: f64,
}

/// Part of its range by which a cycle of a measured history may fail to close.
const NEARLY: f64 = 0.01;
/// Pieces of the whole range of a history between its rows.
const PIECES: f64 = 400.0;

impl LoadPath {
    /// A full cycle at each amplitude (m), from its positive peak back there, each half of it in
    /// this many steps; half a cycle leads from one peak to a higher one, a whole one to a lower
    /// one.
    #[must_use]
    pub fn full_cycles(law: &LawDescriptor, amplitudes: &[f64], pace: Pace, steps: usize) -> Self {
        let mut path = Self::default();
        let mut at = 0.0;
        for &amplitude in amplitudes {
            // From a larger cycle by way of the far side, so that this one is closed as well.
            if at > amplitude {
                path.leg(law, (at, -amplitude), pace, steps);
                at = -amplitude;
            }
            path.leg(law, (at, amplitude), pace, steps);
            let before = path.steps.len();
            path.leg(law, (amplitude, -amplitude), pace, steps);
            let turned = path.steps.len();
            path.leg(law, (-amplitude, amplitude), pace, steps);
            path.cycles.push([before, turned, path.steps.len()]);
            at = amplitude;
        }
        path
    }

    /// The rows of a history, on straight ways between them: at their times, else at this speed
    /// (m/s), else in a second each, which matters to no law that does not depend on the rate.
    /// Its cycles lead from a turning point back to the same deformation.
    ///
    /// # Errors
    /// Times that do not increase, a rate that is not known to a law that depends on it, or no
    /// deformation at all.
    pub fn history(
        law: &LawDescriptor,
        rows: &[HistoryRow],
        speed: Option<f64>,
    ) -> Result<Self, LaboratoryError> {
        let timed = !rows.is_empty() && rows.iter().all(|row| row.time.is_some());
        if law.rate_dependent && !timed && speed.is_none() {
            return Err(LaboratoryError::UnknownRate { law: law.name });
        }
        let mut path = Self::default();
        path.follow(law, rows, speed)?;
        if path.steps.iter().all(|s| s.motion.deformation == 0.0) {
            return Err(LaboratoryError::NoMotion);
        }
        path.find_cycles();
        Ok(path)
    }

    /// Its length (m).
    #[must_use]
    pub fn length(&self) -> f64 {
        let mut from = 0.0;
        let steps = self.steps.iter();
        let ways = steps.map(|step| {
            let to = step.motion.deformation;
            (to - std::mem::replace(&mut from, to)).abs()
        });
        ways.sum()
    }

    /// Half a cycle from one deformation to another.
    fn leg(&mut self, law: &LawDescriptor, (from, to): (f64, f64), pace: Pace, steps: usize) {
        if from == to {
            return;
        }
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        match pace {
            Pace::Harmonic(period) => {
                let duration = 0.5 * period / steps as f64;
                let frequency = std::f64::consts::TAU / period;
                for i in 1..steps {
                    let angle = std::f64::consts::PI * i as f64 / steps as f64;
                    self.step(
                        middle - half * libm::cos(angle),
                        half * frequency * libm::sin(angle),
                        duration,
                    );
                }
                self.step(to, 0.0, duration);
            }
            Pace::Steady(speed) => {
                let velocity = speed.copysign(half);
                self.turn(law, from, velocity);
                let piece = 2.0 * half / steps as f64;
                for i in 1..=steps {
                    let at = if i == steps {
                        to
                    } else {
                        from + piece * i as f64
                    };
                    self.step(at, velocity, (piece / velocity).abs());
                }
            }
        }
    }

    fn step(&mut self, deformation: f64, velocity: f64, duration: f64) {
        let motion = Motion {
            deformation,
            velocity,
        };
        self.times.push(self.time(self.steps.len()) + duration);
        self.steps.push(Step { motion, duration });
    }

    /// Time (s) after so many steps.
    fn time(&self, taken: usize) -> f64 {
        taken
            .checked_sub(1)
            .map_or(self.start, |last| self.times[last])
    }

    /// A sudden change of velocity, which only a law that depends on it would notice.
    fn turn(&mut self, law: &LawDescriptor, deformation: f64, velocity: f64) {
        if law.rate_dependent {
            self.step(deformation, velocity, 0.0);
        }
    }

    /// Deformation after this number of steps (m).
    fn position(&self, taken: usize) -> f64 {
        let last = taken.checked_sub(1).and_then(|i| self.steps.get(i));
        last.map_or(0.0, |step| step.motion.deformation)
    }

    /// Turning points by the number of steps taken, and the end.
    fn turning_points(&self) -> Vec<usize> {
        let mut turning = Vec::new();
        let mut direction = 0.0_f64;
        for taken in 0..self.steps.len() {
            let way = self.position(taken + 1) - self.position(taken);
            if way * direction < 0.0 {
                turning.push(taken);
            }
            if way != 0.0 {
                direction = way.signum();
            }
        }
        turning.push(self.steps.len());
        turning
    }

    /// Cycles of a history: from a turning point over the next one back to the same deformation, or
    /// nearly there. Smaller ones within a larger one, such as ripples of a measured history, are found
    /// first and left out of its way, as in rainflow counting (Downing and Socie, International Journal of
    /// Fatigue 4 (1982) 31).
    fn find_cycles(&mut self) {
        let mut turning = self.turning_points();
        let mut open: Vec<usize> = Vec::new();
        for place in 0..turning.len() {
            while let &[.., before, turn] = open.as_slice() {
                let next = turning[place];
                let (start, far) = (self.position(before), self.position(turn));
                let (side, range) = ((start - far).signum(), (start - far).abs());
                let left = |path: &Self, taken| side * (start - path.position(taken));
                if left(self, next) > NEARLY * range {
                    break;
                }
                // Nothing before the last turning point came so far.
                let last = turning[place - 1];
                let back = (last..=next).find(|k| left(self, *k) <= 0.0);
                let after = back.unwrap_or(next);
                if left(self, after) < 0.0 {
                    self.divide(after - 1, start);
                    turning.iter_mut().skip(place).for_each(|t| *t += 1);
                }
                self.cycles.push([before, turn, after]);
                open.truncate(open.len() - 2);
            }
            open.push(turning[place]);
        }
    }

    /// Divides a step where it passes this deformation.
    fn divide(&mut self, index: usize, deformation: f64) {
        let (from, step) = (self.position(index), self.steps[index]);
        let share = (deformation - from) / (step.motion.deformation - from);
        let time = self.time(index) + share * step.duration;
        self.times.insert(index, time);
        self.steps[index].duration *= 1.0 - share;
        let motion = Motion {
            deformation,
            ..step.motion
        };
        let duration = share * step.duration;
        self.steps.insert(index, Step { motion, duration });
    }

    fn follow(
        &mut self,
        law: &LawDescriptor,
        rows: &[HistoryRow],
        speed: Option<f64>,
    ) -> Result<(), LaboratoryError> {
        let deformations = rows.iter().map(|row| row.deformation);
        let (low, high) = deformations.fold((0.0_f64, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
        let (mut from, mut before): (f64, Option<f64>) = (0.0, None);
        for (
            row,
            &HistoryRow {
                time,
                deformation: to,
            },
        ) in rows.iter().enumerate()
        {
            let way = to - from;
            let duration = match (time, before, speed) {
                (Some(time), Some(before), _) if time > before => time - before,
                (Some(_), Some(_), _) => return Err(LaboratoryError::TimeOrder { row }),
                (Some(_), None, _) if way != 0.0 && law.rate_dependent => {
                    return Err(LaboratoryError::UnknownStart { row });
                }
                (Some(_), None, _) => 0.0,
                (None, _, Some(speed)) => way.abs() / speed,
                (None, _, None) => 1.0,
            };
            if before.is_none() {
                self.start = time.unwrap_or(0.0);
            }
            before = time;
            let pieces = (PIECES * way.abs() / (high - low)).ceil().max(1.0);
            let velocity = if duration > 0.0 { way / duration } else { 0.0 };
            if way != 0.0 || duration > 0.0 {
                self.turn(law, from, velocity);
                for i in 1..=pieces as usize {
                    let share = i as f64 / pieces;
                    let at = if share == 1.0 { to } else { from + way * share };
                    self.step(at, velocity, duration / pieces);
                }
                // As stated, not as the pieces add up to.
                if let (Some(time), Some(end)) = (time, self.times.last_mut()) {
                    *end = time;
                }
            }
            from = to;
        }
        Ok(())
    }
}
