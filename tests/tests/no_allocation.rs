//! Nothing is allocated while a run goes on: not between contacts, not at events, not in
//! contacts, whatever their law.
use pounding_time_history::{RunOptions, run};
use verification::{reference_cases, reference_system, synthetic_motion};

/// Allocations of a run of this duration (s), and its impacts.
fn allocations(case: &str, model: &str, duration: f64) -> (u64, usize) {
    let cases = reference_cases().unwrap();
    let ground = synthetic_motion().unwrap();
    let system = reference_system(&cases.cases[case], model, ground, 1.0).unwrap();
    let options = RunOptions {
        duration: Some(duration),
        ..RunOptions::default()
    };
    // Constants that systems share are made by the first run.
    run(&system, &options, &mut [], &mut |_| {}).unwrap();
    let mut impacts = Vec::new();
    let counted = allocation_counter::measure(|| {
        let outcome = run(&system, &options, &mut [], &mut |_| {}).unwrap();
        impacts = outcome.impacts;
    });
    // Every impact that is handed out brings a list of constants with it.
    let lists = impacts.iter().filter(|i| !i.constants.is_empty()).count();
    (counted.count_total - lists as u64, impacts.len())
}

#[test]
fn a_longer_run_allocates_no_more_than_a_short_one() {
    let models = [
        "linear",
        "kv",
        "kv_cut",
        "mj",
        "hertz",
        "hertzdamp",
        "jank",
        "hunt",
        "fricl",
        "frich",
    ];
    for case in ["C2", "C3a", "C4"] {
        for model in models {
            // Beyond the peak of the motion at 8.755 s: a run that ends before it has a warning more.
            let (short, few) = allocations(case, model, 10.0);
            let (long, many) = allocations(case, model, 30.0);
            assert!(many > few + 20, "{case} {model}: {few} and {many} impacts");
            assert_eq!(short, long, "{case} {model}: allocations");
        }
    }
}
