//! A multiple of the storey stiffness.

use super::{ContactStiffness, ContactStiffnessError, positive};
use crate::descriptor::Verification;

/// Customary factor of [`multiple`] (Anagnostopoulos 1988).
pub const CUSTOMARY_MULTIPLE: f64 = 20.0;
/// Minimum and maximum factor of [`multiple`] in use.
pub const MULTIPLES_IN_USE: (f64, f64) = (10.0, 100.0);

/// A multiple of the lateral storey stiffness (N/m) of the stiffer building
/// (Anagnostopoulos 1988: about 20 times), in N/m.
///
/// # Errors
/// Quantities that are not positive.
pub fn multiple(
    factor: f64,
    storey_stiffness: f64,
) -> Result<ContactStiffness, ContactStiffnessError> {
    if !(factor.is_finite() && factor > 0.0) {
        return Err(ContactStiffnessError::OutOfRange {
            quantity: "factor",
            value: factor,
            range: "(0, inf)",
        });
    }
    positive("storey stiffness", storey_stiffness, "N/m")?;
    let (minimum, maximum) = MULTIPLES_IN_USE;
    let mut warnings = Vec::new();
    if !(minimum..=maximum).contains(&factor) {
        warnings.push(format!(
            "a factor of {factor} is outside the range in use, {minimum} to {maximum}"
        ));
    }
    ContactStiffness {
        value: factor * storey_stiffness,
        exponent: 1.0,
        source: "About 20 times the lateral stiffness of the stiffer building: Anagnostopoulos, EESD 16 (1988) 443",
        status: Verification::SecondarySources("rule of thumb, not checked against the paper"),
        intermediate: Vec::new(),
        warnings,
    }
    .checked()
}
