//! A case with some of its entries replaced, as a text that `pounding run` takes.

use crate::case_text::{Edit, KEPT, Path, apply, entry, with_model, with_motion, without};

/// What is changed in a case; values are TOML.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Change {
    /// The value of an entry, such as `gap.0.width`; it is put in where the case leaves it out.
    Entry {
        /// Where it stands.
        path: String,
        /// The new value.
        value: String,
    },
    /// An entry that the case leaves out; what it has of it is taken away.
    Absent {
        /// Where it would stand.
        path: String,
    },
    /// The impact model of a gap with all that belongs to it.
    Model {
        /// The gap, such as `gap.0`.
        gap: String,
        /// `model` and its parameters.
        keys: Vec<(String, String)>,
    },
    /// The record with all that says how it is read; its scale and how it is processed stay, and so
    /// does the record across the row.
    Record {
        /// `file`, and how it is read where its own header does not say it.
        keys: Vec<(String, String)>,
    },
}

/// A change that the text of a case leaves no room for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{reason}")]
pub struct NoRoom {
    /// Why.
    pub reason: String,
    /// What to do.
    pub help: String,
}

/// The text of a sound case with these changes, made one after another.
///
/// # Errors
/// A path that leads nowhere, or a table that is written so that its text cannot be replaced.
pub fn edited(source: &str, changes: &[Change]) -> Result<String, NoRoom> {
    let mut text = source.to_owned();
    for change in changes {
        text = one(&text, change).map_err(|(reason, help)| NoRoom { reason, help })?;
    }
    Ok(text)
}

fn one(text: &str, change: &Change) -> Result<String, (String, String)> {
    let path = |text: &str| {
        let help = "write it as gap.0.width".to_owned();
        let path = Path::parse(text).map(Path::counted);
        path.map_err(|reason| (reason, help))
    };
    let edits = match change {
        Change::Entry { path: place, value } => {
            vec![Edit::new(&entry(text, &path(place)?)?, value.clone())]
        }
        Change::Absent { path: place } => without(text, &path(place)?)?,
        Change::Model { gap, keys } => with_model(text, &path(gap)?, keys.clone())?,
        Change::Record { keys } => {
            with_motion(text, &[&["scale"][..], &KEPT].concat(), keys.clone())?
        }
    };
    Ok(apply(text, &edits))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const CASE: &str = "[[gap]]\nwidth = \"20 mm\" # as built\nmodel = \"hertz_1882\"\nstiffness = 1e9\n\n[ground_motion]\nfile = \"a.csv\"\nunit = \"g\"\nscale = 2\n";

    #[test]
    fn changes_are_made_one_after_another() {
        let entry = |path: &str, value: &str| Change::Entry {
            path: path.to_owned(),
            value: value.to_owned(),
        };
        let keys = |pairs: &[(&str, &str)]| {
            let owned = |(k, v): &(&str, &str)| ((*k).to_owned(), (*v).to_owned());
            pairs.iter().map(owned).collect()
        };
        let changes = [
            entry("gap.0.width", "\"118 mm\""),
            Change::Model {
                gap: "gap.0".to_owned(),
                keys: keys(&[("model", "\"linear_elastic\""), ("stiffness", "1e8")]),
            },
            entry("gap.0.stiffness", "2e8"),
            Change::Record {
                keys: keys(&[("file", "\"b.csv\"")]),
            },
        ];
        let text = edited(CASE, &changes).unwrap();
        assert_eq!(
            text,
            "[[gap]]\nmodel = \"linear_elastic\"\nstiffness = 2e8\nwidth = \"118 mm\" # as built\n\n\n\n[ground_motion]\nfile = \"b.csv\"\n\n\nscale = 2\n"
        );
        // What the case leaves out already is left out.
        let absent = |path: &str| Change::Absent {
            path: path.to_owned(),
        };
        let changes_of_gap = [absent("gap.0.stiffness"), absent("gap.0.restitution")];
        assert_eq!(
            edited(CASE, &changes_of_gap).unwrap(),
            CASE.replace("stiffness = 1e9", "")
        );
        // What acts on every record stays, wherever it stands.
        for across in [
            "process = [{ filter = { high_pass = 0.1 } }]\n",
            "\n[[ground_motion.process]]\nresample = 0.01\n",
            "across = { file = \"ew.csv\", scale = 2 }\n",
            "\n[ground_motion.across]\nfile = \"ew.csv\"\nscale = 2\n",
        ] {
            let text = edited(&format!("{CASE}{across}"), &changes[3..]).unwrap();
            let expected = "[ground_motion]\nfile = \"b.csv\"\n\n\nscale = 2\n";
            assert!(
                text.ends_with(&format!("{expected}{across}")),
                "{across}: {text}"
            );
        }
        // Numbers are places here, also where gaps have numbers as names.
        let named = CASE.replace(
            "[[gap]]",
            "[[gap]]\nname = \"1\"\nwidth = 7\n\n[[gap]]\nname = \"0\"",
        );
        let text = edited(&named, &[entry("gap.1.width", "8")]).unwrap();
        assert_eq!(text, named.replace("\"20 mm\"", "8"));
        let refused = edited(CASE, &[entry("gap.1.width", "1")]).unwrap_err();
        assert!(refused.reason.contains("1 entry"), "{refused}");
        assert!(edited(CASE, &[entry("gap..width", "1")]).is_err());
    }
}
