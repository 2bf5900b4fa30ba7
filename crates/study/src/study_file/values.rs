//! Values of a variable: lists and ranges.

use pounding_case::Dimension;

use super::reader::{Reader, Result, Table, Value, Wrong};

/// How a range is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
    /// Names of choices that are no numbers.
    Choices(Vec<String>),
}

impl Values {
    /// Number of values in a grid or a list; `None` for a range without a count.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        match self {
            Self::Numbers(numbers) => Some(numbers.len()),
            Self::Choices(names) => Some(names.len()),
            Self::Range { count, .. } => *count,
        }
    }

    /// Value number `index` of a grid or a list.
    #[must_use]
    pub fn at(&self, index: usize) -> super::Value {
        match self {
            Self::Numbers(numbers) => super::Value::Number(numbers[index]),
            Self::Choices(_) => super::Value::Choice(index),
            Self::Range { to, count, .. } => {
                let last = count.unwrap_or(2) - 1;
                // The end is the number of the file to the last bit.
                if index == last {
                    return super::Value::Number(*to);
                }
                self.sample(index as f64 / last as f64)
            }
        }
    }

    /// Value at a part of the way, 0 to 1: of a range the place, of a list the entry in
    /// whose equal share the part lies.
    #[must_use]
    pub fn sample(&self, part: f64) -> super::Value {
        let index = |count: usize| ((part * count as f64) as usize).min(count - 1);
        match self {
            Self::Numbers(numbers) => super::Value::Number(numbers[index(numbers.len())]),
            Self::Choices(names) => super::Value::Choice(index(names.len())),
            Self::Range {
                from, to, spacing, ..
            } => super::Value::Number(match spacing {
                Spacing::Linear => from + part * (to - from),
                Spacing::Logarithmic if part == 0.0 => *from,
                Spacing::Logarithmic => from * (part * (to / from).ln()).exp(),
            }),
        }
    }
}

/// Numbers of a table with `values`, or with `from`, `to`, `count` and `spacing`; and the
/// places from which they were read.
pub(super) fn numbers<'v, 'a>(
    table: &Table<'v, 'a>,
    read: &dyn Fn(&Value<'a>, &str) -> Result<f64>,
) -> Result<(Values, Vec<&'v Value<'a>>)> {
    let reader = table.reader;
    for key in ["from", "to", "count", "spacing"] {
        table.not_both("values", key)?;
    }
    let count = table.or("count", None, |v| reader.count(v, "count", 2).map(Some));
    let (count, spacing) = (reader.keep(count), reader.keep(spacing(table, &reader)));
    if let Some(list) = table.get("values") {
        let items = reader.list(list, "values")?;
        let numbers = reader.all(items.iter().map(|item| read(item, "values")))?;
        return Ok((Values::Numbers(numbers), items.iter().collect()));
    }
    if ["values", "from"].iter().any(|k| table.lacks(k)) {
        table.optional("to", |v| read(v, "to"));
        return Err(Wrong::Recorded);
    }
    if table.get("from").is_none() {
        return Err(reader.error(
            table.span.clone(),
            "this says not which values it takes",
            "add `values = [...]`, or `from`, `to` and, for a grid, `count`",
        ));
    }
    let end = |key: &str| {
        let place = table.required(key)?;
        Ok((place, read(place, key)?))
    };
    let ends = reader.keep(end("from")).zip(reader.keep(end("to")));
    let (((first, from), (last, to)), spacing) = ends.zip(spacing).ok_or(Wrong::Recorded)?;
    if spacing == Spacing::Logarithmic && !(from > 0.0 && to > 0.0) {
        return Err(reader.error(
            first.span(),
            "a logarithmic range lies above zero",
            "correct the range, or write spacing = \"linear\"",
        ));
    }
    if from == to {
        return Err(reader.error(
            last.span(),
            "the range is empty: it ends where it begins",
            "correct `to`, or give one value by `values`",
        ));
    }
    let values = Values::Range {
        from,
        to,
        spacing,
        count: count.ok_or(Wrong::Recorded)?,
    };
    Ok((values, vec![first, last]))
}

fn spacing(table: &Table<'_, '_>, reader: &Reader<'_>) -> Result<Spacing> {
    let Some(value) = table.get("spacing") else {
        return Ok(Spacing::Linear);
    };
    match reader.text(value, "spacing")?.as_str() {
        "linear" => Ok(Spacing::Linear),
        "logarithmic" => Ok(Spacing::Logarithmic),
        _ => Err(reader.error(
            value.span(),
            "`spacing` is \"linear\" or \"logarithmic\"",
            "correct it",
        )),
    }
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
