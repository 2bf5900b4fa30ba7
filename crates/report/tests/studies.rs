//! Pages of commands with many runs, from answers that are made by hand.
use pounding_report::page::{Inputs, comparison, gap, ida, motion};
use serde_json::{Value, json};

const HOSTILE: &str = "<img src=x onerror=alert(1)></td>\u{2028}&";

fn inputs() -> Inputs {
    Inputs {
        title: HOSTILE.to_owned(),
        origin: vec!["gap".to_owned(), HOSTILE.to_owned()],
        warnings: vec![HOSTILE.to_owned()],
        facts: vec![("SHA-256".to_owned(), "ab".repeat(32))],
        listings: vec![("The case file".to_owned(), HOSTILE.to_owned())],
    }
}

/// Every element that is opened is closed, in order, and nothing is fetched or run.
fn is_whole(html: &str) {
    let mut open = Vec::new();
    for tag in html.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').unwrap();
        let name = tag.trim_start_matches('/').split([' ', '\n', '/']).next();
        let name = name.unwrap();
        if let Some(closed) = tag.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(closed.trim()), "{tag}");
        } else if !["!DOCTYPE", "meta", "br"].contains(&name) && !tag.ends_with('/') {
            open.push(name.to_owned());
        }
    }
    assert!(open.is_empty(), "{open:?}");
    for foreign in [
        "<script", "<img", "href=", "@import", "url(", "NaN", ">inf", ">null",
    ] {
        assert!(!html.contains(foreign), "{foreign}");
    }
}

fn check() -> Value {
    let storeys =
        json!([{ "displacement": 1.25, "storey_shear": null, "acceleration_absolute": 2.5 }]);
    json!({
        "adequate": false,
        "confidence": 0.9,
        "target_probability": 0.0,
        "warnings": [HOSTILE],
        "records": [
            { "name": HOSTILE, "peak_ground_acceleration": 3.0, "failure": null,
              "amplification": [storeys], "impacts": [[3]],
              "isolated": [{ "name": HOSTILE }] },
            { "name": "second", "peak_ground_acceleration": 4.0, "failure": HOSTILE,
              "amplification": null, "impacts": null, "isolated": [{ "name": HOSTILE }] },
        ],
        "gaps": [{
            "name": HOSTILE,
            "adequate": false,
            "records_in_contact": 1,
            "demand": [0.0301, 0.0102],
            "governing": { "level": 1, "record": HOSTILE, "required": 0.0301, "provided": 0.02, "margin": -0.0101 },
            "suite": { "mean": 0.02015, "maximum": 0.0301 },
            "required": { "by_count": 0.0301, "allowed_contacts": 0, "lognormal": null },
            "code": {
                "edition": "EN 1998-1:2004", "statistic": "maximum", "demand": 0.0301,
                "cases": [
                    { "ownership": "one owner", "refusal": null, "required": 0.0211, "provided": 0.02, "governing_level": 1 },
                    { "ownership": "two owners", "refusal": HOSTILE, "required": null },
                ],
            },
            "levels": [{ "level": "1-1", "left_elevation": 3.0, "right_elevation": null, "width": 0.02,
                         "demand": [{ "peak": 0.0301 }, { "peak": 0.0102 }] }],
            "combinations": [{ "rule": "absolute_sum", "status": "verified", "satisfied": false,
                               "correlation": null, "width": [[0.035]] }],
            "provisions": [
                { "name": "first", "edition": HOSTILE, "place": "between", "status": "verified",
                  "refusal": null, "satisfied": true,
                  "records": [{ "width": 0.0181, "ratio_to_demand": 0.601 }] },
                { "name": "second", "edition": "", "place": "between", "status": "unverified",
                  "refusal": null, "satisfied": false,
                  "records": [{ "width": 0.0431, "ratio_to_demand": 1.432 }] },
                { "name": "third", "refusal": HOSTILE, "records": [] },
            ],
        }],
        "sweep": { "gap": null, "widths": [0.01, 0.02],
                   "runs": [[{ "amplification": [storeys], "impacts": 7, "peak_force": 1.5e6 }],
                            [{ "failure": HOSTILE }]] },
    })
}

#[test]
fn the_answer_of_a_gap_check_comes_first() {
    let html = gap(&check(), &[], &inputs());
    is_whole(&html);
    for text in [
        "EN 1998-1:2004 gives no answer for gap &lt;img",
        "data-factor=\"1e3\" value=\"21.10\">21.10</data> mm are required",
        "1 of 2 records close it; none may.",
        "Level 1-1 governs:",
        "<li>A width of",
        "is needed so that no record closes it",
        "<tr data-row=\"mean\"><th scope=\"row\">mean</th><td>20.15</td></tr>",
        // The elevation of a wall is not known.
        "<th scope=\"row\">1-1</th><td>3.000</td><td>\u{2013}</td><td>20.00</td><td>30.10</td><td>0.6645</td>",
        "<th scope=\"row\">1</th><td>10.00</td><td>1.250</td><td>\u{2013}</td><td>2.500</td><td>7</td><td>1500</td>",
        "<td>0.3059</td><td>30.10</td><td>\u{2013}</td><td>3</td>",
    ] {
        assert!(html.contains(text), "{text}\n{html}");
    }
    // Rules that the gap does not reach stand before those that it does.
    let place = |name: &str| {
        html.find(&format!("<th scope=\"row\">{name}</th>"))
            .unwrap()
    };
    assert!(place("second") < place("first") && place("first") < place("third"));
    let answer = html.find("Is the gap wide enough?").unwrap();
    assert!(answer < place("second"));
}

/// Heads of widths say what they range over; of one record and one level there is no range.
#[test]
fn widths_say_what_they_range_over() {
    let suite = gap(&check(), &[], &inputs());
    assert_eq!(suite.matches("width over records (mm)").count(), 2);
    let mut two = check();
    let levels = &mut two["gaps"][0]["levels"];
    let level = levels[0].clone();
    levels.as_array_mut().unwrap().push(level);
    let html = gap(&two, &[], &inputs());
    for text in [
        "width over records and levels (mm)",
        "width over records (mm)",
        "The width of a record is that of the level that asks for most.",
        "minimum of width / demand",
        "the maximum over storeys and records",
    ] {
        assert!(html.contains(text), "{text}\n{html}");
    }
    let mut one = check();
    one["records"].as_array_mut().unwrap().pop();
    one["gaps"][0]["demand"] = json!([0.0301]);
    let html = gap(&one, &[], &inputs());
    is_whole(&html);
    assert_eq!(html.matches(">width (mm)</th>").count(), 3, "{html}");
    for text in [
        "over records",
        "and records",
        "minimum of width",
        "maximum demand",
    ] {
        assert!(!html.contains(text), "{text}\n{html}");
    }
}

/// Where no isolated building moves there is no ratio, and no figure of it.
#[test]
fn what_does_not_move_has_no_ratio() {
    let mut still = check();
    let storeys =
        json!([{ "displacement": null, "storey_shear": null, "acceleration_absolute": 2.5 }]);
    still["records"][0]["amplification"] = json!([storeys]);
    still["sweep"]["runs"][0][0]["amplification"] = json!([storeys]);
    let html = gap(&still, &[], &inputs());
    is_whole(&html);
    for text in [
        "There is no figure of displacement, storey shear: no isolated building has any",
        "<td>\u{2013}</td><td>\u{2013}</td><td>2.500</td>",
        "a dash where the isolated building has none",
    ] {
        assert!(html.contains(text), "{text}\n{html}");
    }
}

/// A gap that closes because another gap of the row does: its own demand is no remedy.
#[test]
fn a_gap_that_neighbours_close() {
    let mut answer = check();
    answer["gaps"][0]["code"] = Value::Null;
    let words = [
        "Under 1 of them only because another gap of the row closes",
        "closes it while the other gaps stay open.",
    ];
    let holds = |answer: &Value| {
        let html = gap(answer, &[], &inputs());
        words.map(|text| html.contains(text))
    };
    assert_eq!(holds(&answer), [false; 2]);
    answer["gaps"][0]["records_driven_by_neighbours"] = json!(0);
    assert_eq!(holds(&answer), [false; 2]);
    answer["gaps"][0]["records_driven_by_neighbours"] = json!(1);
    assert_eq!(holds(&answer), [true; 2]);
}

/// Answers with nothing in them have a page without numbers, not a failure.
#[test]
fn empty_answers() {
    let nothing = json!({});
    for html in [
        gap(&nothing, &[], &inputs()),
        comparison(&nothing, &[], &inputs()),
        ida(&nothing, &[], &inputs()),
        motion(&nothing, &[], &inputs()),
    ] {
        is_whole(&html);
    }
}
