//! Accelerations, velocities and displacements of one channel that do not belong together.
use pounding_ground_motion::read_all_bytes;

use crate::common::{COUNT, volumes::csmip_2_of};

/// A sine of 4 Hz with its integrals (cm, s), a change made to it, and what is said of each series.
fn warnings(change: impl Fn(&mut [Vec<f64>; 3])) -> Vec<Vec<String>> {
    let rate = 8.0 * std::f64::consts::PI;
    let fixture = csmip_2_of(COUNT as i64, |_| {
        let of = |f: &dyn Fn(f64) -> f64| (0..COUNT).map(|i| f(rate * 0.01 * i as f64)).collect();
        let mut series = [
            of(&|x| 90.0 * x.sin()),
            of(&|x| -90.0 / rate * x.cos()),
            of(&|x| -90.0 / rate / rate * x.sin()),
        ];
        change(&mut series);
        series
    })
    .remove(0);
    let recording = read_all_bytes("file", &fixture.bytes, &fixture.options).unwrap();
    let warnings = |i: usize| recording.series[i].origin.warnings.clone();
    (0..3).map(warnings).collect()
}

#[test]
fn integrals_that_follow() {
    assert!(warnings(|_| {}).concat().is_empty());
}

/// Rows of eight values exchanged, a sign turned, a digit in a displacement.
#[test]
fn integrals_that_do_not_follow() {
    let exchanged = warnings(|s| {
        let (first, second) = s[0].split_at_mut(8);
        first.swap_with_slice(&mut second[..8]);
    });
    assert!(exchanged[0][0].contains("its acceleration gives"));
    assert!(exchanged[0][0].contains("more steps"), "{exchanged:?}");
    let turned = warnings(|s| s[0][6] = -s[0][6]);
    let expected = "from 0.05 s to 0.06 s the velocity of this channel changes by ";
    assert!(turned[0][0].starts_with(expected), "{turned:?}");
    assert!(turned[0][0].contains("and in one more step"), "{turned:?}");
    assert!(turned[1].is_empty() && turned[2].is_empty());
    let digit = warnings(|s| s[2][12] += 0.1);
    assert!(digit[1][0].contains("its velocity gives"), "{digit:?}");
    assert!(digit[0].is_empty() && digit[2].is_empty());
}

/// Velocities of the opposite sign are those of another component, or of another convention.
#[test]
fn integrals_of_the_opposite_sign() {
    let opposite = warnings(|s| s[1].iter_mut().for_each(|v| *v = -*v));
    assert!(opposite[0][0].contains("more steps"), "{opposite:?}");
}
