//! The list of provisions.

use pounding_separation::{CombinationRule, EffectiveProperties, descriptors, unavailable};
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::output::{pretty, print};
use crate::tables::new_table;

/// Prints all provisions with status and inputs.
pub fn list(as_json: bool) -> Result<(), Failure> {
    if as_json {
        return print(&pretty(&numbers()));
    }
    let mut table = new_table([
        "provision",
        "region",
        "edition",
        "clause",
        "kind",
        "elastic displacement times",
        "status",
        "formula",
        "needs",
    ]);
    for p in descriptors() {
        let inputs: Vec<_> = p.inputs.iter().map(|i| i.key()).collect();
        table.add_row([
            p.name.to_owned(),
            p.region.to_owned(),
            p.edition.to_owned(),
            p.clause.to_owned(),
            format!("{}, {}", p.place().name(), p.basis.name()),
            p.elastic_displacement_factor.unwrap_or("-").to_owned(),
            format!("{}: {}", p.status.name(), p.status.remark()),
            p.formula.to_owned(),
            inputs.join(", "),
        ]);
    }
    let mut text = format!(
        "{table}\n\"elastic displacement times\": what the code multiplies the displacement of an elastic analysis by. Such a rule decides nothing where the buildings yield.\n\nCombination rules\n"
    );
    for rule in CombinationRule::ALL {
        let status = rule.status();
        text.push_str(&format!(
            "  {}: {}; {}: {}\n",
            rule.title(None),
            rule.formula(),
            status.name(),
            status.remark()
        ));
    }
    text.push_str("\nEffective period and damping of yielding buildings\n");
    for rule in EffectiveProperties::ALL {
        let status = rule.status();
        text.push_str(&format!(
            "  {}: {}; {}: {}\n",
            rule.name(),
            rule.citation(),
            status.name(),
            status.remark()
        ));
    }
    text.push_str("\nNot here\n");
    for code in unavailable() {
        text.push_str(&format!(
            "  {}, {}: {}\n",
            code.region, code.edition, code.reason
        ));
    }
    print(&text)
}

fn numbers() -> Value {
    let descriptors = descriptors().iter().map(|p| {
        json!({
            "name": p.name, "region": p.region, "edition": p.edition, "clause": p.clause,
            "place": p.place().name(), "basis": p.basis.name(), "formula": p.formula,
            "status": p.status.name(), "status_remark": p.status.remark(), "remarks": p.remarks,
            "elastic_displacement_factor": p.elastic_displacement_factor,
            "inputs": p.inputs.iter().map(|i| i.key()).collect::<Vec<_>>(),
        })
    });
    let missing = unavailable()
        .iter()
        .map(|u| json!({"region": u.region, "edition": u.edition, "reason": u.reason}));
    json!({"provisions": descriptors.collect::<Vec<_>>(), "unavailable": missing.collect::<Vec<_>>()})
}
