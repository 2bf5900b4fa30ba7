//! Keys of header lines in the spellings of those who write them, and what they are of: `Time-step: 0.01 s`, `Samples 300`.

use crate::number;

/// Ends of keys of a time step.
const STEPS: [&str; 13] = [
    "dt",
    "delta t",
    "deltat",
    "\u{3b4}t",
    "time step",
    "timestep",
    "time interval",
    "sampling interval",
    "sample interval",
    "sampling period",
    "sampling step",
    "sampling time",
    "sample period",
];
/// Ends of keys of a rate.
const RATES: [&str; 8] = [
    "fs",
    "sampling rate",
    "sample rate",
    "sampling frequency",
    "sampling freq",
    "sample frequency",
    "samples per second",
    "sps",
];
/// Keys of a count.
const COUNTS: [&str; 11] = [
    "npts",
    "count",
    "ndata",
    "nsamples",
    "npoints",
    "samples",
    "points",
    "values",
    "data",
    "data points",
    "sample count",
];
/// Words between `number` and what is counted.
const OF_ALL: [&str; 7] = ["of", "the", "data", "total", "acceleration", "acc", "accel"];
/// Keys of a rate, unless it is of something slow.
const FREQUENCIES: [&str; 3] = ["frequency", "freq", "frecuencia"];
/// Keys of a length of the record.
const DURATIONS: [&str; 6] = [
    "duration",
    "total duration",
    "record duration",
    "duration of record",
    "record length",
    "length of record",
];
/// Keys of a largest acceleration.
const PEAKS: [&str; 10] = [
    "pga",
    "peak acceleration",
    "peak acc",
    "peak accel",
    "peak ground acceleration",
    "max acceleration",
    "max acc",
    "maximum acceleration",
    "maximum acc",
    "peak value",
];
/// Keys of what the values are.
const QUANTITIES: [&str; 7] = [
    "type",
    "data type",
    "quantity",
    "record type",
    "series type",
    "signal type",
    "kind",
];
/// Keys of a factor of the values.
const FACTORS: [&str; 11] = [
    "scale",
    "scale factor",
    "scaling",
    "scaling factor",
    "factor",
    "multiplier",
    "multiply by",
    "conversion factor",
    "calibration factor",
    "amplitude factor",
    "gain",
];
/// Keys of a unit.
const UNITS: [&str; 10] = [
    "unit",
    "units",
    "unidad",
    "unidades",
    "einheit",
    "einheiten",
    "unita",
    "unit\u{e0}",
    "unit\u{e9}",
    "unit\u{e9}s",
];
/// Words beside a key of the unit of the values.
const OF_VALUES: [&str; 14] = [
    "data",
    "value",
    "values",
    "y",
    "axis",
    "ordinate",
    "amplitude",
    "amplitudes",
    "of",
    "de",
    "the",
    "measure",
    "medida",
    "aceleraci\u{f3}n",
];

/// Words of keys that speak of the record before it was processed.
const OF_ANOTHER: [&str; 5] = ["original", "raw", "initial", "former", "native"];

/// What stands under a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Meaning {
    /// A time step, or a rate by its unit.
    Step,
    /// A rate of sampling.
    Rate,
    /// A rate of sampling, or of something else.
    Frequency,
    /// The number of values.
    Count,
    /// The length of the record.
    Duration,
    /// The largest acceleration.
    Peak,
    /// What the values are.
    Quantity,
    /// A factor of the values.
    Factor,
}

/// A key with what stands behind it to the end of the line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Entry<'t> {
    pub key: &'t str,
    pub value: &'t str,
    /// Whether a colon or a sign of equality parts them; else a blank does.
    parted: bool,
}

impl<'t> Entry<'t> {
    /// The number that the value starts with, with its digits and the word behind it. A comma within it is
    /// a decimal one unless three digits follow, which may be a group of them.
    pub(crate) fn number(&self) -> Option<(f64, &'t str, &'t str)> {
        let (digits, unit) = split_number(self.value);
        let digit = |text: &str| text.starts_with(|c: char| c.is_ascii_digit());
        let behind = self.value[digits.len()..].strip_prefix(',');
        let Some(decimals) = behind.filter(|rest| digit(rest)) else {
            return Some((number::parse(digits.as_bytes()).ok()?, digits, unit));
        };
        let (fraction, unit) = split_number(decimals);
        let whole = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
        if fraction.len() == 3 || !whole(fraction) || digits.contains('.') {
            return None;
        }
        let all = &self.value[..digits.len() + 1 + fraction.len()];
        let value = number::parse(all.replace(',', ".").as_bytes()).ok()?;
        Some((value, all, unit))
    }

    /// The words of the key, without what stands in brackets behind them.
    fn words(&self) -> String {
        let before = self.key.split(['(', '[']).next().unwrap_or_default();
        before.trim_end().replace(['-', '_'], " ")
    }

    /// Whether a number stands under the key.
    pub(crate) fn has_number(&self) -> bool {
        self.value
            .starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+'))
    }
}

/// Whether the key of an entry is that of a rate of sampling, of this record or of the one before it was
/// processed.
pub(crate) fn is_of_rate(entry: &Entry<'_>) -> bool {
    let plain = entry.words();
    entry.parted && RATES.iter().any(|key| ends_in(&plain, key))
}

/// What follows the words of a rate of sampling in a line in lower case, `200, cutoff 80 hz`.
pub(crate) fn behind_rate(lower: &str) -> Option<&str> {
    let words = RATES.iter().filter(|key| key.contains(' '));
    words
        .filter_map(|key| Some(&lower[lower.find(key)? + key.len()..]))
        .min_by_key(|rest| rest.len())
}

/// What stands under the key of an entry, if that is known.
pub(crate) fn meaning(entry: &Entry<'_>) -> Option<Meaning> {
    let plain = entry.words();
    let plain = plain.as_str();
    // `Original dt` is that of another record.
    if plain.split(' ').any(|word| OF_ANOTHER.contains(&word)) {
        return None;
    }
    let is = |keys: &[&str]| keys.contains(&plain);
    // Behind a blank, a line of words may end in the key.
    let ends = |keys: &[&str]| match entry.parted {
        true => keys.iter().any(|k| ends_in(plain, k)),
        false => is(keys),
    };
    Some(if ends(&STEPS) {
        Meaning::Step
    } else if ends(&RATES) {
        Meaning::Rate
    } else if is(&FREQUENCIES) {
        Meaning::Frequency
    } else if is_count(plain) {
        Meaning::Count
    } else if is(&DURATIONS) {
        Meaning::Duration
    } else if is(&PEAKS) {
        Meaning::Peak
    } else if is(&QUANTITIES) {
        Meaning::Quantity
    } else if is(&FACTORS) {
        Meaning::Factor
    } else {
        return None;
    })
}

/// Whether a key is that of the unit of the values: `units`, `acceleration unit`, `y-unit`,
/// `unidad de medida`.
pub(crate) fn unit_words(key: &str) -> bool {
    let mut words: Vec<&str> = key
        .split([' ', '\t', '-', '_'])
        .filter(|w| !w.is_empty())
        .collect();
    let Some(at) = words.iter().position(|w| UNITS.contains(w)) else {
        return false;
    };
    words.remove(at);
    words
        .iter()
        .all(|w| w.starts_with("accel") || *w == "acc" || OF_VALUES.contains(w))
}

/// The keys of a line in lower case with what stands behind their colon or sign of equality; where
/// it has none, the words before a number at its end.
pub(crate) fn keyed(lower: &str) -> Vec<Entry<'_>> {
    let mut found = Vec::new();
    if !lower.contains([':', '=']) {
        found.extend(before_a_number(lower));
        return found;
    }
    let mut from = 0;
    for (at, _) in lower.match_indices([':', '=']) {
        let key = lower[from..at].trim();
        // The key is what follows the last separator or number.
        let start = key.rfind([',', ';', '\t']).map_or(0, |n| n + 1);
        let key = behind_value(&key[start..]);
        let key = key.trim_start_matches(|c: char| !c.is_alphanumeric());
        found.push(Entry {
            key,
            value: lower[at + 1..].trim_start(),
            parted: true,
        });
        from = at + 1;
    }
    found
}

/// The key behind the value of the one before it, where blanks alone part them: `duration` of `.005
/// sec duration`.
fn behind_value(text: &str) -> &str {
    let number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+');
    let text = text.trim_start();
    if !text.starts_with(number) {
        return text;
    }
    let rest = text.trim_start_matches(number).trim_start();
    let units = ["s", "sec", "secs", "ms", "msec", "hz", "sps", "g", "gal"];
    match rest.split_once([' ', '\t']) {
        Some((unit, key)) if units.contains(&unit.trim_end_matches('.')) => key.trim_start(),
        _ => rest,
    }
}

/// Words with the number, and at most its unit, that end a line: `samples 300`, `dt 0.01 s`.
fn before_a_number(lower: &str) -> Option<Entry<'_>> {
    let bare = lower
        .trim_start_matches(|c: char| !c.is_alphanumeric())
        .trim();
    let starts =
        |rest: &str| rest.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+'));
    let mut blanks = bare.match_indices([' ', '\t']);
    let (at, _) = blanks.find(|(at, _)| starts(&bare[at + 1..]))?;
    let (key, value) = (bare[..at].trim_end(), bare[at..].trim_start());
    let words = |c: char| c.is_alphabetic() || " _-()[]./".contains(c);
    (key.chars().all(words) && value.split_whitespace().count() <= 2).then_some(Entry {
        key,
        value,
        parted: false,
    })
}

/// A number at the start of a text, and the word behind it.
fn split_number(text: &str) -> (&str, &str) {
    let number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+');
    let mut end = text.find(|c| !number(c)).unwrap_or(text.len());
    // An exponent.
    let rest = &text[end..];
    if end > 0
        && let Some(exponent) = rest.strip_prefix(['e', 'd'])
        && exponent.starts_with(number)
    {
        end += 1 + exponent.find(|c| !number(c)).unwrap_or(exponent.len());
    }
    let behind = text[end..].trim_start().trim_start_matches(['(', '[']);
    let word = behind
        .split([' ', '\t', ',', ';', ')', ']'])
        .next()
        .unwrap_or_default();
    (
        text[..end].trim_end_matches('.'),
        word.trim_end_matches('.'),
    )
}

/// Whether a key is that of the count of all values: `npts`, `number of data points`.
fn is_count(key: &str) -> bool {
    if ends_in(key, "npts") {
        return true;
    }
    let mut words: Vec<&str> = key
        .split([' ', '.', '_'])
        .filter(|w| !w.is_empty())
        .collect();
    if words
        .first()
        .is_some_and(|w| ["number", "no", "num", "nr"].contains(w))
    {
        words.remove(0);
        let of = words.iter().take_while(|w| OF_ALL.contains(w)).count();
        words.drain(..of.min(words.len().saturating_sub(1)));
        return words.len() == 1 && COUNTS.contains(&words[0]);
    }
    COUNTS.contains(&words.join(" ").as_str()) && key != "data" && key != "values"
}

/// Whether a text ends in a key as a word of its own.
fn ends_in(text: &str, key: &str) -> bool {
    text.strip_suffix(key)
        .is_some_and(|before| !before.ends_with(|c: char| c.is_alphanumeric()))
}
