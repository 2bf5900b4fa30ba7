//! The widths that records, codes and combination rules ask for: what `pounding gap` says, for
//! the record of the case.

use pounding_case::Separation;
use pounding_study::gap_check::{
    CodeGap, CombinationGap, GapCheckOptions, GapReport, SweepOptions, UNWATCHED, even_widths,
    gap_check, widest,
};
use serde_json::{Value, json};

use super::under_its_record;
use crate::answer::Answer;
use crate::explorer::Prepared;
use crate::fault::Refused;

/// What each gap asks for.
pub(crate) fn answer(prepared: Prepared, separation: &Separation) -> Result<Answer, Refused> {
    let case = prepared.case.clone();
    let records = [under_its_record(prepared)];
    let options = GapCheckOptions {
        target_probability: 0.0,
        confidence: 0.9,
        sweep: None,
        threads: 1,
    };
    let check = gap_check(&case, separation, &records, &options, UNWATCHED)
        .map_err(|e| Refused::of_check(e, &case))?;
    let mut answer = Answer::default();
    answer.say("gaps", check.gaps.iter().map(gap).collect::<Value>());
    for index in 0..check.gaps.len() {
        let to = widest(&records, &check.records, Some(index));
        let widths = if to > 0.0 {
            even_widths(None, to, SweepOptions::POINTS)
        } else {
            Vec::new()
        };
        answer.add_column(&format!("sweep_{index}"), widths);
    }
    Ok(answer)
}

fn gap(report: &GapReport) -> Value {
    let provided = report.levels.iter().map(|level| level.width);
    json!({
        "name": report.name,
        "demand": report.demand.first(),
        "provided": provided.fold(f64::INFINITY, f64::min),
        "adequate": report.adequate,
        "codes": report.codes.iter().map(code).collect::<Value>(),
        "combinations": report.combinations.iter().map(combination).collect::<Value>(),
    })
}

fn code(gap: &CodeGap) -> Value {
    let provision = &gap.provision;
    json!({
        "name": provision.name(),
        "edition": provision.edition(),
        "clause": provision.clause(),
        "formula": provision.formula(),
        "verification": provision.status().to_string(),
        "width": gap.width(0),
        "refusal": gap.refusal().map(ToString::to_string),
        "caution": gap.caution(),
    })
}

fn combination(gap: &CombinationGap) -> Value {
    let levels = gap.records.first().into_iter().flatten();
    let width = levels.map(|level| level.width).fold(0.0, f64::max);
    json!({
        "name": gap.rule.name(),
        "verification": gap.status.to_string(),
        "width": width,
    })
}
