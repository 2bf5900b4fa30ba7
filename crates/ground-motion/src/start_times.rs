//! Times of first samples as agencies print them.

/// Half a day (s): times of day that are further apart lie on either side of a midnight.
const HALF_DAY: f64 = 43_200.0;

/// A time of day with what stands before it, which is the date.
struct Printed {
    /// Digits of the date, and the rest of what stands before the time.
    date: String,
    form: String,
    seconds: f64,
}

/// How far apart two printed times are (s), where both stand in one form that has hours, minutes
/// and seconds, such as `2011/03/11 14:46:30 JST` or `20110311_144630.005`; days apart are infinite.
pub(crate) fn apart(first: &str, second: &str) -> Option<f64> {
    let (first, second) = (Printed::of(first)?, Printed::of(second)?);
    if first.form != second.form {
        return None;
    }
    let apart = (first.seconds - second.seconds).abs();
    Some(match (first.date == second.date, apart > HALF_DAY) {
        (true, _) => apart,
        (false, true) => 2.0 * HALF_DAY - apart,
        (false, false) => f64::INFINITY,
    })
}

impl Printed {
    fn of(text: &str) -> Option<Self> {
        let (at, [hours, minutes, seconds]) = with_colons(text).or_else(|| in_a_row(text))?;
        let (digits, rest) = text[..at].chars().partition(char::is_ascii_digit);
        let inside = hours < 24.0 && minutes < 60.0 && seconds <= 60.0;
        inside.then_some(Self {
            date: digits,
            form: rest,
            seconds: 3600.0 * hours + 60.0 * minutes + seconds,
        })
    }
}

/// Where `14:46:30.005` starts, and its numbers.
fn with_colons(text: &str) -> Option<(usize, [f64; 3])> {
    let first = text.find(':')?;
    let is_digit = |c: char| c.is_ascii_digit();
    let hours = text[..first].trim_end_matches(is_digit).len();
    let (minutes, rest) = text[first + 1..].split_once(':')?;
    let end = rest.find(|c: char| !is_digit(c) && c != '.');
    let seconds = rest[..end.unwrap_or(rest.len())].trim_end_matches('.');
    let number = |text: &str| text.parse::<f64>().ok();
    Some((
        hours,
        [
            number(&text[hours..first])?,
            number(minutes)?,
            number(seconds)?,
        ],
    ))
}

/// The same of `20110311_144630.005`.
fn in_a_row(text: &str) -> Option<(usize, [f64; 3])> {
    let (date, time) = text.split_once('_')?;
    let whole = time.split('.').next()?;
    let all_digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    if !(date.len() == 8 && all_digits(date) && whole.len() == 6 && all_digits(whole)) {
        return None;
    }
    let number = |text: &str| text.trim().parse::<f64>().ok();
    Some((
        date.len() + 1,
        [
            number(&time[..2])?,
            number(&time[2..4])?,
            number(&time[4..])?,
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
            ("", "", None),
            ("14:46", "14:47", None),
            ("at 99:00:00", "at 99:00:01", None),
        ] {
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
}
