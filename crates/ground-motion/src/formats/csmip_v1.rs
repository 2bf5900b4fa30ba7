//! CSMIP (CDMG, CGS) Volume 1, also RENADIC: uncorrected accelerations, as pairs
//! of time and value or at even steps.

use crate::error::GroundMotionError;
use crate::format::Format;
use crate::recording::Series;
use crate::source::Source;
use crate::volume_1;

pub(super) static FORMAT: Format = Format {
    name: "csmip_v1",
    title: "CSMIP (CDMG, CGS) Volume 1: pairs of time and acceleration, or even steps",
    source: "California Strong Motion Instrumentation Program",
    recognised_by: "uncorrected accelerogram data in the first line",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    source
        .first_line()
        .contains("uncorrected accelerogram data")
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    volume_1::read(source)
}
