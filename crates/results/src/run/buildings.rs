//! Storey responses, peaks and modes of every building.

use hdf5::{Dataset, Group};

use super::datasets::{matrix, series};
use super::{Result, RunRecord, elements, share_time};
use crate::dimension_scales;
use pounding_time_history::{Peak, StoreyPeaks};

pub(super) fn buildings(file: &hdf5::File, record: &RunRecord<'_>, time: &Dataset) -> Result<()> {
    let all = file.create_group("building")?;
    let system = record.system;
    for (index, building) in system.buildings().iter().enumerate() {
        let group = all.create_group(building.name())?;
        share_time(&group)?;
        let range = system.offsets()[index]..system.offsets()[index + 1];
        let storey = series(
            &group,
            "storey",
            "m",
            "floor elevation above the ground",
            building.elevations(),
        )?;
        dimension_scales::make_scale(&storey, "storey")?;
        let history = record.history;
        let table = |name: &str, units: &str, long_name: &str, rows: &[f64]| {
            let data = matrix(&group, name, units, long_name, rows, range.len())?;
            dimension_scales::attach(&data, time, 0)?;
            dimension_scales::attach(&data, &storey, 1)
        };
        let columns = |values: &[f64]| history.columns(values, range.clone());
        let drift_ratios = || -> Vec<f64> {
            let displacements = columns(&history.displacement);
            let rows = displacements.chunks_exact(range.len());
            rows.flat_map(|row| {
                let mut below = 0.0;
                let drifts = row
                    .iter()
                    .map(move |u| u - std::mem::replace(&mut below, *u));
                drifts.zip(building.height()).map(|(d, h)| d * (1.0 / h))
            })
            .collect()
        };
        table(
            "displacement",
            "m",
            "floor displacement relative to the ground",
            &columns(&history.displacement),
        )?;
        table(
            "velocity",
            "m s-1",
            "floor velocity relative to the ground",
            &columns(&history.velocity),
        )?;
        table(
            "acceleration_absolute",
            "m s-2",
            "absolute floor acceleration",
            &columns(&history.acceleration_absolute),
        )?;
        table(
            "drift_ratio",
            "1",
            "storey drift over storey height",
            &drift_ratios(),
        )?;
        table(
            "storey_shear",
            "N",
            "storey shear, elastic or by the storey's law",
            &columns(&history.storey_shear),
        )?;
        let peaks = group.create_group("peak")?;
        group.link_hard("storey", "peak/storey")?;
        storey_peaks(
            &peaks,
            "",
            &record.outcome.buildings[index].storeys,
            &storey,
        )?;
        storey_peaks(
            &peaks,
            "isolated_",
            &record.isolated.buildings[index].storeys,
            &storey,
        )?;
        elements::storeys((&group, &peaks), record, index, (time, &storey))?;
        let modes = building.modes();
        let period = series(&group, "period", "s", "natural periods", &modes.period)?;
        dimension_scales::make_scale(&period, "mode")?;
        let ratio = series(
            &group,
            "damping_ratio",
            "1",
            "modal damping ratios",
            &modes.damping_ratio,
        )?;
        dimension_scales::attach(&ratio, &period, 0)?;
    }
    Ok(())
}

fn storey_peaks(
    group: &Group,
    prefix: &str,
    peaks: &[StoreyPeaks],
    storey: &Dataset,
) -> Result<()> {
    type Pick = fn(&StoreyPeaks) -> Peak;
    let quantities: [(&str, &str, Pick); 4] = [
        ("displacement", "m", |p| p.displacement),
        ("drift_ratio", "1", |p| p.drift_ratio),
        ("storey_shear", "N", |p| p.storey_shear),
        ("acceleration_absolute", "m s-2", |p| {
            p.acceleration_absolute
        }),
    ];
    let without = if prefix.is_empty() {
        ""
    } else {
        " without pounding"
    };
    for (name, units, pick) in quantities {
        let values: Vec<f64> = peaks.iter().map(|p| pick(p).value).collect();
        let times: Vec<f64> = peaks.iter().map(|p| pick(p).time).collect();
        let label = name.replace('_', " ");
        let value = series(
            group,
            &format!("{prefix}{name}"),
            units,
            &format!("peak absolute {label}{without}"),
            &values,
        )?;
        let time = series(
            group,
            &format!("{prefix}{name}_time"),
            "s",
            &format!("time of peak {label}{without}"),
            &times,
        )?;
        dimension_scales::attach(&value, storey, 0)?;
        dimension_scales::attach(&time, storey, 0)?;
    }
    Ok(())
}
