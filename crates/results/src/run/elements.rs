//! What storeys with laws and links add to the result.

use hdf5::{Dataset, Group};

use super::datasets::{matrix, series, text};
use super::{Result, RunRecord, levels, share_time};
use crate::dimension_scales;
use pounding_time_history::ElementPlace;
use pounding_time_history::{LinkLevelOutcome, Peak};

/// Energy dissipated in every storey over time, ductility and what stays, for a building
/// that has laws.
pub(super) fn storeys(
    (group, peaks): (&Group, &Group),
    record: &RunRecord<'_>,
    index: usize,
    (time, storey): (&Dataset, &Dataset),
) -> Result<()> {
    let outcome = &record.outcome.buildings[index];
    if outcome.yielding.iter().all(Option::is_none) {
        return Ok(());
    }
    let storeys = outcome.yielding.len();
    let mut place = vec![None; storeys];
    for (e, element) in record.system.elements().iter().enumerate() {
        if let ElementPlace::Storey { building, storey } = element.place
            && building == index
        {
            place[storey] = Some(e);
        }
    }
    let history = record.history;
    let mut rows = Vec::with_capacity(storeys * history.len());
    let width = record.system.elements().len();
    for row in history.element_dissipated.chunks_exact(width) {
        rows.extend(place.iter().map(|e| e.map_or(0.0, |e| row[e])));
    }
    let long_name = "energy dissipated by the law of the storey so far";
    let data = matrix(group, "hysteretic_energy", "J", long_name, &rows, storeys)?;
    dimension_scales::attach(&data, time, 0)?;
    dimension_scales::attach(&data, storey, 1)?;
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
            "greatest drift over the drift at first yield; NaN without a yield force",
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
    Ok(())
}

/// All links.
pub(super) fn links(file: &hdf5::File, record: &RunRecord<'_>, time: &Dataset) -> Result<()> {
    let system = record.system;
    if system.links().is_empty() {
        return Ok(());
    }
    let all = file.create_group("link")?;
    for (index, link) in system.links().iter().enumerate() {
        let group = all.create_group(&link.name)?;
        let range = link.first_element..link.first_element + link.levels;
        share_time(&group)?;
        let level = levels::coordinates(&group, &system.link_levels(index))?;
        let outcome = &record.outcome.links[index];
        text(&group, "law", outcome.law)?;
        let history = record.history;
        let quantities: [(&str, &str, &str, &[f64]); 3] = [
            (
                "deformation",
                "m",
                "displacement of the right floor less that of the left",
                &history.element_deformation,
            ),
            (
                "force",
                "N",
                "force of the link, positive in tension",
                &history.element_force,
            ),
            (
                "energy_dissipated",
                "J",
                "energy dissipated by the link so far",
                &history.element_dissipated,
            ),
        ];
        for (name, units, long_name, values) in quantities {
            let rows = history.columns(values, range.clone());
            let data = matrix(&group, name, units, long_name, &rows, range.len())?;
            text(&data, "coordinates", levels::COORDINATES)?;
            dimension_scales::attach(&data, time, 0)?;
            dimension_scales::attach(&data, &level, 1)?;
        }
        link_peaks(&group.create_group("peak")?, &outcome.levels, &level)?;
        group.link_hard("level", "peak/level")?;
    }
    Ok(())
}

fn link_peaks(group: &Group, levels: &[LinkLevelOutcome], level: &Dataset) -> Result<()> {
    type Pick = fn(&LinkLevelOutcome) -> Peak;
    let quantities: [(&str, &str, Pick); 2] = [
        ("deformation", "m", |l| l.deformation),
        ("force", "N", |l| l.force),
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
