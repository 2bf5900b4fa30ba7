//! The page of the result of a sweep.

use pounding_catalogue::wording::{agreeing, counted};
use pounding_study::sensitivity::{Input, Sensitivity, sensitivity};
use pounding_study::{Axis, Coordinate, Layout, Quantity, ResultReader, StudyFileError, fractile};
use pounding_time_history::VELOCITY_JUMPS_HAVE_NO_FORCE;

use super::answer::{in_parentheses, unit_of};
use super::document::Document;
use super::document::listing;
use super::html::{figure, named, note, number, section, sentences, warnings};
use super::numbers::{self, figures};
use super::table::{Column, Row, facts, table};
use crate::error::ReportError;
use crate::figure::{Curve, Panel, figure_of_size};

/// Rows that are read at once.
const BLOCK: usize = 4096;
/// Failures and collapses that are listed.
const LISTED: usize = 20;
/// Parts of the range of a variable that a curve has a point for.
const PARTS: usize = 24;
/// Size of a panel (pixels), as wide as a page.
const SIZE: (u32, u32) = (718, 230);
/// Part of a variance from which on it is worth a sentence.
const WORTH_SAYING: f64 = 0.1;
/// Quantities that have figures: of the run's levels or storeys the greatest.
const DRAWN: [&str; 5] = [
    "impacts",
    "peak_force",
    "peak_displacement",
    "peak_acceleration_absolute",
    "peak_ductility",
];

/// All rows, column by column.
struct Runs {
    /// For each variable its numbers; of choices their places.
    coordinates: Vec<Vec<f64>>,
    /// Columns of the layout.
    values: Vec<Vec<f64>>,
    /// For each row the number of its run.
    numbers: Vec<usize>,
    /// For each row whether a building collapsed.
    fell: Vec<bool>,
    failed: Vec<(usize, String)>,
    collapsed: Vec<(usize, String)>,
}

/// The page of the result of a sweep; `name` is that of its file.
///
/// # Errors
/// A result that cannot be read.
pub fn sweep(result: &ResultReader, name: &str) -> Result<String, ReportError> {
    let runs = read(result).map_err(ReportError::Study)?;
    let d = &result.description;
    // What depends on what is of all runs: a part has some values of some variables alone.
    let sensitivities = match result.description.part.is_whole() {
        true => sensitivities(result, &runs),
        false => Vec::new(),
    };
    let mut points = points(result, &runs);
    points.extend(depends_most(result, &sensitivities));
    let mut body = section("Summary", &(sentences(&points) + &warnings(&d.warnings)));
    body.push_str(&section("What varied", &variables(result, &runs)));
    let mut peaks = statistics(result, &runs);
    if has_rigid_impacts(result, &runs) {
        peaks.insert_str(0, &note(VELOCITY_JUMPS_HAVE_NO_FORCE));
    }
    body.push_str(&section("Peaks over the runs", &peaks));
    if !sensitivities.is_empty() {
        let dependences = dependences(result, &sensitivities);
        body.push_str(&section("What the peaks depend on", &dependences));
    }
    let drawn = figures_of(result, &runs)?;
    if !drawn.is_empty() {
        body.push_str(&section("Over the variables", &drawn));
    }
    for (heading, list) in [
        ("Runs that failed", &runs.failed),
        ("Collapses", &runs.collapsed),
    ] {
        if !list.is_empty() {
            body.push_str(&section(heading, &listed(list)));
        }
    }
    let rows = [
        ("build", d.build.clone()),
        (
            "part",
            match d.part.is_whole() {
                true => String::new(),
                false => d.part.to_string(),
            },
        ),
        ("SHA-256 of the study", d.study_sha256.clone()),
        ("SHA-256 of the records", d.records.clone()),
    ];
    let computed = facts("How it was computed", &rows)
        + &listing("The study file", &d.study)
        + &listing("The case file", &d.case);
    body.push_str(&section("How it was computed", &computed));
    let origin = [
        name.to_owned(),
        format!("pounding {}", d.version),
        "sweep".to_owned(),
    ];
    let document = Document {
        title: &d.title,
        origin: &origin,
        body: &body,
        script: None,
        style: "",
    };
    Ok(document.html())
}

fn read(result: &ResultReader) -> Result<Runs, StudyFileError> {
    let mut runs = Runs {
        coordinates: vec![Vec::new(); result.description.coordinates.len()],
        values: vec![Vec::new(); result.description.layout.columns()],
        numbers: Vec::new(),
        fell: Vec::new(),
        failed: Vec::new(),
        collapsed: Vec::new(),
    };
    let mut first = 0;
    while first < result.rows {
        let last = (first + BLOCK).min(result.rows);
        for (row, coordinates) in result.block(first..last)? {
            for (column, value) in runs.coordinates.iter_mut().zip(coordinates) {
                column.push(match value {
                    pounding_study::Value::Number(x) => x,
                    pounding_study::Value::Choice(place) => place as f64,
                });
            }
            for (column, value) in runs.values.iter_mut().zip(&row.values) {
                column.push(*value);
            }
            runs.numbers.push(row.run);
            runs.fell.push(row.ending.collapsed());
            let diagnosis = row.ending.diagnosis().unwrap_or_default().to_owned();
            if row.ending.failed() {
                runs.failed.push((row.run, diagnosis));
            } else if row.ending.collapsed() {
                runs.collapsed.push((row.run, diagnosis));
            }
        }
        first = last;
    }
    Ok(runs)
}

fn points(result: &ResultReader, runs: &Runs) -> Vec<String> {
    let d = &result.description;
    let layout = &d.layout;
    let mut points = vec![format!(
        "<strong>{}</strong>: {} failed and {} collapsed.",
        counted(result.rows, "run"),
        runs.failed.len(),
        runs.collapsed.len()
    )];
    if !d.part.is_whole() {
        points.push(format!(
            "<strong>A part of the study</strong>, {}: {} of its {}. All that follows is of these.",
            named(&d.part.to_string()),
            result.rows,
            counted(d.runs, "run")
        ));
    }
    let ended = runs.failed.len() + runs.collapsed.len();
    let impacts = columns(layout, "impacts");
    if ended == result.rows {
        points.push(
            match (runs.failed.len(), runs.collapsed.len()) {
                (0, 0) => "There is no run.",
                (0, _) => "No run stood: peaks and impacts are not known.",
                _ => "No run was completed without a collapse: peaks and impacts are not known.",
            }
            .to_owned(),
        );
    } else if !impacts.is_empty() {
        let touches = |row: &usize| impacts.iter().any(|c| runs.values[*c][*row] > 0.0);
        let closed = (0..result.rows).filter(touches).count();
        points.push(format!(
            "In {}{} a gap closes ({:.1}\u{a0}%), with up to {} at a level.",
            counted(closed, "run"),
            match ended {
                0 => String::new(),
                _ => format!(
                    " of the {} that neither failed nor collapsed",
                    result.rows - ended
                ),
            },
            100.0 * closed as f64 / (result.rows - ended) as f64,
            counted_impacts(greatest(runs, &impacts)),
        ));
    }
    for name in &DRAWN[1..] {
        let Some(quantity) = layout.quantities.iter().find(|q| q.name == *name) else {
            continue;
        };
        let found = drawn_columns(result, name);
        let most = greatest(runs, &found);
        let jumps = *name == "peak_force" && has_rigid_impacts(result, runs);
        // Where velocities jump there is no force: zero is that of levels that nothing hits.
        if !most.is_finite() || (jumps && most == 0.0) {
            continue;
        }
        let place = found.iter().find(|c| runs.values[**c].contains(&most));
        let at = place.map(|c| of_column(layout, quantity, c - layout.range(name).start));
        let row = place.and_then(|c| runs.values[*c].iter().position(|x| *x == most));
        let (factor, unit) = unit_of(quantity.unit);
        let from = format!("maximum {name}");
        let most_shown = number(&from, factor, &figures(factor * most));
        points.push(format!(
            "The {} is at most {}{}{}{}{}.",
            quantity
                .long_name
                .replace("maximum ", "peak ")
                .split(',')
                .next()
                .unwrap_or_default(),
            most_shown,
            match unit {
                "" => String::new(),
                unit => format!(" {unit}"),
            },
            at.map_or(String::new(), |at| format!(", at {}", named(&at))),
            row.map_or(String::new(), |row| format!(
                " in run {}",
                runs.numbers[row]
            )),
            match (runs.collapsed.len(), jumps) {
                (0, false) => "",
                (0, true) => "; rigid impacts have none",
                (_, false) => "; of runs that collapsed it is not known",
                (_, true) =>
                    "; rigid impacts have none, and of runs that collapsed it is not known",
            },
        ));
    }
    points
}

/// Whether floors met at a level without a contact force.
fn has_rigid_impacts(result: &ResultReader, runs: &Runs) -> bool {
    let layout = &result.description.layout;
    let [impacts, forces] = ["impacts", "peak_force"].map(|name| columns(layout, name));
    let mut levels = impacts.iter().zip(&forces);
    levels.any(|(impacts, force)| {
        let mut rows = runs.values[*impacts].iter().zip(&runs.values[*force]);
        rows.any(|(impacts, force)| *impacts > 0.0 && force.is_nan())
    })
}

/// Columns of a quantity that has figures. Isolators go through many times the displacement at which they yield, for which
/// they are there: their ductility is none of a storey.
fn drawn_columns(result: &ResultReader, name: &str) -> Vec<usize> {
    let d = &result.description;
    let all = columns(&d.layout, name);
    if name != "peak_ductility" {
        return all;
    }
    let case = d.case.parse::<toml::Table>().unwrap_or_default();
    let buildings = case.get("building").and_then(toml::Value::as_array);
    let on_isolators = buildings.into_iter().flatten().filter_map(|building| {
        building.get("isolator")?;
        building.get("name")?.as_str()
    });
    let on_isolators: Vec<&str> = on_isolators.collect();
    let storeys = all.into_iter().zip(&d.layout.storeys);
    let above = storeys
        .filter(|(_, storey)| storey.storeys != [1] || !on_isolators.contains(&storey.of.as_str()));
    above.map(|(column, _)| column).collect()
}

/// Columns of a quantity among the values of a row.
fn columns(layout: &Layout, name: &str) -> Vec<usize> {
    match layout.quantities.iter().any(|q| q.name == name) {
        true => layout.range(name).collect(),
        false => Vec::new(),
    }
}

fn greatest(runs: &Runs, columns: &[usize]) -> f64 {
    let values = columns.iter().flat_map(|c| &runs.values[*c]);
    values.copied().fold(f64::NAN, f64::max)
}

/// A greatest number of impacts with its noun.
fn counted_impacts(most: f64) -> String {
    let noun = agreeing(&most, "impact", "impacts");
    let shown = number("maximum impacts", 1.0, &most.to_string());
    format!("{shown} {noun}")
}

/// What a column of a quantity is of.
fn of_column(layout: &Layout, quantity: &Quantity, index: usize) -> String {
    let labels = match quantity.axis {
        Axis::Run => return "the run".to_owned(),
        Axis::Storey => &layout.storeys,
        Axis::Level => &layout.levels,
        Axis::LinkLevel => &layout.link_levels,
        Axis::Building => return layout.buildings.get(index).cloned().unwrap_or_default(),
    };
    let place = labels.get(index);
    place.map_or(String::new(), |p| p.label.clone())
}

fn variables(result: &ResultReader, runs: &Runs) -> String {
    let all = &result.description.coordinates;
    let rows = all.iter().zip(&runs.coordinates).map(|(c, values)| {
        let mut known = values.clone();
        known.sort_by(f64::total_cmp);
        known.dedup();
        let range = match &c.choices {
            Some(choices) => choices.join(", "),
            None => {
                let ends = [known.first(), known.last()].map(|x| x.copied().unwrap_or(f64::NAN));
                let unit = match unit_of(&c.unit) {
                    (1.0, unit) => unit,
                    // Multiples are not SI.
                    _ => c.unit.as_str(),
                };
                let range = format!("{} to {} {unit}", figures(ends[0]), figures(ends[1]));
                range.trim_end().to_owned()
            }
        };
        Row::new(
            &c.name,
            vec![
                c.name.clone(),
                c.long_name.clone(),
                range,
                counted(known.len(), "value"),
            ],
        )
    });
    let columns = ["variable", "what it is", "from, to (SI)", "values"].map(Column::new);
    format!(
        "<div class=\"words\">\n{}</div>\n",
        table("Variables", &columns, rows)
    )
}

/// Minimum, median and maximum of every quantity at every place.
fn statistics(result: &ResultReader, runs: &Runs) -> String {
    let layout = &result.description.layout;
    let mut out = String::new();
    for (axis, of) in [
        (Axis::Level, "level"),
        (Axis::Storey, "storey"),
        (Axis::Building, "building"),
        (Axis::LinkLevel, "level of a link"),
    ] {
        let of_axis = layout.quantities.iter().filter(|q| q.axis == axis);
        let mut tables = String::new();
        for quantity in of_axis.filter(|q| !columns(layout, q.name).is_empty()) {
            let head = quantity.long_name.to_owned() + &in_parentheses(quantity.unit);
            let (factor, _) = unit_of(quantity.unit);
            let from = format!("{}[:,*]", quantity.name);
            let statistic = |word: &str| {
                let from = format!("{} {from}", word.replace(' ', ""));
                Column::of(word, from, factor).below(&head)
            };
            let columns_shown = [
                Column::new(of),
                statistic("minimum"),
                statistic("16 %"),
                statistic("median"),
                statistic("84 %"),
                statistic("maximum"),
                Column::count_of("runs", format!("known {from}")).below(&head),
            ];
            let rows = columns(layout, quantity.name).into_iter().enumerate();
            let rows = rows.map(|(i, c)| {
                let mut cells = vec![of_column(layout, quantity, i)];
                cells.extend(cells_of(&runs.values[c], quantity));
                Row::new(i, cells)
            });
            tables.push_str(&table(quantity.long_name, &columns_shown, rows));
        }
        out.push_str(&format!("<div class=\"tables\">\n{tables}</div>\n"));
    }
    let of_run = layout.quantities.iter().filter(|q| q.axis == Axis::Run);
    let rows: Vec<Row> = of_run
        .filter_map(|quantity| {
            let column = *columns(layout, quantity.name).first()?;
            let head = quantity.long_name.to_owned() + &in_parentheses(quantity.unit);
            let mut cells = vec![head];
            cells.extend(cells_of(&runs.values[column], quantity));
            Some(Row::new(quantity.name, cells))
        })
        .collect();
    let mut columns_shown = vec![Column::new("of the run")];
    for word in ["minimum", "16 %", "median", "84 %", "maximum"] {
        let from = format!("{} *", word.replace(' ', ""));
        columns_shown.push(Column::in_unit_of_row(word, from));
    }
    columns_shown.push(Column::count_of("runs", "known *"));
    if !rows.is_empty() {
        out.push_str(&table("Of the run", &columns_shown, rows));
    }
    let collapsed = match runs.collapsed.len() {
        0 => String::new(),
        n => format!(
            " {} collapsed, of which only isolated demands and peaks are known: all other numbers are of the runs that stood.",
            counted(n, "run")
        ),
    };
    out + &note(&format!(
        "Runs: those in which the quantity has a value; a time of first contact, for one, is of runs with contact.{collapsed}"
    ))
}

/// Minimum, fractiles and maximum of a column, and how many runs have a value.
fn cells_of(values: &[f64], quantity: &Quantity) -> [String; 6] {
    let (factor, _) = unit_of(quantity.unit);
    // Demands of buildings that collapse by themselves are infinite, and so known.
    let mut known: Vec<f64> = values.iter().copied().filter(|x| !x.is_nan()).collect();
    known.sort_by(f64::total_cmp);
    let [least, most] = [known.first(), known.last()].map(|x| x.copied().unwrap_or(f64::NAN));
    let shown = |x: f64| match quantity.name {
        "impacts" if x.fract() == 0.0 => x.to_string(),
        _ if x == f64::INFINITY => "infinite".to_owned(),
        name => numbers::figures_of(name, factor * x),
    };
    [
        shown(least),
        shown(fractile(&known, 0.16)),
        shown(fractile(&known, 0.5)),
        shown(fractile(&known, 0.84)),
        shown(most),
        known.len().to_string(),
    ]
}

/// The greatest value of a quantity in a run; infinite where a building collapsed.
fn of_run(runs: &Runs, name: &str, columns: &[usize], row: usize) -> f64 {
    let values = columns.iter().map(|c| runs.values[*c][row]);
    if runs.fell[row] {
        return f64::INFINITY;
    }
    // A run with a level of unknown force has no maximum of it: that of its other
    // levels, often zero, is not the run's.
    let unknown = name == "peak_force" && values.clone().any(f64::is_nan);
    match unknown {
        true => f64::NAN,
        false => values.fold(f64::NAN, f64::max),
    }
}

/// Of quantities whose figures are drawn, what they are called and on which variables the greatest value of a run
/// depends.
fn sensitivities<'r>(result: &'r ResultReader, runs: &Runs) -> Vec<(&'r str, Sensitivity)> {
    let d = &result.description;
    let inputs = d.coordinates.iter().zip(&runs.coordinates);
    let inputs = inputs.map(|(coordinate, values)| Input {
        values,
        are_choices: coordinate.choices.is_some(),
    });
    let inputs: Vec<Input<'_>> = inputs.collect();
    let found = DRAWN.iter().filter_map(|name| {
        let of = drawn_columns(result, name);
        let quantity = d.layout.quantities.iter().find(|q| q.name == *name)?;
        let rows = 0..runs.numbers.len();
        let values: Vec<f64> = rows.map(|row| of_run(runs, name, &of, row)).collect();
        let heading = quantity.long_name.split(',').next().unwrap_or_default();
        Some((heading, sensitivity(&values, &inputs)?))
    });
    found.collect()
}

/// A part of the variance, of which chance explains another one at most.
fn percent(part: f64, by_chance: f64) -> String {
    match (part.is_nan(), part < by_chance) {
        (true, _) => "–".to_owned(),
        (_, true) => format!("below {:.0}\u{a0}%", (100.0 * by_chance).ceil()),
        _ => format!("{:.0}\u{a0}%", 100.0 * part),
    }
}

/// The variable on which each quantity depends most, in words.
fn depends_most(result: &ResultReader, found: &[(&str, Sensitivity)]) -> Option<String> {
    let coordinates = &result.description.coordinates;
    let most = found.iter().filter_map(|(heading, sensitivity)| {
        let parts = sensitivity.first_order.iter().zip(&sensitivity.by_chance);
        let (coordinate, (part, _)) = coordinates
            .iter()
            .zip(parts)
            .filter(|(_, (part, by_chance))| **part >= by_chance.max(WORTH_SAYING))
            .max_by(|a, b| a.1.0.total_cmp(b.1.0))?;
        Some((heading, named(&coordinate.name), percent(*part, 0.0)))
    });
    let said = most.enumerate().map(|(i, (heading, name, part))| match i {
        0 => format!("the {heading} varies most with {name} ({part} of its variance)"),
        _ => format!("the {heading} with {name} ({part})"),
    });
    let said: Vec<String> = said.collect();
    (!said.is_empty()).then(|| format!("Over the runs {}.", said.join(", ")))
}

/// What part of the variance of each quantity every variable explains by itself.
fn dependences(result: &ResultReader, found: &[(&str, Sensitivity)]) -> String {
    let d = &result.description;
    let of_variable = |(i, coordinate): (usize, &Coordinate)| {
        let part = |s: &Sensitivity| percent(s.first_order[i], s.by_chance[i]);
        let parts = found.iter().map(|(_, s)| part(s));
        let cells = std::iter::once(coordinate.name.clone()).chain(parts);
        Row::new(&coordinate.name, cells.collect())
    };
    let mut rows: Vec<Row> = d.coordinates.iter().enumerate().map(of_variable).collect();
    let of_combinations: Option<Vec<f64>> = found.iter().map(|(_, s)| s.combinations).collect();
    let is_grid = found.iter().all(|(_, s)| s.is_grid);
    let how = match of_combinations {
        Some(parts) => {
            let parts = parts.into_iter().map(|part| percent(part, 0.0));
            let cells = std::iter::once("combinations of them".to_owned()).chain(parts);
            rows.push(Row::new("combinations", cells.collect()));
            "exact for these runs, which are all combinations; what no variable explains by itself is of combinations"
        }
        None if is_grid => {
            "by the means over all combinations but those of runs without a value, which are left out"
        }
        None => {
            "estimated from the runs, by a mean that is linear between quantiles of the variable, less what chance explains; \"below\" stands where chance alone may give as much (5 % of variables without influence have more). What is missing to 100 % is of combinations, of variables that go together, and of what is finer than so few runs show"
        }
    };
    let headings = found.iter().map(|(heading, _)| *heading);
    let headings = std::iter::once("variable").chain(headings);
    let columns: Vec<Column> = headings.map(Column::new).collect();
    table("What the peaks depend on", &columns, rows)
        + &note(&format!(
            "How much of the variance of the greatest value of a run each variable explains by itself (first-order sensitivity index): {how}. It holds for the ranges that varied here."
        ))
}

/// Fractiles of the greatest value of a run over each variable.
fn figures_of(result: &ResultReader, runs: &Runs) -> Result<String, ReportError> {
    let d = &result.description;
    let mut out = String::new();
    for (c, coordinate) in d.coordinates.iter().enumerate() {
        if coordinate.choices.is_some() {
            continue;
        }
        let groups = groups(&runs.coordinates[c]);
        if groups.len() < 2 {
            continue;
        }
        let (scale, _) = unit_of(&coordinate.unit);
        let mut panels = Vec::new();
        for name in DRAWN {
            let found = drawn_columns(result, name);
            let Some(quantity) = d.layout.quantities.iter().find(|q| q.name == name) else {
                continue;
            };
            let (factor, _) = unit_of(quantity.unit);
            let of_row = |row: &usize| factor * of_run(runs, name, &found, *row);
            let curve = |name: &str, part: f64| Curve {
                name: name.to_owned(),
                points: groups
                    .iter()
                    .filter_map(|(x, rows)| {
                        let mut known: Vec<f64> =
                            rows.iter().map(of_row).filter(|y| !y.is_nan()).collect();
                        known.sort_by(f64::total_cmp);
                        let y = fractile(&known, part);
                        y.is_finite().then_some((scale * x, y))
                    })
                    .collect(),
            };
            panels.push(Panel {
                caption: format!(
                    "{}, maximum of a run{}",
                    quantity.long_name.split(',').next().unwrap_or_default(),
                    in_parentheses(quantity.unit)
                ),
                horizontal: coordinate.long_name.clone() + &in_parentheses(&coordinate.unit),
                curves: vec![
                    curve("median", 0.5),
                    curve("16 %", 0.16),
                    curve("84 %", 0.84),
                ],
            });
        }
        if panels
            .iter()
            .all(|p| p.curves.iter().all(|c| c.points.is_empty()))
        {
            continue;
        }
        let words = format!("Peaks of the runs over {}", coordinate.long_name);
        out.push_str(&figure(&figure_of_size(&panels, SIZE), &words));
    }
    if !out.is_empty() && !runs.collapsed.is_empty() {
        out.push_str(&note(
            "Runs that collapsed count as above everything: a curve has no point where its share of the runs lies among them.",
        ));
    }
    Ok(out)
}

/// Rows with the same value of a variable, or in the same part of its range: their mean and
/// places.
fn groups(values: &[f64]) -> Vec<(f64, Vec<usize>)> {
    let mut order: Vec<usize> = (0..values.len())
        .filter(|i| values[*i].is_finite())
        .collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let same = order.chunk_by(|a, b| values[*a] == values[*b]);
    let same: Vec<&[usize]> = same.collect();
    let parts: Vec<Vec<usize>> = match same.len() <= 2 * PARTS {
        true => same.into_iter().map(<[usize]>::to_vec).collect(),
        false => {
            let size = order.len().div_ceil(PARTS);
            order.chunks(size).map(<[usize]>::to_vec).collect()
        }
    };
    let mean = |rows: &[usize]| rows.iter().map(|r| values[*r]).sum::<f64>() / rows.len() as f64;
    parts.into_iter().map(|rows| (mean(&rows), rows)).collect()
}

fn listed(list: &[(usize, String)]) -> String {
    let columns = ["run", "why"].map(Column::new);
    let rows = list
        .iter()
        .take(LISTED)
        .map(|(run, why)| Row::new(run, vec![format!("run {run}"), why.clone()]));
    let html = format!(
        "<div class=\"words\">\n{}</div>\n",
        table("Runs", &columns, rows)
    );
    match list.len().checked_sub(LISTED) {
        Some(more @ 1..) => {
            html + &note(&format!("{more} more in the group failures of the result."))
        }
        _ => html,
    }
}
