//! How wide a gap must be by code: provisions as a registry, and the rules
//! that combine the displacements of two buildings.
//!
//! Two questions are kept apart. A *boundary* rule says how far one building must stand
//! from the border of its own site; a *between* rule says how far two buildings must
//! stand from one another. And two kinds of answer: *displacement-based* rules need an
//! analysis, *prescriptive* ones need only heights and kinds of structure. Every
//! provision says how far its formula was compared with a text ([`Status`]), from when to when its
//! edition is in force ([`Edition`]) and what it takes for granted ([`Assumptions`]). Users state
//! rules of their own as expressions ([`OwnRule`]); a [`Provision`] is one of either kind.

// The same bits on every machine: see clippy.toml.
#![warn(clippy::disallowed_methods)]

mod application;
mod assumptions;
mod code_width;
mod codes;
mod combination;
mod country;
mod date;
mod descriptor;
mod edition;
mod edition_choice;
mod effective_properties;
mod error;
mod inputs;
mod own;
mod ownership;
mod provision;
mod provisions;
mod registry;
mod remedy;
mod rule;
mod status;
mod suite_rule;
mod worked_example;
mod working;

pub use assumptions::{Assumptions, Ground, HeightDatum};
pub use code_width::{CodeWidth, LeastWidth, Rules, Sides};
pub use codes::{Cases, Code, CodeDescriptor, codes, find_code};
pub use combination::{CombinationRule, Oscillator, correlation_coefficient};
pub use descriptor::{Basis, Place, ProvisionDescriptor, Unavailable};
pub use edition::{Date, Edition, InForce, Validity};
pub use edition_choice::{choose_code, code_in_country};
pub use effective_properties::{EffectiveProperties, YieldingOscillator};
pub use error::SeparationError;
pub use inputs::{Input, Site, Situation, SoilZone, StructuralSystem, Structure};
pub use own::{OwnRule, RuleName, arithmetic, rule_names};
pub use ownership::Ownership;
pub use provision::Provision;
pub use registry::{descriptors, find, unavailable};
pub use status::{Reading, Status};
pub use suite_rule::{SpectrumCondition, Statistic, SuiteRule};
pub use worked_example::worked_example;
pub use working::{Factor, ReadingWidth, Requirement};

// The status of combination rules and of what codes take of many records.
pub use pounding_catalogue::Verification;
