//! Tables of the gap check.

use pounding_study::gap_check::{Amplification, GapCheck};

use crate::failure::Failure;
use crate::output::comma_separated;

/// Every width, record, building and storey of the sweep.
pub fn sweep(check: &GapCheck) -> Result<String, Failure> {
    let mut rows = Vec::new();
    let Some(sweep) = &check.sweep else {
        return Ok(String::new());
    };
    for (width, runs) in sweep.widths.iter().zip(&sweep.runs) {
        for (record, run) in check.records.iter().zip(runs) {
            let start = [width.to_string(), record.name.clone()];
            let run = match run {
                Ok(run) => run,
                Err(failure) => {
                    let mut row = start.to_vec();
                    row.extend(vec![String::new(); 8]);
                    row.push(failure.clone());
                    rows.push(row);
                    continue;
                }
            };
            let contact = sweep.contact(run);
            for (building, storeys) in record.isolated.iter().zip(&run.amplification) {
                for (storey, a) in storeys.iter().enumerate() {
                    let mut row = start.to_vec();
                    row.push(building.name.clone());
                    row.push((storey + 1).to_string());
                    row.extend(Amplification::QUANTITIES.map(|(_, of)| of(a).to_string()));
                    row.push(contact.impacts.to_string());
                    row.push(contact.peak_force.to_string());
                    row.push(contact.impact_energy.to_string());
                    row.push(String::new());
                    rows.push(row);
                }
            }
        }
    }
    let header = [
        "width_m",
        "record",
        "building",
        "storey",
        "displacement_amplification",
        "storey_shear_amplification",
        "acceleration_absolute_amplification",
        "impacts",
        "peak_force_n",
        "impact_energy_j",
        "failure",
    ];
    comma_separated(&header, rows)
}

/// Storey or elevation of a floor; nothing for a wall.
fn of_side(value: Option<impl ToString>) -> String {
    value.map_or_else(String::new, |v| v.to_string())
}

/// Every rule at every level under every record.
pub fn codes(check: &GapCheck) -> Result<String, Failure> {
    let mut rows = Vec::new();
    for (index, gap) in check.gaps.iter().enumerate() {
        for (r, record) in check.records.iter().enumerate() {
            for level in 0..gap.levels.len() {
                let demand = record.demand[index][level].value;
                let place = &gap.levels[level].place;
                let mut start = vec![
                    gap.name.clone(),
                    record.name.clone(),
                    (level + 1).to_string(),
                ];
                // Storeys in columns of their own: a spreadsheet takes 3-3 for a day in March.
                start.extend(place.storeys.map(of_side));
                start.extend(place.elevations.map(of_side));
                start.push(gap.levels[level].width.to_string());
                start.push(demand.to_string());
                start.push(record.ground_moves(index, level).to_string());
                let over_demand = |width: f64| (width, (width / demand).to_string());
                let mut add = |rule: &str,
                               status: &str,
                               width: Result<(f64, String), String>,
                               [factor, caution]: [Option<&str>; 2]| {
                    let mut row = start.clone();
                    row.extend([rule.to_owned(), status.to_owned()]);
                    match width {
                        Ok((width, ratio)) => row.extend([width.to_string(), ratio, String::new()]),
                        Err(refusal) => row.extend([String::new(), String::new(), refusal]),
                    }
                    row.extend([factor, caution].map(|x| x.unwrap_or_default().to_owned()));
                    rows.push(row);
                };
                for c in &gap.combinations {
                    let name = match c.effective {
                        Some(e) => format!("{} ({})", c.rule.name(), e.name()),
                        None => c.rule.name().to_owned(),
                    };
                    let width = c.records[r][level].width;
                    add(&name, c.status.name(), Ok(over_demand(width)), [None; 2]);
                }
                for c in &gap.codes {
                    let p = &c.provision;
                    let factor = p.elastic_displacement_factor();
                    let status = p.status().name();
                    let required = c.records[r][level].as_ref();
                    let caution = required.ok().and_then(|w| w.caution.as_deref());
                    // A row for each reading of a disputed provision.
                    for reading in required.map_or(&[][..], |r| &r.readings) {
                        let name = format!("{} ({})", p.name(), reading.text);
                        let width = Ok(over_demand(reading.width));
                        add(&name, status, width, [factor, caution]);
                    }
                    if !required.is_ok_and(|r| !r.readings.is_empty()) {
                        let width = required.map(|w| match c.is_of_seat() {
                            // What closes a gap says nothing of a seat.
                            true => (w.width, String::new()),
                            false => over_demand(w.width),
                        });
                        let width = width.map_err(ToString::to_string);
                        add(p.name(), status, width, [factor, caution]);
                    }
                }
            }
        }
    }
    let header = [
        "gap",
        "record",
        "level",
        "left_storey",
        "right_storey",
        "left_elevation_m",
        "right_elevation_m",
        "provided_m",
        "demand_m",
        "relative_ground_displacement_m",
        "rule",
        "status",
        "width_m",
        "ratio_to_demand",
        "refusal",
        "elastic_displacement_factor",
        "caution",
    ];
    comma_separated(&header, rows)
}
