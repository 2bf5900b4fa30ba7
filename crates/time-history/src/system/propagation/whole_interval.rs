//! A whole interval of one building without contact as one product of a matrix: the motion at
//! its end, works, bounds, and the courses of all that has peaks.

use nalgebra::DMatrix;
use pounding_vectorised::vectorised;
use std::ops::Range;

use super::product::{RowBlocks, padded, product_and_squares};

/// What comes of an interval of one length. Columns are those of the start: displacements,
/// velocities, acceleration and slope of every load.
#[derive(Debug, Clone)]
pub(super) struct OfLength {
    /// Displacements, velocities, absolute accelerations and their rates at the end.
    pub motion: DMatrix<f64>,
    /// By load, the displacements times masses at the end and their integral over the interval;
    /// the quadratic form of the damping's work; what is squared in the bounds of orders 4 and 6,
    /// two rows of each in turn.
    pub others: DMatrix<f64>,
}

/// Values and rates of functions over an interval: at its start, then at its end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Courses<'a> {
    pub start: [&'a [f64]; 2],
    pub end: [&'a [f64]; 2],
}

/// The matrices of one building with its functions.
#[derive(Debug, Clone, Default)]
pub(super) struct WholeInterval {
    /// By length.
    over: Vec<RowBlocks>,
    /// The functions at the start of an interval.
    start: RowBlocks,
    /// Values of the functions of displacements and of those of absolute accelerations, and their
    /// rates in the same order; what else there is stands after them.
    functions: [Range<usize>; 2],
    /// Masses by load, over the coordinates.
    masses: DMatrix<f64>,
    /// After the last interval, and after the one before.
    now: Vec<f64>,
    before: Vec<f64>,
}

impl WholeInterval {
    /// Functions are rows over the coordinates: over displacements, of which the first are the
    /// coordinates themselves, and over absolute accelerations. The masses are those of the
    /// coordinates with a load, by load.
    pub(super) fn new(
        start: &DMatrix<f64>,
        lengths: &[OfLength],
        functions: [&DMatrix<f64>; 2],
        masses: DMatrix<f64>,
    ) -> Self {
        let (n, columns) = (start.nrows() / 4, start.ncols());
        let [displacements, accelerations] = functions;
        let half = padded(displacements.nrows()) + padded(accelerations.nrows());
        let count = 2 * half;
        // First of the functions, and what they are rows over in the motion.
        let second = padded(displacements.nrows());
        let blocks = [
            (displacements, 0, 0),
            (accelerations, second, 2),
            (displacements, half, 1),
            (accelerations, half + second, 3),
        ];
        let of_motion = |motion: &DMatrix<f64>| {
            let mut all = DMatrix::zeros(count, columns);
            for (rows, first, of) in blocks {
                let of = motion.rows(of * n, n);
                all.rows_mut(first, rows.nrows()).copy_from(&(rows * of));
            }
            all
        };
        let others = lengths.first().map_or(0, |of| of.others.nrows());
        let over = lengths.iter().map(|of| {
            let functions = of_motion(&of.motion);
            RowBlocks::new(count + others, columns, |row, column| {
                match row.checked_sub(count) {
                    None => functions[(row, column)],
                    Some(other) => of.others[(other, column)],
                }
            })
        });
        let at_start = of_motion(start);
        let over: Vec<RowBlocks> = over.collect();
        Self {
            over,
            start: RowBlocks::new(count, columns, |i, j| at_start[(i, j)]),
            functions: [0..half, half..count],
            masses,
            now: vec![0.0; count + padded(others)],
            before: vec![0.0; count + padded(others)],
        }
    }

    /// Begins anew where the next interval does.
    pub(super) fn begin(&mut self, start: &[f64]) {
        let (functions, others) = self.now.split_at_mut(self.functions[1].end);
        for (load, masses) in self.masses.row_iter().enumerate() {
            others[2 * load] = masses.iter().zip(start).map(|(m, u)| m * u).sum();
        }
        self.start.multiply(start, functions);
    }

    /// Leads over an interval from where the last one ended, or from where it was begun; `start`
    /// brings the loads and is given the motion. Returns the work of the damping, and what the
    /// bounds of orders 4 and 6 are the roots of.
    pub(super) fn advance(&mut self, which: usize, start: &mut [f64]) -> (f64, [f64; 2]) {
        let n = self.masses.ncols();
        let (u, v) = start[..2 * n].split_at_mut(n);
        for (out, motion) in [u, v].into_iter().zip(self.motion()) {
            out.copy_from_slice(motion);
        }
        std::mem::swap(&mut self.now, &mut self.before);
        let form = self.functions[1].end + 2 * self.masses.nrows();
        lead(&self.over[which], start, &mut self.now, (form, 4 * n))
    }

    /// Displacements and velocities after the last interval.
    #[inline]
    pub(super) fn motion(&self) -> [&[f64]; 2] {
        let (n, [values, rates]) = (self.masses.ncols(), &self.functions);
        let (u, v) = (&self.now[values.start..], &self.now[rates.start..]);
        [&u[..n], &v[..n]]
    }

    /// The rows of [`OfLength::others`], before the last interval and after it.
    #[inline]
    pub(super) fn others(&self) -> [&[f64]; 2] {
        let first = self.functions[1].end;
        [&self.before[first..], &self.now[first..]]
    }

    /// Functions of displacements, then of absolute accelerations.
    #[inline]
    pub(super) fn courses(&self) -> Courses<'_> {
        let [value, rate] = &self.functions;
        let of = |all| {
            let all: &[f64] = all;
            [&all[value.clone()], &all[rate.clone()]]
        };
        Courses {
            start: of(&self.before),
            end: of(&self.now),
        }
    }
}

/// The product of a matrix with a vector, and of what it comes to the product of the rows of a
/// quadratic form with the vector, and the sums of squares of so many rows after them.
#[vectorised]
fn lead(
    matrix: &RowBlocks,
    x: &[f64],
    out: &mut [f64],
    (form, squared): (usize, usize),
) -> (f64, [f64; 2]) {
    matrix.multiply_inline(x, out);
    let (form, rest) = out[form..].split_at(x.len());
    product_and_squares((form, x), &rest[..squared])
}
