//! The comparison for machines: SI units, full precision.

use pounding_study::comparison::{
    ComparedModel, Comparison, Judgement, LevelDifference, Quantity, QuantityKind, StoreyDifference,
};
use serde_json::{Value, json};

use crate::json::add_place;

/// The object that `compare --json` prints.
pub fn comparison(c: &Comparison) -> Value {
    let references = c.references.iter().map(|r| {
        json!({
            "approach_velocity": r.approach_velocity, "effective_mass": r.effective_mass,
            "stiffness": r.stiffness, "exponent": r.exponent, "restitution": r.restitution,
        })
    });
    json!({
        "stiffness_rule": c.options.stiffness_rule.name(),
        "restitution_rule": c.options.restitution_rule.name(),
        "references": references.collect::<Vec<_>>(),
        "records": c.records,
        "warnings": c.warnings,
        "models": c.models.iter().map(|m| model(c, m)).collect::<Vec<_>>(),
        "quantities": (0..c.quantities.len()).map(|q| quantity(c, q)).collect::<Vec<_>>(),
        "gaps": (0..c.levels.len()).map(|g| gap(c, g)).collect::<Vec<_>>(),
        "conclusions": conclusions(c),
        "differences_from_gap": {
            "storeys": c.storey_differences.iter().map(|d| storey(c, d)).collect::<Vec<_>>(),
            "levels": c.level_differences.iter().map(|d| level(c, d)).collect::<Vec<_>>(),
        },
    })
}

/// Under which records the models close a gap.
fn gap(c: &Comparison, index: usize) -> Value {
    let records = 0..c.records.len();
    let models: Vec<_> = records.map(|r| c.models_in_contact(index, r)).collect();
    let without = c.records_without_contact(index);
    let without: Vec<_> = without.iter().map(|r| &c.records[*r]).collect();
    json!({
        "name": gap_name(c, index), "models": c.complete().len(),
        "models_in_contact": models, "records_without_contact": without,
    })
}

fn gap_name(c: &Comparison, index: usize) -> Option<&str> {
    let impacts = |q: &&Quantity| q.kind == QuantityKind::Impacts && q.index == index;
    c.quantities.iter().find(impacts).map(|q| q.of.as_str())
}

fn names_by_record(c: &Comparison, models: &[Vec<usize>]) -> Vec<Vec<&'static str>> {
    models.iter().map(|m| names(c, m)).collect()
}

fn range((low, high): (f64, f64)) -> [f64; 2] {
    [low, high]
}

fn storey(c: &Comparison, d: &StoreyDifference) -> Value {
    let own: Vec<_> = (0..c.records.len()).map(|r| d.own_differs(r)).collect();
    json!({
        "building": c.own.first().map(|r| &r.isolated[d.building].name),
        "storey": d.storey + 1, "quantity": d.kind.name(),
        "models": names_by_record(c, &d.models), "models_that_say": d.models_that_say,
        "amplification_at_storey": range(d.at_storey),
        "ratio_of_maxima": range(d.of_maxima),
        "own_law": {
            "amplification_at_storey": d.own_at_storey,
            "ratio_of_maxima": d.own_of_maxima, "differs": own,
        },
    })
}

fn level(c: &Comparison, d: &LevelDifference) -> Value {
    let place = &c.levels[d.gap][d.level];
    let mut value = json!({
        "gap": gap_name(c, d.gap), "width": place.width,
        "demand": d.demand, "demand_closes": d.demand_closes,
        "models_in_contact": names_by_record(c, &d.models), "models": c.complete().len(),
        "own_law_impacts": d.own_impacts,
    });
    add_place(&mut value, &place.place);
    value
}

fn names(c: &Comparison, models: &[usize]) -> Vec<&'static str> {
    let names = models.iter().map(|m| c.models[*m].descriptor.name);
    names.collect()
}

fn model(c: &Comparison, m: &ComparedModel) -> Value {
    let gaps: Vec<_> = m
        .calibrated
        .iter()
        .flatten()
        .map(|g| {
            json!({
                "parameters": g.parameters.values, "free_restitution": g.free_restitution,
                "notes": g.notes,
            })
        })
        .collect();
    let failures: Vec<_> = c
        .records
        .iter()
        .zip(&m.records)
        .filter_map(|(record, r)| {
            let diagnosis = r.as_ref().err()?;
            Some(json!({"record": record, "diagnosis": diagnosis}))
        })
        .collect();
    json!({"name": m.descriptor.name, "gaps": gaps, "failures": failures})
}

fn quantity(c: &Comparison, q: usize) -> Value {
    let (quantity, spread, ranking) = (&c.quantities[q], &c.spreads[q], &c.rankings[q]);
    let records = 0..c.records.len();
    let of_model = |m: usize| -> Vec<f64> { records.clone().map(|r| c.value(m, r, q)).collect() };
    let isolated: Vec<f64> = c.isolated.iter().map(|r| r[q]).collect();
    json!({
        "name": quantity.kind.name(), "of": quantity.of, "unit": quantity.kind.unit(),
        "statistic": quantity.kind.statistic(),
        "isolated": isolated,
        "values": (0..c.models.len()).map(of_model).collect::<Vec<_>>(),
        "spread": {
            "between_models": spread.between_models,
            "between_records": spread.between_records,
            "greatest_ratio": spread.greatest_ratio,
            "records": spread.records,
            "records_left_out": c.records.len() - spread.records,
        },
        "ranking": {
            "models": names(c, &ranking.order), "relative": ranking.relative,
            "concordance": ranking.concordance,
        },
    })
}

fn conclusions(c: &Comparison) -> Vec<Value> {
    let answer = |j: &Judgement| {
        json!({
            "holds": j.holds.name(), "counts": j.counts,
            "minority": names_by_record(c, &j.dissenters),
        })
    };
    let one = |x: &pounding_study::comparison::Conclusion| {
        let mut value = answer(&x.judgement);
        value["statement"] = json!(x.statement);
        value["statistic"] = json!(x.statistic);
        value["by_storey"] = json!(x.by_storey.as_ref().map(answer));
        value
    };
    c.conclusions.iter().map(one).collect()
}
