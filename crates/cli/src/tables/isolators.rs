//! Isolators under buildings, and the clearance left beside them.

use pounding_shear_building::ShearBuilding;
use pounding_time_history::{ContactLevel, LevelOutcome};

use super::Run;

/// What `check` says of the isolators of a building; nothing without any.
pub(super) fn understood(building: &ShearBuilding) -> String {
    let Some((isolator, properties)) = building.isolator() else {
        return String::new();
    };
    let yields = match properties.strength {
        0.0 => "no strength".to_owned(),
        strength => format!(
            "strength {:.1} kN, {:.2} % of the weight, yield at {:.3} mm",
            strength * 1e-3,
            100.0 * strength / properties.weight,
            properties.yield_displacement * 1e3
        ),
    };
    let dashpot = match isolator.dashpot {
        0.0 => String::new(),
        dashpot => format!(", dashpot {dashpot} N s/m"),
    };
    format!(
        "isolators ({}), storey 1: weight {:.1} kN, stiffness {:e} N/m before yield and {:e} N/m after it, period then {:.4} s, {yields}{dashpot}; the modes above are those before yield, the damping of the storeys above is relative to the base slab\n",
        isolator.name(),
        properties.weight * 1e-3,
        properties.initial_stiffness,
        properties.post_yield_stiffness,
        properties.post_yield_period(),
    )
}

/// What the isolators of a building went through; nothing without any.
pub(super) fn run(run: &Run<'_>, index: usize) -> String {
    let Some(isolator) = run.outcome.buildings[index].isolator else {
        return String::new();
    };
    format!(
        "isolators ({}): displacement {:.2} mm @{:.2}, force {:.1} kN @{:.2}; effective period {:.3} s and damping {:.1} % at that displacement\n",
        isolator.model,
        isolator.displacement.value * 1e3,
        isolator.displacement.time,
        isolator.force.value * 1e-3,
        isolator.force.time,
        isolator.effective_period,
        100.0 * isolator.effective_damping_ratio,
    )
}

/// Clearance left at the levels of a gap beside a building on isolators; nothing beside
/// others.
pub(super) fn clearances(levels: &[LevelOutcome], places: &[ContactLevel]) -> String {
    let mut text = String::new();
    for (level, at) in levels.iter().zip(places) {
        let Some(left) = level.clearance else {
            continue;
        };
        let width = at.width * 1e3;
        text.push_str(&match level.impacts {
            0 => format!(
                "Level {}: {:.2} mm of {width:.1} mm clearance left\n",
                at.place,
                left * 1e3
            ),
            _ => format!(
                "Level {}: the clearance of {width:.1} mm was used up\n",
                at.place
            ),
        });
    }
    text
}
