//! Two processes that write one file.

use std::process::{Child, Stdio};

use super::fixture::{Fixture, message};
use crate::support::part_files::no_part_file;

fn begun(fixture: &Fixture, words: &str, locking: &str) -> Child {
    fixture
        .command(&words.split_whitespace().collect::<Vec<_>>())
        .env("HDF5_USE_FILE_LOCKING", locking)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Both come to their end, and one whole result stays, whether HDF5 locks files or not.
#[test]
fn two_runs_to_one_output_both_complete() {
    let fixture = Fixture::new();
    let folder = fixture.path("").canonicalize().unwrap();
    let run = "run case.toml -o result.h5 --plot result.svg";
    let alone = fixture.run(&run.split_whitespace().collect::<Vec<_>>());
    assert!(alone.status.success(), "{}", message(&alone));
    let picture = std::fs::read(fixture.path("result.svg")).unwrap();
    for locking in ["TRUE", "FALSE"] {
        for pair in 0..20 {
            // Half of them replace a result, half make a new one.
            if pair % 2 == 0 {
                std::fs::remove_file(fixture.path("result.h5")).unwrap();
            }
            let both = [begun(&fixture, run, locking), begun(&fixture, run, locking)];
            for child in both {
                let output = child.wait_with_output().unwrap();
                let told = message(&output);
                assert_eq!(output.status.code(), Some(0), "{locking} {pair}: {told}");
            }
            let report = fixture.run(&["report", "result.h5"]);
            assert!(
                report.status.success(),
                "{locking} {pair}: {}",
                message(&report)
            );
            assert!(std::fs::read(fixture.path("result.svg")).unwrap() == picture);
            no_part_file(&folder);
        }
    }
}

/// Of two sweeps to one output the second refuses while the first is at work; whatever the
/// order, the whole result stands in the end.
#[test]
fn two_sweeps_to_one_output_leave_one_whole_result() {
    let fixture = Fixture::new();
    let folder = fixture.path("").canonicalize().unwrap();
    let sweep = "sweep study.toml --threads 1 -o result.h5 --csv result.csv";
    let alone = fixture.run(&sweep.split_whitespace().collect::<Vec<_>>());
    assert!(alone.status.success(), "{}", message(&alone));
    let whole = std::fs::read(fixture.path("result.h5")).unwrap();
    let table = std::fs::read(fixture.path("result.csv")).unwrap();
    for locking in ["TRUE", "FALSE"] {
        for pair in 0..20 {
            if pair % 2 == 0 {
                std::fs::remove_file(fixture.path("result.h5")).unwrap();
            }
            let both = [
                begun(&fixture, sweep, locking),
                begun(&fixture, sweep, locking),
            ];
            let mut done = 0;
            for child in both {
                let output = child.wait_with_output().unwrap();
                let told = message(&output);
                match output.status.code() {
                    Some(0) => done += 1,
                    Some(2) => assert!(
                        told.contains("another process is working") || told.contains("--resume"),
                        "{told}"
                    ),
                    other => panic!("{locking} {pair}: {other:?}: {told}"),
                }
            }
            assert!(done > 0, "{locking} {pair}");
            assert!(std::fs::read(fixture.path("result.h5")).unwrap() == whole);
            assert!(std::fs::read(fixture.path("result.csv")).unwrap() == table);
            assert!(!fixture.path("result.h5.parts").exists());
            no_part_file(&folder);
        }
    }
}
