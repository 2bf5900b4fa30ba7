//! `pounding impact calibrate`: the factor alpha of papi_toopchi_2022.

use crate::tables::Table;
use pounding_case::Dimension;
use pounding_gap_element::calibration::{
    AlphaChoice, Calibration, CalibrationError, DropTest, calibrate as search,
};
use pounding_gap_element::published::papi_toopchi_2022::DROP_TEST;
use serde::Serialize;

use crate::arguments::CalibrateArguments;
use crate::arguments::value;
use crate::failure::Failure;
use crate::output::{pretty, print};

/// What the numbers are good for.
const ADVICE: &str = "\
Which alpha for buildings: the free one. It returns exactly what is asked in a free collision, for every
mass and stiffness, from 1 mm/s on; model = \"exact_hunt_crossley\" with exponent = 1 is the same law without the
detour. The alpha of a drop test makes up for gravity and for the place of the reading in that test, and
the rule alpha = e + 0.1 (1 from e = 0.8; the paper's equations misprint e + 1) returns too much freely.";

/// Says what the default conditions are worth.
const HYPOTHESIS: &str = "\
Velocity, stiffness and time of reading are a hypothesis: the paper's are not legible or not given, and
these were chosen because its table 1 comes out with them.";

/// A table over restitutions, or one search step by step.
pub fn calibrate(arguments: &CalibrateArguments) -> Result<(), Failure> {
    let (test, is_papers) = drop_test(arguments)?;
    let tolerance = value(&arguments.tolerance, "tolerance", Dimension::NUMBER)?;
    if let Some(text) = &arguments.restitution {
        let requested = value(text, "restitution", Dimension::NUMBER)?;
        let found = search(&test, requested, tolerance)?;
        return print(&match arguments.json {
            true => pretty(&document(&test, is_papers, &found))?,
            false => one_text(&test, is_papers, &found),
        });
    }
    let rows: Vec<(f64, Result<Calibration, CalibrationError>)> = (1..=9)
        .map(|tenth| f64::from(tenth) / 10.0)
        .map(|requested| (requested, search(&test, requested, tolerance)))
        .collect();
    // A row without an answer is shown as such, but a table of them is a failure.
    if let [(_, Err(error)), rest @ ..] = rows.as_slice()
        && rest.iter().all(|(_, result)| result.is_err())
    {
        return Err(error.clone().into());
    }
    if arguments.json {
        let rows: Vec<_> = rows.iter().map(|(e, result)| row(*e, result)).collect();
        return print(&pretty(&document(&test, is_papers, Rows { rows }))?);
    }
    print(&table_text(&test, is_papers, &rows))
}

/// The drop test, and whether it is the paper's.
fn drop_test(arguments: &CalibrateArguments) -> Result<(DropTest, bool), Failure> {
    let given = |text: &Option<String>, name, dimension, default| match text {
        Some(text) => value(text, name, dimension),
        None => Ok(default),
    };
    let is_papers = [
        &arguments.mass,
        &arguments.gravity,
        &arguments.velocity,
        &arguments.stiffness,
    ]
    .into_iter()
    .all(Option::is_none);
    let test = DropTest {
        mass: given(&arguments.mass, "mass", Dimension::MASS, DROP_TEST.mass)?,
        gravity: given(
            &arguments.gravity,
            "gravity",
            Dimension::ACCELERATION,
            DROP_TEST.gravity,
        )?,
        approach_velocity: given(
            &arguments.velocity,
            "velocity",
            Dimension::VELOCITY,
            DROP_TEST.approach_velocity,
        )?,
        stiffness: given(
            &arguments.stiffness,
            "stiffness",
            Dimension::STIFFNESS,
            DROP_TEST.stiffness,
        )?,
        read_at: match arguments.read_at.as_deref() {
            Some("separation") => None,
            Some(text) => Some(value(text, "read-at", Dimension::TIME)?),
            None => DROP_TEST.read_at.filter(|_| is_papers),
        },
    };
    let is_papers = is_papers && test == DROP_TEST;
    Ok((test, is_papers))
}

fn conditions(test: &DropTest, is_papers: bool) -> String {
    let reading = test.read_at.map_or_else(
        || "where the body leaves the slab".to_owned(),
        |time| format!("{time} s after first contact"),
    );
    let note = if is_papers {
        format!("\n{HYPOTHESIS}")
    } else {
        String::new()
    };
    let slow = match test.is_below_floor() {
        true => {
            "\nwarning: the law divides by 1 mm/s at least: slower collisions are damped less, and alpha makes up for it"
        }
        false => "",
    };
    format!(
        "Drop test: {} kg at {} m/s on {:e} N/m, gravity {} m/s2, rebound read {reading}.{note}{slow}\n",
        test.mass, test.approach_velocity, test.stiffness, test.gravity
    )
}

fn table_text(
    test: &DropTest,
    is_papers: bool,
    rows: &[(f64, Result<Calibration, CalibrationError>)],
) -> String {
    let mut table = Table::new();
    table.set_header([
        "requested",
        "alpha found",
        "collisions",
        "returns freely",
        "rule alpha",
        "drop test shows",
        "returns freely",
        "free alpha",
        "drop test shows",
    ]);
    let mut remarks = String::new();
    for (requested, result) in rows {
        match result {
            Ok(found) => table.add_row([
                format!("{requested:.1}"),
                format!("{:.7}", found.found.alpha),
                found.steps.len().to_string(),
                format!("{:.7}", found.found.achieved_in_free_collision),
                format!("{:.1}", found.rule.alpha),
                format!("{:.7}", found.rule.achieved),
                format!("{:.7}", found.rule.achieved_in_free_collision),
                format!("{:.7}", found.free.alpha),
                format!("{:.7}", found.free.achieved),
            ]),
            Err(error) => {
                remarks.push_str(&format!("{requested:.1}: {error}\n"));
                table.add_row([format!("{requested:.1}"), "none".to_owned()])
            }
        };
    }
    format!(
        "{}\n{table}\n{remarks}\n{ADVICE}",
        conditions(test, is_papers)
    )
}

fn one_text(test: &DropTest, is_papers: bool, found: &Calibration) -> String {
    let mut table = Table::new();
    table.set_header(["collision", "alpha", "achieved", "achieved - requested"]);
    for (index, step) in found.steps.iter().enumerate() {
        table.add_row([
            (index + 1).to_string(),
            format!("{:.12}", step.alpha),
            format!("{:.12}", step.achieved),
            format!("{:.3e}", step.achieved - found.requested),
        ]);
    }
    let choice = |name: &str, choice: &AlphaChoice| {
        format!(
            "{name:22}{:.9}   drop test shows {:.9}, a free collision returns {:.9}\n",
            choice.alpha, choice.achieved, choice.achieved_in_free_collision
        )
    };
    format!(
        "{}\nRequested restitution {}; bracketed search by ITP\n{table}\n\n{}{}{}\n{ADVICE}",
        conditions(test, is_papers),
        found.requested,
        choice("alpha found", &found.found),
        choice("alpha by the rule", &found.rule),
        choice("alpha free, exact", &found.free),
    )
}

/// What `--json` prints: what was found, beside the test.
#[derive(Serialize)]
struct Document<'t, T> {
    #[serde(flatten)]
    found: T,
    drop_test: Test<'t>,
    advice: &'static str,
}

/// The drop test.
#[derive(Serialize)]
struct Test<'t> {
    #[serde(flatten)]
    test: &'t DropTest,
    conditions_are_a_hypothesis: bool,
    /// Whether the law divides by 1 mm/s, as the test is slower.
    is_below_approach_velocity_floor: bool,
}

/// A search for each restitution.
#[derive(Serialize)]
struct Rows<'r> {
    rows: Vec<Row<'r>>,
}

/// A search that found something, or why not.
#[derive(Serialize)]
#[serde(untagged)]
enum Row<'r> {
    Found(&'r Calibration),
    Refused { requested: f64, error: String },
}

fn document<T>(test: &DropTest, conditions_are_a_hypothesis: bool, found: T) -> Document<'_, T> {
    Document {
        found,
        drop_test: Test {
            test,
            conditions_are_a_hypothesis,
            is_below_approach_velocity_floor: test.is_below_floor(),
        },
        advice: ADVICE,
    }
}

fn row(requested: f64, result: &Result<Calibration, CalibrationError>) -> Row<'_> {
    match result {
        Ok(found) => Row::Found(found),
        Err(error) => Row::Refused {
            requested,
            error: error.to_string(),
        },
    }
}
