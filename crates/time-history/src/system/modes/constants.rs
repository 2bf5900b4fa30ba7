//! What contact-free motion needs to know of the buildings: made once, shared by all runs.

use pounding_shear_building::ShearBuilding;

use super::block_step::BlockStep;
use super::lanes::{Lane, ModeLanes, Shapes, WIDTH};
use super::mode_step::{ModeStep, Oscillator};
use super::overdamped::Decay;
use super::reach::Reach;
use super::rows::{FloorRows, ModalRow, Rows, total};
use super::single_precision::SinglePrecisionShapes;
use crate::bands::Bands;
use crate::building_rates::fastest_rate;
use crate::system::System;
use pounding_vectorised::vectorised;

/// Exact steps, mode shapes and bounds of all buildings for one length of step.
#[derive(Debug, Clone)]
pub(crate) struct ContactFree {
    /// Length of a step (s).
    pub step: f64,
    /// Rate of the fastest mode of all buildings (1/s).
    pub fastest: f64,
    /// Whether bounds are those of the modes' free vibrations: sharper where a sample has many
    /// periods of the fastest modes, as it has of walls and frames with full matrices.
    pub swings: bool,
    pub modes: Vec<ModeLanes>,
    /// How the modes die out, where one is damped beyond critical.
    pub decays: Vec<Decay>,
    /// Floors and drifts as rows over the modes.
    pub rows: FloorRows,
    /// Floors from modes.
    pub shapes: Vec<Shapes>,
    /// Modes from floors: `q = Phi' M u`.
    pub inverse: Vec<Shapes>,
    /// Magnitudes of the shapes, and of their differences from floor to floor.
    pub magnitudes: Vec<Shapes>,
    pub drift_magnitudes: Vec<Shapes>,
    /// Building of every degree of freedom.
    pub building: Vec<usize>,
    /// Floors from modes, lane by lane.
    pub floor_rows: Vec<Rows>,
    /// Forces in sections from modes, for blocks.
    pub section_rows: Vec<Rows>,
    /// One where a floor has another one below it.
    pub above: Vec<Lane>,
    /// Stiffness and damping of tall buildings by the masses of the floors, where both are
    /// tridiagonal.
    pub bands: Option<Bands>,
    /// Their floors from modes in single precision.
    pub single_precision: Option<SinglePrecisionShapes>,
    /// The step over a block of samples: not for many modes, nor for blocks that are long beside
    /// the periods, nor for walls and frames with full matrices.
    pub block_step: Option<BlockStep>,
    /// Steps so short that displacements are polynomials of degree 7 over each.
    pub fine: Fine,
}

/// A sample in equal parts.
#[derive(Debug, Clone, Default)]
pub(crate) struct Fine {
    pub parts: usize,
    pub step: f64,
    pub modes: Vec<ModeLanes>,
}

/// Maximum product of the fastest rate and the fine step: the interpolant then errs by
/// less than 1e-8 of the amplitude of the fastest mode.
const FINE: f64 = 0.7;

/// Maximum product of the greatest circular frequency and the step. Constants of a step and its peaks are worked out part by part, whatever
/// the duration leaves of it; other steps end where the run does.
const COARSEST: f64 = 1.0e6;
/// The same of the fastest decay of modes that are damped beyond critical: other steps are no faster there, and lose digits
/// of the small differences between floors that stiff storeys join.
const FASTEST_DECAY: f64 = 1.0e8;

/// Storeys of the tallest building from which blocks whose floors are worked out at both ends alone cost less
/// than all floors at every sample, where there is no step over the block.
pub(crate) const TALL: usize = 24;

impl ContactFree {
    /// For these buildings and this step (s); `None` if the damping of a building
    /// couples its modes, or if the step holds so many periods that a whole one costs more than the run may be long.
    pub(crate) fn new(system: &System, step: f64) -> Option<Self> {
        let coupled = |b: &ShearBuilding| b.damping().couples_modes();
        if system.buildings().iter().any(|b| coupled(b)) || !(step > 0.0) {
            return None;
        }
        let fastest = fastest_rate(system.buildings());
        let frequencies = system
            .buildings()
            .iter()
            .map(|b| &b.modes().circular_frequency);
        let swings = frequencies.flatten().copied().fold(0.0, f64::max);
        if swings * step > COARSEST || fastest * step > FASTEST_DECAY {
            return None;
        }
        let mut this = Self::with_step(system, step);
        this.add_rows();
        this.decays = Decay::of_modes(system, step);
        this.fastest = fastest;
        this.rows = FloorRows::new((&this.inverse, &this.building), system);
        this.add_sections();
        this.bands = system.bands().filter(|_| is_tall(system)).cloned();
        if let Some(bands) = &mut this.bands {
            bands.divide(system.mass());
            this.single_precision = Some(SinglePrecisionShapes::new(&this.shapes, &this.rows.size));
        }
        let few = this.modes.len() <= BlockStep::LANES;
        let by_modes = few && !this.swings && system.sections().is_empty();
        let first = system.buildings().iter();
        let first = first.map(|b| b.modes().circular_frequency[0]);
        if by_modes && BlockStep::is_worth(step, first, this.fastest) {
            let parts = this.modes_over(system, BlockStep::parts(step));
            let buildings = Reach::of_buildings(&this.shapes, &this.rows);
            this.block_step = Some(BlockStep::new((&this.modes, &parts), &buildings, step));
        }
        let parts = (this.fastest * step / FINE).ceil().max(1.0);
        this.fine = Fine {
            parts: parts as usize,
            step: step / parts,
            modes: if parts == 1.0 {
                this.modes.clone()
            } else {
                let mut fine = Self::empty(system, step / parts);
                fine.add_modes(system);
                fine.modes
            },
        };
        Some(this)
    }

    /// Constants of all modes for a part of a sample of this length (s).
    pub(crate) fn modes_over(&self, system: &System, length: f64) -> Vec<ModeLanes> {
        let mut part = Self::empty(system, length);
        part.add_modes(system);
        part.modes
    }

    fn with_step(system: &System, step: f64) -> Self {
        let mut this = Self::empty(system, step);
        for (index, building) in system.buildings().iter().enumerate() {
            let first = system.offsets()[index];
            this.building.extend((0..building.storeys()).map(|_| index));
            this.add_building(building, first);
        }
        this.add_modes(system);
        this
    }

    fn empty(system: &System, step: f64) -> Self {
        let dofs = system.degrees_of_freedom();
        Self {
            step,
            fastest: 0.0,
            swings: system.buildings().iter().any(|b| b.stiffness().is_empty()),
            rows: FloorRows::default(),
            modes: vec![ModeLanes::default(); dofs.div_ceil(WIDTH)],
            decays: Vec::new(),
            shapes: Vec::new(),
            inverse: Vec::new(),
            magnitudes: Vec::new(),
            drift_magnitudes: Vec::new(),
            building: Vec::new(),
            floor_rows: Vec::new(),
            section_rows: Vec::new(),
            above: vec![Lane::ZERO; dofs.div_ceil(WIDTH)],
            bands: None,
            single_precision: None,
            block_step: None,
            fine: Fine::default(),
        }
    }

    /// Constants of the modes of all buildings.
    fn add_modes(&mut self, system: &System) {
        for (building, first) in system.buildings().iter().zip(system.offsets()) {
            let modes = building.modes();
            for j in 0..building.storeys() {
                let mode = Oscillator {
                    circular_frequency: modes.circular_frequency[j],
                    damping_ratio: modes.damping_ratio[j],
                    participation: modes.participation_factor[j],
                };
                self.add_mode(first + j, mode);
            }
        }
    }

    fn add_building(&mut self, building: &ShearBuilding, first: usize) {
        let modes = building.modes();
        let count = building.storeys();
        let shape = |i: usize, j: usize| modes.shape[(i, j)];
        let mass = building.mass();
        self.shapes.push(spread(first, count, shape));
        let inverse = spread(first, count, |mode, floor| shape(floor, mode) * mass[floor]);
        self.inverse.push(inverse);
        let below = |i: usize, j: usize| if i == 0 { 0.0 } else { shape(i - 1, j) };
        self.magnitudes
            .push(spread(first, count, |i, j| shape(i, j).abs()));
        let drift = |i: usize, j: usize| (shape(i, j) - below(i, j)).abs();
        self.drift_magnitudes.push(spread(first, count, drift));
    }

    /// An eighth of the step squared (s2).
    pub(crate) fn eighth(&self) -> f64 {
        0.125 * self.step * self.step
    }

    /// Every floor is a sum over the modes of its building.
    pub(super) fn add_rows(&mut self) {
        let dofs = self.building.len();
        let rows = (0..self.modes.len()).map(|lane| {
            let floors = lane * WIDTH..dofs.min((lane + 1) * WIDTH);
            let shapes = floors.clone().map(|i| &self.shapes[self.building[i]]);
            let (first, end) = shapes.fold((usize::MAX, 0), |(a, b), s| {
                (a.min(s.first_mode), b.max(s.first_mode + s.modes))
            });
            let entry = |i: usize, mode: usize| -> f64 {
                let shapes = &self.shapes[self.building[i]];
                if !(shapes.first_mode..shapes.first_mode + shapes.modes).contains(&mode) {
                    return 0.0;
                }
                let place = lane - shapes.first_lane;
                shapes.columns[place * shapes.modes + mode - shapes.first_mode][i % WIDTH]
            };
            let column = |mode: usize| -> Lane {
                Lane::from_fn(|l| {
                    let floor = floors.clone().nth(l);
                    floor.map_or(0.0, |i| entry(i, mode))
                })
            };
            Rows {
                first_mode: first,
                columns: (first..end).map(column).collect(),
            }
        });
        self.floor_rows = rows.collect();
        for i in 1..dofs {
            let same = self.building[i] == self.building[i - 1];
            self.above[i / WIDTH][i % WIDTH] = f64::from(u8::from(same));
        }
    }

    /// The same of the forces in sections.
    fn add_sections(&mut self) {
        let (modes, sections) = (self.building.len(), &self.rows.sections);
        let lanes = sections.chunks(WIDTH).map(|sections| {
            let own = sections.iter().map(ModalRow::modes);
            let own = own.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end));
            let own = own.unwrap_or_default();
            let column = |mode: usize| -> Lane {
                Lane::from_fn(|l| sections.get(l).map_or(0.0, |s| s.weight(mode)))
            };
            Rows {
                first_mode: own.start,
                columns: (own.start..own.end.min(modes)).map(column).collect(),
            }
        });
        self.section_rows = lanes.collect();
    }

    /// Bounds, with `e = |q'| + omega |q|` and `e* = e + |gamma| h A` for the sample:
    /// `|q''| <= (1 + 2 zeta) omega e* + |gamma| A`; the modal part of absolute
    /// acceleration `s = 2 zeta omega q' + omega^2 q` has
    /// `|s''| <= (1 + 4 zeta^2) omega^2 |q''| + 2 zeta omega^3 e* + 2 zeta omega |gamma| S`.
    /// The steady motion under an acceleration that is linear in time is linear too, so that the
    /// same holds for the free vibration alone, whose energy never grows, without the ground.
    fn add_mode(&mut self, place: usize, mode: Oscillator) {
        let (lane, l) = (place / WIDTH, place % WIDTH);
        let step = ModeStep::new(mode, self.step);
        let swings = self.swings;
        let m = &mut self.modes[lane];
        for k in 0..4 {
            m.displacement[k][l] = step.displacement[k];
            m.velocity[k][l] = step.velocity[k];
            m.integral[k][l] = step.integral[k];
        }
        for k in 0..10 {
            m.viscous[k][l] = step.viscous[k];
        }
        let (omega, zeta) = (mode.circular_frequency, mode.damping_ratio);
        m.participation[l] = mode.participation;
        m.circular_frequency[l] = omega;
        m.stiffness[l] = omega * omega;
        m.damping[l] = 2.0 * zeta * omega;
        m.steady[0][l] = mode.participation / (omega * omega);
        m.steady[1][l] = 2.0 * zeta * mode.participation / (omega * omega * omega);
        let gamma = if swings {
            0.0
        } else {
            mode.participation.abs()
        };
        let by_size = (1.0 + 2.0 * zeta) * omega;
        let (second, third) = (
            (1.0 + 4.0 * zeta * zeta) * omega * omega,
            2.0 * zeta * omega * omega * omega,
        );
        let growth = gamma * self.step;
        let by_ground = by_size * growth + gamma;
        (m.acceleration_bound[0][l], m.acceleration_bound[1][l]) = (by_size, by_ground);
        m.snap_bound[0][l] = second * by_size + third;
        m.snap_bound[1][l] = second * by_ground + third * growth;
        m.snap_bound[2][l] = 2.0 * zeta * omega * gamma;
    }
}

/// Whether a building of the system is so tall that blocks by their ends are worth their while.
pub(crate) fn is_tall(system: &System) -> bool {
    let tallest = system.buildings().iter().map(|b| b.storeys()).max();
    tallest.is_some_and(|storeys| storeys >= TALL) && system.sections().is_empty()
}

/// Kinetic energy and energy of strain (J) of the modes.
#[vectorised]
pub(crate) fn stored(constants: &ContactFree, q: &[Lane], p: &[Lane]) -> f64 {
    let mut energies = Lane::ZERO;
    for (c, m) in constants.modes.iter().enumerate() {
        for l in 0..WIDTH {
            let x = m.circular_frequency[l] * q[c][l];
            energies[l] += 0.5 * (p[c][l] * p[c][l] + x * x);
        }
    }
    total(&energies)
}

/// A square matrix over the lanes that hold rows `first..first + count`.
pub(super) fn spread(
    first: usize,
    count: usize,
    mut entry: impl FnMut(usize, usize) -> f64,
) -> Shapes {
    let first_lane = first / WIDTH;
    let lanes = (first + count).div_ceil(WIDTH) - first_lane;
    let mut columns: Vec<Lane> = vec![Lane::ZERO; lanes * count];
    for row in 0..count {
        let place = first + row;
        let lane = place / WIDTH - first_lane;
        for column in 0..count {
            columns[lane * count + column][place % WIDTH] = entry(row, column);
        }
    }
    Shapes {
        first_lane,
        lanes,
        first_mode: first,
        modes: count,
        columns,
    }
}
