//! What a variable of the study changes of the places of its results.

use pounding_time_history::System;

use super::{Layout, Place};
use crate::study_file::Study;

/// Leaves out the elevations and widths that a variable of the study changes. Returns
/// the names of the gaps beside buildings whose storey heights vary.
pub(crate) fn leave_out_varied(layout: &mut Layout, study: &Study, system: &System) -> Vec<String> {
    let mut beside = Vec::new();
    for path in study.variables.iter().flat_map(|v| v.target.paths()) {
        if path.of_elevations() {
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
                // A column is hit where the floor is that hits it.
                let mut in_case = study.base.gaps.iter();
                let columns = in_case.find(|g| g.name == gap.name);
                let hit = |side: usize| columns.is_some_and(|g| g.columns[side].is_some());
                let varies = |side: usize| sides[side] || hit(side) && sides[1 - side];
                for level in layout.levels.iter_mut().filter(|l| l.of == gap.name) {
                    for (side, z) in level.elevations.iter_mut().enumerate() {
                        *z = z.filter(|_| !varies(side));
                    }
                }
            }
            for link in system.links() {
                let sides = link.between.each_ref().map(|side| varies(side));
                for level in layout.link_levels.iter_mut().filter(|l| l.of == link.name) {
                    let storeys = level.storeys.iter().zip(sides);
                    for (z, (storey, varies)) in level.elevations.iter_mut().zip(storeys) {
                        *z = z.filter(|_| *storey == 0 || !varies);
                    }
                }
            }
        }
        if path.of_plan() {
            number_points(&mut layout.levels);
            number_points(&mut layout.link_levels);
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

/// Contact points of floors that turn in plan by their numbers, where their positions vary.
fn number_points(levels: &mut [Place]) {
    let mut before = (String::new(), 0);
    for level in levels {
        let Some((floors, position)) = level.label.rsplit_once(" at ") else {
            continue;
        };
        if !position.ends_with(" m across") {
            continue;
        }
        let number = if before.0 == floors { before.1 + 1 } else { 1 };
        before = (floors.to_owned(), number);
        level.label = format!("{floors} point {number}");
    }
}
