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

/// Where a building collapses under every record no width is enough and no frequency is known, which is no estimate then.
#[test]
fn a_frequency_that_is_not_known_is_no_estimate() {
    let hazard = "[[\"0.02 g\", 0.5], [\"0.2 g\", 5e-3], [\"9 g\", 2e-6]]";
    let bench = Bench::new(&study("\"3 g\", \"4 g\"", hazard));
    let case = std::fs::read_to_string(bench.path("case.toml")).unwrap();
    let weak = "p_delta = true\nlaw = { model = \"elastic_perfectly_plastic\", yield_force = \"20 kN\" }\nheight";
    std::fs::write(bench.path("case.toml"), case.replacen("height", weak, 1)).unwrap();
    let told: serde_json::Value =
        serde_json::from_str(&bench.text("ida study.toml -o out.h5 --json")).unwrap();
    assert_eq!(told["levels"][0]["collapsed"], 2, "{told}");
    let minimum = &told["gaps"][0]["minimum"];
    for key in ["width", "mean_annual_frequency", "mean_annual_frequency_is"] {
        assert!(minimum[key].is_null(), "{key}: {minimum}");
    }
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

/// Numbers that would be usual in g, or in percent, are asked about; with a unit nothing is said.
#[test]
fn bare_numbers_of_limits_and_hazard_are_asked_about() {
    let limits = |acceleration: &str, drift: &str| {
        format!(
            "[[ida.limit]]\nname = \"contents\"\ndemand = \"acceleration_absolute\"\nexceeds = {acceleration}\n[[ida.limit]]\nname = \"collapse\"\ndemand = \"drift_ratio\"\nexceeds = {drift}\n"
        )
    };
    let told = |hazard: &str, limits: &str| {
        let text = study("\"0.3 g\", \"0.6 g\"", hazard) + limits;
        Bench::new(&text).text("ida study.toml -o out.h5")
    };
    let bare = told("[[0.02, 0.5], [0.2, 5e-3], [9, 2e-6]]", &limits("2", "2"));
    for said in [
        "the intensities of the hazard curve have no unit",
        "the limit \"contents\" is 2 m/s2",
        "the limit \"collapse\" is a drift ratio of 200 %",
    ] {
        assert!(bare.contains(said), "{bare}");
    }
    let meant = "[[\"0.02 m/s2\", 0.5], [\"0.2 m/s2\", 5e-3], [\"9 m/s2\", 2e-6]]";
    let stated = told(meant, &limits("\"2 m/s2\"", "\"2 %\""));
    assert!(!stated.contains("warning"), "{stated}");
    let bench = Bench::new(&study("\"0.3 g\", \"0.6 g\"", "\"curve.csv\""));
    std::fs::write(bench.path("curve.csv"), "0.02,0.5\n0.2,5e-3\n9,2e-6\n").unwrap();
    let bare = bench.text("ida study.toml -o out.h5");
    assert!(bare.contains("the hazard curve have no unit"), "{bare}");
    std::fs::write(
        bench.path("curve.csv"),
        "pga (m/s2),mean_annual_frequency\n0.02,0.5\n0.2,5e-3\n9,2e-6\n",
    )
    .unwrap();
    let stated = bench.text("ida study.toml -o out.h5");
    assert!(!stated.contains("no unit"), "{stated}");
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
    // At the variable, and not at `[ida]`.
    assert!(said.contains("study.toml:4:1"), "{said}");
}

/// A sampled design has as many intensities as runs, each of which would stand for the first.
#[test]
fn an_analysis_is_no_sampled_design() {
    let hazard = "[[\"0.02 g\", 0.5], [\"0.2 g\", 5e-3], [\"9 g\", 2e-6]]";
    let with = |range: &str, design: &str| {
        let study = study("\"0.1 g\", \"3 g\"", hazard);
        let study = study.replace("values = [\"0.1 g\", \"3 g\"]", range);
        Bench::new(&format!("{study}[design]\n{design}\n"))
    };
    let range = "from = \"0.1 g\"\nto = \"3 g\"\ncount = 3";
    for kind in ["latin_hypercube", "sobol"] {
        let bench = with(range, &format!("kind = \"{kind}\"\nruns = 8"));
        for command in ["ida", "sweep"] {
            let said = bench.complaint(&format!("{command} study.toml -o out.h5"), 2);
            let expected = format!("takes every record at every intensity, which {kind} does not");
            assert!(said.contains(&expected), "{said}");
        }
    }
}

/// Where even the first frequency of the hazard curve is below the target, any gap would do.
#[test]
fn a_target_lies_below_the_hazard_curve() {
    let hazard = "[[\"0.2 g\", 2.1e-3], [\"9 g\", 2e-6]]";
    let bench = Bench::new(&study("\"0.1 g\", \"3 g\"", hazard));
    let said = bench.complaint("ida study.toml -o out.h5", 2);
    let expected =
        "the target frequency is not below 0.0021 1/year, with which the hazard curve begins";
    assert!(said.contains(expected), "{said}");
    assert!(said.contains("target_frequency = 2.1e-3"), "{said}");
}

/// The least gap says of its fit what the same width asked for says, and who reads numbers or page
/// finds the hazard that both are of.
#[test]
fn a_least_gap_says_what_its_width_does() {
    let hazard = "[[\"0.02 g\", 0.5], [\"0.2 g\", 5e-3], [\"9 g\", 2e-12]]";
    let intensities = "\"0.05 g\", \"0.1 g\", \"0.2 g\", \"0.4 g\", \"0.8 g\", \"1.6 g\"";
    let bench = Bench::new(&study(intensities, hazard));
    let told = |arguments: &str| -> serde_json::Value {
        serde_json::from_str(&bench.text(arguments)).unwrap()
    };
    let first = told("ida study.toml -o out.h5 --json");
    let width = first["gaps"][0]["minimum"]["width"].as_f64().unwrap();
    let text = std::fs::read_to_string(bench.path("study.toml")).unwrap();
    std::fs::write(
        bench.path("study.toml"),
        text.replace("gaps = [\"20 mm\"]", &format!("gaps = [{width:?}]")),
    )
    .unwrap();
    let told = told("ida study.toml -o out.h5 --resume --json --report page.html");
    let (least, asked) = (&told["gaps"][0]["minimum"], &told["gaps"][0]["widths"][0]);
    for key in [
        "width",
        "mean_annual_frequency",
        "mean_annual_frequency_is",
        "mean_annual_frequency_bounds",
        "goodness_of_fit",
    ] {
        assert_eq!(least[key], asked[key], "{key}");
    }
    let said = |of: &serde_json::Value| -> Vec<String> {
        let remarks = of["remarks"].as_array().unwrap().iter();
        remarks.map(|r| r.as_str().unwrap().to_owned()).collect()
    };
    let beside = said(least);
    assert!(said(asked).iter().all(|remark| beside.contains(remark)));
    assert!(!said(asked).is_empty());
    assert_eq!(told["hazard"][1][1], 5e-3);
    assert_eq!(told["target_frequency"], 2.1e-3);
    let page = String::from_utf8(bench.bytes("page.html")).unwrap();
    for part in ["Hazard at the site", "2.000e-12", "0.005000"] {
        assert!(page.contains(part), "{part}");
    }
}

/// A shard has no page of fragilities; its file is named, and what to do.
#[test]
fn a_shard_has_no_page_of_an_analysis() {
    let hazard = "[[\"0.02 g\", 0.5], [\"9 g\", 2e-6]]";
    let bench = Bench::new(&study("\"0.1 g\", \"0.2 g\", \"3 g\"", hazard));
    let text = std::fs::read_to_string(bench.path("study.toml")).unwrap();
    std::fs::write(
        bench.path("study.toml"),
        format!("{text}[output]\nchunk = 1\n"),
    )
    .unwrap();
    bench.text("ida study.toml -o out.h5 --shard 1/2");
    let said = bench.complaint("report out.h5 --study study.toml -o page.html", 2);
    for part in ["out.h5 is shard 1/2", "pounding merge"] {
        assert!(said.contains(part), "{said}");
    }
    bench.text("report out.h5 -o page.html");
}

/// A value that a grid has twice is made twice, which is said.
#[test]
fn a_value_that_stands_twice_is_told() {
    let of = |values: &str| {
        let text = format!(
            "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nvalues = {values}\n"
        );
        Bench::new(&text).text("sweep study.toml -o out.h5")
    };
    let said = "variable \"gap_0_width\" has the value 0.01 m more than once";
    assert!(of("[0.01, 0.02, \"10 mm\"]").contains(said));
    assert!(!of("[0.01, 0.02]").contains("more than once"));
}

/// So is a model under two of its names, and a record in two files that a variable names.
#[test]
fn a_choice_that_stands_twice_is_told() {
    let of = |path: &str, values: &str| {
        let text =
            format!("case = \"case.toml\"\n[[variable]]\npath = \"{path}\"\nvalues = {values}\n");
        let bench = Bench::new(&text);
        let record = super::root().join("ground_motions/el_centro_1940_ns.csv");
        std::fs::copy(record, bench.path("copy.csv")).unwrap();
        bench.text("sweep study.toml -o out.h5")
    };
    let twice = of(
        "gap.0.model",
        "[\"jankowski_2005\", \"lankarani_nikravesh_1990\", \"jankowski_2006\"]",
    );
    let said = "variable \"gap_0_model\" has the model jankowski_2005 more than once, as \"jankowski_2005\" and \"jankowski_2006\"";
    assert!(twice.contains(said), "{twice}");
    let once = of(
        "gap.0.model",
        "[\"jankowski_2005\", \"lankarani_nikravesh_1990\"]",
    );
    assert!(!once.contains("more than once"), "{once}");
    let same = of(
        "ground_motion.file",
        "[\"MOTIONS/el_centro_1940_ns.csv\", \"./copy.csv\"]",
    );
    assert!(same.contains("are the same motion"), "{same}");
}
