//! Exact steps for buildings that are no sums of oscillators: over intervals between samples
//! and parts of them without contact, and over series with contacts.

mod peaks_put_off;
mod series_events;

use pounding_gap_element::{Direction, Guard};

use super::functions::{Begin, Function, Group, Place, Row};
use super::{Driver, EVENTS_AT_ONCE, Mute};
use crate::contact::Contacts;
use crate::dynamics::Context;
use crate::error::TimeHistoryError;
use crate::events::Candidate;
use crate::layout::Layout;
use crate::recorder::{Recorder, wants};
use crate::system::propagation::{AffineContact, ContactSeries, HALVINGS, Propagation};
use crate::system::{Segment, System};
use peaks_put_off::PeaksPutOff;
use series_events::Scan;

/// How often a series is halved before the step is left to the method.
const SHORTENINGS: usize = 3;
/// Part of a length that is round-off.
const ROUND_OFF: f64 = 1.0e-9;

/// Steps with what is looked at in each.
#[derive(Debug)]
pub(super) struct ExactSteps {
    pub propagation: Propagation,
    pub series: ContactSeries,
    /// All that has peaks, and those of buildings together.
    pub functions: Vec<Function>,
    pub groups: Vec<Group>,
    /// Whether the groups have other peaks than the run, and where the next step begins.
    pub stale: bool,
    pub begin: Begin,
    /// Whether a gap may close in the interval that is next.
    pub met: bool,
    /// Numbers of the functions that may have a peak in the present step.
    doubtful: Vec<usize>,
    /// Closings of the contact levels.
    pub levels: Vec<Row>,
    /// Their values and rates at the end of the last whole interval.
    pub closings: Vec<[f64; 2]>,
    /// Time (s) in the interval until which steps are left to the method.
    method_until: f64,
    /// Space for the state while recorders are served.
    saved: Vec<f64>,
    pub put_off: PeaksPutOff,
    /// Work counts of the method for steps that serve recorders alone.
    pub recording: u64,
}

/// What became of an exact step.
pub(super) enum Advance {
    /// It led to this time (s) in the interval.
    To(f64),
    /// It led to this event, which a longer step (s) would have passed.
    ToEvent(f64, (Candidate, f64)),
    /// The method steps, no farther than to this time (s).
    LeftToMethod(f64),
}

impl ExactSteps {
    pub(super) fn new(system: &System) -> Option<Self> {
        let mut propagation = system.propagation()?.for_system(system);
        let (functions, groups) = Function::all(system);
        for group in &groups {
            propagation.follow(group.building(), group.rows());
        }
        Some(Self {
            series: propagation.contact_series(system),
            doubtful: Vec::with_capacity(functions.len()),
            put_off: PeaksPutOff::new(system, functions.len(), propagation.most_halvings()),
            functions,
            groups,
            stale: true,
            met: false,
            begin: Begin::Unknown,
            levels: system
                .levels()
                .iter()
                .map(|l| Row::of_level(system, l))
                .collect(),
            closings: Vec::with_capacity(system.levels().len()),
            method_until: 0.0,
            saved: Vec::with_capacity(Layout::of(system).dimension()),
            recording: 0,
            propagation,
        })
    }

    /// Takes note of a step of the method, or of a jump of the ground's acceleration.
    pub(super) fn interrupt(&mut self) {
        self.stale = true;
        self.begin = Begin::Unknown;
    }
}

impl ContactSeries {
    /// Takes the laws of the closed contacts; false where one is not affine, or where the
    /// bounds would not hold.
    fn take_laws(&mut self, system: &System, contacts: &Contacts) -> bool {
        self.contacts.clear();
        for &l in contacts.closed() {
            let (level, Some(contact)) = (&system.levels()[l], contacts.contact(l)) else {
                return false;
            };
            if contact.is_stuck() || !level.model.is_affine(&contact.collision, contact.phase) {
                return false;
            }
            let law = contact.force(level, 0.0, 0.0);
            if !(law.by_penetration >= 0.0 && law.by_velocity >= 0.0) {
                return false;
            }
            self.contacts.push(AffineContact {
                level: l,
                at_rest: law.value - law.by_penetration * contacts.width(l),
                stiffness: law.by_penetration,
                dashpot: law.by_velocity,
                work: 0.0,
                impulse: 0.0,
            });
        }
        true
    }
}

impl Driver<'_> {
    /// Leads the run from `tau` (s) in an interval as far as it is sure that there is no event
    /// and that no peak is missed.
    pub(super) fn exact_step(
        &mut self,
        segment: &Segment,
        tau: f64,
        duration: f64,
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<Advance, TimeHistoryError> {
        let left = Ok(Advance::LeftToMethod(segment.length));
        // A level that had an event here leaves its root, or the series tells that it does not.
        let mut levels = self.mute.iter().enumerate();
        if levels.any(|(l, mute)| match mute {
            Mute::No => false,
            Mute::Start => self.at_once[l] > EVENTS_AT_ONCE || self.is_rigid(l),
            Mute::Step => true,
        }) {
            return left;
        }
        let Some(mut exact) = self.exact.take() else {
            return left;
        };
        if tau == 0.0 {
            exact.method_until = 0.0;
        }
        let led = self.lead(&mut exact, segment, tau);
        if let Advance::To(next) | Advance::ToEvent(next, _) = led {
            let last = next >= segment.length
                && segment.start + segment.length >= duration * (1.0 - 1e-12);
            self.show(&mut exact, segment, (tau, next), last, recorders)?;
            self.take(&exact, segment, next);
            exact.begin = Begin::AtEnd;
            if matches!(led, Advance::ToEvent(..)) {
                exact.method_until = 0.0;
                exact.begin = Begin::Unknown;
            }
        }
        self.exact = Some(exact);
        if let Advance::To(next) | Advance::ToEvent(next, _) = led {
            self.balance(segment.start + next)?;
        }
        Ok(led)
    }

    fn lead(&mut self, exact: &mut ExactSteps, segment: &Segment, tau: f64) -> Advance {
        if tau < exact.method_until {
            return Advance::LeftToMethod(exact.method_until);
        }
        let closed = !self.contacts.closed().is_empty();
        match exact.propagation.known_length(segment.length) {
            Some(which) if !closed => self.lead_by_matrices(exact, segment, tau, which),
            _ => self.lead_by_series(exact, segment, tau),
        }
    }

    /// Over the interval, or the largest half, quarter and so on of it that begins here.
    fn lead_by_matrices(
        &mut self,
        exact: &mut ExactSteps,
        segment: &Segment,
        tau: f64,
        which: usize,
    ) -> Advance {
        let (system, rest) = (self.system, segment.length - tau);
        let unit = segment.length / f64::from(1_u32 << HALVINGS);
        let place = (tau / unit).round();
        let aligned = (tau - place * unit).abs() <= ROUND_OFF * unit;
        exact.series.contacts.clear();
        let (mut tried, mut by_series) = (false, false);
        for halvings in 0..=HALVINGS {
            let length = segment.length / f64::from(1_u32 << halvings);
            let begins = !aligned || (place as u32).is_multiple_of(1 << (HALVINGS - halvings));
            if length > rest + ROUND_OFF * unit || !begins {
                continue;
            }
            tried = true;
            let part = (which, halvings);
            // A whole interval in which a gap may close has been tried already.
            let met = std::mem::take(&mut exact.met) && halvings == 0 && tau == 0.0;
            if !met {
                let propagation = &mut exact.propagation;
                propagation.advance((system, segment), tau, part, &self.state, |_| true);
            }
            if met || !self.holds_no_event(exact) {
                // A gap may close: the series tells when.
                if !by_series {
                    let led = self.lead_by_series(exact, segment, tau);
                    if !matches!(led, Advance::LeftToMethod(_)) {
                        return led;
                    }
                    by_series = true;
                }
                continue;
            }
            if self.takes_peaks(exact, segment, tau) {
                let next = tau + length;
                let at_end = next >= segment.length - ROUND_OFF * unit;
                return Advance::To(if at_end { segment.length } else { next });
            }
        }
        if !tried {
            // Less than the shortest part is left.
            let led = self.lead_by_series(exact, segment, tau);
            if !matches!(led, Advance::LeftToMethod(_)) {
                return led;
            }
        }
        let end = tau + unit;
        let inside = tried && end < segment.length - ROUND_OFF * unit;
        exact.method_until = if inside { end } else { segment.length };
        Advance::LeftToMethod(exact.method_until)
    }

    /// Over a series of the buildings with the closed contacts.
    fn lead_by_series(&mut self, exact: &mut ExactSteps, segment: &Segment, tau: f64) -> Advance {
        let (system, rest) = (self.system, segment.length - tau);
        let left = Advance::LeftToMethod(segment.length);
        if !exact.series.take_laws(system, &self.contacts) {
            return left;
        }
        let parts = (rest / exact.series.longest(system)).ceil().max(1.0);
        let (place, from) = ((segment, tau), (self.state.as_slice(), rest / parts));
        let (propagation, series) = (&mut exact.propagation, &mut exact.series);
        if !propagation.expand(series, system, place, from) {
            return left;
        }
        let whole = rest / parts;
        exact.propagation.lead(&mut exact.series, system);
        let scan = self.scan(exact);
        let clear = !matches!(scan, Scan::Unclear);
        if let Scan::First(event) = scan {
            exact.series.cut(event.theta);
        }
        for shortenings in 0..=SHORTENINGS {
            if shortenings > 0 {
                exact.series.cut(0.5);
            }
            if shortenings > 0 || matches!(scan, Scan::First(_)) {
                exact.propagation.lead(&mut exact.series, system);
            }
            let passes = clear || self.holds_no_event(exact);
            if passes && self.takes_peaks(exact, segment, tau) {
                let (propagation, series) = (&mut exact.propagation, &mut exact.series);
                propagation.works(series, system);
                let next = tau + series.length();
                return match (shortenings, scan) {
                    (0, Scan::First(event)) => Advance::ToEvent(next, (event, whole)),
                    (0, _) if parts == 1.0 => Advance::To(segment.length),
                    _ => Advance::To(next),
                };
            }
        }
        left
    }

    /// Whether the bounds exclude every event in the step.
    fn holds_no_event(&self, exact: &ExactSteps) -> bool {
        let (ends, closed) = (&exact.propagation.ends, &exact.series.contacts);
        let mut closed = closed.iter().peekable();
        for (l, row) in exact.levels.iter().enumerate() {
            let (least, most) = row.range(ends, 0);
            let Some(law) = closed.next_if(|c| c.level == l) else {
                // What is not a number is no proof.
                if !(most < self.contacts.width(l)) {
                    return false;
                }
                continue;
            };
            let (level, Some(contact)) = (&self.system.levels()[l], self.contacts.contact(l))
            else {
                return false;
            };
            if !(least > self.contacts.width(l)) {
                return false;
            }
            for transition in level.model.transitions(contact.phase) {
                let (least, most) = match transition.guard {
                    Guard::Velocity => row.range(ends, 1),
                    Guard::RawForce if law.is_raw_force_of(contact, level, &self.contacts) => {
                        row.range_of_force(law, ends)
                    }
                    _ => return false,
                };
                let passes = match transition.direction {
                    Direction::Rising => !(most < 0.0),
                    Direction::Falling => !(least > 0.0),
                };
                if passes {
                    return false;
                }
            }
        }
        true
    }

    /// Takes the peaks of a step without events; false if there may be one that would have to
    /// be looked for in shorter steps.
    fn takes_peaks(&mut self, exact: &mut ExactSteps, segment: &Segment, tau: f64) -> bool {
        let ExactSteps {
            propagation,
            series,
            functions,
            groups,
            stale,
            begin,
            doubtful,
            levels,
            ..
        } = exact;
        doubtful.clear();
        let by_series = propagation.is_by_series();
        let mut grouped = 0;
        for group in groups {
            if *stale {
                group.refresh(functions, &self.peaks);
            }
            grouped = group.doubt(&propagation.ends, *begin, doubtful);
        }
        (*stale, *begin) = (false, Begin::AtStart);
        let (levels, ends) = (levels.as_slice(), &propagation.ends);
        let now = Place {
            system: self.system,
            segment,
            tau,
            contacts: &series.contacts,
            levels,
            series: by_series.then_some(&*series),
            finest: false,
        };
        for (number, function) in functions.iter().enumerate().skip(grouped) {
            if !function.stays_below(&now, ends, &self.peaks) {
                doubtful.push(number);
            }
        }
        let stays_below = |law: &AffineContact| {
            let l = law.level;
            let present = [&self.peaks.penetration[l], &self.peaks.force[l]].map(|peak| peak.value);
            levels[l].stay_below((law, ends), self.contacts.width(l), present)
        };
        if doubtful.is_empty() && series.contacts.iter().all(stays_below) {
            return true;
        }
        *stale = true;
        let doubted = |building: usize| doubtful.iter().any(|k| functions[*k].is_of(building));
        propagation.deepen(series, doubted);
        let ends = &propagation.ends;
        let now = Place {
            system: self.system,
            segment,
            tau,
            contacts: &series.contacts,
            levels,
            series: by_series.then_some(&*series),
            finest: false,
        };
        for number in doubtful {
            if !functions[*number].takes_peak(&now, ends, &mut self.peaks) {
                return false;
            }
        }
        let peaks = &mut self.peaks;
        series.contacts.iter().all(|law| {
            let (row, width) = (&levels[law.level], self.contacts.width(law.level));
            let present = [&peaks.penetration[law.level], &peaks.force[law.level]];
            if row.stay_below((law, ends), width, present.map(|peak| peak.value)) {
                return true;
            }
            let penetration = &mut peaks.penetration[law.level];
            row.takes_penetration(&now, ends, width, penetration)
                && row.takes_force(&now, (law, ends), &mut peaks.force[law.level])
        })
    }

    /// Serves recorders from steps of the method, of which nothing else remains.
    pub(super) fn show(
        &mut self,
        exact: &mut ExactSteps,
        segment: &Segment,
        (from, to): (f64, f64),
        last: bool,
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<(), TimeHistoryError> {
        let end = segment.start + to;
        if !recorders.iter().any(|r| wants(&**r, end, last)) {
            return Ok(());
        }
        exact.saved.clone_from(&self.state);
        let before = (self.method.counts(), self.statistics);
        self.method.restart(true);
        let mut tau = from;
        while tau < to {
            let context = Context {
                dynamics: &mut self.dynamics,
                contacts: &self.contacts,
                segment,
            };
            let proposed = self.method.propose(&context, tau, &self.state);
            let rest = to - tau;
            let step = self.trial(segment, tau, proposed.min(rest))?;
            let at_end = step >= rest * (1.0 - 1.0e-12);
            self.show_step((segment, tau, step), last && at_end, recorders)?;
            self.method.accept(false);
            std::mem::swap(&mut self.state, &mut self.new_state);
            tau = if at_end { to } else { tau + step };
        }
        let (counts, statistics) = before;
        self.statistics = statistics;
        self.state.copy_from_slice(&exact.saved);
        exact.recording += self.method.counts().evaluations - counts.evaluations;
        Ok(())
    }

    /// Takes the end of the step.
    pub(super) fn take(&mut self, exact: &ExactSteps, segment: &Segment, next: f64) {
        self.take_motion(exact);
        let layout = self.dynamics.layout;
        for contact in &exact.series.contacts {
            self.state[layout.work(contact.level)] += contact.work;
            self.state[layout.impulse(contact.level)] += contact.impulse;
        }
        let n = layout.dofs;
        let (u, v) = (&self.state[..n], &self.state[n..2 * n]);
        self.contacts.commit(self.system, u, v);
        self.begin_anew();
        self.last_ground = Some(segment.ground(next));
    }

    /// Takes motion and works of a step without contact.
    pub(super) fn take_motion(&mut self, exact: &ExactSteps) {
        let ends = &exact.propagation.ends;
        let (n, layout) = (self.dynamics.layout.dofs, self.dynamics.layout);
        self.state[..n].copy_from_slice(&ends.end[0]);
        self.state[n..2 * n].copy_from_slice(&ends.end[1]);
        self.state[layout.input()] += ends.input;
        self.state[layout.viscous()] += ends.viscous;
        self.statistics.steps += 1;
    }

    /// Leaves behind what belonged to where steps began.
    pub(super) fn begin_anew(&mut self) {
        self.method.restart(true);
        self.at_once.fill(0);
        self.mute.fill(Mute::No);
        self.stalled = 0;
    }
}
