//! Rows of buildings in contact, part by part.
//!
//! In a long row a few buildings touch while the others move freely, and neighbours that touch
//! here have nothing to do with those that touch there. A sample is therefore taken part by
//! part: buildings that are in contact, or could come into it, form a part with their neighbours
//! in contact, whose steps no event of another part cuts; all others take the exact step.
//! That parts and free buildings did not meet is checked afterwards, by bounds of the
//! displacements over the whole sample. If they could have, the sample is taken again with
//! these buildings in one part.

use std::borrow::Cow;
use std::ops::Range;

use super::contact_episode::{ContactEpisode, Open, Sample};
use super::{Driver, Mute};
use crate::contact::Mode;
use crate::contact_episode::StepLength;
use crate::contact_free::{ContactFreePhase, FreeSample, SampleRange};
use crate::dense_output::{ModalStep, Motion};
use crate::error::TimeHistoryError;
use crate::impacts::{LevelMark, LogMark};
use crate::observers::Observers;
use crate::outcome::{Ledger, Statistics};
use crate::peak::Peak;
use crate::system::modes::{ContactFree, Track, WIDTH, put_part, stored, take_part};
use crate::system::{Segment, System};

/// Buildings from which on a row has parts.
const ROW: usize = 3;
/// Lanes of modes from which on a row is taken by parts where contacts are affine, and where
/// not: what is smaller is faster in one piece.
const LANES: [usize; 2] = [5, 4];
/// Buildings of a part at most: what is larger is taken with the whole row.
const LARGEST: usize = 3;
/// Samples that are taken whole after one that was a single part.
const PAUSE: usize = 4;

/// What one level goes back to if a sample is taken again.
struct Mark {
    level: usize,
    contact: (Mode, f64),
    log: LevelMark,
    peaks: [Peak; 2],
    touches: usize,
    quiet: f64,
}

/// Marks of the levels that change in a sample that may be taken again: of those that are
/// closed at its start, and of others before their first event.
#[derive(Default)]
pub(super) struct Marks {
    active: bool,
    marks: Vec<Mark>,
    marked: Vec<bool>,
}

/// The same of the whole run.
#[derive(Default)]
struct RunMark {
    log: LogMark,
    state: Vec<f64>,
    residuals: [f64; 2],
    ledger: Ledger,
    statistics: Statistics,
    at_once: Vec<usize>,
    mute: Vec<Mute>,
    stalled: usize,
    series_terms: u64,
}

/// What observers see is taken back.
struct Shown {
    tracks: [Track; 3],
    penetration: Vec<f64>,
}

/// The parts of a row, with their work space.
pub(super) struct Parts {
    buildings: usize,
    /// First and last building that every level lies between.
    between: Vec<[usize; 2]>,
    /// All parts, by first building and number of buildings, once they are made.
    known: Vec<Option<Box<Open<'static>>>>,
    made: bool,
    /// Whether a building is joined to the next one.
    joined: Vec<bool>,
    /// Whether a building belongs to a part, and to which.
    touching: Vec<bool>,
    part_of: Vec<usize>,
    /// Buildings of the present parts.
    ranges: Vec<Range<usize>>,
    /// Lengths of steps that were last good for each building.
    lengths: Vec<StepLength>,
    /// Whether the floors' accelerations at the present time are known.
    acceleration_known: Vec<bool>,
    free: FreeSample,
    /// Whether the last sample was taken whole, and samples until the next try.
    whole: bool,
    pause: usize,
    run: RunMark,
    shown: Shown,
    /// Evaluations of the pair in parts.
    pub evaluations: u64,
}

impl Parts {
    /// `None` for what is no row.
    pub(super) fn new(system: &System, constants: &ContactFree, tolerance: f64) -> Option<Self> {
        let buildings = system.buildings().len();
        let lanes = constants.modes.len();
        if buildings < ROW || lanes < LANES[1] || !system.sections().is_empty() {
            return None;
        }
        let building = |floor: Option<usize>| {
            floor.map(|i| system.offsets().partition_point(|first| *first <= i) - 1)
        };
        let between = system.levels().iter().map(|level| {
            let ends = [building(level.left), building(level.right)];
            let [a, b] = [ends[0].or(ends[1]), ends[1].or(ends[0])].map(Option::unwrap_or_default);
            [a.min(b), a.max(b)]
        });
        let track = || Track::new(system.degrees_of_freedom());
        Some(Self {
            buildings,
            between: between.collect(),
            known: (0..buildings * LARGEST).map(|_| None).collect(),
            made: false,
            joined: vec![false; buildings],
            touching: vec![false; buildings],
            part_of: vec![0; buildings],
            ranges: Vec::with_capacity(buildings),
            lengths: vec![StepLength::new(tolerance); buildings],
            acceleration_known: vec![false; buildings],
            free: FreeSample::new(constants),
            whole: true,
            pause: 0,
            run: RunMark::default(),
            shown: Shown {
                tracks: [track(), track(), track()],
                penetration: vec![0.0; system.levels().len()],
            },
            evaluations: 0,
        })
    }

    /// Puts all buildings that a level lies between into one part.
    fn join(&mut self, level: usize) {
        let [first, last] = self.between[level];
        self.joined[first..last].fill(true);
        self.touching[first..=last].fill(true);
    }

    /// Makes parts of what is joined. Returns false if one of them is too large.
    fn group(&mut self) -> bool {
        self.ranges.clear();
        let mut first = 0;
        while first < self.buildings {
            let more = self.joined[first..].iter().take_while(|joined| **joined);
            let range = first..first + 1 + more.count();
            first = range.end;
            if !self.touching[range.start] {
                continue;
            }
            if range.len() > LARGEST || range.len() == self.buildings {
                return false;
            }
            self.part_of[range.clone()].fill(self.ranges.len());
            self.ranges.push(range);
        }
        true
    }

    /// Whether affine contacts cost less by parts, in microseconds as measured: a step of so many
    /// lanes, and 0.7 events a part. Steps of other laws are so many more that they always do.
    fn are_worth(&self, system: &System, lanes: usize) -> bool {
        let step = |lanes: usize| 1.0 + 0.6 * lanes as f64;
        let whole = (1.0 + 0.7 * self.ranges.len() as f64) * lanes as f64;
        let parts = self.ranges.iter().map(|range| {
            let dofs = end_of(system, range) - system.offsets()[range.start];
            1.7 * step(dofs.div_ceil(WIDTH)) + 1.5
        });
        let by_parts = parts.sum::<f64>() + 1.5 + 0.1 * lanes as f64;
        1.25 * by_parts < whole
    }

    /// Whether a level lies within a part.
    fn is_inside(&self, level: usize) -> bool {
        let [a, b] = self.between[level];
        self.touching[a] && self.touching[b] && self.part_of[a] == self.part_of[b]
    }

    fn place(range: &Range<usize>) -> usize {
        range.start * LARGEST + range.len() - 1
    }

    /// Makes all parts that there can be, at the first contact: nothing is allocated later.
    fn make_all(&mut self, open: &Open<'_>, system: &System) {
        self.made = true;
        for count in 1..=LARGEST.min(self.buildings - 1) {
            for first in 0..=self.buildings - count {
                self.make(open, system, first..first + count);
            }
        }
    }

    /// Makes a part, unless nothing can touch in it.
    fn make(&mut self, open: &Open<'_>, system: &System, range: Range<usize>) {
        let inside = |l: &usize| self.between[*l].iter().all(|b| range.contains(b));
        let levels: Vec<_> = (0..self.between.len()).filter(inside).collect();
        if levels.is_empty() {
            return;
        }
        let dofs = system.offsets()[range.start]..end_of(system, &range);
        let constants = open.constants.part(range.clone(), dofs.clone());
        let whole = &open.contact_episode;
        let rows = whole.rows.part(&levels, dofs.start, dofs.len());
        let place = (dofs.clone(), constants.modes.len(), levels);
        self.known[Self::place(&range)] = Some(Box::new(Open {
            phase: ContactFreePhase::of_part(dofs.len(), self.between.len()),
            contact_episode: ContactEpisode::new(rows, place, whole.tolerance),
            constants: Cow::Owned(constants),
        }));
    }

    /// Least and greatest displacement of a floor of this building over the sample (m).
    fn extent(&self, phase: &ContactFreePhase, system: &System, floor: usize) -> [f64; 2] {
        let building = system.offsets().partition_point(|first| *first <= floor) - 1;
        if !self.touching[building] {
            return phase.extent_ahead(floor);
        }
        match &self.known[Self::place(&self.ranges[self.part_of[building]])] {
            Some(part) => part
                .phase
                .extent_of(floor - part.contact_episode.dofs.start),
            None => [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// Joins the buildings that could have met outside of their parts. Returns whether any
    /// could.
    fn join_what_met(
        &mut self,
        phase: &ContactFreePhase,
        system: &System,
        widths: impl Fn(usize) -> f64,
    ) -> bool {
        let mut met = false;
        for (l, level) in system.levels().iter().enumerate() {
            let [a, b] = self.between[l];
            if self.is_inside(l) || !(self.touching[a] || self.touching[b]) {
                continue;
            }
            let extent =
                |floor: Option<usize>| floor.map_or([0.0; 2], |i| self.extent(phase, system, i));
            let ([_, left], [right, _]) = (extent(level.left), extent(level.right));
            // A NaN is no proof.
            if !(left - right - widths(l) <= 0.0) {
                self.joined[a..b].fill(true);
                met = true;
            }
        }
        if met {
            for l in 0..self.between.len() {
                let [a, b] = self.between[l];
                if self.joined[a..b].contains(&true) {
                    self.join(l);
                }
            }
        }
        met
    }
}

/// The degree of freedom after the last one of these buildings.
fn end_of(system: &System, range: &Range<usize>) -> usize {
    let end = system.offsets().get(range.end);
    end.copied().unwrap_or(system.degrees_of_freedom())
}

impl Driver<'_> {
    /// Takes a whole sample part by part, if there are parts.
    pub(super) fn by_parts(
        &mut self,
        open: &mut Open<'_>,
        segment: &Segment,
        duration: f64,
        observers: &mut Observers<'_, '_>,
    ) -> Result<Sample, TimeHistoryError> {
        let Some(mut parts) = self.parts.take() else {
            return Ok(Sample::Whole { shown: false });
        };
        let taken = self.sample_by_parts(&mut parts, open, (segment, duration), observers);
        if let Ok(Sample::Whole { .. }) = taken {
            parts.whole = true;
        }
        self.parts = Some(parts);
        taken
    }

    fn sample_by_parts(
        &mut self,
        parts: &mut Parts,
        open: &mut Open<'_>,
        (segment, duration): (&Segment, f64),
        observers: &mut Observers<'_, '_>,
    ) -> Result<Sample, TimeHistoryError> {
        let (system, sample) = (self.system, segment.interval);
        let ground = system.ground();
        let whole = (duration / ground.time_step * (1.0 + 1.0e-12)).floor() as usize;
        let to = whole.min(ground.samples.len().saturating_sub(1));
        let mut shown = false;
        let closed = self.contacts.closed().iter();
        let contacts = closed.filter_map(|l| Some((*l, self.contacts.contact(*l)?)));
        let (mut affine, mut stuck) = (true, false);
        for (l, contact) in contacts {
            let model = &system.levels()[l].model;
            stuck |= contact.is_stuck();
            affine &= model.is_affine(&contact.collision, contact.phase);
        }
        let few = open.constants.modes.len() < LANES[usize::from(!affine)];
        if parts.pause > 0 || sample >= to || stuck || few {
            parts.pause = parts.pause.saturating_sub(1);
            return Ok(Sample::Whole { shown });
        }
        if !parts.made {
            parts.make_all(open, system);
            self.marks.marks.reserve(system.levels().len());
            self.marks.marked.resize(system.levels().len(), false);
            parts.run.state.clone_from(&self.state);
            parts.run.at_once.clone_from(&self.at_once);
            parts.run.mute.clone_from(&self.mute);
        }
        let [q, p, ..] = &open.contact_episode.pair.start.motion;
        let ends = (ground.samples[sample], ground.samples[sample + 1]);
        let (phase, free) = (&mut open.phase, &mut parts.free);
        phase.look_ahead(&open.constants, (q, p), ends, free);
        if !self.find_parts(parts, &open.phase) {
            parts.pause = PAUSE;
            return Ok(Sample::Whole { shown });
        }
        if affine && !parts.are_worth(system, open.constants.modes.len()) {
            parts.pause = PAUSE;
            return Ok(Sample::Whole { shown });
        }
        if parts.whole {
            parts.lengths.fill(open.contact_episode.lengths);
            parts.acceleration_known.fill(open.phase.acceleration_known);
            parts.whole = false;
        }
        let end = segment.start + segment.length;
        if observers.want_before(end) {
            self.show_whole(parts, open, segment, observers)?;
            shown = true;
            let [q, p, ..] = &open.contact_episode.pair.start.motion;
            let (phase, free) = (&mut open.phase, &mut parts.free);
            phase.look_ahead(&open.constants, (q, p), ends, free);
        }
        loop {
            self.mark(parts);
            // Floors that stick are left to the step of all buildings.
            let done = self.follow_parts(parts, open, segment) && !self.contacts.any_stuck();
            let widths = |l: usize| self.contacts.width(l);
            if done && !parts.join_what_met(&open.phase, system, widths) {
                break;
            }
            self.go_back(parts);
            if !done || !parts.group() {
                return Ok(Sample::Whole { shown });
            }
        }
        self.forget_marks();
        self.join_parts(parts, open, (sample, to));
        if !shown && !observers.is_empty() {
            let now = &open.phase.now;
            observers.show(&ModalStep {
                system,
                constants: &open.constants,
                rows: &open.contact_episode.rows,
                contacts: &self.contacts,
                state: &self.state,
                start: end,
                length: 0.0,
                motion: Motion::Instant([&now.displacement, &now.velocity], ends.1),
            })?;
        }
        Ok(Sample::ByParts)
    }

    /// Finds the parts of the sample. Returns false if there are none but the whole.
    fn find_parts(&self, parts: &mut Parts, phase: &ContactFreePhase) -> bool {
        parts.joined.fill(false);
        parts.touching.fill(false);
        let ahead = |l: usize| {
            let (start, (end, over)) = (phase.penetration[l], phase.closing_ahead(self.system, l));
            (start, end - self.contacts.width(l), over)
        };
        for l in 0..parts.between.len() {
            let (start, end, over) = ahead(l);
            let muted = self.mute[l] != Mute::No;
            let closed = self.contacts.contact(l).is_some();
            if muted || closed || !(start.max(end) + over <= 0.0) {
                parts.join(l);
            }
        }
        // What a contact moves may come nearer than it would without.
        let near = |parts: &Parts, l: usize| {
            let (start, end, over) = ahead(l);
            let touching = parts.between[l].iter().any(|b| parts.touching[*b]);
            touching && !(start.max(end) + over + 2.0 * (end - start).abs() <= 0.0)
        };
        for l in 0..parts.between.len() {
            if !parts.joined[parts.between[l][0]] && near(parts, l) {
                parts.join(l);
            }
        }
        parts.group()
    }

    /// Shows observers the sample as all buildings together take it, and goes back to its
    /// start: parts have no steps in common that could be shown, but for their ends.
    fn show_whole(
        &mut self,
        parts: &mut Parts,
        open: &mut Open<'_>,
        segment: &Segment,
        observers: &mut Observers<'_, '_>,
    ) -> Result<(), TimeHistoryError> {
        self.mark(parts);
        open.phase.copy_tracks(&mut parts.shown.tracks);
        let penetration = &open.phase.penetration;
        parts.shown.penetration.copy_from_slice(penetration);
        let known = open.phase.acceleration_known;
        let e = &mut open.contact_episode;
        let (lengths, evaluations) = (e.lengths, e.pair.evaluations);
        e.listed = false;
        self.begin_episode_in_segment(open, segment, observers)?;
        self.go_back(parts);
        open.phase.put_tracks(&parts.shown.tracks);
        open.phase.acceleration_known = known;
        let penetration = &mut open.phase.penetration;
        penetration.copy_from_slice(&parts.shown.penetration);
        let e = &mut open.contact_episode;
        e.listed = false;
        (e.lengths, e.pair.evaluations) = (lengths, evaluations);
        let [q, p, ..] = &mut e.pair.start.motion;
        q.copy_from_slice(&open.phase.now.displacement);
        p.copy_from_slice(&open.phase.now.velocity);
        Ok(())
    }

    /// Follows all parts to the end of the sample. Returns false if one of them has to be left
    /// to the step of all buildings.
    fn follow_parts(&mut self, parts: &mut Parts, open: &mut Open<'_>, segment: &Segment) -> bool {
        let ranges = std::mem::take(&mut parts.ranges);
        let all = ranges
            .iter()
            .all(|range| self.follow_part(parts, open, range, segment));
        parts.ranges = ranges;
        all
    }

    fn follow_part(
        &mut self,
        parts: &mut Parts,
        open: &mut Open<'_>,
        range: &Range<usize>,
        segment: &Segment,
    ) -> bool {
        let Some(mut part) = parts.known[Parts::place(range)].take() else {
            return false;
        };
        let e = &mut part.contact_episode;
        let (first, count) = (e.dofs.start, e.dofs.len());
        open.phase.hand_to(&mut part.phase, first, count);
        let known = &parts.acceleration_known[range.clone()];
        part.phase.acceleration_known = known.iter().all(|known| *known);
        let [q, p, ..] = &mut e.pair.start.motion;
        take_part(&open.phase.now.displacement, first, q, count);
        take_part(&open.phase.now.velocity, first, p, count);
        for l in &e.levels {
            part.phase.penetration[*l] = open.phase.penetration[*l];
        }
        e.listed = false;
        e.lengths = parts.lengths[range.start];
        let layout = self.dynamics.layout;
        let worked: f64 = e.levels.iter().map(|l| self.state[layout.work(*l)]).sum();
        let viscous = self.state[layout.viscous()];
        let energy = stored(&part.constants, q, p) + viscous + worked;
        e.counted_from = Some(energy - self.state[layout.input()] - self.residual);
        let evaluations = e.pair.evaluations;
        let mut nobody = Observers::new(self.system, &mut [], segment.start);
        let left = self.begin_episode_in_segment(&mut part, segment, &mut nobody);
        let e = &part.contact_episode;
        parts.evaluations += e.pair.evaluations - evaluations;
        for lengths in &mut parts.lengths[range.clone()] {
            *lengths = e.lengths;
        }
        parts.known[Parts::place(range)] = Some(part);
        matches!(left, Ok(None))
    }

    /// Puts all buildings together again at the end of the sample.
    fn join_parts(&mut self, parts: &mut Parts, open: &mut Open<'_>, (sample, to): (usize, usize)) {
        let Open {
            constants,
            phase,
            contact_episode: e,
        } = open;
        let system = self.system;
        let range = SampleRange {
            system,
            contacts: &self.contacts,
            from: sample,
            to,
        };
        let buildings = (&parts.touching[..], &mut parts.acceleration_known[..]);
        let works = phase.move_free(constants, &range, &mut parts.free, buildings);
        let layout = self.dynamics.layout;
        self.state[layout.input()] += works.0;
        self.state[layout.viscous()] += works.1;
        for range in &parts.ranges {
            let Some(part) = &parts.known[Parts::place(range)] else {
                continue;
            };
            let of_part = &part.contact_episode;
            let (first, count) = (of_part.dofs.start, of_part.dofs.len());
            let [q, p, ..] = &of_part.pair.start.motion;
            put_part(q, count, &mut phase.now.displacement, first);
            put_part(p, count, &mut phase.now.velocity, first);
            phase.take_back(&part.phase, first, count);
            for l in &of_part.levels {
                phase.penetration[*l] = part.phase.penetration[*l];
            }
            e.lengths = of_part.lengths;
            parts.acceleration_known[range.clone()].fill(part.phase.acceleration_known);
        }
        phase.acceleration_known = parts.acceleration_known.iter().all(|known| *known);
        for (l, level) in system.levels().iter().enumerate() {
            if !parts.is_inside(l) {
                let closing = level.relative_of(|i| phase.displacement_of(i));
                phase.penetration[l] = closing - self.contacts.width(l);
                self.at_once[l] = 0;
                self.mute[l] = Mute::No;
            }
        }
        let [q, p, ..] = &mut e.pair.start.motion;
        q.copy_from_slice(&phase.now.displacement);
        p.copy_from_slice(&phase.now.velocity);
        e.listed = false;
        e.derived = false;
        self.statistics.steps += 1;
        let levels = 0..layout.levels;
        let worked: f64 = levels.map(|l| self.state[layout.work(l)]).sum();
        let input = self.state[layout.input()];
        let energy = stored(constants, q, p) + self.state[layout.viscous()] + worked;
        self.residual = energy - input;
        self.largest_residual = self.largest_residual.max(self.residual.abs());
        self.ledger.largest_input = self.ledger.largest_input.max(input.abs());
    }

    /// Keeps what the sample may have to go back to.
    fn mark(&mut self, parts: &mut Parts) {
        let marks = &mut self.marks;
        marks.active = true;
        for k in 0..self.contacts.closed().len() {
            self.mark_level(self.contacts.closed()[k]);
        }
        let run = &mut parts.run;
        run.log = self.log.mark();
        run.state.clone_from(&self.state);
        run.residuals = [self.residual, self.largest_residual];
        run.ledger = self.ledger;
        run.statistics = self.statistics;
        run.at_once.clone_from(&self.at_once);
        run.mute.clone_from(&self.mute);
        (run.stalled, run.series_terms) = (self.stalled, self.series_terms);
    }

    /// Keeps what a level may have to go back to, before anything happens to it.
    pub(super) fn mark_level(&mut self, l: usize) {
        if !self.marks.active || self.marks.marked[l] {
            return;
        }
        self.marks.marked[l] = true;
        self.marks.marks.push(Mark {
            level: l,
            contact: self.contacts.mark(l),
            log: self.log.mark_level(l),
            peaks: [self.peaks.force[l], self.peaks.penetration[l]],
            touches: self.touches[l],
            quiet: self.quiet[l],
        });
    }

    /// The sample is taken for good.
    fn forget_marks(&mut self) {
        let Marks {
            active,
            marks,
            marked,
        } = &mut self.marks;
        *active = false;
        for mark in marks.drain(..) {
            marked[mark.level] = false;
        }
    }

    /// Goes back to the mark.
    fn go_back(&mut self, parts: &Parts) {
        let run = &parts.run;
        for mark in &self.marks.marks {
            let l = mark.level;
            self.contacts.go_back(l, mark.contact);
            self.log.go_back_level(&mark.log);
            [self.peaks.force[l], self.peaks.penetration[l]] = mark.peaks;
            (self.touches[l], self.quiet[l]) = (mark.touches, mark.quiet);
        }
        self.forget_marks();
        self.eventful = true;
        self.log.go_back(run.log);
        self.state.copy_from_slice(&run.state);
        [self.residual, self.largest_residual] = run.residuals;
        self.ledger = run.ledger;
        self.statistics = run.statistics;
        self.at_once.copy_from_slice(&run.at_once);
        self.mute.copy_from_slice(&run.mute);
        (self.stalled, self.series_terms) = (run.stalled, run.series_terms);
    }
}
