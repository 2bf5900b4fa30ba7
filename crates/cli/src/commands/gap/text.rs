//! The gap check for people.

use pounding_case::Case;
use pounding_catalogue::numbers::{rounded_up_beside, width_in_millimetres};
use pounding_catalogue::wording::counted;
use pounding_shear_building::{OVERTURNING_RATIO, UPLIFT_BEGINS};
use pounding_study::gap_check::{
    Amplification, GapCheck, GapSweep, LevelDemand, RecordDemand, collapsed_building,
};
use pounding_time_history::VELOCITY_JUMPS;

use super::answer::{answer, left_or_short};
use super::rules;
use super::suite::{suite, target};
use crate::tables::{against_capacity, collapsed, decimal, links_stay, new_table, warning_lines};

/// More records than this are summed up instead of listed.
const LISTED: usize = 6;
/// Rows of the printed sweep; every width is in the CSV file.
const ROWS: usize = 16;

/// The whole report.
pub fn report(case: &Case, check: &GapCheck, all: bool) -> String {
    let mut text = String::new();
    if !case.title.is_empty() {
        text.push_str(&format!("{}\n", case.title));
    }
    text.push_str(links_stay(case));
    text.push_str(&foundations(case, check));
    text.push_str(&target(check));
    text.push_str(&warning_lines(&check.warnings));
    text.push_str(&collapsed(
        (&check.collapsed, check.records.len()),
        ", which no gap is wide enough for; demands, widths by rule and ratios",
    ));
    for gap in &check.gaps {
        text.push_str(&answer(check, gap));
    }
    // The answer of a code stands for itself: what else was computed is folded away.
    let folded = !all && check.gaps.iter().any(|gap| gap.code.is_some());
    for gap in 0..check.gaps.len() {
        if !folded {
            text.push_str(&demand(check, gap));
        }
        text.push_str(&isolation(check, gap));
        text.push_str(&suite(check, gap, all));
        if !folded {
            text.push_str(&rules::table(check, &check.gaps[gap], all));
        }
    }
    if folded {
        text.push_str(&columns(check));
        text.push_str(&openings(check));
        text.push_str(&what_is_folded(check));
        return text;
    }
    text.push_str(&provided(check));
    if let Some(sweep) = &check.sweep {
        text.push_str(&swept(check, sweep));
    }
    text
}

/// What `--all` shows beside the answer of a code.
fn what_is_folded(check: &GapCheck) -> String {
    let rules: usize = check.gaps.iter().map(rules::count).sum();
    let mut shown = vec![
        "demand by level".to_owned(),
        format!("widths by {}", counted(rules, "rule")),
        "what pounding does at the provided gaps".to_owned(),
    ];
    if let Some(sweep) = &check.sweep {
        shown.push(format!(
            "the sweep over {}",
            counted(sweep.widths.len(), "width")
        ));
    }
    let failed = check.records.iter().filter(|r| r.pounding.is_err());
    let failed: String = failed
        .map(|r| {
            let collapsed = r
                .pounding
                .as_ref()
                .err()
                .and_then(|d| collapsed_building(d));
            match collapsed {
                Some(building) => format!(
                    "warning: pounding brings {building} to collapse under {}\n",
                    r.name
                ),
                None => format!("warning: the run with pounding under {} failed\n", r.name),
            }
        })
        .collect();
    format!("\n{failed}--all also shows {}\n", shown.join(", "))
}

/// What floor displacements hold beside the deformation of the buildings.
fn foundations(case: &Case, check: &GapCheck) -> String {
    let founded = case.buildings.iter().filter(|b| b.foundation.is_some());
    let names: Vec<&str> = founded.map(|b| b.name.value.as_str()).collect();
    if names.is_empty() {
        return String::new();
    }
    let mut text = format!(
        "  displacements of {} count sway and rotation of the foundation, in demand and in widths by rule\n",
        names.join(", ")
    );
    for name in names {
        let ratios = check.records.iter().filter_map(|record| {
            let building = record.isolated.iter().find(|b| b.name == name)?;
            let mut responses = building.responses.iter();
            let found = responses.find(|r| r.name == OVERTURNING_RATIO)?;
            Some((found.peak.value, record.name.as_str()))
        });
        let Some((ratio, record)) = ratios.max_by(|a, b| a.0.total_cmp(&b.0)) else {
            continue;
        };
        let lifts = if ratio > UPLIFT_BEGINS {
            "warning: the foundation of"
        } else {
            "  the foundation of"
        };
        let so = if ratio > UPLIFT_BEGINS {
            ": from 0.33 on its edge lifts off the soil, which is not modelled, and the demand may be greater"
        } else {
            ""
        };
        text.push_str(&format!(
            "{lifts} {name} bears up to {ratio:.2} of the moment that would overturn it, under {record}{so}\n"
        ));
    }
    text
}

/// Demand at every level under every record.
fn demand(check: &GapCheck, index: usize) -> String {
    let gap = &check.gaps[index];
    let few = check.records.len() <= LISTED;
    let mut header = ["level", "elevations (m)", "provided (mm)"]
        .map(str::to_owned)
        .to_vec();
    if few {
        header.extend(check.records.iter().map(|r| format!("{} (mm)", r.name)));
    }
    let contact = match gap.records_collapsed {
        0 => "records in contact",
        _ => "records in contact or collapsed",
    };
    header.extend(["maximum (mm)", contact].map(str::to_owned));
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let mut table = new_table(&header);
    for (l, level) in gap.levels.iter().enumerate().rev() {
        let peaks = check.records.iter().map(|r| r.demand[index][l]);
        let shown = |demand: f64| rounded_up_beside(demand * 1e3, level.width * 1e3, 2);
        let mut row = vec![
            level.place.label(),
            level.place.elevations_label(),
            width_in_millimetres(level.width),
        ];
        if few {
            row.extend(
                peaks
                    .clone()
                    .map(|p| format!("{} @{:.3}", shown(p.value), p.time)),
            );
        }
        let maximum = peaks.clone().fold(0.0_f64, |m, p| m.max(p.value));
        let contacts = peaks.filter(|p| p.value > level.width).count() + gap.records_collapsed;
        row.push(shown(maximum));
        row.push(format!("{contacts} of {}", gap.records()));
        table.add_row(row);
    }
    format!(
        "\nGap {}: demand, the maximum approach of the buildings without contact, @time (s)\n{table}\n",
        gap.name
    )
}

/// Demand of a building on isolators against the clearance of each level, with the force on
/// what stops it.
fn isolation(check: &GapCheck, index: usize) -> String {
    let mut text = String::new();
    for (l, level) in check.gaps[index].levels.iter().enumerate() {
        let Some(building) = &level.on_isolators else {
            continue;
        };
        let demands = check.records.iter().map(|r| (r, r.demand[index][l].value));
        let Some((record, demand)) = demands.max_by(|a, b| a.1.total_cmp(&b.1)) else {
            continue;
        };
        let forces = check.records.iter().filter_map(|r| r.peak_force(index, l));
        let force = match forces.fold(0.0, f64::max) {
            0.0 => String::new(),
            force => format!(
                "; maximum contact force at this clearance {:.1} kN",
                force * 1e-3
            ),
        };
        text.push_str(&format!(
            "Level {}: {building} on isolators demands {} mm ({}), clearance {} mm: {}{force}\n",
            level.place,
            rounded_up_beside(demand * 1e3, level.width * 1e3, 2),
            record.name,
            width_in_millimetres(level.width),
            left_or_short(level.width, demand),
        ));
    }
    text
}

/// Maximum over the storeys of a building, as "x1.23 (storey 3)"; a dash where nothing moves.
fn maximum(storeys: &[Amplification], quantity: fn(&Amplification) -> f64) -> String {
    match Amplification::of_storeys(storeys, quantity) {
        Some((storey, x)) => format!("x{} (storey {})", decimal(x, 3), storey + 1),
        None => "-".to_owned(),
    }
}

/// Whether some impact was a jump, which has no force.
pub fn rigid(check: &GapCheck) -> bool {
    let runs = check
        .records
        .iter()
        .filter_map(|r| r.pounding.as_ref().ok());
    let levels = runs.flat_map(|(_, gaps)| gaps.iter().flat_map(|g| &g.levels));
    let mut touched = levels.filter(|l| l.impacts > 0);
    touched.any(|l| l.peak_force.value.is_nan())
}

/// What pounding does at the provided gap.
fn provided(check: &GapCheck) -> String {
    let mut table = new_table([
        "record",
        "building",
        "displacement",
        "storey shear",
        "absolute acceleration",
        "impacts",
    ]);
    table.set_keys(2);
    let listed = check.records.len() <= LISTED;
    let mut failures = String::new();
    for record in &check.records {
        let RecordDemand { name, pounding, .. } = record;
        let (with, gaps) = match pounding {
            Ok(pounding) => pounding,
            Err(diagnosis) => {
                let what = match collapsed_building(diagnosis) {
                    Some(building) => format!("pounding brings {building} to collapse"),
                    None => "the run failed".to_owned(),
                };
                failures.push_str(&format!("{name}: {what}: {diagnosis}\n"));
                continue;
            }
        };
        let impacts: usize = gaps.iter().flat_map(|g| &g.levels).map(|l| l.impacts).sum();
        let amplification = record.amplification().unwrap_or_default();
        for (building, storeys) in with.iter().zip(amplification).filter(|_| listed) {
            let mut row = vec![name.clone(), building.name.clone()];
            row.extend(Amplification::QUANTITIES.map(|(_, q)| maximum(&storeys, q)));
            row.push(impacts.to_string());
            table.add_row(row);
        }
    }
    if !listed {
        for row in over_all_records(check) {
            table.add_row(row);
        }
    }
    let jumps = rigid(check).then(|| format!("{VELOCITY_JUMPS}\n"));
    let jumps = jumps.unwrap_or_default();
    format!(
        "\nAt the provided gaps: maximum over storeys of the ratio of a storey's peak with pounding to that without contact\n{table}\n{failures}{jumps}{}{}",
        columns(check),
        openings(check)
    )
}

/// The shear of columns that floors hit, a line each.
fn columns(check: &GapCheck) -> String {
    let mut text = String::new();
    for gap in &check.gaps {
        for column in gap.columns.iter().rev() {
            let shear = &column.response;
            text.push_str(&format!(
                "Gap {}, level {}: columns that are hit bear a {} of {} kN at {:.2} s under {}{}\n",
                gap.name,
                gap.levels[column.level].place,
                shear.name.replace("column_", "").replace('_', " "),
                decimal(1e-3 * shear.peak.value, 1),
                shear.peak.time,
                check.records[column.record].name,
                against_capacity(shear)
            ));
        }
    }
    text
}

/// How far joints with a seat open, a line each.
fn openings(check: &GapCheck) -> String {
    let mut text = String::new();
    for gap in &check.gaps {
        let failed =
            check.records.iter().filter(|r| r.pounding.is_err()).count() + gap.records_collapsed;
        if gap.seat.is_some() && failed > 0 {
            text.push_str(&format!(
                "Gap {}: openings are not known of {} of {}, in which a building collapses or the run fails\n",
                gap.name,
                failed,
                counted(gap.records(), "record")
            ));
        }
        for LevelDemand {
            level,
            record,
            response,
        } in gap.openings.iter().rev()
        {
            let seat = gap.seat.unwrap_or(f64::INFINITY);
            let falls = response.peak.value > seat;
            text.push_str(&format!(
                "Gap {}, level {}: the joint opens by {:.1} mm at {:.2} s under {}, {} its seat of {:.1} mm{}\n",
                gap.name,
                gap.levels[*level].place,
                1e3 * response.peak.value,
                response.peak.time,
                check.records[*record].name,
                if falls { "more than" } else { "within" },
                1e3 * seat,
                if falls { ": the deck falls" } else { "" },
            ));
        }
    }
    text
}

/// A row per building, with the record under which each ratio is a maximum.
fn over_all_records(check: &GapCheck) -> Vec<Vec<String>> {
    let all: Vec<_> = check
        .records
        .iter()
        .filter_map(|r| Some((r.name.as_str(), r.amplification()?)))
        .collect();
    let buildings = check.records.first().map_or(&[][..], |r| &r.isolated);
    let row = |(index, building): (usize, &pounding_time_history::BuildingOutcome)| {
        let mut row = vec![format!("maximum of {}", all.len()), building.name.clone()];
        row.extend(Amplification::QUANTITIES.map(|(_, of)| {
            let tops = all.iter().filter_map(|(name, a)| {
                let (_, top) = Amplification::of_storeys(a.get(index)?, of)?;
                Some((*name, top))
            });
            let top = tops.max_by(|a, b| a.1.total_cmp(&b.1));
            top.map_or("-".to_owned(), |(name, x)| {
                format!("x{} ({name})", decimal(x, 3))
            })
        }));
        row.push("-".to_owned());
        row
    };
    buildings.iter().enumerate().map(row).collect()
}

fn swept(check: &GapCheck, sweep: &GapSweep) -> String {
    let Some(first) = check.records.first() else {
        return String::new();
    };
    if sweep.widths.is_empty() {
        return "\nNo sweep: under no record do the buildings approach each other without contact; --from and --to set its widths\n".to_owned();
    }
    let buildings: Vec<&str> = first.isolated.iter().map(|b| b.name.as_str()).collect();
    let mut header = vec!["width (mm)".to_owned()];
    for name in &buildings {
        header.extend(Amplification::QUANTITIES.map(|(quantity, _)| format!("{name}: {quantity}")));
    }
    header.push(match &sweep.gap {
        Some(gap) => format!("impacts in {gap}"),
        None => "impacts".to_owned(),
    });
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let mut table = new_table(&header);
    let every = sweep.widths.len().div_ceil(ROWS);
    for (i, width) in sweep.widths.iter().enumerate().step_by(every) {
        let mut row = vec![format!("{:.2}", width * 1e3)];
        for building in 0..buildings.len() {
            let falls = sweep.collapses(i, buildings[building]);
            let cell = |x: Option<f64>| match x {
                _ if falls => "collapse".to_owned(),
                Some(x) => decimal(x, 3),
                None => "-".to_owned(),
            };
            row.extend(
                Amplification::QUANTITIES.map(|(_, q)| cell(sweep.over_records(i, building, q))),
            );
        }
        let runs = sweep.runs[i].iter().flatten();
        let impacts = runs.map(|run| sweep.contact(run).impacts).max();
        row.push(impacts.map_or("-".to_owned(), |n| n.to_string()));
        table.add_row(row);
    }
    let which = sweep.gap.as_deref().unwrap_or("all gaps alike");
    let shown = if every == 1 {
        "every width shown".to_owned()
    } else {
        format!("one width in every {every} shown, --csv writes all")
    };
    let mut text = format!(
        "\nSweep over {} ({which}): maximum amplification over storeys and records; {shown}\n{table}\n",
        counted(sweep.widths.len(), "width"),
    );
    text.push_str(&worst(check, sweep, &buildings));
    if sweep.failures() > 0 {
        text.push_str(&format!(
            "{} of the sweep failed; --json and --csv say why\n",
            counted(sweep.failures(), "run")
        ));
    }
    text
}

/// Widths that are named one by one.
const NAMED_WIDTHS: usize = 8;

/// The widths at which pounding brings a building to collapse: nothing is worse.
fn collapse(sweep: &GapSweep, building: &str) -> String {
    let fallen = (0..sweep.widths.len()).filter(|i| sweep.collapses(*i, building));
    let widths: Vec<String> = fallen
        .map(|i| format!("{:.2}", sweep.widths[i] * 1e3))
        .collect();
    let Some((last, others)) = widths.split_last() else {
        return String::new();
    };
    let which = match others {
        [] => last.clone(),
        _ if widths.len() <= NAMED_WIDTHS => format!("{} and {last}", others.join(", ")),
        _ => format!("{} widths from {} to {last}", widths.len(), widths[0]),
    };
    format!("{building}: worst at {which} mm, where pounding brings it to collapse\n")
}

/// The worst width of every quantity: computed ones, nothing in between.
fn worst(check: &GapCheck, sweep: &GapSweep, buildings: &[&str]) -> String {
    let mut text = String::new();
    for (building, name) in buildings.iter().enumerate() {
        let falls = collapse(sweep, name);
        text.push_str(&falls);
        let elsewhere = if falls.is_empty() { "" } else { "otherwise " };
        for (quantity, of) in Amplification::QUANTITIES {
            let Some(w) = sweep.worst(building, of) else {
                continue;
            };
            if !w.is_raised() {
                text.push_str(&format!(
                    "{name}: {elsewhere}no width raises the {quantity}\n"
                ));
                continue;
            }
            text.push_str(&format!(
                "{name}: {elsewhere}{quantity} worst at {:.2} mm: x{} at storey {} under {}\n",
                w.width * 1e3,
                decimal(w.amplification, 3),
                w.storey + 1,
                check.records[w.record].name
            ));
        }
    }
    text
}
