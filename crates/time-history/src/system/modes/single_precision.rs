//! Floors from the modes in single precision, with a bound of what they err by.
//!
//! The mode shapes of a tall building are most of what a block reads, and the products with them
//! most of what it works out. In single precision both are half. What floors err by is some
//! millionths of the motion: enough to tell which of them could have a peak in a block, not to
//! take the peak from.

use std::hint::black_box;

use pounding_vectorised::vectorised;

use super::lanes::{Lane, Shapes, WIDTH, add, at};

/// Values of single precision side by side, in one line of the cache.
const WIDE: usize = 2 * WIDTH;
/// Sixteen floors.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
struct Wide([f32; WIDE]);

impl Wide {
    const ZERO: Self = Self([0.0; WIDE]);
}

/// Sixteens of floors that are worked out together.
const TILE: usize = 2;
/// Functions that are transformed: displacement, and a third of the block times velocity.
const FUNCTIONS: usize = 2;

/// Unit round-off of single precision, and some more for that of everything else.
const ROUND_OFF: f64 = 1.01 / (1 << 24) as f64;
/// Roundings of a product: both factors, what small entries are left out, and itself.
const OF_PRODUCT: usize = 4;
/// Entries of shapes below this part of the maximum are left out: no product of what remains is
/// denormal, which would cost a hundred times as much.
const SMALLEST_ENTRY: f64 = 1.0 / (1 << 26) as f64;
/// Magnitudes of modes below which they are left out, and bound of errors above which there is
/// none: of larger modes single precision has no values.
const SMALLEST: f64 = 1.0e-30;
const LARGEST: f64 = 1.0e30;
/// Bound of what is left out by that, for any number of modes.
const LEFT_OUT: f64 = 1.0e-24;

/// The mode shapes of all buildings.
#[derive(Debug, Clone)]
pub(crate) struct SinglePrecisionShapes {
    buildings: Vec<Building>,
    /// Maximum magnitude of every mode at the floors of its building.
    size: Vec<Lane>,
    /// What a magnitude of one at the floor that the mode moves most errs by, at most.
    error: Vec<Lane>,
}

/// Columns in parts of their maximum, from the last mode to the first: the small ones are added
/// before the large ones.
#[derive(Debug, Clone)]
struct Building {
    first_lane: usize,
    lanes: usize,
    first_mode: usize,
    modes: usize,
    columns: Vec<Wide>,
}

/// Work space: the modes in single precision.
#[derive(Debug, Clone)]
pub(crate) struct SinglePrecisionModes([Vec<f32>; FUNCTIONS]);

impl SinglePrecisionModes {
    pub(crate) fn new(lanes: usize) -> Self {
        Self(std::array::from_fn(|_| vec![0.0; lanes * WIDTH]))
    }
}

impl SinglePrecisionShapes {
    /// Of these shapes, whose modes have these maximum magnitudes.
    pub(crate) fn new(shapes: &[Shapes], size: &[Lane]) -> Self {
        let mut error = vec![Lane::ZERO; size.len()];
        for building in shapes {
            for j in 0..building.modes {
                let place = building.first_mode + j;
                // A mode takes part in its own addition and in those of all modes before it.
                let roundings = (j + 1 + OF_PRODUCT) as f64;
                error[place / WIDTH][place % WIDTH] = ROUND_OFF * roundings;
            }
        }
        Self {
            buildings: shapes.iter().map(|b| Building::new(b, size)).collect(),
            size: size.to_vec(),
            error,
        }
    }

    /// Takes these displacements and velocities of the modes over, the velocities times this (s).
    /// Returns what displacements and velocities times it of any floor err by, at most.
    pub(crate) fn take(
        &self,
        [displacement, velocity]: [&[Lane]; FUNCTIONS],
        third: f64,
        modes: &mut SinglePrecisionModes,
    ) -> [f64; FUNCTIONS] {
        take(self, [displacement, velocity], third, modes)
    }

    /// Works the floors out.
    pub(crate) fn floors(&self, modes: &SinglePrecisionModes, out: [&mut [Lane]; FUNCTIONS]) {
        floors(self, modes, out);
    }
}

impl Building {
    fn new(shapes: &Shapes, size: &[Lane]) -> Self {
        let (lanes, modes) = (shapes.lanes, shapes.modes);
        let mut columns = Vec::with_capacity(lanes.div_ceil(2) * modes);
        let entry = |lane: usize, mode: usize, l: usize| {
            let largest = at(size, shapes.first_mode + mode).max(f64::MIN_POSITIVE);
            let column = (lane < lanes).then(|| shapes.columns[lane * modes + mode]);
            let part = column.map_or(0.0, |column| column[l] / largest);
            if part.abs() < SMALLEST_ENTRY {
                0.0
            } else {
                part as f32
            }
        };
        for first in (0..lanes).step_by(2) {
            for mode in (0..modes).rev() {
                columns.push(Wide(std::array::from_fn(|l| {
                    entry(first + l / WIDTH, mode, l % WIDTH)
                })));
            }
        }
        Self {
            first_lane: shapes.first_lane,
            lanes,
            first_mode: shapes.first_mode,
            modes,
            columns,
        }
    }
}

#[vectorised]
fn take(
    shapes: &SinglePrecisionShapes,
    of: [&[Lane]; FUNCTIONS],
    third: f64,
    modes: &mut SinglePrecisionModes,
) -> [f64; FUNCTIONS] {
    let mut bounds = [0.0; FUNCTIONS];
    for (k, (of, modes)) in of.into_iter().zip(&mut modes.0).enumerate() {
        let factor = if k == 0 { 1.0 } else { third };
        let mut sums = Lane::ZERO;
        let out = modes.as_chunks_mut::<WIDTH>().0.iter_mut();
        for (((of, size), error), out) in of.iter().zip(&shapes.size).zip(&shapes.error).zip(out) {
            for l in 0..WIDTH {
                let value = factor * (size[l] * of[l]);
                let magnitude = value.abs();
                sums[l] += error[l] * magnitude;
                out[l] = if magnitude < SMALLEST {
                    0.0
                } else {
                    value as f32
                };
            }
        }
        let sum = sums.0.iter().sum::<f64>() + LEFT_OUT;
        // What is no number is not bounded.
        bounds[k] = if sum <= LARGEST { sum } else { f64::INFINITY };
    }
    bounds
}

#[vectorised]
fn floors(
    shapes: &SinglePrecisionShapes,
    modes: &SinglePrecisionModes,
    mut out: [&mut [Lane]; FUNCTIONS],
) {
    let mut made = 0;
    for building in &shapes.buildings {
        let wides = building.lanes.div_ceil(2);
        let tiles = wides / TILE;
        for tile in 0..tiles {
            add_tile::<TILE>(building, (tile * TILE, made), modes, &mut out);
        }
        for wide in tiles * TILE..wides {
            add_tile::<1>(building, (wide, made), modes, &mut out);
        }
        made = building.first_lane + building.lanes;
    }
}

/// Works out so many sixteens of floors of a building from this one on. A lane below `made` holds
/// floors of the building before.
#[inline(always)]
fn add_tile<const COUNT: usize>(
    building: &Building,
    (first, made): (usize, usize),
    modes: &SinglePrecisionModes,
    out: &mut [&mut [Lane]; FUNCTIONS],
) {
    let count = building.modes;
    let own = building.first_mode..building.first_mode + count;
    let columns: [&[Wide]; COUNT] =
        std::array::from_fn(|t| &building.columns[(first + t) * count..][..count]);
    let [x, y] = modes.0.each_ref().map(|modes| &modes[own.clone()][..count]);
    let mut sums = [[Wide::ZERO; FUNCTIONS]; COUNT];
    for j in 0..count {
        let factors = [x[count - 1 - j], y[count - 1 - j]];
        for t in 0..COUNT {
            let column = columns[t][j];
            for v in 0..FUNCTIONS {
                let x = factors[v];
                for l in 0..WIDE {
                    sums[t][v].0[l] += column.0[l] * x;
                }
            }
        }
    }
    // Keeps the compiler from taking the vectors before it apart for the sake of what follows.
    let sums = black_box(sums);
    for (t, sums) in sums.iter().enumerate() {
        for (out, sum) in out.iter_mut().zip(sums) {
            let halves = sum.0.as_chunks::<WIDTH>().0;
            let within = 2 * (first + t);
            for (lane, half) in (within..building.lanes).zip(halves) {
                let (lane, floors) = (building.first_lane + lane, Lane(half.map(f64::from)));
                // A lane of the building before ends with floors of this one.
                out[lane] = if lane < made {
                    add(out[lane], floors)
                } else {
                    floors
                };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::modes::constants::spread;
    use crate::system::modes::transform::transform;

    /// Two buildings that share a lane, with shapes of all sizes.
    fn shapes(counts: [usize; 2]) -> (Vec<Shapes>, Vec<Lane>) {
        let total: usize = counts.iter().sum();
        let mut size = vec![Lane::ZERO; total.div_ceil(WIDTH)];
        let mut first = 0;
        let shapes = counts.map(|modes| {
            let own = first;
            first += modes;
            spread(own, modes, |floor, mode| {
                let wave = libm::sin((floor * (2 * mode + 1)) as f64 * 0.37 + mode as f64);
                let entry = wave * libm::exp(-(mode as f64) / 9.0);
                let largest = &mut size[(own + mode) / WIDTH][(own + mode) % WIDTH];
                *largest = largest.max(entry.abs());
                entry
            })
        });
        (shapes.into(), size)
    }

    /// Errors of displacement and velocity beside their bounds, for modes of these magnitudes.
    fn errors(counts: [usize; 2], magnitude: impl Fn(usize) -> f64) -> [(f64, f64); FUNCTIONS] {
        let (shapes, size) = shapes(counts);
        let lanes = size.len();
        let approximate = SinglePrecisionShapes::new(&shapes, &size);
        let modal = [0, 1].map(|k| -> Vec<Lane> {
            let value = |j: usize| magnitude(j) * libm::sin((7 * j + 3 * k + 1) as f64);
            (0..lanes)
                .map(|c| Lane::from_fn(|l| value(c * WIDTH + l)))
                .collect()
        });
        let third = 0.013;
        let mut modes = SinglePrecisionModes::new(lanes);
        let [q, p] = modal.each_ref().map(Vec::as_slice);
        let bounds = approximate.take([q, p], third, &mut modes);
        let mut seen = [0, 1].map(|_| vec![Lane::from_fn(|_| 7.0); lanes]);
        let [u, v] = &mut seen;
        approximate.floors(&modes, [u, v]);
        std::array::from_fn(|k| {
            let mut expected = vec![Lane::ZERO; lanes];
            transform(&shapes, &modal[k], &mut expected);
            let factor = [1.0, third][k];
            let each = seen[k].iter().zip(&expected).flat_map(|(seen, expected)| {
                (0..WIDTH).map(|l| (seen[l] - factor * expected[l]).abs())
            });
            (each.fold(0.0, f64::max), bounds[k])
        })
    }

    #[test]
    fn floors_err_by_less_than_their_bound() {
        for counts in [[24, 1], [50, 31], [3, 200], [129, 7]] {
            for decay in [0.0, 0.01, 0.3] {
                for scale in [1.0e-28, 1.0e-3, 1.0, 1.0e20] {
                    let of = |j: usize| scale * libm::exp(-decay * j as f64);
                    for (error, bound) in errors(counts, of) {
                        assert!(
                            error <= bound,
                            "{counts:?} {decay} {scale}: {error:e} {bound:e}"
                        );
                    }
                }
            }
            // Motion of a metre in the first modes is known to some micrometres.
            let of = |j: usize| 1.0 / ((j + 1) * (j + 1)) as f64;
            let [(_, bound), _] = errors(counts, of);
            assert!(bound < 2.0e-5, "{bound:e}");
        }
    }

    #[test]
    fn what_is_no_number_of_single_precision_is_not_bounded() {
        for large in [1.0e39, f64::INFINITY, f64::NAN] {
            for (_, bound) in errors([30, 2], |j| if j == 4 { large } else { 1.0 }) {
                assert!(bound.is_infinite());
            }
        }
    }
}
