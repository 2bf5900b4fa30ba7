//! `pounding gap`: headline numbers of the example, files, exit codes, mistakes.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn gap(example: &str, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .arg("gap")
        .arg(root().join("examples").join(example).join("case.toml"))
        .args(arguments)
        .current_dir(root())
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", text(&output.stderr)))
}

fn close(value: &Value, expected: f64, relative: f64) {
    let value = value.as_f64().unwrap();
    assert!(
        (value / expected - 1.0).abs() < relative,
        "{value} is not {expected}"
    );
}

fn named<'a>(list: &'a Value, key: &str, name: &str) -> &'a Value {
    let list = list.as_array().unwrap();
    list.iter()
        .find(|x| x[key] == name)
        .unwrap_or_else(|| panic!("{name}"))
}

/// An independent solution has a demand of 0.117207 m, a square root of 0.116112 m and
/// peaks of 0.114253 and 0.020696 m with g = 9.81 m/s2; ours is 9.80665 / 9.81 of that, and
/// the first value of the record at time zero changes the fifth digit. The code's rule is
/// unsafe for this record by 1 %.
#[test]
fn the_example_under_both_records() {
    let records = ["--records", "ground_motions", "--points", "0", "--json"];
    let output = gap("gap_check", &records);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let result = json(&output);
    let gap = &result["gaps"][0];
    assert_eq!(result["records"][0]["name"], "el_centro_1940_ns");
    assert_eq!(result["records"][1]["name"], "kobe_1995_jma_ns");
    close(&gap["demand"][0], 0.117_167, 2e-4);
    close(&gap["demand"][1], 0.402_87, 1e-4);
    assert_eq!(gap["governing_level"], 3);
    close(&gap["levels"][2]["demand"][0]["time"], 5.952, 1e-3);
    assert_eq!(gap["records_in_contact"], 2);
    let root = named(
        &gap["combinations"],
        "rule",
        "square_root_of_sum_of_squares",
    );
    close(&root["width"][0][2], 0.116_072, 2e-4);
    let sum = named(&gap["combinations"], "rule", "absolute_sum");
    close(&sum["width"][0][2], 0.134_903, 2e-4);
    let nbcc = &named(&gap["provisions"], "name", "nbcc_2015_between")["records"][0];
    close(&nbcc["ratio_to_demand"], 0.116_112 / 0.117_207, 2e-4);
    // Cd / R = 0.9 of the square root.
    let asce = &named(&gap["provisions"], "name", "asce_7_10_between")["records"][0];
    close(&asce["width"], 0.9 * 0.116_072, 2e-4);
    let taiwan = named(&gap["provisions"], "name", "taiwan_2011_between");
    assert!(
        taiwan["refusal"]
            .as_str()
            .unwrap()
            .contains("yield_amplification")
    );
    close(&gap["required"]["by_count"], 0.402_87, 1e-4);
}

/// Beside a wall the demand is the displacement towards it: a rule that asks for the
/// displacement itself is exceeded by no record. Undamped buildings have no correlation.
#[test]
fn walls_and_undamped_buildings() {
    let wall = json(&gap("rigid_wall", &["--points", "0", "--json"]));
    let gap_to_wall = &wall["gaps"][0];
    assert_eq!(gap_to_wall["combinations"], serde_json::json!([]));
    let nzs = named(&gap_to_wall["provisions"], "name", "nzs_1170_5_boundary");
    close(&nzs["records"][0]["ratio_to_demand"], 1.0, 1e-6);
    let between = named(&gap_to_wall["provisions"], "name", "nbcc_2015_between");
    assert!(between["refusal"].as_str().unwrap().contains("either side"));
    let shown = text(&gap("rigid_wall", &["--points", "0", "--all"]).stdout);
    let line = shown.lines().find(|l| l.contains("nzs_1170_5_boundary"));
    assert!(line.unwrap().contains("0 of 1"), "{shown}");
    let undamped = json(&gap("snap_back", &["--points", "0", "--json"]));
    let difference = named(
        &undamped["gaps"][0]["combinations"],
        "rule",
        "double_difference",
    );
    assert_eq!(difference["correlation"], 0.0);
}

/// The case of the tutorial, taken from its text, with the numbers that the text gives.
#[test]
fn the_tutorial() {
    let tutorial =
        std::fs::read_to_string(root().join("docs/tutorial/from-a-record-to-a-defended-gap.md"))
            .unwrap();
    let case = tutorial.split("```toml\n").nth(1).unwrap();
    let case = case.split("```").next().unwrap();
    let motions = root().join("ground_motions").canonicalize().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let case = case.replace("\"ground_motions", &format!("\"{}", motions.display()));
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let arguments = [
        "--points",
        "0",
        "--json",
        "--set",
        "response_modification=5",
        "--set",
        "displacement_amplification=4.5",
        "--set",
        "importance=1",
        "--set",
        "soil_zone=\"II\"",
        "--provisions",
        "asce_7_10_between,mexico_city_2004_boundary",
    ];
    let output = gap(folder.path().to_str().unwrap(), &arguments);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let result = json(&output);
    let amplification = &result["records"][0]["amplification"][0];
    close(&amplification[0]["displacement"], 1.667, 1e-3);
    close(&amplification[1]["acceleration_absolute"], 28.92, 1e-3);
    let provisions = &result["gaps"][0]["provisions"];
    assert_eq!(
        provisions.as_array().unwrap().len(),
        2,
        "only those asked for"
    );
    let asce = named(provisions, "name", "asce_7_10_between");
    close(&asce["records"][0]["ratio_to_demand"], 0.892, 1e-3);
    let mexico = named(provisions, "name", "mexico_city_2004_boundary");
    close(&mexico["records"][0]["width"], 0.191_2, 1e-3);
    let explanation = mexico["records"][0]["levels"][2]["explanation"]
        .as_str()
        .unwrap();
    assert!(explanation.contains("u(light) = 0.114"), "{explanation}");
}

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

/// At the width of the square-root rule El Centro closes the gap once.
#[test]
fn a_gap_by_the_rule_is_closed() {
    let result = json(&gap("gap_check", &["--points", "0", "--json"]));
    let record = &result["records"][0];
    assert_eq!(record["impacts"][0], serde_json::json!([0, 0, 1]));
    let roof = &record["amplification"][0][2];
    assert!(roof["acceleration_absolute"].as_f64().unwrap() > 1.5);
    // The contact cuts the roof's peak by no more than the 1.1 mm that the rule lacks.
    let displacement = roof["displacement"].as_f64().unwrap();
    assert!((0.99..1.0).contains(&displacement), "{displacement}");
}

#[test]
fn wide_enough_is_exit_code_zero() {
    let folder = tempfile::tempdir().unwrap();
    let file = root().join("examples/gap_check/case.toml");
    let motions = root().join("ground_motions").canonicalize().unwrap();
    let case = std::fs::read_to_string(file).unwrap();
    let case = case.replace("116.1 mm", "117.3 mm");
    let case = case.replace("../../ground_motions", motions.to_str().unwrap());
    let path = folder.path().join("case.toml");
    std::fs::write(&path, case).unwrap();
    let output = gap(path.parent().unwrap().to_str().unwrap(), &["--points", "0"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let numbers = json(&gap(
        path.parent().unwrap().to_str().unwrap(),
        &["--points", "0", "--json"],
    ));
    let rules = &numbers["gaps"][0];
    // 117.3 mm lie above the root, 116.1, and below the sum, 134.9.
    let root = named(&rules["provisions"], "name", "nbcc_2015_between");
    assert_eq!(root["satisfied"], true);
    let sum = named(&rules["combinations"], "rule", "absolute_sum");
    assert_eq!(sum["satisfied"], false);
    let shown = text(&output.stdout);
    assert!(
        shown.contains("WIDE ENOUGH - 0 of 1 record closes it"),
        "{shown}"
    );
    assert!(
        shown.contains("unverified"),
        "unverified provisions are labelled"
    );
}

/// The sweep's table, picture and worst width. 60 mm by an independent fixed-step
/// solution with the law of the three-storey pair: roof 0.1323 m against 0.114253 m.
#[test]
fn sweep_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (csv, codes, svg) = (path("sweep.csv"), path("codes.csv"), path("sweep.svg"));
    let arguments = [
        "--from",
        "20 mm",
        "--to",
        "120 mm",
        "--points",
        "6",
        "--csv",
        &csv,
        "--codes-csv",
        &codes,
        "--plot",
        &svg,
    ];
    let output = gap("three_storey_pair", &arguments);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let sweep = std::fs::read_to_string(&csv).unwrap();
    assert_eq!(sweep.lines().count(), 1 + 6 * 6, "six widths, six storeys");
    let roof = sweep
        .lines()
        .find(|l| l.starts_with("0.06,el_centro_1940_ns,light,3,"))
        .unwrap_or_else(|| panic!("{sweep}"));
    let value: f64 = roof.split(',').nth(4).unwrap().parse().unwrap();
    assert!(
        (value / (0.132_3 / 0.114_253) - 1.0).abs() < 3e-3,
        "{value}"
    );
    let codes = std::fs::read_to_string(&codes).unwrap();
    assert!(
        codes
            .lines()
            .any(|l| l.contains("nbcc_2015_between,seen in a secondary text,0.116"))
    );
    assert!(codes.lines().any(|l| l.contains("unverified")));
    assert!(std::fs::read_to_string(&svg).unwrap().contains("<svg"));
    assert!(text(&output.stdout).contains("displacement worst at"));
}

const BEHAVIOUR: [&str; 6] = [
    "--set",
    "response_modification=5",
    "--set",
    "displacement_amplification=4.5",
    "--set",
    "importance=1",
];

/// A code that multiplies elastic displacements says so, and decides nothing where the
/// buildings yield: in the table, the JSON object and the CSV file.
#[test]
fn codes_are_marked_where_buildings_yield() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("codes.csv");
    let answers = |example: &str| {
        let mut arguments = BEHAVIOUR.to_vec();
        arguments.extend([
            "--points",
            "0",
            "--all",
            "--codes-csv",
            csv.to_str().unwrap(),
        ]);
        let shown = text(&gap(example, &arguments).stdout);
        arguments.push("--json");
        let result = json(&gap(example, &arguments));
        (shown, result, std::fs::read_to_string(&csv).unwrap())
    };
    let line = |shown: &str, rule: &str| {
        let line = shown.lines().find(|l| l.contains(rule));
        line.unwrap_or_else(|| panic!("{shown}")).to_owned()
    };
    let (shown, result, codes) = answers("yielding_pair");
    let provisions = &result["gaps"][0]["provisions"];
    for (rule, factor) in [
        ("asce_7_10_between", "Cd / Ie"),
        ("ubc_1997_between", "0.7 R"),
    ] {
        let provision = named(provisions, "name", rule);
        assert_eq!(provision["elastic_displacement_factor"], factor);
        assert!(provision["satisfied"].is_null());
        let caution = provision["caution"].as_str().unwrap();
        assert!(
            caution.contains("light and heavy is inelastic"),
            "{caution}"
        );
        let level = &provision["records"][0]["levels"][2];
        assert!(level["width"].as_f64().unwrap() > 0.0);
        assert_eq!(level["caution"], caution);
        let row = line(&shown, rule);
        assert!(
            row.contains(factor) && row.contains("not judged: elastic only"),
            "{row}"
        );
        let row = line(&codes, rule);
        assert!(row.contains(factor) && row.contains("inelastic"), "{row}");
    }
    let sum = named(provisions, "name", "ntc_2018_between");
    assert!(sum["caution"].is_null() && sum["satisfied"].is_boolean());
    let storeys = &result["records"][0]["isolated"][0]["inelastic_storeys"];
    assert_eq!(storeys[0]["storey"], 1);
    let ductility = storeys[0]["ductility"].as_f64().unwrap();
    assert!(ductility > 1.2, "{ductility}");
    let said = format!("light under 1 of 1 record (maximum ductility {ductility:.2}, storey 1");
    assert!(shown.contains(&said), "{said}: {shown}");
    assert!(shown.contains("these widths decide nothing"), "{shown}");

    let (shown, result, codes) = answers("three_storey_pair");
    let provisions = &result["gaps"][0]["provisions"];
    let asce = named(provisions, "name", "asce_7_10_between");
    assert!(asce["caution"].is_null() && asce["satisfied"].is_boolean());
    assert!(
        line(&shown, "asce_7_10_between").contains("Cd / Ie"),
        "{shown}"
    );
    for text in [&shown, &codes] {
        assert!(
            !text.contains("not judged: elastic only") && !text.contains("inelastic"),
            "{text}"
        );
    }
}

#[test]
fn a_list_takes_no_option_of_a_check() {
    for more in [
        "--points=5",
        "--code=ntc",
        "--probability=0.1",
        "--csv=a.csv",
        "--all",
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .args(["gap", "--list", more])
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{more}");
        let said = text(&output.stderr);
        assert!(said.contains("cannot be used with"), "{more}: {said}");
    }
}

#[test]
fn provisions_are_listed_with_their_status() {
    let list = |more: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .args(["gap", "--list"])
            .args(more)
            .output()
            .unwrap();
        assert!(output.status.success());
        text(&output.stdout)
    };
    let shown = list(&[]);
    assert!(shown.contains("unverified: the clause"), "{shown}");
    assert!(
        shown.contains("NTC-Sismo 2017 and 2023"),
        "codes without a formula"
    );
    let result: Value = serde_json::from_str(&list(&["--json"])).unwrap();
    let provisions = result["provisions"].as_array().unwrap();
    assert!(provisions.len() > 50);
    for p in provisions {
        let statuses = ["seen in a secondary text", "unverified", "disputed"];
        assert!(statuses.contains(&p["status"].as_str().unwrap()));
        for said in ["displacement", "height", "ownership", "alignment"] {
            assert!(
                p["assumptions"][said]
                    .as_str()
                    .is_some_and(|s| !s.is_empty()),
                "{p}"
            );
        }
        assert!(p["source"].as_str().is_some_and(|s| !s.is_empty()), "{p}");
    }
    let factor =
        |name| named(&result["provisions"], "name", name)["elastic_displacement_factor"].clone();
    assert_eq!(factor("is_1893_2016_between"), "R");
    assert!(factor("ntc_2018_between").is_null());
    let line = shown.lines().find(|l| l.contains("is_1893_2016_between"));
    assert!(shown.contains("elastic displacement times"), "{shown}");
    assert!(line.unwrap().contains(" R "), "{shown}");
}

/// A folder with a case of two buildings that are alike, a gap of this width apart.
fn alike_buildings(width: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let case = std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"));
    let records = root().join("ground_motions").display().to_string();
    let case = case
        .unwrap()
        .replace("\"1000 t\"", "\"25 t\"")
        .replace("\"2215 MN/m\"", "\"3.46 MN/m\"")
        .replace("\"20 mm\"", &format!("\"{width}\""))
        .replace("\"31 s\"", "\"10 s\"")
        .replace("../../ground_motions", &records);
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    folder
}

fn gap_in(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args(["gap", "case.toml"])
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// The example with another gap, the record where the case finds it.
fn example_with(width: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let case = std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"));
    let records = root().join("ground_motions").display().to_string();
    let case = case
        .unwrap()
        .replace("\"20 mm\"", width)
        .replace("../../ground_motions", &records);
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    folder
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

/// Widths of 40, 95 and 130 mm against demands of 49, 92 and 117 mm: the lowest level closes, and
/// answer, numbers and page say so, not what the roof demands.
#[test]
fn the_level_of_the_least_margin_governs() {
    for (widths, level, verdict, left) in [
        ([40, 95, 130], 1, "TOO SMALL", "9.45 mm short"),
        ([50, 95, 118], 1, "WIDE ENOUGH", "0.55 mm left"),
        ([60, 92, 118], 2, "WIDE ENOUGH", "0.19 mm left"),
    ] {
        let list = widths.map(|width| format!("\"{width} mm\"")).join(", ");
        let folder = example_with(&format!("[{list}]"));
        let arguments = ["--points", "3", "--report", "page.html"];
        let output = gap_in(folder.path(), &arguments);
        let shown = text(&output.stdout);
        assert_eq!(
            output.status.code(),
            Some(i32::from(verdict == "TOO SMALL"))
        );
        let governs = format!("level {level}-{level} governs: required ");
        let line = shown.lines().find(|line| line.contains(&governs)).unwrap();
        let provided = widths[level - 1];
        assert!(
            line.contains(&format!("provided {provided}.0 mm, {left}")),
            "{line}"
        );
        assert!(shown.contains(verdict), "{shown}");
        assert!(
            shown.contains("one width at all levels would have to be 117.16 mm by count"),
            "{shown}"
        );
        let found = json(&gap_in(folder.path(), &["--points", "0", "--json"]))["gaps"][0].clone();
        assert_eq!(found["governing_level"], level);
        let governing = &found["governing"];
        assert_eq!(governing["level"], level);
        assert_eq!(governing["record"], "el_centro_1940_ns");
        close(&governing["provided"], 1e-3 * f64::from(provided), 1e-12);
        assert_eq!(
            governing["required"],
            found["levels"][level - 1]["demand"][0]["peak"]
        );
        let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
        assert!(page.contains(&format!("Level {level}-{level} governs: ")));
        assert!(page.contains(" mm at all levels is needed so that no record closes it"));
        assert!(!page.contains("minimum width of its levels"));
        // A width of the sweep is that of all levels, the one that is provided is not.
        assert!(page.contains(&format!(
            "provided at level {level}-{level}: {provided}.0 mm"
        )));
    }
}

/// The example with storeys that yield under gravity, so that a strong motion overturns the light
/// building.
fn example_that_collapses(width: &str) -> tempfile::TempDir {
    let folder = example_with(width);
    let file = folder.path().join("case.toml");
    let case = std::fs::read_to_string(&file).unwrap();
    let law = "height = \"3 m\"\np_delta = true\nlaw = { model = \"elastic_perfectly_plastic\", yield_force = \"110 kN\" }";
    let case = case
        .replacen("height = \"3 m\"", law, 1)
        .replace("damping_ratio = 0.35", "restitution = 0.65");
    std::fs::write(&file, case).unwrap();
    folder
}

/// One of two records overturns a building without contact: it has no demand, and is in contact
/// whatever the width; the other one is answered as by itself.
#[test]
fn a_record_that_overturns_a_building_fits_no_gap() {
    let folder = example_that_collapses("\"200 mm\"");
    let motions = root().join("ground_motions");
    let motion = |name: &str| motions.join(name).display().to_string();
    let both = [
        "--records",
        &motion("el_centro_1940_ns.csv"),
        &motion("kobe_1995_jma_ns.csv"),
    ];
    let call = |records: &[&str], others: &[&str]| {
        gap_in(
            folder.path(),
            &[records, &["--points", "3"], others].concat(),
        )
    };
    let alone = json(&call(&both[..2], &["--json"]));
    let alone = &alone["gaps"][0];
    assert_eq!(alone["adequate"], true, "{alone}");

    let output = call(
        &both,
        &["--json", "--report", "page.html", "-o", "answer.json"],
    );
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let found = json(&output);
    let gap = &found["gaps"][0];
    assert_eq!(found["records"].as_array().map(Vec::len), Some(1));
    assert_eq!(found["records"][0]["name"], "el_centro_1940_ns");
    let collapsed = &found["collapsed"][0];
    assert_eq!(found["collapsed"].as_array().map(Vec::len), Some(1));
    assert_eq!(collapsed["name"], "kobe_1995_jma_ns");
    assert_eq!(collapsed["building"], "light");
    let time = collapsed["time"].as_f64().unwrap();
    let diagnosis = collapsed["diagnosis"].as_str().unwrap();
    assert!(
        time > 0.0 && diagnosis.starts_with("light collapsed at t = "),
        "{collapsed}"
    );
    assert_eq!(
        (&gap["adequate"], &found["adequate"]),
        (&false.into(), &false.into())
    );
    assert_eq!(gap["records_in_contact"], 1);
    assert!(gap["required"]["by_count"].is_null() && gap["governing"].is_null());
    // One of two seen, as Clopper and Pearson bound it.
    let bounds = &gap["contact_probability_bounds"];
    close(&bounds[0], 1.0 - 0.95_f64.sqrt(), 1e-9);
    close(&bounds[1], 0.95_f64.sqrt(), 1e-9);
    for key in ["demand", "suite", "levels", "combinations"] {
        assert_eq!(gap[key], alone[key], "{key}");
    }
    assert_eq!(found["spectra"]["records"][1], "kobe_1995_jma_ns");
    assert_eq!(
        found["spectra"]["pseudo_acceleration"]
            .as_array()
            .map(Vec::len),
        Some(2)
    );
    assert_eq!(found["sweep"]["runs"][0].as_array().map(Vec::len), Some(1));
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    for said in [
        "<strong>light collapses without contact</strong> under kobe_1995_jma_ns: light collapsed at t = ",
        "1 of 2 records bring its buildings into contact; none may.</li>",
        "No width is enough: under 1 record a building collapses without contact.",
        "is too small",
    ] {
        assert!(page.contains(said), "{said}");
    }

    let shown = text(&call(&both, &[]).stdout);
    let shown = shown.split_whitespace().collect::<Vec<_>>().join(" ");
    for said in [
        "Collapse without contact under 1 of 2 records, which no gap is wide enough for",
        &format!("kobe_1995_jma_ns: {diagnosis}"),
        "TOO SMALL - 1 of 2 records close it, 0 allowed",
        "no width is required by count: 0 of 2 records may touch, and under 1 a building collapses without contact",
    ] {
        assert!(shown.contains(said), "{said}\n{shown}");
    }

    // Where one of two may touch it is that one.
    let half = call(&both, &["--probability", "0.5", "--json"]);
    assert_eq!(half.status.code(), Some(0), "{}", text(&half.stderr));
    let half = json(&half)["gaps"][0].clone();
    assert_eq!(half["required"]["by_count"], alone["required"]["by_count"]);
    assert_eq!(half["governing"], alone["governing"]);
    assert!(half["required"]["lognormal"].is_null(), "{half}");

    // A code has no statistic of displacements without end.
    let by_code = call(
        &both,
        &["--code", "eurocode_8", "--probability", "0.5", "--json"],
    );
    assert_eq!(by_code.status.code(), Some(1));
    assert!(json(&by_code)["gaps"][0]["code"]["satisfied"].is_null());

    // Shards agree, whoever makes them.
    for shard in ["1/2", "2/2"] {
        let output = call(&both, &["--shard", shard, "--into", "parts"]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    }
    assert_eq!(json(&call(&both, &["--merge", "parts", "--json"])), found);
}

/// Where all records overturn a building there is no demand, and no answer.
#[test]
fn records_that_all_overturn_a_building_leave_no_answer() {
    let folder = example_that_collapses("\"200 mm\"");
    let kobe = root().join("ground_motions/kobe_1995_jma_ns.csv");
    std::fs::copy(&kobe, folder.path().join("other.csv")).unwrap();
    let kobe = kobe.display().to_string();
    for (records, said) in [
        (vec!["--records", &kobe], "record kobe_1995_jma_ns"),
        (
            vec!["--records", &kobe, "other.csv"],
            "under all 2 records a building collapses without contact; record kobe_1995_jma_ns",
        ),
    ] {
        let output = gap_in(folder.path(), &[&records[..], &["--points", "0"]].concat());
        assert_eq!(output.status.code(), Some(3));
        let errors = text(&output.stderr);
        let errors = errors.replace('\u{2502}', " ");
        let errors = errors.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            errors.contains(said) && errors.contains("light collapsed at t ="),
            "{errors}"
        );
    }
}

/// Storeys that yield under gravity: pounding overturns the building at some widths, at which
/// nothing is said of ratios of peaks, and which are the worst.
#[test]
fn widths_at_which_a_building_collapses_are_the_worst() {
    let folder = example_that_collapses("\"20 mm\"");
    let file = folder.path().join("case.toml");
    let case = std::fs::read_to_string(&file).unwrap();
    let case = case.replace("[ground_motion]", "[ground_motion]\nscale = 1.2");
    std::fs::write(&file, case).unwrap();
    let sweep = ["--points", "3", "--from", "5 mm", "--to", "65 mm"];
    let shown = text(&gap_in(folder.path(), &sweep).stdout);
    assert!(shown.contains("to collapse"), "{shown}");
    let worst = shown.lines().find(|l| l.starts_with("light: worst at "));
    assert!(
        worst
            .unwrap()
            .ends_with("where pounding brings it to collapse")
    );
    assert!(shown.contains("pounding brings light to collapse: light collapsed at t = "));
    assert!(shown.contains("light: otherwise "), "{shown}");
    assert!(
        shown.contains("|       5.00 |            collapse |"),
        "{shown}"
    );
    assert!(!shown.contains("of the sweep failed"), "{shown}");
    let mut arguments = sweep.to_vec();
    arguments.extend(["--json", "--report", "page.html"]);
    let found = json(&gap_in(folder.path(), &arguments));
    assert_eq!(found["records"][0]["collapsed"], "light");
    assert_eq!(found["sweep"]["runs"][0][0]["collapsed"], "light");
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    assert!(page.contains("<strong>Pounding brings light to collapse</strong> at "));
    assert!(page.contains("<strong>Pounding brings light to collapse</strong> under el_centro"));
}

/// Buildings that are alike move alike: no demand, no sweep, and an answer all the same.
#[test]
fn alike_buildings_need_no_sweep() {
    let folder = alike_buildings("20 mm");
    let call = |arguments: &[&str]| gap_in(folder.path(), arguments);
    let output = call(&["--csv", "x.csv", "--plot", "x.svg"]);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(shown.contains("WIDE ENOUGH"), "{shown}");
    assert!(shown.contains("No sweep: under no record"), "{shown}");
    let csv = std::fs::read_to_string(folder.path().join("x.csv")).unwrap();
    assert!(
        csv.starts_with("width_m,record") && csv.lines().count() == 1,
        "{csv}"
    );
    assert!(folder.path().join("x.svg").is_file());
    let widths = json(&call(&["--json"]))["sweep"]["widths"].clone();
    assert_eq!(widths.as_array().map(Vec::len), Some(0));
    let output = call(&["--from", "10 mm"]);
    assert_eq!(output.status.code(), Some(2));
    let said = text(&output.stderr);
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        said.contains("out of range: it must be less than"),
        "{said}"
    );
    let swept = json(&call(&["--to", "10 mm", "--points", "2", "--json"]))["sweep"].clone();
    assert_eq!(swept["runs"][0][0]["impacts"], 0, "{swept}");
}

/// Where nothing is demanded, a rule is told with the widest gap that it asks for, which the
/// verdict beside it and `--json` mean too.
#[test]
fn alike_buildings_are_told_the_widest_gap_of_a_rule() {
    let folder = alike_buildings("150 mm");
    let shown = text(&gap_in(folder.path(), &["--points", "0", "--all"]).stdout);
    let report = json(&gap_in(folder.path(), &["--points", "0", "--json"]));
    for (rule, told) in [
        ("absolute_sum", "228.4"),
        ("square_root_of_sum_of_squares", "161.5"),
    ] {
        let combination = named(&report["gaps"][0]["combinations"], "rule", rule);
        let widths = combination["width"][0].as_array().unwrap().iter();
        let widest = widths.filter_map(Value::as_f64).fold(0.0, f64::max);
        assert_eq!(format!("{:.1}", widest * 1e3), told);
        let mut rows = shown.lines().filter(|l| l.starts_with('|'));
        let line = rows.find(|l| l.contains(&format!(" {rule} ")));
        let cells: Vec<&str> = line.unwrap().split('|').map(str::trim).collect();
        assert_eq!(cells[4..7], [told, "no", "-"], "{shown}");
    }
    assert!(!shown.contains("inf"), "{shown}");
}

/// The numbers of `docs/how-to/seven-records-one-code.md`.
#[test]
fn seven_records_one_code() {
    let motions = (1..=7).map(|i| format!("examples/synthetic_suite/motion_{i}.csv"));
    let motions: Vec<String> = motions.collect();
    let mut arguments = vec!["--records"];
    arguments.extend(motions.iter().map(String::as_str));
    let provisions = [
        "--provisions",
        "en_1998_1_2004_between",
        "nbcc_2015_between",
    ];
    arguments.extend(provisions);
    arguments.extend(["--probability", "0.1", "--points", "0"]);
    let output = gap("gap_check", &arguments);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let page = root().join("docs/how-to/seven-records-one-code.md");
    let page = std::fs::read_to_string(page).unwrap();
    for (rule, numbers) in [
        ("absolute_sum", ["155.3 to 161.7", "1.074", "0 of 7"]),
        (
            "square_root_of_sum_of_squares (SRSS)",
            ["136.7 to 143.0", "0.945", "3 of 7"],
        ),
        (
            "double_difference (DDC)",
            ["136.6 to 142.9", "0.944", "3 of 7"],
        ),
        (
            "en_1998_1_2004_between",
            ["95.7 to 100.1", "0.661", "7 of 7"],
        ),
        ("nbcc_2015_between", ["136.7 to 143.0", "0.945", "3 of 7"]),
    ] {
        for text in [&shown, &page] {
            let row = text
                .lines()
                .find(|l| l.starts_with('|') && l.contains(rule));
            let row = row.unwrap_or_else(|| panic!("{rule} is not in {text}"));
            let cells: Vec<&str> = row.split('|').map(str::trim).collect();
            for number in numbers {
                assert!(cells.contains(&number), "{number} is not in {row}");
            }
        }
    }
    for number in [
        "148.95 mm by count",
        "152.96 mm",
        "144.77 to 172.89 mm",
        "TOO SMALL",
    ] {
        assert!(shown.contains(number), "{number} is not in {shown}");
    }
}

/// The seven motions of the suite, and what comes after.
fn seven<'a>(motions: &'a [String], more: &[&'a str]) -> Vec<&'a str> {
    let mut arguments = vec!["--records"];
    arguments.extend(motions.iter().map(String::as_str));
    arguments.extend(["--points", "0"]);
    arguments.extend(more);
    arguments
}

fn motions(count: usize) -> Vec<String> {
    (1..=count)
        .map(|i| format!("examples/synthetic_suite/motion_{i}.csv"))
        .collect()
}

/// The answer of Eurocode 8 from the displacements of each record in the same object, by hand:
/// the mean of seven records, the maximum of six, root or sum, times 0.7 for floors that are
/// aligned.
#[test]
fn one_code_decides_by_its_statistic() {
    for (count, statistic) in [(7, "mean"), (6, "maximum")] {
        let files = motions(count);
        let answer = |more: &[&str]| {
            let arguments = seven(&files, &["--code", "eurocode_8_2004", "--json"]);
            let output = gap("gap_check", &[&arguments[..], more].concat());
            (output.status.code(), json(&output))
        };
        let (exit, result) = answer(&[]);
        assert_eq!(exit, Some(0));
        assert_eq!(result["adequate"], true);
        assert_eq!(result["decided_by_code"], "eurocode_8_2004");
        let roof = |building: usize| {
            let records = result["records"].as_array().unwrap().iter();
            let peaks = records.map(|r| &r["isolated"][building]["displacement"][2]["peak"]);
            let peaks: Vec<f64> = peaks.map(|p| p.as_f64().unwrap()).collect();
            match count {
                7 => peaks.iter().sum::<f64>() / 7.0,
                _ => peaks.iter().copied().fold(0.0, f64::max),
            }
        };
        let (light, heavy) = (roof(0), roof(1));
        let code = &result["gaps"][0]["code"];
        assert_eq!(code["statistic"], statistic);
        assert_eq!(code["enough_records"], true);
        let [same, different] = [0, 1].map(|i: usize| &code["cases"][i]);
        assert_eq!(same["ownership"], "same property");
        close(&same["required"], 0.7 * light.hypot(heavy), 1e-12);
        assert_eq!(different["ownership"], "different properties");
        close(&different["required"], 0.7 * (light + heavy), 1e-12);
        assert_eq!(same["governing_level"], 3);
        assert_eq!(same["levels"][2]["provision"]["status"], "unverified");
        // Each of these records closes the gap that the code accepts, and the program says so.
        assert_eq!(result["gaps"][0]["adequate"], false);
        let suite = &result["gaps"][0]["suite"];
        let demand: Vec<f64> = result["gaps"][0]["demand"]
            .as_array()
            .unwrap()
            .iter()
            .map(|d| d.as_f64().unwrap())
            .collect();
        close(
            &suite["mean"],
            demand.iter().sum::<f64>() / count as f64,
            1e-12,
        );
        close(
            &suite["maximum"],
            demand.iter().copied().fold(0.0, f64::max),
            1e-15,
        );
    }
    let files = motions(7);
    let arguments = seven(&files, &["--code", "eurocode_8_2004"]);
    let output = gap("gap_check", &arguments);
    let shown = text(&output.stdout);
    let headline = "Gap light-heavy by eurocode_8_2004 (EN 1998-1:2004): WIDE ENOUGH";
    assert_eq!(shown.lines().nth(2), Some(headline), "{shown}");
    assert!(shown.contains("decided by the mean of the displacements under 7 records"));
    assert!(shown.contains("a width that the code accepts"), "{shown}");
    assert!(
        !shown.contains("nzs_1170_5"),
        "other rules are folded: {shown}"
    );
    let all = [&arguments[..], &["--all"]].concat();
    assert!(text(&gap("gap_check", &all).stdout).contains("nzs_1170_5"));
}

/// Records that the case scales to a code: the mean spectrum beside the target, and each
/// factor. The factor of a record is that of `motion process` to the same spectrum.
#[test]
fn a_suite_scaled_to_a_code() {
    let folder = tempfile::tempdir().unwrap();
    let file = root().join("examples/gap_check/case.toml");
    let records = root().join("ground_motions").canonicalize().unwrap();
    let case = std::fs::read_to_string(file).unwrap();
    let case = case.replace("../../ground_motions", records.to_str().unwrap());
    let scale = "scale = { code = \"eurocode_8_2004\", ground_type = \"C\", ag = \"0.25 g\", from = \"0.2 s\", to = \"2 s\" }";
    let case = case.replace("[ground_motion]", &format!("[ground_motion]\n{scale}"));
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let place = folder.path().to_str().unwrap();
    let arguments = ["--records", "ground_motions", "--points", "0"];
    let result = json(&gap(place, &[&arguments[..], &["--json"]].concat()));
    let target = &result["spectra"]["target"];
    assert!(
        target["name"]
            .as_str()
            .unwrap()
            .starts_with("eurocode_8_2004, ag 0.25 g")
    );
    assert_eq!((&target["from"], &target["to"]), (&0.2.into(), &2.0.into()));
    let spectra = &result["spectra"];
    assert_eq!(spectra["periods"].as_array().unwrap().len(), 200);
    let at = |list: &Value| list[100].as_f64().unwrap();
    let both = &spectra["pseudo_acceleration"];
    close(
        &spectra["mean"][100],
        0.5 * (at(&both[0]) + at(&both[1])),
        1e-14,
    );
    let least = target["least_ratio_of_mean"].as_f64().unwrap();
    assert!(least < 1.0 && least > 0.3, "{least}");
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args([
            "motion",
            "process",
            "ground_motions/kobe_1995_jma_ns.csv",
            "--json",
            "-o",
        ])
        .arg(folder.path().join("o.csv"))
        .args([
            "--scale",
            "code=eurocode_8_2004, ground_type=C, ag=0.25 g, from=0.2 s, to=2 s",
        ])
        .current_dir(root())
        .output()
        .unwrap();
    let numbers = json(&output)["steps"][0]["numbers"].clone();
    let factor = named(&numbers, "name", "factor")["value"].as_f64().unwrap();
    close(&result["records"][1]["factor"], factor, 1e-15);
    let shown = text(&gap(place, &arguments).stdout);
    assert!(
        shown.contains("by least squares of the logarithm"),
        "{shown}"
    );
    assert!(shown.contains(&format!("{factor:.4}")), "{factor} {shown}");
}

/// Another property needs a sum: 0.7 (137.3 + 20.4) is 110.4 mm, above 105 mm; one property
/// 97.2 mm. Two records are fewer than the code asks for, and a code without its inputs gives
/// no answer, which is not a yes.
#[test]
fn ownership_and_missing_inputs_decide() {
    let folder = tempfile::tempdir().unwrap();
    let file = root().join("examples/gap_check/case.toml");
    let records = root().join("ground_motions").canonicalize().unwrap();
    let case = std::fs::read_to_string(file).unwrap();
    let case = case
        .replace("116.1 mm", "105 mm")
        .replace("../../ground_motions", records.to_str().unwrap())
        .replace("[separation]", "[separation]\ncode = \"eurocode_8_2004\"");
    assert!(case.contains("code = "));
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let folder = folder.path().to_str().unwrap();
    let files = motions(7);
    let page = Path::new(folder).join("page.html");
    let page = page.to_str().unwrap();
    for (owner, exit, verdict) in [("true", 0, "is wide enough"), ("false", 1, "is too small")] {
        let set = format!("same_owner={owner}");
        let output = gap(folder, &seven(&files, &["--set", &set, "--report", page]));
        assert_eq!(output.status.code(), Some(exit), "{}", text(&output.stdout));
        // The page gives the verdict of the code, not that of the records: all of them close it.
        let said = std::fs::read_to_string(page).unwrap();
        let headline = format!("By EN 1998-1:2004 gap light-heavy {verdict}.");
        assert!(said.contains(&headline), "{headline}");
    }
    let few = gap(folder, &seven(&files[..2], &["--report", page]));
    assert_eq!(few.status.code(), Some(1));
    let told = text(&few.stdout);
    assert!(
        told.contains("NO ANSWER") && told.contains("the code asks for 3 records at least"),
        "{told}"
    );
    let said = std::fs::read_to_string(page).unwrap();
    assert!(said.contains("gives no answer for gap light-heavy."));
    let undecided = gap(
        "three_storey_pair",
        &["--points", "0", "--code", "asce_7_2016"],
    );
    assert_eq!(undecided.status.code(), Some(1));
    let said = text(&undecided.stdout);
    assert!(
        said.contains("NO ANSWER") && said.contains("add `response_modification`")
            || said.contains("add `displacement_amplification`"),
        "{said}"
    );
}

/// With fewer records than a code asks for no width decides: the row of the table and every answer
/// of the object say so, as the headline does. TBDY 2018 has one rule whoever owns the ground, and
/// EN 1998-1 two: only of the latter the page says that ownership decides.
#[test]
fn rows_have_the_answer_of_the_headline() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.html").display().to_string();
    let files = motions(6);
    let wide = ["--set", "same_owner=true", "--report", &page];
    let decides = "The case states who owns the ground: same property decides.";
    let told = |code: &str, asked: bool| {
        let mut arguments = wide.to_vec();
        arguments.extend(["--code", code]);
        let shown = text(&gap("gap_check", &seven(&files, &arguments)).stdout);
        let said = std::fs::read_to_string(&page).unwrap();
        assert_eq!(said.contains(decides), asked, "{code}");
        arguments.push("--json");
        let found = json(&gap("gap_check", &seven(&files, &arguments)));
        let found = found["gaps"][0]["code"].clone();
        assert_eq!(found["ownership"].is_string(), asked, "{code}: {found}");
        (shown, found)
    };
    let (shown, found) = told("tbdy_2018", false);
    assert!(shown.contains("the code asks for 11 records at least"));
    assert!(shown.contains("NO ANSWER"), "{shown}");
    let row = shown.lines().find(|l| l.contains("| tbdy_2018_"));
    assert!(row.unwrap().contains("no answer"), "{shown}");
    assert!(found["satisfied"].is_null());
    let answer = &found["cases"][0];
    assert!(answer["satisfied"].is_null(), "{answer}");
    // The width by the maximum is shown all the same.
    assert!(answer["required"].as_f64().unwrap() > 0.0);
    for level in answer["levels"].as_array().unwrap() {
        assert!(level["satisfied"].is_null(), "{level}");
    }
    let (shown, found) = told("eurocode_8_2004", true);
    assert!(!shown.contains("no answer"), "{shown}");
    assert!(found["satisfied"].is_boolean());
    assert!(found["cases"][0]["satisfied"].is_boolean());
}

/// What the sweep of one gap in a row says of impacts is of that gap, as `run` counts them; what
/// happens in the others stands beside it.
#[test]
fn a_sweep_of_one_gap_counts_its_own_impacts() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("x.csv").display().to_string();
    // At its own width first.
    let one = ["--gap", "R2-R3", "--from", "20 mm", "--to", "40 mm"];
    let mut arguments = one.to_vec();
    arguments.extend(["--points", "2", "--csv", &csv]);
    let shown = text(&gap("row_of_five", &arguments).stdout);
    assert!(shown.contains("impacts in"), "{shown}");
    arguments.push("--json");
    let told = json(&gap("row_of_five", &arguments));
    let ran = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args(["run", "--json"])
        .arg(root().join("examples/row_of_five/case.toml"))
        .current_dir(root())
        .output()
        .unwrap();
    let ran = json(&ran);
    let swept = &told["sweep"]["runs"][0][0];
    let ours = ["impacts", "peak_force", "impact_energy"];
    let mut all = 0;
    for (index, of_gap) in ran["gaps"].as_array().unwrap().iter().enumerate() {
        let levels = of_gap["levels"].as_array().unwrap();
        let of = |path: &'static str| levels.iter().filter_map(move |l| l.pointer(path)?.as_f64());
        let here = &swept["gaps"][index];
        assert_eq!(here["impacts"].as_f64(), Some(of("/impacts").sum()));
        assert_eq!(
            here["peak_force"].as_f64(),
            of("/peak_force/peak").reduce(f64::max)
        );
        assert_eq!(
            here["impact_energy"].as_f64(),
            Some(of("/energy_dissipated").sum())
        );
        all += here["impacts"].as_u64().unwrap();
        if index == 1 {
            assert!(ours.iter().all(|key| swept[key] == here[key]), "{swept}");
        }
    }
    let impacts = swept["impacts"].as_u64().unwrap();
    assert!(impacts > 0 && all > impacts, "{swept}");
    let rows = std::fs::read_to_string(csv).unwrap();
    let first: Vec<&str> = rows.lines().nth(1).unwrap().split(',').collect();
    let expected = ours.map(|key| swept[key].as_f64().unwrap());
    let written = [7, 8, 9].map(|i| first[i].parse::<f64>().unwrap());
    assert_eq!(written, expected);
    let together = [
        "--from", "20 mm", "--to", "40 mm", "--points", "2", "--json",
    ];
    let together = json(&gap("row_of_five", &together));
    assert_eq!(together["sweep"]["runs"][0][0]["impacts"], all);
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

fn gap_of_folder(command: &str, folder: &Path) -> Output {
    let mut arguments = vec![command, "examples/gap_check/case.toml", "--records"];
    let folder = folder.display().to_string();
    arguments.push(&folder);
    arguments.push("--json");
    if command == "gap" {
        arguments.extend(["--points", "0"]);
    } else {
        arguments.extend(["--models", "hertz_1882"]);
    }
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args(arguments)
        .current_dir(root())
        .env_remove("COLUMNS")
        .output()
        .unwrap()
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

/// Frames of a bridge feel the motion later one after the other: what the ground adds to the
/// widths by rule is said, and stands in the numbers.
#[test]
fn ground_that_moves_differently_is_said() {
    let output = gap("three_frame_bridge", &["--points", "0", "--json"]);
    let result = json(&output);
    let joint = &result["gaps"][0];
    let ground = &joint["levels"][0]["relative_ground_displacement"][0];
    // What the run of the example reports.
    close(&ground["peak"], 0.0509, 1e-3);
    let sum = named(&joint["combinations"], "rule", "absolute_sum");
    let peaks = [0, 1].map(|b| {
        let peak = &result["records"][0]["isolated"][b]["displacement"][0]["peak"];
        peak.as_f64().unwrap()
    });
    let expected = peaks[0] + peaks[1] + ground["peak"].as_f64().unwrap();
    close(&sum["width"][0][0], expected, 1e-14);
    let printed = text(&gap("three_frame_bridge", &["--points", "0"]).stdout);
    let said = "The ground on both sides moves differently, by up to 50.9";
    assert!(printed.contains(said), "{printed}");
    let alike = gap("gap_check", &["--points", "0", "--json"]);
    let level = &json(&alike)["gaps"][0]["levels"][0];
    assert!(level.get("relative_ground_displacement").is_none());
}
