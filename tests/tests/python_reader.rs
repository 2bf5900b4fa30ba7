//! The result file opens in h5py and xarray with named dimensions, coordinates
//! and units.
#![allow(clippy::unwrap_used)]

use std::path::Path;
use std::process::Command;

use pounding_case::Case;
use pounding_time_history::{GridRecorder, Recorder, RunRecord, assemble, run, write_result};

/// Runs `tests/python/open_result.py` with the interpreter named by
/// `POUNDING_PYTHON`, as `scripts/test` does. Without it there is no Python to
/// test with, and only the writing is tested.
#[test]
fn a_result_opens_in_python() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let case = Case::read(&root.join("../examples/three_storey_pair/case.toml")).unwrap();
    let assembly = assemble(&case).unwrap();
    let mut recorder = GridRecorder::new(assembly.output_step).unwrap();
    let mut recorders: [&mut dyn Recorder; 1] = [&mut recorder];
    let outcome = run(
        &assembly.system,
        &assembly.options,
        &mut recorders,
        &mut |_| {},
    )
    .unwrap();
    let isolated = run(
        &assembly.system.isolated(),
        &assembly.options,
        &mut [],
        &mut |_| {},
    )
    .unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("result.h5");
    write_result(
        &path,
        &RunRecord {
            title: &case.title,
            case: &case.source,
            version: "test",
            assembly: &assembly,
            outcome: &outcome,
            isolated: &isolated,
            samples: &recorder.samples,
            wall_time: 0.0,
        },
    )
    .unwrap();
    assert_eq!(recorder.samples.len(), 3101);
    assert_eq!(
        std::fs::read_dir(folder.path()).unwrap().count(),
        1,
        "only the result is left"
    );
    let Some(python) = std::env::var_os("POUNDING_PYTHON") else {
        return;
    };
    let output = Command::new(python)
        .arg(root.join("python/open_result.py"))
        .arg(&path)
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}
