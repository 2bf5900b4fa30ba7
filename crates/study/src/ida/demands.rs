//! Engineering demands out of the rows of a result.

use std::ops::Range;

use crate::runs::Layout;
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
}

impl Demand {
    /// Maximum value in a row; missing values, such as the time of a contact that did not
    /// happen, count as none.
    fn of(&self, values: &[f64]) -> f64 {
        self.columns.iter().map(|c| values[*c]).fold(0.0, f64::max)
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
            });
        }
    }
    for gap in groups(&layout.levels) {
        let mine = |column: usize| layout.levels[column].of == gap;
        for (name, unit) in [
            ("isolated_demand", "m"),
            ("peak_force", "N"),
            ("impulse_max", "N s"),
            ("impacts", "1"),
        ] {
            demands.push(Demand {
                name: format!("{name}: {gap}"),
                unit,
                columns: chosen(layout.range(name), mine),
                isolated: name == ISOLATED,
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
    let (name, unit, of_level) = match limit.demand {
        DemandKind::Displacement => ("peak_displacement", "m", false),
        DemandKind::DriftRatio => ("peak_drift_ratio", "1", false),
        DemandKind::StoreyShear => ("peak_storey_shear", "N", false),
        DemandKind::AccelerationAbsolute => ("peak_acceleration_absolute", "m s-2", false),
        DemandKind::ContactForce => ("peak_force", "N", true),
        DemandKind::Impulse => ("impulse_max", "N s", true),
        DemandKind::Impacts => ("impacts", "1", true),
        DemandKind::IsolatedDemand => ("isolated_demand", "m", true),
    };
    let mine = |column: usize| match (of_level, building, limit.place) {
        (true, _, Some(level)) => column == level,
        (true, _, None) | (false, None, _) => true,
        (false, Some(building), place) => {
            let storey = &layout.storeys[column];
            storey.of == building && place.is_none_or(|p| storey.storeys[0] == p + 1)
        }
    };
    Demand {
        name: limit.name.clone(),
        unit,
        columns: chosen(layout.range(name), mine),
        isolated: name == ISOLATED,
    }
}

/// The columns of one quantity at one gap.
pub(super) fn of_gap(layout: &Layout, name: &'static str, gap: &str) -> Demand {
    Demand {
        name: format!("{name}: {gap}"),
        unit: "m",
        columns: chosen(layout.range(name), |column| layout.levels[column].of == gap),
        isolated: name == ISOLATED,
    }
}
