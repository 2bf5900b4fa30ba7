//! Tables as wide as the terminal, or as `COLUMNS` says.

use std::fmt;
use std::ops::{Deref, DerefMut};

use comfy_table::{ColumnConstraint, ContentArrangement, Width};

/// Least width that is taken from `COLUMNS`.
const LEAST: u16 = 20;

/// Blanks beside a word in its column.
const PADDING: u16 = 2;

/// A table whose cells are broken at blanks to fit, never within a number or word: where
/// these alone are wider, the table is.
pub struct Table(comfy_table::Table);

impl Table {
    /// An empty table.
    pub fn new() -> Self {
        Self(comfy_table::Table::new())
    }
}

impl Deref for Table {
    type Target = comfy_table::Table;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl DerefMut for Table {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.0
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fitted(&self.0, width()).fmt(f)
    }
}

/// Columns to fill: what `COLUMNS` says, else those of a terminal; `None` elsewhere.
fn width() -> Option<u16> {
    let stated = std::env::var("COLUMNS").ok();
    let stated = stated.and_then(|text| text.trim().parse::<u16>().ok());
    stated
        .filter(|n| *n >= LEAST)
        .or_else(|| comfy_table::Table::new().width())
}

/// The table within a width.
fn fitted(table: &comfy_table::Table, width: Option<u16>) -> comfy_table::Table {
    let mut table = table.clone();
    let Some(width) = width else {
        return table;
    };
    table
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(width);
    let mut least: Vec<u16> = vec![1; table.column_count()];
    let header = table.header().into_iter();
    for row in header.chain(table.row_iter()) {
        for (least, cell) in least.iter_mut().zip(row.cell_iter()) {
            let content = cell.content();
            let words = content.split_whitespace().map(|w| w.chars().count());
            let longest = words.max().unwrap_or(0);
            *least = (*least).max(u16::try_from(longest).unwrap_or(u16::MAX));
        }
    }
    for (column, least) in table.column_iter_mut().zip(least) {
        let whole = least.saturating_add(PADDING);
        column.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(whole)));
    }
    table
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
        text.lines().map(|l| l.chars().count()).max().unwrap_or(0)
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
}
