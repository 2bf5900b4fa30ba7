//! The gap that isolated buildings demand, against an independent integration, other
//! methods, and runs with gaps.
use std::path::Path;
use std::sync::Arc;

use pounding_assembly::assemble;
use pounding_case::Case;
use pounding_time_history::{
    Floor, GroundAcceleration, MethodChoice, Peak, RelativeDisplacement, RunOptions, System,
    isolated_demand, run,
};

/// The three-storey pair of the examples under a record of the repository, with the
/// g of the record (m/s2) and its first value at `lead` time steps after zero.
fn pair(case: &str, gravity: f64, lead: usize) -> (System, RunOptions) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let case = Case::read(&root.join("examples").join(case).join("case.toml")).unwrap();
    let assembly = assemble(&case).unwrap();
    let record = assembly.system.ground();
    let mut samples = vec![0.0; lead];
    samples.extend(record.samples.iter().map(|a| a / 9.80665 * gravity));
    let ground = GroundAcceleration {
        samples: samples.into(),
        time_step: record.time_step,
    };
    let mut system = System::new(assembly.system.buildings().to_vec(), ground);
    let model = Arc::clone(&assembly.system.levels()[0].model);
    let pairs = (0..3).map(|s| {
        let floor = |b| Floor::Storey(b, s);
        (floor(0), floor(1), 0.02, Arc::clone(&model))
    });
    let names = ["light".to_owned(), "heavy".to_owned()];
    system.add_gap("pair", names, pairs.collect()).unwrap();
    (system, assembly.options)
}

fn demand(gravity: f64, lead: usize) -> Vec<Peak> {
    let (system, options) = pair("three_storey_pair", gravity, lead);
    isolated_demand(&system, &options).unwrap().1
}

/// Independent fixed-step RK4 with steps of 1 to 2 us, which is good to four or five
/// digits, with g = 9.81 m/s2 and the first tabulated value one step after zero.
#[test]
fn the_pair_under_el_centro() {
    let peaks = demand(9.81, 1);
    for (peak, expected) in peaks.iter().zip([0.049_472, 0.091_852, 0.117_207]) {
        assert!((peak.value / expected - 1.0).abs() < 2.0e-5, "{peak:?}");
    }
    assert!((peaks[2].time - 5.972).abs() < 1.0e-3, "{:?}", peaks[2]);
}

/// With the standard g and the first value at time zero, as our records are read,
/// displacements shrink by 9.80665 / 9.81 and happen one step of 0.02 s earlier, but
/// for the ramp to the first value: half a step at 0.0063 g starts the light building
/// (5.24 rad/s) with 0.12 mm, of which exp(-0.05 * 5.24 * 6) = 0.2 are left at the
/// peaks, 5e-4 of the smallest of them.
#[test]
fn the_convention_of_the_record_is_a_scale_and_a_shift() {
    let (theirs, ours) = (demand(9.81, 1), demand(9.80665, 0));
    for (a, b) in theirs.iter().zip(&ours) {
        let scale = b.value / a.value - 9.80665 / 9.81;
        assert!(scale.abs() < 5.0e-4, "{a:?} {b:?} {scale:e}");
        assert!((a.time - b.time - 0.02).abs() < 1.0e-3, "{a:?} {b:?}");
    }
}

/// Three methods that share the equations of motion alone: exact steps, the adaptive
/// pair, and fixed steps of fourth order.
#[test]
fn methods_agree() {
    let (system, mut options) = pair("three_storey_pair", 9.80665, 0);
    let (_, exact) = isolated_demand(&system, &options).unwrap();
    for (method, relative) in [
        (
            MethodChoice::Adaptive {
                relative_tolerance: 1.0e-10,
            },
            1.0e-7,
        ),
        (MethodChoice::RungeKutta4 { step: 1.0e-3 }, 1.0e-6),
    ] {
        options.method = method;
        let (_, other) = isolated_demand(&system, &options).unwrap();
        for (a, b) in exact.iter().zip(&other) {
            assert!(
                (b.value / a.value - 1.0).abs() < relative,
                "{method:?} {a:?} {b:?}"
            );
            assert!((b.time - a.time).abs() < 1.0e-5, "{method:?} {a:?} {b:?}");
        }
    }
}

/// A gap of the demanded width is never touched; one a millionth narrower is.
#[test]
fn contact_begins_at_the_demand() {
    let (system, options) = pair("three_storey_pair", 9.80665, 0);
    let (_, demand) = isolated_demand(&system, &options).unwrap();
    for (factor, touched) in [(1.0 + 1.0e-6, false), (1.0 - 1.0e-6, true)] {
        let mut with = system.isolated();
        let pairs = system.levels().iter().zip(&demand).enumerate();
        let pairs = pairs.map(|(s, (level, peak))| {
            let floor = |b| Floor::Storey(b, s);
            let width = peak.value * factor;
            (floor(0), floor(1), width, Arc::clone(&level.model))
        });
        let names = ["light".to_owned(), "heavy".to_owned()];
        with.add_gap("pair", names, pairs.collect()).unwrap();
        let outcome = run(&with, &options, &mut [], &mut |_| {}).unwrap();
        let any = outcome.gaps[0].levels.iter().any(|l| l.impacts > 0);
        assert_eq!(any, touched, "factor {factor}");
    }
}

/// Against a wall on the left of the building the demand is its displacement to the
/// left, and on the right that to the right: together they give the peak.
#[test]
fn walls_on_both_sides() {
    let (system, options) = pair("three_storey_pair", 9.80665, 0);
    let mut walled = system.isolated();
    let model = Arc::clone(&system.levels()[0].model);
    let floor = Floor::Storey(0, 2);
    let wall = Floor::Wall;
    let name = |s: &str| s.to_owned();
    let left = vec![(wall, floor, 0.1, Arc::clone(&model))];
    walled
        .add_gap("a", [name("wall"), name("light")], left)
        .unwrap();
    let right = vec![(floor, wall, 0.1, model)];
    walled
        .add_gap("b", [name("light"), name("wall")], right)
        .unwrap();
    let (alone, demand) = isolated_demand(&walled, &options).unwrap();
    let peak = alone.buildings[0].storeys[2].displacement;
    let greatest = demand.iter().fold(0.0_f64, |m, p| m.max(p.value));
    assert!((greatest / peak.value - 1.0).abs() < 1.0e-9);
    assert!(demand.iter().all(|p| p.value > 0.5 * peak.value));
}

/// A recorder of another system, and a gap of a building with itself, are refused.
#[test]
fn floors_of_another_system_are_refused() {
    let (system, options) = pair("three_storey_pair", 9.80665, 0);
    let small = System::new(system.buildings()[..1].to_vec(), system.ground().clone());
    let mut other = RelativeDisplacement::of_levels(&system);
    let error = run(&small, &options, &mut [&mut other], &mut |_| {}).unwrap_err();
    assert!(error.to_string().contains("same buildings"), "{error}");

    let model = Arc::clone(&system.levels()[0].model);
    let names = || ["light".to_owned(), "heavy".to_owned()];
    let mut own = system.isolated();
    let floors = |a, b| {
        vec![(
            Floor::Storey(0, a),
            Floor::Storey(0, b),
            0.02,
            Arc::clone(&model),
        )]
    };
    for (a, b) in [(0, 0), (0, 2)] {
        let error = own.add_gap("own", names(), floors(a, b)).unwrap_err();
        assert!(error.to_string().contains("both of building 1"), "{error}");
    }
    let across = (Floor::Storey(0, 0), Floor::Storey(1, 0), 0.02, model);
    for tolerance in [f64::NAN, -0.1] {
        let pairs = vec![across.clone()];
        let error = own.add_gap_with_tolerance("own", names(), pairs, tolerance);
        assert!(error.unwrap_err().to_string().contains("tolerance"));
    }
}
