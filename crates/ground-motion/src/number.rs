//! Numbers as agencies print them.

use crate::quantity::SeriesUnit;

/// A value that a header prints, with one unit of its last digit.
pub(crate) type Printed = (f64, f64);

/// Magnitudes from which, and up to which, a value is the `1.7E+38` that stands for "missing", or
/// another one near the largest of single precision.
pub(crate) const MISSING: f64 = 1.0e37;
const LARGEST_MISSING: f64 = f32::MAX as f64 * 1.01;

/// Characters that no number of a record exceeds.
const LONGEST: usize = 64;

/// Parses `.5`, `5.`, `1.0D-03`, `1.234-103`; refuses NaN, infinities, Fortran
/// overflow, decimal commas and values that stand for missing, with the reason.
pub(crate) fn parse(field: &[u8]) -> Result<f64, String> {
    let plain = field.trim_ascii();
    if plain.len() > LONGEST {
        return Err(not_a_number(plain));
    }
    let simple = |b: &u8| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'e' | b'E');
    if plain.iter().all(simple)
        && let Ok(text) = std::str::from_utf8(plain)
        && let Ok(value) = text.parse::<f64>()
    {
        return present(value, plain);
    }
    spelled(plain)
}

/// Numbers that Rust does not take as they stand.
fn spelled(plain: &[u8]) -> Result<f64, String> {
    let shown = shown(plain);
    if plain.is_empty() {
        return Err("a value is missing: the field is blank".to_owned());
    }
    if let Some((count, value)) = repeated(plain) {
        return Err(format!(
            "\"{shown}\" is a repeat count of Fortran, {count} times {value}, which is not read: the values must be written out"
        ));
    }
    if plain.contains(&b'*') {
        return Err(format!(
            "\"{shown}\" is a Fortran overflow: the value did not fit its field"
        ));
    }
    if plain.contains(&b',') {
        return Err(format!("\"{shown}\" has a decimal comma"));
    }
    let minus = "\u{2212}".as_bytes();
    if plain.windows(minus.len()).any(|bytes| bytes == minus) {
        let text = String::from_utf8_lossy(plain);
        return Err(format!(
            "\"{text}\" is not a number: its sign is U+2212, not the hyphen"
        ));
    }
    let fortran =
        |b: &u8| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'e' | b'E' | b'd' | b'D');
    if !plain.iter().all(fortran) {
        return Err(not_a_number(plain));
    }
    let mut normal = String::with_capacity(plain.len() + 1);
    for b in plain {
        normal.push(match b {
            b'd' | b'D' | b'E' => 'e',
            other => char::from(*other),
        });
    }
    if touching(plain) {
        return Err(format!(
            "\"{shown}\" is not a number: two numbers touch, or a sign stands within one"
        ));
    }
    if !normal.contains('e')
        && let Some(at) = inner_sign(plain)
    {
        normal.insert(at, 'e');
    }
    let value = normal.parse::<f64>().map_err(|_| not_a_number(plain))?;
    present(value, plain)
}

/// The two numbers of `2*0.5`, as Fortran's list-directed output repeats a value.
fn repeated(plain: &[u8]) -> Option<(&str, &str)> {
    let (count, value) = std::str::from_utf8(plain).ok()?.split_once('*')?;
    let is_count = !count.is_empty() && count.bytes().all(|b| b.is_ascii_digit());
    (is_count && parse(value.as_bytes()).is_ok()).then_some((count, value))
}

/// Where a sign stands within a field, not behind the letter of an exponent: the last one.
fn inner_sign(plain: &[u8]) -> Option<usize> {
    (1..plain.len())
        .rev()
        .find(|i| matches!(plain[*i], b'+' | b'-') && !b"eEdD".contains(&plain[i - 1]))
}

/// Whether a sign stands within a field other than in `1.234-103`: Fortran leaves the letter of
/// the exponent out before exactly three digits, behind a mantissa with a decimal point. Numbers
/// that fill their columns touch, as in `1234-5678`.
pub(crate) fn touching(field: &[u8]) -> bool {
    let plain = field.trim_ascii();
    let Some(at) = inner_sign(plain) else {
        return false;
    };
    let (mantissa, exponent) = (&plain[..at], &plain[at + 1..]);
    let is_mantissa = mantissa.contains(&b'.')
        && inner_sign(mantissa).is_none()
        && !mantissa.iter().any(u8::is_ascii_alphabetic);
    !(is_mantissa && exponent.len() == 3 && exponent.iter().all(u8::is_ascii_digit))
}

fn not_a_number(plain: &[u8]) -> String {
    format!("\"{}\" is not a number", shown(plain))
}

fn present(value: f64, plain: &[u8]) -> Result<f64, String> {
    if !(value.abs() <= LARGEST_MISSING) {
        Err(format!("\"{}\" is too large", shown(plain)))
    } else if value.abs() > MISSING {
        Err(format!(
            "\"{}\" stands for a value that is missing",
            shown(plain)
        ))
    } else if value == 0.0 && !is_zero(plain) {
        Err(format!(
            "\"{}\" is not zero, but its exponent makes it too small to be told from it",
            shown(plain)
        ))
    } else {
        Ok(value)
    }
}

/// Whether no digit of the mantissa is other than zero.
fn is_zero(plain: &[u8]) -> bool {
    let mantissa = plain.split(|b| b"eEdD".contains(b)).next();
    let mantissa = mantissa.unwrap_or_default();
    let mantissa = &mantissa[..inner_sign(mantissa).unwrap_or(mantissa.len())];
    !mantissa.iter().any(|b| (b'1'..=b'9').contains(b))
}

/// Characters of a field that a message shows, and the most bytes of one.
const SHOWN: usize = 24;
const LONGEST_CHARACTER: usize = 4;

/// The field for a message: printable, not long.
pub(crate) fn shown(field: &[u8]) -> String {
    // A line may be as long as the file.
    let start = &field[..field.len().min((SHOWN + 1) * LONGEST_CHARACTER)];
    let of_utf_8 = match std::str::from_utf8(start) {
        Ok(text) => Some(text),
        // Cut within a character.
        Err(e) if e.error_len().is_none() && start.len() < field.len() => {
            std::str::from_utf8(&start[..e.valid_up_to()]).ok()
        }
        Err(_) => None,
    };
    let visible = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    let mut characters: Vec<char> = match of_utf_8 {
        Some(text) => text.chars().map(visible).collect(),
        None => start.iter().map(|b| visible(char::from(*b))).collect(),
    };
    let is_long = characters.len() > SHOWN;
    characters.truncate(SHOWN);
    characters
        .into_iter()
        .chain(is_long.then_some('…'))
        .collect()
}

/// One unit of the last printed digit: 0.01 for `3.25`, 1e-5 for `1.00E-03`.
pub(crate) fn resolution(field: &[u8]) -> f64 {
    10.0_f64.powi(-decimals(field.trim_ascii()))
}

fn whole(digits: &[u8]) -> i32 {
    std::str::from_utf8(digits)
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(0)
}

/// Digits behind the point, less the exponent: 2 for `3.25`, 5 for `1.00E-03`.
pub(crate) fn decimals(plain: &[u8]) -> i32 {
    let mut decimals = 0_i32;
    let mut after_point = false;
    let mut exponent = 0_i32;
    for (i, b) in plain.iter().enumerate() {
        match b {
            b'.' => after_point = true,
            b'0'..=b'9' if after_point => decimals += 1,
            b'e' | b'E' | b'd' | b'D' => {
                exponent = whole(&plain[i + 1..]);
                break;
            }
            // Fortran leaves the letter out before three digits: `1.234-103`.
            b'+' | b'-' if i > 0 => {
                exponent = whole(&plain[i..]);
                break;
            }
            _ => {}
        }
    }
    decimals.min(400) - exponent.clamp(-400, 400)
}

/// The first number in a text, with one unit of its last printed digit.
pub(crate) fn first_in(text: &str) -> Option<(f64, f64)> {
    let part =
        |b: &u8| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+' | b'e' | b'E' | b'd' | b'D');
    text.as_bytes()
        .split(|b| !part(b))
        .filter(|field| field.first().is_some_and(|b| !b.is_ascii_alphabetic()))
        .find_map(|field| {
            // A full stop may touch it: the digits alone count.
            let end = field.iter().rposition(u8::is_ascii_digit)? + 1;
            [field, &field[..end]]
                .into_iter()
                .find_map(|f| Some((parse(f).ok()?, resolution(f))))
        })
}

/// The first number after a key, any case: `MAX = -.200 G` for `max`.
pub(crate) fn after(text: &str, key: &str) -> Option<(f64, f64)> {
    let lower = text.to_ascii_lowercase();
    let at = lower.find(key)? + key.len();
    first_in(text.get(at..)?)
}

/// The number that a header states under a key, any case: `DURATION = 11.435` for `duration`.
/// Nothing but blanks, `=` and `:` may stand between: where the number is blank, the next one is
/// another key's.
pub(crate) fn stated(text: &str, key: &str) -> Option<(f64, f64)> {
    let lower = text.to_ascii_lowercase();
    first_in(number_behind(&lower, key)?)
}

/// What stands behind a key of a text in lower case, where that begins as a number does.
pub(crate) fn number_behind<'t>(lower: &'t str, key: &str) -> Option<&'t str> {
    let at = lower.find(key)? + key.len();
    let rest = lower.get(at..)?.trim_start_matches([' ', '\t', '=', ':']);
    starts_as_number(rest).then_some(rest)
}

fn starts_as_number(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+'))
}

/// The first word of a text that begins with a number, where the word is neither one nor one with its unit: `161.78x`,
/// `-6.x52`.
pub(crate) fn damaged(text: &str) -> Option<&str> {
    const UNITS: [&str; 6] = ["s", "sec", "secs", "second", "seconds", "hz"];
    let text = text.trim_start();
    let word = text.split([' ', '\t', ',', ';', '(', ')']).next()?;
    let has_digit = word.bytes().any(|b| b.is_ascii_digit());
    if !(starts_as_number(word) && has_digit) || parse(word.as_bytes()).is_ok() {
        return None;
    }
    let ends = |c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+'));
    let (number, unit) = word.split_at(word.find(ends).unwrap_or(word.len()));
    let unit = unit.trim_end_matches('.').to_ascii_lowercase();
    let is_unit = UNITS.contains(&unit.as_str()) || SeriesUnit::parse(&unit).is_some();
    let is_number = parse(number.as_bytes()).is_ok();
    (!(is_number && is_unit)).then_some(word)
}

/// The time step (s) of a text such as `equally spaced at .005 sec` or `at 200 pts/sec`,
/// with one unit of its last printed digit: the number after `at` is a step or a rate as
/// its unit says, and nothing without one.
pub(crate) fn time_step(text: &str) -> Option<(f64, f64)> {
    let lower = text.to_ascii_lowercase();
    lower.match_indices("at ").find_map(|(at, key)| {
        let rest = lower[at + key.len()..].trim_start();
        let end = rest
            .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e')))
            .unwrap_or(rest.len());
        let word = rest[..end].trim_end_matches(['e', '-']);
        let unit = rest[word.len()..].trim_start_matches([' ', '-']);
        let printed = word.as_bytes();
        let (value, digit) = (parse(printed).ok()?, resolution(printed));
        if !(value > 0.0) {
            return None;
        }
        let word = unit.split(|c: char| !c.is_ascii_alphabetic()).next()?;
        let mut words = unit.split_whitespace();
        let first = words.next()?;
        let a_second = first.contains("/s")
            || matches!(words.next(), Some("per" | "/"))
                && words.next().is_some_and(|w| w.starts_with('s'));
        match word {
            "s" | "sec" | "secs" | "second" | "seconds" => Some((value, digit)),
            "ms" | "msec" | "msecs" | "millisecond" | "milliseconds" => {
                Some((value * 1.0e-3, digit * 1.0e-3))
            }
            // The digit of a rate is a part of the step.
            "hz" | "hertz" | "sps" => Some((1.0 / value, digit / (value * value))),
            _ if a_second => Some((1.0 / value, digit / (value * value))),
            _ => None,
        }
    })
}

/// What a number without a unit is, where a step or a rate is stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Bare {
    /// A step (s).
    Step,
    /// A rate (Hz).
    Rate,
}

/// The time step (s) of a text in lower case that starts with it, or with a rate: in seconds, in
/// milliseconds, or samples a second by the word behind the number; `None` where no number stands there.
///
/// # Errors
/// Another word, or a decimal comma.
pub(crate) fn step_or_rate(text: &str, bare: Bare) -> Result<Option<f64>, String> {
    let text = text.trim_start();
    let end = text
        .find([' ', ',', ';', '|', '\t', '('])
        .unwrap_or(text.len());
    let (first, behind) = text.split_at(end);
    let digit_follows = behind
        .strip_prefix(',')
        .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    if digit_follows && !first.is_empty() && first.bytes().all(|b| b.is_ascii_digit()) {
        let number = &text[..end + 1 + behind[1..].find([' ', ',']).unwrap_or(behind.len() - 1)];
        return Err(format!("the time step \"{number}\" has a decimal comma"));
    }
    // `100HZ`: the number ends where the word begins. An `e` alone is of the number.
    let glued = first.len()
        - first
            .trim_start_matches(|c: char| !c.is_alphabetic() || "ed".contains(c))
            .len();
    let (number, word) = first.split_at(glued);
    let word = match word {
        "" => behind.trim_start_matches([' ', '\t']),
        word => word,
    };
    // A letter need not be an ASCII one: `20000 \u{b5}s`.
    let ends = |c: char| !(c.is_alphabetic() || c == '/');
    let (word, after) = word.split_at(word.find(ends).unwrap_or(word.len()));
    let Ok(value) = parse(number.as_bytes()) else {
        return Ok(None);
    };
    let plain = match bare {
        Bare::Step => value,
        Bare::Rate => 1.0 / value,
    };
    Ok(Some(match word {
        "hz" | "sps" | "samples/s" | "samples/sec" | "points/sec" => 1.0 / value,
        "ms" | "msec" | "milliseconds" => 1.0e-3 * value,
        "s" | "sec" | "secs" | "second" | "seconds" => value,
        "" => plain,
        // The next key.
        _ if after.trim_start().starts_with('=') => plain,
        _ => {
            let word = word.to_ascii_uppercase();
            return Err(format!("\"{word}\" is not a unit of a time step"));
        }
    }))
}

/// The time steps (s) of the sampling rates in a text, with one unit of their last printed
/// digit: `200 samples/sec`, `100 pts/sec`, `200 sps`; in a text on sampling `200 Hz` and
/// `200/sec` as well, unless the words before it are of a filter or an instrument.
pub(crate) fn rates(text: &str) -> Vec<(f64, f64)> {
    let lower = text.to_ascii_lowercase();
    let on_sampling = lower.contains("sampl");
    let number = |c: char| c.is_ascii_digit() || c == '.';
    let mut found = Vec::new();
    let mut rest = lower.as_str();
    // What stands between the number before that has a unit and this one.
    let mut words = " ".to_owned();
    while let Some(start) = rest.find(number) {
        words.push_str(&rest[..start]);
        let end = rest[start..]
            .find(|c| !number(c))
            .map_or(rest.len(), |n| start + n);
        let printed = rest[start..end].trim_end_matches('.').as_bytes();
        rest = &rest[end..];
        let unit = rest.trim_start();
        let counts = ["samples", "sample", "pts", "points"];
        let per = counts
            .iter()
            .find_map(|word| unit.strip_prefix(word))
            .map(|after| after.trim_start_matches([' ', '.']))
            .is_some_and(|after| {
                ["/s", "/ s", "per s", "a second"]
                    .iter()
                    .any(|p| after.starts_with(p))
            });
        let hertz = unit.starts_with("hz") || unit.starts_with("/s");
        let of_filter = is_of_filter(&words);
        let plain = on_sampling && hertz && !of_filter;
        if hertz || per {
            words.clear();
        }
        if !(per || plain || unit.starts_with("sps")) {
            continue;
        }
        if let Ok(rate) = parse(printed)
            && rate > 0.0
        {
            found.push((1.0 / rate, resolution(printed) / (rate * rate)));
        }
    }
    found
}

/// Whether a word right before one on sampling says that this is of a filter: `filter sampling rate`.
pub(crate) fn is_word_of_filter(word: &str) -> bool {
    const WORDS: [&str; 6] = ["filter", "corner", "cutoff", "cut-off", "notch", "nyquist"];
    WORDS.contains(&word) || word.ends_with("pass")
}

/// Whether the words before a rate are of a filter or of the instrument rather than of sampling.
fn is_of_filter(words: &str) -> bool {
    const OF_FILTERS: [&str; 9] = [
        " filter",
        "corner",
        "cut",
        "natural",
        "pass",
        "nyquist",
        "alias",
        "corte",
        "bandwidth",
    ];
    const OF_INSTRUMENTS: [&str; 6] = [
        "frequency of instrument",
        "frequency of the instrument",
        "frequency of sensor",
        "frequency of the sensor",
        "instrument frequency",
        "sensor frequency",
    ];
    let is_in = |of: &[&str], text: &str| of.iter().any(|word| text.contains(word));
    let Some(last) = words.rfind("sampl") else {
        return is_in(&OF_FILTERS, words) || is_in(&OF_INSTRUMENTS, words);
    };
    // `filtered, resampled at 200 Hz`, but `corner before resampling: 80 Hz`.
    let before = words[..last].trim_end_matches(|c: char| c.is_alphabetic() || c == '-');
    let goes_on = [" of ", " for ", " before "]
        .iter()
        .any(|word| before.ends_with(word))
        && !words[last..].contains(" at ");
    // `Filter sampling 50 Hz` and `Bandpass sampling 0.1-25 Hz` are of the filter; of `resampled` the record is.
    let own = words[last..].starts_with("sampling") && words[..last].ends_with(' ');
    let of_filter = own && {
        let word = words[..last]
            .trim_end()
            .rsplit(' ')
            .next()
            .unwrap_or_default();
        is_word_of_filter(word) && !words[last..].contains(" at ")
    };
    of_filter || is_in(&OF_FILTERS, &words[if goes_on { 0 } else { last }..])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn forms_that_fortran_prints() {
        for (text, value) in [
            (".123", 0.123),
            ("-.5", -0.5),
            ("5.", 5.0),
            ("+1.0E-03", 1e-3),
            ("1.0D-03", 1e-3),
            ("1.234-103", 1.234e-103),
            ("-.5+003", -500.0),
            ("-2.2223E+0", -2.2223),
            ("0.0000000e+000", 0.0),
            (" -0.0 ", 0.0),
        ] {
            assert_eq!(parse(text.as_bytes()).unwrap(), value, "{text}");
        }
        for text in [
            "NaN",
            "inf",
            "-Infinity",
            "********",
            "0,5",
            "",
            "1.7E+38",
            "1e999",
            "--1",
            "1e",
            "1234-5678",
            "50-3",
            "100-5",
            "100-500",
            "1.5-12",
            "1.5-1234",
            "1.5E-03-103",
            "1.5-103-104",
            "-12-345",
        ] {
            assert!(parse(text.as_bytes()).is_err(), "{text}");
        }
    }

    #[test]
    fn what_is_too_large_is_not_missing() {
        for (text, told) in [
            ("1.70141E+38", "stands for a value that is missing"),
            ("-3.4028235e38", "stands for a value that is missing"),
            ("2.96e199", "is too large"),
            ("1e999", "is too large"),
        ] {
            assert!(parse(text.as_bytes()).unwrap_err().contains(told), "{text}");
        }
    }

    /// No number that is not zero is read as zero.
    #[test]
    fn what_is_too_small_is_not_zero() {
        for text in [
            "-0.00074489-959",
            "258.27-838",
            "258.27E-400",
            "0.1E-330",
            "2.5D-999",
            "1e-99999999999999999999",
            "-7.501000E-402",
        ] {
            let error = parse(text.as_bytes()).unwrap_err();
            assert!(error.contains("is not zero"), "{error}");
        }
        for text in ["0", "-0.0", "0.000E-999", "-.00D+25", "0.000-959", "0e-7"] {
            assert_eq!(parse(text.as_bytes()).unwrap(), 0.0, "{text}");
        }
        // Numbers below the least normal one stay as they are.
        for (text, value) in [("4.9E-324", 5e-324), ("1.234-310", 1.234e-310)] {
            assert_eq!(parse(text.as_bytes()).unwrap(), value, "{text}");
        }
    }

    #[test]
    fn printed_digits() {
        for (text, unit) in [
            ("3.25", 1e-2),
            ("1.00E-03", 1e-5),
            ("12", 1.0),
            (".020", 1e-3),
            ("-1.234-003", 1e-6),
        ] {
            assert!(
                (resolution(text.as_bytes()) / unit - 1.0).abs() < 1e-12,
                "{text}"
            );
        }
        assert_eq!(
            after("MAX  =  -.200 G, AT  11.576 SEC.", "max").unwrap().0,
            -0.2
        );
        assert_eq!(
            after("MAX  =  -.200 G, AT  11.576 SEC.", " at ").unwrap().0,
            11.576
        );
        assert_eq!(first_in("at 100 Samples/sec").unwrap().0, 100.0);
    }

    #[test]
    fn numbers_of_headers_that_are_damaged() {
        for text in [
            "161.78x",
            " 13.20x332 ",
            "0.00x s",
            "2394.x mm/s/s",
            "-6.x52 cm/sec2",
        ] {
            let word = text.split_whitespace().next();
            assert_eq!(damaged(text), word, "{text}");
        }
        for text in [
            "161.78",
            "2394. mm/s/s",
            ".005sec.",
            "-.200G, at",
            "13.2cm/s2",
            "at 5",
            "",
            "-",
            "(N-S) 5x",
        ] {
            assert_eq!(damaged(text), None, "{text}");
        }
    }

    #[test]
    fn rates_of_sampling() {
        for (text, rate) in [
            ("RECORD LENGTH = 60.000 SEC   AT 200 SAMPLES/SEC", 200.0),
            (
                " 31932 Accelerogram points at 100 pts/sec in units of g.",
                100.0,
            ),
            ("at 62.5 samples per second", 62.5),
            ("SAMPLING RATE = 50 HZ", 50.0),
            ("recorded at 200sps.", 200.0),
        ] {
            let found = rates(text);
            assert_eq!(found.len(), 1, "{text}");
            assert!((found[0].0 * rate - 1.0).abs() < 1e-12, "{text}: {found:?}");
        }
        for text in [
            "12001 POINTS OF ACCEL DATA EQUALLY SPACED AT .005 SEC.",
            "MAX  =   .058 G, AT   9.425 SEC.",
            "BAND-PASS FILTERED BETWEEN  .050 AND 25.00 HZ",
            "SENSITIVITY = 1.26  V/G.",
            "0 samples/sec",
        ] {
            assert_eq!(rates(text), [], "{text}");
        }
    }

    #[test]
    fn steps_and_rates_by_their_units() {
        for (text, step) in [
            (
                "12001 POINTS OF ACCEL DATA EQUALLY SPACED AT .005 SEC.  (UNITS: G)",
                0.005,
            ),
            (
                "2674 POINTS OF ACC DATA EQUALLY SPACED AT   .020 SEC.",
                0.02,
            ),
            ("equally spaced at 5 ms", 0.005),
            ("equally spaced at 5 msec intervals", 0.005),
            (
                " 31932 Accelerogram points at 100 pts/sec in units of g. Format: (8f9.6)",
                0.01,
            ),
            ("RECORD LENGTH = 60.000 SEC   AT 200 SAMPLES/SEC", 0.005),
            ("at 250 samples per second", 0.004),
            (
                "points of accel data equally spaced at 0.010 sec in cm/sec/sec",
                0.01,
            ),
            ("peak at the roof, sampled at 50 Hz", 0.02),
            ("at 200sps", 0.005),
        ] {
            let found = time_step(text).unwrap().0;
            assert!((found / step - 1.0).abs() < 1e-12, "{text}: {found}");
        }
        for text in [
            "at .005",
            "at 200 points",
            "at -1 sec",
            "at 0 sec",
            "11999 points",
            "at g",
        ] {
            assert_eq!(time_step(text), None, "{text}");
        }
    }
}
