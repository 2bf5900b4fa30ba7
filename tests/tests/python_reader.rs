//! The result file opens in h5py and xarray with named dimensions, coordinates
//! and units.
#![allow(clippy::unwrap_used)]

use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use pounding_assembly::assemble;
use pounding_case::Case;
use pounding_results::{RunEnding, RunHead, RunWriter};
use pounding_shear_building::{Damping, LateralStiffness, ShearBuilding};
use pounding_time_history::{GridRecorder, GroundAcceleration, Recorder, RunOptions, System, run};

/// Runs `tests/python/open_result.py` with the interpreter named by
/// `POUNDING_PYTHON`, as `scripts/test` does. Without it there is no Python to
/// test with, and only the writing is tested.
#[test]
fn a_result_opens_in_python() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    // A whole run each time, so that two files are two runs.
    let write = |path: &Path| {
        let file = root.join("../examples/three_storey_pair/case.toml");
        // Heights, on which nothing that moves depends, whose plain sum is 9.899999999999999 m.
        let source = std::fs::read_to_string(&file).unwrap();
        let source = source.replace("height = \"3 m\"", "height = \"3300 mm\"");
        let case = Case::parse(&source, &file).unwrap();
        assert_eq!(case.buildings[0].elevations(), [3.3, 6.6, 9.9]);
        let assembly = assemble(&case).unwrap();
        let head = RunHead {
            title: &case.title,
            case: &case.source,
            version: "test",
            build: "test",
            system: &assembly.system,
            accelerogram: &assembly.accelerogram,
        };
        let writer = RunWriter::begin(path, &head).unwrap();
        let mut writer = GridRecorder::into_sink(assembly.output_step, writer).unwrap();
        let mut memory = GridRecorder::new(assembly.output_step).unwrap();
        let mut recorders: [&mut dyn Recorder; 2] = [&mut writer, &mut memory];
        let options = &assembly.options;
        let outcome = run(&assembly.system, options, &mut recorders, &mut |_| {}).unwrap();
        let isolated = run(&assembly.system.isolated(), options, &mut [], &mut |_| {}).unwrap();
        assert_eq!(memory.responses.len(), 3101);
        let warnings = assembly.with_those_of_the_record(&outcome.warnings);
        let ending = RunEnding {
            outcome: &outcome,
            isolated: &isolated,
            warnings: &warnings,
            wall_time: 0.0,
        };
        writer.responses.finish(&ending).unwrap();
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("result.h5");
    write(&path);
    assert_eq!(
        std::fs::read_dir(folder.path()).unwrap().count(),
        1,
        "only the result is left"
    );
    let read = |path: &Path, name: &str| -> Vec<u64> {
        let file = hdf5::File::open(path).unwrap();
        let data = file.dataset(name).unwrap().read_raw::<f64>().unwrap();
        data.iter().map(|x| x.to_bits()).collect()
    };
    let again = folder.path().join("again.h5");
    write(&again);
    for name in [
        "time",
        "building/light/displacement",
        "building/heavy/acceleration_absolute",
        "building/light/peak/storey_shear_time",
        "gap/light-heavy/force",
        "energy/residual",
    ] {
        assert!(
            read(&path, name) == read(&again, name),
            "{name} differs between two runs"
        );
    }
    let Some(python) = std::env::var_os("POUNDING_PYTHON") else {
        return;
    };
    the_documented_check(&python, root, &path);
    opens(&python, &root.join("python/open_result.py"), &path);
    // In this test: another beside it would write while Python runs.
    let path = folder.path().join("wall.h5");
    write_wall(&path);
    opens(&python, &root.join("python/open_base_moment.py"), &path);
}

fn opens(python: &OsStr, script: &Path, result: &Path) {
    let output = Command::new(python).arg(script).arg(result).output();
    let output = output.unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
}

/// The result of a wall, with its stiffness matrix, and of a chain of storeys that does not
/// touch it.
fn write_wall(path: &Path) {
    let motion = Path::new(env!("CARGO_MANIFEST_DIR"));
    let motion = motion.join("../ground_motions/el_centro_1940_ns.csv");
    let record = pounding_ground_motion::read(&motion, &Default::default()).unwrap();
    let (mass, height) = (vec![4.0e4; 4], vec![3.0; 4]);
    let damping = Damping::Modal { ratios: vec![0.05] };
    let matrix = LateralStiffness::cantilever(&height, &[6.0e9; 4], None).unwrap();
    let wall = ShearBuilding::with_stiffness_matrix(
        "wall".to_owned(),
        mass.clone(),
        matrix,
        height.clone(),
        damping.clone(),
        0.0,
    );
    let storeys = vec![3.0e7; 4];
    let chain = ShearBuilding::new("chain".to_owned(), mass, storeys, height, damping);
    let buildings = [wall, chain].map(|b| Arc::new(b.unwrap()));
    let ground = GroundAcceleration {
        samples: record.shared_samples(),
        time_step: record.time_step(),
    };
    let system = System::new(buildings.to_vec(), ground);
    let head = RunHead {
        title: "A wall",
        case: "[[building]]",
        version: "test",
        build: "test",
        system: &system,
        accelerogram: &record,
    };
    let writer = RunWriter::begin(path, &head).unwrap();
    let mut writer = GridRecorder::into_sink(0.01, writer).unwrap();
    let options = RunOptions::default();
    let outcome = run(&system, &options, &mut [&mut writer], &mut |_| {}).unwrap();
    let ending = RunEnding {
        outcome: &outcome,
        isolated: &outcome,
        warnings: &[],
        wall_time: 0.0,
    };
    writer.responses.finish(&ending).unwrap();
}

/// Runs the lines of `docs/reference/result-file.md` that check a file without the program: they take
/// the file as it is, and none in which a bit was changed.
fn the_documented_check(python: &OsStr, root: &Path, result: &Path) {
    let page = std::fs::read_to_string(root.join("../docs/reference/result-file.md")).unwrap();
    let blocks = page.split("```python\n").skip(1);
    let mut blocks = blocks.map(|b| b.split("```").next().unwrap());
    let lines = blocks.find(|b| b.contains("hashlib")).unwrap();
    assert!(lines.contains("three_storey_pair.h5"), "{lines}");
    let folder = tempfile::tempdir().unwrap();
    let whole = std::fs::read(result).unwrap();
    for changed in [None, Some(0), Some(whole.len() / 2), Some(whole.len() - 2)] {
        let mut bytes = whole.clone();
        if let Some(at) = changed {
            bytes[at] ^= 1;
        }
        std::fs::write(folder.path().join("three_storey_pair.h5"), bytes).unwrap();
        let check = Command::new(python)
            .args(["-c", lines])
            .current_dir(folder.path())
            .output();
        assert_eq!(
            check.unwrap().status.success(),
            changed.is_none(),
            "{changed:?}"
        );
    }
}
