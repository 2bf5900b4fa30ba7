//! What is known of a model, law, provision, format or generator without running it.

use std::fmt;

use crate::error::DefinitionError;

/// What is found by name and may take parameters.
pub trait Descriptor: Sync + 'static {
    /// What it is: `impact model`.
    const KIND: &'static str;
    /// The same in short, before a name: `model`.
    const NOUN: &'static str;

    /// Name in files and on the command line.
    fn name(&self) -> &'static str;

    /// Other names of the same.
    fn aliases(&self) -> &'static [Alias] {
        &[]
    }

    /// Parameters that a user may give.
    fn parameters(&self) -> &'static [ParameterDescriptor] {
        &[]
    }

    /// The parameter of this name.
    ///
    /// # Errors
    /// [`DefinitionError::UnknownParameter`].
    fn parameter(&self, name: &str) -> Result<&'static ParameterDescriptor, DefinitionError> {
        let known = self.parameters();
        known
            .iter()
            .find(|p| p.name == name)
            .ok_or_else(|| DefinitionError::UnknownParameter {
                noun: Self::NOUN,
                owner: self.name(),
                parameter: name.to_owned(),
                known: known.iter().map(|p| p.name).collect(),
            })
    }

    /// The default of the parameter of this name, if it has one.
    fn default_of(&self, name: &str) -> Option<f64> {
        let known = self.parameters().iter().find(|p| p.name == name);
        known.and_then(|p| p.default)
    }

    /// Refuses a value (SI) that the parameter of this name does not allow.
    ///
    /// # Errors
    /// [`DefinitionError::UnknownParameter`], [`DefinitionError::OutOfRange`].
    fn check_value(&self, name: &str, value: f64) -> Result<(), DefinitionError> {
        let parameter = self.parameter(name)?;
        if parameter.allows(value) {
            return Ok(());
        }
        Err(self.out_of_range(parameter, value, parameter.range()))
    }

    /// A value (SI) of a parameter outside a range.
    fn out_of_range(
        &self,
        parameter: &ParameterDescriptor,
        value: f64,
        range: String,
    ) -> DefinitionError {
        DefinitionError::OutOfRange {
            noun: Self::NOUN,
            owner: self.name(),
            parameter: parameter.name,
            value,
            range,
            explanation: parameter.explanation,
        }
    }

    /// A parameter, or one of alternatives, that is not given.
    fn missing(&self, parameter: impl Into<String>) -> DefinitionError {
        DefinitionError::MissingParameter {
            noun: Self::NOUN,
            owner: self.name(),
            parameter: parameter.into(),
        }
    }
}

/// Another name of the same.
#[derive(Debug, Clone, Copy)]
pub struct Alias {
    /// Name, accepted wherever the own one is.
    pub name: &'static str,
    /// Author, year, journal; or why the name is common.
    pub citation: &'static str,
}

/// How far an implementation has been checked.
///
/// Displayed with what was seen or is uncertain: `from secondary sources: ...`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verification {
    /// Checked against what the text names, or seen in it.
    Verified(&'static str),
    /// The formula, its constants or the rules come from secondary sources; the text says what
    /// was checked.
    SecondarySources(&'static str),
    /// Not compared with a text: check the source before it enters a design report.
    Unverified(&'static str),
}

impl Verification {
    /// In a word or two: `verified`, `secondary sources`, `unverified`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Verified(_) => "verified",
            Self::SecondarySources(_) => "secondary sources",
            Self::Unverified(_) => "unverified",
        }
    }

    /// What was seen or checked, or what is uncertain.
    #[must_use]
    pub fn remark(self) -> &'static str {
        match self {
            Self::Verified(how) | Self::SecondarySources(how) | Self::Unverified(how) => how,
        }
    }

    /// As displayed, for Markdown: what is not verified in bold.
    #[must_use]
    pub fn markdown(self) -> String {
        match self {
            Self::Verified(_) => self.to_string(),
            _ => format!("**{}**: {}", self.status(), self.remark()),
        }
    }

    fn status(self) -> &'static str {
        match self {
            Self::Verified(_) => "verified against",
            Self::SecondarySources(_) => "from secondary sources",
            Self::Unverified(_) => "unverified",
        }
    }

    /// Whether it was checked.
    #[must_use]
    pub fn is_verified(self) -> bool {
        matches!(self, Self::Verified(_))
    }
}

impl fmt::Display for Verification {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.status(), self.remark())
    }
}

/// Unit of a parameter or constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterUnit {
    /// Dimensionless.
    One,
    /// N.
    Newton,
    /// N/m.
    NewtonPerMetre,
    /// N/m^n with the exponent n of a spring.
    NewtonPerMetreToExponent,
    /// N/m^(2+alpha) with the exponent alpha of a density of sliders.
    NewtonPerMetreToTwoPlusExponent,
    /// N s/m.
    NewtonSecondPerMetre,
    /// N (s/m)^a with the exponent a of a damper.
    NewtonSecondPerMetreToExponent,
    /// s/m.
    SecondPerMetre,
    /// m.
    Metre,
    /// m/s.
    MetrePerSecond,
    /// s.
    Second,
}

impl ParameterUnit {
    /// The unit in characters, with the symbol of a free exponent.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::One => "-",
            Self::Newton => "N",
            Self::NewtonPerMetre => "N/m",
            Self::NewtonPerMetreToExponent => "N/m^n",
            Self::NewtonPerMetreToTwoPlusExponent => "N/m^(2+alpha)",
            Self::NewtonSecondPerMetre => "N s/m",
            Self::NewtonSecondPerMetreToExponent => "N (s/m)^a",
            Self::SecondPerMetre => "s/m",
            Self::Metre => "m",
            Self::MetrePerSecond => "m/s",
            Self::Second => "s",
        }
    }

    /// The unit as files and arguments take it, the exponent of the law in figures: `N/m^1.5`; empty of a pure number.
    #[must_use]
    pub fn with_exponent(self, exponent: f64) -> String {
        // Sums of decimal powers carry noise that no reader wants to see.
        let power = |power: f64| match (power * 1e9).round() / 1e9 {
            1.0 => String::new(),
            power => format!("^{power}"),
        };
        match self {
            Self::One => String::new(),
            Self::NewtonPerMetreToExponent => format!("N/m{}", power(exponent)),
            Self::NewtonPerMetreToTwoPlusExponent => format!("N/m{}", power(2.0 + exponent)),
            Self::NewtonSecondPerMetreToExponent => format!("N s{0}/m{0}", power(exponent)),
            unit => unit.symbol().to_owned(),
        }
    }
}

/// One parameter that a user may give.
#[derive(Debug, Clone, Copy)]
pub struct ParameterDescriptor {
    /// Key in the case file, spelled out.
    pub name: &'static str,
    /// SI unit.
    pub unit: ParameterUnit,
    /// Least allowed value and whether it is allowed itself.
    pub minimum: (f64, bool),
    /// Maximum allowed value and whether it is allowed itself.
    pub maximum: (f64, bool),
    /// Value when the user gives none; `None`: the parameter is required, is one of a pair of
    /// alternatives, or has no effect unless given (see `explanation`).
    pub default: Option<f64>,
    /// Whether it must be given.
    pub required: bool,
    /// What it is, in a sentence.
    pub explanation: &'static str,
}

impl ParameterDescriptor {
    /// Whether a value lies in the range.
    #[must_use]
    pub fn allows(&self, value: f64) -> bool {
        let ((low, low_in), (high, high_in)) = (self.minimum, self.maximum);
        value.is_finite()
            && (value > low || (low_in && value == low))
            && (value < high || (high_in && value == high))
    }

    /// The range in mathematical brackets.
    #[must_use]
    pub fn range(&self) -> String {
        let ((low, low_in), (high, high_in)) = (self.minimum, self.maximum);
        format!(
            "{}{low}, {high}{}",
            if low_in { '[' } else { '(' },
            if high_in { ']' } else { ')' }
        )
    }

    /// The same with this range, ends included where the flag says so.
    #[must_use]
    pub const fn within(mut self, minimum: (f64, bool), maximum: (f64, bool)) -> Self {
        self.minimum = minimum;
        self.maximum = maximum;
        self
    }

    /// The same with a default, so that it may be left out.
    #[must_use]
    pub const fn default_to(mut self, value: f64) -> Self {
        self.default = Some(value);
        self.required = false;
        self
    }
}

/// A parameter that is positive and must be given.
#[must_use]
pub const fn positive(
    name: &'static str,
    unit: ParameterUnit,
    explanation: &'static str,
) -> ParameterDescriptor {
    ParameterDescriptor {
        name,
        unit,
        minimum: (0.0, false),
        maximum: (f64::INFINITY, false),
        default: None,
        required: true,
        explanation,
    }
}

/// A parameter that is zero or more and must be given.
#[must_use]
pub const fn non_negative(
    name: &'static str,
    unit: ParameterUnit,
    explanation: &'static str,
) -> ParameterDescriptor {
    positive(name, unit, explanation).within((0.0, true), (f64::INFINITY, false))
}

/// A parameter that is positive and may be left out.
#[must_use]
pub const fn optional_positive(
    name: &'static str,
    unit: ParameterUnit,
    explanation: &'static str,
) -> ParameterDescriptor {
    ParameterDescriptor {
        required: false,
        ..positive(name, unit, explanation)
    }
}

/// A parameter that is zero or more and may be left out.
#[must_use]
pub const fn optional_non_negative(
    name: &'static str,
    unit: ParameterUnit,
    explanation: &'static str,
) -> ParameterDescriptor {
    ParameterDescriptor {
        required: false,
        ..non_negative(name, unit, explanation)
    }
}
