//! California Institute of Technology Volume I and University of Southern
//! California Volume 1: uncorrected pairs of time and acceleration.

use crate::error::GroundMotionError;
use crate::format::Format;
use crate::recording::Series;
use crate::source::Source;
use crate::volume_1;

pub(super) static FORMAT: Format = Format {
    name: "caltech_volume_1",
    title: "Volume I: uncorrected pairs of time and acceleration",
    source: "California Institute of Technology; University of Southern California",
    recognised_by: "uncorrected accelerogram data in the first line, and units are sec and within thirteen",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    source
        .first_line()
        .contains("uncorrected accelerogram data")
        && source
            .lines()
            .take(13)
            .any(|l| l.lower().contains("units are sec and"))
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    volume_1::read(source)
}
