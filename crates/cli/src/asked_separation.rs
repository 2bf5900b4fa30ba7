//! Code, country, day and rules that are asked for beside those of a case.

use std::path::Path;

use pounding_case::{Located, RuleText, Separation, read_regular_text};
use pounding_study::gap_check::wrong_rules;

use crate::failure::Failure;

/// What is asked for; what is not keeps the words of the case.
#[derive(Debug, Clone, Copy, Default)]
pub struct Asked<'a> {
    /// A code or rule whose answer decides.
    pub code: Option<&'a str>,
    /// A country, whose code in force does.
    pub country: Option<&'a str>,
    /// The day of the edition, `YYYY-MM-DD`.
    pub date: Option<&'a str>,
    /// Provisions that alone are applied; none for all.
    pub provisions: &'a [String],
    /// A file of rules.
    pub rules: Option<&'a Path>,
}

/// Words of a case with those that are asked for in their place.
///
/// # Errors
/// A provision that is named twice, a file of rules that cannot be read, and rules that cannot be.
pub fn overridden(separation: Separation, asked: &Asked<'_>) -> Result<Separation, Failure> {
    if asked.code.is_some() && asked.country.is_some() {
        return Err(Failure::input(
            "`code` and `country` are both given".to_owned(),
            Some("give the code, or the country whose code is looked for".to_owned()),
        ));
    }
    // Words of arguments stand in no file.
    let word = |text: &str| Located {
        value: text.to_owned(),
        span: usize::MAX..usize::MAX,
    };
    let provisions = asked.provisions;
    let twice = (1..provisions.len()).find(|i| provisions[..*i].contains(&provisions[*i]));
    if let Some(twice) = twice {
        return Err(Failure::input(
            format!("--provisions names \"{}\" twice", provisions[twice]),
            Some("remove one of them".to_owned()),
        ));
    }
    let mut given = Separation {
        code: asked.code.map(word),
        country: asked.country.map(word),
        date: asked.date.map(word),
        provisions: (!provisions.is_empty()).then(|| provisions.iter().map(|p| word(p)).collect()),
        ..Separation::default()
    };
    if let Some(path) = asked.rules {
        let text = read_regular_text(path, "rules").map_err(|e| Failure::case(e, ""))?;
        let rules = RuleText::parse_all(&text, &path.display().to_string());
        given.rules = rules.map_err(|e| Failure::case(e, &text))?;
    }
    let separation = separation.overridden_by(given);
    if let Some((message, help)) = separation.wide_plan() {
        return Err(Failure::input(message, Some(help.to_owned())));
    }
    match wrong_rules(&separation) {
        None => Ok(separation),
        Some((error, source)) => Err(Failure::case(error, &source)),
    }
}
