//! Stiffness and damping of all buildings as two bands of three.

use pounding_shear_building::{DampingMatrix, ShearBuilding, StiffnessMatrix};
use pounding_vectorised::vectorised;
use std::sync::Arc;

/// Tridiagonal stiffness and damping of all buildings, without links between them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Bands {
    stiffness: Band,
    damping: Band,
}

/// A tridiagonal matrix by rows: entries left of, on and right of the diagonal.
#[derive(Debug, Clone, Default)]
struct Band {
    left: Vec<f64>,
    diagonal: Vec<f64>,
    right: Vec<f64>,
}

impl Band {
    fn push(&mut self, diagonal: &[f64], off_diagonal: &[f64]) {
        for (i, d) in diagonal.iter().enumerate() {
            let before = i.checked_sub(1).and_then(|k| off_diagonal.get(k));
            self.left.push(before.copied().unwrap_or(0.0));
            self.diagonal.push(*d);
            self.right.push(off_diagonal.get(i).copied().unwrap_or(0.0));
        }
    }

    fn divide(&mut self, by: &[f64]) {
        for row in [&mut self.left, &mut self.diagonal, &mut self.right] {
            for (x, by) in row.iter_mut().zip(by) {
                *x /= by;
            }
        }
    }
}

/// All rows of [`Bands::internal_forces`] but the first and the last.
#[vectorised]
fn inner(bands: &Bands, u: &[f64], v: &[f64], out: &mut [f64], damping: &mut [f64]) {
    let m = out.len() - 2;
    let (k, c) = (&bands.stiffness, &bands.damping);
    let (kl, kd, kr) = (&k.left[1..=m], &k.diagonal[1..=m], &k.right[1..=m]);
    let (cl, cd, cr) = (&c.left[1..=m], &c.diagonal[1..=m], &c.right[1..=m]);
    let (u0, u1, u2) = (&u[..m], &u[1..=m], &u[2..m + 2]);
    let (v0, v1, v2) = (&v[..m], &v[1..=m], &v[2..m + 2]);
    let (out, damping) = (&mut out[1..=m], &mut damping[1..=m]);
    for i in 0..m {
        let spring = kl[i] * u0[i] + kd[i] * u1[i] + kr[i] * u2[i];
        let dashpot = cl[i] * v0[i] + cd[i] * v1[i] + cr[i] * v2[i];
        damping[i] = dashpot;
        out[i] = -(spring + dashpot);
    }
}

impl Bands {
    /// `None` if a matrix of a building is not tridiagonal.
    pub(crate) fn of(buildings: &[Arc<ShearBuilding>]) -> Option<Self> {
        let mut this = Self::default();
        for building in buildings {
            let DampingMatrix::Tridiagonal(c) = building.damping_matrix() else {
                return None;
            };
            let StiffnessMatrix::Tridiagonal(k) = building.stiffness_matrix() else {
                return None;
            };
            this.stiffness.push(&k.diagonal, &k.off_diagonal);
            this.damping.push(&c.diagonal, &c.off_diagonal);
        }
        Some(this)
    }

    /// Divides every row.
    pub(crate) fn divide(&mut self, by: &[f64]) {
        self.stiffness.divide(by);
        self.damping.divide(by);
    }

    /// Maximum sums of magnitudes in a row of stiffness and of damping.
    pub(crate) fn largest_rows(&self) -> [f64; 2] {
        [&self.stiffness, &self.damping].map(|band| {
            let rows = band.left.iter().zip(&band.diagonal).zip(&band.right);
            let sums =
                rows.map(|((left, diagonal), right)| left.abs() + diagonal.abs() + right.abs());
            sums.fold(0.0, f64::max)
        })
    }

    /// `out = -(K u + C v)` and `damping = C v`.
    pub(crate) fn internal_forces(
        &self,
        u: &[f64],
        v: &[f64],
        out: &mut [f64],
        damping: &mut [f64],
    ) {
        let n = out.len();
        let row = |b: &Band, x: &[f64], i: usize| {
            let before = if i > 0 { b.left[i] * x[i - 1] } else { 0.0 };
            let after = if i + 1 < n {
                b.right[i] * x[i + 1]
            } else {
                0.0
            };
            before + b.diagonal[i] * x[i] + after
        };
        for i in [0, n - 1] {
            damping[i] = row(&self.damping, v, i);
            out[i] = -(row(&self.stiffness, u, i) + damping[i]);
        }
        if n > 2 {
            inner(self, u, v, out, damping);
        }
    }

    /// `out = -(K u + C v)`; `u` and `v` have one more value on either side, which does
    /// not matter.
    #[inline(always)]
    pub(crate) fn resist(&self, u: &[f64], v: &[f64], out: &mut [f64]) {
        let n = out.len();
        let (k, c) = (&self.stiffness, &self.damping);
        let (kl, kd, kr) = (&k.left[..n], &k.diagonal[..n], &k.right[..n]);
        let (cl, cd, cr) = (&c.left[..n], &c.diagonal[..n], &c.right[..n]);
        let (u0, u1, u2) = (&u[..n], &u[1..=n], &u[2..n + 2]);
        let (v0, v1, v2) = (&v[..n], &v[1..=n], &v[2..n + 2]);
        for i in 0..n {
            let spring = kl[i] * u0[i] + kd[i] * u1[i] + kr[i] * u2[i];
            let dashpot = cl[i] * v0[i] + cd[i] * v1[i] + cr[i] * v2[i];
            out[i] = -(spring + dashpot);
        }
    }
}
