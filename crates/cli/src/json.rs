//! Results for machines: SI units, full precision.

use pounding_gap_element::Verification;
use pounding_time_history::{
    LevelOutcome, LevelPlace, LinkLevelOutcome, LinkOutcome, Outcome, Peak, StoreyPeaks, System,
    YieldingStorey,
};
use serde_json::{Value, json};

/// The object that `run --json` prints.
pub fn outcome(
    system: &System,
    outcome: &Outcome,
    isolated: &Outcome,
    warnings: &[String],
) -> Value {
    let buildings: Vec<_> = outcome
        .buildings
        .iter()
        .zip(&isolated.buildings)
        .zip(system.buildings())
        .map(|((b, isolated), building)| {
            json!({
                "name": b.name,
                "elevation": building.elevations(),
                "storeys": b.storeys.iter().map(storey).collect::<Vec<_>>(),
                "yielding": b.yielding.iter().map(yielding).collect::<Vec<_>>(),
                "isolated": isolated.storeys.iter().map(storey).collect::<Vec<_>>(),
            })
        })
        .collect();
    let gaps: Vec<_> = outcome
        .gaps
        .iter()
        .zip(system.gaps())
        .map(|(g, place)| {
            let descriptor = system
                .levels()
                .get(place.first_level)
                .map(|l| l.model.descriptor());
            let secondary = descriptor
                .is_some_and(|d| matches!(d.verification, Verification::SecondarySources(_)));
            json!({
                "name": g.name,
                "model": descriptor.map(|d| d.name),
                "from_secondary_sources": secondary,
                "between": place.between,
                "levels": g.levels.iter().zip(system.levels_of(place)).map(|(l, at)| {
                    let mut value = level(l);
                    add_place(&mut value, &at.place);
                    value["width"] = json!(at.width);
                    value
                }).collect::<Vec<_>>(),
            })
        })
        .collect();
    let (end, statistics) = (outcome.energy.end, outcome.statistics);
    json!({
        "status": "complete",
        "method": outcome.method.name,
        "end_time": outcome.end_time,
        "buildings": buildings,
        "gaps": gaps,
        "links": links(system, outcome),
        "energy": {
            "input": end.input, "kinetic": end.kinetic, "strain": end.strain, "viscous": end.viscous,
            "hysteretic": end.hysteretic, "impact": end.impact, "residual": end.residual,
            "residual_ratio": outcome.energy.residual_ratio, "largest_input": outcome.energy.largest_input,
        },
        "statistics": {
            "steps": statistics.steps, "rejected": statistics.rejected, "events": statistics.events,
            "location_steps": statistics.location_steps, "evaluations": statistics.evaluations,
            "newton_iterations": statistics.newton_iterations,
        },
        "warnings": warnings,
    })
}

fn yielding(storey: &Option<YieldingStorey>) -> Value {
    storey.map_or(Value::Null, |s| {
        json!({
            "law": s.law,
            "ductility": s.ductility.map(peak),
            "residual_drift_ratio": s.residual_drift_ratio,
            "hysteretic_energy": s.hysteretic_energy,
        })
    })
}

/// Adds label, storeys and elevations of a level; a wall has neither storey nor elevation.
pub fn add_place(value: &mut Value, place: &LevelPlace) {
    value["level"] = json!(place.label());
    value["left_storey"] = json!(place.storeys[0]);
    value["right_storey"] = json!(place.storeys[1]);
    value["left_elevation"] = json!(place.elevations[0]);
    value["right_elevation"] = json!(place.elevations[1]);
}

fn links(system: &System, outcome: &Outcome) -> Vec<Value> {
    let level = |l: &LinkLevelOutcome| {
        json!({
            "deformation": peak(l.deformation),
            "force": peak(l.force),
            "ductility": l.ductility.map(peak),
            "final_deformation": l.final_deformation,
            "energy_dissipated": l.energy_dissipated,
        })
    };
    let link = |(index, l): (usize, &LinkOutcome)| {
        let places = system.link_levels(index);
        let levels = l.levels.iter().zip(&places).map(|(l, place)| {
            let mut value = level(l);
            add_place(&mut value, place);
            value
        });
        let levels: Vec<Value> = levels.collect();
        json!({"name": l.name, "law": l.law, "levels": levels})
    };
    outcome.links.iter().enumerate().map(link).collect()
}

fn peak(p: Peak) -> Value {
    json!({"peak": p.value, "time": p.time})
}

fn storey(s: &StoreyPeaks) -> Value {
    json!({
        "displacement": peak(s.displacement),
        "drift_ratio": peak(s.drift_ratio),
        "storey_shear": peak(s.storey_shear),
        "acceleration_absolute": peak(s.acceleration_absolute),
    })
}

fn level(l: &LevelOutcome) -> Value {
    json!({
        "impacts": l.impacts,
        "first_contact": l.first_contact,
        "peak_force": peak(l.peak_force),
        "peak_penetration": peak(l.peak_penetration),
        "approach_velocity_max": l.approach_velocity_max,
        "energy_dissipated": l.energy_dissipated,
        "impulse": l.impulse,
        "impulse_max": l.impulse_max,
        "gap_widening": l.gap_widening,
        "achieved_restitution": l.achieved_restitution,
        "sticks": l.sticks,
    })
}
