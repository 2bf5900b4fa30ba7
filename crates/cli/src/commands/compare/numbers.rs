//! The comparison for machines: SI units, full precision.

use pounding_study::comparison::{ComparedModel, Comparison};
use serde_json::{Value, json};

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
        "conclusions": conclusions(c),
    })
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
        "isolated": isolated,
        "values": (0..c.models.len()).map(of_model).collect::<Vec<_>>(),
        "spread": {
            "between_models": spread.between_models,
            "between_records": spread.between_records,
            "greatest_ratio": spread.greatest_ratio,
        },
        "ranking": {
            "models": names(c, &ranking.order), "relative": ranking.relative,
            "concordance": ranking.concordance,
        },
    })
}

fn conclusions(c: &Comparison) -> Vec<Value> {
    let one = |x: &pounding_study::comparison::Conclusion| {
        let dissenters = x.dissenters.iter().map(|d| names(c, d));
        json!({
            "statement": x.statement, "holds": x.holds.name(), "counts": x.counts,
            "minority": dissenters.collect::<Vec<_>>(),
        })
    };
    c.conclusions.iter().map(one).collect()
}
