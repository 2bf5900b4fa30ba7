//! Iwan's parallel-series model of sliders with a truncated power density: closed forms, and fits to
//! what was measured.

mod density;
mod fall;
mod fit;
mod measured_curve;

pub use density::{IwanDensity, dimensionless_dissipation};
pub use fall::Fall;
pub use fit::{
    DensityFit, FitDoubt, FitOptions, HeldParameters, density_of_backbone, fit_backbone,
    fit_dissipation, fit_from_many, unknowns_of_fit,
};
pub use measured_curve::MeasuredCurve;
