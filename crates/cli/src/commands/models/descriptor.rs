//! The descriptor of one model, for people and for machines.

use pounding_gap_element::ModelDescriptor;
use serde::Serialize;

use crate::descriptor::{DescribedParameter, OtherName};

/// The descriptor as text.
pub fn text(d: &ModelDescriptor) -> String {
    let mut text = format!(
        "{} - {}\n\n  {}\n\nclass         {}\nsource        {}\nstatus        {}\n",
        d.name, d.title, d.formula, d.class, d.citation, d.verification
    );
    if !d.aliases.is_empty() {
        for alias in d.aliases {
            text.push_str(&format!(
                "also called   {}: {}\n",
                alias.name, alias.citation
            ));
        }
    }
    let mut rules: Vec<_> = d
        .separation_rules
        .iter()
        .map(|r| r.name().to_owned())
        .collect();
    if rules.len() > 1 {
        rules[0].push_str(" (default)");
    }
    text.push_str(&format!(
        "separation    {}\n\nparameters\n",
        rules.join(", ")
    ));
    for p in d.parameters {
        let default = p
            .default
            .map_or_else(String::new, |x| format!(", default {x}"));
        let required = if p.required { ", required" } else { "" };
        text.push_str(&format!(
            "  {:14} {:6} {}  in {}{default}{required}\n",
            p.name,
            d.unit_symbol(p.unit),
            p.explanation,
            p.range()
        ));
    }
    text.push_str("\nwhat to know\n");
    for trap in d.traps {
        text.push_str(&format!("  - {trap}\n"));
    }
    text
}

/// The descriptor for machines.
#[derive(Serialize)]
pub struct Described {
    name: &'static str,
    recommended: bool,
    aliases: Vec<OtherName>,
    title: &'static str,
    formula: &'static str,
    citation: &'static str,
    class: &'static str,
    parameters: Vec<DescribedParameter>,
    separation_rules: Vec<&'static str>,
    verification: String,
    traps: &'static [&'static str],
}

impl Described {
    /// All of it.
    pub fn of(d: &ModelDescriptor) -> Self {
        let parameters = d.parameters.iter();
        let parameters = parameters
            .map(|p| DescribedParameter::of(p, d.unit_symbol(p.unit).to_string(), p.required));
        Self {
            name: d.name,
            recommended: d.recommended,
            aliases: OtherName::of_all(d.aliases),
            title: d.title,
            formula: d.formula,
            citation: d.citation,
            class: d.class,
            parameters: parameters.collect(),
            separation_rules: d.separation_rules.iter().map(|r| r.name()).collect(),
            verification: d.verification.to_string(),
            traps: d.traps,
        }
    }
}
