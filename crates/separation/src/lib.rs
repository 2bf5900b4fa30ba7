//! How wide a gap must be by code: provisions as a registry, and the rules
//! that combine the displacements of two buildings.
//!
//! Two questions are kept apart. A *boundary* rule says how far one building must stand
//! from the border of its own site; a *between* rule says how far two buildings must
//! stand from one another. And two kinds of answer: *displacement-based* rules need an
//! analysis, *prescriptive* ones need only heights and kinds of structure. Every
//! provision says whether its formula was seen in a text or is unverified.

mod codes;
mod combination;
mod descriptor;
mod effective_properties;
mod error;
mod inputs;
mod provisions;
mod registry;
mod suite_rule;
mod working;

pub use codes::{Cases, CodeDescriptor, CodeWidth, Ownership, Rules, Sides, codes, find_code};
pub use combination::{CombinationRule, Oscillator, correlation_coefficient};
pub use descriptor::{Basis, Place, ProvisionDescriptor, Unavailable, Verification};
pub use effective_properties::{EffectiveProperties, YieldingOscillator};
pub use error::SeparationError;
pub use inputs::{Input, Site, Situation, SoilZone, StructuralSystem, Structure};
pub use registry::{descriptors, find, unavailable};
pub use suite_rule::{Statistic, SuiteRule};
pub use working::{Factor, Requirement};
