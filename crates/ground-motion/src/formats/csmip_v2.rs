//! CSMIP (CDMG, CGS) Volume 2: corrected acceleration, velocity and displacement.

use crate::error::GroundMotionError;
use crate::format::Format;
use crate::recording::Series;
use crate::source::Source;
use crate::volume_2;

/// Volume 3 has the skeleton of Volume 2, but holds no time series.
fn is_volume_3(first: &str) -> bool {
    first.contains("response") && first.contains("spectra")
}

pub(super) static FORMAT: Format = Format {
    name: "csmip_v2",
    title: "CSMIP (CDMG, CGS) Volume 2: acceleration, velocity and displacement",
    source: "California Strong Motion Instrumentation Program",
    recognised_by: "corrected accelerogram in the first line, uncorrected accelerogram data in the second",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    let first = source.first_line();
    let second = source.lines().nth(1).map(|l| l.lower()).unwrap_or_default();
    let accelerogram = second.contains("uncorrected accelerogram data");
    is_volume_3(&first) && second.contains("accelerogram")
        || first.contains("corrected accelerogram") && accelerogram
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    if is_volume_3(&source.first_line()) {
        return Err(GroundMotionError::Unsupported {
            file: source.file.to_owned(),
            what: "Volume 3 holds response and Fourier spectra, no time series".to_owned(),
            remedy: "use the Volume 2 file (.V2) of the same record",
        });
    }
    volume_2::read(source)
}
