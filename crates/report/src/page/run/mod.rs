//! The page of a run.

mod animation;
mod figures;
mod packed;
mod row;
mod series;
mod tables;
mod words;

use super::document::{Document, listing};
use super::html::{named, section, section_of};
use super::table::facts;
use crate::error::ReportError;
use crate::result::RunResult;

/// Impacts in the table of the hardest.
const HARDEST: usize = 20;

/// The page of the result of a run; `name` is that of its file.
///
/// # Errors
/// [`ReportError::Figure`] if a figure cannot be drawn.
pub fn page(result: &RunResult, name: &str) -> Result<String, ReportError> {
    let mut body = section("Summary", &words::summary(result));
    let animation = animation::animation(result);
    let (motion, script) = animation.unzip();
    body.push_str(&motion.unwrap_or_default());
    body.push_str(&section("Ground motion", &ground(result)?));
    for (index, building) in result.buildings.iter().enumerate() {
        let mut inside = tables::modes(building);
        inside.push_str(&tables::storeys(building));
        inside.push_str(&tables::frames(building));
        inside.push_str(&tables::base_moment(building));
        inside.push_str(&tables::responses(building));
        inside.push_str(&tables::isolator(building));
        inside.push_str(&figures::profiles(result, building)?);
        inside.push_str(&figures::roof(result, index)?);
        body.push_str(&section_of(["Building ", &building.name, ""], &inside));
    }
    let input = result.energy.input.iter().copied().fold(0.0, f64::max);
    for gap in &result.gaps {
        let mut inside = words::gap(gap);
        inside.push_str(&tables::levels(gap, input));
        inside.push_str(&tables::level_responses(gap));
        inside.push_str(&figures::gap(result, gap)?);
        inside.push_str(&tables::hardest(gap, HARDEST, input));
        body.push_str(&section_of(["Gap ", &gap.name, ""], &inside));
    }
    for link in &result.links {
        let mut inside = tables::link(link, &result.time, input);
        inside.push_str(&figures::link(result, link)?);
        body.push_str(&section_of(["Link ", &link.name, ""], &inside));
    }
    let mut energy = words::energy(result);
    energy.push_str(&figures::energy(result)?);
    body.push_str(&section("Energy", &energy));
    body.push_str(&section("How it was computed", &computed(result)));
    let origin = [
        name.to_owned(),
        format!("pounding {}", result.version),
        result.method.clone(),
    ];
    let document = Document {
        title: &result.title,
        origin: &origin,
        body: &body,
        script,
        style: "",
    };
    Ok(document.html())
}

fn ground(result: &RunResult) -> Result<String, ReportError> {
    let lines = result.record.lines().map(named);
    let lines: Vec<String> = lines.collect();
    Ok(format!(
        "<p>{}</p>\n{}",
        lines.join("<br>\n"),
        figures::ground(result)?
    ))
}

/// What a reader needs to do it again.
fn computed(result: &RunResult) -> String {
    let rows = [
        ("method", result.method.clone()),
        ("steps", result.steps.to_string()),
        ("time of the run", format!("{:.3} s", result.wall_time)),
        (
            "largest energy residual",
            format!("{:.1e} of the largest input", result.residual_ratio),
        ),
        ("SHA-256 of the case", result.case_sha256.clone()),
        ("SHA-256 of the record", result.record_sha256.clone()),
    ];
    facts("How it was computed", &rows) + &listing("The case file", &result.case)
}
