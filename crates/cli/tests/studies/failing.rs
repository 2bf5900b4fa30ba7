//! Runs that fail, records that cannot be read, disks that are full.

#[cfg(unix)]
use serde_json::Value;

use super::{Bench, MIXED};

/// Two steps of classical Runge-Kutta, the second far beyond what contact bears.
const DIVERGING: &str = r#"
case = "case.toml"

[[variable]]
name = "step"
path = "analysis.step"
values = ["0.2 ms", "20 ms"]

[[variable]]
name = "gap"
path = "gap.0.width"
from = "10 mm"
to = "50 mm"
count = 5

[output]
chunk = 3
"#;

fn with_method(bench: &Bench) {
    let case = String::from_utf8(bench.bytes("case.toml")).unwrap();
    // A hundred times as stiff: each contact lasts a few milliseconds.
    let case = case.replace("2.75e9", "2.75e12").replace(
        "duration =",
        "method = \"runge_kutta_4\"\nstep = \"0.2 ms\"\nduration =",
    );
    std::fs::write(bench.path("case.toml"), case).unwrap();
}

#[test]
fn a_failing_run_is_recorded_with_its_diagnosis() {
    let bench = Bench::new(DIVERGING);
    with_method(&bench);
    let told = bench.text("sweep study.toml -o out.h5 --csv out.csv");
    assert!(told.contains("10 runs in out.h5; 5 failed"), "{told}");
    assert!(
        told.contains("run 5: the energy ledger does not close"),
        "{told}"
    );
    let mut reader = csv::Reader::from_path(bench.path("out.csv")).unwrap();
    let header = reader.headers().unwrap().clone();
    let column = |name: &str| header.iter().position(|h| h == name).unwrap();
    for (i, row) in reader.records().map(Result::unwrap).enumerate() {
        let failed = i >= 5;
        assert_eq!(
            &row[column("status")],
            if failed { "failed" } else { "complete" }
        );
        assert_eq!(
            row[column("energy_input [J]")].is_empty(),
            failed,
            "run {i}"
        );
        assert_eq!(
            row[column("diagnosis")].contains("energy ledger does not close"),
            failed,
            "run {i}"
        );
        assert!(!row[column("gap [m]")].is_empty() && row[column("run_id")].len() == 32);
    }
    let all: Value =
        serde_json::from_str(&bench.text("sweep study.toml -o out.h5 --json")).unwrap();
    assert_eq!(
        (&all["runs"], &all["failed"]),
        (&Value::from(10), &Value::from(5))
    );
    assert_eq!(all["first_failures"][0]["run"], 5);
    // The printed case of a failed run fails in the same words.
    std::fs::write(
        bench.path("fifth.toml"),
        bench.text("sweep study.toml --show 5"),
    )
    .unwrap();
    let told = bench.complaint("run fifth.toml --no-output", 3);
    assert!(told.contains("the energy ledger does not close"), "{told}");
    // A study in which nothing works is a failure itself.
    bench.study(&DIVERGING.replace("\"0.2 ms\", ", ""));
    let told = bench.complaint("sweep study.toml -o none.h5", 3);
    assert!(told.contains("all 5 runs failed"), "{told}");
    assert!(bench.path("none.h5").exists());
}

#[test]
fn an_unreadable_record_is_told_before_anything_is_run() {
    let bench = Bench::new(MIXED);
    std::fs::copy(
        super::root().join("ground_motions/kobe_1995_jma_ns.csv"),
        bench.path("copy.csv"),
    )
    .unwrap();
    let study = MIXED.replace("MOTIONS/kobe_1995_jma_ns.csv", "copy.csv");
    bench.study(&study);
    bench.text("sweep study.toml -o whole.h5");
    bench.without_its_result("sweep study.toml -o a.h5");
    let good = bench.bytes("copy.csv");
    std::fs::write(bench.path("copy.csv"), "time_s,acceleration_g\n0.00,zero\n").unwrap();
    let told = bench.complaint("sweep study.toml -o a.h5 --resume", 2);
    assert!(told.contains("1 of the 2 records cannot be read"), "{told}");
    assert!(told.contains("copy.csv:2:6"), "{told}");
    // With the record back, nothing was lost.
    std::fs::write(bench.path("copy.csv"), good).unwrap();
    let told = bench.text("sweep study.toml -o a.h5 --resume");
    assert!(
        told.contains("60 of them stored by an earlier call"),
        "{told}"
    );
    assert!(bench.bytes("a.h5") == bench.bytes("whole.h5"));
    // Asked to keep going, the others are made and these recorded.
    std::fs::remove_file(bench.path("copy.csv")).unwrap();
    let told = bench.text("sweep study.toml -o b.h5 --keep-going");
    assert!(
        told.contains("30 failed") && told.contains("cannot read the record"),
        "{told}"
    );
}

/// Without any record no run succeeds; asked to keep going, that is the result.
#[test]
fn all_records_unreadable_are_a_result_of_failures() {
    let variable =
        "[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.1 g\", \"0.2 g\"]\n";
    for (command, more) in [("sweep", ""), ("ida", "[ida]\n")] {
        let study = format!(
            "case = \"case.toml\"\n[[variable]]\nrecords = [\"a.csv\", \"b.csv\"]\n{variable}{more}"
        );
        let bench = Bench::new(&study);
        for name in ["a.csv", "b.csv"] {
            std::fs::write(bench.path(name), "time_s,acceleration_g\n0.00,zero\n").unwrap();
        }
        let call = format!("{command} study.toml -o out.h5");
        let told = bench.complaint(&call, 2);
        assert!(told.contains("2 of the 2 records cannot be read"), "{told}");
        assert!(!told.contains("--keep-going"), "{told}");
        // Not readable, then not there.
        for _ in 0..2 {
            let told = bench.complaint(&format!("{call} --keep-going"), 3);
            assert!(told.contains("all 4 runs failed; run 0: "), "{told}");
            assert!(bench.path("out.h5").exists());
            let output = bench.run(&format!("{call} --keep-going --json"));
            assert_eq!(output.status.code(), Some(3));
            let told: Value = serde_json::from_slice(&output.stdout).unwrap();
            let runs = told.get("sweep").unwrap_or(&told);
            assert_eq!((&runs["runs"], &runs["failed"]), (&4.into(), &4.into()));
            std::fs::remove_file(bench.path("out.h5")).unwrap();
            let _ = std::fs::remove_file(bench.path("a.csv"));
        }
    }
}

/// Shards of which all runs failed are done; the study that is merged of them has failed, as one
/// call would say.
#[test]
fn a_merged_study_of_failures_is_a_failure() {
    let bench =
        Bench::new("case = \"case.toml\"\n[[variable]]\nrecords = [\"a.csv\", \"b.csv\"]\n");
    for name in ["a.csv", "b.csv"] {
        std::fs::write(bench.path(name), "time_s,acceleration_g\n0.00,zero\n").unwrap();
    }
    for shard in ["1/2", "2/2"] {
        let call = format!("sweep study.toml --shard {shard} --into parts --keep-going");
        assert_eq!(bench.run(&call).status.code(), Some(0));
    }
    let told = bench.complaint("merge parts -o out.h5", 3);
    assert!(told.contains("all 2 runs failed"), "{told}");
    let output = bench.run("merge parts -o out.json.h5 --json");
    assert_eq!(output.status.code(), Some(3));
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&told["runs"], &told["failed"]), (&2.into(), &2.into()));
    // Of some shards the rest is not known.
    let parts = std::fs::read_dir(bench.path("parts")).unwrap();
    let mut parts = parts.map(|entry| entry.unwrap().path());
    let second = parts.find(|path| path.to_string_lossy().ends_with(".shard-2-of-2.h5"));
    std::fs::remove_file(second.unwrap()).unwrap();
    let output = bench.run("merge parts -o part.h5 --partial");
    assert_eq!(output.status.code(), Some(0));
}

/// Files that are not there are said at the names that the study gives them, before any run and
/// together with what else is wrong in it.
#[test]
fn a_missing_record_is_told_at_its_place() {
    let table = "{ name = \"kobe\", file = \"kobe.csv\" }";
    let study = MIXED.replace("\"MOTIONS/kobe_1995_jma_ns.csv\"", table);
    let bench = Bench::new(&study);
    let help = "help: correct the name, which is relative to the folder of the study";
    let text = String::from_utf8(bench.bytes("study.toml")).unwrap();
    let mut lines = text.lines().enumerate();
    let place = lines.find_map(|(line, text)| {
        let column = text.find("\"kobe.csv\"")?;
        Some(format!("study.toml:{}:{}", line + 1, column + 1))
    });
    let place = place.unwrap();
    let told = bench.complaint("sweep study.toml -o a.h5", 2);
    for said in [&*place, "record kobe: cannot read ", "kobe.csv: ", help] {
        assert!(told.contains(said), "{said}: {told}");
    }
    assert!(!bench.path("a.h5").exists() && !bench.path("a.h5.parts").exists());
    bench.study(&study.replace("gap.0.width", "gap.0.widht"));
    let told = bench.complaint("sweep study.toml -o a.h5", 2);
    assert!(
        told.contains("record kobe: cannot read ") && told.contains("`widht`"),
        "{told}"
    );
    // A plan is none of a run, and says it.
    bench.study(&study);
    let output = bench.run("sweep study.toml --plan --shards 2");
    let noted = String::from_utf8_lossy(&output.stderr)
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ");
    assert!(
        output.status.success() && noted.contains("record kobe: cannot read "),
        "{noted}"
    );
    // Files of its steps too.
    let target = "{ name = \"kobe\", file = \"MOTIONS/kobe_1995_jma_ns.csv\", process = [{ scale = { target = \"target.csv\", from = 0.2, to = 1 } }] }";
    bench.study(&MIXED.replace("\"MOTIONS/kobe_1995_jma_ns.csv\"", target));
    let told = bench.complaint("sweep study.toml -o a.h5", 2);
    assert!(
        told.contains("record kobe: cannot read its target spectrum"),
        "{told}"
    );
}

#[test]
fn a_full_disk_loses_nothing_that_was_finished() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml -o whole.h5");
    // No room for a chunk.
    let (code, told) = bench.with_limit(1, "sweep study.toml -o full.h5");
    assert_eq!(code, Some(4), "{told}");
    assert!(
        told.contains("cannot store runs in full.h5.parts: File too large"),
        "{told}"
    );
    assert!(told.contains("0 of 60 runs are stored"), "{told}");
    // Room for all chunks, not for the result.
    let (code, told) = bench.with_limit(20, "sweep study.toml -o full.h5 --resume");
    assert_eq!(code, Some(4), "{told}");
    assert!(told.contains("cannot write the result full.h5"), "{told}");
    assert!(!bench.path("full.h5").exists());
    bench.no_part_file();
    let told = bench.text("sweep study.toml -o full.h5 --resume");
    assert!(
        told.contains("60 of them stored by an earlier call"),
        "{told}"
    );
    assert!(bench.bytes("full.h5") == bench.bytes("whole.h5"));
}

/// A table that has no room is said to be the table, with its own option; the runs are stored, and
/// a call that goes on writes it.
#[test]
fn a_table_without_room_loses_no_run() {
    let bench = Bench::new(MIXED);
    let (code, told) = bench.with_limit(20, "sweep study.toml -o full.h5 --csv full.csv");
    assert_eq!(code, Some(4), "{told}");
    for part in [
        "cannot write full.csv, the table of the runs: File too large",
        "name another table with --csv",
        "--resume goes on",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    assert!(!told.contains("-o"), "{told}");
    assert!(!bench.path("full.csv").exists());
    bench.no_part_file();
    bench.text("sweep study.toml -o full.h5 --csv full.csv --resume");
    bench.text("sweep study.toml -o whole.h5 --csv whole.csv");
    assert!(bench.bytes("full.csv") == bench.bytes("whole.csv"));
    let told = bench.complaint("sweep study.toml -o new.h5 --csv nowhere/t.csv", 4);
    assert!(
        told.contains("cannot write nowhere/t.csv, the table of the runs"),
        "{told}"
    );
    assert!(told.contains("name another table with --csv"), "{told}");
    assert!(!bench.path("new.h5.parts").exists());
}
