//! The answer of a run as one object for machines, by `serde`: SI units, full precision.

use pounding_gap_element::Verification;
use serde::Serialize;

use crate::outcome::{
    FrameOutcome, IsolatorOutcome, Ledger, LevelOutcome, LinkLevelOutcome, NamedPeak, Outcome,
    Statistics, StoreyPeaks, YieldingStorey,
};
use crate::peak::Peak;
use crate::system::{FloorForce, LevelPlace, LinkedMotion, System};

/// A run beside that of the same buildings without gaps: what `pounding run --json` prints.
///
/// Numbers that are none (NaN) are written as `null`.
#[derive(Debug, Clone, Serialize)]
pub struct Summary<'a> {
    status: &'static str,
    method: &'static str,
    end_time: f64,
    buildings: Vec<Building<'a>>,
    gaps: Vec<Gap<'a>>,
    links: Vec<Link<'a>>,
    energy: Ledger,
    statistics: Statistics,
    warnings: &'a [String],
    /// What moves and pushes the buildings beside the first ground motion.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    further_excitation: Vec<String>,
}

#[derive(Debug, Clone, Serialize)]
struct Building<'a> {
    name: &'a str,
    elevation: &'a [f64],
    storeys: &'a [StoreyPeaks],
    #[serde(skip_serializing_if = "Option::is_none")]
    base_moment: Option<Peak>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    responses: &'a [NamedPeak],
    yielding: &'a [Option<YieldingStorey>],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    frames: &'a [FrameOutcome],
    #[serde(skip_serializing_if = "Option::is_none")]
    isolator: Option<IsolatorOutcome>,
    /// Time (s) by which the ground moves later than the first motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    ground_delay: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    forces: Vec<Force<'a>>,
    isolated: &'a [StoreyPeaks],
    #[serde(skip_serializing_if = "Option::is_none")]
    isolated_base_moment: Option<Peak>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    isolated_responses: &'a [NamedPeak],
}

/// A force on a floor.
#[derive(Debug, Clone, Serialize)]
struct Force<'a> {
    storey: usize,
    origin: &'a str,
    #[serde(flatten)]
    peak: Peak,
}

#[derive(Debug, Clone, Serialize)]
struct Gap<'a> {
    name: &'a str,
    model: Option<&'static str>,
    from_secondary_sources: bool,
    between: &'a [String; 2],
    levels: Vec<Level<'a>>,
}

#[derive(Debug, Clone, Serialize)]
struct Level<'a> {
    #[serde(flatten)]
    outcome: &'a LevelOutcome,
    #[serde(flatten)]
    place: LevelPlace,
    width: f64,
}

#[derive(Debug, Clone, Serialize)]
struct Link<'a> {
    name: &'a str,
    law: &'static str,
    joins: &'static str,
    levels: Vec<LinkLevel<'a>>,
}

#[derive(Debug, Clone, Serialize)]
struct LinkLevel<'a> {
    #[serde(flatten)]
    outcome: &'a LinkLevelOutcome,
    #[serde(flatten)]
    place: LevelPlace,
}

impl<'a> Summary<'a> {
    /// Of a run of a system, of the run of [`System::isolated`], and of what the user should
    /// know.
    #[must_use]
    pub fn of(
        system: &'a System,
        (outcome, isolated): (&'a Outcome, &'a Outcome),
        warnings: &'a [String],
    ) -> Self {
        let force = |f: &'a FloorForce| Force {
            storey: f.storey + 1,
            origin: &f.origin,
            peak: f.history.peak(),
        };
        let buildings = outcome.buildings.iter().zip(&isolated.buildings);
        let buildings = buildings.zip(system.buildings()).enumerate();
        let buildings = buildings.map(|(index, ((with, without), building))| Building {
            ground_delay: system.motions_under(index)[0].map(|m| m.delay),
            forces: (system.forces().iter())
                .filter(|f| f.building == index)
                .map(force)
                .collect(),
            name: &with.name,
            elevation: building.elevations(),
            storeys: &with.storeys,
            base_moment: with.base_moment,
            responses: &with.responses,
            yielding: &with.yielding,
            frames: &with.frames,
            isolator: with.isolator,
            isolated: &without.storeys,
            isolated_base_moment: without.base_moment,
            isolated_responses: &without.responses,
        });
        let gaps = outcome.gaps.iter().zip(system.gaps()).map(|(gap, place)| {
            let levels = system.levels_of(place);
            let descriptor = levels.first().map(|l| l.model.descriptor());
            let secondary = descriptor
                .is_some_and(|d| matches!(d.verification, Verification::SecondarySources(_)));
            let levels = gap.levels.iter().zip(levels).map(|(outcome, level)| Level {
                outcome,
                place: level.place,
                width: level.width,
            });
            Gap {
                name: &gap.name,
                model: descriptor.map(|d| d.name),
                from_secondary_sources: secondary,
                between: &place.between,
                levels: levels.collect(),
            }
        });
        let links = outcome.links.iter().enumerate().map(|(index, link)| {
            let places = system.link_levels(index);
            let levels = link.levels.iter().zip(places);
            Link {
                name: &link.name,
                law: link.law,
                joins: match system.links()[index].joins {
                    LinkedMotion::Floors => "floors",
                    LinkedMotion::FoundationSway => "foundation_sway",
                    LinkedMotion::FoundationRotation => "foundation_rotation",
                },
                levels: levels
                    .map(|(outcome, place)| LinkLevel { outcome, place })
                    .collect(),
            }
        });
        Self {
            status: "complete",
            further_excitation: system.further_excitation(),
            method: outcome.method.name,
            end_time: outcome.end_time,
            buildings: buildings.collect(),
            gaps: gaps.collect(),
            links: links.collect(),
            energy: outcome.energy,
            statistics: outcome.statistics,
            warnings,
        }
    }
}
