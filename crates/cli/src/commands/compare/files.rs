//! Tables of the comparison.

use pounding_study::comparison::{Comparison, ModelRun, QuantityKind, StoreyDifference};

use crate::failure::Failure;
use crate::output::comma_separated;

/// Every model, record and quantity, then the peaks of every storey and the impacts of
/// every level, each with the statistic that it is.
pub fn table(c: &Comparison) -> Result<String, Failure> {
    let mut rows = Vec::new();
    for (m, model) in c.models.iter().enumerate() {
        for (r, record) in c.records.iter().enumerate() {
            let start = [model.descriptor.name, record].map(str::to_owned);
            let failure = model.records[r].as_ref().err().cloned();
            let failure = failure.unwrap_or_default();
            for (q, quantity) in c.quantities.iter().enumerate() {
                let mut row = start.to_vec();
                row.extend([
                    quantity.of.clone(),
                    quantity.kind.name().to_owned(),
                    quantity.kind.unit().to_owned(),
                    c.value(m, r, q).to_string(),
                    c.isolated[r][q].to_string(),
                    failure.clone(),
                    quantity.statistic().to_owned(),
                    String::new(),
                    String::new(),
                ]);
                rows.push(row);
            }
            if let Ok(run) = &model.records[r] {
                for place in places(c, (m, r), run) {
                    rows.push([&start[..], &place[..]].concat());
                }
            }
        }
    }
    let header = [
        "model",
        "record",
        "of",
        "quantity",
        "unit",
        "value",
        "isolated",
        "failure",
        "statistic",
        "place",
        "differs_from_gap",
    ];
    comma_separated(&header, rows)
}

/// Rows of every storey and level of one run, but for model and record.
fn places(c: &Comparison, (m, r): (usize, usize), run: &ModelRun) -> Vec<[String; 9]> {
    let mut rows = Vec::new();
    for quantity in &c.quantities {
        let (of, kind) = (quantity.index, quantity.kind);
        let mut add = |value: f64, isolated: f64, statistic: &str, place: String, differs: bool| {
            rows.push([
                quantity.of.clone(),
                kind.name().to_owned(),
                kind.unit().to_owned(),
                value.to_string(),
                isolated.to_string(),
                String::new(),
                statistic.to_owned(),
                place,
                differs.to_string(),
            ]);
        };
        if quantity.is_of_building() {
            let without = c.own[r].isolated[of].storeys.iter();
            for (s, (with, isolated)) in run.storeys[of].iter().zip(without).enumerate() {
                let (Some(with), Some(isolated)) = (kind.peak(with), kind.peak(isolated)) else {
                    continue;
                };
                let here = |d: &&StoreyDifference| (d.building, d.storey, d.kind) == (of, s, kind);
                let difference = c.storey_differences.iter().find(here);
                let differs = difference.is_some_and(|d| d.models[r].contains(&m));
                let jumps = kind == QuantityKind::AccelerationAbsolute
                    && run.amplification[of][s].acceleration_absolute.is_nan();
                let value = if jumps { f64::NAN } else { with.value };
                let place = format!("storey {}", s + 1);
                add(value, isolated.value, "peak of the storey", place, differs);
            }
        }
        if kind == QuantityKind::Impacts {
            for (l, (impacts, level)) in run.impacts[of].iter().zip(&c.levels[of]).enumerate() {
                let closes = c.own[r].demand_exceeds(of, l, level.width);
                let differs = (*impacts > 0) != closes;
                let place = format!("level {}", level.place.label());
                add(
                    *impacts as f64,
                    f64::NAN,
                    "impacts of the level",
                    place,
                    differs,
                );
            }
        }
    }
    rows
}
