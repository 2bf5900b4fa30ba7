//! From modes to floors.

use multiversion::multiversion;

use super::lanes::{Lane, Shapes, WIDTH, at};

/// Floors from modes: `u = Phi q`.
#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
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

/// Four at once, for the lanes of floors that are wanted; the others are left as they are.
#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
pub(crate) fn transform_four(
    shapes: &[Shapes],
    modal: [&[Lane]; 4],
    floors: &mut [Vec<Lane>; 4],
    wanted: &[bool],
) {
    for floors in floors.iter_mut() {
        for (lane, _) in floors.iter_mut().zip(wanted).filter(|(_, w)| **w) {
            *lane = Lane::ZERO;
        }
    }
    for building in shapes {
        for k in (0..building.lanes).filter(|k| wanted[building.first_lane + k]) {
            let columns = &building.columns[k * building.modes..(k + 1) * building.modes];
            let lane = building.first_lane + k;
            let mut sums: [Lane; 4] = std::array::from_fn(|v| floors[v][lane]);
            for (j, column) in columns.iter().enumerate() {
                for (sum, modal) in sums.iter_mut().zip(modal) {
                    let x = at(modal, building.first_mode + j);
                    for l in 0..WIDTH {
                        sum[l] += column[l] * x;
                    }
                }
            }
            for (floors, sum) in floors.iter_mut().zip(sums) {
                floors[lane] = sum;
            }
        }
    }
}
