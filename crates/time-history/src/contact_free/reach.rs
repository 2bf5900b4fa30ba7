//! How far bounds of the modes move the floors of a building.

use std::hint::black_box;
use std::ops::Range;

use super::constants::ContactFree;
use super::lanes::{Lane, WIDTH, mul, sum};

/// What floors are bounded in: displacement, drift and absolute acceleration, and the maximum of
/// absolute acceleration.
pub(super) const QUANTITIES: usize = 4;

/// Bounds of the modes over a block, all magnitudes.
#[derive(Debug, Clone)]
pub(super) struct Bounds {
    /// What displacement and absolute acceleration depart from the cubic through both ends by.
    pub displacement: Vec<Lane>,
    pub acceleration: Vec<Lane>,
    /// Absolute acceleration beside that under the line, which is the ground's.
    pub most: Vec<Lane>,
}

impl Bounds {
    pub(super) fn new(lanes: usize) -> Self {
        let zeros = || vec![Lane::ZERO; lanes];
        Self {
            displacement: zeros(),
            acceleration: zeros(),
            most: zeros(),
        }
    }
}

/// How far the modes of a building move its floors at most.
#[derive(Debug, Clone)]
pub(super) struct Reach {
    /// First lane of its floors.
    pub lane: usize,
    /// Maximum magnitudes of its mode shapes, and of their differences from floor to floor, by
    /// modes; and one for every floor. All are zero for other buildings.
    size: Vec<Lane>,
    drift_size: Vec<Lane>,
    pub own: Vec<Lane>,
}

impl Reach {
    /// Of all buildings.
    pub(super) fn of_buildings(constants: &ContactFree) -> Vec<Self> {
        let shapes = constants.shapes.iter();
        let floors = shapes.map(|b| b.first_mode..b.first_mode + b.modes);
        floors.map(|floors| Self::new(constants, floors)).collect()
    }

    fn new(constants: &ContactFree, floors: Range<usize>) -> Self {
        let rows = &constants.rows;
        let (lane, end) = (floors.start / WIDTH, floors.end.div_ceil(WIDTH));
        let own = |c: usize| Lane::from_fn(|l| f64::from(floors.contains(&(c * WIDTH + l))));
        let part = |of: &[Lane]| (lane..end).map(|c| mul(own(c), of[c])).collect();
        Self {
            lane,
            size: part(&rows.size),
            drift_size: part(&rows.drift_size),
            own: (lane..end).map(own).collect(),
        }
    }

    /// Sums of the products of sizes of modes with their bounds.
    #[inline(always)]
    pub(super) fn sums(&self, bounds: &Bounds) -> [f64; QUANTITIES] {
        let count = self.own.len();
        let lanes = self.lane..self.lane + count;
        let (size, drift_size) = (&self.size[..count], &self.drift_size[..count]);
        let displacement = &bounds.displacement[lanes.clone()];
        let (acceleration, most) = (&bounds.acceleration[lanes.clone()], &bounds.most[lanes]);
        let mut sums = [Lane::ZERO; QUANTITIES];
        for c in 0..count {
            for l in 0..WIDTH {
                sums[0][l] += size[c][l] * displacement[c][l];
                sums[1][l] += drift_size[c][l] * displacement[c][l];
                sums[2][l] += size[c][l] * acceleration[c][l];
                sums[3][l] += size[c][l] * most[c][l];
            }
        }
        // Keeps the compiler from taking the vectors before it apart for the sake of the sums.
        black_box(sums).map(|lane| sum(&[lane]))
    }
}
