//! What steps of implicit methods do to the period of a free swing, measured in runs, against what the warning
//! before the run says of it; and steps that are unstable.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;
use std::sync::Arc;

use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{
    GridRecorder, GroundAcceleration, MethodChoice, RunOptions, System, TimeHistoryError, Warning,
    run,
};

const PERIOD: f64 = 0.4;
const SWINGS: f64 = 30.0;

/// A single storey without damping, let go.
fn swing(step: f64) -> System {
    let mass = 1.0e5;
    let stiffness = mass * (2.0 * PI / PERIOD).powi(2);
    let undamped = Damping::Rayleigh {
        alpha: 0.0,
        beta: 0.0,
    };
    let (mass, stiffness) = (vec![mass], vec![stiffness]);
    let building = ShearBuilding::new("a".to_owned(), mass, stiffness, vec![3.0], undamped);
    let ground = GroundAcceleration {
        samples: vec![0.0; (SWINGS * PERIOD / step) as usize].into(),
        time_step: step,
    };
    let system = System::new(vec![Arc::new(building.unwrap())], ground);
    system.with_initial_state(&[0.01], &[0.0]).unwrap()
}

fn options(method: MethodChoice) -> RunOptions {
    RunOptions {
        method,
        duration: None,
        energy_tolerance: Some(10.0),
    }
}

/// Mean period between the first and the last upward crossing of the place at rest.
fn measured(system: &System, method: MethodChoice) -> f64 {
    let mut recorder = GridRecorder::new(1.0e-3).unwrap();
    run(system, &options(method), &mut [&mut recorder], &mut |_| {}).unwrap();
    let history = recorder.responses;
    let pairs = history.displacement.windows(2).zip(&history.time);
    let crossings: Vec<f64> = pairs
        .filter(|(u, _)| u[0] < 0.0 && u[1] >= 0.0)
        .map(|(u, time)| time + 1.0e-3 * u[0] / (u[0] - u[1]))
        .collect();
    assert!(crossings.len() > 5, "{}", crossings.len());
    (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64
}

fn warned(system: &System, method: MethodChoice) -> Option<f64> {
    let warnings = Warning::before(system, &options(method));
    warnings.into_iter().find_map(|warning| match warning {
        Warning::LongerPeriod { lengthening, .. } => Some(lengthening),
        _ => None,
    })
}

#[test]
fn periods_are_as_long_as_is_said() {
    let newmark = |step, beta, gamma| MethodChoice::Newmark { step, beta, gamma };
    let hht = |step, alpha| MethodChoice::HhtAlpha { step, alpha };
    let step = PERIOD / 11.0;
    for method in [
        newmark(step, 0.25, 0.5),
        newmark(step, 0.3025, 0.6),
        newmark(step, 0.0, 0.5),
        hht(step, -0.05),
        hht(step, -0.3),
    ] {
        let system = swing(step);
        let (found, said) = (
            measured(&system, method) / PERIOD - 1.0,
            warned(&system, method),
        );
        let said = said.unwrap_or_default();
        // The next term is of the fourth order.
        assert!(
            (found - said).abs() < 0.05 * found.abs(),
            "{method:?}: {found} {said}"
        );
    }
    // Below one per cent nothing is said.
    let short = PERIOD / 20.0;
    assert_eq!(warned(&swing(short), newmark(short, 0.25, 0.5)), None);
}

/// Central differences are stable up to two over the circular frequency, linear accelerations up to 3.464.
#[test]
fn steps_of_newmark_that_are_unstable() {
    let omega = 2.0 * PI / PERIOD;
    for (beta, limit) in [(0.0, 2.0), (1.0 / 6.0, 12.0_f64.sqrt())] {
        let newmark = |step| MethodChoice::Newmark {
            step,
            beta,
            gamma: 0.5,
        };
        let stable = 0.98 * limit / omega;
        let system = swing(stable);
        let outcome = run(&system, &options(newmark(stable)), &mut [], &mut |_| {}).unwrap();
        let peak = outcome.buildings[0].storeys[0].displacement.value;
        assert!(peak < 0.2, "{beta}: {peak}");
        let unstable = 1.02 * limit / omega;
        let error = run(
            &swing(unstable),
            &options(newmark(unstable)),
            &mut [],
            &mut |_| {},
        )
        .unwrap_err();
        match &error {
            TimeHistoryError::UnstableStep { longest, .. } => {
                assert!((longest * omega / limit - 1.0).abs() < 1e-9, "{longest}");
            }
            other => panic!("{other}"),
        }
        assert!(
            error.to_string().contains("Newmark's method of beta 0"),
            "{error}"
        );
    }
}
