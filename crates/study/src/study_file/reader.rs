//! Walking the TOML tree of a study with places.

use std::cell::RefCell;
use std::num::IntErrorKind;
use std::ops::Range;

use pounding_case::{CaseError, Dimension, Errors, Quantity, parse_quantity};
use pounding_catalogue::suggestion;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::StudyError;

pub(super) type Value<'a> = Spanned<DeValue<'a>>;
pub(super) type Result<T> = std::result::Result<T, Wrong>;

/// Why something has no value.
#[derive(Debug)]
pub(super) enum Wrong {
    /// This is wrong in the study file.
    Here(Box<CaseError>),
    /// What was recorded before: nothing more is said of what follows from it.
    Recorded,
}

/// A text being read.
#[derive(Clone, Copy)]
pub(super) struct Reader<'a> {
    pub file: &'a str,
    pub source: &'a str,
    /// What was found wrong so far.
    pub errors: &'a Errors,
    /// What was found wrong in other files, such as the case.
    pub elsewhere: &'a RefCell<Vec<StudyError>>,
}

/// Largest count that is taken for meant.
const LARGEST_COUNT: usize = 1_000_000_000;

impl<'a> Reader<'a> {
    pub(super) fn error(
        &self,
        span: Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Wrong {
        let error = CaseError::new(self.file, self.source, span, message, Some(help.into()));
        Wrong::Here(Box::new(error))
    }

    /// The value; `None` after recording what is wrong.
    pub(super) fn keep<T>(&self, result: Result<T>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(Wrong::Here(error)) => {
                self.errors.record(*error);
                None
            }
            Err(Wrong::Recorded) => None,
        }
    }

    /// Records what is wrong with something that has no value of its own.
    pub(super) fn check(&self, result: Result<()>) {
        self.keep(result);
    }

    /// All values, after recording what is wrong with any.
    pub(super) fn all<T>(&self, results: impl IntoIterator<Item = Result<T>>) -> Result<Vec<T>> {
        let kept = results.into_iter().map(|r| self.keep(r));
        // To the end, so that each is recorded.
        let kept: Vec<_> = kept.collect();
        kept.into_iter()
            .collect::<Option<_>>()
            .ok_or(Wrong::Recorded)
    }

    /// Records what is wrong in another file.
    pub(super) fn elsewhere(&self, error: StudyError) -> Wrong {
        self.elsewhere.borrow_mut().push(error);
        Wrong::Recorded
    }

    fn wrong(&self, value: &Value<'_>, key: &str, wanted: &str) -> Wrong {
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
        self.quantity_for(value, key, None)
    }

    /// The same where one dimension is wanted, which is not checked: a unit that is not known
    /// leads to one that gives it.
    fn quantity_for(
        &self,
        value: &Value<'_>,
        key: &str,
        wanted: Option<Dimension>,
    ) -> Result<Quantity> {
        self.maybe_quantity(value).ok_or_else(|| {
            // The reason why a text is none is worth more than that it is none.
            match value.get_ref().as_str().map(parse_quantity) {
                Some(Err(e)) => {
                    self.error(value.span(), format!("`{key}`: {e}"), e.help_for(wanted))
                }
                _ => self.wrong(value, key, "a finite number, or a text with a unit"),
            }
        })
    }

    pub(super) fn quantity(&self, value: &Value<'_>, key: &str, wanted: Dimension) -> Result<f64> {
        let quantity = self.quantity_for(value, key, Some(wanted))?;
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

    /// The value as a table; unknown keys are recorded.
    pub(super) fn table<'v>(
        &self,
        value: &'v Value<'a>,
        name: &str,
        keys: &[&'static str],
    ) -> Result<Table<'v, 'a>> {
        match value.get_ref() {
            DeValue::Table(table) => Ok(Table::new(*self, table, value.span(), name, keys)),
            _ => Err(self.wrong(value, name, "a table")),
        }
    }
}

/// A table whose unknown keys were recorded.
pub(super) struct Table<'v, 'a> {
    pub reader: Reader<'a>,
    table: &'v DeTable<'a>,
    pub span: Range<usize>,
    name: String,
    /// Keys that those which are none of the table's may stand for.
    meant: Vec<&'static str>,
}

impl<'v, 'a> Table<'v, 'a> {
    pub(super) fn new(
        reader: Reader<'a>,
        table: &'v DeTable<'a>,
        span: Range<usize>,
        name: &str,
        keys: &[&'static str],
    ) -> Self {
        let mut checked = Self {
            reader,
            table,
            span,
            name: name.to_owned(),
            meant: Vec::new(),
        };
        for key in table.keys() {
            let text = key.get_ref().as_ref();
            if keys.contains(&text) {
                continue;
            }
            let nearest = suggestion::misspelt(text, keys);
            let guess = nearest.map_or_else(String::new, |k| format!("did you mean `{k}`? "));
            let message = format!("unknown key `{text}` in {name}");
            let help = format!("{guess}known keys: {}", keys.join(", "));
            let file = reader.file;
            let error = CaseError::new(file, reader.source, key.span(), message, Some(help));
            reader.errors.record(error);
            checked.meant.extend(nearest.copied());
        }
        checked
    }

    /// Whether an unknown key may stand for this one, so that something of it is missing.
    pub(super) fn misspelt(&self, key: &str) -> bool {
        self.meant.contains(&key)
    }

    /// Whether this key is missing because it is misspelt.
    pub(super) fn lacks(&self, key: &str) -> bool {
        self.misspelt(key) && self.get(key).is_none()
    }

    pub(super) fn get(&self, key: &str) -> Option<&'v Value<'a>> {
        let mut entries = self.table.iter();
        entries.find(|(k, _)| k.get_ref() == key).map(|(_, v)| v)
    }

    pub(super) fn required(&self, key: &str) -> Result<&'v Value<'a>> {
        self.get(key).ok_or_else(|| {
            if self.lacks(key) {
                return Wrong::Recorded;
            }
            self.reader.error(
                self.span.clone(),
                format!("{} has no `{key}`", self.name),
                format!("add `{key} = ...`"),
            )
        })
    }

    /// What a key says, if it is there; `None` also after recording what is wrong with it.
    pub(super) fn optional<T>(
        &self,
        key: &str,
        read: impl FnOnce(&'v Value<'a>) -> Result<T>,
    ) -> Option<T> {
        self.get(key).and_then(|v| self.reader.keep(read(v)))
    }

    /// The same, or a default where the key is absent.
    ///
    /// # Errors
    /// What is wrong with the value.
    pub(super) fn or<T>(
        &self,
        key: &str,
        default: T,
        read: impl FnOnce(&'v Value<'a>) -> Result<T>,
    ) -> Result<T> {
        match self.get(key) {
            Some(v) => read(v),
            None if self.lacks(key) => Err(Wrong::Recorded),
            None => Ok(default),
        }
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
