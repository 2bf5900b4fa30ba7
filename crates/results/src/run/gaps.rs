//! Contact levels and impacts of every gap.

use hdf5::{Dataset, H5Type};
use pounding_time_history::{Impact, LevelPlace, Outcome, System};

use super::datasets::{series, table as rows_of};
use super::tables::{Content, Tables};
use super::{Result, levels, responses, share_time};
use crate::attributes::text;
use crate::dimension_scales;

/// One impact as a row of the compound table.
#[derive(Debug, Clone, Copy, H5Type)]
#[repr(C)]
struct ImpactRow {
    level: u64,
    t_close: f64,
    t_open: f64,
    approach_velocity: f64,
    separation_velocity: f64,
    achieved_restitution: f64,
    peak_force: f64,
    peak_force_time: f64,
    peak_penetration: f64,
    impulse: f64,
    energy_dissipated: f64,
    constants: [f64; 4],
}

impl ImpactRow {
    fn new(impact: &Impact) -> Self {
        Self {
            level: impact.level as u64 + 1,
            t_close: impact.time_closed,
            t_open: impact.time_opened,
            approach_velocity: impact.approach_velocity,
            separation_velocity: impact.separation_velocity,
            achieved_restitution: impact.achieved_restitution,
            peak_force: impact.peak_force.value,
            peak_force_time: impact.peak_force.time,
            peak_penetration: impact.peak_penetration.value,
            impulse: impact.impulse,
            energy_dissipated: impact.energy_dissipated,
            constants: std::array::from_fn(|i| impact.constants.get(i).copied().unwrap_or(0.0)),
        }
    }
}

/// Creates the groups of all gaps, with coordinates, models, and the datasets that grow.
pub(super) fn begin(
    file: &hdf5::File,
    system: &System,
    tables: &mut Tables,
    time: &Dataset,
) -> Result<()> {
    let all = file.create_group("gap")?;
    for gap in system.gaps() {
        let group = all.create_group(&gap.name)?;
        let range = gap.first_level..gap.first_level + gap.levels;
        let contact_levels = system.levels_of(gap);
        share_time(&group)?;
        let places: Vec<LevelPlace> = contact_levels.iter().map(|l| l.place).collect();
        let level = levels::coordinates(&group, &places)?;
        let width: Vec<f64> = contact_levels.iter().map(|l| l.width).collect();
        let width = series(&group, "width", "m", "width of the gap at rest", &width)?;
        dimension_scales::attach(&width, &level, 0)?;
        let of_levels = |list| Content::Columns(list, range.clone());
        for (names, content) in [
            (
                (
                    "penetration",
                    "m",
                    "penetration, negative while the gap is open",
                ),
                of_levels(|h| &h.penetration),
            ),
            (
                ("force", "N", "contact force, positive pushes apart"),
                of_levels(|h| &h.force),
            ),
        ] {
            let data = tables.add(&group, names, content)?;
            text(
                &data,
                "coordinates",
                &format!("{} width", levels::COORDINATES),
            )?;
            dimension_scales::attach(&data, time, 0)?;
            dimension_scales::attach(&data, &level, 1)?;
        }
        if let Some(first) = contact_levels.first() {
            text(&group, "model", first.model.descriptor().name)?;
            text(&group, "separation", first.model.separation().name())?;
        }
        text(&group, "between", &gap.between.join(" | "))?;
        responses::begin_levels(&group, system, gap, tables, (time, &level))?;
    }
    Ok(())
}

/// Adds widening and impacts of all gaps.
pub(super) fn finish(file: &hdf5::File, system: &System, outcome: &Outcome) -> Result<()> {
    for (index, gap) in system.gaps().iter().enumerate() {
        let group = file.group("gap")?.group(&gap.name)?;
        let level = group.dataset("level")?;
        let levels = outcome.gaps[index].levels.iter();
        let widened: Vec<f64> = levels.map(|l| l.gap_widening).collect();
        let long_name = "widening of the gap by plastic deformation over the run";
        let widening = series(&group, "widening", "m", long_name, &widened)?;
        dimension_scales::attach(&widening, &level, 0)?;
        responses::finish_levels(&group, &outcome.gaps[index].levels, &level)?;
        let levels = outcome.gaps[index].levels.iter();
        let clearance: Vec<Option<f64>> = levels.map(|l| l.clearance).collect();
        if clearance.iter().any(Option::is_some) {
            let values: Vec<f64> = clearance.iter().map(|c| c.unwrap_or(f64::NAN)).collect();
            let long_name = "clearance left beside a building on isolators, zero where the gap closed; NaN beside others";
            let clearance = series(&group, "clearance", "m", long_name, &values)?;
            dimension_scales::attach(&clearance, &level, 0)?;
        }
        let impacts = outcome.impacts.iter().filter(|i| i.gap == index);
        let rows: Vec<ImpactRow> = impacts.map(ImpactRow::new).collect();
        let impacts = rows_of(&group, "impacts", &rows)?;
        let numbers: Vec<f64> = (1..=rows.len()).map(|i| i as f64).collect();
        let number = series(&group, "impact", "1", "number of the impact", &numbers)?;
        dimension_scales::make_scale(&number, "impact")?;
        dimension_scales::attach(&impacts, &number, 0)?;
        text(
            &impacts,
            "long_name",
            "impacts in order of closure; level is the place in the dimension level, from 1; SI units",
        )?;
        if let Some(first) = system.levels_of(gap).first() {
            let constants = first.model.descriptor().constants.iter();
            let names: Vec<_> = constants.map(|c| c.name).collect();
            text(&impacts, "constants", &names.join(", "))?;
        }
    }
    Ok(())
}
