//! Names of a system that cannot be groups of a result.
#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use pounding_ground_motion::{AccelerationUnit, Accelerogram};
use pounding_results::{RunEnding, RunHead, RunWriter, run_in_memory, write_run};
use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{GroundAcceleration, History, RunOptions, System, run};

#[test]
fn names_are_looked_at_before_anything_is_written() {
    let samples = vec![0.0, 1.0, 0.0];
    let unit = AccelerationUnit::MetrePerSecondSquared;
    let accelerogram = Accelerogram::new(samples, unit, 0.1).unwrap();
    let building = ShearBuilding::under_gravity(
        "a/b".to_owned(),
        vec![25e3],
        vec![3.46e6],
        vec![3.0],
        Damping::StiffnessProportional { ratio: 0.05 },
        0.0,
    );
    let ground = GroundAcceleration {
        samples: accelerogram.shared_samples(),
        time_step: accelerogram.time_step(),
    };
    let system = System::new(vec![Arc::new(building.unwrap())], ground);
    let outcome = run(&system, &RunOptions::default(), &mut [], &mut |_| {}).unwrap();
    let head = RunHead {
        title: "",
        case: "",
        version: "0",
        build: "test",
        system: &system,
        accelerogram: &accelerogram,
    };
    let ending = RunEnding {
        outcome: &outcome,
        isolated: &outcome,
        warnings: &[],
        wall_time: 0.0,
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.h5");
    let said = "\"a/b\" cannot name a building";
    let error = RunWriter::begin(&path, &head).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains(said), "{error}");
    assert_eq!(error.help(), "give it another name");
    let rows = History::default();
    let error = write_run((&path, None), &head, &rows, &ending).unwrap_err();
    assert!(error.to_string().contains(said), "{error}");
    let error = run_in_memory(&head, &rows, &ending).unwrap_err();
    assert!(error.to_string().contains(said), "{error}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
