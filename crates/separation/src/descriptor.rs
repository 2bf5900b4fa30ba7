//! The descriptor of a provision.

use pounding_catalogue::Descriptor;
use pounding_catalogue::wording::agreeing;

use crate::assumptions::{Assumptions, Ground, HeightDatum};
use crate::edition::Edition;
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::remedy;
use crate::status::{Reading, Status};
use crate::working::{ReadingWidth, Requirement, Working};

/// What a rule measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// From one building to the border of its own site.
    Boundary,
    /// Between two buildings.
    Between,
    /// The seat of what spans a gap: no width of the gap, and not held against it.
    Seat,
}

impl Place {
    /// A word for tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Boundary => "boundary",
            Self::Between => "between",
            Self::Seat => "seat of a bridge",
        }
    }
}

/// What a rule rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// Computed displacements.
    Displacement,
    /// What the code itself takes of structures, such as heights, kinds or isolators.
    Prescriptive,
}

impl Basis {
    /// A word for tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::Prescriptive => "prescriptive",
        }
    }
}

/// How a provision computes.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Rule {
    /// One building.
    Boundary(fn(&mut Working, &Structure, &Site) -> Result<f64, SeparationError>),
    /// One building, as before; `None` of a building that the rule does not speak of, which beside
    /// one that it speaks of adds nothing, and in words what it speaks of.
    BoundaryOfSome(
        fn(&mut Working, &Structure) -> Result<Option<f64>, SeparationError>,
        &'static str,
    ),
    /// Two buildings.
    Between(fn(&mut Working, &Situation) -> Result<f64, SeparationError>),
    /// The seat of a bridge between two buildings.
    Seat(fn(&mut Working, &Situation) -> Result<f64, SeparationError>),
}

/// Everything that is known of a provision without applying it.
#[derive(Debug, Clone, Copy)]
pub struct ProvisionDescriptor {
    /// Name: code, edition, and what it measures.
    pub name: &'static str,
    /// Code with its edition.
    pub edition: &'static Edition,
    /// Clause; empty if not known.
    pub clause: &'static str,
    /// What it rests on.
    pub basis: Basis,
    /// Where it measures heights from.
    pub height: HeightDatum,
    /// Whose ground it speaks of.
    pub ground: Ground,
    /// What the code multiplies the displacement of an elastic analysis under its reduced
    /// forces by, in its own symbols; `None` for a rule that takes displacements as an
    /// analysis gives them, or none. Such a rule does not hold for the displacement of an
    /// analysis in which the structure yields: the factor would count its ductility twice.
    pub elastic_displacement_factor: Option<&'static str>,
    /// Formula in plain characters. `u` is the unreduced peak displacement, `d` that
    /// under the reduced forces of the code, `I u / R` unless given; `h` the height of
    /// the level: of a boundary rule that of the building's own floor, of one between two
    /// buildings the higher of both floors.
    pub formula: &'static str,
    /// Inputs that it needs beside heights and storeys.
    pub inputs: &'static [Input],
    /// How far the formula has been checked.
    pub status: Status,
    /// What else a user should know.
    pub remarks: &'static [&'static str],
    /// The width of the [worked example](crate::worked_example()) by hand, in mm: an expression of
    /// numbers that the expressions of users can be.
    pub worked: &'static str,
    pub(crate) rule: Rule,
}

impl Descriptor for ProvisionDescriptor {
    const KIND: &'static str = "provision";
    const NOUN: &'static str = "provision";

    fn name(&self) -> &'static str {
        self.name
    }
}

impl ProvisionDescriptor {
    /// Whether the rule is one for isolated structures, and says nothing of others.
    #[must_use]
    pub fn is_of_isolated_structures(&self) -> bool {
        self.inputs.contains(&Input::IsolationPeriod)
    }

    /// Whether it takes displacements, and not only what is known without an analysis.
    #[must_use]
    pub fn depends_on_displacement(&self) -> bool {
        self.basis == Basis::Displacement
    }

    /// What the rule measures.
    #[must_use]
    pub fn place(&self) -> Place {
        match self.rule {
            Rule::Boundary(_) | Rule::BoundaryOfSome(..) => Place::Boundary,
            Rule::Between(_) => Place::Between,
            Rule::Seat(_) => Place::Seat,
        }
    }

    /// What it takes for granted.
    #[must_use]
    pub fn assumptions(&self) -> Assumptions {
        let displacement = match (self.basis, self.elastic_displacement_factor) {
            (Basis::Prescriptive, _) => "none is taken".to_owned(),
            (Basis::Displacement, Some(factor)) => format!(
                "that of an elastic analysis under reduced forces, times {factor}; the unreduced peak u of the run stands for it"
            ),
            (Basis::Displacement, None) => {
                "unreduced, as the analysis gives it: the peak u of the run".to_owned()
            }
        };
        let alignment = if self.inputs.contains(&Input::FloorsAligned) {
            "asks whether all floors up to the lower roof face floors"
        } else {
            "does not ask whether floors face floors"
        };
        Assumptions {
            displacement,
            height: self.height.explanation().to_owned(),
            ownership: self.ground.explanation().to_owned(),
            alignment: alignment.to_owned(),
            others: Vec::new(),
        }
    }

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
            let mut working = Working::new(self.name);
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
            let mut working = Working::new(self.name);
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
            remedy: remedy::on_isolators(self.edition),
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

/// A code that is known to speak of gaps, with no formula here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unavailable {
    /// Country or city.
    pub region: &'static str,
    /// Code with its edition.
    pub edition: &'static str,
    /// Why there is no formula.
    pub reason: &'static str,
}
