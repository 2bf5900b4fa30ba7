//! The run: steps, events, peaks, ledger.

use pounding_gap_element::{Memory, Phase, Target};

use crate::contact::{Contact, Contacts};
use crate::dynamics::{Dynamics, Segment};
use crate::error::TimeHistoryError;
use crate::events::{Candidate, EventKind, Finder};
use crate::impacts::ImpactLog;
use crate::ledger;
use crate::methods::{Context, Method, Verdict};
use crate::options::RunOptions;
use crate::outcome::{BuildingOutcome, GapOutcome, Ledger, Outcome, Statistics};
use crate::peaks::Peaks;
use crate::polynomial::{derivative, value};
use crate::recorder::{Recorder, Sample, StepView, fill_sample};
use crate::system::System;

/// Events closer together than this (s) are one event.
const SIMULTANEOUS: f64 = 1.0e-12;
/// A located event is this close to its root (s).
const EVENT_TOLERANCE: f64 = 1.0e-15;
/// Trial steps taken at most to locate one event.
const LOCATION_STEPS: usize = 8;
/// Shortest step (s) before a run is given up.
const SHORTEST_STEP: f64 = 1.0e-15;
/// Events of one level at one instant before the level has to make progress.
const EVENTS_AT_ONCE: usize = 4;
/// Step (s) that it then has to make, and that floors make after they broke
/// loose: relative velocity and acceleration are zero there, so that only the
/// next higher derivative tells the direction, and round-off must not.
const PROGRESS_STEP: f64 = 1.0e-6;
/// Events without progress before the run is given up.
const CHATTER: usize = 10_000;

/// Integrates a system: a pure function of its arguments. `progress` is told the
/// part of the duration that is done, a few hundred times a run.
///
/// # Errors
/// An option out of range, a step that cannot be made small enough, events
/// without progress, an open energy ledger, or a recorder's error; each with
/// time and place.
pub fn run(
    system: &System,
    options: &RunOptions,
    recorders: &mut [&mut dyn Recorder],
    progress: &mut dyn FnMut(f64),
) -> Result<Outcome, TimeHistoryError> {
    let duration = options.check(system)?;
    let mut driver = Driver::new(system, options);
    driver.begin(recorders)?;
    let mut told = 0.0;
    let mut sample = 0;
    while let Some(segment) = segment(system, sample, duration) {
        driver.segment(&segment, duration, recorders)?;
        sample += 1;
        let done = (segment.start + segment.length) / duration;
        if done - told >= 0.004 {
            told = done;
            progress(done);
        }
    }
    progress(1.0);
    driver.finish(duration, recorders)
}

/// Interval number `sample` of the ground motion up to the end of the run; after
/// the last sample the ground stands still.
fn segment(system: &System, sample: usize, duration: f64) -> Option<Segment> {
    let ground = system.ground();
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
    })
}

/// What events of a level do not count in the next step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mute {
    /// All count.
    No,
    /// Not those at its very start: the level has to make progress.
    Start,
    /// None: the floors just broke loose.
    Step,
}

struct Driver<'a> {
    system: &'a System,
    options: &'a RunOptions,
    dynamics: Dynamics<'a>,
    method: Box<dyn Method>,
    contacts: Contacts,
    finder: Finder,
    peaks: Peaks,
    log: ImpactLog,
    state: Vec<f64>,
    new_state: Vec<f64>,
    interpolated: Vec<f64>,
    ledger: Ledger,
    largest_residual: f64,
    statistics: Statistics,
    /// Events of each level at the present instant.
    at_once: Vec<usize>,
    mute: Vec<Mute>,
    stalled: usize,
    last_ground: f64,
}

impl<'a> Driver<'a> {
    fn new(system: &'a System, options: &'a RunOptions) -> Self {
        let dynamics = Dynamics::new(system);
        let layout = dynamics.layout;
        let zeros = || vec![0.0; layout.dimension()];
        Self {
            system,
            options,
            method: options.build_method(system),
            contacts: Contacts::all_open(layout.levels),
            finder: Finder::new(layout),
            peaks: Peaks::new(layout),
            log: ImpactLog::new(system),
            state: zeros(),
            new_state: zeros(),
            interpolated: zeros(),
            ledger: Ledger::default(),
            largest_residual: 0.0,
            statistics: Statistics::default(),
            at_once: vec![0; layout.levels],
            mute: vec![Mute::No; layout.levels],
            stalled: 0,
            last_ground: f64::NAN,
            dynamics,
        }
    }

    fn begin(&mut self, recorders: &mut [&mut dyn Recorder]) -> Result<(), TimeHistoryError> {
        let ground = self.system.ground().samples.first().copied().unwrap_or(0.0);
        let segment = Segment {
            start: 0.0,
            length: 0.0,
            acceleration: ground,
            slope: 0.0,
        };
        let mut context = Context {
            dynamics: &mut self.dynamics,
            contacts: &self.contacts,
            segment: &segment,
        };
        let mut sample = Sample::default();
        fill_sample(&mut context, 0.0, ground, &self.state, &mut sample);
        for recorder in recorders {
            recorder.begin(self.system, &sample)?;
        }
        Ok(())
    }

    /// Integrates over one interval between samples.
    fn segment(
        &mut self,
        segment: &Segment,
        duration: f64,
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<(), TimeHistoryError> {
        if segment.acceleration != self.last_ground {
            // A jump of the ground acceleration, as at the end of a record.
            self.method.restart(true);
        }
        self.last_ground = segment.ground(segment.length);
        let mut tau = 0.0;
        while tau < segment.length {
            let mut step = self.method.propose(segment, tau);
            if self.mute.iter().any(|m| *m != Mute::No) {
                step = step.min(PROGRESS_STEP);
            }
            let rest = segment.length - tau;
            step = self.trial(segment, tau, step)?;
            let earliest = self.find(segment, tau, step);
            let mut ended_by = None;
            if let Some(event) = earliest {
                if event.theta * step <= EVENT_TOLERANCE {
                    self.process(segment, tau, event, step)?;
                    continue;
                }
                let whole = step;
                let (cut, reached) = self.locate(segment, tau, whole, event)?;
                step = cut;
                ended_by = reached.then_some((event, whole));
            }
            let reached_end = ended_by.is_none() && step >= rest;
            let next = if reached_end {
                segment.length
            } else {
                tau + step
            };
            let last = reached_end && segment.start + segment.length >= duration * (1.0 - 1e-12);
            self.accept(segment, tau, step, (ended_by.is_some(), last), recorders)?;
            if let Some((event, whole)) = ended_by {
                self.process(segment, next, event, whole)?;
            }
            tau = next;
            for impact in self.log.finished() {
                for recorder in recorders.iter_mut() {
                    recorder.impact(impact)?;
                }
            }
        }
        Ok(())
    }

    /// Tries steps, ever shorter, until one is accurate. Returns its length.
    fn trial(&mut self, segment: &Segment, tau: f64, first: f64) -> Result<f64, TimeHistoryError> {
        let mut step = first;
        loop {
            let mut context = Context {
                dynamics: &mut self.dynamics,
                contacts: &self.contacts,
                segment,
            };
            let verdict =
                self.method
                    .trial(&mut context, tau, &self.state, step, &mut self.new_state);
            match verdict {
                Verdict::Accept => {
                    self.method.prepare_interpolant(&mut context, tau);
                    return Ok(step);
                }
                Verdict::Retry(shorter) => {
                    self.statistics.rejected += 1;
                    // A NaN must end here too.
                    if !(shorter >= SHORTEST_STEP) {
                        return Err(TimeHistoryError::StepTooSmall {
                            time: segment.start + tau,
                            step: shorter,
                            method: self.method.information().title,
                            place: self.places_in_touch(),
                        });
                    }
                    step = shorter;
                }
            }
        }
    }

    fn find(&mut self, segment: &Segment, tau: f64, step: f64) -> Option<Candidate> {
        let mut context = Context {
            dynamics: &mut self.dynamics,
            contacts: &self.contacts,
            segment,
        };
        let mute = &self.mute;
        self.finder.find(
            &mut context,
            self.method.as_ref(),
            (tau, step),
            |level, theta| match mute[level] {
                Mute::No => false,
                Mute::Start => theta == 0.0,
                Mute::Step => true,
            },
        )
    }

    /// Cuts the step at the event: Newton on the event function, each time with a
    /// fresh trial step of the corrected length. Returns the final length, and
    /// false if a trial was rejected before the event was reached.
    fn locate(
        &mut self,
        segment: &Segment,
        tau: f64,
        whole: f64,
        event: Candidate,
    ) -> Result<(f64, bool), TimeHistoryError> {
        let mut step = event.theta * whole;
        for _ in 0..LOCATION_STEPS {
            let taken = self.trial(segment, tau, step)?;
            self.statistics.location_steps += 1;
            if taken < step {
                return Ok((taken, false));
            }
            let correction = self.correction(segment, tau, step, event);
            let limit = EVENT_TOLERANCE.max(4.0 * f64::EPSILON * step);
            let corrected = (step + correction).clamp(0.5 * step, whole.min(1.5 * step));
            if !correction.is_finite() || correction.abs() <= limit || corrected == step {
                return Ok((step, true));
            }
            step = corrected;
        }
        let taken = self.trial(segment, tau, step)?;
        Ok((taken, taken >= step))
    }

    /// Newton correction of the length of a step that should end at the event.
    fn correction(&mut self, segment: &Segment, tau: f64, step: f64, event: Candidate) -> f64 {
        let mut context = Context {
            dynamics: &mut self.dynamics,
            contacts: &self.contacts,
            segment,
        };
        let method = self.method.as_ref();
        let guard = self
            .finder
            .guard(&mut context, method, event.level, event.kind, tau, step);
        -value(&guard, 1.0) * step / value(&derivative(&guard), 1.0)
    }

    fn accept(
        &mut self,
        segment: &Segment,
        tau: f64,
        step: f64,
        (cut, last): (bool, bool),
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<(), TimeHistoryError> {
        let mut context = Context {
            dynamics: &mut self.dynamics,
            contacts: &self.contacts,
            segment,
        };
        self.peaks.step(
            &mut context,
            self.method.as_ref(),
            &mut self.finder,
            (tau, step),
        );
        for recorder in recorders.iter_mut() {
            recorder.step(&mut StepView {
                context: &mut context,
                method: self.method.as_ref(),
                state: &mut self.interpolated,
                tau,
                step,
                last,
            })?;
        }
        self.method.accept(cut);
        std::mem::swap(&mut self.state, &mut self.new_state);
        self.statistics.steps += 1;
        if step > SIMULTANEOUS {
            self.at_once.fill(0);
            self.mute.fill(Mute::No);
            self.stalled = 0;
        }
        let n = self.dynamics.layout.dofs;
        self.contacts
            .commit(self.system, &self.state[..n], &self.state[n..2 * n]);
        let energy = ledger::energy(
            self.system,
            self.dynamics.layout,
            &self.contacts,
            &self.state,
        );
        self.ledger.end = energy;
        self.ledger.largest_input = self.ledger.largest_input.max(energy.input.abs());
        self.largest_residual = self.largest_residual.max(energy.residual.abs());
        Ok(())
    }

    /// Processes the event and all others within tolerance of it, in the order
    /// of their levels.
    fn process(
        &mut self,
        segment: &Segment,
        tau: f64,
        event: Candidate,
        step: f64,
    ) -> Result<(), TimeHistoryError> {
        let mut smooth = true;
        let candidates = std::mem::take(&mut self.finder.candidates);
        for other in &candidates {
            let together = (other.theta - event.theta).abs() * step <= SIMULTANEOUS;
            if other.level != event.level && !together {
                continue;
            }
            self.fire(segment, tau, *other);
            self.statistics.events += 1;
            self.at_once[other.level] += 1;
            if self.at_once[other.level] > EVENTS_AT_ONCE && self.mute[other.level] == Mute::No {
                self.mute[other.level] = Mute::Start;
            }
            self.stalled += 1;
            let model = &self.system.levels()[other.level].model;
            if other.kind == EventKind::Close && !model.smooth_at_closure() {
                smooth = false;
            }
        }
        self.finder.candidates = candidates;
        self.method.restart(smooth);
        if self.stalled > CHATTER {
            return Err(TimeHistoryError::Chatter {
                time: segment.start + tau,
                count: self.stalled,
                place: self.place(event.level),
            });
        }
        Ok(())
    }

    fn fire(&mut self, segment: &Segment, tau: f64, event: Candidate) {
        let n = self.dynamics.layout.dofs;
        let l = event.level;
        let level = &self.system.levels()[l];
        let time = segment.start + tau;
        let rate = level.relative(&self.state[n..2 * n]);
        match event.kind {
            EventKind::Close => {
                let collision = level.model.begin(rate, level.effective_mass);
                let contact = Contact {
                    phase: Phase::Approach,
                    collision,
                    memory: Memory::default(),
                };
                self.contacts.close(l, contact);
                self.log
                    .close(l, time, &collision, self.dynamics.layout, &self.state);
                self.peaks.force[l] = crate::outcome::Peak { value: 0.0, time };
                self.peaks.penetration[l] = crate::outcome::Peak { value: 0.0, time };
            }
            EventKind::Open => {
                self.contacts.open(l);
                let end = Some((time, -rate));
                self.log
                    .open(l, end, &self.peaks, self.dynamics.layout, &self.state, 0.0);
            }
            EventKind::Transition(index) => {
                let Some(phase) = self.contacts.contact(l).map(|c| c.phase) else {
                    return;
                };
                let next = match level.model.transitions(phase)[index].target {
                    Target::Phase(phase) => phase,
                    Target::StickOrSlip => self.stick_or_slip(segment, tau, l),
                };
                if next == Phase::Stuck {
                    self.log.stick(l);
                } else if phase == Phase::Stuck {
                    self.mute[l] = Mute::Step;
                }
                self.contacts.set_phase(l, next);
            }
        }
    }

    /// Coulomb's choice at zero relative velocity: hold if the contact can.
    fn stick_or_slip(&mut self, segment: &Segment, tau: f64, l: usize) -> Phase {
        let n = self.dynamics.layout.dofs;
        let level = &self.system.levels()[l];
        self.contacts.set_phase(l, Phase::Stuck);
        let (u, v) = (&self.state[..n], &self.state[n..2 * n]);
        self.dynamics.accelerations(
            &self.contacts,
            segment.ground(tau),
            u,
            v,
            &mut self.interpolated[..n],
        );
        let holding = self.dynamics.forces[l];
        let Some(contact) = self.contacts.contact(l) else {
            return Phase::Restitution;
        };
        let (low, high) =
            level
                .model
                .stick_range(&contact.collision, &contact.memory, level.penetration(u));
        if holding > high {
            Phase::Approach
        } else if holding < low {
            Phase::Restitution
        } else {
            Phase::Stuck
        }
    }

    fn place(&self, level: usize) -> String {
        let gap = self
            .system
            .gaps()
            .iter()
            .find(|g| (g.first_level..g.first_level + g.levels).contains(&level));
        gap.map_or_else(String::new, |g| {
            format!("{} level {}", g.name, level - g.first_level + 1)
        })
    }

    fn places_in_touch(&self) -> String {
        let places: Vec<_> = self
            .contacts
            .closed()
            .iter()
            .map(|l| self.place(*l))
            .collect();
        if places.is_empty() {
            "none".to_owned()
        } else {
            places.join(", ")
        }
    }

    fn finish(
        mut self,
        duration: f64,
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<Outcome, TimeHistoryError> {
        let layout = self.dynamics.layout;
        let n = layout.dofs;
        for l in self.contacts.closed().to_vec() {
            let stored = ledger::stored_energy(self.system, &self.contacts, l, &self.state[..n]);
            self.log
                .open(l, None, &self.peaks, layout, &self.state, stored);
        }
        for impact in self.log.finished() {
            for recorder in recorders.iter_mut() {
                recorder.impact(impact)?;
            }
        }
        if self.ledger.largest_input > 0.0 {
            self.ledger.residual_ratio = self.largest_residual / self.ledger.largest_input;
        }
        let allowed = self.options.energy_tolerance();
        // A NaN must not pass.
        if !(self.ledger.residual_ratio <= allowed) {
            return Err(TimeHistoryError::EnergyResidual {
                residual: self.ledger.residual_ratio,
                allowed,
                time: duration,
                method: self.method.information().title,
            });
        }
        let counts = self.method.counts();
        self.statistics.evaluations = counts.evaluations;
        self.statistics.newton_iterations = counts.newton_iterations;
        let buildings = self
            .system
            .buildings()
            .iter()
            .zip(self.system.offsets().windows(2))
            .map(|(b, range)| BuildingOutcome {
                name: b.name().to_owned(),
                storeys: self.peaks.storeys[range[0]..range[1]].to_vec(),
            })
            .collect();
        let (levels, impacts) = self.log.into_outcome();
        let gaps = self
            .system
            .gaps()
            .iter()
            .map(|g| GapOutcome {
                name: g.name.clone(),
                levels: levels[g.first_level..g.first_level + g.levels].to_vec(),
            })
            .collect();
        Ok(Outcome {
            method: self.method.information(),
            end_time: duration,
            buildings,
            gaps,
            impacts,
            energy: self.ledger,
            final_displacement: self.state[..n].to_vec(),
            final_velocity: self.state[n..2 * n].to_vec(),
            statistics: self.statistics,
            warnings: Vec::new(),
        })
    }
}
