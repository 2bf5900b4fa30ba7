//! Keys of header lines in the spellings of those who write them, and what they are of: `Time-step: 0.01 s`, `Samples 300`.

use std::borrow::Cow;

use crate::number;
use crate::quantity::{Quantity, SeriesUnit};
use crate::text::in_brackets;

mod words;

use words::{
    AMPLIFICATIONS, AND_SECONDS, ARE_GIVEN, BEFORE_DECIMATIONS, BEFORE_DIVISORS, BEFORE_FACTORS,
    BEFORE_NUMBERS, BEFORE_VALUES, CHANGED, CHANGES, COUNTS, DURATIONS, FACTORS, FREQUENCIES,
    GRAVITIES, HEADINGS, HERTZ, LAST_UNITS, NUMBERS_OF, OF_ALL, OF_ANOTHER, OF_VALUES, PEAKS,
    QUANTITIES, RATES, STEPS, STEPS_BY_UNIT, UNITS, UNITS_OF, VALUES_THEMSELVES,
};

/// What stands under a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Meaning {
    /// A time step, or a rate by its unit.
    Step,
    /// A time step where its unit is one of time.
    StepByUnit,
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
    /// Whether a colon, a sign of equality or a separator of columns parts them; else a blank does.
    parted: bool,
}

impl<'t> Entry<'t> {
    /// The number that the value starts with, with its digits and the word behind it. A comma within it is
    /// a decimal one unless three digits follow, which may be a group of them.
    pub(crate) fn number(&self) -> Option<(f64, &'t str, &'t str)> {
        let (digits, unit) = split_number(self.value);
        let digit = |text: &str| text.starts_with(|c: char| c.is_ascii_digit());
        let behind = &self.value[digits.len()..];
        if let Some(rest) = behind.strip_prefix('/').filter(|rest| digit(rest)) {
            // `1/100 s`; two strokes are those of a date.
            let (divisor, unit) = split_number(rest);
            let all = &self.value[..digits.len() + 1 + divisor.len()];
            let quotient =
                number::parse(digits.as_bytes()).ok()? / number::parse(divisor.as_bytes()).ok()?;
            let is_date = self.value[all.len()..].starts_with('/');
            return (!is_date).then_some((quotient, all, unit));
        }
        let Some(decimals) = behind.strip_prefix(',').filter(|rest| digit(rest)) else {
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

    /// The words of the key, without the unit of its value.
    fn words(&self) -> String {
        let before = self.key.split(['(', '[']).next().unwrap_or_default();
        let before = before.trim_matches(['"', '\'', ' ']);
        let plain = without_marks(before).replace(['-', '_'], " ");
        match last_unit(&plain) {
            Some(unit) => plain[..plain.len() - unit.len()]
                .trim_end_matches([' ', ',', '/'])
                .to_owned(),
            None => plain,
        }
    }

    /// The unit of the value that the key has in brackets or as its last word: `dt (s)`, `timestep_s`.
    pub(crate) fn unit_of_key(&self) -> Option<String> {
        let bracket = self.key.replace('[', "(").replace(']', ")");
        if let Some(inside) = in_brackets(&bracket) {
            return Some(inside.trim().to_owned());
        }
        let plain = self.key.replace(['-', '_'], " ");
        last_unit(&plain).map(str::to_owned)
    }

    /// Whether another key follows on the line.
    pub(crate) fn is_followed(&self) -> bool {
        self.value.contains([':', '='])
    }

    /// The number behind ` at ` behind the first one, with its digits: `-16.986   AT   27.06 SEC`.
    pub(crate) fn time(&self) -> Option<(f64, &'t str)> {
        let (digits, _) = split_number(self.value);
        let behind = self.value[digits.len()..].trim_start();
        // A unit may stand between them.
        let at = behind.strip_prefix("at ").or_else(|| {
            let (unit, rest) = behind.split_once([' ', '\t'])?;
            let rest = rest.trim_start().strip_prefix("at ")?;
            (!unit.contains([':', '='])).then_some(rest)
        })?;
        let (time, _) = split_number(at.trim_start());
        Some((number::parse(time.as_bytes()).ok()?, time))
    }

    /// Whether the key is one of times: `@ Time (sec)`.
    pub(crate) fn is_of_time(&self) -> bool {
        ["time", "at time"].contains(&self.words().as_str())
    }

    /// Whether the key says that its value is a largest one, but not of what.
    pub(crate) fn is_of_peak(&self) -> bool {
        self.words() == "peak"
    }

    /// Whether a number stands under the key.
    pub(crate) fn has_number(&self) -> bool {
        self.value
            .starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+'))
    }
}

/// Whether a word behind a rate is its unit, or none stands there.
pub(crate) fn is_rate_unit(unit: &str) -> bool {
    HERTZ.contains(&unit)
}

/// Whether the key of an entry is that of a rate of sampling, of this record or of the one before it was
/// processed.
pub(crate) fn is_of_rate(entry: &Entry<'_>) -> bool {
    let plain = entry.words();
    let named = |key: &str| ends_in(&plain, key) || key.contains(' ') && plain.contains(key);
    entry.parted && RATES.iter().any(|key| named(key))
}

/// Rate (Hz) below which a frequency is none of sampling.
const LEAST_RATE: f64 = 20.0;

/// The rate (Hz) that a line in lower case states alone, `rate: 100 hz`, `frequency (hz): 100`, and whether it is called
/// a rate: a frequency may be of something else.
pub(crate) fn lone_rate(lower: &str) -> Option<(f64, bool)> {
    let entries = keyed(lower);
    let [entry] = entries.as_slice() else {
        return None;
    };
    let (found, digits, behind) = entry.number()?;
    let inside = entry.unit_of_key();
    let inside = inside.as_deref();
    let unit = match behind {
        "" => inside.unwrap_or_default(),
        unit => unit,
    };
    let rest = entry.value[digits.len()..].trim();
    let is_bare = rest.is_empty() || rest.trim_matches(['(', ')', '[', ']', '.']) == behind;
    // `Low-pass filter, frequency = 25 Hz`, `Frequency (natural): 50 Hz`, `Rate: 5`.
    let first = lower.trim_start_matches(|c: char| !c.is_alphanumeric());
    let is_rate = entry.words() == "rate";
    let is_own = meaning(entry) == Some(Meaning::Frequency)
        && first.starts_with(entry.key)
        && inside.is_none_or(is_rate_unit)
        && !(is_rate && unit.is_empty());
    (is_own && is_bare && is_rate_unit(unit) && found >= LEAST_RATE).then_some((found, is_rate))
}

/// The rate (Hz) that a text in lower case is, `100 sps`, with nothing else.
pub(crate) fn bare_rate(lower: &str) -> Option<f64> {
    let bare = lower.trim();
    let digits = bare.find(|c: char| !(c.is_ascii_digit() || c == '.'))?;
    let (number, unit) = bare.split_at(digits);
    let rate = number::parse(number.as_bytes()).ok()?;
    let unit = unit.trim();
    (!unit.is_empty() && is_rate_unit(unit) && rate >= LEAST_RATE).then_some(rate)
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
    let is = |keys: &[&str]| keys.contains(&plain);
    // `Max. acceleration`, of which no word is of another record.
    let words: Vec<&str> = plain.split([' ', '.']).filter(|w| !w.is_empty()).collect();
    if PEAKS.contains(&words.join(" ").as_str()) {
        return Some(Meaning::Peak);
    }
    // `Original dt` is that of another record.
    if is_of_another(entry.key) {
        return None;
    }
    // Behind a blank, a line of words may end in the key.
    let ends = |keys: &[&str]| match entry.parted {
        true => keys.iter().any(|k| ends_in(plain, k)),
        false => is(keys),
    };
    Some(if ends(&STEPS) {
        Meaning::Step
    } else if entry.parted && is(&STEPS_BY_UNIT) {
        Meaning::StepByUnit
    } else if ends(&RATES) {
        // `Filter sampling rate` is none of the record.
        let own = RATES.iter().find_map(|key| {
            let before = plain.strip_suffix(key)?;
            let word = before.split_whitespace().next_back().unwrap_or_default();
            Some(!number::is_word_of_filter(word))
        });
        return own.unwrap_or(true).then_some(Meaning::Rate);
    } else if is(&FREQUENCIES) {
        Meaning::Frequency
    } else if is_count(plain) {
        Meaning::Count
    } else if is(&DURATIONS) {
        Meaning::Duration
    } else if is(&QUANTITIES) {
        Meaning::Quantity
    } else if is(&FACTORS) {
        Meaning::Factor
    } else {
        return None;
    })
}

/// Whether words of a key speak of the record before it was processed, or of something else.
pub(crate) fn is_of_another(key: &str) -> bool {
    let plain = without_marks(key);
    let mut words = plain.split(|c: char| !c.is_alphanumeric());
    words.any(|word| OF_ANOTHER.contains(&word))
}

/// The factors of the values, other than one, that a line in lower case states: under keys, in a part of the
/// line, `npts= 300, scale factor 0.5`, or in words, `values multiplied by 1000`.
pub(crate) fn factors(lower: &str) -> Vec<f64> {
    let lower = &powers_of_ten(lower);
    let stated = |entries: Vec<Entry<'_>>| -> Vec<f64> {
        let of_factor = |entry: &&Entry<'_>| meaning(entry) == Some(Meaning::Factor);
        let found = entries.iter().filter(of_factor);
        found.filter_map(|e| Some(e.number()?.0)).collect()
    };
    let mut found = stated(keyed(lower));
    found.extend(amplification(lower));
    if found.is_empty() {
        let parts = lower.split(SEPARATORS);
        let parts = parts.filter(|part| !part.contains([':', '=']));
        found = parts.flat_map(|part| stated(keyed(part))).collect();
    }
    if found.is_empty() {
        let inverse = number_behind(lower, &BEFORE_DIVISORS).map(|divisor| 1.0 / divisor);
        let factor = number_behind(lower, &BEFORE_FACTORS).or(inverse);
        found.extend(factor.or_else(|| change_in_words(lower)));
    }
    found.retain(|factor| *factor != 1.0 && factor.is_finite());
    found
}

/// The line with powers of ten, `10^-3`, `10**-3` and `10^(-3)`, as numbers, `1e-3`. Those that no record is multiplied
/// by, and exponents that are no whole numbers, stay.
fn powers_of_ten(lower: &str) -> Cow<'_, str> {
    let mut line = Cow::Borrowed(lower);
    for mark in ["10^", "10**"] {
        let mut from = 0;
        while let Some(at) = line[from..].find(mark).map(|at| from + at) {
            let (before, behind) = (&line[..at], &line[at + mark.len()..]);
            let bare = behind.strip_prefix('(').unwrap_or(behind);
            let sign = usize::from(bare.starts_with(['-', '+']));
            let digits = bare[sign..].bytes().take_while(u8::is_ascii_digit).count();
            let (exponent, rest) = bare.split_at(sign + digits);
            let rest = match bare.len() < behind.len() {
                true => rest.strip_prefix(')').unwrap_or(rest),
                false => rest,
            };
            let ends = |text: &str, of: fn(char) -> bool| text.chars().next_back().is_some_and(of);
            let part_of_number = |c: char| c.is_ascii_digit() || c == '.';
            let is_whole = (1..=LONGEST_EXPONENT).contains(&digits)
                && !(rest.starts_with('.') && rest[1..].starts_with(|c: char| c.is_ascii_digit()));
            if !is_whole || ends(before, part_of_number) {
                from = at + mark.len();
                continue;
            }
            // `2*10^-3`, `2 x 10^-3`.
            let mantissa = before.trim_end().strip_suffix(['*', 'x']);
            let mantissa = mantissa
                .map(str::trim_end)
                .filter(|m| ends(m, part_of_number));
            let number = match mantissa {
                Some(mantissa) => format!("{mantissa}e{exponent}"),
                None => format!("{before}1e{exponent}"),
            };
            from = number.len();
            line = Cow::Owned(number + rest);
        }
    }
    line
}

/// Digits of the exponent of a power of ten at most.
const LONGEST_EXPONENT: usize = 2;

/// The amplification that a line in lower case states, and nothing else: with other words it may be that of an instrument
/// or a site, `magnification: 1000 (instrument)`.
fn amplification(lower: &str) -> Option<f64> {
    let entries = keyed(lower);
    let [entry] = entries.as_slice() else {
        return None;
    };
    let first = lower.trim_start_matches(|c: char| !c.is_alphanumeric());
    let (found, digits, _) = entry.number()?;
    let rest = entry.value[digits.len()..].trim_matches([' ', '\t', '.']);
    let is_alone = AMPLIFICATIONS.contains(&entry.key) && first.starts_with(entry.key);
    (is_alone && rest.is_empty()).then_some(found)
}

/// The factor of a change of the values in words: `divide values by 10 to get g`, `scale the values by 0.1`.
/// Where none of its words says what is changed, words behind the number may: `scale by 2 the time`.
fn change_in_words(lower: &str) -> Option<f64> {
    let words: Vec<&str> = lower.split_whitespace().collect();
    let change = |(i, word): (usize, &&str)| {
        let word = word.trim_matches(|c: char| !c.is_alphabetic());
        let (_, divides) = CHANGES.iter().find(|(change, _)| *change == word)?;
        let behind = words[i + 1..].iter();
        let is_of_values = words.get(i + 1).is_some_and(|word| CHANGED.contains(word));
        let behind = behind.skip_while(|word| CHANGED.contains(*word));
        let behind = behind.copied().collect::<Vec<_>>();
        let number = behind
            .iter()
            .position(|word| number::first_in(word).is_some())?;
        let next = behind.get(number + 1);
        if !is_of_values && next.is_some_and(|word| !["to", "for"].contains(word)) {
            return None;
        }
        let rest = behind.join(" ");
        let number = rest
            .strip_prefix("by ")
            .and_then(|_| number_behind(&rest, &["by "]))?;
        Some(if *divides { 1.0 / number } else { number })
    };
    words.iter().enumerate().find_map(change)
}

/// The g (m/s2) that a line in lower case states: as its key, `g = 9.81`, `gravity: 981 cm/s2`, or in brackets behind a
/// unit, `g (1 g = 9.81 m/s2)`. Behind other words, `max value in g: 9.75`, a number is of something else.
pub(crate) fn gravity(lower: &str) -> Option<f64> {
    let behind_key = |text: &str, keys: &[&str]| {
        let (key, value) = text.split_once(['=', ':'])?;
        let key = key.trim();
        keys.contains(&key)
            .then(|| gravity_of(value.trim_start()))?
    };
    let bare = lower.trim_start_matches(|c: char| "#%!*/ \t\"".contains(c));
    let in_brackets = || {
        lower.match_indices(['(', '[']).find_map(|(at, _)| {
            let before = lower[..at].trim_end();
            let unit = before.rsplit([' ', '\t', ':', '=', ',']).next()?;
            SeriesUnit::parse(unit)?;
            behind_key(&lower[at + 1..], &GRAVITIES[..3])
        })
    };
    behind_key(bare, &GRAVITIES).or_else(in_brackets)
}

/// The g (m/s2) that a number is, with its unit or without.
fn gravity_of(text: &str) -> Option<f64> {
    let (number, _) = split_number(text);
    let value = number::parse(number.as_bytes()).ok()?;
    let unit = text[number.len()..].trim_start();
    let end = unit.find([' ', ',', ';', ')', ']']).unwrap_or(unit.len());
    let unit = unit[..end].replace("sec", "s").replace(['^', '*'], "");
    match unit.as_str() {
        "" | "m/s2" | "m/s/s" | "m/s\u{b2}" if (9.7..=9.9).contains(&value) => Some(value),
        "" | "cm/s2" | "cm/s/s" | "cm/s\u{b2}" | "gal" if (970.0..=990.0).contains(&value) => {
            Some(0.01 * value)
        }
        _ => None,
    }
}

/// Of how many samples a line in lower case says that one was kept: `decimation factor: 2`, `decimated by 2`.
pub(crate) fn decimation(lower: &str) -> Option<f64> {
    number_behind(lower, &BEFORE_DECIMATIONS).filter(|of| *of > 1.0)
}

/// The number right behind the first words that are followed by one.
fn number_behind(lower: &str, words: &[&str]) -> Option<f64> {
    let number = |word: &&str| {
        let (_, mut rest) = lower.split_once(*word)?;
        while let Some(behind) = BEFORE_NUMBERS.iter().find_map(|w| rest.strip_prefix(w)) {
            rest = behind;
        }
        let unsigned = rest.trim_start_matches(['.', '-', '+']);
        let starts = unsigned.starts_with(|c: char| c.is_ascii_digit());
        let (number, _) = number::first_in(rest).filter(|_| starts)?;
        let percent = rest.trim_start_matches(|c: char| !matches!(c, ' ' | '%'));
        let percent = percent.trim_start().starts_with('%');
        Some(if percent { 0.01 * number } else { number })
    };
    words.iter().find_map(number)
}

/// Whether a key is that of the unit of the values: `units`, `acceleration unit`, `y-unit`,
/// `unidad de medida`.
pub(crate) fn unit_words(key: &str) -> bool {
    let key = without_marks(key);
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

/// What a line in lower case says in words to be the unit of the values, if it says nothing else: `values in units of g`,
/// `data are in cm/s2 (gal)`. A line of more words may be of something else: `data recorded in cm/s2, converted to g`.
pub(crate) fn unit_in_words(lower: &str) -> Option<&str> {
    let bare = lower.trim_matches(|c: char| "#%!*/ \t\"".contains(c));
    let bare = bare.trim_end_matches('.');
    let inside = |ends: (char, char)| bare.strip_prefix(ends.0)?.strip_suffix(ends.1);
    let before = inside(('(', ')')).or_else(|| inside(('[', ']')));
    let before = before.unwrap_or(bare);
    if let Some(unit) = unit_of_acceleration(before) {
        return Some(unit);
    }
    let mut rest = before;
    while let Some(behind) = first_word_of(rest, &BEFORE_VALUES) {
        rest = behind;
    }
    // `data` may be what the values are of.
    let of_units = first_word_of(rest, &["units"]);
    rest = of_units
        .or_else(|| first_word_of(rest, &VALUES_THEMSELVES))
        .or_else(|| first_word_of(before, &VALUES_THEMSELVES))?;
    while let Some(behind) = first_word_of(rest, &ARE_GIVEN) {
        rest = behind;
    }
    rest = first_word_of(rest, &["in", "en", "em"])?;
    unit_alone(rest, of_units.is_some())
}

/// The unit that a sentence on it names, `the unit of acceleration is cm/s2`.
fn unit_of_acceleration(bare: &str) -> Option<&str> {
    let bare = first_word_of(bare, &["the"]).unwrap_or(bare);
    let of = first_word_of(first_word_of(bare, &["unit", "units"])?, &["of"])?;
    let of = first_word_of(of, &["the"]).unwrap_or(of);
    let is = first_word_of(of, &["acceleration", "accelerations"])?;
    unit_alone(first_word_of(is, &["is", "are"])?, true)
}

/// The unit that a text is, if nothing but a remark in brackets, or the unit of the times, follows it.
fn unit_alone(rest: &str, of_units: bool) -> Option<&str> {
    let of = UNITS_OF.iter().find_map(|words| rest.strip_prefix(words));
    let unit = of.unwrap_or(rest).trim();
    // A remark in brackets ends the line.
    let (name, remark) = unit.split_at(unit.find(['(', '[']).unwrap_or(unit.len()));
    let times = AND_SECONDS.iter().find_map(|of| name.strip_suffix(of));
    let (unit, name) = times.map_or((unit, name), |name| (name, name));
    // `units are in cm and seconds` is a system of units.
    if (of_units || times.is_some()) && !is_of_acceleration(name.trim()) {
        return None;
    }
    let is_alone = !name.contains([',', ';', ':', '=', '|', '\t'])
        && (remark.is_empty() || remark.find([')', ']']) == Some(remark.len() - 1));
    Some(unit).filter(|unit| is_alone && !unit.is_empty())
}

/// Whether a text is a unit of acceleration.
fn is_of_acceleration(text: &str) -> bool {
    SeriesUnit::parse(text).is_some_and(|unit| unit.quantity == Quantity::Acceleration)
}

/// What follows the first word of a text, if it is one of these.
fn first_word_of<'t>(text: &'t str, words: &[&str]) -> Option<&'t str> {
    let (word, rest) = text.split_once([' ', '\t'])?;
    let word = without_marks(word);
    words.contains(&word.as_str()).then(|| rest.trim_start())
}

/// The keys of a line in lower case with what stands behind their colon or sign of equality; where
/// it has none, the words before its numbers, or the first of two cells.
pub(crate) fn keyed(lower: &str) -> Vec<Entry<'_>> {
    let mut found = Vec::new();
    if !lower.contains([':', '=']) {
        found.extend(cell_pair(lower));
        if found.is_empty() {
            found = before_numbers(lower);
        }
        return found;
    }
    let mut from = 0;
    for (at, _) in lower.match_indices([':', '=']) {
        let key = lower[from..at].trim();
        // The key is what follows the last separator or number.
        let key = behind_value(&key[start_of_key(key)..]);
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

/// Where the key starts that ends a text: behind the last separator, unless its unit alone follows that, as
/// in `time step, s`.
fn start_of_key(text: &str) -> usize {
    // A sentence may end in brackets: `component (E-W). Acc. in cm/s2 and dt`.
    let sentence = [").", "]."].iter().filter_map(|end| {
        let at = text.rfind(end)? + 1;
        text[at + 1..].starts_with([' ', '\t']).then_some(at)
    });
    let last = text.rfind(SEPARATORS).max(sentence.max());
    let unit = last.filter(|at| LAST_UNITS.contains(&text[at + 1..].trim()));
    let last = unit.map_or(last, |at| text[..at].rfind(SEPARATORS));
    last.map_or(0, |at| at + 1)
}

/// What stands between keys on a line, and between cells.
const SEPARATORS: [char; 4] = [',', ';', '\t', '|'];

/// A key with its value as two cells of a table: `dt,0.01`, `units;g`.
fn cell_pair(lower: &str) -> Option<Entry<'_>> {
    let bare = lower.trim_start_matches(|c: char| !c.is_alphanumeric());
    let separator = SEPARATORS.into_iter().find(|s| bare.contains(*s))?;
    let mut cells = bare.split(separator).map(str::trim);
    let entry = Entry {
        key: cells.next()?,
        value: cells.next()?.trim_matches(['"', '\'']),
        parted: true,
    };
    // Cells that are blank may close the line.
    let alone = cells.all(str::is_empty) && !entry.key.contains(|c: char| c.is_ascii_digit());
    (alone && !entry.key.is_empty() && !entry.value.is_empty()).then_some(entry)
}

/// The key behind the value of the one before it, where blanks alone part them: `duration` of `.005
/// sec duration`.
fn behind_value(text: &str) -> &str {
    let number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+');
    let text = text.trim_start();
    if !text.starts_with(number) {
        // `g factor` of `units=g factor=0.001`.
        return match text.split_once([' ', '\t']) {
            Some(("g" | "gal" | "cm/s2" | "m/s2" | "mg", key)) => key.trim_start(),
            _ => text,
        };
    }
    let rest = text.trim_start_matches(number).trim_start();
    // `-16.9 at 27.06 sec duration`: the time of a value.
    if let Some(time) = rest.strip_prefix("at ").map(str::trim_start)
        && time.starts_with(number)
    {
        return behind_value(time);
    }
    let units = ["s", "sec", "secs", "ms", "msec", "hz", "sps", "g", "gal"];
    match rest.split_once([' ', '\t']) {
        Some((unit, key)) if units.contains(&unit.trim_end_matches('.')) => key.trim_start(),
        _ => rest,
    }
}

/// Words with the number, and at most its unit, that end a line: `samples 300`, `dt 0.01 s`; or several
/// words with their numbers, `dt 0.01 npts 500`.
fn before_numbers(lower: &str) -> Vec<Entry<'_>> {
    let bare = lower
        .trim_start_matches(|c: char| !c.is_alphanumeric())
        .trim();
    let starts =
        |rest: &str| rest.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+'));
    let entry = |key, value| Entry {
        key,
        value,
        parted: false,
    };
    let words: Vec<&str> = bare.split_whitespace().collect();
    let pair = |two: &[&str]| starts(two[1]) && two[0].starts_with(char::is_alphabetic);
    if words.len() >= 4 && words.len().is_multiple_of(2) && words.chunks_exact(2).all(pair) {
        return words
            .chunks_exact(2)
            .map(|two| entry(two[0], two[1]))
            .collect();
    }
    let mut blanks = bare.match_indices([' ', '\t']);
    let Some((at, _)) = blanks.find(|(at, _)| starts(&bare[at + 1..])) else {
        return Vec::new();
    };
    let (key, value) = (bare[..at].trim_end(), bare[at..].trim_start());
    let in_key = |c: char| c.is_alphabetic() || " _-()[]./'\u{2019}\u{b0}\u{ba}".contains(c);
    let is_one = key.chars().all(in_key) && value.split_whitespace().count() <= 2;
    is_one.then(|| entry(key, value)).into_iter().collect()
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
    // The key that follows is no unit.
    let word = match word.contains([':', '='])
        || behind[word.len()..].trim_start().starts_with(['=', ':'])
    {
        true => "",
        false => word.trim_end_matches('.'),
    };
    (text[..end].trim_end_matches('.'), word)
}

/// A text in lower case without the marks of its letters, `ornekleme frekansi`, as capitals and plain texts
/// have it; signs of omission are apostrophes.
fn without_marks(text: &str) -> String {
    const MARKED: [(&str, char); 8] = [
        ("\u{e0}\u{e1}\u{e2}\u{e3}\u{e4}", 'a'),
        ("\u{e8}\u{e9}\u{ea}", 'e'),
        ("\u{ec}\u{ed}\u{ee}\u{131}", 'i'),
        ("\u{f2}\u{f3}\u{f4}\u{f5}\u{f6}", 'o'),
        ("\u{f9}\u{fa}\u{fb}\u{fc}", 'u'),
        ("\u{e7}", 'c'),
        ("\u{15f}", 's'),
        ("\u{11f}", 'g'),
    ];
    let plain = |c: char| match c {
        '\u{2019}' => '\'',
        c if c.is_ascii() => c,
        c => MARKED
            .iter()
            .find(|(marked, _)| marked.contains(c))
            .map_or(c, |(_, plain)| *plain),
    };
    // The dot of a Turkish capital is a sign of its own.
    text.chars()
        .filter(|c| *c != '\u{307}')
        .map(plain)
        .collect()
}

/// The last word of a key, if that is the unit of its value and not the key itself.
fn last_unit(plain: &str) -> Option<&str> {
    let (_, last) = plain.rsplit_once([' ', ','])?;
    LAST_UNITS.contains(&last).then_some(last)
}

/// Whether a key is that of the count of all values: `npts`, `number of data points`, `numero de muestras`.
fn is_count(key: &str) -> bool {
    if ends_in(key, "npts") {
        return true;
    }
    // `Numero de muestras del registro`.
    let key = ["del registro", "do registro", "totales", "totais"]
        .iter()
        .find_map(|of| key.strip_suffix(of)?.strip_suffix(' '))
        .unwrap_or(key);
    let mut words: Vec<&str> = key
        .split([' ', '.', '_', '\''])
        .filter(|w| !w.is_empty() && !["\u{b0}", "\u{ba}"].contains(w))
        .collect();
    // `Total No. of Points`.
    if words.len() > 1 && words[0] == "total" {
        words.remove(0);
    }
    let of_all = |words: &[&str]| {
        let of = words.iter().take_while(|w| OF_ALL.contains(w)).count();
        of.min(words.len().saturating_sub(1))
    };
    if words.first().is_some_and(|w| NUMBERS_OF.contains(w)) {
        words.remove(0);
        words.drain(..of_all(&words));
        return words.len() == 1 && COUNTS.contains(&words[0]);
    }
    // `Total de muestras`.
    if words.first() == Some(&"de") {
        words.remove(0);
    }
    COUNTS.contains(&words.join(" ").as_str()) && !HEADINGS.contains(&key)
}

/// Whether a text ends in a key as a word of its own.
fn ends_in(text: &str, key: &str) -> bool {
    text.strip_suffix(key)
        .is_some_and(|before| !before.ends_with(|c: char| c.is_alphanumeric()))
}

/// Whether a line states a number under a key, `# dt: 0.01`, and so names no columns.
pub(crate) fn states_number(text: &str) -> bool {
    let lower = text.to_lowercase();
    let stated = |entry: &Entry<'_>| meaning(entry).is_some() && entry.has_number();
    keyed(&lower).iter().any(stated)
}
