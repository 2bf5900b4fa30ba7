//! The result of a study opens in Python.

use std::process::Command;

use super::{Bench, MIXED, root};

/// Runs `tests/python/open_study.py` with the interpreter named by `POUNDING_PYTHON`, as
/// `scripts/test` does. Without it there is no Python to test with.
#[test]
fn a_study_opens_in_python() {
    let peaks = "isolated_demand = true\nisolated_peaks = true";
    let bench = Bench::new(&MIXED.replace("isolated_demand = true", peaks));
    bench.text("sweep study.toml -o out.h5 --csv out.csv");
    let Some(python) = std::env::var_os("POUNDING_PYTHON") else {
        return;
    };
    let output = Command::new(python)
        .arg(root().join("tests/python/open_study.py"))
        .args([bench.path("out.h5"), bench.path("out.csv")])
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}
