//! CSMIP (CDMG, CGS) Volume 1, also RENADIC: uncorrected accelerations, as pairs
//! of time and value or at even steps.

use crate::error::GroundMotionError;
use crate::recording::Series;
use crate::source::Source;
use crate::volume_1;

pub(crate) fn matches(source: &Source<'_>) -> bool {
    source
        .first_line()
        .contains("uncorrected accelerogram data")
}

pub(crate) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    volume_1::read(source)
}
