//! Rules of users for the gap.

use std::sync::Arc;

use schemars::JsonSchema;
use serde::Deserialize;

use crate::document::{Entry, Field, FreeKeys, List, OneOrEach, Optional, Reader, Tables};
use crate::error::{CaseError, Errors};
use crate::located::Located;
use crate::types::{RuleText, TableText};
use crate::units::Quantity;

/// A rule of your own for the gap
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "a rule")]
pub(super) struct RuleTable {
    /// Name in tables and for `code` and `provisions`
    name: Field<String>,
    /// between, the distance of two buildings, or boundary, that of one from the property line
    kind: Field<Kind>,
    /// Width (m) as an expression of named quantities, see docs/reference/own-rules.md
    expression: Field<String>,
    /// Code or standard with its edition
    edition: Optional<String>,
    /// Clause
    clause: Optional<String>,
    /// Country or city
    region: Optional<String>,
    /// Numbers with units that the expression names, such as { least = "30 mm" }
    inputs: Optional<InputsTable>,
    /// Parts of the expression that have names, each an expression itself
    definitions: Optional<DefinitionsTable>,
    /// Tables that the expression calls, such as { part = { points = [[1, 0], [4, 0.02]],
    /// interpolation = "steps" } }
    tables: Optional<TablesTable>,
    /// What the rule takes for granted, in words
    assumptions: Optional<OneOrEach<String, 0>>,
}

/// What a rule measures
#[derive(Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", expecting = "a text in quotes")]
enum Kind {
    /// The distance of two buildings
    Between,
    /// That of one building from the border of its site
    Boundary,
}

/// Numbers with units
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "inputs")]
struct InputsTable {
    /// A number, with its unit in a text
    #[serde(rename = "*")]
    all: FreeKeys<Quantity>,
}

/// Parts of an expression
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "definitions")]
struct DefinitionsTable {
    /// An expression
    #[serde(rename = "*")]
    all: FreeKeys<String>,
}

/// Tables of one quantity over another
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "tables")]
struct TablesTable {
    /// A table
    #[serde(rename = "*")]
    all: FreeKeys<PointsTable>,
}

/// A table of one quantity over another
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "a table of points")]
struct PointsTable {
    /// Pairs of a quantity and its value, the first ones rising
    #[schemars(with = "Vec<Vec<Quantity>>")]
    points: Field<List<List<Quantity>>>,
    /// linear between the points, or steps: a value holds from its point to the next, the last
    /// one on for ever
    interpolation: Field<Interpolation>,
}

/// What holds between the points of a table
#[derive(Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", expecting = "a text in quotes")]
enum Interpolation {
    /// Straight lines
    Linear,
    /// The value of the point before
    Steps,
}

/// A file of rules
#[derive(Deserialize, JsonSchema)]
#[serde(rename = "the file of rules")]
struct RuleFile {
    /// Rules
    rule: Field<Tables<RuleTable>>,
}

impl RuleText {
    /// Reads a file of rules, tables `[[rule]]`.
    ///
    /// # Errors
    /// What is wrong in it, with its places.
    pub fn parse_all(source: &str, file: &str) -> Result<Vec<Self>, CaseError> {
        let errors = Errors::default();
        let reader = Reader {
            file,
            source,
            errors: &errors,
        };
        let read = reader.read::<RuleFile>("see the example in docs/reference/own-rules.md");
        let rules = read.and_then(|file| file.rule.value());
        let rules = rules.map(|rules| read_all(&reader, rules));
        errors.finish(Ok(rules.unwrap_or_default()))
    }
}

/// Rules that stand in a file.
pub(super) fn read_all(reader: &Reader<'_>, rules: Tables<RuleTable>) -> Vec<RuleText> {
    let (file, source): (Arc<str>, Arc<str>) = (reader.file.into(), reader.source.into());
    let tables = rules.0.into_iter().filter_map(Entry::value);
    let mut read: Vec<RuleText> = Vec::new();
    for rule in tables.filter_map(|table| table.read(reader, (file.clone(), source.clone()))) {
        if read.iter().any(|known| known.name.value == rule.name.value) {
            let message = format!("two rules are called \"{}\"", rule.name.value);
            reader.refuse::<()>(rule.name.span.clone(), message, "give each its own name");
        }
        read.push(rule);
    }
    read
}

impl RuleTable {
    fn read(self, reader: &Reader<'_>, (file, source): (Arc<str>, Arc<str>)) -> Option<RuleText> {
        // In one line of messages and tables.
        let of_a_line = |text: Located<String>| {
            if text.value.contains(char::is_control) {
                let message = format!("{:?} breaks a line or a table", text.value);
                return reader.refuse(text.span, message, "write it without control characters");
            }
            Some(text)
        };
        let text = |given: Optional<String>| {
            let text = given.located().and_then(of_a_line);
            text.map_or_else(String::new, |text| text.value)
        };
        let inputs = self.inputs.value().map_or_else(Vec::new, |t| t.all.0);
        let definitions = self.definitions.value().map_or_else(Vec::new, |t| t.all.0);
        let tables = self.tables.value().map_or_else(Vec::new, |t| t.all.0);
        let tables = tables.into_iter().filter_map(|(name, table)| {
            let table = table.located()?;
            Some((name, table.value.read(reader, table.span)?))
        });
        let tables = tables.collect();
        let whole = inputs
            .into_iter()
            .map(|(name, value)| Some((name, value.value()?)));
        let inputs: Option<Vec<_>> = whole.collect();
        let whole = definitions
            .into_iter()
            .map(|(name, text)| Some((name, text.located()?)));
        let definitions: Option<Vec<_>> = whole.collect();
        let name = self.name.located().and_then(of_a_line);
        if let Some(name) = name.as_ref().filter(|name| name.value.trim().is_empty()) {
            return reader.refuse(name.span.clone(), "a rule needs a name", "write one");
        }
        Some(RuleText {
            region: text(self.region),
            edition: text(self.edition),
            clause: text(self.clause),
            between: self.kind.value()? == Kind::Between,
            expression: self.expression.located()?,
            name: name?,
            inputs: inputs?,
            tables,
            definitions: definitions?,
            assumptions: self
                .assumptions
                .value()
                .map_or_else(Vec::new, OneOrEach::into_list),
            file,
            source,
        })
    }
}

impl PointsTable {
    fn read(self, reader: &Reader<'_>, span: std::ops::Range<usize>) -> Option<TableText> {
        let pair = |pair: Field<List<Quantity>>| {
            let Located { value, span } = pair.located()?;
            let values: Option<Vec<Quantity>> = value.0.into_iter().map(Entry::value).collect();
            match <[Quantity; 2]>::try_from(values?) {
                Ok(pair) => Some(pair),
                Err(other) => {
                    let message = format!("a point of a table has {} values", other.len());
                    reader.refuse(span, message, "write the quantity and its value: [3, 0.01]")
                }
            }
        };
        let points: Option<Vec<_>> = self.points.value()?.0.into_iter().map(pair).collect();
        Some(TableText {
            points: points?,
            steps: self.interpolation.value()? == Interpolation::Steps,
            span,
        })
    }
}
