//! What models, laws, provisions, record formats and generators have in common.
//!
//! Each of them is a [`Descriptor`]: a name, aliases and parameters that a user may give, each a
//! [`ParameterDescriptor`] with unit and range. A [`Registry`] finds them by name, and a name that
//! is not known leads to the one that was probably meant ([`suggestion`]). [`Parameters`] are
//! values by name, checked against a descriptor; what is wrong with names or values is a
//! [`DefinitionError`]. [`wording`] has what sentences of them need.
//!
//! ```
//! use pounding_catalogue::{Descriptor, ParameterDescriptor, ParameterUnit};
//! use pounding_catalogue::{Parameters, Registry, positive};
//!
//! struct Spring;
//!
//! impl Descriptor for Spring {
//!     const KIND: &'static str = "spring law";
//!     const NOUN: &'static str = "law";
//!     fn name(&self) -> &'static str {
//!         "linear"
//!     }
//!     fn parameters(&self) -> &'static [ParameterDescriptor] {
//!         const ALL: &[ParameterDescriptor] =
//!             &[positive("stiffness", ParameterUnit::NewtonPerMetre, "Stiffness")];
//!         ALL
//!     }
//! }
//!
//! static SPRINGS: Registry<Spring> = Registry::new(&[&Spring], &[(&["hooke"], "linear")]);
//! assert_eq!(
//!     SPRINGS.find("hooke").map(|s| s.name()).map_err(|e| (e.to_string(), e.help())),
//!     Err(("unknown spring law \"hooke\"".into(), "did you mean \"linear\"?".into()))
//! );
//! let spring = SPRINGS.find("linear")?;
//! let parameters = Parameters::from_pairs(&[("stiffness", -1.0)]);
//! let error = parameters.check(spring).unwrap_err();
//! assert_eq!(error.to_string(), "law linear: stiffness = -1 is outside (0, inf)");
//! # Ok::<(), pounding_catalogue::DefinitionError>(())
//! ```

// The same bits on every machine: see clippy.toml.
#![warn(clippy::disallowed_methods)]

/// Standard gravity (m/s2): the third General Conference on Weights and Measures (1901).
pub const STANDARD_GRAVITY: f64 = 9.806_65;
/// Step (s) of recorded responses where none is asked for.
pub const OUTPUT_STEP: f64 = 0.01;

pub mod numbers;
pub mod suggestion;
pub mod wording;

mod descriptor;
mod error;
mod parameters;
mod registry;

pub use descriptor::{
    Alias, Descriptor, ParameterDescriptor, ParameterUnit, Verification, non_negative,
    optional_non_negative, optional_positive, positive,
};
pub use error::DefinitionError;
pub use parameters::Parameters;
pub use registry::Registry;
