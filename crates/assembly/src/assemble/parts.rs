//! What a case says of buildings, models and options, before they meet the ground.

use std::sync::Arc;

use pounding_case::{Building, Case, CaseError, Errors, Side};
use pounding_catalogue::STANDARD_GRAVITY;
use pounding_shear_building::{ContactLine, ShearBuilding, ShearBuildingError};
use pounding_time_history::RunOptions;

use super::column::Hits;
use super::impact_models::{Models, models_of};
use super::method::options;
use super::plan::OVERTURNED;
use super::{foundation, lateral, laws, plan};

/// What a case says of buildings, models and options.
pub(super) struct Parts {
    pub buildings: Vec<Arc<ShearBuilding>>,
    pub models: Models,
    pub options: RunOptions,
}

/// Refuses gaps and links of buildings that the case does not have, as programs that take buildings out of it may
/// leave them.
fn names_its_buildings(case: &Case) -> Result<(), CaseError> {
    let of_gaps = case.gaps.iter().map(|gap| ("gap", &gap.name, gap.between));
    let of_links = case
        .links
        .iter()
        .map(|link| ("link", &link.name, link.between));
    let lost = of_gaps.chain(of_links).find(|(_, _, between)| {
        let known = |side: &Side| match side {
            Side::Building(b) => *b < case.buildings.len(),
            Side::Wall => true,
        };
        !between.iter().all(known)
    });
    match lost {
        None => Ok(()),
        Some((what, name, _)) => Err(case.error(
            0..0,
            format!("{what} {name} joins a building that the case does not have"),
            Some(format!("take the {what} out with its building")),
        )),
    }
}

impl Parts {
    /// Makes all of it, and reports all that is wrong in it.
    pub fn of(case: &Case) -> Result<Self, CaseError> {
        Self::with_columns(case, case)
    }

    /// The same with columns that the gaps of another case, with the same buildings, let
    /// floors hit.
    pub fn with_columns(case: &Case, gaps: &Case) -> Result<Self, CaseError> {
        names_its_buildings(case)?;
        let errors = Errors::default();
        let hits = errors.keep(Hits::of(gaps));
        let points = |b: usize| {
            hits.as_ref()
                .map_or_else(Vec::new, |hits| hits.with_mass(b))
        };
        let buildings = case.buildings.iter().enumerate();
        let buildings =
            errors.all(buildings.map(|(i, b)| building(case, b, &points(i)).map(Arc::new)));
        let models = errors.all(case.gaps.iter().map(|gap| models_of(case, gap)));
        if let (Ok(models), Some(hits), false) = (&models, &hits, case.gaps.is_empty()) {
            errors.or_default(hits.check_models(models));
        }
        let options = errors.all([options(case)]);
        errors.or_default(errors.all(case.links.iter().map(|l| laws::check_link(case, l))));
        errors.or_default(errors.all(columns_of_rigid_floors(case).into_iter().map(Err::<(), _>)));
        let parts = buildings.and_then(|buildings| {
            Ok(Self {
                buildings,
                models: models?,
                options: options?.remove(0),
            })
        });
        errors.finish(parts)
    }
}

/// The fundamental period (s) along the row of each building of a case, as it is before anything yields.
pub(super) fn fundamental_periods(case: &Case) -> Result<Vec<f64>, CaseError> {
    let buildings = Parts::of(case)?.buildings;
    let period = |b: &Arc<ShearBuilding>| b.modes().period[b.fundamental_mode()];
    Ok(buildings.iter().map(period).collect())
}

/// Columns that are hit beside floors that turn, or in buildings on isolators.
fn columns_of_rigid_floors(case: &Case) -> Vec<CaseError> {
    let mut found = Vec::new();
    for gap in &case.gaps {
        let Some(place) = gap.columns.iter().flatten().next() else {
            continue;
        };
        for (side, own) in gap.between.iter().zip(&gap.columns) {
            let Side::Building(b) = side else {
                continue;
            };
            let building = &case.buildings[*b];
            let what = match (&building.plan, &building.isolator, own) {
                (Some(_), ..) => "plan",
                (_, Some(_), Some(_)) => "isolator",
                _ => continue,
            };
            let message = format!(
                "columns cannot be hit in gap {}: building \"{}\" has `{what}`",
                gap.name, building.name.value
            );
            let help = format!("remove `column`, or `{what}` of the building");
            found.push(case.error(place.span.clone(), message, Some(help)));
        }
    }
    found
}

fn building(case: &Case, b: &Building, points: &[ContactLine]) -> Result<ShearBuilding, CaseError> {
    let gravity = if b.p_delta { STANDARD_GRAVITY } else { 0.0 };
    let (name, mass, height) = (b.name.value.clone(), b.mass.clone(), b.height.clone());
    if let Some(given) = &b.plan {
        return plan::building(case, b, given);
    }
    let damping = b.damping.value.clone();
    let made = match (&b.lateral, &b.isolator) {
        (None, Some(isolator)) => {
            ShearBuilding::on_isolators(name, mass, &b.stiffness, height, damping, isolator.value)
        }
        (None, None) => {
            let stiffness = b.stiffness.clone();
            ShearBuilding::under_gravity(name, mass, stiffness, height, damping, gravity)
        }
        (Some(lateral), _) => {
            let stiffness = lateral::stiffness(case, b, lateral)?;
            ShearBuilding::with_stiffness_matrix(name, mass, stiffness, height, damping, gravity)
        }
    };
    let building = made.map_err(|e| {
        let at_matrix = b.lateral.as_ref().map_or(&b.name.span, |l| &l.span);
        let at_isolator = b.isolator.as_ref().map_or(&b.name.span, |i| &i.span);
        let (place, help) = match &e {
            ShearBuildingError::Unstable { .. } => (&b.name.span, Some(OVERTURNED.to_owned())),
            ShearBuildingError::UnstableMatrix { .. } => (at_matrix, Some(OVERTURNED.to_owned())),
            ShearBuildingError::Length { .. } => (at_matrix, e.help()),
            ShearBuildingError::TooManyStoreys { .. } => (&b.name.span, e.help()),
            ShearBuildingError::Value { quantity, .. } => {
                let place = b.span_of(quantity);
                return case.error(place, e.to_string(), Some(WITH_UNIT.to_owned()));
            }
            ShearBuildingError::Damping { .. } if b.lateral.is_some() => (
                &b.damping.span,
                Some("give ratios, such as { modal = 0.05 }".to_owned()),
            ),
            ShearBuildingError::Isolator { .. } => (at_isolator, e.help()),
            _ => (&b.damping.span, e.help()),
        };
        case.error(place.clone(), e.to_string(), help)
    })?;
    let building = laws::with_storey_laws(case, b, building)?;
    if points.is_empty() {
        return foundation::on_foundation(case, b, building);
    }
    let made = building.with_contact_points(points);
    made.map_err(|e| case.error(b.name.span.clone(), e.to_string(), None))
}

/// What to do about a mass, a stiffness or a height that cannot be.
const WITH_UNIT: &str =
    "correct the value, with its unit, such as \"25 t\" of a mass; plain numbers are SI";
