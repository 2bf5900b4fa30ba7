//! The page of one law.

use pounding_catalogue::numbers::{all_digits, significant};
use pounding_hysteresis::LawDescriptor;
use pounding_hysteresis::laboratory::Specimen;

use super::super::{Head, PARAMETERS, parameter, quoted, traps};
use super::{Example, dependence};
use crate::loops::{CYCLE_COLUMNS, cycle_cells};

/// The page as Markdown.
pub fn page(example: &Example) -> String {
    let d = example.specimen.descriptor;
    let sections = [
        head(d),
        parameters(d),
        traps(d.traps),
        cycles(example),
        usage(example),
    ];
    format!("\n{}\n", sections.join("\n"))
}

fn head(d: &LawDescriptor) -> String {
    Head {
        name: d.name,
        title: d.title,
        formula: d.formula,
        citation: d.citation,
        kind: ("force of", dependence(d)),
        checked: d.verification,
        aliases: d.aliases.iter().map(|a| (a.name, a.citation)).collect(),
    }
    .text()
}

fn parameters(d: &LawDescriptor) -> String {
    let mut text = PARAMETERS.to_owned();
    for p in d.parameters {
        let default = p.default.map_or_else(
            || if p.required { "required" } else { "-" }.to_owned(),
            all_digits,
        );
        text.push_str(&parameter(
            [p.name, p.unit.symbol(), &p.range(), &default],
            p.explanation,
        ));
    }
    text
}

fn cycles(example: &Example) -> String {
    let specimen = &example.specimen;
    let values: Vec<_> = specimen
        .stated()
        .map(|(name, value)| format!("`{name}` {}", specimen.with_unit(name, value).0))
        .collect();
    let rate = if specimen.descriptor.rate_dependent {
        " Harmonic cycles of one second."
    } else {
        ""
    };
    let mut text = format!(
        "## Example\n\n{}.{rate}\n\n![Force over deformation of the example, {1}]({1}.svg)\n\nEach cycle from its positive peak back there:\n\n| {2} |\n|{3}\n",
        values.join(", "),
        specimen.descriptor.name,
        CYCLE_COLUMNS.join(" | "),
        "---|".repeat(CYCLE_COLUMNS.len()),
    );
    for cycle in &example.driven.cycles {
        text.push_str(&format!("| {} |\n", cycle_cells(cycle).join(" | ")));
    }
    text
}

fn usage(example: &Example) -> String {
    let specimen = &example.specimen;
    let name = specimen.descriptor.name;
    let mut text = "## Use it\n\n".to_owned();
    match specimen.descriptor.link_alone {
        None => text.push_str(&format!(
            "As the law of storeys, whose `stiffness` it starts with:\n\n```toml\n[[building]]\nname = \"left\"\nstoreys = 2\nmass = \"25 t\"\nstiffness = \"{} N/m\"\nheight = \"3 m\"\ndamping = {{ stiffness_proportional = 0.05 }}\nlaw = {{ model = \"{name}\"{} }}\n```\n\n",
            all_digits(specimen.law.initial_stiffness()),
            storey_keys(specimen)
        )),
        Some(reason) => text.push_str(&format!(
            "It serves as a link, not as a storey: {reason}.\n\n"
        )),
    }
    let amplitudes: Vec<_> = example
        .amplitudes
        .iter()
        .map(|a| format!("{} mm", significant(1.0e3 * a)))
        .collect();
    text.push_str(&format!(
        "As a link between neighbours:\n\n```toml\n[[link]]\nbetween = [\"left\", \"right\"]\nmodel = \"{name}\"\n{}```\n\nThe example above on the command line, its loop as figure and table:\n\n```sh\npounding hysteresis {name} --cycles \"{}\" \\\n   {} \\\n    --svg {name}.svg --csv {name}.csv\n```\n",
        keys(specimen).map(|(name, value)| format!("{name} = {value}\n")).collect::<String>(),
        amplitudes.join(","),
        keys(specimen).map(|(name, value)| format!(" --set {name}={value}")).collect::<String>(),
    ));
    text
}

/// Names and values as case files and arguments take them.
fn keys(specimen: &Specimen) -> impl Iterator<Item = (&'static str, String)> {
    let stated = specimen.stated();
    stated.map(|(name, value)| (name, quoted(specimen.with_unit(name, value))))
}

/// The keys of a storey law: its stiffness is the storey's.
fn storey_keys(specimen: &Specimen) -> String {
    keys(specimen)
        .filter(|(name, _)| *name != "stiffness")
        .map(|(name, value)| format!(", {name} = {value}"))
        .collect()
}
