//! The page of an incremental dynamic analysis.

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_catalogue::wording::counted;
use serde_json::Value;

use super::answer::{Answer, in_parentheses, spoken, unit_of};
use super::html::{named, note, section, section_of, sentences, warnings};
use super::numbers::figures;
use super::studies::{pictures, rows};
use super::table::Column;
use crate::answer_file::{Inputs, Picture};

/// Demands side by side in a table.
const BESIDE: usize = 4;

/// What stands before a frequency that is an upper bound.
fn at_most(answer: Answer<'_>, path: &str) -> &'static str {
    match answer.text(path) {
        "upper bound" => "at most ",
        _ => "",
    }
}

/// The page of what `ida --json` prints.
#[must_use]
pub fn ida(answer: &Value, drawn: &[Picture], inputs: &Inputs) -> String {
    let answer = Answer(answer);
    let mut body = section(
        "How likely is pounding?",
        &(sentences(&points(answer)) + &warnings(&inputs.warnings)),
    );
    body.push_str(&section(
        "Fragility",
        &(pictures(drawn) + &fits(answer, "/limits")),
    ));
    for (g, gap) in answer.list("/gaps").iter().enumerate() {
        let widths = format!("/gaps/{g}/widths");
        if !answer.list(&widths).is_empty() {
            let name = gap["gap"].as_str().unwrap_or_default();
            let title = ["By width of the gap ", name, ""];
            let remarks = sentences(&of_widths(gap));
            body.push_str(&section_of(title, &(fits(answer, &widths) + &remarks)));
        }
    }
    body.push_str(&section("Runs by intensity", &counts(answer)));
    let remarks = 0..answer.list("/remarks").len();
    let remarks: Vec<String> = remarks
        .map(|r| format!("{}.", answer.quote(&format!("/remarks/{r}"))))
        .collect();
    let said = match remarks.is_empty() {
        true => String::new(),
        false => sentences(&remarks),
    };
    body.push_str(&section("Demands by intensity", &(said + &demands(answer))));
    if !answer.at("/hazard").is_null() {
        body.push_str(&section("Hazard at the site", &hazard(answer)));
    }
    inputs.page(&body)
}

fn points(answer: Answer<'_>) -> Vec<String> {
    let target = answer.at("/target_frequency").as_f64();
    let mut points = Vec::new();
    for l in 0..answer.list("/limits").len() {
        let at = |path: &str| format!("/limits/{l}/{path}");
        let name = answer.quote(&at("name"));
        let (scale, unit) = intensity_of(answer);
        let unit = named(unit);
        let mut sentence = format!("<strong>{name}:</strong> ");
        sentence.push_str(&match answer.text(&at("fit/kind")) {
            "lognormal" => format!(
                "median intensity {} {unit} ({} to {} at {} confidence), dispersion {}",
                answer.say(&at("fit/median"), scale),
                answer.say(&at("fit/median_bounds/0"), scale),
                answer.say(&at("fit/median_bounds/1"), scale),
                answer.say_percent(&at("fit/confidence")),
                answer.say(&at("fit/dispersion"), 1.0),
            ),
            "step" if answer.at(&at("fit/lower")).as_f64() == Some(0.0) => {
                match answer.at(&at("fit/upper")).is_null() {
                    true => "one intensity gives no fragility".to_owned(),
                    false => format!(
                        "reached by some at the lowest intensity already, by all from {} {unit} on",
                        answer.say(&at("fit/upper"), scale)
                    ),
                }
            }
            "step" => format!(
                "first reached above {} {unit}",
                answer.say(&at("fit/lower"), scale)
            ),
            "never" => format!(
                "not reached up to {} {unit}",
                answer.say(&at("fit/up_to"), scale)
            ),
            "always" => format!(
                "reached by all from {} {unit} on",
                answer.say(&at("fit/from"), scale)
            ),
            _ => "the counts give no fragility".to_owned(),
        });
        if !answer.at(&at("mean_annual_frequency")).is_null() {
            sentence.push_str(&format!(
                "; mean annual frequency {}{} 1/year",
                at_most(answer, &at("mean_annual_frequency_is")),
                answer.say(&at("mean_annual_frequency"), 1.0)
            ));
        }
        // Bounds without their frequency would stand beside the dispersion.
        let known = !answer.at(&at("mean_annual_frequency")).is_null();
        if known && !answer.at(&at("mean_annual_frequency_bounds")).is_null() {
            let confidence = match answer.at(&at("fit/confidence")).is_null() {
                true => String::new(),
                false => format!(
                    " at {} confidence",
                    answer.say_percent(&at("fit/confidence"))
                ),
            };
            let range = range_of(answer, &at("mean_annual_frequency_bounds"));
            sentence.push_str(&format!(
                " ({range}{confidence}, by a bootstrap over the records)"
            ));
        }
        points.push(sentence + ".");
        let remarks = 0..answer.list(&at("remarks")).len();
        points.extend(
            remarks.map(|r| format!("{name}: {}.", answer.quote(&at(&format!("remarks/{r}"))))),
        );
    }
    let of_level = |level: &Value| level["collapsed"].as_u64();
    let collapsed: u64 = answer.list("/levels").iter().filter_map(of_level).sum();
    if collapsed > 0 {
        points.push(format!(
            "<strong>In {} a building collapses</strong>, which counts as pounding and as reaching every limit.",
            counted(collapsed as usize, "run")
        ));
    }
    for (g, gap) in answer.list("/gaps").iter().enumerate() {
        let at = |path: &str| format!("/gaps/{g}/{path}");
        let name = named(gap["gap"].as_str().unwrap_or_default());
        let minimum = &gap["minimum"];
        let Some(target) = target.filter(|_| minimum.is_object()) else {
            continue;
        };
        let asked = figures(target);
        let frequency = format!(
            "{}{}",
            at_most(answer, &at("minimum/mean_annual_frequency_is")),
            answer.say(&at("minimum/mean_annual_frequency"), 1.0)
        );
        let bounds = at("minimum/mean_annual_frequency_bounds");
        let bounds = match answer.at(&bounds).is_null() {
            true => String::new(),
            false => format!(" ({})", range_of(answer, &bounds)),
        };
        points.push(match minimum["width"].is_null() {
            false => format!(
                "<strong>Gap {name} needs {}{} mm</strong> for a mean annual frequency of {asked} 1/year; there it \
                 is {frequency} 1/year{bounds}.",
                if minimum["upper_bound"] == true { "at most " } else { "" },
                answer.say(&at("minimum/width"), 1.0e3)
            ),
            true => format!(
                "The intensities or the hazard curve do not reach far enough to find the gap {name} for {asked} \
                 1/year: even a gap as wide as the maximum demand has {frequency} 1/year."
            ),
        });
        let remarks = 0..answer.list(&at("minimum/remarks")).len();
        let remark = |r: usize| answer.quote(&at(&format!("minimum/remarks/{r}")));
        points.extend(remarks.map(|r| format!("Gap {name}: {}.", remark(r))));
    }
    let together = "/least_gaps_together/mean_annual_frequency";
    if answer.at(together).is_number() {
        points.push(format!(
            "With all gaps at these widths one of them closes with {}{} 1/year: a target for all of them together asks \
             for wider ones.",
            at_most(answer, "/least_gaps_together/mean_annual_frequency_is"),
            answer.say(together, 1.0)
        ));
    }
    let structures = match answer.at("/structures").is_number() {
        true => format!(
            ", {}",
            counted(answer.number("/structures", "") as usize, "structure")
        ),
        false => String::new(),
    };
    points.push(format!(
        "{} over {}{structures} and {}; intensity: {}.",
        counted(answer.number("sum /levels/+/runs", "") as usize, "run"),
        counted(answer.number("/records", "") as usize, "record"),
        match answer.list("/levels").len() {
            1 => "one intensity".to_owned(),
            levels => format!("{levels} intensities"),
        },
        answer.quote("/measure"),
    ));
    points
}

/// The bounds at a path, of which one may be unknown.
fn range_of(answer: Answer<'_>, path: &str) -> String {
    let bound = |place: usize| {
        let path = format!("{path}/{place}");
        (!answer.at(&path).is_null()).then(|| answer.say(&path, 1.0))
    };
    match (bound(0), bound(1)) {
        (Some(low), Some(high)) => format!("{low} to {high}"),
        (Some(low), None) => format!("at least {low}"),
        (None, Some(high)) => format!("at most {high}"),
        (None, None) => "without bounds".to_owned(),
    }
}

/// What must be said of the fragilities by width.
fn of_widths(gap: &Value) -> Vec<String> {
    let widths = gap["widths"].as_array().into_iter().flatten();
    let of_width = |state: &Value| -> Vec<String> {
        let name = named(state["name"].as_str().unwrap_or_default());
        let remarks = state["remarks"].as_array().into_iter().flatten();
        let remarks = remarks.filter_map(Value::as_str);
        remarks
            .map(|said| format!("{name}: {}.", named(said)))
            .collect()
    };
    widths.flat_map(of_width).collect()
}

/// Fitted fragilities of the states of a list.
fn fits(answer: Answer<'_>, list: &str) -> String {
    let of = |path: &str| format!("{list}/*/{path}");
    let (scale, unit) = intensity_of(answer);
    let median = format!("median{}", bracketed(unit));
    let states = answer.list(list);
    let mut columns = vec![Column::new("state")];
    if states.iter().any(|s| !s["width"].is_null()) {
        columns.push(Column::of("width (mm)", of("width"), 1.0e3));
    }
    columns.extend([
        Column::words_of("fragility", of("fit/kind")),
        Column::of("fitted", of("fit/median"), scale).below(&median),
        Column::of("from", of("fit/median_bounds/0"), scale).below(&median),
        Column::of("to", of("fit/median_bounds/1"), scale).below(&median),
        Column::of("fitted", of("fit/dispersion"), 1.0).below("dispersion"),
        Column::of("from", of("fit/dispersion_bounds/0"), 1.0).below("dispersion"),
        Column::of("to", of("fit/dispersion_bounds/1"), 1.0).below("dispersion"),
    ]);
    let tested = states.iter().any(|s| !s["goodness_of_fit"].is_null());
    if tested {
        let test = "Pearson's test of the fit";
        columns.extend([
            Column::of("p-value", of("goodness_of_fit/p_value"), 1.0).below(test),
            Column::of(
                "largest distance",
                of("goodness_of_fit/largest_distance"),
                1.0,
            )
            .below(test),
        ]);
    }
    if states.iter().any(|s| !s["mean_annual_frequency"].is_null()) {
        let frequency = "mean annual frequency (1/year)";
        columns.push(Column::of("value", of("mean_annual_frequency"), 1.0).below(frequency));
        columns
            .push(Column::words_of("which is an", of("mean_annual_frequency_is")).below(frequency));
        if states
            .iter()
            .any(|s| !s["mean_annual_frequency_bounds"].is_null())
        {
            columns.extend([
                Column::of("from", of("mean_annual_frequency_bounds/0"), 1.0).below(frequency),
                Column::of("to", of("mean_annual_frequency_bounds/1"), 1.0).below(frequency),
            ]);
        }
    }
    let heads = states
        .iter()
        .map(|s| s["name"].as_str().unwrap_or_default());
    let distance = match tested {
        true => {
            " The distance is that between the curve and the share of runs that reach the state."
        }
        false => "",
    };
    let bounds = format!("From and to: bounds at the confidence of the study.{distance}");
    answer.table("Fragility", &columns, rows(heads)) + &note(&bounds)
}

/// How often states were reached, by intensity.
fn counts(answer: Answer<'_>) -> String {
    let (scale, unit) = intensity_of(answer);
    let unit = bracketed(unit);
    let mut columns = vec![
        Column::new("number"),
        Column::of(format!("intensity{unit}"), "/levels/*/intensity", scale),
        Column::of("runs", "/levels/*/runs", 1.0),
        Column::of("failed", "/levels/*/failed", 1.0),
        Column::of("collapsed", "/levels/*/collapsed", 1.0),
    ];
    for (l, limit) in answer.list("/limits").iter().enumerate() {
        let name = limit["name"].as_str().unwrap_or_default();
        let from = format!("/limits/{l}/counts/*/reached");
        columns.push(Column::of(name, from, 1.0).below("runs that reach"));
    }
    answer.table("Runs by intensity", &columns, numbered(answer))
}

/// The factor from SI to the unit in which people say intensities, and that unit: g for
/// accelerations.
fn intensity_of(answer: Answer<'_>) -> (f64, &str) {
    match answer.text("/unit") {
        "m s-2" => (1.0 / STANDARD_GRAVITY, "g"),
        other => unit_of(other),
    }
}

fn bracketed(unit: &str) -> String {
    match unit {
        "" => String::new(),
        unit => format!(" ({unit})"),
    }
}

fn numbered(answer: Answer<'_>) -> Vec<(String, String)> {
    let levels = 0..answer.list("/levels").len();
    levels
        .map(|i| (i.to_string(), (i + 1).to_string()))
        .collect()
}

/// The points of the hazard curve, as the study gives them.
fn hazard(answer: Answer<'_>) -> String {
    let (scale, unit) = intensity_of(answer);
    let columns = [
        Column::new("number"),
        Column::of(
            format!("intensity{}", bracketed(unit)),
            "/hazard/*/0",
            scale,
        ),
        Column::of("mean annual frequency (1/year)", "/hazard/*/1", 1.0),
    ];
    let points = 0..answer.list("/hazard").len();
    let points = points.map(|i| (i.to_string(), (i + 1).to_string()));
    answer.table("Hazard at the site", &columns, points)
        + &note("Frequencies with which the intensity is exceeded; a power law between points.")
}

/// Fractiles of demands, by intensity.
fn demands(answer: Answer<'_>) -> String {
    let (scale, unit) = intensity_of(answer);
    let unit = bracketed(unit);
    let demands = answer.list("/levels/0/demands");
    let mut out = String::new();
    for (first, chunk) in demands.chunks(BESIDE).enumerate() {
        let mut columns = vec![
            Column::new("number"),
            Column::of(format!("intensity{unit}"), "/levels/*/intensity", scale),
        ];
        for (d, demand) in chunk.iter().enumerate() {
            let text = |key: &str| demand[key].as_str().unwrap_or_default();
            let (factor, _) = unit_of(text("unit"));
            let head = spoken(text("name")) + &in_parentheses(text("unit"));
            for (word, key) in [("16 %", "p16"), ("50 %", "p50"), ("84 %", "p84")] {
                let from = format!("/levels/*/demands/{}/{key}", first * BESIDE + d);
                columns.push(Column::of(word, from, factor).below(&head));
            }
        }
        out.push_str(&answer.table("Demands by intensity", &columns, numbered(answer)));
    }
    out + &note(
        "Fractiles over the records. A collapse is above everything: a dash is a fractile among collapses.",
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// Bounds beside the dispersion would be read as its own.
    #[test]
    fn bounds_stand_with_their_frequency_alone() {
        let told = |frequency: Value, high: Value| {
            let state = json!({
                "name": "pounding", "remarks": [], "mean_annual_frequency": frequency,
                "fit": {
                    "kind": "lognormal", "median": 0.8, "dispersion": 0.4, "confidence": 0.95,
                    "median_bounds": [0.7, 0.9], "dispersion_bounds": [0.3, 0.5],
                },
                "mean_annual_frequency_bounds": [1e-3, high],
            });
            let answer = json!({ "unit": "m s-2", "limits": [state], "gaps": [], "levels": [],
                "records": 2, "measure": "PGA" });
            points(Answer(&answer))[0].clone()
        };
        assert!(told(json!(2e-3), json!(4e-3)).contains("bootstrap"));
        let open = told(json!(2e-3), Value::Null);
        assert!(open.contains("(at least "), "{open}");
        let without = told(Value::Null, json!(4e-3));
        assert!(!without.contains("bootstrap"), "{without}");
    }
}
