//! `pounding floor-spectrum`: what equipment on the floors feels.
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn example(name: &str) -> PathBuf {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    examples.join(name).canonicalize().unwrap()
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pounding"));
    let command = command.env("NO_COLOR", "1").current_dir(folder);
    command
        .arg("floor-spectrum")
        .args(arguments)
        .output()
        .unwrap()
}

fn text(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let told = text(folder, &[arguments, &["--json"]].concat());
    serde_json::from_str(&told).unwrap()
}

fn numbers(values: &Value) -> Vec<f64> {
    let values = values.as_array().unwrap().iter();
    values.map(|x| x.as_f64().unwrap()).collect()
}

const PERIODS: &str = "0.05 s, 0.1 s, 0.3 s, 1 s";

/// A case with its accelerations and records in a folder of its own.
fn changed(name: &str, changes: &[(&str, &str)]) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let motions = example("../ground_motions");
    let case = std::fs::read_to_string(example(name).join("case.toml")).unwrap();
    let mut case = case.replace("../../ground_motions", motions.to_str().unwrap());
    for (from, to) in changes {
        assert!(case.contains(from), "{from}");
        case = case.replace(from, to);
    }
    std::fs::write(folder.path().join("case.toml"), &case).unwrap();
    (folder, case)
}

/// Absolute accelerations of oscillators of 5 % on the roofs of the three-storey pair, and pseudo-accelerations, from
/// the accelerations of the floors in a result at rows of 0.05 ms by the matrix exponential of oscillator and linear
/// excitation (SciPy, which knows nothing of displacements).
#[test]
fn roofs_of_the_pair_have_the_spectra_of_their_accelerations() {
    let folder = example("three_storey_pair");
    let answer = json(&folder, &["case.toml", "--at", PERIODS]);
    let floors = answer["floors"].as_array().unwrap();
    assert_eq!(floors.len(), 2);
    for (floor, accelerations, pseudo) in [
        (
            &floors[0],
            [81.907_602_96, 54.116_566_59, 17.163_400_02, 8.946_712_59],
            [81.633_204_08, 53.844_165_67, 17.070_096_00, 8.900_298_56],
        ),
        (
            &floors[1],
            [9.336_743_63, 12.523_691_27, 32.017_351_68, 5.186_686_50],
            [9.335_328_25, 12.506_054_16, 31.862_805_93, 5.155_292_74],
        ),
    ] {
        let with = &floor["spectra"][0]["pounding"];
        let found = [&with["acceleration"], &with["pseudo_acceleration"]].map(numbers);
        for (found, expected) in found.into_iter().zip([accelerations, pseudo]) {
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found / expected - 1.0).abs() < 5e-5, "{found} {expected}");
            }
        }
    }
    // Headlines of the documentation.
    let told = text(&folder, &["case.toml"]);
    assert!(
        told.contains("light, roof at 9 m, 5 % damping: pounding raises it up to 23.48 times, from 0.3557 g to 8.352 g, at a period of 0.05000 s"),
        "{told}"
    );
    assert!(
        told.contains("|      1.194 |     0.2592 |     1.721 |            0.6114 |  0.355 |"),
        "{told}"
    );
}

/// A building that nothing touches has its spectrum with and without, and a stiff oscillator feels the peak acceleration of
/// its floor. On the ground below stands the spectrum of the record.
#[test]
fn a_floor_that_nothing_touches_and_a_stiff_oscillator() {
    let (folder, _) = changed(
        "three_storey_pair",
        &[("width = \"20 mm\"", "width = \"1 m\"")],
    );
    let answer = json(
        folder.path(),
        &[
            "case.toml",
            "--floor",
            "light:1",
            "heavy:3",
            "--at",
            "0.005 s, 0.4 s",
        ],
    );
    assert_eq!(answer["impacts"], 0);
    for floor in answer["floors"].as_array().unwrap() {
        let spectra = &floor["spectra"][0];
        assert_eq!(spectra["pounding"], spectra["alone"]);
        let peak = floor["peak_acceleration"]["pounding"].as_f64().unwrap();
        let stiff = numbers(&spectra["pounding"]["acceleration"])[0];
        assert!((stiff / peak - 1.0).abs() < 2e-3, "{stiff} {peak}");
    }
    let told = text(folder.path(), &["case.toml"]);
    assert!(
        told.contains("pounding changes none of its peaks"),
        "{told}"
    );
    let record = example("../ground_motions").join("el_centro_1940_ns.csv");
    let mut command = Command::new(env!("CARGO_BIN_EXE_pounding"));
    let output = command
        .args(["motion", "spectrum", "--at", "0.4 s", "--json"])
        .arg(record)
        .output()
        .unwrap();
    let of_record: Value = serde_json::from_slice(&output.stdout).unwrap();
    let expected = numbers(&of_record["spectra"][0]["acceleration"])[0];
    let ground = numbers(&answer["floors"][0]["spectra"][0]["ground"]["acceleration"])[1];
    assert!(
        (ground / expected - 1.0).abs() < 1e-9,
        "{ground} {expected}"
    );
}

/// Rigid impacts are jumps of the velocity. Absolute accelerations of equipment of any damping agree with oscillators that
/// are driven by the increments of the floor's velocity at rows of 0.02 ms (exact steps, NumPy), whatever other periods
/// are asked for; and peak accelerations of floors leave jumps out, which a warning says.
#[test]
fn jumps_of_the_velocity_are_felt() {
    let folder = example("rigid_impacts");
    for (damping, periods, expected) in [
        ("5 %", "0.05 s, 1.7 s", &[128.703_476, 3.841_218_4][..]),
        ("5 %", "1.7 s", &[3.841_218_4]),
        ("20 %", "5 ms, 1.7 s", &[f64::NAN, 3.325_598_6]),
        (
            "50 %",
            "0.05 s, 0.3 s, 1.7 s",
            &[141.917_053, 24.728_019_7, 3.302_426_4],
        ),
    ] {
        let asked = [
            "case.toml",
            "--floor",
            "light:3",
            "--damping",
            damping,
            "--at",
            periods,
        ];
        let answer = json(&folder, &asked);
        let found = numbers(&answer["floors"][0]["spectra"][0]["pounding"]["acceleration"]);
        for (found, expected) in found.into_iter().zip(expected) {
            // Of 5 ms there is no reference.
            let error = found / expected - 1.0;
            assert!(
                expected.is_nan() || error.abs() < 1e-4,
                "{damping} {periods}: {error}"
            );
        }
        let warnings = answer["warnings"].to_string();
        assert!(warnings.contains("rigid impacts are jumps"), "{warnings}");
    }
}

/// Over several records each has the spectra of the case under it, for its own duration; means and fractiles are theirs, by
/// hand; and nothing depends on threads.
#[test]
fn spectra_over_records() {
    let (folder, _) = changed("three_storey_pair", &[]);
    let motions = example("../ground_motions");
    let names = ["el_centro_1940_ns", "kobe_1995_jma_ns"];
    let files = names.map(|name| motions.join(format!("{name}.csv")));
    let files = files.each_ref().map(|file| file.to_str().unwrap());
    let asked = [
        "case.toml",
        "--floor",
        "light:3",
        "--damping",
        "2 %, 5 %",
        "--at",
        PERIODS,
    ];
    let under = [&asked[..], &["--records"], &files].concat();
    let told = text(
        folder.path(),
        &[&under[..], &["--json", "--threads", "1"]].concat(),
    );
    let again = text(
        folder.path(),
        &[&under[..], &["--json", "--threads", "3"]].concat(),
    );
    assert_eq!(told, again);
    let told: Value = serde_json::from_str(&told).unwrap();
    let mut of_records = Vec::new();
    for (number, (name, file)) in names.iter().zip(files).enumerate() {
        let changes = [("duration = \"31 s\"\n", ""), (files[0], file)];
        let (folder, _) = changed("three_storey_pair", &changes);
        let one = json(folder.path(), &asked);
        let record = &told["records"][number];
        assert_eq!(record["name"], *name);
        assert_eq!(record["spectra"]["floors"], one["floors"]);
        of_records.push(one["floors"][0]["spectra"].clone());
    }
    let over = &told["floors"][0]["spectra"];
    for damping in 0..2 {
        for of in ["ground", "alone", "pounding"] {
            let both = of_records
                .iter()
                .map(|r| numbers(&r[damping][of]["acceleration"]));
            let both: Vec<Vec<f64>> = both.collect();
            let found = ["mean", "p16", "p50", "p84"].map(|name| numbers(&over[damping][of][name]));
            for (period, (a, b)) in both[0].iter().zip(&both[1]).enumerate() {
                let (low, rise) = (a.min(*b), (a - b).abs());
                for (found, part) in found.iter().zip([0.5, 0.16, 0.5, 0.84]) {
                    let expected = low + part * rise;
                    assert!(
                        (found[period] / expected - 1.0).abs() < 1e-12,
                        "{of} {expected}"
                    );
                }
            }
        }
    }
    // Files have the same; a record given under two names is told.
    let copy = folder.path().join("copy.csv");
    std::fs::copy(files[0], &copy).unwrap();
    let written = ["--csv", "a.csv", "--plot", "a.svg"];
    let three = [&under[..], &["copy.csv"], &written].concat();
    let said = text(folder.path(), &three);
    assert!(said.contains("over 3 records\n"), "{said}");
    assert!(
        said.contains("5 % damping") && said.contains("pounding raises the mean up to"),
        "{said}"
    );
    assert!(said.contains("are the same motion"), "{said}");
    let table = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 2 * 4);
    assert!(table.contains(",pounding_p84_m_s2\n"), "{table}");
    let picture = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(picture.contains("with pounding, 84 %"), "{picture}");
    // No output takes the place of a record.
    let over_a_record = [&under[..], &["copy.csv", "--csv", "copy.csv"]].concat();
    assert_eq!(run(folder.path(), &over_a_record).status.code(), Some(2));
    let nothing = run(folder.path(), &["case.toml", "--records", "none.csv"]);
    assert_eq!(nothing.status.code(), Some(2));
}

/// A record that overturns a building counts nowhere, and is named; where all do there is no answer.
#[test]
fn records_under_which_a_building_collapses_are_left_out() {
    let (folder, _) = changed(
        "three_storey_pair",
        &[(
            "name = \"light\"",
            "name = \"light\"\np_delta = true\nlaw = { model = \"elastic_perfectly_plastic\", yield_force = \"120 kN\" }",
        )],
    );
    let motions = example("../ground_motions");
    let [strong, weak] =
        ["kobe_1995_jma_ns", "el_centro_1940_ns"].map(|name| motions.join(format!("{name}.csv")));
    let asked = [
        "case.toml",
        "--floor",
        "light:3",
        "--at",
        "0.3 s",
        "--records",
        strong.to_str().unwrap(),
    ];
    let output = run(folder.path(), &asked);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(
        said.contains("no record has spectra; kobe_1995_jma_ns: light"),
        "{said}"
    );
    let told = json(
        folder.path(),
        &[&asked[..], &[weak.to_str().unwrap()]].concat(),
    );
    assert_eq!(told["left_out"][0]["name"], "kobe_1995_jma_ns", "{told}");
    assert_eq!(told["records"].as_array().unwrap().len(), 1);
    let said = text(
        folder.path(),
        &[&asked[..], &[weak.to_str().unwrap()]].concat(),
    );
    assert!(
        said.contains("over 1 record of 2; under the others"),
        "{said}"
    );
    let warnings = told["warnings"].to_string();
    assert!(
        warnings.contains("record kobe_1995_jma_ns counts nowhere"),
        "{warnings}"
    );
}

/// Tables for programs and pictures; and what is refused, with a remedy.
#[test]
fn files_and_errors() {
    let (folder, _) = changed(
        "three_storey_pair",
        &[("duration = \"31 s\"", "duration = \"5 s\"")],
    );
    let place = folder.path();
    text(
        place,
        &[
            "case.toml",
            "--damping",
            "2 %, 5 %",
            "--count",
            "4",
            "--csv",
            "a.csv",
            "--plot",
            "a.svg",
        ],
    );
    let table = std::fs::read_to_string(place.join("a.csv")).unwrap();
    assert!(
        table.starts_with("building,storey,elevation_m,damping_ratio,period_s,ground_sa_m_s2,"),
        "{table}"
    );
    assert_eq!(table.lines().count(), 1 + 2 * 2 * 4);
    let picture = std::fs::read_to_string(place.join("a.svg")).unwrap();
    assert!(
        picture.contains("heavy, roof at 9 m, 2 % damping") && picture.contains("building alone")
    );
    for (arguments, message, help) in [
        (
            &["--floor", "light"][..],
            "\"light\" names no storey",
            "light:1",
        ),
        (
            &["--floor", "light:0"],
            "light has no storey \"0\"",
            "1, at the bottom, to 3",
        ),
        (
            &["--floor", "light:4"],
            "light has no storey \"4\"",
            "1, at the bottom, to 3",
        ),
        (
            &["--floor", "tall:1"],
            "no building \"tall\"",
            "light, heavy",
        ),
        (&["--floor", "light:1", "light:1"], "stands twice", "once"),
        (
            &["--at", "1,5 s"],
            "--at: \"1\" has no unit beside \"5 s\"",
            "decimal points",
        ),
        (
            &["--damping", "0,5 %"],
            "--damping: \"0\" has no unit beside \"5 %\"",
            "decimal points",
        ),
        (
            &["--damping", "5"],
            "5 is not between 0 and 1",
            "such as 0.05",
        ),
        (
            &["--at", "0 s"],
            "0 s is not 0.001 s at least",
            "peak acceleration of the floor",
        ),
        (
            &["--from", "1 us"],
            "is not 0.001 s at least",
            "longer periods",
        ),
        (&["--from", "5 s"], "from", ""),
        (&["--count", "1"], "less than two", "--at"),
        (&["--at", "1 m"], "at", ""),
    ] {
        let output = run(place, &[&["case.toml"], arguments].concat());
        let said = String::from_utf8(output.stderr).unwrap();
        let words: Vec<&str> = said.split_whitespace().filter(|w| *w != "│").collect();
        let said = words.join(" ");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(
            said.contains(message) && said.contains(help),
            "{arguments:?}: {said}"
        );
    }
    // No output takes the place of the case.
    let output = run(place, &["case.toml", "--csv", "case.toml"]);
    assert_eq!(output.status.code(), Some(2));
}
