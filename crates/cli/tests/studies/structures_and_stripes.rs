//! Incremental dynamic analyses with random structures, and with other records at every intensity.

use std::fmt::Write as _;

use serde_json::Value;

use super::Bench;

const RECORDS: usize = 24;
const INTENSITIES: [f64; 4] = [0.04, 0.08, 0.16, 0.32];
const SYNTHETIC: &str = "synthetic = { model = \"rezaeian_der_kiureghian_2010\", count = 24, duration = \"12 s\", significant_duration = \"6 s\", middle_time = \"4 s\", middle_frequency = \"3 1/s\" }";
const SETTINGS: &str = "[ida]\ngaps = [\"10 mm\", \"40 mm\"]\nhazard = [[\"0.01 g\", 0.1], [\"0.1 g\", 3e-3], [\"1 g\", 1e-5]]\n";

/// The study, with rows of runs in `runs.csv`.
fn analysed(bench: &Bench, study: &str) -> Value {
    bench.study(study);
    let told = bench.text("ida study.toml -o out.h5 --json --csv runs.csv");
    serde_json::from_str(&told).unwrap()
}

/// Columns of `runs.csv` whose names begin so.
fn columns(bench: &Bench, begins: [&str; 3]) -> Vec<[f64; 3]> {
    let mut reader = csv::Reader::from_path(bench.path("runs.csv")).unwrap();
    let header = reader.headers().unwrap().clone();
    let places = begins.map(|name| {
        let found = header.iter().position(|column| column.starts_with(name));
        found.unwrap_or_else(|| panic!("{name}: {header:?}"))
    });
    let rows = reader.records().map(|row| {
        let row = row.unwrap();
        places.map(|place| row[place].parse().unwrap())
    });
    rows.collect()
}

fn reached(state: &Value) -> Vec<[u64; 2]> {
    let counts = state["counts"].as_array().unwrap().iter();
    let count = |count: &Value| ["reached", "runs"].map(|key| count[key].as_u64().unwrap());
    counts.map(count).collect()
}

/// Each record has a structure of its own at all intensities, by which isolated linear buildings move in proportion to the
/// intensity. A list of a quarter of these runs, other records at every intensity, has the counts of these runs.
#[test]
fn random_structures_stay_with_their_records() {
    let bench = Bench::new("");
    let stiffness = "name = \"stiffness\"\npath = \"building.*.stiffness\"\nrelative = true\n";
    let random = "distribution = { kind = \"lognormal\", median = 1, dispersion = 0.3 }\n";
    let intensities = INTENSITIES.map(|x| format!("\"{x} g\"")).join(", ");
    let grid = format!(
        "case = \"case.toml\"\n[[variable]]\n{SYNTHETIC}\n[[variable]]\n{stiffness}{random}[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [{intensities}]\n[design]\nsamples = 1\n{SETTINGS}"
    );
    let whole = analysed(&bench, &grid);
    assert_eq!([&whole["records"], &whole["structures"]], [24, 24]);
    let rows = columns(
        &bench,
        ["stiffness", "intensity", "isolated_demand: light-heavy 3"],
    );
    assert_eq!(rows.len(), RECORDS * INTENSITIES.len());
    let mut factors = Vec::new();
    for of_record in rows.chunks(INTENSITIES.len()) {
        let [factor, intensity, demand] = of_record[0];
        factors.push(factor);
        for row in of_record {
            assert_eq!(row[0], factor);
            let expected = demand * row[1] / intensity;
            assert!((row[2] / expected - 1.0).abs() < 1e-9, "{row:?} {expected}");
        }
    }
    let mut different = factors.clone();
    different.sort_by(f64::total_cmp);
    different.dedup();
    assert_eq!(different.len(), RECORDS);
    let text = bench.text("ida study.toml -o out.h5 --resume");
    assert!(text.contains("24 records, 24 structures"), "{text}");

    // Other records at every intensity: the states of the same runs.
    let level = |record: usize| record % INTENSITIES.len();
    let row = |of: &dyn Fn(usize) -> String| -> String {
        (0..RECORDS).map(of).collect::<Vec<_>>().join(", ")
    };
    let stripes = format!(
        "case = \"case.toml\"\n[[variable]]\n{SYNTHETIC}\n[[variable]]\n{stiffness}values = [{}]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [{}]\n[design]\nkind = \"list\"\n{SETTINGS}",
        row(&|record| factors[record].to_string()),
        row(&|record| format!("\"{} g\"", INTENSITIES[level(record)])),
    );
    let told = analysed(&bench, &stripes);
    assert_eq!([&told["records"], &told["structures"]], [24, 24]);
    for (i, width) in [0.01, 0.04].into_iter().enumerate() {
        let mut expected = [[0, 0]; INTENSITIES.len()];
        for record in 0..RECORDS {
            let count = &mut expected[level(record)];
            let demand = rows[record * INTENSITIES.len() + level(record)][2];
            count[0] += u64::from(demand > width);
            count[1] += 1;
        }
        let state = &told["gaps"][0]["widths"][i];
        assert_eq!(reached(state), expected);
        let said = state["remarks"].to_string();
        assert!(!said.contains("at several intensities"), "{said}");
        assert!(!said.contains("of 0"), "{said}");
    }
    // With a picture of points, not of lines.
    let text = bench.text("ida study.toml -o out.h5 --resume --plot curves.svg");
    assert!(text.contains("24 records, 24 structures"), "{text}");
    let picture = String::from_utf8(bench.bytes("curves.svg")).unwrap();
    assert!(picture.contains("24 runs, with pounding"), "{picture}");
}

/// A list that has every record at every intensity, under a name for each, says what a grid of them says; and one that has
/// a record at some of them has no test.
#[test]
fn lists_know_records_that_have_several_names() {
    let bench = Bench::new("");
    let files = ["el_centro_1940_ns", "kobe_1995_jma_ns"];
    let file = |name: &str| format!("file = \"MOTIONS/{name}.csv\"");
    let intensity = |values: &str| {
        format!("[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [{values}]\n")
    };
    let grid = format!(
        "case = \"case.toml\"\n[[variable]]\nrecords = [{}]\n{}{SETTINGS}",
        files.map(|name| format!("{{ {} }}", file(name))).join(", "),
        intensity("0.5, 1, 2")
    );
    let whole = analysed(&bench, &grid);
    let list = |runs: &[(&str, f64)]| {
        let (mut records, mut intensities) = (String::new(), String::new());
        for (name, x) in runs {
            write!(records, "{{ name = \"{name} at {x}\", {} }}, ", file(name)).unwrap();
            write!(intensities, "{x}, ").unwrap();
        }
        format!(
            "case = \"case.toml\"\n[[variable]]\nrecords = [{records}]\n{}[design]\nkind = \"list\"\n{SETTINGS}",
            intensity(&intensities)
        )
    };
    let [a, b] = files;
    let all = [(a, 0.5), (b, 0.5), (b, 1.0), (b, 2.0), (a, 1.0), (a, 2.0)];
    let told = analysed(&bench, &list(&all));
    assert_eq!(told["sweep"]["warnings"], whole["sweep"]["warnings"]);
    assert_eq!(told["records"], 2);
    assert_eq!(told["limits"], whole["limits"]);
    assert_eq!(told["gaps"], whole["gaps"]);
    // Also where the structure differs a little from run to run.
    let values: Vec<String> = (0..6)
        .map(|i| format!("{}", 1.0 + 1e-9 * f64::from(i)))
        .collect();
    let third = format!(
        "[[variable]]\nname = \"k\"\npath = \"building.light.stiffness\"\nrelative = true\nvalues = [{}]\n[design]",
        values.join(", ")
    );
    let told = analysed(&bench, &list(&all).replace("[design]", &third));
    assert_eq!([&told["records"], &told["structures"]], [2, 6]);
    let state = |of: &Value| {
        let state = &of["gaps"][0]["widths"][0];
        (state["counts"].clone(), state["remarks"].clone())
    };
    assert_eq!(state(&told), state(&whole));
    let some = analysed(&bench, &list(&all[..4]));
    assert_eq!(some["records"], 2);
    let states = some["gaps"][0]["widths"].as_array().unwrap();
    let fitted = states
        .iter()
        .filter(|state| state["fit"]["kind"] == "lognormal");
    for state in fitted {
        let said = state["remarks"].to_string();
        assert!(
            said.contains("at several intensities, but not one at each"),
            "{said}"
        );
    }
}

/// Gaps that vary are not those of the case; and a grid that lacks `samples` asks for them alone, as other designs are no
/// incremental dynamic analysis.
#[test]
fn gaps_may_be_random() {
    let bench = Bench::new("");
    let study = |design: &str| {
        format!(
            "case = \"case.toml\"\n[[variable]]\n{SYNTHETIC}\n[[variable]]\nname = \"gap\"\npath = \"gap.0.width\"\ndistribution = {{ kind = \"normal\", mean = \"20 mm\", standard_deviation = \"2 mm\" }}\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [0.4, 0.8]\n{design}{SETTINGS}"
        )
    };
    let told = analysed(&bench, &study("[design]\nsamples = 1\n"));
    assert_eq!(
        told["limits"][0]["name"],
        "pounding at the gaps of the runs"
    );
    bench.study(&study(""));
    let said = bench.complaint("ida study.toml -o other.h5", 2);
    assert!(said.contains("add `samples = ...` to [design]"), "{said}");
    assert!(!said.contains("latin_hypercube"), "{said}");
}
