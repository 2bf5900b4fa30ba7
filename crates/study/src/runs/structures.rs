//! What the user should know of the structures of a study: of its case, and of what variables make of it.

use pounding_assembly::assemble_at_rest;
use pounding_case::CaseTree;
use pounding_time_history::{System, Warning};

use crate::case_text::{Edit, Variant};
use crate::study_file::{Design, Study, Value, Values, Variable};

/// Most values of a variable, and rows of a list, that are looked at.
const MOST_CHOICES: usize = 40;

/// Most warnings that are told of the values of a variable.
const MOST_TOLD: usize = 4;

/// Warnings of the structures of a study: those of its case that hold in a run too, and further ones that values of
/// variables bring about.
pub(super) fn warnings_of_structures(
    study: &Study,
    base: &CaseTree<'_>,
    of_case: &System,
) -> Vec<String> {
    let said = |system: &System| -> Vec<String> {
        let warnings = Warning::of_structure(system).into_iter();
        warnings.map(|warning| warning.to_string()).collect()
    };
    let of_edits = |edits: &[Edit]| {
        let variant = Variant::new(base, edits);
        let case = variant.case().ok()?;
        let assembled = variant.make(&case, assemble_at_rest);
        Some(said(&assembled.ok()?.system))
    };
    let (mut of_case, mut further) = (said(of_case), Vec::new());
    let mut told: Vec<String> = Vec::new();
    for tried in tried(study) {
        let of_values = tried.into_iter().filter_map(|(words, edits)| {
            let warnings = of_edits(&edits)?;
            Some((words, warnings))
        });
        let of_values: Vec<_> = of_values.collect();
        let mut left_out = 0;
        let before = further.len();
        for (words, warnings) in &of_values {
            for warning in warnings {
                if of_case.contains(warning) || told.contains(warning) {
                    continue;
                }
                told.push(warning.clone());
                match further.len() - before < MOST_TOLD {
                    true => further.push(format!("with {words}: {warning}")),
                    false => left_out += 1,
                }
            }
        }
        if left_out > 0
            && let Some(last) = further.last_mut()
        {
            last.push_str(&format!("; {left_out} more of other values"));
        }
        // One that another value takes away in every run is of no run.
        of_case.retain(|warning| {
            let mut values = of_values.iter();
            of_values.is_empty() || values.any(|(_, warnings)| warnings.contains(warning))
        });
    }
    of_case.into_iter().chain(further).collect()
}

/// Values in words with their edits.
type Tried = Vec<(String, Vec<Edit>)>;

/// What is tried: of each variable its values alone, or of a list, whose values go together, its rows.
fn tried(study: &Study) -> Vec<Tried> {
    let changes = |v: &&Variable| v.target.changes_case();
    let words = |v: &Variable, value: &Value| v.in_words(value);
    if let (Design::List { runs }, true) = (&study.design, study.variables.len() > 1) {
        let row = |run| {
            let point = study.point(run);
            let values = study.variables.iter().zip(&point);
            let values: Vec<_> = values.filter(|(v, _)| changes(v)).collect();
            let said: Vec<String> = values.iter().map(|(v, x)| words(v, x)).collect();
            let edits = values.iter().flat_map(|(v, x)| v.target.edits(x));
            (said.join(", "), edits.collect())
        };
        return vec![
            rows_looked_at(*runs, &study.variables)
                .into_iter()
                .map(row)
                .collect(),
        ];
    }
    let of_variable = |v: &Variable| {
        let values = looked_at(&v.values).into_iter();
        values.map(|x| (words(v, &x), v.target.edits(&x))).collect()
    };
    study
        .variables
        .iter()
        .filter(changes)
        .map(of_variable)
        .collect()
}

/// The rows of a list that are looked at: all, if they are not too many, else those with the least and the greatest
/// number of each variable.
fn rows_looked_at(runs: usize, variables: &[Variable]) -> Vec<usize> {
    if runs <= MOST_CHOICES {
        return (0..runs).collect();
    }
    let ends = variables.iter().flat_map(|v| {
        let number = |run: &usize| match v.values.at(*run) {
            Value::Number(x) => x,
            Value::Choice(_) => 0.0,
        };
        let by_number = |a: &usize, b: &usize| number(a).total_cmp(&number(b));
        let ends = [(0..runs).min_by(by_number), (0..runs).max_by(by_number)];
        ends.into_iter().flatten()
    });
    let mut rows: Vec<usize> = ends.collect();
    rows.sort_unstable();
    rows.dedup();
    rows
}

/// The values that are looked at: all of a list, if they are not too many, else the least and the greatest; of random
/// ones but for a hundredth.
pub(super) fn looked_at(values: &Values) -> Vec<Value> {
    match values {
        Values::Numbers(numbers) => {
            let mut numbers = numbers.clone();
            numbers.sort_by(f64::total_cmp);
            numbers.dedup();
            if numbers.len() > MOST_CHOICES {
                numbers = vec![numbers[0], numbers[numbers.len() - 1]];
            }
            numbers.into_iter().map(Value::Number).collect()
        }
        Values::Range { from, to, .. } => vec![Value::Number(*from), Value::Number(*to)],
        Values::Random(_) => vec![values.sample(0.01), values.sample(0.99)],
        Values::Choices(names) => (0..names.len().min(MOST_CHOICES))
            .map(Value::Choice)
            .collect(),
    }
}
