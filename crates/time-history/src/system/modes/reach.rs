//! How far bounds of the modes move the floors of a building.

use std::hint::black_box;
use std::ops::Range;

use super::lanes::{Lane, Shapes, WIDTH, add, mul, scale, sum};
use super::rows::FloorRows;

/// What floors are bounded in: displacement, drift and absolute acceleration, and the maximum of
/// absolute acceleration.
pub(crate) const QUANTITIES: usize = 4;

/// Bounds of the modes over a block, all magnitudes.
#[derive(Debug, Clone)]
pub(crate) struct Bounds {
    /// What displacement and absolute acceleration depart from the cubic through both ends by.
    pub displacement: Vec<Lane>,
    pub acceleration: Vec<Lane>,
    /// Absolute acceleration beside that under the line, which is the ground's.
    pub most: Vec<Lane>,
}

impl Bounds {
    pub(crate) fn new(lanes: usize) -> Self {
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
pub(crate) struct Reach {
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
    pub(crate) fn of_buildings(shapes: &[Shapes], rows: &FloorRows) -> Vec<Self> {
        let floors = shapes.iter().map(|b| b.first_mode..b.first_mode + b.modes);
        floors.map(|floors| Self::new(rows, floors)).collect()
    }

    fn new(rows: &FloorRows, floors: Range<usize>) -> Self {
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
    pub(crate) fn sums(&self, bounds: &Bounds) -> [f64; QUANTITIES] {
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

/// Buildings whose floors all stand in one lane: products with a small matrix cost less there than
/// sums for every building.
#[derive(Debug, Clone)]
pub(crate) struct OneLane {
    /// For every mode its maximum magnitude at the floors of its building, and that of differences
    /// from floor to floor.
    size: [Lane; WIDTH],
    drift_size: [Lane; WIDTH],
    /// One for the floors of every building.
    own: Vec<Lane>,
}

impl OneLane {
    /// `None` for more lanes.
    pub(crate) fn of(lanes: usize, buildings: &[Reach]) -> Option<Self> {
        (lanes == 1).then(|| Self::of_buildings(buildings))
    }

    fn of_buildings(buildings: &[Reach]) -> Self {
        let own: Vec<Lane> = buildings.iter().map(|b| b.own[0]).collect();
        // A size is that of one building alone.
        let spread = |of: fn(&Reach) -> &Lane| -> [Lane; WIDTH] {
            std::array::from_fn(|mode| {
                let mut out = Lane::ZERO;
                for building in buildings {
                    out = add(out, scale(of(building)[mode], building.own[0]));
                }
                out
            })
        };
        Self {
            size: spread(|b| &b.size[0]),
            drift_size: spread(|b| &b.drift_size[0]),
            own,
        }
    }

    /// What these bounds of the modes, and what the accelerations add for each building, come to at
    /// the floors.
    #[inline(always)]
    pub(crate) fn bounds(
        &self,
        bounds: &Bounds,
        added: &[[f64; QUANTITIES]],
    ) -> [Lane; QUANTITIES] {
        let of = [&bounds.displacement, &bounds.acceleration, &bounds.most].map(|of| &of[0]);
        let mut out = [Lane::ZERO; QUANTITIES];
        for (own, added) in self.own.iter().zip(added) {
            for (out, added) in out.iter_mut().zip(added) {
                *out = add(*out, scale(*added, *own));
            }
        }
        for mode in 0..WIDTH {
            let (size, drift_size) = (self.size[mode], self.drift_size[mode]);
            out[0] = add(out[0], scale(of[0][mode], size));
            out[1] = add(out[1], scale(of[0][mode], drift_size));
            out[2] = add(out[2], scale(of[1][mode], size));
            out[3] = add(out[3], scale(of[2][mode], size));
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three buildings of three, one and two storeys.
    #[test]
    fn one_lane_has_the_sums_of_every_building() {
        let value = |k: usize, l: usize| libm::sin((3 * k + 7 * l) as f64).abs();
        let some = |k: usize| Lane::from_fn(|l| value(k, l));
        let buildings: Vec<Reach> = [0..3, 3..4, 4..6]
            .into_iter()
            .map(|floors: Range<usize>| {
                let own = Lane::from_fn(|l| f64::from(floors.contains(&l)));
                Reach {
                    lane: 0,
                    size: vec![mul(own, some(1))],
                    drift_size: vec![mul(own, some(2))],
                    own: vec![own],
                }
            })
            .collect();
        let bounds = Bounds {
            displacement: vec![some(3)],
            acceleration: vec![some(4)],
            most: vec![some(5)],
        };
        let added: Vec<[f64; QUANTITIES]> = (0..3)
            .map(|b| std::array::from_fn(|k| value(k, b)))
            .collect();
        let seen = OneLane::of_buildings(&buildings).bounds(&bounds, &added);
        for (b, building) in buildings.iter().enumerate() {
            let sums = building.sums(&bounds);
            for (k, (seen, sum)) in seen.iter().zip(sums).enumerate() {
                for l in (0..WIDTH).filter(|l| building.own[0][*l] > 0.0) {
                    let error = (seen[l] - (sum + added[b][k])).abs();
                    assert!(error <= 1e-14, "{b} {k} {l}: {error:e}");
                }
            }
        }
        assert!(seen.iter().all(|lane| lane[6] == 0.0 && lane[7] == 0.0));
    }
}
