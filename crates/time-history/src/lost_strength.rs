//! Storeys, frames and links that lose all their strength.

use pounding_shear_building::ShearBuilding;

use crate::system::{ElementPlace, System};
use crate::warning::Warning;

/// What can be said before a run, of each building.
pub(crate) fn before(system: &System) -> impl Iterator<Item = Warning> {
    let buildings = system.buildings().iter();
    buildings.filter_map(|building| may_be_lost(building))
}

/// The warning of a building by its lowest storey that may lose all its strength, or with a frame that may, and yet stand.
fn may_be_lost(building: &ShearBuilding) -> Option<Warning> {
    let laws = building.laws().iter().zip(building.geometric_stiffness());
    let mut may = laws.map(|(law, geometric)| {
        let law = law.as_ref();
        *geometric == 0.0 && law.is_some_and(|law| law.law.may_lose_all_strength())
    });
    let frames = building.yielding_frames().iter();
    let frames = frames.filter(|frame| {
        let geometric = building.geometric_stiffness()[frame.storey];
        geometric == 0.0 && frame.law.law.may_lose_all_strength()
    });
    let of_frame = frames.map(|frame| (frame.storey, true)).min();
    let of_storey = may.position(|may| may).map(|storey| (storey, false));
    let (storey, of_frame) = of_storey.or(of_frame)?;
    Some(Warning::StrengthMayBeLost {
        building: building.name().to_owned(),
        storey: storey + 1,
        of_frame,
    })
}

/// The first storey of each building, and all frames and links, that lost their strength.
pub(crate) fn after(system: &System, lost: &[Option<f64>]) -> Vec<Warning> {
    let mut told: Vec<(f64, Option<usize>, Warning)> = Vec::new();
    for (index, (element, lost)) in system.elements().iter().zip(lost).enumerate() {
        let Some(time) = *lost else { continue };
        let (place, of, stands) = match element.place {
            ElementPlace::Storey { building, storey } => {
                let own = &system.buildings()[building];
                let place = format!("{}, storey {}", own.name(), storey + 1);
                let stands = own.geometric_stiffness()[storey] == 0.0;
                (place, Some(building), stands)
            }
            ElementPlace::Frame { building, frame } => {
                let own = &system.buildings()[building];
                let place = format!("{}, {}", own.name(), own.yielding_frames()[frame]);
                // Other frames of the storey may hold it.
                (place, None, false)
            }
            ElementPlace::Link { .. } => (system.place_of_element(index), None, false),
        };
        let warning = Warning::StrengthLost {
            place,
            time,
            stands,
        };
        match told.iter_mut().find(|(_, b, _)| of.is_some() && *b == of) {
            Some(earlier) if earlier.0 <= time => {}
            Some(later) => *later = (time, of, warning),
            None => told.push((time, of, warning)),
        }
    }
    told.into_iter().map(|(.., warning)| warning).collect()
}
