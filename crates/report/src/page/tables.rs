//! Tables of the page.

use pounding_catalogue::numbers::shown_unit;

use super::html::{escaped, table};
use super::numbers::{figures, ratio};
use crate::result::{
    BuildingResult, GapResult, ImpactResult, LevelResponses, LinkResult, StoreyPeaks,
};

/// Modes listed.
const MODES: usize = 5;

/// The first periods of a building.
pub(super) fn modes(building: &BuildingResult) -> String {
    let modes = building.period.iter().zip(&building.damping_ratio);
    let rows = modes.take(MODES).enumerate().map(|(i, (period, damping))| {
        vec![
            (i + 1).to_string(),
            figures(*period),
            figures(100.0 * damping),
        ]
    });
    table(&["mode", "period (s)", "damping (%)"], rows)
}

/// Peaks of all storeys, the top first.
pub(super) fn storeys(building: &BuildingResult) -> String {
    let headings = [
        "storey",
        "elevation (m)",
        "displacement (mm)",
        "without",
        "ratio",
        "drift (%)",
        "without",
        "ratio",
        "shear (kN)",
        "without",
        "ratio",
        "acceleration (m/s\u{b2})",
        "without",
        "ratio",
        "ductility",
    ];
    let laws = building.ductility.is_some();
    let headings = &headings[..headings.len() - usize::from(!laws)];
    let quantities: [(&StoreyPeaks, f64); 4] = [
        (&building.displacement_peaks, 1.0e3),
        (&building.drift_peaks, 1.0e2),
        (&building.shear_peaks, 1.0e-3),
        (&building.acceleration_peaks, 1.0),
    ];
    let rows = (0..building.elevation.len()).rev().map(|i| {
        let mut row = vec![(i + 1).to_string(), figures(building.elevation[i])];
        for (peaks, factor) in quantities {
            let at = |values: &[f64]| values.get(i).copied().unwrap_or(f64::NAN);
            let (with, without) = (at(&peaks.value), at(&peaks.isolated));
            row.push(figures(factor * with));
            row.push(figures(factor * without));
            row.push(ratio(with, without));
        }
        if let Some(ductility) = &building.ductility {
            row.push(figures(ductility.get(i).copied().unwrap_or(f64::NAN)));
        }
        row
    });
    let note = "<p class=\"note\">Maximum absolute values, found inside the steps; \
                <em>without</em>: the same building under the same motion without any gap \
                or link.</p>\n";
    table(headings, rows) + note
}

/// The peak of the overturning moment at the base; nothing for a chain of storeys.
pub(super) fn base_moment(building: &BuildingResult) -> String {
    let Some(moment) = &building.base_moment else {
        return String::new();
    };
    let headings = [
        "overturning moment at the base (kN m)",
        "at (s)",
        "without",
        "ratio",
    ];
    let row = vec![
        figures(1.0e-3 * moment.value),
        figures(moment.time),
        figures(1.0e-3 * moment.isolated),
        ratio(moment.value, moment.isolated),
    ];
    table(&headings, std::iter::once(row))
}

/// Peaks of the responses with names of a building; nothing if it has none.
pub(super) fn responses(building: &BuildingResult) -> String {
    if building.responses.is_empty() {
        return String::new();
    }
    let headings = ["response", "peak", "at (s)", "without", "ratio"];
    let rows = building.responses.iter().map(|r| {
        let (factor, unit) = shown_unit(&r.unit);
        vec![
            format!("{} ({unit})", r.name.replace('_', " ")),
            figures(factor * r.value),
            figures(r.time),
            figures(factor * r.isolated),
            ratio(r.value, r.isolated),
        ]
    });
    table(&headings, rows)
}

/// What the levels of a gap bear beside contact forces, the top first; nothing if that is
/// nothing.
pub(super) fn level_responses(gap: &GapResult) -> String {
    if gap.responses.is_empty() {
        return String::new();
    }
    let headings = [
        "level",
        "response",
        "peak",
        "at (s)",
        "capacity",
        "peak / capacity",
    ];
    let known = gap.responses.iter().any(|r| !r.capacity.is_empty());
    let shown = if known { headings.len() } else { 4 };
    let rows = (0..gap.levels.len()).rev().flat_map(|l| {
        let known = gap.responses.iter().filter(move |r| r.value[l].is_finite());
        known.map(move |r| {
            let (factor, unit) = shown_unit(&r.unit);
            let mut row = vec![
                gap.levels[l].label.clone(),
                format!("{} ({unit})", r.name.replace('_', " ")),
                figures(factor * r.value[l]),
                figures(r.time[l]),
            ];
            row.extend(capacity(r, l, factor));
            row.truncate(shown);
            row
        })
    });
    table(&headings[..shown], rows)
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
    let headings = [
        "isolators (storey 1)",
        "displacement (mm)",
        "without",
        "ratio",
        "force (kN)",
        "without",
        "ratio",
        "effective period (s)",
        "effective damping (%)",
    ];
    let row = vec![
        escaped(&isolator.model),
        figures(1.0e3 * isolator.displacement),
        figures(1.0e3 * isolator.isolated_displacement),
        ratio(isolator.displacement, isolator.isolated_displacement),
        figures(1.0e-3 * isolator.force),
        figures(1.0e-3 * isolator.isolated_force),
        ratio(isolator.force, isolator.isolated_force),
        figures(isolator.effective_period),
        figures(100.0 * isolator.effective_damping_ratio),
    ];
    table(&headings, std::iter::once(row))
}

/// The levels of a gap, the top first.
pub(super) fn levels(gap: &GapResult) -> String {
    let headings = [
        "level",
        "left elevation (m)",
        "right elevation (m)",
        "width (mm)",
        "impacts",
        "peak force (kN)",
        "at (s)",
        "fastest approach (m/s)",
        "restitution",
        "dissipated (kJ)",
        "clearance left (mm)",
    ];
    let headings = &headings[..headings.len() - usize::from(gap.clearance.is_none())];
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
        let restitution =
            (squares(|i| i.separation_velocity) / squares(|i| i.approach_velocity)).sqrt();
        let dissipated: f64 = here
            .iter()
            .map(|i| i.energy_dissipated)
            .filter(|e| e.is_finite())
            .sum();
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
            figures(1.0e-3 * dissipated),
        ];
        if let Some(clearance) = &gap.clearance {
            row.push(figures(1.0e3 * clearance[l]));
        }
        row
    });
    table(headings, rows)
}

/// The hardest impacts of a gap, by force, or by impulse where a model has no force.
pub(super) fn hardest(gap: &GapResult, count: usize) -> String {
    if gap.impacts.is_empty() {
        return String::new();
    }
    let impacts = gap.hardest_first();
    let headings = [
        "level",
        "left elevation (m)",
        "right elevation (m)",
        "closes (s)",
        "opens (s)",
        "approach (m/s)",
        "separation (m/s)",
        "restitution",
        "force (kN)",
        "penetration (mm)",
        "impulse (kN s)",
        "dissipated (kJ)",
    ];
    let rows = impacts.iter().take(count).map(|i| {
        let level = &gap.levels[i.level as usize - 1];
        vec![
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
            figures(1.0e-3 * i.energy_dissipated),
        ]
    });
    let shown = impacts.len().min(count);
    let heading = match impacts.len() {
        1 => "The only impact".to_owned(),
        all => format!("The hardest {shown} of {all} impacts"),
    };
    format!("<h3>{heading}</h3>\n{}", table(&headings, rows))
}

/// The levels of a link, the top first.
pub(super) fn link(link: &LinkResult) -> String {
    let [(length, length_unit), (force, force_unit)] =
        [&link.units[0], &link.units[1]].map(|unit| shown_unit(unit));
    let turns = link.units[0] == "rad";
    let of = ["force", "moment"][usize::from(turns)];
    let (deformation_heading, force_heading) = (
        format!("peak deformation ({length_unit})"),
        format!("peak {of} ({force_unit})"),
    );
    let headings = [
        "level",
        "left elevation (m)",
        "right elevation (m)",
        &deformation_heading,
        &force_heading,
        "dissipated (kJ)",
    ];
    let rows = (0..link.levels.len()).rev().map(|l| {
        let at = |values: &[f64]| values.get(l).copied().unwrap_or(f64::NAN);
        vec![
            link.levels[l].label.clone(),
            figures(link.levels[l].elevations[0]),
            figures(link.levels[l].elevations[1]),
            figures(length * at(&link.deformation)),
            figures(force * at(&link.force)),
            figures(1.0e-3 * at(&link.energy_dissipated)),
        ]
    });
    format!("<p>Law: {}</p>\n", escaped(&link.law)) + &table(&headings, rows)
}
