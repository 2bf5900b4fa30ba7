//! The row of buildings of a result, for the picture of them in elevation.

use pounding_elevation::{Neighbour, Row, RowGap, WALL};

use crate::result::{GapResult, RunResult};

/// The row.
pub(super) fn row(result: &RunResult) -> Row {
    let buildings = result.buildings.iter();
    let gaps = result.gaps.iter();
    Row {
        buildings: buildings
            .map(|b| (b.name.clone(), b.elevation.clone()))
            .collect(),
        gaps: gaps
            .map(|gap| RowGap {
                between: sides(result, gap),
                levels: (gap.levels.iter().map(|level| level.elevations))
                    .zip(gap.width.iter().copied())
                    .collect(),
            })
            .collect(),
        reach: reach(result),
    }
}

/// What stands on both sides of a gap, by the text of the result.
fn sides(result: &RunResult, gap: &GapResult) -> [Neighbour; 2] {
    let body = |name: &str| {
        let building = result.buildings.iter().position(|b| b.name == name);
        match building {
            Some(building) => Neighbour::Building(building),
            None if name == WALL => Neighbour::Wall,
            None => Neighbour::Unknown,
        }
    };
    // A name may hold the same sign.
    let parts = gap.between.match_indices(" | ").map(|(at, sign)| {
        [
            body(&gap.between[..at]),
            body(&gap.between[at + sign.len()..]),
        ]
    });
    let mut parts = parts.filter(|sides| !sides.contains(&Neighbour::Unknown));
    parts.next().unwrap_or([Neighbour::Unknown; 2])
}

/// Largest displacement of all (m).
fn reach(result: &RunResult) -> f64 {
    let values = result.buildings.iter().flat_map(|b| &b.displacement.values);
    let values = values.copied().filter(|u| u.is_finite());
    values.fold(0.0, |m: f64, u| m.max(u.abs()))
}
