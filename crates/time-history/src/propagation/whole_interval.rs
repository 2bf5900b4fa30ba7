//! A whole interval of one building without contact as one product of a matrix: the motion at
//! its end, works, bounds, and the courses of all that has peaks.

use nalgebra::DMatrix;
use std::ops::Range;

use super::product::{RowBlocks, padded};

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
    /// Displacements and velocities and what else is not a function; then values of the functions
    /// of displacements and of those of absolute accelerations, and their rates in the same order.
    others: usize,
    functions: [Range<usize>; 2],
    /// Masses by load, over the coordinates.
    masses: DMatrix<f64>,
    /// After the last interval, and after the one before.
    now: Vec<f64>,
    before: Vec<f64>,
}

impl WholeInterval {
    /// Functions are rows over the coordinates: over displacements, and over absolute
    /// accelerations. The masses are those of the coordinates with a load, by load.
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
        let others = 2 * n + lengths.first().map_or(0, |of| of.others.nrows());
        let first = padded(others);
        let over = lengths.iter().map(|of| {
            let functions = of_motion(&of.motion);
            RowBlocks::new(first + count, columns, |row, column| {
                if row < 2 * n {
                    of.motion[(row, column)]
                } else if row < others {
                    of.others[(row - 2 * n, column)]
                } else if row < first {
                    0.0
                } else {
                    functions[(row - first, column)]
                }
            })
        });
        let at_start = of_motion(start);
        let over: Vec<RowBlocks> = over.collect();
        Self {
            over,
            start: RowBlocks::new(count, columns, |i, j| at_start[(i, j)]),
            others: first,
            functions: [first..first + half, first + half..first + count],
            masses,
            now: vec![0.0; first + count],
            before: vec![0.0; first + count],
        }
    }

    /// Begins anew where the next interval does.
    pub(super) fn begin(&mut self, start: &[f64]) {
        let n = self.masses.ncols();
        self.now[..2 * n].copy_from_slice(&start[..2 * n]);
        for (load, masses) in self.masses.row_iter().enumerate() {
            let sum = masses.iter().zip(start).map(|(m, u)| m * u).sum();
            self.now[2 * n + 2 * load] = sum;
        }
        self.start.multiply(start, &mut self.now[self.others..]);
    }

    /// Leads over an interval from where the last one ended, or from where it was begun; `start`
    /// brings the loads and is given the motion.
    pub(super) fn advance(&mut self, which: usize, start: &mut [f64]) {
        let motion = 2 * self.masses.ncols();
        start[..motion].copy_from_slice(&self.now[..motion]);
        std::mem::swap(&mut self.now, &mut self.before);
        self.over[which].multiply(start, &mut self.now);
    }

    /// Displacements and velocities and the rows of [`OfLength::others`], before the last
    /// interval and after it.
    pub(super) fn others(&self) -> [&[f64]; 2] {
        [&self.before, &self.now].map(Vec::as_slice)
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
