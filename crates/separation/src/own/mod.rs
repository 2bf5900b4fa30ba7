//! Rules of users: an expression over named quantities, checked for its dimensions.

mod compile;
mod evaluate;
mod kind;
mod names;
mod table;
mod tree;

#[cfg(test)]
mod tests;

use pounding_case::{CaseError, Dimension, RuleText};

use crate::assumptions::Assumptions;
use crate::descriptor::Place;
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::remedy::where_it_does_not_apply;
use crate::working::{Requirement, Working};
use evaluate::Given;
use table::Table;
use tree::Part;

pub use names::{RuleName, rule_names};

/// A rule of a user, compiled: every name is known, and the result is a length.
#[derive(Debug, Clone)]
pub struct OwnRule {
    text: RuleText,
    /// Values of its inputs (SI) with their dimensions, by name.
    inputs: Vec<(String, f64, Dimension)>,
    tables: Vec<(String, Table)>,
    /// Those that the expression needs, each after those that it needs itself.
    definitions: Vec<(String, Part)>,
    expression: Part,
    /// What it takes of the case, in the order of use.
    needs: Vec<names::Named>,
    /// Names of its inputs, tables and definitions that the expression does not take.
    unused: Vec<String>,
}

impl OwnRule {
    /// Compiles a rule as it was read.
    ///
    /// # Errors
    /// What is wrong in it, at its place: a name that is not known, dimensions that do not fit,
    /// a definition that needs itself, an expression that is too long or nested too deeply, or a
    /// result that is no length.
    pub fn compile(text: &RuleText) -> Result<Self, CaseError> {
        compile::compile(text)
    }

    /// Name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.text.name.value
    }

    /// Country or whatever the user calls it; may be empty.
    #[must_use]
    pub fn region(&self) -> &str {
        &self.text.region
    }

    /// Edition, may be empty.
    #[must_use]
    pub fn edition(&self) -> &str {
        &self.text.edition
    }

    /// Clause, may be empty.
    #[must_use]
    pub fn clause(&self) -> &str {
        &self.text.clause
    }

    /// The file that it stands in.
    #[must_use]
    pub fn file(&self) -> &str {
        &self.text.file
    }

    /// What it measures.
    #[must_use]
    pub fn place(&self) -> Place {
        match self.text.between {
            true => Place::Between,
            false => Place::Boundary,
        }
    }

    /// The expression as written, with its definitions.
    #[must_use]
    pub fn formula(&self) -> String {
        let written = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let mut formula = written(&self.text.expression.value);
        for (name, definition) in &self.text.definitions {
            formula.push_str(&format!(
                ", {} = {}",
                name.value,
                written(&definition.value)
            ));
        }
        formula
    }

    /// Whether it takes peak displacements.
    #[must_use]
    pub fn depends_on_displacement(&self) -> bool {
        self.needs
            .iter()
            .any(|n| n.input() == Some(Input::Displacement))
    }

    /// What it needs of the case, beside heights and storeys.
    #[must_use]
    pub fn inputs(&self) -> Vec<Input> {
        let mut inputs = Vec::new();
        for input in self.needs.iter().filter_map(names::Named::input) {
            if !inputs.contains(&input) {
                inputs.push(input);
            }
        }
        inputs
    }

    /// What it takes for granted.
    #[must_use]
    pub fn assumptions(&self) -> Assumptions {
        let needs = |input| self.inputs().contains(&input);
        let says = |yes: bool, one: &str, other: &str| if yes { one } else { other }.to_owned();
        let height = self.needs.iter().any(names::Named::is_height);
        // A misspelled least width is none.
        let mut others = self.text.assumptions.clone();
        others.extend(self.unused.iter().map(|name| {
            format!("the expression does not take \"{name}\", which is given: check the name")
        }));
        Assumptions {
            displacement: says(
                self.depends_on_displacement(),
                "the unreduced peak u of the run",
                "none is taken",
            ),
            height: says(
                height,
                "above ground, as the elevations of the case",
                "none is taken",
            ),
            ownership: says(
                needs(Input::SameOwner),
                "asks whether a property line lies in the gap",
                "the rule does not ask who owns the ground",
            ),
            alignment: says(
                needs(Input::FloorsAligned),
                "asks whether all floors up to the lower roof face floors",
                "does not ask whether floors face floors",
            ),
            others,
        }
    }

    /// Distance of one building from the border of its site (m).
    ///
    /// # Errors
    /// An input that is missing, a rule that holds between two buildings, or an expression that
    /// has no value for these inputs.
    pub fn boundary(
        &self,
        structure: &Structure,
        site: &Site,
    ) -> Result<Requirement, SeparationError> {
        let mut working = Working::new(self.name(), where_it_does_not_apply);
        if self.text.between {
            return Err(working.needs_a_neighbour());
        }
        let given = Given::One { structure, site };
        let width = evaluate::width(self, &given, &mut working)?;
        working.finish(&self.formula(), (width, site), None)
    }

    /// Distance between two buildings (m). A boundary rule gives the sum of the
    /// distances that either building keeps from the border.
    ///
    /// # Errors
    /// An input that is missing, or an expression that has no value for these inputs.
    pub fn between(&self, situation: &Situation) -> Result<Requirement, SeparationError> {
        let mut working = Working::new(self.name(), where_it_does_not_apply);
        let site = &situation.site;
        if self.text.between {
            let width = evaluate::width(self, &Given::Both(situation), &mut working)?;
            return working.finish(&self.formula(), (width, site), None);
        }
        let mut side = |structure: &Structure| {
            let given = Given::One { structure, site };
            evaluate::width(self, &given, &mut working)
        };
        let (left, right) = (side(&situation.left)?, side(&situation.right)?);
        let width = working.summed(left, right);
        let formula = format!("{}, summed over both sides", self.formula());
        working.finish(&formula, (width, site), None)
    }
}

/// The value of an arithmetic expression of numbers alone, as worked examples are written.
///
/// # Errors
/// An expression that is wrong, uses names, or has no value.
pub fn arithmetic(expression: &str) -> Result<f64, String> {
    let rule = compile::numbers(expression).map_err(|e| e.to_string())?;
    let situation = Situation::default();
    let mut working = Working::new("arithmetic", where_it_does_not_apply);
    evaluate::width(&rule, &Given::Both(&situation), &mut working).map_err(|e| e.to_string())
}
