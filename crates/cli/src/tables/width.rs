//! Tables and paragraphs as wide as the terminal, or as `COLUMNS` says.

use std::fmt;
use std::ops::{Deref, DerefMut};

use comfy_table::{ColumnConstraint, ContentArrangement, Width};
use unicode_width::UnicodeWidthStr;

/// Least width that is taken from `COLUMNS`.
const LEAST: u16 = 20;

/// Width from which no table is wider than it should be: in less, words stay whole and
/// tables together, and are wider where they must.
const NARROW: u16 = 60;

/// Blanks beside a word in its column.
const PADDING: u16 = 2;

/// A table whose cells are broken at blanks to fit. Where its words alone are wider it is
/// split into several, one below another, each with the columns that name its rows; within
/// a word it is broken only where a single column beside these is still too wide.
pub struct Table {
    table: comfy_table::Table,
    /// Columns that name the rows.
    keys: usize,
}

impl Table {
    /// An empty table, whose first column names its rows.
    pub fn new() -> Self {
        Self {
            table: comfy_table::Table::new(),
            keys: 1,
        }
    }

    /// Lets the first so many columns name the rows.
    pub fn set_keys(&mut self, keys: usize) {
        self.keys = keys;
    }
}

impl Deref for Table {
    type Target = comfy_table::Table;

    fn deref(&self) -> &Self::Target {
        &self.table
    }
}

impl DerefMut for Table {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.table
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let tables = split(&self.table, self.keys, width());
        let text: Vec<String> = tables.iter().map(ToString::to_string).collect();
        f.write_str(&text.join("\n\n"))
    }
}

/// Columns to fill: what `COLUMNS` says, else those of a terminal; `None` elsewhere.
pub fn width() -> Option<u16> {
    let stated = std::env::var("COLUMNS").ok();
    let stated = stated.and_then(|text| text.trim().parse::<u16>().ok());
    stated
        .filter(|n| *n >= LEAST)
        .or_else(|| comfy_table::Table::new().width())
}

/// The table within a width, or several of them that hold its columns.
fn split(table: &comfy_table::Table, keys: usize, width: Option<u16>) -> Vec<comfy_table::Table> {
    let most = usize::from(width.unwrap_or(u16::MAX).max(NARROW));
    let words = longest_words(table);
    let taken = |columns: &[usize]| -> usize {
        let beside = |c: &usize| usize::from(words[*c] + PADDING) + 1;
        1 + columns.iter().map(beside).sum::<usize>()
    };
    let all: Vec<usize> = (0..words.len()).collect();
    if width.is_none() || taken(&all) <= most {
        return vec![fitted(table, width)];
    }
    let (keys, others) = all.split_at(keys.min(words.len().saturating_sub(1)));
    let mut groups = vec![keys.to_vec()];
    for column in others {
        let Some(group) = groups.last_mut() else {
            continue;
        };
        let with: Vec<usize> = group.iter().chain([column]).copied().collect();
        if group.len() == keys.len() || taken(&with) <= most {
            *group = with;
        } else {
            groups.push(keys.iter().chain([column]).copied().collect());
        }
    }
    let part = |shown: &Vec<usize>| {
        let mut least = words.clone();
        // Words of the widest columns are broken, by as little as makes it fit.
        let mut excess = taken(shown).saturating_sub(most);
        while excess > 0 {
            let Some(widest) = shown.iter().max_by_key(|c| least[**c]) else {
                break;
            };
            least[*widest] = least[*widest].saturating_sub(1).max(1);
            excess -= 1;
        }
        let mut part = bounded(table, width, &least);
        for column in part.column_iter_mut() {
            if !shown.contains(&column.index) {
                column.set_constraint(ColumnConstraint::Hidden);
            }
        }
        part
    };
    groups.iter().map(part).collect()
}

/// The table within a width, with its words whole.
fn fitted(table: &comfy_table::Table, width: Option<u16>) -> comfy_table::Table {
    bounded(table, width, &longest_words(table))
}

/// The table within a width, each column at least as wide as this.
fn bounded(table: &comfy_table::Table, width: Option<u16>, least: &[u16]) -> comfy_table::Table {
    let mut table = table.clone();
    let Some(width) = width else {
        return table;
    };
    table
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(width);
    for (column, least) in table.column_iter_mut().zip(least) {
        let whole = least.saturating_add(PADDING);
        column.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(whole)));
    }
    table
}

/// Width of the longest word of each column.
fn longest_words(table: &comfy_table::Table) -> Vec<u16> {
    let mut longest: Vec<u16> = vec![1; table.column_iter().count()];
    let header = table.header().into_iter();
    for row in header.chain(table.row_iter()) {
        for (longest, cell) in longest.iter_mut().zip(row.cell_iter()) {
            let content = cell.content();
            let words = content.split_whitespace().map(UnicodeWidthStr::width);
            let word = words.max().unwrap_or(0);
            *longest = (*longest).max(u16::try_from(word).unwrap_or(u16::MAX - PADDING));
        }
    }
    longest
}

/// A text whose lines are broken at blanks to fit; tables in it stay as they are.
pub fn paragraphs(text: &str) -> String {
    match width() {
        Some(width) => broken(text, usize::from(width)),
        None => text.to_owned(),
    }
}

fn broken(text: &str, width: usize) -> String {
    let mut lines = Vec::new();
    for line in text.lines() {
        if line.starts_with(['|', '+']) || line.width() <= width {
            lines.push(line.to_owned());
            continue;
        }
        let hang = " ".repeat(hanging(line).min(width / 3));
        let mut rest = line.trim_end().to_owned();
        while rest.width() > width {
            let begun = rest.len() - rest.trim_start().len();
            let blanks = || {
                let blanks = rest.match_indices(' ').map(|(at, _)| at);
                blanks.filter(|at| *at > begun)
            };
            // Beyond the width where a word alone is longer.
            let fits = blanks().take_while(|at| rest[..*at].width() <= width);
            let Some(at) = fits.last().or_else(|| blanks().next()) else {
                break;
            };
            let tail = rest.split_off(at);
            let rest = std::mem::replace(&mut rest, format!("{hang}{}", tail.trim_start()));
            lines.push(rest.trim_end().to_owned());
        }
        lines.push(rest);
    }
    lines.join("\n")
}

/// Where the lines that follow in a paragraph begin: below its text, which stands behind a
/// label and blanks, or where it begins itself.
fn hanging(line: &str) -> usize {
    let text = line.trim_start();
    let begun = line.width() - text.width();
    let labelled = text.split_once("  ").map(|(label, rest)| {
        let blanks = 2 + rest.len() - rest.trim_start().len();
        begun + label.width() + blanks
    });
    labelled.filter(|at| *at <= 20).unwrap_or(begun)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> comfy_table::Table {
        let mut table = comfy_table::Table::new();
        table.set_header(["storey", "displacement (mm)", "absolute acceleration (g)"]);
        for i in 0..3 {
            table.add_row([
                i.to_string(),
                format!("123.{i}5 @12.34 x1.05"),
                format!("-1.234{i}e-12 @{i}.50 x2.00"),
            ]);
        }
        table
    }

    fn widest(text: &str) -> usize {
        text.lines().map(UnicodeWidthStr::width).max().unwrap_or(0)
    }

    #[test]
    fn tables_fit_without_breaking_numbers() {
        let wide = fitted(&table(), None).to_string();
        assert!(widest(&wide) > 50, "{wide}");
        assert_eq!(fitted(&table(), Some(200)).to_string(), wide);
        for width in [20, 42, 45, 50, 55] {
            let text = fitted(&table(), Some(width)).to_string();
            // The longest words and the lines between the columns take 42.
            assert!(
                widest(&text) <= usize::from(width).max(42),
                "{width}:\n{text}"
            );
            for number in ["-1.2340e-12", "123.15", "@12.34", "acceleration"] {
                assert!(text.contains(number), "{width} {number}:\n{text}");
            }
        }
    }

    #[test]
    fn wide_tables_are_split_with_their_keys() {
        let mut wide = table();
        wide.set_header([
            "storey",
            "displacement",
            "acceleration",
            "dissipated",
            "hysteretic",
        ]);
        for row in wide.row_iter_mut() {
            row.add_cell("a_word_that_is_longer_than_any_width_would_have_it_be_at_all".into());
            row.add_cell("123456.7".into());
        }
        for width in [60, 80, 100] {
            let parts = split(&wide, 1, Some(width));
            assert!(parts.len() > 1 || width > 80, "{width}");
            for part in &parts {
                let text = part.to_string();
                assert!(widest(&text) <= usize::from(width), "{width}:\n{text}");
                assert!(text.contains("storey"), "{text}");
            }
            let all: String = parts.iter().map(ToString::to_string).collect();
            for word in ["acceleration", "hysteretic", "-1.2341e-12", "123456.7"] {
                assert!(all.contains(word), "{width} {word}:\n{all}");
            }
        }
        assert_eq!(split(&wide, 1, None)[0].to_string(), wide.to_string());
    }

    #[test]
    fn paragraphs_are_broken_at_blanks() {
        let text = "one two three four\n  five six seven eight\n\n| a table | of its own width |\nsource   nine ten eleven\nalonglongwordofitsown x";
        assert_eq!(
            broken(text, 12),
            "one two\nthree four\n  five six\n  seven\n  eight\n\n| a table | of its own width |\nsource\n    nine ten\n    eleven\nalonglongwordofitsown\nx"
        );
        assert_eq!(broken(text, 80), text);
    }

    /// Signs of East Asia take two columns each, combined marks none.
    #[test]
    fn paragraphs_are_as_wide_as_they_look() {
        let name = "建築物甲館（東側）";
        let text = format!("{name}-{name} {name} e\u{301}e\u{301} and more");
        for width in [40, 60] {
            let lines = broken(&text, width);
            assert!(widest(&lines) <= width, "{width}:\n{lines}");
        }
        assert_eq!(
            broken(&format!("{name} e\u{301}e\u{301} b"), 21),
            format!("{name} e\u{301}e\u{301}\nb")
        );
        assert_eq!(hanging(&format!("{}  text", &name[..9])), 8);
    }
}
