//! Requested against achieved restitution.

use std::path::Path;

use pounding_gap_element::laboratory::Specimen;
use pounding_gap_element::{AchievedRestitution, RestitutionTable, restitution_table};
use pounding_report::pictures::collision::restitutions;
use serde::Serialize;

use super::Models;
use super::chosen;
use super::collisions::{Failed, failure_of, of_each, right_aligned};
use super::remarks::remarks;
use super::setting::Setting;
use crate::arguments::{FigureArguments, ImpactArguments};
use crate::failure::Failure;
use crate::output::{comma_separated, pretty, print, written};
use crate::plot;

/// One model's rows.
struct Tabulated<'a> {
    chosen: &'a Specimen,
    table: RestitutionTable,
}

/// Tabulates the models that take a restitution; the others are left out by name.
pub fn table(
    arguments: &ImpactArguments,
    chosen: &[Specimen],
    setting: &Setting,
) -> Result<(), Failure> {
    let (taking, left_out): (Vec<&Specimen>, Vec<_>) = chosen
        .iter()
        .partition(|c| c.descriptor.takes_restitution());
    let left_out: Vec<_> = left_out
        .iter()
        .map(|c| (c.descriptor.name, reason(c)))
        .collect();
    if taking.is_empty() {
        let who: Vec<_> = left_out
            .iter()
            .map(|(name, why)| format!("{name} {why}"))
            .collect();
        return Err(Failure::input(
            format!("there is nothing to tabulate: {}", who.join("; ")),
            Some("leave --table out to see what such a model returns".to_owned()),
        ));
    }
    let tabulate = |one: &Specimen| {
        let (bodies, options) = (&setting.bodies, &setting.options);
        restitution_table(one.descriptor, &one.parameters, bodies, options)
    };
    let several = taking.len() > 1;
    let (tables, failed) = of_each(taking, tabulate)?;
    let tables = tables.into_iter();
    let tables: Vec<_> = tables
        .map(|(chosen, table)| Tabulated { chosen, table })
        .collect();
    let any = !tables.is_empty();
    if !any && !arguments.json {
        return failure_of(&failed);
    }
    if let Some(path) = arguments.csv.as_ref().filter(|_| any) {
        write_csv(path, &tables, setting)?;
    }
    if let Some(path) = arguments.svg.as_ref().filter(|_| any) {
        write_svg(path, &tables, &arguments.figure)?;
    }
    if arguments.json {
        let left_out = left_out.iter();
        let left_out = left_out.map(|(model, reason)| Reason { model, reason });
        let left_out = LeftOut {
            left_out: left_out.collect(),
            failed: &failed,
        };
        let models = tables.iter().map(|one| (one.chosen, &one.table));
        print(&pretty(&Models::new(models, left_out, setting, several))?)?;
        return failure_of(&failed);
    }
    let mut text = format!("{}\n", setting.description);
    text.push_str(&match tables.as_slice() {
        [one] => detailed(one),
        _ => matrix(&tables),
    });
    for (name, why) in &left_out {
        text.push_str(&format!("left out: {name} {why}\n"));
    }
    text.push_str(&staying(&tables));
    let shown: Vec<_> = tables.iter().map(|one| one.chosen).collect();
    text.push_str(&remarks(&shown, setting));
    text.push_str(&written([
        arguments.csv.as_deref(),
        arguments.svg.as_deref(),
    ]));
    print(&text)?;
    failure_of(&failed)
}

fn reason(chosen: &Specimen) -> &'static str {
    match chosen.descriptor.achieved_restitution {
        AchievedRestitution::Elastic => "takes no restitution: it always returns 1",
        AchievedRestitution::Constant => {
            "takes no restitution: what it returns follows from its other parameters"
        }
        AchievedRestitution::Varies => {
            "takes no restitution: what it returns depends on the collision"
        }
    }
}

/// Rows in which the bodies never part.
fn staying(tables: &[Tabulated<'_>]) -> String {
    let mut text = String::new();
    for one in tables {
        let rows = one.table.rows.iter();
        let staying = rows.filter(|r| r.outcome.stays_in_contact);
        let asked: Vec<_> = staying.map(|r| format!("{:.1}", r.requested)).collect();
        if !asked.is_empty() {
            text.push_str(&format!(
                "stays in contact: {} has too little energy left to part where asked for {}\n",
                one.chosen.descriptor.name,
                asked.join(", ")
            ));
        }
    }
    text
}

fn detailed(one: &Tabulated<'_>) -> String {
    let mut table = right_aligned(
        [
            "requested",
            "achieved",
            "error %",
            "peak force (N)",
            "contact time (s)",
        ]
        .map(str::to_owned)
        .into(),
    );
    for row in &one.table.rows {
        let rigid = row.outcome.is_rigid();
        let dash = |text: String| if rigid { "-".to_owned() } else { text };
        table.add_row([
            format!("{:.1}", row.requested),
            format!("{:.7}", row.outcome.restitution),
            format!("{:.2}", row.error_percent()),
            dash(format!("{:.4e}", row.outcome.peak_force)),
            match row.outcome.contact_time() {
                time if time.is_nan() => "-".to_owned(),
                time => format!("{time:.4e}"),
            },
        ]);
    }
    let [all, middle] = one.table.mean_errors_percent();
    format!("{table}\nmean error {all:.2} % over 0.1-1.0, {middle:.2} % over 0.5-0.8\n")
}

fn matrix(tables: &[Tabulated<'_>]) -> String {
    let mut header = vec!["achieved".to_owned()];
    header.extend(
        tables[0]
            .table
            .rows
            .iter()
            .map(|r| format!("{:.1}", r.requested)),
    );
    header.push("mean error % 0.1-1.0".into());
    header.push("0.5-0.8".into());
    let mut table = right_aligned(header);
    for one in tables {
        let mut row = vec![one.chosen.descriptor.name.to_owned()];
        let achieved = one.table.rows.iter().map(|r| r.outcome.restitution);
        row.extend(achieved.map(|e| format!("{e:.4}")));
        let [all, middle] = one.table.mean_errors_percent();
        row.extend([format!("{all:.2}"), format!("{middle:.2}")]);
        table.add_row(row);
    }
    format!("{table}\n")
}

/// What all models of a table share.
#[derive(Serialize)]
struct LeftOut<'l> {
    left_out: Vec<Reason<'l>>,
    /// Models of which there is no table.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    failed: &'l [Failed],
}

/// Why a model is not in the table.
#[derive(Serialize)]
struct Reason<'l> {
    model: &'l str,
    reason: &'l str,
}

fn write_csv(path: &Path, tables: &[Tabulated<'_>], setting: &Setting) -> Result<(), Failure> {
    let mut head = format!("# pounding impact --table: {}\n", setting.pairs());
    let mut rows = Vec::new();
    for one in tables {
        head.push_str(&format!("# {}\n", chosen::pairs(one.chosen)));
        rows.extend(one.table.rows.iter().map(|r| {
            let force = Some(r.outcome.peak_force).filter(|f| f.is_finite());
            let duration = Some(r.outcome.contact_time()).filter(|t| t.is_finite());
            let name = one.chosen.descriptor.name;
            (
                name,
                r.requested,
                r.outcome.restitution,
                r.error_percent(),
                force,
                duration,
            )
        }));
    }
    let columns = [
        "model",
        "requested",
        "achieved",
        "error_percent",
        "peak_force_n",
        "contact_time_s",
    ];
    plot::write(path, &format!("{head}{}", comma_separated(&columns, rows)?))
}

fn write_svg(path: &Path, tables: &[Tabulated<'_>], size: &FigureArguments) -> Result<(), Failure> {
    let models = tables.iter();
    let models: Vec<_> = models
        .map(|one| (one.chosen.descriptor.name, &one.table))
        .collect();
    plot::write_drawn(path, restitutions(&models), size)
}
