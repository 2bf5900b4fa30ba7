//! Runs shown as cases of their own, and motions that studies make.

use std::collections::HashSet;

use serde_json::Value;

use super::{Bench, root};

/// A made motion without its usual values, and an intensity.
const MADE: &str = r#"
case = "case.toml"
[[variable]]
synthetic = { model = "rezaeian_der_kiureghian_2010", count = 2, seed = 7, duration = "6 s", significant_duration = "3 s", middle_time = "2 s", middle_frequency = "4 Hz" }
[[variable]]
intensity = "spectral_acceleration"
building = "light"
values = ["0.3 g", "0.8 g"]
"#;

/// The maximum displacement of each storey, in the table of runs.
fn displacements(bench: &Bench, run: usize) -> Vec<f64> {
    let mut reader = csv::Reader::from_path(bench.path("out.csv")).unwrap();
    let header = reader.headers().unwrap().clone();
    let row = reader.records().nth(run).unwrap().unwrap();
    let columns = header.iter().zip(row.iter());
    let of = columns.filter(|(name, _)| name.starts_with("peak_displacement: "));
    of.map(|(_, value)| value.parse().unwrap()).collect()
}

fn displacements_alone(bench: &Bench, case: &str) -> Vec<f64> {
    let told: Value =
        serde_json::from_str(&bench.text(&format!("run {case} --no-output --json"))).unwrap();
    let buildings = told["buildings"].as_array().unwrap();
    let storeys = buildings
        .iter()
        .flat_map(|b| b["storeys"].as_array().unwrap());
    storeys
        .map(|s| s["displacement"]["peak"].as_f64().unwrap())
        .collect()
}

fn assert_same(found: &[f64], alone: &[f64], told: &str) {
    assert_eq!(found.len(), 6);
    assert_eq!(found, alone, "{told}");
}

/// All numbers of an answer, as bits: of floors that are at rest zero may have either sign.
fn numbers(value: &Value, found: &mut HashSet<u64>) {
    match value {
        Value::Array(list) => list.iter().for_each(|one| numbers(one, found)),
        Value::Object(map) => map.values().for_each(|one| numbers(one, found)),
        one => {
            found.extend(one.as_f64().map(|x| (x + 0.0).to_bits()));
        }
    }
}

/// `run`, with all its histories, and a run of `sweep`, which has none, agree to the last bit in all numbers of the latter:
/// of pairs, rows, links, rigid impacts, isolators, soil, plans and storeys that yield.
#[test]
fn run_with_its_histories_agrees_with_sweep_to_the_last_bit() {
    let examples = [
        "three_storey_pair",
        "row_of_five",
        "linked_pair",
        "rigid_impacts",
        "isolated_building",
        "soil_pair",
        "pair_that_turns",
        "yielding_pair",
    ];
    for example in examples {
        let case = root().join("examples").join(example).join("case.toml");
        let case = case.to_str().unwrap();
        let bench = Bench::new(&format!(
            "case = \"{case}\"\n[[variable]]\npath = \"gap.0.width\"\nrelative = true\nvalues = [1]\n"
        ));
        let told = bench.text(&format!("run {case} -o run.h5 --json"));
        let mut of_run = HashSet::new();
        numbers(&serde_json::from_str(&told).unwrap(), &mut of_run);
        bench.text("sweep study.toml -o out.h5 --csv out.csv");
        let mut reader = csv::Reader::from_path(bench.path("out.csv")).unwrap();
        let header = reader.headers().unwrap().clone();
        let row = reader.records().next().unwrap().unwrap();
        let columns = header.iter().zip(row.iter());
        let of_sweep: Vec<(&str, f64)> = columns
            .filter(|(name, _)| !["run", "run_id"].contains(name))
            .filter_map(|(name, text)| Some((name, text.parse().ok()?)))
            .collect();
        assert!(of_sweep.len() > 30, "{example}: {header:?}");
        for (name, x) in of_sweep.iter().skip(1) {
            let same = of_run.contains(&(x + 0.0).to_bits());
            assert!(same, "{example}, {name}: {x}");
        }
    }
}

/// The shown case says how to make its record; with it, `run` gives the numbers of the run.
#[test]
fn a_shown_case_is_repeated_by_run() {
    let bench = Bench::new(MADE);
    // Which is for the record of the case, not for motions that are made.
    let case = String::from_utf8(bench.bytes("case.toml")).unwrap();
    let process = "[ground_motion]\nprocess = [{ scale = 3 }, { pad = { before = \"1 s\" } }]";
    std::fs::write(
        bench.path("case.toml"),
        case.replace("[ground_motion]", process),
    )
    .unwrap();
    bench.text("sweep study.toml -o out.h5 --csv out.csv");
    for run in 0..4 {
        let text = bench.text(&format!("sweep study.toml --show {run}"));
        std::fs::write(bench.path("shown.toml"), &text).unwrap();
        let command = text
            .lines()
            .find_map(|l| l.strip_prefix("# pounding "))
            .unwrap();
        let file = format!("seed_{}.csv", 7 + run / 2);
        assert!(command.ends_with(&format!("-o {file}")), "{command}");
        bench.text(command);
        assert_same(
            &displacements(&bench, run),
            &displacements_alone(&bench, "shown.toml"),
            &text,
        );
    }
    // Without an intensity the case's own scale acts, and records are read where they lie.
    bench.study(
        "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\", \"MOTIONS/kobe_1995_jma_ns.csv\"]\n[[variable]]\nname = \"scale\"\npath = \"ground_motion.scale\"\nvalues = [0.7]\n",
    );
    bench.text("sweep study.toml -o records.h5 --csv out.csv");
    for run in 0..2 {
        let text = bench.text(&format!("sweep study.toml --show {run}"));
        std::fs::write(bench.path("shown.toml"), &text).unwrap();
        assert_same(
            &displacements(&bench, run),
            &displacements_alone(&bench, "shown.toml"),
            &text,
        );
    }
}

/// The command that makes the motion of the first run.
fn shown_command(bench: &Bench) -> String {
    let shown = bench.text("sweep study.toml --show 0");
    let mut lines = shown.lines();
    let command = lines.find_map(|l| l.strip_prefix("# pounding "));
    command.unwrap().to_owned()
}

/// A duration that cuts most of a motion off is said of studies as of `motion synth`.
#[test]
fn motions_that_end_early_are_said() {
    let bench = Bench::new(
        "case = \"case.toml\"\n[[variable]]\nsynthetic = { model = \"rezaeian_der_kiureghian_2010\", count = 3, seed = 7, duration = \"4 s\", significant_duration = \"9 s\", middle_time = \"6 s\", middle_frequency = \"3 Hz\" }\n",
    );
    let told = bench.text("sweep study.toml -o out.h5");
    let said = "the duration of 4 s cuts 84.2 % of the expected Arias intensity off";
    assert_eq!(told.matches(said).count(), 1, "{told}");
    let alone = bench.text("motion synth rezaeian_der_kiureghian_2010 --seed 7 --significant-duration 9 --middle-time 6 --middle-frequency 3 --duration 4 -o made.csv");
    assert!(alone.contains(said), "{alone}");
}

/// What a study and `motion synth` leave out is the same: so are their motions.
#[test]
fn a_study_and_synth_make_one_motion() {
    let bench = Bench::new(
        "case = \"case.toml\"\n[[variable]]\nsynthetic = { model = \"rezaeian_der_kiureghian_2010\", count = 1, seed = 7, duration = \"6 s\", significant_duration = \"3 s\", middle_time = \"2 s\", middle_frequency = \"4 Hz\" }\n",
    );
    bench.text("sweep study.toml -o out.h5 --csv out.csv");
    bench.text("motion synth rezaeian_der_kiureghian_2010 --seed 7 --significant-duration 3 --middle-time 2 --middle-frequency 4 --duration 6 -o made.csv");
    let command = shown_command(&bench);
    bench.text(&command);
    assert_eq!(bench.bytes("seed_7.csv"), bench.bytes("made.csv"));
    for (option, other) in [
        ("--arias-intensity", "2"),
        ("--frequency-rate", "-0.2"),
        ("--filter-damping", "0.4"),
        ("--high-pass", "0.1"),
        ("--time-step", "0.02"),
    ] {
        let words: Vec<&str> = command.split_whitespace().collect();
        let at = words.iter().position(|w| *w == option).unwrap();
        let mut words = words.clone();
        words[at + 1] = other;
        bench.text(&words.join(" "));
        assert_ne!(
            bench.bytes("seed_7.csv"),
            bench.bytes("made.csv"),
            "{option}"
        );
    }
    // Circular frequencies are those of the command line, too.
    bench.text("motion synth rezaeian_der_kiureghian_2010 --seed 7 --significant-duration 3 --middle-time 2 --middle-frequency 25.132741228718345rad/s --duration 6 -o turns.csv");
    let study = String::from_utf8(bench.bytes("study.toml")).unwrap();
    bench.study(&study.replace("4 Hz", "25.132741228718345 rad/s"));
    let command = shown_command(&bench);
    bench.text(&command);
    assert_eq!(bench.bytes("seed_7.csv"), bench.bytes("turns.csv"));
}

/// A merged result never takes the place of a shard.
#[test]
fn shards_are_not_merged_onto_themselves() {
    let bench = Bench::new(
        "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nvalues = [0.02, 0.04]\n[output]\nchunk = 1\n",
    );
    for shard in ["1/2", "2/2"] {
        bench.text(&format!(
            "sweep study.toml --shard {shard} -o {}.h5",
            &shard[..1]
        ));
    }
    let before = bench.bytes("1.h5");
    for output in [
        "1.h5",
        "./1.h5",
        "new.h5 --csv 2.h5",
        "new.csv --csv ./new.csv",
    ] {
        let told = bench.complaint(&format!("merge 1.h5 2.h5 -o {output}"), 2);
        assert!(
            told.contains("would take the place of") || told.contains("name the same file"),
            "{told}"
        );
    }
    assert!(bench.bytes("1.h5") == before && !bench.path("new.h5").exists());
    bench.text("merge 1.h5 2.h5 -o whole.h5");
    bench.text("merge 1.h5 2.h5 -o whole.h5");
}
