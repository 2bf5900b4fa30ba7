//! Values such as `high_pass=0.1 Hz, order=4` and `ramped, rise=2 s`.

use pounding_case::Dimension;

use crate::arguments::value;
use crate::failure::Failure;

/// A word and pairs behind it, of one option.
pub struct Words<'a> {
    option: &'a str,
    /// The word; empty if the text starts with a pair.
    pub word: &'a str,
    pairs: Vec<(&'a str, &'a str)>,
}

impl<'a> Words<'a> {
    /// Divides the text of an option at its commas.
    pub fn of(option: &'a str, text: &'a str) -> Result<Self, Failure> {
        let mut words = Self {
            option,
            word: "",
            pairs: Vec::new(),
        };
        for (place, part) in text.split(',').map(str::trim).enumerate() {
            match part.split_once('=') {
                Some((key, value)) => words.add(key.trim(), value.trim())?,
                None if place == 0 => words.word = part,
                None => return Err(words.no_pair(part)),
            }
        }
        Ok(words)
    }

    fn no_pair(&self, part: &str) -> Failure {
        Failure::input(
            format!("--{}: \"{part}\" is not key=value", self.option),
            Some("write pairs divided by commas, such as \"start=2 s, end=30 s\"".into()),
        )
    }

    /// Takes a pair; of two with one key it could not be known which is meant.
    fn add(&mut self, key: &'a str, value: &'a str) -> Result<(), Failure> {
        if let Some((_, first)) = self.pairs.iter().find(|(k, _)| *k == key) {
            return Err(Failure::input(
                format!(
                    "--{}: \"{key}\" is given twice, as \"{first}\" and as \"{value}\"",
                    self.option
                ),
                Some(format!("leave one \"{key}=...\"")),
            ));
        }
        self.pairs.push((key, value));
        Ok(())
    }

    /// Refuses keys that mean nothing here.
    pub fn only(&self, known: &[&str]) -> Result<(), Failure> {
        match self.pairs.iter().find(|(key, _)| !known.contains(key)) {
            None => Ok(()),
            Some((key, _)) => Err(Failure::input(
                format!("--{}: \"{key}\" is not known", self.option),
                Some(format!("known keys: {}", known.join(", "))),
            )),
        }
    }

    /// Whether a key is given.
    pub fn has(&self, key: &str) -> bool {
        self.pairs.iter().any(|(k, _)| *k == key)
    }

    /// The text of a key.
    pub fn text(&self, key: &str) -> Result<&'a str, Failure> {
        let pair = self.pairs.iter().find(|(k, _)| *k == key);
        pair.map(|(_, value)| *value).ok_or_else(|| {
            Failure::input(
                format!("--{} needs {key}", self.option),
                Some(format!("add \"{key}=...\"")),
            )
        })
    }

    /// The SI value of a key.
    pub fn value(&self, key: &str, dimension: Dimension) -> Result<f64, Failure> {
        value(
            self.text(key)?,
            &format!("{}: {key}", self.option),
            dimension,
        )
    }

    /// The same as a line of a case file: `key = { ... }` or `key = "word"`, which holds no word
    /// beside pairs.
    pub fn as_toml(&self, key: &str) -> Result<String, Failure> {
        match (self.word, self.pairs.is_empty()) {
            (word, true) => Ok(format!("{key} = {}", literal(word))),
            ("", false) => Ok(format!("{key} = {{ {} }}", self.pairs_as_toml().join(", "))),
            (word, false) => Err(self.no_pair(word)),
        }
    }

    /// The pairs as lines of a case file.
    pub fn pairs_as_toml(&self) -> Vec<String> {
        let pairs = self.pairs.iter();
        pairs
            .map(|(k, v)| format!("{} = {}", quoted(k), literal(v)))
            .collect()
    }
}

/// A text in the quotes of TOML.
pub fn quoted(text: &str) -> String {
    serde_json::Value::String(text.to_owned()).to_string()
}

/// Numbers and flags as they are, all else in quotes.
fn literal(text: &str) -> String {
    let plain = text.parse::<i64>().is_ok()
        || matches!(text, "true" | "false")
        || (text.parse::<f64>().is_ok_and(f64::is_finite)
            && text.starts_with(|c: char| c.is_ascii_digit() || c == '-'));
    if plain {
        // TOML wants a digit on both sides of the point.
        return match text.parse::<f64>() {
            Ok(number) if text.contains(['.', 'e', 'E']) => format!("{number:?}"),
            _ => text.to_owned(),
        };
    }
    quoted(text)
}
