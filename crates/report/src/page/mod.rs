//! One HTML file of a result: words first, then tables and figures. It needs no other file
//! and no network, and prints.

mod figures;
mod html;
mod numbers;
mod tables;
mod words;

use crate::error::ReportError;
use crate::result::RunResult;
use html::{escaped, section};

/// How the page looks: dark on white, two figures beside one another where there is room.
const STYLE: &str = "
body{font:16px/1.5 system-ui,sans-serif;color:#1a1a1a;background:#fff;max-width:76rem;margin:2rem auto;padding:0 1rem}
h1{margin-bottom:0}h2{border-bottom:1px solid #bbb;margin-top:2.5rem}
.what{color:#555;margin-top:.2rem}
.summary li{margin:.3rem 0}
.warning{background:#fff3cd;border-left:4px solid #d39e00;padding:.5rem 1rem}
table{border-collapse:collapse;margin:1rem 0;font-size:.9rem;font-variant-numeric:tabular-nums}
th,td{padding:.2rem .7rem;text-align:right;border-bottom:1px solid #ddd}
th{background:#f3f3f3}th:first-child,td:first-child{text-align:left}
.wide{overflow-x:auto}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(26rem,1fr));gap:.5rem}
svg{max-width:100%;height:auto}
pre{background:#f6f6f6;padding:1rem;overflow-x:auto;font-size:.85rem}
.note{color:#555;font-size:.9rem}
@media print{body{max-width:none;margin:0}h2{break-after:avoid}svg,tr{break-inside:avoid}}
";

/// Impacts in the table of the hardest.
const HARDEST: usize = 20;

/// The page of a result; `name` is that of its file.
///
/// # Errors
/// [`ReportError::Figure`] if a figure cannot be drawn.
pub fn page(result: &RunResult, name: &str) -> Result<String, ReportError> {
    let mut body = format!(
        "<h1>{}</h1>\n<p class=\"what\">{} &middot; pounding {} &middot; {}</p>\n",
        escaped(&result.title),
        escaped(name),
        escaped(&result.version),
        escaped(&result.method),
    );
    body.push_str(&section("Summary", &words::summary(result)));
    body.push_str(&section("Ground motion", &ground(result)?));
    for (index, building) in result.buildings.iter().enumerate() {
        let mut inside = tables::modes(building);
        inside.push_str(&tables::storeys(building));
        inside.push_str(&tables::base_moment(building));
        inside.push_str(&tables::responses(building));
        inside.push_str(&tables::isolator(building));
        inside.push_str(&figures::profiles(result, building)?);
        inside.push_str(&figures::roof(result, index)?);
        let title = format!("Building {}", building.name);
        body.push_str(&section(&title, &inside));
    }
    for gap in &result.gaps {
        let mut inside = words::gap(gap);
        inside.push_str(&tables::levels(gap));
        inside.push_str(&tables::level_responses(gap));
        inside.push_str(&figures::gap(result, gap)?);
        inside.push_str(&tables::hardest(gap, HARDEST));
        body.push_str(&section(&format!("Gap {}", gap.name), &inside));
    }
    for link in &result.links {
        let title = format!("Link {}", link.name);
        body.push_str(&section(&title, &tables::link(link)));
    }
    let mut energy = words::energy(result);
    energy.push_str(&figures::energy(result)?);
    body.push_str(&section("Energy", &energy));
    body.push_str(&section("Run", &run(result)));
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n{body}</body>\n</html>\n",
        escaped(&result.title),
    ))
}

fn ground(result: &RunResult) -> Result<String, ReportError> {
    let lines = result.record.lines().map(escaped);
    let lines: Vec<String> = lines.collect();
    Ok(format!(
        "<p>{}</p>\n{}",
        lines.join("<br>\n"),
        figures::ground(result)?
    ))
}

/// What a reader needs to do it again.
fn run(result: &RunResult) -> String {
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
    let rows = rows
        .into_iter()
        .filter(|(_, value)| !value.is_empty())
        .map(|(name, value)| vec![name.to_owned(), value]);
    format!(
        "{}<details>\n<summary>The case file</summary>\n<pre>{}</pre>\n</details>\n",
        html::table(&[], rows),
        escaped(&result.case)
    )
}
