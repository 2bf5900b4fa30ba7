//! Intervals between samples of the ground motion, and instants in them.

/// Times this much of them apart are one, but for round-off.
pub(crate) const CLOSE: f64 = 8.0 * f64::EPSILON;

/// Ground accelerations at an instant: that of the first motion, and where to find the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grounds {
    /// Acceleration of the first motion (m/s2).
    pub first: f64,
    /// Number of the interval, and time (s) since its start.
    pub interval: usize,
    pub tau: f64,
}

/// One interval between samples, with linear ground acceleration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Segment {
    /// Time at its start (s).
    pub start: f64,
    /// Its length (s).
    pub length: f64,
    /// Ground acceleration at its start (m/s2).
    pub acceleration: f64,
    /// Slope of the ground acceleration (m/s3).
    pub slope: f64,
    /// Its number.
    pub interval: usize,
}

impl Segment {
    /// Acceleration of the first ground motion (m/s2).
    pub(crate) fn acceleration_at(&self, tau: f64) -> f64 {
        self.acceleration + self.slope * tau
    }

    pub(crate) fn ground(&self, tau: f64) -> Grounds {
        Grounds {
            first: self.acceleration_at(tau),
            interval: self.interval,
            tau,
        }
    }
}
