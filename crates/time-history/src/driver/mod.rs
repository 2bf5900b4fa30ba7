//! The run: steps, events, peaks, ledger.

mod contact_episode;
mod contact_free;
mod episode_steps;
mod event_handling;
mod exact_steps;
mod functions;
mod held_contacts;
mod mute;
mod parts;
mod result;
mod rigid_impacts;
mod stepped_impacts;
mod stuck_contacts;
mod watch;
mod whole_intervals;

use pounding_hysteresis::History;
use pounding_shear_building::ShearBuilding;
use std::sync::Arc;

use crate::contact::Contacts;
use crate::dynamics::{Context, Dynamics, Instant};
use crate::error::TimeHistoryError;
use crate::events::{Candidate, EventKind, Finder};
use crate::history::History as Responses;
use crate::impacts::ImpactLog;
use crate::ledger;
use crate::methods::{Method, Verdict};
use crate::observers::Observers;
use crate::options::RunOptions;
use crate::outcome::{Ledger, Outcome, Statistics};
use crate::peaks::Peaks;
use crate::recorder::{MethodStep, Recorder, StepView, append_state, wants};
use crate::relative_displacement::RelativeDisplacement;
use crate::system::{Grounds, Segment, System};
use contact_episode::{Left, Open};
use exact_steps::{Advance, ExactSteps};
use held_contacts::HeldContacts;
use mute::Mute;
use parts::{Marks, Parts};
use rigid_impacts::RigidImpacts;

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
/// Changes of branch of an element at one instant that lie on its way: a hook and a gap without
/// play have no way between them.
const CHANGES_ON_THE_WAY: usize = 2;
/// Events without progress before the run is given up.
const CHATTER: usize = 10_000;

/// Integrates a system: a pure function of its arguments. `progress` is given the
/// part of the duration that is done, at most a few hundred times a run: exact steps
/// without contact are taken at once.
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
    let on_isolators = |b: &Arc<ShearBuilding>| b.isolator().is_some();
    if system.levels().is_empty() || !system.buildings().iter().any(on_isolators) {
        return integrate(system, options, recorders, progress);
    }
    // Who has isolators asks how far the building came towards its walls.
    let mut approach = RelativeDisplacement::of_levels(system);
    let mut all: Vec<&mut dyn Recorder> = Vec::with_capacity(recorders.len() + 1);
    for recorder in recorders {
        all.push(&mut **recorder);
    }
    all.push(&mut approach);
    let mut outcome = integrate(system, options, &mut all, progress)?;
    for (gap, place) in outcome.gaps.iter_mut().zip(system.gaps()) {
        let range = place.first_level..place.first_level + place.levels;
        let levels = system.levels_of(place).iter().zip(&approach.peaks()[range]);
        for (level, (contact, approach)) in gap.levels.iter_mut().zip(levels) {
            let left = (contact.width - approach.value).max(0.0);
            let left = if level.impacts > 0 { 0.0 } else { left };
            level.clearance = system.isolated_beside(contact).map(|_| left);
        }
    }
    Ok(outcome)
}

fn integrate(
    system: &System,
    options: &RunOptions,
    recorders: &mut [&mut dyn Recorder],
    progress: &mut dyn FnMut(f64),
) -> Result<Outcome, TimeHistoryError> {
    let duration = options.check(system)?;
    for recorder in recorders.iter_mut() {
        recorder.prepare(duration)?;
    }
    let outcome = follow(system, (options, duration), recorders, progress);
    let ended = recorders.iter_mut().try_for_each(|r| r.end());
    outcome.and_then(|outcome| ended.map(|()| outcome))
}

fn follow(
    system: &System,
    (options, duration): (&RunOptions, f64),
    recorders: &mut [&mut dyn Recorder],
    progress: &mut dyn FnMut(f64),
) -> Result<Outcome, TimeHistoryError> {
    let mut driver = Driver::new(system, options);
    let mut observers = Observers::new(system, recorders, duration);
    driver.begin(observers.recorders)?;
    let mut reported = 0.0;
    let mut sample = 0;
    while system.segment(sample, duration).is_some() {
        sample += driver.whole_intervals(sample, duration, observers.recorders)?;
        let mut from = 0.0;
        if driver.open.is_some() {
            sample += driver.propagate(sample, duration, &mut observers)?;
            match driver.contact_episode(sample, duration, &mut observers)? {
                Left::At(next) => {
                    sample = next;
                    from = f64::NAN;
                }
                Left::Within(at, tau) => (sample, from) = (at, tau),
            }
            driver.hand_out_impacts(observers.recorders)?;
        }
        if from.is_finite()
            && let Some(segment) = system.segment(sample, duration)
        {
            driver.segment(&segment, from, duration, observers.recorders)?;
            sample += 1;
        }
        let done = system
            .segment(sample, duration)
            .map_or(1.0, |s| s.start / duration);
        // That of the end is told once.
        if done < 1.0 && done - reported >= 0.004 {
            reported = done;
            progress(done);
        }
    }
    progress(1.0);
    driver.finish(duration, observers.recorders)
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
    /// Energy (J) of all floors at 1 mm/s: what a run with less input is measured by.
    least_energy: f64,
    /// Present residual of the energy balance (J), and the largest.
    residual: f64,
    largest_residual: f64,
    statistics: Statistics,
    /// Events of each level at the present instant.
    at_once: Vec<usize>,
    mute: Vec<Mute>,
    /// Closures of each level since it last did more than touch.
    touches: Vec<usize>,
    /// Whether a level may have had an event at the present instant, or be muted.
    eventful: bool,
    /// Step (s) that a muted level makes.
    quiet: Vec<f64>,
    stalled: usize,
    last_ground: Option<Grounds>,
    /// Whether any level is rigid.
    any_rigid: bool,
    rigid: RigidImpacts,
    held: HeldContacts,
    /// Exact contact-free motion, where the method and the buildings allow it.
    open: Option<Box<Open<'a>>>,
    /// Where some buildings of a row touch and others do not: those that do.
    parts: Option<Box<Parts>>,
    marks: Marks,
    /// Terms of Taylor series in the coordinates of the modes.
    series_terms: u64,
    /// Space for the history of an element on trial.
    spare: Option<History>,
    /// Exact steps of the coordinates, where there are no modes to do them.
    exact: Option<ExactSteps>,
}

impl<'a> Driver<'a> {
    fn new(system: &'a System, options: &'a RunOptions) -> Self {
        let dynamics = Dynamics::new(system);
        let layout = dynamics.layout;
        let zeros = || vec![0.0; layout.dimension()];
        let mut state = zeros();
        state[..2 * layout.dofs].copy_from_slice(system.initial_state());
        let mut contacts = Contacts::all_open(system);
        contacts.elements.begin(system, layout, &mut state);
        contacts.elements.note_lost(system, 0.0);
        // What the buildings bring along counts as put in.
        let brought = ledger::energy(system, layout, &contacts, &state, None);
        state[layout.input()] = brought.kinetic + brought.strain + brought.hysteretic;
        Self {
            system,
            options,
            method: options.build_method(system),
            contacts,
            finder: Finder::new(layout),
            peaks: Peaks::new(layout, system),
            log: ImpactLog::new(system),
            ledger: Ledger {
                largest_input: state[layout.input()],
                ..Ledger::default()
            },
            state,
            new_state: zeros(),
            interpolated: zeros(),
            least_energy: 0.5e-6 * system.mass().iter().sum::<f64>(),
            residual: 0.0,
            largest_residual: 0.0,
            statistics: Statistics::default(),
            at_once: vec![0; layout.levels],
            mute: vec![Mute::No; layout.levels],
            touches: vec![0; layout.levels],
            eventful: true,
            quiet: vec![PROGRESS_STEP; layout.levels],
            stalled: 0,
            last_ground: None,
            any_rigid: system
                .levels()
                .iter()
                .any(|level| level.model.rigid_restitution().is_some()),
            rigid: RigidImpacts::default(),
            held: HeldContacts::default(),
            open: None,
            parts: None,
            marks: Marks::default(),
            series_terms: 0,
            spare: None,
            exact: None,
            dynamics,
        }
        .ready_for_contact_free()
    }

    fn begin(&mut self, recorders: &mut [&mut dyn Recorder]) -> Result<(), TimeHistoryError> {
        let ground = self.system.ground_at_start();
        let segment = Segment {
            start: 0.0,
            length: 0.0,
            acceleration: ground.first,
            slope: 0.0,
            interval: 0,
        };
        if self.locates_impacts() {
            self.settle_held(&segment, 0.0)?;
        }
        let mut context = Context {
            dynamics: &mut self.dynamics,
            contacts: &self.contacts,
            segment: &segment,
        };
        self.peaks.begin(&mut context, &self.state);
        let mut start = Responses::default();
        let now = Instant::committed(ground);
        append_state(&mut context, 0.0, now, &self.state, &mut start);
        for recorder in recorders {
            recorder.begin(self.system, &start)?;
        }
        Ok(())
    }

    /// Integrates over one interval between samples.
    fn segment(
        &mut self,
        segment: &Segment,
        from: f64,
        duration: f64,
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<(), TimeHistoryError> {
        let ground = segment.ground(from);
        if self.system.jumps_into(ground, self.last_ground) {
            // A jump of the ground acceleration, as at the end of a record.
            self.method.restart(true);
            if let Some(exact) = &mut self.exact {
                exact.interrupt();
            }
            if self.locates_impacts() {
                self.bring_to_rest();
                self.held.leaving.clear();
                self.settle_held(segment, from)?;
                self.settle_stuck(segment, from);
            }
        }
        self.last_ground = Some(segment.ground(segment.length));
        let mut tau = from;
        while tau < segment.length {
            let until = match self.exact_step(segment, tau, duration, recorders)? {
                Advance::To(next) => {
                    tau = next;
                    self.hand_out_impacts(recorders)?;
                    continue;
                }
                Advance::ToEvent(next, (event, whole)) => {
                    tau = next;
                    self.process(segment, tau, event, whole)?;
                    self.hand_out_impacts(recorders)?;
                    continue;
                }
                Advance::LeftToMethod(until) => until,
            };
            let context = Context {
                dynamics: &mut self.dynamics,
                contacts: &self.contacts,
                segment,
            };
            let mut step = self.method.propose(&context, tau, &self.state);
            if until < segment.length {
                step = step.min(until - tau);
            }
            for (mute, quiet) in self.mute.iter().zip(&self.quiet) {
                if *mute != Mute::No {
                    step = step.min(*quiet);
                }
            }
            let rest = segment.length - tau;
            step = self.trial(segment, tau, step)?;
            while step > PROGRESS_STEP && self.overlaps_unseen(segment) {
                step = self.trial(segment, tau, (0.5 * step).max(PROGRESS_STEP))?;
            }
            let mut earliest = self.find(segment, tau, step, None);
            while step > PROGRESS_STEP && earliest.is_some_and(|e| self.turns_at_once(e, step)) {
                step = self.trial(segment, tau, (0.1 * step).max(PROGRESS_STEP))?;
                earliest = self.find(segment, tau, step, None);
            }
            let mut ended_by = None;
            if let Some(event) = earliest {
                if event.theta * step <= EVENT_TOLERANCE {
                    self.process(segment, tau, event, step)?;
                    continue;
                }
                let (mut whole, mut event) = (step, event);
                let (mut cut, mut reached) = self.locate(segment, tau, whole, event)?;
                for _ in 0..self.finder.candidates.len() {
                    let passed = self.passed_over(event, whole).filter(|_| reached);
                    let Some(earlier) = passed else {
                        break;
                    };
                    event = earlier;
                    (cut, reached) = self.locate(segment, tau, whole, event)?;
                }
                for _ in 0..LOCATION_STEPS {
                    let place = reached.then_some(event);
                    let Some(earlier) = self.stepped_over(segment, tau, cut, place) else {
                        break;
                    };
                    (whole, event) = (cut, earlier);
                    (cut, reached) = self.locate(segment, tau, whole, event)?;
                }
                step = cut;
                ended_by = reached.then_some((event, whole));
                if !reached && cut <= SIMULTANEOUS {
                    self.makes_no_progress(segment.start + tau, event)?;
                }
            }
            let reached_end = ended_by.is_none() && step >= rest;
            let next = if reached_end {
                segment.length
            } else {
                tau + step
            };
            // A step below the digits of the time would be taken for ever.
            if !reached_end && ended_by.is_none() && next <= tau {
                return Err(TimeHistoryError::StepTooSmall {
                    time: segment.start + tau,
                    step,
                    method: self.method.information().title,
                    place: self.places_in_touch(),
                });
            }
            let last = reached_end && segment.start + segment.length >= duration * (1.0 - 1e-12);
            self.accept(segment, tau, step, (ended_by.is_some(), last), recorders)?;
            if let Some((event, whole)) = ended_by {
                self.process(segment, next, event, whole)?;
            }
            tau = next;
            self.hand_out_impacts(recorders)?;
        }
        Ok(())
    }

    /// Shows recorders the impacts that are over.
    fn hand_out_impacts(
        &mut self,
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<(), TimeHistoryError> {
        if recorders.is_empty() {
            return Ok(());
        }
        for impact in self.log.finished() {
            for recorder in recorders.iter_mut() {
                recorder.impact(impact)?;
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

    /// Whether an element that turned at this very instant, or that has come to where it may
    /// go back and forth, would leave its new branch at once: at rest, that is told by a second
    /// derivative, between floors that set out together even by the fourth, which the
    /// interpolant of a long step does not have.
    fn turns_at_once(&self, event: Candidate, step: f64) -> bool {
        let elements = &self.contacts.elements;
        matches!(event.kind, EventKind::Branch(_))
            && event.theta * step <= EVENT_TOLERANCE
            && (elements.turned[event.level] || elements.changes[event.level] >= CHANGES_ON_THE_WAY)
    }

    /// Whether contacts close, hold and open by events; else steps have impulses, and which floors
    /// are held together follows from these.
    fn locates_impacts(&self) -> bool {
        self.method.step_impulses().is_none()
    }

    /// The earliest event of the trial step, and the first of every level, but for one that is known
    /// and may hide others of its level.
    fn find(
        &mut self,
        segment: &Segment,
        tau: f64,
        step: f64,
        known: Option<Candidate>,
    ) -> Option<Candidate> {
        if !self.locates_impacts() {
            return None;
        }
        let mut context = Context {
            dynamics: &mut self.dynamics,
            contacts: &self.contacts,
            segment,
        };
        let (mute, at_once) = (&self.mute, &self.at_once);
        self.finder.find(
            &mut context,
            self.method.as_ref(),
            (tau, step),
            |Candidate { level, kind, theta }| {
                let is_muted = match kind {
                    EventKind::Branch(_) => false,
                    _ => mute[level].hides(theta * step, at_once[level]),
                };
                is_muted || known.is_some_and(|known| known.level == level && known.kind == kind)
            },
        )
    }

    /// Shows an accepted step of the method to the recorders that want something of it.
    fn show_step(
        &mut self,
        (segment, tau, step): (&Segment, f64, f64),
        last: bool,
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<(), TimeHistoryError> {
        let mut context = Context {
            dynamics: &mut self.dynamics,
            contacts: &self.contacts,
            segment,
        };
        let end = segment.start + tau + step;
        for recorder in recorders.iter_mut().filter(|r| wants(&***r, end, last)) {
            let step = MethodStep {
                context: &mut context,
                method: self.method.as_ref(),
                state: &mut self.interpolated,
                tau,
                step,
            };
            recorder.step(&mut StepView::of_method(step, last))?;
        }
        Ok(())
    }

    fn accept(
        &mut self,
        segment: &Segment,
        tau: f64,
        step: f64,
        (cut, last): (bool, bool),
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<(), TimeHistoryError> {
        self.hold_for_step(segment, tau, step);
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
        self.show_step((segment, tau, step), last, recorders)?;
        self.stands(segment, tau, step)?;
        if let Some(exact) = &mut self.exact {
            exact.interrupt();
        }
        self.method.accept(cut);
        std::mem::swap(&mut self.state, &mut self.new_state);
        self.stepped_impacts(segment, tau, step);
        self.statistics.steps += 1;
        if step > SIMULTANEOUS {
            self.at_once.fill(0);
            self.mute.fill(Mute::No);
            self.contacts.elements.turned.fill(false);
            self.contacts.elements.changes.fill(0);
            self.stalled = 0;
        }
        let n = self.dynamics.layout.dofs;
        let information = self.method.information();
        let implicit = information.implicit;
        if !implicit && !information.adaptive {
            self.laws_are_followed(segment.start + tau + step)?;
        }
        self.contacts.elements.accept(
            (self.system, self.dynamics.layout),
            &mut self.spare,
            &mut self.state,
            implicit.then_some(step),
        );
        self.contacts
            .elements
            .note_lost(self.system, segment.start + tau + step);
        self.contacts
            .commit(self.system, &self.state[..n], &self.state[n..2 * n]);
        self.balance(segment.start + tau + step)
    }
}
