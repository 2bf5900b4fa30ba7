//! Values with their places, and the forms that they may have.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{self, Deserializer, SeqAccess, Visitor};

use super::error::Fault;
use super::schema::kinds_of;
use crate::located::Located;

/// Names by which types ask the deserializer for more than a value.
pub(super) mod ask {
    pub(in crate::document) const LOCATED: &str = "$located";
    pub(in crate::document) const FIELD: &str = "$field";
    pub(in crate::document) const TABLE: &str = "$table";
    pub(in crate::document) const ONE_OR_EACH: &str = "$one_or_each";
    pub(in crate::document) const TABLE_OR: &str = "$table_or";
    pub(in crate::document) const WRITTEN: &str = "$written";
    pub(in crate::document) const SCALAR: &str = "$scalar";
}

/// A key that must be given. What is wrong in its value was recorded.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Field<T> {
    /// The value.
    Given(Located<T>),
    /// It is missing, misspelt or wrong.
    #[default]
    Wrong,
}

/// A key that may be given.
pub type Optional<T> = Option<Field<T>>;

/// What both kinds of keys have.
pub trait Entry<T>: Sized {
    /// The value with its place.
    fn located(self) -> Option<Located<T>>;
    /// Where the value stands.
    fn span(&self) -> Option<Range<usize>>;
    /// Whether an error was recorded in the place of the value.
    fn is_wrong(&self) -> bool;
    /// The value.
    fn value(self) -> Option<T> {
        self.located().map(|located| located.value)
    }
    /// What is given, which may be nothing; `None` where it is wrong.
    fn stated(self) -> Option<Option<Located<T>>> {
        let is_wrong = self.is_wrong();
        let given = self.located();
        (given.is_some() || !is_wrong).then_some(given)
    }
    /// The value, or this one where none is given; `None` where it is wrong.
    fn value_or(self, default: T) -> Option<T> {
        let given = self.stated()?;
        Some(given.map_or(default, |located| located.value))
    }
    /// The same in SI units.
    fn number_or(self, default: f64) -> Option<f64>
    where
        T: Into<f64>,
    {
        let given = self.stated()?;
        Some(given.map_or(default, |located| located.value.into()))
    }
    /// The value in SI units.
    fn number(self) -> Option<f64>
    where
        T: Into<f64>,
    {
        self.value().map(Into::into)
    }
}

impl<T> Entry<T> for Field<T> {
    fn located(self) -> Option<Located<T>> {
        match self {
            Self::Given(located) => Some(located),
            Self::Wrong => None,
        }
    }
    fn span(&self) -> Option<Range<usize>> {
        match self {
            Self::Given(located) => Some(located.span.clone()),
            Self::Wrong => None,
        }
    }
    fn is_wrong(&self) -> bool {
        matches!(self, Self::Wrong)
    }
}

impl<T> Entry<T> for Optional<T> {
    fn located(self) -> Option<Located<T>> {
        self.and_then(Entry::located)
    }
    fn span(&self) -> Option<Range<usize>> {
        self.as_ref().and_then(Entry::span)
    }
    fn is_wrong(&self) -> bool {
        self.as_ref().is_some_and(Entry::is_wrong)
    }
}

/// A table with the places of its keys.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table<T> {
    /// What it holds.
    pub value: T,
    /// Whether nothing in it was found wrong.
    pub whole: bool,
    /// Where the values of its keys stand.
    pub places: BTreeMap<String, Range<usize>>,
}

/// Tables with their name in double brackets.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(expecting = "a list of tables\nwrite [[{key}]] with double brackets")]
pub struct Tables<T>(pub Vec<Field<T>>);

/// A list of at least one entry.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Vec<Field<T>>")]
pub struct List<T>(pub Vec<Field<T>>);

impl<T> TryFrom<Vec<Field<T>>> for List<T> {
    type Error = Fault;
    fn try_from(entries: Vec<Field<T>>) -> Result<Self, Fault> {
        match entries.is_empty() {
            false => Ok(Self(entries)),
            true => Err(Fault::new(
                " must be a list that is not empty",
                "write a list that is not empty",
            )),
        }
    }
}

impl<T> List<T> {
    /// The entries with their places, if none of them is wrong.
    #[must_use]
    pub fn whole(self) -> Option<Vec<Located<T>>> {
        self.0.into_iter().map(Entry::located).collect()
    }
}

/// A table, or a value in its place.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename = "$table_or")]
pub enum TableOr<T, V> {
    /// Another value.
    Value(V),
    /// A table.
    Table(T),
}

/// The keys of a table that it does not name, in the order of the file: of a field that is
/// renamed to `*`. A key that is nearly one of the others is wrong.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct FreeKeys<T>(pub Vec<(Located<String>, Field<T>)>);

/// An enum whose variants have fields: a table that is of the kind of the one variant that is
/// called like one of its keys.
#[derive(Debug, Clone, PartialEq)]
pub struct Kinds<T>(pub T);

/// One value for all places, or a list with one for each; of at least so many entries.
#[derive(Debug, Clone, PartialEq)]
pub enum OneOrEach<T, const LEAST: usize = 1> {
    /// For all.
    One(T),
    /// A list.
    Each(Vec<T>),
}

impl<T, const LEAST: usize> OneOrEach<T, LEAST> {
    /// Length of the list, if it is one.
    pub fn length(&self) -> Option<usize> {
        match self {
            Self::One(_) => None,
            Self::Each(values) => Some(values.len()),
        }
    }

    /// The values by themselves.
    pub fn into_list(self) -> Vec<T> {
        match self {
            Self::One(value) => vec![value],
            Self::Each(values) => values,
        }
    }

    /// A list of so many entries, if it is not one already.
    pub fn spread<U: Clone>(self, count: usize) -> Vec<U>
    where
        T: Into<U>,
    {
        match self {
            Self::One(value) => vec![value.into(); count],
            Self::Each(values) => values.into_iter().map(Into::into).collect(),
        }
    }
}

/// A visitor of one of the types here.
struct Of<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Field<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_tuple_struct(ask::FIELD, 3, Of::<Self>(PhantomData))
    }
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for Of<Field<T>> {
    type Value = Field<T>;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }
    fn visit_unit<E>(self) -> Result<Self::Value, E> {
        Ok(Field::Wrong)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut parts: A) -> Result<Self::Value, A::Error> {
        Ok(match located(&mut parts) {
            Ok(located) => Field::Given(located),
            Err(_) => Field::Wrong,
        })
    }
}

/// The next of several parts that are all there.
fn part<'de, T: Deserialize<'de>, A: SeqAccess<'de>>(parts: &mut A) -> Result<T, A::Error> {
    match parts.next_element()? {
        Some(part) => Ok(part),
        None => Err(de::Error::custom(" is not whole")),
    }
}

/// A value, and where it begins and ends.
fn located<'de, T: Deserialize<'de>, A: SeqAccess<'de>>(
    parts: &mut A,
) -> Result<Located<T>, A::Error> {
    Ok(Located {
        value: part(parts)?,
        span: part(parts)?..part(parts)?,
    })
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Located<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_tuple_struct(ask::LOCATED, 3, Of::<Self>(PhantomData))
    }
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for Of<Located<T>> {
    type Value = Located<T>;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut parts: A) -> Result<Self::Value, A::Error> {
        located(&mut parts)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Table<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_tuple_struct(ask::TABLE, 3, Of::<Self>(PhantomData))
    }
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for Of<Table<T>> {
    type Value = Table<T>;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table")
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut parts: A) -> Result<Self::Value, A::Error> {
        let (value, whole) = (part(&mut parts)?, part(&mut parts)?);
        let places: BTreeMap<String, (usize, usize)> = part(&mut parts)?;
        let place = |(key, (start, end))| (key, start..end);
        Ok(Table {
            value,
            whole,
            places: places.into_iter().map(place).collect(),
        })
    }
}

impl<'de, T: Deserialize<'de> + JsonSchema> Deserialize<'de> for Kinds<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_newtype_struct("Kinds", Of::<Self>(PhantomData))
    }
}

impl<'de, T: Deserialize<'de> + JsonSchema> Visitor<'de> for Of<Kinds<T>> {
    type Value = Kinds<T>;
    /// The keys of all kinds, and the kinds.
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&kinds_of::<T>())
    }
    fn visit_newtype_struct<D: Deserializer<'de>>(self, table: D) -> Result<Self::Value, D::Error> {
        T::deserialize(table).map(Kinds)
    }
}

impl<'de, T: Deserialize<'de>, const LEAST: usize> Deserialize<'de> for OneOrEach<T, LEAST> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_newtype_struct(ask::ONE_OR_EACH, Of::<Self>(PhantomData))
    }
}

impl<'de, T: Deserialize<'de>, const LEAST: usize> Visitor<'de> for Of<OneOrEach<T, LEAST>> {
    type Value = OneOrEach<T, LEAST>;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value or a list of values")
    }
    fn visit_newtype_struct<D: Deserializer<'de>>(self, one: D) -> Result<Self::Value, D::Error> {
        T::deserialize(one).map(OneOrEach::One)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Self::Value, A::Error> {
        let (mut values, mut wrong) = (Vec::new(), None);
        loop {
            match items.next_element() {
                Ok(Some(value)) => values.push(value),
                Ok(None) => break,
                // Recorded; the others are looked at.
                Err(e) => wrong = Some(e),
            }
        }
        match wrong {
            Some(e) => Err(e),
            None if values.len() < LEAST => Err(de::Error::custom(
                " is an empty list\ngive a list of values, or a single value for all",
            )),
            None => Ok(OneOrEach::Each(values)),
        }
    }
}

/// Types that look in a schema as what they hold.
macro_rules! as_what_they_hold {
    ($($name:ident),*) => {$(
        impl<T: JsonSchema> JsonSchema for $name<T> {
            fn schema_name() -> Cow<'static, str> {
                T::schema_name()
            }
            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                T::json_schema(generator)
            }
        }
    )*};
}

as_what_they_hold!(Located, Field, Table, FreeKeys);

// Each by the name of what it lists: a list in a list of another type is no recursion.
impl<T: JsonSchema> JsonSchema for Tables<T> {
    fn schema_name() -> Cow<'static, str> {
        format!("tables of {}", T::schema_name()).into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({"type": "array", "items": generator.subschema_for::<T>()})
    }
}

impl<T: JsonSchema> JsonSchema for List<T> {
    fn schema_name() -> Cow<'static, str> {
        format!("list of {}", T::schema_name()).into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let items = generator.subschema_for::<T>();
        json_schema!({"type": "array", "minItems": 1, "items": items})
    }
}

impl<T: JsonSchema, V: JsonSchema> JsonSchema for TableOr<T, V> {
    fn schema_name() -> Cow<'static, str> {
        format!("{} or {}", V::schema_name(), T::schema_name()).into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({"anyOf": [V::json_schema(generator), T::json_schema(generator)]})
    }
}

impl<T: JsonSchema, const LEAST: usize> JsonSchema for OneOrEach<T, LEAST> {
    fn schema_name() -> Cow<'static, str> {
        format!("{} or a list of {LEAST}", T::schema_name()).into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let one = T::json_schema(generator);
        json_schema!({"anyOf": [one, {"type": "array", "minItems": LEAST, "items": one}]})
    }
}

impl<T: JsonSchema> JsonSchema for Kinds<T> {
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = T::json_schema(generator);
        let kinds = schema.remove("anyOf").unwrap_or_default();
        schema.insert("oneOf".to_owned(), kinds);
        schema
    }
}
