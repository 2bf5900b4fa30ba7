//! Response and Fourier spectra.

pub mod design;

mod floor;
mod fourier;
mod oscillator;
mod response;
mod rotated;
mod target;
mod target_file;
mod transform;

use serde::Serialize;

pub use floor::{FloorMotion, floor_spectrum};
pub use fourier::{FourierSpectrum, fourier_spectrum};
pub(crate) use transform::{inverse_transform, transform};

pub(crate) use oscillator::{Oscillator, State, TOGETHER, exponential, zero};
pub use response::{
    OscillatorResponse, ResponseSpectrum, SMOOTH, USUAL_DAMPING, logarithmic_periods,
    oscillator_response, response_spectra, response_spectrum, response_spectrum_while,
};
pub use rotated::{RotatedSpectrum, rotated_spectrum};
pub use target::TargetSpectrum;

/// How peaks and integrals are taken from samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Evaluation {
    /// Of the acceleration that is linear between samples, which is what the time
    /// history sees: exact integrals, and peaks between samples as well.
    #[default]
    PiecewiseLinear,
    /// At samples alone, integrals by the trapezoid rule, as most programs and
    /// agencies do: peaks of oscillators whose period is a few time steps come out
    /// low. Displacements of the ground stay those of the linear acceleration.
    AtSamples,
}
