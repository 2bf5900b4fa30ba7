//! Many runs of one case: is the gap wide enough, does the answer hang on the
//! impact model, and how likely is pounding?

pub mod comparison;
pub mod gap_check;
