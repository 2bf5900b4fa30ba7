//! Responses go to the result file while the run goes on: memory does not grow with the
//! duration, and what stands in the file is what a recorder in memory holds, to the last bit.
use std::path::Path;

use pounding_assembly::{Assembly, assemble_with_record};
use pounding_case::Case;
use pounding_ground_motion::{AccelerationUnit, Accelerogram};
use pounding_results::{RunEnding, RunHead, RunWriter};
use pounding_time_history::{GridRecorder, Outcome, Recorder, run};

/// A pair that never touches, so that impacts take no memory.
const APART: &str = r#"[[building]]
name = "light"
storeys = 3
mass = "25 t"
stiffness = "3.46 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
[[building]]
name = "heavy"
storeys = 3
mass = "1000 t"
stiffness = "2215 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
[[gap]]
between = ["light", "heavy"]
width = "WIDTH"
model = "jankowski_2005"
stiffness = "2.75e9 N/m^1.5"
restitution = 0.65
[ground_motion]
file = "none"
"#;

fn pair(duration: f64, width: &str) -> Assembly {
    let case = Case::parse(&APART.replace("WIDTH", width), Path::new("case.toml")).unwrap();
    let step = 0.02;
    let samples = (duration / step) as usize + 1;
    let wave = |i: usize| 2.0 * (5.0 * step * i as f64).sin();
    let unit = AccelerationUnit::MetrePerSecondSquared;
    let record = Accelerogram::new((0..samples).map(wave).collect(), unit, step).unwrap();
    assemble_with_record(&case, &record).unwrap()
}

fn written(assembly: &Assembly, path: &Path, others: &mut [&mut dyn Recorder]) -> Outcome {
    let head = RunHead {
        title: "",
        case: "",
        version: "test",
        build: "test",
        system: &assembly.system,
        accelerogram: &assembly.accelerogram,
    };
    let writer = RunWriter::begin(path, &head).unwrap();
    let mut writer = GridRecorder::into_sink(assembly.output_step, writer).unwrap();
    let mut recorders: Vec<&mut dyn Recorder> = vec![&mut writer];
    recorders.extend(others.iter_mut().map(|o| &mut **o as &mut dyn Recorder));
    let outcome = run(
        &assembly.system,
        &assembly.options,
        &mut recorders,
        &mut |_| {},
    )
    .unwrap();
    let ending = RunEnding {
        outcome: &outcome,
        isolated: &outcome,
        warnings: &[],
        wall_time: 0.0,
    };
    writer.responses.finish(&ending).unwrap();
    outcome
}

#[test]
fn memory_does_not_grow_with_the_duration() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.h5");
    let memory = |duration: f64| {
        let assembly = pair(duration, "9 m");
        let used = allocation_counter::measure(|| {
            written(&assembly, &path, &mut []);
        });
        let file = hdf5::File::open(&path).unwrap();
        let times = file.dataset("time").unwrap().size();
        assert_eq!(
            times,
            (duration / assembly.output_step).round() as usize + 1
        );
        used.bytes_max as f64
    };
    let (short, long) = (memory(60.0), memory(1200.0));
    assert!(
        long < 1.02 * short,
        "{long} bytes at most, where a run of a twentieth takes {short}"
    );
}

#[test]
fn the_file_holds_what_memory_would() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.h5");
    let assembly = pair(40.0, "20 mm");
    let mut memory = GridRecorder::new(assembly.output_step).unwrap();
    let outcome = written(&assembly, &path, &mut [&mut memory]);
    assert!(outcome.impacts.len() > 10, "{}", outcome.impacts.len());
    let held = memory.responses;
    assert!(held.len() > 2 * 1024, "several blocks: {}", held.len());
    let file = hdf5::File::open(&path).unwrap();
    let read = |name: &str| file.dataset(name).unwrap().read_raw::<f64>().unwrap();
    let same = |name: &str, expected: &[f64]| {
        let found = read(name);
        assert_eq!(found.len(), expected.len(), "{name}");
        let pairs = found.iter().zip(expected);
        assert!(
            pairs.into_iter().all(|(a, b)| a.to_bits() == b.to_bits()),
            "{name}"
        );
    };
    same("time", &held.time);
    same("ground/acceleration", &held.ground_acceleration);
    for (building, floors) in [("light", 0..3), ("heavy", 3..6)] {
        let name = |quantity: &str| format!("building/{building}/{quantity}");
        let rows = |list: &[f64]| held.columns(list, floors.clone());
        same(&name("displacement"), &rows(&held.displacement));
        same(&name("velocity"), &rows(&held.velocity));
        same(
            &name("acceleration_absolute"),
            &rows(&held.acceleration_absolute),
        );
        same(&name("storey_shear"), &rows(&held.storey_shear));
        let drift = read(&name("drift_ratio"));
        for (row, u) in drift.chunks(3).zip(rows(&held.displacement).chunks(3)) {
            let expected = [u[0], u[1] - u[0], u[2] - u[1]].map(|d| d * (1.0 / 3.0));
            assert_eq!(row, expected);
        }
    }
    same("gap/light-heavy/penetration", &held.penetration);
    same("gap/light-heavy/force", &held.force);
    let input: Vec<f64> = held.energy.iter().map(|e| e.input).collect();
    same("energy/input", &input);
    let impacts = file.dataset("gap/light-heavy/impacts").unwrap();
    assert_eq!(impacts.size(), outcome.impacts.len());
}

/// A run that fails, and a writer that is dropped, leave what stood there and nothing else.
#[test]
fn an_unfinished_result_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.h5");
    std::fs::write(&path, "before").unwrap();
    let assembly = pair(60.0, "9 m");
    let head = RunHead {
        title: "",
        case: "",
        version: "test",
        build: "test",
        system: &assembly.system,
        accelerogram: &assembly.accelerogram,
    };
    let writer = RunWriter::begin(&path, &head).unwrap();
    let mut writer = GridRecorder::into_sink(assembly.output_step, writer).unwrap();
    let mut recorders: [&mut dyn Recorder; 1] = [&mut writer];
    run(
        &assembly.system,
        &assembly.options,
        &mut recorders,
        &mut |_| {},
    )
    .unwrap();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    drop(writer);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "before");
}
