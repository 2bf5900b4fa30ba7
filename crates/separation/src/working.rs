//! The working of a provision: every factor with its number.

use pounding_catalogue::numbers::rounded_up;

use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};

/// One number that went into a gap.
#[derive(Debug, Clone, PartialEq)]
pub struct Factor {
    /// Name, with the structure it belongs to.
    pub name: String,
    /// Value in the unit.
    pub value: f64,
    /// Unit.
    pub unit: &'static str,
}

/// The gap that a provision requires.
#[derive(Debug, Clone, PartialEq)]
pub struct Requirement {
    /// Width (m), with the relative displacement of the ground where that is not zero.
    pub width: f64,
    /// Everything that went into it, in the order of use.
    pub factors: Vec<Factor>,
    /// Formula, factors and result in a line, with the caution.
    pub explanation: String,
    /// Why the width decides nothing: the code multiplies the displacement of an elastic
    /// analysis, and the one given is that of a structure that yields. `None` for a width
    /// that holds.
    pub caution: Option<String>,
    /// What each reading of a disputed provision requires; none of any other. A width with
    /// readings is that of the widest, and decides nothing.
    pub readings: Vec<ReadingWidth>,
}

/// The width by one reading of a disputed provision.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadingWidth {
    /// Whose reading it is.
    pub text: &'static str,
    /// Width (m).
    pub width: f64,
}

impl Requirement {
    /// What every reading of it asks for (m); of a provision that is not disputed its width.
    #[must_use]
    pub fn least(&self) -> f64 {
        let readings = self.readings.iter().map(|reading| reading.width);
        readings.fold(self.width, f64::min)
    }

    /// Why the width decides nothing: a caution, or a dispute. `None` for one that holds.
    #[must_use]
    pub fn undecided(&self) -> Option<String> {
        if let Some(caution) = &self.caution {
            return Some(caution.clone());
        }
        let (first, rest) = self.readings.split_first()?;
        let rest = rest
            .iter()
            .map(|r| format!("{} mm by {}", rounded_up(r.width * 1e3, 1), r.text));
        Some(format!(
            "the texts differ: {} mm by {}, {}; none is chosen",
            rounded_up(first.width * 1e3, 1),
            first.text,
            rest.collect::<Vec<_>>().join(", ")
        ))
    }
}

/// Collects factors and complains of missing ones.
#[derive(Debug)]
pub(crate) struct Working {
    provision: String,
    /// What to do where it does not apply, beside a wall or between buildings, but rules that were
    /// tried.
    remedy: Remedy,
    factors: Vec<Factor>,
}

type Remedy = fn(&str, bool, &[&str]) -> String;
type Number = Result<f64, SeparationError>;

impl Working {
    pub(crate) fn new(provision: &str, remedy: Remedy) -> Self {
        Self {
            provision: provision.to_owned(),
            remedy,
            factors: Vec::new(),
        }
    }

    /// The requirement with its explanation: the width by the code, and what the ground on
    /// both sides of the gap adds to it. A negative zero is zero.
    pub(crate) fn finish(
        mut self,
        formula: &str,
        (width, site): (f64, &Site),
        caution: Option<String>,
    ) -> Result<Requirement, SeparationError> {
        let (mut formula, mut width) = (formula.to_owned(), width);
        let ground = site.relative_ground_displacement;
        if !(ground.is_finite() && ground >= 0.0) {
            return Err(SeparationError::OutOfRange {
                quantity: "relative ground displacement",
                value: ground,
                range: "[0, inf)",
            });
        }
        if ground > 0.0 {
            formula.push_str(", plus the relative displacement of the ground u_g");
            width += self.note("u_g", ground, "m");
        }
        // Factors far out of their range: no width is that of a code then.
        if !width.is_finite() {
            return Err(SeparationError::OutOfRange {
                quantity: "width",
                value: width,
                range: "[0, inf)",
            });
        }
        width = unsigned_zero(width);
        let factors: Vec<String> = self.factors.iter().map(shown).collect();
        let asked = rounded_up(width * 1e3, 1);
        let mut explanation = format!("{formula}; {}; {asked} mm", factors.join(", "));
        if let Some(caution) = &caution {
            explanation.push_str(&format!("; not valid: {caution}"));
        }
        Ok(Requirement {
            width,
            factors: self.factors,
            explanation,
            caution,
            readings: Vec::new(),
        })
    }

    /// The distances of both sides from the border, summed.
    pub(crate) fn summed(&mut self, left: f64, right: f64) -> f64 {
        self.note("own side, left", left, "m") + self.note("own side, right", right, "m")
    }

    /// Notes a number and hands it on.
    pub(crate) fn note(&mut self, name: impl Into<String>, value: f64, unit: &'static str) -> f64 {
        let (name, value) = (name.into(), unsigned_zero(value));
        let known = |f: &Factor| f.name == name && f.value == value;
        if !self.factors.iter().any(known) {
            self.factors.push(Factor { name, value, unit });
        }
        value
    }

    pub(crate) fn not_applicable(&self, reason: impl Into<String>) -> SeparationError {
        SeparationError::NotApplicable {
            provision: self.provision.clone(),
            reason: reason.into(),
            remedy: (self.remedy)(&self.provision, false, &[]),
        }
    }

    /// The error of a rule between buildings beside a wall.
    pub(crate) fn needs_a_neighbour(&self) -> SeparationError {
        SeparationError::NotApplicable {
            provision: self.provision.clone(),
            reason: "it needs a building on either side".to_owned(),
            remedy: (self.remedy)(&self.provision, true, &[]),
        }
    }

    /// A value that must be given.
    pub(crate) fn need<T>(
        &self,
        value: Option<T>,
        input: Input,
        structure: &str,
    ) -> Result<T, SeparationError> {
        value.ok_or_else(|| SeparationError::MissingInput {
            provision: self.provision.clone(),
            input,
            structure: structure.to_owned(),
        })
    }

    fn of(&mut self, s: &Structure, value: Option<f64>, input: Input, symbol: &str) -> Number {
        let value = self.need(value, input, &s.name)?;
        if !(value.is_finite() && value > 0.0) {
            return Err(SeparationError::OutOfRange {
                quantity: input.key(),
                value,
                range: "(0, inf)",
            });
        }
        Ok(self.note(format!("{symbol}({})", s.name), value, "-"))
    }

    /// Peak displacement `u`, not reduced (m).
    pub(crate) fn displacement(&mut self, s: &Structure) -> Number {
        let value = self.need(s.displacement, Input::Displacement, &s.name)?;
        let allowed = value.is_finite() && value >= 0.0;
        if !allowed {
            return Err(SeparationError::OutOfRange {
                quantity: "displacement",
                value,
                range: "[0, inf)",
            });
        }
        Ok(self.note(format!("u({})", s.name), value, "m"))
    }

    /// Square root of the sum of squares of what both structures have.
    pub(crate) fn root_of_squares(
        &mut self,
        situation: &Situation,
        of: fn(&mut Self, &Structure) -> Number,
    ) -> Number {
        let left = of(self, &situation.left)?;
        let right = of(self, &situation.right)?;
        Ok(libm::hypot(left, right))
    }

    /// `R` (-).
    pub(crate) fn response_modification(&mut self, s: &Structure) -> Number {
        self.of(s, s.response_modification, Input::ResponseModification, "R")
    }

    /// `Cd` (-).
    pub(crate) fn displacement_amplification(&mut self, s: &Structure) -> Number {
        let input = Input::DisplacementAmplification;
        self.of(s, s.displacement_amplification, input, "Cd")
    }

    /// `I` (-).
    pub(crate) fn importance(&mut self, s: &Structure) -> Number {
        self.of(s, s.importance, Input::Importance, "I")
    }

    /// `alpha_y` (-).
    pub(crate) fn yield_amplification(&mut self, s: &Structure) -> Number {
        let input = Input::YieldAmplification;
        self.of(s, s.yield_amplification, input, "alpha_y")
    }

    /// `R d`, with the displacement `d` under reduced forces: `R` times that where it is
    /// known, else `I u`, in which `R` cancels (m).
    pub(crate) fn restored(&mut self, s: &Structure) -> Number {
        let value = match s.elastic_displacement {
            Some(d) => {
                let d = self.note(format!("d({})", s.name), d, "m");
                self.response_modification(s)? * d
            }
            None => self.importance(s)? * self.displacement(s)?,
        };
        Ok(value)
    }

    /// `I u`, the displacement that design forces would cause without their reduction (m), `u` where no `I` is given: for
    /// codes whose factor is a part of `R`, of which the whole is taken.
    pub(crate) fn unreduced(&mut self, s: &Structure) -> Number {
        let displacement = self.displacement(s)?;
        Ok(match s.importance {
            Some(_) => self.importance(s)? * displacement,
            None => displacement,
        })
    }

    /// Whether the floors of both structures lie at equal elevations.
    pub(crate) fn floors_aligned(&mut self, site: &Site) -> Result<bool, SeparationError> {
        self.need(site.floors_aligned, Input::FloorsAligned, "")
    }

    /// `h` of one building: the elevation of its own floor at the level (m).
    pub(crate) fn elevation(&mut self, s: &Structure) -> f64 {
        self.note(format!("h({})", s.name), s.elevation, "m")
    }

    /// `h` of a rule between two buildings that has one height (m): the elevation of the level, and
    /// of floors that differ the higher one. No text that was seen speaks of such floors, and no
    /// rule asks for less at a greater height.
    pub(crate) fn common_elevation(&mut self, situation: &Situation) -> f64 {
        let Situation { left, right, .. } = situation;
        if left.elevation == right.elevation {
            return self.note("h", left.elevation, "m");
        }
        let higher = self.elevation(left).max(self.elevation(right));
        self.note("h of the higher floor", higher, "m")
    }
}

/// The value, with zero for a negative zero, as rounded and negated expressions of users give.
fn unsigned_zero(value: f64) -> f64 {
    value + 0.0
}

fn shown(factor: &Factor) -> String {
    let Factor { name, value, unit } = factor;
    match *unit {
        "m" => format!("{name} = {value:.6} m"),
        "-" => format!("{name} = {value}"),
        unit => format!("{name} = {value} {unit}"),
    }
}
