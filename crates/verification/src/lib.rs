//! Published results beside ours: layer 4, what `pounding verify` prints.
//!
//! Each source of published results is a [`Part`]: tables of comparisons, a [`Verdict`] a line,
//! and what does and what does not reproduce, in words. Every line says how it is claimed to come
//! out, so that a change for the worse shows ([`holds`]).
//!
//! ```
//! use pounding_verification::{Verdict, borovin_2014, holds};
//!
//! let part = borovin_2014()?;
//! assert!(holds(&[part.clone()]));
//! let constants = &part.comparisons[0];
//! assert!(constants.lines.iter().all(|line| line.verdict == Verdict::Reproduced));
//! # Ok::<(), pounding_verification::VerificationError>(())
//! ```

mod borovin_2014;
mod comparison;
mod error;
mod iwan;
mod papi_toopchi_2022;
mod restitution;
mod structures;
mod zhou_2012;

pub use borovin_2014::borovin_2014;
pub use comparison::{Cell, Comparison, Line, Part, Report, Value, Verdict, holds};
pub use error::{EnteredError, VerificationError};
pub use iwan::iwan;
pub use papi_toopchi_2022::papi_toopchi_2022;
pub use restitution::restitution;
pub use structures::{Entered, Structures, TEMPLATE};
pub use zhou_2012::zhou_2012;
