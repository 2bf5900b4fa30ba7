//! Buildings as a library user describes them.

use std::sync::Arc;

use pounding_hysteresis::{LawParameters, build as build_law, yield_deformation};
use pounding_shear_building::{Damping, ShearBuilding, StoreyLaw};

use crate::error::Error;
use crate::units::{Length, Mass, Stiffness};

/// Acceleration of gravity that acts through P-Delta (m/s2).
const STANDARD_GRAVITY: f64 = 9.80665;

/// One storey: the floor above it, and what carries that floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Storey {
    /// Mass of the floor.
    pub mass: Mass,
    /// Lateral stiffness of the storey; of a law, that at the start.
    pub stiffness: Stiffness,
    /// Height from floor to floor.
    pub height: Length,
}

/// A building in the making: storeys from the bottom, damping, laws.
#[derive(Debug, Clone)]
pub struct Building {
    name: String,
    storeys: Vec<Storey>,
    damping: Option<Damping>,
    p_delta: bool,
    law: Option<(String, Vec<(String, f64)>)>,
}

/// Refuses parameters that are given twice.
pub(crate) fn once<'p>(of: &str, names: impl Iterator<Item = &'p str>) -> Result<(), Error> {
    let mut seen = std::collections::BTreeSet::new();
    for name in names {
        if !seen.insert(name) {
            return Err(Error::Twice {
                of: of.to_owned(),
                parameter: name.to_owned(),
            });
        }
    }
    Ok(())
}

impl Building {
    /// A shear building without storeys as yet. Whether it is damped must be said.
    #[must_use]
    pub fn shear(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            storeys: Vec::new(),
            damping: None,
            p_delta: false,
            law: None,
        }
    }

    /// Adds a storey on top.
    #[must_use]
    pub fn storey(self, storey: Storey) -> Self {
        self.storeys(1, storey)
    }

    /// Adds equal storeys on top.
    #[must_use]
    pub fn storeys(mut self, count: usize, storey: Storey) -> Self {
        self.storeys.extend(std::iter::repeat_n(storey, count));
        self
    }

    /// Damps the building.
    #[must_use]
    pub fn damping(mut self, damping: Damping) -> Self {
        self.damping = Some(damping);
        self
    }

    /// Leaves the building without damping.
    #[must_use]
    pub fn undamped(self) -> Self {
        self.damping(Damping::MassProportional { ratio: 0.0 })
    }

    /// Lets gravity act through the drifts.
    #[must_use]
    pub fn p_delta(mut self) -> Self {
        self.p_delta = true;
        self
    }

    /// Lets all storeys follow a hysteresis law, by its name and its parameters in SI units;
    /// a `stiffness` that the law has and that is not given is that of the storey.
    #[must_use]
    pub fn law<'p>(
        mut self,
        name: impl Into<String>,
        parameters: impl IntoIterator<Item = (&'p str, f64)>,
    ) -> Self {
        let parameters = parameters.into_iter().map(|(k, v)| (k.to_owned(), v));
        self.law = Some((name.into(), parameters.collect()));
        self
    }

    /// Name, as gaps call it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    pub(crate) fn build(&self) -> Result<Arc<ShearBuilding>, Error> {
        let each = |of: fn(&Storey) -> f64| self.storeys.iter().map(of).collect();
        let damping = self.damping.clone().ok_or_else(|| Error::NoDamping {
            building: self.name.clone(),
        })?;
        let gravity = if self.p_delta { STANDARD_GRAVITY } else { 0.0 };
        let building = ShearBuilding::under_gravity(
            self.name.clone(),
            each(|s| s.mass.si()),
            each(|s| s.stiffness.si()),
            each(|s| s.height.si()),
            damping,
            gravity,
        )?;
        let Some((name, parameters)) = &self.law else {
            return Ok(Arc::new(building));
        };
        let laws = self
            .storeys
            .iter()
            .map(|s| self.storey_law(s, name, parameters));
        let laws = laws.collect::<Result<Vec<_>, _>>()?;
        Ok(Arc::new(building.with_laws(laws)?))
    }

    fn storey_law(
        &self,
        storey: &Storey,
        name: &str,
        parameters: &[(String, f64)],
    ) -> Result<Option<StoreyLaw>, Error> {
        let refused = |reason| Error::Law {
            building: self.name.clone(),
            reason,
        };
        once(&self.name, parameters.iter().map(|p| p.0.as_str()))?;
        let descriptor = pounding_hysteresis::find(name).map_err(refused)?;
        let mut values = LawParameters::default();
        values.values.extend(parameters.iter().cloned());
        if descriptor.parameters.iter().any(|p| p.name == "stiffness") {
            let own = values.values.entry("stiffness".to_owned());
            own.or_insert(storey.stiffness.si());
        }
        let law = build_law(descriptor.name, &values).map_err(refused)?;
        Ok(Some(StoreyLaw {
            yield_drift: yield_deformation(&values, law.initial_stiffness()),
            law: law.into(),
        }))
    }
}
