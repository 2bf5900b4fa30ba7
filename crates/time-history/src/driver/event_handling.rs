//! What the driver does at an event: cut the step there, process it, change modes.

use pounding_gap_element::{Memory, Phase, SeparationRule, Target, Transition};

use pounding_hysteresis::Guard;

use super::{
    CHATTER, Driver, EVENT_TOLERANCE, EVENTS_AT_ONCE, LOCATION_STEPS, Mute, PROGRESS_STEP,
    SIMULTANEOUS,
};
use crate::contact::Contact;
use crate::dynamics::{Context, Instant};
use crate::error::TimeHistoryError;
use crate::events::{Candidate, EventKind};
use crate::peak::Peak;
use crate::polynomial::{Polynomial, bound, derivative, first_rise, value};
use crate::system::Segment;

/// Round-off of a displacement or a velocity, as a part of the maximum one.
const ROUND_OFF: f64 = 1.0e-14;

/// Round-off of a holding force, as a part of its maximum in the step.
const HOLDING_FORCE_ROUND_OFF: f64 = 1.0e-9;

impl Driver<'_> {
    /// Cuts the step at the event: Newton on the event function, each time with a
    /// fresh trial step of the corrected length. Returns the final length, and
    /// false if the event was not reached: a trial was rejected before it, or the event
    /// is not there. The interpolant of the whole step may cross zero by its own error
    /// where the motion does not.
    pub(super) fn locate(
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
            let (correction, missed) = self.correction(segment, tau, step, event);
            if missed && !(correction > 0.0 && step + correction <= whole) {
                return Ok((step, false));
            }
            let limit = EVENT_TOLERANCE.max(4.0 * f64::EPSILON * step);
            let corrected = (step + correction).clamp(0.5 * step, whole.min(1.5 * step));
            if !correction.is_finite() || correction.abs() <= limit || corrected == step {
                return Ok((step, true));
            }
            step = corrected;
        }
        let taken = self.trial(segment, tau, step)?;
        let (_, missed) = self.correction(segment, tau, taken, event);
        Ok((taken, taken >= step && !missed))
    }

    /// The first event inside a trial step that was cut at this one, or before any, if it is clearly
    /// over at the end. The interpolant of the whole step may have put events in another order, as
    /// where a law has a kink in it, and that of the cut one knows better; or this event hid another
    /// one of its level, of which the finder keeps the first alone. The events of the finder are then
    /// those of the cut step.
    pub(super) fn stepped_over(
        &mut self,
        segment: &Segment,
        tau: f64,
        step: f64,
        event: Option<Candidate>,
    ) -> Option<Candidate> {
        std::mem::swap(&mut self.finder.candidates, &mut self.finder.others);
        self.find(segment, tau, step, event);
        let mut first: Option<Candidate> = None;
        for number in 0..self.finder.candidates.len() {
            let other = self.finder.candidates[number];
            let is_inside = other.theta * step > SIMULTANEOUS
                && (1.0 - other.theta) * step > SIMULTANEOUS
                && first.is_none_or(|first| other.theta < first.theta);
            if is_inside && self.is_over(segment, tau, step, other) {
                first = Some(other);
            }
        }
        if first.is_none() {
            std::mem::swap(&mut self.finder.candidates, &mut self.finder.others);
        }
        first
    }

    /// Whether the function of an event is positive at the end of the trial step, by more than
    /// round-off.
    fn is_over(&mut self, segment: &Segment, tau: f64, step: f64, event: Candidate) -> bool {
        let guard = self.function(segment, tau, step, event);
        let mut limit = self.round_off(event, &self.new_state);
        if limit.is_infinite() {
            limit = HOLDING_FORCE_ROUND_OFF * bound(&guard);
        }
        value(&guard, 1.0) > limit
    }

    /// The function of an event over the trial step.
    fn function(&mut self, segment: &Segment, tau: f64, step: f64, event: Candidate) -> Polynomial {
        let mut context = Context {
            dynamics: &mut self.dynamics,
            contacts: &self.contacts,
            segment,
        };
        let method = self.method.as_ref();
        self.finder.forget();
        self.finder
            .guard(&mut context, method, event.level, event.kind, tau, step)
    }

    /// Newton correction of the length of a step that should end at the event, and
    /// whether the event lies clearly, by more than round-off, neither within that step
    /// nor at its end.
    fn correction(
        &mut self,
        segment: &Segment,
        tau: f64,
        step: f64,
        event: Candidate,
    ) -> (f64, bool) {
        let guard = self.function(segment, tau, step, event);
        // Floors that were let be may have closed by a trifle: they meet again where
        // they set out, not at a zero that they never reach.
        let start = match event.kind {
            EventKind::Close => guard[0].max(0.0),
            _ => 0.0,
        };
        let (end, slope) = (value(&guard, 1.0), value(&derivative(&guard), 1.0));
        let correction = (start - end) * step / slope;
        let missed = start - end > self.round_off(event, &self.new_state)
            && correction.abs() > SIMULTANEOUS
            && first_rise(&guard).is_none();
        (correction, missed)
    }

    /// What round-off of displacements, velocities and internal variables makes in the function of
    /// an event in this state; infinite for those of a holding force, which depends on all forces.
    fn round_off(&self, event: Candidate, state: &[f64]) -> f64 {
        let n = self.dynamics.layout.dofs;
        let (u, v) = (&state[..n], &state[n..2 * n]);
        let largest = |x: &[f64]| x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let (displacement, velocity) = (ROUND_OFF * largest(u), ROUND_OFF * largest(v));
        let index = match event.kind {
            EventKind::Close | EventKind::Open => return displacement,
            EventKind::Branch(Guard::Above | Guard::Below) => return displacement,
            EventKind::Branch(Guard::Variable(i)) => {
                let element = &self.system.elements()[event.level];
                let first = element.range(self.dynamics.layout).start;
                let size = element.law.variable_sizes()[usize::from(i)];
                return ROUND_OFF * size.max(state[first + usize::from(i)].abs());
            }
            EventKind::Branch(_) => return velocity,
            EventKind::Transition(index) => index,
        };
        let level = &self.system.levels()[event.level];
        let Some(contact) = self.contacts.contact(event.level) else {
            return f64::INFINITY;
        };
        let transition = level.model.transitions(contact.phase)[index];
        let function =
            |delta: f64, rate: f64| contact.transition_function(level, transition, delta, rate);
        let delta = self.contacts.penetration(self.system, event.level, u);
        let rate = level.relative(v);
        let here = function(delta, rate);
        if !here.is_finite() {
            return f64::INFINITY;
        }
        (function(delta + displacement, rate) - here).abs()
            + (function(delta, rate + velocity) - here).abs()
    }

    /// Processes the event and all others within tolerance of it, in the order of their
    /// levels. Returns whether the forces that begin are smooth functions of time.
    pub(super) fn process(
        &mut self,
        segment: &Segment,
        tau: f64,
        event: Candidate,
        step: f64,
    ) -> Result<bool, TimeHistoryError> {
        let mut smooth = true;
        self.eventful = true;
        let candidates = std::mem::take(&mut self.finder.candidates);
        self.rigid.closing.clear();
        self.held.leaving.clear();
        self.bring_to_rest();
        for other in &candidates {
            let together = (other.theta - event.theta).abs() * step <= SIMULTANEOUS;
            let same = other.level == event.level && other.kind == event.kind;
            if !same && !together {
                continue;
            }
            if let EventKind::Branch(guard) = other.kind {
                self.pass(other.level, guard);
                let time = segment.start + tau;
                self.contacts.elements.note_lost(self.system, time);
                self.statistics.events += 1;
                self.stalled += 1;
                continue;
            }
            self.mark_level(other.level);
            let rigid = self.is_rigid(other.level);
            if rigid && other.kind == EventKind::Close {
                if self.approaches(other.level) {
                    self.rigid.closing.push(other.level);
                    self.quiet[other.level] = PROGRESS_STEP;
                } else {
                    // At rest: unless a force presses them together, the sign of the gap is
                    // round-off.
                    self.keep_quiet(other.level);
                }
            } else if self.goes_on_touching(segment, tau, *other) {
                self.mute[other.level] = Mute::Step;
            } else {
                if rigid {
                    self.held.leaving.push(other.level);
                }
                self.fire(segment, tau, *other);
            }
            self.statistics.events += 1;
            self.comes_at_once(other.level);
            let model = &self.system.levels()[other.level].model;
            let begins = other.kind == EventKind::Close && self.mute[other.level] != Mute::Step;
            if begins && !model.smooth_at_closure() {
                smooth = false;
            }
        }
        self.finder.candidates = candidates;
        if !self.rigid.closing.is_empty() {
            self.rigid_impacts(segment, tau)?;
            // Of forces that jump no crossing of zero is known.
            self.held.leaving.clear();
        }
        self.settle_held(segment, tau)?;
        self.settle_stuck(segment, tau);
        self.method.restart(smooth);
        self.is_stalled(segment.start + tau, &event)?;
        Ok(smooth)
    }

    /// Notes a step that ended before an event that is not there, at once: round-off of a gap of floors that set out
    /// together crosses zero in every long step, and in no short one. What comes so again and again does not count
    /// before the level has made progress.
    pub(super) fn makes_no_progress(
        &mut self,
        time: f64,
        event: Candidate,
    ) -> Result<(), TimeHistoryError> {
        match event.kind {
            EventKind::Branch(_) => self.stalled += 1,
            _ => self.comes_at_once(event.level),
        }
        self.is_stalled(time, &event)
    }

    /// Counts an event of a level at the present instant; after many of them the level has to make progress.
    fn comes_at_once(&mut self, l: usize) {
        self.at_once[l] += 1;
        if self.at_once[l] > EVENTS_AT_ONCE && self.mute[l] == Mute::No {
            self.mute[l] = Mute::Start;
        }
        self.stalled += 1;
    }

    /// Gives up a run whose events leave no time between them.
    fn is_stalled(&self, time: f64, event: &Candidate) -> Result<(), TimeHistoryError> {
        if self.stalled > CHATTER {
            return Err(TimeHistoryError::Chatter {
                time,
                count: self.stalled,
                place: self.place_of(event),
                adaptive: self.method.information().adaptive,
            });
        }
        Ok(())
    }

    /// An element leaves its branch.
    fn pass(&mut self, index: usize, guard: Guard) {
        let (n, layout) = (self.dynamics.layout.dofs, self.dynamics.layout);
        let element = &self.system.elements()[index];
        let motion = element.motion(&self.state[..n], &self.state[n..2 * n]);
        let history = &mut self.contacts.elements.histories[index];
        element
            .law
            .pass(history, guard, motion, &self.state[element.range(layout)]);
        self.contacts.elements.changes[index] += 1;
        if guard == Guard::Turning {
            self.contacts.elements.turned[index] = true;
        }
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
                self.peaks.force[l] = Peak { value: 0.0, time };
                self.peaks.penetration[l] = Peak { value: 0.0, time };
            }
            EventKind::Open => self.open(l, time),
            // Passed before it comes to this.
            EventKind::Branch(_) => {}
            EventKind::Transition(index) => {
                let Some(phase) = self.contacts.contact(l).map(|c| c.phase) else {
                    return;
                };
                let next = match level.model.transitions(phase)[index].target {
                    Target::Open => return self.part_at_zero_force(l, time),
                    Target::Phase(phase) => phase,
                    Target::StickOrSlip => self.stick_or_slip(segment, tau, l),
                };
                if next == Phase::Stuck {
                    self.log.stick(l);
                } else if phase == Phase::Stuck {
                    self.mute[l] = Mute::Step;
                }
                self.contacts.enter(self.system, l, next, &self.state[..n]);
            }
        }
    }

    /// Ends a contact whose floors still overlap.
    fn part_at_zero_force(&mut self, l: usize, time: f64) {
        let n = self.dynamics.layout.dofs;
        if self.system.levels()[l].model.separation() == SeparationRule::GapShift {
            let left = self.contacts.penetration(self.system, l, &self.state[..n]);
            self.contacts.widen(l, left);
            self.log.widen(l, left);
        }
        self.open(l, time);
        if self.is_rigid(l) {
            self.keep_quiet(l);
        } else {
            self.mute[l] = Mute::Start;
        }
    }

    /// Lets the contacts that have forces of their own follow a jump of velocities. The event
    /// finder looks for functions that become positive; one that a jump made so would not be
    /// found by it.
    pub(super) fn follow_jump(&mut self, time: f64) {
        let n = self.dynamics.layout.dofs;
        for l in 0..self.dynamics.layout.levels {
            if self.is_rigid(l) {
                continue;
            }
            self.begin_again(l, time);
            // A law has few phases, and none that it would enter twice at one velocity.
            for _ in 0..EVENTS_AT_ONCE {
                let Some(target) = self.left_phase(l) else {
                    break;
                };
                self.statistics.events += 1;
                let rate = self.system.levels()[l].relative(&self.state[n..2 * n]);
                let next = match target {
                    Target::Open => {
                        self.part_at_zero_force(l, time);
                        break;
                    }
                    Target::Phase(next) => next,
                    Target::StickOrSlip if rate > 0.0 => Phase::Approach,
                    Target::StickOrSlip => Phase::Restitution,
                };
                let u = &self.state[..n];
                let delta = self.contacts.penetration(self.system, l, u);
                self.contacts.commit_level(self.system, l, (delta, rate));
                self.contacts.enter(self.system, l, next, u);
            }
        }
    }

    /// Lets a contact that closed at the instant of a jump begin with the velocity after it: the
    /// jump takes no time, and the law has not acted yet.
    fn begin_again(&mut self, l: usize, time: f64) {
        let (n, layout) = (self.dynamics.layout.dofs, self.dynamics.layout);
        let level = &self.system.levels()[l];
        let rate = level.relative(&self.state[n..2 * n]);
        let closed =
            self.contacts.contact(l).is_some() && self.log.has_just_closed(l, layout, &self.state);
        if !closed || rate <= self.velocity_round_off() {
            return;
        }
        let collision = level.model.begin(rate, level.effective_mass);
        let contact = Contact {
            phase: Phase::Approach,
            collision,
            memory: Memory::default(),
        };
        self.contacts.open(l);
        self.contacts.close(l, contact);
        self.log.begin_again(l, time, &collision);
    }

    /// Where a closed contact has to go since its relative velocity is what it is now, by more
    /// than round-off; `None` where its phase is right.
    fn left_phase(&self, l: usize) -> Option<Target> {
        let n = self.dynamics.layout.dofs;
        let level = &self.system.levels()[l];
        let contact = self.contacts.contact(l)?;
        let (u, v) = (&self.state[..n], &self.state[n..2 * n]);
        let delta = self.contacts.penetration(self.system, l, u);
        let rate = level.relative(v);
        if contact.is_stuck() {
            // Friction holds by a force, which an impulse exceeds.
            return (rate.abs() > self.velocity_round_off()).then_some(Target::StickOrSlip);
        }
        let transitions = level.model.transitions(contact.phase);
        let fires = |index: usize, transition: &Transition| {
            let kind = EventKind::Transition(index);
            let event = Candidate {
                level: l,
                kind,
                theta: 0.0,
            };
            let rises = contact.transition_function(level, *transition, delta, rate);
            rises > self.round_off(event, &self.state)
        };
        let index = (0..transitions.len()).find(|i| fires(*i, &transitions[*i]))?;
        Some(transitions[index].target)
    }

    /// Ends the contact of a level.
    pub(super) fn open(&mut self, l: usize, time: f64) {
        let n = self.dynamics.layout.dofs;
        let rate = self.system.levels()[l].relative(&self.state[n..2 * n]);
        self.contacts.open(l);
        let end = Some((time, -rate));
        self.log
            .open(l, end, &self.peaks, self.dynamics.layout, &self.state, 0.0);
    }

    /// Coulomb's choice at zero relative velocity: hold if the contact can.
    fn stick_or_slip(&mut self, segment: &Segment, tau: f64, l: usize) -> Phase {
        let n = self.dynamics.layout.dofs;
        let level = &self.system.levels()[l];
        self.contacts.set_phase(l, Phase::Stuck);
        let u = &self.state[..n];
        self.dynamics.accelerations(
            &self.contacts,
            Instant::committed(segment.ground(tau)),
            &self.state,
            &mut self.interpolated[..n],
        );
        let holding = self.dynamics.forces[l];
        let Some(contact) = self.contacts.contact(l) else {
            return Phase::Restitution;
        };
        let delta = self.contacts.penetration(self.system, l, u);
        let (low, high) = level
            .model
            .stick_range(&contact.collision, &contact.memory, delta);
        if holding > high {
            Phase::Approach
        } else if holding < low {
            Phase::Restitution
        } else {
            Phase::Stuck
        }
    }
}
