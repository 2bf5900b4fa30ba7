//! Observers are served from the steps as they are taken: they change none of them, and what
//! they see is the motion, also between samples and within contacts.
#![allow(clippy::unwrap_used)]

use pounding_time_history::{
    GridRecorder, MethodChoice, Outcome, RelativeDisplacement, RunOptions, Sample, System, run,
};
use verification::{REFERENCE_MODELS, reference_cases, reference_system, synthetic_motion};

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

fn recorded(system: &System, options: &RunOptions, grid: f64) -> (Outcome, Vec<Sample>) {
    let mut recorder = GridRecorder::new(grid).unwrap();
    let mut approach = RelativeDisplacement::of_levels(system);
    let recorders: &mut [&mut dyn pounding_time_history::Recorder] =
        &mut [&mut recorder, &mut approach];
    let outcome = run(system, options, recorders, &mut |_| {}).unwrap();
    // Floors approach as far as the gap and the greatest penetration.
    let levels = outcome.gaps.iter().flat_map(|g| &g.levels);
    for ((seen, level), contact) in approach.peaks().iter().zip(levels).zip(system.levels()) {
        if level.impacts > 0 {
            let expected = contact.width + level.peak_penetration.value;
            let error = (seen.value - expected).abs();
            assert!(error < 1e-9, "approach {} for {expected}", seen.value);
        }
    }
    (outcome, recorder.samples)
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
    for_all(|name, system| {
        let grid = GRIDS[0];
        let (_, seen) = recorded(system, &event_driven(), grid);
        let (_, expected) = recorded(system, &adaptive, grid);
        assert_eq!(seen.len(), expected.len(), "{name}");
        let largest = expected.iter().fold(0.0_f64, |m, s| m.max(s.energy.input));
        let mut worst = 0.0_f64;
        for (a, b) in seen.iter().zip(&expected) {
            let at = format!("{name} at {} s", b.time);
            assert_eq!(a.time.to_bits(), b.time.to_bits(), "{at}");
            let near = |what: &str, a: &[f64], b: &[f64], allowed: f64| {
                assert_eq!(a.len(), b.len(), "{what}, {at}");
                for (x, y) in a.iter().zip(b) {
                    assert!((x - y).abs() <= allowed, "{what} {x} for {y}, {at}");
                }
            };
            near("displacement", &a.displacement, &b.displacement, 1e-8);
            near("velocity", &a.velocity, &b.velocity, 2e-6);
            near("penetration", &a.penetration, &b.penetration, 1e-8);
            // Forces of a gigapascal per metre, and their sharp ends.
            let force = b.force.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            near("force", &a.force, &b.force, 1e-4 * force + 1e3);
            let shear = b.storey_shear.iter().fold(1.0_f64, |m, f| m.max(f.abs()));
            near(
                "storey shear",
                &a.storey_shear,
                &b.storey_shear,
                1e-5 * shear + 10.0,
            );
            let residual = a.energy.residual.abs() / largest;
            worst = worst.max(residual);
            let (input, viscous) = (
                a.energy.input - b.energy.input,
                a.energy.viscous - b.energy.viscous,
            );
            assert!(
                input.abs().max(viscous.abs()) < 1e-7 * largest,
                "works, {at}"
            );
        }
        // Floors that stick are followed by the pair in the coordinates of the floors.
        let allowed = if name.ends_with("fricl") { 2e-7 } else { 1e-8 };
        assert!(worst < allowed, "residual {worst:e}, {name}");
    });
}
