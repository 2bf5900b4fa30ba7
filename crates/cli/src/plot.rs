//! Pictures of the commands, and where they are written.

use std::path::Path;

use pounding_report::ReportError;
use pounding_report::documentation::DocumentationFile;
pub use pounding_report::{Curve, Panel, Reference};
use pounding_time_history::{Sample, SampleSink, System, TimeHistoryError};

use crate::failure::Failure;

/// Draws panels below one another as SVG.
pub fn figure(panels: &[Panel]) -> Result<String, Failure> {
    pounding_report::figure(panels).map_err(|e| not_drawn(&e))
}

/// Draws panels below one another, and curves to compare with, as SVG.
pub fn figure_with_references(
    panels: &[Panel],
    references: &[Reference],
) -> Result<String, Failure> {
    pounding_report::figure_with_references(panels, references).map_err(|e| not_drawn(&e))
}

/// A picture of a library, written as a file.
pub fn write_drawn(path: &Path, picture: Result<String, ReportError>) -> Result<(), Failure> {
    let picture = picture.map_err(|e| match e {
        ReportError::Motion(error) => error.into(),
        error => not_drawn(&error),
    })?;
    write(path, &picture)
}

/// A picture that could not be drawn.
pub fn not_drawn(e: &impl std::error::Error) -> Failure {
    Failure::output(&std::io::Error::other(e.to_string()), "the picture")
}

/// Writes a text file, whole or not at all.
pub fn write(path: &Path, text: &str) -> Result<(), Failure> {
    pounding_files::write(path, text.as_bytes())
        .map_err(|e| Failure::output(&e, &path.display().to_string()))
}

/// Writes pages of the documentation into a folder.
pub fn write_documentation(folder: &Path, files: &[DocumentationFile]) -> Result<(), Failure> {
    std::fs::create_dir_all(folder)
        .map_err(|e| Failure::output(&e, &folder.display().to_string()))?;
    let mut files = files.iter();
    files.try_for_each(|file| write(&folder.join(&file.name), &file.text))
}

/// Points of a curve at most: more than a picture can show.
const MOST_POINTS: usize = 1 << 16;

/// Roof displacements and contact forces of a run on the output grid, as its picture shows
/// them.
pub struct Responses<'s> {
    system: &'s System,
    roofs: Vec<Thinned>,
    forces: Vec<Thinned>,
}

/// Time and value.
type Point = (f64, f64);

/// A curve that keeps the extremes of more and more samples in one when it gets too long.
#[derive(Default)]
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
    pub fn of(system: &'s System) -> Self {
        let curves = |count: usize| (0..count).map(|_| Thinned::default()).collect();
        Self {
            system,
            roofs: curves(system.buildings().len()),
            forces: curves(drawn(system).count()),
        }
    }

    /// Draws roof displacements above, contact forces of the highest levels below.
    pub fn draw(self, path: &Path) -> Result<(), Failure> {
        let system = self.system;
        let roofs = self.roofs.into_iter().zip(system.buildings());
        let roofs = roofs.map(|(c, b)| c.curve(b.name().to_owned()));
        let forces = self.forces.into_iter().zip(drawn(system));
        let forces = forces.map(|(c, level)| c.curve(system.name_of_level(level)));
        let panel = |caption: &str, curves| Panel {
            caption: caption.to_owned(),
            horizontal: "time (s)".to_owned(),
            curves,
        };
        let panels = [
            panel("Roof displacement (mm)", roofs.collect()),
            panel(
                "Contact force at the highest level (kN), sampled on the output grid",
                forces.collect(),
            ),
        ];
        write(path, &figure(&panels)?)
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
