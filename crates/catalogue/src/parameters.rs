//! Parameters as a user gives them.

use std::collections::BTreeMap;

use crate::descriptor::Descriptor;
use crate::error::DefinitionError;

/// Values (SI) by name.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Parameters {
    /// Values in SI units.
    pub values: BTreeMap<String, f64>,
}

impl Parameters {
    /// Parameters from pairs of name and SI value.
    #[must_use]
    pub fn from_pairs(pairs: &[(&str, f64)]) -> Self {
        Self {
            values: pairs.iter().map(|(k, v)| ((*k).to_owned(), *v)).collect(),
        }
    }

    /// The same with one parameter more, or another value of it.
    #[must_use]
    pub fn with(mut self, name: &str, value: f64) -> Self {
        self.values.insert(name.to_owned(), value);
        self
    }

    /// The value given.
    #[must_use]
    pub fn given(&self, name: &str) -> Option<f64> {
        self.values.get(name).copied()
    }

    /// The value given, or the default of what takes it.
    ///
    /// # Errors
    /// [`DefinitionError::MissingParameter`] where there is neither.
    pub fn get<D: Descriptor>(&self, of: &D, name: &str) -> Result<f64, DefinitionError> {
        self.given(name)
            .or_else(|| of.default_of(name))
            .ok_or_else(|| of.missing(name))
    }

    /// Refuses unknown, missing and out-of-range parameters.
    ///
    /// # Errors
    /// The first parameter that is not known, not allowed, or missing.
    pub fn check<D: Descriptor>(&self, of: &D) -> Result<(), DefinitionError> {
        for (name, value) in &self.values {
            of.check_value(name, *value)?;
        }
        for parameter in of.parameters().iter().filter(|p| p.required) {
            self.get(of, parameter.name)?;
        }
        Ok(())
    }
}
