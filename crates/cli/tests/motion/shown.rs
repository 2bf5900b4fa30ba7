//! `info` and `spectrum`.

use super::*;

const G: f64 = 9.806_65;

/// Values by an independent script (numpy, trapezoid rule, peaks at samples) of the
/// same 1559 samples.
#[test]
fn measures_of_el_centro() {
    let file = el_centro();
    let told = json(&["info", &file, "--at-samples"]);
    let series = &told["files"][0]["series"][0];
    assert_eq!(series["samples"], 1559);
    assert_eq!(series["component"], "NS (north-south)");
    let m = &series["measures"];
    close(number(&m["peak_acceleration"]["value"]), 0.31882 * G, 1e-12);
    close(number(&m["peak_velocity"]["value"]), 0.36142, 2e-5);
    close(number(&m["arias_intensity"]), 1.8010, 3e-5);
    close(number(&m["cumulative_absolute_velocity"]), 12.613, 4e-5);
    let d = &m["significant_5_95"];
    close(number(&d["end"]) - number(&d["start"]), 23.843, 3e-5);
    let shown = text(&["info", &file]);
    for part in [
        "format pounding_csv",
        "peak acceleration PGA (g)",
        "0.31882",
        "bracketed duration, 0.05 g (s)",
        "Housner intensity (m)",
    ] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
}

#[test]
fn info_writes_measures_and_a_picture() {
    let folder = Folder::new();
    let (csv, svg) = (folder.name("a.csv"), folder.name("a.svg"));
    let file = el_centro();
    text(&["info", &file, &file, "--csv", &csv, "--svg", &svg]);
    let content = folder.content("a.csv");
    let lines: Vec<_> = content.lines().collect();
    assert_eq!(lines.len(), 3);
    assert!(lines[0].starts_with("file,channel,component,pga_m_s2,"));
    let columns = |l: &str| l.split(',').count();
    assert_eq!(columns(lines[0]), columns(lines[1]));
    let svg = folder.content("a.svg");
    for part in ["<svg", "Ground acceleration (g)", "Husid curve"] {
        assert!(svg.contains(part), "{part}");
    }
    assert_eq!(folder.files(), ["a.csv", "a.svg"]);
}

/// PSA by the same independent script (Nigam and Jennings, peaks at samples).
#[test]
fn response_spectrum_of_el_centro() {
    let folder = Folder::new();
    let (csv, svg) = (folder.name("s.csv"), folder.name("s.svg"));
    let file = el_centro();
    let arguments = [
        "spectrum",
        &file,
        "--at",
        "0.2 s, 0.5 s, 1 s, 2 s",
        "--damping",
        "2 %, 5 %",
        "--at-samples",
        "--csv",
        &csv,
        "--svg",
        &svg,
    ];
    let told = json(&arguments);
    let psa = &told["spectra"][1]["pseudo_acceleration"];
    for (i, expected) in [0.7925, 0.9162, 0.4541, 0.1374].iter().enumerate() {
        close(number(&psa[i]) / G, *expected, 4e-4);
    }
    let rows = rows(&folder.content("s.csv"));
    assert_eq!(rows.len(), 8);
    for row in &rows {
        let [damping, period, sd, psv, psa, ..] = row[..] else {
            panic!("{row:?}");
        };
        assert!(damping == 0.02 || damping == 0.05);
        let frequency = std::f64::consts::TAU / period;
        close(psv, frequency * sd, 1e-12);
        close(psa, frequency * psv, 1e-12);
    }
    assert!(folder.content("s.svg").contains("2 % damping"));
    let shown = text(&arguments);
    assert!(shown.contains("pseudo-acceleration PSA (g)"), "{shown}");
    assert!(shown.contains("0.79255"), "{shown}");
}

/// Two equal components: the motion is along 45 degrees, sqrt(2) times as large; the
/// median over directions is that of one component, cos 45 degrees of it.
#[test]
fn all_directions_of_equal_components() {
    let file = el_centro();
    let folder = Folder::new();
    // The same motion across the first.
    let second = folder.name("ew.csv");
    let north = std::fs::read_to_string(&file).unwrap();
    assert!(north.contains("NS (north-south)"));
    std::fs::write(&second, north.replace("NS (north-south)", "EW (east-west)")).unwrap();
    let at = ["--at", "0.3 s, 1 s"];
    let one = json(&[&["spectrum", &file], &at[..]].concat());
    let told = json(
        &[
            &["spectrum", &file, "--rotated", "--second-file", &second],
            &at[..],
        ]
        .concat(),
    );
    for i in 0..2 {
        let single = number(&one["spectra"][0]["pseudo_acceleration"][i]);
        let both = &told["spectra"][0];
        close(number(&both["maximum"][i]), single * 2.0_f64.sqrt(), 1e-9);
        close(number(&both["median"][i]), single, 1e-9);
        assert_eq!(number(&both["direction_of_maximum"][i]), 45.0);
    }
}

/// A component that ends before the other is continued with zeros, and that is said; one that ends
/// in strong motion is refused for what it is, not under the option of the periods.
#[test]
fn components_of_unequal_length_are_named() {
    let file = el_centro();
    let folder = Folder::new();
    let north = std::fs::read_to_string(&file).unwrap();
    let samples = north
        .lines()
        .filter(|l| l.starts_with(|c: char| c.is_ascii_digit()));
    let count = samples.count();
    assert_eq!(count, 1559);
    let shortened = |name: &str, by: usize| {
        let path = folder.name(name);
        let lines: Vec<&str> = north.lines().collect();
        let text = lines[..lines.len() - by].join("\n") + "\n";
        std::fs::write(&path, text.replace("NS (north-south)", "EW (east-west)")).unwrap();
        path
    };
    let at = ["--at", "0.3 s, 1 s"];
    let second = shortened("ew.csv", 59);
    let rotated = ["spectrum", &file, "--rotated", "--second-file", &second];
    let shown = text(&[&rotated, &at[..]].concat());
    let warning = "warning: the first component (\"NS (north-south)\") has 1559 samples in 31.16 s, the second (\"EW (east-west)\") 1500 samples in 29.98 s: the shorter one is continued with zeros";
    assert_eq!(shown.matches(warning).count(), 1, "{shown}");
    let told = json(&[&rotated, &at[..]].concat());
    let found = told["spectra"][0]["warnings"][0].as_str().unwrap();
    assert!(
        warning.ends_with(found.split(", where").next().unwrap()),
        "{found}"
    );
    // Cut before the strongest motion.
    let second = shortened("cut.csv", 1500);
    let arguments = ["spectrum", &file, "--rotated", "--second-file", &second];
    let arguments = [&arguments, &at[..]].concat();
    refused::refused(
        2,
        &arguments,
        &[
            "rotation: the first component",
            "59 samples in 1.16 s",
            "--trim",
        ],
    );
}

/// A file beside itself, and a copy of it that says no other direction, are no second component.
#[test]
fn a_record_beside_itself_is_no_second_component() {
    let file = el_centro();
    let folder = Folder::new();
    let copy = folder.name("copy.csv");
    let north = std::fs::read_to_string(&file).unwrap();
    std::fs::write(&copy, north.replace("NS (north-south)", "H2")).unwrap();
    for second in [&file, &copy] {
        refused::refused(
            2,
            &["spectrum", &file, "--rotated", "--second-file", second],
            &["both components are the same series", "second_component"],
        );
    }
}

/// Ricker's wavelet: amplitude `2 A f^2 Tp^3/sqrt(pi) exp(-(f Tp)^2)` (Ricker 1953, in
/// today's notation).
#[test]
fn fourier_amplitudes_of_a_ricker_wavelet() {
    let folder = Folder::new();
    let motion = folder.name("r.csv");
    let csv = folder.name("f.csv");
    text(&[
        "synth",
        "ricker_1953",
        "--amplitude",
        "1 m/s^2",
        "--period",
        "0.5 s",
        "--duration",
        "9.99 s",
        "--output",
        &motion,
    ]);
    text(&[
        "spectrum",
        &motion,
        "--fourier",
        "--unsmoothed",
        "--csv",
        &csv,
    ]);
    let rows = rows(&folder.content("f.csv"));
    let maximum = rows.iter().map(|r| r[1]).fold(0.0, f64::max);
    for row in &rows {
        let x = row[0] * 0.5;
        let expected = 2.0 * x * x * 0.5 / std::f64::consts::PI.sqrt() * (-x * x).exp();
        assert!(
            (row[1] - expected).abs() < 1e-6 * maximum,
            "{row:?} {expected}"
        );
    }
    assert_eq!(rows.iter().find(|r| r[1] == maximum).unwrap()[0], 2.0);
    let smooth = json(&["spectrum", &motion, "--fourier", "--at", "2 Hz"]);
    // An angle per second is a circular frequency.
    let circular = ["--at", "12.566370614359172 rad/s"];
    let circular = json(&[&["spectrum", &motion, "--fourier"][..], &circular].concat());
    assert_eq!(circular["amplitudes"], smooth["amplitudes"]);
    let value = number(&smooth["amplitudes"][0]);
    assert!(
        value < maximum && value > 0.9 * maximum,
        "{value} {maximum}"
    );
}

/// Uneven times are measured at their median step, and the user is told.
#[test]
fn uneven_times() {
    let folder = Folder::new();
    let times = [0.0_f64, 0.005, 0.012, 0.015, 0.023, 0.025, 0.030, 0.035];
    let rows: String = times
        .iter()
        .map(|t| format!("{t:.3} {}\n", (100.0 * t).sin()))
        .collect();
    std::fs::write(folder.path("u.txt"), rows).unwrap();
    let file = folder.name("u.txt");
    let told = json(&[
        "info", &file, "--unit", "m/s2", "--layout", "t,a", "--offset", "keep",
    ]);
    let series = &told["files"][0]["series"][0];
    assert_eq!(series["uneven"], true);
    assert_eq!(number(&series["measured_time_step"]), 0.005);
    let warnings = series["warnings"].to_string();
    assert!(
        warnings.contains("resampled to 0.005 s by linear"),
        "{warnings}"
    );
}
