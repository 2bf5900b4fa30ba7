//! one
#![allow(clippy::unwrap_used, clippy::print_stdout)]
use pounding_time_history::*;
use verification::*;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let cases = reference_cases().unwrap();
    let s = reference_system(&cases.cases[&a[1]], &a[2], synthetic_motion().unwrap(), 1.0).unwrap();
    for _ in 0..a[3].parse::<usize>().unwrap() {
        run(
            &s,
            &RunOptions {
                method: MethodChoice::EventDriven {
                    relative_tolerance: 1e-10,
                },
                ..RunOptions::default()
            },
            &mut [],
            &mut |_| {},
        )
        .unwrap();
    }
}
