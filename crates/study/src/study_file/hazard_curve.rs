//! The hazard curve of a site.

use std::ops::RangeInclusive;

use crate::error::StudyError;

/// Mean annual frequencies with which intensities are exceeded, falling with the
/// intensity; a power law between its points.
#[derive(Debug, Clone, PartialEq)]
pub struct HazardCurve {
    /// Intensity (SI) and mean annual frequency (1/year), intensities rising.
    pub points: Vec<(f64, f64)>,
}

/// Intensities (SI) and frequencies (1/year) of a hazard curve.
pub(super) const HAZARD_NUMBERS: RangeInclusive<f64> = 1.0e-100..=1.0e100;

impl HazardCurve {
    /// A curve through these points.
    ///
    /// # Errors
    /// Fewer than two points, values that are not positive or outside 1e-100 to 1e100, intensities that do not rise
    /// or frequencies that do not fall.
    pub fn new(points: Vec<(f64, f64)>) -> Result<Self, StudyError> {
        match Self::fault(&points) {
            None => Ok(Self { points }),
            Some((_, reason)) => Err(StudyError::Evaluation {
                what: "hazard curve",
                reason: reason.to_owned(),
            }),
        }
    }

    /// The first point (from zero) that no curve goes through after those before it, and why.
    pub(super) fn fault(points: &[(f64, f64)]) -> Option<(usize, &'static str)> {
        if points.len() < 2 {
            return Some((points.len(), "it has fewer than two points"));
        }
        let sound = |(a, b): &(f64, f64)| *a > 0.0 && *b > 0.0 && a.is_finite() && b.is_finite();
        if let Some(point) = points.iter().position(|p| !sound(p)) {
            return Some((point, "intensities and frequencies must be above zero"));
        }
        // Power laws of more extreme points leave the range of numbers.
        let usual = |(a, b): &(f64, f64)| [a, b].into_iter().all(|x| HAZARD_NUMBERS.contains(x));
        if let Some(point) = points.iter().position(|p| !usual(p)) {
            return Some((
                point,
                "intensities and frequencies must be from 1e-100 to 1e100",
            ));
        }
        let mut pairs = points.windows(2);
        let turned = pairs.position(|p| !(p[0].0 < p[1].0 && p[0].1 > p[1].1))?;
        Some((turned + 1, "intensities must rise and frequencies fall"))
    }
}
