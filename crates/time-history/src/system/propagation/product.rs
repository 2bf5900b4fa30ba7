//! Products of matrices with vectors. Every sum runs over the columns in their order, so that
//! the bits of a row depend neither on the processor nor on the rows beside it.

use pounding_vectorised::vectorised;

/// Rows that are summed side by side; outputs of a multiple of the least one need no others.
const WIDEST: usize = 32;
const WIDE: usize = 16;
const MIDDLE: usize = 8;
pub(crate) const NARROW: usize = 4;

/// Rows with what fills them up to a multiple of the narrow block.
pub(crate) fn padded(rows: usize) -> usize {
    rows.next_multiple_of(NARROW)
}

/// Columns filled up with zeros to the padded number of rows, one after another.
pub(crate) fn pad(rows: usize, columns: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all = Vec::new();
    for (k, x) in columns.enumerate() {
        all.push(x);
        if k % rows == rows - 1 {
            all.resize(all.len() - rows + padded(rows), 0.0);
        }
    }
    all
}

/// Product of the first `out.len()` rows of a matrix, whose columns of `rows` entries stand one
/// after another.
pub(crate) fn multiply(matrix: &[f64], rows: usize, x: &[f64], out: &mut [f64]) {
    out.fill(0.0);
    accumulate(matrix, rows, x, out);
}

/// Adds that product.
#[vectorised]
fn accumulate(matrix: &[f64], rows: usize, x: &[f64], out: &mut [f64]) {
    add_product(matrix, rows, x, out);
}

/// The same for callers that are compiled for several instruction sets themselves.
#[inline(always)]
pub(crate) fn add_product(matrix: &[f64], rows: usize, x: &[f64], out: &mut [f64]) {
    let mut first = 0;
    while first + WIDEST <= out.len() {
        block::<WIDEST>(matrix, (rows, first), x, out);
        first += WIDEST;
    }
    if first + WIDE <= out.len() {
        block::<WIDE>(matrix, (rows, first), x, out);
        first += WIDE;
    }
    if first + MIDDLE <= out.len() {
        block::<MIDDLE>(matrix, (rows, first), x, out);
        first += MIDDLE;
    }
    if first + NARROW <= out.len() {
        block::<NARROW>(matrix, (rows, first), x, out);
        first += NARROW;
    }
    while first < out.len() {
        block::<1>(matrix, (rows, first), x, out);
        first += 1;
    }
}

#[inline(always)]
fn block<const ROWS: usize>(
    matrix: &[f64],
    (rows, first): (usize, usize),
    x: &[f64],
    out: &mut [f64],
) {
    let out = &mut out[first..first + ROWS];
    let mut sums = [0.0; ROWS];
    sums.copy_from_slice(out);
    for (column, x) in matrix.chunks_exact(rows).zip(x) {
        let entries = &column[first..first + ROWS];
        for k in 0..ROWS {
            sums[k] += entries[k] * x;
        }
    }
    out.copy_from_slice(&sums);
}

/// A matrix for products of all its rows: in blocks of rows that are summed side by side, each
/// column after column, filled up with zeros to the padded number of rows.
#[derive(Debug, Clone, Default)]
pub(crate) struct RowBlocks {
    columns: usize,
    entries: Vec<f64>,
}

impl RowBlocks {
    pub(crate) fn new(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let all = padded(rows);
        let mut entries = Vec::with_capacity(all * columns);
        let mut first = 0;
        while first < all {
            let widths = [WIDEST, WIDE, MIDDLE, NARROW];
            let width = widths.into_iter().find(|w| first + w <= all);
            let width = width.unwrap_or(NARROW);
            for column in 0..columns {
                let own = first..first + width;
                entries.extend(own.map(|row| if row < rows { entry(row, column) } else { 0.0 }));
            }
            first += width;
        }
        Self { columns, entries }
    }

    /// The product with a vector; `out` takes the padded number of rows.
    pub(crate) fn multiply(&self, x: &[f64], out: &mut [f64]) {
        multiply_blocks(&self.entries, &x[..self.columns], out);
    }

    /// The same for callers that are compiled for several instruction sets themselves.
    #[inline(always)]
    pub(crate) fn multiply_inline(&self, x: &[f64], out: &mut [f64]) {
        blocks(&self.entries, x, out);
    }

    /// The product with two vectors whose elements stand in turn.
    #[inline(always)]
    pub(crate) fn multiply_in_turn(&self, x: [&[f64]; 2], out: &mut [f64]) {
        blocks(&self.entries, x, out);
    }
}

#[vectorised]
fn multiply_blocks(entries: &[f64], x: &[f64], out: &mut [f64]) {
    blocks(entries, x, out);
}

/// What the columns of a matrix are multiplied by.
trait Columns: Copy {
    /// Adds the columns of a block; returns what is left.
    fn add<'a, const ROWS: usize>(self, entries: &'a [f64], sums: &mut [f64; ROWS]) -> &'a [f64];
}

#[inline(always)]
fn blocks(entries: &[f64], x: impl Columns, out: &mut [f64]) {
    let mut left = (entries, out);
    while left.1.len() >= WIDEST {
        left = take_block::<WIDEST>(left, x);
    }
    if left.1.len() >= WIDE {
        left = take_block::<WIDE>(left, x);
    }
    if left.1.len() >= MIDDLE {
        left = take_block::<MIDDLE>(left, x);
    }
    if left.1.len() >= NARROW {
        take_block::<NARROW>(left, x);
    }
}

/// The first block of rows; returns what is left.
#[inline(always)]
fn take_block<'a, const ROWS: usize>(
    (entries, out): (&'a [f64], &'a mut [f64]),
    x: impl Columns,
) -> (&'a [f64], &'a mut [f64]) {
    let (own, out) = out.split_at_mut(ROWS);
    let mut sums = [0.0; ROWS];
    let entries = x.add(entries, &mut sums);
    own.copy_from_slice(&sums);
    (entries, out)
}

impl Columns for &[f64] {
    #[inline(always)]
    fn add<'a, const ROWS: usize>(self, entries: &'a [f64], sums: &mut [f64; ROWS]) -> &'a [f64] {
        let n = self.len();
        let (block, rest) = entries.split_at(ROWS * n);
        let columns = &block.as_chunks::<ROWS>().0[..n];
        for j in 0..n {
            let (column, x) = (&columns[j], self[j]);
            for k in 0..ROWS {
                sums[k] += column[k] * x;
            }
        }
        rest
    }
}

impl Columns for [&[f64]; 2] {
    #[inline(always)]
    fn add<'a, const ROWS: usize>(self, entries: &'a [f64], sums: &mut [f64; ROWS]) -> &'a [f64] {
        let n = self[0].len();
        let (block, rest) = entries.split_at(2 * ROWS * n);
        let columns = &block.as_chunks::<ROWS>().0.as_chunks::<2>().0[..n];
        let (x, y) = (self[0], &self[1][..n]);
        for j in 0..n {
            let ([a, b], x, y) = (&columns[j], x[j], y[j]);
            for k in 0..ROWS {
                sums[k] += a[k] * x;
            }
            for k in 0..ROWS {
                sums[k] += b[k] * y;
            }
        }
        rest
    }
}

/// The product of two vectors, and sums of squares of values of which two belong to the one and
/// two to the other sum, in turn.
#[inline(always)]
pub(crate) fn product_and_squares((a, b): (&[f64], &[f64]), squared: &[f64]) -> (f64, [f64; 2]) {
    let (a, rest_of_a) = a.as_chunks::<NARROW>();
    let (b, rest_of_b) = b.as_chunks::<NARROW>();
    let (n, mut sums) = (a.len(), [0.0; NARROW]);
    let b = &b[..n];
    for k in 0..n {
        for i in 0..NARROW {
            sums[i] += a[k][i] * b[k][i];
        }
    }
    let mut rest = 0.0;
    for k in 0..rest_of_a.len().min(rest_of_b.len()) {
        rest += rest_of_a[k] * rest_of_b[k];
    }
    let product = sums[0] + sums[1] + (sums[2] + sums[3]) + rest;
    let mut sums = [0.0; NARROW];
    for block in squared.as_chunks::<NARROW>().0 {
        for i in 0..NARROW {
            sums[i] += block[i] * block[i];
        }
    }
    (product, [sums[0] + sums[1], sums[2] + sums[3]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_rows_give_the_bits_of_columns() {
        for rows in [1, 4, 7, 12, 29, 44, 64, 83, 92] {
            let entry = |i: usize, j: usize| libm::sin((i * 7 + j * 3) as f64);
            let x: Vec<f64> = (0..9).map(|j| libm::cos(j as f64)).collect();
            let columns = (0..9).flat_map(|j| (0..rows).map(move |i| entry(i, j)));
            let mut by_columns = vec![1.0; padded(rows)];
            let matrix = pad(rows, columns);
            multiply(&matrix, padded(rows), &x, &mut by_columns);
            let mut by_blocks = vec![2.0; padded(rows)];
            RowBlocks::new(rows, 9, entry).multiply(&x, &mut by_blocks);
            assert_eq!(by_columns, by_blocks, "{rows} rows");
            let in_turn = RowBlocks::new(rows, 8, entry);
            let halves = [0, 1].map(|odd| [0, 2, 4, 6].map(|j| x[j + odd]));
            multiply(&matrix, padded(rows), &x[..8], &mut by_columns);
            in_turn.multiply_in_turn(halves.each_ref().map(<[f64; 4]>::as_slice), &mut by_blocks);
            assert_eq!(by_columns, by_blocks, "{rows} rows");
        }
    }
}
