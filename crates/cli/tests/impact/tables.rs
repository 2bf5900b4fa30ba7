//! Requested against achieved restitution.

use pounding_gap_element::published::restitution::REFERENCES;
use pounding_gap_element::registry;

use serde_json::Value;

use super::{close, equal, example, has, json, run_in, text, text_in};

const JANKOWSKI: [f64; 10] = [
    0.0933241, 0.1914793, 0.2917464, 0.3929765, 0.4945878, 0.5962485, 0.6977491, 0.7989438,
    0.8997233, 1.0,
];

#[test]
fn the_detailed_table_of_one_model() {
    let shown = text("jankowski_2005|-p|stiffness=2.75e9|--table");
    for achieved in JANKOWSKI {
        has(&shown, &[&format!("{achieved:.7}")]);
    }
    has(
        &shown,
        &["mean error 1.76 % over 0.1-1.0, 0.54 % over 0.5-0.8"],
    );
    assert!(!shown.contains("secondary sources"));
    assert!(text("tsuji_1992|-p|stiffness=2.75e9|--table").contains("from secondary sources"));
    let result = json("jankowski_2005|-p|stiffness=2.75e9|--table");
    for (row, achieved) in result["rows"].as_array().unwrap().iter().zip(JANKOWSKI) {
        close(&row["achieved"], achieved, 1e-6);
    }
}

/// A model whose collisions do not end keeps no table of the others back.
#[test]
fn the_others_are_tabulated_where_one_does_not_end() {
    let arguments = "lapshin_yurin_2016|jankowski_2005|--example|--table|--velocity|1e8 m/s";
    let output = run_in(&example(), &format!("{arguments}|--json"));
    assert_eq!(output.status.code(), Some(3));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let models = found["models"].as_array().unwrap();
    assert_eq!(models.len(), 1, "{found}");
    close(&models[0]["rows"][5]["achieved"], JANKOWSKI[5], 1e-6);
    assert_eq!(found["failed"][0]["model"], "lapshin_yurin_2016");
    let output = run_in(&example(), arguments);
    assert_eq!(output.status.code(), Some(3));
    let shown = String::from_utf8(output.stdout).unwrap();
    has(&shown, &["0.5962485"]);
    let said = String::from_utf8(output.stderr).unwrap();
    has(
        &said,
        &["lapshin_yurin_2016: the collision did not end within"],
    );
}

/// Reference tables of all models that take the parameters of their examples.
#[test]
fn the_matrix_of_all_models() {
    let result = json("--all|--example|--table");
    let models = result["models"].as_array().unwrap();
    let mut checked = 0;
    for reference in REFERENCES.iter().filter(|r| r.parameters.is_empty()) {
        // The command takes the first separation rule of the model.
        let rules = registry::find(reference.model).unwrap().separation_rules;
        let first = reference.separation.is_none_or(|rule| rule == rules[0]);
        let Some(model) = models
            .iter()
            .find(|m| first && m["model"] == reference.model)
        else {
            continue;
        };
        let rows = model["rows"].as_array().unwrap();
        for (row, expected) in rows.iter().zip(reference.achieved) {
            close(&row["achieved"], expected, 1e-7);
        }
        checked += 1;
    }
    assert!(checked > 25, "{checked}");
    let left_out = result["left_out"].as_array().unwrap();
    assert!(left_out.iter().any(|l| l["model"] == "hertz_1882"));
    assert_eq!(
        models.len() + left_out.len(),
        json("--all|--example")["models"].as_array().unwrap().len()
    );
    let shown = text("--all|--example|--table");
    has(
        &shown,
        &[
            "left out: linear_elastic takes no restitution: it always returns 1",
            "left out: adams_impact takes no restitution",
            "from secondary sources: tsuji_1992",
            "0.0933 | 0.1915",
            "1.76 |    0.54",
        ],
    );
    // The table asks for its own restitutions.
    assert!(!shown.contains("restitution = "));
}

#[test]
fn tables_as_files() {
    let folder = tempfile::tempdir().unwrap();
    text_in(
        folder.path(),
        "jankowski_2005|stereomechanical|--example|--table|--csv|t.csv|--svg|t.svg",
    );
    let written = std::fs::read_to_string(folder.path().join("t.csv")).unwrap();
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(written.as_bytes());
    type Row = (String, f64, f64, f64, Option<f64>, Option<f64>);
    let rows: Vec<Row> = reader.deserialize().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 20);
    let result = json("jankowski_2005|--example|--table");
    for (row, expected) in rows.iter().zip(result["rows"].as_array().unwrap()) {
        equal(row.2, &expected["achieved"]);
        equal(row.4.unwrap(), &expected["peak_force"]);
    }
    assert_eq!(rows[10].4, None);
    let picture = std::fs::read_to_string(folder.path().join("t.svg")).unwrap();
    has(&picture, &["Achieved restitution", "as requested"]);
}

/// Gravity holds bodies of little restitution on the slab: they have no contact time, neither on the
/// screen nor in files. Those that part keep theirs.
#[test]
fn bodies_that_stay_in_contact_have_no_contact_time() {
    let folder = tempfile::tempdir().unwrap();
    let call = "ye_li_2009|--example|--table|--drop|--velocity|1";
    let result = json(call);
    let staying = |row: &Value| row["stays_in_contact"] == true;
    let rows = result["rows"].as_array().unwrap();
    assert!(staying(&rows[0]) && !staying(&rows[9]));
    for row in rows {
        assert_eq!(staying(row), row["duration"].is_null(), "{row}");
        assert_eq!(staying(row), row["achieved"] == 0.0, "{row}");
    }
    let asked = rows
        .iter()
        .filter(|r| staying(r))
        .map(|r| r["requested"].to_string());
    let asked = asked.collect::<Vec<_>>().join(", ");
    let shown = text_in(folder.path(), &format!("{call}|--csv|t.csv"));
    has(
        &shown,
        &[&format!(
            "stays in contact: ye_li_2009 has too little energy left to part where asked for {asked}\n"
        )],
    );
    let written = std::fs::read_to_string(folder.path().join("t.csv")).unwrap();
    let first = written.lines().find(|l| l.starts_with("ye_li_2009,0.1,"));
    assert!(first.is_some_and(|l| l.ends_with(',')), "{written}");
    let matrix = text("ye_li_2009|exact_linear|--example|--table|--drop|--velocity|1");
    has(&matrix, &["stays in contact: ye_li_2009"]);
}
