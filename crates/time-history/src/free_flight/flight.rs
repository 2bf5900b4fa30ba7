//! The flight over many samples.

use super::constants::FreeFlight;
use super::lanes::{Bounds, Ground, Lane, Modal, WIDTH, advance, restoring, transform};
use crate::contact::Contacts;
use crate::dynamics::Layout;
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

/// A function of time at every floor, sampled: present and next values, and its peak.
#[derive(Debug, Clone, Default)]
struct Track {
    now: Vec<Lane>,
    next: Vec<Lane>,
    peak: Vec<Lane>,
    time: Vec<Lane>,
    /// Bound of the overshoot between samples, `h^2 / 8` times that of the second
    /// derivative.
    overshoot: Vec<Lane>,
}

/// Work space of open flight.
#[derive(Debug, Clone, Default)]
pub(crate) struct Flight {
    now: Modal,
    next: Modal,
    bounds: Bounds,
    displacement: Track,
    drift: Track,
    acceleration: Track,
    /// Whether `acceleration.now` holds.
    acceleration_known: bool,
    restoring: Vec<Lane>,
    start_energy: Vec<Lane>,
    drifted: Vec<Lane>,
    /// Bounds of overshoot of every building: displacement, absolute acceleration.
    over: Vec<(f64, f64)>,
    /// Smallest peak of absolute acceleration of every building.
    smallest: Vec<f64>,
    /// Penetrations at the last sample.
    penetration: Vec<f64>,
}

impl Track {
    fn resize(&mut self, lanes: usize) {
        for field in [
            &mut self.now,
            &mut self.next,
            &mut self.peak,
            &mut self.time,
            &mut self.overshoot,
        ] {
            field.resize(lanes, [0.0; WIDTH]);
        }
    }

    /// Whether an extremum inside the sample could exceed the peak.
    fn wants_a_closer_look(&self) -> bool {
        let mut look = false;
        for c in 0..self.now.len() {
            for l in 0..WIDTH {
                let (a, b, over) = (self.now[c][l], self.next[c][l], self.overshoot[c][l]);
                let top = a.abs().max(b.abs()) + over;
                // |b - a| > h^2/2 A excludes a turning point.
                look |= (top > self.peak[c][l]) & ((b - a).abs() <= 4.0 * over);
            }
        }
        look
    }

    /// Takes the values at the end of the sample as peaks.
    fn land(&mut self, time: f64) {
        for c in 0..self.now.len() {
            for l in 0..WIDTH {
                let value = self.next[c][l].abs();
                let higher = value > self.peak[c][l];
                self.peak[c][l] = if higher { value } else { self.peak[c][l] };
                self.time[c][l] = if higher { time } else { self.time[c][l] };
            }
        }
        std::mem::swap(&mut self.now, &mut self.next);
    }
}

impl Flight {
    pub(crate) fn new(system: &System) -> Self {
        let mut this = Self::default();
        let lanes = system.degrees_of_freedom().div_ceil(WIDTH);
        for modal in [&mut this.now, &mut this.next] {
            modal.displacement.resize(lanes, [0.0; WIDTH]);
            modal.velocity.resize(lanes, [0.0; WIDTH]);
            modal.input.resize(lanes, [0.0; WIDTH]);
            modal.viscous.resize(lanes, [0.0; WIDTH]);
        }
        this.bounds.acceleration.resize(lanes, [0.0; WIDTH]);
        this.bounds.snap.resize(lanes, [0.0; WIDTH]);
        this.displacement.resize(lanes);
        this.drift.resize(lanes);
        this.acceleration.resize(lanes);
        for field in [
            &mut this.restoring,
            &mut this.start_energy,
            &mut this.drifted,
        ] {
            field.resize(lanes, [0.0; WIDTH]);
        }
        this.over.resize(system.buildings().len(), (0.0, 0.0));
        this.smallest.resize(system.buildings().len(), 0.0);
        this.penetration.resize(system.levels().len(), 0.0);
        this
    }

    /// Flies samples until one needs a closer look or the leg ends. Returns how many.
    pub(crate) fn fly(
        &mut self,
        constants: &FreeFlight,
        leg: &Leg<'_>,
        book: &mut Logbook<'_>,
    ) -> usize {
        let ground = leg.system.ground();
        self.take_off(constants, leg, book);
        let mut sample = leg.from;
        while sample < leg.to {
            let (a, b) = (ground.samples[sample], ground.samples[sample + 1]);
            let ground = Ground {
                start: a,
                end: b,
                slope: (b - a) / constants.step,
            };
            advance(
                &constants.modes,
                &constants.shapes,
                &self.now,
                ground,
                &mut self.next,
                &mut self.bounds,
                &mut self.displacement.next,
            );
            self.bound(constants, ground);
            if self.may_touch(constants, leg) || self.wants_a_closer_look(constants) {
                break;
            }
            sample += 1;
            let input = self.accept(constants, sample as f64 * constants.step);
            let before = book.state[Layout::of(leg.system).input()];
            *book.largest_input = book.largest_input.max((before + input).abs());
        }
        if sample > leg.from {
            self.land(constants, leg.system, book);
        }
        sample - leg.from
    }

    fn take_off(&mut self, constants: &FreeFlight, leg: &Leg<'_>, book: &Logbook<'_>) {
        let n = leg.system.degrees_of_freedom();
        let floors = &mut self.restoring;
        for (modal, from) in [
            (&mut self.now.displacement, &book.state[..n]),
            (&mut self.now.velocity, &book.state[n..2 * n]),
        ] {
            floors.as_flattened_mut()[..n].copy_from_slice(from);
            transform(&constants.inverse, floors, modal);
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
        drifts(constants, &self.displacement.now, &mut self.drift.now);
        self.acceleration_known = false;
        self.read_peaks(leg.system, book.peaks);
        for (l, penetration) in self.penetration.iter_mut().enumerate() {
            *penetration = leg.contacts.penetration(leg.system, l, &book.state[..n]);
        }
    }

    fn read_peaks(&mut self, system: &System, peaks: &[StoreyPeaks]) {
        for (range, (building, smallest)) in system
            .offsets()
            .windows(2)
            .zip(system.buildings().iter().zip(&mut self.smallest))
        {
            *smallest = f64::INFINITY;
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
                *smallest = smallest.min(p.acceleration_absolute.value);
            }
        }
    }

    /// Bounds of overshoot for every building, and for every floor.
    fn bound(&mut self, constants: &FreeFlight, ground: Ground) {
        let largest = ground.start.abs().max(ground.end.abs());
        let slope = ground.slope.abs();
        let eighth = 0.125 * constants.step * constants.step;
        let acceleration = self.bounds.acceleration.as_flattened();
        let snap = self.bounds.snap.as_flattened();
        for ((shapes, fixed), over) in constants
            .shapes
            .iter()
            .zip(&constants.bounds)
            .zip(&mut self.over)
        {
            let range = shapes.first_mode..shapes.first_mode + shapes.modes;
            let a: f64 = acceleration[range.clone()].iter().sum();
            let s: f64 = snap[range.clone()].iter().sum();
            let a = a + fixed.acceleration * largest;
            let s = s + fixed.snap * largest + fixed.snap_by_slope * slope;
            *over = (eighth * a, eighth * s);
            self.displacement.overshoot.as_flattened_mut()[range.clone()].fill(eighth * a);
            self.drift.overshoot.as_flattened_mut()[range.clone()].fill(2.0 * eighth * a);
            self.acceleration.overshoot.as_flattened_mut()[range].fill(eighth * s);
        }
    }

    /// Whether a gap could close within the sample. Leaves the penetrations at its end.
    fn may_touch(&mut self, constants: &FreeFlight, leg: &Leg<'_>) -> bool {
        let u = self.displacement.next.as_flattened();
        let mut touch = false;
        for (l, (level, penetration)) in leg
            .system
            .levels()
            .iter()
            .zip(&mut self.penetration)
            .enumerate()
        {
            let over =
                |floor: Option<usize>| floor.map_or(0.0, |i| self.over[constants.building[i]].0);
            let end = level.relative(u) - leg.contacts.width(l);
            touch |= end.max(*penetration) + (over(level.left) + over(level.right)) > 0.0;
            *penetration = end;
        }
        touch
    }

    fn wants_a_closer_look(&mut self, constants: &FreeFlight) -> bool {
        drifts(constants, &self.displacement.next, &mut self.drift.next);
        if self.displacement.wants_a_closer_look() || self.drift.wants_a_closer_look() {
            return true;
        }
        // Absolute acceleration is below that relative to the ground's bound.
        let eighth = 0.125 * constants.step * constants.step;
        let low = |(over, smallest): (&(f64, f64), &f64)| over.0 <= eighth * smallest;
        if self.over.iter().zip(&self.smallest).all(low) {
            self.acceleration_known = false;
            return false;
        }
        if !self.acceleration_known {
            restoring(&constants.modes, &self.now, &mut self.restoring);
            transform(
                &constants.shapes,
                &self.restoring,
                &mut self.acceleration.now,
            );
        }
        restoring(&constants.modes, &self.next, &mut self.restoring);
        transform(
            &constants.shapes,
            &self.restoring,
            &mut self.acceleration.next,
        );
        self.acceleration_known = true;
        self.acceleration.wants_a_closer_look()
    }

    /// Goes on to the end of the sample. Returns the input energy since take-off (J).
    fn accept(&mut self, constants: &FreeFlight, time: f64) -> f64 {
        self.displacement.land(time);
        self.drift.land(time);
        if self.acceleration_known {
            self.acceleration.land(time);
        }
        std::mem::swap(&mut self.now, &mut self.next);
        let mut input = 0.0;
        for (c, m) in constants.modes.iter().enumerate() {
            for l in 0..WIDTH {
                let (q, p) = (self.now.displacement[c][l], self.now.velocity[c][l]);
                let x = m.circular_frequency[l] * q;
                let balance = 0.5 * (p * p + x * x) - self.start_energy[c][l]
                    + self.now.viscous[c][l]
                    - self.now.input[c][l];
                self.drifted[c][l] = self.drifted[c][l].max(balance.abs());
                input += self.now.input[c][l];
            }
        }
        input
    }

    /// Writes state, integrals and peaks back.
    fn land(&mut self, constants: &FreeFlight, system: &System, book: &mut Logbook<'_>) {
        let layout = Layout::of(system);
        let n = layout.dofs;
        let floors = &mut self.restoring;
        for (modal, place) in [(&self.now.displacement, 0), (&self.now.velocity, n)] {
            transform(&constants.shapes, modal, floors);
            book.state[place..place + n].copy_from_slice(&floors.as_flattened()[..n]);
        }
        let sum = |lanes: &[Lane]| lanes.as_flattened().iter().sum::<f64>();
        book.state[layout.input()] += sum(&self.now.input);
        book.state[layout.viscous()] += sum(&self.now.viscous);
        book.residual = sum(&self.drifted);
        self.write_peaks(system, book.peaks);
    }

    fn write_peaks(&self, system: &System, peaks: &mut [StoreyPeaks]) {
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

/// Storey drifts from floor displacements.
fn drifts(constants: &FreeFlight, floors: &[Lane], drifts: &mut [Lane]) {
    let (u, d) = (floors.as_flattened(), drifts.as_flattened_mut());
    for building in &constants.shapes {
        let range = building.first_mode..building.first_mode + building.modes;
        let mut below = 0.0;
        for (drift, floor) in d[range.clone()].iter_mut().zip(&u[range]) {
            *drift = floor - below;
            below = *floor;
        }
    }
}
