//! Coordinates of the levels of a gap or a link.

use hdf5::{Dataset, Group};

use super::Result;
use super::datasets::{labels, series};
use crate::dimension_scales;
use pounding_time_history::LevelPlace;

/// Names of the coordinates beside `level`, as the attribute `coordinates` lists them.
pub(super) const COORDINATES: &str = "left_storey right_storey left_elevation right_elevation";

/// Writes the labels of levels, the scale of the dimension `level`, with storeys and
/// elevations on both sides.
pub(super) fn coordinates(group: &Group, places: &[LevelPlace]) -> Result<Dataset> {
    let names: Vec<String> = places.iter().map(LevelPlace::label).collect();
    let long_name = "level: storeys of the left and the right building";
    let level = labels(group, "level", long_name, &names)?;
    dimension_scales::make_scale(&level, "level")?;
    for (i, side) in ["left", "right"].into_iter().enumerate() {
        let storeys = places.iter().map(|p| p.storeys[i].unwrap_or(0) as i32);
        let long_name =
            format!("storey of the {side} building, from 1; 0 is a wall or a foundation");
        let name = format!("{side}_storey");
        let storeys = series(group, &name, "1", &long_name, &storeys.collect::<Vec<_>>())?;
        dimension_scales::attach(&storeys, &level, 0)?;
        let elevations = places.iter().map(|p| p.elevations[i].unwrap_or(f64::NAN));
        let long_name = format!("elevation of the {side} floor; NaN is a wall");
        let name = format!("{side}_elevation");
        let elevations = series(
            group,
            &name,
            "m",
            &long_name,
            &elevations.collect::<Vec<_>>(),
        )?;
        dimension_scales::attach(&elevations, &level, 0)?;
    }
    Ok(level)
}
