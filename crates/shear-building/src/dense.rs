//! Products of full matrices.

use nalgebra::DMatrix;
use pounding_vectorised::vectorised;

/// Columns that are taken in one go.
const COLUMNS: usize = 4;

/// `out = A x`, column by column, as they stand in memory, a few in one go.
pub(crate) fn multiply(matrix: &DMatrix<f64>, x: &[f64], out: &mut [f64]) {
    for out in out.iter_mut() {
        *out = -0.0;
    }
    let n = out.len();
    for (columns, x) in matrix.as_slice().chunks(COLUMNS * n).zip(x.chunks(COLUMNS)) {
        if let (Ok(x), true) = (<&[f64; COLUMNS]>::try_from(x), n > 0) {
            add_columns(columns, x, out);
            continue;
        }
        for (column, x) in columns.chunks(n).zip(x) {
            for (o, c) in out.iter_mut().zip(column) {
                *o += c * x;
            }
        }
    }
}

/// Adds multiples of a few columns, one after another in every place.
#[vectorised]
fn add_columns(columns: &[f64], x: &[f64; COLUMNS], out: &mut [f64]) {
    let n = out.len();
    let [a, b, c, d] = std::array::from_fn(|k| &columns[k * n..(k + 1) * n]);
    for i in 0..n {
        let sum = out[i] + a[i] * x[0];
        out[i] = ((sum + b[i] * x[1]) + c[i] * x[2]) + d[i] * x[3];
    }
}
