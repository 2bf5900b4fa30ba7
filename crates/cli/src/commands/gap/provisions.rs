//! The list of provisions.

use std::path::Path;

use pounding_report::documentation::provisions as documentation;
use pounding_separation::{
    CodeDescriptor, CombinationRule, EffectiveProperties, Provision, codes, descriptors,
    unavailable,
};
use serde::Serialize;

use crate::failure::Failure;
use crate::output::{pretty, print};
use crate::plot::write_documentation;
use crate::tables::new_table;

/// Writes the page of the documentation.
pub fn write_page(folder: &Path) -> Result<(), Failure> {
    write_documentation(folder, &documentation::files()?)?;
    print(&format!(
        "{} provisions in {}",
        descriptors().len(),
        folder.display()
    ))
}

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
            p.edition.region.to_owned(),
            p.edition.title.to_owned(),
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
    text.push_str(
        "\nCodes for --code, with when they are in force and what they take of many records\n",
    );
    for code in codes() {
        text.push_str(&format!(
            "  {} ({}{}): {}; {}\n",
            code.name,
            code.edition().title,
            dates(code),
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

/// From when to when the edition of a code is in force, and what names all its editions.
fn dates(code: &CodeDescriptor) -> String {
    let in_force = code.edition().in_force;
    let in_force = in_force.map_or_else(String::new, |known| format!(", {}", known.explanation()));
    match code.family == code.name {
        true => in_force,
        false => format!("{in_force}, an edition of {}", code.family),
    }
}

/// What `gap --list --json` prints.
#[derive(Serialize)]
struct Provisions {
    provisions: Vec<Descriptor>,
    codes: Vec<Code>,
    unavailable: Vec<Missing>,
}

/// What a provision is, in each object that names it.
#[derive(Serialize)]
pub struct Descriptor {
    name: String,
    region: String,
    edition: String,
    clause: String,
    in_force: Option<String>,
    superseded_by: Option<&'static str>,
    place: &'static str,
    basis: &'static str,
    formula: String,
    status: &'static str,
    /// What was seen, what is uncertain, or the file of a rule of the user.
    source: String,
    assumptions: Assumptions,
    /// Keys of `[separation]` that it needs.
    inputs: Vec<&'static str>,
    /// Only in the list.
    #[serde(skip_serializing_if = "Option::is_none")]
    remarks: Option<&'static [&'static str]>,
    elastic_displacement_factor: Option<&'static str>,
}

/// What a provision takes for granted.
#[derive(Serialize)]
struct Assumptions {
    displacement: String,
    height: String,
    ownership: String,
    alignment: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    others: Vec<String>,
}

impl Descriptor {
    /// That of a provision, without its remarks.
    pub fn of(p: &Provision) -> Self {
        let taken = p.assumptions();
        Self {
            name: p.name().to_owned(),
            region: p.region().to_owned(),
            edition: p.edition().to_owned(),
            clause: p.clause().to_owned(),
            in_force: p.in_force(),
            superseded_by: p.superseded_by(),
            place: p.place().name(),
            basis: p.basis().name(),
            formula: p.formula().into_owned(),
            status: p.status().name(),
            source: p.source().into_owned(),
            assumptions: Assumptions {
                displacement: taken.displacement,
                height: taken.height,
                ownership: taken.ownership,
                alignment: taken.alignment,
                others: taken.others,
            },
            inputs: p.inputs().iter().map(|i| i.key()).collect(),
            remarks: None,
            elastic_displacement_factor: p.elastic_displacement_factor(),
        }
    }
}

/// A code whose answer can be asked for.
#[derive(Serialize)]
struct Code {
    name: &'static str,
    family: &'static str,
    edition: &'static str,
    in_force: Option<String>,
    superseded_by: Option<&'static str>,
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
    provisions: Vec<String>,
}

impl Code {
    fn of(code: &CodeDescriptor) -> Self {
        let rules = code.code().rules.into_iter();
        let rules = rules.map(|(ownership, rules)| CodeRules {
            ownership: ownership.map(|o| o.name()),
            provisions: rules.provisions().map(|p| p.name().to_owned()).collect(),
        });
        Self {
            name: code.name,
            family: code.family,
            edition: code.edition().title,
            in_force: code.edition().in_force.map(|known| known.explanation()),
            superseded_by: code.edition().superseded_by,
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
        let provisions = descriptors().iter().map(|p| Descriptor {
            remarks: Some(p.remarks),
            ..Descriptor::of(&Provision::BuiltIn(p))
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
