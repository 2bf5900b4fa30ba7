//! Figures of the page.

use std::collections::BTreeMap;

use pounding_catalogue::numbers::shown_unit;

use super::words;
use crate::decimation::decimated;
use crate::error::ReportError;
use crate::figure::{Curve, Panel, figure_of_size};
use crate::page::html::{beside, figure};
use crate::result::{
    BuildingResult, GapResult, ImpactResult, LinkResult, RunResult, StoreyPeaks, Table,
};

/// Size of a history, and of a profile beside another (pixels): on paper text of both is as large
/// as in other figures.
const HISTORY: (u32, u32) = (718, 250);
const PROFILE: (u32, u32) = (352, 300);
/// Parts of a history: a curve has no more points than the picture can show, and fewer where
/// many pictures have to fit on a page.
const COLUMNS: usize = 1000;
const COLUMNS_OF_ALL: usize = 10_000;
/// Levels whose stems can be told apart.
const MOST_LEVELS: usize = 6;

type Outcome = Result<String, ReportError>;

fn history(result: &RunResult, name: &str, values: impl Iterator<Item = f64>) -> Curve {
    let points: Vec<(f64, f64)> = result.time.iter().copied().zip(values).collect();
    Curve {
        name: name.to_owned(),
        points: decimated(&points, columns(result)),
    }
}

fn columns(result: &RunResult) -> usize {
    let curves = result.buildings.len() + result.gaps.len() + 6;
    (COLUMNS_OF_ALL / curves).clamp(100, COLUMNS)
}

fn over_time(caption: &str, curves: Vec<Curve>) -> Panel {
    Panel {
        caption: caption.to_owned(),
        horizontal: "time (s)".to_owned(),
        curves,
    }
}

fn wide(panels: &[Panel], words: &str) -> Outcome {
    Ok(figure(&figure_of_size(panels, HISTORY), words))
}

/// Ground acceleration.
pub(super) fn ground(result: &RunResult) -> Outcome {
    let a = result.ground_acceleration.iter().copied();
    let curve = history(result, "ground", a);
    wide(
        &[over_time("Ground acceleration (m/s\u{b2})", vec![curve])],
        "Ground acceleration over time",
    )
}

/// Displacement of the roof.
pub(super) fn roof(result: &RunResult, index: usize) -> Outcome {
    let building = &result.buildings[index];
    let top = building.displacement.columns.saturating_sub(1);
    let u = building.displacement.column(top).map(|u| 1.0e3 * u);
    let curve = history(result, &building.name, u);
    let words = format!("Displacement of the roof of {} over time", building.name);
    wide(
        &[over_time("Displacement of the roof (mm)", vec![curve])],
        &words,
    )
}

/// Peaks over the height, with and without pounding.
pub(super) fn profiles(result: &RunResult, building: &BuildingResult) -> Outcome {
    let ground = &result.ground_acceleration;
    let ground = ground.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    // What links do is no pounding.
    let together = match result.links.is_empty() {
        true => "with pounding",
        false => "with gaps and links",
    };
    // `base` is the value at the ground; a value for each storey has none.
    let profile = |caption: &str, (peaks, factor): (&StoreyPeaks, f64), base: Option<f64>| {
        let curve = |name: &str, values: &[f64]| {
            let mut points: Vec<(f64, f64)> = values
                .iter()
                .zip(&building.elevation)
                .map(|(x, z)| (factor * x, *z))
                .collect();
            match base {
                Some(base) => points.insert(0, (base, 0.0)),
                None => points = steps(&points),
            }
            Curve {
                name: name.to_owned(),
                points,
            }
        };
        let panel = Panel {
            caption: format!("Elevation (m) over {caption}"),
            horizontal: caption.to_owned(),
            curves: vec![
                curve(together, &peaks.value),
                curve("isolated", &peaks.isolated),
            ],
        };
        let words = format!("Elevation over {caption} of {}", building.name);
        Ok::<_, ReportError>(figure(&figure_of_size(&[panel], PROFILE), &words))
    };
    Ok(beside(&[
        profile(
            "peak displacement (mm)",
            (&building.displacement_peaks, 1.0e3),
            Some(0.0),
        )?,
        profile("peak drift (%)", (&building.drift_peaks, 1.0e2), None)?,
        profile(
            "peak storey shear (kN)",
            (&building.shear_peaks, 1.0e-3),
            None,
        )?,
        profile(
            "peak absolute acceleration (m/s\u{b2})",
            (&building.acceleration_peaks, 1.0),
            Some(ground),
        )?,
    ]))
}

/// A value for each storey as steps from floor to floor.
fn steps(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut below = 0.0;
    let mut out = Vec::with_capacity(2 * points.len());
    for (x, z) in points {
        out.push((*x, below));
        out.push((*x, *z));
        below = *z;
    }
    out
}

/// Opening of the level that is hit hardest, or comes closest, and all impacts.
pub(super) fn gap(result: &RunResult, gap: &GapResult) -> Outcome {
    let Some(level) = gap.governing_level() else {
        return Ok(String::new());
    };
    let opening = gap.penetration.column(level).map(|d| -1.0e3 * d);
    let at = words::level(&gap.levels[level]);
    let mut panels = vec![over_time(
        &format!("Distance across the gap at {at} (mm); negative in contact"),
        vec![history(result, &at, opening)],
    )];
    let end = result.time.last().copied().unwrap_or(0.0);
    // Velocity jumps have no force.
    if gap.impacts.iter().any(|i| i.force().is_finite()) {
        let force = |i: &ImpactResult| (i.peak_force_time, 1.0e-3 * i.force());
        panels.push(over_time(
            "Peak force of every impact (kN)",
            stems((gap, columns(result)), end, force),
        ));
    }
    if !gap.impacts.is_empty() {
        let velocity = |i: &ImpactResult| (i.t_close, i.approach_velocity);
        panels.push(over_time(
            "Approach velocity of every impact (m/s)",
            stems((gap, columns(result)), end, velocity),
        ));
    }
    let words = format!(
        "Distance across the gap {}, and its impacts, over time",
        gap.name
    );
    wide(&panels, &words)
}

/// Deformation and force of the level of a link with the greatest force.
pub(super) fn link(result: &RunResult, link: &LinkResult) -> Outcome {
    let Some(level) = link.governing_level() else {
        return Ok(String::new());
    };
    let [(length, length_unit), (force, force_unit)] =
        [&link.units[0], &link.units[1]].map(|unit| shown_unit(unit));
    let at = words::level(&link.levels[level]);
    let of = |table: &Table, factor: f64| {
        let values = (level < table.columns).then(|| table.column(level));
        history(
            result,
            &at,
            values.into_iter().flatten().map(|x| factor * x),
        )
    };
    let (name, ways) = match link.turns() {
        true => ("Moment", ""),
        false => ("Force", "; positive in tension"),
    };
    let panels = [
        over_time(
            &format!("Deformation at {at} ({length_unit})"),
            vec![of(&link.deformations, length)],
        ),
        over_time(
            &format!("{name} at {at} ({force_unit}){ways}"),
            vec![of(&link.forces, force)],
        ),
    ];
    let words = format!("Deformation and force of link {} over time", link.name);
    wide(&panels, &words)
}

/// A stem for each impact, a curve for each level that has any, or one for all where there are
/// many; all over the whole time. Of more stems than the picture can show the longest of each
/// part of the time are left.
fn stems(
    (gap, columns): (&GapResult, usize),
    end: f64,
    stem: impl Fn(&ImpactResult) -> (f64, f64),
) -> Vec<Curve> {
    let hit = |l: &usize| gap.impacts.iter().any(|i| i.level == *l as u64 + 1);
    let levels: Vec<usize> = (0..gap.levels.len()).filter(hit).collect();
    let curve = |name: String, wanted: &dyn Fn(&ImpactResult) -> bool| {
        let mut longest: BTreeMap<usize, (f64, f64)> = BTreeMap::new();
        let impacts = gap.impacts.iter().filter(|i| wanted(i)).map(&stem);
        for (t, y) in impacts.filter(|(t, y)| t.is_finite() && y.is_finite()) {
            let part = (t / end * columns as f64) as usize;
            let known = longest.entry(part).or_insert((t, y));
            if y > known.1 {
                *known = (t, y);
            }
        }
        let inner = longest.into_values();
        let inner = inner.flat_map(|(t, y)| [(t, 0.0), (t, y), (t, 0.0)]);
        let ends = [(0.0, 0.0), (end, 0.0)];
        Curve {
            name,
            points: ends[..1]
                .iter()
                .copied()
                .chain(inner)
                .chain([ends[1]])
                .collect(),
        }
    };
    if levels.len() > MOST_LEVELS {
        return vec![curve("all levels".to_owned(), &|_| true)];
    }
    let levels = levels.into_iter();
    levels
        .map(|l| curve(words::level(&gap.levels[l]), &|i| i.level == l as u64 + 1))
        .collect()
}

/// Energies over time.
pub(super) fn energy(result: &RunResult) -> Outcome {
    let e = &result.energy;
    let stored: Vec<f64> = e
        .kinetic
        .iter()
        .zip(&e.strain)
        .map(|(a, b)| a + b)
        .collect();
    let curves = [
        ("input", &e.input),
        ("kinetic and recoverable", &stored),
        ("viscous damping", &e.viscous),
        ("yielding and links", &e.hysteretic),
        ("impacts", &e.impact),
    ]
    .into_iter()
    // Nothing yields in elastic buildings.
    .filter(|(_, values)| values.iter().any(|x| *x != 0.0))
    .map(|(name, values)| history(result, name, values.iter().map(|x| 1.0e-3 * x)));
    wide(
        &[over_time("Energy (kJ)", curves.collect())],
        "Energies over time",
    )
}
