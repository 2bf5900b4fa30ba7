//! Floors, drifts and levels as rows over the modes.

use std::ops::Range;

use pounding_vectorised::vectorised;

use super::lanes::{Lane, Shapes, WIDTH};
use crate::system::{ContactLevel, SectionForce, System};

/// Rows of values that are linear in the displacements of the modes, eight to a lane.
#[derive(Debug, Clone)]
pub(crate) struct Rows {
    pub first_mode: usize,
    /// One lane a mode, from `first_mode` on.
    pub columns: Vec<Lane>,
}

/// One linear function of the modal displacements, over the lanes where it is not zero.
#[derive(Debug, Clone, Default)]
pub(crate) struct ModalRow {
    first_lane: usize,
    weights: Vec<Lane>,
}

impl ModalRow {
    /// Modes of the lanes where it is not zero.
    pub(crate) fn modes(&self) -> Range<usize> {
        let end = self.first_lane + self.weights.len();
        self.first_lane * WIDTH..end * WIDTH
    }

    /// Its weight on a mode.
    pub(crate) fn weight(&self, mode: usize) -> f64 {
        let lane = (mode / WIDTH).checked_sub(self.first_lane);
        let lane = lane.and_then(|c| self.weights.get(c));
        lane.map_or(0.0, |lane| lane[mode % WIDTH])
    }

    /// The same row where only `count` modes from this one on are there.
    pub(crate) fn of_part(&self, first: usize, count: usize) -> Self {
        let own = self.modes();
        let from = own.start.max(first) - first;
        let end = own.end.min(first + count).saturating_sub(first);
        let first_lane = from / WIDTH;
        let lanes = end.div_ceil(WIDTH).saturating_sub(first_lane);
        let weight = |c: usize| {
            Lane::from_fn(|l| {
                let mode = (first_lane + c) * WIDTH + l;
                if mode < count {
                    self.weight(first + mode)
                } else {
                    0.0
                }
            })
        };
        Self {
            first_lane,
            weights: (0..lanes).map(weight).collect(),
        }
    }

    /// Its weights on all of the first `LANES` lanes.
    #[inline(always)]
    pub(crate) fn spread<const LANES: usize>(&self) -> [Lane; LANES] {
        std::array::from_fn(|c| {
            let place = c.checked_sub(self.first_lane);
            let lane = place.and_then(|c| self.weights.get(c));
            lane.copied().unwrap_or(Lane::ZERO)
        })
    }
}

/// Rows of all floors and drifts: what they are does not depend on the gaps.
#[derive(Debug, Clone, Default)]
pub(crate) struct FloorRows {
    pub floors: Vec<ModalRow>,
    pub drifts: Vec<ModalRow>,
    /// Forces in sections, as [`System::sections`] has them.
    pub sections: Vec<ModalRow>,
    /// Maximum entry of each mode at any floor, and of any difference from floor to floor.
    pub size: Vec<Lane>,
    pub drift_size: Vec<Lane>,
}

/// Rows of all levels: left floor less right one.
#[derive(Debug, Clone)]
pub(crate) struct LevelRows {
    pub levels: Vec<ModalRow>,
}

impl ModalRow {
    fn new(parts: &[(Vec<Lane>, usize, f64)]) -> Self {
        let first = parts.iter().map(|p| p.1).min().unwrap_or(0);
        let end = parts.iter().map(|p| p.1 + p.0.len()).max().unwrap_or(0);
        let mut weights = vec![Lane::ZERO; end - first];
        for (lanes, at, factor) in parts {
            for (weight, lane) in weights[at - first..].iter_mut().zip(lanes) {
                for l in 0..WIDTH {
                    weight[l] += factor * lane[l];
                }
            }
        }
        Self {
            first_lane: first,
            weights,
        }
    }

    /// Its value for these modal displacements.
    #[inline(always)]
    pub(crate) fn dot(&self, x: &[Lane]) -> f64 {
        let mut sum = Lane::ZERO;
        for (w, x) in self.weights.iter().zip(&x[self.first_lane..]) {
            let (w, x) = (*w, *x);
            for l in 0..WIDTH {
                sum[l] += w[l] * x[l];
            }
        }
        total(&sum)
    }

    /// Its values for displacements that stand one after another, so many lanes each.
    pub(crate) fn dot_all(&self, x: &[Lane], lanes: usize, out: &mut [f64]) {
        dot_all(self, x, lanes, out);
    }

    /// Its values for displacements, velocities, accelerations and jerks, with the bits of
    /// [`ModalRow::dot`].
    pub(crate) fn dot_motion(&self, motion: &[Vec<Lane>; 4]) -> [f64; 4] {
        dot_motion(self, motion)
    }

    /// Two values, with the bits of [`ModalRow::dot`].
    pub(crate) fn dot_two(&self, x: [&[Lane]; 2]) -> [f64; 2] {
        dot_two(self, x)
    }

    /// Three values, with the bits of [`ModalRow::dot`].
    pub(crate) fn dot_three(&self, x: [&[Lane]; 3]) -> [f64; 3] {
        dot_three(self, x)
    }

    /// Four values in the time of one, with the bits of [`ModalRow::dot`].
    #[inline(always)]
    fn dot_four(&self, [a, b, c, d]: [&[Lane]; 4]) -> [f64; 4] {
        let mut sums = [Lane::ZERO; 4];
        let end = self.first_lane + self.weights.len();
        let within = self.first_lane..end;
        let (a, b) = (&a[within.clone()], &b[within.clone()]);
        let (c, d) = (&c[within.clone()], &d[within]);
        for (i, w) in self.weights.iter().enumerate() {
            let (w, x) = (*w, [a[i], b[i], c[i], d[i]]);
            for v in 0..4 {
                for l in 0..WIDTH {
                    sums[v][l] += w[l] * x[v][l];
                }
            }
        }
        [
            total(&sums[0]),
            total(&sums[1]),
            total(&sums[2]),
            total(&sums[3]),
        ]
    }

    /// Product of two rows.
    pub(crate) fn product(&self, other: &Self) -> f64 {
        let ends = [self, other].map(|r| r.first_lane + r.weights.len());
        let first = self.first_lane.max(other.first_lane);
        let mut sum = Lane::ZERO;
        for c in first..ends[0].min(ends[1]) {
            let (a, b) = (
                self.weights[c - self.first_lane],
                other.weights[c - other.first_lane],
            );
            for l in 0..WIDTH {
                sum[l] += a[l] * b[l];
            }
        }
        total(&sum)
    }

    /// Sum of the magnitudes that [`ModalRow::dot`] adds.
    #[inline(always)]
    pub(crate) fn dot_magnitudes(&self, x: &[Lane]) -> f64 {
        let mut sum = Lane::ZERO;
        for (w, x) in self.weights.iter().zip(&x[self.first_lane..]) {
            for l in 0..WIDTH {
                sum[l] += (w[l] * x[l]).abs();
            }
        }
        total(&sum)
    }

    /// Adds a multiple of the row.
    #[inline(always)]
    pub(crate) fn add(&self, factor: f64, out: &mut [Lane]) {
        for (w, x) in self.weights.iter().zip(&mut out[self.first_lane..]) {
            let (w, mut sum) = (*w, *x);
            for l in 0..WIDTH {
                sum[l] += factor * w[l];
            }
            *x = sum;
        }
    }
}

/// Sum of a lane, in pairs: the same bits whatever the instruction set.
#[inline(always)]
pub(crate) fn total(x: &Lane) -> f64 {
    // Keeps the compiler from taking the vectors before it apart for the sake of the sum.
    let x = std::hint::black_box(x);
    let half: [f64; 4] = std::array::from_fn(|l| x[l] + x[l + 4]);
    let quarter = [half[0] + half[2], half[1] + half[3]];
    quarter[0] + quarter[1]
}

/// Four values of a row.
#[vectorised]
fn dot_motion(row: &ModalRow, [q, p, a, j]: &[Vec<Lane>; 4]) -> [f64; 4] {
    row.dot_four([q, p, a, j])
}

/// Two values of a row.
#[vectorised]
fn dot_two(row: &ModalRow, x: [&[Lane]; 2]) -> [f64; 2] {
    x.map(|x| row.dot(x))
}

/// Three values of a row.
#[vectorised]
fn dot_three(row: &ModalRow, [a, b, c]: [&[Lane]; 3]) -> [f64; 3] {
    [row.dot(a), row.dot(b), row.dot(c)]
}

/// Values of a row for displacements that stand one after another.
#[vectorised]
fn dot_all(row: &ModalRow, x: &[Lane], lanes: usize, out: &mut [f64]) {
    let mut place = 0;
    let at = |k: usize| &x[k * lanes..(k + 1) * lanes];
    while place + 4 <= out.len() {
        let four = [at(place), at(place + 1), at(place + 2), at(place + 3)];
        out[place..place + 4].copy_from_slice(&row.dot_four(four));
        place += 4;
    }
    for k in place..out.len() {
        out[k] = row.dot(at(k));
    }
}

/// Closings of these levels (m) at these displacements of the modes.
#[vectorised]
pub(crate) fn closings(rows: &LevelRows, levels: &[usize], q: &[Lane], out: &mut [f64]) {
    for l in levels {
        out[*l] = rows.levels[*l].dot(q);
    }
}

impl FloorRows {
    /// Bound of a function of any floor whose modal parts have these magnitudes.
    #[inline(always)]
    pub(crate) fn bound(&self, magnitudes: &[Lane]) -> f64 {
        let mut sum = Lane::ZERO;
        for (size, part) in self.size.iter().zip(magnitudes) {
            for l in 0..WIDTH {
                sum[l] += size[l] * part[l].abs();
            }
        }
        total(&sum)
    }

    pub(super) fn new((inverse, building): (&[Shapes], &[usize]), system: &System) -> Self {
        let mass = system.mass();
        // Columns of Phi' M over the masses are the floors' rows of Phi.
        let floor = |i: usize, sign: f64| -> (Vec<Lane>, usize, f64) {
            let inverse = &inverse[building[i]];
            let local = i - inverse.first_mode;
            let column = (0..inverse.lanes).map(|k| inverse.columns[k * inverse.modes + local]);
            (column.collect(), inverse.first_lane, sign / mass[i])
        };
        let drift = |i: usize| match i.checked_sub(1) {
            Some(b) if building[b] == building[i] => {
                ModalRow::new(&[floor(i, 1.0), floor(b, -1.0)])
            }
            _ => ModalRow::new(&[floor(i, 1.0)]),
        };
        let rows = 0..mass.len();
        let floors: Vec<_> = rows
            .clone()
            .map(|i| ModalRow::new(&[floor(i, 1.0)]))
            .collect();
        let drifts: Vec<_> = rows.map(drift).collect();
        let section = |force: &SectionForce| {
            let parts = force.terms().map(|(i, weight)| floor(i, weight));
            ModalRow::new(&parts.collect::<Vec<_>>())
        };
        let largest = |rows: &[ModalRow]| {
            let mut size = vec![Lane::ZERO; mass.len().div_ceil(WIDTH)];
            for row in rows {
                for (w, s) in row.weights.iter().zip(&mut size[row.first_lane..]) {
                    for l in 0..WIDTH {
                        s[l] = s[l].max(w[l].abs());
                    }
                }
            }
            size
        };
        Self {
            size: largest(&floors),
            drift_size: largest(&drifts),
            sections: system.sections().iter().map(section).collect(),
            drifts,
            floors,
        }
    }
}

impl LevelRows {
    pub(crate) fn new(rows: &FloorRows, system: &System) -> Self {
        let floor = |i: usize, sign: f64| -> (Vec<Lane>, usize, f64) {
            let row = &rows.floors[i];
            (row.weights.clone(), row.first_lane, sign)
        };
        let row = |level: &ContactLevel| {
            let left = level.left.map(|i| floor(i, 1.0));
            let right = level.right.map(|i| floor(i, -1.0));
            ModalRow::new(&left.into_iter().chain(right).collect::<Vec<_>>())
        };
        let levels: Vec<_> = system.levels().iter().map(row).collect();
        Self { levels }
    }

    /// Rows of these levels over `count` modes from `first` on; those of the others are empty.
    pub(crate) fn part(&self, levels: &[usize], first: usize, count: usize) -> Self {
        let mut part = vec![ModalRow::default(); self.levels.len()];
        for l in levels {
            part[*l] = self.levels[*l].of_part(first, count);
        }
        Self { levels: part }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_values_of_a_row_have_the_bits_of_one_after_another() {
        let lane = |seed: usize| Lane::from_fn(|l| libm::sin((seed * WIDTH + l) as f64));
        let lanes = 53;
        let x: Vec<Lane> = (0..lanes * 23).map(|c| lane(c + 7)).collect();
        let row = ModalRow {
            first_lane: 5,
            weights: (0..31).map(lane).collect(),
        };
        for count in [1, 4, 6, 23] {
            let mut all = vec![f64::NAN; count];
            row.dot_all(&x, lanes, &mut all);
            for (k, value) in all.iter().enumerate() {
                let one = row.dot(&x[k * lanes..(k + 1) * lanes]);
                assert_eq!(value.to_bits(), one.to_bits(), "{k} of {count}");
            }
        }
    }
}
