//! Spectra of codes, and records scaled to them.

use super::*;

const EUROCODE: &str = "eurocode_8_2004, ag=0.25 g, ground_type=C";

/// EN 1998-1:2004 on ground C, type 1: S = 1.15 and 0.2, 0.6, 2 s.
fn eurocode(period: f64) -> f64 {
    let plateau = 0.25 * 9.80665 * 1.15 * 2.5;
    match period {
        t if t < 0.2 => plateau / 2.5 * (1.0 + t / 0.2 * 1.5),
        t if t <= 0.6 => plateau,
        t if t <= 2.0 => plateau * 0.6 / t,
        t => plateau * 0.6 * 2.0 / (t * t),
    }
}

/// The table that is written is the code's formula at 200 periods and its corners, and can be
/// read as a target.
#[test]
fn a_code_is_written_as_a_table() {
    let folder = Folder::new();
    let (csv, svg) = (folder.name("c.csv"), folder.name("c.svg"));
    let shown = text(&["spectrum", "--code", EUROCODE, "--csv", &csv, "--svg", &svg]);
    assert!(
        shown.contains("ground type C, type 1, 5 % damping (EN 1998-1:2004, 3.2.2.2)"),
        "{shown}"
    );
    let table = rows(&folder.content("c.csv"));
    assert_eq!(table.len(), 203);
    for row in &table {
        close(row[1], eurocode(row[0]), 1e-12);
    }
    for corner in [0.2, 0.6, 2.0] {
        assert!(table.iter().any(|row| row[0] == corner), "{corner}");
    }
    assert!(folder.content("c.svg").contains("<svg"));
    let out = folder.name("scaled.csv");
    let by_file = format!("target={csv}, from=0.1 s, to=3 s");
    text(&["process", &el_centro(), "-o", &out, "--scale", &by_file]);
    let by_code = folder.name("by_code.csv");
    let code = "code=eurocode_8_2004, ag=0.25 g, ground_type=C";
    text(&["process", &el_centro(), "-o", &by_code, "--scale", code]);
    let (a, b) = (
        rows(&folder.content("scaled.csv")),
        rows(&folder.content("by_code.csv")),
    );
    for (a, b) in a.iter().zip(&b) {
        // The table is straight in logarithms between its points.
        assert!((a[1] - b[1]).abs() <= 2e-4 * b[1].abs(), "{a:?} {b:?}");
    }
}

/// The factor is that of least squares of the logarithm, taken here from the spectrum of the
/// record at the same 100 periods: `ln s = mean(ln Se - ln PSA)`.
#[test]
fn a_record_is_scaled_to_a_code_by_least_squares_of_the_logarithm() {
    let folder = Folder::new();
    let out = folder.name("o.csv");
    let scale = "code=eurocode_8_2004, ag=0.25 g, ground_type=C, from=0.2 s, to=2 s";
    let file = el_centro();
    let told = json(&["process", &file, "-o", &out, "--scale", scale]);
    let steps = told["steps"].as_array().unwrap();
    let numbers = steps[0]["numbers"].as_array().unwrap();
    let factor = numbers.iter().find(|n| n["name"] == "factor").unwrap();
    let band = ["--from", "0.2 s", "--to", "2 s", "--count", "100"];
    let spectrum = json(&[&["spectrum", &file, "--code", EUROCODE][..], &band].concat());
    let (record, code) = (&spectrum["spectra"][0], &spectrum["codes"][0]);
    let mean = (0..100).map(|i| {
        let period = number(&record["periods"][i]);
        close(
            number(&code["pseudo_acceleration"][i]),
            eurocode(period),
            1e-12,
        );
        (eurocode(period) / number(&record["pseudo_acceleration"][i])).ln()
    });
    // The target is straight in logarithms between 320 points of the code.
    close(
        number(&factor["value"]),
        (mean.sum::<f64>() / 100.0).exp(),
        1e-4,
    );
    let remarks = steps[0]["remarks"].to_string();
    assert!(
        remarks.contains("least squares of the logarithm"),
        "{remarks}"
    );
    assert!(remarks.contains("ag 0.25 g, ground type C"), "{remarks}");
    assert!(
        folder
            .content("o.csv")
            .contains("least squares of the logarithm")
    );
}

/// Beside a record the code has columns of its own.
#[test]
fn a_code_stands_beside_a_record() {
    let folder = Folder::new();
    let csv = folder.name("s.csv");
    let code = "asce_7_2016, s_ds=1.0 g, s_d1=0.6 g, t_l=8 s";
    let shown = text(&[
        "spectrum",
        &el_centro(),
        "--code",
        code,
        "--at",
        "0.3 s, 1.2 s",
        "--csv",
        &csv,
    ]);
    assert!(shown.contains("PSA / code"), "{shown}");
    let table = rows(&folder.content("s.csv"));
    close(table[0][7], 9.80665, 1e-12);
    close(table[1][7], 0.5 * 9.80665, 1e-12);
}

#[test]
fn codes_that_are_none() {
    for (arguments, says) in [
        (vec!["--code", "eurocode, ag=0.2 g"], "eurocode_8_2004"),
        (vec!["--code", "ag=0.2 g"], "name of a code"),
        (
            vec![
                "--code",
                "eurocode_8_2004, ag=0.2 g, ground_type=B, damping=0.03",
            ],
            "give it as --damping",
        ),
        (
            vec![
                "--code",
                "eurocode_8_2004, ag=0.2 g, ag=0.3 g, ground_type=B",
            ],
            "\"ag\" is given twice, as \"0.2 g\" and as \"0.3 g\"",
        ),
        (vec!["--code", "eurocode_8_2004, ag=0.2 g"], "ground_type"),
        (vec!["--code", "asce_7_2016, s_ds=1 g, s_d1=0.6 g"], "t_l"),
        (vec!["--code", EUROCODE, "--to", "5 s"], "outside [0.01, 4]"),
        (
            vec!["--code", EUROCODE, "--damping", "40 %"],
            "damping ratio",
        ),
        (
            vec![
                "--code",
                EUROCODE,
                "--damping",
                "2 %, 5 %",
                "--csv",
                "no.csv",
            ],
            "one damping ratio",
        ),
    ] {
        let output = run(&[&["spectrum"][..], &arguments].concat());
        let said = String::from_utf8_lossy(&output.stderr).replace(['\n', '│'], " ");
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.contains(says), "{arguments:?}: {said}");
        assert!(!said.contains("TOML"), "{arguments:?}: {said}");
    }
}

/// The same picture in three forms: each has its signature, and the words of the picture stand
/// in the two that keep text.
#[test]
fn pictures_have_three_forms() {
    let folder = Folder::new();
    for (name, start) in [
        ("c.svg", b"<svg".as_slice()),
        ("c.png", b"\x89PNG"),
        ("c.PDF", b"%PDF"),
    ] {
        let path = folder.name(name);
        text(&["spectrum", "--code", EUROCODE, "--svg", &path]);
        let bytes = std::fs::read(folder.path(name)).unwrap();
        assert!(bytes.starts_with(start), "{name}");
    }
    assert!(folder.content("c.svg").contains("period (s)"));
}

/// Accelerations without unit are in m/s2: said once by whatever takes the spectrum, as `gap` says it
/// of `design_ground_acceleration`, and nothing is said of usual ones.
#[test]
fn parameters_that_no_code_has_are_warned_of() {
    let folder = Folder::new();
    let (record, made) = (folder.name("r.csv"), folder.name("made.csv"));
    let samples: String = (0..400)
        .map(|i| format!("{},{}\n", f64::from(i) * 0.01, (f64::from(i) * 0.3).sin()))
        .collect();
    let header = "# unit: m/s2\ntime_s,acceleration_m_s2\n";
    std::fs::write(&record, format!("{header}{samples}")).unwrap();
    let said = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .arg("motion")
            .args(arguments)
            .env("NO_COLOR", "1")
            .output()
            .unwrap();
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{told}");
        told
    };
    for (ag, warned) in [("0.25", true), ("0.25 g", false)] {
        let code = format!("eurocode_8_2004, ag={ag}, ground_type=C");
        let scale = format!("code={code}");
        for arguments in [
            &["spectrum", "--code", &code, "--damping", "2 %, 5 %"][..],
            &["spectrum", &record, "--code", &code],
            &["process", &record, "--scale", &scale, "-o", &made],
        ] {
            let told = said(arguments);
            let count = told.matches("was \"0.25 g\" meant?").count();
            assert_eq!(count, usize::from(warned), "{arguments:?}: {told}");
        }
    }
    // A case that scales its record so says it in `check`, `run` and `gap`.
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let case = std::fs::read_to_string(root.join("examples/three_storey_pair/case.toml")).unwrap();
    let motions = root.join("ground_motions").display().to_string();
    let scale = "scale = { code = \"eurocode_8_2004\", ag = 0.25, ground_type = \"C\" }";
    let case = case
        .replace("../../ground_motions", &motions)
        .replace("[ground_motion]\n", &format!("[ground_motion]\n{scale}\n"));
    let path = folder.name("case.toml");
    std::fs::write(&path, case).unwrap();
    for command in [
        &["check"][..],
        &["run", "--no-output"],
        &["gap", "--points", "0"],
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .args(command)
            .arg(&path)
            .env("NO_COLOR", "1")
            .output()
            .unwrap();
        let told = [output.stdout, output.stderr].concat();
        let told = String::from_utf8_lossy(&told).into_owned();
        let count = told.matches("was \"0.25 g\" meant?").count();
        assert_eq!(count, 1, "{command:?}: {told}");
    }
}
