//! The flight over many samples.

use super::block::{self, BLOCK, Block, Extremes};
use super::closer_look::CloserLook;
use super::constants::FreeFlight;
use super::lanes::{
    Advance, Ground, Lane, Modal, Track, WIDTH, acceleration_turns, advance, balance, drifts,
    is_low, raise, restoring, transform,
};
use crate::contact::Contacts;
use crate::dynamics::Layout;
use crate::engagement::Tracks;
use crate::outcome::{Peak, StoreyPeaks};
use crate::system::System;

/// What is to be flown.
pub(crate) struct Leg<'a> {
    pub system: &'a System,
    pub contacts: &'a Contacts,
    /// Samples from this one on, at most up to that one.
    pub from: usize,
    pub to: usize,
}

/// What a flight writes down.
pub(crate) struct Logbook<'a> {
    pub state: &'a mut [f64],
    pub peaks: &'a mut [StoreyPeaks],
    pub largest_input: &'a mut f64,
    /// Greatest residual that the energy balance of a flown sample can have (J).
    pub residual: f64,
}

/// Work space of open flight.
#[derive(Debug, Clone)]
pub(crate) struct Flight {
    now: Modal,
    step: Advance,
    displacement: Track,
    drift: Track,
    acceleration: Track,
    /// Whether `acceleration.now` holds.
    acceleration_known: bool,
    modal: Vec<Lane>,
    start_energy: Vec<Lane>,
    drifted: Vec<Lane>,
    /// Penetrations at the last sample.
    penetration: Vec<f64>,
    look: CloserLook,
    block: Block,
}

/// What could happen inside a sample.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Doubts {
    pub touch: bool,
    /// A turning point of displacement or drift above the peak.
    pub turn: bool,
    /// One of absolute acceleration.
    pub acceleration: bool,
}

impl Flight {
    pub(crate) fn new(system: &System) -> Self {
        let lanes = system.degrees_of_freedom().div_ceil(WIDTH);
        let zeros = || vec![[0.0; WIDTH]; lanes];
        Self {
            now: Modal::new(lanes),
            step: Advance::new(lanes),
            displacement: Track::new(lanes),
            drift: Track::new(lanes),
            acceleration: Track::new(lanes),
            acceleration_known: false,
            modal: zeros(),
            start_energy: zeros(),
            drifted: zeros(),
            penetration: vec![0.0; system.levels().len()],
            look: CloserLook::new(lanes),
            block: Block::new(lanes, system.levels().len()),
        }
    }

    /// Flies samples until a gap closes in one or the leg ends. Returns how many.
    pub(crate) fn fly(
        &mut self,
        constants: &FreeFlight,
        leg: &Leg<'_>,
        book: &mut Logbook<'_>,
    ) -> usize {
        self.take_off(constants, leg, book);
        let mut sample = leg.from;
        // Where the next block may be tried: not where the last one failed.
        let mut next_block = sample;
        while sample < leg.to {
            if sample >= next_block && sample + BLOCK <= leg.to {
                next_block = sample + BLOCK;
                if self.fly_block(constants, leg, sample) {
                    sample = next_block;
                    self.note_input(constants, leg, book);
                    continue;
                }
            }
            let ground = ground(leg.system, sample, constants.step);
            let doubts = self.advance(constants, leg, ground);
            let time = sample as f64 * constants.step;
            if (doubts.touch || doubts.turn || doubts.acceleration)
                && !self.clears(constants, leg, ground, doubts, time)
            {
                break;
            }
            sample += 1;
            self.accept(sample as f64 * constants.step);
            self.note_input(constants, leg, book);
        }
        if sample > leg.from {
            self.land(constants, leg.system, book);
        }
        sample - leg.from
    }

    /// Takes the state and the peaks over for motion with contacts.
    pub(crate) fn board(
        &mut self,
        constants: &FreeFlight,
        system: &System,
        peaks: &[StoreyPeaks],
        state: &[f64],
    ) {
        let n = system.degrees_of_freedom();
        for (modal, from) in [
            (&mut self.now.displacement, &state[..n]),
            (&mut self.now.velocity, &state[n..2 * n]),
        ] {
            self.modal.as_flattened_mut()[..n].copy_from_slice(from);
            transform(&constants.inverse, &self.modal, modal);
        }
        self.displacement.now.as_flattened_mut()[..n].copy_from_slice(&state[..n]);
        let u = &self.displacement.now;
        drifts(&constants.shapes, u, &mut self.drift.now);
        self.read_peaks(system, peaks);
    }

    /// Modal displacements (0) or velocities (1).
    pub(crate) fn modal(&self, which: usize) -> &[Lane] {
        [&self.now.displacement, &self.now.velocity][which]
    }

    /// The floors' functions that have peaks.
    pub(crate) fn tracks(&mut self) -> Tracks<'_> {
        Tracks {
            displacement: &mut self.displacement,
            drift: &mut self.drift,
            acceleration: &mut self.acceleration,
        }
    }

    /// Floor displacements and velocities from those of the modes.
    pub(crate) fn land_state(
        &mut self,
        constants: &FreeFlight,
        (q, p): (&[Lane], &[Lane]),
        state: &mut [f64],
    ) {
        let n = state.len() / 2;
        for (modal, place) in [(q, 0), (p, n)] {
            transform(&constants.shapes, modal, &mut self.modal);
            state[place..place + n].copy_from_slice(&self.modal.as_flattened()[..n]);
        }
    }

    fn take_off(&mut self, constants: &FreeFlight, leg: &Leg<'_>, book: &Logbook<'_>) {
        let n = leg.system.degrees_of_freedom();
        for (modal, from) in [
            (&mut self.now.displacement, &book.state[..n]),
            (&mut self.now.velocity, &book.state[n..2 * n]),
        ] {
            self.modal.as_flattened_mut()[..n].copy_from_slice(from);
            transform(&constants.inverse, &self.modal, modal);
        }
        for field in [
            &mut self.now.input,
            &mut self.now.viscous,
            &mut self.drifted,
        ] {
            field.fill([0.0; WIDTH]);
        }
        for (c, m) in constants.modes.iter().enumerate() {
            for l in 0..WIDTH {
                let (q, p) = (self.now.displacement[c][l], self.now.velocity[c][l]);
                let x = m.circular_frequency[l] * q;
                self.start_energy[c][l] = 0.5 * (p * p + x * x);
            }
        }
        let u = self.displacement.now.as_flattened_mut();
        u[..n].copy_from_slice(&book.state[..n]);
        drifts(
            &constants.shapes,
            &self.displacement.now,
            &mut self.drift.now,
        );
        self.acceleration_known = false;
        self.read_peaks(leg.system, book.peaks);
        for (l, penetration) in self.penetration.iter_mut().enumerate() {
            *penetration = leg.contacts.penetration(leg.system, l, &book.state[..n]);
        }
    }

    fn read_peaks(&mut self, system: &System, peaks: &[StoreyPeaks]) {
        for (range, building) in system.offsets().windows(2).zip(system.buildings()) {
            for i in range[0]..range[1] {
                let (c, l) = (i / WIDTH, i % WIDTH);
                let storey = i - range[0];
                let p = &peaks[i];
                self.displacement.peak[c][l] = p.displacement.value;
                self.displacement.time[c][l] = p.displacement.time;
                self.drift.peak[c][l] = p.storey_shear.value / building.stiffness()[storey];
                self.drift.time[c][l] = p.storey_shear.time;
                self.acceleration.peak[c][l] = p.acceleration_absolute.value;
                self.acceleration.time[c][l] = p.acceleration_absolute.time;
            }
        }
    }

    /// Tries the next sample.
    fn advance(&mut self, constants: &FreeFlight, leg: &Leg<'_>, ground: Ground) -> Doubts {
        let turn = advance(
            constants,
            &self.now,
            ground,
            &mut self.step,
            &mut self.displacement,
            &mut self.drift,
        );
        Doubts {
            turn,
            touch: self.may_touch(leg),
            acceleration: self.acceleration_may_peak(constants, ground),
        }
    }

    /// Whether a gap could close within the sample. Leaves the penetrations at its end.
    fn may_touch(&mut self, leg: &Leg<'_>) -> bool {
        let u = self.displacement.next.as_flattened();
        let overshoot = self.displacement.overshoot.as_flattened();
        let mut touch = false;
        let levels = leg.system.levels().iter().zip(&mut self.penetration);
        for (l, (level, penetration)) in levels.enumerate() {
            let over = |floor: Option<usize>| floor.map_or(0.0, |i| overshoot[i]);
            let end = level.relative(u) - leg.contacts.width(l);
            touch |= end.max(*penetration) + (over(level.left) + over(level.right)) > 0.0;
            *penetration = end;
        }
        touch
    }

    /// Whether absolute acceleration could have a peak within the sample. It is below
    /// the bound of that relative to the ground, which mostly settles it.
    fn acceleration_may_peak(&mut self, constants: &FreeFlight, ground: Ground) -> bool {
        let overshoot = &self.displacement.overshoot;
        if is_low(constants, overshoot, &self.acceleration.peak) {
            self.acceleration_known = false;
            return false;
        }
        let modes = &constants.modes;
        if !self.acceleration_known {
            let (q, p) = (&self.now.displacement, &self.now.velocity);
            restoring(modes, q, p, &mut self.modal);
            transform(&constants.shapes, &self.modal, &mut self.acceleration.now);
        }
        let (q, p) = (&self.step.next.displacement, &self.step.next.velocity);
        restoring(modes, q, p, &mut self.modal);
        transform(&constants.shapes, &self.modal, &mut self.acceleration.next);
        self.acceleration_known = true;
        acceleration_turns(constants, &mut self.step, ground, &mut self.acceleration)
    }

    /// Looks closer at a sample. Returns false if a gap closes in it.
    fn clears(
        &mut self,
        constants: &FreeFlight,
        leg: &Leg<'_>,
        ground: Ground,
        doubts: Doubts,
        time: f64,
    ) -> bool {
        let Some(fine) = &constants.fine else {
            return false;
        };
        self.look.begin(&self.now);
        for part in 0..fine.parts {
            let from = part as f64 / fine.parts as f64;
            let at = |x: f64| ground.start + x * (ground.end - ground.start);
            let inner = Ground {
                start: at(from),
                end: at(from + 1.0 / fine.parts as f64),
                slope: ground.slope,
            };
            self.look.advance(constants, fine, inner);
            if doubts.touch && self.look.touches(leg) {
                return false;
            }
            let start = time + from * constants.step;
            if doubts.turn {
                self.look
                    .displacement_peaks(constants, &mut self.displacement, start, fine.step);
                self.look
                    .drift_peaks(constants, &mut self.drift, start, fine.step);
            }
            if doubts.acceleration {
                self.look
                    .acceleration_peaks(constants, &mut self.acceleration, start, fine.step);
            }
        }
        true
    }

    /// Flies a block of samples if nothing can happen in it.
    fn fly_block(&mut self, constants: &FreeFlight, leg: &Leg<'_>, sample: usize) -> bool {
        let ground = &leg.system.ground().samples[sample..=sample + BLOCK];
        let mut samples = [0.0; BLOCK + 1];
        samples.copy_from_slice(ground);
        let block = &mut self.block;
        block::fly(constants, &self.now, &samples, block);
        let [displacement, drift, _] = &block.over;
        if !(below(&block.floors, &self.displacement, displacement)
            && below(&block.drifts, &self.drift, drift))
            || block_may_touch(leg, block, &self.penetration)
        {
            return false;
        }
        if !is_low(constants, displacement, &self.acceleration.peak) {
            if !self.acceleration_known {
                let (q, p) = (&self.now.displacement, &self.now.velocity);
                restoring(&constants.modes, q, p, &mut self.modal);
                transform(&constants.shapes, &self.modal, &mut self.acceleration.now);
            }
            block::accelerations(constants, block);
            if !below(&block.accelerations, &self.acceleration, &block.over[2]) {
                return false;
            }
        }
        let last = block.levels.last.as_flattened();
        for (l, penetration) in self.penetration.iter_mut().enumerate() {
            *penetration = last[l] - leg.contacts.width(l);
        }
        std::mem::swap(&mut self.now, &mut block.end);
        std::mem::swap(&mut self.displacement.now, &mut block.floors.last);
        std::mem::swap(&mut self.drift.now, &mut block.drifts.last);
        self.acceleration_known = false;
        true
    }

    /// Notes the greatest input energy and the imbalance so far.
    fn note_input(&mut self, constants: &FreeFlight, leg: &Leg<'_>, book: &mut Logbook<'_>) {
        let input = balance(
            &constants.modes,
            &self.now,
            &self.start_energy,
            &mut self.drifted,
        );
        let before = book.state[Layout::of(leg.system).input()];
        *book.largest_input = book.largest_input.max((before + input).abs());
    }

    /// Goes on to the end of the sample.
    fn accept(&mut self, time: f64) {
        raise(&mut self.displacement, time);
        raise(&mut self.drift, time);
        if self.acceleration_known {
            raise(&mut self.acceleration, time);
        }
        std::mem::swap(&mut self.now, &mut self.step.next);
    }

    /// Writes state, integrals and peaks back.
    fn land(&mut self, constants: &FreeFlight, system: &System, book: &mut Logbook<'_>) {
        let layout = Layout::of(system);
        let n = layout.dofs;
        for (modal, place) in [(&self.now.displacement, 0), (&self.now.velocity, n)] {
            transform(&constants.shapes, modal, &mut self.modal);
            book.state[place..place + n].copy_from_slice(&self.modal.as_flattened()[..n]);
        }
        let sum = |lanes: &[Lane]| lanes.as_flattened().iter().sum::<f64>();
        book.state[layout.input()] += sum(&self.now.input);
        book.state[layout.viscous()] += sum(&self.now.viscous);
        book.residual = sum(&self.drifted);
        self.write_peaks(system, book.peaks);
    }

    pub(crate) fn write_peaks(&self, system: &System, peaks: &mut [StoreyPeaks]) {
        let raise = |track: &Track, i: usize, factor: f64, peak: &mut Peak| {
            let (c, l) = (i / WIDTH, i % WIDTH);
            peak.raise(track.peak[c][l] * factor, track.time[c][l]);
        };
        for (range, building) in system.offsets().windows(2).zip(system.buildings()) {
            for i in range[0]..range[1] {
                let storey = i - range[0];
                let p = &mut peaks[i];
                raise(&self.displacement, i, 1.0, &mut p.displacement);
                let stiffness = building.stiffness()[storey];
                let before = p.storey_shear.value;
                raise(&self.drift, i, stiffness, &mut p.storey_shear);
                if p.storey_shear.value > before {
                    let height = building.height()[storey];
                    raise(&self.drift, i, 1.0 / height, &mut p.drift_ratio);
                }
                raise(&self.acceleration, i, 1.0, &mut p.acceleration_absolute);
            }
        }
    }
}

/// Whether all values of a block, that at its start included, stay below the peaks by
/// more than the overshoot.
fn below(values: &Extremes, track: &Track, overshoot: &[Lane]) -> bool {
    let (top, peak) = (values.top.as_flattened(), track.peak.as_flattened());
    let (now, over) = (track.now.as_flattened(), overshoot.as_flattened());
    let tops = top.iter().zip(now).map(|(a, b)| a.max(b.abs()));
    let mut all = tops.zip(over).zip(peak);
    all.all(|((top, over), peak)| top + over <= *peak)
}

/// Whether a gap could close within the block.
fn block_may_touch(leg: &Leg<'_>, block: &Block, penetration: &[f64]) -> bool {
    let top = block.levels.top.as_flattened();
    let overshoot = block.over[0].as_flattened();
    let levels = leg.system.levels().iter().zip(penetration);
    levels.enumerate().any(|(l, (level, start))| {
        let over = |floor: Option<usize>| floor.map_or(0.0, |i| overshoot[i]);
        let reach = (top[l] - leg.contacts.width(l)).max(*start);
        reach + (over(level.left) + over(level.right)) > 0.0
    })
}

/// Ground acceleration over a sample.
fn ground(system: &System, sample: usize, step: f64) -> Ground {
    let samples = &system.ground().samples;
    let (start, end) = (samples[sample], samples[sample + 1]);
    Ground {
        start,
        end,
        slope: (end - start) / step,
    }
}
