//! The traps of event location, each with the code that falls into it.
//!
//! Every test solves a case three times: exactly, by the exponential of the matrix of
//! each mode (`exact`) or in closed form; naively, with the one rule that makes the
//! trap; and with the program, by its default method and by the adaptive pair. It
//! asserts that the naive answer is wrong and that the program's is right.
mod approach_velocity;
mod case;
mod chatter;
mod exact;
mod flight;
mod integrate;
mod peaks;
mod plant;
mod singular_start;
mod sticking;
mod sustained_contact;
mod touching;

use exact::{History, Top};
use pounding_time_history::{Outcome, Peak};

/// A relative distance, of numbers that are not small.
fn near(what: &str, computed: f64, expected: f64, relative: f64) {
    let error = ((computed - expected) / expected).abs();
    let same = computed == expected || error <= relative;
    assert!(same, "{what}: {computed} for {expected}, {error:e}");
}

/// Maximum distance of final displacements over their maximum size (at least 0.01 mm),
/// and of final velocities over theirs (at least 1 mm/s).
fn distance(computed: (&[f64], &[f64]), expected: &[f64]) -> f64 {
    let (u, v) = expected.split_at(expected.len() / 2);
    let far = |a: &[f64], b: &[f64], least: f64| -> f64 {
        let size = b.iter().fold(least, |m: f64, x| m.max(x.abs()));
        let most = a.iter().zip(b).map(|(x, y)| (x - y).abs());
        most.fold(0.0, f64::max) / size
    };
    far(computed.0, u, 1e-5).max(far(computed.1, v, 1e-3))
}

/// How far a naive answer ends from the truth.
fn astray(naive: &History, truth: &History) -> f64 {
    distance(naive.end.split_at(naive.end.len() / 2), &truth.end)
}

fn same_peak(what: &str, computed: Peak, expected: Top, relative: f64) {
    near(what, computed.value, expected.0, relative);
}

/// The program's answer is the truth to `relative`; times to as many seconds.
fn agrees(what: &str, ours: &Outcome, truth: &History, relative: f64) {
    assert!(!truth.gave_up, "{what}");
    assert_eq!(ours.impacts.len(), truth.impacts.len(), "{what}: impacts");
    for (i, (a, b)) in ours.impacts.iter().zip(&truth.impacts).enumerate() {
        let what = format!("{what}: impact {i}");
        assert!(
            (a.time_closed - b.closed).abs() <= relative,
            "{what}: {a:?} {b:?}"
        );
        let same_end = a.time_opened.is_nan() && b.opened.is_nan();
        let near_end = (a.time_opened - b.opened).abs() <= relative;
        assert!(same_end || near_end, "{what}: {a:?} {b:?}");
        assert!(
            (a.approach_velocity - b.approach).abs() <= relative,
            "{what}: {a:?} {b:?}"
        );
    }
    let level = &ours.gaps[0].levels[0];
    assert_eq!(level.sticks, truth.sticks, "{what}: sticks");
    let end = distance((&ours.final_displacement, &ours.final_velocity), &truth.end);
    assert!(end <= relative, "{what}: end {end:e}");
    let storeys = ours.buildings.iter().flat_map(|b| &b.storeys);
    for (i, storey) in storeys.enumerate() {
        same_peak(what, storey.displacement, truth.displacement[i], relative);
        let (drift, height) = (truth.drift[i], 3.0);
        near(what, storey.drift_ratio.value * height, drift.0, relative);
        same_peak(
            what,
            storey.acceleration_absolute,
            truth.acceleration[i],
            relative,
        );
    }
    same_peak(what, level.peak_force, truth.force, relative);
    if truth.penetration.0 > 0.0 {
        same_peak(what, level.peak_penetration, truth.penetration, relative);
    }
}
