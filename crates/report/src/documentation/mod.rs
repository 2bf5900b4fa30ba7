//! The reference pages of impact models, of laws of storeys and links, and of provisions:
//! `docs/reference/models`, `docs/reference/hysteresis` and `docs/reference/provisions.md`, written
//! from their descriptors.

pub mod laws;
pub mod models;
pub mod provisions;

use pounding_catalogue::Verification;
use pounding_gap_element::GapElementError;
use pounding_hysteresis::laboratory::LaboratoryError;
use pounding_separation::SeparationError;

use crate::error::ReportError;

/// A file of the documentation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DocumentationFile {
    /// Its name in the folder.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// Why pages could not be made, in the words of the crate that computes what they show.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DocumentationError {
    /// An example of an impact model.
    #[error(transparent)]
    Model(#[from] GapElementError),
    /// An example of a law.
    #[error(transparent)]
    Law(#[from] LaboratoryError),
    /// The worked example of a provision.
    #[error(transparent)]
    Provision(#[from] SeparationError),
    /// A figure.
    #[error(transparent)]
    Figure(#[from] ReportError),
}

/// Where the files of a folder come from: the command that writes them, and from what.
struct Origin {
    /// First line of every page.
    page: &'static str,
    /// The same of a figure: a comment in XML may not hold two hyphens.
    figure: &'static str,
}

impl Origin {
    fn page(&self, name: &str, text: &str) -> DocumentationFile {
        file(format!("{name}.md"), self.page, text)
    }

    fn figure(&self, name: &str, text: &str) -> DocumentationFile {
        file(format!("{name}.svg"), self.figure, text)
    }
}

fn file(name: String, origin: &str, text: &str) -> DocumentationFile {
    DocumentationFile {
        name,
        text: format!("{origin}\n{}\n", text.trim_end()),
    }
}

/// Text inside a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

/// What stands at the top of a page.
struct Head<'a> {
    name: &'a str,
    title: &'a str,
    formula: &'a str,
    citation: &'a str,
    /// A line of its own kind: what it is, and its value.
    kind: (&'a str, &'a str),
    /// Whether it has been verified, and how.
    checked: Verification,
    /// Other names with their citations.
    aliases: Vec<(&'a str, &'a str)>,
}

impl Head<'_> {
    fn text(&self) -> String {
        let mut text = format!(
            "# {}: {}\n\n```text\n{}\n```\n\n| | |\n|---|---|\n| source | {} |\n| {} | {} |\n| checked | {} |\n",
            self.name,
            self.title,
            self.formula.split(";  ").collect::<Vec<_>>().join("\n"),
            cell(self.citation),
            self.kind.0,
            cell(self.kind.1),
            cell(&self.checked.markdown()),
        );
        for (name, citation) in &self.aliases {
            text.push_str(&format!("| also called | `{name}`: {} |\n", cell(citation)));
        }
        text
    }
}

/// The head of the table of parameters.
const PARAMETERS: &str =
    "## Parameters\n\n| name | unit | range | default | |\n|---|---|---|---|---|\n";

/// A line of the table of parameters.
fn parameter([name, unit, range, default]: [&str; 4], explanation: &str) -> String {
    format!(
        "| `{name}` | {unit} | {range} | {default} | {} |\n",
        cell(explanation)
    )
}

/// What to know, in points.
fn traps(traps: &[&str]) -> String {
    let points: String = traps.iter().map(|trap| format!("- {trap}\n")).collect();
    format!("## What to know\n\n{points}")
}

/// A value as case files and arguments take it: in quotes where it has a unit.
fn quoted((value, has_unit): (String, bool)) -> String {
    if has_unit {
        format!("\"{value}\"")
    } else {
        value
    }
}
