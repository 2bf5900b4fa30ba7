//! A study that its caller breaks off.
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

use pounding_study::{Progress, Shard, Study, StudyError, SweepOptions, sweep};

fn study(folder: &Path) -> Study {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let root = root.canonicalize().unwrap();
    let case = root.join("examples/sweep_three_storey_pair/case.toml");
    let case = std::fs::read_to_string(case).unwrap();
    let motions = root.join("ground_motions");
    let case = case
        .replace("../../ground_motions", motions.to_str().unwrap())
        .replace("31 s", "2 s");
    std::fs::write(folder.join("case.toml"), case).unwrap();
    let text = "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nfrom = \"5 mm\"\nto = \"60 mm\"\ncount = 200\n";
    Study::parse(text, &folder.join("study.toml")).unwrap()
}

fn go_on(_: &Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Said once is enough: no more runs are begun, all that finish are stored, the caller is
/// told of it, and the next call makes the rest.
#[test]
fn what_has_finished_is_stored_and_the_rest_made_later() {
    let folder = tempfile::tempdir().unwrap();
    let study = study(folder.path());
    let options = |name: &str| SweepOptions {
        output: folder.path().join(name),
        csv: None,
        threads: 2,
        shard: Shard::WHOLE,
        resume: true,
        // Chunks have 256 runs: nothing is stored but for the interruption.
        store_every: Duration::from_secs(100_000),
        keep_going: false,
        shared: None,
    };
    let (mut broken_off, mut told) = (false, Vec::new());
    let outcome = sweep(&study, &options("broken.h5"), &mut |now| {
        if broken_off {
            told.push(*now);
        }
        if now.made >= 10 && !broken_off {
            broken_off = true;
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    let Err(StudyError::Interrupted { stored, of: 200 }) = outcome else {
        panic!("{outcome:?}");
    };
    // What had finished, and what was in flight or waiting on two threads.
    assert!((10..100).contains(&stored), "{stored}");
    assert!(told.first().is_some_and(|now| now.all_stored()), "{told:?}");
    assert!(told.last().is_some_and(|now| now.stored == stored));
    assert!(!folder.path().join("broken.h5").exists());
    let report = sweep(&study, &options("broken.h5"), &mut go_on).unwrap();
    assert_eq!((report.runs, report.made), (200, 200 - stored));
    sweep(&study, &options("whole.h5"), &mut go_on).unwrap();
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("broken.h5") == bytes("whole.h5"));
}
