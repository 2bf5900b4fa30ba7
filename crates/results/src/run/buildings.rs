//! Storey responses, peaks and modes of every building.

use hdf5::{Dataset, Group};
use pounding_time_history::{IsolatorOutcome, Peak, StoreyPeaks, System};

use super::datasets::{series, single, without};
use super::tables::{Content, Tables};
use super::{Result, RunEnding, elements, frames, share_time};
use crate::attributes::text;
use crate::dimension_scales;

/// Names of the buildings whose base moment is known, those with a stiffness matrix.
pub(crate) fn with_base_moment(system: &System) -> impl Iterator<Item = &str> {
    let buildings = system.buildings().iter();
    let buildings = buildings.filter(|b| b.stiffness().is_empty());
    buildings.map(|b| b.name())
}

/// Ground accelerations of a building of its own, along the row and across it.
const GROUND: [(&str, &str); 2] = [
    (
        "ground_acceleration",
        "acceleration of the ground under this building",
    ),
    (
        "ground_acceleration_across",
        "acceleration of the ground under this building across the row",
    ),
];

/// Creates the groups of all buildings, with coordinates, modes, and the datasets that grow.
pub(super) fn begin(
    file: &hdf5::File,
    system: &System,
    tables: &mut Tables,
    time: &Dataset,
) -> Result<()> {
    let all = file.create_group("building")?;
    let (mut drifts, mut responses) = (0, 0);
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
        let of_floors = |list| Content::Columns(list, range.clone());
        let height = building.height().to_vec();
        let of_drifts = match building.drifts() {
            None => Content::DriftRatios(range.clone(), height),
            Some(rows) => {
                let own = drifts..drifts + rows.len();
                drifts = own.end;
                Content::OverHeights(own, height)
            }
        };
        for (names, content) in [
            (
                (
                    "displacement",
                    "m",
                    "floor displacement relative to the ground",
                ),
                of_floors(|h| &h.displacement),
            ),
            (
                ("velocity", "m s-1", "floor velocity relative to the ground"),
                of_floors(|h| &h.velocity),
            ),
            (
                (
                    "acceleration_absolute",
                    "m s-2",
                    "absolute floor acceleration",
                ),
                of_floors(|h| &h.acceleration_absolute),
            ),
            (
                ("drift_ratio", "1", "storey drift over storey height"),
                of_drifts,
            ),
            (
                (
                    "storey_shear",
                    "N",
                    "storey shear, elastic or by the storey's law",
                ),
                of_floors(|h| &h.storey_shear),
            ),
        ] {
            let data = tables.add(&group, names, content)?;
            dimension_scales::attach(&data, time, 0)?;
            dimension_scales::attach(&data, &storey, 1)?;
        }
        for (motion, (name, long_name)) in system.motions_under(index).into_iter().zip(GROUND) {
            let Some(motion) = motion.cloned() else {
                continue;
            };
            let names = (name, "m s-2", long_name);
            let data = tables.add(&group, names, Content::Ground(motion))?;
            dimension_scales::attach(&data, time, 0)?;
        }
        let forces = system.forces().iter().filter(|f| f.building == index);
        let forces: Vec<_> = forces.cloned().collect();
        if !forces.is_empty() {
            let names = ("applied_force", "N", "sum of the forces on a floor");
            let content = Content::Forces(forces, building.storeys());
            let data = tables.add(&group, names, content)?;
            dimension_scales::attach(&data, time, 0)?;
            dimension_scales::attach(&data, &storey, 1)?;
        }
        if let Some(column) = with_base_moment(system).position(|name| name == building.name()) {
            let names = ("base_moment", "N m", "overturning moment at the base");
            let data = tables.add(&group, names, Content::Column(|h| &h.base_moment, column))?;
            dimension_scales::attach(&data, time, 0)?;
        }
        let first = responses;
        responses += building.responses().len();
        let rows = building.responses().iter();
        let rows = rows.map(|row| (row.name.as_str(), row.unit)).zip(first..);
        super::responses::begin(&group, rows, tables, time)?;
        elements::begin_storeys(&group, system, index, tables, (time, &storey))?;
        frames::begin(&group, (system, index), tables, time)?;
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

/// Adds peaks and what remains of the storeys of all buildings.
pub(super) fn finish(file: &hdf5::File, system: &System, ending: &RunEnding<'_>) -> Result<()> {
    for (index, building) in system.buildings().iter().enumerate() {
        let group = file.group("building")?.group(building.name())?;
        let storey = group.dataset("storey")?;
        let peaks = group.create_group("peak")?;
        group.link_hard("storey", "peak/storey")?;
        for (prefix, outcome) in [("", ending.outcome), ("isolated_", ending.isolated)] {
            let building = &outcome.buildings[index];
            storey_peaks(&peaks, prefix, &building.storeys, &storey)?;
            if let Some(moment) = building.base_moment {
                base_moment(&peaks, prefix, moment)?;
            }
            super::responses::finish(&peaks, prefix, &building.responses)?;
        }
        if let Some(isolator) = &ending.outcome.buildings[index].isolator {
            let isolated = ending.isolated.buildings[index].isolator;
            isolators(&group, isolator, isolated.as_ref())?;
        }
        elements::finish_storeys((&group, &peaks), &ending.outcome.buildings[index], &storey)?;
        frames::finish(&group, &ending.outcome.buildings[index])?;
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
    // Name, what has an absolute peak, unit and value.
    let quantities: [(&str, &str, &str, Pick); 4] = [
        ("displacement", "displacement", "m", |p| p.displacement),
        ("drift_ratio", "drift ratio", "1", |p| p.drift_ratio),
        ("storey_shear", "storey shear", "N", |p| p.storey_shear),
        ("acceleration_absolute", "acceleration", "m s-2", |p| {
            p.acceleration_absolute
        }),
    ];
    let without = without(prefix);
    for (name, label, units, pick) in quantities {
        let values: Vec<f64> = peaks.iter().map(|p| pick(p).value).collect();
        let times: Vec<f64> = peaks.iter().map(|p| pick(p).time).collect();
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
            &format!("time of peak absolute {label}{without}"),
            &times,
        )?;
        dimension_scales::attach(&value, storey, 0)?;
        dimension_scales::attach(&time, storey, 0)?;
    }
    Ok(())
}

/// The peak of the overturning moment at the base of a building.
fn base_moment(group: &Group, prefix: &str, peak: Peak) -> Result<()> {
    let without = without(prefix);
    let name = format!("{prefix}base_moment");
    let long_name = format!("peak absolute overturning moment at the base{without}");
    single(group, &name, "N m", &long_name, peak.value)?;
    let long_name = format!("time of peak overturning moment at the base{without}");
    single(group, &format!("{name}_time"), "s", &long_name, peak.time)?;
    Ok(())
}

/// Model, peaks and effective properties of the isolators under a building.
fn isolators(
    group: &Group,
    with: &IsolatorOutcome,
    isolated: Option<&IsolatorOutcome>,
) -> Result<()> {
    let group = group.create_group("isolator")?;
    text(&group, "model", with.model)?;
    for (prefix, isolator) in [("", Some(with)), ("isolated_", isolated)] {
        let Some(isolator) = isolator else { continue };
        let without = without(prefix);
        for (name, unit, what, value) in [
            (
                "displacement",
                "m",
                "peak displacement of the isolators",
                isolator.displacement.value,
            ),
            (
                "displacement_time",
                "s",
                "time of peak displacement of the isolators",
                isolator.displacement.time,
            ),
            (
                "force",
                "N",
                "peak force of the law of the isolators",
                isolator.force.value,
            ),
            (
                "force_time",
                "s",
                "time of peak force of the isolators",
                isolator.force.time,
            ),
            (
                "effective_period",
                "s",
                "period of the secant stiffness at the peak displacement",
                isolator.effective_period,
            ),
            (
                "effective_damping_ratio",
                "1",
                "damping ratio of a loop to the peak displacement, without dashpots",
                isolator.effective_damping_ratio,
            ),
        ] {
            let long_name = format!("{what}{without}");
            single(&group, &format!("{prefix}{name}"), unit, &long_name, value)?;
        }
    }
    Ok(())
}
