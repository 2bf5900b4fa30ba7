//! The comparison for people.

use pounding_case::Case;
use pounding_catalogue::numbers::shown_unit;
use pounding_catalogue::wording::{agreeing, counted};
use pounding_gap_element::Verification;
use pounding_study::comparison::{Comparison, Holds, Judgement, Quantity, QuantityKind};
use pounding_time_history::VELOCITY_JUMPS_HAVE_NO_FORCE;

use crate::tables::{G, collapsed, links_stay, new_table, warning_lines};

/// More records than this have no tables of their own.
const LISTED: usize = 6;
/// Rows of a printed table of differences; all are in the JSON object and the CSV file.
const ROWS: usize = 24;

/// Kinds that a table of a record shows.
const SHOWN: [QuantityKind; 15] = [
    QuantityKind::Displacement,
    QuantityKind::StoreyShear,
    QuantityKind::AccelerationAbsolute,
    QuantityKind::Ductility,
    QuantityKind::ResidualDriftRatio,
    QuantityKind::BaseMoment,
    QuantityKind::Impacts,
    QuantityKind::PeakForce,
    QuantityKind::ColumnShear,
    QuantityKind::Opening,
    QuantityKind::LinkForce,
    QuantityKind::LinkDeformation,
    QuantityKind::ApproachVelocity,
    QuantityKind::ImpactEnergy,
    QuantityKind::AchievedRestitution,
];

/// Unit of tables, its size in SI, and digits after the point.
fn shown_in(kind: QuantityKind) -> (&'static str, f64, usize) {
    match kind {
        QuantityKind::Displacement | QuantityKind::Opening | QuantityKind::LinkDeformation => {
            ("mm", 1e-3, 1)
        }
        QuantityKind::DriftRatio | QuantityKind::ResidualDriftRatio => ("%", 1e-2, 3),
        QuantityKind::Ductility => ("-", 1.0, 2),
        QuantityKind::StoreyShear
        | QuantityKind::PeakForce
        | QuantityKind::ColumnShear
        | QuantityKind::LinkForce => ("kN", 1e3, 1),
        QuantityKind::AccelerationAbsolute => ("g", G, 3),
        QuantityKind::BaseMoment => ("kN m", 1e3, 1),
        QuantityKind::Response(response) => {
            let (factor, unit) = shown_unit(response.peak.unit);
            (unit, 1.0 / factor, 3)
        }
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
    text.push_str(links_stay(case));
    text.push_str(&warning_lines(&c.warnings));
    text.push_str(&collapsed(
        (&c.collapsed, c.records.len()),
        ", whatever the model; values and conclusions",
    ));
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
    text.push_str(&storey_differences(c));
    text.push_str(&level_differences(c));
    text.push_str(&remarks(c));
    text
}

fn calibration(c: &Comparison) -> String {
    let mut text = format!(
        "\n{}, calibrated alike: elastic laws of equal {}; restitution {}\n",
        counted(c.models.len(), "model"),
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
        .filter(|(_, q)| SHOWN.contains(&q.kind) || matches!(q.kind, QuantityKind::Response(_)))
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
    let mut isolated = vec!["(no pounding)".to_owned(), "-".to_owned()];
    isolated.extend(
        columns
            .iter()
            .map(|(q, x)| cell(c.isolated[record][*q], x.kind)),
    );
    table.add_row(isolated);
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
    format!(
        "\nRecord {}: {STATISTICS}\n{table}\n{failures}",
        c.records[record]
    )
}

/// What the numbers of the tables are.
const STATISTICS: &str = "of buildings the maximum over storeys; of gaps the sum of impacts and energy over levels, the maximum of force and velocity; \"-\" where there is no value, as of a force without contact";

fn percent(x: f64) -> String {
    if x.is_nan() {
        "-".to_owned()
    } else {
        format!("{:.1}", 100.0 * x)
    }
}

fn spreads(c: &Comparison) -> String {
    let mut table = new_table([
        "quantity",
        "statistic",
        "between models (%)",
        "between records (%)",
        "maximum / minimum of models",
        "records",
    ]);
    for (q, s) in c.quantities.iter().zip(&c.spreads) {
        let ratio = if s.greatest_ratio.is_nan() {
            "-".to_owned()
        } else {
            format!("{:.2}", s.greatest_ratio)
        };
        table.add_row([
            q.label().replace('_', " "),
            q.statistic().to_owned(),
            percent(s.between_models),
            percent(s.between_records),
            ratio,
            format!("{} of {}", s.records, c.records.len()),
        ]);
    }
    format!(
        "\nSpread, standard deviation over mean, over the records with a value, between models of buildings over those under which a contact reaches them\n{table}\n{}{}{}",
        of_zero(c),
        without_contact(c),
        not_reached(c)
    )
}

/// Quantities that some models have not, such as the impact energy of elastic ones.
fn of_zero(c: &Comparison) -> String {
    let mut text = String::new();
    for (q, s) in c.quantities.iter().zip(&c.spreads) {
        if s.models_of_zero > 0 && !s.between_records.is_nan() {
            text.push_str(&format!(
                "{}: zero with {} of {}, left out of the spread between records\n",
                q.label().replace('_', " "),
                s.models_of_zero,
                counted(c.complete().len(), "model"),
            ));
        }
    }
    text
}

/// Records under which some or all models leave a gap open.
fn without_contact(c: &Comparison) -> String {
    let all = c.complete().len();
    let mut text = String::new();
    let gaps = c
        .quantities
        .iter()
        .filter(|q| q.kind == QuantityKind::Impacts);
    for gap in gaps {
        let without = c.records_without_contact(gap.index);
        if !without.is_empty() {
            let names: Vec<_> = without.iter().map(|r| c.records[*r].as_str()).collect();
            text.push_str(&format!(
                "{}: no contact with any model under {} of {}, which {} no force, impulse, approach velocity or restitution and {} left out of the spread between models and the ranking of all that is of the gap: {}\n",
                gap.of,
                without.len(),
                counted(c.records.len(), "record"),
                agreeing(&without.len(), "has", "have"),
                agreeing(&without.len(), "is", "are"),
                names.join(", ")
            ));
        }
        for (r, record) in c.records.iter().enumerate() {
            let some = c.models_in_contact(gap.index, r);
            if some > 0 && some < all {
                text.push_str(&format!(
                    "{}: contact with {some} of {} under {record}; the others are left out there\n",
                    gap.of,
                    counted(all, "model"),
                ));
            }
        }
    }
    text
}

/// Records under which no contact reaches some buildings.
fn not_reached(c: &Comparison) -> String {
    let names = c
        .own
        .iter()
        .flat_map(|r| &r.isolated)
        .map(|b| b.name.as_str());
    let mut said: Vec<(Vec<&str>, Vec<usize>)> = Vec::new();
    for (building, name) in names.take(c.gaps_of_buildings.len()).enumerate() {
        let without = c.records_not_reaching(building);
        match said.iter_mut().find(|(_, records)| *records == without) {
            _ if without.is_empty() => {}
            Some((buildings, _)) => buildings.push(name),
            None => said.push((vec![name], without)),
        }
    }
    let links = match c.quantities.iter().any(Quantity::is_of_link) {
        true => " and those of their links",
        false => "",
    };
    let line = |(buildings, without): &(Vec<&str>, Vec<usize>)| {
        let records: Vec<_> = without.iter().map(|r| c.records[*r].as_str()).collect();
        format!(
            "{}: reached by no contact with any model under {} of {}, which {} left out of the spread between models and the ranking of their peaks{links}: {}\n",
            buildings.join(", "),
            without.len(),
            counted(c.records.len(), "record"),
            agreeing(&without.len(), "is", "are"),
            records.join(", ")
        )
    };
    said.iter().map(line).collect()
}

fn ranking(c: &Comparison) -> String {
    let mut table = new_table(["quantity", "largest", "smallest", "agreement of records"]);
    for (q, r) in c.quantities.iter().zip(&c.rankings) {
        let place = |i: usize| {
            let model = r.order.get(i)?;
            let name = c.models[*model].descriptor.name;
            // Round-off around zero is shown without its sign.
            Some(format!("{name} x{:.2}", r.relative[i].max(0.0)))
        };
        let places = |range: Vec<usize>| -> String {
            let all: Vec<_> = range.into_iter().filter_map(place).collect();
            match all.is_empty() {
                true => "-".to_owned(),
                false => all.join(", "),
            }
        };
        let n = r.order.len();
        let the_same = n > 1 && r.at_the_top().is_empty();
        let concordance = if r.concordance.is_nan() {
            "-".to_owned()
        } else {
            format!("{:.2}", r.concordance)
        };
        let [largest, smallest] = match the_same {
            true => ["the same with all models".to_owned(), String::new()],
            false => [
                places((0..n.min(3)).collect()),
                places((n.saturating_sub(3)..n).rev().collect()),
            ],
        };
        table.add_row([q.label().replace('_', " "), largest, smallest, concordance]);
    }
    format!(
        "\nRanking: value over the mean of all models, mean over records; agreement is Kendall's W (1: the same order under every record)\n{table}\n"
    )
}

fn conclusions(c: &Comparison) -> String {
    let mut text = "\nConclusions\n".to_owned();
    for (model, record, building) in c.collapses() {
        text.push_str(&format!(
            "  pounding brings {building} to collapse: with {} under {}, which what follows cannot count\n",
            c.models[model].descriptor.name, c.records[record]
        ));
    }
    for x in &c.conclusions {
        let start = format!("  {} ({}): ", x.statement, x.statistic);
        text.push_str(&judgement(c, &start, &x.judgement));
        let by_storey = x.by_storey.as_ref();
        let other = |j: &&Judgement| j.counts != x.judgement.counts;
        if let Some(by_storey) = by_storey.filter(other) {
            let start = "    storey by storey, as `pounding gap` answers: ";
            text.push_str(&judgement(c, start, by_storey));
        }
    }
    text
}

/// An answer with its counts, and the minority where the models disagree.
fn judgement(c: &Comparison, start: &str, j: &Judgement) -> String {
    let counts: Vec<_> = j
        .counts
        .iter()
        .zip(&c.records)
        .map(|((yes, all), record)| format!("{record} {yes} of {all}"))
        .collect();
    let mut holds = j.holds.name().to_owned();
    if !c.collapses().is_empty() {
        holds = holds.replace("all models", "all other models");
    }
    let mut text = format!("{start}{holds} ({})\n", counts.join(", "));
    if j.holds != Holds::ByModel {
        return text;
    }
    let indent = &start[..start.len() - start.trim_start().len()];
    let known = c.records.iter().zip(&j.ratios);
    let known = known.filter_map(|(record, range)| {
        let range = ratios((*range)?);
        Some(format!("{record} {range}"))
    });
    let known: Vec<_> = known.collect();
    if !known.is_empty() {
        text.push_str(&format!(
            "{indent}  with pounding over without: {}\n",
            known.join(", ")
        ));
    }
    for (record, dissenters) in c.records.iter().zip(&j.dissenters) {
        let names = dissenters.iter().map(|m| c.models[*m].descriptor.name);
        let names: Vec<_> = names.collect();
        if !names.is_empty() {
            text.push_str(&format!(
                "{indent}  minority under {record}: {}\n",
                names.join(", ")
            ));
        }
    }
    text
}

/// "x0.981 to x1.667", or one of them if they are the same; "-" for none.
fn ratios((low, high): (f64, f64)) -> String {
    if low.is_nan() {
        return "-".to_owned();
    }
    let (low, high) = (format!("x{low:.3}"), format!("x{high:.3}"));
    if low == high {
        high
    } else {
        format!("{low} to {high}")
    }
}

/// Storeys at which pounding does what it does not do to the maximum over storeys.
fn storey_differences(c: &Comparison) -> String {
    let Some(first) = c.own.first().filter(|_| !c.storey_differences.is_empty()) else {
        return String::new();
    };
    let mut table = new_table([
        "building",
        "quantity",
        "storey",
        "at the storey",
        "maximum over storeys",
        "models and records that differ",
        "own law, all records, as `gap`",
    ]);
    for d in c.storey_differences.iter().take(ROWS) {
        let differing: usize = d.models.iter().map(Vec::len).sum();
        let saying: usize = d.models_that_say.iter().sum();
        let own = d.own_at_storey.iter().copied();
        let own = own.fold((f64::NAN, f64::NAN), |(low, high), x| {
            (x.min(low), x.max(high))
        });
        table.add_row([
            first.isolated[d.building].name.clone(),
            d.kind.name().replace('_', " "),
            (d.storey + 1).to_string(),
            ratios(d.at_storey),
            ratios(d.of_maxima),
            format!("{differing} of {saying}"),
            ratios(own),
        ]);
    }
    let more = more(c.storey_differences.len());
    format!(
        "\nStoreys where `pounding gap` answers differently: pounding raises the peak of the storey (above x1) and not the maximum over storeys, or the reverse; ratios to the peaks without pounding, over the models and records that differ\n{table}\n{more}"
    )
}

/// Levels that close, or stay open, against the demand of the isolated buildings.
fn level_differences(c: &Comparison) -> String {
    if c.level_differences.is_empty() {
        return String::new();
    }
    let mut table = new_table([
        "gap",
        "level",
        "record",
        "width (mm)",
        "demand (mm)",
        "demand closes it",
        "models that close it",
        "impacts of the own law",
    ]);
    let all = c.complete().len();
    let rows = c.level_differences.iter().flat_map(|d| {
        let records = 0..c.records.len();
        let differs =
            move |r: &usize| d.models[*r].len() != if d.demand_closes[*r] { all } else { 0 };
        records.filter(differs).map(move |r| (d, r))
    });
    let rows: Vec<_> = rows.collect();
    for (d, r) in rows.iter().take(ROWS) {
        let place = &c.levels[d.gap][d.level];
        let gap = c
            .quantities
            .iter()
            .find(|q| q.kind == QuantityKind::Impacts && q.index == d.gap);
        table.add_row([
            gap.map_or_else(String::new, |q| q.of.clone()),
            place.place.label(),
            c.records[*r].clone(),
            format!("{:.2}", place.width * 1e3),
            format!("{:.2}", d.demand[*r] * 1e3),
            if d.demand_closes[*r] { "yes" } else { "no" }.to_owned(),
            format!("{} of {all}", d.models[*r].len()),
            d.own_impacts[*r].to_string(),
        ]);
    }
    let more = more(rows.len());
    format!(
        "\nLevels where `pounding gap` answers differently: its demand, of the isolated buildings, closes a level that models leave open, or the reverse, as a building that was hit moves otherwise\n{table}\n{more}"
    )
}

/// How many rows a table of differences leaves out.
fn more(rows: usize) -> String {
    match rows.saturating_sub(ROWS) {
        0 => String::new(),
        left => format!("{left} more rows: --json or --csv\n"),
    }
}

fn remarks(c: &Comparison) -> String {
    let mut text = "\nRemarks\n".to_owned();
    for (m, model) in c.models.iter().enumerate() {
        let name = model.descriptor.name;
        if let Verification::SecondarySources(how) = model.descriptor.verification {
            text.push_str(&format!("  {name} is from secondary sources: {how}\n"));
        }
        if c.has_rigid_impacts(m) {
            text.push_str(&format!("  {name}: {VELOCITY_JUMPS_HAVE_NO_FORCE}\n"));
        }
        // What holds in some gaps alone is said with their names.
        let mut notes: Vec<(&String, Vec<&str>)> = Vec::new();
        for (index, own) in model.calibrated.iter().flatten().enumerate() {
            let gap = super::numbers::gap_name(c, index).unwrap_or_default();
            for note in &own.notes {
                match notes.iter_mut().find(|(known, _)| *known == note) {
                    Some((_, gaps)) => gaps.push(gap),
                    None => notes.push((note, vec![gap])),
                }
            }
        }
        for (note, gaps) in notes {
            let of = match gaps.len() == c.references.len() {
                true => String::new(),
                false => format!(", gap {}", gaps.join(" and ")),
            };
            text.push_str(&format!("  {name}{of}: {note}\n"));
        }
    }
    text
}
