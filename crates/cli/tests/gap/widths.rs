//! The sweep over widths.

use std::process::Command;

use serde_json::Value;

use super::{alike_buildings, example_with, gap, gap_in, json, named, root, text};

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
    // Metres are hardly meant where no unit stands.
    for (ends, question) in [
        (
            ["--from", "20", "--to", "200"],
            "--to is 200 m, wide for a joint; a number without unit is in m: was \"200 mm\" meant?",
        ),
        (
            ["--from", "0", "--to", "2"],
            "was \"2 cm\" or \"2 in\" meant?",
        ),
        (["--from", "0", "--to", "2 m"], ""),
        (["--from", "0", "--to", "0.2"], ""),
    ] {
        let output = call(&[&ends[..], &["--points", "2"]].concat());
        let said = text(&output.stderr);
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(said.contains("meant?"), !question.is_empty(), "{said}");
        assert!(said.contains(question), "{said}");
    }
}

/// Equal buildings of one storey, whose damping is the same matrix in other words: they move alike but for round-off, which
/// is no demand, as it is no impact in a run.
#[test]
fn round_off_is_no_demand() {
    let folder = tempfile::tempdir().unwrap();
    let building = |name: &str, damping: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nmass = [\"400 t\"]\nstiffness = \"63.165 MN/m\"\nheight = \"3 m\"\ndamping = {{ {damping} = 0.05 }}\n"
        )
    };
    let record = root().join("ground_motions/el_centro_1940_ns.csv");
    let case = format!(
        "{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = 0\nmodel = \"kelvin_voigt\"\nstiffness = \"350 MN/m\"\nrestitution = 0.65\n[ground_motion]\nfile = {record:?}\n",
        building("A", "modal"),
        building("B", "stiffness_proportional"),
    );
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let output = gap_in(folder.path(), &["--points", "0"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let shown = text(&output.stdout);
    assert!(shown.contains("WIDE ENOUGH - 0 of 1"), "{shown}");
    let told = json(&gap_in(folder.path(), &["--points", "0", "--json"]));
    assert_eq!(told["gaps"][0]["required"]["by_count"], 0.0);
}

/// By hand: where no run has an impact every ratio is 1 but for round-off, and no width is the worst.
#[test]
fn round_off_makes_no_width_the_worst() {
    let folder = example_with("\"5 m\"");
    let arguments = ["--from", "1 m", "--to", "5 m", "--points", "3"];
    let shown = text(&gap_in(folder.path(), &arguments).stdout);
    assert!(
        shown.contains("light: no width raises the displacement"),
        "{shown}"
    );
    assert!(!shown.contains("worst at"), "{shown}");
}

/// Of buildings that do not move no ratio is known, and none is drawn.
#[test]
fn what_does_not_move_has_no_ratio() {
    let folder = alike_buildings("20 mm");
    let path = folder.path().join("case.toml");
    let case = std::fs::read_to_string(&path).unwrap();
    let file = case.lines().find(|line| line.starts_with("file = "));
    let case = case.replace(file.unwrap(), "file = \"still.csv\"");
    std::fs::write(&path, case).unwrap();
    let rows: String = (0..100)
        .map(|i| format!("{:.2},0\n", f64::from(i) * 0.01))
        .collect();
    let record = format!("time_s,acceleration_m/s2\n{rows}");
    std::fs::write(folder.path().join("still.csv"), record).unwrap();
    let call = |arguments: &[&str]| gap_in(folder.path(), arguments);
    let swept = ["--to", "10 mm", "--points", "2"];
    let all = [
        &swept[..],
        &["--all", "--plot", "x.svg", "--report", "x.html"],
    ]
    .concat();
    let output = call(&all);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(
        !shown.contains("x1.000") && !shown.contains("NaN"),
        "{shown}"
    );
    let svg = std::fs::read_to_string(folder.path().join("x.svg")).unwrap();
    assert!(
        svg.contains("No amplification is known") && !svg.contains("with pounding"),
        "{svg}"
    );
    let html = std::fs::read_to_string(folder.path().join("x.html")).unwrap();
    assert!(html.contains("no isolated building has any"), "{html}");
    let report = json(&call(&[&swept[..], &["--json"]].concat()));
    for of in [
        &report["records"][0]["amplification"],
        &report["sweep"]["runs"][0][0]["amplification"],
    ] {
        assert!(of[0][0]["displacement"].is_null(), "{of}");
    }
}

/// Where nothing is demanded, a rule is told with the widest gap that it asks for, which the
/// verdict beside it and `--json` mean too.
#[test]
fn alike_buildings_are_told_the_widest_gap_of_a_rule() {
    let folder = alike_buildings("150 mm");
    let shown = text(&gap_in(folder.path(), &["--points", "0", "--all"]).stdout);
    let report = json(&gap_in(folder.path(), &["--points", "0", "--json"]));
    for (rule, told) in [
        ("absolute_sum", "228.5"),
        ("square_root_of_sum_of_squares", "161.6"),
    ] {
        let combination = named(&report["gaps"][0]["combinations"], "rule", rule);
        let widths = combination["width"][0].as_array().unwrap().iter();
        let widest = widths.filter_map(Value::as_f64).fold(0.0, f64::max);
        assert_eq!(format!("{:.1}", (widest * 1e4).ceil() / 10.0), told);
        let mut rows = shown.lines().filter(|l| l.starts_with('|'));
        let line = rows.find(|l| l.contains(&format!(" {rule} ")));
        let cells: Vec<&str> = line.unwrap().split('|').map(str::trim).collect();
        assert_eq!(cells[4..7], [told, "no", "-"], "{shown}");
    }
    assert!(!shown.contains("inf"), "{shown}");
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

/// Tables that leave widths out say which they show.
#[test]
fn widths_that_are_left_out_are_said() {
    let folder = example_with("\"20 mm\"");
    let page = folder.path().join("gap.html");
    let arguments = ["--points", "41", "--report", page.to_str().unwrap()];
    let output = gap_in(folder.path(), &arguments);
    let told = text(&output.stdout);
    assert!(
        told.contains("one width in every 3 shown, --csv writes all"),
        "{told}"
    );
    let page = std::fs::read_to_string(page).unwrap();
    assert!(page.contains("One width in every 3 is shown; --csv writes all."));
}
