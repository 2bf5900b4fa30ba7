//! Design spectra of codes, one code per file.

mod asce_7_2016;
mod code_spectrum;
mod eurocode_8_2004;

use crate::error::GroundMotionError;
use crate::spectra::{TargetSpectrum, logarithmic_periods};

pub use asce_7_2016::Asce7Of2016;
pub use code_spectrum::CodeSpectrum;
pub use eurocode_8_2004::{Eurocode8Of2004, GroundType, SpectrumType};

/// Points between two corners: with straight lines between logarithms, the maximum
/// error of a quadratic piece is below 1e-4.
const POINTS: usize = 80;

/// A target through all corners of a spectrum, many points between them.
fn through(
    corners: &[f64],
    damping: f64,
    acceleration: impl Fn(f64) -> f64,
) -> Result<TargetSpectrum, GroundMotionError> {
    let mut periods = vec![corners[0]];
    for pair in corners.windows(2).filter(|p| p[1] > p[0]) {
        periods.extend(
            logarithmic_periods(pair[0], pair[1], POINTS)?
                .into_iter()
                .skip(1),
        );
    }
    let accelerations = periods.iter().map(|t| acceleration(*t)).collect();
    TargetSpectrum::new(periods, accelerations, damping)
}
