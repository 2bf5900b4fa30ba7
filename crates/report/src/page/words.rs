//! The answers in sentences.

use super::figures::loudest;
use super::html::escaped;
use super::numbers::{figures, percent};
use crate::result::{BuildingResult, GapResult, ImpactResult, RunResult, StoreyPeaks};

/// The summary: warnings, how hard they hit, what it did to the buildings, the ledger.
pub(super) fn summary(result: &RunResult) -> String {
    let mut out = String::new();
    for warning in &result.warnings {
        out.push_str(&format!("<p class=\"warning\">{}</p>\n", escaped(warning)));
    }
    let mut points: Vec<String> = result.gaps.iter().filter_map(hit).collect();
    if points.is_empty() {
        points.push("There is no gap with a contact level.".to_owned());
    }
    if result.gaps.iter().any(|g| !g.impacts.is_empty()) {
        points.extend(result.buildings.iter().map(changed));
    }
    points.push(ledger(result));
    let items: String = points.iter().map(|p| format!("<li>{p}</li>\n")).collect();
    out + &format!("<ul class=\"summary\">\n{items}</ul>\n")
}

/// How hard the floors on both sides of a gap hit.
fn hit(gap: &GapResult) -> Option<String> {
    let level = loudest(gap)?;
    let name = escaped(&gap.name);
    let at = |l: usize| format!("level {} ({} m)", l + 1, figures(gap.elevation[l]));
    if gap.impacts.is_empty() {
        let nearest = gap
            .penetration
            .column(level)
            .fold(f64::NEG_INFINITY, f64::max);
        return Some(format!(
            "<strong>Gap {name} stays open.</strong> On the output grid it is narrowest at {}: \
             {} mm of {} mm are left.",
            at(level),
            figures(-1.0e3 * nearest),
            figures(1.0e3 * gap.width[level]),
        ));
    }
    let hardest = hardest(gap)?;
    let force = match hardest.peak_force.is_finite() {
        true => format!("with {} kN", figures(1.0e-3 * hardest.peak_force)),
        // Velocity jumps have no force.
        false => format!(
            "with an impulse of {} kN s",
            figures(1.0e-3 * hardest.impulse)
        ),
    };
    let levels = (0..gap.elevation.len())
        .filter(|l| gap.impacts.iter().any(|i| i.level == *l as u64 + 1))
        .count();
    Some(format!(
        "<strong>Gap {name} closes {} times</strong> at {levels} of {} levels. The hardest impact \
         hits {force} at {}, {} s into the motion, approaching with {} m/s ({}).",
        gap.impacts.len(),
        gap.elevation.len(),
        at(level),
        figures(hardest.t_close),
        figures(hardest.approach_velocity),
        escaped(&gap.model),
    ))
}

fn hardest(gap: &GapResult) -> Option<&ImpactResult> {
    let level = loudest(gap)? as u64 + 1;
    let here = gap.impacts.iter().filter(|i| i.level == level);
    here.max_by(|a, b| {
        let size = |x: f64| if x.is_finite() { x } else { 0.0 };
        let by_force = size(a.peak_force).total_cmp(&size(b.peak_force));
        by_force.then(a.impulse.total_cmp(&b.impulse))
    })
}

/// What pounding changed in a building: the greatest rise of each quantity.
fn changed(building: &BuildingResult) -> String {
    let rise = |what: &str, peaks: &StoreyPeaks, (factor, unit): (f64, &str)| {
        let ratios = peaks.value.iter().zip(&peaks.isolated).map(|(a, b)| a / b);
        let most = ratios
            .enumerate()
            .filter(|(_, r)| r.is_finite())
            .max_by(|a, b| a.1.total_cmp(&b.1));
        let (storey, ratio) = most?;
        Some(format!(
            "{what} at most {ratio:.2} times (storey {}: {} {unit}, alone {} {unit})",
            storey + 1,
            figures(factor * peaks.value[storey]),
            figures(factor * peaks.isolated[storey]),
        ))
    };
    let parts = [
        rise("displacement", &building.displacement_peaks, (1.0e3, "mm")),
        rise("storey shear", &building.shear_peaks, (1.0e-3, "kN")),
        rise(
            "acceleration",
            &building.acceleration_peaks,
            (1.0, "m/s\u{b2}"),
        ),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    format!(
        "Peaks of building {} beside those of the building alone: {}.",
        escaped(&building.name),
        parts.join(", ")
    )
}

fn ledger(result: &RunResult) -> String {
    format!(
        "The energy ledger closes to {:.1e} of the largest input energy.",
        result.residual_ratio
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
    format!(
        "<p>{} &middot; {}</p>\n",
        escaped(&gap.between),
        escaped(&model)
    )
}

/// Where the energy went.
pub(super) fn energy(result: &RunResult) -> String {
    let e = &result.energy;
    let last = |values: &[f64]| values.last().copied().unwrap_or(f64::NAN);
    let whole = last(&e.input);
    let parts = [
        ("viscous damping", last(&e.viscous)),
        ("yielding and links", last(&e.hysteretic)),
        ("impacts", last(&e.impact)),
        (
            "motion and deformation that are left",
            last(&e.kinetic) + last(&e.strain),
        ),
    ];
    let parts = parts
        .into_iter()
        .filter(|(_, value)| *value != 0.0)
        .map(|(name, value)| format!("{name} {}", percent(value, whole)));
    let parts: Vec<String> = parts.collect();
    format!(
        "<p>The ground motion puts in {} kJ relative to the ground. At the end it is in: {}.</p>\n",
        figures(1.0e-3 * whole),
        parts.join(", ")
    )
}
