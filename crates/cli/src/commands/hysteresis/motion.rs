//! The deformations that an element is led through.

use pounding_case::Dimension;
use pounding_hysteresis::{LawDescriptor, Motion};

use super::columns::{Column, Rows, Source};
use crate::arguments::HysteresisArguments;
use crate::commands::impact::numbers::significant;
use crate::commands::impact::setting::positive;
use crate::failure::Failure;

/// One step on a path.
#[derive(Debug, Clone, Copy)]
pub struct Step {
    /// Where it ends.
    pub motion: Motion,
    /// Its duration (s).
    pub duration: f64,
}

/// A path of deformations from a new element at rest.
#[derive(Debug)]
pub struct Path {
    /// Its steps.
    pub steps: Vec<Step>,
    /// Cycles as numbers of steps taken: before, at the turning point, and after.
    pub cycles: Vec<[usize; 3]>,
    /// In words.
    pub description: String,
}

/// How fast cycles are.
#[derive(Debug, Clone, Copy)]
enum Pace {
    /// Harmonic with this period (s).
    Harmonic(f64),
    /// At this speed (m/s).
    Steady(f64),
}

/// Part of its range by which a cycle of a measured history may fail to close.
const NEARLY: f64 = 0.01;
/// Pieces of the whole range of a history between its rows.
const PIECES: f64 = 400.0;

/// The path of the arguments, if they ask for one.
pub fn path(law: &LawDescriptor, arguments: &HysteresisArguments) -> Result<Option<Path>, Failure> {
    if let Some(file) = &arguments.history {
        let source = Source::open(file, "--history", "deformation_mm")?;
        let speed = speed(arguments)?;
        if arguments.period.is_some() {
            return Err(Failure::input(
                "--period does not go with --history",
                Some("give the file a column of times, or add --rate".to_owned()),
            ));
        }
        return history(law, &source, speed).map(Some);
    }
    if arguments.cycles.is_empty() {
        return Ok(None);
    }
    let amplitudes = arguments
        .cycles
        .iter()
        .map(|text| positive(text.trim(), "cycles", Dimension::LENGTH))
        .collect::<Result<Vec<f64>, Failure>>()?;
    let pace = match speed(arguments)? {
        Some(speed) => Pace::Steady(speed),
        None => Pace::Harmonic(period(arguments)?),
    };
    Ok(Some(full_cycles(
        law,
        &amplitudes,
        pace,
        arguments.steps as usize,
    )))
}

/// Period of harmonic cycles (s).
pub fn period(arguments: &HysteresisArguments) -> Result<f64, Failure> {
    let text = arguments.period.as_deref();
    text.map_or(Ok(1.0), |text| positive(text, "period", Dimension::TIME))
}

fn speed(arguments: &HysteresisArguments) -> Result<Option<f64>, Failure> {
    let text = arguments.rate.as_deref();
    text.map(|text| positive(text, "rate", Dimension::VELOCITY))
        .transpose()
}

/// Harmonic cycles of one second as the pages show them.
pub fn harmonic(law: &LawDescriptor, amplitudes: &[f64], steps: usize) -> Path {
    full_cycles(law, amplitudes, Pace::Harmonic(1.0), steps)
}

/// A full cycle at each amplitude, from its positive peak back there; half a cycle leads
/// from one peak to a higher one, a whole one to a lower one.
fn full_cycles(law: &LawDescriptor, amplitudes: &[f64], pace: Pace, steps: usize) -> Path {
    let mut path = Path {
        steps: Vec::new(),
        cycles: Vec::new(),
        description: String::new(),
    };
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
    let how = match pace {
        _ if !law.rate_dependent => String::new(),
        Pace::Harmonic(period) => format!(", harmonic, {} s each", significant(period)),
        Pace::Steady(speed) => format!(", at a speed of {} m/s", significant(speed)),
    };
    path.description = format!("Full cycles, each from its positive peak back there{how}");
    path
}

impl Path {
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
                        middle - half * angle.cos(),
                        half * frequency * angle.sin(),
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
        self.steps.push(Step { motion, duration });
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

    /// Cycles of a history, not overlapping: from a turning point over the next one back to
    /// the same deformation, or nearly there.
    fn find_cycles(&mut self) {
        let mut turning = self.turning_points();
        let mut first = 0;
        while let Some(&[before, turn, next]) = turning.get(first..first + 3) {
            let (start, far) = (self.position(before), self.position(turn));
            let (side, range) = ((start - far).signum(), (start - far).abs());
            let left = |path: &Self, taken| side * (start - path.position(taken));
            if left(self, next) > NEARLY * range {
                first += 1;
                continue;
            }
            let back = (turn..=next).find(|k| left(self, *k) <= 0.0);
            let after = back.unwrap_or(next);
            if left(self, after) < 0.0 {
                self.divide(after - 1, start);
                turning.iter_mut().skip(first + 2).for_each(|t| *t += 1);
            }
            self.cycles.push([before, turn, after]);
            first += 2;
        }
    }

    /// Divides a step where it passes this deformation.
    fn divide(&mut self, index: usize, deformation: f64) {
        let (from, step) = (self.position(index), self.steps[index]);
        let share = (deformation - from) / (step.motion.deformation - from);
        self.steps[index].duration *= 1.0 - share;
        let motion = Motion {
            deformation,
            ..step.motion
        };
        let duration = share * step.duration;
        self.steps.insert(index, Step { motion, duration });
    }
}

const DEFORMATION: Column = Column {
    name: "deformation",
    dimension: Dimension::LENGTH,
};
const TIME: Column = Column {
    name: "time",
    dimension: Dimension::TIME,
};

/// The rows of a file, on straight ways between them.
fn history(law: &LawDescriptor, source: &Source, speed: Option<f64>) -> Result<Path, Failure> {
    let rows = source.rows(&[&[DEFORMATION], &[TIME, DEFORMATION]])?;
    let timed = rows.first().is_some_and(|(_, row)| row.len() == 2);
    if timed && speed.is_some() {
        return Err(Failure::input(
            "--rate contradicts the times of the history",
            Some("leave --rate out, or the column of times".to_owned()),
        ));
    }
    if law.rate_dependent && !timed && speed.is_none() {
        return Err(Failure::input(
            format!(
                "the force of law {} depends on the rate of deformation, which the history does not state",
                law.name
            ),
            Some("add --rate \"20 mm/s\", or a column of times: time_s,deformation_mm".to_owned()),
        ));
    }
    let mut path = Path {
        steps: Vec::new(),
        cycles: Vec::new(),
        description: "Cycles of the history, from a turning point back to its deformation"
            .to_owned(),
    };
    path.follow(law, source, &rows, speed)?;
    if path.steps.iter().all(|s| s.motion.deformation == 0.0) {
        return Err(Failure::input(
            "the history does not move the element",
            Some("give it rows of deformations".to_owned()),
        ));
    }
    path.find_cycles();
    Ok(path)
}

impl Path {
    fn follow(
        &mut self,
        law: &LawDescriptor,
        source: &Source,
        rows: &Rows,
        speed: Option<f64>,
    ) -> Result<(), Failure> {
        let deformations = || rows.iter().filter_map(|(_, row)| row.last().copied());
        let (low, high) = deformations().fold((0.0_f64, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
        let (mut from, mut before): (f64, Option<f64>) = (0.0, None);
        for (place, row) in rows {
            let (time, to) = match row.as_slice() {
                [time, to] => (Some(*time), *to),
                [to] => (None, *to),
                _ => continue,
            };
            let way = to - from;
            let duration = match (time, before, speed) {
                (Some(time), Some(before), _) if time > before => time - before,
                (Some(_), Some(_), _) => {
                    return Err(source.error(
                        place.clone(),
                        "time does not increase here".to_owned(),
                        "sort the rows by time, and leave out rows that repeat a time",
                    ));
                }
                (Some(_), None, _) if way != 0.0 && law.rate_dependent => {
                    return Err(source.error(
                        place.clone(),
                        "the history begins with a deformation, and how fast it came about is not known"
                            .to_owned(),
                        "begin with a row of zero deformation",
                    ));
                }
                (Some(_), None, _) => 0.0,
                (None, _, Some(speed)) => way.abs() / speed,
                (None, _, None) => 1.0,
            };
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
            }
            from = to;
        }
        Ok(())
    }
}
