//! Foundations of a case.

use pounding_case::{Case, CaseError, Foundation as Given, Located, Support};
use pounding_shear_building::{Foundation, FoundationError};

/// The foundation of a building, if it sways or rocks.
pub(super) fn foundation(case: &Case, given: &Located<Given>) -> Result<Foundation, CaseError> {
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
