//! What a page that computes says of widths at which pounding brings a building to collapse.
use serde_json::{Value, json};

use crate::explore::{asked_of, natively, part, root};
use crate::support::Bench;

/// A pair of which the left building, which yields under gravity, stands at its gap of 24 mm, and collapses at most
/// narrower ones.
fn pair() -> Bench {
    let record = root().join("ground_motions/el_centro_1940_ns.csv");
    Bench::with(&format!(
        r#"title = "collapse"
[[building]]
name = "a"
storeys = 1
mass = "25 t"
stiffness = "3.46 MN/m"
height = "3 m"
p_delta = true
law = {{ model = "elastic_perfectly_plastic", yield_force = "25 kN" }}
damping = {{ stiffness_proportional = 0.05 }}
[[building]]
name = "b"
storeys = 1
mass = "25 t"
stiffness = "13.46 MN/m"
height = "3 m"
damping = {{ stiffness_proportional = 0.05 }}
[[gap]]
between = ["a", "b"]
width = "24 mm"
model = "jankowski_2005"
stiffness = "2.75e9 N/m^1.5"
damping_ratio = 0.35
[ground_motion]
file = '{}'
scale = 0.85
"#,
        record.display()
    ))
}

/// The widths of the sweep of `gap --json` at which a run has no end, each with its words and the building that collapses.
fn failed(check: &Value) -> Vec<Value> {
    let sweep = &check["sweep"];
    let widths = sweep["widths"].as_array().unwrap().iter();
    let runs = sweep["runs"].as_array().unwrap().iter();
    let failed = widths
        .zip(runs)
        .filter(|(_, runs)| runs[0]["failure"].is_string());
    let failed = failed.map(|(width, runs)| {
        json!({ "width": width, "message": runs[0]["failure"], "collapsed": runs[0]["collapsed"] })
    });
    failed.collect()
}

#[test]
fn solver_says_at_which_widths_a_building_collapses() {
    let bench = pair();
    let check: Value = {
        let arguments = "gap case.toml --points 4 --from 5mm --to 26mm --json";
        serde_json::from_slice(&bench.output(arguments).stdout).unwrap()
    };
    let expected = failed(&check);
    assert!((1..4).contains(&expected.len()), "{expected:?}");
    assert_eq!(expected[0]["collapsed"], "a");
    let widths = &check["sweep"]["widths"];
    let record = root().join("ground_motions/el_centro_1940_ns.csv");
    let answers = natively(&[
        json!({ "do": "file", "name": record, "$bytes": record }),
        json!({ "do": "open", "name": "case.toml", "$text": bench.read("case.toml") }),
        json!({ "do": "sweep", "changes": [], "gap": 0, "widths": widths }),
    ]);
    assert_eq!(answers[2]["failed"], json!(expected), "{}", answers[2]);
    assert_eq!(answers[2]["buildings"], json!(["a", "b"]));
}

/// The sentence of the page of `gap`, and the column of its table.
#[test]
fn page_says_at_which_widths_a_building_collapses() {
    let bench = pair();
    let file = "(async () => { let given = null; const made = URL.createObjectURL.bind(URL); URL.createObjectURL = (blob) => { given = blob; return made(blob); };\
                document.querySelector('[data-part=sweep-csv]').click(); return (await given.text()).split('\\n'); })()";
    let Some(told) = asked_of(&bench, &[&part("remarks"), file]) else {
        return;
    };
    let arguments = "gap case.toml --json --report gap.html --csv gap.csv";
    let check: Value = serde_json::from_slice(&bench.output(arguments).stdout).unwrap();
    let failed = failed(&check);
    let page = bench.read("gap.html");
    let words = format!(
        "<strong>Pounding brings a to collapse</strong> at {} of 400 widths, between <data ",
        failed.len()
    );
    assert!(page.contains(&words), "{words}");
    let remark = told[0].as_str().unwrap();
    let words = format!(
        "Pounding brings a to collapse at {} of 400 widths, between ",
        failed.len()
    );
    assert!(remark.starts_with(&words), "{remark}");
    assert!(
        remark.ends_with(" mm: no ratio of peaks is worse."),
        "{remark}"
    );

    let lines: Vec<&str> = (told[1].as_array().unwrap().iter())
        .map(|line| line.as_str().unwrap())
        .collect();
    assert!(
        lines[0].ends_with(",impact_energy_j,failure"),
        "{}",
        lines[0]
    );
    let without: Vec<_> = lines
        .iter()
        .filter(|l| l.contains("collapsed at"))
        .collect();
    assert_eq!(without.len(), failed.len());
    let columns = lines[0].split(',').count();
    let theirs = bench.read("gap.csv");
    for (line, run) in without.iter().zip(&failed) {
        let cells: Vec<&str> = line.splitn(columns, ',').collect();
        assert_eq!(
            cells[2].parse::<f64>().ok(),
            run["width"].as_f64(),
            "{line}"
        );
        assert!(
            cells[3..columns - 1].iter().all(|cell| cell.is_empty()),
            "{line}"
        );
        // As the command writes it.
        let end = format!(",{}", cells[columns - 1]);
        assert!(theirs.lines().any(|l| l.ends_with(&end)), "{end}");
    }
    // Two buildings at each of the other widths, and nothing behind the last line end.
    assert_eq!(lines.len(), 1 + failed.len() + 2 * (400 - failed.len()) + 1);
}
