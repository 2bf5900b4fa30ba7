//! Dates as texts have them.

use std::str::FromStr;

use chrono::NaiveDate;

use crate::edition::Date;
use crate::error::SeparationError;

impl FromStr for Date {
    type Err = SeparationError;
    fn from_str(text: &str) -> Result<Self, SeparationError> {
        let wrong = || SeparationError::NoDate {
            text: text.to_owned(),
        };
        // The parser alone would take `2018-3-22`, and years of five digits.
        let shape = text.len() == 10 && text.is_ascii();
        let date = NaiveDate::parse_from_str(text, "%Y-%m-%d").map_err(|_| wrong())?;
        if shape { Ok(Self(date)) } else { Err(wrong()) }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn dates_are_years_months_days() {
        assert_eq!(
            "2024-02-29".parse::<Date>().unwrap().to_string(),
            "2024-02-29"
        );
        for wrong in [
            "2023-02-29",
            "2024-2-29",
            "29.2.2024",
            "2024",
            "",
            "12024-01-01",
            "today",
        ] {
            assert!(wrong.parse::<Date>().is_err(), "{wrong}");
        }
    }
}
