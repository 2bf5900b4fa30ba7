//! Many runs through one call give what one run after another gives, to the last bit.
use pounding_time_history::{Outcome, RunOptions, System, TimeHistoryError, run, run_many};
use verification::{reference_cases, reference_system, synthetic_motion};

#[test]
fn the_number_of_threads_does_not_matter() {
    let cases = reference_cases().unwrap();
    let options = RunOptions {
        duration: Some(12.0),
        ..RunOptions::default()
    };
    let make = |number: usize| -> Result<System, TimeHistoryError> {
        let (case, model) = [("C2", "kv"), ("C2", "jank"), ("C3a", "hertzdamp")][number % 3];
        let factor = 0.5 + 0.1 * (number / 3) as f64;
        let ground = synthetic_motion().unwrap();
        Ok(reference_system(&cases.cases[case], model, ground, factor).unwrap())
    };
    let alone: Vec<Outcome> = (0..18)
        .map(|n| run(&make(n).unwrap(), &options, &mut [], &mut |_| {}).unwrap())
        .collect();
    assert!(alone.iter().all(|o| !o.impacts.is_empty()));
    for threads in [1, 2, 4] {
        let many = run_many(18, threads, &options, make, |n, outcome| {
            (n, outcome.unwrap())
        });
        for (n, (number, outcome)) in many.iter().enumerate() {
            assert_eq!(n, *number);
            assert_eq!(*outcome, alone[n], "run {n} on {threads} threads");
        }
        assert_eq!(many.len(), 18);
    }
}

/// Systems that share constants give what systems of their own give.
#[test]
fn shared_constants_change_no_bit() {
    let cases = reference_cases().unwrap();
    let system = |scale| {
        let ground = synthetic_motion().unwrap();
        reference_system(&cases.cases["C3a"], "kv", ground, scale).unwrap()
    };
    let first = system(1.0);
    let go = |s: &System| run(s, &RunOptions::default(), &mut [], &mut |_| {}).unwrap();
    let before = go(&first.isolated());
    go(&first);
    assert_eq!(go(&first.isolated()), before);
    assert_eq!(go(&system(1.0)), go(&first));
}

/// A failed run is one result among the others.
#[test]
fn a_failed_run_does_not_end_the_batch() {
    let cases = reference_cases().unwrap();
    let ground = synthetic_motion().unwrap();
    let system = reference_system(&cases.cases["C1"], "kv", ground, 1.0).unwrap();
    let make = |n: usize| match n {
        1 => Err(TimeHistoryError::InitialState {
            reason: "nothing of the kind".to_owned(),
        }),
        _ => Ok(system.clone()),
    };
    let options = RunOptions::default();
    let done = run_many(3, 2, &options, make, |_, outcome| outcome.is_ok());
    assert_eq!(done, [true, false, true]);
}

/// A system without buildings is refused, not integrated.
#[test]
fn a_system_needs_a_building() {
    let ground = synthetic_motion().unwrap();
    let empty = System::new(Vec::new(), ground);
    let options = RunOptions::default();
    let error = run(&empty, &options, &mut [], &mut |_| {}).unwrap_err();
    assert!(error.to_string().contains("at least one"), "{error}");
}
