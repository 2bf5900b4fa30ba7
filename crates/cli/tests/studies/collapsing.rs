//! Runs in which gravity overturns a building: answers, not failures.

use serde_json::Value;

use super::Bench;

/// A frame that yields early under gravity, beside a stiff block.
const CASE: &str = r#"
[[building]]
name = "frame"
storeys = 1
mass = "50 t"
stiffness = "2 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.02 }
law = { model = "elastic_perfectly_plastic", yield_force = "60 kN" }
p_delta = true

[[building]]
name = "block"
storeys = 1
mass = "1000 t"
stiffness = "2215 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }

[[gap]]
between = ["frame", "block"]
width = "20 mm"
model = "anagnostopoulos_1988"
stiffness = "93.5 MN/m"
restitution = 0.6

[ground_motion]
file = "MOTIONS/el_centro_1940_ns.csv"

[analysis]
method = "adaptive"
"#;

const STUDY: &str = r#"
case = "case.toml"
[[variable]]
records = ["MOTIONS/el_centro_1940_ns.csv", "MOTIONS/kobe_1995_jma_ns.csv"]
[[variable]]
intensity = "peak_ground_acceleration"
values = ["0.02 g", "0.2 g", "2 g", "4 g"]
[ida]
gaps = ["20 mm", "400 mm"]
hazard = [["0.01 g", 1], ["4 g", 1e-6]]
target_frequency = 1e-4
[[ida.limit]]
name = "drift"
demand = "drift_ratio"
building = "frame"
exceeds = 0.9
[[ida.limit]]
name = "force"
demand = "contact_force"
exceeds = "1e9 N"
"#;

fn bench() -> Bench {
    bench_of(CASE)
}

fn bench_of(case: &str) -> Bench {
    let bench = Bench::new(STUDY);
    let motions = super::root().join("ground_motions");
    let case = case.replace("MOTIONS", motions.to_str().unwrap());
    std::fs::write(bench.path("case.toml"), case).unwrap();
    bench
}

/// Every record overturns the frame at the highest intensity: all states are reached there,
/// whatever the demand, and fractiles are infinite.
#[test]
fn a_collapse_has_reached_every_state() {
    let bench = bench();
    let told: Value =
        serde_json::from_str(&bench.text("ida study.toml -o out.h5 --csv out.csv --json")).unwrap();
    assert_eq!(told["sweep"]["failed"], 0);
    // The figure speaks of curves that it has, and reaches the last intensity.
    bench.text("ida study.toml --plot figure.svg");
    let figure = String::from_utf8(bench.bytes("figure.svg")).unwrap();
    let fitted = |states: &Value| {
        let mut states = states.as_array().unwrap().iter();
        states.any(|state| state["fit"]["kind"] == "lognormal")
    };
    let of_limits = figure.split("Probability of a state").nth(1).unwrap();
    let (of_limits, of_widths) = of_limits.split_once("Probability of pounding").unwrap();
    for (panel, states) in [
        (of_limits, &told["limits"]),
        (of_widths, &told["gaps"][0]["widths"]),
    ] {
        assert_eq!(panel.contains("fitted curves"), fitted(states), "{states}");
        assert!(panel.contains(">4.0</text>") || panel.contains(">4</text>"));
    }
    let levels = told["levels"].as_array().unwrap();
    assert_eq!(
        (&levels[0]["collapsed"], &levels[0]["runs"]),
        (&0.into(), &2.into())
    );
    assert_eq!(
        (&levels[3]["collapsed"], &levels[3]["runs"]),
        (&2.into(), &2.into())
    );
    for limit in told["limits"].as_array().unwrap() {
        let top = &limit["counts"][3];
        assert_eq!(
            (&top["runs"], &top["reached"]),
            (&2.into(), &2.into()),
            "{limit}"
        );
    }
    let force = &told["limits"][2];
    assert_eq!(force["name"], "force");
    assert_eq!(force["counts"][0]["reached"], 0);
    // Pounding by width asks the frame without its neighbour: it falls by itself.
    for width in told["gaps"][0]["widths"].as_array().unwrap() {
        assert_eq!(width["counts"][3]["reached"], 2, "{width}");
    }
    let drift = &levels[3]["demands"][0];
    assert_eq!(drift["name"], "peak_drift_ratio: frame");
    assert!(drift["p50"].is_null() && levels[0]["demands"][0]["p50"].is_number());
    let collapsed = told["sweep"]["collapsed"].as_u64().unwrap();
    assert!(collapsed >= 2);
    let first = told["sweep"]["first_collapses"][0]["diagnosis"]
        .as_str()
        .unwrap();
    assert!(
        first.contains("frame collapsed at t =") && first.contains("storey 1"),
        "{first}"
    );
    // The table of runs tells them from failures.
    let mut reader = csv::Reader::from_path(bench.path("out.csv")).unwrap();
    let header = reader.headers().unwrap().clone();
    let column = |name: &str| header.iter().position(|h| h == name).unwrap();
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    let fallen: Vec<_> = rows
        .iter()
        .filter(|r| &r[column("status")] == "collapsed")
        .collect();
    assert_eq!(fallen.len() as u64, collapsed);
    for row in fallen {
        assert!(row[column("diagnosis")].contains("frame collapsed at t ="));
        assert!(row[column("energy_input [J]")].is_empty());
        assert!(!row[column("isolated_demand: frame-block 1-1 (3 m | 3 m) [m]")].is_empty());
    }
    // For people; and the shards of a study carry collapses into the whole.
    let told = bench.text("ida study.toml -o out.h5 --resume");
    assert!(
        told.contains("none failed") && told.contains(&format!("Collapse in {collapsed} runs")),
        "{told}"
    );
    assert!(told.contains("inf"), "{told}");
    for shard in ["1/2", "2/2"] {
        bench.text(&format!(
            "sweep study.toml --shard {shard} -o {}.h5",
            &shard[..1]
        ));
    }
    let told: Value =
        serde_json::from_str(&bench.text("merge 1.h5 2.h5 -o merged.h5 --json")).unwrap();
    assert_eq!(
        (&told["failed"], &told["collapsed"]),
        (&0.into(), &collapsed.into())
    );
    assert!(bench.bytes("merged.h5") == bench.bytes("out.h5"));
}

/// A light building that falls where the heavy one hits it, and stands by itself with demands of 164 mm
/// at 4.58 m/s2 and 237 mm at 5.78 m/s2: pounding at a gap of 200 mm and a limit of that on the isolated
/// demand are one state, which is not reached at the first.
#[test]
fn a_limit_on_the_isolated_demand_asks_the_buildings_without_contact() {
    let building = |name: &str, rest: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nstoreys = 2\nheight = \"4 m\"\ndamping = {{ modal = 0.05 }}\n{rest}\n"
        )
    };
    let case = building(
        "light",
        "mass = \"100 t\"\nstiffness = [\"9 MN/m\", \"8 MN/m\"]\np_delta = true\nlaw = { model = \"bilinear\", yield_force = \"250 kN\" }",
    ) + &building("heavy", "mass = \"120 t\"\nstiffness = \"60 MN/m\"")
        + "[[gap]]\nbetween = [\"light\", \"heavy\"]\nwidth = \"60 mm\"\nmodel = \"anagnostopoulos_2004\"\nstiffness = \"500 MN/m\"\nrestitution = 0.6\n"
        + &CASE[CASE.find("[ground_motion]").unwrap()..CASE.find("[analysis]").unwrap()];
    let bench = bench_of(&case);
    bench.study("case = \"case.toml\"\n[output]\nisolated_peaks = true\n[[variable]]\nrecords = [\"MOTIONS/kobe_1995_jma_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [2.179, 4.576, 5.775]\n[ida]\ngaps = [\"200 mm\"]\n[[ida.limit]]\nname = \"isolated\"\ndemand = \"isolated_demand\"\nexceeds = \"200 mm\"\n[[ida.limit]]\nname = \"drift\"\ndemand = \"drift_ratio\"\nbuilding = \"light\"\nexceeds = 0.9\n");
    let told: Value = serde_json::from_str(&bench.text("ida study.toml -o out.h5 --json")).unwrap();
    let reached = |state: &Value| {
        let counts = state["counts"].as_array().unwrap().iter();
        counts
            .map(|c| c["reached"].as_u64().unwrap())
            .collect::<Vec<_>>()
    };
    assert_eq!(told["levels"][1]["collapsed"], 1, "{told}");
    assert_eq!(reached(&told["gaps"][0]["widths"][0]), [0, 0, 1]);
    assert_eq!(reached(&told["limits"][1]), [0, 0, 1]);
    // Other demands are above everything in a collapse.
    assert_eq!(reached(&told["limits"][2]), [0, 1, 1]);
    // Peaks without pounding are known where contact alone overturns the building.
    let file = hdf5::File::open(bench.path("out.h5")).unwrap();
    let drifts = |name: &str| file.dataset(name).unwrap().read_raw::<f64>().unwrap();
    let (with, without) = (
        drifts("peak_drift_ratio"),
        drifts("isolated_peak_drift_ratio"),
    );
    assert!(
        with[0] > 0.0 && with[4..].iter().all(|x| x.is_nan()),
        "{with:?}"
    );
    assert!(without.iter().all(|x| *x > 0.0), "{without:?}");
}

/// A study in which every run collapses has an answer; one run alone still ends with 3.
#[test]
fn collapse_of_all_runs_is_no_failure() {
    let bench = bench();
    let study = STUDY.replace("\"0.02 g\", \"0.2 g\", \"2 g\", ", "");
    bench.study(&study.replace("[ida]", "[output]\nisolated_peaks = true\n[ida]"));
    let told = bench.text("sweep study.toml -o out.h5");
    assert!(
        told.contains("none failed") && told.contains("Collapse in 2 runs"),
        "{told}"
    );
    // The frame falls by itself: no gap keeps it apart, and it has no peaks.
    let file = hdf5::File::open(bench.path("out.h5")).unwrap();
    let values = |name: &str| file.dataset(name).unwrap().read_raw::<f64>().unwrap();
    assert_eq!(values("isolated_demand"), [f64::INFINITY; 2]);
    let peaks = values("isolated_peak_displacement");
    assert!(
        peaks.len() == 4 && peaks.iter().all(|x| x.is_nan()),
        "{peaks:?}"
    );
}

/// Runs that failed count nowhere; collapses count beside them.
#[test]
fn failures_stay_out_where_collapses_count() {
    let bench = bench();
    bench.study(&STUDY.replace("records = [", "records = [\"nowhere.csv\", "));
    let told: Value =
        serde_json::from_str(&bench.text("ida study.toml -o out.h5 --keep-going --json")).unwrap();
    assert_eq!(told["sweep"]["failed"], 4);
    let top = &told["levels"][3];
    assert_eq!(
        (&top["runs"], &top["failed"], &top["collapsed"]),
        (&2.into(), &1.into(), &2.into())
    );
    assert_eq!(told["limits"][1]["counts"][3]["runs"], 2);
    // Who falls by itself is kept apart by no gap.
    let study = STUDY.replace("1e-4", "1e-6");
    bench.study(&study.replace("\"0.02 g\", \"0.2 g\", ", "\"0.02 g\", "));
    let told = bench.text("ida study.toml -o other.h5");
    assert!(
        told.contains("the buildings collapse too often by themselves"),
        "{told}"
    );
}

/// A state that every run reaches already at the least intensity has no frequency, and the
/// table says why.
#[test]
fn a_missing_frequency_has_a_reason() {
    let bench = bench();
    bench.study(&STUDY.replace("\"0.02 g\", \"0.2 g\", ", ""));
    let told = bench.text("ida study.toml -o out.h5");
    assert!(
        told.contains("- (all reach it already at 2.000 g)"),
        "{told}"
    );
}

/// A hazard file in g is the hazard in SI; one that says no unit is refused with its line.
#[test]
fn a_hazard_file_says_its_units() {
    let bench = bench();
    let listed = "hazard = [[\"0.01 g\", 1], [\"4 g\", 1e-6]]";
    assert!(STUDY.contains(listed));
    let frequencies = |output: &str| {
        let told: Value =
            serde_json::from_str(&bench.text(&format!("ida study.toml -o {output} --json")))
                .unwrap();
        let limits = told["limits"].as_array().unwrap().clone();
        let all: Vec<f64> = limits
            .iter()
            .map(|l| l["mean_annual_frequency"].as_f64().unwrap())
            .collect();
        all
    };
    let expected = frequencies("a.h5");
    let file = STUDY.replace(listed, "hazard = \"hazard.csv\"");
    bench.study(&file);
    for (i, text) in [
        "pga (g),mean_annual_frequency\n0.01,1\n4,1e-6\n",
        "pga_g,frequency (1/year)\n0.01,1\n4,1e-6\n",
        "0.0980665,1\n39.2266,1e-6\n",
    ]
    .into_iter()
    .enumerate()
    {
        std::fs::write(bench.path("hazard.csv"), text).unwrap();
        for (found, wanted) in frequencies(&format!("{i}.h5")).iter().zip(&expected) {
            assert!((found / wanted - 1.0).abs() < 1e-12, "{text}");
        }
    }
    std::fs::write(bench.path("hazard.csv"), "# x\npga,mafe\n0.01,1\n4,1e-6\n").unwrap();
    let told = bench.complaint("ida study.toml -o b.h5", 2);
    assert!(
        told.contains("hazard.csv:2: \"pga\" does not say its unit"),
        "{told}"
    );
    // What is wrong with the points together too.
    for (points, said) in [
        (
            "0.01,1\n\n4,1e-6\n3,1e-7\n",
            "hazard.csv:6: intensities must rise",
        ),
        (
            "0.01,1\n4,-1e-6\n",
            "hazard.csv:4: intensities and frequencies must be above zero",
        ),
        (
            "1e-300,1e300\n4,1e-6\n",
            "hazard.csv:3: intensities and frequencies must be from 1e-100 to 1e100",
        ),
        ("0.01,1\n", "hazard.csv: it has fewer than two points"),
    ] {
        let text = format!("# x\npga (g),mafe\n{points}");
        std::fs::write(bench.path("hazard.csv"), text).unwrap();
        let told = bench.complaint("ida study.toml -o a.h5", 2);
        assert!(
            told.contains(said) && told.contains("study.toml:"),
            "{told}"
        );
    }
    assert!(told.contains("intensity (g),frequency (1/year)"), "{told}");
}

/// The page of a sweep: demands that are infinite count, other peaks are said to be of the runs that
/// stood, runs have their numbers, and a part says that it is one.
#[test]
fn a_page_says_what_collapses_leave_out() {
    let bench = bench();
    bench.study(&STUDY[..STUDY.find("[ida]").unwrap()].replace(
        "case = \"case.toml\"",
        "case = \"case.toml\"\n[output]\nisolated_demand = true\nchunk = 1",
    ));
    bench.text("sweep study.toml -o out.h5 --report page.html");
    let page = String::from_utf8(bench.bytes("page.html")).unwrap();
    for said in [
        "that neither failed nor collapsed",
        "; of runs that collapsed it is not known",
        "of the runs that stood",
        "infinite",
        " in run ",
    ] {
        assert!(page.contains(said), "{said}");
    }
    assert!(!page.contains("in row "));
    assert!(!page.contains("A part of the study"));
    // The run of the greatest force can be shown.
    let number = page.split(" in run ").nth(1).unwrap();
    let number = number.split(|c: char| !c.is_ascii_digit()).next().unwrap();
    bench.text(&format!("sweep study.toml --show {number}"));
    bench.text("sweep study.toml -o part.h5 --shard 2/2 --report part.html");
    let page = String::from_utf8(bench.bytes("part.html")).unwrap();
    let said = "<strong>A part of the study</strong>, shard 2/2: 4 of its 8 runs";
    assert!(page.contains(said));
    // Where nothing stands, nothing is counted.
    bench.study(
        "case = \"case.toml\"\n[[variable]]\nintensity = \"peak_ground_acceleration\"\n\
         values = [\"3 g\", \"4 g\"]\n",
    );
    bench.text("sweep study.toml -o none.h5 --report none.html");
    let page = String::from_utf8(bench.bytes("none.html")).unwrap();
    assert!(page.contains("<strong>2 runs</strong>: 0 failed and 2 collapsed."));
    assert!(page.contains("No run stood: peaks and impacts are not known."));
    assert!(!page.contains("NaN"));
}

/// Three of nine runs stand: no part of the variance is told of a grid that lacks values, and why. With the weakest frame left
/// out all stand but those of one intensity, and what is left is a grid. The spring of the contact is elastic: it dissipates
/// nothing, and not what round-off leaves.
#[test]
fn a_grid_with_collapses_tells_no_parts() {
    let study = |forces: &str, most: &str| {
        format!(
            r#"
case = "case.toml"
[[variable]]
name = "fy"
path = "building.frame.law.yield_force"
values = [{forces}]
[[variable]]
name = "pga"
intensity = "peak_ground_acceleration"
values = ["0.1 g", "0.4 g", "{most}"]
"#
        )
    };
    let bench = Bench::new(&study(r#""60 kN", "150 kN", "400 kN""#, "0.9 g"));
    let motions = concat!(env!("CARGO_MANIFEST_DIR"), "/../../ground_motions");
    let case = r#"
[[building]]
name = "frame"
storeys = 2
mass = "100 t"
stiffness = "8 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.03 }
p_delta = true
law = { model = "elastic_perfectly_plastic", yield_force = "60 kN" }
[[gap]]
between = ["frame", "wall"]
levels = [2]
width = "10 mm"
model = "linear_elastic"
stiffness = "93.5 MN/m"
[ground_motion]
file = "MOTIONS/kobe_1995_jma_ns.csv"
[analysis]
duration = "20 s"
"#;
    std::fs::write(bench.path("case.toml"), case.replace("MOTIONS", motions)).unwrap();
    let page = |bench: &Bench| {
        bench.text("sweep study.toml -o out.h5 --report page.html");
        std::fs::read_to_string(bench.path("page.html")).unwrap()
    };
    let lacks = page(&bench);
    assert!(lacks.contains("6 collapsed"), "{lacks}");
    assert!(!lacks.contains("of its variance"), "{lacks}");
    assert!(
        lacks.contains("No parts are told of number of impacts, of maximum contact force, of "),
        "{lacks}"
    );
    let energy = lacks
        .split("energy dissipated in contacts (kJ)</th>")
        .nth(1);
    let energy = energy.unwrap().split("</tr>").next().unwrap();
    assert!(energy.starts_with(&"<td>0</td>".repeat(5)), "{energy}");
    bench.study(&study(r#""400 kN", "600 kN""#, "9 g"));
    let whole = page(&bench);
    assert!(whole.contains(" collapsed"), "{whole}");
    assert!(!whole.contains("No parts are told of"), "{whole}");
}
