//! `pounding models`: the cards of the impact models.

use comfy_table::Table;
use pounding_gap_element::{ModelDescriptor, Verification, registry};
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
        let name = if d.recommended {
            format!("{} *", d.name)
        } else {
            d.name.to_owned()
        };
        table.add_row([name.as_str(), d.title, d.class, checked]);
    }
    print(&format!(
        "{table}\n* recommended: returns the restitution asked for\n\n`pounding models NAME` shows formula, parameters, source and traps."
    ))
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
        for alias in d.aliases {
            text.push_str(&format!(
                "also called   {}: {}\n",
                alias.name, alias.citation
            ));
        }
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
            p.unit.symbol(),
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
        .map(|p| json!({"name": p.name, "unit": p.unit.symbol(), "range": p.range(), "default": p.default, "required": p.required, "explanation": p.explanation}))
        .collect();
    json!({
        "name": d.name, "recommended": d.recommended,
        "aliases": d.aliases.iter().map(|a| json!({"name": a.name, "citation": a.citation})).collect::<Vec<_>>(), "title": d.title, "formula": d.formula,
        "citation": d.citation, "class": d.class, "parameters": parameters,
        "separation_rules": d.separation_rules.iter().map(|r| r.name()).collect::<Vec<_>>(),
        "verification": verification(d), "traps": d.traps,
    })
}
