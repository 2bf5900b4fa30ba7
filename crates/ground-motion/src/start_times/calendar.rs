//! Dates as agencies print them before times of day, and days of the Gregorian calendar.

/// The days (after 1 January 1900) that a date may stand for: with the day before the month and behind it in turn, and two
/// digits of a year in either century.
pub(super) type Days = [Option<i64>; 4];

/// What stands before a time of day, `2011/03/11 `, `2011-03-11T`, `2011 03 11 `, `20110311_`, `2011 day 70 `, `2011,070,`,
/// `11.03.2011 `, `03/11/2011, ` or `3/11/11, `, as days; `None` where it is no date that is known.
pub(super) fn days_of(text: &str) -> Option<Days> {
    let is_outside = |c: char| !c.is_ascii_alphanumeric();
    let text = text.trim_matches(is_outside);
    let text = text.strip_suffix('T').unwrap_or(text).trim_end();
    let number = |text: &str| {
        let is_number = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        text.parse::<i64>().ok().filter(|_| is_number)
    };
    let of_date = |date: (i64, i64, i64)| days_after_1900(date).filter(|_| is_date(date));
    let of_year = |year: &str, day: &str| {
        let (year, day) = (number(year)?, number(day)?);
        let first = days_after_1900((year, 1, 1))?;
        (1..=length_of(year))
            .contains(&day)
            .then(|| first + day - 1)
    };
    let alone = |day: Option<i64>| day.map(|day| [Some(day), Some(day), None, None]);
    if text.len() == 8
        && let (Some(_), Some(day)) = (number(text), text.get(6..))
    {
        return alone(of_date((
            number(&text[..4])?,
            number(&text[4..6])?,
            number(day)?,
        )));
    }
    if let Some((year, day)) = text.split_once(" day ") {
        return alone(of_year(year, day).filter(|_| year.len() == 4));
    }
    let sign = text.chars().find(|c| !c.is_ascii_digit())?;
    if !"/-. ,".contains(sign) {
        return None;
    }
    let mut parts = text.split(sign).map(str::trim);
    let (first, second, third) = (parts.next()?, parts.next()?, parts.next());
    if parts.next().is_some() {
        return None;
    }
    let Some(third) = third else {
        let is_of_year = first.len() == 4 && second.len() == 3;
        return alone(of_year(first, second).filter(|_| is_of_year));
    };
    let (a, b, c) = (number(first)?, number(second)?, number(third)?);
    if first.len() == 4 {
        return alone(of_date((a, b, c)));
    }
    let years = match third.len() {
        4 => [Some(c), None],
        2 => [Some(1900 + c), Some(2000 + c)],
        _ => return None,
    };
    // Blanks and commas stand in other texts, too; full stops stand behind the day first.
    let [first, last] = years.map(|year| {
        let either = [(b, a), (a, b)].map(|(month, day)| of_date((year?, month, day)));
        match sign {
            '.' => [either[0], either[0]],
            _ => either,
        }
    });
    let days = [first[0], first[1], last[0], last[1]];
    let is_known = "/-.".contains(sign) && days.iter().any(Option::is_some);
    is_known.then_some(days)
}

/// What stands before a time of day, with its date so many days later: `2011/03/11 `,
/// `2011-03-11T`, `2011 03 11 `, `20110311_` or `2011 day 70 `.
pub(super) fn date_later(text: &str, days: i64) -> Option<String> {
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

/// Whether there is no such date: of one in year, month and day, in a year and its day, or in day, month and year; beside
/// slashes the month may stand before the day.
pub(super) fn is_no_date(text: &str) -> bool {
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let number = |text: &str| text.parse::<i64>().ok();
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

/// Whether a year has such a month and day.
fn is_date((year, month, day): (i64, i64, i64)) -> bool {
    let next = usize::try_from(month)
        .ok()
        .and_then(|index| BEFORE.get(index));
    let before = usize::try_from(month - 1)
        .ok()
        .and_then(|index| BEFORE.get(index));
    let leap = i64::from(month == 2 && is_leap(year));
    before.is_some_and(|before| (1..=next.unwrap_or(&365) - before + leap).contains(&day))
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
