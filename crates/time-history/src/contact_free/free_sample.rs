//! One sample in which some buildings of a row are in contact and the others are not.

use pounding_vectorised::vectorised;

use super::phase::{ContactFreePhase, SampleRange};
use crate::system::System;
use crate::system::modes::{
    ContactFree, Ground, Lane, Modal, Quantity, Track, WIDTH, at, drifts, is_low,
    modal_acceleration_overshoots, modal_overshoots, put_part, restoring, step_modes, take_part,
    to_floors, transform,
};

/// The exact step of all buildings over the sample, as if none was in contact. What it makes of
/// the floors stands in the tracks of [`ContactFreePhase`], as next values and overshoots.
#[derive(Debug, Clone)]
pub(crate) struct FreeSample {
    end: Modal,
    size: Vec<Lane>,
    modal: Vec<Lane>,
    /// Maximum ground acceleration and slope.
    largest: (f64, f64),
    /// Whether no acceleration can be a peak.
    low: bool,
}

impl FreeSample {
    pub(crate) fn new(constants: &ContactFree) -> Self {
        let lanes = constants.modes.len();
        let zeros = || vec![Lane::ZERO; lanes];
        Self {
            end: Modal::new(lanes),
            size: zeros(),
            modal: zeros(),
            largest: (0.0, 0.0),
            low: false,
        }
    }
}

#[vectorised]
fn look(
    phase: &mut ContactFreePhase,
    constants: &ContactFree,
    (start, end): (f64, f64),
    free: &mut FreeSample,
) {
    let ground = Ground {
        start,
        end,
        slope: (end - start) / constants.step,
    };
    let now = &phase.now;
    for (c, m) in constants.modes.iter().enumerate() {
        let state = [now.displacement[c], now.velocity[c], Lane::ZERO, Lane::ZERO];
        let ([q, p, input, viscous], size) = if constants.swings {
            step_modes::<true>(m, state, ground)
        } else {
            step_modes::<false>(m, state, ground)
        };
        (free.end.displacement[c], free.end.velocity[c]) = (q, p);
        (free.end.input[c], free.end.viscous[c]) = (input, viscous);
        free.size[c] = size;
    }
    free.largest = (start.abs().max(end.abs()), ground.slope.abs());
    modal_overshoots(constants, &free.size, free.largest.0, &mut free.modal);
    let displacement = &mut phase.displacement;
    to_floors(
        &constants.magnitudes,
        &free.modal,
        &mut displacement.overshoot,
    );
    to_floors(
        &constants.shapes,
        &free.end.displacement,
        &mut displacement.next,
    );
    let reach = (displacement.overshoot.as_slice(), free.largest.0);
    free.low = is_low(constants, reach, &phase.acceleration.peak);
}

/// Drifts of all floors, and their accelerations unless these are low.
#[vectorised]
fn look_closer(phase: &mut ContactFreePhase, constants: &ContactFree, free: &mut FreeSample) {
    let (floors, drift) = (&phase.displacement.next, &mut phase.drift);
    to_floors(
        &constants.drift_magnitudes,
        &free.modal,
        &mut drift.overshoot,
    );
    drifts(&constants.shapes, floors, &mut drift.next);
    if free.low {
        return;
    }
    let acceleration = &mut phase.acceleration;
    modal_acceleration_overshoots(constants, &free.size, free.largest, &mut free.modal);
    to_floors(
        &constants.magnitudes,
        &free.modal,
        &mut acceleration.overshoot,
    );
    let (q, p) = (&free.end.displacement, &free.end.velocity);
    restoring(&constants.modes, q, p, &mut free.modal);
    to_floors(&constants.shapes, &free.modal, &mut acceleration.next);
}

impl ContactFreePhase {
    /// Works out the sample from this motion of the modes on.
    pub(crate) fn look_ahead(
        &mut self,
        constants: &ContactFree,
        (q, p): (&[Lane], &[Lane]),
        ground: (f64, f64),
        free: &mut FreeSample,
    ) {
        self.now.displacement.copy_from_slice(q);
        self.now.velocity.copy_from_slice(p);
        look(self, constants, ground, free);
    }

    /// Closing of a level after the sample without contact (m), and what its floors may
    /// exceed the values at both ends of the sample by.
    pub(crate) fn closing_ahead(&self, system: &System, l: usize) -> (f64, f64) {
        let level = &system.levels()[l];
        let (next, over) = (&self.displacement.next, &self.displacement.overshoot);
        let side = |floor: Option<usize>| floor.map_or((0.0, 0.0), |i| (at(next, i), at(over, i)));
        let (left, right) = (side(level.left), side(level.right));
        (left.0 - right.0, left.1 + right.1)
    }

    /// Least and greatest displacement of a floor in the sample without contact (m).
    pub(crate) fn extent_ahead(&self, floor: usize) -> [f64; 2] {
        let track = &self.displacement;
        let (a, b) = (at(&track.now, floor), at(&track.next, floor));
        let over = at(&track.overshoot, floor);
        [a.min(b) - over, a.max(b) + over]
    }

    /// The same of a floor of a part, over all of its steps.
    pub(crate) fn extent_of(&self, floor: usize) -> [f64; 2] {
        match &self.extent {
            Some(extent) => [at(&extent[0], floor), at(&extent[1], floor)],
            None => [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// Present displacement of a floor (m).
    pub(crate) fn displacement_of(&self, floor: usize) -> f64 {
        at(&self.displacement.now, floor)
    }

    /// Hands the buildings from this degree of freedom on to a part, at the start of the
    /// sample.
    pub(crate) fn hand_to(&self, part: &mut Self, first: usize, count: usize) {
        let tracks = [
            (&self.displacement, &mut part.displacement),
            (&self.drift, &mut part.drift),
            (&self.acceleration, &mut part.acceleration),
        ];
        for (all, part) in tracks {
            take_part(&all.now, first, &mut part.now, count);
            take_part(&all.peak, first, &mut part.peak, count);
            take_part(&all.time, first, &mut part.time, count);
        }
        let start = &part.displacement.now;
        if let Some([least, greatest]) = &mut part.extent {
            least.copy_from_slice(start);
            greatest.copy_from_slice(start);
        }
    }

    /// Takes the buildings of a part back at the end of the sample, after the others.
    pub(crate) fn take_back(&mut self, part: &Self, first: usize, count: usize) {
        let tracks = [
            (&mut self.displacement, &part.displacement),
            (&mut self.drift, &part.drift),
            (&mut self.acceleration, &part.acceleration),
        ];
        for (all, part) in tracks {
            put_part(&part.now, count, &mut all.now, first);
            for i in 0..count {
                let (c, l) = ((first + i) / WIDTH, (first + i) % WIDTH);
                let peak = at(&part.peak, i);
                // A look at samples that were put off may have found a higher one.
                if peak > all.peak[c][l] {
                    (all.peak[c][l], all.time[c][l]) = (peak, at(&part.time, i));
                }
            }
        }
    }

    /// Takes the peaks of the buildings without contact, marked false in `touching`, and
    /// moves all to the end of the sample as if none was in contact. Whether accelerations are
    /// known, is told in `known` for every building. Returns the works of ground motion and
    /// damping on the buildings without contact (J).
    pub(crate) fn move_free(
        &mut self,
        constants: &ContactFree,
        range: &SampleRange<'_>,
        free: &mut FreeSample,
        (touching, known): (&[bool], &mut [bool]),
    ) -> (f64, f64) {
        look_closer(self, constants, free);
        let functions = 3 * range.system.degrees_of_freedom();
        let place = (constants, range.system);
        let tracks = &mut [
            &mut self.displacement,
            &mut self.drift,
            &mut self.acceleration,
            &mut self.sections,
        ];
        self.candidates.make_room(place, tracks, functions);
        let mut buildings = known.iter().zip(touching);
        if !free.low && buildings.any(|(known, touching)| !known && !touching) {
            let (q, p) = (&self.now.displacement, &self.now.velocity);
            restoring(&constants.modes, q, p, &mut free.modal);
            transform(&constants.shapes, &free.modal, &mut self.acceleration.now);
        }
        self.note_free_peaks(constants, range.from, (free.low, touching));
        for (known, touching) in known.iter_mut().zip(touching) {
            *known = *known && *touching || !free.low && !*touching;
        }
        std::mem::swap(&mut self.now, &mut free.end);
        for track in [&mut self.displacement, &mut self.drift] {
            std::mem::swap(&mut track.now, &mut track.next);
        }
        if !free.low {
            let track = &mut self.acceleration;
            std::mem::swap(&mut track.now, &mut track.next);
        }
        let (mut input, mut viscous) = (0.0, 0.0);
        for (mode, building) in constants.building.iter().enumerate() {
            if !touching[*building] {
                input += at(&self.now.input, mode);
                viscous += at(&self.now.viscous, mode);
            }
        }
        (input, viscous)
    }

    /// Takes the peaks of buildings without contact, and notes where there could be higher
    /// ones inside the sample.
    fn note_free_peaks(
        &mut self,
        constants: &ContactFree,
        sample: usize,
        (low, touching): (bool, &[bool]),
    ) {
        let end = (sample + 1) as f64 * constants.step;
        let all = [
            (Quantity::Displacement, &mut self.displacement),
            (Quantity::Drift, &mut self.drift),
            (Quantity::Acceleration, &mut self.acceleration),
        ];
        for (quantity, track) in all {
            if low && quantity == Quantity::Acceleration {
                continue;
            }
            for c in 0..track.now.len() {
                if !any_above(track, c) {
                    continue;
                }
                for l in 0..WIDTH {
                    let floor = c * WIDTH + l;
                    let building = constants.building.get(floor);
                    if building.is_none_or(|building| touching[*building]) {
                        continue;
                    }
                    let (a, b, over) = (track.now[c][l], track.next[c][l], track.overshoot[c][l]);
                    if b.abs() > track.peak[c][l] {
                        (track.peak[c][l], track.time[c][l]) = (b.abs(), end);
                    }
                    let upper = a.abs().max(b.abs()) + over;
                    // A larger change excludes a turning point inside.
                    if upper > track.peak[c][l] && (b - a).abs() <= 4.0 * over {
                        let place = (quantity, floor);
                        let state = (sample, &self.now);
                        self.candidates.note(state, place, (sample, upper));
                    }
                }
            }
        }
    }

    /// Copies of what a sample changes.
    pub(crate) fn copy_tracks(&self, to: &mut [Track; 3]) {
        let tracks = [&self.displacement, &self.drift, &self.acceleration];
        for (from, to) in tracks.into_iter().zip(to) {
            to.copy_from(from);
        }
    }

    /// Takes them again.
    pub(crate) fn put_tracks(&mut self, from: &[Track; 3]) {
        let tracks = [
            &mut self.displacement,
            &mut self.drift,
            &mut self.acceleration,
        ];
        for (to, from) in tracks.into_iter().zip(from) {
            to.copy_from(from);
        }
    }
}

/// Whether a floor of a lane could exceed its peak in the sample.
fn any_above(track: &Track, c: usize) -> bool {
    let (now, next) = (track.now[c], track.next[c]);
    let (over, peak) = (track.overshoot[c], track.peak[c]);
    (0..WIDTH).fold(false, |any, l| {
        let (a, b) = (now[l].abs(), next[l].abs());
        any | ((if a > b { a } else { b }) + over[l] > peak[l])
    })
}
