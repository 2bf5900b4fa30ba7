//! Responses with names of their own: histories in the group `response` of a building or a
//! contact level, peaks in the group `response` among its peaks.

use hdf5::{Dataset, Group};
use pounding_time_history::{Gap, LevelOutcome, NamedPeak, Peak, System};

use super::Result;
use super::datasets::{series, single, without};
use super::tables::{Content, Tables};
use crate::dimension_scales;

/// Creates the datasets that grow: of each response its name, its unit, and its column in the
/// history.
pub(super) fn begin<'a>(
    group: &Group,
    rows: impl Iterator<Item = ((&'a str, &'a str), usize)>,
    tables: &mut Tables,
    time: &Dataset,
) -> Result<()> {
    let mut rows = rows.peekable();
    if rows.peek().is_none() {
        return Ok(());
    }
    let group = group.create_group("response")?;
    for ((name, unit), column) in rows {
        let label = name.replace('_', " ");
        let names = (name, unit, label.as_str());
        let data = tables.add(&group, names, Content::Column(|h| &h.response, column))?;
        dimension_scales::attach(&data, time, 0)?;
    }
    Ok(())
}

/// Adds peaks with their times to the peaks of a building or a level.
pub(super) fn finish(peaks: &Group, prefix: &str, responses: &[NamedPeak]) -> Result<()> {
    if responses.is_empty() {
        return Ok(());
    }
    let without = without(prefix);
    let group = match peaks.link_exists("response") {
        true => peaks.group("response")?,
        false => peaks.create_group("response")?,
    };
    for response in responses {
        let label = response.name.replace('_', " ");
        let name = format!("{prefix}{}", response.name);
        let long_name = format!("peak absolute {label}{without}");
        single(
            &group,
            &name,
            response.unit,
            &long_name,
            response.peak.value,
        )?;
        let long_name = format!("time of peak {label}{without}");
        single(
            &group,
            &format!("{name}_time"),
            "s",
            &long_name,
            response.peak.time,
        )?;
    }
    Ok(())
}

/// Names and units of the responses that levels have, each once.
fn names<'a>(all: impl Iterator<Item = (&'a str, &'a str)>) -> Vec<(&'a str, &'a str)> {
    let mut names = Vec::new();
    for name in all {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// Creates the datasets of the levels of a gap, one column a level: zero where a level has no
/// such response.
pub(super) fn begin_levels(
    gap_group: &Group,
    system: &System,
    gap: &Gap,
    tables: &mut Tables,
    (time, level): (&Dataset, &Dataset),
) -> Result<()> {
    let own = gap.first_level..gap.first_level + gap.levels;
    let of_buildings = system.buildings().iter().map(|b| b.responses().len());
    let first: usize = of_buildings.sum();
    let rows: Vec<_> = (first..).zip(system.level_responses()).collect();
    let here = rows.iter().filter(|(_, (l, _))| own.contains(l));
    let names = names(here.map(|(_, (_, r))| (r.name.as_str(), r.unit)));
    if names.is_empty() {
        return Ok(());
    }
    let group = gap_group.create_group("response")?;
    for (name, unit) in names {
        let column = |level: usize| {
            let found = rows
                .iter()
                .find(|(_, (l, r))| *l == level && r.name == name);
            found.iter().map(|(column, _)| *column).collect()
        };
        let columns = own.clone().map(column).collect();
        let label = name.replace('_', " ");
        let content = Content::Sums(|h| &h.response, columns);
        let data = tables.add(&group, (name, unit, label.as_str()), content)?;
        dimension_scales::attach(&data, time, 0)?;
        dimension_scales::attach(&data, level, 1)?;
    }
    Ok(())
}

/// Adds the peaks of the levels of a gap, with their times, and capacities where one is known:
/// NaN where a level has no such response, or no capacity.
pub(super) fn finish_levels(
    gap_group: &Group,
    levels: &[LevelOutcome],
    level: &Dataset,
) -> Result<()> {
    let all = levels.iter().flat_map(|l| &l.responses);
    let names = names(all.map(|r| (r.name.as_str(), r.unit)));
    if names.is_empty() {
        return Ok(());
    }
    let group = gap_group.group("response")?.create_group("peak")?;
    for (name, unit) in names {
        let label = name.replace('_', " ");
        let of = |pick: fn(Peak) -> f64| -> Vec<f64> {
            let peak = |l: &LevelOutcome| {
                let found = l.responses.iter().find(|r| r.name == name);
                found.map_or(f64::NAN, |r| pick(r.peak))
            };
            levels.iter().map(peak).collect()
        };
        let long_name = format!("peak absolute {label}");
        let value = series(&group, name, unit, &long_name, &of(|p| p.value))?;
        let long_name = format!("time of peak {label}");
        let time_name = format!("{name}_time");
        let time = series(&group, &time_name, "s", &long_name, &of(|p| p.time))?;
        dimension_scales::attach(&value, level, 0)?;
        dimension_scales::attach(&time, level, 0)?;
        let capacity = |l: &LevelOutcome| {
            let found = l.responses.iter().find(|r| r.name == name);
            found.and_then(|r| r.capacity)
        };
        if levels.iter().any(|l| capacity(l).is_some()) {
            let known: Vec<f64> = levels
                .iter()
                .map(|l| capacity(l).unwrap_or(f64::NAN))
                .collect();
            let long_name = format!("capacity for {label}");
            let data = series(
                &group,
                &format!("{name}_capacity"),
                unit,
                &long_name,
                &known,
            )?;
            dimension_scales::attach(&data, level, 0)?;
        }
    }
    Ok(())
}
