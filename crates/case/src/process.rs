//! What is done to a record, as words.

use crate::types::{Located, Scale};

/// One step of processing, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub enum ProcessStep {
    /// `true_unit`: the values, taken as m/s2, are in truth in this unit.
    Unit(Located<String>),
    /// `sign = "reversed"`.
    ReverseSign,
    /// `remove_offset`.
    RemoveOffset(RemovedOffset),
    /// `filter`: Butterworth.
    Filter {
        /// Order of each pass and side.
        order: usize,
        /// High-pass (low-cut) corner (Hz).
        high_pass: Option<f64>,
        /// Low-pass (high-cut) corner (Hz).
        low_pass: Option<f64>,
        /// Whether it runs forward only.
        causal: bool,
        /// Whether the zeros put at both ends stay, for a filter in both directions.
        keep_pads: bool,
    },
    /// `baseline`.
    Baseline(BaselineKind),
    /// `trim` to times (s).
    TrimTimes {
        /// Start (s).
        start: f64,
        /// End (s).
        end: f64,
    },
    /// `trim` to parts of the Arias intensity.
    TrimArias {
        /// First part.
        from: f64,
        /// Last part.
        to: f64,
    },
    /// `taper`.
    Taper {
        /// Length at the start (s).
        start: f64,
        /// Length at the end (s).
        end: f64,
    },
    /// `pad` with zeros.
    Pad {
        /// Length before (s).
        before: f64,
        /// Length after (s).
        after: f64,
    },
    /// `resample`.
    Resample {
        /// New time step (s).
        time_step: f64,
        /// Through the Fourier transform instead of along straight lines.
        band_limited: bool,
    },
    /// `scale`.
    Scale(Scale),
}

/// What is taken off all samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RemovedOffset {
    /// The mean of the record.
    Mean,
    /// The mean of its first part of this length (s).
    PreEventMean(f64),
    /// A value (m/s2).
    Value(f64),
}

/// A correction of the baseline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BaselineKind {
    /// A polynomial of this degree off the acceleration.
    Acceleration(usize),
    /// The derivative of a polynomial of this degree, fitted to the velocity.
    Velocity(usize),
    /// Two segments between times (s).
    Segments {
        /// Start of the first segment (s).
        start: f64,
        /// End of the first segment (s).
        end: f64,
        /// Start of the fit (s).
        fit_from: Option<f64>,
    },
    /// Two segments between the first and last sample at an acceleration.
    Threshold {
        /// Acceleration (m/s2).
        threshold: f64,
        /// Start of the fit (s).
        fit_from: Option<f64>,
    },
}
