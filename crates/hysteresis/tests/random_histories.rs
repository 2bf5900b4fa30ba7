//! Properties of every law on random histories.
#![allow(clippy::unwrap_used)]

use crate::common::example;
use pounding_hysteresis::laboratory::history;
use pounding_hysteresis::{LawDescriptor, descriptors};
use proptest::prelude::*;

/// Energy (J) that an element may give back beyond what it was given, each time that its
/// motion turns: none, but of the friction pendulum, whose published law builds its force up
/// with one coefficient of friction and takes it down with another.
fn given_back_at_a_turning(descriptor: &LawDescriptor) -> f64 {
    if descriptor.name != "friction_pendulum" {
        return 0.0;
    }
    let example = |name| {
        let mut parameters = descriptor.example.iter();
        parameters.find(|(n, _)| *n == name).unwrap().1
    };
    let spread = example("friction_fast") - example("friction_slow");
    0.5 * spread * example("weight") * example("yield_displacement")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// No element gives back more than it was given, whatever happens to it (the friction
    /// pendulum by no more than its traps say), and the force stays finite.
    #[test]
    fn work_is_never_negative(shares in prop::collection::vec(-2.0..2.0_f64, 1..60)) {
        for descriptor in descriptors() {
            let law = example(descriptor);
            let mut committed = law.virgin();
            let mut candidate = committed.clone();
            let mut maximum = 0.0_f64;
            let (mut from, mut direction, mut turnings) = (0.0, 1.0, 0.0);
            for share in &shares {
                let x = share * descriptor.example_amplitude;
                let end = pounding_hysteresis::Motion {
                    deformation: x,
                    velocity: (x - from) / 0.1,
                };
                let force = law.trial(&committed, &mut candidate, end, 0.1).force;
                committed.commit(&mut candidate);
                let variables = committed.variables();
                let stored = law.stored_energy(&committed, end, variables);
                let dissipated = law.dissipated_energy(&committed, end, variables);
                maximum = maximum.max((force * (x - from)).abs());
                if direction * (x - from) < 0.0 {
                    (direction, turnings) = (-direction, turnings + 1.0);
                }
                prop_assert!(force.is_finite() && stored.is_finite(), "{}", descriptor.name);
                // The mean of two damper forces is not its work over a long step.
                if descriptor.name != "viscous_damper" {
                    let least = -1e-11 * maximum;
                    let least_work = least - turnings * given_back_at_a_turning(descriptor);
                    prop_assert!(stored + dissipated >= least_work, "{}: {}", descriptor.name, stored + dissipated);
                    prop_assert!(stored >= least, "{}: {}", descriptor.name, stored);
                }
                from = x;
            }
        }
    }

    /// A rate-independent law does not notice where steps are cut.
    #[test]
    fn cut_steps_make_no_difference(
        shares in prop::collection::vec(-1.5..1.5_f64, 1..40),
        cut in 0.01..0.99_f64,
    ) {
        for descriptor in descriptors().iter().filter(|c| !c.rate_dependent) {
            let law = example(descriptor);
            let whole: Vec<f64> = shares.iter().map(|s| s * descriptor.example_amplitude).collect();
            let mut cut_up = Vec::new();
            let mut from = 0.0;
            for x in &whole {
                cut_up.extend([from + cut * (x - from), *x]);
                from = *x;
            }
            let one = history(law.as_ref(), &whole, 0.1);
            let two = history(law.as_ref(), &cut_up, 0.1);
            let force = one.iter().fold(0.0_f64, |m, p| m.max(p.force.abs()));
            let energy = force * descriptor.example_amplitude;
            for (i, a) in one.iter().enumerate() {
                let b = &two[2 * i + 1];
                prop_assert!((a.force - b.force).abs() <= 1e-9 * force, "{}: {:?} {:?}", descriptor.name, a, b);
                prop_assert!((a.dissipated - b.dissipated).abs() <= 1e-9 * energy, "{}: {:?} {:?}", descriptor.name, a, b);
            }
        }
    }
}
