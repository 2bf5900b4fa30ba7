//! Answers that the intensities of an analysis, or its hazard curve, leave open: text, numbers and
//! page say so.

use super::Bench;

/// Two records at intensities between which the answer lies, or from which it lies far.
fn study(intensities: &str, hazard: &str) -> String {
    format!(
        "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\", \"MOTIONS/kobe_1995_jma_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [{intensities}]\n[ida]\ngaps = [\"20 mm\"]\nhazard = {hazard}\ntarget_frequency = 2.1e-3\n"
    )
}

#[test]
fn a_gap_that_intensities_leave_open_is_a_bound() {
    let hazard = "[[\"0.02 g\", 0.5], [\"0.2 g\", 5e-3], [\"9 g\", 2e-6]]";
    let bench = Bench::new(&study("\"3 g\", \"4 g\"", hazard));
    let text = bench.text("ida study.toml -o out.h5 --report page.html");
    assert!(text.contains("0.002100: at most "), "{text}");
    // Two records give no bounds, and none are explained.
    assert!(!text.contains("Bounds of mean annual"), "{text}");
    assert!(text.contains("the least gap may be as small as"), "{text}");
    let told: serde_json::Value =
        serde_json::from_str(&bench.text("ida study.toml -o out.h5 --resume --json")).unwrap();
    let minimum = &told["gaps"][0]["minimum"];
    assert_eq!(minimum["upper_bound"], true, "{minimum}");
    assert!(minimum["wider_than"].as_f64() < minimum["width"].as_f64());
    let said = minimum["remarks"][0].as_str().unwrap();
    assert!(said.contains("add intensities around"), "{said}");
    let page = String::from_utf8(bench.bytes("page.html")).unwrap();
    assert!(page.contains("needs at most "), "{page}");
    assert!(page.contains("add intensities around"));
}

#[test]
fn a_hazard_curve_that_begins_late_is_told() {
    let hazard = "[[\"0.4 g\", 1e-2], [\"9 g\", 2e-6]]";
    let intensities = "\"0.01 g\", \"0.05 g\", \"0.1 g\", \"0.15 g\", \"0.2 g\", \"0.3 g\"";
    let bench = Bench::new(&study(intensities, hazard));
    let text = bench.text("ida study.toml -o out.h5 --report page.html");
    let said = "the hazard curve begins at 0.400 g";
    assert!(text.contains(said), "{text}");
    let told: serde_json::Value =
        serde_json::from_str(&bench.text("ida study.toml -o out.h5 --resume --json")).unwrap();
    let remarks = told["limits"][0]["remarks"].to_string();
    assert!(remarks.contains(said), "{remarks}");
    let page = String::from_utf8(bench.bytes("page.html")).unwrap();
    assert!(page.contains(said));
}

/// An intensity that stands twice would count each record twice.
#[test]
fn an_intensity_stands_once() {
    let hazard = "[[\"0.02 g\", 0.5], [\"0.2 g\", 5e-3], [\"9 g\", 2e-6]]";
    let bench = Bench::new(&study("\"0.1 g\", \"3 g\", 0.980665", hazard));
    let said = bench.complaint("ida study.toml -o out.h5", 2);
    assert!(
        said.contains("the intensity 0.980665 m s-2 stands twice"),
        "{said}"
    );
}
