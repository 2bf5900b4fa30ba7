//! Requested against achieved restitution: what a model is worth, in a table.

use crate::collision::{Bodies, CollisionOptions, CollisionOutcome, collide_with};
use crate::descriptor::ModelDescriptor;
use crate::error::GapElementError;
use crate::parameters::ModelParameters;

/// The restitutions of the tables in the literature: 0.1, 0.2, ... 1.0.
pub const REQUESTED: [f64; 10] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// Mean of `100 |achieved - requested| / requested` (%) over the requested
/// restitutions of [`REQUESTED`] from `minimum` to `maximum`.
#[must_use]
pub fn mean_error_percent(achieved: &[f64], minimum: f64, maximum: f64) -> f64 {
    let errors: Vec<f64> = REQUESTED
        .iter()
        .zip(achieved)
        .filter(|(e, _)| **e > minimum - 1e-9 && **e < maximum + 1e-9)
        .map(|(e, achieved)| 100.0 * (achieved - e).abs() / e)
        .collect();
    errors.iter().sum::<f64>() / errors.len() as f64
}

/// One line of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct RestitutionRow {
    /// Restitution asked for (-).
    pub requested: f64,
    /// The collision that came of it.
    pub outcome: CollisionOutcome,
}

impl RestitutionRow {
    /// `100 |achieved - requested| / requested` (%).
    #[must_use]
    pub fn error_percent(&self) -> f64 {
        100.0 * (self.outcome.restitution - self.requested).abs() / self.requested
    }
}

/// Collisions of one model over [`REQUESTED`].
#[derive(Debug, Clone)]
pub struct RestitutionTable {
    /// The model's descriptor.
    pub descriptor: &'static ModelDescriptor,
    /// One row for each requested restitution.
    pub rows: Vec<RestitutionRow>,
}

impl RestitutionTable {
    /// [`mean_error_percent`] over the rows from `minimum` to
    /// `maximum` requested restitution (%). The literature quotes 0.1 to 1.0, and
    /// 0.5 to 0.8 where building materials are (Papi and Toopchi-Nezhad 2022).
    #[must_use]
    pub fn mean_error_percent(&self, minimum: f64, maximum: f64) -> f64 {
        let achieved = self.rows.iter().map(|row| row.outcome.restitution);
        mean_error_percent(&achieved.collect::<Vec<_>>(), minimum, maximum)
    }

    /// The two mean errors that the literature quotes (%): from 0.1 to 1.0, and from 0.5 to 0.8
    /// requested restitution.
    #[must_use]
    pub fn mean_errors_percent(&self) -> [f64; 2] {
        [(0.1, 1.0), (0.5, 0.8)].map(|(from, to)| self.mean_error_percent(from, to))
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for RestitutionRow {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let mut object = serializer.serialize_struct("RestitutionRow", 6)?;
        object.serialize_field("requested", &self.requested)?;
        object.serialize_field("achieved", &self.outcome.restitution)?;
        object.serialize_field("error_percent", &self.error_percent())?;
        object.serialize_field("peak_force", &self.outcome.peak_force)?;
        object.serialize_field("duration", &self.outcome.shown_duration())?;
        object.serialize_field("stays_in_contact", &self.outcome.stays_in_contact)?;
        object.end()
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for RestitutionTable {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let [all, middle] = self.mean_errors_percent();
        let mut object = serializer.serialize_struct("RestitutionTable", 3)?;
        object.serialize_field("rows", &self.rows)?;
        object.serialize_field("mean_error_percent", &all)?;
        object.serialize_field("mean_error_percent_0.5_0.8", &middle)?;
        object.end()
    }
}

/// Runs one model over [`REQUESTED`] with otherwise the same parameters.
///
/// # Errors
/// A model that takes no restitution, wrong parameters, or a collision that fails.
pub fn restitution_table(
    descriptor: &'static ModelDescriptor,
    parameters: &ModelParameters,
    bodies: &Bodies,
    options: &CollisionOptions,
) -> Result<RestitutionTable, GapElementError> {
    let rows = REQUESTED
        .iter()
        .map(|&requested| {
            let mut parameters = parameters.clone();
            parameters
                .values
                .insert("restitution".to_owned(), requested);
            let model = crate::registry::build(descriptor.name, &parameters)?;
            let outcome = collide_with(model.as_ref(), bodies, options)?;
            Ok(RestitutionRow { requested, outcome })
        })
        .collect::<Result<_, GapElementError>>()?;
    Ok(RestitutionTable { descriptor, rows })
}
