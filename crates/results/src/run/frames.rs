//! What frames with laws add to the result of a building that turns in plan.

use hdf5::{Dataset, Group};
use pounding_time_history::{BuildingOutcome, ElementPlace, FrameOutcome, System};

use super::datasets::{labels, series};
use super::tables::{Content, Tables};
use super::{Result, share_time};
use crate::attributes::text;
use crate::dimension_scales;

/// Names of the coordinates beside `frame`, as the attribute `coordinates` lists them.
const COORDINATES: &str = "at storey";

/// Creates the group of the frames of a building that follow laws, with coordinates and the datasets that grow.
pub(super) fn begin(
    building: &Group,
    (system, index): (&System, usize),
    tables: &mut Tables,
    time: &Dataset,
) -> Result<()> {
    let frames = system.buildings()[index].yielding_frames();
    if frames.is_empty() {
        return Ok(());
    }
    let group = building.create_group("frames")?;
    share_time(&group)?;
    let names: Vec<String> = frames.iter().map(ToString::to_string).collect();
    let frame = labels(&group, "frame", "frame in a storey", &names)?;
    dimension_scales::make_scale(&frame, "frame")?;
    let at: Vec<f64> = frames.iter().map(|frame| frame.at).collect();
    let at = series(&group, "at", "m", "distance from the mass centre", &at)?;
    let storeys: Vec<i32> = frames.iter().map(|f| f.storey as i32 + 1).collect();
    let storey = series(&group, "storey", "1", "storey, from 1", &storeys)?;
    for coordinate in [at, storey] {
        dimension_scales::attach(&coordinate, &frame, 0)?;
    }
    let directions: Vec<&str> = frames.iter().map(|f| f.direction.name()).collect();
    text(&group, "directions", &directions.join(" "))?;
    let elements = system.elements().iter().enumerate();
    let own = elements.filter_map(|(e, element)| match element.place {
        ElementPlace::Frame { building, .. } if building == index => Some(vec![e]),
        _ => None,
    });
    let own: Vec<_> = own.collect();
    for (names, content) in [
        (
            (
                "deformation",
                "m",
                "displacement of the upper floor less that of the lower at the frame",
            ),
            Content::Sums(|h| &h.element_deformation, own.clone()),
        ),
        (
            ("force", "N", "force of the frame"),
            Content::Sums(|h| &h.element_force, own.clone()),
        ),
        (
            (
                "hysteretic_energy",
                "J",
                "energy dissipated by the law of the frame so far",
            ),
            Content::Sums(|h| &h.element_dissipated, own.clone()),
        ),
    ] {
        let data = tables.add(&group, names, content)?;
        text(&data, "coordinates", COORDINATES)?;
        dimension_scales::attach(&data, time, 0)?;
        dimension_scales::attach(&data, &frame, 1)?;
    }
    Ok(())
}

/// Adds laws and peaks of the frames of a building.
pub(super) fn finish(building: &Group, outcome: &BuildingOutcome) -> Result<()> {
    if outcome.frames.is_empty() {
        return Ok(());
    }
    let group = building.group("frames")?;
    let laws: Vec<&str> = outcome.frames.iter().map(|f| f.law).collect();
    text(&group, "laws", &laws.join(" "))?;
    let frame = group.dataset("frame")?;
    let peaks = group.create_group("peak")?;
    type Pick = fn(&FrameOutcome) -> f64;
    let quantities: [(&str, &str, &str, Pick); 6] = [
        ("deformation", "m", "peak absolute deformation", |f| {
            f.deformation.value
        }),
        ("deformation_time", "s", "time of peak deformation", |f| {
            f.deformation.time
        }),
        ("force", "N", "peak absolute force", |f| f.force.value),
        ("force_time", "s", "time of peak force", |f| f.force.time),
        (
            "ductility",
            "1",
            "maximum deformation over that at first yield; NaN without a yield force",
            |f| f.ductility.map_or(f64::NAN, |d| d.value),
        ),
        (
            "residual_deformation",
            "m",
            "deformation at the end less what elastic unloading gives back",
            |f| f.residual_deformation,
        ),
    ];
    let add = |name: &str, unit: &str, long_name: &str, pick: Pick| {
        let values: Vec<f64> = outcome.frames.iter().map(pick).collect();
        let data = series(&peaks, name, unit, long_name, &values)?;
        dimension_scales::attach(&data, &frame, 0)
    };
    for (name, unit, long_name, pick) in quantities {
        add(name, unit, long_name, pick)?;
    }
    if outcome.frames.iter().any(|f| f.strength_lost.is_some()) {
        let long_name = "time from which the frame has no strength; NaN where it kept some";
        add("strength_lost", "s", long_name, |f| {
            f.strength_lost.unwrap_or(f64::NAN)
        })?;
    }
    group.link_hard("frame", "peak/frame")
}
