//! Times of first samples as agencies print them.

/// Half a day (s): times of day that are further apart lie on either side of a midnight.
const HALF_DAY: f64 = 43_200.0;

/// A time of day with what stands before it, which is the date.
struct Printed {
    /// Digits of the date, and the rest of what stands before the time.
    date: String,
    form: String,
    seconds: f64,
    inserted_from: Option<f64>,
}

/// How far apart two printed times are (s), where both stand in one form that has hours, minutes
/// and seconds, such as `2011/03/11 14:46:30 JST` or `20110311_144630.005`; days apart are infinite.
pub(crate) fn apart(first: &str, second: &str) -> Option<f64> {
    from_to(first, second).map(f64::abs)
}

/// The seconds from one printed time to another, below zero where the second is the earlier one.
pub(crate) fn from_to(first: &str, second: &str) -> Option<f64> {
    let (first, second) = (Printed::of(first)?, Printed::of(second)?);
    if first.form != second.form {
        return None;
    }
    let later = second.seconds - first.seconds;
    let is_one_day = first.date == second.date;
    // The minute of a second that was inserted has 61: one more lies between that and the next.
    let is_behind = |other: &Printed, inserted: &Printed, from: f64| match is_one_day {
        true => other.seconds >= from,
        false => other.seconds < inserted.seconds,
    };
    let inserted = match (first.inserted_from, second.inserted_from) {
        (None, Some(from)) if is_behind(&first, &second, from) => -1.0,
        (Some(from), None) if is_behind(&second, &first, from) => 1.0,
        _ => 0.0,
    };
    let counted = later + inserted;
    Some(match (is_one_day, later.abs() > HALF_DAY) {
        (true, _) => counted,
        // Over midnight.
        (false, true) => counted - (2.0 * HALF_DAY).copysign(later),
        (false, false) => f64::INFINITY,
    })
}

impl Printed {
    fn of(text: &str) -> Option<Self> {
        let clock = Clock::of(text)?;
        let (digits, rest) = text[..clock.from].chars().partition(char::is_ascii_digit);
        Some(Self {
            date: digits,
            form: rest,
            seconds: clock.seconds,
            inserted_from: clock.inserted_from,
        })
    }
}

/// The time of day in a text.
struct Clock {
    /// Where it stands.
    from: usize,
    to: usize,
    /// Seconds after midnight.
    seconds: f64,
    /// Where the second begins (s) that was inserted into the minute, if the time lies in it.
    inserted_from: Option<f64>,
    /// Digits behind the point.
    decimals: usize,
    /// What stands between hours, minutes and seconds.
    separator: &'static str,
}

impl Clock {
    fn of(text: &str) -> Option<Self> {
        let (from, to, [hours, minutes, seconds], separator) = with_colons(text)
            .map(|(from, to, numbers)| (from, to, numbers, ":"))
            .or_else(|| in_a_row(text).map(|(from, to, numbers)| (from, to, numbers, "")))
            .or_else(|| in_blanks(text).map(|(from, to, numbers)| (from, to, numbers, " ")))?;
        let inside = is_of_clock([hours, minutes, seconds]);
        let behind = text[from..to].split_once('.');
        let minute = 3600.0 * hours + 60.0 * minutes;
        // Headers round up to 60 seconds in any minute: that of an inserted second stands at few dates.
        let is_inserted = seconds > 60.0 || seconds == 60.0 && may_insert(&text[..from]);
        inside.then_some(Self {
            from,
            to,
            seconds: minute + seconds,
            inserted_from: (is_inserted && minutes == 59.0).then_some(minute + 60.0),
            decimals: behind.map_or(0, |(_, digits)| digits.len()),
            separator,
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
    Some(format!(
        "{date}{:02}{between}{:02}{between}{:02}{point}{digits}{}",
        whole / 3600,
        whole / 60 % 60,
        whole % 60 + within,
        &text[clock.to..]
    ))
}

/// A day and a second (us).
const DAY: i64 = 86_400_000_000;
const SECOND: i64 = 1_000_000;

/// What stands before a time of day, with its date so many days later: `2011/03/11 `,
/// `2011-03-11T`, `2011 03 11 `, `20110311_` or `2011 day 70 `.
fn date_later(text: &str, days: i64) -> Option<String> {
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let number = |from: usize, to: usize| text.get(from..to)?.parse::<i64>().ok();
    if digits == 8 {
        let date = (number(0, 4)?, number(4, 6)?, number(6, 8)?);
        let (year, month, day) = date_of(days_after_1900(date)? + days);
        return Some(format!("{year:04}{month:02}{day:02}{}", &text[8..]));
    }
    if digits != 4 {
        return None;
    }
    if let Some(rest) = text[4..].strip_prefix(" day ") {
        let length = rest.bytes().take_while(u8::is_ascii_digit).count();
        let day: i64 = rest[..length].parse().ok()?;
        let (year, day) = year_and_day(number(0, 4)?, day + days);
        return Some(format!("{year} day {day}{}", &rest[length..]));
    }
    let between = text.get(4..5).filter(|c| matches!(*c, "/" | "-" | " "))?;
    if text.get(7..8) != Some(between) {
        return None;
    }
    let date = (number(0, 4)?, number(5, 7)?, number(8, 10)?);
    let (year, month, day) = date_of(days_after_1900(date)? + days);
    let rest = text.get(10..)?;
    Some(format!(
        "{year:04}{between}{month:02}{between}{day:02}{rest}"
    ))
}

/// Whether a printed time has an hour, a day or a month that there is not. What stands in no known form
/// says nothing.
pub(crate) fn is_impossible(text: &str) -> bool {
    let clock = with_colons(text)
        .or_else(|| in_a_row(text))
        .or_else(|| in_blanks(text));
    let (date, of_clock) = match clock {
        Some((from, _, numbers)) => (&text[..from], !is_of_clock(numbers)),
        None => (text, false),
    };
    of_clock || is_no_date(date)
}

/// The same of a date in year, month and day, in a year and its day, or in day, month and year; beside
/// slashes the month may stand before the day.
fn is_no_date(text: &str) -> bool {
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let number = |text: &str| text.parse::<i64>().ok();
    let is_date = |(year, month, day): (i64, i64, i64)| {
        let next = usize::try_from(month)
            .ok()
            .and_then(|index| BEFORE.get(index));
        let before = usize::try_from(month - 1)
            .ok()
            .and_then(|index| BEFORE.get(index));
        let leap = i64::from(month == 2 && is_leap(year));
        before.is_some_and(|before| (1..=next.unwrap_or(&365) - before + leap).contains(&day))
    };
    if digits == 8 {
        let part = |from: usize, to: usize| number(&text[from..to]);
        let date = (part(0, 4).zip(part(4, 6))).zip(part(6, 8));
        return date.is_some_and(|((year, month), day)| !is_date((year, month, day)));
    }
    if let Some(rest) = text[digits..].strip_prefix(" day ") {
        let day = rest.split(' ').next().and_then(number);
        let year = number(&text[..digits]);
        return (year.zip(day)).is_some_and(|(y, day)| !(1..=length_of(y)).contains(&day));
    }
    let Some(sign) = text[digits..]
        .chars()
        .next()
        .filter(|c| "/-. ".contains(*c))
    else {
        return false;
    };
    let mut parts = text.splitn(3, sign);
    let mut next = || {
        let part = parts.next()?;
        let end = part
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(part.len());
        Some((end, number(&part[..end])?))
    };
    let (Some(first), Some(second), Some(third)) = (next(), next(), next()) else {
        return false;
    };
    match (first.0, second.0, third.0) {
        (4, 1..=2, 1..=2) => !is_date((first.1, second.1, third.1)),
        // Blanks stand in other texts, too.
        _ if sign == ' ' => false,
        (1..=2, 1..=2, 4) if sign == '/' => {
            !is_date((third.1, second.1, first.1)) && !is_date((third.1, first.1, second.1))
        }
        (1..=2, 1..=2, 4) => !is_date((third.1, second.1, first.1)),
        _ => false,
    }
}

/// Whether a second may be inserted at the date that stands before a time of day: they are at the ends of June and of
/// December in UTC, and so on the day after where clocks are ahead of it.
fn may_insert(date: &str) -> bool {
    let digits: String = date.chars().filter(char::is_ascii_digit).collect();
    // Month and day, either first, at the start or at the end.
    let days = ["0630", "3006", "0701", "0107", "1231", "3112", "0101"];
    days.iter()
        .any(|day| digits.starts_with(day) || digits.ends_with(day))
}

/// Seconds are inserted at the end of a day of UTC, which is that of an hour where clocks differ from it by whole hours;
/// headers round up to 60 in any minute.
fn is_of_clock([hours, minutes, seconds]: [f64; 3]) -> bool {
    let is_inserted = minutes == 59.0 && seconds < 61.0;
    hours < 24.0 && minutes < 60.0 && (seconds <= 60.0 || is_inserted)
}

fn is_leap(year: i64) -> bool {
    year % 4 == 0 && year % 100 != 0 || year % 400 == 0
}

fn length_of(year: i64) -> i64 {
    365 + i64::from(is_leap(year))
}

/// Days of the year before each month.
const BEFORE: [i64; 12] = [0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334];

/// Days from 1 January 1900 to a date (year, month, day) of the Gregorian calendar.
pub(crate) fn days_after_1900((year, month, day): (i64, i64, i64)) -> Option<i64> {
    let index = usize::try_from(month - 1).ok()?;
    let before = BEFORE.get(index)?;
    if !((1..=31).contains(&day) && (1..=9999).contains(&year)) {
        return None;
    }
    let of_year = before + i64::from(is_leap(year) && month > 2) + day - 1;
    let past = year - 1;
    Some(365 * (year - 1900) + past / 4 - past / 100 + past / 400 - 460 + of_year)
}

/// Year, month and day so many days after 1 January 1900.
fn date_of(days: i64) -> (i64, i64, i64) {
    let (year, day) = year_and_day(1900, days + 1);
    let leap = i64::from(is_leap(year));
    let first = |index: usize| BEFORE[index] + if index > 1 { leap } else { 0 };
    let month = (0..12).rev().find(|index| first(*index) < day).unwrap_or(0);
    (year, month as i64 + 1, day - first(month))
}

/// A day of a year, counted from 1, which may lie in another year.
pub(crate) fn year_and_day(mut year: i64, mut day: i64) -> (i64, i64) {
    while day > length_of(year) {
        day -= length_of(year);
        year += 1;
    }
    while day < 1 {
        year -= 1;
        day += length_of(year);
    }
    (year, day)
}

/// Where `14:46:30.005` starts and ends, and its numbers; one digit may have a blank before it, as
/// in `10:34: 1.0`.
fn with_colons(text: &str) -> Option<(usize, usize, [f64; 3])> {
    let first = text.find(':')?;
    let is_digit = |c: char| c.is_ascii_digit();
    let hours = text[..first].trim_end_matches(is_digit).len();
    let second = first + 1 + text[first + 1..].find(':')?;
    let rest = &text[second + 1..];
    let blanks = rest.len() - rest.trim_start_matches(' ').len();
    let end = rest[blanks..].find(|c: char| !is_digit(c) && c != '.');
    let seconds = rest[..end.map_or(rest.len(), |end| blanks + end)].trim_end_matches('.');
    let number = |text: &str| text.trim().parse::<f64>().ok();
    Some((
        hours,
        second + 1 + seconds.len(),
        [
            number(&text[hours..first])?,
            number(&text[first + 1..second])?,
            number(seconds)?,
        ],
    ))
}

/// The same of `20110311_144630.005`.
fn in_a_row(text: &str) -> Option<(usize, usize, [f64; 3])> {
    let (date, time) = text.split_once('_')?;
    let whole = time.split('.').next()?;
    let all_digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    if !(date.len() == 8 && all_digits(date) && whole.len() == 6 && all_digits(whole)) {
        return None;
    }
    let time = time.trim_end();
    let number = |text: &str| text.parse::<f64>().ok();
    let from = date.len() + 1;
    Some((
        from,
        from + time.len(),
        [
            number(&time[..2])?,
            number(&time[2..4])?,
            number(&time[4..])?,
        ],
    ))
}

/// The same of `2011 03 11 14 46 30.005`, with whatever stands behind a blank.
fn in_blanks(text: &str) -> Option<(usize, usize, [f64; 3])> {
    // Digits of year, month, day, hour and minute, each with a blank behind it.
    const WIDTHS: [usize; 5] = [4, 2, 2, 2, 2];
    let mut at = 0;
    let mut starts = [0; WIDTHS.len()];
    for (start, width) in starts.iter_mut().zip(WIDTHS) {
        let field = text.get(at..at + width + 1)?;
        let digits = field.strip_suffix(' ')?;
        if !digits.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        *start = at;
        at += width + 1;
    }
    let seconds = text[at..].split(' ').next()?;
    let whole = seconds.split('.').next()?;
    let is_number = seconds.bytes().all(|b| b.is_ascii_digit() || b == b'.');
    if whole.len() != 2 || !is_number {
        return None;
    }
    let seconds = seconds.trim_end_matches('.');
    let number = |text: &str| text.parse::<f64>().ok();
    let [_, _, _, hours, minutes] = starts;
    Some((
        hours,
        at + seconds.len(),
        [
            number(&text[hours..hours + 2])?,
            number(&text[minutes..minutes + 2])?,
            number(seconds)?,
        ],
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_one_form() {
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
                None,
            ),
            (
                "10/20/2021, 10:34: 1.0 UTC",
                "10/20/2021, 10:34:11.0 UTC",
                Some(10.0),
            ),
            ("10/20/2021,  9: 4: 1.0", "10/20/2021, 10: 4: 1.0", None),
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
            // The order of day and month is not known.
            ("10/11/21, 23:59:59.0", 2.0, None),
            ("some day", 2.0, None),
            ("", 2.0, None),
        ] {
            assert_eq!(later(text, by).as_deref(), found, "{text}");
        }
    }
}
