//! Fragilities for OpenQuake. The reader of OpenQuake 3.26 takes such files, and has the probabilities of the fragilities.

use serde_json::Value;

use super::Bench;

const STUDY: &str = r#"
title = "Pair <of> & two"
case = "case.toml"
[[variable]]
synthetic = { model = "rezaeian_der_kiureghian_2010", count = 24, duration = "12 s", significant_duration = "6 s", middle_time = "4 s", middle_frequency = "3 1/s" }
[[variable]]
MEASURE
values = ["0.04 g", "0.08 g", "0.12 g", "0.16 g", "0.24 g", "0.32 g"]
[ida]
gaps = ["22.5 mm", "18 mm", "5 m"]
"#;

/// The value of an attribute of an element that stands behind a text.
fn attribute(xml: &str, behind: &str, name: &str) -> String {
    let (_, rest) = xml
        .split_once(behind)
        .unwrap_or_else(|| panic!("{behind} in {xml}"));
    let (_, rest) = rest.split_once(&format!("{name}=\"")).unwrap();
    rest.split_once('"').unwrap().0.to_owned()
}

/// OpenQuake has mean and deviation of the intensity, from which it takes those of the logarithm again; a state that no run
/// reaches has no function.
#[test]
fn fragilities_are_read_by_openquake() {
    let bench = Bench::new("");
    let hazard = "[ida]\nhazard = [[\"0.01 g\", 1], [\"4 g\", 1e-6]]\ntarget_frequency = 8e-3";
    let study = STUDY.replace("MEASURE", "intensity = \"peak_ground_acceleration\"");
    bench.study(&study.replace("[ida]", hazard));
    let out = bench.run("ida study.toml -o out.h5 --openquake model.xml --json");
    let said = String::from_utf8(out.stderr).unwrap();
    let told: Value = serde_json::from_slice(&out.stdout).unwrap();
    let xml = String::from_utf8(bench.bytes("model.xml")).unwrap();
    assert!(
        xml.contains("Pair &lt;of&gt; &amp; two. Intensity"),
        "{xml}"
    );
    for (place, id) in [
        (&told["limits"][0], "pounding_at_the_gaps_of_the_case"),
        (
            &told["gaps"][0]["widths"][0],
            "pounding_of_light-heavy_at_22_5_mm",
        ),
        (
            &told["gaps"][0]["widths"][1],
            "pounding_of_light-heavy_at_18_mm",
        ),
    ] {
        let function = format!("<fragilityFunction id=\"{id}\"");
        assert_eq!(attribute(&xml, &function, "imt"), "PGA");
        let number = |name: &str| -> f64 { attribute(&xml, &function, name).parse().unwrap() };
        let (mean, deviation) = (number("mean"), number("stddev"));
        let variance = (deviation * deviation / (mean * mean)).ln_1p();
        let median = 9.806_65 * mean / (0.5 * variance).exp();
        let of = |key: &str| place["fit"][key].as_f64().unwrap();
        assert!((median / of("median") - 1.0).abs() < 1e-12, "{id} {median}");
        assert!((variance.sqrt() / of("dispersion") - 1.0).abs() < 1e-12);
    }
    // The least width suffices as it is shown.
    let least = 1e3 * told["gaps"][0]["minimum"]["width"].as_f64().unwrap();
    let behind = xml.split("pounding of light-heavy at ").skip(1);
    let shown = behind.map(|rest| rest.split(" mm").next().unwrap().parse::<f64>().unwrap());
    let shown: Vec<f64> = shown.collect();
    let suffices = |shown: &&f64| (0.0..0.010_001).contains(&(**shown - least));
    assert_eq!(
        shown.iter().filter(suffices).count(),
        1,
        "{least} {shown:?}"
    );
    assert!(
        !xml.contains("5000_mm") && said.contains("pounding of light-heavy at 5000 mm"),
        "{said}"
    );
}

/// Measures that OpenQuake does not have are refused before any run.
#[test]
fn other_measures_are_refused() {
    let bench = Bench::new("");
    for (measure, right) in [
        ("intensity = \"spectral_acceleration\"", None),
        (
            "intensity = \"spectral_acceleration\"\nperiod = \"0.5 s\"\ndamping = 0.02",
            None,
        ),
        (
            "intensity = \"spectral_acceleration\"\nperiod = \"0.5 s\"",
            Some("SA(0.5)"),
        ),
        (
            "intensity = \"average_spectral_acceleration\"",
            Some("AvgSA"),
        ),
    ] {
        bench.study(&STUDY.replace("MEASURE", measure));
        let call = "ida study.toml -o out.h5 --openquake model.xml";
        match right {
            None => {
                let said = bench.complaint(call, 2);
                assert!(
                    said.contains("OpenQuake has no intensity measure"),
                    "{said}"
                );
                assert!(said.contains("one `period`"), "{said}");
                assert!(!bench.path("out.h5").exists());
            }
            Some(imt) => {
                bench.text(call);
                let xml = String::from_utf8(bench.bytes("model.xml")).unwrap();
                assert_eq!(attribute(&xml, "<fragilityFunction", "imt"), imt);
            }
        }
    }
    // Two weak intensities, at which nothing is reached.
    let study = STUDY.replace("MEASURE", "intensity = \"peak_ground_acceleration\"");
    let (before, rest) = study.split_once("values = ").unwrap();
    let (_, rest) = rest.split_once('\n').unwrap();
    bench.study(&format!(
        "{before}values = [\"0.001 g\", \"0.002 g\"]\n{rest}"
    ));
    let out = bench.run("ida study.toml -o weak.h5 --openquake weak.xml");
    let said = String::from_utf8(out.stderr).unwrap();
    assert!(
        out.status.success()
            && said.contains("weak.xml has no function for states without a fragility"),
        "{said}"
    );
    let xml = String::from_utf8(bench.bytes("weak.xml")).unwrap();
    assert!(xml.contains("limitStates") && !xml.contains("<fragilityFunction"));
}
