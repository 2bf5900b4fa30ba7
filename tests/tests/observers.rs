//! Observers are served from the steps as they are taken: they change none of them, and what
//! they see is the motion, also between samples and within contacts.
use pounding_time_history::{
    FloorForce, ForceHistory, GridRecorder, History, MethodChoice, Outcome, RelativeDisplacement,
    RunOptions, System, run,
};
use verification::{
    REFERENCE_MODELS, constant_ground, reference_cases, reference_system, single_storey,
    synthetic_motion,
};

/// A grid that is no multiple of the ground motion's time step, so that most of its points lie
/// inside samples, and one that is.
const GRIDS: [f64; 2] = [0.0037, 0.01];
const DURATION: f64 = 12.0;

fn options(method: MethodChoice) -> RunOptions {
    RunOptions {
        method,
        duration: Some(DURATION),
        energy_tolerance: None,
    }
}

fn event_driven() -> RunOptions {
    let relative_tolerance = 1e-10;
    options(MethodChoice::EventDriven { relative_tolerance })
}

fn recorded(system: &System, options: &RunOptions, grid: f64) -> (Outcome, History) {
    let mut recorder = GridRecorder::new(grid).unwrap();
    let mut approach = RelativeDisplacement::of_levels(system);
    let recorders: &mut [&mut dyn pounding_time_history::Recorder] =
        &mut [&mut recorder, &mut approach];
    let outcome = run(system, options, recorders, &mut |_| {}).unwrap();
    // Floors approach as far as the gap and the maximum penetration.
    let levels = outcome.gaps.iter().flat_map(|g| &g.levels);
    for ((seen, level), contact) in approach.peaks().iter().zip(levels).zip(system.levels()) {
        if level.impacts > 0 {
            let expected = contact.width + level.peak_penetration.value;
            let error = (seen.value - expected).abs();
            assert!(error < 1e-9, "approach {} for {expected}", seen.value);
        }
    }
    (outcome, recorder.responses)
}

/// Every number of a run, as text with all its digits.
fn digits(outcome: &Outcome) -> String {
    format!("{outcome:?}")
}

fn for_all(mut check: impl FnMut(&str, &System)) {
    for (name, case) in &reference_cases().unwrap().cases {
        for model in REFERENCE_MODELS {
            let ground = synthetic_motion().unwrap();
            let system = reference_system(case, model, ground, 1.0).unwrap();
            check(&format!("{name} {model}"), &system);
        }
    }
}

/// Every step and every number of a run is the same, bit for bit, with and without observers.
#[test]
fn observers_change_nothing() {
    for_all(|name, system| {
        let alone = run(system, &event_driven(), &mut [], &mut |_| {}).unwrap();
        for grid in GRIDS {
            let (watched, _) = recorded(system, &event_driven(), grid);
            assert_eq!(digits(&alone), digits(&watched), "{name}, grid {grid}");
        }
    });
}

/// What observers of the event-driven method see is what the adaptive pair, which shares the
/// laws alone, computes at a tight tolerance; and the ledger closes at every point.
#[test]
fn observers_see_the_motion() {
    let adaptive = options(MethodChoice::Adaptive {
        relative_tolerance: 1e-12,
    });
    let check = |name: &str, system: &System, grid: f64| {
        let (_, seen) = recorded(system, &event_driven(), grid);
        let (_, expected) = recorded(system, &adaptive, grid);
        assert_eq!(seen.len(), expected.len(), "{name}");
        let bits = |h: &History| h.time.iter().map(|t| t.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&seen), bits(&expected), "{name}");
        // Differences from what is expected, where `part` of the maximum value of the same time
        // and `least` may be missed.
        let near = |what: &str, pick: fn(&History) -> &Vec<f64>, (part, least): (f64, f64)| {
            let (a, b) = (pick(&seen), pick(&expected));
            assert_eq!(a.len(), b.len(), "{what}, {name}");
            let width = a.len() / seen.len();
            for (i, (a, b)) in a.chunks(width).zip(b.chunks(width)).enumerate() {
                let maximum = b.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                for (x, y) in a.iter().zip(b) {
                    let at = seen.time[i];
                    let allowed = part * maximum + least;
                    assert!(
                        (x - y).abs() <= allowed,
                        "{what} {x} for {y}, {name} at {at} s"
                    );
                }
            }
        };
        near("displacement", |h| &h.displacement, (0.0, 1e-8));
        near("velocity", |h| &h.velocity, (0.0, 2e-6));
        near("penetration", |h| &h.penetration, (0.0, 1e-8));
        // Forces of a giganewton per metre, and their sharp ends.
        near("force", |h| &h.force, (1e-4, 1e3));
        near("acceleration", |h| &h.acceleration_absolute, (1e-4, 1e-1));
        near("storey shear", |h| &h.storey_shear, (1e-5, 10.0));
        let input = expected.energy.iter().map(|e| e.input);
        let largest = input.fold(0.0_f64, f64::max);
        let mut worst = 0.0_f64;
        for (a, b) in seen.energy.iter().zip(&expected.energy) {
            worst = worst.max(a.residual.abs() / largest);
            let works = (a.input - b.input).abs().max((a.viscous - b.viscous).abs());
            assert!(works < 1e-7 * largest, "works, {name}");
        }
        // Floors that stick are followed by the pair in the coordinates of the floors.
        let allowed = if name.ends_with("fricl") { 2e-7 } else { 1e-8 };
        assert!(worst < allowed, "residual {worst:e}, {name}");
    };
    for_all(|name, system| {
        for grid in GRIDS {
            check(name, system, grid);
        }
    });
}

/// Where a force jumps at a row, the row has the acceleration and the force of before the jump, whatever round-off the time of
/// the row has beside that of the jump: mass times acceleration and stiffness times displacement are the force in every row.
#[test]
fn rows_at_jumps_of_a_force_are_of_one_side() {
    let (mass, stiffness, force) = (1.0e5, 4.0e7, 1.0e5);
    let methods = [
        MethodChoice::EventDriven {
            relative_tolerance: 1e-10,
        },
        MethodChoice::Adaptive {
            relative_tolerance: 1e-10,
        },
        MethodChoice::Newmark {
            step: 1e-3,
            beta: 0.25,
            gamma: 0.5,
        },
        MethodChoice::RungeKutta4 { step: 1e-3 },
    ];
    for hundredths in [7, 12, 14, 17, 28, 30, 34, 56, 57, 58, 69, 70] {
        let begin = f64::from(hundredths) / 100.0;
        let points: Vec<_> = [(0.0, 0.0), (0.0, force), (1.0, force), (1.0, 0.0)]
            .iter()
            .map(|(time, force)| (begin + time, *force))
            .collect();
        let history = ForceHistory::new(&points, true).unwrap();
        let push = FloorForce {
            building: 0,
            storey: 0,
            history: history.clone(),
            origin: String::new(),
        };
        let building = single_storey("p", mass, stiffness);
        let system = System::new(vec![building], constant_ground(0.0, 2.0));
        let system = system.with_forces(vec![push]).unwrap();
        for method in methods {
            let options = RunOptions {
                method,
                duration: Some(2.0),
                energy_tolerance: None,
            };
            let mut recorder = GridRecorder::new(0.01).unwrap();
            run(&system, &options, &mut [&mut recorder], &mut |_| {}).unwrap();
            let rows = recorder.responses;
            let motion = rows.acceleration_absolute.iter().zip(&rows.displacement);
            for ((a, u), time) in motion.zip(&rows.time) {
                let left = mass * a + stiffness * u - history.before(*time);
                assert!(
                    left.abs() < 1e-3 * force,
                    "{method:?}, {begin} s: {left} N at {time} s"
                );
            }
        }
    }
}
