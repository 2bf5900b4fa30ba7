//! Following contacts in the coordinates of the modes.

use std::borrow::Cow;
use std::ops::Range;

use super::{Driver, EVENT_TOLERANCE, Mute, SIMULTANEOUS};
use crate::contact_episode::{
    Pair, Rates, Series, StepLength, Touch, are_affine, are_powers, list, refresh,
};
use crate::contact_free::ContactFreePhase;
use crate::error::TimeHistoryError;
use crate::events::Candidate;
use crate::method_choice::MethodChoice;
use crate::observers::Observers;
use crate::system::modes::{ContactFree, Lane, LevelRows, stored};
use crate::system::{Segment, System};

/// Part of the tolerance that the remainder of a series of powers may have.
const NEGLIGIBLE: f64 = 1.0e-9;
/// Size (m) of penetrations beside which the last terms of a series of powers are small.
const SERIES_SIZE: f64 = 1.0e-5;

/// Exact contact-free motion, and contacts between contact-free phases.
pub(super) struct Open<'a> {
    /// Of the whole system, or of a part of it.
    pub constants: Cow<'a, ContactFree>,
    pub phase: ContactFreePhase,
    pub contact_episode: ContactEpisode,
}

/// Work space of contacts.
pub(super) struct ContactEpisode {
    /// Degrees of freedom, and levels in ascending order, that it is about.
    pub dofs: Range<usize>,
    pub levels: Vec<usize>,
    /// For a part of a system: what the balance of its energy counts from (J).
    pub counted_from: Option<f64>,
    pub rows: LevelRows,
    pub touches: Vec<Touch>,
    pub series: Series,
    pub pair: Pair,
    pub rates: Rates,
    /// Closings of all levels (m) at the end of the step.
    pub closings: Vec<f64>,
    pub lengths: StepLength,
    pub absolute: Vec<Lane>,
    pub tolerance: f64,
    /// Terms of a series of powers, what its remainder may be beside the motion, and what its last terms may be (m).
    pub terms: usize,
    pub negligible: f64,
    pub last_terms: f64,
    /// Whether the list of closed levels holds, and whether they all are affine.
    pub listed: bool,
    pub affine: bool,
    /// Whether they all can be expanded into series.
    powers: bool,
    /// Whether the accelerations at the present start hold.
    pub derived: bool,
}

/// Where a contact episode ended.
pub(super) enum Left {
    /// With all gaps open, before this sample.
    At(usize),
    /// In the middle of this sample: the rest is for the general step.
    Within(usize, f64),
}

/// How a sample was taken.
pub(super) enum Sample {
    /// Part by part.
    ByParts,
    /// It is left to the step of all buildings together; observers have seen it or not.
    Whole { shown: bool },
}

impl<'a> Open<'a> {
    pub(super) fn new(system: &'a System, method: &MethodChoice) -> Option<Self> {
        let constants = system.contact_free()?;
        let lanes = constants.modes.len();
        let levels = system.levels().len();
        let MethodChoice::EventDriven { relative_tolerance } = *method else {
            return None;
        };
        let rows = LevelRows::new(&constants.rows, system);
        let dofs = 0..system.degrees_of_freedom();
        let levels = (0..levels).collect();
        Some(Self {
            phase: ContactFreePhase::new(constants, system),
            contact_episode: ContactEpisode::new(rows, (dofs, lanes, levels), relative_tolerance),
            constants: Cow::Borrowed(constants),
        })
    }
}

impl ContactEpisode {
    /// For these degrees of freedom in so many lanes, and these levels.
    pub(super) fn new(
        rows: LevelRows,
        (dofs, lanes, levels): (Range<usize>, usize, Vec<usize>),
        relative_tolerance: f64,
    ) -> Self {
        let (all, count) = (rows.levels.len(), levels.len());
        Self {
            dofs,
            levels,
            counted_from: None,
            rows,
            touches: Vec::with_capacity(count),
            series: Series::new(lanes, count),
            pair: Pair::new(lanes, count),
            rates: Rates::new(lanes),
            closings: vec![0.0; all],
            lengths: StepLength::new(relative_tolerance),
            absolute: vec![Lane::ZERO; lanes],
            tolerance: relative_tolerance,
            terms: series_terms(relative_tolerance),
            negligible: Series::ROUND_OFF.max(NEGLIGIBLE * relative_tolerance),
            last_terms: SERIES_SIZE * relative_tolerance,
            listed: false,
            affine: false,
            powers: false,
            derived: false,
        }
    }
}

impl Open<'_> {
    /// Goes back to contact-free motion.
    fn put_back(&mut self) {
        self.phase.moved = true;
        let [q, p, ..] = &self.contact_episode.pair.start.motion;
        self.phase.now.displacement.copy_from_slice(q);
        self.phase.now.velocity.copy_from_slice(p);
    }
}

impl Driver<'_> {
    /// Follows the motion from the start of a sample until all gaps are open at the end
    /// of one, or until something comes up that the coordinates of the modes do not cover.
    pub(super) fn contact_episode(
        &mut self,
        sample: usize,
        duration: f64,
        observers: &mut Observers<'_, '_>,
    ) -> Result<Left, TimeHistoryError> {
        let Some(mut open) = self.open.take() else {
            return Ok(Left::Within(sample, 0.0));
        };
        let left = self.begin_episode_with(&mut open, (sample, duration), observers);
        self.open = Some(open);
        left
    }

    fn begin_episode_with(
        &mut self,
        open: &mut Open<'_>,
        (first, duration): (usize, f64),
        observers: &mut Observers<'_, '_>,
    ) -> Result<Left, TimeHistoryError> {
        let mut sample = first;
        if self.any_rigid {
            self.leave(open, sample as f64 * self.system.ground().time_step)?;
            return Ok(Left::Within(sample, 0.0));
        }
        let Open {
            constants,
            phase,
            contact_episode,
        } = &mut *open;
        let (system, peaks) = ((self.system, &self.contacts), &self.peaks);
        phase.take_state(constants, system, peaks, &self.state);
        let [q, p, ..] = &mut contact_episode.pair.start.motion;
        contact_episode.listed = false;
        q.copy_from_slice(&phase.now.displacement);
        p.copy_from_slice(&phase.now.velocity);
        while let Some(segment) = self.system.segment(sample, duration) {
            let left = match self.by_parts(open, &segment, duration, observers)? {
                Sample::ByParts => None,
                Sample::Whole { shown: false } => {
                    self.begin_episode_in_segment(open, &segment, observers)?
                }
                Sample::Whole { shown: true } => {
                    let mut nobody = Observers::new(self.system, &mut [], duration);
                    self.begin_episode_in_segment(open, &segment, &mut nobody)?
                }
            };
            if let Some(tau) = left {
                if sample > first || tau > 0.0 {
                    open.put_back();
                }
                self.leave(open, segment.start + tau)?;
                return Ok(Left::Within(sample, tau));
            }
            sample += 1;
            if self.is_contact_free() {
                break;
            }
        }
        open.put_back();
        Ok(Left::At(sample))
    }

    /// Whether all gaps are open, and all events count.
    fn is_contact_free(&self) -> bool {
        let quiet = self.mute.iter().all(|m| *m == Mute::No);
        self.contacts.closed().is_empty() && quiet
    }

    /// Evaluations, or terms of series, in the coordinates of the modes.
    pub(super) fn evaluations_in_modes(&self) -> u64 {
        let open = self.open.as_ref();
        let parts = self.parts.as_ref().map_or(0, |parts| parts.evaluations);
        self.series_terms + parts + open.map_or(0, |o| o.contact_episode.pair.evaluations)
    }

    /// Leaves the coordinates of the modes.
    fn leave(&mut self, open: &mut Open<'_>, time: f64) -> Result<(), TimeHistoryError> {
        let peaks = &mut self.peaks;
        open.phase
            .return_state(&open.constants, self.system, peaks, &mut self.state);
        self.method.restart(true);
        self.balance(time)
    }

    /// Leaves the coordinates of the modes at the end of the run.
    pub(super) fn leave_for_good(&mut self, time: f64) -> Result<(), TimeHistoryError> {
        if let Some(mut open) = self.open.take() {
            self.leave(&mut open, time)?;
            let peaks = &mut self.peaks;
            open.phase.finish(&open.constants, self.system, peaks);
            self.open = Some(open);
        }
        Ok(())
    }

    /// Integrates over one interval between samples. Returns a time within it (s) if it
    /// cannot go on from there.
    pub(super) fn begin_episode_in_segment(
        &mut self,
        open: &mut Open<'_>,
        segment: &Segment,
        observers: &mut Observers<'_, '_>,
    ) -> Result<Option<f64>, TimeHistoryError> {
        let mut tau = 0.0;
        open.contact_episode.derived = false;
        while tau < segment.length {
            let e = &mut open.contact_episode;
            if !e.listed {
                let [q, p, ..] = &e.pair.start.motion;
                let motion = (&e.rows, [&q[..], &p[..]]);
                if !list(&self.contacts, &e.levels, motion, &mut e.touches) {
                    return Ok(Some(tau));
                }
                e.affine = are_affine(&e.touches, self.system);
                e.powers = e.affine || are_powers(&e.touches, self.system);
                if e.powers {
                    let fastest = open.constants.fastest;
                    e.series
                        .take_laws(self.system, (&e.rows, fastest), &e.touches);
                }
                e.listed = true;
            }
            let mut quiet = f64::INFINITY;
            if self.eventful {
                for l in &e.levels {
                    if self.mute[*l] != Mute::No {
                        quiet = quiet.min(self.quiet[*l]);
                    }
                }
            }
            let rest = segment.length - tau;
            let longest = rest.min(quiet);
            let e = &open.contact_episode;
            let series = if e.affine {
                Some(longest)
            } else if e.powers {
                let penetrations = &open.phase.penetration;
                let touches = e.touches.iter();
                let touches = touches.map(|t| (penetrations[t.level], t.motion.1));
                e.lengths.of_series(touches, e.last_terms, longest)
            } else {
                None
            };
            let mut taken = (0.0, None);
            let done = match series {
                Some(length) => {
                    self.by_series(open, (segment, tau), (length, &mut taken), observers)?
                }
                None => false,
            };
            if !done {
                self.by_pair(open, (segment, tau), (longest, &mut taken), observers)?;
            }
            let (step, event) = taken;
            if let Some((event, whole)) = event
                && event.theta * whole <= EVENT_TOLERANCE
            {
                // Nothing to cross: the event is at the start.
                self.displacements_of_modes(open);
                self.fire_all(open, segment, tau, (event, whole))?;
                continue;
            }
            let next = if event.is_none() && step >= rest {
                segment.length
            } else {
                tau + step
            };
            self.arrive(open, segment.start + tau + step, step)?;
            if let Some((event, whole)) = event {
                // The peaks at the end of the step have asked for them.
                let dofs = open.contact_episode.dofs.clone();
                open.phase.present_displacements(&mut self.state[dofs]);
                self.fire_all(open, segment, next, (event, whole))?;
            }
            tau = next;
        }
        Ok(None)
    }

    /// Takes the floors' displacements from the modes.
    fn displacements_of_modes(&mut self, open: &mut Open<'_>) {
        let (q, dofs) = (
            &open.contact_episode.pair.start.motion[0],
            open.contact_episode.dofs.clone(),
        );
        open.phase
            .floors_of(&open.constants, q, &mut self.state[dofs]);
    }

    /// Processes the events at an instant, whose displacements the state has.
    fn fire_all(
        &mut self,
        open: &mut Open<'_>,
        segment: &Segment,
        tau: f64,
        (event, whole): (Candidate, f64),
    ) -> Result<(), TimeHistoryError> {
        let Open {
            constants,
            phase,
            contact_episode,
        } = &mut *open;
        let (n, dofs) = (self.dynamics.layout.dofs, contact_episode.dofs.clone());
        let p = &contact_episode.pair.start.motion[1];
        let velocities = &mut self.state[n..2 * n][dofs];
        phase.floors_of(constants, p, velocities);
        let smooth = self.process(segment, tau, event, whole)?;
        let contact_episode = &mut open.contact_episode;
        contact_episode.lengths.restart(smooth);
        contact_episode.listed = false;
        contact_episode.derived = false;
        open.phase.acceleration_known = false;
        Ok(())
    }

    /// Common to all steps: the new state has been put in place.
    fn arrive(
        &mut self,
        open: &mut Open<'_>,
        time: f64,
        step: f64,
    ) -> Result<(), TimeHistoryError> {
        let Open {
            constants,
            phase,
            contact_episode,
        } = open;
        let constants: &ContactFree = constants;
        let layout = self.dynamics.layout;
        let [q, p, ..] = &contact_episode.pair.start.motion;
        self.statistics.steps += 1;
        let levels = &contact_episode.levels;
        if step > SIMULTANEOUS {
            if self.eventful {
                for l in levels {
                    self.at_once[*l] = 0;
                    self.mute[*l] = Mute::No;
                }
                // Levels of other parts may have had events.
                self.eventful = contact_episode.counted_from.is_some();
            }
            self.stalled = 0;
        }
        if contact_episode.counted_from.is_none() {
            let closings = &contact_episode.closings;
            let penetrations = phase.penetration.iter_mut().zip(closings);
            for ((penetration, closing), width) in penetrations.zip(self.contacts.widths()) {
                *penetration = closing - width;
            }
        } else {
            for l in levels {
                phase.penetration[*l] = contact_episode.closings[*l] - self.contacts.width(*l);
            }
        }
        for touch in &contact_episode.touches {
            let l = touch.level;
            self.contacts.commit_level(self.system, l, touch.motion);
        }
        if !contact_episode.affine {
            refresh(&self.contacts, &mut contact_episode.touches);
        }
        let worked: f64 = levels.iter().map(|l| self.state[layout.work(*l)]).sum();
        let input = self.state[layout.input()];
        let mut residual = stored(constants, q, p) + self.state[layout.viscous()] + worked - input;
        if let Some(start) = contact_episode.counted_from {
            // The other buildings are not yet, or no longer, at this time.
            residual -= start;
        } else {
            self.ledger.largest_input = self.ledger.largest_input.max(input.abs());
        }
        if !residual.is_finite() {
            return Err(self.not_finite(time));
        }
        self.residual = residual;
        self.largest_residual = self.largest_residual.max(residual.abs());
        if worked < -self.most_given() {
            return self.contacts_give(time, residual);
        }
        Ok(())
    }
}

/// Terms of a series of powers: more are worth while where more digits are asked for.
fn series_terms(tolerance: f64) -> usize {
    (6.0 - 1.5 * libm::log10(tolerance)).clamp(12.0, 22.0) as usize
}
