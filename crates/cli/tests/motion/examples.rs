//! The examples that are about motions: their headline numbers hold.

use super::*;

fn example(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    root.join("../../examples").join(name)
}

const STEPS: [&str; 8] = [
    "--remove-offset",
    "mean",
    "--taper",
    "start=0.5 s, end=2 s",
    "--filter",
    "high_pass=0.15 Hz, low_pass=20 Hz",
    "--scale",
    "psa=0.5 g, period=1.2 s",
];

/// PSA of the processed record by an independent script (SciPy 1.17: `butter`, `sosfilt`
/// over the record with 1000 zeros at both ends, forward and backward; oscillators by the
/// matrix exponential at 40 steps a sample).
#[test]
fn record_to_spectrum() {
    let folder = Folder::new();
    let (file, out) = (el_centro(), folder.name("p.csv"));
    let told = json(&[&["process", &file, "-o", &out], &STEPS[..]].concat());
    let factor = told["steps"][3]["numbers"].as_array().unwrap();
    let factor = factor.iter().find(|n| n["name"] == "factor").unwrap();
    close(number(&factor["value"]), 1.972_741_37, 1e-7);
    let arguments = [
        "spectrum",
        &out,
        "--at",
        "0.3 s, 0.6 s, 1.2 s, 2 s",
        "--damping",
        "2 %, 5 %",
    ];
    let told = json(&arguments);
    let expected = [
        [1.666_097, 1.754_927, 0.654_621, 0.370_670],
        [1.492_009, 1.521_159, 0.500_000, 0.265_036],
    ];
    for (spectrum, expected) in expected.iter().enumerate() {
        for (i, value) in expected.iter().enumerate() {
            let psa = &told["spectra"][spectrum]["pseudo_acceleration"][i];
            // A peak between the script's steps is out by (w dt)^2/8 at most.
            close(number(psa) / 9.806_65, *value, 3e-5);
        }
    }
}

/// The case excites the pair by the same motion, and says so.
#[test]
fn the_case_does_the_same() {
    let folder = Folder::new();
    let (file, out) = (el_centro(), folder.name("p.csv"));
    let made = json(&[&["process", &file, "-o", &out], &STEPS[..]].concat());
    let case = example("record_to_spectrum").join("case.toml");
    let run = |command: &str, more: &[&str]| -> Value {
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .arg(command)
            .arg(&case)
            .args(more)
            .arg("--json")
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let checked = run("check", &[]);
    let motion = &checked["ground_motion"];
    assert_eq!(motion["samples"], made["samples"]);
    close(
        number(&motion["peak"]),
        number(&made["peak_acceleration"]["value"]),
        1e-12,
    );
    let echo = motion["echo"].to_string();
    for part in ["offset: ", "taper: ", "filter: order 4", "end displacement"] {
        assert!(echo.contains(part), "{part} is not in {echo}");
    }
    let result = run("run", &["--no-output"]);
    assert!(number(&result["energy"]["residual_ratio"]) < 1e-8);
    let levels = result["gaps"][0]["levels"].as_array().unwrap();
    let impacts: u64 = levels.iter().map(|l| l["impacts"].as_u64().unwrap()).sum();
    assert_eq!(impacts, 97);
}

/// EN 1998-1:2004, type 1, ground B, ag = 0.25 g.
fn target(period: f64) -> f64 {
    let ground = 1.2 * 0.25 * 9.806_65;
    match period {
        t if t < 0.15 => ground * (1.0 + t / 0.15 * 1.5),
        t if t <= 0.5 => ground * 2.5,
        t if t <= 2.0 => ground * 2.5 * 0.5 / t,
        t => ground * 2.5 / (t * t),
    }
}

/// Each of the seven motions is within 5 % of the target at 6,321 periods,
/// their mean within 2.1 %; none drifts.
#[test]
fn synthetic_suite() {
    let mut mean = vec![0.0; 6321];
    let mut periods = Vec::new();
    for seed in 1..=7 {
        let path = example("synthetic_suite").join(format!("motion_{seed}.csv"));
        let file = path.display().to_string();
        let told = json(&[
            "spectrum", &file, "--from", "0.1 s", "--to", "3 s", "--count", "6321",
        ]);
        let s = &told["spectra"][0];
        periods = s["periods"]
            .as_array()
            .unwrap()
            .iter()
            .map(number)
            .collect();
        for (i, period) in periods.iter().enumerate() {
            let ratio = number(&s["pseudo_acceleration"][i]) / target(*period);
            assert!((ratio - 1.0).abs() < 0.05, "{seed} {period} {ratio}");
            mean[i] += ratio / 7.0;
        }
        let told = json(&["info", &file]);
        let series = &told["files"][0]["series"][0];
        let m = &series["measures"];
        // What the generator's envelope leaves at 40 s is gone.
        assert!(number(&m["end_velocity"]).abs() < 1.0e-12, "{seed}");
        assert!(number(&m["end_displacement"]).abs() < 1.0e-11, "{seed}");
        let history = series["history"].to_string();
        assert!(history.contains(&format!("seed {seed}")), "{history}");
        assert!(history.contains("matching by wavelets"), "{history}");
    }
    assert_eq!(periods.len(), 6321);
    for (ratio, period) in mean.iter().zip(&periods) {
        assert!((ratio - 1.0).abs() < 0.021, "{period} {ratio}");
    }
}
