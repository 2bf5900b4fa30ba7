//! What an explorer is asked for.

use pounding_study::edited::Change;
use serde::Deserialize;

use crate::fault::Refused;

/// A request, as its JSON text says it.
#[derive(Debug, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum Request {
    /// Keeps the bytes as the file of this name, for cases that name it.
    File { name: String },
    /// Takes the bytes as a file of rules for the gap from now on.
    Rules { name: String },
    /// Takes the bytes as the text of a case from now on.
    Open { name: String },
    /// What can be moved in the case.
    Controls { changes: Vec<Changed> },
    /// Runs it, with and without its gaps.
    Run {
        changes: Vec<Changed>,
        /// Most times of the motion of the buildings; zero for none.
        frames: usize,
    },
    /// Widths by demand, codes and combination rules.
    Widths { changes: Vec<Changed> },
    /// Parameters with which another model is like that of a gap.
    Calibrate {
        changes: Vec<Changed>,
        gap: usize,
        model: String,
    },
    /// Runs at several widths (m) of one gap, or of all.
    Sweep {
        changes: Vec<Changed>,
        gap: Option<usize>,
        widths: Vec<f64>,
    },
}

/// A change of the case.
#[derive(Debug, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
pub(crate) enum Changed {
    /// An entry has this value.
    Entry { path: String, value: Word },
    /// An entry is left out.
    Absent { absent: String },
    /// A gap has this model.
    Model {
        gap: String,
        keys: Vec<(String, Word)>,
    },
    /// The motion is read from this record.
    Record { record: Vec<(String, Word)> },
}

/// A value of a case: a quantity with its unit, a number in SI, or a list of them.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum Word {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// A list.
    List(Vec<Word>),
}

impl Word {
    /// As it is written in a case.
    fn written(&self) -> Result<String, Refused> {
        Ok(match self {
            Self::Number(x) if x.is_finite() => format!("{x:?}"),
            Self::Number(x) => {
                return Err(Refused::new(format!("{x} is no number of a case"), None));
            }
            // The escapes of JSON are those of TOML.
            Self::Text(text) => serde_json::Value::from(text.as_str()).to_string(),
            Self::List(words) => {
                let words: Result<Vec<String>, Refused> = words.iter().map(Self::written).collect();
                format!("[{}]", words?.join(", "))
            }
        })
    }
}

/// The changes as they are made in a text.
pub(crate) fn changes(changed: &[Changed]) -> Result<Vec<Change>, Refused> {
    let keys = |keys: &[(String, Word)]| -> Result<Vec<(String, String)>, Refused> {
        let written = keys.iter().map(|(k, w)| Ok((k.clone(), w.written()?)));
        written.collect()
    };
    let one = |changed: &Changed| {
        Ok(match changed {
            Changed::Entry { path, value } => Change::Entry {
                path: path.clone(),
                value: value.written()?,
            },
            Changed::Absent { absent } => Change::Absent {
                path: absent.clone(),
            },
            Changed::Model { gap, keys: new } => Change::Model {
                gap: gap.clone(),
                keys: keys(new)?,
            },
            Changed::Record { record } => Change::Record {
                keys: keys(record)?,
            },
        })
    };
    changed.iter().map(one).collect()
}
