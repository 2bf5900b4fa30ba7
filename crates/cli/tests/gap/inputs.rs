//! Records, options and what is wrong with them.

use std::process::Command;

use super::{close, example_with, gap, gap_in, gap_of_folder, json, root, text};

/// A folder of seven copies of one record: seven equal demands, which a lognormal
/// distribution without dispersion fits, and tables that sum records up.
#[test]
fn a_folder_of_records() {
    let folder = tempfile::tempdir().unwrap();
    let record = root().join("ground_motions/el_centro_1940_ns.csv");
    for i in 0..7 {
        std::fs::copy(&record, folder.path().join(format!("copy_{i}.csv"))).unwrap();
    }
    std::fs::write(folder.path().join("README.md"), "no record").unwrap();
    let path = folder.path().to_str().unwrap();
    let arguments = ["--records", path, "--points", "0", "--probability", "0.1"];
    let mut with_json = arguments.to_vec();
    with_json.push("--json");
    let result = json(&gap("gap_check", &with_json));
    let required = &result["gaps"][0]["required"];
    let fit = &required["lognormal"];
    close(&fit["width"], 0.117_167, 2e-4);
    assert!(fit["dispersion"].as_f64().unwrap() < 1e-12);
    close(&fit["bounds"][1], fit["width"].as_f64().unwrap(), 1e-9);
    let shown = text(&gap("gap_check", &arguments).stdout);
    assert!(shown.contains("maximum of 7") && shown.contains("7 of 7 records close it"));
    let compared = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .arg("compare")
        .arg(root().join("examples/three_storey_pair/case.toml"))
        .args(["--records", path, "--models", "jankowski_2005,ye_li_2009"])
        .output()
        .unwrap();
    let compared = text(&compared.stdout);
    assert!(
        compared.contains("Values of every model under every record"),
        "{compared}"
    );
    let empty = tempfile::tempdir().unwrap();
    let nothing = gap("gap_check", &["--records", empty.path().to_str().unwrap()]);
    assert_eq!(nothing.status.code(), Some(2));
}

/// Of a folder the records are taken, and what is none is named.
#[test]
fn a_folder_of_records_may_hold_other_files() {
    let output = gap_of_folder("gap", &root().join("examples/synthetic_suite"));
    assert!(
        matches!(output.status.code(), Some(0 | 1)),
        "{}",
        text(&output.stderr)
    );
    assert_eq!(json(&output)["records"].as_array().unwrap().len(), 7);
    let said = text(&output.stderr);
    assert!(
        said.contains("make_suite is a script, not a record"),
        "{said}"
    );
    assert!(said.contains("README.md is a text, not a record"), "{said}");

    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::copy(
        root().join("ground_motions/el_centro_1940_ns.csv"),
        at("b.csv"),
    )
    .unwrap();
    // Without an ending it is a record all the same.
    std::fs::copy(
        root().join("examples/synthetic_suite/motion_1.csv"),
        at("a"),
    )
    .unwrap();
    for (name, content) in [
        ("README", "these are two records\n"),
        ("make.sh", "echo\n"),
        ("make", "#!/bin/sh\n"),
        ("case.toml", "title = \"\"\n"),
        ("result.H5", "\u{89}HDF"),
        ("page.html", "<html>\n"),
        (".hidden", "1 2\n"),
    ] {
        std::fs::write(at(name), content).unwrap();
    }
    for command in ["gap", "compare"] {
        let output = gap_of_folder(command, folder.path());
        assert!(
            matches!(output.status.code(), Some(0 | 1)),
            "{}",
            text(&output.stderr)
        );
        let records = &json(&output)["records"];
        assert_eq!(records.as_array().unwrap().len(), 2, "{records}");
        let said = text(&output.stderr);
        assert_eq!(said.matches("not a record").count(), 7, "{said}");
    }
    // A file that may be a record is not passed over because it cannot be read.
    std::fs::write(at("c.csv"), "nothing\n").unwrap();
    let output = gap_of_folder("gap", folder.path());
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("c.csv"));
    // What is named itself is taken as a record whatever it is called.
    let output = gap_of_folder("gap", &at("make"));
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));

    for name in ["a", "b.csv", "c.csv"] {
        std::fs::remove_file(at(name)).unwrap();
    }
    let output = gap_of_folder("gap", folder.path());
    let said = text(&output.stderr).replace(['\n', '│'], " ");
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("make is a script, make.sh is a script"),
        "{said}"
    );
    assert!(
        said.contains("name record files, or a folder of them"),
        "{said}"
    );
}

/// Options out of range: the message says what must be, the help which argument it is.
#[test]
fn options_out_of_range_are_named() {
    let folder = example_with("\"20 mm\"");
    for (argument, value, allowed) in [
        ("--probability", "1.2", "at least 0 and less than 1"),
        ("--confidence", "1", "greater than 0 and less than 1"),
        ("--points", "1", "two or more"),
    ] {
        let output = gap_in(folder.path(), &[argument, value]);
        assert_eq!(output.status.code(), Some(2));
        let said = text(&output.stderr).replace('│', " ");
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            said.contains(&format!("= {value} is out of range: it must be {allowed}")),
            "{said}"
        );
        assert!(
            said.contains(&format!("give `{argument}` a value that is")),
            "{said}"
        );
    }
}

#[test]
fn mistakes() {
    for (arguments, says) in [
        (vec!["--provisions", "nbcc"], "nbcc_2015_between"),
        (
            vec!["--code", "eurocode"],
            "did you mean \"eurocode_8_2004\"?",
        ),
        (
            vec!["--set", "code=\"ec8\""],
            "did you mean \"eurocode_8_2004\"?",
        ),
        (vec!["--set", "soil_zone=\"IV\""], "zones are I, II and III"),
        (vec!["--set", "soil_zone=\"IV\""], "--set:1:11"),
        (
            vec!["--set", "structural_system=[\"frame\", \"timber\"]"],
            "--set:1:29",
        ),
        (
            vec!["--set", "plan_length=20", "--set", "plan_width=\"50 m\""],
            "`plan_width`, 50 m for building 1, is greater than",
        ),
        (vec!["--set", "soil_zone=II"], "texts in quotes"),
        (vec!["--set", "importence=1"], "did you mean `importance`?"),
        (vec!["--probability", "1"], "less than 1"),
        (vec!["--to", "5 kN"], "must be a length"),
        (vec!["--gap", "light"], "light-heavy"),
        (vec!["--records", "nowhere.csv"], "nowhere.csv"),
        (vec!["--points", "0", "--csv", "x.csv"], "without a sweep"),
    ] {
        let output = gap("gap_check", &arguments);
        let said = text(&output.stderr);
        let plain: String = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(plain.contains(says), "{arguments:?}: {said}");
    }
}

/// Options that cannot go together are found before anything is computed or written.
#[test]
fn nothing_is_written_for_options_that_cannot_go_together() {
    let folder = tempfile::tempdir().unwrap();
    let codes = folder.path().join("codes.csv");
    let sweep = folder.path().join("sweep.csv");
    let output = gap(
        "gap_check",
        &[
            "--points",
            "0",
            "--codes-csv",
            codes.to_str().unwrap(),
            "--csv",
            sweep.to_str().unwrap(),
        ],
    );
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("without a sweep"));
    assert!(!codes.exists() && !sweep.exists());
}
