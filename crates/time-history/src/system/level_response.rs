//! Responses that belong to a contact level: what a member that is hit there bears.

use super::System;
use crate::error::TimeHistoryError;

/// A response of a contact level: a sum over coordinates of one building and the contact force.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelResponse {
    /// Name in results: lower case with underscores, such as `column_shear_below`.
    pub name: String,
    /// SI unit of the response.
    pub unit: &'static str,
    /// Building index in the row, from zero.
    pub building: usize,
    /// Numbers of its coordinates, floors first, with their weights.
    pub weights: Vec<(usize, f64)>,
    /// Factor of the contact force, which is positive in contact.
    pub by_force: f64,
    /// What the member can bear, in the same unit, where that is known.
    pub capacity: Option<f64>,
}

/// The same by degrees of freedom.
#[derive(Debug, Clone)]
pub(crate) struct LevelRow {
    pub level: usize,
    pub terms: Vec<(usize, f64)>,
    pub by_force: f64,
    pub given: LevelResponse,
}

impl System {
    /// Adds a response of a contact level, by its number in [`System::levels`].
    ///
    /// # Errors
    /// A level, building or coordinate that does not exist.
    pub fn add_level_response(
        &mut self,
        level: usize,
        given: LevelResponse,
    ) -> Result<(), TimeHistoryError> {
        let b = given.building;
        let known = self.buildings.get(b).map_or(0, |b| b.coordinates());
        let beyond = given.weights.iter().find(|(i, _)| *i >= known);
        if level >= self.levels.len() || beyond.is_some() {
            return Err(TimeHistoryError::GapDefinition {
                gap: given.name,
                reason: "a response of a level or coordinate that does not exist".to_owned(),
            });
        }
        let [floors, further] = self.parts(b);
        let dof = |i: usize| match i < floors.len() {
            true => floors.start + i,
            false => further.start + i - floors.len(),
        };
        self.level_rows.push(LevelRow {
            level,
            terms: given.weights.iter().map(|(i, w)| (dof(*i), *w)).collect(),
            by_force: given.by_force,
            given,
        });
        Ok(())
    }

    /// Responses of contact levels in the order in which they were added, each with the number
    /// of its level in [`System::levels`].
    pub fn level_responses(&self) -> impl Iterator<Item = (usize, &LevelResponse)> {
        self.level_rows.iter().map(|row| (row.level, &row.given))
    }

    /// Responses of all contact levels.
    pub(crate) fn level_rows(&self) -> &[LevelRow] {
        &self.level_rows
    }
}
