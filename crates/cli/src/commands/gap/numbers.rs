//! The gap check for machines: SI units, full precision.

use pounding_study::gap_check::{
    Amplification, CodeGap, CombinationGap, GapCheck, GapReport, GapSweep, RecordDemand,
};
use pounding_time_history::Peak;
use serde_json::{Value, json};

use crate::json::add_place;

/// The object that `gap --json` prints.
pub fn check(check: &GapCheck) -> Value {
    let gaps = 0..check.gaps.len();
    json!({
        "adequate": check.adequate(),
        "target_probability": check.options.target_probability,
        "confidence": check.options.confidence,
        "warnings": check.warnings,
        "records": check.records.iter().map(record).collect::<Vec<_>>(),
        "gaps": gaps.map(|i| gap(check, i)).collect::<Vec<_>>(),
        "sweep": check.sweep.as_ref().map(sweep),
    })
}

fn peak(p: &Peak) -> Value {
    json!({"peak": p.value, "time": p.time})
}

fn amplification(buildings: &[Vec<Amplification>]) -> Value {
    let storey = |a: &Amplification| {
        json!({
            "displacement": a.displacement,
            "storey_shear": a.storey_shear,
            "acceleration_absolute": a.acceleration_absolute,
        })
    };
    let building = |b: &Vec<Amplification>| b.iter().map(storey).collect::<Vec<_>>();
    json!(buildings.iter().map(building).collect::<Vec<_>>())
}

fn record(r: &RecordDemand) -> Value {
    let isolated: Vec<_> = r
        .isolated
        .iter()
        .map(|b| {
            let peaks: Vec<_> = b.storeys.iter().map(|s| peak(&s.displacement)).collect();
            let inelastic = b.inelastic_storeys().into_iter();
            let inelastic: Vec<_> = inelastic
                .map(|(s, ductility)| json!({"storey": s + 1, "ductility": ductility}))
                .collect();
            json!({"name": b.name, "displacement": peaks, "inelastic_storeys": inelastic})
        })
        .collect();
    let impacts = r.pounding.as_ref().ok().map(|(_, gaps)| {
        let levels = gaps.iter().map(|g| g.levels.iter().map(|l| l.impacts));
        levels.map(Iterator::collect).collect::<Vec<Vec<usize>>>()
    });
    json!({
        "name": r.name,
        "peak_ground_acceleration": r.peak_ground_acceleration,
        "isolated": isolated,
        "amplification": r.amplification().map(|a| amplification(&a)),
        "impacts": impacts,
        "failure": r.pounding.as_ref().err(),
    })
}

fn gap(check: &GapCheck, index: usize) -> Value {
    let gap = &check.gaps[index];
    let levels: Vec<_> = gap
        .levels
        .iter()
        .enumerate()
        .map(|(l, level)| {
            let demand = check.records.iter().map(|r| peak(&r.demand[index][l]));
            let mut value = json!({"width": level.width, "demand": demand.collect::<Vec<_>>()});
            add_place(&mut value, &level.place);
            value
        })
        .collect();
    let fit = gap.required.lognormal.as_ref();
    json!({
        "name": gap.name,
        "between": gap.between,
        "adequate": gap.adequate,
        "records_in_contact": gap.records_in_contact,
        "records_driven_by_neighbours": gap.records_driven,
        "contact_probability_bounds": [gap.contact_bounds.0, gap.contact_bounds.1],
        "governing_level": gap.governing_level + 1,
        "demand": gap.demand,
        "levels": levels,
        "required": {
            "by_count": gap.required.by_count,
            "allowed_contacts": gap.required.allowed_contacts,
            "lognormal": fit.ok().map(|f| json!({
                "median": f.median, "dispersion": f.dispersion, "width": f.width,
                "bounds": [f.bounds.0, f.bounds.1],
            })),
            "no_lognormal": fit.err(),
        },
        "combinations": gap.combinations.iter().map(|c| combination(gap, c)).collect::<Vec<_>>(),
        "provisions": gap.codes.iter().map(|c| provision(gap, c)).collect::<Vec<_>>(),
    })
}

fn combination(gap: &GapReport, c: &CombinationGap) -> Value {
    let records: Vec<Vec<f64>> = c
        .records
        .iter()
        .map(|levels| levels.iter().map(|l| l.width).collect())
        .collect();
    json!({
        "rule": c.rule.name(), "effective_properties": c.effective.map(|e| e.name()),
        "status": c.status.name(), "correlation": c.correlation, "width": records,
        "satisfied": c.satisfied_by(&gap.levels),
    })
}

fn provision(gap: &GapReport, c: &CodeGap) -> Value {
    let level = |result: &Result<pounding_separation::Requirement, _>| match result {
        Ok(r) => json!({
            "width": r.width, "explanation": r.explanation, "caution": r.caution,
        }),
        Err(e) => json!({"refusal": ToString::to_string(e)}),
    };
    let records: Vec<_> = c
        .records
        .iter()
        .enumerate()
        .map(|(r, levels)| {
            let width = c.width(r);
            json!({
                "width": width,
                "ratio_to_demand": width.map(|w| w / gap.demand[r]),
                "levels": levels.iter().map(level).collect::<Vec<_>>(),
            })
        })
        .collect();
    let p = c.provision;
    json!({
        "name": p.name, "region": p.region, "edition": p.edition, "clause": p.clause,
        "place": p.place().name(), "basis": p.basis.name(), "formula": p.formula,
        "status": p.status.name(), "status_remark": p.status.remark(),
        "elastic_displacement_factor": p.elastic_displacement_factor,
        "refusal": c.refusal().map(ToString::to_string),
        "caution": c.caution(),
        "satisfied": c.satisfied_by(&gap.levels),
        "records": records,
    })
}

fn sweep(sweep: &GapSweep) -> Value {
    let run = |run: &Result<pounding_study::gap_check::SweepRun, String>| match run {
        Ok(run) => json!({
            "amplification": amplification(&run.amplification),
            "impacts": run.impacts,
            "peak_force": run.peak_force,
            "impact_energy": run.impact_energy,
        }),
        Err(failure) => json!({"failure": failure}),
    };
    let runs: Vec<Vec<Value>> = sweep
        .runs
        .iter()
        .map(|records| records.iter().map(run).collect())
        .collect();
    json!({"gap": sweep.gap, "widths": sweep.widths, "runs": runs})
}
