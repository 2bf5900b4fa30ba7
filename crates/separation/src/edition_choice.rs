//! Which edition of a code holds: by its name, by the day on which it is in force, by country or city.

use pounding_catalogue::DefinitionError;

use crate::codes::{CodeDescriptor, codes, find_code};
use crate::country;
use crate::edition::{Date, Validity};
use crate::error::SeparationError;
use crate::provisions::UNAVAILABLE;

/// The code of this name with its edition, or the edition of that family that is in force on a
/// day. The second tells whether the day decided.
///
/// # Errors
/// [`SeparationError::UnknownProvision`] with the nearest known name, and
/// [`SeparationError::NotInForce`] for a family of which no edition is; [`SeparationError::DayNotKnown`]
/// where the newest that may be in force begins or ends in that year, on a day that is not known.
pub fn choose_code(
    name: &str,
    date: Date,
) -> Result<(&'static CodeDescriptor, bool), SeparationError> {
    let editions: Vec<_> = codes().iter().filter(|c| c.family == name).collect();
    let exact = codes().iter().any(|c| c.name == name);
    if exact || editions.is_empty() {
        return find_code(name)
            .map(|code| (code, false))
            .map_err(with_family);
    }
    let possible = editions.iter().map(|c| **c);
    let possible: Vec<_> = possible
        .filter(|c| c.edition().validity(date) != Validity::NotInForce)
        .collect();
    // Of two whose dates overlap the newer.
    let newest = possible.iter().rev();
    let newest = newest.max_by_key(|c| c.edition().in_force.map(|known| known.from));
    match newest {
        Some(code) if code.edition().validity(date) == Validity::InForce => Ok((code, true)),
        Some(_) => Err(day_not_known(name, date, &possible)),
        None => Err(SeparationError::NotInForce {
            what: name.to_owned(),
            date,
            known: editions.iter().map(|c| dated(c)).collect(),
            newest: newest_of(&editions),
            unavailable: unavailable_in(editions[0].edition().region),
        }),
    }
}

/// The one code of a country or city that is in force on a day.
///
/// # Errors
/// [`SeparationError::UnknownCountry`], [`SeparationError::NotInForce`],
/// [`SeparationError::SeveralCodes`] where it has more than one, and
/// [`SeparationError::DayNotKnown`] as for a family.
pub fn code_in_country(
    country: &str,
    date: Date,
) -> Result<&'static CodeDescriptor, SeparationError> {
    let wanted = country::region(country);
    let of_country = |c: &&&CodeDescriptor| country::plain(c.edition().region) == wanted;
    let all: Vec<_> = codes().iter().filter(of_country).collect();
    if all.is_empty() {
        let mut known: Vec<_> = codes().iter().map(|c| c.edition().region).collect();
        known.sort_unstable();
        known.dedup();
        let hint = country::hint(country, &known, |region| code_in_country(region, date));
        let country = country.to_owned();
        return Err(SeparationError::UnknownCountry {
            country,
            known,
            hint,
        });
    }
    let of = |wanted: Validity| {
        let found = all.iter().copied();
        found.filter(move |c| c.edition().validity(date) == wanted)
    };
    // One that ends in that year decides nothing beside a newer edition that is in force.
    let from = |c: &CodeDescriptor| c.edition().in_force.map(|known| known.from);
    let followed = |old: &CodeDescriptor| {
        let mut newer = of(Validity::InForce);
        newer.any(|new| new.family == old.family && from(new) > from(old))
    };
    if of(Validity::NotKnown).any(|c| !followed(c)) {
        let possible = all.iter().map(|c| **c);
        let possible =
            possible.filter(|c| c.edition().validity(date) != Validity::NotInForce && !followed(c));
        return Err(day_not_known(country, date, &possible.collect::<Vec<_>>()));
    }
    match of(Validity::InForce).collect::<Vec<_>>().as_slice() {
        [one] => Ok(one),
        [] => Err(SeparationError::NotInForce {
            what: country.to_owned(),
            date,
            known: all.iter().map(|c| dated(c)).collect(),
            newest: newest_of(&all),
            unavailable: unavailable_in(all[0].edition().region),
        }),
        several => Err(SeparationError::SeveralCodes {
            country: country.to_owned(),
            date,
            codes: several.iter().map(|c| c.name).collect(),
        }),
    }
}

/// The error of a day in a year in which editions change.
fn day_not_known(what: &str, date: Date, possible: &[&'static CodeDescriptor]) -> SeparationError {
    SeparationError::DayNotKnown {
        what: what.to_owned(),
        date,
        known: possible.iter().map(|c| dated(c)).collect(),
        codes: possible.iter().map(|c| c.name).collect(),
    }
}

/// The error of an unknown code, with the family of the one that is meant where its name does not say it.
fn with_family(error: SeparationError) -> SeparationError {
    let SeparationError::UnknownProvision(DefinitionError::UnknownName { nearest, .. }) = &error
    else {
        return error;
    };
    let meant = codes().iter().find(|c| c.name == *nearest);
    let meant = meant.filter(|c| c.is_chosen_by_dates() && !c.name.starts_with(c.family));
    match (meant, error) {
        (Some(code), SeparationError::UnknownProvision(error)) => SeparationError::UnknownCode {
            error,
            family: code.family,
        },
        (_, error) => error,
    }
}

/// The newest of some editions.
fn newest_of(editions: &[&&'static CodeDescriptor]) -> &'static str {
    let from = |c: &&&&CodeDescriptor| c.edition().in_force.map(|known| known.from);
    let newest = editions.iter().max_by_key(from);
    newest.map_or("", |c| c.name)
}

/// Editions of a country or city that have no formula here.
fn unavailable_in(region: &str) -> Vec<&'static str> {
    let here = UNAVAILABLE.iter().filter(|u| u.region == region);
    here.map(|u| u.edition).collect()
}

/// A code with the dates of its edition.
fn dated(code: &CodeDescriptor) -> String {
    let known = code.edition().in_force;
    match known {
        Some(known) => format!("{} {}", code.name, known.explanation()),
        None => format!("{} without known dates", code.name),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn on(date: &str) -> Date {
        date.parse().unwrap()
    }

    /// A family stands for its edition in force, a name with an edition for itself.
    #[test]
    fn editions_are_chosen_by_date() {
        for (family, date, edition) in [
            ("turkey", "2018-12-31", "tdy_2007"),
            ("turkey", "2019-01-01", "tbdy_2018"),
            ("asce_7", "2012-06-01", "asce_7_2010"),
            ("asce_7", "2026-11-23", "asce_7_2022"),
            ("e_030", "2020-01-01", "e_030_2018"),
            ("e_030", "2027-01-01", "e_030_2026"),
            ("asce_7", "2016-12-31", "asce_7_2010"),
            ("asce_7", "2018-01-01", "asce_7_2016"),
            ("mexico_city", "2005-01-01", "mexico_city_2004"),
            ("mexico_city", "2021-01-01", "mexico_city_2020"),
            // The draft is in force at no time.
            ("eurocode_8", "2026-11-23", "eurocode_8_2004"),
        ] {
            let (code, by_date) = choose_code(family, on(date)).unwrap();
            assert_eq!((code.name, by_date), (edition, true), "{family} {date}");
        }
        let (code, by_date) = choose_code("tdy_2007", on("2026-11-23")).unwrap();
        assert_eq!((code.name, by_date), ("tdy_2007", false));
        // Between 2017 and 2020 an edition held that is not here.
        let error = choose_code("mexico_city", on("2018-06-01")).unwrap_err();
        assert!(
            error.to_string().contains("in force on 2018-06-01"),
            "{error}"
        );
        assert!(
            error
                .help()
                .unwrap()
                .contains("mexico_city_2020 from 2020-06-09")
        );
        assert!(choose_code("atlantis", on("2018-06-01")).is_err());
    }

    /// In the year in which an edition begins or ends, of which no day is known, none is chosen.
    #[test]
    fn a_year_in_which_editions_change_asks_for_the_edition() {
        for (family, date, names) in [
            ("asce_7", "2017-06-01", "asce_7_2010 or asce_7_2016"),
            ("asce_7", "2022-01-01", "asce_7_2016 or asce_7_2022"),
            ("e_030", "2026-11-23", "e_030_2018 or e_030_2026"),
            ("is_1893", "2016-12-31", "is_1893_2016 or is_1893_2002"),
            ("nbcc", "2015-07-01", "nbcc_2015"),
            ("taiwan", "2022-07-01", "taiwan_2011"),
        ] {
            let error = choose_code(family, on(date)).unwrap_err();
            let help = error.help().unwrap();
            assert!(help.ends_with(&format!(": {names}")), "{family}: {help}");
            assert!(error.to_string().contains("only years are"), "{error}");
        }
        let error = code_in_country("Peru", on("2026-11-23")).unwrap_err();
        assert!(error.help().unwrap().contains("e_030_2018 or e_030_2026"));
        let found = code_in_country("Peru", on("2027-01-01")).unwrap();
        assert_eq!(found.name, "e_030_2026");
    }

    /// A draft and a practice have no dates: no day chooses them.
    #[test]
    fn editions_without_dates_are_chosen_by_none() {
        for (name, by_dates) in [
            ("eurocode_8_2004", true),
            ("eurocode_8_draft", false),
            ("japan_practice", false),
            ("tdy_2007", true),
            ("nch_433", false),
        ] {
            let found = find_code(name).unwrap();
            assert_eq!(found.is_chosen_by_dates(), by_dates, "{name}");
        }
        for code in codes().iter().filter(|c| c.is_chosen_by_dates()) {
            let days = (1990..2040).map(|year| on(&format!("{year}-12-31")));
            let mut chosen = days.filter_map(|day| choose_code(code.family, day).ok());
            assert!(chosen.any(|(c, _)| c.name == code.name), "{}", code.name);
        }
    }

    #[test]
    fn countries_have_codes() {
        let found = code_in_country("Turkey", on("2010-01-01")).unwrap();
        assert_eq!(found.name, "tdy_2007");
        assert_eq!(
            code_in_country("mexico_city", on("2021-01-01"))
                .unwrap()
                .name,
            "mexico_city_2020"
        );
        let several = code_in_country("United States", on("2020-01-01")).unwrap_err();
        assert_eq!(
            several.to_string(),
            "United States has several codes in force on 2020-01-01: asce_7_2016, asce_41"
        );
        let unknown = code_in_country("Itly", on("2020-01-01")).unwrap_err();
        assert_eq!(unknown.help().unwrap(), "did you mean \"Italy\"?");
        let none = code_in_country("Italy", on("2000-01-01")).unwrap_err();
        assert!(matches!(none, SeparationError::NotInForce { .. }), "{none}");
    }

    /// Other names, countries of EN 1998-1, and what to take where no edition known is in force.
    #[test]
    fn names_of_countries_that_are_no_regions() {
        let day = on("2026-11-27");
        for (name, code) in [
            ("T\u{fc}rkiye", "tbdy_2018"),
            ("NZ", "nzs_1170_5"),
            ("new_zealand", "nzs_1170_5"),
            ("Europe", "eurocode_8_2004"),
        ] {
            let found = code_in_country(name, day).unwrap();
            assert_eq!(found.name, code, "{name}");
        }
        for name in ["USA", "u.s.", "United States of America"] {
            let error = code_in_country(name, on("2020-01-01")).unwrap_err();
            assert!(
                matches!(error, SeparationError::SeveralCodes { .. }),
                "{name}: {error}"
            );
        }
        for name in ["France", "germany", "Czech_Republic", "UK"] {
            let help = code_in_country(name, day).unwrap_err().help().unwrap();
            assert!(
                help.contains("EN 1998-1") && help.contains("\"Europe\""),
                "{name}: {help}"
            );
            assert!(help.contains("National Annex"), "{name}: {help}");
        }
        let city = code_in_country("Mexico City", day).unwrap_err();
        let country = code_in_country("Mexico", day).unwrap_err();
        for help in [city.help().unwrap(), country.help().unwrap()] {
            for part in ["--code mexico_city_2020", "NTC-Sismo 2017 and 2023"] {
                assert!(help.contains(part), "{part}: {help}");
            }
        }
        assert!(
            country
                .help()
                .unwrap()
                .contains("did you mean \"Mexico City\"?")
        );
        let help = code_in_country("Atlantis", day)
            .unwrap_err()
            .help()
            .unwrap();
        assert!(help.starts_with("known are "), "{help}");
    }

    /// Where the family is called otherwise than the edition that is meant, it is named, too.
    #[test]
    fn families_of_codes_that_are_meant() {
        let day = on("2026-11-27");
        let error = choose_code("tbdy", day).unwrap_err();
        assert_eq!(error.to_string(), "unknown code \"tbdy\"");
        let help = error.help().unwrap();
        assert!(
            help.starts_with("did you mean \"tbdy_2018\"? \"turkey\""),
            "{help}"
        );
        let other = choose_code("asce7", day).unwrap_err().help().unwrap();
        assert_eq!(other, "did you mean \"asce_7_2016\"?");
    }
}
