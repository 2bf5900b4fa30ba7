//! Foundations that sway and rock.

use pounding_shear_building::{Excitation, ShearBuilding, SpringDashpot};

use super::decimal;

/// Mass of the foundation and of all else that moves along the row and is no floor (kg).
pub(super) fn mass_along(building: &ShearBuilding) -> f64 {
    let further = building.further_coordinates().iter();
    let along = further.filter(|c| c.excitation == Excitation::Along);
    along.map(|c| c.inertia).sum()
}

/// What `check` says of the foundation of a building; empty without one.
pub(super) fn understood(building: &ShearBuilding) -> String {
    let Some(on) = building.foundation() else {
        return String::new();
    };
    let foundation = on.foundation();
    let spring = |held: Option<SpringDashpot>, inertia: String, units: [&str; 2]| {
        held.map_or_else(
            || "rigid".to_owned(),
            |held| {
                format!(
                    "{inertia}, {:.5e} {}, {:.5e} {}",
                    held.stiffness, units[0], held.dashpot, units[1]
                )
            },
        )
    };
    let (mass, inertia) = (foundation.mass(), foundation.rotational_inertia());
    let mut text = format!(
        "foundation: sway {}; rocking {}\n",
        spring(foundation.sway(), format!("{mass} kg"), ["N/m", "N s/m"]),
        spring(
            foundation.rocking(),
            format!("{inertia:.5e} kg m2"),
            ["N m/rad", "N m s/rad"]
        ),
    );
    let fixed = on.fixed_base().modes();
    let (period, damping) = (fixed.period[0], 100.0 * fixed.damping_ratio[0]);
    match (on.first_mode(), on.period_lengthening()) {
        (Some(mode), Some(lengthening)) => text.push_str(&format!(
            "first mode of building and soil: period {} s, {} times that on a fixed base ({} s); damping {:.2} % ({damping:.2} % on a fixed base)\n",
            decimal(mode.period, 4),
            decimal(lengthening, 4),
            decimal(period, 4),
            100.0 * mode.damping_ratio
        )),
        _ => text.push_str("first mode of building and soil: it does not oscillate, the dashpots of the soil are so strong\n"),
    }
    text.push_str("soil dashpots couple the modes: those in the table are without them, with the diagonal part of their damping\n");
    if let (Some(uplift), Some(most)) = (on.moment_of_uplift(), on.overturning_moment()) {
        text.push_str(&format!(
            "the edge of the foundation lifts off from a moment of some {:.1} kN m on, a sixth of weight times length, which is not modelled; the most that the weight holds is half of weight times length, {:.1} kN m\n",
            uplift * 1e-3,
            most * 1e-3
        ));
    }
    text
}
