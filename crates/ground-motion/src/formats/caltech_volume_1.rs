//! California Institute of Technology Volume I and University of Southern
//! California Volume 1: uncorrected pairs of time and acceleration.

use crate::error::GroundMotionError;
use crate::recording::Series;
use crate::source::Source;
use crate::volume_1;

pub(crate) fn matches(source: &Source<'_>) -> bool {
    source
        .first_line()
        .contains("uncorrected accelerogram data")
        && source
            .lines()
            .take(13)
            .any(|l| l.lower().contains("units are sec and"))
}

pub(crate) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    volume_1::read(source)
}
