//! cmp
#![allow(clippy::unwrap_used, clippy::print_stdout)]
use pounding_time_history::*;
use verification::*;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let cases = reference_cases().unwrap();
    let s = reference_system(&cases.cases[&a[1]], &a[2], synthetic_motion().unwrap(), 1.0).unwrap();
    let x = run(
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
    let y = run(&s, &RunOptions::default(), &mut [], &mut |_| {}).unwrap();
    for (b, c) in x.buildings.iter().zip(&y.buildings) {
        for (i, (p, q)) in b.storeys.iter().zip(&c.storeys).enumerate() {
            for (n, u, v) in [
                ("u", p.displacement, q.displacement),
                ("d", p.drift_ratio, q.drift_ratio),
                ("V", p.storey_shear, q.storey_shear),
                ("a", p.acceleration_absolute, q.acceleration_absolute),
            ] {
                if (u.value / v.value - 1.0).abs() > 1e-9 || (u.time - v.time).abs() > 1e-6 {
                    println!("{} {i} {n} {:?} {:?}", b.name, u, v);
                }
            }
        }
    }
}
