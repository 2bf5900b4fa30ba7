//! Ground motions.

use std::path::Path;

use pounding_ground_motion::processing::Scale;
use pounding_ground_motion::{AccelerationUnit, Accelerogram, ReadOptions, read};

use crate::error::Error;
use crate::units::{Acceleration, Time};

/// The motion of the ground that all buildings stand on.
#[derive(Debug, Clone)]
pub struct GroundMotion(Accelerogram);

impl GroundMotion {
    /// Reads a record in one of the formats that agencies publish, found from its content.
    /// [`ground_motion::read`](pounding_ground_motion::read) has options for files that do not
    /// say all; what it reads is turned into this by `into`.
    ///
    /// # Errors
    /// A file that cannot be read, with its line.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        Ok(Self(read(path.as_ref(), &ReadOptions::default())?))
    }

    /// A motion of these accelerations at even steps from time zero on, linear in between.
    ///
    /// # Errors
    /// A step that is not positive, fewer than two accelerations, or one that is not finite.
    pub fn of(
        accelerations: impl IntoIterator<Item = Acceleration>,
        step: Time,
    ) -> Result<Self, Error> {
        let samples = accelerations.into_iter().map(Acceleration::si).collect();
        let unit = AccelerationUnit::MetrePerSecondSquared;
        Ok(Self(Accelerogram::new(samples, unit, step.si())?))
    }

    /// Scaled to a peak ground acceleration.
    ///
    /// # Errors
    /// A peak that is not positive, or a motion that is zero.
    pub fn scaled_to(&self, peak: Acceleration) -> Result<Self, Error> {
        let factor = Scale::PeakAcceleration(peak.si()).factor(&self.0)?;
        Ok(Self(self.0.scaled_by(factor)?))
    }

    /// The samples, their step, and where they come from.
    #[must_use]
    pub fn accelerogram(&self) -> &Accelerogram {
        &self.0
    }
}

impl From<Accelerogram> for GroundMotion {
    fn from(accelerogram: Accelerogram) -> Self {
        Self(accelerogram)
    }
}
