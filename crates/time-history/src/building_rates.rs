//! How fast buildings can move by themselves.

use pounding_shear_building::{DampingMatrix, ShearBuilding};
use std::sync::Arc;

/// Bound of the magnitudes of all eigenvalues of free motion (1/s). Below critical
/// damping it is the maximum circular frequency; above it a mode forgets its velocity
/// faster than it would swing.
pub(crate) fn fastest_rate(buildings: &[Arc<ShearBuilding>]) -> f64 {
    let rates = buildings.iter().map(|b| {
        if b.damping().couples_modes() {
            coupled(b)
        } else {
            uncoupled(b)
        }
    });
    rates.fold(0.0, f64::max)
}

/// Exact: `omega`, or `omega (zeta + sqrt(zeta^2 - 1))` above critical damping.
fn uncoupled(building: &ShearBuilding) -> f64 {
    let modes = building.modes();
    let pairs = modes.circular_frequency.iter().zip(&modes.damping_ratio);
    pairs
        .map(|(omega, zeta)| omega * (zeta + (zeta * zeta - 1.0).max(0.0).sqrt()).max(1.0))
        .fold(0.0, f64::max)
}

/// An eigenvalue `s` solves `s^2 + c s + w = 0` with the Rayleigh quotients of its
/// vector, `c` at most the maximum eigenvalue of `M^-1 C` and `w` that of `M^-1 K`:
/// `|s| = sqrt(w)` if it is complex, `|s| <= c` if it is real.
fn coupled(building: &ShearBuilding) -> f64 {
    let omega = building.modes().circular_frequency.iter();
    omega.copied().fold(damping_rate(building), f64::max)
}

/// Bound of the eigenvalues of `M^-1/2 C M^-1/2` by Gershgorin's discs.
pub(crate) fn damping_rate(building: &ShearBuilding) -> f64 {
    let (n, mass) = (building.coordinates(), building.inertia());
    let entry = |i: usize, j: usize| building.damping_matrix().entry(i, j);
    let row = |i: usize| -> f64 {
        let columns = match building.damping_matrix() {
            DampingMatrix::Tridiagonal(_) => i.saturating_sub(1)..n.min(i + 2),
            DampingMatrix::Dense(_) => 0..n,
        };
        columns
            .map(|j| entry(i, j).abs() / (mass[i] * mass[j]).sqrt())
            .sum()
    };
    (0..n).map(row).fold(0.0, f64::max)
}
