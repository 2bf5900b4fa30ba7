//! Editions of codes: what they are called, where they hold, and from when to when.

use std::fmt;

use chrono::NaiveDate;

/// A code in one edition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edition {
    /// Code with its edition.
    pub title: &'static str,
    /// Country or city.
    pub region: &'static str,
    /// When it came into force, and how far that was checked; `None` where that is not known,
    /// or for what is no code in force: a draft, a practice.
    pub in_force: Option<InForce>,
    /// The edition or code that took its place, if one is known.
    pub superseded_by: Option<&'static str>,
}

/// From when to when an edition is in force. Dates are `2018-03-22`, or `2010` where only the year
/// is known: then nothing is known of the days of that year.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InForce {
    /// First day or year.
    pub from: &'static str,
    /// First day or year of what took its place; `None` while it is in force.
    pub until: Option<&'static str>,
    /// The text that has the dates; `None` where they are recalled.
    pub source: Option<&'static str>,
}

impl InForce {
    /// Recalled, not seen in a text.
    pub(crate) const fn recalled(from: &'static str, until: Option<&'static str>) -> Option<Self> {
        Some(Self {
            from,
            until,
            source: None,
        })
    }

    /// Whether the edition is in force on this day.
    #[must_use]
    pub fn on(&self, date: Date) -> Validity {
        let begun = reached(self.from, date);
        let ended = self.until.map_or(Some(false), |until| reached(until, date));
        match (begun, ended) {
            (Some(false), _) | (_, Some(true)) => Validity::NotInForce,
            (Some(true), Some(false)) => Validity::InForce,
            _ => Validity::NotKnown,
        }
    }

    /// `from 2007-03-06 to 2019-01-01`, with how far the dates were checked.
    #[must_use]
    pub fn explanation(&self) -> String {
        let until = self
            .until
            .map_or_else(String::new, |until| format!(" to {until}"));
        match self.source {
            Some(source) => format!("from {}{until} ({source})", self.from),
            None => format!("from {}{until} (recalled, unverified)", self.from),
        }
    }
}

/// Whether an edition is in force on a day.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Validity {
    /// It is.
    InForce,
    /// It is not, or has no dates.
    NotInForce,
    /// It begins or ends in the year of that day, on a day that is not known.
    NotKnown,
}

/// Whether a day is a known one or a later one; `None` in the year of which only that is known.
fn reached(known: &str, date: Date) -> Option<bool> {
    // Years and days of ISO 8601 stand in the order of their characters.
    let date = date.to_string();
    match date.strip_prefix(known) {
        Some(rest) if !rest.is_empty() => None,
        _ => Some(known <= date.as_str()),
    }
}

impl Edition {
    /// Whether it is in force on this day, as far as its dates are known.
    #[must_use]
    pub fn validity(&self, date: Date) -> Validity {
        let known = self.in_force;
        known.map_or(Validity::NotInForce, |known| known.on(date))
    }
}

/// A day of the Gregorian calendar.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Date(pub(crate) NaiveDate);

impl Date {
    /// Today in universal time.
    #[must_use]
    pub fn today() -> Self {
        Self(chrono::Utc::now().date_naive())
    }
}

impl fmt::Display for Date {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0.format("%Y-%m-%d"))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn an_edition_is_in_force_from_its_first_day_to_the_day_before_the_next() {
        let old = InForce::recalled("2007-03-06", Some("2019-01-01")).unwrap();
        let new = InForce::recalled("2019-01-01", None).unwrap();
        let year = InForce::recalled("2010", Some("2017")).unwrap();
        let (yes, no) = (Validity::InForce, Validity::NotInForce);
        let perhaps = Validity::NotKnown;
        for (date, in_old, in_new, in_year) in [
            ("2007-03-05", no, no, no),
            ("2007-03-06", yes, no, no),
            ("2009-12-31", yes, no, no),
            ("2010-01-01", yes, no, perhaps),
            ("2010-12-31", yes, no, perhaps),
            ("2011-01-01", yes, no, yes),
            ("2016-12-31", yes, no, yes),
            ("2017-01-01", yes, no, perhaps),
            ("2017-12-31", yes, no, perhaps),
            ("2018-01-01", yes, no, no),
            ("2018-12-31", yes, no, no),
            ("2019-01-01", no, yes, no),
            ("2026-11-23", no, yes, no),
        ] {
            let day: Date = date.parse().unwrap();
            assert_eq!(
                (old.on(day), new.on(day), year.on(day)),
                (in_old, in_new, in_year),
                "{date}"
            );
        }
    }
}
