//! The impact models of the gaps of a case, by their names.

use std::sync::Arc;

use pounding_case::{Case, CaseError, Errors, Gap, Located, Parameter};
use pounding_gap_element::{
    GapElementError, ImpactModel, ModelDescriptor, ModelParameters, SeparationRule, registry,
};

use crate::dimension::parameter_value;
use crate::used_parameters::UsedParameters;

/// The impact model of every contact level of every gap.
pub(super) type Models = Vec<Vec<Arc<dyn ImpactModel>>>;

/// The impact models of all gaps.
pub(super) fn models(case: &Case) -> Result<Models, CaseError> {
    case.gaps.iter().map(|gap| models_of(case, gap)).collect()
}

/// The impact model of each contact level of a gap. Levels with the parameters of the first share its
/// model; there is one for a gap whose levels are not known.
pub(super) fn models_of(case: &Case, gap: &Gap) -> Result<Vec<Arc<dyn ImpactModel>>, CaseError> {
    let first = model(case, gap, 0)?;
    let is_first = |place: usize| {
        let value = |p: &Parameter, place| p.at(place).map(|given| given.value.value);
        let mut parameters = gap.parameters.iter();
        parameters.all(|p| value(p, place) == value(p, 0))
    };
    let errors = Errors::default();
    let further = errors.all((1..gap.levels.len()).map(|place| match is_first(place) {
        true => Ok(Arc::clone(&first)),
        false => model(case, gap, place),
    }));
    let further = errors.finish(further)?;
    Ok(std::iter::once(first).chain(further).collect())
}

/// The parameters of the impact model of a contact level of a gap, from zero.
///
/// # Errors
/// As of a case that cannot be assembled.
pub fn parameters_of_gap(
    case: &Case,
    gap: &Gap,
    level: usize,
) -> Result<UsedParameters, CaseError> {
    let descriptor = registry::find(&gap.model.value).map_err(at_model(case, gap))?;
    let values = values_of_model(case, gap, descriptor, level)?;
    Ok(UsedParameters::of(descriptor, values, false))
}

fn at_model<'c>(case: &'c Case, gap: &'c Gap) -> impl Fn(GapElementError) -> CaseError + use<'c> {
    move |e| case.error(gap.model.span.clone(), e.to_string(), e.help())
}

/// The values (SI) that are given for the model of a contact level, from zero.
fn values_of_model(
    case: &Case,
    gap: &Gap,
    descriptor: &'static ModelDescriptor,
    level: usize,
) -> Result<Vec<(String, f64)>, CaseError> {
    let exponent = gap
        .parameters
        .iter()
        .find(|p| p.key.value == "exponent")
        .and_then(|p| Some(p.at(level)?.value.value));
    let errors = Errors::default();
    let given = gap.parameters.iter();
    let given = given.filter_map(|p| Some((&p.key, p.at(level)?)));
    let read = errors.all(given.map(|given| {
        let value = parameter_value(case, descriptor, given, exponent, |e| {
            GapElementError::from(e).help()
        })?;
        Ok((given.0.value.clone(), value))
    }));
    errors.finish(read)
}

/// The impact model of a contact level, from zero.
fn model(case: &Case, gap: &Gap, level: usize) -> Result<Arc<dyn ImpactModel>, CaseError> {
    let at_model = at_model(case, gap);
    let descriptor = registry::find(&gap.model.value).map_err(&at_model)?;
    let mut parameters = ModelParameters::default();
    let errors = Errors::default();
    let read = values_of_model(case, gap, descriptor, level);
    if let Some(separation) = &gap.separation {
        parameters.separation = errors.keep(separation_rule(case, descriptor, separation));
    }
    parameters.spring = gap.spring.as_ref().map(|table| table.value.clone());
    // TOML keys are unique.
    parameters.values = errors.finish(read)?.into_iter().collect();
    // What is wrong with a table is said where it stands.
    let wrong = |e: GapElementError| match (&e, &gap.spring) {
        (GapElementError::SpringTable(_), Some(table)) => {
            case.error(table.span.clone(), e.to_string(), e.help())
        }
        _ => at_model(e),
    };
    Ok(registry::build(descriptor.name, &parameters)
        .map_err(wrong)?
        .into())
}

fn separation_rule(
    case: &Case,
    descriptor: &'static ModelDescriptor,
    separation: &Located<String>,
) -> Result<SeparationRule, CaseError> {
    SeparationRule::from_name(&separation.value)
        .filter(|rule| descriptor.separation_rules.contains(rule))
        .ok_or_else(|| {
            let offered: Vec<_> = descriptor
                .separation_rules
                .iter()
                .map(|r| r.name())
                .collect();
            case.error(
                separation.span.clone(),
                format!(
                    "model {} does not offer separation \"{}\"",
                    descriptor.name, separation.value
                ),
                Some(format!("it offers {}", offered.join(", "))),
            )
        })
}
