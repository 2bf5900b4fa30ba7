//! Rows of rigid bodies without a gap between them, each with a speed of its own, against an
//! independent solution: of all sets of pairs that an impulse may act on, the one with impulses
//! that press and floors that part, once more from the speeds that it leaves, until none approach.
use std::sync::Arc;

use pounding_gap_element::{ImpactModel, ModelParameters, registry};
use pounding_time_history::{Floor, Outcome, RunOptions, System, run};
use proptest::prelude::*;
use verification::{constant_ground, single_storey};

fn rigid(restitution: f64) -> Arc<dyn ImpactModel> {
    let parameters = ModelParameters::from_pairs(&[("restitution", restitution)]);
    registry::build("stereomechanical", &parameters)
        .unwrap()
        .into()
}

/// The row, let go with its speeds.
fn go(masses: &[f64], restitutions: &[f64], velocities: &[f64]) -> Outcome {
    let bodies = masses.iter().enumerate();
    let bodies = bodies.map(|(i, m)| single_storey(&i.to_string(), *m, 1.0e-12 * m));
    let mut system = System::new(bodies.collect(), constant_ground(0.0, 0.1));
    for (i, restitution) in restitutions.iter().enumerate() {
        let pair = (
            Floor::Storey(i, 0),
            Floor::Storey(i + 1, 0),
            0.0,
            rigid(*restitution),
        );
        let names = [i.to_string(), (i + 1).to_string()];
        system
            .add_gap(&format!("gap{i}"), names, vec![pair])
            .unwrap();
    }
    let at_rest = vec![0.0; masses.len()];
    let system = system.with_initial_state(&at_rest, velocities).unwrap();
    run(&system, &RunOptions::default(), &mut [], &mut |_| {}).unwrap()
}

/// Solves a small dense system by elimination with pivots.
fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n)
            .max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs()))
            .unwrap();
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            for j in k..n {
                a[i][j] -= factor * a[k][j];
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - known) / a[k][k];
    }
    b
}

/// Speeds and the energy lost at each gap after all impacts of this instant.
fn expected(masses: &[f64], restitutions: &[f64], velocities: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let gaps = restitutions.len();
    let mut velocity = velocities.to_vec();
    let mut lost = vec![0.0; gaps];
    for _ in 0..100_000 {
        let approach: Vec<f64> = (0..gaps).map(|g| velocity[g] - velocity[g + 1]).collect();
        if approach.iter().all(|v| *v <= 1e-12) {
            break;
        }
        // Those at rest are pressed together by the impulses of others.
        let meeting: Vec<usize> = (0..gaps).filter(|g| approach[*g] > -1e-12).collect();
        // How an impulse at one gap changes the approach at another.
        let influence = |a: usize, b: usize| match a.abs_diff(b) {
            0 => 1.0 / masses[a] + 1.0 / masses[a + 1],
            1 => -1.0 / masses[a.max(b)],
            _ => 0.0,
        };
        let found = (0..1_u32 << meeting.len()).find_map(|set| {
            let chosen = meeting.iter().enumerate();
            let chosen: Vec<usize> = chosen
                .filter(|(k, _)| set >> k & 1 == 1)
                .map(|(_, g)| *g)
                .collect();
            let row = |a: &usize| chosen.iter().map(|b| influence(*a, *b)).collect();
            let matrix = chosen.iter().map(row).collect();
            let right = chosen.iter();
            let right = right.map(|g| (1.0 + restitutions[*g]) * approach[*g]);
            let impulses = solve(matrix, right.collect());
            let after = |g: usize| {
                let acts = chosen.iter().zip(&impulses);
                approach[g] - acts.map(|(b, p)| influence(g, *b) * p).sum::<f64>()
            };
            let presses = impulses.iter().all(|p| *p >= 0.0);
            let part = |g: &usize| after(*g) <= -restitutions[*g] * approach[*g] + 1e-12;
            let solution = presses && meeting.iter().all(part);
            let rates: Vec<f64> = (0..gaps).map(after).collect();
            solution.then_some((chosen, impulses, rates))
        });
        let (chosen, impulses, after) = found.unwrap();
        for (g, impulse) in chosen.iter().zip(impulses) {
            lost[*g] += 0.5 * impulse * (approach[*g] + after[*g]);
            velocity[*g] -= impulse / masses[*g];
            velocity[*g + 1] += impulse / masses[*g + 1];
        }
    }
    (velocity, lost)
}

fn energy(masses: &[f64], velocities: &[f64]) -> f64 {
    let bodies = masses.iter().zip(velocities);
    bodies.map(|(m, v)| 0.5 * m * v * v).sum()
}

fn check(masses: &[f64], restitutions: &[f64], velocities: &[f64]) {
    let outcome = go(masses, restitutions, velocities);
    let (velocity, lost) = expected(masses, restitutions, velocities);
    for (computed, expected) in outcome.final_velocity.iter().zip(&velocity) {
        let error = (computed - expected).abs();
        assert!(
            error <= 1e-10,
            "{computed} m/s, not {expected}: {velocity:?}"
        );
    }
    let all = energy(masses, velocities);
    for (g, lost) in lost.iter().enumerate() {
        let impacts = outcome.impacts.iter().filter(|i| i.gap == g);
        let in_table: f64 = impacts.map(|i| i.energy_dissipated).sum();
        let error = (in_table - lost).abs();
        assert!(error <= 1e-9 * all, "gap {g}: {in_table} J, not {lost}");
        assert!(in_table >= -1e-12 * all, "gap {g} gives {in_table} J");
    }
    let in_table: f64 = outcome.impacts.iter().map(|i| i.energy_dissipated).sum();
    let in_ledger = outcome.energy.end.impact;
    assert!((in_table - in_ledger).abs() <= 1e-12 * all);
    assert!((all - energy(masses, &velocity) - in_ledger).abs() <= 1e-9 * all);
}

#[test]
fn floors_that_part_are_thrown_back_by_the_impact_of_others() {
    // The third body stops the second, whose way to the first is nothing:
    // 1 - 1.8 * 11 / 2 = -8.9 m/s, then -8.9 + 1.8 * 8.9 / 2 = -0.89 m/s.
    let outcome = go(&[1000.0; 3], &[0.8; 2], &[0.0, 1.0, -10.0]);
    for (computed, expected) in outcome.final_velocity.iter().zip([-8.01, -0.89, -0.1]) {
        assert!((computed - expected).abs() < 1e-12, "{computed}");
    }
    assert_eq!(outcome.impacts.len(), 2);
    check(&[1000.0; 3], &[0.8; 2], &[0.0, 1.0, -10.0]);
}

#[test]
fn a_body_thrown_to_and_fro_without_a_gap_comes_to_rest() {
    // Its way is 0.98 of the last one each time, and nothing all the while.
    check(&[1000.0, 10.0, 1000.0], &[0.3; 2], &[1.0, 2.0, -1.0]);
}

/// Impulses go to and fro until the last of them are as small as the round-off of speeds.
#[test]
fn the_last_impacts_of_a_row() {
    check(
        &[
            94372.13832733825,
            91228.16906955285,
            7520.010971661393,
            64381.65284194435,
            18211.149046132105,
        ],
        &[
            0.443506037650148,
            0.03651980439819077,
            0.22501218067328332,
            0.5692016213353708,
        ],
        &[
            -0.428876169233658,
            0.9189267153342514,
            2.497439692258705,
            -4.405087919422917,
            -4.855667328884057,
        ],
    );
}

proptest! {
    #[test]
    fn rows_in_touch(
        bodies in prop::collection::vec((1.0e3..1.0e5_f64, -5.0..5.0_f64, 0.01..1.0_f64), 2..6),
    ) {
        let masses: Vec<f64> = bodies.iter().map(|b| b.0).collect();
        let velocities: Vec<f64> = bodies.iter().map(|b| b.1).collect();
        let restitutions: Vec<f64> = bodies[1..].iter().map(|b| b.2).collect();
        check(&masses, &restitutions, &velocities);
    }
}
