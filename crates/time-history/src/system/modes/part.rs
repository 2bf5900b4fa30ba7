//! The constants of neighbouring buildings by themselves, with lanes of their own.

use std::ops::Range;

use super::constants::{ContactFree, Fine, spread};
use super::lanes::{Lane, ModeLanes, Shapes, WIDTH};
use super::rows::{FloorRows, ModalRow};

/// Copies values out of a row of lanes, from this place on, into lanes of their own.
pub(crate) fn take_part(all: &[Lane], first: usize, part: &mut [Lane], count: usize) {
    for i in 0..count {
        let from = first + i;
        part[i / WIDTH][i % WIDTH] = all[from / WIDTH][from % WIDTH];
    }
}

/// Puts them back.
pub(crate) fn put_part(part: &[Lane], count: usize, all: &mut [Lane], first: usize) {
    for i in 0..count {
        let to = first + i;
        all[to / WIDTH][to % WIDTH] = part[i / WIDTH][i % WIDTH];
    }
}

impl ContactFree {
    /// What contacts among these buildings need, whose degrees of freedom are `dofs`. Blocks
    /// are left to the whole system.
    pub(crate) fn part(&self, buildings: Range<usize>, dofs: Range<usize>) -> Self {
        let (first, count) = (dofs.start, dofs.len());
        let shapes = |all: &[Shapes]| -> Vec<Shapes> {
            let all = all[buildings.clone()].iter();
            all.map(|shapes| moved(shapes, first)).collect()
        };
        let size = |all: &[Lane]| {
            let mut part = vec![Lane::ZERO; count.div_ceil(WIDTH)];
            take_part(all, first, &mut part, count);
            part
        };
        let rows = |all: &[ModalRow]| -> Vec<ModalRow> {
            let all = all[dofs.clone()].iter();
            all.map(|row| row.of_part(first, count)).collect()
        };
        let own = self.building[dofs.clone()]
            .iter()
            .map(|b| b - buildings.start);
        let mut part = Self {
            step: self.step,
            fastest: self.fastest,
            swings: self.swings,
            modes: modes(&self.modes, first, count),
            // Bounds of samples and blocks.
            decays: Vec::new(),
            rows: FloorRows {
                floors: rows(&self.rows.floors),
                drifts: rows(&self.rows.drifts),
                sections: Vec::new(),
                size: size(&self.rows.size),
                drift_size: size(&self.rows.drift_size),
            },
            shapes: shapes(&self.shapes),
            inverse: Vec::new(),
            magnitudes: shapes(&self.magnitudes),
            drift_magnitudes: shapes(&self.drift_magnitudes),
            building: own.collect(),
            floor_rows: Vec::new(),
            section_rows: Vec::new(),
            above: vec![Lane::ZERO; count.div_ceil(WIDTH)],
            bands: None,
            single_precision: None,
            block_step: None,
            fine: Fine::default(),
        };
        part.add_rows();
        part
    }
}

/// The same matrix where `first` is the first degree of freedom.
fn moved(shapes: &Shapes, first: usize) -> Shapes {
    let entry = |row: usize, column: usize| {
        let place = shapes.first_mode + row;
        let lane = place / WIDTH - shapes.first_lane;
        shapes.columns[lane * shapes.modes + column][place % WIDTH]
    };
    spread(shapes.first_mode - first, shapes.modes, entry)
}

/// Constants of these modes.
fn modes(all: &[ModeLanes], first: usize, count: usize) -> Vec<ModeLanes> {
    let mut part = vec![ModeLanes::default(); count.div_ceil(WIDTH)];
    for i in 0..count {
        let from = &all[(first + i) / WIDTH];
        let (l, k) = ((first + i) % WIDTH, i % WIDTH);
        let to = &mut part[i / WIDTH];
        let pairs = [
            (&from.displacement[..], &mut to.displacement[..]),
            (&from.velocity[..], &mut to.velocity[..]),
            (&from.integral[..], &mut to.integral[..]),
            (&from.viscous[..], &mut to.viscous[..]),
            (&from.acceleration_bound[..], &mut to.acceleration_bound[..]),
            (&from.snap_bound[..], &mut to.snap_bound[..]),
            (&from.steady[..], &mut to.steady[..]),
        ];
        for (from, to) in pairs {
            for (from, to) in from.iter().zip(to) {
                to[k] = from[l];
            }
        }
        to.participation[k] = from.participation[l];
        to.circular_frequency[k] = from.circular_frequency[l];
        to.stiffness[k] = from.stiffness[l];
        to.damping[k] = from.damping[l];
    }
    part
}
