//! Incremental dynamic analysis: what the runs of records at rising intensities say.

mod bootstrap;
mod demands;
mod evaluation;
mod fragility;
mod goodness;
mod hazard;
mod report;

pub use bootstrap::{FrequencyBounds, bootstrap_sets};
pub use evaluation::evaluate;
pub use fragility::{Counts, Fragility, FragilityFit, fit};
pub use goodness::{Capacity, FitRemark, GoodnessOfFit, POOR, Sampled, ShownIntensity, Untested};
pub use hazard::mean_annual_frequency;
pub use report::{
    GapResult, IdaReport, IntensityLevel, LimitResult, MinimumGap, OpenGap, PoundingDemand,
};
