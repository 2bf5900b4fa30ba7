//! Runs.

use pounding_time_history::{History, HistorySink, System, TimeHistoryError};

use super::panel;
use crate::chart::Chart;
use crate::figure::{Curve, Panel, figure};

/// Points of a curve at most: more than a picture can show.
const MOST_POINTS: usize = 1 << 16;
/// Curves of a panel at most: more cannot be told apart.
const MOST_CURVES: usize = 7;

/// Roof displacements and contact forces of a run on the output grid, as its picture shows
/// them.
#[derive(Debug)]
pub struct Responses<'s> {
    system: &'s System,
    roofs: Vec<Thinned>,
    forces: Vec<Thinned>,
}

/// Time and value.
type Point = (f64, f64);

/// A curve that keeps the extremes of more and more samples in one when it gets too long.
#[derive(Debug, Default)]
struct Thinned {
    points: Vec<Point>,
    /// Samples in a pair of points, or 1 while every sample is a point.
    samples: usize,
    /// Samples, the smallest and the greatest of them, that are no points yet.
    open: Option<(usize, Point, Point)>,
}

impl Thinned {
    fn push(&mut self, point: (f64, f64)) {
        let samples = self.samples.max(1);
        if samples == 1 {
            self.points.push(point);
        } else {
            let (count, low, high) = self.open.get_or_insert((0, point, point));
            *count += 1;
            if point.1 < low.1 {
                *low = point;
            }
            if point.1 > high.1 {
                *high = point;
            }
            if *count == samples {
                self.close();
            }
        }
        if self.points.len() >= MOST_POINTS {
            // Pairs of extremes of two parts become one pair.
            let parts = std::mem::take(&mut self.points);
            self.samples = if samples == 1 { 4 } else { 2 * samples };
            for part in parts.chunks(4) {
                self.extremes(part);
            }
        }
    }

    fn close(&mut self) {
        if let Some((_, low, high)) = self.open.take() {
            self.extremes(&[low, high]);
        }
    }

    /// Adds the smallest and the greatest of some points in order of time.
    fn extremes(&mut self, points: &[(f64, f64)]) {
        let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let ends = [
            points.iter().min_by(by_value),
            points.iter().max_by(by_value),
        ];
        let mut ends: Vec<_> = ends.into_iter().flatten().copied().collect();
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.points.extend(ends);
    }

    fn curve(mut self, name: String) -> Curve {
        self.close();
        Curve {
            name,
            points: self.points,
        }
    }
}

impl<'s> Responses<'s> {
    /// None as yet.
    #[must_use]
    pub fn of(system: &'s System) -> Self {
        let curves = |count: usize| (0..count).map(|_| Thinned::default()).collect();
        Self {
            system,
            roofs: curves(system.buildings().len()),
            forces: curves(drawn(system).count()),
        }
    }

    /// Roof displacements above, contact forces of the highest levels below; of long rows the
    /// greatest.
    #[must_use]
    pub fn picture(self) -> Chart {
        let system = self.system;
        let roofs = self.roofs.into_iter().zip(system.buildings());
        let roofs = roofs.map(|(c, b)| c.curve(b.name().to_owned()));
        let forces = self.forces.into_iter().zip(drawn(system));
        let forces = forces.map(|(c, level)| c.curve(system.name_of_level(level)));
        let forces_at = "Contact force at the highest level (kN), sampled on the output grid";
        let of = "Roof displacement with pounding (mm)";
        figure(&[
            greatest(of, "buildings", roofs.collect()),
            greatest(forces_at, "gaps", forces.collect()),
        ])
    }
}

/// A panel with the curves that reach furthest, in their order, and a heading that says how many
/// of how many they are.
fn greatest(caption: &str, things: &str, curves: Vec<Curve>) -> Panel {
    let all = curves.len();
    if all <= MOST_CURVES {
        return panel(caption, "time (s)", curves);
    }
    let reach = |curve: &Curve| curve.points.iter().fold(0.0_f64, |m, p| m.max(p.1.abs()));
    let mut ranked: Vec<(f64, usize, Curve)> = curves
        .into_iter()
        .enumerate()
        .map(|(place, curve)| (reach(&curve), place, curve))
        .collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    ranked.truncate(MOST_CURVES);
    ranked.sort_by_key(|(_, place, _)| *place);
    let shown = ranked.into_iter().map(|(_, _, curve)| curve).collect();
    let caption = format!("{caption}; the greatest {MOST_CURVES} of {all} {things}");
    panel(&caption, "time (s)", shown)
}

/// The highest level of every gap that has one.
fn drawn(system: &System) -> impl Iterator<Item = usize> {
    let gaps = system.gaps().iter().filter(|g| g.levels > 0);
    gaps.map(|g| g.first_level + g.levels - 1)
}

impl HistorySink for Responses<'_> {
    fn take(&mut self, rows: &mut History) -> Result<(), TimeHistoryError> {
        let (system, times) = (self.system, &rows.time);
        let ends = &system.offsets()[1..];
        for (curve, end) in self.roofs.iter_mut().zip(ends) {
            let row = rows.displacement.chunks_exact(system.floors());
            for (time, row) in times.iter().zip(row) {
                curve.push((*time, 1e3 * row[end - 1]));
            }
        }
        for (curve, level) in self.forces.iter_mut().zip(drawn(system)) {
            let row = rows.force.chunks_exact(system.levels().len());
            for (time, row) in times.iter().zip(row) {
                curve.push((*time, 1e-3 * row[level]));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a long row the curves that reach furthest, in the order of the row.
    #[test]
    fn long_rows_show_the_greatest() {
        let curve = |i: usize| Curve {
            name: format!("b{i}"),
            points: vec![
                (0.0, 0.0),
                (1.0, if i % 4 == 1 { -9.0 - i as f64 } else { 1.0 }),
            ],
        };
        let panel = greatest("Roof (mm)", "buildings", (0..30).map(curve).collect());
        let names: Vec<&str> = panel.curves.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["b5", "b9", "b13", "b17", "b21", "b25", "b29"]);
        assert_eq!(panel.caption, "Roof (mm); the greatest 7 of 30 buildings");
        assert_eq!(
            greatest("Roof (mm)", "buildings", vec![curve(1)]).caption,
            "Roof (mm)"
        );
    }

    /// However many samples there are, the picture keeps their extremes and their ends.
    #[test]
    fn long_curves_keep_their_extremes() {
        let value = |i: usize| ((i % 977) as f64).sin() + if i == 654_321 { 9.0 } else { 0.0 };
        let mut curve = Thinned::default();
        for i in 0..1_000_000 {
            curve.push((i as f64, value(i)));
        }
        let curve = curve.curve(String::new());
        assert!(curve.points.len() <= MOST_POINTS + 2);
        assert!(curve.points.contains(&(654_321.0, value(654_321))));
        assert!(curve.points.is_sorted_by(|a, b| a.0 <= b.0));
        let low = curve.points.iter().fold(0.0_f64, |m, p| m.min(p.1));
        let least = (0..977).map(value).fold(0.0_f64, f64::min);
        assert_eq!(low, least);
        assert!(curve.points.last().is_some_and(|p| p.0 > 999_900.0));
    }
}
