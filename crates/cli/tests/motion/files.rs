//! `convert` and `process`.

use super::*;

fn samples(content: &str) -> Vec<f64> {
    rows(content).iter().map(|r| r[1]).collect()
}

/// Our CSV gives every bit back; the digits of AT2 do to 1e-7.
#[test]
fn conversions_return() {
    let folder = Folder::new();
    let file = el_centro();
    let names = ["a.csv", "a.at2", "b.csv", "c.csv", "a.txt"].map(|n| folder.name(n));
    text(&["convert", &file, "-o", &names[0]]);
    text(&["convert", &names[0], "--to", "peer_at2", "-o", &names[1]]);
    text(&["convert", &names[1], "-o", &names[2]]);
    text(&["convert", &names[0], "-o", &names[3]]);
    let first = samples(&folder.content("a.csv"));
    assert_eq!(first.len(), 1559);
    assert_eq!(first, samples(&folder.content("c.csv")));
    let peak = first.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    for (a, b) in first.iter().zip(samples(&folder.content("b.csv"))) {
        assert!((a - b).abs() < 1e-7 * peak, "{a} {b}");
    }
    // The header says where it came from, all the way back.
    let content = folder.content("b.csv");
    assert!(
        content.contains("# Source: a.at2 (peer_at2), SHA-256 "),
        "{content}"
    );
    assert!(
        folder
            .content("c.csv")
            .contains("# Source: el_centro_1940_ns.csv")
    );
    let told = json(&[
        "convert",
        &file,
        "--to",
        "plain_columns",
        "--columns",
        "a",
        "--output-unit",
        "g",
        "-o",
        &names[4],
    ]);
    assert_eq!(told["unit"], "g");
    let plain = folder.content("a.txt");
    let first_value: f64 = plain.lines().next().unwrap().parse().unwrap();
    close(first_value, 0.0063, 1e-14);
    assert_eq!(plain.lines().count(), 1559);
}

/// Steps are done in the order of the command line.
#[test]
fn steps_in_order() {
    let folder = Folder::new();
    let file = el_centro();
    let names = ["a.csv", "b.csv"].map(|n| folder.name(n));
    let (offset, scale) = (["--remove-offset", "value=0.5 m/s^2"], ["--scale", "2"]);
    text(
        &[
            &["process", &file, "-o", &names[0]],
            &offset[..],
            &scale[..],
        ]
        .concat(),
    );
    let told = json(
        &[
            &["process", &file, "-o", &names[1]],
            &scale[..],
            &offset[..],
        ]
        .concat(),
    );
    let steps: Vec<_> = told["steps"]
        .as_array()
        .unwrap()
        .iter()
        .map(|s| &s["step"])
        .collect();
    assert_eq!(steps, ["scale", "offset"]);
    let (a, b) = (
        samples(&folder.content("a.csv")),
        samples(&folder.content("b.csv")),
    );
    for (a, b) in a.iter().zip(&b) {
        close(b - a, 0.5, 1e-13);
    }
    let content = folder.content("a.csv");
    let place = |part: &str| content.find(part).unwrap();
    assert!(place("# Step: offset: offset 0.5 m/s2") < place("# Step: scale: factor 2"));
}

/// Every step runs; each says its numbers; the result reads back with its history.
#[test]
fn all_steps() {
    let folder = Folder::new();
    let file = el_centro();
    let (out, svg) = (folder.name("p.csv"), folder.name("p.svg"));
    let spectrum = folder.path("target.csv");
    std::fs::write(&spectrum, "# 5 %\nperiod_s,psa_g\n0.1,0.8\n1,0.8\n3,0.2\n").unwrap();
    let target = format!("target={}, from=0.2 s, to=2 s", spectrum.display());
    let told = json(&[
        "process",
        &file,
        "-o",
        &out,
        "--svg",
        &svg,
        "--sign",
        "reversed",
        "--remove-offset",
        "mean",
        "--remove-offset",
        "pre_event=0.5 s",
        "--filter",
        "high_pass=0.1 Hz, low_pass=20 Hz, order=3, phase=causal",
        "--filter",
        "low_pass=15 Hz, keep_pads=false",
        "--baseline",
        "acceleration=1",
        "--baseline",
        "velocity=2",
        "--baseline",
        "start=3 s, end=10 s, fit_from=25 s",
        "--baseline",
        "threshold=0.5 m/s^2",
        "--trim",
        "start=0.5 s, end=30 s",
        "--trim",
        "arias_from=0.001, arias_to=0.999",
        "--taper",
        "start=1 s, end=1 s",
        "--pad",
        "before=1 s, after=5 s",
        "--resample",
        "time_step=0.01 s, interpolation=band_limited",
        "--scale",
        "pga=0.35 g",
        "--scale",
        "pgv=0.4 m/s",
        "--scale",
        "psa=0.8 g, period=1 s, damping=2 %",
        "--scale",
        &target,
    ]);
    assert_eq!(told["steps"].as_array().unwrap().len(), 18);
    assert_eq!(number(&told["time_step"]), 0.01);
    let again = json(&["info", &out]);
    let series = &again["files"][0]["series"][0];
    let history = series["history"].as_array().unwrap();
    let steps = history
        .iter()
        .filter(|l| l.as_str().unwrap().starts_with("Step: "));
    assert_eq!(steps.count(), 18);
    close(
        number(&series["peak"]["value"]),
        number(&told["peak_acceleration"]["value"]),
        1e-15,
    );
    assert_eq!(folder.files(), ["p.csv", "p.svg", "target.csv"]);
}

/// A quarter turn of two components leaves the second in the place of the first.
#[test]
fn rotation() {
    let folder = Folder::new();
    let path = folder.path("two.txt");
    let content: String = (0..40)
        .map(|i| {
            format!(
                "{} {} {}\n",
                f64::from(i) * 0.01,
                f64::from(i % 7) - 3.0,
                f64::from(i % 5)
            )
        })
        .collect();
    std::fs::write(&path, content).unwrap();
    let (file, out) = (folder.name("two.txt"), folder.name("out.csv"));
    text(&[
        "process",
        &file,
        "-o",
        &out,
        "--unit",
        "m/s2",
        "--layout",
        "t,ns,ew",
        "--component",
        "ns",
        "--rotate",
        "90",
        "--second-component",
        "ew",
        "--offset",
        "keep",
    ]);
    for (i, a) in samples(&folder.content("out.csv")).iter().enumerate() {
        assert!((a - (i % 5) as f64).abs() < 1e-14, "{i} {a}");
    }
}

/// `convert` says what is odd about the values, as `info` does, in every format and in JSON.
#[test]
fn convert_warns_of_mean_and_peak() {
    let folder = Folder::new();
    let file = folder.name("odd.csv");
    let rows: String = (0..50)
        .map(|i| format!("{:.2},{}\n", 0.01 * f64::from(i), 40.0 + f64::from(i % 5)))
        .collect();
    std::fs::write(&file, format!("time_s,acceleration_m_s2\n{rows}")).unwrap();
    let told = [
        "warning: the mean is 42 m/s2: an offset of the instrument?",
        "warning: peak acceleration 44.000 m/s2 is larger than any recorded; check the unit",
    ];
    for to in ["pounding_csv", "peer_at2", "plain_columns"] {
        let out = folder.name(to);
        let said = text(&["convert", &file, "--to", to, "-o", &out]);
        for words in told {
            assert_eq!(said.matches(words).count(), 1, "{said}");
        }
        let said = json(&["convert", &file, "--to", to, "-o", &out]);
        assert_eq!(said["warnings"].as_array().unwrap().len(), 2, "{said}");
    }
}
