//! Gaps as a library user describes them.

use std::sync::Arc;

use pounding_catalogue::Parameters;
use pounding_gap_element::{ImpactModel, ModelParameters, SeparationRule, registry};

use crate::error::{Error, once};
use crate::facing::{Facing, Levels};
use crate::units::Length;

/// What acts between floors.
#[derive(Debug, Clone)]
enum Model {
    None,
    Named(String, Vec<(String, f64)>),
    Own(Arc<dyn ImpactModel>),
}

/// Clear widths at rest.
#[derive(Debug, Clone)]
enum Widths {
    None,
    Equal(Length),
    Each(Vec<Length>),
}

/// A gap in the making: between a building and the next one on its right, or a wall. A setting that is
/// given twice is that of [the last call](crate#what-a-second-call-does).
#[derive(Debug, Clone)]
pub struct Gap {
    pub(crate) facing: Facing,
    widths: Widths,
    model: Model,
    separation: Option<SeparationRule>,
    pub(crate) floor_to_floor: bool,
}

impl Gap {
    /// A gap between the buildings of these names, the left one first. `"wall"` is a rigid
    /// wall at an end of the row.
    #[must_use]
    pub fn between(left: impl Into<String>, right: impl Into<String>) -> Self {
        Self {
            facing: Facing::new("gap", left.into(), right.into()),
            widths: Widths::None,
            model: Model::None,
            separation: None,
            floor_to_floor: false,
        }
    }

    /// Clear width at rest, the same at all levels.
    #[must_use]
    pub fn width(mut self, width: Length) -> Self {
        self.widths = Widths::Equal(width);
        self
    }

    /// Clear width at rest of each level, bottom first, or in the order of
    /// [`levels`](Self::levels).
    #[must_use]
    pub fn widths(mut self, widths: impl IntoIterator<Item = Length>) -> Self {
        self.widths = Widths::Each(widths.into_iter().collect());
        self
    }

    /// Calls the gap otherwise than by both sides.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.facing.rename(name.into());
        self
    }

    /// The impact model by its name, with its parameters in SI units by theirs: those of
    /// `pounding models NAME`, or of its [descriptor](pounding_gap_element::registry::find).
    #[must_use]
    pub fn model<'p>(
        mut self,
        name: impl Into<String>,
        parameters: impl IntoIterator<Item = (&'p str, f64)>,
    ) -> Self {
        let parameters = parameters.into_iter().map(|(k, v)| (k.to_owned(), v));
        self.model = Model::Named(name.into(), parameters.collect());
        self
    }

    /// An impact model of one's own, as [this one](crate#an-impact-model-of-ones-own).
    #[must_use]
    pub fn impact_model(mut self, model: Arc<dyn ImpactModel>) -> Self {
        self.model = Model::Own(model);
        self
    }

    /// Lets only floors at equal elevation touch, whatever others there are.
    #[must_use]
    pub fn matching_floors_only(mut self) -> Self {
        self.facing.levels = Levels::Matching;
        self
    }

    /// How the model lets the floors part, where it is one by name that offers more than one rule.
    #[must_use]
    pub fn separation(mut self, rule: SeparationRule) -> Self {
        self.separation = Some(rule);
        self
    }

    /// Lets named floors at different elevations act on each other as if they were level, a
    /// simplification that leaves out the columns which they hit; the outcome warns of it.
    #[must_use]
    pub fn floor_to_floor(mut self) -> Self {
        self.floor_to_floor = true;
        self
    }

    /// Lets these pairs of storeys touch, left and right, numbered from 1. Beside a wall its
    /// number is not looked at.
    #[must_use]
    pub fn levels(mut self, pairs: impl IntoIterator<Item = (usize, usize)>) -> Self {
        self.facing.levels = Levels::Pairs(pairs.into_iter().collect());
        self
    }

    /// Name, by default those of both sides.
    #[must_use]
    pub fn name(&self) -> String {
        self.facing.name()
    }

    /// Widths (m) of so many levels.
    pub(crate) fn built_widths(&self, levels: usize) -> Result<Vec<f64>, Error> {
        match &self.widths {
            Widths::Equal(width) => Ok(vec![width.si(); levels]),
            Widths::Each(widths) if widths.len() == levels => {
                Ok(widths.iter().map(|w| w.si()).collect())
            }
            Widths::Each(widths) => Err(Error::Widths {
                gap: self.name(),
                widths: widths.len(),
                levels,
            }),
            Widths::None => Err(self.incomplete("width")),
        }
    }

    fn incomplete(&self, what: &'static str) -> Error {
        Error::Incomplete {
            of: self.facing.of(),
            what,
        }
    }

    pub(crate) fn built_model(&self) -> Result<Arc<dyn ImpactModel>, Error> {
        match &self.model {
            Model::Own(_) if self.separation.is_some() => {
                Err(Error::RuleBesideModel { gap: self.name() })
            }
            Model::Own(model) => Ok(Arc::clone(model)),
            Model::Named(name, parameters) => {
                once(&self.facing.of(), parameters.iter().map(|p| p.0.as_str()))?;
                let parameters = ModelParameters {
                    parameters: Parameters {
                        values: parameters.iter().cloned().collect(),
                    },
                    separation: self.separation,
                    spring: None,
                };
                let model = registry::build(name, &parameters).map_err(|reason| Error::Model {
                    gap: self.name(),
                    reason,
                })?;
                Ok(model.into())
            }
            Model::None => Err(self.incomplete("model")),
        }
    }
}
