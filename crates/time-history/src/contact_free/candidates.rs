//! Peaks between samples, put off.
//!
//! While a response grows, every swing has a higher peak than the last, and a look
//! between the samples of each would be wasted. What could be a peak is noted with a
//! rigorous upper bound; what lies below the maximum sample in the end never needs a
//! look.

use super::block::{self, BLOCK};
use super::closer_look::CloserLook;
use super::constants::ContactFree;
use super::lanes::{Ground, Lane, Modal, Track, WIDTH};
use super::sample_bound::SampleBound;
use crate::polynomial::absolute_maximum;
use crate::system::System;

/// What has peaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    Displacement,
    Drift,
    Acceleration,
    SectionForce,
}

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
    samples: [usize; SNAPSHOTS],
    states: Vec<Lane>,
    /// States in use: the first ones.
    used: usize,
    scratch: Modal,
    bound: SampleBound,
    look: CloserLook,
}

/// Candidates kept at least, and states at most.
const CANDIDATES: usize = 512;
const SNAPSHOTS: usize = 64;

/// Tracks of displacement, drift, acceleration and forces in sections.
pub(super) type AllTracks<'a> = [&'a mut Track; 4];

impl Candidates {
    /// For so many functions.
    pub(super) fn new(lanes: usize, functions: usize) -> Self {
        let capacity = CANDIDATES.max(2 * BLOCK * functions);
        Self {
            list: Vec::with_capacity(capacity),
            capacity,
            samples: [0; SNAPSHOTS],
            states: vec![Lane::ZERO; SNAPSHOTS * 2 * lanes],
            used: 0,
            scratch: Modal::new(lanes),
            bound: SampleBound::new(lanes),
            look: CloserLook::new(lanes),
        }
    }

    /// For what never notes any.
    pub(super) fn none() -> Self {
        Self {
            list: Vec::new(),
            capacity: 0,
            samples: [0; SNAPSHOTS],
            states: Vec::new(),
            used: 0,
            scratch: Modal::new(0),
            bound: SampleBound::new(0),
            look: CloserLook::new(0),
        }
    }

    /// Makes space for those of one more block.
    pub(super) fn make_room(
        &mut self,
        (constants, system): (&ContactFree, &System),
        tracks: &mut AllTracks<'_>,
        wanted: usize,
    ) {
        if self.list.len() + wanted <= self.capacity && self.used < SNAPSHOTS {
            return;
        }
        self.prune(tracks);
        if self.list.len() + wanted > self.capacity || self.used > SNAPSHOTS / 2 {
            self.settle((constants, system), tracks);
        }
    }

    /// Notes a candidate in a block that starts at `first` from the state `now`.
    pub(super) fn note(
        &mut self,
        (first, now): (usize, &Modal),
        (quantity, floor): (Quantity, usize),
        (sample, upper): (usize, f64),
    ) {
        let last = self.used.checked_sub(1);
        let snapshot = match last.filter(|s| self.samples[*s] == first) {
            Some(snapshot) => snapshot,
            None => {
                let lanes = now.displacement.len();
                self.samples[self.used] = first;
                let state = &mut self.states[self.used * 2 * lanes..][..2 * lanes];
                state[..lanes].copy_from_slice(&now.displacement);
                state[lanes..].copy_from_slice(&now.velocity);
                self.used += 1;
                self.used - 1
            }
        };
        self.list.push(Candidate {
            quantity,
            floor,
            sample,
            upper,
            snapshot,
        });
    }

    /// Drops what lies below the peaks by now.
    fn prune(&mut self, tracks: &AllTracks<'_>) {
        self.list.retain(|c| is_above(c, tracks));
        // Candidates are in order of their snapshots: close the gaps between those.
        let (mut kept, mut last) = (0, usize::MAX);
        let both = self.states.len() / SNAPSHOTS;
        for candidate in &mut self.list {
            if candidate.snapshot != last {
                last = candidate.snapshot;
                self.samples[kept] = self.samples[last];
                self.states
                    .copy_within(last * both..(last + 1) * both, kept * both);
                kept += 1;
            }
            candidate.snapshot = kept - 1;
        }
        self.used = kept;
    }

    /// Looks at all that are left, and forgets them: sample by sample, since a look shows
    /// all floors.
    pub(super) fn settle(
        &mut self,
        (constants, system): (&ContactFree, &System),
        tracks: &mut AllTracks<'_>,
    ) {
        let mut list = std::mem::take(&mut self.list);
        list.sort_unstable_by_key(|c| (c.sample, c.quantity as usize, c.floor));
        for group in list.chunk_by_mut(|a, b| a.sample == b.sample) {
            if group.iter().any(|c| is_above(c, tracks)) {
                self.look_at((constants, system), group, tracks);
            }
        }
        list.clear();
        self.list = list;
        self.used = 0;
    }

    /// Looks at the sample that these candidates have in common.
    fn look_at(
        &mut self,
        (constants, system): (&ContactFree, &System),
        group: &mut [Candidate],
        tracks: &mut AllTracks<'_>,
    ) {
        let first = group[0];
        let (sample, samples) = (first.sample, &system.ground().samples);
        let before = &samples[self.samples[first.snapshot]..=sample];
        let lanes = constants.modes.len();
        let state = &self.states[first.snapshot * 2 * lanes..][..2 * lanes];
        self.scratch.displacement.copy_from_slice(&state[..lanes]);
        self.scratch.velocity.copy_from_slice(&state[lanes..]);
        block::advance(constants, before, &mut self.scratch);
        let (start, end) = (samples[sample], samples[sample + 1]);
        let whole = Ground {
            start,
            end,
            slope: (end - start) / constants.step,
        };
        self.bound.take(constants, &self.scratch, whole);
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
        let alive = group.iter().filter(|c| is_above(c, tracks));
        let functions = alive.map(|c| (c.quantity, c.floor));
        self.look.begin(&self.scratch, functions);
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
            for candidate in group.iter() {
                if !is_above(candidate, tracks) {
                    continue;
                }
                let (quantity, floor) = (candidate.quantity, candidate.floor);
                let function = self.look.function(constants, quantity, floor);
                let track = &mut tracks[quantity as usize];
                let (c, l) = (floor / WIDTH, floor % WIDTH);
                if let Some((theta, top)) = absolute_maximum(&function, track.peak[c][l]) {
                    track.peak[c][l] = top;
                    track.time[c][l] = from + theta * fine.step;
                }
            }
        }
    }
}

/// Whether a candidate could still be above its peak.
fn is_above(candidate: &Candidate, tracks: &AllTracks<'_>) -> bool {
    let (c, l) = (candidate.floor / WIDTH, candidate.floor % WIDTH);
    candidate.upper > tracks[candidate.quantity as usize].peak[c][l]
}
