//! Overturning moments at the base in result files of runs and of studies: of buildings with a
//! stiffness matrix, beside a chain of storeys that has none.

use std::path::Path;
use std::sync::Arc;

use hdf5::File;
use pounding_files::checksum::WithoutChecksum;
use pounding_results::study::{
    Axis, Coordinate, Description, Ending, ID, IsolatedQuantities, IsolatedRun, Layout, Part,
    ResultReader, ResultWriter, Row, Value, is_result,
};
use pounding_results::{RunEnding, RunHead, RunWriter, read_all, value};
use pounding_shear_building::{Damping, LateralStiffness, ShearBuilding};
use pounding_time_history::{
    Floor, GridRecorder, Outcome, Peak, Recorder, RunOptions, System, run,
};

use super::condensed_stiffness::model;
use crate::yielding::setup::{el_centro, el_centro_record};

/// A chain of storeys between a wall and a frame.
fn row() -> System {
    let damping = Damping::Modal { ratios: vec![0.04] };
    let dense = |name: &str, mass: f64, stiffness: LateralStiffness| {
        let n = stiffness.floors();
        ShearBuilding::with_stiffness_matrix(
            name.to_owned(),
            vec![mass; n],
            stiffness,
            vec![3.0; n],
            damping.clone(),
            0.0,
        )
    };
    let wall = LateralStiffness::cantilever(&[3.0; 4], &[6.0e9; 4], None).unwrap();
    let frame = LateralStiffness::fishbone(&[3.0; 3], &[2.4e8; 3], &[3.0e8; 3]).unwrap();
    let chain = ShearBuilding::new(
        "chain".to_owned(),
        vec![2.5e4; 3],
        vec![3.46e6; 3],
        vec![3.0; 3],
        damping.clone(),
    );
    let buildings = [
        dense("wall", 4.0e4, wall),
        chain,
        dense("frame", 6.0e4, frame),
    ];
    let buildings = buildings.map(|b| Arc::new(b.unwrap()));
    let mut system = System::new(buildings.to_vec(), el_centro());
    for (left, names) in [["wall", "chain"], ["chain", "frame"]]
        .into_iter()
        .enumerate()
    {
        let level = |i| {
            (
                Floor::Storey(left, i),
                Floor::Storey(left + 1, i),
                0.012,
                model(),
            )
        };
        let name = names.join("-");
        let names = names.map(str::to_owned);
        system
            .add_gap(&name, names, (0..3).map(level).collect())
            .unwrap();
    }
    system
}

/// Outcomes with gaps and without, and the responses, of a run that is written to a file.
fn written(path: &Path) -> (System, [Outcome; 2], GridRecorder) {
    let system = row();
    let record = el_centro_record();
    let head = RunHead {
        title: "A row",
        case: "[[building]]",
        version: "test",
        build: "test",
        system: &system,
        accelerogram: &record,
    };
    let options = RunOptions {
        duration: Some(12.0),
        ..RunOptions::default()
    };
    let writer = RunWriter::begin(path, &head).unwrap();
    let mut writer = GridRecorder::into_sink(0.01, writer).unwrap();
    let mut memory = GridRecorder::new(0.01).unwrap();
    let mut recorders: [&mut dyn Recorder; 2] = [&mut writer, &mut memory];
    let outcome = run(&system, &options, &mut recorders, &mut |_| {}).unwrap();
    let isolated = run(&system.isolated(), &options, &mut [], &mut |_| {}).unwrap();
    let ending = RunEnding {
        outcome: &outcome,
        isolated: &isolated,
        warnings: &[],
        wall_time: 0.0,
    };
    writer.responses.finish(&ending).unwrap();
    (system, [outcome, isolated], memory)
}

#[test]
fn a_result_file_holds_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("row.h5");
    let (system, [outcome, isolated], memory) = written(&path);
    assert!(outcome.impacts.len() > 1);
    let file = File::open(&path).unwrap();
    // What a file without checksum has to pass.
    read_all(&file).unwrap();
    let history = &memory.responses;
    assert_eq!(history.base_moment.len(), 2 * history.len());
    let mut column = 0;
    for (index, building) in system.buildings().iter().enumerate() {
        let group = file
            .group(&format!("building/{}", building.name()))
            .unwrap();
        let peaks = group.group("peak").unwrap();
        let (with, without) = (&outcome.buildings[index], &isolated.buildings[index]);
        assert_eq!(with.base_moment.is_some(), building.name() != "chain");
        let (Some(with), Some(without)) = (with.base_moment, without.base_moment) else {
            for group in [&group, &peaks] {
                assert!(
                    !group
                        .member_names()
                        .unwrap()
                        .iter()
                        .any(|n| n.contains("moment"))
                );
            }
            continue;
        };
        let number = |name: &str| value::<f64>(&peaks, name).unwrap();
        let of = |prefix: &str| Peak {
            value: number(&format!("{prefix}base_moment")),
            time: number(&format!("{prefix}base_moment_time")),
        };
        assert_eq!((of(""), of("isolated_")), (with, without));
        assert_ne!(with, without);
        let data = group.dataset("base_moment").unwrap();
        let stored = data.read_raw::<f64>().unwrap();
        assert_eq!(stored, history.column(&history.base_moment, column));
        column += 1;
        // Of the restoring forces of the floors in the same sample.
        let first = system.offsets()[index];
        let floors = first..system.offsets()[index + 1];
        let shears = history.columns(&history.storey_shear, floors);
        for (moment, shears) in stored.iter().zip(shears.chunks(building.storeys())) {
            let expected: f64 = shears.iter().map(|v| 3.0 * v).sum();
            assert!(
                (moment - expected).abs() < 1e-9 * with.value,
                "{moment} {expected}"
            );
        }
        let sampled = stored.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(sampled <= with.value * (1.0 + 1e-12) && sampled > 0.98 * with.value);
        for (data, units) in [
            (data, "N m"),
            (peaks.dataset("base_moment").unwrap(), "N m"),
            (peaks.dataset("base_moment_time").unwrap(), "s"),
        ] {
            assert_eq!(pounding_results::text(&data, "units").unwrap(), units);
            let long_name = pounding_results::text(&data, "long_name").unwrap();
            assert!(
                long_name.contains("overturning moment at the base"),
                "{long_name}"
            );
        }
    }
    assert_eq!(column, 2);
}

/// One number a building with a matrix, between the numbers of the run and those that a study
/// asks for.
#[test]
fn a_study_has_a_column_for_each() {
    let system = row();
    let options = RunOptions {
        duration: Some(5.0),
        ..RunOptions::default()
    };
    let outcome = run(&system, &options, &mut [], &mut |_| {}).unwrap();
    let isolated = IsolatedQuantities {
        demand: true,
        peaks: true,
    };
    let layout = Layout::of(&system, isolated, false);
    assert_eq!(layout.buildings, ["wall", "frame"]);
    assert_eq!(layout.width(Axis::Building), 2);
    assert!(is_result("peak_base_moment") && is_result("building"));
    let demand = vec![0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    let without_gaps = run(&system.without_gaps(), &options, &mut [], &mut |_| {}).unwrap();
    let buildings = without_gaps.buildings.into_iter();
    let storeys = buildings.flat_map(|b| b.storeys.into_iter().zip(b.yielding));
    let isolated = IsolatedRun {
        demand: demand.clone(),
        storeys: Some(storeys.collect()),
    };
    let mut values = Vec::new();
    layout.fill(&outcome, &isolated, &mut values);
    assert_eq!(values.len(), layout.columns());
    let moment = |b: usize| outcome.buildings[b].base_moment.unwrap().value;
    assert_eq!(
        values[layout.range("peak_base_moment")],
        [moment(0), moment(2)]
    );
    assert_eq!(values[layout.range("isolated_demand")], demand);
    let mut collapsed = Vec::new();
    layout.fill_collapsed(&isolated, &mut collapsed);
    assert_eq!(collapsed.len(), layout.columns());
    for name in ["isolated_demand", "isolated_peak_drift_ratio"] {
        assert_eq!(collapsed[layout.range(name)], values[layout.range(name)]);
    }
    assert!(
        collapsed[layout.range("peak_base_moment")]
            .iter()
            .all(|x| x.is_nan())
    );

    // Versions before let variables have names that are taken now.
    let coordinates = ["link_level", "peak_opening"].map(|name| Coordinate {
        name: name.to_owned(),
        long_name: name.to_owned(),
        unit: String::new(),
        choices: None,
    });
    let description = Description {
        title: String::new(),
        study_sha256: String::new(),
        study: String::new(),
        case: String::new(),
        records: String::new(),
        version: "test".to_owned(),
        build: "test".to_owned(),
        runs: 2,
        chunk: 2,
        part: Part::whole(),
        warnings: Vec::new(),
        quantities: None,
        float32: false,
        layout: layout.clone(),
        coordinates: coordinates.to_vec(),
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.h5");
    let mut writer = ResultWriter::create(&path, &description, 2).unwrap();
    for run in 0..2 {
        let row = Row {
            run,
            id: [run as u8; ID],
            values: values.iter().map(|x| x * (run + 1) as f64).collect(),
            ending: Ending::Complete,
        };
        writer.push(row, vec![Value::Number(0.5); 2]).unwrap();
    }
    writer.finish().unwrap();
    let reader = ResultReader::open(&path, WithoutChecksum::Refuse).unwrap();
    assert_eq!(reader.description.layout, layout);
    let rows = reader.block(0..2).unwrap();
    for (factor, (row, _)) in [1.0, 2.0].into_iter().zip(&rows) {
        let expected = [factor * moment(0), factor * moment(2)];
        assert_eq!(row.values[layout.range("peak_base_moment")], expected);
    }
    // The layout of buildings that are all chains is that of before.
    let damping = Damping::Modal { ratios: vec![0.05] };
    let chain = ShearBuilding::new("a".into(), vec![1.0e4], vec![1.0e6], vec![3.0], damping);
    let system = System::new(vec![Arc::new(chain.unwrap())], el_centro());
    let names = Layout::of(&system, IsolatedQuantities::default(), false).quantities;
    assert!(names.iter().all(|q| q.axis != Axis::Building));
}

/// Where the isolated buildings could not be run, nothing is made up.
#[test]
fn unknown_peaks_are_unknown() {
    let system = row();
    let options = RunOptions {
        duration: Some(1.0),
        ..RunOptions::default()
    };
    let outcome = run(&system, &options, &mut [], &mut |_| {}).unwrap();
    let unknown = outcome.with_unknown_peaks();
    let moment = |b: usize| unknown.buildings[b].base_moment;
    assert!(moment(0).unwrap().value.is_nan() && moment(1).is_none());
}
