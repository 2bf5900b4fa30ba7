//! Computed against measured force.

use serde_json::Value;

use super::{close, example, has, json, refused, refused_with, text_in};

/// Headline numbers of examples/impact_laboratory. The synthetic history is that of
/// an independent integration by its make_measured.py.
#[test]
fn the_example_against_its_measured_history() {
    let folder = tempfile::tempdir().unwrap();
    let file = example().join("measured.csv");
    let file = file.to_str().unwrap();
    let arguments =
        format!("exact_hunt_crossley|jankowski_2005|stereomechanical|--example|--against|{file}");
    let result = json(&arguments);
    let measured = &result["measured"];
    close(&measured["first_contact"], 5.2516e-3, 1e-2);
    close(&measured["peak_force"]["peak"], 1557.72e3, 1e-9);
    close(&measured["impulse"], 20270.9, 1e-4);
    // The true end is 5.13 ms + 28.324 ms: 0.40 ms later, in the tail below the threshold.
    close(&measured["duration"], 27.800e-3, 1e-3);
    let [exact, jankowski, rigid] = [0, 1, 2].map(|i| &result["models"][i]["against"]);
    close(&exact["peak_force_error_percent"], -1.51, 1e-2);
    close(&exact["impulse_error_percent"], 0.1815, 1e-2);
    close(&exact["rms_force_difference_percent_of_peak"], 1.068, 1e-3);
    close(&jankowski["peak_force_error_percent"], -21.86, 1e-3);
    close(
        &jankowski["rms_force_difference_percent_of_peak"],
        15.540,
        1e-3,
    );
    assert!(rigid["peak_force_error_percent"].is_null());
    close(&rigid["impulse_error_percent"], 0.1815, 1e-2);
    // Extrapolated along F^(2/3), 9 us beside the true 5.13 ms.
    close(&exact["first_contact"], 5.1391e-3, 1e-4);
    // With the true time of first contact the difference is the noise.
    let true_time = json(&format!(
        "exact_hunt_crossley|--example|--against|{file}|--shift|5.13 ms"
    ));
    let noise = true_time["against"]["rms_force_difference_percent_of_peak"].as_f64();
    assert!(noise.is_some_and(|n| (0.9..1.3).contains(&n)), "{noise:?}");
    let shown = text_in(folder.path(), &format!("{arguments}|--svg|a.svg"));
    has(
        &shown,
        &[
            "| measured ",
            "1557.7",
            "-21.86",
            "15.54",
            "impulse: each over its own contact",
        ],
    );
    let picture = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    has(&picture, &["measured", "jankowski_2005"]);
}

/// The same numbers whatever the columns look like.
#[test]
fn columns_of_many_kinds() {
    let folder = tempfile::tempdir().unwrap();
    let rows = ["0 0", "5 100", "10 150", "15 80", "20 0"];
    let file = |header: &str, separator: &str| {
        let lines = rows.map(|r| r.replace(' ', separator)).join("\r\n");
        std::fs::write(
            folder.path().join("m.csv"),
            format!("\u{feff}# one\n\n{header}{lines}"),
        )
        .unwrap();
    };
    for (header, separator, option) in [
        ("time_ms,force_kN\n", ",", ""),
        ("time (ms), force (kN)\n", " , ", ""),
        ("\"time (ms)\";\"force [kN]\"\n", ";", ""),
        ("t_ms\tF_kN\n", "\t", ""),
        ("time (ms)  force (kN)\n", "   ", ""),
        ("time_ms force_kN\n", " ", "|--against-units|ms,kN"),
        ("", ",", "|--against-units|ms, kN"),
        ("time,force\n", ",", "|--against-units|ms,kN"),
    ] {
        file(header, separator);
        let shown = text_in(
            folder.path(),
            &format!("hertz_1882|--example|--json|--against|m.csv{option}"),
        );
        let result: Value = serde_json::from_str(&shown).unwrap();
        close(&result["measured"]["impulse"], 1650.0, 1e-12);
        close(&result["measured"]["duration"], 0.02, 1e-12);
        close(&result["measured"]["peak_force"]["peak"], 150e3, 1e-12);
    }
}

#[test]
fn bad_measured_histories() {
    let folder = tempfile::tempdir().unwrap();
    let bad = |content: &str, more: &str, wanted: &[&str]| {
        std::fs::write(folder.path().join("m.csv"), content).unwrap();
        let arguments = format!("hertz_1882|--example|--against|m.csv{more}");
        refused_with(folder.path(), &arguments, 2, wanted);
    };
    let rows = "0,0\n5,100\n10,150\n15,80\n20,0\n";
    bad(
        rows,
        "",
        &[
            "m.csv:1:1",
            "units of time and force are not known",
            "--against-units",
        ],
    );
    bad(
        &format!("time,force\n{rows}"),
        "",
        &["m.csv:1:1", "time_ms,force_kN"],
    );
    bad(
        &format!("force_kN,time_ms\n{rows}"),
        "",
        &["m.csv:1:1", "not a time"],
    );
    bad(
        &format!("time_ms,force_kNn\n{rows}"),
        "",
        &["no unit of the force column", "known units"],
    );
    bad(
        &format!("time_ms,force_kN\n{rows}"),
        "|--against-units|s,kN",
        &["contradicts"],
    );
    bad(
        &format!("time_ms,force_kN\n{rows}"),
        "|--shift|1 s",
        &["first contact at 1 s"],
    );
    bad(
        &format!("time_ms,force_kN\n{rows}"),
        "|--threshold|0",
        &["--threshold is 0"],
    );
    bad(rows, "|--against-units|ms", &["two units are wanted"]);
    bad(rows, "|--against-units|kN,ms", &["not a time"]);
    let headed = |rows: &str| format!("time_ms,force_kN\n# comment\n{rows}");
    bad(
        &headed("0,0\n1,2\n1,3\n"),
        "",
        &["m.csv:5:1", "time does not increase"],
    );
    bad(
        &headed("0,0\n1,nan\n2,3\n"),
        "",
        &["m.csv:4:1", "\"nan\" is not a finite number"],
    );
    bad(
        &headed("0,0\n1,\n2,3\n"),
        "",
        &["m.csv:4:1", "not a finite number"],
    );
    bad(
        &headed("0,0\nhello world\n2,3\n"),
        "",
        &["m.csv:4:1", "\"hello\""],
    );
    bad(
        &headed("0,0\n1,2,3\n2,3\n"),
        "",
        &["m.csv:4:1", "3 columns"],
    );
    bad(&headed("0,0\n1,2\n"), "", &["2 rows", "three rows"]);
    bad(
        &headed("0,0\n1,-2\n2,-3\n"),
        "",
        &["no force above zero", "positive"],
    );
    bad("", "", &["0 rows"]);
    bad("once upon a time", "", &["m.csv:1:1", "4 columns"]);
    refused(
        "hertz_1882|--example|--against|absent.csv",
        &["cannot read absent.csv", "time, force"],
    );
}

/// A file that begins in contact is warned of, as one that ends in contact is.
#[test]
fn a_history_that_begins_in_contact() {
    let folder = tempfile::tempdir().unwrap();
    let write = |rows: &str| {
        let text = format!("time_ms,force_kN\n{rows}");
        std::fs::write(folder.path().join("m.csv"), text).unwrap();
        text_in(folder.path(), "hertz_1882|--example|--against|m.csv")
    };
    let begins = "warning: the measured history begins in contact";
    assert!(write("10,100\n15,150\n20,80\n25,0\n").contains(begins));
    let whole = write("5,0\n10,100\n15,150\n20,80\n25,0\n");
    assert!(!whole.contains(begins), "{whole}");
}
