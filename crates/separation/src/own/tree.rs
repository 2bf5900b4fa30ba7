//! Expressions as trees.

use std::ops::Range;

use cel::common::ast::operators;

use super::kind::Kind;
use super::names::Named;

/// A part of an expression, with its place in the text.
#[derive(Debug, Clone)]
pub(super) struct Part {
    pub node: Node,
    pub kind: Kind,
    /// Bytes of the text.
    pub at: Range<usize>,
    /// Most parts below one another, with definitions.
    pub depth: usize,
}

#[derive(Debug, Clone)]
pub(super) enum Node {
    Constant(f64),
    Truth(bool),
    Word(String),
    Named(Named),
    /// By its place among the inputs of the rule.
    Input(usize),
    /// By its place among the definitions that are compiled.
    Definition(usize),
    Negative(Box<Part>),
    Not(Box<Part>),
    Operation(Operator, Box<[Part; 2]>),
    Function(Function, Vec<Part>),
    /// By its place among the tables of the rule.
    Table(usize, Box<Part>),
    /// The second if the first is true, else the third.
    Choice(Box<[Part; 3]>),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Equal,
    NotEqual,
    And,
    Or,
}

impl Operator {
    /// That of this name in the language.
    pub(super) fn of(name: &str) -> Option<Self> {
        Some(match name {
            operators::ADD => Self::Add,
            operators::SUBSTRACT => Self::Subtract,
            operators::MULTIPLY => Self::Multiply,
            operators::DIVIDE => Self::Divide,
            operators::MODULO => Self::Remainder,
            operators::LESS => Self::Less,
            operators::LESS_EQUALS => Self::LessOrEqual,
            operators::GREATER => Self::Greater,
            operators::GREATER_EQUALS => Self::GreaterOrEqual,
            operators::EQUALS => Self::Equal,
            operators::NOT_EQUALS => Self::NotEqual,
            operators::LOGICAL_AND => Self::And,
            operators::LOGICAL_OR => Self::Or,
            _ => return None,
        })
    }

    pub(super) fn symbol(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Remainder => "%",
            Self::Less => "<",
            Self::LessOrEqual => "<=",
            Self::Greater => ">",
            Self::GreaterOrEqual => ">=",
            Self::Equal => "==",
            Self::NotEqual => "!=",
            Self::And => "&&",
            Self::Or => "||",
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Function {
    SquareRoot,
    Absolute,
    Ceiling,
    Floor,
    Power,
    Maximum,
    Minimum,
}

impl Function {
    pub(super) const ALL: [(&'static str, Self); 7] = [
        ("sqrt", Self::SquareRoot),
        ("abs", Self::Absolute),
        ("ceil", Self::Ceiling),
        ("floor", Self::Floor),
        ("pow", Self::Power),
        ("max", Self::Maximum),
        ("min", Self::Minimum),
    ];

    pub(super) fn of(name: &str) -> Option<Self> {
        let found = Self::ALL.iter().find(|(known, _)| *known == name)?;
        Some(found.1)
    }
}
