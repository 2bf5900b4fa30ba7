//! timing
#![allow(clippy::unwrap_used, clippy::print_stdout)]
use pounding_time_history::*;
use verification::*;
fn main() {
    let cases = reference_cases().unwrap();
    let tol = std::env::args()
        .nth(1)
        .map_or(1e-10, |x| x.parse().unwrap());
    for c in ["C1", "C2", "C3a", "C4"] {
        for m in ["kv", "jank"] {
            let s = reference_system(&cases.cases[c], m, synthetic_motion().unwrap(), 1.0).unwrap();
            let mut best = f64::MAX;
            let mut st = None;
            for _ in 0..(if c == "C4" { 10 } else { 150 }) {
                let t = std::time::Instant::now();
                let o = run(
                    &s,
                    &RunOptions {
                        method: MethodChoice::EventDriven {
                            relative_tolerance: tol,
                        },
                        ..RunOptions::default()
                    },
                    &mut [],
                    &mut |_| {},
                )
                .unwrap();
                best = best.min(t.elapsed().as_secs_f64());
                st = Some(o.statistics);
            }
            println!("{c} {m} {:.3} ms {:?}", best * 1e3, st);
        }
    }
}
