//! Traps 5 and 6: peaks of displacement inside a sample; peaks of force inside a step
//! and on both sides of a jump.

use super::case::{Case, Chain, Law, METHODS, restless, steady};
use super::exact::{History, Rules, Top, solve};
use super::plant::{Mode, Plant};
use super::{agrees, near};

/// The maximum displacement, velocity known too, of a cubic through the ends of every
/// sample, where one Newton step from the larger end takes it.
fn cubic_peak(case: &Case) -> f64 {
    let plant = Plant::new(case);
    let n = plant.floors;
    let mut y = [&case.start[..], &[0.0, 0.0, 1.0]].concat();
    let mut top: f64 = 0.0;
    for pair in case.ground.windows(2) {
        y[2 * n] = pair[0];
        y[2 * n + 1] = (pair[1] - pair[0]) / case.time_step;
        let end = plant.advance(Mode::Open, &y, case.time_step);
        let h = case.time_step;
        let (p, q, a, b) = (y[0], end[0], y[n] * h, end[n] * h);
        let (c2, c3) = (3.0 * (q - p) - 2.0 * a - b, 2.0 * (p - q) + a + b);
        let cubic = |t: f64| p + t * (a + t * (c2 + t * c3));
        let start: f64 = if p.abs() > q.abs() { 0.0 } else { 1.0 };
        let slope = a + start * (2.0 * c2 + 3.0 * c3 * start);
        let newton = start - slope / (2.0 * c2 + 6.0 * c3 * start);
        top = top.max(cubic(newton.clamp(0.0, 1.0)).abs()).max(q.abs());
        y = end;
    }
    top
}

fn relative(naive: f64, truth: Top) -> f64 {
    (naive / truth.0 - 1.0).abs()
}

/// Buildings with a few samples a period, or a few periods a sample, that meet nothing:
/// what their samples show, and a cubic between them, against the exact motion.
#[test]
fn displacement_peaks_inside_samples() {
    let mut worst: [f64; 3] = [0.0; 3];
    for (time_step, period) in [(0.02, 0.12), (0.02, 0.05), (0.12, 0.5), (0.12, 0.07)] {
        for seed in 0..3 {
            let single = Chain::single(2.0e4, period, 0.02);
            let tall = Chain {
                mass: vec![2.0e4, 1.5e4, 1.0e4],
                stiffness: vec![5.0 * single.stiffness[0]; 3],
                alpha: 0.3,
                beta: 1e-4,
            };
            let ground = || restless(80, time_step, f64::from(seed), 2.0);
            let law = Law::Spring { k: 1.0e8 };
            for chain in [single, tall] {
                let floors = chain.mass.len();
                let case = Case::wall(chain, floors - 1, 1.0, law, ground());
                let truth = solve(&case, Rules::EXACT);
                let naive = solve(&case, Rules::ends_of_steps(time_step));
                for i in 0..floors {
                    let error =
                        |f: fn(&History) -> &Vec<Top>| relative(f(&naive)[i].0, f(&truth)[i]);
                    worst[0] = worst[0].max(error(|h| &h.displacement));
                    worst[1] = worst[1].max(error(|h| &h.acceleration));
                }
                worst[2] = worst[2].max(relative(cubic_peak(&case), truth.displacement[0]));
                let what = format!("T {period} s, samples {time_step} s, seed {seed}");
                for method in METHODS {
                    let (sampled, _) = case.run_sampled(method);
                    for outcome in [case.run(method), sampled] {
                        agrees(&what, &outcome, &truth, 1e-8);
                        let peak = outcome.buildings[0].storeys[0].displacement;
                        assert!((peak.time - truth.displacement[0].1).abs() < 1e-6, "{what}");
                    }
                }
            }
        }
    }
    assert!(
        worst[0] > 0.1 && worst[1] > 0.1 && worst[2] > 1e-3,
        "{worst:?}"
    );
}

const MASS: f64 = 2.0e4;
const STIFFNESS: f64 = 2.0e8;
const SPEED: f64 = 0.5;
/// When the body meets the wall (s).
const CLOSURE: f64 = 0.1;

fn thrown(law: Law) -> Case {
    let body = Chain::body(MASS);
    Case::wall(body, 0, SPEED * CLOSURE, law, steady(0.0, 11, 0.02)).from(&[0.0, SPEED])
}

/// Peaks of force in closed form: inside the contact, at its very start where a dashpot
/// makes the force jump, and before the turning point where friction does. Looks at the
/// ends of seven steps a contact, none of them on the far side of a jump, are off.
#[test]
fn force_peaks_inside_steps_and_at_jumps() {
    let omega = (STIFFNESS / MASS).sqrt();
    let impedance = SPEED * (STIFFNESS * MASS).sqrt();
    let quarter = 0.5 * std::f64::consts::PI / omega;
    let friction: f64 = 0.4;
    let raised = (1.0 + friction).sqrt();
    // Kelvin-Voigt below a ratio of 1/2: F is largest where its own rate is zero.
    let zeta: f64 = 0.2;
    let damped = (1.0 - zeta * zeta).sqrt();
    let angle = (damped * (1.0 - 4.0 * zeta * zeta)).atan2(zeta * (3.0 - 4.0 * zeta * zeta));
    let later = (-zeta * angle / damped).exp();
    let cases = [
        (Law::Spring { k: STIFFNESS }, impedance, quarter),
        (
            Law::KelvinVoigt { k: STIFFNESS, zeta },
            impedance * later,
            angle / (damped * omega),
        ),
        (
            Law::KelvinVoigt {
                k: STIFFNESS,
                zeta: 0.9,
            },
            1.8 * impedance,
            0.0,
        ),
        (
            Law::ApproachOnly {
                k: STIFFNESS,
                zeta: 2.0,
            },
            4.0 * impedance,
            0.0,
        ),
        (
            Law::DryFriction {
                k: STIFFNESS,
                friction,
            },
            impedance * raised,
            quarter / raised,
        ),
    ];
    for (law, force, after) in cases {
        let case = thrown(law);
        let contact = 2.0 * quarter;
        let naive = at_ends_of_steps(law, contact / 7.0);
        let error = (naive / force - 1.0).abs();
        assert!(error > 1e-3, "{law:?}: naive within {error:e}");
        let truth = solve(&case, Rules::EXACT);
        for method in METHODS {
            let (sampled, _) = case.run_sampled(method);
            for outcome in [case.run(method), sampled] {
                agrees(&format!("{law:?}"), &outcome, &truth, 1e-9);
                let peak = outcome.gaps[0].levels[0].peak_force;
                near(&format!("{law:?}"), peak.value, force, 1e-9);
                let time = peak.time - CLOSURE - after;
                assert!(time.abs() < 1e-7, "{law:?}: {time:e} s off");
            }
        }
    }
}

/// The maximum force at the ends of steps (s) of the exact motion, by the law for the
/// velocity there.
fn at_ends_of_steps(law: Law, step: f64) -> f64 {
    let case = thrown(law);
    let plant = Plant::new(&case);
    let mut y = vec![case.gap, SPEED, 0.0, 0.0, 1.0];
    let mut top: f64 = 0.0;
    let mut mode = Mode::Approach;
    loop {
        let mut next = plant.advance(mode, &y, step);
        if mode == Mode::Approach && plant.velocity(&next) < 0.0 {
            // The exact turning point, so that nothing but the look is naive.
            let (mut low, mut high) = (0.0, step);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if plant.velocity(&plant.advance(mode, &y, middle)) > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let turning = plant.advance(mode, &y, low);
            mode = Mode::Restitution;
            next = plant.advance(mode, &turning, step - low);
        }
        if plant.penetration(&next) <= 0.0 {
            return top;
        }
        top = top.max(plant.observed(mode)[3].value(&next));
        y = next;
    }
}
