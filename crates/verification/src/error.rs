//! What keeps a published result from being computed.

use pounding_gap_element::GapElementError;
use pounding_gap_element::calibration::CalibrationError;
use pounding_gap_element::contact_stiffness::ContactStiffnessError;
use pounding_hysteresis::HysteresisError;

/// A published result that could not be computed, in the words of the crate that computes it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VerificationError {
    /// A collision.
    #[error(transparent)]
    Collision(#[from] GapElementError),
    /// A contact stiffness.
    #[error(transparent)]
    Stiffness(#[from] ContactStiffnessError),
    /// A drop test.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// A law of hysteresis.
    #[error(transparent)]
    Law(#[from] HysteresisError),
}
