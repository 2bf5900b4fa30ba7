//! Pictures: panels of curves below one another, as SVG.

use crate::chart::{Axis, Chart, HEIGHT, Look, Plot, Series};

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

/// A curve to compare with, drawn dashed, thick and black.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Number of the panel, from zero.
    pub panel: usize,
    /// The curve.
    pub curve: Curve,
}

/// Points (1/72 inch) in a pixel (1/96 inch).
const POINTS_PER_PIXEL: f64 = 0.75;

/// Panels below one another.
#[must_use]
pub fn figure(panels: &[Panel]) -> Chart {
    figure_with_references(panels, &[])
}

/// Panels below one another, and curves to compare with.
#[must_use]
pub fn figure_with_references(panels: &[Panel], references: &[Reference]) -> Chart {
    Chart::of_page(plots(panels, references))
}

/// Draws panels of a width and a height (pixels) below one another as SVG.
pub(crate) fn figure_of_size(panels: &[Panel], size: (u32, u32)) -> String {
    plots_of_size(plots(panels, &[]), size)
}

/// Draws plots of a width and a height (pixels) below one another as SVG.
pub(crate) fn plots_of_size(plots: Vec<Plot>, size: (u32, u32)) -> String {
    let [width, height] = [size.0, size.1].map(f64::from);
    let chart = Chart {
        width: POINTS_PER_PIXEL * width,
        stated_width: format!("{width}"),
        height: Some(POINTS_PER_PIXEL * height * plots.len() as f64),
        plots,
    };
    chart.svg()
}

/// Panels as plots with linear axes, later references over the curves.
pub(crate) fn plots(panels: &[Panel], references: &[Reference]) -> Vec<Plot> {
    let panels = panels.iter().enumerate();
    let plot = |(number, panel): (usize, &Panel)| {
        let curves = panel.curves.iter().enumerate();
        let curves = curves.map(|(i, curve)| series(curve, Look::line(i)));
        let references = references.iter().filter(|r| r.panel == number);
        let references = references.enumerate();
        let references = references.map(|(i, r)| series(&r.curve, Look::reference(i)));
        Plot {
            heading: panel.caption.clone(),
            horizontal: Axis::linear(&panel.horizontal),
            vertical: Axis::linear(""),
            series: curves.chain(references).collect(),
            limits: Vec::new(),
            height: HEIGHT,
        }
    };
    panels.map(plot).collect()
}

/// A curve with a look.
pub(crate) fn series(curve: &Curve, look: Look) -> Series {
    Series {
        name: curve.name.clone(),
        points: curve.points.clone(),
        look,
    }
}
