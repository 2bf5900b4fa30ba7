//! Peaks between samples, put off.
//!
//! While a response grows, every swing has a higher peak than the last, and a look
//! between the samples of each would be wasted. What could be a peak is noted with a
//! rigorous upper bound; what lies below the maximum sample in the end never needs a
//! look.

use std::ops::Range;

use super::block_ends::Suspect;
use super::closer_look::CloserLook;
use super::lane_candidates::{BlockLook, Interval, LaneCandidate};
use super::sample_bound::SampleBound;
use crate::polynomial::absolute_maximum;
use crate::system::System;
use crate::system::modes::{
    BLOCK, ContactFree, Ground, Lane, Modal, Quantity, Track, WIDTH, block,
};

/// A sample in which a floor's function could turn above its peak.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    quantity: Quantity,
    /// Number of the floor, or of the section.
    floor: usize,
    /// Number of the sample at its start.
    sample: usize,
    /// Bound of the function in it.
    upper: f64,
    /// Whether the bound is that of its polynomial between samples.
    by_hull: bool,
    /// Index of the state it is reached from.
    snapshot: usize,
}

/// All of them, with their work space.
#[derive(Debug, Clone)]
pub(super) struct Candidates {
    list: Vec<Candidate>,
    capacity: usize,
    /// Samples of the states that are kept, and the states: displacements of all modes, then
    /// velocities, one after another.
    samples: Vec<usize>,
    states: Vec<Lane>,
    /// States in use: the first ones; and how many there may be before those that nothing is
    /// reached from any more are dropped. Most soon are, and what is small stays in the cache.
    used: usize,
    due: usize,
    scratch: Modal,
    /// State that the scratch was reached from, and the sample that it has come to, with the part
    /// of the modes that is there.
    reached: Option<Reached>,
    bound: SampleBound,
    look: CloserLook,
    /// Value and rate of every candidate of a sample at the end of the last fine step; of tall
    /// buildings.
    ends: Vec<[f64; 2]>,
    blocks: Option<Box<OfBlocks>>,
}

/// How far the scratch has come.
#[derive(Debug, Clone, Copy)]
struct Reached {
    part: usize,
    snapshot: usize,
    sample: usize,
}

/// What is put off of eight floors over a whole block.
#[derive(Debug, Clone)]
struct OfBlocks {
    list: Vec<LaneCandidate>,
    capacity: usize,
    /// Maximum number in one block.
    most: usize,
    look: BlockLook,
    intervals: Vec<Interval>,
    /// Blocks in the order in which they are looked at: how far they could exceed a peak, and
    /// where their candidates begin and end.
    order: Vec<(f64, usize, usize)>,
}

/// Candidates kept at least, and states at most, of which tall buildings keep more: the longer
/// they wait, the fewer are left to be looked at.
const CANDIDATES: usize = 512;
const SNAPSHOTS: usize = 64;
const TALL_SNAPSHOTS: usize = 512;
/// Lanes of floors for every state that tall buildings keep, of all that could be put off.
const LANES_PUT_OFF: f64 = 0.5;

/// Tracks of displacement, drift, acceleration and forces in sections.
pub(super) type AllTracks<'a> = [&'a mut Track; 4];

impl Candidates {
    /// For so many lanes and functions, in blocks by their ends or not, and of `tall` buildings or
    /// not.
    pub(super) fn new((lanes, functions): (usize, usize), by_ends: bool, tall: bool) -> Self {
        let capacity = CANDIDATES.max(2 * BLOCK * functions);
        let snapshots = if tall { TALL_SNAPSHOTS } else { SNAPSHOTS };
        let put_off = |all: usize| all + (LANES_PUT_OFF * (snapshots * all) as f64) as usize;
        Self {
            list: Vec::with_capacity(capacity),
            capacity,
            samples: vec![0; snapshots],
            states: Vec::with_capacity(snapshots * 2 * lanes),
            used: 0,
            due: SNAPSHOTS,
            scratch: Modal::new(lanes),
            reached: None,
            bound: SampleBound::new(lanes),
            look: CloserLook::new(lanes, tall),
            ends: vec![[0.0; 2]; if tall { capacity } else { 0 }],
            blocks: by_ends.then(|| Box::new(OfBlocks::new(lanes, put_off(3 * lanes)))),
        }
    }

    /// For what never notes any.
    pub(super) fn none() -> Self {
        Self {
            list: Vec::new(),
            capacity: 0,
            samples: Vec::new(),
            states: Vec::new(),
            used: 0,
            due: 0,
            scratch: Modal::new(0),
            reached: None,
            bound: SampleBound::new(0),
            look: CloserLook::new(0, false),
            ends: Vec::new(),
            blocks: None,
        }
    }

    /// Makes space for those of one more block.
    pub(super) fn make_room(
        &mut self,
        (constants, system): (&ContactFree, &System),
        tracks: &mut AllTracks<'_>,
        wanted: usize,
    ) {
        let full = |this: &Self| {
            let blocks = this.blocks.as_ref();
            this.list.len() + wanted > this.capacity
                || blocks.is_some_and(|of| of.list.len() + of.most > of.capacity)
        };
        if !full(self) && self.used < self.due {
            return;
        }
        let many = |this: &Self| full(this) || this.used > this.samples.len() / 2;
        self.prune(tracks);
        if many(self) && self.settle_lanes((constants, system), tracks) {
            self.prune(tracks);
        }
        if many(self) {
            self.settle((constants, system), tracks);
        }
        self.due = (2 * self.used).clamp(SNAPSHOTS, self.samples.len());
    }

    /// Number of the state at the start of the block from this sample on.
    fn snapshot(&mut self, (first, now): (usize, &Modal)) -> usize {
        let last = self.used.checked_sub(1);
        if let Some(snapshot) = last.filter(|s| self.samples[*s] == first) {
            return snapshot;
        }
        self.samples[self.used] = first;
        self.states.extend_from_slice(&now.displacement);
        self.states.extend_from_slice(&now.velocity);
        self.used += 1;
        self.used - 1
    }

    /// Notes a candidate in a block that starts at `first` from the state `now`.
    pub(super) fn note(
        &mut self,
        start: (usize, &Modal),
        (quantity, floor): (Quantity, usize),
        (sample, upper): (usize, f64),
    ) {
        let snapshot = self.snapshot(start);
        self.list.push(Candidate {
            quantity,
            floor,
            sample,
            upper,
            by_hull: false,
            snapshot,
        });
    }

    /// Notes what could have a peak in a block by its ends that starts at this sample from this
    /// state.
    pub(super) fn put_off(&mut self, start: (usize, &Modal), suspects: &[Suspect]) {
        if suspects.is_empty() {
            return;
        }
        let snapshot = self.snapshot(start);
        if let Some(blocks) = &mut self.blocks {
            blocks.list.extend(suspects.iter().map(|s| LaneCandidate {
                quantity: s.quantity,
                lane: s.lane,
                upper: s.upper,
                snapshot,
            }));
        }
    }

    /// Drops what lies below the peaks by now, and the states that nothing is reached from.
    fn prune(&mut self, tracks: &AllTracks<'_>) {
        self.list.retain(|c| is_above(c, tracks));
        if let Some(blocks) = &mut self.blocks {
            blocks.list.retain(|c| c.is_above(tracks));
        }
        let lanes = self.blocks.as_ref().map_or(&[][..], |of| &of.list);
        let mut wanted = [false; TALL_SNAPSHOTS];
        let of_lanes = lanes.iter().map(|c| c.snapshot);
        for snapshot in self.list.iter().map(|c| c.snapshot).chain(of_lanes) {
            wanted[snapshot] = true;
        }
        let both = self.states.len() / self.used.max(1);
        let (mut places, mut kept) = ([0; TALL_SNAPSHOTS], 0);
        for snapshot in (0..self.used).filter(|s| wanted[*s]) {
            self.samples[kept] = self.samples[snapshot];
            let state = snapshot * both..(snapshot + 1) * both;
            self.states.copy_within(state, kept * both);
            places[snapshot] = kept;
            kept += 1;
        }
        for candidate in &mut self.list {
            candidate.snapshot = places[candidate.snapshot];
        }
        if let Some(blocks) = &mut self.blocks {
            for candidate in &mut blocks.list {
                candidate.snapshot = places[candidate.snapshot];
            }
        }
        self.used = kept;
        self.states.truncate(kept * both);
    }

    /// Looks at all that are left, and forgets them.
    pub(super) fn settle(&mut self, place: (&ContactFree, &System), tracks: &mut AllTracks<'_>) {
        self.settle_lanes(place, tracks);
        self.settle_samples(place, tracks);
        self.used = 0;
        self.states.clear();
    }

    /// Looks at the lanes of floors that are left, those blocks first that could exceed the
    /// peaks most, and keeps the samples that they could have peaks in. Returns whether there
    /// were any.
    fn settle_lanes(
        &mut self,
        (constants, system): (&ContactFree, &System),
        tracks: &mut AllTracks<'_>,
    ) -> bool {
        let Some(mut of) = self.blocks.take() else {
            return false;
        };
        let any = !of.list.is_empty();
        let (mut count, mut start) = (0, 0);
        for group in of.list.chunk_by(|a, b| a.snapshot == b.snapshot) {
            let most = group.iter().map(|c| c.relative_excess(tracks));
            of.order[count] = (most.fold(0.0, f64::max), start, start + group.len());
            count += 1;
            start += group.len();
        }
        let order = &mut of.order[..count];
        order.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        for (_, start, end) in &*order {
            let group = &of.list[*start..*end];
            if !group.iter().any(|c| c.is_above(tracks)) {
                continue;
            }
            let snapshot = group[0].snapshot;
            let first = self.samples[snapshot];
            let lanes = constants.modes.len();
            let ground = &system.ground().samples[first..=first + BLOCK];
            of.look.begin();
            for candidate in group {
                if !candidate.is_above(tracks) {
                    continue;
                }
                let track = &mut *tracks[candidate.quantity as usize];
                of.intervals.clear();
                let (look, intervals) = (&mut of.look, &mut of.intervals);
                let state = self.states[snapshot * 2 * lanes..][..2 * lanes].split_at(lanes);
                look.follow(constants, (state, ground), candidate.lane);
                look.look_at(constants, candidate, (first, track), intervals);
                if self.list.len() + intervals.len() > self.capacity {
                    self.settle_samples((constants, system), tracks);
                }
                self.list.extend(of.intervals.iter().map(|i| Candidate {
                    quantity: candidate.quantity,
                    floor: i.floor,
                    sample: first + i.number,
                    upper: i.upper,
                    by_hull: true,
                    snapshot,
                }));
            }
        }
        of.list.clear();
        self.blocks = Some(of);
        any
    }

    /// Looks at all samples that are left, and forgets them: sample by sample, since a look
    /// shows all floors; of tall buildings one building after another, since all modes of one are
    /// most of the work.
    fn settle_samples(
        &mut self,
        (constants, system): (&ContactFree, &System),
        tracks: &mut AllTracks<'_>,
    ) {
        let mut list = std::mem::take(&mut self.list);
        let tall = !self.ends.is_empty();
        let part = |c: &Candidate| if tall { constants.building[c.floor] } else { 0 };
        list.sort_unstable_by_key(|c| (part(c), c.sample, c.quantity as usize, c.floor));
        self.reached = None;
        for group in list.chunk_by_mut(|a, b| (part(a), a.sample) == (part(b), b.sample)) {
            if group.iter().any(|c| is_above(c, tracks)) {
                let part = part(&group[0]);
                self.look_at((constants, system), (part, group), tracks);
            }
        }
        list.clear();
        self.list = list;
    }

    /// Lanes of the modes of a part.
    fn lanes_of(&self, constants: &ContactFree, part: usize) -> Range<usize> {
        if self.ends.is_empty() {
            return 0..constants.modes.len();
        }
        let building = &constants.shapes[part];
        building.first_lane..building.first_lane + building.lanes
    }

    /// Looks at the sample that these candidates of a part have in common.
    fn look_at(
        &mut self,
        (constants, system): (&ContactFree, &System),
        (part, group): (usize, &mut [Candidate]),
        tracks: &mut AllTracks<'_>,
    ) {
        let first = group[0];
        let (sample, samples) = (first.sample, &system.ground().samples);
        let lanes = self.lanes_of(constants, part);
        let from = self
            .reached
            .filter(|reached| (reached.part, reached.snapshot) == (part, first.snapshot));
        let from = match from {
            Some(reached) => reached.sample,
            None => {
                let count = constants.modes.len();
                let state = &self.states[first.snapshot * 2 * count..][..2 * count];
                let (displacement, velocity) = state.split_at(count);
                let Modal {
                    displacement: q,
                    velocity: p,
                    ..
                } = &mut self.scratch;
                q[lanes.clone()].copy_from_slice(&displacement[lanes.clone()]);
                p[lanes.clone()].copy_from_slice(&velocity[lanes.clone()]);
                self.samples[first.snapshot]
            }
        };
        let passed = &samples[from..=sample];
        block::advance(constants, (lanes.clone(), passed), &mut self.scratch);
        self.reached = Some(Reached {
            part,
            snapshot: first.snapshot,
            sample,
        });
        let (start, end) = (samples[sample], samples[sample + 1]);
        let whole = Ground {
            start,
            end,
            slope: (end - start) / constants.step,
        };
        // Of tall buildings a sample that is not cut has the bound of its polynomial already.
        let bounded = !self.ends.is_empty() && constants.fine.parts == 1;
        if !bounded || group.iter().any(|c| !c.by_hull) {
            let now = (lanes.clone(), &self.scratch);
            self.bound.take(constants, now, whole);
            for candidate in group.iter_mut().filter(|c| is_above(c, tracks)) {
                let (quantity, floor) = (candidate.quantity, candidate.floor);
                let peak = tracks[quantity as usize].peak[floor / WIDTH][floor % WIDTH];
                if self.bound.is_below(constants, (quantity, floor), peak) {
                    candidate.upper = f64::NEG_INFINITY;
                }
            }
            if !group.iter().any(|c| is_above(c, tracks)) {
                return;
            }
        }
        let alive = group.iter().filter(|c| is_above(c, tracks));
        let functions = alive.map(|c| (c.quantity, c.floor));
        self.look.begin((lanes, &self.scratch), functions);
        let fine = &constants.fine;
        for part in 0..fine.parts {
            let at = |k: usize| start + (end - start) * (k as f64 / fine.parts as f64);
            let ground = Ground {
                start: at(part),
                end: at(part + 1),
                slope: (end - start) / constants.step,
            };
            self.look.advance(constants, fine, ground);
            let from = sample as f64 * constants.step + part as f64 * fine.step;
            for (number, candidate) in group.iter().enumerate() {
                if !is_above(candidate, tracks) {
                    continue;
                }
                let (quantity, floor) = (candidate.quantity, candidate.floor);
                let track = &mut tracks[quantity as usize];
                let (c, l) = (floor / WIDTH, floor % WIDTH);
                // In one part the bound would be that which a look at the block has found.
                let last = self.ends.get_mut(number).filter(|_| fine.parts > 1);
                if let Some(last) = last {
                    let (of, peak) = ((quantity, floor), track.peak[c][l]);
                    if !self.look.could_exceed(constants, of, last, peak) {
                        continue;
                    }
                }
                let function = self.look.function(constants, quantity, floor);
                if let Some((theta, top)) = absolute_maximum(&function, track.peak[c][l]) {
                    track.peak[c][l] = top;
                    track.time[c][l] = from + theta * fine.step;
                }
            }
        }
    }
}

impl OfBlocks {
    fn new(lanes: usize, capacity: usize) -> Self {
        Self {
            list: Vec::with_capacity(capacity),
            capacity,
            most: 3 * lanes,
            look: BlockLook::new(lanes),
            intervals: Vec::with_capacity(BLOCK * WIDTH),
            order: vec![(0.0, 0, 0); TALL_SNAPSHOTS],
        }
    }
}

impl LaneCandidate {
    /// Whether one of the floors could still be above its peak.
    fn is_above(&self, tracks: &AllTracks<'_>) -> bool {
        self.excess(tracks) > 0.0
    }

    /// What they could exceed them by in parts of the peak of the first floor.
    fn relative_excess(&self, tracks: &AllTracks<'_>) -> f64 {
        let first = tracks[self.quantity as usize].reach(self.lane)[0];
        self.excess(tracks) / first.max(f64::MIN_POSITIVE)
    }

    /// What the floors could exceed their peaks by, at most.
    fn excess(&self, tracks: &AllTracks<'_>) -> f64 {
        let track = &tracks[self.quantity as usize];
        let (peak, sure) = (&track.peak[self.lane], &track.sure[self.lane]);
        let mut most = 0.0;
        for l in 0..WIDTH {
            let reach = if sure[l] > peak[l] { sure[l] } else { peak[l] };
            let excess = self.upper[l] - reach;
            most = if excess <= most { most } else { excess };
        }
        most
    }
}

/// Whether a candidate could still be above its peak.
fn is_above(candidate: &Candidate, tracks: &AllTracks<'_>) -> bool {
    let (c, l) = (candidate.floor / WIDTH, candidate.floor % WIDTH);
    candidate.upper > tracks[candidate.quantity as usize].peak[c][l]
}
