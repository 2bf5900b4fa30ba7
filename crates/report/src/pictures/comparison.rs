//! Comparisons of impact models.

use pounding_study::comparison::{Comparison, QuantityKind};

use super::panel;
use crate::error::ReportError;
use crate::figure::{Curve, figure};

/// Peaks over those without pounding, over the models in the order of the tables; a curve
/// a building and record.
///
/// # Errors
/// [`ReportError::Figure`].
pub fn peak_ratios(c: &Comparison) -> Result<String, ReportError> {
    let panel_of = |kind: QuantityKind, name: &str| {
        let quantities = c.quantities.iter().enumerate();
        let curves = quantities
            .filter(|(_, q)| q.kind == kind)
            .flat_map(|(q, quantity)| {
                c.records.iter().enumerate().map(move |(r, record)| {
                    let isolated = c.isolated[r][q];
                    let ratio = |m: usize| ((m + 1) as f64, c.value(m, r, q) / isolated);
                    Curve {
                        name: format!("{}, {record}", quantity.of),
                        points: (0..c.models.len())
                            .map(ratio)
                            .filter(|p| p.1.is_finite())
                            .collect(),
                    }
                })
            });
        panel(
            &format!("Maximum {name} over the storeys, over that without pounding (-)"),
            "number of the model, in the order of the table",
            curves.collect(),
        )
    };
    figure(&[
        panel_of(QuantityKind::Displacement, "displacement"),
        panel_of(QuantityKind::StoreyShear, "storey shear"),
        panel_of(QuantityKind::AccelerationAbsolute, "absolute acceleration"),
    ])
}
