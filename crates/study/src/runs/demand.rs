//! The gap that just keeps isolated buildings apart.

use pounding_time_history::{
    Recorder, RunOptions, Sample, StepView, System, TimeHistoryError, run,
};

/// Parts of a step at whose ends velocities are looked at: several turns of a fast mode
/// inside one step of the record are seen.
const PARTS: usize = 8;
/// Halvings of a part with a turn in it: the value errs by the square of what is left.
const HALVINGS: usize = 24;

/// Greatest approach (m) of the floors of every level of `system` without its gaps; never
/// below zero.
pub(super) fn isolated_demand(
    system: &System,
    options: &RunOptions,
) -> Result<Vec<f64>, TimeHistoryError> {
    let pairs = system.levels().iter().map(|l| (l.left, l.right)).collect();
    let mut recorder = Approach {
        pairs,
        start: Sample::default(),
        end: Sample::default(),
        inside: Sample::default(),
        greatest: vec![0.0; system.levels().len()],
    };
    run(
        &system.isolated(),
        options,
        &mut [&mut recorder],
        &mut |_| {},
    )?;
    Ok(recorder.greatest)
}

/// Degrees of freedom of the floors of a level; `None` is a wall.
type Pair = (Option<usize>, Option<usize>);

struct Approach {
    pairs: Vec<Pair>,
    start: Sample,
    end: Sample,
    inside: Sample,
    greatest: Vec<f64>,
}

/// Left minus right.
fn between(pair: Pair, x: &[f64]) -> f64 {
    pair.0.map_or(0.0, |i| x[i]) - pair.1.map_or(0.0, |i| x[i])
}

impl Approach {
    /// Whether a level may come closer inside a step than it ever did, as far as
    /// velocities and accelerations at the ends of the step tell.
    fn worth_a_look(&self, level: usize, step: f64) -> bool {
        let reach = |s: &Sample| {
            let pair = self.pairs[level];
            let (d, v) = (between(pair, &s.displacement), between(pair, &s.velocity));
            d + step * v.abs() + step * step * between(pair, &s.acceleration_absolute).abs()
        };
        reach(&self.start).max(reach(&self.end)) > self.greatest[level]
    }
}

impl Recorder for Approach {
    fn begin(&mut self, _: &System, start: &Sample) -> Result<(), TimeHistoryError> {
        self.end.clone_from(start);
        for (level, greatest) in self.greatest.iter_mut().enumerate() {
            *greatest = between(self.pairs[level], &start.displacement).max(0.0);
        }
        Ok(())
    }

    fn step(&mut self, step: &mut StepView<'_, '_, '_>) -> Result<(), TimeHistoryError> {
        std::mem::swap(&mut self.start, &mut self.end);
        let (from, to) = (step.start(), step.end());
        step.sample(to, &mut self.end);
        for level in 0..self.pairs.len() {
            if !self.worth_a_look(level, to - from) {
                continue;
            }
            let pair = self.pairs[level];
            let mut velocity_before = between(pair, &self.start.velocity);
            let mut before = from;
            for part in 1..=PARTS {
                let time = from + (to - from) * part as f64 / PARTS as f64;
                step.sample(time, &mut self.inside);
                let velocity = between(pair, &self.inside.velocity);
                let mut here = between(pair, &self.inside.displacement);
                if velocity_before > 0.0 && velocity <= 0.0 {
                    let (mut low, mut high) = (before, time);
                    for _ in 0..HALVINGS {
                        let middle = 0.5 * (low + high);
                        step.sample(middle, &mut self.inside);
                        if between(pair, &self.inside.velocity) > 0.0 {
                            low = middle;
                        } else {
                            high = middle;
                        }
                    }
                    here = here.max(between(pair, &self.inside.displacement));
                }
                self.greatest[level] = self.greatest[level].max(here);
                (before, velocity_before) = (time, velocity);
            }
        }
        Ok(())
    }
}
