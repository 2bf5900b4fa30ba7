//! Exact steps over whole intervals without contact, for buildings that are no sums of
//! oscillators.

use super::{Driver, Mute};
use crate::dynamics::{Layout, Segment};
use crate::error::TimeHistoryError;
use crate::methods::Context;
use crate::propagation::{Ends, Propagation};
use crate::recorder::{MethodStep, Recorder, StepView};
use crate::system::System;

/// What rows over the degrees of freedom are looked at in every interval.
#[derive(Debug)]
pub(super) struct WholeIntervals {
    propagation: Propagation,
    /// Displacement and drift of every floor with the number of its building.
    floors: Vec<Floor>,
    /// Rows of sections, of accelerations and of contact levels, with `sqrt(w' M^-1 w)` of each
    /// building: what multiplies its bound.
    sections: Vec<Bounded>,
    accelerations: Vec<Bounded>,
    responses: Vec<Bounded>,
    levels: Vec<Bounded>,
    /// Space for the state while recorders are served.
    saved: Vec<f64>,
    /// Work counts of the method for steps that serve recorders alone.
    pub recording: u64,
}

#[derive(Debug)]
struct Floor {
    building: usize,
    /// Storey height (m).
    height: f64,
    has_below: bool,
    /// Whether the drift is the difference of two floors.
    plain_drift: bool,
    /// One over the square root of the mass, and that of the floor below added in squares.
    mobility: f64,
    drift_mobility: f64,
    shear: Option<f64>,
}

/// A row with what multiplies the bound of each building.
#[derive(Debug)]
struct Bounded {
    terms: Vec<(usize, f64)>,
    mobility: Vec<(usize, f64)>,
}

impl Bounded {
    fn new(system: &System, terms: Vec<(usize, f64)>) -> Self {
        let mass = system.mass();
        let mut mobility = Vec::new();
        for building in 0..system.buildings().len() {
            let parts = system.parts(building);
            let own = terms
                .iter()
                .filter(|(i, _)| parts.iter().any(|p| p.contains(i)));
            let square: f64 = own.map(|(i, w)| w * w / mass[*i]).sum();
            if square > 0.0 {
                mobility.push((building, square.sqrt()));
            }
        }
        Self { terms, mobility }
    }

    /// Bounds from below and above over an interval of length `h`, from values and slopes at
    /// both ends of quantity `of` (0 displacement, 2 acceleration).
    fn range(&self, ends: &Ends, of: usize, h: f64) -> (f64, f64) {
        let sum = |x: &[f64]| self.terms.iter().map(|(i, w)| w * x[*i]).sum::<f64>();
        let values = [
            &ends.start[of],
            &ends.start[of + 1],
            &ends.end[of],
            &ends.end[of + 1],
        ];
        let error: f64 = self
            .mobility
            .iter()
            .map(|(b, m)| m * ends.bounds[*b][of / 2])
            .sum();
        range(values.map(|x| sum(x)), error, h)
    }
}

/// Least and greatest value of a cubic, by its control points, and the remainder.
fn range([x0, v0, x1, v1]: [f64; 4], fourth: f64, h: f64) -> (f64, f64) {
    let points = [x0, x0 + h * v0 / 3.0, x1 - h * v1 / 3.0, x1];
    let error = h.powi(4) / 384.0 * fourth;
    let least = points.iter().copied().fold(f64::INFINITY, f64::min);
    let most = points.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (least - error, most + error)
}

impl WholeIntervals {
    pub(super) fn new(system: &System) -> Option<Self> {
        let propagation = system.propagation()?.for_system(system);
        let mass = system.mass();
        let mut floors = Vec::new();
        for (index, building) in system.buildings().iter().enumerate() {
            let first = system.offsets()[index];
            for storey in 0..building.storeys() {
                let below = if storey > 0 {
                    1.0 / mass[first + storey - 1]
                } else {
                    0.0
                };
                let own = 1.0 / mass[first + storey];
                floors.push(Floor {
                    building: index,
                    height: building.height()[storey],
                    has_below: storey > 0,
                    plain_drift: building.drifts().is_none(),
                    mobility: own.sqrt(),
                    drift_mobility: (own + below).sqrt(),
                    shear: building.stiffness().get(storey).copied(),
                });
            }
        }
        let rows = |terms: Vec<(usize, f64)>| Bounded::new(system, terms);
        let levels = system.levels().iter().map(|level| {
            let ends = [(level.left, 1.0), (level.right, -1.0)].into_iter();
            let ends = ends.filter_map(|(i, w)| i.map(|i| (i, w)));
            let further = level
                .terms
                .pushed
                .iter()
                .chain(&level.terms.ground)
                .copied();
            rows(ends.chain(further).collect())
        });
        Some(Self {
            propagation,
            floors,
            sections: system
                .sections()
                .iter()
                .map(|s| rows(s.terms().collect()))
                .collect(),
            accelerations: (system.acceleration_rows().iter())
                .map(|s| rows(s.terms().collect()))
                .collect(),
            responses: (system.level_rows().iter())
                .map(|r| rows(r.terms.clone()))
                .collect(),
            levels: levels.collect(),
            saved: Vec::with_capacity(Layout::of(system).dimension()),
            recording: 0,
        })
    }
}

impl Driver<'_> {
    /// Leads the run over a whole interval if no contact is closed, none can close in it, and
    /// nothing can have a peak; false leaves it to the method.
    pub(super) fn whole_interval(
        &mut self,
        segment: &Segment,
        duration: f64,
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<bool, TimeHistoryError> {
        let quiet = self.mute.iter().all(|mute| *mute == Mute::No);
        if !quiet || !self.contacts.closed().is_empty() {
            return Ok(false);
        }
        let Some(mut whole) = self.whole.take() else {
            return Ok(false);
        };
        let done = self.lead(&mut whole, segment);
        if done {
            let last = segment.start + segment.length >= duration * (1.0 - 1e-12);
            self.show(&mut whole, segment, last, recorders)?;
            self.take(&whole, segment);
        }
        self.whole = Some(whole);
        if done {
            self.balance(segment.start + segment.length)?;
        }
        Ok(done)
    }

    /// Whether the interval holds neither an event nor a peak.
    fn lead(&mut self, whole: &mut WholeIntervals, segment: &Segment) -> bool {
        let system = self.system;
        if !whole.propagation.advance(system, segment, &self.state) {
            return false;
        }
        let (ends, h) = (&whole.propagation.ends, segment.length);
        for (l, row) in whole.levels.iter().enumerate() {
            // What is not a number is no proof.
            if !(row.range(ends, 0, h).1 < self.contacts.width(l)) {
                return false;
            }
        }
        let below = |row: &Bounded, of: usize, peak: f64| {
            let (least, most) = row.range(ends, of, h);
            most.max(-least) <= peak
        };
        let instants = [segment.ground(0.0), segment.ground(h)];
        for (i, floor) in whole.floors.iter().enumerate() {
            let peaks = &self.peaks.storeys[i];
            let [bound, bound_of_acceleration] = ends.bounds[floor.building];
            let largest = |values: [f64; 4], fourth: f64| {
                let (least, most) = range(values, fourth, h);
                most.max(-least)
            };
            let at = |i: usize, of: usize| {
                [
                    ends.start[of][i],
                    ends.start[of + 1][i],
                    ends.end[of][i],
                    ends.end[of + 1][i],
                ]
            };
            let u = at(i, 0);
            if !(largest(u, floor.mobility * bound) <= peaks.displacement.value) {
                return false;
            }
            if floor.plain_drift {
                let under = if floor.has_below {
                    at(i - 1, 0)
                } else {
                    [0.0; 4]
                };
                let drift = std::array::from_fn(|k| u[k] - under[k]);
                let drift = largest(drift, floor.drift_mobility * bound);
                let shear = floor.shear.map_or(0.0, |k| k * drift);
                if !(drift <= peaks.drift_ratio.value * floor.height
                    && shear <= peaks.storey_shear.value)
                {
                    return false;
                }
            }
            let [a, b] = instants.map(|ground| system.ground_on(i, ground));
            let slope = system.ground_slope_on(i, segment);
            let [a0, r0, a1, r1] = at(i, 2);
            let absolute = [a0 + a, r0 + slope, a1 + b, r1 + slope];
            let fourth = floor.mobility * bound_of_acceleration;
            if !(largest(absolute, fourth) <= peaks.acceleration_absolute.value) {
                return false;
            }
        }
        let sections = whole.sections.iter().zip(system.sections());
        for (row, section) in sections {
            if !below(row, 0, self.peaks.of_section(section.place).value) {
                return false;
            }
        }
        for (row, section) in whole.accelerations.iter().zip(system.acceleration_rows()) {
            let ground = |k: usize| -> f64 {
                let on = |i: usize| match k {
                    0 => system.ground_on(i, instants[0]),
                    2 => system.ground_on(i, instants[1]),
                    _ => system.ground_slope_on(i, segment),
                };
                row.terms.iter().map(|(i, w)| w * on(*i)).sum()
            };
            let sum = |x: &[f64]| row.terms.iter().map(|(i, w)| w * x[*i]).sum::<f64>();
            let values = [&ends.start[2], &ends.start[3], &ends.end[2], &ends.end[3]];
            let values: [f64; 4] = std::array::from_fn(|k| sum(values[k]) + ground(k));
            let fourth: f64 = row
                .mobility
                .iter()
                .map(|(b, m)| m * ends.bounds[*b][1])
                .sum();
            let (least, most) = range(values, fourth, h);
            if !(most.max(-least) <= self.peaks.of_section(section.place).value) {
                return false;
            }
        }
        for ((row, given), peak) in (whole.responses.iter())
            .zip(system.level_rows())
            .zip(&self.peaks.of_levels)
        {
            let (least, most) = row.range(ends, 0, h);
            let most = if given.one_sided {
                most
            } else {
                most.max(-least)
            };
            if !(most <= peak.value) {
                return false;
            }
        }
        true
    }

    /// Serves recorders from steps of the method, of which nothing else remains.
    fn show(
        &mut self,
        whole: &mut WholeIntervals,
        segment: &Segment,
        last: bool,
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<(), TimeHistoryError> {
        let end = segment.start + segment.length;
        if !recorders.iter().any(|r| r.next_time() <= end) {
            return Ok(());
        }
        whole.saved.clone_from(&self.state);
        let before = (self.method.counts(), self.statistics);
        self.method.restart(true);
        let mut tau = 0.0;
        while tau < segment.length {
            let context = Context {
                dynamics: &mut self.dynamics,
                contacts: &self.contacts,
                segment,
            };
            let first = self.method.propose(&context, tau, &self.state);
            let step = self.trial(segment, tau, first)?;
            let rest = segment.length - tau;
            let at_end = step >= rest * (1.0 - 1.0e-12);
            let mut context = Context {
                dynamics: &mut self.dynamics,
                contacts: &self.contacts,
                segment,
            };
            let until = segment.start + tau + step;
            for recorder in recorders.iter_mut().filter(|r| r.next_time() <= until) {
                let step = MethodStep {
                    context: &mut context,
                    method: self.method.as_ref(),
                    state: &mut self.interpolated,
                    tau,
                    step,
                };
                recorder.step(&mut StepView::of_method(step, last && at_end))?;
            }
            self.method.accept(false);
            std::mem::swap(&mut self.state, &mut self.new_state);
            tau = if at_end { segment.length } else { tau + step };
        }
        let (counts, statistics) = before;
        self.statistics = statistics;
        self.state.copy_from_slice(&whole.saved);
        whole.recording += self.method.counts().evaluations - counts.evaluations;
        Ok(())
    }

    /// Takes the end of the interval.
    fn take(&mut self, whole: &WholeIntervals, segment: &Segment) {
        let ends = &whole.propagation.ends;
        let (n, layout) = (self.dynamics.layout.dofs, self.dynamics.layout);
        self.state[..n].copy_from_slice(&ends.end[0]);
        self.state[n..2 * n].copy_from_slice(&ends.end[1]);
        self.state[layout.input()] += ends.input;
        self.state[layout.viscous()] += ends.viscous;
        self.method.restart(true);
        self.statistics.steps += 1;
        self.at_once.fill(0);
        self.stalled = 0;
        self.last_ground = Some(segment.ground(segment.length));
    }
}
