//! What pages of commands with many runs have in common.

use super::answer::Answer;
use super::document::{Document, listing};
use super::html::{figure, named, section};
use super::table::facts;
use crate::answer_file::{Inputs, Picture};
use crate::chart::{Chart, Plot};

/// Height of a figure (pt) that a sheet has room for below a heading, and what a plot takes beside its
/// axes for heading, legend and labels.
const HIGHEST: f64 = 560.0;
const AROUND: f64 = 55.0;

impl Picture {
    /// Its figures: plots that fit below one another stand in one.
    fn figures(&self) -> String {
        let mut parts: Vec<Vec<Plot>> = Vec::new();
        let mut free = 0.0;
        for plot in &self.plots {
            let needed = plot.height + AROUND;
            match parts.last_mut() {
                Some(part) if needed <= free => part.push(plot.clone()),
                _ => {
                    parts.push(vec![plot.clone()]);
                    free = HIGHEST;
                }
            }
            free -= needed;
        }
        let several = parts.len() > 1;
        let parts = parts.into_iter().map(|plots| {
            let mut words = self.words.clone();
            if several {
                let headings: Vec<&str> = plots.iter().map(|p| p.heading.as_str()).collect();
                words = format!("{words}: {}", headings.join("; "));
            }
            figure(&Chart::of_page(plots).svg(), &words)
        });
        parts.collect()
    }
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

/// Pictures one below the other, each in parts that a sheet of paper has room for.
pub(super) fn pictures<'p>(pictures: impl IntoIterator<Item = &'p Picture>) -> String {
    pictures.into_iter().map(Picture::figures).collect()
}

/// Rows of a table: the places of a list with their heads.
pub(super) fn rows<'h>(heads: impl IntoIterator<Item = &'h str>) -> Vec<(String, String)> {
    let heads = heads.into_iter().enumerate();
    heads
        .map(|(i, head)| (i.to_string(), head.to_owned()))
        .collect()
}

/// The records under which a building collapses without contact, each with what follows from it.
pub(super) fn collapsed(answer: Answer<'_>, consequence: &str) -> Vec<String> {
    let records = answer.list("/collapsed").iter().map(|record| {
        let text = |key: &str| named(record[key].as_str().unwrap_or_default());
        format!(
            "<strong>{} collapses without contact</strong> under {}: {}. {consequence}",
            text("building"),
            text("name"),
            text("diagnosis"),
        )
    });
    records.collect()
}
