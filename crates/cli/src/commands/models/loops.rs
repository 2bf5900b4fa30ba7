//! Force over penetration of the example collisions.

use super::example::{Example, Shown};
use crate::failure::Failure;
use crate::plot::{Curve, Panel, figure};

type Point = (f64, f64);

/// How far (pixels) a drawn curve may lie from the computed one: less does not show.
const TOLERANCE: f64 = 0.25;
/// Pixels across and up that the loops fill, roughly.
const EXTENT: Point = (850.0, 230.0);

/// The figure of a model with a force; none for a jump of velocities.
pub fn draw(example: &Example) -> Result<Option<String>, Failure> {
    if example.rigid {
        return Ok(None);
    }
    let size = example.shown.iter().fold((0.0, 0.0), |size, shown| {
        (
            shown.outcome.peak_penetration.max(size.0),
            shown.outcome.peak_force.max(size.1),
        )
    });
    let curves = example.shown.iter().map(|s| curve(s, size)).collect();
    figure(&[Panel {
        caption: format!("{}: contact force (kN)", example.descriptor.name),
        horizontal: "penetration (mm)".to_owned(),
        curves,
    }])
    .map(Some)
}

fn curve(shown: &Shown, size: Point) -> Curve {
    let name = shown
        .restitution
        .map_or_else(|| "example".to_owned(), |e| format!("e = {e}"));
    let history = &shown.outcome.history;
    // Contact ends at zero but for round-off, whose sign would show on the axis.
    let depth = |penetration: f64| penetration.max(0.0);
    // From nothing at closure and to nothing at the end: jumps show as lines.
    let end = history.last().map_or(0.0, |s| depth(s.penetration));
    let points: Vec<Point> = std::iter::once((0.0, 0.0))
        .chain(history.iter().map(|s| (depth(s.penetration), s.force)))
        .chain([(end, 0.0)])
        .collect();
    let points = thinned(&points, size)
        .into_iter()
        .map(|(x, y)| (1.0e3 * x, 1.0e-3 * y))
        .collect();
    Curve { name, points }
}

/// The points of a curve that show where it is drawn so that `size` fills the figure.
pub fn thinned(points: &[Point], size: Point) -> Vec<Point> {
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
