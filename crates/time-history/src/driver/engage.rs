//! Following contacts in the coordinates of the modes.

use super::{Driver, EVENT_TOLERANCE, Mute, SHORTEST_STEP, SIMULTANEOUS, segment};
use crate::dynamics::Segment;
use crate::engagement::{
    Clock, LevelRows, NEAR, Pair, Rates, Scene, Series, SeriesStep, Span, StepLength, Touch,
    are_affine, are_powers, begin_acceleration, in_series, in_span, list, note_floors_of_series,
    note_floors_of_span, refresh, soon_after, total,
};
use crate::error::TimeHistoryError;
use crate::events::Candidate;
use crate::free_flight::{Flight, FreeFlight, Lane, WIDTH};
use crate::options::MethodChoice;
use crate::outcome::Peak;
use crate::polynomial::{bound, fit, fit_nodes, maximum_above, value};
use crate::system::System;

/// Part of the present peak below which a fitted maximum is not looked at closer.
const BELOW_PEAK: f64 = 1.0 - 1.0e-6;

/// Size (m) of penetrations beside which the last terms of a series of powers are small.
const SERIES_SIZE: f64 = 1.0e-5;
/// Part of the step tried from which on such a series is worth its while.
const FAR_ENOUGH: f64 = 0.3;

/// Exact open flight, and contacts between flights.
pub(super) struct Open<'a> {
    pub constants: &'a FreeFlight,
    pub flight: Flight,
    engagement: Engagement,
}

/// Work space of contacts.
struct Engagement {
    rows: LevelRows,
    touches: Vec<Touch>,
    series: Series,
    pair: Pair,
    rates: Rates,
    lengths: StepLength,
    absolute: Vec<Lane>,
    tolerance: f64,
    /// Terms of a series of powers.
    terms: usize,
    /// Whether the list of closed levels holds, and whether they all are affine.
    listed: bool,
    affine: bool,
    /// Whether they all can be expanded into series.
    powers: bool,
    /// Whether the accelerations at the present start hold.
    derived: bool,
}

/// Where an engagement ended.
pub(super) enum Left {
    /// With all gaps open, before this sample.
    At(usize),
    /// In the middle of this sample: the rest is for the general step.
    Within(usize, f64),
}

impl<'a> Open<'a> {
    pub(super) fn new(system: &'a System, method: &MethodChoice) -> Option<Self> {
        let constants = system.free_flight()?;
        let lanes = constants.modes.len();
        let levels = system.levels().len();
        let MethodChoice::EventDriven { relative_tolerance } = *method else {
            return None;
        };
        let zeros = || vec![Lane::ZERO; lanes];
        Some(Self {
            flight: Flight::new(system),
            engagement: Engagement {
                rows: LevelRows::new(constants, system),
                touches: Vec::with_capacity(levels),
                series: Series::new(lanes, levels),
                pair: Pair::new(lanes, levels),
                rates: Rates::new(lanes),
                lengths: StepLength::new(),
                absolute: zeros(),
                tolerance: relative_tolerance,
                terms: series_terms(relative_tolerance),
                listed: false,
                affine: false,
                powers: false,
                derived: false,
            },
            constants,
        })
    }
}

impl Open<'_> {
    /// Gives the motion back to flight.
    fn put_back(&mut self) {
        self.flight.moved = true;
        let [q, p, ..] = &self.engagement.pair.start.motion;
        self.flight.now.displacement.copy_from_slice(q);
        self.flight.now.velocity.copy_from_slice(p);
    }
}

impl Driver<'_> {
    /// Follows the motion from the start of a sample until all gaps are open at the end
    /// of one, or until something comes up that the coordinates of the modes do not cover.
    pub(super) fn engage(
        &mut self,
        sample: usize,
        duration: f64,
    ) -> Result<Left, TimeHistoryError> {
        let Some(mut open) = self.open.take() else {
            return Ok(Left::Within(sample, 0.0));
        };
        let left = self.engage_with(&mut open, sample, duration);
        self.open = Some(open);
        left
    }

    fn engage_with(
        &mut self,
        open: &mut Open<'_>,
        first: usize,
        duration: f64,
    ) -> Result<Left, TimeHistoryError> {
        let mut sample = first;
        if (0..self.system.levels().len()).any(|l| self.is_rigid(l)) {
            self.leave(open, sample as f64 * self.system.ground().time_step)?;
            return Ok(Left::Within(sample, 0.0));
        }
        let Open {
            constants,
            flight,
            engagement,
        } = &mut *open;
        let (system, peaks) = ((self.system, &self.contacts), &self.peaks.storeys);
        flight.board(constants, system, peaks, &self.state);
        let [q, p, ..] = &mut engagement.pair.start.motion;
        engagement.listed = false;
        q.copy_from_slice(&flight.now.displacement);
        p.copy_from_slice(&flight.now.velocity);
        while let Some(segment) = segment(self.system, sample, duration) {
            if let Some(tau) = self.engage_segment(open, &segment)? {
                if sample > first || tau > 0.0 {
                    open.put_back();
                }
                self.leave(open, segment.start + tau)?;
                return Ok(Left::Within(sample, tau));
            }
            sample += 1;
            let quiet = self.mute.iter().all(|m| *m == Mute::No);
            if self.contacts.closed().is_empty() && quiet {
                break;
            }
        }
        open.put_back();
        Ok(Left::At(sample))
    }

    /// Evaluations, or terms of series, in the coordinates of the modes.
    pub(super) fn evaluations_in_modes(&self) -> u64 {
        let open = self.open.as_ref();
        self.series_terms + open.map_or(0, |o| o.engagement.pair.evaluations)
    }

    /// Leaves the coordinates of the modes.
    fn leave(&mut self, open: &mut Open<'_>, time: f64) -> Result<(), TimeHistoryError> {
        let peaks = &mut self.peaks.storeys;
        open.flight
            .disembark(open.constants, self.system, peaks, &mut self.state);
        self.method.restart(true);
        self.balance(time)
    }

    /// Leaves the coordinates of the modes at the end of the run.
    pub(super) fn leave_for_good(&mut self, time: f64) -> Result<(), TimeHistoryError> {
        if let Some(mut open) = self.open.take() {
            self.leave(&mut open, time)?;
            let peaks = &mut self.peaks.storeys;
            open.flight.finish(open.constants, self.system, peaks);
            self.open = Some(open);
        }
        Ok(())
    }

    /// Integrates over one interval between samples. Returns a time within it (s) if it
    /// cannot go on from there.
    fn engage_segment(
        &mut self,
        open: &mut Open<'_>,
        segment: &Segment,
    ) -> Result<Option<f64>, TimeHistoryError> {
        let mut tau = 0.0;
        open.engagement.derived = false;
        while tau < segment.length {
            let e = &mut open.engagement;
            if !e.listed {
                if !list(&self.contacts, &mut e.touches) {
                    return Ok(Some(tau));
                }
                e.affine = are_affine(&e.touches, self.system);
                e.powers = e.affine || are_powers(&e.touches, self.system);
                if e.powers {
                    e.series.take_laws(self.system, &e.touches);
                }
                e.listed = true;
            }
            let mut quiet = f64::INFINITY;
            for (mute, step) in self.mute.iter().zip(&self.quiet) {
                if *mute != Mute::No {
                    quiet = quiet.min(*step);
                }
            }
            let rest = segment.length - tau;
            let longest = rest.min(quiet);
            let e = &open.engagement;
            let series = if e.affine {
                Some(longest)
            } else if e.powers {
                let p = &e.pair.start.motion[1];
                let touches = e.touches.iter().map(|t| {
                    let rate = e.rows.levels[t.level].dot(p);
                    (open.flight.penetration[t.level], rate)
                });
                e.lengths.of_series(touches, longest)
            } else {
                None
            };
            let taken = series.and_then(|length| self.by_series(open, segment, tau, length));
            let (step, event) = match taken {
                Some(taken) => taken,
                None => self.by_pair(open, segment, tau, longest)?,
            };
            if let Some((event, whole)) = event
                && event.theta * whole <= EVENT_TOLERANCE
            {
                // Nothing to cross: the event is at the start.
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
                self.fire_all(open, segment, next, (event, whole))?;
            }
            tau = next;
        }
        Ok(None)
    }

    fn fire_all(
        &mut self,
        open: &mut Open<'_>,
        segment: &Segment,
        tau: f64,
        (event, whole): (Candidate, f64),
    ) -> Result<(), TimeHistoryError> {
        let Open {
            constants,
            flight,
            engagement,
        } = &mut *open;
        let n = self.dynamics.layout.dofs;
        let [q, p, ..] = &engagement.pair.start.motion;
        flight.land_from(constants, (q, p), &mut self.state[..2 * n]);
        let smooth = self.process(segment, tau, event, whole)?;
        let engagement = &mut open.engagement;
        engagement.lengths.restart(smooth);
        engagement.listed = false;
        engagement.derived = false;
        open.flight.acceleration_known = false;
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
            flight,
            engagement,
        } = open;
        let layout = self.dynamics.layout;
        let [q, p, ..] = &engagement.pair.start.motion;
        self.statistics.steps += 1;
        if step > SIMULTANEOUS {
            self.at_once.fill(0);
            self.mute.fill(Mute::No);
            self.stalled = 0;
        }
        let rows = &engagement.rows.levels;
        for (l, penetration) in flight.penetration.iter_mut().enumerate() {
            *penetration = rows[l].dot(q) - self.contacts.width(l);
        }
        for touch in &engagement.touches {
            let l = touch.level;
            let motion = (flight.penetration[l], rows[l].dot(p));
            self.contacts.commit_level(self.system, l, motion);
        }
        if !engagement.affine {
            refresh(&self.contacts, &mut engagement.touches);
        }
        // The modes hold kinetic and strain energy.
        let mut energies = Lane::ZERO;
        for (c, m) in constants.modes.iter().enumerate() {
            for l in 0..WIDTH {
                let x = m.circular_frequency[l] * q[c][l];
                energies[l] += 0.5 * (p[c][l] * p[c][l] + x * x);
            }
        }
        let worked: f64 = (0..layout.levels).map(|l| self.state[layout.work(l)]).sum();
        let input = self.state[layout.input()];
        let residual = total(&energies) + self.state[layout.viscous()] + worked - input;
        if !residual.is_finite() {
            return Err(self.not_finite(time));
        }
        self.ledger.largest_input = self.ledger.largest_input.max(input.abs());
        self.residual = residual;
        self.largest_residual = self.largest_residual.max(residual.abs());
        Ok(())
    }

    /// A step by the series, cut at its first event; `None` where a series of powers does
    /// not reach far.
    fn by_series(
        &mut self,
        open: &mut Open<'_>,
        segment: &Segment,
        tau: f64,
        longest: f64,
    ) -> Option<(f64, Option<(Candidate, f64)>)> {
        let Open {
            constants,
            flight,
            engagement: e,
        } = open;
        let rate = e.series.rate();
        let rate = (constants.fastest * constants.fastest + rate * rate).sqrt();
        let parts = (longest / Series::longest(rate)).ceil().max(1.0);
        let whole = longest / parts;
        let start = segment.start + tau;
        let from = SeriesStep {
            displacement: &e.pair.start.motion[0],
            velocity: &e.pair.start.motion[1],
            ground: (segment.ground(tau), segment.slope),
            step: whole,
            rate,
            terms: if e.affine { 0 } else { e.terms },
        };
        e.series.expand(constants, &e.rows, &e.touches, &from);
        self.series_terms += e.series.terms() as u64;
        if !flight.acceleration_known {
            e.series
                .start_acceleration(&constants.modes, &mut e.absolute);
            begin_acceleration(constants, &e.absolute, &mut flight.tracks(), start);
        }
        let mut whole = whole;
        if !e.affine {
            let reach = e.series.reach(SERIES_SIZE * e.tolerance);
            if reach < FAR_ENOUGH {
                return None;
            }
            if reach < 1.0 {
                e.series.shorten(reach);
                whole *= reach;
            }
        }
        let modes = &constants.modes;
        let [q, p, ..] = &mut e.pair.end.motion;
        e.series.end(modes, q, p, &mut e.absolute);
        let mute = &self.mute;
        let event = in_series(
            (self.system, &self.contacts, &e.rows),
            (&e.series, &e.touches),
            (q, &flight.penetration),
            &mut self.finder.candidates,
            |level, theta| is_muted(mute[level], theta),
        );
        let mut step = whole;
        if let Some(event) = event {
            if event.theta * whole <= EVENT_TOLERANCE {
                return Some((0.0, Some((event, whole))));
            }
            if event.theta < 1.0 {
                step = event.theta * whole;
                e.series.shorten(event.theta);
                e.series.end(modes, q, p, &mut e.absolute);
            }
        }
        let works = e.series.works(modes, q);
        let layout = self.dynamics.layout;
        self.state[layout.input()] += works.input;
        self.state[layout.viscous()] += works.viscous;
        note_floors_of_series(
            constants,
            &e.series,
            (q, &e.absolute),
            &mut flight.tracks(),
            start,
        );
        flight.acceleration_known = true;
        for touch in &e.series.touches {
            let (work, impulse) = e.series.contact_work(touch);
            self.state[layout.work(touch.level)] += work;
            self.state[layout.impulse(touch.level)] += impulse;
            let peaks = [
                (&touch.delta, &mut self.peaks.penetration[touch.level]),
                (&touch.force, &mut self.peaks.force[touch.level]),
            ];
            for (terms, peak) in peaks {
                if let Some((theta, top)) = e.series.maximum(terms, peak.value) {
                    peak.raise(top, start + theta * step);
                }
            }
        }
        std::mem::swap(&mut e.pair.start, &mut e.pair.end);
        e.derived = false;
        if !e.affine {
            e.lengths.accept_series(step);
        }
        Some((step, event.map(|event| (event, whole))))
    }

    /// A step by the pair, cut at its first event.
    fn by_pair(
        &mut self,
        open: &mut Open<'_>,
        segment: &Segment,
        tau: f64,
        longest: f64,
    ) -> Result<(f64, Option<(Candidate, f64)>), TimeHistoryError> {
        let Open {
            constants,
            flight,
            engagement: e,
        } = open;
        let start = segment.start + tau;
        let ground = (segment.ground(tau), segment.slope);
        let scene = Scene {
            constants,
            rows: &e.rows,
            system: self.system,
            touches: &e.touches,
            ground,
            tolerance: e.tolerance,
        };
        if !e.derived {
            e.pair
                .start
                .derive(constants, &e.rows, (self.system, &e.touches), ground);
            e.derived = true;
        }
        if !flight.acceleration_known {
            for (c, m) in constants.modes.iter().enumerate() {
                for l in 0..WIDTH {
                    e.absolute[c][l] = e.pair.start.motion[2][c][l] + m.participation[l] * ground.0;
                }
            }
            begin_acceleration(constants, &e.absolute, &mut flight.tracks(), start);
            flight.acceleration_known = true;
        }
        let mut tried = e.lengths.propose(&scene, &e.pair.start, longest);
        let (mut clock, mut error);
        loop {
            clock = Clock::new(tried.pace, tried.since, tried.length);
            error = e.pair.step(&scene, &clock);
            if error <= 1.0 {
                break;
            }
            self.statistics.rejected += 1;
            tried = e.lengths.reject(&tried, error);
            // A NaN must end here too.
            if !(tried.length >= SHORTEST_STEP) {
                return Err(TimeHistoryError::StepTooSmall {
                    time: start,
                    step: tried.length,
                    method: self.method.information().title,
                    place: self.places_in_touch(),
                });
            }
        }
        let whole = tried.length;
        let end = (segment.ground(tau + whole), segment.slope);
        e.pair
            .end
            .derive(constants, &e.rows, (self.system, &e.touches), end);
        let mute = &self.mute;
        let candidates = &mut self.finder.candidates;
        let span = Span {
            start: &e.pair.start,
            end: &e.pair.end,
            clock: &clock,
        };
        let found = in_span(
            &scene,
            &self.contacts,
            &span,
            &flight.penetration,
            candidates,
            |level, theta| is_muted(mute[level], theta),
        );
        for candidate in candidates.iter_mut() {
            candidate.theta = clock.offset(candidate.theta) / whole;
        }
        let found = match found {
            Some(found) => {
                let time = clock.offset(found.theta);
                let theta = time / whole;
                Some((Candidate { theta, ..found }, time))
            }
            None => {
                let limit = (NEAR * whole).min(longest - whole);
                let soon = soon_after(&scene, &span, limit);
                let soon = soon.filter(|(event, _)| mute[event.level] == Mute::No);
                candidates.extend(soon.map(|(event, _)| event));
                soon.map(|(event, time)| (event, whole + time))
            }
        };
        let (mut step, mut event) = (whole, None);
        if let Some((mut found, time)) = found {
            if time <= EVENT_TOLERANCE {
                return Ok((0.0, Some((found, whole))));
            }
            let (place, contacts) = ((found.level, found.kind), &self.contacts);
            let (reached, trials) = e.pair.reach(&scene, contacts, place, &mut clock, time);
            self.statistics.location_steps += trials;
            for candidate in &mut self.finder.candidates {
                if candidate.level == found.level {
                    candidate.theta = reached / whole;
                }
            }
            found.theta = reached / whole;
            event = Some((found, whole));
            step = reached;
        }
        e.lengths.accept(&tried, step, error);
        let layout = self.dynamics.layout;
        self.state[layout.input()] += e.pair.works.input;
        self.state[layout.viscous()] += e.pair.works.viscous;
        let span = Span {
            start: &e.pair.start,
            end: &e.pair.end,
            clock: &clock,
        };
        note_floors_of_span(&scene, &span, &mut e.rates, &mut flight.tracks(), start);
        for (k, (touch, works)) in e.touches.iter().zip(&e.pair.contact_works).enumerate() {
            let l = touch.level;
            self.state[layout.work(l)] += works.0;
            self.state[layout.impulse(l)] += works.1;
            let peaks = (&mut self.peaks.penetration[l], &mut self.peaks.force[l]);
            note_contact(&scene, &span, k, peaks, start);
        }
        std::mem::swap(&mut e.pair.start, &mut e.pair.end);
        Ok((step, event))
    }
}

/// Terms of a series of powers: more are worth while where more digits are asked for.
fn series_terms(tolerance: f64) -> usize {
    (10.0 - tolerance.log10()).clamp(14.0, 22.0) as usize
}

/// Whether an event of a level does not count.
fn is_muted(mute: Mute, theta: f64) -> bool {
    match mute {
        Mute::No => false,
        Mute::Start => theta == 0.0,
        Mute::Step => true,
    }
}

/// Takes the peaks of one closed level.
fn note_contact(
    scene: &Scene<'_>,
    span: &Span<'_>,
    k: usize,
    (penetration, force): (&mut Peak, &mut Peak),
    start: f64,
) {
    let touch = &scene.touches[k];
    let level = &scene.system.levels()[touch.level];
    let (a, b) = span.touch(k);
    let (delta, rate) = (span.displacement(a, b), span.velocity(a, b));
    let end = start + span.clock.offset(1.0);
    penetration.raise(b[0], end);
    if a[1] * b[1] <= 0.0
        && let Some((theta, top)) = maximum_above(&delta, penetration.value)
    {
        penetration.raise(top, start + span.clock.offset(theta));
    }
    let (first, last) = (&span.start.touches[k], &span.end.touches[k]);
    force.raise(first.force, start);
    force.raise(last.force, end);
    if first.force_rate * last.force_rate > 0.0 {
        return;
    }
    let at = |theta: f64| {
        let (delta, rate) = (value(&delta, theta), value(&rate, theta));
        touch.contact.force(level, delta, rate).value
    };
    let nodes = fit_nodes();
    let mut samples = nodes.map(at);
    samples[0] = span.start.touches[k].force;
    samples[nodes.len() - 1] = span.end.touches[k].force;
    let fitted = fit(&samples);
    if bound(&fitted) <= force.value * BELOW_PEAK {
        return;
    }
    for (theta, sample) in nodes.iter().zip(samples) {
        force.raise(sample, start + span.clock.offset(*theta));
    }
    if let Some((theta, _)) = maximum_above(&fitted, force.value * BELOW_PEAK) {
        force.raise(at(theta), start + span.clock.offset(theta));
    }
}
