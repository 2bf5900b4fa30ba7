//! The page of the result of a sweep.

use pounding_catalogue::wording::counted;
use pounding_study::sensitivity::{Input, Sensitivity, sensitivity};
use pounding_study::{Axis, Coordinate, Quantity, ResultReader, StudyFileError, fractile};
use pounding_time_history::VELOCITY_JUMPS_HAVE_NO_FORCE;

use super::answer::{in_parentheses, unit_of};
use super::document::Document;
use super::document::listing;
use super::html::{figure, named, note, section, sentences, warnings};
use super::numbers::{self, figures};
use super::sentence::Sentence;
use super::sweep_answer::{DRAWN, SweepAnswer, columns, drawn_columns, of_column};
use super::table::{Column, Row, facts, table};
use crate::chart;
use crate::error::ReportError;
use crate::figure::{Curve, Panel, plots, plots_of_size};

/// Failures and collapses that are listed.
const LISTED: usize = 20;
/// Parts of the range of a variable that a curve has a point for.
const PARTS: usize = 24;
/// Size of a panel (pixels), as wide as a page.
const SIZE: (u32, u32) = (718, 230);
/// Greatest over least value of a variable from which on its axis may be logarithmic.
const LOGARITHMIC_FROM: f64 = 5.0;
/// Energies that laws dissipate.
const DISSIPATED: [&str; 3] = ["energy_dissipated", "energy_hysteretic", "energy_impact"];
/// Part of a variance from which on it is worth a sentence.
const WORTH_SAYING: f64 = 0.1;
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
    let answer = SweepAnswer::of(result).map_err(ReportError::Study)?;
    let mut points = counts(result, &answer);
    points.extend(answer.sentences().iter().map(Sentence::html));
    points.extend(depends_most(result, &runs, &sensitivities));
    let mut body = section("Summary", &(sentences(&points) + &warnings(&d.warnings)));
    body.push_str(&section("What varied", &variables(result, &runs)));
    let mut peaks = statistics(result, &runs);
    if answer.rigid_impacts {
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
    result.each(|row, coordinates| {
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
        Ok::<(), StudyFileError>(())
    })?;
    leave_out_round_off(result, &mut runs);
    Ok(runs)
}

/// Takes what round-off leaves of the energy that elastic laws dissipate for zero, where the input energy of runs is stored.
fn leave_out_round_off(result: &ResultReader, runs: &mut Runs) {
    let layout = &result.description.layout;
    let Some(input) = columns(layout, "energy_input").first().copied() else {
        return;
    };
    let input = runs.values[input].clone();
    for name in DISSIPATED {
        for column in columns(layout, name) {
            for (value, input) in runs.values[column].iter_mut().zip(&input) {
                *value = numbers::without_round_off(*value, *input);
            }
        }
    }
}

/// How many runs there are, and of what.
fn counts(result: &ResultReader, answer: &SweepAnswer) -> Vec<String> {
    let d = &result.description;
    let runs = Sentence::default()
        .emphasis(counted(result.rows, "run"))
        .words(format!(
            ": {} failed and {} collapsed.",
            answer.failed, answer.collapsed
        ));
    let part = (!d.part.is_whole()).then(|| {
        Sentence::default()
            .emphasis("A part of the study")
            .words(", ")
            .name(d.part.to_string())
            .words(format!(
                ": {} of its {}. All that follows is of these.",
                result.rows,
                counted(d.runs, "run")
            ))
    });
    let told = std::iter::once(runs).chain(part);
    told.map(|sentence| sentence.html()).collect()
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

/// The variable on which each quantity depends most, in words; among those that the runs tell, where they do not tell all.
fn depends_most(
    result: &ResultReader,
    runs: &Runs,
    found: &[(&str, Sensitivity)],
) -> Option<String> {
    let coordinates = &result.description.coordinates;
    let most = found.iter().filter_map(|(heading, sensitivity)| {
        let parts = sensitivity.first_order.iter().zip(&sensitivity.by_chance);
        let (coordinate, (part, _)) = coordinates
            .iter()
            .zip(parts)
            .filter(|(_, (part, by_chance))| **part >= by_chance.max(WORTH_SAYING))
            .max_by(|a, b| a.1.0.total_cmp(b.1.0))?;
        let varies = |i: &usize| {
            runs.coordinates[*i]
                .windows(2)
                .any(|pair| pair[0] != pair[1])
        };
        let open: Vec<String> = (0..coordinates.len())
            .filter(|i| sensitivity.first_order[*i].is_nan() && varies(i))
            .map(|i| named(&coordinates[i].name))
            .collect();
        let left_out = match sensitivity.left_out {
            0 => String::new(),
            n => format!(", without {} that have no value", counted(n as u64, "run")),
        };
        Some((
            heading,
            named(&coordinate.name),
            percent(*part, 0.0),
            left_out,
            open,
        ))
    });
    let said = most
        .enumerate()
        .map(|(i, (heading, name, part, left_out, open))| {
            let (varies, of_variance) = match i {
                0 => (" varies most", " of its variance"),
                _ => ("", ""),
            };
            let told = format!("the {heading}{varies} with {name} ({part}{of_variance}{left_out})");
            match open.is_empty() {
                true => told,
                false => format!(
                    "{told} among the variables whose part they tell, unlike that of {}",
                    open.join(" or ")
                ),
            }
        });
    let said: Vec<String> = said.collect();
    (!said.is_empty()).then(|| format!("Over the runs {}.", said.join("; ")))
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
    let is_grid = found.iter().all(|(_, s)| s.is_grid);
    let how = match is_grid {
        true => {
            let parts = found.iter().map(|(_, s)| s.combinations);
            let parts = parts.map(|part| percent(part.unwrap_or(f64::NAN), 0.0));
            let cells = std::iter::once("combinations of them".to_owned()).chain(parts);
            rows.push(Row::new("combinations", cells.collect()));
            "exact for these runs, which are all combinations; what no variable explains by itself is of combinations"
        }
        false => {
            "estimated from the runs, by a mean that is linear between quantiles of the variable, less what chance explains; \"below\" stands where chance alone may give as much (5 % of variables without influence have more). What is missing to 100 % is of combinations, of variables that go together, and of what is finer than so few runs show"
        }
    };
    let lacking: Vec<&str> = found
        .iter()
        .filter(|(_, s)| s.lacks_values)
        .map(|(heading, _)| *heading)
        .collect();
    let overlaps = match lacking.is_empty() {
        true => String::new(),
        false => note(&format!(
            "No parts are told of {}: runs have no value of it, so that those that have one are not all combinations, the variables go together in them, and the parts that they explain overlap.",
            lacking.join(", of ")
        )),
    };
    if lacking.len() == found.len() {
        return overlaps;
    }
    let headings = found.iter().map(|(heading, _)| *heading);
    let headings = std::iter::once("variable").chain(headings);
    let columns: Vec<Column> = headings.map(Column::new).collect();
    table("What the peaks depend on", &columns, rows)
        + &note(&format!(
            "How much of the variance of the greatest value of a run each variable explains by itself (first-order sensitivity index): {how}. It holds for the ranges that varied here."
        ))
        + &overlaps
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
        let mut drawn = plots(&panels, &[]);
        if is_spaced_logarithmically(&runs.coordinates[c]) {
            for plot in &mut drawn {
                plot.horizontal = chart::Axis::logarithmic(&plot.horizontal.label);
            }
        }
        out.push_str(&figure(&plots_of_size(drawn, SIZE), &words));
    }
    if !out.is_empty() && !runs.collapsed.is_empty() {
        out.push_str(&note(
            "Runs that collapsed count as above everything: a curve has no point where its share of the runs lies among them.",
        ));
    }
    Ok(out)
}

/// Whether values lie evenly rather in their logarithms than by themselves, over a factor that shows it: on a linear axis
/// most of them would stand at its beginning.
fn is_spaced_logarithmically(values: &[f64]) -> bool {
    let mut known: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
    known.sort_by(f64::total_cmp);
    known.dedup();
    let (Some(&least), Some(&most)) = (known.first(), known.last()) else {
        return false;
    };
    if least <= 0.0 || most < LOGARITHMIC_FROM * least {
        return false;
    }
    // How far the middle value stands from the middle of the axis, as a part of it.
    let middle = fractile(&known, 0.5);
    let linear = (middle - least) / (most - least) - 0.5;
    let logarithmic = (middle / least).ln() / (most / least).ln() - 0.5;
    logarithmic.abs() < linear.abs()
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

#[cfg(test)]
mod tests {
    use super::is_spaced_logarithmically;

    #[test]
    fn axes_follow_the_spacing_of_values() {
        let of = |count: i32, value: fn(f64) -> f64| -> Vec<f64> {
            (0..count).map(|i| value(f64::from(i))).collect()
        };
        assert!(is_spaced_logarithmically(&of(7, f64::exp2)));
        assert!(is_spaced_logarithmically(&[5.0, 10.0, 20.0, 50.0, 100.0]));
        // Over less than a factor of five both look alike; zero has no logarithm.
        assert!(!is_spaced_logarithmically(&of(3, f64::exp2)));
        assert!(!is_spaced_logarithmically(&[0.0, 1.0, 10.0, 100.0]));
        assert!(!is_spaced_logarithmically(&of(12, |i| 5.0 + 5.0 * i)));
        assert!(!is_spaced_logarithmically(&[f64::NAN]));
    }
}
