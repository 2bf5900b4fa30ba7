//! Engineering demands out of the rows of a result.

use std::ops::Range;

use pounding_case::{Building, Case, Side};
use pounding_results::study::ISOLATED_DEMAND;

use crate::runs::{Axis, LEVEL_QUANTITIES, Layout, Place};
use crate::study_file::{DemandKind, Limit};

/// The demand that asks the buildings without gaps.
pub(super) const ISOLATED: &str = ISOLATED_DEMAND.name;
/// The demand that counts.
pub(super) const IMPACTS: &str = "impacts";

/// Columns over which the maximum value is taken.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Demand {
    /// What it is, with its place.
    pub name: String,
    /// Unit, SI.
    pub unit: &'static str,
    columns: Vec<usize>,
    /// Whether it is one of the buildings without gaps, which a collapse in contact leaves
    /// as it is.
    isolated: bool,
    /// Whether its magnitude counts.
    signed: bool,
    needs: Needs,
}

/// What a demand needs to be defined where impacts are rigid, jumps of the velocity.
#[derive(Debug, Clone, PartialEq)]
enum Needs {
    /// Nothing.
    Nothing,
    /// Its own values: a jump has no contact force.
    Itself,
    /// No jump of a building of its own: columns of impacts and of forces at its levels.
    NoJump(Vec<(usize, usize)>),
    /// A place that has it, as a level with columns that are hit or a storey with a yield force.
    Place,
}

/// What a demand lacks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Lack {
    /// A contact force.
    Force,
    /// The accelerations during rigid impacts.
    Acceleration,
    /// Levels or storeys of its kind.
    Place,
}

/// The quantity that rigid impacts do not have.
const FORCE: &str = "peak_force";
const DRIFT_RATIO: &str = "peak_drift_ratio";
/// Those of storeys, which isolators are not.
const DRIFTS: [&str; 3] = [DRIFT_RATIO, DUCTILITY, RESIDUAL];
const DUCTILITY: &str = "peak_ductility";
const RESIDUAL: &str = "residual_drift_ratio";
/// Those of which rigid impacts are left out.
const ACCELERATION: &str = "peak_acceleration_absolute";
const ACCELERATION_ACROSS: &str = "peak_acceleration_across";

impl Demand {
    /// Maximum value in a row, or magnitude of what has a sign; missing values, such as the time of a contact that did
    /// not happen, count as none.
    fn of(&self, values: &[f64]) -> f64 {
        let value = |column: &usize| match self.signed {
            true => values[*column].abs(),
            false => values[*column],
        };
        self.columns.iter().map(value).fold(0.0, f64::max)
    }

    /// Whether the demand of a run is not defined, and for want of what.
    pub(super) fn lacks(&self, values: &[f64]) -> Option<Lack> {
        match &self.needs {
            Needs::Nothing => None,
            Needs::Itself => {
                let missing = self.columns.iter().any(|c| values[*c].is_nan());
                missing.then_some(Lack::Force)
            }
            Needs::NoJump(levels) => {
                let jump = |&(impacts, force): &(usize, usize)| {
                    values[impacts] > 0.0 && values[force].is_nan()
                };
                levels.iter().any(jump).then_some(Lack::Acceleration)
            }
            Needs::Place => {
                let nowhere = self.columns.iter().all(|c| values[*c].is_nan());
                nowhere.then_some(Lack::Place)
            }
        }
    }

    /// The same for a run that may have collapsed: then it is above everything.
    pub(super) fn of_run(&self, values: &[f64], collapsed: bool) -> f64 {
        if collapsed && !self.isolated {
            return f64::INFINITY;
        }
        self.of(values)
    }
}

/// What accelerations need: no rigid impact at the gaps of the building, or of any without one.
fn no_jump(layout: &Layout, gaps: &[(String, Vec<String>)], building: Option<&str>) -> Needs {
    let beside = |gap: &str| {
        let mut gaps = gaps.iter().filter(|(name, _)| name == gap);
        gaps.any(|(_, sides)| building.is_none_or(|b| sides.iter().any(|side| side == b)))
    };
    let levels = layout.range(IMPACTS).zip(layout.range(FORCE));
    let levels = levels.zip(&layout.levels);
    let levels = levels.filter(|(_, level)| beside(&level.of));
    Needs::NoJump(levels.map(|(columns, _)| columns).collect())
}

/// Names of the gaps of a case, and of the buildings beside each.
pub(super) fn sides_of_gaps(case: &Case) -> Vec<(String, Vec<String>)> {
    let sides = |gap: &pounding_case::Gap| {
        let names = gap.between.iter().filter_map(|side| match side {
            Side::Building(b) => Some(case.buildings[*b].name.value.clone()),
            Side::Wall => None,
        });
        names.collect()
    };
    let gaps = case.gaps.iter();
    gaps.map(|gap| (gap.name.clone(), sides(gap))).collect()
}

/// Names of the buildings of a case on isolators.
pub(super) fn isolated_buildings(case: &Case) -> Vec<String> {
    let isolated = case.buildings.iter().filter(|b| b.isolator.is_some());
    isolated.map(|b| b.name.value.clone()).collect()
}

/// Names of the buildings of a case with storeys or frames that have a law, isolators apart.
pub(super) fn yielding_buildings(case: &Case) -> Vec<String> {
    let yields = |b: &&Building| b.all_laws().next().is_some();
    let yielding = case.buildings.iter().filter(yields);
    yielding.map(|b| b.name.value.clone()).collect()
}

/// Whether drifts are those of a storey and not of isolators, whose displacement over their height says nothing.
fn drifts(storey: &Place, isolated: &[String]) -> bool {
    storey.storeys[0] != 1 || !isolated.contains(&storey.of)
}

/// Demands of every building and every gap, the worst storey or level of each.
pub(super) fn usual(
    layout: &Layout,
    gaps: &[(String, Vec<String>)],
    [isolated, yielding]: [&[String]; 2],
) -> Vec<Demand> {
    let mut demands = Vec::new();
    let groups = |places: &[Place]| {
        let mut names: Vec<String> = Vec::new();
        for place in places {
            if !names.contains(&place.of) {
                names.push(place.of.clone());
            }
        }
        names
    };
    for building in groups(&layout.storeys) {
        let mine = |column: usize| layout.storeys[column].of == building;
        let all = [
            (DRIFT_RATIO, "1"),
            (ACCELERATION, "m s-2"),
            (DUCTILITY, "1"),
            (RESIDUAL, "1"),
        ];
        for (name, unit) in all {
            let of_laws = [DUCTILITY, RESIDUAL].contains(&name);
            if of_laws && (layout.range(name).is_empty() || !yielding.contains(&building)) {
                continue;
            }
            let own = |column: usize| {
                let drift = !DRIFTS.contains(&name) || drifts(&layout.storeys[column], isolated);
                mine(column) && drift
            };
            demands.push(Demand {
                name: format!("{name}: {building}"),
                unit,
                columns: chosen(layout.range(name), own),
                isolated: false,
                signed: name == RESIDUAL,
                needs: match name {
                    ACCELERATION => no_jump(layout, gaps, Some(&building)),
                    DUCTILITY => Needs::Place,
                    _ => Needs::Nothing,
                },
            });
        }
    }
    for gap in groups(&layout.levels) {
        let mine = |column: usize| layout.levels[column].of == gap;
        for (name, unit) in [
            (ISOLATED, "m"),
            (FORCE, "N"),
            ("peak_column_shear", "N"),
            ("peak_opening", "m"),
            ("impulse_max", "N s"),
            (IMPACTS, "1"),
        ] {
            // Not all studies have columns that are hit, or joints with a seat.
            if layout.range(name).is_empty() {
                continue;
            }
            // A maximum, as all are, which the word alone would have for a sum.
            let title = if name == IMPACTS {
                "impacts at one level"
            } else {
                name
            };
            demands.push(Demand {
                name: format!("{title}: {gap}"),
                unit,
                columns: chosen(layout.range(name), mine),
                isolated: name == ISOLATED,
                signed: false,
                needs: match name {
                    FORCE => Needs::Itself,
                    _ if LEVEL_QUANTITIES.iter().any(|q| q.peak.name == name) => Needs::Place,
                    _ => Needs::Nothing,
                },
            });
        }
    }
    for link in groups(&layout.link_levels) {
        let mine = |column: usize| layout.link_levels[column].of == link;
        for (name, unit) in [("peak_link_force", "N"), ("peak_link_deformation", "m")] {
            demands.push(Demand {
                name: format!("{name}: {link}"),
                unit,
                columns: chosen(layout.range(name), mine),
                isolated: false,
                signed: false,
                needs: Needs::Place,
            });
        }
    }
    demands
}

fn chosen(range: Range<usize>, pick: impl Fn(usize) -> bool) -> Vec<usize> {
    let first = range.start;
    range.filter(|c| pick(c - first)).collect()
}

/// Columns of a demand whose name and unit a study gives; `building` names the building.
pub(super) fn of_limit(
    layout: &Layout,
    gaps: &[(String, Vec<String>)],
    isolated: &[String],
    limit: &Limit,
    building: Option<&str>,
) -> Demand {
    let (name, unit, axis) = match limit.demand {
        DemandKind::Displacement => ("peak_displacement", "m", Axis::Storey),
        DemandKind::DriftRatio => (DRIFT_RATIO, "1", Axis::Storey),
        DemandKind::StoreyShear => ("peak_storey_shear", "N", Axis::Storey),
        DemandKind::AccelerationAbsolute => (ACCELERATION, "m s-2", Axis::Storey),
        DemandKind::Ductility => (DUCTILITY, "1", Axis::Storey),
        DemandKind::ResidualDriftRatio => (RESIDUAL, "1", Axis::Storey),
        DemandKind::BaseMoment => ("peak_base_moment", "N m", Axis::Building),
        DemandKind::FoundationSway => ("peak_foundation_sway", "m", Axis::Building),
        DemandKind::FoundationRotation => ("peak_foundation_rotation", "rad", Axis::Building),
        DemandKind::FoundationShear => ("peak_foundation_shear", "N", Axis::Building),
        DemandKind::FoundationMoment => ("peak_foundation_moment", "N m", Axis::Building),
        DemandKind::OverturningRatio => ("peak_overturning_ratio", "1", Axis::Building),
        DemandKind::Rotation => ("peak_rotation", "rad", Axis::Storey),
        DemandKind::EdgeDisplacement => ("peak_edge_displacement", "m", Axis::Storey),
        DemandKind::DisplacementAcross => ("peak_displacement_across", "m", Axis::Storey),
        DemandKind::AccelerationAcross => (ACCELERATION_ACROSS, "m s-2", Axis::Storey),
        DemandKind::ContactForce => (FORCE, "N", Axis::Level),
        DemandKind::ColumnShear => ("peak_column_shear", "N", Axis::Level),
        DemandKind::Opening => ("peak_opening", "m", Axis::Level),
        DemandKind::LinkForce => ("peak_link_force", "N", Axis::LinkLevel),
        DemandKind::LinkDeformation => ("peak_link_deformation", "m", Axis::LinkLevel),
        DemandKind::Impulse => ("impulse_max", "N s", Axis::Level),
        DemandKind::Impacts => (IMPACTS, "1", Axis::Level),
        DemandKind::IsolatedDemand => (ISOLATED, "m", Axis::Level),
    };
    let mine = |column: usize| match axis {
        Axis::Level => limit.places.is_empty() || limit.places.contains(&column),
        Axis::LinkLevel => {
            let link = limit.link.as_ref();
            link.is_none_or(|link| layout.link_levels[column].of == *link)
        }
        Axis::Building => building.is_none_or(|b| layout.buildings[column] == b),
        _ => {
            let storey = &layout.storeys[column];
            let here = match limit.places.as_slice() {
                [] => !DRIFTS.contains(&name) || drifts(storey, isolated),
                places => places.contains(&(storey.storeys[0] - 1)),
            };
            building.is_none_or(|building| storey.of == building) && here
        }
    };
    Demand {
        name: limit.name.clone(),
        unit,
        columns: chosen(layout.range(name), mine),
        isolated: name == ISOLATED,
        signed: name == RESIDUAL,
        needs: match name {
            FORCE => Needs::Itself,
            ACCELERATION | ACCELERATION_ACROSS => no_jump(layout, gaps, building),
            DUCTILITY => Needs::Place,
            _ => Needs::Nothing,
        },
    }
}

/// The columns of one quantity at one gap.
pub(super) fn of_gap(layout: &Layout, name: &'static str, gap: &str) -> Demand {
    Demand {
        name: format!("{name}: {gap}"),
        unit: "m",
        columns: chosen(layout.range(name), |column| layout.levels[column].of == gap),
        isolated: name == ISOLATED,
        signed: false,
        needs: Needs::Nothing,
    }
}
