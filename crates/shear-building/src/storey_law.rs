//! A law in the place of a storey's stiffness.

use std::sync::Arc;

use pounding_hysteresis::HysteresisLaw;

/// A force-deformation law in the place of a storey's stiffness.
#[derive(Debug, Clone)]
pub struct StoreyLaw {
    /// The law: storey shear (N) of the drift (m).
    pub law: Arc<dyn HysteresisLaw>,
    /// Drift (m) at which the storey begins to yield, if the law has one.
    pub yield_drift: Option<f64>,
}
