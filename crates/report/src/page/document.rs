//! The file around what a page says: it needs no other file and no network, and prints.

use super::html::{escaped, escaped_json, named};

/// How pages look on screens, in the dark and in print.
const STYLE: &str = include_str!("page.css");
/// Policy of the browser: nothing is fetched, whatever stands in the page.
const POLICY: &str = "default-src &#39;none&#39;; style-src &#39;unsafe-inline&#39;; script-src &#39;unsafe-inline&#39;";

/// Pages with more than this take a while to lay out (bytes).
const LONG: usize = 1_500_000;

/// What runs in a page, with the data that it shows.
pub struct Script {
    /// JavaScript, ours.
    pub source: String,
    /// What it reads.
    pub data: serde_json::Value,
    /// What the browser may do beside running it: words that follow those of `script-src` in the
    /// policy of the page, with further directives behind them.
    pub may: &'static str,
}

/// A page.
pub struct Document<'a> {
    /// Title, in the tab and above all.
    pub title: &'a str,
    /// What is below the title, part by part.
    pub origin: &'a [String],
    /// All the rest, as HTML.
    pub body: &'a str,
    /// What makes it move.
    pub script: Option<Script>,
    /// Style beside that of all pages.
    pub style: &'a str,
}

/// What marks a page of this program.
pub const MARK: &str = "<meta name=\"generator\" content=\"pounding\">";

impl Document<'_> {
    /// The whole file.
    #[must_use]
    pub fn html(&self) -> String {
        let title = match self.title.is_empty() {
            true => "Untitled",
            false => self.title,
        };
        let heading = named(title);
        let title = escaped(title);
        // Sections of these are laid out as they come into sight.
        let long = match self.body.len() > LONG {
            true => " class=\"long\"",
            false => "",
        };
        let origin: Vec<String> = self.origin.iter().map(|part| named(part)).collect();
        let style = self.style;
        let may = self.script.as_ref().map_or("", |script| script.may);
        let script = self.script.as_ref().map(|script| {
            format!(
                "<script type=\"application/json\" id=\"data\">{}</script>\n<script>\n{}</script>\n",
                escaped_json(&script.data),
                script.source,
            )
        });
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}{may}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n{MARK}\n\
             <title>{title}</title>\n<style>\n{STYLE}{style}</style>\n</head>\n<body>\n\
             <header>\n<h1>{heading}</h1>\n<p class=\"what\">{}</p>\n</header>\n\
             <main{long}>\n{}</main>\n{}</body>\n</html>\n",
            origin.join(" &middot; "),
            self.body,
            script.unwrap_or_default(),
        )
    }
}

/// A file that was read, in full: the text of a case or a study.
pub(super) fn listing(heading: &str, text: &str) -> String {
    if text.is_empty() {
        return String::new();
    }
    let shown = named(heading);
    let heading = escaped(heading);
    format!(
        "<h3>{shown}</h3>\n<pre tabindex=\"0\" role=\"region\" aria-label=\"{heading}\">{}</pre>\n",
        escaped(text)
    )
}
