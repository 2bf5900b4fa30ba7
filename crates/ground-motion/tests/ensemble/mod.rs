//! What ensembles of generated motions are held with.
#![allow(dead_code)]

use pounding_ground_motion::generators::TimeGrid;

/// Standard gravity (m/s2).
pub const G: f64 = 9.80665;
/// Motions of an ensemble.
pub const SEEDS: u64 = 1000;

/// Equal up to a part.
pub fn near(found: f64, exact: f64, tolerance: f64) {
    assert!(
        (found - exact).abs() <= tolerance * exact.abs(),
        "{found} for {exact}: off by {:e}",
        found / exact - 1.0
    );
}

/// A mean over seeds with its standard error.
#[derive(Clone, Copy, Default)]
pub struct Mean {
    sum: f64,
    squares: f64,
}

impl Mean {
    pub fn add(&mut self, value: f64) {
        self.sum += value;
        self.squares += value * value;
    }

    pub fn value(&self) -> f64 {
        self.sum / SEEDS as f64
    }

    /// Within three and a half standard errors of theory, which must be a small part of
    /// it: 1 of 2000 such tests fails by chance, and seeds are fixed.
    pub fn meets(&self, exact: f64, largest_error: f64) {
        let n = SEEDS as f64;
        let error = ((self.squares / n - self.value().powi(2)) / n).sqrt();
        assert!(
            error < largest_error * exact,
            "standard error {error} of {exact}"
        );
        let apart = (self.value() - exact) / error;
        assert!(
            apart.abs() < 3.5,
            "{} for {exact}: {apart} standard errors",
            self.value()
        );
    }
}

/// A time step and a duration (s).
pub fn grid(time_step: f64, duration: f64) -> TimeGrid {
    TimeGrid {
        time_step,
        duration,
    }
}

/// `2 int_0^end S(w) f(w) dw` by the trapezoid rule on steps far below the bandwidths.
pub fn two_sided(end: f64, integrand: impl Fn(f64) -> f64) -> f64 {
    let count = 400_000;
    let step = end / f64::from(count);
    let inner: f64 = (1..count).map(|i| integrand(f64::from(i) * step)).sum();
    2.0 * step * (inner + 0.5 * (integrand(0.0) + integrand(end)))
}
