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

/// Waits until a command is at work on an output: something stands in its part file, or the folder of
/// its runs is there. An empty part file only finds out whether it can be written.
fn at_work(fixture: &Fixture, output: &str, child: &mut Child) {
    let begun = || {
        let entries = std::fs::read_dir(fixture.path("")).unwrap();
        let mut entries = entries.map(|e| e.unwrap());
        entries.any(|entry| {
            let name = entry.file_name().into_string().unwrap();
            let is_part = name.ends_with(".part") && entry.metadata().is_ok_and(|m| m.len() > 0);
            name.starts_with(&format!("{output}.")) && (is_part || name.ends_with(".parts"))
        })
    };
    while !begun() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    assert!(child.try_wait().unwrap().is_none(), "it was done too soon");
}

/// What comes to the default name of a result while it is computed stays, be it the result of a run
/// under the name of a study's, the reverse, that of another case, or another program's; the result
/// stands whole beside it.
#[test]
fn what_came_in_the_meantime_is_not_replaced() {
    let fixture = Fixture::new();
    let case = std::fs::read_to_string(fixture.path("case.toml")).unwrap();
    let long = "duration = \"2 s\"\nmethod = \"runge_kutta_4\"\nstep = \"0.01 ms\"";
    let case = case.replace("duration = \"2 s\"", long);
    std::fs::write(fixture.path("pair.toml"), &case).unwrap();
    std::fs::write(fixture.path("other.toml"), &case).unwrap();
    let study = "case = \"pair.toml\"\n[[variable]]\npath = \"gap.0.width\"\nfrom = \"1 mm\"\nto = \"20 mm\"\ncount = 4\n";
    for folder in ["of_study", "of_run"] {
        std::fs::create_dir(fixture.path(folder)).unwrap();
    }
    std::fs::write(
        fixture.path("of_study/pair.toml"),
        study.replace("pair", "../pair"),
    )
    .unwrap();
    for made in [
        "run pair.toml",
        "sweep of_study/pair.toml",
        "run other.toml",
    ] {
        let words: Vec<&str> = made.split_whitespace().collect();
        let output = fixture.run(&words);
        assert!(output.status.success(), "{made}: {}", message(&output));
        let kept = made.replace([' ', '/'], "_") + ".h5";
        let name = if made.contains("other") {
            "other.h5"
        } else {
            "pair.h5"
        };
        std::fs::rename(fixture.path(name), fixture.path("of_run").join(kept)).unwrap();
    }
    let stored = |name: &str| std::fs::read(fixture.path("of_run").join(name)).unwrap();
    let (run, sweep) = (
        stored("run_pair.toml.h5"),
        stored("sweep_of_study_pair.toml.h5"),
    );
    for (made, comes) in [
        ("sweep of_study/pair.toml", &run),
        ("run pair.toml", &sweep),
        ("run pair.toml", &stored("run_other.toml.h5")),
        ("run pair.toml", &b"another program's".to_vec()),
    ] {
        let mut child = begun(&fixture, made, "TRUE");
        at_work(&fixture, "pair.h5", &mut child);
        std::fs::write(fixture.path("pair.h5"), comes).unwrap();
        let output = child.wait_with_output().unwrap();
        let told = message(&output);
        assert_eq!(output.status.code(), Some(4), "{made}: {told}");
        assert!(
            told.contains("what was to be written there is in pair-2.h5"),
            "{told}"
        );
        assert!(
            std::fs::read(fixture.path("pair.h5")).unwrap() == *comes,
            "{made}"
        );
        assert!(!fixture.path("pair.h5.parts").exists());
        // A run says how long it took.
        let aside = std::fs::read(fixture.path("pair-2.h5")).unwrap();
        assert!(made.starts_with("run") || aside == sweep, "{made}");
        let read = fixture.run(&["report", "pair-2.h5", "-o", "page.html"]);
        assert!(read.status.success(), "{made}: {}", message(&read));
        for name in ["pair.h5", "pair-2.h5"] {
            std::fs::remove_file(fixture.path(name)).unwrap();
        }
    }
    no_part_file(&fixture.path("").canonicalize().unwrap());
}

/// A link from an output to a file that is read, made while the command works, is not followed.
#[cfg(unix)]
#[test]
fn a_link_to_an_input_that_came_in_the_meantime_is_not_followed() {
    let fixture = Fixture::new();
    let study = "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nfrom = \"1 mm\"\nto = \"20 mm\"\ncount = 400\n";
    std::fs::write(fixture.path("widths.toml"), study).unwrap();
    let before = fixture.content();
    for (made, output, aside) in [
        ("sweep widths.toml", "widths.h5", "widths-2.h5"),
        (
            "sweep widths.toml -o new.h5 --csv new.csv",
            "new.h5",
            "new-2.h5",
        ),
    ] {
        let mut child = begun(&fixture, made, "TRUE");
        at_work(&fixture, output, &mut child);
        std::os::unix::fs::symlink("case.toml", fixture.path(output)).unwrap();
        let done = child.wait_with_output().unwrap();
        let told = message(&done);
        assert_eq!(done.status.code(), Some(4), "{made}: {told}");
        assert!(told.contains("would take the place of case.toml"), "{told}");
        assert!(fixture.path(output).is_symlink());
        assert!(fixture.path(aside).is_file());
        std::fs::remove_file(fixture.path(output)).unwrap();
        std::fs::remove_file(fixture.path(aside)).unwrap();
        for (path, bytes) in &before {
            assert!(std::fs::read(path).unwrap() == *bytes, "{}", path.display());
        }
    }
}
