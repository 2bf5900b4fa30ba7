//! All provisions by name.

use pounding_catalogue::suggestion;

use crate::descriptor::{ProvisionDescriptor, Unavailable};
use crate::error::SeparationError;
use crate::provisions;

/// Descriptors of all provisions.
#[must_use]
pub fn descriptors() -> &'static [&'static ProvisionDescriptor] {
    provisions::ALL
}

/// Codes that are known to speak of gaps, with no formula here.
#[must_use]
pub fn unavailable() -> &'static [Unavailable] {
    provisions::UNAVAILABLE
}

/// The provision of this name.
///
/// # Errors
/// [`SeparationError::UnknownProvision`] with the nearest known name.
pub fn find(name: &str) -> Result<&'static ProvisionDescriptor, SeparationError> {
    let all = provisions::ALL;
    all.iter().find(|p| p.name == name).copied().ok_or_else(|| {
        let part = all
            .iter()
            .find(|p| !name.is_empty() && p.name.contains(name));
        let names = all.iter().map(|p| p.name);
        let nearest = part.map(|p| p.name).or(suggestion::nearest(name, names));
        SeparationError::UnknownProvision {
            name: name.to_owned(),
            nearest: nearest.unwrap_or(""),
        }
    })
}
