//! Laws with memory of a case: storeys that yield, and links.

use std::sync::Arc;

use pounding_case::{
    Building, Case, CaseError, Dimension, Errors, FoundationMotion, Link, Located, Parameter, Side,
};
use pounding_catalogue::DefinitionError;
use pounding_hysteresis::{
    HysteresisError, LawDescriptor, LawParameters, build, find, yield_deformation,
};
use pounding_shear_building::{ShearBuilding, StoreyLaw, WALL};
use pounding_time_history::{Floor, LinkedPair, System};

use super::foundation;
use crate::dimension::parameter_value_as;
use crate::error::AssemblyError;
use crate::used_parameters::UsedParameters;

/// Puts the laws of the case into the storeys of a building.
pub(super) fn with_storey_laws(
    case: &Case,
    b: &Building,
    building: ShearBuilding,
) -> Result<ShearBuilding, CaseError> {
    let Some(first) = b.laws.first() else {
        return Ok(building);
    };
    let mut laws = building.laws().to_vec();
    let of = format!("\"{}\"", building.name());
    for (storey, law) in of_storeys(case, &b.laws, (building.stiffness(), &of))? {
        laws[storey] = Some(law);
    }
    building
        .with_laws(laws)
        .map_err(|e| case.error(first.model.span.clone(), e.to_string(), e.help()))
}

/// Laws in the place of these stiffnesses (N/m) of storeys, of a building or of a frame with this name in messages:
/// the number of the storey, from zero, and its law.
pub(super) fn of_storeys(
    case: &Case,
    laws: &[pounding_case::StoreyLaw],
    (stiffness, of): (&[f64], &str),
) -> Result<Vec<(usize, StoreyLaw)>, CaseError> {
    let mut all = Vec::new();
    let errors = Errors::default();
    let read = errors.all(laws.iter().map(|law| {
        let descriptor = descriptor(case, &law.model)?;
        carries_a_storey(case, &law.model, descriptor)?;
        let own = descriptor.parameters.iter().any(|p| p.name == "stiffness");
        for (place, storey) in law.storeys.iter().enumerate() {
            let mut values = parameters(case, descriptor, &law.parameters, place, |d| d)?;
            let stated = stiffness[*storey];
            if own && !values.values.contains_key("stiffness") {
                values.values.insert("stiffness".to_owned(), stated);
            }
            let built = built(case, &law.model, descriptor, &values)?;
            check_stiffness(case, (*storey, stated, of), &law.model, &built)?;
            all.push((*storey, built));
        }
        Ok(())
    }));
    errors.finish(read)?;
    Ok(all)
}

/// Refuses what serves as a link alone.
fn carries_a_storey(
    case: &Case,
    model: &Located<String>,
    descriptor: &LawDescriptor,
) -> Result<(), CaseError> {
    let Some(reason) = descriptor.link_alone else {
        return Ok(());
    };
    Err(case.error(
        model.span.clone(),
        format!("law {} cannot carry a storey: {reason}", descriptor.name),
        Some(
            "make it a [[link]], beside a storey with a stiffness or another law; `pounding hysteresis` lists all"
                .to_owned(),
        ),
    ))
}

/// Modes and damping belong to the stiffness of the storey: the law must start with it.
fn check_stiffness(
    case: &Case,
    (storey, stated, of): (usize, f64, &str),
    model: &Located<String>,
    built: &StoreyLaw,
) -> Result<(), CaseError> {
    let initial = built.law.initial_stiffness();
    if (initial - stated).abs() <= 1.0e-6 * stated {
        return Ok(());
    }
    Err(case.error(
        model.span.clone(),
        format!(
            "law {} starts with {initial} N/m, but storey {} of {of} has a stiffness of {stated} N/m, to which modes and damping belong",
            model.value,
            storey + 1,
        ),
        Some(format!(
            "write stiffness = {initial} for that storey, or change the law"
        )),
    ))
}

/// Adds a link of the case to the system.
pub(super) fn add_link(case: &Case, link: &Link, system: &mut System) -> Result<(), AssemblyError> {
    let laws = laws_of_link(case, link)?;
    let floor = |side: Side, storey: Option<usize>| match (side, storey) {
        (Side::Building(b), Some(s)) => Floor::Storey(b, s),
        _ => Floor::Wall,
    };
    let names = link.between.map(|side| match side {
        Side::Building(b) => case.buildings[b].name.value.clone(),
        Side::Wall => WALL.to_owned(),
    });
    if let Some(motion) = &link.foundations {
        foundation::add_link(link, names, motion.value, laws, system)?;
        return Ok(());
    }
    let levels = link.levels.iter().zip(laws);
    let pairs = levels
        .map(
            |((left, right), StoreyLaw { law, yield_drift })| LinkedPair {
                left: floor(link.between[0], *left),
                right: floor(link.between[1], *right),
                law,
                yield_deformation: yield_drift,
            },
        )
        .collect();
    Ok(system.add_link(&link.name, names, pairs)?)
}

/// The law of each level of a link.
fn laws_of_link(case: &Case, link: &Link) -> Result<Vec<StoreyLaw>, CaseError> {
    let descriptor = descriptor(case, &link.model)?;
    let turned = turns(link);
    (0..link.levels.len())
        .map(|place| {
            let values = parameters(case, descriptor, &link.parameters, place, turned)?;
            built(case, &link.model, descriptor, &values)
        })
        .collect()
}

/// The parameters of each level of a link, the lowest first.
///
/// # Errors
/// As of a case that cannot be assembled.
pub fn parameters_of_link(case: &Case, link: &Link) -> Result<Vec<UsedParameters>, CaseError> {
    let descriptor = descriptor(case, &link.model)?;
    let turned = turns(link);
    (0..link.levels.len())
        .map(|place| {
            let values = parameters(case, descriptor, &link.parameters, place, turned)?;
            let rotates = rotates(link);
            Ok(UsedParameters::of(descriptor, values.values, rotates))
        })
        .collect()
}

/// The parameters of each storey of a building that follows a law, by its number from zero, the lowest first.
///
/// # Errors
/// As of a case that cannot be assembled.
pub fn parameters_of_storeys(
    case: &Case,
    building: &Building,
) -> Result<Vec<(usize, UsedParameters)>, CaseError> {
    parameters_of_laws(case, &building.laws)
}

/// The parameters of the frames of a building in storeys in which they follow a law, with the number of the storey,
/// from zero: in the order of [`ShearBuilding::yielding_frames`].
///
/// # Errors
/// As of a case that cannot be assembled.
pub fn parameters_of_frames(
    case: &Case,
    building: &Building,
) -> Result<Vec<(usize, UsedParameters)>, CaseError> {
    let mut all = Vec::new();
    for frame in building.plan.iter().flat_map(|plan| plan.value.frames()) {
        all.extend(parameters_of_laws(case, &frame.laws)?);
    }
    all.sort_by_key(|(storey, _)| *storey);
    Ok(all)
}

fn parameters_of_laws(
    case: &Case,
    laws: &[pounding_case::StoreyLaw],
) -> Result<Vec<(usize, UsedParameters)>, CaseError> {
    let mut all = Vec::new();
    for law in laws {
        let descriptor = descriptor(case, &law.model)?;
        for (place, storey) in law.storeys.iter().enumerate() {
            let values = parameters(case, descriptor, &law.parameters, place, |d| d)?;
            all.push((
                *storey,
                UsedParameters::of(descriptor, values.values, false),
            ));
        }
    }
    all.sort_by_key(|(storey, _)| *storey);
    Ok(all)
}

/// Of what dimension a link takes parameters that are those of a force and a displacement.
fn turns(link: &Link) -> fn(Dimension) -> Dimension {
    match rotates(link) {
        true => Dimension::of_rotation,
        false => |dimension| dimension,
    }
}

/// Whether a link joins the rotations of foundations.
fn rotates(link: &Link) -> bool {
    let motion = link.foundations.as_ref().map(|f| f.value);
    motion == Some(FoundationMotion::Rocking)
}

/// Refuses a link whose laws cannot be.
pub(super) fn check_link(case: &Case, link: &Link) -> Result<(), CaseError> {
    laws_of_link(case, link).map(|_| ())
}

fn descriptor(case: &Case, model: &Located<String>) -> Result<&'static LawDescriptor, CaseError> {
    find(&model.value).map_err(|e| at(case, model.span.clone(), &e))
}

fn built(
    case: &Case,
    model: &Located<String>,
    descriptor: &'static LawDescriptor,
    values: &LawParameters,
) -> Result<StoreyLaw, CaseError> {
    let law = build(descriptor.name, values).map_err(|e| at(case, model.span.clone(), &e))?;
    Ok(StoreyLaw {
        yield_drift: yield_deformation(descriptor, values, law.initial_stiffness()),
        law: Arc::from(law),
    })
}

/// Parameters of one storey or level, each checked where it stands.
fn parameters(
    case: &Case,
    descriptor: &'static LawDescriptor,
    given: &[Parameter],
    place: usize,
    turned: impl Fn(Dimension) -> Dimension,
) -> Result<LawParameters, CaseError> {
    let exponent = given
        .iter()
        .find(|p| p.key.value == "exponent")
        .map(|p| p.values[place].value.value);
    let errors = Errors::default();
    let read = errors.all(given.iter().map(|Parameter { key, values }| {
        let given = (key, &values[place]);
        let help = |e: DefinitionError| Some(e.help());
        let value = parameter_value_as(case, descriptor, given, exponent, &turned, help)?;
        Ok((key.value.clone(), value))
    }));
    let mut all = LawParameters::default();
    all.values.extend(errors.finish(read)?);
    Ok(all)
}

fn at(case: &Case, span: std::ops::Range<usize>, error: &HysteresisError) -> CaseError {
    case.error(span, error.to_string(), error.help())
}
