//! The names of which expressions may make use.

use pounding_case::Dimension;

use super::kind::Kind;
use crate::inputs::Input;

/// What a name stands for, of a building or of the site.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    Displacement,
    BuildingHeight,
    Storeys,
    ResponseModification,
    DisplacementAmplification,
    Importance,
    YieldAmplification,
    StructuralSystem,
    IsolationPeriod,
    IsolationDampingCoefficient,
    PlanLength,
    PlanWidth,
    PlanEccentricity,
    Height,
    FloorsAligned,
    SameOwner,
    NeighbourHasGap,
    FortificationIntensity,
    SoilZone,
    DesignGroundAcceleration,
    SeismicCoefficient,
    SpectralAcceleration,
    Gravity,
}

/// The building that a name is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    /// The one building of a boundary rule; what both have in common in a rule between two.
    All,
    Left,
    Right,
}

/// A name in an expression.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Named {
    pub meaning: Meaning,
    pub of: Of,
}

/// A name of which expressions of users may make use.
#[derive(Debug, Clone, Copy)]
pub struct RuleName {
    /// The name; of what a building has, in rules between two with `_left` or `_right` after it.
    pub name: &'static str,
    /// Unit: `m`, `s`, `m/s2`, `-`, or `true or false` and the like.
    pub unit: &'static str,
    /// What it is.
    pub explanation: &'static str,
    /// Whether each building has its own.
    pub of_building: bool,
    meaning: Meaning,
}

const fn name(
    name: &'static str,
    unit: &'static str,
    of_building: bool,
    meaning: Meaning,
    explanation: &'static str,
) -> RuleName {
    RuleName {
        name,
        unit,
        explanation,
        of_building,
        meaning,
    }
}

/// Unit of what is true or false.
const TRUTH: &str = "true or false";
/// Unit of what is a word.
const WORD: &str = "a word in quotes";

/// All names, in the order in which users see them.
static NAMES: &[RuleName] = &[
    name(
        "u",
        "m",
        true,
        Meaning::Displacement,
        "unreduced peak displacement at the level",
    ),
    name(
        "height",
        "m",
        true,
        Meaning::Height,
        "elevation of the building's own floor at the level above ground",
    ),
    name(
        "building_height",
        "m",
        true,
        Meaning::BuildingHeight,
        "height of the whole building",
    ),
    name("storeys", "-", true, Meaning::Storeys, "number of storeys"),
    name(
        "R",
        "-",
        true,
        Meaning::ResponseModification,
        "`response_modification`",
    ),
    name(
        "Cd",
        "-",
        true,
        Meaning::DisplacementAmplification,
        "`displacement_amplification`",
    ),
    name("importance", "-", true, Meaning::Importance, "`importance`"),
    name(
        "yield_amplification",
        "-",
        true,
        Meaning::YieldAmplification,
        "`yield_amplification`",
    ),
    name(
        "structural_system",
        WORD,
        true,
        Meaning::StructuralSystem,
        "`structural_system`, compared with == or !=",
    ),
    name(
        "isolation_period",
        "s",
        true,
        Meaning::IsolationPeriod,
        "`isolation_period`",
    ),
    name(
        "isolation_damping_coefficient",
        "-",
        true,
        Meaning::IsolationDampingCoefficient,
        "`isolation_damping_coefficient`",
    ),
    name(
        "plan_length",
        "m",
        true,
        Meaning::PlanLength,
        "`plan_length`",
    ),
    name("plan_width", "m", true, Meaning::PlanWidth, "`plan_width`"),
    name(
        "plan_eccentricity",
        "m",
        true,
        Meaning::PlanEccentricity,
        "`plan_eccentricity`",
    ),
    name(
        "floors_aligned",
        TRUTH,
        false,
        Meaning::FloorsAligned,
        "`floors_aligned`, or found from the elevations",
    ),
    name(
        "same_owner",
        TRUTH,
        false,
        Meaning::SameOwner,
        "`same_owner`",
    ),
    name(
        "neighbour_has_gap",
        TRUTH,
        false,
        Meaning::NeighbourHasGap,
        "`neighbour_has_gap`",
    ),
    name(
        "fortification_intensity",
        "-",
        false,
        Meaning::FortificationIntensity,
        "`fortification_intensity`",
    ),
    name(
        "soil_zone",
        "-",
        false,
        Meaning::SoilZone,
        "`soil_zone` as 1, 2 or 3",
    ),
    name(
        "design_ground_acceleration",
        "m/s2",
        false,
        Meaning::DesignGroundAcceleration,
        "`design_ground_acceleration`",
    ),
    name(
        "seismic_coefficient",
        "-",
        false,
        Meaning::SeismicCoefficient,
        "`seismic_coefficient`",
    ),
    name(
        "spectral_acceleration_1s",
        "m/s2",
        false,
        Meaning::SpectralAcceleration,
        "`spectral_acceleration_1s`",
    ),
    name(
        "g",
        "m/s2",
        false,
        Meaning::Gravity,
        "standard gravity, 9.80665 m/s2",
    ),
];

/// All names of which expressions may make use.
#[must_use]
pub fn rule_names() -> &'static [RuleName] {
    NAMES
}

impl Named {
    fn row(self) -> Option<&'static RuleName> {
        NAMES.iter().find(|n| n.meaning == self.meaning)
    }

    /// As written.
    pub(super) fn name(self) -> String {
        let stem = self.row().map_or("", |n| n.name);
        match self.of {
            Of::All => stem.to_owned(),
            Of::Left => format!("{stem}_left"),
            Of::Right => format!("{stem}_right"),
        }
    }

    /// Whether each building has its own.
    pub(super) fn is_of_building(self) -> bool {
        self.row().is_some_and(|n| n.of_building)
    }

    /// Unit in which it is shown.
    pub(super) fn unit(self) -> &'static str {
        self.row().map_or("-", |n| n.unit)
    }

    pub(super) fn kind(self) -> Kind {
        match self.unit() {
            "m" => Kind::Number(Dimension::LENGTH),
            "s" => Kind::Number(Dimension::TIME),
            "m/s2" => Kind::Number(Dimension::ACCELERATION),
            TRUTH => Kind::Truth,
            WORD => Kind::Word,
            _ => Kind::Number(Dimension::NUMBER),
        }
    }

    pub(super) fn is_height(&self) -> bool {
        matches!(self.meaning, Meaning::Height | Meaning::BuildingHeight)
    }

    /// The key of the case that gives it; `None` for what every case has.
    pub(super) fn input(&self) -> Option<Input> {
        Some(match self.meaning {
            Meaning::Displacement => Input::Displacement,
            Meaning::ResponseModification => Input::ResponseModification,
            Meaning::DisplacementAmplification => Input::DisplacementAmplification,
            Meaning::Importance => Input::Importance,
            Meaning::YieldAmplification => Input::YieldAmplification,
            Meaning::StructuralSystem => Input::StructuralSystem,
            Meaning::IsolationPeriod => Input::IsolationPeriod,
            Meaning::IsolationDampingCoefficient => Input::IsolationDampingCoefficient,
            Meaning::PlanLength => Input::PlanLength,
            Meaning::PlanWidth => Input::PlanWidth,
            Meaning::PlanEccentricity => Input::PlanEccentricity,
            Meaning::FloorsAligned => Input::FloorsAligned,
            Meaning::SameOwner => Input::SameOwner,
            Meaning::NeighbourHasGap => Input::NeighbourHasGap,
            Meaning::FortificationIntensity => Input::FortificationIntensity,
            Meaning::SoilZone => Input::SoilZone,
            Meaning::DesignGroundAcceleration => Input::DesignGroundAcceleration,
            Meaning::SeismicCoefficient => Input::SeismicCoefficient,
            Meaning::SpectralAcceleration => Input::SpectralAccelerationAtOneSecond,
            Meaning::Height | Meaning::BuildingHeight | Meaning::Storeys | Meaning::Gravity => {
                return None;
            }
        })
    }
}

/// What a name stands for in a rule between two buildings, or of one; `Err` with a remedy for one
/// that has another form there.
pub(super) fn find(text: &str, between: bool) -> Result<Option<Named>, String> {
    let stems = [(Of::Left, "_left"), (Of::Right, "_right")];
    for (of, end) in stems {
        let row = text.strip_suffix(end).and_then(row_of);
        let Some(row) = row.filter(|row| row.of_building) else {
            continue;
        };
        if !between {
            return Err(format!(
                "a boundary rule knows one building: write {}",
                row.name
            ));
        }
        let meaning = row.meaning;
        return Ok(Some(Named { meaning, of }));
    }
    let Some(row) = row_of(text) else {
        return Ok(None);
    };
    if between && row.meaning == Meaning::Displacement {
        return Err("each building has its own: write u_left or u_right".to_owned());
    }
    Ok(Some(Named {
        meaning: row.meaning,
        of: Of::All,
    }))
}

fn row_of(text: &str) -> Option<&'static RuleName> {
    NAMES.iter().find(|n| n.name == text)
}

/// All names as they may be written, for suggestions.
pub(super) fn all(between: bool) -> Vec<String> {
    let mut all = Vec::new();
    for row in NAMES {
        if row.of_building && between {
            all.extend(["_left", "_right"].map(|end| format!("{}{end}", row.name)));
        }
        if !(between && row.meaning == Meaning::Displacement) {
            all.push(row.name.to_owned());
        }
    }
    all
}
