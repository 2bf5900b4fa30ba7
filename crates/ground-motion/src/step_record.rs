//! What was done to a record, with its numbers.

use std::borrow::Cow;
use std::fmt;

use serde::{Deserialize, Serialize};

/// One number of a step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StepNumber {
    /// What it is, spelled out.
    pub name: Cow<'static, str>,
    /// Value (SI).
    pub value: f64,
    /// SI unit; `-` where there is none.
    pub unit: Cow<'static, str>,
}

/// One step of processing or generation as it was done.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StepRecord {
    /// Name of the step.
    pub step: Cow<'static, str>,
    /// What was asked for and what came of it.
    pub numbers: Vec<StepNumber>,
    /// What else the user should know.
    pub remarks: Vec<String>,
}

impl StepRecord {
    pub(crate) fn new(step: &'static str) -> Self {
        Self {
            step: step.into(),
            numbers: Vec::new(),
            remarks: Vec::new(),
        }
    }

    pub(crate) fn number(mut self, name: &'static str, value: f64, unit: &'static str) -> Self {
        self.numbers.push(StepNumber {
            name: name.into(),
            value,
            unit: unit.into(),
        });
        self
    }

    pub(crate) fn remark(mut self, text: impl Into<String>) -> Self {
        self.remarks.push(text.into());
        self
    }

    /// The value of this name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<f64> {
        self.numbers
            .iter()
            .find(|n| n.name == name)
            .map(|n| n.value)
    }
}

impl fmt::Display for StepRecord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.step)?;
        for (i, n) in self.numbers.iter().enumerate() {
            let start = if i == 0 { ": " } else { ", " };
            write!(f, "{start}{} {}", n.name, n.value)?;
            if n.unit != "-" {
                write!(f, " {}", n.unit)?;
            }
        }
        for remark in &self.remarks {
            write!(f, "; {remark}")?;
        }
        Ok(())
    }
}
