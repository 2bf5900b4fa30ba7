//! The examples of studies, and their headline numbers.

use serde_json::Value;

use super::{Bench, root};

fn example(name: &str) -> String {
    let path = root().join("examples").join(name).join("study.toml");
    std::fs::read_to_string(path).unwrap()
}

/// The corners and middles of the grid of 10,000 runs: 24 runs with its extremes.
#[test]
fn sweep_of_the_three_storey_pair() {
    let study = example("sweep_three_storey_pair");
    let counts = [
        ("count = 40", "count = 4"),
        ("count = 25", "count = 3"),
        ("count = 10", "count = 2"),
    ];
    let mut reduced = study;
    for (from, to) in counts {
        assert!(reduced.contains(from));
        reduced = reduced.replace(from, to);
    }
    let bench = Bench::new(&reduced);
    let case = String::from_utf8(bench.bytes("case.toml")).unwrap();
    std::fs::write(
        bench.path("case.toml"),
        case.replace("duration = \"6 s\"", "duration = \"31 s\""),
    )
    .unwrap();
    bench.text("sweep study.toml -o out.h5 --csv out.csv");
    let mut reader = csv::Reader::from_path(bench.path("out.csv")).unwrap();
    let header = reader.headers().unwrap().clone();
    let column = |name: &str| header.iter().position(|h| h == name).unwrap();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 24);
    let value = |row: usize, name: &str| rows[row][column(name)].parse::<f64>().unwrap();
    let force = "peak_force: light-heavy 3-3 (9 m | 9 m) [N]";
    let roof = "peak_displacement: light 3 [m]";
    let all = |name: &'static str| (0..24).map(move |r| value(r, name));
    // Headlines of the README; the hardest impact is in the run with the least gap, the
    // highest stiffness and restitution.
    let hardest = all(force).fold(0.0, f64::max);
    assert!((hardest / 6.984e6 - 1.0).abs() < 1e-3, "{hardest}");
    assert_eq!(hardest, value(5, force));
    let farthest = all(roof).fold(0.0, f64::max);
    assert!((farthest / 0.20121 - 1.0).abs() < 1e-3, "{farthest}");
    let alone = value(23, roof);
    assert!((alone / 0.11421 - 1.0).abs() < 1e-3, "{alone}");
    for row in 0..24 {
        let touched = value(row, "impacts: light-heavy 3-3 (9 m | 9 m)") > 0.0;
        assert_eq!(touched, value(row, "gap [m]") < 0.1, "run {row}");
    }
    // The same run by itself, and by another method.
    let case = bench.text("sweep study.toml --show 5");
    std::fs::write(bench.path("fifth.toml"), &case).unwrap();
    let run = |file: &str| -> Value {
        serde_json::from_str(&bench.text(&format!("run {file} --no-output --json"))).unwrap()
    };
    let level = |v: &Value| {
        v["gaps"][0]["levels"][2]["peak_force"]["peak"]
            .as_f64()
            .unwrap()
    };
    let alone = level(&run("fifth.toml"));
    // `run` records responses and therefore steps where a study flies.
    assert!((alone / hardest - 1.0).abs() < 1e-7, "{alone} {hardest}");
    let other = case.replace("[analysis]", "[analysis]\nmethod = \"adaptive\"");
    std::fs::write(bench.path("adaptive.toml"), other).unwrap();
    let independent = level(&run("adaptive.toml"));
    assert!(
        (independent / hardest - 1.0).abs() < 1e-5,
        "{independent} {hardest}"
    );
}

/// The names of the columns and the rows that a command writes into `out.csv`.
fn runs_of(bench: &Bench, command: &str) -> (csv::StringRecord, Vec<csv::StringRecord>) {
    bench.text(command);
    let mut reader = csv::Reader::from_path(bench.path("out.csv")).unwrap();
    let header = reader.headers().unwrap().clone();
    let rows = reader.records().map(Result::unwrap).collect();
    (header, rows)
}

/// The headline of the study of one gap for a whole row. Its run of the widest gap that is hit hardest is
/// that of another method, by itself.
#[test]
fn common_gap_of_the_row() {
    let bench = Bench::new("");
    let study = root().join("examples/row_of_five/common_gap.toml");
    let study = study.display();
    let (header, rows) = runs_of(&bench, &format!("sweep {study} -o out.h5 --csv out.csv"));
    assert_eq!(rows.len(), 30);
    let of = |gap: f64, stiffness: f64| {
        let column = |name: &str| header.iter().position(|h| h == name).unwrap();
        let is = |row: &&csv::StringRecord| {
            let [w, k] = ["gap [m]", "stiffness"].map(|name| row[column(name)].parse::<f64>());
            (w.unwrap(), k.unwrap()) == (gap, stiffness)
        };
        rows.iter().find(is).unwrap()
    };
    let values = |row: &csv::StringRecord, quantity: &str| -> Vec<f64> {
        let of_quantity = header.iter().enumerate();
        let of_quantity = of_quantity.filter(|(_, h)| h.starts_with(&format!("{quantity}: ")));
        let values: Vec<f64> = of_quantity.map(|(i, _)| row[i].parse().unwrap()).collect();
        assert_eq!(values.len(), 24);
        values
    };
    let most = |row, quantity| values(row, quantity).into_iter().fold(0.0, f64::max);
    let close = |x: f64, y: f64| assert!((x / y - 1.0).abs() < 5e-3, "{x} {y}");
    let (narrow, wide) = (of(0.02, 1.0), of(0.1, 1.0));
    let impacts = |row| values(row, "impacts").iter().sum::<f64>();
    assert_eq!((impacts(narrow), impacts(wide)), (206.0, 28.0));
    close(most(narrow, "peak_force"), 15.38e6);
    close(most(wide, "peak_force"), 17.73e6);
    close(most(wide, "isolated_demand"), 0.1946);
    close(most(of(0.1, 0.8), "isolated_demand"), 0.2377);
    // The page says how much of the variance of the greatest force the stiffness explains: that of its means.
    bench.text("report out.h5 -o page.html");
    let page = String::from_utf8(bench.bytes("page.html")).unwrap();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let variance = |values: &[f64]| {
        let squares: Vec<f64> = values.iter().map(|x| (x - mean(values)).powi(2)).collect();
        mean(&squares)
    };
    let forces: Vec<f64> = rows.iter().map(|row| most(row, "peak_force")).collect();
    let of_stiffness = |i: usize| {
        forces
            .iter()
            .skip(i)
            .step_by(5)
            .copied()
            .collect::<Vec<f64>>()
    };
    let means: Vec<f64> = (0..5).map(|i| mean(&of_stiffness(i))).collect();
    let part = 100.0 * variance(&means) / variance(&forces);
    let said = format!("the maximum contact force with stiffness ({part:.0}\u{a0}%)");
    assert!(page.contains(&said), "{said}");
    let number = rows.iter().position(|row| row == wide).unwrap();
    let shown = bench.text(&format!("sweep {study} --show {number}"));
    assert_eq!(shown.matches("width = 1e-1").count(), 4, "{shown}");
    let motions = root().join("ground_motions");
    let shown = shown.replace("../../ground_motions", &motions.display().to_string());
    let other = shown.replace("[analysis]", "[analysis]\nmethod = \"adaptive\"");
    std::fs::write(bench.path("alone.toml"), other).unwrap();
    let alone = bench.text("run alone.toml --no-output --json");
    let alone: Value = serde_json::from_str(&alone).unwrap();
    let gaps = alone["gaps"].as_array().unwrap().iter();
    let levels = gaps.flat_map(|gap| gap["levels"].as_array().unwrap());
    let force = |level: &Value| level["peak_force"]["peak"].as_f64().unwrap();
    let hardest = levels.map(force).fold(0.0, f64::max);
    assert!((hardest / most(wide, "peak_force") - 1.0).abs() < 1e-5);
}

/// The headline of the uncertain pair. Runs in which a gap closes are those whose isolated demand, from runs without
/// gaps, is wider than the gap; a run by itself has what the study has.
#[test]
fn uncertain_pair() {
    let bench = Bench::new("");
    let study = root().join("examples/sweep_three_storey_pair/uncertain.toml");
    let study = study.display();
    let (header, rows) = runs_of(&bench, &format!("sweep {study} -o out.h5 --csv out.csv"));
    assert_eq!(rows.len(), 2000);
    let most = |row: &csv::StringRecord, quantity: &str| {
        let of = header
            .iter()
            .zip(row)
            .filter(|(h, _)| h.starts_with(quantity));
        let values = of.map(|(_, x)| x.parse::<f64>().unwrap());
        values.fold(f64::NEG_INFINITY, f64::max)
    };
    let closes = |row: &&csv::StringRecord| most(row, "impacts: ") > 0.0;
    for row in &rows {
        let demand = most(row, "isolated_demand: ");
        assert_eq!(closes(&row), demand > most(row, "gap [m]"), "{row:?}");
    }
    assert_eq!(rows.iter().filter(closes).count(), 568);
    let mut forces: Vec<f64> = rows
        .iter()
        .filter(closes)
        .map(|row| most(row, "peak_force: "))
        .collect();
    forces.sort_by(f64::total_cmp);
    let close = |x: f64, y: f64| assert!((x / y - 1.0).abs() < 2e-3, "{x} {y}");
    close(0.5 * (forces[283] + forces[284]), 561.1e3);
    let mut demands: Vec<f64> = rows
        .iter()
        .map(|row| most(row, "isolated_demand: "))
        .collect();
    demands.sort_by(f64::total_cmp);
    let wider = demands.iter().filter(|x| **x > 0.119).count();
    assert_eq!(wider, 940);
    close(demands[1899], 0.1527);
    // What the terminal says of them, first by itself, then of the shards that were merged.
    let (hardest, at) = rows.iter().enumerate().filter(|(_, row)| closes(row)).fold(
        (0.0, 0),
        |(most_yet, at), (run, row)| match most(row, "peak_force: ") {
            force if force > most_yet => (force, run),
            _ => (most_yet, at),
        },
    );
    let said = [
        "In 568 runs a gap closes (28.4 %), with up to 5 impacts at a level.".to_owned(),
        format!(
            "The peak contact force is at most {:.0} kN, at light-heavy 3-3 in run {at}.",
            1e-3 * hardest
        ),
    ];
    let told = bench.text(&format!("sweep {study} -o out.h5 --resume"));
    let answer: Value =
        serde_json::from_str(&bench.text(&format!("sweep {study} -o out.h5 --resume --json")))
            .unwrap();
    let answer = &answer["answer"];
    assert_eq!(answer["runs_with_contact"], 568);
    let force = &answer["maxima"][0];
    assert_eq!(force["quantity"], "peak_force");
    assert_eq!(force["value"].as_f64().unwrap(), hardest);
    assert_eq!(force["run"], at);
    for shard in 1..=2 {
        let part = bench.text(&format!(
            "sweep {study} --shard {shard}/2 -o part{shard}.h5"
        ));
        assert!(!part.contains("a gap closes"), "{part}");
    }
    let merged = bench.text("merge part1.h5 part2.h5 -o merged.h5");
    for said in said {
        assert!(
            told.contains(&said) && merged.contains(&said),
            "{said}\n{told}\n{merged}"
        );
    }
    let shown = bench.text(&format!("sweep {study} --show 4"));
    let motions = root().join("ground_motions");
    let shown = shown.replace("../../ground_motions", &motions.display().to_string());
    std::fs::write(bench.path("alone.toml"), shown).unwrap();
    let alone = bench.text("run alone.toml --no-output --json");
    let alone: Value = serde_json::from_str(&alone).unwrap();
    let storeys = alone["buildings"].as_array().unwrap().iter();
    let storeys = storeys.flat_map(|b| b["storeys"].as_array().unwrap());
    let peak = |storey: &Value| storey["displacement"]["peak"].as_f64().unwrap();
    assert_eq!(
        storeys.map(peak).fold(0.0, f64::max),
        most(&rows[4], "peak_displacement: ")
    );
}

/// Runs a study of the example, with other widths of the gap if there are some, in a folder.
fn fragility(folder: &std::path::Path, name: &str, gaps: Option<String>) -> Value {
    let study = root()
        .join("examples/fragility_three_storey_pair")
        .join(name);
    let mut study = std::fs::read_to_string(study).unwrap();
    let examples = root().join("examples");
    let place = |name: &str| examples.join(name).display().to_string();
    for (from, to) in [
        (
            "../three_storey_pair/case.toml",
            place("three_storey_pair/case.toml"),
        ),
        (
            "hazard.csv",
            place("fragility_three_storey_pair/hazard.csv"),
        ),
    ] {
        assert!(study.contains(from));
        study = study.replace(from, &to);
    }
    if let Some(gaps) = gaps {
        let old = study.lines().find(|l| l.starts_with("gaps = ")).unwrap();
        study = study.replace(old, &format!("gaps = [{gaps}]"));
    }
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let output = super::pounding()
        .current_dir(folder)
        .args(["ida", "study.toml", "--json", "-o", "out.h5", "--resume"])
        .args(["--table", "counts.csv", "--plot", "curves.svg"])
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The same motions on uncertain structures, one for each.
#[test]
fn fragility_of_an_uncertain_pair() {
    let folder = tempfile::tempdir().unwrap();
    let report = fragility(folder.path(), "uncertain.toml", None);
    let number = |v: &Value| v.as_f64().unwrap();
    assert_eq!([&report["records"], &report["structures"]], [40, 40]);
    // Headlines of the README.
    let fit = &report["limits"][0]["fit"];
    assert!((number(&fit["median"]) - 0.8775).abs() < 2e-3, "{fit}");
    assert!((number(&fit["dispersion"]) - 0.2946).abs() < 2e-3, "{fit}");
    let minimum = number(&report["gaps"][0]["minimum"]["width"]);
    assert!((minimum - 0.0885).abs() < 3e-4, "{minimum}");
    let at_40_mm = &report["gaps"][0]["widths"][1];
    assert!(number(&at_40_mm["goodness_of_fit"]["p_value"]) > 0.4);
    assert_eq!(report["sweep"]["runs"], 480);
}

#[test]
fn fragility_of_the_three_storey_pair() {
    let folder = tempfile::tempdir().unwrap();
    let report = fragility(folder.path(), "study.toml", None);
    let number = |v: &Value| v.as_f64().unwrap();
    assert_eq!(report["records"], 40);
    // Headlines of the README.
    let fit = &report["limits"][0]["fit"];
    assert!((number(&fit["median"]) - 0.8685).abs() < 2e-3, "{fit}");
    assert!((number(&fit["dispersion"]) - 0.1455).abs() < 2e-3, "{fit}");
    let minimum = number(&report["gaps"][0]["minimum"]["width"]);
    assert!((minimum - 0.0828).abs() < 3e-4, "{minimum}");
    // Pounding in the runs with gaps is what the isolated buildings say: the first
    // contact of a run happens before pounding has changed anything.
    let at_20_mm = &report["gaps"][0]["widths"][0];
    assert_eq!(at_20_mm["counts"], report["limits"][0]["counts"]);
    // The hazard of the example is a power law far beyond all curves, for which the
    // frequency has a closed form: k0 median^-k exp(k^2 dispersion^2 / 2).
    for width in report["gaps"][0]["widths"].as_array().unwrap() {
        let (median, dispersion) = (
            number(&width["fit"]["median"]),
            number(&width["fit"]["dispersion"]),
        );
        let closed = 2.25e-4
            * (median / 9.80665).powf(-2.2)
            * (0.5 * 2.2_f64.powi(2) * dispersion.powi(2)).exp();
        let found = number(&width["mean_annual_frequency"]);
        assert!((found / closed - 1.0).abs() < 1e-5, "{found} {closed}");
        let bounds = &width["mean_annual_frequency_bounds"];
        assert!(number(&bounds[0]) < found && found < number(&bounds[1]));
        // Two parameters through two or three fractions: nothing is left to test.
        assert!(width["goodness_of_fit"].is_null());
        let remarks = width["remarks"].to_string();
        assert!(remarks.contains("the fit cannot be tested"), "{remarks}");
    }
    let curves = std::fs::read_to_string(folder.path().join("curves.svg")).unwrap();
    assert!(curves.starts_with("<svg") && curves.contains("Mean annual frequency"));
    assert!(curves.contains("40 records, with pounding") && curves.contains("intensity (g)"));
    let table = std::fs::read_to_string(folder.path().join("counts.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 12 * 7);
    // Other widths need no run anew. Right below the least gap the target is missed.
    let report = fragility(
        folder.path(),
        "study.toml",
        Some(format!("{}, {minimum}", minimum - 1e-9)),
    );
    assert_eq!(
        (&report["sweep"]["made"], &report["sweep"]["runs"]),
        (&0.into(), &480.into())
    );
    let frequency = |i: usize| number(&report["gaps"][0]["widths"][i]["mean_annual_frequency"]);
    assert!(
        frequency(0) > 2.1e-3 && frequency(1) <= 2.1e-3,
        "{} {}",
        frequency(0),
        frequency(1)
    );
}
