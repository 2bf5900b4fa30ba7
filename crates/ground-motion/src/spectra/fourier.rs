//! Fourier spectra.

use serde::Serialize;

use crate::accelerogram::Accelerogram;
use crate::error::{GroundMotionError, bound, positive};
use crate::spectra::transform::transform;

/// Fourier amplitudes of an acceleration.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FourierSpectrum {
    /// Frequencies (Hz) from zero up, evenly spaced.
    pub frequencies: Vec<f64>,
    /// Amplitudes (m/s): time step times the modulus of the transform.
    pub amplitudes: Vec<f64>,
    /// Length of the samples that were transformed (s), zeros after the record
    /// included.
    pub length: f64,
    /// Time step (s).
    pub time_step: f64,
}

/// The Fourier amplitude spectrum of at least `least_length` samples: the record with
/// zeros after it. Frequencies run to the Nyquist frequency.
#[must_use]
pub fn fourier_spectrum(record: &Accelerogram, least_length: usize) -> FourierSpectrum {
    let count = least_length.max(record.samples().len());
    let step = record.time_step();
    let coefficients = transform(record.samples(), count);
    let length = count as f64 * step;
    FourierSpectrum {
        frequencies: (0..coefficients.len()).map(|k| k as f64 / length).collect(),
        amplitudes: coefficients
            .iter()
            .map(|c| step * libm::hypot(c.re, c.im))
            .collect(),
        length,
        time_step: step,
    }
}

/// Round-off of frequencies that are an end of the spectrum.
const ROUND_OFF: f64 = 1.0e-9;

impl FourierSpectrum {
    /// First line (Hz), one over the length, and half the sampling rate.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        (1.0 / self.length, 0.5 / self.time_step)
    }

    /// Refuses a frequency (Hz) of which the samples tell nothing.
    fn holds(&self, frequency: f64) -> Result<(), GroundMotionError> {
        let (first, highest) = self.range();
        let refused = |reason, remedy| {
            Err(GroundMotionError::NotPossible {
                step: "Fourier spectrum",
                reason,
                remedy,
            })
        };
        if frequency > highest * (1.0 + ROUND_OFF) {
            refused(
                format!(
                    "{} Hz is above half the sampling rate, {} Hz: samples {} s apart hold nothing of it",
                    bound(frequency),
                    bound(highest),
                    bound(self.time_step)
                ),
                "give frequencies up to half the sampling rate",
            )
        } else if frequency < first * (1.0 - ROUND_OFF) {
            refused(
                format!(
                    "{} Hz is below the first line of the spectrum, {} Hz, which is one over {} s",
                    bound(frequency),
                    bound(first),
                    bound(self.length)
                ),
                "give frequencies from the first line on, or put zeros behind the record (`pounding motion process FILE --pad \"after=60 s\" -o OUT`), which puts the lines nearer",
            )
        } else {
            Ok(())
        }
    }

    /// The amplitudes at these frequencies (Hz), smoothed by the window
    /// `(sin(b log10(f/fc))/(b log10(f/fc)))^4` of bandwidth coefficient `b`, 20 to 40
    /// in use (Konno and Ohmachi 1998, Bull. Seism. Soc. Am. 88 (1) 228, eq. 4).
    /// The weights sum to one; the constant term has none.
    ///
    /// # Errors
    /// A coefficient that is not positive, or a frequency beyond the lines of the spectrum: below
    /// the first one, or above half the sampling rate. The window would take the lines at that
    /// end for it.
    pub fn konno_ohmachi(
        &self,
        centres: &[f64],
        bandwidth: f64,
    ) -> Result<Vec<f64>, GroundMotionError> {
        const STEP: &str = "smoothing";
        positive(STEP, "bandwidth coefficient", bandwidth)?;
        let mut smoothed = Vec::with_capacity(centres.len());
        for &centre in centres {
            positive(STEP, "frequency", centre)?;
            self.holds(centre)?;
            let (mut sum, mut weights) = (0.0, 0.0);
            for (f, a) in self.frequencies.iter().zip(&self.amplitudes).skip(1) {
                let weight = window(bandwidth * libm::log10(f / centre));
                sum += weight * a;
                weights += weight;
            }
            smoothed.push(sum / weights);
        }
        Ok(smoothed)
    }
}

fn window(x: f64) -> f64 {
    if x.abs() < 1.0e-6 {
        return 1.0;
    }
    (libm::sin(x) / x).powi(4)
}
