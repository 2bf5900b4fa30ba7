//! Whether a gap is wide enough: headline numbers of examples, and exit codes.

use std::process::Command;

use super::{close, example_with, gap, gap_in, json, named, root, text};

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
    let roof = nbcc["levels"][2]["width"].as_f64().unwrap() / gap["demand"][0].as_f64().unwrap();
    assert!(
        (roof / (0.116_112 / 0.117_207) - 1.0).abs() < 2e-4,
        "{roof}"
    );
    // At the lowest level it is least: 48.90 for 49.45 mm.
    close(&nbcc["ratio_to_demand"], 0.048_898_5 / 0.049_451_7, 1e-5);
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
    close(&asce["records"][0]["ratio_to_demand"], 0.890, 1e-3);
    let mexico = named(provisions, "name", "mexico_city_2004_boundary");
    close(&mexico["records"][0]["width"], 0.191_2, 1e-3);
    let explanation = mexico["records"][0]["levels"][2]["explanation"]
        .as_str()
        .unwrap();
    assert!(explanation.contains("u(light) = 0.114"), "{explanation}");
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

/// Widths of 40, 95 and 130 mm against demands of 49, 92 and 117 mm: the lowest level closes, and
/// answer, numbers and page say so, not what the roof demands.
#[test]
fn the_level_of_the_least_margin_governs() {
    for (widths, level, verdict, left) in [
        ([40, 95, 130], 1, "TOO SMALL", "9.46 mm short"),
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
            shown.contains("one width at all levels would have to be 117.17 mm by count"),
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

/// Two buildings whose lower levels a rule that multiplies displacements leaves shortest of.
const UNEQUAL: &str = r#"
[[building]]
name = "A"
mass = ["110 kip s^2/ft", "3e5 lb", "250 t", "250 t", "180 t"]
stiffness = ["900 kip/in", "140 kN/mm", "120 MN/m", "100 MN/m", "90 MN/m"]
height = ["14 ft", "11 ft", "3.2 m", "3.2 m", "3.2 m"]
damping = { ratio = 0.05, modes = [1, 3] }
[[building]]
name = "B"
mass = ["400 t", "400 t", "400 t", "300 t"]
stiffness = ["80 MN/m", "80 MN/m", "70 MN/m", "60 MN/m"]
elevations = ["4.5 m", "7.5 m", "10.8 m", "14.0 m"]
damping = { modal = [0.02, 0.03, 0.04, 0.05] }
[[gap]]
between = ["A", "B"]
width = WIDTH
model = "jankowski_2005"
stiffness = "2.75e9 N/m^1.5"
restitution = 0.65
elevation_tolerance = "0.35 m"
[ground_motion]
file = "RECORDS/el_centro_1940_ns.csv"
[separation]
response_modification = [7.5, 4.2]
displacement_amplification = [5.25, 3.3]
importance = [1.15, 1.4]
"#;

/// A rule is held against the demand of every level: a gap of just its widths is closed at the level
/// where it asks for least, though its greatest width exceeds the greatest demand.
#[test]
fn rules_are_judged_level_by_level() {
    let folder = tempfile::tempdir().unwrap();
    let records = root().join("ground_motions").display().to_string();
    let write = |width: &str| {
        let case = UNEQUAL.replace("WIDTH", width).replace("RECORDS", &records);
        std::fs::write(folder.path().join("case.toml"), case).unwrap();
    };
    write("\"0.1 m\"");
    let result = json(&gap_in(folder.path(), &["--points", "0", "--json"]));
    let gap = &result["gaps"][0];
    let demand: Vec<f64> = (gap["levels"].as_array().unwrap().iter())
        .map(|level| level["demand"][0]["peak"].as_f64().unwrap())
        .collect();
    let most = demand.iter().fold(0.0_f64, |m, d| m.max(*d));
    let mut hidden = 0;
    for provision in gap["provisions"].as_array().unwrap() {
        let record = &provision["records"][0];
        let Some(ratio) = record["ratio_to_demand"].as_f64() else {
            continue;
        };
        let levels = record["levels"].as_array().unwrap().iter().zip(&demand);
        let ratios = levels.filter_map(|(level, demand)| Some(level["width"].as_f64()? / demand));
        let least = ratios.fold(f64::INFINITY, f64::min);
        assert!((ratio / least - 1.0).abs() < 1e-12, "{}", provision["name"]);
        let of_maxima = record["width"].as_f64().unwrap() / most;
        hidden += usize::from(least < 1.0 && of_maxima > 1.0);
    }
    assert!(hidden > 0, "no rule whose greatest width hides a low level");
    let ubc = named(&gap["provisions"], "name", "ubc_1997_between");
    let levels = ubc["records"][0]["levels"].as_array().unwrap();
    let widths: Vec<String> = levels.iter().map(|l| l["width"].to_string()).collect();
    write(&format!("[{}]", widths.join(", ")));
    let shown = text(&gap_in(folder.path(), &["--points", "0", "--all"]).stdout);
    let line = shown.lines().find(|l| l.contains(" ubc_1997_between "));
    let line = line.unwrap_or_else(|| panic!("{shown}"));
    assert!(line.contains("1 of 1"), "{line}");
    let run = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args(["run", "case.toml", "--json"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    let impacts = &json(&run)["gaps"][0]["levels"][0]["impacts"];
    assert!(impacts.as_u64().unwrap() > 0, "{impacts}");
}

/// The demand of 160.11287 mm is one number wherever it is asked for: rounded up to the digits that are shown, and with
/// what is short of it no less when both are added.
#[test]
fn a_required_gap_is_rounded_up_everywhere() {
    let case = r#"
[[building]]
name = "a"
storeys = 2
mass = "50 t"
stiffness = "30 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
law = { model = "bilinear", yield_force = "200 kN", hardening_ratio = 0.05 }
[[building]]
name = "b"
storeys = 3
mass = "80 t"
stiffness = "200 MN/m"
height = "3 m"
damping = { ratio = 0.05, modes = [1, 2] }
[[gap]]
between = ["a", "b"]
width = ["5 mm", "10 mm"]
model = "anagnostopoulos_2004"
stiffness = "93.5 MN/m"
restitution = 0.65
[ground_motion]
file = "kobe.csv"
[analysis]
duration = "12 s"
"#;
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let record = root().join("ground_motions/kobe_1995_jma_ns.csv");
    std::fs::copy(record, folder.path().join("kobe.csv")).unwrap();
    let shown = gap_in(
        folder.path(),
        &["--points", "3", "--report", "page.html", "--plot", "w.svg"],
    );
    let shown = text(&shown.stdout);
    let found = json(&gap_in(folder.path(), &["--points", "0", "--json"]));
    let required = &found["gaps"][0]["required"]["by_count"];
    close(required, 0.160_112_87, 1e-6);
    for said in [
        "required 160.12 mm (the demand of kobe), provided 10.0 mm, 150.12 mm short",
        "would have to be 160.12 mm by count",
    ] {
        assert!(shown.contains(said), "{said}: {shown}");
    }
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    let picture = std::fs::read_to_string(folder.path().join("w.svg")).unwrap();
    for drawn in [&page, &picture] {
        assert!(
            drawn.contains("required by the records 160.2 mm"),
            "{drawn}"
        );
    }
    assert!(page.contains("value=\"160.2\">160.2</data> mm are required there"));
    // A width between the required one and the same rounded up is wide enough, and does not look too small.
    let narrow = "width = \"160.113 mm\"";
    let enough = case.replace("width = [\"5 mm\", \"10 mm\"]", narrow);
    std::fs::write(folder.path().join("case.toml"), enough).unwrap();
    let shown = text(&gap_in(folder.path(), &["--points", "0"]).stdout);
    for said in [
        "WIDE ENOUGH",
        "required 160.113 mm by count",
        "provided 160.113 mm at level",
        // In the table of demands, too.
        "160.113 @",
    ] {
        assert!(shown.contains(said), "{said}: {shown}");
    }
    // What a rule asks for suffices as it is shown, too: by the absolute sum, in the table and on the page.
    let sum = &named(&found["gaps"][0]["combinations"], "rule", "absolute_sum")["width"];
    let widths = sum[0].as_array().unwrap().iter();
    let most = widths
        .map(|w| 1e3 * w.as_f64().unwrap())
        .fold(0.0, f64::max);
    let up = format!("{:.1}", (10.0 * most).ceil() / 10.0);
    assert!(
        shown.contains(&format!("the widest is {up} mm by absolute_sum")),
        "{most}: {shown}"
    );
    let row = page.split(">absolute_sum</th>").nth(1).unwrap();
    let row = row.split("</tr>").next().unwrap();
    assert!(row.contains(&format!("<td>{up}</td>")), "{most}: {row}");
}
