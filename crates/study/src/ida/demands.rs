//! Engineering demands out of the rows of a result.

use std::ops::Range;

use crate::runs::{Axis, Layout};
use crate::study_file::{DemandKind, Limit};

/// The demand that asks the buildings without gaps.
const ISOLATED: &str = "isolated_demand";

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
    /// Whether a missing value is one that is not defined: the force of velocity jumps.
    has_to_be_there: bool,
}

/// The quantity that rigid impacts do not have.
const FORCE: &str = "peak_force";

impl Demand {
    /// Maximum value in a row; missing values, such as the time of a contact that did not
    /// happen, count as none.
    fn of(&self, values: &[f64]) -> f64 {
        self.columns.iter().map(|c| values[*c]).fold(0.0, f64::max)
    }

    /// Whether the demand of a run is not defined.
    pub(super) fn is_undefined(&self, values: &[f64]) -> bool {
        self.has_to_be_there && self.columns.iter().any(|c| values[*c].is_nan())
    }

    /// The same for a run that may have collapsed: then it is above everything.
    pub(super) fn of_run(&self, values: &[f64], collapsed: bool) -> f64 {
        if collapsed && !self.isolated {
            return f64::INFINITY;
        }
        self.of(values)
    }
}

/// Demands of every building and every gap, the worst storey or level of each.
pub(super) fn usual(layout: &Layout) -> Vec<Demand> {
    let mut demands = Vec::new();
    let groups = |places: &[crate::runs::Place]| {
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
        for (name, unit) in [
            ("peak_drift_ratio", "1"),
            ("peak_acceleration_absolute", "m s-2"),
        ] {
            demands.push(Demand {
                name: format!("{name}: {building}"),
                unit,
                columns: chosen(layout.range(name), mine),
                isolated: false,
                has_to_be_there: false,
            });
        }
    }
    for gap in groups(&layout.levels) {
        let mine = |column: usize| layout.levels[column].of == gap;
        for (name, unit) in [
            ("isolated_demand", "m"),
            (FORCE, "N"),
            ("peak_column_shear", "N"),
            ("impulse_max", "N s"),
            ("impacts", "1"),
        ] {
            // Not all studies have columns that are hit.
            if layout.range(name).is_empty() {
                continue;
            }
            demands.push(Demand {
                name: format!("{name}: {gap}"),
                unit,
                columns: chosen(layout.range(name), mine),
                isolated: name == ISOLATED,
                has_to_be_there: name == FORCE,
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
pub(super) fn of_limit(layout: &Layout, limit: &Limit, building: Option<&str>) -> Demand {
    let (name, unit, axis) = match limit.demand {
        DemandKind::Displacement => ("peak_displacement", "m", Axis::Storey),
        DemandKind::DriftRatio => ("peak_drift_ratio", "1", Axis::Storey),
        DemandKind::StoreyShear => ("peak_storey_shear", "N", Axis::Storey),
        DemandKind::AccelerationAbsolute => ("peak_acceleration_absolute", "m s-2", Axis::Storey),
        DemandKind::BaseMoment => ("peak_base_moment", "N m", Axis::Building),
        DemandKind::FoundationSway => ("peak_foundation_sway", "m", Axis::Building),
        DemandKind::FoundationRotation => ("peak_foundation_rotation", "rad", Axis::Building),
        DemandKind::FoundationShear => ("peak_foundation_shear", "N", Axis::Building),
        DemandKind::FoundationMoment => ("peak_foundation_moment", "N m", Axis::Building),
        DemandKind::OverturningRatio => ("peak_overturning_ratio", "1", Axis::Building),
        DemandKind::Rotation => ("peak_rotation", "rad", Axis::Storey),
        DemandKind::EdgeDisplacement => ("peak_edge_displacement", "m", Axis::Storey),
        DemandKind::DisplacementAcross => ("peak_displacement_across", "m", Axis::Storey),
        DemandKind::AccelerationAcross => ("peak_acceleration_across", "m s-2", Axis::Storey),
        DemandKind::ContactForce => (FORCE, "N", Axis::Level),
        DemandKind::ColumnShear => ("peak_column_shear", "N", Axis::Level),
        DemandKind::Impulse => ("impulse_max", "N s", Axis::Level),
        DemandKind::Impacts => ("impacts", "1", Axis::Level),
        DemandKind::IsolatedDemand => ("isolated_demand", "m", Axis::Level),
    };
    let mine = |column: usize| match axis {
        Axis::Level => limit.place.is_none_or(|level| column == level),
        Axis::Building => building.is_none_or(|b| layout.buildings[column] == b),
        _ => building.is_none_or(|building| {
            let storey = &layout.storeys[column];
            let here = limit.place.is_none_or(|p| storey.storeys[0] == p + 1);
            storey.of == building && here
        }),
    };
    Demand {
        name: limit.name.clone(),
        unit,
        columns: chosen(layout.range(name), mine),
        isolated: name == ISOLATED,
        has_to_be_there: name == FORCE,
    }
}

/// The columns of one quantity at one gap.
pub(super) fn of_gap(layout: &Layout, name: &'static str, gap: &str) -> Demand {
    Demand {
        name: format!("{name}: {gap}"),
        unit: "m",
        columns: chosen(layout.range(name), |column| layout.levels[column].of == gap),
        isolated: name == ISOLATED,
        has_to_be_there: false,
    }
}
