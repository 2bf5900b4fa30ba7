//! The page of one law.

use pounding_hysteresis::{LawDescriptor, build};

use super::super::chosen::Chosen;
use super::super::descriptor::dependence;
use super::Example;
use crate::commands::impact::numbers::significant;
use crate::commands::models::numbers::plain;

/// The page as Markdown.
pub fn page(example: &Example) -> String {
    let d = example.chosen.descriptor;
    let sections = [
        head(d),
        parameters(d),
        traps(d),
        cycles(example),
        usage(example),
    ];
    format!("\n{}\n", sections.join("\n"))
}

/// Whether a storey can have this law: it starts with a stiffness, to which modes and
/// damping belong, and does not depend on the rate.
pub fn carries_a_storey(d: &'static LawDescriptor) -> bool {
    initial_stiffness(d).is_some() && !d.rate_dependent
}

/// Initial stiffness (N/m) of the example, if it has one.
fn initial_stiffness(d: &'static LawDescriptor) -> Option<f64> {
    let law = build(d.name, &d.example_parameters()).ok()?;
    Some(law.initial_stiffness()).filter(|k| k.is_finite() && *k > 0.0)
}

/// Text inside a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

fn head(d: &LawDescriptor) -> String {
    let mut text = format!(
        "# {}: {}\n\n```text\n{}\n```\n\n| | |\n|---|---|\n| source | {} |\n| force of | {} |\n| checked | {} |\n",
        d.name,
        d.title,
        d.formula.split(";  ").collect::<Vec<_>>().join("\n"),
        cell(d.citation),
        dependence(d),
        cell(&d.verification.markdown()),
    );
    for alias in d.aliases {
        text.push_str(&format!(
            "| also called | `{}`: {} |\n",
            alias.name,
            cell(alias.citation)
        ));
    }
    text
}

fn parameters(d: &LawDescriptor) -> String {
    let mut text =
        "## Parameters\n\n| name | unit | range | default | |\n|---|---|---|---|---|\n".to_owned();
    for p in d.parameters {
        text.push_str(&format!(
            "| `{}` | {} | {} | {} | {} |\n",
            p.name,
            p.unit.symbol(),
            p.range(),
            p.default.map_or_else(|| "required".to_owned(), plain),
            cell(p.explanation)
        ));
    }
    text
}

fn traps(d: &LawDescriptor) -> String {
    let mut text = "## What to know\n\n".to_owned();
    for trap in d.traps {
        text.push_str(&format!("- {trap}\n"));
    }
    text
}

fn cycles(example: &Example) -> String {
    let chosen = &example.chosen;
    let values: Vec<_> = chosen
        .stated()
        .map(|(name, value)| format!("`{name}` {}", chosen.with_unit(name, value).0))
        .collect();
    let rate = if chosen.descriptor.rate_dependent {
        " Harmonic cycles of one second."
    } else {
        ""
    };
    let mut text = format!(
        "## Example\n\n{}.{rate}\n\n![Force over deformation of the example, {1}]({1}.svg)\n\nEach cycle from its positive peak back there:\n\n| from (mm) | to (mm) | peak force (kN) | dissipated (J) | secant stiffness (kN/m) | equivalent damping (%) |\n|---|---|---|---|---|---|\n",
        values.join(", "),
        chosen.descriptor.name,
    );
    for cycle in &example.driven.cycles {
        text.push_str(&format!("| {} |\n", cycle.cells(significant).join(" | ")));
    }
    text
}

fn usage(example: &Example) -> String {
    let chosen = &example.chosen;
    let name = chosen.descriptor.name;
    let mut text = "## Use it\n\n".to_owned();
    match initial_stiffness(chosen.descriptor).filter(|_| carries_a_storey(chosen.descriptor)) {
        Some(stiffness) => text.push_str(&format!(
            "As the law of storeys, whose `stiffness` it starts with:\n\n```toml\n[[building]]\nname = \"left\"\nstoreys = 2\nmass = \"25 t\"\nstiffness = \"{} N/m\"\nheight = \"3 m\"\ndamping = {{ stiffness_proportional = 0.05 }}\nlaw = {{ model = \"{name}\"{} }}\n```\n\n",
            plain(stiffness),
            storey_keys(chosen)
        )),
        None => text.push_str(
            "It starts without a stiffness or depends on the rate, so that it serves as a link, not as a storey.\n\n",
        ),
    }
    let amplitudes: Vec<_> = example
        .amplitudes
        .iter()
        .map(|a| format!("{} mm", significant(1.0e3 * a)))
        .collect();
    text.push_str(&format!(
        "As a link between neighbours:\n\n```toml\n[[link]]\nbetween = [\"left\", \"right\"]\nmodel = \"{name}\"\n{}```\n\nThe example above on the command line, its loop as figure and table:\n\n```sh\npounding hysteresis {name} --cycles \"{}\" \\\n   {} \\\n    --svg {name}.svg --csv {name}.csv\n```\n",
        keys(chosen).map(|(name, value)| format!("{name} = {value}\n")).collect::<String>(),
        amplitudes.join(","),
        keys(chosen).map(|(name, value)| format!(" --set {name}={value}")).collect::<String>(),
    ));
    text
}

/// Names and values as case files and arguments take them.
fn keys(chosen: &Chosen) -> impl Iterator<Item = (&'static str, String)> {
    chosen.stated().map(|(name, value)| {
        let (value, has_unit) = chosen.with_unit(name, value);
        let quoted = if has_unit {
            format!("\"{value}\"")
        } else {
            value
        };
        (name, quoted)
    })
}

/// The keys of a storey law: its stiffness is the storey's.
fn storey_keys(chosen: &Chosen) -> String {
    keys(chosen)
        .filter(|(name, _)| *name != "stiffness")
        .map(|(name, value)| format!(", {name} = {value}"))
        .collect()
}
