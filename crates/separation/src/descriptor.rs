//! The descriptor of a provision: all that is known without applying it.

use pounding_catalogue::Descriptor;

use crate::assumptions::{Assumptions, Ground, HeightDatum};
use crate::edition::Edition;
use crate::inputs::Input;
pub(crate) use crate::rule::Rule;
use crate::status::Status;

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
