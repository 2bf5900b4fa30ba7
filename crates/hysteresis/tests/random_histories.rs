//! Properties of every law on random histories.
use crate::common::example;
use pounding_hysteresis::laboratory::history;
use pounding_hysteresis::{LawDescriptor, LawParameters, Motion, build, descriptors};
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
                let end = Motion {
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

    /// Forces on the paths of a step differ by no more than the bound of the slope says, at any parameters: those of
    /// slow unloading and of fast loss of strength too.
    #[test]
    fn slopes_keep_their_bound(
        shares in prop::collection::vec(-0.5..0.5_f64, 1..12),
        exponent in 1.0..8.0_f64,
        beta in 0.05..1.5_f64,
        of_beta in -0.95..1.0_f64,
        strength in prop::sample::select(vec![0.0, 0.005, 0.1]),
        pinching in prop::sample::select(vec![0.0, 0.5, 0.95]),
    ) {
        let shape = [("exponent", exponent), ("beta", beta), ("gamma", of_beta * beta)];
        let loss = [("strength_degradation", strength), ("stiffness_degradation", 0.02), ("pinching", pinching)];
        for (name, more) in [("bouc_wen", &[][..]), ("baber_noori_1985", &loss[..])] {
            let common = [("stiffness", 2.0e7), ("yield_force", 2.0e5), ("hardening_ratio", 0.05)];
            let all = [&common[..], &shape[..], more].concat();
            let law = build(name, &LawParameters::from_pairs(&all)).unwrap();
            let mut committed = law.virgin();
            let mut candidate = committed.clone();
            let mut from = 0.0;
            for share in &shares {
                let bound = law.slope_bound(&committed).unwrap();
                // Up to two and a half yield deformations away, either way.
                let place = |k: i32| from + 0.05 * share * f64::from(k) / 8.0;
                let mut force = |k: i32| {
                    let end = Motion { deformation: place(k), velocity: 0.0 };
                    law.trial(&committed, &mut candidate, end, 0.1).force
                };
                let mut before = force(-8);
                for k in -7..=8 {
                    let after = force(k);
                    let (rise, run) = (after - before, place(k) - place(k - 1));
                    prop_assert!(
                        rise.abs() <= bound * run.abs() + 1e-6,
                        "{}: {} at {} of {}",
                        name,
                        rise / run / bound,
                        k,
                        share
                    );
                    before = after;
                }
                committed.commit(&mut candidate);
                from = place(8);
            }
        }
    }
}
