//! Trap 1 in flight: a brief touch between two looks. No impact may be missed.

use super::case::{Case, Chain, Law, METHODS, restless, steady};
use super::exact::{History, Rules, solve};
use super::{agrees, near};

const SPRING: Law = Law::Spring { k: 2.0e8 };

/// Cases whose samples are far too coarse: stiff single storeys, three storeys, two
/// buildings of one and two storeys.
fn coarse_cases() -> Vec<(String, Case)> {
    let three = |period: f64| {
        let single = Chain::single(2.0e4, period, 0.0);
        Chain {
            mass: vec![2.0e4; 3],
            stiffness: vec![single.stiffness[0]; 3],
            alpha: 0.4,
            beta: 1e-4,
        }
    };
    let mut cases = Vec::new();
    for seed in 0..4 {
        let seed = f64::from(seed);
        for (time_step, period) in [(0.02, 0.05), (0.06, 0.04), (0.12, 0.08), (0.12, 0.3)] {
            let ground = || restless(60, time_step, seed, 1.0);
            let label = |what| format!("{what}, T {period} s, samples {time_step} s, seed {seed}");
            let single = Chain::single(2.0e4, period, 0.02);
            let alone = Case::wall(single.clone(), 0, 1.0, SPRING, ground());
            cases.push((label("one storey"), alone));
            let tall = Case::wall(three(period), 1, 1.0, SPRING, ground());
            cases.push((label("middle of three storeys"), tall));
            let mut two = three(1.7 * period);
            two.mass.truncate(2);
            two.stiffness.truncate(2);
            let pair = Case::pair([single, two], 1.0, SPRING, ground());
            cases.push((label("a pair"), pair));
        }
    }
    cases
}

/// The largest distance that the floors go towards one another, at any time and at samples.
fn reach(case: &Case) -> (f64, f64) {
    let wide = case.with_gap(1.0);
    let top = |rules| {
        let history = solve(&wide, rules);
        assert!(history.impacts.is_empty());
        history.penetration.0 + 1.0
    };
    (top(Rules::EXACT), top(Rules::ends_of_steps(case.time_step)))
}

/// Sampling at the record's step sees no contact at all.
fn blind(label: &str, case: &Case) {
    let naive = solve(case, Rules::ends_of_steps(case.time_step));
    assert!(naive.impacts.is_empty(), "{label}: sampling sees it too");
}

/// Ballistic flight that reaches over the gap by 1e-8 of its height: closure and speed
/// in closed form. Both crossings lie within one of the samples.
#[test]
fn a_parabola_grazes_a_wall() {
    let (speed, pull) = (1.0, 2.0);
    let height = speed * speed / (2.0 * pull);
    let excess = 1e-8 * height;
    let ground = || steady(pull, 10, 0.12);
    let body = |gap| Case::wall(Chain::body(2.0e4), 0, gap, SPRING, ground()).from(&[0.0, speed]);
    let touching = body(height - excess);
    blind("parabola", &touching);
    let approach = (2.0 * pull * excess).sqrt();
    for method in METHODS {
        let (sampled, seen) = touching.run_sampled(method);
        assert!(seen < 0.0, "a sample of the record lies in the contact");
        for outcome in [touching.run(method), sampled] {
            assert_eq!(outcome.impacts.len(), 1, "{method:?}");
            let impact = &outcome.impacts[0];
            let closed = (speed - approach) / pull;
            assert!((impact.time_closed - closed).abs() < 1e-8, "{impact:?}");
            near("approach", impact.approach_velocity, approach, 1e-4);
            near("restitution", impact.achieved_restitution, 1.0, 1e-6);
        }
        let clear = body(height + excess).run(method);
        assert!(clear.impacts.is_empty(), "{method:?}");
    }
}

/// Stiff buildings under coarse records graze by 1e-8 of their way: one impact a hair
/// inside their reach, none a hair outside.
#[test]
fn buildings_that_graze_between_samples() {
    for (label, case) in coarse_cases() {
        let (reach, _) = reach(&case);
        let touching = case.with_gap(reach * (1.0 - 1e-8));
        blind(&label, &touching);
        let truth = solve(&touching, Rules::EXACT);
        assert!(!truth.impacts.is_empty(), "{label}");
        for method in METHODS {
            let (sampled, seen) = touching.run_sampled(method);
            assert!(
                seen < 0.0,
                "{label}: a sample of the record lies in the contact"
            );
            for outcome in [touching.run(method), sampled] {
                assert_eq!(
                    outcome.impacts.len(),
                    truth.impacts.len(),
                    "{label} {method:?}"
                );
                let (a, b) = (&outcome.impacts[0], truth.impacts[0]);
                assert!(
                    (a.time_closed - b.closed).abs() < 1e-6,
                    "{label}: {a:?} {b:?}"
                );
            }
            let clear = case.with_gap(reach * (1.0 + 1e-8));
            assert!(clear.run(method).impacts.is_empty(), "{label} {method:?}");
            let (outcome, _) = clear.run_sampled(method);
            assert!(outcome.impacts.is_empty(), "{label} {method:?}");
        }
    }
}

/// Gaps a little wider than the floors' way at any sample, but narrower than their way
/// between samples: whole impacts, from closure to opening, inside single samples.
#[test]
fn whole_impacts_between_samples() {
    let mut count = 0;
    for (label, case) in coarse_cases() {
        let (reach, sampled) = reach(&case);
        if sampled > 0.995 * reach {
            continue;
        }
        let pounding = case.with_gap(sampled + 0.002 * reach);
        let truth = solve(&pounding, Rules::EXACT);
        let naive = solve(&pounding, Rules::ends_of_steps(case.time_step));
        assert!(naive.impacts.is_empty(), "{label}: sampling sees it too");
        assert!(!truth.impacts.is_empty(), "{label}");
        for method in METHODS {
            agrees(&label, &pounding.run(method), &truth, 1e-7);
            agrees(&label, &pounding.run_sampled(method).0, &truth, 1e-7);
        }
        count += 1;
    }
    assert!(count >= 20, "{count}");
}

fn most_in_one_sample(history: &History, time_step: f64) -> usize {
    let sample = |t: f64| (t / time_step).floor() as usize;
    let within = |i: usize| {
        history
            .impacts
            .iter()
            .filter(move |t| sample(t.closed) == i)
    };
    let last = history.impacts.last().map_or(0, |t| sample(t.closed));
    (0..=last).map(|i| within(i).count()).max().unwrap_or(0)
}

/// A stiff storey that knocks several times within each sample, often at a speed that
/// one look a sample tells nothing of.
#[test]
fn several_impacts_within_a_sample() {
    let chain = Chain::single(2.0e4, 0.05, 0.02);
    for gap in [0.0, 2e-5] {
        let law = Law::KelvinVoigt {
            k: 2.0e9,
            zeta: 0.1,
        };
        let case = Case::wall(chain.clone(), 0, gap, law, restless(50, 0.12, 0.5, 2.0));
        let truth = solve(&case, Rules::EXACT);
        let naive = solve(&case, Rules::ends_of_steps(0.12));
        let most = most_in_one_sample(&truth, 0.12);
        assert!(most > 2, "{most} impacts at most in a sample");
        assert!(2 * naive.impacts.len() < truth.impacts.len(), "{naive:?}");
        for method in METHODS {
            agrees(&format!("gap {gap}"), &case.run(method), &truth, 1e-7);
        }
    }
}
