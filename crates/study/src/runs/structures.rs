//! What the user should know of the structures of a study: of its case, and of what variables make of it.

use pounding_assembly::assemble_with_record;
use pounding_case::CaseTree;
use pounding_ground_motion::Accelerogram;
use pounding_time_history::{System, Warning};

use crate::case_text::Variant;
use crate::study_file::{Study, Value, Values, Variable};

/// Most choices of a variable that are looked at.
const MOST_CHOICES: usize = 40;

/// Warnings of the structures of a study: those of its case that hold in a run too, and further ones that the ends of
/// a variable, or one of its choices, bring about.
pub(super) fn warnings_of_structures(
    study: &Study,
    base: &CaseTree<'_>,
    of_case: &System,
    rest: &Accelerogram,
) -> Vec<String> {
    let said = |system: &System| -> Vec<String> {
        let warnings = Warning::of_structure(system).into_iter();
        warnings.map(|warning| warning.to_string()).collect()
    };
    let of_value = |variable: &Variable, value: &Value| {
        let edits = variable.target.edits(value);
        let variant = Variant::new(base, &edits);
        let case = variant.case().ok()?;
        let assembled = variant.make(&case, |case| assemble_with_record(case, rest));
        Some(said(&assembled.ok()?.system))
    };
    let (mut of_case, mut further) = (said(of_case), Vec::new());
    for variable in study.variables.iter().filter(|v| v.target.changes_case()) {
        let of_values = ends(&variable.values).into_iter().filter_map(|value| {
            let warnings = of_value(variable, &value)?;
            Some((value, warnings))
        });
        let of_values: Vec<_> = of_values.collect();
        let mut told: Vec<&String> = Vec::new();
        for (value, warnings) in &of_values {
            for warning in warnings {
                if !of_case.contains(warning) && !told.contains(&warning) {
                    told.push(warning);
                    further.push(format!("with {}: {warning}", variable.in_words(value)));
                }
            }
        }
        // One that another value takes away in every run is of no run.
        of_case.retain(|warning| {
            let mut values = of_values.iter();
            of_values.is_empty() || values.any(|(_, warnings)| warnings.contains(warning))
        });
    }
    of_case.into_iter().chain(further).collect()
}

/// The least and the greatest of numbers, of random ones but for a hundredth; choices all, if they are not too many.
fn ends(values: &Values) -> Vec<Value> {
    match values {
        Values::Numbers(numbers) => {
            let least = numbers.iter().copied().reduce(f64::min);
            let greatest = numbers.iter().copied().reduce(f64::max);
            let mut ends: Vec<f64> = least.into_iter().chain(greatest).collect();
            ends.dedup();
            ends.into_iter().map(Value::Number).collect()
        }
        Values::Range { from, to, .. } => vec![Value::Number(*from), Value::Number(*to)],
        Values::Random(_) => vec![values.sample(0.01), values.sample(0.99)],
        Values::Choices(names) => (0..names.len().min(MOST_CHOICES))
            .map(Value::Choice)
            .collect(),
    }
}
