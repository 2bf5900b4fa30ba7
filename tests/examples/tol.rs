//! tol
#![allow(clippy::unwrap_used, clippy::print_stdout)]
use pounding_time_history::*;
use verification::*;
fn main() {
    let cases = reference_cases().unwrap();
    for c in ["C2", "C3a"] {
        for m in ["jank", "hertzdamp", "yeli"] {
            let case = &cases.cases[c];
            let r = &case.models[m];
            let s = reference_system(case, m, synthetic_motion().unwrap(), 1.0).unwrap();
            for tol in [1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5] {
                let mut best = f64::MAX;
                let mut o = None;
                for _ in 0..20 {
                    let t = std::time::Instant::now();
                    o = Some(
                        run(
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
                        .unwrap(),
                    );
                    best = best.min(t.elapsed().as_secs_f64());
                }
                let o = o.unwrap();
                let mut u = 0.0_f64;
                let mut f = 0.0_f64;
                let mut k = 0;
                for b in &o.buildings {
                    for p in &b.storeys {
                        u = u.max((p.displacement.value / r.peak_u[k] - 1.0).abs());
                        k += 1;
                    }
                }
                let mut k = 0;
                for g in &o.gaps {
                    for l in &g.levels {
                        f = f.max((l.peak_force.value / r.peak_force[k] - 1.0).abs());
                        k += 1;
                    }
                }
                println!(
                    "{c} {m} {tol:e} {:.3} ms u {u:.1e} F {f:.1e} steps {} rejected {} loc {} ev {}",
                    best * 1e3,
                    o.statistics.steps,
                    o.statistics.rejected,
                    o.statistics.location_steps,
                    o.statistics.evaluations
                );
            }
        }
    }
}
