//! What models, laws, provisions and record formats have in common, and the sentences that
//! speak of them ([`wording`], [`numbers`]). They are found by name, and a name that is not known leads to the one that was probably meant:
//!
//! ```
//! use pounding_catalogue::suggestion;
//!
//! let models = ["hertz_1882", "jankowski_2005", "stereomechanical"];
//! assert_eq!(suggestion::misspelt("jankowsky_2005", models), Some("jankowski_2005"));
//! assert_eq!(suggestion::misspelt("coulomb", models), None);
//! assert_eq!(suggestion::nearest("hertz", models), Some("hertz_1882"));
//! ```

pub mod numbers;
pub mod suggestion;
pub mod wording;
