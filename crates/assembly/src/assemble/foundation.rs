//! Foundations of a case.

use pounding_case::{
    Building, Case, CaseError, Foundation as Given, FoundationMotion, Link, Located, Side, Support,
};
use pounding_catalogue::STANDARD_GRAVITY;
use pounding_shear_building::{
    Foundation, FoundationError, ShearBuilding, ShearBuildingError, StoreyLaw,
};
use pounding_time_history::{
    BuildingPoint, Floor, LinkedMotion, LinkedPair, System, TimeHistoryError,
};

/// The foundation of a building, if it sways or rocks.
fn foundation(case: &Case, given: &Located<Given>) -> Result<Foundation, CaseError> {
    let Given {
        mass,
        rotational_inertia,
        support,
        ..
    } = &given.value;
    let made = match support {
        Support::Soil(soil) => Foundation::on_soil(*mass, *rotational_inertia, soil),
        Support::Springs { sway, rocking } => {
            Foundation::new(*mass, *rotational_inertia, *sway, *rocking)
        }
    };
    made.map_err(|e| {
        let help = match e {
            FoundationError::NoInertia { .. } => {
                "give that of foundation and floors about their own axes: of a slab m (length^2 + thickness^2) / 12"
            }
            _ => "correct the value",
        };
        case.error(given.span.clone(), e.to_string(), Some(help.to_owned()))
    })
}

/// Puts a building on its foundation, if it has one.
pub(super) fn on_foundation(
    case: &Case,
    b: &Building,
    building: ShearBuilding,
) -> Result<ShearBuilding, CaseError> {
    let Some(given) = &b.foundation else {
        return Ok(building);
    };
    let foundation = foundation(case, given)?;
    if let Some(isolator) = &b.isolator {
        let message = format!(
            "\"{}\" stands on isolators and on a foundation that sways or rocks: both together are not known",
            b.name.value
        );
        let help = "remove `isolator` or `foundation`; isolators are far softer than most soil";
        return Err(case.error(isolator.span.clone(), message, Some(help.to_owned())));
    }
    let length = given.value.length;
    let made = building.on_foundation(foundation, length, STANDARD_GRAVITY);
    made.map_err(|e| {
        let help = match e {
            ShearBuildingError::Overturned { .. } => {
                "correct the springs of the soil, or masses and heights; `p_delta = false` leaves gravity out"
            }
            _ => "correct the values: inertias or stiffnesses of building and soil are too far apart; what hardly moves can be left out, which makes it rigid",
        };
        case.error(given.span.clone(), e.to_string(), Some(help.to_owned()))
    })
}

/// Adds a link between the foundations of two buildings.
pub(super) fn add_link(
    link: &Link,
    names: [String; 2],
    motion: FoundationMotion,
    laws: Vec<StoreyLaw>,
    system: &mut System,
) -> Result<(), TimeHistoryError> {
    let joined = match motion {
        FoundationMotion::Sway => LinkedMotion::FoundationSway,
        FoundationMotion::Rocking => LinkedMotion::FoundationRotation,
    };
    for StoreyLaw { law, yield_drift } in laws {
        let [left, right] = link.between.map(|side| match side {
            Side::Building(b) => end_of_link(system, b, motion),
            Side::Wall => Floor::Wall,
        });
        let pair = LinkedPair {
            left,
            right,
            law,
            yield_deformation: yield_drift,
        };
        system.add_foundation_link(&link.name, names.clone(), pair, joined)?;
    }
    Ok(())
}

/// The foundation of a building as the end of a link: its displacement or its rotation.
fn end_of_link(system: &mut System, building: usize, motion: FoundationMotion) -> Floor {
    let on = system.buildings()[building].foundation();
    let coordinate = on.and_then(|on| match motion {
        FoundationMotion::Sway => on.matrices().sway(),
        FoundationMotion::Rocking => on.matrices().rotation(),
    });
    // The case has no link at a foundation that does not move this way; a point without
    // weights is refused.
    let weights = coordinate.map(|i| (i, 1.0)).into_iter().collect();
    system.add_point(BuildingPoint {
        building,
        storey: 0,
        elevation: 0.0,
        weights,
    })
}
