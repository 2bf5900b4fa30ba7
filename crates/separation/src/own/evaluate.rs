//! The value of a rule for a situation.

use super::OwnRule;
use super::compile::shortened;
use super::names::{Meaning, Named, Of};
use super::tree::{Function, Node, Operator, Part};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, SoilZone, Structure};
use crate::working::Working;
use pounding_case::Dimension;
use pounding_catalogue::STANDARD_GRAVITY;

/// What a rule is applied to.
pub(super) enum Given<'g> {
    One {
        structure: &'g Structure,
        site: &'g Site,
    },
    Both(&'g Situation),
}

/// The value of a part.
#[derive(Debug, Clone, PartialEq)]
enum Value {
    Number(f64),
    Truth(bool),
    Word(&'static str),
}

struct Evaluation<'g> {
    rule: &'g OwnRule,
    given: &'g Given<'g>,
    working: &'g mut Working,
    definitions: Vec<Option<Value>>,
    /// The text that is evaluated, and what it is called.
    text: (&'g str, String),
}

/// Width (m) that is taken for none.
const ROUND_OFF: f64 = 1.0e-9;

/// The width (m) that a rule asks for.
pub(super) fn width(
    rule: &OwnRule,
    given: &Given<'_>,
    working: &mut Working,
) -> Result<f64, SeparationError> {
    let mut evaluation = Evaluation {
        rule,
        given,
        working,
        definitions: vec![None; rule.definitions.len()],
        text: (&rule.text.expression.value, "expression".to_owned()),
    };
    let width = evaluation.number(&rule.expression)?;
    // Differences of equal lengths leave round-off.
    if (-ROUND_OFF..0.0).contains(&width) {
        return Ok(0.0);
    }
    if width < 0.0 {
        let message = format!("the width is negative ({:.3} mm)", width * 1e3);
        return Err(evaluation.refused(&rule.expression, message));
    }
    Ok(width)
}

impl<'g> Evaluation<'g> {
    fn refused(&self, part: &Part, message: impl Into<String>) -> SeparationError {
        let (text, of) = &self.text;
        let before = text.get(..part.at.start).unwrap_or_default();
        SeparationError::Expression {
            provision: self.rule.name().to_owned(),
            message: message.into(),
            part: shortened(text.get(part.at.clone()).unwrap_or_default()),
            character: before.chars().count() + 1,
            of: of.clone(),
        }
    }

    fn number(&mut self, part: &Part) -> Result<f64, SeparationError> {
        match self.value(part)? {
            Value::Number(value) if value.is_finite() => Ok(value),
            Value::Number(_) => Err(self.refused(part, "the value is not finite")),
            _ => Err(self.refused(part, "this is no number")),
        }
    }

    fn truth(&mut self, part: &Part) -> Result<bool, SeparationError> {
        match self.value(part)? {
            Value::Truth(value) => Ok(value),
            _ => Err(self.refused(part, "this is neither true nor false")),
        }
    }

    fn value(&mut self, part: &Part) -> Result<Value, SeparationError> {
        let value = match &part.node {
            Node::Constant(value) => *value,
            Node::Truth(value) => return Ok(Value::Truth(*value)),
            Node::Word(word) => return Ok(Value::Word(known_word(word))),
            Node::Named(named) => return self.named(part, *named),
            Node::Input(i) => {
                let (name, value, dimension) = &self.rule.inputs[*i];
                let unit = unit(*dimension);
                self.working.note(name.clone(), *value, unit)
            }
            Node::Definition(i) => return self.defined(*i),
            Node::Negative(one) => -self.number(one)?,
            Node::Not(one) => return Ok(Value::Truth(!self.truth(one)?)),
            Node::Operation(operator, two) => return self.operation(part, *operator, two),
            Node::Function(function, arguments) => self.function(part, *function, arguments)?,
            Node::Table(i, one) => {
                let at = self.number(one)?;
                let (name, table) = &self.rule.tables[*i];
                match table.value(at) {
                    Ok(value) => value,
                    Err((from, to)) => {
                        let message = format!(
                            "{at} lies outside the table {name}, which goes from {from} to {to}"
                        );
                        return Err(self.refused(part, message));
                    }
                }
            }
            Node::Choice(three) => {
                let [condition, yes, no] = &**three;
                let taken = if self.truth(condition)? { yes } else { no };
                return self.value(taken);
            }
        };
        Ok(Value::Number(value))
    }

    /// A definition is computed once, where it is needed first.
    fn defined(&mut self, i: usize) -> Result<Value, SeparationError> {
        if let Some(value) = &self.definitions[i] {
            return Ok(value.clone());
        }
        let rule = self.rule;
        let (name, part) = &rule.definitions[i];
        let mut written = rule.text.definitions.iter();
        let written = written.find(|(known, _)| known.value == *name);
        let text = written.map_or("", |(_, text)| text.value.as_str());
        let outer = std::mem::replace(&mut self.text, (text, format!("definition \"{name}\"")));
        let value = self.value(part)?;
        if let Value::Number(number) = value {
            if !number.is_finite() {
                return Err(self.refused(part, "the value is not finite"));
            }
            let unit = match part.kind {
                super::kind::Kind::Number(dimension) => unit(dimension),
                _ => "-",
            };
            self.working.note(name.clone(), number, unit);
        }
        self.text = outer;
        self.definitions[i] = Some(value.clone());
        Ok(value)
    }

    fn operation(
        &mut self,
        part: &Part,
        operator: Operator,
        [left, right]: &[Part; 2],
    ) -> Result<Value, SeparationError> {
        if matches!(operator, Operator::And | Operator::Or) {
            let first = self.truth(left)?;
            let enough = first == (operator == Operator::Or);
            return Ok(Value::Truth(if enough {
                first
            } else {
                self.truth(right)?
            }));
        }
        if matches!(operator, Operator::Equal | Operator::NotEqual) {
            let equal = self.value(left)? == self.value(right)?;
            return Ok(Value::Truth(equal == (operator == Operator::Equal)));
        }
        let (a, b) = (self.number(left)?, self.number(right)?);
        let value = match operator {
            Operator::Add => a + b,
            Operator::Subtract => a - b,
            Operator::Multiply => a * b,
            Operator::Divide | Operator::Remainder if b == 0.0 => {
                return Err(self.refused(right, "this is zero, and divides"));
            }
            Operator::Divide => a / b,
            Operator::Remainder => a % b,
            Operator::Less => return Ok(Value::Truth(a < b)),
            Operator::LessOrEqual => return Ok(Value::Truth(a <= b)),
            Operator::Greater => return Ok(Value::Truth(a > b)),
            Operator::GreaterOrEqual => return Ok(Value::Truth(a >= b)),
            Operator::Equal | Operator::NotEqual | Operator::And | Operator::Or => f64::NAN,
        };
        if !value.is_finite() {
            return Err(self.refused(part, "the value is not finite"));
        }
        Ok(Value::Number(value))
    }

    fn function(
        &mut self,
        part: &Part,
        function: Function,
        arguments: &[Part],
    ) -> Result<f64, SeparationError> {
        let values = arguments.iter().map(|a| self.number(a));
        let values = values.collect::<Result<Vec<f64>, _>>()?;
        let first = values.first().copied().unwrap_or(f64::NAN);
        let value = match function {
            Function::SquareRoot if first < 0.0 => {
                return Err(self.refused(part, format!("the root of a negative value ({first})")));
            }
            Function::SquareRoot => first.sqrt(),
            Function::Power => {
                let value = libm::pow(first, values.get(1).copied().unwrap_or(f64::NAN));
                if !value.is_finite() {
                    return Err(self.refused(part, "the power has no finite value"));
                }
                value
            }
            Function::Absolute => first.abs(),
            // A whole number but for round-off is one.
            Function::Ceiling => (first - 1.0e-9).ceil(),
            Function::Floor => (first + 1.0e-9).floor(),
            Function::Maximum => values.iter().copied().fold(first, f64::max),
            Function::Minimum => values.iter().copied().fold(first, f64::min),
        };
        Ok(value)
    }

    /// What the case says of a name.
    fn named(&mut self, part: &Part, named: Named) -> Result<Value, SeparationError> {
        let of_site = |site: &Site| {
            Some(match named.meaning {
                Meaning::Gravity => Some(Value::Number(STANDARD_GRAVITY)),
                Meaning::FloorsAligned => site.floors_aligned.map(Value::Truth),
                Meaning::SameOwner => site.same_owner.map(Value::Truth),
                Meaning::NeighbourHasGap => site.neighbour_has_gap.map(Value::Truth),
                Meaning::FortificationIntensity => site
                    .fortification_intensity
                    .map(|i| Value::Number(f64::from(i))),
                Meaning::SoilZone => site.soil_zone.map(|zone| {
                    Value::Number(match zone {
                        SoilZone::One => 1.0,
                        SoilZone::Two => 2.0,
                        SoilZone::Three => 3.0,
                    })
                }),
                Meaning::DesignGroundAcceleration => {
                    site.design_ground_acceleration.map(Value::Number)
                }
                Meaning::SeismicCoefficient => site.seismic_coefficient.map(Value::Number),
                Meaning::SpectralAcceleration => site.spectral_acceleration_1s.map(Value::Number),
                _ => return None,
            })
        };
        let value = match self.given {
            Given::One { structure, site } => match of_site(site) {
                Some(value) => self.needed(named, value, "")?,
                None => self.needed(named, of_structure(structure, named), &structure.name)?,
            },
            Given::Both(Situation { left, right, site }) => match (of_site(site), named.of) {
                (Some(value), _) => self.needed(named, value, "")?,
                (None, Of::Left) => self.needed(named, of_structure(left, named), &left.name)?,
                (None, Of::Right) => self.needed(named, of_structure(right, named), &right.name)?,
                (None, Of::All) => {
                    let a = self.needed(named, of_structure(left, named), &left.name)?;
                    let b = self.needed(named, of_structure(right, named), &right.name)?;
                    if a != b {
                        let name = named.name();
                        let message = format!(
                            "`{name}` is not the same for both buildings: write {name}_left and {name}_right"
                        );
                        return Err(self.refused(part, message));
                    }
                    a
                }
            },
        };
        if let Value::Number(number) = value {
            // Only displacements and what users give by hand can be out of range.
            if !number.is_finite() || (named.meaning == Meaning::Displacement && number < 0.0) {
                return Err(SeparationError::OutOfRange {
                    quantity: "displacement",
                    value: number,
                    range: "[0, inf)",
                });
            }
            let name = match (self.given, named.of) {
                // Both buildings in turn give a boundary rule its values.
                (Given::One { structure, .. }, _)
                    if named.is_of_building() && !structure.name.is_empty() =>
                {
                    format!("{}({})", named.name(), structure.name)
                }
                _ => named.name(),
            };
            self.working.note(name, number, named.unit());
        }
        Ok(value)
    }

    fn needed(
        &self,
        named: Named,
        value: Option<Value>,
        structure: &str,
    ) -> Result<Value, SeparationError> {
        match (value, named.input()) {
            (Some(value), _) => Ok(value),
            (None, Some(input)) => self.working.need(None, input, structure),
            (None, None) => self.working.need(None, Input::Displacement, structure),
        }
    }
}

fn of_structure(s: &Structure, named: Named) -> Option<Value> {
    let number = match named.meaning {
        Meaning::Displacement => s.displacement,
        Meaning::Height => Some(s.elevation),
        Meaning::BuildingHeight => Some(s.height),
        Meaning::Storeys => Some(s.storeys as f64),
        Meaning::ResponseModification => s.response_modification,
        Meaning::DisplacementAmplification => s.displacement_amplification,
        Meaning::Importance => s.importance,
        Meaning::YieldAmplification => s.yield_amplification,
        Meaning::StructuralSystem => return s.system.map(|system| Value::Word(system.name())),
        Meaning::IsolationPeriod => s.isolation_period,
        Meaning::IsolationDampingCoefficient => s.isolation_damping_coefficient,
        Meaning::PlanLength => s.plan_length,
        Meaning::PlanWidth => s.plan_width,
        Meaning::PlanEccentricity => s.plan_eccentricity,
        _ => None,
    };
    number.map(Value::Number)
}

fn known_word(word: &str) -> &'static str {
    crate::inputs::StructuralSystem::from_name(word).map_or("", |system| system.name())
}

/// Unit in which a value is shown.
fn unit(dimension: Dimension) -> &'static str {
    for (known, unit) in [
        (Dimension::NUMBER, "-"),
        (Dimension::LENGTH, "m"),
        (Dimension::TIME, "s"),
        (Dimension::ACCELERATION, "m/s2"),
    ] {
        if known == dimension {
            return unit;
        }
    }
    "in SI units"
}
