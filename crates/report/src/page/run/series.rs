//! Opening and force of levels over time, for curves that a reader zooms into.

use serde_json::{Value, json};

use super::packed::{Kind, packed};
use crate::page::html::turns;
use crate::result::{GapResult, RunResult};

/// Points of all curves on a page at most.
const MOST_POINTS: usize = 70_000;
/// Output times before and after a contact that are kept, if there is room.
const AROUND: usize = 25;
/// Parts of a motion whose extremes are kept.
const PARTS: usize = 800;

/// Curves of the governing level of each gap and of the levels that are hit, the hardest
/// first, as many as there is room for; `contact` finds the contact of a gap and level among
/// those of the picture.
pub(super) fn all(
    result: &RunResult,
    contact: impl Fn((usize, usize)) -> Option<usize>,
) -> Vec<Value> {
    let levels = levels(result);
    let kept = |(around, parts): (usize, usize)| -> Vec<Vec<usize>> {
        let rows = levels.iter().map(|(g, l)| {
            let gap = &result.gaps[*g];
            let governs = gap.governing_level() == Some(*l);
            // Where there is not room for all, the governing levels have the whole motion.
            let parts = if governs || parts == PARTS { parts } else { 16 };
            rows(result, (gap, *l), (around, parts))
        });
        rows.collect()
    };
    let mut asked = (AROUND, PARTS);
    let mut chosen = kept(asked);
    while chosen.iter().map(Vec::len).sum::<usize>() > MOST_POINTS && asked.0 > 3 {
        asked = (asked.0 / 2, (asked.1 / 2).max(50));
        chosen = kept(asked);
    }
    let mut points = 0;
    let fits = |rows: &Vec<usize>| {
        points += rows.len();
        points <= MOST_POINTS
    };
    let chosen: Vec<Vec<usize>> = chosen.into_iter().take_while(fits).collect();
    let curves = levels.iter().zip(chosen);
    let curve = |((g, l), rows): (&(usize, usize), Vec<usize>)| {
        let gap = &result.gaps[*g];
        let column = |values: &crate::result::Table, sign: f64| -> Vec<f64> {
            let value = |row: &usize| values.values.get(row * values.columns + l);
            rows.iter()
                .map(|row| value(row).map_or(f64::NAN, |x| sign * x))
                .collect()
        };
        let time: Vec<f64> = rows.iter().map(|row| result.time[*row]).collect();
        let force =
            (gap.force.columns > 0).then(|| packed(&column(&gap.force, 1.0), Kind::Float32));
        json!({
            "name": name(result, *g, *l),
            "contact": contact((*g, *l)),
            // With all digits: contacts may last microseconds.
            "time": packed(&time, Kind::Float64),
            "opening": packed(&column(&gap.penetration, -1.0), Kind::Float32),
            "force": force,
        })
    };
    curves.map(curve).collect()
}

/// A level with its gap, where there are several.
pub(super) fn name(result: &RunResult, gap: usize, level: usize) -> String {
    let label = &result.gaps[gap].levels[level].label;
    match result.gaps.len() {
        1 => format!("level {label}"),
        _ => match &result.gaps[gap].name {
            // In texts without elements signs set it apart.
            name if turns(name) => format!("\u{2068}{name}\u{2069}, level {label}"),
            name => format!("{name}, level {label}"),
        },
    }
}

/// Gaps and levels whose curves are wanted, the most wanted first.
fn levels(result: &RunResult) -> Vec<(usize, usize)> {
    let of_gaps = result.gaps.iter().enumerate();
    let mut levels: Vec<(bool, f64, (usize, usize))> = of_gaps
        .flat_map(|(g, gap)| {
            let governing = gap.governing_level();
            (0..gap.levels.len()).filter_map(move |l| {
                let here = gap.impacts.iter().filter(|i| i.level == l as u64 + 1);
                let hit = here.clone().next().is_some();
                let hardest = here.map(|i| i.impulse).filter(|x| x.is_finite());
                let governs = governing == Some(l);
                (hit || governs).then(|| (governs, hardest.fold(0.0, f64::max), (g, l)))
            })
        })
        .collect();
    levels.sort_by(|a, b| b.0.cmp(&a.0).then(b.1.total_cmp(&a.1)));
    levels.into_iter().map(|(_, _, place)| place).collect()
}

/// Output times that a curve keeps: around contacts all of them, and elsewhere the extremes
/// of each of so many parts.
fn rows(
    result: &RunResult,
    (gap, level): (&GapResult, usize),
    (around, parts): (usize, usize),
) -> Vec<usize> {
    let opening: Vec<f64> = gap.penetration.column(level).collect();
    let count = opening.len().min(result.time.len());
    let mut keep = vec![false; count];
    for impact in gap.impacts.iter().filter(|i| i.level == level as u64 + 1) {
        let first = result.time.partition_point(|t| *t < impact.t_close);
        let last = match impact.t_open.is_finite() {
            true => result.time.partition_point(|t| *t <= impact.t_open),
            false => first,
        };
        let range = first.saturating_sub(around)..(last + around).min(count);
        keep[range.start.min(count)..range.end].fill(true);
    }
    for part in 0..parts {
        let range = part * count / parts..(part + 1) * count / parts;
        let by_value = |a: &usize, b: &usize| opening[*a].total_cmp(&opening[*b]);
        for row in [
            range.clone().next(),
            range.clone().min_by(by_value),
            range.clone().max_by(by_value),
            range.clone().next_back(),
        ] {
            row.into_iter().for_each(|row| keep[row] = true);
        }
    }
    (0..count).filter(|row| keep[*row]).collect()
}
