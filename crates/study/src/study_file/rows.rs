//! Values that are tried in the case once all variables are known: rows of a list of which the case refuses a value
//! alone, and random numbers as far from the middle as so many runs have them.

use std::ops::Range;

use pounding_assembly::{AssemblyError, assemble_at_rest};
use pounding_case::document::Reader;
use pounding_case::{CaseError, CaseTree};

use super::context::{Base, Context};
use super::{Design, Value, Values, Variable};
use crate::case_text::{Edit, Variant};

/// Why a case cannot be read or assembled.
pub(super) enum Refused {
    /// Of its text, with the place in it.
    Text(CaseError),
    /// Of a file that it names, or of all of it.
    Whole(AssemblyError),
}

impl Refused {
    /// The message, and what helps.
    pub(super) fn into_message(self) -> (String, Option<String>) {
        match self {
            Self::Text(error) => (error.message, error.help),
            Self::Whole(error) => (error.to_string(), error.help()),
        }
    }
}

/// Reads and assembles a case with these edits, without its record.
pub(super) fn tried(tree: &CaseTree<'_>, edits: &[Edit]) -> Result<(), Refused> {
    let variant = Variant::new(tree, edits);
    let case = variant.case().map_err(Refused::Text)?;
    match variant.make(&case, assemble_at_rest) {
        Ok(_) => Ok(()),
        Err(AssemblyError::Case(error)) => Err(Refused::Text(error)),
        Err(error) => Err(Refused::Whole(error)),
    }
}

/// Whether the case takes every row of a list, where it refuses a value of one alone.
pub(super) fn taken(
    reader: &Reader<'_>,
    context: &Context,
    (variables, design): (&[Variable], &Design),
) -> Option<()> {
    let Some(place) = context.refused_alone.borrow().first().cloned() else {
        return Some(());
    };
    let Base { case, .. } = context.base.as_ref()?;
    let tree = CaseTree::parse(&case.source, &case.file).ok()?;
    for run in 0..design.runs() {
        let point = design.point(run, variables);
        let values = || variables.iter().zip(&point);
        let edits: Vec<Edit> = values().flat_map(|(v, x)| v.target.edits(x)).collect();
        if let Err(refused) = tried(&tree, &edits) {
            let (message, help) = refused.into_message();
            let row: Vec<String> = values().map(|(v, x)| v.without_unit(x)).collect();
            let message = format!(
                "the case refuses run {run} of the list ({}): {message}",
                row.join(", ")
            );
            return reader.refuse(place, message, help.unwrap_or_default());
        }
    }
    Some(())
}

/// Whether the case takes random numbers of variables, whose tables stand at these places, that lie as far out as one
/// of so many has them on the average.
pub(super) fn ends_taken(
    reader: &Reader<'_>,
    context: &Context,
    (variables, tables): (&[Variable], &[Range<usize>]),
    samples: usize,
) -> Option<()> {
    let Base { case, .. } = context.base.as_ref()?;
    let tree = CaseTree::parse(&case.source, &case.file).ok()?;
    let part = 0.5 / samples as f64;
    let mut sound = Some(());
    for (variable, table) in variables.iter().zip(tables) {
        let Values::Random(distribution) = &variable.values else {
            continue;
        };
        for (probability, bound) in [(part, "lower"), (1.0 - part, "upper")] {
            let x = distribution.quantile(probability);
            let edits = variable.target.edits(&Value::Number(x));
            if let Err(refused) = tried(&tree, &edits) {
                let (message, of_case) = refused.into_message();
                let message = format!(
                    "the case refuses {}, which about one of {samples} runs has: {message}",
                    variable.in_words(&Value::Number(x))
                );
                let of_case =
                    of_case.map_or_else(String::new, |help| format!("; of the case: {help}"));
                let help =
                    format!("add `{bound} = ...` to the distribution, or correct it{of_case}");
                sound = reader.refuse(table.clone(), message, help);
            }
        }
    }
    sound
}
