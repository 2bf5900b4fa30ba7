//! What a series is, and the units in which agencies print it.

use std::fmt;

use crate::unit::AccelerationUnit;

/// What a series records.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Ground acceleration (m/s2).
    Acceleration,
    /// Ground velocity (m/s).
    Velocity,
    /// Ground displacement (m).
    Displacement,
}

impl Quantity {
    /// Its name, as in `quantity = "acceleration"`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Acceleration => "acceleration",
            Self::Velocity => "velocity",
            Self::Displacement => "displacement",
        }
    }

    /// Symbol of its SI unit.
    #[must_use]
    pub fn si_symbol(self) -> &'static str {
        match self {
            Self::Acceleration => "m/s2",
            Self::Velocity => "m/s",
            Self::Displacement => "m",
        }
    }

    /// What its integral over time is, if that is recorded.
    pub(crate) fn integral(self) -> Option<Self> {
        match self {
            Self::Acceleration => Some(Self::Velocity),
            Self::Velocity => Some(Self::Displacement),
            Self::Displacement => None,
        }
    }

    /// The quantity that a text in lower case names, if it names one alone: `uncorrected
    /// accelerogram`, `raw veloc. counts`.
    pub(crate) fn in_words(lower: &str) -> Option<Self> {
        let named = |q: &Self| lower.contains(&q.name()[..5]);
        let all = [Self::Acceleration, Self::Velocity, Self::Displacement];
        let mut found = all.into_iter().filter(named);
        found.next().filter(|_| found.next().is_none())
    }

    /// The quantity of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::Acceleration, Self::Velocity, Self::Displacement]
            .into_iter()
            .find(|q| q.name().eq_ignore_ascii_case(name.trim()))
    }
}

/// A quantity that a header line names with its unit beside it.
pub(crate) struct NamedWithUnit<'t> {
    /// By the word.
    pub quantity: Quantity,
    /// The unit, which may be of another quantity.
    pub unit: SeriesUnit,
    /// What follows on the line.
    pub rest: &'t str,
}

/// Words of lines that name a quantity other than that of the values: of the ground or the wave,
/// or one value of a motion.
const OF_SOMETHING_ELSE: [&str; 13] = [
    "average", "end", "final", "initial", "max", "maximum", "min", "minimum", "peak", "residual",
    "shear", "vs30", "wave",
];

/// Parts of words for a spectrum, in the languages of the agencies.
const OF_SPECTRA: [&str; 4] = ["spectr", "spektr", "spettr", "pseudo"];
/// Parts of words by which a record was brought to one.
const MATCHED: [&str; 2] = ["match", "compatible"];

/// Whether a line in lower case speaks of a spectrum, and not as of one that a record was matched to.
pub(crate) fn speaks_of_spectrum(lower: &str) -> bool {
    let has = |words: &[&str]| words.iter().any(|w| lower.contains(w));
    has(&OF_SPECTRA) && !has(&MATCHED)
}

/// Words beside accelerations that are none over time.
const OF_NO_RECORD: [&str; 5] = ["gravity", "pseudo", "spectral", "spectrum", "threshold"];

/// Whether a word says that an acceleration beside it is none over time.
pub(crate) fn is_of_no_record(word: &str) -> bool {
    OF_NO_RECORD.contains(&word)
}

/// Whether a word says that a quantity beside it is not that of the values.
pub(crate) fn of_something_else(word: &str) -> bool {
    OF_SOMETHING_ELSE.contains(&word) || is_of_no_record(word)
}

/// The quantity and the unit of a line in lower case such as `el centro ns velocity cm/sec`,
/// `acceleration (gal)` or `accel. in units cm/s2`: the unit stands right behind the word.
pub(crate) fn named_with_unit(lower: &str) -> Option<NamedWithUnit<'_>> {
    let is_word = |c: char| c.is_ascii_alphanumeric();
    let words = || lower.split(|c| !is_word(c)).filter(|w| !w.is_empty());
    if words().any(of_something_else) {
        return None;
    }
    let of = |word: &str| match word {
        "acc" => Some(Quantity::Acceleration),
        "vel" => Some(Quantity::Velocity),
        "disp" => Some(Quantity::Displacement),
        // `accelerogram` says what the record is, not what the number beside it counts.
        word if word.starts_with("accel") && !word.starts_with("accelero") => {
            Some(Quantity::Acceleration)
        }
        word if word.starts_with("veloc") => Some(Quantity::Velocity),
        word if word.starts_with("displ") => Some(Quantity::Displacement),
        _ => None,
    };
    let quantity = words().find_map(of)?;
    if words().filter_map(of).any(|other| other != quantity) {
        return None;
    }
    let mut at = 0;
    let ends = lower.split_inclusive(|c| !is_word(c)).filter_map(|piece| {
        let word = piece.trim_end_matches(|c| !is_word(c));
        let end = at + word.len();
        at += piece.len();
        of(word).map(|_| end)
    });
    let ends: Vec<usize> = ends.collect();
    ends.into_iter().find_map(|behind| {
        let mut rest = lower[behind..].trim_start_matches(BETWEEN);
        for filler in ["in", "units", "unit", "of"] {
            let after = rest.strip_prefix(filler);
            let after = after.filter(|after| after.starts_with([' ', ':', '=', '(', '[']));
            rest = after.map_or(rest, |after| after.trim_start_matches(BETWEEN));
        }
        let (unit, rest) = match rest.strip_prefix(['(', '[']) {
            Some(inside) => {
                let end = inside.rfind([')', ']'])?;
                // The unit may have brackets of its own, and others may follow on the line.
                let ends = inside[..=end].match_indices([')', ']']);
                ends.filter_map(|(end, _)| {
                    Some((SeriesUnit::parse(&inside[..end])?, &inside[end + 1..]))
                })
                .next_back()?
            }
            None => {
                let ends = [&[',', ';', '\t'][..], &[' ', ',', ';', '\t']];
                ends.into_iter().find_map(|ends| {
                    let unit = &rest[..rest.find(ends).unwrap_or(rest.len())];
                    Some((SeriesUnit::parse(unit)?, &rest[unit.len()..]))
                })?
            }
        };
        Some(NamedWithUnit {
            quantity,
            unit,
            rest,
        })
    })
}

/// Characters of a unit at most, with blanks and brackets.
const LONGEST: usize = 200;

/// What may stand between the name of a quantity and its unit.
const BETWEEN: [char; 6] = [' ', '\t', '.', ',', ':', '='];

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A unit in which a file prints a series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SeriesUnit {
    pub quantity: Quantity,
    pub symbol: &'static str,
    /// One unit in SI, or in g where `of_gravity`.
    factor: f64,
    of_gravity: bool,
}

impl SeriesUnit {
    pub(crate) const G: Self = Self::gravity("g", 1.0);
    pub(crate) const TENTH_G: Self = Self::gravity("g/10", 0.1);
    pub(crate) const PERCENT_G: Self = Self::gravity("%g", 0.01);
    pub(crate) const MILLI_G: Self = Self::gravity("mg", 1.0e-3);
    pub(crate) const MICRO_G: Self = Self::gravity("micro-g", 1.0e-6);
    pub(crate) const M_S2: Self = Self::si(Quantity::Acceleration, "m/s2", 1.0);
    pub(crate) const CM_S2: Self = Self::si(Quantity::Acceleration, "cm/s2", 0.01);
    pub(crate) const MM_S2: Self = Self::si(Quantity::Acceleration, "mm/s2", 0.001);
    pub(crate) const NM_S2: Self = Self::si(Quantity::Acceleration, "nm/s2", 1.0e-9);
    pub(crate) const IN_S2: Self = Self::si(Quantity::Acceleration, "in/s2", 0.0254);
    pub(crate) const M_S: Self = Self::si(Quantity::Velocity, "m/s", 1.0);
    pub(crate) const CM_S: Self = Self::si(Quantity::Velocity, "cm/s", 0.01);
    pub(crate) const MM_S: Self = Self::si(Quantity::Velocity, "mm/s", 0.001);
    pub(crate) const IN_S: Self = Self::si(Quantity::Velocity, "in/s", 0.0254);
    pub(crate) const M: Self = Self::si(Quantity::Displacement, "m", 1.0);
    pub(crate) const CM: Self = Self::si(Quantity::Displacement, "cm", 0.01);
    pub(crate) const MM: Self = Self::si(Quantity::Displacement, "mm", 0.001);
    pub(crate) const IN: Self = Self::si(Quantity::Displacement, "in", 0.0254);

    const fn si(quantity: Quantity, symbol: &'static str, factor: f64) -> Self {
        Self {
            quantity,
            symbol,
            factor,
            of_gravity: false,
        }
    }

    const fn gravity(symbol: &'static str, factor: f64) -> Self {
        Self {
            quantity: Quantity::Acceleration,
            symbol,
            factor,
            of_gravity: true,
        }
    }

    /// One unit in SI, for a g of `gravity` (m/s2).
    pub(crate) fn in_si(self, gravity: f64) -> f64 {
        if self.of_gravity {
            self.factor * gravity
        } else {
            self.factor
        }
    }

    /// Whether it is a part or a multiple of g.
    pub(crate) fn is_of_gravity(self) -> bool {
        self.of_gravity
    }

    /// Whether the user's word means the same.
    pub(crate) fn is(self, unit: AccelerationUnit) -> bool {
        Self::from(unit) == self
    }

    /// The unit written as agencies write it, e.g. `cm/sec/sec`, `gal`, `CM/S^2`.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        // No unit is longer: lines of brackets alone, each of which may begin one, are left quickly.
        if text.len() > LONGEST {
            return None;
        }
        let plain: String = text
            .to_ascii_lowercase()
            .replace("sec", "s")
            .replace("seg", "s")
            .chars()
            .filter(|c| !matches!(c, '^' | ' ' | '\t' | '(' | ')' | '.'))
            .collect::<String>()
            .replace("s*s", "s2")
            .replace("s**2", "s2")
            .replace("/s/s", "/s2");
        Some(match plain.as_str() {
            "g" | "g's" => Self::G,
            "g/10" => Self::TENTH_G,
            "%g" | "percentg" => Self::PERCENT_G,
            "mg" | "g/1000" | "millig" | "milli-g" => Self::MILLI_G,
            "micro-g" | "microg" => Self::MICRO_G,
            "m/s2" => Self::M_S2,
            "cm/s2" | "cms/s2" | "gal" | "gals" => Self::CM_S2,
            "mm/s2" => Self::MM_S2,
            "in/s2" => Self::IN_S2,
            "ft/s2" => Self::from(AccelerationUnit::FootPerSecondSquared),
            "nm/s2" => Self::NM_S2,
            "m/s" => Self::M_S,
            "cm/s" | "cms/s" | "kine" | "kines" => Self::CM_S,
            "mm/s" => Self::MM_S,
            "in/s" => Self::IN_S,
            "m" => Self::M,
            "cm" | "cms" => Self::CM,
            "mm" => Self::MM,
            "in" => Self::IN,
            _ => return None,
        })
    }
}

/// A number of units of acceleration, as a header states a unit: `0.001 g`, `x 10^-3 g`, `1/1000 g`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Multiple {
    /// The unit that they are; `None`: one that is not known, or behind which the number stands, `g x 1000`, so
    /// that the values may be multiplied or to be multiplied by it.
    pub unit: Option<SeriesUnit>,
    /// Whether they may be the strength of a motion: `0.1 g`.
    pub may_be_level: bool,
}

impl Multiple {
    /// Units that a number of others may be.
    const KNOWN: [SeriesUnit; 9] = [
        SeriesUnit::G,
        SeriesUnit::TENTH_G,
        SeriesUnit::PERCENT_G,
        SeriesUnit::MILLI_G,
        SeriesUnit::MICRO_G,
        SeriesUnit::M_S2,
        SeriesUnit::CM_S2,
        SeriesUnit::MM_S2,
        SeriesUnit::NM_S2,
    ];
    /// Largest unit (m/s2) that is too weak for the strength of a motion.
    const NO_LEVEL: f64 = 0.0101;

    /// The number and the unit of a text that has both.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let plain = in_signs(text);
        let accelerates = |text: &str| {
            SeriesUnit::parse(text).filter(|unit| unit.quantity == Quantity::Acceleration)
        };
        let times = ['x', '*'];
        let signed = plain.strip_prefix(times);
        if let Some((number, is_bare, rest)) = leading_factor(signed.unwrap_or(&plain)) {
            let unit = accelerates(rest.strip_prefix(times).unwrap_or(rest))?;
            let level = number * unit.in_si(pounding_catalogue::STANDARD_GRAVITY);
            return Some(Self {
                unit: Self::known(number, unit),
                may_be_level: is_bare && signed.is_none() && level > Self::NO_LEVEL,
            });
        }
        let (unit, number) = plain.rsplit_once(['x', '*', '/'])?;
        let is_number = leading_factor(number).is_some_and(|(_, _, rest)| rest.is_empty());
        (is_number && accelerates(unit).is_some()).then_some(Self {
            // `g/10`.
            unit: accelerates(&plain),
            may_be_level: false,
        })
    }

    fn known(number: f64, one: SeriesUnit) -> Option<SeriesUnit> {
        let gravity = pounding_catalogue::STANDARD_GRAVITY;
        let near = |a: f64, b: f64, part: f64| (a / b - 1.0).abs() < part;
        let same = |unit: &&SeriesUnit| {
            unit.of_gravity == one.of_gravity && near(number * one.factor, unit.factor, 1.0e-9)
        };
        // `9.81 m/s2` is g.
        let is_gravity = !one.of_gravity && near(number * one.factor, gravity, 0.002);
        match is_gravity {
            true => Some(SeriesUnit::G),
            false if number == 1.0 => Some(one),
            false => Self::KNOWN.iter().find(same).copied(),
        }
    }
}

/// A text without blanks and brackets, in lower case, with plain signs for those of multiplication and powers.
fn in_signs(text: &str) -> String {
    const DIGITS: [char; 10] = [
        '\u{2070}', '\u{b9}', '\u{b2}', '\u{b3}', '\u{2074}', '\u{2075}', '\u{2076}', '\u{2077}',
        '\u{2078}', '\u{2079}',
    ];
    let mut plain = String::with_capacity(text.len());
    let mut raised = false;
    for c in text.to_lowercase().replace("**", "^").chars() {
        let digit = DIGITS.iter().position(|d| *d == c);
        let is_raised = digit.is_some() || c == '\u{207b}';
        if is_raised && !raised {
            plain.push('^');
        }
        raised = is_raised;
        match (digit, c) {
            (Some(digit), _) => plain.extend(char::from_digit(digit as u32, 10)),
            (_, '\u{207b}' | '\u{2212}') => plain.push('-'),
            (_, '\u{d7}') => plain.push('x'),
            (_, '\u{b7}') => plain.push('*'),
            (_, ' ' | '\t' | '(' | ')' | '{' | '}') => {}
            (_, c) => plain.push(c),
        }
    }
    plain
}

/// The number that a text without blanks starts with, `0.001`, `1e-3`, `1/1000`, `10^-3` or `10-3`, whether it is
/// one of digits alone, and what follows.
fn leading_factor(text: &str) -> Option<(f64, bool, &str)> {
    let digits = |text: &str| {
        let end = text.find(|c: char| !(c.is_ascii_digit() || c == '.'));
        end.unwrap_or(text.len())
    };
    let (number, rest) = text.split_at(digits(text));
    let number: f64 = number.parse().ok()?;
    let power = |text: &str| -> Option<(i32, usize)> {
        let sign = usize::from(text.starts_with(['-', '+']));
        let end = sign + digits(&text[sign..]);
        Some((text[..end].parse().ok()?, end))
    };
    let ten = number == 10.0;
    let raised = rest
        .strip_prefix('^')
        .or(rest.starts_with('-').then_some(rest));
    if let Some(behind) = raised.filter(|_| ten)
        && let Some((power, end)) = power(behind)
    {
        return Some((10.0_f64.powi(power), false, &behind[end..]));
    }
    if let Some(behind) = rest.strip_prefix('e')
        && let Some((power, end)) = power(behind)
    {
        return Some((number * 10.0_f64.powi(power), false, &behind[end..]));
    }
    if let Some(behind) = rest.strip_prefix('/')
        && let Ok(divisor) = behind[..digits(behind)].parse::<f64>()
    {
        return Some((number / divisor, false, &behind[digits(behind)..]));
    }
    Some((number, true, rest))
}

impl From<AccelerationUnit> for SeriesUnit {
    fn from(unit: AccelerationUnit) -> Self {
        match unit {
            AccelerationUnit::StandardGravity => Self::G,
            AccelerationUnit::MilliGravity => Self::MILLI_G,
            AccelerationUnit::TenthGravity => Self::TENTH_G,
            unit => Self::si(Quantity::Acceleration, unit.symbol(), unit.in_si()),
        }
    }
}
