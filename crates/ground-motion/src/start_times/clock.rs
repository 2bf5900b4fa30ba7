//! Times of day as agencies print them.

/// The time of day in a text.
pub(super) struct Clock {
    /// Where it stands.
    pub from: usize,
    pub to: usize,
    /// Seconds after midnight.
    pub seconds: f64,
    /// Where the second begins (s) that was inserted into the minute, if the time lies in it.
    pub inserted_from: Option<f64>,
    /// Digits behind the point.
    pub decimals: usize,
    /// What stands between hours, minutes and seconds.
    pub separator: &'static str,
    /// Which half of the day it is in, where hours are counted to 12.
    pub half: Option<Half>,
    /// Whether a clock has it.
    pub is_possible: bool,
}

/// `AM` or `PM` behind a time of day.
#[derive(Clone, Copy)]
pub(super) struct Half {
    /// Where its first letter stands, and where it ends.
    pub at: usize,
    pub end: usize,
    pub is_second: bool,
}

impl Half {
    /// That of what stands behind a time: `AM`, `pm`, `a.m.`, `p. m.`.
    fn behind(text: &str, to: usize) -> Option<Self> {
        let rest = &text[to..];
        let at = to + rest.len() - rest.trim_start().len();
        let letter = text[at..].chars().next()?.to_ascii_lowercase();
        if !matches!(letter, 'a' | 'p') {
            return None;
        }
        let rest = &text[at + 1..];
        let rest = rest
            .strip_prefix('.')
            .map_or(rest, |behind| behind.trim_start());
        let rest = rest.strip_prefix(['m', 'M'])?;
        let rest = rest.strip_prefix('.').unwrap_or(rest);
        let is_word = !rest.starts_with(|c: char| c.is_alphanumeric());
        is_word.then_some(Self {
            at,
            end: text.len() - rest.len(),
            is_second: letter == 'p',
        })
    }
}

impl Clock {
    /// One that a clock has.
    pub(super) fn of(text: &str) -> Option<Self> {
        Self::find(text).filter(|clock| clock.is_possible)
    }

    pub(super) fn find(text: &str) -> Option<Self> {
        let (from, to, [hours, minutes, seconds], separator) = with_colons(text)
            .map(|(from, to, numbers)| (from, to, numbers, ":"))
            .or_else(|| in_a_row(text).map(|(from, to, numbers)| (from, to, numbers, "")))
            .or_else(|| in_blanks(text).map(|(from, to, numbers)| (from, to, numbers, " ")))?;
        let half = Half::behind(text, to);
        // `14:46:30 PM` counts to 24 all the same.
        let is_of_half = half.is_none_or(|half| half.is_second || hours <= 12.0);
        let hours = match half {
            Some(half) if hours <= 12.0 => hours % 12.0 + if half.is_second { 12.0 } else { 0.0 },
            _ => hours,
        };
        let behind = text[from..to].split_once('.');
        let minute = 3600.0 * hours + 60.0 * minutes;
        // Headers round up to 60 seconds in any minute: that of an inserted second stands at few dates.
        let is_inserted = seconds > 60.0 || seconds == 60.0 && may_insert(&text[..from]);
        Some(Self {
            from,
            to,
            seconds: minute + seconds,
            inserted_from: (is_inserted && minutes == 59.0).then_some(minute + 60.0),
            decimals: behind.map_or(0, |(_, digits)| digits.len()),
            separator,
            half,
            is_possible: is_of_half && is_of_clock([hours, minutes, seconds]),
        })
    }

    /// What stands behind it in the text.
    pub(super) fn behind<'t>(&self, text: &'t str) -> &'t str {
        &text[self.half.map_or(self.to, |half| half.end)..]
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

/// The same of `20110311_144630.005` and `20110311T144630Z`.
fn in_a_row(text: &str) -> Option<(usize, usize, [f64; 3])> {
    let (date, time) = text.split_once(['_', 'T'])?;
    let all_digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    let end = time.find(|c: char| !(c.is_ascii_digit() || c == '.'));
    let time = time[..end.unwrap_or(time.len())].trim_end_matches('.');
    let whole = time.split('.').next()?;
    if !(date.len() == 8 && all_digits(date) && whole.len() == 6) {
        return None;
    }
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
