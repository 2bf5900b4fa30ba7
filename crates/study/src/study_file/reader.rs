//! Walking the TOML tree of a study with places.

use std::num::IntErrorKind;
use std::ops::Range;

use pounding_case::{CaseError, Dimension, Quantity, parse_quantity};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::StudyError;

pub(super) type Value<'a> = Spanned<DeValue<'a>>;
pub(super) type Result<T> = std::result::Result<T, StudyError>;

/// A text being read.
#[derive(Clone, Copy)]
pub(super) struct Reader<'a> {
    pub file: &'a str,
    pub source: &'a str,
}

/// Largest count that is taken for meant.
const LARGEST_COUNT: usize = 1_000_000_000;

impl<'a> Reader<'a> {
    pub(super) fn error(
        &self,
        span: Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> StudyError {
        let error = CaseError::new(self.file, self.source, span, message, Some(help.into()));
        StudyError::Text {
            error: Box::new(error),
            source_text: self.source.to_owned(),
        }
    }

    fn wrong(&self, value: &Value<'_>, key: &str, wanted: &str) -> StudyError {
        self.error(
            value.span(),
            format!("`{key}` must be {wanted}"),
            format!("write {wanted}"),
        )
    }

    pub(super) fn text(&self, value: &Value<'_>, key: &str) -> Result<String> {
        let text = value.get_ref().as_str();
        text.map(str::to_owned)
            .ok_or_else(|| self.wrong(value, key, "a text in quotes"))
    }

    pub(super) fn flag(&self, value: &Value<'_>, key: &str) -> Result<bool> {
        let flag = value.get_ref().as_bool();
        flag.ok_or_else(|| self.wrong(value, key, "true or false"))
    }

    pub(super) fn list<'v>(&self, value: &'v Value<'a>, key: &str) -> Result<&'v [Value<'a>]> {
        match value.get_ref() {
            DeValue::Array(items) if !items.is_empty() => Ok(items),
            DeValue::Array(_) => Err(self.wrong(value, key, "a list that is not empty")),
            _ => Err(self.wrong(value, key, "a list")),
        }
    }

    pub(super) fn count(&self, value: &Value<'_>, key: &str, least: usize) -> Result<usize> {
        let number = match value.get_ref() {
            DeValue::Integer(i) => {
                let digits = i.as_str().replace('_', "");
                match usize::from_str_radix(&digits, i.radix()) {
                    Err(e) if *e.kind() == IntErrorKind::PosOverflow => Some(usize::MAX),
                    number => number.ok(),
                }
            }
            _ => None,
        };
        match number {
            Some(n) if n > LARGEST_COUNT => Err(self.error(
                value.span(),
                format!("`{key}` = {} is too large", &self.source[value.span()]),
                format!("write a whole number from {least} to {LARGEST_COUNT}"),
            )),
            Some(n) if n >= least => Ok(n),
            _ => Err(self.wrong(value, key, &format!("a whole number from {least} on"))),
        }
    }

    /// A number, or a text that begins with one; `None` for anything else.
    pub(super) fn maybe_quantity(&self, value: &Value<'_>) -> Option<Quantity> {
        let plain = |text: &str| {
            let number = text.replace('_', "").parse().ok()?;
            Some(Quantity {
                value: number,
                dimension: None,
                text: text.to_owned(),
            })
        };
        let quantity = match value.get_ref() {
            DeValue::Integer(i) if i.radix() == 10 => plain(i.as_str()),
            DeValue::Float(f) => plain(f.as_str()),
            DeValue::String(text) => parse_quantity(text).ok(),
            _ => None,
        };
        quantity.filter(|q| q.value.is_finite())
    }

    pub(super) fn any_quantity(&self, value: &Value<'_>, key: &str) -> Result<Quantity> {
        self.maybe_quantity(value).ok_or_else(|| {
            // The reason why a text is none is worth more than that it is none.
            match value.get_ref().as_str().map(parse_quantity) {
                Some(Err(e)) => self.error(value.span(), format!("`{key}`: {e}"), e.help()),
                _ => self.wrong(value, key, "a finite number, or a text with a unit"),
            }
        })
    }

    pub(super) fn quantity(&self, value: &Value<'_>, key: &str, wanted: Dimension) -> Result<f64> {
        let quantity = self.any_quantity(value, key)?;
        match quantity.dimension {
            Some(found) if found != wanted => Err(self.error(
                value.span(),
                format!(
                    "`{key}` must be {wanted}, but \"{}\" is {found}",
                    quantity.text
                ),
                "correct the unit; plain numbers are SI",
            )),
            _ => Ok(quantity.value),
        }
    }

    pub(super) fn positive(&self, value: &Value<'_>, key: &str, wanted: Dimension) -> Result<f64> {
        let number = self.quantity(value, key, wanted)?;
        if number > 0.0 {
            return Ok(number);
        }
        Err(self.error(
            value.span(),
            format!("`{key}` = {number} must be greater than zero"),
            "correct the value",
        ))
    }

    pub(super) fn table<'v>(
        &self,
        value: &'v Value<'a>,
        name: &str,
        keys: &[&str],
    ) -> Result<Table<'v, 'a>> {
        match value.get_ref() {
            DeValue::Table(table) => Table::new(*self, table, value.span(), name, keys),
            _ => Err(self.wrong(value, name, "a table")),
        }
    }
}

/// A table whose keys are all known.
pub(super) struct Table<'v, 'a> {
    pub reader: Reader<'a>,
    table: &'v DeTable<'a>,
    pub span: Range<usize>,
    name: String,
}

impl<'v, 'a> Table<'v, 'a> {
    pub(super) fn new(
        reader: Reader<'a>,
        table: &'v DeTable<'a>,
        span: Range<usize>,
        name: &str,
        keys: &[&str],
    ) -> Result<Self> {
        for key in table.keys() {
            let text = key.get_ref().as_ref();
            if keys.contains(&text) {
                continue;
            }
            let nearest = keys
                .iter()
                .min_by_key(|k| strsim::levenshtein(text, k))
                .filter(|k| strsim::levenshtein(text, k) <= 1 + text.len() / 3);
            let guess = nearest.map_or_else(String::new, |k| format!("did you mean `{k}`? "));
            return Err(reader.error(
                key.span(),
                format!("unknown key `{text}` in {name}"),
                format!("{guess}known keys: {}", keys.join(", ")),
            ));
        }
        Ok(Self {
            reader,
            table,
            span,
            name: name.to_owned(),
        })
    }

    pub(super) fn get(&self, key: &str) -> Option<&'v Value<'a>> {
        let mut entries = self.table.iter();
        entries.find(|(k, _)| k.get_ref() == key).map(|(_, v)| v)
    }

    pub(super) fn required(&self, key: &str) -> Result<&'v Value<'a>> {
        self.get(key).ok_or_else(|| {
            self.reader.error(
                self.span.clone(),
                format!("{} has no `{key}`", self.name),
                format!("add `{key} = ...`"),
            )
        })
    }

    /// All keys with their values, in the order of the file.
    pub(super) fn entries(&self) -> Vec<(String, &'v Value<'a>)> {
        let entries = self.table.iter();
        let mut entries: Vec<_> = entries.map(|(k, v)| (k.get_ref().to_string(), v)).collect();
        entries.sort_by_key(|(_, v)| v.span().start);
        entries
    }

    /// An error if both keys stand here, which exclude one another.
    pub(super) fn not_both(&self, a: &str, b: &str) -> Result<()> {
        match (self.get(a), self.get(b)) {
            (Some(_), Some(second)) => Err(self.reader.error(
                second.span(),
                format!(
                    "{} has `{a}` and `{b}`, which exclude one another",
                    self.name
                ),
                "remove one of them",
            )),
            _ => Ok(()),
        }
    }
}
