//! What publications print, the collisions they print it of, and independent
//! reference values where nothing or only a figure is printed.

pub mod borovin_2014;
pub mod papi_toopchi_2022;
pub mod restitution;
pub mod zhou_2012;

use crate::restitution_table::REQUESTED;

/// Mean of `100 |achieved - requested| / requested` (%) over the requested
/// restitutions of [`REQUESTED`] from `least` to `greatest`, for values that are no
/// plain collisions, such as readings.
#[must_use]
pub fn mean_error_percent(achieved: &[f64; 10], least: f64, greatest: f64) -> f64 {
    let errors: Vec<f64> = REQUESTED
        .iter()
        .zip(achieved)
        .filter(|(e, _)| **e > least - 1e-9 && **e < greatest + 1e-9)
        .map(|(e, achieved)| 100.0 * (achieved - e).abs() / e)
        .collect();
    errors.iter().sum::<f64>() / errors.len() as f64
}
