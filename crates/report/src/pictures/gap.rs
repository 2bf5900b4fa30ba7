//! Gaps of several widths.

use super::panel;
use crate::error::ReportError;
use crate::figure::{Curve, figure};

/// Names of buildings, each with a value by width.
pub type ByBuilding<'n> = Vec<(&'n str, Vec<Option<f64>>)>;

/// Amplification over the width (m) of a gap, a panel for each quantity with a curve for each
/// building: its values by width, of which those that are not finite are left out.
///
/// # Errors
/// [`ReportError::Figure`].
pub fn amplifications(
    widths: &[f64],
    quantities: &[(&str, ByBuilding<'_>)],
) -> Result<String, ReportError> {
    let curve = |(name, values): &(&str, Vec<Option<f64>>)| {
        let points = widths.iter().zip(values).filter_map(|(width, value)| {
            let value = value.filter(|x| x.is_finite())?;
            Some((width * 1e3, value))
        });
        Curve {
            name: (*name).to_owned(),
            points: points.collect(),
        }
    };
    let panels = quantities.iter().map(|(quantity, buildings)| {
        panel(
            &format!("Amplification of {quantity} (-), maximum over storeys and records"),
            "width of the gap (mm)",
            buildings.iter().map(curve).collect(),
        )
    });
    figure(&panels.collect::<Vec<_>>())
}
