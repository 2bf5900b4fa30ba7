//! Contact-free motion over many samples.

use std::ops::Range;

use super::block_ends::BlockEnds;
use super::candidates::Candidates;
use crate::contact::Contacts;
use crate::contact_episode::Tracks;
use crate::dense_output::{ModalStep, Motion};
use crate::error::TimeHistoryError;
use crate::layout::Layout;
use crate::observers::Observers;
use crate::peak::Peak;
use crate::peaks::Peaks;
use crate::system::System;
use crate::system::modes::{
    BLOCK, Block, BlockMotion, ContactFree, Extremes, Lane, LevelRows, Modal, Quantity, Track,
    WIDTH, at, balance, block, drifts, gather, is_tall, raise_now, restoring, spread, transform,
};

/// What is to be advanced.
pub(crate) struct SampleRange<'a> {
    pub system: &'a System,
    pub contacts: &'a Contacts,
    /// Samples from this one on, at most up to that one.
    pub from: usize,
    pub to: usize,
}

/// What a contact-free phase writes down.
pub(crate) struct EnergyAccounts<'a> {
    /// The whole state, of which the works are written.
    pub state: &'a mut [f64],
    pub largest_input: &'a mut f64,
    /// Maximum residual that the energy balance of a contact-free sample can have (J).
    pub residual: f64,
}

/// The motion in the coordinates of the modes, with its peaks.
#[derive(Debug, Clone)]
pub(crate) struct ContactFreePhase {
    pub now: Modal,
    pub(super) displacement: Track,
    pub(super) drift: Track,
    pub(super) acceleration: Track,
    pub(super) sections: Track,
    /// Whether the floors' accelerations at the present time are known.
    pub acceleration_known: bool,
    /// Whether they, and the penetrations, are to be worked out at the end of the phase, as
    /// blocks by their ends do without them.
    acceleration_left_out: bool,
    penetration_left_out: bool,
    /// The same of the floors' displacements and drifts, where blocks by their ends know them but
    /// approximately.
    floors_left_out: bool,
    /// Present penetrations.
    pub penetration: Vec<f64>,
    /// Least and greatest displacements of all floors in the present sample, where they are
    /// followed.
    pub(super) extent: Option<[Vec<Lane>; 2]>,
    /// Whether state and peaks are those of the run, and whether the state has changed
    /// since it was taken over.
    holds_state: bool,
    pub moved: bool,
    pub(super) modal: Vec<Lane>,
    start_energy: Vec<Lane>,
    drifted: Vec<Lane>,
    block: Block,
    /// Blocks whose floors are worked out at both ends.
    pub(super) ends: Option<Box<BlockEnds>>,
    pub(super) candidates: Candidates,
    /// The motion at the start of the block, for observers.
    block_start: Modal,
}

impl ContactFreePhase {
    pub(crate) fn new(constants: &ContactFree, system: &System) -> Self {
        let dofs = system.degrees_of_freedom();
        let lanes = dofs.div_ceil(WIDTH);
        let sections = system.sections().len();
        let tall = is_tall(system);
        let by_ends = tall || constants.block_step.is_some();
        system.loads().ask(system);
        let zeros = || vec![Lane::ZERO; lanes];
        Self {
            now: Modal::new(lanes),
            displacement: Track::new(dofs),
            drift: Track::new(dofs),
            acceleration: Track::new(dofs),
            sections: Track::new(sections),
            acceleration_known: false,
            acceleration_left_out: false,
            penetration_left_out: false,
            floors_left_out: false,
            penetration: vec![0.0; system.levels().len()],
            extent: None,
            holds_state: false,
            moved: false,
            modal: zeros(),
            start_energy: zeros(),
            drifted: zeros(),
            block: Block::new(system),
            ends: by_ends.then(|| Box::new(BlockEnds::new(constants))),
            candidates: Candidates::new((lanes, 3 * dofs + sections), by_ends, tall),
            block_start: Modal::new(lanes),
        }
    }

    /// For contacts among some buildings of a system alone, with so many degrees of freedom:
    /// blocks are left to the whole system.
    pub(crate) fn of_part(dofs: usize, levels: usize) -> Self {
        let zeros = || vec![Lane::ZERO; dofs.div_ceil(WIDTH)];
        Self {
            now: Modal::new(dofs.div_ceil(WIDTH)),
            displacement: Track::new(dofs),
            drift: Track::new(dofs),
            acceleration: Track::new(dofs),
            sections: Track::new(0),
            acceleration_known: false,
            acceleration_left_out: false,
            penetration_left_out: false,
            floors_left_out: false,
            penetration: vec![0.0; levels],
            extent: Some([zeros(), zeros()]),
            holds_state: true,
            moved: true,
            modal: zeros(),
            start_energy: Vec::new(),
            drifted: Vec::new(),
            block: Block::none(),
            ends: None,
            candidates: Candidates::none(),
            block_start: Modal::new(0),
        }
    }

    /// Takes state and peaks over, unless it has them.
    pub(crate) fn take_state(
        &mut self,
        constants: &ContactFree,
        (system, contacts): (&System, &Contacts),
        peaks: &Peaks,
        state: &[f64],
    ) {
        if self.holds_state {
            return;
        }
        self.holds_state = true;
        self.moved = false;
        let n = system.degrees_of_freedom();
        for (modal, from) in [
            (&mut self.now.displacement, &state[..n]),
            (&mut self.now.velocity, &state[n..2 * n]),
        ] {
            spread(from, &mut self.modal);
            transform(&constants.inverse, &self.modal, modal);
        }
        spread(&state[..n], &mut self.displacement.now);
        let u = &self.displacement.now;
        drifts(&constants.shapes, u, &mut self.drift.now);
        for (i, section) in system.sections().iter().enumerate() {
            self.sections.now[i / WIDTH][i % WIDTH] = section.at(&state[..n]);
        }
        self.acceleration_known = false;
        for (l, penetration) in self.penetration.iter_mut().enumerate() {
            *penetration = contacts.penetration(system, l, &state[..n]);
        }
        self.read_peaks(system, peaks);
    }

    /// Hands state and peaks back. What could still be a peak is kept for
    /// [`ContactFreePhase::finish`].
    pub(crate) fn return_state(
        &mut self,
        constants: &ContactFree,
        system: &System,
        peaks: &mut Peaks,
        state: &mut [f64],
    ) {
        if self.holds_state {
            self.holds_state = false;
            let n = system.degrees_of_freedom();
            // There and back again would be round-off, which matters to floors in touch.
            let back = [(&self.now.displacement, 0), (&self.now.velocity, n)];
            for (modal, place) in back.into_iter().filter(|_| self.moved) {
                transform(&constants.shapes, modal, &mut self.modal);
                gather(&self.modal, &mut state[place..place + n]);
            }
            self.write_peaks(system, peaks);
        }
    }

    /// Settles what could still be a peak.
    pub(crate) fn finish(&mut self, constants: &ContactFree, system: &System, peaks: &mut Peaks) {
        self.read_peaks(system, peaks);
        let tracks = &mut [
            &mut self.displacement,
            &mut self.drift,
            &mut self.acceleration,
            &mut self.sections,
        ];
        self.candidates.settle((constants, system), tracks);
        self.write_peaks(system, peaks);
    }

    /// A function of the floors from that of the modes.
    pub(crate) fn floors_of(&mut self, constants: &ContactFree, modal: &[Lane], out: &mut [f64]) {
        transform(&constants.shapes, modal, &mut self.modal);
        gather(&self.modal, out);
    }

    /// Floor displacements at the end of the last step, whose peaks have been taken.
    pub(crate) fn present_displacements(&self, out: &mut [f64]) {
        gather(&self.displacement.now, out);
    }

    /// Forces in sections.
    pub(crate) fn sections(&mut self) -> &mut Track {
        &mut self.sections
    }

    /// The floors' functions that have peaks.
    pub(crate) fn tracks(&mut self) -> Tracks<'_> {
        Tracks {
            displacement: &mut self.displacement,
            drift: &mut self.drift,
            acceleration: &mut self.acceleration,
            extent: self.extent.as_mut(),
        }
    }

    /// Advances samples until a gap could close in one or the range ends. Returns how many.
    pub(crate) fn propagate(
        &mut self,
        constants: &ContactFree,
        range: &SampleRange<'_>,
        accounts: &mut EnergyAccounts<'_>,
        (rows, observers): (&LevelRows, &mut Observers<'_, '_>),
    ) -> Result<usize, TimeHistoryError> {
        self.begin(constants);
        let before = accounts.state[Layout::of(range.system).input()];
        let mut sample = range.from;
        let by_loads = constants.block_step.is_some();
        while sample < range.to {
            // Loads are at hand for blocks from every eighth sample on.
            let count = BLOCK - if by_loads { sample % BLOCK } else { 0 };
            let count = count.min(range.to - sample);
            if !observers.is_empty() {
                self.block.watch();
                self.block_start.copy_from(&self.now);
            }
            let by_ends = count == BLOCK && self.propagate_by_ends(constants, range, sample);
            let advanced = match by_ends {
                true => BLOCK,
                false => self.propagate_block(constants, range, (sample, count)),
            };
            let samples = sample..sample + advanced;
            let start = sample as f64 * constants.step;
            let end = start + advanced as f64 * constants.step;
            if advanced > 0 && observers.ask(end) {
                if by_ends && by_loads {
                    self.follow(constants, range, sample);
                }
                let watched = (&*accounts.state, rows, &mut *observers);
                self.show(constants, range, samples, watched)?;
            }
            if advanced > 0 {
                self.moved = true;
                sample += advanced;
                let (modes, start) = (&constants.modes, &self.start_energy);
                let input = balance(modes, &self.now, start, &mut self.drifted);
                *accounts.largest_input = accounts.largest_input.max((before + input).abs());
            }
            if advanced < count {
                break;
            }
        }
        if std::mem::take(&mut self.acceleration_left_out) {
            self.work_out_acceleration(constants);
            self.acceleration_known = true;
        }
        self.work_out_floors(constants, sample);
        self.measure_penetrations(range);
        let layout = Layout::of(range.system);
        let sum = |lanes: &[Lane]| lanes.iter().flat_map(|l| l.0).sum::<f64>();
        accounts.state[layout.input()] += sum(&self.now.input);
        accounts.state[layout.viscous()] += sum(&self.now.viscous);
        accounts.residual = sum(&self.drifted);
        Ok(sample - range.from)
    }

    /// Works out the samples of a block that was advanced by one step.
    fn follow(&mut self, constants: &ContactFree, range: &SampleRange<'_>, sample: usize) {
        let mut samples = [0.0; BLOCK + 1];
        samples.copy_from_slice(&range.system.ground().samples[sample..=sample + BLOCK]);
        block::follow(constants, &self.block_start, &samples, &mut self.block);
    }

    /// Shows samples that were advanced to the observers that want them.
    fn show(
        &self,
        constants: &ContactFree,
        range: &SampleRange<'_>,
        samples: Range<usize>,
        (state, rows, observers): (&[f64], &LevelRows, &mut Observers<'_, '_>),
    ) -> Result<(), TimeHistoryError> {
        let ground = &range.system.ground().samples[samples.start..=samples.end];
        observers.show_wanted(&ModalStep {
            system: range.system,
            constants,
            rows,
            contacts: range.contacts,
            state,
            start: samples.start as f64 * constants.step,
            length: samples.len() as f64 * constants.step,
            motion: Motion::Free(BlockMotion {
                first: samples.start,
                step: constants.step,
                ground,
                start: self.block_start.view(),
                block: &self.block,
            }),
        })
    }

    fn begin(&mut self, constants: &ContactFree) {
        if let Some(ends) = &mut self.ends {
            ends.forget();
        }
        for field in [
            &mut self.now.input,
            &mut self.now.viscous,
            &mut self.drifted,
        ] {
            field.fill(Lane::ZERO);
        }
        for (c, m) in constants.modes.iter().enumerate() {
            let (q, p) = (self.now.displacement[c], self.now.velocity[c]);
            let mut energy = Lane::ZERO;
            for l in 0..WIDTH {
                let x = m.circular_frequency[l] * q[l];
                energy[l] = 0.5 * (p[l] * p[l] + x * x);
            }
            self.start_energy[c] = energy;
        }
    }

    fn read_peaks(&mut self, system: &System, peaks: &Peaks) {
        for (i, section) in system.sections().iter().enumerate() {
            let peak = peaks.of_section(section.place);
            let (c, l) = (i / WIDTH, i % WIDTH);
            self.sections.peak[c][l] = peak.value;
            self.sections.time[c][l] = peak.time;
        }
        for (range, building) in system.offsets().windows(2).zip(system.buildings()) {
            for i in range[0]..range[1] {
                let (c, l) = (i / WIDTH, i % WIDTH);
                let storey = i - range[0];
                let p = &peaks.storeys[i];
                self.displacement.peak[c][l] = p.displacement.value;
                self.displacement.time[c][l] = p.displacement.time;
                let drift = match building.stiffness().get(storey) {
                    Some(stiffness) => (p.storey_shear.value / stiffness, p.storey_shear.time),
                    None => {
                        let height = building.height()[storey];
                        (p.drift_ratio.value * height, p.drift_ratio.time)
                    }
                };
                (self.drift.peak[c][l], self.drift.time[c][l]) = drift;
                self.acceleration.peak[c][l] = p.acceleration_absolute.value;
                self.acceleration.time[c][l] = p.acceleration_absolute.time;
            }
        }
    }

    /// Advances a block of samples by its ends, if it is sure that nothing closes in it.
    /// Returns whether it did.
    fn propagate_by_ends(
        &mut self,
        constants: &ContactFree,
        range: &SampleRange<'_>,
        sample: usize,
    ) -> bool {
        let Some(ends) = &mut self.ends else {
            return false;
        };
        let mut samples = [0.0; BLOCK + 1];
        samples.copy_from_slice(&range.system.ground().samples[sample..=sample + BLOCK]);
        let peak = &self.acceleration.peak;
        let loads = range.system.loads();
        let load = loads.of(constants.block_step.as_ref(), sample);
        let low = ends.advance(
            constants,
            &self.now,
            (&samples, load),
            peak,
            &mut self.block,
        );
        if !ends.is_open(range.system, range.contacts) {
            ends.forget();
            return false;
        }
        let tracks = &mut [
            &mut self.displacement,
            &mut self.drift,
            &mut self.acceleration,
            &mut self.sections,
        ];
        let place = (constants, range.system);
        self.candidates.make_room(place, tracks, 0);
        let tracks = [
            &mut self.displacement,
            &mut self.drift,
            &mut self.acceleration,
        ];
        let end = (sample + BLOCK) as f64 * constants.step;
        let suspects = ends.take_end(constants, tracks, (end, low));
        self.candidates.put_off((sample, &self.now), suspects);
        let exact = ends.is_exact();
        self.acceleration_known = !low && exact;
        self.acceleration_left_out = !low && !exact;
        self.penetration_left_out = true;
        self.floors_left_out = !exact;
        std::mem::swap(&mut self.now, &mut self.block.end);
        true
    }

    /// Advances up to a block of samples. Returns how many it is sure that nothing closes
    /// in.
    fn propagate_block(
        &mut self,
        constants: &ContactFree,
        range: &SampleRange<'_>,
        (sample, count): (usize, usize),
    ) -> usize {
        self.work_out_floors(constants, sample);
        self.measure_penetrations(range);
        let ground = &range.system.ground().samples[sample..=sample + count];
        let mut samples = [ground[count]; BLOCK + 1];
        samples[..=count].copy_from_slice(ground);
        let peak = &self.acceleration.peak;
        let low = block::propagate(constants, &self.now, &samples, peak, &mut self.block);
        let mut clear = clear_samples(range, &self.block, &self.penetration, count);
        if clear < count && block::sharpen(constants, &mut self.block, 0) {
            clear = clear_samples(range, &self.block, &self.penetration, count);
        }
        if clear == 0 {
            return 0;
        }
        let functions = 3 * range.system.degrees_of_freedom() + range.system.sections().len();
        let wanted = BLOCK * functions;
        let tracks = &mut [
            &mut self.displacement,
            &mut self.drift,
            &mut self.acceleration,
            &mut self.sections,
        ];
        let place = (constants, range.system);
        self.candidates.make_room(place, tracks, wanted);
        if !low && !self.acceleration_known {
            self.work_out_acceleration(constants);
        }
        self.note_peaks(constants, (sample, clear), low);
        self.acceleration_known = !low;
        self.acceleration_left_out = false;
        if clear == BLOCK {
            std::mem::swap(&mut self.now, &mut self.block.end);
        } else {
            let all = 0..constants.modes.len();
            block::advance(constants, (all, &samples[..=clear]), &mut self.now);
        }
        let block = &self.block;
        block.floors.copy_after(clear, &mut self.displacement.now);
        block.drifts.copy_after(clear, &mut self.drift.now);
        block.sections.copy_after(clear, &mut self.sections.now);
        if !low {
            let now = &mut self.acceleration.now;
            block.accelerations.copy_after(clear, now);
        }
        for (l, penetration) in self.penetration.iter_mut().enumerate() {
            *penetration = block.levels.after(clear, l) - range.contacts.width(l);
        }
        clear
    }

    /// Works out displacements and drifts of the floors now, at this sample, if they were left
    /// out, and takes their peaks.
    fn work_out_floors(&mut self, constants: &ContactFree, sample: usize) {
        if !std::mem::take(&mut self.floors_left_out) {
            return;
        }
        let (shapes, u) = (&constants.shapes, &mut self.displacement.now);
        transform(shapes, &self.now.displacement, u);
        drifts(shapes, u, &mut self.drift.now);
        let time = sample as f64 * constants.step;
        for track in [&mut self.displacement, &mut self.drift] {
            raise_now(track, time);
        }
    }

    /// Works out present penetrations, if they were left out.
    fn measure_penetrations(&mut self, range: &SampleRange<'_>) {
        if !std::mem::take(&mut self.penetration_left_out) {
            return;
        }
        let floors = &self.displacement.now;
        let floor = |i: Option<usize>| i.map_or(0.0, |i| at(floors, i));
        let levels = range.system.levels().iter().enumerate();
        for ((l, level), penetration) in levels.zip(&mut self.penetration) {
            let closing = floor(level.left) - floor(level.right);
            *penetration = closing - range.contacts.width(l);
        }
    }

    /// Absolute accelerations of the floors now.
    fn work_out_acceleration(&mut self, constants: &ContactFree) {
        let (q, p) = (&self.now.displacement, &self.now.velocity);
        restoring(&constants.modes, q, p, &mut self.modal);
        transform(&constants.shapes, &self.modal, &mut self.acceleration.now);
    }

    /// Takes the peaks at the first samples of the block, and notes where there could be
    /// higher ones between them.
    fn note_peaks(&mut self, constants: &ContactFree, (first, count): (usize, usize), low: bool) {
        let (block, now) = (&mut self.block, &self.now);
        let all = [
            (Quantity::Displacement, &mut self.displacement),
            (Quantity::Drift, &mut self.drift),
            (Quantity::Acceleration, &mut self.acceleration),
            (Quantity::SectionForce, &mut self.sections),
        ];
        for (quantity, track) in all {
            let low = low && quantity == Quantity::Acceleration;
            let is_below = |block: &Block| {
                let values = block.values(quantity);
                below(values, track, &block.over[quantity as usize])
            };
            if low || is_below(block) {
                continue;
            }
            if block::sharpen(constants, block, quantity as usize) && is_below(block) {
                continue;
            }
            let values = block.values(quantity);
            let over = &block.over[quantity as usize];
            let functions = match quantity {
                Quantity::SectionForce => constants.rows.sections.len(),
                _ => constants.building.len(),
            };
            for floor in 0..functions {
                let (c, l) = (floor / WIDTH, floor % WIDTH);
                let top = values.top[c][l].max(track.now[c][l].abs());
                let over = over[c][l];
                if top + over <= track.peak[c][l] {
                    continue;
                }
                let (mut a, mut peak) = (track.now[c][l], track.peak[c][l]);
                for s in 0..count {
                    let b = values.after(s + 1, floor);
                    if b.abs() > peak {
                        peak = b.abs();
                        track.time[c][l] = (first + s + 1) as f64 * constants.step;
                    }
                    let upper = a.abs().max(b.abs()) + over;
                    // A larger change excludes a turning point inside.
                    if upper > peak && (b - a).abs() <= 4.0 * over {
                        let place = (quantity, floor);
                        self.candidates
                            .note((first, now), place, (first + s, upper));
                    }
                    a = b;
                }
                track.peak[c][l] = peak;
            }
        }
    }

    fn write_peaks(&self, system: &System, peaks: &mut Peaks) {
        let raise = |track: &Track, i: usize, factor: f64, peak: &mut Peak| {
            let (c, l) = (i / WIDTH, i % WIDTH);
            peak.raise(track.peak[c][l] * factor, track.time[c][l]);
        };
        for (i, section) in system.sections().iter().enumerate() {
            let (c, l) = (i / WIDTH, i % WIDTH);
            let (peak, time) = (self.sections.peak[c][l], self.sections.time[c][l]);
            peaks.raise_section(section.place, peak, time);
        }
        for (range, building) in system.offsets().windows(2).zip(system.buildings()) {
            for i in range[0]..range[1] {
                let storey = i - range[0];
                let p = &mut peaks.storeys[i];
                raise(&self.displacement, i, 1.0, &mut p.displacement);
                let height = building.height()[storey];
                if let Some(stiffness) = building.stiffness().get(storey) {
                    let before = p.storey_shear.value;
                    raise(&self.drift, i, *stiffness, &mut p.storey_shear);
                    if p.storey_shear.value > before {
                        raise(&self.drift, i, 1.0 / height, &mut p.drift_ratio);
                    }
                } else {
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
    let mut all = true;
    for c in 0..overshoot.len() {
        let (top, now) = (values.top[c], track.now[c]);
        let (over, peak) = (overshoot[c], track.peak[c]);
        for l in 0..WIDTH {
            let start = now[l].abs();
            let maximum = if top[l] > start { top[l] } else { start };
            all &= maximum + over[l] <= peak[l];
        }
    }
    all
}

/// Number of the first samples of the block in which no gap can close.
fn clear_samples(
    range: &SampleRange<'_>,
    block: &Block,
    penetration: &[f64],
    count: usize,
) -> usize {
    let mut clear = count;
    for (l, level) in range.system.levels().iter().enumerate() {
        let over = |floor: Option<usize>| floor.map_or(0.0, |i| at(&block.over[0], i));
        let (width, over) = (
            range.contacts.width(l),
            over(level.left) + over(level.right),
        );
        if (at(&block.levels.top, l) - width).max(penetration[l]) + over <= 0.0 {
            continue;
        }
        let mut start = penetration[l];
        for s in 0..clear {
            let end = block.levels.after(s + 1, l) - width;
            if start.max(end) + over > 0.0 {
                clear = s;
                break;
            }
            start = end;
        }
    }
    clear
}
