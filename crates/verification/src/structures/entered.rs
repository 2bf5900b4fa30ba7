//! Publications whose numbers are not at hand: computed, and compared with what a user enters.

use std::path::{Path, PathBuf};

use pounding_case::{Dimension, parse_quantity};
use pounding_time_history::Outcome;
use serde::Deserialize;
use toml::Spanned;

use super::case_file::{CaseFile, case_file, run_of_user};
use super::quantity::{as_printed, digits};
use crate::comparison::{Comparison, Line, Part, Verdict, nothing, power, text};
use crate::error::{EnteredError, VerificationError};

/// The file that a user fills in, and what stands in the program while nobody did.
pub const TEMPLATE: &str = include_str!("../../cases/entered/published.toml");
/// Cases of entries that have one in the program.
const CASES: [(&str, CaseFile); 1] = [("jankowski_2008", case_file!("entered/jankowski_2008"))];

/// Published numbers that a user entered.
#[derive(Debug, Clone)]
pub struct Entered {
    /// The file, for messages and as the base of its paths; `None` is the template.
    file: Option<PathBuf>,
    entries: Vec<Entry>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    #[serde(default)]
    entry: Vec<RawEntry>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawEntry {
    name: Spanned<String>,
    source: String,
    case: Option<PathBuf>,
    #[serde(default)]
    value: Vec<RawValue>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawValue {
    quantity: Spanned<String>,
    of: Spanned<String>,
    storey: Spanned<usize>,
    published: Spanned<String>,
    tolerance: Spanned<String>,
    #[serde(default)]
    note: String,
}

#[derive(Debug, Clone)]
struct Entry {
    name: String,
    source: String,
    case: Option<PathBuf>,
    values: Vec<EnteredValue>,
}

/// One number of an entry.
#[derive(Debug, Clone)]
struct EnteredValue {
    quantity: &'static Quantity,
    of: String,
    storey: usize,
    published: Option<f64>,
    tolerance: f64,
    note: String,
    /// Line of `of` in the file.
    line: usize,
}

/// A quantity that can be entered.
#[derive(Debug)]
struct Quantity {
    key: &'static str,
    unit: &'static str,
    dimension: Dimension,
    value: Place,
}

/// Where its value is found.
#[derive(Debug, Clone, Copy)]
enum Place {
    Storey(fn(&pounding_time_history::StoreyPeaks) -> f64),
    Level(fn(&pounding_time_history::LevelOutcome) -> f64),
}

const QUANTITIES: [Quantity; 9] = [
    Quantity {
        key: "displacement",
        unit: "m",
        dimension: Dimension::LENGTH,
        value: Place::Storey(|s| s.displacement.value),
    },
    Quantity {
        key: "drift_ratio",
        unit: "-",
        dimension: Dimension::NUMBER,
        value: Place::Storey(|s| s.drift_ratio.value),
    },
    Quantity {
        key: "storey_shear",
        unit: "N",
        dimension: Dimension::FORCE,
        value: Place::Storey(|s| s.storey_shear.value),
    },
    Quantity {
        key: "acceleration",
        unit: "m/s2",
        dimension: Dimension::ACCELERATION,
        value: Place::Storey(|s| s.acceleration_absolute.value),
    },
    Quantity {
        key: "contact_force",
        unit: "N",
        dimension: Dimension::FORCE,
        value: Place::Level(|l| l.peak_force.value),
    },
    Quantity {
        key: "penetration",
        unit: "m",
        dimension: Dimension::LENGTH,
        value: Place::Level(|l| l.peak_penetration.value),
    },
    Quantity {
        key: "approach_velocity",
        unit: "m/s",
        dimension: Dimension::VELOCITY,
        value: Place::Level(|l| l.approach_velocity_max),
    },
    Quantity {
        key: "first_contact",
        unit: "s",
        dimension: Dimension::TIME,
        value: Place::Level(|l| l.first_contact.unwrap_or(f64::NAN)),
    },
    Quantity {
        key: "impacts",
        unit: "-",
        dimension: Dimension::NUMBER,
        value: Place::Level(|l| l.impacts as f64),
    },
];

/// Text of a file, and where its parts stand.
struct Source<'a> {
    name: String,
    text: &'a str,
}

impl Source<'_> {
    fn line(&self, offset: usize) -> usize {
        let before = self.text.get(..offset).unwrap_or(self.text);
        before.matches('\n').count() + 1
    }

    fn error(&self, offset: usize, problem: String, help: impl Into<String>) -> EnteredError {
        EnteredError {
            file: self.name.clone(),
            line: self.line(offset),
            problem,
            help: help.into(),
        }
    }
}

impl Entered {
    /// What is at hand: nothing but the entries.
    ///
    /// # Errors
    /// None: the template is valid.
    pub fn template() -> Result<Self, EnteredError> {
        Self::parse(TEMPLATE, None)
    }

    /// Reads a file that a user filled in.
    ///
    /// # Errors
    /// A file that cannot be read, or what is wrong in it with its line and a remedy.
    pub fn read(path: &Path) -> Result<Self, EnteredError> {
        let text = pounding_files::input::read_to_string(path).map_err(|e| EnteredError {
            file: path.display().to_string(),
            line: 1,
            problem: e.to_string(),
            help: "give a text file in UTF-8; --template prints one to fill in".to_owned(),
        })?;
        Self::parse(&text, Some(path))
    }

    fn parse(text: &str, file: Option<&Path>) -> Result<Self, EnteredError> {
        let name = file.unwrap_or(Path::new("published.toml")).display();
        let source = Source {
            name: name.to_string(),
            text,
        };
        let document: Document = toml::from_str(text).map_err(|e| {
            let offset = e.span().map_or(0, |span| span.start);
            source.error(
                offset,
                e.message().trim().to_owned(),
                "--template prints a file with all keys",
            )
        })?;
        let entry = |entry: RawEntry| {
            let values = entry.value.into_iter().map(|value| number(&source, value));
            Ok(Entry {
                values: values.collect::<Result<_, _>>()?,
                name: entry.name.into_inner(),
                source: entry.source,
                case: entry.case,
            })
        };
        let entries: Vec<Entry> = document
            .entry
            .into_iter()
            .map(entry)
            .collect::<Result<_, _>>()?;
        if entries.is_empty() {
            let help = "--template prints a file with [[entry]] tables";
            return Err(source.error(0, "no entries".to_owned(), help));
        }
        Ok(Self {
            file: file.map(Path::to_owned),
            entries,
        })
    }

    /// The case files that its entries name, resolved against its folder.
    #[must_use]
    pub fn cases(&self) -> Vec<PathBuf> {
        let named = self.entries.iter().filter_map(|entry| entry.case.as_ref());
        named.map(|case| self.resolve(case)).collect()
    }

    fn resolve(&self, path: &Path) -> PathBuf {
        let folder = self.file.as_deref().and_then(Path::parent);
        folder.unwrap_or(Path::new("")).join(path)
    }

    /// An error at a value.
    fn error(&self, line: usize, problem: String, help: String) -> VerificationError {
        let file = self.file.as_deref().unwrap_or(Path::new("published.toml"));
        VerificationError::Entered(EnteredError {
            file: file.display().to_string(),
            line,
            problem,
            help,
        })
    }
}

/// Checks one number.
fn number(source: &Source<'_>, raw: RawValue) -> Result<EnteredValue, EnteredError> {
    let keys = || {
        QUANTITIES
            .iter()
            .map(|q| q.key)
            .collect::<Vec<_>>()
            .join(", ")
    };
    let key = raw.quantity.get_ref();
    let quantity = QUANTITIES.iter().find(|q| q.key == key).ok_or_else(|| {
        let help = format!("quantities are {}", keys());
        source.error(
            raw.quantity.span().start,
            format!("unknown quantity \"{key}\""),
            help,
        )
    })?;
    let read = |text: &Spanned<String>, dimension: Dimension, what: &str, example: &str| {
        let wrong = |problem| source.error(text.span().start, problem, example);
        let read = parse_quantity(text.get_ref()).map_err(|e| wrong(format!("{what}: {e}")))?;
        // A number without a unit is SI, as in a case file.
        match read.dimension.is_none_or(|of| of == dimension) {
            true => Ok(read.value),
            false => Err(wrong(format!(
                "{what} \"{}\" is of another kind",
                text.get_ref()
            ))),
        }
    };
    let published = match raw.published.get_ref().trim() {
        "" => None,
        _ => {
            let help = format!("a number with a unit for {}, or \"\"", quantity.unit);
            Some(read(
                &raw.published,
                quantity.dimension,
                "published",
                &help,
            )?)
        }
    };
    let help = "a part of the published number, such as \"5 %\"";
    let tolerance = read(&raw.tolerance, Dimension::NUMBER, "tolerance", help)?;
    if !(0.0..=1.0).contains(&tolerance) {
        let problem = format!("tolerance is {tolerance}, but it must lie between 0 and 1");
        return Err(source.error(raw.tolerance.span().start, problem, help));
    }
    if *raw.storey.get_ref() == 0 {
        let help = "storeys and levels count from 1 at the bottom";
        return Err(source.error(raw.storey.span().start, "storey is 0".to_owned(), help));
    }
    Ok(EnteredValue {
        quantity,
        line: source.line(raw.of.span().start),
        of: raw.of.into_inner(),
        storey: raw.storey.into_inner(),
        published,
        tolerance,
        note: raw.note,
    })
}

/// Publications whose numbers are not at hand, beside what was entered.
///
/// # Errors
/// A case that cannot be run, or a value of a building or gap that its case does not have.
pub fn entered(entered: &Entered) -> Result<Part, VerificationError> {
    let comparisons = entered.entries.iter().map(|entry| compared(entered, entry));
    let comparisons = comparisons.collect::<Result<Vec<_>, _>>()?;
    let open = comparisons.iter().flat_map(|c| &c.lines);
    let open = open
        .filter(|line| line.verdict == Verdict::NeedsData)
        .count();
    let findings = match open {
        0 => Vec::new(),
        _ => vec!["Computed only: enter the numbers. `pounding verify structures --template` prints the file, `--data FILE` compares. Nothing here is validated against an experiment.".to_owned()],
    };
    Ok(Part {
        name: "entered",
        citation: "Publications whose numbers are not at hand",
        comparisons,
        findings,
    })
}

fn compared(file: &Entered, entry: &Entry) -> Result<Comparison, VerificationError> {
    let inside = CASES.iter().find(|(name, _)| *name == entry.name);
    let (outcome, inputs) = match (&entry.case, inside) {
        (Some(path), _) => {
            let path = file.resolve(path);
            let inputs = format!("inputs: {}", path.display());
            (Some(run_of_user(&path)?), inputs)
        }
        (None, Some((_, case))) => {
            let inputs = format!("inputs, unverified: {}", case.path().display());
            (Some(case.run()?.outcome), inputs)
        }
        (None, None) => (None, "no case: name one with `case`".to_owned()),
    };
    let lines = entry
        .values
        .iter()
        .map(|value| line(file, value, outcome.as_ref()));
    Ok(Comparison {
        title: format!("{}: {}; {inputs}", entry.name, entry.source),
        columns: vec![
            ("quantity", "quantity"),
            ("of", "of"),
            ("storey", "storey or level"),
            ("theirs", "theirs"),
            ("ours", "ours"),
            ("difference", "difference"),
            ("tolerance", "tolerance"),
            ("note", "note"),
        ],
        lines: lines.collect::<Result<_, _>>()?,
    })
}

fn line(
    file: &Entered,
    value: &EnteredValue,
    outcome: Option<&Outcome>,
) -> Result<Line, VerificationError> {
    let ours = outcome
        .map(|outcome| found(file, value, outcome))
        .transpose()?;
    let verdict = match (value.published, ours) {
        (Some(theirs), Some(ours)) if (ours - theirs).abs() <= value.tolerance * theirs.abs() => {
            Verdict::Reproduced
        }
        (Some(_), Some(_)) => Verdict::NotReproduced,
        _ => Verdict::NeedsData,
    };
    let claimed = match verdict {
        Verdict::NeedsData => Verdict::NeedsData,
        _ => Verdict::Reproduced,
    };
    let shown = |value: Option<f64>| value.filter(|v| v.is_finite()).map_or_else(nothing, digits);
    let difference = match (value.published, ours) {
        (Some(theirs), Some(ours)) if theirs != 0.0 && ours.is_finite() => {
            power(ours / theirs - 1.0, 1)
        }
        _ => nothing(),
    };
    Ok(Line {
        cells: vec![
            text(format!("{} ({})", value.quantity.key, value.quantity.unit)),
            text(value.of.as_str()),
            as_printed(value.storey as f64),
            value.published.map_or_else(nothing, as_printed),
            shown(ours),
            difference,
            power(value.tolerance, 0),
            text(value.note.as_str()),
        ],
        verdict,
        claimed,
    })
}

/// Our value.
fn found(
    file: &Entered,
    value: &EnteredValue,
    outcome: &Outcome,
) -> Result<f64, VerificationError> {
    let missing = |what: &str, names: Vec<&str>| {
        file.error(
            value.line,
            format!(
                "no {what} \"{}\" with {} in the case",
                value.of, value.storey
            ),
            format!("{what}s are {}", names.join(", ")),
        )
    };
    let place = value.storey - 1;
    match value.quantity.value {
        Place::Storey(of) => {
            let buildings = outcome.buildings.iter();
            let building = buildings.clone().find(|b| b.name == value.of);
            let storey = building.and_then(|b| b.storeys.get(place));
            let names = || buildings.map(|b| b.name.as_str()).collect();
            storey.map(of).ok_or_else(|| missing("building", names()))
        }
        Place::Level(of) => {
            let gaps = outcome.gaps.iter();
            let gap = gaps.clone().find(|g| g.name == value.of);
            let level = gap.and_then(|g| g.levels.get(place));
            let names = || gaps.map(|g| g.name.as_str()).collect();
            level.map(of).ok_or_else(|| missing("gap", names()))
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn refused(text: &str) -> EnteredError {
        Entered::parse(text, Some(Path::new("mine.toml"))).unwrap_err()
    }

    #[test]
    fn the_template_has_nothing_entered() {
        let part = entered(&Entered::template().unwrap()).unwrap();
        let lines: Vec<_> = part.comparisons.iter().flat_map(|c| &c.lines).collect();
        assert_eq!(lines.len(), 6);
        assert!(
            lines
                .iter()
                .all(|l| l.verdict == Verdict::NeedsData && l.holds())
        );
    }

    #[test]
    fn what_is_entered_is_compared() {
        // Ours itself, and twice as much.
        let ours = case_file!("entered/jankowski_2008").run().unwrap().outcome;
        let roof = ours.buildings[0].storeys[2].displacement.value;
        for (published, verdict) in [
            (roof, Verdict::Reproduced),
            (2.0 * roof, Verdict::NotReproduced),
        ] {
            let text = TEMPLATE.replacen(
                "published = \"\"",
                &format!("published = \"{} mm\"", 1.0e3 * published),
                1,
            );
            let part = entered(&Entered::parse(&text, None).unwrap()).unwrap();
            let first = &part.comparisons[0].lines[0];
            assert_eq!(first.verdict, verdict);
            assert_eq!(first.holds(), verdict == Verdict::Reproduced);
        }
    }

    #[test]
    fn errors_have_line_and_remedy() {
        let changed = |from: &str, to: &str| refused(&TEMPLATE.replacen(from, to, 1));
        for (error, problem) in [
            (
                changed("\"displacement\"", "\"moment\""),
                "unknown quantity \"moment\"",
            ),
            (
                changed("published = \"\"", "published = \"5 kN\""),
                "of another kind",
            ),
            (
                changed("published = \"\"", "published = \"five\""),
                "published: ",
            ),
            (
                changed("tolerance = \"5 %\"", "tolerance = \"500 %\""),
                "between 0 and 1",
            ),
            (changed("storey = 3", "storey = 0"), "storey is 0"),
            (changed("tolerance = ", "tolerence = "), "tolerence"),
            (refused(""), "no entries"),
        ] {
            assert!(error.problem.contains(problem), "{error}");
            assert!(error.line > 0 && !error.help.is_empty());
            assert!(error.to_string().starts_with("mine.toml, line "));
        }
        let unknown = TEMPLATE.replacen("of = \"left\"", "of = \"west\"", 1);
        let file = Entered::parse(&unknown, None).unwrap();
        let error = entered(&file).unwrap_err().to_string();
        assert!(error.contains("no building \"west\""), "{error}");
    }
}
