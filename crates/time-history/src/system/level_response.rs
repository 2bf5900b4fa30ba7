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
    /// Whether negative values do not count in the peak.
    pub one_sided: bool,
    pub given: LevelResponse,
}

/// A further response of a level that follows from the level itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LevelMotion {
    /// How far floors move apart beyond the width at rest (m): the seat that a deck needs.
    Opening,
    /// Displacement of the ground at the left side less that at the right one (m).
    RelativeGroundDisplacement,
}

impl LevelMotion {
    /// Name in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Opening => "opening",
            Self::RelativeGroundDisplacement => "relative_ground_displacement",
        }
    }
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
            one_sided: false,
            given,
        });
        Ok(())
    }

    /// Adds a motion of a contact level to its responses, by its number in [`System::levels`].
    ///
    /// # Errors
    /// A level that does not exist.
    pub fn add_level_motion(
        &mut self,
        level: usize,
        motion: LevelMotion,
    ) -> Result<(), TimeHistoryError> {
        let Some(own) = self.levels.get(level) else {
            return Err(TimeHistoryError::GapDefinition {
                gap: motion.name().to_owned(),
                reason: format!("there is no contact level {level}"),
            });
        };
        let ends = [(own.left, 1.0), (own.right, -1.0)].into_iter();
        let ends = ends.filter_map(|(i, w)| i.map(|i| (i, w)));
        let pushed = ends.chain(own.terms.pushed.iter().copied());
        let ground = own.terms.ground.iter().copied();
        let terms = match motion {
            LevelMotion::Opening => pushed.chain(ground).map(|(i, w)| (i, -w)).collect(),
            LevelMotion::RelativeGroundDisplacement => ground.collect(),
        };
        self.level_rows.push(LevelRow {
            level,
            terms,
            by_force: 0.0,
            one_sided: motion == LevelMotion::Opening,
            given: LevelResponse {
                name: motion.name().to_owned(),
                unit: "m",
                building: 0,
                weights: Vec::new(),
                by_force: 0.0,
                capacity: None,
            },
        });
        Ok(())
    }

    /// Gives the last gap a seat of this width (m): the opening of its levels is a response, and
    /// one beyond the seat a warning.
    ///
    /// # Errors
    /// No gap, or a width that is not positive and finite.
    pub fn seat(&mut self, width: f64) -> Result<(), TimeHistoryError> {
        let sound = width.is_finite() && width > 0.0;
        let Some(gap) = self.gaps.last_mut().filter(|_| sound) else {
            return Err(TimeHistoryError::GapDefinition {
                gap: self
                    .gaps
                    .last()
                    .map_or_else(String::new, |g| g.name.clone()),
                reason: format!("a seat of {width} m"),
            });
        };
        gap.seat = Some(width);
        let levels = gap.first_level..gap.first_level + gap.levels;
        for level in levels {
            self.add_level_motion(level, LevelMotion::Opening)?;
        }
        Ok(())
    }

    /// Takes over the responses of the levels of a system with the same buildings and levels.
    ///
    /// # Errors
    /// As [`System::add_level_response`].
    pub fn take_level_responses(&mut self, from: &Self) -> Result<(), TimeHistoryError> {
        for (gap, other) in self.gaps.iter_mut().zip(&from.gaps) {
            gap.seat = other.seat;
        }
        for row in &from.level_rows {
            let all = [
                LevelMotion::Opening,
                LevelMotion::RelativeGroundDisplacement,
            ];
            match all.into_iter().find(|m| m.name() == row.given.name) {
                Some(motion) => self.add_level_motion(row.level, motion)?,
                None => self.add_level_response(row.level, row.given.clone())?,
            }
        }
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
