//! Pictures of the commands, and where they are written.

use std::path::Path;

use pounding_report::ReportError;
pub use pounding_report::{Curve, Panel, Reference};
use pounding_results::RunRecord;

use crate::failure::Failure;

/// Draws panels below one another as SVG.
pub fn figure(panels: &[Panel]) -> Result<String, Failure> {
    pounding_report::figure(panels).map_err(not_drawn)
}

/// Draws panels below one another, and curves to compare with, as SVG.
pub fn figure_with_references(
    panels: &[Panel],
    references: &[Reference],
) -> Result<String, Failure> {
    pounding_report::figure_with_references(panels, references).map_err(not_drawn)
}

/// A picture that could not be drawn.
pub fn not_drawn(e: ReportError) -> Failure {
    Failure::output(&std::io::Error::other(e.to_string()), "the picture")
}

/// Writes a text file, whole or not at all.
pub fn write(path: &Path, text: &str) -> Result<(), Failure> {
    pounding_files::write(path, text.as_bytes())
        .map_err(|e| Failure::output(&e, &path.display().to_string()))
}

/// Draws roof displacements above, contact forces of the highest levels below.
pub fn responses(path: &Path, record: &RunRecord<'_>) -> Result<(), Failure> {
    let system = record.system;
    let history = record.history;
    let curve = |name: &str, (values, column): (&[f64], usize), factor: f64| {
        let values = history.column(values, column);
        let times = history.time.iter().copied();
        Curve {
            name: name.to_owned(),
            points: times.zip(values.iter().map(|x| x * factor)).collect(),
        }
    };
    let roofs = system
        .buildings()
        .iter()
        .zip(system.offsets().windows(2))
        .map(|(b, range)| curve(b.name(), (&history.displacement, range[1] - 1), 1e3))
        .collect();
    let forces = system
        .gaps()
        .iter()
        .filter(|g| g.levels > 0)
        .map(|g| {
            let level = g.first_level + g.levels - 1;
            curve(&system.name_of_level(level), (&history.force, level), 1e-3)
        })
        .collect();
    let panel = |caption: &str, curves| Panel {
        caption: caption.to_owned(),
        horizontal: "time (s)".to_owned(),
        curves,
    };
    let panels = [
        panel("Roof displacement (mm)", roofs),
        panel(
            "Contact force at the highest level (kN), sampled on the output grid",
            forces,
        ),
    ];
    write(path, &figure(&panels)?)
}
