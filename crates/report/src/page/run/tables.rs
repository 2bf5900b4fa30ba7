//! Tables of the page; their columns name datasets of the result file, `[*]` a row of one.

use pounding_catalogue::numbers::{shown_unit, six_digits};

use crate::page::html::{escaped, note};
use crate::page::numbers::{all_figures, figures, ratio, without_round_off};
use crate::page::table::{Column, Row, table};
use crate::result::{
    BuildingResult, GapResult, ImpactResult, LevelResponses, LinkResult, StoreyPeaks,
};

/// Modes listed at most.
const MODES: usize = 12;

/// The first periods of a building.
pub(super) fn modes(building: &BuildingResult) -> String {
    let modes = building.period.iter().zip(&building.damping_ratio);
    let rows = modes.take(MODES).enumerate().map(|(i, (period, damping))| {
        let cells = [
            (i + 1).to_string(),
            figures(*period),
            figures(100.0 * damping),
        ];
        Row::new(i, cells.to_vec())
    });
    let of = group(building);
    let columns = [
        Column::new("mode"),
        Column::of("period (s)", format!("{of}/period[*]"), 1.0),
        Column::of("damping (%)", format!("{of}/damping_ratio[*]"), 1.0e2),
    ];
    let table = table("Modes", &columns, rows);
    match building.period.len() {
        all if all > MODES => table + &note(&format!("The first {MODES} of {all} modes.")),
        _ => table,
    }
}

/// Path of a building in the result file.
fn group(building: &BuildingResult) -> String {
    format!("building/{}", building.name)
}

/// Columns of a peak, of the same in the isolated building, and of their ratio.
fn beside_isolated(
    heading: &str,
    peaks: &str,
    (name, row, factor): (&str, &str, f64),
) -> [Column; 3] {
    let [with, without] = ["", "isolated_"].map(|of| format!("{peaks}/{of}{name}{row}"));
    let ratio = format!("{with} / {without}");
    [
        Column::of("here", with, factor),
        Column::of("isolated", without, factor),
        Column::of("ratio", ratio, 1.0),
    ]
    .map(|column| column.below(heading))
}

/// Peaks of all storeys, the top first.
pub(super) fn storeys(building: &BuildingResult) -> String {
    let peaks = format!("{}/peak", group(building));
    let quantities: [(&str, &str, &StoreyPeaks, f64); 4] = [
        (
            "displacement (mm)",
            "displacement",
            &building.displacement_peaks,
            1.0e3,
        ),
        ("drift (%)", "drift_ratio", &building.drift_peaks, 1.0e2),
        ("shear (kN)", "storey_shear", &building.shear_peaks, 1.0e-3),
        (
            "acceleration (m/s\u{b2})",
            "acceleration_absolute",
            &building.acceleration_peaks,
            1.0,
        ),
    ];
    let mut columns = vec![
        Column::new("storey"),
        Column::of(
            "elevation (m)",
            format!("{}/storey[*]", group(building)),
            1.0,
        ),
    ];
    for (heading, name, _, factor) in quantities {
        columns.extend(beside_isolated(heading, &peaks, (name, "[*]", factor)));
    }
    if building.ductility.is_some() {
        columns.push(Column::of(
            "ductility",
            format!("{peaks}/ductility[*]"),
            1.0,
        ));
    }
    let rows = (0..building.elevation.len()).rev().map(|i| {
        let mut row = vec![(i + 1).to_string(), figures(building.elevation[i])];
        for (_, _, peaks, factor) in quantities {
            let at = |values: &[f64]| values.get(i).copied().unwrap_or(f64::NAN);
            let (with, without) = (at(&peaks.value), at(&peaks.isolated));
            row.push(all_figures(factor * with));
            row.push(all_figures(factor * without));
            row.push(ratio(with, without));
        }
        if let Some(ductility) = &building.ductility {
            row.push(figures(ductility.get(i).copied().unwrap_or(f64::NAN)));
        }
        Row::new(i, row)
    });
    table("Peaks of the storeys", &columns, rows)
        + &note(
            "Maximum absolute values, found inside the steps. Isolated: the same building under the same \
             motion without any gap or link.",
        )
}

/// What the frames of a building with laws went through, the top first; nothing without any.
pub(super) fn frames(building: &BuildingResult) -> String {
    if building.frames.is_empty() {
        return String::new();
    }
    let peaks = format!("{}/frames/peak", group(building));
    let columns = [
        Column::new("storey"),
        Column::new("frame"),
        Column::new("law"),
        Column::of("peak", format!("{peaks}/force[*]"), 1.0e-3).below("force (kN)"),
        Column::of("at (s)", format!("{peaks}/force_time[*]"), 1.0).below("force (kN)"),
        Column::of("deformation (mm)", format!("{peaks}/deformation[*]"), 1.0e3),
        Column::of("ductility", format!("{peaks}/ductility[*]"), 1.0),
        Column::of(
            "residual deformation (mm)",
            format!("{peaks}/residual_deformation[*]"),
            1.0e3,
        ),
    ];
    let rows = building.frames.iter().enumerate().rev().map(|(i, frame)| {
        let cells = vec![
            frame.storey.to_string(),
            format!("{} at {} m", frame.direction, six_digits(frame.at)),
            frame.law.clone(),
            all_figures(1.0e-3 * frame.force),
            figures(frame.force_time),
            all_figures(1.0e3 * frame.deformation),
            figures(frame.ductility),
            all_figures(1.0e3 * frame.residual_deformation),
        ];
        Row::new(i, cells)
    });
    table("Frames that yield", &columns, rows)
        + &note(
            "Frames with a law, along the row of buildings or across it, by their distance from the mass centre: \
             maximum absolute values, and the deformation at the end less what elastic unloading gives back.",
        )
}

/// The peak of the overturning moment at the base; nothing for a chain of storeys.
pub(super) fn base_moment(building: &BuildingResult) -> String {
    let Some(moment) = &building.base_moment else {
        return String::new();
    };
    let peaks = format!("{}/peak", group(building));
    let [here, isolated, quotient] = beside_isolated(
        "overturning moment (kN m)",
        &peaks,
        ("base_moment", "", 1.0e-3),
    );
    let at = Column::of("at (s)", format!("{peaks}/base_moment_time"), 1.0);
    let columns = [
        Column::new("at"),
        here,
        at.below("overturning moment (kN m)"),
        isolated,
        quotient,
    ];
    let row = vec![
        "base".to_owned(),
        all_figures(1.0e-3 * moment.value),
        figures(moment.time),
        all_figures(1.0e-3 * moment.isolated),
        ratio(moment.value, moment.isolated),
    ];
    table(
        "Overturning moment at the base",
        &columns,
        [Row::new("", row)],
    )
}

/// Peaks of the responses with names of a building; nothing if it has none.
pub(super) fn responses(building: &BuildingResult) -> String {
    if building.responses.is_empty() {
        return String::new();
    }
    // Each has a unit of its own, and so a factor.
    let rows = building.responses.iter().map(|r| {
        let (factor, unit) = shown_unit(&r.unit);
        let cells = vec![
            format!("{} ({unit})", r.name.replace('_', " ")),
            all_figures(factor * r.value),
            figures(r.time),
            all_figures(factor * r.isolated),
            ratio(r.value, r.isolated),
        ];
        Row::new(&r.name, cells)
    });
    let peaks = format!("{}/peak/response", group(building));
    let columns = [
        Column::new("response"),
        Column::in_unit_of_row("peak", format!("{peaks}/*")),
        Column::of("at (s)", format!("{peaks}/*_time"), 1.0),
        Column::in_unit_of_row("isolated", format!("{peaks}/isolated_*")),
        Column::of("ratio", format!("{peaks}/* / {peaks}/isolated_*"), 1.0),
    ];
    table("Responses", &columns, rows)
}

/// What the levels of a gap bear beside contact forces, the top first; nothing if that is
/// nothing.
pub(super) fn level_responses(gap: &GapResult) -> String {
    let mut out = String::new();
    for r in &gap.responses {
        let (factor, unit) = shown_unit(&r.unit);
        let path = format!("gap/{}/response/peak/{}", gap.name, r.name);
        let name = match r.name.as_str() {
            // A seat bears this, not the distance across the gap, of which figures are.
            "opening" => "opening beyond the distance at rest".to_owned(),
            name => name.replace('_', " "),
        };
        let what = format!("{name} ({unit})");
        let mut columns = vec![
            Column::new("level"),
            Column::of("peak", format!("{path}[*]"), factor).below(&what),
            Column::of("at (s)", format!("{path}_time[*]"), 1.0).below(&what),
        ];
        if !r.capacity.is_empty() {
            let capacity = format!("{path}_capacity[*]");
            let ratio = format!("{path}[*] / {capacity}");
            columns.push(Column::of("capacity", capacity, factor).below(&what));
            columns.push(Column::of("peak / capacity", ratio, 1.0).below(&what));
        }
        let levels = (0..gap.levels.len()).rev();
        let rows = levels.filter(|l| r.value[*l].is_finite()).map(|l| {
            let mut cells = vec![
                gap.levels[l].label.clone(),
                figures(factor * r.value[l]),
                figures(r.time[l]),
            ];
            if !r.capacity.is_empty() {
                cells.extend(capacity(r, l, factor));
            }
            Row::new(l, cells)
        });
        out.push_str(&table(&what, &columns, rows));
    }
    out
}

/// Capacity of a response at a level, and in words whether the peak exceeds it.
fn capacity(response: &LevelResponses, level: usize, factor: f64) -> [String; 2] {
    match response.capacity.get(level) {
        Some(capacity) if capacity.is_finite() => {
            let ratio = response.value[level] / capacity;
            let words = if ratio > 1.0 {
                "exceeds"
            } else {
                "stays below"
            };
            [
                figures(factor * capacity),
                format!("{} ({words} it)", figures(ratio)),
            ]
        }
        _ => ["-", "-"].map(str::to_owned),
    }
}

/// What the isolators went through; nothing for a building without.
pub(super) fn isolator(building: &BuildingResult) -> String {
    let Some(isolator) = &building.isolator else {
        return String::new();
    };
    let path = format!("{}/isolator", group(building));
    let mut columns = vec![Column::new("isolators (storey 1)")];
    columns.extend(beside_isolated(
        "displacement (mm)",
        &path,
        ("displacement", "", 1.0e3),
    ));
    columns.extend(beside_isolated("force (kN)", &path, ("force", "", 1.0e-3)));
    columns.push(Column::of(
        "effective period (s)",
        format!("{path}/effective_period"),
        1.0,
    ));
    columns.push(Column::of(
        "effective damping (%)",
        format!("{path}/effective_damping_ratio"),
        1.0e2,
    ));
    let row = vec![
        isolator.model.clone(),
        figures(1.0e3 * isolator.displacement),
        figures(1.0e3 * isolator.isolated_displacement),
        ratio(isolator.displacement, isolator.isolated_displacement),
        figures(1.0e-3 * isolator.force),
        figures(1.0e-3 * isolator.isolated_force),
        ratio(isolator.force, isolator.isolated_force),
        figures(isolator.effective_period),
        figures(100.0 * isolator.effective_damping_ratio),
    ];
    table("Isolators", &columns, [Row::new("", row)])
}

/// Elevations of both sides of the levels of a gap or a link.
fn elevations(path: &str) -> [Column; 2] {
    ["left", "right"].map(|side| {
        Column::of(side, format!("{path}/{side}_elevation[*]"), 1.0).below("elevation (m)")
    })
}

/// The levels of a gap, the top first.
pub(super) fn levels(gap: &GapResult, input: f64) -> String {
    let path = format!("gap/{}", gap.name);
    let of_impacts = |heading: &str, word: &str, column: &str, factor: f64| {
        let from = format!("{word} {path}/impacts[level=*+1].{column}");
        Column::of(heading, from, factor)
    };
    let mut columns = vec![Column::new("level")];
    columns.extend(elevations(&path));
    columns.extend([
        Column::of("width (mm)", format!("{path}/width[*]"), 1.0e3),
        of_impacts("impacts", "count", "level", 1.0),
        of_impacts("peak force (kN)", "maximum", "peak_force", 1.0e-3),
        Column::new("at (s)"),
        of_impacts(
            "fastest approach (m/s)",
            "maximum",
            "approach_velocity",
            1.0,
        ),
        Column::new("restitution"),
        of_impacts("dissipated (kJ)", "sum", "energy_dissipated", 1.0e-3),
    ]);
    if gap.clearance.is_some() {
        columns.push(Column::of(
            "clearance left (mm)",
            format!("{path}/clearance[*]"),
            1.0e3,
        ));
    }
    let rows = (0..gap.levels.len()).rev().map(|l| {
        let here: Vec<&ImpactResult> = gap
            .impacts
            .iter()
            .filter(|i| i.level == l as u64 + 1)
            .collect();
        let hardest = here
            .iter()
            .filter(|i| i.force().is_finite())
            .max_by(|a, b| a.force().total_cmp(&b.force()));
        let fastest = here
            .iter()
            .map(|i| i.approach_velocity)
            .fold(f64::NAN, f64::max);
        // Of all finished impacts together, as a run prints it: ratios of slow ones are
        // of no weight.
        let squares = |speed: fn(&ImpactResult) -> f64| -> f64 {
            let finished = here.iter().filter(|i| i.separation_velocity.is_finite());
            finished.map(|i| speed(i) * speed(i)).sum()
        };
        // None where the floors met at rest in all of them.
        let restitution = match here.iter().any(|i| i.achieved_restitution.is_finite()) {
            true => (squares(|i| i.separation_velocity) / squares(|i| i.approach_velocity)).sqrt(),
            false => f64::NAN,
        };
        let dissipated: f64 = here
            .iter()
            .map(|i| i.energy_dissipated)
            .filter(|e| e.is_finite())
            .sum();
        let dissipated = without_round_off(dissipated, input);
        let mut row = vec![
            gap.levels[l].label.clone(),
            figures(gap.levels[l].elevations[0]),
            figures(gap.levels[l].elevations[1]),
            figures(1.0e3 * gap.width[l]),
            here.len().to_string(),
            figures(1.0e-3 * hardest.map_or(f64::NAN, |i| i.force())),
            figures(hardest.map_or(f64::NAN, |i| i.peak_force_time)),
            figures(fastest),
            figures(restitution),
            all_figures(1.0e-3 * dissipated),
        ];
        if let Some(clearance) = &gap.clearance {
            row.push(figures(1.0e3 * clearance[l]));
        }
        Row::new(l, row)
    });
    let restitution = "Restitution: of all finished impacts of a level together, the square root of the sum of squares of separation \
         velocities over that of approach velocities.";
    let told = match gap.impacts.is_empty() {
        true => String::new(),
        false => note(restitution),
    };
    table("Levels of the gap", &columns, rows) + &told
}

/// The hardest impacts of a gap, by force, or by impulse where a model has no force.
pub(super) fn hardest(gap: &GapResult, count: usize, input: f64) -> String {
    if gap.impacts.is_empty() {
        return String::new();
    }
    let impacts = gap.hardest_first();
    let path = format!("gap/{}", gap.name);
    let of = |heading: &str, column: &str, factor: f64| {
        Column::of(heading, format!("{path}/impacts[*].{column}"), factor)
    };
    let columns = [
        Column::new("level"),
        Column::new("left").below("elevation (m)"),
        Column::new("right").below("elevation (m)"),
        of("closes", "t_close", 1.0).below("time (s)"),
        of("opens", "t_open", 1.0).below("time (s)"),
        of("approach", "approach_velocity", 1.0).below("velocity (m/s)"),
        of("separation", "separation_velocity", 1.0).below("velocity (m/s)"),
        of("restitution", "achieved_restitution", 1.0),
        of("force (kN)", "peak_force", 1.0e-3),
        of("penetration (mm)", "peak_penetration", 1.0e3),
        of("impulse (kN s)", "impulse", 1.0e-3),
        of("dissipated (kJ)", "energy_dissipated", 1.0e-3),
    ];
    let rows = impacts.iter().take(count).map(|i| {
        let level = &gap.levels[i.level as usize - 1];
        let number = gap.impacts.iter().position(|other| std::ptr::eq(other, *i));
        let cells = vec![
            level.label.clone(),
            figures(level.elevations[0]),
            figures(level.elevations[1]),
            format!("{:.4}", i.t_close),
            match i.t_open.is_finite() {
                true => format!("{:.4}", i.t_open),
                false => figures(f64::NAN),
            },
            figures(i.approach_velocity),
            figures(i.separation_velocity),
            figures(i.achieved_restitution),
            figures(1.0e-3 * i.force()),
            figures(1.0e3 * i.peak_penetration),
            figures(1.0e-3 * i.impulse),
            all_figures(1.0e-3 * without_round_off(i.energy_dissipated, input)),
        ];
        Row::new(number.unwrap_or_default(), cells)
    });
    let shown = impacts.len().min(count);
    let heading = match impacts.len() {
        1 => "The only impact".to_owned(),
        all => format!("The hardest {shown} of {all} impacts"),
    };
    format!("<h3>{heading}</h3>\n{}", table(&heading, &columns, rows))
}

/// Whether the greatest force of a level pulls or pushes; nothing of moments, of no force, and where output times do not
/// tell.
pub(super) fn direction(link: &LinkResult, times: &[f64], level: usize) -> Option<&'static str> {
    let tension = link.in_tension(times, level).filter(|_| !link.turns())?;
    Some(["compression", "tension"][usize::from(tension)])
}

/// The levels of a link, the top first.
pub(super) fn link(link: &LinkResult, times: &[f64], input: f64) -> String {
    let [(length, length_unit), (force, force_unit)] =
        [&link.units[0], &link.units[1]].map(|unit| shown_unit(unit));
    let of = ["force", "moment"][usize::from(link.turns())];
    let path = format!("link/{}", link.name);
    let mut columns = vec![Column::new("level")];
    columns.extend(elevations(&path));
    columns.extend([
        Column::of(
            format!("peak deformation ({length_unit})"),
            format!("{path}/peak/deformation[*]"),
            length,
        ),
        Column::of("at (s)", format!("{path}/peak/deformation_time[*]"), 1.0),
        Column::of(
            format!("peak {of} ({force_unit})"),
            format!("{path}/peak/force[*]"),
            force,
        ),
        Column::of("at (s)", format!("{path}/peak/force_time[*]"), 1.0),
        Column::new("in"),
        Column::of(
            "dissipated (kJ)",
            format!("{path}/energy_dissipated[-1,*]"),
            1.0e-3,
        ),
    ]);
    let rows = (0..link.levels.len()).rev().map(|l| {
        let at = |values: &[f64]| values.get(l).copied().unwrap_or(f64::NAN);
        let cells = vec![
            link.levels[l].label.clone(),
            figures(link.levels[l].elevations[0]),
            figures(link.levels[l].elevations[1]),
            figures(length * at(&link.deformation)),
            figures(at(&link.deformation_time)),
            figures(force * at(&link.force)),
            figures(at(&link.force_time)),
            direction(link, times, l).unwrap_or("-").to_owned(),
            figures(1.0e-3 * without_round_off(at(&link.energy_dissipated), input)),
        ];
        Row::new(l, cells)
    });
    format!("<p>Law: {}</p>\n", escaped(&link.law)) + &table("Levels of the link", &columns, rows)
}
