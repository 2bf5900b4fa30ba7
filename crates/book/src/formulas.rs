//! Formulas, written as LaTeX in blocks of the language `math`, as MathML, which browsers show
//! without scripts or fonts of their own.

use std::path::Path;

use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::mathml::push_mathml;
use pulldown_latex::{Parser, Storage};

use crate::error::BookError;

const START: &str = "```math\n";
const END: &str = "```\n";

/// A page whose formulas are elements of HTML.
pub(crate) fn rendered(page: &Path, text: &str) -> Result<String, BookError> {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once(START) {
        let (formula, next) = after.split_once(END).unwrap_or((after, ""));
        out.push_str(before);
        out.push_str(&element(page, formula.trim())?);
        rest = next;
    }
    out.push_str(rest);
    Ok(out)
}

fn element(page: &Path, formula: &str) -> Result<String, BookError> {
    let refused = |message: String| BookError::Formula {
        page: page.to_owned(),
        message,
        formula: formula.to_owned(),
    };
    let storage = Storage::new();
    if let Some(error) = Parser::new(formula, &storage).find_map(Result::err) {
        return Err(refused(error.to_string()));
    }
    let config = RenderConfig {
        display_mode: DisplayMode::Block,
        ..RenderConfig::default()
    };
    let mut element = String::new();
    push_mathml(&mut element, Parser::new(formula, &storage), config)
        .map_err(|e| refused(e.to_string()))?;
    // A blank line would end the HTML within Markdown.
    let lines = element.lines().filter(|line| !line.trim().is_empty());
    let whole: Vec<&str> = lines.collect();
    Ok(format!(
        "<div style=\"margin:1em 0;overflow-x:auto\">{}</div>\n",
        whole.join(" ")
    ))
}
