//! Gaps of several widths.

use pounding_study::gap_check::{Amplification, GapCheck};

use super::panel;
use crate::error::ReportError;
use crate::figure::{Curve, figure};

/// Maximum amplification over storeys and records, over the width of a gap, a panel for each
/// quantity with a curve for each building; values that are not finite are left out. `None` for
/// a check that tried no widths.
#[must_use]
pub fn amplifications(check: &GapCheck) -> Option<Result<String, ReportError>> {
    let (sweep, first) = (check.sweep.as_ref()?, check.records.first()?);
    let panels = Amplification::QUANTITIES.map(|(quantity, of)| {
        let curves = first.isolated.iter().enumerate().map(|(index, building)| {
            let points = sweep.widths.iter().enumerate().filter_map(|(i, width)| {
                let value = sweep.over_records(i, index, of)?;
                value.is_finite().then_some((width * 1e3, value))
            });
            Curve {
                name: building.name.clone(),
                points: points.collect(),
            }
        });
        panel(
            &format!("Amplification of {quantity} (-), maximum over storeys and records"),
            "width of the gap (mm)",
            curves.collect(),
        )
    });
    Some(figure(&panels))
}
