//! Steps in the coordinates of the modes: by the series, or by the pair.

use super::contact_episode::Open;
use super::{Driver, EVENT_TOLERANCE, Mute, SHORTEST_STEP};
use crate::contact_episode::{
    Clock, EndOfStep, NEAR, Pair, Places, Proposal, Scene, Series, SeriesEnd, SeriesStep, Span,
    StepLength, Works, begin_acceleration, in_series, in_span, note_floors_of_series,
    note_floors_of_span, note_sections_of_series, note_sections_of_span, soon_after,
};
use crate::contact_free::ContactFreePhase;
use crate::dense_output::{ModalStep, Motion};
use crate::error::TimeHistoryError;
use crate::events::Candidate;
use crate::observers::Observers;
use crate::peak::Peak;
use crate::polynomial::{COEFFICIENTS, derivative, fit, maximum_above, value, values_at_nodes};
use crate::system::Segment;
use crate::system::modes::{ContactFree, Lane, add, closings, scale};

/// Part of the present peak below which a fitted maximum is not looked at closer.
const BELOW_PEAK: f64 = 1.0 - 1.0e-3;
/// Greatest part by which what is left of the rate of change may raise a maximum that was looked
/// at: as much errs the fit.
const CORRECTION: f64 = 1.0e-3;

/// Part of the step tried from which on such a series is worth its while.
const FAR_ENOUGH: f64 = 0.3;

/// Length of a step (s), and the event that ended it with the length that it was cut from.
pub(super) type Taken = (f64, Option<(Candidate, f64)>);

/// A trial of the pair that is accurate.
struct Trial {
    tried: Proposal,
    clock: Clock,
    error: f64,
}

impl Driver<'_> {
    /// A step by the series, cut at its first event, into `taken`; false where a series of powers
    /// does not reach far.
    pub(super) fn by_series(
        &mut self,
        open: &mut Open<'_>,
        (segment, tau): (&Segment, f64),
        (longest, taken): (f64, &mut Taken),
        observers: &mut Observers<'_, '_>,
    ) -> Result<bool, TimeHistoryError> {
        let Open {
            constants,
            phase,
            contact_episode: e,
        } = open;
        let constants: &ContactFree = constants;
        let most = e.series.longest();
        let whole = if longest <= most {
            longest
        } else {
            longest / (longest / most).ceil()
        };
        let start = segment.start + tau;
        let from = SeriesStep {
            displacement: &e.pair.start.motion[0],
            velocity: &e.pair.start.motion[1],
            ground: (segment.acceleration_at(tau), segment.slope),
            step: whole,
            rate: e.series.rate(),
            terms: if e.affine { 0 } else { e.terms },
            negligible: if e.affine {
                Series::ROUND_OFF
            } else {
                e.negligible
            },
        };
        e.series.expand(constants, &e.rows, &e.touches, &from);
        self.series_terms += e.series.terms() as u64;
        if !phase.acceleration_known {
            e.series
                .start_acceleration(&constants.modes, &mut e.absolute);
            begin_acceleration(constants, &e.absolute, &mut phase.tracks(), start);
        }
        let mut whole = whole;
        if !e.affine {
            let reach = e.series.reach(e.last_terms);
            if reach < FAR_ENOUGH {
                e.lengths.refuse_series();
                return Ok(false);
            }
            if reach < 1.0 {
                e.series.shorten(reach);
                whole *= reach;
            }
        }
        let places = Places {
            constants,
            rows: &e.rows,
            levels: &e.levels,
        };
        let [displacement, velocity, ..] = &mut e.pair.end.motion;
        let mut end = EndOfStep {
            displacement,
            velocity,
            absolute: &mut e.absolute,
            closings: &mut e.closings,
        };
        e.series.finish(places, &mut end);
        let (mute, at_once) = (&self.mute, &self.at_once);
        let event = in_series(
            (self.system, &self.contacts, &e.rows),
            &e.levels,
            (&e.series, &e.touches),
            (end.closings, e.series.over, &phase.penetration),
            &mut self.finder.candidates,
            |level, theta| mute[level].hides(theta * whole, at_once[level]),
        );
        let mut step = whole;
        if let Some(event) = event {
            if event.theta * whole <= EVENT_TOLERANCE {
                *taken = (0.0, Some((event, whole)));
                return Ok(true);
            }
            if event.theta < 1.0 {
                step = event.theta * whole;
                e.series.cut(event.theta, places, &mut end);
            }
        }
        let works = e.series.account(&constants.modes);
        if !observers.is_empty() {
            let [displacement, velocity, ..] = &e.pair.end.motion;
            let end = SeriesEnd {
                displacement,
                velocity,
                absolute: &e.absolute,
                works,
            };
            observers.show(&ModalStep {
                system: self.system,
                constants,
                rows: &e.rows,
                contacts: &self.contacts,
                state: &self.state,
                start,
                length: step,
                motion: Motion::Series(&e.series, end),
            })?;
        }
        self.note_series(open, start, works);
        let e = &mut open.contact_episode;
        std::mem::swap(&mut e.pair.start, &mut e.pair.end);
        for (touch, series) in e.touches.iter_mut().zip(&e.series.touches) {
            touch.motion = (e.closings[touch.level] - touch.width, series.rate_end);
        }
        e.derived = false;
        if !e.affine {
            e.lengths.accept_series(step);
        }
        *taken = (step, event.map(|event| (event, whole)));
        Ok(true)
    }

    /// Takes works and peaks of the series as it now is, from its start (s) on.
    fn note_series(&mut self, open: &mut Open<'_>, start: f64, works: Works) {
        let Open {
            constants,
            phase,
            contact_episode: e,
        } = open;
        let constants: &ContactFree = constants;
        let layout = self.dynamics.layout;
        self.state[layout.input()] += works.input;
        self.state[layout.viscous()] += works.viscous;
        note_floors_of_series(
            constants,
            &e.series,
            (&e.pair.end.motion[0], &e.absolute),
            &mut phase.tracks(),
            start,
        );
        let sections = &constants.rows.sections;
        let end = &e.pair.end.motion[0];
        note_sections_of_series(sections, &e.series, end, phase.sections(), start);
        phase.acceleration_known = true;
        for touch in &e.series.touches {
            let (work, impulse) = touch.works;
            self.state[layout.work(touch.level)] += work;
            self.state[layout.impulse(touch.level)] += impulse;
            let peaks = [
                (
                    (&touch.delta, touch.delta_end),
                    &mut self.peaks.penetration[touch.level],
                ),
                (
                    (&touch.force, touch.force_end),
                    &mut self.peaks.force[touch.level],
                ),
            ];
            for ((terms, ends), peak) in peaks {
                if let Some((theta, top)) = e.series.maximum(terms, ends, peak.value) {
                    peak.raise(top, start + theta * e.series.step());
                }
            }
        }
    }

    /// A step by the pair, cut at its first event, into `taken`.
    pub(super) fn by_pair(
        &mut self,
        open: &mut Open<'_>,
        (segment, tau): (&Segment, f64),
        (longest, taken): (f64, &mut Taken),
        observers: &mut Observers<'_, '_>,
    ) -> Result<(), TimeHistoryError> {
        let Open {
            constants,
            phase,
            contact_episode: e,
        } = open;
        let constants: &ContactFree = constants;
        let start = segment.start + tau;
        let scene = Scene {
            constants,
            rows: &e.rows,
            system: self.system,
            touches: &e.touches,
            ground: (segment.acceleration_at(tau), segment.slope),
            tolerance: e.tolerance,
        };
        if !e.derived {
            e.pair.derive_start(&scene);
            e.derived = true;
        }
        begin(&scene, &e.pair, phase, &mut e.absolute, start);
        let mut trial = self.accurate(&scene, &mut e.pair, &mut e.lengths, (start, longest))?;
        let whole = trial.tried.length;
        e.pair.derive_end(&scene, whole);
        let mut step = whole;
        let event = self.event_of((&scene, &e.levels), &e.pair, phase, &trial.clock, longest);
        if let Some((found, time)) = &event {
            if *time <= EVENT_TOLERANCE {
                *taken = (0.0, Some((*found, whole)));
                return Ok(());
            }
            let (place, contacts) = ((found.level, found.kind), &self.contacts);
            let clock = &mut trial.clock;
            // One that was found inside does not lie beyond.
            let limit = if *time > whole { longest } else { whole };
            let expected = (*time, limit);
            let (reached, trials) = e.pair.reach(&scene, contacts, place, clock, expected);
            self.statistics.location_steps += trials;
            step = reached;
        }
        let event = event.map(|(found, _)| {
            let theta = step / whole;
            for candidate in &mut self.finder.candidates {
                if candidate.level == found.level {
                    candidate.theta = theta;
                }
            }
            (Candidate { theta, ..found }, whole)
        });
        e.lengths.accept(&trial.tried, step, trial.error);
        let span = Span::new([&e.pair.start, &e.pair.end], &trial.clock);
        if !observers.is_empty() {
            observers.show(&ModalStep {
                system: self.system,
                constants,
                rows: &e.rows,
                contacts: &self.contacts,
                state: &self.state,
                start,
                length: step,
                motion: Motion::Pair(&scene, &span, &e.pair),
            })?;
        }
        note_floors_of_span(&scene, &span, &mut e.rates, &mut phase.tracks(), start);
        note_sections_of_span(&constants.rows.sections, &span, phase.sections(), start);
        self.note_contacts(&scene, &trial.clock, &mut e.pair, start);
        closings(&e.rows, &e.levels, &e.pair.end.motion[0], &mut e.closings);
        for (touch, end) in e.touches.iter_mut().zip(&e.pair.end.touches) {
            touch.motion = (end.motion[0], end.motion[1]);
        }
        std::mem::swap(&mut e.pair.start, &mut e.pair.end);
        *taken = (step, event);
        Ok(())
    }

    /// Tries steps of the pair, ever shorter, until one is accurate.
    fn accurate(
        &mut self,
        scene: &Scene<'_>,
        pair: &mut Pair,
        lengths: &mut StepLength,
        (start, longest): (f64, f64),
    ) -> Result<Trial, TimeHistoryError> {
        let mut tried = lengths.propose(scene, &pair.start, longest);
        loop {
            let clock = Clock::new(tried.pace, tried.since, tried.length);
            let error = pair.step(scene, &clock);
            if error <= 1.0 {
                return Ok(Trial {
                    tried,
                    clock,
                    error,
                });
            }
            self.statistics.rejected += 1;
            tried = lengths.reject(&tried, error);
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
    }

    /// The first event of the step that was tried, with its time (s) after the start.
    fn event_of(
        &mut self,
        (scene, levels): (&Scene<'_>, &[usize]),
        pair: &Pair,
        phase: &ContactFreePhase,
        clock: &Clock,
        longest: f64,
    ) -> Option<(Candidate, f64)> {
        let (mute, at_once, whole) = (&self.mute, &self.at_once, clock.offset(1.0));
        let candidates = &mut self.finder.candidates;
        let span = Span::new([&pair.start, &pair.end], clock);
        let found = in_span(
            scene,
            levels,
            &self.contacts,
            &span,
            &phase.penetration,
            candidates,
            |level, theta| mute[level].hides(clock.offset(theta), at_once[level]),
        );
        for candidate in candidates.iter_mut() {
            candidate.theta = clock.offset(candidate.theta) / whole;
        }
        if let Some(found) = found {
            let time = clock.offset(found.theta);
            let theta = time / whole;
            return Some((Candidate { theta, ..found }, time));
        }
        let limit = (NEAR * whole).min(longest - whole);
        let soon = soon_after(scene, &span, limit);
        let (event, time) = soon.filter(|(event, _)| mute[event.level] == Mute::No)?;
        candidates.push(event);
        Some((event, whole + time))
    }

    /// Takes works and peaks of the closed levels.
    fn note_contacts(&mut self, scene: &Scene<'_>, clock: &Clock, pair: &mut Pair, start: f64) {
        let layout = self.dynamics.layout;
        self.state[layout.input()] += pair.works.input;
        self.state[layout.viscous()] += pair.works.viscous;
        for (k, touch) in scene.touches.iter().enumerate() {
            let (l, works) = (touch.level, pair.contact_works[k]);
            self.state[layout.work(l)] += works.0;
            self.state[layout.impulse(l)] += works.1;
            let peaks = (&mut self.peaks.penetration[l], &mut self.peaks.force[l]);
            note_contact(scene, (pair, clock), k, peaks, start);
        }
    }
}

/// Takes the floors' accelerations at the start of a step, where they may have jumped.
fn begin(
    scene: &Scene<'_>,
    pair: &Pair,
    phase: &mut ContactFreePhase,
    absolute: &mut [Lane],
    start: f64,
) {
    if phase.acceleration_known {
        return;
    }
    let modes = pair.start.motion[2].iter().zip(&scene.constants.modes);
    for ((a, m), absolute) in modes.zip(absolute.iter_mut()) {
        *absolute = add(*a, scale(scene.ground.0, m.participation));
    }
    begin_acceleration(scene.constants, absolute, &mut phase.tracks(), start);
    phase.acceleration_known = true;
}

/// Takes the peaks of one closed level.
fn note_contact(
    scene: &Scene<'_>,
    (pair, clock): (&mut Pair, &Clock),
    k: usize,
    (penetration, force): (&mut Peak, &mut Peak),
    start: f64,
) {
    let touch = &scene.touches[k];
    let level = &scene.system.levels()[touch.level];
    let span = Span::new([&pair.start, &pair.end], clock);
    let (a, b) = span.touch(k);
    let (first, last) = (pair.start.touches[k], pair.end.touches[k]);
    let end = start + clock.offset(1.0);
    penetration.raise(b[0], end);
    force.raise(first.force, start);
    force.raise(last.force, end);
    let (turns, forced) = (
        a[1] * b[1] <= 0.0,
        first.force_rate * last.force_rate <= 0.0,
    );
    if !turns && !forced {
        return;
    }
    let delta = span.displacement(a, b);
    if turns && let Some((theta, top)) = maximum_above(&delta, penetration.value) {
        penetration.raise(top, start + clock.offset(theta));
    }
    if !forced {
        return;
    }
    let rate = span.velocity(a, b);
    let (deltas, rates) = (values_at_nodes(&delta), values_at_nodes(&rate));
    let mut samples = [first.force; COEFFICIENTS];
    for node in 1..COEFFICIENTS - 1 {
        let law = touch.contact.force(level, deltas[node], rates[node]);
        samples[node] = law.value;
    }
    samples[COEFFICIENTS - 1] = last.force;
    let fitted = fit(&samples);
    let Some((theta, _)) = maximum_above(&fitted, force.value * BELOW_PEAK) else {
        return;
    };
    if theta <= 0.0 || theta >= 1.0 {
        return;
    }
    let now = pair.inside(scene, clock, (theta, k));
    // Where the rate of change is zero: the fit tells how it goes on from here.
    let bend = value(&derivative(&derivative(&fitted)), theta);
    let by_time = clock.span() * clock.rate(theta);
    let change = now.force_rate * by_time;
    let left = (-0.5 * change * change / bend).clamp(0.0, CORRECTION * now.force.abs());
    let left = if bend < 0.0 { left } else { 0.0 };
    let time = start + clock.offset((theta - change / bend).clamp(0.0, 1.0));
    force.raise(
        now.force + left,
        if left > 0.0 {
            time
        } else {
            start + clock.offset(theta)
        },
    );
}
