//! Zones of times of day as agencies print them behind these.

/// The zone of a time of day.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Zone<'t> {
    /// Not stated.
    Unstated,
    /// So many seconds before UTC.
    Ahead(f64),
    /// A name that is not known, or stands for several zones.
    Named(&'t str),
}

/// Zones (hours before UTC) by their names, where agencies that print these mean one alone: PST is that of California, which
/// also names the time of the Philippines.
const ZONES: [(&str, f64); 26] = [
    ("UTC", 0.0),
    ("UT", 0.0),
    ("GMT", 0.0),
    ("Z", 0.0),
    ("WET", 0.0),
    ("CET", 1.0),
    ("MET", 1.0),
    ("CEST", 2.0),
    ("EET", 2.0),
    ("EEST", 3.0),
    ("TRT", 3.0),
    ("MSK", 3.0),
    ("IRST", 3.5),
    ("IRDT", 4.5),
    ("JST", 9.0),
    ("KST", 9.0),
    ("NZST", 12.0),
    ("NZDT", 13.0),
    ("HST", -10.0),
    ("AKST", -9.0),
    ("AKDT", -8.0),
    ("PST", -8.0),
    ("PDT", -7.0),
    ("MST", -7.0),
    ("MDT", -6.0),
    ("EDT", -4.0),
];

/// Most hours that clocks differ from UTC by.
const MOST: f64 = 14.0;

impl<'t> Zone<'t> {
    /// That of what stands behind a time of day: `Z`, ` JST`, ` GMT+8`, `+09:00`, ` (GMT)`.
    pub(super) fn behind(rest: &'t str) -> Self {
        let rest = rest.trim_start_matches([' ', '(', ',']);
        if let Some(ahead) = difference(rest) {
            return Self::Ahead(ahead);
        }
        let is_outside = |c: char| !c.is_alphabetic();
        let (word, behind) = rest.split_at(rest.find(is_outside).unwrap_or(rest.len()));
        let known = ZONES
            .iter()
            .find(|(name, _)| name.eq_ignore_ascii_case(word));
        if let Some((_, hours)) = known {
            // `GMT+8`.
            let more = difference(behind.trim_start()).filter(|_| *hours == 0.0);
            return Self::Ahead(more.unwrap_or(3600.0 * hours));
        }
        let is_name = (3..=5).contains(&word.len())
            && word.ends_with('T')
            && word.bytes().all(|b| b.is_ascii_uppercase());
        match is_name {
            true => Self::Named(word),
            false => Self::Unstated,
        }
    }
}

/// Seconds of `+09:00`, `+0900`, `-8`.
fn difference(text: &str) -> Option<f64> {
    let sign = match text.chars().next()? {
        '+' => 1.0,
        '-' => -1.0,
        _ => return None,
    };
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let number = |text: &str| text.parse::<f64>().ok();
    let text = &text[1..];
    let length = digits(text);
    let (hours, rest) = text.split_at(length);
    let (hours, minutes) = match length {
        1 | 2 => match rest.strip_prefix(':').filter(|rest| digits(rest) >= 2) {
            Some(minutes) => (hours, &minutes[..2]),
            None => (hours, "0"),
        },
        4 => hours.split_at(2),
        _ => return None,
    };
    let hours = number(hours)? + number(minutes)? / 60.0;
    (hours <= MOST).then_some(sign * 3600.0 * hours)
}

/// By how many seconds a time is to be less, as that of K-NET, ` JST less 15 s`, which its recorder states late.
pub(super) fn less(rest: &str) -> f64 {
    let number = |text: &str| text.split(' ').next()?.parse::<f64>().ok();
    let stated = rest.split_once("less ").and_then(|(_, text)| number(text));
    stated.filter(|seconds| seconds.is_finite()).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zones_behind_times() {
        for (rest, hours) in [
            (" JST less 15 s", 9.0),
            (" UTC (Q=5) RcrdId: (see comment)", 0.0),
            (" GMT+8", 8.0),
            (" UTC-03:30", -3.5),
            (" (GMT)", 0.0),
            ("Z", 0.0),
            ("+09:00", 9.0),
            ("+0530", 5.5),
            ("-08", -8.0),
            (" UTC +1", 1.0),
            (" utc", 0.0),
        ] {
            assert_eq!(Zone::behind(rest), Zone::Ahead(3600.0 * hours), "{rest}");
        }
        for rest in ["", " at night", " +99:00", " N-S", " (see comment)", "-123"] {
            assert_eq!(Zone::behind(rest), Zone::Unstated, "{rest}");
        }
        assert_eq!(Zone::behind(" CST"), Zone::Named("CST"));
    }

    #[test]
    fn seconds_that_a_time_is_less() {
        for (rest, seconds) in [
            (" JST less 15 s", 15.0),
            (" JST", 0.0),
            (" less of it", 0.0),
        ] {
            assert_eq!(less(rest), seconds, "{rest}");
        }
    }
}
