//! The page of records: what files hold, and measures of their accelerations.

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_catalogue::wording::counted;
use serde_json::Value;

use super::answer::Answer;
use super::html::{named, note, section, sentences, warnings};
use super::studies::pictures;
use super::table::Column;
use crate::answer_file::{Inputs, Picture};

/// Measures: words with unit, path below `measures`.
const MEASURES: [(&str, &str); 21] = [
    ("peak acceleration PGA (g)", "peak_acceleration/value"),
    ("time of PGA (s)", "peak_acceleration/time"),
    ("peak velocity PGV (cm/s)", "peak_velocity/value"),
    ("time of PGV (s)", "peak_velocity/time"),
    ("peak displacement PGD (cm)", "peak_displacement/value"),
    ("time of PGD (s)", "peak_displacement/time"),
    ("Arias intensity (m/s)", "arias_intensity"),
    (
        "cumulative absolute velocity (m/s)",
        "cumulative_absolute_velocity",
    ),
    (
        "standardised CAV (m/s)",
        "standardised_cumulative_absolute_velocity",
    ),
    ("Housner intensity (m)", "housner_intensity"),
    (
        "acceleration spectrum intensity (m/s)",
        "acceleration_spectrum_intensity",
    ),
    (
        "characteristic intensity (m^1.5/s^2.5)",
        "characteristic_intensity",
    ),
    (
        "specific energy density (m\u{b2}/s)",
        "specific_energy_density",
    ),
    (
        "root mean square acceleration over 5 to 95 % (m/s\u{b2})",
        "root_mean_square_acceleration",
    ),
    ("PGV / PGA (s)", "velocity_to_acceleration"),
    ("mean period (s)", "mean_period"),
    ("predominant period (s)", "predominant_period"),
    ("uniform duration (s)", "uniform_duration"),
    ("velocity at the end (cm/s)", "end_velocity"),
    ("displacement at the end (cm)", "end_displacement"),
    (
        "threshold of durations (m/s\u{b2})",
        "options/duration_threshold",
    ),
];
/// Spans: words, path below `measures`.
const SPANS: [(&str, &str); 3] = [
    ("significant, 5 to 95 %", "significant_5_95"),
    ("significant, 5 to 75 %", "significant_5_75"),
    ("bracketed", "bracketed"),
];

/// The page of what `motion info --json` prints.
#[must_use]
pub fn motion(answer: &Value, drawn: &[Picture], inputs: &Inputs) -> String {
    let answer = Answer(answer);
    let mut points = Vec::new();
    let mut warned = Vec::new();
    let mut tables = String::new();
    for (f, file) in answer.list("/files").iter().enumerate() {
        let name = file["file"].as_str().unwrap_or_default();
        let series = file["series"].as_array().map_or(&[][..], Vec::as_slice);
        for (s, one) in series.iter().enumerate() {
            let at = format!("/files/{f}/series/{s}");
            for warning in answer.list(&format!("{at}/warnings")) {
                warned.push(format!("{name}: {}", warning.as_str().unwrap_or_default()));
            }
            if one["measures"].is_null() {
                continue;
            }
            points.push(format!(
                "<strong>{}{}:</strong> peak {} g at {} s; 5 to 95 % of its Arias intensity of {} m/s {}.",
                named(base(name)),
                match one["component"].as_str().unwrap_or_default() {
                    "" => String::new(),
                    component => format!(", {}", named(component)),
                },
                answer.say(&format!("{at}/measures/peak_acceleration/value"), 1.0 / STANDARD_GRAVITY),
                answer.say(&format!("{at}/measures/peak_acceleration/time"), 1.0),
                answer.say(&format!("{at}/measures/arias_intensity"), 1.0),
                significant(answer, &at),
            ));
        }
        tables.push_str(&section(base(name), &of_file(answer, f, file, series)));
    }
    if points.is_empty() {
        points.push("There is no acceleration to measure.".to_owned());
    }
    let mut body = section("Summary", &(sentences(&points) + &warnings(&warned)));
    if !drawn.is_empty() {
        body.push_str(&section("Figures", &pictures(drawn)));
    }
    inputs.page(&(body + &tables))
}

/// The name of a file without its folders.
fn base(file: &str) -> &str {
    file.rsplit(['/', '\\']).next().unwrap_or(file)
}

/// The significant duration by its ends.
fn significant(answer: Answer<'_>, at: &str) -> String {
    let end = |which: &str| format!("{at}/measures/significant_5_95/{which}");
    format!(
        "from {} to {} s",
        answer.say(&end("start"), 1.0),
        answer.say(&end("end"), 1.0)
    )
}

fn of_file(answer: Answer<'_>, f: usize, file: &Value, series: &[Value]) -> String {
    let text = |key: &str| named(file[key].as_str().unwrap_or_default());
    let mut out = format!(
        "<p>{}<br>\nformat {}, {}, SHA-256 {}</p>\n",
        named(
            series
                .first()
                .map_or("", |s| s["title"].as_str().unwrap_or_default())
        ),
        text("format"),
        counted(series.len(), "series"),
        text("sha256"),
    );
    let of = |path: &str| format!("/files/{f}/series/*/{path}");
    let columns = [
        Column::new("component"),
        Column::of("channel", of("channel"), 1.0),
        Column::words_of("quantity", of("quantity")),
        Column::words_of("unit in file", of("unit_in_file")),
        Column::of("samples", of("samples"), 1.0),
        Column::of("time step (s)", of("time_step"), 1.0),
        Column::of("value", of("peak/value"), 1.0).below("peak (SI)"),
        Column::of("at (s)", of("peak/time"), 1.0).below("peak (SI)"),
        Column::words_of("processing", of("processing")),
    ];
    let head = |s: &Value| s["component"].as_str().unwrap_or_default().to_owned();
    let rows = series
        .iter()
        .enumerate()
        .map(|(i, s)| (i.to_string(), head(s)));
    out.push_str(&answer.table("Series", &columns, rows));
    let measured: Vec<usize> = (0..series.len())
        .filter(|s| !series[*s]["measures"].is_null())
        .collect();
    for s in &measured {
        let of = |path: &str| format!("/files/{f}/series/{s}/measures/{path}");
        let of_component = match head(&series[*s]).as_str() {
            "" => String::new(),
            component => format!(" of {}", named(component)),
        };
        out.push_str(&format!("<h3>Measures{of_component}</h3>\n"));
        // One row for each measure, whose path stands for `*`.
        let columns = [
            Column::new("measure"),
            Column::in_unit_of_row("value", of("*")),
        ];
        let measures = MEASURES.map(|(words, path)| (path.to_owned(), words.to_owned()));
        out.push_str(&answer.table("Measures", &columns, measures));
        let columns = [
            Column::new("duration"),
            Column::of("from (s)", of("*/start"), 1.0),
            Column::of("to (s)", of("*/end"), 1.0),
        ];
        let spans = SPANS.map(|(words, path)| (path.to_owned(), words.to_owned()));
        out.push_str(&answer.table("Durations", &columns, spans));
    }
    let history: Vec<&str> = series
        .iter()
        .flat_map(|s| s["history"].as_array().into_iter().flatten())
        .filter_map(Value::as_str)
        .collect();
    for line in history {
        out.push_str(&note(line));
    }
    out
}
