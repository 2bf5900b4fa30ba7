//! Runs.

use pounding_time_history::{Sample, SampleSink, System, TimeHistoryError};

use super::panel;
use crate::error::ReportError;
use crate::figure::{Curve, figure};

/// Points of a curve at most: more than a picture can show.
const MOST_POINTS: usize = 1 << 16;

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

    /// Roof displacements above, contact forces of the highest levels below.
    ///
    /// # Errors
    /// [`ReportError::Figure`].
    pub fn picture(self) -> Result<String, ReportError> {
        let system = self.system;
        let roofs = self.roofs.into_iter().zip(system.buildings());
        let roofs = roofs.map(|(c, b)| c.curve(b.name().to_owned()));
        let forces = self.forces.into_iter().zip(drawn(system));
        let forces = forces.map(|(c, level)| c.curve(system.name_of_level(level)));
        let forces_at = "Contact force at the highest level (kN), sampled on the output grid";
        figure(&[
            panel(
                "Roof displacement with pounding (mm)",
                "time (s)",
                roofs.collect(),
            ),
            panel(forces_at, "time (s)", forces.collect()),
        ])
    }
}

/// The highest level of every gap that has one.
fn drawn(system: &System) -> impl Iterator<Item = usize> {
    let gaps = system.gaps().iter().filter(|g| g.levels > 0);
    gaps.map(|g| g.first_level + g.levels - 1)
}

impl SampleSink for Responses<'_> {
    fn take(&mut self, sample: &Sample) -> Result<(), TimeHistoryError> {
        let ends = &self.system.offsets()[1..];
        for (curve, end) in self.roofs.iter_mut().zip(ends) {
            curve.push((sample.time, 1e3 * sample.displacement[end - 1]));
        }
        for (curve, level) in self.forces.iter_mut().zip(drawn(self.system)) {
            curve.push((sample.time, 1e-3 * sample.force[level]));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
