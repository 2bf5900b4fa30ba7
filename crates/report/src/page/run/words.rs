//! The answers in sentences.

use super::tables::direction;
use crate::page::html::{named, number, sentences, warnings};
use crate::page::numbers::{all_figures, figures, percent, ratio as times};
use crate::result::{
    BuildingResult, GapResult, ImpactResult, LevelResult, LinkResult, RunResult, StoreyPeaks,
};
use pounding_catalogue::numbers::shown_unit;
use pounding_catalogue::wording::counted;
use pounding_elevation::WALL;
use pounding_time_history::VELOCITY_JUMPS;

/// The summary: warnings, how hard they hit, what it did to the buildings, the ledger.
pub(super) fn summary(result: &RunResult) -> String {
    let (gaps, more) = hardest(result);
    let mut points: Vec<String> = gaps.iter().filter_map(|gap| hit(gap)).collect();
    if !more.is_empty() {
        let impacts: usize = more.iter().map(|gap| gap.impacts.len()).sum();
        points.push(format!(
            "{} more below, hit less hard, with {}.",
            counted(more.len(), "gap"),
            counted(impacts, "impact"),
        ));
    }
    let (links, fewer) = strongest(result);
    let told = links.into_iter();
    points.extend(told.filter_map(|link| pulled(link, &result.time)));
    if fewer > 0 {
        points.push(format!(
            "{} more below, which bear less.",
            counted(fewer, "link")
        ));
    }
    if points.is_empty() {
        points.push("There is no gap with a contact level.".to_owned());
    }
    points.extend(result.gaps.iter().filter_map(beyond_capacity));
    if !result.links.is_empty() || result.gaps.iter().any(|g| !g.impacts.is_empty()) {
        points.extend(most_changed(result).into_iter().filter_map(changed));
        if let Some(more @ 1..) = result.buildings.len().checked_sub(MOST) {
            points.push(format!(
                "{} more below, whose accelerations rise less.",
                counted(more, "building")
            ));
        }
    }
    if result.gaps.iter().any(GapResult::jumps) {
        points.push(VELOCITY_JUMPS.to_owned());
    }
    points.push(ledger(result));
    sentences(&points) + &warnings(&result.warnings)
}

/// Ratio to the response of the isolated building beyond which that is round-off.
const OF_NOTHING: f64 = 1.0e6;
/// Gaps, links and buildings that have a sentence of their own in the summary.
const MOST: usize = 6;

/// The buildings whose accelerations pounding raises most, in the order of the case.
fn most_changed(result: &RunResult) -> Vec<&BuildingResult> {
    let rise = |building: &BuildingResult| {
        let peaks = &building.acceleration_peaks;
        let ratios = peaks.value.iter().zip(&peaks.isolated).map(|(a, b)| a / b);
        ratios.filter(|r| r.is_finite()).fold(0.0, f64::max)
    };
    let mut places: Vec<usize> = (0..result.buildings.len()).collect();
    let of = |place: &usize| rise(&result.buildings[*place]);
    places.sort_by(|a, b| of(b).total_cmp(&of(a)));
    places.truncate(MOST);
    places.sort_unstable();
    places
        .iter()
        .map(|place| &result.buildings[*place])
        .collect()
}

/// The gaps that are hit hardest, in the order of the case, and all others.
fn hardest(result: &RunResult) -> (Vec<&GapResult>, Vec<&GapResult>) {
    // Velocity jumps have no force to go by.
    let jumps = result.gaps.iter().any(GapResult::jumps);
    let size = |gap: &GapResult| {
        let hardest = gap.hardest_first();
        let size = |i: &&ImpactResult| if jumps { i.impulse } else { i.force() };
        hardest.first().map_or(0.0, size)
    };
    let mut sizes: Vec<f64> = result.gaps.iter().map(size).collect();
    sizes.sort_by(|a, b| b.total_cmp(a));
    let least = sizes.get(MOST.min(sizes.len()).saturating_sub(1)).copied();
    let least = least.unwrap_or(0.0);
    result.gaps.iter().partition(|gap| !(size(gap) < least))
}

/// What at the levels of a gap exceeds its capacity by most, as the shear of columns that are hit.
fn beyond_capacity(gap: &GapResult) -> Option<String> {
    let ratios = gap.responses.iter().flat_map(|r| {
        let levels = r.value.iter().zip(&r.capacity).enumerate();
        levels.map(move |(l, (value, capacity))| (r, l, value / capacity))
    });
    let known = ratios.filter(|(.., ratio)| *ratio > 1.0);
    let (response, l, ratio) = known.max_by(|a, b| a.2.total_cmp(&b.2))?;
    let path = format!("gap/{}/response/peak/{}", gap.name, response.name);
    let from = format!("{path}[{l}] / {path}_capacity[{l}]");
    Some(format!(
        "<strong>Gap {}: the {} at {} is {} times its capacity.</strong>",
        named(&gap.name),
        response.name.replace('_', " "),
        named(&level(&gap.levels[l])),
        number(&from, 1.0, &figures(ratio)),
    ))
}

/// How hard the floors on both sides of a gap hit.
fn hit(gap: &GapResult) -> Option<String> {
    let level = gap.governing_level()?;
    let name = named(&gap.name);
    let path = format!("gap/{}", gap.name);
    let at = |l: usize| named(&self::level(&gap.levels[l]));
    if gap.impacts.is_empty() {
        let nearest = gap
            .penetration
            .column(level)
            .fold(f64::NEG_INFINITY, f64::max);
        return Some(format!(
            "<strong>Gap {name} stays open.</strong> On the output grid it is narrowest at {}: \
             {} mm of {} mm are left.",
            at(level),
            number(
                &format!("maximum {path}/penetration[:,{level}]"),
                -1.0e3,
                &figures(-1.0e3 * nearest),
            ),
            number(
                &format!("{path}/width[{level}]"),
                1.0e3,
                &figures(1.0e3 * gap.width[level]),
            ),
        ));
    }
    let hardest = *gap.hardest_first().first()?;
    let place = gap.impacts.iter().position(|i| std::ptr::eq(i, hardest));
    let row = place.unwrap_or_default();
    let of = |column: &str, factor: f64, value: f64| {
        let from = format!("{path}/impacts[{row}].{column}");
        number(&from, factor, &figures(factor * value))
    };
    let force = match gap.jumps() {
        true => format!(
            "with an impulse of {} kN s",
            of("impulse", 1.0e-3, hardest.impulse)
        ),
        false => format!("with {} kN", of("peak_force", 1.0e-3, hardest.force())),
    };
    let times = match gap.impacts.len() {
        1 => "once".to_owned(),
        count => {
            let from = format!("count {path}/impacts[:].level");
            format!("{} times", number(&from, 1.0, &count.to_string()))
        }
    };
    let levels = (0..gap.levels.len())
        .filter(|l| gap.impacts.iter().any(|i| i.level == *l as u64 + 1))
        .count();
    Some(format!(
        "<strong>Gap {name} closes {times}</strong> at {levels} of {}. The hardest impact \
         hits {force} at {}, {} s into the motion, approaching with {} m/s ({}).",
        counted(gap.levels.len(), "level"),
        at(level),
        of("t_close", 1.0, hardest.t_close),
        of("approach_velocity", 1.0, hardest.approach_velocity),
        named(&gap.model),
    ))
}

/// The links with the greatest forces, in the order of the case, and how many others there are.
fn strongest(result: &RunResult) -> (Vec<&LinkResult>, usize) {
    let most = |link: &LinkResult| link.force.iter().copied().fold(0.0, f64::max);
    let mut places: Vec<usize> = (0..result.links.len()).collect();
    places.sort_by(|a, b| most(&result.links[*b]).total_cmp(&most(&result.links[*a])));
    let fewer = places.len().saturating_sub(MOST);
    places.truncate(MOST);
    places.sort_unstable();
    (
        places.into_iter().map(|at| &result.links[at]).collect(),
        fewer,
    )
}

/// What a link bears where it bears most.
fn pulled(link: &LinkResult, times: &[f64]) -> Option<String> {
    let l = link.governing_level()?;
    let name = named(&link.name);
    if link.force[l] == 0.0 {
        return Some(format!(
            "<strong>Link {name} never bears a force</strong> ({}).",
            named(&link.law)
        ));
    }
    let path = format!("link/{}/peak", link.name);
    let [(length, length_unit), (force, force_unit)] =
        [&link.units[0], &link.units[1]].map(|unit| shown_unit(unit));
    let of = |column: &str, factor: f64, values: &[f64]| {
        let from = format!("{path}/{column}[{l}]");
        number(&from, factor, &figures(factor * values[l]))
    };
    let kind = ["force", "moment"][usize::from(link.turns())];
    let way = direction(link, times, l).map_or_else(String::new, |way| format!(" in {way}"));
    Some(format!(
        "<strong>Link {name} bears a {kind} of at most {} {force_unit}{way}</strong>, at {}, {} s into the motion, and \
         deforms by at most {} {length_unit} ({}).",
        of("force", force, &link.force),
        named(&level(&link.levels[l])),
        of("force_time", 1.0, &link.force_time),
        of("deformation", length, &link.deformation),
        named(&link.law),
    ))
}

/// A level with the elevations of both sides.
pub(super) fn level(level: &LevelResult) -> String {
    let [left, right] = level.elevations.map(|z| match z.is_finite() {
        true => format!("{} m", figures(z)),
        false if level.label.split('-').any(|side| side == WALL) => WALL.to_owned(),
        false => figures(z),
    });
    format!("level {} ({left} | {right})", level.label)
}

/// What pounding changed in a building: the largest rise of each quantity.
fn changed(building: &BuildingResult) -> Option<String> {
    let path = format!("building/{}/peak", building.name);
    // Ratio, value and value of the isolated building.
    let three = |name: &str, row: &str, factor: f64, (with, without): (f64, f64)| {
        let [here, isolated] = ["", "isolated_"].map(|of| format!("{path}/{of}{name}{row}"));
        let ratio = format!("{here} / {isolated}");
        [
            number(&ratio, 1.0, &times(with, without)),
            number(&here, factor, &all_figures(factor * with)),
            number(&isolated, factor, &all_figures(factor * without)),
        ]
    };
    let rise = |what: &str, name: &str, peaks: &StoreyPeaks, (factor, unit): (f64, &str)| {
        let ratios = peaks.value.iter().zip(&peaks.isolated).map(|(a, b)| a / b);
        let most = ratios
            .enumerate()
            .filter(|(_, r)| r.is_finite())
            .max_by(|a, b| a.1.total_cmp(&b.1));
        let (storey, _) = most?;
        let both = (peaks.value[storey], peaks.isolated[storey]);
        let [ratio, with, without] = three(name, &format!("[{storey}]"), factor, both);
        Some(format!(
            "{what} at most {ratio} times (storey {}: {with} {unit}, alone {without} {unit})",
            storey + 1,
        ))
    };
    let base = building.base_moment.filter(|m| m.isolated > 0.0);
    let base = base.map(|moment| {
        let both = (moment.value, moment.isolated);
        let [ratio, with, without] = three("base_moment", "", 1.0e-3, both);
        format!("overturning moment at the base {ratio} times ({with} kN m, alone {without} kN m)")
    });
    // Such as those of the edges of a plan that turns, which go further than the mass centre.
    let named_responses = building.responses.iter();
    let named_responses = named_responses.map(|r| (r, r.value / r.isolated));
    let most = named_responses
        .filter(|(_, ratio)| !ratio.is_nan())
        .max_by(|a, b| a.1.total_cmp(&b.1));
    let response = most.map(|(response, most)| {
        let (factor, unit) = match shown_unit(&response.unit) {
            (factor, "-" | "1") => (factor, String::new()),
            (factor, unit) => (factor, format!(" {}", unit.replace("s2", "s\u{b2}"))),
        };
        let name = named(&response.name.replace('_', " "));
        let from = format!("{path}/response/{}", response.name);
        let value = number(&from, factor, &all_figures(factor * response.value));
        if most > OF_NOTHING {
            return format!("{name} {value}{unit}, of which there is none alone");
        }
        let isolated = format!("{path}/response/isolated_{}", response.name);
        let quotient = format!("{from} / {isolated}");
        format!(
            "{name} at most {} times ({value}{unit}, alone {}{unit})",
            number(&quotient, 1.0, &times(response.value, response.isolated)),
            number(&isolated, factor, &all_figures(factor * response.isolated)),
        )
    });
    let parts = [
        rise(
            "displacement",
            "displacement",
            &building.displacement_peaks,
            (1.0e3, "mm"),
        ),
        rise(
            "storey shear",
            "storey_shear",
            &building.shear_peaks,
            (1.0e-3, "kN"),
        ),
        rise(
            "acceleration",
            "acceleration_absolute",
            &building.acceleration_peaks,
            (1.0, "m/s\u{b2}"),
        ),
        base,
        response,
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| {
        format!(
            "Peaks of building {} beside those without its neighbours: {}.",
            named(&building.name),
            parts.join(", ")
        )
    })
}

fn ledger(result: &RunResult) -> String {
    format!(
        "The energy ledger closes to {} of the largest input energy.",
        number(
            "energy@residual_ratio",
            1.0,
            &match result.residual_ratio {
                0.0 => "0".to_owned(),
                ratio => format!("{ratio:.1e}"),
            }
        )
    )
}

/// What stands beside a gap, and the model in it.
pub(super) fn gap(gap: &GapResult) -> String {
    let model = match gap.model.as_str() {
        "" => "no common level".to_owned(),
        model => format!(
            "impact model {model}, separation at {}",
            gap.separation.replace('_', " ")
        ),
    };
    let mut out = format!(
        "<p>{} &middot; {}</p>\n",
        sides(&gap.between),
        named(&model)
    );
    if gap.jumps() {
        out.push_str(
            "<p class=\"note\">Velocities jump at impacts: there is no force, and floor \
             accelerations do not include the jumps. Forces are those that hold floors together \
             where contact lasts.</p>\n",
        );
    }
    out
}

/// What stands on both sides, each by itself: together they would stand in the direction of the first.
fn sides(between: &str) -> String {
    let sides = between.split(" | ").map(named);
    sides.collect::<Vec<_>>().join(" | ")
}

/// What brings the energy, with its verb.
fn sources(result: &RunResult) -> String {
    let buildings = &result.buildings;
    let moving = buildings.iter().any(|b| b.on_moving_ground);
    let pushed = buildings.iter().any(|b| b.pushed);
    let of_start = [&result.energy.kinetic, &result.energy.strain];
    let of_start = of_start.iter().filter_map(|e| e.first());
    let started = of_start.into_iter().any(|e| *e != 0.0);
    let all = [
        ("ground motion", moving),
        ("forces on floors", pushed),
        ("initial motion", started),
    ];
    let names = all
        .iter()
        .filter(|(_, given)| *given)
        .map(|(name, _)| *name);
    match names.collect::<Vec<_>>()[..] {
        [] => "The excitation brings".to_owned(),
        ["forces on floors"] => "The forces on floors bring".to_owned(),
        [one] => format!("The {one} brings"),
        [ref others @ .., last] => format!("The {} and {last} bring", others.join(", ")),
    }
}

/// Where the energy went.
pub(super) fn energy(result: &RunResult) -> String {
    let e = &result.energy;
    let last = |values: &[f64]| values.last().copied().unwrap_or(f64::NAN);
    let whole = last(&e.input);
    let parts = [
        ("viscous damping", "viscous", last(&e.viscous)),
        ("yielding and links", "hysteretic", last(&e.hysteretic)),
        ("impacts", "impact", last(&e.impact)),
        ("motion that is left", "kinetic", last(&e.kinetic)),
        ("deformation that is left", "strain", last(&e.strain)),
    ];
    let parts =
        parts
            .into_iter()
            .filter(|(.., value)| *value != 0.0)
            .map(|(name, history, value)| {
                let from = format!("energy/{history}[-1] / energy/input[-1]");
                format!("{name} {}", number(&from, 1.0e2, &percent(value, whole)))
            });
    let parts: Vec<String> = parts.collect();
    // Parts of what round-off leaves are none: its ledger does not close.
    let closes = result.residual_ratio < 1.0e-6;
    let some = !parts.is_empty() && whole != 0.0 && (closes || figures(1.0e-3 * whole) != "0");
    let Some(time) = result.time.last().filter(|_| some) else {
        return "<p>There is no energy on the output grid.</p>\n".to_owned();
    };
    format!(
        "<p>{} {} kJ relative to the ground by {} s, the last output time. Then it is in: {}.</p>\n",
        sources(result),
        number("energy/input[-1]", 1.0e-3, &all_figures(1.0e-3 * whole)),
        number("time[-1]", 1.0, &figures(*time)),
        parts.join(", ")
    )
}
