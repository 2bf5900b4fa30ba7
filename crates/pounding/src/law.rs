//! Hysteresis laws by name, for storeys and links.

use pounding_hysteresis::{LawParameters, build, yield_deformation};
use pounding_shear_building::StoreyLaw;

use crate::error::{Error, once};

/// A law with its parameters in SI units by their names.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Law {
    name: String,
    parameters: Vec<(String, f64)>,
}

impl Law {
    pub(crate) fn new<'p>(
        name: impl Into<String>,
        parameters: impl IntoIterator<Item = (&'p str, f64)>,
    ) -> Self {
        let parameters = parameters.into_iter().map(|(k, v)| (k.to_owned(), v));
        Self {
            name: name.into(),
            parameters: parameters.collect(),
        }
    }

    /// Builds the law of what `of` names. `stiffness` (N/m) is that of a storey, which a law
    /// takes that has one and is given none.
    pub(crate) fn build(&self, of: &str, stiffness: Option<f64>) -> Result<StoreyLaw, Error> {
        let refused = |reason| Error::Law {
            of: of.to_owned(),
            reason,
        };
        once(of, self.parameters.iter().map(|p| p.0.as_str()))?;
        let descriptor = pounding_hysteresis::find(&self.name).map_err(refused)?;
        let mut values = LawParameters::default();
        values.values.extend(self.parameters.iter().cloned());
        let has_stiffness = descriptor.parameters.iter().any(|p| p.name == "stiffness");
        if let (Some(stiffness), true) = (stiffness, has_stiffness) {
            let own = values.values.entry("stiffness".to_owned());
            own.or_insert(stiffness);
        }
        let law = build(descriptor.name, &values).map_err(refused)?;
        Ok(StoreyLaw {
            yield_drift: yield_deformation(descriptor, &values, law.initial_stiffness()),
            law: law.into(),
        })
    }
}
