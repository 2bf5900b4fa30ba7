//! Quantities with units, at the file boundary only.

use std::fmt;

/// Powers of kilogram, metre and second. Powers of a length may be fractions, as
/// in the contact stiffness N/m^1.5.
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
    /// Acceleration, m/s2.
    pub const ACCELERATION: Self = Self::new(0.0, 1.0, -2.0);
    /// Force, N.
    pub const FORCE: Self = Self::new(1.0, 1.0, -2.0);
    /// Stiffness, N/m.
    pub const STIFFNESS: Self = Self::new(1.0, 0.0, -2.0);
    /// Dashpot coefficient, N s/m.
    pub const DASHPOT: Self = Self::new(1.0, 0.0, -1.0);

    const fn new(mass: f64, length: f64, time: f64) -> Self {
        Self { mass, length, time }
    }

    /// Contact stiffness of a law with this exponent, N/m^n.
    #[must_use]
    pub fn stiffness_with_exponent(exponent: f64) -> Self {
        Self::new(1.0, 1.0 - exponent, -2.0)
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
            (Self::DASHPOT, "a dashpot coefficient (N s/m)"),
        ];
        if let Some((_, name)) = named.iter().find(|(d, _)| d == self) {
            f.write_str(name)
        } else if (self.mass - 1.0).abs() < 1e-9 && (self.time + 2.0).abs() < 1e-9 {
            write!(f, "a contact stiffness (N/m^{})", 1.0 - self.length)
        } else {
            write!(f, "kg^{} m^{} s^{}", self.mass, self.length, self.time)
        }
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

/// A text that is not a quantity.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct UnitError(pub String);

const INCH: f64 = 0.0254;
const POUND: f64 = 0.453_592_37;
const GRAVITY: f64 = 9.80665;

/// Value in SI and dimension of a unit symbol.
fn unit(symbol: &str) -> Option<(f64, Dimension)> {
    let d = |factor, dimension| Some((factor, dimension));
    match symbol {
        "%" => d(0.01, Dimension::NUMBER),
        "kg" => d(1.0, Dimension::MASS),
        "t" | "Mg" => d(1.0e3, Dimension::MASS),
        "kt" | "Gg" => d(1.0e6, Dimension::MASS),
        "lb" => d(POUND, Dimension::MASS),
        "m" => d(1.0, Dimension::LENGTH),
        "cm" => d(1.0e-2, Dimension::LENGTH),
        "mm" => d(1.0e-3, Dimension::LENGTH),
        "in" => d(INCH, Dimension::LENGTH),
        "ft" => d(12.0 * INCH, Dimension::LENGTH),
        "s" | "sec" => d(1.0, Dimension::TIME),
        "ms" => d(1.0e-3, Dimension::TIME),
        "us" => d(1.0e-6, Dimension::TIME),
        "Hz" => d(1.0, Dimension::FREQUENCY),
        "rad" => d(1.0, Dimension::NUMBER),
        "g" => d(GRAVITY, Dimension::ACCELERATION),
        "gal" => d(0.01, Dimension::ACCELERATION),
        "N" => d(1.0, Dimension::FORCE),
        "kN" => d(1.0e3, Dimension::FORCE),
        "MN" => d(1.0e6, Dimension::FORCE),
        "GN" => d(1.0e9, Dimension::FORCE),
        "lbf" => d(POUND * GRAVITY, Dimension::FORCE),
        "kip" => d(1.0e3 * POUND * GRAVITY, Dimension::FORCE),
        "Pa" => d(1.0, Dimension::new(1.0, -1.0, -2.0)),
        "kPa" => d(1.0e3, Dimension::new(1.0, -1.0, -2.0)),
        "MPa" => d(1.0e6, Dimension::new(1.0, -1.0, -2.0)),
        "GPa" => d(1.0e9, Dimension::new(1.0, -1.0, -2.0)),
        "1" => d(1.0, Dimension::NUMBER),
        _ => None,
    }
}

/// Parses `"25 t"`, `"2.75e9 N/m^1.5"`, `"0.35 g"`, `"kN s/m"` style units: factors
/// separated by blank, `*` or `·`, divisors after `/`, powers after `^` or as a
/// final digit. `g` is standard gravity, never gram.
///
/// # Errors
/// A text without a number, a number that is not finite, or an unknown unit.
pub fn parse_quantity(text: &str) -> Result<Quantity, UnitError> {
    let plain = text.trim();
    // The number is the longest prefix that parses: "1e3" wins over "1".
    let end = (1..=plain.len())
        .rev()
        .filter(|i| plain.is_char_boundary(*i))
        .find(|i| {
            let head = &plain[..*i];
            !head.ends_with(char::is_alphabetic) && head.trim_end().parse::<f64>().is_ok()
        })
        .ok_or_else(|| UnitError(format!("\"{text}\" does not start with a number")))?;
    let value: f64 = plain[..end]
        .trim_end()
        .parse()
        .map_err(|_| UnitError(format!("\"{text}\" does not start with a number")))?;
    let symbols = plain[end..].trim();
    if !value.is_finite() {
        return Err(UnitError(format!("\"{text}\" is not finite")));
    }
    if symbols.is_empty() {
        return Ok(Quantity {
            value,
            dimension: None,
            text: text.to_owned(),
        });
    }
    let (factor, dimension) = parse_unit(symbols)?;
    Ok(Quantity {
        value: value * factor,
        dimension: Some(dimension),
        text: text.to_owned(),
    })
}

fn parse_unit(symbols: &str) -> Result<(f64, Dimension), UnitError> {
    let (mut factor, mut dimension) = (1.0, Dimension::NUMBER);
    let normal = symbols.replace('²', "^2").replace('·', "*");
    for (i, part) in normal.split('/').enumerate() {
        let sign = if i == 0 { 1.0 } else { -1.0 };
        for term in part.split([' ', '*']).filter(|t| !t.is_empty()) {
            let (symbol, power) = split_power(term)?;
            let (size, unit_dimension) = unit(symbol).ok_or_else(|| {
                UnitError(format!("\"{symbol}\" in \"{symbols}\" is not a known unit"))
            })?;
            factor *= size.powf(sign * power);
            dimension = dimension.plus(unit_dimension, sign * power);
        }
    }
    Ok((factor, dimension))
}

fn split_power(term: &str) -> Result<(&str, f64), UnitError> {
    if term == "1" {
        return Ok((term, 1.0));
    }
    let wrong = || UnitError(format!("\"{term}\" has no readable power"));
    if let Some((symbol, power)) = term.split_once('^') {
        return Ok((symbol, power.parse().map_err(|_| wrong())?));
    }
    match term.find(|c: char| c.is_ascii_digit()) {
        Some(at) if at > 0 => Ok((&term[..at], term[at..].parse().map_err(|_| wrong())?)),
        _ => Ok((term, 1.0)),
    }
}
