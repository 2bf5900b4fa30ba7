//! Links as a library user describes them.

use pounding_time_history::{Floor, LinkedPair};

use crate::error::Error;
use crate::facing::{Facing, Levels};
use crate::law::Law;

/// A link in the making: joints, dampers or bumpers between floors of a building and of the
/// next one on its right, or a wall, that follow a law. A setting that is given twice is that of
/// [the last call](crate#what-a-second-call-does).
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    pub(crate) facing: Facing,
    law: Option<Law>,
}

impl Link {
    /// A link between the buildings of these names, the left one first, at all levels.
    /// `"wall"` is a rigid wall at an end of the row.
    #[must_use]
    pub fn between(left: impl Into<String>, right: impl Into<String>) -> Self {
        Self {
            facing: Facing::new("link", left.into(), right.into()),
            law: None,
        }
    }

    /// The law of each level by its name, with its parameters in SI units by theirs: those of
    /// `pounding hysteresis NAME`, or of its [descriptor](pounding_hysteresis::find). Its
    /// deformation is the displacement of the right floor less that of the left one.
    #[must_use]
    pub fn law<'p>(
        mut self,
        name: impl Into<String>,
        parameters: impl IntoIterator<Item = (&'p str, f64)>,
    ) -> Self {
        self.law = Some(Law::new(name, parameters));
        self
    }

    /// Joins only floors at equal elevation, whatever others there are.
    #[must_use]
    pub fn matching_floors_only(mut self) -> Self {
        self.facing.levels = Levels::Matching;
        self
    }

    /// Joins these pairs of storeys, left and right, numbered from 1. Beside a wall its number
    /// is not looked at.
    #[must_use]
    pub fn levels(mut self, pairs: impl IntoIterator<Item = (usize, usize)>) -> Self {
        self.facing.levels = Levels::Pairs(pairs.into_iter().collect());
        self
    }

    /// Calls the link otherwise than by both sides.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.facing.rename(name.into());
        self
    }

    /// Name, by default those of both sides.
    #[must_use]
    pub fn name(&self) -> String {
        self.facing.name()
    }

    pub(crate) fn build(&self, pairs: Vec<(Floor, Floor)>) -> Result<Vec<LinkedPair>, Error> {
        let of = self.facing.of();
        let law = self.law.as_ref().ok_or_else(|| Error::Incomplete {
            of: of.clone(),
            what: "law",
        })?;
        let linked = |(left, right)| {
            let law = law.build(&of, None)?;
            Ok(LinkedPair {
                left,
                right,
                law: law.law,
                yield_deformation: law.yield_drift,
            })
        };
        pairs.into_iter().map(linked).collect()
    }
}
