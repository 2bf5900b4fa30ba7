//! States of storeys that yield, and of some storeys of a building.

use serde_json::Value;

use super::{Bench, root};

/// Counts of states of ductility, of residual drift and of some storeys are those of the table of runs.
#[test]
fn states_of_storeys_that_yield_are_counted() {
    let states = [
        ("ductility", "building = \"light\"", 3.0),
        ("residual_drift_ratio", "building = \"light\"", 0.01),
        (
            "drift_ratio",
            "building = \"light\"\nstorey = [2, 3]",
            0.012,
        ),
        ("impacts", "level = [1, 2]", 1.0),
    ];
    let limits = states.map(|(demand, place, exceeds)| {
        format!("[[ida.limit]]\nname = \"{demand}\"\ndemand = \"{demand}\"\n{place}\nexceeds = {exceeds}\n")
    });
    let bench = Bench::new(&format!(
        "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\", \"MOTIONS/kobe_1995_jma_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.05 g\", \"0.3 g\", \"0.6 g\"]\n[ida]\n{}",
        limits.concat()
    ));
    let case = std::fs::read_to_string(root().join("examples/yielding_pair/case.toml")).unwrap();
    let records = root().join("ground_motions");
    let case = case.replace("../../ground_motions", records.to_str().unwrap());
    std::fs::write(bench.path("case.toml"), case.replace("31 s", "8 s")).unwrap();
    let told = bench.text("ida study.toml -o out.h5 --json");
    let told: Value = serde_json::from_str(&told).unwrap();
    bench.text("sweep study.toml -o again.h5 --csv runs.csv");
    let mut table = csv::Reader::from_path(bench.path("runs.csv")).unwrap();
    let headers = table.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    let columns = [
        ("peak_ductility: light ", ["1", "2", "3"].as_slice()),
        ("residual_drift_ratio: light ", &["1", "2", "3"]),
        ("peak_drift_ratio: light ", &["2", "3"]),
        ("impacts: light-heavy ", &["1-1", "2-2"]),
    ];
    let mut reached_somewhere = 0;
    for (state, ((of, places), (_, _, exceeds))) in columns.iter().zip(states).enumerate() {
        let own = |name: &str| {
            let rest = name.strip_prefix(of);
            let place = rest.map(|rest| rest.split(' ').next().unwrap_or_default());
            place.is_some_and(|place| places.contains(&place))
        };
        let own: Vec<usize> = (0..headers.len()).filter(|i| own(&headers[*i])).collect();
        assert_eq!(own.len(), places.len(), "{headers:?}");
        let reached = |row: &csv::StringRecord| {
            let value = |column: &usize| row[*column].parse::<f64>().unwrap().abs();
            own.iter().any(|column| value(column) > exceeds)
        };
        // The last variable is the fastest: rows of both records at an intensity lie three apart.
        let expected = [0, 1, 2].map(|i| [i, i + 3].iter().filter(|r| reached(&rows[**r])).count());
        let counts = told["limits"][state + 1]["counts"].as_array().unwrap();
        let found: Vec<u64> = counts
            .iter()
            .filter_map(|c| c["reached"].as_u64())
            .collect();
        assert_eq!(found, expected.map(|n| n as u64), "{of}");
        assert_eq!(found[0], 0);
        reached_somewhere += usize::from(found[2] > 0);
    }
    assert_eq!(reached_somewhere, 4, "{told}");
}

/// Laws without a yield force have no ductility to exceed.
#[test]
fn ductility_of_laws_without_a_yield_force_is_refused() {
    let bench = Bench::new(
        "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.05 g\", \"0.3 g\"]\n[ida]\n[[ida.limit]]\nname = \"x\"\ndemand = \"ductility\"\nexceeds = 2\n",
    );
    let case = std::fs::read_to_string(bench.path("case.toml")).unwrap();
    let (before, after) = case.split_once("[[gap]]").unwrap();
    let law = "law = { model = \"linear\" }\n";
    std::fs::write(
        bench.path("case.toml"),
        format!("{before}{law}[[gap]]{after}"),
    )
    .unwrap();
    let told = bench.complaint("ida study.toml -o out.h5", 2);
    assert!(
        told.contains("only laws with a yield force have it"),
        "{told}"
    );
}

/// The example of a study, whose run at the gap and strength of the case has the ductility of `run`, which
/// `crates/cli/tests/yielding_examples.rs` holds against an independent solution.
#[test]
fn ductility_by_gap_and_strength() {
    let bench = Bench::new("");
    let study = root().join("examples/yielding_pair/study.toml");
    bench.text(&format!("sweep {} -o out.h5", study.display()));
    let file = hdf5::File::open(bench.path("out.h5")).unwrap();
    let first_storeys = |name: &str| {
        let all = file.dataset(name).unwrap().read_2d::<f64>().unwrap();
        (0..20).map(|run| all[[run, 0]]).collect::<Vec<f64>>()
    };
    let [with, without] = ["peak_ductility", "isolated_peak_ductility"].map(first_storeys);
    // Five strengths at each gap, of which the third is that of the case.
    for (run, ductility, alone) in [
        (12, 2.910, 1.333),
        (7, 1.763, 1.333),
        (5, 5.082, 2.404),
        (10, 2.183, 2.404),
    ] {
        assert!((with[run] - ductility).abs() < 1e-3, "{}", with[run]);
        assert!((without[run] - alone).abs() < 1e-3, "{}", without[run]);
    }
    let case = root().join("examples/yielding_pair/case.toml");
    let told = bench.text(&format!("run {} --no-output --json", case.display()));
    let told: Value = serde_json::from_str(&told).unwrap();
    let of_run = &told["buildings"][0]["yielding"][0]["ductility"]["peak"];
    assert!(
        (of_run.as_f64().unwrap() / with[7] - 1.0).abs() < 1e-9,
        "{of_run}"
    );
}
