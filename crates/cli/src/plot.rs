//! A picture of a result: roof displacements and contact forces over time.

use std::path::Path;

use plotters::prelude::*;
use pounding_time_history::{RunRecord, Sample};

use crate::failure::Failure;

type Outcome = Result<(), Box<dyn std::error::Error>>;
type Curve = (String, Vec<(f64, f64)>);

/// Draws roof displacements above, contact forces of the highest levels below.
pub fn responses(path: &Path, record: &RunRecord<'_>) -> Result<(), Failure> {
    let mut svg = String::new();
    let drawn = draw(&mut svg, record).map_err(|e| e.to_string());
    drawn
        .map_err(std::io::Error::other)
        .and_then(|()| {
            let mut name = path.file_name().unwrap_or_default().to_owned();
            name.push(".part");
            let part = path.with_file_name(name);
            std::fs::write(&part, svg)?;
            std::fs::rename(&part, path)
        })
        .map_err(|e| Failure::output(&e, &path.display().to_string()))
}

fn draw(svg: &mut String, record: &RunRecord<'_>) -> Outcome {
    let root = SVGBackend::with_string(svg, (960, 640)).into_drawing_area();
    root.fill(&WHITE)?;
    let (upper, lower) = root.split_vertically(340);
    let system = &record.assembly.system;
    let curve =
        |pick: &dyn Fn(&Sample) -> f64| record.samples.iter().map(|s| (s.time, pick(s))).collect();
    let roofs: Vec<Curve> = system
        .buildings()
        .iter()
        .zip(system.offsets().windows(2))
        .map(|(b, range)| {
            (
                b.name().to_owned(),
                curve(&|s| s.displacement[range[1] - 1] * 1e3),
            )
        })
        .collect();
    panel(&upper, "Roof displacement (mm)", &roofs)?;
    let forces: Vec<Curve> = system
        .gaps()
        .iter()
        .filter(|g| g.levels > 0)
        .map(|g| {
            (
                g.name.clone(),
                curve(&|s| s.force[g.first_level + g.levels - 1] * 1e-3),
            )
        })
        .collect();
    panel(
        &lower,
        "Contact force at the highest level (kN), sampled on the output grid",
        &forces,
    )?;
    root.present()?;
    Ok(())
}

fn panel(
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
    caption: &str,
    curves: &[Curve],
) -> Outcome {
    let points = || curves.iter().flat_map(|(_, c)| c.iter());
    let end = points().fold(0.0_f64, |m, p| m.max(p.0)).max(1e-9);
    let low = points().fold(0.0_f64, |m, p| m.min(p.1));
    let high = points().fold(0.0_f64, |m, p| m.max(p.1));
    let margin = 0.05 * (high - low).max(1e-9);
    let mut chart = ChartBuilder::on(area)
        .caption(caption, ("sans-serif", 18))
        .margin(10)
        .x_label_area_size(32)
        .y_label_area_size(64)
        .build_cartesian_2d(0.0..end, low - margin..high + margin)?;
    chart
        .configure_mesh()
        .x_desc("time (s)")
        .light_line_style(WHITE)
        .draw()?;
    for (i, (name, curve)) in curves.iter().enumerate() {
        let colour = Palette99::pick(i).to_rgba();
        chart
            .draw_series(LineSeries::new(curve.iter().copied(), &colour))?
            .label(name.as_str())
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], colour));
    }
    if curves.len() > 1 {
        chart
            .configure_series_labels()
            .background_style(WHITE.mix(0.8))
            .border_style(BLACK)
            .draw()?;
    }
    Ok(())
}
