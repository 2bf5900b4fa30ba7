//! The exact solution of a case, and deliberately naive treatments of its events.
//!
//! Between events a case is a linear system in displacements, velocities, ground
//! acceleration, its slope and one. It is advanced by the exponential series in pieces
//! a quarter of the fastest radian long, which is exact to round-off. Events are looked
//! for in every piece, its ends and its inner extremum, and bisected. Nothing here is
//! shared with the program: no interpolant, no Newton, no Bernstein bound.
//!
//! The naive treatments use the same exact motion, so that what they get wrong is the
//! trap alone.

use super::case::{Case, Law};
use super::plant::{Mode, Plant, Target, Watch};

/// How events and peaks are looked for.
#[derive(Debug, Clone, Copy)]
pub struct Rules {
    /// Longest step (s).
    pub step: f64,
    /// Whether inner extrema of event functions are looked at.
    pub extrema: bool,
    /// Whether inner extrema of responses and both sides of a jump count as peaks.
    pub peaks: bool,
    /// Whether an open gap closes wherever the penetration is not negative.
    pub closes_wherever_closed: bool,
    /// Whether dry friction can hold.
    pub sticks: bool,
    /// Whether a gap closes only where its penetration was negative before.
    pub closes_from_apart: bool,
}

impl Rules {
    /// The truth.
    pub const EXACT: Self = Self {
        step: f64::INFINITY,
        extrema: true,
        peaks: true,
        closes_wherever_closed: false,
        sticks: true,
        closes_from_apart: false,
    };

    /// Signs at the ends of steps of this length (s), no more.
    pub const fn ends_of_steps(step: f64) -> Self {
        Self {
            step,
            extrema: false,
            peaks: false,
            ..Self::EXACT
        }
    }
}

/// One impact.
#[derive(Debug, Clone, Copy)]
pub struct Touch {
    /// Closure and opening (s); the latter NaN if it outlasts the run.
    pub closed: f64,
    pub opened: f64,
    /// Relative velocity at closure, and apart at opening (m/s).
    pub approach: f64,
    pub separation: f64,
}

/// A maximum absolute value and its time (s).
pub type Top = (f64, f64);

/// What happened.
#[derive(Debug, Clone, Default)]
pub struct History {
    pub impacts: Vec<Touch>,
    /// Times that friction held, and changes of mode of any kind.
    pub sticks: usize,
    pub events: usize,
    /// The run was given up: events without progress.
    pub gave_up: bool,
    /// Peaks of displacement (m), drift (m) and absolute acceleration (m/s2) by floor.
    pub displacement: Vec<Top>,
    pub drift: Vec<Top>,
    pub acceleration: Vec<Top>,
    /// Peaks of the contact force (N) and of the penetration (m), the latter negative if
    /// the floors never met.
    pub force: Top,
    pub penetration: Top,
    /// Displacements, then velocities at the end.
    pub end: Vec<f64>,
}

/// Events after which a run is given up.
pub const GIVE_UP: usize = 3_000;

/// How long (s) velocities do not count after floors broke loose. They then grow like
/// the square of time from zero, and stand clear of round-off after so much.
const DEAF: f64 = 1e-7;

/// Solves a case over its record.
pub fn solve(case: &Case, rules: Rules) -> History {
    let plant = Plant::new(case);
    let n = plant.floors;
    let mut run = Run {
        plant: &plant,
        rules,
        law: case.law,
        y: [&case.start[..], &[0.0, 0.0, 1.0]].concat(),
        time: 0.0,
        mode: Mode::Open,
        deaf: false,
        history: History {
            displacement: vec![(0.0, 0.0); n],
            drift: vec![(0.0, 0.0); n],
            acceleration: vec![(0.0, 0.0); n],
            penetration: (f64::NEG_INFINITY, 0.0),
            ..History::default()
        },
    };
    for (i, pair) in case.ground.windows(2).enumerate() {
        run.y[2 * n] = pair[0];
        run.y[2 * n + 1] = (pair[1] - pair[0]) / case.time_step;
        run.sample(i as f64 * case.time_step, case.time_step);
        if run.history.gave_up {
            break;
        }
    }
    run.history.end = run.y[..2 * n].to_vec();
    run.history
}

struct Run<'a> {
    plant: &'a Plant,
    rules: Rules,
    law: Law,
    y: Vec<f64>,
    time: f64,
    mode: Mode,
    /// Floors broke loose: velocity and acceleration are round-off at first.
    deaf: bool,
    history: History,
}

impl Run<'_> {
    fn sample(&mut self, start: f64, length: f64) {
        let mut tau = 0.0;
        while tau < length && !self.history.gave_up {
            self.time = start + tau;
            if self.rules.closes_wherever_closed
                && self.mode == Mode::Open
                && self.plant.penetration(&self.y) >= 0.0
            {
                self.enter(Mode::Approach);
            }
            let rest = length - tau;
            let piece = self.plant.piece(self.mode);
            let step = match (self.deaf, self.rules.extrema) {
                (true, _) => DEAF.min(rest),
                (false, true) => piece.min(rest),
                (false, false) => self.rules.step.min(rest),
            };
            let first = self.first_event(step);
            self.deaf = false;
            let taken = first.map_or(step, |f| f.0);
            self.observe(taken);
            self.y = self.plant.advance(self.mode, &self.y, taken);
            tau = if first.is_none() && step == rest {
                length
            } else {
                tau + taken
            };
            self.time = start + tau;
            if let Some((_, target)) = first {
                self.fire(target);
            }
        }
    }

    /// The first event within a step, and when.
    fn first_event(&self, step: f64) -> Option<(f64, Target)> {
        let watches = self.plant.watches(self.mode).iter();
        let watches = watches.filter(|w| !(self.deaf && w.is_velocity));
        let found = watches.filter_map(|w| Some((self.rise(w, step)?, w.target)));
        found.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// When a function becomes positive.
    fn rise(&self, watch: &Watch, step: f64) -> Option<f64> {
        let at = |t: f64| self.plant.advance(self.mode, &self.y, t);
        let (value, slope) = (|t: f64| watch.value(&at(t)), |t: f64| watch.slope(&at(t)));
        let (mut low, mut high) = (0.0, step);
        if self.rules.extrema {
            let (before, after) = (watch.slope(&self.y), slope(step));
            if before > 0.0 && after < 0.0 {
                high = bisect(|t| slope(t) < 0.0, 0.0, step).1;
            } else if before < 0.0 && after > 0.0 {
                low = bisect(|t| slope(t) > 0.0, 0.0, step).1;
            }
        }
        let from_apart = self.mode != Mode::Open || watch.value(&self.y) < 0.0;
        if value(high) <= 0.0 || (self.rules.closes_from_apart && !from_apart) {
            return None;
        }
        let bracket = bisect(|t| value(t) > 0.0, low, high);
        Some(if self.rules.closes_wherever_closed {
            bracket.0
        } else {
            bracket.1
        })
    }

    fn fire(&mut self, target: Target) {
        match target {
            Target::Mode(mode) => self.enter(mode),
            Target::StickOrSlip if !self.rules.sticks => self.enter(match self.mode {
                Mode::Approach => Mode::Restitution,
                _ => Mode::Approach,
            }),
            Target::StickOrSlip => {
                let holding = self.plant.holding(&self.y);
                let (low, high) = self.stick_range();
                self.enter(if holding > high {
                    Mode::Approach
                } else if holding < low {
                    Mode::Restitution
                } else {
                    Mode::Stuck
                });
            }
        }
    }

    fn stick_range(&self) -> (f64, f64) {
        let Law::DryFriction { k, friction } = self.law else {
            return (0.0, 0.0);
        };
        let spring = k * self.plant.penetration(&self.y);
        (spring * (1.0 - friction), spring * (1.0 + friction))
    }

    fn enter(&mut self, mode: Mode) {
        let velocity = self.plant.velocity(&self.y);
        if self.mode == Mode::Open {
            self.history.impacts.push(Touch {
                closed: self.time,
                opened: f64::NAN,
                approach: velocity,
                separation: f64::NAN,
            });
        }
        if mode == Mode::Open
            && let Some(touch) = self.history.impacts.last_mut()
        {
            touch.opened = self.time;
            touch.separation = -velocity;
        }
        self.deaf = self.mode == Mode::Stuck;
        self.history.sticks += usize::from(mode == Mode::Stuck);
        self.history.events += 1;
        self.history.gave_up |= self.history.events >= GIVE_UP;
        self.mode = mode;
    }

    /// Takes the peaks of a step in.
    fn observe(&mut self, step: f64) {
        let end = self.plant.advance(self.mode, &self.y, step);
        let n = self.plant.floors;
        for (i, watch) in self.plant.observed(self.mode).iter().enumerate() {
            let mut candidates = vec![(watch.value(&end), self.time + step)];
            if self.rules.peaks {
                candidates.push((watch.value(&self.y), self.time));
                let (before, after) = (watch.slope(&self.y), watch.slope(&end));
                if before * after < 0.0 {
                    let slope = |t: f64| watch.slope(&self.plant.advance(self.mode, &self.y, t));
                    let t = bisect(|t| slope(t) * before < 0.0, 0.0, step).1;
                    let top = self.plant.advance(self.mode, &self.y, t);
                    candidates.push((watch.value(&top), self.time + t));
                }
            }
            let history = &mut self.history;
            let peak = match i / n {
                0 => &mut history.displacement[i],
                1 => &mut history.drift[i - n],
                2 => &mut history.acceleration[i - 2 * n],
                _ if i == 3 * n => &mut history.force,
                _ => &mut history.penetration,
            };
            for (value, time) in candidates {
                // Forces that push and floors that overlap are positive.
                let size = if i < 3 * n { value.abs() } else { value };
                if size > peak.0 {
                    *peak = (size, time);
                }
            }
        }
    }
}

/// Neighbouring doubles between which a condition becomes true.
fn bisect(holds: impl Fn(f64) -> bool, low: f64, high: f64) -> (f64, f64) {
    let (mut low, mut high) = (low, high);
    if holds(low) {
        return (low, low);
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return (low, high);
        }
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
}
