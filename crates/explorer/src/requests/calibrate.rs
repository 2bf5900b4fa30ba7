//! Another impact model, made like that of a gap: as `pounding compare` does by default.

use pounding_catalogue::numbers::significant;
use pounding_gap_element::laboratory::EXAMPLE_RESTITUTION;
use pounding_gap_element::registry;
use pounding_study::calibration::{RestitutionRule, StiffnessRule, calibrated, references};
use pounding_study::gap_check::{UNWATCHED, demands};
use serde_json::{Value, json};

use super::under_its_record;
use crate::answer::Answer;
use crate::explorer::Prepared;
use crate::fault::Refused;

/// The keys of a gap with this model. Where no collision is known, as a building collapses by itself, or
/// the gap's own law gives nothing to calibrate to, the parameters are those of the model's example.
pub(crate) fn answer(prepared: Prepared, gap: usize, model: &str) -> Result<Answer, Refused> {
    let case = prepared.case.clone();
    let descriptor = registry::find(model).map_err(|e| Refused::new(e.to_string(), e.help()))?;
    if gap >= case.gaps.len() {
        return Err(Refused::new(format!("the case has no gap {gap}"), None));
    }
    let records = [under_its_record(prepared)];
    let system = &records[0].assembly.system;
    let rules = (StiffnessRule::Penetration, RestitutionRule::AsPublished);
    let like_it = demands(&records, 1, UNWATCHED)
        .and_then(|own| references(&case, system, &own, (None, None)))
        .map_err(|e| e.to_string())
        .and_then(|references| calibrated(descriptor, &references[gap], rules));
    let (values, mut notes) = match like_it {
        Ok(made) => (made.parameters.values.clone(), made.notes),
        Err(reason) => {
            let restitution = case.gaps[gap].parameters.iter();
            let restitution = restitution
                .filter(|p| p.key.value == "restitution")
                .find_map(|p| Some(p.at(0)?.value.value));
            let example = descriptor.example_parameters(restitution.unwrap_or(EXAMPLE_RESTITUTION));
            let note = format!("parameters of the model's example, as {reason}");
            (example.values.clone(), vec![note])
        }
    };
    if case.gaps[gap].parameters.iter().any(|p| !p.is_one()) {
        notes.push("the levels had parameters of their own: all have those now that follow from the level that is hit fastest, also with the former model; \"Reset\" takes the case file's again".to_owned());
    }
    let mut keys = vec![json!(["model", descriptor.name])];
    // As many digits as mean anything: what is written is what is run.
    let shown = |x: f64| significant(x).to_string().parse().unwrap_or(x);
    let parameters = values.into_iter();
    keys.extend(parameters.map(|(name, value)| json!([name, shown(value)])));
    let mut answer = Answer::default();
    answer.say("keys", Value::Array(keys));
    answer.say("notes", json!(notes));
    Ok(answer)
}
