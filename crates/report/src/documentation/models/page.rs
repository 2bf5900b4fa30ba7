//! The page of one model.

use pounding_catalogue::DefinitionError;
use pounding_catalogue::numbers::all_digits;
use pounding_gap_element::laboratory::EXAMPLE_RESTITUTION;
use pounding_gap_element::{GapElementError, ModelDescriptor, ParameterDescriptor, registry};

use super::super::{Head, PARAMETERS, parameter, quoted, traps};
use super::example::{BODIES_AS_ARGUMENTS, Example};
use super::results::{collisions, restitution};
use super::with_unit;

/// The page as Markdown.
pub fn page(example: &Example) -> String {
    let d = example.descriptor;
    let mut sections = vec![
        head(d),
        parameters(d),
        separation(d),
        traps(d.traps),
        restitution(example),
        collisions(example),
        usage(d),
    ];
    sections.retain(|s| !s.is_empty());
    format!("\n{}\n", sections.join("\n"))
}

fn head(d: &ModelDescriptor) -> String {
    let head = Head {
        name: d.name,
        title: d.title,
        formula: d.formula,
        citation: d.citation,
        kind: ("class", d.class),
        checked: d.verification,
        aliases: d.aliases.iter().map(|a| (a.name, a.citation)).collect(),
    };
    let mut text = head.text();
    if d.recommended {
        text.push_str("| recommended | it returns the restitution asked for |\n");
    }
    text
}

fn parameters(d: &ModelDescriptor) -> String {
    let mut text = PARAMETERS.to_owned();
    for p in d.parameters {
        let default = default(d, p);
        text.push_str(&parameter(
            [p.name, d.unit_symbol(p.unit), &p.range(), &default],
            p.explanation,
        ));
    }
    let constants: Vec<_> = d
        .constants
        .iter()
        .map(|c| format!("`{}` ({})", c.name, d.unit_symbol(c.unit)))
        .collect();
    if !constants.is_empty() {
        text.push_str(&format!(
            "\nFixed when the gap closes and written with each impact: {}.",
            constants.join(", ")
        ));
    }
    let needed: Vec<_> = [
        (d.needs_approach_velocity, "approach velocity"),
        (d.needs_effective_mass, "effective mass"),
    ]
    .iter()
    .filter_map(|(needed, what)| needed.then_some(*what))
    .collect();
    text.push_str(&if needed.is_empty() {
        "\nThe law uses neither approach velocity nor effective mass.\n".to_owned()
    } else {
        format!("\nThe law uses the {}.\n", needed.join(" and the "))
    });
    text
}

/// The default of a parameter, or whether a case must give it.
fn default(d: &ModelDescriptor, p: &ParameterDescriptor) -> String {
    if p.required {
        return "required".to_owned();
    }
    if let Some(default) = p.default {
        return all_digits(default);
    }
    // One of a pair of alternatives shows when the example is left without it.
    let mut parameters = d.example_parameters(EXAMPLE_RESTITUTION);
    parameters.values.remove(p.name);
    match registry::build(d.name, &parameters) {
        Err(GapElementError::Definition(DefinitionError::MissingParameter {
            parameter, ..
        })) if parameter != p.name => {
            format!("required: {parameter}")
        }
        _ => "optional".to_owned(),
    }
}

fn separation(d: &ModelDescriptor) -> String {
    let mut names: Vec<_> = d
        .separation_rules
        .iter()
        .map(|rule| format!("`{}`", rule.name()))
        .collect();
    if names.len() > 1 {
        names[0].push_str(" (default)");
    }
    format!(
        "Separation: {}. What the rules mean: [contact laws](../../theory/contact-laws.md#separation-rules).\n",
        names.join(", ")
    )
}

fn usage(d: &ModelDescriptor) -> String {
    let (mut keys, mut arguments) = (String::new(), String::new());
    let example = d.example_parameters(EXAMPLE_RESTITUTION);
    for p in d.parameters {
        if let Some(value) = example.values.get(p.name) {
            let value = quoted(with_unit(d, &example, p.name, *value));
            keys.push_str(&format!("{} = {value}\n", p.name));
            arguments.push_str(&format!(" -p {}={value}", p.name));
        }
    }
    if let [_, others @ ..] = d.separation_rules {
        for rule in others {
            keys.push_str(&format!(
                "# separation = \"{}\"    # instead of the default\n",
                rule.name()
            ));
        }
    }
    let table = if d.takes_restitution() {
        "the example collision, and with `--table` the table above"
    } else {
        "the example collision"
    };
    let stiffness = if d.parameters.iter().any(|p| p.name == "stiffness") {
        "\nWhere a stiffness comes from: [contact stiffness](../../how-to/contact-stiffness.md).\n"
    } else {
        ""
    };
    format!(
        "## Use it\n\nIn a case file, with the values of the example:\n\n```toml\n[[gap]]\nbetween = [\"left\", \"right\"]\nwidth = \"20 mm\"\nmodel = \"{0}\"\n{keys}```\n\nOn the command line {table}:\n\n```sh\npounding impact {0} {BODIES_AS_ARGUMENTS} \\\n   {arguments}\n```\n{stiffness}",
        d.name
    )
}
