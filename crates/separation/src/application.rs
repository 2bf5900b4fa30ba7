//! A provision, applied to structures: the width that it requires.

use pounding_catalogue::wording::agreeing;

use crate::descriptor::{Place, ProvisionDescriptor};
use crate::error::SeparationError;
use crate::inputs::{Site, Situation, Structure};
use crate::remedy::{on_isolators, where_it_does_not_apply};
use crate::rule::Rule;
use crate::status::Reading;
use crate::working::{ReadingWidth, Requirement, Working};

impl ProvisionDescriptor {
    /// Distance of one building from the border of its site (m).
    ///
    /// # Errors
    /// An input that is missing, a situation that the provision does not cover, or a
    /// rule that holds between two buildings.
    pub fn boundary(
        &self,
        structure: &Structure,
        site: &Site,
    ) -> Result<Requirement, SeparationError> {
        self.speaks_of(&[structure])?;
        let width = |rule, formula: &str| {
            let mut working = Working::new(self.name, where_it_does_not_apply);
            let width = match rule {
                Rule::Boundary(rule) => rule(&mut working, structure, site)?,
                Rule::BoundaryOfSome(rule, speaks_of) => rule(&mut working, structure)?
                    .ok_or_else(|| working.not_applicable(speaks_of))?,
                Rule::Between(_) | Rule::Seat(_) => return Err(working.needs_a_neighbour()),
            };
            working.finish(formula, (width, site), self.caution(&[structure]))
        };
        self.required(width)
    }

    /// Distance between two buildings (m). A boundary rule gives the sum of the
    /// distances that either building keeps from the border.
    ///
    /// # Errors
    /// An input that is missing, or a situation that the provision does not cover.
    pub fn between(&self, situation: &Situation) -> Result<Requirement, SeparationError> {
        self.speaks_of(&[&situation.left, &situation.right])?;
        self.required(|rule, formula| {
            let mut working = Working::new(self.name, where_it_does_not_apply);
            let caution = self.caution(&[&situation.left, &situation.right]);
            match rule {
                Rule::Between(rule) | Rule::Seat(rule) => {
                    let width = rule(&mut working, situation)?;
                    working.finish(formula, (width, &situation.site), caution)
                }
                Rule::BoundaryOfSome(rule, speaks_of) => {
                    let left = rule(&mut working, &situation.left)?;
                    let right = rule(&mut working, &situation.right)?;
                    if left.or(right).is_none() {
                        return Err(working.not_applicable(speaks_of));
                    }
                    let width = working.summed(left.unwrap_or(0.0), right.unwrap_or(0.0));
                    let formula = format!("{formula}, summed over both sides");
                    working.finish(&formula, (width, &situation.site), caution)
                }
                Rule::Boundary(rule) => {
                    let side = |working: &mut Working, structure: &Structure| {
                        rule(working, structure, &situation.site)
                    };
                    let left = side(&mut working, &situation.left)?;
                    let right = side(&mut working, &situation.right)?;
                    let width = working.summed(left, right);
                    let formula = format!("{formula}, summed over both sides");
                    working.finish(&formula, (width, &situation.site), caution)
                }
            }
        })
    }

    /// Refuses structures that cannot be, and those on isolators, of which a rule for fixed bases says nothing.
    fn speaks_of(&self, structures: &[&Structure]) -> Result<(), SeparationError> {
        possible(structures)?;
        // What spans a gap between bridges is no rule of their bases.
        if self.is_of_isolated_structures() || self.place() == Place::Seat {
            return Ok(());
        }
        let isolated = structures.iter().filter(|s| s.on_isolators);
        let isolated: Vec<&str> = isolated.map(|s| &*s.name).collect();
        if isolated.is_empty() {
            return Ok(());
        }
        Err(SeparationError::NotApplicable {
            provision: self.name.to_owned(),
            reason: format!(
                "it is a rule for buildings on fixed bases, and {} {} on isolators",
                isolated.join(" and "),
                agreeing(&isolated.len(), "stands", "stand")
            ),
            remedy: on_isolators(self.edition),
        })
    }

    /// What the rule requires; of a disputed one what each reading does, with the width of the
    /// widest.
    fn required(
        &self,
        width: impl Fn(Rule, &str) -> Result<Requirement, SeparationError>,
    ) -> Result<Requirement, SeparationError> {
        let of = |reading: &'static Reading| Ok((reading, width(reading.rule, reading.formula)?));
        let readings = self.status.readings().iter().map(of);
        let readings: Vec<_> = readings.collect::<Result<_, SeparationError>>()?;
        let Some((_, first)) = readings.first() else {
            return width(self.rule, self.formula);
        };
        let explained = readings
            .iter()
            .map(|(reading, r)| format!("{}: {}", reading.text, r.explanation));
        let explanation = explained.collect::<Vec<_>>().join("; or, by ");
        let widest = readings.iter().map(|(_, r)| r.width);
        Ok(Requirement {
            width: widest.fold(0.0, f64::max),
            factors: first.factors.clone(),
            explanation: format!("disputed, by {explanation}"),
            caution: first.caution.clone(),
            readings: readings
                .iter()
                .map(|(reading, r)| ReadingWidth {
                    text: reading.text,
                    width: r.width,
                })
                .collect(),
        })
    }

    /// Why the rule does not hold for the displacements of these structures.
    fn caution(&self, structures: &[&Structure]) -> Option<String> {
        let factor = self.elastic_displacement_factor?;
        let taken = |s: &&&Structure| s.inelastic && s.elastic_displacement.is_none();
        let names: Vec<_> = structures.iter().filter(taken).map(|s| &*s.name).collect();
        if names.is_empty() {
            return None;
        }
        Some(format!(
            "the rule is for elastic displacements, which the code multiplies by {factor}; that of {} is inelastic already, and its ductility must not be counted again",
            names.join(" and ")
        ))
    }
}

/// Refuses heights that no structure has.
fn possible(structures: &[&Structure]) -> Result<(), SeparationError> {
    for structure in structures {
        for (quantity, value) in [
            ("height", structure.height),
            ("elevation", structure.elevation),
        ] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(SeparationError::OutOfRange {
                    quantity,
                    value,
                    range: "[0, inf)",
                });
            }
        }
    }
    Ok(())
}
