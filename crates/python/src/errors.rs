//! Failures as exceptions of Python, with place and remedy in their text.

use miette::{Diagnostic, Report};
use pounding_cli::Failure;
use pyo3::exceptions::{PyKeyboardInterrupt, PyUserWarning};
use pyo3::prelude::*;

/// Errors of one case that are shown: more help nobody.
const MOST_SHOWN: usize = 20;

/// Where something is missing from a case that was made of a dict.
const WHOLE: &str = "the case";

/// Class of the exception for a record that is read by itself.
const OF_RECORD: &str = "RecordError";

/// A failure with the name of a text that nobody wrote: places in it are told by their keys.
#[derive(Debug)]
pub struct Problem {
    failure: Failure,
    /// Class of the exception for input that cannot be used.
    input: &'static str,
    /// Name in messages of a text that was made of a dict.
    made: Option<String>,
}

/// One thing that is wrong.
struct Fault {
    message: String,
    help: Option<String>,
    /// The line that it stands in.
    shown: String,
}

impl From<Failure> for Problem {
    fn from(failure: Failure) -> Self {
        Self {
            failure,
            input: "CaseError",
            made: None,
        }
    }
}

impl Problem {
    /// The same where places in the text of this name are to be told by keys.
    pub fn by_keys(self, made: Option<String>) -> Self {
        Self { made, ..self }
    }

    /// The same of a record.
    pub fn of_record(failure: Failure) -> Self {
        Self {
            input: OF_RECORD,
            ..failure.into()
        }
    }

    /// The same of a value of a kind that cannot stand in its place.
    pub fn of_type(failure: Failure) -> Self {
        Self {
            input: "CaseTypeError",
            ..failure.into()
        }
    }

    fn raised(self, py: Python<'_>) -> PyResult<PyErr> {
        let (class, reports) = match self.failure {
            Failure::Input(report) => (self.input, vec![report]),
            Failure::Inputs(reports) => (self.input, reports),
            Failure::Output(report) => ("OutputError", vec![report]),
            Failure::Computation(report) => ("ComputationError", vec![report]),
            Failure::Interrupted(report) => {
                return Ok(PyKeyboardInterrupt::new_err(report.to_string()));
            }
            // What only the commands answer.
            Failure::No | Failure::Reported(_) => ("ComputationError", Vec::new()),
        };
        let made = self.made.as_deref();
        let of_record = self.input == OF_RECORD;
        let faults: Vec<Fault> = reports.iter().map(|r| fault(r, made, of_record)).collect();
        let class = py.import("pounding._errors")?.getattr(class)?;
        let list: Vec<_> = faults
            .iter()
            .map(|f| (f.message.as_str(), f.help.as_deref()))
            .collect();
        Ok(PyErr::from_value(class.call1((text(&faults), list))?))
    }
}

impl From<Problem> for PyErr {
    fn from(problem: Problem) -> Self {
        Python::attach(|py| problem.raised(py).unwrap_or_else(|error| error))
    }
}

/// Warns as modules of Python do, of the line that calls the package: so many calls above this one. Where warnings
/// are errors, that is one: what is not to be done then comes after it.
///
/// # Errors
/// The warning.
pub fn warn(py: Python<'_>, text: &str, calls: i32) -> PyResult<()> {
    // A text from a file may hold what ends a text of C.
    let text = std::ffi::CString::new(text.replace('\0', "\u{fffd}"))?;
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, calls)
}

fn text(faults: &[Fault]) -> String {
    let mut lines = Vec::new();
    for fault in faults.iter().take(MOST_SHOWN) {
        lines.push(fault.message.clone());
        if !fault.shown.is_empty() {
            lines.push(format!("    {}", fault.shown));
        }
        if let Some(help) = &fault.help {
            lines.push(format!("  help: {help}"));
        }
    }
    if faults.len() > MOST_SHOWN {
        lines.push(format!(
            "{} errors, the first {MOST_SHOWN} shown",
            faults.len()
        ));
    }
    lines.join("\n")
}

/// What is wrong with all that led to it, each once.
fn whole_message(report: &Report) -> String {
    let mut message = String::new();
    for cause in report.chain().map(ToString::to_string) {
        match message.as_str() {
            "" => message = cause,
            told if told.contains(&cause) => {}
            _ => message = format!("{message}: {cause}"),
        }
    }
    message
}

fn fault(report: &Report, made: Option<&str>, of_record: bool) -> Fault {
    let diagnostic: &dyn Diagnostic = report.as_ref();
    let told = whole_message(report);
    let mut fault = Fault {
        message: with_keywords(&told),
        help: diagnostic.help().map(|h| {
            let help = with_keywords(&h.to_string());
            match of_record {
                true => without_keys(&help),
                false => help,
            }
        }),
        shown: String::new(),
    };
    let rest = made.and_then(|name| behind_the_place(&told, name));
    let rest = rest.map(with_keywords);
    if let Some(rest) = &rest {
        fault.message = format!("{WHOLE}: {rest}");
    }
    let label = diagnostic.labels().and_then(|mut labels| labels.next());
    let (Some(label), Some(source)) = (label, diagnostic.source_code()) else {
        return fault;
    };
    // From the start of the text to the end of the line at least.
    let Ok(contents) = source.read_span(label.inner(), usize::MAX / 4, 1) else {
        return fault;
    };
    // What is not there has no line, and no keys.
    if rest.is_some() && label.offset() == 0 && label.is_empty() {
        return fault;
    }
    let text = String::from_utf8_lossy(contents.data());
    let before = text.get(..label.offset()).unwrap_or(&text);
    let line = text.lines().nth(before.matches('\n').count());
    fault.shown = line.unwrap_or_default().trim().to_owned();
    if let Some(rest) = rest {
        fault.message = format!("{}: {rest}", key_path(&text, label.offset()));
    }
    fault
}

/// Options of the command line that are keywords here.
const KEYWORDS: [&str; 33] = [
    "approach-velocity",
    "code",
    "component",
    "confidence",
    "country",
    "date",
    "format",
    "from",
    "gap",
    "gravity",
    "keep-going",
    "layout",
    "lenient",
    "output",
    "points",
    "prepend-zero",
    "probability",
    "provisions",
    "quantity",
    "records",
    "response",
    "restitution",
    "resume",
    "rules",
    "sensitivity",
    "set",
    "shard",
    "skip-columns",
    "skip-lines",
    "threads",
    "time-step",
    "to",
    "unit",
];

/// Those whose values are numbers, which texts do not stand for.
const NUMBERS: [&str; 6] = [
    "confidence",
    "points",
    "restitution",
    "skip-columns",
    "skip-lines",
    "threads",
];

/// Those that are true or false.
const FLAGS: [&str; 4] = ["keep-going", "lenient", "prepend-zero", "resume"];

/// What options of the command line alone do, as remedies say it.
const WITHOUT_KEYWORD: [&str; 2] = [
    ", give all shards one folder with --into, where each has a name of its own",
    ", or give all shards one folder with --into, where each has a name of its own",
];

/// A message or a remedy with keywords and functions in the place of options and commands.
fn with_keywords(text: &str) -> String {
    let mut remedy = text.to_owned();
    for option in WITHOUT_KEYWORD {
        remedy = remedy.replace(option, "");
    }
    for option in ["-o", "--output"] {
        let file = "name another file";
        remedy = remedy.replace(&format!("{file} with {option}"), file);
    }
    let remedy = remedy.replace(" with -o", " with --output");
    // Code stands between backticks.
    let parts = remedy.split('`').enumerate().map(|(number, part)| {
        let (is_code, keyword) = (number % 2 == 1, keyword(part));
        match (is_code, part) {
            (true, "pounding motion") => "read_motion".to_owned(),
            (true, "pounding models") => "pounding.models()".to_owned(),
            (true, _) => keyword.unwrap_or_else(|| part.to_owned()),
            (false, _) => in_words(part),
        }
    });
    parts.collect::<Vec<_>>().join("`")
}

/// A remedy for a record that is read by itself, where keys of a case are keywords.
fn without_keys(remedy: &str) -> String {
    let parts = remedy.split('`').collect::<Vec<_>>();
    let of_a_case = |number: usize| {
        let behind = parts.get(number + 1);
        behind.is_some_and(|text| text.starts_with(" in [ground_motion]"))
    };
    let parts = parts.iter().enumerate().map(|(number, part)| {
        let is_code = number % 2 == 1 && !of_a_case(number);
        let keyword = is_code.then(|| of_a_key(part)).flatten();
        keyword.unwrap_or_else(|| (*part).to_owned())
    });
    parts.collect::<Vec<_>>().join("`")
}

/// An option with its value, if it has one, as a keyword.
fn keyword(option: &str) -> Option<String> {
    let (name, value) = match option.split_once(' ') {
        Some((name, value)) => (name, Some(value)),
        None => (option, None),
    };
    let name = name.strip_prefix("--")?;
    let name = match name {
        "from" => "from_".to_owned(),
        _ => KEYWORDS.contains(&name).then(|| name.replace('-', "_"))?,
    };
    let is_one_of = |options: &[&str]| options.iter().any(|o| o.replace('-', "_") == name);
    Some(match value.map(|value| value.trim_matches('"')) {
        Some(value) if is_one_of(&NUMBERS) => format!("{name}={value}"),
        Some(value) => format!("{name}=\"{value}\""),
        None if is_one_of(&FLAGS) => format!("{name}=True"),
        None => name,
    })
}

/// A key of a case with its value, as a keyword with it.
fn of_a_key(code: &str) -> Option<String> {
    let (name, value) = code.split_once(" = ")?;
    KEYWORDS
        .contains(&&*name.replace('_', "-"))
        .then(|| match value {
            "true" => format!("{name}=True"),
            value => format!("{name}={value}"),
        })
}

/// A text with keywords, as code, in the place of the options in it.
fn in_words(text: &str) -> String {
    let word = |word: &str| {
        let option = word.trim_end_matches([',', ';', '.', ':']);
        match keyword(option) {
            Some(name) => format!("`{name}`{}", &word[option.len()..]),
            None => word.to_owned(),
        }
    };
    text.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

/// What follows `name:line:column: ` in a message.
fn behind_the_place<'m>(message: &'m str, name: &str) -> Option<&'m str> {
    let rest = message.strip_prefix(name)?.strip_prefix(':')?;
    let digits = |c: char| c.is_ascii_digit() || c == ':';
    let rest = rest.trim_start_matches(digits);
    rest.strip_prefix(' ')
}

/// The keys that lead to a place of a text that was made of a dict, such as
/// `gap[1].width`.
fn key_path(text: &str, place: usize) -> String {
    let (mut table, mut counts) = (String::new(), std::collections::BTreeMap::new());
    let (mut start, mut key) = (0, "");
    for line in text.split_inclusive('\n') {
        if start > place {
            break;
        }
        start += line.len();
        let trimmed = line.trim();
        let inside = |open: &str, close: &str| trimmed.strip_prefix(open)?.strip_suffix(close);
        if let Some(name) = inside("[[", "]]") {
            let count = counts.entry(name.to_owned()).or_insert(0_usize);
            table = format!("{name}[{count}]");
            *count += 1;
            key = "";
        } else if let Some(name) = inside("[", "]") {
            // A table of the last entry of a list.
            let list = name.split('.').next().unwrap_or(name);
            table = match counts.get(list) {
                Some(count) if name != list => {
                    format!("{list}[{}]{}", count - 1, &name[list.len()..])
                }
                _ => name.to_owned(),
            };
            key = "";
        } else if let Some((name, _)) = trimmed.split_once(" = ") {
            key = name;
        }
    }
    match (table.is_empty(), key.is_empty()) {
        (true, true) => WHOLE.to_owned(),
        (true, false) => key.to_owned(),
        (false, true) => table,
        (false, false) => format!("{table}.{key}"),
    }
}
