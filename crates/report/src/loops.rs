//! Loops of force over penetration or deformation.

use pounding_catalogue::numbers::significant;
use pounding_hysteresis::laboratory::{Cycle, Loop};

use crate::figure::{Curve, Panel};

type Point = (f64, f64);

/// How far (pixels) a drawn curve may lie from the computed one: less does not show.
const TOLERANCE: f64 = 0.25;
/// Pixels across and up that the loops fill, roughly.
const EXTENT: Point = (850.0, 230.0);

/// Force (kN) over deformation (mm) of named loops.
pub(crate) fn deformation_panel(law: &str, loops: Vec<(String, &Loop)>) -> Panel {
    let curves = loops.into_iter().map(|(name, driven)| {
        let states = driven.states.iter();
        (name, states.map(|s| (s.deformation, s.force)).collect())
    });
    let caption = format!("{law}: force (kN)");
    panel(caption, "deformation (mm)", curves.collect())
}

/// Curves (N over m) in kN over mm, without the points that would not show.
pub(crate) fn panel(caption: String, horizontal: &str, curves: Vec<(String, Vec<Point>)>) -> Panel {
    let largest = |coordinate: fn(&Point) -> f64| {
        let points = curves.iter().flat_map(|(_, points)| points);
        let sizes = points.map(|p| coordinate(p).abs());
        sizes.fold(f64::MIN_POSITIVE, f64::max)
    };
    let size = (largest(|p| p.0), largest(|p| p.1));
    let drawn = |(name, points): (String, Vec<Point>)| Curve {
        name,
        points: thinned(&points, size)
            .into_iter()
            .map(|(x, y)| (1.0e3 * x, 1.0e-3 * y))
            .collect(),
    };
    Panel {
        caption,
        horizontal: horizontal.to_owned(),
        curves: curves.into_iter().map(drawn).collect(),
    }
}

/// The points of a curve that show where it is drawn so that `size` fills the figure.
fn thinned(points: &[Point], size: Point) -> Vec<Point> {
    let pixels: Vec<Point> = points
        .iter()
        .map(|p| (p.0 / size.0 * EXTENT.0, p.1 / size.1 * EXTENT.1))
        .collect();
    let mut kept = vec![0];
    simplify(&pixels, 0, pixels.len() - 1, &mut kept);
    kept.into_iter().map(|i| points[i]).collect()
}

/// The points after `first` up to `last` without which the curve would lie further
/// off than [`TOLERANCE`] (Douglas and Peucker 1973).
fn simplify(points: &[Point], first: usize, last: usize, kept: &mut Vec<usize>) {
    let farthest = (first + 1..last)
        .map(|i| (i, distance(points[i], points[first], points[last])))
        .max_by(|a, b| a.1.total_cmp(&b.1));
    match farthest {
        Some((middle, off)) if off > TOLERANCE => {
            simplify(points, first, middle, kept);
            simplify(points, middle, last, kept);
        }
        _ => kept.push(last),
    }
}

/// Distance of a point from the line between two others.
fn distance(point: Point, from: Point, to: Point) -> f64 {
    let (x, y) = (point.0 - from.0, point.1 - from.1);
    let (along_x, along_y) = (to.0 - from.0, to.1 - from.1);
    let squared = along_x * along_x + along_y * along_y;
    let part = if squared > 0.0 {
        ((x * along_x + y * along_y) / squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (x - part * along_x).hypot(y - part * along_y)
}

/// What [`cycle_cells`] shows of a cycle. A cycle of a history begins at either of its extremes.
pub const CYCLE_COLUMNS: [&str; 6] = [
    "greatest (mm)",
    "least (mm)",
    "peak force (kN)",
    "dissipated (J)",
    "secant stiffness (kN/m)",
    "equivalent damping (%)",
];

/// Extremes (mm), force (kN), energy (J), stiffness (kN/m) and damping (%) of a cycle, as texts.
#[must_use]
pub fn cycle_cells(cycle: &Cycle) -> [String; 6] {
    let range = cycle.maximum - cycle.minimum;
    // What is round-off beside the work of the peak force is shown as nothing.
    let shown = |value: f64, scale: f64| {
        let nothing = value.abs() < 1.0e-11 * scale;
        significant(if nothing { 0.0 } else { value })
    };
    let ratio = cycle.equivalent_damping_ratio;
    [
        significant(1.0e3 * cycle.maximum),
        significant(1.0e3 * cycle.minimum),
        significant(1.0e-3 * cycle.peak_force),
        shown(cycle.dissipated, cycle.peak_force * range),
        shown(1.0e-3 * cycle.secant_stiffness, cycle.peak_force / range),
        ratio.map_or_else(|| "-".to_owned(), |ratio| significant(100.0 * ratio)),
    ]
}
