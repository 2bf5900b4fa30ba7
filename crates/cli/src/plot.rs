//! Pictures: panels of curves below one another, as SVG.

use std::path::Path;

use plotters::prelude::*;
use pounding_time_history::{RunRecord, Sample};

use crate::failure::Failure;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// One curve: its name and its points.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Name in the legend.
    pub name: String,
    /// Points in the units of the panel's axes.
    pub points: Vec<(f64, f64)>,
}

/// One set of axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Heading: the quantity and unit of the vertical axis.
    pub caption: String,
    /// Quantity and unit of the horizontal axis.
    pub horizontal: String,
    /// Curves; a legend appears if there are several.
    pub curves: Vec<Curve>,
}

/// Width of a picture (pixels).
const WIDTH: u32 = 960;
/// Height of a panel (pixels).
const HEIGHT: u32 = 320;
/// Colours of the curves in turn, all dark enough on white (Tableau's ten without
/// the palest).
const COLOURS: [RGBColor; 7] = [
    RGBColor(31, 119, 180),
    RGBColor(214, 39, 40),
    RGBColor(44, 160, 44),
    RGBColor(255, 127, 14),
    RGBColor(148, 103, 189),
    RGBColor(140, 86, 75),
    RGBColor(23, 190, 207),
];

/// Draws panels below one another as SVG.
pub fn figure(panels: &[Panel]) -> Result<String, Failure> {
    let mut svg = String::new();
    let drawn = draw(&mut svg, panels).map_err(|e| e.to_string());
    drawn
        .map_err(std::io::Error::other)
        .map_err(|e| Failure::output(&e, "the picture"))?;
    Ok(svg)
}

/// Writes a text file beside its place and renames it: a reader never sees half.
pub fn write(path: &Path, text: &str) -> Result<(), Failure> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    let part = path.with_file_name(name);
    std::fs::write(&part, text)
        .and_then(|()| std::fs::rename(&part, path))
        .map_err(|e| Failure::output(&e, &path.display().to_string()))
}

/// Draws roof displacements above, contact forces of the highest levels below.
pub fn responses(path: &Path, record: &RunRecord<'_>) -> Result<(), Failure> {
    let system = &record.assembly.system;
    let curve = |name: &str, pick: &dyn Fn(&Sample) -> f64| Curve {
        name: name.to_owned(),
        points: record.samples.iter().map(|s| (s.time, pick(s))).collect(),
    };
    let roofs = system
        .buildings()
        .iter()
        .zip(system.offsets().windows(2))
        .map(|(b, range)| curve(b.name(), &|s| s.displacement[range[1] - 1] * 1e3))
        .collect();
    let forces = system
        .gaps()
        .iter()
        .filter(|g| g.levels > 0)
        .map(|g| curve(&g.name, &|s| s.force[g.first_level + g.levels - 1] * 1e-3))
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

fn draw(svg: &mut String, panels: &[Panel]) -> Outcome {
    let height = HEIGHT * u32::try_from(panels.len())?;
    let root = SVGBackend::with_string(svg, (WIDTH, height)).into_drawing_area();
    root.fill(&WHITE)?;
    for (panel, area) in panels.iter().zip(root.split_evenly((panels.len(), 1))) {
        draw_panel(&area, panel)?;
    }
    root.present()?;
    Ok(())
}

/// Range of a coordinate with a margin, and never empty.
fn range(values: impl Iterator<Item = f64>, margin: f64) -> std::ops::Range<f64> {
    let (low, high) = values
        .filter(|x| x.is_finite())
        .fold((0.0_f64, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
    let width = if high > low { high - low } else { 1.0e-9 };
    low - if low < 0.0 { margin * width } else { 0.0 }..high + margin * width
}

fn draw_panel(
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
    panel: &Panel,
) -> Outcome {
    let points = || panel.curves.iter().flat_map(|c| c.points.iter());
    let mut chart = ChartBuilder::on(area)
        .caption(&panel.caption, ("sans-serif", 18))
        .margin(10)
        .x_label_area_size(32)
        .y_label_area_size(64)
        .build_cartesian_2d(
            range(points().map(|p| p.0), 0.02),
            range(points().map(|p| p.1), 0.05),
        )?;
    chart
        .configure_mesh()
        .x_desc(&panel.horizontal)
        .max_light_lines(0)
        .draw()?;
    for (i, curve) in panel.curves.iter().enumerate() {
        let colour = COLOURS[i % COLOURS.len()];
        chart
            .draw_series(LineSeries::new(curve.points.iter().copied(), &colour))?
            .label(curve.name.as_str())
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], colour));
    }
    if panel.curves.len() > 1 {
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::LowerRight)
            .background_style(WHITE.mix(0.8))
            .border_style(BLACK)
            .draw()?;
    }
    Ok(())
}
