//! Incremental dynamic analysis: what the runs of records at rising intensities say.

mod demands;
mod evaluation;
mod fragility;
mod hazard;

pub use evaluation::{
    GapResult, IdaReport, IntensityLevel, LimitResult, MinimumGap, PoundingDemand, evaluate,
};
pub use fragility::{Counts, Fragility, FragilityFit, fit};
pub use hazard::mean_annual_frequency;
