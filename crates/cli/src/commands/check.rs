//! `pounding check`: what was understood.

use std::path::Path;

use pounding_catalogue::wording::counted;
use serde_json::json;

use crate::failure::Failure;
use crate::faults::{assembled, read_case, responses_fit};
use crate::json::add_place;
use crate::output::{pretty, print};
use crate::progress::Progress;
use crate::tables;

/// Validates a case, reads its record, and prints both in SI units.
pub fn check(path: &Path, as_json: bool) -> Result<(), Failure> {
    let case = read_case(path, true)?;
    let storeys: usize = case.buildings.iter().map(|b| b.mass.len()).sum();
    let progress = Progress::working(format!(
        "computing the modes of {}",
        counted(storeys, "storey")
    ))?;
    let assembly = assembled(&case)?;
    responses_fit(&assembly, &case)?;
    if !as_json {
        let text = tables::understood(&case, &assembly);
        drop(progress);
        return print(&text);
    }
    let system = &assembly.system;
    let buildings: Vec<_> = system
        .buildings()
        .iter()
        .map(|b| {
            json!({
                "name": b.name(), "mass": b.mass(), "stiffness": b.stiffness(), "height": b.height(),
                "elevation": b.elevations(), "period": b.modes().period,
                "geometric_stiffness": b.geometric_stiffness(),
                "laws": b.laws().iter().map(|l| l.as_ref().map(|l| l.law.descriptor().name)).collect::<Vec<_>>(),
                "damping_ratio": b.modes().damping_ratio, "effective_mass": b.modes().effective_mass,
            })
        })
        .collect();
    let gaps: Vec<_> = system
        .gaps()
        .iter()
        .map(|g| {
            let levels = system.levels_of(g).iter().map(|l| {
                let mut value = json!({
                    "width": l.width, "effective_mass": l.effective_mass,
                    "model": l.model.descriptor().name,
                });
                add_place(&mut value, &l.place);
                value
            });
            let levels: Vec<_> = levels.collect();
            json!({"name": g.name, "between": g.between, "levels": levels})
        })
        .collect();
    let links: Vec<_> = system
        .links()
        .iter()
        .enumerate()
        .map(|(index, l)| {
            let places = system.link_levels(index);
            let levels = places.iter().map(|place| {
                let mut value = json!({});
                add_place(&mut value, place);
                value
            });
            let levels: Vec<_> = levels.collect();
            let laws: Vec<_> = system.elements()[l.first_element..l.first_element + l.levels]
                .iter()
                .map(|e| e.law.descriptor().name)
                .collect();
            json!({"name": l.name, "between": l.between, "levels": levels, "laws": laws})
        })
        .collect();
    let record = &assembly.accelerogram;
    drop(progress);
    print(&pretty(&json!({
        "buildings": buildings, "gaps": gaps, "links": links,
        "ground_motion": {
            "samples": record.samples().len(), "time_step": record.time_step(),
            "peak": record.peak().value, "scale": record.scale(), "echo": record.echo(),
        },
        "warnings": assembly.warnings(),
        "analysis": {"output_step": assembly.output_step, "duration": assembly.options.duration.unwrap_or(record.duration())},
    })))
}
