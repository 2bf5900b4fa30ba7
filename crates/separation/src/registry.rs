//! All provisions by name.

use pounding_catalogue::Registry;

use crate::descriptor::{ProvisionDescriptor, Unavailable};
use crate::error::SeparationError;
use crate::provisions;

static PROVISIONS: Registry<ProvisionDescriptor> = Registry::new(provisions::ALL, &[]);

/// Descriptors of all provisions.
#[must_use]
pub fn descriptors() -> &'static [&'static ProvisionDescriptor] {
    PROVISIONS.all()
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
    Ok(PROVISIONS.find(name)?)
}
