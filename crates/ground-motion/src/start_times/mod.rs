//! Times of first samples as agencies print them.

mod calendar;
mod clock;
mod zone;

use calendar::{Days, date_later, days_of, is_no_date};
use clock::Clock;
use zone::{Zone, less};

pub(crate) use calendar::{days_after_1900, year_and_day};

/// A day (s), and half a day: times of day that are further apart lie on either side of a midnight.
const DAY_SECONDS: f64 = 86_400.0;
const HALF_DAY: f64 = 0.5 * DAY_SECONDS;

/// A time as it is printed.
struct Printed<'t> {
    /// What stands before the time of day, and the days that it may be.
    date: &'t str,
    days: Option<Days>,
    clock: Clock,
    zone: Zone<'t>,
    /// Seconds to take off it.
    less: f64,
}

/// How far apart two printed times are (s), each in any notation that has hours, minutes and seconds, such as
/// `2011/03/11 14:46:30 JST` or `20110311_144630.005`; days apart are infinite.
pub(crate) fn apart(first: &str, second: &str) -> Option<f64> {
    from_to(first, second).map(f64::abs)
}

/// The seconds from one printed time to another, below zero where the second is the earlier one: between instants where
/// both state their zones, else between the readings of their clocks. `None` where they cannot be compared: one is not
/// understood, one alone has a date, or a zone is not known.
pub(crate) fn from_to(first: &str, second: &str) -> Option<f64> {
    let (first, second) = (Printed::of(first)?, Printed::of(second)?);
    let ahead = match (first.zone, second.zone) {
        (Zone::Ahead(first), Zone::Ahead(second)) => second - first,
        (Zone::Named(first), Zone::Named(second)) if first == second => 0.0,
        (Zone::Unstated, _) | (_, Zone::Unstated) => 0.0,
        _ => return None,
    };
    let of_day = second.clock.seconds - first.clock.seconds + first.less - second.less - ahead;
    let counted = match (first.days, second.days) {
        (Some(a), Some(b)) => {
            let days = nearest(a, b, of_day / DAY_SECONDS)?;
            let counted = of_day + DAY_SECONDS * days as f64;
            (days == 0 || counted.abs() <= HALF_DAY).then_some(counted)
        }
        (None, None) => {
            // Of dates that are not known, equal ones are one day.
            let parted = |text: &str| text.chars().partition::<String, _>(char::is_ascii_digit);
            let ((a, form), (b, form_of_other)) = (parted(first.date), parted(second.date));
            if form != form_of_other {
                return None;
            }
            let over_midnight = of_day - DAY_SECONDS.copysign(of_day);
            match (of_day.abs() > HALF_DAY, a == b) {
                (true, false) => Some(over_midnight),
                // The zones alone may lead over midnight.
                (true, true) if ahead != 0.0 => Some(over_midnight),
                (_, true) => Some(of_day),
                (false, false) => None,
            }
        }
        _ => return None,
    };
    Some(counted.map_or(f64::INFINITY, |counted| {
        counted + inserted(&first, &second, counted)
    }))
}

/// The days from the first date to the second: of those that they may be, with day and month in one order, those that
/// bring both times the nearest.
fn nearest(first: Days, second: Days, of_day: f64) -> Option<i64> {
    let in_orders = |is_one: bool| {
        let pairs = (0..first.len()).flat_map(|i| (0..second.len()).map(move |j| (i, j)));
        let pairs = pairs.filter(move |(i, j)| !is_one || i % 2 == j % 2);
        let days = pairs.filter_map(|(i, j)| Some(second[j]? - first[i]?));
        days.min_by(|a, b| {
            let off = |days: &i64| (*days as f64 + of_day).abs();
            off(a).total_cmp(&off(b))
        })
    };
    in_orders(true).or_else(|| in_orders(false))
}

/// What a second that was inserted adds between two times so many seconds apart by their clocks: the minute has 61, and
/// one more lies between that second and the next minute.
fn inserted(first: &Printed<'_>, second: &Printed<'_>, counted: f64) -> f64 {
    // Round-off of the times.
    let is_behind = |seconds: f64, from: f64| seconds >= from - 1.0e-7;
    match (first.clock.inserted_from, second.clock.inserted_from) {
        (None, Some(from)) if is_behind(second.clock.seconds - counted, from) => -1.0,
        (Some(from), None) if is_behind(first.clock.seconds + counted, from) => 1.0,
        _ => 0.0,
    }
}

impl<'t> Printed<'t> {
    fn of(text: &'t str) -> Option<Self> {
        let clock = Clock::of(text)?;
        let behind = clock.behind(text);
        Some(Self {
            date: &text[..clock.from],
            days: days_of(&text[..clock.from]),
            zone: Zone::behind(behind),
            less: less(behind),
            clock,
        })
    }
}

/// Digits of seconds (s) that times are told apart by.
const DIGITS: usize = 6;

/// A printed time so many seconds later, in its own form; `None` where it is not understood, or
/// lies on another day of a date that is not.
pub(crate) fn later(text: &str, by: f64) -> Option<String> {
    let clock = Clock::of(text)?;
    if by == 0.0 {
        return Some(text.to_owned());
    }
    if !(by.abs() < 1.0e9) {
        return None;
    }
    // Whole parts of a second, so that 59.9999999 is not printed as 60.
    let parts = libm::round((clock.seconds + by) * 1.0e6) as i64;
    let inserted = clock.inserted_from.map(|from| (from * 1.0e6) as i64);
    // Of the second that was inserted; behind it the clock is one second late.
    let (parts, within) = match inserted {
        Some(from) if parts >= from + SECOND => (parts - SECOND, 0),
        Some(from) if parts >= from => (parts - SECOND, 1),
        _ => (parts, 0),
    };
    let (days, parts) = (parts.div_euclid(DAY), parts.rem_euclid(DAY));
    let date = match days {
        0 => text[..clock.from].to_owned(),
        days => date_later(&text[..clock.from], days)?,
    };
    let (whole, fraction) = (parts / SECOND, parts % SECOND);
    let mut digits = format!("{fraction:06}");
    while digits.len() > clock.decimals.min(DIGITS) && digits.ends_with('0') {
        digits.pop();
    }
    let point = if digits.is_empty() { "" } else { "." };
    let between = clock.separator;
    let hours = whole / 3600;
    // Hours that are counted to 12 begin with 12.
    let (hours, behind) = match clock.half {
        None => (hours, text[clock.to..].to_owned()),
        Some(half) => {
            let letter = match (hours >= 12, text.as_bytes()[half.at].is_ascii_uppercase()) {
                (true, true) => "P",
                (true, false) => "p",
                (false, true) => "A",
                (false, false) => "a",
            };
            let mut behind = text[clock.to..].to_owned();
            let at = half.at - clock.to;
            behind.replace_range(at..=at, letter);
            ((hours + 11) % 12 + 1, behind)
        }
    };
    Some(format!(
        "{date}{hours:02}{between}{:02}{between}{:02}{point}{digits}{behind}",
        whole / 60 % 60,
        whole % 60 + within,
    ))
}

/// A day and a second (us).
const DAY: i64 = 86_400_000_000;
const SECOND: i64 = 1_000_000;

/// Whether a printed time has an hour, a day or a month that there is not. What stands in no known form
/// says nothing.
pub(crate) fn is_impossible(text: &str) -> bool {
    let clock = Clock::find(text);
    let (date, of_clock) = match &clock {
        Some(clock) => (&text[..clock.from], !clock.is_possible),
        None => (text, false),
    };
    of_clock || is_no_date(date)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_apart() {
        for (a, b, seconds) in [
            (
                "2011/03/11 14:46:30 JST less 15 s",
                "2011/03/11 14:46:33 JST less 15 s",
                Some(3.0),
            ),
            (
                "2011/03/11 23:59:59.5 JST",
                "2011/03/12 00:00:00.0 JST",
                Some(0.5),
            ),
            (
                "2011/03/11 14:46:30",
                "2011/03/12 14:46:30",
                Some(f64::INFINITY),
            ),
            ("20110311_144630.000", "20110311_144630.005", Some(0.005)),
            // Rounded up, at no date at which a second is inserted.
            (
                "2011-03-11T14:59:60.00",
                "2011-03-11T15:00:00.00",
                Some(0.0),
            ),
            (
                "2011-03-11T14:59:60.00",
                "2011-03-11T14:59:59.00",
                Some(1.0),
            ),
            (
                "2004,270,14:46:30.0100",
                "2004,270,14:46:30.0000",
                Some(0.01),
            ),
            (
                "2011 day 70 14:46:30.000 UTC",
                "2011/03/11 14:46:30 JST",
                Some(32_400.0),
            ),
            (
                "10/20/2021, 10:34: 1.0 UTC",
                "10/20/2021, 10:34:11.0 UTC",
                Some(10.0),
            ),
            (
                "10/20/2021,  9: 4: 1.0",
                "10/20/2021, 10: 4: 1.0",
                Some(3600.0),
            ),
            (
                "10/20/2021, 9: 4: 1.0",
                "10/20/2021, 10: 4: 1.0",
                Some(3600.0),
            ),
            (
                "2011 03 11 14 46 00 JST",
                "2011 03 11 14 46 10.5 JST",
                Some(10.5),
            ),
            (
                "2011 03 11 23 59 59 JST",
                "2011 03 12 00 00 01 JST",
                Some(2.0),
            ),
            ("2011 03 11 14 46 00", "2011 03 11 14 46", None),
            // The second that was inserted at the end of 2016.
            (
                "2016-12-31T23:59:60.010000",
                "2016-12-31T23:59:60.000000",
                Some(0.01),
            ),
            (
                "2016-12-31T23:59:59.990000",
                "2016-12-31T23:59:60.000000",
                Some(0.01),
            ),
            (
                "2016-12-31T23:59:60.990000",
                "2017-01-01T00:00:00.000000",
                Some(0.01),
            ),
            (
                "2017-01-01T00:00:00.000000",
                "2016-12-31T23:59:60.990000",
                Some(0.01),
            ),
            (
                "2017/01/01 08:59:60.99 JST",
                "2017/01/01 09:00:00.00 JST",
                Some(0.01),
            ),
            (
                "2017/01/01 08:59:58.00 JST",
                "2017/01/01 08:59:60.50 JST",
                Some(2.5),
            ),
            // One instant by two zones.
            (
                "2011/03/11 14:46:15 JST",
                "2011/03/11 05:46:15 UTC",
                Some(0.0),
            ),
            (
                "2011/03/12 00:30:00 JST",
                "2011-03-11T15:30:00.5Z",
                Some(0.5),
            ),
            (
                "2011/03/11 14:46:15 JST",
                "2011/03/11 14:46:15 UTC",
                Some(32_400.0),
            ),
            (
                "2011/03/11 14:46:15 JST",
                "2011/03/11 14:46:15 JST less 15 s",
                Some(15.0),
            ),
            (
                "2011/03/11 14:46:15 JST",
                "2011 day 70 05:46:25 UTC",
                Some(10.0),
            ),
            ("2011/03/11 14:46:15 JST", "20110311_144625", Some(10.0)),
            ("2011/03/11 14:46:15 JST", "20110311T054615Z", Some(0.0)),
            ("2011/03/11 14:46:15 JST", "2011,070,14:46:15", Some(0.0)),
            (
                "2014/07/06 4:00:18 PM",
                "2014/07/06 4:00:18 AM",
                Some(43_200.0),
            ),
            ("2014/07/06 12:00:18 a.m.", "2014/07/06 00:00:19", Some(1.0)),
            (
                "2012-05-29T07:00:03+02:00",
                "2012-05-29T07:00:03+00:00",
                Some(7200.0),
            ),
            (
                "2012-05-29T07:00:03+02:00",
                "29.05.2012 05:00:03 GMT",
                Some(0.0),
            ),
            (
                "1999/09/20-17:46:37.0 GMT+8",
                "1999-09-20T09:46:37Z",
                Some(0.0),
            ),
            // Month and day, and the century, may be meant in two ways.
            (
                "7/06/19, 03:16: 8.0 UTC (GPS)",
                "2019-07-06T03:16:09Z",
                Some(1.0),
            ),
            (
                "7/06/19, 03:16: 8.0 UTC (GPS)",
                "2019-07-08T03:16:09Z",
                Some(f64::INFINITY),
            ),
            (
                "2011/03/11 23:00:00",
                "2011/03/13 01:00:00",
                Some(f64::INFINITY),
            ),
            (
                "03/04/2011 10:00:00",
                "04/03/2011 10:00:00",
                Some(f64::INFINITY),
            ),
            ("13/04/2011 10:00:00", "04/13/2011 10:00:00", Some(0.0)),
            // An inserted second in another zone.
            (
                "2016-12-31T23:59:60.500Z",
                "2017/01/01 09:00:00.25 JST",
                Some(0.75),
            ),
            // No date, or a zone that is not known.
            ("22:46:15 UTC", "07:46:15 JST", Some(0.0)),
            ("18:14:18", "1985/09/19 18:14:18", None),
            (
                "2014/07/06 10:00:18 CST",
                "2014/07/06 10:00:19 CST",
                Some(1.0),
            ),
            ("2014/07/06 10:00:18 CST", "2014/07/06 10:00:18 UTC", None),
            ("2011/03/11 14:46:15", "in the evening", None),
            ("", "", None),
            ("14:46", "14:47", None),
            ("at 99:00:00", "at 99:00:01", None),
        ] {
            assert_eq!(from_to(a, b).map(f64::abs), apart(a, b));
            match (apart(a, b), seconds) {
                (Some(found), Some(seconds)) => {
                    assert!(
                        found == seconds || (found - seconds).abs() < 1e-9,
                        "{a}: {found}"
                    );
                }
                (found, seconds) => assert_eq!(found, seconds, "{a}"),
            }
        }
    }

    #[test]
    fn times_of_no_calendar() {
        for text in [
            "2020/13/01 01:02:15 JST",
            "2020/12/41 01:02:15 JST",
            "2021/02/29 01:02:15 JST",
            "2020/12/31 25:02:15 JST",
            "2020-12-31T23:61:15",
            "20231301_011730",
            "20230230_011730.005",
            "20230228_241730",
            "2020 day 367 01:02:03.456 UTC",
            "2021 day 366 01:02:03 UTC",
            "2011 13 11 14 46 00 JST",
            "2011 02 29 14 46 00 JST",
            "2011 03 11 24 46 00 JST",
            "1999/09/20-27:46:37.0 GMT+8",
            "31.13.1999 04:55:53.671UTC",
            "31.11.1999 04:55:53",
            "41/13/2000 00:00:00",
            "2016-12-31T23:58:60.5",
            "2016-12-31T23:59:61.0",
            "2012/05/29 13:00:00 AM",
            "2012/05/29 24:00:00 PM",
        ] {
            assert!(is_impossible(text), "{text}");
        }
        for text in [
            "",
            "2020/02/29 01:02:15 JST less 15 s",
            "2020-12-31T23:59:60",
            "2016-12-31T23:59:60.5",
            "2017/01/01 08:59:60.99 JST",
            "2017/01/01 08:12:60.0 UTC",
            "20000101_000000.000",
            "2020 day 366 01:02:03.456 UTC",
            "1999/09/20-17:46:37.0 GMT+8",
            "31.12.1999 04:55:53.671UTC",
            "12/20/22, 10:34: 1.0 UTC (GPS)",
            "06/28/92, 15:05:37.4 UTC",
            "01/31/2000 00:00:00.000000 (GMT)",
            "31/01/2000 00:00:00.000000 (GMT)",
            "00:00:00",
            "2018/11/30 17:29:06.332 UTC (Q=5) RcrdId: (see comment)",
            "2012 02 29 14 46 00 JST",
            "2012 2",
            "2012 13 more",
            "2012/05/29 12:59:59 PM",
            "2012/05/29 14:59:59 PM",
            "1 13 2012",
            "unknown",
            "2020",
        ] {
            assert!(!is_impossible(text), "{text}");
        }
    }

    #[test]
    fn later_times_have_their_own_form() {
        for (text, by, found) in [
            (
                "2011/03/11 14:46:30 JST less 15 s",
                5.25,
                Some("2011/03/11 14:46:35.25 JST less 15 s"),
            ),
            (
                "2011/12/31 23:59:59.50 JST",
                0.5,
                Some("2012/01/01 00:00:00.00 JST"),
            ),
            (
                "2012-03-01 00:00:00 UTC",
                -1.0,
                Some("2012-02-29 23:59:59 UTC"),
            ),
            ("20110311_144630.005", -30.005, Some("20110311_144600.000")),
            ("20110301_000000", -0.5, Some("20110228_235959.5")),
            (
                "2000 day 366 23:59:59.9999 UTC",
                0.0002,
                Some("2001 day 1 00:00:00.0001 UTC"),
            ),
            (
                "2001 day 1 00:00:00.0000 UTC",
                -0.5,
                Some("2000 day 366 23:59:59.5000 UTC"),
            ),
            (
                "10/20/21, 10:34: 1.0 UTC (Q= 5)",
                9.0,
                Some("10/20/21, 10:34:10.0 UTC (Q= 5)"),
            ),
            (
                "2011 12 31 23 59 58 JST",
                2.25,
                Some("2012 01 01 00 00 00.25 JST"),
            ),
            (
                "2016-12-31T23:59:60.5",
                0.25,
                Some("2016-12-31T23:59:60.75"),
            ),
            ("2016-12-31T23:59:60.5", -1.0, Some("2016-12-31T23:59:59.5")),
            ("2016-12-31T23:59:60.5", 1.0, Some("2017-01-01T00:00:00.5")),
            (
                "2011-03-11T14:59:60.00",
                1.0,
                Some("2011-03-11T15:00:01.00"),
            ),
            ("2011 03 11 14 59 60", 1.0, Some("2011 03 11 15 00 01")),
            ("12/31/2016 23:59:60.0", 0.5, Some("12/31/2016 23:59:60.5")),
            (
                "2012/05/29 11:59:59 AM",
                1.0,
                Some("2012/05/29 12:00:00 PM"),
            ),
            (
                "2012/05/29 11:59:59 PM",
                1.0,
                Some("2012/05/30 12:00:00 AM"),
            ),
            (
                "2012/05/29 12:59:59 PM UTC",
                1.0,
                Some("2012/05/29 01:00:00 PM UTC"),
            ),
            (
                "2012/05/29 12:00:00.5 a.m.",
                -1.0,
                Some("2012/05/28 11:59:59.5 p.m."),
            ),
            (
                "2012-05-29T07:00:03+02:00",
                1.5,
                Some("2012-05-29T07:00:04.5+02:00"),
            ),
            ("20110311T054615Z", 1.0, Some("20110311T054616Z")),
            // The order of day and month is not known.
            ("10/11/21, 23:59:59.0", 2.0, None),
            ("some day", 2.0, None),
            ("", 2.0, None),
        ] {
            assert_eq!(later(text, by).as_deref(), found, "{text}");
        }
    }
}
