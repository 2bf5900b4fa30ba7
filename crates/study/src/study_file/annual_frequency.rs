//! Mean annual frequencies: numbers a year.

use std::borrow::Cow;

use pounding_case::document::{Fault, Number, Positive, Written};
use pounding_case::{Dimension, Quantity};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

/// Units of a mean annual frequency, also of a column of a table.
pub(super) const PER_YEAR: [&str; 6] = ["1/year", "1/yr", "1/a", "per_year", "year^-1", "yr^-1"];
/// Further ways in which a text of a number says that it is one a year.
const FURTHER: [&str; 5] = ["per year", "per yr", "/year", "/yr", "/a"];

/// A mean annual frequency above zero (1/year).
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "Written")]
pub(super) struct AnnualFrequency(f64);

impl From<AnnualFrequency> for f64 {
    fn from(frequency: AnnualFrequency) -> Self {
        frequency.0
    }
}

impl TryFrom<Written> for AnnualFrequency {
    type Error = Fault;
    fn try_from(written: Written) -> Result<Self, Fault> {
        let number = match written.is_plain() {
            true => None,
            false => number_a_year(written.as_written()).map(str::to_owned),
        };
        let written = number.map_or(written, Written::of_text);
        let (text, is_plain) = (written.as_written().to_owned(), written.is_plain());
        let help = format!("plain numbers are in 1/year: write {EXAMPLE}, or \"{EXAMPLE} 1/year\"");
        let quantity = written.any().map_err(|fault| match is_plain {
            true => fault,
            false => Fault {
                help: help.clone(),
                ..fault
            },
        })?;
        match quantity.dimension {
            Some(found) if found != Dimension::NUMBER => {
                let message =
                    format!(" must be a mean annual frequency (1/year), but \"{text}\" is {found}");
                Err(Fault::new(message, help))
            }
            _ => above_zero(&quantity).map(Self),
        }
    }
}

/// A number as it could be written.
const EXAMPLE: &str = "1e-3";

fn above_zero(quantity: &Quantity) -> Result<f64, Fault> {
    // As any number above zero is read.
    Positive::<Number>::try_from(Written::of_text(quantity.value.to_string())).map(f64::from)
}

/// The number of a text that ends with a unit such as `1/year`.
fn number_a_year(text: &str) -> Option<&str> {
    let text = text.trim();
    let ending = |unit: &&str| {
        let at = text.len().checked_sub(unit.len())?;
        let (number, end) = (text.get(..at)?, text.get(at..)?);
        // `1e-31/year` is 1e-31 a year.
        let is_parted = unit.starts_with('/') || number.ends_with(char::is_whitespace);
        (is_parted && end.eq_ignore_ascii_case(unit)).then(|| number.trim_end())
    };
    PER_YEAR.iter().chain(&FURTHER).find_map(ending)
}

impl JsonSchema for AnnualFrequency {
    fn schema_name() -> Cow<'static, str> {
        Positive::<Number>::schema_name()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        Positive::<Number>::json_schema(generator)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_year_is_the_only_unit() {
        for (text, value) in [
            ("1e-3", 1e-3),
            ("1e-3 1/year", 1e-3),
            (" 2e-3/year ", 2e-3),
            ("2e-3 /yr", 2e-3),
            ("0.01 per year", 0.01),
            ("0.01 per_year", 0.01),
            ("0.01 1/a", 0.01),
            ("1e-3 year^-1", 1e-3),
            ("1/year", 1.0),
            ("1e-31/year", 1e-31),
            ("10 % per year", 0.1),
        ] {
            let found = AnnualFrequency::try_from(Written::of_text(text.to_owned()));
            assert_eq!(found, Ok(AnnualFrequency(value)), "{text}");
        }
        for text in [
            "1e-3 Hz", "1e-3 1/s", "2 m/year", "1/yaer", "0.1 a", "year", "",
        ] {
            let fault = AnnualFrequency::try_from(Written::of_text(text.to_owned())).unwrap_err();
            assert!(fault.help.contains("plain numbers are in 1/year"), "{text}");
        }
        for text in ["0", "-1e-3 1/year"] {
            let fault = AnnualFrequency::try_from(Written::of_text(text.to_owned())).unwrap_err();
            assert!(fault.message.contains("greater than zero"), "{fault}");
        }
    }
}
