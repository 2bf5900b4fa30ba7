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

/// Peaks over those without pounding, over the models in the order of the tables; a curve
/// a building and record.
pub fn figure(c: &Comparison) -> Result<String, Failure> {
    let panel = |kind: QuantityKind, name: &str| {
        let quantities = c.quantities.iter().enumerate();
        let curves = quantities
            .filter(|(_, q)| q.kind == kind)
            .flat_map(|(q, quantity)| {
                c.records.iter().enumerate().map(move |(r, record)| {
                    let alone = c.isolated[r][q];
                    let ratio = |m: usize| ((m + 1) as f64, c.value(m, r, q) / alone);
                    Curve {
                        name: format!("{}, {record}", quantity.of),
                        points: (0..c.models.len())
                            .map(ratio)
                            .filter(|p| p.1.is_finite())
                            .collect(),
                    }
                })
            });
        Panel {
            caption: format!("Peak {name} over that without pounding (-)"),
            horizontal: "number of the model, in the order of the table".to_owned(),
            curves: curves.collect(),
        }
    };
    draw(&[
        panel(QuantityKind::Displacement, "displacement"),
        panel(QuantityKind::StoreyShear, "storey shear"),
        panel(QuantityKind::AccelerationAbsolute, "absolute acceleration"),
    ])
}
