//! California Institute of Technology Volume II: corrected acceleration, velocity
//! and displacement. Header peaks and initial values have the opposite sign to the
//! samples, and records start with the velocity of the first sample, not at rest.

use crate::error::GroundMotionError;
use crate::format::Format;
use crate::recording::Series;
use crate::source::Source;
use crate::volume_2;

pub(super) static FORMAT: Format = Format {
    name: "caltech_volume_2",
    title: "Volume II: corrected acceleration, velocity and displacement",
    source: "California Institute of Technology",
    recognised_by: "corrected accelerogram and comp in the first line, of uncorrected accelerogram data of vol in the second",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    let first = source.first_line();
    let second = source.lines().nth(1).map(|l| l.lower()).unwrap_or_default();
    first.contains("corrected accelerogram")
        && first.contains("comp ")
        && second.contains("of uncorrected accelerogram data of vol")
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    volume_2::read(source)
}
