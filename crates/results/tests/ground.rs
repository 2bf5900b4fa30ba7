//! The result of a run says what was read and what was done to it.
#![allow(clippy::unwrap_used)]

use std::path::Path;

use pounding_assembly::assemble;
use pounding_case::Case;
use pounding_results::{RunEnding, RunHead, RunWriter};
use pounding_time_history::run;

const CASE: &str = r#"[[building]]
name = "a"
mass = ["25 t"]
stiffness = "3.46 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
[ground_motion]
file = "sine.txt"
layout = "t,ns"
unit = "m/s2"
component = "ns"
offset = "keep"
process = [{ remove_offset = "mean" }]
"#;

#[test]
fn the_steps_of_processing_stand_in_the_result() {
    let folder = tempfile::tempdir().unwrap();
    let rows: String = (0..400)
        .map(|i| 0.02 * f64::from(i))
        .map(|t| format!("{t:.2} {}\n", 0.05 + (3.0 * t).sin() * t * (8.0 - t) / 16.0))
        .collect();
    std::fs::write(folder.path().join("sine.txt"), rows).unwrap();
    let case = Case::parse(CASE, Path::new(&folder.path().join("case.toml"))).unwrap();
    let assembly = assemble(&case).unwrap();
    let outcome = run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap();
    let path = folder.path().join("r.h5");
    let head = RunHead {
        title: "",
        case: "",
        version: "0",
        build: "test",
        system: &assembly.system,
        accelerogram: &assembly.accelerogram,
    };
    let ending = RunEnding {
        outcome: &outcome,
        isolated: &outcome,
        warnings: &[],
        wall_time: 0.0,
    };
    let writer = RunWriter::begin(&path, &head).unwrap();
    writer.finish(&ending).unwrap();
    let file = hdf5::File::open(&path).unwrap();
    let steps = file.group("ground").unwrap().attr("record").unwrap();
    let steps: hdf5::types::VarLenUnicode = steps.read_scalar().unwrap();
    assert_eq!(steps.as_str(), assembly.accelerogram.echo().join("\n"));
    assert!(steps.contains("offset: offset 0.0"), "{steps}");
}
