//! Runs.

use pounding_time_history::{History, HistorySink, Impact, System, TimeHistoryError};

use super::panel;
use crate::chart::Chart;
use crate::decimation::decimated;
use crate::figure::{Curve, Panel, figure};

/// Points of a curve at most: more than a picture can show.
const MOST_POINTS: usize = 1 << 16;
/// Curves of a panel at most: more cannot be told apart.
const MOST_CURVES: usize = 7;

/// Roof displacements and contact forces of a run on the output grid, to which its picture adds
/// the impacts between its times.
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

    /// Roof displacements above, below them what these impacts, all of the run, bring to the
    /// highest levels: contact forces, and impulses where velocities jump; of long rows the
    /// greatest.
    #[must_use]
    pub fn picture(self, impacts: &[Impact]) -> Chart {
        let system = self.system;
        let end = self.roofs.iter().filter_map(|c| c.points.last());
        let end = end.fold(0.0_f64, |m, p| m.max(p.0));
        let roofs = self.roofs.into_iter().zip(system.buildings());
        let roofs = roofs.map(|(c, b)| c.curve(b.name().to_owned()));
        let of = "Roof displacement with pounding (mm)";
        let mut panels = vec![greatest(of, "buildings", roofs.collect())];
        let (mut forces, mut impulses, mut hit) = (Vec::new(), Vec::new(), false);
        for (curve, level) in self.forces.into_iter().zip(drawn(system)) {
            let here = |i: &&Impact| system.gaps()[i.gap].first_level + i.level == level;
            let here: Vec<Hit> = impacts.iter().filter(here).map(Hit::of).collect();
            hit |= !here.is_empty();
            let curve = curve.curve(system.name_of_level(level));
            let (force, impulse) = of_level(curve, &here, end);
            forces.extend(force);
            impulses.extend(impulse);
        }
        if !forces.is_empty() || impulses.is_empty() {
            let caption = match hit {
                true => {
                    "Contact force at the highest level (kN), with closing, peak and opening of every impact"
                }
                false => "Contact force at the highest level (kN): no impact there",
            };
            panels.push(greatest(caption, "gaps", forces));
        }
        if !impulses.is_empty() {
            let caption = "Impulse of every impact at the highest level (kN s): velocities jump, without a force";
            panels.push(greatest(caption, "gaps", impulses));
        }
        figure(&panels)
    }
}

/// What a picture shows of an impact: times (s), force (kN) and impulse (kN s).
#[derive(Debug, Clone, Copy)]
struct Hit {
    closes: f64,
    /// NaN where it outlasts the run.
    opens: f64,
    peak: Point,
    impulse: f64,
}

impl Hit {
    fn of(impact: &Impact) -> Self {
        let peak = impact.peak_force;
        Self {
            closes: impact.time_closed,
            opens: impact.time_opened,
            peak: (peak.time, 1e-3 * peak.value),
            impulse: 1e-3 * impact.impulse,
        }
    }

    fn has_force(&self) -> bool {
        self.peak.1 > 0.0
    }

    /// Closing, peak and opening of an impact that has a force: most last less than an output
    /// step.
    fn instants(&self) -> impl Iterator<Item = Point> {
        let points = [(self.closes, 0.0), self.peak, (self.opens, 0.0)];
        let forced = self.has_force();
        points
            .into_iter()
            .filter(move |p| forced && p.0.is_finite())
    }
}

/// Force of a level over time, if it has any or nothing else to show, and the impulses of its
/// velocity jumps, if there are any, as stems over the time up to `end`.
fn of_level(samples: Curve, hits: &[Hit], end: f64) -> (Option<Curve>, Option<Curve>) {
    let mut stems = vec![(0.0, 0.0)];
    let jumps = hits
        .iter()
        .filter(|i| !i.has_force() && i.opens.is_finite());
    stems.extend(jumps.flat_map(|i| [0.0, i.impulse, 0.0].map(|height| (i.closes, height))));
    let impulses = (stems.len() > 1).then(|| {
        stems.push((end, 0.0));
        Curve {
            name: samples.name.clone(),
            points: few(stems),
        }
    });
    let pushed = samples.points.iter().any(|p| p.1 != 0.0);
    let forced = hits.iter().any(Hit::has_force);
    let force = (impulses.is_none() || pushed || forced).then(|| {
        let mut points = samples.points;
        points.extend(hits.iter().flat_map(Hit::instants));
        // Stable: instants of an impact at one time stay in their order.
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Curve {
            name: samples.name,
            points: few(points),
        }
    });
    (force, impulses)
}

/// No more points than a picture can show.
fn few(points: Vec<Point>) -> Vec<Point> {
    match points.len() > MOST_POINTS {
        true => decimated(&points, MOST_POINTS / 4),
        false => points,
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

    /// An impact between two output times is in the curve with its peak; of velocity jumps the
    /// impulses stand in a curve of their own, and no force that is zero throughout.
    #[test]
    fn impacts_between_output_times_are_drawn() {
        let samples = |value: f64| Curve {
            name: "a-b".to_owned(),
            points: (0..5).map(|i| (0.01 * f64::from(i), value)).collect(),
        };
        let hit = |closes: f64, force: f64, opens: f64| Hit {
            closes,
            opens,
            peak: (closes + 1e-4, force),
            impulse: 3.0,
        };
        let hits = [hit(0.0123, 5e3, 0.0125), hit(0.0323, 2e3, f64::NAN)];
        let (force, impulse) = of_level(samples(0.0), &hits, 0.04);
        let points = force.map(|c| c.points).unwrap_or_default();
        assert_eq!(
            points[2..5],
            [(0.0123, 0.0), (0.0123 + 1e-4, 5e3), (0.0125, 0.0)]
        );
        assert_eq!(points.len(), 10);
        assert!(points.is_sorted_by(|a, b| a.0 <= b.0));
        assert_eq!(impulse, None);
        let jump = [hit(0.0123, f64::NAN, 0.0123)];
        let (force, impulse) = of_level(samples(0.0), &jump, 0.04);
        assert_eq!(force, None);
        let stems = impulse.map(|c| c.points).unwrap_or_default();
        let at = 0.0123;
        assert_eq!(
            stems,
            [(0.0, 0.0), (at, 0.0), (at, 3.0), (at, 0.0), (0.04, 0.0)]
        );
        // What holds floors together is a force all the same, and so is none of a gap that stays open.
        assert!(of_level(samples(1.0), &jump, 0.04).0.is_some());
        assert!(of_level(samples(0.0), &[], 0.04).0.is_some());
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
