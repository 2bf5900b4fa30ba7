//! What storeys with laws and links add to the result.

use hdf5::{Dataset, Group};
use pounding_time_history::{
    BuildingOutcome, LinkLevelOutcome, LinkedMotion, Outcome, Peak, System,
};

use super::datasets::series;
use super::tables::{Content, Tables};
use super::{Result, levels, share_time};
use crate::attributes::text;
use crate::dimension_scales;

/// Creates the dataset of the energy that storeys dissipate over time, for a building that
/// has laws.
pub(super) fn begin_storeys(
    group: &Group,
    system: &System,
    index: usize,
    tables: &mut Tables,
    (time, storey): (&Dataset, &Dataset),
) -> Result<()> {
    let mut places = vec![Vec::new(); system.buildings()[index].mass().len()];
    for (e, element) in system.elements().iter().enumerate() {
        if let Some((building, storey)) = system.storey_of_element(element.place)
            && building == index
        {
            places[storey].push(e);
        }
    }
    if places.iter().all(Vec::is_empty) {
        return Ok(());
    }
    let long_name = "energy dissipated by the law of the storey so far";
    let names = ("hysteretic_energy", "J", long_name);
    let content = Content::Sums(|h| &h.element_dissipated, places);
    let data = tables.add(group, names, content)?;
    dimension_scales::attach(&data, time, 0)?;
    dimension_scales::attach(&data, storey, 1)
}

/// Adds laws, ductility and what stays, for a building that has laws.
pub(super) fn finish_storeys(
    (group, peaks): (&Group, &Group),
    outcome: &BuildingOutcome,
    storey: &Dataset,
) -> Result<()> {
    if outcome.yielding.iter().all(Option::is_none) {
        return Ok(());
    }
    let names: Vec<&str> = outcome
        .yielding
        .iter()
        .map(|y| y.map_or("linear", |y| y.law))
        .collect();
    text(group, "laws", &names.join(" "))?;
    let ductility: Vec<f64> = outcome
        .yielding
        .iter()
        .map(|y| y.and_then(|y| y.ductility).map_or(f64::NAN, |d| d.value))
        .collect();
    let residual: Vec<f64> = outcome
        .yielding
        .iter()
        .map(|y| y.map_or(0.0, |y| y.residual_drift_ratio))
        .collect();
    for (name, long_name, values) in [
        (
            "ductility",
            "maximum drift over the drift at first yield; NaN without a yield force",
            ductility,
        ),
        (
            "residual_drift_ratio",
            "drift at the end less what elastic unloading gives back, over storey height",
            residual,
        ),
    ] {
        let data = series(peaks, name, "1", long_name, &values)?;
        dimension_scales::attach(&data, storey, 0)?;
    }
    let lost = outcome
        .yielding
        .iter()
        .map(|y| y.and_then(|y| y.strength_lost));
    if lost.clone().any(|lost| lost.is_some()) {
        let times: Vec<f64> = lost.map(|lost| lost.unwrap_or(f64::NAN)).collect();
        let long_name = "time from which the storey has no strength; NaN where it kept some";
        let data = series(peaks, "strength_lost", "s", long_name, &times)?;
        dimension_scales::attach(&data, storey, 0)?;
    }
    Ok(())
}

/// Creates the groups of all links, with coordinates and the datasets that grow.
pub(super) fn begin_links(
    file: &hdf5::File,
    system: &System,
    tables: &mut Tables,
    time: &Dataset,
) -> Result<()> {
    if system.links().is_empty() {
        return Ok(());
    }
    let all = file.create_group("link")?;
    for (index, link) in system.links().iter().enumerate() {
        let group = all.create_group(&link.name)?;
        let range = link.first_element..link.first_element + link.levels;
        share_time(&group)?;
        let places = system.link_levels(index);
        let level = levels::coordinates(&group, &places)?;
        let [deformation_unit, force_unit] = link.joins.units();
        let long_names = match link.joins {
            LinkedMotion::Floors => [
                "displacement of the right floor less that of the left",
                "force of the link, positive in tension",
            ],
            LinkedMotion::FoundationRotation => [
                "rotation of the right foundation less that of the left",
                "moment of the link",
            ],
            _ => [
                "displacement of the right foundation less that of the left",
                "force of the link, positive in tension",
            ],
        };
        let of_levels = |list| Content::Columns(list, range.clone());
        for (names, content) in [
            (
                ("deformation", deformation_unit, long_names[0]),
                of_levels(|h| &h.element_deformation),
            ),
            (
                ("force", force_unit, long_names[1]),
                of_levels(|h| &h.element_force),
            ),
            (
                (
                    "energy_dissipated",
                    "J",
                    "energy dissipated by the link so far",
                ),
                of_levels(|h| &h.element_dissipated),
            ),
        ] {
            let data = tables.add(&group, names, content)?;
            text(&data, "coordinates", levels::COORDINATES)?;
            dimension_scales::attach(&data, time, 0)?;
            dimension_scales::attach(&data, &level, 1)?;
        }
    }
    Ok(())
}

/// Adds laws and peaks of all links.
pub(super) fn finish_links(file: &hdf5::File, system: &System, outcome: &Outcome) -> Result<()> {
    for (link, outcome) in system.links().iter().zip(&outcome.links) {
        let group = file.group("link")?.group(&link.name)?;
        text(&group, "law", outcome.law)?;
        let level = group.dataset("level")?;
        let peaks = group.create_group("peak")?;
        link_peaks(&peaks, &outcome.levels, link.joins, &level)?;
        group.link_hard("level", "peak/level")?;
    }
    Ok(())
}

fn link_peaks(
    group: &Group,
    levels: &[LinkLevelOutcome],
    joins: LinkedMotion,
    level: &Dataset,
) -> Result<()> {
    type Pick = fn(&LinkLevelOutcome) -> Peak;
    let [deformation, force] = joins.units();
    let quantities: [(&str, &str, Pick); 2] = [
        ("deformation", deformation, |l| l.deformation),
        ("force", force, |l| l.force),
    ];
    for (name, units, pick) in quantities {
        let values: Vec<f64> = levels.iter().map(|l| pick(l).value).collect();
        let times: Vec<f64> = levels.iter().map(|l| pick(l).time).collect();
        let label = format!("peak absolute {name}");
        let value = series(group, name, units, &label, &values)?;
        let label = format!("time of peak {name}");
        let time = series(group, &format!("{name}_time"), "s", &label, &times)?;
        dimension_scales::attach(&value, level, 0)?;
        dimension_scales::attach(&time, level, 0)?;
    }
    Ok(())
}
