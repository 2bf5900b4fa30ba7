//! The descriptors of the laws, for people and for machines.

use std::collections::BTreeMap;

use pounding_catalogue::numbers::all_digits;
use pounding_hysteresis::LawDescriptor;
use pounding_report::documentation::laws::dependence;
use serde::Serialize;

use crate::descriptor::{DescribedParameter, OtherName};
use crate::tables::Table;

/// One line per law.
pub fn list(laws: &[&LawDescriptor]) -> String {
    let mut table = Table::new();
    table.set_header(["name", "law and its parameters", "checked"]);
    for d in laws {
        let law = format!("{}\n{}", d.title, parameters(d));
        table.add_row([d.name, &law, d.verification.name()]);
    }
    format!(
        "{table}\nParameters in brackets have a default.\n\n`pounding hysteresis NAME` shows formula, parameters, source and traps; with --cycles \"10 mm,20 mm\",\n--history FILE or --dissipation \"0.1 mm,10 mm\" it drives the law."
    )
}

/// The names of the parameters, those with a default in brackets, three per line.
fn parameters(d: &LawDescriptor) -> String {
    let names: Vec<String> = d
        .parameters
        .iter()
        .map(|p| match p.default {
            Some(_) => format!("[{}]", p.name),
            None => p.name.to_owned(),
        })
        .collect();
    let lines: Vec<String> = names.chunks(3).map(|line| line.join(", ")).collect();
    lines.join("\n")
}

/// The descriptor as text.
pub fn text(d: &LawDescriptor) -> String {
    let mut text = format!(
        "{} - {}\n\n  {}\n\nforce of      {}\nsource        {}\nstatus        {}\n",
        d.name,
        d.title,
        d.formula.split(";  ").collect::<Vec<_>>().join("\n  "),
        dependence(d),
        d.citation,
        d.verification
    );
    for alias in d.aliases {
        text.push_str(&format!(
            "also called   {}: {}\n",
            alias.name, alias.citation
        ));
    }
    text.push_str("\nparameters\n");
    for p in d.parameters {
        let default = p.default.map_or_else(
            || if p.required { ", required" } else { "" }.to_owned(),
            |x| format!(", default {x}"),
        );
        text.push_str(&format!(
            "  {:20} {:14} {}  in {}{default}\n",
            p.name,
            p.unit.symbol(),
            p.explanation,
            p.range()
        ));
    }
    text.push_str("\nexample, SI\n");
    for (name, value) in d.example {
        text.push_str(&format!("  {name} = {}\n", all_digits(*value)));
    }
    text.push_str(&format!(
        "  cycled to {} m to see all branches\n\nwhat to know\n",
        all_digits(d.example_amplitude)
    ));
    for trap in d.traps {
        text.push_str(&format!("  - {trap}\n"));
    }
    text
}

/// The descriptor for machines.
#[derive(Serialize)]
pub struct Described {
    name: &'static str,
    aliases: Vec<OtherName>,
    title: &'static str,
    formula: &'static str,
    citation: &'static str,
    rate_dependent: bool,
    parameters: Vec<DescribedParameter>,
    example: BTreeMap<&'static str, f64>,
    example_amplitude: f64,
    verification: String,
    traps: &'static [&'static str],
}

impl Described {
    /// All of it.
    pub fn of(d: &LawDescriptor) -> Self {
        let parameters = d.parameters.iter();
        let parameters = parameters
            .map(|p| DescribedParameter::of(p, p.unit.symbol().to_string(), p.default.is_none()));
        Self {
            name: d.name,
            aliases: OtherName::of_all(d.aliases),
            title: d.title,
            formula: d.formula,
            citation: d.citation,
            rate_dependent: d.rate_dependent,
            parameters: parameters.collect(),
            example: d.example.iter().copied().collect(),
            example_amplitude: d.example_amplitude,
            verification: d.verification.to_string(),
            traps: d.traps,
        }
    }
}
