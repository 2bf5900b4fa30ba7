//! Ground motions.

use std::path::{Path, PathBuf};

use pounding_ground_motion::processing::Scale;
use pounding_ground_motion::{AccelerationUnit, Accelerogram, ReadOptions, read};

use crate::error::Error;
use crate::units::{Acceleration, Time};

/// What stands in the place of the file where the samples were given by code.
const BY_CODE: &str = "samples given by code";

/// The motion of the ground that all buildings stand on.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundMotion {
    accelerogram: Accelerogram,
    /// Where it was read, which no result may replace.
    file: Option<PathBuf>,
}

impl GroundMotion {
    /// Reads a record in one of the formats that agencies publish, found from its content.
    /// [`ground_motion::read`](pounding_ground_motion::read) has options for files that do not
    /// say all; what it reads is turned into this by `into`.
    ///
    /// # Errors
    /// A file that cannot be read, with its line.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        Ok(Self {
            accelerogram: read(path.as_ref(), &ReadOptions::default())?,
            file: Some(wherever(path.as_ref().to_owned())),
        })
    }

    /// A motion of these accelerations at even steps from time zero on, linear in between. A step that no
    /// accelerograph has is among the [warnings](crate::Model::warnings) of its runs.
    ///
    /// # Errors
    /// A step that is not positive, fewer than two accelerations, or one that is not finite.
    pub fn of(
        accelerations: impl IntoIterator<Item = Acceleration>,
        step: Time,
    ) -> Result<Self, Error> {
        let samples = accelerations.into_iter().map(Acceleration::si).collect();
        let unit = AccelerationUnit::MetrePerSecondSquared;
        Ok(Accelerogram::new(samples, unit, step.si())?.into())
    }

    /// Scaled to a peak ground acceleration.
    ///
    /// # Errors
    /// A peak that is not positive, or a motion that is zero.
    pub fn scaled_to(&self, peak: Acceleration) -> Result<Self, Error> {
        let factor = Scale::PeakAcceleration(peak.si()).factor(&self.accelerogram)?;
        Ok(Self {
            accelerogram: self.accelerogram.scaled_by(factor)?,
            file: self.file.clone(),
        })
    }

    /// The samples, their step, and where they come from.
    #[must_use]
    pub fn accelerogram(&self) -> &Accelerogram {
        &self.accelerogram
    }

    pub(crate) fn file(&self) -> Option<&Path> {
        self.file.as_deref()
    }
}

/// A file under a name by which it is found when the working folder is another one.
pub(crate) fn wherever(file: PathBuf) -> PathBuf {
    std::path::absolute(&file).unwrap_or(file)
}

impl From<Accelerogram> for GroundMotion {
    fn from(accelerogram: Accelerogram) -> Self {
        match accelerogram.origin() {
            None => Self {
                accelerogram: accelerogram.of_memory(BY_CODE),
                file: None,
            },
            Some(origin) => {
                let file = PathBuf::from(&origin.file);
                Self {
                    // Of a motion in memory it is a name.
                    file: Some(file).filter(|file| file.is_file()).map(wherever),
                    accelerogram,
                }
            }
        }
    }
}
