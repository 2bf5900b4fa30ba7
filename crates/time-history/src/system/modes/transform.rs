//! From modes to floors.

use pounding_vectorised::vectorised;

use super::lanes::{Lane, ModeLanes, Shapes, WIDTH, at, restore};
use super::rows::Rows;

/// Floors from modes: `u = Phi q`.
#[vectorised]
pub(crate) fn transform(shapes: &[Shapes], modal: &[Lane], floors: &mut [Lane]) {
    to_floors(shapes, modal, floors);
}

#[inline(always)]
pub(crate) fn to_floors(shapes: &[Shapes], modal: &[Lane], floors: &mut [Lane]) {
    for lane in floors.iter_mut() {
        *lane = Lane::ZERO;
    }
    for building in shapes {
        for k in 0..building.lanes {
            let columns = &building.columns[k * building.modes..(k + 1) * building.modes];
            let floor = &mut floors[building.first_lane + k];
            let mut sum = *floor;
            for (j, column) in columns.iter().enumerate() {
                let x = at(modal, building.first_mode + j);
                for l in 0..WIDTH {
                    sum[l] += column[l] * x;
                }
            }
            *floor = sum;
        }
    }
}

/// The first two of four transformations, in one pass over the mode shapes.
#[vectorised]
pub(crate) fn transform_two(shapes: &[Shapes], modal: [&[Lane]; 2], floors: &mut [Vec<Lane>; 4]) {
    let [first, second, _, _] = floors;
    to_floors_together::<2, 2>(shapes, modal, [first, second]);
}

/// All four of them.
#[vectorised]
pub(crate) fn transform_four(shapes: &[Shapes], modal: [&[Lane]; 4], floors: &mut [Vec<Lane>; 4]) {
    let floors = floors.each_mut().map(Vec::as_mut_slice);
    to_floors_together::<4, 1>(shapes, modal, floors);
}

/// Several transformations with the bits of [`transform`], `TILE` lanes of floors at once.
#[inline(always)]
fn to_floors_together<const COUNT: usize, const TILE: usize>(
    shapes: &[Shapes],
    modal: [&[Lane]; COUNT],
    mut floors: [&mut [Lane]; COUNT],
) {
    for floors in &mut floors {
        floors.fill(Lane::ZERO);
    }
    for building in shapes {
        let tiles = building.lanes / TILE;
        for tile in 0..tiles {
            add_tile::<COUNT, TILE>(building, tile * TILE, modal, &mut floors);
        }
        for k in tiles * TILE..building.lanes {
            add_tile::<COUNT, 1>(building, k, modal, &mut floors);
        }
    }
}

/// Adds all columns of a building to so many of its lanes from this one on.
#[inline(always)]
fn add_tile<const COUNT: usize, const TILE: usize>(
    building: &Shapes,
    first: usize,
    modal: [&[Lane]; COUNT],
    floors: &mut [&mut [Lane]; COUNT],
) {
    let count = building.modes;
    let mut columns: [&[Lane]; TILE] =
        std::array::from_fn(|t| &building.columns[(first + t) * count..][..count]);
    let lane = building.first_lane + first;
    let mut sums: [[Lane; COUNT]; TILE] =
        std::array::from_fn(|t| std::array::from_fn(|v| floors[v][lane + t]));
    let (mut from, mut place) = (building.first_mode / WIDTH, building.first_mode % WIDTH);
    let mut left = count;
    while left > 0 {
        let now = left.min(WIDTH - place);
        let modes: [&Lane; COUNT] = std::array::from_fn(|v| &modal[v][from]);
        let these = columns.map(|columns| &columns[..now]);
        for (j, place) in (place..WIDTH).take(now).enumerate() {
            for t in 0..TILE {
                let column = these[t][j];
                for v in 0..COUNT {
                    let x = modes[v][place];
                    for l in 0..WIDTH {
                        sums[t][v][l] += column[l] * x;
                    }
                }
            }
        }
        columns = columns.map(|columns| &columns[now..]);
        (from, place, left) = (from + 1, 0, left - now);
    }
    for (t, sums) in sums.iter().enumerate() {
        for (floors, sum) in floors.iter_mut().zip(sums) {
            floors[lane + t] = *sum;
        }
    }
}

/// The first two of four transformations by rows, which cost less where mode shapes are small.
#[vectorised]
pub(crate) fn rows_of_two(rows: &[Rows], modal: [&[Lane]; 2], floors: &mut [Vec<Lane>; 4]) {
    let [first, second, _, _] = floors;
    by_rows::<2>(rows, modal, [first, second]);
}

/// All four of them.
#[vectorised]
pub(crate) fn rows_of_four(rows: &[Rows], modal: [&[Lane]; 4], floors: &mut [Vec<Lane>; 4]) {
    let floors = floors.each_mut().map(Vec::as_mut_slice);
    by_rows::<4>(rows, modal, floors);
}

#[inline(always)]
fn by_rows<const COUNT: usize>(
    rows: &[Rows],
    modal: [&[Lane]; COUNT],
    floors: [&mut [Lane]; COUNT],
) {
    let floors = floors.map(|floors| &mut floors[..rows.len()]);
    for (c, row) in rows.iter().enumerate() {
        let sums = sums_of_row(row, modal);
        for v in 0..COUNT {
            floors[v][c] = sums[v];
        }
    }
}

/// Eight floors from the modes, of so many transformations.
#[inline(always)]
pub(crate) fn sums_of_row<const COUNT: usize>(
    row: &Rows,
    modal: [&[Lane]; COUNT],
) -> [Lane; COUNT] {
    let mut sums = [Lane::ZERO; COUNT];
    let (mut lane, mut place) = (row.first_mode / WIDTH, row.first_mode % WIDTH);
    let mut columns = row.columns.as_slice();
    while !columns.is_empty() {
        let (now, later) = columns.split_at(columns.len().min(WIDTH - place));
        let modes = modal.map(|modal| &modal[lane].0[place..]);
        for (j, column) in now.iter().enumerate() {
            for v in 0..COUNT {
                let x = modes[v][j];
                for l in 0..WIDTH {
                    sums[v][l] += column[l] * x;
                }
            }
        }
        (columns, lane, place) = (later, lane + 1, 0);
    }
    sums
}

/// One floor of eight transformations, with the bits of [`transform`], from eight values for
/// every mode.
#[vectorised]
pub(crate) fn floor_of_eight(shapes: &[Shapes], eights: &[Lane], floor: usize) -> Lane {
    let holds = |b: &&Shapes| (b.first_mode..b.first_mode + b.modes).contains(&floor);
    let mut sum = Lane::ZERO;
    let Some(building) = shapes.iter().find(holds) else {
        return sum;
    };
    let (lane, place) = (floor / WIDTH - building.first_lane, floor % WIDTH);
    let columns = &building.columns[lane * building.modes..][..building.modes];
    for (column, eight) in columns.iter().zip(&eights[building.first_mode..]) {
        let entry = column[place];
        for l in 0..WIDTH {
            sum[l] += entry * eight[l];
        }
    }
    sum
}

/// Displacements, velocities and accelerations of floors, eight after eight.
pub(crate) type Floors = [Vec<f64>; 3];

/// Three transformations in one pass, each with the bits of [`transform`].
#[vectorised]
pub(crate) fn transform_three(rows: &[Rows], modal: [&[Lane]; 3], floors: &mut Floors) {
    three(rows, modal, floors);
}

/// The same of displacements and velocities of the modes without contact, with the accelerations
/// that follow from them: they are left in `absolute`.
#[vectorised]
pub(crate) fn transform_free(
    (modes, rows): (&[ModeLanes], &[Rows]),
    [q, p]: [&[Lane]; 2],
    absolute: &mut [Lane],
    floors: &mut Floors,
) {
    restore(modes, q, p, absolute);
    three(rows, [q, p, absolute], floors);
}

#[inline(always)]
fn three(rows: &[Rows], modal: [&[Lane]; 3], [u, v, w]: &mut Floors) {
    let out = u.as_chunks_mut::<WIDTH>().0.iter_mut();
    let out = out.zip(v.as_chunks_mut::<WIDTH>().0);
    let out = out.zip(w.as_chunks_mut::<WIDTH>().0);
    for (row, ((u, v), w)) in rows.iter().zip(out) {
        [*u, *v, *w] = sums_of_row(row, modal).map(|sums| sums.0);
    }
}

/// Four transformations that have their lanes of floors in common.
pub(crate) struct Four<'a> {
    pub modal: [&'a [Lane]; 4],
    pub floors: &'a mut [Vec<Lane>; 4],
    /// Lanes of floors that are wanted; the others are left as they are.
    pub wanted: &'a [bool],
}

/// Fours at once.
const FOURS: usize = 4;
/// Modes that all floors take before the next ones: their columns then stay in the cache
/// until all fours have them.
pub(crate) const STRIP: usize = 64;

/// Modal values of a strip, four after four for every mode.
type Packed = [[[f64; 4]; FOURS]; STRIP];

/// Many transformations in one pass, each with the bits of [`transform`]: the mode shapes of a
/// tall building are larger than the cache, so that reading them is most of the work of one.
#[vectorised]
pub(crate) fn transform_fours(shapes: &[Shapes], fours: &mut [Four<'_>]) {
    for four in fours.iter_mut() {
        for floors in four.floors.iter_mut() {
            for (lane, _) in floors.iter_mut().zip(four.wanted).filter(|(_, w)| **w) {
                *lane = Lane::ZERO;
            }
        }
    }
    if shapes.iter().all(|b| b.modes <= STRIP) {
        // Small shapes stay in the cache by themselves.
        for four in fours.iter_mut() {
            for building in shapes {
                add_small(building, four);
            }
        }
        return;
    }
    let mut packed: Packed = [[[0.0; 4]; FOURS]; STRIP];
    for fours in fours.chunks_mut(FOURS) {
        for building in shapes {
            for first in (0..building.modes).step_by(STRIP) {
                let modes = first..building.modes.min(first + STRIP);
                for (packed, mode) in packed.iter_mut().zip(modes.clone()) {
                    for (packed, four) in packed.iter_mut().zip(fours.iter()) {
                        for v in 0..4 {
                            packed[v] = at(four.modal[v], building.first_mode + mode);
                        }
                    }
                }
                for k in 0..building.lanes {
                    let row = &building.columns[k * building.modes..(k + 1) * building.modes];
                    let lane = building.first_lane + k;
                    for (place, four) in fours.iter_mut().enumerate() {
                        if four.wanted[lane] {
                            add_strip(&row[modes.clone()], &packed, place, lane, four);
                        }
                    }
                }
            }
        }
    }
}

/// Adds all columns of a small building to the lanes of floors that are wanted.
#[inline(always)]
fn add_small(building: &Shapes, four: &mut Four<'_>) {
    for k in 0..building.lanes {
        let lane = building.first_lane + k;
        if !four.wanted[lane] {
            continue;
        }
        let columns = &building.columns[k * building.modes..(k + 1) * building.modes];
        let mut sums: [Lane; 4] = std::array::from_fn(|v| four.floors[v][lane]);
        for (j, column) in columns.iter().enumerate() {
            for (sum, modal) in sums.iter_mut().zip(four.modal) {
                let x = at(modal, building.first_mode + j);
                for l in 0..WIDTH {
                    sum[l] += column[l] * x;
                }
            }
        }
        for (floors, sum) in four.floors.iter_mut().zip(sums) {
            floors[lane] = sum;
        }
    }
}

/// Adds the columns of a strip of modes to one lane of floors.
#[inline(always)]
fn add_strip(columns: &[Lane], packed: &Packed, place: usize, lane: usize, four: &mut Four<'_>) {
    let mut sums = [Lane::ZERO; 4];
    for v in 0..4 {
        sums[v] = four.floors[v][lane];
    }
    for (column, packed) in columns.iter().zip(packed) {
        let (column, modal) = (*column, packed[place]);
        for v in 0..4 {
            for l in 0..WIDTH {
                sums[v][l] += column[l] * modal[v];
            }
        }
    }
    for v in 0..4 {
        four.floors[v][lane] = sums[v];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::modes::constants::spread;

    /// Two buildings that share a lane, taller than a strip.
    fn shapes(counts: [usize; 2]) -> Vec<Shapes> {
        let mut first = 0;
        let building = |modes: usize| {
            let own = first;
            first += modes;
            spread(own, modes, |floor, mode| {
                libm::sin(((own + floor) * 7 + mode * 13) as f64)
            })
        };
        counts.map(building).into()
    }

    #[test]
    fn many_at_once_have_the_bits_of_one_after_another() {
        for counts in [[150, 221], [3, 6], [64, 1]] {
            many_at_once(counts);
        }
    }

    fn many_at_once(counts: [usize; 2]) {
        let lanes = (counts[0] + counts[1]).div_ceil(WIDTH);
        let shapes = shapes(counts);
        let modal: Vec<Vec<Lane>> = (0..20)
            .map(|v| {
                let value = |c: usize, l: usize| libm::cos((c * WIDTH + l + 31 * v) as f64);
                (0..lanes).map(|c| Lane::from_fn(|l| value(c, l))).collect()
            })
            .collect();
        let kept = Lane::from_fn(|_| 0.25);
        let mut floors: Vec<[Vec<Lane>; 4]> = (0..5)
            .map(|_| std::array::from_fn(|_| vec![kept; lanes]))
            .collect();
        let wanted: Vec<Vec<bool>> = (0..5)
            .map(|four| {
                (0..lanes)
                    .map(|c| four == 0 || (c + four) % 3 > 0)
                    .collect()
            })
            .collect();
        let mut fours: Vec<Four<'_>> = floors
            .iter_mut()
            .zip(&wanted)
            .enumerate()
            .map(|(four, (floors, wanted))| Four {
                modal: std::array::from_fn(|v| modal[4 * four + v].as_slice()),
                floors,
                wanted,
            })
            .collect();
        transform_fours(&shapes, &mut fours);
        let mut one = vec![Lane::ZERO; lanes];
        for (v, modal) in modal.iter().enumerate() {
            transform(&shapes, modal, &mut one);
            for (c, one) in one.iter().enumerate() {
                let expected = if wanted[v / 4][c] { *one } else { kept };
                let bits = |lane: Lane| lane.0.map(f64::to_bits);
                assert_eq!(bits(floors[v / 4][v % 4][c]), bits(expected), "{v}, {c}");
            }
        }
    }
}
