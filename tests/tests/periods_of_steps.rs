//! What steps of implicit methods do to the period and the height of a free swing, measured in runs, against what the
//! warnings before the run say of it; and steps that are unstable.
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

/// Mean period between the first and the last upward crossing of the place at rest, and the damping (of critical) by
/// which the swings between them become lower.
fn measured(system: &System, method: MethodChoice) -> (f64, f64) {
    let mut recorder = GridRecorder::new(1.0e-3).unwrap();
    run(system, &options(method), &mut [&mut recorder], &mut |_| {}).unwrap();
    let history = recorder.responses;
    let pairs = history.displacement.windows(2).zip(&history.time);
    let crossings: Vec<(usize, f64)> = pairs
        .enumerate()
        .filter(|(_, (u, _))| u[0] < 0.0 && u[1] >= 0.0)
        .map(|(i, (u, time))| (i, time + 1.0e-3 * u[0] / (u[0] - u[1])))
        .collect();
    let swings = crossings.len() - 1;
    assert!(swings > 5, "{swings}");
    let ((first, start), (last, end)) = (crossings[0], crossings[swings]);
    let height = |from: usize, to: usize| {
        let heights = history.displacement[from..to].iter();
        heights.fold(0.0_f64, |most, u| most.max(*u))
    };
    let lower = height(first, crossings[1].0) / height(crossings[swings - 1].0, last);
    let damping = lower.ln() / (2.0 * PI * (swings - 1) as f64);
    ((end - start) / swings as f64, damping)
}

/// What is said of period and damping; nothing is zero.
fn warned(system: &System, method: MethodChoice) -> (f64, f64) {
    let mut said = (0.0, 0.0);
    for warning in Warning::before(system, &options(method)) {
        match warning {
            Warning::LongerPeriod { lengthening, .. } => said.0 = lengthening,
            Warning::AddedDamping { ratio, .. } => said.1 = ratio,
            _ => {}
        }
    }
    said
}

#[test]
fn periods_and_dampings_are_as_is_said() {
    let newmark = |step, beta, gamma| MethodChoice::Newmark { step, beta, gamma };
    let hht = |step, alpha| MethodChoice::HhtAlpha { step, alpha };
    let theta = |step, theta| MethodChoice::MoreauJean { step, theta };
    let step = PERIOD / 11.0;
    for method in [
        newmark(step, 0.25, 0.5),
        newmark(step, 0.3025, 0.6),
        newmark(step, 0.0, 0.5),
        newmark(step, 0.3025, 0.55),
        hht(step, -0.05),
        hht(step, -0.3),
        theta(step, 0.5),
        theta(step, 0.6),
    ] {
        let system = swing(step);
        let ((period, damping), (longer, damped)) =
            (measured(&system, method), warned(&system, method));
        let found = period / PERIOD - 1.0;
        // The next term is of two orders more.
        assert!(
            (found - longer).abs() < 0.1 * found.abs(),
            "{method:?}: {found} {longer}"
        );
        match damped == 0.0 {
            true => assert!(damping.abs() < 0.005, "{method:?}: {damping}"),
            false => assert!(
                (damping - damped).abs() < 0.1 * damped,
                "{method:?}: {damping} {damped}"
            ),
        }
    }
    // Below one per cent nothing is said, and of damping below half a per cent.
    let short = PERIOD / 20.0;
    assert_eq!(warned(&swing(short), newmark(short, 0.25, 0.5)), (0.0, 0.0));
    let short = PERIOD / 70.0;
    assert_eq!(
        warned(&swing(short), newmark(short, 0.3025, 0.6)),
        (0.0, 0.0)
    );
    assert_eq!(warned(&swing(short), theta(short, 0.55)), (0.0, 0.0));
    // What is told, and the step that it names.
    let long = PERIOD / 30.0;
    let warnings = Warning::before(&swing(long), &options(theta(long, 1.0)));
    let mut texts = warnings.iter().map(ToString::to_string);
    let text = texts.find(|t| t.contains("theta")).unwrap();
    assert_eq!(
        text,
        "a: with this theta, steps of 13.3 ms damp its fundamental mode of 0.4 s by 10.5 % of critical beside the damping of the building; use a step of 0.6 ms, or method = \"event_driven\""
    );
}

/// Steps divide the samples of the ground evenly: what is said is of those that are taken, whichever are asked for.
#[test]
fn what_is_said_is_of_the_steps_that_are_taken() {
    // Of samples of 0.08 s the half is taken for all of these.
    let system = swing(0.08);
    let newmark = |step| MethodChoice::Newmark {
        step,
        beta: 0.3025,
        gamma: 0.6,
    };
    let half = newmark(0.04);
    let said = warned(&system, half);
    assert!(said.0 > 0.0 && said.1 > 0.0);
    for step in [0.041, 0.06, 0.079] {
        assert_eq!(warned(&system, newmark(step)), said, "{step}");
        assert_eq!(measured(&system, newmark(step)), measured(&system, half));
    }
    assert!(warned(&system, newmark(0.08)).0 > 2.0 * said.0);
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
