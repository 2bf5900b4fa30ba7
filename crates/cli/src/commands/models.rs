//! `pounding models`: the cards of the impact models.

use comfy_table::Table;
use pounding_gap_element::{ModelDescriptor, ParameterUnit, Verification, registry};
use serde_json::json;

use super::{pretty, print};
use crate::failure::Failure;

/// Lists all models, or shows one.
pub fn models(name: Option<&str>, as_json: bool) -> Result<(), Failure> {
    let chosen: Vec<&ModelDescriptor> = match name {
        Some(name) => vec![registry::find(name)?],
        None => registry::descriptors().to_vec(),
    };
    if as_json {
        let cards: Vec<_> = chosen.iter().map(|d| card_json(d)).collect();
        return print(&pretty(&json!(cards)));
    }
    if name.is_some() {
        return print(&chosen.iter().map(|d| card(d)).collect::<String>());
    }
    let mut table = Table::new();
    table.set_header(["name", "law", "class", "checked"]);
    for d in &chosen {
        let checked = match d.verification {
            Verification::Verified(_) => "verified",
            Verification::SecondarySources(_) => "secondary sources",
        };
        table.add_row([d.name, d.title, d.class, checked]);
    }
    print(&format!(
        "{table}\n\n`pounding models NAME` shows formula, parameters, source and traps."
    ))
}

fn unit(unit: ParameterUnit) -> &'static str {
    match unit {
        ParameterUnit::One => "-",
        ParameterUnit::NewtonPerMetre => "N/m",
        ParameterUnit::NewtonPerMetreToExponent => "N/m^n",
        ParameterUnit::NewtonSecondPerMetre => "N s/m",
        ParameterUnit::SecondPerMetre => "s/m",
    }
}

fn verification(d: &ModelDescriptor) -> String {
    match d.verification {
        Verification::Verified(how) => format!("verified against: {how}"),
        Verification::SecondarySources(how) => format!("from secondary sources: {how}"),
    }
}

fn card(d: &ModelDescriptor) -> String {
    let mut text = format!(
        "{} - {}\n\n  {}\n\nclass         {}\nsource        {}\nstatus        {}\n",
        d.name,
        d.title,
        d.formula,
        d.class,
        d.citation,
        verification(d)
    );
    if !d.aliases.is_empty() {
        text.push_str(&format!("also called   {}\n", d.aliases.join(", ")));
    }
    let rules: Vec<_> = d.separation_rules.iter().map(|r| r.name()).collect();
    text.push_str(&format!(
        "separation    {}\n\nparameters\n",
        rules.join(" (default), ")
    ));
    for p in d.parameters {
        let default = p
            .default
            .map_or_else(String::new, |x| format!(", default {x}"));
        let required = if p.required { ", required" } else { "" };
        text.push_str(&format!(
            "  {:14} {:6} {}  in {}{default}{required}\n",
            p.name,
            unit(p.unit),
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

fn card_json(d: &ModelDescriptor) -> serde_json::Value {
    let parameters: Vec<_> = d
        .parameters
        .iter()
        .map(|p| json!({"name": p.name, "unit": unit(p.unit), "range": p.range(), "default": p.default, "required": p.required, "explanation": p.explanation}))
        .collect();
    json!({
        "name": d.name, "aliases": d.aliases, "title": d.title, "formula": d.formula,
        "citation": d.citation, "class": d.class, "parameters": parameters,
        "separation_rules": d.separation_rules.iter().map(|r| r.name()).collect::<Vec<_>>(),
        "verification": verification(d), "traps": d.traps,
    })
}
