//! What pages of commands with many runs have in common.

use super::document::{Document, listing};
use super::html::{figure, section};
use super::table::facts;

/// A picture that a command has drawn, and what it shows in words.
#[derive(Debug, Clone)]
pub struct Picture {
    /// SVG.
    pub svg: String,
    /// For those who do not see it.
    pub words: String,
}

/// What a page says of its inputs beside the answer.
#[derive(Debug, Clone, Default)]
pub struct Inputs {
    /// Title of the case or study.
    pub title: String,
    /// Below the title: command, file, version.
    pub origin: Vec<String>,
    /// What the user should know, beside warnings in the answer itself.
    pub warnings: Vec<String>,
    /// Names and values, such as hashes.
    pub facts: Vec<(String, String)>,
    /// Headings and texts of files that were read.
    pub listings: Vec<(String, String)>,
}

impl Inputs {
    /// The page of what was made of them.
    pub(super) fn page(&self, body: &str) -> String {
        let rows: Vec<(&str, String)> = self
            .facts
            .iter()
            .map(|(name, value)| (name.as_str(), value.clone()))
            .collect();
        let mut computed = facts("How it was computed", &rows);
        for (heading, text) in &self.listings {
            computed.push_str(&listing(heading, text));
        }
        let body = format!("{body}{}", section("How it was computed", &computed));
        let document = Document {
            title: &self.title,
            origin: &self.origin,
            body: &body,
            script: None,
            style: "",
        };
        document.html()
    }
}

/// Pictures one below the other.
pub(super) fn pictures(pictures: &[Picture]) -> String {
    let drawn = pictures.iter().map(|p| figure(&p.svg, &p.words));
    drawn.collect()
}

/// Rows of a table: the places of a list with their heads.
pub(super) fn rows<'h>(heads: impl IntoIterator<Item = &'h str>) -> Vec<(String, String)> {
    let heads = heads.into_iter().enumerate();
    heads
        .map(|(i, head)| (i.to_string(), head.to_owned()))
        .collect()
}
