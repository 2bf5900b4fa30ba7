//! Numbers: quantities of a dimension, and counts.

use std::borrow::Cow;
use std::f64::consts::TAU;
use std::fmt;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{self, Deserializer, Visitor};

use super::entries::ask;
use super::error::Fault;
use crate::units::{Dimension, Quantity, force_meant, parse_quantity};

/// A number in SI units or a text with a unit, as written.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    text: String,
    /// Whether it is a plain number.
    plain: bool,
}

impl Written {
    /// The quantity, where this dimension is wanted, which is not checked: a unit that is not
    /// known leads to one that gives it.
    fn quantity(self, wanted: Option<Dimension>) -> Result<Quantity, Fault> {
        let quantity = if self.plain {
            Quantity {
                // What is no number is not finite either.
                value: self.text.parse().unwrap_or(f64::NAN),
                dimension: None,
                text: self.text,
            }
        } else {
            let read = parse_quantity(&self.text)
                .map_err(|e| Fault::new(format!(": {e}"), e.help_for(wanted)))?;
            // Who writes quotes means to write a unit: without one it is a pure number.
            Quantity {
                dimension: read.dimension.or(Some(Dimension::NUMBER)),
                ..read
            }
        };
        if quantity.value.is_finite() {
            return Ok(quantity);
        }
        let message = format!(" = {} is not a finite number", quantity.text);
        Err(Fault::new(message, "correct the number"))
    }

    /// The value in SI units of a quantity of this dimension.
    ///
    /// # Errors
    /// A text that is no quantity, a number that is not finite, or another dimension.
    pub fn of(self, wanted: Dimension) -> Result<f64, Fault> {
        self.quantity(Some(wanted))?.of(wanted)
    }

    /// The quantity, of any dimension.
    ///
    /// # Errors
    /// A text that is no quantity, or a number that is not finite.
    pub fn any(self) -> Result<Quantity, Fault> {
        self.quantity(None)
    }

    /// The value in SI units of a quantity of this dimension that is above zero.
    ///
    /// # Errors
    /// As [`Written::of`], and a value that is not above zero.
    pub fn above_zero(self, wanted: Dimension) -> Result<f64, Fault> {
        let value = self.of(wanted)?;
        AboveZero::check(value)?;
        Ok(value)
    }

    /// A text as it could be written.
    #[must_use]
    pub fn of_text(text: String) -> Self {
        Self { text, plain: false }
    }

    /// The text, or the digits of a number.
    #[must_use]
    pub fn as_written(&self) -> &str {
        &self.text
    }

    /// Whether it is a plain number, and no text.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.plain
    }

    /// Whether this stands in the unit.
    fn mentions(&self, unit: &str) -> bool {
        self.text.contains(unit)
    }
}

impl Quantity {
    /// The value in SI units, if it is of this dimension or a plain number.
    ///
    /// # Errors
    /// Another dimension.
    pub fn of(&self, wanted: Dimension) -> Result<f64, Fault> {
        match self.dimension {
            Some(found) if found != wanted && self.has_no_unit() => Err(Fault::new(
                format!(" must be {wanted}, but \"{}\" has no unit", self.text),
                self.unit_help(),
            )),
            Some(found) if found != wanted => Err(Fault::new(
                format!(" must be {wanted}, but \"{}\" is {found}", self.text),
                dimension_help(&self.text, wanted, found),
            )),
            _ => Ok(self.value),
        }
    }

    /// Whether it is a number alone, as text or plain.
    #[must_use]
    pub fn has_no_unit(&self) -> bool {
        self.text.trim().parse::<f64>().is_ok()
    }

    /// What to do about a text that needs a unit and has none.
    #[must_use]
    pub fn unit_help(&self) -> String {
        let number = self.text.trim();
        format!("add a unit, or write {number} without quotes: plain numbers are SI")
    }
}

fn dimension_help(text: &str, wanted: Dimension, found: Dimension) -> String {
    if wanted == Dimension::MASS && found == Dimension::FORCE {
        "a weight is a force: divide it by g, or write the mass in kg or t".to_owned()
    } else if wanted == Dimension::STIFFNESS && found == Dimension::FORCE {
        "a stiffness is a force over a length, such as \"3.46 MN/m\"".to_owned()
    } else if found == Dimension::ACCELERATION && wanted == Dimension::MASS {
        "\"g\" is the acceleration of gravity; write the mass in kg or t".to_owned()
    } else if wanted == Dimension::FORCE && found == Dimension::MASS {
        "a mass is no force: write N, kN, MN, kgf, tf, lbf or kip".to_owned()
    } else if let Some(force) = force_meant(text, wanted) {
        force
    } else {
        "correct the unit; plain numbers are SI".to_owned()
    }
}

/// A visitor of what is written.
struct Text;

impl<'de> Visitor<'de> for Text {
    type Value = Written;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or a text with unit")
    }
    fn visit_str<E>(self, text: &str) -> Result<Written, E> {
        Ok(Written {
            text: text.to_owned(),
            plain: false,
        })
    }
    /// The digits of a number.
    fn visit_newtype_struct<D: Deserializer<'de>>(self, digits: D) -> Result<Written, D::Error> {
        Ok(Written {
            text: String::deserialize(digits)?,
            plain: true,
        })
    }
}

impl<'de> Deserialize<'de> for Written {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_newtype_struct(ask::WRITTEN, Text)
    }
}

/// A value that is no list and no table.
#[derive(Debug, Clone, PartialEq)]
pub enum Scalar {
    /// True or false.
    Flag(bool),
    /// A number or a text.
    Written(Written),
}

impl<'de> Deserialize<'de> for Scalar {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Given;
        impl<'de> Visitor<'de> for Given {
            type Value = Scalar;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, a text, or true or false")
            }
            fn visit_bool<E>(self, flag: bool) -> Result<Scalar, E> {
                Ok(Scalar::Flag(flag))
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Scalar, E> {
                Text.visit_str(text).map(Scalar::Written)
            }
            fn visit_newtype_struct<D: Deserializer<'de>>(
                self,
                digits: D,
            ) -> Result<Scalar, D::Error> {
                Text.visit_newtype_struct(digits).map(Scalar::Written)
            }
        }
        deserializer.deserialize_newtype_struct(ask::SCALAR, Given)
    }
}

impl<'de> Deserialize<'de> for Quantity {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let written = Written::deserialize(deserializer)?;
        written.any().map_err(de::Error::custom)
    }
}

/// A dimension as a type.
pub trait Dimensioned {
    /// The dimension.
    const DIMENSION: Dimension;
    /// What a unit of an angle stands for: a number, as is usual, or a part of a cycle.
    const RADIAN: f64 = 1.0;
}

/// Frequency, Hz. An angle per second is a circular frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycles;

impl Dimensioned for Cycles {
    const DIMENSION: Dimension = Dimension::FREQUENCY;
    const RADIAN: f64 = TAU;
}

macro_rules! dimensions {
    ($($name:ident $constant:ident $what:literal;)*) => {$(
        #[doc = $what]
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name;
        impl Dimensioned for $name {
            const DIMENSION: Dimension = Dimension::$constant;
        }
    )*};
}

dimensions! {
    Number NUMBER "A pure number.";
    Mass MASS "Mass, kg.";
    Length LENGTH "Length, m.";
    Time TIME "Time, s.";
    Frequency FREQUENCY "Frequency, 1/s.";
    Velocity VELOCITY "Velocity, m/s.";
    Slowness SLOWNESS "Slowness, s/m.";
    Acceleration ACCELERATION "Acceleration, m/s2.";
    Force FORCE "Force, N.";
    Stiffness STIFFNESS "Stiffness, N/m.";
    Flexibility FLEXIBILITY "Flexibility, m/N.";
    FlexuralRigidity FLEXURAL_RIGIDITY "Flexural rigidity, N m2.";
    Dashpot DASHPOT "Dashpot coefficient, N s/m.";
    Density DENSITY "Density, kg/m3.";
    RotationalInertia ROTATIONAL_INERTIA "Rotational inertia, kg m2.";
    RotationalStiffness ROTATIONAL_STIFFNESS "Rotational stiffness, N m/rad.";
    RotationalDashpot ROTATIONAL_DASHPOT "Dashpot coefficient of a rotation, N m s/rad.";
}

/// The values that a number may have.
pub trait Within {
    /// Refuses others.
    ///
    /// # Errors
    /// A value outside.
    fn check(value: f64) -> Result<(), Fault>;
    /// The same for numbers without unit in a schema.
    const SCHEMA: &[(&str, f64)];
}

macro_rules! ranges {
    ($($name:ident $what:literal $schema:expr, |$value:ident| $inside:expr, $message:expr, $help:literal;)*) => {$(
        #[doc = $what]
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name;
        impl Within for $name {
            const SCHEMA: &[(&str, f64)] = $schema;
            fn check($value: f64) -> Result<(), Fault> {
                if $inside {
                    return Ok(());
                }
                Err(Fault::new($message, $help))
            }
        }
    )*};
}

ranges! {
    Any "Any value." &[], |value| true, format!(" = {value}"), "";
    AboveZero "Above zero." &[("exclusiveMinimum", 0.0)], |value| value > 0.0,
        format!(" = {value} must be greater than zero"), "write a value above zero";
    FromZero "Zero or more." &[("minimum", 0.0)], |value| value >= 0.0,
        format!(" = {value} must be zero or more"), "write zero or a value above it";
    BelowOne "A damping ratio." &[("minimum", 0.0), ("exclusiveMaximum", 1.0)],
        |value| (0.0..1.0).contains(&value),
        format!("damping ratio {value} is not from 0 to below 1"), "5 % of critical is 0.05 or \"5 %\"";
    BelowHalf "A Poisson's ratio of soil." &[("minimum", 0.0), ("exclusiveMaximum", 0.5)],
        |value| (0.0..0.5).contains(&value),
        format!(" = {value} must be a Poisson's ratio from 0 to below 0.5"),
        "soils have 0.25 to 0.45; for saturated clay write 0.49";
}

/// A quantity of a dimension within a range, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amount<D, R> {
    value: f64,
    of: PhantomData<(D, R)>,
}

/// Any value of a dimension.
pub type Signed<D> = Amount<D, Any>;
/// A value above zero.
pub type Positive<D> = Amount<D, AboveZero>;
/// Zero or more.
pub type NotNegative<D> = Amount<D, FromZero>;
/// A damping ratio.
pub type Ratio = Amount<Number, BelowOne>;
/// A Poisson's ratio of soil.
pub type Poisson = Amount<Number, BelowHalf>;

impl<D, R> From<Amount<D, R>> for f64 {
    fn from(amount: Amount<D, R>) -> Self {
        amount.value
    }
}

impl<D: Dimensioned, R: Within> TryFrom<Written> for Amount<D, R> {
    type Error = Fault;
    fn try_from(written: Written) -> Result<Self, Fault> {
        let radian = if written.mentions("rad") {
            D::RADIAN
        } else {
            1.0
        };
        let value = written.of(D::DIMENSION)?;
        R::check(value)?;
        Ok(Self {
            value: value / radian,
            of: PhantomData,
        })
    }
}

impl<'de, D: Dimensioned, R: Within> Deserialize<'de> for Amount<D, R> {
    fn deserialize<T: Deserializer<'de>>(deserializer: T) -> Result<Self, T::Error> {
        let written = Written::deserialize(deserializer)?;
        Self::try_from(written).map_err(de::Error::custom)
    }
}

/// A whole number in a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Count<const LEAST: usize, const MOST: usize = LARGEST_COUNT>(pub usize);

/// Largest number of storeys, lines to skip and the like: far above any use, and small enough
/// that a mistyped number does not fill the memory.
const LARGEST_COUNT: usize = 100_000;

impl<'de, const LEAST: usize, const MOST: usize> Deserialize<'de> for Count<LEAST, MOST> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let number = usize::try_from(i64::deserialize(deserializer)?);
        match number {
            Ok(number) if (LEAST..=MOST).contains(&number) => Ok(Self(number)),
            _ => Err(de::Error::custom(format!(
                " must be a whole number from {LEAST} to {MOST}\ncorrect the number"
            ))),
        }
    }
}

macro_rules! written {
    ($($name:ident),*) => {$(
        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                "quantity".into()
            }
            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!({"type": ["number", "string"]})
            }
        }
    )*};
}

written!(Written, Quantity);

impl JsonSchema for Scalar {
    fn schema_name() -> Cow<'static, str> {
        "scalar".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({"type": ["number", "string", "boolean"]})
    }
}

impl<D, R: Within> JsonSchema for Amount<D, R> {
    fn schema_name() -> Cow<'static, str> {
        Written::schema_name()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = Written::json_schema(generator);
        for (limit, value) in R::SCHEMA {
            schema.insert((*limit).to_owned(), (*value).into());
        }
        schema
    }
}

impl<const LEAST: usize, const MOST: usize> JsonSchema for Count<LEAST, MOST> {
    fn schema_name() -> Cow<'static, str> {
        format!("from {LEAST} to {MOST}").into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({"type": "integer", "minimum": LEAST, "maximum": MOST})
    }
}
