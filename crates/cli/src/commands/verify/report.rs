//! Published beside computed, with a verdict per line.

use crate::tables::Table;
use pounding_catalogue::wording::counted;
use serde_json::{Map, Value, json};

/// How a computed value stands to a published one, the worst first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// It differs.
    NotReproduced,
    /// There is nothing to compare it with.
    ComputedOnly,
    /// It comes out near the print if the test was read as is supposed.
    UnderTheReading,
    /// The source's own numbers are lost; an independent evaluation agrees.
    AgreesWithReference,
    /// It comes out in all printed digits.
    Reproduced,
}

impl Verdict {
    fn words(self) -> &'static str {
        match self {
            Self::NotReproduced => "not reproduced",
            Self::ComputedOnly => "computed only",
            Self::UnderTheReading => "reproduced under the reading",
            Self::AgreesWithReference => "agrees with the reference",
            Self::Reproduced => "reproduced",
        }
    }

    /// Against printed digits: half a unit of the last one.
    pub fn printed(published: f64, computed: f64, last_digit: f64) -> Self {
        // Round-off of the subtraction does not decide.
        if (published - computed).abs() <= 0.5 * last_digit * (1.0 + 1.0e-9) {
            Self::Reproduced
        } else {
            Self::NotReproduced
        }
    }

    /// Against reference values: the largest difference and what is allowed.
    pub fn reference(difference: f64, tolerance: f64) -> Self {
        if difference <= tolerance {
            Self::AgreesWithReference
        } else {
            Self::NotReproduced
        }
    }
}

/// The largest of some differences; infinite if one is no number, so that it never
/// passes.
pub fn largest(differences: impl IntoIterator<Item = f64>) -> f64 {
    differences.into_iter().fold(0.0, |largest, difference| {
        if difference <= largest {
            largest
        } else if difference > largest {
            difference
        } else {
            f64::INFINITY
        }
    })
}

/// The largest relative difference of pairs of value and reference.
pub fn largest_relative(pairs: &[(f64, f64)]) -> f64 {
    largest(
        pairs
            .iter()
            .map(|(value, reference)| (value / reference - 1.0).abs()),
    )
}

/// One entry of a line.
pub struct Cell {
    shown: String,
    value: Value,
}

/// Words.
pub fn text(words: impl Into<String>) -> Cell {
    let words = words.into();
    Cell {
        value: json!(words),
        shown: words,
    }
}

/// A number with this many decimals in the table.
pub fn number(value: f64, decimals: usize) -> Cell {
    Cell {
        shown: format!("{value:.decimals$}"),
        value: json!(value),
    }
}

/// A number with this many digits behind the point of its power form.
pub fn power(value: f64, decimals: usize) -> Cell {
    Cell {
        shown: format!("{value:.decimals$e}"),
        value: json!(value),
    }
}

/// Nothing to show.
pub fn nothing() -> Cell {
    Cell {
        shown: "-".to_owned(),
        value: Value::Null,
    }
}

/// One comparison.
pub struct Line {
    /// Entries below the columns.
    pub cells: Vec<Cell>,
    /// How it comes out.
    pub verdict: Verdict,
    /// How we say it comes out.
    pub claimed: Verdict,
}

impl Line {
    fn holds(&self) -> bool {
        self.verdict >= self.claimed
    }
}

/// A table of comparisons.
pub struct Comparison {
    /// Heading.
    pub title: String,
    /// Key for machines and heading for people of each column.
    pub columns: Vec<(&'static str, &'static str)>,
    /// Lines.
    pub lines: Vec<Line>,
}

/// All of one source.
pub struct Part {
    /// Name as in the arguments.
    pub name: &'static str,
    /// Author, year.
    pub citation: &'static str,
    /// Tables.
    pub comparisons: Vec<Comparison>,
    /// What does and what does not reproduce, in words.
    pub findings: Vec<String>,
}

/// Whether everything that is said to reproduce does.
pub fn holds(parts: &[Part]) -> bool {
    lines(parts).all(Line::holds)
}

fn lines(parts: &[Part]) -> impl Iterator<Item = &Line> {
    parts
        .iter()
        .flat_map(|part| &part.comparisons)
        .flat_map(|comparison| &comparison.lines)
}

/// For people.
pub fn as_text(parts: &[Part]) -> String {
    let mut out = String::new();
    for part in parts {
        out.push_str(&format!("{}\n\n", part.citation));
        for comparison in &part.comparisons {
            out.push_str(&format!("{}\n{}\n\n", comparison.title, table(comparison)));
        }
        for finding in &part.findings {
            out.push_str(&format!("- {finding}\n"));
        }
        out.push('\n');
    }
    let failed: Vec<&Line> = lines(parts).filter(|line| !line.holds()).collect();
    out.push_str(&format!(
        "{} compared; ",
        counted(lines(parts).count(), "line")
    ));
    if failed.is_empty() {
        out.push_str("everything that is said to reproduce does.");
    } else {
        out.push_str(&format!("{} do not come out as said:\n", failed.len()));
        for line in failed {
            let cells: Vec<_> = line.cells.iter().map(|c| c.shown.as_str()).collect();
            out.push_str(&format!(
                "  {}: {}, said to be {}\n",
                cells.join(" | "),
                line.verdict.words(),
                line.claimed.words()
            ));
        }
    }
    out
}

fn table(comparison: &Comparison) -> Table {
    let mut table = Table::new();
    let headings = comparison.columns.iter().map(|(_, heading)| *heading);
    table.set_header(headings.chain(["verdict"]));
    for line in &comparison.lines {
        let cells = line.cells.iter().map(|cell| cell.shown.as_str());
        table.add_row(cells.chain([line.verdict.words()]));
    }
    table
}

/// For machines: SI units, full precision.
pub fn as_json(parts: &[Part]) -> Value {
    let parts_json: Vec<_> = parts
        .iter()
        .map(|part| {
            json!({
                "source": part.name, "citation": part.citation, "findings": part.findings,
                "comparisons": part.comparisons.iter().map(comparison_json).collect::<Vec<_>>(),
            })
        })
        .collect();
    json!({"parts": parts_json, "holds": holds(parts)})
}

fn comparison_json(comparison: &Comparison) -> Value {
    let line_json = |line: &Line| {
        let mut object: Map<String, Value> = comparison
            .columns
            .iter()
            .zip(&line.cells)
            .map(|((key, _), cell)| ((*key).to_owned(), cell.value.clone()))
            .collect();
        object.insert("verdict".to_owned(), json!(line.verdict.words()));
        object.insert("claimed".to_owned(), json!(line.claimed.words()));
        object.insert("holds".to_owned(), json!(line.holds()));
        Value::Object(object)
    };
    json!({
        "title": comparison.title,
        "lines": comparison.lines.iter().map(line_json).collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(verdict: Verdict, claimed: Verdict) -> Part {
        Part {
            name: "source",
            citation: "Author year",
            comparisons: vec![Comparison {
                title: "Table".to_owned(),
                columns: vec![("value", "value")],
                lines: vec![Line {
                    cells: vec![number(1.5, 2)],
                    verdict,
                    claimed,
                }],
            }],
            findings: Vec::new(),
        }
    }

    #[test]
    fn a_line_that_falls_short_of_its_claim_is_named() {
        let parts = [part(Verdict::NotReproduced, Verdict::Reproduced)];
        assert!(!holds(&parts));
        let shown = as_text(&parts);
        assert!(shown.contains("1 do not come out as said"), "{shown}");
        assert!(
            shown.contains("1.50: not reproduced, said to be reproduced"),
            "{shown}"
        );
        assert_eq!(as_json(&parts)["holds"], false);
    }

    #[test]
    fn a_line_that_is_said_not_to_reproduce_is_no_failure() {
        for verdict in [Verdict::NotReproduced, Verdict::Reproduced] {
            assert!(holds(&[part(verdict, Verdict::NotReproduced)]));
        }
    }

    #[test]
    fn no_number_never_passes() {
        assert_eq!(largest([1.0, f64::NAN, 2.0]), f64::INFINITY);
        assert_eq!(largest_relative(&[(2.0, 1.0), (3.0, 1.0), (1.0, 1.0)]), 2.0);
        for value in [f64::NAN, f64::INFINITY] {
            assert_eq!(Verdict::reference(value, 1.0), Verdict::NotReproduced);
            assert_eq!(Verdict::printed(1.0, value, 0.1), Verdict::NotReproduced);
        }
    }
}
