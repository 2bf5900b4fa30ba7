//! Walking the TOML tree with places.

use std::ops::Range;

use pounding_catalogue::suggestion;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{CaseError, Errors};
use crate::schema::Key;
use crate::types::Located;
use crate::units::{Dimension, Quantity, parse_quantity};

/// A text being read.
#[derive(Clone, Copy)]
pub(crate) struct Reader<'a> {
    pub file: &'a str,
    pub source: &'a str,
    /// What was found wrong so far.
    pub errors: &'a Errors,
}

/// Largest number of storeys, lines to skip and the like: far above any use, and
/// small enough that a slip of the pen does not fill the memory.
const LARGEST_COUNT: usize = 100_000;

/// A TOML value with its place.
pub(crate) type Value<'a> = Spanned<DeValue<'a>>;

impl<'a> Reader<'a> {
    pub(crate) fn error(
        &self,
        span: Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> CaseError {
        CaseError::new(self.file, self.source, span, message, Some(help.into()))
    }

    /// Line of a place, from 1.
    pub(crate) fn line(&self, span: &Range<usize>) -> usize {
        self.error(span.clone(), "", "").line
    }

    /// The document.
    ///
    /// # Errors
    /// All that is not TOML; `help` says how to write it.
    pub(crate) fn document(&self, help: &str) -> Result<Spanned<DeTable<'a>>, CaseError> {
        let (tree, errors) = DeTable::parse_recoverable(self.source);
        let mut lines = Vec::new();
        for e in errors {
            let span = e.span().unwrap_or(0..0);
            let line = self.line(&span);
            // What follows in the same line is mostly of the parser's own making.
            if !lines.contains(&line) {
                lines.push(line);
                let message = format!("this is not TOML: {}", e.message());
                self.errors.record(self.error(span, message, help));
            }
        }
        self.errors.recorded().map_or(Ok(tree), Err)
    }

    /// The value as a table whose keys are all known: one whose keys mean something together,
    /// so that nothing else is said of it where a key is unknown.
    pub(crate) fn table<'v>(
        &self,
        value: &'v Value<'a>,
        name: &str,
        keys: &[Key],
    ) -> Result<Table<'v, 'a>, CaseError> {
        let table = self.section(value, name, keys)?;
        table
            .unknown
            .first()
            .map(|(_, e)| e.clone())
            .map_or(Ok(table), Err)
    }

    /// The value as a table whose keys are read one by one; unknown ones are recorded.
    pub(crate) fn section<'v>(
        &self,
        value: &'v Value<'a>,
        name: &str,
        keys: &[Key],
    ) -> Result<Table<'v, 'a>, CaseError> {
        let DeValue::Table(table) = value.get_ref() else {
            return Err(self.wrong_type(value, name, "a table"));
        };
        Ok(Table::new(*self, table, value.span(), name, keys))
    }

    /// The error for a value that is not there because of one recorded before.
    pub(crate) fn lost(&self) -> CaseError {
        self.errors
            .recorded()
            .unwrap_or_else(|| self.error(0..0, "the file cannot be read", "correct it"))
    }

    pub(crate) fn wrong_type(&self, value: &Value<'_>, key: &str, wanted: &str) -> CaseError {
        self.error(
            value.span(),
            format!(
                "`{key}` must be {wanted}, not {}",
                type_name(value.get_ref())
            ),
            match key {
                "damping" => {
                    "for example { stiffness_proportional = 0.05 }, the ratio in the first mode"
                        .to_owned()
                }
                _ => format!("write {wanted}"),
            },
        )
    }

    pub(crate) fn text(&self, value: &Value<'_>, key: &str) -> Result<Located<String>, CaseError> {
        match value.get_ref() {
            DeValue::String(text) => Ok(Located {
                value: text.to_string(),
                span: value.span(),
            }),
            _ => Err(self.wrong_type(value, key, "a text in quotes")),
        }
    }

    pub(crate) fn boolean(&self, value: &Value<'_>, key: &str) -> Result<bool, CaseError> {
        value
            .get_ref()
            .as_bool()
            .ok_or_else(|| self.wrong_type(value, key, "true or false"))
    }

    /// A whole number from `least` on.
    pub(crate) fn count(
        &self,
        value: &Value<'_>,
        key: &str,
        least: usize,
    ) -> Result<usize, CaseError> {
        let number = match value.get_ref() {
            DeValue::Integer(i) => usize::from_str_radix(i.as_str(), i.radix()).ok(),
            _ => return Err(self.wrong_type(value, key, "a whole number")),
        };
        number
            .filter(|n| (least..=LARGEST_COUNT).contains(n))
            .ok_or_else(|| {
                self.error(
                    value.span(),
                    format!("`{key}` must be a whole number from {least} to {LARGEST_COUNT}"),
                    "correct the number",
                )
            })
    }

    /// A number or a text with unit.
    pub(crate) fn any_quantity(&self, value: &Value<'_>, key: &str) -> Result<Quantity, CaseError> {
        self.quantity_for(value, key, None)
    }

    /// The same where one dimension is wanted, which is not checked: a unit that is not known
    /// leads to one that gives it.
    fn quantity_for(
        &self,
        value: &Value<'_>,
        key: &str,
        wanted: Option<Dimension>,
    ) -> Result<Quantity, CaseError> {
        // What is no number here is refused below as not finite.
        let number = |text: &str, value: Option<f64>| Quantity {
            value: value.unwrap_or(f64::NAN),
            dimension: None,
            text: text.to_owned(),
        };
        let quantity = match value.get_ref() {
            DeValue::Integer(i) if i.radix() == 10 => number(i.as_str(), i.as_str().parse().ok()),
            DeValue::Integer(i) => {
                let whole = u64::from_str_radix(i.as_str(), i.radix());
                number(i.as_str(), whole.ok().map(|n| n as f64))
            }
            DeValue::Float(f) => number(f.as_str(), f.as_str().parse().ok()),
            DeValue::String(text) => parse_quantity(text).map_err(|e| {
                self.error(value.span(), format!("`{key}`: {e}"), e.help_for(wanted))
            })?,
            _ => return Err(self.wrong_type(value, key, "a number, or a text with unit")),
        };
        if quantity.value.is_finite() {
            Ok(quantity)
        } else {
            Err(self.error(
                value.span(),
                format!("`{key}` = {} is not a finite number", quantity.text),
                "correct the number",
            ))
        }
    }

    /// A quantity of a dimension, in SI units.
    pub(crate) fn quantity(
        &self,
        value: &Value<'_>,
        key: &str,
        wanted: Dimension,
    ) -> Result<f64, CaseError> {
        let quantity = self.quantity_for(value, key, Some(wanted))?;
        match quantity.dimension {
            Some(found) if found != wanted => Err(self.error(
                value.span(),
                format!(
                    "`{key}` must be {wanted}, but \"{}\" is {found}",
                    quantity.text
                ),
                dimension_help(wanted, found),
            )),
            _ => Ok(quantity.value),
        }
    }

    pub(crate) fn positive(
        &self,
        value: &Value<'_>,
        key: &str,
        wanted: Dimension,
    ) -> Result<f64, CaseError> {
        let number = self.quantity(value, key, wanted)?;
        if number > 0.0 {
            Ok(number)
        } else {
            Err(self.error(
                value.span(),
                format!("`{key}` = {number} must be greater than zero"),
                "correct the value",
            ))
        }
    }

    /// A scalar or a list of quantities that must all pass `check`; each value
    /// with its place.
    pub(crate) fn list(
        &self,
        value: &Value<'_>,
        key: &str,
        read: impl Fn(&Value<'_>) -> Result<f64, CaseError>,
    ) -> Result<List, CaseError> {
        let values = match value.get_ref() {
            DeValue::Array(items) => {
                let values = self.errors.all(items.iter().map(read))?;
                if values.is_empty() {
                    return Err(self.error(
                        value.span(),
                        format!("`{key}` is an empty list"),
                        "give one value per storey, or a single value for all",
                    ));
                }
                Values::List(values)
            }
            _ => Values::Scalar(read(value)?),
        };
        Ok(List {
            values,
            span: value.span(),
        })
    }
}

/// A scalar that applies everywhere, or a list.
pub(crate) enum Values {
    Scalar(f64),
    List(Vec<f64>),
}

/// Values with their place.
pub(crate) struct List {
    pub values: Values,
    pub span: Range<usize>,
}

fn dimension_help(wanted: Dimension, found: Dimension) -> String {
    if wanted == Dimension::MASS && found == Dimension::FORCE {
        "a weight is a force: divide it by g, or write the mass in kg or t".to_owned()
    } else if wanted == Dimension::STIFFNESS && found == Dimension::FORCE {
        "a stiffness is a force over a length, such as \"3.46 MN/m\"".to_owned()
    } else if found == Dimension::ACCELERATION && wanted == Dimension::MASS {
        "\"g\" is the acceleration of gravity; write the mass in kg or t".to_owned()
    } else if wanted == Dimension::FORCE && found == Dimension::MASS {
        "a mass is no force: write N, kN, MN, lbf or kip".to_owned()
    } else {
        "correct the unit; plain numbers are SI".to_owned()
    }
}

fn type_name(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a text",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}

/// A table whose keys were checked.
pub(crate) struct Table<'v, 'a> {
    pub reader: Reader<'a>,
    table: &'v DeTable<'a>,
    pub span: Range<usize>,
    pub name: String,
    /// Keys that are none of the table's, and what was recorded of each.
    unknown: Vec<(Located<String>, CaseError)>,
    /// Keys that they may stand for.
    meant: Vec<&'static str>,
}

impl<'v, 'a> Table<'v, 'a> {
    /// Checks the keys and records those that are unknown. An entry `*` in `keys` admits
    /// any that is not nearly one of the others: that is a slip.
    pub(crate) fn new(
        reader: Reader<'a>,
        table: &'v DeTable<'a>,
        span: Range<usize>,
        name: &str,
        keys: &[Key],
    ) -> Self {
        let mut checked = Self {
            reader,
            table,
            span,
            name: name.to_owned(),
            unknown: Vec::new(),
            meant: Vec::new(),
        };
        let open = keys.iter().any(|k| k.name == "*");
        let known = || keys.iter().map(|k| k.name).filter(|k| *k != "*");
        for (key, _) in checked.entries() {
            let text = key.value.as_str();
            if known().any(|k| k == text) {
                continue;
            }
            let nearest = if open {
                suggestion::nearest(text, known()).filter(|k| suggestion::is_within(text, k, 2))
            } else {
                suggestion::misspelt(text, known())
            };
            if open && nearest.is_none() {
                continue;
            }
            let guess = nearest.map_or_else(String::new, |k| format!("did you mean `{k}`?"));
            let help = if open {
                guess
            } else {
                let all: Vec<_> = known().collect();
                format!("{guess} known keys: {}", all.join(", "))
                    .trim_start()
                    .to_owned()
            };
            let message = format!("unknown key `{text}` in {name}");
            let error = reader.error(key.span.clone(), message, help);
            reader.errors.record(error.clone());
            checked.meant.extend(nearest);
            checked.unknown.push((key, error));
        }
        checked
    }

    /// Whether a key was recorded as unknown.
    pub(crate) fn is_unknown(&self, key: &str) -> bool {
        self.unknown.iter().any(|(k, _)| k.value == key)
    }

    /// What was recorded of the key that was written for this one.
    pub(crate) fn misspelt(&self, key: &str) -> Option<CaseError> {
        self.meant
            .contains(&key)
            .then(|| self.reader.lost())
            .filter(|_| self.get(key).is_none())
    }

    pub(crate) fn get(&self, key: &str) -> Option<&'v Value<'a>> {
        self.table
            .iter()
            .find(|(k, _)| k.get_ref() == key)
            .map(|(_, v)| v)
    }

    pub(crate) fn required(&self, key: &str) -> Result<&'v Value<'a>, CaseError> {
        self.get(key).ok_or_else(|| {
            self.misspelt(key).unwrap_or_else(|| {
                self.reader.error(
                    self.span.clone(),
                    format!("{} has no `{key}`", self.name),
                    format!("add `{key} = ...`"),
                )
            })
        })
    }

    /// All entries with the places of their keys, in the order of the file.
    pub(crate) fn entries(&self) -> Vec<(Located<String>, &'v Value<'a>)> {
        let mut entries: Vec<_> = self
            .table
            .iter()
            .map(|(k, v)| {
                let key = Located {
                    value: k.get_ref().to_string(),
                    span: k.span(),
                };
                (key, v)
            })
            .collect();
        entries.sort_by_key(|(k, _)| k.span.start);
        entries
    }

    pub(crate) fn optional_positive(
        &self,
        key: &str,
        wanted: Dimension,
    ) -> Result<Option<f64>, CaseError> {
        self.get(key)
            .map(|v| self.reader.positive(v, key, wanted))
            .transpose()
    }

    pub(crate) fn optional_number(&self, key: &str) -> Result<Option<f64>, CaseError> {
        self.get(key)
            .map(|v| self.reader.quantity(v, key, Dimension::NUMBER))
            .transpose()
    }

    pub(crate) fn optional_text(&self, key: &str) -> Result<Option<Located<String>>, CaseError> {
        self.get(key).map(|v| self.reader.text(v, key)).transpose()
    }

    pub(crate) fn flag(&self, key: &str) -> Result<bool, CaseError> {
        self.get(key)
            .map_or(Ok(false), |v| self.reader.boolean(v, key))
    }
}
