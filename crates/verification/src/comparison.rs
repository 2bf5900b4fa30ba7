//! Published beside computed, with a verdict per line.

use serde::ser::{Serialize, SerializeMap, Serializer};

/// How a computed value stands to a published one, the worst first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// It differs.
    NotReproduced,
    /// The published numbers are not at hand: who has them enters them.
    NeedsData,
    /// There is nothing to compare it with.
    ComputedOnly,
    /// The published value is off, and the closed form, which ours meets, shows by how much.
    TheirError,
    /// The published value is that of its time step: the published scheme gives it at that step,
    /// and ours at a small one.
    AtTheirStep,
    /// It comes out near the print if the test was read as is supposed.
    UnderTheReading,
    /// The source's own numbers are lost; an independent evaluation agrees.
    AgreesWithReference,
    /// It comes out in all printed digits.
    Reproduced,
}

impl Verdict {
    /// The verdict in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::NotReproduced => "not reproduced",
            Self::NeedsData => "needs data",
            Self::ComputedOnly => "computed only",
            Self::TheirError => "their error",
            Self::AtTheirStep => "reproduced at their step",
            Self::UnderTheReading => "reproduced under the reading",
            Self::AgreesWithReference => "agrees with the reference",
            Self::Reproduced => "reproduced",
        }
    }

    /// Against printed digits: half a unit of the last one.
    #[must_use]
    pub fn printed(published: f64, computed: f64, last_digit: f64) -> Self {
        // Round-off of the subtraction does not decide.
        if (published - computed).abs() <= 0.5 * last_digit * (1.0 + 1.0e-9) {
            Self::Reproduced
        } else {
            Self::NotReproduced
        }
    }

    /// Against reference values: the largest difference and what is allowed.
    #[must_use]
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
pub(crate) fn largest(differences: impl IntoIterator<Item = f64>) -> f64 {
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
pub(crate) fn largest_relative(pairs: &[(f64, f64)]) -> f64 {
    largest(
        pairs
            .iter()
            .map(|(value, reference)| (value / reference - 1.0).abs()),
    )
}

/// One entry of a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// As a table shows it.
    pub shown: String,
    /// What it says.
    pub value: Value,
}

/// What an entry says.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum Value {
    /// Words.
    Text(String),
    /// A number in full precision, in the unit of its column.
    Number(f64),
    /// Nothing to compare with.
    Nothing,
}

/// Words.
pub fn text(words: impl Into<String>) -> Cell {
    let words = words.into();
    Cell {
        value: Value::Text(words.clone()),
        shown: words,
    }
}

/// A number with this many decimals in the table.
pub fn number(value: f64, decimals: usize) -> Cell {
    Cell {
        shown: format!("{value:.decimals$}"),
        value: Value::Number(value),
    }
}

/// A number with this many digits behind the point of its power form.
pub fn power(value: f64, decimals: usize) -> Cell {
    Cell {
        shown: format!("{value:.decimals$e}"),
        value: Value::Number(value),
    }
}

/// Nothing to show.
pub fn nothing() -> Cell {
    Cell {
        shown: "-".to_owned(),
        value: Value::Nothing,
    }
}

/// One comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Entries below the columns.
    pub cells: Vec<Cell>,
    /// How it comes out.
    pub verdict: Verdict,
    /// How we say it comes out.
    pub claimed: Verdict,
}

impl Line {
    /// Whether it comes out as claimed, or better.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.verdict >= self.claimed
    }
}

/// A table of comparisons.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Heading.
    pub title: String,
    /// Key for machines and heading for people of each column.
    pub columns: Vec<(&'static str, &'static str)>,
    /// Lines.
    pub lines: Vec<Line>,
}

/// All of one source.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Part {
    /// Name as in the arguments.
    #[serde(rename = "source")]
    pub name: &'static str,
    /// Author, year.
    pub citation: &'static str,
    /// Tables.
    pub comparisons: Vec<Comparison>,
    /// What does and what does not reproduce, in words.
    pub findings: Vec<String>,
}

/// Parts, and whether they hold: SI units, full precision.
#[derive(Debug, Clone, Copy, serde::Serialize)]
pub struct Report<'a> {
    parts: &'a [Part],
    holds: bool,
}

impl<'a> Report<'a> {
    /// The report of some parts.
    #[must_use]
    pub fn of(parts: &'a [Part]) -> Self {
        Self {
            parts,
            holds: holds(parts),
        }
    }
}

/// Whether everything that is said to reproduce does.
#[must_use]
pub fn holds(parts: &[Part]) -> bool {
    let comparisons = parts.iter().flat_map(|part| &part.comparisons);
    let mut lines = comparisons.flat_map(|comparison| &comparison.lines);
    lines.all(Line::holds)
}

impl Serialize for Comparison {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let line = |line| LineOf {
            columns: &self.columns,
            line,
        };
        let lines: Vec<_> = self.lines.iter().map(line).collect();
        let mut map = serializer.serialize_map(Some(2))?;
        map.serialize_entry("title", &self.title)?;
        map.serialize_entry("lines", &lines)?;
        map.end()
    }
}

/// A line whose entries have the keys of their columns.
struct LineOf<'a> {
    columns: &'a [(&'static str, &'static str)],
    line: &'a Line,
}

impl Serialize for LineOf<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.columns.len() + 3))?;
        for ((key, _), cell) in self.columns.iter().zip(&self.line.cells) {
            map.serialize_entry(key, &cell.value)?;
        }
        map.serialize_entry("verdict", self.line.verdict.words())?;
        map.serialize_entry("claimed", self.line.claimed.words())?;
        map.serialize_entry("holds", &self.line.holds())?;
        map.end()
    }
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
    fn a_line_that_falls_short_of_its_claim_is_reported() {
        let parts = [part(Verdict::NotReproduced, Verdict::Reproduced)];
        assert!(!holds(&parts));
        let report = serde_json::json!(Report::of(&parts));
        assert_eq!(report["holds"], false);
        assert_eq!(
            report["parts"][0]["comparisons"][0]["lines"][0],
            serde_json::json!({
                "value": 1.5, "verdict": "not reproduced", "claimed": "reproduced", "holds": false,
            })
        );
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
