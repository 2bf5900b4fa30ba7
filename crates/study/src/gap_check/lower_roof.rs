//! Roofs that a gap leaves out.

use pounding_shear_building::are_level;

use super::codes::GapPlace;

/// Says that no level of a gap holds the roof of the lower of two buildings, or of one of two of a height,
/// where codes ask for most and the building moves most: nothing is computed or judged there.
pub(super) fn left_out(place: &GapPlace<'_>) -> Option<String> {
    let levels = place.levels();
    let [Some((left, _)), Some((right, _))] = *levels.first()? else {
        return None;
    };
    let buildings = [left, right].map(|b| &place.system.buildings()[b]);
    let roofs = buildings.map(|b| b.elevations().last().copied().unwrap_or(0.0));
    let gap = place.gap();
    let elevations = |side: usize| {
        let levels = place.system.levels_of(gap).iter();
        levels.filter_map(move |level| level.place.elevations[side])
    };
    let lowest = roofs[0].min(roofs[1]);
    // Of roofs that are level both.
    let side = (0..2).find(|side| {
        let roof = roofs[*side];
        are_level(roof, lowest, gap.elevation_tolerance) && !elevations(*side).any(|z| z == roof)
    })?;
    let (lower, other, roof) = (buildings[side], buildings[1 - side], roofs[side]);
    let highest = elevations(side).fold(0.0, f64::max);
    Some(format!(
        "gap {}: the roof of \"{}\" at {roof} m, storey {}, lies at no level of the gap: demand and widths by rule are those of levels up to {highest} m, and nothing is asked of the roof. Let it hit the columns of \"{}\" (`column`, with `levels = \"all_floors\"`), or act on a floor of it (a pair in `levels`, with `floor_to_floor = true` where they are not level), or correct the storey heights",
        gap.name,
        lower.name(),
        lower.storeys(),
        other.name(),
    ))
}
