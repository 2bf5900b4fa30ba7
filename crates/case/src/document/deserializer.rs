//! Serde's view of a TOML tree, with the places of its values.
//!
//! Everything is read from a [`Value`], also a place or a piece of text: each deserializer more
//! would have every type compiled for it once more, with all types in it. For the same reason
//! what does not depend on the type stands in functions of its own.

use std::borrow::Cow;
use std::num::IntErrorKind;
use std::ops::Range;

use pounding_catalogue::suggestion;
use pounding_catalogue::wording::agreeing;
use serde::de::value::StrDeserializer;
use serde::de::{
    DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, Error as _, Expected, MapAccess,
    SeqAccess, Unexpected, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::Reader;
use super::entries::ask;
use super::error::{Error, Fault};

/// The value of a key, empty for the root of a tree; `None` after recording what is wrong.
pub(super) fn read<T: DeserializeOwned>(
    reader: Reader<'_>,
    key: &str,
    value: &Spanned<DeValue<'_>>,
) -> Option<T> {
    let value = Value {
        reader,
        key,
        wanted: "",
        or_each: false,
        held: Held::Given(value),
    };
    match T::deserialize(value) {
        Ok(read) => Some(read),
        Err(error) => {
            value.settled(error, true);
            None
        }
    }
}

/// A value with the name of its key, or something else about it.
#[derive(Clone, Copy)]
struct Value<'r> {
    reader: Reader<'r>,
    /// Empty for the root.
    key: &'r str,
    /// What the type that holds this one expects, if it says so.
    wanted: &'r str,
    /// Whether a list may stand in its place, with one value for each of several things.
    or_each: bool,
    held: Held<'r>,
}

#[derive(Clone, Copy)]
enum Held<'r> {
    Given(&'r Spanned<DeValue<'r>>),
    /// Not given in this table.
    Absent(&'r Keys<'r>),
    /// Not read because of an error that was recorded.
    Lost,
    /// What the table does not name.
    Free(&'r Keys<'r>),
    /// One of the keys that the table does not name, with its value, if that was not lost.
    Entry(&'r Key<'r>, Option<&'r Spanned<DeValue<'r>>>),
    /// A key with its place.
    Key(&'r Key<'r>),
    /// A word, or digits.
    Text(&'r str),
    /// Where something begins and ends.
    Span(usize, usize),
    /// One of these.
    Index(usize),
    /// Whether no errors came to so many.
    Whole(usize),
    /// Where the values of the keys of a table stand.
    Places(&'r Spanned<DeValue<'r>>),
}

/// What enums of words expect by `#[serde(expecting)]`, at least at its beginning; others are
/// tables.
const WORD: &str = "a text in quotes";

/// A table that a case must have, and what to do where it is missing.
const GROUND_MOTION: (&str, &str) = (
    "ground_motion",
    "add [ground_motion] with `file = \"...\"`, a record; where initial displacements, velocities or forces move the buildings without an earthquake, a record of zeros: a file with the lines `time (s),acceleration (m/s2)`, `0,0` and `0.1,0`, and a `duration` in [analysis]",
);

/// Keys that are lists of tables, one after another.
const TABLES: [&str; 2] = ["rule", "variable"];

/// What counts expect.
const WHOLE: &str = "a whole number";

/// Whole numbers up to which a double tells each from the next one: 2^53.
const MOST_EXACT: f64 = 9_007_199_254_740_992.0;

/// The name of a key or table in a message.
pub(super) fn quoted(name: &str) -> String {
    match name.contains('`') {
        true => name.to_owned(),
        false => format!("`{name}`"),
    }
}

/// Whether this is the name of a type, which is none for messages.
fn is_type(name: &str) -> bool {
    name.starts_with(char::is_uppercase)
}

/// What a type expects.
fn expected<'de>(visitor: &impl Visitor<'de>) -> String {
    (visitor as &dyn Expected).to_string()
}

/// The remedy for a word that is not known.
fn unknown_word(word: &str, known: &[&str], more: &str) -> String {
    let nearest = suggestion::misspelt(word, known);
    let guess = nearest.map_or_else(String::new, |k| format!("did you mean \"{k}\"? "));
    let more = match more {
        "" => String::new(),
        more => format!("; {more}"),
    };
    let are = agreeing(&known.len(), "is", "are");
    format!("{guess}known {are} {}{more}", known.join(", "))
}

impl<'r> Value<'r> {
    /// What is held by another key or at another place.
    fn with(self, key: &'r str, held: Held<'r>) -> Self {
        Self {
            key,
            wanted: "",
            or_each: false,
            held,
            ..self
        }
    }

    /// What a type asks for that holds more than what stands in the file, or the entries of a
    /// list; `None` where nothing of it is there.
    fn facts(self, name: &str, expecting: &dyn Expected) -> Result<Option<Parts<'r>>, Error> {
        let held = |held| Part::Value(Self { held, ..self });
        Ok(Some(match (name, self.held) {
            (ask::FIELD, Held::Given(value)) => {
                let span = value.span();
                let (start, end) = (Held::Index(span.start), Held::Index(span.end));
                parts([Part::Recorded(self), held(start), held(end)])
            }
            (ask::FIELD, _) => {
                self.given().map_err(|error| self.record(error)).err();
                return Ok(None);
            }
            (ask::LOCATED, Held::Key(key)) => {
                let (start, end) = (Held::Index(key.span().start), Held::Index(key.span().end));
                parts([Held::Text(key.get_ref()), start, end].map(held))
            }
            (ask::LOCATED, value) => {
                let span = self.given()?.span();
                parts([value, Held::Index(span.start), Held::Index(span.end)].map(held))
            }
            (ask::TABLE, value) => {
                let places = match value {
                    Held::Given(table) => Held::Places(table),
                    _ => value,
                };
                let whole = Held::Whole(self.reader.errors.count());
                parts([value, whole, places].map(held))
            }
            _ => match self.given()?.get_ref() {
                DeValue::Array(_) => self.entries()?,
                _ => return Err(self.wrong_type(&expecting.to_string())),
            },
        }))
    }

    /// What a newtype holds. `text` keeps what is written on the way.
    fn asked(
        self,
        name: &str,
        visitor: &dyn Expected,
        text: &'r mut String,
    ) -> Result<Asked<'r>, Error> {
        if name == ask::SCALAR
            && let Some(flag) = self.given()?.get_ref().as_bool()
        {
            return Ok(Asked::Flag(flag));
        }
        Ok(match name {
            ask::ONE_OR_EACH => match self.given()?.get_ref() {
                DeValue::Array(_) => Asked::Parts(self.entries()?),
                _ => Asked::Value(Self {
                    or_each: true,
                    ..self
                }),
            },
            ask::WRITTEN | ask::SCALAR => match self.written(visitor)? {
                Cow::Borrowed(text) => Asked::Text(text),
                Cow::Owned(digits) => {
                    *text = digits;
                    let held = Held::Text(text);
                    Asked::Value(Self { held, ..self })
                }
            },
            _ => {
                *text = visitor.to_string();
                let is_derived = text.starts_with("tuple struct ");
                let wanted = if is_derived { "" } else { text.as_str() };
                Asked::Value(Self { wanted, ..self })
            }
        })
    }

    /// The entries of a list, or of the keys that a table does not name. Errors of the entries
    /// are recorded, and the next entry can be read after one.
    fn entries(self) -> Result<Parts<'r>, Error> {
        if let Held::Free(keys) = self.held {
            let entry = |(key, value)| Part::Value(self.with(self.key, Held::Entry(key, value)));
            return Ok(parts(keys.free().into_iter().map(entry)));
        }
        let item = |item| Part::Recorded(self.with(self.key, Held::Given(item)));
        match self.given()?.get_ref() {
            DeValue::Array(items) => Ok(parts(items.iter().map(item))),
            _ => Err(self.wrong_type(self.wanted("a list"))),
        }
    }

    /// A key with its place, and its value; or where a place begins and ends.
    fn entry(self) -> Option<Parts<'r>> {
        let (first, second) = match self.held {
            Held::Entry(key, value) => {
                let value = value.map_or(Held::Lost, Held::Given);
                let key_itself = self.with(self.key, Held::Key(key));
                (key_itself, self.with(key.get_ref(), value))
            }
            Held::Span(start, end) => {
                let index = |index| self.with(self.key, Held::Index(index));
                (index(start), index(end))
            }
            _ => return None,
        };
        Some(parts([Part::Value(first), Part::Value(second)]))
    }

    /// A text, or the digits of a number.
    fn written(self, expecting: &dyn Expected) -> Result<Cow<'r, str>, Error> {
        Ok(Cow::Owned(match self.given()?.get_ref() {
            DeValue::String(text) => return Ok(Cow::Borrowed(text)),
            DeValue::Integer(i) if i.radix() == 10 => i.as_str().to_owned(),
            DeValue::Integer(i) => {
                let number = u64::from_str_radix(i.as_str(), i.radix());
                number.map_or_else(|_| i.as_str().to_owned(), |n| n.to_string())
            }
            DeValue::Float(f) => f.as_str().to_owned(),
            _ => return Err(self.wrong_type(&expecting.to_string())),
        }))
    }

    fn given(self) -> Result<&'r Spanned<DeValue<'r>>, Error> {
        match self.held {
            Held::Given(value) => Ok(value),
            Held::Absent(keys) => Err(keys.lacks(self.key)),
            // Of what is more than a value, errors were recorded.
            _ => Err(Error::Recorded),
        }
    }

    /// Reads the value; errors come with their place.
    fn read<'de, S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value, Error> {
        match seed.deserialize(self) {
            Ok(value) => Ok(value),
            Err(error) => Err(self.placed(error)),
        }
    }

    /// An error with its place, which may be recorded.
    fn settled(self, error: Error, is_recorded: bool) -> Error {
        match (self.placed(error), is_recorded) {
            (error, true) => self.record(error),
            (error, false) => error,
        }
    }

    fn record(self, error: Error) -> Error {
        if let Error::Placed(error) = error {
            self.reader.errors.record(*error);
        }
        Error::Recorded
    }

    fn placed(self, error: Error) -> Error {
        let Error::New(fault) = error else {
            return error;
        };
        let span = match self.held {
            Held::Given(value) => value.span(),
            _ => 0..0,
        };
        Error::Placed(Box::new(self.reader.fault(span, self.key, fault)))
    }

    fn wrong_type(self, wanted: &str) -> Error {
        let found = match self.given() {
            Err(error) => return error,
            Ok(value) => match value.get_ref() {
                DeValue::String(text) => Unexpected::Str(text),
                DeValue::Boolean(flag) => Unexpected::Bool(*flag),
                DeValue::Integer(_) => Unexpected::Signed(0),
                DeValue::Float(_) if wanted == WHOLE => Unexpected::Other("one with a fraction"),
                DeValue::Float(_) => Unexpected::Float(0.0),
                DeValue::Datetime(_) => Unexpected::Other("a date"),
                DeValue::Array(_) => Unexpected::Seq,
                DeValue::Table(_) => Unexpected::Map,
            },
        };
        let is_table = found == Unexpected::Map;
        match Error::invalid_type(found, &wanted) {
            Error::New(fault) if is_table && self.or_each => Error::New(Fault {
                help: format!(
                    "{}, or a list with one for each, in their order: [first, second]",
                    fault.help
                ),
                ..fault
            }),
            error => error,
        }
    }

    /// Refuses a value that is of another type.
    fn only(self, fits: fn(&DeValue<'r>) -> bool, wanted: &str) -> Result<Self, Error> {
        match fits(self.given()?.get_ref()) {
            true => Ok(self),
            false => Err(self.wrong_type(wanted)),
        }
    }

    /// The whole number that is written with a decimal point, as in 3.0: one to a JSON Schema.
    fn whole(self) -> Option<i64> {
        let DeValue::Float(digits) = self.given().ok()?.get_ref() else {
            return None;
        };
        let number: f64 = digits.as_str().parse().ok()?;
        let is_whole = number.fract() == 0.0 && number.abs() <= MOST_EXACT;
        is_whole.then_some(number as i64)
    }

    /// What the type that holds this one expects, or else this.
    fn wanted(self, otherwise: &'r str) -> &'r str {
        match self.wanted.is_empty() {
            true => otherwise,
            false => self.wanted,
        }
    }

    /// A table with these keys, which is called by its own name or else like its key.
    fn table(
        self,
        name: &'r str,
        fields: &'r [&'r str],
        expecting: &dyn Expected,
    ) -> Result<Keys<'r>, Error> {
        let name = match is_type(name) {
            true => self.key,
            false => name,
        };
        let value = self.given()?;
        if let DeValue::Table(table) = value.get_ref() {
            return Ok(Keys::new(self.reader, name, value.span(), table, fields));
        }
        let expecting = expecting.to_string();
        let is_derived = expecting.starts_with("struct ") || expecting.starts_with("enum ");
        let wanted = if is_derived { "a table" } else { &expecting };
        let named = self.with(name, self.held);
        Err(named.placed(named.wrong_type(wanted)))
    }
}

impl<'r> Value<'r> {
    /// A table with these keys, whose unknown keys are recorded.
    fn named_table(
        self,
        name: &'r str,
        fields: &'r [&'r str],
        expecting: &dyn Expected,
    ) -> Result<Keys<'r>, Error> {
        let keys = self.table(name, fields, expecting)?;
        let unknown = keys.all_known();
        // Keys of tables without a name of their own mean something together.
        if is_type(name) && !(self.key.is_empty() || keys.is_open()) {
            unknown?;
        }
        Ok(keys)
    }

    /// The one of several words that is written. `expecting` says what else may stand there,
    /// and in a second line, for words with a name, what there is more to know of them, for
    /// others the remedy.
    fn word(
        self,
        name: &str,
        words: &[&'static str],
        expecting: &str,
    ) -> Result<&'static str, Error> {
        let (form, more) = expecting.split_once('\n').unwrap_or((expecting, ""));
        let DeValue::String(word) = self.given()?.get_ref() else {
            let wanted = if is_type(name) { expecting } else { form };
            return Err(self.wrong_type(wanted));
        };
        if let Some(known) = words.iter().find(|known| *known == word) {
            return Ok(known);
        }
        let known: Vec<_> = words.iter().map(|v| format!("\"{v}\"")).collect();
        Err(Error::New(match is_type(name) {
            true => Fault::new(
                format!(" cannot be \"{word}\""),
                match more {
                    "" => format!("write {}", known.join(" or ")),
                    more => more.to_owned(),
                },
            ),
            false => Fault::new(
                format!("unknown {name} \"{word}\""),
                unknown_word(word, words, more),
            ),
        }))
    }

    /// A table of several kinds with keys of their own, or with one key, and the variant that
    /// it is.
    fn variant(
        self,
        name: &'r str,
        variants: &'r [&'static str],
        keys: &'r [&'r str],
        kinds: Option<&str>,
        expecting: &dyn Expected,
    ) -> Result<(Keys<'r>, &'static str), Error> {
        let keys = self.table(name, keys, expecting)?;
        keys.all_known()?;
        let given: Vec<_> = variants.iter().filter(|v| keys.get(v).is_some()).collect();
        if let [variant] = given.as_slice() {
            let variant = **variant;
            return Ok((keys, variant));
        }
        let (name, count) = (quoted(keys.name), given.len());
        Err(Error::New(match kinds {
            Some(kinds) if count == 0 => Fault::new(
                format!("{name} needs one of {kinds}"),
                "give one of them: none is there",
            ),
            Some(kinds) => Fault::new(
                format!("{name} must be of one kind, not {count}"),
                format!("it needs one of {kinds}, and nothing of the other kinds"),
            ),
            None => Fault::new(
                format!("{name} has one key, not {count}"),
                expecting
                    .to_string()
                    .lines()
                    .nth(1)
                    .unwrap_or("write one of them"),
            ),
        }))
    }
}

impl<'de> Deserializer<'de> for Value<'_> {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self.given()?.get_ref() {
            DeValue::String(text) => visitor.visit_str(text),
            DeValue::Boolean(flag) => visitor.visit_bool(*flag),
            DeValue::Integer(i) => {
                // What is no such number is as far out of every range as can be.
                visitor.visit_i64(match i64::from_str_radix(i.as_str(), i.radix()) {
                    Ok(number) => number,
                    Err(e) if *e.kind() == IntErrorKind::PosOverflow => i64::MAX,
                    Err(_) => i64::MIN,
                })
            }
            DeValue::Array(_) => self.deserialize_seq(visitor),
            _ => Err(self.wrong_type(&expected(&visitor))),
        }
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        if let Held::Whole(before) = self.held {
            return visitor.visit_bool(self.reader.errors.count() == before);
        }
        self.only(DeValue::is_bool, "true or false")?
            .deserialize_any(visitor)
    }

    fn deserialize_i64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        if let Some(number) = self.whole() {
            return visitor.visit_i64(number);
        }
        self.only(DeValue::is_integer, self.wanted(WHOLE))?
            .deserialize_any(visitor)
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self.held {
            Held::Index(index) => visitor.visit_u64(index as u64),
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        if let Held::Text(text) = self.held {
            return visitor.visit_str(text);
        }
        self.only(DeValue::is_str, WORD)?.deserialize_any(visitor)
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        self.deserialize_str(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self.held {
            Held::Absent(_) => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_seq(self.entries()?)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Error> {
        match self.asked(name, &visitor, &mut String::new())? {
            Asked::Value(value) => visitor.visit_newtype_struct(value),
            Asked::Text(text) => visitor.visit_str(text),
            Asked::Flag(flag) => visitor.visit_bool(flag),
            Asked::Parts(parts) => visitor.visit_seq(parts),
        }
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        _: usize,
        visitor: V,
    ) -> Result<V::Value, Error> {
        match self.facts(name, &visitor)? {
            Some(facts) => visitor.visit_seq(facts),
            None => visitor.visit_unit(),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        let keys = self.named_table(name, fields, &visitor)?;
        visitor.visit_map(Fields {
            table: self,
            keys: &keys,
            next: 0,
        })
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        if name == ask::TABLE_OR {
            let is_table = self.given()?.get_ref().is_table();
            return visitor.visit_enum(Kind {
                variant: variants[usize::from(is_table)],
                value: self,
                table: None,
            });
        }
        let expecting = expected(&visitor);
        if expecting.starts_with(WORD) {
            let variant = self.word(name, variants, &expecting)?;
            return visitor.visit_enum(Kind {
                variant,
                value: self.with(self.key, Held::Text(variant)),
                table: None,
            });
        }
        let kinds = self.wanted.split_once('\n');
        let all: Vec<&str> = match kinds {
            Some((keys, _)) => keys.split(", ").collect(),
            None => variants.to_vec(),
        };
        let kinds = kinds.map(|(_, kinds)| kinds);
        let (keys, variant) = self.variant(name, variants, &all, kinds, &visitor)?;
        visitor.visit_enum(Kind {
            variant,
            value: self.with(variant, keys.held(variant)),
            table: Some((self, &keys)),
        })
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Error> {
        match self.entry() {
            Some(entry) => visitor.visit_seq(entry),
            None => self.deserialize_any(visitor),
        }
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self.held {
            Held::Places(table) => visitor.visit_map(Places {
                value: self,
                rest: table.get_ref().as_table().into_iter().flatten().collect(),
                span: Held::Lost,
            }),
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        self.given()?;
        visitor.visit_unit()
    }

    forward_to_deserialize_any! {
        i8 i16 i32 i128 u8 u16 u32 u128 f32 f64 char bytes byte_buf unit unit_struct
        identifier
    }
}

/// What the visitor of a newtype is given.
enum Asked<'r> {
    Value(Value<'r>),
    Text(&'r str),
    Flag(bool),
    Parts(Parts<'r>),
}

/// One of several values.
enum Part<'r> {
    Value(Value<'r>),
    /// One whose errors are recorded.
    Recorded(Value<'r>),
}

struct Parts<'r>(std::vec::IntoIter<Part<'r>>);

fn parts<'r>(parts: impl IntoIterator<Item = Part<'r>>) -> Parts<'r> {
    Parts(parts.into_iter().collect::<Vec<_>>().into_iter())
}

impl<'r> Parts<'r> {
    /// The next value, and whether its errors are recorded.
    fn next(&mut self) -> Option<(Value<'r>, bool)> {
        Some(match self.0.next()? {
            Part::Value(value) => (value, false),
            Part::Recorded(value) => (value, true),
        })
    }
}

impl<'de> SeqAccess<'de> for Parts<'_> {
    type Error = Error;
    fn next_element_seed<S: DeserializeSeed<'de>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Error> {
        let Some((value, is_recorded)) = self.next() else {
            return Ok(None);
        };
        match seed.deserialize(value) {
            Ok(value) => Ok(Some(value)),
            Err(error) => Err(value.settled(error, is_recorded)),
        }
    }
}

/// Where the values of the keys of a table stand.
struct Places<'r> {
    value: Value<'r>,
    rest: Vec<(&'r Key<'r>, &'r Spanned<DeValue<'r>>)>,
    /// That of the key that was read last.
    span: Held<'r>,
}

impl<'de> MapAccess<'de> for Places<'_> {
    type Error = Error;
    fn next_key_seed<S: DeserializeSeed<'de>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Error> {
        let Some((key, value)) = self.rest.pop() else {
            return Ok(None);
        };
        self.span = Held::Span(value.span().start, value.span().end);
        let key = self.value.with(self.value.key, Held::Text(key.get_ref()));
        key.read(seed).map(Some)
    }
    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, Error> {
        self.value.with(self.value.key, self.span).read(seed)
    }
}

type Key<'r> = Spanned<Cow<'r, str>>;

/// The keys of a table beside those that it may have.
struct Keys<'r> {
    reader: Reader<'r>,
    name: &'r str,
    span: Range<usize>,
    table: &'r DeTable<'r>,
    fields: &'r [&'r str],
    /// Keys that are none of the table's, with the one that may be meant, in the order of the
    /// file.
    unknown: Vec<(&'r Key<'r>, Option<&'r str>)>,
    /// Of which kinds it can be.
    kinds: &'r str,
}

/// The field of all keys that a table does not name.
const FREE: &str = "*";

impl<'r> Keys<'r> {
    fn new(
        reader: Reader<'r>,
        name: &'r str,
        span: Range<usize>,
        table: &'r DeTable<'r>,
        fields: &'r [&'r str],
    ) -> Self {
        let mut keys = Self {
            reader,
            name,
            span,
            table,
            fields,
            unknown: Vec::new(),
            kinds: "",
        };
        let known = || fields.iter().copied().filter(|k| *k != FREE);
        // A key that is given already is meant once more if it begins alike: `stifness` beside `stiffness`,
        // but not `weight` beside `height`.
        let meant = |key: &str| {
            let begins = |k: &&str| k.chars().next() == key.chars().next();
            let absent = || known().filter(|k| !table.contains_key(*k));
            suggestion::misspelt(key, known().filter(begins))
                .or_else(|| suggestion::misspelt(key, absent()))
        };
        let unknown = |(key, _): (&'r Key<'r>, _)| match keys.is_open() {
            false => Some((key, meant(key.get_ref()))),
            // Where any key may stand, one that is nearly another is a slip.
            true => {
                let meant = suggestion::nearest_within(key.get_ref(), known(), 2);
                meant.map(|meant| (key, Some(meant)))
            }
        };
        keys.unknown = keys.others().filter_map(unknown).collect();
        keys.unknown.sort_by_key(|(key, _)| key.span().start);
        keys
    }

    fn is_open(&self) -> bool {
        self.fields.contains(&FREE)
    }

    fn get(&self, key: &str) -> Option<&'r Spanned<DeValue<'r>>> {
        self.table.get(key)
    }

    /// The keys that are not among the fields.
    fn others(&self) -> impl Iterator<Item = (&'r Key<'r>, &'r Spanned<DeValue<'r>>)> + use<'r> {
        let fields = self.fields;
        let is_other = move |key: &Key<'r>| fields.iter().all(|f| f != key.get_ref());
        self.table.iter().filter(move |(key, _)| is_other(key))
    }

    /// Records the keys that are unknown.
    fn all_known(&self) -> Result<(), Error> {
        for (key, nearest) in &self.unknown {
            let guess = nearest.map_or_else(String::new, |k| format!("did you mean `{k}`?"));
            let help = match self.is_open() {
                true => guess,
                false => format!("{guess} known keys: {}", self.fields.join(", ")),
            };
            let message = format!("unknown key `{}` in {}", key.get_ref(), self.name);
            let error = self.reader.error(key.span(), message, help.trim_start());
            self.reader.errors.record(error);
        }
        match self.unknown.as_slice() {
            [] => Ok(()),
            _ => Err(Error::Recorded),
        }
    }

    /// The error of a key that is not given.
    fn lacks(&self, key: &str) -> Error {
        let message = format!("{} has no `{key}`", self.name);
        let help = match self.kinds {
            "" if key == GROUND_MOTION.0 => GROUND_MOTION.1.to_owned(),
            "" if TABLES.contains(&key) => format!("add a [[{key}]]"),
            "" => format!("add `{key} = ...`"),
            kinds => format!("add `{key} = ...`; known are {kinds}"),
        };
        let error = self.reader.error(self.span.clone(), message, help);
        Error::Placed(Box::new(error))
    }

    /// What a field holds.
    fn held(&'r self, field: &str) -> Held<'r> {
        match self.get(field) {
            _ if field == FREE => Held::Free(self),
            Some(value) => Held::Given(value),
            None if self.unknown.iter().any(|(_, k)| *k == Some(field)) => Held::Lost,
            None => Held::Absent(self),
        }
    }

    /// The keys that the table does not name, in the order of the file; those that are nearly
    /// others without value.
    fn free(&self) -> Vec<(&'r Key<'r>, Option<&'r Spanned<DeValue<'r>>>)> {
        let held = |(key, value): (&'r Key<'r>, _)| {
            let unknown = self.unknown.iter().any(|(k, _)| k.span() == key.span());
            (key, (!unknown).then_some(value))
        };
        let mut free: Vec<_> = self.others().map(held).collect();
        free.sort_by_key(|(key, _)| key.span().start);
        free
    }
}

/// Every field of a table, whether it is given or not.
struct Fields<'r> {
    table: Value<'r>,
    keys: &'r Keys<'r>,
    next: usize,
}

impl<'r> Fields<'r> {
    /// The next field.
    fn field(&mut self) -> Option<StrDeserializer<'r, Error>> {
        let field = self.keys.fields.get(self.next)?;
        self.next += 1;
        Some(StrDeserializer::new(field))
    }

    /// The value of the last field.
    fn value(&self) -> Value<'r> {
        let field = self.keys.fields[self.next - 1];
        self.table.with(field, self.keys.held(field))
    }
}

impl<'de> MapAccess<'de> for Fields<'_> {
    type Error = Error;
    fn next_key_seed<S: DeserializeSeed<'de>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Error> {
        match self.field() {
            Some(field) => Ok(Some(seed.deserialize(field)?)),
            None => Ok(None),
        }
    }
    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, Error> {
        self.value().read(seed)
    }
}

/// One of several kinds of values.
struct Kind<'r> {
    variant: &'static str,
    /// The value of the key of that name.
    value: Value<'r>,
    /// The table that this key stands in, with those of all kinds.
    table: Option<(Value<'r>, &'r Keys<'r>)>,
}

impl<'de> EnumAccess<'de> for Kind<'_> {
    type Error = Error;
    type Variant = Self;
    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<(S::Value, Self), Error> {
        let variant = seed.deserialize(StrDeserializer::<Error>::new(self.variant))?;
        Ok((variant, self))
    }
}

impl<'de> VariantAccess<'de> for Kind<'_> {
    type Error = Error;

    fn unit_variant(self) -> Result<(), Error> {
        match self.value.held {
            Held::Text(_) => Ok(()),
            _ => Err(self.value.wrong_type(WORD)),
        }
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value, Error> {
        self.value.read(seed)
    }

    /// A table in which all keys belong to the one that names the kind.
    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        let (table, all) = self.table.ok_or(Error::Recorded)?;
        let mut keys = Keys::new(table.reader, all.name, all.span.clone(), all.table, fields);
        keys.kinds = table.wanted.split_once('\n').map_or("", |(_, kinds)| kinds);
        if let Some((key, _)) = keys.unknown.first() {
            let text = key.get_ref();
            let message = format!("`{text}` has no meaning beside `{}`", self.variant);
            let help = format!("remove `{text}`");
            let error = table.reader.error(key.span(), message, help);
            return Err(Error::Placed(Box::new(error)));
        }
        visitor.visit_map(Fields {
            table,
            keys: &keys,
            next: 0,
        })
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Error> {
        Err(self.value.wrong_type(&expected(&visitor)))
    }
}
