//! The comparison for people.

use pounding_case::Case;
use pounding_gap_element::Verification;
use pounding_study::comparison::{Comparison, Holds, Quantity, QuantityKind};

use crate::tables::{new_table, warning_lines};

const G: f64 = 9.80665;
/// More records than this have no tables of their own.
const LISTED: usize = 6;

/// Kinds that a table of a record shows.
const SHOWN: [QuantityKind; 8] = [
    QuantityKind::Displacement,
    QuantityKind::StoreyShear,
    QuantityKind::AccelerationAbsolute,
    QuantityKind::Impacts,
    QuantityKind::PeakForce,
    QuantityKind::ApproachVelocity,
    QuantityKind::ImpactEnergy,
    QuantityKind::AchievedRestitution,
];

/// Unit of tables, its size in SI, and digits after the point.
fn shown_in(kind: QuantityKind) -> (&'static str, f64, usize) {
    match kind {
        QuantityKind::Displacement => ("mm", 1e-3, 1),
        QuantityKind::DriftRatio => ("%", 1e-2, 3),
        QuantityKind::StoreyShear | QuantityKind::PeakForce => ("kN", 1e3, 1),
        QuantityKind::AccelerationAbsolute => ("g", G, 3),
        QuantityKind::Impacts => ("-", 1.0, 0),
        QuantityKind::Impulse => ("kN s", 1e3, 2),
        QuantityKind::ApproachVelocity => ("m/s", 1.0, 3),
        QuantityKind::ImpactEnergy => ("kJ", 1e3, 2),
        QuantityKind::AchievedRestitution => ("-", 1.0, 3),
    }
}

/// The whole report.
pub fn report(case: &Case, c: &Comparison) -> String {
    let mut text = String::new();
    if !case.title.is_empty() {
        text.push_str(&format!("{}\n", case.title));
    }
    text.push_str(&warning_lines(&c.warnings));
    text.push_str(&calibration(c));
    if c.records.len() <= LISTED {
        for record in 0..c.records.len() {
            text.push_str(&values(c, record));
        }
    } else {
        text.push_str(&failures(c));
        text.push_str("\nValues of every model under every record: --csv or --json\n");
    }
    text.push_str(&spreads(c));
    text.push_str(&ranking(c));
    text.push_str(&conclusions(c));
    text.push_str(&remarks(c));
    text
}

fn calibration(c: &Comparison) -> String {
    let mut text = format!(
        "\n{} models, calibrated alike: elastic laws of equal {}; restitution {}\n",
        c.models.len(),
        c.options.stiffness_rule.name(),
        match c.options.restitution_rule.name() {
            "exact" => "returned exactly by the reference collision",
            _ => "asked for by each model's own relation",
        }
    );
    let gaps = c
        .quantities
        .iter()
        .filter(|q| q.kind == QuantityKind::Impacts);
    for (gap, r) in gaps.zip(&c.references) {
        text.push_str(&format!(
            "  {}: restitution {:.4}; reference collision at {:.4} m/s, effective mass {:.1} kg, own law {:.4e} N/m^{}\n",
            gap.of, r.restitution, r.approach_velocity, r.effective_mass, r.stiffness, r.exponent
        ));
    }
    text
}

/// Models that did not run under every record, with the first reason.
fn failures(c: &Comparison) -> String {
    let failed = c.models.iter().filter_map(|m| {
        let diagnosis = m.diagnosis()?;
        Some(format!("{}: {diagnosis}\n", m.descriptor.name))
    });
    failed.collect()
}

/// Values of all models under one record.
fn values(c: &Comparison, record: usize) -> String {
    let columns: Vec<(usize, &Quantity)> = c
        .quantities
        .iter()
        .enumerate()
        .filter(|(_, q)| SHOWN.contains(&q.kind))
        .collect();
    let mut header = vec!["model".to_owned(), "free restitution".to_owned()];
    header.extend(columns.iter().map(|(_, q)| {
        let (unit, _, _) = shown_in(q.kind);
        format!("{} ({unit})", q.label().replace('_', " "))
    }));
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let mut table = new_table(&header);
    let cell = |x: f64, kind: QuantityKind| {
        let (_, size, digits) = shown_in(kind);
        if x.is_nan() {
            "-".to_owned()
        } else {
            format!("{:.digits$}", x / size)
        }
    };
    let mut alone = vec!["(no pounding)".to_owned(), "-".to_owned()];
    alone.extend(
        columns
            .iter()
            .map(|(q, x)| cell(c.isolated[record][*q], x.kind)),
    );
    table.add_row(alone);
    let mut failures = String::new();
    for (m, model) in c.models.iter().enumerate() {
        if let Err(diagnosis) = &model.records[record] {
            failures.push_str(&format!("{}: {diagnosis}\n", model.descriptor.name));
            continue;
        }
        let free = model
            .calibrated
            .iter()
            .flatten()
            .map(|g| g.free_restitution);
        let free: Vec<_> = free.map(|e| format!("{e:.4}")).collect();
        let mut row = vec![model.descriptor.name.to_owned(), free.join(" ")];
        row.extend(
            columns
                .iter()
                .map(|(q, x)| cell(c.value(m, record, *q), x.kind)),
        );
        table.add_row(row);
    }
    format!("\nRecord {}\n{table}\n{failures}", c.records[record])
}

fn percent(x: f64) -> String {
    if x.is_nan() {
        "-".to_owned()
    } else {
        format!("{:.1}", 100.0 * x)
    }
}

fn spreads(c: &Comparison) -> String {
    let mut table = new_table(&[
        "quantity",
        "between models (%)",
        "between records (%)",
        "greatest / smallest model",
    ]);
    for (q, s) in c.quantities.iter().zip(&c.spreads) {
        let ratio = if s.greatest_ratio.is_nan() {
            "-".to_owned()
        } else {
            format!("{:.2}", s.greatest_ratio)
        };
        table.add_row([
            q.label().replace('_', " "),
            percent(s.between_models),
            percent(s.between_records),
            ratio,
        ]);
    }
    format!("\nSpread, standard deviation over mean\n{table}\n")
}

fn ranking(c: &Comparison) -> String {
    let mut table = new_table(&["quantity", "greatest", "smallest", "agreement of records"]);
    for (q, r) in c.quantities.iter().zip(&c.rankings) {
        let place = |i: usize| {
            let model = r.order.get(i)?;
            let name = c.models[*model].descriptor.name;
            // Round-off around zero is shown without its sign.
            Some(format!("{name} x{:.2}", r.relative[i].max(0.0)))
        };
        let places = |range: Vec<usize>| -> String {
            let all: Vec<_> = range.into_iter().filter_map(place).collect();
            all.join(", ")
        };
        let n = r.order.len();
        let concordance = if r.concordance.is_nan() {
            "-".to_owned()
        } else {
            format!("{:.2}", r.concordance)
        };
        table.add_row([
            q.label().replace('_', " "),
            places((0..n.min(3)).collect()),
            places((n.saturating_sub(3)..n).rev().collect()),
            concordance,
        ]);
    }
    format!(
        "\nRanking: value over the mean of all models, mean over records; agreement is Kendall's W (1: the same order under every record)\n{table}\n"
    )
}

fn conclusions(c: &Comparison) -> String {
    let mut text = "\nConclusions\n".to_owned();
    for x in &c.conclusions {
        let counts: Vec<_> = x
            .counts
            .iter()
            .zip(&c.records)
            .map(|((yes, all), record)| format!("{record} {yes} of {all}"))
            .collect();
        text.push_str(&format!(
            "  {}: {} ({})\n",
            x.statement,
            x.holds.name(),
            counts.join(", ")
        ));
        if x.holds != Holds::ByModel {
            continue;
        }
        for (record, dissenters) in c.records.iter().zip(&x.dissenters) {
            let names = dissenters.iter().map(|m| c.models[*m].descriptor.name);
            let names: Vec<_> = names.collect();
            if !names.is_empty() {
                text.push_str(&format!(
                    "    minority under {record}: {}\n",
                    names.join(", ")
                ));
            }
        }
    }
    text
}

fn remarks(c: &Comparison) -> String {
    let mut text = "\nRemarks\n".to_owned();
    for model in &c.models {
        let name = model.descriptor.name;
        if let Verification::SecondarySources(how) = model.descriptor.verification {
            text.push_str(&format!("  {name} is from secondary sources: {how}\n"));
        }
        let notes = model.calibrated.iter().flatten().flat_map(|g| &g.notes);
        let mut told: Vec<&String> = Vec::new();
        for note in notes {
            if !told.contains(&note) {
                text.push_str(&format!("  {name}: {note}\n"));
                told.push(note);
            }
        }
    }
    text
}
