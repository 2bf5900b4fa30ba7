//! What a variable of the study changes of the places of its results.

use pounding_time_history::System;

use super::Layout;
use crate::study_file::{Study, Target};

/// Leaves out the elevations and widths that a variable of the study changes. Returns
/// the names of the gaps beside buildings whose storey heights vary.
pub(crate) fn leave_out_varied(layout: &mut Layout, study: &Study, system: &System) -> Vec<String> {
    let mut beside = Vec::new();
    for variable in &study.variables {
        let Target::Entry { path, .. } = &variable.target else {
            continue;
        };
        if path.table() == "building" && path.leads_through("height") {
            let names = system.buildings().iter().map(|b| b.name());
            let name = path.second(names);
            let varies = |building: &str| name.as_deref().is_none_or(|n| n == building);
            for storey in layout.storeys.iter_mut().filter(|s| varies(&s.of)) {
                storey.elevations.fill(None);
            }
            for gap in system.gaps() {
                let sides = gap.between.each_ref().map(|side| varies(side));
                if sides.contains(&true) && !beside.contains(&gap.name) {
                    beside.push(gap.name.clone());
                }
                for level in layout.levels.iter_mut().filter(|l| l.of == gap.name) {
                    for (z, varies) in level.elevations.iter_mut().zip(sides) {
                        *z = z.filter(|_| !varies);
                    }
                }
            }
        }
        if path.table() == "gap" && path.leads_through("width") {
            let name = path.second(system.gaps().iter().map(|g| g.name.as_str()));
            let varies = |gap: &str| name.as_deref().is_none_or(|n| n == gap);
            for level in layout.levels.iter_mut().filter(|l| varies(&l.of)) {
                level.width = None;
            }
        }
    }
    beside
}
