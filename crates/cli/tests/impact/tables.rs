//! Requested against achieved restitution.

use pounding_gap_element::published::restitution::REFERENCES;
use pounding_gap_element::registry;

use super::{close, equal, has, json, text, text_in};

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
