//! Quantities with units, at the file boundary only.

mod other_forms;

use std::fmt;
use std::ops::Range;

use pounding_catalogue::suggestion::letters_to_change;

use other_forms::without_brackets;

/// Powers of kilogram, metre and second. Powers of a length may be fractions, as
/// in the contact stiffness N/m^1.5. Two dimensions are equal if their powers
/// agree to 1e-9.
#[derive(Debug, Clone, Copy)]
pub struct Dimension {
    /// Power of mass.
    pub mass: f64,
    /// Power of length.
    pub length: f64,
    /// Power of time.
    pub time: f64,
}

impl Dimension {
    /// A pure number.
    pub const NUMBER: Self = Self::new(0.0, 0.0, 0.0);
    /// Mass, kg.
    pub const MASS: Self = Self::new(1.0, 0.0, 0.0);
    /// Length, m.
    pub const LENGTH: Self = Self::new(0.0, 1.0, 0.0);
    /// Time, s.
    pub const TIME: Self = Self::new(0.0, 0.0, 1.0);
    /// Frequency, 1/s.
    pub const FREQUENCY: Self = Self::new(0.0, 0.0, -1.0);
    /// Velocity, m/s.
    pub const VELOCITY: Self = Self::new(0.0, 1.0, -1.0);
    /// Slowness, s/m.
    pub const SLOWNESS: Self = Self::new(0.0, -1.0, 1.0);
    /// Acceleration, m/s2.
    pub const ACCELERATION: Self = Self::new(0.0, 1.0, -2.0);
    /// Force, N.
    pub const FORCE: Self = Self::new(1.0, 1.0, -2.0);
    /// Stiffness, N/m.
    pub const STIFFNESS: Self = Self::new(1.0, 0.0, -2.0);
    /// Flexibility, m/N.
    pub const FLEXIBILITY: Self = Self::new(-1.0, 0.0, 2.0);
    /// Flexural rigidity, N m2.
    pub const FLEXURAL_RIGIDITY: Self = Self::new(1.0, 3.0, -2.0);
    /// Dashpot coefficient, N s/m.
    pub const DASHPOT: Self = Self::new(1.0, 0.0, -1.0);
    /// Energy, J.
    pub const ENERGY: Self = Self::new(1.0, 2.0, -2.0);
    /// Density, kg/m3.
    pub const DENSITY: Self = Self::new(1.0, -3.0, 0.0);
    /// Rotational inertia, kg m2.
    pub const ROTATIONAL_INERTIA: Self = Self::new(1.0, 2.0, 0.0);
    /// Rotational stiffness, N m/rad: that of an energy, as angles are numbers.
    pub const ROTATIONAL_STIFFNESS: Self = Self::ENERGY;
    /// Dashpot coefficient of a rotation, N m s/rad.
    pub const ROTATIONAL_DASHPOT: Self = Self::new(1.0, 2.0, -1.0);
    /// Pressure, Pa.
    pub const PRESSURE: Self = Self::new(1.0, -1.0, -2.0);

    const fn new(mass: f64, length: f64, time: f64) -> Self {
        Self { mass, length, time }
    }

    /// Contact stiffness of a law with this exponent, N/m^n.
    #[must_use]
    pub fn stiffness_with_exponent(exponent: f64) -> Self {
        Self::new(1.0, 1.0 - exponent, -2.0)
    }

    /// Coefficient of a damper whose force is proportional to a power of the velocity,
    /// N (s/m)^a.
    #[must_use]
    pub fn dashpot_with_exponent(exponent: f64) -> Self {
        Self::new(1.0, 1.0 - exponent, exponent - 2.0)
    }

    /// The dimension of a law of forces and displacements, where the law is one of moments and
    /// rotations: N becomes N m, and m a pure number.
    #[must_use]
    pub fn of_rotation(self) -> Self {
        Self::new(self.mass, 2.0 * self.mass, self.time)
    }

    fn plus(self, other: Self, power: f64) -> Self {
        Self::new(
            self.mass + power * other.mass,
            self.length + power * other.length,
            self.time + power * other.time,
        )
    }
}

impl PartialEq for Dimension {
    fn eq(&self, other: &Self) -> bool {
        (self.mass - other.mass).abs() < 1e-9
            && (self.length - other.length).abs() < 1e-9
            && (self.time - other.time).abs() < 1e-9
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let named = [
            (Self::NUMBER, "a pure number"),
            (Self::MASS, "a mass (kg)"),
            (Self::LENGTH, "a length (m)"),
            (Self::TIME, "a time (s)"),
            (Self::FREQUENCY, "a frequency (1/s)"),
            (Self::VELOCITY, "a velocity (m/s)"),
            (Self::ACCELERATION, "an acceleration (m/s2)"),
            (Self::FORCE, "a force (N)"),
            (Self::STIFFNESS, "a stiffness (N/m)"),
            (Self::FLEXIBILITY, "a flexibility (m/N)"),
            (Self::FLEXURAL_RIGIDITY, "a flexural rigidity (N m2)"),
            (Self::DASHPOT, "a dashpot coefficient (N s/m)"),
            // Also the coefficient of a damper whose force is proportional to the squared velocity.
            (
                Self::new(1.0, -1.0, 0.0),
                "a mass over a length (kg/m = N s^2/m^2)",
            ),
            (
                Self::ENERGY,
                "a moment, an energy or a rotational stiffness (N m)",
            ),
            (Self::DENSITY, "a density (kg/m3)"),
            (Self::ROTATIONAL_INERTIA, "a rotational inertia (kg m2)"),
            (
                Self::ROTATIONAL_DASHPOT,
                "a dashpot coefficient of a rotation (N m s)",
            ),
            // Also the contact stiffness of a law with exponent 2.
            (Self::PRESSURE, "a pressure (Pa = N/m^2)"),
        ];
        // Sums of decimal powers carry noise that no reader wants to see.
        let shown = |power: f64| (power * 1e6).round() / 1e6;
        if let Some((_, name)) = named.iter().find(|(d, _)| d == self) {
            return f.write_str(name);
        }
        if self.length < 0.0 && *self == Self::stiffness_with_exponent(1.0 - self.length) {
            return write!(f, "a contact stiffness (N/m^{})", shown(1.0 - self.length));
        }
        let exponent = self.time + 2.0;
        if exponent > 0.0 && *self == Self::dashpot_with_exponent(exponent) {
            let power = shown(exponent);
            return write!(f, "a dashpot coefficient (N s^{power}/m^{power})");
        }
        f.write_str("a quantity in")?;
        for (symbol, power) in [("kg", self.mass), ("m", self.length), ("s", self.time)] {
            match shown(power) {
                0.0 => {}
                1.0 => write!(f, " {symbol}")?,
                power => write!(f, " {symbol}^{power}")?,
            }
        }
        Ok(())
    }
}

/// A value in SI units; a plain number has no dimension of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// Value in SI units.
    pub value: f64,
    /// Dimension, `None` for a plain number, which is SI whatever it stands for.
    pub dimension: Option<Dimension>,
    /// As written.
    pub text: String,
}

/// Why a text is not a quantity.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UnitError {
    /// The text does not start with a number.
    #[error("\"{text}\" does not start with a number")]
    NoNumber {
        /// The text.
        text: String,
    },
    /// A decimal comma, or a comma between thousands.
    #[error("\"{text}\" has a comma in its number")]
    Comma {
        /// The text.
        text: String,
    },
    /// The number, or its value in SI units, is too large.
    #[error("\"{text}\" is not a finite number")]
    NotFinite {
        /// The text.
        text: String,
    },
    /// A unit that is not known.
    #[error("\"{symbol}\" in \"{text}\" is not a known unit")]
    UnknownUnit {
        /// The text.
        text: String,
        /// The unit.
        symbol: String,
    },
    /// A power that is not a number from -9 to 9.
    #[error("\"{term}\" in \"{text}\" has no readable power")]
    Power {
        /// The text.
        text: String,
        /// The unit with its power.
        term: String,
    },
    /// `/` or `*` with nothing on one side.
    #[error("the unit of \"{text}\" is incomplete")]
    Incomplete {
        /// The text.
        text: String,
    },
    /// Per cent beside other units, or radians beside units of a quantity that no angle takes part in.
    #[error("\"{symbol}\" in \"{text}\" does not go with the other units")]
    BesideOthers {
        /// The text.
        text: String,
        /// The unit.
        symbol: &'static str,
    },
    /// A product after `/`, which can be read in two ways.
    #[error("the unit of \"{text}\" has a product after `/` and can be read in two ways")]
    Ambiguous {
        /// The text.
        text: String,
    },
}

impl UnitError {
    /// What to do about it, where any dimension may stand.
    #[must_use]
    pub fn help(&self) -> String {
        self.help_for(None)
    }

    /// What to do about it, where this dimension is wanted: a unit that is not known leads to
    /// one that gives it.
    #[must_use]
    pub fn help_for(&self, wanted: Option<Dimension>) -> String {
        if let Some(help) = self.of_form(wanted) {
            return help;
        }
        match self {
            Self::Comma { .. } => {
                "write a decimal point, and nothing between thousands: 3.46, 25000".to_owned()
            }
            Self::NotFinite { .. } => "correct the number".to_owned(),
            Self::UnknownUnit { text, symbol } => {
                if let Some(said) = of_tons(text, symbol, wanted) {
                    return said;
                }
                let guess = meant(text, wanted);
                let guess =
                    guess.map_or_else(String::new, |unit| format!("did you mean \"{unit}\"? "));
                format!("{guess}{}", known_units(wanted))
            }
            Self::Power { .. } => "write powers as in m/s^2, N/m^1.5".to_owned(),
            Self::BesideOthers { .. } => {
                "leave it out: `%` stands alone, as in \"5 %\", and `rad` alone, over times and below others, as in \"rad/s\" or \"kN m/rad\""
                    .to_owned()
            }
            Self::Incomplete { .. } => {
                "write units as in \"kN s/m\", \"N/m^1.5\", \"1/s\"".to_owned()
            }
            Self::Ambiguous { .. } => {
                "write all factors before `/` and one `/` for each divisor: \"kN s/m\", \"m/s/s\""
                    .to_owned()
            }
            Self::NoNumber { .. } => {
                "write a number in SI units, or a text such as \"25 t\", \"3.46 MN/m\", \"20 mm\""
                    .to_owned()
            }
        }
    }
}

impl UnitError {
    /// What to do about brackets in a unit, and about other signs than blanks between its factors.
    fn of_form(&self, wanted: Option<Dimension>) -> Option<String> {
        let (Self::UnknownUnit { text, .. }
        | Self::Power { text, .. }
        | Self::Incomplete { text }
        | Self::Ambiguous { text }) = self
        else {
            return None;
        };
        let unit = unit_of_text(text);
        let plain = without_brackets(&unit).filter(|plain| gives(plain, wanted));
        if unit.contains(['(', ')', '[', ']', '{', '}']) {
            let write = plain.map_or_else(
                || {
                    "all factors before `/` and one `/` for each divisor, as in \"kN s/m\""
                        .to_owned()
                },
                |plain| format!("\"{plain}\""),
            );
            return Some(format!("brackets are not read in units: write {write}"));
        }
        // A full stop behind a unit is no sign between two.
        let plain = plain.filter(|plain| plain.contains([' ', '/']))?;
        matches!(self, Self::UnknownUnit { .. })
            .then(|| format!("write \"{plain}\": blanks between factors, and powers as in m^2"))
    }
}

/// The unit of a text, in plain signs.
fn unit_of_text(text: &str) -> String {
    let plain = text.trim();
    normal(plain[number_length(plain)..].trim())
}

/// Whether a unit can be read, and is of the dimension that is wanted.
fn gives(unit: &str, wanted: Option<Dimension>) -> bool {
    let found = parse_unit(unit, unit).ok();
    found.is_some_and(|(_, _, found)| wanted.is_none_or(|wanted| wanted == found))
}

/// What to do about tons, of which there are several.
fn of_tons(text: &str, symbol: &str, wanted: Option<Dimension>) -> Option<String> {
    if !matches!(symbol.to_lowercase().as_str(), "ton" | "tons") {
        return None;
    }
    let unit = unit_of_text(text);
    let fits = |known: &str| gives(&unit.replacen(symbol, known, 1), wanted);
    if fits("t") {
        return Some(
            "a metric ton is \"t\"; a US (short) ton is 907.185 kg or 2000 \"lb\"".to_owned(),
        );
    }
    fits("tf").then(|| {
        "a metric ton of force is \"tf\"; a US (short) ton of force is 2 \"kip\"".to_owned()
    })
}

/// A quantity with a unit of force for that of mass which people call alike, where that is of the dimension that is
/// wanted; in words.
pub(crate) fn force_meant(text: &str, wanted: Dimension) -> Option<String> {
    let plain = text.trim();
    let (number, unit) = plain.split_at(number_length(plain));
    let mut terms = Vec::new();
    let mut replaced = None;
    for term in unit.split_inclusive(|c: char| !c.is_alphanumeric()) {
        let symbol = term.trim_end_matches(|c: char| !c.is_alphabetic());
        let force = OF_WEIGHT.iter().find(|(mass, _, _)| *mass == symbol);
        match force {
            Some((mass, force, name)) if replaced.is_none() => {
                replaced = Some((mass, force, name));
                terms.push(term.replacen(mass, force, 1));
            }
            _ => terms.push(term.to_owned()),
        }
    }
    let (mass, force, name) = replaced?;
    let with_force = terms.concat();
    gives(with_force.trim(), Some(wanted))
        .then(|| format!("{mass} is a mass; {name} of force are {force}: \"{number}{with_force}\""))
}

/// Units of mass that people use for weights, and those of their weights.
const OF_WEIGHT: [(&str, &str, &str); 3] = [
    ("t", "tf", "tonnes"),
    ("kg", "kgf", "kilograms"),
    ("lb", "lbf", "pounds"),
];

/// A unit. Its size in SI units is `up / down`, both exact, so that a decimal
/// value comes out as the nearest double to what it says wherever possible.
struct Unit {
    symbol: &'static str,
    up: f64,
    down: f64,
    dimension: Dimension,
}

const fn unit(symbol: &'static str, up: f64, down: f64, dimension: Dimension) -> Unit {
    Unit {
        symbol,
        up,
        down,
        dimension,
    }
}

/// Inch, foot and pound are those of 1959 (exact); standard gravity is that of the
/// third General Conference on Weights and Measures (1901), 9.80665 m/s2.
const UNITS: &[Unit] = &[
    unit("%", 1.0, 100.0, Dimension::NUMBER),
    unit("rad", 1.0, 1.0, Dimension::NUMBER),
    unit("kg", 1.0, 1.0, Dimension::MASS),
    unit("t", 1e3, 1.0, Dimension::MASS),
    unit("Mg", 1e3, 1.0, Dimension::MASS),
    unit("kt", 1e6, 1.0, Dimension::MASS),
    unit("Gg", 1e6, 1.0, Dimension::MASS),
    unit("lb", 45_359_237.0, 1e8, Dimension::MASS),
    unit("m", 1.0, 1.0, Dimension::LENGTH),
    unit("km", 1000.0, 1.0, Dimension::LENGTH),
    unit("cm", 1.0, 100.0, Dimension::LENGTH),
    unit("mm", 1.0, 1e3, Dimension::LENGTH),
    unit("um", 1.0, 1e6, Dimension::LENGTH),
    unit("in", 254.0, 1e4, Dimension::LENGTH),
    unit("ft", 3048.0, 1e4, Dimension::LENGTH),
    unit("s", 1.0, 1.0, Dimension::TIME),
    unit("sec", 1.0, 1.0, Dimension::TIME),
    unit("ms", 1.0, 1e3, Dimension::TIME),
    unit("us", 1.0, 1e6, Dimension::TIME),
    unit("min", 60.0, 1.0, Dimension::TIME),
    unit("h", 3600.0, 1.0, Dimension::TIME),
    unit("Hz", 1.0, 1.0, Dimension::FREQUENCY),
    unit("g", 980_665.0, 1e5, Dimension::ACCELERATION),
    unit("gal", 1.0, 100.0, Dimension::ACCELERATION),
    unit("Gal", 1.0, 100.0, Dimension::ACCELERATION),
    unit("N", 1.0, 1.0, Dimension::FORCE),
    unit("kN", 1e3, 1.0, Dimension::FORCE),
    unit("MN", 1e6, 1.0, Dimension::FORCE),
    unit("GN", 1e9, 1.0, Dimension::FORCE),
    unit("kgf", 980_665.0, 1e5, Dimension::FORCE),
    unit("tf", 980_665.0, 100.0, Dimension::FORCE),
    unit("lbf", 44_482_216_152_605.0, 1e13, Dimension::FORCE),
    unit("kip", 44_482_216_152_605.0, 1e10, Dimension::FORCE),
    unit("Pa", 1.0, 1.0, Dimension::PRESSURE),
    unit("kPa", 1e3, 1.0, Dimension::PRESSURE),
    unit("MPa", 1e6, 1.0, Dimension::PRESSURE),
    unit("GPa", 1e9, 1.0, Dimension::PRESSURE),
    unit(
        "psi",
        44_482_216_152_605.0,
        6_451_600_000.0,
        Dimension::PRESSURE,
    ),
    unit(
        "ksi",
        44_482_216_152_605.0,
        6_451_600.0,
        Dimension::PRESSURE,
    ),
];

/// The units that give a dimension, or all where it takes several.
fn known_units(wanted: Option<Dimension>) -> String {
    let symbols = |wanted: Option<Dimension>| -> Vec<&str> {
        let fits = |u: &&Unit| wanted.is_none_or(|d| d == u.dimension);
        UNITS.iter().filter(fits).map(|u| u.symbol).collect()
    };
    match (symbols(wanted), wanted) {
        (fitting, Some(wanted)) if !fitting.is_empty() => {
            format!("units of {wanted}: {}", fitting.join(", "))
        }
        _ => format!("known units: {}", symbols(None).join(", ")),
    }
}

/// Unknown symbols in one unit up to which a correction is looked for.
const MOST_CORRECTED: usize = 3;

/// What was probably meant by the unit of a text in which symbols are not known: those that
/// make it a unit of the wanted dimension with the fewest letters changed, upper and lower
/// case apart. The symbol alone where one is wrong, else the whole unit.
fn meant(text: &str, wanted: Option<Dimension>) -> Option<String> {
    let unit = unit_of_text(text);
    let unknown = unknown_symbols(&unit);
    if unknown.is_empty() || unknown.len() > MOST_CORRECTED {
        return None;
    }
    // Every choice of a symbol for each of the first few places, with what it changes.
    let mut choices = vec![(0, unit.clone())];
    // From the end, so that the places before it stay where they are.
    for place in unknown.iter().rev() {
        let near = near_symbols(&unit[place.clone()]);
        let put = |(cost, unit): &(usize, String)| {
            let with = |&(more, symbol): &(usize, &str)| {
                let mut unit = unit.clone();
                unit.replace_range(place.clone(), symbol);
                (cost + more, unit)
            };
            near.iter().map(with).collect::<Vec<_>>()
        };
        choices = choices.iter().flat_map(put).collect();
    }
    let fitting = choices.into_iter().filter(|(_, unit)| gives(unit, wanted));
    let (_, corrected) = fitting.min_by_key(|(cost, _)| *cost)?;
    match unknown.as_slice() {
        [one] => {
            let after = unit.len() - one.end;
            Some(corrected[one.start..corrected.len() - after].to_owned())
        }
        _ => Some(corrected),
    }
}

/// Places of the symbols in a unit that are none.
fn unknown_symbols(unit: &str) -> Vec<Range<usize>> {
    let separates = |c: char| matches!(c, '*' | '/') || c.is_whitespace();
    let mut found = Vec::new();
    let mut start = 0;
    for term in unit.split_inclusive(separates) {
        let symbol = split_power(term.trim_end_matches(separates)).map_or("", |(symbol, _)| symbol);
        let known = symbol.is_empty() || symbol == "1" || UNITS.iter().any(|u| u.symbol == symbol);
        if !known {
            found.push(start..start + symbol.len());
        }
        start += term.len();
    }
    found
}

/// The known symbols that are like one, each with how far it is from it.
fn near_symbols(symbol: &str) -> Vec<(usize, &'static str)> {
    let lower = symbol.to_lowercase();
    let letters = lower.chars().count();
    let near = |u: &Unit| {
        let known = u.symbol.to_lowercase();
        let changed = letters_to_change(&lower, &known);
        // A single letter that is another one says nothing.
        let like = changed < letters && changed <= 1 + letters / 3;
        // Of equals one that begins alike, then one that is as long.
        let begins = usize::from(known.chars().next() != lower.chars().next());
        let length = known.chars().count().abs_diff(letters);
        like.then_some((100 * changed + 10 * begins + length, u.symbol))
    };
    UNITS.iter().filter_map(near).collect()
}

/// Largest power of a unit; larger ones are slips of the pen.
const LARGEST_POWER: f64 = 9.0;

/// The unit in a name of a column: `ms` in `time (ms)`, `time [ms]` and `time_ms`.
#[must_use]
pub fn unit_in(name: &str) -> Option<&str> {
    if let Some((_, rest)) = name.split_once(['(', '[']) {
        return rest.split([')', ']']).next().map(str::trim);
    }
    name.rsplit_once('_').map(|(_, unit)| unit.trim())
}

/// The number of degrees of a text such as `30 deg`; a plain number, which is of degrees too where these are
/// wanted, is none.
#[must_use]
pub fn parse_degrees(text: &str) -> Option<f64> {
    let text = text.trim();
    let mut units = ["degrees", "deg", "\u{b0}"].iter();
    let degrees = units.find_map(|unit| text.strip_suffix(unit)?.trim().parse::<f64>().ok());
    degrees.filter(|degrees| degrees.is_finite())
}

/// Parses `"25 t"`, `"2.75e9 N/m^1.5"`, `"0.35 g"`, `"kN s/m"` style units: factors
/// separated by blank, `*`, `·` or `⋅`, one divisor after each `/`, powers after `^`, as final
/// digits or raised, as in `m·s⁻²`. `g` is standard gravity, never gram. A text that is only a
/// number has no dimension.
///
/// # Errors
/// A text without a number, a value that is not finite, or a unit that is unknown
/// or can be read in two ways.
pub fn parse_quantity(text: &str) -> Result<Quantity, UnitError> {
    let quantity = |value: f64, dimension| Quantity {
        value,
        dimension,
        text: text.to_owned(),
    };
    let owned = || text.to_owned();
    let plain = text.trim();
    let (number, symbols) = plain.split_at(number_length(plain));
    let value: f64 = number
        .parse()
        .map_err(|_| UnitError::NoNumber { text: owned() })?;
    let symbols = symbols.trim();
    if symbols.starts_with(',') {
        return Err(UnitError::Comma { text: owned() });
    }
    let result = if symbols.is_empty() {
        quantity(value, None)
    } else {
        let (up, down, dimension) = parse_unit(symbols, text)?;
        quantity(value * up / down, Some(dimension))
    };
    if result.value.is_finite() {
        Ok(result)
    } else {
        Err(UnitError::NotFinite { text: owned() })
    }
}

/// Length of the decimal number at the start of a text, zero if there is none.
/// An `e` counts only with the digits of an exponent after it.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        bytes[from..]
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count()
    };
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let mut at = sign(0);
    let whole = digits(at);
    at += whole;
    let mut fraction = 0;
    if bytes.get(at) == Some(&b'.') {
        fraction = digits(at + 1);
        at += 1 + fraction;
    }
    if whole + fraction == 0 {
        return 0;
    }
    if matches!(bytes.get(at), Some(b'e' | b'E')) {
        let start = at + 1 + sign(at + 1);
        let exponent = digits(start);
        if exponent > 0 {
            at = start + exponent;
        }
    }
    at
}

/// Size (as a fraction) and dimension of a compound unit.
fn parse_unit(symbols: &str, text: &str) -> Result<(f64, f64, Dimension), UnitError> {
    let text = || text.to_owned();
    let (mut up, mut down, mut dimension) = (1.0, 1.0, Dimension::NUMBER);
    let (mut count, mut per_cent, mut radians) = (0, false, false);
    let normal = normal(symbols);
    for (i, part) in normal.split('/').enumerate() {
        // "1/s": a one stands for an absent numerator, and for nothing else.
        if i == 0 && part.trim() == "1" && normal.contains('/') {
            continue;
        }
        if part.split('*').any(|p| p.trim().is_empty()) {
            return Err(UnitError::Incomplete { text: text() });
        }
        let terms = || part.split(|c: char| c == '*' || c.is_whitespace());
        if i > 0 && terms().filter(|t| !t.is_empty()).count() > 1 {
            return Err(UnitError::Ambiguous { text: text() });
        }
        for term in terms().filter(|t| !t.is_empty()) {
            let (symbol, power) = split_power(term).ok_or_else(|| UnitError::Power {
                text: text(),
                term: term.to_owned(),
            })?;
            let unit = UNITS.iter().find(|u| u.symbol == symbol).ok_or_else(|| {
                UnitError::UnknownUnit {
                    text: text(),
                    symbol: as_written(symbols, symbol),
                }
            })?;
            let power = if i == 0 { power } else { -power };
            count += 1;
            per_cent |= symbol == "%";
            radians |= symbol == "rad" && power > 0.0;
            let (rise, fall) = if power < 0.0 {
                (unit.down, unit.up)
            } else {
                (unit.up, unit.down)
            };
            up *= libm::pow(rise, power.abs());
            down *= libm::pow(fall, power.abs());
            dimension = dimension.plus(unit.dimension, power);
        }
    }
    let beside = |symbol| UnitError::BesideOthers {
        text: text(),
        symbol,
    };
    if per_cent && count > 1 {
        return Err(beside("%"));
    }
    // An angle is of no mass, and no force or length is by one.
    if radians && (dimension.mass != 0.0 || dimension.length > 0.0) {
        return Err(beside("rad"));
    }
    Ok((up, down, dimension))
}

/// A unit with powers, products and the prefix micro in plain signs.
fn normal(unit: &str) -> String {
    let mut plain = String::with_capacity(unit.len());
    let mut is_raised = false;
    for sign in unit.chars() {
        let raised = SUPERSCRIPTS.iter().find(|(raised, _)| *raised == sign);
        match (raised, sign) {
            (Some((_, low)), _) => {
                if !is_raised {
                    plain.push('^');
                }
                plain.push(*low);
            }
            (None, '·' | '⋅') => plain.push('*'),
            (None, 'µ' | 'μ') => plain.push('u'),
            (None, other) => plain.push(other),
        }
        is_raised = raised.is_some();
    }
    plain
}

/// Signs of powers, and what they are on the line.
const SUPERSCRIPTS: [(char, char); 12] = [
    ('⁺', '+'),
    ('⁻', '-'),
    ('⁰', '0'),
    ('¹', '1'),
    ('²', '2'),
    ('³', '3'),
    ('⁴', '4'),
    ('⁵', '5'),
    ('⁶', '6'),
    ('⁷', '7'),
    ('⁸', '8'),
    ('⁹', '9'),
];

/// A symbol in plain signs as it stands in a unit: with the sign for micro that was written.
fn as_written(unit: &str, symbol: &str) -> String {
    let written = ['µ', 'μ'].map(|micro| symbol.replacen('u', &micro.to_string(), 1));
    let found = written.into_iter().find(|written| unit.contains(written));
    found.unwrap_or_else(|| symbol.to_owned())
}

/// `m^1.5` and `s2` into symbol and power; `None` for a power that is none.
fn split_power(term: &str) -> Option<(&str, f64)> {
    let (symbol, power) = match (
        term.split_once('^'),
        term.find(|c: char| c.is_ascii_digit()),
    ) {
        (Some(parts), _) => parts,
        (None, Some(at)) if at > 0 => term.split_at(at),
        (None, _) => return Some((term, 1.0)),
    };
    // A full stop behind a unit is no part of it, with or without a power.
    if power.ends_with('.') {
        return None;
    }
    let power: f64 = power.parse().ok()?;
    (power.abs() <= LARGEST_POWER).then_some((symbol, power))
}
