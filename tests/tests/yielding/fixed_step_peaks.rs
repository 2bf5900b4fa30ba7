//! Peaks of methods of fixed steps beside histories of the same run at finer times: a peak may stand anywhere
//! in a step, by the equations of motion, and with implicit methods where laws change their branch.

use pounding_hysteresis::LawParameters;
use pounding_time_history::{
    GridRecorder, History, MethodChoice, Outcome, Peak, Recorder, RunOptions, System, run,
};

use std::sync::Arc;

use super::setup::{building, el_centro, newmark, with_gaps, with_links, yielding_pair};

const HHT_ALPHA: fn(f64) -> MethodChoice = |step| MethodChoice::HhtAlpha { step, alpha: -0.1 };

fn recorded(system: &System, method: MethodChoice) -> (Outcome, History) {
    let mut recorder = GridRecorder::new(3.7e-4).unwrap();
    let options = RunOptions {
        method,
        duration: Some(8.0),
        energy_tolerance: Some(1.0),
    };
    let recorders: &mut [&mut dyn Recorder] = &mut [&mut recorder];
    let outcome = run(system, &options, recorders, &mut |_| {}).unwrap();
    (outcome, recorder.responses)
}

/// The largest part by which accelerations of a history exceed their peaks.
fn accelerations_exceed(outcome: &Outcome, history: &History) -> f64 {
    let storeys = outcome.buildings.iter().flat_map(|b| &b.storeys);
    let peaks: Vec<Peak> = storeys.map(|s| s.acceleration_absolute).collect();
    exceeds(&peaks, history, &history.acceleration_absolute)
}

/// Buildings without laws, some of whose periods are as short as seven steps: with Newmark's method the
/// accelerations at the ends of steps lay 1.3 % below those of the history.
#[test]
fn no_acceleration_exceeds_its_peak() {
    let light = building("light", (3, 25.0e3, 2.0e7), None);
    let heavy = building("heavy", (3, 6.0e4, 1.0e8), None);
    let pair = System::new(vec![Arc::new(light), Arc::new(heavy)], el_centro());
    let runge_kutta_4 = |step| MethodChoice::RungeKutta4 { step };
    for (name, system, methods) in [
        (
            "apart",
            pair.clone(),
            [newmark(0.02), HHT_ALPHA(0.02), runge_kutta_4(0.01)],
        ),
        (
            "in contact",
            with_gaps(pair),
            [newmark(2.0e-3), HHT_ALPHA(2.0e-3), runge_kutta_4(1.0e-3)],
        ),
    ] {
        for method in methods {
            let (outcome, history) = recorded(&system, method);
            let worst = accelerations_exceed(&outcome, &history);
            println!("{name} {method:?}: {worst:.1e}");
            assert!(worst < 1.0e-9, "{name} {method:?}: {worst:e}");
        }
    }
}

/// The largest part by which a history exceeds the peaks.
fn exceeds(peaks: &[Peak], history: &History, values: &[f64]) -> f64 {
    let of = |(index, peak): (usize, &Peak)| {
        let column = history.column(values, index);
        let largest = column.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        largest / peak.value - 1.0
    };
    peaks.iter().enumerate().map(of).fold(-1.0, f64::max)
}

#[test]
fn no_history_exceeds_its_peak() {
    let bumper = LawParameters::from_pairs(&[
        ("stiffness", 5.0e8),
        ("yield_force", 1.0e5),
        ("hardening_ratio", 0.02),
        ("gap", 5.0e-3),
    ]);
    let hook = LawParameters::from_pairs(&[
        ("compression_stiffness", 2.0e8),
        ("compression_gap", 5.0e-3),
        ("tension_stiffness", 1.0e8),
        ("tension_gap", 1.0e-2),
    ]);
    let maxwell = LawParameters::from_pairs(&[("stiffness", 5.0e7), ("damping", 2.0e5)]);
    let pair = || yielding_pair("bilinear", el_centro());
    for (name, system) in [
        ("bumpers", with_links(pair(), "elastoplastic_gap", &bumper)),
        ("hooks", with_links(pair(), "gap_hook", &hook)),
        (
            "dampers",
            with_links(with_gaps(pair()), "maxwell", &maxwell),
        ),
        ("storeys", with_gaps(yielding_pair("takeda", el_centro()))),
    ] {
        for method in [
            newmark(0.01),
            newmark(0.02),
            HHT_ALPHA(0.01),
            HHT_ALPHA(0.02),
        ] {
            let (outcome, history) = recorded(&system, method);
            let storeys = || outcome.buildings.iter().flat_map(|b| &b.storeys);
            let shears: Vec<Peak> = storeys().map(|s| s.storey_shear).collect();
            let links = outcome.links.iter().flat_map(|link| &link.levels);
            let forces: Vec<Peak> = links.map(|level| level.force).collect();
            // Elements of storeys stand before those of links.
            let stored = history.element_force.len() / history.len() - forces.len();
            let own = |(index, force): (usize, &f64)| {
                let count = stored + forces.len();
                (index % count >= stored).then_some(*force)
            };
            let by_links: Vec<f64> = history
                .element_force
                .iter()
                .enumerate()
                .filter_map(own)
                .collect();
            for (what, worst) in [
                ("accelerations", accelerations_exceed(&outcome, &history)),
                ("shears", exceeds(&shears, &history, &history.storey_shear)),
                (
                    "forces of links",
                    match forces.is_empty() {
                        true => 0.0,
                        false => exceeds(&forces, &history, &by_links),
                    },
                ),
            ] {
                println!("{name} {method:?}: {what} {worst:.1e}");
                assert!(worst < 1.0e-6, "{name} {method:?}: {what} {worst:e}");
            }
        }
    }
}
