//! Response spectra of floors.

use pounding_catalogue::STANDARD_GRAVITY as G;
use pounding_ground_motion::spectra::ResponseSpectrum;

use super::motion::{over_period, percent};
use super::{over, panel};
use crate::chart::Chart;

/// Spectra of a floor, of one damping ratio.
#[derive(Debug, Clone, Copy)]
pub struct Curves<'s> {
    /// Of the ground under the building.
    pub ground: &'s ResponseSpectrum,
    /// With pounding.
    pub pounding: &'s ResponseSpectrum,
    /// Of the building alone.
    pub alone: Option<&'s ResponseSpectrum>,
}

/// Absolute acceleration over the period, axes for each floor, whose title stands above them, and damping ratio.
#[must_use]
pub fn spectra(floors: &[(String, Curves<'_>)]) -> Chart {
    let panels = floors.iter().map(|(title, curves)| {
        let damping = percent(curves.pounding.damping);
        let caption = format!("Absolute acceleration (g) on {title}, {damping}");
        let curve =
            |name: &str, s: &ResponseSpectrum| over(name, &s.periods, &s.acceleration, 1.0 / G);
        let mut all = vec![curve("with pounding", curves.pounding)];
        all.extend(curves.alone.map(|alone| curve("building alone", alone)));
        all.push(curve("ground", curves.ground));
        panel(&caption, "period (s)", all)
    });
    over_period(&panels.collect::<Vec<_>>())
}
