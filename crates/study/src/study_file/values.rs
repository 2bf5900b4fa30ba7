//! Values of a variable: lists and ranges.

use std::borrow::Cow;
use std::ops::Range;

use pounding_case::document::{Entry, Fault, Field, List, Optional, Reader, Written};
use pounding_case::{Dimension, Located};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error as _};

use super::distribution::Distribution;
use super::keys::{Place, lacks, not_both};

/// How a range is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", expecting = "a text in quotes")]
pub enum Spacing {
    /// Even steps.
    Linear,
    /// Even steps of the logarithm.
    Logarithmic,
}

/// The values that a variable takes.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers (SI).
    Numbers(Vec<f64>),
    /// Everything between two numbers (SI).
    Range {
        /// First number.
        from: f64,
        /// Last number.
        to: f64,
        /// How it is divided.
        spacing: Spacing,
        /// Values in a grid, both ends included.
        count: Option<usize>,
    },
    /// Random numbers (SI).
    Random(Distribution),
    /// Names of choices that are no numbers.
    Choices(Vec<String>),
}

impl Values {
    /// Number of values in a grid or a list; `None` for a range without a count, and random numbers.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        match self {
            Self::Numbers(numbers) => Some(numbers.len()),
            Self::Choices(names) => Some(names.len()),
            Self::Range { count, .. } => *count,
            Self::Random(_) => None,
        }
    }

    /// Whether they are random numbers.
    #[must_use]
    pub fn is_random(&self) -> bool {
        matches!(self, Self::Random(_))
    }

    /// Value number `index` of a grid or a list; of random numbers, which neither has, the median.
    #[must_use]
    pub fn at(&self, index: usize) -> super::Value {
        match self {
            Self::Numbers(numbers) => super::Value::Number(numbers[index]),
            Self::Choices(_) => super::Value::Choice(index),
            Self::Random(distribution) => super::Value::Number(distribution.quantile(0.5)),
            Self::Range {
                from,
                to,
                count,
                spacing,
            } => {
                let last = count.unwrap_or(2) - 1;
                let (before, after) = (index as f64, (last - index.min(last)) as f64);
                super::Value::Number(match spacing {
                    // The ends are the numbers of the file to the last bit.
                    _ if index == 0 => *from,
                    _ if index >= last => *to,
                    Spacing::Linear => short((from * after + to * before) / last as f64, 0.0),
                    Spacing::Logarithmic => {
                        let power = before / last as f64 * libm::log(to / from);
                        short(from * libm::exp(power), power)
                    }
                })
            }
        }
    }

    /// The numbers of a grid or a list; NaN for what is none.
    #[must_use]
    pub(crate) fn numbers(&self) -> Vec<f64> {
        let number = |i| match self.at(i) {
            super::Value::Number(x) => x,
            super::Value::Choice(_) => f64::NAN,
        };
        (0..self.count().unwrap_or(0)).map(number).collect()
    }

    /// Value at a part of the way, 0 to 1: of a range the place, of a list the entry in
    /// whose equal share the part lies, of random numbers what they stay below with this probability.
    #[must_use]
    pub fn sample(&self, part: f64) -> super::Value {
        let index = |count: usize| ((part * count as f64) as usize).min(count - 1);
        match self {
            Self::Numbers(numbers) => super::Value::Number(numbers[index(numbers.len())]),
            Self::Choices(names) => super::Value::Choice(index(names.len())),
            Self::Random(distribution) => super::Value::Number(distribution.quantile(part)),
            Self::Range {
                from, to, spacing, ..
            } => super::Value::Number(match spacing {
                Spacing::Linear => from + part * (to - from),
                Spacing::Logarithmic if part == 0.0 => *from,
                Spacing::Logarithmic => from * libm::exp(part * libm::log(to / from)),
            }),
        }
    }
}

/// A number of a grid without the round-off of its steps: the decimal number of 12 digits, if it lies
/// as near as round-off does, that of a power of e with its exponent too, so that 0.8 is what `0.8` is read as.
/// Others stay as they are.
pub(super) fn short(x: f64, power: f64) -> f64 {
    let round_off = (16.0 + power.abs()) * f64::EPSILON;
    match format!("{x:.11e}").parse() {
        Ok(near) if f64::abs(near - x) <= round_off * x.abs() => near,
        _ => x,
    }
}

/// Largest seed and number of a storey.
const LARGEST: i64 = 1_000_000_000;
/// Most numbers of a range.
pub(super) const MOST_OF_RANGE: i64 = 1_000_000;
/// Most runs of a study, however they are sampled: two years of a core at half a second each.
pub(super) const MOST_RUNS: i64 = 100_000_000;
/// Most runs that are stored at once: all of them are kept until then.
pub(super) const MOST_OF_CHUNK: i64 = 1_000_000;

/// A whole number of runs, values and the like, at least so large and at most.
#[derive(Debug, Clone, Copy)]
pub(super) struct Whole<const LEAST: i64, const MOST: i64 = LARGEST>(pub usize);

impl<'de, const LEAST: i64, const MOST: i64> Deserialize<'de> for Whole<LEAST, MOST> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let number = i64::deserialize(deserializer)?;
        match usize::try_from(number) {
            _ if number > MOST => Err(D::Error::custom(Fault::new(
                " = {written} is too large",
                format!("write a whole number from {LEAST} to {MOST}"),
            ))),
            Ok(count) if number >= LEAST => Ok(Self(count)),
            _ => Err(D::Error::custom(Fault::new(
                format!(" must be a whole number from {LEAST} on"),
                format!("write a whole number from {LEAST} on"),
            ))),
        }
    }
}

impl<const LEAST: i64, const MOST: i64> JsonSchema for Whole<LEAST, MOST> {
    fn schema_name() -> Cow<'static, str> {
        format!("from {LEAST} to {MOST}").into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({"type": "integer", "minimum": LEAST, "maximum": MOST})
    }
}

/// A table with the keys of a range behind its own, and what makes other keys of them. Serde
/// flattens a struct into another only without the places of its values.
macro_rules! table_with_range {
    ($(#[$of_table:meta])* $table:ident { $($own:tt)* } $(=> $into:ident)?) => {
        $(#[$of_table])*
        pub(super) struct $table {
            $($own)*
            /// First number of a range
            pub from: Optional<Written>,
            /// Last number of a range
            pub to: Optional<Written>,
            /// How many numbers of a range, both ends included, for a grid or a list
            pub count: Optional<Whole<2, { $crate::study_file::values::MOST_OF_RANGE }>>,
            /// linear (default) or logarithmic
            pub spacing: Optional<Spacing>,
        }
        $(
            impl $table {
                /// The same range, or these values.
                fn range_or(self, values: Optional<List<Written>>) -> $into {
                    let Self { from, to, count, spacing, .. } = self;
                    $into { values, from, to, count, spacing }
                }
            }
        )?
    };
}
pub(super) use table_with_range;

table_with_range! {
    /// Numbers: a list, or a range
    #[derive(Debug, serde::Deserialize, JsonSchema)]
    #[serde(rename = "gaps")]
    Numbers {
        /// The numbers
        pub values: Optional<List<Written>>,
    }
}

impl Numbers {
    /// Its keys, those of a range behind that of a list, and where they are given.
    pub(super) fn keys(&self) -> [Place<'static>; 5] {
        [
            ("values", self.values.span()),
            ("from", self.from.span()),
            ("to", self.to.span()),
            ("count", self.count.span()),
            ("spacing", self.spacing.span()),
        ]
    }

    /// The numbers of a table that is called so and stands here, and the places from which
    /// they were read.
    pub(super) fn read(
        self,
        reader: &Reader<'_>,
        (table, span): (&str, Range<usize>),
        number: &dyn Fn(Written) -> Result<f64, Fault>,
    ) -> Option<(Values, Vec<Located<Written>>)> {
        let read = |key: &str, written: &Located<Written>| {
            reader.keep(&written.span, key, number(written.value.clone()))
        };
        let [values, of_range @ ..] = self.keys();
        for key in of_range {
            not_both(reader, table, values.clone(), key)?;
        }
        let Some(list) = self.values.stated() else {
            // Said before; the rest is looked at.
            self.to.located().and_then(|to| read("to", &to));
            return None;
        };
        if let Some(list) = list {
            let entry = |item: Field<Written>| {
                let item = item.located()?;
                Some((read("values", &item)?, item))
            };
            let (numbers, places) = all(list.value.0.into_iter().map(entry))?
                .into_iter()
                .unzip();
            return Some((Values::Numbers(numbers), places));
        }
        if self.from.is_none() {
            let message = "this says not which values it takes";
            let help = "add `values = [...]`, or `from`, `to` and, for a grid, `count`";
            return reader.refuse(span, message, help);
        }
        let end = |key: &str, given: Optional<Written>| {
            let Some(given) = given else {
                return lacks(reader, table, span.clone(), key);
            };
            let written = given.located()?;
            Some((read(key, &written)?, written))
        };
        let ends = (end("from", self.from), end("to", self.to));
        let ((from, first), (to, last)) = ends.0.zip(ends.1)?;
        let spacing = self.spacing.value_or(Spacing::Linear)?;
        if spacing == Spacing::Logarithmic && !(from > 0.0 && to > 0.0) {
            let message = "a logarithmic range lies above zero";
            let help = "correct the range, or write spacing = \"linear\"";
            return reader.refuse(first.span, message, help);
        }
        if from == to {
            let message = "the range is empty: it ends where it begins";
            let help = "correct `to`, or give one value by `values`";
            return reader.refuse(last.span, message, help);
        }
        let values = Values::Range {
            from,
            to,
            spacing,
            count: self.count.stated()?.map(|count| count.value.0),
        };
        Some((values, vec![first, last]))
    }
}

/// All values, unless one of them is wrong; every one is looked at.
pub(super) fn all<T>(values: impl IntoIterator<Item = Option<T>>) -> Option<Vec<T>> {
    let values: Vec<_> = values.into_iter().collect();
    values.into_iter().collect()
}

/// A dimension as the attribute `units` of a result has it, such as `kg m-0.5 s-2`.
pub(super) fn unit_of(dimension: Dimension) -> String {
    let named = [
        (Dimension::NUMBER, "1"),
        (Dimension::FORCE, "N"),
        (Dimension::STIFFNESS, "N m-1"),
        (Dimension::DASHPOT, "N s m-1"),
        (Dimension::ENERGY, "J"),
        (Dimension::PRESSURE, "Pa"),
    ];
    if let Some((_, name)) = named.iter().find(|(d, _)| *d == dimension) {
        return (*name).to_owned();
    }
    let powers = [
        ("kg", dimension.mass),
        ("m", dimension.length),
        ("s", dimension.time),
    ];
    let shown = powers.iter().filter_map(|(symbol, power)| {
        // Sums of decimal powers carry noise.
        let power = (power * 1e6).round() / 1e6;
        match power {
            0.0 => None,
            1.0 => Some((*symbol).to_owned()),
            _ => Some(format!("{symbol}{power}")),
        }
    });
    shown.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::Value::{Choice, Number};
    use super::*;

    fn range(spacing: Spacing) -> Values {
        Values::Range {
            from: 0.01,
            to: 1.0,
            spacing,
            count: Some(3),
        }
    }

    #[test]
    fn grids_end_where_the_file_says() {
        assert_eq!(range(Spacing::Linear).at(0), Number(0.01));
        assert_eq!(range(Spacing::Linear).at(2), Number(1.0));
        let Number(middle) = range(Spacing::Logarithmic).at(1) else {
            panic!("a range has numbers");
        };
        assert!((middle - 0.1).abs() < 1e-15);
        assert_eq!(range(Spacing::Logarithmic).at(2), Number(1.0));
    }

    /// Whatever the ends and the count, values that are short decimals are the numbers that these
    /// are read as, and all are in order.
    #[test]
    fn grids_have_short_decimals() {
        let numbers = |from: f64, to: f64, count: usize, spacing| -> Vec<f64> {
            let range = Values::Range {
                from,
                to,
                spacing,
                count: Some(count),
            };
            let numbers = (0..count).map(|i| match range.at(i) {
                Number(x) => x,
                Choice(_) => panic!("a range has numbers"),
            });
            numbers.collect()
        };
        let read = |text: String| text.parse::<f64>().unwrap();
        for (digits, scale) in [(1, 10), (2, 100), (3, 1000), (4, 10_000)] {
            for first in [0, 1, 2, 5, 7, 33] {
                for step in [1, 2, 3, 5, 7, 25] {
                    let at = |i: usize| first + i * step;
                    let exact = |n: usize| read(format!("{}.{:0digits$}", n / scale, n % scale));
                    let count = 41;
                    let found = numbers(exact(at(0)), exact(at(40)), count, Spacing::Linear);
                    let expected: Vec<f64> = (0..count).map(|i| exact(at(i))).collect();
                    assert_eq!(found, expected, "{first} {step} {digits}");
                }
            }
        }
        let decades = numbers(1e-3, 1e3, 7, Spacing::Logarithmic);
        assert_eq!(decades, [1e-3, 0.01, 0.1, 1.0, 10.0, 100.0, 1e3]);
        let many = numbers(1.0, 1e26, 27, Spacing::Logarithmic);
        let expected: Vec<f64> = (0..27).map(|i| read(format!("1e{i}"))).collect();
        assert_eq!(many, expected);
        let down = numbers(0.3, -0.3, 7, Spacing::Linear);
        assert_eq!(down, [0.3, 0.2, 0.1, 0.0, -0.1, -0.2, -0.3]);
    }

    #[test]
    fn choices_have_equal_shares() {
        let names = Values::Choices(vec!["a".into(), "b".into()]);
        assert_eq!(names.sample(0.0), Choice(0));
        assert_eq!(names.sample(0.499), Choice(0));
        assert_eq!(names.sample(0.5), Choice(1));
        assert_eq!(names.sample(1.0), Choice(1));
    }

    #[test]
    fn units_are_those_of_udunits() {
        assert_eq!(unit_of(Dimension::LENGTH), "m");
        assert_eq!(unit_of(Dimension::ACCELERATION), "m s-2");
        assert_eq!(
            unit_of(Dimension::stiffness_with_exponent(1.5)),
            "kg m-0.5 s-2"
        );
    }
}
