//! The verification ladder of `pounding`: see the integration tests beside this file.
