//! Opening and force of levels over time, for curves that a reader zooms into.

use serde_json::{Value, json};

use super::animation::name;
use super::figures::governing_level;
use super::packed::{Kind, packed};
use crate::result::{GapResult, RunResult};

/// Points of all curves on a page at most.
const MOST_POINTS: usize = 80_000;
/// Output times before and after a contact that are kept, if there is room.
const AROUND: usize = 25;
/// Parts of a motion whose extremes are kept.
const PARTS: usize = 800;

/// Curves of the levels that are hit, and of the governing level of each gap; `contact`
/// finds the contact of a gap and level among those of the picture.
pub(super) fn all(
    result: &RunResult,
    contact: impl Fn((usize, usize)) -> Option<usize>,
) -> Vec<Value> {
    let levels = result.gaps.iter().enumerate().flat_map(|(g, gap)| {
        let governing = governing_level(gap);
        let hit = move |l: usize| gap.impacts.iter().any(|i| i.level == l as u64 + 1);
        let wanted = (0..gap.levels.len()).filter(move |l| Some(*l) == governing || hit(*l));
        wanted.map(move |l| (g, l))
    });
    let levels: Vec<(usize, usize)> = levels.collect();
    if levels.is_empty() {
        return Vec::new();
    }
    let kept = |(around, parts): (usize, usize)| -> Vec<Vec<usize>> {
        let rows = levels.iter().map(|(g, l)| {
            let gap = &result.gaps[*g];
            let governs = governing_level(gap) == Some(*l);
            // Where there is not room for all, the governing levels have the whole motion.
            let parts = if governs || parts == PARTS { parts } else { 16 };
            rows(result, (gap, *l), (around, parts))
        });
        rows.collect()
    };
    let mut asked = (AROUND, PARTS);
    let mut chosen = kept(asked);
    while chosen.iter().map(Vec::len).sum::<usize>() > MOST_POINTS && asked.0 > 1 {
        asked = (asked.0 / 2, (asked.1 / 2).max(16));
        chosen = kept(asked);
    }
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
            "time": packed(&time, Kind::Float32),
            "opening": packed(&column(&gap.penetration, -1.0), Kind::Float32),
            "force": force,
        })
    };
    curves.map(curve).collect()
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
