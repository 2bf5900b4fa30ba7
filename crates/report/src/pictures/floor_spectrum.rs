//! Response spectra of floors.

use pounding_catalogue::STANDARD_GRAVITY as G;

use super::motion::{over_period, percent};
use super::{over, panel};
use crate::chart::Chart;

/// Spectra of a floor, of one damping ratio.
#[derive(Debug, Clone)]
pub struct Floor<'s> {
    /// What the floor is called.
    pub title: String,
    /// Damping ratio (-).
    pub damping: f64,
    /// Periods (s).
    pub periods: &'s [f64],
    /// What each spectrum is of, and its absolute accelerations (m/s2).
    pub spectra: Vec<(&'static str, &'s [f64])>,
}

/// Absolute acceleration over the period, axes for each floor and damping ratio, whose title stands above them.
#[must_use]
pub fn spectra(floors: &[Floor<'_>]) -> Chart {
    let panels = floors.iter().map(|floor| {
        let damping = percent(floor.damping);
        let caption = format!("Absolute acceleration (g) on {}, {damping}", floor.title);
        let curves = floor.spectra.iter();
        let curves = curves.map(|(name, values)| {
            let mut curve = over(name, floor.periods, values, 1.0 / G);
            // In the order of the periods, which stand as they were asked for.
            curve.points.sort_by(|a, b| a.0.total_cmp(&b.0));
            curve
        });
        panel(&caption, "period (s)", curves.collect())
    });
    over_period(&panels.collect::<Vec<_>>())
}
