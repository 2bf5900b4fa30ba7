//! Pictures: panels of curves below one another, as SVG.

use plotters::element::DashedPathElement;
use plotters::prelude::*;

use crate::error::ReportError;

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

/// A curve to compare with, drawn dashed and black.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Number of the panel, from zero.
    pub panel: usize,
    /// The curve.
    pub curve: Curve,
}

/// Width of the panels (pixels).
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
/// Dashes and spaces (pixels) that tell curves apart where the colours begin anew.
const DASHES: [(u32, u32); 4] = [(6, 4), (2, 3), (12, 3), (1, 5)];
/// More curves than this would hide behind their legend: it moves beside them.
const LEGEND_INSIDE: usize = 2;
/// Width of a legend beside the panels (pixels).
const LEGEND_WIDTH: u32 = 280;
/// Height of its lines (pixels).
const LEGEND_LINE: u32 = 18;

/// Draws panels below one another as SVG.
///
/// # Errors
/// [`ReportError::Figure`] with what the plotting library says.
pub fn figure(panels: &[Panel]) -> Result<String, ReportError> {
    figure_with_references(panels, &[])
}

/// Draws panels below one another, and curves to compare with, as SVG.
///
/// # Errors
/// As [`figure()`].
pub fn figure_with_references(
    panels: &[Panel],
    references: &[Reference],
) -> Result<String, ReportError> {
    drawn(panels, references, (WIDTH, HEIGHT))
}

/// Draws panels of a width and a height (pixels) below one another as SVG.
///
/// # Errors
/// As [`figure()`].
pub fn figure_of_size(panels: &[Panel], size: (u32, u32)) -> Result<String, ReportError> {
    drawn(panels, &[], size)
}

fn drawn(
    panels: &[Panel],
    references: &[Reference],
    size: (u32, u32),
) -> Result<String, ReportError> {
    let mut svg = String::new();
    let done = draw(&mut svg, panels, references, size).map_err(|e| e.to_string());
    done.map_err(|reason| ReportError::Figure { reason })?;
    Ok(svg)
}

fn draw(
    svg: &mut String,
    panels: &[Panel],
    references: &[Reference],
    (across, down): (u32, u32),
) -> Outcome {
    let beside = legend_beside(panels);
    let mut height = down * u32::try_from(panels.len())?;
    if beside {
        let lines = panels[0].curves.len() + references.len();
        height = height.max(LEGEND_LINE * u32::try_from(lines + 1)?);
    }
    let width = if beside {
        across + LEGEND_WIDTH
    } else {
        across
    };
    let root = SVGBackend::with_string(svg, (width, height)).into_drawing_area();
    root.fill(&WHITE)?;
    let (left, right) = root.split_horizontally(across);
    let areas = left.split_evenly((panels.len(), 1));
    for (i, (panel, area)) in panels.iter().zip(areas).enumerate() {
        let references: Vec<_> = references.iter().filter(|r| r.panel == i).collect();
        draw_panel(&area, panel, &references, !beside)?;
    }
    if beside {
        draw_legend(&right, &panels[0].curves, references)?;
    }
    root.present()?;
    Ok(())
}

/// Whether one legend beside the panels serves them all better.
fn legend_beside(panels: &[Panel]) -> bool {
    let names =
        |panel: &Panel| -> Vec<String> { panel.curves.iter().map(|c| c.name.clone()).collect() };
    panels.first().is_some_and(|first| {
        first.curves.len() > LEGEND_INSIDE && panels.iter().all(|p| names(p) == names(first))
    })
}

fn draw_legend(
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
    curves: &[Curve],
    references: &[Reference],
) -> Outcome {
    let references = references.iter().map(|r| (&r.curve, Stroke::REFERENCE));
    let curves = curves.iter().enumerate();
    let lines = references.chain(curves.map(|(i, c)| (c, Stroke::of(i))));
    let mut middle = i32::try_from(LEGEND_LINE)?;
    for (curve, stroke) in lines {
        let across = [(8, middle), (40, middle)];
        area.draw(&stroke.line(across))?;
        area.draw(&Text::new(
            curve.name.as_str(),
            (48, middle - 6),
            ("sans-serif", 13),
        ))?;
        middle += i32::try_from(LEGEND_LINE)?;
    }
    Ok(())
}

/// How a curve looks.
#[derive(Clone, Copy)]
struct Stroke {
    colour: RGBColor,
    /// Dash and space (pixels); `None` is a solid line.
    dash: Option<(u32, u32)>,
    width: u32,
}

impl Stroke {
    /// A curve to compare with.
    const REFERENCE: Self = Self {
        colour: BLACK,
        dash: Some(DASHES[0]),
        width: 2,
    };

    /// Curve number `index`.
    fn of(index: usize) -> Self {
        let turn = index / COLOURS.len();
        Self {
            colour: COLOURS[index % COLOURS.len()],
            dash: turn.checked_sub(1).map(|k| DASHES[k % DASHES.len()]),
            width: 1,
        }
    }

    fn style(self) -> ShapeStyle {
        self.colour.stroke_width(self.width)
    }

    /// A short line for a legend.
    fn line(
        self,
        ends: [(i32, i32); 2],
    ) -> DashedPathElement<std::array::IntoIter<(i32, i32), 2>, u32> {
        // A dash as long as the picture is a solid line.
        let (dash, space) = self.dash.unwrap_or((WIDTH, 0));
        DashedPathElement::new(ends, dash, space, self.style())
    }
}

/// Range of a coordinate with a margin, and never empty.
fn range(values: impl Iterator<Item = f64>, margin: f64) -> std::ops::Range<f64> {
    let (low, high) = values
        // Beyond this the width of the range would not be finite.
        .filter(|x| x.abs() < 1.0e150)
        .fold((0.0_f64, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
    let width = if high > low { high - low } else { 1.0e-9 };
    low - if low < 0.0 { margin * width } else { 0.0 }..high + margin * width
}

fn draw_panel(
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
    panel: &Panel,
    references: &[&Reference],
    legend: bool,
) -> Outcome {
    let compared = || references.iter().map(|r| &r.curve);
    let points = || {
        panel
            .curves
            .iter()
            .chain(compared())
            .flat_map(|c| c.points.iter())
    };
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
    let curves = panel.curves.iter().enumerate();
    let strokes = curves.map(|(i, curve)| (curve, Stroke::of(i)));
    for (curve, stroke) in strokes.chain(compared().map(|c| (c, Stroke::REFERENCE))) {
        let points = curve.points.iter().copied();
        let series = match stroke.dash {
            Some((dash, space)) => {
                chart.draw_series(DashedLineSeries::new(points, dash, space, stroke.style()))?
            }
            None => chart.draw_series(LineSeries::new(points, stroke.style()))?,
        };
        series
            .label(curve.name.as_str())
            .legend(move |(x, y)| stroke.line([(x, y), (x + 20, y)]));
    }
    if legend && panel.curves.len() + references.len() > 1 {
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::LowerRight)
            .background_style(WHITE.mix(0.8))
            .border_style(BLACK)
            .draw()?;
    }
    Ok(())
}
