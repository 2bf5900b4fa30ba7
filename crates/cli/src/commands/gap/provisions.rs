//! The list of provisions.

use pounding_separation::{
    CodeDescriptor, CombinationRule, EffectiveProperties, ProvisionDescriptor, codes, descriptors,
    unavailable,
};
use serde::Serialize;

use crate::failure::Failure;
use crate::output::{pretty, print};
use crate::tables::new_table;

/// Prints all provisions with status and inputs.
pub fn list(as_json: bool) -> Result<(), Failure> {
    if as_json {
        return print(&pretty(&Provisions::all())?);
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
    text.push_str("\nCodes for --code, with what they take of many records\n");
    for code in codes() {
        text.push_str(&format!(
            "  {} ({}): {}; {}\n",
            code.name,
            code.edition(),
            code.suite.explanation(),
            code.suite.status.name()
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

/// What `gap --list-provisions --json` prints.
#[derive(Serialize)]
struct Provisions {
    provisions: Vec<Provision>,
    codes: Vec<Code>,
    unavailable: Vec<Missing>,
}

/// What a provision is, in each object that names it.
#[derive(Serialize)]
pub struct Descriptor {
    name: &'static str,
    region: &'static str,
    edition: &'static str,
    clause: &'static str,
    place: &'static str,
    basis: &'static str,
    formula: &'static str,
    status: &'static str,
    status_remark: &'static str,
    /// Only in the list.
    #[serde(skip_serializing_if = "Option::is_none")]
    remarks: Option<&'static [&'static str]>,
    elastic_displacement_factor: Option<&'static str>,
}

impl Descriptor {
    /// That of a provision, without its remarks.
    pub fn of(p: &ProvisionDescriptor) -> Self {
        Self {
            name: p.name,
            region: p.region,
            edition: p.edition,
            clause: p.clause,
            place: p.place().name(),
            basis: p.basis.name(),
            formula: p.formula,
            status: p.status.name(),
            status_remark: p.status.remark(),
            remarks: None,
            elastic_displacement_factor: p.elastic_displacement_factor,
        }
    }
}

/// A provision with what it needs to know.
#[derive(Serialize)]
struct Provision {
    #[serde(flatten)]
    descriptor: Descriptor,
    inputs: Vec<&'static str>,
}

/// A code whose answer can be asked for.
#[derive(Serialize)]
struct Code {
    name: &'static str,
    edition: &'static str,
    statistic_rule: String,
    statistic_clause: &'static str,
    statistic_status: &'static str,
    /// Provisions by ownership; `null` where the code does not ask.
    rules: Vec<CodeRules>,
}

/// Provisions of a code for one kind of ownership.
#[derive(Serialize)]
struct CodeRules {
    ownership: Option<&'static str>,
    provisions: Vec<&'static str>,
}

impl Code {
    fn of(code: &CodeDescriptor) -> Self {
        let rules = code.rules().into_iter();
        let rules = rules.map(|(ownership, rules)| CodeRules {
            ownership: ownership.map(|o| o.name()),
            provisions: rules.provisions().map(|p| p.name).collect(),
        });
        Self {
            name: code.name,
            edition: code.edition(),
            statistic_rule: code.suite.explanation(),
            statistic_clause: code.suite.clause,
            statistic_status: code.suite.status.name(),
            rules: rules.collect(),
        }
    }
}

/// A code that is not here, and why.
#[derive(Serialize)]
struct Missing {
    region: &'static str,
    edition: &'static str,
    reason: &'static str,
}

impl Provisions {
    fn all() -> Self {
        let provisions = descriptors().iter().map(|p| Provision {
            descriptor: Descriptor {
                remarks: Some(p.remarks),
                ..Descriptor::of(p)
            },
            inputs: p.inputs.iter().map(|i| i.key()).collect(),
        });
        let unavailable = unavailable().iter().map(|u| Missing {
            region: u.region,
            edition: u.edition,
            reason: u.reason,
        });
        Self {
            provisions: provisions.collect(),
            codes: codes().iter().map(|c| Code::of(c)).collect(),
            unavailable: unavailable.collect(),
        }
    }
}
