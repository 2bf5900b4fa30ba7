//! Tables and pictures of the comparison.

use pounding_study::comparison::{Comparison, QuantityKind};

use super::super::gap::csv;
use crate::failure::Failure;
use crate::plot::{Curve, Panel, figure as draw};

/// Every model, record and quantity.
pub fn table(c: &Comparison) -> Result<String, Failure> {
    let mut rows = Vec::new();
    for (m, model) in c.models.iter().enumerate() {
        for (r, record) in c.records.iter().enumerate() {
            let failure = model.records[r].as_ref().err().cloned();
            for (q, quantity) in c.quantities.iter().enumerate() {
                rows.push(vec![
                    model.descriptor.name.to_owned(),
                    record.clone(),
                    quantity.of.clone(),
                    quantity.kind.name().to_owned(),
                    quantity.kind.unit().to_owned(),
                    c.value(m, r, q).to_string(),
                    c.isolated[r][q].to_string(),
                    failure.clone().unwrap_or_default(),
                ]);
            }
        }
    }
    let header = [
        "model", "record", "of", "quantity", "unit", "value", "isolated", "failure",
    ];
    csv(&header, rows.into_iter())
}

/// Displacement, acceleration and force over the models, numbered as in the tables; a
/// curve a record and building, or gap.
pub fn figure(c: &Comparison) -> Result<String, Failure> {
    let panel = |kind: QuantityKind, caption: &str, size: f64| {
        let quantities = c
            .quantities
            .iter()
            .enumerate()
            .filter(|(_, q)| q.kind == kind);
        let curves = quantities.flat_map(|(q, quantity)| {
            c.records.iter().enumerate().map(move |(r, record)| {
                let values = (0..c.models.len()).map(|m| ((m + 1) as f64, c.value(m, r, q) / size));
                Curve {
                    name: format!("{}, {record}", quantity.of),
                    points: values.filter(|p| p.1.is_finite()).collect(),
                }
            })
        });
        Panel {
            caption: caption.to_owned(),
            horizontal: "number of the model in the table".to_owned(),
            curves: curves.collect(),
        }
    };
    draw(&[
        panel(QuantityKind::Displacement, "Peak displacement (mm)", 1e-3),
        panel(
            QuantityKind::AccelerationAbsolute,
            "Peak absolute acceleration (m/s2)",
            1.0,
        ),
        panel(QuantityKind::PeakForce, "Peak contact force (kN)", 1e3),
    ])
}
